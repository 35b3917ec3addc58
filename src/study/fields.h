/* SPDX-License-Identifier: BSD-3-Clause */
/* Members of structs by name, for study files, CSV, JSON and the page. The members of an entry are
 * those of BAUM_STUDY_ENTRY_LIST. */
#ifndef BAUM_I_STUDY_FIELDS_H
#define BAUM_I_STUDY_FIELDS_H

#include <baum/study.h>

typedef enum baum_i_kind {
  BAUM_I_TEXT,
  BAUM_I_INTEGRATOR,
  BAUM_I_FORMULATION,
  BAUM_I_STATE,
  BAUM_I_STATUS,
  BAUM_I_LAST_TEXT = BAUM_I_STATUS, /* last kind that is a text in reports */
  BAUM_I_NUMBER,
  BAUM_I_COUNT, /* int64_t */
  BAUM_I_INDEX, /* int32_t */
  BAUM_I_FLAG
} baum_i_kind;

typedef struct baum_i_field {
  const char *key; /* must never change */
  const char *unit;
  const char *meaning;
  baum_i_kind kind;
  bool when_done; /* known only for entries that are done */
  bool filed;     /* written to study files */
  size_t place;   /* offset in the struct */
} baum_i_field;

/* An entry, and the data that a report adds to it. */
typedef struct baum_i_report_entry {
  baum_study_entry entry; /* first member, so that offsets are those of an entry */
  const char *gains;      /* rule; NULL: none */
  double gain[2];         /* its numbers; NaN: none */
  bool front[2];          /* by baum_study_cost */
} baum_i_report_entry;

typedef struct baum_i_report_method {
  baum_study_method method;
  char label[192]; /* name, with "by step" or "by rtol" if the integrator takes both */
} baum_i_report_method;

/* Lists of fields. Each ends with a field whose key is NULL. */
extern const baum_i_field baum_i_entry_fields[];     /* of baum_i_report_entry */
extern const baum_i_field baum_i_method_fields[];    /* of baum_i_report_method */
extern const baum_i_field baum_i_reference_fields[]; /* of baum_study_reference */

/* Returns a text, or NULL if it is not known. */
const char *baum_i_field_text(const baum_i_field *field, const void *object);

/* Returns a number of any kind, or NaN if it is not known. */
double baum_i_field_number(const baum_i_field *field, const void *object);

/* Returns a member that is a whole number, an enum or a flag. Returns 0 for double. */
int64_t baum_i_field_whole(const baum_i_field *field, const void *object);

#endif
