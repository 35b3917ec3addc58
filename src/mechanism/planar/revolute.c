/* SPDX-License-Identifier: BSD-3-Clause */
/* Revolute joint (pin), planar: two points, one on each body, coincide.
 * Its rows are those of pin_rows.c.
 *
 *   coordinate = angle_b - angle_a, gradient [ 0 0 -1 0 0 1 ]
 */
#include "mechanism/definition.h"
#include "mechanism/planar/pin_rows.h"

static const baum_planar_revolute_def defaults = {
  .struct_size = sizeof(baum_planar_revolute_def),
  .point = {BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN},
  .point_a = {BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN},
  .point_b = {BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN},
};

static baum_status check(const baum_mechanism *mechanism, const void *def, const char *label)
{
  return baum_i_planar_check(mechanism, def, label, true);
}

static baum_status evaluate(const baum_i_joint_group *group, baum_i_point *point,
                            const baum_i_rows *out)
{
  static const baum_i_planar_kernels kernels = {2, baum_i_pin_phi, baum_i_pin_jacobian,
                                                baum_i_pin_gamma};
  return baum_i_planar_evaluate(group, point, &kernels, out);
}

static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  return baum_i_planar_linearize(joint, point, w, lambda, baum_i_pin_linearize, blocks);
}

static void coordinate(const baum_i_joint *joint, const baum_i_point *point, baum_i_coordinate *out)
{
  const baum_i_frame *a = &point->frames[joint->span.bodies[0]];
  const baum_i_frame *b = &point->frames[joint->span.bodies[1]];
  *out = (baum_i_coordinate){
    .value = b->angle - a->angle,
    .rate = b->w - a->w,
    .gradient = {0.0, 0.0, -1.0, 0.0, 0.0, 1.0},
  };
}

/* The coordinate is linear. */
static void coordinate_linearize(const baum_i_joint *joint, const baum_i_point *point,
                                 const double w[6], double lambda, baum_i_coordinate_blocks *out)
{
  (void)joint;
  (void)point;
  (void)w;
  (void)lambda;
  *out = (baum_i_coordinate_blocks){.jw_q = {0.0}};
}

static const baum_i_joint_type type = {
  .definition = {.kind = "planar revolute joint",
                 .size = sizeof(baum_planar_revolute_def),
                 .defaults = &defaults,
                 .check = check},
  .parameter_count = BAUM_I_PLANAR_NUMBERS,
  .planar = true,
  .scleronomic = true,
  .is_pin = true,
  .row_count = 2,
  .bodies = baum_i_planar_bodies,
  .extent = baum_i_planar_extent,
  .lower = baum_i_planar_lower_points,
  .evaluate = evaluate,
  .linearize = linearize,
  .place = baum_i_planar_place,
  .is_angle = true,
  .check_coordinate = baum_i_planar_check_angles,
  .coordinate = coordinate,
  .coordinate_linearize = coordinate_linearize,
};

BAUM_I_DEFINE(joint, planar_revolute, type)
