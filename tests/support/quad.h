/* SPDX-License-Identifier: BSD-3-Clause */
/* Numbers in quadruple precision, or in the longest type available. */
#ifndef BAUM_TEST_QUAD_H
#define BAUM_TEST_QUAD_H

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 wide;
#else
typedef long double wide;
#endif

static inline wide wide_size(wide x)
{
  return x < 0 ? -x : x;
}

/* Returns the square root, by Newton's iteration. It starts from the root in double precision,
 * which has at least a quarter of the digits. */
static inline wide wide_root(wide x)
{
  wide root = (wide)__builtin_sqrt((double)x);
  for (int k = 0; k < 3 && root > 0; k++) {
    root = (root + x / root) / 2;
  }
  return root;
}

#endif
