/* SPDX-License-Identifier: BSD-3-Clause */
/* Draws a configuration as an SVG picture. The colours are legible on light and on dark
 * backgrounds. Planar mechanisms are seen along the z axis. Spatial mechanisms are shown in a
 * parallel projection, in which nearer shapes cover those behind them. */
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "draw/svg.h"

enum { WIDTH = 640, HEIGHT = 480, COLOURS = 8, COIL = 22 };
static const double MARGIN = 12.0;

typedef baum_i_picture picture;
typedef baum_i_look look;

/* The look of each style. Bodies take their colours from the table COLOUR instead of the fill and
 * stroke in this table. */
static const look LOOKS[BAUM_I_STYLE_COUNT] = {
  [BAUM_I_BASE] = {"", "", 1.3, NULL},
  [BAUM_I_GUIDE] = {"none", "#8a94a0", 1.5, NULL},
  [BAUM_I_GROUND] = {"none", "#78828c", 1.3, NULL},
  [BAUM_I_WHEEL] = {"", "", 1.3, NULL},
  [BAUM_I_BODY] = {"", "", 1.3, NULL},
  [BAUM_I_MARK] = {"none", "#59636e", 1.2, NULL},
  [BAUM_I_PITCH] = {"none", "#59636e", 1.2, "8 3 2 3"},
  [BAUM_I_SLOT] = {"#f4f6f8", "#59636e", 1.3, NULL},
  [BAUM_I_SPRING] = {"none", "#78828c", 1.7, NULL},
  [BAUM_I_DAMPER] = {"none", "#78828c", 1.7, NULL},
  [BAUM_I_ROD] = {"#d5dae0", "#59636e", 1.2, NULL},
  [BAUM_I_JOINT] = {"#f4f6f8", "#3f4750", 1.3, NULL},
  [BAUM_I_COUPLING] = {"none", "#78828c", 1.6, "5 4"},
  [BAUM_I_DRIVER] = {"none", "#0f9d6b", 2.0, NULL},
  [BAUM_I_LOAD] = {"none", "#d9480f", 2.0, NULL},
  [BAUM_I_MOMENT] = {"none", "#8b5cf6", 2.0, NULL},
  [BAUM_I_USER] = {"#a21caf", "none", 0.0, NULL},
  [BAUM_I_GAP] = {"none", "#e11d48", 2.5, NULL},
};

static const char *const COLOUR[COLOURS][2] = {
  {"#a9c9ec", "#2563a8"}, {"#f5c396", "#b4560f"}, {"#a5dcc0", "#0c7a50"}, {"#dcb4e8", "#8d22a3"},
  {"#ead48a", "#86640a"}, {"#a3dbe5", "#0e7188"}, {"#f3b3be", "#b91c43"}, {"#c8ced6", "#4b5563"}};

/* ---- projection ---- */

void baum_i_picture_project(const baum_i_picture *p, int body, const double point[3], double out[3])
{
  double at[3];
  baum_i_to_ground(&p->frames[body], point, at);
  baum_i_turn(p->view, at, out);
}

void baum_i_picture_set_view(baum_i_picture *p)
{
  static const double plane[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  /* [rad] Direction of view: rotation about the vertical, and downward inclination. */
  static const double TURN = -0.9, TILT = 0.45;
  memcpy(p->view, plane, sizeof plane);
  if (!p->drawing->spatial) {
    return;
  }
  const double *g = p->drawing->mechanism->gravity;
  double size = sqrt(baum_i_dot3(g, g));
  double up[3] = {0.0, 0.0, 1.0}, x[3], y[3];
  for (int i = 0; i < 3 && size > 0.0; i++) {
    up[i] = -g[i] / size;
  }
  /* Horizontal vectors x and y, the same as in page.html. */
  const double other[3] = {fabs(up[0]) < 0.9, !(fabs(up[0]) < 0.9), 0.0};
  baum_i_cross(up, other, y);
  double length = sqrt(baum_i_dot3(y, y));
  for (int i = 0; i < 3; i++) {
    y[i] /= length;
  }
  baum_i_cross(y, up, x);
  for (int i = 0; i < 3; i++) {
    double right = cos(TURN) * x[i] + sin(TURN) * y[i];
    double front = sin(TURN) * x[i] - cos(TURN) * y[i];
    p->view[i] = right;
    p->view[3 + i] = cos(TILT) * up[i] - sin(TILT) * front;
    p->view[6 + i] = sin(TILT) * up[i] + cos(TILT) * front;
  }
}

/* ---- shapes ---- */

static const double *point_of(const picture *p, const baum_i_shape *shape, int k)
{
  return p->drawing->points[shape->first + k];
}

/* Finds the two ends of a shape that connects bodies, projected to the picture. Returns its length
 * [m]. */
static double project_ends(const picture *p, const baum_i_shape *shape, double out[2][3])
{
  double at[2][3];
  baum_i_find_ends(p->drawing, p->frames, shape, at[0], at[1]);
  baum_i_turn(p->view, at[0], out[0]);
  baum_i_turn(p->view, at[1], out[1]);
  baum_i_add_scaled3(-1.0, at[0], at[1]);
  return sqrt(baum_i_dot3(at[1], at[1]));
}

static bool connects(const baum_i_shape *shape)
{
  return shape->form == BAUM_I_ARROW || shape->form == BAUM_I_BETWEEN || shape->style == BAUM_I_GAP;
}

/* Tells whether all points of a shape are positions on its body. If this is false, only the first
 * point is a position on the body. */
static bool has_places(const baum_i_shape *shape)
{
  return shape->form == BAUM_I_LINE || shape->form == BAUM_I_AREA ||
         shape->form == BAUM_I_CYLINDER || shape->form == BAUM_I_MESH;
}

/* Returns the depth of a shape [m], which increases towards the eye. For a line that shows a body,
 * it is the depth of the farther end, so that the joints at both ends cover this line. For other
 * shapes it is the mean over their points. Joints are moved one unit towards the eye. */
static double depth_of(const picture *p, const baum_i_shape *shape)
{
  bool bar = shape->form == BAUM_I_LINE && shape->style == BAUM_I_BODY;
  double sum = 0.0, least = INFINITY, at[3];
  int count = has_places(shape) ? shape->count : 1;
  for (int k = 0; k < count; k++) {
    baum_i_picture_project(p, shape->body, point_of(p, shape, k), at);
    sum += at[2];
    least = fmin(least, at[2]);
  }
  return (bar ? least : sum / count) + (shape->style == BAUM_I_JOINT ? p->drawing->unit : 0.0);
}

static void include(const double at[3], double radius, baum_i_box *box)
{
  baum_i_box_include(box, at[0] - radius, at[1] - radius, 0.0);
  baum_i_box_include(box, at[0] + radius, at[1] + radius, 0.0);
}

/* Tells whether a shape is shown. A gap is shown only if it is long enough to be seen. */
static bool is_shown(const picture *p, const baum_i_shape *shape)
{
  double ends[2][3];
  return shape->style != BAUM_I_GAP || project_ends(p, shape, ends) > 0.2 * p->drawing->unit;
}

static void include_box(const picture *p, const baum_i_shape *shape, baum_i_box *box)
{
  const double *centre = point_of(p, shape, 0), *half = point_of(p, shape, 1);
  for (int k = 0; k < 8; k++) {
    double point[3], at[3];
    for (int i = 0; i < 3; i++) {
      point[i] = centre[i] + (k >> i & 1 ? half[i] : -half[i]);
    }
    baum_i_picture_project(p, shape->body, point, at);
    include(at, 0.0, box);
  }
}

static void include_shape(const picture *p, const baum_i_shape *shape, baum_i_box *box)
{
  double at[3];
  if (shape->form == BAUM_I_BOX) {
    include_box(p, shape, box);
    return;
  }
  if (connects(shape)) {
    double ends[2][3];
    (void)project_ends(p, shape, ends);
    include(ends[0], shape->radius, box);
    include(ends[1], shape->radius, box);
    return;
  }
  for (int k = 0; k < (has_places(shape) ? shape->count : 1); k++) {
    baum_i_picture_project(p, shape->body, point_of(p, shape, k), at);
    include(at, shape->radius, box);
  }
}

/* ---- SVG ---- */

static void put_number(const picture *p, double x)
{
  baum_i_putf(p->out, "%.1f", x);
}

void baum_i_picture_put_point(const baum_i_picture *p, const char *word, const double at[3])
{
  baum_i_put(p->out, word);
  put_number(p, (at[0] - p->left) * p->scale);
  baum_i_put(p->out, " ");
  put_number(p, (p->top - at[1]) * p->scale);
}

look baum_i_picture_look(const baum_i_shape *shape)
{
  look found = LOOKS[shape->style];
  if (shape->color) {
    memcpy(found.fill, shape->color, sizeof found.fill);
    baum_i_shade(found.fill, 0.55, found.stroke);
  } else if (!*found.fill) {
    const char *const *colour = COLOUR[(shape->body + COLOURS - 1) % COLOURS];
    memcpy(found.fill, colour[0], sizeof found.fill);
    memcpy(found.stroke, colour[1], sizeof found.stroke);
  }
  return found;
}

static void put_attributes(const picture *p, const char *fill, const char *stroke, double width,
                           const char *dash)
{
  baum_i_putf(p->out, " fill=\"%s\" stroke=\"%s\" stroke-width=\"%.1f\"", fill, stroke, width);
  if (dash) {
    baum_i_putf(p->out, " stroke-dasharray=\"%s\"", dash);
  }
  baum_i_put(p->out, "/>");
}

static void put_path(const picture *p, int count, const double (*at)[3], bool closed)
{
  baum_i_put(p->out, "<path d=\"");
  for (int k = 0; k < count; k++) {
    baum_i_picture_put_point(p, k ? "L" : "M", at[k]);
  }
  baum_i_put(p->out, closed ? "Z\"" : "\"");
}

/* Draws a line. If the shape has a radius, a wide line in the colour of the edge is drawn first,
 * and then a narrower line in the colour of the fill on top of it. */
static void put_line(const picture *p, const baum_i_shape *shape, int count, const double (*at)[3],
                     bool closed)
{
  const look l = baum_i_picture_look(shape);
  double wide = 2.0 * shape->radius * p->scale;
  put_path(p, count, at, closed);
  if (wide <= 2.0 * l.width || strcmp(l.fill, "none") == 0) {
    put_attributes(p, closed ? l.fill : "none", l.stroke, fmax(wide, l.width), l.dash);
    return;
  }
  put_attributes(p, closed ? l.stroke : "none", l.stroke, wide, NULL);
  put_path(p, count, at, closed);
  put_attributes(p, closed ? l.fill : "none", l.fill, wide - 2.0 * l.width, NULL);
}

void baum_i_picture_put_area(const picture *p, const look *l, int count, const double (*at)[3])
{
  put_path(p, count, at, true);
  put_attributes(p, l->fill, l->stroke, l->width, l->dash);
}

static void put_circle(const picture *p, const baum_i_shape *shape, const double at[3])
{
  const look l = baum_i_picture_look(shape);
  baum_i_put(p->out, "<circle cx=\"");
  put_number(p, (at[0] - p->left) * p->scale);
  baum_i_put(p->out, "\" cy=\"");
  put_number(p, (p->top - at[1]) * p->scale);
  baum_i_putf(p->out, "\" r=\"%.1f\"", fmax(shape->radius * p->scale, 1.0));
  put_attributes(p, l.fill, l.stroke, l.width, l.dash);
}

/* Draws the face of a box that is normal to one axis, if this face points towards the eye. */
static void put_face(const picture *p, const baum_i_shape *shape, int axis, double sign)
{
  const double *centre = point_of(p, shape, 0), *half = point_of(p, shape, 1);
  double normal[3] = {0.0, 0.0, 0.0}, turned[3], towards[3];
  normal[axis] = sign;
  baum_i_turn(p->frames[shape->body].axes, normal, turned);
  baum_i_turn(p->view, turned, towards);
  if (towards[2] <= 0.0) {
    return;
  }
  double corners[4][3];
  for (int k = 0; k < 4; k++) {
    double point[3];
    memcpy(point, centre, sizeof point);
    point[axis] += sign * half[axis];
    point[(axis + 1) % 3] += (k == 0 || k == 3 ? -1.0 : 1.0) * half[(axis + 1) % 3];
    point[(axis + 2) % 3] += (k < 2 ? -1.0 : 1.0) * half[(axis + 2) % 3];
    baum_i_picture_project(p, shape->body, point, corners[k]);
  }
  const look l = baum_i_picture_look(shape);
  baum_i_picture_put_area(p, &l, 4, (const double(*)[3])corners);
}

static void put_disc(const picture *p, const baum_i_shape *shape)
{
  double at[BAUM_I_CIRCLE][3], x[3], y[3];
  if (!p->drawing->spatial) {
    baum_i_picture_project(p, shape->body, point_of(p, shape, 0), at[0]);
    put_circle(p, shape, at[0]);
    return;
  }
  baum_i_complete_axes(point_of(p, shape, 1), x, y);
  for (int k = 0; k < BAUM_I_CIRCLE; k++) {
    double angle = BAUM_I_REVOLUTION * k / BAUM_I_CIRCLE, point[3];
    memcpy(point, point_of(p, shape, 0), sizeof point);
    baum_i_add_scaled3(shape->radius * cos(angle), x, point);
    baum_i_add_scaled3(shape->radius * sin(angle), y, point);
    baum_i_picture_project(p, shape->body, point, at[k]);
  }
  const look l = baum_i_picture_look(shape);
  baum_i_picture_put_area(p, &l, BAUM_I_CIRCLE, (const double(*)[3])at);
}

/* Draws a line along the connection between two ends, for example a coil. Each row of xy is a point
 * of this line. x is the position along the connection, as a fraction of its length, and y is the
 * distance from the connection, in radii of the shape. If the shape has a third point, the y of
 * this point shifts the line to the left, except at its two ends. */
static void put_along(const picture *p, const baum_i_shape *shape, const double (*ends)[3],
                      int count, const double (*xy)[2])
{
  double at[COIL][3];
  const double d[2] = {ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]};
  const double length = hypot(d[0], d[1]);
  const double shift = shape->count > 2 ? point_of(p, shape, 2)[1] : 0.0;
  for (int k = 0; k < count; k++) {
    bool inner = xy[k][0] > 0.0 && xy[k][0] < 1.0;
    double across = (shape->radius * xy[k][1] + (inner ? shift : 0.0)) / length;
    at[k][0] = ends[0][0] + xy[k][0] * d[0] - across * d[1];
    at[k][1] = ends[0][1] + xy[k][0] * d[1] + across * d[0];
  }
  baum_i_shape thin = *shape;
  thin.radius = 0.0;
  put_line(p, &thin, count, (const double(*)[3])at, false);
}

static void put_coil(const picture *p, const baum_i_shape *shape, const double (*ends)[3])
{
  double xy[COIL][2];
  for (int k = 0; k < COIL; k++) {
    xy[k][0] = 0.15 + 0.7 * (k - 1) / (COIL - 3);
    xy[k][1] = k < 2 || k > COIL - 3 ? 0.0 : k % 2 ? -1.0 : 1.0;
  }
  xy[0][0] = 0.0;
  xy[COIL - 1][0] = 1.0;
  put_along(p, shape, ends, COIL, (const double(*)[2])xy);
}

static void put_damper(const picture *p, const baum_i_shape *shape, const double (*ends)[3])
{
  static const double rod[3][2] = {{0.0, 0.0}, {0.15, 0.0}, {0.3, 0.0}};
  static const double cylinder[4][2] = {{0.7, -1.0}, {0.3, -1.0}, {0.3, 1.0}, {0.7, 1.0}};
  static const double piston[5][2] = {{1.0, 0.0}, {0.85, 0.0}, {0.5, 0.0}, {0.5, -0.8}, {0.5, 0.8}};
  put_along(p, shape, ends, 3, rod);
  put_along(p, shape, ends, 4, cylinder);
  put_along(p, shape, ends, 5, piston);
}

static void put_between(const picture *p, const baum_i_shape *shape)
{
  double ends[2][3];
  (void)project_ends(p, shape, ends);
  double seen = hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
  if (seen > 0.0 && shape->style == BAUM_I_SPRING) {
    put_coil(p, shape, (const double(*)[3])ends);
  } else if (seen > 0.0 && shape->style == BAUM_I_DAMPER) {
    put_damper(p, shape, (const double(*)[3])ends);
  } else {
    put_line(p, shape, 2, (const double(*)[3])ends, false);
  }
}

/* Draws an arrow. The arrow of a moment has two tips. */
static void put_arrow(const picture *p, const baum_i_shape *shape)
{
  static const double tip[4][2] = {{0.0, 0.0}, {1.2, 0.5}, {0.0, 0.0}, {1.2, -0.5}};
  double ends[2][3], at[9][3];
  (void)project_ends(p, shape, ends);
  const double *from = ends[0], *to = ends[1];
  const double d[2] = {to[0] - from[0], to[1] - from[1]};
  const double size = p->drawing->unit / fmax(hypot(d[0], d[1]), p->drawing->unit);
  const int count = shape->style == BAUM_I_MOMENT ? 9 : 5;
  memcpy(at[0], from, sizeof at[0]);
  for (int k = 1; k < count; k++) {
    double back = size * (tip[(k - 1) % 4][0] + (k > 4 ? 0.8 : 0.0));
    double side = size * tip[(k - 1) % 4][1];
    at[k][0] = to[0] - back * d[0] + side * d[1];
    at[k][1] = to[1] - back * d[1] - side * d[0];
  }
  put_line(p, shape, count, (const double(*)[3])at, false);
}

static void put_connection(const picture *p, const baum_i_shape *shape)
{
  if (shape->form == BAUM_I_ARROW) {
    put_arrow(p, shape);
  } else {
    put_between(p, shape);
  }
}

static void put_points(const picture *p, const baum_i_shape *shape)
{
  double(*at)[3] = baum_i_alloc((size_t)shape->count, sizeof *at);
  if (!at) {
    p->out->failed = true;
    return;
  }
  for (int k = 0; k < shape->count; k++) {
    baum_i_picture_project(p, shape->body, point_of(p, shape, k), at[k]);
  }
  put_line(p, shape, shape->count, (const double(*)[3])at, shape->form == BAUM_I_AREA);
  baum_i_free(at);
}

static void put_shape(const picture *p, const baum_i_shape *shape, int part)
{
  double at[3];
  baum_i_picture_project(p, shape->body, point_of(p, shape, 0), at);
  if (connects(shape)) {
    put_connection(p, shape);
  } else if (shape->form == BAUM_I_BALL) {
    put_circle(p, shape, at);
  } else if (shape->form == BAUM_I_DISC) {
    put_disc(p, shape);
  } else if (shape->form == BAUM_I_CYLINDER) {
    baum_i_picture_put_cylinder(p, shape);
  } else if (shape->form == BAUM_I_MESH) {
    baum_i_picture_put_triangle(p, shape, part);
  } else if (shape->form == BAUM_I_BOX) {
    for (int face = 0; face < 6; face++) {
      put_face(p, shape, face / 2, face % 2 ? 1.0 : -1.0);
    }
  } else {
    put_points(p, shape);
  }
}

/* ---- the picture ---- */

/* The order in which shapes and the triangles of meshes are drawn: by layer, then by depth. In the
 * plane, every shape has its own layer. In space, outlines of the ground are in the rear layer,
 * because a large floor has no single depth. Couplings, drivers, loads, user elements and gaps are
 * in front, each in its own layer. All other shapes share one layer. */
typedef struct order {
  int layer;
  double depth;
  int shape;
  int part;
} order;

static int compare(const void *a, const void *b)
{
  const order *x = a, *y = b;
  if (x->layer != y->layer) {
    return x->layer - y->layer;
  }
  if (x->depth != y->depth) {
    return x->depth > y->depth ? 1 : -1;
  }
  return x->shape != y->shape ? x->shape - y->shape : x->part - y->part;
}

static int parts_of(const baum_i_shape *shape)
{
  return shape->form == BAUM_I_MESH ? shape->triangle_count : 1;
}

static int layer_of(const picture *p, int k)
{
  const baum_i_style style = p->drawing->shapes[k].style;
  const int in_space = style == BAUM_I_BASE ? 0 : style > BAUM_I_JOINT ? 2 + k : 1;
  return p->drawing->spatial ? in_space : k;
}

/* Makes a list of all shown shapes and triangles in the order of drawing. Returns their number, or
 * -1 when out of memory. */
static int sort_parts(const picture *p, order **out)
{
  int count = 0, room = 0;
  for (int k = 0; k < p->drawing->shape_count; k++) {
    room += parts_of(&p->drawing->shapes[k]);
  }
  order *orders = *out = baum_i_alloc((size_t)room, sizeof *orders);
  if (!orders) {
    return -1;
  }
  for (int k = 0; k < p->drawing->shape_count; k++) {
    const baum_i_shape *shape = &p->drawing->shapes[k];
    const int parts = is_shown(p, shape) ? parts_of(shape) : 0;
    for (int part = 0; part < parts; part++) {
      double depth =
        shape->form == BAUM_I_MESH ? baum_i_picture_depth(p, shape, part) : depth_of(p, shape);
      orders[count++] = (order){layer_of(p, k), depth, k, part};
    }
  }
  qsort(orders, (size_t)count, sizeof *orders, compare);
  return count;
}

void baum_i_picture_include(const baum_i_picture *p, baum_i_box *box)
{
  for (int k = 0; k < p->drawing->shape_count; k++) {
    if (is_shown(p, &p->drawing->shapes[k])) {
      include_shape(p, &p->drawing->shapes[k], box);
    }
  }
}

void baum_i_picture_begin(baum_i_picture *p, const baum_i_box *seen, double below)
{
  baum_i_box box = *seen;
  if (!(box.high[0] >= box.low[0] && box.high[1] >= box.low[1])) {
    include((const double[3]){0.0, 0.0, 0.0}, 1.0, &box);
  }
  double width = box.high[0] - box.low[0], height = box.high[1] - box.low[1];
  p->scale = fmin((WIDTH - 2.0 * MARGIN) / width, (HEIGHT - 2.0 * MARGIN) / height);
  p->left = box.low[0] - MARGIN / p->scale;
  p->top = box.high[1] + MARGIN / p->scale;
  p->size[0] = width * p->scale + 2.0 * MARGIN;
  p->size[1] = height * p->scale + 2.0 * MARGIN + below;
  baum_i_putf(p->out,
              "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
              "viewBox=\"0 0 %.0f %.0f\" stroke-width=\".7\" stroke-linecap=\"round\" "
              "stroke-linejoin=\"round\">\n",
              p->size[0], p->size[1], p->size[0], p->size[1]);
}

baum_status baum_i_picture_put_shapes(const baum_i_picture *p)
{
  order *orders;
  const int count = sort_parts(p, &orders);
  if (count < 0) {
    return baum_i_fail_memory();
  }
  for (int k = 0; k < count; k++) {
    const baum_i_shape *shape = &p->drawing->shapes[orders[k].shape];
    if (k == 0 || orders[k].shape != orders[k - 1].shape) {
      baum_i_put(p->out, k ? "</g>\n<g><title>" : "<g><title>");
      baum_i_put_user_text(p->out, shape->element->name, BAUM_I_XML);
      baum_i_put(p->out, "</title>");
    }
    put_shape(p, shape, orders[k].part);
  }
  baum_i_put(p->out, count ? "</g>\n" : "");
  baum_i_free(orders);
  return BAUM_OK;
}

const char *baum_i_picture_colour(int body)
{
  return COLOUR[(body + COLOURS - 1) % COLOURS][1];
}

baum_status baum_i_put_picture(const baum_i_drawing *drawing, const baum_i_spatial_frame *frames,
                               baum_i_buffer *out)
{
  picture p = {.drawing = drawing, .frames = frames, .out = out};
  baum_i_box box = BAUM_I_EMPTY_BOX;
  baum_i_picture_set_view(&p);
  baum_i_picture_include(&p, &box);
  baum_i_picture_begin(&p, &box, 0.0);
  BAUM_I_TRY(baum_i_picture_put_shapes(&p));
  baum_i_put(out, "</svg>\n");
  return out->failed ? baum_i_fail_memory() : BAUM_OK;
}
