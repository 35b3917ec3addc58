/* SPDX-License-Identifier: BSD-3-Clause */
/* Distance joint, planar: a massless rod keeps two points at distance L. With the vector d from the
 * point on body_a to the point on body_b, the arms p_a and p_b of these points (planar.h), and F
 * and G of separation.h:
 *
 *   Phi   = (d . d - L^2) / (2 L)   (1 row); nearly |d| - L if Phi is small, and smooth at d = 0
 *   J     = G^T d / L                                (6 columns)
 *   gamma = -v^T F_qq v / L = -(d' . d' + w_a^2 d . p_a - w_b^2 d . p_b) / L
 *
 *   (J w)_q = F_qq w / L,   (J^T lambda)_q = lambda F_qq / L,   gamma_v = -2 F_qq v / L
 *   gamma_q = -(G^T (w_a^2 p_a - w_b^2 p_b) + [ 0 0 c_a  0 0 -c_b ]) / L
 *             where c = 2 w d' . p + w^2 d . (k x p) for each body
 */
#include <math.h>

#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/planar/planar_rows.h"
#include "mechanism/planar/separation.h"

/* The parameters that follow the two points of the joint. */
enum { LENGTH = 0, OWN_COUNT = 1 };

/* ---- definition ---- */

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  BAUM_I_TRY(baum_i_planar_lower_points(mechanism, joint, parameters));
  const baum_planar_distance_def *def = joint->element.def;
  double *numbers = parameters + BAUM_I_PLANAR_NUMBERS;
  numbers[LENGTH] = def->length;
  if (isnan(def->length)) {
    numbers[LENGTH] = baum_i_separation_in_design(mechanism, &joint->span, parameters);
  }
  if (!(numbers[LENGTH] > 0.0)) {
    return baum_i_fail(
      BAUM_ERR_ARGUMENT,
      "%s: length is not given and is 0 m in the design configuration, must be > 0",
      baum_i_label(&joint->element).text);
  }
  return BAUM_OK;
}

/* ---- one joint ---- */

static double dot(const double x[2], const double y[2])
{
  return x[0] * y[0] + x[1] * y[1];
}

static void one_phi(const baum_i_planar_pair *pair, double *out)
{
  double length = pair->numbers[LENGTH];
  baum_i_separation s = baum_i_separation_of(&pair->a, &pair->b);
  out[0] = 0.5 * (dot(s.d, s.d) / length - length);
}

static void one_jacobian(const baum_i_planar_pair *pair, double *six)
{
  double length = pair->numbers[LENGTH];
  baum_i_separation s = baum_i_separation_of(&pair->a, &pair->b);
  const double along[2] = {s.d[0] / length, s.d[1] / length};
  baum_i_separation_spread(&s, along, six);
}

static void one_gamma(const baum_i_planar_pair *pair, double *out)
{
  baum_i_separation s = baum_i_separation_of(&pair->a, &pair->b);
  double w_a = pair->a.w;
  double w_b = pair->b.w;
  double bend = w_a * w_a * dot(s.d, pair->a.arm) - w_b * w_b * dot(s.d, pair->b.arm);
  out[0] = -(dot(s.rate, s.rate) + bend) / pair->numbers[LENGTH];
}

static void set_gamma_q(const baum_i_planar_pair *pair, const baum_i_separation *s, double scale,
                        double *out)
{
  const double *p_a = pair->a.arm;
  const double *p_b = pair->b.arm;
  double w_a = pair->a.w;
  double w_b = pair->b.w;
  const double pull[2] = {w_a * w_a * p_a[0] - w_b * w_b * p_b[0],
                          w_a * w_a * p_a[1] - w_b * w_b * p_b[1]};
  baum_i_separation_spread(s, pull, out);
  /* d . (k x p) = d_y p_x - d_x p_y */
  out[2] += 2.0 * w_a * dot(s->rate, p_a) + w_a * w_a * (s->d[1] * p_a[0] - s->d[0] * p_a[1]);
  out[5] -= 2.0 * w_b * dot(s->rate, p_b) + w_b * w_b * (s->d[1] * p_b[0] - s->d[0] * p_b[1]);
  for (int i = 0; i < 6; i++) {
    out[i] *= scale;
  }
}

static void one_second(const baum_i_planar_pair *pair, const double *w, const double *lambda,
                       baum_i_planar_blocks *out)
{
  double v[6];
  baum_i_planar_velocities(pair->frame_a, pair->frame_b, v);
  double scale = 1.0 / pair->numbers[LENGTH];
  baum_i_separation s = baum_i_separation_of(&pair->a, &pair->b);
  double hessian[36];
  baum_i_separation_hessian(&s, hessian);
  for (int i = 0; i < 6; i++) {
    for (int j = 0; j < 6; j++) {
      double h = scale * hessian[6 * i + j];
      out->jw_q[i] += h * w[j];
      out->jtl_q[6 * i + j] = h * lambda[0];
      out->gamma_v[i] -= 2.0 * h * v[j];
    }
  }
  set_gamma_q(pair, &s, -scale, out->gamma_q);
}

/* ---- type ---- */

BAUM_I_PLANAR_EVALUATE(planar_distance, 1, one_phi, one_jacobian, one_gamma)
BAUM_I_PLANAR_LINEARIZE(one, one_second)

static const baum_i_joint_type type = {
  BAUM_I_PLANAR_JOINT(planar_distance, "planar distance joint", baum_i_planar_check_apart,
                      OWN_COUNT, 1, BAUM_I_PLANAR_FIELDS(baum_planar_distance_def),
                      BAUM_I_OPTIONAL(baum_planar_distance_def, length, OPTIONAL_POSITIVE, "m")),
  .lower = lower,
  .linearize = one_linearize,
};

BAUM_I_DEFINE(joint, planar_distance, type)
