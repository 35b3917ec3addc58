/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's iteration of CVODE BDF requires the solution d = (dq, dv) of
 *
 *   (I - gamma df/dy) d = r,     f = (N v, a(t, q, v)), a from (5) or (7) of docs/notation.md
 *
 * The residual of index 1 (dae_matrix.c) defines a and the multipliers implicitly:
 *
 *   F = (q' - N v,  M v' + J^T lambda - g,  J v' - gamma + 2 alpha Phi' + beta^2 Phi)
 *
 * The last two parts of F are zero for v' = a(t, q, v). Let da = (da/dq) dq + (da/dv) dv be the
 * change of a, and dlambda the corresponding change of lambda. Differentiating the last two parts
 * then gives
 *
 *   F_q dq + F_v dv + F_lambda dlambda = - (M da, J da)
 *
 * With c = 1 / gamma it follows that
 *
 *   (dF/dy + c dF/dy') (dq, dv, dlambda) = (c dq - dv, M (c dv - da), J (c dv - da)).
 *
 * If the right-hand side of these equations is c (r_q, M r_v, J r_v), their solution satisfies dq -
 * gamma dv = r_q and dv - gamma da = r_v. These are the required equations. The part dlambda of the
 * solution is not needed. The matrix contains the derivatives of all forces and rows and is sparse.
 * (If q is not a vector, dq stands for a displacement of length nv and r_q for N^+ r_q. The part of
 * r_q off the manifold is added to dq unchanged.)
 */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include "integrate/cvode_newton.h"

#include <string.h>

#include "base/alloc.h"

static const baum_workspace *workspace_of(const baum_i_cvode_newton *newton)
{
  return newton->klu.sundials->problem->workspace;
}

/* ---- the matrix ---- */

baum_status baum_i_cvode_newton_fill(baum_i_cvode_newton *newton, double t, const double *y,
                                     double gamma)
{
  const baum_i_problem *problem = newton->klu.sundials->problem;
  const baum_workspace *w = problem->workspace;
  const baum_mechanism *m = w->mechanism;
  baum_dae dae = {.index = BAUM_RESIDUAL_INDEX1};
  baum_i_problem_gains(problem, &dae.alpha, &dae.beta);
  BAUM_I_TRY(baum_i_problem_acceleration(problem, t, y, y + m->nq));
  newton->c = 1.0 / gamma;
  newton->klu.sundials->present = newton->y;
  baum_i_sundials_pack(m, y, y + m->nq, newton->y);
  memcpy(newton->y + m->nq + m->nv, w->lambda, (size_t)m->nc * sizeof *y);
  baum_i_sundials_pack_rate(w, y, newton->dy);
  baum_status status =
    baum_i_sundials_klu_fill(&newton->klu, &dae, newton->c, t, newton->y, newton->dy);
  memcpy(newton->mass, w->mass, (size_t)m->mass_size * sizeof *y);
  memcpy(newton->jacobian, w->jacobian, (size_t)m->jacobian_size * sizeof *y);
  baum_i_clear_omitted_rows(w, newton->jacobian);
  return status;
}

/* ---- solve ---- */

static int factor(SUNLinearSolver solver, SUNMatrix matrix)
{
  (void)matrix;
  baum_i_cvode_newton *newton = solver->content;
  return baum_i_sundials_klu_factor(&newton->klu);
}

/* Compute the right-hand side c (r_q, M r_v, J r_v) of the linear equations above. It is 0 in rows
 * that were omitted when the matrix was computed, so dlambda of these rows is 0. */
static void make_right_side(const baum_i_cvode_newton *newton, const double *r, double *right)
{
  const baum_workspace *w = workspace_of(newton);
  const baum_mechanism *m = w->mechanism;
  double *forces = right + m->nv;
  double *rows = forces + m->nv;
  const baum_i_sundials *sundials = newton->klu.sundials;
  memcpy(right, baum_i_sundials_split(sundials, sundials->present, r), (size_t)m->nv * sizeof *r);
  memset(forces, 0, (size_t)(m->nv + m->nc) * sizeof *r);
  baum_i_mass_times(&w->structure, newton->mass, r + m->nq, forces);
  baum_i_jacobian_times(&w->structure, newton->jacobian, r + m->nq, rows);
  for (int i = 0; i < 2 * m->nv + m->nc; i++) {
    right[i] *= newton->c;
  }
}

static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b,
                 sunrealtype tolerance)
{
  (void)matrix;
  (void)tolerance;
  baum_i_cvode_newton *newton = solver->content;
  baum_i_sundials_klu *klu = &newton->klu;
  const baum_mechanism *m = workspace_of(newton)->mechanism;
  double *change = N_VGetArrayPointer(x);
  make_right_side(newton, N_VGetArrayPointer(b), N_VGetArrayPointer(klu->right));
  int failed = baum_i_sundials_klu_solve(klu, klu->solution, klu->right);
  double *solution = N_VGetArrayPointer(klu->solution);
  baum_i_rest_fixed_bodies(m, solution); /* exactly, without rounding */
  baum_i_rest_fixed_bodies(m, solution + m->nv);
  baum_i_sundials_join(klu->sundials, klu->sundials->present, solution, 1.0, change);
  memcpy(change + m->nq, solution + m->nv, (size_t)m->nv * sizeof *change);
  return failed;
}

/* ---- life ---- */

baum_status baum_i_cvode_newton_open(baum_i_cvode_newton *newton, baum_i_sundials *sundials)
{
  BAUM_I_TRY(baum_i_sundials_klu_open(&newton->klu, sundials, BAUM_RESIDUAL_INDEX1));
  const baum_mechanism *m = workspace_of(newton)->mechanism;
  size_t n = (size_t)baum_i_residual_size(m, BAUM_RESIDUAL_INDEX1);
  size_t count = 2 * n + (size_t)m->mass_size + (size_t)m->jacobian_size;
  newton->numbers = baum_i_alloc(count, sizeof *newton->numbers);
  BAUM_I_TRY(baum_i_check_memory(newton->numbers));
  newton->y = newton->numbers;
  newton->dy = newton->y + n;
  newton->mass = newton->dy + n;
  newton->jacobian = newton->mass + m->mass_size;
  newton->solver = baum_i_sundials_front(sundials, newton, factor, solve);
  return newton->solver ? BAUM_OK : baum_i_fail_memory();
}

void baum_i_cvode_newton_close(baum_i_cvode_newton *newton)
{
  (void)SUNLinSolFree(newton->solver);
  baum_i_sundials_klu_close(&newton->klu);
  baum_i_free(newton->numbers);
}

#endif
