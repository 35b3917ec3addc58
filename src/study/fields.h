/* SPDX-License-Identifier: BSD-3-Clause */
/* Tables that list the members of structs by name. They determine the fields of study files, CSV,
 * JSON and the page. BAUM_STUDY_ENTRY_LIST lists the members of an entry. */
#ifndef BAUM_I_STUDY_FIELDS_H
#define BAUM_I_STUDY_FIELDS_H

#include <baum/study.h>

typedef enum baum_i_kind {
  BAUM_I_TEXT,
  BAUM_I_INTEGRATOR,
  BAUM_I_FORMULATION,
  BAUM_I_STATE,
  BAUM_I_STATUS,
  BAUM_I_LAST_TEXT = BAUM_I_STATUS, /* the last kind that reports show as text */
  BAUM_I_NUMBER,
  BAUM_I_COUNT, /* int64_t */
  BAUM_I_INDEX, /* int32_t */
  BAUM_I_FLAG
} baum_i_kind;

typedef struct baum_i_field {
  const char *key; /* name of the member, which must never change */
  const char *unit;
  const char *meaning;
  baum_i_kind kind;
  bool when_done; /* known only for entries whose state is "done" */
  bool filed;     /* whether study files contain the field */
  size_t place;   /* offset of the member in its struct */
} baum_i_field;

/* An entry of a study with the data that a report adds to it. */
typedef struct baum_i_report_entry {
  baum_study_entry entry; /* first: its members have the same offsets in this struct */
  const char *gains;      /* name of the rule for gains; NULL if there is none */
  double gain[2];         /* the parameters of this rule; NaN if it has none */
  bool front[2];          /* whether the entry is on the Pareto front, for each baum_study_cost */
} baum_i_report_entry;

typedef struct baum_i_report_method {
  baum_study_method method;
  char label[192]; /* name, followed by "by step" or "by rtol" if the integrator can use both */
} baum_i_report_method;

/* The tables of fields. Each table ends with a field whose key is NULL. */
extern const baum_i_field baum_i_entry_fields[];     /* fields of a baum_i_report_entry */
extern const baum_i_field baum_i_method_fields[];    /* fields of a baum_i_report_method */
extern const baum_i_field baum_i_reference_fields[]; /* fields of a baum_study_reference */

/* Returns the value of a member that is a text. Returns NULL if the value is not known. */
const char *baum_i_field_text(const baum_i_field *field, const void *object);

/* Returns the value of a member that is a number of any kind. Returns NaN if the value is not
 * known. */
double baum_i_field_number(const baum_i_field *field, const void *object);

/* Returns the value of a member that is a whole number, an enum or a flag. Returns 0 if the member
 * is a double. */
int64_t baum_i_field_whole(const baum_i_field *field, const void *object);

#endif
