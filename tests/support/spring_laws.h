/* SPDX-License-Identifier: BSD-3-Clause */
/* A user's law of a spring. It is right or has a fault that a test chooses. The functions below
 * check how the library reports the fault. */
#ifndef BAUM_TEST_SPRING_LAWS_H
#define BAUM_TEST_SPRING_LAWS_H

#include <baum/planar.h>

#include "point.h"

/* The law receives this struct as its `user`. If all fields are zero, the law has no fault. */
typedef struct spring_law {
  int answer; /* return value of the law */
  int spoil;  /* if > 0, element spoil - 1 of out is NaN */
  int wrong;  /* if 1 or 2, this element of out is 1 too large */
} spring_law;

extern spring_law spring_law_good;

/* The tension T = 2 + 3 l^3 + 0.4 l' + 0.1 l l'^2. The test fails unless the caller has set `out`
 * to zero. */
int spring_law_cubic(double length, double rate, double out[3], void *user);

/* Computes the value and the derivatives of the law. */
void spring_law_cubic_at(double length, double rate, double out[3]);

/* Checks that force() and linearize() fail with this status and message. */
void check_spring_law_fails(test_point *p, baum_status status, bool retry, const char *message);

/* Calls baum_mechanism_check_derivatives(). Checks that its message names element `entry` of the
 * law of force 1, or, if `entry` is 0, that it reports no error. Destroys the mechanism. */
void check_spring_law_verdict(baum_mechanism *mechanism, const char *name, int entry);

#endif
