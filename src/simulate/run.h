/* SPDX-License-Identifier: BSD-3-Clause */
/* The internals of a run: present state, integrator, monitors, warnings. */
#ifndef BAUM_I_SIMULATE_RUN_H
#define BAUM_I_SIMULATE_RUN_H

#include <stdatomic.h>

#include "base/message.h"
#include "integrate/integrator.h"
#include "mechanism/fingerprint.h"
#include "stabilization/gains.h"

enum {
  BAUM_I_WARNINGS = 24, /* more than the number of kinds of warnings */
  BAUM_I_EXPLAIN_SIZE = 3072,
  BAUM_I_WORK = 5 /* number of counters of the work of solvers and methods; see monitor.c */
};

/* The time grid of a fixed-step method. A grid time is computed as origin + k times the step,
 * because a sum of k steps would accumulate rounding errors. */
typedef struct baum_i_grid {
  double origin;
  int64_t k;
} baum_i_grid;

/* A jump of an input; see schedule.c. */
typedef struct baum_i_jump {
  double t; /* [s] */
  double before;
  double after;
  int64_t input;
} baum_i_jump;

typedef struct baum_i_schedule {
  baum_i_jump *jumps; /* (room) the first `count` entries are used, in the order of time */
  int count;
  int room;
} baum_i_schedule;

typedef struct baum_i_account baum_i_account;
typedef struct baum_i_companion baum_i_companion;
typedef struct baum_i_crossings baum_i_crossings;
typedef struct baum_i_events baum_i_events;
typedef struct baum_i_saved baum_i_saved; /* saved.h */

struct baum_simulation {
  /* The members before `options` are plain numbers. They are part of a saved run. */
  baum_i_grid grid;
  /* [s] time of the last restart; the method may compute with t - origin instead of t */
  double origin;
  double start_energy;
  double largest_gamma; /* largest |gamma_i| (in J a = gamma) of all rows i and all steps */
  /* [s] time of the last check of the redundant rows without suitable pivots; see rows.c */
  double rows_looked_at;
  double judged_phi; /* max_phi when it was last compared with its limit */
  /* max_phi_rate when it was last compared with the limit for non-holonomic rows */
  double judged_phi_rate;
  int64_t near_singular_seen; /* workspace->near_singular at the last check */
  /* for each entry of `warnings`: number of occurrences that a status BAUM_WARNED has reported */
  int64_t announced[BAUM_I_WARNINGS];
  baum_counters counters;

  baum_simulation_options options;
  const baum_integrator *integrator;
  baum_workspace *workspace;
  baum_i_problem problem;
  void *self; /* memory of the integrator; may be NULL for a fixed-step method */

  /* (2 nc) copy of the option row_gains, followed by its products with row_gains of the mechanism;
   * NULL: the option is not given */
  double *row_gains;
  baum_i_account *account; /* energy account, see account.h; NULL: none */
  /* workspaces of the account [0] and the companion [1], or NULL; like run->workspace, they call
   * user functions */
  baum_workspace *beside[2];
  baum_i_events *events;       /* see events.h; NULL: no events */
  baum_i_companion *companion; /* see companion.h; NULL: no error estimate */

  baum_i_crossings *crossings; /* see crossing.h; NULL: crossings are not monitored */

  /* the run's own copy of the parameters of elements; NULL while it uses those of the mechanism */
  double *parameters;
  baum_i_schedule schedule; /* schedule of the inputs */
  double *memory;           /* memory of the arrays below */
  baum_i_state state;       /* present state, which is reported */
  baum_i_state ahead;       /* variable step: end of the last step of the method */
  /* end of a tried step, or a state that is only reported and is not part of the motion */
  baum_i_state trial;
  baum_i_state spare;   /* further state for steps near a singular configuration */
  double *acceleration; /* (nv) at the start of a step */

  baum_i_fingerprint fingerprint; /* fingerprint of the mechanism */
  /* numbers added to the counts of this process, so that the counters of a restored run continue
   * from the saved values; 0 if the run was not restored */
  int64_t work_before[BAUM_I_WORK];
  baum_warning warnings[BAUM_I_WARNINGS]; /* one entry for each kind of warning */
  char explain[BAUM_I_EXPLAIN_SIZE];
  char message[BAUM_I_MESSAGE_SIZE];
  baum_i_gain_choice gains;

  atomic_int cancelled;
  double last_progress; /* [s] */
  double time_limit;    /* [s] largest wall time of a call */
  double deadline;      /* [s] wall time at which the present call stops */
  bool reporting;       /* true while progress() runs */
  /* [s] time in the motion at which the lengths of the steps were last checked; see interrupt.c */
  double paced_at;
  bool has_functions; /* true if the mechanism has user functions whose derivatives are checked */
  int64_t rechecked;  /* counters.steps at the last check of derivatives; see recheck.c */
};

/* ---- run.c ---- */

/* Copy time, positions and velocities. In all states and knots of a run, v follows q in one
 * array. */
void baum_i_run_copy(const baum_simulation *run, const baum_i_state *from, baum_i_state *to);

/* Set the angles of joints and forces of spatial mechanisms in the workspace to their values at
 * `state`. Whole revolutions are added to each value such that the angle changes continuously.
 * Returns the result of baum_i_follow_angles(). */
double baum_i_run_follow_angles(baum_simulation *run, const baum_i_state *state);

/* Call baum_i_run_follow_angles() at the end of a step, unless all angles are still near to their
 * last values (baum_i_angles_are_near()). baum_i_run_follow_angles() takes longer than an
 * evaluation of the accelerations. */
void baum_i_run_follow_step(baum_simulation *run, const baum_i_state *end);

static inline bool baum_i_run_has_fixed_step(const baum_simulation *run)
{
  return baum_i_problem_has_fixed_step(&run->problem);
}

/* [s] The end of the last step. With a variable-step method it may be later than the reported
 * state. */
static inline double baum_i_run_last_end(const baum_simulation *run)
{
  return baum_i_run_has_fixed_step(run) ? run->state.t : run->ahead.t;
}

/* Copy the run's present direction, gains, inputs and driver laws to a problem with a separate
 * workspace. */
void baum_i_run_share_equations(const baum_simulation *run, baum_i_problem *own);

/* Create a workspace that uses the same solver and omits the same rows as the workspace of the run.
 * Returns the statuses of baum_i_workspace_create() and baum_i_use_blocks(). */
baum_status baum_i_run_make_workspace(const baum_simulation *run, baum_workspace **out);

enum { BAUM_I_NO_JOINT = -1 };

/* Add a warning with the time t. `joint` is the joint that the warning is about, or
 * BAUM_I_NO_JOINT. Later warnings of the same kind are only counted, and the text of the first one
 * is kept. */
void baum_i_run_warn(baum_simulation *run, baum_warning_code code, double t, int joint,
                     const char *format, ...) BAUM_I_PRINTF(5, 6);

/* Tell whether a warning of this kind means that the motion may be wrong. */
bool baum_i_doubts_motion(baum_warning_code code);

/* Tell whether the run has a warning of this kind. */
bool baum_i_run_has_warned(const baum_simulation *run, baum_warning_code code);

/* Return BAUM_OK, or BAUM_WARNED if there are warnings that no status has announced yet. */
baum_status baum_i_run_finish(baum_simulation *run);

/* Store the message of a failure in the run and return the status. */
baum_status baum_i_run_fail(baum_simulation *run, baum_status status);

/* Check the arguments of a public function that fills a struct of caller_size bytes from a run.
 * Returns BAUM_OK or BAUM_ERR_ARGUMENT. */
baum_status baum_i_run_check_out(const baum_simulation *run, const void *out, size_t caller_size,
                                 const char *call);

/* End a call. On success restore the earlier message of the thread. On failure store the message in
 * the run. */
baum_status baum_i_run_end_call(baum_simulation *run, baum_status status,
                                const baum_i_kept_message *before);

/* ---- start.c ---- */

/* Set the trial state to a given state, moved onto the constraints according to the option `start`.
 * The present state does not change. */
baum_status baum_i_run_start(baum_simulation *run, double t, const double *q, const double *v);

/* Check the velocities of the trial state. The omitted rows must already be known. If a projection
 * onto ill-conditioned rows would change the velocities too much, the function warns or returns
 * BAUM_ERR_INCONSISTENT. */
baum_status baum_i_run_check_velocities(baum_simulation *run);

/* Find the energy of the trial state. The workspace then contains Phi and Phi' of the trial
 * state. */
baum_status baum_i_run_measure(baum_simulation *run, double *energy);

/* Make the trial state, whose energy is known, the present state. A new time grid begins at its
 * time, and changes of energy are measured from its energy. */
void baum_i_run_accept(baum_simulation *run, double energy);

/* Do what baum_simulation_set_state() does. The number of revolutions of each angle is chosen such
 * that the angle is nearest to its value in the workspace. The workspace need not contain the
 * angles of the present state. */
baum_status baum_i_run_set_state(baum_simulation *run, double t, const double *q, const double *v);

/* ---- choose_gains.c, pilot.c ---- */

/* [1/s] Return the fastest angular rate of the trial state, whose accelerations must be in the
 * workspace. It is 0 if nothing moves and there is no gravity. */
double baum_i_run_start_rate(const baum_simulation *run);

/* [1/s] Return the rate below which velocities count as rounding errors. */
double baum_i_rest_rate(const baum_mechanism *m);

/* [1/s] Return the mean rate over a short pilot run from the trial state, whose accelerations must
 * be in the workspace. Overwrites run->ahead, run->state and the workspace. The lengths of the
 * pilot's steps are chosen for the larger one of two rates: the present rate of the motion, and
 * `swing` [1/s]. */
double baum_i_run_pilot(baum_simulation *run, double swing);

/* Choose the gains of the problem, and the step limit that they require. */
baum_status baum_i_run_choose_gains(baum_simulation *run);

/* ---- monitor.c ---- */

/* Monitor the state that the workspace evaluated last. t is the time of this state. The function
 * checks the violation of the state and whether the state is near-singular. If with_gamma is true,
 * it also updates largest_gamma. */
void baum_i_run_observe(baum_simulation *run, double t, bool with_gamma);

/* Warn if a force jumps in the step that ends at `end`. Call this just before the step is
 * accepted. */
void baum_i_run_observe_jumps(baum_simulation *run, const baum_i_state *end);

/* Accept the violation of the present state without a warning, because the user has given this
 * state. */
void baum_i_run_excuse_violation(baum_simulation *run);

/* Derivatives of user constraints that the user does not provide are computed by differences.
 * Return their relative error, or 0 if the user provides all derivatives. */
double baum_i_difference_noise(const baum_mechanism *mechanism);

/* Update the counters of evaluations, near-singular states and other work in run->counters. */
void baum_i_run_count(baum_simulation *run);

/* Let the counters of work continue from the present values of run->counters, which have just been
 * restored. */
void baum_i_run_count_from_here(baum_simulation *run);

/* ---- restart.c ---- */

/* Call this before the equations or the direction of the run change at the present state. The
 * account and the companion are brought to this state with the old equations. */
void baum_i_run_end_before_change(baum_simulation *run);

/* Restart at the present state after the equations have changed. With variable steps, the present
 * state may be before the end of the last step. Only methods with a history restart. If the restart
 * fails, the method restarts at its next step, from the same state. */
baum_status baum_i_run_restart(baum_simulation *run);

/* ---- interrupt.c ---- */

/* Check at the start of a call whether the run was cancelled before this call. The check before
 * every step does not suffice, because a call may be too short for a step. Returns BAUM_OK or
 * BAUM_STOP_CANCELLED. */
baum_status baum_i_run_may_begin(baum_simulation *run);

/* Check before every step whether the run must stop because it was cancelled, the time limit of the
 * call has passed, the call has taken too many steps, or the steps are too short. The run then
 * stays at the end of its last step, which is in `ahead` for a variable-step method. */
baum_status baum_i_run_may_go_on(baum_simulation *run, int64_t taken);

/* Check whether the time limit of the present call has passed. The caller skips this check before
 * the first step or sample of a call. Returns BAUM_OK or BAUM_STOP_TIME. */
baum_status baum_i_run_has_time(const baum_simulation *run);

/* Check before every sample whether the run was cancelled. This check is separate from
 * baum_i_run_may_go_on(), because a sample may not need a step. Returns BAUM_OK or
 * BAUM_STOP_CANCELLED. */
baum_status baum_i_run_is_wanted(baum_simulation *run);

/* Refuse calls from inside a callback of the run (BAUM_ERR_STATE) and a NULL run
 * (BAUM_ERR_ARGUMENT). The callback progress() may read the run, but may not change it. */
baum_status baum_i_run_may_be_read(const baum_simulation *run, const char *call);
baum_status baum_i_run_may_be_changed(const baum_simulation *run, const char *call);

/* ---- one_step.c ---- */

/* Fixed step: set the trial state to the end of a step from the present state to t_next. */
baum_status baum_i_run_try_step(baum_simulation *run, double t_next, bool observe);

/* Variable step: set the trial state to the end of a step from `ahead`. The method chooses the
 * length of the step. */
baum_status baum_i_run_try_own_step(baum_simulation *run);

/* Variable step: set the trial state to the interpolated state at t inside the last step, and
 * project it if the formulation includes projection. */
baum_status baum_i_run_inside(baum_simulation *run, double t);

/* ---- inputs.c ---- */

/* Give the run its own copy of the parameters. Before this call, the run uses the parameters of the
 * mechanism. Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_run_own_parameters(baum_simulation *run);

/* ---- schedule.c ---- */

/* Set all inputs that jump between the times `from` and `to` to their values at `to`. `to` may be
 * earlier than `from`. */
void baum_i_schedule_move(baum_simulation *run, double from, double to);

/* End the schedule of an input. The input keeps its value. */
void baum_i_schedule_end(baum_simulation *run, int64_t input);

/* Allocate memory for `count` jumps. Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_schedule_reserve(baum_i_schedule *schedule, int count);

/* Tell whether `bytes` contains `count` valid jumps of a run with input_count inputs. The address
 * may have any alignment. */
bool baum_i_schedule_is_sound(const void *bytes, int64_t count, int64_t input_count);

/* ---- breaks.c ---- */

/* A break is a time at which functions of the mechanism or inputs may jump. These are its two
 * sides, in the order in which the run reaches them. */
typedef struct baum_i_break {
  double near; /* [s] time at which a step ends */
  double far;  /* [s] time at which the next step begins */
} baum_i_break;

/* Return the next break after the last step in the direction of the run. Both times are infinite if
 * there is none. */
baum_i_break baum_i_run_find_break(const baum_simulation *run);

/* Do what baum_i_run_find_break() does, but return at once if there are no breaks at all, as in
 * most runs. */
static inline baum_i_break baum_i_run_next_break(const baum_simulation *run)
{
  if (run->workspace->mechanism->break_count == 0 && run->schedule.count == 0) {
    double never = run->problem.direction * (double)INFINITY;
    return (baum_i_break){never, never};
  }
  return baum_i_run_find_break(run);
}

/* Tell whether the last step ends at the near side of the break. */
bool baum_i_run_is_at(const baum_simulation *run, baum_i_break next);

/* restart.c: move the present time from the near side of a break to its far side. Methods with a
 * history restart at the far side, and a new time grid begins there. Returns the statuses of
 * baum_i_run_restart(). */
baum_status baum_i_run_pass(baum_simulation *run, baum_i_break next);

/* ---- rows.c ---- */

/* Check the omitted redundant rows at the present state, where the next step begins. If the active
 * rows have become ill-conditioned, omit other rows. A method that cannot keep its history then
 * restarts. Returns the statuses of baum_i_run_restart(). Does nothing for kinematics, which
 * chooses rows itself. */
baum_status baum_i_run_choose_rows(baum_simulation *run);

/* Choose the omitted rows for a given state. If the run is crossing a singular configuration, this
 * crossing ends. The caller must restart the method afterwards. */
void baum_i_run_restart_rows(baum_simulation *run, const baum_i_state *state);

/* Omit the rows i for which omitted[i] is not 0 (nc entries). Returns the statuses of
 * baum_i_omit_rows(); on failure nothing changes. */
baum_status baum_i_run_omit_rows(baum_simulation *run, const unsigned char *omitted);

/* ---- singular_step.c ---- */

/* If the configuration at the start of a step is singular, replace run->acceleration by its limit
 * along the motion (integrate/limit.h). Overwrites the trial state. Evaluates the present state
 * again afterwards, and returns the status of this evaluation. */
baum_status baum_i_run_limit_acceleration(baum_simulation *run);

/* Project the trial state, the end of a step, onto the constraints at t. The projection is skipped
 * near a singular configuration, where its rounding errors would be larger than the error of the
 * step. Returns the statuses of baum_i_project(). */
baum_status baum_i_run_project(baum_simulation *run, double t);

/* ---- recheck.c ---- */

/* Check the derivatives of user functions at a state. If a derivative is wrong, set the message,
 * set *joint as baum_i_check_at() does, and return true. Overwrites the workspace and
 * run->spare. */
bool baum_i_run_find_wrong_derivative(baum_simulation *run, const baum_i_state *at, int *joint);

/* Call this after every step and at the end of a call. If a check of the derivatives is due, check
 * them, and warn if one is wrong. */
void baum_i_run_recheck(baum_simulation *run, const baum_i_state *at, bool ends_call);

/* ---- failure.c ---- */

/* Complete the message of a failed step: name the joint and the body that are probably the cause,
 * as found at the last good state `at`, and add advice. Returns the status. */
baum_status baum_i_run_explain_failure(baum_simulation *run, baum_status status,
                                       const baum_i_state *at);

/* ---- output.c ---- */

/* Check channels and find their total width. Returns BAUM_OK, BAUM_ERR_ARGUMENT or
 * BAUM_ERR_STRUCT. */
baum_status baum_i_check_channels(const baum_mechanism *mechanism, const baum_channel *channels,
                                  int count, int *width);

/* Return channel k of a caller's array. The caller may have been compiled with an older version of
 * the struct. */
baum_channel baum_i_channel(const baum_channel *channels, int k);

/* Append a description such as `pose of body 3 "slider" at (0.1, 0) m` to a text. The channel must
 * have been checked. */
void baum_i_append_channel(const baum_mechanism *mechanism, const baum_channel *channel, char *text,
                           size_t size);

/* Evaluate checked channels at any state. The motion of the run does not change. */
baum_status baum_i_output(baum_simulation *run, const baum_i_state *state,
                          const baum_channel *channels, int count, double *row);

/* ---- explain.c ---- */

void baum_i_run_explain(baum_simulation *run);

#endif
