/* SPDX-License-Identifier: BSD-3-Clause */
/* Estimates local errors of fixed steps. The change of v in a step is compared with the
 * Adams-Moulton formula of order 5, and the change of q with the Hermite rule (E. Hairer, S.
 * Norsett, G. Wanner, Solving Ordinary Differential Equations I, 1993, III.1):
 *
 *   dv = v_1 - v_0 - h/720 (251 a_1 + 646 a_0 - 264 a_-1 + 106 a_-2 - 19 a_-3)
 *   dq = q_1 - q_0 - h/2 (q'_0 + q'_1) - h^2/12 (q''_0 - q''_1) + h/2 N dv
 *
 * where q' = v and q'' = a if q is a vector. The index 1 denotes the end of the step, 0 its start,
 * and -1, -2 and -3 the starts of the three steps before it. The formulas have errors of order h^6
 * and h^5, so the estimate is far too large for methods of high order. */
#include "simulate/local_error.h"

#include <math.h>
#include <string.h>

#include "base/hot.h"
#include "base/measure.h"

static const double SAME_STEP = 1e-6; /* relative difference up to which steps are equal */

size_t baum_i_local_error_size(const baum_mechanism *m)
{
  return (size_t)m->nq + (size_t)m->nv * (1 + BAUM_I_ACCELERATIONS);
}

void baum_i_local_error_place(baum_i_local_error *local, const baum_mechanism *m, double *numbers)
{
  local->q = numbers;
  local->v = local->q + m->nq;
  for (int k = 0; k < BAUM_I_ACCELERATIONS; k++) {
    local->a[k] = local->v + (k + 1) * (ptrdiff_t)m->nv;
  }
}

/* If q is not a vector, compute dq without its last term (h/2) N dv, as a displacement (nv). */
static const double *find_position_errors(const baum_i_local_error *e, const baum_simulation *run,
                                          double h)
{
  const baum_mechanism *m = run->workspace->mechanism;
  const baum_i_state *now = &run->state;
  ptrdiff_t nq = m->nq;
  double *dq = run->workspace->work_q;
  double *room = dq + nq;
  const double *v0 = baum_i_rates(m, e->q, e->v, room);
  const double *v1 = baum_i_rates(m, now->q, now->v, room + nq);
  const double *a0 = baum_i_second_rates(m, e->q, e->v, e->a[0], room + 2 * nq);
  const double *a1 = baum_i_second_rates(m, now->q, now->v, run->workspace->a, room + 3 * nq);
  for (int i = 0; i < m->nq; i++) {
    dq[i] = now->q[i] - e->q[i] - 0.5 * h * (v0[i] + v1[i]) - h * h / 12.0 * (a0[i] - a1[i]);
  }
  return baum_i_tangent(m, now->q, dq, room);
}

/* Return the largest scaled error of a step by h. Errors of velocities are multiplied by
 * `period`. */
static double largest_error(const baum_i_local_error *e, const baum_simulation *run, double h,
                            double period)
{
  const baum_mechanism *m = run->workspace->mechanism;
  const baum_i_state *now = &run->state;
  const baum_i_step_samples samples = {.q = {e->q, now->q},
                                       .v = {e->v, now->v},
                                       .a = {run->workspace->a, e->a[0], e->a[1], e->a[2], e->a[3]},
                                       .dq = m->flat ? NULL : find_position_errors(e, run, h),
                                       .scale = m->scale,
                                       .h = h,
                                       .period = period};
  return BAUM_I_HOT_TABLE(m->wide, baum_i_measure_kernel)->local_error(m->nv, &samples);
}

static void remember(baum_i_local_error *e, const baum_simulation *run, double h)
{
  const baum_mechanism *m = run->workspace->mechanism;
  size_t bytes = (size_t)m->nv * sizeof *e->v;
  double *oldest = e->a[BAUM_I_ACCELERATIONS - 1];
  memmove(e->a + 1, e->a, (BAUM_I_ACCELERATIONS - 1) * sizeof *e->a);
  e->a[0] = oldest;
  memcpy(e->a[0], run->workspace->a, bytes);
  memcpy(e->q, run->state.q, (size_t)m->nq * sizeof *e->q);
  memcpy(e->v, run->state.v, bytes);
  e->t = run->state.t;
  e->h = h;
}

double baum_i_local_error_of_step(baum_i_local_error *e, const baum_simulation *run)
{
  double h = run->state.t - e->t;
  double error = 0.0;
  if (e->known > 1 && !(fabs(h - e->h) <= SAME_STEP * fabs(h))) {
    e->known = 1; /* only the acceleration at the start of this step is still useful */
  }
  if (e->known == BAUM_I_ACCELERATIONS) {
    double rate = baum_i_scaled_size(run->workspace->mechanism, run->state.v);
    error = largest_error(e, run, h, 1.0 / fmax(rate, run->problem.rate));
  } else {
    e->known++;
  }
  remember(e, run, h);
  return error;
}
