/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests gains of single rows, with integrators that choose their steps. If alpha = beta = b
 * and a row has the factor f, this row satisfies in any mechanism
 *
 *   Phi'' + 2 b f Phi' + (b f)^2 Phi = 0,   Phi = Phi_0 (1 + b f t) exp(-b f t)
 *
 * Adams methods include the factor of every row in their iteration. BDF and IDA include it in their
 * matrices.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "models.h"
#include "runs.h"

enum { METHODS = 4, ROWS = 8, SAMPLES = 4 };
static const char *const NAMES[METHODS] = {"cvode_adams", "cvode_bdf", "ida", "rk8"};

/* Returns the integrator, or NULL if this build does not have it. */
static const baum_integrator *find(const char *name)
{
  const baum_integrator *found = NULL;
  for (int k = 0; baum_integrator_at(k); k++) {
    const baum_integrator *at = baum_integrator_at(k);
    found = strcmp(baum_integrator_name(at), name) == 0 ? at : found;
  }
  /* Among the tested integrators, only those without a fixed step need SUNDIALS. */
  bool runs = found && (baum_has("sundials") || baum_integrator_has_fixed_step(found));
  return runs ? found : NULL;
}

static baum_simulation *begin(const baum_mechanism *m, const baum_integrator *integrator,
                              double gain, const double *factors)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.formulation = BAUM_FORMULATION_BAUMGARTE;
  o.gains = baum_gains_fixed(gain, gain);
  o.rtol = 1e-8;
  o.start = BAUM_START_AS_GIVEN;
  o.row_gains = factors;
  o.row_gain_count = factors ? ROWS : 0;
  return create_run(m, &o);
}

static const double FACTORS[ROWS] = {0.5, 0.25, 2.0, 4.0, 1.0, 3.0, 0.7, 1.5};

/* Moves a slider-crank so that it violates every row slightly. Sets `phi` to the violations. */
static void start_with_violations(baum_simulation *run, double *phi)
{
  const baum_channel violation = baum_channel_of(BAUM_PHI);
  double q[9];
  double v[9] = {0.0};
  memcpy(q, baum_simulation_q(run), sizeof q);
  for (int i = 0; i < 9; i++) {
    q[i] += 1e-4 * (i % 2 == 0 ? 1.0 + 0.1 * i : -1.0);
  }
  assert_true(baum_simulation_set_state(run, 0.0, q, v) >= BAUM_OK);
  assert_int_equal(baum_simulation_get(run, &violation, 1, phi), BAUM_OK);
}

static void check_decay(const baum_mechanism *m, const char *name, double gain)
{
  const baum_channel violation = baum_channel_of(BAUM_PHI);
  double times[SAMPLES];
  double rows[SAMPLES * ROWS];
  double start[ROWS];
  baum_simulation *run = begin(m, find(name), gain, FACTORS);
  start_with_violations(run, start);
  for (int k = 0; k < SAMPLES; k++) {
    times[k] = 0.7 * (k + 1) / gain;
  }
  if (baum_simulation_sample(run, times, SAMPLES, &violation, 1, rows, NULL) < BAUM_OK) {
    fail_msg("%s: %s", name, baum_message());
  }
  for (int k = 0; k < SAMPLES * ROWS; k++) {
    double decay = gain * FACTORS[k % ROWS] * times[k / ROWS];
    double want = start[k % ROWS] * (1.0 + decay) * exp(-decay);
    assert_true(fabs(start[k % ROWS]) > 1e-5);
    /* The tolerance allows for the errors of several hundred steps at rtol 1e-8, with lengths below
     * 1 m. An error of 1e-6 or more would show that a factor is missing in some term. */
    ASSERT_NEAR(rows[k], want, 0.0, 1e-7);
  }
  baum_simulation_destroy(run);
}

static void each_row_decays_with_its_own_gains(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.rough = true}, &m), BAUM_OK);
  for (int k = 0; k < METHODS; k++) {
    if (find(NAMES[k])) {
      check_decay(m.mechanism, NAMES[k], 50.0);
      check_decay(m.mechanism, NAMES[k], 1000.0);
    }
  }
  model_destroy(&m);
}

static void each_row_decays_with_its_own_gains_backward_in_time(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.rough = true}, &m), BAUM_OK);
  for (int k = 0; k < METHODS; k++) {
    if (find(NAMES[k])) {
      double start[ROWS];
      double end[ROWS];
      const baum_channel violation = baum_channel_of(BAUM_PHI);
      baum_simulation *run = begin(m.mechanism, find(NAMES[k]), 50.0, FACTORS);
      start_with_violations(run, start);
      assert_true(baum_simulation_advance_to(run, -0.02) >= BAUM_OK);
      assert_int_equal(baum_simulation_get(run, &violation, 1, end), BAUM_OK);
      for (int i = 0; i < ROWS; i++) {
        ASSERT_NEAR(end[i], start[i] * (1.0 + FACTORS[i]) * exp(-FACTORS[i]), 0.0,
                    1e-7); /* the tolerance is explained above */
      }
      baum_simulation_destroy(run);
    }
  }
  model_destroy(&m);
}

static baum_counters count_steps(const baum_mechanism *m, const char *name, double gain,
                                 const double *factors)
{
  baum_simulation *run = begin(m, find(name), gain, factors);
  if (baum_simulation_advance_to(run, 0.05) < BAUM_OK) {
    fail_msg("%s: %s", name, baum_message());
  }
  baum_counters counters = counters_of(run);
  baum_simulation_destroy(run);
  return counters;
}

/* The gains reach 4e4 1/s. A plain fixed-point iteration converges only if 2 alpha h < 2, so it
 * would require 2000 steps. CVODE Adams, CVODE BDF and IDA were measured to take 620, 440 and 580
 * steps. With equal gains of 1e4 1/s they take 340, 370 and 390 steps. */
static void steps_do_not_become_much_shorter(void **state)
{
  (void)state;
  static const double ones[ROWS] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.moving = true}, &m), BAUM_OK);
  for (int k = 0; k < METHODS - 1; k++) {
    if (find(NAMES[k])) {
      baum_counters equal = count_steps(m.mechanism, NAMES[k], 1e4, NULL);
      baum_counters with_ones = count_steps(m.mechanism, NAMES[k], 1e4, ones);
      baum_counters own = count_steps(m.mechanism, NAMES[k], 1e4, FACTORS);
      /* Factors of 1 leave the gains unchanged. The order of summation differs, however, so
       * rounding may change the number of steps slightly. */
      ASSERT_NEAR((double)with_ones.steps, (double)equal.steps, 0.1, 0.0);
      assert_in_range(own.steps, 1, 1000);
      assert_in_range(own.nonlinear_iterations, 1, 2000);
    }
  }
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(each_row_decays_with_its_own_gains),
    cmocka_unit_test(each_row_decays_with_its_own_gains_backward_in_time),
    cmocka_unit_test(steps_do_not_become_much_shorter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
