/* SPDX-License-Identifier: BSD-3-Clause */
/* Projection of the line between two markers on a direction e of body_a. With u = A_a e, n = k x u,
 * p_b the arm of body_b's marker, r the origins, and D = r_b + p_b - r_a (u . p_a is constant, both
 * being of body_a):
 *
 *   f     = u . (D - p_a)
 *   f_q   = [ -u   n . D   u   u . (k x p_b) ]                                           (6)
 *   H     = f_qq: symmetric, with only
 *           angle_a, r_a: -n;  angle_a, r_b: n;  angle_a, angle_b: n . (k x p_b) = u . p_b;
 *           angle_a, angle_a: -u . D;  angle_b, angle_b: -u . p_b
 *   gamma = -v^T H v = w_a^2 u . D - 2 w_a n . (P_b' - r_a') + w_b^2 u . p_b,  P_b = r_b + p_b
 *
 * (J w)_q = H w, (J^T lambda)_q = lambda H, gamma_v = -2 H v, and gamma_q has
 *
 *   r_a: -w_a^2 u;  r_b: w_a^2 u;  angle_b: (w_a - w_b)^2 u . (k x p_b);
 *   angle_a: w_a^2 n . D + 2 w_a u . (r_b' - r_a') - (2 w_a w_b - w_b^2) n . p_b
 */
#include "mechanism/joints/axis_row.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "mechanism/definition.h"

/* ---- an axis in definitions ---- */

baum_status baum_i_axis_check(const double axis[2], const char *label)
{
  baum_status status = baum_i_check_finite(label, "axis[0]", "[-]", axis[0]);
  if (status == BAUM_OK) {
    status = baum_i_check_finite(label, "axis[1]", "[-]", axis[1]);
  }
  if (status == BAUM_OK && axis[0] == 0.0 && axis[1] == 0.0) {
    status = baum_i_fail(BAUM_ERR_ARGUMENT, "%s: axis is (0, 0), must have a direction", label);
  }
  return status;
}

void baum_i_axis_lower(const double axis[2], const double point[2], const baum_i_frame *a,
                       double along[2], double normal[2])
{
  /* Scaled first, so that the length of a very long or short axis neither overflows nor
   * vanishes. */
  double largest = fmax(fabs(axis[0]), fabs(axis[1]));
  double x = axis[0] / largest;
  double y = axis[1] / largest;
  double length = hypot(x, y);
  x /= length;
  y /= length;
  bool on_ground = !isnan(point[0]);
  along[0] = on_ground ? a->c * x + a->s * y : x;
  along[1] = on_ground ? -a->s * x + a->c * y : y;
  if (normal) {
    normal[0] = -along[1];
    normal[1] = along[0];
  }
}

/* ---- the row ---- */

/* What all of the above is made of. */
typedef struct baum_i_axis {
  double u[2];
  double n[2];
  double span[2]; /* D */
  double u_span;
  double n_span;
  double u_arm; /* u . p_b */
  double n_arm;
} baum_i_axis;

static double dot(const double x[2], const double y[2])
{
  return x[0] * y[0] + x[1] * y[1];
}

static baum_i_axis axis_at(const baum_i_planar_pair *pair, const double direction[2])
{
  const baum_i_frame *f = pair->frame_a;
  baum_i_axis x;
  x.u[0] = f->c * direction[0] - f->s * direction[1];
  x.u[1] = f->s * direction[0] + f->c * direction[1];
  x.n[0] = -x.u[1];
  x.n[1] = x.u[0];
  x.span[0] = pair->b.r[0] - f->x;
  x.span[1] = pair->b.r[1] - f->y;
  x.u_span = dot(x.u, x.span);
  x.n_span = dot(x.n, x.span);
  x.u_arm = dot(x.u, pair->b.arm);
  x.n_arm = dot(x.n, pair->b.arm);
  return x;
}

double baum_i_axis_value(const baum_i_planar_pair *pair, const double direction[2])
{
  baum_i_axis x = axis_at(pair, direction);
  const double between[2] = {pair->b.r[0] - pair->a.r[0], pair->b.r[1] - pair->a.r[1]};
  return dot(x.u, between);
}

void baum_i_axis_gradient(const baum_i_planar_pair *pair, const double direction[2],
                          double gradient[6])
{
  baum_i_axis x = axis_at(pair, direction);
  gradient[0] = -x.u[0];
  gradient[1] = -x.u[1];
  gradient[2] = x.n_span;
  gradient[3] = x.u[0];
  gradient[4] = x.u[1];
  gradient[5] = -x.n_arm; /* u . (k x p) = -n . p */
}

double baum_i_axis_gamma(const baum_i_planar_pair *pair, const double direction[2])
{
  baum_i_axis x = axis_at(pair, direction);
  double w_a = pair->a.w;
  double w_b = pair->b.w;
  const double relative[2] = {pair->b.dr[0] - pair->frame_a->vx, pair->b.dr[1] - pair->frame_a->vy};
  return w_a * w_a * x.u_span - 2.0 * w_a * dot(x.n, relative) + w_b * w_b * x.u_arm;
}

void baum_i_axis_coordinate(const baum_i_planar_pair *pair, const double direction[2],
                            baum_i_coordinate *out)
{
  double v[6];
  baum_i_planar_velocities(pair->frame_a, pair->frame_b, v);
  out->value = baum_i_axis_value(pair, direction);
  out->gamma = baum_i_axis_gamma(pair, direction);
  baum_i_axis_gradient(pair, direction, out->gradient);
  out->rate = 0.0;
  for (int i = 0; i < 6; i++) {
    out->rate += out->gradient[i] * v[i];
  }
}

/* H y */
static void times_hessian(const baum_i_axis *x, const double y[6], double out[6])
{
  const double between[2] = {y[3] - y[0], y[4] - y[1]};
  out[0] = -x->n[0] * y[2];
  out[1] = -x->n[1] * y[2];
  out[2] = dot(x->n, between) - x->u_span * y[2] + x->u_arm * y[5];
  out[3] = -out[0];
  out[4] = -out[1];
  out[5] = x->u_arm * (y[2] - y[5]);
}

static void set_gamma_q(const baum_i_axis *x, const double v[6], double out[6])
{
  const double between[2] = {v[3] - v[0], v[4] - v[1]};
  double w_a = v[2];
  double w_b = v[5];
  double both = w_a - w_b;
  out[0] = -w_a * w_a * x->u[0];
  out[1] = -w_a * w_a * x->u[1];
  out[2] =
    w_a * w_a * x->n_span + 2.0 * w_a * dot(x->u, between) - (2.0 * w_a - w_b) * w_b * x->n_arm;
  out[3] = -out[0];
  out[4] = -out[1];
  out[5] = -both * both * x->n_arm;
}

void baum_i_axis_linearize(const baum_i_planar_pair *pair, const double direction[2],
                           const double w[6], double lambda, baum_i_coordinate_blocks *out)
{
  baum_i_axis x = axis_at(pair, direction);
  double v[6];
  baum_i_planar_velocities(pair->frame_a, pair->frame_b, v);
  times_hessian(&x, w, out->jw_q);
  for (int i = 0; i < 6; i++) {
    double unit[6] = {0.0};
    unit[i] = lambda;
    times_hessian(&x, unit, out->jtl_q + (size_t)6 * i);
  }
  times_hessian(&x, v, out->gamma_v);
  for (int i = 0; i < 6; i++) {
    out->gamma_v[i] *= -2.0;
  }
  set_gamma_q(&x, v, out->gamma_q);
}

void baum_i_axis_row_linearize(const baum_i_planar_pair *pair, const double direction[2],
                               const double w[6], double lambda, baum_i_planar_blocks *out)
{
  baum_i_coordinate_blocks row;
  baum_i_axis_linearize(pair, direction, w, lambda, &row);
  memcpy(out->jw_q, row.jw_q, sizeof row.jw_q);
  memcpy(out->jtl_q, row.jtl_q, sizeof row.jtl_q);
  memcpy(out->gamma_q, row.gamma_q, sizeof row.gamma_q);
  memcpy(out->gamma_v, row.gamma_v, sizeof row.gamma_v);
}
