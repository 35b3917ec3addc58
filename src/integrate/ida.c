/* SPDX-License-Identifier: BSD-3-Clause */
/* IDA of SUNDIALS (P. Brown, A. Hindmarsh, L. Petzold, 1994; A. Hindmarsh et al., ACM TOMS 31,
 * 2005): BDF of orders 1 to 5, in fixed-leading-coefficient form, for
 *
 *   F(t, y, y') = 0,  y = (q, v, lambda)             (nq + nv + nc)
 *   q' - N v,  M v' + J^T lambda - g,                and
 *   index 1   J v' - gamma + 2 alpha Phi' + beta^2 Phi
 *   index 2   Phi'
 *   index 3   Phi
 *   GGL       Phi' and Phi, with y = (q, v, lambda, mu) and q' - N (v - W^-1 J^T mu)
 *
 * For rows of velocity level the equation is Phi' = 0 also at index 3. In GGL their mu is 0.
 *
 * IDA solves these equations reliably only under the following conditions, which were found by
 * measurement:
 * - The error test excludes multipliers, because their errors do not accumulate. At index 3 it also
 *   excludes velocities. At index 1, tolerance_lambda adds lambda to the test. In other
 *   formulations the error estimate of lambda does not decrease with the step as it should.
 *   Newton's iteration has a separate convergence test that includes multipliers (ida_newton.c).
 *   Without this test, multipliers diverge.
 * - The start is consistent. If the equations contain Phi or Phi' and the violation is not small, q
 *   and v are projected. v' and lambda come from one solution of (5) or (7) of docs/notation.md.
 *   IDA's own search for a consistent start can succeed with wrong accelerations.
 * - The length of the first step is prescribed. IDA's own choice is too large for index 3.
 * - The Jacobian is exact and sparse. Without the derivatives with respect to lambda, iterations
 *   fail.
 * - KLU keeps its pivots (sundials_klu.h).
 */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include <math.h>
#include <string.h>

#include <ida/ida.h>

#include "integrate/ida_newton.h"
#include "integrate/sundials_driver.h"
#include "integrate/sundials_klu.h"

/* Memory of a run. */
typedef struct ida_run {
  baum_i_sundials sundials;
  N_Vector dy;            /* y' at the end of the last step */
  N_Vector tested;        /* 1 for unknowns in the error test, otherwise 0 */
  SUNLinearSolver solver; /* IDA calls it, and it calls klu */
  baum_i_sundials_klu klu;
  double linearized; /* [1/s] coefficient c for which the matrix dF/dy + c dF/dy' was computed */
  baum_i_ida_newton newton;
  baum_dae dae;
} ida_run;

/* If the violation at a start is at most this large, relative to the tolerance, it is not
 * removed. */
static const double LARGEST_VIOLATION = 0.01;

/* ---- callbacks ---- */

static int evaluate(sunrealtype tau, N_Vector y, N_Vector dy, N_Vector residual, void *user)
{
  ida_run *run = user;
  double t = run->sundials.origin + tau;
  run->sundials.present = N_VGetArrayPointer(y);
  baum_status status =
    baum_i_residual(run->sundials.problem->workspace, &run->dae, t, run->sundials.present,
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

/* Set the error weights. They must be > 0 even for multipliers that are not tested. */
static int weigh(N_Vector y, N_Vector weights, void *user)
{
  ida_run *run = user;
  const baum_mechanism *mechanism = run->sundials.problem->workspace->mechanism;
  const double *multipliers = N_VGetArrayPointer(y) + mechanism->nq + mechanism->nv;
  N_VConst(1.0, weights);
  (void)baum_i_sundials_weigh(y, weights, user);
  baum_i_ida_newton_begin_step(&run->newton, multipliers, N_VGetArrayPointer(weights));
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
  (void)IDAGetCurrentCj(run->sundials.memory, &c);
  double ratio = c / run->linearized;
  baum_i_ida_newton_scale_right(&run->newton, ratio, b);
  int failed = baum_i_sundials_klu_solve_positions(&run->klu, run->linearized, x, b);
  baum_i_ida_newton_scale_solution(&run->newton, ratio, x);
  return failed;
}

/* ---- start ---- */

static baum_residual residual_of(baum_formulation formulation)
{
  switch ((int)formulation) {
  case BAUM_FORMULATION_GGL: return BAUM_RESIDUAL_GGL;
  case BAUM_FORMULATION_INDEX2: return BAUM_RESIDUAL_INDEX2;
  case BAUM_FORMULATION_INDEX3: return BAUM_RESIDUAL_INDEX3;
  default: return BAUM_RESIDUAL_INDEX1;
  }
}

static int size_of(const baum_i_problem *problem)
{
  return baum_i_residual_size(problem->workspace->mechanism, residual_of(problem->formulation));
}

/* Return rtol times the smallest tolerance factor of the tested unknowns. */
static double tightest(const ida_run *run, const baum_i_problem *problem)
{
  bool index3 = run->dae.index == BAUM_RESIDUAL_INDEX3;
  double factor = index3 ? problem->tolerance_q : fmin(problem->tolerance_q, problem->tolerance_v);
  return problem->rtol * factor;
}

/* Return the largest violation as a scaled displacement. Phi' is multiplied by the time T = 1 /
 * problem->rate. */
static double violation_of(const ida_run *run, const baum_i_problem *problem)
{
  int row = -1;
  bool index2 = run->dae.index == BAUM_RESIDUAL_INDEX2;
  double rate = baum_i_row_sizes(problem->workspace, problem->workspace->phi_rate, &row);
  double phi = index2 ? 0.0 : baum_i_row_sizes(problem->workspace, problem->workspace->phi, &row);
  return fmax(phi, rate / problem->rate);
}

/* Make the start consistent. If the equations contain Phi = 0 or Phi' = 0, the first step would
 * remove a violation at once, however short the step is, and its error estimate would be wrong. The
 * violation is therefore removed before the first step. The equations of index 2 do not contain Phi
 * = 0, so for them a violation of Phi remains. */
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

/* Find y and y' that satisfy F = 0. mu and the derivatives of all multipliers are set to 0. */
static baum_status complete_start(baum_i_sundials *sundials, double t)
{
  ida_run *run = (ida_run *)sundials;
  const baum_i_problem *problem = sundials->problem;
  baum_workspace *workspace = problem->workspace;
  const baum_mechanism *mechanism = workspace->mechanism;
  double *q = N_VGetArrayPointer(sundials->y);
  double *v = q + mechanism->nq;
  baum_i_problem_gains(problem, &run->dae.alpha, &run->dae.beta);
  BAUM_I_TRY(make_consistent(run, problem, t, q, v));
  BAUM_I_TRY(baum_i_problem_acceleration(problem, t, q, v));
  memcpy(v + mechanism->nv, workspace->lambda, (size_t)mechanism->nc * sizeof *v);
  N_VConst(0.0, run->dy);
  baum_i_sundials_pack_rate(workspace, q, N_VGetArrayPointer(run->dy));
  BAUM_I_TRY(baum_i_need_jacobian(workspace));
  BAUM_I_TRY(baum_i_evaluate_mass(workspace));
  if (!workspace->metric_ready) {
    baum_i_choose_metric(workspace);
  }
  baum_i_ida_newton_measure(&run->newton);
  return BAUM_OK;
}

/* Set the length h of the first step. The step has order 1 and the error h^2 |q''| / 2, where |q''|
 * <= rate^2 scale. At index 3, h is chosen such that this error equals the tolerance. In the other
 * formulations, the error test also includes velocities, whose derivatives are larger, so their h
 * is a fifth of that length. At index 3 a smaller h is not possible: velocities are differences of
 * q divided by h, and would consist mostly of rounding errors. */
static int give_first_step(ida_run *run)
{
  const baum_i_problem *problem = run->sundials.problem;
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  const double *v = N_VGetArrayPointer(run->sundials.y) + mechanism->nq;
  const double *a = N_VGetArrayPointer(run->dy) + mechanism->nq;
  double rate = fmax(problem->rate, baum_i_state_rate(mechanism, v, a));
  double factor = run->dae.index == BAUM_RESIDUAL_INDEX3 ? sqrt(2.0) : 0.3;
  double step = factor * sqrt(tightest(run, problem)) / rate;
  return IDASetInitStep(run->sundials.memory, problem->direction * step);
}

static int restart(baum_i_sundials *sundials)
{
  ida_run *run = (ida_run *)sundials;
  int flag = IDAReInit(sundials->memory, 0.0, sundials->y, run->dy);
  return flag == IDA_SUCCESS ? give_first_step(run) : flag;
}

/* ---- other functions for the driver ---- */

static baum_status open_run(baum_i_sundials *sundials)
{
  ida_run *run = (ida_run *)sundials;
  N_Vector *const vectors[] = {&run->dy, &run->tested, &run->newton.displacement,
                               &run->newton.inertia};
  for (size_t k = 0; k < sizeof vectors / sizeof *vectors; k++) {
    *vectors[k] = baum_i_sundials_vector(sundials);
  }
  run->dae.index = residual_of(sundials->problem->formulation);
  run->newton.index = run->dae.index;
  run->newton.sundials = sundials;
  return baum_i_sundials_klu_open(&run->klu, sundials, run->dae.index);
}

static void *create_memory(int multistep, SUNContext context)
{
  (void)multistep;
  return IDACreate(context);
}

static int init(baum_i_sundials *sundials)
{
  return IDAInit(sundials->memory, evaluate, 0.0, sundials->y, ((ida_run *)sundials)->dy);
}

static int choose_tested(ida_run *run)
{
  const baum_mechanism *mechanism = run->sundials.problem->workspace->mechanism;
  bool index3 = run->dae.index == BAUM_RESIDUAL_INDEX3;
  bool multipliers = isfinite(run->sundials.problem->tolerance_lambda);
  int tested = index3 ? mechanism->nq : mechanism->nq + mechanism->nv;
  tested += multipliers ? mechanism->nc : 0;
  double *id = N_VGetArrayPointer(run->tested);
  for (int i = 0; i < N_VGetLength(run->tested); i++) {
    id[i] = i < tested ? 1.0 : 0.0;
  }
  int flag = IDASetId(run->sundials.memory, run->tested);
  return flag == IDA_SUCCESS ? IDASetSuppressAlg(run->sundials.memory, SUNTRUE) : flag;
}

static int attach_newton(ida_run *run)
{
  int flag = choose_tested(run);
  if (flag == IDA_SUCCESS) {
    flag = baum_i_ida_newton_attach(&run->newton);
  }
  return flag == IDA_SUCCESS ? give_first_step(run) : flag;
}

/* The calls about linear solvers return IDALS flags, not IDA flags. They can fail only for lack of
 * memory. IDA's scaling of solutions is switched off, because solve() scales them. */
static int attach_klu(baum_i_sundials *sundials)
{
  ida_run *run = (ida_run *)sundials;
  void *ida = sundials->memory;
  run->solver = baum_i_sundials_front(sundials, run, factor, solve);
  bool attached = run->solver &&
                  IDASetLinearSolver(ida, run->solver, run->klu.matrix) == IDALS_SUCCESS &&
                  IDASetLinearSolutionScaling(ida, SUNFALSE) == IDALS_SUCCESS &&
                  IDASetJacFn(ida, linearize) == IDALS_SUCCESS;
  return attached ? attach_newton(run) : IDA_MEM_FAIL;
}

static int step(baum_i_sundials *sundials, double target, double *tau)
{
  N_Vector dy = ((ida_run *)sundials)->dy;
  return IDASolve(sundials->memory, target, tau, sundials->y, dy, IDA_ONE_STEP);
}

static void close_run(baum_i_sundials *sundials)
{
  ida_run *run = (ida_run *)sundials;
  baum_i_ida_newton_close(&run->newton);
  (void)SUNLinSolFree(run->solver);
  baum_i_sundials_klu_close(&run->klu);
}

static const baum_i_sundials_package PACKAGE = {
  .kind = BAUM_I_SUNDIALS_IDA,
  BAUM_I_SUNDIALS_CALLS(IDA),
  .size = size_of,
  .complete_start = complete_start,
  .create = create_memory,
  .init = init,
  .weigh = weigh,
  .restart = restart,
  .step = step,
  .close = close_run,
};

static const baum_i_sundials_method METHOD = {
  .name = "ida",
  .package = &PACKAGE,
  .open = open_run,
  .attach = attach_klu,
};

#endif

/* ---- the integrator ---- */

static const baum_integrator IDA = {
  .name = "ida",
  .formulations = {BAUM_FORMULATION_GGL, BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED,
                   BAUM_FORMULATION_INDEX2, BAUM_FORMULATION_INDEX3},
  .gains = BAUM_GAINS_AUTO,
  .family = BAUM_I_FAMILY_BDF,
  .seen = 1.0,
  .tests_multipliers = true,
  .solves_residuals = true,
#if BAUM_HAVE_SUNDIALS
  .table = &METHOD,
  .memory = sizeof(ida_run),
  BAUM_I_SUNDIALS_OPERATIONS,
#endif
};

const baum_integrator *baum_ida(void)
{
  return &IDA;
}
