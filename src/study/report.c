/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes reports of all forms, to memory and to files. */
#include "study/report.h"

#include "base/file.h"

typedef void report_fn(const baum_i_snapshot *snapshot, baum_i_buffer *out);

static report_fn *const FORMS[] = {baum_i_report_text, baum_i_report_csv, baum_i_report_json,
                                   baum_i_report_page};
enum { FORM_COUNT = sizeof FORMS / sizeof FORMS[0] };

/* Writes a report to *out. The caller must clear *out afterwards. */
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
  baum_i_buffer report = {0};
  baum_status status = make_report(study, form, title, call, &report);
  if (status == BAUM_OK) {
    status = baum_i_give_file(&report, call, path);
  }
  baum_i_buffer_clear(&report);
  return status;
}

baum_status baum_study_print(const baum_study *study, baum_report_form form, const char *title,
                             char *text, size_t capacity, size_t *size)
{
  const char *call = "baum_study_print";
  baum_i_buffer report = {0};
  baum_status status = make_report(study, form, title, call, &report);
  if (status == BAUM_OK) {
    status = baum_i_give_text(&report, call, text, capacity, size);
  }
  baum_i_buffer_clear(&report);
  return status;
}
