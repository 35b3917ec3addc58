/* SPDX-License-Identifier: BSD-3-Clause */
/* Translational joint (slider), planar: body_b slides along an axis fixed in body_a and does not
 * rotate relative to it. With e the unit axis in the axes of body_a, n = A_a (k x e), and d from
 * the marker on body_a to the marker on body_b:
 *
 *   Phi = [ n . d                           distance from the axis, see axis_row.h
 *           angle_b - angle_a - angle ]     J = [ 0 0 -1 0 0 1 ], gamma = 0
 *
 *   coordinate = A_a e . d, see axis_row.h
 */
#include <math.h>

#include "mechanism/definition.h"
#include "mechanism/planar/axis_row.h"

/* Parameters of the joint, which follow the two points. */
enum { ANGLE = BAUM_I_AXIS_NUMBERS, OWN_COUNT };

static const baum_i_def_field fields[] = {
  BAUM_I_PLANAR_FIELDS(baum_planar_translational_def),
  BAUM_I_NUMBERS(baum_planar_translational_def, axis, DIRECTION, "", 1.0, 0.0),
  BAUM_I_OPTIONAL(baum_planar_translational_def, angle, OPTIONAL, "rad"),
  {0},
};

/* ---- definition ---- */

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  BAUM_I_TRY(baum_i_planar_lower_points(mechanism, joint, parameters));
  const baum_planar_translational_def *def = joint->element.def;
  baum_i_frame a = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  baum_i_frame b = baum_i_design_frame(mechanism, joint->span.bodies[1]);
  double *numbers = parameters + BAUM_I_PLANAR_NUMBERS;
  baum_i_axis_lower(def->axis, def->point, &a, numbers + BAUM_I_AXIS, numbers + BAUM_I_AXIS_NORMAL);
  numbers[ANGLE] = isnan(def->angle) ? b.angle - a.angle : def->angle;
  return BAUM_OK;
}

/* ---- one joint ---- */

static void one_phi(const baum_i_planar_pair *pair, double *out)
{
  out[0] = baum_i_axis_value(pair, pair->numbers + BAUM_I_AXIS_NORMAL);
  out[1] = baum_i_planar_angle(pair) - pair->numbers[ANGLE];
}

static void one_jacobian(const baum_i_planar_pair *pair, double *six)
{
  baum_i_axis_gradient(pair, pair->numbers + BAUM_I_AXIS_NORMAL, six);
  baum_i_planar_set_row(six + 6, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0);
}

static void one_gamma(const baum_i_planar_pair *pair, double *out)
{
  out[0] = baum_i_axis_gamma(pair, pair->numbers + BAUM_I_AXIS_NORMAL);
  out[1] = 0.0;
}

/* ---- type ---- */

BAUM_I_PLANAR_EVALUATE(2, one_phi, one_jacobian, one_gamma)

static const baum_i_joint_type type = {
  BAUM_I_PLANAR_JOINT(planar_translational, "planar translational joint",
                      baum_i_planar_check_turning, OWN_COUNT, 2),
  .lower = lower,
  .linearize = baum_i_axis_joint_linearize,
  .coordinates = {BAUM_COORDINATE_DISPLACEMENT},
  .coordinate = baum_i_axis_joint_coordinate,
  .coordinate_linearize = baum_i_axis_joint_coordinate_linearize,
};

BAUM_I_DEFINE(joint, planar_translational, type)
