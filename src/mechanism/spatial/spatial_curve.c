/* SPDX-License-Identifier: BSD-3-Clause */
/* Point on a curve in space. The user's functions F(x, y, z) and G(x, y, z) are zero on a curve
 * that is fixed in body_a, and the point of body_b stays on this curve. Let e be the vector from
 * the point of body_a to the point of body_b. The coordinates x_i are products (spatial_rows.h) of
 * e and the axes of body_a:
 *
 *   x_i = u_i . e,   Phi = (F(x), G(x))                     (2 rows)
 *
 * The chain rule for one row F is that of composed_row.c, with three coordinates. With
 * g_i = (x_i)_q, r_i = x_i', and gamma_i defined by g_i a = x_i'' + gamma_i:
 *
 *   J       = F_i g_i
 *   gamma   = F_i gamma_i - F_ij r_i r_j
 *   (J w)_q = F_i (g_i w)_q + F_ij (g_j w) g_i
 *   (J^T l)_q = l (F_i (g_i^T)_q + F_ij g_i^T g_j)
 *   gamma_v = F_i (gamma_i)_v - 2 F_ij r_j g_i
 *   gamma_q = F_i (gamma_i)_q + (F_ij gamma_j - F_ijk r_j r_k) g_i - 2 F_ij r_j (r_i)_q
 *
 * F_ijk r_k, the derivative of F_ij along r, is computed by differences.
 */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/spatial/spatial_rows.h"

enum { ROWS = 2, COLUMNS = BAUM_I_PAIR_COLUMNS };

/* Entries of the result of the curve function, for F and then for G. */
enum { VALUE, FIRST, SECOND = 4, ENTRIES = 10, CURVE_SIZE = ROWS * ENTRIES };

/* BEND[i][j] is the index of F_ij in the result of the curve function. */
static const int BEND[3][3] = {{4, 5, 6}, {5, 7, 8}, {6, 8, 9}};

static const baum_i_def_field fields[] = {
  BAUM_I_SPATIAL_FIELDS(baum_spatial_curve_def),
  BAUM_I_FIELD(baum_spatial_curve_def, curve, FUNCTION),
  BAUM_I_FIELD(baum_spatial_curve_def, user, USER),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_spatial_curve_def *def = given;
  BAUM_I_TRY(baum_i_spatial_check_turning(mechanism, def->body_a, label, "body_a"));
  return baum_i_spatial_check_head(mechanism, def, label, false);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  return baum_i_spatial_points(mechanism, &joint->element, parameters);
}

/* ---- the curve ---- */

static baum_i_user_function function(const baum_i_joint *joint)
{
  const baum_spatial_curve_def *def = joint->element.def;
  return (baum_i_user_function){&joint->element, "curve", CURVE_SIZE, 0, def->user};
}

/* Computes F, G and their derivatives. `at` contains the coordinates x. */
static baum_status curve_at(const void *joint, const baum_i_local *at, double *out)
{
  const baum_i_joint *own = joint;
  const baum_spatial_curve_def *def = own->element.def;
  baum_i_user_function f = function(own);
  baum_i_begin_call(&f, at, out);
  return baum_i_judge(&f, at, def->curve(at->q, out, def->user), out);
}

/* ---- one joint ---- */

/* A joint, together with the state (point) in which it is evaluated. */
typedef struct state {
  baum_i_spatial_pair pair;
  baum_i_coordinate x[3];
  /* arguments of the curve function and of its differences */
  double place[3], rate[3], scale[3];
  double f[ROWS][ENTRIES];
} state;

static const baum_i_spatial_row COORDINATES[3] = {
  {BAUM_I_X_A, BAUM_I_APART}, {BAUM_I_Y_A, BAUM_I_APART}, {BAUM_I_Z_A, BAUM_I_APART}};

static baum_i_local place_at(baum_i_point *point, const state *s)
{
  return (baum_i_local){.point = point,
                        .ql = 3,
                        .nl = 3,
                        .t = point->t,
                        .q = s->place,
                        .v = s->rate,
                        .scale = s->scale,
                        .free = point->scratch};
}

static void set_places(const baum_i_joint *joint, const baum_i_point *point, state *s)
{
  const double *numbers = point->parameters + joint->element.parameter;
  s->pair = baum_i_spatial_pair_at(&joint->span, numbers, false, point);
  for (int i = 0; i < 9; i++) { /* the columns of the rotation matrix are the axes of body_a */
    s->pair.axes[0][i] = s->pair.frame[0]->axes[3 * (i % 3) + i / 3];
  }
  for (int i = 0; i < 3; i++) {
    baum_i_spatial_row_at(&s->pair, COORDINATES[i], &s->x[i]);
    s->place[i] = s->x[i].value;
    s->rate[i] = s->x[i].rate;
    s->scale[i] = point->mechanism->length;
  }
}

static baum_status state_at(const baum_i_joint *joint, baum_i_point *point, state *s)
{
  set_places(joint, point, s);
  const baum_i_local at = place_at(point, s);
  return curve_at(joint, &at, s->f[0]);
}

/* Returns the sum of F_ij y_j over j. */
static double bend(const double f[ENTRIES], int i, const double y[3])
{
  return f[BEND[i][0]] * y[0] + f[BEND[i][1]] * y[1] + f[BEND[i][2]] * y[2];
}

static void row_of(const state *s, int row, double twelve[COLUMNS])
{
  memset(twelve, 0, COLUMNS * sizeof *twelve);
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < COLUMNS; k++) {
      twelve[k] += s->f[row][FIRST + i] * s->x[i].gradient[k];
    }
  }
}

static baum_status evaluate(const baum_i_joint *joint, baum_i_point *point, const baum_i_rows *out)
{
  state s;
  BAUM_I_TRY(state_at(joint, point, &s));
  double rows[ROWS * COLUMNS];
  for (int row = 0; row < ROWS; row++) {
    const double *f = s.f[row];
    double gamma = 0.0;
    for (int i = 0; i < 3; i++) {
      gamma += f[FIRST + i] * s.x[i].gamma - s.rate[i] * bend(f, i, s.rate);
    }
    if (out->phi) {
      out->phi[joint->row + row] = f[VALUE];
    }
    if (out->gamma) {
      out->gamma[joint->row + row] = gamma;
    }
    row_of(&s, row, rows + (ptrdiff_t)row * COLUMNS);
  }
  if (out->jacobian) {
    baum_i_columns_pack_any(point->mechanism, &joint->span, BAUM_I_SPACE, ROWS, rows,
                            out->jacobian + joint->jacobian);
  }
  return BAUM_OK;
}

/* ---- second derivatives ---- */

/* Second derivatives of a row over the twelve columns of both bodies. */
typedef struct second_row {
  double *jw_q, *gamma_q, *gamma_v;
  double *jtl_q; /* summed over the rows */
} second_row;

/* Adds the contribution of the coordinate x_i to the second derivatives of a row. `along` has the
 * entries F_ijk r_k in the places of F_ij. `w` has twelve entries, and w_x contains the products
 * g_j w. */
static void add_coordinate(const state *s, int row, int i, const double *along, const double *w,
                           const double w_x[3], double lambda, const second_row *out)
{
  const double *f = s->f[row];
  const double *g = s->x[i].gradient;
  const double gammas[3] = {s->x[0].gamma, s->x[1].gamma, s->x[2].gamma};
  const double first = f[FIRST + i];
  const double rate = bend(f, i, s->rate);
  const double change = bend(f, i, gammas) - bend(along, i, s->rate);
  const double bend_w = bend(f, i, w_x);
  baum_i_spatial_second second;
  baum_i_spatial_second_of(&s->pair, COORDINATES[i], &second);
  baum_i_spatial_add_jw_q(&second, w, first, out->jw_q);
  for (int k = 0; k < COLUMNS; k++) {
    out->jw_q[k] += bend_w * g[k];
    out->gamma_v[k] += first * second.gamma_v[k] - 2.0 * rate * g[k];
    out->gamma_q[k] += first * second.gamma_q[k] + change * g[k] - 2.0 * rate * second.rate_q[k];
    const double g_k[3] = {s->x[0].gradient[k], s->x[1].gradient[k], s->x[2].gradient[k]};
    const double across = bend(f, i, g_k);
    for (int j = 0; j < COLUMNS; j++) {
      out->jtl_q[COLUMNS * j + k] +=
        lambda * (first * second.columns_q[COLUMNS * j + k] + across * g[j]);
    }
  }
}

/* Computes the time derivatives of F and G, and of their first and second derivatives, for the
 * present rates of x. */
static baum_status set_along(const baum_i_joint *joint, baum_i_point *point, const state *s,
                             double along[CURVE_SIZE])
{
  const baum_i_local at = place_at(point, s);
  const baum_i_field field = {.evaluate = curve_at, .context = joint, .size = CURVE_SIZE};
  const baum_i_ray ray = {.dq = s->rate, .rate = baum_i_local_rate(&at)};
  memset(along, 0, CURVE_SIZE * sizeof *along);
  return ray.rate > 0.0 ? baum_i_difference_first(&field, &ray, &at, along) : BAUM_OK;
}

/* w has nv entries, or is NULL. */
static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  state s;
  BAUM_I_TRY(state_at(joint, point, &s));
  double along[CURVE_SIZE] = {0.0};
  if (blocks->gamma_q) {
    BAUM_I_TRY(set_along(joint, point, &s, along));
  }
  double jw_q[ROWS * COLUMNS] = {0.0}, gamma_q[ROWS * COLUMNS] = {0.0};
  double gamma_v[ROWS * COLUMNS] = {0.0}, jtl_q[COLUMNS * COLUMNS] = {0.0};
  double w_wide[COLUMNS], w_x[3] = {0.0};
  baum_i_columns_gather(point, &joint->span, BAUM_I_SPACE, w, w_wide);
  for (int k = 0; k < 3 * COLUMNS; k++) {
    w_x[k / COLUMNS] += s.x[k / COLUMNS].gradient[k % COLUMNS] * w_wide[k % COLUMNS];
  }
  for (int k = 0; k < 3 * ROWS; k++) {
    const int row = k / 3;
    const ptrdiff_t at = (ptrdiff_t)row * COLUMNS;
    const second_row out = {jw_q + at, gamma_q + at, gamma_v + at, jtl_q};
    add_coordinate(&s, row, k % 3, along + (ptrdiff_t)row * ENTRIES, w_wide, w_x,
                   lambda ? lambda[joint->row + row] : 0.0, &out);
  }
  const baum_i_joint_blocks wide = {jw_q, jtl_q, gamma_q, gamma_v, NULL};
  baum_i_columns_pack_blocks(point->mechanism, joint, BAUM_I_SPACE, &wide, blocks);
  return BAUM_OK;
}

/* ---- checks of the user's curve ---- */

static baum_status check_derivatives(const void *element, baum_i_point *point)
{
  const baum_i_joint *joint = element;
  state s;
  set_places(joint, point, &s);
  const baum_i_local at = place_at(point, &s);
  baum_i_user_function curve = function(joint);
  const baum_i_field field = {.evaluate = curve_at, .context = joint, .size = CURVE_SIZE};
  for (int by = 0; by < 3; by++) {
    baum_i_derived pairs[ROWS * 4];
    for (int k = 0; k < ROWS * 4; k++) {
      const int first = ENTRIES * (k / 4);
      const int i = k % 4 - 1; /* -1 for the derivative of F or G itself */
      pairs[k] = i < 0 ? (baum_i_derived){first + FIRST + by, first + VALUE}
                       : (baum_i_derived){first + BEND[i][by], first + FIRST + i};
    }
    double direction[3];
    const baum_i_ray ray = baum_i_column_ray(&at, BAUM_I_VARIABLE_Q, by, direction);
    BAUM_I_TRY(baum_i_compare_entries(&curve, "curve", &field, pairs, ROWS * 4, &ray, &at));
  }
  return BAUM_OK;
}

/* ---- type ---- */

static void place(const baum_i_joint *joint, const baum_i_point *point, double at[3])
{
  const double *numbers = point->parameters + joint->element.parameter;
  const baum_i_spatial_pair pair = baum_i_spatial_pair_at(&joint->span, numbers, false, point);
  baum_i_spatial_place_of(&pair, at);
}

static void force_on_b(const baum_i_joint *joint, const baum_i_point *point, const double *lambda,
                       double six[BAUM_I_SPACE])
{
  /* The curve function has already succeeded at this state. If it fails now, the force is NaN. */
  state s;
  if (state_at(joint, baum_i_mutable(point), &s) != BAUM_OK) {
    s.f[0][FIRST] = s.f[1][FIRST] = (double)NAN;
  }
  for (int row = 0; row < ROWS; row++) {
    double twelve[COLUMNS];
    row_of(&s, row, twelve);
    for (int j = 0; j < BAUM_I_SPACE; j++) {
      six[j] -= lambda[row] * twelve[6 + j];
    }
  }
}

static const baum_i_joint_type type = {
  .definition = {BAUM_I_DEFINITION(spatial_curve, "spatial point on a curve", fields),
                 .check = check, .parameter_count = BAUM_I_SPATIAL_AXES_A,
                 .check_derivatives = check_derivatives},
  .width = BAUM_I_SPACE,
  .scleronomic = true,
  .row_count = ROWS,
  .lower = lower,
  .extent = baum_i_spatial_extent,
  .evaluate = baum_i_evaluate_each,
  .evaluate_one = evaluate,
  .linearize = linearize,
  .place = place,
  .force_on_b = force_on_b,
};

BAUM_I_DEFINE(joint, spatial_curve, type)
