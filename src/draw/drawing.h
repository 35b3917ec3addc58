/* SPDX-License-Identifier: BSD-3-Clause */
/* A drawing is a list of shapes that show a mechanism. The points of a shape are given in the axes
 * of bodies. Pictures and pages depend only on these shapes and on the frames of the bodies.
 * docs/drawings.md lists the forms and styles of shapes.
 */
#ifndef BAUM_I_DRAW_DRAWING_H
#define BAUM_I_DRAW_DRAWING_H

#include <baum/draw.h>

#include "base/buffer.h"
#include "base/rotation.h"
#include "mechanism/model.h"

typedef enum baum_i_form {
  BAUM_I_LINE,     /* a line through all points */
  BAUM_I_AREA,     /* a closed line through all points, filled */
  BAUM_I_DISC,     /* points: the centre; the normal vector */
  BAUM_I_BALL,     /* point: the centre */
  BAUM_I_BOX,      /* points: the centre; half the lengths of the edges */
  BAUM_I_CYLINDER, /* points: the centres of both ends */
  BAUM_I_MESH,     /* points: the vertices */
  /* A connection between a point on `body` and a point on `other`. An optional third point shifts
   * the connection to the left by its y coordinate [m]. */
  BAUM_I_BETWEEN,
  BAUM_I_ARROW, /* from a point on `body`, along a vector in the axes of `other` */
  /* The next three forms connect a point on `body` with the nearest point of an object on `other`.
   * The object is: */
  BAUM_I_TO_LINE,  /* an open polygonal line through all points after the first */
  BAUM_I_TO_PLANE, /* a plane, given by a point and a normal vector */
  BAUM_I_TO_SPHERE /* a sphere, given by its centre and the vector (radius, 0, 0) */
} baum_i_form;

/* Expands the macro STYLE(CODE, name) for every style. CODE is the suffix of the enumerator, and
 * `name` is the text in JSON. Pictures of planar mechanisms draw the styles in this order, and
 * larger wheels before smaller ones. */
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
  const baum_i_element *element; /* the joint, force or body that the shape shows */
  int body;                      /* the points are in the axes of this body; 0 for ground */
  int other;                     /* second body, for the forms that have one */
  double radius;                 /* [m] of a disc, ball or cylinder; half the width of lines */
  int first, count;              /* its points among all points; set by baum_i_draw() */
  const char *color;             /* "#rrggbb", or NULL for the colour of the style */
  /* (triangle_count x 3) the three corners of each triangle of a mesh, as indices of points of this
   * shape. */
  const int32_t *triangles;
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

/* The points and axes at which a joint or force acts on its two bodies. Each point and each axis is
 * given in the axes of its body. For a load, both bodies are the body on which it acts. */
typedef struct baum_i_place {
  const baum_i_element *element; /* NULL if the element has no place */
  int body[2];
  double point[2][3];
  double axis[2][3]; /* unit vectors; (0, 0, 1) if the kind of element has no axis */
} baum_i_place;

/* One of the two ends of a place: its point on the body number `side`, which is 0 or 1. */
typedef struct baum_i_place_end {
  int place;
  int side;
} baum_i_place_end;

/* Samples of the positions of a motion. */
typedef struct baum_i_samples {
  const double *q; /* (count x stride); each row begins with the positions q (nq) */
  int64_t count;   /* 0 if there are no samples */
  int64_t stride;
} baum_i_samples;

typedef struct baum_i_drawing {
  const baum_mechanism *mechanism;
  baum_i_samples motion;        /* samples that determine the lengths of guides */
  baum_i_spatial_frame *design; /* (body_count + 1) frames in the design configuration */
  baum_i_place *places;         /* (joint_count + force_count), with the joints first */
  int place_count;
  /* (2 place_count) sorted by body; the ends on body k begin at first_end[k]. */
  baum_i_place_end *ends;
  int *first_end; /* (body_count + 2) */
  int *gears;     /* (gear_count) the numbers of the joints that are gears */
  int gear_count;
  double unit; /* [m] unit of length of all symbols; links are two units wide */
  bool spatial;
  baum_i_shape *shapes; /* (shape_count) */
  int shape_count;
  double (*points)[3]; /* (point_count) [m] */
  int point_count;
  bool failed; /* set when memory has run out */
} baum_i_drawing;

/* Make the shapes of all elements of a mechanism. The mechanism must be frozen if there are
 * samples. Returns BAUM_OK or BAUM_ERR_MEMORY. The caller must release *out even after a
 * failure. */
baum_status baum_i_drawing_create(const baum_mechanism *m, const baum_i_samples *motion,
                                  baum_i_drawing *out);
void baum_i_drawing_release(baum_i_drawing *drawing);

/* Add a shape that has `count` points. */
void baum_i_draw(baum_i_drawing *drawing, baum_i_shape shape, int count, const double (*points)[3]);

const char *baum_i_style_name(baum_i_style style);
const char *baum_i_form_name(baum_i_form form);

/* Write the shapes as JSON. */
void baum_i_put_drawing(const baum_i_drawing *drawing, baum_i_buffer *out);

/* Return the frame of a body at the positions q (nq) of the mechanism. Quaternions need not be
 * normalized. */
baum_i_spatial_frame baum_i_drawing_frame(const baum_i_body *body, const double *q);

/* ---- places.c ---- */

/* Return the value of a field of an element's definition. Returns 0 if the definition has no such
 * field. */
double baum_i_find_number(const baum_i_element *element, const char *name);
bool baum_i_has_field(const baum_i_element *element, const char *name);

/* Find the places of all joints and forces. The frames of the design configuration must be set
 * before this call. */
void baum_i_find_places(baum_i_drawing *drawing);

/* Return the ends of places that are on a body. The ends of joints come first. *count is set to the
 * number of ends. */
const baum_i_place_end *baum_i_ends_of(const baum_i_drawing *drawing, int body, int *count);

/* Transform a point from the axes of a body to ground axes. */
static inline void baum_i_to_ground(const baum_i_spatial_frame *frame, const double point[3],
                                    double out[3])
{
  baum_i_turn(frame->axes, point, out);
  baum_i_add_scaled3(1.0, frame->r, out);
}

/* Transform the vector x from the axes of the body `from` to the axes of the body `to`, in the
 * design configuration. */
void baum_i_draw_turn(const baum_i_drawing *drawing, int from, int to, const double x[3],
                      double out[3]);
/* Transform a point from the axes of the body `from` to the axes of the body `to`, in the design
 * configuration. */
void baum_i_draw_move(const baum_i_drawing *drawing, int from, int to, const double point[3],
                      double out[3]);

/* ---- outlines.c, user_outlines.c, symbols.c ---- */

/* The first function draws the body with this index: the outlines that the user has given for the
 * body or, if there are none, an outline that follows from its joints and its inertia. The second
 * function draws only outlines that the user has given. */
void baum_i_draw_body(baum_i_drawing *drawing, int body);
void baum_i_draw_outlines(baum_i_drawing *drawing, int body);

/* Draw the symbol of an element, and its gaps. Joint k has the number k, and force k has the number
 * joint_count + k. */
void baum_i_draw_symbol(baum_i_drawing *drawing, int number);

/* ---- page.c ---- */

/* Copy a caller's page and check it. *width is set to the number of columns in the rows of the
 * page. */
baum_status baum_i_page_check(const baum_mechanism *m, const baum_page *given, const char *call,
                              baum_page *page, int *width);
/* Return the column of q[0] in the rows of a page that baum_i_page_check() has accepted. */
int baum_i_page_positions(const baum_mechanism *m, const baum_page *page);
/* Tell whether a channel is a joint reaction. Pages show joint reactions as arrows. */
bool baum_i_page_is_reaction(const baum_mechanism *m, const baum_channel *c);
/* ---- gaps.c ---- */

/* The conditions that a joint imposes, as bits. */
enum {
  BAUM_I_GAP_POINTS = 1,    /* the points coincide */
  BAUM_I_GAP_LINE = 2,      /* the point of body_b is on the axis of body_a */
  BAUM_I_GAP_PLANE = 4,     /* the point of body_b is in a plane on body_a */
  BAUM_I_GAP_LENGTH = 8,    /* the points have a prescribed distance */
  BAUM_I_GAP_PARALLEL = 16, /* the axes are parallel */
  BAUM_I_GAP_NORMAL = 32,   /* the axes are perpendicular */
  BAUM_I_GAP_TURN = 64      /* body_b does not rotate about the axis relative to body_a */
};

/* Draw the lines that show the constraint violation of a joint. `conditions` is the sum of the
 * joint's conditions, or 0. docs/drawings.md describes the lines. */
void baum_i_draw_gaps(baum_i_drawing *drawing, const baum_i_place *place, int conditions);

/* Draw the gap between the point on body_b and a polygonal line that is fixed on body_a. */
void baum_i_draw_gap_to_line(baum_i_drawing *drawing, const baum_i_place *place, int count,
                             const double (*line)[3]);

/* Find the two ends of a shape that connects bodies, in ground axes. `frames` gives the present
 * poses of the bodies. Arrows are 8 units long. */
void baum_i_find_ends(const baum_i_drawing *drawing, const baum_i_spatial_frame *frames,
                      const baum_i_shape *shape, double from[3], double to[3]);

/* ---- svg.c ---- */

/* Write a drawing as an SVG picture. `frames` gives the present poses of the bodies. */
baum_status baum_i_put_picture(const baum_i_drawing *drawing, const baum_i_spatial_frame *frames,
                               baum_i_buffer *out);

/* ---- wheels.c ---- */

/* Return the radius of a body's pitch circle in a gear. `centre` is set to the centre of this
 * circle, in the axes of the body. Returns 0 if the body is not a wheel of this gear. */
double baum_i_gear_radius(const baum_i_drawing *drawing, const baum_i_joint *joint, int body,
                          double centre[3]);
/* Return the radius of a wheel's outline, which is slightly larger than the pitch circle of the
 * wheel. `centre` is set as in baum_i_gear_radius(). Returns 0 if the body is not a wheel. */
double baum_i_wheel_radius(const baum_i_drawing *drawing, int body, double centre[3]);

#endif
