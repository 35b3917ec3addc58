/* SPDX-License-Identifier: BSD-3-Clause */
/* Every version of the format of saved runs has its own list of parts. This test fails if the list
 * changes but the version stays the same. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/digest.h"
#include "pendulum_events.h"
#include "runs.h"
#include "simulate/saved.h"

/* The checksums cover the sizes of all parts that a run saves. Never change a row of this table. If
 * sizes change, raise the version and add a row. Versions up to 8 had another kind of list. Version
 * 12 saves more angles of spatial joints than version 11. The run of this test has no spatial
 * joints, so both checksums are equal. Version 13 saves one more number of the monitors. Version 14
 * also saves the angles of springs in space, but the run of this test has no such springs. Version
 * 15 also saves the rates of events, and its fingerprint of the mechanism contains the joints that
 * definitions refer to. */
static const struct {
  int version;
  uint64_t list;
} VERSIONS[] = {{9, 0x448b4b059414f4fd},  {10, 0x448b4b059414f4fd}, {11, 0x492d9d0abb55ace3},
                {12, 0x492d9d0abb55ace3}, {13, 0x6634a5d176aadf59}, {14, 0x6634a5d176aadf59},
                {15, 0x14f2772d89e95364}};

enum { VERSION_COUNT = sizeof VERSIONS / sizeof *VERSIONS };

static uint64_t sum_of(const baum_i_saved *list)
{
  baum_i_digest sum = {0};
  for (int k = 0; k < list->count; k++) {
    const baum_i_saved_part *part = &list->parts[k];
    baum_i_digest_add_integer(&sum, (int64_t)part->unit);
    baum_i_digest_add_integer(&sum, part->least);
    baum_i_digest_add_integer(&sum, part->most);
    baum_i_digest_add_integer(&sum, part->counters);
  }
  return sum.value;
}

static void the_list_of_parts_agrees_with_the_version(void **state)
{
  (void)state;
  static baum_i_saved list;
  swing s = swing_make(1.0);
  baum_simulation_options o = baum_simulation_options_default();
  baum_event_def event = baum_event_def_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  o.energy_account = true;
  event.joint = s.pin;
  baum_simulation *run = create_run(s.mechanism, &o);
  assert_int_equal(baum_simulation_add_event(run, &event, NULL), BAUM_OK);
  baum_i_saved_list(run, &list);
  assert_non_null(run->account);
  assert_non_null(run->crossings);
  for (int k = 1; k < VERSION_COUNT; k++) {
    assert_true(VERSIONS[k].version > VERSIONS[k - 1].version);
  }
  assert_int_equal(VERSIONS[VERSION_COUNT - 1].version, BAUM_I_SAVED_VERSION);
  if (sum_of(&list) != VERSIONS[VERSION_COUNT - 1].list) {
    fail_msg(
      "the list of saved parts has changed: raise BAUM_I_SAVED_VERSION, add a row with 0x%llx",
      (unsigned long long)sum_of(&list));
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_list_of_parts_agrees_with_the_version),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
