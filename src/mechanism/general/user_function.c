/* SPDX-License-Identifier: BSD-3-Clause */
/* User functions: gathering their coordinates, calling them, and checking their results. */
#include "mechanism/general/user_function.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/message.h"

/* ---- memory and coordinates ---- */

/* Largest number of results of a user function whose size does not depend on rows and columns. The
 * function of a curve in space has this many results. */
enum { CURVE_SIZE = 20 };

int64_t baum_i_scratch_size(int columns, int rows)
{
  /* Differences may be nested: a difference may call a function that itself computes differences.
   * Each of the two levels needs about a dozen vectors, and there are up to three matrices at a
   * time. */
  int64_t vectors = 48 * ((int64_t)columns + rows) + 24 * (int64_t)CURVE_SIZE;
  int64_t matrices = 3 * ((int64_t)columns * rows);
  return vectors + matrices;
}

double *baum_i_take(baum_i_local *local, int count)
{
  double *taken = local->free;
  local->free += count;
  assert(local->free <= local->point->scratch + local->point->mechanism->scratch_size);
  return taken;
}

static const double *gather(baum_i_local *local, const int *columns, int count, const double *x)
{
  double *gathered = baum_i_take(local, count);
  for (int i = 0; i < count; i++) {
    gathered[i] = x ? x[columns[i]] : 0.0;
  }
  return gathered;
}

const double *baum_i_gather_vector(baum_i_local *local, const baum_i_span *span, const double *x)
{
  return gather(local, span->columns, span->nl, x);
}

baum_i_local baum_i_gather(baum_i_point *point, const baum_i_span *span)
{
  baum_i_local local = {.point = point,
                        .span = span->flat ? NULL : span,
                        .ql = span->ql,
                        .nl = span->nl,
                        .t = point->t,
                        .free = point->scratch};
  local.q = gather(&local, span->positions, span->ql, point->q);
  local.v = baum_i_gather_vector(&local, span, point->v);
  local.scale = baum_i_gather_vector(&local, span, point->mechanism->scale);
  return local;
}

/* ---- calls ---- */

static int values(const baum_i_user_function *function)
{
  return function->cols > 0 ? function->rows * function->cols : function->rows;
}

void baum_i_begin_call(const baum_i_user_function *function, const baum_i_local *at, double *out)
{
  baum_i_listen();
  at->point->asking = true;
  memset(out, 0, (size_t)values(function) * sizeof *out);
}

baum_i_text baum_i_user_entry(const baum_i_user_function *function, int entry)
{
  const baum_i_text label = baum_i_label(function->element);
  return function->cols > 0 ? baum_i_text_of("%s: %s()[%d][%d]", label.text, function->name,
                                             entry / function->cols, entry % function->cols)
                            : baum_i_text_of("%s: %s()[%d]", label.text, function->name, entry);
}

baum_status baum_i_fail_returned(const baum_i_element *element, const char *name, int answer,
                                 baum_i_point *point)
{
  const char *said = baum_i_heard();
  point->retry = answer > 0;
  return baum_i_fail(BAUM_ERR_CALLBACK, "%s: %s() returned %d (%s)%s%.300s",
                     baum_i_label(element).text, name, answer, answer > 0 ? "retry" : "stop",
                     said ? ": " : "", said ? said : "");
}

static baum_status fail_not_finite(const baum_i_user_function *function, const baum_i_local *at,
                                   int entry, double value)
{
  const char *what = isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
  at->point->retry = true;
  return baum_i_fail(BAUM_ERR_NOT_FINITE, "%s is %s at t = %g s",
                     baum_i_user_entry(function, entry).text, what, at->t);
}

baum_status baum_i_judge(const baum_i_user_function *function, const baum_i_local *at, int answer,
                         const double *out)
{
  at->point->asking = false;
  if (answer != 0) {
    return baum_i_fail_returned(function->element, function->name, answer, at->point);
  }
  int count = values(function);
  for (int i = 0; i < count; i++) {
    if (!isfinite(out[i])) {
      return fail_not_finite(function, at, i, out[i]);
    }
  }
  return BAUM_OK;
}

baum_status baum_i_call_q(const baum_i_user_function *function, baum_q_fn *call,
                          const baum_i_local *at, double *out)
{
  baum_i_begin_call(function, at, out);
  return baum_i_judge(function, at, call(at->t, at->q, out, function->user), out);
}

baum_status baum_i_call_qv(const baum_i_user_function *function, baum_qv_fn *call,
                           const baum_i_local *at, double *out)
{
  baum_i_begin_call(function, at, out);
  return baum_i_judge(function, at, call(at->t, at->q, at->v, out, function->user), out);
}

baum_status baum_i_call_force(const baum_i_user_function *function, baum_force_fn *call,
                              const baum_i_local *at, double *out)
{
  baum_i_begin_call(function, at, out);
  return baum_i_judge(function, at,
                      call(at->t, at->q, at->v, at->point->inputs, out, function->user), out);
}
