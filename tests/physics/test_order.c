/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the order of every fixed-step integrator with every formulation. The step is halved
 * repeatedly for a pendulum, a free slider-crank and a four-bar, and the errors relative to
 * references are compared. The rule `auto` chooses the gains, which are the same for all these
 * steps. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "a01_pendulum_reference.h"
#include "assert_near.h"
#include "catalog/data/four_bar.h"
#include "catalog/data/slider_crank_eccentric.h"
#include "physics_run.h"
#include "reference.h"

enum { RUNGS = 4, METHODS = 10, ORDER_MAX = 4 };

/* The largest allowed difference between slope and order. There are 4 runs, and the step changes by
 * a factor of 8 from the first to the last. Suppose that an error term of the next order is 1/4 of
 * the error at the largest step. Even then, it changes the mean slope by less than 0.11. */
static const double TOLERANCE = 0.2;

/* `samples` is chosen so that runs end after 2 rad of the crank, or 3 rad of the pendulum. */
static const reference REFERENCES[] = {
  [PENDULUM] = {.samples = 3,
                .width = A01_PENDULUM_WIDTH,
                .t = A01_PENDULUM_T,
                .q = A01_PENDULUM_Q[0],
                .lengths = "mm"},
  [FREE_CRANK] = {.samples = 3,
                  .width = 9,
                  .t = SLIDER_CRANK_ECCENTRIC_T,
                  .entry = "slider_crank_eccentric",
                  .lengths = "mmrmmrmmr"},
  [FOUR_BAR] =
    {.samples = 5, .width = 9, .t = FOUR_BAR_T, .entry = "four_bar", .lengths = "mmrmmrmmr"},
};

/* Number of steps of the coarsest run, for each order. At order 4 with gains, the error term of
 * order 5 would dominate if there were fewer than 128 steps. The errors of the finest run are
 * between 1e-12 and 1e-3; the largest are those of order 1. Rounding errors are below 1e-13. Adams
 * methods have larger error terms of the next order, so their coarsest run has 4 times as many
 * steps. */
static const int COARSEST[ORDER_MAX + 1] = {0, 2048, 256, 128, 256};

/* Series of runs for orders 5 and 8. Their errors reach rounding before error terms of the next
 * order become small, particularly with gains. Each series therefore has fewer runs. Its slope may
 * exceed the order by `too_steep`. */
typedef struct high_ladder {
  int order;
  physics_mechanism which;
  int samples;
  int coarsest;
  int rungs;
  double too_steep; /* the largest allowed slope minus order */
} high_ladder;

static const high_ladder HIGH[] = {
  {5, PENDULUM, 3, 128, 3, 0.7},
  {5, FREE_CRANK, 3, 128, 3, 0.7},
  {5, FOUR_BAR, 9, 512, 2, 0.7},
  {8, PENDULUM, 3, 16, 2, (double)INFINITY},
  {8, FREE_CRANK, 3, 48, 2, (double)INFINITY},
  {8, FOUR_BAR, 5, 32, 2, (double)INFINITY},
};

static double error_at(const model *m, const reference *with, baum_simulation_options *options,
                       int steps, double *alpha)
{
  options->step = with->t[with->samples - 1] / steps;
  reference_run run = reference_compare(with, m->mechanism, options);
  if (run.status < BAUM_OK) {
    fail_msg("%s", run.message);
  }
  assert_int_equal(run.counters.short_steps, 0);
  *alpha = run.counters.alpha;
  return run.error;
}

/* Prints the errors of a series of runs and returns their mean slope. */
static double observe_order(const model *m, const reference *with, baum_simulation_options *options)
{
  bool multistep = strncmp(baum_integrator_name(options->integrator), "ab", 2) == 0;
  int steps = (multistep ? 4 : 1) * COARSEST[baum_integrator_order(options->integrator)];
  double error[RUNGS];
  double alpha[RUNGS];
  for (int k = 0; k < RUNGS; k++) {
    error[k] = error_at(m, with, options, steps << k, &alpha[k]);
    printf(" %9.2e", error[k]);
    assert_true(alpha[k] == alpha[0]);
  }
  for (int k = 1; k < RUNGS; k++) {
    printf(" %5.2f", log2(error[k - 1] / error[k]));
  }
  return log2(error[0] / error[RUNGS - 1]) / (RUNGS - 1);
}

static void compare_order(physics_mechanism which, const model *m,
                          const baum_integrator *integrator, baum_formulation formulation)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = formulation;
  if (formulation == BAUM_FORMULATION_BAUMGARTE) {
    options.gains = baum_gains_auto();
  }
  printf("%-18s %-20s %-12s", mechanism_name(which), baum_integrator_name(integrator),
         baum_formulation_name(formulation));
  double order = observe_order(m, &REFERENCES[which], &options);
  printf("   order %.2f\n", order);
  (void)fflush(stdout);
  ASSERT_NEAR(order, baum_integrator_order(integrator), 0.0, TOLERANCE);
}

static void compare_high_order(const high_ladder *ladder, const model *m,
                               const baum_integrator *integrator, baum_formulation formulation)
{
  baum_simulation_options options = baum_simulation_options_default();
  reference with = REFERENCES[ladder->which];
  double error[RUNGS];
  double alpha[RUNGS];
  with.samples = ladder->samples;
  options.integrator = integrator;
  options.formulation = formulation;
  printf("%-18s %-20s %-12s", mechanism_name(ladder->which), baum_integrator_name(integrator),
         baum_formulation_name(formulation));
  for (int k = 0; k < ladder->rungs; k++) {
    error[k] = error_at(m, &with, &options, ladder->coarsest << k, &alpha[k]);
    printf(" %9.2e", error[k]);
    assert_true(alpha[k] == alpha[0]);
  }
  double order = log2(error[0] / error[ladder->rungs - 1]) / (ladder->rungs - 1);
  printf("   order %.2f\n", order);
  (void)fflush(stdout);
  assert_true(order >= ladder->order - TOLERANCE);
  assert_true(order <= ladder->order + ladder->too_steep);
}

static void orders_5_and_8_are_kept(void **state)
{
  (void)state;
  printf("\nerrors with steps that are halved each time, mean slope\n");
  for (size_t i = 0; i < sizeof HIGH / sizeof HIGH[0]; i++) {
    const baum_integrator *integrator = HIGH[i].order == 5 ? baum_dp5() : baum_rk8();
    model m = build_mechanism(HIGH[i].which);
    assert_int_equal(baum_integrator_order(integrator), HIGH[i].order);
    compare_high_order(&HIGH[i], &m, integrator, BAUM_FORMULATION_PROJECTION);
    compare_high_order(&HIGH[i], &m, integrator, BAUM_FORMULATION_BAUMGARTE);
    compare_high_order(&HIGH[i], &m, integrator, BAUM_FORMULATION_UNSTABILIZED);
    model_destroy(&m);
  }
}

static void compare_all(baum_formulation formulation)
{
  static const physics_mechanism mechanisms[] = {PENDULUM, FREE_CRANK, FOUR_BAR};
  const baum_integrator *const methods[METHODS] = {baum_euler(),  baum_semi_implicit_euler(),
                                                   baum_rk2(),    baum_rk3(),
                                                   baum_rk4(),    baum_ab2(),
                                                   baum_ab3(),    baum_ab4(),
                                                   baum_rattle(), baum_generalized_alpha()};
  printf("\nerrors with steps that are halved each time, slopes between them, mean slope\n");
  for (int i = 0; i < 3; i++) {
    model m = build_mechanism(mechanisms[i]);
    for (int k = 0; k < METHODS; k++) {
      if (baum_integrator_offers(methods[k], formulation)) {
        compare_order(mechanisms[i], &m, methods[k], formulation);
      }
    }
    model_destroy(&m);
  }
}

static void baumgarte_with_constant_gains_keeps_the_order(void **state)
{
  (void)state;
  compare_all(BAUM_FORMULATION_BAUMGARTE);
}

static void no_stabilization_keeps_the_order(void **state)
{
  (void)state;
  compare_all(BAUM_FORMULATION_UNSTABILIZED);
}

static void projection_keeps_the_order(void **state)
{
  (void)state;
  compare_all(BAUM_FORMULATION_PROJECTION);
}

static void index_3_methods_have_their_order(void **state)
{
  (void)state;
  compare_all(BAUM_FORMULATION_INDEX3);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(baumgarte_with_constant_gains_keeps_the_order),
    cmocka_unit_test(no_stabilization_keeps_the_order),
    cmocka_unit_test(projection_keeps_the_order),
    cmocka_unit_test(index_3_methods_have_their_order),
    cmocka_unit_test(orders_5_and_8_are_kept),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
