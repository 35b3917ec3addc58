/* SPDX-License-Identifier: BSD-3-Clause */
/* Sorts entries by method, and finds what one more digit of accuracy costs.
 *
 * The error of a method is approximately C h^p, where h is the step or rtol, until rounding errors
 * or the uncertainty of the reference dominate. The cost, too, is approximately proportional to a
 * power of h. Straight lines are therefore fitted to the logarithms of error and cost, from the
 * coarsest entry to the most accurate one. Errors near the smallest error do not follow these
 * lines. The fit therefore excludes entries with errors below FLOOR times the smallest error,
 * except the most accurate entry. */
#include <math.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "integrate/integrator.h"
#include "study/study.h"

static const double FLOOR = 3.0;

int baum_i_study_find_method(baum_study *study, const baum_simulation_options *options, int entry)
{
  uint64_t key = baum_i_options_key(options, false);
  for (int k = 0; k < study->method_count; k++) {
    if (study->methods[k].key == key) {
      return k;
    }
  }
  baum_i_study_method *methods =
    baum_i_grow_by_one(study->methods, (size_t)study->method_count + 1, sizeof *methods);
  if (!methods) {
    return -1;
  }
  study->methods = methods;
  baum_i_study_method *method = &methods[study->method_count];
  *method = (baum_i_study_method){.key = key, .first = entry};
  method->name = baum_i_method_name(options);
  return study->method_count++;
}

static int by_setting(const void *a, const void *b)
{
  double x = baum_i_setting(&(*(const baum_i_entry *const *)a)->options);
  double y = baum_i_setting(&(*(const baum_i_entry *const *)b)->options);
  return (x < y) - (x > y);
}

static bool is_usable(const baum_i_entry *entry)
{
  const baum_study_entry *r = &entry->out;
  return r->state == BAUM_STUDY_DONE && entry->stage >= BAUM_I_TIMED && !r->off &&
         isfinite(r->error) && r->error > 0.0;
}

bool baum_i_study_is_answer(const baum_i_entry *entry)
{
  return is_usable(entry) && !entry->out.unstable;
}

int baum_i_study_usable(const baum_study *study, int method,
                        const baum_i_entry *entries[BAUM_I_METHOD_ENTRIES])
{
  int count = 0;
  for (int k = 0; k < study->entry_count && count < BAUM_I_METHOD_ENTRIES; k++) {
    const baum_i_entry *entry = study->entries[k];
    if (entry->out.method == method && is_usable(entry)) {
      entries[count++] = entry;
    }
  }
  /* NOLINTNEXTLINE(bugprone-sizeof-expression): pointers are sorted. */
  qsort(entries, (size_t)count, sizeof *entries, by_setting);
  return count;
}

/* Returns the slope of the least-squares line through points. Returns NaN if there are fewer than
 * two different values of x. */
static double slope_of(const double *x, const double *y, int count)
{
  double mx = 0.0;
  double my = 0.0;
  for (int k = 0; k < count; k++) {
    mx += x[k] / count;
    my += y[k] / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (int k = 0; k < count; k++) {
    xx += (x[k] - mx) * (x[k] - mx);
    xy += (x[k] - mx) * (y[k] - my);
  }
  return count >= 2 && xx > 0.0 ? xy / xx : (double)NAN;
}

/* Fits lines to these entries, and stores their slopes in the method. */
static void fit(const baum_i_entry *const *entries, int count, baum_study_method *out)
{
  double setting[BAUM_I_METHOD_ENTRIES];
  double error[BAUM_I_METHOD_ENTRIES];
  double work[BAUM_I_METHOD_ENTRIES];
  double cpu[BAUM_I_METHOD_ENTRIES];
  int used = 0;
  for (int k = 0; k < count; k++) {
    const baum_study_entry *entry = &entries[k]->out;
    if (entry->error >= FLOOR * out->least_error || entry->error == out->least_error) {
      setting[used] = log10(baum_i_setting(&entries[k]->options));
      error[used] = log10(entry->error);
      work[used] = log10(entry->work);
      cpu[used++] = log10(entry->cpu);
    }
    if (entry->error == out->least_error) {
      break;
    }
  }
  out->slope = slope_of(setting, error, used);
  out->work_per_digit = pow(10.0, -slope_of(error, work, used));
  out->cpu_per_digit = pow(10.0, -slope_of(error, cpu, used));
}

static double growth_of(const baum_i_entry *const *entries, int count)
{
  double sum = 0.0;
  int used = 0;
  for (int k = 0; k < count; k++) {
    if (isfinite(entries[k]->out.error_validated)) {
      sum += log(entries[k]->out.error_validated / entries[k]->out.error);
      used++;
    }
  }
  return used > 0 ? exp(sum / used) : (double)NAN;
}

int32_t baum_study_method_count(const baum_study *study)
{
  return study ? study->method_count : 0;
}

baum_status baum_study_method_at(const baum_study *study, int32_t k, baum_study_method *out,
                                 size_t caller_size)
{
  const char *call = "baum_study_method_at";
  if (!study || k < 0 || k >= study->method_count) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the study is NULL or has no method %d", call,
                       (int)k);
  }
  BAUM_I_TRY(baum_i_check_sized(out, caller_size, call));
  const baum_i_study_method *method = &study->methods[k];
  const baum_simulation_options *o = &study->entries[method->first]->options;
  const double none = (double)NAN;
  baum_study_method whole = {.name = method->name.text,
                             .integrator = o->integrator,
                             .formulation = o->formulation,
                             .gains = o->gains,
                             .fixed_step = !isnan(o->step),
                             .least_error = none,
                             .slope = none,
                             .work_per_digit = none,
                             .cpu_per_digit = none};
  const baum_i_entry *entries[BAUM_I_METHOD_ENTRIES];
  whole.usable = baum_i_study_usable(study, k, entries);
  for (int i = 0; i < study->entry_count; i++) {
    whole.entries += study->entries[i]->out.method == k;
  }
  for (int i = 0; i < whole.usable; i++) {
    whole.least_error = fmin(whole.least_error, entries[i]->out.error);
  }
  fit(entries, whole.usable, &whole);
  whole.growth = growth_of(entries, whole.usable);
  baum_i_give_sized(out, caller_size, &whole, sizeof whole);
  return BAUM_OK;
}
