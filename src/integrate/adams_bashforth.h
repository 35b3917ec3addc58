/* SPDX-License-Identifier: BSD-3-Clause */
/* Adams-Bashforth methods: one driver, a table for each method. */
#ifndef BAUM_I_INTEGRATE_ADAMS_BASHFORTH_H
#define BAUM_I_INTEGRATE_ADAMS_BASHFORTH_H

#include "integrate/integrator.h"

enum { BAUM_I_ADAMS_STEPS_MAX = 4 };

/* Integrals of the Lagrange polynomials over the nodes 0, -1, .., 1 - k, from 0 to theta:
 * w_j(theta) = sum_m weights[j k + m] theta^(m + 1). At theta = 1 they are the method's b_j. */
typedef struct baum_i_adams_table {
  int steps;             /* k <= BAUM_I_ADAMS_STEPS_MAX */
  const double *weights; /* (k x k) */
} baum_i_adams_table;

/* As in baum_integrator; the table is a baum_i_adams_table. */
baum_status baum_i_adams_create(const void *table, const baum_i_problem *problem,
                                const baum_i_state *start, void **out);
void baum_i_adams_destroy(void *self);
baum_status baum_i_adams_step(void *self, const baum_i_problem *problem, baum_i_state *state,
                              double h, const double *a);
void baum_i_adams_accept(void *self, const baum_i_problem *problem, const baum_i_state *state);
baum_status baum_i_adams_restart(void *self, const baum_i_problem *problem,
                                 const baum_i_state *state);
void baum_i_adams_forget(void *self);

#endif
