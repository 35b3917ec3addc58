/* SPDX-License-Identifier: BSD-3-Clause */
/* A fingerprint of a frozen mechanism, by which another process recognizes the same mechanism. */
#ifndef BAUM_I_MECHANISM_FINGERPRINT_H
#define BAUM_I_MECHANISM_FINGERPRINT_H

#include "mechanism/identify.h"

/* Numbers that characterize a mechanism. User functions and the names of elements do not affect
 * them. */
typedef struct baum_i_fingerprint {
  /* the kinds of elements in their order, the bodies they act on, and the names of inputs */
  uint64_t structure;
  uint64_t numbers; /* masses, lengths and all other parameters */
} baum_i_fingerprint;

baum_i_fingerprint baum_i_mechanism_fingerprint(const baum_mechanism *mechanism);

#endif
