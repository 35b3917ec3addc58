/* SPDX-License-Identifier: BSD-3-Clause */
/* Adams-Bashforth methods: one implementation, and a table for each method. */
#ifndef BAUM_I_INTEGRATE_ADAMS_BASHFORTH_H
#define BAUM_I_INTEGRATE_ADAMS_BASHFORTH_H

#include "integrate/integrator.h"

enum { BAUM_I_ADAMS_STEPS_MAX = 4 };

/* The weights of a method as polynomials in theta: w_j(theta) is the integral, from 0 to theta, of
 * the j-th Lagrange polynomial on the nodes 0, -1, .., 1 - k. The coefficient of theta^(m+1) in w_j
 * is weights[j k + m]. w_j(1) is the weight b_j of a whole step. */
typedef struct baum_i_adams_table {
  int steps;             /* k <= BAUM_I_ADAMS_STEPS_MAX */
  const double *weights; /* (k x k) */
} baum_i_adams_table;

/* Memory of a run. */
typedef struct baum_i_adams {
  const baum_i_adams_table *table;
  void *starter; /* memory of rk4, which takes the first steps */
  int nq;
  int nv;
  /* index of the slot for the start of the present step; the slots of the history precede it */
  int ahead;
  int past;      /* number of points in the history, at most steps - 1 */
  bool on_grid;  /* true if the last trial was a step of the grid */
  double *slots; /* (steps x (nq + nv)) N v and a of each point */
} baum_i_adams;

/* The functions for the table baum_integrator. `table` points to a baum_i_adams_table. */
baum_status baum_i_adams_open(void *self, const void *table, const baum_i_problem *problem,
                              const baum_i_state *start);
void baum_i_adams_close(void *self);
baum_status baum_i_adams_step(void *self, const baum_i_problem *problem, baum_i_state *state,
                              double h, const double *a);
void baum_i_adams_accept(void *self, const baum_i_problem *problem, const baum_i_state *state);
baum_status baum_i_adams_restart(void *self, const baum_i_problem *problem,
                                 const baum_i_state *state);
void baum_i_adams_forget(void *self);

/* clang-format off */
#define BAUM_I_ADAMS_OPERATIONS                                                       \
  .formulations = {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED},        \
  .gains = BAUM_GAINS_BEST_DAMPING,                                                   \
  .memory = sizeof(baum_i_adams),                                                     \
  .open = baum_i_adams_open,                                                          \
  .close = baum_i_adams_close,                                                        \
  .step = baum_i_adams_step,                                                          \
  .accept = baum_i_adams_accept,                                                      \
  .restart = baum_i_adams_restart,                                                    \
  .forget = baum_i_adams_forget
/* clang-format on */

#endif
