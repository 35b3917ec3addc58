/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs the grid of stress settings as a study. Every entry must either meet its tolerance, or have
 * a warning or a message. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "models.h"
#include "study_entries.h"

static const double SPAN = 2.0;

static baum_study *stress_of(const baum_mechanism *mechanism, const baum_integrator *integrator)
{
  baum_study *study = NULL;
  baum_study_options o = small_study_options();
  o.validate = false;
  o.entry_limit = 0.05;
  assert_int_equal(baum_study_create(mechanism, 0.0, SPAN, &study), BAUM_OK);
  assert_int_equal(baum_study_set_options(study, &o), BAUM_OK);
  assert_int_equal(baum_study_add_stress(study, integrator), BAUM_OK);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  return study;
}

/* Returns the largest error that an entry without a warning may have. With a fixed step it is 0.1.
 * Otherwise it is 10 rtol for each step, plus rounding. */
static double promise(const baum_study_entry *entry)
{
  const double rounding = 1e-12;
  return isnan(entry->rtol) ? 0.1 : 10.0 * entry->rtol * (double)entry->steps + rounding;
}

static void check_entry(const baum_study_entry *entry)
{
  assert_int_not_equal(entry->state, BAUM_STUDY_WAITING);
  if (entry->state != BAUM_STUDY_DONE) {
    assert_string_not_equal(entry->message, "");
  } else if (entry->warnings == 0 && !(entry->error <= promise(entry))) {
    fail_msg("%s is off by %g silently", entry->name, entry->error);
  }
}

static void no_entry_is_silently_wrong(void **state)
{
  static const struct {
    const baum_integrator *(*integrator)(void);
    int entries;
  } TRIED[] = {{baum_rk4, 9 + 20}, {baum_rk8, 9 + 13 + 20}, {baum_cvode_adams, 13 + 20}};
  const model *m = *state;
  int seen[5] = {0};
  for (size_t k = 0; k < sizeof TRIED / sizeof TRIED[0]; k++) {
    if (!baum_has("sundials") && TRIED[k].integrator == baum_cvode_adams) {
      continue;
    }
    baum_study *study = stress_of(m->mechanism, TRIED[k].integrator());
    assert_int_equal(baum_study_entry_count(study), TRIED[k].entries);
    for (int r = 0; r < TRIED[k].entries; r++) {
      baum_study_entry entry = study_entry(study, r);
      check_entry(&entry);
      seen[entry.state]++;
    }
    baum_study_destroy(study);
  }
  assert_true(seen[BAUM_STUDY_DONE] > 0);
  assert_true(seen[BAUM_STUDY_REFUSED] > 0); /* for example rk4 with unstable gains */
  assert_true(seen[BAUM_STUDY_TIMED_OUT] > 0);
}

static void refused_additions_add_no_entries(void **state)
{
  const model *m = *state;
  baum_study *study = NULL;
  assert_int_equal(baum_study_add_stress(NULL, baum_rk4()), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_study_create(m->mechanism, 0.0, SPAN, &study), BAUM_OK);
  assert_int_equal(baum_study_add_stress(study, baum_kinematics()), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "no kinematics with a step or a tolerance"));
  assert_int_equal(baum_study_entry_count(study), 0);
  assert_int_equal(baum_study_method_count(study), 0);
  baum_study_destroy(study);
}

static int build_pendulum(void **state)
{
  static model m;
  *state = &m;
  return model_pendulum_rod(&MODEL_PENDULUM_A01, &m) == BAUM_OK ? 0 : -1;
}

static int destroy_pendulum(void **state)
{
  model_destroy(*state);
  return 0;
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(no_entry_is_silently_wrong),
    cmocka_unit_test(refused_additions_add_no_entries),
  };
  return cmocka_run_group_tests(tests, build_pendulum, destroy_pendulum);
}
