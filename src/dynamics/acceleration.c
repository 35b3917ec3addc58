/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations and multipliers
 *
 *   [ M  J^T ] [ a      ]   [ g                                   ]
 *   [ J   0  ] [ lambda ] = [ gamma - 2 alpha Phi' - beta^2 Phi ]
 *
 * Flores et al. 2008 (7); (5) with alpha = beta = 0.
 *
 * Rows that permanently depend on others are left out. Their multipliers are then zero, which is
 * one of many solutions; what is reported to users is the one of least norm (least_multipliers.c).
 */
#include "base/message.h"
#include "dynamics/block_path.h"

/* Without a solution the largest right side is all there is to name a joint by: a hint, no
 * proof. */
static baum_status fail_singular(const baum_workspace *w)
{
  int row = baum_i_largest(w->rhs, w->mechanism->nc, NULL);
  char label[BAUM_I_LABEL_SIZE] = "no joint";
  if (row >= 0) {
    (void)baum_i_joint_label(w->mechanism, baum_i_row_joint(w->mechanism, row), label);
  }
  return baum_i_fail(
    BAUM_ERR_SINGULAR,
    "t = %.9g s: the equations of motion are singular (J has lost rank, or the mass "
    "matrix is not positive where the constraints leave freedom); largest right side in "
    "%s",
    w->point.t, label);
}

static baum_status translate(baum_workspace *w, baum_status status)
{
  switch ((int)status) {
  case BAUM_ERR_SINGULAR: return fail_singular(w);
  case BAUM_ERR_NOT_FINITE: w->point.retry = true; return baum_i_fail_not_finite(w);
  default: return status;
  }
}

static baum_status solve(baum_workspace *w)
{
  const baum_i_kkt_values values = {
    .mass = w->mass, .jacobian = w->jacobian, .omitted = baum_i_omitted_rows(w)};
  baum_status status =
    baum_i_kkt_factor_and_solve(w->kkt, &values, w->force, w->rhs, w->a, w->lambda);
  w->solved_by = NULL;
  w->evaluations++;
  w->near_singular += baum_i_kkt_get_quality(w->kkt) != BAUM_I_KKT_GOOD ? 1 : 0;
  return translate(w, status);
}

static baum_status fail_blocks(const baum_workspace *w)
{
  int joint = -1;
  (void)baum_i_smallest_pivot(w, &joint);
  char label[BAUM_I_LABEL_SIZE] = "no joint";
  if (joint >= 0) {
    (void)baum_i_joint_label(w->mechanism, joint, label);
  }
  return baum_i_fail(
    BAUM_ERR_SINGULAR,
    "t = %.9g s: pivots by blocks are too small, most of all in %s: the configuration is "
    "close to a singular one, or masses are too uneven; the solver auto goes on "
    "with klu and qr",
    w->point.t, label);
}

/* By the solver of the whole system. */
static baum_status accelerate(baum_workspace *w, double t, const double *q, const double *v,
                              double alpha, double beta)
{
  BAUM_I_TRY(baum_i_velocity_stage(w, t, q, v));
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->rhs[i] = w->gamma[i] - 2.0 * alpha * w->phi_rate[i] - beta * beta * w->phi[i];
  }
  for (int i = 0; w->row_gains && i < w->mechanism->nc; i++) {
    double f = w->row_gains[i];
    w->rhs[i] -= 2.0 * alpha * (f - 1.0) * w->phi_rate[i];
    w->rhs[i] -= beta * beta * (f * f - 1.0) * w->phi[i];
  }
  return solve(w);
}

/* By a path, or where that is NULL or hands over by the solver of the whole system. */
static baum_status accelerate_by(baum_workspace *w, baum_i_block_path *path, double t,
                                 const double *q, const double *v, double alpha, double beta)
{
  if (path) {
    const baum_i_right_side right = {.bending = 1.0,
                                     .damping = 2.0 * alpha,
                                     .stiffness = beta * beta,
                                     .force = true,
                                     .row_gains = w->row_gains};
    baum_status status = baum_i_block_path_solve(w, path, t, q, v, &right);
    if (status != BAUM_ERR_SINGULAR) {
      w->evaluations += status == BAUM_OK ? 1 : 0;
      return status;
    }
    if (w->blocks_only) {
      return fail_blocks(w);
    }
  }
  return accelerate(w, t, q, v, alpha, beta);
}

baum_status baum_i_acceleration(baum_workspace *w, double t, const double *q, const double *v,
                                double alpha, double beta)
{
  return accelerate_by(w, w->path, t, q, v, alpha, beta);
}

baum_status baum_i_motion(baum_workspace *w, double t, const double *q, const double *v,
                          double alpha, double beta)
{
  BAUM_I_TRY(accelerate_by(w, w->motion, t, q, v, alpha, beta));
  if (!w->solved_by) {
    baum_i_rest_fixed_bodies(w->mechanism, w->a);
  }
  return BAUM_OK;
}

/* Without blocks a solution costs little more than its factors. */
baum_status baum_i_find_pivot(baum_workspace *w, double t, const double *q, const double *v)
{
  if (!w->motion) {
    return baum_i_motion(w, t, q, v, 0.0, 0.0);
  }
  BAUM_I_TRY(baum_i_block_path_factor(w, w->motion, t, q));
  w->solved_by = NULL;
  return baum_i_blocks_tell(w) ? BAUM_OK : baum_i_motion(w, t, q, v, 0.0, 0.0);
}

baum_status baum_i_reported_acceleration(baum_workspace *w, double t, const double *q,
                                         const double *v)
{
  BAUM_I_TRY(baum_i_acceleration(w, t, q, v, 0.0, 0.0));
  BAUM_I_TRY(baum_i_need_jacobian(w));
  if (w->rows.count == 0) {
    return BAUM_OK;
  }
  BAUM_I_TRY(baum_i_evaluate_mass(w));
  return baum_i_make_multipliers_least(w);
}
