/* SPDX-License-Identifier: BSD-3-Clause */
/* Coordinates of joints, which drivers, couplings, joint springs, channels and events use.
 *
 * Positions give an angle in space only up to revolutions. Of the possible values, the one nearest
 * to the expected angle is taken. The expected angle is angles[2 k] at the time angles[2 n] and
 * changes at the rate angles[2 k + 1], where k is the index of the coordinate among the n =
 * BAUM_I_COORDINATES joint_count coordinates of all joints. A run updates `angles` after every
 * step. Without angles, or with zeros, the angle is between -pi and pi.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_COORDINATE_H
#define BAUM_I_MECHANISM_GENERAL_COORDINATE_H

#include "mechanism/identify.h"

/* Check that a joint in a definition exists and has this coordinate: BAUM_OK or BAUM_ERR_ARGUMENT.
 * `joint` and `coordinate` are the names of their fields in the definition. `purpose`, such as "to
 * drive", ends the message. */
typedef struct baum_i_coordinate_fields {
  const char *joint;
  const char *coordinate;
  const char *purpose;
} baum_i_coordinate_fields;

baum_status baum_i_check_coordinate(const baum_mechanism *mechanism, baum_joint_id id,
                                    baum_joint_coordinate which, const char *label,
                                    const baum_i_coordinate_fields *fields);

/* Its name in messages: "angle". */
const char *baum_i_coordinate_name(baum_joint_coordinate which);

/* The coordinate of a checked definition. */
baum_i_joint_coordinate baum_i_joint_coordinate_of(const baum_mechanism *mechanism,
                                                   baum_joint_id id, baum_joint_coordinate which);

/* True for an angle [rad], false for a displacement [m]. */
bool baum_i_is_angle(const baum_i_joint_coordinate *c);
/* True for an angle that positions give only up to revolutions. */
bool baum_i_is_spatial_angle(const baum_i_joint_coordinate *c);

static inline void baum_i_coordinate_at(const baum_i_joint_coordinate *c, const baum_i_point *point,
                                        baum_i_coordinate *out)
{
  c->joint->type->coordinate(c->joint, c->number, point, out);
}

/* Like baum_i_coordinate_at(), but with angles between -pi and pi. */
void baum_i_coordinate_near_zero(const baum_i_joint_coordinate *c, const baum_i_point *point,
                                 baum_i_coordinate *out);

/* w and the results have the columns of the joint. */
static inline void baum_i_coordinate_linearize(const baum_i_joint_coordinate *c,
                                               const baum_i_point *point, const double *w,
                                               double lambda, baum_i_coordinate_blocks *out)
{
  c->joint->type->coordinate_linearize(c->joint, c->number, point, w, lambda, out);
}

/* Value of the coordinate in the design configuration. Only elements added after the joint may call
 * this, in `lower`. */
double baum_i_design_coordinate(const baum_mechanism *mechanism, const baum_i_joint_coordinate *c);

/* ---- revolutions ---- */

/* Size of `angles` of a point. */
static inline int baum_i_angles_size(const baum_mechanism *mechanism)
{
  return 2 * BAUM_I_COORDINATES * mechanism->joint_count + 1;
}

/* The expected angle of a spatial joint at the time of the point. */
double baum_i_expected_angle(const baum_i_joint_coordinate *c, const baum_i_point *point);

/* Expect all angles to stay constant from the time t on. */
void baum_i_hold_angles(baum_i_point *point, double t);

/* Update the angles of a point from its positions. Each angle is predicted from the last one with
 * the mean of the last and the present rate, and the value nearest to the prediction is taken.
 * Returns the largest deviation from a prediction, at most half a revolution [rad]. */
double baum_i_follow_angles(baum_i_point *point);

#endif
