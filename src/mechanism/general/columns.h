/* SPDX-License-Identifier: BSD-3-Clause */
/* Conversion between two forms of rows, called wide and packed. Functions of element types compute
 * wide rows, which have the same number of columns for every body. In the plane there are three
 * columns for a body: x, y and angle. In space there are six: the velocity of the origin in ground
 * axes, and the angular velocity in body axes. Packed rows contain only the columns that a body
 * has. A planar particle has no angle, a spatial particle has no angular velocity, and ground has
 * no columns. In space a planar body has x, y and the rotation about z.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_COLUMNS_H
#define BAUM_I_MECHANISM_GENERAL_COLUMNS_H

#include <string.h>

#include "base/hot.h"
#include "base/pair.h"
#include "mechanism/identify.h"

/* Gather `width` numbers of each body from a vector x (nv). Entries for columns that a body does
 * not have are set to zero. If x is NULL, all entries are zero. */
void baum_i_columns_gather(const baum_i_point *point, const baum_i_span *span, int width,
                           const double *x, double *wide);

/* Add `width` numbers of each body to a vector x (nv). Entries for columns that a body does not
 * have are ignored. */
void baum_i_columns_scatter_any(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                                const double *wide, double *x);

BAUM_I_INLINE void baum_i_columns_add_three(const double *three, double *x)
{
  baum_i_store(x, baum_i_load(x) + (baum_i_pair){three[0], three[1]});
  x[2] += three[2];
}

/* Do the same as baum_i_columns_scatter_any(), for three numbers of each of two bodies. The
 * function is fast if each body is ground or has all three columns. */
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

/* Do the same as baum_i_columns_scatter_any(), for three numbers of one body. */
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

/* Convert rows with `width` numbers for each body to rows with nl numbers. */
void baum_i_columns_pack_any(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                             int rows, const double *wide, double *packed);

/* Do the same as baum_i_columns_pack_any(), in the plane, with three numbers for each body. The
 * function is fast if both bodies have all three columns, or if one of them has all three columns
 * and the other is ground. */
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

/* For each of the `width` columns of body number k of a span, find its index among the packed
 * columns of the span. The index is -1 if the body does not have the column. */
void baum_i_columns_find(const baum_mechanism *mechanism, const baum_i_span *span, int k, int width,
                         int *at);

/* Convert a square matrix over all wide columns to a matrix of nl x nl entries. */
void baum_i_columns_pack_square(const baum_mechanism *mechanism, const baum_i_span *span, int width,
                                const double *wide, double *packed);

/* Convert second derivatives of a joint's rows from wide columns to packed blocks. Only blocks that
 * are not NULL are set. nu_q is not set. It is zero for all joints that use this function. */
void baum_i_columns_pack_blocks(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                int width, const baum_i_joint_blocks *wide,
                                const baum_i_joint_blocks *blocks);

/* Convert the derivative of a force from wide columns to packed columns, and write it to the block
 * of this force in `squares`. Does nothing if squares is NULL. */
void baum_i_columns_pack_force(const baum_mechanism *mechanism, const baum_i_force *force,
                               int width, const double *wide, double *squares);

#endif
