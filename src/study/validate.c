/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the errors of entries over twice the span and from other starts. The growth of errors
 * depends on the motion and on the method, and may be a factor of 100 per revolution. Entries that
 * may be recommended are therefore run again over twice the span. One of these runs starts with the
 * velocities of the study. The velocities of two others are perturbed by the fraction NUDGE, or, if
 * the mechanism starts at rest, by NUDGE times the rate of the motion. Each start has its own
 * reference. It is computed with the setting of the study's reference, or with RK8 and projection
 * if the user has given the study's reference. An entry is not validated if its work is more than
 * NEAR times the work of an entry that is at least as accurate. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "dynamics/dynamics.h"
#include "integrate/integrator.h"
#include "simulate/run.h"
#include "study/study.h"

static const double NUDGE = 0.05;
static const double NEAR = 2.5;

/* ---- motions ---- */

static baum_status allocate(const baum_study *study, baum_i_samples *samples)
{
  const baum_mechanism *m = study->mechanism;
  size_t n = (size_t)study->reference.samples.n;
  samples->n = (int)n;
  samples->times = baum_i_alloc(n, sizeof(double));
  samples->values = baum_i_alloc(n * (size_t)baum_i_study_layout(study).width, sizeof(double));
  samples->q = baum_i_alloc((size_t)m->nq, sizeof(double));
  samples->v = baum_i_alloc((size_t)m->nv, sizeof(double));
  return samples->times && samples->values && samples->q && samples->v ? BAUM_OK
                                                                       : baum_i_fail_memory();
}

/* Sets the start of a motion, whose velocities are perturbed by the fraction `nudge`. */
static baum_status set_start(const baum_study *study, double nudge, baum_i_samples *samples)
{
  const baum_mechanism *m = study->mechanism;
  baum_simulation *probe = NULL;
  baum_workspace *w = NULL;
  baum_status status = baum_i_study_probe(study, &probe);
  if (status == BAUM_OK) {
    status = baum_workspace_create(study->mechanism, &w);
  }
  if (status == BAUM_OK) {
    memcpy(samples->q, baum_simulation_q(probe), (size_t)m->nq * sizeof(double));
    memcpy(samples->v, baum_simulation_v(probe), (size_t)m->nv * sizeof(double));
    double still = baum_i_scaled_size(m, samples->v) > 0.0 ? 0.0 : probe->problem.rate;
    for (int i = 0; i < m->nv; i++) {
      samples->v[i] += nudge * (samples->v[i] + still * m->scale[i]);
    }
    status = nudge != 0.0 ? baum_workspace_project(w, study->t0, samples->q, samples->v) : BAUM_OK;
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

/* Computes one of the motions for validation. If this fails, its `values` are NULL. */
static baum_status make_one(const baum_study *study, double nudge, baum_i_deadline *deadline,
                            baum_i_samples *samples)
{
  BAUM_I_TRY(allocate(study, samples));
  for (int k = 0; k < samples->n; k++) {
    samples->times[k] = study->t0 + 2.0 * (study->reference.samples.times[k] - study->t0);
  }
  baum_i_outcome outcome = {.status = set_start(study, nudge, samples)};
  if (outcome.status == BAUM_OK) {
    const baum_simulation_options o = reference_options(study);
    const baum_i_task task = {study, &o, samples, false};
    baum_i_study_run_one(&task, deadline, samples->values, &outcome);
  }
  if (outcome.status == BAUM_ERR_MEMORY) {
    return baum_i_fail_memory();
  }
  if (outcome.status < BAUM_OK || outcome.status == BAUM_STOP_CANCELLED) {
    baum_i_free(samples->values);
    samples->values = NULL;
  }
  return BAUM_OK;
}

baum_status baum_i_study_make_validations(baum_study *study, baum_i_deadline *deadline)
{
  static const double NUDGES[BAUM_I_VALIDATIONS] = {0.0, NUDGE, -NUDGE};
  for (int k = 0; k < BAUM_I_VALIDATIONS; k++) {
    baum_i_study_clear_samples(&study->validations[k]);
    BAUM_I_TRY(make_one(study, NUDGES[k], deadline, &study->validations[k]));
  }
  study->validated = !baum_i_deadline_stops(deadline);
  return BAUM_OK;
}

/* ---- an entry ---- */

/* Tells whether an entry is near the Pareto front. It is not near the front if another entry that
 * may be recommended is at least as accurate with less than 1 / NEAR of the work. */
static bool is_near_front(const baum_study *study, const baum_i_entry *entry)
{
  for (int k = 0; k < study->entry_count; k++) {
    const baum_i_entry *other = study->entries[k];
    if (baum_i_study_is_answer(other) && other->out.error <= entry->out.error &&
        NEAR * other->out.work < entry->out.work) {
      return false;
    }
  }
  return true;
}

bool baum_i_study_wants_validation(const baum_study *study, const baum_i_entry *entry)
{
  return entry->stage == BAUM_I_TIMED && baum_i_study_is_answer(entry) &&
         is_near_front(study, entry);
}

baum_status baum_i_study_validate(const baum_study *study, const baum_i_entry *entry,
                                  baum_i_deadline *deadline, double *values, double *error)
{
  double largest = (double)NAN;
  for (int k = 0; k < BAUM_I_VALIDATIONS; k++) {
    const baum_i_samples *samples = &study->validations[k];
    if (!samples->values) {
      continue;
    }
    const baum_i_task task = {study, &entry->options, samples, false};
    baum_i_outcome outcome;
    baum_i_study_run_one(&task, deadline, values, &outcome);
    if (outcome.status == BAUM_ERR_MEMORY) {
      return baum_i_fail_memory();
    }
    bool ended = outcome.status == BAUM_OK || outcome.status == BAUM_WARNED;
    baum_i_differences d = baum_i_study_compare(study, samples, values);
    largest = fmax(largest, ended ? d.error[0] : (double)INFINITY);
  }
  *error = isnan(largest) ? largest : fmax(largest, entry->out.error);
  return BAUM_OK;
}
