/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the accuracy after 10000 revolutions. The angle of a body is one number, from which whole
 * revolutions are never subtracted. The rounding error of this number therefore limits the
 * accuracy. At 6e4 rad it is 7e-12 rad. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "posed.h"
#include "runs.h"

static const double TURNS = 1e4;
/* The sum TURN + TURN_REST is 2 pi. With both parts, TURNS revolutions can be subtracted without
 * rounding. */
static const double TURN = 6.283185307179586;
static const double TURN_REST = 2.4492935982947064e-16;

/* The limit for ordinary configurations, as in test_acceleration_accuracy.c. */
static const double ORDINARY = 1e-12;

enum { CASES = 5, STEPS = 200, LINKS = 10 };

static const char *const NAMES[CASES] = {"slider-crank", "slider-crank, driven", "four-bar",
                                         "four-bar N = 10", "chain N = 10"};

static baum_status build_chain(double shift, model *m)
{
  double angle[LINKS];
  for (int k = 0; k < LINKS; k++) {
    angle[k] = 0.3 * k + shift;
  }
  model_chain data = {.links = LINKS, .angle = angle};
  return model_chain_build(&data, m);
}

/* Makes a mechanism in which all angles are shifted by `shift`. In slider-cranks, only the angle of
 * the crank is shifted. */
static posed pose_case(int which, double shift)
{
  model m;
  model_slider_crank crank = {.driven = which == 1, .angle = 1.0 + shift, .moving = true};
  model_n_four_bar bars = model_n_four_bar_a02(which == 2 ? 1 : 10);
  bars.angle = 1.0 + shift;
  baum_status status = BAUM_OK;
  switch (which) {
  case 0:
  case 1: status = model_slider_crank_build(crank, &m); break;
  case 4: status = build_chain(shift, &m); break;
  default: status = model_n_four_bar_build(&bars, &m); break;
  }
  return pose_model(status, m);
}

/* Subtracts the TURNS revolutions from all angles that were shifted. */
static void turn_back(int count, double *q)
{
  for (int i = 2; i < count; i += 3) {
    if (q[i] > TURNS * TURN / 2) {
      q[i] = fma(-TURNS, TURN, q[i]) - TURNS * TURN_REST;
    }
  }
}

static void configurations_after_many_revolutions_keep_twelve_digits(void **state)
{
  (void)state;
  int failures = 0;
  printf("\n%-24s %10s %10s %20s\n", "after 10000 revolutions", "a", "lambda", "a without them");
  for (int which = 0; which < CASES; which++) {
    posed p = pose_case(which, TURNS * TURN);
    accelerate(&p);
    assert_true(quad_acceleration(p.workspace, 0.0, p.q, p.v, NULL, p.want_a, p.want_lambda));
    double a = quad_error(p.nv, p.a, p.want_a);
    double lambda = quad_error(p.nc, p.lambda, p.want_lambda);
    turn_back(p.nv, p.q);
    accelerate(&p);
    double apart = quad_error(p.nv, p.a, p.want_a);
    printf("%-24s %10.1e %10.1e %20.1e\n", NAMES[which], a, lambda, apart);
    failures += a <= ORDINARY && lambda <= ORDINARY && apart <= ORDINARY ? 0 : 1;
    unpose(&p);
  }
  assert_int_equal(failures, 0);
}

/* ---- runs ---- */

static baum_simulation *start_run(const posed *p, const baum_simulation_options *options)
{
  baum_simulation *run = create_run(p->m.mechanism, options);
  check(baum_simulation_set_state(run, 0.0, p->q, p->v));
  return run;
}

/* Makes two runs, one of which starts with the additional revolutions. Returns their largest
 * difference at `end`. Differences of lengths are relative to the characteristic length. */
static double compare_runs(int which, const baum_simulation_options *options, double end)
{
  posed p = pose_case(which, TURNS * TURN);
  double scale = (double)NAN;
  check(baum_mechanism_get_characteristic_length(p.m.mechanism, &scale));
  baum_simulation *turned = start_run(&p, options);
  /* The second run needs a new mechanism, because drivers start from the design configuration. */
  posed other = pose_case(which, 0.0);
  turn_back(p.nv, p.q);
  (void)memcpy(other.q, p.q, (size_t)p.nv * sizeof *p.q);
  baum_simulation *plain = start_run(&other, options);
  check(baum_simulation_advance_to(turned, end));
  check(baum_simulation_advance_to(plain, end));
  (void)memcpy(p.q, baum_simulation_q(turned), (size_t)p.nv * sizeof *p.q);
  turn_back(p.nv, p.q);
  double worst = 0.0;
  for (int i = 0; i < p.nv; i++) {
    double apart = fabs(p.q[i] - baum_simulation_q(plain)[i]) / (i % 3 < 2 ? scale : 1.0);
    worst = isnan(apart) || apart > worst ? apart : worst;
  }
  baum_simulation_destroy(turned);
  baum_simulation_destroy(plain);
  unpose(&p);
  unpose(&other);
  return worst;
}

static void fixed_steps_differ_by_the_rounding_of_angles(void **state)
{
  (void)state;
  /* Each of the 200 steps rounds an angle by at most 3.6e-12 rad. Together this is 7.3e-10 rad. The
   * motion takes at most 1 s, and amplifies this error at most tenfold. */
  const double limit = 7.3e-9;
  int failures = 0;
  printf("\n%-24s %10s\n", "200 steps of RK4", "apart");
  for (int which = 0; which < CASES; which++) {
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = baum_rk4();
    options.step = which < 2 ? 1e-5 : 1e-3;
    double worst = compare_runs(which, &options, STEPS * options.step);
    printf("%-24s %10.1e\n", NAMES[which], worst);
    failures += worst <= limit ? 0 : 1;
  }
  assert_int_equal(failures, 0);
}

static void variable_steps_differ_by_their_tolerance(void **state)
{
  (void)state;
  enum { METHODS = 4 };
  /* A build without SUNDIALS has only the first two methods. */
  const int methods_here = BAUM_HAVE_SUNDIALS ? METHODS : 2;
  int failures = 0;
  const baum_integrator *methods[METHODS] = {baum_dp5(), baum_rk8(), baum_cvode_adams(),
                                             baum_ida()};
  printf("\n%-24s %10s\n", "rtol 1e-8", "apart");
  for (int k = 0; k < methods_here * CASES; k++) {
    int which = k / methods_here;
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = methods[k % methods_here];
    options.rtol = 1e-8;
    double worst = compare_runs(which, &options, which < 2 ? 2e-3 : 0.2);
    printf("%-24s %-12s %10.1e\n", NAMES[which], baum_integrator_name(options.integrator), worst);
    /* Rounding changes the choice of steps. The results therefore differ by the error of the
     * method, which is larger for IDA. */
    failures += worst <= (options.integrator == baum_ida() ? 100.0 : 10.0) * options.rtol ? 0 : 1;
  }
  assert_int_equal(failures, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(configurations_after_many_revolutions_keep_twelve_digits),
    cmocka_unit_test(fixed_steps_differ_by_the_rounding_of_angles),
    cmocka_unit_test(variable_steps_differ_by_their_tolerance),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
