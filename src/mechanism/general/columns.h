/* SPDX-License-Identifier: BSD-3-Clause */
/* Three columns for each body of a span, and what the bodies have of them: a particle has no angle,
 * ground has none. Kernels write over the six of two bodies; what is said here of six holds for any
 * number of bodies.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_COLUMNS_H
#define BAUM_I_MECHANISM_GENERAL_COLUMNS_H

#include <string.h>

#include "base/hot.h"
#include "base/pair.h"
#include "mechanism/identify.h"

/* Velocity-sized columns (or any vector over v) of both bodies as six numbers; zeros where
 * absent, all for NULL. */
void baum_i_columns_gather(const baum_i_point *point, const baum_i_span *span, const double *x,
                           double *six);

/* The same as baum_i_columns_scatter(), whatever the bodies are. */
void baum_i_columns_scatter_any(const baum_mechanism *mechanism, const baum_i_span *span,
                                const double *six, double *x);

BAUM_I_INLINE void baum_i_columns_add_three(const double *three, double *x)
{
  baum_i_store(x, baum_i_load(x) + (baum_i_pair){three[0], three[1]});
  x[2] += three[2];
}

/* Add six numbers to the bodies' places in a vector over v. */
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
    baum_i_columns_scatter_any(mechanism, span, six, x);
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
    baum_i_columns_scatter_any(mechanism, span, three, x);
  }
}

/* The same as baum_i_columns_pack(), whatever the bodies are. */
void baum_i_columns_pack_any(const baum_mechanism *mechanism, const baum_i_span *span, int rows,
                             const double *six, double *packed);

/* Rows of six to rows of nl. Nearly always of two bodies with all their columns, or of one on the
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
    baum_i_columns_pack_any(mechanism, span, rows, six, packed);
  }
}

/* 6 x 6 to nl x nl. */
void baum_i_columns_pack_square(const baum_mechanism *mechanism, const baum_i_span *span,
                                const double *six, double *packed);

/* Second derivatives of a joint's rows over six columns to where they are wanted. nu_q stays zero:
 * no joint with such rows has one. */
void baum_i_columns_pack_blocks(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                const baum_i_joint_blocks *six, const baum_i_joint_blocks *blocks);

#endif
