/* SPDX-License-Identifier: BSD-3-Clause */
#include "integrator_run.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#include <baum/planar.h>

#include "check.h"
#include "construct.h"

enum { MOST_STEPS = 1000000 };

/* ---- runs ---- */

integrator_setup integrator_setup_make(baum_mechanism *mechanism, const baum_integrator *integrator,
                                       baum_formulation formulation)
{
  return (integrator_setup){.mechanism = mechanism,
                            .integrator = integrator,
                            .formulation = formulation,
                            .fixed = baum_integrator_has_fixed_step(integrator),
                            .gain = 6.0,
                            .step = 1e-3,
                            .rtol = 1e-6,
                            .direction = 1.0};
}

static void find_rate(integrator_run *run)
{
  const baum_workspace *w = run->workspace;
  check(baum_i_acceleration(run->workspace, 0.0, run->state_q, run->state_v, 0.0, 0.0));
  run->problem.rate = fmax(baum_i_state_rate(w->mechanism, run->state_v, w->a), 1e-3);
}

static void define_problem(integrator_run *run, const integrator_setup *setup)
{
  run->problem.workspace = run->workspace;
  run->problem.formulation = setup->formulation == BAUM_FORMULATION_DEFAULT
                               ? setup->integrator->formulations[0]
                               : setup->formulation;
  run->problem.alpha = setup->gain;
  run->problem.beta = setup->gain;
  run->problem.direction = setup->direction;
  run->problem.rtol = setup->fixed ? (double)NAN : setup->rtol;
  run->problem.step = setup->fixed ? setup->step : (double)NAN;
  run->problem.max_step = (double)INFINITY;
  run->problem.tolerance_q = 1.0;
  run->problem.tolerance_v = 1.0;
  run->problem.tolerance_lambda = (double)INFINITY;
  run->step = setup->step;
}

baum_status integrator_run_open(integrator_run *run, const integrator_setup *setup)
{
  memset(run, 0, sizeof *run);
  run->integrator = setup->integrator;
  check(baum_workspace_create(setup->mechanism, &run->workspace));
  int nv = setup->mechanism->nv;
  assert_true(nv <= RUN_SIZE_MAX);
  check(baum_workspace_design(run->workspace, run->state_q, run->state_v));
  check(baum_workspace_assemble(run->workspace, 0.0, run->state_q, run->state_v, NULL, 0));
  run->state = (baum_i_state){.q = run->state_q, .v = run->state_v};
  check(baum_i_find_rows(run->workspace, 0.0, run->state_q));
  define_problem(run, setup);
  find_rate(run);
  baum_status status =
    baum_i_integrator_create(setup->integrator, &run->problem, &run->state, &run->self);
  if (status != BAUM_OK) {
    assert_null(run->self);
    integrator_run_close(run);
  }
  return status;
}

void integrator_run_close(integrator_run *run)
{
  baum_i_integrator_destroy(run->integrator, run->self);
  baum_workspace_destroy(run->workspace);
}

static baum_status take_fixed_step(integrator_run *run)
{
  baum_i_state *state = &run->state;
  double h = run->problem.direction * run->step;
  baum_status status = baum_i_problem_acceleration(&run->problem, state->t, state->q, state->v);
  if (status == BAUM_OK) {
    status = run->integrator->step(run->self, &run->problem, state, h, run->workspace->a);
  }
  if (status != BAUM_OK) {
    return status;
  }
  run->steps++;
  state->t = run->problem.direction * run->step * (double)run->steps;
  if (run->problem.formulation == BAUM_FORMULATION_PROJECTION) {
    status = baum_i_project(run->workspace, state->t, state->q, state->v);
  }
  if (status == BAUM_OK && run->integrator->accept) {
    run->integrator->accept(run->self, &run->problem, state);
  }
  return status;
}

baum_status integrator_run_step(integrator_run *run)
{
  if (baum_i_problem_has_fixed_step(&run->problem)) {
    return take_fixed_step(run);
  }
  baum_status status = run->integrator->advance(run->self, &run->problem, &run->state);
  run->steps += status == BAUM_OK ? 1 : 0;
  return status;
}

baum_status integrator_run_to(integrator_run *run, double t)
{
  bool fixed = baum_i_problem_has_fixed_step(&run->problem);
  double slack = fixed ? 0.5 * run->step : 0.0;
  while ((t - run->state.t) * run->problem.direction > slack) {
    baum_status status = integrator_run_step(run);
    if (status != BAUM_OK) {
      return status;
    }
    assert_true(run->steps < MOST_STEPS);
  }
  if (!fixed) {
    return run->integrator->interpolate(run->self, &run->problem, t, run->q, run->v);
  }
  memcpy(run->q, run->state_q, sizeof run->q);
  memcpy(run->v, run->state_v, sizeof run->v);
  return BAUM_OK;
}

baum_status integrator_run_restart(integrator_run *run, double t, const double *q, const double *v,
                                   double direction)
{
  size_t size = (size_t)run->workspace->mechanism->nv * sizeof(double);
  memmove(run->state_q, q, size);
  memmove(run->state_v, v, size);
  run->state.t = t;
  run->problem.direction = direction;
  return run->integrator->restart(run->self, &run->problem, &run->state);
}

double motion_error(int nv, const double *q, const double *v, const double *want_q,
                    const double *want_v, double rate)
{
  double error = 0.0;
  for (int i = 0; i < nv; i++) {
    error = fmax(error, fabs(q[i] - want_q[i]));
    error = fmax(error, fabs(v[i] - want_v[i]) / rate);
  }
  return error;
}

/* Returns the largest error at 50 equally spaced times up to t. */
static double largest_error(const integrator_setup *setup, double t, motion_fn *motion, double rate)
{
  integrator_run run;
  double largest = 0.0;
  check(integrator_run_open(&run, setup));
  for (int k = 1; k <= 50; k++) {
    double q[2];
    double v[2];
    double now = setup->direction * t * k / 50.0;
    check(integrator_run_to(&run, now));
    motion(now, q, v);
    largest = fmax(largest, motion_error(2, run.q, run.v, q, v, rate));
  }
  integrator_run_close(&run);
  return largest;
}

double tolerance_factor(const integrator_setup *setup, double t, motion_fn *motion, double rate)
{
  double sum = 0.0;
  integrator_setup trial = *setup;
  for (int k = -3; k <= 3; k++) {
    trial.rtol = pow(10.0, -7 - k);
    double error = log10(largest_error(&trial, t, motion, rate));
    sum += k * error;
  }
  return pow(10.0, -sum / 28.0); /* slope of the least-squares line; 28 is the sum of k^2 */
}

/* ---- mechanisms ---- */

static baum_mechanism *begin(void)
{
  baum_mechanism *mechanism = create_mechanism();
  return mechanism;
}

static baum_body_id add_particle(baum_mechanism *mechanism, double x, double y, double vx,
                                 double vy)
{
  baum_planar_particle_def def = baum_planar_particle_def_default();
  baum_body_id id;
  def.position[0] = x;
  def.position[1] = y;
  def.velocity[0] = vx;
  def.velocity[1] = vy;
  check(baum_mechanism_add_planar_particle(mechanism, &def, &id));
  return id;
}

static baum_body_id add_pendulum(baum_mechanism *mechanism)
{
  baum_body_id id = add_particle(mechanism, 1.0, 0.0, 0.0, 0.0);
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.body_a = BAUM_GROUND;
  rod.body_b = id;
  rod.point_a[0] = rod.point_a[1] = 0.0;
  rod.point_b[0] = rod.point_b[1] = 0.0;
  check(baum_mechanism_add_planar_distance(mechanism, &rod, NULL));
  return id;
}

static baum_mechanism *freeze(baum_mechanism *mechanism)
{
  check(baum_mechanism_freeze(mechanism));
  return mechanism;
}

baum_mechanism *make_pendulum(void)
{
  baum_mechanism *mechanism = begin();
  (void)add_pendulum(mechanism);
  return freeze(mechanism);
}

/* The equation of the pendulum is angle'' = -9.81 cos(angle). The angle is measured from the x
 * axis. */
static void angle_rate(const double y[2], double rate[2])
{
  rate[0] = y[1];
  rate[1] = -9.81 * cos(y[0]);
}

/* Takes a step of the classical Runge-Kutta method. With h = 1e-4 s the error after 2 s is below
 * 1e-13. */
static void turn_angle(double y[2], double h)
{
  double k[4][2];
  double z[2];
  static const double AT[4] = {0.0, 0.5, 0.5, 1.0};
  for (int i = 0; i < 4; i++) {
    for (int j = 0; j < 2; j++) {
      z[j] = y[j] + (i > 0 ? h * AT[i] * k[i - 1][j] : 0.0);
    }
    angle_rate(z, k[i]);
  }
  for (int j = 0; j < 2; j++) {
    y[j] += h / 6.0 * (k[0][j] + 2.0 * k[1][j] + 2.0 * k[2][j] + k[3][j]);
  }
}

void pendulum_motion(double t, double q[2], double v[2])
{
  long n = lround(ceil(fabs(t) / 1e-4));
  double y[2] = {0.0, 0.0};
  for (long i = 0; i < n; i++) {
    turn_angle(y, t / (double)n);
  }
  q[0] = cos(y[0]);
  q[1] = sin(y[0]);
  v[0] = -y[1] * sin(y[0]);
  v[1] = y[1] * cos(y[0]);
}

static int answer_fault(double t, const double *q, const double *v, const double *inputs,
                        double *out, void *user)
{
  (void)q;
  (void)v;
  (void)inputs;
  (void)out;
  force_fault *fault = user;
  fault->calls++;
  return fabs(t) > fault->after ? fault->answer : 0;
}

baum_mechanism *make_faulty_pendulum(force_fault *fault)
{
  baum_mechanism *mechanism = begin();
  baum_body_id id = add_pendulum(mechanism);
  baum_user_force_def def = baum_user_force_def_default();
  def.depends_on_velocity = false;
  def.name = "faulty";
  def.bodies = &id;
  def.body_count = 1;
  def.force = answer_fault;
  def.depends_on_velocity = false;
  def.user = fault;
  check(baum_mechanism_add_user_force(mechanism, &def, NULL));
  return freeze(mechanism);
}

baum_mechanism *make_throw(void)
{
  baum_mechanism *mechanism = begin();
  (void)add_particle(mechanism, 0.0, 0.0, 1.0, 2.0);
  check(baum_mechanism_set_characteristic_length(mechanism, 1.0));
  return freeze(mechanism);
}

void throw_motion(double t, double q[2], double v[2])
{
  q[0] = t;
  q[1] = 2.0 * t - 0.5 * 9.81 * t * t;
  v[0] = 1.0;
  v[1] = 2.0 - 9.81 * t;
}

static void add_spring(baum_mechanism *mechanism, baum_body_id id, double stiffness, double damping)
{
  baum_planar_spring_def spring = baum_planar_spring_def_default();
  spring.body_a = BAUM_GROUND;
  spring.body_b = id;
  spring.point_a[0] = spring.point_a[1] = 0.0;
  spring.point_b[0] = spring.point_b[1] = 0.0;
  spring.stiffness = stiffness;
  spring.damping = damping;
  spring.free_length = 0.0;
  check(baum_mechanism_add_planar_spring(mechanism, &spring, NULL));
}

/* The user force -4 q. It replaces a spring of zero length, which would have no direction at the
 * origin. */
static int pull(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = -4.0 * q[0];
  out[1] = -4.0 * q[1];
  return 0;
}

baum_mechanism *make_oscillator(void)
{
  baum_mechanism *mechanism = begin();
  check(baum_mechanism_set_gravity(mechanism, 0.0, 0.0, 0.0));
  check(baum_mechanism_set_characteristic_length(mechanism, 1.0));
  baum_body_id id = add_particle(mechanism, 1.0, 0.0, 0.0, 0.0);
  baum_user_force_def def = baum_user_force_def_default();
  def.depends_on_velocity = false;
  def.bodies = &id;
  def.body_count = 1;
  def.force = pull;
  def.depends_on_velocity = false;
  check(baum_mechanism_add_user_force(mechanism, &def, NULL));
  return freeze(mechanism);
}

void oscillator_motion(double t, double q[2], double v[2])
{
  q[0] = cos(2.0 * t);
  q[1] = 0.0;
  v[0] = -2.0 * sin(2.0 * t);
  v[1] = 0.0;
}

baum_mechanism *make_stiff(void)
{
  baum_mechanism *mechanism = begin();
  baum_body_id id = add_particle(mechanism, 1.0, 0.0, 0.0, 0.0);
  add_spring(mechanism, id, 1.0, 1e4);
  return freeze(mechanism);
}
