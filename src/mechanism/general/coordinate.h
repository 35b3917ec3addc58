/* SPDX-License-Identifier: BSD-3-Clause */
/* Coordinates of joints. Drivers, couplings, joint springs, channels and events use them.
 *
 * In space, positions determine the angle of a joint only up to whole revolutions. Of the possible
 * values, the one nearest to an expected angle is taken. The expected angle is linear in time: at
 * the time angles[2 n] it is angles[2 k], and its rate is angles[2 k + 1]. Here k is the index of
 * the coordinate among the n = BAUM_I_COORDINATES * joint_count coordinates of all joints. A run
 * updates `angles` after every step. If `angles` is NULL or all zeros, the angle is between -pi and
 * pi.
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

/* Return the name of a coordinate for messages, such as "angle". */
const char *baum_i_coordinate_name(baum_joint_coordinate which);

/* Return the coordinate that a checked definition selects. */
baum_i_joint_coordinate baum_i_joint_coordinate_of(const baum_mechanism *mechanism,
                                                   baum_joint_id id, baum_joint_coordinate which);

/* True for an angle [rad], false for a displacement [m]. */
bool baum_i_is_angle(const baum_i_joint_coordinate *c);
/* True for an angle that positions determine only up to whole revolutions. */
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

/* Return the value of the coordinate in the design configuration. Call it only in `lower` of
 * elements that were added after the joint, because the parameters of the joint must have been
 * set. */
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

/* Update the angles of a point from its positions. Each angle is predicted from its last value with
 * the mean of its last and its present rate. Of the possible values, the one nearest to the
 * prediction is taken. Returns the largest deviation from a prediction, in rad, which is at most
 * pi. */
double baum_i_follow_angles(baum_i_point *point);

#endif
