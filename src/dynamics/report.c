/* SPDX-License-Identifier: BSD-3-Clause */
/* Reports the cost of an evaluation, and the work that the evaluation skips, as numbers and as
 * text. */
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "base/text.h"
#include "dynamics/block_path.h"
#include "dynamics/islands.h"
#include "dynamics/snapshot.h"

/* Append to the report's text. A text that becomes too long is cut. */
#define say(report, ...) baum_i_append((report)->text, sizeof(report)->text, __VA_ARGS__)

static const char *plural(int count)
{
  return count == 1 ? "" : "s";
}

/* ---- the mechanism ---- */

static void report_sizes(const baum_workspace *w, bool assembled, baum_report *report)
{
  const baum_mechanism *m = w->mechanism;
  report->bodies = m->body_count;
  report->joints = m->joint_count;
  report->forces = m->force_count;
  report->velocities = m->nv;
  report->rows = m->nc;
  report->redundant_rows = w->rows.count;
  report->degrees_of_freedom = assembled ? m->nv - (m->nc > 0 ? w->rows.rank : 0) : -1;
  report->velocity_rows = m->velocity_row_count;
  report->position_degrees_of_freedom =
    assembled ? m->nv - (m->nc > 0 ? w->rows.position_rank : 0) : -1;
  for (int k = 0; k < m->joint_count; k++) {
    report->constant_rows += m->joints[k]->type->scleronomic ? m->joints[k]->rows : 0;
  }
  say(report, "mechanism     bodies %d, joints %d, forces %d; velocities %d, rows %d",
      m->body_count, m->joint_count, m->force_count, m->nv, m->nc);
  if (assembled) {
    say(report, ", degrees of freedom %d", report->degrees_of_freedom);
    if (report->velocity_rows > 0) {
      say(report, " of velocity, %d of position", report->position_degrees_of_freedom);
    }
    say(report, "\n");
  } else {
    say(report, "\n              cannot be assembled\n");
  }
}

/* ---- islands ---- */

static baum_status report_islands(const baum_mechanism *m, baum_report *report)
{
  int count;
  baum_i_island largest;
  BAUM_I_TRY(baum_i_count_islands(m, &count, &largest));
  report->islands = count;
  report->fixed_bodies = m->fixed_count;
  say(report, "islands       %d", count);
  if (count > 0) {
    say(report, "%s of %d bod%s, %d joint%s, %d row%s", count > 1 ? ", the largest" : ",",
        largest.bodies, largest.bodies == 1 ? "y" : "ies", largest.joints, plural(largest.joints),
        largest.rows, plural(largest.rows));
  }
  say(report, count > 1 ? "; they do not couple\n" : "\n");
  return BAUM_OK;
}

/* ---- the solver ---- */

/* Find the body with the most joints among the bodies that are not fixed. */
static baum_status find_most_joined(const baum_workspace *w, baum_report *report)
{
  const baum_mechanism *m = w->mechanism;
  int *joints = NULL;
  BAUM_I_TRY(baum_i_count_joints(m, &joints));
  for (int i = 1; i <= m->body_count; i++) {
    if (!m->bodies[i]->fixed && joints[i] > report->most_joints) {
      report->most_joints = joints[i];
      report->most_joined = (baum_body_id){i, m->tag};
    }
  }
  baum_i_free(joints);
  return BAUM_OK;
}

static void say_most_joined(const baum_mechanism *m, baum_report *report)
{
  if (report->most_joints > 0) {
    say(report, "; %s has most joints, %d",
        baum_i_label(&m->bodies[report->most_joined.index1]->element).text, report->most_joints);
  }
}

static void report_block(const baum_i_block_path *path, baum_report *report)
{
  const baum_i_block_size size = baum_i_block_path_size(path);
  report->blocks = true;
  report->nodes = size.nodes;
  report->couplings = size.couplings;
  report->fill = size.fill;
  report->most_couplings = size.most_couplings;
  say(report, "fill          %d of %d coupling%s, at most %d of one node", report->fill,
      report->couplings, plural(report->couplings), report->most_couplings);
}

static baum_status report_solver(const baum_workspace *w, baum_report *report)
{
  const baum_i_block_path *path = w->motion;
  say(report, "solver        %s\n", baum_i_solver_text(w).text);
  baum_status status = find_most_joined(w, report);
  if (path) {
    report_block(path, report);
  } else {
    say(report, "fill          not by blocks");
  }
  say_most_joined(w->mechanism, report);
  say(report, "\n");
  return status;
}

/* ---- skipped work ---- */

/* Return the text that precedes an item: the beginning of the line for the first item, and a
 * separator for the others. */
static const char *next_skipped(int *count)
{
  return (*count)++ > 0 ? "; " : "skipped       ";
}

static void report_skipped(const baum_mechanism *m, baum_report *report)
{
  int count = 0;
  report->constant_mass = m->constant_mass;
  report->constant_force = baum_i_has_constant_force(m);
  if (report->constant_mass) {
    say(report, "%smasses are constant%s", next_skipped(&count),
        report->blocks ? ", inverted once" : "");
  }
  if (report->constant_force) {
    say(report, "%sforces are constant%s", next_skipped(&count),
        report->blocks ? ", set once" : "");
  }
  if (report->constant_rows > 0) {
    say(report, "%s%d of %d row%s have no time derivatives", next_skipped(&count),
        report->constant_rows, m->nc, plural(m->nc));
  }
  if (report->redundant_rows > 0) {
    say(report, "%s%d redundant row%s", next_skipped(&count), report->redundant_rows,
        plural(report->redundant_rows));
  }
  if (report->fixed_bodies > 0) {
    say(report, "%s%d fixed bod%s", next_skipped(&count), report->fixed_bodies,
        report->fixed_bodies == 1 ? "y" : "ies");
  }
  if (count == 0) {
    say(report, "skipped       nothing");
  }
}

/* ---- the whole ---- */

/* Assemble the design configuration; if that fails, use it as it is. */
static baum_status find_configuration(baum_workspace *w, double *q, bool *assembled)
{
  memcpy(q, w->mechanism->design_q, (size_t)w->mechanism->nq * sizeof *q);
  baum_status status = baum_i_assemble(w, 0.0, q, NULL, w->mechanism->held);
  *assembled = status == BAUM_OK;
  return status == BAUM_ERR_MEMORY ? status : BAUM_OK;
}

static baum_status report_all(baum_workspace *w, double *q, void *whole)
{
  baum_report *report = whole;
  bool assembled = false;
  BAUM_I_TRY(find_configuration(w, q, &assembled));
  report_sizes(w, assembled, report);
  BAUM_I_TRY(report_islands(w->mechanism, report));
  BAUM_I_TRY(report_solver(w, report));
  report_skipped(w->mechanism, report);
  return BAUM_OK;
}

baum_status baum_mechanism_report(const baum_mechanism *mechanism, baum_report *out,
                                  size_t caller_size)
{
  baum_report report = {.struct_size = sizeof report};
  const baum_i_snapshot_out to = {"baum_mechanism_report", out, caller_size, &report,
                                  sizeof report};
  return baum_i_snapshot(mechanism, report_all, &to);
}
