/* SPDX-License-Identifier: BSD-3-Clause */
/* Reports the mobility of a mechanism in its assembled initial configuration: the number of degrees
 * of freedom, and the joints with redundant or conflicting rows. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/text.h"
#include "dynamics/islands.h"
#include "dynamics/snapshot.h"

/* Append to the report's text. A text that becomes too long is cut. */
#define say(report, ...) baum_i_append((report)->text, sizeof(report)->text, __VA_ARGS__)

static baum_status report_free_bodies(const baum_mechanism *m, baum_mobility *report)
{
  int *joints = NULL;
  BAUM_I_TRY(baum_i_count_joints(m, &joints));
  for (int i = 1; i <= m->body_count; i++) {
    if (joints[i] == 0) {
      say(report, "%s\"%s\"", report->free_bodies == 0 ? " Bodies without a joint: " : ", ",
          m->bodies[i]->element.name);
      report->free_bodies++;
    }
  }
  if (report->free_bodies > 0) {
    say(report, ".");
  }
  baum_i_free(joints);
  return BAUM_OK;
}

static void find_worst(const baum_workspace *w, baum_mobility *report)
{
  int row = baum_i_largest(w->phi, w->mechanism->nc, &report->worst_phi);
  if (row >= 0) {
    report->worst_joint = baum_i_joint_id(w->mechanism, baum_i_row_joint(w->mechanism, row));
  }
}

/* Called when assembly has failed. Report the conflicting rows, which are the rows whose violation
 * is at least a tenth of the largest violation. */
static baum_status report_conflict(baum_workspace *w, baum_mobility *report)
{
  char reason[BAUM_I_MESSAGE_SIZE];
  (void)snprintf(reason, sizeof reason, "%s", baum_message());
  find_worst(w, report);
  for (int i = 0; i < w->mechanism->nc; i++) {
    report->conflicting_rows += fabs(w->phi[i]) >= 0.1 * report->worst_phi ? 1 : 0;
  }
  report->degrees_of_freedom = -1;
  report->position_degrees_of_freedom = -1;
  say(report, "Cannot be assembled: %s.", reason);
  return BAUM_OK;
}

static void report_counts(const baum_mechanism *m, baum_mobility *report)
{
  say(report, "%d %s, %d velocities, %d constraint rows.", report->degrees_of_freedom,
      report->degrees_of_freedom == 1 ? "degree of freedom" : "degrees of freedom", m->nv, m->nc);
  if (report->degrees_of_freedom == 0 && baum_i_has_constant_constraints(m)) {
    say(report, " The mechanism cannot move.");
  }
  if (m->velocity_row_count > 0) {
    say(report, " %d %s of velocity level; degrees of freedom: %d of velocity, %d of position.",
        m->velocity_row_count, m->velocity_row_count == 1 ? "row" : "rows",
        report->degrees_of_freedom, report->position_degrees_of_freedom);
  }
}

static baum_status report_rank(baum_workspace *w, const double *q, baum_mobility *report)
{
  const baum_mechanism *m = w->mechanism;
  const baum_i_row_set *r = &w->rows;
  BAUM_I_TRY(baum_i_find_rows(w, 0.0, q));
  report->degrees_of_freedom = m->nv - (m->nc > 0 ? r->rank : 0);
  report->position_degrees_of_freedom = m->nv - (m->nc > 0 ? r->position_rank : 0);
  report->redundant_rows = r->count;
  report->near_singular = m->nc > 0 && r->rank_at_start < r->rank;
  baum_status status = BAUM_OK;
  report_counts(m, report);
  if (r->count > 0) {
    char names[512] = "";
    BAUM_I_TRY(baum_i_position_stage(w, 0.0, q));
    status = baum_i_redundancy_text(w, names, sizeof names);
    say(report, " %d redundant %s%s%s.", r->count, r->count == 1 ? "row" : "rows",
        names[0] ? " among " : "", names);
    status = status == BAUM_ERR_SINGULAR ? BAUM_OK : status; /* the report then names no joints */
  }
  if (report->near_singular) {
    say(
      report,
      " The initial configuration is singular or nearly singular: %d independent rows, %d nearby.",
      r->rank_at_start, r->rank);
  }
  return status;
}

static baum_status report_mobility(baum_workspace *w, double *q, void *whole)
{
  baum_mobility *report = whole;
  const baum_mechanism *m = w->mechanism;
  memcpy(q, m->design_q, (size_t)m->nq * sizeof *q);
  report->velocity_rows = m->velocity_row_count;
  baum_status status = baum_i_assemble(w, 0.0, q, NULL, m->held);
  if (status == BAUM_ERR_INCONSISTENT) {
    status = report_conflict(w, report);
  } else if (status == BAUM_OK) {
    status = baum_i_position_stage(w, 0.0, q);
    find_worst(w, report);
    status = status == BAUM_OK ? report_rank(w, q, report) : status;
  }
  return status == BAUM_OK ? report_free_bodies(m, report) : status;
}

baum_status baum_mechanism_mobility(const baum_mechanism *mechanism, baum_mobility *out,
                                    size_t caller_size)
{
  baum_mobility report = {.struct_size = sizeof report};
  const baum_i_snapshot_out to = {"baum_mechanism_mobility", out, caller_size, &report,
                                  sizeof report};
  return baum_i_snapshot(mechanism, report_mobility, &to);
}
