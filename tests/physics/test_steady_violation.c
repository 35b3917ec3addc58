/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the steady violations of the Euler methods with Baumgarte's gains. After the initial
 * violation has decayed, every row must satisfy these equations, with gamma at the present state
 * (docs/theory/stabilization.md):
 *
 *   |Phi'_i| = (h / 2) |gamma_i|,   |Phi_i| = (alpha / beta^2) h |gamma_i|
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "assert_near.h"
#include "physics_run.h"

enum { SAMPLES = 40, STRIDE = 200, PAIRS = 6 };

/* Pairs of (alpha h, beta h). */
static const double GAINS[PAIRS][2] = {{0.3, 0.3}, {0.3, 0.7}, {0.5, 0.5},
                                       {0.5, 0.8}, {0.8, 0.4}, {0.8, 0.8}};

/* The largest allowed difference between a row and the formula, as a fraction of the value that the
 * formula gives. */
static const double TOLERANCE = 0.02;
/* An additional difference is allowed, which is LAG h omega times the largest value that the
 * formula gives. Phi follows gamma with a delay of 2 alpha / beta^2 + 1 / alpha. This delay is at
 * most 10 h. During this time, gamma changes by the fraction 10 h omega of its largest value. This
 * matters for rows whose gamma is near zero. */
static const double LAG = 10.0;

typedef struct motion {
  physics_mechanism which;
  double step;
  double rate; /* [rad/s] largest angular velocity */
} motion;

/* The pendulum starts in a horizontal position with a velocity of 3 m/s downwards, and reaches 5.4
 * rad/s. Gamma of its only row is therefore never near zero. The crank rotates at up to 150 rad/s.
 * In every run, the pendulum or the crank rotates by more than 1 rad. */
static const model_pendulum THROWN = {.gravity = 9.81, .x = 1.0, .v = -3.0};
static const motion MOTIONS[2] = {{PENDULUM, 1e-4, 5.4}, {FREE_CRANK, 1e-6, 150.0}};

static model build_motion(const motion *with)
{
  model out = {0};
  if (with->which != PENDULUM) {
    return build_mechanism(with->which);
  }
  check(model_pendulum_rod(&THROWN, &out));
  return out;
}

typedef struct deviation {
  /* Largest relative difference from the formula. Only rows whose |gamma| is above a tenth of the
   * largest |gamma| count. */
  double phi;
  double phi_rate;
} deviation;

static void compare_rows(const double *got, const double *gamma, double factor, double slack,
                         int nc, double *worst)
{
  double largest = largest_of(gamma, nc);
  for (int i = 0; i < nc; i++) {
    double want = factor * fabs(gamma[i]);
    ASSERT_NEAR(fabs(got[i]), want, TOLERANCE, slack * factor * largest);
    if (fabs(gamma[i]) > 0.1 * largest) {
      *worst = fmax(*worst, fabs(fabs(got[i]) / want - 1.0));
    }
  }
}

static void compare_state(const checked_run *checked, const motion *with, deviation *worst)
{
  const baum_channel channels[2] = {baum_channel_of(BAUM_PHI), baum_channel_of(BAUM_PHI_RATE)};
  double rows[2 * PHYSICS_NC];
  double gamma[PHYSICS_NC];
  double h = with->step;
  baum_counters c = counters_of(checked->run);
  check(baum_simulation_get(checked->run, channels, 2, rows));
  check(baum_workspace_gamma(checked->workspace, baum_simulation_time(checked->run),
                             baum_simulation_q(checked->run), baum_simulation_v(checked->run),
                             gamma));
  double slack = LAG * h * with->rate;
  compare_rows(rows, gamma, c.alpha / (c.beta * c.beta) * h, slack, checked->nc, &worst->phi);
  compare_rows(rows + checked->nc, gamma, h / 2, slack, checked->nc, &worst->phi_rate);
}

static checked_run start(const model *m, const motion *with, const baum_integrator *integrator,
                         const double pair[2])
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  options.gains = baum_gains_scaled(pair[0], pair[1] * pair[1]);
  options.step = with->step;
  return create_checked_run(m->mechanism, &options);
}

/* Compares the largest violation of the run with the largest violation that is predicted. Both are
 * in the counters. The two agree if gamma is largest late in the run, as it is for the pendulum.
 * For the free crank, gamma is largest at the start. At the start, however, Phi rises from zero and
 * overshoots like a step response, by at most 100 %. With explicit Euler and (alpha h, beta h) =
 * (0.3, 0.7), an overshoot of 90 % was measured. The amplification factors then have the modulus
 * 0.94. */
static void compare_counters(const checked_run *checked, physics_mechanism which)
{
  baum_counters c = counters_of(checked->run);
  printf("   max|Phi| %.3e predicted %.3e   max|Phi'| %.3e predicted %.3e\n", c.max_phi,
         c.predicted_phi, c.max_phi_rate, c.predicted_phi_rate);
  double most = which == PENDULUM ? 1.0 + TOLERANCE : 2.0;
  assert_true(c.max_phi >= (1.0 - TOLERANCE) * c.predicted_phi);
  assert_true(c.max_phi <= most * c.predicted_phi);
  assert_true(c.max_phi_rate >= (1.0 - TOLERANCE) * c.predicted_phi_rate);
  assert_true(c.max_phi_rate <= most * c.predicted_phi_rate);
}

static void follow(const baum_integrator *integrator, const motion *with, const double pair[2])
{
  model m = build_motion(with);
  checked_run checked = start(&m, with, integrator, pair);
  deviation worst = {0.0, 0.0};
  check(baum_simulation_step(checked.run, (int64_t)ceil(50.0 / pair[0])));
  for (int k = 0; k < SAMPLES; k++) {
    check(baum_simulation_step(checked.run, STRIDE));
    compare_state(&checked, with, &worst);
  }
  printf("%-20s %-18s %4.1f %4.1f   off by %5.2f %% %5.2f %%", baum_integrator_name(integrator),
         mechanism_name(with->which), pair[0], pair[1], 100.0 * worst.phi, 100.0 * worst.phi_rate);
  compare_counters(&checked, with->which);
  destroy_checked_run(&checked);
  model_destroy(&m);
}

static void follow_all(const baum_integrator *integrator)
{
  printf(
    "largest relative differences of |Phi| and |Phi'| from the formulas, for (alpha h, beta h)\n");
  for (int k = 0; k < 2 * PAIRS; k++) {
    const double *pair = GAINS[k % PAIRS];
    baum_amplification z;
    check(baum_stability_at(integrator, pair[0], pair[1] * pair[1], &z, sizeof z));
    assert_int_equal(z.stability, BAUM_STABLE);
    follow(integrator, &MOTIONS[k / PAIRS], pair);
  }
  (void)fflush(stdout);
}

static void explicit_euler_keeps_the_predicted_violation(void **state)
{
  (void)state;
  follow_all(baum_euler());
}

static void semi_implicit_euler_keeps_the_predicted_violation(void **state)
{
  (void)state;
  follow_all(baum_semi_implicit_euler());
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(explicit_euler_keeps_the_predicted_violation),
    cmocka_unit_test(semi_implicit_euler_keeps_the_predicted_violation),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
