/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  A study on paper: its entries, its front, what it recommends, its reference and where it was
 *  made.
 *
 *    baum_study_write(study, BAUM_REPORT_PAGE, "slider-crank", "slider_crank.html");
 *
 *  What is not known, as figures of entries that have failed, is a dash for people, empty in CSV
 *  and null in JSON. Texts are UTF-8; numbers have a point whatever the locale is. Reading only: a
 *  study may be reported at any time.
 */
#ifndef BAUM_REPORT_H
#define BAUM_REPORT_H

#include <stddef.h>

#include <baum/study.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a report looks like. */
typedef enum baum_report_form {
  BAUM_REPORT_TEXT = 0, /**< Aligned columns for a screen. */
  BAUM_REPORT_CSV =
    1, /**< The entries, one line each, below a line of keys; comma separated, RFC 4180. */
  BAUM_REPORT_JSON =
    2, /**< All there is; "units" has the unit of every key. Keys stay as they are. */
  BAUM_REPORT_PAGE = 3 /**< One HTML page with charts and a table to sort, which loads nothing. */
} baum_report_form;

/** Write a report into a file, and wait until it is on the disk. An older file is replaced, with
 *  its mode, when the new one is complete; on failure it stays as it is. While it is written, the
 *  new file has a name of its own in the same folder (.baum-*.part). What replacing would break is
 *  written in place, and may be incomplete after a failure: a pipe, a device, a symbolic link, a
 *  file with several hard links, and one of another owner.
 *  @param form   which
 *  @param title  of text, JSON and page. NULL: "Study"
 *  @param path   of the file
 *  @return       BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_FILE (the message has the system's reason),
 *                BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_study_write(const baum_study *study, baum_report_form form,
                                      const char *title, const char *path);

/** Write a report into memory.
 *  @param      form      which
 *  @param      title     as above
 *  @param[out] text      (capacity) zero-terminated, cut if too long. NULL when capacity is 0
 *  @param      capacity  [byte]
 *  @param[out] size      [byte] that the report has, without its zero. May be NULL
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_study_print(const baum_study *study, baum_report_form form,
                                      const char *title, char *text, size_t capacity, size_t *size);

#ifdef __cplusplus
}
#endif

#endif
