/* SPDX-License-Identifier: BSD-3-Clause */
/* Two points, one on each body, coincide. With p = A s, k x p = (-p_y, p_x) and k x (k x p) = -p:
 *
 *   Phi   = r_a + p_a - r_b - p_b                               (2 rows)
 *   J     = [ I   k x p_a   -I   -k x p_b ]                     (2 x 6)
 *   gamma = p_a w_a^2 - p_b w_b^2                               (2 rows)
 *
 * lambda is the force on body_b. The second derivatives, with any vector w of six numbers, are
 *
 *   (J w)_q        columns angle_a: -p_a w_3, angle_b: p_b w_6
 *   (J^T lambda)_q angle_a, angle_a: -p_a . lambda; angle_b, angle_b: p_b . lambda
 *   gamma_q        columns angle_a: (k x p_a) w_a^2, angle_b: -(k x p_b) w_b^2
 *   gamma_v        columns w_a: 2 p_a w_a, w_b: -2 p_b w_b
 */
#include "mechanism/planar/pin_rows.h"

void baum_i_pin_phi(const baum_i_planar_pair *pair, double *phi)
{
  phi[0] = pair->a.r[0] - pair->b.r[0];
  phi[1] = pair->a.r[1] - pair->b.r[1];
}

void baum_i_pin_jacobian(const baum_i_planar_pair *pair, double *six)
{
  const double *a = pair->a.arm;
  const double *b = pair->b.arm;
  baum_i_planar_set_row(six, 1.0, 0.0, -a[1], -1.0, 0.0, b[1]);
  baum_i_planar_set_row(six + 6, 0.0, 1.0, a[0], 0.0, -1.0, -b[0]);
}

void baum_i_pin_gamma(const baum_i_planar_pair *pair, double *gamma)
{
  double a = pair->a.w * pair->a.w;
  double b = pair->b.w * pair->b.w;
  gamma[0] = pair->a.arm[0] * a - pair->b.arm[0] * b;
  gamma[1] = pair->a.arm[1] * a - pair->b.arm[1] * b;
}

/* Set the column angle_a of two rows to the vector a p_a, and their column angle_b to b p_b. */
static void set_angle_columns(const double p_a[2], double a, const double p_b[2], double b,
                              double *six)
{
  six[2] = p_a[0] * a;
  six[5] = p_b[0] * b;
  six[8] = p_a[1] * a;
  six[11] = p_b[1] * b;
}

void baum_i_pin_linearize(const baum_i_planar_pair *pair, const double *w, const double *lambda,
                          baum_i_planar_blocks *out)
{
  const double *p_a = pair->a.arm;
  const double *p_b = pair->b.arm;
  const double turned_a[2] = {-p_a[1], p_a[0]};
  const double turned_b[2] = {-p_b[1], p_b[0]};
  double w_a = pair->a.w;
  double w_b = pair->b.w;
  set_angle_columns(p_a, -w[2], p_b, w[5], out->jw_q);
  set_angle_columns(turned_a, w_a * w_a, turned_b, -w_b * w_b, out->gamma_q);
  set_angle_columns(p_a, 2.0 * w_a, p_b, -2.0 * w_b, out->gamma_v);
  out->jtl_q[2 * 6 + 2] = -(p_a[0] * lambda[0] + p_a[1] * lambda[1]);
  out->jtl_q[5 * 6 + 5] = p_b[0] * lambda[0] + p_b[1] * lambda[1];
}
