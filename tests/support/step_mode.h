/* SPDX-License-Identifier: BSD-3-Clause */
/* Lists all pairs of an integrator and a kind of step (fixed or variable) that the integrator has.
 * Include after cmocka.h. */
#ifndef BAUM_TEST_STEP_MODE_H
#define BAUM_TEST_STEP_MODE_H

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include <baum/baum.h>

typedef struct step_mode {
  const baum_integrator *integrator; /* NULL after the last pair */
  bool fixed;
} step_mode;

/* Returns pair number k of an integrator and a kind of step. The list contains the integrators of
 * this build for mechanisms with degrees of freedom. */
static inline step_mode step_mode_at(int k)
{
  for (int32_t i = 0; baum_integrator_at(i); i++) {
    const baum_integrator *integrator = baum_integrator_at(i);
    bool fixed = baum_integrator_has_fixed_step(integrator);
    if (fixed && k-- == 0) {
      return (step_mode){integrator, true};
    }
    /* An integrator that has only variable steps needs SUNDIALS. */
    bool variable = baum_integrator_has_variable_step(integrator);
    if (variable && (fixed || baum_has("sundials")) && k-- == 0) {
      return (step_mode){integrator, false};
    }
  }
  return (step_mode){NULL, false};
}

/* Tells whether the method is an Adams-Bashforth method. */
static inline bool step_mode_is_adams(step_mode mode)
{
  return strncmp(baum_integrator_name(mode.integrator), "ab", 2) == 0;
}

/* Tells whether the method uses data of earlier steps. Such a method restarts if the motion has a
 * jump. These are all methods with variable steps, the multistep methods, and the generalized-alpha
 * method. */
static inline bool step_mode_remembers(step_mode mode)
{
  bool alpha = strcmp(baum_integrator_name(mode.integrator), "generalized_alpha") == 0;
  return !mode.fixed || step_mode_is_adams(mode) || alpha;
}

/* Advances to t. Warnings of first-order methods are accepted, because the tests allow for the
 * errors of these methods. */
static inline baum_status step_mode_advance(step_mode mode, baum_simulation *run, double t)
{
  baum_status status = baum_simulation_advance_to(run, t);
  bool may_warn = mode.fixed && baum_integrator_order(mode.integrator) == 1;
  return status == BAUM_WARNED && may_warn ? BAUM_OK : status;
}

/* Returns options with a fixed step or with a tolerance, depending on the kind of step. */
static inline baum_simulation_options step_mode_options(step_mode mode, double step, double rtol)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = mode.integrator;
  options.step = mode.fixed ? step : (double)NAN;
  options.rtol = mode.fixed ? (double)NAN : rtol;
  return options;
}

#endif
