/* SPDX-License-Identifier: BSD-3-Clause */
/* Knife edge in space. A point of body_a, with the arm p, moves relative to body_b, but not along
 * the unit vector e, which is fixed in body_a. The row is of velocity level. Let d be the vector
 * from the origin of body_b to the point. A motion z consists of the velocities V of both origins
 * and of the angular velocities W of both bodies. The row of a motion is
 *
 *   J z = e . (V_a + W_a x p - V_b - W_b x d) = e . u + W_a . m - W_b . (d x e),   nu = 0
 *
 * with u = V_a - V_b and m = p x e. Let D_y be the derivative along a motion y. For this
 * derivative, the V of a motion z are constant in ground axes, and its W are constant in body axes.
 * W_a . m is constant, because both vectors are fixed in body_a:
 *
 *   D_y e = W_ya x e,   D_y d = u_y + W_ya x p,   D_y W_b = W_yb x W_b
 *   D_y (J z) = u . D_y e - D_y W_b . (d x e) - W_b . (D_y d x e + d x D_y e)
 *   (J w)_q . y = D_y (J w),   gamma = -D_v (J v),   gamma_v . y = -D_y (J v) - D_v (J y)
 *   gamma_q . y = -D_y D_v (J v)
 *
 * In D_v (J v), the vectors e' = W_a x e and W_a x p are fixed in body_a, too. Hence
 *
 *   D_y D_v (J v) = u . D_y e' - D_y W_b . (d' x e + d x e')
 *                   - W_b . (D_y d' x e + d' x D_y e + D_y d x e' + d x D_y e')
 */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/spatial/spatial_motion.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

/* Parameters: the point and e, in the axes of body_a. */
enum { POINT = 0, AXIS = 3, PARAMETER_COUNT = 6 };

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_spatial_knife_edge_def, body_a, BODY),
  BAUM_I_FIELD(baum_spatial_knife_edge_def, body_b, CARRIER),
  BAUM_I_OPTIONAL(baum_spatial_knife_edge_def, point, POINT, "m"),
  BAUM_I_OPTIONAL(baum_spatial_knife_edge_def, point_a, POINT, "m"),
  BAUM_I_NUMBERS(baum_spatial_knife_edge_def, axis, DIRECTION, "-", 0.0, 0.0, 1.0),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_spatial_knife_edge_def *def = given;
  BAUM_I_TRY(baum_i_spatial_check_pair(mechanism, def->body_a, def->body_b, label));
  bool in_ground = baum_i_spatial_is_given(def->point);
  if (in_ground != baum_i_spatial_is_given(def->point_a)) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s; give either point or point_a", label,
                     in_ground ? "point and point_a are both given" : "no point is given");
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  const baum_spatial_knife_edge_def *def = joint->element.def;
  const baum_i_spatial_frame a = baum_i_spatial_design_frame(mechanism, joint->span.bodies[0]);
  double *axis = parameters + AXIS;
  if (baum_i_spatial_is_given(def->point)) {
    double apart[3];
    for (int i = 0; i < 3; i++) {
      apart[i] = def->point[i] - a.r[i];
    }
    baum_i_turn_back(a.axes, apart, parameters + POINT);
    double unit[3] = {def->axis[0], def->axis[1], def->axis[2]};
    baum_i_normalize3(unit);
    baum_i_turn_back(a.axes, unit, axis);
  } else {
    memcpy(parameters + POINT, def->point_a, sizeof def->point_a);
    memcpy(axis, def->axis, sizeof def->axis);
  }
  baum_i_normalize3(axis);
  return BAUM_OK;
}

static void extent(const baum_mechanism *mechanism, const baum_i_joint *joint, baum_i_box *box)
{
  const baum_spatial_knife_edge_def *def = joint->element.def;
  double at[3];
  if (baum_i_spatial_is_given(def->point)) {
    memcpy(at, def->point, sizeof at);
  } else {
    const baum_i_spatial_frame a = baum_i_spatial_design_frame(mechanism, joint->span.bodies[0]);
    baum_i_turn(a.axes, def->point_a, at);
    baum_i_add_scaled3(1.0, a.r, at);
  }
  baum_i_box_include(box, at[0], at[1], at[2]);
}

/* ---- one joint ---- */

typedef struct edge {
  const baum_i_spatial_frame *a, *b;
  double e[3], p[3], d[3];
} edge;

static edge edge_at(const baum_i_joint *joint, const baum_i_point *point)
{
  const double *numbers = point->parameters + joint->element.parameter;
  edge x = {.a = &point->spatial[joint->span.bodies[0]],
            .b = &point->spatial[joint->span.bodies[1]]};
  baum_i_turn(x.a->axes, numbers + AXIS, x.e);
  baum_i_turn(x.a->axes, numbers + POINT, x.p);
  for (int i = 0; i < 3; i++) {
    x.d[i] = x.a->r[i] + x.p[i] - x.b->r[i];
  }
  return x;
}

/* Computes u. */
static void relative_velocity(const baum_i_spatial_motion *z, double out[3])
{
  for (int i = 0; i < 3; i++) {
    out[i] = z->v[0][i] - z->v[1][i];
  }
}

/* Computes D_y d. */
static void arm_along(const edge *x, const baum_i_spatial_motion *y, double out[3])
{
  double u[3];
  relative_velocity(y, u);
  baum_i_cross(y->w[0], x->p, out);
  baum_i_add_scaled3(1.0, u, out);
}

/* Returns the product x . (y x z). */
static double mixed_product(const double x[3], const double y[3], const double z[3])
{
  double product[3];
  baum_i_cross(y, z, product);
  return baum_i_dot3(x, product);
}

/* Returns D_y (J z). */
static double row_along(const edge *x, const baum_i_spatial_motion *z,
                        const baum_i_spatial_motion *y)
{
  double u[3], e_y[3], d_y[3], w_y[3];
  relative_velocity(z, u);
  baum_i_cross(y->w[0], x->e, e_y);
  baum_i_cross(y->w[1], z->w[1], w_y);
  arm_along(x, y, d_y);
  return baum_i_dot3(u, e_y) - mixed_product(w_y, x->d, x->e) - mixed_product(z->w[1], d_y, x->e) -
         mixed_product(z->w[1], x->d, e_y);
}

/* Returns D_y D_v (J v). */
static double bend_along(const edge *x, const baum_i_spatial_motion *v,
                         const baum_i_spatial_motion *y)
{
  double u[3], e_v[3], e_y[3], e_vy[3], d_v[3], d_y[3], d_vy[3], turned[3], w_y[3];
  relative_velocity(v, u);
  baum_i_cross(v->w[0], x->e, e_v);
  baum_i_cross(y->w[0], x->e, e_y);
  baum_i_cross(y->w[0], e_v, e_vy);
  baum_i_cross(v->w[0], x->p, turned);
  baum_i_cross(y->w[0], turned, d_vy);
  arm_along(x, v, d_v);
  arm_along(x, y, d_y);
  baum_i_cross(y->w[1], v->w[1], w_y);
  return baum_i_dot3(u, e_vy) - mixed_product(w_y, d_v, x->e) - mixed_product(w_y, x->d, e_v) -
         mixed_product(v->w[1], d_vy, x->e) - mixed_product(v->w[1], d_v, e_y) -
         mixed_product(v->w[1], d_y, e_v) - mixed_product(v->w[1], x->d, e_vy);
}

static void row_of(const edge *x, double twelve[COLUMNS])
{
  double moment[3];
  for (int i = 0; i < 3; i++) {
    twelve[i] = x->e[i];
    twelve[6 + i] = -x->e[i];
  }
  baum_i_cross(x->p, x->e, moment);
  baum_i_turn_back(x->a->axes, moment, twelve + 3);
  baum_i_cross(x->e, x->d, moment);
  baum_i_turn_back(x->b->axes, moment, twelve + 9);
}

/* ---- type ---- */

static baum_status evaluate(const baum_i_joint *joint, baum_i_point *point, const baum_i_rows *out)
{
  const edge x = edge_at(joint, point);
  if (out->phi) {
    out->phi[joint->row] = 0.0;
  }
  if (out->gamma) {
    const baum_i_spatial_motion v = baum_i_spatial_motion_at(x.a, x.b);
    out->gamma[joint->row] = -row_along(&x, &v, &v);
  }
  if (out->jacobian) {
    double row[COLUMNS];
    row_of(&x, row);
    baum_i_columns_pack_any(point->mechanism, &joint->span, BAUM_I_SPACE, 1, row,
                            out->jacobian + joint->jacobian);
  }
  return BAUM_OK;
}

/* Sets column j of (J^T lambda)_q. The moment on body_a is constant in body axes. */
static void set_force_column(const edge *x, double lambda, const baum_i_spatial_motion *y, int j,
                             double *square)
{
  double e_y[3], d_y[3], moment[3], turned[3], change[3], body[3];
  baum_i_cross(y->w[0], x->e, e_y);
  arm_along(x, y, d_y);
  baum_i_cross(x->e, d_y, change);
  baum_i_cross(e_y, x->d, turned);
  baum_i_add_scaled3(1.0, turned, change);
  baum_i_cross(x->e, x->d, moment);
  baum_i_cross(y->w[1], moment, turned);
  baum_i_add_scaled3(-1.0, turned, change);
  baum_i_turn_back(x->b->axes, change, body);
  for (int i = 0; i < 3; i++) {
    square[i * COLUMNS + j] = lambda * e_y[i];
    square[(6 + i) * COLUMNS + j] = -lambda * e_y[i];
    square[(9 + i) * COLUMNS + j] = lambda * body[i];
  }
}

static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  const edge x = edge_at(joint, point);
  double twelve[COLUMNS], jw_q[COLUMNS], gamma_q[COLUMNS], gamma_v[COLUMNS];
  double jtl_q[COLUMNS * COLUMNS] = {0.0};
  baum_i_columns_gather(point, &joint->span, BAUM_I_SPACE, w, twelve);
  const baum_i_spatial_motion along = baum_i_spatial_motion_of(x.a, x.b, twelve);
  const baum_i_spatial_motion v = baum_i_spatial_motion_at(x.a, x.b);
  for (int j = 0; j < COLUMNS; j++) {
    const baum_i_spatial_motion y = baum_i_spatial_unit_motion(x.a, x.b, j);
    jw_q[j] = row_along(&x, &along, &y);
    gamma_v[j] = -row_along(&x, &v, &y) - row_along(&x, &y, &v);
    gamma_q[j] = -bend_along(&x, &v, &y);
    set_force_column(&x, lambda ? lambda[joint->row] : 0.0, &y, j, jtl_q);
  }
  const baum_i_joint_blocks wide = {jw_q, jtl_q, gamma_q, gamma_v, NULL};
  baum_i_columns_pack_blocks(point->mechanism, joint, BAUM_I_SPACE, &wide, blocks);
  return BAUM_OK;
}

static void place(const baum_i_joint *joint, const baum_i_point *point, double at[3])
{
  const edge x = edge_at(joint, point);
  for (int i = 0; i < 3; i++) {
    at[i] = x.a->r[i] + x.p[i];
  }
}

static void force_on_b(const baum_i_joint *joint, const baum_i_point *point, const double *lambda,
                       double six[BAUM_I_SPACE])
{
  const edge x = edge_at(joint, point);
  double twelve[COLUMNS];
  row_of(&x, twelve);
  for (int j = 0; j < BAUM_I_SPACE; j++) {
    six[j] -= lambda[0] * twelve[6 + j];
  }
}

static const baum_i_joint_type type = {
  .definition = {BAUM_I_DEFINITION(spatial_knife_edge, "spatial knife edge", fields),
                 .check = check, .parameter_count = PARAMETER_COUNT},
  .width = BAUM_I_SPACE,
  .scleronomic = true,
  .row_count = 1,
  .velocity_row_count = 1,
  .lower = lower,
  .extent = extent,
  .evaluate = baum_i_evaluate_each,
  .evaluate_one = evaluate,
  .linearize = linearize,
  .place = place,
  .force_on_b = force_on_b,
};

BAUM_I_DEFINE(joint, spatial_knife_edge, type)
