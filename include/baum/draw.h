/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Drawings of mechanisms, and HTML pages that show a run in any browser.
 *
 *    double rows[401 * 9];  // channels: BAUM_Q of nine positions
 *    baum_simulation_sample(run, times, 401, &channel, 1, rows, NULL);
 *    baum_page page = baum_page_default();
 *    page.times = times, page.count = 401;
 *    page.channels = &channel, page.channel_count = 1, page.rows = rows;
 *    baum_page_write(mechanism, &page, "slider_crank.html");
 *
 *  The shapes follow from the elements: links are bars between their joints, sliders are blocks,
 *  wheels are discs, other bodies have the size that corresponds to their inertia, and joints and
 *  forces are symbols.
 *
 *  Files replace older ones as described for baum_study_write(). These functions do not change the
 *  mechanism.
 */
#ifndef BAUM_DRAW_H
#define BAUM_DRAW_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- one configuration ----------------------------------------------------------------------- */

/** Draw a mechanism as an SVG picture, in the x-y plane or, with spatial elements, in a parallel
 *  view from above. A red line joins the two points of a joint that is open.
 *  @param      mechanism  must be frozen unless q is NULL
 *  @param[in]  q          (nq) positions. NULL: the design configuration.
 *  @param[out] text       (capacity) zero-terminated, truncated if too long. NULL if capacity is 0.
 *  @param      capacity   [byte]
 *  @param[out] size       [byte] length of the whole picture without the final zero. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen), BAUM_ERR_NOT_FINITE,
 *           BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_svg(const baum_mechanism *mechanism, const double *q,
                                        char *text, size_t capacity, size_t *size);

/** Write the picture of baum_mechanism_svg() into a file.
 *  @param     mechanism  must be frozen unless q is NULL
 *  @param[in] q          (nq) positions. NULL: the design configuration.
 *  @param[in] path       of the file
 *  @return  as baum_mechanism_svg(), and BAUM_ERR_FILE */
BAUM_API baum_status baum_mechanism_write_svg(const baum_mechanism *mechanism, const double *q,
                                              const char *path);

/* ---- a run ----------------------------------------------------------------------------------- */

/** What a page shows: samples of a run as baum_simulation_sample() records them. All pointers
 *  belong to the caller and are read only during the call. */
typedef struct baum_page {
  size_t struct_size;  /**< Set by the default. Do not write. */
  const char *title;   /**< Default: NULL, "Mechanism". */
  const double *times; /**< (count) [s] monotone. Default: NULL, must be set. */
  /** [-] > 0. A page keeps at most 600 samples, among them the extremes of the columns that it
   *  plots. Default: 0, must be set. */
  int64_t count;
  /** (channel_count) the channels in each row. BAUM_Q must be among them; BAUM_JOINT_REACTION is
   *  shown as an arrow. Default: NULL, must be set. */
  const baum_channel *channels;
  int32_t channel_count; /**< [-] > 0. Default: 0, must be set. */
  const double *rows;    /**< (count x baum_channels_width()). Default: NULL, must be set. */
  /** (count x plot_count) columns to plot, such as `rows` + 9. Default: NULL. */
  const double *plots;
  int32_t plot_count;  /**< [-] >= 0. Default: 0. */
  int32_t plot_stride; /**< [-] numbers in a row of `plots`. Default: 0, plot_count. */
  /** (plot_count) such as "slider velocity [m/s]". Consecutive columns with the same unit share a
   *  plot. Default: NULL. */
  const char *const *plot_labels;
  const baum_channel *traces;    /**< (trace_count) BAUM_BODY_POSE of points. Default: NULL. */
  int32_t trace_count;           /**< [-] >= 0. Default: 0. */
  const double *mark_times;      /**< (mark_count) [s] of events and warnings. Default: NULL. */
  const char *const *mark_texts; /**< (mark_count) Default: NULL. */
  int32_t mark_count;            /**< [-] >= 0. Default: 0. */
} baum_page;

/** Set every field to its default.
 *  @param[out] page         NULL is ignored
 *  @param      caller_size  sizeof *page; no byte beyond it is written */
BAUM_API void baum_page_init(baum_page *page, size_t caller_size);

/** Make a page with every field at its default. @return the page */
static inline baum_page baum_page_default(void)
{
  baum_page page;
  baum_page_init(&page, sizeof page);
  return page;
}

/** Write a page into a file: one HTML file that loads no other file.
 *  @param     mechanism  frozen
 *  @param[in] page       what it shows
 *  @param[in] path       of the file
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE (not frozen),
 *           BAUM_ERR_FILE, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_page_write(const baum_mechanism *mechanism, const baum_page *page,
                                     const char *path);

/** Write a page into memory.
 *  @param      mechanism  frozen
 *  @param[in]  page       what it shows
 *  @param[out] text       (capacity) zero-terminated, truncated if too long. NULL if capacity is 0.
 *  @param      capacity   [byte]
 *  @param[out] size       [byte] length of the whole page without the final zero. May be NULL.
 *  @return  as baum_page_write() without BAUM_ERR_FILE */
BAUM_API baum_status baum_page_print(const baum_mechanism *mechanism, const baum_page *page,
                                     char *text, size_t capacity, size_t *size);

/** Draw one sample of a page as an SVG picture, with the paths of the traces up to this sample, and
 *  with reactions as arrows. The view holds the whole motion, so that pictures of several samples
 *  have the same scale. Plots, marks and the title are not shown.
 *  @param      mechanism  frozen
 *  @param[in]  page       the motion
 *  @param      sample     [-] >= 0, < count of the page
 *  @param[out] text       (capacity) zero-terminated, truncated if too long. NULL if capacity is 0.
 *  @param      capacity   [byte]
 *  @param[out] size       [byte] length of the whole picture without the final zero. May be NULL.
 *  @return  as baum_page_print(), and BAUM_ERR_NOT_FINITE for positions that are not finite */
BAUM_API baum_status baum_page_svg(const baum_mechanism *mechanism, const baum_page *page,
                                   int64_t sample, char *text, size_t capacity, size_t *size);

#ifdef __cplusplus
}
#endif

#endif
