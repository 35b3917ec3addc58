/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests RATTLE for rigid bodies in space: its order, its symmetry, the quantities that it
 * conserves, and its solvers. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "rotation.h"
#include "runs.h"
#include "spatial_scenes.h"

/* ---- mechanisms ---- */

/* [rad/s] Angular velocity with which the gyroscope of build_gyroscope() precesses. Its axis is
 * horizontal, so that this angular velocity is m g a / (I w), with the mass m = 2 kg, the arm a =
 * 0.1 m, the axial moment of inertia I = 0.02 kg m^2 and the spin w = 300 rad/s. */
static const double PRECESSION = 2.0 * 9.81 * 0.1 / (0.02 * 300.0);

/* A heavy top on a spherical joint at the origin. */
static const double MASS = 1.2;
static const double INERTIA[6] = {0.3, 0.5, 0.4, 0.05, -0.03, 0.02};
/* The vector from the centre of mass to the joint, in body axes. */
static const double ARM[3] = {0.1, -0.2, -0.6};
static const double START_P[4] = {0.6, 0.0, 0.8, 0.0};
static const double START_W[3] = {2.0, -1.0, 6.0};

enum { TOP_NQ = 7, TOP_NV = 6 };

/* Computes the state of the top from its orientation and angular velocity. */
static void place_top(const double p[4], const double w[3], double q[TOP_NQ], double v[TOP_NV])
{
  double swing[3];
  rotate(p, ARM, q);
  cross(ARM, w, swing);
  rotate(p, swing, v);
  for (int i = 0; i < 3; i++) {
    q[i] = -q[i];
    v[3 + i] = w[i];
  }
  memcpy(q + 3, p, 4 * sizeof *q);
}

static void build_top(baum_mechanism *m)
{
  baum_spatial_body_def def = baum_spatial_body_def_default();
  baum_spatial_spherical_def joint = baum_spatial_spherical_def_default();
  double q[TOP_NQ];
  double v[TOP_NV];
  place_top(START_P, START_W, q, v);
  def.mass = MASS;
  memcpy(def.inertia, INERTIA, sizeof INERTIA);
  memcpy(def.position, q, sizeof def.position);
  memcpy(def.orientation, START_P, sizeof START_P);
  memcpy(def.angular_velocity, START_W, sizeof START_W);
  joint.body_a = BAUM_GROUND;
  memset(joint.point, 0, sizeof joint.point);
  check(baum_mechanism_add_spatial_body(m, &def, &joint.body_b));
  check(baum_mechanism_add_spatial_spherical(m, &joint, NULL));
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -9.81));
}

typedef void build_fn(baum_mechanism *m);

static baum_mechanism *make(build_fn *build)
{
  baum_mechanism *m = create_mechanism();
  build(m);
  check(baum_mechanism_freeze(m));
  return m;
}

static baum_simulation *start(build_fn *build, const baum_integrator *integrator, double step)
{
  baum_mechanism *m = make(build);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.step = step;
  baum_simulation *run = create_run(m, &options);
  baum_mechanism_destroy(m);
  return run;
}

static double apart(const double *a, const double *b, int count)
{
  double largest = 0.0;
  for (int i = 0; i < count; i++) {
    largest = fmax(largest, fabs(a[i] - b[i]));
  }
  return largest;
}

/* ---- accuracy ---- */

static double error_at(build_fn *build, int nq, const double *want, double step)
{
  baum_simulation *run = start(build, baum_rattle(), step);
  check(baum_simulation_advance_to(run, 0.5));
  double error = apart(baum_simulation_q(run), want, nq);
  baum_counters c = counters_of(run);
  /* The limits allow for rounding errors of coordinates below 1 m, and of velocities below 20
   * rad/s. */
  assert_true(c.max_phi <= 4e-15);
  assert_true(c.max_phi_rate <= 2e-13);

  baum_simulation_destroy(run);
  return error;
}

static void check_order(const char *name, build_fn *build, int nq)
{
  double want[SPATIAL_RSSR_NQ];
  double error[3];
  baum_simulation *run = start(build, baum_rk8(), 1e-3);
  check(baum_simulation_advance_to(run, 0.5));
  memcpy(want, baum_simulation_q(run), (size_t)nq * sizeof *want);
  baum_simulation_destroy(run);
  for (int k = 0; k < 3; k++) {
    error[k] = error_at(build, nq, want, 2e-3 / (1 << k));
  }
  print_message("%s: errors %.3g, %.3g, %.3g\n", name, error[0], error[1], error[2]);
  ASSERT_NEAR(log2(error[0] / error[2]) / 2.0, 2.0, 0.0, 0.02);
}

static void the_order_is_two_and_constraints_hold_to_rounding(void **state)
{
  (void)state;
  check_order("heavy top", build_top, TOP_NQ);
  check_order("RSSR", spatial_build_rssr, SPATIAL_RSSR_NQ);
}

/* ---- symmetry ---- */

/* RATTLE is symmetric. If the velocities are reversed after some steps, the same number of steps
 * must lead back to the start, except for rounding. */
static void check_reversal(build_fn *build, int nq, int nv)
{
  double q[2][SPATIAL_RSSR_NQ];
  double v[SPATIAL_RSSR_NV];
  baum_simulation *run = start(build, baum_rattle(), 2e-3);
  memcpy(q[0], baum_simulation_q(run), (size_t)nq * sizeof **q);
  check(baum_simulation_step(run, 500));
  assert_true(apart(baum_simulation_q(run), q[0], nq) > 0.1);
  memcpy(q[1], baum_simulation_q(run), (size_t)nq * sizeof **q);
  for (int i = 0; i < nv; i++) {
    v[i] = -baum_simulation_v(run)[i];
  }
  check(baum_simulation_set_state(run, 0.0, q[1], v));
  check(baum_simulation_step(run, 500));
  double back = apart(baum_simulation_q(run), q[0], nq);
  print_message("distance from the start after going back: %.2g\n", back);
  assert_true(back <= 1e-11);
  baum_simulation_destroy(run);
}

static void reversed_velocities_lead_back_to_the_start(void **state)
{
  (void)state;
  check_reversal(build_top, TOP_NQ, TOP_NV);
  check_reversal(spatial_build_rssr, SPATIAL_RSSR_NQ, SPATIAL_RSSR_NV);
}

/* ---- the symplectic form ---- */

/* A variation of the state. It consists of a displacement eta of the orientation, and of a change m
 * of the angular momentum about the joint. Both are in body axes. */
typedef struct variation {
  double eta[3];
  double m[3];
} variation;

/* Returns the symplectic form of two variations, eta_1 . m_2 - eta_2 . m_1 + m . (eta_1 x eta_2).
 * Here m is the angular momentum of the state that is varied. */
static double form_of(const double m[3], const variation *a, const variation *b)
{
  double turned[3];
  double sum = 0.0;
  cross(a->eta, b->eta, turned);
  for (int i = 0; i < 3; i++) {
    sum += a->eta[i] * b->m[i] - b->eta[i] * a->m[i] + m[i] * turned[i];
  }
  return sum;
}

/* Computes the angular momentum about the joint, in body axes. */
static void momentum_of(const double w[3], double out[3])
{
  static const int places[9] = {0, 3, 4, 3, 1, 5, 4, 5, 2};
  double swing[3];
  double arm[3];
  cross(ARM, w, swing);
  cross(swing, ARM, arm); /* this is w (s . s) - s (s . w) with s = ARM */
  for (int i = 0; i < 3; i++) {
    out[i] = MASS * arm[i];
    for (int j = 0; j < 3; j++) {
      out[i] += INERTIA[places[3 * i + j]] * w[j];
    }
  }
}

/* Computes the coordinates and the angular momentum of the top after 40 steps, which are 2 s. */
static void map_top(baum_simulation *run, const double p[4], const double w[3], double q[TOP_NQ],
                    double m[3])
{
  double v[TOP_NV];
  place_top(p, w, q, v);
  check(baum_simulation_set_state(run, 0.0, q, v));
  check(baum_simulation_step(run, 40));
  memcpy(q, baum_simulation_q(run), TOP_NQ * sizeof *q);
  momentum_of(baum_simulation_v(run) + 3, m);
}

/* Differentiates map_top() with respect to variable k. The variables 0 to 2 are rotations about the
 * three axes, and the variables 3 to 5 are the angular velocities about them. */
static variation vary_top(baum_simulation *run, int k, double d)
{
  double q[2][TOP_NQ];
  double m[2][3];
  variation out;
  for (int side = 0; side < 2; side++) {
    double p[4];
    double turn[4] = {1.0, 0.0, 0.0, 0.0};
    double w[3];
    memcpy(w, START_W, sizeof w);
    if (k < 3) {
      turn[1 + k] = (side ? 0.5 : -0.5) * d;
    } else {
      w[k - 3] += side ? d : -d;
    }
    quaternion_product(START_P, turn, p);
    quaternion_normalize(p);
    map_top(run, p, w, q[side], m[side]);
  }
  const double back[4] = {q[0][3], -q[0][4], -q[0][5], -q[0][6]};
  double turn[4];
  quaternion_product(back, q[1] + 3, turn);
  for (int i = 0; i < 3; i++) {
    out.eta[i] = copysign(1.0, turn[0]) * turn[1 + i] / d;
    out.m[i] = (m[1][i] - m[0][i]) / (2.0 * d);
  }
  return out;
}

/* Returns by how much map_top() changes the symplectic form. This is the largest change over all
 * pairs of directions. A symplectic method keeps the form. */
static double form_error(const baum_integrator *integrator)
{
  const double d = 1e-4; /* the truncation error is d^2 times third derivatives */
  baum_simulation *run = start(build_top, integrator, 0.05);
  variation from[6];
  variation to[6];
  double m[2][3];
  double q[TOP_NQ];
  double worst = 0.0;
  momentum_of(START_W, m[0]);
  map_top(run, START_P, START_W, q, m[1]);
  for (int k = 0; k < 6; k++) {
    const double axis[3] = {k % 3 == 0, k % 3 == 1, k % 3 == 2};
    memset(&from[k], 0, sizeof from[k]);
    if (k < 3) {
      memcpy(from[k].eta, axis, sizeof axis);
    } else {
      momentum_of(axis, from[k].m);
    }
    to[k] = vary_top(run, k, d);
  }
  for (int k = 0; k < 36; k++) {
    double change =
      form_of(m[1], &to[k / 6], &to[k % 6]) - form_of(m[0], &from[k / 6], &from[k % 6]);
    worst = fmax(worst, fabs(change));
  }
  baum_simulation_destroy(run);
  return worst;
}

static void the_symplectic_form_is_kept(void **state)
{
  (void)state;
  double kept = form_error(baum_rattle());
  double lost = form_error(baum_rk2());
  print_message("the symplectic form changes by %.2g, with rk2 by %.2g\n", kept, lost);
  assert_true(kept <= 1e-5);
  assert_true(lost > 1e-2);
}

/* ---- energy ---- */

typedef struct band {
  double least;
  double most;
} band;

static band energy_band(baum_simulation *run, int steps)
{
  band b = {(double)INFINITY, -(double)INFINITY};
  for (int k = 0; k < steps; k += 7) {
    check(baum_simulation_step(run, 7));
    double change = counters_of(run).energy_change;
    b.least = fmin(b.least, change);
    b.most = fmax(b.most, change);
  }
  return b;
}

static void check_band(const char *name, build_fn *build, double step)
{
  baum_simulation *run = start(build, baum_rattle(), step);
  band first = energy_band(run, 10000);
  check(baum_simulation_step(run, 80000));
  band last = energy_band(run, 10000);
  print_message("%s: energy changes by [%.4e, %.4e] J in the first tenth of 1e5 steps, by [%.4e, "
                "%.4e] J in the last\n",
                name, first.least, first.most, last.least, last.most);
  double width = first.most - first.least;
  ASSERT_NEAR(last.least, first.least, 0.0, 0.05 * width);
  ASSERT_NEAR(last.most, first.most, 0.0, 0.05 * width);
  baum_simulation_destroy(run);
}

static void the_energy_error_of_long_runs_is_bounded(void **state)
{
  (void)state;
  check_band("heavy top", build_top, 5e-3);
  check_band("RSSR", spatial_build_rssr, 1e-3);
}

/* ---- other mechanisms ---- */

/* Returns the definition of an additional body. The body is welded to ground, or it moves
 * freely. */
static baum_spatial_body_def other_body(void)
{
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.inertia[0] = 2.0;
  def.position[0] = 5.0;
  return def;
}

static void build_framed_rssr(baum_mechanism *m)
{
  baum_spatial_fixed_def weld = baum_spatial_fixed_def_default();
  baum_spatial_body_def def = other_body();
  spatial_build_rssr(m);
  check(baum_mechanism_add_spatial_body(m, &def, &weld.body_b));
  weld.body_a = BAUM_GROUND;
  memcpy(weld.point, def.position, sizeof weld.point);
  check(baum_mechanism_add_spatial_fixed(m, &weld, NULL));
}

static void end_of(build_fn *build, baum_solver solver, double *q)
{
  baum_mechanism *m = make(build);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rattle();
  options.step = 2e-3;
  options.solver = solver;
  baum_simulation *run = create_run(m, &options);
  check(baum_simulation_advance_to(run, 0.5));
  memcpy(q, baum_simulation_q(run), SPATIAL_RSSR_NQ * sizeof *q);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static void expect_same_end(build_fn *build, baum_solver solver, const double *want)
{
  double got[SPATIAL_RSSR_NQ];
  end_of(build, solver, got);
  assert_true(apart(got, want, SPATIAL_RSSR_NQ) <= 1e-11);
}

/* Another solver, redundant rows or fixed bodies may change the results only by rounding. The
 * four-bar with parallel axes has three redundant rows. */
static void solvers_redundant_rows_and_fixed_bodies_do_not_change_results(void **state)
{
  (void)state;
  double want[SPATIAL_RSSR_NQ];
  end_of(spatial_build_rssr, BAUM_SOLVER_AUTO, want);
  expect_same_end(build_framed_rssr, BAUM_SOLVER_AUTO, want);
  expect_same_end(build_framed_rssr, BAUM_SOLVER_BLOCK, want);
  expect_same_end(build_framed_rssr, BAUM_SOLVER_KLU, want);
  expect_same_end(build_framed_rssr, BAUM_SOLVER_QR, want);
  end_of(spatial_build_four_bar, BAUM_SOLVER_AUTO, want);
  expect_same_end(spatial_build_four_bar, BAUM_SOLVER_KLU, want);
}

/* Makes the top and a free ball, which has no gyroscopic moment. Neither body may affect the motion
 * of the other. */
static void build_top_and_ball(baum_mechanism *m)
{
  baum_spatial_body_def ball = other_body();
  ball.inertia[0] = 1.0;
  for (int i = 0; i < 3; i++) {
    ball.velocity[i] = 1.0 + i;
    ball.angular_velocity[i] = 3.0 - i;
  }
  build_top(m);
  check(baum_mechanism_add_spatial_body(m, &ball, NULL));
}

static void bodies_with_and_without_gyroscopic_moments_do_not_interact(void **state)
{
  (void)state;
  baum_simulation *run = start(build_top_and_ball, baum_rattle(), 2e-3);
  baum_simulation *alone = start(build_top, baum_rattle(), 2e-3);
  check(baum_simulation_step(run, 500));
  check(baum_simulation_step(alone, 500));
  assert_true(apart(baum_simulation_q(run), baum_simulation_q(alone), TOP_NQ) <= 1e-13);
  const double *v = baum_simulation_v(run) + TOP_NV;
  for (int i = 0; i < 3; i++) {
    ASSERT_NEAR(v[i], 1.0 + i - (i == 2 ? 9.81 : 0.0), 0.0, 1e-13);
    assert_true(v[3 + i] == 3.0 - i);
  }
  baum_simulation_destroy(run);
  baum_simulation_destroy(alone);
}

/* Makes a disc with a horizontal axis. It rotates about this axis by 17 degrees per step, and
 * precesses at 0.33 rad/s. */
static void build_gyroscope(baum_mechanism *m)
{
  baum_spatial_body_def def = baum_spatial_body_def_default();
  baum_spatial_spherical_def joint = baum_spatial_spherical_def_default();
  def.mass = 2.0;
  def.inertia[0] = 0.02;
  def.inertia[1] = def.inertia[2] = 0.01;
  def.position[0] = 0.1;
  def.angular_velocity[0] = 300.0;
  def.angular_velocity[1] = 0.0;
  def.angular_velocity[2] = PRECESSION;
  joint.body_a = BAUM_GROUND;
  memset(joint.point, 0, sizeof joint.point);
  check(baum_mechanism_add_spatial_body(m, &def, &joint.body_b));
  check(baum_mechanism_add_spatial_spherical(m, &joint, NULL));
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -9.81));
}

static void fast_gyroscopes_precess_steadily(void **state)
{
  (void)state;
  baum_simulation *run = start(build_gyroscope, baum_rattle(), 1e-3);
  check(baum_simulation_advance_to(run, 2.0));
  const double *q = baum_simulation_q(run);
  double off = atan2(q[1], q[0]) - 2.0 * PRECESSION;
  print_message("the gyroscope is off by %.2g rad and sinks by %.2g m\n", off, -q[2]);
  assert_true(fabs(off) <= 2e-5 && fabs(q[2]) <= 1e-6);
  baum_simulation_destroy(run);
}

/* ---- energy account ---- */

static double residual_at(double step)
{
  baum_mechanism *m = make(spatial_build_rssr);
  baum_energy_account account;
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rattle();
  options.step = step;
  options.energy_account = true;
  baum_simulation *run = create_run(m, &options);
  check(baum_simulation_advance_to(run, 0.5));
  check(baum_simulation_energy_account(run, &account, sizeof account));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  return fabs(account.residual);
}

static void the_energy_residual_falls_with_the_order(void **state)
{
  (void)state;
  double residual[2] = {residual_at(2e-3), residual_at(1e-3)};
  print_message("residuals of the account: %.3g, %.3g J\n", residual[0], residual[1]);
  ASSERT_NEAR(log2(residual[0] / residual[1]), 2.0, 0.0, 0.3);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_order_is_two_and_constraints_hold_to_rounding),
    cmocka_unit_test(reversed_velocities_lead_back_to_the_start),
    cmocka_unit_test(the_symplectic_form_is_kept),
    cmocka_unit_test(the_energy_error_of_long_runs_is_bounded),
    cmocka_unit_test(solvers_redundant_rows_and_fixed_bodies_do_not_change_results),
    cmocka_unit_test(bodies_with_and_without_gyroscopic_moments_do_not_interact),
    cmocka_unit_test(fast_gyroscopes_precess_steadily),
    cmocka_unit_test(the_energy_residual_falls_with_the_order),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
