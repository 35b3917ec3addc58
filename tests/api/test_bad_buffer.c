/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests that baum_simulation_restore() checks a buffer before it changes the run. It must refuse
 * buffers that are truncated or damaged, and buffers of other mechanisms or options. The message
 * must say which of these is the case. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "every_element.h"
#include "models.h"
#include "runs.h"

/* Byte positions of the numbers in the header of a buffer. */
enum { AT_NUMBER = 8, AT_VERSION = 16, AT_SIZE = 24, AT_STRUCTURE = 32, HEAD = 48 };

typedef struct saved {
  unsigned char *bytes;
  size_t size;
} saved;

static saved save(baum_simulation *run)
{
  saved s = {0};
  s.bytes = save_run(run, &s.size);
  return s;
}

static baum_simulation *start(const baum_mechanism *mechanism,
                              const baum_simulation_options *options, double t)
{
  baum_simulation *run = create_run(mechanism, options);
  assert_true(baum_simulation_advance_to(run, t) >= BAUM_OK);
  return run;
}

static baum_simulation_options fixed_step(void)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.formulation = BAUM_FORMULATION_BAUMGARTE;
  o.step = 1e-3;
  return o;
}

static baum_mechanism *pendulum(void)
{
  model m;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  baum_mechanism *mechanism = m.mechanism;
  m.mechanism = NULL;
  model_destroy(&m);
  return mechanism;
}

/* Checks that the buffer is refused, with a message that contains these words. */
static void check_refused(baum_simulation *run, const void *bytes, size_t size, const char *words)
{
  baum_status status = baum_simulation_restore(run, bytes, size);
  const char *message = baum_message();
  if (status != BAUM_ERR_BUFFER || !strstr(message, words) ||
      !strstr(message, "baum_simulation_restore: the buffer")) {
    fail_msg("want \"%s\", got %s: %s", words, baum_status_name(status), message);
  }
  assert_string_equal(baum_simulation_message(run), message);
}

/* Checks that a run saves the same bytes as before. Then all its numbers are unchanged. Saving does
 * not alter a run that uses a one-step method with a fixed step. */
static void check_unchanged(baum_simulation *run, const saved *before)
{
  saved now = save(run);
  assert_int_equal(now.size, before->size);
  assert_memory_equal(now.bytes, before->bytes, now.size);
  free(now.bytes);
}

/* A run at 0.3 s, and a buffer that was saved at 0.2 s. */
typedef struct scene {
  baum_mechanism *mechanism;
  baum_simulation *run;
  saved other;
  saved before;
} scene;

static scene open_scene(void)
{
  scene s = {.mechanism = pendulum()};
  baum_simulation_options o = fixed_step();
  s.run = start(s.mechanism, &o, 0.2);
  s.other = save(s.run);
  assert_int_equal(baum_simulation_advance_to(s.run, 0.3), BAUM_OK);
  s.before = save(s.run);
  return s;
}

static void close_scene(scene *s)
{
  check_unchanged(s->run, &s->before);
  assert_int_equal(baum_simulation_restore(s->run, s->other.bytes, s->other.size), BAUM_OK);
  assert_true(baum_simulation_time(s->run) == 0.2);
  free(s->other.bytes);
  free(s->before.bytes);
  baum_simulation_destroy(s->run);
  baum_mechanism_destroy(s->mechanism);
}

static void buffers_truncated_at_any_length_are_refused(void **state)
{
  (void)state;
  scene s = open_scene();
  for (size_t size = 0; size < s.other.size; size++) {
    /* The allocation has exactly this size, so that the address sanitizer detects reading past its
     * end. */
    unsigned char *part = malloc(size + 1);
    assert_non_null(part);
    memcpy(part + 1, s.other.bytes, size); /* not aligned */
    check_refused(s.run, part + 1, size, "truncated");
    free(part);
  }
  close_scene(&s);
}

static void buffers_with_any_changed_bit_are_refused(void **state)
{
  (void)state;
  scene s = open_scene();
  for (size_t k = 0; k < s.other.size; k++) {
    for (int bit = 0; bit < 8; bit++) {
      s.other.bytes[k] ^= (unsigned char)(1 << bit);
      const char *words = k < AT_NUMBER       ? "not written by baum_simulation_save()"
                          : k < AT_VERSION    ? "another byte order"
                          : k < AT_SIZE       ? "version"
                          : k >= AT_STRUCTURE ? "damaged: its checksum"
                                              : "";
      check_refused(s.run, s.other.bytes, s.other.size, words);
      s.other.bytes[k] ^= (unsigned char)(1 << bit);
    }
  }
  close_scene(&s);
}

/* The sum of all words would not change if the highest bits of two words changed. The checksum must
 * detect such a change. */
static void buffers_with_two_changed_signs_are_refused(void **state)
{
  (void)state;
  scene s = open_scene();
  for (size_t k = AT_STRUCTURE + 7; k + 8 < s.other.size; k += 8) {
    s.other.bytes[k] ^= 0x80;
    s.other.bytes[k + 8] ^= 0x80;
    check_refused(s.run, s.other.bytes, s.other.size, "damaged");
    s.other.bytes[k] ^= 0x80;
    s.other.bytes[k + 8] ^= 0x80;
  }
  close_scene(&s);
}

/* ---- buffers whose checksum is right, but whose content is not ---- */

/* Writes the checksum into the buffer. The checksum is documented in base/digest.h. */
static void seal(saved *s)
{
  uint64_t h = 0;
  for (size_t k = 0; k + 8 < s->size; k += 8) {
    uint64_t word = 0;
    memcpy(&word, s->bytes + k, sizeof word);
    h = (h ^ word) * UINT64_C(0x9e3779b97f4a7c15);
    h ^= h >> 32;
  }
  memcpy(s->bytes + s->size - sizeof h, &h, sizeof h);
}

/* The lengths and the numbers are random, and the checksum is valid. baum_simulation_restore() must
 * not crash. It must use the whole buffer or nothing of it. */
static void random_bytes_with_a_valid_checksum_are_harmless(void **state)
{
  (void)state;
  scene s = open_scene();
  uint64_t seed = 1;
  int taken = 0;
  unsigned char *kept = malloc(s.other.size);
  assert_non_null(kept);
  memcpy(kept, s.other.bytes, s.other.size);
  for (int k = 0; k < 20000; k++) {
    seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    size_t words = (s.other.size - HEAD) / 8 - 1;
    size_t at = HEAD + (size_t)(seed >> 33) % words * 8;
    uint64_t value = k % 3 == 0 ? seed : (seed >> 50) << (k % 3 == 1 ? 0 : 49);
    memcpy(s.other.bytes + at, &value, sizeof value);
    seal(&s.other);
    baum_status status = baum_simulation_restore(s.run, s.other.bytes, s.other.size);
    assert_true(status == BAUM_OK || status == BAUM_ERR_BUFFER);
    taken += status == BAUM_OK;
    memcpy(s.other.bytes, kept, s.other.size);
  }
  /* A buffer is accepted if only numbers of the state differ, and refused if a size differs. */
  assert_in_range(taken, 1, 19999);
  free(kept);
  assert_int_equal(baum_simulation_restore(s.run, s.before.bytes, s.before.size), BAUM_OK);
  close_scene(&s);
}

/* In the first part of the test, a buffer with an impossible size must be refused. The second part
 * replaces each word of the buffer by 0, one at a time. One of these words says that the driver has
 * a polynomial as its law. If this word is 0, the driver has no law, and restoring must refuse the
 * buffer. */
static void impossible_sizes_and_laws_are_refused(void **state)
{
  (void)state;
  baum_body_id crank;
  baum_planar_body_def body = baum_planar_body_def_default();
  baum_driver_def motor = baum_driver_def_default();
  baum_mechanism *mechanism = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &body, &crank), BAUM_OK);
  motor.joint = add_planar_pin(mechanism, NULL, BAUM_GROUND, crank, 0.0, 0.0);
  baum_joint_id id;
  assert_int_equal(baum_mechanism_add_driver(mechanism, &motor, &id), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  baum_simulation_options o = fixed_step();
  baum_simulation *run = start(mechanism, &o, 0.01);
  assert_int_equal(baum_simulation_set_driver(run, id, 0.0, 1.0, 0.0), BAUM_OK);
  saved s = save(run);

  const uint64_t eight = 8;
  uint64_t own = 0;
  memcpy(&own, s.bytes + AT_SIZE, sizeof own);
  memcpy(s.bytes + AT_SIZE, &eight, sizeof eight);
  check_refused(run, s.bytes, s.size, "8 bytes");
  memcpy(s.bytes + AT_SIZE, &own, sizeof own);

  const uint64_t zero = 0;
  int laws = 0;
  for (size_t at = HEAD; at + 16 <= s.size; at += 8) {
    memcpy(&own, s.bytes + at, sizeof own);
    memcpy(s.bytes + at, &zero, sizeof zero);
    seal(&s);
    laws += baum_simulation_restore(run, s.bytes, s.size) == BAUM_ERR_BUFFER &&
            strstr(baum_message(), "law for joint 2");
    memcpy(s.bytes + at, &own, sizeof own);
  }
  assert_int_equal(laws, 1);
  free(s.bytes);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

static void buffers_of_other_versions_are_refused(void **state)
{
  (void)state;
  scene s = open_scene();
  uint64_t own = 0;
  memcpy(&own, s.other.bytes + AT_VERSION, sizeof own);
  assert_true(own >= 2);
  for (uint64_t version = 0; version <= own + 1; version += version == own - 1 ? 2 : 1) {
    char words[80];
    (void)snprintf(words, sizeof words,
                   "has version %d of the format, this library reads version %d", (int)version,
                   (int)own);
    memcpy(s.other.bytes + AT_VERSION, &version, sizeof version);
    seal(&s.other);
    check_refused(s.run, s.other.bytes, s.other.size, words);
  }
  memcpy(s.other.bytes + AT_VERSION, &own, sizeof own);
  seal(&s.other);
  close_scene(&s);
}

/* ---- buffers of other mechanisms ---- */

/* Makes a slider-crank with a given mass of the rod, or with an additional joint. */
static baum_mechanism *crank(double rod_mass, bool doubled)
{
  model m;
  const model_slider_crank data = {.rod_mass = rod_mass, .doubled_guide = doubled};
  assert_int_equal(model_slider_crank_build(data, &m), BAUM_OK);
  baum_mechanism *mechanism = m.mechanism;
  m.mechanism = NULL;
  model_destroy(&m);
  return mechanism;
}

static void buffers_of_other_mechanisms_are_refused(void **state)
{
  (void)state;
  baum_mechanism *mechanisms[4] = {pendulum(), crank(0.1, false), crank(0.1 + 1e-16, false),
                                   crank(0.1, true)};
  baum_simulation_options o = fixed_step();
  o.step = 1e-4;
  baum_simulation *runs[4];
  for (int k = 0; k < 4; k++) {
    runs[k] = start(mechanisms[k], &o, 1e-3);
  }
  for (int k = 0; k < 4; k++) {
    saved s = save(runs[k]);
    for (int i = 0; i < 4; i++) {
      bool numbers = k + i == 3 && k * i == 2;
      if (i != k) {
        saved before = save(runs[i]);
        check_refused(runs[i], s.bytes, s.size,
                      numbers ? "another mechanism: the elements are the same, but masses"
                              : "another mechanism: kinds, number or connections");
        check_unchanged(runs[i], &before);
        free(before.bytes);
      }
    }
    free(s.bytes);
  }
  for (int k = 0; k < 4; k++) {
    baum_simulation_destroy(runs[k]);
    baum_mechanism_destroy(mechanisms[k]);
  }
}

typedef struct other_options {
  const char *words;
  void (*change)(baum_simulation_options *o);
} other_options;

static void use_rk3(baum_simulation_options *o)
{
  o->integrator = baum_rk3();
}

static void use_projection(baum_simulation_options *o)
{
  o->formulation = BAUM_FORMULATION_PROJECTION;
}

static void use_rtol(baum_simulation_options *o)
{
  o->integrator = baum_rk8();
  o->step = (double)NAN;
  o->rtol = 1e-6;
}

static void use_step(baum_simulation_options *o)
{
  o->step = 0.002;
}

static void use_gains(baum_simulation_options *o)
{
  o->gains = baum_gains_fixed(5.0, 6.0);
}

static void use_account(baum_simulation_options *o)
{
  o->energy_account = true;
}

static void use_solver(baum_simulation_options *o)
{
  o->solver = BAUM_SOLVER_KLU;
}

static void use_row_gains(baum_simulation_options *o)
{
  static const double factor = 0.5;
  o->row_gains = &factor;
  o->row_gain_count = 1;
}

static void buffers_of_runs_with_other_options_are_refused(void **state)
{
  (void)state;
  static const other_options cases[] = {
    {"the integrator is rk3 in the buffer and rk4 in this run", use_rk3},
    {"the formulation is projection in the buffer and baumgarte in this run", use_projection},
    {"the integrator is rk8 in the buffer and rk4 in this run", use_rtol},
    {"step is 0.002 in the buffer and 0.001 in this run", use_step},
    {"the gain rule is", use_gains},
    {"energy_account is 1 in the buffer and 0 in this run", use_account},
    {"solver is 1 in the buffer and 0 in this run", use_solver},
    {"row_gain_count is 1 in the buffer and 0 in this run", use_row_gains},
  };
  scene s = open_scene();
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    baum_simulation_options o = fixed_step();
    cases[k].change(&o);
    baum_simulation *run = start(s.mechanism, &o, 0.1);
    saved other = save(run);
    check_refused(s.run, other.bytes, other.size, cases[k].words);
    free(other.bytes);
    baum_simulation_destroy(run);
  }
  close_scene(&s);
}

static void bytes_that_no_run_has_saved_are_refused(void **state)
{
  (void)state;
  scene s = open_scene();
  unsigned char zeros[4096] = {0};
  check_refused(s.run, zeros, sizeof zeros, "not written by baum_simulation_save()");
  memset(zeros, 0xff, sizeof zeros);
  check_refused(s.run, zeros, sizeof zeros, "not written by baum_simulation_save()");
  /* These bytes are a run and not a saved run. */
  check_refused(s.run, s.run, 64, "not written by baum_simulation_save()");
  close_scene(&s);
}

/* ---- calls ---- */

static void wrong_arguments_are_refused(void **state)
{
  (void)state;
  scene s = open_scene();
  size_t most = 0;
  size_t size = 77;
  unsigned char bytes[256];
  assert_int_equal(baum_simulation_save(NULL, NULL, 0, &most), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_simulation_save(s.run, bytes, sizeof bytes, NULL), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_simulation_save(s.run, NULL, 0, &most), BAUM_OK);
  assert_int_equal(baum_simulation_save(s.run, bytes, sizeof bytes, &size), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "capacity is 256 bytes, must be at least"));
  assert_int_equal(size, 77);
  assert_int_equal(baum_simulation_restore(NULL, bytes, sizeof bytes), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_simulation_restore(s.run, NULL, sizeof bytes), BAUM_ERR_ARGUMENT);
  close_scene(&s);
}

/* A buffer may be larger than the saved run. What follows the saved run is ignored. */
static void bytes_after_a_saved_run_are_ignored(void **state)
{
  (void)state;
  scene s = open_scene();
  unsigned char *longer = malloc(s.other.size + 5);
  assert_non_null(longer);
  memcpy(longer, s.other.bytes, s.other.size);
  memset(longer + s.other.size, 0xa5, 5);
  assert_int_equal(baum_simulation_restore(s.run, longer, s.other.size + 5), BAUM_OK);
  assert_true(baum_simulation_time(s.run) == 0.2);
  free(longer);
  assert_int_equal(baum_simulation_restore(s.run, s.before.bytes, s.before.size), BAUM_OK);
  close_scene(&s);
}

/* Scheduled inputs are checked even if the checksum is right. Otherwise restoring would write to a
 * wrong address for an input that does not exist. */
static void schedules_out_of_order_are_refused(void **state)
{
  (void)state;
  enum { T = 0, BEFORE = 1, INPUT = 3 };
  static const double times[2] = {0.2, 0.4};
  static const double values[2] = {0.123456789, 2.0};
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = fixed_step();
  baum_simulation *run = start(parts.mechanism, &o, 0.01);
  assert_int_equal(baum_simulation_schedule_input(run, parts.throttle, times, values, 2), BAUM_OK);
  saved s = save(run);
  /* Finds the record of the second jump. It contains the value before this jump, which is
   * values[0], the value after the first jump. */
  size_t at = 0;
  for (size_t k = HEAD; k + 8 <= s.size; k += 8) {
    at = memcmp(s.bytes + k, &values[0], sizeof *values) == 0 ? k - BEFORE * sizeof *values : at;
  }
  assert_true(at > HEAD);
  const double nan = (double)NAN;
  const double early = 0.1;
  const int64_t inputs[2] = {-1, 1};
  const struct {
    int word;
    const void *bytes;
  } cases[] = {{T, &nan}, {T, &early}, {BEFORE, &nan}, {INPUT, inputs}, {INPUT, inputs + 1}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    unsigned char kept[8];
    unsigned char *place = s.bytes + at + 8 * (size_t)cases[k].word;
    memcpy(kept, place, sizeof kept);
    memcpy(place, cases[k].bytes, sizeof kept);
    seal(&s);
    check_refused(run, s.bytes, s.size, "damaged: scheduled inputs are not in order");
    memcpy(place, kept, sizeof kept);
  }
  seal(&s);
  assert_int_equal(baum_simulation_restore(run, s.bytes, s.size), BAUM_OK);
  assert_true(baum_simulation_advance_to(run, 0.3) >= BAUM_OK);
  assert_true(baum_simulation_input(run, parts.throttle) == values[0]);
  free(s.bytes);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

/* The run is saved before a law and an input are set. If it is restored afterwards, it must have
 * the law and the value of the input that it had when it was saved. */
static void restoring_removes_laws_that_were_set_later(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = fixed_step();
  baum_simulation *run = start(parts.mechanism, &o, 0.01);
  saved s = save(run);
  assert_true(baum_simulation_advance_to(run, 0.05) >= BAUM_OK);
  double want = baum_simulation_q(run)[0];
  for (int k = 0; k < 2; k++) {
    assert_int_equal(baum_simulation_restore(run, s.bytes, s.size), BAUM_OK);
    assert_true(baum_simulation_input(run, parts.throttle) == 1.0);
    assert_true(baum_simulation_advance_to(run, 0.05) >= BAUM_OK);
    assert_true(baum_simulation_q(run)[0] == want);
    assert_int_equal(baum_simulation_set_driver(run, parts.motor, 0.6, 3.0, 0.0), BAUM_OK);
    assert_int_equal(baum_simulation_set_input(run, parts.throttle, 2.0), BAUM_OK);
    assert_true(baum_simulation_advance_to(run, 0.07) >= BAUM_OK);
  }
  free(s.bytes);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(buffers_truncated_at_any_length_are_refused),
    cmocka_unit_test(buffers_with_any_changed_bit_are_refused),
    cmocka_unit_test(buffers_with_two_changed_signs_are_refused),
    cmocka_unit_test(random_bytes_with_a_valid_checksum_are_harmless),
    cmocka_unit_test(impossible_sizes_and_laws_are_refused),
    cmocka_unit_test(buffers_of_other_versions_are_refused),
    cmocka_unit_test(buffers_of_other_mechanisms_are_refused),
    cmocka_unit_test(buffers_of_runs_with_other_options_are_refused),
    cmocka_unit_test(bytes_that_no_run_has_saved_are_refused),
    cmocka_unit_test(wrong_arguments_are_refused),
    cmocka_unit_test(bytes_after_a_saved_run_are_ignored),
    cmocka_unit_test(schedules_out_of_order_are_refused),
    cmocka_unit_test(restoring_removes_laws_that_were_set_later),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
