/* SPDX-License-Identifier: BSD-3-Clause */
/* Coordinates of joints: checks of definitions, values in the design configuration, and whole
 * revolutions of angles. */
#include "mechanism/general/coordinate.h"

#include <math.h>

#include "base/message.h"
#include "base/rotation.h"
#include "base/text.h"

static const char *const names[] = {
  [BAUM_COORDINATE_FIRST] = "the first",
  [BAUM_COORDINATE_DISPLACEMENT] = "displacement",
  [BAUM_COORDINATE_ANGLE] = "angle",
  [BAUM_COORDINATE_ANGLE_B] = "angle_b",
  [BAUM_COORDINATE_X] = "x",
  [BAUM_COORDINATE_Y] = "y",
};

const char *baum_i_coordinate_name(baum_joint_coordinate which)
{
  return (size_t)which < sizeof names / sizeof *names ? names[which] : "unknown";
}

/* ---- checks ---- */

/* Return the index of a coordinate in the list of a joint type. Returns -1 if the type does not
 * have this coordinate. */
static int find(const baum_i_joint_type *type, baum_joint_coordinate which)
{
  int k = 0;
  while (which != BAUM_COORDINATE_FIRST && type->coordinates[k] != which) {
    if (type->coordinates[k++] == BAUM_COORDINATE_FIRST) {
      return -1;
    }
  }
  return k;
}

static baum_status fail_which(const baum_i_joint *joint, baum_joint_coordinate which,
                              const char *label, const char *field)
{
  baum_i_text list = {""};
  const baum_joint_coordinate *has = joint->type->coordinates;
  for (int k = 0; has[k] != BAUM_COORDINATE_FIRST; k++) {
    baum_i_append(list.text, sizeof list.text, k > 0 ? ", \"%s\"" : "\"%s\"",
                  baum_i_coordinate_name(has[k]));
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is \"%s\", but %s, a %s, has %s", label, field,
                     baum_i_coordinate_name(which), baum_i_label(&joint->element).text,
                     joint->type->definition.kind, list.text);
}

baum_status baum_i_check_coordinate(const baum_mechanism *mechanism, baum_joint_id id,
                                    baum_joint_coordinate which, const char *label,
                                    const baum_i_coordinate_fields *fields)
{
  BAUM_I_TRY(baum_i_check_joint(mechanism, id, label, fields->joint));
  const baum_i_joint *joint = mechanism->joints[baum_i_joint_index(mechanism, id)];
  if (!joint->type->coordinate) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %s, a %s, which has no coordinate %s", label,
                       fields->joint, baum_i_label(&joint->element).text,
                       joint->type->definition.kind, fields->purpose);
  }
  if (find(joint->type, which) < 0) {
    return fail_which(joint, which, label, fields->coordinate);
  }
  return joint->type->check_coordinate
           ? joint->type->check_coordinate(mechanism, joint->element.def, label)
           : BAUM_OK;
}

/* ---- one coordinate ---- */

baum_i_joint_coordinate baum_i_joint_coordinate_of(const baum_mechanism *mechanism,
                                                   baum_joint_id id, baum_joint_coordinate which)
{
  const baum_i_joint *joint = mechanism->joints[id.index1 - 1];
  return (baum_i_joint_coordinate){joint, find(joint->type, which)};
}

bool baum_i_is_angle(const baum_i_joint_coordinate *c)
{
  baum_joint_coordinate name = c->joint->type->coordinates[c->number];
  return name == BAUM_COORDINATE_ANGLE || name == BAUM_COORDINATE_ANGLE_B;
}

bool baum_i_is_spatial_angle(const baum_i_joint_coordinate *c)
{
  return c->joint->type->width == BAUM_I_SPACE && baum_i_is_angle(c);
}

void baum_i_coordinate_near_zero(const baum_i_joint_coordinate *c, const baum_i_point *point,
                                 baum_i_coordinate *out)
{
  baum_i_point near_zero = *point;
  near_zero.angles = NULL;
  baum_i_coordinate_at(c, &near_zero, out);
}

double baum_i_design_coordinate(const baum_mechanism *mechanism, const baum_i_joint_coordinate *c)
{
  /* A coordinate depends only on the two bodies of its joint. Here these have the numbers 0 and
   * 1. */
  int pair[2] = {0, 1};
  const int *bodies = c->joint->span.bodies;
  baum_i_frame frames[2] = {baum_i_design_frame(mechanism, bodies[0]),
                            baum_i_design_frame(mechanism, bodies[1])};
  baum_i_spatial_frame spatial[2] = {baum_i_spatial_design_frame(mechanism, bodies[0]),
                                     baum_i_spatial_design_frame(mechanism, bodies[1])};
  baum_i_joint alone = *c->joint;
  alone.span.bodies = pair;
  baum_i_point point = {.mechanism = mechanism,
                        .parameters = mechanism->parameters,
                        .frames = frames,
                        .spatial = spatial};
  const baum_i_joint_coordinate design = {&alone, c->number};
  baum_i_coordinate out;
  baum_i_coordinate_at(&design, &point, &out);
  return out.value;
}

/* ---- revolutions ---- */

/* Return a pointer to the stored angle of a coordinate. The next number in memory is its rate. */
static double *angle_of(const baum_i_joint_coordinate *c, const baum_i_point *point)
{
  int k = BAUM_I_COORDINATES * (c->joint->element.index - 1) + c->number;
  return point->angles + 2 * (ptrdiff_t)k;
}

static double *time_of(const baum_i_point *point)
{
  return point->angles + baum_i_angles_size(point->mechanism) - 1;
}

static double *force_angle_of(const baum_i_force *force, const baum_i_point *point)
{
  int k = BAUM_I_COORDINATES * point->mechanism->joint_count + force->element.index - 1;
  return point->angles + 2 * (ptrdiff_t)k;
}

static double expected(const double *angle, const baum_i_point *point)
{
  return angle[0] + angle[1] * (point->t - *time_of(point));
}

double baum_i_expected_angle(const baum_i_joint_coordinate *c, const baum_i_point *point)
{
  return point->angles ? expected(angle_of(c, point), point) : 0.0;
}

double baum_i_expected_force_angle(const baum_i_force *force, const baum_i_point *point)
{
  return point->angles ? expected(force_angle_of(force, point), point) : 0.0;
}

void baum_i_expect_angle(const baum_i_joint_coordinate *c, const baum_i_point *point, double angle)
{
  double *stored = angle_of(c, point);
  stored[0] = angle;
  stored[1] = 0.0;
}

baum_status baum_i_set_angle(const baum_i_point *point, baum_joint_id joint,
                             baum_joint_coordinate which, double angle, const char *call)
{
  static const baum_i_coordinate_fields fields = {"joint", "coordinate", "to set"};
  BAUM_I_TRY(baum_i_check_coordinate(point->mechanism, joint, which, call, &fields));
  const baum_i_joint_coordinate c = baum_i_joint_coordinate_of(point->mechanism, joint, which);
  if (!baum_i_is_spatial_angle(&c)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: coordinate is \"%s\" of %s, must be an angle of a spatial joint", call,
                       baum_i_coordinate_name(which), baum_i_label(&c.joint->element).text);
  }
  BAUM_I_TRY(baum_i_check_finite(call, "angle", "rad", angle));
  baum_i_expect_angle(&c, point, angle);
  return BAUM_OK;
}

static double follow(double *angle, double value, double rate, const baum_i_point *point)
{
  double near = angle[0] + 0.5 * (angle[1] + rate) * (point->t - *time_of(point));
  double off = remainder(value - near, BAUM_I_REVOLUTION);
  angle[0] = near + off;
  angle[1] = rate;
  return fabs(off);
}

static double follow_joint(const baum_i_joint *joint, const baum_i_point *point)
{
  double farthest = 0.0;
  for (int k = 0; joint->type->coordinates[k] != BAUM_COORDINATE_FIRST; k++) {
    const baum_i_joint_coordinate c = {joint, k};
    if (baum_i_is_spatial_angle(&c)) {
      baum_i_coordinate now;
      baum_i_coordinate_at(&c, point, &now);
      farthest = fmax(farthest, follow(angle_of(&c, point), now.value, now.rate, point));
    }
  }
  return farthest;
}

double baum_i_follow_angles(baum_i_point *point)
{
  double farthest = 0.0;
  for (int i = 0; point->angles && i < point->mechanism->joint_count; i++) {
    farthest = fmax(farthest, follow_joint(point->mechanism->joints[i], point));
  }
  for (int i = 0; point->angles && i < point->mechanism->force_count; i++) {
    const baum_i_force *force = point->mechanism->forces[i];
    if (force->type->counts_revolutions) {
      const baum_i_stretch now = force->type->stretch(force, point);
      farthest = fmax(farthest, follow(force_angle_of(force, point), now.length, now.rate, point));
    }
  }
  if (point->angles) {
    *time_of(point) = point->t;
  }
  return farthest;
}

bool baum_i_angles_are_near(const baum_i_point *point, double t, double rate)
{
  static const double NEAR = 0.1; /* [rad] */
  for (int i = 0; i < point->mechanism->force_count; i++) {
    if (point->mechanism->forces[i]->type->counts_revolutions) {
      return false; /* such an angle may change much faster than its bodies rotate */
    }
  }
  int size = baum_i_angles_size(point->mechanism);
  for (int k = 1; k < size; k += 2) {
    double own = fabs(point->angles[k]);
    rate = own > rate ? own : rate;
  }
  return rate * fabs(t - *time_of(point)) <= NEAR;
}

void baum_i_hold_angles(baum_i_point *point, double t)
{
  for (int k = 1; point->angles && k < baum_i_angles_size(point->mechanism); k += 2) {
    point->angles[k] = 0.0;
  }
  if (point->angles) {
    *time_of(point) = t;
  }
}
