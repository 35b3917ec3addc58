/* SPDX-License-Identifier: BSD-3-Clause */
/* The study file consists of lines of text. Each line is written as soon as its result is known.
 *
 *   baum-study 4 structure HEX numbers HEX start HEX span HEX samples HEX error HEX account HEX
 *   reference HEX library HEX #SUM
 *   reference DIGITS ... | TEXT #SUM
 *   entry KEY STAGE LIMIT STATE STATUS ... | MESSAGE #SUM
 *
 * STAGE is 1 for an entry that is measured, 2 for one that is timed, and 3 for one that is
 * validated. KEY is a digest of the options of an entry. The entries of a study may therefore be
 * added in any order. SUM is a digest of the text before it in the line. In all lines except the
 * first, this digest also covers the first line. A line that is incomplete, damaged or from another
 * study is therefore recognized and ignored, and its entry is run again. Each stage of an entry has
 * its own line, with all results that are known at this stage. If there are two lines for the same
 * stage of an entry, the first line without a timeout counts. */
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <baum/version.h>

#include "base/alloc.h"
#include "base/digest.h"
#include "base/platform.h"
#include "base/text.h"
#include "mechanism/fingerprint.h"
#include "mechanism/identify.h"
#include "study/report.h"
#include "study/study.h"
#include "study/study_line.h"

enum { LINE = BAUM_I_STUDY_LINE, MARKS = 9 };
static const char HEAD[] = "baum-study ";
static const char REFERENCE[] = "reference";
static const char ENTRY[] = "entry ";
static const char VERSION[] = "baum-study 4";

struct baum_i_study_file {
  FILE *stream;
  const char *path;
  uint64_t seed; /* digest of the first line; the digests of all other lines continue it */
};

/* ---- lines ---- */

static baum_status fail_file(const baum_i_study_file *file, const char *what)
{
  return baum_i_fail(BAUM_ERR_FILE, "study: file %s cannot be %s: %s", file->path, what,
                     strerror(errno));
}

/* Writes a line and flushes it. If the process is killed later, all lines written so far are
 * complete. */
static baum_status write_line(baum_i_study_file *file, char *line, uint64_t seed)
{
  baum_i_study_seal(line, seed);
  size_t size = strlen(line);
  errno = 0;
  if (fwrite(line, 1, size, file->stream) != size || fflush(file->stream) != 0) {
    return fail_file(file, "written");
  }
  return BAUM_OK;
}

/* ---- identity of the study ---- */

/* A property that must be the same in the study and in the file. `what` is its name in messages. */
typedef struct mark {
  const char *name;
  const char *what;
  uint64_t value;
} mark;

static uint64_t digest_numbers(const double *numbers, size_t count, uint64_t before)
{
  baum_i_digest digest = {before};
  baum_i_digest_add(&digest, numbers, count * sizeof *numbers);
  return digest.value;
}

/* Returns a digest of the data with which runs of the mechanism start. The fingerprint of the
 * mechanism does not contain these data. */
static uint64_t digest_start(const baum_mechanism *m)
{
  baum_i_digest d = {digest_numbers(m->design_q, (size_t)m->nq, 0)};
  for (int i = 0; i < m->nv; i++) {
    const double v = isnan(m->design_v[i]) ? (double)NAN : m->design_v[i]; /* NaN has many forms */
    baum_i_digest_add(&d, &v, sizeof v);
    baum_i_digest_add_integer(&d, m->held[i]);
  }
  return digest_numbers(baum_i_initial_inputs(m), (size_t)m->input_count, d.value);
}

static uint64_t digest_error(const baum_study *study)
{
  baum_i_digest d = {0};
  baum_i_digest_add(&d, &study->unit, sizeof study->unit);
  for (int k = 0; k < study->channel_count; k++) {
    const baum_channel *c = &study->channels[k];
    baum_i_digest_add_integer(&d, c->quantity);
    baum_i_digest_add_integer(&d, c->body.index1);
    baum_i_digest_add_integer(&d, c->joint.index1);
    baum_i_digest_add(&d, c->point, sizeof c->point);
    baum_i_digest_add_integer(&d, c->coordinate);
  }
  return d.value;
}

static uint64_t digest_reference(const baum_study *study)
{
  const baum_i_study_reference *r = &study->reference;
  const baum_mechanism *m = study->mechanism;
  const int widths[3] = {m->nq, m->nv, m->nc};
  uint64_t value = digest_numbers(&r->digits, 1, (uint64_t)r->out.origin);
  for (int k = 0; k < 3; k++) {
    if (r->given[k]) {
      value = digest_numbers(r->given[k], (size_t)r->samples.n * (size_t)widths[k], value);
    }
  }
  return value;
}

static void mark_study(const baum_study *study, mark marks[MARKS])
{
  baum_i_fingerprint print = baum_i_mechanism_fingerprint(study->mechanism);
  const double span[2] = {study->t0, study->t1};
  const baum_i_study_reference *r = &study->reference;
  const mark all[MARKS] = {
    {"structure", "the elements of the mechanism", print.structure},
    {"numbers", "the numbers of the mechanism", print.numbers},
    {"start", "the initial positions, velocities, inputs or held bodies",
     digest_start(study->mechanism)},
    {"span", "the time span", digest_numbers(span, 2, 0)},
    {"samples", "the samples", digest_numbers(r->samples.times, (size_t)r->samples.n, 0)},
    {"error", "the definition of the error", digest_error(study)},
    {"account", "the option energy_account", study->options.energy_account},
    {"reference", "the reference", digest_reference(study)},
    {"library", "the version of the library", 0},
  };
  memcpy(marks, all, sizeof all);
  baum_i_digest version = {0};
  baum_i_digest_add_text(&version, baum_version());
  marks[MARKS - 1].value = version.value;
}

static void write_head(const baum_study *study, char *line)
{
  mark marks[MARKS];
  mark_study(study, marks);
  line[0] = '\0';
  baum_i_append(line, LINE, "%s", VERSION);
  for (int k = 0; k < MARKS; k++) {
    baum_i_append(line, LINE, " %s %016" PRIx64, marks[k].name, marks[k].value);
  }
}

static uint64_t seed_of(const baum_study *study)
{
  char head[LINE];
  baum_i_digest digest = {0};
  write_head(study, head);
  baum_i_digest_add_text(&digest, head);
  return digest.value;
}

static baum_status refuse(const baum_i_study_file *file, const char *why)
{
  return baum_i_fail(BAUM_ERR_BUFFER, "study: file %s %s", file->path, why);
}

static baum_status check_head(const baum_i_study_file *file, const baum_study *study, char *line)
{
  if (strncmp(line, HEAD, strlen(HEAD)) != 0 || !baum_i_study_unseal(line, 0)) {
    return refuse(file, "is not a study file");
  }
  if (strncmp(line, VERSION, strlen(VERSION)) != 0 || line[strlen(VERSION)] != ' ') {
    return refuse(file, "has another version of the format; use another file");
  }
  mark marks[MARKS];
  mark_study(study, marks);
  for (int k = 0; k < MARKS; k++) {
    char wanted[64] = "";
    baum_i_append(wanted, sizeof wanted, " %s %016" PRIx64, marks[k].name, marks[k].value);
    if (!strstr(line, wanted)) {
      return baum_i_fail(BAUM_ERR_BUFFER,
                         "study: file %s belongs to another study: %s differ%s; use another file",
                         file->path, marks[k].what, k < 3 || k == 4 ? "" : "s");
    }
  }
  return BAUM_OK;
}

/* ---- reading ---- */

/* Returns the text that follows " | ". Returns NULL if " | " is missing. */
static const char *text_at(const char *rest)
{
  return rest && strncmp(rest, " | ", 3) == 0 ? rest + 3 : NULL;
}

/* Reads the part STAGE LIMIT FIELDS | MESSAGE of an entry's line. */
static void take_entry(const baum_study *study, baum_i_entry *entry, const char *rest)
{
  baum_study_entry out = entry->out;
  double number = 0.0;
  double limit = 0.0;
  rest = baum_i_read_number(rest, &number);
  rest = rest ? baum_i_read_number(rest, &limit) : NULL;
  const char *message =
    text_at(rest ? baum_i_study_read_fields(rest, &out, baum_i_entry_fields) : NULL);
  if (!message || (out.state == BAUM_STUDY_TIMED_OUT && !(limit >= study->options.entry_limit))) {
    return;
  }
  baum_i_stage stage = BAUM_I_MEASURED;
  if (out.state == BAUM_STUDY_DONE && number >= BAUM_I_TIMED) {
    stage = number >= BAUM_I_VALIDATED ? BAUM_I_VALIDATED : BAUM_I_TIMED;
  }
  entry->filed = stage > entry->filed ? stage : entry->filed;
  if (stage > entry->stage || entry->out.state == BAUM_STUDY_TIMED_OUT) {
    entry->out = out;
    entry->limit = limit;
    entry->stage = stage;
    (void)snprintf(entry->message, sizeof entry->message, "%s", message);
  }
}

static void take_reference(baum_study *study, const char *rest)
{
  baum_i_study_reference *r = &study->reference;
  baum_study_reference out = r->out;
  const char *text = text_at(baum_i_study_read_fields(rest, &out, baum_i_reference_fields));
  if (text && !r->known) {
    r->out = out;
    r->known = true;
    (void)snprintf(r->text, sizeof r->text, "%s", text);
  }
}

static void take_line(const baum_i_study_file *file, baum_study *study, char *line)
{
  if (!baum_i_study_unseal(line, file->seed)) {
    return;
  }
  if (strncmp(line, REFERENCE, strlen(REFERENCE)) == 0) {
    take_reference(study, line + strlen(REFERENCE));
  } else if (strncmp(line, ENTRY, strlen(ENTRY)) == 0) {
    char *rest = NULL;
    uint64_t key = strtoull(line + strlen(ENTRY), &rest, 16);
    for (int k = 0; k < study->entry_count; k++) { /* several entries may have equal options */
      if (study->entries[k]->key == key) {
        take_entry(study, study->entries[k], rest);
      }
    }
  }
}

/* Tells whether the file ends within its first line. Such a file contains no results. */
static bool is_begun_head(const baum_i_study_file *file, const baum_study *study, const char *line)
{
  char head[LINE];
  size_t size = strlen(line);
  write_head(study, head);
  baum_i_study_seal(head, 0);
  return size < strlen(head) && strncmp(line, head, size) == 0 && feof(file->stream) &&
         ftell(file->stream) == (long)size;
}

/* Reads all lines. *is_new is set to true if the first line is missing or incomplete, and *whole is
 * set to true if the last line is complete. */
static baum_status read_all(baum_i_study_file *file, baum_study *study, bool *is_new, bool *whole)
{
  char *line = baum_i_alloc(LINE, 1);
  BAUM_I_TRY(baum_i_check_memory(line));
  baum_status status = BAUM_OK;
  *is_new = true;
  *whole = true;
  while (status == BAUM_OK && fgets(line, LINE, file->stream)) {
    *whole = strchr(line, '\n') != NULL;
    if (*is_new && is_begun_head(file, study, line)) {
      break;
    }
    if (*is_new) {
      status = check_head(file, study, line);
    } else {
      take_line(file, study, line);
    }
    *is_new = false;
  }
  if (status == BAUM_OK && ferror(file->stream)) {
    status = fail_file(file, "read");
  }
  baum_i_free(line);
  return status;
}

/* ---- opening and closing ---- */

/* Reads the study file. If there is no file, *is_new and *whole are set to true. */
static baum_status take_present(baum_i_study_file *file, baum_study *study, bool *is_new,
                                bool *whole)
{
  *is_new = true;
  *whole = true;
  if (baum_i_is_no_file(file->path)) {
    return baum_i_fail(BAUM_ERR_FILE, "study: file %s is not a regular file", file->path);
  }
  errno = 0;
  file->stream = baum_i_file_open(file->path, "rb");
  if (!file->stream) {
    return errno == ENOENT ? BAUM_OK : fail_file(file, "opened");
  }
  baum_status status = read_all(file, study, is_new, whole);
  (void)fclose(file->stream);
  file->stream = NULL;
  return status;
}

static baum_status begin(baum_i_study_file *file, const baum_study *study, bool is_new, bool whole)
{
  errno = 0;
  file->stream = baum_i_file_open(file->path, is_new ? "wb" : "ab");
  if (!file->stream) {
    return fail_file(file, "opened");
  }
  if (is_new) {
    char line[LINE];
    write_head(study, line);
    return write_line(file, line, 0);
  }
  /* A newline ends an incomplete last line. Readers ignore this line, because its digest is
   * missing. */
  return whole || fputs("\n", file->stream) >= 0 ? BAUM_OK : fail_file(file, "written");
}

/* Writes known results of entries that are not in the file. An earlier attempt to write them may
 * have failed, for example because the disk was full. */
static baum_status catch_up(baum_i_study_file *file, const baum_study *study)
{
  for (int k = 0; k < study->entry_count; k++) {
    if (study->entries[k]->stage > study->entries[k]->filed) {
      BAUM_I_TRY(baum_i_study_file_entry(file, study->entries[k]));
    }
  }
  return BAUM_OK;
}

baum_status baum_i_study_file_open(baum_study *study, baum_i_study_file **out)
{
  *out = NULL;
  if (!study->options.file) {
    return BAUM_OK;
  }
  baum_i_study_file *file = baum_i_alloc(1, sizeof *file);
  BAUM_I_TRY(baum_i_check_memory(file));
  file->path = study->options.file;
  file->seed = seed_of(study);
  bool is_new = true;
  bool whole = true;
  for (int k = 0; k < study->entry_count; k++) {
    study->entries[k]->filed = BAUM_I_ADDED;
  }
  baum_status status = take_present(file, study, &is_new, &whole);
  if (status == BAUM_OK) {
    status = begin(file, study, is_new, whole);
  }
  if (status == BAUM_OK) {
    status = catch_up(file, study);
  }
  if (status != BAUM_OK) {
    (void)baum_i_study_file_close(file);
    return status;
  }
  *out = file;
  return BAUM_OK;
}

baum_status baum_i_study_file_close(baum_i_study_file *file)
{
  baum_status status = BAUM_OK;
  if (file && file->stream) {
    int reason = baum_i_file_sync(file->stream);
    if (fclose(file->stream) != 0 || reason != 0) {
      errno = reason ? reason : errno;
      status = fail_file(file, "written");
    }
  }
  baum_i_free(file);
  return status;
}

/* ---- writing ---- */

baum_status baum_i_study_file_reference(baum_i_study_file *file, const baum_study *study)
{
  char line[LINE] = "";
  if (!file) {
    return BAUM_OK;
  }
  baum_i_append(line, LINE, "%s", REFERENCE);
  baum_i_study_write_fields(line, &study->reference.out, baum_i_reference_fields);
  baum_i_study_write_text(line, study->reference.text);
  return write_line(file, line, file->seed);
}

baum_status baum_i_study_file_entry(baum_i_study_file *file, const baum_i_entry *entry)
{
  char line[LINE] = "";
  if (!file) {
    return BAUM_OK;
  }
  baum_i_append(line, LINE, "%s%016" PRIx64 " %d %s", ENTRY, entry->key, (int)entry->stage,
                baum_i_exact(entry->limit, "inf").text);
  baum_i_study_write_fields(line, &entry->out, baum_i_entry_fields);
  baum_i_study_write_text(line, entry->message);
  return write_line(file, line, file->seed);
}
