/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the energy account with motions that are known in closed form. Each test of a class of work
 * has only one source of work. The last tests check how the account starts and continues in a
 * run. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "message.h"
#include "runs.h"
#include "user_models.h"

/* At rtol 1e-12 the errors of rk8 after one second are about 1e-12. */
static const double CLOSE = 1e-10;

static baum_simulation_options account_options(void)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk8();
  o.formulation = BAUM_FORMULATION_UNSTABILIZED;
  o.rtol = 1e-12;
  o.max_step = 0.1;
  o.start = BAUM_START_AS_GIVEN;
  o.energy_account = true;
  return o;
}

static baum_energy_account read_account(baum_simulation *run)
{
  baum_energy_account out;
  check(baum_simulation_energy_account(run, &out, sizeof out));
  assert_int_equal(out.struct_size, sizeof out);
  return out;
}

/* Runs a frozen mechanism to t = 1 s, then destroys the run and the mechanism. */
static baum_energy_account run_to_1(baum_mechanism *m, baum_simulation_options options)
{
  check(baum_mechanism_freeze(m));
  baum_simulation *run = create_run(m, &options);
  check(baum_simulation_advance_to(run, 1.0));
  baum_energy_account out = read_account(run);
  ASSERT_NEAR(out.residual, 0.0, 0.0, CLOSE);
  assert_true(counters_of(run).energy_residual == out.residual);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  return out;
}

/* Makes a mechanism without gravity: a particle of 1 kg at (1, 0) with the velocity v along x. */
static baum_mechanism *make(double v, baum_body_id *id)
{
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
  baum_planar_particle_def particle = baum_planar_particle_def_default();
  particle.position[0] = 1.0;
  particle.velocity[0] = v;
  check(baum_mechanism_add_planar_particle(m, &particle, id));
  return m;
}

/* ---- classes of work ---- */

/* From rest, a force of 2 N moves 1 kg by 1 m in 1 s: the work is 2 J. */
static void loads_do_work(void **state)
{
  (void)state;
  baum_body_id body;
  baum_input_id input;
  baum_mechanism *m = make(0.0, &body);
  check(baum_mechanism_add_input(m, "push", 2.0, &input));
  baum_planar_load_def load = baum_planar_load_def_default();
  load.body = body;
  load.force[0] = 1.0;
  load.input = input;
  check(baum_mechanism_add_planar_load(m, &load, NULL));
  baum_energy_account a = run_to_1(m, account_options());
  ASSERT_NEAR(a.loads, 2.0, 0.0, CLOSE);
  ASSERT_NEAR(a.kinetic, 2.0, 0.0, CLOSE);
}

static int soft_law(double length, double rate, double *out, void *user)
{
  (void)rate;
  (void)user;
  out[0] = 4.0 * length;
  out[1] = 4.0;
  return 0;
}

static baum_energy_account run_spring(double damping, baum_spring_fn *law)
{
  baum_body_id body;
  baum_mechanism *m = make(law ? 0.0 : 3.0, &body);
  baum_planar_spring_def spring = baum_planar_spring_def_default();
  spring.body_a = BAUM_GROUND;
  spring.body_b = body;
  spring.point_a[0] = -1.0;
  spring.point_a[1] = 0.0;
  spring.point_b[0] = 0.0;
  spring.point_b[1] = 0.0;
  spring.damping = damping;
  spring.law = law;
  check(baum_mechanism_add_planar_spring(m, &spring, NULL));
  return run_to_1(m, account_options());
}

/* The velocity is v = 3 exp(-c t) with c = 0.5, so the kinetic energy falls from 4.5 J by a factor
 * of exp(-1) in 1 s. */
static void dampers_take_energy(void **state)
{
  (void)state;
  baum_energy_account a = run_spring(0.5, NULL);
  ASSERT_NEAR(a.dampers, -4.5 * (1.0 - exp(-1.0)), 0.0, CLOSE);
}

/* The length of the spring is l = |2 cos 2t|. When its length is l, the spring force 4 l has done
 * the work 8 - 2 l^2. The account lists this work under `springs`, because the library knows no
 * potential of a law that the user gives. */
static void the_work_of_a_law_is_listed_under_springs(void **state)
{
  (void)state;
  baum_energy_account a = run_spring(0.0, soft_law);
  double length = 2.0 * cos(2.0);
  ASSERT_NEAR(a.springs, 8.0 - 2.0 * length * length, 0.0, CLOSE);
  ASSERT_NEAR(a.potential, 0.0, 0.0, 0.0);
}

static int push(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)q;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = 6.0 * t;
  return 0;
}

/* x'' = 6 t gives v = 3 t^2, so the kinetic energy is 9/2 J at t = 1. */
static void user_forces_do_work(void **state)
{
  (void)state;
  baum_body_id body;
  baum_mechanism *m = make(0.0, &body);
  baum_user_force_def force = baum_user_force_def_default();
  force.bodies = &body;
  force.body_count = 1;
  force.force = push;
  check(baum_mechanism_add_user_force(m, &force, NULL));
  ASSERT_NEAR(run_to_1(m, account_options()).user_forces, 4.5, 0.0, CLOSE);
}

static int growing_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = 1.0 + q[0] * q[0];
  return 0;
}

/* The mass is M = 1 + q^2, but the equation of motion is only M v' = 0. It lacks the terms with M'
 * of Lagrange's equation, so the velocity v = 1 stays constant. The kinetic energy M v^2 / 2 thus
 * grows because of M' alone. The account lists this change under `bodies`. */
static void a_varying_mass_is_in_the_account(void **state)
{
  (void)state;
  static const double rate[1] = {1.0};
  baum_mechanism *m = create_mechanism();
  baum_coordinates_def body = baum_coordinates_def_default();
  body.size = 1;
  body.v = rate;
  body.mass = growing_mass;
  body.force = user_no_force;
  check(baum_mechanism_add_coordinates(m, &body, NULL));
  ASSERT_NEAR(run_to_1(m, account_options()).bodies, 0.5, 0.0, CLOSE);
}

/* A driver accelerates a wheel of 2 kg m^2 from rest by 3 rad/s^2. In 1 s the driver does 9 J of
 * work. */
static void drivers_do_work(void **state)
{
  (void)state;
  baum_body_id wheel;
  baum_mechanism *m = create_mechanism();
  baum_planar_body_def body = baum_planar_body_def_default();
  body.inertia = 2.0;
  check(baum_mechanism_add_planar_body(m, &body, &wheel));
  baum_joint_id pin = add_planar_pin(m, NULL, BAUM_GROUND, wheel, 0.0, 0.0);
  baum_driver_def driver = baum_driver_def_default();
  driver.joint = pin;
  driver.acceleration = 3.0;
  check(baum_mechanism_add_driver(m, &driver, NULL));
  ASSERT_NEAR(run_to_1(m, account_options()).drivers, 9.0, 0.0, CLOSE);
}

/* ---- constraints ---- */

static int wall(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[0] - 1.0;
  return 0;
}

static int wall_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  out[0] = 1.0;
  return 0;
}

/* A particle starts at x = 1 m with a velocity of 1 m/s along x. The constraint is x = 1, which
 * this velocity violates. `gravity` acts along x. */
static baum_energy_account run_wall(double gravity, baum_simulation_options options)
{
  baum_body_id body;
  baum_mechanism *m = make(1.0, &body);
  check(baum_mechanism_set_gravity(m, gravity, 0.0, 0.0));
  baum_user_constraint_def row = baum_user_constraint_def_default();
  row.bodies = &body;
  row.body_count = 1;
  row.row_count = 1;
  row.phi = wall;
  row.jacobian = wall_jacobian;
  check(baum_mechanism_add_user_constraint(m, &row, NULL));
  return run_to_1(m, options);
}

/* The constraint force balances the weight of 5 N. Without stabilization, x grows by 1 m in 1 s, so
 * the constraint force does the work -5 J. */
static void violation_does_work(void **state)
{
  (void)state;
  baum_energy_account a = run_wall(5.0, account_options());
  ASSERT_NEAR(a.violation, -5.0, 0.0, CLOSE);
  ASSERT_NEAR(a.gains, 0.0, 0.0, CLOSE);
}

/* With alpha = beta = 2 the exact motion is x - 1 = t exp(-2 t), v = (1 - 2 t) exp(-2 t). The field
 * `violation` of the account includes the work of the force that balances the weight. The field
 * `gains` excludes this work. */
static void gains_are_a_part_of_the_violation(void **state)
{
  (void)state;
  baum_simulation_options o = account_options();
  o.formulation = BAUM_FORMULATION_BAUMGARTE;
  o.gains = baum_gains_fixed(2.0, 2.0);
  baum_energy_account a = run_wall(5.0, o);
  double v = -exp(-2.0);
  ASSERT_NEAR(a.gains, 0.5 * (v * v - 1.0), 0.0, CLOSE);
  ASSERT_NEAR(a.violation, a.gains - 5.0 * exp(-2.0), 0.0, CLOSE);
}

/* Projection at the end of the first step sets the velocity to zero. This removes 0.5 J. */
static void projection_takes_energy(void **state)
{
  (void)state;
  baum_simulation_options o = account_options();
  o.formulation = BAUM_FORMULATION_PROJECTION;
  ASSERT_NEAR(run_wall(0.0, o).projection, -0.5, 0.0, CLOSE);
  o.integrator = baum_rk4();
  o.rtol = (double)NAN;
  o.max_step = (double)NAN;
  o.step = 0.01;
  ASSERT_NEAR(run_wall(0.0, o).projection, -0.5, 0.0, CLOSE);
}

/* ---- during a run ---- */

static baum_mechanism *make_pushed(baum_input_id *input)
{
  baum_body_id body;
  baum_mechanism *m = make(0.0, &body);
  check(baum_mechanism_add_input(m, "push", 2.0, input));
  baum_planar_load_def load = baum_planar_load_def_default();
  load.body = body;
  load.force[0] = 1.0;
  load.input = *input;
  check(baum_mechanism_add_planar_load(m, &load, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

/* In 1 s, a force of 2 N accelerates a particle of 1 kg from rest to 2 m/s. In the next second, a
 * force of 4 N accelerates the particle to 6 m/s. The account continues after a new input value,
 * but set_state() restarts the account. */
static void inputs_continue_and_states_restart(void **state)
{
  (void)state;
  baum_input_id input;
  baum_mechanism *m = make_pushed(&input);
  baum_simulation_options o = account_options();
  o.max_step = 0.3; /* so that no step ends at 1 s */
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_advance_to(run, 1.0));
  check(baum_simulation_set_input(run, input, 4.0));
  ASSERT_NEAR(read_account(run).loads, 2.0, 0.0, CLOSE);
  check(baum_simulation_advance_to(run, 2.0));
  ASSERT_NEAR(read_account(run).loads, 18.0, 0.0, CLOSE);
  check(baum_simulation_advance_to(run, 1.0));
  ASSERT_NEAR(read_account(run).loads, 2.0, 0.0, CLOSE);
  const double q[2] = {0.0, 0.0};
  const double v[2] = {1.0, 0.0};
  check(baum_simulation_set_state(run, 5.0, q, v));
  ASSERT_NEAR(read_account(run).loads, 0.0, 0.0, 0.0);
  ASSERT_NEAR(read_account(run).start, 0.5, 0.0, 0.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* A sample between two grid points includes the work up to its own time. Sampling changes neither
 * the account of the run nor the motion. */
static void samples_change_neither_the_account_nor_the_motion(void **state)
{
  (void)state;
  enum { WIDTH = 12, LOADS = 2, N = 3 };
  static const double times[N] = {0.105, 0.205, 0.3};
  const baum_channel channel = baum_channel_of(BAUM_ENERGY_ACCOUNT);
  double rows[N][WIDTH];
  double x[2];
  baum_input_id input;
  baum_mechanism *m = make_pushed(&input);
  for (int k = 0; k < 2; k++) {
    baum_simulation_options o = account_options();
    o.integrator = baum_rk4();
    o.rtol = (double)NAN;
    o.max_step = (double)NAN;
    o.step = 0.01;
    o.energy_account = k == 0;
    baum_simulation *run = create_run(m, &o);
    if (k == 0) {
      check(baum_simulation_sample(run, times, N, &channel, 1, rows[0], NULL));
      ASSERT_NEAR(read_account(run).loads, 2.0 * 0.09, 0.0, CLOSE);
    } else {
      check(baum_simulation_advance_to(run, 0.3));
    }
    x[k] = baum_simulation_q(run)[0];
    baum_simulation_destroy(run);
  }
  for (int k = 0; k < N; k++) {
    ASSERT_NEAR(rows[k][LOADS], 2.0 * times[k] * times[k], 0.0, CLOSE);
  }
  assert_true(x[0] == x[1]);
  baum_mechanism_destroy(m);
}

static void runs_without_an_account_refuse_to_return_one(void **state)
{
  (void)state;
  baum_input_id input;
  baum_mechanism *m = make_pushed(&input);
  baum_simulation_options o = account_options();
  baum_energy_account out;
  o.energy_account = false;
  baum_simulation *run = create_run(m, &o);
  assert_true(isnan(counters_of(run).energy_residual));
  ASSERT_SAYS(baum_simulation_energy_account(run, &out, sizeof out), BAUM_ERR_STATE,
              "energy_account");
  ASSERT_SAYS(baum_simulation_energy_account(NULL, &out, sizeof out), BAUM_ERR_ARGUMENT,
              "simulation is NULL");
  ASSERT_SAYS(baum_simulation_energy_account(run, NULL, sizeof out), BAUM_ERR_ARGUMENT,
              "out is NULL");
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(loads_do_work),
    cmocka_unit_test(dampers_take_energy),
    cmocka_unit_test(the_work_of_a_law_is_listed_under_springs),
    cmocka_unit_test(user_forces_do_work),
    cmocka_unit_test(a_varying_mass_is_in_the_account),
    cmocka_unit_test(drivers_do_work),
    cmocka_unit_test(violation_does_work),
    cmocka_unit_test(gains_are_a_part_of_the_violation),
    cmocka_unit_test(projection_takes_energy),
    cmocka_unit_test(inputs_continue_and_states_restart),
    cmocka_unit_test(samples_change_neither_the_account_nor_the_motion),
    cmocka_unit_test(runs_without_an_account_refuse_to_return_one),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
