/* SPDX-License-Identifier: BSD-3-Clause */
/* A load on one body in space. It consists of a force f at the point s, and a moment n. If the load
 * has an input, both are multiplied by the input. Below, the generalized force g has two parts: one
 * for r in ground axes, and one for the rotation in body axes. Its derivative g_q is zero except in
 * the columns of the rotation, and there only the rows named below differ from zero. With F = A^T
 * f, and [a]x b = a x b:
 *
 *   ground axes    g = (f, s x A^T f + A^T n)     rows of rotation: [s]x [F]x + [A^T n]x
 *                  V = -f . (r + A s) where n = 0
 *   follows_body   g = (A f, s x f + n)           rows of r: -A [f]x
 *
 * In space, a constant moment has no potential. A load that has an input has no potential either,
 * because a jump of the input would change the potential although no work is done.
 */
#include <string.h>

#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/spatial/spatial.h"

/* Parameters. */
enum { POINT = 0, FORCE = 3, MOMENT = 6, PARAMETER_COUNT = 9 };

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_spatial_load_def, body, BODY),
  BAUM_I_NUMBERS(baum_spatial_load_def, point, FINITE, "m", 0.0),
  BAUM_I_NUMBERS(baum_spatial_load_def, force, FINITE, "N", 0.0),
  BAUM_I_NUMBERS(baum_spatial_load_def, moment, FINITE, "N m", 0.0),
  BAUM_I_FIELD(baum_spatial_load_def, input, INPUT),
  BAUM_I_FIELD(baum_spatial_load_def, follows_body, FLAG),
  {0},
};

/* ---- definition ---- */

static bool is_zero(const double x[3])
{
  return x[0] == 0.0 && x[1] == 0.0 && x[2] == 0.0;
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_spatial_load_def *def = given;
  BAUM_I_TRY(baum_i_spatial_check_body(mechanism, def->body, label, "body"));
  int index = baum_i_body_index(mechanism, def->body);
  if (index == 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: body is ground, which does not move", label);
  }
  BAUM_I_TRY(
    baum_i_spatial_check_zero_on_particle(mechanism, def->body, label, "point", "m", def->point));
  BAUM_I_TRY(baum_i_spatial_check_zero_on_particle(mechanism, def->body, label, "moment", "N m",
                                                   def->moment));
  return def->follows_body ? baum_i_spatial_check_turning(mechanism, def->body, label, "body")
                           : BAUM_OK;
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  (void)mechanism;
  const baum_spatial_load_def *def = force->element.def;
  memcpy(parameters + POINT, def->point, sizeof def->point);
  memcpy(parameters + FORCE, def->force, sizeof def->force);
  memcpy(parameters + MOMENT, def->moment, sizeof def->moment);
  return BAUM_OK;
}

/* ---- one load ---- */

typedef struct load {
  const baum_i_spatial_frame *frame;
  const double *point;
  double force[2][3];  /* in ground axes, and in body axes */
  double moment[2][3]; /* in ground axes, and in body axes */
  bool follows_body;
  bool has_potential;
} load;

static void set_both(const baum_i_spatial_frame *frame, const double *given, double scale,
                     bool follows_body, double out[2][3])
{
  int own = follows_body ? 1 : 0;
  for (int i = 0; i < 3; i++) {
    out[own][i] = scale * given[i];
  }
  if (follows_body) {
    baum_i_turn(frame->axes, out[1], out[0]);
  } else {
    baum_i_turn_back(frame->axes, out[0], out[1]);
  }
}

static load load_at(const baum_i_force *element, const baum_i_point *point)
{
  const baum_spatial_load_def *def = element->element.def;
  const double *numbers = point->parameters + element->element.parameter;
  double scale = baum_i_input_factor(point, def->input);
  load l = {
    .frame = &point->spatial[element->span.bodies[0]],
    .point = numbers + POINT,
    .follows_body = def->follows_body,
    .has_potential =
      !def->follows_body && is_zero(numbers + MOMENT) && !baum_i_has_input(def->input),
  };
  set_both(l.frame, numbers + FORCE, scale, def->follows_body, l.force);
  set_both(l.frame, numbers + MOMENT, scale, def->follows_body, l.moment);
  return l;
}

/* ---- type ---- */

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const load l = load_at(group->forces[i], point);
    double wide[BAUM_I_SPACE];
    memcpy(wide, l.force[0], sizeof l.force[0]);
    baum_i_cross(l.point, l.force[1], wide + 3);
    for (int k = 0; k < 3; k++) {
      wide[3 + k] += l.moment[1][k];
    }
    baum_i_columns_scatter_any(point->mechanism, &group->forces[i]->span, BAUM_I_SPACE, wide, out);
  }
  return BAUM_OK;
}

static baum_status potential(const baum_i_force *element, baum_i_point *point, double *sum)
{
  const load l = load_at(element, point);
  if (l.has_potential) {
    *sum -= baum_i_dot3(l.force[0], l.frame->r) + baum_i_dot3(l.force[1], l.point);
  }
  return BAUM_OK;
}

static baum_status power(const baum_i_force *element, baum_i_point *point,
                         double sum[BAUM_I_POWERS])
{
  const load l = load_at(element, point);
  double moment[3];
  double w[3];
  if (l.has_potential) {
    return BAUM_OK;
  }
  baum_i_turn_back(l.frame->axes, l.frame->w, w);
  baum_i_cross(l.point, l.force[1], moment);
  sum[BAUM_I_POWER_LOADS] +=
    baum_i_dot3(l.force[0], l.frame->v) + baum_i_dot3(moment, w) + baum_i_dot3(l.moment[1], w);
  return BAUM_OK;
}

/* Writes the derivative of g with respect to a rotation about body axis j. */
static void set_column(const load *l, int j, double square[36])
{
  const double axis[3] = {j == 0, j == 1, j == 2};
  double turned[3];
  double rows[6] = {0.0};
  if (l->follows_body) {
    baum_i_cross(axis, l->force[1], turned);
    baum_i_turn(l->frame->axes, turned, rows);
  } else {
    double moment[3];
    baum_i_cross(l->force[1], axis, turned);
    baum_i_cross(l->point, turned, rows + 3);
    baum_i_cross(l->moment[1], axis, moment);
    for (int i = 0; i < 3; i++) {
      rows[3 + i] += moment[i];
    }
  }
  for (int i = 0; i < 6; i++) {
    square[6 * i + 3 + j] = rows[i];
  }
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  if (blocks->force_q) {
    const load l = load_at(element, point);
    double square[36] = {0.0};
    for (int j = 0; j < 3; j++) {
      set_column(&l, j, square);
    }
    baum_i_columns_pack_force(point->mechanism, element, BAUM_I_SPACE, square, blocks->force_q);
  }
  return BAUM_OK;
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(spatial_load, "spatial load", fields), .check = check,
                 .parameter_count = PARAMETER_COUNT},
  .spatial = true,
  .lower = lower,
  .force = force,
  .potential = potential,
  .linearize = linearize,
  .power = power,
};

BAUM_I_DEFINE(force, spatial_load, type)
