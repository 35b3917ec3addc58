/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares runs of the catalogue's spatial mechanisms with their references. The runs use dp5,
 * RATTLE and the methods of SUNDIALS. test_catalog.c does the same for rk8. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include <baum/baum.h>
#include <baum/catalog.h>

#include "check.h"
#include "runs.h"

static const char *const ENTRIES[] = {"spatial_slider_crank",
                                      "bricard",
                                      "flyball",
                                      "flyball_stiff",
                                      "heavy_top",
                                      "rssr",
                                      "robot_arm",
                                      "rolling_disc",
                                      "stewart",
                                      "differential",
                                      "gimbals",
                                      "double_wishbone"};

static double run(const char *entry, const baum_simulation_options *o)
{
  const baum_catalog_choice choice = {.name = entry};
  const baum_channel positions = baum_channel_of(BAUM_Q);
  baum_catalog_entry about;
  baum_mechanism *m = NULL;
  baum_catalog_error error;
  int32_t nq = 0;
  double times[32];
  check(baum_catalog_find(entry, &about, sizeof about));
  assert_true(about.sample_count <= 32);
  check(baum_catalog_times(entry, times));
  check(baum_catalog_build(&choice, &m));
  check(baum_mechanism_sizes(m, &nq, NULL, NULL));
  double *q = calloc((size_t)about.sample_count * (size_t)nq, sizeof *q);
  assert_non_null(q);
  baum_simulation *s = create_run(m, o);
  if (baum_simulation_sample(s, times, about.sample_count, &positions, 1, q, NULL) < BAUM_OK) {
    fail_msg("%s: %s", entry, baum_simulation_message(s));
  }
  check(baum_catalog_compare(&choice, m, times, about.sample_count, q, NULL, &error, sizeof error));
  printf("%-22s %-20s %-11s error %.1e\n", entry, baum_integrator_name(o->integrator),
         baum_formulation_name(o->formulation), error.q);
  free(q);
  baum_simulation_destroy(s);
  baum_mechanism_destroy(m);
  return error.q;
}

static void check_all(const baum_integrator *integrator, baum_formulation formulation, double most)
{
  for (size_t k = 0; k < sizeof ENTRIES / sizeof *ENTRIES; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = integrator;
    o.formulation = formulation;
    o.rtol = 1e-10;
    assert_true(run(ENTRIES[k], &o) < most);
  }
}

static void every_method_reaches_the_references(void **state)
{
  (void)state;
  check_all(baum_dp5(), BAUM_FORMULATION_PROJECTION, 1e-6);
#if BAUM_HAVE_SUNDIALS
  /* The largest error measured is 4e-6. It occurs for the spatial slider-crank after thousands of
   * steps. */
  check_all(baum_cvode_bdf(), BAUM_FORMULATION_PROJECTION, 1e-5);
  check_all(baum_ida(), BAUM_FORMULATION_GGL, 1e-5);
#endif
}

/* RATTLE refuses dampers, so the two flyball governors are not in this list. */
static void rattle_converges_to_the_references_with_its_order(void **state)
{
  (void)state;
  static const char *const taken[] = {"spatial_slider_crank", "bricard", "gimbals"};
  for (size_t k = 0; k < sizeof taken / sizeof *taken; k++) {
    double error[2];
    for (int i = 0; i < 2; i++) {
      baum_simulation_options o = baum_simulation_options_default();
      o.integrator = baum_rattle();
      o.step = i == 0 ? 1e-3 : 5e-4;
      error[i] = run(taken[k], &o);
    }
    assert_true(error[1] < 1e-3);
    assert_true(fabs(error[0] / error[1] - 4.0) < 0.2);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_method_reaches_the_references),
    cmocka_unit_test(rattle_converges_to_the_references_with_its_order),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
