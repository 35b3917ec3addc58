/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Reports of a study: its entries, front, recommendations and reference, and the machine
 *  that ran it.
 *
 *    baum_study_write(study, BAUM_REPORT_PAGE, "slider-crank", "slider_crank.html");
 *
 *  Unknown values, such as figures of failed entries, are a dash in text and page, empty in CSV and
 *  null in JSON. Texts are UTF-8. Numbers have a decimal point in every locale. Writing a report
 *  does not change the study and is possible at any time. */
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
  /** The entries only: a header line of keys, then one line for each entry (RFC 4180). */
  BAUM_REPORT_CSV = 1,
  /** Everything; "units" has the unit of every key. Keys are stable. */
  BAUM_REPORT_JSON = 2,
  /** One HTML page with charts, a sortable table and a picture of the mechanism. The page loads no
   *  other files. Drawing the picture calls functions of the mechanism. */
  BAUM_REPORT_PAGE = 3
} baum_report_form;

/** Write a report into a file and wait until it is on the disk. A complete new file replaces an
 *  older one and keeps its mode; on failure the older one remains. While it is written, the new
 *  file has a temporary name in the same folder (.baum-*.part). Pipes, devices, symbolic links,
 *  files with several hard links and files of another owner cannot be replaced safely. They are
 *  written in place and may be incomplete after a failure.
 *  @param     study  the study
 *  @param     form   the form
 *  @param[in] title  of text, JSON and page. NULL: "Study".
 *  @param[in] path   of the file
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_FILE (the message has the system's reason),
 *           BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_write(const baum_study *study, baum_report_form form,
                                      const char *title, const char *path);

/** Write a report into memory.
 *  @param      study     the study
 *  @param      form      the form
 *  @param[in]  title     of text, JSON and page. NULL: "Study".
 *  @param[out] text      (capacity) zero-terminated, cut if too long. NULL if capacity is 0.
 *  @param      capacity  [byte]
 *  @param[out] size      [byte] length of the whole report without the final zero. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_print(const baum_study *study, baum_report_form form,
                                      const char *title, char *text, size_t capacity, size_t *size);

#ifdef __cplusplus
}
#endif

#endif
