/* SPDX-License-Identifier: BSD-3-Clause */
/* A row G(c_0, c_1) of two coordinates: the two coordinates of a point on a curve, or the
 * coordinates of two coupled joints.
 *
 * The row has three columns for each of up to four bodies, in the order of its span. A coordinate
 * uses six of them.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_COMPOSED_ROW_H
#define BAUM_I_MECHANISM_GENERAL_COMPOSED_ROW_H

#include "mechanism/identify.h"

enum { BAUM_I_COMPOSED_BODIES = 4, BAUM_I_COMPOSED_COLUMNS = 3 * BAUM_I_COMPOSED_BODIES };

/* One of the two coordinates. */
typedef struct baum_i_inner {
  baum_i_coordinate c;
  baum_i_coordinate_blocks blocks; /* with lambda = 1; only for linearize */
  int at[2];                       /* where the three columns of each of its bodies begin */
} baum_i_inner;

/* G and its derivatives at both. */
typedef struct baum_i_outer {
  double value;
  double first[2];  /* G_0, G_1 */
  double second[3]; /* G_00, G_01, G_11 */
  double third[4];  /* G_000, G_001, G_011, G_111; only for gamma_q */
} baum_i_outer;

/* Extract the six columns of a coordinate from the columns of the row. */
void baum_i_composed_narrow(const baum_i_inner *inner, const double *wide, double six[6]);

/* Write the wanted parts of a row at the places of its joint. */
void baum_i_composed_put_row(const baum_i_joint *joint, const baum_i_point *point,
                             const baum_i_inner x[2], const baum_i_outer *g,
                             const baum_i_rows *out);
/* w (columns of the row); lambda (nc) or NULL. */
void baum_i_composed_put_blocks(const baum_i_joint *joint, const baum_i_point *point,
                                const baum_i_inner x[2], const baum_i_outer *g, const double *w,
                                const double *lambda, const baum_i_joint_blocks *blocks);

#endif
