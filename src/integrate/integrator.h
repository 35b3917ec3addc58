/* SPDX-License-Identifier: BSD-3-Clause */
/* Integrators behind one ops table. Each has a file of its own, so that a program links only those
 * it calls.
 *
 * A fixed-step method moves a state by h; the caller owns grid, projection, monitors and output. A
 * variable-step method takes one step of its own length and interpolates inside its last one.
 * Integrators reach the equations only through a problem, whose functions apply the formulation and
 * the gains. */
#ifndef BAUM_I_INTEGRATE_INTEGRATOR_H
#define BAUM_I_INTEGRATE_INTEGRATOR_H

#include <baum/simulation.h>

#include "dynamics/dynamics.h"
#include "stabilization/amplification.h"

/* The equations to integrate, and the accuracy. Constant except for direction and stop. */
typedef struct baum_i_problem {
  /* The members up to `workspace` are saved with a run, because they may differ in the last digits
   * on another processor. */
  double alpha;     /* [1/s] >= 0 */
  double beta;      /* [1/s] >= 0 */
  double direction; /* +1 forward, -1 backward in time: alpha carries it */
  double rate;      /* [1/s] > 0, 1/T: velocities are measured against scale x rate */
  double max_step;  /* [s] > 0, INFINITY for none; variable step */

  baum_workspace *workspace;
  baum_formulation formulation;
  double step;             /* [s] > 0, or NaN: variable */
  double rtol;             /* NaN for fixed step */
  double atol;             /* >= 0 */
  double tolerance_q;      /* [-] > 0, factors on rtol and atol */
  double tolerance_v;      /* [-] > 0 */
  double tolerance_lambda; /* [-] > 0, INFINITY: multipliers are outside of the error test */
  /* explicit variable step: refuse steps whose end the projection moves far */
  bool distrusts_projection;
  bool stops;  /* variable step: no step passes `stop`, and one ends there */
  double stop; /* [s] ahead in direction, by more than the rounding of times */
} baum_i_problem;

/* Time, positions, velocities. */
typedef struct baum_i_state {
  double t;
  double *q; /* (nq) */
  double *v; /* (nv) */
} baum_i_state;

/* What a variable-step method has done since it was created. */
typedef struct baum_i_statistics {
  int64_t rejected;
  int64_t factorizations;      /* of its own matrix */
  int64_t full_factorizations; /* those that chose pivots again and may allocate */
  int64_t nonlinear_iterations;
  int64_t forced; /* accepted whatever their error estimate, over a singular configuration */
} baum_i_statistics;

struct baum_integrator {
  const char *name;
  const void *table;                /* for open(): which method of a family */
  int order;                        /* 0: variable */
  baum_formulation formulations[6]; /* default first, ends with BAUM_FORMULATION_DEFAULT */
  baum_gain_rule gains;             /* meaning of BAUM_GAINS_DEFAULT */
  baum_i_method method;             /* amplification */
  baum_i_method_family family;      /* of methods without one */
  double seen;             /* BDF: tested fraction of the error that a step adds to the motion */
  bool predicts_violation; /* steady violation of both Eulers: (h/2)|gamma|, (alpha/beta^2) h
                              |gamma| */
  /* integrates the whole system; otherwise it uses accelerations or configurations */
  bool solves_residuals;
  bool without_freedom; /* for mechanisms without freedom alone; takes no formulation, step or
                           rtol */
  const char *why_no_projection; /* where it is refused; NULL: nothing to say */
  bool tests_multipliers;        /* at index 1 tolerance_lambda may be finite */

  /* Memory of a run: `open` fills `memory` zeroed bytes and may fail with every status of a run,
   * `close` frees what `open` has made so far. Methods without memory have none of the three.
   * baum_i_integrator_create() and _destroy() call them. */
  size_t memory;
  baum_status (*open)(void *self, const void *table, const baum_i_problem *problem,
                      const baum_i_state *start);
  void (*close)(void *self);

  /* Fixed step: move state from t by h (signed). a is the acceleration at the start of the step
   * (nv), which the caller has evaluated through baum_i_problem_motion(); the caller also sets
   * state->t. NULL for methods with variable steps only. A method with both this and `advance` uses
   * the one that problem->step selects. A method with neither needs SUNDIALS, which the build
   * lacks. */
  baum_status (*step)(void *self, const baum_i_problem *problem, baum_i_state *state, double h,
                      const double *a);

  /* Fixed step, methods with a history: accept the last step, which may have been a trial until
   * now. NULL for one-step methods. */
  void (*accept)(void *self, const baum_i_problem *problem, const baum_i_state *state);

  /* Variable step; NULL for methods with fixed steps only. */
  /* Take one step of its own length in problem->direction; state receives its end. On failure the
   * state is that of the last good step, from which the next call restarts. */
  baum_status (*advance)(void *self, const baum_i_problem *problem, baum_i_state *state);
  /* Interpolate positions and velocities inside the last step. */
  baum_status (*interpolate)(void *self, const baum_i_problem *problem, double t, double *q,
                             double *v);
  /* Restart from a state, in problem->direction. Allocates nothing. NULL for methods without
   * history; not called if baum_i_integrator_remembers() is false. */
  baum_status (*restart)(void *self, const baum_i_problem *problem, const baum_i_state *state);
  /* Restart at the next step, from its given state and with new pivots, so that nothing depends on
   * earlier steps. Neither evaluates nor allocates. Required if `restart` is given. */
  void (*forget)(void *self);
  void (*statistics)(const void *self, baum_i_statistics *out);
};

/* alpha with the sign of the direction, and beta [1/s]; 0 if the formulation has no gains. */
void baum_i_problem_gains(const baum_i_problem *problem, double *alpha, double *beta);

/* Find a and lambda at a state as the formulation says, in workspace->a and ->lambda. */
baum_status baum_i_problem_acceleration(const baum_i_problem *problem, double t, const double *q,
                                        const double *v);

/* Find a alone, for methods that use nothing else; fixed bodies may be skipped. */
baum_status baum_i_problem_motion(const baum_i_problem *problem, double t, const double *q,
                                  const double *v);

/* Are the steps fixed? Otherwise they are variable, or the method is kinematics. */
bool baum_i_problem_has_fixed_step(const baum_i_problem *problem);

/* Is h from t a step of the fixed grid, up to the rounding of times? The history of multistep
 * methods is only valid for such steps. */
bool baum_i_problem_is_grid_step(const baum_i_problem *problem, double t, double h);

/* Tolerances of all coordinates for variable-step methods: positions rtol scale + atol, velocities
 * rtol scale max(rate, present size) + atol with the present size max_i |v_i| / scale_i, times
 * their factors. */
void baum_i_problem_tolerances(const baum_i_problem *problem, const double *v, double *tolerance_q,
                               double *tolerance_v);

/* |rows_i| of each row as a displacement of its scales into workspace->work_c (nc), at the point of
 * the workspace, where J is; the largest of them, and its row or -1. */
double baum_i_row_sizes(baum_workspace *workspace, const double *rows, int *row);

/* Fraction of rtol and atol that the error test of a method uses, <= 1. */
double baum_i_integrator_portion(const baum_integrator *integrator, double rtol);

/* Does a run have a history, so that it needs restarts? */
bool baum_i_integrator_remembers(const baum_integrator *integrator, const baum_i_problem *problem);

/* Add the step of length h from t to the message of an evaluation that failed in it. h is 0 if no
 * step had begun. */
baum_status baum_i_fail_in_step(baum_status status, const char *message, const char *integrator,
                                double t, double h);

/* Fail with BAUM_ERR_CONVERGENCE in a step from t. `what` does not converge; size is its last
 * change relative to the scale. */
baum_status baum_i_fail_iteration(const char *integrator, const char *what, double t, double size);

/* Create the memory of a run; *out = NULL for a method without memory, and on failure. */
baum_status baum_i_integrator_create(const baum_integrator *integrator,
                                     const baum_i_problem *problem, const baum_i_state *start,
                                     void **out);
void baum_i_integrator_destroy(const baum_integrator *integrator, void *self); /* NULL is fine */

/* Does the integrator offer this formulation? */
bool baum_i_integrator_offers(const baum_integrator *integrator, baum_formulation formulation);

/* Version such as "6.4.1"; "none" in a build without SUNDIALS. */
const char *baum_i_sundials_version(void);

#endif
