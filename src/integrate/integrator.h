/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of operations that every integrator implements. Each integrator has a separate file, so
 * that a program links only the integrators that it calls.
 *
 * A fixed-step method only moves a state by h. The caller handles the time grid, projection,
 * monitors and output. A variable-step method takes one step, whose length it chooses, and can
 * interpolate inside its last step. Integrators evaluate the equations of motion only through a
 * problem (baum_i_problem), whose functions apply the formulation and the gains. */
#ifndef BAUM_I_INTEGRATE_INTEGRATOR_H
#define BAUM_I_INTEGRATE_INTEGRATOR_H

#include <baum/simulation.h>

#include "dynamics/dynamics.h"
#include "stabilization/amplification.h"

/* A problem: the equations to integrate, and the required accuracy. All members except direction,
 * stops and stop are constant during a run. */
typedef struct baum_i_problem {
  /* The members before `workspace` are saved with a run, because another processor may compute them
   * with different last digits. */
  double alpha;     /* [1/s] >= 0 */
  double beta;      /* [1/s] >= 0 */
  double direction; /* +1 forward, -1 backward in time; multiplies alpha */
  /* [1/s] > 0, 1/T, where T is the time scale of the motion; the rate times the scale of a
   * coordinate is a typical velocity */
  double rate;
  double max_step; /* [s] > 0, limit for variable steps; INFINITY: no limit */

  baum_workspace *workspace;
  baum_formulation formulation;
  double step;        /* [s] > 0 if the step is fixed; NaN: variable */
  double rtol;        /* NaN for fixed step */
  double atol;        /* >= 0 */
  double tolerance_q; /* [-] > 0, factor on rtol and atol for positions */
  double tolerance_v; /* [-] > 0, the same for velocities */
  /* [-] > 0, the same for multipliers; INFINITY excludes them from the error test */
  double tolerance_lambda;
  /* true if explicit methods with variable steps must refuse a step whose end the projection moves
   * far */
  bool distrusts_projection;
  bool stops;  /* variable step: a step ends exactly at `stop` */
  double stop; /* [s] a time that is ahead of the state by more than the rounding of times */
} baum_i_problem;

/* Time, positions, velocities. */
typedef struct baum_i_state {
  double t;
  double *q; /* (nq) */
  double *v; /* (nv) */
} baum_i_state;

/* Counts of a variable-step method since its creation. */
typedef struct baum_i_statistics {
  int64_t rejected;
  int64_t factorizations;      /* number of factorizations of the method's own matrix */
  int64_t full_factorizations; /* number of those that chose new pivots, and may allocate */
  int64_t nonlinear_iterations;
  /* steps over a singular configuration that were accepted with an error above the tolerance */
  int64_t forced;
} baum_i_statistics;

struct baum_integrator {
  const char *name;
  const void *table; /* passed to open(), to select one method of a family */
  int order;         /* 0: variable order */
  /* the default comes first; BAUM_FORMULATION_DEFAULT ends the list */
  baum_formulation formulations[6];
  baum_gain_rule gains;        /* the rule that BAUM_GAINS_DEFAULT means */
  baum_i_method method;        /* amplification of violations */
  baum_i_method_family family; /* only for methods of kind BAUM_I_METHOD_VARIABLE_STEP */
  /* BDF: the fraction of the error of a step that the error test measures; see integrator.c */
  double seen;
  /* true for both Euler methods, whose gains lead to a known steady violation: |Phi'| = (h/2)
   * |gamma| and |Phi| = (alpha/beta^2) h |gamma| */
  bool predicts_violation;
  /* true if the method solves the residual form, whose unknowns include multipliers */
  bool solves_residuals;
  /* true if the last evaluation in `advance` is that of the accelerations at the end of the step */
  bool evaluates_end;
  bool without_freedom; /* only for mechanisms without degrees of freedom; takes no formulation,
                           step or rtol */
  /* reason that messages give if projection is refused; NULL: none */
  const char *why_no_projection;
  bool tests_multipliers; /* tolerance_lambda may be finite at index 1 */

  /* Memory of a run. `open` initializes `memory` zeroed bytes and may fail with every status of a
   * run. `close` frees what `open` has allocated, even if `open` failed. Methods without memory
   * leave these three members zero. baum_i_integrator_create() and _destroy() call them. */
  size_t memory;
  baum_status (*open)(void *self, const void *table, const baum_i_problem *problem,
                      const baum_i_state *start);
  void (*close)(void *self);

  /* Fixed step: move state from t by h (signed). a is the acceleration at the start of the step
   * (nv), which the caller has evaluated through baum_i_problem_motion(); the caller also sets
   * state->t. NULL for methods that have only variable steps. If a method has both `step` and
   * `advance`, problem->step selects one. If a method has neither, it needs SUNDIALS, which the
   * build lacks. */
  baum_status (*step)(void *self, const baum_i_problem *problem, baum_i_state *state, double h,
                      const double *a);

  /* For methods with a fixed step that use past steps: accept the last step. A step that is not
   * accepted was only a trial. NULL for one-step methods. */
  void (*accept)(void *self, const baum_i_problem *problem, const baum_i_state *state);

  /* The next two functions are for variable steps. They are NULL for methods that have only fixed
   * steps. */
  /* Take one step in problem->direction. The method chooses its length. `state` receives the end of
   * the step. After a failure, `state` is the end of the last good step, from which the next call
   * restarts. */
  baum_status (*advance)(void *self, const baum_i_problem *problem, baum_i_state *state);
  /* Interpolate positions and velocities inside the last step. */
  baum_status (*interpolate)(void *self, const baum_i_problem *problem, double t, double *q,
                             double *v);
  /* Restart from a state, in problem->direction. Phi and Phi' in the workspace must afterwards be
   * those of this state, or as before. Allocates nothing. NULL for methods that do not use past
   * steps; not called if baum_i_integrator_remembers() is false. */
  baum_status (*restart)(void *self, const baum_i_problem *problem, const baum_i_state *state);
  /* Make the next step restart from its given state and with new pivots, so that nothing depends on
   * earlier steps. Neither evaluates nor allocates. Required if `restart` is given. */
  void (*forget)(void *self);
  void (*statistics)(const void *self, baum_i_statistics *out);
};

/* Return alpha with the sign of the direction, and beta [1/s]. Both are 0 if the formulation has no
 * gains. */
void baum_i_problem_gains(const baum_i_problem *problem, double *alpha, double *beta);

/* Find a and lambda at a state by the equations of the formulation. Results are in workspace->a and
 * ->lambda. */
baum_status baum_i_problem_acceleration(const baum_i_problem *problem, double t, const double *q,
                                        const double *v);

/* Find only a, by the same equations. Fixed bodies may be skipped. */
baum_status baum_i_problem_motion(const baum_i_problem *problem, double t, const double *q,
                                  const double *v);

/* Tell whether steps are fixed. If not, they are variable, or the method is kinematics. */
bool baum_i_problem_has_fixed_step(const baum_i_problem *problem);

/* Tell whether a step h from t is a step of the fixed grid, up to the rounding of times. Multistep
 * methods can keep their past steps only after such a step. */
bool baum_i_problem_is_grid_step(const baum_i_problem *problem, double t, double h);

/* Set the tolerances of all coordinates for variable-step methods; integrator.c gives the
 * equations. */
void baum_i_problem_tolerances(const baum_i_problem *problem, const double *v, double *tolerance_q,
                               double *tolerance_v);

/* Express the value of each row as a scaled displacement, using J of the workspace, and write the
 * absolute values to workspace->work_c (nc). Returns the largest of them. *row receives the row of
 * the largest one, or -1 if there are no rows. */
double baum_i_row_sizes(baum_workspace *workspace, const double *rows, int *row);

/* Return the factor, <= 1, by which rtol and atol are multiplied for the error test of a method. */
double baum_i_integrator_portion(const baum_integrator *integrator, double rtol);

/* Tell whether a run uses past steps, so that it must be restarted after jumps. */
bool baum_i_integrator_remembers(const baum_integrator *integrator, const baum_i_problem *problem);

/* Fail with the message of a failed evaluation, followed by the start t and the length h of the
 * step. h is 0 if no step had begun. */
baum_status baum_i_fail_in_step(baum_status status, const char *message, const char *integrator,
                                double t, double h);

/* Fail with BAUM_ERR_CONVERGENCE, because an iteration in the step from t does not converge. `what`
 * names the iteration in the message, and size is its last change relative to the scale. */
baum_status baum_i_fail_iteration(const char *integrator, const char *what, double t, double size);

/* Create the memory of a run. *out is NULL for a method without memory, and on failure. */
baum_status baum_i_integrator_create(const baum_integrator *integrator,
                                     const baum_i_problem *problem, const baum_i_state *start,
                                     void **out);
void baum_i_integrator_destroy(const baum_integrator *integrator, void *self); /* NULL is allowed */

/* Tell whether the integrator offers this formulation. */
bool baum_i_integrator_offers(const baum_integrator *integrator, baum_formulation formulation);

/* Return the version of SUNDIALS, such as "6.4.1", or "none" in a build without SUNDIALS. */
const char *baum_i_sundials_version(void);

#endif
