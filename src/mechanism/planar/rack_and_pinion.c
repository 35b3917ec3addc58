/* SPDX-License-Identifier: BSD-3-Clause */
/* Rack and pinion, planar: body_b's pinion, of pitch radius R about its point, rolls on the rack of
 * body_a, of direction e (Nikravesh 1988, chapter 4; Haug 1989, chapter 3). With d from body_a's
 * marker to body_b's, u = A_a e, and s = u . d the displacement of axis_row.c:
 *
 *   Phi   = s - R (angle_b - angle_a) - offset        (1)
 *   J     = s_q + [ 0 0 R  0 0 -R ]                   (6)
 *   gamma = that of s, as are all second derivatives: the angles are linear
 *
 * Where they touch the pinion is at rest against the rack: its centre goes by R w along u, and the
 * point at R n, n = k x u, by R w u + w k x R n = 0. So the pitch line is at R n from the centre.
 */
#include <math.h>

#include "mechanism/definition.h"
#include "mechanism/planar/axis_row.h"

/* Own numbers, after both points. */
enum { AXIS = 0, RADIUS = 2, OFFSET = 3, OWN_COUNT = 4 };

static const baum_planar_rack_and_pinion_def defaults = {
  .struct_size = sizeof(baum_planar_rack_and_pinion_def),
  .point = {BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN},
  .point_a = {BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN},
  .point_b = {BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN},
  .axis = {1.0, 0.0},
  .offset = BAUM_I_NOT_GIVEN,
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *def, const char *label)
{
  const baum_planar_rack_and_pinion_def *given = def;
  baum_status status = baum_i_planar_check(mechanism, def, label, true);
  if (status == BAUM_OK) {
    status = baum_i_planar_check_angles(mechanism, def, label);
  }
  if (status == BAUM_OK) {
    status = baum_i_axis_check(given->axis, label);
  }
  if (status == BAUM_OK) {
    status = baum_i_check_not_zero(label, "radius", "m", given->radius);
  }
  return status == BAUM_OK ? baum_i_check_optional(label, "offset", "m", given->offset) : status;
}

/* Displacement along the rack less what has been rolled off. */
static double rolled(const baum_i_planar_pair *pair)
{
  return baum_i_axis_value(pair, pair->numbers + AXIS) -
         pair->numbers[RADIUS] * baum_i_planar_angle(pair);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  baum_status status = baum_i_planar_lower_points(mechanism, joint, parameters);
  const baum_planar_rack_and_pinion_def *def = joint->element.def;
  baum_i_frame a = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  baum_i_frame b = baum_i_design_frame(mechanism, joint->span.bodies[1]);
  double *numbers = parameters + BAUM_I_PLANAR_NUMBERS;
  baum_i_axis_lower(def->axis, def->point, &a, numbers + AXIS, NULL);
  numbers[RADIUS] = def->radius;
  baum_i_planar_pair drawn = baum_i_planar_pair_of(parameters, &a, &b);
  numbers[OFFSET] = isnan(def->offset) ? rolled(&drawn) : def->offset;
  return status;
}

/* ---- one joint ---- */

static void one_phi(const baum_i_planar_pair *pair, double *out)
{
  out[0] = rolled(pair) - pair->numbers[OFFSET];
}

static void one_jacobian(const baum_i_planar_pair *pair, double *six)
{
  baum_i_axis_gradient(pair, pair->numbers + AXIS, six);
  six[2] += pair->numbers[RADIUS];
  six[5] -= pair->numbers[RADIUS];
}

static void one_gamma(const baum_i_planar_pair *pair, double *out)
{
  out[0] = baum_i_axis_gamma(pair, pair->numbers + AXIS);
}

static void one_linearize(const baum_i_planar_pair *pair, const double *w, const double *lambda,
                          baum_i_planar_blocks *out)
{
  baum_i_axis_row_linearize(pair, pair->numbers + AXIS, w, lambda[0], out);
}

/* ---- type ---- */

static baum_status evaluate(const baum_i_joint_group *group, baum_i_point *point,
                            const baum_i_rows *out)
{
  static const baum_i_planar_kernels kernels = {1, one_phi, one_jacobian, one_gamma};
  return baum_i_planar_evaluate(group, point, &kernels, out);
}

static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  return baum_i_planar_linearize(joint, point, w, lambda, one_linearize, blocks);
}

static const baum_i_joint_type type = {
  .definition = {.kind = "planar rack and pinion",
                 .size = sizeof(baum_planar_rack_and_pinion_def),
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
  .linearize = linearize,
  .place = baum_i_planar_place,
};

BAUM_I_DEFINE(joint, planar_rack_and_pinion, type)
