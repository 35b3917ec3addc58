/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the rolling disc. A general motion is compared with reduced equations, which have no
 * constraints and are integrated in quadruple precision. A ball on a turntable is compared with its
 * closed form. The steady motion of a disc is tested with the catalogue. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "quad.h"
#include "runs.h"
#include "step_mode.h"

/* ---- reduced equations ----
 *
 * The rim of the wheel is a torus whose cross section has the radius t. The distance from the
 * centre of the wheel to the centre of the cross section is R = RADIUS - t. For a disc with a sharp
 * edge, t = 0. Let n be the axis of the wheel, k the normal of the plane, and u the unit vector in
 * the direction of k - (k . n) n. The vector from the centre to the contact point is rho = -R u - t
 * k. Because the wheel rolls, the velocity of the centre is rho x w. The balance of the angular
 * momentum about the contact point is
 *
 *   I w' - m rho x (rho x w') = -w x I w + m rho x (rho' x w) + m g rho x k,
 *   I = I_t + (I_a - I_t) n n^T,   n' = w x n
 *
 * in ground axes. Here m is the mass, g is the acceleration of gravity, and I_a and I_t are the
 * moments of inertia about n and about transverse axes. The state consists of n, the angular
 * velocity w, and the horizontal position of the centre.
 */

static const double MASS = 1.2;
static const double TRANSVERSE = 0.08; /* I_t */
static const double AXIAL = 0.15;      /* I_a */
static const double RADIUS = 0.5;
static const double GRAVITY = 9.81; /* along -y; k = (0, 1, 0) */

enum { STATE = 9 }; /* n, w, position */

static wide dot(const wide *a, const wide *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const wide *a, const wide *b, wide *out)
{
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Solves a symmetric system by Cramer's rule. */
static void solve3(const wide a[3][3], const wide *b, wide *x)
{
  wide c[3][3];
  cross(a[1], a[2], c[0]);
  cross(a[2], a[0], c[1]);
  cross(a[0], a[1], c[2]);
  wide determinant = dot(a[0], c[0]);
  for (int i = 0; i < 3; i++) {
    x[i] = (c[0][i] * b[0] + c[1][i] * b[1] + c[2][i] * b[2]) / determinant;
  }
}

/* Sets rho and its derivative for n and n'. */
static void find_contact(const wide *n, const wide *dn, double rim, wide *rho, wide *drho)
{
  wide r = (wide)RADIUS - (wide)rim;
  wide s = wide_root(1 - n[1] * n[1]);
  for (int i = 0; i < 3; i++) {
    wide k = i == 1 ? 1 : 0;
    wide u = (k - n[1] * n[i]) / s;
    wide du = -(dn[1] * n[i] + n[1] * dn[i]) / s + u * n[1] * dn[1] / (s * s);
    rho[i] = -r * u - (wide)rim * k;
    drho[i] = -r * du;
  }
}

static void rate_of(const wide *x, double rim, wide *out)
{
  const wide *n = x;
  const wide *w = x + 3;
  const wide k[3] = {0, 1, 0};
  wide rho[3], drho[3], iw[3], gyro[3], slip[3], turn[3], weight[3], right[3], matrix[3][3];
  cross(w, n, out);
  find_contact(n, out, rim, rho, drho);
  wide axial = ((wide)AXIAL - (wide)TRANSVERSE) * dot(n, w);
  wide square = dot(rho, rho);
  for (int i = 0; i < 3; i++) {
    iw[i] = (wide)TRANSVERSE * w[i] + axial * n[i];
    for (int j = 0; j < 3; j++) {
      matrix[i][j] = ((wide)AXIAL - (wide)TRANSVERSE) * n[i] * n[j] - (wide)MASS * rho[i] * rho[j];
    }
    matrix[i][i] += (wide)TRANSVERSE + (wide)MASS * square;
  }
  cross(w, iw, gyro);
  cross(drho, w, slip);
  cross(rho, slip, turn);
  cross(rho, k, weight);
  for (int i = 0; i < 3; i++) {
    right[i] = -gyro[i] + (wide)MASS * (turn[i] + (wide)GRAVITY * weight[i]);
  }
  solve3((const wide(*)[3])matrix, right, out + 3);
  cross(rho, w, out + 6);
}

static void step_reduced(wide *x, wide h, double rim)
{
  wide k[4][STATE];
  wide at[STATE];
  rate_of(x, rim, k[0]);
  for (int s = 1; s < 4; s++) {
    for (int i = 0; i < STATE; i++) {
      at[i] = x[i] + (s < 3 ? h / 2 : h) * k[s - 1][i];
    }
    rate_of(at, rim, k[s]);
  }
  for (int i = 0; i < STATE; i++) {
    x[i] += h * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]) / 6;
  }
}

/* Integrates the reduced equations to t by the classical Runge-Kutta method, once with `steps`
 * steps and once with twice as many. Extrapolates from both results. */
static void reduce(const double start[STATE], double t, int steps, double rim, double out[STATE])
{
  wide x[2][STATE];
  for (int k = 0; k < 2; k++) {
    int count = steps * (k + 1);
    for (int i = 0; i < STATE; i++) {
      x[k][i] = (wide)start[i];
    }
    for (int n = 0; n < count; n++) {
      step_reduced(x[k], (wide)t / count, rim);
    }
  }
  for (int i = 0; i < STATE; i++) {
    out[i] = (double)(x[1][i] + (x[1][i] - x[0][i]) / 15);
  }
}

/* ---- the mechanism ---- */

/* Computes a quaternion that rotates the z axis to n. */
static void orient(const double n[3], double p[4])
{
  double half = sqrt(0.5 * (1.0 + n[2]));
  p[0] = half;
  p[1] = -n[1] / (2.0 * half);
  p[2] = n[0] / (2.0 * half);
  p[3] = 0.0;
}

/* Converts x (3) from ground axes to body axes. If `back` is set, converts x from body axes to
 * ground axes. */
static void turn(const double p[4], const double x[3], bool back, double out[3])
{
  double sign = back ? 1.0 : -1.0;
  const double v[3] = {sign * p[1], sign * p[2], sign * p[3]};
  double t[3] = {v[1] * x[2] - v[2] * x[1], v[2] * x[0] - v[0] * x[2], v[0] * x[1] - v[1] * x[0]};
  double u[3] = {v[1] * t[2] - v[2] * t[1], v[2] * t[0] - v[0] * t[2], v[0] * t[1] - v[1] * t[0]};
  for (int i = 0; i < 3; i++) {
    out[i] = x[i] + 2.0 * (p[0] * t[i] + u[i]);
  }
}

static baum_mechanism *make_disc(const double start[STATE], double rim)
{
  baum_body_id id;
  baum_spatial_body_def body = baum_spatial_body_def_default();
  baum_spatial_rolling_disc_def disc = baum_spatial_rolling_disc_def_default();
  baum_mechanism *m = create_mechanism();
  body.name = "disc";
  body.mass = MASS;
  body.inertia[0] = body.inertia[1] = TRANSVERSE;
  body.inertia[2] = AXIAL;
  memcpy(body.position, start + 6, sizeof body.position);
  body.position[1] = rim + (RADIUS - rim) * sqrt(1.0 - start[1] * start[1]);
  orient(start, body.orientation);
  turn(body.orientation, start + 3, false, body.angular_velocity);
  check(baum_mechanism_add_spatial_body(m, &body, &id));
  disc.name = "contact";
  disc.body_b = id;
  disc.radius = RADIUS;
  disc.rim_radius = rim;
  check(baum_mechanism_add_spatial_rolling_disc(m, &disc, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

/* Returns the largest difference between the state of a run and a state of the reduced equations.
 * The height of the centre is not compared. */
static double difference_from(const baum_simulation *run, const double want[STATE])
{
  const double z[3] = {0.0, 0.0, 1.0};
  const double *q = baum_simulation_q(run);
  double n[3], w[3];
  turn(q + 3, z, true, n);
  turn(q + 3, baum_simulation_v(run) + 3, true, w);
  double largest = fmax(fabs(q[0] - want[6]), fabs(q[2] - want[8]));
  for (int i = 0; i < 3; i++) {
    largest = fmax(largest, fmax(fabs(n[i] - want[i]), fabs(w[i] - want[3 + i])));
  }
  return largest;
}

static baum_simulation *create(const baum_mechanism *m, double rtol)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = rtol;
  return create_run(m, &options);
}

/* ---- general motion ---- */

static const double GENERAL[STATE] = {0.8, 0.36, 0.48, 5.0, -0.4, 4.5, 0.3, 0.0, -0.2};

static void general_motion_follows_the_reduced_equations(void **state)
{
  (void)state;
  enum { LEGS = 2, STEPS = 8000 };
  static const double rims[LEGS] = {0.0, 0.1};
  for (int k = 0; k < LEGS; k++) {
    double want[STATE], coarse[STATE];
    reduce(GENERAL, 10.0, STEPS, rims[k], want);
    reduce(GENERAL, 10.0, STEPS / 2, rims[k], coarse);
    baum_mechanism *m = make_disc(GENERAL, rims[k]);
    baum_simulation *run = create(m, 1e-12);
    check(baum_simulation_advance_to(run, 10.0));
    baum_counters counters = counters_of(run);
    /* the error of `coarse` is 32 times that of `want` */
    ASSERT_NEAR(difference_from(run, coarse), 0.0, 0.0, 1e-8);
    ASSERT_NEAR(difference_from(run, want), 0.0, 0.0, 1e-9);
    assert_true(fabs(want[6] - GENERAL[6]) + fabs(want[8] - GENERAL[8]) > 0.5);
    assert_true(fabs(counters.energy_change) <= 1e-9);
    assert_true(counters.max_phi <= 1e-14); /* rounding, after projection */
    assert_true(counters.max_phi_rate <= 3e-14);
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

/* ---- every method ---- */

static double allowed(step_mode mode, baum_formulation formulation)
{
  static const double by_order[] = {2e-4, 1.0, 1e-3, 1e-5, 1e-6, 1e-8, 1e-9, 1e-9, 1e-9};
  if (formulation == BAUM_FORMULATION_INDEX3) {
    return 1e-2;
  }
  double wide_limit = step_mode_is_adams(mode) ? 300.0 : 1.0;
  return wide_limit * by_order[mode.fixed ? baum_integrator_order(mode.integrator) : 0];
}

static void roll(const baum_mechanism *m, step_mode mode, baum_formulation formulation,
                 const double want[STATE])
{
  baum_simulation_options options = step_mode_options(mode, 1e-3, 1e-8);
  options.formulation = formulation;
  baum_simulation *run = create_run(m, &options);
  check(step_mode_advance(mode, run, 1.0));
  double error = difference_from(run, want);
  if (!(error <= allowed(mode, formulation))) {
    fail_msg("%s, %s, %s: off by %.3g", baum_integrator_name(mode.integrator),
             mode.fixed ? "fixed step" : "variable step", baum_formulation_name(formulation),
             error);
  }
  baum_simulation_destroy(run);
}

static void every_method_rolls_the_disc(void **state)
{
  (void)state;
  double want[STATE];
  int tried = 0;
  reduce(GENERAL, 1.0, 1000, 0.0, want);
  baum_mechanism *m = make_disc(GENERAL, 0.0);
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    for (int f = BAUM_FORMULATION_DEFAULT + 1; baum_formulation_name((baum_formulation)f); f++) {
      if (baum_integrator_offers(mode.integrator, (baum_formulation)f) &&
          mode.integrator != baum_rattle()) {
        roll(m, mode, (baum_formulation)f, want);
        tried++;
      }
    }
  }
  assert_true(tried >= 20);
  baum_mechanism_destroy(m);
}

static void a_disc_has_5_position_and_3_velocity_degrees_of_freedom(void **state)
{
  (void)state;
  baum_mobility mobility;
  baum_mechanism *m = make_disc(GENERAL, 0.0);
  check(baum_mechanism_mobility(m, &mobility, sizeof mobility));
  assert_int_equal(mobility.degrees_of_freedom, 3);
  assert_int_equal(mobility.position_degrees_of_freedom, 5);
  baum_mechanism_destroy(m);
}

/* ---- a ball on a turntable ---- */

/* If a plane rotates with the constant angular velocity W, a homogeneous ball that rolls on it
 * moves on a circle with the angular velocity 2 W / 7 (S. Earnshaw, Dynamics, 1844). */
static void a_ball_on_a_turntable_moves_on_a_circle(void **state)
{
  (void)state;
  const double rate = 2.1;
  const double r = 0.1;
  const double speed[2] = {0.3, -0.2};
  baum_body_id table, ball;
  baum_joint_id axle;
  baum_spatial_body_def plate = baum_spatial_body_def_default();
  baum_spatial_body_def sphere = baum_spatial_body_def_default();
  baum_spatial_revolute_def bearing = baum_spatial_revolute_def_default();
  baum_driver_def motor = baum_driver_def_default();
  baum_spatial_rolling_disc_def contact = baum_spatial_rolling_disc_def_default();
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_add_spatial_body(m, &plate, &table));
  sphere.mass = 0.7;
  sphere.inertia[0] = sphere.inertia[1] = sphere.inertia[2] = 0.4 * sphere.mass * r * r;
  sphere.position[0] = 0.4;
  sphere.position[1] = r;
  sphere.velocity[0] = speed[0];
  sphere.velocity[2] = speed[1];
  sphere.angular_velocity[1] = 0.5;
  check(baum_mechanism_add_spatial_body(m, &sphere, &ball));
  bearing.body_a = BAUM_GROUND;
  bearing.body_b = table;
  memset(bearing.point, 0, sizeof bearing.point);
  bearing.axis[1] = 1.0;
  bearing.axis[2] = 0.0;
  check(baum_mechanism_add_spatial_revolute(m, &bearing, &axle));
  motor.joint = axle;
  motor.rate = rate;
  check(baum_mechanism_add_driver(m, &motor, NULL));
  contact.body_a = table;
  contact.body_b = ball;
  contact.radius = contact.rim_radius = r;
  check(baum_mechanism_add_spatial_rolling_disc(m, &contact, NULL));
  check(baum_mechanism_freeze(m));
  baum_simulation *run = create(m, 1e-11);
  const double own = 2.0 * rate / 7.0;
  for (int k = 1; k <= 8; k++) {
    double t = k;
    double c = cos(own * t);
    double s = sin(own * t);
    check(baum_simulation_advance_to(run, t));
    const double *at = baum_simulation_q(run) + 7;
    /* the velocity of the ball rotates about y with the angular velocity `own` */
    ASSERT_NEAR(at[0], 0.4 + (s * speed[0] + (1.0 - c) * speed[1]) / own, 0.0, 1e-9);
    ASSERT_NEAR(at[2], (s * speed[1] - (1.0 - c) * speed[0]) / own, 0.0, 1e-9);
    ASSERT_NEAR(at[1], r, 0.0, 1e-14);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(general_motion_follows_the_reduced_equations),
    cmocka_unit_test(every_method_rolls_the_disc),
    cmocka_unit_test(a_disc_has_5_position_and_3_velocity_degrees_of_freedom),
    cmocka_unit_test(a_ball_on_a_turntable_moves_on_a_circle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
