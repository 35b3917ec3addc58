/* SPDX-License-Identifier: BSD-3-Clause */
/* User coordinates are any number of generalized coordinates q with velocities v. User functions
 * compute their mass matrix M(q, t) and their force g(q, v, t). Either v = q', or q' = N(q) v,
 * where the user functions of coordinates_manifold.c define N.
 *
 * All derivatives of M a, where a is the acceleration v', are finite differences (difference.c).
 * Derivatives of g are finite differences, too, unless a user function computes them.
 */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/general/coordinates_manifold.h"
#include "mechanism/general/given_force.h"

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_coordinates_def, size, COUNT),
  BAUM_I_ARRAY(baum_coordinates_def, q, ARRAY, FINITE, position_count, size),
  BAUM_I_ARRAY(baum_coordinates_def, v, ARRAY, FREE, size, size),
  BAUM_I_ARRAY(baum_coordinates_def, scale, ARRAY, POSITIVE, size, size),
  BAUM_I_FIELD(baum_coordinates_def, mass, FUNCTION),
  BAUM_I_FIELD(baum_coordinates_def, force, FUNCTION),
  BAUM_I_FIELD(baum_coordinates_def, force_q, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_coordinates_def, force_v, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_coordinates_def, potential, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_coordinates_def, constant_mass, FLAG),
  BAUM_I_FIELD(baum_coordinates_def, held, START_FLAG),
  BAUM_I_FIELD(baum_coordinates_def, user, USER),
  BAUM_I_FIELD(baum_coordinates_def, depends_on_velocity, CLAIM),
  BAUM_I_ARRAY(baum_coordinates_def, position_scale, ARRAY, POSITIVE, position_count, size),
  BAUM_I_FIELD(baum_coordinates_def, rate, KEPT_FUNCTION),
  BAUM_I_FIELD(baum_coordinates_def, move, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_coordinates_def, difference, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_coordinates_def, normalize, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_coordinates_def, position_count, OPTIONAL_COUNT),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  (void)mechanism;
  const baum_coordinates_def *def = given;
  if (baum_i_coordinates_positions(def) < def->size) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: position_count is %d, must be at least size (%d)",
                       label, (int)def->position_count, (int)def->size);
  }
  return baum_i_coordinates_check_manifold(def, label);
}

static int size(const void *given)
{
  const baum_coordinates_def *def = given;
  return def->size;
}

static int positions(const void *given)
{
  return baum_i_coordinates_positions(given);
}

static bool depends_on_velocity(const void *given)
{
  const baum_coordinates_def *def = given;
  return def->depends_on_velocity;
}

static bool constant_mass(const void *given)
{
  const baum_coordinates_def *def = given;
  return def->constant_mass;
}

static void design(const void *given, double *q, double *v, bool *held)
{
  const baum_coordinates_def *def = given;
  for (int i = 0; i < baum_i_coordinates_positions(def); i++) {
    q[i] = def->q ? def->q[i] : 0.0;
  }
  for (int i = 0; i < def->size; i++) {
    v[i] = def->v ? def->v[i] : (double)NAN;
  }
  *held = def->held;
}

static void scale(const void *given, double length, double *out)
{
  (void)length;
  const baum_coordinates_def *def = given;
  for (int i = 0; i < def->size; i++) {
    out[i] = def->scale ? def->scale[i] : 1.0;
  }
}

static void position_scale(const void *given, double length, double *out)
{
  (void)length;
  const baum_coordinates_def *def = given;
  for (int i = 0; i < baum_i_coordinates_positions(def); i++) {
    out[i] = def->position_scale ? def->position_scale[i] : 1.0;
  }
}

/* ---- calls ---- */

static const baum_coordinates_def *def_of(const baum_i_body *body)
{
  return body->element.def;
}

static baum_i_user_function function(const baum_i_body *body, const char *name, int row_count,
                                     int cols)
{
  return (baum_i_user_function){&body->element, name, row_count, cols, def_of(body)->user};
}

static baum_status mass_at(const baum_i_body *body, const baum_i_local *at, double *out)
{
  baum_i_user_function f = function(body, "mass", body->nv, body->nv);
  return baum_i_call_q(&f, def_of(body)->mass, at, out);
}

static baum_i_given_force given_force(const baum_i_body *body)
{
  return BAUM_I_GIVEN_FORCE(&body->element, def_of(body));
}

/* ---- evaluation ---- */

static baum_status mass(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    baum_i_local at = baum_i_gather(point, &body->span);
    BAUM_I_TRY(mass_at(body, &at, out + body->mass));
  }
  return BAUM_OK;
}

static baum_status force(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    baum_i_local at = baum_i_gather(point, &body->span);
    double *value = baum_i_take(&at, body->nv);
    baum_i_given_force f = given_force(body);
    BAUM_I_TRY(baum_i_given_force_at(&f, &at, value));
    for (int j = 0; j < body->nv; j++) {
      out[body->v + j] += value[j];
    }
  }
  return BAUM_OK;
}

static baum_status potential(const baum_i_body *body, baum_i_point *point, double *sum)
{
  baum_i_given_force f = given_force(body);
  baum_i_local at = baum_i_gather(point, &body->span);
  return baum_i_given_force_potential(&f, &at, sum);
}

/* ---- derivatives ---- */

/* Compute the kinetic energy v^T M v / 2 as a function of q and t. */
static baum_status kinetic_field(const void *context, const baum_i_local *at, double *out)
{
  const baum_i_body *body = context;
  int n = body->nv;
  baum_i_local here = *at;
  double *block = baum_i_take(&here, n * n);
  BAUM_I_TRY(mass_at(body, &here, block));
  *out = 0.0;
  for (int i = 0; i < n * n; i++) {
    *out += 0.5 * at->v[i / n] * block[i] * at->v[i % n];
  }
  return BAUM_OK;
}

/* Compute v^T M' v / 2 along the motion. */
static baum_status kinetic_rate(const baum_i_body *body, const baum_i_local *at, double *out)
{
  double rate = baum_i_local_rate(at);
  *out = 0.0;
  if (def_of(body)->constant_mass || rate == 0.0) {
    return BAUM_OK;
  }
  baum_i_field field = {.evaluate = kinetic_field, .context = body, .size = 1};
  baum_i_ray ray = {.dt = 1.0, .dq = at->v, .rate = fmax(rate, 1.0)};
  return baum_i_difference_first(&field, &ray, at, out);
}

static baum_status power(const baum_i_body *body, baum_i_point *point, double sum[BAUM_I_POWERS])
{
  baum_i_given_force f = given_force(body);
  baum_i_local at = baum_i_gather(point, &body->span);
  double rate = 0.0;
  BAUM_I_TRY(baum_i_given_force_power(&f, &at, &sum[BAUM_I_POWER_BODIES]));
  BAUM_I_TRY(kinetic_rate(body, &at, &rate));
  sum[BAUM_I_POWER_BODIES] += rate;
  return BAUM_OK;
}

/* Context for M a as a function of q and t. */
typedef struct inertia {
  const baum_i_body *body;
  const double *a;
} inertia;

static baum_status inertia_field(const void *context, const baum_i_local *at, double *out)
{
  const inertia *m = context;
  int n = m->body->nv;
  baum_i_local here = *at;
  double *block = baum_i_take(&here, n * n);
  BAUM_I_TRY(mass_at(m->body, &here, block));
  for (int i = 0; i < n; i++) {
    out[i] = 0.0;
    for (int j = 0; j < n; j++) {
      out[i] += block[i * n + j] * m->a[j];
    }
  }
  return BAUM_OK;
}

static baum_status inertia_block(const baum_i_body *body, const baum_i_local *at, const double *a,
                                 double *out)
{
  if (def_of(body)->constant_mass) {
    memset(out, 0, (size_t)body->nv * (size_t)body->nv * sizeof *out);
    return BAUM_OK;
  }
  inertia m = {body, a};
  baum_i_field field = {.evaluate = inertia_field, .context = &m, .size = body->nv};
  return baum_i_difference_columns(&field, BAUM_I_VARIABLE_Q, at, out);
}

static baum_status linearize(const baum_i_body *body, baum_i_point *point, const double *a,
                             const baum_i_body_blocks *blocks)
{
  baum_i_local at = baum_i_gather(point, &body->span);
  const double *own_a = baum_i_gather_vector(&at, &body->span, a);
  if (blocks->ma_q) {
    BAUM_I_TRY(inertia_block(body, &at, own_a, blocks->ma_q + body->mass));
  }
  baum_i_given_force f = given_force(body);
  double *force_q = baum_i_block_at(blocks->force_q, body->mass);
  double *force_v = baum_i_block_at(blocks->force_v, body->mass);
  BAUM_I_TRY(baum_i_given_force_block(&f, &at, BAUM_I_VARIABLE_Q, force_q));
  return baum_i_given_force_block(&f, &at, BAUM_I_VARIABLE_V, force_v);
}

/* ---- checks of the user's functions ---- */

static baum_status check_symmetry(const baum_i_body *body, const double *block)
{
  int n = body->nv;
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < i; j++) {
      double a = block[i * n + j];
      double b = block[j * n + i];
      /* The tolerance is much larger than rounding errors, even if large terms cancel, and much
       * smaller than the effect of any mistake. */
      double size = sqrt(fabs(block[i * n + i] * block[j * n + j]));
      if (fabs(a - b) > 1e-6 * fmax(fabs(a), fabs(b)) + 1e-9 * size) {
        return baum_i_fail(BAUM_ERR_ARGUMENT,
                           "%s: mass()[%d][%d] is %.9g but mass()[%d][%d] is %.9g; the mass matrix "
                           "must be symmetric",
                           baum_i_label(&body->element).text, i, j, a, j, i, b);
      }
    }
  }
  return BAUM_OK;
}

/* Check that the diagonal of M is not negative. Only the design configuration is checked, because M
 * may be meaningless at other coordinates. */
static baum_status check_sign(const baum_i_body *body, const baum_i_local *at, const double *block)
{
  int n = body->nv;
  const double *design_q = at->point->mechanism->design_q + body->q;
  bool design_pose = memcmp(at->q, design_q, (size_t)body->nq * sizeof *design_q) == 0;
  baum_i_user_function f = function(body, "mass", n, n);
  for (int i = 0; i < n && design_pose; i++) {
    if (block[i * (n + 1)] < 0.0) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s is %.9g in the design configuration, must be >= 0",
                         baum_i_user_entry(&f, i * (n + 1)).text, block[i * (n + 1)]);
    }
  }
  return BAUM_OK;
}

/* Check that the mass matrix is constant, as constant_mass states. For this purpose, M is compared
 * with its value in the design configuration at t = 0. */
static baum_status check_constant(const baum_i_body *body, const baum_i_local *at,
                                  const double *block)
{
  int n = body->nv;
  baum_i_local here = *at;
  here.t = 0.0;
  here.q = at->point->mechanism->design_q + body->q;
  double *there = baum_i_take(&here, n * n);
  BAUM_I_TRY(mass_at(body, &here, there));
  baum_i_user_function f = function(body, "mass", n, n);
  for (int i = 0; i < n * n; i++) {
    double size = sqrt(fabs(block[i / n * (n + 1)] * block[i % n * (n + 1)]));
    if (fabs(block[i] - there[i]) > 1e-9 * (fabs(block[i]) + size)) {
      return baum_i_fail(
        BAUM_ERR_ARGUMENT,
        "%s is %.9g in the design configuration and %.9g near it, but constant_mass is true",
        baum_i_user_entry(&f, i).text, there[i], block[i]);
    }
  }
  return BAUM_OK;
}

static baum_status check_mass(const baum_i_body *body, const baum_i_local *at)
{
  baum_i_local here = *at;
  double *block = baum_i_take(&here, body->nv * body->nv);
  BAUM_I_TRY(mass_at(body, &here, block));
  BAUM_I_TRY(check_symmetry(body, block));
  BAUM_I_TRY(check_sign(body, &here, block));
  if (def_of(body)->constant_mass) {
    BAUM_I_TRY(check_constant(body, &here, block));
  }
  return BAUM_OK;
}

static baum_status check_derivatives(const void *given, baum_i_point *point)
{
  const baum_i_body *body = given;
  baum_i_local at = baum_i_gather(point, &body->span);
  BAUM_I_TRY(baum_i_coordinates_compare_manifold(body, &at));
  BAUM_I_TRY(check_mass(body, &at));
  baum_i_given_force f = given_force(body);
  return baum_i_given_force_check(&f, &at);
}

static const baum_i_body_type type = {
  .definition = {BAUM_I_DEFINITION(coordinates, "user coordinates", fields), .check = check,
                 .check_derivatives = check_derivatives},
  .frame = BAUM_I_FRAME_NONE,
  .size = size,
  .positions = positions,
  .manifold = baum_i_coordinates_manifold,
  .constant_mass = constant_mass,
  .depends_on_velocity = depends_on_velocity,
  .design = design,
  .scale = scale,
  .position_scale = position_scale,
  .mass = mass,
  .force = force,
  .potential = potential,
  .linearize = linearize,
  .power = power,
};

BAUM_I_DEFINE(body, coordinates, type)
