/* SPDX-License-Identifier: BSD-3-Clause */
/* The interface of a solver of the saddle-point system. To add one: write a file with a const
 * struct of these functions, declare it below, and give it a place in kkt.c. The front end (kkt.c)
 * computes residuals, refines, counts, judges the accuracy and falls back; a backend only factors
 * and solves. None of these functions sets a message. */
#ifndef BAUM_I_LINEAR_BACKEND_H
#define BAUM_I_LINEAR_BACKEND_H

#include "linear/kkt.h"

/* How much a factorization may cost. */
typedef enum baum_i_kkt_effort {
  BAUM_I_EFFORT_KEEP,   /* keep the pivots of the last factorization; allocates nothing */
  BAUM_I_EFFORT_CHOOSE, /* choose pivots at these values */
  BAUM_I_EFFORT_CAREFUL /* choose them for accuracy alone; for matrices close to singular */
} baum_i_kkt_effort;

typedef struct baum_i_kkt_ops {
  const char *name;
  bool keeps_pivots; /* supports BAUM_I_EFFORT_KEEP */

  /* BAUM_OK or BAUM_ERR_MEMORY, then *out is NULL. The structure outlives the backend. */
  baum_status (*create)(const baum_i_kkt_structure *structure, void **out);

  /* Factor at finite values; `values` and `scale` (see scale.h) stay in place until the last solve.
   * KEEP only after a factorization that succeeded. BAUM_OK, BAUM_ERR_SINGULAR (then nothing can be
   * solved) or BAUM_ERR_MEMORY. */
  baum_status (*factor)(void *self, const baum_i_kkt_values *values, const double *scale,
                        baum_i_kkt_effort effort);

  /* Replaces the right-hand side (f, r) in x (nv + nc) by the solution (a, lambda). BAUM_OK or
   * BAUM_ERR_MEMORY. */
  baum_status (*solve)(void *self, double *x);

  /* Cheap estimate of the reciprocal condition of the scaled matrix; 0 if its rank is not full. */
  double (*rcond)(const void *self);

  void (*destroy)(void *self); /* NULL does nothing */
} baum_i_kkt_ops;

extern const baum_i_kkt_ops baum_i_klu_ops;
extern const baum_i_kkt_ops baum_i_qr_ops;

#endif
