/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the geometry of all planar revolute joints (called pins) in one pass and writes it
 * directly to the block solver. */
#ifndef BAUM_I_DYNAMICS_PINS_H
#define BAUM_I_DYNAMICS_PINS_H

#include "linear/block.h"
#include "mechanism/mechanism.h"

/* Input and output of the kernel. */
typedef struct baum_i_pins {
  /* (4 pin_count, with pin_count rounded up to even) for each pin, in the order of block->pins: its
   * point on body a, then its point on body b */
  const double *points;
  const baum_i_frame *frames;
  double bending; /* r = bending gamma - damping Phi' - stiffness Phi */
  double damping;
  double stiffness;
  double *phi;      /* (nc) only rows of pins are set */
  double *phi_rate; /* (nc) */
  double *gamma;    /* (nc) */
} baum_i_pins;

typedef struct baum_i_pins_kernel {
  /* Set arms, right-hand sides r and pivots of the pins, and set lambda[] to J a0 - r. The block
   * must already contain a0, the accelerations without constraint forces. */
  void (*set)(baum_i_block *block, const baum_i_pins *pins);
} baum_i_pins_kernel;

extern const baum_i_pins_kernel baum_i_pins_kernel_plain;
extern const baum_i_pins_kernel baum_i_pins_kernel_wide;

#endif
