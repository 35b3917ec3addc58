/* SPDX-License-Identifier: BSD-3-Clause */
/* Coordinates of joints. Drivers, couplings, joint springs, channels and events use these
 * coordinates.
 *
 * The positions of spatial bodies determine the angle of a joint only up to whole revolutions. Of
 * the possible values of the angle, the one nearest to an expected angle is used. The expected
 * angle is a linear function of time. Let n be the number of angles, and k the index of an angle.
 * At the time angles[2 n], the expected angle is angles[2 k], and its rate is angles[2 k + 1]. The
 * angles of the joints come first, with BAUM_I_COORDINATES places for each joint. One place for
 * each force follows. It is used only if the force counts revolutions. A run updates `angles` after
 * steps. If `angles` is NULL or all zeros, the angle is between -pi and pi.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_COORDINATE_H
#define BAUM_I_MECHANISM_GENERAL_COORDINATE_H

#include "mechanism/identify.h"

/* Texts for a message about the two fields of a definition that select a coordinate. `joint` and
 * `coordinate` are the names of these fields. `purpose`, for example "to drive", is the end of the
 * message. */
typedef struct baum_i_coordinate_fields {
  const char *joint;
  const char *coordinate;
  const char *purpose;
} baum_i_coordinate_fields;

/* Check that a definition names an existing joint and that this joint has the coordinate. Returns
 * BAUM_OK or BAUM_ERR_ARGUMENT. */
baum_status baum_i_check_coordinate(const baum_mechanism *mechanism, baum_joint_id id,
                                    baum_joint_coordinate which, const char *label,
                                    const baum_i_coordinate_fields *fields);

/* Return the name of a coordinate for messages, for example "angle". */
const char *baum_i_coordinate_name(baum_joint_coordinate which);

/* Return the coordinate that a definition selects. The definition has been checked. */
baum_i_joint_coordinate baum_i_joint_coordinate_of(const baum_mechanism *mechanism,
                                                   baum_joint_id id, baum_joint_coordinate which);

/* Return true for an angle [rad], and false for a displacement [m]. */
bool baum_i_is_angle(const baum_i_joint_coordinate *c);
/* Return true for an angle that positions determine only up to whole revolutions. */
bool baum_i_is_spatial_angle(const baum_i_joint_coordinate *c);

static inline void baum_i_coordinate_at(const baum_i_joint_coordinate *c, const baum_i_point *point,
                                        baum_i_coordinate *out)
{
  c->joint->type->coordinate(c->joint, c->number, point, out);
}

/* Do what baum_i_coordinate_at() does, but return angles between -pi and pi. */
void baum_i_coordinate_near_zero(const baum_i_joint_coordinate *c, const baum_i_point *point,
                                 baum_i_coordinate *out);

/* Compute second derivatives of a coordinate. w and the results have the columns of the joint. */
static inline void baum_i_coordinate_linearize(const baum_i_joint_coordinate *c,
                                               const baum_i_point *point, const double *w,
                                               double lambda, baum_i_coordinate_blocks *out)
{
  c->joint->type->coordinate_linearize(c->joint, c->number, point, w, lambda, out);
}

/* Return the value of the coordinate in the design configuration. Elements call this function only
 * in `lower`, and only for joints that were added before them, because the parameters of the joint
 * must have been set. */
double baum_i_design_coordinate(const baum_mechanism *mechanism, const baum_i_joint_coordinate *c);

/* ---- revolutions ---- */

/* Return the length of the array `angles` of a point. */
static inline int baum_i_angles_size(const baum_mechanism *mechanism)
{
  return 2 * (BAUM_I_COORDINATES * mechanism->joint_count + mechanism->force_count) + 1;
}

/* Return the expected angle of a spatial joint at the time of the point. */
double baum_i_expected_angle(const baum_i_joint_coordinate *c, const baum_i_point *point);

/* Return the expected angle of a force that counts revolutions. */
double baum_i_expected_force_angle(const baum_i_force *force, const baum_i_point *point);

/* Do what baum_workspace_set_angle() does, for the public function `call`. Returns BAUM_OK or
 * BAUM_ERR_ARGUMENT. */
baum_status baum_i_set_angle(const baum_i_point *point, baum_joint_id joint,
                             baum_joint_coordinate which, double angle, const char *call);

/* Set the expected angle of a coordinate, and set its expected rate to zero. */
void baum_i_expect_angle(const baum_i_joint_coordinate *c, const baum_i_point *point, double angle);

/* Set the rates of all expected angles to zero, so that the angles are constant from the time t
 * on. */
void baum_i_hold_angles(baum_i_point *point, double t);

/* Update the angles of a point from its positions. Each angle is predicted from its last value with
 * the mean of its last rate and its present rate. Of the possible values of the angle, the one
 * nearest to the prediction is stored. Returns the largest difference between an angle and its
 * prediction, in rad. It is at most pi. */
double baum_i_follow_angles(baum_i_point *point);

/* Tell whether all angles are still so near to their last values that they need not be updated at
 * time t. `rate` is the largest angular velocity of a body. The function also considers the last
 * rates of the angles, because they may be larger than `rate`. `angles` must not be NULL. */
bool baum_i_angles_are_near(const baum_i_point *point, double t, double rate);

#endif
