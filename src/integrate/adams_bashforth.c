/* SPDX-License-Identifier: BSD-3-Clause */
/* Explicit Adams methods of k steps, order k (F. Bashforth, J. C. Adams, 1883). The method
 * interpolates v and a at the last k points of the time grid and integrates the polynomials:
 *
 *   q(t + theta h) = q + h sum_{j<k} w_j(theta) (N v)(t - j h)    (nq)   then normalized
 *   v(t + theta h) = v + h sum_{j<k} w_j(theta) a(t - j h)        (nv)
 *   w_j(theta)     = integral of the j-th Lagrange polynomial over the nodes 0, -1, ..
 *                    from 0 to theta
 *
 * A step of the grid has theta = 1. A step of another length uses the same past steps, and its
 * local error has the same order, O(h^(k+1)). If such a step is accepted, the run has left the
 * grid, and the past steps are discarded.
 *
 * At the start and after a restart there are not enough past steps. The classical Runge-Kutta
 * method then takes the steps. Its local error is O(h^5), so the order k <= 4 is not reduced.
 *
 * A step may be a trial that is discarded. v and a at the start of a step are therefore stored in a
 * separate slot. This slot becomes part of the history only when the step is accepted. */
#include "integrate/adams_bashforth.h"

#include <string.h>

#include "base/alloc.h"
#include "base/message.h"

/* ---- history ---- */

/* Return the slot with N v and a at the point that is j steps before the start of the present
 * step. */
static double *slot(const baum_i_adams *run, int j)
{
  int steps = run->table->steps;
  return run->slots + (size_t)((run->ahead - j + steps) % steps) * (size_t)(run->nq + run->nv);
}

/* ---- one step ---- */

/* Compute w_j(theta) / theta by Horner's rule. The caller multiplies the result by the actual
 * length of the step. This length is theta times the step of the grid, so it provides the missing
 * factor theta. */
static void find_weights(const baum_i_adams_table *table, double theta, double *weights)
{
  int steps = table->steps;
  for (int j = 0; j < steps; j++) {
    const double *c = table->weights + (size_t)j * (size_t)steps;
    double sum = 0.0;
    for (int m = steps - 1; m >= 0; m--) {
      sum = sum * theta + c[m];
    }
    weights[j] = sum;
  }
}

/* Add h sum_j weights_j x_j to out (count). x_j are `count` numbers of slot j, beginning at
 * `offset`. */
static void add_rates(const baum_i_adams *run, const double *weights, double h, int offset,
                      int count, double *out)
{
  const double *rates[BAUM_I_ADAMS_STEPS_MAX];
  for (int j = 0; j < run->table->steps; j++) {
    rates[j] = slot(run, j) + offset;
  }
  for (int i = 0; i < count; i++) {
    double sum = 0.0;
    for (int j = 0; j < run->table->steps; j++) {
      sum += weights[j] * rates[j][i];
    }
    out[i] += h * sum;
  }
}

baum_status baum_i_adams_step(void *self, const baum_i_problem *problem, baum_i_state *state,
                              double h, const double *a)
{
  baum_i_adams *run = self;
  run->on_grid = baum_i_problem_is_grid_step(problem, state->t, h);
  baum_i_rate(problem->workspace->mechanism, state->q, state->v, slot(run, 0));
  memcpy(slot(run, 0) + run->nq, a, (size_t)run->nv * sizeof *a);
  if (run->past < run->table->steps - 1) {
    return baum_rk4()->step(run->starter, problem, state, h, a);
  }
  double weights[BAUM_I_ADAMS_STEPS_MAX];
  double theta = run->on_grid ? 1.0 : h / (problem->direction * problem->step);
  find_weights(run->table, theta, weights);
  add_rates(run, weights, h, 0, run->nq, state->q);
  add_rates(run, weights, h, run->nq, run->nv, state->v);
  baum_i_normalize(problem->workspace->mechanism, state->q);
  return BAUM_OK;
}

void baum_i_adams_accept(void *self, const baum_i_problem *problem, const baum_i_state *state)
{
  baum_i_adams *run = self;
  int steps = run->table->steps;
  if (!run->on_grid) {
    (void)baum_i_adams_restart(self, problem, state);
    return;
  }
  run->ahead = (run->ahead + 1) % steps;
  run->past += run->past < steps - 1 ? 1 : 0;
}

baum_status baum_i_adams_restart(void *self, const baum_i_problem *problem,
                                 const baum_i_state *state)
{
  (void)problem;
  (void)state;
  baum_i_adams_forget(self);
  return BAUM_OK;
}

void baum_i_adams_forget(void *self)
{
  baum_i_adams *run = self;
  run->past = 0;
}

/* ---- memory ---- */

baum_status baum_i_adams_open(void *self, const void *table, const baum_i_problem *problem,
                              const baum_i_state *start)
{
  baum_i_adams *run = self;
  run->table = table;
  run->nq = problem->workspace->mechanism->nq;
  run->nv = problem->workspace->mechanism->nv;
  BAUM_I_TRY(baum_i_integrator_create(baum_rk4(), problem, start, &run->starter));
  size_t count = (size_t)run->table->steps * (size_t)(run->nq + run->nv);
  run->slots = baum_i_alloc(count, sizeof *run->slots);
  return baum_i_check_memory(run->slots);
}

void baum_i_adams_close(void *self)
{
  baum_i_adams *run = self;
  baum_i_integrator_destroy(baum_rk4(), run->starter);
  baum_i_free(run->slots);
}
