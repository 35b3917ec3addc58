/* SPDX-License-Identifier: BSD-3-Clause */
/* Pin in a slot (point on a line), planar: body_b's point stays on an axis fixed in body_a and may
 * turn there (Nikravesh 1988, chapter 4; Haug 1989, chapter 3). With e the unit axis in body_a,
 * n = A_a (k x e), d from body_a's marker to body_b's:
 *
 *   Phi = n . d             (1), a row of axis_row.c
 *
 *   coordinate = A_a e . d, again of axis_row.c
 */
#include "mechanism/definition.h"
#include "mechanism/planar/axis_row.h"

/* Own numbers, after both points. */
enum { OWN_COUNT = BAUM_I_AXIS_NUMBERS };

static const baum_planar_pin_in_slot_def defaults = {
  .struct_size = sizeof(baum_planar_pin_in_slot_def),
  .point = {BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN},
  .point_a = {BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN},
  .point_b = {BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN},
  .axis = {1.0, 0.0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *def, const char *label)
{
  const baum_planar_pin_in_slot_def *given = def;
  baum_status status = baum_i_planar_check(mechanism, def, label, true);
  if (status == BAUM_OK) {
    status = baum_i_planar_check_angle(mechanism, given->body_a, label, "body_a");
  }
  return status == BAUM_OK ? baum_i_axis_check(given->axis, label) : status;
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  baum_status status = baum_i_planar_lower_points(mechanism, joint, parameters);
  const baum_planar_pin_in_slot_def *def = joint->element.def;
  baum_i_frame a = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  double *numbers = parameters + BAUM_I_PLANAR_NUMBERS;
  baum_i_axis_lower(def->axis, def->point, &a, numbers + BAUM_I_AXIS, numbers + BAUM_I_AXIS_NORMAL);
  return status;
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

static baum_status evaluate(const baum_i_joint_group *group, baum_i_point *point,
                            const baum_i_rows *out)
{
  static const baum_i_planar_kernels kernels = {1, one_phi, one_jacobian, one_gamma};
  return baum_i_planar_evaluate(group, point, &kernels, out);
}

static const baum_i_joint_type type = {
  .definition = {.kind = "planar pin in a slot",
                 .size = sizeof(baum_planar_pin_in_slot_def),
                 .defaults = &defaults,
                 .check = check},
  .parameter_count = BAUM_I_PLANAR_NUMBERS + OWN_COUNT,
  .planar = true,
  .scleronomic = true,
  .row_count = 1,
  .bodies = baum_i_planar_bodies,
  .extent = baum_i_planar_extent,
  .lower = lower,
  .evaluate = evaluate,
  .linearize = baum_i_axis_joint_linearize,
  .place = baum_i_planar_place,
  .coordinate = baum_i_axis_joint_coordinate,
  .coordinate_linearize = baum_i_axis_joint_coordinate_linearize,
};

BAUM_I_DEFINE(joint, planar_pin_in_slot, type)
