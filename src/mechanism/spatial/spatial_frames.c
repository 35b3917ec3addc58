/* SPDX-License-Identifier: BSD-3-Clause */
/* The spatial frames of bodies. */
#include <math.h>
#include <string.h>

#include "mechanism/spatial/spatial.h"

/* ---- frames ---- */

baum_i_spatial_frame baum_i_spatial_frame_at(baum_i_frame_kind kind, const double *q,
                                             const double *v)
{
  baum_i_spatial_frame frame = {.axes = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}};
  if (kind == BAUM_I_FRAME_NONE || kind == BAUM_I_FRAME_GROUND) {
    return frame;
  }
  if (!baum_i_is_spatial(kind)) {
    baum_i_frame planar = baum_i_frame_at(kind, q);
    planar.vx = v ? v[0] : 0.0;
    planar.vy = v ? v[1] : 0.0;
    planar.w = v && kind == BAUM_I_FRAME_BODY ? v[2] : 0.0;
    return baum_i_lifted(&planar);
  }
  memcpy(frame.r, q, 3 * sizeof *q);
  if (v) {
    memcpy(frame.v, v, 3 * sizeof *v);
  }
  if (kind == BAUM_I_FRAME_SPATIAL_BODY) {
    baum_i_rotation_of(q + 3, frame.axes);
    if (v) {
      baum_i_turn(frame.axes, v + 3, frame.w);
    }
  }
  return frame;
}

/* Read the positions of a body in the design configuration. Returns the kind of its frame. */
static baum_i_frame_kind design_positions(const baum_mechanism *mechanism, int index, double q[7])
{
  const baum_i_body *body = mechanism->bodies[index];
  const baum_i_frame_kind kind = baum_i_frame_of(body);
  double v[6];
  bool held;
  memset(q, 0, 7 * sizeof *q);
  if (kind != BAUM_I_FRAME_NONE && kind != BAUM_I_FRAME_GROUND) {
    body->type->design(body->element.def, q, v, &held);
  }
  return kind;
}

baum_i_spatial_frame baum_i_spatial_design_frame(const baum_mechanism *mechanism, int index)
{
  double q[7];
  const baum_i_frame_kind kind = design_positions(mechanism, index, q);
  return baum_i_spatial_frame_at(kind, q, NULL);
}

void baum_i_spatial_orientation_at(baum_i_frame_kind kind, const double *q, double p[4])
{
  const double half = kind == BAUM_I_FRAME_BODY ? 0.5 * q[2] : 0.0;
  const double planar[4] = {cos(half), 0.0, 0.0, sin(half)};
  memcpy(p, kind == BAUM_I_FRAME_SPATIAL_BODY ? q + 3 : planar, sizeof planar);
}

void baum_i_spatial_design_orientation(const baum_mechanism *mechanism, int index, double p[4])
{
  double q[7];
  const baum_i_frame_kind kind = design_positions(mechanism, index, q);
  baum_i_spatial_orientation_at(kind, q, p);
}

void baum_i_point_set_spatial(baum_i_point *point)
{
  const baum_mechanism *m = point->mechanism;
  for (int i = 1; i <= m->body_count; i++) {
    const baum_i_body_place *place = &m->places[i];
    const baum_i_frame_kind kind = (baum_i_frame_kind)place->kind;
    if (place->in_space && baum_i_is_spatial(kind)) {
      point->spatial[i] =
        baum_i_spatial_frame_at(kind, point->q + place->q, point->v ? point->v + place->v : NULL);
    } else if (place->in_space) {
      point->spatial[i] = baum_i_lifted(&point->frames[i]);
    }
  }
}
