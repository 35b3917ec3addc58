/* SPDX-License-Identifier: BSD-3-Clause */
/* Two numbers as one vector. */
#ifndef BAUM_I_BASE_PAIR_H
#define BAUM_I_BASE_PAIR_H

typedef double baum_i_pair __attribute__((vector_size(16)));

/* A pair in an array of doubles. Unlike memcpy() and the functions of immintrin.h, stores of this
 * type tell the compiler that they change no integers and pointers, so that it need not load these
 * again. */
typedef double baum_i_pair_in_array __attribute__((vector_size(16), aligned(8)));

static inline baum_i_pair baum_i_load(const double *from)
{
  return *(const baum_i_pair_in_array *)from;
}

static inline void baum_i_store(double *to, baum_i_pair x)
{
  *(baum_i_pair_in_array *)to = x;
}

/* See baum_i_four_rounded(). */
static inline baum_i_pair baum_i_rounded(baum_i_pair product)
{
#ifdef BAUM_I_WIDE
  __asm__("" : "+x"(product));
#endif
  return product;
}

static inline baum_i_pair baum_i_both(double x)
{
  return (baum_i_pair){x, x};
}

/* Return (-y, x), which is p rotated by +90 degrees. This is the cross product k x p with the unit
 * vector k along z. */
static inline baum_i_pair baum_i_turned(baum_i_pair p)
{
  return (baum_i_pair){p[1], p[0]} * (baum_i_pair){-1.0, 1.0};
}

/* Return (y, x). */
static inline baum_i_pair baum_i_exchanged(baum_i_pair p)
{
  return (baum_i_pair){p[1], p[0]};
}

/* Return |x|. */
static inline baum_i_pair baum_i_magnitude(baum_i_pair x)
{
  return (baum_i_pair){__builtin_fabs(x[0]), __builtin_fabs(x[1])};
}

/* Return the larger number of x and y at each index. Where either number is NaN, return the number
 * of y. */
static inline baum_i_pair baum_i_larger(baum_i_pair x, baum_i_pair y)
{
  return (baum_i_pair){x[0] > y[0] ? x[0] : y[0], x[1] > y[1] ? x[1] : y[1]};
}

/* Return the scalar product of x and y. The sum stays in a vector register, because it is slow to
 * extract single numbers. */
static inline double baum_i_dot(baum_i_pair x, baum_i_pair y)
{
  baum_i_pair product = x * y;
  return (product + baum_i_exchanged(product))[0];
}

/* A 2 x 2 matrix, stored by columns. */
typedef struct baum_i_square {
  baum_i_pair column[2];
} baum_i_square;

static inline baum_i_square baum_i_load_square(const double *from)
{
  return (baum_i_square){{baum_i_load(from), baum_i_load(from + 2)}};
}

static inline void baum_i_store_square(double *to, baum_i_square m)
{
  baum_i_store(to, m.column[0]);
  baum_i_store(to + 2, m.column[1]);
}

/* Return m + x I. x is added by products with zeros and ones, because valgrind misreports the
 * instruction that sets half a vector. */
static inline baum_i_square baum_i_add_diagonal(baum_i_square m, double x)
{
  return (baum_i_square){
    {m.column[0] + x * (baum_i_pair){1.0, 0.0}, m.column[1] + x * (baum_i_pair){0.0, 1.0}}};
}

/* Return the product m x. */
static inline baum_i_pair baum_i_times(baum_i_square m, baum_i_pair x)
{
  return m.column[0] * x[0] + m.column[1] * x[1];
}

static inline baum_i_square baum_i_transposed(baum_i_square m)
{
  return (baum_i_square){{{m.column[0][0], m.column[1][0]}, {m.column[0][1], m.column[1][1]}}};
}

/* Return the product m^T x. */
static inline baum_i_pair baum_i_transposed_times(baum_i_square m, baum_i_pair x)
{
  baum_i_square products = baum_i_transposed((baum_i_square){{m.column[0] * x, m.column[1] * x}});
  return products.column[0] + products.column[1];
}

/* Return the product m n. */
static inline baum_i_square baum_i_product(baum_i_square m, baum_i_square n)
{
  return (baum_i_square){{baum_i_times(m, n.column[0]), baum_i_times(m, n.column[1])}};
}

/* Return the product m n^T. */
static inline baum_i_square baum_i_times_transposed(baum_i_square m, baum_i_square n)
{
  return (baum_i_square){{m.column[0] * n.column[0][0] + m.column[1] * n.column[1][0],
                          m.column[0] * n.column[0][1] + m.column[1] * n.column[1][1]}};
}

/* Return the matrix x y^T. */
static inline baum_i_square baum_i_outer_product(baum_i_pair x, baum_i_pair y)
{
  return (baum_i_square){{x * y[0], x * y[1]}};
}

#endif
