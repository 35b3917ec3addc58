/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the order of every fixed-step integrator for mechanisms whose positions are on a manifold.
 * The mechanisms are three tops, and a slider-crank whose bodies represent their angle by (cos,
 * sin). The step is halved repeatedly, and the errors are compared. The rule `auto` chooses the
 * gains, which are the same for all these steps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "manifold_scenes.h"
#include "runs.h"
#include "step_mode.h"

enum { SIZE = MANIFOLD_SIZE, RUNGS = 3 };

static const double END = 0.5;

/* Limits of the difference between the slope and the order. They are wider than those in
 * test_order.c. The runs take only half a second, so that error terms of the next order are larger.
 * Such terms may also increase the slope. */
static const double TOO_FLAT = 0.25;
/* This is the limit for the orders 5 and 8, instead of TOO_FLAT. It still finds wrong coefficients,
 * because these would give slopes of at most 2. */
static const double TOO_FLAT_HIGH = 0.6;
static const double TOO_STEEP = 0.8;

/* Number of steps of the coarsest run, for each order. With these numbers, the errors of the finest
 * run are far above 1e-11, the error of the reference. */
static const int COARSEST[9] = {0, 2000, 200, 100, 100, 32, 0, 0, 5};

static double error_at(const manifold_scene *scene, const double *want,
                       baum_simulation_options *options, int steps)
{
  int32_t nq;
  double error = 0.0;
  baum_mechanism *mechanism = manifold_scene_make(scene);
  options->step = END / steps;
  check(baum_mechanism_sizes(mechanism, &nq, NULL, NULL));
  baum_simulation *run = create_run(mechanism, options);
  check(baum_simulation_advance_to(run, END));
  for (int i = 0; i < nq; i++) {
    error = fmax(error, fabs(baum_simulation_q(run)[i] - want[i]));
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return error;
}

static void observe(const manifold_scene *scene, const double *want,
                    const baum_integrator *integrator, baum_formulation formulation)
{
  int order = baum_integrator_order(integrator);
  bool multistep = step_mode_is_adams((step_mode){integrator, true});
  double error[RUNGS];
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = formulation;
  if (formulation == BAUM_FORMULATION_BAUMGARTE) {
    options.gains = baum_gains_auto();
  }
  printf("%-28s %-20s %-12s", scene->name, baum_integrator_name(integrator),
         baum_formulation_name(formulation));
  int rungs = order == 8 ? 2 : RUNGS;
  for (int k = 0; k < rungs; k++) {
    error[k] = error_at(scene, want, &options, (multistep ? 4 : 1) * COARSEST[order] << k);
    printf(" %9.2e", error[k]);
  }
  double slope = log2(error[0] / error[rungs - 1]) / (rungs - 1);
  printf("   order %.2f\n", slope);
  (void)fflush(stdout);
  bool high = order >= 5; /* the errors of these orders are so small that rounding matters */
  double flat = high ? TOO_FLAT_HIGH : TOO_FLAT;
  if (!(slope >= order - flat && (high || slope <= order + TOO_STEEP))) {
    fail_msg("%s by %s, %s: order %.2f", scene->name, baum_integrator_name(integrator),
             baum_formulation_name(formulation), slope);
  }
}

static void observe_all(const char *name)
{
  const manifold_scene *scene = manifold_scene_find(name);
  double want[SIZE];
  manifold_scene_solve(scene, END, want);
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    bool refused = scene->refuses_rattle && mode.integrator == baum_rattle();
    for (int f = BAUM_FORMULATION_DEFAULT + 1; baum_formulation_name((baum_formulation)f); f++) {
      if (mode.fixed && !refused && baum_integrator_offers(mode.integrator, (baum_formulation)f)) {
        observe(scene, want, mode.integrator, (baum_formulation)f);
      }
    }
  }
}

static void bodies_with_cosine_and_sine_keep_the_order(void **state)
{
  (void)state;
  observe_all("slider-crank");
}

static void tops_keep_the_order(void **state)
{
  (void)state;
  observe_all("heavy top with its Jacobian");
  observe_all("ball");
  observe_all("spatial heavy top");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(bodies_with_cosine_and_sine_keep_the_order),
    cmocka_unit_test(tops_keep_the_order),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
