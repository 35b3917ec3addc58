/* SPDX-License-Identifier: BSD-3-Clause */
/* Fixed joint (weld), planar: two points coincide (pin_rows.c) and the relative angle is kept.
 *
 *   Phi = [ r_a + p_a - r_b - p_b           (2 rows)
 *           angle_b - angle_a - angle ]     J = [ 0 0 -1 0 0 1 ], gamma = 0
 */
#include <math.h>

#include "mechanism/definition.h"
#include "mechanism/planar/pin_rows.h"

/* Parameters of the joint, which follow the two points. */
enum { ANGLE = 0, OWN_COUNT = 1 };

static const baum_i_def_field fields[] = {
  BAUM_I_PLANAR_FIELDS(baum_planar_fixed_def),
  BAUM_I_OPTIONAL(baum_planar_fixed_def, angle, OPTIONAL, "rad"),
  {0},
};

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  BAUM_I_TRY(baum_i_planar_lower_points(mechanism, joint, parameters));
  const baum_planar_fixed_def *def = joint->element.def;
  baum_i_frame a = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  baum_i_frame b = baum_i_design_frame(mechanism, joint->span.bodies[1]);
  double *numbers = parameters + BAUM_I_PLANAR_NUMBERS;
  numbers[ANGLE] = isnan(def->angle) ? b.angle - a.angle : def->angle;
  return BAUM_OK;
}

/* ---- one joint; the row of the angle is linear, so second derivatives are the pin's ---- */

static void one_phi(const baum_i_planar_pair *pair, double *out)
{
  baum_i_pin_phi(pair, out);
  out[2] = baum_i_planar_angle(pair) - pair->numbers[ANGLE];
}

static void one_jacobian(const baum_i_planar_pair *pair, double *six)
{
  baum_i_pin_jacobian(pair, six);
  baum_i_planar_set_row(six + 12, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0);
}

static void one_gamma(const baum_i_planar_pair *pair, double *out)
{
  baum_i_pin_gamma(pair, out);
  out[2] = 0.0;
}

/* ---- fixed bodies ---- */

static void weld(const double *parameters, bool from_a, const double *known, double *q)
{
  baum_i_frame_kind kind = known ? BAUM_I_FRAME_BODY : BAUM_I_FRAME_GROUND;
  baum_i_frame f = baum_i_frame_at(kind, known);
  const double *p = parameters + (from_a ? 0 : 2);
  const double *s = parameters + (from_a ? 2 : 0);
  double angle = parameters[BAUM_I_PLANAR_NUMBERS + ANGLE];
  q[2] = f.angle + (from_a ? angle : -angle);
  double cosine = cos(q[2]);
  double sine = sin(q[2]);
  q[0] = f.x + f.c * p[0] - f.s * p[1] - (cosine * s[0] - sine * s[1]);
  q[1] = f.y + f.s * p[0] + f.c * p[1] - (sine * s[0] + cosine * s[1]);
}

/* ---- type ---- */

BAUM_I_PLANAR_EVALUATE(3, one_phi, one_jacobian, one_gamma)

BAUM_I_PLANAR_LINEARIZE(baum_i_pin_linearize)

static const baum_i_joint_type type = {
  BAUM_I_PLANAR_JOINT(planar_fixed, "planar fixed joint", baum_i_planar_check_turning, OWN_COUNT,
                      3),
  .lower = lower,
  .linearize = linearize,
  .weld = weld,
};

BAUM_I_DEFINE(joint, planar_fixed, type)
