/* SPDX-License-Identifier: BSD-3-Clause */
/* Loops over arrays, with vectors of four numbers. If one to three numbers remain at the end, each
 * of them is processed as a vector of four equal numbers. */
#include <math.h>

#include "base/four.h"
#include "base/measure.h"

enum { LANES = 4 };

typedef baum_i_four take_fn(const double *x);

BAUM_I_INLINE baum_i_four take_four(const double *x)
{
  return baum_i_four_gathered(x, x + 2);
}

BAUM_I_INLINE baum_i_four take_one(const double *x)
{
  return baum_i_four_all(*x);
}

BAUM_I_INLINE double largest_of(baum_i_four x)
{
  baum_i_pair both = baum_i_larger(baum_i_four_low(x), baum_i_four_high(x));
  return both[0] > both[1] ? both[0] : both[1];
}

/* Add 0 x to a sum. The sum stays 0, or becomes NaN if a number of x is not finite. */
BAUM_I_INLINE baum_i_four add_zeros(baum_i_four sum, baum_i_four x)
{
  return baum_i_four_plus(sum, baum_i_four_times(baum_i_four_all(0.0), x));
}

BAUM_I_INLINE bool is_zero(baum_i_four sum)
{
  baum_i_pair both = baum_i_four_low(sum) + baum_i_four_high(sum);
  return both[0] + both[1] == 0.0;
}

static bool is_finite(int n, const double *x)
{
  baum_i_four zeros = baum_i_four_all(0.0);
  int i = 0;
  for (; i + LANES <= n; i += LANES) {
    zeros = add_zeros(zeros, take_four(x + i));
  }
  for (; i < n; i++) {
    zeros = add_zeros(zeros, take_one(x + i));
  }
  return is_zero(zeros);
}

/* ---- largest numbers ---- */

typedef struct sizes {
  baum_i_four most;
  baum_i_four zeros;
} sizes;

BAUM_I_INLINE sizes add_size(sizes sum, baum_i_four x)
{
  return (sizes){baum_i_four_larger(baum_i_four_magnitude(x), sum.most), add_zeros(sum.zeros, x)};
}

static double largest(int n, const double *x)
{
  sizes sum = {baum_i_four_all(0.0), baum_i_four_all(0.0)};
  int i = 0;
  for (; i + LANES <= n; i += LANES) {
    sum = add_size(sum, take_four(x + i));
  }
  for (; i < n; i++) {
    sum = add_size(sum, take_one(x + i));
  }
  return is_zero(sum.zeros) ? largest_of(sum.most) : (double)NAN;
}

BAUM_I_INLINE baum_i_four scaled(const double *x, const double *scale, take_fn *take)
{
  return baum_i_four_over(baum_i_four_magnitude(take(x)), take(scale));
}

static double largest_scaled(int n, const double *x, const double *scale)
{
  baum_i_four most = baum_i_four_all(0.0);
  int i = 0;
  for (; i + LANES <= n; i += LANES) {
    most = baum_i_four_larger(scaled(x + i, scale + i, take_four), most);
  }
  for (; i < n; i++) {
    most = baum_i_four_larger(scaled(x + i, scale + i, take_one), most);
  }
  return largest_of(most);
}

/* ---- local errors, see simulate/local_error.c ---- */

BAUM_I_INLINE baum_i_four times(double factor, baum_i_four x)
{
  return baum_i_four_times(baum_i_four_all(factor), x);
}

BAUM_I_INLINE baum_i_four change(const double *const ends[2], int i, take_fn *take)
{
  return baum_i_four_minus(take(ends[1] + i), take(ends[0] + i));
}

BAUM_I_INLINE baum_i_four error_of_velocity(const baum_i_step_samples *s, int i, take_fn *take)
{
  static const double WEIGHTS[] = {251.0, 646.0, -264.0, 106.0, -19.0};
  baum_i_four sum = baum_i_four_all(0.0);
  BAUM_I_UNROLL(5)
  for (int k = 0; k < 5; k++) {
    sum = baum_i_four_plus(sum, times(WEIGHTS[k], take(s->a[k] + i)));
  }
  return baum_i_four_minus(change(s->v, i, take), times(s->h / 720.0, sum));
}

BAUM_I_INLINE baum_i_four error_of_position(const baum_i_step_samples *s, int i, take_fn *take)
{
  const double *const bends[2] = {s->a[1], s->a[0]};
  double h = s->h;
  baum_i_four rates = baum_i_four_plus(take(s->v[0] + i), take(s->v[1] + i));
  baum_i_four sum = baum_i_four_minus(change(s->q, i, take), times(0.5 * h, rates));
  return baum_i_four_plus(sum, times(h * h / 12.0, change(bends, i, take)));
}

BAUM_I_INLINE baum_i_four error_at(const baum_i_step_samples *s, int i, take_fn *take)
{
  baum_i_four dv = error_of_velocity(s, i, take);
  baum_i_four dq = s->dq ? take(s->dq + i) : error_of_position(s, i, take);
  dq = baum_i_four_plus(dq, times(0.5 * s->h, dv));
  baum_i_four error =
    baum_i_four_plus(baum_i_four_magnitude(dq), times(s->period, baum_i_four_magnitude(dv)));
  return baum_i_four_over(error, take(s->scale + i));
}

static double local_error(int n, const baum_i_step_samples *samples)
{
  const baum_i_step_samples s = *samples; /* a copy, which the compiler keeps in registers */
  baum_i_four most = baum_i_four_all(0.0);
  int i = 0;
  for (; i + LANES <= n; i += LANES) {
    most = baum_i_four_larger(error_at(&s, i, take_four), most);
  }
  for (; i < n; i++) {
    most = baum_i_four_larger(error_at(&s, i, take_one), most);
  }
  return largest_of(most);
}

const baum_i_measure_kernel BAUM_I_HOT(baum_i_measure_kernel) = {
  .largest = largest,
  .largest_scaled = largest_scaled,
  .is_finite = is_finite,
  .local_error = local_error,
};
