/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests inputs: which functions receive them, where their values are stored, and how a change of an
 * input affects a run. In the runs, a load moves a particle of 2 kg along x. The load is 4 N times
 * the input u, so x'' = 2 u. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "construct.h"
#include "runs.h"
#include "step_mode.h"
#include "user_models.h"

/* ---- functions that record their inputs ---- */

typedef struct witness {
  int calls;
  bool none; /* whether the inputs were NULL */
  double seen[2];
  double fails_at; /* value of the first input at which force() fails */
} witness;

static int record_inputs(const double *inputs, witness *w)
{
  w->calls++;
  w->none = inputs == NULL;
  if (inputs) {
    w->seen[0] = inputs[0];
    w->seen[1] = inputs[1];
  }
  return inputs && inputs[0] == w->fails_at ? -1 : 0;
}

static int force(double t, const double *q, const double *v, const double *inputs, double *out,
                 void *user)
{
  (void)t;
  (void)q;
  (void)v;
  out[0] = inputs ? 4.0 * inputs[0] : 0.0;
  return record_inputs(inputs, user);
}

/* Records the inputs that the function receives. The derivative that it returns is zero. */
static int force_q(double t, const double *q, const double *v, const double *inputs, double *out,
                   void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)out;
  return record_inputs(inputs, user);
}

/* ---- mechanisms ---- */

typedef struct scene {
  baum_mechanism *mechanism;
  baum_body_id body;
  baum_input_id push;
  baum_input_id other;
} scene;

static scene empty_scene(bool with_inputs)
{
  scene s = {.mechanism = create_mechanism()};
  assert_int_equal(baum_mechanism_set_gravity(s.mechanism, 0.0, 0.0, 0.0), BAUM_OK);
  if (with_inputs) {
    assert_int_equal(baum_mechanism_add_input(s.mechanism, "push", 0.5, &s.push), BAUM_OK);
    assert_int_equal(baum_mechanism_add_input(s.mechanism, NULL, -3.0, &s.other), BAUM_OK);
  }
  baum_planar_particle_def bead = baum_planar_particle_def_default();
  bead.mass = 2.0;
  bead.velocity[0] = bead.velocity[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_particle(s.mechanism, &bead, &s.body), BAUM_OK);
  return s;
}

/* Makes a particle with a load. The initial value of u is 0.5. */
static scene pushed_scene(void)
{
  scene s = empty_scene(true);
  baum_planar_load_def load = baum_planar_load_def_default();
  load.body = s.body;
  load.force[0] = 4.0;
  load.input = s.push;
  assert_int_equal(baum_mechanism_add_planar_load(s.mechanism, &load, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(s.mechanism), BAUM_OK);
  return s;
}

/* Makes the same particle, with a user force instead of the load. */
static scene user_scene(witness *w, bool with_inputs)
{
  scene s = empty_scene(with_inputs);
  baum_user_force_def def = baum_user_force_def_default();
  def.bodies = &s.body;
  def.body_count = 1;
  def.force = force;
  def.force_q = force_q;
  def.user = w;
  assert_int_equal(baum_mechanism_add_user_force(s.mechanism, &def, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(s.mechanism), BAUM_OK);
  return s;
}

/* ---- the list ---- */

static void inputs_have_names_numbers_and_initial_values(void **state)
{
  (void)state;
  scene s = empty_scene(true);
  double value = 0.0;
  assert_int_equal(baum_mechanism_input_count(s.mechanism), 2);
  assert_string_equal(baum_mechanism_input_name(s.mechanism, s.push), "push");
  assert_string_equal(baum_mechanism_input_name(s.mechanism, s.other), "input2");
  assert_int_equal(baum_mechanism_get_input(s.mechanism, s.other, &value), BAUM_OK);
  assert_true(value == -3.0);
  assert_int_equal(baum_mechanism_set_input(s.mechanism, s.other, 7.0), BAUM_OK);
  assert_int_equal(baum_mechanism_get_input(s.mechanism, s.other, &value), BAUM_OK);
  assert_true(value == 7.0);
  assert_int_equal(baum_mechanism_add_input(s.mechanism, "third", 1.0, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_input_count(s.mechanism), 3);
  baum_mechanism_destroy(s.mechanism);
}

static void copies_have_the_same_inputs_and_their_own_values(void **state)
{
  (void)state;
  scene s = pushed_scene();
  baum_mechanism *copy = NULL;
  double value = 0.0;
  assert_int_equal(baum_mechanism_copy(s.mechanism, &copy), BAUM_OK);
  assert_int_equal(baum_mechanism_input_count(copy), 2);
  assert_string_equal(baum_mechanism_input_name(copy, s.push), "push");
  assert_int_equal(baum_mechanism_set_input(copy, s.push, 9.0), BAUM_OK);
  assert_int_equal(baum_mechanism_get_input(s.mechanism, s.push, &value), BAUM_OK);
  assert_true(value == 0.5);
  assert_int_equal(baum_mechanism_get_input(copy, s.push, &value), BAUM_OK);
  assert_true(value == 9.0);
  baum_mechanism_destroy(s.mechanism);
  /* The load of the copy refers to the copy's input. */
  baum_workspace *w = NULL;
  const double q[2] = {0.0, 0.0};
  double g[2];
  assert_int_equal(baum_mechanism_freeze(copy), BAUM_OK);
  assert_int_equal(baum_workspace_create(copy, &w), BAUM_OK);
  assert_int_equal(baum_workspace_force(w, 0.0, q, q, g), BAUM_OK);
  assert_true(g[0] == 36.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(copy);
}

/* ---- values of a workspace, and the inputs that functions receive ---- */

static void each_workspace_has_its_own_inputs(void **state)
{
  (void)state;
  scene s = pushed_scene();
  baum_workspace *w[2] = {NULL, NULL};
  const double q[2] = {0.0, 0.0};
  double g[2];
  for (int k = 0; k < 2; k++) {
    assert_int_equal(baum_workspace_create(s.mechanism, &w[k]), BAUM_OK);
    assert_true(baum_workspace_input(w[k], s.push) == 0.5);
    assert_true(baum_workspace_input(w[k], s.other) == -3.0);
  }
  assert_int_equal(baum_workspace_set_input(w[0], s.push, -1.5), BAUM_OK);
  assert_true(baum_workspace_input(w[0], s.push) == -1.5);
  assert_true(baum_workspace_input(w[1], s.push) == 0.5);
  assert_int_equal(baum_workspace_force(w[0], 0.0, q, q, g), BAUM_OK);
  assert_true(g[0] == -6.0 && g[1] == 0.0);
  assert_int_equal(baum_workspace_force(w[1], 0.0, q, q, g), BAUM_OK);
  assert_true(g[0] == 2.0 && g[1] == 0.0);
  baum_workspace_destroy(w[0]);
  baum_workspace_destroy(w[1]);
  baum_mechanism_destroy(s.mechanism);
}

static void check_seen(witness *seen, baum_workspace *w, double push)
{
  const double q[2] = {0.1, 0.2};
  double g[2];
  *seen = (witness){.fails_at = seen->fails_at};
  assert_int_equal(baum_workspace_force(w, 0.0, q, q, g), BAUM_OK);
  assert_int_equal(seen->calls, 1);
  assert_false(seen->none);
  assert_true(seen->seen[0] == push && seen->seen[1] == -3.0);
}

static void force_functions_receive_the_present_values_in_order(void **state)
{
  (void)state;
  witness seen = {.fails_at = 1e9};
  scene s = user_scene(&seen, true);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(s.mechanism, &w), BAUM_OK);
  check_seen(&seen, w, 0.5);
  assert_int_equal(baum_workspace_set_input(w, s.push, 2.0), BAUM_OK);
  check_seen(&seen, w, 2.0);
  /* Functions for derivatives receive inputs too. The last function that is called is force_q(). */
  baum_sparse sparse = {NULL, NULL, NULL, 0};
  const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX1};
  const double y[4] = {0.0, 0.0, 0.0, 0.0};
  assert_int_equal(baum_workspace_residual_jacobian(w, &dae, 1.0, 0.0, y, y, &sparse), BAUM_OK);
  double values[64];
  assert_in_range(sparse.nonzeros, 1, 64);
  sparse.values = values;
  seen = (witness){.fails_at = 1e9};
  assert_int_equal(baum_workspace_residual_jacobian(w, &dae, 1.0, 0.0, y, y, &sparse), BAUM_OK);
  assert_true(seen.calls > 0 && seen.seen[0] == 2.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(s.mechanism);
}

static void functions_receive_null_if_there_are_no_inputs(void **state)
{
  (void)state;
  witness seen = {.fails_at = 1e9};
  scene s = user_scene(&seen, false);
  const double q[2] = {0.0, 0.0};
  double g[2];
  baum_workspace *w = NULL;
  assert_int_equal(baum_mechanism_input_count(s.mechanism), 0);
  assert_int_equal(baum_workspace_create(s.mechanism, &w), BAUM_OK);
  assert_int_equal(baum_workspace_force(w, 0.0, q, q, g), BAUM_OK);
  assert_true(seen.calls > 0 && seen.none);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(s.mechanism);
}

static void user_coordinates_and_their_check_receive_inputs(void **state)
{
  (void)state;
  witness seen = {.fails_at = 1e9};
  scene s = empty_scene(true);
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = 1;
  def.mass = user_mass_of_first;
  def.force = force;
  def.force_q = force_q;
  def.user = &seen;
  assert_int_equal(baum_mechanism_add_coordinates(s.mechanism, &def, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(s.mechanism), BAUM_OK);
  assert_int_equal(baum_mechanism_check_derivatives(s.mechanism), BAUM_OK);
  assert_true(seen.calls > 0 && seen.seen[0] == 0.5 && seen.seen[1] == -3.0);
  baum_workspace *w = NULL;
  const double q[3] = {0.0, 0.0, 0.0};
  double g[3];
  assert_int_equal(baum_workspace_create(s.mechanism, &w), BAUM_OK);
  assert_int_equal(baum_workspace_force(w, 0.0, q, q, g), BAUM_OK);
  assert_true(g[2] == 2.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(s.mechanism);
}

/* ---- runs ---- */

static baum_simulation *start_in(const baum_mechanism *mechanism, step_mode mode)
{
  baum_simulation_options o = step_mode_options(mode, 1e-3, 1e-9);
  return create_run(mechanism, &o);
}

/* Starts a run, with a fixed step if the integrator has one. */
static baum_simulation *start(const baum_mechanism *mechanism, const baum_integrator *integrator)
{
  return start_in(mechanism, (step_mode){integrator, baum_integrator_has_fixed_step(integrator)});
}

/* Returns the largest allowed error of x and v. For variable steps, this is 100 rtol times the size
 * of the motion. For fixed steps of order 1, it is h |x''| T / 2 with h = 1e-3, |x''| <= 6 and
 * T = 1. For order 2 and higher, only rounding is allowed, because the motion between changes of u
 * is a parabola. */
static double allowed(step_mode mode)
{
  if (!mode.fixed) {
    return 5e-7;
  }
  return baum_integrator_order(mode.integrator) == 1 ? 3e-3 : 1e-12;
}

/* Advances to t and compares with the exact motion. This motion is at (x, v) at the time t - h, and
 * has the constant acceleration a. */
static void check_motion(baum_simulation *run, double t, double h, double a, double x, double v,
                         double off)
{
  assert_int_equal(baum_simulation_advance_to(run, t), BAUM_OK);
  ASSERT_NEAR(baum_simulation_q(run)[0], x + h * (v + 0.5 * h * a), 0.0, off);
  ASSERT_NEAR(baum_simulation_v(run)[0], v + h * a, 0.0, off);
}

enum { CHANGES = 3 };

static void check_run(step_mode mode)
{
  /* These times are grid points of fixed steps. If the input did not change, one variable step
   * would pass over several of these times. */
  static const double until[CHANGES + 1] = {0.25, 0.375, 0.75, 1.0};
  static const double inputs[CHANGES + 1] = {0.5, -3.0, 0.0, 1.25};
  scene s = pushed_scene();
  baum_simulation *run = start_in(s.mechanism, mode);
  double t = 0.0;
  double x = 0.0;
  double v = 0.0;
  for (int k = 0; k <= CHANGES; k++) {
    double before[2] = {baum_simulation_q(run)[0], baum_simulation_v(run)[0]};
    assert_int_equal(baum_simulation_set_input(run, s.push, inputs[k]), BAUM_OK);
    assert_int_equal(baum_simulation_set_input(run, s.push, inputs[k]), BAUM_OK);
    assert_true(baum_simulation_input(run, s.push) == inputs[k]);
    assert_true(baum_simulation_time(run) == t);
    assert_true(baum_simulation_q(run)[0] == before[0] && baum_simulation_v(run)[0] == before[1]);
    /* The first call advances to a time shortly after the change. The last step before the change
     * may already have passed this time, and the result must not come from that step. */
    check_motion(run, t + 1e-3, 1e-3, 2.0 * inputs[k], x, v, allowed(mode));
    double h = until[k] - t;
    check_motion(run, until[k], h, 2.0 * inputs[k], x, v, allowed(mode));
    x += h * (v + h * inputs[k]);
    v += 2.0 * h * inputs[k];
    t = until[k];
  }
  /* The first value that is set equals the initial value of the input, so it causes no restart. */
  int64_t changes = step_mode_remembers(mode) ? CHANGES : 0;
  assert_true(counters_of(run).restarts >= changes);
  assert_true(step_mode_is_adams(mode) ||
              counters_of(run).restarts ==
                changes); /* Adams methods also restart after short steps */
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

static void a_change_acts_from_the_present_time_on(void **state)
{
  (void)state;
  int count = 0;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    /* Methods that offer only index 3 are excluded. */
    if (baum_integrator_offers(step_mode_at(k).integrator, BAUM_FORMULATION_BAUMGARTE)) {
      check_run(step_mode_at(k));
      count++;
    }
  }
  assert_in_range(count, 12, 100);
}

static void each_run_has_its_own_inputs(void **state)
{
  (void)state;
  scene s = pushed_scene();
  baum_simulation *one = start(s.mechanism, baum_rk2());
  baum_simulation *two = start(s.mechanism, baum_rk2());
  double initial = 0.0;
  assert_int_equal(baum_simulation_set_input(one, s.push, -1.0), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(one, 1.0), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(two, 1.0), BAUM_OK);
  /* The method integrates x = u t^2 exactly, up to the rounding errors of 1000 steps. */
  ASSERT_NEAR(baum_simulation_q(one)[0], -1.0, 1e-12, 0.0);
  ASSERT_NEAR(baum_simulation_q(two)[0], 0.5, 1e-12, 0.0);
  assert_int_equal(baum_mechanism_get_input(s.mechanism, s.push, &initial), BAUM_OK);
  assert_true(initial == 0.5);
  baum_simulation_destroy(one);
  baum_simulation_destroy(two);
  baum_mechanism_destroy(s.mechanism);
}

static void set_state_keeps_the_inputs(void **state)
{
  (void)state;
  scene s = pushed_scene();
  baum_simulation *run = start(s.mechanism, baum_rk2());
  const double zero[2] = {0.0, 0.0};
  assert_int_equal(baum_simulation_set_input(run, s.push, 3.0), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(run, 0.5), BAUM_OK);
  assert_int_equal(baum_simulation_set_state(run, 0.0, zero, zero), BAUM_OK);
  assert_true(baum_simulation_input(run, s.push) == 3.0);
  assert_int_equal(baum_simulation_advance_to(run, 1.0), BAUM_OK);
  ASSERT_NEAR(baum_simulation_q(run)[0], 3.0, 1e-12, 0.0); /* rounding errors, as above */
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

/* A change of an input restarts IDA, which then evaluates the forces. If this fails, the old value
 * is restored. */
static void a_change_of_an_input_that_fails_is_undone(void **state)
{
  (void)state;
  if (!baum_has("sundials")) {
    skip();
  }
  witness seen = {.fails_at = 13.0};
  scene s = user_scene(&seen, true);
  baum_simulation *run = start(s.mechanism, baum_ida());
  assert_int_equal(baum_simulation_advance_to(run, 0.4), BAUM_OK);
  assert_int_equal(baum_simulation_set_input(run, s.push, 13.0), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_simulation_message(run),
                      "force 1 \"force1\": force() returned -1 (stop)");
  assert_true(baum_simulation_input(run, s.push) == 0.5);
  assert_true(baum_simulation_time(run) == 0.4);
  assert_int_equal(counters_of(run).restarts, 0);
  /* The run continues with the old input. The first of the following times lie inside the last
   * step. At these times, too, the motion must follow the old input. */
  for (double t = 0.401; t < 1.0; t += 0.0999) {
    assert_int_equal(baum_simulation_advance_to(run, t), BAUM_OK);
    ASSERT_NEAR(baum_simulation_q(run)[0], 0.5 * t * t, 0.0,
                allowed((step_mode){baum_ida(), false}));
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(inputs_have_names_numbers_and_initial_values),
    cmocka_unit_test(copies_have_the_same_inputs_and_their_own_values),
    cmocka_unit_test(each_workspace_has_its_own_inputs),
    cmocka_unit_test(force_functions_receive_the_present_values_in_order),
    cmocka_unit_test(functions_receive_null_if_there_are_no_inputs),
    cmocka_unit_test(user_coordinates_and_their_check_receive_inputs),
    cmocka_unit_test(a_change_acts_from_the_present_time_on),
    cmocka_unit_test(each_run_has_its_own_inputs),
    cmocka_unit_test(set_state_keeps_the_inputs),
    cmocka_unit_test(a_change_of_an_input_that_fails_is_undone),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
