/* SPDX-License-Identifier: BSD-3-Clause */
#include "saved_scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "driven.h"
#include "every_element.h"
#include "models.h"
#include "spatial_scenes.h"
#include "step_mode.h"

double saved_random(int k)
{
  double x = 0.5 + 0.6180339887498949 * k; /* the golden section */
  return x - floor(x);
}

bool saved_reached(baum_status status)
{
  return status == BAUM_OK || status == BAUM_WARNED;
}

/* ---- mechanisms ---- */

/* Replaces the law of the motor by a quadratic polynomial. This polynomial continues the law with
 * the same value, velocity and acceleration. */
static baum_status lead_on(baum_simulation *run, const saved_scene *scene)
{
  double t = baum_simulation_time(run);
  return baum_simulation_set_driver(run, scene->motor, 0.5 + t * (2.0 + 0.15 * t), 2.0 + 0.3 * t,
                                    0.3);
}

static void open_every_element(saved_scene *scene)
{
  const double breaks[] = {0.013, 0.0991, 0.21, 0.2222};
  every_element parts = {0};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  assert_int_equal(baum_mechanism_add_break_times(parts.mechanism, breaks, 4), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(parts.mechanism), BAUM_OK);
  scene->mechanism = parts.mechanism;
  scene->has_input = true;
  scene->input = parts.throttle;
  scene->motor = parts.motor;
  scene->law = lead_on;
}

static void open_slider_crank(saved_scene *scene, bool doubled)
{
  model m;
  const model_slider_crank options = {.doubled_guide = doubled, .frames = 2};
  assert_int_equal(model_slider_crank_build(options, &m), BAUM_OK);
  scene->mechanism = m.mechanism;
  m.mechanism = NULL;
  model_destroy(&m);
  scene->span = 1e-2;
}

static void open_driven(saved_scene *scene)
{
  const drive motor = {.angle = 0.4, .rate = 1.0};
  scene->mechanism = four_bar_make(&motor);
  scene->span = 0.2;
}

/* ---- the list ---- */

/* Opens scene `number` of a list that has one scene for each formulation of each integrator. The
 * mechanism is one that the integrator supports. */
static bool open_pair(saved_scene *scene, int *number)
{
  for (int i = 0; step_mode_at(i).integrator; i++) {
    step_mode mode = step_mode_at(i);
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      baum_formulation formulation = (baum_formulation)f;
      if (!baum_integrator_offers(mode.integrator, formulation) || (*number)-- != 0) {
        continue;
      }
      double rtol = formulation == BAUM_FORMULATION_INDEX3 ? 1e-4 : 1e-6;
      scene->options = step_mode_options(mode, 1e-3, rtol);
      scene->options.formulation = formulation;
      if (every_element_suits(mode.integrator)) {
        open_every_element(scene);
      } else {
        open_slider_crank(scene, false);
        scene->options.step = 1e-4;
      }
      return true;
    }
  }
  return false;
}

/* Opens a scene with two coupled four-bars and events. The motion passes through two singular
 * configurations per revolution. */
static bool open_singular(saved_scene *scene, int number)
{
  const baum_integrator *const methods[] = {baum_rk4(), baum_rk8(), baum_ab4(), baum_ida()};
  if (number >= 3 + (baum_has("sundials") ? 1 : 0)) {
    return false;
  }
  baum_simulation_options *o = &scene->options;
  model m;
  const model_n_four_bar data = model_n_four_bar_a02(2);
  assert_int_equal(model_n_four_bar_build(&data, &m), BAUM_OK);
  bool fixed = number % 2 == 0;
  o->integrator = methods[number];
  o->step = fixed ? 2e-3 : (double)NAN;
  o->rtol = fixed ? (double)NAN : 1e-7;
  scene->watched = m.joints[0];
  scene->mechanism = m.mechanism;
  m.mechanism = NULL;
  model_destroy(&m);
  scene->passes = 1.0;
  scene->span = 0.2;
  return true;
}

/* Opens the other scenes. They have other solvers, redundant rows, fixed bodies, the energy
 * account, the kinematics integrator, and RATTLE in space. */
static bool open_other(saved_scene *scene, int number)
{
  static const baum_solver solvers[] = {BAUM_SOLVER_KLU, BAUM_SOLVER_QR, BAUM_SOLVER_BLOCK};
  baum_simulation_options *o = &scene->options;
  *o = baum_simulation_options_default();
  o->integrator = baum_rk4();
  o->step = 1e-4;
  scene->times = 100;
  if (number < 6) {
    o->solver = solvers[number / 2];
    open_slider_crank(scene, number % 2 == 1);
    return true;
  }
  switch (number) {
  case 6: /* the energy account with a fixed step */
    open_every_element(scene);
    o->step = 1e-3;
    o->energy_account = true;
    return true;
  case 7: /* the energy account with a variable step */
    open_every_element(scene);
    o->integrator = baum_rk8();
    o->step = (double)NAN;
    o->rtol = 1e-6;
    o->energy_account = true;
    return true;
  case 8:
    open_driven(scene);
    o->integrator = baum_kinematics();
    o->step = (double)NAN;
    return true;
  /* Spatial bodies with RATTLE, because RATTLE does not support the mechanism that has every
   * element. */
  case 9:
    scene->mechanism = spatial_make_rssr();
    o->integrator = baum_rattle();
    return true;
  default: return open_singular(scene, number - 10);
  }
}

bool saved_scene_open(saved_scene *scene, int number)
{
  *scene = (saved_scene){.times = 100, .span = 5e-3};
  bool is_pair = open_pair(scene, &number);
  if (!is_pair && !open_other(scene, number)) {
    return false;
  }
  assert_int_equal(baum_mechanism_sizes(scene->mechanism, &scene->nq, &scene->nv, NULL), BAUM_OK);
  assert_in_range(scene->nq, scene->nv, SAVED_NQ_MAX);
  const baum_simulation_options *o = &scene->options;
  const char *formulation = baum_formulation_name(o->formulation);
  (void)snprintf(scene->name, sizeof scene->name, "%s %s %s, solver %d%s",
                 baum_integrator_name(o->integrator), isnan(o->step) ? "variable" : "fixed",
                 formulation, (int)o->solver, o->energy_account ? ", account" : "");
  return true;
}

void saved_scene_close(saved_scene *scene)
{
  baum_mechanism_destroy(scene->mechanism);
  scene->mechanism = NULL;
}

baum_simulation *saved_scene_start(const saved_scene *scene)
{
  baum_simulation *run = NULL;
  baum_status status = baum_simulation_create(scene->mechanism, &scene->options, &run);
  if (status != BAUM_OK) {
    fail_msg("%s: %s", scene->name, baum_message());
  }
  if (scene->watched.index1 != 0) {
    baum_event_def event = baum_event_def_default();
    event.joint = scene->watched;
    event.value = scene->passes;
    event.terminal = false;
    assert_int_equal(baum_simulation_add_event(run, &event, NULL), BAUM_OK);
  }
  return run;
}
