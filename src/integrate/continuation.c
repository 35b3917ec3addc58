/* SPDX-License-Identifier: BSD-3-Clause */
/* One step along the path q(t) that solves Phi(q, t) = 0. There are nc = nv independent rows, so J
 * is a square matrix. Steps that may lead to another branch are refused.
 *
 * Newton's method solves J dq = -Phi and moves q by dq. Then J v = nu and J a = gamma give v and a.
 *
 * The configuration found must lie on the branch on which the step began. Newton's method alone
 * does not ensure this: where two branches pass close to each other, a long step may end next to
 * the wrong branch and converge to it. The sign of det J distinguishes the branches: it is constant
 * along a path without singular configurations, and it changes at a fold or at a crossing. With J0
 * at the beginning of the step and J1 at its end, the ratio of the determinants is
 *
 *   det J0 / det J1 = det(I - D),   D = I - J1^-1 J0   (nv x nv)
 *
 * This ratio is positive as long as no real eigenvalue of D reaches 1. |D| < 1 at the end of the
 * step is sufficient: |D| is then also below 1 along the step, because D grows approximately in
 * proportion to the length of the step (the lemma of Newton and Kantorovich; P. Deuflhard, Newton
 * Methods for Nonlinear Problems, 2004, chapters 2 and 5). The norm of D is estimated with a probe
 * z that moves every coordinate by a fraction of its scale:
 *
 *   turning = max_k |D^k z| / |D^(k-1) z|,  k = 1 .. PROBES,   |x| = max_i |x_i| / scale_i
 *
 * `turning` is close to the largest eigenvalue of D or above it, because z has a component in
 * every critical direction. Each product D z requires one solution of linear equations. Their
 * matrix is already factored, because v and a need it, too.
 *
 * The saddle-point solver solves all these equations. Without degrees of freedom, its solution a is
 * J^-1 times the right-hand side of the rows, whatever M is. If the right-hand side of the rows is
 * zero, its solution lambda is J^-T times the right-hand side of the bodies.
 */
#include "integrate/continuation.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/golden.h"
#include "base/message.h"

enum { ITERATIONS = 16, PROBES = 8, INVERSE_ITERATIONS = 3 };
/* FARTHEST limits Newton's first correction relative to the scales, and CONTRACTION limits the
 * second correction relative to the first. If a correction is larger, the guess may be closer to
 * another configuration. */
static const double FARTHEST = 0.25;
static const double CONTRACTION = 0.25;
/* Limit on the ratio of a later correction to the one before it. If the ratio is above this limit,
 * the corrections have stopped decreasing, perhaps because of rounding. */
static const double STAGNATION = 0.5;
/* Limit on the estimate of |D|. It is below 1 because the estimate is not exact and refers to the
 * end of the step only. */
static const double TURNING = 0.7;
/* Allowed violations, expressed as displacements. Newton's method ends when the violation is at
 * most ROUNDING. If its corrections have stopped decreasing, a violation of at most NOISE is
 * accepted, too. NOISE is relative to the largest coordinate, but at least to 1. */
static const double ROUNDING = 4.0 * DBL_EPSILON;
static const double NOISE = 64.0 * DBL_EPSILON;
/* Allowed violation of omitted rows. A row with a larger violation does not depend on the other
 * rows in this configuration. */
static const double NEGLIGIBLE = 1e-6;
/* The iteration z := D z ends when the size of z has decreased to the fraction DECAYED. The first z
 * contains, with the weight KEPT, the direction in which the iteration of the previous step
 * ended. */
static const double DECAYED = 0.01;
static const double KEPT = 3.0;

/* ---- life ---- */

baum_status baum_i_continuation_open(baum_i_continuation *path, baum_workspace *workspace)
{
  size_t nv = (size_t)workspace->mechanism->nv;
  size_t nc = (size_t)workspace->mechanism->nc;
  path->workspace = workspace;
  path->memory = baum_i_alloc(3 * nv + 2 * nc, sizeof *path->memory);
  BAUM_I_TRY(baum_i_check_memory(path->memory));
  path->zero = path->memory;
  path->probe = path->zero + nv;
  path->image = path->probe + nv;
  path->distance = path->image + nv;
  path->left = path->distance + nc;
  return baum_i_kkt_prepare(workspace->kkt);
}

void baum_i_continuation_close(baum_i_continuation *path)
{
  baum_i_free(path->memory);
}

/* ---- linear algebra ---- */

static bool is_kept(const baum_workspace *w, int row)
{
  return !w->rows.omitted[row];
}

static bool refuse(baum_i_verdict *verdict, baum_i_refusal refusal, baum_status status)
{
  verdict->refusal = refusal;
  verdict->status = status;
  return false;
}

/* Return true if an evaluation succeeded; otherwise store in *verdict whether a shorter step may
 * help. */
static bool accept_evaluation(const baum_workspace *w, baum_status status, baum_i_verdict *verdict)
{
  bool may_retry = (status == BAUM_ERR_CALLBACK || status == BAUM_ERR_NOT_FINITE) && w->point.retry;
  return status == BAUM_OK ||
         refuse(verdict, may_retry ? BAUM_I_REFUSAL_EVALUATION : BAUM_I_REFUSAL_STOP, status);
}

static bool accept_solution(baum_status status, baum_i_verdict *verdict)
{
  switch ((int)status) {
  case BAUM_OK: return true;
  case BAUM_ERR_SINGULAR: return refuse(verdict, BAUM_I_REFUSAL_SINGULAR, status);
  case BAUM_ERR_NOT_FINITE:
    (void)baum_i_fail(status,
                      "a constraint, its Jacobian or a mass has a value that is nan or inf");
    return refuse(verdict, BAUM_I_REFUSAL_EVALUATION, status);
  default: return refuse(verdict, BAUM_I_REFUSAL_STOP, status);
  }
}

/* Factor J at the present configuration. The values of J in the workspace must not change as long
 * as the factorization is used. */
static baum_status factor(baum_workspace *w)
{
  const baum_i_kkt_values values = {
    .mass = w->mass, .jacobian = w->jacobian, .omitted = baum_i_omitted_rows(w)};
  w->evaluations++;
  return baum_i_kkt_factor(w->kkt, &values);
}

/* Solve J x = rows. */
static baum_status solve(const baum_i_continuation *path, const double *rows, double *x)
{
  baum_workspace *w = path->workspace;
  return baum_i_kkt_solve(w->kkt, path->zero, rows, x, w->lambda);
}

/* ---- Newton ---- */

/* Find the row with the largest violation, measured as a displacement, among the active rows
 * (`kept`) or among the omitted rows. Return this violation. */
static double violation(const baum_i_continuation *path, bool kept, int *row)
{
  const baum_workspace *w = path->workspace;
  double worst = 0.0;
  for (int i = 0; i < w->mechanism->nc; i++) {
    double size = fabs(w->phi[i]) / path->distance[i];
    if (is_kept(w, i) == kept && !(size <= worst)) {
      worst = size;
      *row = i;
    }
  }
  return worst;
}

/* Evaluate the constraints at the configuration *to, and find their largest violation. */
static baum_status evaluate_violation(const baum_i_continuation *path,
                                      const baum_i_configuration *to, double *worst)
{
  baum_workspace *w = path->workspace;
  int row = 0;
  BAUM_I_TRY(baum_i_position_stage(w, to->t, to->q));
  baum_i_row_displacements(w, path->distance);
  *worst = violation(path, true, &row);
  return BAUM_OK;
}

/* Compute Newton's correction dq and write it to path->image. */
static baum_status correct(const baum_i_continuation *path)
{
  baum_workspace *w = path->workspace;
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->rhs[i] = -w->phi[i];
  }
  BAUM_I_TRY(factor(w));
  return solve(path, w->rhs, path->image);
}

/* Tell whether correction k of Newton's method is small enough. `last` is the size of the previous
 * correction. */
static bool converges(int k, double size, double last)
{
  return size <= (k == 0 ? FARTHEST : (k == 1 ? CONTRACTION : STAGNATION) * last);
}

/* Find the configuration by Newton's method. The workspace then contains Phi and J at this
 * configuration. */
static bool find_root(const baum_i_continuation *path, baum_i_configuration *to,
                      baum_i_verdict *verdict)
{
  const baum_mechanism *m = path->workspace->mechanism;
  double last = 0.0;
  for (int k = 0; k < ITERATIONS; k++) {
    double worst = 0.0;
    if (!accept_evaluation(path->workspace, evaluate_violation(path, to, &worst), verdict)) {
      return false;
    }
    if (worst <= ROUNDING) {
      return true;
    }
    if (!accept_solution(correct(path), verdict)) {
      return false;
    }
    verdict->iterations++;
    double size = baum_i_scaled_size(m, path->image);
    if (k == 1) {
      verdict->contraction = size / last;
    }
    if (!converges(k, size, last)) {
      bool is_noise = worst <= NOISE * fmax(1.0, baum_i_position_size(m, to->q));
      return is_noise || refuse(verdict, BAUM_I_REFUSAL_FAR, BAUM_OK);
    }
    baum_i_move(m, 1.0, path->image, to->q);
    last = size;
  }
  return refuse(verdict, BAUM_I_REFUSAL_FAR, BAUM_OK);
}

/* ---- guards ---- */

/* Refuse the configuration if an omitted row is violated. Such a row does not depend on the other
 * rows, so it must not be omitted. */
static bool all_follow(const baum_i_continuation *path, baum_i_verdict *verdict)
{
  return path->workspace->rows.count == 0 || violation(path, false, &verdict->row) <= NEGLIGIBLE ||
         refuse(verdict, BAUM_I_REFUSAL_OMITTED, BAUM_OK);
}

/* Return the k-th quasi-random number with either sign and a magnitude between 1/2 and 1. */
static double scatter(int k)
{
  double x = baum_i_golden(k + 1);
  return x < 0.0 ? 0.5 * x - 0.5 : 0.5 * x + 0.5;
}

/* Multiply the vector `probe` by D = I - J^-1 J_from. */
static baum_status apply_turning(const baum_i_continuation *path, const double *from)
{
  baum_workspace *w = path->workspace;
  memset(w->rhs, 0, (size_t)w->mechanism->nc * sizeof *w->rhs);
  baum_i_jacobian_times(&w->structure, from, path->probe, w->rhs);
  baum_status status = solve(path, w->rhs, path->image);
  for (int i = 0; i < w->mechanism->nv; i++) {
    path->probe[i] -= path->image[i];
  }
  return status;
}

/* Choose the first z: a fraction of the scale in every coordinate, plus the direction in which the
 * last iteration ended, because branches come close to each other in this direction. */
static void begin_probe(const baum_i_continuation *path, const baum_i_configuration *from)
{
  const baum_mechanism *m = path->workspace->mechanism;
  double size = baum_i_scaled_size(m, from->turn);
  double weight = size > 0.0 ? KEPT / size : 0.0;
  for (int i = 0; i < m->nv; i++) {
    path->probe[i] = scatter(i) * m->scale[i] + weight * from->turn[i];
  }
}

static bool keeps_turning(const baum_i_continuation *path, const baum_i_configuration *from,
                          baum_i_configuration *to, baum_i_verdict *verdict)
{
  const baum_mechanism *m = path->workspace->mechanism;
  begin_probe(path, from);
  double enough = DECAYED * baum_i_scaled_size(m, path->probe);
  double last = baum_i_scaled_size(m, path->probe);
  baum_status status = BAUM_OK;
  for (int k = 0; k < PROBES && last > enough && status == BAUM_OK; k++) {
    status = apply_turning(path, from->jacobian);
    double size = baum_i_scaled_size(m, path->probe);
    verdict->turning = fmax(verdict->turning, size / last);
    last = size;
  }
  if (!accept_solution(status, verdict)) {
    return false;
  }
  memcpy(to->turn, path->probe, (size_t)m->nv * sizeof *to->turn);
  return verdict->turning <= TURNING || refuse(verdict, BAUM_I_REFUSAL_TURNED, BAUM_OK);
}

/* ---- velocities and accelerations ---- */

/* Find v and a at the configuration in the workspace, whose J is factored. */
static bool differentiate(const baum_i_continuation *path, baum_i_configuration *to,
                          baum_i_verdict *verdict)
{
  baum_workspace *w = path->workspace;
  if (!accept_solution(solve(path, w->nu, to->v), verdict)) {
    return false;
  }
  baum_i_point_set(&w->point, to->t, to->q, to->v);
  return accept_evaluation(w, baum_i_mechanism_gamma(&w->point, w->gamma), verdict) &&
         accept_solution(solve(path, w->gamma, to->a), verdict);
}

/* ---- the step ---- */

static void keep_jacobian(const baum_workspace *w, baum_i_configuration *to)
{
  memcpy(to->jacobian, w->jacobian, (size_t)w->mechanism->jacobian_size * sizeof *to->jacobian);
}

baum_status baum_i_continuation_mark(baum_i_continuation *path, baum_i_configuration *to)
{
  baum_workspace *w = path->workspace;
  BAUM_I_TRY(baum_i_position_stage(w, to->t, to->q));
  memset(to->turn, 0, (size_t)w->mechanism->nv * sizeof *to->turn);
  keep_jacobian(w, to);
  return BAUM_OK;
}

bool baum_i_continuation_solve(baum_i_continuation *path, const baum_i_configuration *from,
                               baum_i_configuration *to, baum_i_verdict *verdict)
{
  *verdict = (baum_i_verdict){.refusal = BAUM_I_REFUSAL_NONE};
  bool found = find_root(path, to, verdict) && all_follow(path, verdict) &&
               accept_solution(factor(path->workspace), verdict) &&
               keeps_turning(path, from, to, verdict) && differentiate(path, to, verdict);
  if (found) {
    keep_jacobian(path->workspace, to);
  }
  return found;
}

/* ---- impasse ---- */

/* Normalize the left singular vector u to max |u_i| d_i = 1, where d is path->distance. u consists
 * of constraint forces that nearly cancel: J^T u is almost 0. */
static void normalize_left(const baum_i_continuation *path)
{
  double largest = 0.0;
  int nc = path->workspace->mechanism->nc;
  for (int i = 0; i < nc; i++) {
    largest = fmax(largest, fabs(path->left[i]) * path->distance[i]);
  }
  for (int i = 0; i < nc && largest > 0.0; i++) {
    path->left[i] /= largest;
  }
}

/* Make one step of inverse iteration: compute u = J^-T s^-2 probe and normalize it, then compute
 * probe = J^-1 d^2 u. s are the scales of the coordinates, and d is path->distance. */
static baum_status iterate(const baum_i_continuation *path)
{
  baum_workspace *w = path->workspace;
  const baum_mechanism *m = w->mechanism;
  double size = baum_i_scaled_size(m, path->probe);
  for (int i = 0; i < m->nv; i++) {
    path->image[i] = path->probe[i] / (size * m->scale[i] * m->scale[i]);
  }
  memset(w->rhs, 0, (size_t)m->nc * sizeof *w->rhs);
  BAUM_I_TRY(baum_i_kkt_solve(w->kkt, path->image, w->rhs, path->probe, path->left));
  normalize_left(path);
  for (int i = 0; i < m->nc; i++) {
    w->rhs[i] = path->left[i] * path->distance[i] * path->distance[i];
  }
  return solve(path, w->rhs, path->probe);
}

/* Find the left singular vector of the smallest singular value and write it to path->left. Rows are
 * measured as displacements, and coordinates relative to their scales. */
static baum_status find_critical(const baum_i_continuation *path)
{
  baum_workspace *w = path->workspace;
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->rhs[i] = is_kept(w, i) ? scatter(i) * path->distance[i] : 0.0;
  }
  BAUM_I_TRY(solve(path, w->rhs, path->probe));
  for (int k = 0; k < INVERSE_ITERATIONS; k++) {
    BAUM_I_TRY(iterate(path));
  }
  return BAUM_OK;
}

static void name_joints(const baum_i_continuation *path, baum_i_impasse *out)
{
  const baum_workspace *w = path->workspace;
  double most = -1.0;
  out->pull = 0.0;
  out->driver = -1;
  out->resister = -1;
  for (int i = 0; i < w->mechanism->nc; i++) {
    double share = fabs(path->left[i]) * path->distance[i];
    if (w->nu[i] != 0.0 && share > out->pull) {
      out->pull = share;
      out->driver = baum_i_row_joint(w->mechanism, i);
    }
    if (w->nu[i] == 0.0 && share > most) {
      most = share;
      out->resister = baum_i_row_joint(w->mechanism, i);
    }
  }
}

baum_status baum_i_continuation_explain(baum_i_continuation *path, const baum_i_configuration *to,
                                        baum_i_impasse *impasse)
{
  double worst = 0.0;
  *impasse = (baum_i_impasse){.gain = (double)INFINITY, .driver = -1, .resister = -1};
  BAUM_I_TRY(evaluate_violation(path, to, &worst));
  BAUM_I_TRY(factor(path->workspace));
  BAUM_I_TRY(find_critical(path));
  impasse->gain = baum_i_scaled_size(path->workspace->mechanism, path->probe);
  name_joints(path, impasse);
  return BAUM_OK;
}
