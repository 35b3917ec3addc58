/* SPDX-License-Identifier: BSD-3-Clause */
/* Rack and pinion in the plane. The centre of the pinion is the marker on body_b, and its pitch
 * radius is R. The pinion rolls on a rack, which is fixed in body_a and has the direction e
 * (Nikravesh 1988, chapter 4; Haug 1989, chapter 3). With the vector d from the marker on body_a to
 * the marker on body_b, u = A_a e, and the displacement s = u . d of axis_row.h:
 *
 *   Phi   = s - R (angle_b - angle_a) - offset        (1 row)
 *   J     = s_q + [ 0 0 R  0 0 -R ]                   (6 columns)
 *   gamma and all second derivatives are those of s, because the row is linear in the angles
 *
 * At the contact, the pinion is at rest relative to the rack. Let w be the angular velocity of the
 * pinion relative to the rack, k the unit vector along z, and n = k x u. Relative to the rack, the
 * centre of the pinion has the velocity R w u. The point of the pinion at R n from its centre has
 * the velocity R w u + w k x R n = 0. This point is therefore the point of contact.
 */
#include <math.h>

#include "mechanism/definition.h"
#include "mechanism/planar/axis_row.h"

/* The parameters that follow the two points of the joint. */
enum { AXIS = 0, RADIUS = 2, OFFSET = 3, OWN_COUNT = 4 };

/* ---- definition ---- */

/* Return the displacement along the rack minus the arc length that the pinion has rolled. */
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
  baum_i_axis_lower(mechanism, joint, numbers + AXIS);
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

static void one_second(const baum_i_planar_pair *pair, const double *w, const double *lambda,
                       baum_i_planar_blocks *out)
{
  baum_i_axis_row_linearize(pair, pair->numbers + AXIS, w, lambda[0], out);
}

/* ---- type ---- */

BAUM_I_PLANAR_EVALUATE(planar_rack_and_pinion, 1, one_phi, one_jacobian, one_gamma)
BAUM_I_PLANAR_LINEARIZE(one, one_second)

static const baum_i_joint_type type = {
  BAUM_I_PLANAR_JOINT(planar_rack_and_pinion, "planar rack and pinion", baum_i_planar_check_turning,
                      OWN_COUNT, 1, BAUM_I_PLANAR_AXIS_FIELDS(baum_planar_rack_and_pinion_def),
                      BAUM_I_NUMBERS(baum_planar_rack_and_pinion_def, radius, NOT_ZERO, "m", 0.0),
                      BAUM_I_OPTIONAL(baum_planar_rack_and_pinion_def, offset, OPTIONAL, "m")),
  .lower = lower,
  .linearize = one_linearize,
};

BAUM_I_DEFINE(joint, planar_rack_and_pinion, type)
