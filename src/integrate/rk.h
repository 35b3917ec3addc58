/* SPDX-License-Identifier: BSD-3-Clause */
/* Explicit Runge-Kutta methods: functions that compute the stages and take fixed steps, from the
 * table of any method. Embedded pairs, which choose their step, are in rk_adaptive.h. */
#ifndef BAUM_I_INTEGRATE_RK_H
#define BAUM_I_INTEGRATE_RK_H

#include "integrate/integrator.h"
#include "integrate/rk_kernel.h"

/* Butcher's table of an explicit method; c[0] = 0. */
typedef struct baum_i_rk_table {
  int stages;
  const double *c; /* (stages) */
  const double *a; /* strictly lower triangle, row by row */
  const double *b; /* (stages) */
} baum_i_rk_table;

/* Memory of a run. Methods that need further memory have this struct as the first member of their
 * own struct. Arrays over (q, v) have `size` entries: nq positions, nv velocities, and zeros up to
 * a multiple of BAUM_I_RK_LANES. */
typedef struct baum_i_rk {
  const baum_i_rk_table *table;
  const baum_i_rk_kernel *kernel;
  int nq;
  int nv;
  int size;
  double *rates; /* (rate_count x size) K_i = (N V_i, A_i) */
  double *start; /* (size) (q, v) at the start of the step */
  double *point; /* (size) (Q_i, V_i) of the present stage */
} baum_i_rk;

/* The functions for the table baum_integrator. `table` points to a baum_i_rk_table. */
baum_status baum_i_rk_open(void *self, const void *table, const baum_i_problem *problem,
                           const baum_i_state *start);
void baum_i_rk_close(void *self);
baum_status baum_i_rk_step(void *self, const baum_i_problem *problem, baum_i_state *state, double h,
                           const double *a);

/* Formulations and gains of all Runge-Kutta methods. */
/* clang-format off */
#define BAUM_I_RK_CHOICES                                                             \
  .formulations = {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE,           \
                   BAUM_FORMULATION_UNSTABILIZED},                                    \
  .gains = BAUM_GAINS_AUTO

#define BAUM_I_RK_OPERATIONS                                                          \
  BAUM_I_RK_CHOICES,                                                                  \
  .memory = sizeof(baum_i_rk),                                                        \
  .open = baum_i_rk_open,                                                             \
  .close = baum_i_rk_close,                                                           \
  .step = baum_i_rk_step
/* clang-format on */

/* ---- for methods with more memory ---- */

/* Initialize *rk with memory for rate_count >= stages rates. *more receives more_count further
 * arrays over (q, v). All arrays are one allocation, rk->rates. */
baum_status baum_i_rk_make(baum_i_rk *rk, const baum_i_rk_table *table,
                           const baum_i_problem *problem, int rate_count, int more_count,
                           double **more);

double *baum_i_rk_rate(const baum_i_rk *rk, int stage);

/* Evaluate K_stage at (t, y), y = (q, v). */
baum_status baum_i_rk_evaluate(const baum_i_rk *rk, const baum_i_problem *problem, double t,
                               const double *y, int stage);

/* out = start + h sum_j weights_j K_j over the first `count` rates. */
void baum_i_rk_combine(const baum_i_rk *rk, int count, const double *weights, double h,
                       double *out);

/* Evaluate all stages of a step by h from `start` at t except the first, whose rate is known. */
baum_status baum_i_rk_stages(const baum_i_rk *rk, const baum_i_problem *problem, double t,
                             double h);

#endif
