/* SPDX-License-Identifier: BSD-3-Clause */
/* The kernel that sets the frames of all bodies. */
#ifndef BAUM_I_MECHANISM_PLANAR_FRAMES_H
#define BAUM_I_MECHANISM_PLANAR_FRAMES_H

#include "mechanism/identify.h"

struct baum_i_frames_kernel {
  /* Set frames (body_count + 1) of a mechanism at q and v. v = NULL means that all velocities are
   * zero. */
  void (*set)(const baum_mechanism *mechanism, const double *q, const double *v,
              baum_i_frame *frames);
};

extern const baum_i_frames_kernel baum_i_frames_kernel_plain;
extern const baum_i_frames_kernel baum_i_frames_kernel_wide;

#endif
