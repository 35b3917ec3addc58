/* SPDX-License-Identifier: BSD-3-Clause */
/* The interface of a solver (backend) of the saddle-point system. To add a solver, write a file
 * that defines a const baum_i_kkt_ops, declare it below, and use it in kkt.c. A backend only
 * factors and solves. The front end (kkt.c) computes residuals, refines, counts the work, checks
 * the accuracy and chooses another solver if necessary. None of these functions sets a message. */
#ifndef BAUM_I_LINEAR_BACKEND_H
#define BAUM_I_LINEAR_BACKEND_H

#include "linear/kkt.h"

/* How a factorization chooses its pivots, from cheap to robust. */
typedef enum baum_i_kkt_effort {
  BAUM_I_EFFORT_KEEP,   /* keep the pivots of the last factorization; allocates nothing */
  BAUM_I_EFFORT_CHOOSE, /* choose pivots for the present values */
  BAUM_I_EFFORT_CAREFUL /* choose pivots for accuracy alone; for nearly singular matrices */
} baum_i_kkt_effort;

typedef struct baum_i_kkt_ops {
  const char *name;
  bool keeps_pivots; /* supports BAUM_I_EFFORT_KEEP */

  /* Returns BAUM_OK, or BAUM_ERR_MEMORY with *out = NULL. `structure` outlives the backend. */
  baum_status (*create)(const baum_i_kkt_structure *structure, void **out);

  /* Factor the matrix, whose values must be finite. The caller does not change `values` and `scale`
   * (see scale.h) until the last solve with these factors. BAUM_I_EFFORT_KEEP requires that an
   * earlier factorization succeeded. Returns BAUM_OK, BAUM_ERR_SINGULAR (no solve may follow) or
   * BAUM_ERR_MEMORY. */
  baum_status (*factor)(void *self, const baum_i_kkt_values *values, const double *scale,
                        baum_i_kkt_effort effort);

  /* Replaces the right-hand side (f, r) in x (nv + nc) by the solution (a, lambda). Returns BAUM_OK
   * or BAUM_ERR_MEMORY. */
  baum_status (*solve)(void *self, double *x);

  /* Return a cheap estimate of the reciprocal condition number of the scaled matrix, or 0 if the
   * rank of the matrix is not full. */
  double (*rcond)(const void *self);

  void (*destroy)(void *self); /* NULL does nothing */
} baum_i_kkt_ops;

extern const baum_i_kkt_ops baum_i_klu_ops;
extern const baum_i_kkt_ops baum_i_qr_ops;

#endif
