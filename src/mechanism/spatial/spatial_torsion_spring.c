/* SPDX-License-Identifier: BSD-3-Clause */
/* Torsion spring and damper in parallel about the axis z_a. The axis z_b may be inclined to z_a.
 * The angle is the twist of the relative rotation about z_a. With the quaternion p of this
 * rotation,
 *
 *   angle = 2 atan2(p_z, p_w) = atan2(s, c)
 *   s = y_a . x_b - x_a . y_b,   c = x_a . x_b + y_a . y_b
 *
 * because s = 4 p_w p_z and c = 2 (p_w^2 - p_z^2). If body_a and body_b are interchanged, only the
 * sign of the angle changes. If z_b points in the direction opposite to z_a, the angle is undefined
 * and the torque is 0. Let h = angle_q, and let T(angle, angle') be the torque of
 * general/spring_law.h, with the partial derivatives T_l with respect to the angle and T_l' with
 * respect to the angular velocity:
 *
 *   g   = -T h
 *   g_q = -h T_q - T h_q,   T_q = T_l h + T_l' (angle')_q
 *   g_v = -T_l' h h^T
 *
 * s and c are sums of products (spatial_rows.h). The chain rule is in general/composed_row.h.
 */
#include <float.h>
#include <math.h>

#include "base/rotation.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/general/spring_law.h"
#include "mechanism/spatial/spatial_joint.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

/* Parameters of the spring: the points and axes, then the numbers of the spring law. */
enum { LAW = BAUM_I_SPATIAL_NUMBERS, PARAMETER_COUNT = LAW + BAUM_I_SPRING_NUMBERS };

BAUM_I_CHECK_SPRING_DEF(baum_spatial_torsion_spring_def);

static const baum_i_def_field fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_torsion_spring_def),
  BAUM_I_SPRING_FIELDS(baum_spatial_torsion_spring_def, "N m/rad", "N m s/rad", free_angle,
                       OPTIONAL, "rad"),
  {0},
};

/* ---- definition ---- */

/* The axes are chosen so that the angle is 0 in the design configuration. */
static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  baum_i_spring_lower(force, 0.0, parameters + LAW);
  return baum_i_spatial_lower_axes(mechanism, &force->element, &force->span, parameters);
}

/* ---- one spring ---- */

/* c is the sum of the first two products, and s is the difference of the last two. */
static const baum_i_spatial_row PRODUCTS[2][2] = {
  {{BAUM_I_X_A, BAUM_I_X_B}, {BAUM_I_Y_A, BAUM_I_Y_B}},
  {{BAUM_I_Y_A, BAUM_I_X_B}, {BAUM_I_X_A, BAUM_I_Y_B}}};
static const double SIGNS[2] = {1.0, -1.0};

typedef struct spring {
  baum_i_spatial_pair pair;
  baum_i_spring_law law;
  baum_i_inner x[2]; /* c and s */
  baum_i_outer angle;
  double rate;
  double h[COLUMNS];
  bool no_direction;
} spring;

static void set_inner(const baum_i_spatial_pair *pair, int number, baum_i_inner *x)
{
  static const int bodies[2] = {0, 1};
  baum_i_coordinate other;
  baum_i_composed_place(x, BAUM_I_SPACE, BAUM_I_SPACE, bodies);
  baum_i_spatial_row_at(pair, PRODUCTS[number][0], &x->c);
  baum_i_spatial_row_at(pair, PRODUCTS[number][1], &other);
  x->c.value += SIGNS[number] * other.value;
  x->c.rate += SIGNS[number] * other.rate;
  for (int k = 0; k < COLUMNS; k++) {
    x->c.gradient[k] += SIGNS[number] * other.gradient[k];
  }
}

static spring spring_at(const baum_i_force *force, const baum_i_point *point)
{
  const double *numbers = point->parameters + force->element.parameter;
  spring s = {.pair = baum_i_spatial_pair_at(&force->span, numbers, true, point),
              .law = baum_i_spring_law_of(force, point)};
  set_inner(&s.pair, 0, &s.x[0]);
  set_inner(&s.pair, 1, &s.x[1]);
  s.no_direction = hypot(s.x[0].c.value, s.x[1].c.value) < sqrt(DBL_MIN);
  if (!s.no_direction) {
    const double near = baum_i_expected_force_angle(force, point);
    s.angle = baum_i_spatial_angle_of(s.x[0].c.value, s.x[1].c.value);
    s.angle.value = near + remainder(s.angle.value - near, BAUM_I_REVOLUTION);
    s.rate = s.angle.first[0] * s.x[0].c.rate + s.angle.first[1] * s.x[1].c.rate;
    baum_i_composed_add_gradient(s.x, &s.angle, s.h);
  }
  return s;
}

static baum_i_stretch stretch(const baum_i_force *force, const baum_i_point *point)
{
  const spring s = spring_at(force, point);
  return (baum_i_stretch){s.angle.value, s.rate, 1.0, s.no_direction};
}

/* Let d be the least distance of z_b from -z_a in a step in which z_b moves by l relative to z_a.
 * For d << 1 the angle changes by nearly 2 pi while z_b moves by a few times d. If l > 4.53 d, the
 * prediction of baum_i_follow_angles() may differ from the angle by more than pi, and the count
 * then loses a revolution. LIMIT is lower than 4.53, because z_b does not move along a straight
 * line. A spring without torque never jumps. */
static bool jumps(const baum_i_force *force, const baum_i_point *point, const double *from,
                  const double *to)
{
  static const double LIMIT = 3.0;
  const baum_i_spring_law law = baum_i_spring_law_of(force, point);
  if (!law.law && law.numbers[BAUM_I_STIFFNESS] == 0.0 && law.numbers[BAUM_I_DAMPING] == 0.0) {
    return false;
  }
  double r[2][9], start[3], move[3], nearest[3];
  baum_i_spatial_relative_axes(force, point, from, r[0]);
  baum_i_spatial_relative_axes(force, point, to, r[1]);
  for (int i = 0; i < 3; i++) {
    start[i] = r[0][3 * i + 2] + (i == 2 ? 1.0 : 0.0);
    move[i] = r[1][3 * i + 2] - r[0][3 * i + 2];
  }
  const double length = baum_i_dot3(move, move);
  const double part = length > 0.0 ? -baum_i_dot3(start, move) / length : 0.0;
  for (int i = 0; i < 3; i++) {
    nearest[i] = start[i] + fmin(fmax(part, 0.0), 1.0) * move[i];
  }
  return length > LIMIT * LIMIT * baum_i_dot3(nearest, nearest);
}

/* ---- type ---- */

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const spring s = spring_at(group->forces[i], point);
    if (s.no_direction) {
      continue;
    }
    baum_i_tension t;
    BAUM_I_TRY(baum_i_tension_at(&s.law, point, s.angle.value, s.rate, &t));
    double wide[COLUMNS];
    for (int k = 0; k < COLUMNS; k++) {
      wide[k] = -t.value * s.h[k];
    }
    baum_i_columns_scatter_any(point->mechanism, &group->forces[i]->span, BAUM_I_SPACE, wide, out);
  }
  return BAUM_OK;
}

/* Sets those second derivatives of c or s that forces need, for lambda = 1. */
static void set_blocks(const baum_i_spatial_pair *pair, int number, baum_i_inner *x)
{
  x->blocks = (baum_i_coordinate_blocks){.jw_q = {0.0}};
  for (int n = 0; n < 2; n++) {
    baum_i_spatial_second second;
    const double sign = n == 0 ? 1.0 : SIGNS[number];
    baum_i_spatial_second_of(pair, PRODUCTS[number][n], &second);
    for (int k = 0; k < COLUMNS; k++) {
      x->blocks.rate_q[k] += sign * second.rate_q[k];
    }
    for (int k = 0; k < COLUMNS * COLUMNS; k++) {
      x->blocks.jtl_q[k] += sign * second.columns_q[k];
    }
  }
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  spring s = spring_at(element, point);
  if (s.no_direction) {
    return BAUM_OK;
  }
  baum_i_tension t;
  BAUM_I_TRY(baum_i_tension_at(&s.law, point, s.angle.value, s.rate, &t));
  set_blocks(&s.pair, 0, &s.x[0]);
  set_blocks(&s.pair, 1, &s.x[1]);
  const double unused[COLUMNS] = {0.0};
  baum_i_coordinate_blocks c = {.jw_q = {0.0}};
  const baum_i_composed_blocks out = {COLUMNS, c.jw_q, c.jtl_q, c.gamma_q, c.gamma_v, c.rate_q};
  baum_i_composed_linearize(s.x, &s.angle, unused, t.value, &out);
  double force_q[COLUMNS * COLUMNS];
  double force_v[COLUMNS * COLUMNS];
  for (int i = 0; i < COLUMNS; i++) {
    for (int k = 0; k < COLUMNS; k++) {
      int at = COLUMNS * i + k;
      force_q[at] = -s.h[i] * (t.by_length * s.h[k] + t.by_rate * c.rate_q[k]) - c.jtl_q[at];
      force_v[at] = -t.by_rate * s.h[i] * s.h[k];
    }
  }
  const baum_mechanism *m = point->mechanism;
  baum_i_columns_pack_force(m, element, BAUM_I_SPACE, force_q, blocks->force_q);
  baum_i_columns_pack_force(m, element, BAUM_I_SPACE, force_v, blocks->force_v);
  return BAUM_OK;
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(spatial_torsion_spring, "spatial torsion spring", fields),
                 .check = baum_i_spatial_check_axes, .parameter_count = PARAMETER_COUNT,
                 .check_derivatives = baum_i_spring_check},
  .spatial = true,
  .counts_revolutions = true,
  .lower = lower,
  .force = force,
  .linearize = linearize,
  BAUM_I_SPRING_MEMBERS(baum_spatial_torsion_spring_def),
  .stretch = stretch,
  .jumps = jumps,
};

BAUM_I_DEFINE(force, spatial_torsion_spring, type)
