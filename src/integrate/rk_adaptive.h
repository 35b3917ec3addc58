/* SPDX-License-Identifier: BSD-3-Clause */
/* Explicit Runge-Kutta pairs, which estimate their error and choose their step: one driver, a table
 * for each pair. baum_i_rk_step() of rk.h takes their steps of fixed length. */
#ifndef BAUM_I_INTEGRATE_RK_ADAPTIVE_H
#define BAUM_I_INTEGRATE_RK_ADAPTIVE_H

#include "integrate/rk.h"

/* A pair of s stages. Rate s (from 0) is that at the end of the step, from which the next one
 * begins. Extra rates, for the interpolant alone, come after it. */
typedef struct baum_i_rk_pair {
  const char *name; /* of the integrator, in messages */
  baum_i_rk_table table;
  int error_order;      /* the estimate grows with h^error_order */
  int error_count;      /* rates in the estimate: s, or s + 1 with the one at the end */
  const double *error;  /* (error_count) */
  const double *error3; /* (error_count) of order 3, or NULL */
  int extra;
  const double *extra_c;   /* (extra) */
  const double *extra_a;   /* rows over all rates before: s + 1, s + 2, ... */
  int dense;               /* coefficients of the interpolant that are sums of rates */
  const double *dense_row; /* (dense x (s + 1 + extra)) */
} baum_i_rk_pair;

/* As in baum_integrator; the table is a baum_i_rk_pair. */
baum_status baum_i_rk_adaptive_create(const void *table, const baum_i_problem *problem,
                                      const baum_i_state *start, void **out);
void baum_i_rk_adaptive_destroy(void *self);
baum_status baum_i_rk_adaptive_advance(void *self, const baum_i_problem *problem,
                                       baum_i_state *state);
baum_status baum_i_rk_adaptive_interpolate(void *self, const baum_i_problem *problem, double t,
                                           double *q, double *v);
baum_status baum_i_rk_adaptive_restart(void *self, const baum_i_problem *problem,
                                       const baum_i_state *state);
void baum_i_rk_adaptive_forget(void *self);
void baum_i_rk_adaptive_statistics(const void *self, baum_i_statistics *out);

#endif
