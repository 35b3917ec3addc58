/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks the fields that spatial elements share, and converts their points to body axes.
 *
 * A definition may give a point in ground axes, in the design configuration. On a body with the
 * origin r, this point has the body coordinates s = A^T (point - r).
 */
#include "mechanism/spatial/spatial.h"

#include <string.h>

#include "base/message.h"

/* Points are considered equal up to this relative tolerance. A particle and the point of its joint
 * are often typed as decimal numbers, so they are equal only up to rounding. */
static const double SAME_PLACE = 1e-9;

/* ---- bodies ---- */

static const baum_i_body *body_of(const baum_mechanism *mechanism, baum_body_id id)
{
  return mechanism->bodies[baum_i_body_index(mechanism, id)];
}

static bool has_axes(const baum_i_body *body)
{
  baum_i_frame_kind kind = baum_i_frame_of(body);
  return kind != BAUM_I_FRAME_NONE && kind != BAUM_I_FRAME_PARTICLE &&
         kind != BAUM_I_FRAME_SPATIAL_PARTICLE;
}

static baum_status fail_body(const baum_i_body *body, const char *label, const char *field,
                             const char *what)
{
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %s, which has no %s", label, field,
                     baum_i_label(&body->element).text, what);
}

baum_status baum_i_spatial_check_body(const baum_mechanism *mechanism, baum_body_id id,
                                      const char *label, const char *field)
{
  const baum_i_body *body = body_of(mechanism, id);
  return baum_i_frame_of(body) == BAUM_I_FRAME_NONE
           ? fail_body(body, label, field, "place in space")
           : BAUM_OK;
}

baum_status baum_i_spatial_check_turning(const baum_mechanism *mechanism, baum_body_id id,
                                         const char *label, const char *field)
{
  BAUM_I_TRY(baum_i_spatial_check_body(mechanism, id, label, field));
  const baum_i_body *body = body_of(mechanism, id);
  return has_axes(body) ? BAUM_OK : fail_body(body, label, field, "orientation");
}

static baum_status check_different(const baum_mechanism *mechanism, baum_body_id a, baum_body_id b,
                                   const char *label)
{
  if (a.index1 != b.index1) {
    return BAUM_OK;
  }
  const baum_i_body *body = body_of(mechanism, a);
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: body_a and body_b are both %s", label,
                     body->type ? baum_i_label(&body->element).text : "ground");
}

static baum_status check_bodies(const baum_mechanism *mechanism, const baum_i_spatial_head *head,
                                const char *label)
{
  BAUM_I_TRY(baum_i_spatial_check_body(mechanism, head->body_a, label, "body_a"));
  BAUM_I_TRY(baum_i_spatial_check_body(mechanism, head->body_b, label, "body_b"));
  return check_different(mechanism, head->body_a, head->body_b, label);
}

baum_status baum_i_spatial_check_pair(const baum_mechanism *mechanism, baum_body_id a,
                                      baum_body_id b, const char *label)
{
  BAUM_I_TRY(baum_i_spatial_check_turning(mechanism, a, label, "body_a"));
  BAUM_I_TRY(baum_i_spatial_check_turning(mechanism, b, label, "body_b"));
  return check_different(mechanism, a, b, label);
}

/* ---- points ---- */

static baum_status check_one_way(const baum_i_spatial_head *head, const char *label,
                                 bool has_length)
{
  bool point = baum_i_spatial_is_given(head->point);
  if (point && has_length) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: point is given, but the length would be zero; give point_a and "
                       "point_b instead",
                       label);
  }
  return baum_i_check_points_given(label, point, baum_i_spatial_is_given(head->point_a),
                                   baum_i_spatial_is_given(head->point_b), !has_length);
}

baum_status baum_i_spatial_check_zero_on_particle(const baum_mechanism *mechanism, baum_body_id id,
                                                  const char *label, const char *field,
                                                  const char *unit, const double s[3])
{
  const baum_i_body *body = body_of(mechanism, id);
  bool is_zero = s[0] == 0.0 && s[1] == 0.0 && s[2] == 0.0;
  if (has_axes(body) || !baum_i_spatial_is_given(s) || is_zero) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: %s is (%g, %g, %g) %s, must be (0, 0, 0) on the particle %s", label,
                     field, s[0], s[1], s[2], unit, baum_i_label(&body->element).text);
}

baum_status baum_i_spatial_check_head(const baum_mechanism *mechanism, const void *def,
                                      const char *label, bool has_length)
{
  const baum_i_spatial_head *head = def;
  BAUM_I_TRY(check_bodies(mechanism, head, label));
  BAUM_I_TRY(check_one_way(head, label, has_length));
  BAUM_I_TRY(baum_i_spatial_check_zero_on_particle(mechanism, head->body_a, label, "point_a", "m",
                                                   head->point_a));
  return baum_i_spatial_check_zero_on_particle(mechanism, head->body_b, label, "point_b", "m",
                                               head->point_b);
}

/* Converts a point from ground axes to body axes. */
static baum_status place_on(const baum_mechanism *mechanism, int index, const double point[3],
                            const char *label, double s[3])
{
  const baum_i_body *body = mechanism->bodies[index];
  const baum_i_spatial_frame frame = baum_i_spatial_design_frame(mechanism, index);
  double apart[3];
  for (int i = 0; i < 3; i++) {
    apart[i] = point[i] - frame.r[i];
  }
  baum_i_turn_back(frame.axes, apart, s);
  if (has_axes(body)) {
    return BAUM_OK;
  }
  double near =
    SAME_PLACE * (sqrt(baum_i_dot3(point, point)) + sqrt(baum_i_dot3(frame.r, frame.r)));
  if (baum_i_dot3(s, s) <= near * near) {
    memset(s, 0, 3 * sizeof *s);
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: point is (%g, %g, %g) m, must be at the particle %s, whose design "
                     "position is (%g, %g, %g) m",
                     label, point[0], point[1], point[2], baum_i_label(&body->element).text,
                     frame.r[0], frame.r[1], frame.r[2]);
}

baum_status baum_i_spatial_points(const baum_mechanism *mechanism, const baum_i_element *element,
                                  double s[6])
{
  const baum_i_spatial_head *head = element->def;
  if (!baum_i_spatial_is_given(head->point)) {
    memcpy(s, head->point_a, sizeof head->point_a);
    memcpy(s + 3, head->point_b, sizeof head->point_b);
    return BAUM_OK;
  }
  int a = baum_i_body_index(mechanism, head->body_a);
  int b = baum_i_body_index(mechanism, head->body_b);
  const baum_i_text label = baum_i_label(element);
  BAUM_I_TRY(place_on(mechanism, a, head->point, label.text, s));
  return place_on(mechanism, b, head->point, label.text, s + 3);
}

/* ---- extent ---- */

static void include_point(baum_i_box *box, const baum_mechanism *mechanism, int body,
                          const double s[3])
{
  if (baum_i_spatial_is_given(s)) {
    const baum_i_spatial_frame frame = baum_i_spatial_design_frame(mechanism, body);
    double at[3];
    baum_i_turn(frame.axes, s, at);
    baum_i_box_include(box, frame.r[0] + at[0], frame.r[1] + at[1], frame.r[2] + at[2]);
  }
}

void baum_i_spatial_extent(const baum_mechanism *mechanism, const baum_i_joint *joint,
                           baum_i_box *box)
{
  const baum_i_spatial_head *head = joint->element.def;
  include_point(box, mechanism, 0, head->point);
  include_point(box, mechanism, joint->span.bodies[0], head->point_a);
  include_point(box, mechanism, joint->span.bodies[1], head->point_b);
}
