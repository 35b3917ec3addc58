/* SPDX-License-Identifier: BSD-3-Clause */
/* A run into memory and back.
 *
 * A buffer is words of eight bytes as this machine has them:
 *
 *   "baumsave"       a number by which byte order and doubles are known      version
 *   size in bytes    fingerprint of the mechanism (2)                        sum over the names of the parts
 *   for each part of the list in saved.h: its length in bytes, and its bytes filled up to whole words
 *   sum over all before (base/digest.h)
 *
 * Everything is checked before anything changes. What methods remember of steps, and pivots, are not in it: saving
 * makes the run forget them, as restoring does, so that both go on alike.
 */
#include <math.h>
#include <string.h>

#include "base/digest.h"
#include "mechanism/fingerprint.h"
#include "mechanism/general/driven.h"
#include "simulate/account.h"
#include "simulate/companion.h"
#include "simulate/crossing.h"
#include "simulate/events.h"
#include "simulate/rows.h"
#include "simulate/saved.h"
#include "simulate/schedule.h"

enum { WORD = 8 };

static const char MAGIC[WORD + 1] = "baumsave";
static const double NUMBER = 0x1.123456789abcdp+42; /* no two bytes are the same */

typedef struct header {
  char magic[WORD];
  double number;
  uint64_t version;
  uint64_t size;
  baum_i_fingerprint mechanism;
  uint64_t parts;
} header;

static size_t padded(size_t size)
{
  return (size + WORD - 1) / WORD * WORD;
}

/* Which parts there are. */
static uint64_t sum_of_names(const baum_i_saved *list)
{
  baum_i_digest sum = {0};
  for (int k = 0; k < list->count; k++) {
    baum_i_digest_add_text(&sum, list->parts[k].name);
  }
  return sum.value;
}

static header header_of(const baum_simulation *run, const baum_i_saved *list)
{
  header h = {.number = NUMBER, .version = BAUM_I_SAVED_VERSION, .parts = sum_of_names(list)};
  memcpy(h.magic, MAGIC, WORD);
  h.mechanism = run->fingerprint;
  return h;
}

/* The most that a list takes. */
static size_t largest_size(const baum_i_saved *list)
{
  size_t size = sizeof(header) + WORD;
  for (int k = 0; k < list->count; k++) {
    size += WORD + padded(list->parts[k].size);
  }
  return size;
}

/* ---- forget ---- */

/* What no buffer holds. */
static void forget(baum_simulation *run)
{
  baum_i_workspace_forget(run->workspace);
  baum_i_companion_forget(run);
  if (run->account) {
    baum_i_account_forget(run->account);
  }
  if (baum_i_integrator_remembers(run->integrator, &run->problem)) {
    run->integrator->forget(run->self);
  }
}

/* Values there have been asked for before; should one fail now, what is known of them stays. */
static void go_on_with_events(baum_simulation *run)
{
  if (baum_i_events_evaluate(run, &run->state) == BAUM_OK) {
    baum_i_events_go_on(run);
  }
}

/* The state that is reported becomes the one from which the next step goes. */
static void begin_anew(baum_simulation *run)
{
  baum_i_run_end_before_change(run);
  if (baum_i_integrator_remembers(run->integrator, &run->problem)) {
    baum_i_run_copy(run, &run->state, &run->ahead);
    run->origin = run->state.t;
    if (run->account) {
      baum_i_account_go_on(run);
    }
    if (run->events) {
      go_on_with_events(run);
    }
    run->counters.restarts++;
  }
  forget(run);
}

/* ---- save ---- */

/* Bytes of a part, of which it has at most BAUM_I_SAVED_TEXT of its own. */
static const void *bytes_of(const baum_i_saved_part *part, char own[BAUM_I_SAVED_TEXT],
                            size_t *size)
{
  *size = part->size;
  switch (part->kind) {
  case BAUM_I_SAVED_NUMBER: memcpy(own, &part->number, sizeof part->number); return own;
  case BAUM_I_SAVED_INTEGER: memcpy(own, &part->integer, sizeof part->integer); return own;
  case BAUM_I_SAVED_TEXT_OF:
    memset(own, 0, BAUM_I_SAVED_TEXT);
    memcpy(own, part->place, strnlen(part->place, BAUM_I_SAVED_TEXT - 1));
    return own;
  case BAUM_I_SAVED_NUMBERS: *size = part->place ? part->size : 0; return part->place;
  case BAUM_I_SAVED_SOME: *size = part->used; return part->place;
  case BAUM_I_SAVED_CHOICE:
  case BAUM_I_SAVED_BOUNDED:
  case BAUM_I_SAVED_STATE:
  case BAUM_I_SAVED_JUMPS:
  case BAUM_I_SAVED_ROWS:
  default: return part->place;
  }
}

static unsigned char *put(unsigned char *to, const void *bytes, size_t size)
{
  if (size > 0) {
    memcpy(to, bytes, size);
    memset(to + size, 0, padded(size) - size);
  }
  return to + padded(size);
}

static size_t write_all(const baum_simulation *run, const baum_i_saved *list, unsigned char *buffer)
{
  unsigned char *next = buffer + sizeof(header);
  for (int k = 0; k < list->count; k++) {
    char own[BAUM_I_SAVED_TEXT];
    size_t size = 0;
    const void *bytes = bytes_of(&list->parts[k], own, &size);
    uint64_t length = size;
    next = put(next, &length, sizeof length);
    next = put(next, bytes, size);
  }
  size_t before = (size_t)(next - buffer);
  header h = header_of(run, list);
  h.size = before + WORD;
  (void)put(buffer, &h, sizeof h);
  baum_i_digest sum = {0};
  baum_i_digest_add(&sum, buffer, before);
  (void)put(next, &sum.value, sizeof sum.value);
  return before + WORD;
}

baum_status baum_simulation_save(baum_simulation *simulation, void *buffer, size_t capacity,
                                 size_t *size)
{
  const char *call = "baum_simulation_save";
  if (!simulation || !size) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is NULL", call,
                       simulation ? "size" : "the simulation");
  }
  baum_status status = baum_i_run_may_be_changed(simulation, call); /* it forgets pivots */
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_saved list;
  baum_i_saved_list(simulation, &list);
  size_t most = largest_size(&list);
  if (!buffer) {
    *size = most;
    return BAUM_OK;
  }
  if (capacity < most) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: capacity is %zu bytes, must be at least %zu; ask with a buffer that is "
                       "NULL",
                       call, capacity, most);
  }
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  begin_anew(simulation);
  baum_i_run_count(simulation);
  baum_i_saved_list(simulation, &list); /* there may be more of them now */
  *size = write_all(simulation, &list, buffer);
  return baum_i_run_end_call(simulation, BAUM_OK, &kept);
}

/* ---- check ---- */

/* The buffer of a restore. */
typedef struct reader {
  const unsigned char *bytes;
  size_t size;
  header head;
  const unsigned char *at[BAUM_I_SAVED_PARTS]; /* where each part is */
  size_t length[BAUM_I_SAVED_PARTS];
} reader;

#define refuse(...) baum_i_fail(BAUM_ERR_BUFFER, "baum_simulation_restore: " __VA_ARGS__)

/* Is it of this library, and whole? */
static baum_status check_header(reader *r)
{
  const header *h = &r->head;
  if (r->size < sizeof *h + WORD) {
    return refuse("the buffer has %zu bytes, less than its head; it is cut off, or none of "
                  "baum_simulation_save()",
                  r->size);
  }
  memcpy(&r->head, r->bytes, sizeof r->head);
  if (memcmp(h->magic, MAGIC, WORD) != 0) {
    return refuse("the buffer is none of baum_simulation_save()");
  }
  if (h->number != NUMBER) { /* also where it is no number there */
    return refuse("the buffer is of a machine with another order of bytes or other numbers, or "
                  "damaged");
  }
  if (h->version != BAUM_I_SAVED_VERSION) {
    return refuse("the buffer has version %llu of the format, this library reads version %d; save "
                  "with the library that restores",
                  (unsigned long long)h->version, (int)BAUM_I_SAVED_VERSION);
  }
  if (h->size > r->size) {
    return refuse("the buffer has %zu bytes of %llu; it is cut off", r->size,
                  (unsigned long long)h->size);
  }
  if (h->size < sizeof *h + WORD || h->size % WORD != 0) {
    return refuse("the buffer is damaged: it says that it has %llu bytes",
                  (unsigned long long)h->size);
  }
  return BAUM_OK;
}

static baum_status check_sum(reader *r)
{
  size_t before = (size_t)r->head.size - WORD;
  baum_i_digest sum = {0};
  baum_i_digest_add(&sum, r->bytes, before);
  if (memcmp(&sum.value, r->bytes + before, WORD) != 0) {
    return refuse("the buffer is damaged: its sum is not that of its bytes");
  }
  return BAUM_OK;
}

static baum_status check_mechanism(const reader *r, const baum_simulation *run)
{
  const baum_i_fingerprint *there = &r->head.mechanism;
  const baum_i_fingerprint *here = &run->fingerprint;
  if (there->structure != here->structure) {
    return refuse("the buffer is of another mechanism: kinds, number or connections of elements "
                  "differ");
  }
  if (there->numbers != here->numbers) {
    return refuse("the buffer is of another mechanism: elements are the same, but not all masses, "
                  "lengths or other numbers of theirs");
  }
  return BAUM_OK;
}

/* A lone double that must agree; one that is not given, as there. */
static baum_status check_number(const baum_i_saved_part *part, const unsigned char *at)
{
  double there = 0.0;
  memcpy(&there, at, sizeof there);
  if (there == part->number || (isnan(there) && isnan(part->number))) {
    return BAUM_OK;
  }
  return refuse("the buffer is of a run with other options: %s is %.9g there and %.9g here",
                part->name, there, part->number);
}

static baum_status check_integer(const baum_i_saved_part *part, const unsigned char *at)
{
  int64_t there = 0;
  memcpy(&there, at, sizeof there);
  if (there == part->integer) {
    return BAUM_OK;
  }
  return refuse("the buffer is of a run with other options: %s is %lld there and %lld here",
                part->name, (long long)there, (long long)part->integer);
}

/* A bool, an int32_t or an int64_t. */
static int64_t whole_number(const baum_i_saved_part *part, const unsigned char *at)
{
  int32_t shorter = at[0];
  int64_t longer = 0;
  if (part->size == sizeof longer) {
    memcpy(&longer, at, sizeof longer);
    return longer;
  }
  if (part->size == sizeof shorter) {
    memcpy(&shorter, at, sizeof shorter);
  }
  return shorter;
}

static baum_status check_bounds(const baum_i_saved_part *part, const unsigned char *at)
{
  int64_t there = whole_number(part, at);
  if (there >= part->least && there <= part->most) {
    return BAUM_OK;
  }
  return refuse("the buffer is damaged: %s is %lld there", part->name, (long long)there);
}

static baum_status check_text(const baum_i_saved_part *part, const unsigned char *at)
{
  char there[BAUM_I_SAVED_TEXT];
  memcpy(there, at, sizeof there);
  there[sizeof there - 1] = '\0';
  if (strcmp(there, part->place) == 0) {
    return BAUM_OK;
  }
  return refuse("the buffer is of a run with other options: %s is %s there and %s here", part->name,
                there, (const char *)part->place);
}

/* Whether a part may have this length. */
static bool has_length(const baum_i_saved_part *part, size_t length)
{
  if (part->kind == BAUM_I_SAVED_JUMPS) {
    return length % sizeof(baum_i_jump) == 0;
  }
  if (part->kind == BAUM_I_SAVED_SOME) {
    return length <= part->size && length % part->unit == 0;
  }
  return length == part->size || (part->kind == BAUM_I_SAVED_NUMBERS && length == 0);
}

static baum_status check_choice(const baum_i_saved_part *part, const unsigned char *at)
{
  if (part->size == 0 || memcmp(at, part->place, part->size) == 0) {
    return BAUM_OK;
  }
  return refuse("the buffer does not fit: %s is not as it is here", part->name);
}

static baum_status check_rows(const baum_i_saved_part *part, const unsigned char *at)
{
  int64_t left_out = 0;
  bool sound = true;
  for (size_t i = 0; i < part->size; i++) {
    sound = sound && at[i] <= 1;
    left_out += at[i];
  }
  if (sound && (left_out == part->integer || part->integer == 0)) {
    return BAUM_OK;
  }
  return refuse("the buffer does not fit: %s is not as it may be here", part->name);
}

static baum_status check_jumps(const baum_i_saved_part *part, const unsigned char *at,
                               size_t length)
{
  if (baum_i_schedule_is_sound(at, length, part->integer)) {
    return BAUM_OK;
  }
  return refuse("the buffer is damaged: %s are not in order", part->name);
}

static baum_status check_part(const baum_i_saved_part *part, const unsigned char *at, size_t length)
{
  if (!has_length(part, length)) {
    return refuse("the buffer does not fit: %s has %zu bytes there and %zu here", part->name,
                  length, part->size);
  }
  switch (part->kind) {
  case BAUM_I_SAVED_NUMBER: return check_number(part, at);
  case BAUM_I_SAVED_INTEGER: return check_integer(part, at);
  case BAUM_I_SAVED_TEXT_OF: return check_text(part, at);
  case BAUM_I_SAVED_BOUNDED: return check_bounds(part, at);
  case BAUM_I_SAVED_CHOICE: return check_choice(part, at);
  case BAUM_I_SAVED_ROWS: return check_rows(part, at);
  case BAUM_I_SAVED_JUMPS: return check_jumps(part, at, length);
  case BAUM_I_SAVED_STATE:
  case BAUM_I_SAVED_NUMBERS:
  case BAUM_I_SAVED_SOME:
  default: return BAUM_OK;
  }
}

/* Where the parts are, and whether each fits. */
static baum_status check_parts(reader *r, const baum_i_saved *list)
{
  size_t next = sizeof(header);
  size_t end = (size_t)r->head.size - WORD;
  for (int k = 0; k < list->count; k++) {
    uint64_t length = 0;
    if (end - next < WORD) {
      return refuse("the buffer does not fit: it ends before %s", list->parts[k].name);
    }
    memcpy(&length, r->bytes + next, sizeof length);
    next += WORD;
    if (length > end - next) {
      return refuse("the buffer does not fit: it ends in %s", list->parts[k].name);
    }
    r->at[k] = r->bytes + next;
    r->length[k] = (size_t)length;
    next += padded((size_t)length);
    baum_status status = check_part(&list->parts[k], r->at[k], r->length[k]);
    if (status != BAUM_OK) {
      return status;
    }
  }
  return next == end ? BAUM_OK : refuse("the buffer does not fit: there is something behind it");
}

static double number_at(const unsigned char *bytes, int k)
{
  double number = 0.0;
  memcpy(&number, bytes + (size_t)k * sizeof number, sizeof number);
  return number;
}

/* A driver that has no other motion than its polynomial cannot be without it. */
static baum_status check_laws(const baum_mechanism *m, const unsigned char *numbers)
{
  for (int k = 0; k < m->joint_count; k++) {
    int at = m->joints[k]->element.parameter + BAUM_I_DRIVER_POLYNOMIAL;
    if (m->joints[k]->type->drives && m->parameters[at] != 0.0 && number_at(numbers, at) == 0.0) {
      return refuse("the buffer is damaged: it has no law for joint %d", k + 1);
    }
  }
  return BAUM_OK;
}

static baum_status check_all_laws(const reader *r, const baum_mechanism *m,
                                  const baum_i_saved *list)
{
  baum_status status = BAUM_OK;
  for (int k = 0; k < list->count && status == BAUM_OK; k++) {
    if (list->parts[k].kind == BAUM_I_SAVED_NUMBERS && r->length[k] > 0) {
      status = check_laws(m, r->at[k]);
    }
  }
  return status;
}

static baum_status check(reader *r, const baum_simulation *run, const baum_i_saved *list)
{
  baum_status status = check_header(r);
  if (status == BAUM_OK) {
    status = check_sum(r);
  }
  if (status == BAUM_OK) {
    status = check_mechanism(r, run);
  }
  if (status != BAUM_OK) {
    return status;
  }
  status = check_parts(r, list);
  if (status == BAUM_OK && r->head.parts != sum_of_names(list)) {
    status = refuse("the buffer does not fit: it has other parts; save with the library that "
                    "restores");
  }
  return status == BAUM_OK ? check_all_laws(r, run->workspace->mechanism, list) : status;
}

/* ---- put back ---- */

static bool is_put_back(const baum_i_saved_part *part)
{
  return part->kind == BAUM_I_SAVED_STATE || part->kind == BAUM_I_SAVED_BOUNDED ||
         part->kind == BAUM_I_SAVED_SOME;
}

static baum_status leave_out_rows(baum_simulation *run, const reader *r, const baum_i_saved *list)
{
  baum_status status = BAUM_OK;
  for (int k = 0; k < list->count && run->workspace->redundancy.count > 0; k++) {
    if (list->parts[k].kind == BAUM_I_SAVED_ROWS) {
      status = baum_i_run_omit_rows(run, r->at[k]);
    }
  }
  return status == BAUM_OK || status == BAUM_ERR_MEMORY
           ? status
           : refuse("the buffer is damaged: the rows that it leaves out cannot be spared");
}

/* A run without numbers of its own gets them when the buffer has some. Jumps of inputs may be more than here. */
static baum_status make_room(baum_simulation *run, const reader *r, const baum_i_saved *list)
{
  baum_status status = BAUM_OK;
  for (int k = 0; k < list->count && status == BAUM_OK; k++) {
    baum_i_saved_kind kind = list->parts[k].kind;
    if (kind == BAUM_I_SAVED_NUMBERS && r->length[k] > 0) {
      status = baum_i_run_own_parameters(run);
    } else if (kind == BAUM_I_SAVED_JUMPS) {
      status = baum_i_schedule_reserve(&run->schedule, (int)(r->length[k] / sizeof(baum_i_jump)));
    }
  }
  return status == BAUM_OK ? leave_out_rows(run, r, list) : status;
}

static void put_numbers_back(baum_simulation *run, const unsigned char *at, size_t length)
{
  const baum_mechanism *m = run->workspace->mechanism;
  if (run->parameters) {
    memcpy(run->parameters, length > 0 ? (const void *)at : m->parameters,
           (size_t)m->parameter_count * sizeof *run->parameters);
  }
}

static void put_jumps_back(baum_i_schedule *schedule, const unsigned char *at, size_t length)
{
  schedule->count = (int)(length / sizeof *schedule->jumps);
  if (length > 0) {
    memcpy(schedule->jumps, at, length);
  }
}

/* Ids of another process have other tags. */
static void own_id(const baum_simulation *run, baum_joint_id *id)
{
  const baum_mechanism *m = run->workspace->mechanism;
  bool is_joint = id->index1 > 0 && id->index1 <= m->joint_count;
  *id = baum_i_joint_id(m, is_joint ? id->index1 - 1 : -1);
}

static void own_ids(baum_simulation *run)
{
  own_id(run, &run->counters.max_phi_joint);
  own_id(run, &run->counters.max_phi_rate_joint);
  for (int k = 0; run->crossings && k < BAUM_I_PASSAGES; k++) {
    own_id(run, &run->crossings->kept[k].joint);
  }
}

/* Whatever bytes they were. */
static void own_warnings(baum_simulation *run)
{
  for (int64_t k = 0; k < run->counters.warnings; k++) {
    baum_warning *warning = &run->warnings[k];
    own_id(run, &warning->joint);
    warning->doubts_motion = baum_i_doubts_motion(warning->code);
    warning->text[sizeof warning->text - 1] = '\0';
  }
}

static void put_back(baum_simulation *run, const reader *r, const baum_i_saved *list)
{
  for (int k = 0; k < list->count; k++) {
    const baum_i_saved_part *part = &list->parts[k];
    if (part->kind == BAUM_I_SAVED_NUMBERS) {
      put_numbers_back(run, r->at[k], r->length[k]);
    } else if (part->kind == BAUM_I_SAVED_JUMPS) {
      put_jumps_back(&run->schedule, r->at[k], r->length[k]);
    } else if (is_put_back(part) && r->length[k] > 0) {
      memcpy(part->place, r->at[k], r->length[k]);
    }
  }
  own_ids(run);
  own_warnings(run);
  baum_i_run_count_from_here(run);
  baum_i_run_copy(run, &run->state, &run->ahead);
  forget(run);
}

baum_status baum_simulation_restore(baum_simulation *simulation, const void *buffer, size_t size)
{
  if (!simulation || !buffer) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_simulation_restore: %s is NULL",
                       simulation ? "the buffer" : "the simulation");
  }
  baum_status status = baum_i_run_may_be_changed(simulation, "baum_simulation_restore");
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  baum_i_saved list;
  baum_i_saved_list(simulation, &list);
  reader r = {.bytes = buffer, .size = size};
  status = check(&r, simulation, &list);
  if (status == BAUM_OK) {
    status = make_room(simulation, &r, &list);
  }
  if (status == BAUM_OK) {
    put_back(simulation, &r, &list);
  }
  return baum_i_run_end_call(simulation, status, &kept);
}
