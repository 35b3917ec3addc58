/* SPDX-License-Identifier: BSD-3-Clause */
/* Semi-implicit Euler, order 1, symplectic without constraints (R. de Vogelaere, 1956):
 *
 *   v(t + h) = v + h a        (nv)
 *   q(t + h) = q moved by h v(t + h)   (nq)   new velocities
 *
 * The amplification z of a violation is a root of z^2 + (B + 2A - 2) z + (1 - 2A), where A = alpha
 * h and B = (beta h)^2. The polynomial differs from that of explicit Euler. At the dead-beat point,
 * alpha = 1/(2h) and beta = 1/h, both roots are 0. The dead-beat point of explicit Euler is
 * unstable for this method.
 */
#include "integrate/integrator.h"

/* Update v and q in one pass, if q is a vector. */
static void add_both(int n, double h, const double *restrict a, double *restrict v,
                     double *restrict q)
{
  for (int i = 0; i < n; i++) {
    v[i] += h * a[i];
    q[i] += h * v[i];
  }
}

static baum_status take_step(void *self, const baum_i_problem *problem, baum_i_state *state,
                             double h, const double *a)
{
  (void)self;
  const baum_mechanism *m = problem->workspace->mechanism;
  if (m->flat) {
    add_both(m->nv, h, a, state->v, state->q);
    return BAUM_OK;
  }
  baum_i_add_scaled(m->nv, h, a, state->v);
  baum_i_move(m, h, state->v, state->q);
  return BAUM_OK;
}

static const baum_integrator SEMI_IMPLICIT_EULER = {
  .name = "semi_implicit_euler",
  .order = 1,
  .formulations = {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED,
                   BAUM_FORMULATION_PROJECTION},
  .gains = BAUM_GAINS_DEADBEAT,
  .method = {.kind = BAUM_I_METHOD_SEMI_IMPLICIT},
  .predicts_violation = true,
  .step = take_step,
};

const baum_integrator *baum_semi_implicit_euler(void)
{
  return &SEMI_IMPLICIT_EULER;
}
