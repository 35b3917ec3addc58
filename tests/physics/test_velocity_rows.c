/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests rows of velocity level, that is, non-holonomic constraints. Chaplygin's sleigh is compared
 * with its closed form, with every integrator and formulation. Further tests cover the stability of
 * the gain for such rows, degrees of freedom, redundancy, work, and saving and restoring a run. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/catalog.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "runs.h"
#include "step_mode.h"

/* ---- Chaplygin's sleigh, which is in the catalogue ---- */

static const double MASS = 2.0;
static const double INERTIA = 0.15;
static const double D = 0.3;
static const double ANGLE = 0.4; /* at the start */
static const double U0 = 0.5;
static const double W0 = 1.3;

static baum_body_id add_body(baum_mechanism *m, double u, double w)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.name = "sleigh";
  def.mass = MASS;
  def.inertia = INERTIA;
  def.angle = ANGLE;
  def.velocity[0] = u * cos(ANGLE) - w * D * sin(ANGLE);
  def.velocity[1] = u * sin(ANGLE) + w * D * cos(ANGLE);
  def.angular_velocity = w;
  check(baum_mechanism_add_planar_body(m, &def, &id));
  return id;
}

static baum_joint_id add_blade(baum_mechanism *m, baum_body_id body, double behind)
{
  baum_planar_knife_edge_def def = baum_planar_knife_edge_def_default();
  baum_joint_id id;
  def.name = "blade";
  def.body_a = body;
  def.point_a[0] = -behind;
  def.point_a[1] = 0.0;
  check(baum_mechanism_add_planar_knife_edge(m, &def, &id));
  return id;
}

static baum_mechanism *start_plane(void)
{
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
  return m;
}

static const baum_catalog_choice SLEIGH = {.name = "chaplygin_sleigh"};

static baum_mechanism *make_sleigh(void)
{
  baum_mechanism *m = NULL;
  check(baum_catalog_build(&SLEIGH, &m));
  return m;
}

static const double END = 4.0;

/* Returns the largest allowed error at h = 1e-3 s or rtol = 1e-9. The limits are listed by order,
 * and the first one is for variable steps. Each is at least three times the largest measured
 * value. */
static double allowed(step_mode mode)
{
  static const double by_order[] = {1e-7, 5e-3, 1e-6, 1e-8, 2e-10, 1e-11, 1e-12, 1e-12, 1e-12};
  return by_order[mode.fixed ? baum_integrator_order(mode.integrator) : 0];
}

static void expect(const char *what, double got, double most, step_mode mode,
                   baum_formulation formulation)
{
  if (!(got <= most)) {
    fail_msg("%s, %s, %s: %s is %.3g, allowed %.3g", baum_integrator_name(mode.integrator),
             mode.fixed ? "fixed step" : "variable step", baum_formulation_name(formulation), what,
             got, most);
  }
}

static void slide(const baum_mechanism *m, step_mode mode, baum_formulation formulation)
{
  baum_simulation_options options = step_mode_options(mode, 1e-3, 1e-9);
  options.formulation = formulation;
  options.energy_account = true;
  baum_simulation *run = create_run(m, &options);
  check(step_mode_advance(mode, run, END));
  baum_counters counters = counters_of(run);
  const double *q = baum_simulation_q(run);
  const double *v = baum_simulation_v(run);
  double want_q[3];
  double want_v[3];
  check(baum_catalog_reference(&SLEIGH, END, want_q, want_v));
  double most = allowed(mode);
  double error = 0.0;
  for (int i = 0; i < 3; i++) {
    error = fmax(error, fmax(fabs(q[i] - want_q[i]), fabs(v[i] - want_v[i])));
  }
  bool kept = formulation == BAUM_FORMULATION_PROJECTION;
  expect("the error", error, most, mode, formulation);
  expect("the violation of the velocity", counters.max_phi_rate, kept ? 1e-15 : most, mode,
         formulation);
  expect("the change of energy", fabs(counters.energy_change), most, mode, formulation);
  expect("the energy residual", fabs(counters.energy_residual), most, mode, formulation);
  assert_true(counters.max_phi == 0.0);
  baum_simulation_destroy(run);
}

static void the_sleigh_follows_its_closed_form(void **state)
{
  (void)state;
  int tried = 0;
  baum_mechanism *m = make_sleigh();
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    for (int f = BAUM_FORMULATION_DEFAULT + 1; baum_formulation_name((baum_formulation)f); f++) {
      if (baum_integrator_offers(mode.integrator, (baum_formulation)f) &&
          mode.integrator != baum_rattle()) {
        slide(m, mode, (baum_formulation)f);
        tried++;
      }
    }
  }
  assert_true(tried >= 20);
  baum_mechanism_destroy(m);
}

/* ---- stability ---- */

enum { GRID = 40, STEPS = 400 };
static const double STEP = 1e-3;
static const double ACROSS = 1e-3; /* [m/s] initial violation */

/* Makes a body that does not rotate and has its blade at the centre of mass. J is then constant,
 * and only the gain changes the velocity across the blade. */
static baum_mechanism *make_straight(void)
{
  baum_mechanism *m = start_plane();
  add_blade(m, add_body(m, 1.0, 0.0), 0.0);
  check(baum_mechanism_freeze(m));
  return m;
}

static baum_simulation_options with_alpha(const baum_integrator *integrator, double alpha_h)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  options.step = STEP;
  options.gains = baum_gains_fixed(alpha_h / STEP, 0.0);
  options.start = BAUM_START_AS_GIVEN;
  return options;
}

/* Returns the factor by which the violation grows per step, as a mean over the second half of a
 * run. Returns 2 if the violation becomes larger than 1e9 m/s, and 0 if it becomes smaller than
 * 1e-12 m/s. */
static double growth_of(const baum_mechanism *m, const baum_integrator *integrator, double alpha_h)
{
  baum_simulation_options options = with_alpha(integrator, alpha_h);
  double violation[2] = {0.0, 0.0};
  const baum_channel channel = baum_channel_of(BAUM_PHI_RATE);
  options.allow_unstable = true;
  baum_simulation *run = create_run(m, &options);
  const double q[3] = {0.0, 0.0, ANGLE};
  const double v[3] = {cos(ANGLE) - ACROSS * sin(ANGLE), sin(ANGLE) + ACROSS * cos(ANGLE), 0.0};
  check(baum_simulation_set_state(run, 0.0, q, v));
  int steps = 0;
  for (int k = 0; k < 2; k++) {
    for (int n = 0; n < STEPS / 2 && (k == 0 || fabs(violation[0]) > 1e-12); n++, steps += k) {
      baum_status status = baum_simulation_step(run, 1);
      assert_true(status == BAUM_OK || status == BAUM_WARNED);
      check(baum_simulation_get(run, &channel, 1, &violation[k]));
      if (fabs(violation[k]) > 1e9 || fabs(violation[k]) < 1e-12) {
        baum_simulation_destroy(run);
        return fabs(violation[k]) > 1.0 ? 2.0 : 0.0;
      }
    }
  }
  baum_simulation_destroy(run);
  return pow(fabs(violation[1] / violation[0]), 1.0 / steps);
}

static int compare_boundary(const baum_mechanism *m, const baum_integrator *integrator)
{
  double limit = 0.0;
  int compared = 0;
  check(baum_stability_velocity_limit(integrator, &limit));
  assert_true(limit > 0.1 && limit < 20.0);
  for (int k = 1; k <= GRID; k++) {
    double alpha_h = 1.5 * limit * k / GRID;
    baum_amplification predicted;
    check(baum_stability_velocity_at(integrator, alpha_h, &predicted, sizeof predicted));
    assert_true(isnan(predicted.z[1][0]));
    double radius = predicted.spectral_radius;
    if (fabs(radius - 1.0) < 1e-3) {
      continue;
    }
    double growth = growth_of(m, integrator, alpha_h);
    if ((growth > 1.0) != (radius > 1.0)) {
      fail_msg("%s at alpha h = %g: predicted %g, simulated %g", baum_integrator_name(integrator),
               alpha_h, radius, growth);
    }
    /* If growth_of() returns 0 or 2, the result is not a mean factor. */
    assert_true(growth == 0.0 || growth == 2.0 || fabs(growth - radius) <= 1e-2 * radius);
    compared++;
  }
  return compared;
}

static void predicted_and_simulated_stability_agree(void **state)
{
  (void)state;
  int methods = 0;
  baum_mechanism *m = make_straight();
  for (int32_t i = 0; baum_integrator_at(i); i++) {
    double limit;
    const baum_integrator *integrator = baum_integrator_at(i);
    if (baum_integrator_has_fixed_step(integrator) &&
        baum_stability_velocity_limit(integrator, &limit) == BAUM_OK) {
      assert_true(compare_boundary(m, integrator) >= GRID - 3);
      methods++;
    }
  }
  assert_true(methods >= 10);
  baum_mechanism_destroy(m);
}

static void unstable_gains_are_refused(void **state)
{
  (void)state;
  baum_mechanism *m = make_straight();
  for (int32_t i = 0; baum_integrator_at(i); i++) {
    double limit;
    const baum_integrator *integrator = baum_integrator_at(i);
    if (!baum_integrator_has_fixed_step(integrator) ||
        baum_stability_velocity_limit(integrator, &limit) != BAUM_OK) {
      continue;
    }
    baum_simulation_options options = with_alpha(integrator, 0.99 * limit);
    baum_simulation *run = create_run(m, &options);
    assert_non_null(strstr(baum_simulation_explain(run), "rows of velocity level: alpha h"));
    baum_simulation_destroy(run);
    options = with_alpha(integrator, 1.01 * limit);
    assert_int_equal(baum_simulation_create(m, &options, &run), BAUM_ERR_UNSTABLE);
    assert_non_null(strstr(baum_message(), "violations of velocities grow"));
    /* The same gain must also be refused if the row has a factor of 0.5, because the gain is
     * checked without this factor, too. */
    const double half[1] = {0.5};
    options.row_gains = half;
    options.row_gain_count = 1;
    assert_int_equal(baum_simulation_create(m, &options, &run), BAUM_ERR_UNSTABLE);
    options.gains = baum_gains_fixed(0.6 * limit / STEP, 0.0);
    run = create_run(m, &options);
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* The default gains of every integrator must be stable for a mechanism that has both rows of
 * velocity level and rows of positions. */
static void default_gains_are_stable(void **state)
{
  (void)state;
  baum_mechanism *m = start_plane();
  baum_body_id body = add_body(m, U0, W0);
  baum_body_id arm = add_body(m, (double)NAN, (double)NAN);
  add_blade(m, body, D);
  (void)add_planar_pin(m, NULL, body, arm, 0.5, 0.5);
  check(baum_mechanism_freeze(m));
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    baum_simulation_options options = step_mode_options(mode, 1e-2, 1e-6);
    options.formulation = BAUM_FORMULATION_BAUMGARTE;
    if (!baum_integrator_offers(mode.integrator, options.formulation)) {
      continue;
    }
    baum_simulation *run = create_run(m, &options);
    check(step_mode_advance(mode, run, 1.0));
    baum_counters counters = counters_of(run);
    assert_true(!(counters.spectral_radius > 1.0 - 1e-5));
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* ---- what refuses rows of velocity level ---- */

static void rattle_and_kinematics_refuse_rows_of_velocity_level(void **state)
{
  (void)state;
  baum_simulation *run = NULL;
  baum_mechanism *m = make_sleigh();
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rattle();
  options.step = 1e-3;
  assert_int_equal(baum_simulation_create(m, &options, &run), BAUM_ERR_UNSUPPORTED);
  assert_non_null(strstr(baum_message(), "joint 1 \"blade\" has rows of velocity level"));
  options = baum_simulation_options_default();
  options.integrator = baum_kinematics();
  assert_int_equal(baum_simulation_create(m, &options, &run), BAUM_ERR_UNSUPPORTED);
  assert_non_null(strstr(baum_message(), "1 constraint row is of velocity level"));
  baum_mechanism_destroy(m);
}

/* ---- degrees of freedom and redundancy ---- */

static void position_and_velocity_degrees_of_freedom_differ(void **state)
{
  (void)state;
  baum_mobility mobility;
  baum_report report;
  baum_mechanism *m = make_sleigh();
  check(baum_mechanism_mobility(m, &mobility, sizeof mobility));
  assert_int_equal(mobility.degrees_of_freedom, 2);
  assert_int_equal(mobility.position_degrees_of_freedom, 3);
  assert_int_equal(mobility.velocity_rows, 1);
  assert_non_null(strstr(
    mobility.text, "1 row of velocity level; degrees of freedom: 2 of velocity, 3 of position."));
  check(baum_mechanism_report(m, &report, sizeof report));
  assert_int_equal(report.degrees_of_freedom, 2);
  assert_int_equal(report.position_degrees_of_freedom, 3);
  assert_non_null(strstr(report.text, "degrees of freedom 2 of velocity, 3 of position"));
  baum_mechanism_destroy(m);
}

/* A guide along the blade makes the row of the blade redundant. The row of the blade must be
 * omitted, although the blade is added first. Only the guide constrains positions. A projection can
 * therefore return the body to the guide only if the row of the guide is not omitted. */
static void rows_of_velocity_level_are_omitted_before_rows_of_positions(void **state)
{
  (void)state;
  baum_mobility mobility;
  baum_workspace *w = NULL;
  baum_mechanism *m = start_plane();
  baum_body_id body = add_body(m, 1.0, 0.0);
  baum_planar_translational_def guide = baum_planar_translational_def_default();
  guide.body_a = BAUM_GROUND;
  guide.body_b = body;
  guide.point[0] = guide.point[1] = 0.0;
  guide.axis[0] = cos(ANGLE);
  guide.axis[1] = sin(ANGLE);
  add_blade(m, body, D);
  check(baum_mechanism_add_planar_translational(m, &guide, NULL));
  check(baum_mechanism_freeze(m));
  check(baum_mechanism_mobility(m, &mobility, sizeof mobility));
  assert_int_equal(mobility.degrees_of_freedom, 1);
  assert_int_equal(mobility.position_degrees_of_freedom, 1);
  assert_int_equal(mobility.redundant_rows, 1);
  check(baum_workspace_create(m, &w));
  double q[3] = {2.0 * cos(ANGLE) - 0.1 * sin(ANGLE), 2.0 * sin(ANGLE) + 0.1 * cos(ANGLE), ANGLE};
  double v[3] = {0.0, 1.0, 0.0};
  check(baum_workspace_project(w, 0.0, q, v));
  ASSERT_NEAR(q[0], 2.0 * cos(ANGLE), 0.0, 1e-14);
  ASSERT_NEAR(q[1], 2.0 * sin(ANGLE), 0.0, 1e-14);
  ASSERT_NEAR(v[0], sin(ANGLE) * cos(ANGLE), 0.0, 1e-14);
  ASSERT_NEAR(v[1], sin(ANGLE) * sin(ANGLE), 0.0, 1e-14);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

/* ---- assembly ---- */

static void assembly_satisfies_rows_of_velocity_level(void **state)
{
  (void)state;
  baum_workspace *w = NULL;
  baum_mechanism *m = make_sleigh();
  check(baum_workspace_create(m, &w));
  double q[3] = {0.3, -0.2, 1.1};
  double v[3] = {0.7, (double)NAN, 0.9};
  check(baum_workspace_assemble(w, 0.0, q, v, NULL, 0));
  assert_true(q[0] == 0.3 && q[1] == -0.2 && q[2] == 1.1);
  assert_true(v[0] == 0.7 && v[2] == 0.9);
  ASSERT_NEAR(-sin(q[2]) * v[0] + cos(q[2]) * v[1] - D * v[2], 0.0, 0.0, 1e-15);
  v[1] += 0.1;
  assert_int_equal(baum_workspace_assemble(w, 0.0, q, v, NULL, 0), BAUM_ERR_INCONSISTENT);
  assert_non_null(strstr(baum_message(), "blade"));
  double phi = 1.0;
  check(baum_workspace_phi(w, 0.0, q, &phi));
  assert_true(phi == 0.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

/* ---- a row that does work ---- */

static int across(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = -sin(q[2]);
  out[1] = cos(q[2]);
  out[2] = 0.0;
  return 0;
}

static int pushed(double t, const double *q, double *out, void *user)
{
  (void)q;
  (void)user;
  out[0] = 0.4 * sin(3.0 * t);
  return 0;
}

/* A row of velocity level with nu(t) acts like a driver. The velocity across the body follows nu,
 * and the work of the row equals the change of energy. */
static void a_prescribed_velocity_does_work(void **state)
{
  (void)state;
  baum_mechanism *m = start_plane();
  baum_body_id body = add_body(m, 1.0, 0.0);
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.bodies = &body;
  def.body_count = 1;
  def.row_count = 1;
  def.velocity_level = true;
  def.jacobian = across;
  def.nu = pushed;
  check(baum_mechanism_add_user_constraint(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    baum_energy_account account;
    baum_simulation_options options = step_mode_options(mode, 1e-3, 1e-8);
    options.energy_account = true;
    if (mode.integrator == baum_rattle()) {
      continue;
    }
    baum_simulation *run = create_run(m, &options);
    check(step_mode_advance(mode, run, 1.0));
    baum_counters counters = counters_of(run);
    check(baum_simulation_energy_account(run, &account, sizeof account));
    double across_end = 0.4 * sin(3.0);
    double most = mode.fixed && baum_integrator_order(mode.integrator) == 1 ? 2e-3 : 1e-6;
    ASSERT_NEAR(counters.energy_change, 0.5 * MASS * across_end * across_end, 0.0, most);
    ASSERT_NEAR(account.drivers, counters.energy_change, 0.0, most);
    assert_true(fabs(counters.energy_residual) <= most);
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* ---- save and restore ---- */

static void a_restored_run_continues_identically(void **state)
{
  (void)state;
  enum { BYTES = 1 << 16 };
  static unsigned char bytes[BYTES];
  size_t size = 0;
  baum_mechanism *m = make_sleigh();
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-7;
  baum_simulation *run = create_run(m, &options);
  baum_simulation *other = create_run(m, &options);
  check(baum_simulation_advance_to(run, 1.0));
  check(baum_simulation_save(run, bytes, BYTES, &size));
  check(baum_simulation_restore(other, bytes, size));
  check(baum_simulation_advance_to(run, 2.0));
  check(baum_simulation_advance_to(other, 2.0));
  assert_memory_equal(baum_simulation_q(run), baum_simulation_q(other), 3 * sizeof(double));
  assert_memory_equal(baum_simulation_v(run), baum_simulation_v(other), 3 * sizeof(double));
  baum_simulation_destroy(run);
  baum_simulation_destroy(other);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_sleigh_follows_its_closed_form),
    cmocka_unit_test(predicted_and_simulated_stability_agree),
    cmocka_unit_test(unstable_gains_are_refused),
    cmocka_unit_test(default_gains_are_stable),
    cmocka_unit_test(rattle_and_kinematics_refuse_rows_of_velocity_level),
    cmocka_unit_test(position_and_velocity_degrees_of_freedom_differ),
    cmocka_unit_test(rows_of_velocity_level_are_omitted_before_rows_of_positions),
    cmocka_unit_test(assembly_satisfies_rows_of_velocity_level),
    cmocka_unit_test(a_prescribed_velocity_does_work),
    cmocka_unit_test(a_restored_run_continues_identically),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
