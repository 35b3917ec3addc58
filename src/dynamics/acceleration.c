/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes accelerations and multipliers from
 *
 *   [ M  J^T ] [ a      ]   [ g                                   ]
 *   [ J   0  ] [ lambda ] = [ gamma - 2 alpha Phi' - beta^2 Phi ]
 *
 * This is equation (7) of Flores et al. 2008. With alpha = beta = 0 it is equation (5).
 *
 * The projections of positions and velocities solve systems with the same matrix, but with other
 * right-hand sides.
 *
 * Rows that always depend on other rows are omitted from the system. Their multipliers are set to
 * zero. The result is then one of many possible sets of multipliers. If alpha = beta = 0,
 * users receive the set of least norm instead (least_multipliers.c).
 */
#include <string.h>

#include "base/message.h"
#include "dynamics/block_path.h"

/* Name the row with the largest right-hand side in the message. When there is no solution, this row
 * is the only hint at the joint that causes the singularity, and the hint may be wrong. */
static baum_status fail_singular(const baum_workspace *w)
{
  int row = baum_i_largest(w->rhs, w->mechanism->nc, NULL);
  return baum_i_fail(
    BAUM_ERR_SINGULAR,
    "t = %.9g s: the equations of motion are singular (J has lost rank, or the mass matrix is not "
    "positive for motions that the constraints allow); the right-hand side of the constraints is "
    "largest in %s",
    w->point.t, baum_i_row_label(w->mechanism, row).text);
}

static baum_status fail_blocks(const baum_workspace *w)
{
  int joint = -1;
  (void)baum_i_smallest_pivot(w, &joint);
  return baum_i_fail(
    BAUM_ERR_SINGULAR,
    "t = %.9g s: the pivots of the block solver are too small, the smallest in %s: the "
    "configuration is close to a singular one, or the masses differ too much; choose the "
    "solver auto, which can use klu and qr here",
    w->point.t, baum_i_joint_label(w->mechanism, joint).text);
}

/* ---- the solver of the whole system ---- */

/* Evaluate all terms that the system and its right-hand side need. gamma and g are evaluated only
 * if `force` is true. Otherwise g is set to zero. */
static baum_status evaluate_stage(baum_workspace *w, double t, const double *q, const double *v,
                                  bool force)
{
  if (force) {
    return baum_i_velocity_stage(w, t, q, v);
  }
  memset(w->force, 0, (size_t)w->mechanism->nv * sizeof *w->force);
  if (!v) {
    return baum_i_position_stage(w, t, q);
  }
  BAUM_I_TRY(baum_i_violation(w, t, q, v));
  return baum_i_evaluate_mass(w);
}

/* `right` is passed by value, so that the compiler keeps its members in registers. */
static void set_right_side(const baum_workspace *w, baum_i_right_side right)
{
  for (int i = 0; i < w->mechanism->nc; i++) {
    double f = right.row_gains ? right.row_gains[i] : 1.0;
    double r = right.bending != 0.0 ? right.bending * w->gamma[i] : 0.0;
    r -= right.damping != 0.0 ? f * right.damping * w->phi_rate[i] : 0.0;
    r -= right.stiffness != 0.0 ? f * f * right.stiffness * w->phi[i] : 0.0;
    w->rhs[i] = r;
  }
}

/* Solve the whole system with the terms that have been evaluated last. */
static baum_status solve_whole(baum_workspace *w, const baum_i_right_side *right)
{
  const baum_i_kkt_values values = baum_i_kkt_values_of(w);
  set_right_side(w, *right);
  baum_status status =
    baum_i_kkt_factor_and_solve(w->kkt, &values, w->force, w->rhs, w->a, w->lambda);
  w->solved_by = NULL;
  return status;
}

baum_status baum_i_report_constraints(const baum_workspace *w, baum_status status)
{
  switch ((int)status) {
  case BAUM_ERR_SINGULAR:
    return baum_i_fail(status, "t = %.9g s: the constraints are singular in this configuration",
                       w->point.t);
  case BAUM_ERR_NOT_FINITE: return baum_i_fail_not_finite(w);
  default: return status;
  }
}

baum_status baum_i_solve_motion(baum_workspace *w, double t, const double *q, const double *v,
                                const baum_i_right_side *right)
{
  baum_status status =
    w->motion ? baum_i_block_path_solve(w, w->motion, t, q, v, right) : BAUM_ERR_SINGULAR;
  if (status != BAUM_ERR_SINGULAR) {
    return status;
  }
  BAUM_I_TRY(evaluate_stage(w, t, q, v, right->force));
  BAUM_I_TRY(baum_i_report_constraints(w, solve_whole(w, right)));
  baum_i_rest_fixed_bodies(w->mechanism, w->a);
  return BAUM_OK;
}

/* ---- accelerations ---- */

static baum_status accelerate_whole(baum_workspace *w, const baum_i_right_side *right)
{
  baum_status status = solve_whole(w, right);
  w->evaluations++;
  w->near_singular += baum_i_kkt_get_quality(w->kkt) != BAUM_I_KKT_GOOD ? 1 : 0;
  if (status == BAUM_ERR_NOT_FINITE) {
    w->point.retry = true;
    return baum_i_fail_not_finite(w);
  }
  return status == BAUM_ERR_SINGULAR ? fail_singular(w) : status;
}

/* Solve by the given block path. If `path` is NULL, or if its pivots are too small, use the solver
 * of the whole system instead. If w->blocks_only forbids this solver, small pivots are an error. */
static baum_status accelerate_by(baum_workspace *w, baum_i_block_path *path, double t,
                                 const double *q, const double *v, double alpha, double beta)
{
  const baum_i_right_side right = {.bending = 1.0,
                                   .damping = 2.0 * alpha,
                                   .stiffness = beta * beta,
                                   .force = true,
                                   .row_gains = w->row_gains};
  if (path) {
    baum_status status = baum_i_block_path_solve(w, path, t, q, v, &right);
    if (status != BAUM_ERR_SINGULAR) {
      w->evaluations += status == BAUM_OK ? 1 : 0;
      return status;
    }
    if (w->blocks_only) {
      return fail_blocks(w);
    }
  }
  BAUM_I_TRY(baum_i_velocity_stage(w, t, q, v));
  return accelerate_whole(w, &right);
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

/* The block solver only factors its matrix, because the pivots are part of the factors. Without the
 * block solver, or if baum_i_blocks_tell() rejects its pivot, the accelerations are computed. For
 * the solver of the whole system this costs little more than factoring. */
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
