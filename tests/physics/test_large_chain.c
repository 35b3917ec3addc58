/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests a chain of 100000 links. The test checks how much time and memory the setup takes, and
 * whether every link satisfies Newton's and Euler's equations. Builds with instrumentation, such as
 * sanitizers, use a shorter chain and do not test memory. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

#include <cmocka.h>

#include "physics_run.h"
#include "runs.h"

enum { LINKS = 100000 / BAUM_TEST_PATIENCE, PER_LINK = 3 };

/* [s] If one part of the setup takes longer than this, its time does not grow linearly with the
 * number of links. */
static const double HANGING = 30.0 * BAUM_TEST_PATIENCE;
static const double GRAVITY = 9.81;

/* ---- cost ---- */

static double now(void)
{
  struct timespec time;
  assert_int_equal(clock_gettime(CLOCK_MONOTONIC, &time), 0);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Returns the largest amount of memory that the process has used so far [MB]. */
static double most_memory(void)
{
  struct rusage usage;
  assert_int_equal(getrusage(RUSAGE_SELF, &usage), 0);
  return (double)usage.ru_maxrss / 1e3;
}

/* Prints the time since `since`, and the largest amount of memory used so far. Returns the present
 * time. */
static double lap(const char *what, double since)
{
  double seconds = now() - since;
  printf("%-34s %8.4f s %8.1f MB\n", what, seconds, most_memory());
  assert_true(seconds < HANGING);
  if (BAUM_TEST_PATIENCE == 1) {
    assert_true(most_memory() < 1000.0);
  }
  return now();
}

/* ---- the chain: links of 1 m and 1 kg in gentle bends, at rest ---- */

static double angle_of(int link)
{
  return 0.3 * sin(0.1 * link);
}

static model build_chain(void)
{
  model out;
  double *angles = malloc(LINKS * sizeof *angles);
  assert_non_null(angles);
  for (int k = 0; k < LINKS; k++) {
    angles[k] = angle_of(k);
  }
  const model_chain data = {.links = LINKS, .angle = angles};
  check(model_chain_build(&data, &out));
  free(angles);
  return out;
}

static void freezing_and_starting_a_run_take_linear_time(void **state)
{
  (void)state;
  double before = now();
  model m = build_chain();
  before = lap("add and freeze", before);
  baum_mechanism *again = NULL;
  check(baum_mechanism_copy(m.mechanism, &again));
  before = lap("copy", before);
  check(baum_mechanism_freeze(again));
  before = lap("freeze", before);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_semi_implicit_euler();
  options.step = 1e-4;
  baum_simulation *run = create_run(again, &options);
  baum_mechanism_destroy(again);
  model_destroy(&m);
  before = lap("simulation", before);
  check(baum_simulation_step(run, 1));
  (void)lap("step", before);
  for (int i = 0; i < PER_LINK * LINKS; i++) {
    assert_true(isfinite(baum_simulation_q(run)[i]));
  }
  baum_simulation_destroy(run);
}

/* In a straight horizontal chain, the rounding errors of all joints add up at the last links.
 * Projection must work in spite of this. */
static void projection_works_for_a_straight_chain(void **state)
{
  (void)state;
  model m;
  double *angles = calloc(LINKS, sizeof *angles);
  assert_non_null(angles);
  const model_chain data = {.links = LINKS, .angle = angles};
  check(model_chain_build(&data, &m));
  free(angles);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.step = 1e-3;
  baum_simulation *run = create_run(m.mechanism, &options);
  model_destroy(&m);
  double before = now();
  check(baum_simulation_step(run, 12));
  (void)lap("12 steps of rk4", before);
  baum_simulation_destroy(run);
}

static void degrees_of_freedom_are_counted(void **state)
{
  (void)state;
  model m = build_chain();
  baum_mobility mobility;
  double before = now();
  check(baum_mechanism_mobility(m.mechanism, &mobility, sizeof mobility));
  (void)lap("mobility", before);
  assert_int_equal(mobility.degrees_of_freedom, LINKS);
  assert_int_equal(mobility.redundant_rows, 0);
  assert_int_equal(mobility.free_bodies, 0);
  assert_false(mobility.near_singular);
  model_destroy(&m);
}

/* ---- mechanics ---- */

/* Each link must satisfy Newton's and Euler's equations. The pin at the start of link k carries
 * this link and all links after it. A link has the mass m and the moment of inertia J. The force of
 * the pin at the start of link k is F_k, the sum of m (a_j - g) over j >= k. Euler's equation is J
 * alpha_k = -p x F_k - p x F_(k+1), where p is the vector from the centre of the link to its end.
 * The ends of adjacent links must have the same acceleration. */
typedef struct worst {
  double force;
  double moment; /* [N m] largest residual */
  double gap;    /* [m/s^2] largest difference between the accelerations of adjacent ends */
} worst;

static worst compare_links(const double *a)
{
  worst out = {0};
  double force[2] = {0.0, 0.0};
  double next[2] = {NAN, NAN}; /* acceleration at the start of the next link */
  for (int k = LINKS - 1; k >= 0; k--) {
    const double *at = a + (size_t)(PER_LINK * k);
    double p[2] = {0.5 * cos(angle_of(k)), 0.5 * sin(angle_of(k))};
    double turned[2] = {-p[1] * at[2], p[0] * at[2]};
    double moment = -at[2] / 12.0 - (p[0] * force[1] - p[1] * force[0]);
    force[0] += at[0];
    force[1] += at[1] + GRAVITY;
    moment -= p[0] * force[1] - p[1] * force[0];
    out.moment = fmax(out.moment, fabs(moment));
    out.force = fmax(out.force, hypot(force[0], force[1]));
    for (int i = 0; i < 2 && k < LINKS - 1; i++) {
      out.gap = fmax(out.gap, fabs(at[i] + turned[i] - next[i]));
    }
    next[0] = at[0] - turned[0];
    next[1] = at[1] - turned[1];
  }
  out.gap = fmax(out.gap, hypot(next[0], next[1])); /* the first link is pinned to the ground */
  return out;
}

static double *solve(const model *m)
{
  double *q = malloc((size_t)PER_LINK * LINKS * sizeof *q);
  double *v = calloc((size_t)PER_LINK * LINKS, sizeof *v);
  double *a = malloc((size_t)PER_LINK * LINKS * sizeof *a);
  assert_true(q && v && a);
  baum_workspace *workspace = NULL;
  double before = now();
  check(baum_workspace_create(m->mechanism, &workspace));
  before = lap("workspace", before);
  check(baum_workspace_design(workspace, q, NULL));
  check(baum_workspace_acceleration(workspace, 0.0, q, v, 0.0, 0.0, a, NULL));
  before = lap("first evaluation", before);
  check(baum_workspace_acceleration(workspace, 0.0, q, v, 0.0, 0.0, a, NULL));
  (void)lap("second evaluation", before);
  baum_workspace_destroy(workspace);
  free(q);
  free(v);
  return a;
}

static void every_link_obeys_newton_and_euler(void **state)
{
  (void)state;
  model m = build_chain();
  double *a = solve(&m);
  worst off = compare_links(a);
  printf("forces up to %.3g N; largest errors: moments %.1e N m, ends %.1e m/s^2\n", off.force,
         off.moment, off.gap);
  /* F_k is a sum of up to 1e5 terms. Each term has a relative rounding error of 1e-16. */
  assert_true(off.moment <= 1e-11 * off.force);
  /* Refinement reduces the residuals of rows to rounding errors of accelerations, which are about
   * g. */
  assert_true(off.gap <= 1e-12 * GRAVITY);
  free(a);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(freezing_and_starting_a_run_take_linear_time),
    cmocka_unit_test(projection_works_for_a_straight_chain),
    cmocka_unit_test(degrees_of_freedom_are_counted),
    cmocka_unit_test(every_link_obeys_newton_and_euler),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
