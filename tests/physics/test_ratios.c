/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the ratios of screws, gears, belts and constant-velocity joints over 100 revolutions
 * forward and backward, also in restored runs. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "base/rotation.h"
#include "check.h"
#include "construct.h"
#include "runs.h"
#include "step_mode.h"

static const double PITCH = -0.05;       /* [m] */
static const double GEAR = -37.0 / 23.0; /* ratio of a gear pair with skew axes */
static const double BELT = 0.4;          /* ratio of the belt that drives the screw */
static const double STIFFNESS = 0.2;     /* [N m/rad] of the spring that rotates the train back */
static const double AMPLITUDE = 640.0;   /* [rad] more than 100 revolutions */
static const double MOMENT = 0.5;        /* [kg m^2] of each body */
static const double TRAVEL_MASS = 2.0;   /* [kg] of each body */

/* A shaft on a spring drives three other parts: a second shaft through a constant-velocity joint, a
 * wheel with a skew axis through a gear pair, and a screw by a belt. */
typedef struct train {
  baum_mechanism *mechanism;
  baum_joint_id shaft, other, wheel, screw;
} train;

enum { BODIES = 4, NQ = 7 * BODIES };

static double total_moment(void)
{
  double lead = PITCH * BELT / BAUM_I_REVOLUTION;
  return MOMENT * (2.0 + GEAR * GEAR + BELT * BELT) + TRAVEL_MASS * lead * lead;
}

static double frequency(void)
{
  return sqrt(STIFFNESS / total_moment());
}

/* `speed` is the angular velocity about `axis`. If it is NaN, the angular velocity is not given. */
static baum_body_id add_body(baum_mechanism *m, const double position[3], const double axis[3],
                             double speed)
{
  baum_body_id id;
  baum_spatial_body_def def = baum_spatial_body_def_default();
  const double inertia[6] = {MOMENT, MOMENT, MOMENT, 0.0, 0.0, 0.0};
  def.mass = TRAVEL_MASS;
  memcpy(def.inertia, inertia, sizeof inertia);
  memcpy(def.position, position, sizeof def.position);
  for (int i = 0; i < 3; i++) {
    def.angular_velocity[i] = speed * axis[i];
  }
  check(baum_mechanism_add_spatial_body(m, &def, &id));
  return id;
}

static baum_joint_id add_bearing(baum_mechanism *m, baum_body_id body, const double point[3],
                                 const double axis[3])
{
  baum_joint_id id;
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = body;
  memcpy(def.point, point, sizeof def.point);
  memcpy(def.axis, axis, sizeof def.axis);
  check(baum_mechanism_add_spatial_revolute(m, &def, &id));
  return id;
}

static void couple(baum_mechanism *m, baum_joint_id a, baum_joint_id b, double ratio)
{
  baum_coupling_def def = baum_coupling_def_default();
  def.joint_a = a;
  def.joint_b = b;
  def.coordinate_a = def.coordinate_b = BAUM_COORDINATE_ANGLE;
  def.ratio = ratio;
  check(baum_mechanism_add_coupling(m, &def, NULL));
}

static void add_screw(train *t)
{
  static const double place[3] = {0.0, -2.0, 0.0};
  static const double axis[3] = {2.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0};
  baum_spatial_screw_def def = baum_spatial_screw_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = add_body(t->mechanism, place, axis, (double)NAN);
  memcpy(def.point, place, sizeof def.point);
  memcpy(def.axis, axis, sizeof def.axis);
  def.pitch = PITCH;
  check(baum_mechanism_add_spatial_screw(t->mechanism, &def, &t->screw));
  couple(t->mechanism, t->shaft, t->screw, BELT);
}

static train make(double speed)
{
  static const double places[3][3] = {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.5, 0.0}};
  static const double axes[3][3] = {
    {0.0, 0.0, 1.0}, {0.6, 0.0, 0.8}, {2.0 / 7.0, 6.0 / 7.0, 3.0 / 7.0}};
  train t;
  t.mechanism = create_mechanism();
  check(baum_mechanism_set_gravity(t.mechanism, 0.0, 0.0, 0.0));
  baum_body_id bodies[3];
  baum_joint_id *joints[3] = {&t.shaft, &t.other, &t.wheel};
  for (int k = 0; k < 3; k++) {
    bodies[k] = add_body(t.mechanism, places[k], axes[k], k == 0 ? speed : (double)NAN);
    *joints[k] = add_bearing(t.mechanism, bodies[k], places[k], axes[k]);
  }
  baum_spatial_constant_velocity_def cage = baum_spatial_constant_velocity_def_default();
  cage.body_a = bodies[0];
  cage.body_b = bodies[1];
  memcpy(cage.point, places[1], sizeof cage.point);
  memcpy(cage.axis, axes[0], sizeof cage.axis);
  memcpy(cage.axis_b, axes[1], sizeof cage.axis_b);
  check(baum_mechanism_add_spatial_constant_velocity(t.mechanism, &cage, NULL));
  couple(t.mechanism, t.shaft, t.wheel, GEAR);
  add_screw(&t);
  baum_joint_spring_def spring = baum_joint_spring_def_default();
  spring.joint = t.shaft;
  spring.coordinate = BAUM_COORDINATE_ANGLE;
  spring.stiffness = STIFFNESS;
  check(baum_mechanism_add_joint_spring(t.mechanism, &spring, NULL));
  check(baum_mechanism_freeze(t.mechanism));
  return t;
}

/* Reads the angles of both shafts, the wheel and the screw, and the displacement of the screw. */
enum { READ = 5 };
static void read(baum_simulation *run, const train *t, double out[READ])
{
  const baum_joint_id joints[READ] = {t->shaft, t->other, t->wheel, t->screw, t->screw};
  for (int k = 0; k < READ; k++) {
    double both[2];
    baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, joints[k]);
    channel.coordinate = k == 4 ? BAUM_COORDINATE_DISPLACEMENT : BAUM_COORDINATE_ANGLE;
    check(baum_simulation_get(run, &channel, 1, both));
    out[k] = both[0];
  }
}

/* Returns the largest error of the ratios, relative to the angles. */
static double ratio_error(baum_simulation *run, const train *t)
{
  double x[READ];
  read(run, t, x);
  const double errors[] = {x[1] - x[0], x[2] - GEAR * x[0], x[3] - BELT * x[0],
                           x[4] - PITCH / BAUM_I_REVOLUTION * x[3]};
  double largest = 0.0;
  for (int k = 0; k < 4; k++) {
    largest = fmax(largest, fabs(errors[k]));
  }
  return largest / fmax(1.0, fabs(x[0]));
}

static baum_simulation *start(const train *t, const baum_integrator *integrator, double step)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.formulation = BAUM_FORMULATION_PROJECTION;
  o.step = step;
  return create_run(t->mechanism, &o);
}

/* The train makes a whole oscillation. The run is saved and restored several times. */
static void ratios_are_exact_over_100_revolutions(void **state)
{
  (void)state;
  static unsigned char buffer[1 << 16];
  const double period = BAUM_I_REVOLUTION / frequency();
  train t = make(AMPLITUDE * frequency());
  baum_simulation *run = start(&t, baum_rk4(), 1e-3);
  double most = 0.0;
  double farthest[2] = {0.0, 0.0};
  for (int i = 1; i <= 40; i++) {
    double x[READ];
    check(baum_simulation_advance_to(run, period * i / 40));
    read(run, &t, x);
    most = fmax(most, ratio_error(run, &t));
    farthest[0] = fmin(farthest[0], x[0]);
    farthest[1] = fmax(farthest[1], x[0]);
    if (i % 7 == 0) {
      size_t size = 0;
      check(baum_simulation_save(run, buffer, sizeof buffer, &size));
      baum_simulation *next = start(&t, baum_rk4(), 1e-3);
      check(baum_simulation_restore(next, buffer, size));
      baum_simulation_destroy(run);
      run = next;
    }
  }
  assert_true(most <= 1e-12);
  assert_true(farthest[0] < -100.0 * BAUM_I_REVOLUTION && farthest[1] > 100.0 * BAUM_I_REVOLUTION);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(t.mechanism);
}

/* The rows are satisfied at any number of revolutions, but the energy of the spring depends on this
 * number. A workspace must compute the right energy after it has been given the angle of the
 * shaft. */
static void a_workspace_uses_the_revolutions_that_it_is_given(void **state)
{
  (void)state;
  train t = make(AMPLITUDE * frequency());
  baum_simulation *run = start(&t, baum_rk4(), 1e-3);
  baum_workspace *w = NULL;
  double x[READ];
  double phi[64];
  double energy[2];
  int32_t rows = 0;
  check(baum_simulation_advance_to(run, 0.2 * BAUM_I_REVOLUTION / frequency()));
  read(run, &t, x);
  assert_true(fabs(x[0]) > 90.0 * BAUM_I_REVOLUTION);
  check(baum_workspace_create(t.mechanism, &w));
  check(baum_mechanism_sizes(t.mechanism, NULL, NULL, &rows));
  assert_true(rows <= 64);
  const double *q = baum_simulation_q(run);
  const double *v = baum_simulation_v(run);
  const double wound = 0.5 * STIFFNESS * x[0] * x[0];
  for (int given = 0; given < 2; given++) {
    check(baum_workspace_phi(w, 0.0, q, phi));
    for (int i = 0; i < rows; i++) {
      assert_true(fabs(phi[i]) <= 1e-12);
    }
    check(baum_workspace_energy(w, 0.0, q, v, &energy[0], &energy[1]));
    assert_true(given ? fabs(energy[1] / wound - 1.0) <= 1e-12 : energy[1] < 1e-3 * wound);
    check(baum_workspace_set_angle(w, t.shaft, BAUM_COORDINATE_FIRST, x[0] + 1.0));
  }
  assert_int_equal(baum_workspace_set_angle(NULL, t.shaft, BAUM_COORDINATE_ANGLE, 0.0),
                   BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_workspace_set_angle(w, t.screw, BAUM_COORDINATE_DISPLACEMENT, 0.0),
                   BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "must be an angle of a spatial joint"));
  assert_int_equal(baum_workspace_set_angle(w, t.shaft, BAUM_COORDINATE_ANGLE, (double)NAN),
                   BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "angle is nan rad, must be finite"));
  baum_workspace_destroy(w);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(t.mechanism);
}

/* ---- all methods ---- */

/* Returns the allowed error of the angle. It is at least three times the measured error. */
static double allowed(step_mode mode, baum_formulation formulation)
{
  static const double by_order[] = {5e-7, 1e-3, 2e-5, 3e-8, 3e-10, 1e-13, 1e-13, 1e-13, 1e-13};
  double wide = step_mode_is_adams(mode) ? 30.0 : 1.0;
  return formulation == BAUM_FORMULATION_INDEX3
           ? 1e-6
           : wide * by_order[mode.fixed ? baum_integrator_order(mode.integrator) : 0];
}

static void check_method(step_mode mode, baum_formulation formulation)
{
  static const double speed = 4.0, end = 1.0;
  train t = make(speed);
  baum_simulation_options o = step_mode_options(mode, 1e-3, 1e-8);
  double x[READ];
  o.formulation = formulation;
  baum_simulation *run = create_run(t.mechanism, &o);
  check(baum_simulation_advance_to(run, end));
  read(run, &t, x);
  double error = fabs(x[0] - speed / frequency() * sin(frequency() * end));
  double ratio = ratio_error(run, &t);
  if (!(error <= allowed(mode, formulation)) || !(ratio <= allowed(mode, formulation))) {
    fail_msg("%s, %s, %s: error %.3g, ratio %.3g, allowed %.3g",
             baum_integrator_name(mode.integrator), mode.fixed ? "fixed step" : "variable step",
             baum_formulation_name(formulation), error, ratio, allowed(mode, formulation));
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(t.mechanism);
}

/* Calls `test` for every pair of a method and a formulation that the method offers. */
static void with_every_method(void (*test)(step_mode, baum_formulation))
{
  int tried = 0;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    for (int f = BAUM_FORMULATION_DEFAULT + 1; baum_formulation_name((baum_formulation)f); f++) {
      if (baum_integrator_offers(mode.integrator, (baum_formulation)f)) {
        test(mode, (baum_formulation)f);
        tried++;
      }
    }
  }
  assert_true(tried >= 15);
}

static void every_method_keeps_the_ratios(void **state)
{
  (void)state;
  with_every_method(check_method);
}

/* ---- constant-velocity joints ---- */

/* A shaft that rotates at a constant rate drives another shaft. The angle between the shafts ranges
 * from 3 to 175 degrees. */
static void rates_are_equal_at_any_angle(void **state)
{
  (void)state;
  for (int k = 0; k <= 10; k++) {
    const double tilt = 0.05 + 0.3 * k;
    const double axes[2][3] = {{0.0, 0.0, 1.0}, {sin(tilt), 0.0, cos(tilt)}};
    const double origin[3] = {0.0, 0.0, 0.0};
    baum_joint_id bearings[2];
    baum_body_id bodies[2];
    baum_mechanism *m = create_mechanism();
    check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
    for (int n = 0; n < 2; n++) {
      bodies[n] = add_body(m, origin, axes[n], (double)NAN);
      bearings[n] = add_bearing(m, bodies[n], origin, axes[n]);
    }
    baum_spatial_constant_velocity_def cage = baum_spatial_constant_velocity_def_default();
    cage.body_a = bodies[0];
    cage.body_b = bodies[1];
    memcpy(cage.point, origin, sizeof cage.point);
    memcpy(cage.axis_b, axes[1], sizeof cage.axis_b);
    check(baum_mechanism_add_spatial_constant_velocity(m, &cage, NULL));
    baum_driver_def motor = baum_driver_def_default();
    motor.joint = bearings[0];
    motor.rate = 3.0;
    check(baum_mechanism_add_driver(m, &motor, NULL));
    check(baum_mechanism_freeze(m));
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_kinematics();
    baum_simulation *run = create_run(m, &o);
    for (int i = 1; i <= 20; i++) {
      double both[2];
      const baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, bearings[1]);
      check(baum_simulation_advance_to(run, 0.31 * i));
      check(baum_simulation_get(run, &channel, 1, both));
      assert_true(fabs(both[0] - 3.0 * 0.31 * i) < 1e-12);
      assert_true(fabs(both[1] - 3.0) < 1e-12);
    }
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

/* A top hangs from a shaft by a constant-velocity joint. Gravity swings it through the
 * configuration in which both axes point in opposite directions, at about 0.7 s. */
static baum_mechanism *make_top(void)
{
  static const double origin[3] = {0.0, 0.0, 0.0}, up[3] = {0.0, 0.0, 1.0};
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 3.0, 1.0, -9.81));
  baum_spatial_constant_velocity_def cage = baum_spatial_constant_velocity_def_default();
  cage.body_a = add_body(m, origin, up, (double)NAN);
  add_bearing(m, cage.body_a, origin, up);
  baum_spatial_body_def top = baum_spatial_body_def_default();
  memcpy(top.position, (const double[]){0.3, 0.1, 0.5}, sizeof top.position);
  memcpy(top.inertia, (const double[]){0.15, 0.14, 0.12}, 3 * sizeof *top.inertia);
  check(baum_mechanism_add_spatial_body(m, &top, &cage.body_b));
  memcpy(cage.point, origin, sizeof cage.point);
  memcpy(cage.axis_b, (const double[]){0.6, 0.2, 1.0}, sizeof cage.axis_b);
  check(baum_mechanism_add_spatial_constant_velocity(m, &cage, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

enum { TOP_NQ = 14 };

/* Runs the top for 1 s, and writes its positions. Returns the change of the energy. */
static double run_top(step_mode mode, baum_formulation formulation, double rtol, double q[TOP_NQ])
{
  baum_mechanism *m = make_top();
  baum_simulation_options o = step_mode_options(mode, 1e-3, rtol);
  baum_counters c;
  o.formulation = formulation;
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_advance_to(run, 1.0));
  check(baum_simulation_counters(run, &c, sizeof c));
  memcpy(q, baum_simulation_q(run), TOP_NQ * sizeof *q);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  return c.energy_change;
}

/* Compares with rk8 at a small tolerance. The limits are at least three times the measured errors.
 * Steps of methods of order 1 are too long for this motion. */
static void check_top(step_mode mode, baum_formulation formulation)
{
  static const double by_order[] = {2e-5, INFINITY, 3e-4, 5e-5, 5e-8, 1e-9, 1e-9, 1e-9, 1e-9};
  const int order = mode.fixed ? baum_integrator_order(mode.integrator) : 0;
  double right[TOP_NQ], q[TOP_NQ];
  if (order == 1) {
    return;
  }
  (void)run_top((step_mode){baum_rk8(), false}, BAUM_FORMULATION_PROJECTION, 1e-12, right);
  double worst = fabs(run_top(mode, formulation, 1e-8, q));
  for (int i = 0; i < TOP_NQ; i++) {
    worst = fmax(worst, fabs(q[i] - right[i]));
  }
  if (!(worst <= by_order[order])) {
    fail_msg("%s, %s, %s: error %.3g, allowed %.3g", baum_integrator_name(mode.integrator),
             mode.fixed ? "fixed step" : "variable step", baum_formulation_name(formulation), worst,
             by_order[order]);
  }
}

static void every_method_passes_opposite_axes(void **state)
{
  (void)state;
  with_every_method(check_top);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(ratios_are_exact_over_100_revolutions),
    cmocka_unit_test(a_workspace_uses_the_revolutions_that_it_is_given),
    cmocka_unit_test(every_method_keeps_the_ratios),
    cmocka_unit_test(rates_are_equal_at_any_angle),
    cmocka_unit_test(every_method_passes_opposite_axes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
