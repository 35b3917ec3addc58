/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes reports in their forms, into memory and into files. */
#include "study/report.h"

#include <string.h>

typedef void report_fn(const baum_i_snapshot *snapshot, baum_i_buffer *out);

static report_fn *const FORMS[] = {baum_i_report_text, baum_i_report_csv, baum_i_report_json,
                                   baum_i_report_page};
enum { FORM_COUNT = sizeof FORMS / sizeof FORMS[0] };

/* Makes the report in *out, which the caller clears. */
static baum_status make_report(const baum_study *study, baum_report_form form, const char *title,
                               const char *call, baum_i_buffer *out)
{
  if (!study) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the study is NULL", call);
  }
  if ((int)form < 0 || (int)form >= FORM_COUNT) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: form is %d, must be one of baum_report_form", call,
                       (int)form);
  }
  baum_i_snapshot snapshot;
  baum_status status = baum_i_snapshot_read(study, title, &snapshot);
  if (status == BAUM_OK) {
    FORMS[form](&snapshot, out);
  }
  baum_i_snapshot_clear(&snapshot);
  return status == BAUM_OK && out->failed ? baum_i_fail_memory() : status;
}

baum_status baum_study_write(const baum_study *study, baum_report_form form, const char *title,
                             const char *path)
{
  const char *call = "baum_study_write";
  if (!path || !path[0]) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: path is NULL or empty", call);
  }
  baum_i_buffer report = {0};
  baum_status status = make_report(study, form, title, call, &report);
  if (status == BAUM_OK) {
    status = baum_i_write_file(path, report.text, report.used);
  }
  baum_i_buffer_clear(&report);
  return status;
}

baum_status baum_study_print(const baum_study *study, baum_report_form form, const char *title,
                             char *text, size_t capacity, size_t *size)
{
  const char *call = "baum_study_print";
  if (!text && capacity > 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: text is NULL and capacity is not 0", call);
  }
  baum_i_buffer report = {0};
  baum_status status = make_report(study, form, title, call, &report);
  if (status == BAUM_OK && report.text && capacity > 0) {
    size_t kept = report.used < capacity ? report.used : capacity - 1;
    memcpy(text, report.text, kept);
    text[kept] = '\0';
  }
  if (status == BAUM_OK && size) {
    *size = report.used;
  }
  baum_i_buffer_clear(&report);
  return status;
}
