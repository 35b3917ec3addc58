/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests redundant rows, which must be found and named and must not change the motion. Rows that
 * contradict each other must be found, named and refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "dynamics/dynamics.h"
#include "message.h"
#include "models.h"
#include "runs.h"

/* ---- mechanisms ---- */

static baum_body_id add_link(baum_mechanism *m, const char *name, double x, double y, double angle)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.name = name;
  def.mass = 2.0;
  def.inertia = 0.3;
  def.position[0] = x;
  def.position[1] = y;
  def.angle = angle;
  assert_int_equal(baum_mechanism_add_planar_body(m, &def, &id), BAUM_OK);
  return id;
}

/* Makes a physical pendulum with one, two or three equal pins. */
static baum_mechanism *pendulum_with_pins(int pins)
{
  static const char *const names[3] = {"pin", "pin again", "pin once more"};
  baum_mechanism *m = create_mechanism();
  baum_body_id link = add_link(m, "link", 0.5, 0.2, 0.3);
  for (int k = 0; k < pins; k++) {
    (void)add_planar_pin(m, names[k], BAUM_GROUND, link, 0.0, 0.0);
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

/* Makes parallel cranks of length 1 m. Their pins to ground are at x = 0, 1, 2, ... All cranks have
 * the same angle, and one coupler joins them. */
static baum_mechanism *parallelogram(int cranks, double angle)
{
  static const char *const names[3] = {"first", "second", "third"};
  static const char *const feet[3] = {"foot 1", "foot 2", "foot 3"};
  static const char *const heads[3] = {"head 1", "head 2", "head 3"};
  baum_mechanism *m = create_mechanism();
  double c = cos(angle);
  double s = sin(angle);
  baum_body_id coupler = add_link(m, "coupler", 1.0 + c, s, 0.0);
  for (int k = 0; k < cranks; k++) {
    baum_body_id crank = add_link(m, names[k], k + 0.5 * c, 0.5 * s, angle);
    (void)add_planar_pin(m, feet[k], BAUM_GROUND, crank, k, 0.0);
    (void)add_planar_pin(m, heads[k], crank, coupler, k + c, s);
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

/* Computes accelerations and multipliers in the design configuration. The velocities are v (nv). */
static void solve(const baum_mechanism *m, const double *v, double *a, double *lambda)
{
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  assert_int_equal(baum_i_find_rows(w, 0.0, m->design_q), BAUM_OK);
  assert_int_equal(baum_workspace_acceleration(w, 0.0, m->design_q, v, 0.0, 0.0, a, lambda),
                   BAUM_OK);
  baum_workspace_destroy(w);
}

/* ---- redundant rows ---- */

static void a_duplicated_joint_changes_no_acceleration_and_is_named(void **state)
{
  (void)state;
  baum_mechanism *once = pendulum_with_pins(1);
  baum_mechanism *twice = pendulum_with_pins(2);
  const double v[3] = {-0.2 * 1.5, 0.5 * 1.5, 1.5};
  double want[3];
  double got[3];
  double force[2];
  double shared[4];
  solve(once, v, want, force);
  solve(twice, v, got, shared);
  for (int i = 0; i < 3; i++) {
    ASSERT_NEAR(got[i], want[i], 1e-13, 1e-13);
  }
  for (int i = 0; i < 2; i++) { /* with the least norm, each pin carries half of the force */
    ASSERT_NEAR(shared[i], 0.5 * force[i], 1e-12, 1e-12);
    ASSERT_NEAR(shared[i + 2], 0.5 * force[i], 1e-12, 1e-12);
  }
  baum_mobility mobility;
  assert_int_equal(baum_mechanism_mobility(twice, &mobility, sizeof mobility), BAUM_OK);
  assert_int_equal(mobility.degrees_of_freedom, 1);
  assert_int_equal(mobility.redundant_rows, 2);
  assert_int_equal(mobility.conflicting_rows, 0);
  assert_non_null(strstr(mobility.text, "\"pin\", \"pin again\""));
  baum_mechanism_destroy(once);
  baum_mechanism_destroy(twice);
}

static void a_third_crank_of_a_parallelogram_changes_no_acceleration_and_is_named(void **state)
{
  (void)state;
  const double angle = 1.1;
  const double w = 2.0;
  baum_mechanism *three = parallelogram(3, angle);
  double v[12] = {-w * sin(angle), w * cos(angle), 0.0};
  for (int k = 0; k < 3; k++) {
    v[3 + 3 * k] = -0.5 * w * sin(angle);
    v[4 + 3 * k] = 0.5 * w * cos(angle);
    v[5 + 3 * k] = w;
  }
  double a[12];
  double lambda[12];
  solve(three, v, a, lambda);
  /* Lagrange's equation for the angle of the cranks is (3 (J + m/4) + m) angle'' = -(3 m/2 + m) g
   * cos(angle), with m = 2 kg, J = 0.3 kg m^2 and the length 1 m. */
  double want = -(3.0 + 2.0) * 9.81 * cos(angle) / (3.0 * (0.3 + 0.5) + 2.0);
  for (int k = 0; k < 3; k++) {
    ASSERT_NEAR(a[5 + 3 * k], want, 1e-12, 0.0);
  }
  ASSERT_NEAR(a[2], 0.0, 0.0, 1e-12);
  baum_mobility mobility;
  assert_int_equal(baum_mechanism_mobility(three, &mobility, sizeof mobility), BAUM_OK);
  assert_int_equal(mobility.degrees_of_freedom, 1);
  assert_int_equal(mobility.redundant_rows, 1);
  assert_false(mobility.near_singular);
  assert_non_null(strstr(mobility.text, "1 redundant row"));
  assert_non_null(strstr(mobility.text, "\"foot 3\""));
  assert_non_null(strstr(mobility.text, "\"head 1\""));
  baum_mechanism_destroy(three);
}

/* Makes a horizontal chain of links of 1 m, which begins at the origin. `pins` equal pins join each
 * link to the previous link. */
static baum_mechanism *chain_with_pins(int links, int pins)
{
  baum_mechanism *m = create_mechanism();
  baum_body_id before = BAUM_GROUND;
  for (int k = 0; k < links; k++) {
    baum_body_id link = add_link(m, NULL, k + 0.5, 0.0, 0.0);
    for (int i = 0; i < pins; i++) {
      (void)add_planar_pin(m, NULL, before, link, k, 0.0);
    }
    before = link;
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static void many_duplicated_joints_share_their_forces(void **state)
{
  (void)state;
  enum { LINKS = 200 };
  baum_mechanism *once = chain_with_pins(LINKS, 1);
  baum_mechanism *twice = chain_with_pins(LINKS, 2);
  double v[3 * LINKS];
  double want[3 * LINKS];
  double got[3 * LINKS];
  double force[2 * LINKS];
  double shared[4 * LINKS];
  for (int k = 0; k < LINKS; k++) { /* the chain rotates like a rigid body */
    v[3 * k] = 0.0;
    v[3 * k + 1] = 2.0 * (k + 0.5);
    v[3 * k + 2] = 2.0;
  }
  solve(once, v, want, force);
  solve(twice, v, got, shared);
  for (int i = 0; i < 3 * LINKS; i++) { /* accelerations are up to 800 m/s^2 */
    ASSERT_NEAR(got[i], want[i], 0.0, 1e-9);
  }
  for (int k = 0; k < LINKS; k++) { /* forces are up to 2 kg x 8e4 m/s^2 */
    for (int i = 0; i < 2; i++) {
      ASSERT_NEAR(shared[4 * k + i], 0.5 * force[2 * k + i], 0.0, 1e-7);
      ASSERT_NEAR(shared[4 * k + 2 + i], 0.5 * force[2 * k + i], 0.0, 1e-7);
    }
  }
  baum_mechanism_destroy(once);
  baum_mechanism_destroy(twice);
}

static void multipliers_of_least_norm_still_balance_the_forces(void **state)
{
  (void)state;
  baum_mechanism *m = parallelogram(3, 0.7);
  double v[12] = {0};
  double a[12];
  double lambda[12];
  solve(m, v, a, lambda);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  double mass[144];
  double jacobian[144];
  double force[12];
  assert_int_equal(baum_workspace_mass(w, 0.0, m->design_q, mass), BAUM_OK);
  assert_int_equal(baum_workspace_jacobian(w, 0.0, m->design_q, jacobian), BAUM_OK);
  assert_int_equal(baum_workspace_force(w, 0.0, m->design_q, v, force), BAUM_OK);
  for (int i = 0; i < 12; i++) {
    double sum = -force[i];
    for (int j = 0; j < 12; j++) {
      sum += mass[12 * i + j] * a[j] + jacobian[12 * j + i] * lambda[j];
    }
    ASSERT_NEAR(sum, 0.0, 0.0, 1e-12); /* rounding error of 20 N */
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

/* The test changes a multiplier by 1e-5 N. Forces are about 10 N. */
static void multipliers_that_do_not_balance_the_forces_are_refused(void **state)
{
  (void)state;
  baum_mechanism *m = parallelogram(3, 0.7);
  const double v[12] = {0};
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  assert_int_equal(baum_i_reported_acceleration(w, 0.0, m->design_q, v), BAUM_OK);
  assert_int_equal(baum_i_make_multipliers_least(w), BAUM_OK);
  w->lambda[0] += 1e-5;
  assert_int_equal(baum_i_make_multipliers_least(w), BAUM_ERR_SINGULAR);
  assert_non_null(strstr(baum_message(), "balance the forces on body 2 \"first\""));
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

static void a_flat_parallelogram_is_singular_and_not_redundant(void **state)
{
  (void)state;
  baum_mechanism *m = parallelogram(2, 0.0);
  baum_mobility mobility;
  assert_int_equal(baum_mechanism_mobility(m, &mobility, sizeof mobility), BAUM_OK);
  assert_int_equal(mobility.degrees_of_freedom, 1);
  assert_int_equal(mobility.redundant_rows, 0);
  assert_true(mobility.near_singular);
  assert_non_null(strstr(mobility.text, "initial configuration is singular"));
  baum_mechanism_destroy(m);
}

static void the_rank_does_not_depend_on_the_unit_of_length(void **state)
{
  (void)state;
  for (int k = -6; k <= 6; k += 3) {
    double unit = pow(10.0, k);
    baum_mechanism *m = create_mechanism();
    baum_planar_body_def def = baum_planar_body_def_default();
    def.mass = 3.0;
    def.inertia = 0.2 * unit * unit;
    def.position[0] = 0.4 * unit;
    baum_body_id link;
    assert_int_equal(baum_mechanism_add_planar_body(m, &def, &link), BAUM_OK);
    (void)add_planar_pin(m, "pin", BAUM_GROUND, link, 0.0, 0.0);
    (void)add_planar_pin(m, "double", BAUM_GROUND, link, 0.0, 0.0);
    assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
    baum_mobility mobility;
    assert_int_equal(baum_mechanism_mobility(m, &mobility, sizeof mobility), BAUM_OK);
    assert_int_equal(mobility.degrees_of_freedom, 1);
    assert_int_equal(mobility.redundant_rows, 2);
    baum_mechanism_destroy(m);
  }
}

static void a_body_without_a_joint_is_named(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_body_id link = add_link(m, "link", 1.0, 0.0, 0.0);
  (void)add_link(m, "stray", 2.0, 2.0, 0.0);
  (void)add_planar_pin(m, "pin", BAUM_GROUND, link, 0.0, 0.0);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  baum_mobility mobility;
  assert_int_equal(baum_mechanism_mobility(m, &mobility, sizeof mobility), BAUM_OK);
  assert_int_equal(mobility.degrees_of_freedom, 4);
  assert_int_equal(mobility.free_bodies, 1);
  assert_non_null(strstr(mobility.text, "\"stray\""));
  baum_mechanism_destroy(m);
}

/* ---- rows that contradict each other ---- */

static baum_mechanism *contradicting_rods(void)
{
  baum_mechanism *m = create_mechanism();
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  baum_body_id body;
  bob.name = "bob";
  bob.position[0] = 1.0;
  assert_int_equal(baum_mechanism_add_planar_particle(m, &bob, &body), BAUM_OK);
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.body_a = BAUM_GROUND;
  rod.body_b = body;
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  rod.name = "short";
  rod.length = 1.0;
  assert_int_equal(baum_mechanism_add_planar_distance(m, &rod, NULL), BAUM_OK);
  rod.name = "long";
  rod.length = 1.1;
  assert_int_equal(baum_mechanism_add_planar_distance(m, &rod, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static void two_contradicting_rods_are_named_and_refused(void **state)
{
  (void)state;
  baum_mechanism *m = contradicting_rods();
  baum_mobility mobility;
  assert_int_equal(baum_mechanism_mobility(m, &mobility, sizeof mobility), BAUM_OK);
  assert_int_equal(mobility.conflicting_rows, 2);
  assert_non_null(strstr(mobility.text, "\"short\""));
  assert_non_null(strstr(mobility.text, "\"long\""));

  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  baum_simulation *s = (baum_simulation *)&o;
  assert_int_equal(baum_simulation_create(m, &o, &s), BAUM_ERR_INCONSISTENT);
  assert_null(s);
  assert_non_null(strstr(baum_message(), "\"short\""));
  assert_non_null(strstr(baum_message(), "\"long\""));
  baum_mechanism_destroy(m);
}

static void a_redundant_mechanism_runs_with_a_warning_that_names_its_joints(void **state)
{
  (void)state;
  baum_mechanism *m = parallelogram(3, 1.1);
  const baum_integrator *integrators[] = {baum_rk4(), baum_semi_implicit_euler(),
                                          baum_cvode_adams(), baum_ida()};
  double angle[4];
  for (int k = 0; k < 4; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    baum_warning warning;
    o.integrator = integrators[k];
    if (baum_integrator_has_fixed_step(o.integrator)) {
      o.step = k == 0 ? 1e-3 : 1e-5;
    } else {
      o.rtol = 1e-9;
    }
    if (k >= 2 && !baum_has("sundials")) {
      angle[k] = angle[0];
      continue;
    }
    baum_simulation *s = create_run(m, &o);
    assert_int_equal(baum_simulation_advance_to(s, 0.3), BAUM_WARNED);
    assert_int_equal(baum_simulation_warning(s, 0, &warning, sizeof warning), BAUM_OK);
    assert_int_equal(warning.code, BAUM_WARNING_REDUNDANT_ROWS);
    assert_non_null(strstr(warning.text, "\"foot 1\""));
    angle[k] = baum_simulation_q(s)[5];
    baum_simulation_destroy(s);
  }
  ASSERT_NEAR(angle[1], angle[0], 0.0, 1e-4); /* a method of order 1 with h = 1e-5 s */
  ASSERT_NEAR(angle[2], angle[0], 0.0, 1e-7); /* with rtol 1e-9 */
  /* The global error of IDA with rtol 1e-9 is larger. */
  ASSERT_NEAR(angle[3], angle[0], 0.0, 1e-6);
  baum_mechanism_destroy(m);
}

/* Makes a pin with two drivers. One prescribes the angle 2 t, and the other 2 t + acceleration
 * t^2 / 2. */
static baum_mechanism *driven_twice(double acceleration)
{
  baum_mechanism *m = create_mechanism();
  baum_body_id link = add_link(m, "link", 1.0, 0.0, 0.0);
  baum_driver_def def = baum_driver_def_default();
  def.joint = add_planar_pin(m, "pin", BAUM_GROUND, link, 0.0, 0.0);
  def.rate = 2.0;
  def.name = "one motor";
  assert_int_equal(baum_mechanism_add_driver(m, &def, NULL), BAUM_OK);
  def.acceleration = acceleration;
  def.name = "other motor";
  assert_int_equal(baum_mechanism_add_driver(m, &def, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static int64_t warnings_after(const baum_mechanism *m, double t)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  baum_simulation *s = create_run(m, &o);
  assert_int_equal(baum_simulation_advance_to(s, t), BAUM_WARNED);
  baum_counters c = counters_of(s);
  baum_simulation_destroy(s);
  return c.warnings;
}

/* At t = 0, both drivers prescribe the same position and velocity, but different accelerations. */
static void a_workspace_refuses_accelerations_that_violate_an_omitted_row(void **state)
{
  (void)state;
  const double q[3] = {1.0, 0.0, 0.0};
  const double v[3] = {0.0, 2.0, 2.0};
  const double gains[2] = {0.0, 10.0};
  for (int k = 0; k < 4; k++) {
    baum_workspace *w = NULL;
    baum_mechanism *m = driven_twice(k < 2 ? 1.0 : 0.0);
    assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
    baum_status status =
      baum_workspace_acceleration(w, 0.0, q, v, gains[k % 2], gains[k % 2], NULL, NULL);
    if (k < 2) {
      ASSERT_SAYS(status, BAUM_ERR_INCONSISTENT,
                  "t = 0 s: no acceleration satisfies all constraints|\"other motor\"");
    } else {
      assert_int_equal(status, BAUM_OK);
    }
    baum_workspace_destroy(w);
    baum_mechanism_destroy(m);
  }
}

static void drivers_that_contradict_each_other_later_cause_a_warning(void **state)
{
  (void)state;
  baum_mechanism *same = driven_twice(0.0);
  baum_mechanism *parting = driven_twice(1.0);
  assert_int_equal(warnings_after(same, 1.0), 1); /* the warning about redundant rows */
  assert_true(warnings_after(parting, 1.0) >= 2); /* also a warning that a driver is violated */
  baum_mechanism_destroy(same);
  baum_mechanism_destroy(parting);
}

static void a_workspace_projects_a_redundant_mechanism(void **state)
{
  (void)state;
  baum_mechanism *m = parallelogram(3, 0.7);
  baum_workspace *w = NULL;
  double q[12];
  double v[12] = {0.0};
  double phi[12];
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  assert_int_equal(baum_workspace_design(w, q, NULL), BAUM_OK);
  for (int i = 0; i < 12; i++) {
    q[i] += 1e-4 * sin(3.0 * i);
    v[i] = cos(2.0 * i);
  }
  assert_int_equal(baum_workspace_project(w, 0.0, q, v), BAUM_OK);
  assert_int_equal(baum_workspace_phi(w, 0.0, q, phi), BAUM_OK);
  for (int i = 0; i < 12; i++) {
    ASSERT_NEAR(phi[i], 0.0, 0.0, 1e-14); /* including omitted rows */
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

/* If acceleration = 1, the two motors differ by t^2 / 2 in the angle and by t in the velocity.
 * Projection can therefore satisfy only one of the motors. */
static void projection_names_redundant_rows_that_remain_violated(void **state)
{
  (void)state;
  static const struct {
    double acceleration;
    double t;
    const char *message; /* NULL if projection succeeds */
  } cases[] = {
    {0.0, 0.3, NULL},
    {1.0, 0.0, NULL},
    {1.0, 0.3,
     "t = 0.3 s: projection: a redundant row of joint |motor\" was omitted, but is violated by "
     "|contradict"},
    {1.0, 1e-4,
     "t = 0.0001 s: projection: a redundant row of joint |5e-09, and its time derivative by "
     "|0.0001"},
  };
  for (int k = 0; k < 4; k++) {
    baum_mechanism *m = driven_twice(cases[k].acceleration);
    baum_workspace *w = NULL;
    double angle = 2.0 * cases[k].t;
    double q[3] = {cos(angle), sin(angle), angle + 1e-3};
    double v[3] = {0.0, 2.0, 2.0};
    assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
    assert_int_equal(w->rows.count, 1);
    if (cases[k].message) {
      const double before[6] = {q[0], q[1], q[2], v[0], v[1], v[2]};
      ASSERT_SAYS(baum_workspace_project(w, cases[k].t, q, v), BAUM_ERR_INCONSISTENT,
                  cases[k].message);
      assert_memory_equal(q, before, sizeof q);
      assert_memory_equal(v, before + 3, sizeof v);
    } else {
      assert_int_equal(baum_workspace_project(w, cases[k].t, q, v), BAUM_OK);
      ASSERT_NEAR(q[2], angle, 0.0, 1e-15);
      ASSERT_NEAR(v[2], 2.0, 1e-15, 0.0);
    }
    baum_workspace_destroy(w);
    baum_mechanism_destroy(m);
  }
}

static void a_diverging_run_causes_warnings(void **state)
{
  (void)state;
  baum_mechanism *m = pendulum_with_pins(1);
  baum_simulation_options o = baum_simulation_options_default();
  baum_warning warning;
  o.integrator = baum_euler();
  o.formulation = BAUM_FORMULATION_UNSTABILIZED;
  o.step = 0.1; /* the step is much too long, so it causes violations */
  baum_simulation *s = create_run(m, &o);
  assert_int_equal(baum_simulation_advance_to(s, 3.0), BAUM_WARNED);
  assert_int_equal(baum_simulation_warning(s, 0, &warning, sizeof warning), BAUM_OK);
  assert_int_equal(warning.code, BAUM_WARNING_VIOLATION);
  assert_non_null(strstr(warning.text, "joint 1 \"pin\" is violated by"));
  assert_int_equal(baum_simulation_warning(s, 1, &warning, sizeof warning), BAUM_OK);
  assert_int_equal(warning.code, BAUM_WARNING_ACCURACY);
  assert_non_null(strstr(warning.text, "the estimated error of the positions by euler is"));
  baum_simulation_destroy(s);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_duplicated_joint_changes_no_acceleration_and_is_named),
    cmocka_unit_test(a_third_crank_of_a_parallelogram_changes_no_acceleration_and_is_named),
    cmocka_unit_test(many_duplicated_joints_share_their_forces),
    cmocka_unit_test(multipliers_of_least_norm_still_balance_the_forces),
    cmocka_unit_test(multipliers_that_do_not_balance_the_forces_are_refused),
    cmocka_unit_test(a_flat_parallelogram_is_singular_and_not_redundant),
    cmocka_unit_test(the_rank_does_not_depend_on_the_unit_of_length),
    cmocka_unit_test(a_body_without_a_joint_is_named),
    cmocka_unit_test(two_contradicting_rods_are_named_and_refused),
    cmocka_unit_test(a_redundant_mechanism_runs_with_a_warning_that_names_its_joints),
    cmocka_unit_test(a_workspace_refuses_accelerations_that_violate_an_omitted_row),
    cmocka_unit_test(drivers_that_contradict_each_other_later_cause_a_warning),
    cmocka_unit_test(a_workspace_projects_a_redundant_mechanism),
    cmocka_unit_test(projection_names_redundant_rows_that_remain_violated),
    cmocka_unit_test(a_diverging_run_causes_warnings),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
