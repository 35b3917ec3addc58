/* SPDX-License-Identifier: BSD-3-Clause */
/* Point on a curve, planar. The user's function F(x, y) is zero on a curve that is fixed in body_a,
 * and the point of body_b stays on this curve. The point-follower and the cam of Nikravesh 1988,
 * chapter 4, and Haug 1989, chapter 3, are similar. They describe the curve by a parameter, which
 * needs an additional equation. Here the equation of the curve is implicit. Let d be the vector
 * from the marker on body_a to the marker on body_b:
 *
 *   (x, y) = A_a^T d, the distances of axis_row.h along (1, 0) and (0, 1)
 *   Phi    = F(x, y)                     (1 row)
 *
 * J, gamma and the second derivatives follow from the chain rule of composed_row.c. Only gamma_q
 * needs the third derivatives of F. They are computed by differences of the second derivatives.
 */
#include <string.h>

#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/general/composed_row.h"
#include "mechanism/planar/axis_row.h"

/* Entries of the result of the curve function. */
enum { F, F_X, F_Y, F_XX, F_XY, F_YY, CURVE_SIZE };

static const double axes[2][2] = {{1.0, 0.0}, {0.0, 1.0}};

/* ---- the curve ---- */

static baum_i_user_function function(const baum_i_joint *joint)
{
  const baum_planar_curve_def *def = joint->element.def;
  return (baum_i_user_function){&joint->element, "curve", CURVE_SIZE, 0, def->user};
}

/* Return the arguments with which the curve function is called and differentiated. They are in the
 * axes of the curve. The result contains pointers to `values`, which are q, v and scale. */
static baum_i_local place_at(baum_i_point *point, const double values[6])
{
  return (baum_i_local){.point = point,
                        .ql = 2,
                        .nl = 2,
                        .t = point->t,
                        .q = values,
                        .v = values + 2,
                        .scale = values + 4,
                        .free = point->scratch};
}

static baum_status curve_at(const baum_i_joint *joint, const baum_i_local *at, double out[6])
{
  const baum_planar_curve_def *def = joint->element.def;
  baum_i_user_function f = function(joint);
  baum_i_begin_call(&f, at, out);
  return baum_i_judge(&f, at, def->curve(at->q, out, def->user), out);
}

/* ---- the row ---- */

/* A joint, together with the state (point) in which it is evaluated. */
typedef struct state {
  baum_i_planar_pair pair;
  baum_i_inner x[2];
  double values[6]; /* arguments of place_at(): x and y, two zeros, and two scales */
  baum_i_outer g;
} state;

static void set_places(const baum_i_joint *joint, const baum_i_point *point, state *s)
{
  static const int bodies[2] = {0, 1};
  s->pair = baum_i_planar_pair_at(joint, point);
  for (int i = 0; i < 2; i++) {
    baum_i_axis_coordinate(&s->pair, axes[i], &s->x[i].c);
    baum_i_composed_place(&s->x[i], BAUM_I_PLANE, BAUM_I_PLANE, bodies);
    s->values[i] = s->x[i].c.value;
    s->values[2 + i] = 0.0;
    s->values[4 + i] = point->mechanism->length;
  }
}

static baum_status state_at(const baum_i_joint *joint, baum_i_point *point, state *s)
{
  set_places(joint, point, s);
  baum_i_local at = place_at(point, s->values);
  double f[CURVE_SIZE];
  BAUM_I_TRY(curve_at(joint, &at, f));
  s->g =
    (baum_i_outer){.value = f[F], .first = {f[F_X], f[F_Y]}, .second = {f[F_XX], f[F_XY], f[F_YY]}};
  return BAUM_OK;
}

static baum_status evaluate(const baum_i_joint *joint, baum_i_point *point, const baum_i_rows *out)
{
  state s;
  BAUM_I_TRY(state_at(joint, point, &s));
  baum_i_composed_put_row(joint, point, BAUM_I_PLANE, s.x, &s.g, out);
  return BAUM_OK;
}

/* ---- second derivatives ---- */

static baum_status second_field(const void *joint, const baum_i_local *at, double *out)
{
  double f[CURVE_SIZE];
  BAUM_I_TRY(curve_at(joint, at, f));
  memcpy(out, f + F_XX, 3 * sizeof *out);
  return BAUM_OK;
}

static baum_status set_third(const baum_i_joint *joint, baum_i_point *point, state *s)
{
  baum_i_local at = place_at(point, s->values);
  baum_i_field field = {.evaluate = second_field, .context = joint, .size = 3};
  double by_column[6]; /* F_xxx, F_xxy, F_xyx, F_xyy, F_yyx, F_yyy */
  BAUM_I_TRY(baum_i_difference_columns(&field, BAUM_I_VARIABLE_Q, &at, by_column));
  s->g.third[0] = by_column[0];
  s->g.third[1] = by_column[1];
  s->g.third[2] = by_column[3];
  s->g.third[3] = by_column[5];
  return BAUM_OK;
}

/* w has nv entries, or is NULL. */
static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  state s;
  BAUM_I_TRY(state_at(joint, point, &s));
  if (blocks->gamma_q && (s.x[0].c.rate != 0.0 || s.x[1].c.rate != 0.0)) {
    BAUM_I_TRY(set_third(joint, point, &s));
  }
  double w_six[BAUM_I_PLANAR_COLUMNS];
  baum_i_columns_gather(point, &joint->span, BAUM_I_PLANE, w, w_six);
  for (int i = 0; i < 2; i++) {
    baum_i_axis_linearize(&s.pair, axes[i], w_six, 1.0, &s.x[i].blocks);
  }
  baum_i_composed_put_blocks(joint, point, BAUM_I_PLANE, s.x, &s.g, w_six, lambda, blocks);
  return BAUM_OK;
}

/* ---- checks of the user's curve ---- */

static baum_status curve_field(const void *joint, const baum_i_local *at, double *out)
{
  return curve_at(joint, at, out);
}

static baum_status check_derivatives(const void *element, baum_i_point *point)
{
  static const baum_i_derived pairs[2][3] = {/* derivatives with respect to x and to y */
                                             {{F_X, F}, {F_XX, F_X}, {F_XY, F_Y}},
                                             {{F_Y, F}, {F_XY, F_X}, {F_YY, F_Y}}};
  const baum_i_joint *joint = element;
  state s;
  set_places(joint, point, &s);
  baum_i_local at = place_at(point, s.values);
  baum_i_user_function curve = function(joint);
  baum_i_field field = {.evaluate = curve_field, .context = joint, .size = CURVE_SIZE};
  for (int by = 0; by < 2; by++) {
    double direction[2];
    baum_i_ray ray = baum_i_column_ray(&at, BAUM_I_VARIABLE_Q, by, direction);
    BAUM_I_TRY(baum_i_compare_entries(&curve, "curve", &field, pairs[by], 3, &ray, &at));
  }
  return BAUM_OK;
}

static const baum_i_joint_type type = {
  .definition = {BAUM_I_PLANAR_DEFINITION(planar_curve, "planar point on a curve",
                                          baum_i_planar_check_axis, 0,
                                          BAUM_I_PLANAR_FIELDS(baum_planar_curve_def),
                                          BAUM_I_FIELD(baum_planar_curve_def, curve, FUNCTION),
                                          BAUM_I_FIELD(baum_planar_curve_def, user, USER)),
                 .check_derivatives = check_derivatives},
  BAUM_I_PLANAR_MEMBERS(1),
  .evaluate = baum_i_evaluate_each,
  .evaluate_one = evaluate,
  .lower = baum_i_planar_lower_points,
  .linearize = linearize,
};

BAUM_I_DEFINE(joint, planar_curve, type)
