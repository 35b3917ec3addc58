/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions that tests with reference trajectories share. Include after cmocka.h. */
#ifndef BAUM_TEST_REFERENCE_TEST_H
#define BAUM_TEST_REFERENCE_TEST_H

#include <math.h>
#include <stdio.h>

#include "check.h"
#include "reference.h"

/* Returns options for Adams with BAUMGARTE and the gains of the rule `auto`. */
static inline baum_simulation_options adams_options(void)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_cvode_adams();
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  return options;
}

/* Returns options for IDA with GGL. The equations of GGL contain the constraints on positions and
 * on velocities. */
static inline baum_simulation_options ggl_options(void)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_ida();
  options.formulation = BAUM_FORMULATION_GGL;
  return options;
}

/* Makes runs with a series of tolerances and prints them. Fails unless the error is at most
 * `wanted` at some rtol and at all smaller ones. */
static inline void assert_reached(const reference *with, const baum_mechanism *mechanism,
                                  const baum_simulation_options *options, double wanted)
{
  reference_ladder ladder = reference_climb(with, mechanism, options);
  double needed = reference_rtol_needed(&ladder, wanted);
  if (isnan(needed)) {
    fail_msg("%s: error %.3g at rtol 1e-12, wanted %.3g", with->name,
             ladder.runs[REFERENCE_RUNGS - 1].error, wanted);
  }
  printf("error %.0e needs rtol %.0e\n", wanted, needed);
}

/* Checks that RK4 with projection, which does not use SUNDIALS, has at most the error `wanted`. */
static inline void assert_reached_by_rk4(const reference *with, const baum_mechanism *mechanism,
                                         double step, double wanted)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.formulation = BAUM_FORMULATION_PROJECTION;
  options.step = step;
  reference_run run = reference_compare(with, mechanism, &options);
  printf("\n%s: rk4, projection, h = %g s: error %.2e, steps %lld %s\n", with->name, step,
         run.error, (long long)run.counters.steps, run.message);
  assert_true(run.status >= 0);
  assert_true(run.error <= wanted);
}

#endif
