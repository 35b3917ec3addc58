/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds outlines of bodies from the points of their joints. Links are drawn as rounded bars and
 * polygons, sliders as blocks, and wheels as discs. If a body is neither a slider nor a wheel and
 * has fewer than two points of joints, a shape at its centre of mass shows its inertia. In the
 * plane, this shape is a disc of the same inertia. In space, it is a box or cylinder with the same
 * moments of inertia about the axes of the body.
 */
#include <string.h>

#include <baum/spatial.h>

#include "base/alloc.h"
#include "draw/drawing.h"
#include "mechanism/kinds.h"

/* Lengths in drawing units. LEAST and MOST are the limits for the radius of discs that show
 * inertia. 2 MOST is the limit for half the edges of boxes, for half the length of cylinders, and
 * for the radius of cylinders. BLOCK contains half the lengths of the edges of a slider's block. */
static const double LEAST = 1.5, MOST = 8.0;
static const double BLOCK[2] = {2.6, 1.5};

typedef struct outline {
  baum_i_drawing *drawing;
  int body;
  const baum_i_element *element;
  int count;
  double (*points)[3]; /* (count) points of joints, without repetition */
} outline;

static void draw(const outline *o, baum_i_style style, baum_i_form form, double radius, int count,
                 const double (*points)[3])
{
  const baum_i_shape shape = baum_i_shape_of(style, form, o->element, o->body, o->body, radius);
  baum_i_draw(o->drawing, shape, count, points);
}

static double distance(const double a[3], const double b[3])
{
  const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  return sqrt(baum_i_dot3(d, d));
}

static void add_point(outline *o, const double point[3])
{
  for (int k = 0; k < o->count; k++) {
    if (distance(o->points[k], point) < 0.2 * o->drawing->unit) {
      return;
    }
  }
  memcpy(o->points[o->count++], point, 3 * sizeof *point);
}

/* Tells whether the point of a joint belongs to the outline of a body. The point on body_a of a
 * sliding joint does not, because it may be anywhere on the axis and would make the outline too
 * long. */
static bool is_point_on(const baum_i_place *place, int side)
{
  return side == 1 || !baum_i_has_field(place->element, "axis") ||
         baum_i_has_field(place->element, "axis_b");
}

static void add_points(outline *o)
{
  int count;
  const baum_i_place_end *ends = baum_i_ends_of(o->drawing, o->body, &count);
  for (int k = 0; k < count; k++) {
    const baum_i_place *place = &o->drawing->places[ends[k].place];
    const int side = ends[k].side;
    const baum_i_definition *kind = place->element->definition;
    bool curve = kind == baum_i_planar_curve_definition || kind == baum_i_spatial_curve_definition;
    if (is_point_on(place, side) && !(side == 0 && curve)) {
      add_point(o, place->point[side]);
    }
  }
}

/* ---- the plane ---- */

static double cross2(const double o[3], const double a[3], const double b[3])
{
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

static void swap3(double a[3], double b[3])
{
  double kept[3];
  memcpy(kept, a, sizeof kept);
  memcpy(a, b, sizeof kept);
  memcpy(b, kept, sizeof kept);
}

/* Finds the next corner of the hull among the points `first` to n - 1. All other points are on the
 * left of the line from `here` to this corner. If several points are on this line, the farthest is
 * the corner. */
static int find_rightmost(const double here[3], int first, int n, const double (*x)[3])
{
  int found = first;
  for (int k = first + 1; k < n; k++) {
    double turn = cross2(here, x[found], x[k]);
    bool further = turn == 0.0 && distance(here, x[k]) > distance(here, x[found]);
    found = turn < 0.0 || further ? k : found;
  }
  return found;
}

/* Moves the corners of the convex hull to the front of the list, in counter-clockwise order.
 * Returns the number of corners. The method is gift wrapping (Jarvis 1973). */
static int find_hull(int n, double (*x)[3])
{
  for (int k = 1; k < n; k++) {
    if (x[k][0] < x[0][0] || (x[k][0] == x[0][0] && x[k][1] < x[0][1])) {
      swap3(x[k], x[0]);
    }
  }
  for (int hull = 1; hull < n; hull++) {
    int next = find_rightmost(x[hull - 1], hull, n, (const double(*)[3])x);
    if (hull > 1 && cross2(x[hull - 1], x[next], x[0]) <= 0.0) {
      return hull;
    }
    if (next != hull) {
      swap3(x[next], x[hull]);
    }
  }
  return n;
}

/* Returns the radius of a disc with the mass and inertia of the body, limited to LEAST and MOST. */
static double inertia_radius(const outline *o)
{
  double mass = baum_i_find_number(o->element, "mass");
  double radius = sqrt(2.0 * baum_i_find_number(o->element, "inertia") / mass);
  return fmin(fmax(radius, LEAST * o->drawing->unit), MOST * o->drawing->unit);
}

/* Draws the block of a slider. Returns false if the body is not a slider. */
static bool draw_block(const outline *o)
{
  const double u = o->drawing->unit;
  bool found = false;
  int count;
  const baum_i_place_end *ends = baum_i_ends_of(o->drawing, o->body, &count);
  for (int k = 0; k < count; k++) {
    const baum_i_place *place = &o->drawing->places[ends[k].place];
    if (ends[k].side == 0 || place->element->definition != baum_i_planar_translational_definition) {
      continue;
    }
    const double *at = place->point[1], *along = place->axis[1];
    double corners[4][3];
    for (int i = 0; i < 4; i++) {
      double x = (i == 0 || i == 3 ? -BLOCK[0] : BLOCK[0]) * u, y = (i < 2 ? -1 : 1) * BLOCK[1] * u;
      corners[i][0] = at[0] + x * along[0] - y * along[1];
      corners[i][1] = at[1] + x * along[1] + y * along[0];
      corners[i][2] = 0.0;
    }
    draw(o, BAUM_I_BODY, BAUM_I_AREA, 0.3 * u, 4, (const double(*)[3])corners);
    found = true;
  }
  return found;
}

/* Draws a disc about a point, with a radial line that shows its rotation. */
static void draw_disc(const outline *o, const double centre[3], double radius)
{
  const double disc[2][3] = {{centre[0], centre[1], 0.0}, {0.0, 0.0, 1.0}};
  const double mark[2][3] = {{centre[0], centre[1], 0.0}, {centre[0] + radius, centre[1], 0.0}};
  draw(o, BAUM_I_WHEEL, BAUM_I_DISC, radius, 2, disc);
  draw(o, BAUM_I_MARK, BAUM_I_LINE, 0.0, 2, mark);
}

static void draw_planar(outline *o)
{
  static const double origin[3] = {0.0, 0.0, 0.0};
  const double u = o->drawing->unit;
  double centre[3];
  double wheel = baum_i_wheel_radius(o->drawing, o->body, centre);
  if (wheel > 0.0) {
    draw_disc(o, centre, wheel);
  }
  bool block = draw_block(o);
  if (o->count == 1 && !block && wheel == 0.0) {
    double arm = distance(o->points[0], origin);
    double radius = inertia_radius(o);
    radius = arm < u ? radius : fmin(radius, fmax(arm / 3.0, LEAST * u));
    draw_disc(o, origin, radius);
    add_point(o, origin);
  } else if (o->count == 0 && !block && wheel == 0.0) {
    draw_disc(o, origin, inertia_radius(o));
  }
  int hull = o->count > 1 ? find_hull(o->count, o->points) : 0;
  if (hull > 1) {
    draw(o, BAUM_I_BODY, hull > 2 ? BAUM_I_AREA : BAUM_I_LINE, u, hull,
         (const double(*)[3])o->points);
  }
}

/* ---- space ---- */

/* Draws a box with the same moments of inertia as the body. A box with edges 2 e_x, 2 e_y and 2 e_z
 * has I_xx = m (e_y^2 + e_z^2) / 3, and so on. */
static void draw_box(const outline *o)
{
  const double u = o->drawing->unit;
  const baum_spatial_body_def *def = o->element->def;
  double sum = def->inertia[0] + def->inertia[1] + def->inertia[2];
  double box[2][3] = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  for (int i = 0; i < 3; i++) {
    double square = 1.5 * (sum - 2.0 * def->inertia[i]) / def->mass;
    box[1][i] = fmin(fmax(sqrt(fmax(square, 0.0)), 0.5 * u), 2.0 * MOST * u);
  }
  draw(o, BAUM_I_BODY, BAUM_I_BOX, 0.0, 2, (const double(*)[3])box);
}

/* Returns the index of the body axis about which the inertia is symmetric. Returns -1 if there is
 * no such axis, or if all three moments are equal. */
static int find_symmetry(const double inertia[6])
{
  const double least = 1e-6 * (inertia[0] + inertia[1] + inertia[2]);
  const bool diagonal = fabs(inertia[3]) + fabs(inertia[4]) + fabs(inertia[5]) < least;
  for (int i = 0; diagonal && i < 3; i++) {
    const double next = inertia[(i + 1) % 3], last = inertia[(i + 2) % 3];
    if (fabs(next - last) < least && fabs(inertia[i] - next) > least) {
      return i;
    }
  }
  return -1;
}

/* Draws a cylinder with the same moments of inertia as the body. A cylinder of radius r and length
 * 2 e has I = m r^2 / 2 about its axis, and I = m (r^2 / 4 + e^2 / 3) about the other axes. */
static void draw_cylinder(const outline *o, int axis)
{
  const double least = 0.5 * o->drawing->unit, most = 2.0 * MOST * o->drawing->unit;
  const baum_spatial_body_def *def = o->element->def;
  const double about = def->inertia[axis] / def->mass;
  const double across = def->inertia[(axis + 1) % 3] / def->mass;
  double ends[2][3] = {{0.0}};
  ends[1][axis] = fmin(fmax(sqrt(fmax(3.0 * across - 1.5 * about, 0.0)), least), most);
  ends[0][axis] = -ends[1][axis];
  const double radius = fmin(fmax(sqrt(2.0 * about), least), most);
  draw(o, BAUM_I_BODY, BAUM_I_CYLINDER, radius, 2, (const double(*)[3])ends);
  /* A line across both ends and along the side shows the rotation. */
  double mark[4][3] = {{0.0}};
  for (int k = 0; k < 4; k++) {
    mark[k][axis] = ends[k / 2][axis];
    mark[k][(axis + 1) % 3] = k == 1 || k == 2 ? radius : 0.0;
  }
  draw(o, BAUM_I_MARK, BAUM_I_LINE, 0.0, 4, (const double(*)[3])mark);
}

static void draw_spatial(const outline *o)
{
  static const double origin[3] = {0.0, 0.0, 0.0};
  const double u = o->drawing->unit;
  if (o->count < 2 && o->element->definition == baum_i_spatial_body_definition) {
    const baum_spatial_body_def *def = o->element->def;
    const int axis = find_symmetry(def->inertia);
    if (axis >= 0) {
      draw_cylinder(o, axis);
    } else {
      draw_box(o);
    }
  }
  if (o->count == 2) { /* one bent bar through the centre of mass */
    const double bar[3][3] = {{o->points[0][0], o->points[0][1], o->points[0][2]},
                              {0.0, 0.0, 0.0},
                              {o->points[1][0], o->points[1][1], o->points[1][2]}};
    draw(o, BAUM_I_BODY, BAUM_I_LINE, 0.7 * u, 3, bar);
    return;
  }
  for (int k = 0; k < o->count; k++) {
    double rod[2][3] = {{0.0}};
    memcpy(rod[1], o->points[k], sizeof rod[1]);
    if (distance(origin, rod[1]) > u) {
      draw(o, BAUM_I_BODY, BAUM_I_LINE, 0.7 * u, 2, (const double(*)[3])rod);
    }
  }
}

/* ---- any body ---- */

void baum_i_draw_body(baum_i_drawing *drawing, int body)
{
  const double origin[1][3] = {{0.0, 0.0, 0.0}};
  const baum_i_body *drawn = drawing->mechanism->bodies[body];
  baum_i_frame_kind kind = baum_i_frame_of(drawn);
  outline o = {drawing, body, &drawn->element, 0, NULL};
  if (drawn->outline_count > 0) {
    baum_i_draw_outlines(drawing, body);
    return;
  }
  if (kind == BAUM_I_FRAME_NONE || kind == BAUM_I_FRAME_GROUND) {
    return;
  }
  if (kind == BAUM_I_FRAME_PARTICLE || kind == BAUM_I_FRAME_SPATIAL_PARTICLE) {
    draw(&o, BAUM_I_BODY, BAUM_I_BALL, 1.3 * drawing->unit, 1, origin);
    return;
  }
  int ends;
  (void)baum_i_ends_of(drawing, body, &ends);
  o.points = baum_i_alloc((size_t)ends + 1, sizeof *o.points);
  if (!o.points) {
    drawing->failed = true;
    return;
  }
  add_points(&o);
  if (drawing->spatial && kind == BAUM_I_FRAME_SPATIAL_BODY) {
    draw_spatial(&o);
  } else {
    draw_planar(&o);
  }
  baum_i_free(o.points);
}
