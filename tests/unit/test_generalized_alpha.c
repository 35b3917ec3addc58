/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the generalized-alpha method: the order of q, v and lambda, the damping of fast modes,
 * stiff forces, redundant rows, and shortened steps. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "integrate/generalized_alpha.h"
#include "integrator_run.h"
#include "message.h"
#include "models.h"
#include "one_coordinate.h"
#include "runs.h"
#include "user_models.h"

static baum_simulation_options options_with(const baum_integrator *integrator, double step)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.step = step;
  return options;
}

static model make_crank(model_slider_crank with)
{
  model m = {0};
  check(model_slider_crank_build(with, &m));
  return m;
}

/* ---- one coordinate: x'' = -w^2 x - 2 d w x' ---- */

typedef struct oscillator {
  double w;
  double d;
} oscillator;

static int pull(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)t;
  (void)inputs;
  const oscillator *o = user;
  out[0] = -o->w * (o->w * q[0] + 2.0 * o->d * v[0]);
  return 0;
}

/* Makes an oscillator that starts from rest at x = 1. */
static baum_mechanism *make_oscillating(oscillator *o)
{
  return one_coordinate(1.0, 0.0, pull, o, NULL);
}

/* If w h = 1e4, the three roots of the method are nearly equal. They differ from -rho = -0.8 by
 * about 1e-4. The amplitude after k steps is therefore about k^2 rho^k. */
static void modes_that_are_too_fast_decay_by_rho_per_step(void **state)
{
  (void)state;
  oscillator o = {.w = 1e6};
  baum_mechanism *mechanism = make_oscillating(&o);
  baum_simulation_options options = options_with(baum_generalized_alpha(), 1e-2);
  baum_simulation *run = create_run(mechanism, &options);
  check(baum_simulation_step(run, 100));
  double before = baum_simulation_q(run)[0];
  check(baum_simulation_step(run, 1));
  /* (101 / 100)^2 = 1 + 2 / 100 + ... The tolerance 2e-3 allows for the other terms and for the
   * differences of the roots. */
  ASSERT_NEAR(baum_simulation_q(run)[0] / before, -0.8 * (1.0 + 2.0 / 100.0), 2e-3, 0.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

/* The decay rate of the velocity is 1e4 1/s, and the steps are 10 ms long. Explicit methods are
 * unstable with such steps. The slow motion, which is x = exp(-w t / (2 d)) for d >> 1, is
 * accurate. The error comes from the first steps, because they do not resolve the transition from
 * rest to the slow motion. The measured error is 3e-4, which is a fraction of (w h)^2 = 1e-2. */
static void a_stiff_damper_needs_no_small_steps(void **state)
{
  (void)state;
  oscillator o = {.w = 10.0, .d = 500.0};
  baum_mechanism *mechanism = make_oscillating(&o);
  baum_simulation_options options = options_with(baum_generalized_alpha(), 1e-2);
  baum_simulation *run = create_run(mechanism, &options);
  check(baum_simulation_advance_to(run, 10.0));
  double slow = o.w * (o.d - sqrt(o.d * o.d - 1.0));
  ASSERT_NEAR(baum_simulation_q(run)[0], exp(-10.0 * slow), 1e-3, 0.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

/* ---- order ---- */

/* Returns the final position error of a pendulum (1 m, 1 kg), and sets the errors of its velocity
 * and of its multiplier. Equation (5) of docs/theory/formulations.md gives the exact multiplier at
 * the exact state. */
static double errors_at(double step, double *velocity, double *multiplier)
{
  baum_mechanism *mechanism = make_pendulum();
  integrator_setup setup =
    integrator_setup_make(mechanism, baum_generalized_alpha(), BAUM_FORMULATION_INDEX3);
  setup.step = step;
  integrator_run run;
  double q[2];
  double v[2];
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  assert_int_equal(integrator_run_to(&run, 1.6), BAUM_OK);
  pendulum_motion(1.6, q, v);
  double lambda = baum_i_generalized_alpha_multipliers(run.self)[0];
  assert_int_equal(baum_i_acceleration(run.workspace, 1.6, q, v, 0.0, 0.0), BAUM_OK);
  *multiplier = fabs(lambda - run.workspace->lambda[0]);
  *velocity = hypot(run.v[0] - v[0], run.v[1] - v[1]);
  double error = hypot(run.q[0] - q[0], run.q[1] - q[1]);
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
  return error;
}

static void positions_velocities_and_multipliers_are_of_order_2(void **state)
{
  (void)state;
  double coarse[3];
  double fine[3];
  coarse[0] = errors_at(4e-3, &coarse[1], &coarse[2]);
  fine[0] = errors_at(5e-4, &fine[1], &fine[2]);
  for (int k = 0; k < 3; k++) {
    double order = log2(coarse[k] / fine[k]) / 3.0;
    print_message("order %.3f of %s: errors %.3g and %.3g\n", order,
                  k == 0 ? "q" : (k == 1 ? "v" : "lambda"), coarse[k], fine[k]);
    ASSERT_NEAR(order, 2.0, 0.0, 0.2);
  }
}

/* Compares multipliers after five steps. If the method used the acceleration at the start as its
 * auxiliary acceleration, the multipliers would have order 1 at first. */
static void multipliers_are_of_order_2_from_the_start(void **state)
{
  (void)state;
  double error[2];
  for (int k = 0; k < 2; k++) {
    double step = k == 0 ? 4e-3 : 5e-4;
    baum_mechanism *mechanism = make_pendulum();
    integrator_setup setup =
      integrator_setup_make(mechanism, baum_generalized_alpha(), BAUM_FORMULATION_INDEX3);
    setup.step = step;
    integrator_run run;
    double q[2];
    double v[2];
    assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
    assert_int_equal(integrator_run_to(&run, 5.0 * step), BAUM_OK);
    double lambda = baum_i_generalized_alpha_multipliers(run.self)[0];
    pendulum_motion(5.0 * step, q, v);
    assert_int_equal(baum_i_acceleration(run.workspace, 5.0 * step, q, v, 0.0, 0.0), BAUM_OK);
    error[k] = fabs(lambda - run.workspace->lambda[0]);
    integrator_run_close(&run);
    baum_mechanism_destroy(mechanism);
  }
  double order = log2(error[0] / error[1]) / 3.0;
  print_message("order %.3f of lambda after five steps: %.3g and %.3g\n", order, error[0],
                error[1]);
  assert_true(order > 1.8);
}

/* ---- runs ---- */

static void positions_satisfy_the_constraints_to_rounding(void **state)
{
  (void)state;
  model m = make_crank((model_slider_crank){0});
  baum_simulation_options options = options_with(baum_generalized_alpha(), 1e-4);
  baum_simulation *run = create_run(m.mechanism, &options);
  check(baum_simulation_step(run, 1000));
  baum_counters c = counters_of(run);
  assert_true(c.max_phi <= 1e-14);     /* rounding errors of lengths of 1 m and of angles */
  assert_true(c.max_phi_rate > 1e-9);  /* the velocity error is O(h^2) */
  assert_true(c.max_phi_rate <= 1e-2); /* speeds are up to 45 m/s */
  assert_int_equal(c.rejected, 0);
  assert_int_equal(c.warnings, 0);
  assert_true(c.nonlinear_iterations >= 1000 && c.nonlinear_iterations <= 4000);
  assert_true(c.full_factorizations <= 20); /* later steps reuse the pivots */
  baum_simulation_destroy(run);
  model_destroy(&m);
}

static void end_of(const model *m, baum_simulation_options *options, double *q)
{
  baum_simulation *run = create_run(m->mechanism, options);
  check(baum_simulation_advance_to(run, 0.03));
  memcpy(q, baum_simulation_q(run), 9 * sizeof *q);
  baum_simulation_destroy(run);
}

/* A second guide on the same line changes only the matrix of the iteration. The two motions
 * therefore differ by at most the tolerance of the iteration. */
static void redundant_rows_do_not_change_the_motion(void **state)
{
  (void)state;
  model plain = make_crank((model_slider_crank){0});
  model doubled = make_crank((model_slider_crank){.doubled_guide = true});
  baum_simulation_options options = options_with(baum_generalized_alpha(), 1e-4);
  double want[9];
  double got[9];
  end_of(&plain, &options, want);
  end_of(&doubled, &options, got);
  for (int i = 0; i < 9; i++) {
    ASSERT_NEAR(got[i], want[i], 0.0, 1e-10);
  }
  model_destroy(&plain);
  model_destroy(&doubled);
}

/* The start is 0.01 m off the circle and has a velocity component along the rod. The first step
 * removes both errors, but keeps the velocity component along the circle. */
static void a_start_off_the_constraints_is_projected(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_pendulum();
  baum_simulation_options options = options_with(baum_generalized_alpha(), 1e-4);
  options.start = BAUM_START_AS_GIVEN;
  baum_simulation *run = create_run(mechanism, &options);
  const double q[2] = {1.01, 0.0};
  const double v[2] = {0.3, 1.0};
  check(baum_simulation_set_state(run, 0.0, q, v));
  check(baum_simulation_step(run, 1));
  assert_true(fabs(hypot(baum_simulation_q(run)[0], baum_simulation_q(run)[1]) - 1.0) <= 1e-14);
  ASSERT_NEAR(baum_simulation_v(run)[1], 1.0 - 9.81e-4, 0.0, 1e-6); /* an error of O(h^2) */
  ASSERT_NEAR(baum_simulation_v(run)[0], -1e-4, 0.0, 1e-6);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

/* Samples at one third and at two thirds of every step do not change the motion. The samples are as
 * accurate as the results at grid points. */
static void samples_between_grid_points_change_nothing(void **state)
{
  (void)state;
  enum { SAMPLES = 300 };
  const baum_channel channel = baum_channel_of(BAUM_Q);
  const double step = 1.0 / 64.0;
  double times[SAMPLES];
  double rows[SAMPLES];
  oscillator o = {.w = 1.0};
  baum_mechanism *mechanism = make_oscillating(&o);
  baum_simulation_options options = options_with(baum_generalized_alpha(), step);
  baum_simulation *sampled = create_run(mechanism, &options);
  baum_simulation *plain = create_run(mechanism, &options);
  double error[2] = {0.0, 0.0};
  for (int i = 0; i < SAMPLES; i++) {
    times[i] = step * (i + 1) / 3.0;
  }
  check(baum_simulation_sample(sampled, times, SAMPLES, &channel, 1, rows, NULL));
  check(baum_simulation_advance_to(plain, times[SAMPLES - 1]));
  assert_true(baum_simulation_q(sampled)[0] == baum_simulation_q(plain)[0]);
  for (int i = 0; i < SAMPLES; i++) {
    double *most = &error[i % 3 == 2];
    *most = fmax(*most, fabs(rows[i] - cos(times[i])));
  }
  assert_true(error[1] > 0.0 && error[0] <= 1.1 * error[1]);
  baum_simulation_destroy(sampled);
  baum_simulation_destroy(plain);
  baum_mechanism_destroy(mechanism);
}

/* This force changes its sign at x = 0.5. It is so large that the iteration jumps back and forth by
 * thousands of metres. */
static int jump(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = q[0] > 0.5 ? -1e8 : 1e8;
  return 0;
}

static void samples_in_the_first_step_change_nothing(void **state)
{
  (void)state;
  const baum_channel channel = baum_channel_of(BAUM_Q);
  const double times[3] = {0.3e-4, 1.7e-4, 20e-4};
  double rows[27];
  model m = make_crank((model_slider_crank){0});
  baum_simulation_options options = options_with(baum_generalized_alpha(), 1e-4);
  baum_simulation *sampled = create_run(m.mechanism, &options);
  baum_simulation *plain = create_run(m.mechanism, &options);
  check(baum_simulation_sample(sampled, times, 3, &channel, 1, rows, NULL));
  check(baum_simulation_advance_to(plain, times[2]));
  assert_memory_equal(baum_simulation_q(sampled), baum_simulation_q(plain), 9 * sizeof(double));
  assert_memory_equal(baum_simulation_v(sampled), baum_simulation_v(plain), 9 * sizeof(double));
  baum_simulation_destroy(sampled);
  baum_simulation_destroy(plain);
  model_destroy(&m);
}

static void a_step_that_does_not_converge_leaves_the_state(void **state)
{
  (void)state;
  baum_mechanism *mechanism = one_coordinate(1.0, 0.0, jump, NULL, NULL);
  baum_simulation_options options = options_with(baum_generalized_alpha(), 1e-2);
  baum_simulation *run = create_run(mechanism, &options);
  ASSERT_SAYS(baum_simulation_step(run, 1), BAUM_ERR_CONVERGENCE,
              "t = 0 s: generalized_alpha|the step is too large");
  assert_true(baum_simulation_time(run) == 0.0);
  assert_true(baum_simulation_q(run)[0] == 1.0);
  assert_true(baum_simulation_v(run)[0] == 0.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

static void only_index_3_without_gains_is_offered(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_pendulum();
  baum_simulation_options options = options_with(baum_generalized_alpha(), 1e-3);
  options.formulation = BAUM_FORMULATION_PROJECTION;
  check_run_refused(mechanism, &options, BAUM_ERR_UNSUPPORTED,
                    "generalized_alpha does not offer the formulation projection|offers index3");
  options.formulation = BAUM_FORMULATION_DEFAULT;
  options.gains = baum_gains_auto();
  check_run_refused(mechanism, &options, BAUM_ERR_ARGUMENT, "gains are given");
  baum_mechanism_destroy(mechanism);
}

/* ---- a small and stiff coordinate that measures a large one ---- */

/* The coordinate u has unit mass, and a spring of stiffness k acts on it. A constraint sets u to x
 * - 0.4, where x is the position of a link. */
static int spring(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  const double *k = user;
  out[0] = -*k * q[0];
  return 0;
}

static int follow(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[3] - (q[0] - 0.4);
  return 0;
}

static baum_mechanism *link_with_gauge(double *k)
{
  baum_body_id ids[2];
  const double scale = 1e-5;
  baum_planar_body_def link = baum_planar_body_def_default();
  baum_coordinates_def gauge = baum_coordinates_def_default();
  baum_user_constraint_def tie = baum_user_constraint_def_default();
  link.inertia = 1.0 / 12.0;
  link.position[0] = 0.4;
  link.position[1] = -0.3;
  gauge.size = 1;
  gauge.scale = &scale;
  gauge.mass = user_mass_of_first;
  gauge.constant_mass = true;
  gauge.force = spring;
  gauge.user = k;
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_add_planar_body(m, &link, &ids[0]));
  check(baum_mechanism_add_coordinates(m, &gauge, &ids[1]));
  (void)add_planar_pin(m, NULL, BAUM_GROUND, ids[0], 0.0, 0.0);
  tie.bodies = ids;
  tie.body_count = 2;
  tie.row_count = 1;
  tie.phi = follow;
  check(baum_mechanism_add_user_constraint(m, &tie, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

/* The scale of u is 1e-5. The rounding error of x is about 1e-16, which is 1e-11 of the scale of u,
 * whatever the step. The iteration must accept this error. */
static void the_iteration_accepts_rounding_errors_of_a_small_coordinate(void **state)
{
  (void)state;
  for (double k = 1e8; k <= 1e12; k *= 100.0) {
    baum_mechanism *m = link_with_gauge(&k);
    for (double h = 1e-6; h < 1e-4; h *= 4.0) {
      baum_simulation_options options = options_with(baum_generalized_alpha(), h);
      baum_simulation *run = create_run(m, &options);
      check(baum_simulation_step(run, 100));
      assert_true(counters_of(run).max_phi < 1e-14);
      assert_true(counters_of(run).nonlinear_iterations <= 600);
      /* u oscillates about the position at which the spring and the weight are in equilibrium. */
      assert_true(fabs(baum_simulation_q(run)[3]) < 100.0 / k);
      baum_simulation_destroy(run);
    }
    baum_mechanism_destroy(m);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(modes_that_are_too_fast_decay_by_rho_per_step),
    cmocka_unit_test(a_stiff_damper_needs_no_small_steps),
    cmocka_unit_test(positions_velocities_and_multipliers_are_of_order_2),
    cmocka_unit_test(multipliers_are_of_order_2_from_the_start),
    cmocka_unit_test(positions_satisfy_the_constraints_to_rounding),
    cmocka_unit_test(redundant_rows_do_not_change_the_motion),
    cmocka_unit_test(a_start_off_the_constraints_is_projected),
    cmocka_unit_test(samples_between_grid_points_change_nothing),
    cmocka_unit_test(samples_in_the_first_step_change_nothing),
    cmocka_unit_test(a_step_that_does_not_converge_leaves_the_state),
    cmocka_unit_test(only_index_3_without_gains_is_offered),
    cmocka_unit_test(the_iteration_accepts_rounding_errors_of_a_small_coordinate),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
