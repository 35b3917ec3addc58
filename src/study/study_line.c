/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines of the study file: results as text, and the sum at the end of each. */
#include "study/study_line.h"

#include <inttypes.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <baum/study.h>

#include "base/digest.h"
#include "base/text.h"
#include "study/report_buffer.h"

enum { LINE = BAUM_I_STUDY_LINE };

/* ---- fields ---- */

typedef enum field_kind { NUMBER, COUNT, YES_OR_NO, STATE, STATUS, REPEATS } field_kind;

struct baum_i_study_field {
  size_t place;
  field_kind kind;
};

#define ROW(name, kind)                      \
  {                                          \
    offsetof(baum_study_entry, name), (kind) \
  }
#define REFERENCE(name, kind)                    \
  {                                              \
    offsetof(baum_study_reference, name), (kind) \
  }

static const baum_i_study_field MEASURED[] = {
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
  ROW(alpha, NUMBER),
  ROW(beta, NUMBER),
  ROW(doubts, COUNT),
  ROW(error_estimate, NUMBER),
};

static const baum_i_study_field TIMED[] = {
  ROW(evaluations, COUNT), ROW(factorizations, COUNT), ROW(work, NUMBER),
  ROW(cpu, NUMBER),        ROW(cpu_spread, NUMBER),    ROW(repeats, REPEATS),
};

static const baum_i_study_field VALIDATED[] = {ROW(error_validated, NUMBER)};

static const baum_i_study_field KNOWN[] = {
  REFERENCE(trusted, YES_OR_NO),         REFERENCE(digits, NUMBER),
  REFERENCE(uncertainty, NUMBER),        REFERENCE(uncertainty_q, NUMBER),
  REFERENCE(uncertainty_v, NUMBER),      REFERENCE(uncertainty_lambda, NUMBER),
  REFERENCE(uncertainty_energy, NUMBER),
};

#define FIELDS(list)                       \
  {                                        \
    (list), sizeof(list) / sizeof(list)[0] \
  }

const baum_i_study_fields baum_i_measured_fields = FIELDS(MEASURED);
const baum_i_study_fields baum_i_timed_fields = FIELDS(TIMED);
const baum_i_study_fields baum_i_validated_fields = FIELDS(VALIDATED);
const baum_i_study_fields baum_i_reference_fields = FIELDS(KNOWN);

/* ---- writing ---- */

static int64_t whole_of(const void *place, field_kind kind)
{
  switch (kind) {
  case COUNT: return *(const int64_t *)place;
  case YES_OR_NO: return *(const bool *)place;
  case STATE:
  case STATUS:
  case REPEATS: return *(const int32_t *)place;
  case NUMBER: break;
  }
  return 0;
}

static const char *name_of_not_finite(double x)
{
  if (isnan(x)) {
    return signbit(x) ? "-nan" : "nan";
  }
  return x > 0.0 ? "inf" : "-inf";
}

void baum_i_study_write_fields(char line[LINE], const void *object,
                               const baum_i_study_fields *fields)
{
  for (int k = 0; k < fields->count; k++) {
    const baum_i_study_field *field = &fields->list[k];
    const void *place = (const char *)object + field->place;
    if (field->kind == NUMBER) {
      double x = *(const double *)place;
      baum_i_append(line, LINE, " %s", baum_i_exact(x, name_of_not_finite(x)).text);
    } else {
      baum_i_append(line, LINE, " %" PRId64, whole_of(place, field->kind));
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

static bool is_one_of(field_kind kind, int64_t value)
{
  switch (kind) {
  case YES_OR_NO: return value == 0 || value == 1;
  case STATE: return value >= BAUM_STUDY_DONE && value <= BAUM_STUDY_TIMED_OUT;
  case STATUS:
    return value >= INT32_MIN && value <= INT32_MAX &&
           strcmp(baum_status_name((baum_status)value), "BAUM_?") != 0;
  case REPEATS: return value >= 1 && value <= INT32_MAX;
  case COUNT:
  case NUMBER: break;
  }
  return value >= 0;
}

static void put_whole(void *place, field_kind kind, int64_t value)
{
  switch (kind) {
  case COUNT: *(int64_t *)place = value; break;
  case YES_OR_NO: *(bool *)place = value != 0; break;
  case STATE:
  case STATUS:
  case REPEATS: *(int32_t *)place = (int32_t)value; break;
  case NUMBER: break;
  }
}

static const char *read_whole(const char *text, void *place, field_kind kind)
{
  char *end = NULL;
  int64_t value = strtoll(text, &end, 10);
  if (end == text || !is_one_of(kind, value)) {
    return NULL;
  }
  put_whole(place, kind, value);
  return end;
}

const char *baum_i_study_read_fields(const char *text, void *object,
                                     const baum_i_study_fields *fields)
{
  for (int k = 0; k < fields->count && text; k++) {
    const baum_i_study_field *field = &fields->list[k];
    void *place = (char *)object + field->place;
    text = field->kind == NUMBER ? baum_i_read_number(text, place)
                                 : read_whole(text, place, field->kind);
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
