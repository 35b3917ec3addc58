/* SPDX-License-Identifier: BSD-3-Clause */
/* The part that spatial joints and forces have in common: the first fields of their definitions,
 * checks of these fields, and points. Spatial elements compute derivatives over six columns for
 * each body (general/columns.h). A planar body may have spatial joints, although it stays in its
 * plane. It then also has six columns.
 */
#ifndef BAUM_I_MECHANISM_SPATIAL_SPATIAL_H
#define BAUM_I_MECHANISM_SPATIAL_SPATIAL_H

#include <baum/spatial.h>
#include <baum/spatial_joints.h>
#include <baum/spatial_points.h>

#include "base/rotation.h"
#include "mechanism/general/columns.h"

/* ---- definitions ---- */

/* The first fields of every definition of a spatial joint or spring. */
typedef struct baum_i_spatial_head {
  size_t struct_size;
  const char *name;
  baum_body_id body_a;
  baum_body_id body_b;
  double point[3];
  double point_a[3];
  double point_b[3];
} baum_i_spatial_head;

#define BAUM_I_SPATIAL_FIELDS(DEF)                                                      \
  BAUM_I_FIELD(DEF, body_a, BODY), BAUM_I_FIELD(DEF, body_b, BODY),                     \
    BAUM_I_OPTIONAL(DEF, point, POINT, "m"), BAUM_I_OPTIONAL(DEF, point_a, POINT, "m"), \
    BAUM_I_OPTIONAL(DEF, point_b, POINT, "m")

/* Checks that a body has a position in space. baum_i_spatial_check_turning() also checks that it
 * has an orientation. */
baum_status baum_i_spatial_check_body(const baum_mechanism *mechanism, baum_body_id id,
                                      const char *label, const char *field);
baum_status baum_i_spatial_check_turning(const baum_mechanism *mechanism, baum_body_id id,
                                         const char *label, const char *field);

/* Checks that both bodies have orientations, and that they are two different bodies. */
baum_status baum_i_spatial_check_pair(const baum_mechanism *mechanism, baum_body_id a,
                                      baum_body_id b, const char *label);

/* Checks that the vector s is zero, or not given, if the body is a particle. */
baum_status baum_i_spatial_check_zero_on_particle(const baum_mechanism *mechanism, baum_body_id id,
                                                  const char *label, const char *field,
                                                  const char *unit, const double s[3]);

/* Checks that the two bodies differ, and that the definition gives their points in exactly one way:
 * by `point`, or by point_a and point_b. An element with a length cannot use `point`, because its
 * length would be zero. */
baum_status baum_i_spatial_check_head(const baum_mechanism *mechanism, const void *def,
                                      const char *label, bool has_length);

/* Writes the points of an element in body axes: s[0..2] on body_a and s[3..5] on body_b. The
 * definition has been checked. Fails with BAUM_ERR_ARGUMENT if one of the bodies is a particle that
 * is not at `point`. */
baum_status baum_i_spatial_points(const baum_mechanism *mechanism, const baum_i_element *element,
                                  double s[6]);

/* Extends the box so that it includes the points of a joint's definition. This is the `extent`
 * function of spatial joints. */
void baum_i_spatial_extent(const baum_mechanism *mechanism, const baum_i_joint *joint,
                           baum_i_box *box);

/* Writes the orientation of a body with an orientation, or of ground, as a unit quaternion. It is
 * continuous in the positions q of the body, which must be normalized. The quaternion of a planar
 * body changes its sign in one revolution. */
void baum_i_spatial_orientation_at(baum_i_frame_kind kind, const double *q, double p[4]);

/* Writes the orientation of a body in the design configuration. May be called before freeze. */
void baum_i_spatial_design_orientation(const baum_mechanism *mechanism, int body, double p[4]);

/* Tells whether a point is given. All entries of a point that is not given are NaN. */
static inline bool baum_i_spatial_is_given(const double point[3])
{
  return !isnan(point[0]);
}

#endif
