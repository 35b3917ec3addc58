/* SPDX-License-Identifier: BSD-3-Clause */
/* Makes runs with arbitrary options, and calls functions of these runs with arbitrary arguments.
 * After each call, the state of the run must be finite. */
#include <math.h>
#include <string.h>

#include "drawn.h"

enum { STEPS = 40, CHANNELS = 14, WIDTH = 400, LOOKS = 6, MECHANISMS = 2 };

/* ---- mechanisms, made once for all inputs ---- */

/* Makes a particle on a massless rod. This mechanism has no user functions, so that every
 * formulation can be used. */
static baum_mechanism *make_pendulum(every_element *parts)
{
  baum_mechanism *m = NULL;
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  bob.position[0] = 1.0;
  FUZZ_CHECK(baum_mechanism_create(&m) == BAUM_OK);
  FUZZ_CHECK(baum_mechanism_add_planar_particle(m, &bob, &parts->bob) == BAUM_OK);
  rod.body_a = BAUM_GROUND;
  rod.body_b = parts->bob;
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  FUZZ_CHECK(baum_mechanism_add_planar_distance(m, &rod, &parts->rod) == BAUM_OK);
  FUZZ_CHECK(baum_mechanism_freeze(m) == BAUM_OK);
  return m;
}

static const every_element *mechanism_at(int k)
{
  static every_element all[MECHANISMS];
  static every_fault fault;
  if (!all[0].mechanism) {
    all[0].fault = &fault;
    FUZZ_CHECK(every_element_build(&all[0]) == BAUM_OK);
    FUZZ_CHECK(baum_mechanism_freeze(all[0].mechanism) == BAUM_OK);
    all[1].mechanism = make_pendulum(&all[1]);
  }
  *all[0].fault = (every_fault){.answer = 0};
  return &all[k];
}

/* ---- calls ---- */

/* A run, and the bytes of the input that have not been used yet. */
typedef struct scene {
  baum_simulation *run;
  const every_element *parts;
  fuzz_bytes *b;
  int nv;
  double *q; /* (nv) */
  double *v;
} scene;

static int stop_soon(const baum_simulation *run, double t, void *user)
{
  int *left = user;
  (void)t;
  FUZZ_CHECK(isfinite(baum_simulation_time(run)));
  return --*left < 0;
}

static void advance(const scene *s)
{
  double t = baum_simulation_time(s->run) + fuzz_number(s->b) / 32.0;
  (void)fuzz_status(baum_simulation_advance_to(s->run, t));
}

static void take_steps(const scene *s)
{
  (void)fuzz_status(baum_simulation_step(s->run, fuzz_below(s->b, 8)));
}

static void sample(const scene *s)
{
  static double rows[3 * WIDTH];
  const baum_channel channels[] = {baum_channel_of(BAUM_A), baum_channel_of(BAUM_ENERGY)};
  double times[3];
  int64_t done = -1;
  times[0] = baum_simulation_time(s->run);
  times[1] = times[0] + fuzz_number(s->b) / 32.0;
  times[2] = times[1] + fuzz_number(s->b) / 32.0;
  (void)fuzz_status(baum_simulation_sample(s->run, times, 3, channels, 2, rows, &done));
  FUZZ_CHECK(done >= 0 && done <= 3);
}

static void set_state(const scene *s)
{
  memcpy(s->q, baum_simulation_q(s->run), (size_t)s->nv * sizeof *s->q);
  memcpy(s->v, baum_simulation_v(s->run), (size_t)s->nv * sizeof *s->v);
  double t = fuzz_below(s->b, 2) == 0 ? baum_simulation_time(s->run) : fuzz_number(s->b);
  for (int k = fuzz_below(s->b, 4); k > 0; k--) {
    s->q[fuzz_below(s->b, s->nv)] += fuzz_small(s->b);
    s->v[fuzz_below(s->b, s->nv)] = fuzz_number(s->b);
  }
  (void)fuzz_status(baum_simulation_set_state(s->run, t, s->q, s->v));
}

static void set_acting(const scene *s)
{
  double x[3] = {fuzz_number(s->b), fuzz_number(s->b), fuzz_number(s->b)};
  (void)fuzz_status(baum_simulation_set_input(s->run, s->parts->throttle, x[0]));
  (void)fuzz_status(baum_simulation_set_driver(s->run, s->parts->motor, x[0], x[1], x[2]));
}

/* Makes the user functions fail from a chosen call on, or makes them work again. */
static void set_fault(const scene *s)
{
  if (s->parts->fault) {
    *s->parts->fault = (every_fault){.answer = fuzz_below(s->b, 3) - 1,
                                     .fails = fuzz_below(s->b, 2) == 1,
                                     .from = 1 + fuzz_byte(s->b)};
  }
}

static void add_event(const scene *s)
{
  baum_event_def def = baum_event_def_default();
  def.joint = s->parts->pin;
  def.value = fuzz_number(s->b);
  def.direction = fuzz_below(s->b, 4) - 1;
  def.terminal = fuzz_below(s->b, 2) == 1;
  def.tolerance = fuzz_number(s->b);
  (void)fuzz_status(baum_simulation_add_event(s->run, &def, NULL));
}

static void get_channels(const scene *s)
{
  static double row[WIDTH];
  baum_channel channel = baum_channel_of((baum_quantity)fuzz_below(s->b, CHANNELS + 2));
  channel.body = fuzz_below(s->b, 2) == 0 ? s->parts->bob : s->parts->crank;
  channel.joint = fuzz_below(s->b, 2) == 0 ? s->parts->rod : s->parts->motor;
  channel.point[0] = fuzz_number(s->b);
  int width = baum_channels_width(s->parts->mechanism, &channel, 1);
  FUZZ_CHECK(width <= WIDTH);
  baum_status status = fuzz_status(baum_simulation_get(s->run, &channel, 1, row));
  for (int k = 0; k < width && status == BAUM_OK; k++) {
    FUZZ_CHECK(isfinite(row[k]) || channel.quantity == BAUM_ENERGY_ACCOUNT);
  }
}

/* Saves a run and restores it. The time of the restored run must be the time at which the run was
 * saved. */
static void save_and_restore(const scene *s)
{
  enum { BYTES = 1 << 20 };
  static unsigned char buffer[BYTES];
  size_t size = 0;
  double t = baum_simulation_time(s->run);
  FUZZ_CHECK(baum_simulation_save(s->run, NULL, 0, &size) == BAUM_OK && size <= BYTES);
  FUZZ_CHECK(baum_simulation_save(s->run, buffer, BYTES, &size) == BAUM_OK);
  if (fuzz_below(s->b, 2) == 0) {
    take_steps(s);
  }
  FUZZ_CHECK(baum_simulation_restore(s->run, buffer, size) == BAUM_OK);
  FUZZ_CHECK(baum_simulation_time(s->run) == t);
}

static void read_all(const scene *s)
{
  baum_warning warning;
  baum_counters counters;
  baum_energy_account account;
  baum_near_singular crossing;
  baum_event_record record;
  FUZZ_CHECK(baum_simulation_explain(s->run) && baum_simulation_message(s->run));
  (void)fuzz_status(baum_simulation_counters(s->run, &counters, sizeof counters));
  (void)fuzz_status(baum_simulation_energy_account(s->run, &account, sizeof account));
  (void)fuzz_status(baum_simulation_near_singular(s->run, 0, &crossing, sizeof crossing));
  (void)fuzz_status(baum_simulation_event(s->run, 0, &record, sizeof record));
  (void)fuzz_status(baum_simulation_warning(s->run, 0, &warning, sizeof warning));
}

static void call(const scene *s)
{
  switch (fuzz_below(s->b, 12)) {
  case 0:
  case 1: advance(s); break;
  case 2:
  case 3: take_steps(s); break;
  case 4: sample(s); break;
  case 5: set_state(s); break;
  case 6: set_acting(s); break;
  case 7: set_fault(s); break;
  case 8: add_event(s); break;
  case 9: get_channels(s); break;
  case 10: save_and_restore(s); break;
  default: baum_simulation_cancel(s->run); break;
  }
}

static void check_stands(const scene *s)
{
  FUZZ_CHECK(isfinite(baum_simulation_time(s->run)));
  for (int i = 0; i < s->nv; i++) {
    FUZZ_CHECK(isfinite(baum_simulation_q(s->run)[i]) && isfinite(baum_simulation_v(s->run)[i]));
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  enum { CALLS = 10, COORDINATES = 128 /* larger than nq of every_element */ };
  fuzz_bytes b = {data, size};
  double factors[DRAWN_ROOM];
  double q[COORDINATES];
  double v[COORDINATES];
  int looks = LOOKS + fuzz_below(&b, 4 * STEPS);
  scene s = {.parts = mechanism_at(fuzz_below(&b, MECHANISMS)), .b = &b, .q = q, .v = v};
  baum_simulation_options options;
  design_options(&b, STEPS, factors, &options);
  options.progress = stop_soon;
  options.user = &looks;
  baum_status status = fuzz_status(baum_simulation_create(s.parts->mechanism, &options, &s.run));
  FUZZ_CHECK((status >= BAUM_OK) == (s.run != NULL));
  if (!s.run) {
    return 0;
  }
  FUZZ_CHECK(baum_mechanism_sizes(s.parts->mechanism, NULL, &s.nv, NULL) == BAUM_OK);
  check_stands(&s);
  for (int k = 0; k < CALLS && b.left > 0; k++) {
    call(&s);
    check_stands(&s);
  }
  read_all(&s);
  baum_simulation_destroy(s.run);
  return 0;
}
