/* SPDX-License-Identifier: BSD-3-Clause */
/* With l_k the Lagrange polynomials of the times, l_k(t_i) = 1 for i = k and 0 else, and s_k = l_k'(t_k):
 *
 *   p(t) = sum_k (1 - 2 s_k (t - t_k)) l_k(t)^2 q_k + (t - t_k) l_k(t)^2 v_k
 *
 * (J. Stoer, R. Bulirsch, Introduction to Numerical Analysis, section 2.1.5.) The factors of q_k and v_k are the same for
 * all coordinates. Those of the q_k have the sum 1, their rates the sum 0: q_k - q_0 stands for q_k, so that angles after
 * many turns lose nothing.
 */
#include "simulate/hermite.h"

/* What belongs to a knot at a time. */
typedef struct factors {
  double q;
  double v;
  double q_rate;
  double v_rate;
} factors;

static factors find_factors(const baum_i_knot *knots, int count, int k, double t)
{
  double l = 1.0;
  double rate = 0.0; /* of l */
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

void baum_i_hermite(const baum_i_knot *knots, int count, int n, double t, double *q, double *v)
{
  for (int i = 0; i < n; i++) {
    q[i] = v[i] = 0.0;
  }
  for (int k = 0; k < count; k++) {
    factors f = find_factors(knots, count, k, t);
    for (int i = 0; i < n; i++) {
      double from_first = knots[k].q[i] - knots[0].q[i];
      q[i] += f.q * from_first + f.v * knots[k].v[i];
      v[i] += f.q_rate * from_first + f.v_rate * knots[k].v[i];
    }
  }
  for (int i = 0; i < n; i++) {
    q[i] += knots[0].q[i];
  }
}
