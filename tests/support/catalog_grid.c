/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "catalog_grid.h"

void catalog_tally_add(catalog_tally *sum, const catalog_tally *of)
{
  for (int k = 0; k <= BAUM_STUDY_TIMED_OUT; k++) {
    sum->state[k] += of->state[k];
  }
  sum->entries += of->entries;
  sum->off += of->off;
  sum->unstable += of->unstable;
  sum->at_floor += of->at_floor;
  sum->compared += of->compared;
  sum->missing += of->missing;
  sum->better += of->better;
  sum->differ += of->differ;
  sum->unmarked += of->unmarked;
}

int catalog_tally_wrong(const catalog_tally *of)
{
  return of->missing + of->better + of->differ + of->unmarked;
}

/* ---- two studies of one entry ---- */

/* An entry of the catalogue, and two studies of it. The samples of a study must be equally spaced.
 * Both studies therefore use only the first n + 1 samples of the catalogue, which are equally
 * spaced. */
typedef struct pair {
  const baum_catalog_entry *entry;
  double *times; /* samples of the catalogue */
  int n;         /* number of samples after the start */
  baum_mechanism *mechanism;
  baum_study *own;
  baum_study *stored;
} pair;

static baum_status take_times(pair *p)
{
  p->times = calloc((size_t)p->entry->sample_count, sizeof *p->times);
  if (!p->times) {
    return BAUM_ERR_MEMORY;
  }
  baum_status status = baum_catalog_times(p->entry->name, p->times);
  double step = p->times[1] - p->times[0];
  p->n = 1;
  while (p->n + 1 < p->entry->sample_count &&
         fabs(p->times[p->n + 1] - p->times[0] - (p->n + 1) * step) < 1e-9 * step) {
    p->n++;
  }
  return status;
}

/* Stops the study after the first half of its stages, in which it measures errors. In the second
 * half, the study would measure times, which are not needed here. */
static int stop_before_times(const baum_study *study, int32_t done, int32_t total, void *user)
{
  (void)study;
  (void)user;
  return 2 * done >= total;
}

static baum_status make_study(const pair *p, double limit, baum_study **out)
{
  baum_study_options o = baum_study_options_default();
  o.samples = p->n;
  o.entry_limit = limit;
  o.energy_account = false;
  o.validate = false;
  o.progress = stop_before_times;
  baum_status status = baum_study_create(p->mechanism, p->times[0], p->times[p->n], out);
  return status == BAUM_OK ? baum_study_set_options(*out, &o) : status;
}

static baum_status run(baum_study *study)
{
  baum_status status = baum_study_run(study);
  return status == BAUM_STOP_CANCELLED || status == BAUM_WARNED ? BAUM_OK : status;
}

static baum_status add_same_entries(const baum_study *from, baum_study *to)
{
  baum_status status = BAUM_OK;
  for (int32_t k = 0; k < baum_study_entry_count(from) && status == BAUM_OK; k++) {
    baum_simulation_options o;
    status = baum_study_entry_options(from, k, &o, sizeof o);
    status = status == BAUM_OK ? baum_study_add(to, &o) : status;
  }
  return status;
}

/* Returns the number of correct digits of the stored positions, relative to the scales of the
 * mechanism. */
static double digits_of(const pair *p, const baum_catalog_choice *choice, const double *q)
{
  baum_catalog_error error;
  baum_status status =
    baum_catalog_compare(choice, p->mechanism, p->times + 1, p->n, q, NULL, &error, sizeof error);
  return status == BAUM_OK ? -log10(error.q_floor) : (double)NAN;
}

static baum_status give_stored(const pair *p, const baum_catalog_choice *choice)
{
  int32_t nq = 0;
  baum_status status = baum_mechanism_sizes(p->mechanism, &nq, NULL, NULL);
  double *q = calloc((size_t)p->n * (size_t)nq, sizeof *q);
  status = status == BAUM_OK && !q ? BAUM_ERR_MEMORY : status;
  for (int k = 0; k < p->n && status == BAUM_OK; k++) {
    status = baum_catalog_reference(choice, p->times[k + 1], q + (size_t)k * (size_t)nq, NULL);
  }
  if (status == BAUM_OK) {
    status = baum_study_set_reference(p->stored, p->times + 1, p->n, q, NULL, NULL,
                                      digits_of(p, choice, q));
  }
  free(q);
  return status;
}

static baum_status study_twice(pair *p, const baum_study_grid *grid, double limit)
{
  const baum_catalog_choice choice = {.name = p->entry->name};
  baum_status status = take_times(p);
  status = status == BAUM_OK ? baum_catalog_build(&choice, &p->mechanism) : status;
  status = status == BAUM_OK ? make_study(p, limit, &p->own) : status;
  status = status == BAUM_OK ? make_study(p, limit, &p->stored) : status;
  status = status == BAUM_OK ? give_stored(p, &choice) : status;
  status = status == BAUM_OK ? baum_study_add_standard(p->own, grid) : status;
  status = status == BAUM_OK ? add_same_entries(p->own, p->stored) : status;
  status = status == BAUM_OK ? run(p->own) : status;
  return status == BAUM_OK ? run(p->stored) : status;
}

/* ---- checks ---- */

/* Tells whether the given entry of a study has fixed gains with which violations do not decay.
 * Violations of position constraints and of rows of velocity level decay differently, so both are
 * checked. */
static bool has_unstable_constants(const pair *p, const baum_study_entry *entry)
{
  baum_amplification a = {.spectral_radius = 0.0};
  baum_amplification b = {.spectral_radius = 0.0};
  baum_mobility mobility;
  int32_t nv = 0;
  double x = fabs(entry->gains.value[0] * entry->step);
  double y = entry->gains.value[1] * entry->step;
  if (entry->formulation != BAUM_FORMULATION_BAUMGARTE || entry->gains.rule != BAUM_GAINS_FIXED ||
      isnan(entry->step) || baum_mechanism_sizes(p->mechanism, NULL, &nv, NULL) != BAUM_OK ||
      baum_mechanism_mobility(p->mechanism, &mobility, sizeof mobility) != BAUM_OK) {
    return false;
  }
  if (mobility.position_degrees_of_freedom < nv) {
    (void)baum_stability_at(entry->integrator, x, y * y, &a, sizeof a);
  }
  if (mobility.degrees_of_freedom < mobility.position_degrees_of_freedom) {
    (void)baum_stability_velocity_at(entry->integrator, x, &b, sizeof b);
  }
  return fmax(a.spectral_radius, b.spectral_radius) >= 1.0;
}

static bool is_marked(const pair *p, const baum_study_entry *own, const baum_study_entry *stored)
{
  bool other_motion = stored->error_q > 0.1 || own->branch_warnings > 0;
  if (own->state == BAUM_STUDY_DONE && stored->state == BAUM_STUDY_DONE &&
      own->off != other_motion) {
    return false;
  }
  bool looked_at = own->state == BAUM_STUDY_DONE || own->status == BAUM_ERR_UNSTABLE;
  return !looked_at || own->unstable == has_unstable_constants(p, own) ||
         (own->unstable && own->gains.rule != BAUM_GAINS_FIXED);
}

static bool is_consistent(const pair *p, const baum_study_entry *own,
                          const baum_study_entry *stored)
{
  baum_study_reference a;
  baum_study_reference b;
  (void)baum_study_reference_read(p->own, &a, sizeof a);
  (void)baum_study_reference_read(p->stored, &b, sizeof b);
  double differ = fabs(stored->error_q - own->error_q);
  /* The last term allows for rounding errors. */
  double open = a.uncertainty_q + b.uncertainty_q + 1e-14 * own->error_q;
  return own->error_q == stored->error_q || differ <= open; /* both may be infinite */
}

static bool is_better(const baum_study_entry *entry, const baum_study *study)
{
  baum_study_reference r;
  (void)baum_study_reference_read(study, &r, sizeof r);
  return entry->error_q < r.uncertainty_q || entry->at_floor != (entry->error <= r.uncertainty);
}

static void judge_entry(const pair *p, int32_t k, catalog_tally *t)
{
  baum_study_entry own;
  baum_study_entry stored;
  (void)baum_study_entry_at(p->own, k, &own, sizeof own);
  (void)baum_study_entry_at(p->stored, k, &stored, sizeof stored);
  catalog_tally one = {.entries = 1, .off = own.off, .unstable = own.unstable};
  one.state[own.state] = 1;
  one.at_floor = own.at_floor;
  one.missing = own.state == BAUM_STUDY_WAITING || stored.state == BAUM_STUDY_WAITING;
  one.unmarked = !is_marked(p, &own, &stored);
  one.compared = own.state == BAUM_STUDY_DONE && stored.state == BAUM_STUDY_DONE;
  one.better = one.compared && (is_better(&own, p->own) || is_better(&stored, p->stored));
  one.differ = one.compared && !is_consistent(p, &own, &stored);
  if (catalog_tally_wrong(&one) > 0) {
    printf("  %s: %s, error %.3e, by the stored reference %.3e%s%s\n", own.name,
           baum_study_state_name(own.state), own.error_q, stored.error_q, own.off ? ", off" : "",
           own.unstable ? ", unstable" : "");
  }
  catalog_tally_add(t, &one);
}

/* Returns how many entries a study has for an integrator with a formulation. */
static int count_entries(const baum_study *study, const baum_integrator *integrator,
                         baum_formulation formulation)
{
  int count = 0;
  for (int32_t k = 0; k < baum_study_method_count(study); k++) {
    baum_study_method m;
    if (baum_study_method_at(study, k, &m, sizeof m) == BAUM_OK && m.integrator == integrator &&
        m.formulation == formulation) {
      count += m.entries;
    }
  }
  return count;
}

/* Counts the methods for which some entries are missing. Every integrator must have all settings of
 * the grid with each of its formulations. With BAUMGARTE, it must have all settings both with the
 * default rule and with all constant gains. */
static int count_missing(const baum_study *study, const baum_study_grid *grid)
{
  int missing = 0;
  const baum_integrator *i = NULL;
  for (int32_t k = 0; (i = baum_integrator_at(k)) != NULL; k++) {
    bool here = count_entries(study, i, BAUM_FORMULATION_UNSTABILIZED) > 0 || grid->integrator == i;
    for (int f = BAUM_FORMULATION_UNSTABILIZED; here && f <= BAUM_FORMULATION_INDEX3; f++) {
      int kinds = baum_integrator_has_fixed_step(i) + baum_integrator_has_variable_step(i);
      int gains = f == BAUM_FORMULATION_BAUMGARTE ? 1 + grid->constants : 1;
      bool offered = baum_integrator_offers(i, (baum_formulation)f);
      missing +=
        offered && count_entries(study, i, (baum_formulation)f) < kinds * gains * grid->settings;
    }
  }
  return missing;
}

baum_status catalog_grid_judge(const baum_catalog_entry *entry, const baum_study_grid *grid,
                               double limit, catalog_tally *out)
{
  pair p = {.entry = entry};
  *out = (catalog_tally){0};
  baum_status status = study_twice(&p, grid, limit);
  if (status == BAUM_OK) {
    out->missing = count_missing(p.own, grid);
    for (int32_t k = 0; k < baum_study_entry_count(p.own); k++) {
      judge_entry(&p, k, out);
    }
  }
  baum_study_destroy(p.own);
  baum_study_destroy(p.stored);
  baum_mechanism_destroy(p.mechanism);
  free(p.times);
  return status;
}
