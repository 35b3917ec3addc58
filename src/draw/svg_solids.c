/* SPDX-License-Identifier: BSD-3-Clause */
/* Draws cylinders and meshes in SVG pictures. */
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "draw/svg.h"

enum { HALF = BAUM_I_CIRCLE / 2 };
static const double SIDE = 0.88; /* brightness of the side of a cylinder */

void baum_i_shade(const char color[8], double factor, char out[8])
{
  const long rgb = strtol(color + 1, NULL, 16);
  int part[3];
  for (int i = 0; i < 3; i++) {
    part[i] = (int)fmin(255.0, factor * (double)(rgb >> (16 - 8 * i) & 255) + 0.5);
  }
  (void)baum_i_print(out, 8, "#%02x%02x%02x", part[0] & 255, part[1] & 255, part[2] & 255);
}

/* ---- cylinders ----
 *
 * In a parallel projection, the silhouette of a cylinder consists of one half of each end circle
 * and of two lines between them. The vector x is orthogonal to the axis and to the direction
 * towards the eye. The two lines therefore begin at x and -x from the centre of an end. The vector
 * y is the cross product of the axis and x.
 */

/* Sets `count` points on a circle, beginning at the angle `first`. */
static void set_arc(const double centre[3], const double (*xy)[3], double first, int count,
                    double (*out)[3])
{
  for (int k = 0; k < count; k++) {
    const double angle = first + BAUM_I_REVOLUTION * k / BAUM_I_CIRCLE;
    memcpy(out[k], centre, sizeof out[k]);
    baum_i_add_scaled3(cos(angle), xy[0], out[k]);
    baum_i_add_scaled3(sin(angle), xy[1], out[k]);
  }
}

/* Sets the vectors x and y, whose length is the radius of the cylinder. */
static void set_axes(const double along[3], double radius, double (*xy)[3])
{
  static const double eye[3] = {0.0, 0.0, 1.0};
  const double length = sqrt(baum_i_dot3(along, along));
  const double axis[3] = {along[0] / length, along[1] / length, along[2] / length};
  baum_i_cross(eye, axis, xy[0]);
  const double sine = sqrt(baum_i_dot3(xy[0], xy[0]));
  if (sine < 1e-9) {
    baum_i_complete_axes(axis, xy[0], xy[1]);
  }
  for (int i = 0; i < 3; i++) {
    xy[0][i] *= radius / (sine < 1e-9 ? 1.0 : sine);
  }
  baum_i_cross(axis, xy[0], xy[1]);
}

void baum_i_picture_put_cylinder(const baum_i_picture *p, const baum_i_shape *shape)
{
  double far_end[3], near_end[3], xy[2][3], side[BAUM_I_CIRCLE + 2][3], cap[BAUM_I_CIRCLE][3];
  const double(*ends)[3] = (const double(*)[3])p->drawing->points + shape->first;
  baum_i_picture_project(p, shape->body, ends[0], far_end);
  baum_i_picture_project(p, shape->body, ends[1], near_end);
  if (near_end[2] < far_end[2]) {
    baum_i_picture_project(p, shape->body, ends[0], near_end);
    baum_i_picture_project(p, shape->body, ends[1], far_end);
  }
  const double along[3] = {near_end[0] - far_end[0], near_end[1] - far_end[1],
                           near_end[2] - far_end[2]};
  set_axes(along, shape->radius, xy);
  /* The silhouette contains the half of the far circle that faces away from the near end. */
  const bool upper = xy[1][0] * along[0] + xy[1][1] * along[1] < 0.0;
  const double first = upper ? 0.0 : 0.5 * BAUM_I_REVOLUTION;
  set_arc(far_end, (const double(*)[3])xy, first, HALF + 1, side);
  set_arc(near_end, (const double(*)[3])xy, first + 0.5 * BAUM_I_REVOLUTION, HALF + 1,
          side + HALF + 1);
  set_arc(near_end, (const double(*)[3])xy, 0.0, BAUM_I_CIRCLE, cap);
  baum_i_look look = baum_i_picture_look(shape), darker = look;
  baum_i_shade(look.fill, SIDE, darker.fill);
  baum_i_picture_put_area(p, &darker, BAUM_I_CIRCLE + 2, (const double(*)[3])side);
  if (along[2] > 0.0) {
    baum_i_picture_put_area(p, &look, BAUM_I_CIRCLE, (const double(*)[3])cap);
  }
}

/* ---- meshes ---- */

static void project_triangle(const baum_i_picture *p, const baum_i_shape *shape, int triangle,
                             double (*at)[3])
{
  for (int k = 0; k < 3; k++) {
    const int corner = shape->triangles[3 * (size_t)triangle + (size_t)k];
    baum_i_picture_project(p, shape->body, p->drawing->points[shape->first + corner], at[k]);
  }
}

double baum_i_picture_depth(const baum_i_picture *p, const baum_i_shape *shape, int triangle)
{
  double at[3][3];
  project_triangle(p, shape, triangle, at);
  return (at[0][2] + at[1][2] + at[2][2]) / 3.0;
}

/* Draws a triangle. The light comes from above the eye, and both sides of the triangle are lit. A
 * thin edge in the same colour covers the gap that browsers leave between neighbouring triangles.
 * Its width is set once for the whole picture. */
void baum_i_picture_put_triangle(const baum_i_picture *p, const baum_i_shape *shape, int triangle)
{
  static const double LIGHT[3] = {-0.3, 0.5, 0.81};
  double at[3][3], a[3], b[3], normal[3];
  project_triangle(p, shape, triangle, at);
  for (int i = 0; i < 3; i++) {
    a[i] = at[1][i] - at[0][i];
    b[i] = at[2][i] - at[0][i];
  }
  baum_i_cross(a, b, normal);
  const double size = sqrt(baum_i_dot3(normal, normal));
  if (fabs(normal[2]) <= 1e-6 * size) { /* the triangle is edge-on, or its area is zero */
    return;
  }
  const double cosine = baum_i_dot3(normal, LIGHT) / size * (normal[2] < 0.0 ? -1.0 : 1.0);
  char colour[8];
  baum_i_shade(baum_i_picture_look(shape).fill, 0.55 + 0.5 * fmax(cosine, 0.0), colour);
  baum_i_picture_put_point(p, "<path d=\"M", at[0]);
  baum_i_picture_put_point(p, "L", at[1]);
  baum_i_picture_put_point(p, "L", at[2]);
  baum_i_putf(p->out, "Z\" fill=\"%s\" stroke=\"%s\"/>", colour, colour);
}
