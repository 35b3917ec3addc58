/* SPDX-License-Identifier: BSD-3-Clause */
/* A function G(c_0, c_1) of two coordinates. It has three uses: for a point on a curve, G = 0 is
 * the equation of the curve; for a coupling, G = 0 relates the coordinates of two joints; for a
 * spatial joint, G is the angle as a function of its cosine and sine.
 *
 * A row has up to four bodies, in the order of its span, and `width` columns for each of them.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_COMPOSED_ROW_H
#define BAUM_I_MECHANISM_GENERAL_COMPOSED_ROW_H

#include "mechanism/identify.h"

enum {
  BAUM_I_COMPOSED_BODIES = 4,
  BAUM_I_COMPOSED_COLUMNS = BAUM_I_SPACE * BAUM_I_COMPOSED_BODIES
};

/* One of the two coordinates. */
typedef struct baum_i_inner {
  baum_i_coordinate c;
  baum_i_coordinate_blocks blocks; /* with lambda = 1; only for linearize */
  int columns;                     /* number of columns of its two bodies */
  int at[BAUM_I_PAIR_COLUMNS];     /* index of each of them among the columns of the row */
} baum_i_inner;

/* G and its derivatives at (c_0, c_1). */
typedef struct baum_i_outer {
  double value;
  double first[2];  /* G_0, G_1 */
  double second[3]; /* G_00, G_01, G_11 */
  double third[4];  /* G_000, G_001, G_011, G_111; only for gamma_q */
} baum_i_outer;

/* Set inner->columns and inner->at. Each body has `width` columns in the coordinate and `row_width`
 * in the row. The row contains the two bodies as its bodies number place[0] and place[1]. */
void baum_i_composed_place(baum_i_inner *inner, int width, int row_width, const int place[2]);

/* Extract the columns of a coordinate from the columns of the row. */
void baum_i_composed_narrow(const baum_i_inner *inner, const double *wide, double *own);

/* Add J to `gradient`, which has the columns of the row. */
void baum_i_composed_add_gradient(const baum_i_inner x[2], const baum_i_outer *g, double *gradient);
double baum_i_composed_gamma(const baum_i_inner x[2], const baum_i_outer *g);

/* Second derivatives with respect to the columns of the row. Functions add to them. */
typedef struct baum_i_composed_blocks {
  int columns;
  double *jw_q;
  double *jtl_q; /* columns x columns */
  double *gamma_q;
  double *gamma_v;
  double *rate_q;
} baum_i_composed_blocks;

/* w has the columns of the row. */
void baum_i_composed_linearize(const baum_i_inner x[2], const baum_i_outer *g, const double *w,
                               double lambda, const baum_i_composed_blocks *out);

/* Write the parts of a row for which `out` has arrays to the places of the joint in these
 * arrays. */
void baum_i_composed_put_row(const baum_i_joint *joint, const baum_i_point *point, int width,
                             const baum_i_inner x[2], const baum_i_outer *g,
                             const baum_i_rows *out);
/* w (columns of the row); lambda (nc) or NULL. */
void baum_i_composed_put_blocks(const baum_i_joint *joint, const baum_i_point *point, int width,
                                const baum_i_inner x[2], const baum_i_outer *g, const double *w,
                                const double *lambda, const baum_i_joint_blocks *blocks);

#endif
