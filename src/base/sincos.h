/* SPDX-License-Identifier: BSD-3-Clause */
/* Sine and cosine of one angle without branches or tables, so that compilers vectorize loops over
 * angles. The error is below 1 ulp (unit in the last place) for angles up to 1e6 rad. For larger
 * angles callers use the C library.
 *
 * x = n pi/2 + r + y,  |r| <= pi/4,  y is the part of the remainder that r cannot represent
 *
 * The number pi/2 is represented as a sum of four parts. The first three have 33 bits, so that
 * their products with n (at most 20 bits) are exact (W. J. Cody, W. Waite, 1980). The rounding
 * errors of the differences are computed and included in r and y (D. E. Knuth, 1969). The
 * polynomials are those of fdlibm (K. C. Ng, Sun Microsystems, 1993).
 */
#ifndef BAUM_I_BASE_SINCOS_H
#define BAUM_I_BASE_SINCOS_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Up to this angle [rad], n has at most 20 bits. */
static const double baum_i_sincos_limit = 1e6;

/* Return the rounding error of rounded = a - b. */
static inline double baum_i_difference_error(double a, double b, double rounded)
{
  double moved = rounded - a;
  return (a - (rounded - moved)) - (b + moved);
}

static inline double baum_i_sine_kernel(double r, double y)
{
  static const double s1 = -1.66666666666666324348e-01;
  static const double s2 = 8.33333333332248946124e-03;
  static const double s3 = -1.98412698298579493134e-04;
  static const double s4 = 2.75573137070700676789e-06;
  static const double s5 = -2.50507602534068634195e-08;
  static const double s6 = 1.58969099521155010221e-10;
  double z = r * r;
  double cube = z * r;
  double tail = s2 + z * (s3 + z * (s4 + z * (s5 + z * s6)));
  return r - ((z * (0.5 * y - cube * tail) - y) - cube * s1);
}

static inline double baum_i_cosine_kernel(double r, double y)
{
  static const double c1 = 4.16666666666666019037e-02;
  static const double c2 = -1.38888888888741095749e-03;
  static const double c3 = 2.48015872894767294178e-05;
  static const double c4 = -2.75573143513906633035e-07;
  static const double c5 = 2.08757232129817482790e-09;
  static const double c6 = -1.13596475577881948265e-11;
  double z = r * r;
  double square = z * z;
  double tail = z * (c1 + z * (c2 + z * c3)) + square * square * (c4 + z * (c5 + z * c6));
  double half = 0.5 * z;
  double w = 1.0 - half;
  return w + (((1.0 - w) - half) + (z * tail - r * y));
}

/* Compute sine and cosine of x for |x| up to baum_i_sincos_limit. For larger x the results are
 * meaningless. */
static inline void baum_i_sincos(double x, double *sine, double *cosine)
{
  static const double two_over_pi = 0x1.45f306dc9c883p-1;
  /* After this constant is added to a number, the last bits of the sum contain the number rounded
   * to an integer. */
  static const double to_integer = 0x1.8p52;
  static const double part1 = 1.57079632673412561417e+00;
  static const double part2 = 6.07710050630396597660e-11;
  static const double part3 = 2.02226624871116645580e-21;
  static const double part4 = 8.47842766036889956997e-32;
  double shifted = x * two_over_pi + to_integer;
  double n = shifted - to_integer;
  int64_t quadrant;
  memcpy(&quadrant, &shifted, sizeof quadrant);
  double first = x - n * part1;
  double second = first - n * part2;
  double third = second - n * part3;
  double tail = baum_i_difference_error(first, n * part2, second) +
                baum_i_difference_error(second, n * part3, third) - n * part4;
  double r = third + tail;
  double y = (third - r) + tail;
  double s = baum_i_sine_kernel(r, y);
  double c = baum_i_cosine_kernel(r, y);
  double turned_s = (quadrant & 1) != 0 ? c : s;
  double turned_c = (quadrant & 1) != 0 ? s : c;
  *sine = (quadrant & 2) != 0 ? -turned_s : turned_s;
  *cosine = ((quadrant + 1) & 2) != 0 ? -turned_c : turned_c;
}

#endif
