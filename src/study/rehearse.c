/* SPDX-License-Identifier: BSD-3-Clause */
/* What becomes of errors over twice the span and from other starts.
 *
 * How fast errors grow is a matter of the motion, and of the method: from one turn to the next they may grow hundredfold.
 * So rows that may be recommended are run again over twice the span, from the start as designed and from two others whose
 * velocities differ by NUDGE of their size, or, where all is at rest, of the rate of the motion. There is a reference for
 * each, by the setting of the study's own. Rows that cost more than NEAR times another one that is as exact are left out.
 */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "dynamics/dynamics.h"
#include "integrate/integrator.h"
#include "simulate/run.h"
#include "study/study.h"

static const double NUDGE = 0.05;
static const double NEAR = 2.5;

void baum_i_study_clear_course(baum_i_course *course)
{
  baum_i_free(course->times);
  baum_i_free(course->rows);
  baum_i_free(course->q);
  baum_i_free(course->v);
  *course = (baum_i_course){0};
}

/* ---- motions ---- */

static baum_status allocate(const baum_study *study, baum_i_course *course)
{
  const baum_mechanism *m = study->mechanism;
  size_t n = (size_t)study->reference.course.n;
  course->n = (int)n;
  course->times = baum_i_alloc(n, sizeof(double));
  course->rows = baum_i_alloc(n * (size_t)baum_i_study_layout(study).width, sizeof(double));
  course->q = baum_i_alloc((size_t)m->nq, sizeof(double));
  course->v = baum_i_alloc((size_t)m->nv, sizeof(double));
  return course->times && course->rows && course->q && course->v ? BAUM_OK : baum_i_fail_memory();
}

/* Start as designed, nudged by a share of the velocities. */
static baum_status set_start(const baum_study *study, double nudge, baum_i_course *course)
{
  const baum_mechanism *m = study->mechanism;
  baum_simulation *probe = NULL;
  baum_workspace *w = NULL;
  baum_status status = baum_i_study_probe(study, &probe);
  if (status == BAUM_OK) {
    status = baum_workspace_create(study->mechanism, &w);
  }
  if (status == BAUM_OK) {
    memcpy(course->q, baum_simulation_q(probe), (size_t)m->nq * sizeof(double));
    memcpy(course->v, baum_simulation_v(probe), (size_t)m->nv * sizeof(double));
    double still = baum_i_scaled_size(m, course->v) > 0.0 ? 0.0 : probe->problem.rate;
    for (int i = 0; i < m->nv; i++) {
      course->v[i] += nudge * (course->v[i] + still * m->scale[i]);
    }
    status = nudge != 0.0 ? baum_workspace_project(w, study->t0, course->q, course->v) : BAUM_OK;
  }
  baum_workspace_destroy(w);
  baum_simulation_destroy(probe);
  return status;
}

static baum_simulation_options reference_options(const baum_study *study)
{
  baum_simulation_options o = study->reference.options;
  if (!o.integrator) {
    o = baum_simulation_options_default();
    o.integrator = baum_rk8();
    o.formulation = BAUM_FORMULATION_PROJECTION;
    o.rtol = 1e-12;
  }
  return o;
}

/* One motion; its rows are given up where it cannot be made. */
static baum_status make_one(const baum_study *study, double nudge, baum_i_watch *watch,
                            baum_i_course *course)
{
  baum_status status = allocate(study, course);
  if (status != BAUM_OK) {
    return status;
  }
  for (int k = 0; k < course->n; k++) {
    course->times[k] = study->t0 + 2.0 * (study->reference.course.times[k] - study->t0);
  }
  baum_i_outcome outcome = {.status = set_start(study, nudge, course)};
  if (outcome.status == BAUM_OK) {
    const baum_simulation_options o = reference_options(study);
    const baum_i_task task = {study, &o, course, false};
    baum_i_study_run_one(&task, watch, course->rows, &outcome);
  }
  if (outcome.status == BAUM_ERR_MEMORY) {
    return baum_i_fail_memory();
  }
  if (outcome.status < BAUM_OK || outcome.status == BAUM_STOP_CANCELLED) {
    baum_i_free(course->rows);
    course->rows = NULL;
  }
  return BAUM_OK;
}

baum_status baum_i_study_make_rehearsals(baum_study *study, baum_i_watch *watch)
{
  static const double NUDGES[BAUM_I_REHEARSALS] = {0.0, NUDGE, -NUDGE};
  baum_status status = BAUM_OK;
  for (int k = 0; k < BAUM_I_REHEARSALS && status == BAUM_OK; k++) {
    baum_i_study_clear_course(&study->rehearsals[k]);
    status = make_one(study, NUDGES[k], watch, &study->rehearsals[k]);
  }
  study->rehearsed = status == BAUM_OK && !baum_i_watch_stops(watch);
  return status;
}

/* ---- a row ---- */

/* Could it be recommended? */
static bool is_near_front(const baum_study *study, const baum_i_row *row)
{
  for (int k = 0; k < study->row_count; k++) {
    const baum_i_row *other = study->rows[k];
    if (baum_i_study_is_answer(other) && other->out.error <= row->out.error &&
        NEAR * other->out.work < row->out.work) {
      return false;
    }
  }
  return true;
}

bool baum_i_study_wants_rehearsal(const baum_study *study, const baum_i_row *row)
{
  return !row->rehearsed && baum_i_study_is_answer(row) && is_near_front(study, row);
}

baum_status baum_i_study_rehearse(const baum_study *study, const baum_i_row *row,
                                  baum_i_watch *watch, double *samples, double *error)
{
  double largest = (double)NAN;
  for (int k = 0; k < BAUM_I_REHEARSALS; k++) {
    const baum_i_course *course = &study->rehearsals[k];
    if (!course->rows) {
      continue;
    }
    const baum_i_task task = {study, &row->options, course, false};
    baum_i_outcome outcome;
    baum_i_study_run_one(&task, watch, samples, &outcome);
    if (outcome.status == BAUM_ERR_MEMORY) {
      return baum_i_fail_memory();
    }
    bool ended = outcome.status == BAUM_OK || outcome.status == BAUM_WARNED;
    baum_i_differences d = baum_i_study_compare(study, course, samples);
    largest = fmax(largest, ended ? d.error[0] : (double)INFINITY);
  }
  *error = isnan(largest) ? largest : fmax(largest, row->out.error);
  return BAUM_OK;
}
