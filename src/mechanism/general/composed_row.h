/* SPDX-License-Identifier: BSD-3-Clause */
/* A function G(c_0, c_1) of two coordinates. Such functions have three uses. For a point on a
 * curve, G = 0 is the equation of the curve. For a coupling, G = 0 relates the coordinates of two
 * joints. For a spatial joint, G is the angle as a function of its cosine and sine.
 *
 * A row has `width` columns for each of its bodies. It has up to four bodies, in the order of the
 * joint's span.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_COMPOSED_ROW_H
#define BAUM_I_MECHANISM_GENERAL_COMPOSED_ROW_H

#include "mechanism/identify.h"

enum {
  BAUM_I_COMPOSED_BODIES = 4,
  BAUM_I_COMPOSED_COLUMNS = BAUM_I_SPACE * BAUM_I_COMPOSED_BODIES
};

/* One of the two coordinates c_0 and c_1. */
typedef struct baum_i_inner {
  baum_i_coordinate c;
  baum_i_coordinate_blocks blocks; /* for lambda = 1; set only if second derivatives are needed */
  int columns;                     /* number of columns of the coordinate's two bodies */
  /* For each of these columns, its index among the columns of the row. */
  int at[BAUM_I_PAIR_COLUMNS];
} baum_i_inner;

/* The value and the derivatives of G at (c_0, c_1). */
typedef struct baum_i_outer {
  double value;
  double first[2];  /* G_0, G_1 */
  double second[3]; /* G_00, G_01, G_11 */
  double third[4];  /* G_000, G_001, G_011, G_111; needed only for gamma_q */
} baum_i_outer;

/* Set inner->columns and inner->at for a coordinate of two bodies. A body has `width` columns in
 * the coordinate and `row_width` columns in the row. The two bodies of the coordinate are bodies
 * number place[0] and place[1] of the row. */
void baum_i_composed_place(baum_i_inner *inner, int width, int row_width, const int place[2]);

/* From the columns of the row, copy those that belong to a coordinate. */
void baum_i_composed_narrow(const baum_i_inner *inner, const double *wide, double *own);

/* Add J of the row to `gradient`, which has the columns of the row. */
void baum_i_composed_add_gradient(const baum_i_inner x[2], const baum_i_outer *g, double *gradient);
double baum_i_composed_gamma(const baum_i_inner x[2], const baum_i_outer *g);

/* Second derivatives with respect to the columns of the row. The functions below add to them. */
typedef struct baum_i_composed_blocks {
  int columns;
  double *jw_q;
  double *jtl_q; /* square matrix over the columns */
  double *gamma_q;
  double *gamma_v;
  double *rate_q;
} baum_i_composed_blocks;

/* Compute second derivatives of the row. w has the columns of the row. */
void baum_i_composed_linearize(const baum_i_inner x[2], const baum_i_outer *g, const double *w,
                               double lambda, const baum_i_composed_blocks *out);

/* Write a row to the arrays of `out` that are not NULL, at the places that belong to the joint. */
void baum_i_composed_put_row(const baum_i_joint *joint, const baum_i_point *point, int width,
                             const baum_i_inner x[2], const baum_i_outer *g,
                             const baum_i_rows *out);
/* Write second derivatives of a row to the blocks of the joint. w has the columns of the row.
 * lambda has nc entries, or is NULL. */
void baum_i_composed_put_blocks(const baum_i_joint *joint, const baum_i_point *point, int width,
                                const baum_i_inner x[2], const baum_i_outer *g, const double *w,
                                const double *lambda, const baum_i_joint_blocks *blocks);

#endif
