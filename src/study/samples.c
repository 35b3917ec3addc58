/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the differences between the samples of a run and the reference. A sample has several
 * parts with these errors:
 *
 *   q       |dq_i| / s_i             s_i: characteristic length for lengths, and 1 for angles
 *   v       |dv_i| / (s_i V)         V: largest |v_j| / s_j over all samples of the reference [1/s]
 *   lambda  |dlambda_i| n_i / E      n_i: norm of row i of J with each column j multiplied by s_j
 *                                   E: largest |lambda_j| n_j over all samples [J]
 *   energy  |d(T + U)|
 *   user    |dx_i| / unit            if the user gives no channels, the error of q is used
 *
 * Numbers that are missing in the reference are not compared. If a number is missing in a run but
 * not in the reference, the error of the run is infinite. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "dynamics/dynamics.h"
#include "study/study.h"

baum_i_layout baum_i_study_layout(const baum_study *study)
{
  const baum_mechanism *m = study->mechanism;
  int user = 0;
  if (study->channel_count > 0) {
    user = baum_channels_width(m, study->channels, study->channel_count);
  }
  baum_i_layout l = {.nq = m->nq, .nv = m->nv, .nc = m->nc};
  l.v = l.nq;
  l.lambda = l.v + l.nv;
  l.energy = l.lambda + l.nc;
  l.user = l.energy + 2;
  l.width = l.user + user;
  return l;
}

int baum_i_study_channels(const baum_study *study, baum_channel *channels)
{
  static const baum_quantity OWN[] = {BAUM_Q, BAUM_V, BAUM_LAMBDA, BAUM_ENERGY};
  int count = 0;
  for (size_t k = 0; k < sizeof OWN / sizeof OWN[0]; k++) {
    if (OWN[k] != BAUM_LAMBDA || study->mechanism->nc > 0) {
      channels[count++] = baum_channel_of(OWN[k]);
    }
  }
  for (int k = 0; k < study->channel_count; k++) {
    channels[count++] = study->channels[k];
  }
  return count;
}

void baum_i_study_clear_samples(baum_i_samples *samples)
{
  baum_i_free(samples->times);
  baum_i_free(samples->values);
  baum_i_free(samples->q);
  baum_i_free(samples->v);
  *samples = (baum_i_samples){0};
}

/* ---- weights ---- */

/* Computes the norms n_i of all rows of J (see the top of this file) at the first sample of the
 * reference. */
static baum_status measure_rows(const baum_study *study, double *rows)
{
  baum_workspace *w = NULL;
  baum_status status = baum_workspace_create(study->mechanism, &w);
  if (status == BAUM_OK) {
    status =
      baum_i_position_stage(w, study->reference.samples.times[0], study->reference.samples.values);
  }
  if (status == BAUM_OK) {
    baum_i_row_displacements(w, rows);
  }
  baum_workspace_destroy(w);
  return status;
}

/* Divides the weights of some columns by the largest weighted value that the reference has in these
 * columns. */
static void normalize(const baum_study *study, const baum_i_layout *l, int first, int count)
{
  const baum_i_samples *samples = &study->reference.samples;
  double *weight = study->reference.weight;
  double largest = 0.0;
  for (int k = 0; k < samples->n; k++) {
    for (int i = first; i < first + count; i++) {
      largest = fmax(largest, fabs(samples->values[(size_t)k * l->width + i]) * weight[i]);
    }
  }
  for (int i = first; i < first + count && largest > 0.0; i++) {
    weight[i] /= largest;
  }
}

baum_status baum_i_study_weigh(baum_study *study)
{
  baum_i_layout l = baum_i_study_layout(study);
  const baum_mechanism *m = study->mechanism;
  baum_i_free(study->reference.weight);
  double *weight = study->reference.weight = baum_i_alloc((size_t)l.width, sizeof *weight);
  BAUM_I_TRY(baum_i_check_memory(weight));
  for (int i = 0; i < l.nq; i++) {
    weight[i] = 1.0 / m->position_scale[i];
  }
  for (int i = 0; i < l.nv; i++) {
    weight[l.v + i] = 1.0 / m->scale[i];
  }
  baum_status status = l.nc > 0 ? measure_rows(study, weight + l.lambda) : BAUM_OK;
  weight[l.energy] = weight[l.energy + 1] = 1.0;
  for (int i = l.user; i < l.width; i++) {
    weight[i] = 1.0 / study->unit;
  }
  normalize(study, &l, l.v, l.nv);
  normalize(study, &l, l.lambda, l.nc);
  return status;
}

/* ---- differences ---- */

static double distance(double got, double wanted)
{
  double difference = fabs(got - wanted);
  if (isnan(wanted)) {
    return (double)NAN;
  }
  return isfinite(difference) ? difference : (double)INFINITY;
}

/* Returns the largest weighted difference in the columns from `first` to end - 1 of a sample.
 * Returns NaN if no difference is known.
 */
static double largest_of(const baum_study *study, const double *got, const double *wanted,
                         int first, int end)
{
  double largest = (double)NAN;
  for (int i = first; i < end; i++) {
    largest = fmax(largest, distance(got[i], wanted[i]) * study->reference.weight[i]);
  }
  return largest;
}

static double of_energy(const double *got, const double *wanted, int energy)
{
  return distance(got[energy] + got[energy + 1], wanted[energy] + wanted[energy + 1]);
}

static void keep_largest(double of[2], double value)
{
  of[0] = fmax(of[0], value);
  of[1] = value;
}

baum_i_differences baum_i_study_compare(const baum_study *study, const baum_i_samples *samples,
                                        const double *values)
{
  baum_i_layout l = baum_i_study_layout(study);
  double none = (double)NAN;
  baum_i_differences d = {
    {none, none, none}, {none, none}, {none, none}, {none, none}, {none, none}};
  for (int k = 0; k < samples->n; k++) {
    const double *got = values + (size_t)k * l.width;
    const double *wanted = samples->values + (size_t)k * l.width;
    keep_largest(d.q, largest_of(study, got, wanted, 0, l.nq));
    keep_largest(d.v, largest_of(study, got, wanted, l.v, l.v + l.nv));
    keep_largest(d.lambda, largest_of(study, got, wanted, l.lambda, l.lambda + l.nc));
    keep_largest(d.energy, of_energy(got, wanted, l.energy));
    keep_largest(d.error,
                 l.user < l.width ? largest_of(study, got, wanted, l.user, l.width) : d.q[1]);
    if (fabs(samples->times[k] - study->t0) <= 0.5 * fabs(study->t1 - study->t0)) {
      d.error[2] = d.error[0];
    }
  }
  return d;
}
