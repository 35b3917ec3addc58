/* SPDX-License-Identifier: BSD-3-Clause */
/* Gear, planar: two wheels a and b on a carrier c roll on each other without slip (Nikravesh 1988,
 * chapter 4; Haug 1989, chapter 3). Seen from the carrier, both pitch circles have the same speed
 * at the point of contact. With the pitch radii R_a and R_b and the angular velocities w_a and w_b
 * relative to the carrier, external gears satisfy R_a w_a = -R_b w_b:
 *
 *   Phi   = R_a (angle_a - angle_c) + R_b (angle_b - angle_c) - offset     (1 row)
 *   J     = [ 0 0 R_a   0 0 R_b   0 0 -(R_a + R_b) ]                       (9 columns), constant
 *   gamma = 0, and all second derivatives are 0
 *
 * The reaction on each body is a pure moment, because the tooth force on a wheel and the force of
 * its pin form a couple. The sum of the three moments is zero.
 */
#include <math.h>

#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/planar/planar.h"

/* Parameters. */
enum { RADIUS_A, RADIUS_B, OFFSET, PARAMETER_COUNT };

enum { A, B, CARRIER, BODY_COUNT };

static const baum_i_def_field fields[] = {
  BAUM_I_PLANAR_BODIES(baum_planar_gear_def),
  BAUM_I_FIELD(baum_planar_gear_def, carrier, CARRIER),
  BAUM_I_NUMBERS(baum_planar_gear_def, radius_a, NOT_ZERO, "m", 0.0),
  BAUM_I_NUMBERS(baum_planar_gear_def, radius_b, NOT_ZERO, "m", 0.0),
  BAUM_I_OPTIONAL(baum_planar_gear_def, offset, OPTIONAL, "m"),
  {0},
};

/* ---- definition ---- */

static baum_status check_carrier(const baum_mechanism *mechanism, const baum_planar_gear_def *def,
                                 const char *label)
{
  BAUM_I_TRY(baum_i_planar_check_body(mechanism, def->carrier, label, "carrier"));
  BAUM_I_TRY(baum_i_planar_check_angle(mechanism, def->carrier, label, "carrier"));
  int carrier = baum_i_body_index(mechanism, def->carrier);
  bool is_a = carrier == baum_i_body_index(mechanism, def->body_a);
  if (is_a || carrier == baum_i_body_index(mechanism, def->body_b)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: carrier and %s are both %s", label,
                       is_a ? "body_a" : "body_b",
                       baum_i_label(&mechanism->bodies[carrier]->element).text);
  }
  return BAUM_OK;
}

static baum_status check(const baum_mechanism *mechanism, const void *def, const char *label)
{
  BAUM_I_TRY(baum_i_planar_check_bodies(mechanism, def, label));
  BAUM_I_TRY(baum_i_planar_check_angles(mechanism, def, label));
  return check_carrier(mechanism, def, label);
}

/* Return Phi + offset for the three angles. */
static double rolled(const double *numbers, double a, double b, double carrier)
{
  return numbers[RADIUS_A] * (a - carrier) + numbers[RADIUS_B] * (b - carrier);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  const baum_planar_gear_def *def = joint->element.def;
  const int *body = joint->span.bodies;
  parameters[RADIUS_A] = def->radius_a;
  parameters[RADIUS_B] = def->radius_b;
  parameters[OFFSET] = def->offset;
  if (isnan(def->offset)) {
    parameters[OFFSET] = rolled(parameters, baum_i_design_frame(mechanism, body[A]).angle,
                                baum_i_design_frame(mechanism, body[B]).angle,
                                baum_i_design_frame(mechanism, body[CARRIER]).angle);
  }
  return BAUM_OK;
}

/* ---- type ---- */

static void evaluate_one(const baum_i_joint *joint, const baum_i_point *point,
                         const baum_i_rows *out)
{
  const double *numbers = point->parameters + joint->element.parameter;
  const int *body = joint->span.bodies;
  if (out->phi) {
    const baum_i_frame *frames = point->frames;
    out->phi[joint->row] =
      rolled(numbers, frames[body[A]].angle, frames[body[B]].angle, frames[body[CARRIER]].angle) -
      numbers[OFFSET];
  }
  if (out->jacobian) {
    const double nine[3 * BODY_COUNT] = {
      [3 * A + 2] = numbers[RADIUS_A],
      [3 * B + 2] = numbers[RADIUS_B],
      [3 * CARRIER + 2] = -(numbers[RADIUS_A] + numbers[RADIUS_B]),
    };
    baum_i_columns_pack(point->mechanism, &joint->span, 1, nine, out->jacobian + joint->jacobian);
  }
  if (out->gamma) {
    out->gamma[joint->row] = 0.0;
  }
}

static baum_status evaluate(const baum_i_joint_group *group, baum_i_point *point,
                            const baum_i_rows *out)
{
  for (int i = 0; i < group->count; i++) {
    evaluate_one(group->joints[i], point, out);
  }
  return BAUM_OK;
}

static const baum_i_joint_type type = {
  .definition = {BAUM_I_DEFINITION(planar_gear, "planar gear", fields), .check = check,
                 .parameter_count = PARAMETER_COUNT},
  .scleronomic = true,
  .row_count = 1,
  .lower = lower,
  .evaluate = evaluate,
};

BAUM_I_DEFINE(joint, planar_gear, type)
