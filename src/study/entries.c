/* SPDX-License-Identifier: BSD-3-Clause */
/* Adds settings to a study, and returns their entries. */
#include <math.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "integrate/integrator.h"
#include "study/fields.h"
#include "study/study.h"

/* Sets all results of an entry to values that mean "not known". */
static void clear_results(baum_study_entry *entry)
{
  for (const baum_i_field *f = baum_i_entry_fields; f->key; f++) {
    if (f->filed && f->kind == BAUM_I_NUMBER) {
      *(double *)(void *)((char *)entry + f->place) = (double)NAN;
    }
  }
}

/* Returns the formulation of the options. DEFAULT is replaced by the formulation that it stands
 * for. */
static baum_formulation resolve_formulation(const baum_simulation_options *o)
{
  return o->formulation == BAUM_FORMULATION_DEFAULT ? o->integrator->formulations[0]
                                                    : o->formulation;
}

static void describe(baum_i_entry *entry)
{
  baum_simulation_options *o = &entry->options;
  o->formulation = resolve_formulation(o);
  o->progress = NULL;
  o->user = NULL;
  entry->name = baum_i_options_name(o);
  entry->key = baum_i_options_key(o, true);
  entry->out = (baum_study_entry){.integrator = o->integrator,
                                  .formulation = o->formulation,
                                  .gains = o->gains,
                                  .step = o->step,
                                  .rtol = o->rtol};
  clear_results(&entry->out);
}

static baum_status copy_row_gains(baum_i_entry *entry)
{
  baum_simulation_options *o = &entry->options;
  if (o->row_gains && o->row_gain_count > 0) {
    entry->row_gains = baum_i_copy(o->row_gains, (size_t)o->row_gain_count, sizeof(double));
    if (!entry->row_gains) {
      return baum_i_fail_memory();
    }
    o->row_gains = entry->row_gains;
  }
  return BAUM_OK;
}

/* Appends an entry to a study, which then owns the entry. After this call has succeeded, the caller
 * must not return an error, because the entry stays in the study. */
static baum_status append_entry(baum_study *study, baum_i_entry *entry)
{
  size_t wanted = (size_t)study->entry_count + 1;
  /* NOLINTNEXTLINE(bugprone-sizeof-expression): an array of pointers. */
  baum_i_entry **entries = baum_i_grow_by_one(study->entries, wanted, sizeof *study->entries);
  BAUM_I_TRY(baum_i_check_memory(entries));
  study->entries = entries;
  entry->out.method = baum_i_study_find_method(study, &entry->options, study->entry_count);
  if (entry->out.method < 0) {
    return baum_i_fail_memory();
  }
  study->entries[study->entry_count++] = entry;
  return BAUM_OK;
}

static baum_status copy_options(const baum_study *study, const baum_simulation_options *options,
                                baum_simulation_options *out)
{
  const char *call = "baum_study_add";
  if (!study || !options) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: study or options are NULL", call);
  }
  *out = baum_simulation_options_default();
  BAUM_I_TRY(baum_i_take_sized(out, sizeof *out, options, call, "", "the default"));
  return out->integrator ? baum_i_study_check_idle(study, call)
                         : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: integrator is NULL", call);
}

baum_status baum_study_add(baum_study *study, const baum_simulation_options *options)
{
  baum_simulation_options taken;
  BAUM_I_TRY(copy_options(study, options, &taken));
  baum_i_entry *entry = baum_i_alloc(1, sizeof *entry);
  BAUM_I_TRY(baum_i_check_memory(entry));
  entry->options = taken;
  entry->options.start_time = study->t0;
  baum_status status = copy_row_gains(entry);
  if (status == BAUM_OK) {
    describe(entry);
    status = append_entry(study, entry);
  }
  if (status != BAUM_OK) {
    baum_i_free(entry->row_gains);
    baum_i_free(entry);
  }
  return status;
}

int32_t baum_study_entry_count(const baum_study *study)
{
  return study ? study->entry_count : 0;
}

static baum_status check_read(const baum_study *study, int32_t k, const void *out,
                              size_t caller_size, const char *call)
{
  BAUM_I_TRY(baum_i_study_check(study, call));
  if (k < 0 || k >= study->entry_count) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: k is %d, must be 0 to %d", call, (int)k,
                       study->entry_count - 1);
  }
  return baum_i_check_sized(out, caller_size, call);
}

baum_status baum_study_entry_at(const baum_study *study, int32_t k, baum_study_entry *out,
                                size_t caller_size)
{
  BAUM_I_TRY(check_read(study, k, out, caller_size, "baum_study_entry_at"));
  baum_study_entry whole = study->entries[k]->out;
  whole.name = study->entries[k]->name.text;
  whole.message = study->entries[k]->message;
  baum_i_give_sized(out, caller_size, &whole, sizeof whole);
  return BAUM_OK;
}

baum_status baum_study_entry_options(const baum_study *study, int32_t k,
                                     baum_simulation_options *out, size_t caller_size)
{
  BAUM_I_TRY(check_read(study, k, out, caller_size, "baum_study_entry_options"));
  baum_i_give_sized(out, caller_size, &study->entries[k]->options, sizeof(baum_simulation_options));
  return BAUM_OK;
}
