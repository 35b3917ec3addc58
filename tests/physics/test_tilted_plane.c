/* SPDX-License-Identifier: BSD-3-Clause */
/* Builds spatial twins of planar mechanisms of the catalogue. A twin is the same mechanism made of
 * spatial elements in a tilted plane. It is compared with the planar reference. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/catalog.h>

#include "check.h"
#include "runs.h"
#include "tilt.h"

enum { MOST_BODIES = 7 };

/* An entry of the catalogue, and how many closed loops its spatial twin has. */
typedef struct tilted {
  const char *entry;
  int loops;
} tilted;

static const tilted ENTRIES[] = {
  {"four_bar", 1}, {"slider_crank", 1}, {"slider_crank_driven", 1}, {"andrews_bodies", 3}};

static baum_mechanism *build(const char *entry)
{
  const baum_catalog_choice choice = {.name = entry};
  baum_mechanism *planar = NULL;
  baum_mechanism *out = NULL;
  check(baum_catalog_build(&choice, &planar));
  check(model_tilt(planar, 0.0, &out));
  baum_mechanism_destroy(planar);
  return out;
}

static void loops_have_three_redundant_rows(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof ENTRIES / sizeof *ENTRIES; k++) {
    baum_mobility mobility;
    baum_mechanism *m = build(ENTRIES[k].entry);
    check(baum_mechanism_mobility(m, &mobility, sizeof mobility));
    assert_int_equal(mobility.redundant_rows, 3 * ENTRIES[k].loops);
    assert_int_equal(mobility.degrees_of_freedom, k == 2 ? 0 : 1);
    baum_mechanism_destroy(m);
  }
}

/* Returns the largest error of all bodies. Errors of positions are relative to `length`. Errors of
 * angles are in rad, modulo 2 pi. */
static double error_at(const baum_catalog_choice *choice, const baum_simulation *run, int bodies,
                       double t, double length)
{
  double want[3 * MOST_BODIES];
  double error = 0.0;
  check(baum_catalog_reference(choice, t, want, NULL));
  for (int k = 0; k < bodies; k++) {
    double pose[3];
    double off[2];
    model_untilt_body(baum_simulation_q(run) + (ptrdiff_t)7 * k, pose, off);
    double turned = remainder(pose[2] - want[3 * k + 2], 2.0 * acos(-1.0));
    error = fmax(error, hypot(pose[0] - want[3 * k], pose[1] - want[3 * k + 1]) / length);
    error = fmax(error, fmax(fabs(turned), fmax(off[0] / length, off[1])));
  }
  return error;
}

static void tilted_mechanisms_move_like_planar_mechanisms(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof ENTRIES / sizeof *ENTRIES; k++) {
    const baum_catalog_choice choice = {.name = ENTRIES[k].entry};
    baum_mechanism *m = build(choice.name);
    baum_catalog_entry entry;
    double times[32];
    double length = 0.0;
    double worst = 0.0;
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_rk8();
    o.formulation = BAUM_FORMULATION_PROJECTION;
    o.rtol = 1e-13;
    check(baum_catalog_find(choice.name, &entry, sizeof entry));
    check(baum_catalog_times(choice.name, times));
    check(baum_mechanism_get_characteristic_length(m, &length));
    baum_simulation *run = create_run(m, &o);
    for (int i = 0; i < entry.sample_count; i++) {
      check(baum_simulation_advance_to(run, times[i]));
      worst = fmax(worst, error_at(&choice, run, baum_mechanism_body_count(m), times[i], length));
    }
    printf("%-20s in a tilted plane: error %.1e\n", choice.name, worst);
    assert_true(worst <= 1e-10);
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

/* The rows that hold the bodies in the plane contain only rounding errors. Their multipliers are
 * therefore amplified rounding errors. The QR solver must accept this. */
static void qr_solves_rows_that_contain_only_rounding(void **state)
{
  (void)state;
  baum_mechanism *m = build("four_bar");
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rattle();
  o.formulation = BAUM_FORMULATION_INDEX3;
  o.solver = BAUM_SOLVER_QR;
  o.step = 1e-3;
  baum_simulation *run = create_run(m, &o);
  /* The warning is about redundant rows. */
  assert_int_equal(baum_simulation_advance_to(run, 2.0), BAUM_WARNED);
  assert_true(baum_simulation_time(run) == 2.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* ---- singular configurations ---- */

static baum_counters counters_at(const baum_catalog_choice *choice,
                                 const baum_integrator *integrator, double end, baum_status *status)
{
  baum_mechanism *planar = NULL;
  baum_mechanism *m = NULL;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.rtol = 1e-7;
  check(baum_catalog_build(choice, &planar));
  check(model_tilt(planar, 0.0, &m));
  baum_simulation *run = create_run(m, &o);
  *status = baum_simulation_advance_to(run, end);
  if (*status < BAUM_OK) {
    assert_non_null(strstr(baum_simulation_message(run), "singular"));
  }
  baum_counters counters = counters_of(run);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  baum_mechanism_destroy(planar);
  return counters;
}

/* The rod is longer than the crank by 1e-12. The folded configuration is therefore nearly singular.
 * One step of rk8 passes over it. Near this configuration, the omitted rows are not the same as
 * elsewhere. The crossing must be reported nevertheless. */
static void crossings_are_reported_where_the_omitted_rows_change(void **state)
{
  (void)state;
  static const baum_catalog_setting data[] = {{"crank", 1.0},
                                              {"rod", 1.0 + 1e-12},
                                              {"crank_mass", 1.0},
                                              {"rod_mass", 1.0},
                                              {"slider_mass", 1.0},
                                              {"crank_inertia", 1.0 / 12},
                                              {"rod_inertia", 1.0 / 12},
                                              {"slider_inertia", 1e-3},
                                              {"angle", 0.3},
                                              {"speed", 6.0}};
  const baum_catalog_choice choice = {"slider_crank", data, sizeof data / sizeof *data};
  baum_status status = BAUM_OK;
  baum_counters counters = counters_at(&choice, baum_rk8(), 0.6374, &status);
  check(status);
  assert_int_equal(counters.near_singular_intervals, 1);
}

#if BAUM_HAVE_SUNDIALS
/* Five cranks fall through the horizontal configuration twice. This configuration is singular. The
 * second time, the run continues on a branch on which all configurations are singular. The second
 * near-singular interval therefore does not end. */
static void a_branch_of_singular_configurations_is_reported(void **state)
{
  (void)state;
  static const baum_catalog_setting data[] = {{"windows", 4}, {"angle", 1.0}, {"rate", -2.0}};
  const baum_catalog_choice choice = {"n_four_bar", data, 3};
  baum_status status = BAUM_OK;
  baum_counters counters = counters_at(&choice, baum_cvode_adams(), 0.932395316, &status);
  /* On such a branch, rounding errors decide whether the run can continue. If the initial angular
   * velocity is changed by multiples of 1e-13, about a third of the runs stop. A run that stops
   * must return BAUM_ERR_STEP or BAUM_ERR_SINGULAR, and must have reported the first interval. */
  assert_true(status >= BAUM_OK || status == BAUM_ERR_STEP || status == BAUM_ERR_SINGULAR);
  assert_in_range(counters.near_singular_intervals, status >= BAUM_OK ? 2 : 1, 2);
}
#endif

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(loops_have_three_redundant_rows),
    cmocka_unit_test(tilted_mechanisms_move_like_planar_mechanisms),
    cmocka_unit_test(qr_solves_rows_that_contain_only_rounding),
    cmocka_unit_test(crossings_are_reported_where_the_omitted_rows_change),
#if BAUM_HAVE_SUNDIALS
    cmocka_unit_test(a_branch_of_singular_configurations_is_reported),
#endif
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
