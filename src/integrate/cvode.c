/* SPDX-License-Identifier: BSD-3-Clause */
/* CVODE of SUNDIALS (S. Cohen, A. Hindmarsh, 1996; A. Hindmarsh et al., ACM TOMS 31, 2005): linear multistep
 * methods of variable order and step for
 *
 *   y = (q, v)                                       (nq + nv)
 *   y' = (N v, a(t, q, v))                           a from (5) or (7), N the identity so far
 *
 * Adams-Moulton, orders 1 to 12, with fixed-point iteration; BDF, orders 1 to 5, with Newton's iteration on the
 * dense Jacobian
 *
 *   dy'/dy = [ 0     I   ]
 *            [ da/dq da/dv ]                         (2 nv x 2 nv), differences column by column
 *
 * (CVODE's own differences would allocate). Errors are measured in the weighted root mean square over y, with the
 * tolerances of baum_i_problem_tolerances().
 */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include <float.h>
#include <math.h>
#include <string.h>

#include <cvode/cvode.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "base/alloc.h"
#include "integrate/sundials_common.h"

/* Memory of a run. */
typedef struct cvode_run {
  baum_i_sundials sundials;
  void *cvode;
  N_Vector y;                     /* end of the last step */
  N_Vector inside;                /* interpolated */
  SUNNonlinearSolver fixed_point; /* Adams */
  SUNMatrix matrix;               /* BDF */
  SUNLinearSolver dense;          /* BDF */
  double *jacobian;               /* BDF: (2 nv x nv) da/dy, column by column */
  baum_i_statistics before;       /* up to the last restart */
} cvode_run;

static const baum_i_sundials_flag FLAGS[] = {
  {CV_TOO_MUCH_ACC, BAUM_ERR_STEP,
   "rtol and atol ask for more digits than double precision has; raise rtol"},
  {CV_ERR_FAILURE, BAUM_ERR_STEP,
   "the error stays above the tolerance however small the step; a force may jump here, the "
   "position may be near singular, or rtol is too small"},
  {CV_CONV_FAILURE, BAUM_ERR_CONVERGENCE,
   "the iteration does not converge however small the step; stiff forces need cvode_bdf or ida, "
   "and near a singular position projection helps"},
  {CV_TOO_CLOSE, BAUM_ERR_STEP, "no first step can be found; the scales of time differ too much"},
  {CV_MEM_FAIL, BAUM_ERR_MEMORY, "out of memory"},
  {0, BAUM_OK, NULL},
};

/* ---- callbacks ---- */

static int evaluate(sunrealtype t, N_Vector y, N_Vector rate, void *user)
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
  baum_status status = baum_i_problem_motion(problem, t, q, q + nq);
  if (status == BAUM_OK) {
    memcpy(dy, q + nq, (size_t)nq * sizeof *dy);
    memcpy(dy + nq, workspace->a, (size_t)nv * sizeof *dy);
  }
  return baum_i_sundials_answer(&run->sundials, status);
}

/* A difference between rounding and truncation for a coordinate of value y that matters at the scale s. */
static double choose_difference(double y, double s)
{
  double wanted = sqrt(DBL_EPSILON * s * (s + fabs(y)));
  double moved = y + wanted;
  return moved - y;
}

/* Column j of da/dy; y is moved and put back. */
static baum_status difference(const baum_i_problem *problem, double t, double *y, int j,
                              const double *a, double *column)
{
  const baum_workspace *workspace = problem->workspace;
  int nq = workspace->mechanism->nq;
  int nv = workspace->mechanism->nv;
  const double *scale = workspace->mechanism->scale;
  double s = j < nq ? scale[j] : scale[j - nq] * problem->rate;
  double kept = y[j];
  double step = choose_difference(kept, s);
  y[j] += step;
  baum_status status = baum_i_problem_motion(problem, t, y, y + nq);
  y[j] = kept;
  for (int i = 0; i < nv && status == BAUM_OK; i++) {
    column[i] = (workspace->a[i] - a[i]) / step;
  }
  return status;
}

/* Both blocks of accelerations at (t, y) into run->jacobian; moved is scratch. */
static baum_status differentiate(const cvode_run *run, double t, const double *y, const double *a,
                                 double *moved)
{
  const baum_i_problem *problem = run->sundials.problem;
  int nv = problem->workspace->mechanism->nv;
  int n = problem->workspace->mechanism->nq + nv;
  memcpy(moved, y, (size_t)n * sizeof *moved);
  baum_status status = BAUM_OK;
  for (int j = 0; j < n && status == BAUM_OK; j++) {
    status = difference(problem, t, moved, j, a, run->jacobian + (size_t)j * nv);
  }
  return status;
}

/* matrix = I - gamma dy'/dy */
static void fill(const cvode_run *run, double gamma, SUNMatrix matrix)
{
  const baum_mechanism *mechanism = run->sundials.problem->workspace->mechanism;
  int nq = mechanism->nq;
  int nv = mechanism->nv;
  (void)SUNMatZero(matrix);
  for (int j = 0; j < nq + nv; j++) {
    double *column = SUNDenseMatrix_Column(matrix, j);
    const double *accelerations = run->jacobian + (size_t)j * nv;
    for (int i = 0; i < nv; i++) {
      column[nq + i] = -gamma * accelerations[i];
    }
    if (j >= nq) {
      column[j - nq] = -gamma;
    }
    column[j] += 1.0;
  }
}

/* The system of Newton's iteration. CVODE's own way clones the matrix without looking whether there is memory.
 * NOLINTNEXTLINE(readability-function-size): CVODE's parameters. */
static int build(sunrealtype t, N_Vector y, N_Vector rate, SUNMatrix matrix,
                 sunbooleantype may_keep, sunbooleantype *is_new, sunrealtype gamma, void *user,
                 N_Vector work1, N_Vector work2, N_Vector work3)
{
  /* #lizard forgives: CVODE's parameters */
  (void)work2;
  (void)work3;
  cvode_run *run = user;
  int nq = run->sundials.problem->workspace->mechanism->nq;
  baum_status status = BAUM_OK;
  *is_new = !may_keep;
  if (!may_keep) {
    const double *a = N_VGetArrayPointer(rate) + nq;
    status = differentiate(run, t, N_VGetArrayPointer(y), a, N_VGetArrayPointer(work1));
  }
  fill(run, gamma, matrix);
  return baum_i_sundials_answer(&run->sundials, status);
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

static void load(cvode_run *run, const baum_i_problem *problem, const baum_i_state *state)
{
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  double *y = N_VGetArrayPointer(run->y);
  memcpy(y, state->q, (size_t)mechanism->nq * sizeof *y);
  memcpy(y + mechanism->nq, state->v, (size_t)mechanism->nv * sizeof *y);
}

static void unload(const baum_i_problem *problem, N_Vector from, double *q, double *v)
{
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  const double *y = N_VGetArrayPointer(from);
  memcpy(q, y, (size_t)mechanism->nq * sizeof *y);
  memcpy(v, y + mechanism->nq, (size_t)mechanism->nv * sizeof *y);
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
  if (CVodeGetDky(run->cvode, t, 0, run->inside) != CV_SUCCESS) {
    return baum_i_sundials_fail_outside(&run->sundials, t);
  }
  unload(problem, run->inside, q, v);
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
  out->full_factorizations = 0; /* a dense one allocates nothing */
  out->nonlinear_iterations = run->before.nonlinear_iterations + iterations;
}

static baum_status restart(void *self, const baum_i_problem *problem, const baum_i_state *state)
{
  cvode_run *run = self;
  baum_i_statistics present;
  count(run, &present);
  run->before = present;
  baum_i_sundials_begin(&run->sundials, problem, state->t);
  load(run, problem, state);
  int flag = CVodeReInit(run->cvode, state->t, run->y);
  run->sundials.unfinished = flag != CV_SUCCESS;
  return flag == CV_SUCCESS ? BAUM_OK : fail(run, flag);
}

/* ---- one step ---- */

static baum_status advance(void *self, const baum_i_problem *problem, baum_i_state *state)
{
  cvode_run *run = self;
  baum_status status = run->sundials.unfinished ? restart(self, problem, state) : BAUM_OK;
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_sundials_begin_step(&run->sundials, problem, state->t);
  double t = state->t;
  double target = baum_i_sundials_target(problem, t);
  int flag = CVode(run->cvode, target, run->y, &t, CV_ONE_STEP);
  if (flag < 0) {
    return fail(run, flag);
  }
  status = baum_i_sundials_check_progress(&run->sundials, t);
  if (status == BAUM_OK) {
    run->sundials.unfinished = false;
    state->t = t;
    unload(problem, run->y, state->q, state->v);
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
  (void)SUNLinSolFree(run->dense);
  SUNMatDestroy(run->matrix);
  baum_i_sundials_close(&run->sundials);
  baum_i_free(run->jacobian);
  baum_i_free(run);
}

static int attach_fixed_point(cvode_run *run)
{
  run->fixed_point = SUNNonlinSol_FixedPoint(run->y, 0, run->sundials.context);
  return run->fixed_point ? CVodeSetNonlinearSolver(run->cvode, run->fixed_point) : CV_MEM_FAIL;
}

static int attach_dense(cvode_run *run)
{
  sunindextype n = N_VGetLength(run->y);
  run->jacobian = baum_i_alloc((size_t)n * (size_t)n / 2, sizeof *run->jacobian);
  run->matrix = run->jacobian ? SUNDenseMatrix(n, n, run->sundials.context) : NULL;
  if (run->matrix) {
    run->dense = SUNLinSol_Dense(run->y, run->matrix, run->sundials.context);
  }
  /* These two have flags of their own; only memory can be wrong. */
  bool attached = run->dense &&
                  CVodeSetLinearSolver(run->cvode, run->dense, run->matrix) == CVLS_SUCCESS &&
                  CVodeSetLinSysFn(run->cvode, build) == CVLS_SUCCESS;
  return attached ? CV_SUCCESS : CV_MEM_FAIL;
}

static int start_cvode(cvode_run *run, int method, const baum_i_problem *problem, double t)
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
    flag = CVodeInit(run->cvode, evaluate, t, run->y);
  }
  if (flag == CV_SUCCESS) {
    flag = CVodeWFtolerances(run->cvode, weigh);
  }
  if (flag == CV_SUCCESS) {
    flag = method == CV_ADAMS ? attach_fixed_point(run) : attach_dense(run);
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
  baum_i_sundials_begin(&run->sundials, problem, start->t);
  load(run, problem, start);
  int flag = start_cvode(run, method, problem, start->t);
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

/* ---- the two integrators ---- */

static const baum_formulation FORMULATIONS[] = {
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
  .formulations = FORMULATIONS,
  .gains = BAUM_GAINS_AUTO,
  .create = create_adams,
  .destroy = destroy,
  .advance = advance,
  .interpolate = interpolate,
  .restart = restart,
  .statistics = count,
};

static const baum_integrator BDF = {
  .name = "cvode_bdf",
  .formulations = FORMULATIONS,
  .gains = BAUM_GAINS_AUTO,
  .create = create_bdf,
  .destroy = destroy,
  .advance = advance,
  .interpolate = interpolate,
  .restart = restart,
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
