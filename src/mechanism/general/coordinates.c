/* SPDX-License-Identifier: BSD-3-Clause */
/* Generalized coordinates of the user: q and v of any size, mass M(q, t) and force g(q, v, t) by
 * functions; v = q', or q' = N(q) v with the functions of coordinates_manifold.c.
 *
 * Where the derivatives of g are not given they come from differences,
 * as always those of M a (difference.c).
 */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/general/coordinates_manifold.h"
#include "mechanism/general/difference.h"
#include "mechanism/general/user_function.h"

static const baum_coordinates_def defaults = {.struct_size = sizeof(baum_coordinates_def),
                                              .depends_on_velocity = true};

/* ---- definition ---- */

/* Units are the user's own: sentences name none. */
static baum_status check_scale(const char *label, const char *field, const double *scale, int count)
{
  for (int i = 0; scale && i < count; i++) {
    if (!(isfinite(scale[i]) && scale[i] > 0.0)) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s[%d] is %g, must be finite and > 0", label,
                         field, i, scale[i]);
    }
  }
  return BAUM_OK;
}

static baum_status check_arrays(const baum_coordinates_def *def, const char *label)
{
  int positions = baum_i_coordinates_positions(def);
  for (int i = 0; i < positions && def->q; i++) {
    if (!isfinite(def->q[i])) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: q[%d] is %g, must be finite", label, i, def->q[i]);
    }
  }
  for (int i = 0; i < def->size; i++) {
    if (def->v && isinf(def->v[i])) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: v[%d] is %g, must be finite, or NaN for free",
                         label, i, def->v[i]);
    }
  }
  BAUM_I_TRY(check_scale(label, "position_scale", def->position_scale, positions));
  return check_scale(label, "scale", def->scale, def->size);
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  (void)mechanism;
  const baum_coordinates_def *def = given;
  BAUM_I_TRY(baum_i_check_count(label, "size", def->size));
  if (def->position_count != 0) {
    BAUM_I_TRY(baum_i_check_count(label, "position_count", def->position_count));
  }
  if (baum_i_coordinates_positions(def) < def->size) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: position_count is %d, must be at least size (%d)",
                       label, (int)def->position_count, (int)def->size);
  }
  BAUM_I_TRY(check_arrays(def, label));
  BAUM_I_TRY(baum_i_check_given(label, "mass()", def->mass != NULL));
  BAUM_I_TRY(baum_i_check_given(label, "force()", def->force != NULL));
  return baum_i_coordinates_check_manifold(def, label);
}

static void release(void *copy)
{
  baum_coordinates_def *def = copy;
  baum_i_free(def->q);
  baum_i_free(def->v);
  baum_i_free(def->scale);
  baum_i_free(def->position_scale);
  def->q = NULL;
  def->v = NULL;
  def->scale = NULL;
  def->position_scale = NULL;
}

/* Replace an array by a copy; false when out of memory. */
static bool own_array(const double **array, int count)
{
  if (*array) {
    *array = baum_i_copy(*array, (size_t)count, sizeof **array);
    return *array != NULL;
  }
  return true;
}

static baum_status own(void *copy)
{
  baum_coordinates_def *def = copy;
  int positions = baum_i_coordinates_positions(def);
  bool q = own_array(&def->q, positions);
  bool position_scale = own_array(&def->position_scale, positions);
  bool v = own_array(&def->v, def->size);
  bool scale = own_array(&def->scale, def->size);
  if (q && v && scale && position_scale) {
    return BAUM_OK;
  }
  release(def);
  return BAUM_ERR_MEMORY;
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

static const char *tied(const void *present, const void *next)
{
  const baum_coordinates_def *a = present;
  const baum_coordinates_def *b = next;
  if (baum_i_coordinates_positions(a) != baum_i_coordinates_positions(b)) {
    return "position_count";
  }
  return !a->rate == !b->rate ? NULL : "rate";
}

static void digest(const void *given, baum_i_digest *sum)
{
  const baum_coordinates_def *def = given;
  baum_i_digest_add_integer(sum, def->constant_mass);
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
  return (baum_i_user_function){.element = &body->element,
                                .family = "body",
                                .name = name,
                                .rows = row_count,
                                .cols = cols,
                                .user = def_of(body)->user};
}

static baum_status mass_at(const baum_i_body *body, const baum_i_local *at, double *out)
{
  baum_i_user_function f = function(body, "mass", body->nv, body->nv);
  return baum_i_call_q(&f, def_of(body)->mass, at, out);
}

static baum_status force_at(const baum_i_body *body, const baum_i_local *at, double *out)
{
  baum_i_user_function f = function(body, "force", body->nv, 0);
  return baum_i_call_force(&f, def_of(body)->force, at, out);
}

/* ---- evaluation ---- */

static baum_status mass(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  baum_status status = BAUM_OK;
  for (int i = 0; i < group->count && status == BAUM_OK; i++) {
    const baum_i_body *body = group->bodies[i];
    baum_i_local at = baum_i_gather(point, &body->span);
    status = mass_at(body, &at, out + body->mass);
  }
  return status;
}

static baum_status force(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  baum_status status = BAUM_OK;
  for (int i = 0; i < group->count && status == BAUM_OK; i++) {
    const baum_i_body *body = group->bodies[i];
    baum_i_local at = baum_i_gather(point, &body->span);
    double *value = baum_i_take(&at, body->nv);
    status = force_at(body, &at, value);
    for (int j = 0; j < body->nv && status == BAUM_OK; j++) {
      out[body->v + j] += value[j];
    }
  }
  return status;
}

static baum_status potential(const baum_i_body_group *group, baum_i_point *point, double *sum)
{
  baum_status status = BAUM_OK;
  for (int i = 0; i < group->count && status == BAUM_OK; i++) {
    const baum_i_body *body = group->bodies[i];
    if (def_of(body)->potential) {
      baum_i_local at = baum_i_gather(point, &body->span);
      baum_i_user_function f = function(body, "potential", 1, 0);
      double value;
      status = baum_i_call_q(&f, def_of(body)->potential, &at, &value);
      *sum += status == BAUM_OK ? value : 0.0;
    }
  }
  return status;
}

/* ---- derivatives ---- */

static baum_status force_field(const void *context, const baum_i_local *at, double *out)
{
  return force_at(context, at, out);
}

static baum_status force_block(const baum_i_body *body, const baum_i_local *at,
                               baum_i_variable variable, double *out)
{
  bool by_q = variable == BAUM_I_VARIABLE_Q;
  baum_force_fn *given = by_q ? def_of(body)->force_q : def_of(body)->force_v;
  if (given) {
    baum_i_user_function f = function(body, by_q ? "force_q" : "force_v", body->nv, body->nv);
    return baum_i_call_force(&f, given, at, out);
  }
  baum_i_field field = {.evaluate = force_field, .context = body, .size = body->nv};
  return baum_i_difference_columns(&field, variable, at, out);
}

/* v^T M v / 2, v held fixed. */
static baum_status kinetic_field(const void *context, const baum_i_local *at, double *out)
{
  const baum_i_body *body = context;
  int n = body->nv;
  baum_i_local here = *at;
  double *block = baum_i_take(&here, n * n);
  baum_status status = mass_at(body, &here, block);
  *out = 0.0;
  for (int i = 0; i < n * n && status == BAUM_OK; i++) {
    *out += 0.5 * at->v[i / n] * block[i] * at->v[i % n];
  }
  return status;
}

/* v^T M' v / 2 along the motion. */
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

static baum_status power_of(const baum_i_body *body, const baum_i_local *at, double *sum)
{
  baum_i_local here = *at;
  double *value = baum_i_take(&here, body->nv);
  double rate = 0.0;
  baum_status status = force_at(body, &here, value);
  for (int j = 0; j < body->nv && status == BAUM_OK; j++) {
    *sum += value[j] * at->v[j];
  }
  if (status == BAUM_OK) {
    status = kinetic_rate(body, &here, &rate);
  }
  *sum += rate;
  return status;
}

static baum_status power(const baum_i_body_group *group, baum_i_point *point,
                         double sum[BAUM_I_POWERS])
{
  baum_status status = BAUM_OK;
  for (int i = 0; i < group->count && status == BAUM_OK; i++) {
    baum_i_local at = baum_i_gather(point, &group->bodies[i]->span);
    status = power_of(group->bodies[i], &at, &sum[BAUM_I_POWER_BODIES]);
  }
  return status;
}

/* M a, a held fixed. */
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
  baum_status status = mass_at(m->body, &here, block);
  for (int i = 0; i < n && status == BAUM_OK; i++) {
    out[i] = 0.0;
    for (int j = 0; j < n; j++) {
      out[i] += block[i * n + j] * m->a[j];
    }
  }
  return status;
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
  baum_status status = BAUM_OK;
  if (blocks->ma_q) {
    status = inertia_block(body, &at, own_a, blocks->ma_q + body->mass);
  }
  if (blocks->force_q && status == BAUM_OK) {
    status = force_block(body, &at, BAUM_I_VARIABLE_Q, blocks->force_q + body->mass);
  }
  if (blocks->force_v && status == BAUM_OK) {
    status = force_block(body, &at, BAUM_I_VARIABLE_V, blocks->force_v + body->mass);
  }
  return status;
}

/* ---- checking what is given ---- */

static baum_status check_symmetry(const baum_i_body *body, const double *block)
{
  int n = body->nv;
  char label[BAUM_I_LABEL_SIZE];
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < i; j++) {
      double a = block[i * n + j];
      double b = block[j * n + i];
      /* Far above rounding, also where large terms cancel in an entry, and far below any
       * mistake. */
      double size = sqrt(fabs(block[i * n + i] * block[j * n + j]));
      if (fabs(a - b) > 1e-6 * fmax(fabs(a), fabs(b)) + 1e-9 * size) {
        return baum_i_fail(BAUM_ERR_ARGUMENT,
                           "%s: mass()[%d][%d] is %.9g but mass()[%d][%d] is %.9g; must be "
                           "symmetric",
                           baum_i_label(&body->element, "body", label), i, j, a, j, i, b);
      }
    }
  }
  return BAUM_OK;
}

/* In the design configuration alone: beside it, coordinates may be where M is none. */
static baum_status check_sign(const baum_i_body *body, const baum_i_local *at, const double *block)
{
  int n = body->nv;
  const double *design_q = at->point->mechanism->design_q + body->q;
  bool design_pose = memcmp(at->q, design_q, (size_t)body->nq * sizeof *design_q) == 0;
  char text[BAUM_I_ENTRY_SIZE];
  baum_i_user_function f = function(body, "mass", n, n);
  for (int i = 0; i < n && design_pose; i++) {
    if (block[i * (n + 1)] < 0.0) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s is %.9g in the design configuration, must be >= 0",
                         baum_i_user_entry(&f, i * (n + 1), text), block[i * (n + 1)]);
    }
  }
  return BAUM_OK;
}

/* constant_mass is the claim that a derivative is zero: compare with the design configuration at t = 0. */
static baum_status check_constant(const baum_i_body *body, const baum_i_local *at,
                                  const double *block)
{
  int n = body->nv;
  char text[BAUM_I_ENTRY_SIZE];
  baum_i_local here = *at;
  here.t = 0.0;
  here.q = at->point->mechanism->design_q + body->q;
  double *there = baum_i_take(&here, n * n);
  baum_status status = mass_at(body, &here, there);
  baum_i_user_function f = function(body, "mass", n, n);
  for (int i = 0; i < n * n && status == BAUM_OK; i++) {
    double size = sqrt(fabs(block[i / n * (n + 1)] * block[i % n * (n + 1)]));
    if (fabs(block[i] - there[i]) > 1e-9 * (fabs(block[i]) + size)) {
      status = baum_i_fail(
        BAUM_ERR_ARGUMENT,
        "%s is %.9g in the design configuration and %.9g near it, but constant_mass is true",
        baum_i_user_entry(&f, i, text), there[i], block[i]);
    }
  }
  return status;
}

static baum_status check_mass(const baum_i_body *body, const baum_i_local *at)
{
  baum_i_local here = *at;
  double *block = baum_i_take(&here, body->nv * body->nv);
  baum_status status = mass_at(body, &here, block);
  if (status == BAUM_OK) {
    status = check_symmetry(body, block);
  }
  if (status == BAUM_OK) {
    status = check_sign(body, &here, block);
  }
  if (status == BAUM_OK && def_of(body)->constant_mass) {
    status = check_constant(body, &here, block);
  }
  return status;
}

static baum_status check_force(const baum_i_body *body, const baum_i_local *at,
                               baum_i_variable variable)
{
  bool by_q = variable == BAUM_I_VARIABLE_Q;
  if (!(by_q ? def_of(body)->force_q : def_of(body)->force_v)) {
    return BAUM_OK;
  }
  baum_i_local here = *at;
  double *given = baum_i_take(&here, body->nv * body->nv);
  baum_status status = force_block(body, &here, variable, given);
  baum_i_user_function f = function(body, by_q ? "force_q" : "force_v", body->nv, body->nv);
  baum_i_field field = {.evaluate = force_field, .context = body, .size = body->nv};
  baum_i_claim claim = {&f, "force", given};
  return status == BAUM_OK ? baum_i_compare_columns(&claim, &field, variable, &here) : status;
}

static baum_status check_derivatives(const baum_i_body *body, baum_i_point *point)
{
  baum_i_local at = baum_i_gather(point, &body->span);
  BAUM_I_TRY(baum_i_coordinates_compare_manifold(body, &at));
  baum_status status = check_mass(body, &at);
  if (status == BAUM_OK && !def_of(body)->depends_on_velocity) {
    baum_i_user_function f = function(body, "force", body->nv, 0);
    baum_i_field field = {.evaluate = force_field, .context = body, .size = body->nv};
    status = baum_i_compare_with_rest(&f, &field, &at);
  }
  if (status == BAUM_OK) {
    status = check_force(body, &at, BAUM_I_VARIABLE_Q);
  }
  if (status == BAUM_OK) {
    status = check_force(body, &at, BAUM_I_VARIABLE_V);
  }
  return status;
}

static const baum_i_body_type type = {
  .definition = {.kind = "user coordinates",
                 .size = sizeof(baum_coordinates_def),
                 .defaults = &defaults,
                 .check = check,
                 .own = own,
                 .release = release,
                 .tied = tied,
                 .digest = digest},
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
  .check = check_derivatives,
};

BAUM_I_DEFINE(body, coordinates, type)
