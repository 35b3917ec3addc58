/* SPDX-License-Identifier: BSD-3-Clause */
/* Spatial joints whose last row is composed of several products (spatial_rows.h): the screw and the
 * constant-velocity joint. All other rows are products.
 *
 *   screw              Phi = d - offset - pitch angle / (2 pi)
 *   constant velocity  Phi = y_a . x_b - x_a . y_b
 *
 * In the screw, d and the angle are the coordinates of a cylindrical joint. Positions determine the
 * angle only up to whole revolutions, and therefore Phi only up to multiples of the pitch. The
 * value of Phi that is nearest to 0 is used.
 *
 * In the constant-velocity joint, Phi is 4 p_w p_z with the quaternion p of the relative rotation
 * (see spatial_torsion_spring.c). If Phi is 0 because p_z is 0, the axis of the relative rotation
 * is normal to z_a, and the relative angular velocity is normal to z_a + z_b (K. H. Hunt,
 * Constant-velocity shaft couplings: a general theory, J. Eng. Ind. 95, 1973). Shafts with fixed
 * axes therefore rotate with equal angular velocities. Phi is also 0 if p_w is 0, which is the case
 * after one shaft is rotated by pi about its axis; x_a . x_b + y_a . y_b is negative there. */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/spatial/spatial_joint.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

/* Parameters of a screw, after the points and axes. */
enum { PITCH = BAUM_I_SPATIAL_NUMBERS, OFFSET, SCREW_COUNT };

/* ---- rows of both joints ---- */

/* A joint, together with the state (point) in which it is evaluated. */
typedef struct state {
  const baum_i_joint *joint;
  const baum_i_point *point;
  const double *numbers;
  baum_i_spatial_pair pair;
} state;

/* The type of a joint whose last row is a sum of two terms. */
typedef struct coupled_type {
  baum_i_spatial_joint_type spatial;
  /* Evaluate term `number` (0 or 1), multiplied by its factor. */
  void (*term)(const state *s, int number, baum_i_coordinate *out);
  /* Compute the second derivatives of this term. w has twelve entries. */
  void (*term_linearize)(const state *s, int number, const double *w, double lambda,
                         baum_i_coordinate_blocks *out);
  /* Return Phi. `sum` is the sum of the values of both terms. */
  double (*phi)(const state *s, double sum);
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

static void scale(double factor, baum_i_coordinate *c)
{
  c->value *= factor;
  c->rate *= factor;
  c->gamma *= factor;
  for (int k = 0; k < COLUMNS; k++) {
    c->gradient[k] *= factor;
  }
}

static void row_at(const state *s, int number, baum_i_coordinate *out)
{
  const coupled_type *type = type_of(s->joint);
  if (number < s->joint->rows - 1) {
    baum_i_spatial_row_at(&s->pair, type->spatial.rows[number], out);
    return;
  }
  baum_i_coordinate other;
  type->term(s, 0, out);
  type->term(s, 1, &other);
  out->value = type->phi(s, out->value + other.value);
  out->rate += other.rate;
  out->gamma += other.gamma;
  for (int k = 0; k < COLUMNS; k++) {
    out->gradient[k] += other.gradient[k];
  }
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
  for (int n = 0; n < 2; n++) {
    baum_i_coordinate_blocks term;
    type->term_linearize(&s, n, w_wide, lambda ? lambda[joint->row + last] : 0.0, &term);
    for (int k = 0; k < COLUMNS; k++) {
      jw_q[at + k] += term.jw_q[k];
      gamma_q[at + k] += term.gamma_q[k];
      gamma_v[at + k] += term.gamma_v[k];
    }
    for (int k = 0; k < COLUMNS * COLUMNS; k++) {
      jtl_q[k] += term.jtl_q[k];
    }
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
#define COUPLED(NAME, TITLE, LOWER, ROWS, COUNT, REVERSED, FIELDS)                             \
  .definition = {BAUM_I_DEFINITION(NAME, TITLE, FIELDS), .check = baum_i_spatial_check_axes,   \
                 .parameter_count = (COUNT)},                                                  \
  .width = BAUM_I_SPACE, .scleronomic = true, .row_count = (ROWS), .lower = (LOWER),           \
  .extent = baum_i_spatial_extent, .evaluate = baum_i_evaluate_each, .evaluate_one = evaluate, \
  .linearize = linearize, .place = baum_i_spatial_place, .force_on_b = force_on_b,             \
  .is_reversed = (REVERSED)

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

/* Return the factor of a term. Term 0 is the displacement, and term 1 is the angle, each multiplied
 * by its factor. */
static double factor_of(const state *s, int number)
{
  return number == 0 ? 1.0 : -s->numbers[PITCH] / BAUM_I_REVOLUTION;
}

static void screw_term(const state *s, int number, baum_i_coordinate *out)
{
  const baum_i_joint_coordinate c = {s->joint, number};
  baum_i_coordinate_near_zero(&c, s->point, out);
  scale(factor_of(s, number), out);
}

static void screw_linearize(const state *s, int number, const double *w, double lambda,
                            baum_i_coordinate_blocks *out)
{
  const double factor = factor_of(s, number);
  baum_i_spatial_coordinate_linearize(s->joint, number, s->point, w, factor * lambda, out);
  for (int k = 0; k < COLUMNS; k++) {
    out->jw_q[k] *= factor;
    out->gamma_q[k] *= factor;
    out->gamma_v[k] *= factor;
  }
}

static double screw_phi(const state *s, double sum)
{
  return remainder(sum - s->numbers[OFFSET], s->numbers[PITCH]);
}

static const baum_i_def_field screw_fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_screw_def),
  BAUM_I_NUMBERS(baum_spatial_screw_def, pitch, NOT_ZERO, "m", 0.0),
  BAUM_I_OPTIONAL(baum_spatial_screw_def, offset, OPTIONAL, "m"),
  {0},
};

static const coupled_type screw = {
  {{COUPLED(spatial_screw, "spatial screw", lower_screw, 5, SCREW_COUNT, baum_i_spatial_is_reversed,
            screw_fields),
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
  .term = screw_term,
  .term_linearize = screw_linearize,
  .phi = screw_phi,
};

BAUM_I_DEFINE(joint, spatial_screw, screw.spatial.type)

/* ---- constant-velocity joint ---- */

static const baum_i_spatial_row TWIST[2] = {{BAUM_I_Y_A, BAUM_I_X_B}, {BAUM_I_X_A, BAUM_I_Y_B}};

static void twist_term(const state *s, int number, baum_i_coordinate *out)
{
  baum_i_spatial_row_at(&s->pair, TWIST[number], out);
  scale(number == 0 ? 1.0 : -1.0, out);
}

static void twist_linearize(const state *s, int number, const double *w, double lambda,
                            baum_i_coordinate_blocks *out)
{
  const double sign = number == 0 ? 1.0 : -1.0;
  baum_i_spatial_row_linearize(&s->pair, TWIST[number], w, sign * lambda, out);
  for (int k = 0; k < COLUMNS; k++) {
    out->jw_q[k] *= sign;
    out->gamma_q[k] *= sign;
    out->gamma_v[k] *= sign;
  }
}

static double twist_phi(const state *s, double sum)
{
  (void)s;
  return sum;
}

static bool is_half_turned(const baum_i_joint *joint, const baum_i_point *point)
{
  const state s = state_at(joint, point);
  const baum_i_spatial_row x = {BAUM_I_X_A, BAUM_I_X_B}, y = {BAUM_I_Y_A, BAUM_I_Y_B};
  return baum_i_spatial_product(&s.pair, x) + baum_i_spatial_product(&s.pair, y) < 0.0;
}

static const baum_i_def_field shaft_fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_constant_velocity_def),
  {0},
};

static const coupled_type constant_velocity = {
  {{COUPLED(spatial_constant_velocity, "spatial constant-velocity joint", lower_axes, 4,
            BAUM_I_SPATIAL_NUMBERS, is_half_turned, shaft_fields)},
   .rows = {{BAUM_I_X_GROUND, BAUM_I_APART},
            {BAUM_I_Y_GROUND, BAUM_I_APART},
            {BAUM_I_Z_GROUND, BAUM_I_APART}}},
  .term = twist_term,
  .term_linearize = twist_linearize,
  .phi = twist_phi,
};

BAUM_I_DEFINE(joint, spatial_constant_velocity, constant_velocity.spatial.type)
