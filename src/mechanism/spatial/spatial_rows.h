/* SPDX-License-Identifier: BSD-3-Clause */
/* Most rows of spatial joints are products of two vectors,
 *
 *   Phi = x . y,
 *
 * where x is a joint axis on body_a or body_b, or a ground axis. The vector y is also such an axis,
 * or it is the vector e from body_a's point to body_b's point. The coordinates of joints and the
 * squared length of a rod are such products as well, and all derivatives are sums of such products.
 * Each vector has the form u = c + t (r_b - r_a) + u_a + u_b. The vector c is fixed to ground. The
 * number t is 1 for e, and 0 otherwise. The vectors u_a and u_b are fixed in the bodies. If the
 * bodies have the velocities r_a' and r_b' and the angular velocities W_a and W_b, the derivative
 * of u is
 *
 *   u' = t (r_b' - r_a') + W_a x u_a + W_b x u_b.
 *
 * This derivative has the same form as u, with c = t (r_b' - r_a'), with t = 0, and with W_k x u_k
 * instead of u_k. The reason is that, in further derivatives, r' is constant in ground axes and W
 * is constant in body axes. Hence, with the abbreviation l = lambda,
 *
 *   (x . y)_q      r_b: t_x y + t_y x; r_a: -(t_x y + t_y x); W_k: cross(u_xk, y) + cross(u_yk, x)
 *   gamma          = -(x'' . y + 2 x' . y' + x . y'')
 *   (J w)_q        = (x_w . y + x . y_w)_q,     x_w the derivative along w
 *   (J^T l)_q      row i: l (J e_i)_q;          gamma_v = -(J v)_q - ((J e_i)_q v)_i
 *   gamma_q        = -(x'' . y + 2 x' . y' + x . y'')_q
 *
 * The angular velocity W is not the derivative of coordinates. Therefore (J^T l)_q is not
 * symmetric.
 */
#ifndef BAUM_I_MECHANISM_SPATIAL_SPATIAL_ROWS_H
#define BAUM_I_MECHANISM_SPATIAL_SPATIAL_ROWS_H

#include "mechanism/spatial/spatial.h"

enum { BAUM_I_SPATIAL_ROWS = 6 }; /* the largest number of rows of a spatial joint */

/* Parameters of a joint. The joint axes x, y and z are given in body axes. */
enum {
  BAUM_I_SPATIAL_POINTS = 0,
  BAUM_I_SPATIAL_AXES_A = 6,
  BAUM_I_SPATIAL_AXES_B = 15,
  BAUM_I_SPATIAL_NUMBERS = 24
};

/* A joint, together with the state (point) in which it is evaluated. All vectors are in ground
 * axes. */
typedef struct baum_i_spatial_pair {
  const baum_i_spatial_frame *frame[2];
  double arm[2][3];
  double axes[2][9]; /* the axes x, y and z of the joint on each body */
} baum_i_spatial_pair;

/* Computes the points and axes of a joint. `numbers` contains the parameters of the joint, or only
 * its points if `has_axes` is false. */
baum_i_spatial_pair baum_i_spatial_pair_at(const baum_i_span *span, const double *numbers,
                                           bool has_axes, const baum_i_point *point);

/* An element has one set of axes on body_a and one on body_b. Computes the products of these axes
 * at the positions q of all bodies: r[3 i + k] is the product of axis i on body_a and axis k on
 * body_b. */
void baum_i_spatial_relative_axes(const baum_i_force *force, const baum_i_point *point,
                                  const double *q, double r[9]);

/* The vectors that can be factors of a product. */
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
  BAUM_I_APART, /* the vector e */
} baum_i_spatial_vector;

typedef struct baum_i_spatial_row {
  baum_i_spatial_vector x, y;
} baum_i_spatial_row;

double baum_i_spatial_product(const baum_i_spatial_pair *pair, baum_i_spatial_row row);
/* Returns the product, and writes its gradient (12) unless `gradient` is NULL. */
double baum_i_spatial_gradient_at(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                                  double *gradient);
/* Evaluates a product, its gradient, its rate, and gamma. */
void baum_i_spatial_row_at(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                           baum_i_coordinate *out);

/* The distance l of the two points, its rate l' and its gradient h over the twelve columns of both
 * bodies. If l is too short to have a direction, all three are 0. */
typedef struct baum_i_spatial_length {
  double length;
  double rate;
  double h[BAUM_I_PAIR_COLUMNS];
} baum_i_spatial_length;

baum_i_spatial_length baum_i_spatial_length_of(const baum_i_spatial_pair *pair);

/* Second derivatives of a product over the twelve columns of both bodies. */
typedef struct baum_i_spatial_second {
  double rate_q[BAUM_I_PAIR_COLUMNS]; /* (J v)_q */
  double gamma_q[BAUM_I_PAIR_COLUMNS];
  double gamma_v[BAUM_I_PAIR_COLUMNS];
  /* Row i of this matrix is (J e_i)_q, where e_i is a unit vector. Hence (J w)_q = w^T columns_q
   * and (J^T l)_q = l columns_q. */
  double columns_q[BAUM_I_PAIR_COLUMNS * BAUM_I_PAIR_COLUMNS];
} baum_i_spatial_second;

void baum_i_spatial_second_of(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                              baum_i_spatial_second *out);

/* Add factor (J w)_q to `out`. Both w and `out` have twelve entries. */
void baum_i_spatial_add_jw_q(const baum_i_spatial_second *second, const double *w, double factor,
                             double *out);

/* Writes those derivatives of the product `row` that a coordinate needs. w has twelve entries. */
void baum_i_spatial_row_linearize(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                                  const double *w, double lambda, baum_i_coordinate_blocks *out);

/* Compute second derivatives of the first `count` rows of a joint. Each row is one of the products
 * in `rows`, multiplied by `factor`. w has twelve entries. lambda has `count` entries, or is NULL.
 * The function adds to jw_q and jtl_q of `wide`, and sets gamma_q and gamma_v. */
void baum_i_spatial_linearize_products(const baum_i_spatial_pair *pair,
                                       const baum_i_spatial_row *rows, int count, double factor,
                                       const double *w, const double *lambda,
                                       const baum_i_joint_blocks *wide);

/* Implements linearize() for a joint whose rows are products. Each row is one of the products in
 * `rows`, multiplied by `factor`. */
void baum_i_spatial_linearize_rows(const baum_i_joint *joint, const baum_i_point *point,
                                   const baum_i_spatial_pair *pair, const baum_i_spatial_row *rows,
                                   double factor, const double *w, const double *lambda,
                                   const baum_i_joint_blocks *blocks);

/* From `six`, subtract lambda times those entries of the gradient that belong to body_b. */
void baum_i_spatial_add_force_on_b(const baum_i_coordinate *row, double lambda,
                                   double six[BAUM_I_SPACE]);

/* Write the position of the joint's point on body_b, in ground axes. */
void baum_i_spatial_place_of(const baum_i_spatial_pair *pair, double at[3]);

/* Return the length |e| in the design configuration. `points` contains the point s_a on body_a and
 * then the point s_b on body_b, in body axes. */
double baum_i_spatial_design_length(const baum_mechanism *mechanism, const baum_i_span *span,
                                    const double points[6]);

#endif
