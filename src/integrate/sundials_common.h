/* SPDX-License-Identifier: BSD-3-Clause */
/* Common parts of CVODE and IDA runs: vectors, equations, the order of the unknowns. Only files of
 * CVODE and IDA include it, and only when the build has SUNDIALS.
 *
 * SUNDIALS never prints: each run has its own context, and its error texts are kept here. */
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
  const struct baum_i_sundials_method *method;
  SUNContext context;
  N_Vector vectors[BAUM_I_SUNDIALS_VECTORS]; /* all vectors of a run, allocated together */
  int taken;                                 /* of them */
  double *numbers;                           /* their memory */
  void *memory;                              /* of CVODE or IDA */
  N_Vector y;                                /* end of the last step */
  N_Vector inside;                           /* interpolated */
  const double *present;                     /* q of the last evaluation */
  const baum_i_problem *problem;             /* of the call under way */
  bool unfinished;        /* since begin: a start or step that failed needs a restart */
  bool stops;             /* a stop time is set */
  bool stopped;           /* an evaluation of this call failed for good */
  baum_status evaluation; /* status of the last evaluation that failed, or BAUM_OK */
  double origin;          /* [s] SUNDIALS is told t - origin: a late start costs no digits */
  double t;               /* start of the step under way */
  double evaluated_at;    /* start of the step in which that evaluation failed */
  char message[BAUM_I_MESSAGE_SIZE];              /* of that evaluation */
  char complaint[BAUM_I_SUNDIALS_COMPLAINT_SIZE]; /* last one of SUNDIALS, "" for none */
  bool pivots_forgotten;                          /* KLU must choose pivots again */
  int64_t full_factorizations;                    /* times KLU chose pivots */
  baum_i_statistics before;                       /* counts up to the last restart */
} baum_i_sundials;

/* Create a context with a silent error handler and vectors of length n. Close it after everything
 * made with it; closing accepts zeroes. */
baum_status baum_i_sundials_open(baum_i_sundials *sundials, int n);
void baum_i_sundials_close(baum_i_sundials *sundials);

/* Take one of the vectors; what SUNDIALS clones from it comes from the same stock. Never fails for
 * the few of this library. */
N_Vector baum_i_sundials_vector(baum_i_sundials *sundials);

/* Keep an error text of SUNDIALS. */
void baum_i_sundials_complain(baum_i_sundials *sundials, const char *text);

/* The return value of a callback: 0, +1 if a smaller step may help, otherwise -1. Stores a
 * failure. */
int baum_i_sundials_answer(baum_i_sundials *sundials, baum_status status);

/* ---- y = (q, v) and y' = (N v, v'), the first nq + nv unknowns of every method ---- */

void baum_i_sundials_pack(const baum_mechanism *mechanism, const double *q, const double *v,
                          double *y);
void baum_i_sundials_unpack(const baum_mechanism *mechanism, const double *y, double *q, double *v);

/* y' at y, whose acceleration is workspace->a. */
void baum_i_sundials_pack_rate(const baum_workspace *workspace, const double *y, double *dy);

/* Newton's iterations solve for displacements dx of velocity size (nv) in place of dq (nq), at a q
 * near the manifold: dq = N dx + n, with n = 0 where q is a vector. */

/* Returns dx, valid until workspace->work_q is used again. work_q also holds n for the next
 * call. */
const double *baum_i_sundials_split(const baum_i_sundials *sundials, const double *q,
                                    const double *dq);
/* dq = N dx + factor n. */
void baum_i_sundials_join(const baum_i_sundials *sundials, const double *q, const double *dx,
                          double factor, double *dq);

/* The error weights of y, 1 / tolerance; a callback of CVODE and IDA. */
int baum_i_sundials_weigh(N_Vector y, N_Vector weights, void *run);

#endif
