/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks the outlines that users give to bodies, and draws them. */
#include <stdlib.h>
#include <string.h>

#include <baum/draw.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "draw/drawing.h"
#include "mechanism/identify.h"
#include "mechanism/mechanism.h"

void baum_outline_init(baum_outline *outline, size_t caller_size)
{
  const baum_outline defaults = {.struct_size = sizeof defaults};
  if (baum_i_takes_sized(outline, caller_size)) {
    baum_i_give_sized(outline, caller_size, &defaults, sizeof defaults);
  }
}

/* ---- checks ---- */

/* The outline that is being checked. Messages about it begin with `call` and the index `k`. */
typedef struct subject {
  const char *call;
  int k;
  const baum_outline *outline;
} subject;

static baum_status refuse(const subject *s, const char *text)
{
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: outlines[%d]: %s", s->call, s->k, text);
}

static baum_status check_numbers(const subject *s, const char *field, const double *x, int count)
{
  for (int i = 0; i < count; i++) {
    if (!isfinite(x[i])) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: outlines[%d]: %s[%d] is %g m, must be finite",
                         s->call, s->k, field, i, x[i]);
    }
  }
  return BAUM_OK;
}

static baum_status check_points(const subject *s)
{
  const baum_outline *o = s->outline;
  if (!o->points || o->point_count < 3) {
    return !o->points ? refuse(s, "points are NULL")
                      : baum_i_fail(BAUM_ERR_ARGUMENT,
                                    "%s: outlines[%d]: point_count is %d, must be at least 3",
                                    s->call, s->k, (int)o->point_count);
  }
  for (int k = 0; k < o->point_count; k++) {
    for (int i = 0; i < 3; i++) {
      const double x = o->points[3 * (size_t)k + i];
      if (!isfinite(x)) {
        return baum_i_fail(BAUM_ERR_ARGUMENT,
                           "%s: outlines[%d]: %c of point %d is %g m, must be finite", s->call,
                           s->k, 'x' + i, k, x);
      }
    }
  }
  return BAUM_OK;
}

static baum_status check_polygon(const subject *s)
{
  const baum_outline *o = s->outline;
  BAUM_I_TRY(check_points(s));
  for (int k = 1; k < o->point_count; k++) {
    const double z = o->points[3 * (size_t)k + 2];
    if (z != o->points[2]) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "%s: outlines[%d]: z of point %d of a polygon is %g m, must be %g m "
                         "like z of point 0",
                         s->call, s->k, k, z, o->points[2]);
    }
  }
  return BAUM_OK;
}

static baum_status check_mesh(const subject *s)
{
  const baum_outline *o = s->outline;
  BAUM_I_TRY(check_points(s));
  if (o->triangle_count < 1 || o->triangle_count > BAUM_OUTLINE_MAX_TRIANGLES) {
    return baum_i_fail(
      BAUM_ERR_ARGUMENT,
      "%s: outlines[%d]: triangle_count is %d, must be from 1 to %d; simplify a larger mesh",
      s->call, s->k, (int)o->triangle_count, BAUM_OUTLINE_MAX_TRIANGLES);
  }
  if (!o->triangles) {
    return refuse(s, "triangles are NULL");
  }
  for (int i = 0; i < 3 * o->triangle_count; i++) {
    if (o->triangles[i] < 0 || o->triangles[i] >= o->point_count) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "%s: outlines[%d]: triangle %d refers to point %d, must be from 0 to %d",
                         s->call, s->k, i / 3, (int)o->triangles[i], (int)o->point_count - 1);
    }
  }
  return BAUM_OK;
}

static baum_status check_radius(const subject *s)
{
  const double radius = s->outline->radius;
  if (isfinite(radius) && radius > 0.0) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: outlines[%d]: radius is %g m, must be > 0 and finite",
                     s->call, s->k, radius);
}

static baum_status check_round(const subject *s)
{
  BAUM_I_TRY(check_numbers(s, "center", s->outline->center, 3));
  return check_radius(s);
}

static baum_status check_cylinder(const subject *s)
{
  const baum_outline *o = s->outline;
  BAUM_I_TRY(check_numbers(s, "start", o->start, 3));
  BAUM_I_TRY(check_numbers(s, "end", o->end, 3));
  if (o->start[0] == o->end[0] && o->start[1] == o->end[1] && o->start[2] == o->end[2]) {
    return refuse(s, "start and end of a cylinder are the same point");
  }
  return check_radius(s);
}

static baum_status check_box(const subject *s)
{
  const baum_outline *o = s->outline;
  int zeros = 0;
  BAUM_I_TRY(check_numbers(s, "center", o->center, 3));
  BAUM_I_TRY(check_numbers(s, "size", o->size, 3));
  for (int i = 0; i < 3; i++) {
    if (o->size[i] < 0.0) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: outlines[%d]: size[%d] is %g m, must be >= 0",
                         s->call, s->k, i, o->size[i]);
    }
    zeros += o->size[i] == 0.0;
  }
  return zeros < 2 ? BAUM_OK : refuse(s, "two edges of a box are 0");
}

static baum_status check_color(const subject *s)
{
  const char *color = s->outline->color;
  bool fine = !color || (strlen(color) == 7 && color[0] == '#');
  for (int i = 1; fine && color && i < 7; i++) {
    fine = strchr("0123456789abcdefABCDEF", color[i]) != NULL;
  }
  return fine ? BAUM_OK : refuse(s, "color is not of the form \"#rrggbb\"");
}

static baum_status check_outline(const subject *s)
{
  static baum_status (*const checks[])(const subject *) = {
    [BAUM_OUTLINE_POLYGON] = check_polygon, [BAUM_OUTLINE_CIRCLE] = check_round,
    [BAUM_OUTLINE_BOX] = check_box,         [BAUM_OUTLINE_CYLINDER] = check_cylinder,
    [BAUM_OUTLINE_SPHERE] = check_round,    [BAUM_OUTLINE_MESH] = check_mesh};
  const int form = (int)s->outline->form;
  if (s->outline->struct_size != sizeof *s->outline) {
    return baum_i_fail(BAUM_ERR_STRUCT,
                       "%s: struct_size of outlines[%d] is %zu, must be %zu; begin with "
                       "baum_outline_default()",
                       s->call, s->k, s->outline->struct_size, sizeof *s->outline);
  }
  if (form < 0 || form > BAUM_OUTLINE_MESH) {
    return refuse(s, "form is not one of baum_outline_form");
  }
  BAUM_I_TRY(check_color(s));
  return checks[form](s);
}

/* ---- calls ---- */

baum_status baum_mechanism_set_outlines(baum_mechanism *mechanism, baum_body_id body,
                                        const baum_outline *outlines, int32_t count)
{
  const char *call = "baum_mechanism_set_outlines";
  BAUM_I_TRY(baum_i_check_body(mechanism, body, call, "body"));
  baum_i_body *owner = mechanism->bodies[baum_i_body_index(mechanism, body)];
  if (baum_i_frame_of(owner) == BAUM_I_FRAME_NONE) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: \"%s\" are user coordinates, which cannot have outlines", call,
                       owner->element.name);
  }
  if (count < 0 || (count > 0 && !outlines)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s", call,
                       count < 0 ? "count is negative" : "outlines are NULL");
  }
  for (int k = 0; k < count; k++) {
    BAUM_I_TRY(check_outline(&(subject){call, k, &outlines[k]}));
  }
  baum_outline *copies;
  BAUM_I_TRY(baum_i_copy_outlines(outlines, count, &copies));
  baum_i_free_outlines(owner->outlines, owner->outline_count);
  owner->outlines = copies;
  owner->outline_count = count;
  return BAUM_OK;
}

int32_t baum_mechanism_outline_count(const baum_mechanism *mechanism, baum_body_id body)
{
  const int index = baum_i_body_index(mechanism, body);
  return index < 0 ? 0 : mechanism->bodies[index]->outline_count;
}

baum_status baum_mechanism_get_outline(const baum_mechanism *mechanism, baum_body_id body,
                                       int32_t k, baum_outline *out, size_t caller_size)
{
  const char *call = "baum_mechanism_get_outline";
  BAUM_I_TRY(baum_i_check_body(mechanism, body, call, "body"));
  BAUM_I_TRY(baum_i_check_sized(out, caller_size, call));
  const baum_i_body *owner = mechanism->bodies[baum_i_body_index(mechanism, body)];
  BAUM_I_TRY(baum_i_check_entry(k, 0, owner->outline_count, call));
  baum_i_give_sized(out, caller_size, &owner->outlines[k], sizeof *owner->outlines);
  return BAUM_OK;
}

/* ---- shapes ---- */

/* For each form of an outline, the form of the shape that draws it. */
static const baum_i_form FORMS[] = {
  [BAUM_OUTLINE_POLYGON] = BAUM_I_AREA, [BAUM_OUTLINE_CIRCLE] = BAUM_I_DISC,
  [BAUM_OUTLINE_BOX] = BAUM_I_BOX,      [BAUM_OUTLINE_CYLINDER] = BAUM_I_CYLINDER,
  [BAUM_OUTLINE_SPHERE] = BAUM_I_BALL,  [BAUM_OUTLINE_MESH] = BAUM_I_MESH};

static bool has_radius(const baum_outline *o)
{
  return o->form == BAUM_OUTLINE_CIRCLE || o->form == BAUM_OUTLINE_SPHERE ||
         o->form == BAUM_OUTLINE_CYLINDER;
}

static void draw_outline(baum_i_drawing *drawing, baum_i_shape shape, const baum_outline *o)
{
  const double *c = o->center, *size = o->size, *a = o->start, *b = o->end;
  const double round[2][3] = {{c[0], c[1], c[2]}, {0.0, 0.0, 1.0}};
  const double box[2][3] = {{c[0], c[1], c[2]}, {0.5 * size[0], 0.5 * size[1], 0.5 * size[2]}};
  const double ends[2][3] = {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}};
  shape.form = FORMS[o->form];
  shape.radius = has_radius(o) ? o->radius : 0.0;
  shape.color = o->color;
  shape.triangles = o->triangles;
  shape.triangle_count = o->triangle_count;
  switch (o->form) {
  case BAUM_OUTLINE_CIRCLE: baum_i_draw(drawing, shape, 2, round); break;
  case BAUM_OUTLINE_SPHERE: baum_i_draw(drawing, shape, 1, round); break;
  case BAUM_OUTLINE_BOX: baum_i_draw(drawing, shape, 2, box); break;
  case BAUM_OUTLINE_CYLINDER: baum_i_draw(drawing, shape, 2, ends); break;
  case BAUM_OUTLINE_POLYGON:
  case BAUM_OUTLINE_MESH:
  default: baum_i_draw(drawing, shape, o->point_count, baum_i_mutable(o->points));
  }
}

void baum_i_draw_outlines(baum_i_drawing *drawing, int body)
{
  const baum_i_body *owner = drawing->mechanism->bodies[body];
  const baum_i_style style = body == 0 ? BAUM_I_BASE : BAUM_I_BODY;
  const baum_i_shape shape = baum_i_shape_of(style, BAUM_I_AREA, &owner->element, body, body, 0.0);
  for (int k = 0; k < owner->outline_count; k++) {
    draw_outline(drawing, shape, &owner->outlines[k]);
  }
}
