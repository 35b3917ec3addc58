/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  One run of a frozen mechanism: formulation, integrator, motion and results.
 *
 *  Failure: a run that fails keeps its last good step; time, q and v can still be read.
 *
 *  Threads: one simulation is used by one thread at a time, except baum_simulation_cancel().
 *  Simulations may share a mechanism.
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

/* After the integrator itself, each comment lists the formulations that it offers. The first one is
 * its default. The default rule for the gains of BAUMGARTE is in parentheses. */

/** @return explicit Euler, order 1, fixed step. BAUMGARTE (dead-beat), UNSTABILIZED, PROJECTION */
BAUM_API const baum_integrator *baum_euler(void);
/** @return semi-implicit (symplectic) Euler, order 1, fixed step; it updates the velocities first.
 *  Formulations as baum_euler() */
BAUM_API const baum_integrator *baum_semi_implicit_euler(void);
/** @return  explicit midpoint rule, order 2, fixed step. PROJECTION, BAUMGARTE (auto), UNSTABILIZED
 */
BAUM_API const baum_integrator *baum_rk2(void);
/** @return Kutta's third-order method, fixed step. Formulations as baum_rk2() */
BAUM_API const baum_integrator *baum_rk3(void);
/** @return classical fourth-order Runge-Kutta method, fixed step. Formulations as baum_rk2() */
BAUM_API const baum_integrator *baum_rk4(void);
/** For loose tolerances.
 *  @return  Dormand and Prince's pair of orders 5 and 4, explicit, with rtol or with a fixed step.
 *           Six evaluations per step. PROJECTION, BAUMGARTE (auto), UNSTABILIZED */
BAUM_API const baum_integrator *baum_dp5(void);
/** The first choice for non-stiff forces and rtol <= 1e-5.
 *  @return  DOP853, order 8 with estimates of orders 5 and 3 (Hairer, Norsett, Wanner 1993),
 *           explicit, with rtol or with a fixed step. Twelve evaluations per step, three more if
 *           the step is interpolated. Formulations as baum_dp5() */
BAUM_API const baum_integrator *baum_rk8(void);
/** Takes its first steps with a Runge-Kutta method: at the start, after
 *  baum_simulation_set_state(), _set_input() and _set_driver(), after a reversal of time and after
 *  a target off the grid.
 *  @return  two-step Adams-Bashforth method, order 2, fixed step, one evaluation per step.
 *           BAUMGARTE (best damping), UNSTABILIZED; not PROJECTION, because its past steps cannot
 *           be projected */
BAUM_API const baum_integrator *baum_ab2(void);
/** @return three-step Adams-Bashforth method, order 3; otherwise as baum_ab2() */
BAUM_API const baum_integrator *baum_ab3(void);
/** @return four-step Adams-Bashforth method, order 4; otherwise as baum_ab2() */
BAUM_API const baum_integrator *baum_ab4(void);
/** For long runs without dissipation: the energy stays in a band of width O(h^2). Also for rigid
 *  bodies in space; the angular momentum of a free body is conserved to rounding. Refuses variable
 *  masses and forces that depend on velocities, such as dampers and gyroscopic moments of user
 *  coordinates. It checks this for user functions at a few states. Phi = 0 and Phi' = 0 hold to
 *  rounding after every step.
 *  @return  RATTLE, order 2, fixed step, symplectic. INDEX3 */
BAUM_API const baum_integrator *baum_rattle(void);
/** For stiff forces, and for comparison at index 3. Phi = 0 holds to rounding after every step,
 *  Phi' to second order.
 *  @return  generalized-alpha method with spectral radius 0.8, order 2, fixed step, implicit.
 *           INDEX3 */
BAUM_API const baum_integrator *baum_generalized_alpha(void);
/** Solves the implicit equations of a step by fixed-point iteration, but treats the stiff terms of
 *  the gains by Newton's method. Stiff forces therefore limit the steps, but high gains do not.
 *  CVODE projects only with BDF.
 *  @return  SUNDIALS CVODE, Adams-Moulton, rtol. BAUMGARTE (auto), UNSTABILIZED */
BAUM_API const baum_integrator *baum_cvode_adams(void);
/** For stiff forces. Newton iteration with the true sparse Jacobian, including the derivatives of
 *  all joints and forces. PROJECTION projects inside each step, before the error test.
 *  @return  SUNDIALS CVODE, BDF, rtol. PROJECTION, BAUMGARTE (auto), UNSTABILIZED */
BAUM_API const baum_integrator *baum_cvode_bdf(void);
/** INDEX3 is offered for comparison only: its error is far above its tolerance.
 *  @return  SUNDIALS IDA, variable-order BDF on y = (q, v, lambda), rtol. GGL, BAUMGARTE (auto),
 *           UNSTABILIZED, INDEX2, INDEX3 */
BAUM_API const baum_integrator *baum_ida(void);
/** For mechanisms whose drivers prescribe all degrees of freedom, so that Phi(q, t) = 0 determines
 *  every coordinate; other mechanisms are refused. It computes configurations to rounding at the
 *  requested times, by continuation along the branch of the initial configuration. It takes no
 *  formulation, gains, step, rtol or atol. If the mechanism locks or branches cross, the run stops
 *  with BAUM_ERR_SINGULAR; it never jumps to another branch.
 *  @return  kinematics, without integration */
BAUM_API const baum_integrator *baum_kinematics(void);

/** List the integrators, for bindings and tables. Linking this function links every backend.
 *  @param k  0, 1, ...
 *  @return  NULL past the end */
BAUM_API const baum_integrator *baum_integrator_at(int32_t k);

/** Name of an integrator.
 *  @param integrator  may be NULL
 *  @return  such as "cvode_adams"; NULL for NULL */
BAUM_API const char *baum_integrator_name(const baum_integrator *integrator);
/** Order of accuracy of an integrator at a fixed step.
 *  @param integrator  may be NULL
 *  @return  0 for variable order and for NULL */
BAUM_API int32_t baum_integrator_order(const baum_integrator *integrator);
/** Whether an integrator takes `step`. @param integrator  may be NULL @return false for NULL */
BAUM_API bool baum_integrator_has_fixed_step(const baum_integrator *integrator);
/** Whether an integrator takes `rtol`. If it takes both `step` and `rtol`, set one of the two
 *  options. baum_kinematics() takes neither.
 *  @param integrator  may be NULL
 *  @return  false for NULL */
BAUM_API bool baum_integrator_has_variable_step(const baum_integrator *integrator);

/** Form of the equations of motion. docs/notation.md lists the equations (5) and (7). */
typedef enum baum_formulation {
  BAUM_FORMULATION_DEFAULT = 0, /**< The first formulation that the integrator offers. */
  /** (5): J a = gamma; the constraint violation drifts. */
  BAUM_FORMULATION_UNSTABILIZED = 1,
  BAUM_FORMULATION_BAUMGARTE = 2,  /**< (7): J a = gamma - 2 alpha Phi' - beta^2 Phi. */
  BAUM_FORMULATION_PROJECTION = 3, /**< (5); q and v are projected after each step. */
  BAUM_FORMULATION_INDEX2 = 4,     /**< J v = nu; Phi drifts slowly. */
  BAUM_FORMULATION_GGL = 5,        /**< J v = nu and Phi = 0 (Gear, Gupta, Leimkuhler 1985). */
  BAUM_FORMULATION_INDEX3 = 6      /**< Phi = 0. */
} baum_formulation;

/** Name of a formulation.
 *  @param formulation  any value
 *  @return  such as "baumgarte"; NULL for unknown values */
BAUM_API const char *baum_formulation_name(baum_formulation formulation);

/** Whether an integrator offers a formulation.
 *  @param integrator   may be NULL
 *  @param formulation  any value
 *  @return  false for NULL */
BAUM_API bool baum_integrator_offers(const baum_integrator *integrator,
                                     baum_formulation formulation);

/** How a run begins from the design configuration. */
typedef enum baum_start {
  /** Assemble; refuse displacements above a quarter of the characteristic length, or 1 rad. If
   *  drivers start away from the design configuration and the displacement is refused, first
   *  assemble with the drivers in the design configuration, and then move them to their initial
   *  values in small steps. */
  BAUM_START_ASSEMBLE = 0,
  /** Refuse a configuration or velocities that violate the constraints. */
  BAUM_START_EXACT = 1,
  /** Accept the given configuration and velocities; free velocities are zero. Only bodies that are
   *  welded to ground move, to the poses that the welds prescribe. */
  BAUM_START_AS_GIVEN = 2
} baum_start;

/** Solver of the equations of motion (7). baum_simulation_explain() states which one is used, and
 *  why. Assembly and the multipliers of redundant rows use KLU and QR in any case. */
typedef enum baum_solver {
  /** BLOCK if it suits the mechanism; KLU and QR where BLOCK is not accurate. */
  BAUM_SOLVER_AUTO = 0,
  BAUM_SOLVER_KLU = 1, /**< Sparse LU of the whole system, refactored on a fixed pattern. */
  /** Sparse rank-revealing QR; slow. For comparison and singular configurations. */
  BAUM_SOLVER_QR = 2,
  /** Schur complement in blocks of two rows, without a fallback. It is refused if a body has more
   *  than about 50 joints, if the joints form a dense network, or if the mass matrix is not
   *  positive definite. Fails with BAUM_ERR_SINGULAR close to singular configurations. */
  BAUM_SOLVER_BLOCK = 3
} baum_solver;

/** Called every progress_interval while a call advances a run. The first interval begins with that
 *  call. The function may read the run, also with baum_simulation_get(). Inside it, functions that
 *  change, advance or save the run fail (BAUM_ERR_STATE), and destroying the run does nothing.
 *  @param simulation  the run
 *  @param t           [s] present time
 *  @param user        the option `user`
 *  @return  non-zero to cancel */
typedef int baum_progress_fn(const baum_simulation *simulation, double t, void *user);

/* ---- options --------------------------------------------------------------------------------- */

/** How to run. Variable-step integrators may step over a force or a law that begins late or acts
 *  briefly; set max_step or break times (breaks.h) in this case. */
typedef struct baum_simulation_options {
  size_t struct_size;                /**< Set by the default. Do not write. */
  const baum_integrator *integrator; /**< Default: NULL, must be set. */
  baum_formulation formulation;      /**< Default: BAUM_FORMULATION_DEFAULT. */
  baum_gains gains;                  /**< Only for BAUMGARTE. Default: BAUM_GAINS_DEFAULT. */
  bool allow_unstable; /**< Accept gains that are known to be unstable. Default: false. */
  double step;         /**< [s] > 0, for fixed-step integrators. Default: NaN, not given. */
  /** [-] > 0, < 1, tolerance of the local error relative to the scales of q and v. cvode_bdf uses
   *  1/6.9 and ida 1/3 of rtol and atol, but not less than 1e-13, so that all methods are about
   *  equally accurate at the same rtol. Default: NaN, not given. */
  double rtol;
  /** [unit of the coordinate] >= 0, added to rtol times the scale. Default: NaN, none. */
  double atol;
  /** [s] > 0, longest step of a variable-step integrator. Default: NaN, none. */
  double max_step;
  double start_time;      /**< [s] Default: 0. */
  baum_start start;       /**< Default: BAUM_START_ASSEMBLE. */
  baum_solver solver;     /**< Default: BAUM_SOLVER_AUTO. */
  bool check_derivatives; /**< See baum_mechanism_check_derivatives(). Default: true. */
  /** [-] > 0, most steps of a call; a call that needs more fails. Default: 1000000000. */
  int64_t max_steps;
  baum_progress_fn *progress; /**< Default: NULL, none. */
  double progress_interval;   /**< [s] of wall time, >= 0. Default: 0.05. */
  void *user;                 /**< Passed to progress, not owned. Default: NULL. */
  /** [-] > 0, finite, factor on rtol and atol for positions; refused with a fixed step. Default: 1.
   */
  double tolerance_q;
  double tolerance_v; /**< [-] > 0, finite, the same for velocities. Default: 1. */
  /** [-] > 0, factor on rtol for multipliers; finite only for IDA with BAUMGARTE or UNSTABILIZED.
   *  Row i has the tolerance tolerance_lambda rtol E / n_i, where n_i is the norm of row i of J
   *  after each column j has been multiplied by the scale s_j of its coordinate. E is the largest
   *  present |lambda_k| n_k, or the largest M_jj s_j^2 r^2 if that is larger, where r [1/s] is the
   *  rate that baum_simulation_explain() states with the tolerances. Default: infinity, multipliers
   *  are not tested. */
  double tolerance_lambda;
  /** Record the works of baum_simulation_energy_account(). Not for kinematics. Default: false. */
  bool energy_account;
  /** [-] (row_gain_count) > 0, factor f_i for each row, whose gains are alpha f_i and beta f_i.
   *  Copied. Default: NULL, all 1. */
  const double *row_gains;
  int32_t row_gain_count; /**< [-] nc of the mechanism if row_gains is given. Default: 0. */
  /** Estimate the error of the motion from the start by a second integration, and warn if it is
   *  large; see counters.error_estimate. The second integration is rk8 at rtol 1e-8 for a run with
   *  a fixed step, and the same method at 0.03 rtol for a run with variable steps; it at least
   *  doubles the cost. Without this option, a fixed-step run starts such an integration only when
   *  the sum of its local errors is large enough to matter. Default: false. */
  bool error_check;
} baum_simulation_options;

/** Set every field to its default.
 *  @param[out] options      NULL is ignored
 *  @param      caller_size  sizeof *options; no byte beyond it is written */
BAUM_API void baum_simulation_options_init(baum_simulation_options *options, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_simulation_options baum_simulation_options_default(void)
{
  baum_simulation_options options;
  baum_simulation_options_init(&options, sizeof options);
  return options;
}

/* ---- a run ----------------------------------------------------------------------------------- */

/** Create a run: assemble, choose and check gains, set up the integrator.
 *  @param      mechanism  frozen; the simulation keeps it alive
 *  @param[in]  options    copied
 *  @param[out] out        receives the run, NULL on failure; release it with
 *                         baum_simulation_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE (not frozen),
 *           BAUM_ERR_UNSUPPORTED (the integrator does not offer the formulation, has no gains by
 *           this rule, or is not in this build; kinematics for a mechanism with degrees of freedom
 *           or with an energy account; RATTLE or BAUM_SOLVER_BLOCK cannot handle the mechanism),
 *           BAUM_ERR_INCONSISTENT, BAUM_ERR_SINGULAR, BAUM_ERR_UNSTABLE, BAUM_ERR_MEMORY,
 *           BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE, BAUM_ERR_CONVERGENCE, BAUM_ERR_INTEGRATOR */
BAUM_API baum_status baum_simulation_create(const baum_mechanism *mechanism,
                                            const baum_simulation_options *options,
                                            baum_simulation **out);

/** Release a run. @param simulation  may be NULL */
BAUM_API void baum_simulation_destroy(baum_simulation *simulation);

/** Advance to time t, forward or backward. If t is the present time, nothing happens. A fixed-step
 *  method takes whole steps from the present time; if t is off its grid, one shorter step follows,
 *  which is counted and starts a new grid. A variable-step method steps past t and interpolates, so
 *  that targets do not alter its steps.
 *  @param simulation  the run
 *  @param t           [s] finite
 *  @return  BAUM_OK, BAUM_WARNED, BAUM_STOP_CANCELLED, BAUM_STOP_EVENT, BAUM_STOP_TIME,
 *           BAUM_ERR_ARGUMENT, BAUM_ERR_SINGULAR, BAUM_ERR_STEP (also: max_steps is reached, or
 *           10000 variable steps in a row were shorter than 1e-9 / r on average, where r [1/s] is
 *           the rate of the motion), BAUM_ERR_CONVERGENCE, BAUM_ERR_INTEGRATOR,
 *           BAUM_ERR_NOT_FINITE, BAUM_ERR_CALLBACK, BAUM_ERR_INCONSISTENT (kinematics: a driver
 *           jumps at a break), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_advance_to(baum_simulation *simulation, double t);

/** Take whole steps forward, up to the end of the last one.
 *  @param simulation  the run
 *  @param count       [-] > 0
 *  @return  as baum_simulation_advance_to() */
BAUM_API baum_status baum_simulation_step(baum_simulation *simulation, int64_t count);

/** Ask a run to stop after its present step; the next call continues. If no call is advancing the
 *  run, the next call stops at once and the one after continues. May be called from any thread or
 *  signal handler.
 *  @param simulation  may be NULL */
BAUM_API void baum_simulation_cancel(baum_simulation *simulation);

/** Change the option progress_interval. The progress function may call this, too, for example to be
 *  called after every step from now on.
 *  @param simulation  the run
 *  @param interval    [s] of wall time, >= 0, finite
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (inside another function of the user) */
BAUM_API baum_status baum_simulation_set_progress_interval(baum_simulation *simulation,
                                                           double interval);

/** Limit the wall time of calls that advance the run. A call that takes longer stops after its
 *  present step, but not before its first, with BAUM_STOP_TIME, and the next call continues. The
 *  motion and the monitors do not depend on such stops.
 *  @param simulation  the run
 *  @param limit       [s] of wall time, > 0; INFINITY, as at the start of a run: none
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (inside another function of the user) */
BAUM_API baum_status baum_simulation_set_time_limit(baum_simulation *simulation, double limit);

/** Replace time and state; multistep methods restart. If the state violates the constraints no more
 *  than the run already does, it is taken as it is; otherwise the option `start` decides what
 *  happens.
 *  @param     simulation  unchanged on failure
 *  @param     t           [s] finite
 *  @param[in] q           (nq) finite
 *  @param[in] v           (nv) finite, or NaN where free if `start` is BAUM_START_ASSEMBLE
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_INCONSISTENT, BAUM_ERR_SINGULAR,
 *           BAUM_ERR_CONVERGENCE (IDA), BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE,
 *           BAUM_ERR_INTEGRATOR, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_set_state(baum_simulation *simulation, double t,
                                               const double *q, const double *v);

/** Continue from the present state of another run, even one that has failed. Time, state, inputs
 *  and laws of drivers come from that run; options, counters and warnings are those of this run.
 *  Another integrator, formulation, tolerance or solver can thus take over from the last good step.
 *  Unless the option `start` is BAUM_START_AS_GIVEN, q and v change by the least amount that
 *  fulfils the constraints.
 *  @param simulation  unchanged on failure
 *  @param from        of the same mechanism, or of one with the same elements and numbers
 *  @return  as baum_simulation_set_state(); BAUM_ERR_ARGUMENT also for another mechanism,
 *           BAUM_ERR_CONVERGENCE also if q and v cannot be moved onto the constraints */
BAUM_API baum_status baum_simulation_continue(baum_simulation *simulation,
                                              const baum_simulation *from);

/** Change an input from the present time on. This ends a schedule of the input. The value holds
 *  until it is changed again, also across baum_simulation_set_state(). Setting the present value
 *  does not alter the motion.
 *
 *  Variable-step methods restart with small steps (counters.restarts). For control loops use a
 *  fixed step; for changes known in advance use baum_simulation_schedule_input().
 *  @param simulation  unchanged on failure
 *  @param input       one of the mechanism
 *  @param value       finite
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_SINGULAR, BAUM_ERR_CONVERGENCE (IDA),
 *           BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE, BAUM_ERR_INTEGRATOR, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_set_input(baum_simulation *simulation, baum_input_id input,
                                               double value);

/** Read an input.
 *  @param simulation  may be NULL
 *  @param input       one of the mechanism
 *  @return  its present value; NaN for NULL and other ids */
BAUM_API double baum_simulation_input(const baum_simulation *simulation, baum_input_id input);

/** Replace the law of a driver in this run. From the present time t0 on, the prescribed coordinate
 *  is s + ds (t - t0) + dds (t - t0)^2 / 2, until it is set again. Variable-step methods restart
 *  (counters.restarts).
 *
 *  The state does not change. If s or ds differ from the present coordinate and velocity, the
 *  difference is a constraint violation, and the formulation decides what happens. With PROJECTION
 *  the state jumps at the end of the next step, with GGL and INDEX3 within it. INDEX2 corrects ds
 *  but keeps the difference in s. With BAUMGARTE the difference decays at the rate of the gains;
 *  after a jump in s, gains of 1/h cause velocities of about s/h. UNSTABILIZED keeps the
 *  difference. Kinematics takes the nearest configuration on its branch and fails if none is near.
 *  To avoid jumps, start s at the present coordinate, and change only dds, or ds.
 *  @param simulation  unchanged on failure
 *  @param driver      one of the mechanism
 *  @param s           [rad or m] finite
 *  @param ds          [rad/s or m/s] finite
 *  @param dds         [rad/s^2 or m/s^2] finite
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_INCONSISTENT (kinematics), BAUM_ERR_SINGULAR,
 *           BAUM_ERR_CONVERGENCE (IDA: the jump is too large), BAUM_ERR_CALLBACK,
 *           BAUM_ERR_NOT_FINITE, BAUM_ERR_INTEGRATOR, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_set_driver(baum_simulation *simulation, baum_joint_id driver,
                                                double s, double ds, double dds);

/* ---- save and restore ------------------------------------------------------------------------ */

/** Save a run into memory: time, q, v, grid of the steps, gains in use, inputs and schedules, laws
 *  of drivers, counters, warnings and energy account.
 *
 *  Integrator history and pivots are not saved. Saving discards them just as restoring does, so
 *  both runs continue identically, bit for bit. Multistep and variable-step methods therefore
 *  restart here (counters.restarts), and KLU chooses new pivots, which may allocate in the next
 *  step. One-step methods with a fixed step lose nothing; with the block solver, the run continues
 *  as if it had not been saved. Saving allocates nothing.
 *
 *  The buffer contains no pointers. You may copy it, keep it in a file and restore it in another
 *  process. It contains a format version, its size, a checksum, and fingerprints of the mechanism
 *  and the options. Libraries with another format version refuse it.
 *  @param      simulation  the run
 *  @param[out] buffer      (capacity) of any alignment. NULL: only size is written, and the run
 *                          does not change.
 *  @param      capacity    [byte] at least the size that a call with NULL writes. This size is
 *                          constant during a run, except that each time of a schedule adds 32
 *                          bytes.
 *  @param[out] size        [byte] number of bytes written; with NULL the largest number needed
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT; unchanged on failure */
BAUM_API baum_status baum_simulation_save(baum_simulation *simulation, void *buffer,
                                          size_t capacity, size_t *size);

/** Restore a saved run: in the same run, or in a run of the same mechanism and options, also in
 *  another process. With the same library on the same kind of processor it continues bit for bit as
 *  the saved run does.
 *
 *  The library checks that the mechanism has the same elements, order, bodies and numbers, and that
 *  integrator, formulation, gains, row_gains, step, tolerances, max_step, solver and energy_account
 *  are the same. It cannot check user functions: they must be the same, and the state that they
 *  keep is not saved. Gains and redundant rows chosen at the start are those of the saved run.
 *  Restoring allocates memory only if drivers were set in the saved run, or if it has longer
 *  schedules or omits other redundant rows than this run.
 *  @param     simulation  unchanged on failure
 *  @param[in] buffer      (size) of any alignment; bytes after the saved run are ignored
 *  @param     size        [byte] at least what baum_simulation_save() wrote
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_BUFFER (truncated, damaged, not a saved run, or of
 *           another version, mechanism or options; the message says which), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_restore(baum_simulation *simulation, const void *buffer,
                                             size_t size);

/** Present time. @param simulation  may be NULL @return [s]; NaN for NULL */
BAUM_API double baum_simulation_time(const baum_simulation *simulation);
/** Present positions.
 *  @param simulation  may be NULL
 *  @return  (nq) owned by the run, which changes them; NULL for NULL */
BAUM_API const double *baum_simulation_q(const baum_simulation *simulation);
/** Present velocities.
 *  @param simulation  may be NULL
 *  @return  (nv) owned by the run, which changes them; NULL for NULL */
BAUM_API const double *baum_simulation_v(const baum_simulation *simulation);

/* ---- what comes out -------------------------------------------------------------------------- */

/** What a channel records. The number of columns is in parentheses. Units are m, rad, N, N m and s,
 *  or those of user coordinates and rows; a multiplier has J per unit of its row.
 *
 *  Accelerations, multipliers, reactions and efforts come from one solution of (5) at the present
 *  state, without stabilization terms. It is computed only if a channel needs it. */
typedef enum baum_quantity {
  BAUM_Q = 1,        /**< Positions (nq). */
  BAUM_V = 2,        /**< Velocities (nv). */
  BAUM_A = 3,        /**< Accelerations (nv). */
  BAUM_LAMBDA = 4,   /**< Multipliers of `joint`, or of all (nc). */
  BAUM_PHI = 5,      /**< Constraint violation of `joint`, or of all (nc). */
  BAUM_PHI_RATE = 6, /**< Phi' = J v - nu of `joint`, or of all (nc). */
  BAUM_ENERGY = 7,   /**< Kinetic and potential energy [J] (2). */
  /** Planar body: x, y of `point`, angle (3). Spatial body: x, y, z of `point`, quaternion (7).
   *  Other bodies: their q. */
  BAUM_BODY_POSE = 8,
  /** The velocities of BAUM_BODY_POSE. Spatial body: velocity of `point` and angular velocity, both
   *  in ground axes (6). */
  BAUM_BODY_VELOCITY = 9,
  /** Force and moment on body_b (3, in space 6), see planar.h and spatial.h. User constraints,
   *  gears, couplings: -J^T lambda on the velocities of their bodies. */
  BAUM_JOINT_REACTION = 10,
  /** Coordinate of a joint that has one, and its time derivative, the joint velocity (2). */
  BAUM_JOINT_COORDINATE = 11,
  BAUM_BODY_ACCELERATION = 12, /**< The derivatives of BAUM_BODY_VELOCITY. */
  /** Force [N] or torque [N m] of the driver `joint` on the coordinate it prescribes (1). Times the
   *  joint velocity, it is the power of the driver. */
  BAUM_DRIVE_EFFORT = 13,
  /** As in baum_energy_account [J] (12): kinetic, potential, loads, springs, dampers, user_forces,
   *  bodies, drivers, violation, projection, gains, residual. Requires the option energy_account.
   */
  BAUM_ENERGY_ACCOUNT = 14
} baum_quantity;

/** What to record: a group of columns. All channels of an array have the same struct_size. */
typedef struct baum_channel {
  size_t struct_size;     /**< Set by the default. Do not write. */
  baum_quantity quantity; /**< What it records. Default: 0, must be set. */
  baum_body_id body;      /**< For BAUM_BODY_*. Default: none. */
  /** For JOINT_* and DRIVE_EFFORT; optional for LAMBDA, PHI and PHI_RATE. Default: none. */
  baum_joint_id joint;
  /** [m] in body axes, for BAUM_BODY_*; z = 0 in the plane. Default: (0, 0, 0), the centre of mass.
   */
  double point[3];
  /** [-] For BAUM_JOINT_COORDINATE. Default: BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinate;
} baum_channel;

/** Set every field to its default.
 *  @param[out] channel      NULL is ignored
 *  @param      caller_size  sizeof *channel; no byte beyond it is written */
BAUM_API void baum_channel_init(baum_channel *channel, size_t caller_size);

/** Make a channel of the whole mechanism. @param quantity  what it records @return the channel */
static inline baum_channel baum_channel_of(baum_quantity quantity)
{
  baum_channel channel;
  baum_channel_init(&channel, sizeof channel);
  channel.quantity = quantity;
  return channel;
}

/** Make a channel of a body.
 *  @param quantity  what it records
 *  @param body      one of the mechanism
 *  @return  the channel */
static inline baum_channel baum_channel_of_body(baum_quantity quantity, baum_body_id body)
{
  baum_channel channel = baum_channel_of(quantity);
  channel.body = body;
  return channel;
}

/** Make a channel of a point of a body.
 *  @param quantity  what it records
 *  @param body      one of the mechanism
 *  @param x,y,z     [m] in body axes
 *  @return  the channel */
static inline baum_channel baum_channel_of_point(baum_quantity quantity, baum_body_id body,
                                                 double x, double y, double z)
{
  baum_channel channel = baum_channel_of_body(quantity, body);
  channel.point[0] = x;
  channel.point[1] = y;
  channel.point[2] = z;
  return channel;
}

/** Make a channel of a joint.
 *  @param quantity  what it records
 *  @param joint     one of the mechanism
 *  @return  the channel */
static inline baum_channel baum_channel_of_joint(baum_quantity quantity, baum_joint_id joint)
{
  baum_channel channel = baum_channel_of(quantity);
  channel.joint = joint;
  return channel;
}

/** Count the columns of all given channels.
 *  @param     mechanism  frozen
 *  @param[in] channels   (count) May be NULL if count is 0.
 *  @param     count      [-] >= 0
 *  @return  -1 if a channel is not valid; baum_message() says why */
BAUM_API int32_t baum_channels_width(const baum_mechanism *mechanism, const baum_channel *channels,
                                     int32_t count);

/** Determine which multipliers are unique at the present state. With redundant rows, joints can
 *  share forces in more than one way. BAUM_LAMBDA, BAUM_JOINT_REACTION and BAUM_DRIVE_EFFORT then
 *  report the multipliers of least norm, with lambda_i multiplied by |row i of J M^-1/2|. They
 *  balance the forces to a relative 1e-9.
 *  @param      simulation  the run
 *  @param[out] unique      (nc) per row, true if its multiplier is unique
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_SINGULAR, BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE,
 *           BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_unique_multipliers(baum_simulation *simulation, bool *unique);

/** Read channels at the present state.
 *  @param      simulation  the run
 *  @param[in]  channels    (count)
 *  @param      count       [-] >= 0
 *  @param[out] row         (baum_channels_width())
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT (of a channel), BAUM_ERR_STATE
 *           (BAUM_ENERGY_ACCOUNT without the option), BAUM_ERR_SINGULAR, BAUM_ERR_CALLBACK,
 *           BAUM_ERR_NOT_FINITE, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_get(baum_simulation *simulation, const baum_channel *channels,
                                         int32_t count, double *row);

/** Advance through times and record channels at each. A fixed-step method reaches times off its
 *  grid by a shorter step on a copy, so that sampling does not alter the motion. Afterwards the run
 *  is at the last time, as after baum_simulation_advance_to().
 *  @param      simulation  the run
 *  @param[in]  times       (n) [s] monotone; the first may be the present time
 *  @param      n           [-] >= 0
 *  @param[in]  channels    (count)
 *  @param      count       [-] >= 0
 *  @param[out] rows        (n x width)
 *  @param[out] done        [-] number of rows written, also on failure. May be NULL.
 *  @return  as baum_simulation_advance_to(); BAUM_ERR_STRUCT (of a channel), BAUM_ERR_STATE
 *           (BAUM_ENERGY_ACCOUNT without the option) */
BAUM_API baum_status baum_simulation_sample(baum_simulation *simulation, const double *times,
                                            int64_t n, const baum_channel *channels, int32_t count,
                                            double *rows, int64_t *done);

/** What a run has cost and how well it kept the constraints since it was created. */
typedef struct baum_counters {
  size_t struct_size; /**< Set by baum_simulation_counters(). */
  int64_t steps;      /**< [-] accepted. */
  int64_t rejected;   /**< [-] steps that failed an error test or an iteration. */
  /** [-] shorter steps of a fixed-step method to a requested time off its grid. */
  int64_t short_steps;
  /** [-] evaluations of the equations of motion, (7) or the residual of an implicit method. */
  int64_t evaluations;
  /** [-] factorizations of the matrix in (7) and of the matrices of IDA and CVODE. */
  int64_t factorizations;
  /** [-] the part of factorizations that chose new pivots, which may allocate memory. */
  int64_t full_factorizations;
  int64_t nonlinear_iterations; /**< [-] iterations of CVODE, IDA and kinematics. */
  int64_t restarts;             /**< [-] restarts of multistep and variable-step methods. */
  int64_t near_singular;        /**< [-] evaluations in which the matrix was close to singular. */
  int64_t warnings;             /**< [-] kinds of warnings, see baum_simulation_warning(). */
  double wall;                  /**< [s] wall time inside advance_to, step and sample. */
  double max_phi;               /**< [m or rad] largest |Phi| over all steps. */
  double max_phi_rate;          /**< [m/s or rad/s] largest |Phi'| over all steps. */
  baum_joint_id max_phi_joint;  /**< Joint of max_phi. */
  baum_joint_id max_phi_rate_joint; /**< Joint of max_phi_rate. */
  /** [m or rad] steady |Phi| that the gains leave, (alpha/beta^2) h max |gamma_i|. Only for the
   *  Euler methods with stable gains of at least 0.1/h, otherwise NaN. */
  double predicted_phi;
  double predicted_phi_rate; /**< [m/s or rad/s] the same for |Phi'|: (h/2) max |gamma_i|. */
  /** [J] change of kinetic plus potential energy since the start. It is not only the error of the
   *  method: the work of drivers, inputs and dampers also changes this energy. */
  double energy_change;
  /** [-] largest displacement of a body in the last assembly, in characteristic lengths or rad,
   *  without the motion of drivers to their initial values. */
  double start_change;
  double alpha; /**< [1/s] in use. */
  double beta;  /**< [1/s] in use. */
  /** [-] factor by which each step multiplies a violation in the long run. NaN without BAUMGARTE
   *  and with variable steps. */
  double spectral_radius;
  /** [1/s] decay rate of violations, -ln(spectral_radius) / h. It equals alpha for small gains with
   *  alpha = beta, is infinite for dead-beat gains and negative if violations grow. NaN if
   *  spectral_radius is. */
  double damping;
  int64_t near_singular_intervals; /**< [-] see baum_simulation_near_singular(). */
  /** [-] near-singular intervals after which the motion is or may be on another branch. */
  int64_t branch_warnings;
  /** [-] steps of rk8 and dp5 across a singular configuration, taken regardless of their error
   *  estimate. */
  int64_t forced_steps;
  /** [J] energy that the method itself has added so far, from the energy account. NaN without the
   *  option energy_account. */
  double energy_residual;
  int64_t doubts; /**< [-] kinds of warnings that doubt the motion. */
  /** [-] largest estimated global error of the positions since the start: lengths relative to the
   *  characteristic length, angles in radians. It is 0 while the local errors of fixed steps are
   *  negligible. NaN: unknown, because inputs change every few steps, or because the estimate
   *  failed or would cost too much. With variable steps it is NaN without the option error_check,
   *  except after a singularity crossing at a loose tolerance. */
  double error_estimate;
} baum_counters;

/** Read the counters.
 *  @param      simulation   the run
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE */
BAUM_API baum_status baum_simulation_counters(baum_simulation *simulation, baum_counters *out,
                                              size_t caller_size);

/** Where the energy of the mechanism came from since the start of the run or the last
 *  baum_simulation_set_state(); setting inputs and drivers does not reset the account. Positive
 *  work adds energy to the mechanism.
 *
 *  The residual is the energy error of the method. It falls with the step at the order of the
 *  method, or with the tolerance. If an evaluation fails, the account ends with a warning, and
 *  works and residual are NaN from then on. The account does not change the motion.
 *
 *  The account costs additional evaluations of (7) or (5) in each step: 3 with a fixed step, but 18
 *  with dp5 and 48 with rk8, which subdivide the step for the account; 4 with variable steps, but 7
 *  with rk8, including its interpolant. BAUMGARTE adds 2 to 4. */
typedef struct baum_energy_account {
  size_t struct_size; /**< Set by baum_simulation_energy_account(). */
  double kinetic;     /**< [J] present kinetic energy v^T M v / 2. */
  /** [J] present potential energy of gravity, linear springs, constant loads and user
   *  potentials. */
  double potential;
  double start; /**< [J] kinetic plus potential energy at the start. */
  /** [J] work of loads with an input or a torque, and of loads that follow their body. */
  double loads;
  double springs;     /**< [J] work of springs with a user law. */
  double dampers;     /**< [J] work of the dampers of linear springs. */
  double user_forces; /**< [J] work of user forces, without the change of their potential. */
  /** [J] work of the forces of user coordinates, without the change of their potential, plus the
   *  integral of v^T M' v / 2. The velocity terms of Lagrange's equations add nothing to this
   *  sum. */
  double bodies;
  double drivers; /**< [J] work of drivers and other rows that depend on time, from -nu^T lambda. */
  double violation;  /**< [J] work of violated constraints, from -Phi'^T lambda. */
  double projection; /**< [J] change of kinetic and potential energy by projections. */
  /** [J] work of the gains. It is part of drivers and violation, so do not add it. */
  double gains;
  double residual; /**< [J] kinetic + potential - start - all works except gains. */
  /** [-] evaluations of (5) and (7) for the account, which the counters exclude. */
  int64_t evaluations;
} baum_energy_account;

/** Read the energy account at the present state.
 *  @param      simulation   the run
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (the option energy_account is false),
 *           BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE */
BAUM_API baum_status baum_simulation_energy_account(baum_simulation *simulation,
                                                    baum_energy_account *out, size_t caller_size);

/** How a motion continues after a singular configuration, where branches of motion cross. */
typedef enum baum_branch {
  BAUM_BRANCH_CONTINUED = 1, /**< The motion continues smoothly. */
  /** The velocity has jumped: the motion is on another branch. Do not trust it. */
  BAUM_BRANCH_LEFT = 2,
  BAUM_BRANCH_UNKNOWN = 3 /**< The steps do not allow a decision. */
} baum_branch;

/** An interval in which a run was near a singular configuration. The pivot of a state is the
 *  smallest pivot of the equations of motion, relative to the largest such value of the run so far.
 *  It falls with the square of the distance from a singular configuration. In the interval the
 *  pivot is below 0.02, possibly only inside one step. After leaving the interval, the run lists it
 *  if the pivot fell below 1e-3, or stayed above only because of the constraint violation. */
typedef struct baum_near_singular {
  size_t struct_size; /**< Set by baum_simulation_near_singular(). */
  double begin;       /**< [s] end of the last step before the interval. */
  double end;         /**< [s] end of the first step after the interval. */
  double t;           /**< [s] time of the smallest pivot, which may be inside a step. */
  /** [-] smallest pivot, relative to the largest of the run so far. */
  double pivot;
  /** [-] difference between the velocity after the interval and the smooth continuation of the
   *  motion before it, relative to the size of the velocity. NaN: unknown. */
  double jump;
  double jump_error;   /**< [-] estimated error of jump; NaN: unknown. */
  baum_branch branch;  /**< How the motion continues. */
  baum_joint_id joint; /**< Joint whose rows have the smallest pivot; none if unknown. */
} baum_near_singular;

/** Read a near-singular interval. Runs of baum_kinematics() have none.
 *  @param      simulation   the run
 *  @param      k            0 to counters.near_singular_intervals - 1; the first 64 are kept
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_simulation_near_singular(const baum_simulation *simulation, int64_t k,
                                                   baum_near_singular *out, size_t caller_size);

/** Kinds of warnings. Kinds from 100 on doubt the motion: the result may be wrong by far more than
 *  its tolerance. The others are notes on a correct result. */
typedef enum baum_warning_code {
  BAUM_WARNING_REDUNDANT_ROWS = 1,    /**< Some multipliers are not unique. */
  BAUM_WARNING_GAINS = 2,             /**< The stability of the gains is not known. */
  BAUM_WARNING_NOISY_DERIVATIVES = 3, /**< rtol is below the error of difference quotients. */
  BAUM_WARNING_INDEX3 = 4,            /**< IDA at index 3: for comparison only. */
  BAUM_WARNING_LOOSE_VELOCITIES = 5,  /**< Ill-conditioned rows hardly determine the velocities. */
  BAUM_WARNING_ENERGY_ACCOUNT = 6,    /**< The energy account has ended. */
  BAUM_WARNING_ILL_CONDITIONED = 7,   /**< The equations of motion are close to singular. */
  BAUM_WARNING_SINGULARITY_CROSSED = 8, /**< The motion continues smoothly through a singularity. */
  BAUM_WARNING_BRANCH = 100,        /**< The motion may have left its branch at a singularity. */
  BAUM_WARNING_VIOLATION = 101,     /**< The constraint violation is too large. */
  BAUM_WARNING_CONTRADICTION = 102, /**< Omitted rows no longer follow from the others. */
  BAUM_WARNING_ACCURACY = 103,      /**< The estimated error of the motion is large. */
  BAUM_WARNING_SINGULAR_START = 104 /**< Several motions may leave the initial configuration. */
} baum_warning_code;

/** Name of a kind of warnings.
 *  @param code  any value
 *  @return  such as "branch"; NULL for unknown values */
BAUM_API const char *baum_warning_name(baum_warning_code code);

/** All warnings of one kind. */
typedef struct baum_warning {
  size_t struct_size;     /**< Set by baum_simulation_warning(). */
  baum_warning_code code; /**< Kind. */
  bool doubts_motion;     /**< The result may be wrong: code >= 100. */
  baum_joint_id joint;    /**< Joint of the first warning; all-zero: none. */
  double first;           /**< [s] time of the first warning. */
  double last;            /**< [s] time of the last warning. */
  int64_t count;          /**< [-] number of warnings of this kind. */
  char text[400];         /**< Message of the first warning, and the count. */
} baum_warning;

/** Read the warnings of one kind. A run keeps one entry per kind, in the order of the first
 *  warnings.
 *  @param      simulation   the run
 *  @param      k            0 to counters.warnings - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_simulation_warning(const baum_simulation *simulation, int64_t k,
                                             baum_warning *out, size_t caller_size);

/** Explain a run: formulation, integrator, gains and why, stability, solver, redundancy,
 *  tolerances.
 *  @param simulation  may be NULL
 *  @return  text owned by the run; NULL for NULL */
BAUM_API const char *baum_simulation_explain(const baum_simulation *simulation);

/** Message of this run's last failure, stop or warning.
 *  @param simulation  may be NULL
 *  @return  text owned by the run, initially ""; NULL for NULL */
BAUM_API const char *baum_simulation_message(const baum_simulation *simulation);

#ifdef __cplusplus
}
#endif

#endif
