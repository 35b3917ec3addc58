/* SPDX-License-Identifier: BSD-3-Clause */
/* Constraints that user functions compute. At position level, the function Phi(q, t) is required.
 * Functions for the following quantities are optional:
 *
 *   J = Phi_q,  nu = -Phi_t,  gamma = -(J v)_q v - 2 Phi_tq v - Phi_tt
 *
 * Quantities without a user function are computed by differences (difference.c). Differences give
 * gamma as follows. In general Phi'' = J a - gamma, and a = 0 along the straight line q + s v,
 * t + s. Therefore
 *
 *   gamma = -d^2/ds^2 Phi(q + s v, t + s) = d/ds (nu - J v)(q + s v, t + s)       at s = 0.
 *
 * The second form is more accurate. It is used if the user gives J, and if nu is given or zero. If
 * the user does not give J, second derivatives of Phi follow from those along straight lines:
 *
 *   4 Phi_ij = D^2 Phi along (e_i + e_j) - D^2 Phi along (e_i - e_j)
 *
 * Constraints of velocity level, J(q, t) v = nu(q, t), have no Phi: J is required, nu is zero if it
 * is not given, and gamma = d/ds (nu - J v)(q + s v, t + s) as above.
 *
 * The time in which Phi changes at constant q is unknown. Differences with respect to t assume that
 * it is one second. Differences along the line q + s v, t + s use the time scale of the motion
 * instead, if that is shorter. For a constraint that changes much more slowly with t, the user
 * should give nu and gamma.
 */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/general/difference.h"
#include "mechanism/general/user_function.h"

static const baum_i_def_field fields[] = {
  BAUM_I_ARRAY(baum_user_constraint_def, bodies, BODIES, FINITE, body_count, body_count),
  BAUM_I_FIELD(baum_user_constraint_def, body_count, OWN_COUNT),
  BAUM_I_FIELD(baum_user_constraint_def, row_count, COUNT),
  BAUM_I_FIELD(baum_user_constraint_def, phi, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_user_constraint_def, jacobian, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_user_constraint_def, nu, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_user_constraint_def, gamma, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_user_constraint_def, user, USER),
  BAUM_I_FIELD(baum_user_constraint_def, velocity_level, FLAG),
  {0},
};

/* ---- definition ---- */

static int rows(const void *given)
{
  const baum_user_constraint_def *def = given;
  return def->row_count;
}

static int velocity_rows(const void *given)
{
  const baum_user_constraint_def *def = given;
  return def->velocity_level ? def->row_count : 0;
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  (void)mechanism;
  const baum_user_constraint_def *def = given;
  if (!def->velocity_level) {
    return baum_i_check_given(label, "phi()", def->phi != NULL);
  }
  if (def->phi) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: phi() is given, but with velocity_level = true the constraint is J v = "
                       "nu, without Phi; give jacobian(), or velocity_level = false",
                       label);
  }
  return baum_i_check_given(label, "jacobian()", def->jacobian != NULL);
}

/* Return the relative error of the derivatives that are computed by differences (difference.c). */
static double noise(const void *given)
{
  const baum_user_constraint_def *def = given;
  if (!def->gamma && !def->jacobian) {
    return 1e-11;
  }
  return def->gamma && def->jacobian ? 0.0 : 1e-13;
}

/* ---- calls ---- */

static const baum_user_constraint_def *def_of(const baum_i_joint *joint)
{
  return joint->element.def;
}

static baum_i_user_function function(const baum_i_joint *joint, const char *name, int cols)
{
  return (baum_i_user_function){&joint->element, name, joint->rows, cols, def_of(joint)->user};
}

static baum_status phi_at(const void *constraint, const baum_i_local *at, double *out)
{
  const baum_i_joint *joint = constraint;
  if (joint->velocity_rows > 0) {
    memset(out, 0, (size_t)joint->rows * sizeof *out);
    return BAUM_OK;
  }
  baum_i_user_function f = function(joint, "phi", 0);
  return baum_i_call_q(&f, def_of(joint)->phi, at, out);
}

static baum_status given_jacobian_at(const baum_i_joint *joint, const baum_i_local *at, double *out)
{
  baum_i_user_function f = function(joint, "jacobian", at->nl);
  return baum_i_call_q(&f, def_of(joint)->jacobian, at, out);
}

static baum_status given_nu_at(const baum_i_joint *joint, const baum_i_local *at, double *out)
{
  baum_i_user_function f = function(joint, "nu", 0);
  return baum_i_call_q(&f, def_of(joint)->nu, at, out);
}

static baum_status given_gamma_at(const baum_i_joint *joint, const baum_i_local *at, double *out)
{
  baum_i_user_function f = function(joint, "gamma", 0);
  return baum_i_call_qv(&f, def_of(joint)->gamma, at, out);
}

/* ---- fields to difference ---- */

static baum_status minus_phi_field(const void *context, const baum_i_local *at, double *out)
{
  const baum_i_joint *joint = context;
  BAUM_I_TRY(phi_at(joint, at, out));
  for (int i = 0; i < joint->rows; i++) {
    out[i] = -out[i];
  }
  return BAUM_OK;
}

/* Compute nu - J v as a function of q and t. If the user does not give nu, nu is zero here. */
static baum_status minus_rate_field(const void *context, const baum_i_local *at, double *out)
{
  const baum_i_joint *joint = context;
  baum_i_local here = *at;
  double *jacobian = baum_i_take(&here, joint->rows * at->nl);
  memset(out, 0, (size_t)joint->rows * sizeof *out);
  BAUM_I_TRY(def_of(joint)->nu ? given_nu_at(joint, &here, out) : BAUM_OK);
  BAUM_I_TRY(given_jacobian_at(joint, &here, jacobian));
  for (int i = 0; i < joint->rows; i++) {
    for (int j = 0; j < at->nl; j++) {
      out[i] -= jacobian[i * at->nl + j] * at->v[j];
    }
  }
  return BAUM_OK;
}

static baum_i_field field_of(baum_i_field_fn *evaluate, const baum_i_joint *joint)
{
  return (baum_i_field){.evaluate = evaluate, .context = joint, .size = joint->rows};
}

/* ---- given functions, or differences ---- */

static baum_status jacobian_at(const baum_i_joint *joint, const baum_i_local *at, double *out)
{
  if (def_of(joint)->jacobian) {
    return given_jacobian_at(joint, at, out);
  }
  baum_i_field field = field_of(phi_at, joint);
  return baum_i_difference_columns(&field, BAUM_I_VARIABLE_Q, at, out);
}

static const baum_i_ray time_ray = {.dt = 1.0, .rate = 1.0};

static baum_status nu_at(const void *constraint, const baum_i_local *at, double *out)
{
  const baum_i_joint *joint = constraint;
  if (def_of(joint)->nu) {
    return given_nu_at(joint, at, out);
  }
  if (joint->velocity_rows > 0) {
    memset(out, 0, (size_t)joint->rows * sizeof *out);
    return BAUM_OK;
  }
  baum_i_field field = field_of(minus_phi_field, joint);
  return baum_i_difference_first(&field, &time_ray, at, out);
}

/* Find whether Phi, or nu - J v if there is no Phi, changes with t at constant q. The function
 * compares the present values with the values a short time before and after. */
static baum_status find_movement(const baum_i_joint *joint, const baum_i_local *at, bool *moves)
{
  baum_i_local here = *at;
  double *now = baum_i_take(&here, joint->rows);
  double *then = baum_i_take(&here, joint->rows);
  baum_i_field_fn *value_at = joint->velocity_rows > 0 ? minus_rate_field : phi_at;
  size_t bytes = (size_t)joint->rows * sizeof *now;
  *moves = false;
  BAUM_I_TRY(value_at(joint, &here, now));
  for (int side = -1; side <= 1 && !*moves; side += 2) {
    here.t = at->t + side * 0x1p-9;
    BAUM_I_TRY(value_at(joint, &here, then));
    *moves = memcmp(now, then, bytes) != 0;
  }
  return BAUM_OK;
}

/* Find the ray (straight line) along the motion, the rate of this ray, and whether the constraint
 * may change with t. */
static baum_status find_line(const baum_i_joint *joint, const baum_i_local *at, baum_i_ray *ray,
                             bool *moves)
{
  const baum_user_constraint_def *def = def_of(joint);
  *ray = (baum_i_ray){.dt = 1.0, .dq = at->v, .rate = baum_i_local_rate(at)};
  /* If the rate is at least 1, `moves` does not change the rate below. Then `moves` is needed only
   * if the user gives J without nu. In this case gamma_at() uses it to select the form of gamma. */
  bool matters = ray->rate < 1.0 || (def->jacobian && !def->nu);
  *moves = true;
  BAUM_I_TRY(matters ? find_movement(joint, at, moves) : BAUM_OK);
  if (*moves) {
    ray->rate = fmax(ray->rate, 1.0);
  } else {
    ray->dt = 0.0;
  }
  return BAUM_OK;
}

static baum_status gamma_at(const void *constraint, const baum_i_local *at, double *out)
{
  const baum_i_joint *joint = constraint;
  const baum_user_constraint_def *def = def_of(joint);
  if (def->gamma) {
    return given_gamma_at(joint, at, out);
  }
  baum_i_ray ray;
  bool moves;
  BAUM_I_TRY(find_line(joint, at, &ray, &moves));
  if (ray.rate == 0.0) {
    memset(out, 0, (size_t)joint->rows * sizeof *out);
    return BAUM_OK;
  }
  if (def->jacobian && (def->nu || !moves || def->velocity_level)) {
    baum_i_field field = field_of(minus_rate_field, joint);
    return baum_i_difference_first(&field, &ray, at, out);
  }
  baum_i_field field = field_of(minus_phi_field, joint);
  return baum_i_difference_second(&field, &ray, at, out);
}

/* ---- evaluation ---- */

static baum_status evaluate(const baum_i_joint *joint, baum_i_point *point, const baum_i_rows *out)
{
  baum_i_local at = baum_i_gather(point, &joint->span);
  BAUM_I_TRY(out->phi ? phi_at(joint, &at, out->phi + joint->row) : BAUM_OK);
  if (out->jacobian) {
    BAUM_I_TRY(jacobian_at(joint, &at, out->jacobian + joint->jacobian));
  }
  if (out->nu) {
    BAUM_I_TRY(nu_at(joint, &at, out->nu + joint->row));
  }
  if (out->gamma) {
    BAUM_I_TRY(gamma_at(joint, &at, out->gamma + joint->row));
  }
  return BAUM_OK;
}

/* ---- second derivatives ---- */

/* The joint, the factors w and lambda, and the blocks to which second derivatives are added. */
typedef struct second {
  const baum_i_joint *joint;
  const double *w;      /* (nl) */
  const double *lambda; /* (rows), or zeros if there are no multipliers */
  double *jw_q;         /* NULL if the caller does not need it */
  double *jtl_q;
} second;

/* Write the products J w (`rows` values) and J^T lambda (nl values), one after the other. */
static baum_status products_field(const void *context, const baum_i_local *at, double *out)
{
  const second *s = context;
  int nl = at->nl;
  baum_i_local here = *at;
  double *jacobian_now = baum_i_take(&here, s->joint->rows * nl);
  BAUM_I_TRY(given_jacobian_at(s->joint, &here, jacobian_now));
  memset(out, 0, (size_t)(s->joint->rows + nl) * sizeof *out);
  for (int i = 0; i < s->joint->rows; i++) {
    for (int j = 0; j < nl; j++) {
      out[i] += jacobian_now[i * nl + j] * s->w[j];
      out[s->joint->rows + j] += jacobian_now[i * nl + j] * s->lambda[i];
    }
  }
  return BAUM_OK;
}

static void put_column(double *block, const double *column, int count, int nl, int j)
{
  for (int i = 0; block && i < count; i++) {
    block[i * nl + j] = column[i];
  }
}

static baum_status products_by_columns(const second *s, const baum_i_local *at)
{
  int row_count = s->joint->rows;
  baum_i_local here = *at;
  double *direction = baum_i_take(&here, at->nl);
  double *column = baum_i_take(&here, row_count + at->nl);
  baum_i_field field = {.evaluate = products_field, .context = s, .size = row_count + at->nl};
  for (int j = 0; j < at->nl; j++) {
    baum_i_ray ray = baum_i_column_ray(at, BAUM_I_VARIABLE_Q, j, direction);
    BAUM_I_TRY(baum_i_difference_first(&field, &ray, &here, column));
    put_column(s->jw_q, column, row_count, at->nl, j);
    put_column(s->jtl_q, column + row_count, at->nl, at->nl, j);
  }
  return BAUM_OK;
}

/* Compute the derivative of column i of J with respect to q_j, for all rows. If q is not a vector,
 * q is first moved along coordinate j, and then along coordinate i. `work` has 2 nl + rows
 * entries. */
static baum_status curvature(const baum_i_joint *joint, const baum_i_local *at, int i, int j,
                             double *work, double *out)
{
  double *direction = work;
  double *first = work + at->nl;
  double *other = first + at->nl;
  double *turned = at->span ? first : direction; /* contains the displacement along coordinate j */
  baum_i_field field = field_of(phi_at, joint);
  baum_i_ray ray = {.dq = direction, .dq_first = at->span ? first : NULL, .rate = 1.0};
  memset(direction, 0, 2 * (size_t)at->nl * sizeof *direction);
  direction[i] = at->scale[i];
  turned[j] += i == j ? 0.0 : at->scale[j];
  BAUM_I_TRY(baum_i_difference_second(&field, &ray, at, out));
  double unit = at->scale[i] * at->scale[j];
  if (i != j) {
    turned[j] = -at->scale[j];
    BAUM_I_TRY(baum_i_difference_second(&field, &ray, at, other));
    unit *= 4.0;
  }
  for (int k = 0; k < joint->rows; k++) {
    out[k] = (out[k] - (i != j ? other[k] : 0.0)) / unit;
  }
  return BAUM_OK;
}

/* Add the contributions of `value` to the blocks. `value` contains (J_ki)_qj for all rows k. */
static void add_curvature(const second *s, const double *value, int i, int j, int nl)
{
  for (int k = 0; k < s->joint->rows; k++) {
    if (s->jw_q) {
      s->jw_q[k * nl + j] += value[k] * s->w[i];
    }
    if (s->jtl_q) {
      s->jtl_q[i * nl + j] += value[k] * s->lambda[k];
    }
  }
}

/* If q is a vector, Phi_ij = Phi_ji. Each pair of indices is then computed only once. */
static baum_status products_by_pairs(const second *s, const baum_i_local *at)
{
  baum_i_local here = *at;
  double *work = baum_i_take(&here, 2 * at->nl + s->joint->rows);
  double *value = baum_i_take(&here, s->joint->rows);
  for (int i = 0; i < at->nl; i++) {
    for (int j = at->span ? 0 : i; j < at->nl; j++) {
      BAUM_I_TRY(curvature(s->joint, &here, i, j, work, value));
      add_curvature(s, value, i, j, at->nl);
      if (i != j && !at->span) {
        add_curvature(s, value, j, i, at->nl);
      }
    }
  }
  return BAUM_OK;
}

static baum_status linearize_products(const second *s, const baum_i_local *at)
{
  if (!s->jw_q && !s->jtl_q) {
    return BAUM_OK;
  }
  return def_of(s->joint)->jacobian ? products_by_columns(s, at) : products_by_pairs(s, at);
}

/* Write the derivative of a function to out (size x nl), unless out is NULL. If the user did not
 * give this function (is_given is false), `call` computes it by differences. */
static baum_status linearize_by(const baum_i_joint *joint, baum_i_field_fn *call, bool is_given,
                                baum_i_variable variable, const baum_i_local *at, double *out)
{
  baum_i_field field = field_of(call, joint);
  field.rough = !is_given;
  return out ? baum_i_difference_columns(&field, variable, at, out) : BAUM_OK;
}

static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  baum_i_local at = baum_i_gather(point, &joint->span);
  double *none = baum_i_take(&at, joint->rows);
  memset(none, 0, (size_t)joint->rows * sizeof *none);
  second s = {.joint = joint,
              .w = baum_i_gather_vector(&at, &joint->span, w),
              .lambda = lambda ? lambda + joint->row : none,
              .jw_q = baum_i_block_at(blocks->jw_q, joint->jacobian),
              .jtl_q = baum_i_block_at(blocks->jtl_q, joint->square)};
  BAUM_I_TRY(linearize_products(&s, &at));
  bool gamma = def_of(joint)->gamma != NULL;
  bool nu = def_of(joint)->nu != NULL;
  double *gamma_q = baum_i_block_at(blocks->gamma_q, joint->jacobian);
  double *gamma_v = baum_i_block_at(blocks->gamma_v, joint->jacobian);
  double *nu_q = baum_i_block_at(blocks->nu_q, joint->jacobian);
  BAUM_I_TRY(linearize_by(joint, gamma_at, gamma, BAUM_I_VARIABLE_Q, &at, gamma_q));
  BAUM_I_TRY(linearize_by(joint, gamma_at, gamma, BAUM_I_VARIABLE_V, &at, gamma_v));
  return linearize_by(joint, nu_at, nu, BAUM_I_VARIABLE_Q, &at, nu_q);
}

/* ---- checks of the user's functions ---- */

static baum_status check_jacobian(const baum_i_joint *joint, const baum_i_local *at)
{
  if (!def_of(joint)->jacobian || joint->velocity_rows > 0) {
    return BAUM_OK;
  }
  baum_i_local here = *at;
  double *given = baum_i_take(&here, joint->rows * at->nl);
  BAUM_I_TRY(given_jacobian_at(joint, &here, given));
  baum_i_user_function f = function(joint, "jacobian", at->nl);
  baum_i_field field = field_of(phi_at, joint);
  baum_i_claim claim = {&f, "phi", given};
  return baum_i_compare_columns(&claim, &field, BAUM_I_VARIABLE_Q, &here);
}

static baum_status check_nu(const baum_i_joint *joint, const baum_i_local *at)
{
  if (!def_of(joint)->nu || joint->velocity_rows > 0) {
    return BAUM_OK;
  }
  baum_i_local here = *at;
  double *given = baum_i_take(&here, joint->rows);
  BAUM_I_TRY(given_nu_at(joint, &here, given));
  baum_i_user_function f = function(joint, "nu", 0);
  baum_i_field field = field_of(minus_phi_field, joint);
  baum_i_claim claim = {&f, "phi in t", given};
  return baum_i_compare_ray(&claim, &baum_i_stencil_first, &field, &time_ray, &here);
}

/* Check gamma, if possible by the second form that the top of this file describes. jacobian and nu
 * have already been checked, or they define the constraint. */
static baum_status check_gamma(const baum_i_joint *joint, const baum_i_local *at)
{
  const baum_user_constraint_def *def = def_of(joint);
  if (!def->gamma) {
    return BAUM_OK;
  }
  bool by_rate = def->jacobian && (def->nu || def->velocity_level);
  baum_i_local here = *at;
  double *given = baum_i_take(&here, joint->rows);
  BAUM_I_TRY(given_gamma_at(joint, &here, given));
  baum_i_ray ray = {.dt = 1.0, .dq = at->v, .rate = fmax(baum_i_local_rate(at), 1.0)};
  baum_i_user_function f = function(joint, "gamma", 0);
  baum_i_field field = field_of(by_rate ? minus_rate_field : minus_phi_field, joint);
  baum_i_claim claim = {&f, by_rate ? "jacobian and nu" : "phi", given};
  return baum_i_compare_ray(&claim, by_rate ? &baum_i_stencil_first : &baum_i_stencil_second,
                            &field, &ray, &here);
}

static baum_status check_derivatives(const void *given, baum_i_point *point)
{
  const baum_i_joint *joint = given;
  baum_i_local at = baum_i_gather(point, &joint->span);
  baum_i_local here = at;
  double *value = baum_i_take(&here, joint->rows);
  BAUM_I_TRY(phi_at(joint, &here, value));
  BAUM_I_TRY(check_jacobian(joint, &at));
  BAUM_I_TRY(check_nu(joint, &at));
  return check_gamma(joint, &at);
}

static const baum_i_joint_type type = {
  .definition = {BAUM_I_DEFINITION(user_constraint, "user constraint", fields), .check = check,
                 .check_derivatives = check_derivatives},
  .rows = rows,
  .velocity_rows = velocity_rows,
  .evaluate = baum_i_evaluate_each,
  .evaluate_one = evaluate,
  .linearize = linearize,
  .noise = noise,
};

BAUM_I_DEFINE(joint, user_constraint, type)
