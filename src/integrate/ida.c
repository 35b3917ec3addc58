/* SPDX-License-Identifier: BSD-3-Clause */
/* IDA of SUNDIALS (P. Brown, A. Hindmarsh, L. Petzold, 1994; A. Hindmarsh et al., ACM TOMS 31, 2005): BDF of
 * orders 1 to 5, in fixed-leading-coefficient form, for
 *
 *   F(t, y, y') = 0,  y = (q, v, lambda)             (nq + nv + nc)
 *   q' - N v,  M v' + J^T lambda - g,                and
 *   index 1   J v' - gamma + 2 alpha Phi' + beta^2 Phi
 *   index 2   Phi'
 *   index 3   Phi
 *   GGL       Phi' and Phi, with y = (q, v, lambda, mu) and q' - N (v - W^-1 J^T mu)
 *
 * What it takes to make this work, all measured:
 * - Multipliers are left out of the error test (their errors do not add up), at index 3 velocities too; at index 1
 *   lambda is put in by tolerance_lambda, elsewhere its estimate does not fall with the step as it should. Newton's
 *   iteration is judged by sizes of its own (ida_newton.c): left out there too, multipliers run away.
 * - The start is consistent: q and v are given, and projected where Phi or Phi' is among the equations but not small;
 *   v' and lambda come from one solution of (5) or (7). IDA's own search for a consistent start can succeed with wrong
 *   accelerations.
 * - The first step is given. IDA's own is too large for index 3.
 * - The Jacobian is exact and sparse; leaving out lambda's part makes iterations fail.
 * - KLU keeps its pivots (sundials_klu.h).
 */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include "integrate/ida.h"

#include <math.h>
#include <string.h>

#include <ida/ida.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "base/alloc.h"
#include "integrate/ida_newton.h"
#include "integrate/sundials_common.h"
#include "integrate/sundials_klu.h"

/* Memory of a run. */
typedef struct ida_run {
  baum_i_sundials sundials;
  void *ida;
  bool stops; /* a stop time is set */
  N_Vector y; /* end of the last step */
  N_Vector dy;
  N_Vector inside;        /* interpolated */
  N_Vector tested;        /* 1 where the error test looks, else 0 */
  bool differences;       /* a dense matrix by differences */
  SUNMatrix dense;        /* of differences */
  SUNLinearSolver solver; /* what IDA calls: dense, or a front before klu */
  baum_i_sundials_klu klu;
  double linearized; /* [1/s] c of the present matrix */
  baum_i_ida_newton newton;
  baum_dae dae;
  baum_i_statistics before; /* up to the last restart */
} ida_run;

static const baum_i_sundials_flag FLAGS[] = {
  {IDA_TOO_MUCH_ACC, BAUM_ERR_STEP,
   "rtol and atol ask for more digits than double precision has; raise rtol"},
  {IDA_ERR_FAIL, BAUM_ERR_STEP,
   "the error stays above the tolerance however small the step; a force may jump here, the "
   "position may be near singular, or rtol is too small"},
  {IDA_CONV_FAIL, BAUM_ERR_CONVERGENCE,
   "the iteration does not converge however small the step; the position may be near singular, "
   "or rtol is too small, for index 3 above all"},
  {IDA_LSETUP_FAIL, BAUM_ERR_SINGULAR,
   "the matrix of Newton's iteration cannot be factored; take another formulation, or rk8"},
  {IDA_LSOLVE_FAIL, BAUM_ERR_SINGULAR,
   "the matrix of Newton's iteration cannot be solved with; take rk8, or a smaller rtol"},
  {IDA_NLS_FAIL, BAUM_ERR_CONVERGENCE, "the iteration failed; take rk8, or a smaller rtol"},
  {IDA_ILL_INPUT, BAUM_ERR_NOT_FINITE,
   "the state or its tolerances are not finite; the motion grows without bound, or rtol and atol "
   "are too small"},
  {IDA_MEM_FAIL, BAUM_ERR_MEMORY, "out of memory"},
  {0, BAUM_OK, NULL},
};

/* At a start, of the tolerance. */
static const double LARGEST_VIOLATION = 0.01;

/* ---- callbacks ---- */

/* IDA's time is that since the last start. */
static int evaluate(sunrealtype tau, N_Vector y, N_Vector dy, N_Vector residual, void *user)
{
  ida_run *run = user;
  double t = run->sundials.origin + tau;
  baum_status status =
    baum_i_residual(run->sundials.problem->workspace, &run->dae, t, N_VGetArrayPointer(y),
                    N_VGetArrayPointer(dy), N_VGetArrayPointer(residual));
  return baum_i_sundials_answer(&run->sundials, status);
}

/* NOLINTNEXTLINE(readability-function-size): IDA's parameters. */
static int linearize(sunrealtype tau, sunrealtype c, N_Vector y, N_Vector dy, N_Vector residual,
                     SUNMatrix matrix, void *user, N_Vector work1, N_Vector work2, N_Vector work3)
{
  /* #lizard forgives: IDA's parameters */
  (void)residual;
  (void)matrix;
  (void)work1;
  (void)work2;
  (void)work3;
  ida_run *run = user;
  double t = run->sundials.origin + tau;
  run->linearized = c;
  baum_status status = baum_i_sundials_klu_fill(&run->klu, &run->dae, c, t, N_VGetArrayPointer(y),
                                                N_VGetArrayPointer(dy));
  if (status == BAUM_OK) {
    baum_i_ida_newton_measure(&run->newton);
  }
  return baum_i_sundials_answer(&run->sundials, status);
}

static int weigh(N_Vector y, N_Vector weights, void *user)
{
  ida_run *run = user;
  const baum_i_problem *problem = run->sundials.problem;
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  const double *v = N_VGetArrayPointer(y) + mechanism->nq;
  double *w = N_VGetArrayPointer(weights);
  N_VConst(1.0, weights); /* those of multipliers are used nowhere, but must be > 0 */
  baum_i_sundials_weights(problem, v, w);
  /* and of lambda where it is tested */
  baum_i_ida_newton_begin_step(&run->newton, v + mechanism->nv, w);
  return 0;
}

/* ---- linear solver ---- */

static int factor(SUNLinearSolver solver, SUNMatrix matrix)
{
  (void)matrix;
  ida_run *run = solver->content;
  return baum_i_sundials_klu_factor(&run->klu);
}

static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b,
                 sunrealtype tolerance)
{
  (void)matrix;
  (void)tolerance;
  ida_run *run = solver->content;
  double c = run->linearized;
  (void)IDAGetCurrentCj(run->ida, &c);
  double ratio = c / run->linearized;
  baum_i_ida_newton_scale_right(&run->newton, ratio, b);
  int failed = baum_i_sundials_klu_solve(&run->klu, x, b);
  baum_i_ida_newton_scale_solution(&run->newton, ratio, x);
  return failed;
}

/* ---- in and out ---- */

static baum_residual residual_of(baum_formulation formulation)
{
  switch (formulation) {
  case BAUM_FORMULATION_GGL: return BAUM_RESIDUAL_GGL;
  case BAUM_FORMULATION_INDEX2: return BAUM_RESIDUAL_INDEX2;
  case BAUM_FORMULATION_INDEX3: return BAUM_RESIDUAL_INDEX3;
  case BAUM_FORMULATION_BAUMGARTE:
  case BAUM_FORMULATION_UNSTABILIZED:
  case BAUM_FORMULATION_PROJECTION:
  case BAUM_FORMULATION_DEFAULT:
  default: return BAUM_RESIDUAL_INDEX1;
  }
}

static void begin(ida_run *run, const baum_i_problem *problem, double t)
{
  baum_i_sundials_begin(&run->sundials, problem, t);
  run->sundials.origin = t;
  run->dae.index = residual_of(problem->formulation);
  run->newton.sundials = &run->sundials;
  run->newton.index = run->dae.index;
  baum_i_problem_gains(problem, &run->dae.alpha, &run->dae.beta);
}

static baum_status fail(const ida_run *run, int flag)
{
  double step = 0.0;
  (void)IDAGetCurrentStep(run->ida, &step);
  return baum_i_sundials_fail(&run->sundials, FLAGS, flag, step);
}

static baum_status interpolate(void *self, const baum_i_problem *problem, double t, double *q,
                               double *v)
{
  ida_run *run = self;
  /* IDA refuses times before its last step, but extrapolates beyond. */
  double end = 0.0;
  double last = 0.0;
  (void)IDAGetCurrentTime(run->ida, &end);
  (void)IDAGetLastStep(run->ida, &last);
  double tau = baum_i_sundials_inside(&run->sundials, t, end, last);
  if (isnan(tau) || IDAGetDky(run->ida, tau, 0, run->inside) != IDA_SUCCESS) {
    return baum_i_sundials_fail_outside(&run->sundials, t);
  }
  baum_i_sundials_unload(problem, run->inside, q, v);
  return BAUM_OK;
}

/* ---- statistics and restart ---- */

static void count(const void *self, baum_i_statistics *out)
{
  const ida_run *run = self;
  long rejected[2] = {0, 0};
  long setups = 0;
  long iterations = 0;
  (void)IDAGetNumErrTestFails(run->ida, &rejected[0]);
  (void)IDAGetNumStepSolveFails(run->ida, &rejected[1]);
  (void)IDAGetNumLinSolvSetups(run->ida, &setups);
  (void)IDAGetNumNonlinSolvIters(run->ida, &iterations);
  out->rejected = run->before.rejected + rejected[0] + rejected[1];
  out->factorizations = run->before.factorizations + setups;
  out->full_factorizations = run->klu.full_factorizations;
  out->nonlinear_iterations = run->before.nonlinear_iterations + iterations;
}

/* rtol with the smaller of the factors of what is tested. */
static double tightest(const ida_run *run, const baum_i_problem *problem)
{
  bool index3 = run->dae.index == BAUM_RESIDUAL_INDEX3;
  double factor = index3 ? problem->tolerance_q : fmin(problem->tolerance_q, problem->tolerance_v);
  return problem->rtol * factor;
}

/* Largest violation as a displacement, over the scale; of velocities, times 1/T. */
static double violation_of(ida_run *run, const baum_i_problem *problem)
{
  const baum_workspace *w = problem->workspace;
  double *displacement = N_VGetArrayPointer(run->newton.displacement);
  double positions = run->dae.index == BAUM_RESIDUAL_INDEX2 ? 0.0 : 1.0;
  double largest = 0.0;
  baum_i_row_displacements(w, displacement);
  for (int i = 0; i < w->mechanism->nc; i++) {
    double phi = positions * fabs(w->phi[i]) / displacement[i];
    double rate = fabs(w->phi_rate[i]) / (displacement[i] * problem->rate);
    largest = fmax(largest, fmax(phi, rate));
  }
  return largest;
}

/* What violates Phi = 0 or Phi' = 0 where these are among the equations would jump in the first step, and its error
 * estimate with it, at any length of the step. So it jumps here; Phi of index 2 stays. */
static baum_status make_consistent(ida_run *run, const baum_i_problem *problem, double t, double *q,
                                   double *v)
{
  baum_workspace *w = problem->workspace;
  if (run->dae.index == BAUM_RESIDUAL_INDEX1) {
    return BAUM_OK;
  }
  baum_status status = baum_i_violation(w, t, q, v);
  if (status != BAUM_OK ||
      violation_of(run, problem) <= LARGEST_VIOLATION * tightest(run, problem)) {
    return status;
  }
  return run->dae.index == BAUM_RESIDUAL_INDEX2 ? baum_i_project_velocities(w, t, q, v)
                                                : baum_i_project(w, t, q, v);
}

/* y and y' that fulfil F = 0; mu and all derivatives of multipliers are 0. */
static baum_status load(ida_run *run, const baum_i_problem *problem, const baum_i_state *state)
{
  baum_workspace *workspace = problem->workspace;
  size_t nq = (size_t)workspace->mechanism->nq;
  size_t nv = (size_t)workspace->mechanism->nv;
  size_t nc = (size_t)workspace->mechanism->nc;
  double *y = N_VGetArrayPointer(run->y);
  double *dy = N_VGetArrayPointer(run->dy);
  N_VConst(0.0, run->y);
  N_VConst(0.0, run->dy);
  memcpy(y, state->q, nq * sizeof *y);
  memcpy(y + nq, state->v, nv * sizeof *y);
  baum_status status = make_consistent(run, problem, state->t, y, y + nq);
  if (status == BAUM_OK) {
    status = baum_i_problem_acceleration(problem, state->t, y, y + nq);
  }
  if (status != BAUM_OK) {
    return status;
  }
  memcpy(y + nq + nv, workspace->lambda, nc * sizeof *y);
  memcpy(dy, y + nq, nq * sizeof *dy);
  memcpy(dy + nq, workspace->a, nv * sizeof *dy);
  status = baum_i_need_jacobian(workspace);
  if (status == BAUM_OK) {
    status = baum_i_evaluate_mass(workspace);
  }
  if (status != BAUM_OK) {
    return status;
  }
  if (!workspace->metric_ready) {
    baum_i_choose_metric(workspace);
  }
  baum_i_ida_newton_measure(&run->newton);
  return BAUM_OK;
}

/* The first step is of order 1 with an error of h^2 |q''| / 2, where |q''| <= rate^2 scale. All but index 3 test velocities
 * too, whose derivatives are larger: a fifth of that h passes. At index 3 a smaller step would drown the
 * velocities, differences of q over h, in rounding. After a load(). */
static int give_first_step(ida_run *run)
{
  const baum_i_problem *problem = run->sundials.problem;
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  const double *v = N_VGetArrayPointer(run->y) + mechanism->nq;
  const double *a = N_VGetArrayPointer(run->dy) + mechanism->nq;
  double rate = fmax(problem->rate, baum_i_state_rate(mechanism, v, a));
  double factor = run->dae.index == BAUM_RESIDUAL_INDEX3 ? sqrt(2.0) : 0.3;
  double step = factor * sqrt(tightest(run, problem)) / rate;
  return IDASetInitStep(run->ida, problem->direction * step);
}

static baum_status restart(void *self, const baum_i_problem *problem, const baum_i_state *state)
{
  ida_run *run = self;
  baum_i_statistics present;
  count(run, &present);
  run->before = present;
  begin(run, problem, state->t);
  run->sundials.unfinished = true;
  baum_status status = load(run, problem, state);
  if (status != BAUM_OK) {
    return status;
  }
  int flag = IDAReInit(run->ida, 0.0, run->y, run->dy);
  if (flag == IDA_SUCCESS) {
    flag = give_first_step(run);
  }
  run->sundials.unfinished = flag != IDA_SUCCESS;
  return flag == IDA_SUCCESS ? BAUM_OK : fail(run, flag);
}

static void forget(void *self)
{
  ida_run *run = self;
  run->sundials.unfinished = true;
  run->klu.forgotten = true;
}

/* ---- one step ---- */

/* SUNDIALS 6.4 cannot take a stop back, only put it off. */
static void give_stop(ida_run *run, const baum_i_problem *problem)
{
  if (problem->stops || run->stops) {
    double stop =
      problem->stops ? problem->stop - run->sundials.origin : problem->direction * (double)INFINITY;
    (void)IDASetStopTime(run->ida, stop); /* fails only where the stop is behind */
    run->stops = problem->stops;
  }
}

static baum_status advance(void *self, const baum_i_problem *problem, baum_i_state *state)
{
  ida_run *run = self;
  baum_status status = run->sundials.unfinished ? restart(self, problem, state) : BAUM_OK;
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_sundials_begin_step(&run->sundials, problem, state->t);
  double before = 0.0;
  double tau = 0.0;
  (void)IDAGetCurrentTime(run->ida, &before);
  double target = baum_i_sundials_target(problem, before);
  give_stop(run, problem);
  int flag = IDASolve(run->ida, target, &tau, run->y, run->dy, IDA_ONE_STEP);
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
  ida_run *run = self;
  if (!run) {
    return;
  }
  IDAFree(&run->ida);
  baum_i_ida_newton_close(&run->newton);
  (void)SUNLinSolFree(run->solver);
  SUNMatDestroy(run->dense);
  baum_i_sundials_klu_close(&run->klu);
  baum_i_sundials_close(&run->sundials);
  baum_i_free(run);
}

static void take_vectors(ida_run *run)
{
  N_Vector *const all[] = {
    &run->y, &run->dy, &run->inside, &run->tested, &run->newton.displacement, &run->newton.inertia};
  for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
    *all[k] = baum_i_sundials_vector(&run->sundials);
  }
}

static int choose_tested(ida_run *run)
{
  const baum_mechanism *mechanism = run->sundials.problem->workspace->mechanism;
  bool index3 = run->dae.index == BAUM_RESIDUAL_INDEX3;
  bool multipliers = isfinite(run->sundials.problem->tolerance_lambda);
  int tested = index3 ? mechanism->nq : mechanism->nq + mechanism->nv;
  tested += multipliers ? mechanism->nc : 0;
  double *id = N_VGetArrayPointer(run->tested);
  int n = baum_i_residual_size(mechanism, run->dae.index);
  for (int i = 0; i < n; i++) {
    id[i] = i < tested ? 1.0 : 0.0;
  }
  int flag = IDASetId(run->ida, run->tested);
  return flag == IDA_SUCCESS ? IDASetSuppressAlg(run->ida, SUNTRUE) : flag;
}

static int attach_dense(ida_run *run)
{
  sunindextype n = N_VGetLength(run->y);
  run->dense = SUNDenseMatrix(n, n, run->sundials.context);
  if (run->dense) {
    run->solver = SUNLinSol_Dense(run->y, run->dense, run->sundials.context);
  }
  bool attached =
    run->solver && IDASetLinearSolver(run->ida, run->solver, run->dense) == IDALS_SUCCESS;
  return attached ? IDA_SUCCESS : IDA_MEM_FAIL;
}

static int attach_klu(ida_run *run)
{
  run->solver = baum_i_sundials_front(&run->sundials, run, factor, solve);
  /* These have flags of their own; only memory can be wrong. Scaling is ours. */
  bool attached = run->solver &&
                  IDASetLinearSolver(run->ida, run->solver, run->klu.matrix) == IDALS_SUCCESS &&
                  IDASetLinearSolutionScaling(run->ida, SUNFALSE) == IDALS_SUCCESS &&
                  IDASetJacFn(run->ida, linearize) == IDALS_SUCCESS;
  return attached ? IDA_SUCCESS : IDA_MEM_FAIL;
}

static int start_ida(ida_run *run)
{
  run->ida = IDACreate(run->sundials.context);
  if (!run->ida) {
    return IDA_MEM_FAIL;
  }
  int flag = BAUM_I_SUNDIALS_SILENCE(IDASetErrHandlerFn, run->ida, &run->sundials);
  if (flag == IDA_SUCCESS) {
    flag = IDASetUserData(run->ida, run);
  }
  if (flag == IDA_SUCCESS) {
    flag = IDAInit(run->ida, evaluate, 0.0, run->y, run->dy);
  }
  if (flag == IDA_SUCCESS) {
    flag = IDAWFtolerances(run->ida, weigh);
  }
  if (flag == IDA_SUCCESS) {
    flag = choose_tested(run);
  }
  if (flag == IDA_SUCCESS) {
    flag = run->differences ? attach_dense(run) : attach_klu(run);
  }
  if (flag == IDA_SUCCESS) {
    flag = baum_i_ida_newton_attach(&run->newton, run->ida, run->y);
  }
  double max_step = run->sundials.problem->max_step;
  if (flag == IDA_SUCCESS && isfinite(max_step)) {
    flag = IDASetMaxStep(run->ida, max_step);
  }
  return flag == IDA_SUCCESS ? give_first_step(run) : flag;
}

static baum_status set_up(ida_run *run, const baum_i_problem *problem, const baum_i_state *start,
                          bool differences)
{
  int n = baum_i_residual_size(problem->workspace->mechanism, residual_of(problem->formulation));
  run->differences = differences;
  baum_status status = baum_i_sundials_open(&run->sundials, "ida", n);
  begin(run, problem, start->t);
  if (status == BAUM_OK) {
    take_vectors(run);
    status = load(run, problem, start);
  }
  if (status == BAUM_OK && !differences) {
    status = baum_i_sundials_klu_open(&run->klu, &run->sundials, run->dae.index);
  }
  if (status != BAUM_OK) {
    return status;
  }
  int flag = start_ida(run);
  run->sundials.unfinished = flag != IDA_SUCCESS;
  return flag == IDA_SUCCESS ? BAUM_OK : baum_i_sundials_fail(&run->sundials, FLAGS, flag, 0.0);
}

static baum_status create_run(const baum_i_problem *problem, const baum_i_state *start,
                              bool differences, void **out)
{
  *out = NULL;
  ida_run *run = baum_i_alloc(1, sizeof *run);
  if (!run) {
    return baum_i_fail_memory();
  }
  baum_status status = set_up(run, problem, start, differences);
  if (status != BAUM_OK) {
    destroy(run);
    return status;
  }
  *out = run;
  return BAUM_OK;
}

static baum_status create(const baum_i_problem *problem, const baum_i_state *start, void **out)
{
  return create_run(problem, start, false, out);
}

baum_status baum_i_ida_create_with_differences(const baum_i_problem *problem,
                                               const baum_i_state *start, void **out)
{
  return create_run(problem, start, true, out);
}

const double *baum_i_ida_multipliers(const void *run)
{
  const ida_run *self = run;
  const baum_mechanism *mechanism = self->sundials.problem->workspace->mechanism;
  return N_VGetArrayPointer(self->y) + mechanism->nq + mechanism->nv;
}

baum_status baum_i_ida_explain_flag(int flag)
{
  const baum_i_sundials sundials = {.integrator = "ida"};
  return baum_i_sundials_fail(&sundials, FLAGS, flag, 1e-3);
}

/* ---- the integrator ---- */

static const baum_formulation FORMULATIONS[] = {
  BAUM_FORMULATION_GGL,    BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED,
  BAUM_FORMULATION_INDEX2, BAUM_FORMULATION_INDEX3,    BAUM_FORMULATION_DEFAULT,
};

static const baum_integrator IDA = {
  .name = "ida",
  .formulations = FORMULATIONS,
  .gains = BAUM_GAINS_AUTO,
  .family = BAUM_I_FAMILY_BDF,
  .seen = 1.0,
  .tests_multipliers = true,
  .solves_residuals = true,
  .create = create,
  .destroy = destroy,
  .advance = advance,
  .interpolate = interpolate,
  .restart = restart,
  .forget = forget,
  .statistics = count,
};

const baum_integrator *baum_ida(void)
{
  return &IDA;
}

#endif
