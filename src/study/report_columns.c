/* SPDX-License-Identifier: BSD-3-Clause */
/* What is known of every entry, under names that stay. */
#include <math.h>
#include <string.h>

#include "study/report.h"

#define AT(member) offsetof(baum_i_report_entry, member)
/* Known of every entry; known of entries that are done. */
#define IS(key, unit, title, meaning, kind, member)                         \
  {                                                                         \
    key, unit, title, meaning, BAUM_I_COLUMN_##kind, AT(member), 1.0, false \
  }
#define MEASURED(key, unit, title, meaning, kind, member)                        \
  {                                                                              \
    key, unit, title, meaning, BAUM_I_COLUMN_##kind, AT(entry.member), 1.0, true \
  }

const baum_i_column baum_i_columns[] = {
  IS("name", "", "setting", "method and step or tolerance", TEXT, entry.name),
  IS("state", "", "state", "done, refused, failed, timed_out or waiting", TEXT, state),
  IS("integrator", "", NULL, "", TEXT, integrator),
  IS("formulation", "", NULL, "", TEXT, formulation),
  IS("gains", "", NULL, "rule of the gains", TEXT, gains),
  IS("gain_1", "of the rule", NULL, "first number of the rule", NUMBER, gain[0]),
  IS("gain_2", "of the rule", NULL, "second number of the rule", NUMBER, gain[1]),
  IS("alpha", "1/s", NULL, "of the gains in use", NUMBER, entry.alpha),
  IS("beta", "1/s", NULL, "likewise", NUMBER, entry.beta),
  IS("method", "", NULL, "index in methods", INDEX, entry.method),
  IS("step", "s", NULL, "", NUMBER, entry.step),
  IS("rtol", "1", NULL, "", NUMBER, entry.rtol),
  MEASURED("error", "1", "error", "largest over all samples, of what the study calls error", NUMBER,
           error),
  MEASURED("error_final", "1", "at the end", "error at the last sample", NUMBER, error_final),
  MEASURED("error_half", "1", NULL, "error over the first half", NUMBER, error_half),
  MEASURED("work", "evaluations", "work", "cost that is the same on every machine, in evaluations",
           NUMBER, work),
  {"cpu", "s", "CPU [ms]", "least CPU time of the repeats", BAUM_I_COLUMN_NUMBER, AT(entry.cpu),
   1e3, true},
  {"cpu_spread", "s", "± [ms]", "second least CPU time less the least", BAUM_I_COLUMN_NUMBER,
   AT(entry.cpu_spread), 1e3, true},
  MEASURED("repeats", "1", NULL, "runs for the time", INDEX, repeats),
  MEASURED("evaluations", "1", "evaluations", "right-hand sides or residuals", COUNT, evaluations),
  MEASURED("factorizations", "1", "factorizations", "of matrices", COUNT, factorizations),
  MEASURED("steps", "1", "steps", "accepted", COUNT, steps),
  MEASURED("rejected", "1", "rejected", "steps that were repeated", COUNT, rejected),
  MEASURED("nonlinear_iterations", "1", NULL, "", COUNT, nonlinear_iterations),
  MEASURED("forced_steps", "1", NULL, "over singular poses", COUNT, forced_steps),
  MEASURED("error_q", "1", "error q", "of positions, by the scales", NUMBER, error_q),
  MEASURED("error_q_final", "1", NULL, "", NUMBER, error_q_final),
  MEASURED("error_v", "1", "error v", "of velocities, of the largest", NUMBER, error_v),
  MEASURED("error_v_final", "1", NULL, "", NUMBER, error_v_final),
  MEASURED("error_lambda", "1", "error λ", "of multipliers, of the largest", NUMBER, error_lambda),
  MEASURED("error_lambda_final", "1", NULL, "", NUMBER, error_lambda_final),
  MEASURED("max_phi", "m or rad", "|Φ| [m, rad]", "largest violation over all steps", NUMBER,
           max_phi),
  MEASURED("max_phi_rate", "m/s or rad/s", "|Φ′| [/s]", "largest rate of a violation", NUMBER,
           max_phi_rate),
  MEASURED("energy_error", "J", "energy [J]", "drift of energy against the reference", NUMBER,
           energy_error),
  MEASURED("energy_error_final", "J", NULL, "", NUMBER, energy_error_final),
  MEASURED("gains_work", "J", "gains [J]", "work of the stabilization", NUMBER, gains_work),
  MEASURED("violation_work", "J", "violation [J]", "work of constraint forces on the violation",
           NUMBER, violation_work),
  MEASURED("projection_work", "J", "projection [J]", "energy that projections have changed", NUMBER,
           projection_work),
  MEASURED("warnings", "1", "warnings", "of its run", COUNT, warnings),
  MEASURED("near_singular_intervals", "1", NULL, "", COUNT, near_singular_intervals),
  MEASURED("branch_warnings", "1", NULL, "", COUNT, branch_warnings),
  MEASURED("doubts", "1", "doubts", "kinds of warnings that doubt the motion", COUNT, doubts),
  MEASURED("error_estimate", "1", NULL, "", NUMBER, error_estimate),
  IS("at_floor", "", NULL, "as good as can be told", FLAG, entry.at_floor),
  IS("untrusted", "", NULL, "the reference is not to be trusted", FLAG, entry.untrusted),
  IS("off", "", NULL, "another motion", FLAG, entry.off),
  IS("unstable", "", NULL, "its gains do not damp with this step", FLAG, entry.unstable),
  IS("on_front_work", "", NULL, "no entry is both cheaper by work and more exact", FLAG, front[0]),
  IS("on_front_cpu", "", NULL, "likewise by CPU time", FLAG, front[1]),
  IS("status", "", NULL, "of its run", TEXT, status),
  IS("message", "", NULL, "why it is refused or failed, or its first warning", TEXT, message),
};
const int baum_i_column_count = sizeof baum_i_columns / sizeof baum_i_columns[0];

/* The member that a column is. */
static void take(const baum_i_column *column, const baum_i_report_entry *entry, void *to,
                 size_t size)
{
  memcpy(to, (const char *)entry + column->offset, size);
}

const char *baum_i_column_text(const baum_i_column *column, const baum_i_report_entry *entry)
{
  const char *text = NULL;
  take(column, entry, &text, sizeof text);
  return text;
}

double baum_i_column_number(const baum_i_column *column, const baum_i_report_entry *entry)
{
  double number = (double)NAN;
  int64_t count = 0;
  int32_t index = 0;
  bool flag = false;
  if (column->when_is_run && entry->entry.state != BAUM_STUDY_DONE) {
    return number;
  }
  switch (column->kind) {
  case BAUM_I_COLUMN_NUMBER: take(column, entry, &number, sizeof number); return number;
  case BAUM_I_COLUMN_COUNT: take(column, entry, &count, sizeof count); return (double)count;
  case BAUM_I_COLUMN_INDEX: take(column, entry, &index, sizeof index); return index;
  case BAUM_I_COLUMN_FLAG: take(column, entry, &flag, sizeof flag); return flag;
  case BAUM_I_COLUMN_TEXT: break;
  }
  return number;
}

const baum_i_column *baum_i_column_by_key(const char *key)
{
  const baum_i_column *column = baum_i_columns;
  while (strcmp(column->key, key) != 0) {
    column++;
  }
  return column;
}

const char *baum_i_remark(const baum_i_report_entry *entry, int k)
{
  const baum_study_entry *r = &entry->entry;
  const bool holds[BAUM_I_REMARKS] = {entry->front[BAUM_STUDY_WORK],
                                      entry->front[BAUM_STUDY_CPU],
                                      r->at_floor,
                                      r->off,
                                      r->unstable,
                                      r->untrusted};
  static const char *const WORDS[BAUM_I_REMARKS] = {"front", "front by CPU", "floor",
                                                    "off",   "unstable",     "untrusted"};
  return holds[k] ? WORDS[k] : NULL;
}
