/* SPDX-License-Identifier: BSD-3-Clause */
/* The loop of a run.
 *
 * Fixed step: times are origin + k h. A step is tried on the trial state, projected if the
 * formulation includes projection, and checked. Only then does the trial state become the present
 * state. A sample between two grid times is the end of a trial step that is discarded afterwards.
 *
 * Variable step: the method takes whole steps, whose lengths it chooses, up to or beyond the
 * requested time. Reported states are interpolated inside the last step and projected if the
 * formulation includes projection. */
#include <math.h>

#include "base/platform.h"
#include "mechanism/definition.h"
#include "simulate/account.h"
#include "simulate/companion.h"
#include "simulate/crossing.h"
#include "simulate/events.h"

/* Times that differ by less than this fraction of a step are equal. */
static const double SAME_TIME = 1e-9;

/* ---- one step of fixed length, on the trial state ---- */

static void keep_trial(baum_simulation *run)
{
  baum_i_run_follow_step(run, &run->trial);
  baum_i_run_observe_jumps(run, &run->trial);
  baum_i_run_copy(run, &run->trial, &run->state);
  run->counters.steps++;
  if (run->account) {
    baum_i_account_accept(run);
  }
  if (run->integrator->accept) {
    run->integrator->accept(run->self, &run->problem, &run->state);
  }
  baum_i_crossings_look(run);
  baum_i_run_recheck(run, &run->state, false);
}

/* ---- a fixed-step method to a target ---- */

static double grid_time(const baum_simulation *run, int64_t k)
{
  return run->grid.origin + (double)k * run->options.step;
}

/* Start a new grid after a step off the grid. The method discards its history, which belongs to the
 * old grid. */
static void leave_grid(baum_simulation *run)
{
  run->counters.short_steps++;
  run->counters.restarts += run->integrator->accept ? 1 : 0;
  run->grid = (baum_i_grid){.origin = run->state.t};
}

/* Search the step to t_next, which has just been tried, for events. If there is a terminal event,
 * accept the step up to the event and return BAUM_STOP_EVENT. */
static baum_status watch_step(baum_simulation *run, double t_next)
{
  baum_status status = run->events ? baum_i_events_watch(run, t_next) : BAUM_OK;
  if (status == BAUM_STOP_EVENT) {
    keep_trial(run);
    leave_grid(run);
    if (run->integrator->accept) {
      (void)run->integrator->restart(run->self, &run->problem, &run->state); /* cannot fail */
    }
  }
  return status;
}

static baum_status kept_step(baum_simulation *run, double t_next)
{
  BAUM_I_TRY(baum_i_run_choose_rows(run));
  BAUM_I_TRY(baum_i_run_try_step(run, t_next, true));
  BAUM_I_TRY(watch_step(run, t_next));
  keep_trial(run);
  return BAUM_OK;
}

/* The next step, which ends on the grid or at a break (a time at which functions may jump). */
typedef struct fixed_step {
  baum_i_break at; /* the next break */
  double on_grid;  /* [s] next time on the grid */
  bool breaks;     /* true if the step ends at the break */
} fixed_step;

static fixed_step find_next(const baum_simulation *run, int direction)
{
  fixed_step next = {.at = baum_i_run_next_break(run),
                     .on_grid = grid_time(run, run->grid.k + direction)};
  next.breaks = direction * (next.on_grid - next.at.near) >= -SAME_TIME * run->options.step;
  return next;
}

static baum_status grid_step(baum_simulation *run, int direction, double t_next)
{
  if (t_next == run->state.t) {
    return baum_i_fail(BAUM_ERR_STEP,
                       "t = %.17g s: the step of %g s is smaller than the rounding error of the "
                       "time; take a larger step",
                       run->state.t, run->options.step);
  }
  baum_status status = kept_step(run, t_next);
  run->grid.k += status == BAUM_OK ? direction : 0;
  return status;
}

/* Step to a break and pass it. */
static baum_status break_step(baum_simulation *run, const fixed_step *next)
{
  BAUM_I_TRY(baum_i_run_is_at(run, next->at) ? BAUM_OK : kept_step(run, next->at.near));
  run->counters.short_steps += fabs(next->on_grid - next->at.near) > SAME_TIME * run->options.step;
  return baum_i_run_pass(run, next->at);
}

static baum_status take_next(baum_simulation *run, int direction, const fixed_step *next)
{
  return next->breaks ? break_step(run, next) : grid_step(run, direction, next->on_grid);
}

/* Take all whole steps that do not pass t. Afterwards the present time is t if t is on the grid.
 * Otherwise it is less than a step before t. */
static baum_status steps_before(baum_simulation *run, double t, int64_t *taken)
{
  int direction = run->problem.direction > 0.0 ? 1 : -1;
  double same = SAME_TIME * run->options.step;
  fixed_step next = find_next(run, direction);
  while (direction * (t - (next.breaks ? next.at.far : next.on_grid)) >= -same) {
    BAUM_I_TRY(baum_i_run_may_go_on(run, (*taken)++));
    BAUM_I_TRY(take_next(run, direction, &next));
    next = find_next(run, direction);
  }
  return BAUM_OK;
}

static bool stands_at(const baum_simulation *run, double t)
{
  return fabs(t - run->state.t) <= SAME_TIME * run->options.step;
}

static baum_status advance_fixed(baum_simulation *run, double t, int64_t *taken)
{
  BAUM_I_TRY(steps_before(run, t, taken));
  if (stands_at(run, t)) {
    return BAUM_OK;
  }
  BAUM_I_TRY(baum_i_run_may_go_on(run, (*taken)++));
  BAUM_I_TRY(kept_step(run, t));
  leave_grid(run);
  return BAUM_OK;
}

/* ---- a variable-step method to a target ---- */

static baum_status internal_step(baum_simulation *run)
{
  baum_workspace *w = run->workspace;
  BAUM_I_TRY(baum_i_run_try_own_step(run));
  /* Phi and Phi' at the end of the step are known if this end was evaluated last. */
  bool known = !baum_i_crossings_step(run, &run->trial) && run->integrator->evaluates_end;
  if (run->account) {
    baum_i_account_step(run);
  }
  baum_i_run_follow_step(run, &run->trial);
  baum_i_run_observe_jumps(run, &run->trial);
  baum_i_run_copy(run, &run->trial, &run->ahead);
  run->counters.steps++;
  if (!known) {
    BAUM_I_TRY(baum_i_violation(w, run->ahead.t, run->ahead.q, run->ahead.v));
  }
  baum_i_run_observe(run, run->ahead.t, false);
  baum_i_crossings_look(run);
  baum_i_run_recheck(run, &run->ahead, false);
  return BAUM_OK;
}

/* Make the end of the method's last step the present state. */
static void catch_up(baum_simulation *run)
{
  baum_i_run_copy(run, &run->ahead, &run->state);
}

/* Search the last step for events up to t, or up to its end if it ends before t. If a terminal
 * event is found, the state at the event becomes the present state. */
static baum_status watch_last(baum_simulation *run, double t)
{
  bool passed = run->problem.direction * (run->ahead.t - t) > 0.0;
  baum_status status = run->events ? baum_i_events_watch(run, passed ? t : run->ahead.t) : BAUM_OK;
  if (status == BAUM_STOP_EVENT) {
    baum_i_run_copy(run, &run->trial, &run->state);
  }
  return status;
}

/* Pass a break at the end of the last step, and further breaks that are too close for a step in
 * between. */
static baum_status pass_breaks(baum_simulation *run)
{
  baum_status status = BAUM_OK;
  baum_i_break next = baum_i_run_next_break(run);
  while (status == BAUM_OK && baum_i_run_is_at(run, next)) {
    catch_up(run);
    status = baum_i_run_pass(run, next);
    baum_i_run_copy(run, &run->state, &run->ahead);
    next = baum_i_run_next_break(run);
  }
  return status;
}

/* Take one more step. If the step or the search for events in it fails, the run stays at the start
 * of the step. */
static baum_status next_step(baum_simulation *run, int64_t taken)
{
  catch_up(run);
  BAUM_I_TRY(baum_i_run_may_go_on(run, taken));
  BAUM_I_TRY(baum_i_run_choose_rows(run));
  baum_i_companion_follow(run, &run->state);
  return internal_step(run);
}

static baum_status advance_variable(baum_simulation *run, double t, int64_t *taken)
{
  BAUM_I_TRY(watch_last(run, t));
  while (run->problem.direction * (t - run->ahead.t) > 0.0) {
    BAUM_I_TRY(pass_breaks(run));
    if (run->problem.direction * (t - run->ahead.t) <= 0.0) {
      return BAUM_OK; /* t is the time of the break */
    }
    BAUM_I_TRY(next_step(run, (*taken)++));
    BAUM_I_TRY(watch_last(run, t));
  }
  if (t == run->ahead.t) {
    catch_up(run);
    return BAUM_OK;
  }
  BAUM_I_TRY(baum_i_run_inside(run, t));
  baum_i_run_copy(run, &run->trial, &run->state);
  return BAUM_OK;
}

/* ---- beginning and end of every call ---- */

/* Set the direction of the run towards t. If the method cannot restart from the present state, the
 * direction does not change. */
static baum_status turn(baum_simulation *run, double t)
{
  double before = run->problem.direction;
  double direction = t < run->state.t ? -1.0 : 1.0;
  if (direction == before) {
    return BAUM_OK;
  }
  baum_i_run_end_before_change(run);
  run->problem.direction = direction;
  baum_status status = baum_i_run_restart(run);
  run->problem.direction = status == BAUM_OK ? direction : before;
  return status;
}

static baum_status advance(baum_simulation *run, double t, int64_t *taken)
{
  if (t == run->state.t) {
    return BAUM_OK;
  }
  BAUM_I_TRY(turn(run, t));
  return baum_i_run_has_fixed_step(run) ? advance_fixed(run, t, taken)
                                        : advance_variable(run, t, taken);
}

/* Data that a call stores at its beginning. */
typedef struct public_call {
  double start; /* [s] */
  baum_i_kept_message before;
  int64_t taken; /* number of steps */
} public_call;

static baum_status begin_call(baum_simulation *run, public_call *c)
{
  c->start = baum_i_wall_seconds();
  run->last_progress = c->start;
  run->deadline = c->start + run->time_limit;
  c->taken = 0;
  c->before = baum_i_message_keep();
  return baum_i_run_may_begin(run);
}

/* End a call: evaluate and monitor its last state, because no step has evaluated it. A call that
 * stops because its time limit has passed does not evaluate its last state, so that results do not
 * depend on the speed of the machine. */
static baum_status finish_call(baum_simulation *run, baum_status status, const public_call *c)
{
  const baum_i_state *state = &run->state;
  if (status == BAUM_STOP_TIME) {
    run->counters.wall += baum_i_wall_seconds() - c->start;
    return status;
  }
  baum_i_kept_message reason = baum_i_message_keep();
  if (status == BAUM_OK || status == BAUM_STOP_EVENT) {
    baum_i_run_recheck(run, state, true);
  }
  baum_status look = baum_i_violation(run->workspace, state->t, state->q, state->v);
  if (look == BAUM_OK) {
    baum_i_run_observe(run, state->t, false);
    baum_i_companion_output(run, state);
  }
  /* Also discard requests to cancel that user functions have made in this call. */
  atomic_store(&run->cancelled, 0);
  run->counters.wall += baum_i_wall_seconds() - c->start;
  if (status == BAUM_OK && look != BAUM_OK) {
    return baum_i_run_fail(run, look);
  }
  (void)baum_i_message_settle(BAUM_OK, status == BAUM_OK ? &c->before : &reason);
  return status == BAUM_OK ? baum_i_run_finish(run) : baum_i_run_fail(run, status);
}

static baum_status check_time(const baum_simulation *run, const char *call, double t)
{
  BAUM_I_TRY(baum_i_run_may_be_changed(run, call));
  return baum_i_check_finite(call, "t", "s", t);
}

/* ---- public ---- */

baum_status baum_simulation_advance_to(baum_simulation *simulation, double t)
{
  BAUM_I_TRY(check_time(simulation, "baum_simulation_advance_to", t));
  public_call c;
  baum_status status = begin_call(simulation, &c);
  status = status == BAUM_OK ? advance(simulation, t, &c.taken) : status;
  return finish_call(simulation, status, &c);
}

/* Take a step from the end of the last step. The method chooses the length. */
static baum_status own_step(baum_simulation *run)
{
  BAUM_I_TRY(pass_breaks(run));
  catch_up(run);
  BAUM_I_TRY(baum_i_run_choose_rows(run));
  BAUM_I_TRY(internal_step(run));
  return watch_last(run, INFINITY);
}

static baum_status one_step(baum_simulation *run)
{
  if (baum_i_run_has_fixed_step(run)) {
    const fixed_step next = find_next(run, 1);
    return take_next(run, 1, &next);
  }
  BAUM_I_TRY(watch_last(run, INFINITY));
  baum_status status = own_step(run);
  if (status != BAUM_STOP_EVENT) {
    catch_up(run);
  }
  return status;
}

static baum_status take_steps(baum_simulation *run, int64_t count)
{
  BAUM_I_TRY(turn(run, INFINITY));
  for (int64_t k = 0; k < count; k++) {
    BAUM_I_TRY(baum_i_run_may_go_on(run, k));
    BAUM_I_TRY(one_step(run));
  }
  return BAUM_OK;
}

baum_status baum_simulation_step(baum_simulation *simulation, int64_t count)
{
  BAUM_I_TRY(check_time(simulation, "baum_simulation_step", 0.0));
  if (count <= 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_simulation_step: count is %lld, must be > 0",
                       (long long)count);
  }
  public_call c;
  baum_status status = begin_call(simulation, &c);
  status = status == BAUM_OK ? take_steps(simulation, count) : status;
  return finish_call(simulation, status, &c);
}

/* ---- sampling ---- */

static baum_status check_times(const baum_simulation *run, const double *times, int64_t n)
{
  const char *call = "baum_simulation_sample";
  double direction = n > 0 && times[n - 1] < run->state.t ? -1.0 : 1.0;
  double last = run->state.t;
  for (int64_t k = 0; k < n; k++) {
    if (!isfinite(times[k]) || direction * (times[k] - last) < 0.0) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "%s: times[%lld] is %.9g s, and the time before it is %.9g s; times must "
                         "be finite and monotonic from the present time",
                         call, (long long)k, times[k], last);
    }
    last = times[k];
  }
  return BAUM_OK;
}

static baum_status check_sample(const baum_simulation *run, const double *times, int64_t n,
                                const baum_channel *channels, int32_t count, const double *rows)
{
  int width = 0;
  const char *call = "baum_simulation_sample";
  BAUM_I_TRY(baum_i_run_may_be_changed(run, call));
  if (n < 0 || (n > 0 && (!times || !rows))) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: times or rows are NULL, or n is negative", call);
  }
  BAUM_I_TRY(baum_i_check_channels(run->workspace->mechanism, channels, count, &width));
  return check_times(run, times, n);
}

/* Advance to a sample time: take whole steps, and then a trial step that ends at the sample. */
static baum_status advance_beside(baum_simulation *run, double t, int64_t *taken,
                                  const baum_i_state **at)
{
  *at = &run->state;
  if (t == run->state.t) {
    return BAUM_OK;
  }
  BAUM_I_TRY(turn(run, t));
  BAUM_I_TRY(steps_before(run, t, taken));
  if (stands_at(run, t)) {
    return BAUM_OK;
  }
  *at = &run->trial;
  BAUM_I_TRY(baum_i_run_try_step(run, t, false));
  return watch_step(run, t);
}

static baum_status sample_one(baum_simulation *run, double t, bool last, int64_t *taken,
                              const baum_i_state **at)
{
  *at = &run->state;
  bool beside = !last && baum_i_run_has_fixed_step(run);
  return beside ? advance_beside(run, t, taken, at) : advance(run, t, taken);
}

/* Fill the rows of output. *done counts the filled rows. */
static baum_status sample_all(baum_simulation *run, const double *times, int64_t n,
                              const baum_channel *channels, int count, double *rows, int64_t *done,
                              int64_t *taken)
{
  int width = 0;
  BAUM_I_TRY(baum_i_check_channels(run->workspace->mechanism, channels, count, &width));
  for (; *done < n; ++*done) {
    const baum_i_state *at = NULL;
    BAUM_I_TRY(baum_i_run_is_wanted(run));
    BAUM_I_TRY(*done > 0 ? baum_i_run_has_time(run) : BAUM_OK);
    BAUM_I_TRY(sample_one(run, times[*done], *done == n - 1, taken, &at));
    BAUM_I_TRY(baum_i_output(run, at, channels, count, rows + *done * width));
    baum_i_companion_output(run, at);
  }
  return BAUM_OK;
}

baum_status baum_simulation_sample(baum_simulation *simulation, const double *times, int64_t n,
                                   const baum_channel *channels, int32_t count, double *rows,
                                   int64_t *done)
{
  int64_t own = 0;
  done = done ? done : &own;
  *done = 0;
  BAUM_I_TRY(check_sample(simulation, times, n, channels, count, rows));
  public_call c;
  baum_status status = begin_call(simulation, &c);
  if (status == BAUM_OK) {
    status = sample_all(simulation, times, n, channels, count, rows, done, &c.taken);
  }
  return finish_call(simulation, status, &c);
}
