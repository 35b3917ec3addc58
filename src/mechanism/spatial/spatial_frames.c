/* SPDX-License-Identifier: BSD-3-Clause */
/* The spatial frames of all bodies that have a position. */
#include <string.h>

#include "mechanism/spatial/spatial.h"

/* ---- frames ---- */

static void set_turn(baum_i_spatial_frame *frame, double cosine, double sine, double rate)
{
  const double axes[9] = {cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0};
  memcpy(frame->axes, axes, sizeof axes);
  frame->w[2] = rate;
}

baum_i_spatial_frame baum_i_spatial_frame_at(baum_i_frame_kind kind, const double *q,
                                             const double *v)
{
  baum_i_spatial_frame frame = {.axes = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}};
  if (kind == BAUM_I_FRAME_NONE || kind == BAUM_I_FRAME_GROUND) {
    return frame;
  }
  bool planar = kind == BAUM_I_FRAME_PARTICLE || kind == BAUM_I_FRAME_BODY;
  size_t size = (planar ? 2 : 3) * sizeof *q;
  memcpy(frame.r, q, size);
  if (v) {
    memcpy(frame.v, v, size);
  }
  if (kind == BAUM_I_FRAME_BODY) {
    set_turn(&frame, cos(q[2]), sin(q[2]), v ? v[2] : 0.0);
  } else if (kind == BAUM_I_FRAME_SPATIAL_BODY) {
    baum_i_rotation_of(q + 3, frame.axes);
    if (v) {
      baum_i_turn(frame.axes, v + 3, frame.w);
    }
  }
  return frame;
}

baum_i_spatial_frame baum_i_spatial_design_frame(const baum_mechanism *mechanism, int index)
{
  const baum_i_body *body = mechanism->bodies[index];
  baum_i_frame_kind kind = baum_i_frame_of(body);
  double q[7] = {0.0};
  double v[6];
  bool held;
  if (kind != BAUM_I_FRAME_NONE && kind != BAUM_I_FRAME_GROUND) {
    body->type->design(body->element.def, q, v, &held);
  }
  return baum_i_spatial_frame_at(kind, q, NULL);
}

void baum_i_point_set_spatial(baum_i_point *point)
{
  const baum_mechanism *m = point->mechanism;
  for (int i = 1; i <= m->body_count; i++) {
    const baum_i_body_place *place = &m->places[i];
    point->spatial[i] = baum_i_spatial_frame_at((baum_i_frame_kind)place->kind, point->q + place->q,
                                                point->v ? point->v + place->v : NULL);
  }
}
