/* SPDX-License-Identifier: BSD-3-Clause */
/* Do mechanisms keep their constraints where baum_stability_at() says so? A pendulum and a free
 * slider-crank start with all rows violated, and a pair of gains is observed to be stable when the
 * largest violation of the last quarter of a run is below that of the first. All pairs of a grid
 * over the plane of (alpha h, beta^2 h^2), both Eulers and RK4.
 *
 * The step: the motion itself keeps up a violation of (alpha h / beta^2 h^2) h^2 |gamma|, which
 * must stay far below the start's. With h omega = 1e-5 it is 1e-10 of the length scale, times 20 in
 * the corner of the grid, against 1e-6.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "physics_run.h"

enum { CELLS = 44, STEPS = 3000, CALM = 32, TAYLOR_STEPS = 400 };

static const double OFF = 1e-6; /* of the length scale, and rad */
/* Times the start's violation: 1e-3 of the scale, hardly still linear. */
static const double GROWN = 1e3;
/* Of the start's violation. A start with Phi' = 0 gives a mode a share of (1 - z1) / (z2 - z1),
 * 1/100 or more here, so that no mode hides below this from the beginning. */
static const double DECAYED = 1e-3;

/* Steps of 1e-5 over omega: 3.1 and 150 rad/s at start. */
static double step_of(physics_mechanism which)
{
  return which == PENDULUM ? 1e-5 / 3.1 : 1e-5 / 150.0;
}

/* Every coordinate moved, no two alike, so that every row is violated. */
static void violate(const watched_run *watched, const baum_mechanism *mechanism)
{
  double q[PHYSICS_NQ];
  double v[PHYSICS_NQ];
  double scale = (double)NAN;
  check(baum_mechanism_get_scale(mechanism, &scale));
  for (int i = 0; i < watched->nq; i++) {
    double unit = watched->nq == PHYSICS_NQ && i % 3 == 2 ? 1.0 : scale;
    q[i] = baum_simulation_q(watched->run)[i] + OFF * unit * cos(2.0 * i);
    v[i] = baum_simulation_v(watched->run)[i];
  }
  check(baum_simulation_set_state(watched->run, 0.0, q, v));
}

/* A run from the violated start; the consistent one is found once by a run that assembles. */
static watched_run start(const model *m, const watched_run *consistent,
                         const baum_integrator *integrator, double step, baum_gains gains)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  options.gains = gains;
  options.allow_unstable = true;
  options.step = step;
  options.start = BAUM_START_AS_GIVEN;
  options.check_derivatives = false;
  watched_run out = watch(m->mechanism, &options);
  check(baum_simulation_set_state(out.run, 0.0, baum_simulation_q(consistent->run),
                                  baum_simulation_v(consistent->run)));
  violate(&out, m->mechanism);
  return out;
}

static watched_run start_consistent(const model *m)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_euler();
  options.step = 1e-5;
  return watch(m->mechanism, &options);
}

/* ---- observed ---- */

/* Whether the last quarter's largest violation is below the first's. Runs that have grown or
 * decayed beyond doubt end early: a violation that swings through zero is no doubt after CALM
 * steps. */
static bool watch_decay(const watched_run *watched)
{
  double phi[PHYSICS_NC];
  double quarter[4] = {0.0};
  watch_phi(watched, phi);
  double first = largest_of(phi, watched->nc);
  int calm = 0;
  for (int k = 0; k < STEPS; k++) {
    watch_phi(watched, phi);
    double size = largest_of(phi, watched->nc);
    quarter[4 * k / STEPS] = fmax(quarter[4 * k / STEPS], size);
    calm = size < DECAYED * first ? calm + 1 : 0;
    if (calm == CALM) {
      return true;
    }
    if (!(size < GROWN * first) || baum_simulation_step(watched->run, 1) < BAUM_OK) {
      return false;
    }
  }
  return quarter[3] < quarter[0];
}

/* ---- predicted ---- */

typedef struct window {
  const baum_integrator *integrator;
  double alpha_h;  /* largest; the grid begins one cell above 0 */
  double beta2_h2; /* likewise */
} window;

static bool predict(const window *w, double alpha_h, double beta2_h2)
{
  baum_amplification z;
  check(baum_stability_at(w->integrator, alpha_h, beta2_h2, &z, sizeof z));
  return z.stability == BAUM_STABLE;
}

static double alpha_at(const window *w, double i)
{
  return fmax(0.0, w->alpha_h * i / CELLS);
}

static double beta2_at(const window *w, double j)
{
  return fmax(0.0, w->beta2_h2 * j / CELLS);
}

/* Whether one of the neighbours of a point, or a point as good as itself, is on the other side: a
 * cell may hold the boundary, and points on it are marginal. */
static bool at_boundary(const window *w, int i, int j)
{
  static const double reach[] = {1.0, 1e-9};
  bool here = predict(w, alpha_at(w, i), beta2_at(w, j));
  bool other = false;
  for (int k = 0; k < 18; k++) {
    double di = (k % 3 - 1) * reach[k / 9];
    double dj = (k / 3 % 3 - 1) * reach[k / 9];
    other = other || predict(w, alpha_at(w, i + di), beta2_at(w, j + dj)) != here;
  }
  return other;
}

/* ---- both ---- */

typedef struct tally {
  int agree;
  int differ_at_boundary;
  int differ_elsewhere;
  int stable;
  int boundary;
} tally;

static void count(tally *t, const window *w, int i, int j, bool observed)
{
  bool predicted = predict(w, alpha_at(w, i), beta2_at(w, j));
  bool boundary = at_boundary(w, i, j);
  t->stable += predicted;
  t->boundary += boundary;
  t->agree += observed == predicted;
  t->differ_at_boundary += observed != predicted && boundary;
  if (observed != predicted && !boundary) {
    t->differ_elsewhere++;
    printf("astray: alpha h %.4f, beta^2 h^2 %.4f: predicted %d, observed %d\n", alpha_at(w, i),
           beta2_at(w, j), predicted, observed);
  }
}

static void compare_grid(const window *w, physics_mechanism which)
{
  model m = build_mechanism(which);
  watched_run consistent = start_consistent(&m);
  tally t = {0};
  for (int k = 0; k < CELLS * CELLS; k++) {
    int i = k % CELLS + 1;
    int j = k / CELLS + 1;
    baum_gains gains = baum_gains_scaled(alpha_at(w, i), beta2_at(w, j));
    watched_run watched = start(&m, &consistent, w->integrator, step_of(which), gains);
    count(&t, w, i, j, watch_decay(&watched));
    unwatch(&watched);
  }
  printf("%-20s %-20s %3.1f x %3.1f: %6.2f %% of %d agree (%d stable), %d differ next to the "
         "boundary (%d points), %d elsewhere\n",
         baum_integrator_name(w->integrator), mechanism_name(which), w->alpha_h, w->beta2_h2,
         100.0 * t.agree / (CELLS * CELLS), CELLS * CELLS, t.stable, t.differ_at_boundary,
         t.boundary, t.differ_elsewhere);
  (void)fflush(stdout);
  unwatch(&consistent);
  model_destroy(&m);
  assert_int_equal(t.differ_elsewhere, 0);
  /* A window that misses the region, or its edge, would agree for nothing. */
  assert_true(t.stable > CELLS * CELLS / 10 && t.stable < CELLS * CELLS * 9 / 10);
}

static void explicit_euler_is_stable_where_predicted(void **state)
{
  (void)state;
  window w = {baum_euler(), 2.2, 4.4};
  compare_grid(&w, PENDULUM);
  compare_grid(&w, FREE_CRANK);
}

static void semi_implicit_euler_is_stable_where_predicted(void **state)
{
  (void)state;
  window w = {baum_semi_implicit_euler(), 2.2, 4.4};
  compare_grid(&w, PENDULUM);
  compare_grid(&w, FREE_CRANK);
}

/* Its real interval ends at alpha h = 2.785, the imaginary one at beta^2 h^2 = 8. */
static void rk4_is_stable_where_predicted(void **state)
{
  (void)state;
  window w = {baum_rk4(), 3.3, 8.8};
  compare_grid(&w, PENDULUM);
  compare_grid(&w, FREE_CRANK);
}

/* ---- Taylor ---- */

/* z^2 = -1, so that Phi(n + 2) = -Phi(n), and Phi(1) = Phi(0) where the start's Phi' is zero. */
static void watch_circle(physics_mechanism which)
{
  model m = build_mechanism(which);
  watched_run consistent = start_consistent(&m);
  watched_run watched = start(&m, &consistent, baum_euler(), step_of(which), baum_gains_taylor());
  double phi[TAYLOR_STEPS + 1][PHYSICS_NC] = {{0.0}};
  double worst = 0.0;
  for (int n = 0; n <= TAYLOR_STEPS; n++) {
    watch_phi(&watched, phi[n]);
    check(baum_simulation_step(watched.run, 1));
  }
  for (int n = 2; n <= TAYLOR_STEPS; n++) {
    for (int i = 0; i < watched.nc; i++) {
      assert_true(phi[n][i] * phi[n - 2][i] < 0.0);
      worst = fmax(worst, fabs(phi[n][i] + phi[n - 2][i]) / fabs(phi[0][i]));
    }
  }
  printf("taylor, %s: row 0 over 8 steps:", mechanism_name(which));
  for (int n = 0; n < 8; n++) {
    printf(" %+.2e", phi[n][0]);
  }
  printf("; largest |Phi(n) + Phi(n - 2)| / |Phi(0)| of %d rows in %d steps %.1e\n", watched.nc,
         TAYLOR_STEPS, worst);
  /* The motion adds h^2 |gamma| a step, 1e-10 of the scale, to rows that were violated by 1e-7 of
   * it or more. */
  assert_true(worst < 1e-2);
  unwatch(&watched);
  unwatch(&consistent);
  model_destroy(&m);
}

static void taylors_gains_turn_a_violation_about_the_circle_in_four_steps(void **state)
{
  (void)state;
  watch_circle(PENDULUM);
  watch_circle(FREE_CRANK);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(explicit_euler_is_stable_where_predicted),
    cmocka_unit_test(semi_implicit_euler_is_stable_where_predicted),
    cmocka_unit_test(rk4_is_stable_where_predicted),
    cmocka_unit_test(taylors_gains_turn_a_violation_about_the_circle_in_four_steps),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
