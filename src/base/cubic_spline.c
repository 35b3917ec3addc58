/* SPDX-License-Identifier: BSD-3-Clause */
/* Cubic splines. Let y_i be the given value at the time t_i, and d = t - t_i. On the interval of
 * length h_i from t_i to t_i+1, the spline s is
 *
 *   s = y_i + b_i d + c_i d^2 + (c_i+1 - c_i) / (3 h_i) d^3
 *   b_i = (y_i+1 - y_i) / h_i - h_i (2 c_i + c_i+1) / 3
 *
 * The first derivative s' is continuous at t_i if the coefficients c satisfy
 *
 *   h_i-1 c_i-1 + 2 (h_i-1 + h_i) c_i + h_i c_i+1
 *     = 3 ((y_i+1 - y_i) / h_i - (y_i - y_i-1) / h_i-1)
 *
 * The equations at all inner points form a diagonally dominant system, which needs no pivoting. A
 * natural spline has c = 0 at both ends. A periodic spline has the coefficients c + p z, where c is
 * the solution of the natural spline and z solves the homogeneous equations with z = 1 at both
 * ends. The number p is chosen so that the equation above also holds at the point where the two
 * ends meet.
 *
 *   C. de Boor, A Practical Guide to Splines, Springer 1978, chapter IV
 */
#include "base/cubic_spline.h"

#include "base/alloc.h"

static double length_after(const baum_i_cubic_spline *spline, int32_t i)
{
  return spline->times[i + 1] - spline->times[i];
}

static double slope_after(const baum_i_cubic_spline *spline, int32_t i)
{
  return (spline->values[i + 1] - spline->values[i]) / length_after(spline, i);
}

/* Find the coefficients c of the natural spline, and the solution z (count) of the homogeneous
 * equations. `upper` (count) is zeroed scratch memory. */
static void solve_natural(const baum_i_cubic_spline *spline, double *upper, double *z)
{
  double *c = spline->bends;
  int32_t last = spline->count - 1;
  c[0] = c[last] = 0.0;
  z[0] = z[last] = 1.0;
  for (int32_t i = 1; i < last; i++) {
    double before = length_after(spline, i - 1);
    double after = length_after(spline, i);
    double diagonal = 2.0 * (before + after) - before * upper[i - 1];
    double right = 3.0 * (slope_after(spline, i) - slope_after(spline, i - 1));
    upper[i] = after / diagonal;
    c[i] = (right - before * c[i - 1]) / diagonal;
    z[i] = -before * z[i - 1] / diagonal;
  }
  for (int32_t i = last - 1; i > 0; i--) {
    c[i] -= upper[i] * c[i + 1];
    z[i] -= upper[i] * z[i + 1];
  }
}

static void join_ends(const baum_i_cubic_spline *spline, const double *z)
{
  double *c = spline->bends;
  int32_t last = spline->count - 1;
  double before = length_after(spline, last - 1);
  double after = length_after(spline, 0);
  double right = 3.0 * (slope_after(spline, 0) - slope_after(spline, last - 1));
  double p = (right - before * c[last - 1] - after * c[1]) /
             (before * (2.0 + z[last - 1]) + after * (2.0 + z[1]));
  for (int32_t i = 0; i <= last; i++) {
    c[i] += p * z[i];
  }
}

baum_status baum_i_cubic_spline_fit(const baum_i_cubic_spline *spline, bool periodic)
{
  double *work = baum_i_alloc(2 * (size_t)spline->count, sizeof *work);
  if (!work) {
    return BAUM_ERR_MEMORY;
  }
  double *z = work + spline->count;
  solve_natural(spline, work, z);
  if (periodic) {
    join_ends(spline, z);
  }
  baum_i_free(work);
  return BAUM_OK;
}

/* Find the interval that contains a time. */
static int32_t find_interval(const baum_i_cubic_spline *spline, double time)
{
  int32_t low = 0;
  int32_t high = spline->count - 1;
  while (high - low > 1) {
    int32_t middle = low + (high - low) / 2;
    if (time < spline->times[middle]) {
      high = middle;
    } else {
      low = middle;
    }
  }
  return low;
}

void baum_i_cubic_spline_evaluate(const baum_i_cubic_spline *spline, double time, double s[3])
{
  int32_t i = find_interval(spline, time);
  const double *c = spline->bends + i;
  double h = length_after(spline, i);
  double d = time - spline->times[i];
  double b = slope_after(spline, i) - h * (2.0 * c[0] + c[1]) / 3.0;
  double third = (c[1] - c[0]) / (3.0 * h);
  s[0] = spline->values[i] + d * (b + d * (c[0] + d * third));
  s[1] = b + d * (2.0 * c[0] + d * 3.0 * third);
  s[2] = 2.0 * c[0] + d * 6.0 * third;
}
