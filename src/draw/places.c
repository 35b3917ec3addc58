/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the places of joints and forces, from the fields that their definitions have in common. */
#include <string.h>

#include "draw/drawing.h"
#include "mechanism/identify.h"
#include "mechanism/kinds.h"

/* Finds the value of a field in a definition. Returns NULL if the definition has no such field. */
static const void *find_field(const baum_i_element *element, const char *name, size_t *size)
{
  *size = 0;
  for (const baum_i_def_field *field = element->definition->fields; field->name; field++) {
    if (strcmp(field->name, name) == 0) {
      *size = field->size;
      return baum_i_field_at(field, element->def);
    }
  }
  return NULL;
}

bool baum_i_has_field(const baum_i_element *element, const char *name)
{
  size_t size;
  return find_field(element, name, &size) != NULL;
}

double baum_i_find_number(const baum_i_element *element, const char *name)
{
  size_t size;
  const double *number = find_field(element, name, &size);
  return number ? *number : 0.0;
}

static int find_body(const baum_i_drawing *drawing, const baum_i_element *element, const char *name)
{
  size_t size;
  const baum_body_id *id = find_field(element, name, &size);
  return id ? baum_i_body_index(drawing->mechanism, *id) : -1;
}

/* ---- axes ---- */

void baum_i_draw_turn(const baum_i_drawing *drawing, int from, int to, const double x[3],
                      double out[3])
{
  double ground[3];
  baum_i_turn(drawing->design[from].axes, x, ground);
  baum_i_turn_back(drawing->design[to].axes, ground, out);
}

void baum_i_draw_move(const baum_i_drawing *drawing, int from, int to, const double point[3],
                      double out[3])
{
  double ground[3];
  baum_i_turn(drawing->design[from].axes, point, ground);
  baum_i_add_scaled3(1.0, drawing->design[from].r, ground);
  baum_i_add_scaled3(-1.0, drawing->design[to].r, ground);
  baum_i_turn_back(drawing->design[to].axes, ground, out);
}

static void normalize(double x[3])
{
  double length = sqrt(baum_i_dot3(x, x));
  for (int i = 0; i < 3; i++) {
    x[i] /= length;
  }
}

/* Sets the axes of an element from its fields axis, axis_b and angle. If the definition gives
 * `point`, it gives both axes in ground axes. Otherwise `axis` is in the axes of body_a, and
 * `axis_b` is in the axes of body_b. */
static void set_axes(const baum_i_drawing *drawing, bool planar, bool in_ground,
                     baum_i_place *place)
{
  size_t size;
  double *const axis = place->axis[0];
  double *const axis_b = place->axis[1];
  const double *given = find_field(place->element, "axis", &size);
  axis[2] = planar && given ? 0.0 : 1.0;
  if (given) {
    memcpy(axis, given, size);
  }
  if (in_ground) {
    const double ground[3] = {axis[0], axis[1], axis[2]};
    baum_i_turn_back(drawing->design[place->body[0]].axes, ground, axis);
  }
  baum_i_draw_turn(drawing, place->body[0], place->body[1], axis, axis_b);
  given = find_field(place->element, "angle", &size);
  if (given && !isnan(*given)) { /* a planar guide with a prescribed relative orientation */
    axis_b[0] = cos(*given) * axis[0] + sin(*given) * axis[1];
    axis_b[1] = cos(*given) * axis[1] - sin(*given) * axis[0];
  }
  given = find_field(place->element, "axis_b", &size);
  if (given && !isnan(*given)) {
    memcpy(axis_b, given, size);
    if (in_ground) {
      baum_i_turn_back(drawing->design[place->body[1]].axes, given, axis_b);
    }
  }
  normalize(axis);
  normalize(axis_b);
}

/* ---- places ---- */

static bool is_particle(const baum_i_drawing *drawing, int body)
{
  const baum_i_frame_kind kind = baum_i_frame_of(drawing->mechanism->bodies[body]);
  return kind == BAUM_I_FRAME_PARTICLE || kind == BAUM_I_FRAME_SPATIAL_PARTICLE;
}

/* Sets the points of an element from its fields point, point_a and point_b. If one of the bodies is
 * a particle, `point` is ignored for this body, because the point on it is the particle itself. */
static void set_points(const baum_i_drawing *drawing, const double *point, size_t size,
                       baum_i_place *out)
{
  static const char *const names[2] = {"point_a", "point_b"};
  const bool in_ground = !isnan(point[0]);
  double ground[3] = {0.0};
  memcpy(ground, point, size);
  for (int side = 0; side < 2; side++) {
    size_t same;
    const double *own = find_field(out->element, names[side], &same);
    if (in_ground && !is_particle(drawing, out->body[side])) {
      baum_i_draw_move(drawing, 0, out->body[side], ground, out->point[side]);
    } else if (!in_ground && own && !isnan(own[0])) {
      memcpy(out->point[side], own, size);
    }
  }
  set_axes(drawing, size == 2 * sizeof *point, in_ground, out);
}

/* Sets the place of a load. A load at the centre of mass needs no place. */
static void set_load(const baum_i_element *element, int body, const double *point, size_t size,
                     baum_i_place *out)
{
  out->body[0] = out->body[1] = body;
  memcpy(out->point[0], point, size);
  memcpy(out->point[1], point, size);
  out->element = baum_i_dot3(out->point[0], out->point[0]) > 0.0 ? element : NULL;
}

static void find_place(const baum_i_drawing *drawing, const baum_i_element *element,
                       baum_i_place *out)
{
  size_t size;
  *out = (baum_i_place){.axis = {{0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}}};
  const double *point = find_field(element, "point", &size);
  const int loaded = find_body(drawing, element, "body");
  if (point && loaded >= 0) {
    set_load(element, loaded, point, size, out);
    return;
  }
  out->body[0] = find_body(drawing, element, "body_a");
  out->body[1] = find_body(drawing, element, "body_b");
  if (point && out->body[0] >= 0 && out->body[1] >= 0) {
    out->element = element;
    set_points(drawing, point, size, out);
  }
}

/* Makes the lists of the ends on each body and of the gears. Without these lists, drawing a body
 * would need a search through all elements. */
static void list_ends(baum_i_drawing *drawing)
{
  const baum_mechanism *m = drawing->mechanism;
  int *first = drawing->first_end;
  for (int k = 0; k < m->joint_count; k++) {
    if (m->joints[k]->element.definition == baum_i_planar_gear_definition) {
      drawing->gears[drawing->gear_count++] = k;
    }
  }
  for (int k = 0; k < 2 * drawing->place_count; k++) {
    const baum_i_place *place = &drawing->places[k / 2];
    first[place->body[k % 2] + 1] += place->element != NULL;
  }
  for (int k = 0; k <= m->body_count; k++) {
    first[k + 1] += first[k];
  }
  const int total = first[m->body_count + 1];
  /* Copies each end into the list. Afterwards first[k + 1] is the index of the first end on body
   * k. */
  for (int k = 2 * drawing->place_count - 1; k >= 0; k--) {
    const baum_i_place *place = &drawing->places[k / 2];
    if (place->element) {
      drawing->ends[--first[place->body[k % 2] + 1]] = (baum_i_place_end){k / 2, k % 2};
    }
  }
  memmove(first, first + 1, ((size_t)m->body_count + 1) * sizeof *first);
  first[m->body_count + 1] = total;
}

const baum_i_place_end *baum_i_ends_of(const baum_i_drawing *drawing, int body, int *count)
{
  *count = drawing->first_end[body + 1] - drawing->first_end[body];
  return drawing->ends + drawing->first_end[body];
}

void baum_i_find_places(baum_i_drawing *drawing)
{
  const baum_mechanism *m = drawing->mechanism;
  for (int k = 0; k < drawing->place_count; k++) {
    const baum_i_element *element =
      k < m->joint_count ? &m->joints[k]->element : &m->forces[k - m->joint_count]->element;
    find_place(drawing, element, &drawing->places[k]);
  }
  list_ends(drawing);
}
