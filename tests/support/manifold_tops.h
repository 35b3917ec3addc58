/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid bodies with a unit quaternion that rotate about a fixed point. They are a free top, a ball,
 * and a heavy top. A user constraint with three rows holds the ball and the heavy top at the fixed
 * point. For the heavy top, this constraint is defined with or without its Jacobian. The functions
 * named `solve` integrate the reference motions. */
#ifndef BAUM_TEST_MANIFOLD_TOPS_H
#define BAUM_TEST_MANIFOLD_TOPS_H

#include <baum/baum.h>

void manifold_build_free_top(baum_mechanism *mechanism);
void manifold_solve_free_top(double t, double *q);
void manifold_build_heavy_top(baum_mechanism *mechanism);
void manifold_build_given_top(baum_mechanism *mechanism);
void manifold_solve_heavy_top(double t, double *q);
/* Builds the heavy top as a spatial body on a spherical joint. */
void manifold_build_spatial_top(baum_mechanism *mechanism);
void manifold_build_ball(baum_mechanism *mechanism);
void manifold_solve_ball(double t, double *q);

#endif
