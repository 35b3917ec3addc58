/* SPDX-License-Identifier: BSD-3-Clause */
/* Common implementation of CVODE and IDA: creation, steps, stops, interpolation, restarts, counters
 * and messages.
 *
 * The time given to SUNDIALS counts from the last start, so that steps lose no digits when t is
 * large.
 */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include "integrate/sundials_driver.h"

#include <float.h>
#include <math.h>

#include <cvode/cvode.h>
#include <ida/ida.h>

/* ---- messages ---- */

/* Flags of CVODE and IDA (0: the package has no such flag), with their meaning and advice. */
static const struct {
  int flag[2];
  baum_status status;
  const char *meaning;
} FLAGS[] = {
  {{CV_TOO_MUCH_ACC, IDA_TOO_MUCH_ACC},
   BAUM_ERR_STEP,
   "rtol and atol ask for more digits than double precision has; raise rtol"},
  {{CV_ERR_FAILURE, IDA_ERR_FAIL},
   BAUM_ERR_STEP,
   "the error stays above the tolerance however small the step; a force may jump here, the "
   "configuration may be near a singular one, or rtol is too small"},
  {{CV_CONV_FAILURE, 0},
   BAUM_ERR_CONVERGENCE,
   "the iteration does not converge however small the step; forces may be stiff, which "
   "requires cvode_bdf or ida, or the configuration may be near a singular one, where projection "
   "helps"},
  {{0, IDA_CONV_FAIL},
   BAUM_ERR_CONVERGENCE,
   "the iteration does not converge however small the step; the configuration may be near a "
   "singular one, or rtol is too small, especially for index 3"},
  {{CV_TOO_CLOSE, 0},
   BAUM_ERR_STEP,
   "no first step can be found, because the time scales differ too much"},
  {{CV_LSETUP_FAIL, 0},
   BAUM_ERR_SINGULAR,
   "the matrix of Newton's iteration cannot be factored; take a fixed-point method such as "
   "cvode_adams, or rk8"},
  {{0, IDA_LSETUP_FAIL},
   BAUM_ERR_SINGULAR,
   "the matrix of Newton's iteration cannot be factored; take another formulation, or rk8"},
  {{CV_LSOLVE_FAIL, IDA_LSOLVE_FAIL},
   BAUM_ERR_SINGULAR,
   "the linear equations of Newton's iteration could not be solved; take rk8, or a smaller rtol"},
  {{CV_NLS_FAIL, IDA_NLS_FAIL},
   BAUM_ERR_CONVERGENCE,
   "the iteration failed; take rk8, or a smaller rtol"},
  {{CV_ILL_INPUT, IDA_ILL_INPUT},
   BAUM_ERR_NOT_FINITE,
   "the state or its tolerances are not finite; the motion grows without bound, or rtol and atol "
   "are too small"},
  {{CV_MEM_FAIL, IDA_MEM_FAIL}, BAUM_ERR_MEMORY, "out of memory"},
};

enum { FLAG_COUNT = sizeof FLAGS / sizeof *FLAGS };

/* Fail with the message of an evaluation. step is the length of the step, or 0 if no step was
 * tried. */
static baum_status fail_with_evaluation(const baum_i_sundials *run, double step)
{
  return baum_i_fail_in_step(run->evaluation, run->message, run->method->name, run->t, step);
}

/* Fail with the meaning of a flag, or with the message of an evaluation that failed. */
static baum_status fail(const baum_i_sundials *run, int flag, double step)
{
  if (run->evaluation != BAUM_OK) {
    return fail_with_evaluation(run, step);
  }
  int k = 0;
  while (k < FLAG_COUNT && FLAGS[k].flag[run->method->package->kind] != flag) {
    k++;
  }
  if (k == FLAG_COUNT) {
    return baum_i_fail(BAUM_ERR_INTEGRATOR, "t = %.9g s: %s failed with flag %d (step %.3g s. %s)",
                       run->t, run->method->name, flag, step, run->complaint);
  }
  return baum_i_fail(FLAGS[k].status, "t = %.9g s: %s: %s (step %.3g s. %s)", run->t,
                     run->method->name, FLAGS[k].meaning, step,
                     run->origin == 0.0 ? run->complaint : "");
}

static baum_status fail_in_step(const baum_i_sundials *run, int flag)
{
  double step = 0.0;
  (void)run->method->package->get_step(run->memory, &step);
  return fail(run, flag, step);
}

/* ---- start and restart ---- */

static void begin(baum_i_sundials *run, const baum_i_problem *problem, double t)
{
  run->problem = problem;
  run->t = t;
  run->unfinished = true;
  run->stopped = false;
  run->evaluation = BAUM_OK;
  run->complaint[0] = '\0';
}

static baum_status load(baum_i_sundials *run, const baum_i_problem *problem,
                        const baum_i_state *state)
{
  begin(run, problem, state->t);
  run->origin = state->t;
  N_VConst(0.0, run->y);
  baum_i_sundials_pack(problem->workspace->mechanism, state->q, state->v,
                       N_VGetArrayPointer(run->y));
  const baum_i_sundials_package *package = run->method->package;
  return package->complete_start ? package->complete_start(run, state->t) : BAUM_OK;
}

baum_status baum_i_sundials_restart(void *self, const baum_i_problem *problem,
                                    const baum_i_state *state)
{
  baum_i_sundials *run = self;
  baum_i_statistics present;
  baum_i_sundials_count(run, &present);
  run->before = present;
  BAUM_I_TRY(load(run, problem, state));
  int flag = run->method->package->restart(run);
  run->unfinished = flag != 0;
  return flag == 0 ? BAUM_OK : fail_in_step(run, flag);
}

void baum_i_sundials_forget(void *self)
{
  baum_i_sundials *run = self;
  run->unfinished = true;
  run->pivots_forgotten = true;
}

void baum_i_sundials_count(const void *self, baum_i_statistics *out)
{
  const baum_i_sundials *run = self;
  const baum_i_sundials_package *package = run->method->package;
  long rejected[2] = {0, 0};
  long setups = 0;
  long iterations = 0;
  (void)package->count_error_failures(run->memory, &rejected[0]);
  (void)package->count_solver_failures(run->memory, &rejected[1]);
  (void)package->count_setups(run->memory, &setups);
  (void)package->count_iterations(run->memory, &iterations);
  out->rejected = run->before.rejected + rejected[0] + rejected[1];
  out->factorizations = run->before.factorizations + setups;
  out->full_factorizations = run->full_factorizations;
  out->nonlinear_iterations = run->before.nonlinear_iterations + iterations;
}

/* ---- one step ---- */

/* Begin a step. If an evaluation very close to this time has failed, its failure is kept. If steps
 * then become too short, this failure is reported as the reason, even if the last evaluation
 * succeeds. */
static void begin_step(baum_i_sundials *run, const baum_i_problem *problem, double t)
{
  bool near = fabs(t - run->evaluated_at) * problem->rate <= 1e-6;
  baum_status evaluation = near ? run->evaluation : BAUM_OK;
  begin(run, problem, t);
  run->evaluation = evaluation;
}

/* Pass the stop time to SUNDIALS. SUNDIALS 6.4 cannot cancel a stop time; it is set to infinity
 * instead, in the direction of the run, which may have changed since the last step. */
static void give_stop(baum_i_sundials *run)
{
  const baum_i_problem *problem = run->problem;
  run->stops = run->stops || problem->stops;
  if (run->stops) {
    double stop =
      problem->stops ? problem->stop - run->origin : problem->direction * (double)INFINITY;
    /* The call fails only if the stop time is in the past. */
    (void)run->method->package->set_stop(run->memory, stop);
  }
}

/* Fail with BAUM_ERR_STEP if a step between two times of SUNDIALS did not advance. */
static baum_status check_progress(const baum_i_sundials *run, double before, double after)
{
  /* A first step may be shorter than the rounding error of a large t. This is permitted if the
   * motion in a time as short as this rounding error is negligible. */
  double rounding = DBL_EPSILON * fabs(run->t) * run->problem->rate;
  if (run->origin + after != run->t || (after != before && rounding <= 1e-4)) {
    return BAUM_OK;
  }
  if (run->evaluation != BAUM_OK) {
    return fail_with_evaluation(run, after - before);
  }
  return baum_i_fail(BAUM_ERR_STEP,
                     "t = %.9g s: %s: the step became too small to change the time (%.3g s); the "
                     "motion may be singular here, or rtol = %g is too small",
                     run->t, run->method->name, fabs(after - before), run->problem->rtol);
}

/* Take one step. The target tells SUNDIALS the direction of time. It is 10 T (T = 1/rate) away,
 * because SUNDIALS limits the first step to a tenth of the distance to the target. */
baum_status baum_i_sundials_advance(void *self, const baum_i_problem *problem, baum_i_state *state)
{
  baum_i_sundials *run = self;
  if (run->unfinished) {
    BAUM_I_TRY(baum_i_sundials_restart(run, problem, state));
  }
  const baum_i_sundials_package *package = run->method->package;
  begin_step(run, problem, state->t);
  give_stop(run);
  double before = 0.0;
  double after = 0.0;
  (void)package->get_time(run->memory, &before);
  int flag = package->step(run, before + problem->direction * 10.0 / problem->rate, &after);
  if (flag < 0) {
    return fail_in_step(run, flag);
  }
  BAUM_I_TRY(check_progress(run, before, after));
  run->unfinished = false;
  state->t = run->origin + after;
  baum_i_sundials_unpack(problem->workspace->mechanism, N_VGetArrayPointer(run->y), state->q,
                         state->v);
  return BAUM_OK;
}

/* ---- inside the last step ---- */

/* Convert t to the time of SUNDIALS. A time that is outside of the last step only by rounding is
 * moved to the nearest end of the step. Returns NaN if t is further outside, where IDA would
 * extrapolate. */
static double find_inside(const baum_i_sundials *run, double t)
{
  double end = 0.0;
  double last = 0.0;
  (void)run->method->package->get_time(run->memory, &end);
  (void)run->method->package->get_last_step(run->memory, &last);
  double tau = t - run->origin;
  double beyond = (tau - end) * run->problem->direction;
  double before = -beyond - fabs(last);
  if (fmax(beyond, before) > 100.0 * DBL_EPSILON * fmax(fabs(t), fabs(end))) {
    return (double)NAN;
  }
  return beyond > 0.0 ? end : (before > 0.0 ? end - last : tau);
}

baum_status baum_i_sundials_interpolate(void *self, const baum_i_problem *problem, double t,
                                        double *q, double *v)
{
  baum_i_sundials *run = self;
  double tau = find_inside(run, t);
  if (isnan(tau) || run->method->package->get_derivative(run->memory, tau, 0, run->inside) != 0) {
    return baum_i_fail(BAUM_ERR_INTEGRATOR, "t = %.9g s is not inside the last step of %s", t,
                       run->method->name);
  }
  baum_i_sundials_unpack(problem->workspace->mechanism, N_VGetArrayPointer(run->inside), q, v);
  return BAUM_OK;
}

/* ---- life ---- */

static void complain(int flag, const char *module, const char *function, char *text, void *user)
{
  (void)flag;
  (void)module;
  (void)function;
  baum_i_sundials_complain(user, text);
}

static int start_sundials(baum_i_sundials *run)
{
  const baum_i_sundials_package *package = run->method->package;
  double max_step = run->problem->max_step;
  run->memory = package->create(run->method->multistep, run->context);
  if (!run->memory) {
    return package->kind == BAUM_I_SUNDIALS_IDA ? IDA_MEM_FAIL : CV_MEM_FAIL;
  }
  int flag = package->set_complain ? package->set_complain(run->memory, complain, run) : 0;
  flag = flag ? flag : package->set_user(run->memory, run);
  flag = flag ? flag : package->init(run);
  flag = flag ? flag : package->set_weigh(run->memory, package->weigh);
  flag = flag ? flag : run->method->attach(run);
  flag = flag || isinf(max_step) ? flag : package->set_max_step(run->memory, max_step);
  return flag;
}

baum_status baum_i_sundials_open_run(void *self, const void *table, const baum_i_problem *problem,
                                     const baum_i_state *start)
{
  baum_i_sundials *run = self;
  run->method = table;
  run->problem = problem;
  BAUM_I_TRY(baum_i_sundials_open(run, run->method->package->size(problem)));
  run->y = baum_i_sundials_vector(run);
  run->inside = baum_i_sundials_vector(run);
  if (run->method->open) {
    BAUM_I_TRY(run->method->open(run));
  }
  BAUM_I_TRY(load(run, problem, start));
  int flag = start_sundials(run);
  run->unfinished = flag != 0;
  return flag == 0 ? BAUM_OK : fail(run, flag, 0.0);
}

void baum_i_sundials_close_run(void *self)
{
  baum_i_sundials *run = self;
  run->method->package->destroy(&run->memory);
  run->method->package->close(run);
  baum_i_sundials_close(run);
}

#endif
