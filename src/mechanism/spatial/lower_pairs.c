/* SPDX-License-Identifier: BSD-3-Clause */
/* Spatial joints whose rows are products of two vectors (spatial_rows.h). Each joint is defined by
 * a table of such products.
 *
 * Every joint has axes x_a, y_a, z_a on body_a and x_b, y_b, z_b on body_b. The z axes are along
 * the axes of the definition. The vector e points from body_a's point to body_b's point.
 */
#include <string.h>

#include "base/message.h"
#include "mechanism/spatial/spatial_joint.h"

/* Two axes are considered opposite if 1 plus the cosine of the angle between them is below
 * OPPOSITE. They are considered parallel if the sine of this angle is below OPPOSITE. In these
 * cases, the direction of the x axis and the zero of the joint's angle are not determined. */
static const double OPPOSITE = 1e-6;

/* ---- checks ---- */

static baum_status check_points(const baum_mechanism *mechanism, const void *def, const char *label)
{
  return baum_i_spatial_check_head(mechanism, def, label, false);
}

/* Checks a joint with one axis. Only body_a needs an orientation, so body_b may be a particle. */
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

/* Checks that an optional direction is not the zero vector. A direction that is not given is
 * NaN. */
static baum_status check_direction(const double x[3], const char *label, const char *field)
{
  return x[0] != 0.0 || x[1] != 0.0 || x[2] != 0.0
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is (0, 0, 0), which has no direction", label,
                         field);
}

baum_status baum_i_spatial_check_axes(const baum_mechanism *mechanism, const void *def,
                                      const char *label)
{
  const baum_i_spatial_axis_head *given = def;
  BAUM_I_TRY(check_turning(mechanism, def, label));
  return check_direction(given->axis_b, label, "axis_b");
}

baum_status baum_i_spatial_check_frame(const baum_mechanism *mechanism, const void *def,
                                       const char *label)
{
  const baum_spatial_planar_def *given = def;
  BAUM_I_TRY(baum_i_spatial_check_axes(mechanism, def, label));
  return check_direction(given->x_axis, label, "x_axis");
}

static baum_status check_two_axes(const baum_mechanism *mechanism, const void *def,
                                  const char *label)
{
  const baum_i_spatial_axis_head *given = def;
  BAUM_I_TRY(baum_i_spatial_check_axes(mechanism, def, label));
  return baum_i_spatial_is_given(given->axis_b)
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: axis_b is not given", label);
}

/* ---- parameters ---- */

static baum_status lower_points(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                double *parameters)
{
  return baum_i_spatial_points(mechanism, &joint->element, parameters);
}

/* Converts an axis of the definition to ground axes. If the definition gives `point`, its axes are
 * in ground axes, otherwise they are in body axes. */
static void to_ground(const baum_i_spatial_head *head, const baum_i_spatial_frame *frame,
                      const double axis[3], double out[3])
{
  if (baum_i_spatial_is_given(head->point)) {
    memcpy(out, axis, 3 * sizeof *out);
  } else {
    baum_i_turn(frame->axes, axis, out);
  }
  baum_i_normalize3(out);
}

/* Computes the joint axes x, y and z in body axes. The arguments z and x are in ground axes, and x
 * is made perpendicular to z. Returns false if x is parallel to z. */
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
  baum_i_normalize3(ground);
  memcpy(ground + 6, z, 3 * sizeof *z);
  baum_i_cross(z, ground, ground + 3);
  for (int i = 0; i < 9; i += 3) {
    baum_i_turn_back(frame->axes, ground + i, out + i);
  }
  return true;
}

/* Computes joint axes whose z is along an axis of the definition. The directions of x and y are
 * arbitrary. */
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
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: axis and axis_b point in opposite directions in the design "
                     "configuration; reverse one of them",
                     baum_i_label(&joint->element).text);
}

/* Finds x_b. It is x_a after the smallest rotation that takes z_a to z_b. The angle of the joint is
 * therefore 0 in the design configuration. */
static baum_status lower_axes_b(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                double *parameters)
{
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
  /* Let n = z_a x z_b and c = z_a . z_b. This rotation takes any vector y to
   * y + n x y + n x (n x y) / (1 + c). */
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

static baum_status lower_axes(const baum_mechanism *mechanism, const baum_i_joint *joint,
                              double *parameters)
{
  BAUM_I_TRY(lower_axis(mechanism, joint, parameters));
  return lower_axes_b(mechanism, joint, parameters);
}

/* Writes the axis on body_a (side 0) or on body_b (side 1) in ground axes. Returns the frame of
 * this body in the design configuration. */
static baum_i_spatial_frame design_axis(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                        int side, double z[3])
{
  const baum_i_spatial_axis_head *def = joint->element.def;
  const baum_i_spatial_frame frame =
    baum_i_spatial_design_frame(mechanism, joint->span.bodies[side]);
  to_ground(&def->head, &frame, side == 0 ? def->axis : def->axis_b, z);
  return frame;
}

/* Chooses x_a = z_b and y_b = z_a in the design configuration, so that both angles are 0 there. */
static baum_status lower_two_axes(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                  double *parameters)
{
  double z_a[3];
  double z_b[3];
  double normal[3];
  BAUM_I_TRY(lower_points(mechanism, joint, parameters));
  const baum_i_spatial_frame a = design_axis(mechanism, joint, 0, z_a);
  const baum_i_spatial_frame b = design_axis(mechanism, joint, 1, z_b);
  baum_i_cross(z_a, z_b, normal);
  bool fine = put_axes(&a, z_a, z_b, parameters + BAUM_I_SPATIAL_AXES_A) &&
              put_axes(&b, z_b, normal, parameters + BAUM_I_SPATIAL_AXES_B);
  return fine ? BAUM_OK
              : baum_i_fail(BAUM_ERR_ARGUMENT,
                            "%s: axis and axis_b are parallel in the design configuration, must "
                            "be perpendicular",
                            baum_i_label(&joint->element).text);
}

static baum_status lower_planar(const baum_mechanism *mechanism, const baum_i_joint *joint,
                                double *parameters)
{
  static const double ground[2][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const baum_spatial_planar_def *def = joint->element.def;
  double *axes = parameters + BAUM_I_SPATIAL_AXES_A;
  double z[3];
  double x[3];
  BAUM_I_TRY(lower_points(mechanism, joint, parameters));
  const baum_i_spatial_frame a = design_axis(mechanism, joint, 0, z);
  bool given = baum_i_spatial_is_given(def->x_axis);
  if (given) {
    to_ground(joint->element.def, &a, def->x_axis, x);
  }
  if (!(given ? put_axes(&a, z, x, axes)
              : put_axes(&a, z, ground[0], axes) || put_axes(&a, z, ground[1], axes))) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: x_axis is parallel to axis; give another direction",
                       baum_i_label(&joint->element).text);
  }
  return lower_axes_b(mechanism, joint, parameters);
}

/* The axes of a joint depend only on its span and element. The axes of a force are therefore
 * computed as if the force were a joint. */
baum_status baum_i_spatial_lower_axes(const baum_mechanism *mechanism,
                                      const baum_i_element *element, const baum_i_span *span,
                                      double *parameters)
{
  const baum_i_joint alike = {.element = *element, .span = *span};
  return lower_axes(mechanism, &alike, parameters);
}

baum_status baum_i_spatial_lower_frame(const baum_mechanism *mechanism,
                                       const baum_i_element *element, const baum_i_span *span,
                                       double *parameters)
{
  const baum_i_joint alike = {.element = *element, .span = *span};
  return lower_planar(mechanism, &alike, parameters);
}

/* In the design configuration, the joint axes on both bodies are the ground axes. */
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

/* These rows make the points of body_a and body_b coincide: e = 0. */
#define POINT_ROWS                                                  \
  {BAUM_I_X_GROUND, BAUM_I_APART}, {BAUM_I_Y_GROUND, BAUM_I_APART}, \
  {                                                                 \
    BAUM_I_Z_GROUND, BAUM_I_APART                                   \
  }

/* These rows make z_a and z_b parallel. */
#define PARALLEL_ROWS       \
  {BAUM_I_X_A, BAUM_I_Z_B}, \
  {                         \
    BAUM_I_Y_A, BAUM_I_Z_B  \
  }

/* These rows keep the point of body_b on the axis of body_a. */
#define LINE_ROWS             \
  {BAUM_I_X_A, BAUM_I_APART}, \
  {                           \
    BAUM_I_Y_A, BAUM_I_APART  \
  }

/* ANGLE gives the two products that are the sine and the cosine of the angle about z. ALONG gives
 * the product that is the displacement along an axis. */
#define ANGLE                 \
  {                           \
    {BAUM_I_Y_A, BAUM_I_X_B}, \
    {                         \
      BAUM_I_X_A, BAUM_I_X_B  \
    }                         \
  }
#define ALONG(AXIS)      \
  {                      \
    {                    \
      AXIS, BAUM_I_APART \
    }                    \
  }
#define COORDINATES(...)                                                 \
  .coordinates = {__VA_ARGS__}, .coordinate = baum_i_spatial_coordinate, \
  .coordinate_linearize = baum_i_spatial_coordinate_linearize

#define SAME_DIRECTION .directed_count = 1, .directed = {{BAUM_I_Z_A, BAUM_I_Z_B}}

/* ---- the joints ---- */

static const baum_i_spatial_joint_type spherical = {
  {BAUM_I_SPATIAL_JOINT(spatial_spherical, "spatial spherical joint", check_points, lower_points, 3,
                        BAUM_I_SPATIAL_FIELDS(baum_spatial_spherical_def))},
  .rows = {POINT_ROWS},
};

BAUM_I_DEFINE(joint, spatial_spherical, spherical.type)

static const baum_i_spatial_joint_type revolute = {
  {BAUM_I_SPATIAL_JOINT(spatial_revolute, "spatial revolute joint", baum_i_spatial_check_axes,
                        lower_axes, 5, BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_revolute_def)),
   COORDINATES(BAUM_COORDINATE_ANGLE)},
  .rows = {POINT_ROWS, PARALLEL_ROWS},
  .coordinate_rows = {ANGLE},
  SAME_DIRECTION,
};

BAUM_I_DEFINE(joint, spatial_revolute, revolute.type)

static const baum_i_spatial_joint_type universal = {
  {BAUM_I_SPATIAL_JOINT(spatial_universal, "spatial universal joint", check_two_axes,
                        lower_two_axes, 4, BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_universal_def)),
   COORDINATES(BAUM_COORDINATE_ANGLE, BAUM_COORDINATE_ANGLE_B)},
  .rows = {POINT_ROWS, {BAUM_I_Z_A, BAUM_I_Z_B}},
  /* The first angle is the rotation of z_b about z_a, seen from body_a. The second angle is the
   * rotation of body_b about z_b. It is therefore minus the rotation of z_a about z_b, seen from
   * body_b. */
  .coordinate_rows = {{{BAUM_I_Y_A, BAUM_I_Z_B}, {BAUM_I_X_A, BAUM_I_Z_B}},
                      {{BAUM_I_X_B, BAUM_I_Z_A}, {BAUM_I_Y_B, BAUM_I_Z_A}}},
};

BAUM_I_DEFINE(joint, spatial_universal, universal.type)

static const baum_i_spatial_joint_type cylindrical = {
  {BAUM_I_SPATIAL_JOINT(spatial_cylindrical, "spatial cylindrical joint", baum_i_spatial_check_axes,
                        lower_axes, 4, BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_cylindrical_def)),
   COORDINATES(BAUM_COORDINATE_DISPLACEMENT, BAUM_COORDINATE_ANGLE)},
  .rows = {PARALLEL_ROWS, LINE_ROWS},
  .coordinate_rows = {ALONG(BAUM_I_Z_A), ANGLE},
  SAME_DIRECTION,
};

BAUM_I_DEFINE(joint, spatial_cylindrical, cylindrical.type)

static const baum_i_spatial_joint_type prismatic = {
  {BAUM_I_SPATIAL_JOINT(spatial_prismatic, "spatial prismatic joint", baum_i_spatial_check_axes,
                        lower_axes, 5, BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_prismatic_def)),
   COORDINATES(BAUM_COORDINATE_DISPLACEMENT)},
  .rows = {PARALLEL_ROWS, LINE_ROWS, {BAUM_I_X_A, BAUM_I_Y_B}},
  .coordinate_rows = {ALONG(BAUM_I_Z_A)},
  .directed_count = 2,
  .directed = {{BAUM_I_Z_A, BAUM_I_Z_B}, {BAUM_I_X_A, BAUM_I_X_B}},
};

BAUM_I_DEFINE(joint, spatial_prismatic, prismatic.type)

static const baum_i_spatial_joint_type planar = {
  {BAUM_I_SPATIAL_JOINT(spatial_planar, "spatial planar joint", baum_i_spatial_check_frame,
                        lower_planar, 3, BAUM_I_SPATIAL_AXIS_FIELDS(baum_spatial_planar_def),
                        BAUM_I_OPTIONAL(baum_spatial_planar_def, x_axis, POINT, "-")),
   COORDINATES(BAUM_COORDINATE_X, BAUM_COORDINATE_Y, BAUM_COORDINATE_ANGLE)},
  .rows = {PARALLEL_ROWS, {BAUM_I_Z_A, BAUM_I_APART}},
  .coordinate_rows = {ALONG(BAUM_I_X_A), ALONG(BAUM_I_Y_A), ANGLE},
  SAME_DIRECTION,
};

BAUM_I_DEFINE(joint, spatial_planar, planar.type)

static const baum_i_spatial_joint_type fixed = {
  {BAUM_I_SPATIAL_JOINT(spatial_fixed, "spatial fixed joint", check_turning, lower_fixed, 6,
                        BAUM_I_SPATIAL_FIELDS(baum_spatial_fixed_def))},
  .rows = {POINT_ROWS,
           {BAUM_I_X_A, BAUM_I_Y_B},
           {BAUM_I_Y_A, BAUM_I_Z_B},
           {BAUM_I_Z_A, BAUM_I_X_B}},
  .directed_count = 2,
  .directed = {{BAUM_I_Z_A, BAUM_I_Z_B}, {BAUM_I_X_A, BAUM_I_X_B}},
};

BAUM_I_DEFINE(joint, spatial_fixed, fixed.type)

static const baum_i_spatial_joint_type point_on_line = {
  {BAUM_I_SPATIAL_JOINT(
     spatial_point_on_line, "spatial point on a line", check_axis, lower_axis, 2,
     BAUM_I_SPATIAL_FIELDS(baum_spatial_point_on_line_def),
     BAUM_I_NUMBERS(baum_spatial_point_on_line_def, axis, DIRECTION, "-", 0.0, 0.0, 1.0)),
   COORDINATES(BAUM_COORDINATE_DISPLACEMENT)},
  .rows = {LINE_ROWS},
  .coordinate_rows = {ALONG(BAUM_I_Z_A)},
};

BAUM_I_DEFINE(joint, spatial_point_on_line, point_on_line.type)

static const baum_i_spatial_joint_type point_on_plane = {
  {BAUM_I_SPATIAL_JOINT(
    spatial_point_on_plane, "spatial point on a plane", check_axis, lower_axis, 1,
    BAUM_I_SPATIAL_FIELDS(baum_spatial_point_on_plane_def),
    BAUM_I_NUMBERS(baum_spatial_point_on_plane_def, axis, DIRECTION, "-", 0.0, 0.0, 1.0))},
  .rows = {{BAUM_I_Z_A, BAUM_I_APART}},
};

BAUM_I_DEFINE(joint, spatial_point_on_plane, point_on_plane.type)
