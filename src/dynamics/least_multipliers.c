/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the multipliers of least norm. If rows are redundant, many sets of multipliers satisfy
 * the equations.
 *
 * The solution lambda is zero in the omitted rows (index d) and balances the forces with the kept
 * rows (index k) alone. Every other solution has the form lambda + N z. Here z contains one number
 * for each omitted row, and N z is a null vector of J^T, which means that
 *
 *   (N z)_d = z,   J_k^T (N z)_k = -J_d^T z.
 *
 * N z is part of the solution of the system
 *
 *   [ W     J_k^T ] [ x       ]   [ -J_d^T z ]
 *   [ J_k   0     ] [ (N z)_k ] = [     0    ].
 *
 * The matrix W = diag(1 / scale^2) is used in place of the mass matrix, because masses that differ
 * by orders of magnitude would cause rounding errors.
 *
 * The method of conjugate gradients (CGLS of A. Bjorck) finds the z that minimizes |S (lambda + N
 * z)|. Here S = diag(s_i), s_i = |row i of J D^-1/2|, and D is the diagonal of M. The entries of S
 * in the rows d precondition the iteration. The forces stay balanced even if the iteration ends
 * before it has found the minimum.
 *
 * If the constraints are violated, the omitted rows need not depend on the other rows, and N z may
 * disturb the balance of the forces. Then only a fraction of N z is added, namely the largest
 * fraction that keeps the forces balanced. Usually this fraction is close to 1 or close to 0.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/golden.h"
#include "base/message.h"
#include "dynamics/block_path.h"
#include "linear/residual.h"

enum { MOST_ITERATIONS = 100 };

/* The iteration ends when the gradient has fallen to this fraction of the first gradient. */
static const double FOUND = 1e-12;
/* Tolerances of the residual of M a + J^T lambda = g. OF_ROW is relative to the terms of the same
 * row, OF_BODY to the largest row of the same body, and OF_ALL to the largest row of the mechanism.
 * OF_ALL allows for rounding. */
static const double OF_ROW = 1e-9;
static const double OF_BODY = 1e-11;
static const double OF_ALL = 1e-14;
/* This tolerance replaces OF_ALL when a null vector is added, because the small forces on light
 * bodies must stay balanced, too. */
static const double OF_ALL_SHARED = 1e-24;
/* A residual smaller than this, relative to the terms of its row, counts as zero. */
static const double ROUNDING = 1e-11;
/* The residual of N z may reach this fraction of the tolerances above. */
static const double SHARE = 0.02;

/* ---- null vectors ---- */

/* Factor the matrix of the system for N z. The head of this file states the system. `shift` (nc)
 * makes the matrix regular; it may be NULL. */
static baum_status factor_null_matrix(baum_workspace *w, const double *shift)
{
  const baum_i_sharing *r = &w->sharing;
  const baum_i_kkt_values values = {
    .mass = r->weight, .jacobian = w->jacobian, .shift = shift, .omitted = w->rows.omitted};
  for (int b = 0; b < w->structure.mass_block_count; b++) {
    const baum_i_mass_block *block = &w->structure.mass_blocks[b];
    for (int i = 0; i < block->size; i++) {
      double scale = w->mechanism->scale[block->first + i];
      r->weight[block->value + i * (block->size + 1)] = 1.0 / (scale * scale);
    }
  }
  return baum_i_kkt_factor(r->kkt, &values);
}

/* Compute out = N z for a vector z (nc) that is zero in the kept rows. If z is already a null
 * vector, `out` is the same null vector with smaller errors. */
static baum_status apply(baum_workspace *w, const double *z, double *out)
{
  int nv = w->mechanism->nv;
  int nc = w->mechanism->nc;
  double *f = w->work_v;
  memset(f, 0, (size_t)nv * sizeof *f);
  memset(w->work_c, 0, (size_t)nc * sizeof *w->work_c);
  baum_i_jacobian_transposed_times(&w->structure, w->jacobian, z, f);
  for (int i = 0; i < nv; i++) {
    f[i] = -f[i];
  }
  BAUM_I_TRY(baum_i_kkt_solve(w->sharing.kkt, f, w->work_c, f + nv, out));
  baum_i_add_scaled(nc, 1.0, z, out);
  return BAUM_OK;
}

/* Compute out = N^T u. */
static baum_status apply_transposed(baum_workspace *w, const double *u, double *out)
{
  int nv = w->mechanism->nv;
  int nc = w->mechanism->nc;
  double *f = w->work_v;
  memset(f, 0, (size_t)nv * sizeof *f);
  memset(out, 0, (size_t)nc * sizeof *out);
  BAUM_I_TRY(baum_i_kkt_solve(w->sharing.kkt, f, u, f + nv, w->work_c));
  baum_i_jacobian_times(&w->structure, w->jacobian, f + nv, out);
  for (int i = 0; i < nc; i++) {
    out[i] = w->rows.omitted[i] ? u[i] - out[i] : 0.0;
  }
  return BAUM_OK;
}

/* ---- least norm ---- */

/* The vectors of the method of conjugate gradients, each of length nc. */
typedef struct search {
  double *u;
  double *gradient;
  double *direction;
  double *image;
} search;

static search search_memory(const baum_workspace *w)
{
  double *work = w->sharing.work;
  int nc = w->mechanism->nc;
  return (search){
    .u = work, .gradient = work + nc, .direction = work + 2 * nc, .image = work + 3 * nc};
}

/* Find the gradient of |S (lambda + N z)|^2 / 2 with respect to z at N z = `part`. Set *size to the
 * square of its preconditioned length. */
static baum_status find_gradient(baum_workspace *w, const search *s, double *size)
{
  const baum_i_sharing *r = &w->sharing;
  for (int i = 0; i < w->mechanism->nc; i++) {
    s->u[i] = r->mobility[i] * (w->lambda[i] + r->part[i]);
  }
  BAUM_I_TRY(apply_transposed(w, s->u, s->gradient));
  *size = 0.0;
  for (int i = 0; i < w->mechanism->nc; i++) {
    *size += s->gradient[i] * s->gradient[i] / r->mobility[i];
  }
  return BAUM_OK;
}

/* Find the minimum along a new direction and add the step to `part`. The new direction is the
 * direction of steepest descent plus `share` times the last direction. */
static baum_status minimize_along(baum_workspace *w, const search *s, double size, double share)
{
  const baum_i_sharing *r = &w->sharing;
  int nc = w->mechanism->nc;
  for (int i = 0; i < nc; i++) {
    s->direction[i] = share * s->direction[i] - s->gradient[i] / r->mobility[i];
  }
  BAUM_I_TRY(apply(w, s->direction, s->image));
  double curvature = 0.0;
  for (int i = 0; i < nc; i++) {
    curvature += r->mobility[i] * s->image[i] * s->image[i];
  }
  baum_i_add_scaled(nc, size / curvature, s->image, r->part);
  return BAUM_OK;
}

/* Large forces cause rounding errors in rows with small forces. Remove these errors from `part`. */
static baum_status refine_part(baum_workspace *w)
{
  double *refined = search_memory(w).image;
  BAUM_I_TRY(apply(w, w->sharing.part, refined));
  memcpy(w->sharing.part, refined, (size_t)w->mechanism->nc * sizeof *refined);
  return BAUM_OK;
}

/* Find the z that minimizes |S (lambda + N z)|, and set `part` to N z. */
static baum_status find_part(baum_workspace *w)
{
  const baum_i_sharing *r = &w->sharing;
  search s = search_memory(w);
  size_t bytes = (size_t)w->mechanism->nc * sizeof *r->part;
  int most = w->rows.count == 1 ? 1 : 2 * w->rows.count;
  double size = 0.0;
  double first = 0.0;
  memset(r->part, 0, bytes);
  memset(s.direction, 0, bytes);
  baum_i_row_mobilities(w, r->mobility);
  for (int i = 0; i < w->mechanism->nc; i++) {
    r->mobility[i] = r->mobility[i] > 0.0 ? r->mobility[i] : 1.0;
  }
  BAUM_I_TRY(factor_null_matrix(w, NULL));
  for (int k = 0; k < most && k < MOST_ITERATIONS; k++) {
    double before = size;
    BAUM_I_TRY(find_gradient(w, &s, &size));
    first = k == 0 ? size : first;
    if (size <= FOUND * FOUND * first) {
      break;
    }
    BAUM_I_TRY(minimize_along(w, &s, size, k == 0 ? 0.0 : size / before));
  }
  return refine_part(w);
}

/* ---- balance ---- */

/* Vectors of length nv + nc for the system with the matrix K of M and J: the right-hand side b, the
 * solution x, residual = b - K x, and size = |b| + |K| |x|. */
typedef struct balance {
  double *b;
  double *x;
  double *residual;
  double *size;
} balance;

/* Compute the residual g - M a - J^T lambda. */
static balance compute_balance(const baum_workspace *w, const double *force, const double *a,
                               const double *lambda)
{
  int nv = w->mechanism->nv;
  int n = nv + w->mechanism->nc;
  double *system = w->sharing.system;
  balance out = {system, system + n, system + 2 * n, system + 3 * n};
  const baum_i_kkt_values values = {.mass = w->mass, .jacobian = w->jacobian};
  memset(system, 0, 2 * (size_t)n * sizeof *system);
  for (int i = 0; i < nv; i++) {
    out.b[i] = force ? force[i] : 0.0;
    out.x[i] = a ? a[i] : 0.0;
  }
  memcpy(out.x + nv, lambda, (size_t)(n - nv) * sizeof *lambda);
  baum_i_residual_form(&w->structure, &values, out.b, out.x, out.residual, out.size);
  return out;
}

/* Return the largest of `count` entries of terms[], which belong to rows of M a + J^T lambda = g.
 * Each entry is multiplied by the scale of its coordinate. */
static double largest_scaled(const baum_workspace *w, const double *terms, int first, int count)
{
  double most = 0.0;
  for (int i = first; i < first + count; i++) {
    most = fmax(most, fabs(terms[i]) * w->mechanism->scale[i]);
  }
  return most;
}

/* Write the tolerance of each row to w->work_v. */
static void set_limits(const baum_workspace *w, const balance *at, double of_all)
{
  const baum_mechanism *m = w->mechanism;
  double all = of_all * largest_scaled(w, at->size, 0, m->nv);
  for (int b = 1; b <= m->body_count; b++) {
    int first = m->bodies[b]->v;
    int end = first + m->bodies[b]->nv;
    double least = fmax(all, OF_BODY * largest_scaled(w, at->size, first, end - first));
    for (int i = first; i < end; i++) {
      w->work_v[i] = fmax(least / m->scale[i], OF_ROW * at->size[i]);
    }
  }
}

/* Find the largest ratio of a residual to its tolerance, and the row in which it occurs (*worst). A
 * residual of NaN counts as infinite. */
static double find_imbalance(const baum_workspace *w, const balance *at, int *worst)
{
  double most = 0.0;
  for (int i = 0; i < w->mechanism->nv; i++) {
    double size = fabs(at->residual[i]);
    double share = size <= ROUNDING * at->size[i] ? 0.0 : size / w->work_v[i];
    if (!(share <= most)) {
      most = isnan(share) ? (double)INFINITY : share;
      *worst = i;
    }
  }
  return most;
}

/* Compute the residual of the last solution. */
static balance compute_solution_balance(const baum_workspace *w)
{
  return compute_balance(w, baum_i_solved_force(w), w->a, w->lambda);
}

static double find_imbalance_of_solution(const baum_workspace *w)
{
  int worst = 0;
  balance at = compute_solution_balance(w);
  set_limits(w, &at, OF_ALL_SHARED);
  return find_imbalance(w, &at, &worst);
}

static baum_status check_balance(const baum_workspace *w)
{
  int worst = 0;
  balance at = compute_solution_balance(w);
  set_limits(w, &at, OF_ALL);
  double imbalance = find_imbalance(w, &at, &worst);
  if (imbalance <= 1.0) {
    return BAUM_OK;
  }
  const baum_i_body *body = baum_i_velocity_body(w->mechanism, worst);
  return baum_i_fail(
    BAUM_ERR_SINGULAR,
    "t = %.9g s: the multipliers balance the forces on %s only to a relative error of %.2g, must "
    "be at most %g; the masses differ too much, or the configuration is close to a singular one",
    w->point.t, baum_i_label(&body->element).text, imbalance * OF_ROW, OF_ROW);
}

/* Find the largest fraction of `part` whose residual is within the tolerances. */
static double find_share(const baum_workspace *w)
{
  int worst = 0;
  balance at = compute_balance(w, NULL, NULL, w->sharing.part);
  double imbalance = find_imbalance(w, &at, &worst);
  return imbalance <= SHARE ? 1.0 : SHARE / imbalance;
}

/* When N z is added, large forces on light bodies may cancel, and rounding errors of these large
 * forces remain. Remove these errors. */
static baum_status refine_multipliers(baum_workspace *w)
{
  int nv = w->mechanism->nv;
  double *change = search_memory(w).image;
  balance at = compute_solution_balance(w);
  memset(w->work_c, 0, (size_t)w->mechanism->nc * sizeof *w->work_c);
  BAUM_I_TRY(baum_i_kkt_solve(w->sharing.kkt, at.residual, w->work_c, w->work_v + nv, change));
  baum_i_add_scaled(w->mechanism->nc, 1.0, change, w->lambda);
  return BAUM_OK;
}

/* Add the largest fraction of `part` that keeps the forces balanced. If rounding still disturbs the
 * balance, add nothing. */
static void add_share(baum_workspace *w)
{
  double *before = search_memory(w).direction;
  size_t bytes = (size_t)w->mechanism->nc * sizeof *before;
  double imbalance_before = find_imbalance_of_solution(w);
  double share = find_share(w);
  memcpy(before, w->lambda, bytes);
  for (int i = 0; i < w->mechanism->nc && share > 0.0; i++) {
    w->lambda[i] += share * w->sharing.part[i];
  }
  double imbalance = find_imbalance_of_solution(w);
  if (imbalance > 2.0 * SHARE && refine_multipliers(w) == BAUM_OK) {
    imbalance = find_imbalance_of_solution(w);
  }
  if (imbalance > fmax(imbalance_before, 1.0)) {
    memcpy(w->lambda, before, bytes);
  }
}

baum_status baum_i_make_multipliers_least(baum_workspace *w)
{
  baum_status found = find_part(w);
  if (found == BAUM_ERR_NOT_FINITE) {
    w->point.retry = true;
    return baum_i_fail_not_finite(w);
  }
  baum_status status = found == BAUM_OK || found == BAUM_ERR_SINGULAR ? check_balance(w) : found;
  if (found == BAUM_OK && status == BAUM_OK) {
    add_share(w);
  }
  return status;
}

/* ---- which multipliers are not unique ---- */

/* A multiplier is not unique if its component in a generic null vector is larger than SHARED. In
 * omitted rows the components are about 1. Rounding errors are far smaller than SHARED. */
static const double SHARED = 1e-6;

/* Relative size of the shift that makes the matrix regular in every case. Iterative refinement
 * removes the error that the shift causes. */
static const double SHIFT = 1e-12;

/* Set `part` to a generic null vector of J^T, with each component multiplied by the displacement of
 * its row (baum_i_row_displacements()). Set *least to the size above which components count as
 * non-zero. If the constraints are violated, components that should be zero are about as large as
 * the relative residual of the vector. */
static baum_status find_null_vector(baum_workspace *w, double *least)
{
  const baum_i_sharing *r = &w->sharing;
  int nc = w->mechanism->nc;
  double *z = search_memory(w).direction;
  double *size = search_memory(w).u;
  baum_i_row_displacements(w, size);
  for (int i = 0; i < nc; i++) {
    z[i] = w->rows.omitted[i] ? baum_i_golden(i + 1) / size[i] : 0.0;
    w->shift[i] = SHIFT * size[i] * size[i];
  }
  BAUM_I_TRY(factor_null_matrix(w, w->shift));
  BAUM_I_TRY(apply(w, z, r->part));
  BAUM_I_TRY(refine_part(w));
  BAUM_I_TRY(refine_part(w));
  balance at = compute_balance(w, NULL, NULL, r->part);
  double off = largest_scaled(w, at.residual, 0, w->mechanism->nv) /
               largest_scaled(w, at.size, 0, w->mechanism->nv);
  *least = fmax(SHARED, 10.0 * off);
  for (int i = 0; i < nc; i++) {
    r->part[i] *= size[i];
  }
  return BAUM_OK;
}

/* Return the largest component of `part` in the rows of a joint. */
static double part_of(const baum_workspace *w, const baum_i_joint *joint)
{
  double part = 0.0;
  (void)baum_i_largest(w->sharing.part + joint->row, joint->rows, &part);
  return part;
}

static void list_joints(const baum_workspace *w, double least, char *text, size_t size)
{
  const baum_mechanism *m = w->mechanism;
  size_t used = 0;
  for (int j = 0; j < m->joint_count && used + 1 < size; j++) {
    if (part_of(w, m->joints[j]) > least) {
      int wrote = snprintf(text + used, size - used, "%s\"%s\"", used ? ", " : "",
                           m->joints[j]->element.name);
      used += wrote > 0 ? (size_t)wrote : 0;
    }
  }
}

baum_status baum_i_redundancy_text(baum_workspace *w, char *text, size_t size)
{
  text[0] = '\0';
  double least = 0.0;
  BAUM_I_TRY(find_null_vector(w, &least));
  list_joints(w, least, text, size);
  return BAUM_OK;
}

baum_status baum_i_find_unique_multipliers(baum_workspace *w, bool *unique)
{
  bool any_shared = w->rows.count > 0;
  double least = 0.0;
  BAUM_I_TRY(any_shared ? find_null_vector(w, &least) : BAUM_OK);
  for (int i = 0; i < w->mechanism->nc; i++) {
    unique[i] = !any_shared || fabs(w->sharing.part[i]) <= least;
  }
  return BAUM_OK;
}
