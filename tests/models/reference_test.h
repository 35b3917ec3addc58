/* SPDX-License-Identifier: BSD-3-Clause */
/* Shared by tests against reference trajectories. Include after cmocka.h. */
#ifndef BAUM_TEST_REFERENCE_TEST_H
#define BAUM_TEST_REFERENCE_TEST_H

#include <math.h>
#include <stdio.h>

#include "check.h"
#include "reference.h"

/* Adams with BAUMGARTE and gains by the rule `auto`. */
static inline baum_simulation_options adams_options(void)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_cvode_adams();
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  return options;
}

/* IDA with GGL: constraints on positions and velocities are among its equations. */
static inline baum_simulation_options ggl_options(void)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_ida();
  options.formulation = BAUM_FORMULATION_GGL;
  return options;
}

/* Runs and prints a series of tolerances; fails unless the error reaches `wanted` at some rtol and
 * keeps it at all tighter ones. */
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

/* Checks the same values by RK4 with projection, which does not use SUNDIALS. */
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
