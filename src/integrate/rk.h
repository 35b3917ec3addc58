/* SPDX-License-Identifier: BSD-3-Clause */
/* Explicit Runge-Kutta methods: one driver, a table for each method. */
#ifndef BAUM_I_INTEGRATE_RK_H
#define BAUM_I_INTEGRATE_RK_H

#include "integrate/integrator.h"

/* Butcher's table of an explicit method; c[0] = 0. */
typedef struct baum_i_rk_table {
  int stages;
  const double *c; /* (stages) */
  const double *a; /* strictly lower triangle, its rows one after the other */
  const double *b; /* (stages) */
} baum_i_rk_table;

/* Formulations of every Runge-Kutta method. */
extern const baum_formulation baum_i_rk_formulations[];

/* As in baum_integrator; create also takes the table, which must stay. */
baum_status baum_i_rk_create(const baum_i_rk_table *table, const baum_i_problem *problem,
                             void **out);
void baum_i_rk_destroy(void *self);
baum_status baum_i_rk_step(void *self, const baum_i_problem *problem, baum_i_state *state, double h,
                           const double *a);

#endif
