/* SPDX-License-Identifier: BSD-3-Clause */
/* Common parts of CVODE and IDA runs: vectors, equations, the order of the unknowns. Only files of
 * CVODE and IDA include this header, and only if the build has SUNDIALS.
 *
 * SUNDIALS never prints: each run has its own context, and SUNDIALS' error texts are stored in
 * `complaint`. */
#ifndef BAUM_I_INTEGRATE_SUNDIALS_COMMON_H
#define BAUM_I_INTEGRATE_SUNDIALS_COMMON_H

#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>

#include "base/message.h"
#include "integrate/integrator.h"

enum { BAUM_I_SUNDIALS_COMPLAINT_SIZE = 256, BAUM_I_SUNDIALS_VECTORS = 40 };

/* First member of the memory of a run. */
typedef struct baum_i_sundials {
  const struct baum_i_sundials_method *method;
  SUNContext context;
  N_Vector vectors[BAUM_I_SUNDIALS_VECTORS]; /* all vectors of a run, allocated together */
  int taken;                                 /* number of vectors in use */
  double *numbers;                           /* memory of the numbers of all vectors */
  void *memory;                              /* memory object of CVODE or IDA */
  N_Vector y;                                /* unknowns at the end of the last step */
  N_Vector inside;                           /* unknowns at an interpolated time */
  const double *present;                     /* q of the last evaluation */
  const baum_i_problem *problem;             /* problem of the present call */
  bool unfinished;                           /* a start or step failed, so the next step restarts */
  bool stops;                                /* a stop time has been set */
  bool stopped;                              /* an evaluation failed and no smaller step can help */
  baum_status evaluation; /* status of the last evaluation that failed, or BAUM_OK */
  double origin;          /* [s] SUNDIALS' time is t - origin, to keep digits after a late start */
  double t;               /* start of the present step */
  double evaluated_at;    /* start of the step in which the last failed evaluation occurred */
  char message[BAUM_I_MESSAGE_SIZE];              /* message of the last evaluation that failed */
  char complaint[BAUM_I_SUNDIALS_COMPLAINT_SIZE]; /* last error text of SUNDIALS; "": none */
  bool pivots_forgotten;                          /* KLU must choose new pivots */
  int64_t full_factorizations;                    /* number of times that KLU chose pivots */
  baum_i_statistics before;                       /* counts before the last restart */
} baum_i_sundials;

/* Create a context with a silent error handler and vectors of length n. Close it after everything
 * that was created with it. A zeroed struct may be closed. */
baum_status baum_i_sundials_open(baum_i_sundials *sundials, int n);
void baum_i_sundials_close(baum_i_sundials *sundials);

/* Return one of the preallocated vectors. When SUNDIALS clones a vector, the clone is also one of
 * the preallocated vectors. Returns NULL if no vector is left. There are enough preallocated
 * vectors for all that this library requests. */
N_Vector baum_i_sundials_vector(baum_i_sundials *sundials);

/* Store an error text of SUNDIALS. */
void baum_i_sundials_complain(baum_i_sundials *sundials, const char *text);

/* Convert a status to the return value of a callback: 0 on success, +1 if a smaller step may help,
 * otherwise -1. If the status is a failure, it is stored together with its message. */
int baum_i_sundials_answer(baum_i_sundials *sundials, baum_status status);

/* ---- y = (q, v) and y' = (N v, v'), the first nq + nv unknowns of every method ---- */

void baum_i_sundials_pack(const baum_mechanism *mechanism, const double *q, const double *v,
                          double *y);
void baum_i_sundials_unpack(const baum_mechanism *mechanism, const double *y, double *q, double *v);

/* Set dy to y' at y, with the accelerations workspace->a. */
void baum_i_sundials_pack_rate(const baum_workspace *workspace, const double *y, double *dy);

/* Newton's iterations solve for displacements dx (nv) instead of dq (nq). At a q near the
 * configuration manifold, dq = N dx + n. n is the part of dq that points off the manifold, and n =
 * 0 if q is a vector. */

/* Return dx, which is valid until workspace->work_q is used again. work_q also stores n for
 * baum_i_sundials_join(). */
const double *baum_i_sundials_split(const baum_i_sundials *sundials, const double *q,
                                    const double *dq);
/* Set dq = N dx + factor n, where n is the part that baum_i_sundials_split() has stored. */
void baum_i_sundials_join(const baum_i_sundials *sundials, const double *q, const double *dx,
                          double factor, double *dq);

/* Callback of CVODE and IDA: set the error weights 1 / tolerance of y. */
int baum_i_sundials_weigh(N_Vector y, N_Vector weights, void *run);

#endif
