/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the accuracy of accelerations and multipliers. They are compared with a solution in
 * quadruple precision for the same M, J, g and gamma. For every case, the test prints the largest
 * error of a and the largest error of lambda, each relative to the largest element. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "posed.h"

static const double PI = 3.14159265358979324;

/* The limit for ordinary configurations. It is about ten times the error that remains after
 * iterative refinement of the solution. The remaining error is rounding, amplified by condition
 * numbers of a few hundred. */
static const double ORDINARY = 1e-12;
/* At a distance d [rad] from a singular configuration, the error of lambda is the error of J a
 * divided by d^2. If refinement used residuals in double precision, an error of 1e-16 / d^2 would
 * remain. The solvers compute residuals in higher precision. This gives full accuracy at 1e-4 rad,
 * and seven digits at 1e-6 rad. */
static const double NEAR = 1e-12;
static const double NEAREST = 1e-7;
/* Masses differ by a factor of 1e6, so six digits could be lost. In fact only about two are
 * lost. */
static const double UNEVEN = 1e-10;

/* ---- table ---- */

typedef struct errors {
  double a;
  double lambda;
} errors;

typedef struct table {
  int failures;
} table;

static void print_head(const char *title)
{
  printf("\n%-44s %10s %10s %10s\n", title, "a", "lambda", "limit");
}

static double worse(double a, double b)
{
  return isnan(a) || a > b ? a : b;
}

/* Prints the errors of a case and checks them. `lambda_limit` may be infinite. */
static void note(table *t, const char *name, errors found, double limit, double lambda_limit)
{
  bool fine = found.a <= limit && (found.lambda <= lambda_limit || isinf(lambda_limit));
  printf("%-44s %10.1e %10.1e %10.0e%s\n", name, found.a, found.lambda, limit,
         fine ? "" : "  exceeded");
  (void)fflush(stdout);
  t->failures += fine ? 0 : 1;
}

/* Measures the errors in the configuration p and frees p. */
static errors measure(posed *p)
{
  accelerate(p);
  assert_true(quad_acceleration(p->workspace, 0.0, p->q, p->v, NULL, p->want_a, p->want_lambda));
  errors out = {quad_error(p->nv, p->a, p->want_a), quad_error(p->nc, p->lambda, p->want_lambda)};
  unpose(p);
  return out;
}

/* ---- configurations ---- */

typedef posed pose_fn(uint64_t *seed, int size);

static posed free_crank(uint64_t *seed, int size)
{
  (void)size;
  model m;
  model_slider_crank options = {.angle = draw(seed, -PI, PI), .moving = true};
  baum_status status = model_slider_crank_build(options, &m);
  return pose_model(status, m);
}

static posed driven_crank(uint64_t *seed, int size)
{
  (void)size;
  model m;
  model_slider_crank options = {.driven = true, .angle = draw(seed, -PI, PI), .moving = true};
  baum_status status = model_slider_crank_build(options, &m);
  return pose_model(status, m);
}

/* Rotates the crank of Andrews' mechanism by a random angle. Assembly then moves the other
 * bodies. */
static posed andrews(uint64_t *seed, int size)
{
  (void)size;
  model m;
  baum_status status = model_andrews_bodies(&m);
  posed p = pose_model(status, m);
  double turn = draw(seed, -0.4, 0.4);
  double x = p.q[0];
  p.q[0] = x * cos(turn) - p.q[1] * sin(turn);
  p.q[1] = x * sin(turn) + p.q[1] * cos(turn);
  p.q[2] += turn;
  for (int i = 0; i < p.nv; i++) {
    p.v[i] = (double)NAN;
  }
  p.v[2] = draw(seed, -1e3, 1e3);
  check(baum_workspace_assemble(p.workspace, 0.0, p.q, p.v, m.bodies, 1));
  return p;
}

static posed pose_n_four_bar(model_n_four_bar data)
{
  model m;
  baum_status status = model_n_four_bar_build(&data, &m);
  return pose_model(status, m);
}

/* Makes an N-four-bar in a random configuration. All cranks are at least 0.2 rad from the flat
 * configuration. */
static posed n_four_bar(uint64_t *seed, int size)
{
  model_n_four_bar data = model_n_four_bar_a02(size);
  data.angle = draw(seed, 0.2, PI - 0.2) * (draw(seed, -1.0, 1.0) < 0.0 ? -1.0 : 1.0);
  data.rate = draw(seed, -5.0, 5.0);
  return pose_n_four_bar(data);
}

static posed pose_chain(uint64_t *seed, int links, const double *mass)
{
  model m;
  double *angle = calloc((size_t)links, sizeof *angle);
  double *rate = calloc((size_t)links, sizeof *rate);
  assert_true(angle && rate);
  for (int k = 0; k < links; k++) {
    angle[k] = draw(seed, -PI, PI);
    rate[k] = draw(seed, -2.0, 2.0);
  }
  model_chain data = {.links = links, .mass = mass, .angle = angle, .rate = rate};
  baum_status status = model_chain_build(&data, &m);
  free(angle);
  free(rate);
  return pose_model(status, m);
}

static posed chain(uint64_t *seed, int size)
{
  return pose_chain(seed, size, NULL);
}

/* ---- ordinary configurations ---- */

/* The mechanism has one degree of freedom, the crank angle. The equation of motion for this angle
 * gives the angular acceleration. The oracle must find the same value. */
static void the_oracle_finds_the_motion_of_the_n_four_bar(void **state)
{
  (void)state;
  enum { N = 10 };
  uint64_t seed = 3;
  posed p = n_four_bar(&seed, N);
  double want = -((N + 1) / 2.0 + N) / ((N + 1) / 3.0 + N) * 9.81 * cos(p.q[2]);
  assert_true(quad_acceleration(p.workspace, 0.0, p.q, p.v, NULL, p.want_a, p.want_lambda));
  for (int k = 0; k <= N; k++) {
    /* The rounding errors of M, J and g are amplified by the condition number. It is largest when a
     * crank is only 0.2 rad from the flat configuration. */
    assert_true(fabs(p.want_a[6 * k + 2] - want) <= 1e-12 * fabs(want));
  }
  unpose(&p);
}

static void both_oracles_give_the_same_solution(void **state)
{
  (void)state;
  uint64_t seed = 4;
  posed p = chain(&seed, 30);
  assert_true(quad_acceleration(p.workspace, 0.0, p.q, p.v, NULL, p.want_a, p.want_lambda));
  assert_true(quad_acceleration_of_blocks(p.workspace, 0.0, p.q, p.v, p.a, p.lambda));
  /* Each result was rounded once, from quadruple to double precision. */
  assert_true(quad_error(p.nv, p.a, p.want_a) <= 0x1p-52);
  assert_true(quad_error(p.nc, p.lambda, p.want_lambda) <= 0x1p-52);
  unpose(&p);
}

static void ordinary_configurations_keep_twelve_digits(void **state)
{
  (void)state;
  static const struct {
    const char *name;
    pose_fn *pose;
    int size;
  } cases[] = {
    {"slider-crank", free_crank, 0},
    {"slider-crank, driven", driven_crank, 0},
    {"Andrews", andrews, 0},
    {"four-bar N = 1", n_four_bar, 1},
    {"four-bar N = 10", n_four_bar, 10},
    {"four-bar N = 40", n_four_bar, 40},
    {"chain N = 10", chain, 10},
    {"chain N = 100", chain, 100},
  };
  enum { POSES = 5 };
  table t = {0};
  uint64_t seed = 1;
  print_head("random configurations, the worst of 5");
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    errors worst = {0};
    for (int i = 0; i < POSES; i++) {
      posed p = cases[k].pose(&seed, cases[k].size);
      errors found = measure(&p);
      worst.a = worse(found.a, worst.a);
      worst.lambda = worse(found.lambda, worst.lambda);
    }
    note(&t, cases[k].name, worst, ORDINARY, ORDINARY);
  }
  assert_int_equal(t.failures, 0);
}

/* ---- near singular configurations ---- */

static errors measure_folded_crank(double gap, bool driven)
{
  model m;
  model_slider_crank options = {
    .driven = driven, .centric = true, .rod = 0.153, .angle = PI / 2 - gap, .moving = true};
  baum_status status = model_slider_crank_build(options, &m);
  posed p = pose_model(status, m);
  return measure(&p);
}

static errors measure_flat(double gap)
{
  model_n_four_bar data = model_n_four_bar_a02(10);
  data.angle = gap;
  posed p = pose_n_four_bar(data);
  return measure(&p);
}

static void near_singular_configurations_keep_the_digits_that_refinement_allows(void **state)
{
  (void)state;
  table t = {0};
  print_head("near a singular configuration");
  note(&t, "slider-crank, 1e-4 rad", measure_folded_crank(1e-4, false), NEAR, NEAR);
  note(&t, "slider-crank, 1e-6 rad", measure_folded_crank(1e-6, false), NEAREST, NEAREST);
  note(&t, "slider-crank, driven, 1e-4 rad", measure_folded_crank(1e-4, true), NEAR, NEAR);
  note(&t, "slider-crank, driven, 1e-6 rad", measure_folded_crank(1e-6, true), NEAREST, NEAREST);
  note(&t, "four-bar N = 10, 1e-4 rad", measure_flat(1e-4), NEAR, NEAR);
  note(&t, "four-bar N = 10, 1e-6 rad", measure_flat(1e-6), NEAREST, NEAREST);
  assert_int_equal(t.failures, 0);
}

/* ---- masses ---- */

static errors measure_rod_mass(double mass)
{
  model m;
  model_slider_crank options = {.angle = 1.0, .rod_mass = mass, .moving = true};
  baum_status status = model_slider_crank_build(options, &m);
  posed p = pose_model(status, m);
  return measure(&p);
}

static errors measure_alternating(int loops, double crank, double coupler)
{
  model_n_four_bar data = model_n_four_bar_a02(loops);
  data.angle = 1.0;
  data.crank_mass = crank;
  data.coupler_mass = coupler;
  posed p = pose_n_four_bar(data);
  return measure(&p);
}

enum { LINKS = 100 };

/* Measures a chain whose links have a mass of 1 kg, except every second link, whose mass is
 * `other`. In addition, the mass of the last link is multiplied by `tip`. */
static errors measure_uneven_chain(double tip, double other)
{
  double mass[LINKS];
  uint64_t seed = 2;
  for (int k = 0; k < LINKS; k++) {
    mass[k] = k % 2 ? other : 1.0;
  }
  mass[LINKS - 1] *= tip;
  posed p = pose_chain(&seed, LINKS, mass);
  return measure(&p);
}

static void uneven_masses_keep_ten_digits(void **state)
{
  (void)state;
  table t = {0};
  print_head("uneven masses");
  note(&t, "slider-crank, rod x 1e6", measure_rod_mass(0.038e6), UNEVEN, UNEVEN);
  note(&t, "slider-crank, rod x 1e-6", measure_rod_mass(0.038e-6), UNEVEN, UNEVEN);
  note(&t, "four-bar N = 10, couplers x 1e6", measure_alternating(10, 1.0, 1e6), UNEVEN, UNEVEN);
  note(&t, "four-bar N = 10, couplers x 1e-6", measure_alternating(10, 1.0, 1e-6), UNEVEN, UNEVEN);
  note(&t, "chain N = 100, every other link x 1e6", measure_uneven_chain(1.0, 1e6), UNEVEN, UNEVEN);
  note(&t, "chain N = 100, every other link x 1e-6", measure_uneven_chain(1.0, 1e-6), UNEVEN,
       UNEVEN);
  note(&t, "chain N = 100, tip x 1e-6", measure_uneven_chain(1e-6, 1.0), UNEVEN, UNEVEN);
  note(&t, "chain N = 100, tip x 1e6", measure_uneven_chain(1e6, 1.0), UNEVEN, UNEVEN);
  assert_int_equal(t.failures, 0);
}

/* ---- length ---- */

static void a_chain_of_100000_links_keeps_ten_digits_of_a(void **state)
{
  (void)state;
  table t = {0};
  uint64_t seed = 5;
  print_head("long");
  posed p = chain(&seed, 100000);
  accelerate(&p);
  assert_true(quad_acceleration_of_blocks(p.workspace, 0.0, p.q, p.v, p.want_a, p.want_lambda));
  errors found = {quad_error(p.nv, p.a, p.want_a), quad_error(p.nc, p.lambda, p.want_lambda)};
  unpose(&p);
  /* Only a is tested. Errors of lambda are amplified by the condition number, which grows as the
   * square of the length. */
  note(&t, "chain N = 100000", found, 1e-10, (double)INFINITY);
  assert_int_equal(t.failures, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_oracle_finds_the_motion_of_the_n_four_bar),
    cmocka_unit_test(both_oracles_give_the_same_solution),
    cmocka_unit_test(ordinary_configurations_keep_twelve_digits),
    cmocka_unit_test(near_singular_configurations_keep_the_digits_that_refinement_allows),
    cmocka_unit_test(uneven_masses_keep_ten_digits),
    cmocka_unit_test(a_chain_of_100000_links_keeps_ten_digits_of_a),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
