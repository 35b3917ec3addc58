/* SPDX-License-Identifier: BSD-3-Clause */
/* Spatial joints whose last row is not a product (spatial_rows.h): the screw and the
 * constant-velocity joint. All other rows are products.
 *
 *   screw              Phi = d - offset - pitch angle / (2 pi)
 *   constant velocity  Phi = 2 p_z
 *
 * In the screw, d and the angle are the coordinates of a cylindrical joint. Positions determine the
 * angle only up to whole revolutions, and therefore Phi only up to multiples of the pitch. The
 * value of Phi that is nearest to 0 is used.
 *
 * In the constant-velocity joint, p is the quaternion of the rotation of body_b's joint axes
 * relative to body_a's joint axes. If p_z is 0, the axis of this rotation is normal to z_a, and the
 * relative angular velocity is normal to z_a + z_b (K. H. Hunt, Constant-velocity shaft couplings:
 * a general theory, J. Eng. Ind. 95, 1973). Shafts with fixed axes therefore rotate with equal
 * angular velocities. Let W_y be the angular velocities of a motion y, in ground axes and constant
 * in body axes, and let D_y be the derivative along y. With s_y = W_ya + W_yb, d_y = W_yb - W_ya
 * and no index for the present motion,
 *
 *   n       = p_y x_a - p_x y_a + p_w z_a;  z_a + z_b = 2 p_w n if p_z = 0
 *   D_y Phi = n . d_y
 *   D_y n   = (s_y x n - p_z d_y) / 2
 *   gamma   = p_z d . d / 2 + n . (W_a x W_b),   (J w)_y = (D_w n) . d_y
 *
 * The length of n is sqrt(1 - p_z^2), so the row is regular at every angle between the shafts. The
 * product y_a . x_b - x_a . y_b = 4 p_w p_z has the same zeros, but its derivatives vanish if the
 * shafts point in opposite directions, where p_w = 0. A motion without resistance passes such
 * configurations, because p_w = 0 is only one condition if p_z is 0. The state determines the sign
 * of p, because it contains quaternions or angles of planar bodies and not only axes. */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/spatial/spatial_joint.h"
#include "mechanism/spatial/spatial_motion.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

/* Parameters of a screw, after the points and axes. */
enum { PITCH = BAUM_I_SPATIAL_NUMBERS, OFFSET, SCREW_COUNT };

/* Parameters of a constant-velocity joint, after the points and axes: the orientations of the joint
 * axes on body_a and on body_b in body axes, as quaternions. */
enum { AXES_IN_BODY = BAUM_I_SPATIAL_NUMBERS, SHAFTS_COUNT = AXES_IN_BODY + 8 };

/* ---- rows of both joints ---- */

/* A joint, together with the state (point) in which it is evaluated. */
typedef struct state {
  const baum_i_joint *joint;
  const baum_i_point *point;
  const double *numbers;
  baum_i_spatial_pair pair;
} state;

/* The type of a joint whose last row is not a product. */
typedef struct coupled_type {
  baum_i_spatial_joint_type spatial;
  void (*last_row)(const state *s, baum_i_coordinate *out);
  /* Compute the second derivatives of the last row. w has twelve entries. */
  void (*last_linearize)(const state *s, const double *w, double lambda,
                         baum_i_coordinate_blocks *out);
} coupled_type;

static const coupled_type *type_of(const baum_i_joint *joint)
{
  return (const coupled_type *)(const void *)joint->type;
}

static state state_at(const baum_i_joint *joint, const baum_i_point *point)
{
  const double *numbers = point->parameters + joint->element.parameter;
  return (state){joint, point, numbers, baum_i_spatial_pair_at(&joint->span, numbers, true, point)};
}

static void row_at(const state *s, int number, baum_i_coordinate *out)
{
  const coupled_type *type = type_of(s->joint);
  if (number < s->joint->rows - 1) {
    baum_i_spatial_row_at(&s->pair, type->spatial.rows[number], out);
    return;
  }
  type->last_row(s, out);
}

static baum_status evaluate(const baum_i_joint *joint, baum_i_point *point, const baum_i_rows *out)
{
  const state s = state_at(joint, point);
  for (int i = 0; i < joint->rows; i++) {
    baum_i_coordinate row;
    row_at(&s, i, &row);
    if (out->phi) {
      out->phi[joint->row + i] = row.value;
    }
    if (out->gamma) {
      out->gamma[joint->row + i] = row.gamma;
    }
    if (out->jacobian) {
      baum_i_columns_pack_any(point->mechanism, &joint->span, BAUM_I_SPACE, 1, row.gradient,
                              out->jacobian + joint->jacobian + (ptrdiff_t)i * joint->span.nl);
    }
  }
  return BAUM_OK;
}

static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  const state s = state_at(joint, point);
  const coupled_type *type = type_of(joint);
  const int last = joint->rows - 1;
  const ptrdiff_t at = (ptrdiff_t)COLUMNS * last;
  double w_wide[COLUMNS];
  double jw_q[BAUM_I_SPATIAL_ROWS * COLUMNS] = {0.0},
                                    gamma_q[BAUM_I_SPATIAL_ROWS * COLUMNS] = {0.0};
  double gamma_v[BAUM_I_SPATIAL_ROWS * COLUMNS] = {0.0}, jtl_q[COLUMNS * COLUMNS] = {0.0};
  const baum_i_joint_blocks wide = {jw_q, jtl_q, gamma_q, gamma_v, NULL};
  baum_i_columns_gather(point, &joint->span, BAUM_I_SPACE, w, w_wide);
  baum_i_spatial_linearize_products(&s.pair, type->spatial.rows, last, 1.0, w_wide,
                                    lambda ? lambda + joint->row : NULL, &wide);
  baum_i_coordinate_blocks row;
  type->last_linearize(&s, w_wide, lambda ? lambda[joint->row + last] : 0.0, &row);
  memcpy(jw_q + at, row.jw_q, sizeof row.jw_q);
  memcpy(gamma_q + at, row.gamma_q, sizeof row.gamma_q);
  memcpy(gamma_v + at, row.gamma_v, sizeof row.gamma_v);
  for (int k = 0; k < COLUMNS * COLUMNS; k++) {
    jtl_q[k] += row.jtl_q[k];
  }
  baum_i_columns_pack_blocks(point->mechanism, joint, BAUM_I_SPACE, &wide, blocks);
  return BAUM_OK;
}

static void force_on_b(const baum_i_joint *joint, const baum_i_point *point, const double *lambda,
                       double six[BAUM_I_SPACE])
{
  const state s = state_at(joint, point);
  for (int i = 0; i < joint->rows; i++) {
    baum_i_coordinate row;
    row_at(&s, i, &row);
    baum_i_spatial_add_force_on_b(&row, lambda[i], six);
  }
}

static baum_status lower_axes(const baum_mechanism *mechanism, const baum_i_joint *joint,
                              double *parameters)
{
  return baum_i_spatial_lower_axes(mechanism, &joint->element, &joint->span, parameters);
}

/* The members that both types set. */
#define COUPLED(NAME, TITLE, LOWER, ROWS, COUNT, FIELDS)                                       \
  .definition = {BAUM_I_DEFINITION(NAME, TITLE, FIELDS), .check = baum_i_spatial_check_axes,   \
                 .parameter_count = (COUNT)},                                                  \
  .width = BAUM_I_SPACE, .scleronomic = true, .row_count = (ROWS), .lower = (LOWER),           \
  .extent = baum_i_spatial_extent, .evaluate = baum_i_evaluate_each, .evaluate_one = evaluate, \
  .linearize = linearize, .place = baum_i_spatial_place, .force_on_b = force_on_b

/* ---- screw ---- */

/* Return the displacement along the axis in the design configuration. */
static double design_displacement(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                  const double *parameters)
{
  baum_i_spatial_frame frames[2];
  double arms[2][3], axis[3], apart[3];
  for (int k = 0; k < 2; k++) {
    frames[k] = baum_i_spatial_design_frame(mechanism, joint->span.bodies[k]);
    baum_i_turn(frames[k].axes, parameters + (ptrdiff_t)3 * k, arms[k]);
  }
  for (int i = 0; i < 3; i++) {
    apart[i] = frames[1].r[i] + arms[1][i] - frames[0].r[i] - arms[0][i];
  }
  baum_i_turn(frames[0].axes, parameters + BAUM_I_SPATIAL_AXES_A + 6, axis);
  return baum_i_dot3(apart, axis);
}

static baum_status lower_screw(const baum_mechanism *mechanism, const baum_i_joint *joint,
                               double *parameters)
{
  const baum_spatial_screw_def *def = joint->element.def;
  BAUM_I_TRY(lower_axes(mechanism, joint, parameters));
  parameters[PITCH] = def->pitch;
  parameters[OFFSET] =
    isnan(def->offset) ? design_displacement(mechanism, joint, parameters) : def->offset;
  return BAUM_OK;
}

static void screw_row(const state *s, baum_i_coordinate *out)
{
  const double pitch = s->numbers[PITCH], factor = -pitch / BAUM_I_REVOLUTION;
  const baum_i_joint_coordinate displacement = {s->joint, 0}, angle = {s->joint, 1};
  baum_i_coordinate turned;
  baum_i_coordinate_near_zero(&displacement, s->point, out);
  baum_i_coordinate_near_zero(&angle, s->point, &turned);
  out->value = remainder(out->value + factor * turned.value - s->numbers[OFFSET], pitch);
  out->rate += factor * turned.rate;
  out->gamma += factor * turned.gamma;
  for (int k = 0; k < COLUMNS; k++) {
    out->gradient[k] += factor * turned.gradient[k];
  }
}

static void screw_linearize(const state *s, const double *w, double lambda,
                            baum_i_coordinate_blocks *out)
{
  const double factor = -s->numbers[PITCH] / BAUM_I_REVOLUTION;
  baum_i_coordinate_blocks turned;
  baum_i_spatial_coordinate_linearize(s->joint, 0, s->point, w, lambda, out);
  baum_i_spatial_coordinate_linearize(s->joint, 1, s->point, w, factor * lambda, &turned);
  for (int k = 0; k < COLUMNS; k++) {
    out->jw_q[k] += factor * turned.jw_q[k];
    out->gamma_q[k] += factor * turned.gamma_q[k];
    out->gamma_v[k] += factor * turned.gamma_v[k];
  }
  for (int k = 0; k < COLUMNS * COLUMNS; k++) {
    out->jtl_q[k] += turned.jtl_q[k];
  }
}

static const baum_i_def_field screw_fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_screw_def),
  BAUM_I_NUMBERS(baum_spatial_screw_def, pitch, NOT_ZERO, "m", 0.0),
  BAUM_I_OPTIONAL(baum_spatial_screw_def, offset, OPTIONAL, "m"),
  {0},
};

static const coupled_type screw = {
  {{COUPLED(spatial_screw, "spatial screw", lower_screw, 5, SCREW_COUNT, screw_fields),
    .is_reversed = baum_i_spatial_is_reversed,
    .coordinates = {BAUM_COORDINATE_DISPLACEMENT, BAUM_COORDINATE_ANGLE},
    .coordinate = baum_i_spatial_coordinate,
    .coordinate_linearize = baum_i_spatial_coordinate_linearize},
   .rows = {{BAUM_I_X_A, BAUM_I_Z_B},
            {BAUM_I_Y_A, BAUM_I_Z_B},
            {BAUM_I_X_A, BAUM_I_APART},
            {BAUM_I_Y_A, BAUM_I_APART}},
   .coordinate_rows = {{{BAUM_I_Z_A, BAUM_I_APART}},
                       {{BAUM_I_Y_A, BAUM_I_X_B}, {BAUM_I_X_A, BAUM_I_X_B}}},
   .directed_count = 1,
   .directed = {{BAUM_I_Z_A, BAUM_I_Z_B}}},
  .last_row = screw_row,
  .last_linearize = screw_linearize,
};

BAUM_I_DEFINE(joint, spatial_screw, screw.spatial.type)

/* ---- constant-velocity joint ---- */

/* Compute p from the orientations of both bodies, which are unit quaternions. */
static void relative_rotation(const double *numbers, double body[2][4], double p[4])
{
  double joint[2][4];
  for (int k = 0; k < 2; k++) {
    baum_i_quaternion_product(body[k], numbers + AXES_IN_BODY + (ptrdiff_t)4 * k, joint[k]);
  }
  const double back[4] = {joint[0][0], -joint[0][1], -joint[0][2], -joint[0][3]};
  baum_i_quaternion_product(back, joint[1], p);
}

/* Store the orientations of the joint axes in body axes, as quaternions. Their signs are such that
 * p_w > 0 in the design configuration. */
static baum_status lower_shafts(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                double *parameters)
{
  double body[2][4], p[4];
  BAUM_I_TRY(lower_axes(mechanism, joint, parameters));
  for (int k = 0; k < 2; k++) {
    const double *axes =
      parameters + (k == 0 ? (int)BAUM_I_SPATIAL_AXES_A : (int)BAUM_I_SPATIAL_AXES_B);
    double columns[9];
    for (int i = 0; i < 9; i++) {
      columns[i] = axes[3 * (i % 3) + i / 3];
    }
    baum_i_quaternion_of(columns, parameters + AXES_IN_BODY + (ptrdiff_t)4 * k);
    baum_i_spatial_design_orientation(mechanism, joint->span.bodies[k], body[k]);
  }
  relative_rotation(parameters, body, p);
  if (p[0] < 0.0) {
    for (int i = 4; i < 8; i++) {
      parameters[AXES_IN_BODY + i] *= -1.0;
    }
  }
  return BAUM_OK;
}

/* The numbers from which the row and its derivatives are computed, see the head of this file. */
typedef struct shafts {
  baum_i_spatial_motion motion;
  double p[4];
  double n[3];
} shafts;

static shafts shafts_at(const state *s)
{
  shafts out = {.motion = baum_i_spatial_motion_at(s->pair.frame[0], s->pair.frame[1])};
  double body[2][4];
  for (int k = 0; k < 2; k++) {
    const baum_i_body_place *place = &s->point->mechanism->places[s->joint->span.bodies[k]];
    baum_i_spatial_orientation_at((baum_i_frame_kind)place->kind, s->point->q + place->q, body[k]);
  }
  relative_rotation(s->numbers, body, out.p);
  baum_i_add_scaled3(out.p[2], s->pair.axes[0], out.n);
  baum_i_add_scaled3(-out.p[1], s->pair.axes[0] + 3, out.n);
  baum_i_add_scaled3(out.p[0], s->pair.axes[0] + 6, out.n);
  return out;
}

/* Return a . (b x c). */
static double dot_cross(const double a[3], const double b[3], const double c[3])
{
  double normal[3];
  baum_i_cross(b, c, normal);
  return baum_i_dot3(a, normal);
}

/* Set d = b - a. */
static void subtract(const double b[3], const double a[3], double d[3])
{
  for (int i = 0; i < 3; i++) {
    d[i] = b[i] - a[i];
  }
}

/* Compute D_y n for the motion y. */
static void normal_along(const shafts *x, const baum_i_spatial_motion *y, double out[3])
{
  double half_sum[3], d[3];
  subtract(y->w[1], y->w[0], d);
  for (int i = 0; i < 3; i++) {
    half_sum[i] = 0.5 * (y->w[0][i] + y->w[1][i]);
  }
  baum_i_cross(half_sum, x->n, out);
  baum_i_add_scaled3(-0.5 * x->p[3], d, out);
}

/* Write the twelve numbers g with g w = c . d_w for all motions w. */
static void spread(const state *s, const double c[3], double g[COLUMNS])
{
  memset(g, 0, COLUMNS * sizeof *g);
  for (int k = 0; k < 2; k++) {
    double moment[3] = {0.0};
    baum_i_add_scaled3(k == 0 ? -1.0 : 1.0, c, moment);
    baum_i_turn_back(s->pair.frame[k]->axes, moment, g + (ptrdiff_t)BAUM_I_SPACE * k + 3);
  }
}

static void shafts_row(const state *s, baum_i_coordinate *out)
{
  const shafts x = shafts_at(s);
  double d[3];
  subtract(x.motion.w[1], x.motion.w[0], d);
  *out = (baum_i_coordinate){.value = 2.0 * x.p[3],
                             .rate = baum_i_dot3(x.n, d),
                             .gamma = 0.5 * x.p[3] * baum_i_dot3(d, d) +
                                      dot_cross(x.n, x.motion.w[0], x.motion.w[1])};
  spread(s, x.n, out->gradient);
}

/* Compute the derivatives of gamma along y: with respect to positions, D_y W_k is W_yk x W_k; with
 * respect to velocities, it is W_yk. */
static void gamma_along(const shafts *x, const baum_i_spatial_motion *y, double *gamma_q,
                        double *gamma_v)
{
  const double(*w)[3] = x->motion.w;
  double turned[2][3], d[3], d_y[3], d_turned[3], n_y[3];
  baum_i_cross(y->w[0], w[0], turned[0]);
  baum_i_cross(y->w[1], w[1], turned[1]);
  subtract(w[1], w[0], d);
  subtract(y->w[1], y->w[0], d_y);
  subtract(turned[1], turned[0], d_turned);
  normal_along(x, y, n_y);
  *gamma_q = 0.25 * baum_i_dot3(x->n, d_y) * baum_i_dot3(d, d) +
             x->p[3] * baum_i_dot3(d, d_turned) + dot_cross(n_y, w[0], w[1]) +
             dot_cross(x->n, turned[0], w[1]) + dot_cross(x->n, w[0], turned[1]);
  *gamma_v =
    x->p[3] * baum_i_dot3(d, d_y) + dot_cross(x->n, y->w[0], w[1]) + dot_cross(x->n, w[0], y->w[1]);
}

static void shafts_linearize(const state *s, const double *w, double lambda,
                             baum_i_coordinate_blocks *out)
{
  const shafts x = shafts_at(s);
  const baum_i_spatial_motion along =
    baum_i_spatial_motion_of(s->pair.frame[0], s->pair.frame[1], w);
  double change[3];
  *out = (baum_i_coordinate_blocks){.jw_q = {0.0}};
  normal_along(&x, &along, change);
  spread(s, change, out->jw_q);
  normal_along(&x, &x.motion, change);
  spread(s, change, out->rate_q);
  for (int i = 0; i < COLUMNS; i++) {
    const baum_i_spatial_motion unit =
      baum_i_spatial_unit_motion(s->pair.frame[0], s->pair.frame[1], i);
    gamma_along(&x, &unit, &out->gamma_q[i], &out->gamma_v[i]);
    normal_along(&x, &unit, change);
    for (int k = 0; k < 3; k++) {
      change[k] *= lambda;
    }
    spread(s, change, out->jtl_q + (ptrdiff_t)COLUMNS * i);
  }
}

static const baum_i_def_field shaft_fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_constant_velocity_def),
  {0},
};

static const coupled_type constant_velocity = {
  {{COUPLED(spatial_constant_velocity, "spatial constant-velocity joint", lower_shafts, 4,
            SHAFTS_COUNT, shaft_fields)},
   .rows = {{BAUM_I_X_GROUND, BAUM_I_APART},
            {BAUM_I_Y_GROUND, BAUM_I_APART},
            {BAUM_I_Z_GROUND, BAUM_I_APART}}},
  .last_row = shafts_row,
  .last_linearize = shafts_linearize,
};

BAUM_I_DEFINE(joint, spatial_constant_velocity, constant_velocity.spatial.type)
