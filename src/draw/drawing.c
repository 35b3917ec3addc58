/* SPDX-License-Identifier: BSD-3-Clause */
/* Makes the list of shapes that show a mechanism. */
#include "draw/drawing.h"

#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"

/* Two limits for the unit of length of a drawing. The unit is at most SHARE times the largest
 * extent of the mechanism, and at most LINK_SHARE times the mean distance of joints from the
 * centres of mass of their bodies. The second limit matters for mechanisms of many bodies. */
static const double SHARE = 0.02, LINK_SHARE = 0.125;

const char *baum_i_style_name(baum_i_style style)
{
#define NAME(CODE, NAME) [BAUM_I_##CODE] = #NAME,
  static const char *const names[] = {BAUM_I_STYLES(NAME)};
#undef NAME
  return names[style];
}

const char *baum_i_form_name(baum_i_form form)
{
  static const char *const names[] = {"line",  "area",     "disc",     "ball",
                                      "box",   "cylinder", "mesh",     "between",
                                      "arrow", "to line",  "to plane", "to sphere"};
  return names[form];
}

void baum_i_draw(baum_i_drawing *drawing, baum_i_shape shape, int count, const double (*points)[3])
{
  const int wanted = drawing->point_count + count;
  double(*grown)[3] = baum_i_grow(drawing->points, (size_t)wanted, sizeof *grown);
  drawing->points = grown ? grown : drawing->points;
  baum_i_shape *shapes =
    baum_i_grow_by_one(drawing->shapes, (size_t)drawing->shape_count + 1, sizeof *shapes);
  drawing->shapes = shapes ? shapes : drawing->shapes;
  if (!grown || !shapes) {
    drawing->failed = true;
    return;
  }
  shape.first = drawing->point_count;
  shape.count = count;
  memcpy(grown + shape.first, points, (size_t)count * sizeof *points);
  drawing->point_count = wanted;
  shapes[drawing->shape_count++] = shape;
}

/* Sorts shapes by style, and wheels also by radius, larger ones first. All other shapes of one
 * style keep the order in which they were added, which is the order of their points in memory. */
static int compare(const void *a, const void *b)
{
  const baum_i_shape *x = a, *y = b;
  if (x->style != y->style) {
    return x->style < y->style ? -1 : 1;
  }
  if (x->style == BAUM_I_WHEEL && x->radius != y->radius) {
    return x->radius > y->radius ? -1 : 1;
  }
  return x->first - y->first;
}

/* ---- the whole drawing ---- */

baum_i_spatial_frame baum_i_drawing_frame(const baum_i_body *body, const double *q)
{
  baum_i_frame_kind kind = baum_i_frame_of(body);
  double own[7] = {0.0};
  if (kind != BAUM_I_FRAME_NONE && kind != BAUM_I_FRAME_GROUND) {
    memcpy(own, q + body->q, (size_t)body->nq * sizeof *own);
  }
  if (kind == BAUM_I_FRAME_SPATIAL_BODY) {
    baum_i_quaternion_normalize(own + 3);
  }
  return baum_i_spatial_frame_at(kind, own, NULL);
}

static bool is_spatial(const baum_mechanism *m)
{
  bool found = false;
  for (int k = 1; k <= m->body_count; k++) {
    found = found || baum_i_is_spatial(baum_i_frame_of(m->bodies[k]));
  }
  for (int k = 0; k < m->joint_count; k++) {
    found = found || m->joints[k]->type->width == BAUM_I_SPACE;
  }
  for (int k = 0; k < m->force_count; k++) {
    found = found || m->forces[k]->type->spatial;
  }
  return found;
}

static void include(const baum_i_drawing *drawing, int body, const double point[3], baum_i_box *box)
{
  double at[3];
  baum_i_draw_move(drawing, body, 0, point, at);
  baum_i_box_include(box, at[0], at[1], at[2]);
}

/* Returns the largest edge of a box. The result is negative if the box contains nothing. */
static double largest_edge(const baum_i_box *box)
{
  double edge = -INFINITY;
  for (int i = 0; i < 3; i++) {
    edge = fmax(edge, box->high[i] - box->low[i]);
  }
  return edge;
}

/* Returns the mean distance of joints from the centres of mass of their bodies. Distances below
 * `least` are ignored. Returns infinity if there are no larger distances. */
static double mean_distance(const baum_i_drawing *drawing, double least)
{
  double sum = 0.0;
  int count = 0;
  for (int k = 0; k < 2 * drawing->place_count; k++) {
    const baum_i_place *place = &drawing->places[k / 2];
    const double *point = place->point[k % 2];
    double distance =
      place->element && place->body[k % 2] > 0 ? sqrt(baum_i_dot3(point, point)) : 0.0;
    sum += distance > least ? distance : 0.0;
    count += distance > least;
  }
  return count > 0 ? sum / count : (double)INFINITY;
}

static double find_unit(const baum_i_drawing *drawing)
{
  const double origin[3] = {0.0, 0.0, 0.0};
  baum_i_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (int k = 1; k <= drawing->mechanism->body_count; k++) {
    if (baum_i_frame_of(drawing->mechanism->bodies[k]) != BAUM_I_FRAME_NONE) {
      include(drawing, k, origin, &box);
    }
  }
  for (int k = 0; k < drawing->place_count; k++) {
    const baum_i_place *place = &drawing->places[k];
    for (int side = 0; place->element && side < 2; side++) {
      include(drawing, place->body[side], place->point[side], &box);
    }
  }
  double extent = largest_edge(&box);
  if (extent <= 0.0) { /* all elements are at one point: extend the box to the origin */
    include(drawing, 0, origin, &box);
    extent = largest_edge(&box);
  }
  if (extent <= 0.0) {
    return SHARE;
  }
  return fmin(SHARE * extent, LINK_SHARE * mean_distance(drawing, 1e-6 * extent));
}

baum_status baum_i_drawing_create(const baum_mechanism *m, const baum_i_samples *motion,
                                  baum_i_drawing *out)
{
  *out = (baum_i_drawing){.mechanism = m, .motion = *motion, .spatial = is_spatial(m)};
  out->place_count = m->joint_count + m->force_count;
  out->design = baum_i_alloc((size_t)m->body_count + 1, sizeof *out->design);
  out->places = baum_i_alloc((size_t)out->place_count, sizeof *out->places);
  out->ends = baum_i_alloc(2 * (size_t)out->place_count, sizeof *out->ends);
  out->first_end = baum_i_alloc((size_t)m->body_count + 2, sizeof *out->first_end);
  out->gears = baum_i_alloc((size_t)m->joint_count, sizeof *out->gears);
  if (!out->design || !out->places || !out->ends || !out->first_end || !out->gears) {
    return baum_i_fail_memory();
  }
  for (int k = 0; k <= m->body_count; k++) {
    out->design[k] = baum_i_spatial_design_frame(m, k);
  }
  baum_i_find_places(out);
  out->unit = find_unit(out);
  for (int k = 0; k <= m->body_count; k++) {
    baum_i_draw_body(out, k);
  }
  for (int k = 0; k < out->place_count; k++) {
    baum_i_draw_symbol(out, k);
  }
  if (out->shapes) {
    qsort(out->shapes, (size_t)out->shape_count, sizeof *out->shapes, compare);
  }
  return out->failed ? baum_i_fail_memory() : BAUM_OK;
}

void baum_i_drawing_release(baum_i_drawing *drawing)
{
  baum_i_free(drawing->design);
  baum_i_free(drawing->places);
  baum_i_free(drawing->ends);
  baum_i_free(drawing->first_end);
  baum_i_free(drawing->gears);
  baum_i_free(drawing->shapes);
  baum_i_free(drawing->points);
}

/* ---- JSON ---- */

static void put_bodies(const baum_mechanism *m, baum_i_buffer *out)
{
  static const char *const kinds[] = {"none",   "particle",         "body",
                                      "ground", "spatial particle", "spatial body"};
  for (int k = 0; k <= m->body_count; k++) {
    baum_i_put(out, k ? ",\n{\"name\":\"" : "\n{\"name\":\"");
    baum_i_put_user_text(out, k ? m->bodies[k]->element.name : "ground", BAUM_I_JSON);
    baum_i_putf(out, "\",\"kind\":\"%s\",\"q\":%d}", kinds[baum_i_frame_of(m->bodies[k])],
                m->bodies[k]->q);
  }
}

static void put_points(const baum_i_drawing *drawing, const baum_i_shape *shape, baum_i_buffer *out)
{
  baum_i_put(out, ",\"points\":[");
  for (int i = 0; i < shape->count; i++) {
    const double *x = drawing->points[shape->first + i];
    baum_i_putf(out, "%s[%.6g,%.6g,%.6g]", i ? "," : "", x[0], x[1], x[2]);
  }
  baum_i_put(out, "]");
}

static void put_triangles(const baum_i_shape *shape, baum_i_buffer *out)
{
  for (int k = 0; k < shape->triangle_count; k++) {
    const int32_t *corner = shape->triangles + 3 * (size_t)k;
    baum_i_putf(out, "%s%d,%d,%d", k ? "," : ",\"triangles\":[", (int)corner[0], (int)corner[1],
                (int)corner[2]);
  }
  baum_i_put(out, shape->triangle_count > 0 ? "]" : "");
}

void baum_i_put_drawing(const baum_i_drawing *drawing, baum_i_buffer *out)
{
  baum_i_putf(out, "{\"version\":1,\"spatial\":%s,\"unit\":%.6g,\"gravity\":[%.6g,%.6g,%.6g]",
              drawing->spatial ? "true" : "false", drawing->unit, drawing->mechanism->gravity[0],
              drawing->mechanism->gravity[1], drawing->mechanism->gravity[2]);
  baum_i_put(out, ",\"bodies\":[");
  put_bodies(drawing->mechanism, out);
  baum_i_put(out, "],\n\"shapes\":[");
  for (int k = 0; k < drawing->shape_count; k++) {
    const baum_i_shape *shape = &drawing->shapes[k];
    baum_i_putf(out, "%s\n{\"style\":\"%s\",\"form\":\"%s\",\"body\":%d,\"other\":%d,",
                k ? "," : "", baum_i_style_name(shape->style), baum_i_form_name(shape->form),
                shape->body, shape->other);
    baum_i_put(out, "\"element\":\"");
    baum_i_put_user_text(out, shape->element->name, BAUM_I_JSON);
    baum_i_putf(out, "\",\"radius\":%.5g", shape->radius);
    if (shape->color) {
      baum_i_putf(out, ",\"color\":\"%s\"", shape->color);
    }
    put_points(drawing, shape, out);
    put_triangles(shape, out);
    baum_i_put(out, "}");
  }
  baum_i_put(out, "]}");
}
