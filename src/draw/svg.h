/* SPDX-License-Identifier: BSD-3-Clause */
/* Types and functions that the files for SVG pictures share. */
#ifndef BAUM_I_DRAW_SVG_H
#define BAUM_I_DRAW_SVG_H

#include "base/buffer.h"
#include "draw/drawing.h"

enum { BAUM_I_CIRCLE = 24 /* number of corners of a circle in space */ };

/* The look of a shape. Colours are "#rrggbb" or "none". */
typedef struct baum_i_look {
  char fill[8];
  char stroke[8];
  double width; /* [px] */
  const char *dash;
} baum_i_look;

typedef struct baum_i_picture {
  const baum_i_drawing *drawing;
  const baum_i_spatial_frame *frames; /* (body_count + 1) */
  /* Rotation matrix (by rows) from ground axes to the axes of the picture: right, up and towards
   * the eye. */
  double view[9];
  double scale;     /* [px/m] */
  double left, top; /* [m] */
  double size[2];   /* [px] */
  baum_i_buffer *out;
} baum_i_picture;

/* ---- svg.c ---- */

#define BAUM_I_EMPTY_BOX        \
  (baum_i_box)                  \
  {                             \
    {INFINITY, INFINITY, 0.0},  \
    {                           \
      -INFINITY, -INFINITY, 0.0 \
    }                           \
  }

/* Set the direction of view, which depends only on what is drawn. */
void baum_i_picture_set_view(baum_i_picture *p);
/* Extend a box [m] so that it includes all shapes, with the bodies in the poses p->frames. */
void baum_i_picture_include(const baum_i_picture *p, baum_i_box *box);
/* Set the scale so that the picture shows the whole box, and write the beginning of the SVG text. A
 * strip of height `below` [px] at the bottom stays free for text. */
void baum_i_picture_begin(baum_i_picture *p, const baum_i_box *seen, double below);
/* Draw all shapes. Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_picture_put_shapes(const baum_i_picture *p);
/* Return the colour of the edges of a body. */
const char *baum_i_picture_colour(int body);

/* Transform a point of a body to the axes of the picture: right, up and towards the eye [m]. */
void baum_i_picture_project(const baum_i_picture *p, int body, const double point[3],
                            double out[3]);

baum_i_look baum_i_picture_look(const baum_i_shape *shape);
/* Write a command of an SVG path, such as "M", and its point, which is given in the axes of the
 * picture. */
void baum_i_picture_put_point(const baum_i_picture *p, const char *word, const double at[3]);
/* Draw a filled area with a thin edge. */
void baum_i_picture_put_area(const baum_i_picture *p, const baum_i_look *l, int count,
                             const double (*at)[3]);

/* ---- svg_solids.c ---- */

/* Set `out` to a colour multiplied by a factor. Factors below 1 make it darker. */
void baum_i_shade(const char color[8], double factor, char out[8]);

void baum_i_picture_put_cylinder(const baum_i_picture *p, const baum_i_shape *shape);

/* Return the mean depth of the corners of a triangle [m], which increases towards the eye. */
double baum_i_picture_depth(const baum_i_picture *p, const baum_i_shape *shape, int triangle);
void baum_i_picture_put_triangle(const baum_i_picture *p, const baum_i_shape *shape, int triangle);

#endif
