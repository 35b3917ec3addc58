/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests drivers that are set during a run. In the scene, a motor rotates a crank about its centre,
 * and a rod hangs freely from the crank. A winch moves a cart on a guide. The law of the winch is a
 * user function or a spline. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "runs.h"
#include "step_mode.h"

static const double RATE = 2.0; /* [rad/s] angular velocity in the definition of the motor */

/* Tells which law the winch uses and whether the user force fails, and counts the calls of the
 * law. */
typedef struct faults {
  bool along_spline; /* the law of the winch is a spline, not the user function */
  int law_calls;
  bool force_fails;
} faults;

/* The law 0.1 sin(3 t). */
static int swing(double t, double s[3], void *user)
{
  faults *f = user;
  f->law_calls++;
  s[0] = 0.1 * sin(3.0 * t);
  s[1] = 0.3 * cos(3.0 * t);
  s[2] = -0.9 * sin(3.0 * t);
  return 0;
}

static int no_force(double t, const double *q, const double *v, const double *inputs, double *out,
                    void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  (void)out;
  const faults *f = user;
  return f->force_fails ? -1 : 0;
}

/* ---- the scene ---- */

typedef struct scene {
  baum_mechanism *mechanism;
  baum_body_id crank;
  baum_body_id rod;
  baum_body_id cart;
  baum_joint_id pin;
  baum_joint_id guide;
  baum_joint_id motor; /* drives the pin */
  baum_joint_id winch; /* drives the guide */
} scene;

static baum_body_id add_body(const scene *s, double x, double y, double angle)
{
  baum_body_id id;
  baum_planar_body_def def = baum_planar_body_def_default();
  def.inertia = 0.01;
  def.position[0] = x;
  def.position[1] = y;
  def.angle = angle;
  assert_int_equal(baum_mechanism_add_planar_body(s->mechanism, &def, &id), BAUM_OK);
  return id;
}

static baum_joint_id add_pin(const scene *s, baum_body_id a, baum_body_id b, double at_a,
                             double at_b)
{
  baum_joint_id id;
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  def.body_a = a;
  def.body_b = b;
  def.point_a[0] = at_a;
  def.point_b[0] = at_b;
  def.point_a[1] = def.point_b[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_revolute(s->mechanism, &def, &id), BAUM_OK);
  return id;
}

/* Adds a spline driver that prescribes 0.5 t. */
static void add_spline_winch(scene *s)
{
  static const double times[3] = {-1.0, 0.0, 1.0};
  static const double values[3] = {-0.5, 0.0, 0.5};
  baum_spline_driver_def def = baum_spline_driver_def_default();
  def.joint = s->guide;
  def.times = times;
  def.values = values;
  def.count = 3;
  assert_int_equal(baum_mechanism_add_spline_driver(s->mechanism, &def, &s->winch), BAUM_OK);
}

static void add_drivers(scene *s, faults *f)
{
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  def.joint = s->pin;
  def.rate = RATE;
  assert_int_equal(baum_mechanism_add_driver(s->mechanism, &def, &s->motor), BAUM_OK);
  if (f->along_spline) {
    add_spline_winch(s);
    return;
  }
  def = baum_driver_def_default();
  def.name = "winch";
  def.joint = s->guide;
  def.law = swing;
  def.user = f;
  assert_int_equal(baum_mechanism_add_driver(s->mechanism, &def, &s->winch), BAUM_OK);
}

static scene make_scene(faults *f)
{
  scene s = {.mechanism = create_mechanism()};
  s.crank = add_body(&s, 0.0, 0.0, 0.0);
  s.rod = add_body(&s, 0.1, -0.2, -acos(0.0));
  s.cart = add_body(&s, 0.0, 1.0, 0.0);
  s.pin = add_pin(&s, BAUM_GROUND, s.crank, 0.0, 0.0);
  (void)add_pin(&s, s.crank, s.rod, 0.1, -0.2);
  baum_planar_translational_def guide = baum_planar_translational_def_default();
  guide.body_a = BAUM_GROUND;
  guide.body_b = s.cart;
  guide.point[0] = 0.0;
  guide.point[1] = 1.0;
  assert_int_equal(baum_mechanism_add_planar_translational(s.mechanism, &guide, &s.guide), BAUM_OK);
  add_drivers(&s, f);
  baum_user_force_def force = baum_user_force_def_default();
  force.depends_on_velocity = false;
  force.bodies = &s.rod;
  force.body_count = 1;
  force.force = no_force;
  force.depends_on_velocity = false;
  force.user = f;
  assert_int_equal(baum_mechanism_add_user_force(s.mechanism, &force, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(s.mechanism), BAUM_OK);
  return s;
}

/* ---- runs ---- */

static baum_simulation_options options_of(const baum_integrator *integrator)
{
  bool fixed = baum_integrator_has_fixed_step(integrator);
  return step_mode_options((step_mode){integrator, fixed}, 1e-3, 1e-9);
}

/* Value and velocity of the coordinate of a joint. */
typedef struct motion {
  double value;
  double rate;
} motion;

static motion motion_of(baum_simulation *run, baum_joint_id joint)
{
  double row[2];
  const baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, joint);
  assert_int_equal(baum_simulation_get(run, &channel, 1, row), BAUM_OK);
  return (motion){row[0], row[1]};
}

static void check_within(baum_simulation *run, baum_joint_id joint, double t, motion want,
                         motion off)
{
  check(baum_simulation_advance_to(run, t));
  motion got = motion_of(run, joint);
  ASSERT_NEAR(got.value, want.value, 0.0, off.value);
  ASSERT_NEAR(got.rate, want.rate, 0.0, off.rate);
}

/* Checks the value and the velocity of a joint's coordinate. The tolerance for the velocity is ten
 * times as large. */
static void check_at(baum_simulation *run, baum_joint_id joint, double t, motion want,
                     double tolerance)
{
  check_within(run, joint, t, want, (motion){tolerance, 10.0 * tolerance});
}

/* ---- every method ---- */

/* Returns the largest allowed errors of a driven coordinate. For variable steps, they are 300 rtol
 * in position and 3000 rtol in velocity. For Euler methods with gains of 1/h, they are h^2 |s''| in
 * position and h |s''| / 2 in velocity with |s''| = 8, plus 10 %. Two exceptions are explained
 * below. All other fixed-step methods project and have only rounding errors. */
static motion allowed(step_mode mode)
{
  if (!mode.fixed) {
    return (motion){3e-7, 3e-6};
  }
  /* Adams-Bashforth methods do not project. Their errors are of order h^2 = 1e-6 s^2. */
  if (step_mode_is_adams(mode)) {
    return (motion){1e-6, 1e-5};
  }
  /* The generalized-alpha method projects only positions. Its velocities have errors of about h^2
   * |s'''| / 10 with |s'''| <= 2.7. Ten times this value is allowed. */
  if (mode.integrator == baum_generalized_alpha()) {
    return (motion){1e-12, 2.7e-6};
  }
  return baum_integrator_order(mode.integrator) == 1 ? (motion){8.8e-6, 4.4e-3}
                                                     : (motion){1e-12, 1e-11};
}

static void check_laws(step_mode mode)
{
  faults f = {0};
  scene s = make_scene(&f);
  baum_simulation_options o = step_mode_options(mode, 1e-3, 1e-9);
  baum_simulation *run = create_run(s.mechanism, &o);
  motion off = allowed(mode);
  check_within(run, s.pin, 0.3, (motion){RATE * 0.3, RATE}, off);
  motion now = motion_of(run, s.pin);
  assert_int_equal(baum_simulation_set_driver(run, s.motor, now.value, now.rate, 8.0), BAUM_OK);
  assert_true(motion_of(run, s.pin).value == now.value);
  check_within(run, s.pin, 0.7, (motion){0.6 + 0.4 * RATE + 0.5 * 8.0 * 0.16, RATE + 0.4 * 8.0},
               off);
  /* The winch must continue with the law of its definition. */
  check_within(run, s.guide, 0.7, (motion){0.1 * sin(2.1), 0.3 * cos(2.1)}, off);
  now = motion_of(run, s.pin);
  assert_int_equal(baum_simulation_set_driver(run, s.motor, now.value, now.rate, 0.0), BAUM_OK);
  check_within(run, s.pin, 1.0, (motion){now.value + 0.3 * now.rate, now.rate}, off);
  int64_t changes = step_mode_remembers(mode) ? 2 : 0;
  assert_true(counters_of(run).restarts >= changes);
  /* Shortened steps also cause restarts. */
  bool by_short_steps = mode.fixed && step_mode_remembers(mode);
  assert_true(by_short_steps || counters_of(run).restarts == changes);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

static void a_law_acts_from_the_current_time_on(void **state)
{
  (void)state;
  int count = 0;
  while (step_mode_at(count).integrator) {
    check_laws(step_mode_at(count++));
  }
  assert_in_range(count, 12, 100);
}

/* ---- replacing a user law ---- */

static void a_law_that_is_set_replaces_a_users_law_in_this_run_only(void **state)
{
  (void)state;
  faults f = {0};
  scene s = make_scene(&f);
  baum_simulation_options o = options_of(baum_rk4());
  baum_simulation *run = create_run(s.mechanism, &o);
  baum_simulation *other = create_run(s.mechanism, &o);
  check_at(run, s.guide, 0.2, (motion){0.1 * sin(0.6), 0.3 * cos(0.6)}, 1e-12); /* rounding */
  motion now = motion_of(run, s.guide);
  assert_int_equal(baum_simulation_set_driver(run, s.winch, now.value, now.rate, -1.0), BAUM_OK);
  f.law_calls = 0;
  check_at(run, s.guide, 0.6, (motion){now.value + 0.4 * now.rate - 0.08, now.rate - 0.4}, 1e-12);
  assert_int_equal(f.law_calls, 0);
  check_at(other, s.guide, 0.6, (motion){0.1 * sin(1.8), 0.3 * cos(1.8)}, 1e-12);
  assert_true(f.law_calls > 0);
  baum_simulation_destroy(run);
  baum_simulation_destroy(other);
  /* The definition in the mechanism must be unchanged, so that a new run uses the user's law. */
  run = create_run(s.mechanism, &o);
  check_at(run, s.guide, 0.1, (motion){0.1 * sin(0.3), 0.3 * cos(0.3)}, 1e-12);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

static void a_law_that_is_set_replaces_a_spline(void **state)
{
  (void)state;
  faults f = {.along_spline = true};
  scene s = make_scene(&f);
  baum_simulation_options o = options_of(baum_rk4());
  baum_simulation *run = create_run(s.mechanism, &o);
  check_at(run, s.guide, 0.2, (motion){0.1, 0.5}, 1e-12); /* rounding */
  assert_int_equal(baum_simulation_set_driver(run, s.winch, 0.1, 0.5, -1.0), BAUM_OK);
  check_at(run, s.guide, 0.6, (motion){0.1 + 0.2 - 0.08, 0.5 - 0.4}, 1e-12);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

static void the_time_of_a_law_counts_from_its_setting_in_both_directions(void **state)
{
  (void)state;
  faults f = {0};
  scene s = make_scene(&f);
  baum_simulation_options o = options_of(baum_rk4());
  o.start_time = -0.1;
  baum_simulation *run = create_run(s.mechanism, &o);
  check_at(run, s.pin, 0.2, (motion){0.4, RATE}, 1e-12);
  assert_int_equal(baum_simulation_set_driver(run, s.motor, 0.4, RATE, 3.0), BAUM_OK);
  check_at(run, s.pin, 0.3, (motion){0.4 + 0.2 + 0.015, RATE + 0.3}, 1e-12);
  check_at(run, s.pin, 0.1, (motion){0.4 - 0.2 + 0.015, RATE - 0.3}, 1e-12);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

static void the_law_is_called_once_per_evaluation(void **state)
{
  (void)state;
  faults f = {0};
  scene s = make_scene(&f);
  baum_workspace *w = NULL;
  double q[9];
  const double v[9] = {0.0};
  double a[9];
  assert_int_equal(baum_workspace_create(s.mechanism, &w), BAUM_OK);
  assert_int_equal(baum_workspace_design(w, q, NULL), BAUM_OK);
  f.law_calls = 0;
  assert_int_equal(baum_workspace_acceleration(w, 0.0, q, v, 1.0, 1.0, a, NULL), BAUM_OK);
  assert_int_equal(f.law_calls, 1);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(s.mechanism);
}

/* ---- jumps with each formulation ---- */

static const double JUMP = 0.05; /* [rad] */

/* Starts a run. At 0.1 s, sets the motor to an angle that differs from the current angle by
 * JUMP. */
static baum_simulation *jump(const scene *s, baum_formulation formulation, baum_gains gains)
{
  baum_simulation_options o = options_of(baum_rk4());
  o.formulation = formulation;
  o.gains = gains;
  baum_simulation *run = create_run(s->mechanism, &o);
  assert_int_equal(baum_simulation_advance_to(run, 0.1), BAUM_OK);
  motion now = motion_of(run, s->pin);
  assert_int_equal(baum_simulation_set_driver(run, s->motor, now.value + JUMP, now.rate, 0.0),
                   BAUM_OK);
  ASSERT_NEAR(motion_of(run, s->pin).value, now.value, 0.0, 0.0);
  return run;
}

static void with_projection_the_next_step_jumps_to_the_law(void **state)
{
  (void)state;
  faults f = {0};
  scene s = make_scene(&f);
  const baum_gains none = {.rule = BAUM_GAINS_DEFAULT};
  baum_simulation *run = jump(&s, BAUM_FORMULATION_PROJECTION, none);
  assert_int_equal(baum_simulation_step(run, 1), BAUM_OK);
  ASSERT_NEAR(motion_of(run, s.pin).value, RATE * 0.101 + JUMP, 0.0, 1e-12); /* rounding */
  baum_counters c = counters_of(run);
  ASSERT_NEAR(c.max_phi, JUMP, 0.0, 1e-12); /* the violation at the start of this step */
  assert_memory_equal(&c.max_phi_joint, &s.motor, sizeof s.motor);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

/* If alpha = beta, the violation decays as Phi = -JUMP (1 + alpha t) exp(-alpha t). The relative
 * error of rk4 is about (alpha h)^4. */
static void with_baumgarte_the_difference_to_the_law_decays_with_the_gains(void **state)
{
  (void)state;
  faults f = {0};
  scene s = make_scene(&f);
  baum_simulation *run = jump(&s, BAUM_FORMULATION_BAUMGARTE, baum_gains_fixed(20.0, 20.0));
  for (int k = 1; k <= 5; k++) {
    double tau = 0.05 * k;
    double phi = -JUMP * (1.0 + 20.0 * tau) * exp(-20.0 * tau);
    check_at(
      run, s.pin, 0.1 + tau,
      (motion){RATE * (0.1 + tau) + JUMP + phi, RATE + JUMP * 400.0 * tau * exp(-20.0 * tau)},
      1e-7);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

static void without_stabilization_the_difference_to_the_law_stays(void **state)
{
  (void)state;
  faults f = {0};
  scene s = make_scene(&f);
  const baum_gains none = {.rule = BAUM_GAINS_DEFAULT};
  baum_simulation *run = jump(&s, BAUM_FORMULATION_UNSTABILIZED, none);
  check_at(run, s.pin, 0.4, (motion){RATE * 0.4, RATE}, 1e-12); /* up to rounding */
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

/* ---- failure ---- */

/* Setting a law restarts IDA, which evaluates the mechanism. If this evaluation fails, the old law
 * remains. In this test, a user force fails. */
static void a_law_is_not_set_if_the_restart_fails(void **state)
{
  (void)state;
  if (!baum_has("sundials")) {
    skip();
  }
  faults f = {0};
  scene s = make_scene(&f);
  baum_simulation_options o = options_of(baum_ida());
  baum_simulation *run = create_run(s.mechanism, &o);
  assert_int_equal(baum_simulation_advance_to(run, 0.2), BAUM_OK);
  for (int k = 0; k < 2; k++) {
    f.force_fails = true;
    assert_int_equal(baum_simulation_set_driver(run, s.motor, 3.0, 0.0, 0.0), BAUM_ERR_CALLBACK);
    f.force_fails = false;
    assert_int_equal(counters_of(run).restarts, 0);
    check_at(run, s.pin, 0.3 + 0.1 * k, (motion){RATE * (0.3 + 0.1 * k), RATE}, 1e-6);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_law_acts_from_the_current_time_on),
    cmocka_unit_test(a_law_that_is_set_replaces_a_users_law_in_this_run_only),
    cmocka_unit_test(a_law_that_is_set_replaces_a_spline),
    cmocka_unit_test(the_time_of_a_law_counts_from_its_setting_in_both_directions),
    cmocka_unit_test(the_law_is_called_once_per_evaluation),
    cmocka_unit_test(with_projection_the_next_step_jumps_to_the_law),
    cmocka_unit_test(with_baumgarte_the_difference_to_the_law_decays_with_the_gains),
    cmocka_unit_test(without_stabilization_the_difference_to_the_law_stays),
    cmocka_unit_test(a_law_is_not_set_if_the_restart_fails),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
