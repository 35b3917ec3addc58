/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests that a tolerance is refused if the integrator and the formulation do not use it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "every_element.h"
#include "runs.h"

/* Only IDA at index 1 has multipliers in its error test. */
static void tolerances_of_multipliers_are_refused_where_nothing_tests_them(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  for (int32_t k = 0; baum_integrator_at(k) != NULL; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_integrator_at(k);
    bool fixed = baum_integrator_has_fixed_step(o.integrator);
    o.step = fixed ? 1e-3 : (double)NAN;
    o.rtol = fixed ? (double)NAN : 1e-6;
    o.tolerance_lambda = 10.0;
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      o.formulation = (baum_formulation)f;
      if (!baum_integrator_offers(o.integrator, o.formulation)) {
        continue;
      }
      if (o.integrator != baum_ida()) {
        check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                          "tolerance_lambda is 10, but|has no multipliers among its unknowns");
      } else if (f != BAUM_FORMULATION_UNSTABILIZED && f != BAUM_FORMULATION_BAUMGARTE) {
        check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                          "tolerance_lambda is 10, but with the formulation|cannot be tested");
      }
    }
  }
  baum_mechanism_destroy(parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(tolerances_of_multipliers_are_refused_where_nothing_tests_them),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
