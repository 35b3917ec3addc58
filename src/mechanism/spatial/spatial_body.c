/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies in space. A particle has q = r and v = r'. A rigid body has q = (r, p) and v = (r', w).
 * Here r is the centre of mass in ground axes, p is a unit quaternion, and w is the angular
 * velocity in body axes. m is the mass, I the inertia tensor in body axes, and E the unit matrix.
 *
 *   p' = p o (0, w) / 2,  where o is the product of quaternions
 *   M = diag(m E, I), constant; for a particle M = m E
 *   g  = (m gravity, -w x (I w)),   g_w = [I w]x - [w]x I;   V = -m gravity . r;   [a]x b = a x b
 *
 * A displacement is (dr, dth) with the rotation vector dth in body axes. It changes p to
 * p o exp(dth). The displacement from p_1 to p_2 is the logarithm of p_1^-1 o p_2.
 */
#include <string.h>

#include <baum/spatial.h>

#include "base/message.h"
#include "base/rotation.h"
#include "mechanism/definition.h"

/* Parameters. Only rigid bodies have the parameter INERTIA, which is a 3 x 3 matrix. */
enum { MASS, INERTIA, PARAMETER_COUNT = INERTIA + 9 };

/* The length of a given quaternion may differ from 1 by this much, because a user may type only a
 * few digits. */
static const double NEAR_UNIT = 1e-6;

/* The smallest principal moment that a body may have, relative to its largest one. It replaces the
 * moment of a slender rod about its axis, because a zero moment would make M singular. In Bricard's
 * mechanism of such rods, this causes an error of only 2e-11 m after 5 s. */
static const double SMALLEST_MOMENT = 1e-10;
static const double ROUNDING = 1e-9;

static const baum_i_def_field body_fields[] = {
  BAUM_I_NUMBERS(baum_spatial_body_def, mass, POSITIVE, "kg", 1.0),
  BAUM_I_NUMBERS(baum_spatial_body_def, inertia, FINITE, "kg m^2", 1.0, 1.0, 1.0),
  BAUM_I_NUMBERS(baum_spatial_body_def, position, FINITE, "m", 0.0),
  BAUM_I_NUMBERS(baum_spatial_body_def, orientation, FINITE, "", 1.0),
  BAUM_I_OPTIONAL(baum_spatial_body_def, velocity, FREE, "m/s"),
  BAUM_I_OPTIONAL(baum_spatial_body_def, angular_velocity, FREE, "rad/s"),
  BAUM_I_FIELD(baum_spatial_body_def, held, START_FLAG),
  {0},
};

/* ---- definition ---- */

/* Computes the 3 x 3 inertia matrix from the entries xx, yy, zz, xy, xz, yz. */
static void matrix_of(const double inertia[6], double out[9])
{
  static const int places[9] = {0, 3, 4, 3, 1, 5, 4, 5, 2};
  for (int i = 0; i < 9; i++) {
    out[i] = inertia[places[i]];
  }
}

static baum_status check_inertia(const baum_spatial_body_def *def, const char *label)
{
  double matrix[9];
  double m[3];
  double axes[9];
  matrix_of(def->inertia, matrix);
  baum_i_principal_axes(matrix, m, axes);
  if (!(m[1] > ROUNDING * m[2] && m[0] >= -ROUNDING * m[2])) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: inertia has the principal moments %g, %g and %g kg m^2; two must be "
                       "> 0, and none < 0",
                       label, m[0], m[1], m[2]);
  }
  if (!(m[2] - m[1] <= m[0] + ROUNDING * m[2])) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: inertia has the principal moments %g, %g and %g kg m^2; none may be "
                       "larger than the sum of the other two",
                       label, m[0], m[1], m[2]);
  }
  return BAUM_OK;
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  (void)mechanism;
  const baum_spatial_body_def *def = given;
  double length = baum_i_quaternion_length(def->orientation);
  if (!(fabs(length - 1.0) <= NEAR_UNIT)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: orientation has the length %.9g, must be 1 within 1e-6: a unit "
                       "quaternion w, x, y, z",
                       label, length);
  }
  return check_inertia(def, label);
}

static void lower(const baum_i_body *body, double *parameters)
{
  const baum_spatial_body_def *def = body->element.def;
  double moments[3];
  double axes[9];
  parameters[MASS] = def->mass;
  matrix_of(def->inertia, parameters + INERTIA);
  baum_i_principal_axes(parameters + INERTIA, moments, axes);
  double missing = fmax(0.0, SMALLEST_MOMENT * moments[2] - moments[0]);
  for (int i = 0; i < 9; i += 4) {
    parameters[INERTIA + i] += missing;
  }
}

static void design(const void *given, double *q, double *v, bool *held)
{
  const baum_spatial_body_def *def = given;
  memcpy(q, def->position, sizeof def->position);
  memcpy(q + 3, def->orientation, sizeof def->orientation);
  baum_i_quaternion_normalize(q + 3);
  memcpy(v, def->velocity, sizeof def->velocity);
  memcpy(v + 3, def->angular_velocity, sizeof def->angular_velocity);
  *held = def->held;
}

static void scale(const void *def, double length, double *out)
{
  (void)def;
  for (int i = 0; i < 6; i++) {
    out[i] = i < 3 ? length : 1.0;
  }
}

static void position_scale(const void *def, double length, double *out)
{
  (void)def;
  for (int i = 0; i < 7; i++) {
    out[i] = i < 3 ? length : 0.5;
  }
}

/* ---- the manifold ---- */

static void rate(const baum_i_body *body, const double *q, const double *v, double *dq)
{
  (void)body;
  const double half[4] = {0.0, 0.5 * v[3], 0.5 * v[4], 0.5 * v[5]};
  memcpy(dq, v, 3 * sizeof *dq);
  baum_i_quaternion_product(q + 3, half, dq + 3);
}

static void move(const baum_i_body *body, double h, const double *v, double *q)
{
  (void)body;
  const double rotation[3] = {h * v[3], h * v[4], h * v[5]};
  double p[4];
  double turn[4];
  for (int i = 0; i < 3; i++) {
    q[i] += h * v[i];
  }
  memcpy(p, q + 3, sizeof p);
  baum_i_quaternion_exp(rotation, turn);
  baum_i_quaternion_product(p, turn, q + 3);
}

static void difference(const baum_i_body *body, const double *from, const double *to, double *dx)
{
  (void)body;
  const double back[4] = {from[3], -from[4], -from[5], -from[6]};
  double turn[4];
  for (int i = 0; i < 3; i++) {
    dx[i] = to[i] - from[i];
  }
  baum_i_quaternion_product(back, to + 3, turn);
  baum_i_quaternion_log(turn, dx + 3);
}

static void normalize(const baum_i_body *body, double *q)
{
  (void)body;
  baum_i_quaternion_normalize(q + 3);
}

/* With omega = (0, w), p' = p omega / 2 gives p'' = p omega' / 2 - |omega|^2 p / 4. */
static void second_rate(const baum_i_body *body, const double *q, const double *v, const double *a,
                        double *ddq)
{
  rate(body, q, a, ddq);
  for (int i = 3; i < 7; i++) {
    ddq[i] -= 0.25 * baum_i_dot3(v + 3, v + 3) * q[i];
  }
}

static void tangent(const baum_i_body *body, const double *q, const double *dq, double *dx)
{
  (void)body;
  double square = q[3] * q[3] + baum_i_dot3(q + 4, q + 4);
  const double back[4] = {q[3] / square, -q[4] / square, -q[5] / square, -q[6] / square};
  double half[4];
  baum_i_quaternion_product(back, dq + 3, half);
  for (int i = 0; i < 3; i++) {
    dx[i] = dq[i];
    dx[3 + i] = 2.0 * half[1 + i];
  }
}

static const baum_i_manifold *manifold(const void *def)
{
  static const baum_i_manifold rotations = {.rate = rate,
                                            .move = move,
                                            .difference = difference,
                                            .normalize = normalize,
                                            .second_rate = second_rate,
                                            .tangent = tangent};
  (void)def;
  return &rotations;
}

/* ---- evaluation ---- */

static baum_status body_masses(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    const double *numbers = point->parameters + body->element.parameter;
    double *block = out + body->mass;
    memset(block, 0, 36 * sizeof *block);
    for (int k = 0; k < 3; k++) {
      block[7 * k] = numbers[MASS];
      memcpy(block + 6 * (3 + k) + 3, numbers + INERTIA + (ptrdiff_t)3 * k, 3 * sizeof *block);
    }
  }
  return BAUM_OK;
}

/* Only the gyroscopic moment depends on the velocity. It is zero if I is a multiple of the unit
 * matrix E. */
static bool depends_on_velocity(const void *given)
{
  const baum_spatial_body_def *def = given;
  const double *x = def->inertia;
  return x[0] != x[1] || x[1] != x[2] || x[3] != 0.0 || x[4] != 0.0 || x[5] != 0.0;
}

static const double *inertia(const baum_i_body *body, const double *parameters)
{
  return parameters + body->element.parameter + INERTIA;
}

static double mass_of(const baum_i_body *body, const baum_i_point *point)
{
  return point->parameters[body->element.parameter + MASS];
}

static baum_status force_of_gravity(const baum_i_body_group *group, baum_i_point *point,
                                    double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    baum_i_add_scaled3(mass_of(body, point), point->mechanism->gravity, out + body->v);
  }
  return BAUM_OK;
}

static baum_status potential(const baum_i_body *body, baum_i_point *point, double *sum)
{
  *sum -= mass_of(body, point) * baum_i_dot3(point->mechanism->gravity, point->q + body->q);
  return BAUM_OK;
}

static baum_status force(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; point->v && i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    const double *w = point->v + body->v + 3;
    double momentum[3];
    double gyroscopic[3];
    baum_i_turn(inertia(body, point->parameters), w, momentum);
    baum_i_cross(momentum, w, gyroscopic);
    const double *moment = point->moments ? point->moments + body->v + 3 : gyroscopic;
    baum_i_add_scaled3(1.0, moment, out + body->v + 3);
  }
  return force_of_gravity(group, point, out);
}

/* Computes g_w. Its column j is (I e_j) x w + (I w) x e_j. */
static baum_status linearize(const baum_i_body *body, baum_i_point *point, const double *a,
                             const baum_i_body_blocks *blocks)
{
  (void)a;
  const double *tensor = inertia(body, point->parameters);
  const double *w = point->v + body->v + 3;
  double momentum[3];
  if (!blocks->force_v) {
    return BAUM_OK;
  }
  baum_i_turn(tensor, w, momentum);
  for (int j = 0; j < 3; j++) {
    const double axis[3] = {j == 0, j == 1, j == 2};
    double column[3];
    double first[3];
    double second[3];
    baum_i_turn(tensor, axis, column);
    baum_i_cross(column, w, first);
    baum_i_cross(momentum, axis, second);
    for (int i = 0; i < 3; i++) {
      blocks->force_v[body->mass + 6 * (3 + i) + 3 + j] = first[i] + second[i];
    }
  }
  return BAUM_OK;
}

static const baum_i_body_type body_type = {
  .definition = {BAUM_I_DEFINITION(spatial_body, "spatial body", body_fields), .check = check,
                 .parameter_count = PARAMETER_COUNT},
  .frame = BAUM_I_FRAME_SPATIAL_BODY,
  .scleronomic = true,
  .nq = 7,
  .nv = 6,
  .manifold = manifold,
  .depends_on_velocity = depends_on_velocity,
  .inertia = inertia,
  .lower = lower,
  .design = design,
  .scale = scale,
  .position_scale = position_scale,
  .mass = body_masses,
  .force = force,
  .potential = potential,
  .linearize = linearize,
};

BAUM_I_DEFINE(body, spatial_body, body_type)

/* ---- particles ---- */

static const baum_i_def_field particle_fields[] = {
  BAUM_I_NUMBERS(baum_spatial_particle_def, mass, POSITIVE, "kg", 1.0),
  BAUM_I_NUMBERS(baum_spatial_particle_def, position, FINITE, "m", 0.0),
  BAUM_I_OPTIONAL(baum_spatial_particle_def, velocity, FREE, "m/s"),
  BAUM_I_FIELD(baum_spatial_particle_def, held, START_FLAG),
  {0},
};

static void lower_particle(const baum_i_body *body, double *parameters)
{
  const baum_spatial_particle_def *def = body->element.def;
  parameters[MASS] = def->mass;
}

static void design_particle(const void *given, double *q, double *v, bool *held)
{
  const baum_spatial_particle_def *def = given;
  memcpy(q, def->position, sizeof def->position);
  memcpy(v, def->velocity, sizeof def->velocity);
  *held = def->held;
}

static void scale_particle(const void *def, double length, double *out)
{
  (void)def;
  for (int i = 0; i < 3; i++) {
    out[i] = length;
  }
}

static baum_status particle_masses(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    double *block = out + body->mass;
    memset(block, 0, 9 * sizeof *block);
    for (int k = 0; k < 9; k += 4) {
      block[k] = mass_of(body, point);
    }
  }
  return BAUM_OK;
}

static const baum_i_body_type particle_type = {
  .definition = {BAUM_I_DEFINITION(spatial_particle, "spatial particle", particle_fields),
                 .parameter_count = 1},
  .frame = BAUM_I_FRAME_SPATIAL_PARTICLE,
  .scleronomic = true,
  .constant_force = true,
  .nq = 3,
  .nv = 3,
  .lower = lower_particle,
  .design = design_particle,
  .scale = scale_particle,
  .mass = particle_masses,
  .force = force_of_gravity,
  .potential = potential,
};

BAUM_I_DEFINE(body, spatial_particle, particle_type)
