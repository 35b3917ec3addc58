/* SPDX-License-Identifier: BSD-3-Clause */
/* Explicit Runge-Kutta methods for q' = N v, v' = a(t, q, v) (C. Runge, 1895; W. Kutta, 1901; table: J. Butcher,
 * 1964). With s stages, N the identity so far:
 *
 *   Q_i = q + h sum_{j<i} a_ij V_j                  (nq)   i = 1 .. s
 *   V_i = v + h sum_{j<i} a_ij A_j                  (nv)
 *   A_i = a(t + c_i h, Q_i, V_i)                    (nv)   A_1 is given by the caller
 *   q(t + h) = q + h sum b_i V_i,  v(t + h) = v + h sum b_i A_i
 *
 * The state is written last, so that a failing stage leaves it as it was.
 */
#include "integrate/rk.h"

#include <string.h>

#include "base/alloc.h"
#include "base/message.h"

/* Memory of a run. */
typedef struct rk_run {
  const baum_i_rk_table *table;
  int nv;
  double *velocities;    /* (stages x nv) V_i */
  double *accelerations; /* (stages x nv) A_i */
  double *positions;     /* (nv) Q_i of the present stage */
} rk_run;

const baum_formulation baum_i_rk_formulations[] = {
  BAUM_FORMULATION_PROJECTION,
  BAUM_FORMULATION_BAUMGARTE,
  BAUM_FORMULATION_UNSTABILIZED,
  BAUM_FORMULATION_DEFAULT,
};

/* out = base + h sum_j weights_j rates_j over the first `count` rates; out may be base. */
static void combine(const rk_run *run, int count, const double *weights, const double *rates,
                    double h, const double *base, double *out)
{
  int nv = run->nv;
  for (int i = 0; i < nv; i++) {
    double sum = 0.0;
    for (int j = 0; j < count; j++) {
      sum += weights[j] * rates[(size_t)j * nv + i];
    }
    out[i] = base[i] + h * sum;
  }
}

static void keep(const rk_run *run, int stage, const double *a)
{
  memcpy(run->accelerations + (size_t)stage * run->nv, a, (size_t)run->nv * sizeof *a);
}

static baum_status evaluate_stage(const rk_run *run, int stage, const baum_i_problem *problem,
                                  const baum_i_state *state, double h)
{
  const double *row = run->table->a + stage * (stage - 1) / 2;
  double *velocity = run->velocities + (size_t)stage * run->nv;
  combine(run, stage, row, run->velocities, h, state->q, run->positions);
  combine(run, stage, row, run->accelerations, h, state->v, velocity);
  double t = state->t + run->table->c[stage] * h;
  baum_status status = baum_i_problem_motion(problem, t, run->positions, velocity);
  if (status == BAUM_OK) {
    keep(run, stage, problem->workspace->a);
  }
  return status;
}

baum_status baum_i_rk_step(void *self, const baum_i_problem *problem, baum_i_state *state, double h,
                           const double *a)
{
  const rk_run *run = self;
  int stages = run->table->stages;
  memcpy(run->velocities, state->v, (size_t)run->nv * sizeof *state->v);
  keep(run, 0, a);
  for (int stage = 1; stage < stages; stage++) {
    baum_status status = evaluate_stage(run, stage, problem, state, h);
    if (status != BAUM_OK) {
      return status;
    }
  }
  combine(run, stages, run->table->b, run->velocities, h, state->q, state->q);
  combine(run, stages, run->table->b, run->accelerations, h, state->v, state->v);
  return BAUM_OK;
}

baum_status baum_i_rk_create(const baum_i_rk_table *table, const baum_i_problem *problem,
                             void **out)
{
  *out = NULL;
  rk_run *run = baum_i_alloc(1, sizeof *run);
  if (!run) {
    return baum_i_fail_memory();
  }
  run->table = table;
  run->nv = problem->workspace->mechanism->nv;
  size_t block = (size_t)table->stages * (size_t)run->nv;
  run->velocities = baum_i_alloc(2 * block + (size_t)run->nv, sizeof *run->velocities);
  if (!run->velocities) {
    baum_i_rk_destroy(run);
    return baum_i_fail_memory();
  }
  run->accelerations = run->velocities + block;
  run->positions = run->accelerations + block;
  *out = run;
  return BAUM_OK;
}

void baum_i_rk_destroy(void *self)
{
  rk_run *run = self;
  if (run) {
    baum_i_free(run->velocities);
    baum_i_free(run);
  }
}
