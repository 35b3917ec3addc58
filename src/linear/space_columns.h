/* SPDX-License-Identifier: BSD-3-Clause */
/* Columns of up to six numbers for the solver of mechanisms in space (space_block.h). A column
 * consists of four numbers and, if the matrix is *tall*, of two more. `tall` and the numbers of
 * columns are compile-time constants wherever speed matters, so that the compiler removes the code
 * that is not needed. */
#ifndef BAUM_I_LINEAR_SPACE_COLUMNS_H
#define BAUM_I_LINEAR_SPACE_COLUMNS_H

#include "base/four.h"
#include "linear/space_block.h"

/* Returns (x_0, x_1, 0, 0). */
BAUM_I_INLINE baum_i_four baum_i_four_of(baum_i_pair x)
{
#ifdef BAUM_I_WIDE
  return _mm256_zextpd128_pd256(x);
#else
  return (baum_i_four){x, {0.0, 0.0}};
#endif
}

/* Returns (low_0, low_1, high_0, high_1). */
BAUM_I_INLINE baum_i_four baum_i_four_joined(baum_i_pair low, baum_i_pair high)
{
#ifdef BAUM_I_WIDE
  return _mm256_set_m128d(high, low);
#else
  return (baum_i_four){low, high};
#endif
}

/* Returns (x_0, y_0, x_2, y_2). */
BAUM_I_INLINE baum_i_four baum_i_four_first(baum_i_four x, baum_i_four y)
{
#ifdef BAUM_I_WIDE
  return _mm256_unpacklo_pd(x, y);
#else
  return (baum_i_four){{x.low[0], y.low[0]}, {x.high[0], y.high[0]}};
#endif
}

/* Returns (x_1, y_1, x_3, y_3). */
BAUM_I_INLINE baum_i_four baum_i_four_second(baum_i_four x, baum_i_four y)
{
#ifdef BAUM_I_WIDE
  return _mm256_unpackhi_pd(x, y);
#else
  return (baum_i_four){{x.low[1], y.low[1]}, {x.high[1], y.high[1]}};
#endif
}

/* sum - x s */
BAUM_I_INLINE baum_i_four baum_i_four_subtract(baum_i_four sum, baum_i_four x, double s)
{
  return baum_i_four_minus(sum, baum_i_four_times(x, baum_i_four_all(s)));
}

/* Returns four sums, each over the four numbers of one vector. */
BAUM_I_INLINE baum_i_four baum_i_four_sums(const baum_i_four x[4])
{
#ifdef BAUM_I_WIDE
  baum_i_four first = _mm256_hadd_pd(x[0], x[1]);
  baum_i_four second = _mm256_hadd_pd(x[2], x[3]);
  return _mm256_permute2f128_pd(first, second, 0x20) + _mm256_permute2f128_pd(first, second, 0x31);
#else
  baum_i_pair s[4];
  for (int i = 0; i < 4; i++) {
    s[i] = x[i].low + x[i].high;
  }
  return (baum_i_four){(baum_i_pair){s[0][0], s[1][0]} + (baum_i_pair){s[0][1], s[1][1]},
                       (baum_i_pair){s[2][0], s[3][0]} + (baum_i_pair){s[2][1], s[3][1]}};
#endif
}

BAUM_I_INLINE baum_i_four baum_i_four_set(double x, double y, double z, double u)
{
#ifdef BAUM_I_WIDE
  return _mm256_setr_pd(x, y, z, u);
#else
  return (baum_i_four){{x, y}, {z, u}};
#endif
}

/* Returns number i, where i is a compile-time constant. */
BAUM_I_INLINE double baum_i_four_get(baum_i_four x, int i)
{
  return i < 2 ? baum_i_four_low(x)[i] : baum_i_four_high(x)[i - 2];
}

/* Replaces number i, where i is a compile-time constant. */
BAUM_I_INLINE baum_i_four baum_i_four_put(baum_i_four x, int i, double s)
{
#ifdef BAUM_I_WIDE
  baum_i_four all = _mm256_set1_pd(s);
  switch (i) {
  case 0: return _mm256_blend_pd(x, all, 1);
  case 1: return _mm256_blend_pd(x, all, 2);
  case 2: return _mm256_blend_pd(x, all, 4);
  default: return _mm256_blend_pd(x, all, 8);
  }
#else
  baum_i_pair *half = i < 2 ? &x.low : &x.high;
  *half = i % 2 == 0 ? (baum_i_pair){s, (*half)[1]} : (baum_i_pair){(*half)[0], s};
  return x;
#endif
}

/* Replaces number i of x by number c of y. Both i and c must be constants. */
BAUM_I_INLINE baum_i_four baum_i_four_move(baum_i_four x, int i, baum_i_four y, int c)
{
#ifdef BAUM_I_WIDE
  baum_i_four all = y;
  switch (c == i ? -1 : c) {
  case -1: break;
  case 0: all = _mm256_permute4x64_pd(y, 0x00); break;
  case 1: all = _mm256_permute4x64_pd(y, 0x55); break;
  case 2: all = _mm256_permute4x64_pd(y, 0xaa); break;
  default: all = _mm256_permute4x64_pd(y, 0xff); break;
  }
  switch (i) {
  case 0: return _mm256_blend_pd(x, all, 1);
  case 1: return _mm256_blend_pd(x, all, 2);
  case 2: return _mm256_blend_pd(x, all, 4);
  default: return _mm256_blend_pd(x, all, 8);
  }
#else
  return baum_i_four_put(x, i, baum_i_four_get(y, c));
#endif
}

BAUM_I_INLINE double baum_i_four_sum(baum_i_four x)
{
  baum_i_pair halves = baum_i_four_low(x) + baum_i_four_high(x);
  return halves[0] + halves[1];
}

/* Returns (x_1, x_2, x_0, x_3). */
BAUM_I_INLINE baum_i_four baum_i_four_rotated(baum_i_four x)
{
#ifdef BAUM_I_WIDE
  return _mm256_permute4x64_pd(x, 0xc9);
#else
  return (baum_i_four){{x.low[1], x.high[0]}, {x.low[0], x.high[1]}};
#endif
}

/* Returns (x_1, x_2, x_3, x_0). */
BAUM_I_INLINE baum_i_four baum_i_four_next(baum_i_four x)
{
#ifdef BAUM_I_WIDE
  return _mm256_permute4x64_pd(x, 0x39);
#else
  return (baum_i_four){{x.low[1], x.high[0]}, {x.high[1], x.low[0]}};
#endif
}

/* Returns (x_2, x_3, x_0, x_1). */
BAUM_I_INLINE baum_i_four baum_i_four_swapped(baum_i_four x)
{
#ifdef BAUM_I_WIDE
  return _mm256_permute2f128_pd(x, x, 0x01);
#else
  return (baum_i_four){x.high, x.low};
#endif
}

/* Sets the columns of a symmetric matrix with the entries (i, i) = x_i, (i, i + 1) = y_i and
 * (i, i + 2) = z_i, where indices are modulo 4. */
BAUM_I_INLINE void baum_i_four_symmetric(baum_i_four x, baum_i_four y, baum_i_four z,
                                         baum_i_four out[4])
{
#ifdef BAUM_I_WIDE
  baum_i_four xy = _mm256_unpacklo_pd(x, y);                                /* x0 y0 x2 y2 */
  baum_i_four zy = _mm256_shuffle_pd(z, y, 0xa);                            /* z0 y1 z0 y3 */
  baum_i_four yx = _mm256_blend_pd(y, x, 0xa);                              /* y0 x1 y2 x3 */
  baum_i_four yz = _mm256_blend_pd(_mm256_permute4x64_pd(y, 0x13), z, 0xa); /* y3 z1 y1 z1 */
  out[0] = _mm256_blend_pd(xy, zy, 0xc);
  out[1] = _mm256_blend_pd(yx, yz, 0xc);
  out[2] = _mm256_blend_pd(zy, xy, 0xc);
  out[3] = _mm256_blend_pd(yz, yx, 0xc);
#else
  out[0] = (baum_i_four){{x.low[0], y.low[0]}, {z.low[0], y.high[1]}};
  out[1] = (baum_i_four){{y.low[0], x.low[1]}, {y.low[1], z.low[1]}};
  out[2] = (baum_i_four){{z.low[0], y.low[1]}, {x.high[0], y.high[0]}};
  out[3] = (baum_i_four){{y.high[1], z.low[1]}, {y.high[0], x.high[1]}};
#endif
}

/* Returns the cross product of the first three numbers. The fourth number of the result is 0 or a
 * rounding error. */
BAUM_I_INLINE baum_i_four baum_i_four_cross(baum_i_four x, baum_i_four y)
{
  baum_i_four first = baum_i_four_times(x, baum_i_four_rotated(y));
  baum_i_four second = baum_i_four_times(baum_i_four_rotated(x), y);
  return baum_i_four_rotated(baum_i_four_minus(first, second));
}

BAUM_I_INLINE baum_i_four baum_i_four_zero(void)
{
  return baum_i_four_all(0.0);
}

/* Sets m to the vectors (x_0, y_1, z_2), (z_0, x_1, y_2) and (y_0, z_1, x_2), each followed by
 * x_3. */
BAUM_I_INLINE void baum_i_four_mix(baum_i_four x, baum_i_four y, baum_i_four z, baum_i_four m[3])
{
  m[0] = baum_i_four_move(baum_i_four_move(x, 1, y, 1), 2, z, 2);
  m[1] = baum_i_four_move(baum_i_four_move(x, 2, y, 2), 0, z, 0);
  m[2] = baum_i_four_move(baum_i_four_move(x, 0, y, 0), 1, z, 1);
}

/* Returns A x, where a column of A begins after every `stride` numbers of axes[]. */
BAUM_I_INLINE baum_i_four baum_i_four_combined(const double *axes, int stride, const double *x)
{
  baum_i_four sum = baum_i_four_times(baum_i_four_load(axes), baum_i_four_all(x[0]));
  sum = baum_i_four_add(sum, baum_i_four_load(axes + stride), x[1]);
  return baum_i_four_add(sum, baum_i_four_load(axes + 2 * stride), x[2]);
}

/* Returns A x, where `axes` contains the columns of A, each followed by one number. */
BAUM_I_INLINE baum_i_four baum_i_four_turned(const double *axes, const double *x)
{
  return baum_i_four_combined(axes, 4, x);
}

/* One column, or a vector. */
typedef struct baum_i_space_column {
  baum_i_four low;
  baum_i_pair high;
} baum_i_space_column;

/* Loads column c of a matrix with `columns` columns. */
BAUM_I_INLINE baum_i_space_column baum_i_column_load(const double *m, int columns, int c, bool tall)
{
  baum_i_space_column x = {.low = baum_i_four_load(m + 4 * c)};
  x.high = tall ? baum_i_load(m + 4 * columns + 2 * c) : (baum_i_pair){0.0, 0.0};
  return x;
}

BAUM_I_INLINE void baum_i_column_store(double *m, int columns, int c, bool tall,
                                       baum_i_space_column x)
{
  baum_i_four_store(m + 4 * c, x.low);
  if (tall) {
    baum_i_store(m + 4 * columns + 2 * c, x.high);
  }
}

/* sum + x s. The vector of copies of s is used for both parts, because the compiler would otherwise
 * make it twice. */
BAUM_I_INLINE baum_i_space_column baum_i_column_add(baum_i_space_column sum, baum_i_space_column x,
                                                    double s, bool tall)
{
  baum_i_four all = baum_i_four_all(s);
  sum.low = baum_i_four_plus(sum.low, baum_i_four_times(x.low, all));
  if (tall) {
    sum.high += x.high * baum_i_four_low(all);
  }
  return sum;
}

BAUM_I_INLINE baum_i_space_column baum_i_column_subtract(baum_i_space_column sum,
                                                         baum_i_space_column x, double s, bool tall)
{
  baum_i_four all = baum_i_four_all(s);
  sum.low = baum_i_four_minus(sum.low, baum_i_four_times(x.low, all));
  if (tall) {
    sum.high -= x.high * baum_i_four_low(all);
  }
  return sum;
}

BAUM_I_INLINE baum_i_space_column baum_i_column_times(baum_i_space_column x, double s, bool tall)
{
  baum_i_four all = baum_i_four_all(s);
  x.low = baum_i_four_times(x.low, all);
  if (tall) {
    x.high *= baum_i_four_low(all);
  }
  return x;
}

/* x + y */
BAUM_I_INLINE baum_i_space_column baum_i_column_plus(baum_i_space_column x, baum_i_space_column y,
                                                     bool tall)
{
  x.low = baum_i_four_plus(x.low, y.low);
  x.high = tall ? x.high + y.high : x.high;
  return x;
}

/* x - y */
BAUM_I_INLINE baum_i_space_column baum_i_column_minus(baum_i_space_column x, baum_i_space_column y,
                                                      bool tall)
{
  x.low = baum_i_four_minus(x.low, y.low);
  x.high = tall ? x.high - y.high : x.high;
  return x;
}

/* Returns the products of the numbers of two columns, row by row. */
BAUM_I_INLINE baum_i_space_column baum_i_column_product(baum_i_space_column x,
                                                        baum_i_space_column y, bool tall)
{
  x.low = baum_i_four_times(x.low, y.low);
  x.high = tall ? x.high * y.high : x.high;
  return x;
}

/* x y - z u, row by row, where z u is rounded. */
BAUM_I_INLINE baum_i_space_column baum_i_column_cross(baum_i_space_column x, baum_i_space_column y,
                                                      baum_i_space_column z, baum_i_space_column u,
                                                      bool tall)
{
  x.low = baum_i_four_minus(baum_i_four_times(x.low, y.low),
                            baum_i_four_rounded(baum_i_four_times(z.low, u.low)));
  x.high = tall ? x.high * y.high - baum_i_rounded(z.high * u.high) : x.high;
  return x;
}

/* Returns the index of an entry in a matrix with `columns` columns. */
BAUM_I_INLINE ptrdiff_t baum_i_column_entry(int columns, int row, int column)
{
  return row < 4 ? 4 * column + row : 4 * columns + 2 * column + row - 4;
}

/* Returns the unit vector whose last of n numbers is 1. */
BAUM_I_INLINE baum_i_space_column baum_i_column_last(int n, bool tall)
{
  static const double UNITS[14] = {[7] = 1.0};
  return baum_i_column_load(UNITS + 8 - n, 1, 0, tall);
}

/* Returns m^T lambda for a matrix m with three columns. */
BAUM_I_INLINE baum_i_four baum_i_column_transposed_times(const double *m,
                                                         baum_i_space_column lambda, bool tall)
{
  baum_i_four products[4];
  for (int c = 0; c < 3; c++) {
    baum_i_space_column g = baum_i_column_load(m, 3, c, tall);
    products[c] = baum_i_four_times(g.low, lambda.low);
    if (tall) {
      products[c] = baum_i_four_plus(products[c], baum_i_four_of(g.high * lambda.high));
    }
  }
  products[3] = baum_i_four_zero();
  return baum_i_four_sums(products);
}

/* Returns the angular acceleration L^-T y. */
BAUM_I_INLINE baum_i_four baum_i_space_unwhitened(const baum_i_space_body *body, const double *y)
{
  baum_i_four sum = baum_i_four_times(baum_i_four_load(body->columns), baum_i_four_all(y[0]));
  sum = baum_i_four_add(sum, baum_i_four_load(body->columns + 4), y[1]);
  return baum_i_four_add(sum, baum_i_four_load(body->columns + 8), y[2]);
}

#endif
