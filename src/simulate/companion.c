/* SPDX-License-Identifier: BSD-3-Clause */
/* The companion of a run is a second integration of the same motion. It estimates the error of the
 * run.
 *
 * Fixed-step methods have no tolerance, and they take many short steps where rk8 with projection
 * takes one long step. If the run has a fixed step, the companion therefore uses rk8, which costs
 * little compared with the run. The companion starts as soon as the error of the run may matter.
 * This is the case when the sum of the run's local errors is so large that, amplified by 1e4, it
 * would make the result wrong. If the run has variable steps and a loose tolerance, the companion
 * starts when the run first crosses a singular configuration, because crossings amplify errors. The
 * first state of the companion is a state that the run had some steps earlier, when it was still
 * accurate. If run and companion differ by more than DOUBTFUL for some time, the run warns. Short
 * peaks of the difference are ignored. They occur, for example, if a light rod flips a little too
 * late.
 *
 * With the option error_check, the companion starts together with the run. If the run has variable
 * steps, the companion then uses the method of the run with 0.03 times the tolerance. A factor of
 * 0.1 is not enough: with it, run and companion had the same wrong motion in one of 2000
 * mechanisms.
 *
 * The companion has its own workspace. Its evaluations therefore do not change the solver or the
 * counters of the run. The companion ends if it fails, or if it costs too much compared with the
 * run, for example because of stiff forces. The error of the run is then unknown. */
#include "simulate/companion.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/text.h"
#include "simulate/crossing.h"
#include "simulate/local_error.h"
#include "simulate/saved.h"

/* If run and companion differ by more than this, relative to the scales, the run is doubtful.
 * Correct results have errors below 0.01, and wrong results have errors above 0.1. */
static const double DOUBTFUL = 0.03;
/* The run warns if the difference stays above DOUBTFUL for longer than this fraction of 1/rate. */
static const double LASTING = 0.1;
/* The warning recommends a step with which the run would have about this error. FINE is well below
 * DOUBTFUL, because the error continues to grow after the warning. */
static const double FINE = 0.002;
/* If the sum of local errors is below this, no companion is necessary, although the motion may
 * amplify errors: an amplification by 1e3 leaves the error negligible, and one by 1e4 does not make
 * the result wrong. */
static const double NEGLIGIBLE = 1e-5;
/* At the start no local error has been estimated. The companion then starts at once if (step * rate
 * of the motion)^order is above this. */
static const double COARSE = 1e-3;
/* Tolerance rtol of rk8 as a companion. Even if errors are multiplied by 1e3 during the motion, the
 * error of the companion stays below 0.01. A result with this error counts as correct. */
static const double TOLERANCE = 1e-5;
static const double TOLERANCE_OF_CHECK = 1e-8; /* the same with error_check */
/* If the run has variable steps: tolerance of the companion relative to the tolerance of the run,
 * without error_check (TIGHTER) and with it (TIGHTER_OF_CHECK). */
static const double TIGHTER = 0.1;
static const double TIGHTER_OF_CHECK = 0.03;
static const double LEAST_RTOL = 1e-14; /* with smaller tolerances, rounding errors dominate */
/* Largest number of evaluations of the companion for each evaluation of the run. MOST_COST applies
 * without error_check. The user has then not requested the companion, so it must not slow the run
 * down much. FREE further evaluations are always allowed, because short runs with long steps take
 * only few evaluations. */
static const double MOST_COST = 2.0;
static const double MOST_COST_OF_CHECK = 10.0;
static const int64_t FREE = 1000;

enum {
  STRIDE = 8, /* number of steps between two stored states */
  /* The local errors of some steps are unknown. The error of the run is unknown if there are more
   * than UNSEEN such steps and they are more than three quarters of all steps. */
  UNSEEN = 16
};

typedef enum state_of_companion { WAITS, GOES_ALONG, ENDED } state_of_companion;

struct baum_i_companion {
  /* The members before `method` are plain numbers. They are part of a saved run. */
  int64_t steps;  /* number of steps since the last start */
  int64_t unseen; /* number of these steps whose local errors are unknown */
  int64_t begun;  /* number of evaluations of the run when the companion started */
  double sum;     /* sum of local errors */
  double apart;   /* [s] time at which run and companion began to differ, or NaN while they agree */
  int32_t doing;  /* a value of the enum state_of_companion */

  const baum_integrator *method;
  baum_workspace *workspace;
  baum_i_problem problem; /* the problem that the companion integrates */
  void *self;
  baum_i_local_error local; /* the local errors of the run */
  baum_i_state state;       /* state at the start of the companion's next step */
  baum_i_state at;          /* state of the companion at the time of the last comparison */
  /* Earlier states of the run: [0] is at least STRIDE steps old, [1] is newer. */
  baum_i_state kept[2];
};

/* ---- life ---- */

static baum_status make_memory(baum_i_companion *c)
{
  const baum_mechanism *m = c->workspace->mechanism;
  baum_i_state *const states[] = {&c->state, &c->at, &c->kept[0], &c->kept[1]};
  enum { STATES = sizeof states / sizeof states[0] };
  size_t size = (size_t)m->nq + (size_t)m->nv;
  double *next = baum_i_alloc(STATES * size + baum_i_local_error_size(m), sizeof *next);
  BAUM_I_TRY(baum_i_check_memory(next));
  for (int k = 0; k < STATES; k++, next += size) {
    *states[k] = (baum_i_state){.q = next, .v = next + m->nq};
  }
  baum_i_local_error_place(&c->local, m, next);
  return BAUM_OK;
}

static double rtol_of_check(const baum_simulation *run)
{
  return fmax(TIGHTER_OF_CHECK * run->problem.rtol, LEAST_RTOL);
}

bool baum_i_companion_is_wanted(const baum_simulation *run)
{
  bool loose = run->problem.rtol >= 0.5 * TOLERANCE;
  bool wanted = run->options.error_check || baum_i_run_has_fixed_step(run) || loose;
  return wanted && !run->integrator->without_freedom;
}

static void choose_problem(const baum_simulation *run, baum_i_companion *c)
{
  c->problem = run->problem;
  c->problem.workspace = c->workspace;
  c->problem.distrusts_projection = true;
  if (run->options.error_check && !baum_i_run_has_fixed_step(run)) {
    c->method = run->integrator;
    c->problem.rtol = rtol_of_check(run);
    c->problem.atol = TIGHTER_OF_CHECK * run->problem.atol;
    return;
  }
  double tolerance =
    baum_i_run_has_fixed_step(run) ? TOLERANCE : fmin(TOLERANCE, TIGHTER * run->problem.rtol);
  c->method = baum_rk8();
  c->problem.formulation = BAUM_FORMULATION_PROJECTION;
  c->problem.step = (double)NAN;
  c->problem.rtol = run->options.error_check ? TOLERANCE_OF_CHECK : tolerance;
  c->problem.atol = 0.0;
  c->problem.max_step = (double)INFINITY;
  c->problem.tolerance_q = 1.0;
  c->problem.tolerance_v = 1.0;
}

baum_status baum_i_companion_create(baum_simulation *run)
{
  baum_i_companion *c = baum_i_alloc(1, sizeof *c);
  BAUM_I_TRY(baum_i_check_memory(c));
  run->companion = c;
  BAUM_I_TRY(baum_i_run_make_workspace(run, &c->workspace));
  BAUM_I_TRY(make_memory(c));
  run->beside[1] = c->workspace;
  choose_problem(run, c);
  return baum_i_integrator_create(c->method, &c->problem, &run->trial, &c->self);
}

void baum_i_companion_destroy(baum_i_companion *c)
{
  if (c) {
    baum_i_integrator_destroy(c->method, c->self);
    baum_workspace_destroy(c->workspace);
    baum_i_free(c->state.q);
    baum_i_free(c);
  }
}

/* ---- compare ---- */

static void warn_of_error(baum_simulation *run, double t)
{
  double error = run->counters.error_estimate;
  char advice[64] = "take a smaller rtol";
  if (baum_i_run_has_fixed_step(run)) {
    double advised = run->options.step * pow(FINE / error, 1.0 / run->integrator->order);
    baum_i_print(advice, sizeof advice, "take a step below %.1g s", advised);
  }
  baum_i_run_warn(run, BAUM_WARNING_ACCURACY, t, BAUM_I_NO_JOINT,
                  "t = %.9g s: the estimated error of the positions by %s is %.2g (lengths "
                  "relative to the characteristic length, angles in radians); %s",
                  t, run->integrator->name, error, advice);
  run->companion->doing = run->options.error_check ? GOES_ALONG : ENDED;
}

static void compare_positions(baum_simulation *run, const baum_i_state *state)
{
  baum_i_companion *c = run->companion;
  const baum_mechanism *m = run->workspace->mechanism;
  double *apart = c->workspace->work_v;
  baum_i_difference(m, c->at.q, state->q, apart);
  double error = baum_i_scaled_size(m, apart);
  run->counters.error_estimate = fmax(run->counters.error_estimate, error);
  if (!(error > DOUBTFUL)) {
    c->apart = (double)NAN;
  } else if (isnan(c->apart)) {
    c->apart = state->t;
  }
}

/* Warn if run and companion have differed for long enough. At an output, warn even if they have
 * differed for a short time only, because the user receives this state. */
static void warn_if_apart(baum_simulation *run, double t, bool output)
{
  const baum_i_companion *c = run->companion;
  bool lasts = fabs(t - c->apart) * run->problem.rate > LASTING;
  bool is_apart = lasts || (output && !isnan(c->apart));
  if (is_apart && !baum_i_run_has_warned(run, BAUM_WARNING_ACCURACY)) {
    warn_of_error(run, t);
  }
}

/* ---- following the run ---- */

/* Write the companion's state at time t to c->at. This time is inside the last step of the
 * companion. */
static baum_status interpolate_at(baum_simulation *run, double t)
{
  baum_i_companion *c = run->companion;
  if (t == c->state.t) {
    baum_i_run_copy(run, &c->state, &c->at);
    return BAUM_OK;
  }
  c->at.t = t;
  return c->method->interpolate(c->self, &c->problem, t, c->at.q, c->at.v);
}

static bool is_too_costly(const baum_simulation *run)
{
  const baum_i_companion *c = run->companion;
  double cost = (double)(run->workspace->evaluations - c->begun);
  double most = run->options.error_check ? MOST_COST_OF_CHECK : MOST_COST;
  return (double)(c->workspace->evaluations - FREE) > most * cost;
}

/* Take steps of the companion until it has reached t. */
static baum_status go_to(baum_simulation *run, double t)
{
  baum_i_companion *c = run->companion;
  while (c->problem.direction * (t - c->state.t) > 0.0) {
    BAUM_I_TRY(is_too_costly(run) ? BAUM_ERR_STEP
                                  : c->method->advance(c->self, &c->problem, &c->state));
  }
  return interpolate_at(run, t);
}

/* A companion that the user has not requested may end without a warning if it is too costly. */
static void warn_of_end(baum_simulation *run, double t)
{
  bool costly = is_too_costly(run);
  if (run->options.error_check || !costly) {
    baum_i_run_warn(
      run, BAUM_WARNING_ERROR_UNKNOWN, t, BAUM_I_NO_JOINT,
      "t = %.9g s: the error of the motion is unknown, because the second integration "
      "that estimates it %s; compare with a run that has %s",
      t, costly ? "takes more than ten times as many evaluations as the run" : "has failed",
      baum_i_run_has_fixed_step(run) ? "half the step" : "a tenth of rtol");
  }
}

/* Follow the run to a state, and compare the companion with this state. If the companion fails, the
 * run continues without it. */
static bool reach(baum_simulation *run, const baum_i_state *state)
{
  baum_i_companion *c = run->companion;
  baum_i_run_share_equations(run, &c->problem);
  c->problem.stop = baum_i_run_next_break(run).near;
  c->problem.stops = isfinite(c->problem.stop);
  bool reached = go_to(run, state->t) == BAUM_OK;
  if (reached) {
    compare_positions(run, state);
  } else {
    c->doing = ENDED;
    run->counters.error_estimate = (double)NAN;
    warn_of_end(run, state->t);
  }
  return reached;
}

static bool goes_along(const baum_simulation *run)
{
  return run->companion && run->companion->doing == GOES_ALONG;
}

static void keep_state(baum_simulation *run, const baum_i_state *state)
{
  baum_i_companion *c = run->companion;
  baum_i_run_copy(run, &c->kept[1], &c->kept[0]);
  baum_i_run_copy(run, state, &c->kept[1]);
}

static void keep_present_twice(baum_simulation *run)
{
  keep_state(run, &run->state);
  keep_state(run, &run->state);
  run->companion->local.known = 0;
}

static void start_companion(baum_simulation *run, const baum_i_state *from)
{
  baum_i_companion *c = run->companion;
  c->doing = GOES_ALONG;
  c->apart = (double)NAN;
  c->begun = run->workspace->evaluations;
  c->workspace->evaluations = 0;
  c->problem.direction = run->problem.direction;
  run->counters.error_estimate = 0.0;
  baum_i_run_copy(run, from, &c->state);
  c->method->forget(c->self);
}

static bool is_coarse(const baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double rate = fmax(run->problem.rate, baum_i_scaled_size(m, run->state.v));
  return baum_i_run_has_fixed_step(run) &&
         pow(run->options.step * rate, run->integrator->order) > COARSE;
}

void baum_i_companion_begin(baum_simulation *run)
{
  baum_i_companion *c = run->companion;
  if (c) {
    keep_present_twice(run);
    c->sum = 0.0;
    c->steps = 0;
    c->unseen = 0;
    c->doing = WAITS;
    run->counters.error_estimate = baum_i_run_has_fixed_step(run) ? 0.0 : (double)NAN;
    if (run->options.error_check || is_coarse(run)) {
      start_companion(run, &run->state);
    }
  }
}

/* Tell whether the errors of the run may matter. If so, the companion must start. */
static bool may_matter(baum_simulation *run)
{
  baum_i_companion *c = run->companion;
  if (!baum_i_run_has_fixed_step(run)) {
    return run->counters.near_singular_intervals > 0;
  }
  c->unseen += c->local.known < BAUM_I_ACCELERATIONS;
  int64_t steps = c->steps++;
  if (c->unseen > UNSEEN && 4 * c->unseen > 3 * steps) {
    /* The error is unknown, because inputs change every few steps. */
    run->counters.error_estimate = (double)NAN;
  }
  c->sum += baum_i_local_error_of_step(&c->local, run);
  /* Steps whose local errors are unknown are assumed to have the mean error of the others. */
  double seen = fmax((double)(steps - c->unseen), 0.25 * (double)steps);
  return !(c->sum * (double)steps <= NEGLIGIBLE * seen);
}

static void wait_or_start(baum_simulation *run, const baum_i_state *state)
{
  bool is_clear = !run->crossings || !run->crossings->open;
  if (may_matter(run)) {
    start_companion(run, &run->companion->kept[0]);
  } else if (is_clear && run->counters.steps % STRIDE == 0) {
    keep_state(run, state);
  }
}

void baum_i_companion_follow(baum_simulation *run, const baum_i_state *state)
{
  baum_i_companion *c = run->companion;
  if (c && c->doing == WAITS) {
    wait_or_start(run, state);
  }
  if (goes_along(run) && c->problem.direction * (state->t - c->state.t) >= 0.0 &&
      reach(run, state)) {
    warn_if_apart(run, state->t, false);
  }
}

void baum_i_companion_output(baum_simulation *run, const baum_i_state *state)
{
  if (goes_along(run) && reach(run, state)) {
    warn_if_apart(run, state->t, true);
  }
}

/* ---- changes ---- */

void baum_i_companion_settle(baum_simulation *run)
{
  baum_i_companion *c = run->companion;
  if (goes_along(run) && reach(run, &run->state)) {
    baum_i_run_copy(run, &c->at, &c->state);
  }
}

void baum_i_companion_restart(baum_simulation *run)
{
  baum_i_companion *c = run->companion;
  if (goes_along(run)) {
    c->state.t = run->state.t;
    c->method->forget(c->self);
  } else if (c) {
    keep_present_twice(run);
  }
}

void baum_i_companion_forget(baum_simulation *run)
{
  baum_i_companion_restart(run);
  if (run->companion) {
    baum_i_workspace_forget(run->companion->workspace);
  }
}

/* ---- saved ---- */

void baum_i_companion_saved(baum_i_companion *c, baum_i_saved *list)
{
  baum_workspace *w = c->workspace;
  baum_i_saved_add(list, c, offsetof(baum_i_companion, method), 2);
  baum_i_saved_add(list, &w->evaluations, sizeof w->evaluations, 1);
  baum_i_saved_add_state(list, w->mechanism, &c->state);
}
