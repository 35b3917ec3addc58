/* SPDX-License-Identifier: BSD-3-Clause */
/* A fingerprint that identifies a frozen mechanism in another process. */
#ifndef BAUM_I_MECHANISM_FINGERPRINT_H
#define BAUM_I_MECHANISM_FINGERPRINT_H

#include "mechanism/identify.h"

/* It covers neither user functions nor names of elements. */
typedef struct baum_i_fingerprint {
  uint64_t structure; /* kinds of elements in their order, on which bodies each acts, names of
                         inputs */
  uint64_t numbers;   /* masses, lengths and all others */
} baum_i_fingerprint;

baum_i_fingerprint baum_i_mechanism_fingerprint(const baum_mechanism *mechanism);

#endif
