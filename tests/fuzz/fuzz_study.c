/* SPDX-License-Identifier: BSD-3-Clause */
/* Continues studies from files. Some files consist of arbitrary bytes. Others are study files with
 * changed bits or lines, or with lines of another study. In further files, fields are changed and
 * the digests of their lines are corrected. If the library refuses a file, the file must be
 * unchanged. If it accepts a file, the entries of the study must be exactly those of a study
 * without a file, unless a digest was corrected. Running a completed study again must compute
 * nothing. */
#define _GNU_SOURCE /* for mkstemp */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/digest.h"
#include "bytes.h"
#include "models.h"
#include "study/study_line.h"

enum { ENTRIES = 3, TEXT = 1 << 15, LINES = 64, MOST_CHANGES = 8, FORMS = 4 };

/* ---- the file, at the same path for all inputs ---- */

static char path[] = "/tmp/baum-fuzz-study-XXXXXX";

static void remove_file(void)
{
  (void)remove(path);
}

static void make_file(void)
{
  int file = mkstemp(path);
  FUZZ_CHECK(file >= 0 && close(file) == 0 && atexit(remove_file) == 0);
}

static void write_file(const char *text, size_t size)
{
  FILE *file = fopen(path, "wb");
  FUZZ_CHECK(file && fwrite(text, 1, size, file) == size && fclose(file) == 0);
}

static size_t read_file(char text[TEXT])
{
  FILE *file = fopen(path, "rb");
  FUZZ_CHECK(file);
  size_t size = fread(text, 1, TEXT - 1, file);
  FUZZ_CHECK(fclose(file) == 0 && size < TEXT - 1);
  text[size] = '\0';
  return size;
}

/* ---- studies ---- */

/* Makes study 0 or study 1. They differ only in their end times. */
static baum_study *make_study(int which)
{
  static model pendulum;
  baum_study *study = NULL;
  baum_study_options o = baum_study_options_default();
  o.samples = 4;
  o.repeats = 1;
  o.file = path;
  if (!pendulum.mechanism) {
    FUZZ_CHECK(model_pendulum_rod(&MODEL_PENDULUM_A01, &pendulum) == BAUM_OK);
  }
  FUZZ_CHECK(baum_study_create(pendulum.mechanism, 0.0, which ? 0.06 : 0.05, &study) == BAUM_OK);
  FUZZ_CHECK(baum_study_set_options(study, &o) == BAUM_OK);
  for (int k = 0; k < ENTRIES; k++) {
    baum_simulation_options run = baum_simulation_options_default();
    run.integrator = k < 2 ? baum_rk4() : baum_euler();
    run.formulation = k < 2 ? BAUM_FORMULATION_PROJECTION : BAUM_FORMULATION_BAUMGARTE;
    /* The library refuses the last entry, because its gains are unstable. */
    run.gains = k < 2 ? run.gains : baum_gains_fixed(1e3, 1e3);
    run.step = k == 1 ? 0.01 : 0.02;
    FUZZ_CHECK(baum_study_add(study, &run) == BAUM_OK);
  }
  return study;
}

static baum_study_entry entry_of(const baum_study *study, int k)
{
  baum_study_entry entry;
  FUZZ_CHECK(baum_study_entry_at(study, k, &entry, sizeof entry) == BAUM_OK);
  return entry;
}

/* Tells whether two numbers are equal. Two NaNs count as equal. */
static bool same(double a, double b)
{
  return memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
}

#define CHECK_SAME(type, name, known, unit, meaning) \
  FUZZ_CHECK(same((double)a.name, (double)b.name));

static void check_same_entries(const baum_study *one, const baum_study *other, bool times)
{
  for (int k = 0; k < ENTRIES; k++) {
    baum_study_entry a = entry_of(one, k);
    baum_study_entry b = entry_of(other, k);
    if (!times) {
      a.cpu = a.cpu_spread = b.cpu = b.cpu_spread = 0.0;
    }
    BAUM_STUDY_ENTRY_LIST(CHECK_SAME)
    FUZZ_CHECK(strcmp(a.message, b.message) == 0);
  }
}

/* Study 0 without a file, the file that study 0 writes, and the file that study 1 writes. */
typedef struct truth {
  baum_study *study;
  char text[2][TEXT];
  uint64_t seed; /* for the digests in the lines of study 0 */
} truth;

static const truth *true_ones(void)
{
  static truth t;
  if (!t.study) {
    make_file();
    for (int k = 1; k >= 0; k--) {
      write_file("", 0);
      baum_study_destroy(t.study);
      t.study = make_study(k);
      FUZZ_CHECK(baum_study_run(t.study) == BAUM_OK);
      (void)read_file(t.text[k]);
    }
    FUZZ_CHECK(entry_of(t.study, ENTRIES - 1).state == BAUM_STUDY_REFUSED);
    baum_i_digest digest = {0};
    static char head[BAUM_I_STUDY_LINE];
    (void)snprintf(head, sizeof head, "%.*s\n", (int)strcspn(t.text[0], "\n"), t.text[0]);
    FUZZ_CHECK(baum_i_study_unseal(head, 0));
    baum_i_digest_add_text(&digest, head);
    t.seed = digest.value;
  }
  return &t;
}

/* ---- texts ---- */

/* The first LINES lines of a file, each with its line end. */
typedef struct document {
  char line[LINES][BAUM_I_STUDY_LINE];
  int count;
  bool sealed; /* whether the digest of a changed line has been corrected */
} document;

static void add_line(document *d, const char *line)
{
  if (d->count < LINES) {
    memmove(d->line[d->count++], line, strlen(line) + 1);
  }
}

static void add_text(document *d, const char *text)
{
  char line[BAUM_I_STUDY_LINE];
  while (*text) {
    size_t size = strcspn(text, "\n") + 1;
    (void)snprintf(line, sizeof line, "%.*s", (int)size, text);
    add_line(d, line);
    text += size;
  }
}

/* Replaces a word of a line, and corrects the digest of the line. */
static void change_field(document *d, fuzz_bytes *b, char *line, const truth *t)
{
  static const char *const words[] = {
    "0",    "1",   "-1", "2",  "3", "4",          "5",   "1e300",  "-1e-300",
    "nan",  "inf", "-5", "10", "",  "2147483648", "| x", "5e-324", "9223372036854775807",
    "1e999"};
  enum { WORDS = sizeof words / sizeof *words };
  static char copy[BAUM_I_STUDY_LINE];
  uint64_t seed = line == d->line[0] ? 0 : t->seed;
  (void)snprintf(copy, sizeof copy, "%s", line);
  if (!baum_i_study_unseal(copy, seed)) {
    return;
  }
  char *begin = copy;
  for (int k = fuzz_below(b, 40); k > 0 && strchr(begin, ' '); k--) {
    begin = strchr(begin, ' ') + 1;
  }
  const char *rest = begin + strcspn(begin, " ");
  (void)snprintf(line, BAUM_I_STUDY_LINE - 32, "%.*s%s%s", (int)(begin - copy), copy,
                 words[fuzz_below(b, WORDS)], rest);
  baum_i_study_seal(line, seed);
  d->sealed = true;
}

static void change(document *d, fuzz_bytes *b, const truth *t)
{
  char *line = d->line[fuzz_below(b, d->count)];
  size_t length = strlen(line);
  size_t at = length ? (size_t)(fuzz_byte(b) + 256 * fuzz_byte(b)) % length : 0;
  switch (fuzz_below(b, 8)) {
  case 0: line[at] = (char)(line[at] ^ (1 << fuzz_below(b, 8))); break;
  case 1: line[at] = (char)fuzz_byte(b); break;
  case 2: line[at] = '\0'; break;
  case 3: line[0] = '\0'; break;
  case 4: add_line(d, line); break;
  case 5: add_text(d, t->text[1]); break;
  case 6: memmove(line, d->line[fuzz_below(b, d->count)], BAUM_I_STUDY_LINE); break;
  default: change_field(d, b, line, t); break;
  }
}

/* Writes the changed file. Returns true if the digest of a changed line has been corrected. */
static bool write_changed(fuzz_bytes *b, const truth *t)
{
  static document d;
  static char text[LINES * BAUM_I_STUDY_LINE];
  d.count = 0;
  d.sealed = false;
  add_text(&d, t->text[0]);
  for (int k = 1 + fuzz_below(b, MOST_CHANGES); k > 0 && b->left > 0; k--) {
    change(&d, b, t);
  }
  size_t size = 0;
  for (int k = 0; k < d.count; k++) {
    size_t length = strlen(d.line[k]);
    memcpy(text + size, d.line[k], length);
    size += length;
  }
  write_file(text, size);
  return d.sealed;
}

/* ---- studies that continue from the file ---- */

static void read_all(const baum_study *study, fuzz_bytes *b)
{
  static char text[TEXT];
  baum_simulation_options options;
  baum_study_method method;
  int32_t entries[ENTRIES];
  int32_t count = 0;
  double cost = 0.0;
  baum_report_form form = (baum_report_form)fuzz_below(b, FORMS);
  FUZZ_CHECK(baum_study_print(study, form, NULL, text, sizeof text, NULL) == BAUM_OK);
  for (int k = 0; k < baum_study_method_count(study); k++) {
    FUZZ_CHECK(baum_study_method_at(study, k, &method, sizeof method) == BAUM_OK);
    (void)fuzz_status(baum_study_cost_at(study, k, 1e-6, BAUM_STUDY_WORK, &cost));
  }
  for (int cheap = BAUM_STUDY_WORK; cheap <= BAUM_STUDY_CPU; cheap++) {
    FUZZ_CHECK(baum_study_front(study, (baum_study_cost)cheap, ENTRIES, entries, &count) ==
               BAUM_OK);
    FUZZ_CHECK(count >= 0 && count <= ENTRIES);
    double error = fuzz_small(b);
    (void)fuzz_status(baum_study_recommend(study, error, (baum_study_cost)cheap, &options,
                                           sizeof options, text, sizeof text));
  }
  (void)fuzz_status(
    baum_study_recommend_budget(study, 1e-3, &options, sizeof options, text, sizeof text));
}

/* Runs the completed study again. The study must compute nothing and leave the file unchanged. */
static void check_over(const baum_study *study)
{
  static char before[TEXT];
  static char after[TEXT];
  size_t size = read_file(before);
  baum_study *again = make_study(0);
  baum_status status = fuzz_status(baum_study_run(again));
  FUZZ_CHECK(status == BAUM_OK || status == BAUM_WARNED);
  check_same_entries(study, again, true);
  FUZZ_CHECK(read_file(after) == size && memcmp(before, after, size) == 0);
  baum_study_destroy(again);
}

static void check_left_alone(const baum_study *study, const char *before, size_t size)
{
  static char after[TEXT];
  FUZZ_CHECK(read_file(after) == size && memcmp(before, after, size) == 0);
  for (int k = 0; k < ENTRIES; k++) {
    FUZZ_CHECK(entry_of(study, k).state == BAUM_STUDY_WAITING);
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static char text[TEXT];
  fuzz_bytes b = {data, size};
  const truth *t = true_ones();
  bool sealed = false;
  if (fuzz_below(&b, 8) == 0) {
    write_file((const char *)b.at, b.left);
  } else {
    sealed = write_changed(&b, t);
  }
  size_t length = read_file(text);
  baum_study *study = make_study(0);
  baum_status status = fuzz_status(baum_study_run(study));
  /* A line with a corrected digest may claim that an entry is done although its run fails. The
   * study then fails when it measures the CPU time of this entry. */
  FUZZ_CHECK(status == BAUM_OK || status == BAUM_ERR_BUFFER || sealed);
  if (status == BAUM_ERR_BUFFER) {
    check_left_alone(study, text, length);
  } else if (status >= BAUM_OK) {
    if (!sealed) {
      check_same_entries(t->study, study, false);
    }
    read_all(study, &b);
    check_over(study);
  }
  baum_study_destroy(study);
  return 0;
}
