/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Reports of a study, which compares integration methods on one mechanism (study.h). A report
 *  lists the entries of the study (each is a setting with its results), the Pareto front, the
 *  recommendations and the quality of the reference motion. It also describes the machine that ran
 *  the study.
 *
 *    baum_study_write(study, BAUM_REPORT_PAGE, "slider-crank", "slider_crank.html");
 *
 *  Values that are not known, such as the results of failed entries, appear as a dash in texts and
 *  pages, as an empty field in CSV, and as null in JSON. Reports are in UTF-8. Numbers have a
 *  decimal point, whatever the locale is. You can write a report at any time. Writing it does not
 *  change the study. */
#ifndef BAUM_REPORT_H
#define BAUM_REPORT_H

#include <stddef.h>

#include <baum/study.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The form of a report. */
typedef enum baum_report_form {
  BAUM_REPORT_TEXT = 0, /**< Aligned columns for a screen. */
  /** Only the entries: one line with the names of the columns, then one line for each entry (RFC
   *  4180). */
  BAUM_REPORT_CSV = 1,
  /** The whole report. The member "units" states the unit of every key. Later versions of the
   *  library keep these keys. */
  BAUM_REPORT_JSON = 2,
  /** One HTML page with charts, a sortable table and a picture of the mechanism. The page loads no
   *  other files. Drawing the picture calls user functions of the mechanism. */
  BAUM_REPORT_PAGE = 3
} baum_report_form;

/** Write a report into a file and wait until the file is on the disk. If a file of this name
 *  exists, the function first writes a new file under a temporary name in the same folder
 *  (.baum-*.part). When the new file is complete, it replaces the older file and takes over its
 *  permissions. If the function fails, the older file remains. Pipes, devices, symbolic links,
 *  files with several hard links and files of another owner cannot be replaced safely. The function
 *  writes to them directly, so they may be incomplete after a failure.
 *  @param     study  the study
 *  @param     form   form of the report
 *  @param[in] title  title of the report; CSV has none. NULL means "Study".
 *  @param[in] path   path of the file
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_FILE (the message gives the reason),
 *           BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_write(const baum_study *study, baum_report_form form,
                                      const char *title, const char *path);

/** Write a report into memory.
 *  @param      study     the study
 *  @param      form      form of the report
 *  @param[in]  title     title of the report; CSV has none. NULL means "Study".
 *  @param[out] text      (capacity) the report, zero-terminated, truncated if too long. May be
 *                        NULL if capacity is 0.
 *  @param      capacity  [byte]
 *  @param[out] size      [byte] length of the whole report without the final zero. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_print(const baum_study *study, baum_report_form form,
                                      const char *title, char *text, size_t capacity, size_t *size);

#ifdef __cplusplus
}
#endif

#endif
