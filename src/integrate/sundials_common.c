/* SPDX-License-Identifier: BSD-3-Clause */
/* Common parts of CVODE and IDA: context, vectors, failing evaluations, unknowns. */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include "integrate/sundials_common.h"

#include <stdio.h>
#include <string.h>

#include "base/alloc.h"

/* ---- contexts and error texts of SUNDIALS 6.4 and 7 ---- */

void baum_i_sundials_complain(baum_i_sundials *sundials, const char *text)
{
  (void)snprintf(sundials->complaint, sizeof sundials->complaint, "%s", text ? text : "");
}

#if SUNDIALS_VERSION_MAJOR >= 7

static void handle_error(int line, const char *function, const char *file, const char *text,
                         SUNErrCode flag, void *user, SUNContext context)
{
  (void)line;
  (void)function;
  (void)file;
  (void)flag;
  (void)context;
  baum_i_sundials_complain(user, text);
}

static int create_context(baum_i_sundials *sundials)
{
  if (SUNContext_Create(SUN_COMM_NULL, &sundials->context) != 0) {
    return -1;
  }
  int cleared = SUNContext_ClearErrHandlers(sundials->context);
  return cleared != 0 ? cleared
                      : SUNContext_PushErrHandler(sundials->context, handle_error, sundials);
}

#else

static int create_context(baum_i_sundials *sundials)
{
  return SUNContext_Create(NULL, &sundials->context);
}

#endif

/* ---- vectors ----
 *
 * SUNDIALS 6.4 clones vectors without checking for lack of memory, and after a failure at the start
 * it frees some of them twice. All vectors are therefore allocated beforehand, and lack of memory
 * is returned as a status. Cloning returns the next of these vectors, destroying does nothing, and
 * baum_i_sundials_close() frees them. A pointer to the baum_i_sundials precedes the numbers of each
 * vector. */

enum { PREFIX = 1 };

static N_Vector clone(N_Vector like)
{
  baum_i_sundials *sundials;
  memcpy(&sundials, N_VGetArrayPointer(like) - PREFIX, sizeof(void *));
  N_Vector vector = baum_i_sundials_vector(sundials);
  if (vector) {
    return vector;
  }
  vector = N_VClone_Serial(like);
  if (vector) { /* vector created by SUNDIALS */
    vector->ops->nvclone = N_VClone_Serial;
    vector->ops->nvdestroy = N_VDestroy_Serial;
  }
  return vector;
}

static void keep_vector(N_Vector vector)
{
  (void)vector;
}

static baum_status make_vectors(baum_i_sundials *sundials, int n)
{
  size_t stride = (size_t)n + PREFIX;
  sundials->numbers = baum_i_alloc(BAUM_I_SUNDIALS_VECTORS * stride, sizeof(double));
  BAUM_I_TRY(baum_i_check_memory(sundials->numbers));
  for (size_t k = 0; k < BAUM_I_SUNDIALS_VECTORS; k++) {
    double *numbers = sundials->numbers + k * stride + PREFIX;
    memcpy(numbers - PREFIX, &sundials, sizeof(void *));
    N_Vector vector = N_VMake_Serial(n, numbers, sundials->context);
    if (!vector) {
      return baum_i_fail_memory();
    }
    vector->ops->nvclone = clone;
    vector->ops->nvdestroy = keep_vector;
    sundials->vectors[k] = vector;
  }
  return BAUM_OK;
}

N_Vector baum_i_sundials_vector(baum_i_sundials *sundials)
{
  bool left = sundials->taken < BAUM_I_SUNDIALS_VECTORS;
  return left ? sundials->vectors[sundials->taken++] : NULL;
}

/* ---- life ---- */

baum_status baum_i_sundials_open(baum_i_sundials *sundials, int n)
{
  return create_context(sundials) == 0 ? make_vectors(sundials, n) : baum_i_fail_memory();
}

void baum_i_sundials_close(baum_i_sundials *sundials)
{
  for (int k = 0; k < BAUM_I_SUNDIALS_VECTORS; k++) {
    if (sundials->vectors[k]) {
      N_VDestroy_Serial(sundials->vectors[k]);
    }
  }
  baum_i_free(sundials->numbers);
  if (sundials->context) {
    (void)SUNContext_Free(&sundials->context);
  }
}

/* ---- evaluations ---- */

int baum_i_sundials_answer(baum_i_sundials *sundials, baum_status status)
{
  if (status == BAUM_OK) {
    return 0;
  }
  sundials->evaluation = status;
  sundials->evaluated_at = sundials->t;
  (void)snprintf(sundials->message, sizeof sundials->message, "%s", baum_message());
  /* The flag `retry` is set only by these two failures. */
  bool may_retry = status == BAUM_ERR_CALLBACK || status == BAUM_ERR_NOT_FINITE;
  sundials->stopped = !(may_retry && sundials->problem->workspace->point.retry);
  return sundials->stopped ? -1 : 1;
}

/* ---- unknowns ---- */

void baum_i_sundials_pack(const baum_mechanism *mechanism, const double *q, const double *v,
                          double *y)
{
  memcpy(y, q, (size_t)mechanism->nq * sizeof *y);
  memcpy(y + mechanism->nq, v, (size_t)mechanism->nv * sizeof *y);
}

void baum_i_sundials_unpack(const baum_mechanism *mechanism, const double *y, double *q, double *v)
{
  memcpy(q, y, (size_t)mechanism->nq * sizeof *y);
  memcpy(v, y + mechanism->nq, (size_t)mechanism->nv * sizeof *y);
  baum_i_normalize(mechanism, q);
}

void baum_i_sundials_pack_rate(const baum_workspace *workspace, const double *y, double *dy)
{
  const baum_mechanism *mechanism = workspace->mechanism;
  baum_i_rate(mechanism, y, y + mechanism->nq, dy);
  memcpy(dy + mechanism->nq, workspace->a, (size_t)mechanism->nv * sizeof *dy);
}

/* ---- displacements ---- */

/* Return the part of workspace->work_q that follows the part used by baum_i_tangent(). */
static double *normal_of(const baum_i_sundials *sundials)
{
  const baum_workspace *w = sundials->problem->workspace;
  return w->work_q + 3 * (ptrdiff_t)w->mechanism->nq;
}

const double *baum_i_sundials_split(const baum_i_sundials *sundials, const double *q,
                                    const double *dq)
{
  const baum_workspace *w = sundials->problem->workspace;
  const baum_mechanism *m = w->mechanism;
  const double *dx = baum_i_tangent(m, q, dq, w->work_q);
  if (!m->flat) {
    double *normal = normal_of(sundials);
    baum_i_rate(m, q, dx, normal);
    for (int i = 0; i < m->nq; i++) {
      normal[i] = dq[i] - normal[i];
    }
  }
  return dx;
}

void baum_i_sundials_join(const baum_i_sundials *sundials, const double *q, const double *dx,
                          double factor, double *dq)
{
  const baum_mechanism *m = sundials->problem->workspace->mechanism;
  const double *normal = normal_of(sundials);
  baum_i_rate(m, q, dx, dq);
  for (int i = 0; i < m->nq && !m->flat; i++) {
    dq[i] += factor * normal[i];
  }
}

int baum_i_sundials_weigh(N_Vector y, N_Vector weights, void *run)
{
  const baum_i_problem *problem = ((const baum_i_sundials *)run)->problem;
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  const double *v = N_VGetArrayPointer(y) + mechanism->nq;
  double *w = N_VGetArrayPointer(weights);
  baum_i_problem_tolerances(problem, v, w, w + mechanism->nq);
  for (int i = 0; i < mechanism->nq + mechanism->nv; i++) {
    w[i] = 1.0 / w[i];
  }
  return 0;
}

#endif

const char *baum_i_sundials_version(void)
{
#if BAUM_HAVE_SUNDIALS
  return SUNDIALS_VERSION;
#else
  return "none";
#endif
}
