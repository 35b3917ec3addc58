/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls of user functions. This file gathers the coordinates that they receive, calls them, and
 * checks their results.
 *
 * A user function receives the coordinates of its bodies, one body after the other in the order of
 * the definition. It fills an array that has been set to zero. If it returns a positive number, or
 * if its results are not finite, the call fails with point->retry set, because a smaller step may
 * avoid the failure. If it returns a negative number, the run stops.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_USER_FUNCTION_H
#define BAUM_I_MECHANISM_GENERAL_USER_FUNCTION_H

#include "base/message.h"
#include "mechanism/identify.h"

/* Return how many doubles of point->scratch an element may use. `columns` is the number of local
 * positions or of local velocities, whichever is larger. */
int64_t baum_i_scratch_size(int columns, int rows);

/* The point at which user functions are evaluated. A function that needs scratch memory copies this
 * struct and calls baum_i_take() on the copy. Because `free` of the original struct does not
 * change, all memory is free again when the function returns. */
typedef struct baum_i_local {
  baum_i_point *point;
  /* Needed to move q on a manifold. NULL if q is a vector; then ql = nl. */
  const baum_i_span *span;
  int ql;
  int nl;
  double t;
  const double *q;     /* (ql) */
  const double *v;     /* (nl), zeros if the point has only positions */
  const double *scale; /* (nl) scale of each coordinate */
  double *free;        /* the part of point->scratch that is still free */
} baum_i_local;

/* Return the block of an element at `offset`, or NULL if blocks is NULL. */
static inline double *baum_i_block_at(double *blocks, int offset)
{
  return blocks ? blocks + offset : NULL;
}

/* Return the local positions and velocities of a span at a point. */
baum_i_local baum_i_gather(baum_i_point *point, const baum_i_span *span);

/* Return those entries of a vector (nv), such as the accelerations, that belong to a span. */
const double *baum_i_gather_vector(baum_i_local *local, const baum_i_span *span, const double *x);

/* Take count doubles from the free memory. The memory is not cleared. */
double *baum_i_take(baum_i_local *local, int count);

/* Description of a user function, for messages such as `joint 2 "circle": phi()`. */
typedef struct baum_i_user_function {
  const baum_i_element *element;
  const char *name; /* for example "phi" */
  int rows;         /* number of rows of the output */
  int cols;         /* number of columns of the output, or 0 if it is a vector */
  void *user;
} baum_i_user_function;

/* Set out (rows x cols) to zero, call the function and check its result. Returns BAUM_OK,
 * BAUM_ERR_CALLBACK or BAUM_ERR_NOT_FINITE. */
baum_status baum_i_call_q(const baum_i_user_function *function, baum_q_fn *call,
                          const baum_i_local *at, double *out);
baum_status baum_i_call_qv(const baum_i_user_function *function, baum_qv_fn *call,
                           const baum_i_local *at, double *out);
baum_status baum_i_call_force(const baum_i_user_function *function, baum_force_fn *call,
                              const baum_i_local *at, double *out);

/* For user functions with other arguments: call baum_i_begin_call() before the user function, and
 * baum_i_judge() after it. Both use only the members point and t of `at`. */
void baum_i_begin_call(const baum_i_user_function *function, const baum_i_local *at, double *out);
baum_status baum_i_judge(const baum_i_user_function *function, const baum_i_local *at, int answer,
                         const double *out);

/* Fail because a user function returned `answer`, which is not 0. If the function itself has set a
 * message since baum_i_listen(), this message is included. */
baum_status baum_i_fail_returned(const baum_i_element *element, const char *name, int answer,
                                 baum_i_point *point);

/* Return a text such as `joint 2 "circle": jacobian()[0][1]`. `entry` is the index of a number in
 * the output of the function. */
baum_i_text baum_i_user_entry(const baum_i_user_function *function, int entry);

#endif
