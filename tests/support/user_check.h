/* SPDX-License-Identifier: BSD-3-Clause */
/* Small mechanisms for baum_mechanism_check_derivatives(). */
#ifndef BAUM_TEST_USER_CHECK_H
#define BAUM_TEST_USER_CHECK_H

#include "user_models.h"

baum_mechanism *user_make_empty(void);

/* Freezes the mechanism, checks its derivatives and destroys it. The second and third function fail
 * the test unless no error is found, or the one in the message. */
baum_status user_check(baum_mechanism *mechanism);
void user_check_right(baum_mechanism *mechanism);
void user_check_wrong(baum_mechanism *mechanism, const char *message);

/* Two coordinates with the design values (0.6, -0.8), and one row named "circle" without `user`. */
baum_mechanism *user_make_constraint(baum_q_fn *phi, baum_q_fn *jacobian, baum_q_fn *nu,
                                     baum_qv_fn *gamma, double scale);

/* Two coordinates with the design values (0, 0), and a force named "spring". */
baum_mechanism *user_make_force(baum_force_fn *force, baum_force_fn *force_q,
                                baum_force_fn *force_v, void *user);

#endif
