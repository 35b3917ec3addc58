/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines of the study file. They contain results as text, and each line ends with a digest. */
#include "study/study_line.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/buffer.h"
#include "base/digest.h"
#include "base/text.h"

enum { LINE = BAUM_I_STUDY_LINE };

/* ---- writing ---- */

static const char *name_of_not_finite(double x)
{
  if (isnan(x)) {
    return signbit(x) ? "-nan" : "nan";
  }
  return x > 0.0 ? "inf" : "-inf";
}

void baum_i_study_write_fields(char line[LINE], const void *object, const baum_i_field *fields)
{
  for (const baum_i_field *f = fields; f->key; f++) {
    if (f->filed && f->kind == BAUM_I_NUMBER) {
      double x = *(const double *)(const void *)((const char *)object + f->place);
      baum_i_append(line, LINE, " %s", baum_i_exact(x, name_of_not_finite(x)).text);
    } else if (f->filed) {
      baum_i_append(line, LINE, " %" PRId64, baum_i_field_whole(f, object));
    }
  }
}

void baum_i_study_write_text(char line[LINE], const char *text)
{
  size_t used = strlen(line);
  baum_i_append(line, LINE, " | %s", text);
  for (char *c = line + used; *c; c++) {
    if (*c == '\n' || *c == '\r') {
      *c = ' ';
    }
  }
}

/* ---- reading ---- */

static bool is_one_of(baum_i_kind kind, int64_t value)
{
  bool is_status = kind == BAUM_I_STATUS;
  bool is_state = kind == BAUM_I_STATE;
  int64_t least = is_state ? BAUM_STUDY_DONE : is_status ? INT32_MIN : 0;
  int64_t most = is_state               ? BAUM_STUDY_TIMED_OUT
                 : kind == BAUM_I_FLAG  ? 1
                 : kind == BAUM_I_COUNT ? INT64_MAX
                                        : INT32_MAX;
  return value >= least && value <= most &&
         !(is_status && strcmp(baum_status_name((baum_status)value), "BAUM_?") == 0);
}

static void put_whole(void *place, baum_i_kind kind, int64_t value)
{
  if (kind == BAUM_I_COUNT) {
    *(int64_t *)place = value;
  } else if (kind == BAUM_I_FLAG) {
    *(bool *)place = value != 0;
  } else {
    *(int32_t *)place = (int32_t)value; /* enums are stored in the same way */
  }
}

const char *baum_i_study_read_fields(const char *text, void *object, const baum_i_field *fields)
{
  for (const baum_i_field *f = fields; f->key && text; f++) {
    void *place = (char *)object + f->place;
    if (f->filed && f->kind == BAUM_I_NUMBER) {
      text = baum_i_read_number(text, place);
    } else if (f->filed) {
      char *end = NULL;
      int64_t value = strtoll(text, &end, 10);
      text = end != text && is_one_of(f->kind, value) ? end : NULL;
      if (text) {
        put_whole(place, f->kind, value);
      }
    }
  }
  return text;
}

/* ---- sums ---- */

static uint64_t sum_of(const char *text, uint64_t seed)
{
  baum_i_digest digest = {seed};
  baum_i_digest_add_text(&digest, text);
  return digest.value;
}

void baum_i_study_seal(char line[LINE], uint64_t seed)
{
  baum_i_append(line, LINE, " #%016" PRIx64 "\n", sum_of(line, seed));
}

bool baum_i_study_unseal(char *line, uint64_t seed)
{
  char *mark = strrchr(line, '#');
  if (!mark || mark == line || mark[-1] != ' ') {
    return false;
  }
  char *end = NULL;
  uint64_t sum = strtoull(mark + 1, &end, 16);
  mark[-1] = '\0';
  bool is_whole = end == mark + 17 && strcmp(end + (*end == '\r'), "\n") == 0;
  return is_whole && sum == sum_of(line, seed);
}
