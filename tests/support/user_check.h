/* SPDX-License-Identifier: BSD-3-Clause */
/* Small mechanisms for baum_mechanism_check_derivatives(). */
#ifndef BAUM_TEST_USER_CHECK_H
#define BAUM_TEST_USER_CHECK_H

#include "user_models.h"

baum_mechanism *user_make_empty(void);

/* Freeze the mechanism, check its derivatives and destroy it. user_check_right() requires that no
 * error is found, user_check_wrong() that `message` reports one. */
baum_status user_check(baum_mechanism *mechanism);
void user_check_right(baum_mechanism *mechanism);
void user_check_wrong(baum_mechanism *mechanism, const char *message);

/* Two coordinates with the design values (0.6, -0.8), and one row named "circle". Its functions
 * receive no `user`. */
baum_mechanism *user_make_constraint(baum_q_fn *phi, baum_q_fn *jacobian, baum_q_fn *nu,
                                     baum_qv_fn *gamma, double scale);

/* Two coordinates with the design values (0, 0), and a force named "spring". */
baum_mechanism *user_make_force(baum_force_fn *force, baum_force_fn *force_q,
                                baum_force_fn *force_v, void *user);

#endif
