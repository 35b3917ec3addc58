/* SPDX-License-Identifier: BSD-3-Clause */
/* This file computes the distance of the marker on body_b from the marker on body_a along a
 * direction fixed in body_a. The distance along the normal of an axis is used for the first row of
 * the translational joint, and for the row of the pin in a slot. The distance along the axis is the
 * coordinate of these joints. The rack and pinion and the point on a curve also use such distances.
 *
 * Let e be the direction in the axes of body_a, A_a the rotation matrix of body_a, k the unit
 * vector along z, u = A_a e, and n = k x u. Let p_a and p_b be the arms of the markers (planar.h),
 * r_a and r_b the origins of the bodies, and D = r_b + p_b - r_a. The product u . p_a is constant,
 * because both vectors are fixed in body_a. The distance f is
 *
 *   f     = u . (D - p_a)
 *   f_q   = [ -u   n . D   u   u . (k x p_b) ]                                    (6 columns)
 *   H     = f_qq, symmetric; its non-zero entries are
 *           angle_a, r_a: -n;  angle_a, r_b: n;  angle_a, angle_b: n . (k x p_b) = u . p_b;
 *           angle_a, angle_a: -u . D;  angle_b, angle_b: -u . p_b
 *   gamma = -v^T H v = w_a^2 u . D - 2 w_a n . (P_b' - r_a') + w_b^2 u . p_b,  P_b = r_b + p_b
 *
 * (J w)_q = H w, (J^T lambda)_q = lambda H, gamma_v = -2 H v, and gamma_q has the entries
 *
 *   r_a: -w_a^2 u;  r_b: w_a^2 u;  angle_b: (w_a - w_b)^2 u . (k x p_b);
 *   angle_a: w_a^2 n . D + 2 w_a u . (r_b' - r_a') - (2 w_a w_b - w_b^2) n . p_b
 */
#ifndef BAUM_I_MECHANISM_PLANAR_AXIS_ROW_H
#define BAUM_I_MECHANISM_PLANAR_AXIS_ROW_H

#include "mechanism/planar/planar_rows.h"

/* ---- an axis in definitions ---- */

/* The first fields of all definitions that have an axis. */
typedef struct baum_i_planar_axis_head {
  baum_i_planar_head head;
  double axis[2];
} baum_i_planar_axis_head;

#define BAUM_I_PLANAR_AXIS_FIELDS(DEF) \
  BAUM_I_PLANAR_FIELDS(DEF), BAUM_I_NUMBERS(DEF, axis, DIRECTION, "", 1.0, 0.0)

/* Set `along` to the unit axis of a joint, in the axes of body_a. If the definition gives `point`
 * (its value is not NaN), both `point` and `axis` are in ground axes. */
void baum_i_axis_lower(const baum_mechanism *mechanism, const baum_i_joint *joint, double along[2]);

/* Set `along` to the unit vector of an axis after a rotation by -a, where a is the angle whose
 * cosine is c and whose sine is s. */
void baum_i_axis_turn(const double axis[2], double c, double s, double along[2]);

/* ---- the row; its functions are inline, so that the compiler evaluates common terms once ---- */

/* Common terms of the equations above. */
typedef struct baum_i_axis {
  double u[2];
  double n[2];
  double span[2]; /* D */
  double u_span;
  double n_span;
  double u_arm; /* u . p_b */
  double n_arm;
} baum_i_axis;

static inline double baum_i_axis_dot(const double x[2], const double y[2])
{
  return x[0] * y[0] + x[1] * y[1];
}

static inline baum_i_axis baum_i_axis_at(const baum_i_planar_pair *pair, const double direction[2])
{
  const baum_i_frame *f = pair->frame_a;
  baum_i_axis x;
  x.u[0] = f->c * direction[0] - f->s * direction[1];
  x.u[1] = f->s * direction[0] + f->c * direction[1];
  x.n[0] = -x.u[1];
  x.n[1] = x.u[0];
  x.span[0] = pair->b.r[0] - f->x;
  x.span[1] = pair->b.r[1] - f->y;
  x.u_span = baum_i_axis_dot(x.u, x.span);
  x.n_span = baum_i_axis_dot(x.n, x.span);
  x.u_arm = baum_i_axis_dot(x.u, pair->b.arm);
  x.n_arm = baum_i_axis_dot(x.n, pair->b.arm);
  return x;
}

/* Return the distance f. `direction` is a unit vector in the axes of body_a. */
static inline double baum_i_axis_value(const baum_i_planar_pair *pair, const double direction[2])
{
  baum_i_axis x = baum_i_axis_at(pair, direction);
  const double between[2] = {pair->b.r[0] - pair->a.r[0], pair->b.r[1] - pair->a.r[1]};
  return baum_i_axis_dot(x.u, between);
}

static inline void baum_i_axis_gradient(const baum_i_planar_pair *pair, const double direction[2],
                                        double gradient[6])
{
  baum_i_axis x = baum_i_axis_at(pair, direction);
  gradient[0] = -x.u[0];
  gradient[1] = -x.u[1];
  gradient[2] = x.n_span;
  gradient[3] = x.u[0];
  gradient[4] = x.u[1];
  gradient[5] = -x.n_arm; /* u . (k x p) = -n . p */
}

/* Return gamma. It is defined by f'' = gradient . a - gamma. */
static inline double baum_i_axis_gamma(const baum_i_planar_pair *pair, const double direction[2])
{
  baum_i_axis x = baum_i_axis_at(pair, direction);
  double w_a = pair->a.w;
  double w_b = pair->b.w;
  const double relative[2] = {pair->b.dr[0] - pair->frame_a->vx, pair->b.dr[1] - pair->frame_a->vy};
  return w_a * w_a * x.u_span - 2.0 * w_a * baum_i_axis_dot(x.n, relative) + w_b * w_b * x.u_arm;
}

/* Compute all members of the coordinate f. */
void baum_i_axis_coordinate(const baum_i_planar_pair *pair, const double direction[2],
                            baum_i_coordinate *out);

/* Compute all second derivatives of the coordinate f. */
void baum_i_axis_linearize(const baum_i_planar_pair *pair, const double direction[2],
                           const double w[6], double lambda, baum_i_coordinate_blocks *out);

/* Compute the second derivatives of f, and write them to the places of a joint's first row. */
void baum_i_axis_row_linearize(const baum_i_planar_pair *pair, const double direction[2],
                               const double w[6], double lambda, baum_i_planar_blocks *out);

#endif
