/* SPDX-License-Identifier: BSD-3-Clause */
/* Rack and pinion, planar: body_b's pinion, of pitch radius R about its point, rolls on the rack of
 * body_a, of direction e (Nikravesh 1988, chapter 4; Haug 1989, chapter 3). With d from body_a's
 * marker to body_b's, u = A_a e, and s = u . d the displacement of axis_row.c:
 *
 *   Phi   = s - R (angle_b - angle_a) - offset        (1)
 *   J     = s_q + [ 0 0 R  0 0 -R ]                   (6)
 *   gamma = that of s, as are all second derivatives: the angles are linear
 *
 * At the contact the pinion is at rest relative to the rack: its centre moves at R w u, and its
 * point at R n, n = k x u, at R w u + w k x R n = 0. So the pitch line is at R n from the centre.
 */
#include <math.h>

#include "mechanism/definition.h"
#include "mechanism/planar/axis_row.h"

/* Own numbers, after both points. */
enum { AXIS = 0, RADIUS = 2, OFFSET = 3, OWN_COUNT = 4 };

static const baum_i_def_field fields[] = {
  BAUM_I_PLANAR_FIELDS(baum_planar_rack_and_pinion_def),
  BAUM_I_NUMBERS(baum_planar_rack_and_pinion_def, axis, DIRECTION, "[-]", 1.0, 0.0),
  BAUM_I_NUMBERS(baum_planar_rack_and_pinion_def, radius, NOT_ZERO, "m", 0.0),
  BAUM_I_OPTIONAL(baum_planar_rack_and_pinion_def, offset, OPTIONAL, "m"),
  {0},
};

/* ---- definition ---- */

/* Displacement along the rack minus the arc rolled by the pinion. */
static double rolled(const baum_i_planar_pair *pair)
{
  return baum_i_axis_value(pair, pair->numbers + AXIS) -
         pair->numbers[RADIUS] * baum_i_planar_angle(pair);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  BAUM_I_TRY(baum_i_planar_lower_points(mechanism, joint, parameters));
  const baum_planar_rack_and_pinion_def *def = joint->element.def;
  baum_i_frame a = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  baum_i_frame b = baum_i_design_frame(mechanism, joint->span.bodies[1]);
  double *numbers = parameters + BAUM_I_PLANAR_NUMBERS;
  baum_i_axis_lower(def->axis, def->point, &a, numbers + AXIS, NULL);
  numbers[RADIUS] = def->radius;
  baum_i_planar_pair design = baum_i_planar_pair_of(parameters, &a, &b);
  numbers[OFFSET] = isnan(def->offset) ? rolled(&design) : def->offset;
  return BAUM_OK;
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

BAUM_I_PLANAR_EVALUATE(1, one_phi, one_jacobian, one_gamma)

BAUM_I_PLANAR_LINEARIZE(one_linearize)

static const baum_i_joint_type type = {
  BAUM_I_PLANAR_JOINT(planar_rack_and_pinion, "planar rack and pinion", baum_i_planar_check_turning,
                      OWN_COUNT, 1),
  .lower = lower,
  .linearize = linearize,
};

BAUM_I_DEFINE(joint, planar_rack_and_pinion, type)
