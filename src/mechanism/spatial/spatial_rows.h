/* SPDX-License-Identifier: BSD-3-Clause */
/* Every row of a spatial joint is a product of two vectors,
 *
 *   Phi = x . y,
 *
 * where x is a joint axis on body_a or body_b or a ground axis; y is such an axis, too, or the
 * vector e from body_a's point to body_b's. Coordinates of joints and the squared length of a rod
 * are such products as well, and all derivatives are sums of them. Each vector has the form u = c +
 * t (r_b - r_a) + u_a + u_b with c fixed to ground, a number t (1 for e, otherwise 0), and u_a and
 * u_b fixed in the bodies. Its derivative along a motion with velocities r_a', r_b' and angular
 * velocities W_a, W_b is
 *
 *   u' = t (r_b' - r_a') + W_a x u_a + W_b x u_b.
 *
 * This has the same form, with c = t (r_b' - r_a'), t = 0 and W_k x u_k instead of u_k, because in
 * further derivatives r' is constant in ground axes, and W in body axes. Hence, with l = lambda,
 *
 *   (x . y)_q      r_b: t_x y + t_y x; r_a: -(t_x y + t_y x); W_k: cross(u_xk, y) + cross(u_yk, x)
 *   gamma          = -(x'' . y + 2 x' . y' + x . y'')
 *   (J w)_q        = (x_w . y + x . y_w)_q,     x_w the derivative along w
 *   (J^T l)_q      row i: l (J e_i)_q;          gamma_v = -(J v)_q - ((J e_i)_q v)_i
 *   gamma_q        = -(x'' . y + 2 x' . y' + x . y'')_q
 *
 * W is not the derivative of coordinates; therefore (J^T l)_q is not symmetric.
 */
#ifndef BAUM_I_MECHANISM_SPATIAL_SPATIAL_ROWS_H
#define BAUM_I_MECHANISM_SPATIAL_SPATIAL_ROWS_H

#include "mechanism/spatial/spatial.h"

enum { BAUM_I_SPATIAL_ROWS = 6 }; /* the most a joint has */

/* Parameters of a joint. The joint axes x, y, z are in body axes. */
enum {
  BAUM_I_SPATIAL_POINTS = 0,
  BAUM_I_SPATIAL_AXES_A = 6,
  BAUM_I_SPATIAL_AXES_B = 15,
  BAUM_I_SPATIAL_NUMBERS = 24
};

/* One joint in a state of the mechanism; all vectors are in ground axes. */
typedef struct baum_i_spatial_pair {
  const baum_i_spatial_frame *frame[2];
  double arm[2][3];
  double axes[2][9]; /* x, y, z */
} baum_i_spatial_pair;

/* `numbers` holds the parameters of a joint, or only the points if has_axes is false. */
baum_i_spatial_pair baum_i_spatial_pair_at(const baum_i_span *span, const double *numbers,
                                           bool has_axes, const baum_i_point *point);

/* The vectors whose product is a row. */
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
/* Evaluates the product, its gradient and rate, and gamma. */
void baum_i_spatial_row_at(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                           baum_i_coordinate *out);

/* Second derivatives over the twelve columns of both bodies. */
typedef struct baum_i_spatial_second {
  double rate_q[BAUM_I_PAIR_COLUMNS]; /* (J v)_q */
  double gamma_q[BAUM_I_PAIR_COLUMNS];
  double gamma_v[BAUM_I_PAIR_COLUMNS];
  /* Row i is (J e_i)_q with the unit vector e_i. Hence (J w)_q = w^T columns_q and (J^T l)_q = l
   * columns_q. */
  double columns_q[BAUM_I_PAIR_COLUMNS * BAUM_I_PAIR_COLUMNS];
} baum_i_spatial_second;

void baum_i_spatial_second_of(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                              baum_i_spatial_second *out);

/* out += factor (J w)_q; w and out over the twelve columns. */
void baum_i_spatial_add_jw_q(const baum_i_spatial_second *second, const double *w, double factor,
                             double *out);

/* Writes the derivatives of the row as a coordinate needs them; w has twelve entries. */
void baum_i_spatial_row_linearize(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                                  const double *w, double lambda, baum_i_coordinate_blocks *out);

/* The `linearize` of a joint whose rows are `factor` times `rows`. */
void baum_i_spatial_linearize_rows(const baum_i_joint *joint, const baum_i_point *point,
                                   const baum_i_spatial_pair *pair, const baum_i_spatial_row *rows,
                                   double factor, const double *w, const double *lambda,
                                   const baum_i_joint_blocks *blocks);

/* six += -lambda times the gradient's columns of body_b. */
void baum_i_spatial_add_force_on_b(const baum_i_coordinate *row, double lambda,
                                   double six[BAUM_I_SPACE]);

/* body_b's point in ground axes. */
void baum_i_spatial_place_of(const baum_i_spatial_pair *pair, double at[3]);

/* |e| in the design configuration; points = (s_a, s_b) in body axes. */
double baum_i_spatial_design_length(const baum_mechanism *mechanism, const baum_i_span *span,
                                    const double points[6]);

#endif
