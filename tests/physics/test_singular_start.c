/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests runs that start in a singular configuration or very close to one. Runs with variable steps
 * must either continue with a warning, or end with a message. Both must happen after few steps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "models.h"
#include "runs.h"

/* The largest allowed number of accepted and rejected steps together. A run leaves the singular
 * configuration in a few steps, or it ends after 10 unsuccessful attempts. The largest number that
 * was measured is 34. It depends on rounding. A run that did not make progress would need more than
 * a hundred thousand steps. */
enum { MOST_TRIES = 1000 };

/* [s] the cranks start with 3 rad/s and rotate by almost 1 rad until this time */
static const double END = 0.3;
static const double TOLERANCES[] = {1e-5, 1e-7, 1e-9, 1e-11};

static baum_simulation *create(const model *m, const baum_integrator *integrator, double rtol)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = BAUM_FORMULATION_PROJECTION;
  options.rtol = rtol;
  return create_run(m->mechanism, &options);
}

/* Advances to `end`. Checks that the run needs only few steps to reach `end` or to stop with a
 * message. */
static baum_status run_to(baum_simulation *run, double end)
{
  baum_status status = baum_simulation_advance_to(run, end);
  if (status < BAUM_OK) {
    assert_non_null(strstr(baum_simulation_message(run), "at the last good step"));
  }
  baum_counters c = counters_of(run);
  assert_true(c.steps + c.rejected <= MOST_TRIES);
  return status;
}

/* ---- four-bars ---- */

/* `want` is the angle of the cranks at END [rad]. If it is NaN, a run that ends with a message is
 * also accepted. */
static void run_all(int loops, double angle, double rate, double want)
{
  model m;
  model_n_four_bar data = model_n_four_bar_a02(loops);
  data.angle = angle;
  data.rate = rate;
  assert_int_equal(model_n_four_bar_build(&data, &m), BAUM_OK);
  for (int k = 0; k < 8; k++) {
    baum_simulation *run = create(&m, k % 2 == 0 ? baum_rk8() : baum_dp5(), TOLERANCES[k / 2]);
    baum_status status = run_to(run, END);
    assert_true(status == BAUM_WARNED || (isnan(want) && status < BAUM_OK));
    for (int i = 2; !isnan(want) && i < 3 * m.body_count; i += 6) {
      /* On another branch, the angles would differ by radians. The largest error, 2e-5 rad, is that
       * of dp5 at the loosest tolerance. */
      assert_true(fabs(baum_simulation_q(run)[i] - want) <= 1e-4);
    }
    baum_simulation_destroy(run);
  }
  model_destroy(&m);
}

/* These are solutions of [(N + 1) / 3 + N] th'' = -[(N + 1) / 2 + N] g cos th, which start at
 * th = 0 with 3 rad/s. N is `loops`. They were computed by the classical Runge-Kutta method with
 * steps of 1e-5 s. */
static const struct {
  int loops;
  double want; /* [rad] angle at END */
} LEVEL[] = {{1, 0.38584123}, {2, 0.40053536}, {5, 0.41102074}, {20, 0.41684209}};

static void a_moving_run_follows_the_exact_motion(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof LEVEL / sizeof LEVEL[0]; k++) {
    run_all(LEVEL[k].loops, 0.0, 3.0, LEVEL[k].want);
    run_all(LEVEL[k].loops, 1e-9, 3.0, LEVEL[k].want);
  }
}

static void a_run_from_rest_continues_with_a_warning_or_ends(void **state)
{
  (void)state;
  run_all(1, 0.0, 0.0, (double)NAN);
  run_all(2, 0.0, 0.0, (double)NAN);
}

/* ---- slider-crank of equal links ---- */

/* Sets a state in which the crank angle is pi/2 + off. The crank rotates at 150 rad/s, and the rod
 * rotates in the opposite direction. The angle of the rod is set directly. Assembly would compute
 * it from the sine of the crank angle, which loses half of the digits near pi/2. */
static void fold(baum_simulation *run, double off)
{
  static const double L = 0.153;
  static const double RATE = 150.0;
  double x = -L * sin(off);
  double y = L * cos(off);
  double angle = asin(1.0) + off;
  const double q[9] = {0.5 * x, 0.5 * y, angle, 1.5 * x, 0.5 * y, -angle, 2.0 * x, 0.0, 0.0};
  const double v[9] = {-0.5 * RATE * y,
                       0.5 * RATE * x,
                       RATE,
                       -1.5 * RATE * y,
                       0.5 * RATE * x,
                       -RATE,
                       -2.0 * RATE * y,
                       0.0,
                       0.0};
  assert_true(baum_simulation_set_state(run, 0.0, q, v) >= BAUM_OK);
}

static void leave_fold(const model *m, const baum_integrator *integrator, double rtol, double off)
{
  baum_simulation *run = create(m, integrator, rtol);
  fold(run, off);
  baum_status status = run_to(run, 0.01);
  if (status >= BAUM_OK) {
    /* On the other branch, the rod would rotate together with the crank. This would make a
     * difference of 3 rad. */
    assert_true(fabs(baum_simulation_q(run)[2] + baum_simulation_q(run)[5]) <= 1e-3);
  }
  baum_simulation_destroy(run);
}

static void a_run_that_starts_near_a_folded_configuration_needs_few_steps(void **state)
{
  (void)state;
  const model_slider_crank data = {.centric = true, .rod = 0.153, .angle = 0.3, .moving = true};
  model m;
  assert_int_equal(model_slider_crank_build(data, &m), BAUM_OK);
  for (double off = 1e-6; off > 1e-13; off *= 0.1) {
    for (int sign = -1; sign <= 1; sign += 2) {
      leave_fold(&m, baum_rk8(), 1e-9, sign * off);
      leave_fold(&m, baum_dp5(), 1e-6, sign * off);
#if BAUM_HAVE_SUNDIALS
      leave_fold(&m, baum_cvode_bdf(), 1e-6, sign * off);
      leave_fold(&m, baum_cvode_bdf(), 1e-9, sign * off);
#endif
    }
  }
  model_destroy(&m);
}

/* ---- set states ---- */

/* The pivots of three almost point-like links in a chain are below 1e-4 in every configuration. At
 * such a start, rk8 and dp5 also evaluate another configuration. The run must not take the
 * violation of that configuration for its own. */
static void a_set_state_with_a_small_pivot_has_its_own_violation(void **state)
{
  (void)state;
  const baum_integrator *const pairs[2] = {baum_rk8(), baum_dp5()};
  baum_mechanism *m = create_mechanism();
  baum_body_id last = BAUM_GROUND;
  for (int k = 0; k < 3; k++) {
    baum_planar_body_def link = baum_planar_body_def_default();
    baum_body_id id;
    link.inertia = 1e-5;
    link.position[0] = k + 0.5;
    assert_int_equal(baum_mechanism_add_planar_body(m, &link, &id), BAUM_OK);
    (void)add_planar_pin(m, NULL, last, id, k, 0.0);
    last = id;
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  const model chain = {.mechanism = m};
  for (int k = 0; k < 2; k++) {
    baum_simulation *first = create(&chain, pairs[k], 1e-8);
    baum_simulation *second = create(&chain, pairs[k], 1e-8);
    assert_int_equal(baum_simulation_advance_to(first, 0.5), BAUM_OK);
    assert_int_equal(
      baum_simulation_set_state(second, 0.5, baum_simulation_q(first), baum_simulation_v(first)),
      BAUM_OK);
    assert_true(counters_of(second).max_phi <= 1e-14);
    baum_simulation_destroy(first);
    baum_simulation_destroy(second);
  }
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_moving_run_follows_the_exact_motion),
    cmocka_unit_test(a_run_from_rest_continues_with_a_warning_or_ends),
    cmocka_unit_test(a_run_that_starts_near_a_folded_configuration_needs_few_steps),
    cmocka_unit_test(a_set_state_with_a_small_pivot_has_its_own_violation),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
