/* SPDX-License-Identifier: BSD-3-Clause */
/* The frames of all bodies: angles side by side, their sines and cosines as vectors, then the frames. */
#include <math.h>

#include "base/hot.h"
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

static void set_positions(const baum_mechanism *mechanism, const double *q, const double *angle,
                          int size, baum_i_frame *frames)
{
  const double *cosine = angle + size;
  const double *sine = cosine + size;
  for (int i = 1; i <= mechanism->body_count; i++) {
    const baum_i_body_place *place = &mechanism->places[i];
    baum_i_frame *frame = &frames[i];
    frame->c = cosine[i];
    frame->s = sine[i];
    frame->angle = angle[i];
    if (place->kind != BAUM_I_FRAME_NONE) {
      frame->x = q[place->q];
      frame->y = q[place->q + 1];
    }
  }
}

static void set_velocities(const baum_mechanism *mechanism, const double *v, baum_i_frame *frames)
{
  for (int i = 1; i <= mechanism->body_count; i++) {
    const baum_i_body_place *place = &mechanism->places[i];
    baum_i_frame *frame = &frames[i];
    if (place->kind != BAUM_I_FRAME_NONE) {
      frame->vx = v[place->q];
      frame->vy = v[place->q + 1];
      frame->w = place->kind == BAUM_I_FRAME_BODY ? v[place->q + 2] : 0.0;
    }
  }
}

static void set_rest(const baum_mechanism *mechanism, baum_i_frame *frames)
{
  for (int i = 1; i <= mechanism->body_count; i++) {
    frames[i].vx = 0.0;
    frames[i].vy = 0.0;
    frames[i].w = 0.0;
  }
}

static void set(const baum_mechanism *mechanism, const double *q, const double *v,
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
  set_positions(mechanism, q, turn, size, frames);
  if (v) {
    set_velocities(mechanism, v, frames);
  } else {
    set_rest(mechanism, frames);
  }
}

const baum_i_frames_kernel BAUM_I_HOT(baum_i_frames_kernel) = {.set = set};
