/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs the free and the driven slider-crank forward and then backward in time. The runs use
 * stabilization, or IDA at higher index. Violations must not grow in either direction. After the
 * backward run, the error at the start must be comparable with the error at the far end, which is
 * the end of the forward run. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <baum/catalog.h>

#include "physics_run.h"
#include "slider_crank_driven_reference.h"

enum { FAR = 5, LOOKS = 200, NQ = SLIDER_CRANK_DRIVEN_WIDTH };

/* The largest violation of the backward run may be at most this many times the largest violation of
 * the forward run. Both violations come from local errors, which depend a little on the direction
 * and on the steps chosen. */
static const double MOST_VIOLATION = 4.0;
/* The error back at the start may be at most this many times the error at the far end. A ratio of 4
 * is expected. It is the sum of 1 from the position error at the far end, 2 from the velocity error
 * there, which acts for twice the time, and 1 from the backward run. The limit is larger, because
 * the error at the far end may be small by chance. */
static const double MOST_ERROR = 20.0;
/* The limits are increased by this value, which is the rounding error of about 1e4 steps. The
 * driven crank needs this, because its positions depend on time alone and have only rounding
 * errors. */
static const double ROUNDING = 1e-11;

typedef struct method {
  const baum_integrator *integrator;
  /* [s] NaN for variable steps. The sample times of tests/data are multiples of the step. */
  double step;
  double rtol;
  baum_formulation formulation;
} method;

typedef struct journey {
  double error[2]; /* at the far end, and back at the start */
  double phi[2];   /* largest violation in the forward and in the backward run */
} journey;

static double scaled_error(const baum_mechanism *mechanism, const double *q, const double *want)
{
  double scale = (double)NAN;
  double error = 0.0;
  check(baum_mechanism_get_characteristic_length(mechanism, &scale));
  for (int i = 0; i < NQ; i++) {
    error = fmax(error, fabs(q[i] - want[i]) / (i % 3 == 2 ? 1.0 : scale));
  }
  return error;
}

/* Advances the run and returns the largest violation at the output times. */
static double travel(const checked_run *checked, double from, double to)
{
  double phi[PHYSICS_NC];
  double largest = 0.0;
  for (int k = 1; k <= LOOKS; k++) {
    double t = k < LOOKS ? from + (to - from) * k / LOOKS : to;
    check(baum_simulation_advance_to(checked->run, t));
    evaluate_phi(checked, phi);
    largest = fmax(largest, largest_of(phi, checked->nc));
  }
  return largest;
}

static journey out_and_back(const model *m, const method *with, bool driven)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = with->integrator;
  options.formulation = with->formulation;
  options.step = with->step;
  options.rtol = with->rtol;
  checked_run checked = create_checked_run(m->mechanism, &options);
  double start[NQ];
  memcpy(start, baum_simulation_q(checked.run), sizeof start);
  double far = SLIDER_CRANK_DRIVEN_T[FAR];
  const baum_catalog_choice free_crank = {.name = "slider_crank_eccentric"};
  double want[NQ];
  memcpy(want, SLIDER_CRANK_DRIVEN_Q[FAR], sizeof want);
  check(driven ? BAUM_OK : baum_catalog_reference(&free_crank, far, want, NULL));
  journey out;
  out.phi[0] = travel(&checked, 0.0, far);
  out.error[0] = scaled_error(m->mechanism, baum_simulation_q(checked.run), want);
  out.phi[1] = travel(&checked, far, 0.0);
  out.error[1] = scaled_error(m->mechanism, baum_simulation_q(checked.run), start);
  destroy_checked_run(&checked);
  return out;
}

static void assert_returns(physics_mechanism which, const method *with)
{
  model m = build_mechanism(which);
  journey j = out_and_back(&m, with, which == DRIVEN_CRANK);
  printf("%-20s %-10s %-20s %8.0e   error there %.1e, back %.1e   max|Phi| out %.1e, back %.1e\n",
         baum_integrator_name(with->integrator), baum_formulation_name(with->formulation),
         mechanism_name(which), isnan(with->step) ? with->rtol : with->step, j.error[0], j.error[1],
         j.phi[0], j.phi[1]);
  (void)fflush(stdout);
  model_destroy(&m);
  /* If there are no degrees of freedom, the error at the far end may by chance be far below the
   * tolerance. A fraction of the tolerance is therefore added to the limit. */
  double by_chance = which == DRIVEN_CRANK && !isnan(with->rtol) ? 0.1 * with->rtol : 0.0;
  assert_true(j.phi[1] <= MOST_VIOLATION * j.phi[0] + ROUNDING);
  assert_true(j.error[1] <= MOST_ERROR * j.error[0] + by_chance + ROUNDING);
}

static void return_on_both(const baum_integrator *integrator, double step, double rtol)
{
  method with = {integrator, step, rtol, BAUM_FORMULATION_BAUMGARTE};
  assert_returns(FREE_CRANK, &with);
  assert_returns(DRIVEN_CRANK, &with);
}

static void explicit_euler_returns_to_its_start(void **state)
{
  (void)state;
  return_on_both(baum_euler(), 5e-6, (double)NAN);
}

static void semi_implicit_euler_returns_to_its_start(void **state)
{
  (void)state;
  return_on_both(baum_semi_implicit_euler(), 5e-6, (double)NAN);
}

static void rk4_returns_to_its_start(void **state)
{
  (void)state;
  return_on_both(baum_rk4(), 5e-5, (double)NAN);
}

static void runge_kutta_pairs_return_to_their_start(void **state)
{
  (void)state;
  const baum_integrator *const pairs[] = {baum_dp5(), baum_rk8()};
  for (int k = 0; k < 2; k++) {
    return_on_both(pairs[k], 5e-5, (double)NAN);
    return_on_both(pairs[k], (double)NAN, 1e-8);
  }
}

static void adams_returns_to_its_start(void **state)
{
  (void)state;
  need_sundials();
  return_on_both(baum_cvode_adams(), (double)NAN, 1e-8);
}

static void bdf_returns_to_its_start(void **state)
{
  (void)state;
  need_sundials();
  return_on_both(baum_cvode_bdf(), (double)NAN, 1e-8);
}

static void ida_at_index_1_returns_to_its_start(void **state)
{
  (void)state;
  need_sundials();
  return_on_both(baum_ida(), (double)NAN, 1e-8);
}

static void ida_with_ggl_and_at_index_2_returns_to_its_start(void **state)
{
  (void)state;
  need_sundials();
  const baum_formulation forms[] = {BAUM_FORMULATION_GGL, BAUM_FORMULATION_INDEX2};
  for (int f = 0; f < 2; f++) {
    method with = {baum_ida(), (double)NAN, 1e-8, forms[f]};
    assert_returns(FREE_CRANK, &with);
    assert_returns(DRIVEN_CRANK, &with);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(explicit_euler_returns_to_its_start),
    cmocka_unit_test(semi_implicit_euler_returns_to_its_start),
    cmocka_unit_test(rk4_returns_to_its_start),
    cmocka_unit_test(runge_kutta_pairs_return_to_their_start),
    cmocka_unit_test(adams_returns_to_its_start),
    cmocka_unit_test(bdf_returns_to_its_start),
    cmocka_unit_test(ida_at_index_1_returns_to_its_start),
    cmocka_unit_test(ida_with_ggl_and_at_index_2_returns_to_its_start),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
