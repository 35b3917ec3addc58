/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's form with every time taken twice, z_0 = z_1 = t_0, z_2 = z_3 = t_1, ...:
 *
 *   p(t) = sum_k f[z_0 ... z_k] (t - z_0) ... (t - z_(k-1)),  f[z_i z_i] = v_i
 *
 * (J. Stoer, R. Bulirsch, Introduction to Numerical Analysis, section 2.1.5.)
 */
#include "simulate/hermite.h"

#include <stdbool.h>

enum { ORDER = 2 * BAUM_I_HERMITE_MOST };

/* f[z_0 ... z_k] of coordinate i. */
static void divided_differences(const baum_i_knot *knots, int count, int i, double f[ORDER])
{
  int n = 2 * count;
  for (int k = 0; k < n; k++) {
    f[k] = knots[k / 2].q[i];
  }
  for (int order = 1; order < n; order++) {
    for (int k = n - 1; k >= order; k--) {
      double apart = knots[k / 2].t - knots[(k - order) / 2].t;
      bool twice = order == 1 && k % 2 == 1;
      f[k] = twice ? knots[k / 2].v[i] : (f[k] - f[k - 1]) / apart;
    }
  }
}

void baum_i_hermite(const baum_i_knot *knots, int count, int n, double t, double *q, double *v)
{
  double f[ORDER];
  for (int i = 0; i < n; i++) {
    divided_differences(knots, count, i, f);
    double value = f[2 * count - 1];
    double rate = 0.0;
    for (int k = 2 * count - 2; k >= 0; k--) {
      double x = t - knots[k / 2].t;
      rate = rate * x + value;
      value = value * x + f[k];
    }
    q[i] = value;
    v[i] = rate;
  }
}
