/* SPDX-License-Identifier: BSD-3-Clause */
/* The common implementation of CVODE and IDA. Tables in cvode.c and ida.c define what differs
 * between the two. Only cvode.c, ida.c, sundials_driver.c and tests include this header, and only
 * if the build has SUNDIALS. */
#ifndef BAUM_I_INTEGRATE_SUNDIALS_DRIVER_H
#define BAUM_I_INTEGRATE_SUNDIALS_DRIVER_H

#include "integrate/sundials_common.h"

typedef enum baum_i_sundials_kind {
  BAUM_I_SUNDIALS_CVODE,
  BAUM_I_SUNDIALS_IDA
} baum_i_sundials_kind;

typedef void baum_i_sundials_complain_fn(int flag, const char *module, const char *function,
                                         char *text, void *user);

/* The table of CVODE or IDA. Functions that return int return a flag, which is 0 for success. */
typedef struct baum_i_sundials_package {
  baum_i_sundials_kind kind;

  /* Calls that differ between CVODE and IDA only in their names; set by BAUM_I_SUNDIALS_CALLS. */
  int (*set_complain)(void *memory, baum_i_sundials_complain_fn *function, void *user);
  int (*set_user)(void *memory, void *user);
  int (*set_weigh)(void *memory, int (*weigh)(N_Vector y, N_Vector weights, void *user));
  int (*set_max_step)(void *memory, sunrealtype step);
  int (*set_stop)(void *memory, sunrealtype stop);
  int (*get_time)(void *memory, sunrealtype *t);
  int (*get_step)(void *memory, sunrealtype *step); /* length of the next step */
  int (*get_last_step)(void *memory, sunrealtype *step);
  int (*get_derivative)(void *memory, sunrealtype t, int order, N_Vector out);
  int (*count_error_failures)(void *memory, long *count);
  int (*count_solver_failures)(void *memory, long *count);
  int (*count_setups)(void *memory, long *count);
  int (*count_iterations)(void *memory, long *count);
  void (*destroy)(void **memory); /* NULL is allowed */

  int (*size)(const baum_i_problem *problem); /* n, length of y */
  /* Complete run->y for a start at t. On entry, run->y contains (q, v), followed by zeros. NULL:
   * nothing to do. */
  baum_status (*complete_start)(baum_i_sundials *run, double t);
  /* returns run->memory, or NULL if out of memory */
  void *(*create)(int multistep, SUNContext context);
  int (*init)(baum_i_sundials *run);
  int (*weigh)(N_Vector y, N_Vector weights, void *run);
  int (*restart)(baum_i_sundials *run);
  /* Take one step towards target. On return, run->y contains the unknowns at the end of the step,
   * and *tau the time of this end. */
  int (*step)(baum_i_sundials *run, double target, double *tau);
  /* Free what the method's `open` and `attach` have allocated. If the creation of the run failed,
   * `open` and `attach` may not have been called. run->memory is freed before this call. */
  void (*close)(baum_i_sundials *run);
} baum_i_sundials_package;

/* An integrator of CVODE or IDA. */
typedef struct baum_i_sundials_method {
  const char *name; /* name in messages */
  const baum_i_sundials_package *package;
  baum_status (*open)(baum_i_sundials *run); /* creates further memory of a run; NULL: none */
  int multistep;                             /* CVODE: CV_ADAMS or CV_BDF */
  int (*attach)(baum_i_sundials *run);       /* sets solvers and options; called last */
} baum_i_sundials_method;

/* From SUNDIALS 7 on, the context has the error handler. In older versions CVODE and IDA each have
 * an error handler. */
#if SUNDIALS_VERSION_MAJOR >= 7
#define BAUM_I_SUNDIALS_SET_COMPLAIN(prefix) NULL
#else
#define BAUM_I_SUNDIALS_SET_COMPLAIN(prefix) prefix##SetErrHandlerFn
#endif

/* clang-format off */
#define BAUM_I_SUNDIALS_CALLS(prefix)                      \
  .set_complain = BAUM_I_SUNDIALS_SET_COMPLAIN(prefix),    \
  .set_user = prefix##SetUserData,                         \
  .set_weigh = prefix##WFtolerances,                       \
  .set_max_step = prefix##SetMaxStep,                      \
  .set_stop = prefix##SetStopTime,                         \
  .get_time = prefix##GetCurrentTime,                      \
  .get_step = prefix##GetCurrentStep,                      \
  .get_last_step = prefix##GetLastStep,                    \
  .get_derivative = prefix##GetDky,                        \
  .count_error_failures = prefix##GetNumErrTestFails,      \
  .count_solver_failures = prefix##GetNumStepSolveFails,   \
  .count_setups = prefix##GetNumLinSolvSetups,             \
  .count_iterations = prefix##GetNumNonlinSolvIters,       \
  .destroy = prefix##Free
/* clang-format on */

/* ---- operations of an integrator ---- */

/* The functions for the table baum_integrator. `table` points to a baum_i_sundials_method. The
 * memory of a run begins with a baum_i_sundials. */
baum_status baum_i_sundials_open_run(void *self, const void *table, const baum_i_problem *problem,
                                     const baum_i_state *start);
void baum_i_sundials_close_run(void *self);
baum_status baum_i_sundials_advance(void *self, const baum_i_problem *problem, baum_i_state *state);
baum_status baum_i_sundials_interpolate(void *self, const baum_i_problem *problem, double t,
                                        double *q, double *v);
baum_status baum_i_sundials_restart(void *self, const baum_i_problem *problem,
                                    const baum_i_state *state);
void baum_i_sundials_forget(void *self);
void baum_i_sundials_count(const void *self, baum_i_statistics *out);

/* clang-format off */
#define BAUM_I_SUNDIALS_OPERATIONS              \
  .open = baum_i_sundials_open_run,             \
  .close = baum_i_sundials_close_run,           \
  .advance = baum_i_sundials_advance,           \
  .interpolate = baum_i_sundials_interpolate,   \
  .restart = baum_i_sundials_restart,           \
  .forget = baum_i_sundials_forget,             \
  .statistics = baum_i_sundials_count
/* clang-format on */

#endif
