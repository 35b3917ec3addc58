/* SPDX-License-Identifier: BSD-3-Clause */
/* The part that planar joints and forces have in common: checks of their common fields, and the
 * conversion of points to body axes.
 *
 * A definition may give a point in ground axes, in the design configuration. On a body with the
 * origin r, this point has the body coordinates s = A^T (point - r).
 */
#include "mechanism/planar/planar.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "mechanism/definition.h"

/* Points are considered equal up to this relative tolerance. Points that users give as decimal
 * numbers are equal only up to rounding. */
static const double SAME_PLACE = 1e-9;

/* ---- bodies ---- */

static bool has_angle(const baum_i_body *body)
{
  baum_i_frame_kind kind = baum_i_frame_of(body);
  return kind == BAUM_I_FRAME_BODY || kind == BAUM_I_FRAME_GROUND;
}

baum_status baum_i_planar_check_body(const baum_mechanism *mechanism, baum_body_id id,
                                     const char *label, const char *field)
{
  const baum_i_body *body = mechanism->bodies[baum_i_body_index(mechanism, id)];
  baum_i_frame_kind kind = baum_i_frame_of(body);
  if (kind == BAUM_I_FRAME_NONE || baum_i_is_spatial(kind)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %s, which has no position in the plane%s",
                       label, field, baum_i_label(&body->element).text,
                       baum_i_is_spatial(kind) ? "; take the spatial element" : "");
  }
  return BAUM_OK;
}

baum_status baum_i_planar_check_bodies(const baum_mechanism *mechanism, const void *def,
                                       const char *label)
{
  const baum_i_planar_head *head = def;
  BAUM_I_TRY(baum_i_planar_check_body(mechanism, head->body_a, label, "body_a"));
  BAUM_I_TRY(baum_i_planar_check_body(mechanism, head->body_b, label, "body_b"));
  if (head->body_a.index1 == head->body_b.index1) {
    const baum_i_body *both = mechanism->bodies[baum_i_body_index(mechanism, head->body_a)];
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: body_a and body_b are both %s", label,
                       baum_i_label(&both->element).text);
  }
  return BAUM_OK;
}

baum_status baum_i_planar_check_angle(const baum_mechanism *mechanism, baum_body_id id,
                                      const char *label, const char *field)
{
  const baum_i_body *body = mechanism->bodies[baum_i_body_index(mechanism, id)];
  if (has_angle(body)) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %s, which has no angle", label, field,
                     baum_i_label(&body->element).text);
}

baum_status baum_i_planar_check_angles(const baum_mechanism *mechanism, const void *def,
                                       const char *label)
{
  const baum_i_planar_head *head = def;
  BAUM_I_TRY(baum_i_planar_check_angle(mechanism, head->body_a, label, "body_a"));
  return baum_i_planar_check_angle(mechanism, head->body_b, label, "body_b");
}

/* ---- points ---- */

/* Tell whether a point is given. Either both numbers of a point are given, or neither of them. */
static bool is_given(const double point[2])
{
  return !isnan(point[0]);
}

static baum_status check_one_way(const baum_i_planar_head *head, const char *label,
                                 bool point_allowed)
{
  bool point = is_given(head->point);
  if (point && !point_allowed) {
    return baum_i_fail(
      BAUM_ERR_ARGUMENT,
      "%s: point is given, but the length would be zero; give point_a and point_b instead", label);
  }
  return baum_i_check_points_given(label, point, is_given(head->point_a), is_given(head->point_b),
                                   point_allowed);
}

static baum_status check_on_particle(const baum_mechanism *mechanism, baum_body_id id,
                                     const char *label, const char *field, const double s[2])
{
  const baum_i_body *body = mechanism->bodies[baum_i_body_index(mechanism, id)];
  if (has_angle(body) || !is_given(s) || (s[0] == 0.0 && s[1] == 0.0)) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is (%g, %g) m, must be (0, 0) on the particle %s",
                     label, field, s[0], s[1], baum_i_label(&body->element).text);
}

static baum_status check_points(const baum_mechanism *mechanism, const void *def, const char *label,
                                bool point_allowed)
{
  const baum_i_planar_head *head = def;
  BAUM_I_TRY(baum_i_planar_check_bodies(mechanism, head, label));
  BAUM_I_TRY(check_one_way(head, label, point_allowed));
  BAUM_I_TRY(check_on_particle(mechanism, head->body_a, label, "point_a", head->point_a));
  return check_on_particle(mechanism, head->body_b, label, "point_b", head->point_b);
}

baum_status baum_i_planar_check_with_point(const baum_mechanism *mechanism, const void *def,
                                           const char *label)
{
  return check_points(mechanism, def, label, true);
}

baum_status baum_i_planar_check_apart(const baum_mechanism *mechanism, const void *def,
                                      const char *label)
{
  return check_points(mechanism, def, label, false);
}

baum_status baum_i_planar_check_turning(const baum_mechanism *mechanism, const void *def,
                                        const char *label)
{
  BAUM_I_TRY(check_points(mechanism, def, label, true));
  return baum_i_planar_check_angles(mechanism, def, label);
}

baum_status baum_i_planar_check_axis(const baum_mechanism *mechanism, const void *def,
                                     const char *label)
{
  const baum_i_planar_head *head = def;
  BAUM_I_TRY(check_points(mechanism, def, label, true));
  return baum_i_planar_check_angle(mechanism, head->body_a, label, "body_a");
}

/* Convert a point in the design configuration from ground axes to the axes of a body. */
static baum_status place_on(const baum_mechanism *mechanism, int index, const double point[2],
                            const baum_i_element *element, double s[2])
{
  baum_i_frame frame = baum_i_design_frame(mechanism, index);
  double x = point[0] - frame.x;
  double y = point[1] - frame.y;
  const baum_i_body *body = mechanism->bodies[index];
  if (has_angle(body)) {
    s[0] = frame.c * x + frame.s * y;
    s[1] = -frame.s * x + frame.c * y;
    return BAUM_OK;
  }
  s[0] = 0.0;
  s[1] = 0.0;
  if (hypot(x, y) <= SAME_PLACE * (hypot(point[0], point[1]) + hypot(frame.x, frame.y))) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: point is (%g, %g) m, must be at the particle %s, which is at (%g, %g) m",
                     baum_i_label(element).text, point[0], point[1],
                     baum_i_label(&body->element).text, frame.x, frame.y);
}

baum_status baum_i_planar_points(const baum_mechanism *mechanism, const baum_i_element *element,
                                 double s[4])
{
  const baum_i_planar_head *head = element->def;
  if (!is_given(head->point)) {
    memcpy(s, head->point_a, sizeof head->point_a);
    memcpy(s + 2, head->point_b, sizeof head->point_b);
    return BAUM_OK;
  }
  int a = baum_i_body_index(mechanism, head->body_a);
  int b = baum_i_body_index(mechanism, head->body_b);
  BAUM_I_TRY(place_on(mechanism, a, head->point, element, s));
  return place_on(mechanism, b, head->point, element, s + 2);
}

/* ---- extent ---- */

static void include_marker(baum_i_box *box, const baum_i_frame *f, const double s[2])
{
  if (is_given(s)) {
    baum_i_marker marker = baum_i_marker_on(f, s);
    baum_i_box_include(box, marker.r[0], marker.r[1], 0.0);
  }
}

void baum_i_planar_extent(const baum_mechanism *mechanism, const baum_i_joint *joint,
                          baum_i_box *box)
{
  const baum_i_planar_head *head = joint->element.def;
  baum_i_frame ground = baum_i_design_frame(mechanism, 0);
  baum_i_frame fa = baum_i_design_frame(mechanism, joint->span.bodies[0]);
  baum_i_frame fb = baum_i_design_frame(mechanism, joint->span.bodies[1]);
  include_marker(box, &ground, head->point);
  include_marker(box, &fa, head->point_a);
  include_marker(box, &fb, head->point_b);
}
