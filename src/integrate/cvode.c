/* SPDX-License-Identifier: BSD-3-Clause */
/* CVODE of SUNDIALS (S. Cohen, A. Hindmarsh, 1996; A. Hindmarsh et al., ACM TOMS 31, 2005): linear
 * multistep methods of variable order and step for
 *
 *   y = (q, v)                                       (nq + nv)
 *   y' = (N v, a(t, q, v))                           a from (5) or (7)
 *
 * where (5) and (7) are equations of docs/notation.md. Adams: Adams-Moulton of orders 1 to 12 with
 * fixed-point iteration. If there are gains, Newton's iteration is used instead, with only the part
 * of the Jacobian that the gains cause (cvode_embedded.c). BDF: orders 1 to 5 with Newton's
 * iteration, the exact Jacobian (cvode_newton.c) and projection. Errors are measured in the
 * weighted root mean square over y, with the tolerances of baum_i_problem_tolerances().
 */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include <string.h>

#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "integrate/cvode_embedded.h"
#include "integrate/cvode_newton.h"
#include "integrate/sundials_driver.h"

/* Memory of a run. */
typedef struct cvode_run {
  baum_i_sundials sundials;
  N_Vector work;                  /* scratch of the projection */
  SUNNonlinearSolver fixed_point; /* Adams without gains */
  baum_i_cvode_embedded embedded; /* Adams with gains */
  baum_i_cvode_newton newton;     /* BDF */
} cvode_run;

/* ---- callbacks ---- */

static int evaluate(sunrealtype tau, N_Vector y, N_Vector rate, void *user)
{
  cvode_run *run = user;
  /* `stopped` means that an evaluation has failed and that no smaller step can help. The
   * fixed-point solver of SUNDIALS 6.4 tries a smaller step nevertheless, so the failure is
   * returned again here. */
  if (run->sundials.stopped) {
    return -1;
  }
  const baum_i_problem *problem = run->sundials.problem;
  const baum_workspace *workspace = problem->workspace;
  const double *q = N_VGetArrayPointer(y);
  const double *v = q + workspace->mechanism->nq;
  run->sundials.present = q;
  baum_status status = baum_i_problem_motion(problem, run->sundials.origin + tau, q, v);
  if (status == BAUM_OK) {
    baum_i_sundials_pack_rate(workspace, q, N_VGetArrayPointer(rate));
  }
  return baum_i_sundials_answer(&run->sundials, status);
}

/* Compute a new matrix, even if CVODE would accept the old one. This costs about as much as one
 * evaluation. NOLINTNEXTLINE(readability-function-size): CVODE's parameters. */
static int build(sunrealtype tau, N_Vector y, N_Vector rate, SUNMatrix matrix,
                 sunbooleantype may_keep, sunbooleantype *is_new, sunrealtype gamma, void *user,
                 N_Vector work1, N_Vector work2, N_Vector work3)
{
  /* #lizard forgives: CVODE's parameters */
  (void)rate;
  (void)matrix;
  (void)may_keep;
  (void)work1;
  (void)work2;
  (void)work3;
  cvode_run *run = user;
  *is_new = SUNTRUE;
  double t = run->sundials.origin + tau;
  baum_status status = baum_i_cvode_newton_fill(&run->newton, t, N_VGetArrayPointer(y), gamma);
  return baum_i_sundials_answer(&run->sundials, status);
}

/* ---- projection ---- */

/* Projection within the steps of BDF (E. Eich, SIAM J. Numer. Anal. 30, 1993): after Newton's
 * iteration, q and v are moved onto the constraints by the least change in the metric of M. The
 * component of the estimated error of q normal to the constraint manifold is removed, because the
 * projection also removes this component of the true error:
 *
 *   e_q - N P N^+ e_q,     P = M^-1 J^T (J M^-1 J^T)^-1 J at the projected q,
 *
 * where the last factor J does not contain the rows of velocity level, because they do not restrict
 * q.
 *
 * The estimated error e_v of v is not changed, because the projection does not remove its whole
 * normal component: the error of q tangential to the manifold contributes J e_v = -(J v)_q e_q,
 * where the subscript q denotes a derivative. If P e_v is subtracted, errors are twice as large at
 * the same tolerance and the same cost (pendulum, slider-crank, four-bar, Andrews, rtol 1e-4 to
 * 1e-10).
 *
 * CVODE adds the correction to its history, so that the next prediction starts at the projected
 * state. The history of Adams methods consists of values of f, which cannot be corrected in this
 * way, so CVODE projects with BDF only. */

static void subtract(int n, const double *what, double *from)
{
  for (int i = 0; i < n; i++) {
    from[i] -= what[i];
  }
}

/* A projection that does not converge may converge after a smaller step. */
static int answer_projection(baum_i_sundials *sundials, baum_status status)
{
  int answered = baum_i_sundials_answer(sundials, status);
  if (status == BAUM_ERR_CONVERGENCE || status == BAUM_ERR_SINGULAR) {
    sundials->stopped = false;
    return 1;
  }
  return answered;
}

static int project(sunrealtype tau, N_Vector y, N_Vector correction, sunrealtype tolerance,
                   N_Vector error, void *user)
{
  (void)tolerance; /* the projection always converges to rounding */
  cvode_run *run = user;
  baum_workspace *w = run->sundials.problem->workspace;
  int nq = w->mechanism->nq;
  int nv = w->mechanism->nv;
  const double *state = N_VGetArrayPointer(y);
  double *projected = N_VGetArrayPointer(correction);
  memcpy(projected, state, (size_t)(nq + nv) * sizeof *state);
  baum_status status = baum_i_project(w, run->sundials.origin + tau, projected, projected + nq);
  subtract(nq + nv, state, projected);
  if (status == BAUM_OK && error) {
    double *e = N_VGetArrayPointer(error);
    double *normal = N_VGetArrayPointer(run->work);
    status = baum_i_displaced_part(w, baum_i_tangent(w->mechanism, state, e, w->work_q), normal);
    subtract(status == BAUM_OK ? nq : 0, baum_i_rates(w->mechanism, state, normal, w->work_q), e);
  }
  return answer_projection(&run->sundials, status);
}

/* ---- functions for the driver ---- */

static int size_of(const baum_i_problem *problem)
{
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  return mechanism->nq + mechanism->nv;
}

static baum_status open_bdf(baum_i_sundials *sundials)
{
  cvode_run *run = (cvode_run *)sundials;
  run->work = baum_i_sundials_vector(sundials);
  return baum_i_cvode_newton_open(&run->newton, sundials);
}

static int init(baum_i_sundials *sundials)
{
  return CVodeInit(sundials->memory, evaluate, 0.0, sundials->y);
}

static int attach_adams(baum_i_sundials *sundials)
{
  cvode_run *run = (cvode_run *)sundials;
  const baum_i_problem *problem = sundials->problem;
  if (problem->formulation == BAUM_FORMULATION_BAUMGARTE && problem->workspace->mechanism->nc > 0) {
    return baum_i_cvode_embedded_attach(&run->embedded, sundials);
  }
  run->fixed_point = SUNNonlinSol_FixedPoint(sundials->y, 0, sundials->context);
  return run->fixed_point ? CVodeSetNonlinearSolver(sundials->memory, run->fixed_point)
                          : CV_MEM_FAIL;
}

static int attach_bdf(baum_i_sundials *sundials)
{
  const baum_i_cvode_newton *newton = &((cvode_run *)sundials)->newton;
  void *cvode = sundials->memory;
  /* CVodeSetLinearSolver() and CVodeSetLinSysFn() return CVLS flags, not CV flags. They can fail
   * only for lack of memory. */
  bool attached = CVodeSetLinearSolver(cvode, newton->solver, newton->klu.matrix) == CVLS_SUCCESS &&
                  CVodeSetLinSysFn(cvode, build) == CVLS_SUCCESS;
  if (!attached) {
    return CV_MEM_FAIL;
  }
  bool projects = sundials->problem->formulation == BAUM_FORMULATION_PROJECTION;
  return projects ? CVodeSetProjFn(cvode, project) : CV_SUCCESS;
}

static int restart(baum_i_sundials *sundials)
{
  return CVodeReInit(sundials->memory, 0.0, sundials->y);
}

static int step(baum_i_sundials *sundials, double target, double *tau)
{
  return CVode(sundials->memory, target, sundials->y, tau, CV_ONE_STEP);
}

static void close_run(baum_i_sundials *sundials)
{
  cvode_run *run = (cvode_run *)sundials;
  (void)SUNNonlinSolFree(run->fixed_point);
  baum_i_cvode_embedded_close(&run->embedded);
  baum_i_cvode_newton_close(&run->newton);
}

static const baum_i_sundials_package PACKAGE = {
  .kind = BAUM_I_SUNDIALS_CVODE,
  BAUM_I_SUNDIALS_CALLS(CVode),
  .size = size_of,
  .create = CVodeCreate,
  .init = init,
  .weigh = baum_i_sundials_weigh,
  .restart = restart,
  .step = step,
  .close = close_run,
};

static const baum_i_sundials_method ADAMS_METHOD = {
  .name = "cvode_adams",
  .package = &PACKAGE,
  .multistep = CV_ADAMS,
  .attach = attach_adams,
};

static const baum_i_sundials_method BDF_METHOD = {
  .name = "cvode_bdf",
  .package = &PACKAGE,
  .open = open_bdf,
  .multistep = CV_BDF,
  .attach = attach_bdf,
};

#endif

/* ---- the two integrators ---- */

static const baum_integrator ADAMS = {
  .name = "cvode_adams",
  .formulations = {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED},
  .why_no_projection = "CVODE projects only within BDF",
  .gains = BAUM_GAINS_AUTO,
  .family = BAUM_I_FAMILY_ADAMS,
#if BAUM_HAVE_SUNDIALS
  .table = &ADAMS_METHOD,
  .memory = sizeof(cvode_run),
  BAUM_I_SUNDIALS_OPERATIONS,
#endif
};

static const baum_integrator BDF = {
  .name = "cvode_bdf",
  .formulations = {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE,
                   BAUM_FORMULATION_UNSTABILIZED},
  .gains = BAUM_GAINS_AUTO,
  .family = BAUM_I_FAMILY_BDF,
  .seen = 60.0 / 137.0,
#if BAUM_HAVE_SUNDIALS
  .table = &BDF_METHOD,
  .memory = sizeof(cvode_run),
  BAUM_I_SUNDIALS_OPERATIONS,
#endif
};

const baum_integrator *baum_cvode_adams(void)
{
  return &ADAMS;
}

const baum_integrator *baum_cvode_bdf(void)
{
  return &BDF;
}
