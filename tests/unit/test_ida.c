/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#if BAUM_HAVE_SUNDIALS

#include "assert_near.h"
#include "construct.h"
#include "dense_ida.h"
#include "integrate/sundials_driver.h"
#include "integrator_run.h"
#include "models.h"

enum { FORM_COUNT = 4 };
static const baum_formulation FORMS[FORM_COUNT] = {BAUM_FORMULATION_GGL, BAUM_FORMULATION_BAUMGARTE,
                                                   BAUM_FORMULATION_INDEX2,
                                                   BAUM_FORMULATION_INDEX3};

/* ---- accuracy ---- */

static void error_falls_with_the_tolerance(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_pendulum();
  integrator_setup setup = integrator_setup_make(mechanism, baum_ida(), BAUM_FORMULATION_BAUMGARTE);
  setup.gain = 2.0 * 4.43;
  for (int f = 0; f < FORM_COUNT; f++) {
    setup.formulation = FORMS[f];
    double factor = tolerance_factor(&setup, 2.0, pendulum_motion, 4.43);
    print_message("%-10s %.2f\n", baum_formulation_name(FORMS[f]), factor);
    /* The order of IDA is at most 5. When rtol decreases by a factor of 10, the error should
     * therefore fall by 10^(5/6) = 6.8. Only one motion is tested, so a factor of 6 is accepted.
     * Index 3 may deviate more, because its error test omits velocities. */
    if (!(factor >= (FORMS[f] == BAUM_FORMULATION_INDEX3 ? 4.0 : 6.0))) {
      fail_msg("%s: factor %.2f", baum_formulation_name(FORMS[f]), factor);
    }
  }
  baum_mechanism_destroy(mechanism);
}

typedef struct violation {
  double phi;  /* [m] */
  double rate; /* [m/s] */
} violation;

static violation largest_violation(baum_formulation formulation, double t)
{
  baum_mechanism *mechanism = make_pendulum();
  integrator_setup setup = integrator_setup_make(mechanism, baum_ida(), formulation);
  integrator_run run;
  violation largest = {0};
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  while (run.state.t < t) {
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
    const double *q = run.state_q;
    const double *v = run.state_v;
    double length = hypot(q[0], q[1]);
    largest.phi = fmax(largest.phi, fabs(length - 1.0));
    largest.rate = fmax(largest.rate, fabs(q[0] * v[0] + q[1] * v[1]) / length);
  }
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
  return largest;
}

/* At index 3, the equations contain Phi = 0. At index 2 they contain Phi' = 0, and GGL contains
 * both. These equations hold within the tolerance of Newton's iteration. At index 2, Phi drifts.
 * The drift is slower than at index 1, where Phi' drifts too. */
static void violations_agree_with_the_formulation(void **state)
{
  (void)state;
  violation unstabilized = largest_violation(BAUM_FORMULATION_UNSTABILIZED, 5.0);
  violation baumgarte = largest_violation(BAUM_FORMULATION_BAUMGARTE, 5.0);
  violation index3 = largest_violation(BAUM_FORMULATION_INDEX3, 5.0);
  violation index2[2];
  violation ggl[2];
  for (int k = 0; k < 2; k++) {
    index2[k] = largest_violation(BAUM_FORMULATION_INDEX2, k ? 50.0 : 5.0);
    ggl[k] = largest_violation(BAUM_FORMULATION_GGL, k ? 50.0 : 5.0);
  }
  print_message("Phi: unstabilized %.2g, Baumgarte %.2g, index 3 %.2g; after 5 s and 50 s: index 2 "
                "%.2g and %.2g, GGL %.2g and %.2g\n",
                unstabilized.phi, baumgarte.phi, index3.phi, index2[0].phi, index2[1].phi,
                ggl[0].phi, ggl[1].phi);
  print_message("Phi': unstabilized %.2g, Baumgarte %.2g, index 3 %.2g; after 5 s and 50 s: index "
                "2 %.2g and %.2g, GGL %.2g and %.2g\n",
                unstabilized.rate, baumgarte.rate, index3.rate, index2[0].rate, index2[1].rate,
                ggl[0].rate, ggl[1].rate);
  assert_true(index3.phi <= 5e-6 && baumgarte.phi <= 1e-4);
  assert_true(unstabilized.phi > 2.0 * baumgarte.phi);
  for (int k = 0; k < 2; k++) {
    assert_true(ggl[k].phi <= 5e-6 && ggl[k].rate <= 5e-6 && index2[k].rate <= 5e-6);
  }
  assert_true(index2[0].phi < unstabilized.phi && index2[1].phi > 3.0 * index2[0].phi &&
              index2[1].phi < 20.0 * index2[0].phi);
}

/* ---- exact Jacobian ---- */

typedef struct cost {
  int64_t steps;
  baum_i_statistics statistics;
  double q[RUN_SIZE_MAX];
} cost;

/* Returns IDA's multipliers (nc) at the end of the last step. */
static const double *multipliers_of(const integrator_run *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  return N_VGetArrayPointer(((const baum_i_sundials *)run->self)->y) + m->nq + m->nv;
}

static cost run_it(const integrator_setup *setup, bool differences, double t)
{
  integrator_run run;
  cost out;
  assert_int_equal(integrator_run_open(&run, setup), BAUM_OK);
  if (differences) {
    dense_ida_use(&run);
  }
  assert_int_equal(integrator_run_to(&run, t), BAUM_OK);
  out.steps = run.steps;
  baum_ida()->statistics(run.self, &out.statistics);
  memcpy(out.q, run.q, sizeof out.q);
  if (differences) {
    dense_ida_release();
  }
  integrator_run_close(&run);
  return out;
}

/* Compares a run with the exact Jacobian to a run with the dense difference Jacobian that IDA
 * computes itself. The first run must not need more steps or iterations. Deviations due to rounding
 * have been at most 15 % so far, and 30 % are allowed. A missing term or a wrong sign causes 2 to
 * 40 times as much work. */
static void compare_jacobians(const char *name, baum_mechanism *mechanism,
                              baum_formulation formulation, double gain, double t)
{
  integrator_setup setup = integrator_setup_make(mechanism, baum_ida(), formulation);
  setup.gain = gain;
  cost exact = run_it(&setup, false, t);
  cost differences = run_it(&setup, true, t);
  double steps = (double)exact.steps / (double)differences.steps;
  double iterations = (double)exact.statistics.nonlinear_iterations /
                      (double)differences.statistics.nonlinear_iterations;
  print_message("%-20s %-10s %6.3f x the iterations per step, %6.3f x the iterations\n", name,
                baum_formulation_name(formulation), iterations / steps, iterations);
  if (!(steps <= 1.3 && iterations <= 1.3)) {
    fail_msg("%s, %s: %.2f x the steps, %.2f x the iterations", name,
             baum_formulation_name(formulation), steps, iterations);
  }
  double tolerance = formulation == BAUM_FORMULATION_INDEX3 ? 0.1 : 1e-3;
  for (int i = 0; i < mechanism->nq; i++) {
    ASSERT_NEAR(exact.q[i], differences.q[i], 0.0, tolerance * mechanism->scale[i]);
  }
}

static void compare_forms(const char *name, baum_status status, model *scene, double gain, double t)
{
  if (status != BAUM_OK) {
    fail_msg("%s: %s", name, baum_message());
  }
  for (int f = 0; f < FORM_COUNT; f++) {
    compare_jacobians(name, scene->mechanism, FORMS[f], gain, t);
  }
  model_destroy(scene);
}

static void the_exact_jacobian_is_as_good_as_differences(void **state)
{
  (void)state;
  model scene;
  model_slider_crank free_crank = {.driven = false};
  model_slider_crank driven_crank = {.driven = true};
  compare_forms("pendulum", model_pendulum_rod(&MODEL_PENDULUM_SUNDIALS, &scene), &scene, 10.0,
                2.0);
  compare_forms("circle", model_pendulum_circle(&MODEL_PENDULUM_SUNDIALS, &scene), &scene, 10.0,
                2.0);
  compare_forms("slider-crank", model_slider_crank_build(free_crank, &scene), &scene, 300.0, 0.05);
  compare_forms("driven slider-crank", model_slider_crank_build(driven_crank, &scene), &scene,
                300.0, 0.05);
  compare_forms("four-bar", model_four_bar(&scene), &scene, 10.0, 2.0);
  compare_forms("Andrews", model_andrews_bodies(&scene), &scene, 1e3, 0.01);
  compare_forms("car axis", model_car_axis(true, &scene), &scene, 10.0, 0.5);
}

/* ---- multipliers ---- */

/* Returns the largest error of IDA's multipliers at the ends of steps up to t. Each error is
 * relative to the largest exact multiplier at its time. */
static double multiplier_error(const model *scene, baum_formulation formulation, double gain,
                               double rtol, double t)
{
  integrator_setup setup = integrator_setup_make(scene->mechanism, baum_ida(), formulation);
  integrator_run run;
  double worst = 0.0;
  setup.gain = gain;
  setup.rtol = rtol;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  while (run.state.t < t) {
    const double *exact = run.workspace->lambda;
    const double *found = multipliers_of(&run);
    double error = 0.0;
    double largest = 0.0;
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
    assert_int_equal(
      baum_i_problem_acceleration(&run.problem, run.state.t, run.state_q, run.state_v), BAUM_OK);
    for (int i = 0; i < scene->mechanism->nc; i++) {
      error = fmax(error, fabs(found[i] - exact[i]));
      largest = fmax(largest, fabs(exact[i]));
    }
    worst = fmax(worst, error / largest);
  }
  integrator_run_close(&run);
  return worst;
}

/* Checks that the relative errors of the multipliers are at most 0.1. The error test excludes
 * multipliers, so that only Newton's iteration controls them. The tolerance of this iteration is
 * 1e-2 of the largest multiplier. The iteration weights each multiplier by the size of its row, and
 * these sizes differ by less than a factor of 10. Without this control the errors would grow to
 * 1e14 times the multipliers. */
static void check_multipliers_of(baum_formulation formulation)
{
  for (int k = 4; k <= 10; k++) {
    model crank;
    model andrews;
    double rtol = pow(10.0, -k);
    assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = true}, &crank),
                     BAUM_OK);
    assert_int_equal(model_andrews_bodies(&andrews), BAUM_OK);
    double error[2] = {multiplier_error(&crank, formulation, 300.0, rtol, 0.1),
                       multiplier_error(&andrews, formulation, 1e3, rtol, 0.03)};
    const char *name = baum_formulation_name(formulation);
    print_message("%s, rtol 1e-%02d: %.2g and %.2g\n", name, k, error[0], error[1]);
    if (!(error[0] <= 0.1 && error[1] <= 0.1)) {
      fail_msg("%s, rtol 1e-%02d: multipliers wrong by %.2g and %.2g", name, k, error[0], error[1]);
    }
    model_destroy(&crank);
    model_destroy(&andrews);
  }
}

static void the_multipliers_stay_accurate(void **state)
{
  (void)state;
  check_multipliers_of(BAUM_FORMULATION_BAUMGARTE);
  check_multipliers_of(BAUM_FORMULATION_INDEX2);
  check_multipliers_of(BAUM_FORMULATION_GGL);
}

static const double SLEDGE_SPEED[2] = {0.6, 0.8}; /* [m/s] */

static baum_mechanism *make_sledge(void)
{
  baum_body_id id;
  baum_planar_body_def body = baum_planar_body_def_default();
  baum_planar_translational_def rail = baum_planar_translational_def_default();
  body.mass = 2.0;
  body.inertia = 0.1;
  body.position[0] = body.position[1] = body.angle = body.angular_velocity = 0.0;
  memcpy(body.velocity, SLEDGE_SPEED, sizeof body.velocity);
  baum_mechanism *mechanism = create_mechanism();
  assert_int_equal(baum_mechanism_set_gravity(mechanism, 0.0, 0.0, 0.0), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &body, &id), BAUM_OK);
  rail.body_a = BAUM_GROUND;
  rail.body_b = id;
  rail.point[0] = rail.point[1] = 0.0;
  memcpy(rail.axis, SLEDGE_SPEED, sizeof rail.axis);
  assert_int_equal(baum_mechanism_add_planar_translational(mechanism, &rail, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  return mechanism;
}

/* A body slides freely on a rail, so that its exact multipliers are zero. The computed multipliers
 * are rounding errors, which must not make the run fail. */
static void multipliers_may_vanish(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_sledge();
  for (int f = 0; f < FORM_COUNT; f++) {
    for (int k = 4; k <= 13; k++) {
      integrator_run run;
      integrator_setup setup = integrator_setup_make(mechanism, baum_ida(), FORMS[f]);
      setup.gain = 10.0;
      setup.rtol = pow(10.0, -k);
      assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
      assert_int_equal(integrator_run_to(&run, 10.0), BAUM_OK);
      /* No step has an error, so IDA doubles the length of every step. The first step is sqrt(rtol)
       * s long. */
      assert_true(run.steps < 100);
      for (int i = 0; i < 2; i++) { /* rounding errors at 10 m, one in each step */
        ASSERT_NEAR(run.q[i], SLEDGE_SPEED[i] * 10.0, 0.0, 1e-12);
      }
      integrator_run_close(&run);
    }
  }
  baum_mechanism_destroy(mechanism);
}

/* ---- units ---- */

/* Returns how many steps IDA needs for a pendulum whose mass is `mass`. The multipliers are
 * proportional to the mass, but the motion does not depend on it. The number of steps must
 * therefore be the same. */
static int64_t steps_with_mass(baum_formulation formulation, double mass)
{
  baum_body_id id;
  baum_planar_particle_def particle = baum_planar_particle_def_default();
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  particle.mass = mass;
  particle.position[0] = 1.0;
  particle.velocity[0] = particle.velocity[1] = 0.0;
  baum_mechanism *mechanism = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_particle(mechanism, &particle, &id), BAUM_OK);
  rod.body_a = BAUM_GROUND;
  rod.body_b = id;
  rod.point_a[0] = rod.point_a[1] = rod.point_b[0] = rod.point_b[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_distance(mechanism, &rod, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  integrator_setup setup = integrator_setup_make(mechanism, baum_ida(), formulation);
  cost out = run_it(&setup, false, 2.0);
  baum_mechanism_destroy(mechanism);
  return out.steps;
}

static void the_unit_of_mass_makes_no_difference(void **state)
{
  (void)state;
  for (int f = 0; f < FORM_COUNT; f++) {
    int64_t kilograms = steps_with_mass(FORMS[f], 1.0);
    for (int k = -9; k <= 12; k += 3) {
      double ratio = (double)steps_with_mass(FORMS[f], pow(10.0, k)) / (double)kilograms;
      if (!(ratio > 0.9 && ratio < 1.1)) {
        fail_msg("%s, 1e%d kg: %.2f times the steps", baum_formulation_name(FORMS[f]), k, ratio);
      }
    }
  }
}

/* ---- multipliers in the error test ---- */

/* Returns the largest error of IDA's multipliers up to t = 2, relative to the largest multiplier.
 * The error test includes the multipliers with `factor` times the tolerance. */
static double tested_multiplier_error(const model *scene, baum_formulation formulation,
                                      double factor, int64_t *steps)
{
  integrator_setup setup = integrator_setup_make(scene->mechanism, baum_ida(), formulation);
  integrator_run run;
  double error = 0.0;
  double largest = 0.0;
  setup.gain = 10.0;
  setup.rtol = 1e-4;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  baum_i_integrator_destroy(baum_ida(), run.self);
  run.problem.tolerance_lambda = factor;
  assert_int_equal(baum_i_integrator_create(baum_ida(), &run.problem, &run.state, &run.self),
                   BAUM_OK);
  while (run.state.t < 2.0) {
    const double *exact = run.workspace->lambda;
    const double *found = multipliers_of(&run);
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
    assert_int_equal(
      baum_i_problem_acceleration(&run.problem, run.state.t, run.state_q, run.state_v), BAUM_OK);
    for (int i = 0; i < scene->mechanism->nc; i++) {
      error = fmax(error, fabs(found[i] - exact[i]));
      largest = fmax(largest, fabs(exact[i]));
    }
  }
  *steps = run.steps;
  integrator_run_close(&run);
  return error / largest;
}

/* If the error test excludes multipliers, their error is arbitrary. If it includes them, their
 * error is at most 10 times their tolerance, as for other unknowns. The largest measured error is
 * 3.5 times the tolerance. If the tolerance decreases by a factor of 10, the number of steps rises
 * less than fivefold, because the order is at least 2. */
static void the_error_test_of_multipliers_follows_their_factor(void **state)
{
  (void)state;
  static const double FACTORS[] = {1.0, 1e-1, 1e-2, 1e-3};
  static const baum_formulation INDEX1[] = {BAUM_FORMULATION_BAUMGARTE,
                                            BAUM_FORMULATION_UNSTABILIZED};
  model scenes[2];
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_SUNDIALS, &scenes[0]), BAUM_OK);
  assert_int_equal(model_four_bar(&scenes[1]), BAUM_OK);
  for (int s = 0; s < 4; s++) {
    int64_t steps = 0;
    int64_t before = 0;
    double free = tested_multiplier_error(&scenes[s / 2], INDEX1[s % 2], (double)INFINITY, &before);
    print_message("scene %d, %s, not tested: error %.1e, steps %ld\n", s / 2,
                  baum_formulation_name(INDEX1[s % 2]), free, (long)before);
    for (int k = 0; k < 4; k++) {
      double error = tested_multiplier_error(&scenes[s / 2], INDEX1[s % 2], FACTORS[k], &steps);
      print_message("scene %d, factor %g: error %.1e, steps %ld\n", s / 2, FACTORS[k], error,
                    (long)steps);
      assert_true(error <= 10.0 * FACTORS[k] * 1e-4);
      assert_true(steps >= before && steps <= 5 * before);
      before = steps;
    }
  }
  model_destroy(&scenes[0]);
  model_destroy(&scenes[1]);
}

/* ---- start ---- */

/* The state at the start has Phi = 1e-2 m and Phi' = 0.3 m/s. The first step must remove the
 * violations of those constraints that are part of the formulation's equations. With GGL and at
 * index 3, it must remove both Phi and Phi', and at index 2 only Phi'. */
static void a_start_off_the_constraints_jumps_onto_them(void **state)
{
  (void)state;
  static const baum_formulation JUMPING[] = {BAUM_FORMULATION_GGL, BAUM_FORMULATION_INDEX2,
                                             BAUM_FORMULATION_INDEX3};
  for (int f = 0; f < 3; f++) {
    integrator_run run;
    baum_mechanism *mechanism = make_pendulum();
    integrator_setup setup = integrator_setup_make(mechanism, baum_ida(), JUMPING[f]);
    const double q[2] = {1.01, 0.0};
    const double v[2] = {0.3, -1.0};
    assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
    assert_int_equal(integrator_run_restart(&run, 0.0, q, v, 1.0), BAUM_OK);
    assert_memory_equal(run.state_q, q, sizeof q); /* restart() does not change the state */
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
    const double *end = run.state_q;
    double length = hypot(end[0], end[1]);
    double rate = (end[0] * run.state_v[0] + end[1] * run.state_v[1]) / length;
    /* The tolerance of lengths is 1e-6 m. The tolerance of velocities is 1e-6 m per time constant
     * of the pendulum. */
    ASSERT_NEAR(length, JUMPING[f] == BAUM_FORMULATION_INDEX2 ? 1.01 : 1.0, 0.0, 1e-5);
    ASSERT_NEAR(rate, 0.0, 0.0, JUMPING[f] == BAUM_FORMULATION_INDEX3 ? 1e-3 : 1e-5);
    /* The step must keep the tangential component of v, which is 1 m/s. */
    ASSERT_NEAR(hypot(run.state_v[0], run.state_v[1]), 1.0, 0.0, 0.05);
    integrator_run_close(&run);
    baum_mechanism_destroy(mechanism);
  }
}

/* The start is consistent, and the library chooses the first step. At any tolerance, none of the
 * first ten steps should be rejected. There are exceptions: at most one step is rejected at index
 * 2, and at most two at index 3. A shorter first step would cause more rejections at index 3. */
static void few_of_the_first_steps_are_rejected(void **state)
{
  (void)state;
  model scene;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = false}, &scene),
                   BAUM_OK);
  for (int f = 0; f < FORM_COUNT; f++) {
    int most = FORMS[f] == BAUM_FORMULATION_INDEX3   ? 2
               : FORMS[f] == BAUM_FORMULATION_INDEX2 ? 1
                                                     : 0;
    for (double rtol = 1e-3; rtol > 0.9e-10; rtol *= 0.1) {
      integrator_setup setup = integrator_setup_make(scene.mechanism, baum_ida(), FORMS[f]);
      integrator_run run;
      baum_i_statistics statistics;
      setup.gain = 300.0;
      setup.rtol = rtol;
      assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
      for (int k = 0; k < 10; k++) {
        assert_int_equal(integrator_run_step(&run), BAUM_OK);
      }
      setup.integrator->statistics(run.self, &statistics);
      if (statistics.rejected > most) {
        fail_msg("%s, rtol %g: %ld rejected", baum_formulation_name(FORMS[f]), rtol,
                 (long)statistics.rejected);
      }
      integrator_run_close(&run);
    }
  }
  model_destroy(&scene);
}

/* A second guide on the same line adds two redundant rows. IDA solves the equations lambda_i = 0
 * and mu_i = 0 instead of these rows. The motions with one and with two guides differ by their
 * global errors, which are about 100 rtol after one revolution. */
static void redundant_rows_make_no_difference(void **state)
{
  (void)state;
  for (int f = 0; f < FORM_COUNT; f++) {
    double q[2][RUN_SIZE_MAX];
    for (int k = 0; k < 2; k++) {
      model crank;
      assert_int_equal(
        model_slider_crank_build((model_slider_crank){.doubled_guide = k == 1}, &crank), BAUM_OK);
      integrator_setup setup = integrator_setup_make(crank.mechanism, baum_ida(), FORMS[f]);
      setup.gain = 300.0;
      setup.rtol = 1e-8;
      cost out = run_it(&setup, false, 0.04);
      memcpy(q[k], out.q, sizeof q[k]);
      model_destroy(&crank);
    }
    for (int i = 0; i < 9; i++) {
      double off = FORMS[f] == BAUM_FORMULATION_INDEX3 ? 1e-3 : 1e-5;
      ASSERT_NEAR(q[1][i], q[0][i], 0.0, off);
    }
  }
}

/* The mechanism does not depend on time, and IDA measures time from the start of the run. At 1e9 s,
 * a double is rounded to 1e-7 s. Even so, a start at this time must change no digit at the ends of
 * steps. Only results inside a step may differ, because t itself is rounded. */
static void a_late_start_costs_no_digits(void **state)
{
  (void)state;
  const double late = 1e9;
  baum_mechanism *mechanism = make_pendulum();
  integrator_run runs[2];
  for (int k = 0; k < 2; k++) {
    integrator_setup setup = integrator_setup_make(mechanism, baum_ida(), BAUM_FORMULATION_GGL);
    const double q[2] = {1.0, 0.0};
    const double v[2] = {0.0, 0.0};
    setup.rtol = 1e-9;
    assert_int_equal(integrator_run_open(&runs[k], &setup), BAUM_OK);
    assert_int_equal(integrator_run_restart(&runs[k], k * late, q, v, 1.0), BAUM_OK);
    for (int i = 0; i < 300; i++) {
      assert_int_equal(integrator_run_step(&runs[k]), BAUM_OK);
    }
  }
  ASSERT_NEAR(runs[1].state.t - late, runs[0].state.t, 0.0, 1.2e-7);
  assert_memory_equal(runs[0].state_q, runs[1].state_q, 2 * sizeof(double));
  assert_memory_equal(runs[0].state_v, runs[1].state_v, 2 * sizeof(double));
  for (int k = 0; k < 2; k++) {
    double *q = runs[k].q;
    double *v = runs[k].v;
    baum_ida()->interpolate(runs[k].self, &runs[k].problem, runs[k].state.t, q, v);
    for (int i = 0; i < 2; i++) {
      ASSERT_NEAR(q[i], runs[k].state_q[i], 0.0, 1.2e-7 * 5.0); /* speeds are below 5 m/s */
    }
    integrator_run_close(&runs[k]);
  }
  baum_mechanism_destroy(mechanism);
}

/* The integrator evaluates the initial state when it is created. If this fails, the creation of the
 * integrator reports the failure and leaves nothing to destroy. */
static void a_start_that_cannot_be_evaluated_is_refused(void **state)
{
  (void)state;
  force_fault fault = {.after = 1.0, .answer = -1};
  baum_mechanism *mechanism = make_faulty_pendulum(&fault);
  integrator_setup setup = integrator_setup_make(mechanism, baum_ida(), BAUM_FORMULATION_BAUMGARTE);
  integrator_run run;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  run.state.t = 2.0;
  int unwanted = 0;
  void *self = &unwanted;
  assert_int_equal(baum_i_integrator_create(baum_ida(), &run.problem, &run.state, &self),
                   BAUM_ERR_CALLBACK);
  assert_null(self);
  assert_non_null(strstr(baum_message(), "faulty"));
  assert_int_equal(baum_ida()->restart(run.self, &run.problem, &run.state), BAUM_ERR_CALLBACK);
  run.state.t = 0.0;
  assert_int_equal(integrator_run_to(&run, 0.5), BAUM_OK); /* the integrator restarts by itself */
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(error_falls_with_the_tolerance),
    cmocka_unit_test(violations_agree_with_the_formulation),
    cmocka_unit_test(the_exact_jacobian_is_as_good_as_differences),
    cmocka_unit_test(the_multipliers_stay_accurate),
    cmocka_unit_test(multipliers_may_vanish),
    cmocka_unit_test(the_unit_of_mass_makes_no_difference),
    cmocka_unit_test(the_error_test_of_multipliers_follows_their_factor),
    cmocka_unit_test(a_start_off_the_constraints_jumps_onto_them),
    cmocka_unit_test(few_of_the_first_steps_are_rejected),
    cmocka_unit_test(redundant_rows_make_no_difference),
    cmocka_unit_test(a_late_start_costs_no_digits),
    cmocka_unit_test(a_start_that_cannot_be_evaluated_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

#else

#include "without_sundials.h"

#endif
