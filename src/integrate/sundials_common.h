/* SPDX-License-Identifier: BSD-3-Clause */
/* What runs of CVODE and IDA have in common, and the differences between SUNDIALS 6.4 and 7. Only cvode.c, ida.c
 * and sundials_common.c include it, and only when the build has SUNDIALS.
 *
 * SUNDIALS never prints: each run has a context of its own, and its complaints are kept here.
 */
#ifndef BAUM_I_INTEGRATE_SUNDIALS_COMMON_H
#define BAUM_I_INTEGRATE_SUNDIALS_COMMON_H

#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>

#include "base/message.h"
#include "integrate/integrator.h"

enum { BAUM_I_SUNDIALS_COMPLAINT_SIZE = 256, BAUM_I_SUNDIALS_VECTORS = 40 };

/* First member of a run. */
typedef struct baum_i_sundials {
  const char *integrator; /* name in messages */
  SUNContext context;
  N_Vector vectors[BAUM_I_SUNDIALS_VECTORS]; /* all that a run needs, made at once */
  int taken;                                 /* of them */
  double *numbers;                           /* their memory */
  const baum_i_problem *problem;             /* of the call under way */
  bool unfinished;        /* since begin: a start or step that failed must be begun anew */
  bool stopped;           /* an evaluation of this call failed for good */
  baum_status evaluation; /* the last failing one here and now, or BAUM_OK */
  double origin;          /* [s] SUNDIALS is told t - origin: a late start costs no digits */
  double t;               /* start of the step under way */
  double evaluated_at;    /* start of the step in which that evaluation failed */
  char sentence[BAUM_I_MESSAGE_SIZE];             /* of that evaluation */
  char complaint[BAUM_I_SUNDIALS_COMPLAINT_SIZE]; /* last one of SUNDIALS, "" for none */
} baum_i_sundials;

/* What a flag of CVODE or IDA means. */
typedef struct baum_i_sundials_flag {
  int flag;
  baum_status status;
  const char *meaning; /* and advice; begins in lower case */
} baum_i_sundials_flag;

/* Context with a silent error handler and vectors of length n; close it after everything made with it. Closing
 * accepts zeroes. */
baum_status baum_i_sundials_open(baum_i_sundials *sundials, const char *integrator, int n);
void baum_i_sundials_close(baum_i_sundials *sundials);

/* One of the vectors; what SUNDIALS clones from it comes from the same stock. Never fails for our own few. */
N_Vector baum_i_sundials_vector(baum_i_sundials *sundials);

/* Before a start at t; before a step from t. Clear `unfinished` after success. */
void baum_i_sundials_begin(baum_i_sundials *sundials, const baum_i_problem *problem, double t);
void baum_i_sundials_begin_step(baum_i_sundials *sundials, const baum_i_problem *problem, double t);

/* What a callback answers: 0, +1 where a smaller step may help, else -1. Remembers a failure. */
int baum_i_sundials_answer(baum_i_sundials *sundials, baum_status status);

/* From a flag to a status with its sentence; a remembered evaluation comes first. flags end with flag 0. */
baum_status baum_i_sundials_fail(const baum_i_sundials *sundials, const baum_i_sundials_flag *flags,
                                 int flag, double step);

/* After a step between two times of SUNDIALS: BAUM_ERR_STEP when it did not move. */
baum_status baum_i_sundials_check_progress(const baum_i_sundials *sundials, double before,
                                           double after);

/* The time of SUNDIALS that is t, put into its last step, which ends at `end`, where it is off by the rounding of t; NaN
 * where it is outside. */
double baum_i_sundials_inside(const baum_i_sundials *sundials, double t, double end, double last);

/* For a time that is not inside the last step. */
baum_status baum_i_sundials_fail_outside(const baum_i_sundials *sundials, double t);

/* A target beyond the first step, in problem->direction: CVODE and IDA take the direction from it, and its distance
 * bounds the first step to a tenth of 10 T. */
double baum_i_sundials_target(const baum_i_problem *problem, double t);

/* Weights of q and v in error norms, 1 / tolerance; one after the other. */
void baum_i_sundials_weights(const baum_i_problem *problem, const double *v, double *weights);

/* q and v, the first of a vector's numbers. */
void baum_i_sundials_unload(const baum_i_problem *problem, N_Vector from, double *q, double *v);

/* ---- 6.4 and 7 ---- */

#if SUNDIALS_VERSION_MAJOR >= 7
/* The context's handler serves all. */
#define BAUM_I_SUNDIALS_SILENCE(set_handler, memory, sundials) 0
#else
/* Each integrator has its own. */
#define BAUM_I_SUNDIALS_SILENCE(set_handler, memory, sundials) \
  set_handler(memory, baum_i_sundials_handle_error, sundials)

void baum_i_sundials_handle_error(int flag, const char *module, const char *function, char *text,
                                  void *user);
#endif

#endif
