/* SPDX-License-Identifier: BSD-3-Clause */
/* Bushing: a linear spring and damper for all six relative displacements of two bodies. E_a and E_b
 * are matrices whose rows are the axes of the bushing on each body, and e is the vector from
 * body_a's point to body_b's point. W and r are as in spatial_rows.h.
 *
 *   x = (d, theta),   d = E_a e,   theta = log R,   R = E_a E_b^T
 *   V = x^T K x / 2,  f = K x + C x',  g = -H^T f,  H = x_q              (H is 6 x 12)
 *   g_q = -(H^T f)_q at constant f - H^T (K H + C (x')_q),   g_v = -H^T C H
 *
 * The components of d are products (spatial_rows.h). theta is the rotation vector, of length
 * phi < pi. With the relative angular velocity w = E_a (W_b - W_a) (Bullo, Murray 1995):
 *
 *   theta' = B(theta) w,   B u = u - theta x u / 2 + k theta x (theta x u)
 *   k = (1 - h cot h) / (4 h^2),   h = phi / 2
 *
 * B^T u is the same expression with + theta x u / 2. Let l be the last three numbers of f, and m =
 * B^T l. The part of H^T f that belongs to l is the moment E_a^T m on body_b and the opposite
 * moment on body_a. Let D be the derivative along a motion y with the angular velocities W_ya and
 * W_yb:
 *
 *   D w = E_a ((W_yb - W_ya) x W_b),   D (E_a^T m) = E_a^T D m + W_ya x E_a^T m
 */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "mechanism/spatial/spatial_joint.h"

enum { SIX = 6, MATRIX = SIX * SIX, COLUMNS = BAUM_I_PAIR_COLUMNS };

/* Parameters, after the points and axes. */
enum {
  STIFFNESS = BAUM_I_SPATIAL_NUMBERS,
  DAMPING = STIFFNESS + MATRIX,
  PARAMETER_COUNT = DAMPING + MATRIX
};

static const baum_i_def_field fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_bushing_def),
  BAUM_I_OPTIONAL(baum_spatial_bushing_def, x_axis, POINT, "-"),
  BAUM_I_NUMBERS(baum_spatial_bushing_def, stiffness, FINITE, "N/m, N or N m/rad", 0.0),
  BAUM_I_NUMBERS(baum_spatial_bushing_def, damping, FINITE, "N s/m, N s or N m s/rad", 0.0),
  {0},
};

/* ---- definition ---- */

/* Relative size of rounding errors in matrices that the user has typed or rotated. */
static const double ROUNDING = 1e-9;

/* Tells whether a symmetric matrix is positive semidefinite, by elimination. If a pivot is zero up
 * to rounding, the rest of its row must also be zero. */
static bool is_semidefinite(const double given[MATRIX])
{
  double m[SIX][SIX];
  memcpy(m, given, sizeof m);
  for (int k = 0; k < SIX; k++) {
    const double small = ROUNDING * fabs(given[(SIX + 1) * k]);
    if (m[k][k] < -small) {
      return false;
    }
    for (int i = k + 1; i < SIX; i++) {
      const double limit = ROUNDING * sqrt(fabs(given[(SIX + 1) * k] * given[(SIX + 1) * i]));
      if (m[k][k] <= small && fabs(m[i][k]) > limit) {
        return false;
      }
      const double factor = m[k][k] <= small ? 0.0 : m[i][k] / m[k][k];
      for (int j = k + 1; j < SIX; j++) {
        m[i][j] -= factor * m[k][j];
      }
    }
  }
  return true;
}

static baum_status check_matrix(const double m[MATRIX], const char *label, const char *field)
{
  for (int i = 0; i < SIX; i++) {
    for (int j = 0; j < i; j++) {
      const double a = m[SIX * i + j], b = m[SIX * j + i];
      const double diagonal = sqrt(fabs(m[(SIX + 1) * i] * m[(SIX + 1) * j]));
      if (fabs(a - b) > ROUNDING * fmax(diagonal, fmax(fabs(a), fabs(b)))) {
        return baum_i_fail(BAUM_ERR_ARGUMENT,
                           "%s: %s[%d][%d] is %g and %s[%d][%d] is %g, must be equal", label, field,
                           i, j, a, field, j, i, b);
      }
    }
  }
  return is_semidefinite(m)
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT,
                         "%s: %s has a negative eigenvalue, must be positive semidefinite", label,
                         field);
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_spatial_bushing_def *def = given;
  BAUM_I_TRY(baum_i_spatial_check_frame(mechanism, def, label));
  BAUM_I_TRY(check_matrix(def->stiffness, label, "stiffness"));
  return check_matrix(def->damping, label, "damping");
}

/* Stores the mean of a matrix and its transpose. If the given matrix is symmetric only up to
 * rounding, the forces are then still conservative. */
static void set_symmetric(const double given[MATRIX], double out[MATRIX])
{
  for (int i = 0; i < MATRIX; i++) {
    out[i] = 0.5 * (given[i] + given[SIX * (i % SIX) + i / SIX]);
  }
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  const baum_spatial_bushing_def *def = force->element.def;
  set_symmetric(def->stiffness, parameters + STIFFNESS);
  set_symmetric(def->damping, parameters + DAMPING);
  return baum_i_spatial_lower_frame(mechanism, &force->element, &force->span, parameters);
}

/* ---- the map B ---- */

/* The rotation vector theta, k, and slope = (dk/dphi) / phi. */
typedef struct turn {
  double theta[3];
  double k, slope;
} turn;

static turn turn_of(const double r[9])
{
  turn t;
  double p[4];
  baum_i_quaternion_of(r, p);
  baum_i_quaternion_log(p, t.theta);
  const double h = 0.5 * sqrt(baum_i_dot3(t.theta, t.theta));
  const double h2 = h * h;
  if (h < 0.1) { /* the first terms of the series, which are exact to rounding here */
    t.k = 0.25 * (1.0 / 3.0 + h2 * (1.0 / 45.0 + h2 * (2.0 / 945.0 + h2 / 4725.0)));
    t.slope = 0.0625 * (2.0 / 45.0 + h2 * (8.0 / 945.0 + h2 * (6.0 / 4725.0)));
  } else {
    const double sine = sin(h), cotangent = cos(h) / sine, rest = 1.0 - h * cotangent;
    t.k = 0.25 * rest / h2;
    t.slope = 0.0625 * (h / (sine * sine) - cotangent - 2.0 * rest / h) / (h * h2);
  }
  return t;
}

/* Sets out = B u if sign is -1, and out = B^T u if sign is 1. */
static void apply(const turn *t, double sign, const double u[3], double out[3])
{
  double first[3], second[3];
  baum_i_cross(t->theta, u, first);
  baum_i_cross(t->theta, first, second);
  for (int i = 0; i < 3; i++) {
    out[i] = u[i] + 0.5 * sign * first[i] + t->k * second[i];
  }
}

/* Sets `out` to the derivative of B u, or of B^T u, along a change of theta. */
static void apply_along(const turn *t, double sign, const double change[3], const double u[3],
                        double out[3])
{
  double first[3], second[3], turned[3], again[3], other[3];
  const double slope = t->slope * baum_i_dot3(t->theta, change);
  baum_i_cross(t->theta, u, first);
  baum_i_cross(t->theta, first, second);
  baum_i_cross(change, u, turned);
  baum_i_cross(change, first, again);
  baum_i_cross(t->theta, turned, other);
  for (int i = 0; i < 3; i++) {
    out[i] = 0.5 * sign * turned[i] + slope * second[i] + t->k * (again[i] + other[i]);
  }
}

/* ---- one bushing ---- */

typedef struct bushing {
  baum_i_spatial_pair pair;
  const double *stiffness, *damping;
  turn turn;
  double w[3]; /* relative angular velocity, in the axes of the bushing on body_a */
  double x[SIX];
  double rate[SIX];
  double f[SIX];
  double h[SIX * COLUMNS];
} bushing;

static void multiply(const double m[MATRIX], const double *x, int stride, double *out)
{
  for (int i = 0; i < SIX; i++) {
    double sum = 0.0;
    for (int j = 0; j < SIX; j++) {
      sum += m[SIX * i + j] * x[stride * j];
    }
    out[stride * i] += sum;
  }
}

static baum_i_spatial_row along_axis(int i)
{
  return (baum_i_spatial_row){(baum_i_spatial_vector)(BAUM_I_X_A + i), BAUM_I_APART};
}

/* Computes the angular velocities of both bodies, in ground axes, if the velocity of one column is
 * 1 and all others are 0. Returns false if the column is a translation. */
static bool unit_turn(const bushing *b, int column, double w[2][3])
{
  const int body = column / SIX, i = column % SIX - 3;
  const double axis[3] = {i == 0, i == 1, i == 2};
  memset(w, 0, 2 * sizeof *w);
  if (i >= 0) {
    baum_i_turn(b->pair.frame[body]->axes, axis, w[body]);
  }
  return i >= 0;
}

/* Sets out = E_a (y - x). */
static void relative(const bushing *b, const double x[3], const double y[3], double out[3])
{
  const double apart[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
  baum_i_turn(b->pair.axes[0], apart, out);
}

static void set_displacement(bushing *b)
{
  for (int i = 0; i < 3; i++) {
    baum_i_coordinate c;
    baum_i_spatial_row_at(&b->pair, along_axis(i), &c);
    b->x[i] = c.value;
    b->rate[i] = c.rate;
    memcpy(b->h + (ptrdiff_t)COLUMNS * i, c.gradient, sizeof c.gradient);
  }
}

static void set_rotation(bushing *b)
{
  const double *a = b->pair.axes[0];
  double r[9];
  for (int i = 0; i < 9; i++) {
    r[i] = baum_i_dot3(a + (ptrdiff_t)3 * (i / 3), b->pair.axes[1] + (ptrdiff_t)3 * (i % 3));
  }
  b->turn = turn_of(r);
  memcpy(b->x + 3, b->turn.theta, sizeof b->turn.theta);
  relative(b, b->pair.frame[0]->w, b->pair.frame[1]->w, b->w);
  apply(&b->turn, -1.0, b->w, b->rate + 3);
  for (int j = 0; j < COLUMNS; j++) {
    double w[2][3], along[3], column[3] = {0.0};
    if (unit_turn(b, j, w)) {
      relative(b, w[0], w[1], along);
      apply(&b->turn, -1.0, along, column);
    }
    for (int i = 0; i < 3; i++) {
      b->h[COLUMNS * (3 + i) + j] = column[i];
    }
  }
}

static bushing bushing_at(const baum_i_force *force, const baum_i_point *point)
{
  const double *numbers = point->parameters + force->element.parameter;
  bushing b = {.pair = baum_i_spatial_pair_at(&force->span, numbers, true, point),
               .stiffness = numbers + STIFFNESS,
               .damping = numbers + DAMPING};
  set_displacement(&b);
  set_rotation(&b);
  multiply(b.stiffness, b.x, 1, b.f);
  multiply(b.damping, b.rate, 1, b.f);
  return b;
}

/* ---- derivatives ---- */

/* Sets the first three of the six rows of (x')_q, which belong to d. Subtracts (d_q^T f)_q from
 * `square`. */
static void add_displacement(const bushing *b, double *rate_q, double *square)
{
  for (int i = 0; i < 3; i++) {
    baum_i_spatial_second second;
    baum_i_spatial_second_of(&b->pair, along_axis(i), &second);
    memcpy(rate_q + (ptrdiff_t)COLUMNS * i, second.rate_q, sizeof second.rate_q);
    for (int k = 0; k < COLUMNS * COLUMNS; k++) {
      square[k] -= b->f[i] * second.columns_q[k];
    }
  }
}

/* Sets column j of the last three rows of (x')_q, which belong to theta. Subtracts column j of
 * (theta_q^T f)_q from `square`. */
static void add_rotation(const bushing *b, int j, double *rate_q, double *square)
{
  double w[2][3], change[3], turned[3], one[3], other[3], moment[3], ground[3];
  if (!unit_turn(b, j, w)) {
    return;
  }
  for (int i = 0; i < 3; i++) {
    change[i] = b->h[COLUMNS * (3 + i) + j];
    turned[i] = w[1][i] - w[0][i];
  }
  baum_i_cross(turned, b->pair.frame[1]->w, one);
  baum_i_turn(b->pair.axes[0], one, turned);
  apply(&b->turn, -1.0, turned, one);
  apply_along(&b->turn, -1.0, change, b->w, other);
  for (int i = 0; i < 3; i++) {
    rate_q[COLUMNS * (3 + i) + j] = one[i] + other[i];
  }
  apply(&b->turn, 1.0, b->f + 3, moment);
  baum_i_turn_back(b->pair.axes[0], moment, ground);
  apply_along(&b->turn, 1.0, change, b->f + 3, one);
  baum_i_turn_back(b->pair.axes[0], one, moment);
  for (int side = 0; side < 2; side++) {
    const double spin[3] = {w[0][0] - w[side][0], w[0][1] - w[side][1], w[0][2] - w[side][2]};
    baum_i_cross(spin, ground, one);
    baum_i_add_scaled3(1.0, moment, one);
    baum_i_turn_back(b->pair.frame[side]->axes, one, other);
    for (int i = 0; i < 3; i++) {
      square[COLUMNS * (SIX * side + 3 + i) + j] += side == 0 ? other[i] : -other[i];
    }
  }
}

/* Subtracts H^T x from `square`. The matrix x has six rows. */
static void subtract_product(const bushing *b, const double *x, double *square)
{
  for (int i = 0; i < COLUMNS; i++) {
    for (int k = 0; k < SIX; k++) {
      for (int j = 0; j < COLUMNS; j++) {
        square[COLUMNS * i + j] -= b->h[COLUMNS * k + i] * x[COLUMNS * k + j];
      }
    }
  }
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  const bushing b = bushing_at(element, point);
  double rate_q[SIX * COLUMNS] = {0.0}, f_q[SIX * COLUMNS] = {0.0}, f_v[SIX * COLUMNS] = {0.0};
  double force_q[COLUMNS * COLUMNS] = {0.0}, force_v[COLUMNS * COLUMNS] = {0.0};
  add_displacement(&b, rate_q, force_q);
  for (int j = 0; j < COLUMNS; j++) {
    add_rotation(&b, j, rate_q, force_q);
    multiply(b.stiffness, b.h + j, COLUMNS, f_q + j);
    multiply(b.damping, rate_q + j, COLUMNS, f_q + j);
    multiply(b.damping, b.h + j, COLUMNS, f_v + j);
  }
  subtract_product(&b, f_q, force_q);
  subtract_product(&b, f_v, force_v);
  const baum_mechanism *m = point->mechanism;
  baum_i_columns_pack_force(m, element, BAUM_I_SPACE, force_q, blocks->force_q);
  baum_i_columns_pack_force(m, element, BAUM_I_SPACE, force_v, blocks->force_v);
  return BAUM_OK;
}

/* ---- type ---- */

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int n = 0; n < group->count; n++) {
    const bushing b = bushing_at(group->forces[n], point);
    double wide[COLUMNS] = {0.0};
    for (int i = 0; i < SIX; i++) {
      for (int j = 0; j < COLUMNS; j++) {
        wide[j] -= b.h[COLUMNS * i + j] * b.f[i];
      }
    }
    baum_i_columns_scatter_any(point->mechanism, &group->forces[n]->span, BAUM_I_SPACE, wide, out);
  }
  return BAUM_OK;
}

static bool depends_on_velocity(const baum_i_force *force)
{
  const baum_spatial_bushing_def *def = force->element.def;
  bool damps = false;
  for (int i = 0; i < MATRIX; i++) {
    damps = damps || def->damping[i] != 0.0;
  }
  return damps;
}

static double quadratic(const double m[MATRIX], const double x[SIX])
{
  double product[SIX] = {0.0}, sum = 0.0;
  multiply(m, x, 1, product);
  for (int i = 0; i < SIX; i++) {
    sum += x[i] * product[i];
  }
  return sum;
}

static baum_status potential(const baum_i_force *element, baum_i_point *point, double *sum)
{
  const bushing b = bushing_at(element, point);
  *sum += 0.5 * quadratic(b.stiffness, b.x);
  return BAUM_OK;
}

static baum_status power(const baum_i_force *element, baum_i_point *point,
                         double sum[BAUM_I_POWERS])
{
  const bushing b = bushing_at(element, point);
  sum[BAUM_I_POWER_DAMPERS] -= quadratic(b.damping, b.rate);
  return BAUM_OK;
}

/* ---- jumps at pi ---- */

static void rotation_at(const baum_i_force *element, const baum_i_point *point, const double *q,
                        double theta[3])
{
  double r[9];
  baum_i_spatial_relative_axes(element, point, q, r);
  const turn t = turn_of(r);
  memcpy(theta, t.theta, sizeof t.theta);
}

/* theta reverses its direction when the angle passes pi. A bushing whose moments are zero does not
 * jump. The diagonal of a semidefinite matrix tells which of its rows are zero. */
static bool jumps(const baum_i_force *element, const baum_i_point *point, const double *from,
                  const double *to)
{
  const double *numbers = point->parameters + element->element.parameter;
  double before[3], after[3], largest = 0.0;
  for (int i = 3; i < SIX; i++) {
    const int k = (SIX + 1) * i;
    largest = fmax(largest, fmax(numbers[STIFFNESS + k], numbers[DAMPING + k]));
  }
  if (largest == 0.0) {
    return false;
  }
  rotation_at(element, point, to, after);
  const double quarter = 0.25 * BAUM_I_REVOLUTION;
  if (baum_i_dot3(after, after) < quarter * quarter) {
    return false;
  }
  rotation_at(element, point, from, before);
  return baum_i_dot3(before, before) > quarter * quarter && baum_i_dot3(before, after) < 0.0;
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(spatial_bushing, "spatial bushing", fields), .check = check,
                 .parameter_count = PARAMETER_COUNT},
  .spatial = true,
  .lower = lower,
  .force = force,
  .depends_on_velocity = depends_on_velocity,
  .potential = potential,
  .linearize = linearize,
  .power = power,
  .jumps = jumps,
};

BAUM_I_DEFINE(force, spatial_bushing, type)
