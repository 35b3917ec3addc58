/* SPDX-License-Identifier: BSD-3-Clause */
/* Many slider-cranks that differ in one number. Each is a copy of a frozen slider-crank, with
 * another mass of the slider. */
#ifndef BAUM_TEST_MODELS_VARIANTS_H
#define BAUM_TEST_MODELS_VARIANTS_H

#include "models.h"

/* The mechanism and the state that all variants share. They are constant, so that any number of
 * threads may use them. */
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

/* Copies the mechanism, sets the mass of the slider [kg] and freezes the copy. If `out` is not
 * NULL, computes the accelerations at the state of the plan. Then destroys the copy. */
baum_status variant_make(const variant_plan *plan, double mass, variant_result *out);

#endif
