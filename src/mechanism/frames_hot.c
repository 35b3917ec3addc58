/* SPDX-License-Identifier: BSD-3-Clause */
/* The frames of all bodies: angles side by side, their sines and cosines as vectors, then the frames. */
#include <math.h>

#include "base/hot.h"
#include "base/pair.h"
#include "base/sincos.h"
#include "mechanism/frames.h"

/* Angles of the bodies that have one, zero for the others; whether one is beyond own sincos. */
static bool gather_angles(const baum_mechanism *mechanism, const double *q, double *angle)
{
  bool far = false;
  for (int i = 1; i <= mechanism->body_count; i++) {
    const baum_i_body_place *place = &mechanism->places[i];
    double x = place->kind == BAUM_I_FRAME_BODY ? q[place->q + 2] : 0.0;
    angle[i] = x;
    far = far || !(fabs(x) <= baum_i_sincos_limit);
  }
  return far;
}

static void set_sines(const double *restrict angle, int count, double *restrict sine,
                      double *restrict cosine)
{
  for (int i = 0; i < count; i++) {
    baum_i_sincos(angle[i], &sine[i], &cosine[i]);
  }
}

/* Far angles, infinite ones and NaN. */
static void mend_far(const double *angle, int count, double *sine, double *cosine)
{
  for (int i = 0; i < count; i++) {
    if (!(fabs(angle[i]) <= baum_i_sincos_limit)) {
      sine[i] = sin(angle[i]);
      cosine[i] = cos(angle[i]);
    }
  }
}

/* Of a body whose frame is not that of a planar body. */
static void set_other(int kind, const double *q, const double *v, baum_i_frame *frame)
{
  static const double rest[2] = {0.0, 0.0};
  const double *rate = v ? v : rest;
  if (kind == BAUM_I_FRAME_PARTICLE) {
    baum_i_store(&frame->x, baum_i_load(q));
    baum_i_store(&frame->vx, baum_i_load(rate));
  }
}

static void set_frames(const baum_mechanism *mechanism, const double *q, const double *v,
                       const double *turn, baum_i_frame *frames)
{
  static const double rest[3] = {0.0, 0.0, 0.0};
  int size = baum_i_turn_size(mechanism);
  const baum_i_body_place *places = mechanism->places;
  for (int i = 1; i <= mechanism->body_count; i++) {
    baum_i_frame *frame = &frames[i];
    const double *position = q + places[i].q;
    if (places[i].kind != BAUM_I_FRAME_BODY) {
      set_other(places[i].kind, position, v ? v + places[i].q : NULL, frame);
      continue;
    }
    const double *rate = v ? v + places[i].q : rest;
    baum_i_store(&frame->x, baum_i_load(position));
    baum_i_store(&frame->vx, baum_i_load(rate));
    frame->c = turn[size + i];
    frame->s = turn[2 * size + i];
    frame->w = rate[2];
    frame->angle = position[2];
  }
}

static void set_all(const baum_mechanism *mechanism, const double *q, const double *v,
                baum_i_frame *frames, double *turn)
{
  int size = baum_i_turn_size(mechanism);
  double *cosine = turn + size;
  double *sine = cosine + size;
  bool far = gather_angles(mechanism, q, turn);
  set_sines(turn, size, sine, cosine);
  if (far) {
    mend_far(turn, size, sine, cosine);
  }
  set_frames(mechanism, q, v, turn, frames);
}

const baum_i_frames_kernel BAUM_I_HOT(baum_i_frames_kernel) = {.set = set_all};
