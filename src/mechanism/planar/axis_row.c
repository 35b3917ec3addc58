/* SPDX-License-Identifier: BSD-3-Clause */
/* Axes in definitions, and the second derivatives of the distance along an axis. The equations are
 * in axis_row.h. */
#include "mechanism/planar/axis_row.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "mechanism/definition.h"

/* ---- an axis in definitions ---- */

void baum_i_axis_turn(const double axis[2], double c, double s, double along[2])
{
  /* The axis is first divided by its largest component, so that squares neither overflow nor become
   * zero. */
  double largest = fmax(fabs(axis[0]), fabs(axis[1]));
  double x = axis[0] / largest;
  double y = axis[1] / largest;
  double length = hypot(x, y);
  along[0] = (c * x + s * y) / length;
  along[1] = (c * y - s * x) / length;
}

void baum_i_axis_lower(const baum_mechanism *mechanism, const baum_i_joint *joint, double along[2])
{
  const baum_i_planar_axis_head *def = joint->element.def;
  const baum_i_frame a = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  bool on_ground = !isnan(def->head.point[0]);
  baum_i_axis_turn(def->axis, on_ground ? a.c : 1.0, on_ground ? a.s : 0.0, along);
}

/* ---- the row ---- */

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

/* Set out = H y, with H of axis_row.h. */
static void times_hessian(const baum_i_axis *x, const double y[6], double out[6])
{
  const double between[2] = {y[3] - y[0], y[4] - y[1]};
  out[0] = -x->n[0] * y[2];
  out[1] = -x->n[1] * y[2];
  out[2] = baum_i_axis_dot(x->n, between) - x->u_span * y[2] + x->u_arm * y[5];
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
  out[2] = w_a * w_a * x->n_span + 2.0 * w_a * baum_i_axis_dot(x->u, between) -
           (2.0 * w_a - w_b) * w_b * x->n_arm;
  out[3] = -out[0];
  out[4] = -out[1];
  out[5] = -both * both * x->n_arm;
}

void baum_i_axis_linearize(const baum_i_planar_pair *pair, const double direction[2],
                           const double w[6], double lambda, baum_i_coordinate_blocks *out)
{
  baum_i_axis x = baum_i_axis_at(pair, direction);
  double v[6];
  baum_i_planar_velocities(pair->frame_a, pair->frame_b, v);
  times_hessian(&x, w, out->jw_q);
  for (int i = 0; i < 6; i++) {
    double unit[6] = {0.0};
    unit[i] = lambda;
    times_hessian(&x, unit, out->jtl_q + (size_t)6 * i);
  }
  times_hessian(&x, v, out->rate_q);
  for (int i = 0; i < 6; i++) {
    out->gamma_v[i] = -2.0 * out->rate_q[i];
  }
  set_gamma_q(&x, v, out->gamma_q);
}

void baum_i_axis_row_linearize(const baum_i_planar_pair *pair, const double direction[2],
                               const double w[6], double lambda, baum_i_planar_blocks *out)
{
  baum_i_coordinate_blocks row;
  baum_i_axis_linearize(pair, direction, w, lambda, &row);
  memcpy(out->jw_q, row.jw_q, BAUM_I_PLANAR_COLUMNS * sizeof *row.jw_q);
  memcpy(out->jtl_q, row.jtl_q, BAUM_I_PLANAR_COLUMNS * BAUM_I_PLANAR_COLUMNS * sizeof *row.jtl_q);
  memcpy(out->gamma_q, row.gamma_q, BAUM_I_PLANAR_COLUMNS * sizeof *row.gamma_q);
  memcpy(out->gamma_v, row.gamma_v, BAUM_I_PLANAR_COLUMNS * sizeof *row.gamma_v);
}
