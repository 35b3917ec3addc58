/* SPDX-License-Identifier: BSD-3-Clause */
/* Explicit Runge-Kutta methods for q' = N v, v' = a(t, q, v) (C. Runge, 1895; W. Kutta, 1901;
 * table: J. Butcher, 1964). With y = (q, v), s stages:
 *
 *   Y_i = (Q_i, V_i) = y + h sum_{j<i} a_ij K_j                  (nq + nv)  i = 1 .. s
 *   K_i = (N(Q_i) V_i, A_i),  A_i = a(t + c_i h, Q_i, V_i)       (nq + nv)
 *   y(t + h) = y + h sum b_i K_i,  its q normalized
 *
 * The caller provides A_1.
 *
 * The state is written only at the end, so that it does not change if a stage fails.
 */
#include "integrate/rk.h"

#include <string.h>

#include "base/alloc.h"
#include "base/hot.h"
#include "base/message.h"

double *baum_i_rk_rate(const baum_i_rk *rk, int stage)
{
  return rk->rates + (size_t)stage * (size_t)rk->size;
}

/* Store the rate K_stage = (N v, a) of a stage at (q, v). */
static void store_rate(const baum_i_rk *rk, const baum_mechanism *m, int stage, const double *q,
                       const double *v, const double *a)
{
  double *rate = baum_i_rk_rate(rk, stage);
  baum_i_rate(m, q, v, rate);
  memcpy(rate + rk->nq, a, (size_t)rk->nv * sizeof *a);
}

baum_status baum_i_rk_evaluate(const baum_i_rk *rk, const baum_i_problem *problem, double t,
                               const double *y, int stage)
{
  BAUM_I_TRY(baum_i_problem_motion(problem, t, y, y + rk->nq));
  store_rate(rk, problem->workspace->mechanism, stage, y, y + rk->nq, problem->workspace->a);
  return BAUM_OK;
}

void baum_i_rk_combine(const baum_i_rk *rk, int count, const double *weights, double h, double *out)
{
  rk->kernel->combine(rk->size, count, weights, h, rk->rates, rk->start, out);
}

baum_status baum_i_rk_stages(const baum_i_rk *rk, const baum_i_problem *problem, double t, double h)
{
  const baum_i_rk_table *table = rk->table;
  const double *row = table->a;
  for (int i = 1; i < table->stages; i++) {
    baum_i_rk_combine(rk, i, row, h, rk->point);
    BAUM_I_TRY(baum_i_rk_evaluate(rk, problem, t + table->c[i] * h, rk->point, i));
    row += i;
  }
  return BAUM_OK;
}

baum_status baum_i_rk_step(void *self, const baum_i_problem *problem, baum_i_state *state, double h,
                           const double *a)
{
  const baum_i_rk *rk = self;
  const baum_mechanism *m = problem->workspace->mechanism;
  memcpy(rk->start, state->q, (size_t)rk->nq * sizeof *a);
  memcpy(rk->start + rk->nq, state->v, (size_t)rk->nv * sizeof *a);
  store_rate(rk, m, 0, state->q, state->v, a);
  BAUM_I_TRY(baum_i_rk_stages(rk, problem, state->t, h));
  baum_i_rk_combine(rk, rk->table->stages, rk->table->b, h, rk->point);
  baum_i_normalize(m, rk->point);
  memcpy(state->q, rk->point, (size_t)rk->nq * sizeof *a);
  memcpy(state->v, rk->point + rk->nq, (size_t)rk->nv * sizeof *a);
  return BAUM_OK;
}

baum_status baum_i_rk_make(baum_i_rk *rk, const baum_i_rk_table *table,
                           const baum_i_problem *problem, int rate_count, int more_count,
                           double **more)
{
  const size_t lanes = BAUM_I_RK_LANES;
  const baum_mechanism *m = problem->workspace->mechanism;
  size_t size = ((size_t)m->nq + (size_t)m->nv + lanes - 1) / lanes * lanes;
  size_t arrays = (size_t)rate_count + 2 + (size_t)more_count;
  *rk = (baum_i_rk){.table = table, .nq = m->nq, .nv = m->nv, .size = (int)size};
  rk->kernel = BAUM_I_HOT_TABLE(m->wide, baum_i_rk_kernel);
  rk->rates = baum_i_alloc(arrays * size, sizeof *rk->rates);
  BAUM_I_TRY(baum_i_check_memory(rk->rates));
  rk->start = rk->rates + (size_t)rate_count * size;
  rk->point = rk->start + size;
  *more = rk->point + size;
  return BAUM_OK;
}

baum_status baum_i_rk_open(void *self, const void *table, const baum_i_problem *problem,
                           const baum_i_state *start)
{
  (void)start;
  const baum_i_rk_table *of = table;
  double *more = NULL;
  return baum_i_rk_make(self, of, problem, of->stages, 0, &more);
}

void baum_i_rk_close(void *self)
{
  baum_i_free(((baum_i_rk *)self)->rates);
}
