/* SPDX-License-Identifier: BSD-3-Clause */
/* Code that the tests of this folder share. It selects mechanisms by number, and makes runs whose
 * constraints are evaluated by a separate workspace. Include after cmocka.h. */
#ifndef BAUM_TEST_PHYSICS_RUN_H
#define BAUM_TEST_PHYSICS_RUN_H

#include <math.h>
#include <stdio.h>

#include "check.h"
#include "models.h"
#include "runs.h"

/* Sizes of arrays. The slider-cranks need the largest ones. */
enum { PHYSICS_NQ = 9, PHYSICS_NC = 9 };

/* ---- mechanisms ---- */

typedef enum physics_mechanism { PENDULUM, FREE_CRANK, DRIVEN_CRANK, FOUR_BAR } physics_mechanism;

static inline const char *mechanism_name(physics_mechanism which)
{
  static const char *const names[] = {"pendulum", "slider-crank, free", "slider-crank, driven",
                                      "four-bar"};
  return names[which];
}

static inline model build_mechanism(physics_mechanism which)
{
  model out = {0};
  model_slider_crank crank = {.driven = which == DRIVEN_CRANK};
  switch (which) {
  case PENDULUM: check(model_pendulum_rod(&MODEL_PENDULUM_A01, &out)); break;
  case FOUR_BAR: check(model_four_bar(&out)); break;
  case FREE_CRANK:
  case DRIVEN_CRANK: check(model_slider_crank_build(crank, &out)); break;
  }
  return out;
}

/* ---- runs ---- */

/* A run, together with a workspace that is used only to evaluate the constraints. */
typedef struct checked_run {
  baum_simulation *run;
  baum_workspace *workspace;
  int32_t nq;
  int32_t nc;
} checked_run;

static inline checked_run create_checked_run(const baum_mechanism *mechanism,
                                             const baum_simulation_options *options)
{
  checked_run out = {0};
  check(baum_mechanism_sizes(mechanism, &out.nq, NULL, &out.nc));
  assert_true(out.nq <= PHYSICS_NQ && out.nc <= PHYSICS_NC);
  out.run = create_run(mechanism, options);
  check(baum_workspace_create(mechanism, &out.workspace));
  return out;
}

static inline void destroy_checked_run(checked_run *checked)
{
  baum_simulation_destroy(checked->run);
  baum_workspace_destroy(checked->workspace);
}

static inline double largest_of(const double *values, int count)
{
  double largest = 0.0;
  for (int i = 0; i < count; i++) {
    largest = fabs(values[i]) > largest ? fabs(values[i]) : largest;
  }
  return largest;
}

/* Computes Phi at the present state of the run. */
static inline void evaluate_phi(const checked_run *checked, double phi[PHYSICS_NC])
{
  check(baum_workspace_phi(checked->workspace, baum_simulation_time(checked->run),
                           baum_simulation_q(checked->run), phi));
}

#endif
