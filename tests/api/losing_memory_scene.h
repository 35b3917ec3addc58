/* SPDX-License-Identifier: BSD-3-Clause */
/* Objects on which test_calls_losing_memory.c calls functions. Include after cmocka.h. */
#ifndef BAUM_TEST_LOSING_MEMORY_SCENE_H
#define BAUM_TEST_LOSING_MEMORY_SCENE_H

#include <string.h>

#include "every_element.h"
#include "models.h"
#include "runs.h"

/* ---- scenes, which contain the objects of a call ---- */

/* The stage of a scene tells which objects a call needs. A scene of one stage also has the objects
 * of the stages before it. STUDIED is an exception: a scene of this stage has only a study of a
 * pendulum. */
typedef enum stage { NOTHING, OPEN, FROZEN, RUNNING, STUDIED } stage;

typedef struct scene {
  stage stage;
  every_element parts;
  baum_workspace *w;
  double q[EVERY_NQ];
  double v[EVERY_NV];
  double y[EVERY_NQ + EVERY_NV + 2 * EVERY_NC];
  baum_simulation *run;
  /* A run that has a schedule and a new law of a driver. Its time is later than the time of
   * `run`. */
  baum_simulation *from;
  model pendulum;
  baum_study *study;
} scene;

static baum_simulation_options rk4_options(double step)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = step;
  return o;
}

static baum_simulation *start(const scene *s)
{
  const baum_simulation_options o = rk4_options(1e-3);
  return create_run(s->parts.mechanism, &o);
}

static baum_status schedule(const scene *s, baum_simulation *run)
{
  const double times[2] = {6e-3, 8e-3};
  const double values[2] = {0.9, 1.1};
  return baum_simulation_schedule_input(run, s->parts.throttle, times, values, 2);
}

static baum_status drive(const scene *s, baum_simulation *run)
{
  return baum_simulation_set_driver(run, s->parts.motor, 0.5, 2.0, 0.3);
}

static void make_runs(scene *s)
{
  s->run = start(s);
  s->from = start(s);
  assert_int_equal(drive(s, s->from), BAUM_OK);
  assert_int_equal(schedule(s, s->from), BAUM_OK);
}

static void make_study(scene *s)
{
  baum_study_options o = baum_study_options_default();
  o.samples = 3;
  o.repeats = 1;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &s->pendulum), BAUM_OK);
  assert_int_equal(baum_study_create(s->pendulum.mechanism, 0.0, 0.05, &s->study), BAUM_OK);
  assert_int_equal(baum_study_set_options(s->study, &o), BAUM_OK);
  for (int k = 1; k <= 2; k++) {
    const baum_simulation_options run = rk4_options(0.01 * k);
    assert_int_equal(baum_study_add(s->study, &run), BAUM_OK);
  }
}

static void make_scene(scene *s, stage wanted)
{
  *s = (scene){.stage = wanted};
  if (wanted == STUDIED) {
    make_study(s);
  } else if (wanted >= OPEN) {
    assert_int_equal(every_element_build(&s->parts), BAUM_OK);
  }
  if (wanted == FROZEN || wanted == RUNNING) {
    assert_int_equal(baum_mechanism_freeze(s->parts.mechanism), BAUM_OK);
    assert_int_equal(baum_workspace_create(s->parts.mechanism, &s->w), BAUM_OK);
    assert_int_equal(baum_workspace_design(s->w, s->q, NULL), BAUM_OK);
    memcpy(s->y, s->q, sizeof s->q);
    s->q[0] += 1e-3; /* otherwise assembly would have nothing to do */
  }
  if (wanted == RUNNING) {
    make_runs(s);
  }
}

static void end_scene(scene *s)
{
  baum_simulation_destroy(s->run);
  baum_simulation_destroy(s->from);
  baum_workspace_destroy(s->w);
  baum_mechanism_destroy(s->parts.mechanism);
  baum_study_destroy(s->study);
  model_destroy(&s->pendulum);
}

/* ---- a call that needs a function ---- */

static baum_status change_nothing(baum_mechanism *copy, int64_t run, void *user)
{
  (void)copy;
  (void)run;
  (void)user;
  return BAUM_OK;
}

static baum_status call_baum_sweep(scene *s)
{
  const baum_simulation_options o = rk4_options(1e-3);
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  const double time = 0.0;
  double rows[4];
  baum_sweep_def def = baum_sweep_def_default();
  def.count = 2;
  def.change = change_nothing;
  def.times = &time;
  def.time_count = 1;
  def.channels = &energy;
  def.channel_count = 1;
  return baum_sweep(s->parts.mechanism, &o, &def, rows, NULL);
}

/* A small scene as text. The calls do not write and read the mechanism above, because a text of
 * that mechanism needs a hook for each of its functions. */
static const char SCENE_TEXT[] =
  "{\"baum_scene\": 1, \"break_times\": [1], \"ground_outlines\": [{\"form\": \"polygon\", "
  "\"points\": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}], \"bodies\": [{\"kind\": \"planar_body\", "
  "\"name\": \"b\"}], \"joints\": [{\"kind\": \"planar_revolute\", \"name\": \"A\", "
  "\"body_a\": \"ground\", \"body_b\": \"b\", \"point\": [0, 0]}, {\"kind\": \"spline_driver\", "
  "\"joint\": \"A\", "
  "\"times\": [0, 1, 2], \"values\": [0, 1, 3]}]}";

#endif
