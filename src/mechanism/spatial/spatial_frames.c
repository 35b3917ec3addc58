/* SPDX-License-Identifier: BSD-3-Clause */
/* Frames in space, of all bodies that have a place, and the columns of bodies. */
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

/* ---- columns ---- */

/* Which of the six a body has. */
typedef struct columns {
  int count;
  int at[BAUM_I_SPATIAL_COLUMNS];
} columns;

static const columns *columns_of(const baum_mechanism *mechanism, const baum_i_span *span, int k)
{
  static const columns list[] = {
    [BAUM_I_FRAME_PARTICLE] = {2, {0, 1}},
    [BAUM_I_FRAME_BODY] = {3, {0, 1, 5}},
    [BAUM_I_FRAME_GROUND] = {0, {0}},
    [BAUM_I_FRAME_SPATIAL_PARTICLE] = {3, {0, 1, 2}},
    [BAUM_I_FRAME_SPATIAL_BODY] = {6, {0, 1, 2, 3, 4, 5}},
  };
  return &list[baum_i_frame_of(mechanism->bodies[span->bodies[k]])];
}

void baum_i_spatial_gather(const baum_mechanism *mechanism, const baum_i_span *span,
                           const double *x, double *wide)
{
  memset(wide, 0, (size_t)span->body_count * BAUM_I_SPATIAL_COLUMNS * sizeof *wide);
  for (int k = 0; x && k < span->body_count; k++, wide += BAUM_I_SPATIAL_COLUMNS) {
    const columns *c = columns_of(mechanism, span, k);
    const double *own = x + mechanism->bodies[span->bodies[k]]->v;
    for (int i = 0; i < c->count; i++) {
      wide[c->at[i]] = own[i];
    }
  }
}

void baum_i_spatial_scatter(const baum_mechanism *mechanism, const baum_i_span *span,
                            const double *wide, double *x)
{
  for (int k = 0; k < span->body_count; k++, wide += BAUM_I_SPATIAL_COLUMNS) {
    const columns *c = columns_of(mechanism, span, k);
    double *own = x + mechanism->bodies[span->bodies[k]]->v;
    for (int i = 0; i < c->count; i++) {
      own[i] += wide[c->at[i]];
    }
  }
}

void baum_i_spatial_pack(const baum_mechanism *mechanism, const baum_i_span *span, int rows,
                         const double *wide, double *packed)
{
  for (int row = 0; row < rows; row++) {
    for (int k = 0; k < span->body_count; k++, wide += BAUM_I_SPATIAL_COLUMNS) {
      const columns *c = columns_of(mechanism, span, k);
      for (int i = 0; i < c->count; i++) {
        *packed++ = wide[c->at[i]];
      }
    }
  }
}

void baum_i_spatial_pack_square(const baum_mechanism *mechanism, const baum_i_span *span,
                                const double *wide, double *packed)
{
  ptrdiff_t width = (ptrdiff_t)span->body_count * BAUM_I_SPATIAL_COLUMNS;
  for (int k = 0; k < span->body_count; k++, wide += BAUM_I_SPATIAL_COLUMNS * width) {
    const columns *c = columns_of(mechanism, span, k);
    for (int i = 0; i < c->count; i++, packed += span->nl) {
      baum_i_spatial_pack(mechanism, span, 1, wide + width * c->at[i], packed);
    }
  }
}
