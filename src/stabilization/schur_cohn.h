/* SPDX-License-Identifier: BSD-3-Clause */
/* Where the roots of a polynomial with complex coefficients lie, without finding the roots. */
#ifndef BAUM_I_STABILIZATION_SCHUR_COHN_H
#define BAUM_I_STABILIZATION_SCHUR_COHN_H

enum { BAUM_I_SCHUR_COHN_DEGREE = 12 };

/* c[0] + c[1] z + ... + c[degree] z^degree; c[k] is a real and an imaginary part. */
typedef struct baum_i_polynomial {
  int degree; /* 0 .. BAUM_I_SCHUR_COHN_DEGREE */
  double c[BAUM_I_SCHUR_COHN_DEGREE + 1][2];
} baum_i_polynomial;

/* Positive: all roots have |z| < radius. Otherwise some root has |z| >= radius. The smaller its
 * size, the nearer a root is to the circle; below about 1e-12 rounding decides. radius > 0. */
double baum_i_schur_cohn_margin(const baum_i_polynomial *p, double radius);

/* Returns the largest |z|, within 1e-9 of itself where no other root is as large, and within about
 * 1e-16^(1/(m+1)) for a root of multiplicity m, because the test divides by the distance to the
 * last root. Infinite beyond double. c[degree] = 1. */
double baum_i_schur_cohn_radius(const baum_i_polynomial *p);

#endif
