/* SPDX-License-Identifier: BSD-3-Clause */
/* A user's spring law, right or with a chosen fault, and checks of how the fault is reported. */
#ifndef BAUM_TEST_SPRING_LAWS_H
#define BAUM_TEST_SPRING_LAWS_H

#include <baum/planar.h>

#include "point.h"

/* `user` of the law; all zero: no fault. */
typedef struct spring_law {
  int answer; /* returned */
  int spoil;  /* if > 0, element spoil - 1 of out is NaN */
  int wrong;  /* if 1 or 2, this element of out is 1 too large */
} spring_law;

extern spring_law spring_law_good;

/* T = 2 + 3 l^3 + 0.4 l' + 0.1 l l'^2; fails unless `out` is zero at the call. */
int spring_law_cubic(double length, double rate, double out[3], void *user);

/* Value and derivatives of the law. */
void spring_law_cubic_at(double length, double rate, double out[3]);

/* Force and linearize fail with this status and message. */
void check_spring_law_fails(test_point *p, baum_status status, bool retry, const char *message);

/* The check of derivatives reports the wrong element of the law of force 1, or none if `entry` is
 * 0; destroys the mechanism. */
void check_spring_law_verdict(baum_mechanism *mechanism, const char *name, int entry);

#endif
