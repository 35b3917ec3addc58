/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes a polynomial p(t) that passes through several states, called knots, with their
 * velocities. Let l_k be the Lagrange polynomials of the times t_i. Each is 1 at its own time,
 * l_k(t_k) = 1, and 0 at the other times. With s_k = l_k'(t_k) the polynomial is
 *
 *   p(t) = sum_k (1 - 2 s_k (t - t_k)) l_k(t)^2 q_k + (t - t_k) l_k(t)^2 q'_k,  q'_k = N(q_k) v_k
 *
 * The velocity is v = N^+ p'. (J. Stoer, R. Bulirsch, Introduction to Numerical Analysis, section
 * 2.1.5.) The factors of q_k and of q'_k are the same for all coordinates. The factors of q_k add
 * up to 1, and the derivatives of these factors add up to 0. p is therefore computed as q_0 plus
 * the combination of the differences q_k - q_0. Computed in this way, angles lose no digits even
 * after many revolutions.
 */
#include "simulate/hermite.h"

#include <string.h>

/* The factors of one knot k in the polynomial p and in its derivative. */
typedef struct factors {
  double q;      /* factor of q_k in p(t) */
  double v;      /* factor of q'_k in p(t) */
  double q_rate; /* factor of q_k in p'(t) */
  double v_rate; /* factor of q'_k in p'(t) */
} factors;

static factors find_factors(const baum_i_knot *knots, int count, int k, double t)
{
  double l = 1.0;
  double rate = 0.0; /* derivative of the Lagrange polynomial l */
  double slope = 0.0;
  for (int i = 0; i < count; i++) {
    if (i != k) {
      double apart = knots[k].t - knots[i].t;
      double share = (t - knots[i].t) / apart;
      rate = rate * share + l / apart;
      l *= share;
      slope += 1.0 / apart;
    }
  }
  double x = t - knots[k].t;
  double square = l * l;
  double square_rate = 2.0 * l * rate;
  double line = 1.0 - 2.0 * slope * x;
  return (factors){line * square, x * square, line * square_rate - 2.0 * slope * square,
                   square + x * square_rate};
}

void baum_i_hermite(const baum_mechanism *m, const baum_i_knot *knots, int count, double t,
                    double *q, double *v, double *work)
{
  double *slope = m->flat ? v : work; /* q', the derivative of p */
  double *room = work + m->nq;
  for (int i = 0; i < m->nq; i++) {
    q[i] = slope[i] = 0.0;
  }
  for (int k = 0; k < count; k++) {
    factors f = find_factors(knots, count, k, t);
    const double *rate = baum_i_rates(m, knots[k].q, knots[k].v, room);
    for (int i = 0; i < m->nq; i++) {
      double from_first = knots[k].q[i] - knots[0].q[i];
      q[i] += f.q * from_first + f.v * rate[i];
      slope[i] += f.q_rate * from_first + f.v_rate * rate[i];
    }
  }
  for (int i = 0; i < m->nq; i++) {
    q[i] += knots[0].q[i];
  }
  if (!m->flat) {
    baum_i_normalize(m, q);
    memcpy(v, baum_i_tangent(m, q, slope, room), (size_t)m->nv * sizeof *v);
  }
}
