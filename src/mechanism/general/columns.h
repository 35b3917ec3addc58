/* SPDX-License-Identifier: BSD-3-Clause */
/* Packing of columns. Kernels write the same number of columns for each body: three in the plane,
 * x, y and angle; six in space, the velocity of the origin in ground axes and the angular velocity
 * in body axes. Packing keeps the columns that a body has. A planar particle has no angle, a
 * spatial one no angular velocity, ground has no columns. In space a planar body has x, y and the
 * rotation about z.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_COLUMNS_H
#define BAUM_I_MECHANISM_GENERAL_COLUMNS_H

#include <string.h>

#include "base/hot.h"
#include "base/pair.h"
#include "mechanism/identify.h"

/* Gather `width` numbers of each body from a vector over v. Absent columns, and all for NULL, are
 * zero. */
void baum_i_columns_gather(const baum_i_point *point, const baum_i_span *span, int width,
                           const double *x, double *wide);

/* Add such numbers to a vector over v. */
void baum_i_columns_scatter_any(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                                const double *wide, double *x);

BAUM_I_INLINE void baum_i_columns_add_three(const double *three, double *x)
{
  baum_i_store(x, baum_i_load(x) + (baum_i_pair){three[0], three[1]});
  x[2] += three[2];
}

/* The same of three for each body; nearly always of bodies with all three, or on the ground. */
BAUM_I_INLINE void baum_i_columns_scatter(const baum_mechanism *mechanism, const baum_i_span *span,
                                          const double *six, double *x)
{
  bool pair = span->body_count == 2;
  if (pair && span->nl == 6) {
    baum_i_columns_add_three(six, x + span->columns[0]);
    baum_i_columns_add_three(six + 3, x + span->columns[3]);
  } else if (pair && span->nl == 3) {
    baum_i_columns_add_three(six + (span->bodies[1] == 0 ? 0 : 3), x + span->columns[0]);
  } else {
    baum_i_columns_scatter_any(mechanism, span, BAUM_I_PLANE, six, x);
  }
}

/* Three numbers of a span of one body. */
BAUM_I_INLINE void baum_i_columns_scatter_one(const baum_mechanism *mechanism,
                                              const baum_i_span *span, const double *three,
                                              double *x)
{
  if (span->nl == 3) {
    baum_i_columns_add_three(three, x + span->columns[0]);
  } else {
    baum_i_columns_scatter_any(mechanism, span, BAUM_I_PLANE, three, x);
  }
}

/* Pack rows of `width` numbers for each body to rows of nl. */
void baum_i_columns_pack_any(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                             int rows, const double *wide, double *packed);

/* The same in the plane. The fast cases are two bodies with all their columns, and one body and
 * ground. */
BAUM_I_INLINE void baum_i_columns_pack(const baum_mechanism *mechanism, const baum_i_span *span,
                                       int rows, const double *six, double *packed)
{
  bool pair = span->body_count == 2;
  if (pair && span->nl == 6) {
    memcpy(packed, six, (size_t)(6 * rows) * sizeof *six);
  } else if (pair && span->nl == 3) {
    bool first = span->bodies[1] == 0;
    for (int row = 0; row < rows; row++, six += 6) {
      for (int i = 0; i < 3; i++) {
        *packed++ = first ? six[i] : six[3 + i];
      }
    }
  } else {
    baum_i_columns_pack_any(mechanism, span, BAUM_I_PLANE, rows, six, packed);
  }
}

/* Pack a square matrix over all columns to nl x nl. */
void baum_i_columns_pack_square(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                                const double *wide, double *packed);

/* Pack second derivatives of a joint's rows over all columns to the wanted blocks. nu_q stays zero,
 * because it is zero for all joints with such rows. */
void baum_i_columns_pack_blocks(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                int width, const baum_i_joint_blocks *wide,
                                const baum_i_joint_blocks *blocks);

#endif
