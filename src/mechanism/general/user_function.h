/* SPDX-License-Identifier: BSD-3-Clause */
/* User functions: the coordinates they receive, the call, and what becomes of the answer.
 *
 * A user function sees the coordinates of its bodies one after the other, in the order named, and
 * fills a zeroed array. Returning > 0, or values that are not finite, fails with point->retry set:
 * a smaller step may help. Returning < 0 fails for good.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_USER_FUNCTION_H
#define BAUM_I_MECHANISM_GENERAL_USER_FUNCTION_H

#include "base/message.h"
#include "mechanism/identify.h"

/* Doubles of point->scratch that an element may use, with the larger number of its local columns,
 * of q or of v, and that many rows. */
int64_t baum_i_scratch_size(int columns, int rows);

/* Where user functions are evaluated. Copies of it are cheap: a function that needs memory copies
 * the struct and takes from its own copy, so that everything it took is given back when it
 * returns. */
typedef struct baum_i_local {
  baum_i_point *point;
  const baum_i_span *span; /* whose q is moved on the manifold; NULL: q is a vector, ql = nl */
  int ql;
  int nl;
  double t;
  const double *q;     /* (ql) */
  const double *v;     /* (nl), zeros at position level */
  const double *scale; /* (nl) a relevant change of each coordinate */
  double *free;        /* what is left of point->scratch */
} baum_i_local;

/* Where an element's block begins in an array of all; NULL where there is none. */
static inline double *baum_i_block_at(double *blocks, int offset)
{
  return blocks ? blocks + offset : NULL;
}

/* Gather the columns of a span at a point. */
baum_i_local baum_i_gather(baum_i_point *point, const baum_i_span *span);

/* Gather any vector over v, such as accelerations. */
const double *baum_i_gather_vector(baum_i_local *local, const baum_i_span *span, const double *x);

/* Take count doubles, not cleared. */
double *baum_i_take(baum_i_local *local, int count);

/* What is called, for messages: `joint 2 "circle": phi()`. */
typedef struct baum_i_user_function {
  const baum_i_element *element;
  const char *name; /* "phi" */
  int rows;         /* of the output */
  int cols;         /* of the output; 0 when it is a vector */
  void *user;
} baum_i_user_function;

/* Clear out (rows x cols), call, and judge the answer:
 * BAUM_OK, BAUM_ERR_CALLBACK or BAUM_ERR_NOT_FINITE. */
baum_status baum_i_call_q(const baum_i_user_function *function, baum_q_fn *call,
                          const baum_i_local *at, double *out);
baum_status baum_i_call_qv(const baum_i_user_function *function, baum_qv_fn *call,
                           const baum_i_local *at, double *out);
baum_status baum_i_call_force(const baum_i_user_function *function, baum_force_fn *call,
                              const baum_i_local *at, double *out);

/* The first and the last part of a call, for functions of another shape: of `at` point and t are
 * used. */
void baum_i_begin_call(const baum_i_user_function *function, const baum_i_local *at, double *out);
baum_status baum_i_judge(const baum_i_user_function *function, const baum_i_local *at, int answer,
                         const double *out);

/* After baum_i_listen(): the message for a function that has answered so, with what it says
 * itself. */
baum_status baum_i_fail_returned(const baum_i_element *element, const char *name, int answer,
                                 baum_i_point *point);

/* `joint 2 "circle": jacobian()[0][1]` into text; returns text.
 * The entry counts over the output as stored. */
enum { BAUM_I_ENTRY_SIZE = BAUM_I_LABEL_SIZE + 80 };
const char *baum_i_user_entry(const baum_i_user_function *function, int entry,
                              char text[BAUM_I_ENTRY_SIZE]);

#endif
