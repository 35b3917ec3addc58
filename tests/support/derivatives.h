/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the derivatives of a mechanism's elements with finite differences, at the present
 * state. */
#ifndef BAUM_TEST_DERIVATIVES_H
#define BAUM_TEST_DERIVATIVES_H

#include "point.h"

/* Checks J, nu, gamma and the blocks of linearize() of all joints. */
void check_joint_derivatives(test_point *p);

/* Checks gradient, rate, gamma and the blocks of all coordinates of the first joint. */
void check_coordinate_derivatives(test_point *p);

/* Checks force_q and force_v of all forces. */
void check_force_derivatives(test_point *p);

/* Checks that the force at zero velocities is minus the gradient of the potential. */
void check_potential_gradient(test_point *p);

#endif
