/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs mechanisms whose positions are on a manifold (support/manifold_scenes.c). Every integrator
 * of this build is used with all formulations that it offers. The results are compared with those
 * of a twin, which is the same mechanism with angles as coordinates. A mechanism without a twin is
 * compared with a reference solution. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "manifold_scenes.h"
#include "runs.h"
#include "step_mode.h"

enum { SIZE = MANIFOLD_SIZE };

static const double END = 0.5;

/* Rounding error of Phi after a projection. The points have three coordinates of up to 2 m each. */
static const double ROUNDING = 3e-14;

/* An integrator and its settings. */
typedef struct method {
  step_mode mode;
  baum_formulation formulation;
} method;

typedef void try_fn(const manifold_scene *scene, const method *with, const void *context);

/* Tries every method of this build, and returns how many there are. */
static int for_each_method(const manifold_scene *scene, try_fn *try, const void *context)
{
  int tried = 0;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    bool refused = scene->refuses_rattle && mode.integrator == baum_rattle();
    for (int f = BAUM_FORMULATION_DEFAULT + 1; baum_formulation_name((baum_formulation)f); f++) {
      if (!refused && baum_integrator_offers(mode.integrator, (baum_formulation)f)) {
        try(scene, &(method){mode, (baum_formulation)f}, context);
        tried++;
      }
    }
  }
  return tried;
}

/* Returns options with the fixed step h = 1e-3 s, or with variable steps and rtol = 1e-7. */
static baum_simulation_options options_of(const method *with)
{
  baum_simulation_options options = step_mode_options(with->mode, 1e-3, 1e-7);
  options.formulation = with->formulation;
  return options;
}

static baum_simulation *start(const manifold_scene *scene, const method *with, int32_t *nq)
{
  baum_mechanism *mechanism = manifold_scene_make(scene);
  baum_simulation_options options = options_of(with);
  check(baum_mechanism_sizes(mechanism, nq, NULL, NULL));
  assert_true(*nq <= SIZE);
  baum_simulation *run = create_run(mechanism, &options);
  baum_mechanism_destroy(mechanism);
  return run;
}

static void advance(baum_simulation *run, const manifold_scene *scene, const method *with, double t)
{
  baum_status status = baum_simulation_advance_to(run, t);
  if (status < BAUM_OK) {
    fail_msg("%s, %s, %s: %s", scene->name, baum_integrator_name(with->mode.integrator),
             baum_formulation_name(with->formulation), baum_message());
  }
}

static double apart(const double *a, const double *b, int count)
{
  double largest = 0.0;
  for (int i = 0; i < count; i++) {
    double size = fabs(a[i] - b[i]);
    largest = size <= largest ? largest : size;
  }
  return largest;
}

static void expect(const char *what, double got, double most, const manifold_scene *scene,
                   const method *with)
{
  if (!(got <= most)) {
    fail_msg("%s, %s, %s, %s: %s is %.3g, allowed %.3g", scene->name,
             baum_integrator_name(with->mode.integrator),
             with->mode.fixed ? "fixed step" : "variable step",
             baum_formulation_name(with->formulation), what, got, most);
  }
}

/* ---- every method ---- */

/* Returns the largest allowed error. It is up to ten times the limit in test_all_joints.c, because
 * the tops rotate through a larger angle, 3 rad. */
static double allowed(const method *with)
{
  static const double by_order[] = {2e-4, 5e-1, 1e-3, 1e-5, 1e-7, 1e-9, 3e-10, 3e-10, 3e-10};
  if (with->formulation == BAUM_FORMULATION_INDEX3) {
    return 1e-2; /* IDA is less accurate at index 3, where its error test omits velocities. */
  }
  double wide = step_mode_is_adams(with->mode) ? 300.0 : 1.0;
  return wide * by_order[with->mode.fixed ? baum_integrator_order(with->mode.integrator) : 0];
}

static double off_manifold(const manifold_scene *scene, const double *q)
{
  double largest = 0.0;
  for (int k = 0; k < scene->units.count; k++) {
    double square = 0.0;
    for (int i = 0; i < scene->units.length; i++) {
      int stride = scene->units.length == 4 ? 7 : 4;
      double x = q[scene->units.first + stride * k + i];
      square += x * x;
    }
    largest = fmax(largest, fabs(sqrt(square) - 1.0));
  }
  return largest;
}

static void try_run(const manifold_scene *scene, const method *with, const void *want)
{
  int32_t nq;
  baum_simulation *run = start(scene, with, &nq);
  for (int k = 1; k <= 5; k++) {
    advance(run, scene, with, 0.2 * k * END);
    expect("the distance from the manifold", off_manifold(scene, baum_simulation_q(run)), 1e-15,
           scene, with);
  }
  baum_counters counters = counters_of(run);
  double most = allowed(with);
  expect("the error", apart(baum_simulation_q(run), want, nq), most, scene, with);
  bool projected = with->formulation == BAUM_FORMULATION_PROJECTION;
  expect("the violation", counters.max_phi, projected ? ROUNDING : most, scene, with);
  assert_int_equal(counters.branch_warnings, 0);
  baum_simulation_destroy(run);
}

static void every_method_reproduces_the_motion_of_every_scene(void **state)
{
  (void)state;
  for (int k = 0; k < MANIFOLD_SCENES; k++) {
    double want[SIZE];
    manifold_scene_solve(&manifold_scenes[k], END, want);
    assert_true(for_each_method(&manifold_scenes[k], try_run, want) >= 15);
  }
}

/* ---- steps ---- */

static const double *twin_at(const manifold_scene *scene, const method *with, double *q)
{
  baum_mechanism *mechanism = manifold_scene_make_twin(scene);
  baum_simulation_options options = options_of(with);
  baum_simulation *run = create_run(mechanism, &options);
  advance(run, scene, with, END);
  scene->translate(baum_simulation_q(run), q);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return q;
}

/* If angles are represented by (cos, sin), the function move() of the manifold is exact. A method
 * that changes q only by move() must therefore reach the same states as with the twin. For
 * quaternions, the Euler methods add h q' instead of calling move(). In scenes with quaternions,
 * only RATTLE and generalized-alpha are therefore tested. */
static void try_steps(const manifold_scene *scene, const method *with, const void *context)
{
  (void)context;
  static const char *const MOVING[] = {"rattle", "generalized_alpha", "euler",
                                       "semi_implicit_euler"};
  int32_t nq;
  double want[SIZE];
  for (int k = 0; k < (scene->units.length == 4 ? 2 : 4); k++) {
    if (strcmp(baum_integrator_name(with->mode.integrator), MOVING[k]) == 0) {
      baum_simulation *run = start(scene, with, &nq);
      advance(run, scene, with, END);
      double most = apart(baum_simulation_q(run), twin_at(scene, with, want), nq);
      expect("the distance from its twin", most, 1e-9, scene, with);
      baum_simulation_destroy(run);
    }
  }
}

static void steps_along_the_manifold_equal_those_of_the_twin(void **state)
{
  (void)state;
  for (int k = 0; k < MANIFOLD_SCENES; k++) {
    if (manifold_scenes[k].translate) {
      (void)for_each_method(&manifold_scenes[k], try_steps, NULL);
    }
  }
}

static double estimate_of(const baum_mechanism *mechanism)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_semi_implicit_euler();
  options.formulation = BAUM_FORMULATION_UNSTABILIZED;
  options.step = 1e-3;
  options.error_check = true;
  baum_simulation *run = create_run(mechanism, &options);
  check(baum_simulation_advance_to(run, END));
  baum_counters counters = counters_of(run);
  baum_simulation_destroy(run);
  return counters.error_estimate;
}

/* The error estimate of a run measures displacements along the manifold, which are angles in this
 * scene. It does not measure differences of q. It must therefore equal the error estimate of the
 * twin, whose coordinates are angles. */
static void error_estimates_measure_displacements(void **state)
{
  (void)state;
  const manifold_scene *scene = manifold_scene_find("angle");
  baum_mechanism *mechanism = manifold_scene_make(scene);
  baum_mechanism *twin = manifold_scene_make_twin(scene);
  double want = estimate_of(twin);
  assert_true(want > 1e-5);
  ASSERT_NEAR(estimate_of(mechanism), want, 1e-4, 0.0);
  baum_mechanism_destroy(mechanism);
  baum_mechanism_destroy(twin);
}

static void scenes_move_far(void **state)
{
  (void)state;
  for (int k = 0; k < MANIFOLD_SCENES; k++) {
    double end[SIZE] = {0.0};
    double begin[SIZE] = {0.0};
    manifold_scene_solve(&manifold_scenes[k], 0.0, begin);
    manifold_scene_solve(&manifold_scenes[k], END, end);
    if (!(apart(begin, end, SIZE) > 0.4)) {
      fail_msg("%s moves by %.3g", manifold_scenes[k].name, apart(begin, end, SIZE));
    }
    baum_mobility mobility;
    baum_mechanism *mechanism = manifold_scene_make(&manifold_scenes[k]);
    check(baum_mechanism_check_derivatives(mechanism));
    check(baum_mechanism_mobility(mechanism, &mobility, sizeof mobility));
    assert_int_equal(mobility.degrees_of_freedom, manifold_scenes[k].degrees_of_freedom);
    assert_int_equal(mobility.redundant_rows, manifold_scenes[k].redundant_rows);
    baum_mechanism_destroy(mechanism);
  }
}

/* ---- save and restore ---- */

static void try_restore(const manifold_scene *scene, const method *with, const void *context)
{
  (void)context;
  int32_t nq;
  size_t size = 0;
  baum_simulation *run = start(scene, with, &nq);
  baum_simulation *other = start(scene, with, &nq);
  advance(run, scene, with, 0.1);
  void *saved = save_run(run, &size);
  check(baum_simulation_restore(other, saved, size));
  advance(run, scene, with, 0.2);
  advance(other, scene, with, 0.2);
  expect("a restored run", apart(baum_simulation_q(run), baum_simulation_q(other), nq), 0.0, scene,
         with);
  /* A state that was read from the run earlier can be set again. */
  double q[SIZE];
  double v[SIZE];
  int32_t nv;
  baum_mechanism *mechanism = manifold_scene_make(scene);
  check(baum_mechanism_sizes(mechanism, NULL, &nv, NULL));
  baum_mechanism_destroy(mechanism);
  memcpy(q, baum_simulation_q(run), (size_t)nq * sizeof *q);
  memcpy(v, baum_simulation_v(run), (size_t)nv * sizeof *v);
  advance(run, scene, with, 0.25);
  check(baum_simulation_set_state(run, 0.2, q, v));
  expect("a state that is set again", apart(baum_simulation_q(run), q, nq), 1e-15, scene, with);
  free(saved);
  baum_simulation_destroy(run);
  baum_simulation_destroy(other);
}

static void runs_are_saved_and_restored(void **state)
{
  (void)state;
  for (int k = 0; k < MANIFOLD_SCENES; k++) {
    (void)for_each_method(&manifold_scenes[k], try_restore, NULL);
  }
}

/* ---- events ---- */

/* An event function, which is q[0] - *user. */
static int first_position(double t, const double *q, const double *v, const double *inputs,
                          double *out, void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  out[0] = q[0] - *(const double *)user;
  return 0;
}

/* Returns the time at which q[0] passes a value. */
static double find_event(baum_simulation *run, double *value)
{
  baum_event_def def = baum_event_def_default();
  def.function = first_position;
  def.user = value;
  check(baum_simulation_add_event(run, &def, NULL));
  baum_status status = baum_simulation_advance_to(run, END);
  if (status != BAUM_STOP_EVENT) {
    fail_msg("%s: no event: %d", baum_message(), status);
  }
  return baum_simulation_time(run);
}

typedef struct passing {
  double value;
  double t;
} passing;

static void try_event(const manifold_scene *scene, const method *with, const void *context)
{
  const passing *want = context;
  int32_t nq;
  double value = want->value;
  baum_simulation *run = start(scene, with, &nq);
  double t = find_event(run, &value);
  expect("the time of the event", fabs(t - want->t), allowed(with), scene, with);
  expect("the value of the event function", fabs(baum_simulation_q(run)[0] - value), 1e-12, scene,
         with);
  expect("the distance from the manifold", off_manifold(scene, baum_simulation_q(run)), 1e-15,
         scene, with);
  baum_simulation_destroy(run);
}

static void events_are_found(void **state)
{
  (void)state;
  static const char *const names[] = {"angle", "slider-crank", "heavy top with its Jacobian"};
  for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
    const manifold_scene *scene = manifold_scene_find(names[k]);
    passing at = {.t = 0.21};
    double q[SIZE];
    manifold_scene_solve(scene, at.t, q);
    at.value = q[0];
    (void)for_each_method(scene, try_event, &at);
  }
}

/* ---- energy ---- */

static double residual_of(const baum_mechanism *mechanism, const baum_simulation_options *options)
{
  baum_energy_account account;
  baum_simulation *run = create_run(mechanism, options);
  check(baum_simulation_advance_to(run, END));
  check(baum_simulation_energy_account(run, &account, sizeof account));
  baum_simulation_destroy(run);
  return fabs(account.residual);
}

/* The residual of the energy account comes from the error of the method. It must be comparable with
 * the residual of the twin, because the representation of q only affects the choice of steps. */
static void energy_residuals_are_comparable_with_those_of_the_twin(void **state)
{
  (void)state;
  static const struct {
    const baum_integrator *(*integrator)(void);
    double step;
    double most; /* [J] limit if there is no twin; the energies of tops are 10 J */
  } WAYS[] = {{baum_rk4, 1e-3, 1e-7}, {baum_rk8, 5e-3, 1e-7}, {baum_dp5, (double)NAN, 1e-5}};
  for (int k = 0; k < MANIFOLD_SCENES; k++) {
    for (size_t i = 0; i < sizeof WAYS / sizeof *WAYS; i++) {
      const manifold_scene *scene = &manifold_scenes[k];
      baum_mechanism *mechanism = manifold_scene_make(scene);
      baum_mechanism *twin = scene->solve ? NULL : manifold_scene_make_twin(scene);
      baum_simulation_options options = baum_simulation_options_default();
      options.integrator = WAYS[i].integrator();
      options.formulation = BAUM_FORMULATION_PROJECTION;
      options.step = WAYS[i].step;
      options.rtol = isnan(WAYS[i].step) ? 1e-8 : (double)NAN;
      options.energy_account = true;
      double got = residual_of(mechanism, &options);
      double most = twin ? 30.0 * residual_of(twin, &options) + 1e-10 : WAYS[i].most;
      if (!(got <= most)) {
        fail_msg("%s by %s: residual %.3g J, allowed %.3g", scene->name,
                 baum_integrator_name(options.integrator), got, most);
      }
      baum_mechanism_destroy(mechanism);
      baum_mechanism_destroy(twin);
    }
  }
}

/* ---- without degrees of freedom ---- */

static void kinematics_follows_the_driver(void **state)
{
  (void)state;
  const manifold_scene *scene = manifold_scene_find("driven slider-crank");
  baum_mechanism *mechanism = manifold_scene_make(scene);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_kinematics();
  baum_simulation *run = create_run(mechanism, &options);
  for (int k = 1; k <= 40; k++) { /* 2.5 revolutions */
    double want[SIZE];
    check(baum_simulation_advance_to(run, 0.1 * k));
    scene->solve(0.1 * k, want);
    assert_true(apart(baum_simulation_q(run), want, 12) <= 1e-13);
    assert_true(off_manifold(scene, baum_simulation_q(run)) <= 1e-15);
    /* The tolerance allows for errors of J and nu, which are computed by differences of Phi. */
    assert_true(fabs(baum_simulation_v(run)[2] - 4.0) <= 1e-12);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

/* ---- singular configurations ---- */

typedef struct crossed {
  double q[SIZE];
  baum_counters counters;
} crossed;

static crossed cross(const baum_mechanism *mechanism, const baum_simulation_options *options)
{
  crossed out;
  int32_t nq;
  check(baum_mechanism_sizes(mechanism, &nq, NULL, NULL));
  baum_simulation *run = create_run(mechanism, options);
  check(baum_simulation_advance_to(run, 1.0));
  out.counters = counters_of(run);
  memcpy(out.q, baum_simulation_q(run), (size_t)nq * sizeof *out.q);
  baum_simulation_destroy(run);
  return out;
}

/* The slider passes through the pin between the crank and the ground. This configuration is a
 * bifurcation. On the other branch, the slider would stay at the pin. */
static void singular_configurations_are_crossed(void **state)
{
  (void)state;
  static const struct {
    const baum_integrator *(*integrator)(void);
    double step; /* NaN for variable steps with rtol 1e-9 */
    double most;
  } WAYS[] = {{baum_rk4, 1e-3, 1e-8}, {baum_rk8, 5e-3, 1e-8}, {baum_dp5, (double)NAN, 1e-6}};
  for (size_t i = 0; i < sizeof WAYS / sizeof *WAYS; i++) {
    baum_mechanism *mechanism = manifold_scene_make(&manifold_crossing);
    baum_mechanism *twin = manifold_scene_make_twin(&manifold_crossing);
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = WAYS[i].integrator();
    options.formulation = BAUM_FORMULATION_PROJECTION;
    options.step = WAYS[i].step;
    options.rtol = isnan(WAYS[i].step) ? 1e-9 : (double)NAN;
    crossed got = cross(mechanism, &options);
    crossed of_twin = cross(twin, &options);
    double want[SIZE];
    manifold_crossing.translate(of_twin.q, want);
    if (!(apart(got.q, want, 12) <= WAYS[i].most)) {
      fail_msg("%s: off by %.3g", baum_integrator_name(options.integrator), apart(got.q, want, 12));
    }
    assert_true(of_twin.counters.near_singular_intervals > 0);
    assert_int_equal(got.counters.near_singular_intervals,
                     of_twin.counters.near_singular_intervals);
    assert_int_equal(got.counters.branch_warnings, of_twin.counters.branch_warnings);
    baum_mechanism_destroy(mechanism);
    baum_mechanism_destroy(twin);
  }
}

/* ---- studies ---- */

static void study_of(const char *name)
{
  const baum_integrator *(*const integrators[])(void) = {baum_rk4, baum_rk8};
  baum_mechanism *mechanism = manifold_scene_make(manifold_scene_find(name));
  baum_study *study = NULL;
  check(baum_study_create(mechanism, 0.0, END, &study));
  for (int k = 0; k < 4; k++) {
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = integrators[k / 2]();
    options.formulation = BAUM_FORMULATION_PROJECTION;
    options.step = k % 2 == 0 ? 0.01 : 0.005;
    check(baum_study_add(study, &options));
  }
  check(baum_study_run(study));
  assert_int_equal(baum_study_entry_count(study), 4);
  baum_study_entry entry[4];
  for (int k = 0; k < 4; k++) {
    check(baum_study_entry_at(study, k, &entry[k], sizeof entry[k]));
    assert_int_equal(entry[k].state, BAUM_STUDY_DONE);
  }
  assert_true(entry[0].error < 1e-3 && entry[2].error < 1e-6);
  ASSERT_NEAR(log2(entry[0].error / entry[1].error), 4.0, 0.0, 0.5);
  baum_study_destroy(study);
  baum_mechanism_destroy(mechanism);
}

static void studies_measure_errors(void **state)
{
  (void)state;
  study_of("slider-crank");
  study_of("heavy top with its Jacobian");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(scenes_move_far),
    cmocka_unit_test(every_method_reproduces_the_motion_of_every_scene),
    cmocka_unit_test(steps_along_the_manifold_equal_those_of_the_twin),
    cmocka_unit_test(error_estimates_measure_displacements),
    cmocka_unit_test(runs_are_saved_and_restored),
    cmocka_unit_test(events_are_found),
    cmocka_unit_test(energy_residuals_are_comparable_with_those_of_the_twin),
    cmocka_unit_test(kinematics_follows_the_driver),
    cmocka_unit_test(singular_configurations_are_crossed),
    cmocka_unit_test(studies_measure_errors),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
