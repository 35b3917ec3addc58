/* SPDX-License-Identifier: BSD-3-Clause */
/* Members of structs under their names: what stands of them in study files, CSV, JSON and on the
 * page. Those of an entry come from BAUM_STUDY_ENTRY_LIST. */
#ifndef BAUM_I_STUDY_FIELDS_H
#define BAUM_I_STUDY_FIELDS_H

#include <baum/study.h>

typedef enum baum_i_kind {
  BAUM_I_TEXT,
  BAUM_I_INTEGRATOR,
  BAUM_I_FORMULATION,
  BAUM_I_STATE,
  BAUM_I_STATUS,
  BAUM_I_LAST_TEXT = BAUM_I_STATUS, /* those before are texts in reports */
  BAUM_I_NUMBER,
  BAUM_I_COUNT, /* int64_t */
  BAUM_I_INDEX, /* int32_t */
  BAUM_I_FLAG
} baum_i_kind;

typedef struct baum_i_field {
  const char *key; /* never to be changed */
  const char *unit;
  const char *meaning;
  baum_i_kind kind;
  bool when_done; /* a figure of entries that are done */
  bool filed;     /* in study files, too */
  size_t place;   /* in the struct */
} baum_i_field;

/* An entry with what a report says of it besides. */
typedef struct baum_i_report_entry {
  baum_study_entry entry; /* first, so that its fields are those of an entry alone */
  const char *gains;      /* rule; NULL: none */
  double gain[2];         /* its numbers; NaN: it has none */
  bool front[2];          /* by baum_study_cost */
} baum_i_report_entry;

typedef struct baum_i_report_method {
  baum_study_method method;
  char label[192]; /* its name, with "by step" or "by rtol" where the integrator takes both */
} baum_i_report_method;

/* Each ends with a field whose key is NULL. */
extern const baum_i_field baum_i_entry_fields[];     /* of baum_i_report_entry */
extern const baum_i_field baum_i_method_fields[];    /* of baum_i_report_method */
extern const baum_i_field baum_i_reference_fields[]; /* of baum_study_reference */

/* A text; NULL: not known. */
const char *baum_i_field_text(const baum_i_field *field, const void *object);

/* A number of any kind; NaN: not known. */
double baum_i_field_number(const baum_i_field *field, const void *object);

/* Members of all kinds but texts as they are, enums and flags among them; 0 for double. */
int64_t baum_i_field_whole(const baum_i_field *field, const void *object);

#endif
