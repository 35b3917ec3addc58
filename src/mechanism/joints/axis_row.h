/* SPDX-License-Identifier: BSD-3-Clause */
/* Distance of body_b's marker from body_a's along a direction fixed in body_a: with the normal of an
 * axis the first row of the translational joint and the row of the pin in a slot, with the axis
 * itself their coordinate; also part of the rack and pinion and of the point on a curve.
 */
#ifndef BAUM_I_MECHANISM_JOINTS_AXIS_ROW_H
#define BAUM_I_MECHANISM_JOINTS_AXIS_ROW_H

#include "mechanism/joints/planar_rows.h"

/* ---- an axis in definitions ---- */

/* Finite, with a direction. */
baum_status baum_i_axis_check(const double axis[2], const char *label);

/* The unit axis and its normal k x axis (NULL: not wanted), in the axes of body_a, drawn at `a`. The axis has those
 * axes that the points have: with `point` (given or NaN) it is drawn on the ground. */
void baum_i_axis_lower(const double axis[2], const double point[2], const baum_i_frame *a,
                       double along[2], double normal[2]);

/* ---- direction: unit vector in the axes of body_a ---- */

double baum_i_axis_value(const baum_i_planar_pair *pair, const double direction[2]);

void baum_i_axis_gradient(const baum_i_planar_pair *pair, const double direction[2],
                          double gradient[6]);

/* So that gradient . a = value'' + gamma. */
double baum_i_axis_gamma(const baum_i_planar_pair *pair, const double direction[2]);

/* All of the above. */
void baum_i_axis_coordinate(const baum_i_planar_pair *pair, const double direction[2],
                            baum_i_coordinate *out);

/* Sets every entry. */
void baum_i_axis_linearize(const baum_i_planar_pair *pair, const double direction[2],
                           const double w[6], double lambda, baum_i_coordinate_blocks *out);

/* The same as the first row of a joint. */
void baum_i_axis_row_linearize(const baum_i_planar_pair *pair, const double direction[2],
                               const double w[6], double lambda, baum_i_planar_blocks *out);

#endif
