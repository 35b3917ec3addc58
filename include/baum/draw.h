/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Drawings of mechanisms, and HTML pages that show a run in any browser.
 *
 *    double rows[401 * 9];  // 401 samples of BAUM_Q with nine columns
 *    baum_simulation_sample(run, times, 401, &channel, 1, rows, NULL);
 *    baum_page page = baum_page_default();
 *    page.times = times, page.count = 401;
 *    page.channels = &channel, page.channel_count = 1, page.rows = rows;
 *    baum_page_write(mechanism, &page, "slider_crank.html");
 *
 *  The library chooses the shape of each body from the elements of the mechanism. It draws links as
 *  bars between their joints, sliders as blocks, and wheels as discs. It draws every other body in
 *  a size that corresponds to its inertia. Joints and forces are drawn as symbols. You can give
 *  a body outlines (shapes of your own), which replace the shape that the library chooses.
 *
 *  If the file that a function of this header writes already exists, the new file replaces it as
 *  described at baum_study_write(). Drawing does not change the mechanism. */
#ifndef BAUM_DRAW_H
#define BAUM_DRAW_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- outlines -------------------------------------------------------------------------------- */

/** Forms of outlines. */
typedef enum baum_outline_form {
  BAUM_OUTLINE_POLYGON = 0,  /**< A flat polygon with the corners `points`. It may be concave. */
  BAUM_OUTLINE_CIRCLE = 1,   /**< A disc parallel to the x-y plane of the body. */
  BAUM_OUTLINE_BOX = 2,      /**< A box with edges parallel to the axes of the body. */
  BAUM_OUTLINE_CYLINDER = 3, /**< A circular cylinder from `start` to `end`. */
  BAUM_OUTLINE_SPHERE = 4,   /**< A sphere about `center`. */
  BAUM_OUTLINE_MESH = 5      /**< Triangles, which are visible from both sides. */
} baum_outline_form;

#define BAUM_OUTLINE_MAX_TRIANGLES 200000 /**< Largest number of triangles of a mesh. */

/** An outline is a shape that is drawn for a body. It is given in the axes of the body. Each form
 *  uses only some of the fields below; the comment of a field names the forms that use it. */
typedef struct baum_outline {
  size_t struct_size;     /**< Set by the default function. Do not write. */
  baum_outline_form form; /**< Default: BAUM_OUTLINE_POLYGON. */
  /** (point_count x 3) [m] x, y, z of the corners of a polygon or of the vertices of a mesh. The
   *  corners of a polygon must all have the same z. Default: NULL, must be set. */
  const double *points;
  int32_t point_count; /**< [-] >= 3, number of points. Default: 0, must be set. */
  /** (triangle_count x 3) [-] the three vertices of each triangle of a mesh, as indices of rows of
   *  `points`, counted from 0. Default: NULL, must be set. */
  const int32_t *triangles;
  /** [-] 1 to BAUM_OUTLINE_MAX_TRIANGLES, number of triangles of a mesh.
   *  Default: 0, must be set. */
  int32_t triangle_count;
  double center[3]; /**< [m] centre of a circle, box or sphere. Default: (0, 0, 0). */
  /** [m] >= 0, lengths of the edges of a box along x, y and z; one of them may be 0.
   *  Default: (0, 0, 0), must be set. */
  double size[3];
  double start[3]; /**< [m] centre of one end of a cylinder. Default: (0, 0, 0). */
  /** [m] centre of the other end of a cylinder; must differ from `start`. Default: (0, 0, 0). */
  double end[3];
  /** [m] > 0, radius of a circle, cylinder or sphere. Default: 0, must be set. */
  double radius;
  /** Colour, as "#rrggbb". Default: NULL, the library chooses a colour for the body. */
  const char *color;
} baum_outline;

/** Set every field to its default.
 *  @param[out] outline      NULL is ignored
 *  @param      caller_size  sizeof *outline; no byte beyond it is written */
BAUM_API void baum_outline_init(baum_outline *outline, size_t caller_size);

/** Make an outline with every field at its default. @return the outline */
static inline baum_outline baum_outline_default(void)
{
  baum_outline outline;
  baum_outline_init(&outline, sizeof outline);
  return outline;
}

/** Set the outlines of a body. The body is then drawn with these outlines instead of the shape that
 *  the library has chosen. Planar and spatial bodies, particles and ground may have outlines of
 *  every form. The mechanism may be frozen or not. Outlines change only drawings, not the motion.
 *  Copies of the mechanism have the same outlines. While this function runs, no other thread may
 *  draw or copy the mechanism.
 *  @param     mechanism  unchanged on failure
 *  @param     body       a body of the mechanism, but not a body of user coordinates, because such
 *                        a body has no position in space
 *  @param[in] outlines   (count) new outlines, which replace all earlier outlines of the body.
 *                        Copied. May be NULL if count is 0.
 *  @param     count      [-] >= 0, number of outlines; with 0 the body is drawn with the shape that
 *                        the library chooses
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_set_outlines(baum_mechanism *mechanism, baum_body_id body,
                                                 const baum_outline *outlines, int32_t count);

/** Count the outlines of a body.
 *  @param mechanism  may be NULL
 *  @param body       a body of the mechanism
 *  @return [-] number of outlines; 0 if there is no such body */
BAUM_API int32_t baum_mechanism_outline_count(const baum_mechanism *mechanism, baum_body_id body);

/** Read an outline. The pointers in the outline stay valid until the outlines of the body are set
 *  again.
 *  @param      mechanism    frozen or not
 *  @param      body         a body of the mechanism
 *  @param      k            [-] number of the outline, 0 to baum_mechanism_outline_count() - 1
 *  @param[out] out          receives the outline
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_mechanism_get_outline(const baum_mechanism *mechanism, baum_body_id body,
                                                int32_t k, baum_outline *out, size_t caller_size);

/* ---- one configuration ----------------------------------------------------------------------- */

/** Draw a mechanism as an SVG picture. A planar mechanism is shown in the x-y plane. A mechanism
 *  with spatial elements is shown in a parallel projection, seen obliquely from above. Red lines
 *  show where the constraints of a joint are violated. A red line connects two points that should
 *  coincide, or the tips of two axes that should be parallel. It may also connect a point with the
 *  line, plane or curve on which the point should be. For a distance joint, it connects a point
 *  with the sphere on which the point should be.
 *  @param      mechanism  must be frozen unless q is NULL
 *  @param[in]  q          (nq) positions. If q is NULL, the design configuration is drawn.
 *  @param[out] text       (capacity) the picture, zero-terminated, truncated if too long. May be
 *                         NULL if capacity is 0.
 *  @param      capacity   [byte]
 *  @param[out] size       [byte] length of the whole picture without the final zero. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen), BAUM_ERR_NOT_FINITE,
 *           BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_svg(const baum_mechanism *mechanism, const double *q,
                                        char *text, size_t capacity, size_t *size);

/** Write the picture of baum_mechanism_svg() into a file.
 *  @param     mechanism  must be frozen unless q is NULL
 *  @param[in] q          (nq) positions. If q is NULL, the design configuration is drawn.
 *  @param[in] path       path of the file
 *  @return  as baum_mechanism_svg(), and BAUM_ERR_FILE */
BAUM_API baum_status baum_mechanism_write_svg(const baum_mechanism *mechanism, const double *q,
                                              const char *path);

/** Draw the assembled configuration at t = 0. If the mechanism cannot be assembled, the function
 *  draws the configuration in which assembly stopped, and red lines show the joints in conflict.
 *  @param      mechanism  frozen or not
 *  @param[out] text       (capacity) as in baum_mechanism_svg()
 *  @param      capacity   [byte]
 *  @param[out] size       [byte] length of the whole picture without the final zero. May be NULL.
 *  @return  BAUM_OK, also if the constraints contradict each other; BAUM_ERR_ARGUMENT,
 *           BAUM_ERR_SINGULAR, BAUM_ERR_NOT_FINITE, BAUM_ERR_CALLBACK, BAUM_ERR_MEMORY. If the
 *           mechanism is not frozen, the function freezes a copy and may also return a status of
 *           baum_mechanism_freeze(). */
BAUM_API baum_status baum_mechanism_svg_assembled(const baum_mechanism *mechanism, char *text,
                                                  size_t capacity, size_t *size);

/* ---- a run ----------------------------------------------------------------------------------- */

/** A kind of mark on the time axis of the HTML page of a run (baum_page). Each kind has a different
 *  colour and shape. */
typedef enum baum_mark_kind {
  BAUM_MARK_WARNING = 0,  /**< A warning of the run. */
  BAUM_MARK_SINGULAR = 1, /**< A near-singular interval of the run. */
  BAUM_MARK_EVENT = 2     /**< An event of the run. */
} baum_mark_kind;

/** The content of an HTML page: samples of a run as baum_simulation_sample() records them. All
 *  pointers belong to the caller. The library reads them only during the call that writes or draws
 *  the page. */
typedef struct baum_page {
  size_t struct_size; /**< Set by the default function. Do not write. */
  const char *title;  /**< Default: NULL, the title "Mechanism". */
  /** (count) [s] times of the samples, monotone. Default: NULL, must be set. */
  const double *times;
  /** [-] > 0, number of samples. A page keeps at most 600 samples, always including those at which
   *  a plotted column has its largest or its smallest value. Default: 0, must be set. */
  int64_t count;
  /** (channel_count) the channels that each row of `rows` contains. BAUM_Q must be one of them.
   *  Reactions (BAUM_JOINT_REACTION) are shown as arrows. Default: NULL, must be set. */
  const baum_channel *channels;
  int32_t channel_count; /**< [-] > 0, number of channels. Default: 0, must be set. */
  /** (count x width) the samples, where width is baum_channels_width() of the channels.
   *  Default: NULL, must be set. */
  const double *rows;
  /** (count x plot_count) columns to plot over time. This pointer may point into `rows`; for
   *  example, `rows` + 9 plots the columns from index 9 on if plot_stride is the width of `rows`.
   *  Default: NULL, none. */
  const double *plots;
  int32_t plot_count; /**< [-] >= 0, number of columns in `plots`. Default: 0. */
  /** [-] number of doubles from the start of one row of `plots` to the start of the next row.
   *  Default: 0, which means plot_count. */
  int32_t plot_stride;
  /** (plot_count) labels of the columns, such as "slider velocity [m/s]". Consecutive columns with
   *  the same unit are drawn in the same plot. Default: NULL, must be set if plot_count > 0. */
  const char *const *plot_labels;
  /** (trace_count) the points whose paths are drawn; each is given as a channel with the quantity
   *  BAUM_BODY_POSE. Default: NULL, none. */
  const baum_channel *traces;
  int32_t trace_count; /**< [-] >= 0, number of traces. Default: 0. */
  /** (mark_count) [s] times of the marks, which stand for warnings, near-singular intervals and
   *  events. Default: NULL. */
  const double *mark_times;
  const char *const *mark_texts; /**< (mark_count) labels of the marks. Default: NULL. */
  /** (mark_count) kinds of the marks, as values of baum_mark_kind. Default: NULL, which means that
   *  all marks are BAUM_MARK_WARNING. */
  const int32_t *mark_kinds;
  int32_t mark_count; /**< [-] >= 0, number of marks. Default: 0. */
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

/** Write a page into a file. The page is a single HTML file, which loads no other file.
 *  @param     mechanism  frozen
 *  @param[in] page       what the page shows
 *  @param[in] path       path of the file
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE (not frozen),
 *           BAUM_ERR_FILE, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_page_write(const baum_mechanism *mechanism, const baum_page *page,
                                     const char *path);

/** Write a page into memory.
 *  @param      mechanism  frozen
 *  @param[in]  page       what the page shows
 *  @param[out] text       (capacity) the page, zero-terminated, truncated if too long. May be
 *                         NULL if capacity is 0.
 *  @param      capacity   [byte]
 *  @param[out] size       [byte] length of the whole page without the final zero. May be NULL.
 *  @return  as baum_page_write() without BAUM_ERR_FILE */
BAUM_API baum_status baum_page_print(const baum_mechanism *mechanism, const baum_page *page,
                                     char *text, size_t capacity, size_t *size);

/** Draw one sample of a page as an SVG picture. The picture contains the paths of the points in
 *  `traces` up to this sample, and reactions as arrows. It does not contain the plots, the marks
 *  and the title of the page. Its frame is large enough for the whole motion, so that pictures of
 *  several samples have the same scale.
 *  @param      mechanism  frozen
 *  @param[in]  page       what the page shows
 *  @param      sample     [-] >= 0, < count of the page
 *  @param[out] text       (capacity) the picture, zero-terminated, truncated if too long. May be
 *                         NULL if capacity is 0.
 *  @param      capacity   [byte]
 *  @param[out] size       [byte] length of the whole picture without the final zero. May be NULL.
 *  @return  as baum_page_print(), and BAUM_ERR_NOT_FINITE for positions that are not finite */
BAUM_API baum_status baum_page_svg(const baum_mechanism *mechanism, const baum_page *page,
                                   int64_t sample, char *text, size_t capacity, size_t *size);

#ifdef __cplusplus
}
#endif

#endif
