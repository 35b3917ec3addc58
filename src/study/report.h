/* SPDX-License-Identifier: BSD-3-Clause */
/* Reports of studies. A report of any form is written from a snapshot of the study. */
#ifndef BAUM_I_STUDY_REPORT_H
#define BAUM_I_STUDY_REPORT_H

#include <stdio.h>

#include <baum/report.h>

#include "base/buffer.h"
#include "base/text.h"
#include "study/fields.h"

/* The number of recommendations for each kind of cost, and the number of kinds of cost. There is a
 * recommendation for each of the errors 1e-2, 1e-4, 1e-6, 1e-8 and 1e-10. */
enum { BAUM_I_ADVICE = 5, BAUM_I_COSTS = 2 };

/* The recommendation for one error. */
typedef struct baum_i_advice {
  double error;
  baum_status status;
  baum_simulation_options options; /* the recommended options, unless the status is an error */
  baum_i_text setting;             /* name of the setting, or "" if there is none */
  /* Why this setting is recommended, or why there is no recommendation. */
  char why[BAUM_I_MESSAGE_SIZE];
} baum_i_advice;

/* The software versions, the machine and the date of a report. */
typedef struct baum_i_environment {
  const char *baum;     /* version of baum */
  const char *sundials; /* version of SUNDIALS, or "none" */
  const char *compiler;
  char cpu[128];
  char date[32]; /* ISO 8601, UTC */
} baum_i_environment;

typedef struct baum_i_snapshot {
  const baum_study *study;
  const char *title;
  const char *error; /* explains what the errors of the study mean */
  double t0;
  double t1;
  baum_study_options options;
  baum_study_reference reference;
  baum_i_report_entry *entries;
  int entry_count;
  baum_i_report_method *methods;
  int method_count;
  int32_t *front[BAUM_I_COSTS]; /* the entries on each Pareto front, from cheap to accurate */
  int32_t front_count[BAUM_I_COSTS];
  baum_i_advice advice[BAUM_I_COSTS][BAUM_I_ADVICE];
  baum_i_environment environment;
} baum_i_snapshot;

/* Reads a study into a snapshot. The caller must clear the snapshot, even after a failure. */
baum_status baum_i_snapshot_read(const baum_study *study, const char *title, baum_i_snapshot *out);
void baum_i_snapshot_clear(baum_i_snapshot *snapshot);

/* Returns the name of a rule for gains, such as "best_damping". Returns NULL for an unknown
 * value. */
const char *baum_i_gain_rule_name(int rule);

void baum_i_environment_read(baum_i_environment *out);

/* ---- forms ---- */

void baum_i_report_text(const baum_i_snapshot *snapshot, baum_i_buffer *out);
void baum_i_report_csv(const baum_i_snapshot *snapshot, baum_i_buffer *out);
void baum_i_report_json(const baum_i_snapshot *snapshot, baum_i_buffer *out);
void baum_i_report_page(const baum_i_snapshot *snapshot, baum_i_buffer *out);

#endif
