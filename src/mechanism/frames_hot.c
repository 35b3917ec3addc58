/* SPDX-License-Identifier: BSD-3-Clause */
/* The frames of all bodies, some at a time: angles side by side, their sines and cosines as vectors, then
 * the frames. Where all bodies are planar bodies their coordinates need no looking up.
 */
#include <math.h>

#include "base/hot.h"
#include "base/pair.h"
#include "base/sincos.h"
#include "mechanism/frames.h"

/* Bodies at a time; whole vectors. */
enum { SOME = 32, LANES = 4 };

typedef struct bodies {
  const baum_i_body_place *places; /* NULL: all are planar bodies, in the order of q */
  int first;
  int count;
} bodies;

BAUM_I_INLINE baum_i_body_place place_of(const bodies *some, int k)
{
  if (!some->places) {
    return (baum_i_body_place){.q = 3 * (some->first + k - 1), .kind = BAUM_I_FRAME_BODY};
  }
  return some->places[some->first + k];
}

/* Without its sign a number in bits is in the order of its size; infinity and NaN come last. */
BAUM_I_INLINE uint64_t size_bits(double x)
{
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits << 1;
}

/* Zero where a body has no angle; whether one is beyond own sincos. */
BAUM_I_INLINE bool gather_angles(const bodies *some, const double *q, double *angle)
{
  uint64_t largest = 0;
  for (int k = 0; k < some->count; k++) {
    baum_i_body_place place = place_of(some, k);
    double x = place.kind == BAUM_I_FRAME_BODY ? q[place.q + 2] : 0.0;
    angle[k] = x;
    largest = size_bits(x) > largest ? size_bits(x) : largest;
  }
  for (int k = some->count; k % LANES != 0; k++) {
    angle[k] = 0.0;
  }
  return largest > size_bits(baum_i_sincos_limit);
}

static void set_sines(const double *restrict angle, int count, double *restrict sine,
                      double *restrict cosine)
{
  for (int i = 0; i < count; i += LANES) {
    for (int k = i; k < i + LANES; k++) {
      baum_i_sincos(angle[k], &sine[k], &cosine[k]);
    }
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

BAUM_I_INLINE void set_frame(baum_i_body_place place, const double *q, const double *v,
                             double angle, baum_i_frame *frame)
{
  double w = 0.0;
  if (place.kind != BAUM_I_FRAME_NONE) {
    baum_i_store(&frame->x, baum_i_load(q + place.q));
    baum_i_store(&frame->vx, v ? baum_i_load(v + place.q) : baum_i_both(0.0));
  }
  if (place.kind == BAUM_I_FRAME_BODY && v) {
    w = v[place.q + 2];
  }
  baum_i_store(&frame->w, (baum_i_pair){w, angle});
}

BAUM_I_INLINE void set_some(const bodies *some, const double *q, const double *v,
                            baum_i_frame *frames)
{
  double angle[SOME];
  double sine[SOME];
  double cosine[SOME];
  bool far = gather_angles(some, q, angle);
  set_sines(angle, some->count, sine, cosine);
  if (far) {
    mend_far(angle, some->count, sine, cosine);
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
