/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests bushings and torsion springs in space. Forces are compared with closed forms, and small
 * motions with the linear equations of six coordinates. Large motions are compared between all
 * integrators. */
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

enum { SIX = 6 };

/* ---- scenes ---- */

static void set3(double out[3], double x, double y, double z)
{
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

static baum_body_id add_body(baum_mechanism *m, const double inertia[SIX])
{
  baum_body_id id;
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.mass = 2.0;
  memcpy(def.inertia, inertia, sizeof def.inertia);
  check(baum_mechanism_add_spatial_body(m, &def, &id));
  return id;
}

static const double SPHERE[SIX] = {0.5, 0.5, 0.5, 0.0, 0.0, 0.0};
static const double BRICK[SIX] = {0.5, 0.7, 0.9, 0.05, -0.1, 0.02};

/* Sets full symmetric matrices that are positive definite. */
static void set_matrices(double stiffness[36], double damping[36])
{
  for (int i = 0; i < 36; i++) {
    int row = i / SIX;
    int column = i % SIX;
    stiffness[i] = (row == column ? 40.0 + 5.0 * row : 0.0) + 3.0 * cos(row + column);
    damping[i] = (row == column ? 0.4 : 0.0) + 0.02 * (row + 1.0) * (column + 1.0);
  }
}

static baum_spatial_bushing_def bushing_on(baum_body_id body)
{
  baum_spatial_bushing_def def = baum_spatial_bushing_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = body;
  set3(def.point, 0.0, 0.0, 0.0);
  return def;
}

/* ---- closed forms ---- */

/* Writes the state of a body that was rotated by `angle` about the unit vector n. */
static void set_rotated(const double n[3], double angle, double q[7])
{
  const double rotation[3] = {angle * n[0], angle * n[1], angle * n[2]};
  memset(q, 0, 7 * sizeof *q);
  baum_i_quaternion_exp(rotation, q + 3);
}

/* With equal rotational stiffnesses k, the moment is k times the rotation vector, for angles up to
 * almost pi. If the stiffness matrix is diagonal, the force along each axis of the bushing is
 * stiffness times displacement. */
static void a_bushing_is_linear_in_its_rotation_vector(void **state)
{
  (void)state;
  static const double n[3] = {2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0};
  static const double angles[] = {0.0, 1e-9, 1e-3, 0.19, 0.21, 1.5, 3.0, 3.1415};
  baum_workspace *w = NULL;
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
  baum_spatial_bushing_def def = bushing_on(add_body(m, SPHERE));
  set3(def.axis, 1.0, 0.0, 0.0);
  set3(def.x_axis, 0.0, 1.0, 0.0); /* the axes of the bushing are y, z, x */
  for (int i = 0; i < SIX; i++) {
    def.stiffness[7 * i] = i < 3 ? 10.0 * (i + 1) : 4.0;
  }
  check(baum_mechanism_add_spatial_bushing(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  check(baum_workspace_create(m, &w));
  for (size_t k = 0; k < sizeof angles / sizeof *angles; k++) {
    double q[7];
    double force[SIX];
    const double v[SIX] = {0.0};
    set_rotated(n, angles[k], q);
    set3(q, 0.1, 0.2, 0.3);
    check(baum_workspace_force(w, 0.0, q, v, force));
    const double want[3] = {-30.0 * 0.1, -10.0 * 0.2, -20.0 * 0.3};
    for (int i = 0; i < 3; i++) {
      assert_true(fabs(force[i] - want[i]) <= 1e-14 * 6.0);
      assert_true(fabs(force[3 + i] + 4.0 * angles[k] * n[i]) <= 1e-14 * 13.0);
    }
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

/* A body is first rotated by `twist` about the axis of the spring, and then inclined about a
 * perpendicular axis. The angle of the spring must be the twist alone. */
static void a_torsion_spring_measures_the_twist(void **state)
{
  (void)state;
  static const double axis[3] = {2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0};
  double x[3];
  double y[3];
  baum_workspace *w = NULL;
  baum_i_complete_axes(axis, x, y);
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
  baum_spatial_torsion_spring_def def = baum_spatial_torsion_spring_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = add_body(m, SPHERE);
  set3(def.point, 0.0, 0.0, 0.0);
  memcpy(def.axis, axis, sizeof axis);
  def.stiffness = 3.0;
  def.free_angle = 0.2;
  check(baum_mechanism_add_spatial_torsion_spring(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  check(baum_workspace_create(m, &w));
  for (int k = 0; k < 25; k++) {
    double twist = -3.0 + 0.25 * k;
    double tilt = 0.12 * k;
    double turned[7];
    double inclined[7];
    double q[7] = {0.0};
    double energy = 0.0;
    const double v[SIX] = {0.0};
    set_rotated(axis, twist, turned);
    set_rotated(x, tilt, inclined);
    baum_i_quaternion_product(inclined + 3, turned + 3, q + 3);
    check(baum_workspace_energy(w, 0.0, q, v, NULL, &energy));
    double want = 1.5 * (twist - 0.2) * (twist - 0.2);
    assert_true(fabs(energy - want) <= 1e-13 * (1.0 + want));
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

/* ---- small motions ---- */

/* Computes x'' = -M^-1 (K x + C x') for the six coordinates of a body whose centre of mass is at
 * the bushing. M is the diagonal (mass, mass, mass, I, I, I). */
static void linear_rate(const double y[2 * SIX], double out[2 * SIX])
{
  double stiffness[36];
  double damping[36];
  set_matrices(stiffness, damping);
  for (int i = 0; i < SIX; i++) {
    double sum = 0.0;
    for (int j = 0; j < SIX; j++) {
      sum -= stiffness[SIX * i + j] * y[j] + damping[SIX * i + j] * y[SIX + j];
    }
    out[i] = y[SIX + i];
    out[SIX + i] = sum / (i < 3 ? 2.0 : 0.5);
  }
}

/* Integrates the linear equations by 4000 steps of the classical Runge-Kutta method. */
static void linear_motion(double end, double y[2 * SIX])
{
  static const double places[4] = {0.0, 0.5, 0.5, 1.0};
  static const double weights[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  const double h = end / 4000;
  for (int n = 0; n < 4000; n++) {
    double sum[2 * SIX] = {0.0};
    double rate[2 * SIX] = {0.0};
    for (int k = 0; k < 4; k++) {
      double stage[2 * SIX];
      for (int i = 0; i < 2 * SIX; i++) {
        stage[i] = y[i] + places[k] * h * rate[i];
      }
      linear_rate(stage, rate);
      for (int i = 0; i < 2 * SIX; i++) {
        sum[i] += weights[k] * rate[i];
      }
    }
    for (int i = 0; i < 2 * SIX; i++) {
      y[i] += h * sum[i];
    }
  }
}

/* The linear equations have a relative error of the order of the amplitude. */
static void small_motions_are_those_of_the_linear_equations(void **state)
{
  (void)state;
  static const double amplitudes[2] = {1e-3, 1e-6};
  for (int n = 0; n < 2; n++) {
    const double amplitude = amplitudes[n];
    double q[7] = {0.0};
    double v[SIX];
    double y[2 * SIX];
    double rotation[3];
    baum_mechanism *m = create_mechanism();
    check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
    baum_spatial_bushing_def def = bushing_on(add_body(m, SPHERE));
    set_matrices(def.stiffness, def.damping);
    set3(def.x_axis, 1.0, 0.0, 0.0);
    check(baum_mechanism_add_spatial_bushing(m, &def, NULL));
    check(baum_mechanism_freeze(m));
    for (int i = 0; i < SIX; i++) {
      y[i] = amplitude * cos(1.0 + i);
      y[SIX + i] = v[i] = amplitude * sin(2.0 * i);
    }
    memcpy(q, y, 3 * sizeof *q);
    baum_i_quaternion_exp(y + 3, q + 3);
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_rk8();
    o.step = 1e-3;
    baum_simulation *run = create_run(m, &o);
    check(baum_simulation_set_state(run, 0.0, q, v));
    check(baum_simulation_advance_to(run, 2.0));
    linear_motion(2.0, y);
    const double *end = baum_simulation_q(run);
    baum_i_quaternion_log(end + 3, rotation);
    for (int i = 0; i < 3; i++) {
      assert_true(fabs(end[i] - y[i]) < 2.0 * amplitude * amplitude);
      assert_true(fabs(rotation[i] - y[3 + i]) < 2.0 * amplitude * amplitude);
    }
    assert_true(fabs(y[0]) > 0.01 * amplitude); /* the motion has not died out */
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

/* ---- large motions ---- */

/* Makes a brick on a ball joint and a second brick on a bushing to ground. Another bushing and a
 * torsion spring join the two bricks. */
static baum_mechanism *make_pair(bool damped)
{
  double damping[36];
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -9.81));
  baum_body_id first = add_body(m, BRICK);
  baum_body_id second = add_body(m, BRICK);
  baum_spatial_spherical_def ball = baum_spatial_spherical_def_default();
  ball.body_a = BAUM_GROUND;
  ball.body_b = first;
  set3(ball.point, 0.3, 0.2, 0.1);
  check(baum_mechanism_add_spatial_spherical(m, &ball, NULL));
  baum_spatial_bushing_def def = bushing_on(second);
  set3(def.axis, 1.0, 2.0, 2.0);
  set_matrices(def.stiffness, damping);
  memcpy(def.damping, damping, damped ? sizeof damping : 0);
  check(baum_mechanism_add_spatial_bushing(m, &def, NULL));
  def.body_a = first;
  set3(def.point, 0.0, 0.4, 0.2);
  check(baum_mechanism_add_spatial_bushing(m, &def, NULL));
  baum_spatial_torsion_spring_def twist = baum_spatial_torsion_spring_def_default();
  twist.body_a = first;
  twist.body_b = second;
  set3(twist.point, 0.0, 0.0, 0.0);
  set3(twist.axis, 0.0, 1.0, 1.0);
  twist.stiffness = 5.0;
  twist.damping = damped ? 0.3 : 0.0;
  twist.free_angle = 1.0;
  check(baum_mechanism_add_spatial_torsion_spring(m, &twist, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

enum { NQ = 14 };

/* Runs for 0.5 s and returns the relative residual of the energy account. */
static double run_pair(bool damped, const baum_simulation_options *given, double q[NQ])
{
  baum_mechanism *m = make_pair(damped);
  baum_energy_account account;
  baum_simulation_options o = *given;
  o.energy_account = true;
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_advance_to(run, 0.5));
  check(baum_simulation_energy_account(run, &account, sizeof account));
  memcpy(q, baum_simulation_q(run), NQ * sizeof *q);
  assert_true(damped == (account.dampers < -1e-3));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  return fabs(account.residual) / 20.0; /* [J] typical kinetic energy */
}

/* Returns the allowed error of a method. It is at least three times the measured error. */
static double allowed(step_mode mode, baum_formulation formulation)
{
  static const double by_order[] = {5e-7, 2e-2, 2e-5, 1e-7, 2e-10, 1e-12, 1e-12, 1e-12, 1e-12};
  double wide = step_mode_is_adams(mode) ? 30.0 : 1.0;
  return formulation == BAUM_FORMULATION_INDEX3
           ? 1e-5
           : wide * by_order[mode.fixed ? baum_integrator_order(mode.integrator) : 0];
}

static void check_method(bool damped, step_mode mode, baum_formulation formulation,
                         const double want[NQ])
{
  double q[NQ];
  double largest = 0.0;
  baum_simulation_options o = step_mode_options(mode, 1e-3, 1e-8);
  o.formulation = formulation;
  double residual = run_pair(damped, &o, q);
  for (int i = 0; i < NQ; i++) {
    largest = fmax(largest, fabs(q[i] - want[i]));
  }
  if (!(largest <= allowed(mode, formulation)) || !(residual <= allowed(mode, formulation))) {
    fail_msg("%s, %s, %s: error %.3g, residual %.3g, allowed %.3g",
             baum_integrator_name(mode.integrator), mode.fixed ? "fixed step" : "variable step",
             baum_formulation_name(formulation), largest, residual, allowed(mode, formulation));
  }
}

/* RATTLE runs only without damping, because it refuses forces that depend on velocities. */
static void every_method_makes_the_same_motion(void **state)
{
  (void)state;
  for (int damped = 0; damped < 2; damped++) {
    double want[NQ];
    int tried = 0;
    baum_simulation_options fine = baum_simulation_options_default();
    fine.integrator = baum_rk8();
    fine.step = 2e-4;
    assert_true(run_pair(damped, &fine, want) < 1e-11);
    for (int k = 0; step_mode_at(k).integrator; k++) {
      step_mode mode = step_mode_at(k);
      for (int f = BAUM_FORMULATION_DEFAULT + 1; baum_formulation_name((baum_formulation)f); f++) {
        if (baum_integrator_offers(mode.integrator, (baum_formulation)f) &&
            !(damped && mode.integrator == baum_rattle())) {
          check_method(damped, mode, (baum_formulation)f, want);
          tried++;
        }
      }
    }
    assert_true(tried >= 15);
  }
}

/* ---- a bushing that rotates too far ---- */

/* Runs for 5 s with the initial velocities v of a body. At the start, the axes of the body are
 * parallel to those of ground. Returns the code of the run's warning, whose text must contain
 * `text`, or 0 if there is no warning. *first receives the time of the warning; `first` may be
 * NULL. Destroys the mechanism. */
static int code_of_rotation(baum_mechanism *m, const baum_simulation_options *o,
                            const double v[SIX], const char *text, double *first)
{
  const double q[7] = {0.0, 0.0, 0.0, 1.0};
  baum_warning warning = {.code = (baum_warning_code)0};
  baum_simulation *run = create_run(m, o);
  check(baum_simulation_set_state(run, 0.0, q, v));
  baum_status status = baum_simulation_advance_to(run, 5.0);
  assert_true(status == BAUM_OK || status == BAUM_WARNED);
  if (status == BAUM_WARNED) {
    check(baum_simulation_warning(run, 0, &warning, sizeof warning));
    assert_true(warning.doubts_motion);
    assert_non_null(strstr(warning.text, text));
    if (first) {
      *first = warning.first;
    }
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  return (int)warning.code;
}

/* Runs a sphere that rotates in a bushing about a tilted axis. Returns the code of the run's
 * warning, or 0 if there is none. With the initial angular velocity w_0, the rotational stiffness k
 * and the moment of inertia I, the angle reaches at most w_0 / sqrt(k / I). */
static int warning_of(double angle, double stiffness, bool fixed)
{
  static const double n[3] = {2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0};
  double v[SIX] = {0.0};
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
  baum_spatial_bushing_def def = bushing_on(add_body(m, SPHERE));
  def.name = "rubber";
  for (int i = 0; i < SIX; i++) {
    def.stiffness[7 * i] = i < 3 ? 10.0 : stiffness;
  }
  check(baum_mechanism_add_spatial_bushing(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_dp5();
  o.step = fixed ? 1e-2 : (double)NAN;
  o.rtol = fixed ? (double)NAN : 1e-8;
  baum_i_add_scaled3(angle * sqrt(4.0 / 0.5), n, v + 3);
  return code_of_rotation(m, &o, v, "the rotation of force 1 \"rubber\" has passed pi", NULL);
}

static void a_bushing_that_passes_pi_warns(void **state)
{
  (void)state;
  for (int fixed = 0; fixed < 2; fixed++) {
    assert_int_equal(warning_of(3.1, 4.0, fixed), 0);
    assert_int_equal(warning_of(3.2, 4.0, fixed), BAUM_WARNING_BUSHING);
    assert_int_equal(warning_of(3.2, 0.0, fixed), 0); /* without stiffness, no moment can jump */
  }
}

/* ---- a torsion spring whose axes pass antiparallel directions ---- */

/* Rotates a sphere about the x axis. After half a revolution, the axes of its torsion spring are
 * `distance` away from opposite directions. A step rotates the sphere by `step`. Returns the code
 * of the run's warning, or 0. */
static int warning_of_twist(double distance, double stiffness, double step)
{
  const double v[SIX] = {0.0, 0.0, 0.0, 1.0};
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
  baum_spatial_torsion_spring_def def = baum_spatial_torsion_spring_def_default();
  def.name = "twist";
  def.body_a = BAUM_GROUND;
  def.body_b = add_body(m, SPHERE);
  set3(def.point, 0.0, 0.0, 0.0);
  set3(def.axis_b, sin(distance), 0.0, cos(distance));
  def.stiffness = stiffness;
  check(baum_mechanism_add_spatial_torsion_spring(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = step;
  double first = (double)NAN;
  int code =
    code_of_rotation(m, &o, v, "the axes of force 1 \"twist\" nearly point in opposite", &first);
  if (code != 0) {
    assert_true(fabs(first - 0.5 * BAUM_I_REVOLUTION) <= 3.0 * step);
  }
  return code;
}

static void a_torsion_spring_warns_if_a_step_may_lose_a_revolution(void **state)
{
  (void)state;
  static const double weak = 1e-9; /* too weak to change the motion */
  assert_int_equal(warning_of_twist(0.02, weak, 0.1), BAUM_WARNING_BUSHING);
  assert_int_equal(warning_of_twist(1e-5, weak, 0.01), BAUM_WARNING_BUSHING);
  assert_int_equal(warning_of_twist(0.02, weak, 0.02), 0);
  assert_int_equal(warning_of_twist(0.5, weak, 0.1), 0);
  assert_int_equal(warning_of_twist(0.02, 0.0, 0.1), 0); /* without torque */
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_bushing_is_linear_in_its_rotation_vector),
    cmocka_unit_test(a_torsion_spring_measures_the_twist),
    cmocka_unit_test(small_motions_are_those_of_the_linear_equations),
    cmocka_unit_test(every_method_makes_the_same_motion),
    cmocka_unit_test(a_bushing_that_passes_pi_warns),
    cmocka_unit_test(a_torsion_spring_warns_if_a_step_may_lose_a_revolution),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
