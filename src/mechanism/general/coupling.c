/* SPDX-License-Identifier: BSD-3-Clause */
/* Coupling: one row that couples the coordinates of two joints.
 *
 *   Phi  = c_b - f(c_a)                  (1)
 *   f(x) = ratio x + offset, or the user's law: a cam whose follower is a joint
 *
 * J, gamma and second derivatives follow from the chain rule of composed_row.c; the types of the
 * joints give c and its derivatives. The third derivative of a law, which only gamma_q needs, comes
 * from differences of the second one.
 *
 * The row acts on the bodies of joint_a and joint_b, each once. Where the joints share a body,
 * their columns add up.
 */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/general/columns.h"
#include "mechanism/general/composed_row.h"
#include "mechanism/general/coordinate.h"

/* Parameters. */
enum { RATIO, OFFSET, PARAMETER_COUNT };

/* Entries of the law. */
enum { VALUE, SLOPE, CURVATURE, LAW_SIZE };

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_coupling_def, joint_a, JOINT),
  BAUM_I_FIELD(baum_coupling_def, joint_b, JOINT),
  BAUM_I_NUMBERS(baum_coupling_def, ratio, FINITE, "[unit b / unit a]", 1.0),
  BAUM_I_OPTIONAL(baum_coupling_def, offset, OPTIONAL, "rad or m"),
  BAUM_I_FIELD(baum_coupling_def, law, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_coupling_def, user, USER),
  {0},
};

/* ---- definition ---- */

/* The joint of number 0 (joint_a) or 1 (joint_b) of a checked definition. */
static const baum_i_joint *coupled(const baum_mechanism *mechanism, const void *given, int number)
{
  const baum_coupling_def *def = given;
  baum_joint_id id = number == 0 ? def->joint_a : def->joint_b;
  return mechanism->joints[id.index1 - 1];
}

static baum_status check_one(const baum_mechanism *mechanism, baum_joint_id id, const char *label,
                             const char *field)
{
  BAUM_I_TRY(baum_i_check_coordinate(mechanism, id, label, field, "to couple"));
  char text[BAUM_I_LABEL_SIZE];
  return mechanism->joints[id.index1 - 1]->type->width == BAUM_I_PLANE
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT,
                         "%s: %s is %s, a joint in space, which cannot be coupled", label, field,
                         baum_i_joint_label(mechanism, id.index1 - 1, text));
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_coupling_def *def = given;
  BAUM_I_TRY(check_one(mechanism, def->joint_a, label, "joint_a"));
  BAUM_I_TRY(check_one(mechanism, def->joint_b, label, "joint_b"));
  if (def->joint_a.index1 == def->joint_b.index1) {
    char text[BAUM_I_LABEL_SIZE];
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: joint_a and joint_b are both %s", label,
                       baum_i_joint_label(mechanism, def->joint_a.index1 - 1, text));
  }
  return BAUM_OK;
}

/* Place of a body among the first `count` bodies; count if it is not among them. */
static int find(const int *bodies, int count, int body)
{
  int k = 0;
  while (k < count && bodies[k] != body) {
    k++;
  }
  return k;
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  const baum_coupling_def *def = joint->element.def;
  parameters[RATIO] = def->ratio;
  parameters[OFFSET] = def->offset;
  if (isnan(def->offset)) {
    double a = baum_i_design_coordinate(mechanism, coupled(mechanism, def, 0));
    double b = baum_i_design_coordinate(mechanism, coupled(mechanism, def, 1));
    parameters[OFFSET] = b - def->ratio * a;
  }
  return BAUM_OK;
}

/* ---- the law ---- */

static baum_i_user_function function(const baum_i_joint *joint)
{
  const baum_coupling_def *def = joint->element.def;
  return (baum_i_user_function){&joint->element, "law", LAW_SIZE, 0, def->user};
}

/* The point at which the law is called and differentiated; it refers to values (q, v, scale). */
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

/* One coupling at a point. */
typedef struct state {
  const baum_i_joint *joints[2];
  baum_i_inner x[2];
  double values[3]; /* coordinate of joint_a, zero, scale: a place */
  baum_i_outer g;
} state;

static void set_inner(const baum_i_joint *joint, const baum_i_point *point, int number, state *s)
{
  const baum_i_joint *of = coupled(point->mechanism, joint->element.def, number);
  s->joints[number] = of;
  of->type->coordinate(of, point, &s->x[number].c);
  for (int k = 0; k < 2; k++) {
    s->x[number].at[k] = 3 * find(joint->span.bodies, joint->span.body_count, of->span.bodies[k]);
  }
}

static void set_places(const baum_i_joint *joint, const baum_i_point *point, state *s)
{
  set_inner(joint, point, 0, s);
  set_inner(joint, point, 1, s);
  s->values[0] = s->x[0].c.value;
  s->values[1] = 0.0;
  s->values[2] = s->joints[0]->type->is_angle ? 1.0 : point->mechanism->length;
}

static baum_status state_at(const baum_i_joint *joint, baum_i_point *point, state *s)
{
  set_places(joint, point, s);
  double f[LAW_SIZE];
  baum_i_local at = place_at(point, s->values);
  BAUM_I_TRY(law_at(joint, &at, f));
  s->g = (baum_i_outer){
    .value = s->x[1].c.value - f[VALUE], .first = {-f[SLOPE], 1.0}, .second = {-f[CURVATURE]}};
  return BAUM_OK;
}

static baum_status evaluate(const baum_i_joint *joint, baum_i_point *point, const baum_i_rows *out)
{
  state s;
  BAUM_I_TRY(state_at(joint, point, &s));
  baum_i_composed_put_row(joint, point, s.x, &s.g, out);
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

/* w (nv) or NULL. */
static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  state s;
  BAUM_I_TRY(state_at(joint, point, &s));
  if (needs_third(joint, &s, blocks)) {
    BAUM_I_TRY(set_third(joint, point, &s));
  }
  double w_wide[BAUM_I_COMPOSED_COLUMNS] = {0.0};
  baum_i_columns_gather(point, &joint->span, BAUM_I_PLANE, w, w_wide);
  for (int i = 0; i < 2; i++) {
    double six[6];
    baum_i_composed_narrow(&s.x[i], w_wide, six);
    s.joints[i]->type->coordinate_linearize(s.joints[i], point, six, 1.0, &s.x[i].blocks);
  }
  baum_i_composed_put_blocks(joint, point, s.x, &s.g, w_wide, lambda, blocks);
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
  .definition = {.kind = "coupling",
                 .size = sizeof(baum_coupling_def),
                 .fields = fields,
                 .check = check,
                 .parameter_count = PARAMETER_COUNT,
                 .check_derivatives = check_derivatives},
  .scleronomic = true,
  .row_count = 1,
  .lower = lower,
  .evaluate = baum_i_evaluate_each,
  .evaluate_one = evaluate,
  .linearize = linearize,
};

BAUM_I_DEFINE(joint, coupling, type)
