/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs IDA from many initial configurations, with all formulations and with many tolerances. No run
 * may fail, and the final configurations must agree with those of CVODE. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "physics_run.h"
#include "runs.h"

enum { NQ_MAX = 21, FORMULATION_COUNT = 5, LOOSEST = 6, TIGHTEST = 13 };

static const baum_formulation FORMULATIONS[FORMULATION_COUNT] = {
  BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED, BAUM_FORMULATION_INDEX3,
  BAUM_FORMULATION_GGL,       BAUM_FORMULATION_INDEX2,
};

/* The largest allowed values of the final error divided by rtol, for each of FORMULATIONS. Lengths
 * are in m, and angles in rad. Driven mechanisms have no degrees of freedom, so stabilization
 * corrects their errors. In free mechanisms, errors grow during two revolutions or a swing. At
 * index 3 the error test omits velocities. In the order of FORMULATIONS, the measured values were
 * 0.7, 460, 0.1, 0.04 and 13 for driven mechanisms, and 760, 800, 1.2e5, 3.1e3 and 1.8e3 for free
 * ones. The limits are four to ten times as large, because the results change with rounding. */
static const double MOST_DRIVEN_ERROR[FORMULATION_COUNT] = {5.0, 3e3, 1.0, 0.4, 1e2};
static const double MOST_FREE_ERROR[FORMULATION_COUNT] = {5e3, 5e3, 5e5, 2e4, 1e4};
/* Errors are only judged if rtol >= 10^-TIGHTEST_JUDGED. At tighter tolerances, the errors also
 * contain rounding and the error of the reference. */
static const int TIGHTEST_JUDGED = 10;

typedef struct end {
  baum_status status;
  double q[NQ_MAX];
  baum_counters counters;
} end;

static end run_to(const model *m, const baum_simulation_options *options, double t)
{
  end out = {0};
  int32_t nq = 0;
  check(baum_mechanism_sizes(m->mechanism, &nq, NULL, NULL));
  assert_true(nq <= NQ_MAX);
  baum_simulation *run = create_run(m->mechanism, options);
  out.status = baum_simulation_advance_to(run, t);
  memcpy(out.q, baum_simulation_q(run), (size_t)nq * sizeof *out.q);
  out.counters = counters_of(run);
  baum_simulation_destroy(run);
  return out;
}

static end find_reference(const model *m, double t)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_cvode_adams();
  options.rtol = 1e-12;
  end out = run_to(m, &options, t);
  check(out.status);
  return out;
}

static double largest_difference(const end *one, const end *other)
{
  double largest = 0.0;
  for (int i = 0; i < NQ_MAX; i++) {
    largest = fmax(largest, fabs(one->q[i] - other->q[i]));
  }
  return largest;
}

/* Results of the runs from all initial configurations of a mechanism. There is one such struct for
 * each formulation and each rtol = 10^-k. */
typedef struct tally {
  int runs;
  int64_t steps;
  int64_t iterations;
  int64_t rejected;
  double error; /* largest error / rtol */
} tally;

typedef struct table {
  const char *name;
  int tightest;
  const double *most;
  tally sums[FORMULATION_COUNT][TIGHTEST + 1];
} table;

static void run_one(table *out, const model *m, double t, const end *reference, int f, int k)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_ida();
  options.formulation = FORMULATIONS[f];
  options.rtol = pow(10.0, -k);
  end found = run_to(m, &options, t);
  if (found.status < BAUM_OK) {
    fail_msg("%s, %s, rtol %g: %s", out->name, baum_formulation_name(FORMULATIONS[f]), options.rtol,
             baum_message());
  }
  tally *sum = &out->sums[f][k];
  sum->error = fmax(sum->error, largest_difference(&found, reference) / options.rtol);
  sum->runs++;
  sum->steps += found.counters.steps;
  sum->iterations += found.counters.nonlinear_iterations;
  sum->rejected += found.counters.rejected;
}

static void run_all(table *out, const model *m, double t)
{
  end reference = find_reference(m, t);
  for (int f = 0; f < FORMULATION_COUNT; f++) {
    for (int k = LOOSEST; k <= out->tightest; k++) {
      run_one(out, m, t, &reference, f, k);
    }
  }
}

static void judge(const table *found)
{
  for (int f = 0; f < FORMULATION_COUNT; f++) {
    for (int k = LOOSEST; k <= found->tightest; k++) {
      const tally *sum = &found->sums[f][k];
      const char *formulation = baum_formulation_name(FORMULATIONS[f]);
      print_message("%-12s %-12s 1e-%02d %6.0f steps %6.2f iterations each %4.0f rejected, error "
                    "%.1e rtol\n",
                    found->name, formulation, k, (double)sum->steps / sum->runs,
                    (double)sum->iterations / (double)sum->steps, (double)sum->rejected / sum->runs,
                    sum->error);
      if (k <= TIGHTEST_JUDGED && !(sum->error <= found->most[f])) {
        fail_msg("%s, %s, rtol 1e-%02d: error %.2g rtol", found->name, formulation, k, sum->error);
      }
    }
  }
}

/* ---- slider-cranks: two revolutions, from start angles all around the circle ---- */

static void turn(table *out, bool driven, int poses)
{
  for (int k = 0; k < poses; k++) {
    model m;
    check(model_slider_crank_build(
      (model_slider_crank){.driven = driven, .moving = true, .angle = -3.1 + k * (6.2 / poses)},
      &m));
    run_all(out, &m, 0.1);
    model_destroy(&m);
  }
  judge(out);
}

static void a_driven_crank_runs_from_all_angles_at_all_tolerances(void **state)
{
  (void)state;
  need_sundials();
  table out = {.name = "driven crank", .tightest = 10, .most = MOST_DRIVEN_ERROR};
  turn(&out, true, 40);
}

static void a_free_crank_runs_from_all_angles_at_all_tolerances(void **state)
{
  (void)state;
  need_sundials();
  table out = {.name = "free crank", .tightest = 10, .most = MOST_FREE_ERROR};
  turn(&out, false, 12);
}

/* ---- other mechanisms, with tolerances down to rounding ---- */

static void move(const char *name, baum_status built, model *m, double t)
{
  table out = {.name = name, .tightest = TIGHTEST, .most = MOST_FREE_ERROR};
  check(built);
  run_all(&out, m, t);
  model_destroy(m);
  judge(&out);
}

static void andrews_mechanism_runs_at_all_tolerances(void **state)
{
  (void)state;
  need_sundials();
  model m;
  move("Andrews", model_andrews_bodies(&m), &m, 0.03);
}

static void a_four_bar_runs_at_all_tolerances(void **state)
{
  (void)state;
  need_sundials();
  model m;
  move("four-bar", model_four_bar(&m), &m, 2.0);
}

static void a_chain_runs_at_all_tolerances(void **state)
{
  (void)state;
  need_sundials();
  model m;
  move("chain", model_chain_3(&m), &m, 1.0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_driven_crank_runs_from_all_angles_at_all_tolerances),
    cmocka_unit_test(a_free_crank_runs_from_all_angles_at_all_tolerances),
    cmocka_unit_test(andrews_mechanism_runs_at_all_tolerances),
    cmocka_unit_test(a_four_bar_runs_at_all_tolerances),
    cmocka_unit_test(a_chain_runs_at_all_tolerances),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
