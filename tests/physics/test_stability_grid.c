/* SPDX-License-Identifier: BSD-3-Clause */
/* Fig. 1 of Flores et al. 2008, for three methods and two mechanisms: is a violation damped where the amplification
 * predicts it?
 *
 * Grid of 44 x 44 points in (alpha h, beta^2 h^2). Every point starts from a pose whose coordinates are off by 1e-6 of
 * their scales and runs 3000 steps; it is stable when the largest violation of the last quarter is below that of the
 * first. Observed must be predicted but on points next to the predicted boundary, where 3000 steps cannot tell a
 * spectral radius of 0.999 from 1.001.
 *
 * The step is 1e-5 of the time of a radian, so that the motion hardly moves within the run, and the steady violation
 * of the Eulers, (alpha/beta^2) h |gamma| or about 1e-10 A/B of the length scale, stays far below 1e-6.
 *
 * Work: a run ends early once a block of steps has at most 1e-3 or at least 1e3 times the violation of the first
 * block, because a violation that a linear map has damped or blown up a thousandfold goes on that way. Every eleventh
 * point, and with the pendulum every point, is run to the end nevertheless.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "models.h"

enum {
  SIDE = 44,
  COORDINATES = 9,
  BLOCKS = 20,
  BLOCK = 150,
  QUARTER = BLOCKS / 4,
  FULL_EVERY = 11
};

static const double PERTURBATION = 1e-6;
static const double DECIDED = 1e3;

/* A mechanism, its consistent start, and a step. */
typedef struct scene {
  const char *name;
  model model;
  double q[COORDINATES];
  double v[COORDINATES];
  int nq;
  double scale;
  double step;
  bool in_full;
} scene;

typedef struct field {
  const baum_integrator *integrator;
  double alpha_h; /* between grid lines; the first line is at this value */
  double beta2_h2;
} field;

/* Time and state between blocks. */
typedef struct moving {
  double t;
  double q[COORDINATES];
  double v[COORDINATES];
} moving;

static baum_simulation_options options_at(const scene *on, const baum_integrator *integrator,
                                          double alpha_h, double beta2_h2)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  options.gains = baum_gains_scaled(alpha_h, beta2_h2);
  options.step = on->step;
  options.start = BAUM_START_AS_GIVEN;
  options.allow_unstable = true;
  return options;
}

static void prepare(scene *out, double rate)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_euler();
  options.step = 1e-5 / rate;
  baum_simulation *run = NULL;
  assert_int_equal(baum_simulation_create(out->model.mechanism, &options, &run), BAUM_OK);
  int32_t nq = 0;
  assert_int_equal(baum_mechanism_sizes(out->model.mechanism, &nq, NULL, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_get_scale(out->model.mechanism, &out->scale), BAUM_OK);
  out->nq = nq;
  out->step = options.step;
  memcpy(out->q, baum_simulation_q(run), (size_t)nq * sizeof(double));
  memcpy(out->v, baum_simulation_v(run), (size_t)nq * sizeof(double));
  baum_simulation_destroy(run);
}

static scene make_pendulum(void)
{
  /* Level with the pivot and falling at 3 m/s. */
  static const model_pendulum data = {.gravity = 9.81, .x = 1.0, .v = -3.0};
  scene out = {.name = "pendulum", .in_full = true};
  assert_int_equal(model_pendulum_rod(&data, &out.model), BAUM_OK);
  prepare(&out, 3.0);
  return out;
}

static scene make_slider_crank(void)
{
  scene out = {.name = "slider-crank, free"};
  assert_int_equal(model_slider_crank_build((model_slider_crank){0}, &out.model), BAUM_OK);
  prepare(&out, 150.0);
  return out;
}

static moving perturbed(const scene *on)
{
  moving out = {.t = 0.0};
  memcpy(out.v, on->v, sizeof out.v);
  for (int i = 0; i < on->nq; i++) {
    double scale = on->nq == COORDINATES && i % 3 == 2 ? 1.0 : on->scale;
    out.q[i] = on->q[i] + (i % 2 == 0 ? PERTURBATION : -PERTURBATION) * scale;
  }
  return out;
}

/* Largest |Phi| over one block of steps, of which `state` is moved to the end; infinite when the run fails. */
static double run_block(const scene *on, const baum_simulation_options *options, moving *state)
{
  baum_simulation *run = NULL;
  double largest = INFINITY;
  baum_status status = baum_simulation_create(on->model.mechanism, options, &run);
  assert_true(status >= 0);
  status = baum_simulation_set_state(run, state->t, state->q, state->v);
  if (status >= 0) {
    status = baum_simulation_step(run, BLOCK);
  }
  if (status >= 0) {
    baum_counters counters;
    assert_int_equal(baum_simulation_counters(run, &counters, sizeof counters), BAUM_OK);
    largest = counters.max_phi;
    state->t = baum_simulation_time(run);
    memcpy(state->q, baum_simulation_q(run), (size_t)on->nq * sizeof(double));
    memcpy(state->v, baum_simulation_v(run), (size_t)on->nq * sizeof(double));
  }
  baum_simulation_destroy(run);
  return largest;
}

static bool observe(const scene *on, const baum_simulation_options *options, bool in_full)
{
  moving state = perturbed(on);
  double begun = 0.0;
  double first = 0.0;
  double last = 0.0;
  for (int k = 0; k < BLOCKS; k++) {
    double largest = run_block(on, options, &state);
    begun = k == 0 ? largest : begun;
    if (!(largest < DECIDED * PERTURBATION) || (!in_full && largest < begun / DECIDED)) {
      return largest < begun;
    }
    first = k < QUARTER ? fmax(first, largest) : first;
    last = k >= BLOCKS - QUARTER ? fmax(last, largest) : last;
  }
  return last < first;
}

static bool predict(const field *f, int i, int j)
{
  baum_amplification at;
  assert_int_equal(
    baum_stability_at(f->integrator, (i + 1) * f->alpha_h, (j + 1) * f->beta2_h2, &at, sizeof at),
    BAUM_OK);
  return at.stability == BAUM_STABLE;
}

/* Does a neighbour, also one just off the grid, have another prediction? */
static bool next_to_boundary(const field *f, int i, int j)
{
  bool here = predict(f, i, j);
  for (int di = -1; di <= 1; di++) {
    for (int dj = -1; dj <= 1; dj++) {
      if (predict(f, i + di, j + dj) != here) {
        return true;
      }
    }
  }
  return false;
}

typedef struct tally {
  int stable;
  int boundary;
  int off_boundary; /* observed and predicted differ, next to the boundary */
  int off;          /* elsewhere */
} tally;

static void visit(const scene *on, const field *f, int i, int j, tally *count)
{
  bool predicted = predict(f, i, j);
  bool boundary = next_to_boundary(f, i, j);
  baum_simulation_options options =
    options_at(on, f->integrator, (i + 1) * f->alpha_h, (j + 1) * f->beta2_h2);
  bool in_full = on->in_full || (SIDE * j + i) % FULL_EVERY == 0;
  bool differs = observe(on, &options, in_full) != predicted;
  count->stable += predicted;
  count->boundary += boundary;
  count->off_boundary += boundary && differs;
  count->off += !boundary && differs;
  if (!boundary && differs) {
    print_error("%s, %s: alpha h %g, beta^2 h^2 %g is predicted %s, observed the opposite\n",
                on->name, baum_integrator_name(f->integrator), options.gains.value[0],
                options.gains.value[1], predicted ? "stable" : "unstable");
  }
}

static void compare(const scene *on, const field *f)
{
  tally count = {0};
  for (int j = 0; j < SIDE; j++) {
    for (int i = 0; i < SIDE; i++) {
      visit(on, f, i, j, &count);
    }
  }
  printf("%-20s %-20s %9d %10d %12d %12d\n", on->name, baum_integrator_name(f->integrator),
         count.stable, count.boundary, count.off_boundary, count.off);
  (void)fflush(stdout);
  /* Both sides are there. */
  assert_in_range(count.stable, 300, SIDE * SIDE - 300);
  assert_int_equal(count.off, 0);
}

static void compare_all(scene *on)
{
  /* The grids reach a little beyond the regions: A < 2, B < 4; A < 1, B < 4; A < 2.8, B < 8. */
  const field fields[] = {
    {baum_euler(), 0.048, 0.097},
    {baum_semi_implicit_euler(), 0.027, 0.097},
    {baum_rk4(), 0.067, 0.19},
  };
  printf("%-20s %-20s %9s %10s %12s %12s\n", "of 1936 points", "", "stable", "boundary",
         "differ there", "elsewhere");
  for (size_t k = 0; k < sizeof fields / sizeof fields[0]; k++) {
    compare(on, &fields[k]);
  }
  model_destroy(&on->model);
}

static void the_pendulum_is_stable_where_predicted(void **state)
{
  (void)state;
  scene on = make_pendulum();
  compare_all(&on);
}

static void the_slider_crank_is_stable_where_predicted(void **state)
{
  (void)state;
  scene on = make_slider_crank();
  compare_all(&on);
}

/* Taylor's pair has the roots i and -i: Phi(n + 2) = -Phi(n). From a start off in position only, Phi(0) = Phi(1). */
static void taylor_with_explicit_euler_repeats_every_four_steps(void **state)
{
  (void)state;
  enum { STEPS = 400 };
  static const baum_channel channel = {.quantity = BAUM_PHI};
  scene on = make_slider_crank();
  baum_simulation_options options = options_at(&on, baum_euler(), 0.0, 0.0);
  options.gains = baum_gains_taylor();
  baum_simulation *run = NULL;
  assert_true(baum_simulation_create(on.model.mechanism, &options, &run) >= 0);
  moving start = perturbed(&on);
  assert_int_equal(baum_simulation_set_state(run, 0.0, start.q, start.v), BAUM_OK);
  double first[8];
  assert_int_equal(baum_simulation_get(run, &channel, 1, first), BAUM_OK);
  static const double sign[4] = {1.0, -1.0, -1.0, 1.0};
  for (int n = 0; n < STEPS; n++) {
    double phi[8];
    assert_true(baum_simulation_step(run, 1) >= 0);
    assert_int_equal(baum_simulation_get(run, &channel, 1, phi), BAUM_OK);
    for (int row = 0; row < 8; row++) {
      /* + - - + from the first step on. On the circle nothing damps what each step adds: Phi of order (1e-5)^2 of a
       * length per step, so 400 x 1e-10 of 0.3 m on 1e-7 or more. */
      double want = sign[n % 4] * first[row];
      assert_true(fabs(first[row]) > 1e-7);
      assert_true(fabs(phi[row] - want) <= 0.02 * fabs(first[row]));
    }
  }
  baum_simulation_destroy(run);
  model_destroy(&on.model);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_pendulum_is_stable_where_predicted),
    cmocka_unit_test(the_slider_crank_is_stable_where_predicted),
    cmocka_unit_test(taylor_with_explicit_euler_repeats_every_four_steps),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
