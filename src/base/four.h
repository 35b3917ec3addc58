/* SPDX-License-Identifier: BSD-3-Clause */
/* Four numbers in two halves. They are one vector in code for processors with vectors of this size,
 * and otherwise two pairs. Moving numbers between the halves is slow, so only the functions that
 * join or split halves do so.
 */
#ifndef BAUM_I_BASE_FOUR_H
#define BAUM_I_BASE_FOUR_H

#include "base/hot.h"
#include "base/pair.h"

#ifdef BAUM_I_WIDE

#include <immintrin.h>

typedef __m256d baum_i_four;

/* See baum_i_pair_in_array. */
typedef double baum_i_four_in_array __attribute__((vector_size(32), aligned(8)));

/* Load one pair from each of the two addresses. */
BAUM_I_INLINE baum_i_four baum_i_four_gathered(const double *low, const double *high)
{
  return _mm256_loadu2_m128d(high, low);
}

/* Return the vector (x, y, x, y). */
BAUM_I_INLINE baum_i_four baum_i_four_in_turns(double x, double y)
{
  return _mm256_setr_pd(x, y, x, y);
}

/* Return the vector (*low, *low, *high, *high). */
BAUM_I_INLINE baum_i_four baum_i_four_spread(const double *low, const double *high)
{
  return _mm256_blend_pd(_mm256_broadcast_sd(low), _mm256_broadcast_sd(high), 0xc);
}

BAUM_I_INLINE baum_i_four baum_i_four_all(double x)
{
  return _mm256_set1_pd(x);
}

BAUM_I_INLINE baum_i_pair baum_i_four_low(baum_i_four x)
{
  return _mm256_castpd256_pd128(x);
}

BAUM_I_INLINE baum_i_pair baum_i_four_high(baum_i_four x)
{
  return _mm256_extractf128_pd(x, 1);
}

BAUM_I_INLINE baum_i_four baum_i_four_plus(baum_i_four x, baum_i_four y)
{
  return x + y;
}

BAUM_I_INLINE baum_i_four baum_i_four_minus(baum_i_four x, baum_i_four y)
{
  return x - y;
}

BAUM_I_INLINE baum_i_four baum_i_four_times(baum_i_four x, baum_i_four y)
{
  return x * y;
}

BAUM_I_INLINE baum_i_four baum_i_four_over(baum_i_four x, baum_i_four y)
{
  return x / y;
}

/* Return `product` rounded to double. The compiler then cannot fuse the multiplication with an
 * addition that follows. */
BAUM_I_INLINE baum_i_four baum_i_four_rounded(baum_i_four product)
{
  __asm__("" : "+x"(product));
  return product;
}

/* Return (x_0 - y_0, x_1 + y_1) for each half. If y = baum_i_four_exchanged(z), each half of z is
 * thus rotated by +90 degrees and added to x. */
BAUM_I_INLINE baum_i_four baum_i_four_minus_plus(baum_i_four x, baum_i_four y)
{
  return _mm256_addsub_pd(x, y);
}

/* Return each half with its two numbers exchanged: (x_1, x_0). */
BAUM_I_INLINE baum_i_four baum_i_four_exchanged(baum_i_four x)
{
  return _mm256_permute_pd(x, 0x5);
}

/* |x| */
BAUM_I_INLINE baum_i_four baum_i_four_magnitude(baum_i_four x)
{
  return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x);
}

/* Return the larger number of x and y at each index. Where either number is NaN, return the number
 * of y. */
BAUM_I_INLINE baum_i_four baum_i_four_larger(baum_i_four x, baum_i_four y)
{
  return _mm256_max_pd(x, y);
}

#else

typedef struct baum_i_four {
  baum_i_pair low;
  baum_i_pair high;
} baum_i_four;

BAUM_I_INLINE baum_i_four baum_i_four_gathered(const double *low, const double *high)
{
  return (baum_i_four){baum_i_load(low), baum_i_load(high)};
}

BAUM_I_INLINE baum_i_four baum_i_four_in_turns(double x, double y)
{
  return (baum_i_four){{x, y}, {x, y}};
}

BAUM_I_INLINE baum_i_four baum_i_four_spread(const double *low, const double *high)
{
  return (baum_i_four){baum_i_both(*low), baum_i_both(*high)};
}

BAUM_I_INLINE baum_i_four baum_i_four_all(double x)
{
  return (baum_i_four){baum_i_both(x), baum_i_both(x)};
}

BAUM_I_INLINE baum_i_pair baum_i_four_low(baum_i_four x)
{
  return x.low;
}

BAUM_I_INLINE baum_i_pair baum_i_four_high(baum_i_four x)
{
  return x.high;
}

BAUM_I_INLINE baum_i_four baum_i_four_plus(baum_i_four x, baum_i_four y)
{
  return (baum_i_four){x.low + y.low, x.high + y.high};
}

BAUM_I_INLINE baum_i_four baum_i_four_minus(baum_i_four x, baum_i_four y)
{
  return (baum_i_four){x.low - y.low, x.high - y.high};
}

BAUM_I_INLINE baum_i_four baum_i_four_times(baum_i_four x, baum_i_four y)
{
  return (baum_i_four){x.low * y.low, x.high * y.high};
}

BAUM_I_INLINE baum_i_four baum_i_four_over(baum_i_four x, baum_i_four y)
{
  return (baum_i_four){x.low / y.low, x.high / y.high};
}

BAUM_I_INLINE baum_i_four baum_i_four_rounded(baum_i_four product)
{
  return product;
}

BAUM_I_INLINE baum_i_four baum_i_four_minus_plus(baum_i_four x, baum_i_four y)
{
  const baum_i_pair signs = {-1.0, 1.0};
  return (baum_i_four){x.low + signs * y.low, x.high + signs * y.high};
}

BAUM_I_INLINE baum_i_four baum_i_four_exchanged(baum_i_four x)
{
  return (baum_i_four){baum_i_exchanged(x.low), baum_i_exchanged(x.high)};
}

BAUM_I_INLINE baum_i_four baum_i_four_magnitude(baum_i_four x)
{
  return (baum_i_four){baum_i_magnitude(x.low), baum_i_magnitude(x.high)};
}

BAUM_I_INLINE baum_i_four baum_i_four_larger(baum_i_four x, baum_i_four y)
{
  return (baum_i_four){baum_i_larger(x.low, y.low), baum_i_larger(x.high, y.high)};
}

#endif

/* Load four numbers. */
BAUM_I_INLINE baum_i_four baum_i_four_load(const double *from)
{
#ifdef BAUM_I_WIDE
  return *(const baum_i_four_in_array *)from;
#else
  return baum_i_four_gathered(from, from + 2);
#endif
}

BAUM_I_INLINE void baum_i_four_store(double *to, baum_i_four x)
{
#ifdef BAUM_I_WIDE
  *(baum_i_four_in_array *)to = x;
#else
  baum_i_store(to, x.low);
  baum_i_store(to + 2, x.high);
#endif
}

/* Store x, and return `to`. The compiler then loads single numbers of x from memory, although it
 * has just stored them. This is faster than copying a number of a register into all its parts. */
BAUM_I_INLINE const double *baum_i_four_spilled(double *to, baum_i_four x)
{
  baum_i_four_store(to, x);
  __asm__("" : "+r"(to) : "m"(*(baum_i_pair_in_array *)to), "m"(*(baum_i_pair_in_array *)(to + 2)));
  return to;
}

/* Return sum + x s. */
BAUM_I_INLINE baum_i_four baum_i_four_add(baum_i_four sum, baum_i_four x, double s)
{
  return baum_i_four_plus(sum, baum_i_four_times(x, baum_i_four_all(s)));
}

#endif
