/* SPDX-License-Identifier: BSD-3-Clause */
/* Restores runs from bytes. The bytes are arbitrary, or they are a saved run with some changed
 * words and a corrected checksum. If the library refuses the bytes, the run must be unchanged. If
 * it accepts the bytes, later calls may fail, but they must not crash. Afterwards the saved run
 * must be restored exactly. */
#include <stdlib.h>
#include <string.h>

#include "base/digest.h"
#include "drawn.h"

enum { WORD = 8, MOST_CHANGES = 6, STEPS = 20 };

/* ---- runs, made once for all inputs ---- */

/* A saved run, and the positions that it reaches some steps later. */
typedef struct scene {
  const every_element *parts;
  baum_simulation *run;
  unsigned char *saved;
  unsigned char *changed;
  size_t size;
  size_t room;
  double then[EVERY_NQ]; /* q after three more steps */
} scene;

static const baum_integrator *integrator_at(int k)
{
  const baum_integrator *const all[] = {baum_rk4(),      baum_ab4(),   baum_generalized_alpha(),
                                        baum_rk8(),      baum_euler(), baum_ida(),
                                        baum_cvode_bdf()};
  enum { ALL = sizeof all / sizeof *all };
  return k < (baum_has("sundials") ? ALL : ALL - 2) ? all[k] : NULL;
}

static baum_simulation_options options_at(int k)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator_at(k);
  bool fixed = baum_integrator_has_fixed_step(o.integrator) && o.integrator != baum_rk8();
  o.step = fixed ? 1e-3 : o.step;
  o.rtol = fixed ? o.rtol : 1e-5;
  o.energy_account = k % 2 == 0;
  o.max_steps = STEPS;
  return o;
}

static void restore(const scene *s)
{
  FUZZ_CHECK(baum_simulation_restore(s->run, s->saved, s->size) == BAUM_OK);
}

static scene make(const every_element *parts, int k)
{
  scene s = {.parts = parts};
  baum_simulation_options o = options_at(k);
  baum_event_def event = baum_event_def_default();
  event.joint = parts->pin;
  event.value = 0.51;
  event.terminal = false;
  FUZZ_CHECK(baum_simulation_create(parts->mechanism, &o, &s.run) >= BAUM_OK);
  FUZZ_CHECK(baum_simulation_add_event(s.run, &event, NULL) == BAUM_OK);
  FUZZ_CHECK(baum_simulation_step(s.run, 9) >= BAUM_OK);
  FUZZ_CHECK(k % 3 != 0 ||
             baum_simulation_set_driver(s.run, parts->motor, 0.53, 2.0, 0.3) == BAUM_OK);
  FUZZ_CHECK(baum_simulation_save(s.run, NULL, 0, &s.room) == BAUM_OK);
  s.saved = malloc(s.room);
  s.changed = malloc(s.room);
  FUZZ_CHECK(s.saved && s.changed);
  FUZZ_CHECK(baum_simulation_save(s.run, s.saved, s.room, &s.size) == BAUM_OK);
  restore(&s);
  FUZZ_CHECK(baum_simulation_step(s.run, 3) >= BAUM_OK);
  memcpy(s.then, baum_simulation_q(s.run), sizeof s.then);
  return s;
}

static scene *scene_at(int k)
{
  enum { SCENES = 7 };
  static every_element parts;
  static scene all[SCENES];
  int count = 0;
  if (!parts.mechanism) {
    FUZZ_CHECK(every_element_build(&parts) == BAUM_OK);
    FUZZ_CHECK(baum_mechanism_freeze(parts.mechanism) == BAUM_OK);
  }
  while (count < SCENES && integrator_at(count)) {
    if (!all[count].run) {
      all[count] = make(&parts, count);
    }
    count++;
  }
  return &all[k % count];
}

/* ---- buffers ---- */

static void seal(unsigned char *bytes, size_t size)
{
  baum_i_digest sum = {0};
  baum_i_digest_add(&sum, bytes, size - WORD);
  memcpy(bytes + size - WORD, &sum.value, WORD);
}

/* Changes some words or the length of a saved run. Returns the length. */
static size_t change(scene *s, fuzz_bytes *b)
{
  size_t size = s->size;
  memcpy(s->changed, s->saved, s->size);
  for (int k = 1 + fuzz_below(b, MOST_CHANGES); k > 0 && b->left > 0; k--) {
    size_t at = (size_t)(fuzz_byte(b) + 256 * fuzz_byte(b)) % (s->size / WORD) * WORD;
    uint64_t word = (uint64_t)fuzz_byte(b);
    double number = fuzz_number(b);
    switch (fuzz_below(b, 5)) {
    case 0: memcpy(s->changed + at, &word, WORD); break;
    case 1: memcpy(s->changed + at, &number, WORD); break;
    case 2: fuzz_copy(b, s->changed + at, WORD); break;
    case 3: s->changed[at + word % WORD] ^= (unsigned char)(1 << fuzz_below(b, 8)); break;
    default: size = at < WORD ? WORD : at; break;
    }
  }
  seal(s->changed, size);
  return size;
}

static baum_status restore_any(scene *s, fuzz_bytes *b)
{
  if (fuzz_below(b, 8) == 0) {
    return baum_simulation_restore(s->run, b->at, b->left);
  }
  size_t size = change(s, b);
  /* The bytes are in separately allocated memory, so that a sanitizer reports reading past its
   * end. */
  unsigned char *bytes = malloc(size);
  FUZZ_CHECK(bytes);
  memcpy(bytes, s->changed, size);
  baum_status status = baum_simulation_restore(s->run, bytes, size);
  free(bytes);
  return status;
}

static void use(const scene *s)
{
  static double row[4 * EVERY_NV];
  baum_warning warning;
  baum_counters counters;
  baum_event_record record;
  baum_near_singular crossing;
  const baum_channel channel = baum_channel_of(BAUM_ENERGY);
  (void)fuzz_status(baum_simulation_step(s->run, 2));
  (void)fuzz_status(baum_simulation_advance_to(s->run, baum_simulation_time(s->run) - 1e-3));
  (void)fuzz_status(baum_simulation_get(s->run, &channel, 1, row));
  (void)fuzz_status(baum_simulation_counters(s->run, &counters, sizeof counters));
  for (int64_t k = counters.warnings - 1; k >= 0 && k > counters.warnings - 4; k--) {
    (void)fuzz_status(baum_simulation_warning(s->run, k, &warning, sizeof warning));
  }
  for (int64_t k = 0; k < 3; k++) {
    (void)fuzz_status(baum_simulation_event(s->run, k, &record, sizeof record));
    (void)fuzz_status(baum_simulation_near_singular(s->run, k, &crossing, sizeof crossing));
  }
  FUZZ_CHECK(baum_simulation_explain(s->run));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  fuzz_bytes b = {data, size};
  scene *s = scene_at(fuzz_byte(&b));
  restore(s);
  baum_status status = fuzz_status(restore_any(s, &b));
  FUZZ_CHECK(status == BAUM_OK || status == BAUM_ERR_BUFFER);
  if (status == BAUM_OK) {
    use(s);
    restore(s);
  }
  FUZZ_CHECK(baum_simulation_step(s->run, 3) >= BAUM_OK);
  FUZZ_CHECK(memcmp(s->then, baum_simulation_q(s->run), sizeof s->then) == 0);
  return 0;
}
