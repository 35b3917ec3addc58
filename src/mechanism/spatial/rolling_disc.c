/* SPDX-License-Identifier: BSD-3-Clause */
/* A disc, wheel or sphere of body_b rolls without slipping on a plane of body_a. Let k be the unit
 * normal of the plane, n the unit axis of the disc, c = k . n, and s = sqrt(1 - c^2). Let R be the
 * radius of the disc, and t the radius of the rim's cross-section (0: a sharp edge, R: a sphere).
 * Seen from the centre, the contact point is at
 *
 *   rho = -(R - t) u - t k,   u = (k - c n) / s
 *
 * The vector u is the direction in the plane of the disc that is nearest to k, so -u points to the
 * lowest point of the disc. The vector p points from the origin of body_b to the centre, and d
 * points from the origin of body_a to the centre. A motion z consists of the velocities V of both
 * origins and of the angular velocities W of both bodies. In the motion z, the material points in
 * contact have the relative velocity
 *
 *   U(z) = V_b + W_b x (p + rho) - V_a - W_a x (d + rho)
 *
 * The first row is of position level, k . (d + rho) - k . s_a = 0. Here s_a is the vector from the
 * origin of body_a to a point of the plane. The J of this row is k . U. The other two rows are of
 * velocity level. They are e . U = 0 for two directions e in the plane.
 *
 * Let D_y be the derivative along a motion y. For this derivative, the V of a motion z are constant
 * in ground axes, and its W are constant in body axes:
 *
 *   D_y W = W_y x W for each body,  D_y k = W_ya x k,  D_y e = W_ya x e,  D_y p = W_yb x p
 *   D_y d = V_yb + W_yb x p - V_ya,  D_y rho = W_ya x rho + G(r),  r = (W_yb - W_ya) x n
 *
 * where G(r) is the derivative of rho along a change r of n at constant k. The term W_ya x rho is
 * there because rho rotates with k and n if both rotate together. Then
 *
 *   (J w)_q . y = D_y (e . U(w)),   gamma = -D_v (e . U(v))
 *   gamma_v . y = -D_y (e . U(v)) - D_v (e . U(y)),   gamma_q . y = -D_y D_v (e . U(v))
 *
 * gamma_q contains D_y G(r) = W_ya x G(r) + G(D_y r - W_ya x r) + H(r_y, r). Here H(r_y, r) is the
 * second derivative of rho along the changes r_y and r of n, and r_y is the change that the motion
 * y causes.
 */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/spatial/spatial_motion.h"

enum { ROWS = 3, COLUMNS = BAUM_I_PAIR_COLUMNS };

/* Parameters: k, e_1, e_2 and the offset k . s_a on body_a; centre and n on body_b; R - t and t. */
enum { VECTORS = 0, OFFSET = 9, CENTRE = 10, AXIS = 13, RADIUS = 16, RIM = 17, PARAMETER_COUNT };

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_spatial_rolling_disc_def, body_a, CARRIER),
  BAUM_I_FIELD(baum_spatial_rolling_disc_def, body_b, BODY),
  BAUM_I_NUMBERS(baum_spatial_rolling_disc_def, point_a, FINITE, "m", 0.0),
  BAUM_I_NUMBERS(baum_spatial_rolling_disc_def, normal, DIRECTION, "-", 0.0, 1.0, 0.0),
  BAUM_I_NUMBERS(baum_spatial_rolling_disc_def, centre, FINITE, "m", 0.0),
  BAUM_I_NUMBERS(baum_spatial_rolling_disc_def, axis_b, DIRECTION, "-", 0.0, 0.0, 1.0),
  BAUM_I_NUMBERS(baum_spatial_rolling_disc_def, radius, POSITIVE, "m", 0.0),
  BAUM_I_NUMBERS(baum_spatial_rolling_disc_def, rim_radius, NOT_NEGATIVE, "m", 0.0),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_spatial_rolling_disc_def *def = given;
  BAUM_I_TRY(baum_i_spatial_check_pair(mechanism, def->body_a, def->body_b, label));
  if (def->rim_radius > def->radius) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: rim_radius is %g m, must be at most radius, which is %g m", label,
                       def->rim_radius, def->radius);
  }
  return BAUM_OK;
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  (void)mechanism;
  const baum_spatial_rolling_disc_def *def = joint->element.def;
  double *k = parameters + VECTORS;
  memcpy(k, def->normal, sizeof def->normal);
  baum_i_normalize3(k);
  baum_i_complete_axes(k, k + 3, k + 6);
  parameters[OFFSET] = baum_i_dot3(k, def->point_a);
  memcpy(parameters + CENTRE, def->centre, sizeof def->centre);
  memcpy(parameters + AXIS, def->axis_b, sizeof def->axis_b);
  baum_i_normalize3(parameters + AXIS);
  parameters[RADIUS] = def->radius - def->rim_radius;
  parameters[RIM] = def->rim_radius;
  return BAUM_OK;
}

static void extent(const baum_mechanism *mechanism, const baum_i_joint *joint, baum_i_box *box)
{
  const baum_spatial_rolling_disc_def *def = joint->element.def;
  const baum_i_spatial_frame frame = baum_i_spatial_design_frame(mechanism, joint->span.bodies[1]);
  double at[3];
  baum_i_turn(frame.axes, def->centre, at);
  baum_i_add_scaled3(1.0, frame.r, at);
  for (int sign = -1; sign <= 1; sign += 2) {
    double reach = sign * def->radius;
    baum_i_box_include(box, at[0] + reach, at[1] + reach, at[2] + reach);
  }
}

/* ---- vectors ---- */

static void add_cross(double factor, const double x[3], const double y[3], double out[3])
{
  double product[3];
  baum_i_cross(x, y, product);
  baum_i_add_scaled3(factor, product, out);
}

static void subtract(const double x[3], const double y[3], double out[3])
{
  for (int i = 0; i < 3; i++) {
    out[i] = x[i] - y[i];
  }
}

/* ---- the contact ---- */

typedef struct contact {
  const baum_i_spatial_frame *a, *b;
  double e[ROWS][3]; /* k, e_1, e_2 */
  double n[3];
  double radius, rim;
  double c;       /* k . n */
  double inverse; /* 1 / s */
  double p[3], d[3], rho[3];
} contact;

/* The vectors of a contact that vary with the configuration, or the derivatives of these vectors
 * along a motion. */
typedef struct variation {
  double p[3], d[3], rho[3];
} variation;

static contact contact_at(const baum_i_joint *joint, const baum_i_point *point)
{
  const double *numbers = point->parameters + joint->element.parameter;
  contact x = {.a = &point->spatial[joint->span.bodies[0]],
               .b = &point->spatial[joint->span.bodies[1]],
               .radius = numbers[RADIUS],
               .rim = numbers[RIM]};
  for (int i = 0; i < ROWS; i++) {
    baum_i_turn(x.a->axes, numbers + VECTORS + (ptrdiff_t)3 * i, x.e[i]);
  }
  baum_i_turn(x.b->axes, numbers + AXIS, x.n);
  baum_i_turn(x.b->axes, numbers + CENTRE, x.p);
  subtract(x.b->r, x.a->r, x.d);
  baum_i_add_scaled3(1.0, x.p, x.d);
  x.c = baum_i_dot3(x.e[0], x.n);
  x.inverse = x.radius > 0.0 ? 1.0 / sqrt(1.0 - x.c * x.c) : 0.0;
  for (int i = 0; i < 3; i++) {
    x.rho[i] = -x.radius * x.inverse * (x.e[0][i] - x.c * x.n[i]) - x.rim * x.e[0][i];
  }
  return x;
}

/* Adds G(r), which the top of this file defines. */
static void add_first(const contact *x, const double r[3], double out[3])
{
  double kr = baum_i_dot3(x->e[0], r);
  double i1 = x->inverse;
  double bend = x->c * kr * i1 * i1 * i1;
  for (int i = 0; i < 3; i++) {
    double normal = x->e[0][i] - x->c * x->n[i];
    out[i] -= x->radius * (bend * normal - i1 * (kr * x->n[i] + x->c * r[i]));
  }
}

/* Adds H(r, y), which the top of this file defines. */
static void add_second(const contact *x, const double r[3], const double y[3], double out[3])
{
  double kr = baum_i_dot3(x->e[0], r);
  double ky = baum_i_dot3(x->e[0], y);
  double i1 = x->inverse;
  double i3 = i1 * i1 * i1;
  double bend = kr * ky * i3 * (1.0 + 3.0 * x->c * x->c * i1 * i1);
  for (int i = 0; i < 3; i++) {
    double normal = x->e[0][i] - x->c * x->n[i];
    double by_r = kr * x->n[i] + x->c * r[i];
    double by_y = ky * x->n[i] + x->c * y[i];
    out[i] -= x->radius *
              (bend * normal - i1 * (kr * y[i] + ky * r[i]) - x->c * i3 * (ky * by_r + kr * by_y));
  }
}

/* Computes the change r of n relative to body_a that the motion y causes. */
static void relative_change(const contact *x, const baum_i_spatial_motion *y, double r[3])
{
  double relative[3];
  subtract(y->w[1], y->w[0], relative);
  baum_i_cross(relative, x->n, r);
}

static variation derivative_along(const contact *x, const baum_i_spatial_motion *y)
{
  variation out = {.p = {0.0}};
  double r[3];
  relative_change(x, y, r);
  add_cross(1.0, y->w[1], x->p, out.p);
  subtract(y->v[1], y->v[0], out.d);
  baum_i_add_scaled3(1.0, out.p, out.d);
  add_cross(1.0, y->w[0], x->rho, out.rho);
  add_first(x, r, out.rho);
  return out;
}

/* Returns D_y of the derivatives along a motion z, that is D_y D_z of p, d and rho. The argument dz
 * is motion_along(z, y). */
static variation second_along(const contact *x, const baum_i_spatial_motion *z,
                              const baum_i_spatial_motion *dz, const baum_i_spatial_motion *y)
{
  const variation by_y = derivative_along(x, y);
  variation out = {.p = {0.0}};
  double r[3], r_y[3], change[3] = {0.0}, dn[3], relative[3], g[3] = {0.0};
  add_cross(1.0, dz->w[1], x->p, out.p);
  add_cross(1.0, z->w[1], by_y.p, out.p);
  memcpy(out.d, out.p, sizeof out.d);
  add_cross(1.0, dz->w[0], x->rho, out.rho);
  add_cross(1.0, z->w[0], by_y.rho, out.rho);
  relative_change(x, z, r);
  relative_change(x, y, r_y);
  baum_i_cross(y->w[1], x->n, dn);
  relative_change(x, dz, change);
  subtract(z->w[1], z->w[0], relative);
  add_cross(1.0, relative, dn, change);
  add_cross(-1.0, y->w[0], r, change);
  add_first(x, r, g);
  add_cross(1.0, y->w[0], g, out.rho);
  add_first(x, change, out.rho);
  add_second(x, r_y, r, out.rho);
  return out;
}

/* Returns D_y of the motion z. In the result, the velocities V are 0, because the V of z are
 * constant. */
static baum_i_spatial_motion motion_along(const baum_i_spatial_motion *z,
                                          const baum_i_spatial_motion *y)
{
  baum_i_spatial_motion out = {.v = {{0.0}}};
  baum_i_cross(y->w[0], z->w[0], out.w[0]);
  baum_i_cross(y->w[1], z->w[1], out.w[1]);
  return out;
}

/* Adds W_b x (p + rho) - W_a x (d + rho) for the W of the motion z and the vectors in `at`. */
static void add_turning(const baum_i_spatial_motion *z, const variation *at, double out[3])
{
  add_cross(1.0, z->w[1], at->p, out);
  add_cross(1.0, z->w[1], at->rho, out);
  add_cross(-1.0, z->w[0], at->d, out);
  add_cross(-1.0, z->w[0], at->rho, out);
}

static variation present(const contact *x)
{
  variation out;
  memcpy(out.p, x->p, sizeof out.p);
  memcpy(out.d, x->d, sizeof out.d);
  memcpy(out.rho, x->rho, sizeof out.rho);
  return out;
}

/* Computes U(z). */
static void slip_of(const contact *x, const baum_i_spatial_motion *z, double out[3])
{
  const variation at = present(x);
  subtract(z->v[1], z->v[0], out);
  add_turning(z, &at, out);
}

/* Computes D_y U(z). */
static void slip_along(const contact *x, const baum_i_spatial_motion *z,
                       const baum_i_spatial_motion *y, double out[3])
{
  const variation at = present(x);
  const variation by_y = derivative_along(x, y);
  const baum_i_spatial_motion dz = motion_along(z, y);
  memset(out, 0, 3 * sizeof *out);
  add_turning(&dz, &at, out);
  add_turning(z, &by_y, out);
}

/* Computes D_y (e . U(z)) for every row, where e is k in the first row. */
static void rows_along(const contact *x, const baum_i_spatial_motion *z,
                       const baum_i_spatial_motion *y, double out[ROWS])
{
  double slip[3], change[3];
  slip_of(x, z, slip);
  slip_along(x, z, y, change);
  for (int i = 0; i < ROWS; i++) {
    double turned[3];
    baum_i_cross(y->w[0], x->e[i], turned);
    out[i] = baum_i_dot3(turned, slip) + baum_i_dot3(x->e[i], change);
  }
}

/* Computes D_y D_v (e . U(v)) for every row, where e is k in the first row. */
static void bend_along(const contact *x, const baum_i_spatial_motion *v,
                       const baum_i_spatial_motion *y, double out[ROWS])
{
  const baum_i_spatial_motion dv = motion_along(v, y);
  const variation at = derivative_along(x, v);
  const variation by_y = second_along(x, v, &dv, y);
  double slip[3], slip_y[3], change[3] = {0.0}, change_y[3] = {0.0};
  slip_of(x, v, slip);
  slip_along(x, v, y, slip_y);
  add_turning(v, &at, change);
  add_turning(&dv, &at, change_y);
  add_turning(v, &by_y, change_y);
  for (int i = 0; i < ROWS; i++) {
    double by_v[3], turned[3], both[3] = {0.0};
    baum_i_cross(v->w[0], x->e[i], by_v);
    baum_i_cross(y->w[0], x->e[i], turned);
    add_cross(1.0, dv.w[0], x->e[i], both);
    add_cross(1.0, v->w[0], turned, both);
    out[i] = baum_i_dot3(both, slip) + baum_i_dot3(by_v, slip_y) + baum_i_dot3(turned, change) +
             baum_i_dot3(x->e[i], change_y);
  }
}

/* Computes the row of J with the direction e. It equals the generalized force of a contact force e
 * on body_b and the opposite force on body_a. */
static void row_of(const contact *x, const double e[3], double twelve[COLUMNS])
{
  double arm_a[3], arm_b[3], moment[3];
  for (int i = 0; i < 3; i++) {
    arm_a[i] = x->d[i] + x->rho[i];
    arm_b[i] = x->p[i] + x->rho[i];
    twelve[i] = -e[i];
    twelve[6 + i] = e[i];
  }
  baum_i_cross(e, arm_a, moment);
  baum_i_turn_back(x->a->axes, moment, twelve + 3);
  baum_i_cross(arm_b, e, moment);
  baum_i_turn_back(x->b->axes, moment, twelve + 9);
}

/* ---- type ---- */

static baum_status evaluate(const baum_i_joint *joint, baum_i_point *point, const baum_i_rows *out)
{
  const contact x = contact_at(joint, point);
  if (out->phi) {
    const double *numbers = point->parameters + joint->element.parameter;
    memset(out->phi + joint->row, 0, ROWS * sizeof *out->phi);
    out->phi[joint->row] = baum_i_dot3(x.e[0], x.d) + baum_i_dot3(x.e[0], x.rho) - numbers[OFFSET];
  }
  if (out->gamma) {
    const baum_i_spatial_motion v = baum_i_spatial_motion_at(x.a, x.b);
    double *gamma = out->gamma + joint->row;
    rows_along(&x, &v, &v, gamma);
    for (int i = 0; i < ROWS; i++) {
      gamma[i] = -gamma[i];
    }
  }
  if (out->jacobian) {
    double rows[ROWS * COLUMNS];
    for (int i = 0; i < ROWS; i++) {
      row_of(&x, x.e[i], rows + (ptrdiff_t)i * COLUMNS);
    }
    baum_i_columns_pack_any(point->mechanism, &joint->span, BAUM_I_SPACE, ROWS, rows,
                            out->jacobian + joint->jacobian);
  }
  return BAUM_OK;
}

/* Adds column j of (J^T lambda)_q. l is the sum of lambda e over the rows. */
static void add_force_column(const contact *x, const double l[3], int j, double *square)
{
  const baum_i_spatial_motion y = baum_i_spatial_unit_motion(x->a, x->b, j);
  const variation by_y = derivative_along(x, &y);
  double dl[3], arm_a[3], arm_b[3], turn_a[3], turn_b[3], moment[3], body[3];
  baum_i_cross(y.w[0], l, dl);
  for (int i = 0; i < 3; i++) {
    arm_a[i] = x->d[i] + x->rho[i];
    arm_b[i] = x->p[i] + x->rho[i];
    turn_a[i] = by_y.d[i] + by_y.rho[i];
    turn_b[i] = by_y.p[i] + by_y.rho[i];
  }
  double change_a[3] = {0.0}, change_b[3] = {0.0};
  add_cross(1.0, dl, arm_a, change_a);
  add_cross(1.0, l, turn_a, change_a);
  baum_i_cross(l, arm_a, moment);
  add_cross(-1.0, y.w[0], moment, change_a);
  add_cross(1.0, arm_b, dl, change_b);
  add_cross(1.0, turn_b, l, change_b);
  baum_i_cross(arm_b, l, moment);
  add_cross(-1.0, y.w[1], moment, change_b);
  for (int i = 0; i < 3; i++) {
    square[i * COLUMNS + j] = -dl[i];
    square[(6 + i) * COLUMNS + j] = dl[i];
  }
  baum_i_turn_back(x->a->axes, change_a, body);
  for (int i = 0; i < 3; i++) {
    square[(3 + i) * COLUMNS + j] = body[i];
  }
  baum_i_turn_back(x->b->axes, change_b, body);
  for (int i = 0; i < 3; i++) {
    square[(9 + i) * COLUMNS + j] = body[i];
  }
}

static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  const contact x = contact_at(joint, point);
  double twelve[COLUMNS], jw_q[ROWS * COLUMNS], gamma_q[ROWS * COLUMNS], gamma_v[ROWS * COLUMNS];
  double jtl_q[COLUMNS * COLUMNS] = {0.0};
  double l[3] = {0.0};
  baum_i_columns_gather(point, &joint->span, BAUM_I_SPACE, w, twelve);
  const baum_i_spatial_motion along = baum_i_spatial_motion_of(x.a, x.b, twelve);
  const baum_i_spatial_motion v = baum_i_spatial_motion_at(x.a, x.b);
  for (int i = 0; i < ROWS && lambda; i++) {
    baum_i_add_scaled3(lambda[joint->row + i], x.e[i], l);
  }
  for (int j = 0; j < COLUMNS; j++) {
    const baum_i_spatial_motion y = baum_i_spatial_unit_motion(x.a, x.b, j);
    double jw[ROWS], by_y[ROWS], by_v[ROWS], bend[ROWS];
    rows_along(&x, &along, &y, jw);
    rows_along(&x, &v, &y, by_y);
    rows_along(&x, &y, &v, by_v);
    bend_along(&x, &v, &y, bend);
    for (int i = 0; i < ROWS; i++) {
      jw_q[i * COLUMNS + j] = jw[i];
      gamma_v[i * COLUMNS + j] = -by_y[i] - by_v[i];
      gamma_q[i * COLUMNS + j] = -bend[i];
    }
    add_force_column(&x, l, j, jtl_q);
  }
  const baum_i_joint_blocks wide = {jw_q, jtl_q, gamma_q, gamma_v, NULL};
  baum_i_columns_pack_blocks(point->mechanism, joint, BAUM_I_SPACE, &wide, blocks);
  return BAUM_OK;
}

/* Sets `at` to the contact point in ground axes. */
static void place(const baum_i_joint *joint, const baum_i_point *point, double at[3])
{
  const contact x = contact_at(joint, point);
  for (int i = 0; i < 3; i++) {
    at[i] = x.b->r[i] + x.p[i] + x.rho[i];
  }
}

static void force_on_b(const baum_i_joint *joint, const baum_i_point *point, const double *lambda,
                       double six[BAUM_I_SPACE])
{
  const contact x = contact_at(joint, point);
  for (int i = 0; i < ROWS; i++) {
    double twelve[COLUMNS];
    row_of(&x, x.e[i], twelve);
    for (int j = 0; j < BAUM_I_SPACE; j++) {
      six[j] -= lambda[i] * twelve[6 + j];
    }
  }
}

static const baum_i_joint_type type = {
  .definition = {BAUM_I_DEFINITION(spatial_rolling_disc, "spatial rolling disc", fields),
                 .check = check, .parameter_count = PARAMETER_COUNT},
  .width = BAUM_I_SPACE,
  .scleronomic = true,
  .row_count = ROWS,
  .velocity_row_count = 2,
  .lower = lower,
  .extent = extent,
  .evaluate = baum_i_evaluate_each,
  .evaluate_one = evaluate,
  .linearize = linearize,
  .place = place,
  .force_on_b = force_on_b,
};

BAUM_I_DEFINE(joint, spatial_rolling_disc, type)
