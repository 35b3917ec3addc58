/* SPDX-License-Identifier: BSD-3-Clause */
/* Planar joints whose rows make two points coincide, keep a point on an axis, or keep a relative
 * angle constant.
 *
 * In a revolute joint (pin) and a fixed joint (weld), two points coincide, one on each body. With
 * p = A s, k x p = (-p_y, p_x) and k x (k x p) = -p:
 *
 *   Phi   = r_a + p_a - r_b - p_b                               (2 rows)
 *   J     = [ I   k x p_a   -I   -k x p_b ]                     (2 x 6)
 *   gamma = p_a w_a^2 - p_b w_b^2                               (2 rows)
 *
 * The multiplier lambda is the force on body_b. With any vector w of six numbers, the second
 * derivatives are
 *
 *   (J w)_q        columns angle_a: -p_a w_3, angle_b: p_b w_6
 *   (J^T lambda)_q angle_a, angle_a: -p_a . lambda; angle_b, angle_b: p_b . lambda
 *   gamma_q        columns angle_a: (k x p_a) w_a^2, angle_b: -(k x p_b) w_b^2
 *   gamma_v        columns w_a: 2 p_a w_a, w_b: -2 p_b w_b
 *
 * In a pin in a slot (point on a line) and a translational joint (slider), the point of body_b
 * stays on an axis fixed in body_a (Nikravesh 1988, chapter 4; Haug 1989, chapter 3). Let e be the
 * unit axis in the axes of body_a, let n = A_a (k x e), and let d be the vector from the marker on
 * body_a to the marker on body_b. Then
 *
 *   Phi = n . d             (1 row), see axis_row.h;  coordinate = A_a e . d
 *
 * Fixed and translational joints also keep the angle of body_b relative to body_a constant:
 *
 *   Phi = angle_b - angle_a - angle      J = [ 0 0 -1 0 0 1 ], gamma = 0
 *
 * The angle of body_b relative to body_a is also the coordinate of the revolute joint.
 */
#include <math.h>

#include "mechanism/definition.h"
#include "mechanism/planar/axis_row.h"

/* ---- the angle ---- */

/* Return the angle that the definition gives, or else the angle in the design configuration. */
static double choose_angle(const baum_mechanism *mechanism, const baum_i_joint *joint, double given)
{
  baum_i_frame a = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  baum_i_frame b = baum_i_design_frame(mechanism, joint->span.bodies[1]);
  return isnan(given) ? b.angle - a.angle : given;
}

static void set_angle_row(double six[6])
{
  baum_i_planar_set_row(six, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0);
}

static void angle(const baum_i_joint *joint, int number, const baum_i_point *point,
                  baum_i_coordinate *out)
{
  (void)number;
  const baum_i_frame *a = &point->frames[joint->span.bodies[0]];
  const baum_i_frame *b = &point->frames[joint->span.bodies[1]];
  *out = (baum_i_coordinate){
    .value = b->angle - a->angle,
    .rate = b->w - a->w,
    .gradient = {0.0, 0.0, -1.0, 0.0, 0.0, 1.0},
  };
}

/* The angle is a linear function of q, so its second derivatives are zero. */
static void angle_linearize(const baum_i_joint *joint, int number, const baum_i_point *point,
                            const double w[6], double lambda, baum_i_coordinate_blocks *out)
{
  (void)joint;
  (void)number;
  (void)point;
  (void)w;
  (void)lambda;
  *out = (baum_i_coordinate_blocks){.jw_q = {0.0}};
}

/* ---- revolute joint ---- */

static void pin_phi(const baum_i_planar_pair *pair, double *phi)
{
  phi[0] = pair->a.r[0] - pair->b.r[0];
  phi[1] = pair->a.r[1] - pair->b.r[1];
}

static void pin_jacobian(const baum_i_planar_pair *pair, double *six)
{
  const double *a = pair->a.arm;
  const double *b = pair->b.arm;
  baum_i_planar_set_row(six, 1.0, 0.0, -a[1], -1.0, 0.0, b[1]);
  baum_i_planar_set_row(six + 6, 0.0, 1.0, a[0], 0.0, -1.0, -b[0]);
}

static void pin_gamma(const baum_i_planar_pair *pair, double *gamma)
{
  double a = pair->a.w * pair->a.w;
  double b = pair->b.w * pair->b.w;
  gamma[0] = pair->a.arm[0] * a - pair->b.arm[0] * b;
  gamma[1] = pair->a.arm[1] * a - pair->b.arm[1] * b;
}

/* Set the column angle_a of two rows to the vector a p_a, and their column angle_b to b p_b. */
static void set_angle_columns(const double p_a[2], double a, const double p_b[2], double b,
                              double *six)
{
  six[2] = p_a[0] * a;
  six[5] = p_b[0] * b;
  six[8] = p_a[1] * a;
  six[11] = p_b[1] * b;
}

static void pin_second(const baum_i_planar_pair *pair, const double *w, const double *lambda,
                       baum_i_planar_blocks *out)
{
  const double *p_a = pair->a.arm;
  const double *p_b = pair->b.arm;
  const double turned_a[2] = {-p_a[1], p_a[0]};
  const double turned_b[2] = {-p_b[1], p_b[0]};
  double w_a = pair->a.w;
  double w_b = pair->b.w;
  set_angle_columns(p_a, -w[2], p_b, w[5], out->jw_q);
  set_angle_columns(turned_a, w_a * w_a, turned_b, -w_b * w_b, out->gamma_q);
  set_angle_columns(p_a, 2.0 * w_a, p_b, -2.0 * w_b, out->gamma_v);
  out->jtl_q[2 * 6 + 2] = -(p_a[0] * lambda[0] + p_a[1] * lambda[1]);
  out->jtl_q[5 * 6 + 5] = p_b[0] * lambda[0] + p_b[1] * lambda[1];
}

BAUM_I_PLANAR_EVALUATE(planar_revolute, 2, pin_phi, pin_jacobian, pin_gamma)
BAUM_I_PLANAR_LINEARIZE(pin, pin_second)

static const baum_i_joint_type revolute = {
  BAUM_I_PLANAR_JOINT(planar_revolute, "planar revolute joint", baum_i_planar_check_with_point, 0,
                      2, BAUM_I_PLANAR_FIELDS(baum_planar_revolute_def)),
  .is_pin = true,
  .lower = baum_i_planar_lower_points,
  .linearize = pin_linearize,
  .coordinates = {BAUM_COORDINATE_ANGLE},
  .check_coordinate = baum_i_planar_check_angles,
  .coordinate = angle,
  .coordinate_linearize = angle_linearize,
};

BAUM_I_DEFINE(joint, planar_revolute, revolute)

/* ---- fixed joint: the row of the angle is linear and adds no second derivatives ---- */

static baum_status lower_fixed(const baum_mechanism *mechanism, const baum_i_joint *joint,
                               double *parameters)
{
  const baum_planar_fixed_def *def = joint->element.def;
  parameters[BAUM_I_PLANAR_NUMBERS] = choose_angle(mechanism, joint, def->angle);
  return baum_i_planar_lower_points(mechanism, joint, parameters);
}

static void fixed_phi(const baum_i_planar_pair *pair, double *out)
{
  pin_phi(pair, out);
  out[2] = baum_i_planar_angle(pair) - pair->numbers[0];
}

static void fixed_jacobian(const baum_i_planar_pair *pair, double *six)
{
  pin_jacobian(pair, six);
  set_angle_row(six + 12);
}

static void fixed_gamma(const baum_i_planar_pair *pair, double *out)
{
  pin_gamma(pair, out);
  out[2] = 0.0;
}

static void weld(const double *parameters, bool from_a, const double *known, double *q)
{
  baum_i_frame_kind kind = known ? BAUM_I_FRAME_BODY : BAUM_I_FRAME_GROUND;
  baum_i_frame f = baum_i_frame_at(kind, known);
  const double *p = parameters + (from_a ? 0 : 2);
  const double *s = parameters + (from_a ? 2 : 0);
  double angle = parameters[BAUM_I_PLANAR_NUMBERS];
  q[2] = f.angle + (from_a ? angle : -angle);
  double cosine = cos(q[2]);
  double sine = sin(q[2]);
  q[0] = f.x + f.c * p[0] - f.s * p[1] - (cosine * s[0] - sine * s[1]);
  q[1] = f.y + f.s * p[0] + f.c * p[1] - (sine * s[0] + cosine * s[1]);
}

BAUM_I_PLANAR_EVALUATE(planar_fixed, 3, fixed_phi, fixed_jacobian, fixed_gamma)

static const baum_i_joint_type fixed = {
  BAUM_I_PLANAR_JOINT(planar_fixed, "planar fixed joint", baum_i_planar_check_turning, 1, 3,
                      BAUM_I_PLANAR_FIELDS(baum_planar_fixed_def),
                      BAUM_I_OPTIONAL(baum_planar_fixed_def, angle, OPTIONAL, "rad")),
  .lower = lower_fixed,
  .linearize = pin_linearize,
  .weld = weld,
};

BAUM_I_DEFINE(joint, planar_fixed, fixed)

/* ---- pin in a slot ---- */

/* For joints with an axis: indices of the parameters that follow the two points. */
enum { AXIS = 0, NORMAL = 2, SLOT_NUMBERS = 4, ANGLE = SLOT_NUMBERS, SLIDER_NUMBERS };

static baum_status lower_slot(const baum_mechanism *mechanism, const baum_i_joint *joint,
                              double *parameters)
{
  double *numbers = parameters + BAUM_I_PLANAR_NUMBERS;
  BAUM_I_TRY(baum_i_planar_lower_points(mechanism, joint, parameters));
  baum_i_axis_lower(mechanism, joint, numbers + AXIS);
  numbers[NORMAL] = -numbers[AXIS + 1];
  numbers[NORMAL + 1] = numbers[AXIS];
  return BAUM_OK;
}

static void slot_phi(const baum_i_planar_pair *pair, double *out)
{
  out[0] = baum_i_axis_value(pair, pair->numbers + NORMAL);
}

static void slot_jacobian(const baum_i_planar_pair *pair, double *six)
{
  baum_i_axis_gradient(pair, pair->numbers + NORMAL, six);
}

static void slot_gamma(const baum_i_planar_pair *pair, double *out)
{
  out[0] = baum_i_axis_gamma(pair, pair->numbers + NORMAL);
}

static void slot_second(const baum_i_planar_pair *pair, const double *w, const double *lambda,
                        baum_i_planar_blocks *out)
{
  baum_i_axis_row_linearize(pair, pair->numbers + NORMAL, w, lambda[0], out);
}

static void displacement(const baum_i_joint *joint, int number, const baum_i_point *point,
                         baum_i_coordinate *out)
{
  (void)number;
  baum_i_planar_pair pair = baum_i_planar_pair_at(joint, point);
  baum_i_axis_coordinate(&pair, pair.numbers + AXIS, out);
}

static void displacement_linearize(const baum_i_joint *joint, int number, const baum_i_point *point,
                                   const double w[6], double lambda, baum_i_coordinate_blocks *out)
{
  (void)number;
  baum_i_planar_pair pair = baum_i_planar_pair_at(joint, point);
  baum_i_axis_linearize(&pair, pair.numbers + AXIS, w, lambda, out);
}

BAUM_I_PLANAR_EVALUATE(planar_pin_in_slot, 1, slot_phi, slot_jacobian, slot_gamma)
BAUM_I_PLANAR_LINEARIZE(slot, slot_second)

#define DISPLACEMENT                                                          \
  .linearize = slot_linearize, .coordinates = {BAUM_COORDINATE_DISPLACEMENT}, \
  .coordinate = displacement, .coordinate_linearize = displacement_linearize

static const baum_i_joint_type pin_in_slot = {
  BAUM_I_PLANAR_JOINT(planar_pin_in_slot, "planar pin in a slot", baum_i_planar_check_axis,
                      SLOT_NUMBERS, 1, BAUM_I_PLANAR_AXIS_FIELDS(baum_planar_pin_in_slot_def)),
  DISPLACEMENT,
  .lower = lower_slot,
};

BAUM_I_DEFINE(joint, planar_pin_in_slot, pin_in_slot)

/* ---- translational joint ---- */

static baum_status lower_slider(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                double *parameters)
{
  const baum_planar_translational_def *def = joint->element.def;
  parameters[BAUM_I_PLANAR_NUMBERS + ANGLE] = choose_angle(mechanism, joint, def->angle);
  return lower_slot(mechanism, joint, parameters);
}

static void slider_phi(const baum_i_planar_pair *pair, double *out)
{
  slot_phi(pair, out);
  out[1] = baum_i_planar_angle(pair) - pair->numbers[ANGLE];
}

static void slider_jacobian(const baum_i_planar_pair *pair, double *six)
{
  slot_jacobian(pair, six);
  set_angle_row(six + 6);
}

static void slider_gamma(const baum_i_planar_pair *pair, double *out)
{
  slot_gamma(pair, out);
  out[1] = 0.0;
}

BAUM_I_PLANAR_EVALUATE(planar_translational, 2, slider_phi, slider_jacobian, slider_gamma)

static const baum_i_joint_type translational = {
  BAUM_I_PLANAR_JOINT(planar_translational, "planar translational joint",
                      baum_i_planar_check_turning, SLIDER_NUMBERS, 2,
                      BAUM_I_PLANAR_AXIS_FIELDS(baum_planar_translational_def),
                      BAUM_I_OPTIONAL(baum_planar_translational_def, angle, OPTIONAL, "rad")),
  DISPLACEMENT,
  .lower = lower_slider,
};

BAUM_I_DEFINE(joint, planar_translational, translational)
