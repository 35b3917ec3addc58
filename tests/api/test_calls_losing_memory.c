/* SPDX-License-Identifier: BSD-3-Clause */
/* Every public function that allocates: whichever of its allocations fails, it says BAUM_ERR_MEMORY
 * or does without, what it was called on is as before, and the same call with memory then does what
 * it always does. Nothing is left behind. tests/layout/check_allocation.sh finds each public
 * function here or in test_calls_without_memory.c.
 */
#define _GNU_SOURCE /* of heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/catalog.h>

#include "base/digest.h"
#include "every_element.h"
#include "heap.h"
#include "models.h"

enum { MOST = 24 /* allocations that are made to fail, of one call */, BYTES = 1 << 17 };
static const char FILE_NAME[] = "test_calls_losing_memory.out";

/* ---- what is called on ---- */

/* Each has what is before it, but a study is of a pendulum. */
typedef enum stage { NOTHING, OPEN, FROZEN, RUNNING, STUDIED } stage;

typedef struct scene {
  stage stage;
  every_element parts;
  baum_workspace *w;
  double q[EVERY_NQ];
  double v[EVERY_NV];
  double y[EVERY_NQ + EVERY_NV + 2 * EVERY_NC];
  baum_simulation *run;
  baum_simulation *from; /* further on, with a schedule and a law of its own */
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
  baum_simulation *run = NULL;
  const baum_simulation_options o = rk4_options(1e-3);
  assert_int_equal(baum_simulation_create(s->parts.mechanism, &o, &run), BAUM_OK);
  return run;
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
    s->q[0] += 1e-3; /* something to be assembled */
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

/* ---- what can be told of it ---- */

static void add_mechanism(baum_i_digest *d, const baum_mechanism *m)
{
  int32_t breaks = 0;
  const double *times = baum_mechanism_break_times(m, &breaks);
  const int64_t counts[] = {baum_mechanism_is_frozen(m),   baum_mechanism_body_count(m),
                            baum_mechanism_joint_count(m), baum_mechanism_force_count(m),
                            baum_mechanism_input_count(m), breaks};
  baum_i_digest_add(d, counts, sizeof counts);
  baum_i_digest_add(d, times, (size_t)breaks * sizeof *times);
}

/* All that a run is. */
static void add_saved(baum_i_digest *d, baum_simulation *run)
{
  static unsigned char bytes[BYTES];
  size_t size = 0;
  assert_int_equal(baum_simulation_save(run, bytes, sizeof bytes, &size), BAUM_OK);
  baum_i_digest_add(d, bytes, size);
}

/* What it stands at. */
static void add_state(baum_i_digest *d, const baum_simulation *run)
{
  double t = baum_simulation_time(run);
  baum_i_digest_add(d, &t, sizeof t);
  baum_i_digest_add(d, baum_simulation_q(run), EVERY_NQ * sizeof(double));
  baum_i_digest_add(d, baum_simulation_v(run), EVERY_NV * sizeof(double));
}

static void add_study(baum_i_digest *d, const baum_study *study)
{
  baum_study_options o;
  assert_int_equal(baum_study_settings(study, NULL, NULL, &o, sizeof o), BAUM_OK);
  baum_i_digest_add_integer(d, o.samples);
  baum_i_digest_add_text(d, o.file ? o.file : "none");
  baum_i_digest_add_text(d, baum_study_error_text(study));
  baum_i_digest_add_integer(d, baum_study_method_count(study));
  baum_study_reference r;
  assert_int_equal(baum_study_reference_read(study, &r, sizeof r), BAUM_OK);
  baum_i_digest_add_integer(d, r.origin);
  for (int32_t k = 0; k < baum_study_entry_count(study); k++) {
    baum_study_entry entry;
    assert_int_equal(baum_study_entry_at(study, k, &entry, sizeof entry), BAUM_OK);
    baum_i_digest_add_text(d, entry.name);
    baum_i_digest_add_integer(d, entry.state);
    baum_i_digest_add(d, &entry.error, sizeof entry.error);
  }
}

/* What is seen of it: runs with all that they are, or what they stand at. */
static uint64_t look(const scene *s, bool all)
{
  baum_i_digest d = {0};
  if (s->stage == OPEN) {
    add_mechanism(&d, s->parts.mechanism);
  }
  if (s->w) {
    baum_i_digest_add(&d, s->q, sizeof s->q);
    baum_i_digest_add(&d, s->v, sizeof s->v);
  }
  if (s->run) {
    add_state(&d, s->run);
  }
  if (s->run && all) {
    add_saved(&d, s->run);
  }
  if (s->study) {
    add_study(&d, s->study);
  }
  return d.value;
}

/* Where it comes to from there. */
static uint64_t go_on(const scene *s)
{
  if (s->run) {
    assert_true(baum_simulation_step(s->run, 9) >= BAUM_OK);
  }
  return look(s, false);
}

/* ---- calls ---- */

static void *const GARBAGE = (void *)(uintptr_t)16;

/* A create or copy function: NULL on failure; what it has made is given up. */
#define MADE(TYPE, CALL)                                                \
  {                                                                     \
    baum_##TYPE *out = GARBAGE;                                         \
    baum_status status = CALL;                                          \
    assert_int_equal(status >= BAUM_OK && out != GARBAGE, out != NULL); \
    baum_##TYPE##_destroy(out == GARBAGE ? NULL : out);                 \
    return status;                                                      \
  }
#define CALL(NAME) static baum_status call_##NAME(scene *s)

CALL(baum_mechanism_create)
{
  (void)s;
  MADE(mechanism, baum_mechanism_create(&out));
}

CALL(baum_mechanism_copy)
{
  MADE(mechanism, baum_mechanism_copy(s->parts.mechanism, &out));
}

CALL(baum_catalog_build)
{
  (void)s;
  const baum_catalog_choice choice = {.name = "andrews_bodies"};
  MADE(mechanism, baum_catalog_build(&choice, &out));
}

CALL(baum_workspace_create)
{
  MADE(workspace, baum_workspace_create(s->parts.mechanism, &out));
}

CALL(baum_simulation_create)
{
  const baum_simulation_options o = rk4_options(1e-3);
  MADE(simulation, baum_simulation_create(s->parts.mechanism, &o, &out));
}

CALL(baum_study_create)
{
  MADE(study, baum_study_create(s->parts.mechanism, 0.0, 1.0, &out));
}

CALL(baum_mechanism_add_input)
{
  return baum_mechanism_add_input(s->parts.mechanism, "second throttle", 0.5, NULL);
}

CALL(baum_mechanism_add_break_times)
{
  const double times[3] = {0.1, 0.2, 0.3};
  return baum_mechanism_add_break_times(s->parts.mechanism, times, 3);
}

CALL(baum_mechanism_freeze)
{
  return baum_mechanism_freeze(s->parts.mechanism);
}

CALL(baum_mechanism_check_derivatives)
{
  return baum_mechanism_check_derivatives(s->parts.mechanism);
}

CALL(baum_mechanism_mobility)
{
  baum_mobility out;
  return baum_mechanism_mobility(s->parts.mechanism, &out, sizeof out);
}

CALL(baum_mechanism_report)
{
  baum_report out;
  return baum_mechanism_report(s->parts.mechanism, &out, sizeof out);
}

/* Velocities that are to be found. */
static void free_all(double v[EVERY_NV])
{
  for (int i = 0; i < EVERY_NV; i++) {
    v[i] = (double)NAN;
  }
}

CALL(baum_workspace_assemble)
{
  double v[EVERY_NV];
  free_all(v);
  return baum_workspace_assemble(s->w, 0.0, s->q, v, &s->parts.slider, 1);
}

CALL(baum_workspace_project)
{
  return baum_workspace_project(s->w, 0.0, s->q, s->v);
}

CALL(baum_workspace_residual_jacobian)
{
  const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX3};
  baum_sparse out = {NULL, NULL, NULL, 0};
  return baum_workspace_residual_jacobian(s->w, &dae, 1.0, 0.0, s->y, s->y, &out);
}

CALL(baum_simulation_set_state)
{
  double v[EVERY_NV];
  free_all(v);
  return baum_simulation_set_state(s->run, 0.0, s->q, v);
}

CALL(baum_simulation_set_driver)
{
  return drive(s, s->run);
}

CALL(baum_simulation_schedule_input)
{
  return schedule(s, s->run);
}

CALL(baum_simulation_add_event)
{
  baum_event_def def = baum_event_def_default();
  def.name = "stop";
  def.joint = s->parts.pin;
  def.value = 0.51;
  return baum_simulation_add_event(s->run, &def, NULL);
}

CALL(baum_simulation_continue)
{
  return baum_simulation_continue(s->run, s->from);
}

CALL(baum_study_set_options)
{
  baum_study_options o = baum_study_options_default();
  o.samples = 7;
  o.file = FILE_NAME;
  return baum_study_set_options(s->study, &o);
}

CALL(baum_study_add)
{
  const baum_simulation_options o = rk4_options(0.005);
  return baum_study_add(s->study, &o);
}

CALL(baum_study_add_standard)
{
  baum_study_grid grid = baum_study_grid_default();
  grid.integrator = baum_rk4();
  grid.settings = 2;
  return baum_study_add_standard(s->study, &grid);
}

CALL(baum_study_add_stress)
{
  return baum_study_add_stress(s->study, baum_rk4());
}

CALL(baum_study_set_error)
{
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  return baum_study_set_error(s->study, &energy, 1, 1.0);
}

CALL(baum_study_set_reference)
{
  const double end = 0.05;
  const double q[2] = {1.0, 0.0};
  return baum_study_set_reference(s->study, &end, 1, q, NULL, NULL, 3.0);
}

CALL(baum_study_run)
{
  return baum_study_run(s->study);
}

CALL(baum_study_print)
{
  return baum_study_print(s->study, BAUM_REPORT_TEXT, NULL, NULL, 0, NULL);
}

CALL(baum_study_write)
{
  return baum_study_write(s->study, BAUM_REPORT_JSON, NULL, FILE_NAME);
}

/* ---- the table ---- */

typedef struct call {
  const char *name;
  stage stage;
  baum_status (*make)(scene *s);
  bool works; /* on the run, whose counts of work change though it fails */
} call;

/* clang-format off */
#define ROW(NAME, STAGE) {#NAME, (STAGE), call_##NAME, false}
#define WORKS(NAME) {#NAME, RUNNING, call_##NAME, true}
/* clang-format on */

static const call CALLS[] = {
  ROW(baum_mechanism_create, NOTHING),
  ROW(baum_catalog_build, NOTHING),
  ROW(baum_mechanism_add_input, OPEN),
  ROW(baum_mechanism_add_break_times, OPEN),
  ROW(baum_mechanism_freeze, OPEN),
  ROW(baum_mechanism_copy, FROZEN),
  ROW(baum_mechanism_check_derivatives, FROZEN),
  ROW(baum_mechanism_mobility, FROZEN),
  ROW(baum_mechanism_report, FROZEN),
  ROW(baum_workspace_create, FROZEN),
  ROW(baum_workspace_assemble, FROZEN),
  ROW(baum_workspace_project, FROZEN),
  ROW(baum_workspace_residual_jacobian, FROZEN),
  ROW(baum_simulation_create, FROZEN),
  WORKS(baum_simulation_set_state),
  ROW(baum_simulation_set_driver, RUNNING),
  ROW(baum_simulation_schedule_input, RUNNING),
  ROW(baum_simulation_add_event, RUNNING),
  WORKS(baum_simulation_continue),
  ROW(baum_study_create, FROZEN),
  ROW(baum_study_set_options, STUDIED),
  ROW(baum_study_add, STUDIED),
  ROW(baum_study_add_standard, STUDIED),
  ROW(baum_study_add_stress, STUDIED),
  ROW(baum_study_set_error, STUDIED),
  ROW(baum_study_set_reference, STUDIED),
  ROW(baum_study_run, STUDIED),
  ROW(baum_study_print, STUDIED),
  ROW(baum_study_write, STUDIED),
};

/* What it allocates, and what is seen after it. */
static long count_allocations(const call *c, uint64_t *seen)
{
  scene s;
  make_scene(&s, c->stage);
  (void)look(&s, !c->works); /* saving makes solvers choose their pivots again */
  heap_watch();
  baum_status status = c->make(&s);
  long allocations = heap_stop();
  if (status < BAUM_OK) {
    fail_msg("%s: %s", c->name, baum_message());
  }
  *seen = go_on(&s);
  end_scene(&s);
  return allocations;
}

/* Opening a file needs memory too, and fails for the system's reason. */
static bool is_for_memory(baum_status status)
{
  return status == BAUM_ERR_MEMORY ||
         (status == BAUM_ERR_FILE && strstr(baum_message(), strerror(ENOMEM)));
}

/* Returns whether it failed. */
static bool fail_once(const call *c, long n, bool for_good, uint64_t wanted)
{
  scene s;
  make_scene(&s, c->stage);
  uint64_t before = look(&s, !c->works);
  heap_fail(n, for_good);
  baum_status status = c->make(&s);
  (void)heap_stop();
  bool failed = status < BAUM_OK;
  if (failed && !is_for_memory(status)) {
    fail_msg("%s, allocation %ld: %s", c->name, n, baum_message());
  }
  if (failed && c->make != call_baum_study_run && look(&s, !c->works) != before) {
    fail_msg("%s, allocation %ld: something has changed", c->name, n);
  }
  if (failed && c->make(&s) < BAUM_OK) {
    fail_msg("%s, allocation %ld, then again: %s", c->name, n, baum_message());
  }
  if (go_on(&s) != wanted) {
    fail_msg("%s, allocation %ld: it comes out as something else", c->name, n);
  }
  end_scene(&s);
  return failed;
}

static void fail_some(const call *c)
{
  uint64_t wanted = 0;
  long allocations = count_allocations(c, &wanted); /* and what libraries keep for good */
  long step = allocations > MOST ? allocations / MOST : 1;
  long before = heap_blocks();
  int failures = 0;
  for (long n = 0; n < allocations; n += step) {
    failures += fail_once(c, n, false, wanted);
    failures += fail_once(c, n, true, wanted);
    if (heap_blocks() != before) {
      fail_msg("%s, allocation %ld: %ld blocks are lost", c->name, n, heap_blocks() - before);
    }
  }
  if (failures == 0) {
    fail_msg("%s has never failed: it belongs to test_calls_without_memory.c", c->name);
  }
}

static void what_fails_for_memory_changes_nothing_and_can_be_repeated(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  for (size_t k = 0; k < sizeof CALLS / sizeof CALLS[0]; k++) {
    fail_some(&CALLS[k]);
  }
  (void)remove(FILE_NAME);
}

/* ---- elements ---- */

static uint64_t look_at_element(const every_element *parts, const element_kind *kind)
{
  baum_i_digest d = {0};
  any_def def;
  memset(&def, 0, sizeof def);
  assert_int_equal(kind->get(parts->mechanism, every_element_id(parts, kind), &def, kind->size),
                   BAUM_OK);
  add_mechanism(&d, parts->mechanism);
  baum_i_digest_add_text(&d, def.head.name);
  baum_i_digest_add(&d, def.bytes, kind->size);
  return d.value;
}

/* A second one of a kind, or another definition for the first; returns how often it failed. */
static int until_it_works(every_element *parts, const element_kind *kind, bool replace)
{
  any_def def;
  kind->good(parts, &def);
  def.head.name = replace ? "another" : "a second one";
  uint64_t before = look_at_element(parts, kind);
  baum_status status = BAUM_ERR_MEMORY;
  long n = 0;
  for (; status == BAUM_ERR_MEMORY; n++) {
    assert_true(look_at_element(parts, kind) == before);
    heap_fail(n, false);
    status = replace ? kind->set(parts->mechanism, every_element_id(parts, kind), &def)
                     : kind->add(parts->mechanism, &def, NULL);
    (void)heap_stop();
  }
  if (status != BAUM_OK || look_at_element(parts, kind) == before) {
    fail_msg("%s, allocation %ld: %s", kind->name, n, baum_message());
  }
  return (int)n - 1;
}

static void elements_are_added_and_replaced_wholly_or_not_at_all(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  long before = heap_blocks();
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    assert_true(until_it_works(&parts, &element_kinds[k], false) > 0);
    assert_true(until_it_works(&parts, &element_kinds[k], true) > 0);
  }
  assert_int_equal(baum_mechanism_freeze(parts.mechanism), BAUM_OK);
  baum_mechanism_destroy(parts.mechanism);
  assert_int_equal(heap_blocks(), before);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(what_fails_for_memory_changes_nothing_and_can_be_repeated),
    cmocka_unit_test(elements_are_added_and_replaced_wholly_or_not_at_all),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
