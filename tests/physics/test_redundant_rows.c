/* SPDX-License-Identifier: BSD-3-Clause */
/* Redundant rows must not change the motion. Two mechanisms with redundant rows are compared with
 * the same mechanisms without these rows. The rows come from a third parallel crank in the first
 * mechanism, and from a second guide on the same line in the second one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "posed.h"
#include "runs.h"

enum { POSES = 8 };

/* The largest allowed difference between the results with and without redundant rows. Both results
 * are as accurate as in ordinary configurations. In addition, the redundant rows are satisfied only
 * up to rounding, which increases the difference. */
static const double LIMIT = 1e-10;

/* ---- the pairs of mechanisms ---- */

/* Returns a mechanism in configuration k, with or without redundant rows. */
typedef posed pair_fn(int k, bool redundant);

static posed cranks(int k, bool redundant)
{
  model m;
  model_parallelogram which = redundant ? MODEL_THREE_CRANKS : MODEL_THIRD_BY_A_ROD;
  /* Crank angles are from 0.3 to 2.4 rad. They avoid the flat configurations, which are
   * singular. */
  baum_status status = model_parallelogram_build(which, 0.3 + 0.3 * k, &m);
  return pose_model(status, m);
}

static posed slider(int k, bool redundant, bool driven)
{
  model m;
  model_slider_crank options = {
    .driven = driven, .doubled_guide = redundant, .angle = 0.7 * k, .moving = true};
  baum_status status = model_slider_crank_build(options, &m);
  return pose_model(status, m);
}

static posed free_slider(int k, bool redundant)
{
  return slider(k, redundant, false);
}

static posed driven_slider(int k, bool redundant)
{
  return slider(k, redundant, true);
}

static const struct {
  const char *name;
  pair_fn *pose;
  int more_rows;
  int redundant_rows;
  double step; /* [s] the step of runs */
} PAIRS[] = {
  {"three parallel cranks", cranks, 1, 1, 1e-3},
  {"slider-crank, two guides", free_slider, 2, 2, 1e-5},
  {"slider-crank, two guides, driven", driven_slider, 2, 2, 1e-5},
};
enum { PAIR_COUNT = sizeof PAIRS / sizeof PAIRS[0] };

/* ---- accelerations ---- */

static double compare_pose(int pair, int k)
{
  posed with = PAIRS[pair].pose(k, true);
  posed without = PAIRS[pair].pose(k, false);
  assert_int_equal(with.nv, without.nv);
  assert_int_equal(with.nc - without.nc, PAIRS[pair].more_rows);
  assert_int_equal(with.workspace->rows.count, PAIRS[pair].redundant_rows);
  accelerate(&with);
  accelerate(&without);
  double apart = quad_error(with.nv, with.a, without.a);
  unpose(&with);
  unpose(&without);
  return apart;
}

static void accelerations_equal_those_without_redundant_rows(void **state)
{
  (void)state;
  double worst_of_all = 0.0;
  for (int pair = 0; pair < PAIR_COUNT; pair++) {
    double worst = 0.0;
    for (int k = 0; k < POSES; k++) {
      double apart = compare_pose(pair, k);
      worst = isnan(apart) || apart > worst ? apart : worst;
    }
    printf("%-34s a differs by %.1e\n", PAIRS[pair].name, worst);
    worst_of_all = isnan(worst) || worst > worst_of_all ? worst : worst_of_all;
  }
  assert_true(worst_of_all <= LIMIT);
}

/* The accelerations are compared with a solution in quadruple precision, which omits the same rows
 * as the workspace. */
static void accelerations_agree_with_quadruple_precision(void **state)
{
  (void)state;
  for (int pair = 0; pair < PAIR_COUNT; pair++) {
    posed p = PAIRS[pair].pose(1, true);
    accelerate(&p);
    assert_true(quad_acceleration(p.workspace, 0.0, p.q, p.v, p.workspace->rows.omitted, p.want_a,
                                  p.want_lambda));
    double error = quad_error(p.nv, p.a, p.want_a);
    printf("%-34s error of a %.1e\n", PAIRS[pair].name, error);
    assert_true(error <= 1e-12); /* the same limit as in test_acceleration_accuracy.c */
    unpose(&p);
  }
}

/* ---- runs ---- */

static double compare_runs(int pair, const baum_simulation_options *options)
{
  double worst = 0.0;
  posed with = PAIRS[pair].pose(1, true);
  posed without = PAIRS[pair].pose(1, false);
  baum_simulation *runs[2] = {NULL, NULL};
  check(baum_simulation_create(with.m.mechanism, options, &runs[0]));
  check(baum_simulation_create(without.m.mechanism, options, &runs[1]));
  for (int i = 0; i < 2; i++) {
    check(baum_simulation_step(runs[i], 200));
  }
  for (int i = 0; i < with.nv; i++) {
    double apart = fabs(baum_simulation_q(runs[0])[i] - baum_simulation_q(runs[1])[i]);
    worst = isnan(apart) || apart > worst ? apart : worst;
  }
  baum_simulation_destroy(runs[0]);
  baum_simulation_destroy(runs[1]);
  unpose(&with);
  unpose(&without);
  return worst;
}

static void motions_equal_those_without_redundant_rows(void **state)
{
  (void)state;
  const baum_integrator *methods[] = {baum_semi_implicit_euler(), baum_rk4()};
  for (int k = 0; k < 2 * PAIR_COUNT; k++) {
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = methods[k % 2];
    options.formulation = BAUM_FORMULATION_PROJECTION;
    options.step = PAIRS[k / 2].step;
    double apart = compare_runs(k / 2, &options);
    printf("%-34s %-20s 200 steps: %.1e\n", PAIRS[k / 2].name,
           baum_integrator_name(options.integrator), apart);
    assert_true(apart <= LIMIT); /* rounding errors of 200 steps, in m and rad */
  }
}

/* ---- multipliers ---- */

enum { PLAIN_ROWS = 8, ROWS = 10, FIRST_SHARED = 6 };

static void read_multipliers(bool doubled, baum_solver solver, double *lambda, bool *unique)
{
  const model_parallelogram_data data = {
    .which = MODEL_TWO_CRANKS, .angle = 1.0, .doubled = doubled};
  const baum_channel channel = baum_channel_of(BAUM_LAMBDA);
  baum_simulation_options options = baum_simulation_options_default();
  model m;
  options.integrator = baum_rk4();
  options.step = 1e-3;
  options.solver = solver;
  check(model_parallelogram_build_of(&data, &m));
  baum_simulation *run = create_run(m.mechanism, &options);
  check(baum_simulation_step(run, 10));
  check(baum_simulation_get(run, &channel, 1, lambda));
  check(baum_simulation_unique_multipliers(run, unique));
  baum_simulation_destroy(run);
  model_destroy(&m);
}

/* If a pin is duplicated, the pin and its duplicate must each carry half of the force. All other
 * multipliers must be the same as without the duplicate, and they must be unique. */
static void multipliers_that_are_not_unique_are_marked(void **state)
{
  (void)state;
  for (int k = BAUM_SOLVER_AUTO; k <= BAUM_SOLVER_BLOCK; k++) {
    double alone[PLAIN_ROWS];
    double twice[ROWS];
    bool unique[ROWS];
    read_multipliers(false, (baum_solver)k, alone, unique);
    for (int i = 0; i < PLAIN_ROWS; i++) {
      assert_true(unique[i]);
    }
    read_multipliers(true, (baum_solver)k, twice, unique);
    for (int i = 0; i < ROWS; i++) {
      assert_true(unique[i] == (i < FIRST_SHARED));
    }
    for (int i = 0; i < PLAIN_ROWS; i++) {
      double want = i < FIRST_SHARED ? alone[i] : 0.5 * alone[i];
      assert_true(fabs(twice[i] - want) <= LIMIT * 100.0); /* forces are about 10 N */
    }
  }
}

/* ---- redundant everywhere, or singular in one configuration ---- */

/* These mechanisms have redundant rows, or rows that are dependent only in a flat configuration, or
 * both. If a pin is duplicated, two rows are redundant, even if the duplicate is off by 1e-10 m.
 * Rows that become dependent in a flat configuration are not redundant, even at a distance of 1e-8
 * rad from it. */
static const struct {
  const char *name;
  model_parallelogram_data data;
  int redundant;
  bool near_singular;
} TELL_APART[] = {
  {"twice", {.which = MODEL_TWO_CRANKS, .angle = 1.0, .doubled = true}, 2, false},
  {"twice, aside",
   {.which = MODEL_TWO_CRANKS, .angle = 1.0, .doubled = true, .aside = 1e-10},
   2,
   false},
  {"twice, with a gap",
   {.which = MODEL_TWO_CRANKS, .angle = 1.0, .doubled = true, .gap = 1e-10},
   2,
   false},
  {"near flat", {.which = MODEL_TWO_CRANKS, .angle = 1e-4}, 0, false},
  {"nearly flat", {.which = MODEL_TWO_CRANKS, .angle = 1e-8}, 0, true},
  {"flat", {.which = MODEL_TWO_CRANKS, .angle = 0.0}, 0, true},
  {"nearly flat, twice", {.which = MODEL_TWO_CRANKS, .angle = 1e-8, .doubled = true}, 2, true},
  {"nearly flat, twice, aside",
   {.which = MODEL_TWO_CRANKS, .angle = 1e-8, .doubled = true, .aside = 1e-10},
   2,
   true},
  {"three, near flat", {.which = MODEL_THREE_CRANKS, .angle = 1e-4}, 1, false},
  {"three, nearly flat", {.which = MODEL_THREE_CRANKS, .angle = 1e-8}, 1, true},
  {"three, all but flat", {.which = MODEL_THREE_CRANKS, .angle = 1e-12}, 1, true},
  {"three, flat", {.which = MODEL_THREE_CRANKS, .angle = 0.0}, 1, true},
  {"three, nearly flat, twice, aside",
   {.which = MODEL_THREE_CRANKS, .angle = 1e-8, .doubled = true, .aside = 1e-10},
   3,
   true},
};
enum { TELL_APART_COUNT = sizeof TELL_APART / sizeof *TELL_APART };

static model tell_apart(int k, const model_units *units)
{
  model_parallelogram_data data = TELL_APART[k].data;
  model m;
  data.units = units;
  check(model_parallelogram_build_of(&data, &m));
  return m;
}

static void permanent_and_momentary_redundancy_are_distinguished_in_any_unit(void **state)
{
  (void)state;
  const model_units *const units[] = {NULL, &MODEL_MILLI};
  for (int k = 0; k < 2 * TELL_APART_COUNT; k++) {
    model m = tell_apart(k / 2, units[k % 2]);
    baum_mobility report;
    check(baum_mechanism_mobility(m.mechanism, &report, sizeof report));
    if (report.redundant_rows != TELL_APART[k / 2].redundant || report.degrees_of_freedom != 1 ||
        report.near_singular != TELL_APART[k / 2].near_singular || report.conflicting_rows != 0) {
      fail_msg("%s, in %s: %s", TELL_APART[k / 2].name, k % 2 == 0 ? "m" : "mm", report.text);
    }
    model_destroy(&m);
  }
}

/* The runs start with redundant rows, or near a singular configuration, or both. All cranks must
 * rotate by the same angle th, with th'' = -k cos th and a constant k. */
static void a_run_may_start_next_to_a_singular_configuration(void **state)
{
  (void)state;
  for (int k = 0; k < TELL_APART_COUNT; k++) {
    const model_parallelogram_data *data = &TELL_APART[k].data;
    double cranks = data->which == MODEL_TWO_CRANKS ? 2.0 : 3.0;
    double pull = (cranks / 2.0 + 2.0) * 9.81 / (cranks / 3.0 + 2.0);
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = baum_rk4();
    options.formulation = BAUM_FORMULATION_PROJECTION;
    options.step = 1e-3;
    model m = tell_apart(k, NULL);
    baum_simulation *run = create_run(m.mechanism, &options);
    check(baum_simulation_advance_to(run, 0.1));
    baum_counters counters = counters_of(run);
    const double *q = baum_simulation_q(run);
    const double *v = baum_simulation_v(run);
    /* For this motion, th'^2 / 2 + k sin th is constant. If the run starts in a flat configuration,
     * its first accelerations are not unique, which changes the constant by 3e-6. */
    double energy = v[2] * v[2] / 2.0 + pull * (sin(q[2]) - sin(data->angle));
    printf("%-34s angle %.9f, energy off by %.1e\n", TELL_APART[k].name, q[2], energy - 2.0);
    assert_true(fabs(energy - 2.0) <= 1e-5);
    assert_true(fabs(q[5] - q[2]) <= 1e-9); /* the cranks must stay on the same branch */
    assert_int_equal(counters.branch_warnings, 0);
    assert_true((counters.warnings > 0) ==
                (TELL_APART[k].redundant > 0 || TELL_APART[k].near_singular));
    baum_simulation_destroy(run);
    model_destroy(&m);
  }
}

/* ---- a coupling of equal angles ---- */

/* Makes a door on two hinges whose common axis is oblique. If `coupled` is true, a coupling makes
 * both hinge angles equal. The hinges enforce this already, so the row of the coupling is zero up
 * to rounding. */
static baum_mechanism *make_door(bool coupled)
{
  baum_body_id door;
  baum_joint_id joints[2];
  baum_spatial_body_def body = baum_spatial_body_def_default();
  const double axis[3] = {1.0, 2.0, 3.0};
  baum_mechanism *m = create_mechanism();
  body.position[0] = 0.7;
  body.angular_velocity[0] = 0.1;
  body.angular_velocity[1] = 0.2;
  body.angular_velocity[2] = 0.3;
  check(baum_mechanism_add_spatial_body(m, &body, &door));
  for (int k = 0; k < 2; k++) {
    baum_spatial_revolute_def hinge = baum_spatial_revolute_def_default();
    hinge.body_a = BAUM_GROUND;
    hinge.body_b = door;
    for (int i = 0; i < 3; i++) {
      hinge.axis[i] = axis[i] * (k == 0 ? 1.0 : 0.3);
      hinge.point[i] = 0.3 * k * axis[i];
    }
    check(baum_mechanism_add_spatial_revolute(m, &hinge, &joints[k]));
  }
  if (coupled) {
    baum_coupling_def coupling = baum_coupling_def_default();
    coupling.joint_a = joints[0];
    coupling.joint_b = joints[1];
    check(baum_mechanism_add_coupling(m, &coupling, NULL));
  }
  check(baum_mechanism_freeze(m));
  return m;
}

static void a_coupling_of_both_hinges_of_a_door_is_redundant(void **state)
{
  (void)state;
  double q[2][7];
  for (int k = 0; k < 2; k++) {
    baum_mobility mobility;
    baum_simulation_options o = baum_simulation_options_default();
    baum_mechanism *m = make_door(k == 1);
    check(baum_mechanism_mobility(m, &mobility, sizeof mobility));
    assert_int_equal(mobility.degrees_of_freedom, 1);
    assert_int_equal(mobility.redundant_rows, 5 + k);
    o.integrator = baum_rk8();
    o.rtol = 1e-10;
    baum_simulation *run = create_run(m, &o);
    check(baum_simulation_advance_to(run, 1.0));
    memcpy(q[k], baum_simulation_q(run), sizeof q[k]);
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
  for (int i = 0; i < 7; i++) {
    assert_true(fabs(q[0][i] - q[1][i]) <= LIMIT);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(accelerations_equal_those_without_redundant_rows),
    cmocka_unit_test(accelerations_agree_with_quadruple_precision),
    cmocka_unit_test(motions_equal_those_without_redundant_rows),
    cmocka_unit_test(multipliers_that_are_not_unique_are_marked),
    cmocka_unit_test(permanent_and_momentary_redundancy_are_distinguished_in_any_unit),
    cmocka_unit_test(a_run_may_start_next_to_a_singular_configuration),
    cmocka_unit_test(a_coupling_of_both_hinges_of_a_door_is_redundant),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
