/* SPDX-License-Identifier: BSD-3-Clause */
/* Axes that are moved along a mechanism from body to body. Their origin r and their quaternion p
 * are functions of one angle. */
#ifndef BAUM_TEST_CARRIED_H
#define BAUM_TEST_CARRIED_H

#include "jets.h"

typedef struct carried {
  jets r[3];
  jets p[4];
} carried;

/* Returns axes that are parallel to the ground axes. */
carried carried_at(long double x, long double y, long double z);
/* Rotates the axes about one of them. */
void carried_turn(carried *c, int axis, jets angle);
/* Moves the origin to the point (x, y, z), which is given in these axes. */
void carried_go(carried *c, long double x, long double y, long double z);
/* Computes w = 2 vec(p^-1 p^(n)), where p^(n) is the n-th derivative of p. */
void carried_spin(const carried *c, int n, long double w[3]);

#endif
