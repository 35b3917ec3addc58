/* SPDX-License-Identifier: BSD-3-Clause */
/* The internals of a run: present state, integrator, monitors, warnings. */
#ifndef BAUM_I_SIMULATE_RUN_H
#define BAUM_I_SIMULATE_RUN_H

#include <stdatomic.h>
#include <time.h>

#include "base/message.h"
#include "integrate/integrator.h"
#include "mechanism/fingerprint.h"
#include "stabilization/gains.h"

enum {
  BAUM_I_WARNINGS = 24, /* more than there are kinds */
  BAUM_I_EXPLAIN_SIZE = 3072,
  BAUM_I_WORK = 5 /* counts that solvers and methods keep themselves, see monitor.c */
};

/* Times of a fixed-step method: origin + k step, never sums. */
typedef struct baum_i_grid {
  double origin;
  int64_t k;
} baum_i_grid;

/* An input jumps at a time; see schedule.c. */
typedef struct baum_i_jump {
  double t; /* [s] */
  double before;
  double after;
  int64_t input;
} baum_i_jump;

typedef struct baum_i_schedule {
  baum_i_jump *jumps; /* (room), rising in time */
  int count;
  int room;
} baum_i_schedule;

typedef struct baum_i_account baum_i_account;
typedef struct baum_i_companion baum_i_companion;
typedef struct baum_i_crossings baum_i_crossings;
typedef struct baum_i_events baum_i_events;
typedef struct baum_i_saved baum_i_saved; /* saved.h */

struct baum_simulation {
  /* Plain numbers up to `options`, which are saved. */
  baum_i_grid grid;
  double origin; /* [s] where the method restarted; it may count its times from there */
  double start_energy;
  double largest_gamma;       /* over all rows and steps */
  double rows_looked_at;      /* [s] last check of the redundant rows with KLU or QR; see rows.c */
  double judged_phi;          /* max_phi at the last judgement */
  int64_t near_singular_seen; /* workspace->near_singular at the last check */
  int64_t announced[BAUM_I_WARNINGS]; /* occurrences of each warning that a status has announced */
  baum_counters counters;

  baum_simulation_options options;
  const baum_integrator *integrator;
  baum_workspace *workspace;
  baum_i_problem problem;
  void *self; /* of the integrator; may be NULL for a fixed-step one */

  double *row_gains;       /* (nc) own copy of the option, or NULL */
  baum_i_account *account; /* energy account, see account.h; NULL: none */
  baum_workspace
    *beside[2]; /* of account and companion, which ask functions of the user too; NULL without */
  baum_i_events *events;       /* see events.h; NULL: no events */
  baum_i_companion *companion; /* see companion.h; NULL: no error estimate */

  baum_i_crossings *crossings; /* through singular configurations, see crossing.h; NULL: not looked
                                 for */

  double *parameters;       /* own copy of the mechanism's once a driver is set, else NULL */
  baum_i_schedule schedule; /* of inputs */
  double *memory;           /* all arrays below */
  baum_i_state state;       /* reported */
  baum_i_state ahead;       /* variable step: end of the last internal step */
  baum_i_state trial;       /* a step under way, or a sample beside the motion */
  baum_i_state spare;       /* of a step near a singular configuration */
  double *acceleration;     /* (nv) at the start of a step */

  baum_i_fingerprint fingerprint; /* of the mechanism */
  /* work that other processes have done for the run, minus the counts of this process before it */
  int64_t work_before[BAUM_I_WORK];
  baum_warning warnings[BAUM_I_WARNINGS]; /* one of each kind */
  char explain[BAUM_I_EXPLAIN_SIZE];
  char message[BAUM_I_MESSAGE_SIZE];
  baum_i_gain_choice gains;

  atomic_int cancelled;
  struct timespec last_progress;
  bool reporting;  /* within progress() */
  double paced_at; /* [s] of a call: where its pace has last been looked at */
};

/* ---- run.c ---- */

/* Copy time, positions and velocities. */
void baum_i_run_copy(const baum_simulation *run, const baum_i_state *from, baum_i_state *to);

/* Count the revolutions of joints in space: angles go on from those that the workspace has of the
 * time `from` to those at a state. */
void baum_i_run_follow_angles(baum_simulation *run, double from, const baum_i_state *state);

static inline bool baum_i_run_has_fixed_step(const baum_simulation *run)
{
  return baum_i_problem_has_fixed_step(&run->problem);
}

/* [s] Time at which the last step ended; a variable-step method is ahead of the reported state. */
static inline double baum_i_run_last_end(const baum_simulation *run)
{
  return baum_i_run_has_fixed_step(run) ? run->state.t : run->ahead.t;
}

/* Give a problem with a workspace of its own the run's present equations: direction, gains, inputs,
 * laws of drivers. */
void baum_i_run_share_equations(const baum_simulation *run, baum_i_problem *own);

/* Create a workspace with the solver and the omitted rows of the run. BAUM_OK, BAUM_ERR_MEMORY. */
baum_status baum_i_run_make_workspace(const baum_simulation *run, baum_workspace **out);

enum { BAUM_I_NO_JOINT = -1 };

/* Warn at time t; joint is the one concerned, or BAUM_I_NO_JOINT. Later warnings of the same kind
 * are only counted; the text of the first one stays. */
void baum_i_run_warn(baum_simulation *run, baum_warning_code code, double t, int joint,
                     const char *format, ...) BAUM_I_PRINTF(5, 6);

/* Does a warning of this kind mean that the motion may be wrong? */
bool baum_i_doubts_motion(baum_warning_code code);

/* Does the run have a warning of this kind? */
bool baum_i_run_has_warned(const baum_simulation *run, baum_warning_code code);

/* BAUM_OK, or BAUM_WARNED if there are warnings that no status has announced yet. */
baum_status baum_i_run_finish(baum_simulation *run);

/* Keep the message of a failure in the run and return its status. */
baum_status baum_i_run_fail(baum_simulation *run, baum_status status);

/* Check the arguments of a call that fills a sized struct from a run. BAUM_OK or
 * BAUM_ERR_ARGUMENT. */
baum_status baum_i_run_check_out(const baum_simulation *run, const void *out, size_t caller_size,
                                 const char *call);

/* End a call: on success the thread has its message from before again, on failure the run keeps the
 * message. */
baum_status baum_i_run_end_call(baum_simulation *run, baum_status status,
                                const baum_i_kept_message *before);

/* ---- start.c ---- */

/* Set the trial state to a state that is moved onto the constraints as the option `start` says. The
 * present state stays. */
baum_status baum_i_run_start(baum_simulation *run, double t, const double *q, const double *v);

/* Check the velocities of the trial state once the omitted rows are known: BAUM_ERR_INCONSISTENT,
 * or a warning, if ill-conditioned rows would change the velocities much. */
baum_status baum_i_run_check_velocities(baum_simulation *run);

/* Find the energy of the trial state. Phi and Phi' there stay in the workspace. */
baum_status baum_i_run_measure(baum_simulation *run, double *energy);

/* Make the trial state, whose energy is known, the present state. Grid and energy restart. */
void baum_i_run_accept(baum_simulation *run, double energy);

/* ---- choose_gains.c, pilot.c ---- */

/* [1/s] Fastest angular rate of the trial state, whose accelerations are in the workspace; 0 if
 * nothing moves and gravity would not move it either. */
double baum_i_run_start_rate(const baum_simulation *run);

/* [1/s] Rate below which velocities are rounding errors. */
double baum_i_rest_rate(const baum_mechanism *m);

/* [1/s] Mean rate over a short pilot run from the trial state, whose accelerations are in the
 * workspace. Overwrites run->ahead, run->state and the workspace. swing: [1/s] least rate for which
 * steps are chosen. */
double baum_i_run_pilot(baum_simulation *run, double swing);

/* Choose the gains, and the step limit that they need, for the problem. */
baum_status baum_i_run_choose_gains(baum_simulation *run);

/* ---- monitor.c ---- */

/* Monitor the violation, gamma and near-singular configurations from the last velocity stage of the
 * workspace, which was at time t. */
void baum_i_run_observe(baum_simulation *run, double t, bool with_gamma);

/* Accept the violation of the present state as given by the user; it does not doubt the motion. */
void baum_i_run_excuse_violation(baum_simulation *run);

/* Relative error of the derivatives that user constraints do not provide; 0: they provide all. */
double baum_i_difference_noise(const baum_mechanism *mechanism);

/* Bring the counters of work up to date. */
void baum_i_run_count(baum_simulation *run);

/* Continue counting from what has been written into run->counters. */
void baum_i_run_count_from_here(baum_simulation *run);

/* ---- restart.c ---- */

/* Prepare for a change of what acts on the mechanism, at the present state. */
void baum_i_run_end_before_change(baum_simulation *run);

/* Restart after a change of the equations at the present state, which may be before the end of the
 * last step. Methods with a history restart there. If the restart fails, the method restarts at its
 * next step, from the same state. */
baum_status baum_i_run_restart(baum_simulation *run);

/* ---- interrupt.c ---- */

/* Check before every step: cancelled, too many steps in this call, or no progress? A run that stops
 * here stands where its last step ended; a variable-step method keeps that state in `ahead`. */
baum_status baum_i_run_may_go_on(baum_simulation *run, int64_t taken);

/* Check before every sample, which may need no step: BAUM_OK, or BAUM_STOP_CANCELLED. */
baum_status baum_i_run_is_wanted(baum_simulation *run);

/* Refuse calls from inside a callback of the run (BAUM_ERR_STATE) and a NULL run
 * (BAUM_ERR_ARGUMENT). progress() may read the run. */
baum_status baum_i_run_may_be_read(const baum_simulation *run, const char *call);
baum_status baum_i_run_may_be_changed(const baum_simulation *run, const char *call);

/* [s] of wall time. */
double baum_i_seconds_since(const struct timespec *then);

/* ---- one_step.c ---- */

/* Fixed step: try a step from the present state to t_next, on the trial state. */
baum_status baum_i_run_try_step(baum_simulation *run, double t_next, bool observe);

/* Variable step: try a step of the method's own length from `ahead`, on the trial state. */
baum_status baum_i_run_try_own_step(baum_simulation *run);

/* Variable step: interpolate inside the last step into the trial state, projected if the
 * formulation includes it. */
baum_status baum_i_run_inside(baum_simulation *run, double t);

/* ---- inputs.c ---- */

/* Give the run its own copy of the parameters, which belong to the mechanism otherwise. BAUM_OK or
 * BAUM_ERR_MEMORY. */
baum_status baum_i_run_own_parameters(baum_simulation *run);

/* ---- schedule.c ---- */

/* Set inputs that jump between two times to their values at the second time, which may be
 * earlier. */
void baum_i_schedule_move(baum_simulation *run, double from, double to);

/* End the schedule of an input, which keeps its value. */
void baum_i_schedule_end(baum_simulation *run, int64_t input);

/* Reserve room for `count` jumps. BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_schedule_reserve(baum_i_schedule *schedule, int count);

/* Copy into an empty schedule. BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_schedule_copy(const baum_i_schedule *from, baum_i_schedule *to);

/* Are these bytes, of any alignment, `count` valid jumps of a run with input_count inputs? */
bool baum_i_schedule_is_sound(const void *bytes, int64_t count, int64_t input_count);

/* ---- breaks.c ---- */

/* The two sides of a break, in the order in which the run meets them. */
typedef struct baum_i_break {
  double near; /* [s] where steps end */
  double far;  /* where the next begins */
} baum_i_break;

/* The next break after the last step, in the direction of the run; both sides are infinite if there
 * is none. */
baum_i_break baum_i_run_next_break(const baum_simulation *run);

/* Does the last step end at the near side of the break? */
bool baum_i_run_is_at(const baum_simulation *run, baum_i_break next);

/* restart.c: go from the present state, which is at the near side, to the far one: methods with a
 * history restart, and so does the grid. Statuses of baum_i_run_restart(). */
baum_status baum_i_run_pass(baum_simulation *run, baum_i_break next);

/* ---- rows.c ---- */

/* Check the omitted redundant rows at the present state, where the next step begins, and choose
 * others if the active rows have become ill-conditioned; then methods restart. Statuses of
 * baum_i_run_restart(). Does nothing for kinematics. */
baum_status baum_i_run_choose_rows(baum_simulation *run);

/* Choose the omitted rows for a given state, after which everything restarts anyway. */
void baum_i_run_choose_rows_anew(baum_simulation *run, const baum_i_state *state);

/* Omit these rows (nc). Statuses of baum_i_omit_rows(); on failure nothing changes. */
baum_status baum_i_run_omit_rows(baum_simulation *run, const unsigned char *omitted);

/* ---- singular_step.c ---- */

/* Replace run->acceleration at the start of a step by its limit if the configuration is singular.
 * Uses the trial state. Statuses of an evaluation at the present state, which is repeated. */
baum_status baum_i_run_limit_acceleration(baum_simulation *run);

/* Project the trial state, the end of a step, onto the constraints at t. The projection is skipped
 * near a singularity, where rounding would exceed the error of the step. Statuses of
 * baum_i_project(). */
baum_status baum_i_run_project(baum_simulation *run, double t);

/* ---- failure.c ---- */

/* Add to the message of a failed step which joint and body to look at, at the last good state, and
 * what may help. Returns the status. */
baum_status baum_i_run_explain_failure(baum_simulation *run, baum_status status,
                                       const baum_i_state *at);

/* ---- output.c ---- */

/* Check channels and find their total width: BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT. */
baum_status baum_i_check_channels(const baum_mechanism *mechanism, const baum_channel *channels,
                                  int count, int *width);

/* Channel k of an array of a caller, whose struct may be of an older version. */
baum_channel baum_i_channel(const baum_channel *channels, int k);

/* `pose of body 3 "slider" at (0.1, 0) m` behind a text. The channel is checked. */
void baum_i_append_channel(const baum_mechanism *mechanism, const baum_channel *channel, char *text,
                           size_t size);

/* Evaluate checked channels at any state. The run does not change. */
baum_status baum_i_output(baum_simulation *run, const baum_i_state *state,
                          const baum_channel *channels, int count, double *row);

/* ---- explain.c ---- */

void baum_i_run_explain(baum_simulation *run);

#endif
