/* SPDX-License-Identifier: BSD-3-Clause */
/* The part that planar joints and forces have in common: points and markers.
 *
 * A marker is a point that is fixed on a body. Its coordinates in body axes are s. The arm of a
 * marker is the vector p = A s from the origin of the body to the marker, in ground axes. With k x
 * p = (-p_y, p_x), the position, velocity and acceleration of the marker are
 *   r = origin + p,   r' = v + w k x p,   r'' = a + alpha k x p - w^2 p.
 * Kernels are functions that evaluate one joint. They write six columns, x_a y_a angle_a x_b y_b
 * angle_b (general/columns.h).
 */
#ifndef BAUM_I_MECHANISM_PLANAR_PLANAR_H
#define BAUM_I_MECHANISM_PLANAR_PLANAR_H

#include <baum/planar.h>
#include <baum/planar_joints.h>

#include "base/pair.h"
#include "mechanism/general/columns.h"

/* The first fields of every definition of a planar joint or spring. */
typedef struct baum_i_planar_head {
  size_t struct_size;
  const char *name;
  baum_body_id body_a;
  baum_body_id body_b;
  double point[2];
  double point_a[2];
  double point_b[2];
} baum_i_planar_head;

/* The entries for these fields in the table of fields of a definition. */
#define BAUM_I_PLANAR_BODIES(DEF) BAUM_I_FIELD(DEF, body_a, BODY), BAUM_I_FIELD(DEF, body_b, BODY)
#define BAUM_I_PLANAR_FIELDS(DEF)                                     \
  BAUM_I_PLANAR_BODIES(DEF), BAUM_I_OPTIONAL(DEF, point, POINT, "m"), \
    BAUM_I_OPTIONAL(DEF, point_a, POINT, "m"), BAUM_I_OPTIONAL(DEF, point_b, POINT, "m")

typedef struct baum_i_marker {
  double arm[2]; /* p */
  double r[2];
  double dr[2]; /* r' */
  double w;     /* angular velocity of the body */
} baum_i_marker;

/* Compute only the arm p of a marker, as a pair. */
static inline baum_i_pair baum_i_arm_on(const baum_i_frame *f, const double *s)
{
  return f->c * baum_i_load(s) + f->s * baum_i_turned(baum_i_load(s));
}

static inline baum_i_marker baum_i_marker_on(const baum_i_frame *f, const double *s)
{
  baum_i_marker m;
  m.arm[0] = f->c * s[0] - f->s * s[1];
  m.arm[1] = f->s * s[0] + f->c * s[1];
  m.r[0] = f->x + m.arm[0];
  m.r[1] = f->y + m.arm[1];
  m.dr[0] = f->vx - f->w * m.arm[1];
  m.dr[1] = f->vy + f->w * m.arm[0];
  m.w = f->w;
  return m;
}

static inline baum_i_marker baum_i_marker_at(const baum_i_point *point, int body, const double *s)
{
  return baum_i_marker_on(&point->frames[body], s);
}

/* Write the velocities of both bodies, in the order of the six columns. */
static inline void baum_i_planar_velocities(const baum_i_frame *a, const baum_i_frame *b,
                                            double six[6])
{
  const double v[6] = {a->vx, a->vy, a->w, b->vx, b->vy, b->w};
  for (int i = 0; i < 6; i++) {
    six[i] = v[i];
  }
}

/* The following functions check definitions. Before they are called, each field has been checked by
 * the table of fields. */

/* Check that a body has a position in the plane. */
baum_status baum_i_planar_check_body(const baum_mechanism *mechanism, baum_body_id id,
                                     const char *label, const char *field);

/* Check that body_a and body_b have positions in the plane, and that they are different bodies. */
baum_status baum_i_planar_check_bodies(const baum_mechanism *mechanism, const void *def,
                                       const char *label);

/* These are `check` functions for definitions that have bodies and points. Points must be given in
 * exactly one way: either `point`, or `point_a` and `point_b`. */
baum_status baum_i_planar_check_with_point(const baum_mechanism *mechanism, const void *def,
                                           const char *label);
/* This function is for elements that have a length. They cannot use `point`, because their length
 * would be zero. */
baum_status baum_i_planar_check_apart(const baum_mechanism *mechanism, const void *def,
                                      const char *label);
/* These two functions make the same checks as baum_i_planar_check_with_point(). In addition, the
 * first one checks that both bodies have an angle, and the second one that body_a has an angle. */
baum_status baum_i_planar_check_turning(const baum_mechanism *mechanism, const void *def,
                                        const char *label);
baum_status baum_i_planar_check_axis(const baum_mechanism *mechanism, const void *def,
                                     const char *label);

/* The first function checks that one body has an angle, and the second that both bodies have one.
 * Planar bodies and ground have an angle. The checks above must have passed before. */
baum_status baum_i_planar_check_angle(const baum_mechanism *mechanism, baum_body_id id,
                                      const char *label, const char *field);
baum_status baum_i_planar_check_angles(const baum_mechanism *mechanism, const void *def,
                                       const char *label);

/* Find the points of an element on both bodies, in body axes, from its definition and the design
 * configuration. s[0..1] is on body_a, and s[2..3] is on body_b. Returns BAUM_ERR_ARGUMENT if a
 * body is a particle and `point` is not at the particle. */
baum_status baum_i_planar_points(const baum_mechanism *mechanism, const baum_i_element *element,
                                 double s[4]);

/* Extend the box so that it includes the points of a joint's definition. This is the `extent`
 * function of joint types. */
void baum_i_planar_extent(const baum_mechanism *mechanism, const baum_i_joint *joint,
                          baum_i_box *box);

#endif
