/* SPDX-License-Identifier: BSD-3-Clause */
/* Gains add -M^-1 J^T (J M^-1 J^T)^-1 (2 alpha Phi' + beta^2 Phi) to the accelerations a. The
 * constraints then act like springs and dampers with rates alpha and beta. This makes the equations
 * y' = f stiff, even if the motion is smooth. The part of df/dy that the gains cause is known:
 *
 *   df/dy = [ 0           I          ] + rest,     P = M^-1 J^T (J M^-1 J^T)^-1 J
 *           [ -beta^2 P   -2 alpha P ]
 *
 * CVODE requires solutions of (I - gamma df/dy) (dq, dv) = (r_q, r_v), where gamma is a coefficient
 * of CVODE, which is a fraction of the step. If the rest is neglected, P P = P gives the solution
 *
 *   dv = r_v - P (s r_v + gamma beta^2 r_q) / (1 + s),   dq = r_q + gamma dv,
 *   s = 2 alpha gamma + (beta gamma)^2
 *
 * A product with P costs one forward and back substitution with the factors of the previous
 * evaluation. If rows have different gains, row i has s = 2 alpha_i gamma + (beta_i gamma)^2. Then
 * with Q = M^-1 J^T (J M^-1 J^T)^-1, for which J Q = I, the solution is
 *
 *   dv = r_v - Q ((s J r_v + gamma beta_i^2 J r_q) / (1 + s))
 *
 * Rows of velocity level have no Phi, so their beta_i is 0.
 *
 * If q is not a vector, r_q stands for N^+ r_q in these equations, and dq = r_q + gamma N dv.
 *
 * If the run goes backward in time, both alpha and gamma change their signs. The neglected rest
 * contains the derivatives of forces, so stiff forces still require BDF.
 */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include "integrate/cvode_embedded.h"

#include <string.h>

#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#include "integrate/sundials_klu.h"

/* Convert the status of a solution to CVODE's flag. The flag 1 makes CVODE try a smaller step. */
static int answer(baum_i_sundials *sundials, baum_status status)
{
  if (status == BAUM_OK) {
    return 0;
  }
  return status == BAUM_ERR_MEMORY ? baum_i_sundials_answer(sundials, status) : 1;
}

/* Compute (s r_v + gamma beta^2 r_q) / (1 + s). */
static double weigh(double alpha, double beta, double gamma, double r_v, double r_q)
{
  double s = 2.0 * alpha * gamma;
  double stiffness = gamma * beta * beta;
  s += gamma * stiffness;
  return (s * r_v + stiffness * r_q) / (1.0 + s);
}

static baum_status solve_alike(const baum_i_problem *problem, double gamma, const double *r_q,
                               const double *r_v, double *work, double *normal)
{
  double alpha = problem->direction * problem->alpha;
  for (int i = 0; i < problem->workspace->mechanism->nv; i++) {
    work[i] = weigh(alpha, problem->beta, gamma, r_v[i], r_q[i]);
  }
  return baum_i_normal_part(problem->workspace, work, normal);
}

static baum_status solve_by_rows(const baum_i_problem *problem, double gamma, const double *r_q,
                                 const double *r_v, double *normal)
{
  baum_workspace *w = problem->workspace;
  int nc = w->mechanism->nc;
  double *rows_v = w->work_c;
  double *rows_q = rows_v + nc;
  BAUM_I_TRY(baum_i_need_jacobian(w));
  memset(rows_v, 0, 2 * (size_t)nc * sizeof *rows_v);
  baum_i_jacobian_times(&w->structure, w->jacobian, r_v, rows_v);
  baum_i_jacobian_times(&w->structure, w->jacobian, r_q, rows_q);
  for (int i = 0; i < nc; i++) {
    double f = w->row_gains[i];
    double beta = baum_i_is_velocity_row(w->mechanism, i) ? 0.0 : f * problem->beta;
    rows_v[i] = weigh(f * problem->direction * problem->alpha, beta, gamma, rows_v[i], rows_q[i]);
  }
  return baum_i_least_with_rows(w, rows_v, normal);
}

static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b,
                 sunrealtype tolerance)
{
  (void)matrix;
  (void)tolerance;
  baum_i_cvode_embedded *embedded = solver->content;
  const baum_i_problem *problem = embedded->sundials->problem;
  baum_workspace *w = problem->workspace;
  const baum_mechanism *m = w->mechanism;
  const double *q = embedded->sundials->present;
  const double *r = N_VGetArrayPointer(b);
  const double *r_q = baum_i_tangent(m, q, r, w->work_q);
  const double *r_v = r + m->nq;
  double *d = N_VGetArrayPointer(x);
  double *d_v = d + m->nq;
  double *normal = N_VGetArrayPointer(embedded->normal);
  double gamma = 0.0;
  (void)CVodeGetCurrentGamma(embedded->sundials->memory, &gamma);
  baum_status status = w->row_gains ? solve_by_rows(problem, gamma, r_q, r_v, normal)
                                    : solve_alike(problem, gamma, r_q, r_v, d, normal);
  for (int i = 0; i < m->nv && status == BAUM_OK; i++) {
    d_v[i] = r_v[i] - normal[i];
  }
  const double *rate = baum_i_rates(m, q, d_v, w->work_q);
  for (int i = 0; i < m->nq && status == BAUM_OK; i++) {
    d[i] = r[i] + gamma * rate[i];
  }
  return answer(embedded->sundials, status);
}

static SUNLinearSolver_Type tell_type(SUNLinearSolver solver)
{
  (void)solver;
  return SUNLINEARSOLVER_MATRIX_EMBEDDED;
}

int baum_i_cvode_embedded_attach(baum_i_cvode_embedded *embedded, baum_i_sundials *sundials)
{
  void *cvode = sundials->memory;
  embedded->sundials = sundials;
  embedded->normal = baum_i_sundials_vector(sundials);
  embedded->newton = SUNNonlinSol_Newton(sundials->y, sundials->context);
  embedded->solver = baum_i_sundials_front(sundials, embedded, NULL, solve);
  if (!embedded->newton || !embedded->solver) {
    return CV_MEM_FAIL;
  }
  embedded->solver->ops->gettype = tell_type;
  int flag = CVodeSetNonlinearSolver(cvode, embedded->newton);
  if (flag != CV_SUCCESS) {
    return flag;
  }
  /* CVodeSetLinearSolver() returns CVLS flags, not CV flags. It can fail only for lack of
   * memory. */
  return CVodeSetLinearSolver(cvode, embedded->solver, NULL) == CVLS_SUCCESS ? CV_SUCCESS
                                                                             : CV_MEM_FAIL;
}

void baum_i_cvode_embedded_close(baum_i_cvode_embedded *embedded)
{
  (void)SUNNonlinSolFree(embedded->newton);
  (void)SUNLinSolFree(embedded->solver);
}

#endif
