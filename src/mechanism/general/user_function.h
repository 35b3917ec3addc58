/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls of user functions: the coordinates that they receive, the call, and the check of the
 * result.
 *
 * A user function receives the coordinates of its bodies one after the other, in the order of the
 * definition, and fills an array that has been set to zero. If it returns > 0, or values that are
 * not finite, the call fails with point->retry set, because a smaller step may avoid the failure.
 * If it returns < 0, the run stops.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_USER_FUNCTION_H
#define BAUM_I_MECHANISM_GENERAL_USER_FUNCTION_H

#include "base/message.h"
#include "mechanism/identify.h"

/* Return the number of doubles of point->scratch that an element may use. columns is the larger of
 * its numbers of local positions and velocities. */
int64_t baum_i_scratch_size(int columns, int rows);

/* The point at which user functions are evaluated. A function that needs scratch memory copies this
 * struct and calls baum_i_take() on the copy. Since `free` of the original is unchanged, all memory
 * is free again when the function returns. */
typedef struct baum_i_local {
  baum_i_point *point;
  const baum_i_span *span; /* needed if q must be moved on a manifold; NULL: q is a vector, ql =
                            * nl */
  int ql;
  int nl;
  double t;
  const double *q;     /* (ql) */
  const double *v;     /* (nl), zeros at position level */
  const double *scale; /* (nl) scale of each coordinate */
  double *free;        /* the rest of point->scratch */
} baum_i_local;

/* Return the block of an element at `offset`, or NULL if blocks is NULL. */
static inline double *baum_i_block_at(double *blocks, int offset)
{
  return blocks ? blocks + offset : NULL;
}

/* Return the local positions and velocities of a span at a point. */
baum_i_local baum_i_gather(baum_i_point *point, const baum_i_span *span);

/* Return the local part of any vector (nv), such as accelerations. */
const double *baum_i_gather_vector(baum_i_local *local, const baum_i_span *span, const double *x);

/* Take count doubles from the free memory. They are not cleared. */
double *baum_i_take(baum_i_local *local, int count);

/* Description of a user function, for messages: `joint 2 "circle": phi()`. */
typedef struct baum_i_user_function {
  const baum_i_element *element;
  const char *name; /* "phi" */
  int rows;         /* of the output */
  int cols;         /* of the output; 0 if it is a vector */
  void *user;
} baum_i_user_function;

/* Clear out (rows x cols), call the function and check its result: BAUM_OK, BAUM_ERR_CALLBACK or
 * BAUM_ERR_NOT_FINITE. */
baum_status baum_i_call_q(const baum_i_user_function *function, baum_q_fn *call,
                          const baum_i_local *at, double *out);
baum_status baum_i_call_qv(const baum_i_user_function *function, baum_qv_fn *call,
                           const baum_i_local *at, double *out);
baum_status baum_i_call_force(const baum_i_user_function *function, baum_force_fn *call,
                              const baum_i_local *at, double *out);

/* For user functions with other arguments: call the first before and the second after the user
 * function. Of `at`, they use only point and t. */
void baum_i_begin_call(const baum_i_user_function *function, const baum_i_local *at, double *out);
baum_status baum_i_judge(const baum_i_user_function *function, const baum_i_local *at, int answer,
                         const double *out);

/* Fail because a user function returned `answer` != 0. If the function itself set a message since
 * baum_i_listen(), it is included. */
baum_status baum_i_fail_returned(const baum_i_element *element, const char *name, int answer,
                                 baum_i_point *point);

/* Return a text such as `joint 2 "circle": jacobian()[0][1]`. `entry` is an index into the
 * output. */
baum_i_text baum_i_user_entry(const baum_i_user_function *function, int entry);

#endif
