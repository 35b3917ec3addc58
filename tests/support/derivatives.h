/* SPDX-License-Identifier: BSD-3-Clause */
/* Every derivative that a mechanism's elements give, against differences at the point's present
 * state. */
#ifndef BAUM_TEST_DERIVATIVES_H
#define BAUM_TEST_DERIVATIVES_H

#include "point.h"

/* J, nu, gamma, and the blocks of linearize, for all joints together. */
void check_joint_derivatives(test_point *p);

/* Gradient, rate, gamma and the blocks of the coordinate of the joint that was added first. */
void check_coordinate_derivatives(test_point *p);

/* force_q and force_v of all forces. */
void check_force_derivatives(test_point *p);

/* The gradient of the potential is the force at rest, turned round. */
void check_potential_gradient(test_point *p);

#endif
