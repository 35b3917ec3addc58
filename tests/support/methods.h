/* SPDX-License-Identifier: BSD-3-Clause */
/* The fixed-step methods, as src/stabilization describes them, and random numbers that are the same
 * in every run. */
#ifndef BAUM_TEST_METHODS_H
#define BAUM_TEST_METHODS_H

#include <stdint.h>

#include "stabilization/amplification.h"

enum {
  EULER,
  SEMI_IMPLICIT_EULER,
  RK2,
  RK3,
  RK4,
  ONE_STEP_COUNT,
  AB2 = ONE_STEP_COUNT,
  AB3,
  AB4,
  DP5,
  RK8,
  METHOD_COUNT
};

static const baum_i_method methods[METHOD_COUNT] = {
  [EULER] = {.kind = BAUM_I_METHOD_ONE_STEP, .degree = 1, .coefficients = {1.0, 1.0}},
  [SEMI_IMPLICIT_EULER] = {.kind = BAUM_I_METHOD_SEMI_IMPLICIT, .degree = 0, .coefficients = {0.0}},
  [RK2] = {.kind = BAUM_I_METHOD_ONE_STEP, .degree = 2, .coefficients = {1.0, 1.0, 1.0 / 2.0}},
  [RK3] = {.kind = BAUM_I_METHOD_ONE_STEP,
           .degree = 3,
           .coefficients = {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0}},
  [RK4] = {.kind = BAUM_I_METHOD_ONE_STEP,
           .degree = 4,
           .coefficients = {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0}},
  [AB2] = {.kind = BAUM_I_METHOD_ADAMS_BASHFORTH,
           .degree = 2,
           .coefficients = {3.0 / 2.0, -1.0 / 2.0}},
  [AB3] = {.kind = BAUM_I_METHOD_ADAMS_BASHFORTH,
           .degree = 3,
           .coefficients = {23.0 / 12.0, -16.0 / 12.0, 5.0 / 12.0}},
  [AB4] = {.kind = BAUM_I_METHOD_ADAMS_BASHFORTH,
           .degree = 4,
           .coefficients = {55.0 / 24.0, -59.0 / 24.0, 37.0 / 24.0, -9.0 / 24.0}},
  [DP5] = {.kind = BAUM_I_METHOD_ONE_STEP,
           .degree = 6,
           .coefficients = {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 600.0}},
  [RK8] = {.kind = BAUM_I_METHOD_ONE_STEP,
           .degree = 12,
           .coefficients = {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0,
                            1.0 / 5040.0, 1.0 / 40320.0, 2.691692200169086e-06,
                            2.34134510820978e-07, 1.4947364854591546e-08, 3.613324578128244e-10}},
};

static inline baum_amplification amplification_at(int method, double alpha_h, double beta2_h2)
{
  baum_amplification out = {.struct_size = 77};
  baum_i_amplification(&methods[method], alpha_h, beta2_h2, &out);
  return out;
}

/* Returns a uniform random number in [low, high), by a linear congruential generator (Knuth,
 * MMIX). */
static inline double uniform(uint64_t *seed, double low, double high)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * ((double)(*seed >> 11) / 9007199254740992.0);
}

#endif
