/* SPDX-License-Identifier: BSD-3-Clause */
/* Explicit Euler, order 1 (L. Euler, 1768; with Baumgarte's gains: Flores et al. 2008, equations 12
 * to 19):
 *
 *   q(t + h) = q moved by h v (nq)   old velocities
 *   v(t + h) = v + h a        (nv)
 *
 * The amplification of a violation is z = R(mu) = 1 + mu (amplification.h). This is a root of the
 * paper's polynomial (19), z^2 + (2A - 2) z + (B - 2A + 1), with A = alpha h and B = (beta h)^2.
 */
#include "integrate/integrator.h"

static baum_status take_step(void *self, const baum_i_problem *problem, baum_i_state *state,
                             double h, const double *a)
{
  (void)self;
  const baum_mechanism *m = problem->workspace->mechanism;
  baum_i_move(m, h, state->v, state->q);
  baum_i_add_scaled(m->nv, h, a, state->v);
  return BAUM_OK;
}

static const baum_integrator EULER = {
  .name = "euler",
  .order = 1,
  .formulations = {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED,
                   BAUM_FORMULATION_PROJECTION},
  .gains = BAUM_GAINS_DEADBEAT,
  .method = {.kind = BAUM_I_METHOD_ONE_STEP, .degree = 1, .coefficients = {1.0, 1.0}},
  .predicts_violation = true,
  .step = take_step,
};

const baum_integrator *baum_euler(void)
{
  return &EULER;
}
