/* SPDX-License-Identifier: BSD-3-Clause */
/* Many slider-cranks that differ in one number: copies of a frozen one with another mass of the
 * slider. */
#ifndef BAUM_TEST_MODELS_VARIANTS_H
#define BAUM_TEST_MODELS_VARIANTS_H

#include "models.h"

/* The mechanism and state that all variants share; constant, so any number of threads may use
 * it. */
typedef struct variant_plan {
  model m;
  double q[9];
  double v[9];
} variant_plan;

baum_status variant_plan_make(variant_plan *out);
void variant_plan_clear(variant_plan *plan);

typedef struct variant_result {
  double a[9];
  double lambda[9];
} variant_result;

/* Copies the mechanism, sets the slider's mass [kg] and freezes it; then computes the accelerations
 * at the plan's state if `out` is not NULL, and destroys the copy. */
baum_status variant_make(const variant_plan *plan, double mass, variant_result *out);

#endif
