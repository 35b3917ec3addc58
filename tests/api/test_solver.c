/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests which solver a run uses, what its explanation says about the solver, and which choices are
 * refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "models.h"
#include "runs.h"
#include "user_models.h"

#define PI 3.14159265358979323846

enum { ARMS = 60, NET = 300 };

static const baum_solver SOLVERS[] = {BAUM_SOLVER_AUTO, BAUM_SOLVER_KLU, BAUM_SOLVER_QR,
                                      BAUM_SOLVER_BLOCK};

static baum_simulation_options euler(baum_solver solver)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_semi_implicit_euler();
  o.step = 1e-6;
  o.solver = solver;
  return o;
}

static void assert_explained(const baum_simulation *run, const char *line)
{
  if (!strstr(baum_simulation_explain(run), line)) {
    print_error("\"%s\" is not in\n%s\n", line, baum_simulation_explain(run));
    fail();
  }
}

/* ---- mechanisms ---- */

/* Makes a disc that is pinned to ground, and pendulums that are pinned to the disc. The mechanism
 * is not frozen. */
static baum_mechanism *make_hub(int arms)
{
  baum_body_id hub;
  baum_mechanism *m = create_mechanism();
  baum_planar_body_def disc = baum_planar_body_def_default();
  disc.name = "hub";
  disc.mass = 10.0;
  check(baum_mechanism_add_planar_body(m, &disc, &hub));
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.body_a = BAUM_GROUND;
  pin.body_b = hub;
  pin.point[0] = 0.0;
  pin.point[1] = 0.0;
  check(baum_mechanism_add_planar_revolute(m, &pin, NULL));
  for (int k = 0; k < arms; k++) {
    double angle = 2.0 * PI * k / arms;
    baum_planar_body_def arm = baum_planar_body_def_default();
    arm.position[0] = 1.5 * cos(angle);
    arm.position[1] = 1.5 * sin(angle);
    check(baum_mechanism_add_planar_body(m, &arm, &pin.body_b));
    pin.body_a = hub;
    pin.point[0] = cos(angle);
    pin.point[1] = sin(angle);
    check(baum_mechanism_add_planar_revolute(m, &pin, NULL));
  }
  return m;
}

static int pull(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  (void)user;
  out[1] = 3.0;
  return 0;
}

static int pull_one(double t, const double *q, const double *v, const double *inputs, double *out,
                    void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = 3.0;
  return 0;
}

static int tie(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[1] - q[0];
  return 0;
}

/* Makes two coordinates that a constraint makes equal. The second one has no mass. */
static baum_mechanism *make_massless(void)
{
  baum_body_id body;
  baum_mechanism *m = create_mechanism();
  baum_coordinates_def def = baum_coordinates_def_default();
  def.name = "twin";
  def.size = 2;
  def.mass = user_mass_of_first;
  def.force = pull;
  def.constant_mass = true;
  check(baum_mechanism_add_coordinates(m, &def, &body));
  baum_user_constraint_def same = baum_user_constraint_def_default();
  same.bodies = &body;
  same.body_count = 1;
  same.row_count = 1;
  same.phi = tie;
  check(baum_mechanism_add_user_constraint(m, &same, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

/* Makes particles with about four rods each. Two of these rods lead to distant particles, so that
 * elimination has many couplings. */
static baum_mechanism *make_net(void)
{
  baum_body_id bodies[NET];
  baum_mechanism *m = create_mechanism();
  for (int k = 0; k < NET; k++) {
    baum_planar_particle_def def = baum_planar_particle_def_default();
    def.position[0] = sin(1.7 * k * k + 1.0);
    def.position[1] = sin(2.3 * k * k + k);
    check(baum_mechanism_add_planar_particle(m, &def, &bodies[k]));
  }
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  for (int k = 0; k < 2 * NET - 3; k++) {
    int a = k % NET;
    rod.body_a = bodies[a];
    rod.body_b = bodies[k < NET ? (a + 1) % NET : (7 * a + 4) % NET]; /* b never equals a */
    check(baum_mechanism_add_planar_distance(m, &rod, NULL));
  }
  check(baum_mechanism_freeze(m));
  return m;
}

/* A mass function that fails until t = 1 s. */
static int late_mass(double t, const double *q, double *out, void *user)
{
  (void)q;
  (void)user;
  out[0] = 2.0;
  return t < 1.0 ? -1 : 0;
}

static baum_mechanism *make_late(void)
{
  baum_coordinates_def def = baum_coordinates_def_default();
  def.name = "late";
  def.size = 1;
  def.mass = late_mass;
  def.force = pull_one;
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_add_coordinates(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

/* ---- tests ---- */

static void all_solvers_find_the_same_accelerations_and_multipliers(void **state)
{
  (void)state;
  model m;
  model_slider_crank data = {.angle = 1.0, .moving = true};
  check(model_slider_crank_build(data, &m));
  const baum_channel channels[] = {baum_channel_of(BAUM_A), baum_channel_of(BAUM_LAMBDA)};
  double want[17];
  for (size_t k = 0; k < sizeof SOLVERS / sizeof *SOLVERS; k++) {
    baum_simulation_options o = euler(SOLVERS[k]);
    baum_simulation *run = create_run(m.mechanism, &o);
    double row[17];
    check(baum_simulation_step(run, 100));
    assert_int_equal(baum_channels_width(m.mechanism, channels, 2), 17);
    check(baum_simulation_get(run, channels, 2, row));
    for (int i = 0; i < 17; i++) {
      want[i] = k == 0 ? row[i] : want[i];
      /* Accelerations are about 1e4 m/s^2, and multipliers about 1e3 N. The tolerances allow for
       * their rounding errors, multiplied by a condition number. */
      ASSERT_NEAR(row[i], want[i], 1e-11, i < 9 ? 1e-7 : 1e-9);
    }
    baum_simulation_destroy(run);
  }
  model_destroy(&m);
}

static void explain_names_the_solver(void **state)
{
  (void)state;
  static const char *const lines[] = {
    "\nsolver        blocks, 5 nodes, 5 couplings; klu and qr where pivots are bad\n",
    "\nsolver        klu on the whole system: another solver was chosen\n",
    "\nsolver        qr on the whole system: another solver was chosen\n",
    "\nsolver        blocks, 5 nodes, 5 couplings, no other solver\n",
  };
  model m;
  model_slider_crank data = {.driven = true, .angle = 1.0, .moving = true};
  check(model_slider_crank_build(data, &m));
  for (size_t k = 0; k < sizeof SOLVERS / sizeof *SOLVERS; k++) {
    baum_simulation_options o = euler(SOLVERS[k]);
    baum_simulation *run = create_run(m.mechanism, &o);
    assert_explained(run, lines[k]);
    baum_simulation_destroy(run);
  }
  model_destroy(&m);
}

/* Kinematics and IDA do not factor the matrix of the equations for accelerations and multipliers.
 * They factor other matrices. */
static void explain_names_the_solver_of_kinematics_and_ida(void **state)
{
  (void)state;
  model m;
  model_slider_crank data = {.driven = true, .angle = 1.0, .moving = true};
  check(model_slider_crank_build(data, &m));
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  baum_simulation *run = create_run(m.mechanism, &o);
  assert_explained(run, "\nsolver        klu on the constraints\n");
  baum_simulation_destroy(run);
#if BAUM_HAVE_SUNDIALS
  o.integrator = baum_ida();
  o.rtol = 1e-6;
  run = create_run(m.mechanism, &o);
  assert_explained(run, "\nsolver        klu on the Jacobian of the residual; start and "
                        "channels: blocks, 5 nodes");
  baum_simulation_destroy(run);
#endif
  model_destroy(&m);
}

static void bodies_with_very_many_joints_are_named(void **state)
{
  (void)state;
  baum_mechanism *m = make_hub(ARMS);
  check(baum_mechanism_freeze(m));
  baum_simulation_options o = euler(BAUM_SOLVER_AUTO);
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_step(run, 10));
  assert_explained(run,
                   "\nsolver        klu on the whole system: body 1 \"hub\" has 61 joints, too "
                   "many for blocks\n");
  baum_simulation_destroy(run);
  o = euler(BAUM_SOLVER_BLOCK);
  check_run_refused(m, &o, BAUM_ERR_UNSUPPORTED,
                    "solver is block|body 1 \"hub\" has 61 joints, too many for blocks");
  baum_mechanism_destroy(m);
}

static void forty_pins_on_a_body_are_accepted_for_blocks(void **state)
{
  (void)state;
  baum_mechanism *m = make_hub(40);
  check(baum_mechanism_freeze(m));
  baum_simulation_options o = euler(BAUM_SOLVER_BLOCK);
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_step(run, 10));
  /* A node is the pair of rows of one pin. All 41 nodes share the hub, so that each is coupled with
   * every other one. These are 41 x 40 / 2 couplings. */
  assert_explained(run, "\nsolver        blocks, 41 nodes, 820 couplings");
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static void masses_that_cannot_be_inverted_are_named(void **state)
{
  (void)state;
  baum_mechanism *m = make_massless();
  baum_simulation_options o = euler(BAUM_SOLVER_AUTO);
  baum_simulation *run = create_run(m, &o);
  const baum_channel channel = baum_channel_of(BAUM_A);
  double a[2];
  check(baum_simulation_get(run, &channel, 1, a));
  /* The Jacobian is computed by differences of Phi, which limits the accuracy. */
  ASSERT_NEAR(a[0], 3.0, 0.0, 1e-10);
  ASSERT_NEAR(a[1], 3.0, 0.0, 1e-10);
  assert_explained(run,
                   "\nsolver        klu on the whole system: the mass matrix of body 1 \"twin\" "
                   "is not positive definite\n");
  baum_simulation_destroy(run);
  o = euler(BAUM_SOLVER_BLOCK);
  check_run_refused(m, &o, BAUM_ERR_UNSUPPORTED,
                    "solver is block|mass matrix of body 1 \"twin\" is not positive definite");
  baum_mechanism_destroy(m);
}

static void joints_in_a_dense_net_are_refused_for_blocks(void **state)
{
  (void)state;
  baum_mechanism *m = make_net();
  baum_simulation_options o = euler(BAUM_SOLVER_BLOCK);
  check_run_refused(
    m, &o, BAUM_ERR_UNSUPPORTED,
    "solver is block|the joints form a dense net, so the block solver would have too much fill");
  baum_mechanism_destroy(m);
}

static void masses_unknown_in_the_design_configuration_are_reported(void **state)
{
  (void)state;
  baum_mechanism *m = make_late();
  baum_report report;
  check(baum_mechanism_report(m, &report, sizeof report));
  assert_false(report.blocks);
  assert_non_null(strstr(report.text, "\nskipped       nothing"));
  baum_simulation_options o = euler(BAUM_SOLVER_AUTO);
  o.start_time = 1.5;
  o.step = 0.5;
  o.formulation = BAUM_FORMULATION_UNSTABILIZED;
  baum_simulation *run = create_run(m, &o);
  assert_explained(run, "\nsolver        klu on the whole system: mass or force cannot be "
                        "evaluated in the design configuration\n");
  check(baum_simulation_step(run, 1));
  ASSERT_NEAR(baum_simulation_v(run)[0], 0.75, 1e-15, 0.0);
  baum_simulation_destroy(run);
  o.solver = BAUM_SOLVER_BLOCK;
  check_run_refused(
    m, &o, BAUM_ERR_UNSUPPORTED,
    "solver is block|mass or force cannot be evaluated in the design configuration");
  baum_mechanism_destroy(m);
}

static void the_block_solver_alone_is_refused_close_to_a_singular_configuration(void **state)
{
  (void)state;
  model m;
  model_slider_crank data = {.centric = true, .rod = 0.153, .angle = PI / 2 - 1e-7, .moving = true};
  check(model_slider_crank_build(data, &m));
  baum_simulation_options o = euler(BAUM_SOLVER_BLOCK);
  o.start = BAUM_START_AS_GIVEN;
  check_run_refused(m.mechanism, &o, BAUM_ERR_SINGULAR,
                    "t = 0 s|pivots of the block solver are too small");
  o.solver = BAUM_SOLVER_AUTO;
  baum_simulation *run = create_run(m.mechanism, &o);
  baum_counters counters = counters_of(run);
  assert_true(counters.full_factorizations > 0); /* KLU made these factorizations */
  baum_simulation_destroy(run);
  model_destroy(&m);
}

static void a_mechanism_without_joints_has_no_nodes(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_planar_body_def def = baum_planar_body_def_default();
  def.velocity[0] = 2.0;
  def.velocity[1] = 0.0;
  check(baum_mechanism_add_planar_body(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  baum_simulation_options o = euler(BAUM_SOLVER_BLOCK);
  o.integrator = baum_rk2();
  o.formulation = BAUM_FORMULATION_UNSTABILIZED;
  o.step = 0.5;
  baum_simulation *run = create_run(m, &o);
  assert_explained(run, "\nsolver        blocks, 0 nodes, 0 couplings");
  check(baum_simulation_step(run, 2));
  const double *q = baum_simulation_q(run);
  ASSERT_NEAR(q[0], 2.0, 1e-15, 0.0);
  ASSERT_NEAR(q[1], -9.81 / 2, 1e-15, 0.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(all_solvers_find_the_same_accelerations_and_multipliers),
    cmocka_unit_test(explain_names_the_solver),
    cmocka_unit_test(explain_names_the_solver_of_kinematics_and_ida),
    cmocka_unit_test(bodies_with_very_many_joints_are_named),
    cmocka_unit_test(forty_pins_on_a_body_are_accepted_for_blocks),
    cmocka_unit_test(masses_that_cannot_be_inverted_are_named),
    cmocka_unit_test(joints_in_a_dense_net_are_refused_for_blocks),
    cmocka_unit_test(masses_unknown_in_the_design_configuration_are_reported),
    cmocka_unit_test(the_block_solver_alone_is_refused_close_to_a_singular_configuration),
    cmocka_unit_test(a_mechanism_without_joints_has_no_nodes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
