/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares baum_stability_at() with runs of mechanisms. In such a run, all rows of the mechanism
 * are violated at the start. A pair of gains (alpha, beta) is considered stable if the largest
 * violation in the last quarter of the run is smaller than the largest violation in the first
 * quarter. For every fixed-step integrator, pairs on a grid are tested. The grid covers the part of
 * the plane of (alpha h, beta^2 h^2) that contains the predicted stable region. Each mechanism has
 * a separate test program, so that the programs can run in parallel. Include after cmocka.h.
 *
 * The step is chosen as follows. The motion itself causes a steady violation of (alpha h / (beta^2
 * h^2)) h^2 |gamma|, where gamma is the right side of J a = gamma. This steady violation must be
 * far below the initial violation, which is 1e-6 of the characteristic length. The step is 1e-5 /
 * omega, where omega is the rate of the motion at the start. The steady violation is then 1e-10 of
 * the characteristic length. In the corner of the grid where alpha h is largest and beta^2 h^2 is
 * smallest, the steady violation is about 20 times as large. For methods of higher order it is
 * smaller.
 */
#ifndef BAUM_TEST_STABILITY_GRID_H
#define BAUM_TEST_STABILITY_GRID_H

#include <string.h>

#include "physics_run.h"

enum { CELLS = 44, STEPS = 3000, CALM = 32, OUTLINE = 2000 };

/* Initial position error. For lengths, it is a fraction of the characteristic length; for angles,
 * it is in rad. */
static const double OFF = 1e-6;
/* A violation is considered to have grown if it is this many times the initial one. It is then 1e-3
 * of the characteristic length. Much larger violations would no longer follow the linear
 * equations. */
static const double GROWN = 1e3;
/* A violation is considered to have decayed if it is below this fraction of the initial one. A
 * one-step method has two modes, which change by the factors z1 and z2 in a step. If Phi' = 0 at
 * the start, a mode initially has the fraction (1 - z1) / (z2 - z1) of the violation. In these
 * tests that fraction is at least 1/100, so a run in which a mode grows never counts as decayed. A
 * multistep method has further modes, whose initial fractions may be smaller. A run with such a
 * method therefore never ends early as decayed. */
static const double DECAYED = 1e-3;

/* Size of the grid divided by the size of the predicted stable region. */
static const double BEYOND = 1.1;

/* Returns a step of 1e-5 / omega. At the start, omega is 3.1 rad/s for the pendulum, 2 rad/s for
 * the four-bar, and 150 rad/s for the slider-cranks. */
static inline double step_of(physics_mechanism which)
{
  return which == PENDULUM ? 1e-5 / 3.1 : which == FOUR_BAR ? 1e-5 / 2.0 : 1e-5 / 150.0;
}

/* Changes every coordinate by a different amount, so that all rows are violated. */
static inline void violate(const checked_run *checked, const baum_mechanism *mechanism)
{
  double q[PHYSICS_NQ];
  double v[PHYSICS_NQ];
  double scale = (double)NAN;
  check(baum_mechanism_get_characteristic_length(mechanism, &scale));
  for (int i = 0; i < checked->nq; i++) {
    double unit = checked->nq == PHYSICS_NQ && i % 3 == 2 ? 1.0 : scale;
    q[i] = baum_simulation_q(checked->run)[i] + OFF * unit * cos(2.0 * i);
    v[i] = baum_simulation_v(checked->run)[i];
  }
  check(baum_simulation_set_state(checked->run, 0.0, q, v));
}

/* Starts a run whose initial state violates all constraints. `consistent` is an assembled run from
 * which the consistent state is read. It is created only once. */
static inline checked_run start(const model *m, const checked_run *consistent,
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
  checked_run out = create_checked_run(m->mechanism, &options);
  check(baum_simulation_set_state(out.run, 0.0, baum_simulation_q(consistent->run),
                                  baum_simulation_v(consistent->run)));
  violate(&out, m->mechanism);
  return out;
}

static inline checked_run start_consistent(const model *m)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_euler();
  options.step = 1e-5;
  return create_checked_run(m->mechanism, &options);
}

/* ---- observed stability ---- */

/* Tells whether the largest violation in the last quarter of the run is below that in the first
 * quarter. A run ends early if its violation has grown. It also ends early if the violation stays
 * below DECAYED for CALM steps. Fewer steps would not suffice, because the violation could just be
 * passing through zero. */
static inline bool violation_decays(const checked_run *checked, bool one_step)
{
  double phi[PHYSICS_NC];
  double quarter[4] = {0.0};
  evaluate_phi(checked, phi);
  double first = largest_of(phi, checked->nc);
  int calm = 0;
  for (int k = 0; k < STEPS; k++) {
    evaluate_phi(checked, phi);
    double size = largest_of(phi, checked->nc);
    quarter[4 * k / STEPS] = fmax(quarter[4 * k / STEPS], size);
    calm = size < DECAYED * first ? calm + 1 : 0;
    if (one_step && calm == CALM) {
      return true;
    }
    if (!(size < GROWN * first) || baum_simulation_step(checked->run, 1) < BAUM_OK) {
      return false;
    }
  }
  return quarter[3] < quarter[0];
}

/* ---- predicted stability ---- */

typedef struct window {
  const baum_integrator *integrator;
  double alpha_h;  /* the largest value of the grid; the smallest is the width of one cell */
  double beta2_h2; /* the largest value of the grid; the smallest is the height of one cell */
} window;

static inline bool predict(const window *w, double alpha_h, double beta2_h2)
{
  baum_amplification z;
  check(baum_stability_at(w->integrator, alpha_h, beta2_h2, &z, sizeof z));
  return z.stability == BAUM_STABLE;
}

/* Returns the size of the grid. The grid contains the predicted region. */
static inline window make_window(const baum_integrator *integrator)
{
  static double alpha_h[OUTLINE];
  static double beta2_h2[OUTLINE];
  int32_t count = 0;
  window w = {integrator, 0.0, 0.0};
  check(baum_stability_outline(integrator, 1.0, OUTLINE, alpha_h, beta2_h2, &count));
  assert_true(count > 0 && count <= OUTLINE);
  /* fmax() ignores the NaN between two parts of the outline */
  for (int32_t k = 0; k < count; k++) {
    w.alpha_h = fmax(w.alpha_h, BEYOND * alpha_h[k]);
    w.beta2_h2 = fmax(w.beta2_h2, BEYOND * beta2_h2[k]);
  }
  return w;
}

static inline double alpha_at(const window *w, double i)
{
  return fmax(0.0, w->alpha_h * i / CELLS);
}

static inline double beta2_at(const window *w, double j)
{
  return fmax(0.0, w->beta2_h2 * j / CELLS);
}

/* Tells whether a point of the grid is next to the predicted boundary. This is so if the prediction
 * is different at a neighbouring grid point, or at a distance of only 1e-9 cells. In the first case
 * the boundary passes through the cell, and in the second case through the point itself. */
static inline bool at_boundary(const window *w, int i, int j)
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

/* ---- comparison ---- */

typedef struct tally {
  int agree;
  int differ_at_boundary;
  int differ_elsewhere;
  int stable;
  int boundary;
} tally;

static inline void count(tally *t, const window *w, int i, int j, bool observed)
{
  bool predicted = predict(w, alpha_at(w, i), beta2_at(w, j));
  bool boundary = at_boundary(w, i, j);
  t->stable += predicted;
  t->boundary += boundary;
  t->agree += observed == predicted;
  t->differ_at_boundary += observed != predicted && boundary;
  if (observed != predicted && !boundary) {
    t->differ_elsewhere++;
    printf("mismatch: alpha h %.4f, beta^2 h^2 %.4f: predicted %d, observed %d\n", alpha_at(w, i),
           beta2_at(w, j), predicted, observed);
  }
}

static inline void compare_grid(const baum_integrator *integrator, physics_mechanism which)
{
  const window made = make_window(integrator);
  const window *w = &made;
  const bool one_step = strncmp(baum_integrator_name(integrator), "ab", 2) != 0;
  model m = build_mechanism(which);
  checked_run consistent = start_consistent(&m);
  tally t = {0};
  for (int k = 0; k < CELLS * CELLS; k++) {
    int i = k % CELLS + 1;
    int j = k / CELLS + 1;
    baum_gains gains = baum_gains_scaled(alpha_at(w, i), beta2_at(w, j));
    checked_run checked = start(&m, &consistent, w->integrator, step_of(which), gains);
    count(&t, w, i, j, violation_decays(&checked, one_step));
    destroy_checked_run(&checked);
  }
  printf("%-20s %-20s %4.2f x %5.2f: %6.2f %% of %d agree (%d stable), %d differ next to the "
         "boundary (%d points), %d elsewhere\n",
         baum_integrator_name(w->integrator), mechanism_name(which), w->alpha_h, w->beta2_h2,
         100.0 * t.agree / (CELLS * CELLS), CELLS * CELLS, t.stable, t.differ_at_boundary,
         t.boundary, t.differ_elsewhere);
  (void)fflush(stdout);
  destroy_checked_run(&consistent);
  model_destroy(&m);
  assert_int_equal(t.differ_elsewhere, 0);
  assert_true(t.agree >= 97 * CELLS * CELLS / 100);
  /* If the whole grid were inside or outside of the region, the agreement of prediction and
   * observation would prove nothing. */
  assert_true(t.stable > CELLS * CELLS / 10 && t.stable < CELLS * CELLS * 9 / 10);
}

/* The fixed-step integrators that have gains. dp5 is missing, because its region is computed in the
 * same way as that of rk8. */
#define EVERY_INTEGRATOR(X)   \
  X(baum_euler)               \
  X(baum_semi_implicit_euler) \
  X(baum_rk2)                 \
  X(baum_rk3)                 \
  X(baum_rk4)                 \
  X(baum_rk8)                 \
  X(baum_ab2)                 \
  X(baum_ab3)                 \
  X(baum_ab4)

/* Defines one test for an integrator, named after it. */
#define DEFINE_GRID(integrator, mechanism)                         \
  static void integrator##_is_stable_where_predicted(void **state) \
  {                                                                \
    (void)state;                                                   \
    compare_grid(integrator(), mechanism);                         \
  }
#define LIST_GRID(integrator) cmocka_unit_test(integrator##_is_stable_where_predicted),

#endif
