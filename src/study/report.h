/* SPDX-License-Identifier: BSD-3-Clause */
/* Reports from the inside: what is read from a study, once, and what each form makes of it. */
#ifndef BAUM_I_STUDY_REPORT_H
#define BAUM_I_STUDY_REPORT_H

#include <stdio.h>

#include <baum/report.h>

#include "study/report_buffer.h"

/* Errors that are asked for: 1e-2, 1e-4, ... 1e-10. */
enum { BAUM_I_ADVICE = 5, BAUM_I_COSTS = 2 };

/* An entry with what a report says of it besides. */
typedef struct baum_i_report_entry {
  baum_study_entry entry;
  const char *integrator;
  const char *formulation;
  const char *gains; /* rule */
  double gain[2];    /* its numbers; NaN: it has none */
  const char *state;
  const char *status;
  const char *message;      /* NULL without */
  bool front[BAUM_I_COSTS]; /* by baum_study_cost */
} baum_i_report_entry;

/* What is recommended for an error. */
typedef struct baum_i_advice {
  double error;
  baum_status status;
  baum_simulation_options options; /* those of the setting, if the status is not an error */
  char setting[256];               /* in words; "" without */
  char why[BAUM_I_MESSAGE_SIZE];   /* or why there is none */
} baum_i_advice;

/* Where a report was made. */
typedef struct baum_i_environment {
  const char *baum;     /* version */
  const char *sundials; /* likewise; "none" */
  const char *compiler;
  char cpu[128];
  char date[32]; /* ISO 8601, UTC */
} baum_i_environment;

typedef struct baum_i_snapshot {
  const baum_study *study;
  const char *title;
  const char *error; /* what it means */
  double t0;
  double t1;
  baum_study_options options;
  baum_study_reference reference;
  baum_i_report_entry *entries;
  int entry_count;
  const baum_i_report_entry **order; /* (entry_count) by method, from coarse to fine */
  baum_study_method *methods;
  int method_count;
  int32_t *front[BAUM_I_COSTS]; /* entries, from cheap to exact */
  int32_t front_count[BAUM_I_COSTS];
  baum_i_advice advice[BAUM_I_COSTS][BAUM_I_ADVICE];
  baum_i_environment environment;
} baum_i_snapshot;

/* Read a study; to be cleared, also after a failure. */
baum_status baum_i_snapshot_read(const baum_study *study, const char *title, baum_i_snapshot *out);
void baum_i_snapshot_clear(baum_i_snapshot *snapshot);
/* Entries in that state. */
int baum_i_snapshot_count(const baum_i_snapshot *snapshot, baum_study_state state);

/* To be added to the name of a method, where it may go by steps and by tolerances. */
const char *baum_i_way(const baum_study_method *method);

void baum_i_environment_read(baum_i_environment *out);

/* ---- columns ---- */

typedef enum baum_i_column_kind {
  BAUM_I_COLUMN_TEXT,
  BAUM_I_COLUMN_NUMBER, /* double */
  BAUM_I_COLUMN_COUNT,  /* int64_t */
  BAUM_I_COLUMN_INDEX,  /* int32_t */
  BAUM_I_COLUMN_FLAG
} baum_i_column_kind;

/* What is known of every entry. */
typedef struct baum_i_column {
  const char *key; /* in CSV and JSON, never to be changed */
  const char *unit;
  const char *title; /* on the page; NULL: not there */
  const char *meaning;
  baum_i_column_kind kind;
  size_t offset;    /* in a baum_i_report_entry */
  double times;     /* on the page, in the unit of its title */
  bool when_is_run; /* else it is known of every entry */
} baum_i_column;

extern const baum_i_column baum_i_columns[];
extern const int baum_i_column_count;

const char *baum_i_column_text(const baum_i_column *column, const baum_i_report_entry *entry);
const baum_i_column *baum_i_column_by_key(const char *key);
/* A number of any kind; NaN where it is not known. */
double baum_i_column_number(const baum_i_column *column, const baum_i_report_entry *entry);

/* Words on an entry: remark k of it, from 0 on; NULL where it does not hold. */
enum { BAUM_I_REMARKS = 6 };
const char *baum_i_remark(const baum_i_report_entry *entry, int k);

/* ---- forms ---- */

void baum_i_report_text(const baum_i_snapshot *snapshot, baum_i_buffer *out);
void baum_i_report_csv(const baum_i_snapshot *snapshot, baum_i_buffer *out);
void baum_i_report_json(const baum_i_snapshot *snapshot, baum_i_buffer *out);
void baum_i_report_page(const baum_i_snapshot *snapshot, baum_i_buffer *out);

/* ---- parts of the page ---- */

enum { BAUM_I_HIGHLIGHTS = 8 };

/* Methods that have a colour: up to BAUM_I_HIGHLIGHTS, best first; the others are grey. */
typedef struct baum_i_highlights {
  int methods[BAUM_I_HIGHLIGHTS];
  int count;
} baum_i_highlights;

baum_i_highlights baum_i_choose_highlights(const baum_i_snapshot *snapshot);
/* Its colour, or -1. */
int baum_i_highlight_of(const baum_i_highlights *highlights, int method);

void baum_i_put_style(baum_i_buffer *out);
void baum_i_put_script(baum_i_buffer *out);
void baum_i_put_charts(const baum_i_snapshot *snapshot, const baum_i_highlights *highlights,
                       baum_i_buffer *out);
void baum_i_put_stability_maps(const baum_i_snapshot *snapshot, baum_i_buffer *out);
void baum_i_put_advice_table(const baum_i_snapshot *snapshot, baum_i_buffer *out);
void baum_i_put_method_table(const baum_i_snapshot *snapshot, const baum_i_highlights *highlights,
                             baum_i_buffer *out);
void baum_i_put_entry_table(const baum_i_snapshot *snapshot, baum_i_buffer *out);
void baum_i_put_messages(const baum_i_snapshot *snapshot, baum_i_buffer *out);

/* ---- files ---- */

/* Is there something that is no regular file, such as a pipe? Links are followed. */
bool baum_i_is_no_file(const char *path);

/* All of it or nothing, see baum_study_write(). */
baum_status baum_i_write_file(const char *path, const char *bytes, size_t size);

/* What was flushed reaches the disk; 0, or the reason (errno) why not. */
int baum_i_sync_file(FILE *file);

#endif
