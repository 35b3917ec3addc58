/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs that pass through singular configurations must report what happened there. All other runs
 * must report nothing. This test is a small version of bench_singular, with two initial
 * configurations of each mechanism. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "construct.h"
#include "runs.h"
#include "singular_scenes.h"

/* [rad] If the error of a run is larger than this, the run is on another branch. Branches differ by
 * radians. Even at the loosest tolerance used here, errors on the right branch are smaller than
 * this. */
static const double WRONG = 0.1;

static const struct {
  singular_kind kind;
  int loops;
} SCENES[] = {
  {SINGULAR_N_FOUR_BAR, 1},    {SINGULAR_N_FOUR_BAR, 2},   {SINGULAR_N_FOUR_BAR, 10},
  {SINGULAR_PARALLELOGRAM, 0}, {SINGULAR_THREE_CRANKS, 0}, {SINGULAR_SLIDER_CRANK, 0},
};
enum { SCENE_COUNT = sizeof SCENES / sizeof SCENES[0], STARTS = 2 };

static bool is_of_cvode(const singular_setting *setting)
{
  return setting->integrator == baum_cvode_adams || setting->integrator == baum_cvode_bdf;
}

static bool is_built(const singular_setting *setting)
{
  return BAUM_HAVE_SUNDIALS || !is_of_cvode(setting);
}

static void every_wrong_run_warns_and_few_right_runs_have_a_branch_warning(void **state)
{
  (void)state;
  int right = 0;
  int alarmed = 0;
  int wrong = 0;
  uint64_t seed = 7;
  for (int k = 0; k < SCENE_COUNT * STARTS; k++) {
    singular_scene scene = singular_open(SCENES[k / STARTS].kind, SCENES[k / STARTS].loops, &seed);
    for (const singular_setting *setting = SINGULAR_SETTINGS; setting->name; setting++) {
      if (!is_built(setting)) {
        continue;
      }
      singular_result r = singular_run(&scene, setting);
      bool is_right = r.status >= BAUM_OK && r.error <= WRONG;
      bool is_wrong = r.status >= BAUM_OK && !is_right;
      right += is_right;
      alarmed += is_right && r.branch_warnings > 0;
      wrong += is_wrong;
      assert_true(r.warnings > 0 || r.status < BAUM_OK);
      assert_true(!is_wrong || r.doubts > 0);
      if (setting->formulation == BAUM_FORMULATION_PROJECTION && !is_of_cvode(setting)) {
        assert_true(is_right);
      }
    }
    singular_close(&scene);
  }
  printf("%d right, %d of them with a branch warning; %d wrong\n", right, alarmed, wrong);
  assert_true(right > 0 && wrong > 0); /* otherwise nothing was tested */
  assert_true(20 * alarmed <= right);
}

/* Tests the setting that docs/theory/singular.md recommends. The largest error in the table of that
 * page is 3e-8. The largest error measured here was 1e-8. */
static void the_recommended_setting_is_accurate(void **state)
{
  (void)state;
  const singular_setting setting = {
    .integrator = baum_rk8, .formulation = BAUM_FORMULATION_PROJECTION, .rtol = 1e-11};
  uint64_t seed = 11;
  for (int k = 0; k < SCENE_COUNT * STARTS; k++) {
    singular_scene scene = singular_open(SCENES[k / STARTS].kind, SCENES[k / STARTS].loops, &seed);
    singular_result r = singular_run(&scene, &setting);
    assert_true(r.status >= BAUM_OK);
    assert_true(r.error <= 1e-7);
    assert_true(r.intervals > 0);
    singular_close(&scene);
  }
}

/* In these two cases, a step ends close to a flat configuration. In the first case it ends 5e-7 rad
 * from the flat configuration. The acceleration that the equations give there has no correct digit.
 * In the second case, an ordinary projection does not converge at the end of the step. Runs in
 * which no step ends close to a flat configuration have errors of 4e-6. */
static void fixed_steps_may_end_in_a_singular_configuration(void **state)
{
  (void)state;
  static const struct {
    int loops;
    int start;
  } MET[] = {{2, 2}, {20, 9}};
  const singular_setting setting = {
    .integrator = baum_rk4, .formulation = BAUM_FORMULATION_PROJECTION, .step = 1e-2};
  for (int k = 0; k < 2; k++) {
    uint64_t seed = 4711;
    singular_scene scene = singular_open(SINGULAR_N_FOUR_BAR, MET[k].loops, &seed);
    for (int start = 1; start < MET[k].start; start++) {
      singular_close(&scene);
      scene = singular_open(SINGULAR_N_FOUR_BAR, MET[k].loops, &seed);
    }
    singular_result r = singular_run(&scene, &setting);
    assert_true(r.status >= BAUM_OK);
    assert_true(r.error <= 1e-4);
    singular_close(&scene);
  }
}

/* Checks which time, joint and branch are reported at the first flat configuration of a
 * four-bar. */
static void near_singular_intervals_report_time_joint_and_branch(void **state)
{
  (void)state;
  model m;
  model_n_four_bar data = model_n_four_bar_a02(1);
  assert_int_equal(model_n_four_bar_build(&data, &m), BAUM_OK);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.step = 5e-3;
  options.formulation = BAUM_FORMULATION_PROJECTION;
  baum_simulation *run = create_run(m.mechanism, &options);
  assert_int_equal(baum_simulation_advance_to(run, 1.0), BAUM_WARNED);
  baum_near_singular entry;
  baum_counters c = counters_of(run);
  assert_int_equal(c.near_singular_intervals, 1);
  assert_int_equal(c.branch_warnings, 0);
  assert_int_equal(baum_simulation_near_singular(run, 0, &entry, sizeof entry), BAUM_OK);
  assert_int_equal(entry.struct_size, sizeof entry);
  assert_true(entry.begin < entry.t && entry.t < entry.end);
  /* The mechanism becomes flat after 90 degrees of the crank. The reference time was computed from
   * the equation of motion in the angle, with mpmath and 25 digits. The search is accurate to a
   * millionth of two steps, which is 1e-8 s. The integration adds an error of 3e-9 s. The pivot is
   * proportional to the square of the distance from the flat configuration. Because of these
   * errors, the smallest pivot found is about 1e-12 instead of zero. */
  assert_true(fabs(entry.t - 0.7084500088357589) <= 3e-8);
  assert_true(entry.pivot < 1e-11);
  assert_int_equal(entry.branch, BAUM_BRANCH_CONTINUED);
  assert_true(entry.joint.index1 > 0);
  assert_int_equal(baum_simulation_near_singular(run, 1, &entry, sizeof entry), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_simulation_near_singular(run, -1, &entry, sizeof entry), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_simulation_near_singular(run, 0, NULL, sizeof entry), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_simulation_near_singular(NULL, 0, &entry, sizeof entry), BAUM_ERR_ARGUMENT);
  baum_simulation_destroy(run);
  model_destroy(&m);
}

/* ---- away from singular configurations ---- */

/* Makes a run, and sets *angle to its angle at 10 s. Returns false if the run has stopped, or if it
 * has warned that its motion is doubtful. */
static bool trusts(const model *m, const baum_integrator *method, baum_formulation formulation,
                   double rtol, double *angle)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = method;
  options.formulation = formulation;
  options.rtol = rtol;
  options.max_steps = 10000;
  baum_simulation *run = create_run(m->mechanism, &options);
  baum_status status = baum_simulation_advance_to(run, 10.0);
  baum_counters c = counters_of(run);
  *angle = baum_simulation_q(run)[2];
  baum_simulation_destroy(run);
  return status >= BAUM_OK && c.doubts == 0;
}

/* A small error in a singular configuration causes a violation. Because of this violation, the
 * mechanism cannot reach the next singular configuration. The motion reverses shortly before this
 * configuration, and continues on the other branch. */
static void drifting_runs_that_leave_their_branch_warn(void **state)
{
  (void)state;
  /* [rad] angle at 10 s in the closed-form solution of problem A02 of A Coruna. */
  static const double ANGLE = -30.343944970943127;
  model_n_four_bar data = model_n_four_bar_a02(1);
  model m;
  int trusted = 0;
  assert_int_equal(model_n_four_bar_build(&data, &m), BAUM_OK);
  for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_PROJECTION; f++) {
    for (int k = 12; k <= 24; k++) {
      const baum_integrator *const METHODS[] = {baum_dp5(), baum_rk8()};
      for (int i = 0; i < 2; i++) {
        double angle = 0.0;
        if (trusts(&m, METHODS[i], (baum_formulation)f, pow(10.0, -0.5 * k), &angle)) {
          assert_true(fabs(angle - ANGLE) < WRONG);
          trusted++;
        }
      }
    }
  }
  assert_true(trusted >= 26); /* at least all runs with projection */
  model_destroy(&m);
}

static void assert_silent(baum_status built, model *m, const baum_integrator *method, double step,
                          double end)
{
  baum_simulation_options options = baum_simulation_options_default();
  assert_int_equal(built, BAUM_OK);
  options.integrator = method;
  options.formulation = BAUM_FORMULATION_PROJECTION;
  if (step > 0.0) {
    options.step = step;
  } else {
    options.rtol = 1e-6;
  }
  baum_simulation *run = create_run(m->mechanism, &options);
  assert_true(baum_simulation_advance_to(run, end) >= BAUM_OK); /* the run may give a warning */
  baum_counters c = counters_of(run);
  assert_int_equal(c.near_singular_intervals, 0);
  assert_int_equal(c.branch_warnings, 0);
  assert_int_equal(c.forced_steps, 0);
  baum_simulation_destroy(run);
  model_destroy(m);
}

/* Makes a body of 1 kg, which is pinned 1 m from its centre. Its moment of inertia is almost
 * zero. */
static baum_status build_light_rotation(model *out)
{
  *out = (model){0};
  baum_planar_body_def arm = baum_planar_body_def_default();
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  arm.inertia = 1e-6;
  arm.position[0] = 1.0;
  pin.body_a = BAUM_GROUND;
  pin.point[0] = pin.point[1] = 0.0;
  baum_status status = baum_mechanism_create(&out->mechanism);
  if (status == BAUM_OK) {
    status = baum_mechanism_add_planar_body(out->mechanism, &arm, &pin.body_b);
  }
  if (status == BAUM_OK) {
    status = baum_mechanism_add_planar_revolute(out->mechanism, &pin, NULL);
  }
  return status == BAUM_OK ? baum_mechanism_freeze(out->mechanism) : status;
}

/* Makes a light rod between a bob of 1 kg and a pin that slides in a slot through the origin. When
 * the rod becomes perpendicular to the slot, it stops the bob suddenly. */
static baum_mechanism *build_taut_rod(double mass, double direction)
{
  baum_planar_body_def rod = baum_planar_body_def_default();
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  baum_planar_pin_in_slot_def slot = baum_planar_pin_in_slot_def_default();
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  rod.mass = mass;
  rod.inertia = mass / 12.0;
  rod.position[0] = 0.4;
  rod.position[1] = -0.3;
  rod.angle = -0.6435011087932844;
  bob.position[0] = 0.8;
  bob.position[1] = -0.6;
  bob.velocity[0] = 2.0 * cos(direction);
  bob.velocity[1] = 2.0 * sin(direction);
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_body(m, &rod, &pin.body_a), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_particle(m, &bob, &pin.body_b), BAUM_OK);
  slot.body_a = BAUM_GROUND;
  slot.body_b = pin.body_a;
  slot.point_a[0] = slot.point_a[1] = 0.0;
  slot.point_b[0] = -0.5;
  slot.point_b[1] = 0.0;
  slot.axis[0] = 1.0;
  slot.axis[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_pin_in_slot(m, &slot, NULL), BAUM_OK);
  pin.point_a[0] = 0.5;
  pin.point_a[1] = 0.0;
  pin.point_b[0] = pin.point_b[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_revolute(m, &pin, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static baum_counters run_taut_rod(double mass, double direction, const baum_simulation_options *o)
{
  baum_mechanism *m = build_taut_rod(mass, direction);
  baum_simulation *run = create_run(m, o);
  assert_true(baum_simulation_advance_to(run, 1.5) >= BAUM_OK);
  baum_counters c = counters_of(run);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  return c;
}

/* While the rod is perpendicular to the slot, the slot holds the bob only through the light rod.
 * Pivots then become as small as the ratio of the masses, although J keeps its rank. The run must
 * not treat this configuration as singular, and it must not step over it. */
static void a_light_rod_that_comes_taut_is_not_singular(void **state)
{
  (void)state;
  baum_simulation_options o = baum_simulation_options_default();
  o.rtol = 1e-9;
  for (int k = 0; k < 120; k++) {
    o.integrator = k < 60 ? baum_rk8() : baum_dp5();
    baum_counters c = run_taut_rod(pow(10.0, -5.0 + 4.0 * (k % 20) / 19.0), 0.9 * k, &o);
    assert_true(fabs(c.energy_change) < (k < 60 ? 1e-7 : 1e-6));
    assert_int_equal(c.near_singular_intervals, 0);
    assert_int_equal(c.forced_steps, 0);
  }
}

/* The same rod moves without stabilization. The violation grows during the run. This must not be
 * mistaken for a singular configuration either. */
static void a_light_rod_that_drifts_is_not_singular(void **state)
{
  (void)state;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_euler();
  o.formulation = BAUM_FORMULATION_UNSTABILIZED;
  for (int k = 0; k < 8; k++) {
    o.step = 5e-5 + 1e-5 * k;
    baum_counters c = run_taut_rod(4e-3, -1.1, &o);
    assert_true(c.max_phi > 5e-4);
    assert_int_equal(c.near_singular_intervals, 0);
  }
}

static void mechanisms_away_from_singular_configurations_are_silent(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    const baum_integrator *method = k == 0 ? baum_rk4() : baum_rk8();
    double fixed = k == 0 ? 1.0 : 0.0;
    model m;
    baum_status built = model_andrews_bodies(&m);
    assert_silent(built, &m, method, 1e-5 * fixed, 0.05);
    built = model_four_bar(&m);
    assert_silent(built, &m, method, 1e-2 * fixed, 20.0);
    built = model_slider_crank_build((model_slider_crank){.driven = false}, &m);
    assert_silent(built, &m, method, 1e-4 * fixed, 0.5);
    built = model_slider_crank_build((model_slider_crank){.driven = true}, &m);
    assert_silent(built, &m, method, 1e-4 * fixed, 0.5);
    built = model_chain_3(&m);
    assert_silent(built, &m, method, 2e-3 * fixed, 20.0);
    built = model_car_axis(true, &m);
    assert_silent(built, &m, method, 1e-3 * fixed, 3.0);
    built = model_pendulum_rod(&MODEL_PENDULUM_A01, &m);
    assert_silent(built, &m, method, 1e-2 * fixed, 10.0);
    built = build_light_rotation(&m);
    assert_silent(built, &m, method, 1e-2 * fixed, 10.0);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_recommended_setting_is_accurate),
    cmocka_unit_test(fixed_steps_may_end_in_a_singular_configuration),
    cmocka_unit_test(near_singular_intervals_report_time_joint_and_branch),
    cmocka_unit_test(drifting_runs_that_leave_their_branch_warn),
    cmocka_unit_test(mechanisms_away_from_singular_configurations_are_silent),
    cmocka_unit_test(a_light_rod_that_comes_taut_is_not_singular),
    cmocka_unit_test(a_light_rod_that_drifts_is_not_singular),
    cmocka_unit_test(every_wrong_run_warns_and_few_right_runs_have_a_branch_warning),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
