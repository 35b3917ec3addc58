/* SPDX-License-Identifier: BSD-3-Clause */
#include "reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <baum/catalog.h>

/* Returns row i of the reference. If the reference comes from the catalogue, the row is computed in
 * `row`. */
static const double *find_row(const reference *with, int i, double *row)
{
  if (with->q) {
    return with->q + (size_t)i * (size_t)with->width;
  }
  const baum_catalog_choice choice = {.name = with->entry};
  bool found = baum_catalog_reference(&choice, with->t[i], row, NULL) == BAUM_OK;
  for (int k = 0; k < with->width && !found; k++) {
    row[k] = (double)NAN;
  }
  return row;
}

static double worst(const reference *with, double scale, const double *rows, int nq)
{
  double error = 0.0;
  for (int i = 0; i < with->samples; i++) {
    const double *q = rows + (size_t)i * (size_t)nq;
    double row[REFERENCE_WIDTH];
    double columns[REFERENCE_WIDTH];
    const double *wanted = find_row(with, i, row);
    if (with->columns) {
      with->columns(q, columns);
    } else {
      memcpy(columns, q, (size_t)with->width * sizeof *q);
    }
    for (int k = 0; k < with->width; k++) {
      double unit = with->lengths[k] == 'm' ? scale : 1.0;
      double off = fabs(columns[k] - wanted[k]) / unit;
      error = isnan(off) ? off : fmax(error, off);
    }
  }
  return error;
}

static void finish(baum_simulation *run, reference_run *out)
{
  if (out->status < 0) {
    (void)snprintf(out->message, sizeof out->message, "%s", baum_message());
  }
  if (run) {
    (void)baum_simulation_counters(run, &out->counters, sizeof out->counters);
  }
}

reference_run reference_compare(const reference *with, const baum_mechanism *mechanism,
                                const baum_simulation_options *options)
{
  const baum_channel positions = baum_channel_of(BAUM_Q);
  reference_run out = {.error = (double)NAN};
  double scale = (double)NAN;
  int32_t nq = 0;
  baum_simulation *run = NULL;
  (void)baum_mechanism_get_characteristic_length(mechanism, &scale);
  (void)baum_mechanism_sizes(mechanism, &nq, NULL, NULL);
  double *rows = calloc((size_t)with->samples * (size_t)nq, sizeof *rows);
  out.status = rows ? baum_simulation_create(mechanism, options, &run) : BAUM_ERR_MEMORY;
  if (out.status >= 0) {
    out.status = baum_simulation_sample(run, with->t, with->samples, &positions, 1, rows, NULL);
  }
  finish(run, &out);
  if (out.status >= 0) {
    out.error = worst(with, scale, rows, nq);
  }
  baum_simulation_destroy(run);
  free(rows);
  return out;
}

double reference_rtol(int rung)
{
  static const double rtol[REFERENCE_RUNGS] = {1e-4, 1e-5,  1e-6,  1e-7, 1e-8,
                                               1e-9, 1e-10, 1e-11, 1e-12};
  return rtol[rung];
}

reference_ladder reference_climb(const reference *with, const baum_mechanism *mechanism,
                                 const baum_simulation_options *options)
{
  reference_ladder ladder;
  printf("\n%s: %s, %s\n", with->name, baum_integrator_name(options->integrator),
         baum_formulation_name(options->formulation));
  printf("%8s %10s %12s %8s %8s %10s\n", "rtol", "error", "error/rtol", "steps", "evals",
         "max|Phi|");
  for (int k = 0; k < REFERENCE_RUNGS; k++) {
    baum_simulation_options tight = *options;
    tight.rtol = reference_rtol(k);
    reference_run *run = &ladder.runs[k];
    *run = reference_compare(with, mechanism, &tight);
    printf("%8.0e %10.2e %12.3g %8lld %8lld %10.2e %s\n", tight.rtol, run->error,
           run->error / tight.rtol, (long long)run->counters.steps,
           (long long)run->counters.evaluations, run->counters.max_phi, run->message);
  }
  (void)fflush(stdout);
  return ladder;
}

double reference_rtol_needed(const reference_ladder *ladder, double wanted)
{
  double needed = (double)NAN;
  for (int k = REFERENCE_RUNGS - 1; k >= 0; k--) {
    double error = ladder->runs[k].error;
    if (error <= wanted) {
      needed = reference_rtol(k);
    } else if (!isnan(needed)) {
      break;
    }
  }
  return needed;
}
