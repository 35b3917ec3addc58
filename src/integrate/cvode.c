/* SPDX-License-Identifier: BSD-3-Clause */
/* CVODE of SUNDIALS (S. Cohen, A. Hindmarsh, 1996; A. Hindmarsh et al., ACM TOMS 31, 2005): linear multistep
 * methods of variable order and step for
 *
 *   y = (q, v)                                       (nq + nv)
 *   y' = (N v, a(t, q, v))                           a from (5) or (7), N the identity so far
 *
 * Adams-Moulton, orders 1 to 12, with fixed-point iteration, or where there are gains with Newton's iteration on their
 * part of the Jacobian (cvode_embedded.c); BDF, orders 1 to 5, with Newton's iteration on the true Jacobian (cvode_newton.c)
 * and projection (cvode_projection.c). Errors are measured in the weighted root mean square over y, with the tolerances of
 * baum_i_problem_tolerances().
 */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include <math.h>
#include <string.h>

#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "base/alloc.h"
#include "integrate/cvode.h"
#include "integrate/cvode_embedded.h"
#include "integrate/cvode_newton.h"
#include "integrate/cvode_projection.h"
#include "integrate/sundials_common.h"

/* Memory of a run. */
typedef struct cvode_run {
  baum_i_sundials sundials;
  void *cvode;
  bool stops;                     /* a stop time is set */
  N_Vector y;                     /* end of the last step */
  N_Vector inside;                /* interpolated */
  N_Vector work;                  /* of the projection */
  SUNNonlinearSolver fixed_point; /* Adams without gains */
  baum_i_cvode_embedded embedded; /* Adams with gains */
  baum_i_cvode_newton newton;     /* BDF */
  baum_i_statistics before;       /* up to the last restart */
} cvode_run;

static const baum_i_sundials_flag FLAGS[] = {
  {CV_TOO_MUCH_ACC, BAUM_ERR_STEP,
   "rtol and atol ask for more digits than double precision has; raise rtol"},
  {CV_ERR_FAILURE, BAUM_ERR_STEP,
   "the error stays above the tolerance however small the step; a force may jump here, the "
   "position may be near singular, or rtol is too small"},
  {CV_CONV_FAILURE, BAUM_ERR_CONVERGENCE,
   "the iteration does not converge however small the step; forces may be stiff, which only "
   "cvode_bdf and ida are for, or the position near singular, where projection helps"},
  {CV_TOO_CLOSE, BAUM_ERR_STEP, "no first step can be found; the scales of time differ too much"},
  {CV_LSETUP_FAIL, BAUM_ERR_SINGULAR,
   "the matrix of Newton's iteration cannot be factored; take a fixed-point method such as "
   "cvode_adams, or rk8"},
  {CV_LSOLVE_FAIL, BAUM_ERR_SINGULAR,
   "the matrix of Newton's iteration cannot be solved with; take rk8, or a smaller rtol"},
  {CV_NLS_FAIL, BAUM_ERR_CONVERGENCE, "the iteration failed; take rk8, or a smaller rtol"},
  {CV_ILL_INPUT, BAUM_ERR_NOT_FINITE,
   "the state or its tolerances are not finite; the motion grows without bound, or rtol and atol "
   "are too small"},
  {CV_MEM_FAIL, BAUM_ERR_MEMORY, "out of memory"},
  {0, BAUM_OK, NULL},
};

/* ---- callbacks ---- */

static int evaluate(sunrealtype tau, N_Vector y, N_Vector rate, void *user)
{
  cvode_run *run = user;
  /* SUNDIALS 6.4's fixed-point solver takes every failure for one that a smaller step may cure. */
  if (run->sundials.stopped) {
    return -1;
  }
  const baum_i_problem *problem = run->sundials.problem;
  const baum_workspace *workspace = problem->workspace;
  int nq = workspace->mechanism->nq;
  int nv = workspace->mechanism->nv;
  const double *q = N_VGetArrayPointer(y);
  double *dy = N_VGetArrayPointer(rate);
  baum_status status = baum_i_problem_motion(problem, run->sundials.origin + tau, q, q + nq);
  if (status == BAUM_OK) {
    memcpy(dy, q + nq, (size_t)nq * sizeof *dy);
    memcpy(dy + nq, workspace->a, (size_t)nv * sizeof *dy);
  }
  return baum_i_sundials_answer(&run->sundials, status);
}

/* The system of Newton's iteration, always anew: its derivatives cost about an evaluation.
 * NOLINTNEXTLINE(readability-function-size): CVODE's parameters. */
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

static int project(sunrealtype tau, N_Vector y, N_Vector correction, sunrealtype tolerance,
                   N_Vector error, void *user)
{
  (void)tolerance; /* the projection goes to rounding */
  cvode_run *run = user;
  double t = run->sundials.origin + tau;
  return baum_i_cvode_project(&run->sundials, t, y, correction, error, run->work);
}

static int weigh(N_Vector y, N_Vector weights, void *user)
{
  const cvode_run *run = user;
  const baum_i_problem *problem = run->sundials.problem;
  const double *v = N_VGetArrayPointer(y) + problem->workspace->mechanism->nq;
  baum_i_sundials_weights(problem, v, N_VGetArrayPointer(weights));
  return 0;
}

/* ---- in and out ---- */

static void begin(cvode_run *run, const baum_i_problem *problem, double t)
{
  baum_i_sundials_begin(&run->sundials, problem, t);
  run->sundials.origin = t;
}

static void load(cvode_run *run, const baum_i_problem *problem, const baum_i_state *state)
{
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  double *y = N_VGetArrayPointer(run->y);
  memcpy(y, state->q, (size_t)mechanism->nq * sizeof *y);
  memcpy(y + mechanism->nq, state->v, (size_t)mechanism->nv * sizeof *y);
}

static baum_status fail(const cvode_run *run, int flag)
{
  double step = 0.0;
  (void)CVodeGetCurrentStep(run->cvode, &step);
  return baum_i_sundials_fail(&run->sundials, FLAGS, flag, step);
}

static baum_status interpolate(void *self, const baum_i_problem *problem, double t, double *q,
                               double *v)
{
  cvode_run *run = self;
  double end = 0.0;
  double last = 0.0;
  (void)CVodeGetCurrentTime(run->cvode, &end);
  (void)CVodeGetLastStep(run->cvode, &last);
  double tau = baum_i_sundials_inside(&run->sundials, t, end, last);
  if (isnan(tau) || CVodeGetDky(run->cvode, tau, 0, run->inside) != CV_SUCCESS) {
    return baum_i_sundials_fail_outside(&run->sundials, t);
  }
  baum_i_sundials_unload(problem, run->inside, q, v);
  return BAUM_OK;
}

/* ---- statistics and restart ---- */

static void count(const void *self, baum_i_statistics *out)
{
  const cvode_run *run = self;
  long rejected[2] = {0, 0};
  long setups = 0;
  long iterations = 0;
  (void)CVodeGetNumErrTestFails(run->cvode, &rejected[0]);
  (void)CVodeGetNumStepSolveFails(run->cvode, &rejected[1]);
  (void)CVodeGetNumLinSolvSetups(run->cvode, &setups);
  (void)CVodeGetNumNonlinSolvIters(run->cvode, &iterations);
  out->rejected = run->before.rejected + rejected[0] + rejected[1];
  out->factorizations = run->before.factorizations + setups;
  out->full_factorizations = run->newton.klu.full_factorizations;
  out->nonlinear_iterations = run->before.nonlinear_iterations + iterations;
}

static baum_status restart(void *self, const baum_i_problem *problem, const baum_i_state *state)
{
  cvode_run *run = self;
  baum_i_statistics present;
  count(run, &present);
  run->before = present;
  begin(run, problem, state->t);
  load(run, problem, state);
  int flag = CVodeReInit(run->cvode, 0.0, run->y);
  run->sundials.unfinished = flag != CV_SUCCESS;
  return flag == CV_SUCCESS ? BAUM_OK : fail(run, flag);
}

static void forget(void *self)
{
  cvode_run *run = self;
  run->sundials.unfinished = true;
  run->newton.klu.forgotten = true;
}

/* ---- one step ---- */

/* SUNDIALS 6.4 cannot take a stop back, only put it off. */
static void give_stop(cvode_run *run, const baum_i_problem *problem)
{
  if (problem->stops || run->stops) {
    double stop =
      problem->stops ? problem->stop - run->sundials.origin : problem->direction * (double)INFINITY;
    (void)CVodeSetStopTime(run->cvode, stop); /* fails only where the stop is behind */
    run->stops = problem->stops;
  }
}

static baum_status advance(void *self, const baum_i_problem *problem, baum_i_state *state)
{
  cvode_run *run = self;
  baum_status status = run->sundials.unfinished ? restart(self, problem, state) : BAUM_OK;
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_sundials_begin_step(&run->sundials, problem, state->t);
  double before = 0.0;
  double tau = 0.0;
  (void)CVodeGetCurrentTime(run->cvode, &before);
  double target = baum_i_sundials_target(problem, before);
  give_stop(run, problem);
  int flag = CVode(run->cvode, target, run->y, &tau, CV_ONE_STEP);
  if (flag < 0) {
    return fail(run, flag);
  }
  double t = run->sundials.origin + tau;
  status = baum_i_sundials_check_progress(&run->sundials, before, tau);
  if (status == BAUM_OK) {
    run->sundials.unfinished = false;
    state->t = t;
    baum_i_sundials_unload(problem, run->y, state->q, state->v);
  }
  return status;
}

/* ---- life ---- */

static void destroy(void *self)
{
  cvode_run *run = self;
  if (!run) {
    return;
  }
  CVodeFree(&run->cvode);
  (void)SUNNonlinSolFree(run->fixed_point);
  baum_i_cvode_embedded_close(&run->embedded);
  baum_i_cvode_newton_close(&run->newton);
  baum_i_sundials_close(&run->sundials);
  baum_i_free(run);
}

static int attach_fixed_point(cvode_run *run)
{
  run->fixed_point = SUNNonlinSol_FixedPoint(run->y, 0, run->sundials.context);
  return run->fixed_point ? CVodeSetNonlinearSolver(run->cvode, run->fixed_point) : CV_MEM_FAIL;
}

static int attach_adams(cvode_run *run, const baum_i_problem *problem)
{
  bool gains =
    problem->formulation == BAUM_FORMULATION_BAUMGARTE && problem->workspace->mechanism->nc > 0;
  return gains ? baum_i_cvode_embedded_attach(&run->embedded, &run->sundials, run->cvode, run->y)
               : attach_fixed_point(run);
}

static int attach_bdf(cvode_run *run, const baum_i_problem *problem)
{
  SUNLinearSolver solver = run->newton.solver;
  /* These two have flags of their own; only memory can be wrong. */
  bool attached =
    CVodeSetLinearSolver(run->cvode, solver, run->newton.klu.matrix) == CVLS_SUCCESS &&
    CVodeSetLinSysFn(run->cvode, build) == CVLS_SUCCESS;
  if (!attached) {
    return CV_MEM_FAIL;
  }
  bool projects = problem->formulation == BAUM_FORMULATION_PROJECTION;
  return projects ? CVodeSetProjFn(run->cvode, project) : CV_SUCCESS;
}

static int start_cvode(cvode_run *run, int method, const baum_i_problem *problem)
{
  run->cvode = CVodeCreate(method, run->sundials.context);
  if (!run->cvode) {
    return CV_MEM_FAIL;
  }
  int flag = BAUM_I_SUNDIALS_SILENCE(CVodeSetErrHandlerFn, run->cvode, &run->sundials);
  if (flag == CV_SUCCESS) {
    flag = CVodeSetUserData(run->cvode, run);
  }
  if (flag == CV_SUCCESS) {
    flag = CVodeInit(run->cvode, evaluate, 0.0, run->y);
  }
  if (flag == CV_SUCCESS) {
    flag = CVodeWFtolerances(run->cvode, weigh);
  }
  if (flag == CV_SUCCESS) {
    flag = method == CV_ADAMS ? attach_adams(run, problem) : attach_bdf(run, problem);
  }
  if (flag == CV_SUCCESS && isfinite(problem->max_step)) {
    flag = CVodeSetMaxStep(run->cvode, problem->max_step);
  }
  return flag;
}

static baum_status set_up(cvode_run *run, int method, const char *name,
                          const baum_i_problem *problem, const baum_i_state *start)
{
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  baum_status status = baum_i_sundials_open(&run->sundials, name, mechanism->nq + mechanism->nv);
  if (status != BAUM_OK) {
    return status;
  }
  run->y = baum_i_sundials_vector(&run->sundials);
  run->inside = baum_i_sundials_vector(&run->sundials);
  run->work = baum_i_sundials_vector(&run->sundials);
  begin(run, problem, start->t);
  load(run, problem, start);
  if (method == CV_BDF) {
    status = baum_i_cvode_newton_open(&run->newton, &run->sundials);
    if (status != BAUM_OK) {
      return status;
    }
  }
  int flag = start_cvode(run, method, problem);
  run->sundials.unfinished = flag != CV_SUCCESS;
  return flag == CV_SUCCESS ? BAUM_OK : baum_i_sundials_fail(&run->sundials, FLAGS, flag, 0.0);
}

static baum_status create(int method, const char *name, const baum_i_problem *problem,
                          const baum_i_state *start, void **out)
{
  *out = NULL;
  cvode_run *run = baum_i_alloc(1, sizeof *run);
  if (!run) {
    return baum_i_fail_memory();
  }
  baum_status status = set_up(run, method, name, problem, start);
  if (status != BAUM_OK) {
    destroy(run);
    return status;
  }
  *out = run;
  return BAUM_OK;
}

/* ---- for tests ---- */

baum_status baum_i_cvode_solve_newton(void *self, double t, const double *y, double gamma,
                                      const double *r, double *x)
{
  cvode_run *run = self;
  size_t n = (size_t)N_VGetLength(run->y);
  baum_status status = baum_i_cvode_newton_fill(&run->newton, t, y, gamma);
  if (status != BAUM_OK) {
    return status;
  }
  SUNLinearSolver solver = run->newton.solver;
  memcpy(N_VGetArrayPointer(run->work), r, n * sizeof *r);
  bool solved = SUNLinSolSetup(solver, NULL) == 0 &&
                SUNLinSolSolve(solver, NULL, run->inside, run->work, 0.0) == 0;
  memcpy(x, N_VGetArrayPointer(run->inside), n * sizeof *x);
  return solved ? BAUM_OK : BAUM_ERR_SINGULAR;
}

baum_status baum_i_cvode_explain_flag(int flag)
{
  const baum_i_sundials sundials = {.integrator = "cvode"};
  return baum_i_sundials_fail(&sundials, FLAGS, flag, 1e-3);
}

/* ---- the two integrators ---- */

static const baum_formulation ADAMS_FORMULATIONS[] = {
  BAUM_FORMULATION_BAUMGARTE,
  BAUM_FORMULATION_UNSTABILIZED,
  BAUM_FORMULATION_DEFAULT,
};

static const baum_formulation BDF_FORMULATIONS[] = {
  BAUM_FORMULATION_PROJECTION,
  BAUM_FORMULATION_BAUMGARTE,
  BAUM_FORMULATION_UNSTABILIZED,
  BAUM_FORMULATION_DEFAULT,
};

static baum_status create_adams(const baum_i_problem *problem, const baum_i_state *start,
                                void **out)
{
  return create(CV_ADAMS, "cvode_adams", problem, start, out);
}

static baum_status create_bdf(const baum_i_problem *problem, const baum_i_state *start, void **out)
{
  return create(CV_BDF, "cvode_bdf", problem, start, out);
}

static const baum_integrator ADAMS = {
  .name = "cvode_adams",
  .formulations = ADAMS_FORMULATIONS,
  .why_no_projection = "CVODE projects only within BDF",
  .gains = BAUM_GAINS_AUTO,
  .family = BAUM_I_FAMILY_ADAMS,
  .create = create_adams,
  .destroy = destroy,
  .advance = advance,
  .interpolate = interpolate,
  .restart = restart,
  .forget = forget,
  .statistics = count,
};

static const baum_integrator BDF = {
  .name = "cvode_bdf",
  .formulations = BDF_FORMULATIONS,
  .gains = BAUM_GAINS_AUTO,
  .family = BAUM_I_FAMILY_BDF,
  .seen = 60.0 / 137.0,
  .create = create_bdf,
  .destroy = destroy,
  .advance = advance,
  .interpolate = interpolate,
  .restart = restart,
  .forget = forget,
  .statistics = count,
};

const baum_integrator *baum_cvode_adams(void)
{
  return &ADAMS;
}

const baum_integrator *baum_cvode_bdf(void)
{
  return &BDF;
}

#endif
