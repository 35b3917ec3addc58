/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares mechanisms of the catalogue with values and laws that do not use their references: the
 * closed inverse kinematics of the Stewart platform, the ratio of a differential, Newton's solution
 * for a wishbone suspension, and the momenta of a gyroscope and of a quadruped. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>
#include <baum/catalog.h>

#include "check.h"
#include "double_wishbone_reference.h"
#include "rotation.h"
#include "runs.h"
#include "step_mode.h"

enum { Q = 7, V = 6 }; /* coordinates and velocities of a body */

static baum_mechanism *build(const char *name)
{
  baum_mechanism *m = NULL;
  check(baum_catalog_build(&(baum_catalog_choice){.name = name}, &m));
  return m;
}

static baum_simulation *start(const baum_mechanism *m, const baum_integrator *integrator)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.rtol = integrator == baum_kinematics() ? o.rtol : 1e-11; /* kinematics has no tolerance */
  return create_run(m, &o);
}

static double largest(const double *a, const double *b, int count)
{
  double most = 0.0;
  for (int i = 0; i < count; i++) {
    most = fmax(most, fabs(a[i] - b[i]));
  }
  return most;
}

/* ---- Stewart platform ---- */

enum { LEGS = 6, STEWART_Q = Q * (1 + 2 * LEGS), STEWART_V = V * (1 + 2 * LEGS) };

/* Solves the inverse kinematics: computes the lengths of the legs from the pose of the platform. */
static void find_lengths(const double *platform, double length[LEGS])
{
  static const double foot[LEGS] = {-0.3, 0.3, 1.7944, 2.3944, 3.8888, 4.4888};
  static const double ball[LEGS] = {-0.7972, 0.7972, 1.2972, 2.8916, 3.3916, 4.986};
  for (int k = 0; k < LEGS; k++) {
    const double b[3] = {0.6 * cos(ball[k]), 0.6 * sin(ball[k]), 0.0};
    double d[3];
    rotate(platform + 3, b, d);
    d[0] += platform[0] - cos(foot[k]);
    d[1] += platform[1] - sin(foot[k]);
    length[k] = sqrt(d[0] * d[0] + d[1] * d[1] + (d[2] + platform[2]) * (d[2] + platform[2]));
  }
}

/* Computes the pose of the platform at a time from its given motion. */
static void find_platform(double t, double pose[Q])
{
  const double a = 0.1 + 0.2 * sin(2.5 * t);
  const double b = 0.15 - 0.2 * sin(3.5 * t);
  const double c = 0.1 - 0.1 * cos(3.0 * t);
  const double about_z[4] = {cos(a / 2), 0.0, 0.0, sin(a / 2)};
  const double about_x[4] = {cos(b / 2), sin(b / 2), 0.0, 0.0};
  const double about_y[4] = {cos(c / 2), 0.0, sin(c / 2), 0.0};
  double first[4];
  quaternion_product(about_z, about_x, first);
  quaternion_product(first, about_y, pose + 3);
  pose[0] = 0.05 + 0.1 * sin(3.0 * t);
  pose[1] = -0.1 + 0.1 * sin(2.0 * t);
  pose[2] = 1.0 - 0.1 * sin(4.0 * t);
}

/* Reads the elongations of the legs from the library. */
static void read_legs(baum_simulation *run, const baum_mechanism *m, double out[LEGS])
{
  static const char *const names[LEGS] = {"leg 1", "leg 2", "leg 3", "leg 4", "leg 5", "leg 6"};
  for (int k = 0; k < LEGS; k++) {
    const baum_channel channel =
      baum_channel_of_joint(BAUM_JOINT_COORDINATE, baum_mechanism_find_joint(m, names[k]));
    double both[2];
    check(baum_simulation_get(run, &channel, 1, both));
    out[k] = both[0];
  }
}

static void the_lengths_of_the_legs_follow_from_the_pose(void **state)
{
  (void)state;
  baum_mechanism *m = build("stewart");
  baum_simulation *run = start(m, baum_kinematics());
  double at_start[LEGS];
  double inverse = 0.0;
  double forward = 0.0;
  double pose[Q];
  find_platform(0.0, pose);
  find_lengths(pose, at_start);
  for (int i = 1; i <= 40; i++) {
    double want[LEGS];
    double got[LEGS];
    check(baum_simulation_advance_to(run, 0.05 * i));
    find_platform(0.05 * i, pose);
    find_lengths(pose, want);
    read_legs(run, m, got);
    for (int k = 0; k < LEGS; k++) {
      inverse = fmax(inverse, fabs(at_start[k] + got[k] - want[k]));
    }
    forward = fmax(forward, largest(baum_simulation_q(run), pose, Q));
  }
  print_message("inverse kinematics %.1e m, forward along the motion %.1e\n", inverse, forward);
  assert_true(inverse <= 1e-12 && forward <= 1e-12);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static double random_number(uint64_t *seed)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(*seed >> 11) * 0x1p-52 - 1.0; /* from -1 to 1 */
}

/* Returns the largest difference between the lengths of the legs and the lengths that the drivers
 * prescribe at time t. */
static double length_error(double t, const double *q)
{
  double pose[Q];
  double want[LEGS];
  double got[LEGS];
  find_platform(t, pose);
  find_lengths(pose, want);
  find_lengths(q, got);
  return largest(got, want, LEGS);
}

/* For each start, every body gets a different wrong pose, and the lengths of the legs are
 * prescribed for a different time of the given motion. Assembly must find a pose of the platform
 * with these lengths. There are several such poses. Assembly nearly always finds the pose of the
 * given motion. */
static void assembly_solves_the_forward_kinematics_from_100_starts(void **state)
{
  (void)state;
  enum { STARTS = 100 };
  baum_mechanism *m = build("stewart");
  baum_workspace *w = NULL;
  uint64_t seed = 1;
  double worst = 0.0;
  int same = 0;
  check(baum_workspace_create(m, &w));
  for (int i = 0; i < STARTS; i++) {
    double q[STEWART_Q];
    double v[STEWART_V];
    double off[STEWART_V];
    double pose[Q];
    double t = 1.0 + random_number(&seed);
    check(baum_workspace_design(w, q, v));
    for (int k = 0; k < STEWART_V; k++) {
      off[k] = (k % V < 3 ? 0.2 : 0.5) * random_number(&seed); /* m, rad */
      v[k] = (double)NAN;
    }
    check(baum_workspace_move(w, off, q));
    assert_true(length_error(t, q) > 1e-3);
    check(baum_workspace_assemble(w, t, q, v, NULL, 0));
    worst = fmax(worst, length_error(t, q));
    find_platform(t, pose);
    if (largest(q, pose, 3) < 1e-11) {
      same++;
    } else {
      assert_true(largest(q, pose, 3) > 1e-2); /* it is another pose, not an inaccurate one */
    }
  }
  print_message("forward kinematics from %d starts: lengths %.1e m, pose of the motion %d times\n",
                STARTS, worst, same);
  assert_true(worst <= 1e-12);
  assert_true(same >= 95);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

/* ---- differential ---- */

/* Returns the difference between the mean of the wheels' speeds and the speed of the carrier. */
static double ratio_error(const baum_simulation *run)
{
  const double *v = baum_simulation_v(run);
  return fabs((v[V + 3] + v[2 * V + 3]) / 2 - v[3]);
}

static void the_mean_speed_of_the_wheels_equals_the_speed_of_the_carrier(void **state)
{
  (void)state;
  baum_mechanism *m = build("differential");
  double worst = 0.0;
  int tried = 0;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    const step_mode mode = step_mode_at(k);
    baum_simulation_options o = step_mode_options(mode, 1e-3, 1e-8);
    o.formulation = BAUM_FORMULATION_PROJECTION;
    if (!baum_integrator_offers(mode.integrator, o.formulation)) {
      continue;
    }
    baum_simulation *run = create_run(m, &o);
    for (int i = 1; i <= 10; i++) {
      check(baum_simulation_advance_to(run, 0.1 * i));
      worst = fmax(worst, ratio_error(run));
    }
    const double *v = baum_simulation_v(run);
    assert_true(v[2 * V + 3] - v[V + 3] > 1.0); /* the wheels rotate at different speeds */
    tried++;
    baum_simulation_destroy(run);
  }
  print_message("differential: %.1e rad/s with %d methods\n", worst, tried);
  assert_true(tried >= 8 && worst <= 1e-13);
  baum_mechanism_destroy(m);
}

/* ---- suspension ---- */

static void the_wheel_follows_newtons_solution(void **state)
{
  (void)state;
  static const double y[3] = {0.0, 1.0, 0.0};
  baum_mechanism *m = build("double_wishbone");
  baum_simulation *run = start(m, baum_kinematics());
  const int upright = 2;
  double design[4];
  double worst = 0.0;
  double back[3];
  memcpy(design, baum_simulation_q(run) + upright * Q + 3, sizeof design);
  design[0] = -design[0]; /* the inverse */
  rotate(design, y, back);
  for (int i = 0; i < DOUBLE_WISHBONE_SAMPLES; i++) {
    if (i > 0) {
      check(baum_simulation_advance_to(run, DOUBLE_WISHBONE_T[i]));
    }
    const double *q = baum_simulation_q(run) + upright * Q;
    double axis[3];
    rotate(q + 3, back, axis);
    const double got[4] = {asin(axis[2]), atan2(axis[0], axis[1]), q[0], q[1]};
    worst = fmax(worst, largest(got, DOUBLE_WISHBONE_Q[i], DOUBLE_WISHBONE_WIDTH));
  }
  print_message("double wishbone: axis and path %.1e rad or m\n", worst);
  assert_true(worst <= 1e-13);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* ---- momenta ---- */

typedef struct momenta {
  double mass;
  double centre[3];
  double linear[3];
  double angular[3]; /* about the origin */
  double kinetic;
} momenta;

static momenta find_momenta(const baum_mechanism *m, const double *q, const double *v)
{
  momenta sum = {0};
  for (int32_t k = 0; k < baum_mechanism_body_count(m); k++) {
    const double *qk = q + k * Q;
    const double *vk = v + k * V;
    baum_spatial_body_def def;
    double spin[3], own[3], orbit[3];
    check(baum_mechanism_get_spatial_body(m, baum_mechanism_body_at(m, k), &def, sizeof def));
    for (int i = 0; i < 3; i++) {
      spin[i] = def.inertia[i] * vk[3 + i];
      sum.kinetic += 0.5 * (def.mass * vk[i] * vk[i] + spin[i] * vk[3 + i]);
    }
    rotate(qk + 3, spin, own);
    cross(qk, vk, orbit);
    sum.mass += def.mass;
    for (int i = 0; i < 3; i++) {
      sum.centre[i] += def.mass * qk[i];
      sum.linear[i] += def.mass * vk[i];
      sum.angular[i] += own[i] + def.mass * orbit[i];
    }
  }
  for (int i = 0; i < 3; i++) {
    sum.centre[i] /= sum.mass;
  }
  return sum;
}

/* Only gravity acts on the quadruped. */
static void the_quadruped_keeps_its_momenta(void **state)
{
  (void)state;
  const double gravity = 9.81;
  baum_mechanism *m = build("quadruped");
  baum_simulation *run = start(m, baum_rk8());
  const momenta a = find_momenta(m, baum_simulation_q(run), baum_simulation_v(run));
  double spin[3];
  double worst[3] = {0.0, 0.0, 0.0};
  cross(a.centre, a.linear, spin);
  for (int i = 0; i < 3; i++) {
    spin[i] = a.angular[i] - spin[i];
  }
  double before = a.kinetic + a.mass * gravity * a.centre[2];
  for (int n = 1; n <= 10; n++) {
    const double t = 0.1 * n;
    check(baum_simulation_advance_to(run, t));
    const momenta b = find_momenta(m, baum_simulation_q(run), baum_simulation_v(run));
    double orbit[3];
    cross(b.centre, b.linear, orbit);
    for (int i = 0; i < 3; i++) {
      double fall = i == 2 ? -gravity * t * t / 2 : 0.0;
      double path = a.centre[i] + a.linear[i] / a.mass * t + fall;
      worst[0] = fmax(worst[0], fabs(b.centre[i] - path));
      worst[1] = fmax(worst[1], fabs(b.angular[i] - orbit[i] - spin[i]));
    }
    worst[2] = fmax(worst[2], fabs(b.kinetic + b.mass * gravity * b.centre[2] - before));
  }
  print_message(
    "quadruped: path %.1e m, angular momentum %.1e N m s of %.2g, energy %.1e J of %.3g\n",
    worst[0], worst[1], fabs(spin[1]), worst[2], before);
  assert_true(worst[0] <= 1e-11 && worst[1] <= 1e-11 && worst[2] <= 1e-9);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* The spin of the rotor is half of that in the catalogue, so that the axis of the gyroscope nods
 * and its precession varies. Gravity does not change the angular momentum about z, and no torque
 * acts on the rotor about its axis. */
static void a_nodding_gyroscope_keeps_its_momenta_and_its_energy(void **state)
{
  (void)state;
  const int axle = 2 * V + 4; /* angular velocity of the rotor about its axis */
  const double gravity = 9.81;
  baum_mechanism *m = build("gimbals");
  baum_simulation *run = start(m, baum_rk8());
  double q[3 * Q];
  double v[3 * V];
  memcpy(q, baum_simulation_q(run), sizeof q);
  memcpy(v, baum_simulation_v(run), sizeof v);
  v[axle] *= 0.5;
  check(baum_simulation_set_state(run, 0.0, q, v));
  const momenta a = find_momenta(m, q, v);
  double level[2] = {q[Q + 2], q[Q + 2]}; /* heights of the weight */
  double worst[3] = {0.0, 0.0, 0.0};
  double before = a.kinetic + a.mass * gravity * a.centre[2];
  for (int n = 1; n <= 100; n++) {
    check(baum_simulation_advance_to(run, 0.05 * n));
    const double *at = baum_simulation_q(run);
    const momenta b = find_momenta(m, at, baum_simulation_v(run));
    worst[0] = fmax(worst[0], fabs(b.angular[2] / a.angular[2] - 1.0));
    worst[1] = fmax(worst[1], fabs(baum_simulation_v(run)[axle] / v[axle] - 1.0));
    worst[2] = fmax(worst[2], fabs((b.kinetic + b.mass * gravity * b.centre[2]) / before - 1.0));
    level[0] = fmin(level[0], at[Q + 2]);
    level[1] = fmax(level[1], at[Q + 2]);
  }
  print_message(
    "gimbals: momentum about z %.1e, spin %.1e, energy %.1e; the weight moves by %.2g m\n",
    worst[0], worst[1], worst[2], level[1] - level[0]);
  assert_true(worst[0] <= 5e-10 && worst[1] <= 5e-10 && worst[2] <= 5e-10);
  assert_true(level[1] - level[0] > 5e-3);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_lengths_of_the_legs_follow_from_the_pose),
    cmocka_unit_test(assembly_solves_the_forward_kinematics_from_100_starts),
    cmocka_unit_test(the_mean_speed_of_the_wheels_equals_the_speed_of_the_carrier),
    cmocka_unit_test(the_wheel_follows_newtons_solution),
    cmocka_unit_test(the_quadruped_keeps_its_momenta),
    cmocka_unit_test(a_nodding_gyroscope_keeps_its_momenta_and_its_energy),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
