/* SPDX-License-Identifier: BSD-3-Clause */
/* Revolute joint (pin), planar: two points, one on each body, coincide.
 * Its rows are those of pin_rows.c.
 *
 *   coordinate = angle_b - angle_a, gradient [ 0 0 -1 0 0 1 ]
 */
#include "mechanism/definition.h"
#include "mechanism/planar/pin_rows.h"

static const baum_i_def_field fields[] = {
  BAUM_I_PLANAR_FIELDS(baum_planar_revolute_def),
  {0},
};

BAUM_I_PLANAR_EVALUATE(2, baum_i_pin_phi, baum_i_pin_jacobian, baum_i_pin_gamma)

BAUM_I_PLANAR_LINEARIZE(baum_i_pin_linearize)

static void coordinate(const baum_i_joint *joint, int number, const baum_i_point *point,
                       baum_i_coordinate *out)
{
  (void)number;
  const baum_i_frame *a = &point->frames[joint->span.bodies[0]];
  const baum_i_frame *b = &point->frames[joint->span.bodies[1]];
  *out = (baum_i_coordinate){
    .value = b->angle - a->angle,
    .rate = b->w - a->w,
    .gradient = {0.0, 0.0, -1.0, 0.0, 0.0, 1.0},
  };
}

/* The coordinate is linear. */
static void coordinate_linearize(const baum_i_joint *joint, int number, const baum_i_point *point,
                                 const double w[6], double lambda, baum_i_coordinate_blocks *out)
{
  (void)joint;
  (void)number;
  (void)point;
  (void)w;
  (void)lambda;
  *out = (baum_i_coordinate_blocks){.jw_q = {0.0}};
}

static const baum_i_joint_type type = {
  BAUM_I_PLANAR_JOINT(planar_revolute, "planar revolute joint", baum_i_planar_check_with_point, 0,
                      2),
  .is_pin = true,
  .lower = baum_i_planar_lower_points,
  .linearize = linearize,
  .coordinates = {BAUM_COORDINATE_ANGLE},
  .check_coordinate = baum_i_planar_check_angles,
  .coordinate = coordinate,
  .coordinate_linearize = coordinate_linearize,
};

BAUM_I_DEFINE(joint, planar_revolute, type)
