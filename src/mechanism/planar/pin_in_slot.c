/* SPDX-License-Identifier: BSD-3-Clause */
/* Pin in a slot (point on a line), planar: body_b's point stays on an axis fixed in body_a, and
 * body_b may rotate (Nikravesh 1988, chapter 4; Haug 1989, chapter 3). With e the unit axis in the
 * axes of body_a, n = A_a (k x e), and d from the marker on body_a to the marker on body_b:
 *
 *   Phi = n . d             (1 row), see axis_row.h
 *
 *   coordinate = A_a e . d, see axis_row.h
 */
#include "mechanism/definition.h"
#include "mechanism/planar/axis_row.h"

/* Parameters of the joint, which follow the two points. */
enum { OWN_COUNT = BAUM_I_AXIS_NUMBERS };

static const baum_i_def_field fields[] = {
  BAUM_I_PLANAR_FIELDS(baum_planar_pin_in_slot_def),
  BAUM_I_NUMBERS(baum_planar_pin_in_slot_def, axis, DIRECTION, "", 1.0, 0.0),
  {0},
};

/* ---- definition ---- */

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  BAUM_I_TRY(baum_i_planar_lower_points(mechanism, joint, parameters));
  const baum_planar_pin_in_slot_def *def = joint->element.def;
  baum_i_frame a = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  double *numbers = parameters + BAUM_I_PLANAR_NUMBERS;
  baum_i_axis_lower(def->axis, def->point, &a, numbers + BAUM_I_AXIS, numbers + BAUM_I_AXIS_NORMAL);
  return BAUM_OK;
}

/* ---- one joint ---- */

static void one_phi(const baum_i_planar_pair *pair, double *out)
{
  out[0] = baum_i_axis_value(pair, pair->numbers + BAUM_I_AXIS_NORMAL);
}

static void one_jacobian(const baum_i_planar_pair *pair, double *six)
{
  baum_i_axis_gradient(pair, pair->numbers + BAUM_I_AXIS_NORMAL, six);
}

static void one_gamma(const baum_i_planar_pair *pair, double *out)
{
  out[0] = baum_i_axis_gamma(pair, pair->numbers + BAUM_I_AXIS_NORMAL);
}

/* ---- type ---- */

BAUM_I_PLANAR_EVALUATE(1, one_phi, one_jacobian, one_gamma)

static const baum_i_joint_type type = {
  BAUM_I_PLANAR_JOINT(planar_pin_in_slot, "planar pin in a slot", baum_i_planar_check_axis,
                      OWN_COUNT, 1),
  .lower = lower,
  .linearize = baum_i_axis_joint_linearize,
  .coordinates = {BAUM_COORDINATE_DISPLACEMENT},
  .coordinate = baum_i_axis_joint_coordinate,
  .coordinate_linearize = baum_i_axis_joint_coordinate_linearize,
};

BAUM_I_DEFINE(joint, planar_pin_in_slot, type)
