/* SPDX-License-Identifier: BSD-3-Clause */
/* Settings that are added, and what can be read of their rows. */
#include <math.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "integrate/integrator.h"
#include "study/study.h"

/* Everything that is measured, not known. */
static void clear(baum_study_row *row)
{
  const double none = (double)NAN;
  row->error = row->error_final = row->error_half = none;
  row->error_q = row->error_q_final = row->error_v = row->error_v_final = none;
  row->error_lambda = row->error_lambda_final = none;
  row->energy_error = row->energy_error_final = none;
  row->max_phi = row->max_phi_rate = none;
  row->violation_work = row->projection_work = row->gains_work = none;
  row->work = row->cpu = row->cpu_spread = row->error_rehearsed = none;
  row->alpha = row->beta = none;
}

/* The formulation that DEFAULT stands for. */
static baum_formulation meant(const baum_simulation_options *o)
{
  return o->formulation == BAUM_FORMULATION_DEFAULT ? o->integrator->formulations[0]
                                                    : o->formulation;
}

static void describe(baum_i_row *row)
{
  baum_simulation_options *o = &row->options;
  o->formulation = meant(o);
  o->progress = NULL;
  o->user = NULL;
  baum_i_name_method(o, row->name, sizeof row->name);
  baum_i_name_setting(o, row->name, sizeof row->name);
  row->key = baum_i_options_key(o, true);
  row->out = (baum_study_row){.integrator = o->integrator,
                              .formulation = o->formulation,
                              .gains = o->gains,
                              .step = o->step,
                              .rtol = o->rtol};
  clear(&row->out);
}

static baum_status copy_row_gains(baum_i_row *row)
{
  baum_simulation_options *o = &row->options;
  if (o->row_gains && o->row_gain_count > 0) {
    row->row_gains = baum_i_copy(o->row_gains, (size_t)o->row_gain_count, sizeof(double));
    if (!row->row_gains) {
      return baum_i_fail_memory();
    }
    o->row_gains = row->row_gains;
  }
  return BAUM_OK;
}

/* Last, for the row is the study's from here on. */
static baum_status keep(baum_study *study, baum_i_row *row)
{
  size_t wanted = (size_t)study->row_count + 1;
  /* NOLINTNEXTLINE(bugprone-sizeof-expression): an array of pointers. */
  baum_i_row **rows = baum_i_grow_by_one(study->rows, wanted, sizeof *study->rows);
  if (!rows) {
    return baum_i_fail_memory();
  }
  study->rows = rows;
  row->out.method = baum_i_study_find_method(study, &row->options, study->row_count);
  if (row->out.method < 0) {
    return baum_i_fail_memory();
  }
  study->rows[study->row_count++] = row;
  return BAUM_OK;
}

void baum_i_study_drop_rows(baum_study *study, int rows, int methods)
{
  for (int k = rows; k < study->row_count; k++) {
    baum_i_free(study->rows[k]->row_gains);
    baum_i_free(study->rows[k]);
  }
  study->row_count = rows;
  study->method_count = methods;
}

static baum_status take(const baum_study *study, const baum_simulation_options *options,
                        baum_simulation_options *out)
{
  const char *call = "baum_study_add";
  if (!study || !options) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: study or options are NULL", call);
  }
  *out = baum_simulation_options_default();
  baum_status status = baum_i_study_take(out, sizeof *out, options, call);
  if (status == BAUM_OK && !out->integrator) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: integrator is NULL", call);
  }
  return status == BAUM_OK ? baum_i_study_check_idle(study, call) : status;
}

baum_status baum_study_add(baum_study *study, const baum_simulation_options *options)
{
  baum_simulation_options taken;
  baum_status status = take(study, options, &taken);
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_row *row = baum_i_alloc(1, sizeof *row);
  if (!row) {
    return baum_i_fail_memory();
  }
  row->options = taken;
  row->options.start_time = study->t0;
  status = copy_row_gains(row);
  if (status == BAUM_OK) {
    describe(row);
    status = keep(study, row);
  }
  if (status != BAUM_OK) {
    baum_i_free(row->row_gains);
    baum_i_free(row);
  }
  return status;
}

int32_t baum_study_row_count(const baum_study *study)
{
  return study ? study->row_count : 0;
}

static baum_status check_read(const baum_study *study, int32_t k, const void *out,
                              size_t caller_size, const char *call)
{
  if (!study) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the study is NULL", call);
  }
  if (k < 0 || k >= study->row_count) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: k is %d, must be 0 to %d", call, (int)k,
                       study->row_count - 1);
  }
  return baum_i_check_sized(out, caller_size, call);
}

baum_status baum_study_row_at(const baum_study *study, int32_t k, baum_study_row *out,
                              size_t caller_size)
{
  baum_status status = check_read(study, k, out, caller_size, "baum_study_row_at");
  if (status == BAUM_OK) {
    baum_study_row whole = study->rows[k]->out;
    whole.name = study->rows[k]->name;
    whole.message = study->rows[k]->message;
    baum_i_give_sized(out, caller_size, &whole, sizeof whole);
  }
  return status;
}

baum_status baum_study_row_options(const baum_study *study, int32_t k, baum_simulation_options *out,
                                   size_t caller_size)
{
  baum_status status = check_read(study, k, out, caller_size, "baum_study_row_options");
  if (status == BAUM_OK) {
    baum_i_give_sized(out, caller_size, &study->rows[k]->options, sizeof(baum_simulation_options));
  }
  return status;
}
