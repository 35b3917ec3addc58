/* SPDX-License-Identifier: BSD-3-Clause */
/* What a mechanism looks like: shapes in the axes of its bodies. Pictures and pages are made only
 * from these shapes and the frames of the bodies. docs/drawings.md lists forms and styles.
 */
#ifndef BAUM_I_DRAW_DRAWING_H
#define BAUM_I_DRAW_DRAWING_H

#include <baum/draw.h>

#include "base/buffer.h"
#include "base/rotation.h"
#include "mechanism/model.h"

typedef enum baum_i_form {
  BAUM_I_LINE,     /* through all points */
  BAUM_I_AREA,     /* closed, through all points */
  BAUM_I_DISC,     /* centre; normal */
  BAUM_I_BALL,     /* centre */
  BAUM_I_BOX,      /* centre; half of the edges, along the axes of the body */
  BAUM_I_CYLINDER, /* centres of both ends */
  BAUM_I_MESH,     /* vertices */
  BAUM_I_BETWEEN,  /* from a point on `body` to one on `other`; moved to the left by y of a third */
  BAUM_I_ARROW,    /* from a point on `body` along a vector in the axes of `other` */
  /* from a point on `body` to the nearest point of what is given on `other`: */
  BAUM_I_TO_LINE,  /* the open line whose corners are the other points */
  BAUM_I_TO_PLANE, /* a plane: point; normal */
  BAUM_I_TO_SPHERE /* a sphere: centre; radius, 0, 0 */
} baum_i_form;

/* STYLE(name). Pictures of the plane draw them in this order, larger wheels before smaller ones. */
#define BAUM_I_STYLES(STYLE) \
  STYLE(BASE, base)          \
  STYLE(GUIDE, guide)        \
  STYLE(WHEEL, wheel)        \
  STYLE(GROUND, ground)      \
  STYLE(BODY, body)          \
  STYLE(MARK, mark)          \
  STYLE(PITCH, pitch)        \
  STYLE(SLOT, slot)          \
  STYLE(DAMPER, damper)      \
  STYLE(SPRING, spring)      \
  STYLE(ROD, rod)            \
  STYLE(JOINT, joint)        \
  STYLE(COUPLING, coupling)  \
  STYLE(DRIVER, driver)      \
  STYLE(LOAD, load)          \
  STYLE(MOMENT, moment)      \
  STYLE(USER, user)          \
  STYLE(GAP, gap)

typedef enum baum_i_style {
#define BAUM_I_STYLE(CODE, NAME) BAUM_I_##CODE,
  BAUM_I_STYLES(BAUM_I_STYLE)
#undef BAUM_I_STYLE
    BAUM_I_STYLE_COUNT
} baum_i_style;

typedef struct baum_i_shape {
  baum_i_style style;
  baum_i_form form;
  const baum_i_element *element; /* joint, force or body that it shows */
  int body;                      /* the points are in its axes; 0: ground */
  int other;                     /* see the forms */
  double radius;                 /* [m] of a disc, ball or cylinder; half the width of lines */
  int first, count;              /* its points, set by baum_i_draw() */
  const char *color;             /* "#rrggbb"; NULL: as its style */
  const int32_t *triangles;      /* (triangle_count x 3) corners of a mesh, among its points */
  int triangle_count;
} baum_i_shape;

static inline baum_i_shape baum_i_shape_of(baum_i_style style, baum_i_form form,
                                           const baum_i_element *element, int body, int other,
                                           double radius)
{
  return (baum_i_shape){.style = style,
                        .form = form,
                        .element = element,
                        .body = body,
                        .other = other,
                        .radius = radius};
}

/* The place of a joint or force between two bodies: its points and axes, in the axes of each body.
 * The two bodies of a load are the same. */
typedef struct baum_i_place {
  const baum_i_element *element; /* NULL: it has no place */
  int body[2];
  double point[2][3];
  double axis[2][3]; /* unit vectors; k where the kind has no axis */
} baum_i_place;

/* One end of a place. */
typedef struct baum_i_place_end {
  int place;
  int side;
} baum_i_place_end;

/* Samples of positions; count is 0 if there are none. */
typedef struct baum_i_samples {
  const double *q; /* (count x stride); each row begins with q (nq) */
  int64_t count;
  int64_t stride;
} baum_i_samples;

typedef struct baum_i_drawing {
  const baum_mechanism *mechanism;
  baum_i_samples motion;        /* determines the lengths of guides */
  baum_i_spatial_frame *design; /* (body_count + 1) */
  baum_i_place *places;         /* (joint_count + force_count), joints first */
  int place_count;
  baum_i_place_end *ends; /* (2 place_count) by body; those of body k begin at first_end[k] */
  int *first_end;         /* (body_count + 2) */
  int *gears;             /* (gear_count) numbers of joints */
  int gear_count;
  double unit; /* [m] half the width of a link */
  bool spatial;
  baum_i_shape *shapes; /* (shape_count) */
  int shape_count;
  double (*points)[3]; /* (point_count) [m] */
  int point_count;
  bool failed; /* memory has run out */
} baum_i_drawing;

/* Draw all elements. If there are no samples, the mechanism need not be frozen. BAUM_OK
 * or BAUM_ERR_MEMORY; release the drawing in any case. */
baum_status baum_i_drawing_create(const baum_mechanism *m, const baum_i_samples *motion,
                                  baum_i_drawing *out);
void baum_i_drawing_release(baum_i_drawing *drawing);

/* Add a shape of `count` points. */
void baum_i_draw(baum_i_drawing *drawing, baum_i_shape shape, int count, const double (*points)[3]);

const char *baum_i_style_name(baum_i_style style);
const char *baum_i_form_name(baum_i_form form);

/* Write the shapes as JSON. */
void baum_i_put_drawing(const baum_i_drawing *drawing, baum_i_buffer *out);

/* Frame of a body at (nq) positions; quaternions need not be normalized. */
baum_i_spatial_frame baum_i_drawing_frame(const baum_i_body *body, const double *q);

/* ---- places.c ---- */

/* Return a number of a definition, or 0 if it has no such field. */
double baum_i_find_number(const baum_i_element *element, const char *name);
bool baum_i_has_field(const baum_i_element *element, const char *name);

/* Set the places of all joints and forces. Needs the design frames. */
void baum_i_find_places(baum_i_drawing *drawing);

/* Return the ends of places on a body, in the order of joints and forces. */
const baum_i_place_end *baum_i_ends_of(const baum_i_drawing *drawing, int body, int *count);

/* Transform a point of a body to ground axes. */
static inline void baum_i_to_ground(const baum_i_spatial_frame *frame, const double point[3],
                                    double out[3])
{
  baum_i_turn(frame->axes, point, out);
  baum_i_add_scaled3(1.0, frame->r, out);
}

/* Transform the vector x from the axes of body `from` to the axes of body `to`, in the design
 * configuration. */
void baum_i_draw_turn(const baum_i_drawing *drawing, int from, int to, const double x[3],
                      double out[3]);
/* The same for a point. */
void baum_i_draw_move(const baum_i_drawing *drawing, int from, int to, const double point[3],
                      double out[3]);

/* ---- outlines.c, user_outlines.c, symbols.c ---- */

/* Draw the body of this index: by the outlines of the user, or else by its joints. */
void baum_i_draw_body(baum_i_drawing *drawing, int body);
void baum_i_draw_outlines(baum_i_drawing *drawing, int body);

/* Draw a joint (number k) or a force (number joint_count + k). */
void baum_i_draw_symbol(baum_i_drawing *drawing, int number);

/* ---- page.c ---- */

/* Copy and check a page of the caller. Sets the number of columns in its rows. */
baum_status baum_i_page_check(const baum_mechanism *m, const baum_page *given, const char *call,
                              baum_page *page, int *width);
/* Return the first column of q in the rows of a checked page. */
int baum_i_page_positions(const baum_mechanism *m, const baum_page *page);
/* Whether a channel is a joint reaction, which is shown as an arrow. */
bool baum_i_page_is_reaction(const baum_mechanism *m, const baum_channel *c);
/* ---- gaps.c ---- */

/* Draw what shows that a joint is open, see docs/drawings.md. */
void baum_i_draw_gaps(baum_i_drawing *drawing, const baum_i_place *place);

/* Draw the gap between body_b's point and a line through points on body_a. */
void baum_i_draw_gap_to_line(baum_i_drawing *drawing, const baum_i_place *place, int count,
                             const double (*line)[3]);

/* Find the two ends of a shape that connects bodies, in ground axes. An arrow is 8 units long. */
void baum_i_find_ends(const baum_i_drawing *drawing, const baum_i_spatial_frame *frames,
                      const baum_i_shape *shape, double from[3], double to[3]);

/* ---- svg.c ---- */

/* Write a picture of a drawing with the bodies at these frames. */
baum_status baum_i_put_picture(const baum_i_drawing *drawing, const baum_i_spatial_frame *frames,
                               baum_i_buffer *out);

/* ---- wheels.c ---- */

/* Return the radius of a body's pitch circle in this gear, and the centre in the body's axes; 0 if
 * the body is no wheel of it. */
double baum_i_gear_radius(const baum_i_drawing *drawing, const baum_i_joint *joint, int body,
                          double centre[3]);
/* Return the radius of a wheel's outline, slightly larger than its pitch circle in any joint; 0 if
 * the body is no wheel. */
double baum_i_wheel_radius(const baum_i_drawing *drawing, int body, double centre[3]);

#endif
