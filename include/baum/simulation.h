/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  One run of a frozen mechanism: how constraints are kept, which method integrates, what comes
 *  out.
 *
 *  Threads: one simulation is used by one thread at a time, but for baum_simulation_cancel(), which
 *  may be called from any thread or signal handler. Simulations may share a mechanism.
 *  Failure: a run that fails keeps its last good step; time, q and v stay readable.
 */
#ifndef BAUM_SIMULATION_H
#define BAUM_SIMULATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/mechanism.h>
#include <baum/stabilization.h>

#ifdef __cplusplus
extern "C" {
#endif

/** One run. */
typedef struct baum_simulation baum_simulation;

/* ---- integrators ----------------------------------------------------------------------------- */

/** Explicit Euler, order 1, fixed step. BAUMGARTE (dead-beat), UNSTABILIZED, PROJECTION. */
BAUM_API const baum_integrator *baum_euler(void);
/** Semi-implicit (symplectic) Euler, order 1, fixed step: velocities first. Formulations as
 *  baum_euler(). */
BAUM_API const baum_integrator *baum_semi_implicit_euler(void);
/** Explicit midpoint rule, order 2, fixed step. PROJECTION, BAUMGARTE (auto), UNSTABILIZED. */
BAUM_API const baum_integrator *baum_rk2(void);
/** Kutta's third-order method, fixed step. Formulations as baum_rk2(). */
BAUM_API const baum_integrator *baum_rk3(void);
/** The classical fourth-order Runge-Kutta method, fixed step. Formulations as baum_rk2(). */
BAUM_API const baum_integrator *baum_rk4(void);
/** Dormand and Prince's pair of orders 5 and 4, explicit: rtol, or step for steps of one length.
 *  Six evaluations a step. PROJECTION, BAUMGARTE (auto), UNSTABILIZED. For loose tolerances. */
BAUM_API const baum_integrator *baum_dp5(void);
/** DOP853, explicit, order 8 with estimates of orders 5 and 3 (Hairer, Norsett, Wanner 1993): rtol,
 *  or step for steps of one length. Twelve evaluations a step, three more where one is looked into
 *  between its ends. Formulations as baum_dp5(). The first choice where forces are not stiff and
 *  rtol is 1e-5 or less. */
BAUM_API const baum_integrator *baum_rk8(void);
/** Adams-Bashforth of two steps, order 2, fixed step: one evaluation a step. BAUMGARTE (best
 *  damping), UNSTABILIZED; its past cannot be projected. Begins with Runge-Kutta steps, also after
 *  baum_simulation_set_state(), _set_input() and _set_driver(), a turn in time and a target off the
 *  grid. */
BAUM_API const baum_integrator *baum_ab2(void);
/** Adams-Bashforth of three steps, order 3. Otherwise as baum_ab2(). */
BAUM_API const baum_integrator *baum_ab3(void);
/** Adams-Bashforth of four steps, order 4. Otherwise as baum_ab2(). */
BAUM_API const baum_integrator *baum_ab4(void);
/** RATTLE, order 2, fixed step, symplectic: for long runs without dissipation, whose energy stays
 *  in a band of width O(h^2) however long. INDEX3: Phi = 0 and Phi' = 0 hold to rounding after
 *  every step. For constant masses and forces of time, position and inputs; masses that vary and
 *  forces that depend on velocities, as dampers do, are refused. Functions of the user are asked at
 *  some states. */
BAUM_API const baum_integrator *baum_rattle(void);
/** Generalized-alpha with spectral radius 0.8, order 2, fixed step, implicit: for stiff forces, and
 *  to compare with at index 3. INDEX3: Phi = 0 to rounding after every step, Phi' of second
 *  order. */
BAUM_API const baum_integrator *baum_generalized_alpha(void);
/** SUNDIALS CVODE, Adams-Moulton, rtol. BAUMGARTE (auto), UNSTABILIZED; CVODE projects only within
 *  BDF. Iterates by fixed point, and with gains by Newton on what these make stiff, so that high
 *  gains do not bind the steps; stiff forces do. */
BAUM_API const baum_integrator *baum_cvode_adams(void);
/** SUNDIALS CVODE, BDF, rtol: for stiff forces. PROJECTION, BAUMGARTE (auto), UNSTABILIZED. Newton
 *  iteration on the true Jacobian, which is sparse and has the derivatives of all joints and
 *  forces; PROJECTION is made inside of each step, before its error is judged. */
BAUM_API const baum_integrator *baum_cvode_bdf(void);
/** SUNDIALS IDA, variable-order BDF on y = (q, v, lambda), rtol. GGL, BAUMGARTE (auto),
 *  UNSTABILIZED, INDEX2, and INDEX3, which is there for comparison: its error is far above its
 *  tolerance. */
BAUM_API const baum_integrator *baum_ida(void);
/** Kinematics: for mechanisms without degrees of freedom, whose drivers take it all, so that every
 *  coordinate follows from Phi(q, t) = 0; others are refused. Nothing is integrated: poses are
 *  solved to rounding at the times asked for, by continuation along the branch of the start pose.
 *  Takes no formulation, gains, step, rtol or atol. A run that cannot go on, because the mechanism
 *  locks up or branches cross, stops with BAUM_ERR_SINGULAR; it never jumps to another branch. */
BAUM_API const baum_integrator *baum_kinematics(void);

/** All integrators by number, for bindings and tables; linking this links every backend.
 *  @param k  0, 1, ...
 *  @return   NULL past the end
 */
BAUM_API const baum_integrator *baum_integrator_at(int32_t k);

/** Name of an integrator such as "cvode_adams"; NULL for NULL. */
BAUM_API const char *baum_integrator_name(const baum_integrator *integrator);
/** Order of accuracy of a fixed-step integrator, 0 for variable order or NULL. */
BAUM_API int32_t baum_integrator_order(const baum_integrator *integrator);
/** Whether the integrator takes `step`. NULL gives false. */
BAUM_API bool baum_integrator_has_fixed_step(const baum_integrator *integrator);
/** Whether the integrator takes `rtol`; one that takes both is given one of them, and
 *  baum_kinematics() takes neither. NULL gives false. */
BAUM_API bool baum_integrator_has_variable_step(const baum_integrator *integrator);

/** Form of the equations of motion; h is the step. */
typedef enum baum_formulation {
  BAUM_FORMULATION_DEFAULT = 0,      /**< The first in the integrator's list. */
  BAUM_FORMULATION_UNSTABILIZED = 1, /**< (5): J a = gamma; the violation drifts. */
  BAUM_FORMULATION_BAUMGARTE = 2,    /**< (7): J a = gamma - 2 alpha Phi' - beta^2 Phi. */
  BAUM_FORMULATION_PROJECTION = 3,   /**< (5), then q and v projected after each step. */
  BAUM_FORMULATION_INDEX2 = 4,       /**< J v = nu; Phi drifts slowly. */
  BAUM_FORMULATION_GGL = 5,          /**< J v = nu and Phi = 0 (Gear, Gupta, Leimkuhler 1985). */
  BAUM_FORMULATION_INDEX3 = 6        /**< Phi = 0. */
} baum_formulation;

/** Name of a formulation such as "baumgarte"; NULL for an unknown value. */
BAUM_API const char *baum_formulation_name(baum_formulation formulation);

/** Whether an integrator offers a formulation. NULL gives false. */
BAUM_API bool baum_integrator_offers(const baum_integrator *integrator,
                                     baum_formulation formulation);

/** What to do with the design configuration. */
typedef enum baum_start {
  BAUM_START_ASSEMBLE = 0, /**< Assemble; refuse moves above a quarter of the scale, or 1 rad. */
  BAUM_START_EXACT =
    1, /**< Refuse a configuration or velocities that do not fulfil the constraints. */
  BAUM_START_AS_GIVEN = 2 /**< Take them as they are, free velocities zero; but bodies that
                                welds hold to ground are where the welds have them. */
} baum_start;

/** Which solver of the equations (7) is used. baum_simulation_explain() tells which it is, and why.
 *  Assembly and the multipliers of redundant rows are found by KLU and QR in any case. */
typedef enum baum_solver {
  BAUM_SOLVER_AUTO = 0, /**< BLOCK where it suits; KLU and QR where that cannot be trusted. */
  BAUM_SOLVER_KLU = 1,  /**< Sparse LU of the whole system, refactored on a fixed pattern. */
  BAUM_SOLVER_QR =
    2, /**< Sparse rank-revealing QR; slow, for comparison and singular configurations. */
  BAUM_SOLVER_BLOCK = 3 /**< Schur complement in blocks of two rows, never anything else: refused
                             for mechanisms that it does not suit (a body with more than about 50
                             joints, a dense net, a mass matrix that is not positive definite);
                             BAUM_ERR_SINGULAR close to singular configurations. */
} baum_solver;

/** Called now and then during a call that advances a run; each call restarts the interval. It
 *  may read the run, with baum_simulation_get() and such, too; what changes, advances or saves it
 *  fails (BAUM_ERR_STATE), and it cannot be destroyed.
 *  @return non-zero to cancel */
typedef int baum_progress_fn(const baum_simulation *simulation, double t, void *user);

/* ---- options --------------------------------------------------------------------------------- */

/** How to run. Start from baum_simulation_options_default(); a struct of an older version is taken
 *  as definitions are, see mechanism.h. Variable-step integrators may step over a force or a law
 *  that begins late or does not last: give max_step then. */
typedef struct baum_simulation_options {
  size_t struct_size;                /**< Set by the default. Do not write. */
  const baum_integrator *integrator; /**< Default: NULL, must be set. */
  baum_formulation formulation;      /**< Default: BAUM_FORMULATION_DEFAULT. */
  baum_gains gains;                  /**< Only for BAUMGARTE. Default: BAUM_GAINS_DEFAULT. */
  bool allow_unstable; /**< Run with gains that are known to be unstable. Default: false. */
  double step;         /**< [s] > 0, fixed-step integrators. Default: NaN, not given. */
  double rtol;     /**< [-] > 0, < 1, relative to the scales of q and v, for the error of a step.
                        Of it, and of atol, cvode_bdf takes 1/6.9 and ida 1/3 (all from 1e-13
                        on), so that runs at one rtol are about as exact by any method.
                        Default: NaN, not given. */
  double atol;     /**< [unit of the coordinate] >= 0, added. Default: NaN, none. */
  double max_step; /**< [s] > 0, longest step of a variable-step integrator. Default: NaN, none. */
  double start_time;          /**< [s] Default: 0. */
  baum_start start;           /**< Default: BAUM_START_ASSEMBLE. */
  baum_solver solver;         /**< Default: BAUM_SOLVER_AUTO. */
  bool check_derivatives;     /**< Compare user derivatives with differences. Default: true. */
  int64_t max_steps;          /**< [-] > 0, of one call before it fails. Default: 1000000000. */
  baum_progress_fn *progress; /**< Default: NULL, none. */
  double progress_interval;   /**< [s] of wall time, >= 0. Default: 0.05. */
  void *user;                 /**< Passed to progress, not owned. Default: NULL. */
  double tolerance_q;         /**< [-] > 0, finite, factor on rtol and atol for positions; refused
                                with a fixed step. Default: 1. */
  double tolerance_v;         /**< [-] > 0, likewise for velocities. Default: 1. */
  double tolerance_lambda;    /**< [-] > 0, factor on rtol for multipliers; finite only for IDA with
                                BAUMGARTE or UNSTABILIZED. Row i with displacement n_i (the norm
                                of its J times the scales) has tolerance_lambda rtol E / n_i, where
                                E is the largest present |lambda_k| n_k, or, where that is
                                larger, M_jj s_j^2 times the square of the rate which explain
                                tells. Default: infinity, they are not tested. */
  bool energy_account; /**< Keep the works of baum_simulation_energy_account(). Not for kinematics.
                            Default: false. */
  const double *row_gains; /**< [-] (row_gain_count) > 0, factors f on the gains of each row: alpha
                               f_i, beta f_i. Copied. Default: NULL, all 1. */
  int32_t row_gain_count;  /**< [-] nc of the mechanism where row_gains are given. Default: 0. */
  bool error_check; /**< Estimate the error of the motion by a second integration from the start on,
                         see counters.error_estimate, and warn where it is large. Beside a fixed
                         step that is rk8 at 1e-8, beside a variable one the same method at 0.03
                         rtol, which doubles the cost or more. Without this option fixed steps are
                         checked as soon as their error may matter. Default: false. */
} baum_simulation_options;

/** Set the default options; writes at most caller_size bytes.
 *  @param[out] options      NULL is ignored
 *  @param      caller_size  sizeof *options
 */
BAUM_API void baum_simulation_options_init(baum_simulation_options *options, size_t caller_size);

/** The default options. */
static inline baum_simulation_options baum_simulation_options_default(void)
{
  baum_simulation_options options;
  baum_simulation_options_init(&options, sizeof options);
  return options;
}

/* ---- a run ----------------------------------------------------------------------------------- */

/** Start a run: assemble, choose gains, check them, and set up the integrator.
 *  @param[in]  mechanism  frozen; kept alive by the simulation
 *  @param[in]  options    copied
 *  @param[out] out        receives the run, NULL on failure; release with baum_simulation_destroy()
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE (not frozen),
 *              BAUM_ERR_UNSUPPORTED (the pair of integrator and formulation, the build, kinematics
 *              where freedom is left or with an energy account, gains that the method has no point
 *              for, RATTLE with what it is not for, or blocks where they do not suit),
 *              BAUM_ERR_INCONSISTENT, BAUM_ERR_SINGULAR, BAUM_ERR_UNSTABLE, BAUM_ERR_MEMORY,
 *              BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE, BAUM_ERR_CONVERGENCE, BAUM_ERR_INTEGRATOR
 */
BAUM_API baum_status baum_simulation_create(const baum_mechanism *mechanism,
                                            const baum_simulation_options *options,
                                            baum_simulation **out);

/** End a run.
 *  @param simulation  may be NULL
 */
BAUM_API void baum_simulation_destroy(baum_simulation *simulation);

/** Advance to time t, forward or backward; t equal to the present time does nothing. A fixed-step
 *  method takes whole steps from where it stands and, when t is off its grid, one shorter step at
 *  the end, which is counted and starts a new grid. A variable-step method passes t and
 *  interpolates, so that targets never alter its steps.
 *  @param t  [s] finite
 *  @return   BAUM_OK, BAUM_WARNED, BAUM_STOP_CANCELLED, BAUM_STOP_EVENT, BAUM_ERR_ARGUMENT,
 *            BAUM_ERR_SINGULAR, BAUM_ERR_STEP (also: max_steps have been taken, or 10000 steps in
 *            a row have advanced by less than 1e-9 each of the time 1/rate of the motion),
 *            BAUM_ERR_CONVERGENCE, BAUM_ERR_INTEGRATOR, BAUM_ERR_NOT_FINITE, BAUM_ERR_CALLBACK,
 *            BAUM_ERR_INCONSISTENT (kinematics, where a driver jumps at a break), BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_simulation_advance_to(baum_simulation *simulation, double t);

/** Take whole steps forward; afterwards time is where the last one ended.
 *  @param count  > 0
 *  @return       as baum_simulation_advance_to()
 */
BAUM_API baum_status baum_simulation_step(baum_simulation *simulation, int64_t count);

/** Ask a run to stop after its present step; the next call goes on. A run that no call is advancing
 *  stops at the start of the next call, and the one after goes on. From any thread or signal
 *  handler.
 *  @param simulation  may be NULL
 */
BAUM_API void baum_simulation_cancel(baum_simulation *simulation);

/** Replace time and state; multistep methods restart. The state is handled as the option `start`
 *  says, but for one that violates the constraints no more than the run already has: that, as every
 *  state of the run itself, is taken as it is.
 *  @param      t    [s] finite
 *  @param[in]  q    (nq) finite
 *  @param[in]  v    (nv) finite, or NaN where free when `start` is BAUM_START_ASSEMBLE
 *  @return          BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_INCONSISTENT, BAUM_ERR_SINGULAR,
 *                   BAUM_ERR_CONVERGENCE (IDA), BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE,
 *                   BAUM_ERR_INTEGRATOR, BAUM_ERR_MEMORY; unchanged on failure
 */
BAUM_API baum_status baum_simulation_set_state(baum_simulation *simulation, double t,
                                               const double *q, const double *v);

/** Go on where another run stands, also one that has failed: time, state, inputs and laws of
 *  drivers are taken from it; options, counters and warnings stay this run's own. Unless the option
 *  `start` is BAUM_START_AS_GIVEN, q and v are changed by the least that fulfils the constraints.
 *  So another integrator, formulation, tolerance or solver takes over from the last good step.
 *  @param[in] from  of the same mechanism, or of one with the same elements and numbers; unchanged
 *  @return          as baum_simulation_set_state(); BAUM_ERR_ARGUMENT also for another mechanism,
 *                   BAUM_ERR_CONVERGENCE also where q and v cannot be brought onto the constraints
 */
BAUM_API baum_status baum_simulation_continue(baum_simulation *simulation,
                                              const baum_simulation *from);

/** Change an input from the present time on; it is held until it is changed again, also by
 *  baum_simulation_set_state(), and a schedule of it ends. Variable-step methods restart, which
 *  counters.restarts counts and which costs them small steps: a loop that sets inputs often goes
 *  best with a fixed step, and changes that are known before with baum_simulation_schedule_input().
 *  A value that is the present one changes no motion.
 *  @param value  finite
 *  @return       BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_SINGULAR, BAUM_ERR_CONVERGENCE (IDA),
 *                BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE, BAUM_ERR_INTEGRATOR, BAUM_ERR_MEMORY;
 *                unchanged on failure
 */
BAUM_API baum_status baum_simulation_set_input(baum_simulation *simulation, baum_input_id input,
                                               double value);

/** Present value of an input; NaN for NULL and for ids of others. */
BAUM_API double baum_simulation_input(const baum_simulation *simulation, baum_input_id input);

/** Give a driver another law, for this run only: with the present time t0 the prescribed coordinate
 *  is s + ds (t - t0) + dds (t - t0)^2 / 2, in place of the polynomial, user law or spline of its
 *  definition, until it is set again. Variable-step methods restart, which counters.restarts
 *  counts. The state stays: where s or ds differ from it, that is a violation, which the
 *  formulation treats as any other. PROJECTION jumps at the end of the next step, GGL and INDEX3 in
 *  it, as INDEX2 does with ds while it keeps a difference in s, BAUMGARTE goes
 *  there at the rate of its gains (a jump in s with gains of 1/h asks for velocities of about s/h),
 *  UNSTABILIZED keeps the difference, and kinematics takes the nearest pose on its branch, or
 *  refuses where none is near. So lead on from where the coordinate is, and change dds, or ds.
 *  @param driver  of the mechanism of the run
 *  @param s       [rad or m] finite
 *  @param ds      [rad/s or m/s] finite
 *  @param dds     [rad/s^2 or m/s^2] finite
 *  @return        BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_INCONSISTENT (kinematics),
 *                 BAUM_ERR_SINGULAR, BAUM_ERR_CONVERGENCE (IDA, too large a jump),
 *                 BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE, BAUM_ERR_INTEGRATOR, BAUM_ERR_MEMORY;
 *                 unchanged on failure
 */
BAUM_API baum_status baum_simulation_set_driver(baum_simulation *simulation, baum_joint_id driver,
                                                double s, double ds, double dds);

/* ---- save and restore ------------------------------------------------------------------------ */

/** Save a run into memory: time, q, v, grid, gains in use, inputs and their schedules, laws of
 *  drivers, counters, warnings, energy account.
 *  The run forgets what a restored one cannot know, so that the two go on alike, bit for bit:
 *  methods of several steps and those that choose their step restart from here, which
 *  counters.restarts counts, and KLU chooses its pivots again, which may allocate in the next step.
 *  One-step methods with a fixed step lose nothing; with blocks (BAUM_SOLVER_AUTO where they suit)
 *  the run goes on as if it had not been saved. Allocates nothing.
 *  The buffer has no pointers and may be copied, kept in a file and restored in another process;
 *  not by another version of the format, which the library counts up with what a run has. It has
 *  version, size, a sum over its bytes, and fingerprints of the mechanism and the options.
 *  @param[out] buffer    (capacity) of any alignment; NULL: only the size is told, and nothing
 *                        changes
 *  @param      capacity  [byte] at least what NULL tells, which is the same all through a run but
 *                        for
 *                        32 bytes more for each time of a schedule
 *  @param[out] size      [byte] that were written; with NULL the most that will be
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT; unchanged on failure
 */
BAUM_API baum_status baum_simulation_save(baum_simulation *simulation, void *buffer,
                                          size_t capacity, size_t *size);

/** Put a run back to where one was saved: this run, or one of the same mechanism and options, also
 *  in another process. It goes on bit for bit as the saved one does on a processor of the same kind
 *  with the same library. Of the mechanism the kinds of elements, their order and bodies, and all
 *  numbers must be the same, which is checked; functions of the user must be, too, and cannot be
 *  checked, and what these keep for themselves is not saved. Of the options integrator,
 *  formulation, gains, row_gains, step, tolerances, max_step, solver and energy_account must be the
 *  same. Gains and rates that were chosen at the start, and redundant rows, are those of the saved
 *  run. Allocates nothing, but for a saved run that has set drivers, where this one has not, has
 *  more in schedules than this one ever had, or leaves out other rows.
 *  @param[in] buffer  (size) of any alignment; what is behind its end is not looked at
 *  @param     size    [byte] at least what baum_simulation_save() wrote
 *  @return    BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_BUFFER (cut off, damaged, none of a run, of
 *             another version, mechanism or options: the message says which), BAUM_ERR_MEMORY;
 *             unchanged on failure
 */
BAUM_API baum_status baum_simulation_restore(baum_simulation *simulation, const void *buffer,
                                             size_t size);

/** Present time [s]; NaN for NULL. */
BAUM_API double baum_simulation_time(const baum_simulation *simulation);
/** Present positions (nq), owned by the run and changed by it; NULL for NULL. */
BAUM_API const double *baum_simulation_q(const baum_simulation *simulation);
/** Present velocities (nv), owned by the run and changed by it; NULL for NULL. */
BAUM_API const double *baum_simulation_v(const baum_simulation *simulation);

/* ---- what comes out -------------------------------------------------------------------------- */

/** What a channel holds; in brackets its number of columns. Units are m, rad, N, N m and s, or what
 *  those of a user's coordinates and rows make of them; a multiplier has J per unit of its row.
 *  Accelerations, multipliers, reactions and efforts come from one solution of (5) at the present
 *  state, without stabilization terms, which is made only when a channel asks for one of them. The
 *  effort of a driver is its force [N] or torque [N m] on the coordinate it drives: times the
 *  coordinate's rate it is the power that the driver puts into the mechanism. */
typedef enum baum_quantity {
  BAUM_Q = 1,             /**< Positions (nq). */
  BAUM_V = 2,             /**< Velocities (nv). */
  BAUM_A = 3,             /**< Accelerations (nv). */
  BAUM_LAMBDA = 4,        /**< Multipliers of `joint`, or of all (nc). */
  BAUM_PHI = 5,           /**< Constraint violation of `joint`, or of all (nc). */
  BAUM_PHI_RATE = 6,      /**< Its rate J v - nu, of `joint`, or of all (nc). */
  BAUM_ENERGY = 7,        /**< Kinetic and potential energy [J] (2). */
  BAUM_BODY_POSE = 8,     /**< Planar body: x, y of `point` and angle (3); spatial body: x, y, z and
                           quaternion (7); else its q. */
  BAUM_BODY_VELOCITY = 9, /**< Likewise velocities; of a spatial body those of `point` and the
                                    angular velocity in ground axes (6). */
  BAUM_JOINT_REACTION = 10,    /**< Force and moment on body_b (3, in space 6), see planar.h and
                                    spatial.h; of others, such as
                                    user constraints, gears and couplings, -J^T lambda over the
                                    velocities of their bodies. */
  BAUM_JOINT_COORDINATE = 11,  /**< Coordinate and rate of a joint that has one (2). */
  BAUM_BODY_ACCELERATION = 12, /**< As BAUM_BODY_VELOCITY: their derivatives. */
  BAUM_DRIVE_EFFORT = 13,      /**< Effort of the driver `joint` (1). */
  BAUM_ENERGY_ACCOUNT = 14     /**< As in baum_energy_account [J] (12): kinetic, potential, loads,
                                    springs, dampers, user_forces, bodies, drivers, violation,
                                    projection, gains, residual. Only with the option
                                    energy_account. */
} baum_quantity;

/** One group of columns. All channels of an array have the same struct_size. */
typedef struct baum_channel {
  size_t struct_size;     /**< Set by the default. Do not write. */
  baum_quantity quantity; /**< What. Default: 0, must be set. */
  baum_body_id body;      /**< For BAUM_BODY_*. Default: none. */
  baum_joint_id joint;    /**< For JOINT_*, DRIVE_EFFORT; optional for LAMBDA, PHI, PHI_RATE.
                               Default: none. */
  double point[3];        /**< [m] body axes, for BAUM_BODY_* of a body that has axes; its plane has
                               z = 0. Default: (0, 0, 0), the centre of mass. */
} baum_channel;

/** Set the defaults of a channel; writes at most caller_size bytes.
 *  @param[out] channel      NULL is ignored
 *  @param      caller_size  sizeof *channel
 */
BAUM_API void baum_channel_init(baum_channel *channel, size_t caller_size);

/** A channel of the whole mechanism. */
static inline baum_channel baum_channel_of(baum_quantity quantity)
{
  baum_channel channel;
  baum_channel_init(&channel, sizeof channel);
  channel.quantity = quantity;
  return channel;
}

/** A channel of a body. */
static inline baum_channel baum_channel_of_body(baum_quantity quantity, baum_body_id body)
{
  baum_channel channel = baum_channel_of(quantity);
  channel.body = body;
  return channel;
}

/** A channel of a point of a body [m], body axes. */
static inline baum_channel baum_channel_of_point(baum_quantity quantity, baum_body_id body,
                                                 double x, double y, double z)
{
  baum_channel channel = baum_channel_of_body(quantity, body);
  channel.point[0] = x;
  channel.point[1] = y;
  channel.point[2] = z;
  return channel;
}

/** A channel of a joint. */
static inline baum_channel baum_channel_of_joint(baum_quantity quantity, baum_joint_id joint)
{
  baum_channel channel = baum_channel_of(quantity);
  channel.joint = joint;
  return channel;
}

/** Number of columns of some channels together.
 *  @param[in] mechanism  frozen
 *  @param[in] channels   (count); may be NULL when count is 0
 *  @return    -1 when a channel is not valid; baum_message() says why
 */
BAUM_API int32_t baum_channels_width(const baum_mechanism *mechanism, const baum_channel *channels,
                                     int32_t count);

/** Tell which multipliers are unique at the present state. Where rows are redundant, forces can be
 *  shared between joints in more than one way: BAUM_LAMBDA, BAUM_JOINT_REACTION and
 *  BAUM_DRIVE_EFFORT are then those of least norm in rows scaled by M, as far as the constraints
 *  are met, and balance the forces to 1e-9 in any case.
 *  @param[out] unique  (nc) per row, true where its multiplier has no choice
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_SINGULAR, BAUM_ERR_CALLBACK,
 *              BAUM_ERR_NOT_FINITE, BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_simulation_unique_multipliers(baum_simulation *simulation, bool *unique);

/** Read channels at the present state.
 *  @param[in]  channels  (count)
 *  @param[out] row       (baum_channels_width())
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT (of a channel), BAUM_ERR_STATE
 *              (BAUM_ENERGY_ACCOUNT without the option), BAUM_ERR_SINGULAR, BAUM_ERR_CALLBACK,
 *              BAUM_ERR_NOT_FINITE, BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_simulation_get(baum_simulation *simulation, const baum_channel *channels,
                                         int32_t count, double *row);

/** Advance through times and record channels at each. Times off the grid of a fixed-step method are
 *  reached by a shorter step on a copy, so that sampling does not alter the motion; afterwards the
 *  run stands at the last time, as after baum_simulation_advance_to().
 *  @param[in]  times     (n) [s] monotone, the first may be the present time
 *  @param[in]  channels  (count)
 *  @param[out] rows      (n x width)
 *  @param[out] done      number of rows written, also on failure. May be NULL.
 *  @return     as baum_simulation_advance_to(); BAUM_ERR_STRUCT (of a channel), BAUM_ERR_STATE
 *              (BAUM_ENERGY_ACCOUNT without the option)
 */
BAUM_API baum_status baum_simulation_sample(baum_simulation *simulation, const double *times,
                                            int64_t n, const baum_channel *channels, int32_t count,
                                            double *rows, int64_t *done);

/** What a run has cost and how well constraints were kept, since it was created. Violations are
 *  predicted for both Eulers with stable gains of at least 0.1/h. */
typedef struct baum_counters {
  size_t struct_size;     /**< Set by baum_simulation_counters(). */
  int64_t steps;          /**< [-] accepted. */
  int64_t rejected;       /**< [-] steps that failed an error test or an iteration. */
  int64_t short_steps;    /**< [-] shorter steps of a fixed-step method to a target off its grid. */
  int64_t evaluations;    /**< [-] of (7) or of the residual. */
  int64_t factorizations; /**< [-] refactorizations of the matrix in (7) and of IDA's or CVODE's. */
  int64_t full_factorizations;  /**< [-] of these those that chose new pivots and may allocate. */
  int64_t nonlinear_iterations; /**< [-] of CVODE, IDA, kinematics. */
  int64_t restarts;             /**< [-] of a multistep method. */
  int64_t near_singular;        /**< [-] evaluations in which the matrix was close to singular. */
  int64_t warnings;             /**< [-] kinds of warnings, see baum_simulation_warning(). */
  double wall;                  /**< [s] inside advance_to, step and sample. */
  double max_phi;               /**< [m or rad] largest |Phi| over all steps. */
  double max_phi_rate;          /**< [m/s or rad/s] largest |Phi'| over all steps. */
  baum_joint_id max_phi_joint;  /**< Joint of max_phi. */
  baum_joint_id max_phi_rate_joint; /**< Joint of max_phi_rate. */
  double predicted_phi; /**< [m or rad] (alpha/beta^2) h largest |gamma_i|; NaN: not predicted. */
  double predicted_phi_rate; /**< [m/s or rad/s] (h/2) largest |gamma_i|; NaN likewise. */
  double energy_change; /**< [J] kinetic, potential since start; of drivers, inputs, dampers too. */
  double start_change;  /**< [-] largest displacement of the last assembly, of the scale. */
  double alpha;         /**< [1/s] in use. */
  double beta;          /**< [1/s] in use. */
  double spectral_radius; /**< [-] what a step of the gains in use leaves of a violation in the long
                               run; NaN without BAUMGARTE or where steps vary. */
  double damping; /**< [1/s] effective, -ln(spectral_radius) / h: alpha where gains are small and
                       alpha = beta; infinite for a dead-beat pair, negative where violations grow;
                       NaN likewise. */
  int64_t near_singular_intervals; /**< [-] crossings near singular configurations, see
                                        baum_simulation_near_singular(). */
  int64_t branch_warnings; /**< [-] of these those behind which the motion is on another branch, or
                                may be. */
  int64_t forced_steps; /**< [-] of rk8 and dp5, taken over a singular configuration whatever their
                             error estimate. */
  double energy_residual; /**< [J] of the energy account at present: gained or lost by the method
                                itself; NaN without the option energy_account. */
  int64_t doubts;         /**< [-] kinds of warnings that doubt the motion. */
  double error_estimate;  /**< [-] largest estimated error of the positions since the start,
                                relative to the characteristic length and to radians; 0 while the
                                local errors of fixed steps are negligible. NaN: not known, as with
                                variable steps without the option error_check, or where the
                                estimate would cost more than the run. */
} baum_counters;

/** Read the counters.
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE
 */
BAUM_API baum_status baum_simulation_counters(baum_simulation *simulation, baum_counters *out,
                                              size_t caller_size);

/** Where the energy of a run has come from since its start, or since the last
 *  baum_simulation_set_state(); inputs and drivers that are set go on. A work is positive where it
 *  brings energy into the mechanism. The account closes as well as the motion has been integrated:
 *  the residual is an error of the method, of its order in the step or of the size of its
 *  tolerance. An evaluation that fails ends the account with a warning; works and residual are NaN
 *  from there on. The motion is the same with and without an account.
 *  Cost, in evaluations of (7) or (5) a step: 3 with a fixed step, but 18 with dp5 and 48 with rk8,
 *  which take shorter steps for it; 4 with variable steps, of rk8 7 with those of its interpolant;
 *  BAUMGARTE adds 2 to 4. */
typedef struct baum_energy_account {
  size_t struct_size;  /**< Set by baum_simulation_energy_account(). */
  double kinetic;      /**< [J] v^T M v / 2 at present. */
  double potential;    /**< [J] of gravity, linear springs, constant loads and as users say. */
  double start;        /**< [J] kinetic and potential at the start. */
  double loads;        /**< [J] of loads with an input or a torque, or that follow their body. */
  double springs;      /**< [J] of springs with a law of the user. */
  double dampers;      /**< [J] of the damping of linear springs. */
  double user_forces;  /**< [J] of user forces, without the change of their potential. */
  double bodies;       /**< [J] of the forces of user coordinates, without the change of their
                           potential, and v^T M' v / 2 of theirs: 0 where these are Lagrange's. */
  double drivers;      /**< [J] -nu^T lambda: of drivers and other rows that depend on time. */
  double violation;    /**< [J] -Phi'^T lambda: of rows whose Phi' is not 0. */
  double projection;   /**< [J] changes of kinetic and potential energy by projections. */
  double gains;        /**< [J] what the gains have done, a part of drivers and violation: not to be
                     added. */
  double residual;     /**< [J] kinetic + potential - start - all works but gains. */
  int64_t evaluations; /**< [-] of (5) and (7) for the account, which counters leave out. */
} baum_energy_account;

/** Read the energy account at the present state.
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (the option energy_account is false),
 *              BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE
 */
BAUM_API baum_status baum_simulation_energy_account(baum_simulation *simulation,
                                                    baum_energy_account *out, size_t caller_size);

/** What has become of a motion behind a singular configuration, where several branches of motion
 *  cross. */
typedef enum baum_branch {
  BAUM_BRANCH_CONTINUED = 1, /**< It goes on smoothly. */
  BAUM_BRANCH_LEFT = 2,   /**< Its velocity has jumped: it is on another branch. Do not trust it. */
  BAUM_BRANCH_UNKNOWN = 3 /**< Cannot be told from the steps taken. */
} baum_branch;

/** One interval in which a run was near a singular configuration. The pivot is the smallest of the
 *  equations of motion against the largest of the run so far; it falls with the square of the
 *  distance from a singular configuration. Intervals with a pivot below 1e-3, or as small as the
 *  constraint violation of the run makes it, are listed when the run has come out of them. */
typedef struct baum_near_singular {
  size_t struct_size;  /**< Set by baum_simulation_near_singular(). */
  double begin;        /**< [s] last step before it. */
  double end;          /**< [s] first step behind it. */
  double t;            /**< [s] of the smallest pivot, between steps too. */
  double pivot;        /**< [-] smallest of the motion, of the usual one; also between steps. */
  double jump;         /**< [-] change of the velocity against the smooth continuation of the motion
                            before, of its size; NaN: not known. */
  double jump_error;   /**< [-] estimated error of jump; NaN likewise. */
  baum_branch branch;  /**< What has become of the motion. */
  baum_joint_id joint; /**< With the smallest pivot; none where it is not known. */
} baum_near_singular;

/** Read a near-singular interval. Runs of baum_kinematics() have none.
 *  @param      k            0 to counters.near_singular_intervals - 1; the first 64 are kept
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_simulation_near_singular(const baum_simulation *simulation, int64_t k,
                                                   baum_near_singular *out, size_t caller_size);

/** What a warning is about. Kinds from 100 on doubt the motion: the result may be wrong by far more
 *  than its tolerance. The others tell what deserves to be known about a right one. */
typedef enum baum_warning_code {
  BAUM_WARNING_REDUNDANT_ROWS = 1,      /**< Some multipliers are not unique. */
  BAUM_WARNING_GAINS = 2,               /**< The stability of the gains is not known. */
  BAUM_WARNING_NOISY_DERIVATIVES = 3,   /**< rtol is below the error of differences. */
  BAUM_WARNING_INDEX3 = 4,              /**< IDA at index 3: for comparison only. */
  BAUM_WARNING_LOOSE_VELOCITIES = 5,    /**< Ill-conditioned rows leave velocities loose. */
  BAUM_WARNING_ENERGY_ACCOUNT = 6,      /**< The energy account has ended. */
  BAUM_WARNING_ILL_CONDITIONED = 7,     /**< The equations of motion are close to singular. */
  BAUM_WARNING_SINGULARITY_CROSSED = 8, /**< The motion continues smoothly through a singularity. */
  BAUM_WARNING_BRANCH = 100,            /**< It may have left its branch at a singularity. */
  BAUM_WARNING_VIOLATION = 101,         /**< The constraint violation is too large. */
  BAUM_WARNING_CONTRADICTION = 102,     /**< Omitted rows no longer follow from the others. */
  BAUM_WARNING_ACCURACY = 103,          /**< The estimated error of the motion is large. */
  BAUM_WARNING_SINGULAR_START = 104     /**< Several motions may leave the initial configuration. */
} baum_warning_code;

/** Name of a kind of warnings such as "branch"; NULL for an unknown value. */
BAUM_API const char *baum_warning_name(baum_warning_code code);

/** All warnings of one kind. */
typedef struct baum_warning {
  size_t struct_size;     /**< Set by baum_simulation_warning(). */
  baum_warning_code code; /**< Kind. */
  bool doubts_motion;     /**< The result may be wrong: code >= 100. */
  baum_joint_id joint;    /**< Joint that the first one is about; all-zero: none. */
  double first;           /**< [s] time of the first one. */
  double last;            /**< [s] time of the last one. */
  int64_t count;          /**< [-] how many there were. */
  char text[400];         /**< Message of the first one, and how often it came. */
} baum_warning;

/** Read a kind of warnings. A run keeps one entry per kind, in the order in which they first came.
 *  @param      k            0 to counters.warnings - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_simulation_warning(const baum_simulation *simulation, int64_t k,
                                             baum_warning *out, size_t caller_size);

/** In words: formulation, integrator, gains and why, stability, solver, redundancy, tolerances.
 *  Owned by the run; NULL for NULL. */
BAUM_API const char *baum_simulation_explain(const baum_simulation *simulation);

/** The message of this run's last failure, stop or warning, "" at first. Owned by the run; NULL
 *  for NULL. */
BAUM_API const char *baum_simulation_message(const baum_simulation *simulation);

#ifdef __cplusplus
}
#endif

#endif
