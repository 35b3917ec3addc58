/* SPDX-License-Identifier: BSD-3-Clause */
/* The frames of all bodies at once. */
#ifndef BAUM_I_MECHANISM_FRAMES_H
#define BAUM_I_MECHANISM_FRAMES_H

#include "mechanism/mechanism.h"

struct baum_i_frames_kernel {
  /* frames (body_count + 1) of a mechanism at q, and v or NULL for rest; turn (3 x
   * baum_i_turn_size()) is overwritten. */
  void (*set)(const baum_mechanism *mechanism, const double *q, const double *v,
              baum_i_frame *frames, double *turn);
};

extern const baum_i_frames_kernel baum_i_frames_kernel_plain;
extern const baum_i_frames_kernel baum_i_frames_kernel_wide;

/* Bodies with ground, up to whole vectors of four. */
static inline int baum_i_turn_size(const baum_mechanism *mechanism)
{
  return (mechanism->body_count + 4) / 4 * 4;
}

#endif
