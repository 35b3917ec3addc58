/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the frames of all bodies in batches. For each batch, it computes first the angles, then
 * their sines and cosines by vector instructions, and finally the frames. If all bodies are planar
 * bodies, the table of indices in q and v (`places`) is not needed.
 */
#include <math.h>

#include "base/hot.h"
#include "base/pair.h"
#include "base/sincos.h"
#include "mechanism/planar/frames.h"

/* Number of bodies in a batch, and number of doubles in a vector. */
enum { SOME = 32, LANES = 4 };

typedef double vector __attribute__((vector_size(LANES * sizeof(double))));
typedef int64_t flags __attribute__((vector_size(LANES * sizeof(int64_t))));

typedef struct bodies {
  /* NULL if all bodies are planar bodies, which are then in the order of q. */
  const baum_i_body_place *places;
  int first;
  int count;
} bodies;

BAUM_I_INLINE baum_i_body_place place_of(const bodies *some, int k)
{
  if (!some->places) {
    int32_t first = 3 * (some->first + k - 1);
    return (baum_i_body_place){.q = first, .v = first, .kind = BAUM_I_FRAME_BODY};
  }
  return some->places[some->first + k];
}

BAUM_I_INLINE double angle_of(const bodies *some, const double *q, int k)
{
  baum_i_body_place place = place_of(some, k);
  return place.kind == BAUM_I_FRAME_BODY ? q[place.q + 2] : 0.0;
}

/* Gather the angles of a batch. For bodies without an angle, the angle is 0. Angles are stored as
 * vectors, because they are loaded as vectors immediately afterwards. If single numbers were stored
 * instead, the processor would have to wait before it can load them as a vector. */
BAUM_I_INLINE void gather_angles(const bodies *some, const double *q, double *angle)
{
  int i = 0;
  for (; i + LANES <= some->count; i += LANES) {
    const vector x = {angle_of(some, q, i), angle_of(some, q, i + 1), angle_of(some, q, i + 2),
                      angle_of(some, q, i + 3)};
    memcpy(angle + i, &x, sizeof x);
  }
  if (i < some->count) {
    int last = some->count - 1;
    const vector x = {angle_of(some, q, i), angle_of(some, q, i + 1 < last ? i + 1 : last),
                      angle_of(some, q, i + 2 < last ? i + 2 : last), 0.0};
    memcpy(angle + i, &x, sizeof x);
  }
}

/* Compute sines and cosines of the angles. Return false if an angle is outside of the range of
 * baum_i_sincos(). */
static bool set_sines(const double *restrict angle, int count, double *restrict sine,
                      double *restrict cosine)
{
  flags far = {0};
  for (int i = 0; i < count; i += LANES) {
    for (int k = i; k < i + LANES; k++) {
      baum_i_sincos(angle[k], &sine[k], &cosine[k]);
    }
    vector x;
    memcpy(&x, angle + i, sizeof x);
    far |= x * x > baum_i_sincos_limit * baum_i_sincos_limit;
  }
  return (far[0] | far[1] | far[2] | far[3]) == 0;
}

/* Use the C library for angles outside of the range of baum_i_sincos(), including infinite
 * angles. */
static void set_far_sines(const double *angle, int count, double *sine, double *cosine)
{
  for (int i = 0; i < count; i++) {
    if (!(fabs(angle[i]) <= baum_i_sincos_limit)) {
      sine[i] = sin(angle[i]);
      cosine[i] = cos(angle[i]);
    }
  }
}

BAUM_I_INLINE void set_frame(baum_i_body_place place, const double *q, const double *v,
                             double angle, baum_i_frame *frame)
{
  double w = 0.0;
  if (place.kind != BAUM_I_FRAME_NONE) {
    baum_i_store(&frame->x, baum_i_load(q + place.q));
    baum_i_store(&frame->vx, v ? baum_i_load(v + place.v) : baum_i_both(0.0));
  }
  if (place.kind == BAUM_I_FRAME_BODY && v) {
    w = v[place.v + 2];
  }
  baum_i_store(&frame->w, (baum_i_pair){w, angle});
}

BAUM_I_INLINE void set_some(const bodies *some, const double *q, const double *v,
                            baum_i_frame *frames)
{
  double angle[SOME];
  double sine[SOME];
  double cosine[SOME];
  gather_angles(some, q, angle);
  if (!set_sines(angle, some->count, sine, cosine)) {
    set_far_sines(angle, some->count, sine, cosine);
  }
  for (int k = 0; k < some->count; k++) {
    baum_i_frame *frame = &frames[some->first + k];
    baum_i_store(&frame->c, (baum_i_pair){cosine[k], sine[k]});
    set_frame(place_of(some, k), q, v, angle[k], frame);
  }
}

static void set_frames(const baum_mechanism *mechanism, const double *q, const double *v,
                       baum_i_frame *frames)
{
  int end = mechanism->body_count + 1;
  for (int i = 1; i < end; i += SOME) {
    int count = end - i < SOME ? end - i : SOME;
    if (mechanism->all_planar) {
      set_some(&(bodies){.first = i, .count = count}, q, v, frames);
    } else {
      set_some(&(bodies){.places = mechanism->places, .first = i, .count = count}, q, v, frames);
    }
  }
}

const baum_i_frames_kernel BAUM_I_HOT(baum_i_frames_kernel) = {.set = set_frames};
