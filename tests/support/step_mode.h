/* SPDX-License-Identifier: BSD-3-Clause */
/* Integrators in each of their ways to step: of one length, or of their own choice. Include after
 * cmocka.h. */
#ifndef BAUM_TEST_STEP_MODE_H
#define BAUM_TEST_STEP_MODE_H

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include <baum/baum.h>

typedef struct step_mode {
  const baum_integrator *integrator; /* NULL past the end */
  bool fixed;
} step_mode;

/* The k-th of all that this build can run where freedom is left. */
static inline step_mode step_mode_at(int k)
{
  for (int32_t i = 0; baum_integrator_at(i); i++) {
    const baum_integrator *integrator = baum_integrator_at(i);
    bool fixed = baum_integrator_has_fixed_step(integrator);
    if (fixed && k-- == 0) {
      return (step_mode){integrator, true};
    }
    /* All that has no fixed step is of SUNDIALS. */
    bool variable = baum_integrator_has_variable_step(integrator);
    if (variable && (fixed || baum_has("sundials")) && k-- == 0) {
      return (step_mode){integrator, false};
    }
  }
  return (step_mode){NULL, false};
}

/* One of Adams' explicit methods. */
static inline bool step_mode_is_adams(step_mode mode)
{
  return strncmp(baum_integrator_name(mode.integrator), "ab", 2) == 0;
}

/* Steps of its own choice and multistep methods restart where a motion is changed. */
static inline bool step_mode_remembers(step_mode mode)
{
  bool alpha = strcmp(baum_integrator_name(mode.integrator), "generalized_alpha") == 0;
  return !mode.fixed || step_mode_is_adams(mode) || alpha;
}

/* Advance. Methods of first order, whose errors the tests know, may warn of these. */
static inline baum_status step_mode_advance(step_mode mode, baum_simulation *run, double t)
{
  baum_status status = baum_simulation_advance_to(run, t);
  bool may_warn = mode.fixed && baum_integrator_order(mode.integrator) == 1;
  return status == BAUM_WARNED && may_warn ? BAUM_OK : status;
}

/* Options of a mode: a step or a tolerance. */
static inline baum_simulation_options step_mode_options(step_mode mode, double step, double rtol)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = mode.integrator;
  options.step = mode.fixed ? step : (double)NAN;
  options.rtol = mode.fixed ? (double)NAN : rtol;
  return options;
}

#endif
