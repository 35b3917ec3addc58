/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares runs with reference motions that avoid singular configurations. The runs use dp5 and rk8
 * with projection, at rtol from 1e-4 to 1e-12. These integrators do not need SUNDIALS. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "a01_pendulum_reference.h"
#include "assert_near.h"
#include "catalog/data/andrews.h"
#include "catalog/data/car_axis.h"
#include "catalog/data/chain.h"
#include "catalog/data/four_bar.h"
#include "catalog/data/slider_crank_eccentric.h"
#include "catalog/data/slider_crank_sundials.h"
#include "reference_test.h"
#include "slider_crank_driven_reference.h"
#include "sundials_pendulum_reference.h"

/* ---- the problems ---- */

static baum_status build_a01(model *m)
{
  return model_pendulum_rod(&MODEL_PENDULUM_A01, m);
}

static baum_status build_swing(model *m)
{
  return model_pendulum_rod(&MODEL_PENDULUM_SUNDIALS, m);
}

static baum_status build_free_crank(model *m)
{
  return model_slider_crank_build((model_slider_crank){.driven = false}, m);
}

static baum_status build_driven_crank(model *m)
{
  return model_slider_crank_build((model_slider_crank){.driven = true}, m);
}

static baum_status build_angles(model *m)
{
  return model_andrews_angles(true, m);
}

static baum_status build_axis(model *m)
{
  return model_car_axis(true, m);
}

static baum_status build_chain(model *m)
{
  return model_chain_3(m);
}

#define REFERENCE(title, NAME, units)                                                 \
  {                                                                                   \
    .name = (title), .samples = NAME##_SAMPLES, .width = NAME##_WIDTH, .t = NAME##_T, \
    .q = NAME##_Q[0], .lengths = (units)                                              \
  }

/* A problem, and the errors that are allowed for dp5 and for rk8. The limits for the pendulum and
 * the chain are larger, because their motions are long, and errors of 1e-12 in each step add up or
 * grow. */
typedef struct problem {
  reference with;
  baum_status (*build)(model *m);
  double dp5;
  double rk8;
} problem;

#define OF_CATALOG(title, NAME, of, units)                                                 \
  {                                                                                        \
    .name = (title), .samples = NAME##_SAMPLES, .width = sizeof(units) - 1, .t = NAME##_T, \
    .entry = (of), .lengths = (units)                                                      \
  }

static const problem PROBLEMS[] = {
  {REFERENCE("A01 pendulum", A01_PENDULUM, "mm"), build_a01, 1e-9, 1e-10},
  {REFERENCE("SUNDIALS pendulum", SUNDIALS_PENDULUM, "mm"), build_swing, 1e-8, 1e-9},
  {OF_CATALOG("free slider-crank", SLIDER_CRANK_ECCENTRIC, "slider_crank_eccentric", "mmrmmrmmr"),
   build_free_crank, 1e-9, 1e-10},
  {REFERENCE("driven slider-crank", SLIDER_CRANK_DRIVEN, "mmrmmrmmr"), build_driven_crank, 1e-10,
   1e-10},
  {REFERENCE("Andrews, 7 angles", ANDREWS, "rrrrrrr"), build_angles, 1e-10, 1e-10},
  {REFERENCE("Andrews, 7 bodies", ANDREWS, "rrrrrrr"), model_andrews_bodies, 1e-10, 1e-10},
  {REFERENCE("car axis", CAR_AXIS, "mmmm"), build_axis, 1e-10, 1e-10},
  {OF_CATALOG("chain N = 3", CHAIN, "chain_3", "mmrmmrmmr"), build_chain, 1e-8, 1e-9},
  {OF_CATALOG("four-bar", FOUR_BAR, "four_bar", "mmrmmrmmr"), model_four_bar, 1e-9, 1e-9},
  {OF_CATALOG("SUNDIALS slider-crank", SUNDIALS_SLIDER_CRANK, "slider_crank_sundials", "mmrmmr"),
   model_sundials_slider_crank, 1e-10, 1e-10},
};

enum { COUNT = sizeof PROBLEMS / sizeof PROBLEMS[0] };

static void reach_all(const baum_integrator *integrator)
{
  for (int k = 0; k < COUNT; k++) {
    model m;
    reference with = PROBLEMS[k].with;
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = integrator;
    if (PROBLEMS[k].build == model_andrews_bodies) {
      with.columns = model_andrews_from_bodies;
    }
    assert_int_equal(PROBLEMS[k].build(&m), BAUM_OK);
    double wanted = integrator == baum_dp5() ? PROBLEMS[k].dp5 : PROBLEMS[k].rk8;
    assert_reached(&with, m.mechanism, &options, wanted);
    model_destroy(&m);
  }
}

static void dp5_reaches_all_references(void **state)
{
  (void)state;
  reach_all(baum_dp5());
}

static void rk8_reaches_all_references(void **state)
{
  (void)state;
  reach_all(baum_rk8());
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(dp5_reaches_all_references),
    cmocka_unit_test(rk8_reaches_all_references),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
