/* SPDX-License-Identifier: BSD-3-Clause */
/* What one step of a method makes of a violation with Phi'' + 2 alpha Phi' + beta^2 Phi = 0.
 * Everything is in A = |alpha h| and B = (beta h)^2.
 */
#ifndef BAUM_I_STABILIZATION_AMPLIFICATION_H
#define BAUM_I_STABILIZATION_AMPLIFICATION_H

#include <baum/stabilization.h>

/* The kinds of method that the mathematics here knows. */
typedef enum baum_i_method_kind {
  BAUM_I_METHOD_VARIABLE_STEP = 0, /* no fixed region */
  BAUM_I_METHOD_ONE_STEP,          /* z = R(mu), R(mu) = sum coefficients[k] mu^k */
  BAUM_I_METHOD_SEMI_IMPLICIT      /* z^2 + (B + 2 A - 2) z + (1 - 2 A) */
} baum_i_method_kind;

enum { BAUM_I_METHOD_DEGREE = 4 };

/* Description that an integrator carries of itself. */
typedef struct baum_i_method {
  baum_i_method_kind kind;
  int degree;
  double coefficients[BAUM_I_METHOD_DEGREE + 1];
} baum_i_method;

/* Fill every field of out but struct_size. */
void baum_i_amplification(const baum_i_method *method, double alpha_h, double beta2_h2,
                          baum_amplification *out);

/* Largest stable alpha h at alpha = damping_ratio beta; fixed-step methods only. */
double baum_i_stability_limit(const baum_i_method *method, double damping_ratio);

/* Point of least spectral radius; the exact dead-beat point where there is one. */
void baum_i_stability_deadbeat(const baum_i_method *method, double *alpha_h, double *beta2_h2);

/* Nearest point with spectral radius <= 0.9. */
void baum_i_stability_nearest(const baum_i_method *method, double alpha_h, double beta2_h2,
                              double *good_alpha_h, double *good_beta2_h2);

#endif
