/* SPDX-License-Identifier: BSD-3-Clause */
/* Spatial joints whose rows are products of vectors (spatial_rows.h): a table for each.
 *
 * x_a, y_a, z_a and x_b, y_b, z_b are the axes of the joint on both bodies, z along its axis; e
 * leads from body_a's point to body_b's.
 */
#include <string.h>

#include "base/message.h"
#include "mechanism/spatial/spatial_joint.h"

/* Shorter, two axes that are opposite in the design configuration leave their angle open. */
static const double OPPOSITE = 1e-6;

/* ---- checks ---- */

static baum_status check_points(const baum_mechanism *mechanism, const void *def, const char *label)
{
  return baum_i_spatial_check_head(mechanism, def, label, false);
}

/* body_b may be a particle. */
static baum_status check_axis(const baum_mechanism *mechanism, const void *def, const char *label)
{
  const baum_i_spatial_head *head = def;
  BAUM_I_TRY(check_points(mechanism, def, label));
  return baum_i_spatial_check_turning(mechanism, head->body_a, label, "body_a");
}

static baum_status check_turning(const baum_mechanism *mechanism, const void *def,
                                 const char *label)
{
  const baum_i_spatial_head *head = def;
  BAUM_I_TRY(check_axis(mechanism, def, label));
  return baum_i_spatial_check_turning(mechanism, head->body_b, label, "body_b");
}

static baum_status check_axes(const baum_mechanism *mechanism, const void *def, const char *label)
{
  const baum_i_spatial_axis_head *given = def;
  const double *axis = given->axis_b;
  BAUM_I_TRY(check_turning(mechanism, def, label));
  return axis[0] != 0.0 || axis[1] != 0.0 || axis[2] != 0.0
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: axis_b is (0, 0, 0), must have a direction",
                         label);
}

static baum_status check_two_axes(const baum_mechanism *mechanism, const void *def,
                                  const char *label)
{
  const baum_i_spatial_axis_head *given = def;
  BAUM_I_TRY(check_axes(mechanism, def, label));
  return baum_i_spatial_is_given(given->axis_b)
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: axis_b is not given", label);
}

/* ---- numbers ---- */

static void normalize(double x[3])
{
  double largest = fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2])));
  for (int i = 0; i < 3; i++) {
    x[i] /= largest;
  }
  double length = sqrt(baum_i_dot3(x, x));
  for (int i = 0; i < 3; i++) {
    x[i] /= length;
  }
}

static baum_status lower_points(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                double *parameters)
{
  return baum_i_spatial_points(mechanism, &joint->element, parameters);
}

/* An axis in ground axes where the joint is given by `point`, else in those of its body, becomes
 * one in ground axes. */
static void to_ground(const baum_i_spatial_head *head, const baum_i_spatial_frame *frame,
                      const double axis[3], double out[3])
{
  if (baum_i_spatial_is_given(head->point)) {
    memcpy(out, axis, 3 * sizeof *out);
  } else {
    baum_i_turn(frame->axes, axis, out);
  }
  normalize(out);
}

/* The three axes that belong to z, nearest to x; ground axes to those of the body. False where x is
 * along z. */
static bool put_axes(const baum_i_spatial_frame *frame, const double z[3], const double x[3],
                     double out[9])
{
  double ground[9];
  double along = baum_i_dot3(x, z);
  for (int i = 0; i < 3; i++) {
    ground[i] = x[i] - along * z[i];
  }
  if (baum_i_dot3(ground, ground) < OPPOSITE * OPPOSITE) {
    return false;
  }
  normalize(ground);
  memcpy(ground + 6, z, 3 * sizeof *z);
  baum_i_cross(z, ground, ground + 3);
  for (int i = 0; i < 9; i += 3) {
    baum_i_turn_back(frame->axes, ground + i, out + i);
  }
  return true;
}

/* z along an axis of the definition, x and y anywhere beside it. */
static void put_any_axes(const baum_mechanism *mechanism, const baum_i_joint *joint, int side,
                         const double axis[3], double out[9])
{
  const baum_i_spatial_frame frame =
    baum_i_spatial_design_frame(mechanism, joint->span.bodies[side]);
  double z[3];
  double x[3];
  double y[3];
  to_ground(joint->element.def, &frame, axis, z);
  baum_i_complete_axes(z, x, y);
  (void)put_axes(&frame, z, x, out);
}

static baum_status lower_axis(const baum_mechanism *mechanism, const baum_i_joint *joint,
                              double *parameters)
{
  const baum_i_spatial_axis_head *def = joint->element.def;
  BAUM_I_TRY(lower_points(mechanism, joint, parameters));
  put_any_axes(mechanism, joint, 0, def->axis, parameters + BAUM_I_SPATIAL_AXES_A);
  return BAUM_OK;
}

static baum_status fail_opposite(const baum_i_joint *joint)
{
  char label[BAUM_I_LABEL_SIZE];
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: axis and axis_b point in opposite directions in the design "
                     "configuration; turn one of them round",
                     baum_i_label(&joint->element, label));
}

/* x_b is x_a, turned as z_a turns to z_b by the shortest way: the angle is 0 in the design
 * configuration. */
static baum_status lower_axes(const baum_mechanism *mechanism, const baum_i_joint *joint,
                              double *parameters)
{
  BAUM_I_TRY(lower_axis(mechanism, joint, parameters));
  const baum_i_spatial_axis_head *def = joint->element.def;
  const baum_i_spatial_frame a = baum_i_spatial_design_frame(mechanism, joint->span.bodies[0]);
  const baum_i_spatial_frame b = baum_i_spatial_design_frame(mechanism, joint->span.bodies[1]);
  double axes[9];
  for (int i = 0; i < 9; i += 3) {
    baum_i_turn(a.axes, parameters + BAUM_I_SPATIAL_AXES_A + i, axes + i);
  }
  double z[3];
  memcpy(z, axes + 6, sizeof z);
  if (baum_i_spatial_is_given(def->axis_b)) {
    to_ground(&def->head, &b, def->axis_b, z);
  }
  /* R x = x + n x x + n x (n x x) / (1 + c), n = z_a x z_b, c = z_a . z_b */
  double c = baum_i_dot3(axes + 6, z);
  double n[3];
  double first[3];
  double second[3];
  baum_i_cross(axes + 6, z, n);
  baum_i_cross(n, axes, first);
  baum_i_cross(n, first, second);
  for (int i = 0; i < 3; i++) {
    axes[i] += first[i] + second[i] / (1.0 + c);
  }
  bool fine = c > OPPOSITE - 1.0 && put_axes(&b, z, axes, parameters + BAUM_I_SPATIAL_AXES_B);
  return fine ? BAUM_OK : fail_opposite(joint);
}

static baum_status lower_two_axes(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                  double *parameters)
{
  const baum_i_spatial_axis_head *def = joint->element.def;
  BAUM_I_TRY(lower_axis(mechanism, joint, parameters));
  put_any_axes(mechanism, joint, 1, def->axis_b, parameters + BAUM_I_SPATIAL_AXES_B);
  return BAUM_OK;
}

/* Axes of ground in the design configuration. */
static baum_status lower_fixed(const baum_mechanism *mechanism, const baum_i_joint *joint,
                               double *parameters)
{
  static const double z[3] = {0.0, 0.0, 1.0};
  static const double x[3] = {1.0, 0.0, 0.0};
  BAUM_I_TRY(lower_points(mechanism, joint, parameters));
  const baum_i_spatial_frame a = baum_i_spatial_design_frame(mechanism, joint->span.bodies[0]);
  const baum_i_spatial_frame b = baum_i_spatial_design_frame(mechanism, joint->span.bodies[1]);
  (void)put_axes(&a, z, x, parameters + BAUM_I_SPATIAL_AXES_A);
  (void)put_axes(&b, z, x, parameters + BAUM_I_SPATIAL_AXES_B);
  return BAUM_OK;
}

/* ---- rows ---- */

/* Both points coincide: e = 0. */
#define POINT_ROWS                                                  \
  {BAUM_I_X_GROUND, BAUM_I_APART}, {BAUM_I_Y_GROUND, BAUM_I_APART}, \
  {                                                                 \
    BAUM_I_Z_GROUND, BAUM_I_APART                                   \
  }

/* Axes are parallel. */
#define PARALLEL_ROWS       \
  {BAUM_I_X_A, BAUM_I_Z_B}, \
  {                         \
    BAUM_I_Y_A, BAUM_I_Z_B  \
  }

/* body_b's point is on the axis of body_a. */
#define LINE_ROWS             \
  {BAUM_I_X_A, BAUM_I_APART}, \
  {                           \
    BAUM_I_Y_A, BAUM_I_APART  \
  }

/* Sine and cosine of the angle about the axis; the displacement along it. */
#define ANGLE        .coordinate = {{BAUM_I_Y_A, BAUM_I_X_B}, {BAUM_I_X_A, BAUM_I_X_B}}
#define DISPLACEMENT .coordinate = {{BAUM_I_Z_A, BAUM_I_APART}}
#define COORDINATE                         \
  .coordinate = baum_i_spatial_coordinate, \
  .coordinate_linearize = baum_i_spatial_coordinate_linearize

#define SAME_DIRECTION .directed_count = 1, .directed = {{BAUM_I_Z_A, BAUM_I_Z_B}}

/* ---- the joints ---- */

static const baum_i_def_field spatial_spherical_fields[] = {
  BAUM_I_SPATIAL_FIELDS(baum_spatial_spherical_def),
  {0},
};

static const baum_i_spatial_joint_type spherical = {
  {BAUM_I_SPATIAL_JOINT(spatial_spherical, "spatial spherical joint", check_points, lower_points,
                        3)},
  .rows = {POINT_ROWS},
};

BAUM_I_DEFINE(joint, spatial_spherical, spherical.type)

static const baum_i_def_field spatial_revolute_fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_revolute_def),
  {0},
};

static const baum_i_spatial_joint_type revolute = {
  {BAUM_I_SPATIAL_JOINT(spatial_revolute, "spatial revolute joint", check_axes, lower_axes, 5),
   .is_angle = true, COORDINATE},
  .rows = {POINT_ROWS, PARALLEL_ROWS},
  ANGLE,
  SAME_DIRECTION,
};

BAUM_I_DEFINE(joint, spatial_revolute, revolute.type)

static const baum_i_def_field spatial_universal_fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_universal_def),
  {0},
};

static const baum_i_spatial_joint_type universal = {
  {BAUM_I_SPATIAL_JOINT(spatial_universal, "spatial universal joint", check_two_axes,
                        lower_two_axes, 4)},
  .rows = {POINT_ROWS, {BAUM_I_Z_A, BAUM_I_Z_B}},
};

BAUM_I_DEFINE(joint, spatial_universal, universal.type)

static const baum_i_def_field spatial_cylindrical_fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_cylindrical_def),
  {0},
};

static const baum_i_spatial_joint_type cylindrical = {
  {BAUM_I_SPATIAL_JOINT(spatial_cylindrical, "spatial cylindrical joint", check_axes, lower_axes,
                        4),
   COORDINATE},
  .rows = {PARALLEL_ROWS, LINE_ROWS},
  DISPLACEMENT,
  SAME_DIRECTION,
};

BAUM_I_DEFINE(joint, spatial_cylindrical, cylindrical.type)

static const baum_i_def_field spatial_prismatic_fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_prismatic_def),
  {0},
};

static const baum_i_spatial_joint_type prismatic = {
  {BAUM_I_SPATIAL_JOINT(spatial_prismatic, "spatial prismatic joint", check_axes, lower_axes, 5),
   COORDINATE},
  .rows = {PARALLEL_ROWS, LINE_ROWS, {BAUM_I_X_A, BAUM_I_Y_B}},
  DISPLACEMENT,
  .directed_count = 2,
  .directed = {{BAUM_I_Z_A, BAUM_I_Z_B}, {BAUM_I_X_A, BAUM_I_X_B}},
};

BAUM_I_DEFINE(joint, spatial_prismatic, prismatic.type)

static const baum_i_def_field spatial_planar_fields[] = {
  BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_planar_def),
  {0},
};

static const baum_i_spatial_joint_type planar = {
  {BAUM_I_SPATIAL_JOINT(spatial_planar, "spatial planar joint", check_axes, lower_axes, 3)},
  .rows = {PARALLEL_ROWS, {BAUM_I_Z_A, BAUM_I_APART}},
  SAME_DIRECTION,
};

BAUM_I_DEFINE(joint, spatial_planar, planar.type)

static const baum_i_def_field spatial_fixed_fields[] = {
  BAUM_I_SPATIAL_FIELDS(baum_spatial_fixed_def),
  {0},
};

static const baum_i_spatial_joint_type fixed = {
  {BAUM_I_SPATIAL_JOINT(spatial_fixed, "spatial fixed joint", check_turning, lower_fixed, 6)},
  .rows = {POINT_ROWS,
           {BAUM_I_X_A, BAUM_I_Y_B},
           {BAUM_I_Y_A, BAUM_I_Z_B},
           {BAUM_I_Z_A, BAUM_I_X_B}},
  .directed_count = 2,
  .directed = {{BAUM_I_Z_A, BAUM_I_Z_B}, {BAUM_I_X_A, BAUM_I_X_B}},
};

BAUM_I_DEFINE(joint, spatial_fixed, fixed.type)

static const baum_i_def_field spatial_point_on_line_fields[] = {
  BAUM_I_SPATIAL_FIELDS(baum_spatial_point_on_line_def),
  BAUM_I_NUMBERS(baum_spatial_point_on_line_def, axis, DIRECTION, "-", 0.0, 0.0, 1.0),
  {0},
};

static const baum_i_spatial_joint_type point_on_line = {
  {BAUM_I_SPATIAL_JOINT(spatial_point_on_line, "spatial point on a line", check_axis, lower_axis,
                        2),
   COORDINATE},
  .rows = {LINE_ROWS},
  DISPLACEMENT,
};

BAUM_I_DEFINE(joint, spatial_point_on_line, point_on_line.type)

static const baum_i_def_field spatial_point_on_plane_fields[] = {
  BAUM_I_SPATIAL_FIELDS(baum_spatial_point_on_plane_def),
  BAUM_I_NUMBERS(baum_spatial_point_on_plane_def, axis, DIRECTION, "-", 0.0, 0.0, 1.0),
  {0},
};

static const baum_i_spatial_joint_type point_on_plane = {
  {BAUM_I_SPATIAL_JOINT(spatial_point_on_plane, "spatial point on a plane", check_axis, lower_axis,
                        1)},
  .rows = {{BAUM_I_Z_A, BAUM_I_APART}},
};

BAUM_I_DEFINE(joint, spatial_point_on_plane, point_on_plane.type)
