/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests where the roots of a polynomial with complex coefficients are, without computing the
 * roots. */
#ifndef BAUM_I_STABILIZATION_SCHUR_COHN_H
#define BAUM_I_STABILIZATION_SCHUR_COHN_H

enum { BAUM_I_SCHUR_COHN_DEGREE = 12 };

/* The polynomial c[0] + c[1] z + ... + c[degree] z^degree. Each coefficient c[k] consists of a real
 * and an imaginary part. */
typedef struct baum_i_polynomial {
  int degree; /* 0 .. BAUM_I_SCHUR_COHN_DEGREE */
  double c[BAUM_I_SCHUR_COHN_DEGREE + 1][2];
} baum_i_polynomial;

/* Returns a positive margin if all roots have |z| < radius. Otherwise returns zero or a negative
 * margin. A small margin means that a root is close to the circle. If the margin is below about
 * 1e-12, rounding determines its sign. `radius` must be > 0. */
double baum_i_schur_cohn_margin(const baum_i_polynomial *p, double radius);

/* Returns the largest |z| of all roots, or infinity on overflow. The relative error is below 1e-9
 * if no other root is as large. If the largest root has the multiplicity m, rounding causes a
 * relative error of about 1e-16^(1/(m+1)). c[degree] must be 1. */
double baum_i_schur_cohn_radius(const baum_i_polynomial *p);

#endif
