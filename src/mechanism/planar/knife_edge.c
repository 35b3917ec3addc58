/* SPDX-License-Identifier: BSD-3-Clause */
/* Knife edge, planar: body_a has a blade. Relative to body_b, a point of the blade has no velocity
 * across the blade. The point has the arm p. The row is of velocity level. With the unit vector t
 * along the blade, the unit vector k along z, n = k x t, R = r_a - r_b and D = R + p, the velocity
 * of the point relative to body_b across the blade is
 *
 *   J v = n . (r_a' + w_a k x p - r_b' - w_b k x D),   nu = 0
 *   J   = [ n   c   -n   -(t . R + c) ],   c = t . p                       (6 columns)
 *
 * c is constant, because both vectors are fixed in body_a. Let d = r_a' - r_b'. In the formula of
 * (J w)_q, w_ra, w_rb and w_b are the entries of the vector w for r_a, r_b and angle_b. In the
 * other formulas, w_a and w_b are the angular velocities of the bodies:
 *
 *   gamma   = -J' v = (w_a + w_b) t . d + w_a w_b n . R
 *   (J w)_q = [ -t w_b   -t . (w_ra - w_rb) - n . R w_b   t w_b   0 ]
 *   gamma_q = w_a w_b [ n   -t . R   -n   0 ] + (w_a + w_b) [ 0   n . d   0   0 ]
 *   gamma_v = (w_a + w_b) [ t   0   -t   0 ] + t . d [ 0 1 0 1 ] + n . R [ 0   w_b   0   w_a ]
 *
 * (J^T lambda)_q: -lambda t in the rows of r_a and lambda t in those of r_b, both in the column
 * angle_a, and -lambda [ t   n . R   -t   0 ] in the row of angle_b.
 */
#include <math.h>

#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/planar/axis_row.h"

/* The parameters of the joint that follow the two points: the vector t in the axes of body_a. Of
 * the two points, only the first one is used. */
enum { OWN_COUNT = 2 };

/* ---- definition ---- */

static bool is_given(const double point[2])
{
  return !isnan(point[0]);
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_planar_knife_edge_def *def = given;
  BAUM_I_TRY(baum_i_planar_check_bodies(mechanism, def, label));
  BAUM_I_TRY(baum_i_planar_check_angles(mechanism, def, label));
  if (is_given(def->point) != is_given(def->point_a)) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s; give either point or point_a", label,
                     is_given(def->point) ? "point and point_a are both given"
                                          : "no point is given");
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  const baum_planar_knife_edge_def *def = joint->element.def;
  const baum_i_frame a = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  const bool in_ground = is_given(def->point);
  const double x = in_ground ? def->point[0] - a.x : def->point_a[0];
  const double y = in_ground ? def->point[1] - a.y : def->point_a[1];
  const double c = in_ground ? a.c : 1.0;
  const double s = in_ground ? a.s : 0.0;
  double *along = parameters + BAUM_I_PLANAR_NUMBERS;
  parameters[0] = c * x + s * y;
  parameters[1] = c * y - s * x;
  baum_i_axis_turn(def->axis, c, s, along);
  return BAUM_OK;
}

static void extent(const baum_mechanism *mechanism, const baum_i_joint *joint, baum_i_box *box)
{
  const baum_planar_knife_edge_def *def = joint->element.def;
  const baum_i_frame ground = baum_i_design_frame(mechanism, 0);
  const baum_i_frame a = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  bool in_ground = is_given(def->point);
  const baum_i_marker at =
    baum_i_marker_on(in_ground ? &ground : &a, in_ground ? def->point : def->point_a);
  baum_i_box_include(box, at.r[0], at.r[1], 0.0);
}

/* ---- one joint ---- */

/* Common terms of the equations above. */
typedef struct blade {
  double t[2], n[2];
  double d[2];
  double c;
  double t_span, n_span; /* t . R, n . R */
  double t_rate, n_rate; /* t . d, n . d */
  double w_a, w_b;
} blade;

static blade blade_of(const baum_i_planar_pair *pair)
{
  const baum_i_frame *a = pair->frame_a;
  const baum_i_frame *b = pair->frame_b;
  const double *along = pair->numbers;
  const double span[2] = {a->x - b->x, a->y - b->y};
  blade x = {.t = {a->c * along[0] - a->s * along[1], a->s * along[0] + a->c * along[1]},
             .d = {a->vx - b->vx, a->vy - b->vy},
             .w_a = a->w,
             .w_b = b->w};
  x.n[0] = -x.t[1];
  x.n[1] = x.t[0];
  x.c = baum_i_axis_dot(along, pair->s_a);
  x.t_span = baum_i_axis_dot(x.t, span);
  x.n_span = baum_i_axis_dot(x.n, span);
  x.t_rate = baum_i_axis_dot(x.t, x.d);
  x.n_rate = baum_i_axis_dot(x.n, x.d);
  return x;
}

static void edge_phi(const baum_i_planar_pair *pair, double *out)
{
  (void)pair;
  out[0] = 0.0;
}

static void edge_jacobian(const baum_i_planar_pair *pair, double *six)
{
  const blade x = blade_of(pair);
  baum_i_planar_set_row(six, x.n[0], x.n[1], x.c, -x.n[0], -x.n[1], -(x.t_span + x.c));
}

static void edge_gamma(const baum_i_planar_pair *pair, double *out)
{
  const blade x = blade_of(pair);
  out[0] = (x.w_a + x.w_b) * x.t_rate + x.w_a * x.w_b * x.n_span;
}

static void edge_second(const baum_i_planar_pair *pair, const double *w, const double *lambda,
                        baum_i_planar_blocks *out)
{
  const blade x = blade_of(pair);
  const double l = lambda[0];
  const double both = x.w_a + x.w_b;
  const double product = x.w_a * x.w_b;
  const double between[2] = {w[0] - w[3], w[1] - w[4]};
  const double turn = -baum_i_axis_dot(x.t, between) - x.n_span * w[5];
  baum_i_planar_set_row(out->jw_q, -x.t[0] * w[5], -x.t[1] * w[5], turn, x.t[0] * w[5],
                        x.t[1] * w[5], 0.0);
  for (int i = 0; i < 2; i++) {
    out->jtl_q[6 * i + 2] = -l * x.t[i];
    out->jtl_q[6 * (3 + i) + 2] = l * x.t[i];
  }
  baum_i_planar_set_row(out->jtl_q + 30, -l * x.t[0], -l * x.t[1], -l * x.n_span, l * x.t[0],
                        l * x.t[1], 0.0);
  baum_i_planar_set_row(out->gamma_q, product * x.n[0], product * x.n[1],
                        both * x.n_rate - product * x.t_span, -product * x.n[0], -product * x.n[1],
                        0.0);
  baum_i_planar_set_row(out->gamma_v, both * x.t[0], both * x.t[1], x.t_rate + x.w_b * x.n_span,
                        -both * x.t[0], -both * x.t[1], x.t_rate + x.w_a * x.n_span);
}

/* Find the blade's point, which is fixed in body_a, in ground axes. */
static void place(const baum_i_joint *joint, const baum_i_point *point, double at[3])
{
  const baum_i_planar_pair pair = baum_i_planar_pair_at(joint, point);
  at[0] = pair.a.r[0];
  at[1] = pair.a.r[1];
  at[2] = 0.0;
}

/* ---- type ---- */

BAUM_I_PLANAR_EVALUATE(edge, 1, edge_phi, edge_jacobian, edge_gamma)
BAUM_I_PLANAR_LINEARIZE(edge, edge_second)

static const baum_i_joint_type type = {
  .definition = {BAUM_I_PLANAR_DEFINITION(
    planar_knife_edge, "planar knife edge", check, OWN_COUNT,
    BAUM_I_FIELD(baum_planar_knife_edge_def, body_a, BODY),
    BAUM_I_FIELD(baum_planar_knife_edge_def, body_b, CARRIER),
    BAUM_I_OPTIONAL(baum_planar_knife_edge_def, point, POINT, "m"),
    BAUM_I_OPTIONAL(baum_planar_knife_edge_def, point_a, POINT, "m"),
    BAUM_I_NUMBERS(baum_planar_knife_edge_def, axis, DIRECTION, "", 1.0, 0.0))},
  .width = BAUM_I_PLANE,
  .scleronomic = true,
  .row_count = 1,
  .velocity_row_count = 1,
  .lower = lower,
  .extent = extent,
  .place = place,
  .evaluate = edge_evaluate,
  .linearize = edge_linearize,
};

BAUM_I_DEFINE(joint, planar_knife_edge, type)
