/* SPDX-License-Identifier: BSD-3-Clause */
/* A coupling has one row, which relates the coordinates c_a and c_b of two joints.
 *
 *   Phi  = c_b - f(c_a)                  (1 row)
 *   f(x) = ratio x + offset, or a user function (the law), as for a cam that moves joint_b
 *
 * J, gamma and the second derivatives follow from the chain rule of composed_row.c. The types of
 * the two joints compute c_a, c_b and their derivatives. Only gamma_q needs the third derivative of
 * a law. It is computed by differences of the second derivative.
 *
 * Positions determine spatial angles only up to whole revolutions. One revolution of c_a changes
 * Phi by 2 pi ratio, and one revolution of c_b changes Phi by 2 pi. Of all values that Phi can
 * therefore have, the one nearest to zero is used. The row thus does not depend on how many
 * revolutions were made. There are two exceptions: a coupling with a law, and a ratio of two
 * spatial angles that is not rational.
 *
 * If a coupling only repeats what other joints already enforce (for example, if it couples the
 * angles of two hinges of one door), the gradients of c_a and c_b cancel up to rounding. The row is
 * then set to zero. Otherwise it would look like an independent row.
 *
 * The row acts on the bodies of joint_a and joint_b. If the joints have a common body, it is listed
 * once, and its columns for both joints are added.
 */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "base/rotation.h"
#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/general/columns.h"
#include "mechanism/general/composed_row.h"
#include "mechanism/general/coordinate.h"

/* Parameters. */
enum { RATIO, OFFSET, PERIOD, PARAMETER_COUNT };

/* Entries of the result of the law. */
enum { VALUE, SLOPE, CURVATURE, LAW_SIZE };

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_coupling_def, joint_a, JOINT),
  BAUM_I_FIELD(baum_coupling_def, joint_b, JOINT),
  BAUM_I_NUMBERS(baum_coupling_def, ratio, FINITE, "[unit b / unit a]", 1.0),
  BAUM_I_OPTIONAL(baum_coupling_def, offset, OPTIONAL, "rad or m"),
  BAUM_I_LAW(baum_coupling_def, ratio),
  BAUM_I_FIELD(baum_coupling_def, user, USER),
  BAUM_I_FIELD(baum_coupling_def, coordinate_a, COORDINATE),
  BAUM_I_FIELD(baum_coupling_def, coordinate_b, COORDINATE),
  {0},
};

/* Smallest period of Phi [revolutions]. It permits ratios of spatial angles with denominators up to
 * 1000, which is more than the number of teeth of any gear. */
static const double SMALLEST_PART = 0.999e-3;
static const double ROUNDING = 1e-12;
/* If the sum of two gradients is at most this fraction of one of them, they are considered to
 * cancel. redundancy.c uses the same limit to decide whether rows are dependent. */
static const double CANCELLED = 1e-10;

/* ---- definition ---- */

/* Return the coordinate of joint_a if `number` is 0, or of joint_b if it is 1. The definition has
 * been checked. */
static baum_i_joint_coordinate coupled(const baum_mechanism *mechanism, const void *given,
                                       int number)
{
  const baum_coupling_def *def = given;
  return number == 0 ? baum_i_joint_coordinate_of(mechanism, def->joint_a, def->coordinate_a)
                     : baum_i_joint_coordinate_of(mechanism, def->joint_b, def->coordinate_b);
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  static const baum_i_coordinate_fields a = {"joint_a", "coordinate_a", "to couple"};
  static const baum_i_coordinate_fields b = {"joint_b", "coordinate_b", "to couple"};
  const baum_coupling_def *def = given;
  BAUM_I_TRY(baum_i_check_coordinate(mechanism, def->joint_a, def->coordinate_a, label, &a));
  BAUM_I_TRY(baum_i_check_coordinate(mechanism, def->joint_b, def->coordinate_b, label, &b));
  const baum_i_joint *joint = mechanism->joints[def->joint_a.index1 - 1];
  bool same = def->joint_a.index1 == def->joint_b.index1;
  if (same && coupled(mechanism, def, 0).number == coupled(mechanism, def, 1).number) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: joint_a and joint_b are both %s, with the same coordinate", label,
                       baum_i_label(&joint->element).text);
  }
  return BAUM_OK;
}

/* Return the index of a body among the first `count` bodies. Returns `count` if it is not one of
 * them. */
static int find(const int *bodies, int count, int body)
{
  int k = 0;
  while (k < count && bodies[k] != body) {
    k++;
  }
  return k;
}

/* Return the smallest change of Phi that whole revolutions of spatial angles can cause. This is the
 * greatest common divisor of the change that one revolution of c_a causes and the change that one
 * revolution of c_b causes. Returns 0 if there is no spatial angle, or if the divisor is below
 * SMALLEST_PART.
 */
static double period_of(const baum_i_joint_coordinate *a, const baum_i_joint_coordinate *b,
                        double ratio)
{
  double period = baum_i_is_spatial_angle(a) ? BAUM_I_REVOLUTION * fabs(ratio) : 0.0;
  double rest = baum_i_is_spatial_angle(b) ? BAUM_I_REVOLUTION : 0.0;
  while (rest > SMALLEST_PART * BAUM_I_REVOLUTION) {
    double next = fabs(remainder(period, rest));
    period = rest;
    rest = next > ROUNDING * BAUM_I_REVOLUTION ? next : 0.0;
  }
  return rest > 0.0 ? 0.0 : period;
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  const baum_coupling_def *def = joint->element.def;
  parameters[RATIO] = def->ratio;
  parameters[OFFSET] = def->offset;
  const baum_i_joint_coordinate a = coupled(mechanism, def, 0);
  const baum_i_joint_coordinate b = coupled(mechanism, def, 1);
  parameters[PERIOD] = def->law ? 0.0 : period_of(&a, &b, def->ratio);
  if (isnan(def->offset)) {
    parameters[OFFSET] = baum_i_design_coordinate(mechanism, &b) -
                         def->ratio * baum_i_design_coordinate(mechanism, &a);
  }
  return BAUM_OK;
}

/* ---- the law ---- */

static baum_i_user_function function(const baum_i_joint *joint)
{
  const baum_coupling_def *def = joint->element.def;
  return (baum_i_user_function){&joint->element, "law", LAW_SIZE, 0, def->user};
}

/* Return the arguments with which the law is called and differentiated. The result contains
 * pointers to `values`, which are q, v and scale. */
static baum_i_local place_at(baum_i_point *point, const double values[3])
{
  return (baum_i_local){.point = point,
                        .ql = 1,
                        .nl = 1,
                        .t = point->t,
                        .q = values,
                        .v = values + 1,
                        .scale = values + 2,
                        .free = point->scratch};
}

static baum_status law_at(const baum_i_joint *joint, const baum_i_local *at, double f[LAW_SIZE])
{
  const baum_coupling_def *def = joint->element.def;
  if (!def->law) {
    const double *numbers = at->point->parameters + joint->element.parameter;
    f[VALUE] = numbers[RATIO] * at->q[0] + numbers[OFFSET];
    f[SLOPE] = numbers[RATIO];
    f[CURVATURE] = 0.0;
    return BAUM_OK;
  }
  baum_i_user_function user = function(joint);
  baum_i_begin_call(&user, at, f);
  return baum_i_judge(&user, at, def->law(at->q[0], f, def->user), f);
}

/* ---- the row ---- */

/* A coupling, together with the state (point) in which it is evaluated. */
typedef struct state {
  baum_i_joint_coordinate of[2];
  baum_i_inner x[2];
  int width;
  double values[3]; /* arguments of place_at(): the coordinate of joint_a, zero, and the scale */
  baum_i_outer g;
} state;

static void set_inner(const baum_i_joint *joint, const baum_i_point *point, int number, state *s)
{
  const baum_i_joint *of = s->of[number].joint;
  const baum_i_span *span = &joint->span;
  const int place[2] = {find(span->bodies, span->body_count, of->span.bodies[0]),
                        find(span->bodies, span->body_count, of->span.bodies[1])};
  baum_i_composed_place(&s->x[number], of->type->width, s->width, place);
  if (point->parameters[joint->element.parameter + PERIOD] > 0.0) {
    baum_i_coordinate_near_zero(&s->of[number], point, &s->x[number].c);
  } else {
    baum_i_coordinate_at(&s->of[number], point, &s->x[number].c);
  }
}

static void set_places(const baum_i_joint *joint, const baum_i_point *point, state *s)
{
  s->of[0] = coupled(point->mechanism, joint->element.def, 0);
  s->of[1] = coupled(point->mechanism, joint->element.def, 1);
  s->width = s->of[0].joint->type->width > s->of[1].joint->type->width
               ? s->of[0].joint->type->width
               : s->of[1].joint->type->width;
  set_inner(joint, point, 0, s);
  set_inner(joint, point, 1, s);
  s->values[0] = s->x[0].c.value;
  s->values[1] = 0.0;
  s->values[2] = baum_i_is_angle(&s->of[0]) ? 1.0 : point->mechanism->length;
}

/* Return the largest element of a gradient. Entries of displacements are multiplied by `length`. */
static double largest(const double *gradient, int width, double length)
{
  /* index of the first rotation column of a body */
  const int turns = width == BAUM_I_SPACE ? 3 : 2;
  double most = 0.0;
  for (int i = 0; i < BAUM_I_COMPOSED_COLUMNS; i++) {
    most = fmax(most, fabs(gradient[i]) * (i % width < turns ? length : 1.0));
  }
  return most;
}

/* Tell whether the gradients of both coordinates cancel. */
static bool is_cancelled(const state *s, double length)
{
  double all[BAUM_I_COMPOSED_COLUMNS] = {0.0};
  double one[BAUM_I_COMPOSED_COLUMNS] = {0.0};
  const baum_i_outer only_b = {.first = {0.0, s->g.first[1]}};
  baum_i_composed_add_gradient(s->x, &s->g, all);
  baum_i_composed_add_gradient(s->x, &only_b, one);
  return largest(all, s->width, length) <= CANCELLED * largest(one, s->width, length);
}

static baum_status state_at(const baum_i_joint *joint, baum_i_point *point, state *s)
{
  set_places(joint, point, s);
  double f[LAW_SIZE];
  baum_i_local at = place_at(point, s->values);
  BAUM_I_TRY(law_at(joint, &at, f));
  double period = point->parameters[joint->element.parameter + PERIOD];
  double value = s->x[1].c.value - f[VALUE];
  s->g = (baum_i_outer){.value = period > 0.0 ? remainder(value, period) : value,
                        .first = {-f[SLOPE], 1.0},
                        .second = {-f[CURVATURE]}};
  if (is_cancelled(s, point->mechanism->length)) {
    s->g.first[0] = s->g.first[1] = 0.0;
  }
  return BAUM_OK;
}

static baum_status evaluate(const baum_i_joint *joint, baum_i_point *point, const baum_i_rows *out)
{
  state s;
  BAUM_I_TRY(state_at(joint, point, &s));
  baum_i_composed_put_row(joint, point, s.width, s.x, &s.g, out);
  return BAUM_OK;
}

/* ---- second derivatives ---- */

static baum_status curvature_field(const void *joint, const baum_i_local *at, double *out)
{
  double f[LAW_SIZE];
  BAUM_I_TRY(law_at(joint, at, f));
  out[0] = f[CURVATURE];
  return BAUM_OK;
}

static baum_status set_third(const baum_i_joint *joint, baum_i_point *point, state *s)
{
  baum_i_local at = place_at(point, s->values);
  baum_i_field field = {.evaluate = curvature_field, .context = joint, .size = 1};
  double third;
  BAUM_I_TRY(baum_i_difference_columns(&field, BAUM_I_VARIABLE_Q, &at, &third));
  s->g.third[0] = -third;
  return BAUM_OK;
}

static bool needs_third(const baum_i_joint *joint, const state *s,
                        const baum_i_joint_blocks *blocks)
{
  const baum_coupling_def *def = joint->element.def;
  return def->law && blocks->gamma_q && s->x[0].c.rate != 0.0;
}

/* w has nv entries, or is NULL. */
static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  state s;
  BAUM_I_TRY(state_at(joint, point, &s));
  if (needs_third(joint, &s, blocks)) {
    BAUM_I_TRY(set_third(joint, point, &s));
  }
  double w_wide[BAUM_I_COMPOSED_COLUMNS] = {0.0};
  baum_i_columns_gather(point, &joint->span, s.width, w, w_wide);
  for (int i = 0; i < 2; i++) {
    double own[BAUM_I_PAIR_COLUMNS];
    baum_i_composed_narrow(&s.x[i], w_wide, own);
    baum_i_coordinate_linearize(&s.of[i], point, own, 1.0, &s.x[i].blocks);
  }
  baum_i_composed_put_blocks(joint, point, s.width, s.x, &s.g, w_wide, lambda, blocks);
  return BAUM_OK;
}

/* ---- checks of the user's law ---- */

static baum_status law_field(const void *joint, const baum_i_local *at, double *out)
{
  return law_at(joint, at, out);
}

static baum_status check_derivatives(const void *element, baum_i_point *point)
{
  static const baum_i_derived pairs[] = {{SLOPE, VALUE}, {CURVATURE, SLOPE}};
  const baum_i_joint *joint = element;
  const baum_coupling_def *def = joint->element.def;
  if (!def->law) {
    return BAUM_OK;
  }
  state s;
  set_places(joint, point, &s);
  double direction[1];
  baum_i_local at = place_at(point, s.values);
  baum_i_user_function law = function(joint);
  baum_i_field field = {.evaluate = law_field, .context = joint, .size = LAW_SIZE};
  baum_i_ray ray = baum_i_column_ray(&at, BAUM_I_VARIABLE_Q, 0, direction);
  return baum_i_compare_entries(&law, "law", &field, pairs, 2, &ray, &at);
}

static const baum_i_joint_type type = {
  .definition = {BAUM_I_DEFINITION(coupling, "coupling", fields), .check = check,
                 .parameter_count = PARAMETER_COUNT, .check_derivatives = check_derivatives},
  .scleronomic = true,
  .row_count = 1,
  .lower = lower,
  .evaluate = baum_i_evaluate_each,
  .evaluate_one = evaluate,
  .linearize = linearize,
};

BAUM_I_DEFINE(joint, coupling, type)
