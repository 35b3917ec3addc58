/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls every public function that allocates memory while allocations fail. The function must
 * return BAUM_ERR_MEMORY and leave its objects as before, or it must succeed without this memory. A
 * second call with memory must then give the usual result, and no memory may be lost.
 * tests/layout/check_allocation.sh checks that each public function is called here or in
 * test_calls_without_memory.c. */
#define _GNU_SOURCE /* needed by heap.h */
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
#include "losing_memory_scene.h"

enum { MOST = 24 /* the largest number of failing allocations for each call */, BYTES = 1 << 17 };
static const char FILE_NAME[] = "test_calls_losing_memory.out";

/* ---- digests of the objects ---- */

static void add_mechanism(baum_i_digest *d, const baum_mechanism *m)
{
  int32_t breaks = 0;
  const double *times = baum_mechanism_break_times(m, &breaks);
  const int64_t counts[] = {baum_mechanism_is_frozen(m),   baum_mechanism_body_count(m),
                            baum_mechanism_joint_count(m), baum_mechanism_force_count(m),
                            baum_mechanism_input_count(m), breaks};
  baum_i_digest_add(d, counts, sizeof counts);
  baum_i_digest_add(d, times, (size_t)breaks * sizeof *times);
  for (int32_t k = 0; k < baum_mechanism_body_count(m); k++) {
    baum_i_digest_add_integer(d, baum_mechanism_outline_count(m, baum_mechanism_body_at(m, k)));
  }
}

static void add_saved(baum_i_digest *d, baum_simulation *run)
{
  static unsigned char bytes[BYTES];
  size_t size = 0;
  assert_int_equal(baum_simulation_save(run, bytes, sizeof bytes, &size), BAUM_OK);
  baum_i_digest_add(d, bytes, size);
}

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

/* Returns the digest of a scene. If `all` is true, the digest includes all that a saved run
 * contains. */
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

static uint64_t go_on(const scene *s)
{
  if (s->run) {
    assert_true(baum_simulation_step(s->run, 9) >= BAUM_OK);
  }
  return look(s, false);
}

/* ---- calls ---- */

static void *const GARBAGE = (void *)(uintptr_t)16;

/* Defines a call of a function that creates or copies an object. If the call fails, it has to set
 * the pointer to NULL. */
#define MADE(TYPE, CALL)                                                \
  {                                                                     \
    baum_##TYPE *out = GARBAGE;                                         \
    baum_status status = CALL;                                          \
    assert_int_equal(status >= BAUM_OK && out != GARBAGE, out != NULL); \
    baum_##TYPE##_destroy(out == GARBAGE ? NULL : out);                 \
    return status;                                                      \
  }
#define CALL(NAME) static baum_status call_##NAME(scene *s)
#define SHORT_CALL(NAME, ...)   \
  CALL(NAME)                    \
  {                             \
    return (NAME)(__VA_ARGS__); \
  }

SHORT_CALL(baum_mechanism_freeze, s->parts.mechanism)
SHORT_CALL(baum_mechanism_check_derivatives, s->parts.mechanism)
SHORT_CALL(baum_workspace_project, s->w, 0.0, s->q, s->v)
SHORT_CALL(baum_simulation_set_angle, s->run, s->parts.bearing, BAUM_COORDINATE_FIRST, 7.0)
SHORT_CALL(baum_simulation_continue, s->run, s->from)
SHORT_CALL(baum_study_add_stress, s->study, baum_rk4())

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

/* Sets all velocities to NaN, so that assembly has to find them. */
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

CALL(baum_mechanism_set_outlines)
{
  static const double points[3][3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  static const int32_t triangle[3] = {0, 1, 2};
  baum_outline two[2] = {baum_outline_default(), baum_outline_default()};
  two[1].form = BAUM_OUTLINE_MESH;
  two[0].points = two[1].points = points[0];
  two[0].point_count = two[1].point_count = 3;
  two[1].triangles = triangle;
  two[1].triangle_count = 1;
  two[1].color = "#123456";
  return baum_mechanism_set_outlines(s->parts.mechanism, s->parts.crank, two, 2);
}

CALL(baum_mechanism_svg)
{
  return baum_mechanism_svg(s->parts.mechanism, s->q, NULL, 0, NULL);
}

CALL(baum_mechanism_svg_assembled)
{
  return baum_mechanism_svg_assembled(s->parts.mechanism, NULL, 0, NULL);
}

CALL(baum_mechanism_write_svg)
{
  return baum_mechanism_write_svg(s->parts.mechanism, NULL, FILE_NAME);
}

CALL(baum_mechanism_parse)
{
  (void)s;
  baum_mechanism *m[2] = {NULL, NULL};
  bool equal = false;
  baum_status status = baum_mechanism_parse(SCENE_TEXT, sizeof SCENE_TEXT - 1, NULL, 0, &m[0]);
  status = status ? status : baum_mechanism_write(m[0], NULL, 0, FILE_NAME);
  status = status ? status : baum_mechanism_read(FILE_NAME, NULL, 0, &m[1]);
  status = status ? status : baum_mechanism_print(m[1], NULL, 0, NULL, 0, NULL);
  status = status ? status : baum_mechanism_compare(m[0], m[1], &equal);
  baum_mechanism_destroy(m[0]);
  baum_mechanism_destroy(m[1]);
  return status;
}

#define call_baum_mechanism_write   call_baum_mechanism_parse
#define call_baum_mechanism_read    call_baum_mechanism_parse
#define call_baum_mechanism_print   call_baum_mechanism_parse
#define call_baum_mechanism_compare call_baum_mechanism_parse
static baum_page page_of(const scene *s, const baum_channel *channel)
{
  static const double time = 0.0;
  baum_page page = baum_page_default();
  page.times = &time;
  page.count = 1;
  page.channels = channel;
  page.channel_count = 1;
  page.rows = s->q;
  return page;
}

CALL(baum_page_print)
{
  const baum_channel channel = baum_channel_of(BAUM_Q);
  const baum_page page = page_of(s, &channel);
  return baum_page_print(s->parts.mechanism, &page, NULL, 0, NULL);
}

CALL(baum_page_svg)
{
  const baum_channel channels[] = {baum_channel_of(BAUM_Q),
                                   baum_channel_of_joint(BAUM_JOINT_REACTION, s->parts.pin)};
  const baum_channel trace = baum_channel_of_body(BAUM_BODY_POSE, s->parts.crank);
  double row[EVERY_NQ + 6] = {0.0};
  memcpy(row, s->q, sizeof s->q);
  baum_page page = page_of(s, channels);
  page.channel_count = 2;
  page.rows = row;
  page.traces = &trace;
  page.trace_count = 1;
  return baum_page_svg(s->parts.mechanism, &page, 0, NULL, 0, NULL);
}

CALL(baum_page_write)
{
  const baum_channel channel = baum_channel_of(BAUM_Q);
  const baum_page page = page_of(s, &channel);
  return baum_page_write(s->parts.mechanism, &page, FILE_NAME);
}

/* ---- the table ---- */

typedef struct call {
  const char *name;
  stage stage;
  baum_status (*make)(scene *s);
  /* Whether the call evaluates the equations. This changes the run's counters even if it fails. */
  bool works;
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
  ROW(baum_simulation_set_angle, RUNNING),
  ROW(baum_simulation_set_driver, RUNNING),
  ROW(baum_simulation_schedule_input, RUNNING),
  ROW(baum_simulation_add_event, RUNNING),
  WORKS(baum_simulation_continue),
  ROW(baum_sweep, FROZEN),
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
  ROW(baum_mechanism_set_outlines, OPEN),
  ROW(baum_mechanism_svg, FROZEN),
  ROW(baum_mechanism_svg_assembled, FROZEN),
  ROW(baum_mechanism_write_svg, FROZEN),
  ROW(baum_mechanism_parse, OPEN),
  ROW(baum_mechanism_write, OPEN),
  ROW(baum_mechanism_read, OPEN),
  ROW(baum_mechanism_print, OPEN),
  ROW(baum_mechanism_compare, OPEN),
  ROW(baum_page_print, FROZEN),
  ROW(baum_page_svg, FROZEN),
  ROW(baum_page_write, FROZEN),
};

static long count_allocations(const call *c, uint64_t *seen)
{
  scene s;
  make_scene(&s, c->stage);
  /* fail_once() also calls look(). If look() saves the run, solvers choose new pivots. */
  (void)look(&s, !c->works);
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

/* Tells whether a call failed because memory was missing. If the missing memory was for opening a
 * file, the status is BAUM_ERR_FILE, and the message contains the reason that the system gives. */
static bool is_for_memory(baum_status status)
{
  return status == BAUM_ERR_MEMORY ||
         (status == BAUM_ERR_FILE && strstr(baum_message(), strerror(ENOMEM)));
}

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
    fail_msg("%s, allocation %ld: the later result is different", c->name, n);
  }
  end_scene(&s);
  return failed;
}

static void fail_some(const call *c)
{
  uint64_t wanted = 0;
  /* Libraries keep the memory that they allocate in their first call. The blocks are therefore
   * counted only after this call. */
  long allocations = count_allocations(c, &wanted);
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

static void a_call_that_fails_for_memory_changes_nothing_and_can_be_repeated(void **state)
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

/* Adds a second element of a kind, or replaces the definition of the first one. In each attempt one
 * more allocation succeeds, until none fails. Returns the number of failures. */
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
    cmocka_unit_test(a_call_that_fails_for_memory_changes_nothing_and_can_be_repeated),
    cmocka_unit_test(elements_are_added_and_replaced_wholly_or_not_at_all),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
