/* SPDX-License-Identifier: BSD-3-Clause */
/* A body rotates without torques for a thousand revolutions. Its motion is compared with a Taylor
 * series solution of Euler's equations in long double:
 *
 *   I w' = (I w) x w,   p' = p o (0, w) / 2
 *
 * Here w is the angular velocity in body axes, and p is the quaternion of the orientation. The
 * energy and the angular momentum of the body must be constant.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "check.h"
#include "construct.h"
#include "rotation.h"
#include "runs.h"

/* The body rotates almost about its middle principal axis. Rotation about this axis is unstable, so
 * the body tumbles from time to time. It makes about one revolution per second. */
static const double MOMENTS[3] = {1.0, 2.0, 2.7};
static const double P[4] = {0.5, 0.5, -0.5, 0.5};
static const double W[3] = {0.6, 6.2, 0.5};
enum { REVOLUTIONS = 1000 };

/* ---- reference ---- */

/* With these numbers, the last Taylor term of a step is 0.5^40 of a revolution, which is far below
 * rounding. */
enum { TERMS = 40, STEPS_A_SECOND = 16 };

typedef struct series {
  long double w[TERMS + 1][3];
  long double p[TERMS + 1][4];
} series;

/* These two functions return Taylor coefficient n of p_i w_j and of w_i w_j. */
static long double of_p_w(const series *s, int i, int j, int n)
{
  long double sum = 0.0L;
  for (int k = 0; k <= n; k++) {
    sum += s->p[k][i] * s->w[n - k][j];
  }
  return sum;
}

static long double of_w_w(const series *s, int i, int j, int n)
{
  long double sum = 0.0L;
  for (int k = 0; k <= n; k++) {
    sum += s->w[k][i] * s->w[n - k][j];
  }
  return sum;
}

static void extend(series *s, int n)
{
  long double scalar = 0.0L;
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3;
    int k = (i + 2) % 3;
    long double rise = (long double)(n + 1);
    long double apart = (long double)MOMENTS[j] - (long double)MOMENTS[k];
    long double turn = of_p_w(s, 0, i, n) + of_p_w(s, 1 + j, k, n) - of_p_w(s, 1 + k, j, n);
    s->w[n + 1][i] = apart * of_w_w(s, j, k, n) / ((long double)MOMENTS[i] * rise);
    s->p[n + 1][1 + i] = turn / (2.0L * rise);
    scalar -= of_p_w(s, 1 + i, i, n) / (2.0L * rise);
  }
  s->p[n + 1][0] = scalar;
}

static long double sum_at(const long double *terms, int width, long double h)
{
  long double sum = 0.0L;
  for (int n = TERMS; n >= 0; n--) {
    sum = h * sum + terms[n * width];
  }
  return sum;
}

static void reference(int seconds, long double w[3], long double p[4])
{
  const long double h = 1.0L / STEPS_A_SECOND;
  for (int step = 0; step < seconds * STEPS_A_SECOND; step++) {
    series s;
    memcpy(s.w[0], w, sizeof s.w[0]);
    memcpy(s.p[0], p, sizeof s.p[0]);
    for (int n = 0; n < TERMS; n++) {
      extend(&s, n);
    }
    for (int i = 0; i < 4; i++) {
      p[i] = sum_at(&s.p[0][i], 4, h);
      if (i < 3) {
        w[i] = sum_at(&s.w[0][i], 3, h);
      }
    }
  }
}

/* ---- runs ---- */

static baum_mechanism *make_body(void)
{
  baum_spatial_body_def def = baum_spatial_body_def_default();
  static const double velocity[3] = {0.3, -0.2, 0.1};
  memcpy(def.inertia, MOMENTS, sizeof MOMENTS);
  memcpy(def.orientation, P, sizeof P);
  memcpy(def.angular_velocity, W, sizeof W);
  memcpy(def.velocity, velocity, sizeof velocity);
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
  check(baum_mechanism_add_spatial_body(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

static double energy_of(const double w[3])
{
  double sum = 0.0;
  for (int i = 0; i < 3; i++) {
    sum += 0.5 * MOMENTS[i] * w[i] * w[i];
  }
  return sum;
}

static void momentum_of(const double p[4], const double w[3], double out[3])
{
  const double own[3] = {MOMENTS[0] * w[0], MOMENTS[1] * w[1], MOMENTS[2] * w[2]};
  rotate(p, own, out);
}

/* The errors of a run after all revolutions. */
typedef struct errors {
  double angle; /* [rad] */
  double energy;
  double momentum; /* this and `energy` are relative errors */
} errors;

static errors run(const baum_integrator *integrator, double step, double rtol,
                  const long double p[4])
{
  baum_mechanism *m = make_body();
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.step = step;
  o.rtol = rtol;
  baum_simulation *s = create_run(m, &o);
  check(baum_simulation_advance_to(s, REVOLUTIONS));
  const double *q = baum_simulation_q(s);
  const double *v = baum_simulation_v(s);
  double before[3];
  double after[3];
  const double back[4] = {(double)p[0], -(double)p[1], -(double)p[2], -(double)p[3]};
  double apart[4];
  quaternion_product(back, q + 3, apart);
  momentum_of(P, W, before);
  momentum_of(q + 3, v + 3, after);
  errors e = {.energy = fabs(energy_of(v + 3) / energy_of(W) - 1.0)};
  e.angle = 2.0 * sqrt(apart[1] * apart[1] + apart[2] * apart[2] + apart[3] * apart[3]);
  for (int i = 0; i < 3; i++) {
    double size = sqrt(before[0] * before[0] + before[1] * before[1] + before[2] * before[2]);
    e.momentum = fmax(e.momentum, fabs(after[i] - before[i]) / size);
    /* The centre must move in a straight line. */
    assert_true(fabs(q[i] - v[i] * REVOLUTIONS) <= 1e-9);
  }
  baum_simulation_destroy(s);
  baum_mechanism_destroy(m);
  print_message("%s: angle %.2g rad, energy %.2g, momentum %.2g\n",
                baum_integrator_name(integrator), e.angle, e.energy, e.momentum);
  return e;
}

/* ---- tests ---- */

static void find_reference(long double p[4])
{
  long double w[3];
  double energy[3];
  for (int i = 0; i < 4; i++) {
    p[i] = (long double)P[i];
    w[i % 3] = (long double)W[i % 3];
  }
  reference(REVOLUTIONS, w, p);
  for (int i = 0; i < 3; i++) {
    energy[i] = (double)w[i];
  }
  assert_true(fabs(energy_of(energy) / energy_of(W) - 1.0) <= 1e-15);
}

static void rk8_keeps_the_orientation_for_a_thousand_revolutions(void **state)
{
  (void)state;
  long double p[4];
  find_reference(p);
  errors e = run(baum_rk8(), (double)NAN, 1e-13, p);
  assert_true(e.angle <= 1e-8);
  assert_true(e.energy <= 1e-11);
  assert_true(e.momentum <= 1e-11);
}

static void cvode_bdf_keeps_the_orientation_for_a_thousand_revolutions(void **state)
{
  (void)state;
#if BAUM_HAVE_SUNDIALS
  long double p[4];
  find_reference(p);
  errors e = run(baum_cvode_bdf(), (double)NAN, 1e-11, p);
  assert_true(e.angle <= 1e-3);
  assert_true(e.energy <= 1e-6);
  assert_true(e.momentum <= 1e-6);
#else
  skip();
#endif
}

/* RATTLE has order 2. After 100 000 steps of 4 degrees, the error of the orientation is therefore
 * large. Nevertheless, the momentum must be kept to rounding, and the error of the energy must be
 * bounded. */
static void rattle_keeps_the_angular_momentum_to_rounding(void **state)
{
  (void)state;
  long double p[4];
  find_reference(p);
  errors e = run(baum_rattle(), 0.01, (double)NAN, p);
  assert_true(e.energy <= 1e-3);
  assert_true(e.momentum <= 1e-12);
  (void)run(baum_generalized_alpha(), 0.01, (double)NAN, p);
}

/* Euler's equation about the axis of a symmetric body is I w' = 0. Rounding errors of the right
 * side would be divided by the moment of inertia about the axis, which is tiny here. */
static void symmetric_bodies_keep_their_spin(void **state)
{
  (void)state;
  for (int axis = 0; axis < 3; axis++) {
    baum_mechanism *m = create_mechanism();
    baum_workspace *workspace = NULL;
    baum_spatial_body_def def = baum_spatial_body_def_default();
    double q[7];
    double a[6];
    def.inertia[axis] = 1e-8;
    check(baum_mechanism_add_spatial_body(m, &def, NULL));
    check(baum_mechanism_freeze(m));
    check(baum_workspace_create(m, &workspace));
    check(baum_workspace_design(workspace, q, NULL));
    for (int k = 1; k <= 20; k++) {
      const double v[6] = {0.0, 0.0, 0.0, 0.1 * k, 1.0 / k, 0.7};
      check(baum_workspace_acceleration(workspace, 0.0, q, v, 0.0, 0.0, a, NULL));
      assert_true(a[3 + axis] == 0.0);
    }
    baum_workspace_destroy(workspace);
    baum_mechanism_destroy(m);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(symmetric_bodies_keep_their_spin),
    cmocka_unit_test(rk8_keeps_the_orientation_for_a_thousand_revolutions),
    cmocka_unit_test(rattle_keeps_the_angular_momentum_to_rounding),
    cmocka_unit_test(cvode_bdf_keeps_the_orientation_for_a_thousand_revolutions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
