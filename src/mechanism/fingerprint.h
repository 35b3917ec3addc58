/* SPDX-License-Identifier: BSD-3-Clause */
/* By what a frozen mechanism is known again in another process. */
#ifndef BAUM_I_MECHANISM_FINGERPRINT_H
#define BAUM_I_MECHANISM_FINGERPRINT_H

#include "mechanism/identify.h"

/* Functions of the user are not in it, nor names of elements. */
typedef struct baum_i_fingerprint {
  uint64_t structure; /* kinds of elements in their order, on which bodies each acts, names of
                         inputs */
  uint64_t numbers;   /* masses, lengths and all others */
} baum_i_fingerprint;

baum_i_fingerprint baum_i_mechanism_fingerprint(const baum_mechanism *mechanism);

#endif
