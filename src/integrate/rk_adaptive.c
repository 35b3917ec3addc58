/* SPDX-License-Identifier: BSD-3-Clause */
/* Embedded explicit Runge-Kutta pairs with variable steps (E. Hairer, S. P. Norsett, G. Wanner:
 * Solving Ordinary Differential Equations I, 2nd ed. 1993, sections II.4 to II.6 and the appendix).
 * In the notation of rk.c, with K_(s+1) the rate at the end of the step:
 *
 *   estimate      E = h sum e_i K_i,  |E| the root mean square of E_i / tolerance_i over (q, v).
 *                 rk8 has a second estimate E3 of order 3, and its error is taken as
 *                 |E|^2 / sqrt(|E|^2 + 0.01 |E3|^2), which falls with h^8. |E| alone falls with h^6
 *   interpolant   y + x (F_1 + (1 - x) (F_2 + x (F_3 + (1 - x) (F_4 + ...)))),  x = (t - t_n) / h,
 *                 F_1 = y_(n+1) - y_n,  F_2 = h K_1 - F_1,  F_3 = 2 F_1 - h (K_1 + K_(s+1)),  F_4
 *                 ... = h sum d_i K_i
 *
 * Whatever F_4 and the later terms are, the interpolant agrees with the states and rates at both
 * ends of the step. The norm of the error and the tolerances are the same as those of CVODE, so
 * that all methods are about equally accurate at the same rtol. Extra rates of the interpolant are
 * evaluated only if a time inside the step is requested, and never affect the motion.
 *
 * Projection: the end of a step is projected before the rate there is evaluated. The interpolant
 * thus ends at the projected state, and the next step begins there. If the error estimate needs the
 * rate at the end, the estimate is computed after the projection, so that the rate is evaluated
 * only once. This is accurate enough, because the projection does not change the state by more than
 * the estimate.
 *
 * The time t + h at the end of a step is rounded. h is then set to the difference of the rounded
 * times, so that it is exactly the length of the step. */
#include "integrate/rk_adaptive.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Square of the weight of the error estimate of order 3. */
static const double SHARE_OF_ERROR3 = 0.01;

/* Largest displacement by the projection, in units of the tolerance, with which a step is accepted
 * if problem->distrusts_projection is true. */
static const double MOST_MOVED = 10.0;

/* Shortest step, relative to the time or to 1/rate of the motion, whichever is larger. In a step of
 * this length, the times of the stages still differ from each other. */
static const double SHORTEST = 10.0 * DBL_EPSILON;

/* Largest number of tries of one step. Each try is at most 0.9 times as long as the last one, so
 * half of this number is enough to shorten a step from the time scale T to the shortest step. */
enum { MOST_TRIES = 1000 };

/* ---- failures ---- */

/* Fail with the message of an evaluation. h is the length of the step, or 0 if no step has
 * begun. */
static baum_status fail_with_evaluation(const baum_i_rk_adaptive *run, double h)
{
  return baum_i_fail_in_step(run->failure, run->message.text, run->pair->name, run->t, h);
}

static void keep_failure(baum_i_rk_adaptive *run, baum_status status)
{
  run->failure = status;
  run->failure_t = run->t;
  run->message = baum_i_message_keep();
}

/* Tell whether a shorter step may help. */
static bool may_shorten(const baum_i_problem *problem, baum_status status)
{
  if (status == BAUM_ERR_CALLBACK) {
    return problem->workspace->point.retry;
  }
  return status == BAUM_ERR_NOT_FINITE || status == BAUM_ERR_SINGULAR ||
         status == BAUM_ERR_CONVERGENCE;
}

/* Fail because the step is too short. If an earlier evaluation failed very close to this time, its
 * failure is the reason, even if the last evaluation succeeded. */
static baum_status fail_short(const baum_i_rk_adaptive *run, const baum_i_problem *problem,
                              double h)
{
  bool near = fabs(run->t - run->failure_t) * problem->rate <= 1e-6;
  if (run->failure != BAUM_OK && near) {
    return fail_with_evaluation(run, h);
  }
  return baum_i_fail(
    BAUM_ERR_STEP,
    "t = %.9g s: %s: a step of %.3g s is too short to change the time; the error stays "
    "above the tolerance however small the step: a force may jump here, the configuration "
    "may be near a singular one, the motion may grow without bound, or rtol = %g "
    "is too small",
    run->t, run->pair->name, h, problem->rtol);
}

/* ---- norms ---- */

static void weigh(baum_i_rk_adaptive *run, const baum_i_problem *problem)
{
  int nq = run->rk.nq;
  baum_i_problem_tolerances(problem, run->rk.start + nq, run->weights, run->weights + nq);
  for (int i = 0; i < nq + run->rk.nv; i++) {
    run->weights[i] = 1.0 / run->weights[i];
  }
}

/* Refuse tolerances below the rounding of the state, because no step can meet them. */
static baum_status check_tolerances(const baum_i_rk_adaptive *run, const baum_i_problem *problem)
{
  static const double ONE = 1.0;
  const baum_i_rk *rk = &run->rk;
  double squares = rk->kernel->square(rk->size, 1, &ONE, rk->start, run->weights);
  if (!(DBL_EPSILON * sqrt(squares / (rk->nq + rk->nv)) > 1.0)) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_STEP,
                     "t = %.9g s: %s: rtol = %g and atol ask for more digits than double precision "
                     "has; raise rtol",
                     run->t, run->pair->name, problem->rtol);
}

static double square(const baum_i_rk_adaptive *run, const double *weights)
{
  const baum_i_rk *rk = &run->rk;
  return rk->kernel->square(rk->size, run->pair->error_count, weights, rk->rates, run->weights);
}

/* Return the estimated error of the step by h in units of the tolerance. */
static double estimate(const baum_i_rk_adaptive *run, double h)
{
  const baum_i_rk_pair *pair = run->pair;
  double count = run->rk.nq + run->rk.nv;
  double squares = square(run, pair->error);
  if (!pair->error3) {
    return fabs(h) * sqrt(squares / count);
  }
  double both = squares + SHARE_OF_ERROR3 * square(run, pair->error3);
  return both == 0.0 ? 0.0 : fabs(h) * squares / sqrt(both * count);
}

/* ---- begin ---- */

/* Choose the length of the first step. If the error constant of the method were one, the local
 * error of a step of this length would equal the tolerance. The step control corrects this length
 * later. */
static double first_step(const baum_i_rk_adaptive *run, const baum_i_problem *problem)
{
  const baum_i_rk *rk = &run->rk;
  const baum_mechanism *m = problem->workspace->mechanism;
  const double *a = baum_i_rk_rate(rk, 0) + rk->nq;
  double rate = fmax(problem->rate, baum_i_state_rate(m, rk->start + rk->nq, a));
  double tolerance = problem->rtol * fmin(problem->tolerance_q, problem->tolerance_v);
  return pow(fmin(tolerance, 1.0), 1.0 / run->pair->error_order) / rate;
}

baum_status baum_i_rk_adaptive_restart(void *self, const baum_i_problem *problem,
                                       const baum_i_state *state)
{
  baum_i_rk_adaptive *run = self;
  run->unfinished = true;
  run->has_step = false;
  run->failure = BAUM_OK;
  run->t = state->t;
  memcpy(run->rk.start, state->q, (size_t)run->rk.nq * sizeof *state->q);
  memcpy(run->rk.start + run->rk.nq, state->v, (size_t)run->rk.nv * sizeof *state->v);
  baum_status status = baum_i_rk_evaluate(&run->rk, problem, run->t, run->rk.start, 0);
  if (status == BAUM_OK) {
    status = baum_i_rk_crossing_begin(&run->crossing, &run->rk, problem, run->t);
  }
  if (status != BAUM_OK) {
    keep_failure(run, status);
    return fail_with_evaluation(run, 0.0);
  }
  baum_i_step_control_begin(&run->control, run->pair->error_order, first_step(run, problem));
  run->unfinished = false;
  return BAUM_OK;
}

void baum_i_rk_adaptive_forget(void *self)
{
  baum_i_rk_adaptive *run = self;
  run->unfinished = true;
}

/* Make the end of the last step the start of the next one. */
static void go_on(baum_i_rk_adaptive *run, const baum_i_problem *problem)
{
  const baum_i_rk *rk = &run->rk;
  size_t bytes = (size_t)rk->size * sizeof *rk->start;
  run->t = run->t_end;
  memcpy(rk->start, run->end, bytes);
  memcpy(rk->rates, baum_i_rk_rate(rk, rk->table->stages), bytes);
  run->has_step = false;
  baum_i_rk_crossing_go_on(&run->crossing, rk, problem, run->control.step);
}

static baum_status begin(baum_i_rk_adaptive *run, const baum_i_problem *problem,
                         const baum_i_state *state)
{
  if (run->unfinished) {
    BAUM_I_TRY(baum_i_rk_adaptive_restart(run, problem, state));
  } else if (run->has_step) {
    go_on(run, problem);
  }
  weigh(run, problem);
  return check_tolerances(run, problem);
}

/* ---- one step ---- */

/* Project the end of a step. *moved is the displacement in units of the tolerance of positions. */
static baum_status project_end(const baum_i_rk_adaptive *run, const baum_i_problem *problem,
                               double *moved)
{
  int nq = run->rk.nq;
  double *before = run->dense; /* used as scratch; it contains no data of this step yet */
  double squares = 0.0;
  memcpy(before, run->end, (size_t)nq * sizeof *before);
  baum_status status = baum_i_project(problem->workspace, run->t_end, run->end, run->end + nq);
  for (int i = 0; i < nq; i++) {
    double move = (run->end[i] - before[i]) * run->weights[i];
    squares += move * move;
  }
  *moved = sqrt(squares / nq);
  return status;
}

/* Project the end and evaluate its rate. If the velocity that a driver prescribes jumps, the
 * accelerations do not show this jump. Only the displacement by the projection shows it. */
static baum_status finish_end(const baum_i_rk_adaptive *run, const baum_i_problem *problem,
                              double *error)
{
  const baum_i_rk *rk = &run->rk;
  baum_status status = BAUM_OK;
  double moved = 0.0;
  baum_i_normalize(problem->workspace->mechanism, run->end);
  if (problem->formulation == BAUM_FORMULATION_PROJECTION) {
    status = project_end(run, problem, &moved);
  }
  if (problem->distrusts_projection) {
    *error = fmax(*error, moved / MOST_MOVED);
  }
  BAUM_I_TRY(status);
  return baum_i_rk_evaluate(rk, problem, run->t_end, run->end, rk->table->stages);
}

/* Try a step from t to t_end: estimate its error and, if the error is at most `most`, find the end
 * of the step and the rate there. */
static baum_status try_step(baum_i_rk_adaptive *run, const baum_i_problem *problem, double most,
                            double *error)
{
  const baum_i_rk *rk = &run->rk;
  const baum_i_rk_table *table = rk->table;
  bool needs_end = run->pair->error_count > table->stages;
  *error = 0.0;
  BAUM_I_TRY(baum_i_rk_stages(rk, problem, run->t, run->h));
  if (!needs_end) {
    *error = estimate(run, run->h);
  }
  if (*error <= most) {
    baum_i_rk_combine(rk, table->stages, table->b, run->h, run->end);
    BAUM_I_TRY(finish_end(run, problem, error));
  }
  if (needs_end) {
    *error = fmax(*error, estimate(run, run->h));
  }
  return BAUM_OK;
}

/* Accept a step of the given length. If the step was shortened because of a singular configuration
 * ahead, the step control keeps the longer length, because the next step needs it to pass the
 * configuration. */
static void accept(baum_i_rk_adaptive *run, double error, double length, baum_i_state *state)
{
  double wanted = run->control.step;
  baum_i_step_control_accept(&run->control, fabs(run->h), error);
  if (length < wanted) {
    run->control.step = fmax(run->control.step, wanted);
  }
  run->has_step = true;
  run->has_dense = false;
  state->t = run->t_end;
  memcpy(state->q, run->end, (size_t)run->rk.nq * sizeof *state->q);
  memcpy(state->v, run->end + run->rk.nq, (size_t)run->rk.nv * sizeof *state->v);
}

/* Choose the end of a step of about the given length. */
static baum_status choose_end(baum_i_rk_adaptive *run, const baum_i_problem *problem, double length)
{
  length = fmin(length, problem->max_step);
  double shortest = fmax(SHORTEST * fmax(fabs(run->t), 1.0 / problem->rate), DBL_MIN);
  double left = problem->stops ? problem->direction * (problem->stop - run->t) : (double)INFINITY;
  if (length < left && 2.0 * length > left) {
    length = 0.5 * left; /* take two equal steps, so that the last step is not tiny */
  }
  run->t_end = length < left ? run->t + problem->direction * length : problem->stop;
  length = fmin(length, left);
  run->h = run->t_end - run->t;
  bool is_sound = length >= shortest && isfinite(run->h);
  return is_sound ? BAUM_OK : fail_short(run, problem, length);
}

/* Try steps until one is accepted. */
static baum_status step(baum_i_rk_adaptive *run, const baum_i_problem *problem, baum_i_state *state)
{
  baum_i_rk_crossing_look(&run->crossing, &run->rk, problem, run->t);
  for (int k = 0; k < MOST_TRIES && !baum_i_rk_crossing_is_held(&run->crossing); k++) {
    double error = 0.0;
    bool forced = false;
    double length = baum_i_rk_crossing_length(&run->crossing, &run->rk, problem, run->t,
                                              run->control.step, &forced);
    BAUM_I_TRY(choose_end(run, problem, length));
    double most = baum_i_rk_crossing_error(&run->crossing, run->h, forced) / problem->rtol;
    most = fmax(1.0, most); /* largest accepted error, in units of the tolerance */
    baum_status status = try_step(run, problem, most, &error);
    if (status == BAUM_OK && error <= most &&
        baum_i_rk_crossing_may_end(&run->crossing, &run->rk, problem, run->h, run->t_end,
                                   run->end)) {
      run->forced += error > 1.0;
      accept(run, fmin(error, 1.0), length, state);
      return BAUM_OK;
    }
    if (status != BAUM_OK) {
      keep_failure(run, status);
      if (!may_shorten(problem, status)) {
        return fail_with_evaluation(run, run->h);
      }
    }
    if (forced || status != BAUM_OK) {
      run->crossing.least = 0.0; /* the failure may have another cause, so permit short steps */
    }
    /* The next length depends on the error only if the step was refused because of its error. */
    bool known = status == BAUM_OK && error > most;
    baum_i_step_control_refuse(&run->control, fabs(run->h), known ? error : (double)INFINITY);
    baum_i_rk_crossing_refuse(&run->crossing, &run->rk, problem, run->h);
    run->rejected++;
  }
  return fail_short(run, problem, run->control.step);
}

baum_status baum_i_rk_adaptive_advance(void *self, const baum_i_problem *problem,
                                       baum_i_state *state)
{
  baum_i_rk_adaptive *run = self;
  baum_status status = begin(run, problem, state);
  if (status == BAUM_OK) {
    status = step(run, problem, state);
  }
  run->unfinished = status != BAUM_OK;
  return status;
}

/* ---- inside the last step ---- */

static baum_status evaluate_extra(const baum_i_rk_adaptive *run, const baum_i_problem *problem)
{
  const baum_i_rk *rk = &run->rk;
  const baum_i_rk_pair *pair = run->pair;
  const double *row = pair->extra_a;
  for (int i = 0; i < pair->extra; i++) {
    int stage = rk->table->stages + 1 + i;
    baum_i_rk_combine(rk, stage, row, run->h, rk->point);
    BAUM_I_TRY(
      baum_i_rk_evaluate(rk, problem, run->t + pair->extra_c[i] * run->h, rk->point, stage));
    row += stage;
  }
  return BAUM_OK;
}

/* Write the coefficients F_1, F_2, ... of the interpolant to run->dense. */
static void fill_dense(const baum_i_rk_adaptive *run)
{
  const baum_i_rk *rk = &run->rk;
  const baum_i_rk_pair *pair = run->pair;
  int n = rk->size;
  int rates = rk->table->stages + 1 + pair->extra;
  const double *first = rk->rates;
  const double *last = baum_i_rk_rate(rk, rk->table->stages);
  for (int i = 0; i < n; i++) {
    double change = run->end[i] - rk->start[i];
    run->dense[i] = change;
    run->dense[n + i] = run->h * first[i] - change;
    run->dense[2 * n + i] = 2.0 * change - run->h * (first[i] + last[i]);
  }
  double *more = run->dense + 3 * (size_t)n;
  memset(more, 0, (size_t)pair->dense * (size_t)n * sizeof *more);
  for (int k = 0; k < pair->dense; k++, more += n) {
    rk->kernel->combine(n, rates, pair->dense_row + k * rates, run->h, rk->rates, more, more);
  }
}

static baum_status prepare_dense(baum_i_rk_adaptive *run, const baum_i_problem *problem)
{
  if (run->has_dense) {
    return BAUM_OK;
  }
  BAUM_I_TRY(evaluate_extra(run, problem));
  fill_dense(run);
  run->has_dense = true;
  return BAUM_OK;
}

baum_status baum_i_rk_adaptive_interpolate(void *self, const baum_i_problem *problem, double t,
                                           double *q, double *v)
{
  baum_i_rk_adaptive *run = self;
  if (!run->has_step || !((t - run->t) * (t - run->t_end) <= 0.0)) {
    return baum_i_fail(BAUM_ERR_INTEGRATOR, "t = %.9g s is not inside the last step of %s", t,
                       run->pair->name);
  }
  BAUM_I_TRY(prepare_dense(run, problem));
  double x = (t - run->t) / run->h;
  const baum_i_rk *rk = &run->rk;
  rk->kernel->interpolate(rk->size, 3 + run->pair->dense, x, run->dense, rk->start, rk->point);
  memcpy(q, rk->point, (size_t)rk->nq * sizeof *q);
  memcpy(v, rk->point + rk->nq, (size_t)rk->nv * sizeof *v);
  baum_i_normalize(problem->workspace->mechanism, q);
  return BAUM_OK;
}

/* ---- life ---- */

void baum_i_rk_adaptive_statistics(const void *self, baum_i_statistics *out)
{
  const baum_i_rk_adaptive *run = self;
  *out = (baum_i_statistics){.rejected = run->rejected, .forced = run->forced};
}

baum_status baum_i_rk_adaptive_open(void *self, const void *table, const baum_i_problem *problem,
                                    const baum_i_state *start)
{
  (void)start;
  baum_i_rk_adaptive *run = self;
  const baum_i_rk_pair *pair = table;
  int rates = pair->table.stages + 1 + pair->extra;
  BAUM_I_TRY(baum_i_rk_make(&run->rk, &pair->table, problem, rates, 5 + pair->dense, &run->end));
  run->pair = pair;
  baum_i_rk_crossing_open(&run->crossing, &pair->table);
  run->weights = run->end + run->rk.size;
  run->dense = run->weights + run->rk.size;
  run->unfinished = true;
  return BAUM_OK;
}
