/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Runs: simulations of the motion of frozen mechanisms. This header declares baum_simulation (one
 *  run), the integrators, the options of a run, the functions that advance it, and its results.
 *
 *  Integrators: the description of each integrator lists the formulations that it offers. The first
 *  formulation of the list is the default. The words in parentheses after BAUMGARTE name the rule
 *  that chooses the gains by default (stabilization.h). baum_kinematics() has no formulations.
 *
 *  Counters: counters.steps stands for the field `steps` of baum_counters, which
 *  baum_simulation_counters() fills. The names of the other counters are written in the same way.
 *
 *  Failure: a run that fails stays at the end of its last successful step. You can still read time,
 *  q and v.
 *
 *  Threads: only one thread at a time may use a simulation, except that any thread may call
 *  baum_simulation_cancel(). Several simulations may share a mechanism.
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

/** A run of a mechanism. */
typedef struct baum_simulation baum_simulation;

/* ---- integrators ----------------------------------------------------------------------------- */

/** @return explicit Euler, order 1, fixed step. Formulations: BAUMGARTE (dead-beat), UNSTABILIZED,
 *          PROJECTION */
BAUM_API const baum_integrator *baum_euler(void);
/** @return semi-implicit (symplectic) Euler, order 1, fixed step. It updates the velocities first
 *          and moves the positions with the new velocities. Formulations: as for baum_euler() */
BAUM_API const baum_integrator *baum_semi_implicit_euler(void);
/** @return  explicit midpoint rule, order 2, fixed step. Formulations: PROJECTION, BAUMGARTE
 *           (auto), UNSTABILIZED
 */
BAUM_API const baum_integrator *baum_rk2(void);
/** @return Kutta's third-order method, fixed step. Formulations: as for baum_rk2() */
BAUM_API const baum_integrator *baum_rk3(void);
/** @return classical Runge-Kutta method, order 4, fixed step. Formulations: as for baum_rk2() */
BAUM_API const baum_integrator *baum_rk4(void);
/** A good choice for loose tolerances.
 *  @return  the embedded Runge-Kutta pair of Dormand and Prince, orders 5 and 4, explicit, with
 *           rtol or with a fixed step. Six evaluations of the accelerations per step. Formulations:
 *           PROJECTION, BAUMGARTE (auto), UNSTABILIZED */
BAUM_API const baum_integrator *baum_dp5(void);
/** The first choice if the forces are not stiff and rtol is 1e-5 or less.
 *  @return  DOP853 (Hairer, Norsett, Wanner 1993), a Runge-Kutta method of order 8 with error
 *           estimates of orders 5 and 3, explicit, with rtol or with a fixed step. Twelve
 *           evaluations of the accelerations per step, and three more if the step is interpolated.
 *           Formulations: as for baum_dp5() */
BAUM_API const baum_integrator *baum_rk8(void);
/** A method that uses past steps. As long as it does not have enough past steps, it takes steps
 *  with a Runge-Kutta method instead. This happens at the start, after a requested time that is not
 *  on the grid of steps, and after each restart (counters.restarts), for example at a break, after
 *  a reversal of the direction in time, and after baum_simulation_set_state(),
 *  baum_simulation_set_input() and baum_simulation_set_driver().
 *  @return  two-step Adams-Bashforth method, order 2, fixed step, one evaluation of the
 *           accelerations per step. Formulations: BAUMGARTE (best damping), UNSTABILIZED. The
 *           method does not offer PROJECTION, because past steps cannot be projected */
BAUM_API const baum_integrator *baum_ab2(void);
/** @return three-step Adams-Bashforth method, order 3. Otherwise it is like baum_ab2() */
BAUM_API const baum_integrator *baum_ab3(void);
/** @return four-step Adams-Bashforth method, order 4. Otherwise it is like baum_ab2() */
BAUM_API const baum_integrator *baum_ab4(void);
/** A method for long runs without dissipation. The error of the energy stays within a band of width
 *  O(h^2), where h is the step. The angular momentum of a free rigid body in space is conserved to
 *  rounding. After every step, Phi = 0 and Phi' = 0 are satisfied to rounding. The method refuses
 *  mass matrices that vary, and forces that depend on velocities, such as the forces of dampers and
 *  the gyroscopic moments of user coordinates. To find out whether the forces of user functions
 *  depend on velocities, a run calls the functions at a few states when it is created.
 *  @return  RATTLE, order 2, fixed step, symplectic. Formulation: INDEX3 */
BAUM_API const baum_integrator *baum_rattle(void);
/** A method for stiff forces, and for comparisons of methods with index 3. After every step, the
 *  constraints Phi = 0 are satisfied to rounding, and |Phi'| is of second order in the step.
 *  @return  generalized-alpha method with spectral radius 0.8 at infinite frequency, order 2, fixed
 *           step, implicit. Formulation: INDEX3 */
BAUM_API const baum_integrator *baum_generalized_alpha(void);
/** This method solves the implicit equations of a step by fixed-point iteration. It uses Newton's
 *  method only for the stiff terms that come from the gains. Stiff forces therefore limit its
 *  steps, but large gains do not. It does not offer PROJECTION, because CVODE projects only with
 *  BDF.
 *  @return  the Adams-Moulton method of SUNDIALS CVODE, with rtol. Formulations: BAUMGARTE (auto),
 *           UNSTABILIZED */
BAUM_API const baum_integrator *baum_cvode_adams(void);
/** A method for stiff forces. It solves the equations of a step by Newton's method, with a sparse
 *  Jacobian that contains the derivatives of all joints and forces. With PROJECTION, the method
 *  projects the state inside each step, before the error test.
 *  @return  the BDF method of SUNDIALS CVODE, with rtol. Formulations: PROJECTION, BAUMGARTE
 *           (auto), UNSTABILIZED */
BAUM_API const baum_integrator *baum_cvode_bdf(void);
/** A method for stiff forces, and for comparisons of formulations. Use INDEX3 only for such
 *  comparisons: with INDEX3, errors are far above the tolerance.
 *  @return  SUNDIALS IDA with rtol: BDF of variable order for the unknowns y = (q, v, lambda), or
 *           y = (q, v, lambda, mu) with GGL. Formulations: GGL, BAUMGARTE (auto),
 *           UNSTABILIZED, INDEX2, INDEX3 */
BAUM_API const baum_integrator *baum_ida(void);
/** A method for mechanisms whose drivers prescribe all degrees of freedom, so that Phi(q, t) = 0
 *  determines every coordinate. Other mechanisms are refused. At each requested time, the run
 *  solves Phi(q, t) = 0 to rounding. It follows the branch of solutions to which the initial
 *  configuration belongs, and never jumps to another branch. If the mechanism locks, or if branches
 *  cross, the run stops with BAUM_ERR_SINGULAR. The options formulation, gains, step, rtol and atol
 *  must not be given.
 *  @return  kinematics, without integration */
BAUM_API const baum_integrator *baum_kinematics(void);

/** Get an integrator by its number, for bindings and tables that list all integrators. A program
 *  that calls this function is linked with all integrators, including SUNDIALS.
 *  @param k  0, 1, ...
 *  @return  the integrator; NULL if there are at most k integrators */
BAUM_API const baum_integrator *baum_integrator_at(int32_t k);

/** Name of an integrator.
 *  @param integrator  may be NULL
 *  @return  such as "cvode_adams"; NULL if the argument is NULL */
BAUM_API const char *baum_integrator_name(const baum_integrator *integrator);
/** Order of accuracy of an integrator at a fixed step.
 *  @param integrator  may be NULL
 *  @return  0 for variable order and for NULL */
BAUM_API int32_t baum_integrator_order(const baum_integrator *integrator);
/** Tell whether an integrator takes the option `step`. @param integrator  may be NULL @return false
 *  for NULL */
BAUM_API bool baum_integrator_has_fixed_step(const baum_integrator *integrator);
/** Tell whether an integrator takes the option `rtol`. If it takes both `step` and `rtol`, set one
 *  of the two options. baum_kinematics() takes neither.
 *  @param integrator  may be NULL
 *  @return  false for NULL */
BAUM_API bool baum_integrator_has_variable_step(const baum_integrator *integrator);

/** Form of the equations of motion and of the constraints. Equations (5) and (7), which the values
 *  below mention, are on the page "docs/notation.md". */
typedef enum baum_formulation {
  BAUM_FORMULATION_DEFAULT = 0, /**< The first formulation that the integrator offers. */
  /** Equation (5), with J a = gamma. The constraint violation drifts. */
  BAUM_FORMULATION_UNSTABILIZED = 1,
  /** Equation (7), with J a = gamma - 2 alpha Phi' - beta^2 Phi. */
  BAUM_FORMULATION_BAUMGARTE = 2,
  /** Equation (5). After each step, q and v are projected onto the constraints. */
  BAUM_FORMULATION_PROJECTION = 3,
  BAUM_FORMULATION_INDEX2 = 4, /**< The constraints are J v = nu. Phi drifts slowly. */
  /** The constraints are J v = nu and Phi = 0 (Gear, Gupta, Leimkuhler 1985). */
  BAUM_FORMULATION_GGL = 5,
  BAUM_FORMULATION_INDEX3 = 6 /**< The constraints are Phi = 0. */
} baum_formulation;

/** Name of a formulation.
 *  @param formulation  any value
 *  @return  such as "baumgarte"; NULL for unknown values */
BAUM_API const char *baum_formulation_name(baum_formulation formulation);

/** Tell whether an integrator offers a formulation.
 *  @param integrator   may be NULL
 *  @param formulation  any value
 *  @return  false for NULL */
BAUM_API bool baum_integrator_offers(const baum_integrator *integrator,
                                     baum_formulation formulation);

/** The start of a run: how the run begins from the design configuration, which consists of the
 *  positions in the definitions of the bodies. */
typedef enum baum_start {
  /** Assemble the mechanism. The run is refused if assembly moves a body by more than a quarter of
   *  the characteristic length (mechanism.h), or by more than 1 rad. If the initial values of
   *  drivers differ from their values in the design configuration, a second attempt is made before
   *  the run is refused. The second attempt assembles the mechanism with the drivers at their
   *  values in the design configuration, and then moves the drivers to their initial values in
   *  small steps. The two limits apply to each of these steps. */
  BAUM_START_ASSEMBLE = 0,
  /** Refuse the run if the design configuration or the initial velocities violate the
   *  constraints. */
  BAUM_START_EXACT = 1,
  /** Start from the design configuration and the initial velocities as they are. Velocities that
   *  are not given are zero. The only bodies that are moved are those welded to ground, because the
   *  welds determine their poses. */
  BAUM_START_AS_GIVEN = 2
} baum_start;

/** Solver of the linear system for the accelerations and the multipliers, which is equation (7) of
 *  the page "docs/notation.md". baum_simulation_explain() states which solver a run uses, and why.
 *  The option `solver` affects neither assembly nor the multipliers of redundant rows: both are
 *  always computed with KLU and QR. */
typedef enum baum_solver {
  /** Use BLOCK if it is suitable for the mechanism. Use KLU or QR for other mechanisms, and in
   *  configurations where BLOCK is not accurate. */
  BAUM_SOLVER_AUTO = 0,
  /** Sparse LU factorization of the whole system. It keeps its pivot order as long as the pivots
   *  are large enough. */
  BAUM_SOLVER_KLU = 1,
  /** Sparse rank-revealing QR factorization. It is slow; use it for comparisons and for singular
   *  configurations. */
  BAUM_SOLVER_QR = 2,
  /** Schur complement in blocks. A block is a whole joint if the mechanism has spatial bodies but
   *  no user coordinates; otherwise it is a pair of rows. Close to singular configurations this
   *  solver is not accurate. No other solver then takes over, and the run fails with
   *  BAUM_ERR_SINGULAR. The solver is refused if a body has more than about 50 joints, if the
   *  joints form a dense network, or if the mass matrix is not positive definite. */
  BAUM_SOLVER_BLOCK = 3
} baum_solver;

/** A progress function. While a call advances a run, the run calls this function repeatedly, at
 *  intervals given by the option progress_interval. The first interval begins when the call begins.
 *  The function may read the run, also with baum_simulation_get(). Inside the function, calls that
 *  change, advance or save the run fail with BAUM_ERR_STATE, and baum_simulation_destroy() does
 *  nothing.
 *  @param simulation  the run
 *  @param t           [s] present time
 *  @param user        the option `user`
 *  @return  non-zero to cancel */
typedef int baum_progress_fn(const baum_simulation *simulation, double t, void *user);

/* ---- options --------------------------------------------------------------------------------- */

/** The options of a run. A variable-step integrator may step over a force or a law that begins late
 *  or acts only briefly, and thus not notice it. If the mechanism has such a force or law, set
 *  max_step or break times (breaks.h). */
typedef struct baum_simulation_options {
  size_t struct_size;                /**< Set by the default function. Do not write. */
  const baum_integrator *integrator; /**< The integration method. Default: NULL, must be set. */
  /** Form of the equations of motion. Default: BAUM_FORMULATION_DEFAULT. */
  baum_formulation formulation;
  baum_gains gains;    /**< Gain rule for BAUMGARTE. Default: BAUM_GAINS_DEFAULT. */
  bool allow_unstable; /**< Accept gains that are known to be unstable. Default: false. */
  double step;         /**< [s] > 0, length of a fixed step. Default: NaN, not given. */
  /** [-] > 0, < 1, tolerance of the local error, relative to the scales of q and v (mechanism.h).
   *  cvode_bdf divides rtol and atol by 6.9, and ida divides them by 3, so that all methods are
   *  about equally accurate at the same rtol. Both methods use a smaller divisor if division by 6.9
   *  or 3 would give an rtol below 1e-13. Default: NaN, not given. */
  double rtol;
  /** [unit of the coordinate] >= 0, absolute tolerance of the local error. It is added to rtol
   *  times the scale of the coordinate. Default: NaN, none. */
  double atol;
  /** [s] > 0, longest step of a variable-step integrator. If an event function passes zero twice
   *  within a quarter of a step, the run may miss both events; a smaller max_step prevents this.
   *  Default: NaN, none. */
  double max_step;
  double start_time; /**< [s] time at which the run starts. Default: 0. */
  baum_start start;  /**< How the run begins. Default: BAUM_START_ASSEMBLE. */
  /** Solver of the linear system for the accelerations and the multipliers.
   *  Default: BAUM_SOLVER_AUTO. */
  baum_solver solver;
  /** Check the derivatives of user functions. When the run is created,
   *  baum_mechanism_check_derivatives() checks them. During the run they are checked again: if the
   *  last check was after n steps of the run, the next one is after 2 n + 32 steps. A run that is
   *  advanced in a single call is thus checked after 32, 96, 224, 480, ... steps. At the end of a
   *  call that advances the run, they are also checked if the run has taken at least 1.5 n + 16
   *  steps since its start, or if this is the first check during the run. The checks during the run
   *  call the functions at states near those of the run. If a derivative is wrong there, the run
   *  warns with BAUM_WARNING_WRONG_DERIVATIVE. If a step fails, the derivatives are checked at the
   *  last good state, even without this option. If a derivative is wrong there, the message of the
   *  failed call names it. Default: true. */
  bool check_derivatives;
  /** [-] > 0, largest number of steps in one call that advances the run. A call that needs more
   *  steps fails. Default: 1000000000. */
  int64_t max_steps;
  baum_progress_fn *progress; /**< The run calls this function repeatedly. Default: NULL, none. */
  /** [s] of wall time, >= 0, between two calls of the progress function. Default: 0.05. */
  double progress_interval;
  void *user; /**< Passed to the function `progress`, not owned. Default: NULL. */
  /** [-] > 0, finite; rtol and atol are multiplied by this factor for positions. Refused with a
   *  fixed step. Default: 1.
   */
  double tolerance_q;
  /** [-] > 0, finite; rtol and atol are multiplied by this factor for velocities. Refused with a
   *  fixed step. Default: 1. */
  double tolerance_v;
  /** [-] > 0, may be infinite; rtol is multiplied by this factor for multipliers. A finite factor
   *  is accepted only by IDA with the formulation BAUMGARTE or UNSTABILIZED. The tolerance of the
   *  multiplier of row i is tolerance_lambda rtol E / n_i. Here n_i is the norm of row i of the
   *  Jacobian J, with each column j multiplied by the scale s_j of its coordinate. E is the larger
   *  of two numbers: the largest present value of |lambda_k| n_k, and the largest value of M_jj
   *  s_j^2 r^2, where M is the mass matrix and r [1/s] is the rate of the motion at the start. This
   *  rate is the largest of |v_j| / s_j and sqrt(|a_j| / s_j) over all coordinates j, where v are
   *  the velocities and a the accelerations. In an equilibrium at rest, r is sqrt(g/L) instead,
   *  where g is the acceleration of gravity and L the characteristic length. In an equilibrium at
   *  rest without gravity, r is 1 per second. baum_simulation_explain() reports r together with the
   *  tolerances. Default: infinity, the error of multipliers is not tested. */
  double tolerance_lambda;
  /** Compute the energy account that baum_simulation_energy_account() returns. The integrator
   *  baum_kinematics() refuses this option. Default: false. */
  bool energy_account;
  /** [-] (row_gain_count) factors f_i > 0. The gains of constraint row i are alpha f_i and
   *  beta f_i. Copied. Default: NULL, all 1. */
  const double *row_gains;
  /** [-] number of elements of row_gains; must be the number of constraint rows of the mechanism
   *  (nc) if row_gains is given. Default: 0. */
  int32_t row_gain_count;
  /** During the whole run, estimate the error of the motion by a second integration, and warn if
   *  the error is large; see error_estimate in baum_counters. If the run has a fixed step, the
   *  second integration uses rk8 with rtol = 1e-8. If the run has variable steps, the second
   *  integration uses the method of the run with 0.03 times its rtol, and the rtol of the run must
   *  be at least 2e-14. With variable steps, the cost of the run at least doubles. If the second
   *  integration fails, or takes more than ten times as many evaluations as the run, it ends, and
   *  the run warns (BAUM_WARNING_ERROR_UNKNOWN). The integrator baum_kinematics() refuses this
   *  option, because it does not integrate.
   *
   *  Without this option, a fixed-step run starts a second integration only if its step is long, or
   *  if the sum of its local errors becomes large enough to matter. Default: false. */
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

/** Create a run. This function assembles the mechanism, chooses and checks the gains, and prepares
 *  the integrator.
 *  @param      mechanism  frozen; it stays in memory as long as the simulation exists
 *  @param[in]  options    copied
 *  @param[out] out        receives the run, NULL on failure; release it with
 *                         baum_simulation_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE (not frozen),
 *           BAUM_ERR_UNSUPPORTED (the integrator does not offer the formulation or the gain rule,
 *           or is not in this build; kinematics was requested together with an energy account, or
 *           for a mechanism with degrees of freedom; RATTLE or BAUM_SOLVER_BLOCK cannot handle the
 *           mechanism), BAUM_ERR_INCONSISTENT, BAUM_ERR_SINGULAR, BAUM_ERR_UNSTABLE,
 *           BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE, BAUM_ERR_CONVERGENCE,
 *           BAUM_ERR_INTEGRATOR */
BAUM_API baum_status baum_simulation_create(const baum_mechanism *mechanism,
                                            const baum_simulation_options *options,
                                            baum_simulation **out);

/** Release a run. @param simulation  may be NULL */
BAUM_API void baum_simulation_destroy(baum_simulation *simulation);

/** Advance the run to time t, forward or backward. If t is the present time, nothing happens. A
 *  fixed-step method takes whole steps from the present time. If t is not on this grid of steps, a
 *  shorter last step follows (counters.short_steps counts it), and a new grid begins at t. A
 *  variable-step method steps past t and interpolates its last step, so the times that you request
 *  do not alter its steps.
 *  @param simulation  the run
 *  @param t           [s] finite
 *  @return  BAUM_OK, BAUM_WARNED, BAUM_STOP_CANCELLED, BAUM_STOP_EVENT, BAUM_STOP_TIME,
 *           BAUM_ERR_ARGUMENT, BAUM_ERR_SINGULAR, BAUM_ERR_STEP (also if max_steps is reached, or
 *           if the mean of 10000 successive variable steps is less than 1e-9 / r, where r [1/s] is
 *           the rate of the motion), BAUM_ERR_CONVERGENCE, BAUM_ERR_INTEGRATOR,
 *           BAUM_ERR_NOT_FINITE, BAUM_ERR_CALLBACK, BAUM_ERR_INCONSISTENT (kinematics: a driver
 *           jumps at a break), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_advance_to(baum_simulation *simulation, double t);

/** Take a number of whole steps forward in time.
 *  @param simulation  the run
 *  @param count       [-] > 0
 *  @return  as baum_simulation_advance_to() */
BAUM_API baum_status baum_simulation_step(baum_simulation *simulation, int64_t count);

/** Ask a run to stop after its present step. The call that advances the run then returns
 *  BAUM_STOP_CANCELLED, and the next call continues the run. If no call is advancing the run now,
 *  the next call that advances the run stops at once, and the call after it continues the run. This
 *  function may be called from any thread and from signal handlers.
 *  @param simulation  may be NULL */
BAUM_API void baum_simulation_cancel(baum_simulation *simulation);

/** Change the option progress_interval. The progress function itself may call this function. With
 *  an interval of 0, the progress function is called after every step from then on.
 *  @param simulation  the run
 *  @param interval    [s] of wall time, >= 0, finite
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (called by a callback other than the
 *           progress function) */
BAUM_API baum_status baum_simulation_set_progress_interval(baum_simulation *simulation,
                                                           double interval);

/** Limit the wall time of each call that advances the run. A call that takes longer finishes its
 *  present step and returns BAUM_STOP_TIME. Every call takes at least one step. The next call
 *  continues the run. Such stops change neither the motion nor the warnings of the run.
 *  @param simulation  the run
 *  @param limit       [s] of wall time, > 0; INFINITY means no limit, which is the default
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (called by a callback other than the
 *           progress function) */
BAUM_API baum_status baum_simulation_set_time_limit(baum_simulation *simulation, double limit);

/** Replace the time and the state of a run. Multistep methods restart. If all velocities are given,
 *  and the new state violates the constraints by no more than the run has violated them so far
 *  (counters.max_phi and counters.max_phi_rate), the new state is used as it is. Otherwise the
 *  option `start` decides whether the new state is assembled, refused or used as it is. The
 *  positions q determine angles of spatial joints only up to whole revolutions. Each such angle
 *  takes the possible value that is nearest to its last value. There is one exception: if a driver
 *  prescribes the angle, and t differs from the time of the run, the angle takes the possible value
 *  that is nearest to the value of the driver. To choose another possible value, call
 *  baum_simulation_set_angle() afterwards.
 *  @param     simulation  unchanged on failure
 *  @param     t           [s] finite
 *  @param[in] q           (nq) finite
 *  @param[in] v           (nv) finite; if `start` is BAUM_START_ASSEMBLE, NaN marks velocities that
 *                         assembly determines
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_INCONSISTENT, BAUM_ERR_SINGULAR,
 *           BAUM_ERR_CONVERGENCE (IDA), BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE,
 *           BAUM_ERR_INTEGRATOR, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_set_state(baum_simulation *simulation, double t,
                                               const double *q, const double *v);

/** Choose the number of whole revolutions in an angle of a spatial joint, for example after
 *  baum_simulation_set_state() has given a new run the state of another run in which a spring was
 *  wound up. The run restarts at its present state, as after baum_simulation_set_state(), and the
 *  angle has the possible value that is nearest to `angle`.
 *  @param simulation  unchanged on failure
 *  @param joint       a spatial joint
 *  @param coordinate  one of the angles of the joint; BAUM_COORDINATE_FIRST is allowed if the first
 *                     coordinate of the joint is an angle
 *  @param angle       [rad] finite
 *  @return  as baum_simulation_set_state() */
BAUM_API baum_status baum_simulation_set_angle(baum_simulation *simulation, baum_joint_id joint,
                                               baum_joint_coordinate coordinate, double angle);

/** Continue with the motion of another run. The present run takes over the time, state, inputs and
 *  laws of drivers of the other run. The present run keeps its own options, counters and warnings.
 *  A run with another integrator, formulation, tolerance or solver can thus continue where the
 *  other run has failed. The positions and velocities are changed only as much as is necessary to
 *  satisfy the constraints. They are not changed if the option `start` is BAUM_START_AS_GIVEN.
 *  @param simulation  unchanged on failure
 *  @param from        the other run. Its mechanism must be the same, or another one with the same
 *                     elements and the same numbers in their definitions
 *  @return  as baum_simulation_set_state(); BAUM_ERR_ARGUMENT also for another mechanism,
 *           BAUM_ERR_CONVERGENCE also if q and v cannot be moved onto the constraints */
BAUM_API baum_status baum_simulation_continue(baum_simulation *simulation,
                                              const baum_simulation *from);

/** Change an input from the present time on. If the input has a schedule, this call ends the
 *  schedule. The input keeps the value until it is changed again; baum_simulation_set_state() does
 *  not change it. If the input already has the new value, the run does not restart.
 *
 *  Variable-step methods restart with small steps (counters.restarts counts this). For control
 *  loops, use a fixed step. If you know the changes in advance, use
 *  baum_simulation_schedule_input().
 *  @param simulation  unchanged on failure
 *  @param input       an input of the mechanism
 *  @param value       finite
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_SINGULAR, BAUM_ERR_CONVERGENCE (IDA),
 *           BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE, BAUM_ERR_INTEGRATOR, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_set_input(baum_simulation *simulation, baum_input_id input,
                                               double value);

/** Read an input.
 *  @param simulation  may be NULL
 *  @param input       an input of the mechanism
 *  @return  present value of the input; NaN for NULL and for ids that are not inputs of the
 *           mechanism */
BAUM_API double baum_simulation_input(const baum_simulation *simulation, baum_input_id input);

/** Replace the law of a driver in this run. From the present time t0 on, the driver prescribes the
 *  value s + ds (t - t0) + dds (t - t0)^2 / 2 for its coordinate, until the next call for this
 *  driver. Variable-step methods restart (counters.restarts counts this).
 *
 *  The call itself does not change the state. If s differs from the present coordinate, or ds from
 *  its present velocity, the difference is a constraint violation. The formulation determines what
 *  happens to it:
 *  - With PROJECTION the state jumps at the end of the next step, and with GGL and INDEX3 during
 *    the next step.
 *  - With INDEX2 the velocity jumps, but the difference in s remains.
 *  - With BAUMGARTE the gains let the difference decay. If the gains are about 1/h, where h is the
 *    step, a jump of s causes velocities of about the jump divided by h.
 *  - With UNSTABILIZED the difference remains.
 *  - Kinematics moves to the nearest configuration on its branch, and fails if there is none
 *    nearby.
 *
 *  To avoid a jump of the position, let s be the present coordinate. To avoid a jump of the
 *  velocity, too, let ds be the present velocity of this coordinate, and change only dds.
 *  @param simulation  unchanged on failure
 *  @param driver      a driver of the mechanism
 *  @param s           [rad or m] finite, value at the present time t0
 *  @param ds          [rad/s or m/s] finite, velocity at t0
 *  @param dds         [rad/s^2 or m/s^2] finite, constant acceleration
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_INCONSISTENT (kinematics), BAUM_ERR_SINGULAR,
 *           BAUM_ERR_CONVERGENCE (IDA: the jump is too large), BAUM_ERR_CALLBACK,
 *           BAUM_ERR_NOT_FINITE, BAUM_ERR_INTEGRATOR, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_set_driver(baum_simulation *simulation, baum_joint_id driver,
                                                double s, double ds, double dds);

/* ---- save and restore ------------------------------------------------------------------------ */

/** Save a run into memory. The saved run contains time, q, v, the grid of steps, the gains in use,
 *  inputs and their schedules, laws of drivers, counters, warnings and the energy account.
 *
 *  Two things are not saved: the past steps that an integrator remembers, and the pivot order of
 *  KLU. Saving discards both, just as restoring does, so that the run and its restored copy
 *  continue identically, bit for bit. Multistep and variable-step methods therefore restart when a
 *  run is saved (counters.restarts counts this). KLU chooses new pivots in the next step, which may
 *  allocate memory. One-step methods with a fixed step do not remember past steps; with the block
 *  solver, such a run continues as if it had not been saved. Saving itself allocates no memory.
 *
 *  The buffer contains no pointers. You may copy it, keep it in a file and restore it in another
 *  process. It also contains a format version, its size, a checksum, and fingerprints of the
 *  mechanism and of the options. A library with another format version refuses the buffer.
 *  @param      simulation  the run
 *  @param[out] buffer      (capacity) bytes, with any alignment. If it is NULL, the function writes
 *                          only `size`, and does not change the run.
 *  @param      capacity    [byte] at least the size that a call with NULL returns. This size is
 *                          constant during a run, except that every scheduled change of an input
 *                          adds 32 bytes.
 *  @param[out] size        [byte] number of bytes written; if buffer is NULL, a number of bytes
 *                          that is sufficient
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (called by a callback); unchanged on failure
 */
BAUM_API baum_status baum_simulation_save(baum_simulation *simulation, void *buffer,
                                          size_t capacity, size_t *size);

/** Restore a saved run. `simulation` may be the run that was saved, or another run with the same
 *  mechanism and options, even in another process. With the same library on the same kind of
 *  processor, the restored run continues bit for bit as the saved run does.
 *
 *  The library checks that the mechanism of the saved run and the mechanism of this run have the
 *  same elements in the same order, with equal masses, points, stiffnesses and so on. It also
 *  checks that the two runs have the same events, and that the following options are equal:
 *  integrator, formulation, gains, row_gains, step, tolerances, max_step, solver, energy_account
 *  and error_check. Therefore add the events of the saved run to this run before restoring. The
 *  library cannot check user functions. They must be the same, and if they keep a state of their
 *  own, this state is not saved. The omitted redundant rows are those of the saved run, and so are
 *  the gains if a rule chooses them. Restoring allocates memory in three cases only: drivers were
 *  set in the saved run, the saved run has longer schedules than this run, or the two runs omit
 *  different redundant rows.
 *  @param     simulation  unchanged on failure
 *  @param[in] buffer      (size) bytes, with any alignment; bytes after the saved run are ignored
 *  @param     size        [byte] at least the size that baum_simulation_save() wrote
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_BUFFER (truncated, damaged, not a saved run, or of
 *           another version, mechanism or options; the message says which), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_restore(baum_simulation *simulation, const void *buffer,
                                             size_t size);

/** Present time. @param simulation  may be NULL @return [s] the time; NaN for NULL */
BAUM_API double baum_simulation_time(const baum_simulation *simulation);
/** Present positions.
 *  @param simulation  may be NULL
 *  @return  (nq) owned by the run; its values change when the run advances. NULL if the argument is
 *           NULL */
BAUM_API const double *baum_simulation_q(const baum_simulation *simulation);
/** Present velocities.
 *  @param simulation  may be NULL
 *  @return  (nv) owned by the run; its values change when the run advances. NULL if the argument is
 *           NULL */
BAUM_API const double *baum_simulation_v(const baum_simulation *simulation);

/* ---- results --------------------------------------------------------------------------------- */

/** A quantity that a channel records. The number of columns of each quantity is in parentheses. The
 *  point, body and joint of a channel are fields of baum_channel. Units are m, rad, N, N m and s.
 *  The units of user coordinates and user constraints are your choice. The unit of a multiplier is
 *  joule per unit of its row.
 *
 *  Accelerations, multipliers, reactions and efforts come from one solution of equation (5) of the
 *  page "docs/notation.md" at the present state. This equation contains no stabilization terms. The
 *  run computes this solution only if a channel needs it. */
typedef enum baum_quantity {
  BAUM_Q = 1,        /**< Positions (nq). */
  BAUM_V = 2,        /**< Velocities (nv). */
  BAUM_A = 3,        /**< Accelerations (nv). */
  BAUM_LAMBDA = 4,   /**< Multipliers of the channel's joint, or of all joints (nc). */
  BAUM_PHI = 5,      /**< Constraint violation of the channel's joint, or of all joints (nc). */
  BAUM_PHI_RATE = 6, /**< Phi' = J v - nu of the channel's joint, or of all joints (nc). */
  BAUM_ENERGY = 7,   /**< Kinetic and potential energy [J] (2). */
  /** Planar body: x and y of the channel's point, and the angle of the body (3). Spatial body: x, y
   *  and z of the channel's point, and the quaternion of the body (7). Particles and user
   *  coordinates: their part of q. */
  BAUM_BODY_POSE = 8,
  /** Planar body: the time derivatives of BAUM_BODY_POSE (3). Spatial body: velocity of the
   *  channel's point and angular velocity, both in ground axes (6). Particles and user coordinates:
   *  their part of v. */
  BAUM_BODY_VELOCITY = 9,
  /** Force and moment on body_b (3 for planar joints, 6 for spatial joints), see planar.h and
   *  spatial.h. For user constraints, gears and couplings: the generalized force -J^T lambda of
   *  their rows, with one number for each velocity of their bodies. */
  BAUM_JOINT_REACTION = 10,
  /** The coordinate of the joint that the channel's field `coordinate` selects, and the time
   *  derivative of this coordinate, the joint velocity (2). */
  BAUM_JOINT_COORDINATE = 11,
  BAUM_BODY_ACCELERATION = 12, /**< The time derivatives of BAUM_BODY_VELOCITY. */
  /** Force [N] or torque [N m] that a driver exerts on the coordinate it prescribes (1). The field
   *  `joint` of the channel is the driver. The power of the driver is this force or torque times
   *  the joint velocity. */
  BAUM_DRIVE_EFFORT = 13,
  /** The fields of baum_energy_account [J] (12): kinetic, potential, loads, springs, dampers,
   *  user_forces, bodies, drivers, violation, projection, gains, residual. Requires the option
   *  energy_account.
   */
  BAUM_ENERGY_ACCOUNT = 14
} baum_quantity;

/** A channel: a group of columns that a run records. All channels of an array must have the same
 *  struct_size. */
typedef struct baum_channel {
  size_t struct_size;     /**< Set by the default function. Do not write. */
  baum_quantity quantity; /**< What the channel records. Default: 0, must be set. */
  baum_body_id body;      /**< The body, for the quantities BAUM_BODY_*. Default: none. */
  /** The joint, for the quantities BAUM_JOINT_* and BAUM_DRIVE_EFFORT. For BAUM_LAMBDA, BAUM_PHI
   *  and BAUM_PHI_RATE the joint is optional: without it, the channel records the rows of all
   *  joints. Default: none. */
  baum_joint_id joint;
  /** [m] the point in body axes, for the quantities BAUM_BODY_*; z must be 0 for planar bodies.
   *  Default: (0, 0, 0), the centre of mass.
   */
  double point[3];
  /** [-] which coordinate of the joint, for BAUM_JOINT_COORDINATE. Default: BAUM_COORDINATE_FIRST.
   */
  baum_joint_coordinate coordinate;
} baum_channel;

/** Set every field to its default.
 *  @param[out] channel      NULL is ignored
 *  @param      caller_size  sizeof *channel; no byte beyond it is written */
BAUM_API void baum_channel_init(baum_channel *channel, size_t caller_size);

/** Make a channel for the whole mechanism.
 *  @param quantity  what the channel records
 *  @return  the channel */
static inline baum_channel baum_channel_of(baum_quantity quantity)
{
  baum_channel channel;
  baum_channel_init(&channel, sizeof channel);
  channel.quantity = quantity;
  return channel;
}

/** Make a channel for a body.
 *  @param quantity  what the channel records
 *  @param body      a body of the mechanism
 *  @return  the channel */
static inline baum_channel baum_channel_of_body(baum_quantity quantity, baum_body_id body)
{
  baum_channel channel = baum_channel_of(quantity);
  channel.body = body;
  return channel;
}

/** Make a channel for a point of a body.
 *  @param quantity  what the channel records
 *  @param body      a body of the mechanism
 *  @param x         [m] coordinate x of the point in body axes
 *  @param y         [m] coordinate y of the point in body axes
 *  @param z         [m] coordinate z of the point in body axes
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

/** Make a channel for a joint.
 *  @param quantity  what the channel records
 *  @param joint     a joint of the mechanism
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
 *  @return  number of columns; -1 if a channel is not valid, and baum_message() says why */
BAUM_API int32_t baum_channels_width(const baum_mechanism *mechanism, const baum_channel *channels,
                                     int32_t count);

/** Determine which multipliers are unique at the present state. If there are redundant rows, the
 *  joints can share the forces in more than one way, and some multipliers are not unique.
 *  BAUM_LAMBDA, BAUM_JOINT_REACTION and BAUM_DRIVE_EFFORT then report the multipliers of least
 *  norm. This norm weights each lambda_i with the length of row i of J M^(-1/2). These multipliers
 *  balance the forces with a relative error of at most 1e-9.
 *  @param      simulation  the run
 *  @param[out] unique      (nc) for each row, true if its multiplier is unique
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_SINGULAR, BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE,
 *           BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_unique_multipliers(baum_simulation *simulation, bool *unique);

/** Read channels at the present state.
 *  @param      simulation  the run
 *  @param[in]  channels    (count)
 *  @param      count       [-] >= 0
 *  @param[out] row         (baum_channels_width()); may be NULL if count is 0
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT (of a channel), BAUM_ERR_STATE
 *           (BAUM_ENERGY_ACCOUNT without the option energy_account), BAUM_ERR_SINGULAR,
 *           BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_simulation_get(baum_simulation *simulation, const baum_channel *channels,
                                         int32_t count, double *row);

/** Advance through given times and record channels at each of them. If a time is not on the grid of
 *  a fixed-step method, a copy of the state takes a shorter step to this time, so that sampling
 *  does not alter the motion. After the call the run is at the last time, as after
 *  baum_simulation_advance_to().
 *  @param      simulation  the run
 *  @param[in]  times       (n) [s] monotone; the first may be the present time
 *  @param      n           [-] >= 0
 *  @param[in]  channels    (count)
 *  @param      count       [-] >= 0
 *  @param[out] rows        (n x width) samples; width is baum_channels_width() of the channels
 *  @param[out] done        [-] number of rows written, also on failure. May be NULL.
 *  @return  as baum_simulation_advance_to(); BAUM_ERR_STRUCT (of a channel), BAUM_ERR_STATE
 *           (BAUM_ENERGY_ACCOUNT without the option energy_account) */
BAUM_API baum_status baum_simulation_sample(baum_simulation *simulation, const double *times,
                                            int64_t n, const baum_channel *channels, int32_t count,
                                            double *rows, int64_t *done);

/** Counters of a run: what the run has cost since it was created, and how well it has satisfied the
 *  constraints. */
typedef struct baum_counters {
  size_t struct_size; /**< Set by baum_simulation_counters(). */
  int64_t steps;      /**< [-] accepted steps. */
  /** [-] steps that were repeated, because an error test or an iteration failed. */
  int64_t rejected;
  /** [-] shorter steps that a fixed-step method took to reach a requested time or a break time that
   *  is not on its grid of steps. */
  int64_t short_steps;
  /** [-] evaluations of the equations of motion. Most methods solve equation (7) of the page
   *  "docs/notation.md" in each evaluation. IDA and generalized-alpha compute the residual of their
   *  equations instead. */
  int64_t evaluations;
  /** [-] factorizations of the matrix in equation (7) and of the matrices of IDA and CVODE. */
  int64_t factorizations;
  /** [-] factorizations that chose new pivots, which may allocate memory. */
  int64_t full_factorizations;
  /** [-] iterations of baum_kinematics() and of the implicit methods: CVODE, IDA, RATTLE and
   *  generalized-alpha. */
  int64_t nonlinear_iterations;
  int64_t restarts; /**< [-] restarts of multistep and variable-step methods. */
  /** [-] evaluations in which the matrix of the equations of motion was almost singular. */
  int64_t near_singular;
  int64_t warnings; /**< [-] number of kinds of warnings that occurred. */
  /** [s] wall time inside the functions that advance the run: baum_simulation_advance_to(),
   *  baum_simulation_step() and baum_simulation_sample(). */
  double wall;
  double max_phi;                   /**< [m or rad] largest violation |Phi| over all steps. */
  double max_phi_rate;              /**< [m/s or rad/s] largest rate |Phi'| over all steps. */
  baum_joint_id max_phi_joint;      /**< The joint with the violation max_phi. */
  baum_joint_id max_phi_rate_joint; /**< The joint with the violation max_phi_rate. */
  /** [m or rad] prediction of the steady |Phi| that the gains leave, (alpha/beta^2) h max
   *  |gamma_i|, where h is the step, and gamma is the right-hand side of J a = gamma. It is known
   *  only for the Euler methods with stable gains of at least 0.1/h, otherwise it is NaN. */
  double predicted_phi;
  /** [m/s or rad/s] prediction of the steady |Phi'| that the gains leave, (h/2) max |gamma_i|, with
   *  h and gamma as for predicted_phi. It is NaN in the same cases as predicted_phi. */
  double predicted_phi_rate;
  /** [J] change of kinetic plus potential energy since the start. It contains the error of the
   *  method, but also the work of drivers, inputs and dampers. */
  double energy_change;
  /** [-] largest displacement of a body in the last assembly, in characteristic lengths or rad. It
   *  includes the motion of drivers to their initial values if assembly makes this motion in a
   *  single step, but not if assembly makes it in several small steps. */
  double start_change;
  double alpha; /**< [1/s] Baumgarte's gain alpha in use. */
  double beta;  /**< [1/s] Baumgarte's gain beta in use. */
  /** [-] spectral radius of the gains: the factor by which each step multiplies a violation in the
   *  long run. NaN if the formulation is not BAUMGARTE, or if the steps are variable. */
  double spectral_radius;
  /** [1/s] decay rate of violations, -ln(spectral_radius) / h. For small gains with alpha = beta it
   *  is approximately alpha. It is infinite for dead-beat gains, and negative if violations grow.
   *  NaN if spectral_radius is NaN. */
  double damping;
  /** [-] number of intervals in which the run was near a singular configuration. */
  int64_t near_singular_intervals;
  /** [-] number of near-singular intervals after which the motion is, or may be, on another branch
   *  than before. */
  int64_t branch_warnings;
  /** [-] steps of rk8 and dp5 across a singular configuration. They are accepted although their
   *  error estimate is above the tolerance. */
  int64_t forced_steps;
  /** [J] energy that errors of the method have added so far, according to the energy account. NaN
   *  without the option energy_account. */
  double energy_residual;
  int64_t doubts; /**< [-] number of kinds of warnings that put the motion in doubt. */
  /** [-] estimate of the largest global error of the positions since the start. Errors of lengths
   *  are relative to the characteristic length, and errors of angles are in radians. NaN means that
   *  the error is unknown, for example because the estimate failed or would cost too much. Without
   *  the option error_check, the estimate shows only whether the error is large: values up to 0.01
   *  may be errors of the estimate itself. Without the option error_check, the estimate of a run
   *  with a fixed step is 0 as long as the local errors of the run are negligible, and NaN if
   *  inputs change every few steps. Without the option, the estimate of a run with variable steps
   *  is NaN, except after a singularity crossing at a loose tolerance. */
  double error_estimate;
} baum_counters;

/** Read the counters.
 *  @param      simulation   the run
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE */
BAUM_API baum_status baum_simulation_counters(baum_simulation *simulation, baum_counters *out,
                                              size_t caller_size);

/** The energy account of a run: where the energy of the mechanism came from. The account begins at
 *  the start of the run, and begins again at each call of baum_simulation_set_state(). Setting
 *  inputs and drivers does not reset it. Work is positive if it adds energy to the mechanism.
 *
 *  The residual is the part of the energy that no work explains; it is the energy error of the
 *  method. With a fixed step h, the residual is proportional to h^p for small h, where p is the
 *  order of the method. With variable steps, the residual decreases with the tolerance. If an
 *  evaluation for the account fails, the account ends with a warning. The work terms and the
 *  residual are then NaN. The account does not change the motion.
 *
 *  The account costs additional evaluations of the equations of motion in each step. With a fixed
 *  step, most methods need 3 additional evaluations per step. dp5 needs 18 and rk8 needs 48,
 *  because they subdivide the step for the account. With variable steps, most methods need 4; rk8
 *  needs 7, including the evaluations for its interpolant. With BAUMGARTE, add 2 to 4 evaluations
 *  per step to each of these numbers. */
typedef struct baum_energy_account {
  size_t struct_size; /**< Set by baum_simulation_energy_account(). */
  double kinetic;     /**< [J] present kinetic energy v^T M v / 2. */
  /** [J] present potential energy of gravity, linear springs, user potentials, and loads that are
   *  only a constant force in ground axes. */
  double potential;
  double start; /**< [J] kinetic plus potential energy at the start. */
  /** [J] work of the loads that have an input, a torque or a moment, or that follow their body. */
  double loads;
  double springs; /**< [J] work of springs with a user law. */
  /** [J] work of the dampers in bushings, and in springs and cables without a user law. */
  double dampers;
  /** [J] the part of the work of user forces that no potential explains: their whole work plus the
   *  change of their potential energy. */
  double user_forces;
  /** [J] work of the forces of user coordinates, plus the change of their potential energy, plus
   *  the integral of v^T M' v / 2. In this sum the velocity terms of Lagrange's equations cancel.
   */
  double bodies;
  /** [J] work of drivers and of other rows that depend on time: the integral of -nu^T lambda, where
   *  nu is the right-hand side of J v = nu. */
  double drivers;
  double violation;  /**< [J] work of violated constraints: the integral of -Phi'^T lambda. */
  double projection; /**< [J] change of kinetic and potential energy by projections. */
  /** [J] work of Baumgarte's gains. It is already contained in the fields `drivers` and
   *  `violation`, so do not add it to these fields. */
  double gains;
  /** [J] kinetic + potential - start, minus the sum of all work terms except gains. */
  double residual;
  /** [-] evaluations of the equations (5) and (7) (page "docs/notation.md") for the account. The
   *  counters of the run do not include them. */
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

/** The branch on which a motion continues after a singular configuration, where branches of motion
 *  cross. */
typedef enum baum_branch {
  BAUM_BRANCH_CONTINUED = 1, /**< The motion continues smoothly. */
  /** The velocity has jumped: the motion is on another branch. Do not trust the motion from then
   *  on. */
  BAUM_BRANCH_LEFT = 2,
  BAUM_BRANCH_UNKNOWN = 3 /**< The run cannot decide whether the motion has left its branch. */
} baum_branch;

/** A near-singular interval: an interval of time in which a run was near a singular configuration.
 *  To detect such intervals, a run computes the smallest pivot of the equations of motion at each
 *  state; the page "docs/theory/singular.md" defines this pivot. Let p be this smallest pivot,
 *  divided by the largest value that the smallest pivot has had at any state of the run so far.
 *  Close to a singular configuration, p is proportional to the square of the distance from this
 *  configuration. The interval consists of the times at which p is below 0.02, and may lie inside
 *  one step. When the run has left the interval, it adds the interval to its list if the Jacobian J
 *  of the constraints loses rank in the interval and p has fallen below 1e-3. If J loses rank, and
 *  only a constraint violation has kept p above 1e-3, the run adds the interval, too. */
typedef struct baum_near_singular {
  size_t struct_size; /**< Set by baum_simulation_near_singular(). */
  /** [s] time of the last state of the run before the interval, or of the first state if the run
   *  starts or restarts in the interval. */
  double begin;
  /** [s] time of the first state of the run after the interval. However, if the motion stays close
   *  to singular configurations, the run may list the interval before the motion has left it. The
   *  interval then continues after this time. */
  double end;
  double t; /**< [s] time at which p is smallest (see pivot); it may be inside a step. */
  /** [-] the smallest p in the interval. At each state, p is the smallest pivot of the equations of
   *  motion, divided by the largest value that the smallest pivot has had at any state of the run
   *  so far. The page "docs/theory/singular.md" defines the smallest pivot. */
  double pivot;
  /** [-] difference between the velocity after the interval and the velocity of a smooth
   *  continuation of the motion before the interval, relative to the size of the velocity. NaN:
   *  unknown. */
  double jump;
  double jump_error;   /**< [-] estimated error of the field `jump`; NaN: unknown. */
  baum_branch branch;  /**< How the motion continues after the interval. */
  baum_joint_id joint; /**< Joint whose rows have the smallest pivot; none if unknown. */
} baum_near_singular;

/** Read a near-singular interval: an interval of time in which the run was near a singular
 *  configuration. Runs with baum_kinematics() have no such intervals.
 *  @param      simulation   the run
 *  @param      k            number of the interval, 0 to counters.near_singular_intervals - 1; a
 *                           run keeps the first 64
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_simulation_near_singular(const baum_simulation *simulation, int64_t k,
                                                   baum_near_singular *out, size_t caller_size);

/** Kinds of warnings. A warning with a code of 100 or more puts the motion in doubt: the result may
 *  be wrong by far more than its tolerance. Warnings with smaller codes are notes, which do not put
 *  the motion in doubt. */
typedef enum baum_warning_code {
  BAUM_WARNING_REDUNDANT_ROWS = 1, /**< Some multipliers are not unique. */
  /** With the gains of the run, violations may grow, or not decay, or decay slowly. */
  BAUM_WARNING_GAINS = 2,
  /** The option rtol is smaller than the error of derivatives that are computed by finite
   *  differences. */
  BAUM_WARNING_NOISY_DERIVATIVES = 3,
  /** The run uses IDA with INDEX3, which is meant only for comparisons. */
  BAUM_WARNING_INDEX3 = 4,
  /** Ill-conditioned constraint rows make the computed velocities inaccurate. */
  BAUM_WARNING_LOOSE_VELOCITIES = 5,
  /** An evaluation for the energy account failed. The work terms and the residual of the account
   *  are NaN from then on. */
  BAUM_WARNING_ENERGY_ACCOUNT = 6,
  BAUM_WARNING_ILL_CONDITIONED = 7,     /**< The equations of motion are close to singular. */
  BAUM_WARNING_SINGULARITY_CROSSED = 8, /**< The motion continues smoothly through a singularity. */
  /** The error of the motion is unknown, because the second integration that estimates this error
   *  failed or became too expensive. */
  BAUM_WARNING_ERROR_UNKNOWN = 9,
  BAUM_WARNING_BRANCH = 100,    /**< The motion may have left its branch at a singularity. */
  BAUM_WARNING_VIOLATION = 101, /**< The constraint violation is too large. */
  /** Omitted redundant rows no longer follow from the other rows. */
  BAUM_WARNING_CONTRADICTION = 102,
  BAUM_WARNING_ACCURACY = 103, /**< The estimated error of the motion is large. */
  /** Several motions may start from the initial configuration. */
  BAUM_WARNING_SINGULAR_START = 104,
  /** The rotation of a bushing passed pi, where its moment jumps. The run also warns if the axes of
   *  a spatial torsion spring nearly pointed in opposite directions, and a step was too long to
   *  follow the angle of the spring. */
  BAUM_WARNING_BUSHING = 105,
  /** A user function returned a wrong derivative at a state of the run. */
  BAUM_WARNING_WRONG_DERIVATIVE = 106
} baum_warning_code;

/** Name of a kind of warnings.
 *  @param code  any value
 *  @return  such as "branch"; NULL for unknown values */
BAUM_API const char *baum_warning_name(baum_warning_code code);

/** All warnings of one kind in a run. */
typedef struct baum_warning {
  size_t struct_size;     /**< Set by baum_simulation_warning(). */
  baum_warning_code code; /**< Kind of the warnings. */
  bool doubts_motion;     /**< True if the result may be wrong: code >= 100. */
  /** Joint that the first warning names; all-zero if this warning names no joint. */
  baum_joint_id joint;
  double first;  /**< [s] time of the first warning. */
  double last;   /**< [s] time of the last warning. */
  int64_t count; /**< [-] number of warnings of this kind. */
  /** Message of the first warning, followed by the number of warnings. The text ends with the code
   *  and the name, such as "[warning 104 singular_start]". On the page "docs/cookbook/warnings.md",
   *  the section with the same code and name explains the warning and says what to do. */
  char text[400];
} baum_warning;

/** Read the warnings of one kind. A run keeps one entry per kind, in the order in which the kinds
 *  first occurred.
 *  @param      simulation   the run
 *  @param      k            number of the kind, 0 to counters.warnings - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_simulation_warning(const baum_simulation *simulation, int64_t k,
                                             baum_warning *out, size_t caller_size);

/** Explain a run in words: its formulation and integrator; its gains, why these gains were chosen
 *  and whether they are stable; its solver, redundant rows and tolerances.
 *  @param simulation  may be NULL
 *  @return  text owned by the run; NULL if the argument is NULL */
BAUM_API const char *baum_simulation_explain(const baum_simulation *simulation);

/** Message of this run's last failure, stop or warning.
 *  @param simulation  may be NULL
 *  @return  text owned by the run, initially ""; NULL if the argument is NULL */
BAUM_API const char *baum_simulation_message(const baum_simulation *simulation);

#ifdef __cplusplus
}
#endif

#endif
