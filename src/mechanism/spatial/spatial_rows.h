/* SPDX-License-Identifier: BSD-3-Clause */
/* Every row of a spatial joint is a product of two vectors,
 *
 *   Phi = x . y - offset,
 *
 * where x is an axis of the joint on body_a or body_b or of ground, and y is one, too, or e, from
 * body_a's point to body_b's. So are the coordinates of joints, the squared length of a rod, and
 * all of their derivatives: a vector u = c + t (r_b - r_a) + u_a + u_b, of which u_a and u_b turn
 * with the bodies, changes along motions (r_a', W_a, r_b', W_b) at
 *
 *   u' = t (r_b' - r_a') + W_a x u_a + W_b x u_b,
 *
 * which is again such a vector, with c = t (r_b' - r_a'), and W_a x u_a and W_b x u_b turning with
 * the bodies: velocities are held in ground axes, angular velocities in body axes. Hence
 *
 *   (x . y)_q      on r_b: t_x y + t_y x, on r_a the opposite, on W_k: u_xk x y + u_yk x x
 *   gamma          = -(x'' . y + 2 x' . y' + x . y'')
 *   (J w)_q        = (x_w . y + x . y_w)_q,     x_w the derivative along w
 *   (J^T l)_q      row i: l (J e_i)_q;          gamma_v = -(J v)_q - ((J e_i)_q v)_i
 *   gamma_q        = -(x'' . y + 2 x' . y' + x . y'')_q
 *
 * W is no derivative of coordinates, therefore (J^T l)_q is not symmetric.
 */
#ifndef BAUM_I_MECHANISM_SPATIAL_SPATIAL_ROWS_H
#define BAUM_I_MECHANISM_SPATIAL_SPATIAL_ROWS_H

#include "mechanism/spatial/spatial.h"

enum { BAUM_I_SPATIAL_ROWS = 6 }; /* most that a joint has */

/* Parameters of a joint. Axes are x, y, z of the joint in axes of the body. */
enum {
  BAUM_I_SPATIAL_POINTS = 0,
  BAUM_I_SPATIAL_AXES_A = 6,
  BAUM_I_SPATIAL_AXES_B = 15,
  BAUM_I_SPATIAL_NUMBERS = 24
};

/* One joint at a point; all in ground axes. */
typedef struct baum_i_spatial_pair {
  const baum_i_spatial_frame *frame[2];
  double arm[2][3];
  double axes[2][9]; /* x, y, z one after the other */
} baum_i_spatial_pair;

/* With the axes of the numbers of a joint, or without axes (numbers: the points). */
baum_i_spatial_pair baum_i_spatial_pair_at(const baum_i_span *span, const double *numbers,
                                           bool has_axes, const baum_i_point *point);

/* Whose product a row is. */
typedef enum baum_i_spatial_vector {
  BAUM_I_X_A,
  BAUM_I_Y_A,
  BAUM_I_Z_A,
  BAUM_I_X_B,
  BAUM_I_Y_B,
  BAUM_I_Z_B,
  BAUM_I_X_GROUND,
  BAUM_I_Y_GROUND,
  BAUM_I_Z_GROUND,
  BAUM_I_APART, /* e */
} baum_i_spatial_vector;

typedef struct baum_i_spatial_row {
  baum_i_spatial_vector x, y;
} baum_i_spatial_row;

double baum_i_spatial_product(const baum_i_spatial_pair *pair, baum_i_spatial_row row);
/* Also what it changes at, and gamma. */
void baum_i_spatial_row_at(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                           baum_i_coordinate *out);

/* Second derivatives over the twelve columns. */
typedef struct baum_i_spatial_second {
  double rate_q[BAUM_I_PAIR_COLUMNS]; /* (J v)_q */
  double gamma_q[BAUM_I_PAIR_COLUMNS];
  double gamma_v[BAUM_I_PAIR_COLUMNS];
  /* (J e_i)_q by rows i: (J w)_q = w^T columns_q, (J^T l)_q = l columns_q. */
  double columns_q[BAUM_I_PAIR_COLUMNS * BAUM_I_PAIR_COLUMNS];
} baum_i_spatial_second;

void baum_i_spatial_second_of(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                              baum_i_spatial_second *out);

/* out += factor (J w)_q; w and out over the twelve columns. */
void baum_i_spatial_add_jw_q(const baum_i_spatial_second *second, const double *w, double factor,
                             double *out);

/* The `linearize` of a joint whose rows are factor times these. */
void baum_i_spatial_linearize_rows(const baum_i_joint *joint, const baum_i_point *point,
                                   const baum_i_spatial_pair *pair, const baum_i_spatial_row *rows,
                                   double factor, const double *w, const double *lambda,
                                   const baum_i_joint_blocks *blocks);

/* Add -lambda times the columns of body_b. */
void baum_i_spatial_add_force_on_b(const baum_i_coordinate *row, double lambda,
                                   double six[BAUM_I_SPACE]);

/* body_b's point in ground axes. */
void baum_i_spatial_place_of(const baum_i_spatial_pair *pair, double at[3]);

/* |e| in the design configuration between points (s_a, s_b) of both bodies of a span. */
double baum_i_spatial_design_length(const baum_mechanism *mechanism, const baum_i_span *span,
                                    const double points[6]);

#endif
