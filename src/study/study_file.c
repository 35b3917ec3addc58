/* SPDX-License-Identifier: BSD-3-Clause */
/* The study file: lines of text, each written at once when its result is known.
 *
 *   baum-study 1 library 0.1.0 structure HEX numbers HEX span HEX samples HEX error HEX account HEX reference HEX #SUM
 *   reference DIGITS ... | TEXT #SUM
 *   row KEY STATE STATUS ... | MESSAGE #SUM
 *   time KEY EVALUATIONS ... #SUM
 *   rehearsed KEY NUMBER #SUM
 *
 * KEY is a sum over the options of a row, so that rows may be added in any order. SUM is over the line before it: a line
 * that is cut off or damaged is not a result, and its row is run again. Of two lines of one row the last counts.
 */
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <baum/version.h>

#include "base/alloc.h"
#include "base/digest.h"
#include "base/text.h"
#include "mechanism/fingerprint.h"
#include "study/study.h"

enum { LINE = 4096, MARKS = 8 };
enum { FILED_MEASURED = 1, FILED_TIMED = 2, FILED_REHEARSED = 4 };
static const char HEAD[] = "baum-study ";

struct baum_i_study_file {
  FILE *stream;
  const char *path;
};

/* ---- fields ---- */

typedef enum field_kind { NUMBER, COUNT, YES_OR_NO, STATE, STATUS } field_kind;

typedef struct field {
  size_t place;
  field_kind kind;
} field;

#define ROW(name, kind)                    \
  {                                        \
    offsetof(baum_study_row, name), (kind) \
  }
#define REFERENCE(name, kind)                    \
  {                                              \
    offsetof(baum_study_reference, name), (kind) \
  }

static const field MEASURED[] = {
  ROW(state, STATE),
  ROW(status, STATUS),
  ROW(at_floor, YES_OR_NO),
  ROW(untrusted, YES_OR_NO),
  ROW(off, YES_OR_NO),
  ROW(unstable, YES_OR_NO),
  ROW(error, NUMBER),
  ROW(error_final, NUMBER),
  ROW(error_half, NUMBER),
  ROW(error_q, NUMBER),
  ROW(error_q_final, NUMBER),
  ROW(error_v, NUMBER),
  ROW(error_v_final, NUMBER),
  ROW(error_lambda, NUMBER),
  ROW(error_lambda_final, NUMBER),
  ROW(energy_error, NUMBER),
  ROW(energy_error_final, NUMBER),
  ROW(max_phi, NUMBER),
  ROW(max_phi_rate, NUMBER),
  ROW(violation_work, NUMBER),
  ROW(projection_work, NUMBER),
  ROW(gains_work, NUMBER),
  ROW(steps, COUNT),
  ROW(rejected, COUNT),
  ROW(nonlinear_iterations, COUNT),
  ROW(forced_steps, COUNT),
  ROW(warnings, COUNT),
  ROW(near_singular_intervals, COUNT),
  ROW(branch_warnings, COUNT),
};

static const field TIMED[] = {
  ROW(evaluations, COUNT), ROW(factorizations, COUNT), ROW(work, NUMBER),
  ROW(cpu, NUMBER),        ROW(cpu_spread, NUMBER),    ROW(repeats, STATE),
};

static const field KNOWN[] = {
  REFERENCE(trusted, YES_OR_NO),         REFERENCE(digits, NUMBER),
  REFERENCE(uncertainty, NUMBER),        REFERENCE(uncertainty_q, NUMBER),
  REFERENCE(uncertainty_v, NUMBER),      REFERENCE(uncertainty_lambda, NUMBER),
  REFERENCE(uncertainty_energy, NUMBER),
};

enum {
  MEASURED_COUNT = sizeof MEASURED / sizeof MEASURED[0],
  TIMED_COUNT = sizeof TIMED / sizeof TIMED[0],
  KNOWN_COUNT = sizeof KNOWN / sizeof KNOWN[0]
};

static int64_t whole_of(const void *place, field_kind kind)
{
  switch (kind) {
  case COUNT: return *(const int64_t *)place;
  case YES_OR_NO: return *(const bool *)place;
  case STATE:
  case STATUS: return *(const int32_t *)place;
  case NUMBER: break;
  }
  return 0;
}

static void put_whole(void *place, field_kind kind, int64_t value)
{
  switch (kind) {
  case COUNT: *(int64_t *)place = value; break;
  case YES_OR_NO: *(bool *)place = value != 0; break;
  case STATE:
  case STATUS: *(int32_t *)place = (int32_t)value; break;
  case NUMBER: break;
  }
}

static void write_fields(char *line, const void *object, const field *fields, int count)
{
  for (int k = 0; k < count; k++) {
    const void *place = (const char *)object + fields[k].place;
    if (fields[k].kind == NUMBER) {
      baum_i_append(line, LINE, " %.17g", *(const double *)place);
    } else {
      baum_i_append(line, LINE, " %" PRId64, whole_of(place, fields[k].kind));
    }
  }
}

/* Returns where the fields end, or NULL. */
static const char *read_fields(const char *text, void *object, const field *fields, int count)
{
  for (int k = 0; k < count; k++) {
    void *place = (char *)object + fields[k].place;
    char *end = NULL;
    if (fields[k].kind == NUMBER) {
      *(double *)place = strtod(text, &end);
    } else {
      put_whole(place, fields[k].kind, strtoll(text, &end, 10));
    }
    if (end == text) {
      return NULL;
    }
    text = end;
  }
  return text;
}

/* ---- lines ---- */

static uint64_t sum_of(const char *text, size_t size)
{
  baum_i_digest digest = {0};
  baum_i_digest_add_integer(&digest, (int64_t)size);
  baum_i_digest_add(&digest, text, size);
  return digest.value;
}

/* Without what would end a line. */
static void add_text(char *line, const char *text)
{
  size_t used = strlen(line);
  baum_i_append(line, LINE, " | %s", text);
  for (char *c = line + used; *c; c++) {
    if (*c == '\n' || *c == '\r') {
      *c = ' ';
    }
  }
}

static baum_status complain(const baum_i_study_file *file, const char *what)
{
  return baum_i_fail(BAUM_ERR_FILE, "study: file %s cannot be %s: %s", file->path, what,
                     strerror(errno));
}

/* A line at once, so that a process that ends here leaves whole lines. */
static baum_status write_line(baum_i_study_file *file, char *line)
{
  baum_i_append(line, LINE, " #%016" PRIx64 "\n", sum_of(line, strlen(line)));
  size_t size = strlen(line);
  errno = 0;
  if (fwrite(line, 1, size, file->stream) != size || fflush(file->stream) != 0) {
    return complain(file, "written");
  }
  return BAUM_OK;
}

/* Cut the sum off a line that agrees with it. */
static bool check_line(char *line)
{
  char *mark = strrchr(line, '#');
  if (!mark || mark == line || mark[-1] != ' ') {
    return false;
  }
  char *end = NULL;
  uint64_t sum = strtoull(mark + 1, &end, 16);
  mark[-1] = '\0';
  return end == mark + 17 && strcmp(end, "\n") == 0 && sum == sum_of(line, strlen(line));
}

/* ---- whose file it is ---- */

/* Something that must be the same, and how it is called. */
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
      value = digest_numbers(r->given[k], (size_t)r->course.n * (size_t)widths[k], value);
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
    {"span", "the time span", digest_numbers(span, 2, 0)},
    {"samples", "the samples", digest_numbers(r->course.times, (size_t)r->course.n, 0)},
    {"error", "what error means", digest_error(study)},
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
  baum_i_append(line, LINE, "baum-study 1");
  for (int k = 0; k < MARKS; k++) {
    baum_i_append(line, LINE, " %s %016" PRIx64, marks[k].name, marks[k].value);
  }
}

static baum_status refuse(const baum_i_study_file *file, const char *why)
{
  return baum_i_fail(BAUM_ERR_BUFFER, "study: file %s %s", file->path, why);
}

static baum_status check_head(const baum_i_study_file *file, const baum_study *study, char *line)
{
  if (strncmp(line, HEAD, strlen(HEAD)) != 0 || !check_line(line)) {
    return refuse(file, "is no study file");
  }
  if (strncmp(line, "baum-study 1 ", 13) != 0) {
    return refuse(file, "is of another version of the format");
  }
  mark marks[MARKS];
  mark_study(study, marks);
  for (int k = 0; k < MARKS; k++) {
    char wanted[64] = "";
    baum_i_append(wanted, sizeof wanted, " %s %016" PRIx64, marks[k].name, marks[k].value);
    if (!strstr(line, wanted)) {
      return baum_i_fail(BAUM_ERR_BUFFER, "study: file %s is of another study: %s differ%s",
                         file->path, marks[k].what, k < 2 || k == 3 ? "" : "s");
    }
  }
  return BAUM_OK;
}

/* ---- reading ---- */

static void take_text(const char *rest, char *text, size_t size)
{
  const char *begin = strstr(rest, "| ");
  (void)snprintf(text, size, "%s", begin ? begin + 2 : "");
}

static void take_measured(const baum_study *study, const char *rest, uint64_t key)
{
  for (int k = 0; k < study->row_count; k++) {
    baum_i_row *row = study->rows[k];
    baum_study_row out = row->out;
    char *end = NULL;
    double limit = strtod(rest, &end);
    const char *text = read_fields(end, &out, MEASURED, MEASURED_COUNT);
    bool too_short = out.state == BAUM_STUDY_TIMED_OUT && limit < study->options.row_limit;
    if (row->key != key || !text || too_short) {
      continue;
    }
    row->filed |= FILED_MEASURED;
    if (!row->measured) {
      row->out = out;
      row->limit = limit;
      row->measured = true;
      take_text(text, row->message, sizeof row->message);
    }
  }
}

static void take_timed(const baum_study *study, const char *rest, uint64_t key)
{
  for (int k = 0; k < study->row_count; k++) {
    baum_i_row *row = study->rows[k];
    baum_study_row out = row->out;
    if (row->key != key || !row->measured || !read_fields(rest, &out, TIMED, TIMED_COUNT)) {
      continue;
    }
    row->filed |= FILED_TIMED;
    if (!row->timed) {
      row->out = out;
      row->timed = true;
    }
  }
}

static void take_reference(baum_study *study, const char *rest)
{
  baum_i_study_reference *r = &study->reference;
  baum_study_reference out = r->out;
  const char *text = read_fields(rest, &out, KNOWN, KNOWN_COUNT);
  if (text && !r->known) {
    r->out = out;
    r->known = true;
    take_text(text, r->text, sizeof r->text);
  }
}

static void take_rehearsed(const baum_study *study, const char *text)
{
  char *end = NULL;
  uint64_t key = strtoull(text, &end, 16);
  for (int k = 0; k < study->row_count; k++) {
    baum_i_row *row = study->rows[k];
    if (row->key == key && row->timed) {
      row->filed |= FILED_REHEARSED;
      row->out.error_rehearsed = strtod(end, NULL);
      row->rehearsed = true;
    }
  }
}

static void take_line(baum_study *study, char *line)
{
  if (!check_line(line)) {
    return;
  }
  if (strncmp(line, "reference ", 10) == 0) {
    take_reference(study, line + 9);
    return;
  }
  if (strncmp(line, "rehearsed ", 10) == 0) {
    take_rehearsed(study, line + 10);
    return;
  }
  bool is_row = strncmp(line, "row ", 4) == 0;
  if (!is_row && strncmp(line, "time ", 5) != 0) {
    return;
  }
  char *end = NULL;
  uint64_t key = strtoull(line + (is_row ? 4 : 5), &end, 16);
  if (is_row) {
    take_measured(study, end, key);
  } else {
    take_timed(study, end, key);
  }
}

/* All lines; `whole` says whether the last one has its end. */
static baum_status read_all(baum_i_study_file *file, baum_study *study, bool *is_new, bool *whole)
{
  char *line = baum_i_alloc(LINE, 1);
  if (!line) {
    return baum_i_fail_memory();
  }
  baum_status status = BAUM_OK;
  *is_new = true;
  *whole = true;
  while (status == BAUM_OK && fgets(line, LINE, file->stream)) {
    *whole = strchr(line, '\n') != NULL;
    if (*is_new && !*whole && strncmp(line, HEAD, strlen(HEAD)) == 0) {
      break; /* it ended before its head was written: nothing is lost */
    }
    if (*is_new) {
      status = check_head(file, study, line);
    } else {
      take_line(study, line);
    }
    *is_new = false;
  }
  if (status == BAUM_OK && ferror(file->stream)) {
    status = complain(file, "read");
  }
  baum_i_free(line);
  return status;
}

/* ---- opening and closing ---- */

/* What is there already. A file that is not there is a new one. */
static baum_status take_present(baum_i_study_file *file, baum_study *study, bool *is_new,
                                bool *whole)
{
  *is_new = true;
  *whole = true;
  errno = 0;
  file->stream = fopen(file->path, "r");
  if (!file->stream) {
    return errno == ENOENT ? BAUM_OK : complain(file, "opened");
  }
  baum_status status = read_all(file, study, is_new, whole);
  (void)fclose(file->stream);
  file->stream = NULL;
  return status;
}

static baum_status begin(baum_i_study_file *file, const baum_study *study, bool is_new, bool whole)
{
  errno = 0;
  file->stream = fopen(file->path, is_new ? "w" : "a");
  if (!file->stream) {
    return complain(file, "opened");
  }
  if (is_new) {
    char line[LINE];
    write_head(study, line);
    return write_line(file, line);
  }
  /* What was cut off becomes a line of its own, which is no result. */
  return whole || fputs("\n", file->stream) >= 0 ? BAUM_OK : complain(file, "written");
}

/* What is known but not in the file, which may have been full. */
static baum_status catch_up(baum_i_study_file *file, const baum_study *study)
{
  baum_status status = BAUM_OK;
  for (int k = 0; k < study->row_count && status == BAUM_OK; k++) {
    const baum_i_row *row = study->rows[k];
    if (row->measured && !(row->filed & FILED_MEASURED)) {
      status = baum_i_study_file_measured(file, row);
    }
    if (status == BAUM_OK && row->timed && !(row->filed & FILED_TIMED)) {
      status = baum_i_study_file_timed(file, row);
    }
    if (status == BAUM_OK && row->rehearsed && !(row->filed & FILED_REHEARSED)) {
      status = baum_i_study_file_rehearsed(file, row);
    }
  }
  return status;
}

baum_status baum_i_study_file_open(baum_study *study, baum_i_study_file **out)
{
  *out = NULL;
  if (!study->options.file) {
    return BAUM_OK;
  }
  baum_i_study_file *file = baum_i_alloc(1, sizeof *file);
  if (!file) {
    return baum_i_fail_memory();
  }
  file->path = study->options.file;
  bool is_new = true;
  bool whole = true;
  for (int k = 0; k < study->row_count; k++) {
    study->rows[k]->filed = 0;
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
  if (file && file->stream && fclose(file->stream) != 0) {
    status = complain(file, "written");
  }
  baum_i_free(file);
  return status;
}

/* ---- writing ---- */

baum_status baum_i_study_file_reference(baum_i_study_file *file, const baum_study *study)
{
  char line[LINE] = "reference";
  if (!file) {
    return BAUM_OK;
  }
  write_fields(line, &study->reference.out, KNOWN, KNOWN_COUNT);
  add_text(line, study->reference.text);
  return write_line(file, line);
}

baum_status baum_i_study_file_measured(baum_i_study_file *file, const baum_i_row *row)
{
  char line[LINE] = "";
  if (!file) {
    return BAUM_OK;
  }
  baum_i_append(line, LINE, "row %016" PRIx64 " %.17g", row->key, row->limit);
  write_fields(line, &row->out, MEASURED, MEASURED_COUNT);
  add_text(line, row->message);
  return write_line(file, line);
}

baum_status baum_i_study_file_timed(baum_i_study_file *file, const baum_i_row *row)
{
  char line[LINE] = "";
  if (!file) {
    return BAUM_OK;
  }
  baum_i_append(line, LINE, "time %016" PRIx64, row->key);
  write_fields(line, &row->out, TIMED, TIMED_COUNT);
  return write_line(file, line);
}

baum_status baum_i_study_file_rehearsed(baum_i_study_file *file, const baum_i_row *row)
{
  char line[LINE] = "";
  if (!file) {
    return BAUM_OK;
  }
  baum_i_append(line, LINE, "rehearsed %016" PRIx64 " %.17g", row->key, row->out.error_rehearsed);
  return write_line(file, line);
}
