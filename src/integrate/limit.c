/* SPDX-License-Identifier: BSD-3-Clause */
#include "integrate/limit.h"

#include <string.h>

/* [rad] Distance between the states that define the cubic. The truncation error of the cubic is
 * about the fourth power of this distance. The rounding error is 1e-16 divided by the square of
 * this distance. */
static const double APART = 0.003;
/* Slowest motion for which a limit is computed, relative to the rate 1/T of the problem. Slower
 * motions have no clear direction. */
static const double SLOW = 0.1;

static baum_status evaluate_behind(const baum_i_problem *problem, const baum_i_state *state,
                                   double dt, double *room)
{
  const baum_mechanism *m = problem->workspace->mechanism;
  double *v = room + m->nq;
  memcpy(v, state->v, (size_t)m->nv * sizeof *v);
  baum_i_move_from(m, state->q, dt, v, room);
  BAUM_I_TRY(baum_i_project(problem->workspace, state->t + dt, room, v));
  return baum_i_problem_motion(problem, state->t + dt, room, v);
}

bool baum_i_limit_acceleration(const baum_i_problem *problem, const baum_i_state *state,
                               double *room, double *limit)
{
  static const double WEIGHT[] = {4.0, -6.0, 4.0, -1.0};
  const baum_workspace *w = problem->workspace;
  int nv = w->mechanism->nv;
  double rate = baum_i_scaled_size(w->mechanism, state->v);
  bool found = rate > SLOW * problem->rate;
  memset(limit, 0, (size_t)nv * sizeof *limit);
  for (int k = 0; k < 4 && found; k++) {
    double dt = problem->direction * (k + 1) * APART / rate;
    found = evaluate_behind(problem, state, dt, room) == BAUM_OK;
    for (int i = 0; i < nv; i++) {
      limit[i] += WEIGHT[k] * w->a[i];
    }
  }
  return found;
}
