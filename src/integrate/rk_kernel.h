/* SPDX-License-Identifier: BSD-3-Clause */
/* The loops of Runge-Kutta methods over rates K_j of n numbers each, where n is a multiple of
 * BAUM_I_RK_LANES. They are optimized because plain loops would cost as much as the evaluations of
 * the accelerations if the mechanism has few bodies. */
#ifndef BAUM_I_INTEGRATE_RK_KERNEL_H
#define BAUM_I_INTEGRATE_RK_KERNEL_H

enum { BAUM_I_RK_LANES = 8 };

typedef struct baum_i_rk_kernel {
  /* out = base + h sum_j weights_j K_j over the first `count` rates; out may be base. */
  void (*combine)(int n, int count, const double *weights, double h, const double *rates,
                  const double *base, double *out);
  /* out = base + x (F_1 + (1 - x) (F_2 + x (F_3 + ...))) over `count` terms of n numbers each. */
  void (*interpolate)(int n, int count, double x, const double *terms, const double *base,
                      double *out);
  /* sum_i (scale_i sum_j weights_j K_ji)^2 */
  double (*square)(int n, int count, const double *weights, const double *rates,
                   const double *scale);
} baum_i_rk_kernel;

extern const baum_i_rk_kernel baum_i_rk_kernel_plain;
extern const baum_i_rk_kernel baum_i_rk_kernel_wide;

#endif
