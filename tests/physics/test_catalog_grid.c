/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the errors that two studies of the same mechanism compute. One study computes its own
 * references, and the other uses the references stored in the catalogue. This test covers only some
 * mechanisms; bench_catalog covers the whole catalogue. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "catalog_grid.h"

/* [s] Time limit of a run. Runs come near this limit only in slow builds. */
static const double LIMIT = 5.0;

static void judge(const char *name, const baum_integrator *integrator, catalog_tally *sum)
{
  baum_catalog_entry entry;
  assert_int_equal(baum_catalog_find(name, &entry, sizeof entry), BAUM_OK);
  baum_study_grid grid = baum_study_grid_default();
  grid.integrator = integrator;
  grid.settings = 3;
  catalog_tally one;
  assert_int_equal(catalog_grid_judge(&entry, &grid, LIMIT, &one), BAUM_OK);
  assert_int_equal(catalog_tally_wrong(&one), 0);
  catalog_tally_add(sum, &one);
}

static void computed_and_stored_references_give_the_same_errors(void **state)
{
  (void)state;
  const char *const names[] = {"slider_crank_simeon", "four_bar", "n_four_bar"};
  catalog_tally sum = {0};
  for (int k = 0; k < 3; k++) {
    judge(names[k], baum_semi_implicit_euler(), &sum);
    judge(names[k], baum_rk4(), &sum);
    judge(names[k], baum_rk8(), &sum);
  }
  /* Outcomes of all kinds must have occurred. */
  assert_true(sum.compared > sum.off && sum.off > 0);
  assert_true(sum.unstable > 0 && sum.at_floor > 0);
  print_message("%d entries, %d compared, %d off, %d unstable, %d at the floor\n", sum.entries,
                sum.compared, sum.off, sum.unstable, sum.at_floor);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(computed_and_stored_references_give_the_same_errors),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
