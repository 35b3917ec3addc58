/* SPDX-License-Identifier: BSD-3-Clause */
/* Small mechanisms for baum_mechanism_check_derivatives(). */
#ifndef BAUM_TEST_USER_CHECK_H
#define BAUM_TEST_USER_CHECK_H

#include "point.h"
#include "user_models.h"

/* These functions freeze the mechanism, check its derivatives and destroy the mechanism.
 * user_check_right() requires that the check finds no error. user_check_wrong() requires that the
 * check fails with this message. */
baum_status user_check(baum_mechanism *mechanism);
void user_check_right(baum_mechanism *mechanism);
void user_check_wrong(baum_mechanism *mechanism, const char *message);

/* Like user_check_wrong(), but requires only that the message names `what` and the number `entry`
 * of the wrong derivative. `what` is the element of the mechanism and its function, such as "joint
 * 1 "cam": curve". */
void user_check_wrong_entry(baum_mechanism *mechanism, const char *what, int entry);

/* Checks that phi(), jacobian(), gamma() and linearize() fail with the same status and the same
 * message. They all call the function of a joint. */
void user_check_fails(test_point *p, baum_status status, bool retry, const char *message);

/* Makes a mechanism with two coordinates, whose design values are (0.6, -0.8), and one row named
 * "circle". The functions of this row receive NULL as their `user`. */
baum_mechanism *user_make_constraint(baum_q_fn *phi, baum_q_fn *jacobian, baum_q_fn *nu,
                                     baum_qv_fn *gamma, double scale);

/* Makes a mechanism with two coordinates, whose design values are (0, 0), and a force named
 * "spring". */
baum_mechanism *user_make_force(baum_force_fn *force, baum_force_fn *force_q,
                                baum_force_fn *force_v, void *user);

#endif
