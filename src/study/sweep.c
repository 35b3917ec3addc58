/* SPDX-License-Identifier: BSD-3-Clause */
#include <baum/sweep.h>

#include <math.h>
#include <stdatomic.h>

#include "base/message.h"
#include "base/platform.h"
#include "base/sized.h"
#include "mechanism/identify.h"

typedef struct sweep {
  const baum_mechanism *mechanism;
  const baum_simulation_options *options;
  const baum_sweep_def *def;
  int32_t width; /* number of columns of all channels together */
  int64_t size;  /* number of values that one run writes into its rows */
  double *rows;
  int32_t *statuses; /* may be NULL */
  atomic_llong next; /* index of the next run */
  baum_i_lock *lock; /* protects the members below */
  int64_t failed;    /* smallest index of a failed run, or def->count if none failed */
  baum_status status;
  baum_i_kept_message message;
} sweep;

void baum_sweep_def_init(baum_sweep_def *def, size_t caller_size)
{
  const baum_sweep_def whole = {.threads = 1};
  baum_i_give_sized(def, caller_size, &whole, sizeof whole);
}

/* ---- one run ---- */

static baum_status sample(const sweep *s, const baum_mechanism *mechanism, double *rows)
{
  baum_simulation *run = NULL;
  baum_status status = baum_simulation_create(mechanism, s->options, &run);
  if (status >= BAUM_OK) {
    status = baum_simulation_sample(run, s->def->times, s->def->time_count, s->def->channels,
                                    s->def->channel_count, rows, NULL);
  }
  baum_simulation_destroy(run);
  return status;
}

/* Checks that change() has not changed the number of columns. */
static baum_status check_width(const sweep *s, const baum_mechanism *copy)
{
  const int32_t width = baum_channels_width(copy, s->def->channels, s->def->channel_count);
  return width == s->width
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT,
                         "the channels have %d columns after change(), but had %d before",
                         (int)width, (int)s->width);
}

static baum_status run_one(const sweep *s, int64_t k, double *rows)
{
  baum_mechanism *copy = NULL;
  for (int64_t i = 0; i < s->size; i++) {
    rows[i] = (double)NAN;
  }
  baum_status status = baum_mechanism_copy(s->mechanism, &copy);
  if (status == BAUM_OK) {
    const baum_i_kept_message kept = baum_i_message_keep();
    (void)baum_i_fail(BAUM_OK, "change() returned an error without a message");
    status = baum_i_message_settle(s->def->change(copy, k, s->def->user), &kept);
  }
  if (status >= BAUM_OK) {
    status = baum_mechanism_freeze(copy);
  }
  if (status >= BAUM_OK) {
    status = check_width(s, copy);
  }
  if (status >= BAUM_OK) {
    status = sample(s, copy, rows);
  }
  baum_mechanism_destroy(copy);
  return status;
}

/* ---- all runs ---- */

static void note_failure(sweep *s, int64_t k, baum_status status)
{
  baum_i_lock_take(s->lock);
  if (k < s->failed) {
    s->failed = k;
    s->status = status;
    s->message = baum_i_message_keep();
  }
  baum_i_lock_give(s->lock);
}

static void work(void *user, int thread)
{
  sweep *s = user;
  (void)thread;
  for (int64_t k = atomic_fetch_add(&s->next, 1); k < s->def->count;
       k = atomic_fetch_add(&s->next, 1)) {
    const baum_status status = run_one(s, k, s->rows + k * s->size);
    if (s->statuses) {
      s->statuses[k] = status;
    }
    if (status < BAUM_OK) {
      note_failure(s, k, status);
    }
  }
}

static baum_status check_def(const baum_sweep_def *def)
{
  const struct {
    const char *what;
    bool good;
  } checks[] = {
    {"count must be > 0", def->count > 0},
    {"change is NULL", def->change != NULL},
    {"time_count must be > 0", def->time_count > 0},
    {"times is NULL", def->times != NULL},
    {"channel_count must be > 0", def->channel_count > 0},
    {"channels is NULL", def->channels != NULL},
    {"threads must be 1 to 1024", def->threads >= 1 && def->threads <= 1024},
  };
  for (size_t k = 0; k < sizeof checks / sizeof *checks; k++) {
    if (!checks[k].good) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_sweep: %s", checks[k].what);
    }
  }
  return BAUM_OK;
}

static baum_status run_all(sweep *s)
{
  const baum_sweep_def *def = s->def;
  s->lock = baum_i_lock_create();
  BAUM_I_TRY(baum_i_check_memory(s->lock));
  baum_i_threads_run(def->threads < def->count ? def->threads : (int)def->count, work, s);
  baum_i_lock_destroy(s->lock);
  return s->failed < def->count
           ? baum_i_fail(s->status, "run %lld: %.900s", (long long)s->failed, s->message.text)
           : BAUM_OK;
}

baum_status baum_sweep(const baum_mechanism *mechanism, const baum_simulation_options *options,
                       const baum_sweep_def *def, double *rows, int32_t *statuses)
{
  const char *call = "baum_sweep";
  baum_sweep_def whole = {.threads = 1};
  BAUM_I_TRY(baum_i_check_frozen(mechanism, call));
  if (!options || !def || !rows) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is NULL", call,
                       !options ? "options" : (!def ? "def" : "rows"));
  }
  BAUM_I_TRY(
    baum_i_take_sized(&whole, sizeof whole, def, call, " of def", "baum_sweep_def_default()"));
  BAUM_I_TRY(check_def(&whole));
  const int32_t width = baum_channels_width(mechanism, whole.channels, whole.channel_count);
  if (width < 0) {
    return BAUM_ERR_ARGUMENT; /* the call has set the message */
  }
  sweep s = {.mechanism = mechanism, .options = options, .def = &whole, .rows = rows};
  s.width = width;
  s.size = (int64_t)whole.time_count * width;
  s.statuses = statuses;
  s.failed = whole.count;
  return run_all(&s);
}
