/* SPDX-License-Identifier: BSD-3-Clause */
/* What runs of CVODE and IDA have in common: context, complaints, failing evaluations, weights. */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include "integrate/sundials_common.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"

/* ---- 6.4 and 7 ---- */

static void keep_complaint(baum_i_sundials *sundials, const char *text)
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
  keep_complaint(user, text);
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

void baum_i_sundials_handle_error(int flag, const char *module, const char *function, char *text,
                                  void *user)
{
  (void)flag;
  (void)module;
  (void)function;
  keep_complaint(user, text);
}

static int create_context(baum_i_sundials *sundials)
{
  return SUNContext_Create(NULL, &sundials->context);
}

#endif

/* ---- vectors ----
 *
 * SUNDIALS 6.4 clones vectors without looking whether there was memory, and after a failure at start frees those it has
 * twice. So all are made beforehand, where a failure is a status; cloning takes the next, destroying does nothing,
 * closing frees them. Each one's numbers are preceded by a pointer to its stock. */

enum { PREFIX = 1 };

/* A vector of SUNDIALS' own making goes its own ways. */
static N_Vector let_go(N_Vector vector)
{
  if (vector) {
    vector->ops->nvclone = N_VClone_Serial;
    vector->ops->nvcloneempty = N_VCloneEmpty_Serial;
    vector->ops->nvdestroy = N_VDestroy_Serial;
  }
  return vector;
}

static N_Vector clone(N_Vector like)
{
  baum_i_sundials *sundials;
  memcpy(&sundials, N_VGetArrayPointer(like) - PREFIX, sizeof(void *));
  N_Vector vector = baum_i_sundials_vector(sundials);
  return vector ? vector : let_go(N_VClone_Serial(like));
}

/* For differences of IDA: a shell around numbers that are not ours. */
static N_Vector clone_empty(N_Vector like)
{
  return let_go(N_VCloneEmpty_Serial(like));
}

static void keep(N_Vector vector)
{
  (void)vector;
}

static baum_status make_vectors(baum_i_sundials *sundials, int n)
{
  size_t stride = (size_t)n + PREFIX;
  sundials->numbers = baum_i_alloc(BAUM_I_SUNDIALS_VECTORS * stride, sizeof(double));
  if (!sundials->numbers) {
    return baum_i_fail_memory();
  }
  for (size_t k = 0; k < BAUM_I_SUNDIALS_VECTORS; k++) {
    double *numbers = sundials->numbers + k * stride + PREFIX;
    memcpy(numbers - PREFIX, &sundials, sizeof(void *));
    N_Vector vector = N_VMake_Serial(n, numbers, sundials->context);
    if (!vector) {
      return baum_i_fail_memory();
    }
    vector->ops->nvclone = clone;
    vector->ops->nvcloneempty = clone_empty;
    vector->ops->nvdestroy = keep;
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

baum_status baum_i_sundials_open(baum_i_sundials *sundials, const char *integrator, int n)
{
  sundials->integrator = integrator;
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

void baum_i_sundials_begin(baum_i_sundials *sundials, const baum_i_problem *problem, double t)
{
  sundials->problem = problem;
  sundials->t = t;
  sundials->unfinished = true;
  sundials->stopped = false;
  sundials->evaluation = BAUM_OK;
  sundials->complaint[0] = '\0';
}

/* Steps that shrink towards a place where evaluations fail end with one in which none does: what failed nearly no time
 * ago is still the reason. */
void baum_i_sundials_begin_step(baum_i_sundials *sundials, const baum_i_problem *problem, double t)
{
  bool near = fabs(t - sundials->evaluated_at) * problem->rate <= 1e-6;
  baum_status evaluation = near ? sundials->evaluation : BAUM_OK;
  baum_i_sundials_begin(sundials, problem, t);
  sundials->evaluation = evaluation;
}

/* The flag `retry` says something after these two failures only. */
static bool may_retry(const baum_i_sundials *sundials, baum_status status)
{
  return (status == BAUM_ERR_CALLBACK || status == BAUM_ERR_NOT_FINITE) &&
         sundials->problem->workspace->point.retry;
}

int baum_i_sundials_answer(baum_i_sundials *sundials, baum_status status)
{
  if (status == BAUM_OK) {
    return 0;
  }
  sundials->evaluation = status;
  sundials->evaluated_at = sundials->t;
  (void)snprintf(sundials->sentence, sizeof sundials->sentence, "%s", baum_message());
  sundials->stopped = !may_retry(sundials, status);
  return sundials->stopped ? -1 : 1;
}

/* step: 0 where none was tried. */
static baum_status fail_with_evaluation(const baum_i_sundials *sundials, double step)
{
  return baum_i_fail_in_step(sundials->evaluation, sundials->sentence, sundials->integrator,
                             sundials->t, step);
}

baum_status baum_i_sundials_fail(const baum_i_sundials *sundials, const baum_i_sundials_flag *flags,
                                 int flag, double step)
{
  if (sundials->evaluation != BAUM_OK) {
    return fail_with_evaluation(sundials, step);
  }
  while (flags->flag != 0 && flags->flag != flag) {
    flags++;
  }
  if (flags->flag == 0) {
    return baum_i_fail(BAUM_ERR_INTEGRATOR, "t = %.9g s: %s failed with flag %d (step %.3g s. %s)",
                       sundials->t, sundials->integrator, flag, step, sundials->complaint);
  }
  return baum_i_fail(flags->status, "t = %.9g s: %s: %s (step %.3g s. %s)", sundials->t,
                     sundials->integrator, flags->meaning, step,
                     sundials->origin == 0.0 ? sundials->complaint : "");
}

/* First steps may be lost in the rounding of a late t as long as that is fine beside the motion. */
static bool has_moved(const baum_i_sundials *sundials, double before, double after)
{
  double rounding = DBL_EPSILON * fabs(sundials->t) * sundials->problem->rate;
  bool shows = sundials->origin + after != sundials->t;
  return shows || (after != before && rounding <= 1e-4);
}

baum_status baum_i_sundials_check_progress(const baum_i_sundials *sundials, double before,
                                           double after)
{
  if (has_moved(sundials, before, after)) {
    return BAUM_OK;
  }
  if (sundials->evaluation != BAUM_OK) {
    return fail_with_evaluation(sundials, after - before);
  }
  return baum_i_fail(BAUM_ERR_STEP,
                     "t = %.9g s: %s: the step became too small to change the time (%.3g s); the "
                     "motion may be singular here, or rtol = %g is too small",
                     sundials->t, sundials->integrator, fabs(after - before),
                     sundials->problem->rtol);
}

double baum_i_sundials_inside(const baum_i_sundials *sundials, double t, double end, double last)
{
  double tau = t - sundials->origin;
  double beyond = (tau - end) * sundials->problem->direction;
  double before = -beyond - fabs(last);
  if (fmax(beyond, before) > 100.0 * DBL_EPSILON * fmax(fabs(t), fabs(end))) {
    return (double)NAN;
  }
  return beyond > 0.0 ? end : (before > 0.0 ? end - last : tau);
}

baum_status baum_i_sundials_fail_outside(const baum_i_sundials *sundials, double t)
{
  return baum_i_fail(BAUM_ERR_INTEGRATOR, "t = %.9g s is not inside the last step of %s", t,
                     sundials->integrator);
}

/* ---- numbers ---- */

double baum_i_sundials_target(const baum_i_problem *problem, double t)
{
  return t + problem->direction * 10.0 / problem->rate;
}

void baum_i_sundials_weights(const baum_i_problem *problem, const double *v, double *weights)
{
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  baum_i_problem_tolerances(problem, v, weights, weights + mechanism->nq);
  for (int i = 0; i < mechanism->nq + mechanism->nv; i++) {
    weights[i] = 1.0 / weights[i];
  }
}

void baum_i_sundials_unload(const baum_i_problem *problem, N_Vector from, double *q, double *v)
{
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  const double *y = N_VGetArrayPointer(from);
  memcpy(q, y, (size_t)mechanism->nq * sizeof *y);
  memcpy(v, y + mechanism->nq, (size_t)mechanism->nv * sizeof *y);
}

const char *baum_i_sundials_version(void)
{
  return SUNDIALS_VERSION;
}

#endif
