/* SPDX-License-Identifier: BSD-3-Clause */
/* The public functions that draw SVG pictures. */
#include <string.h>

#include <baum/draw.h>

#include "base/alloc.h"
#include "base/file.h"
#include "draw/drawing.h"
#include "draw/picture.h"
#include "dynamics/snapshot.h"
#include "mechanism/identify.h"

static baum_status check(const baum_mechanism *mechanism, const double *q, const char *call)
{
  if (!mechanism) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: mechanism is NULL", call);
  }
  if (!q) {
    return BAUM_OK;
  }
  BAUM_I_TRY(baum_i_check_frozen(mechanism, call));
  for (int k = 0; k < mechanism->nq; k++) {
    if (!isfinite(q[k])) {
      return baum_i_fail(BAUM_ERR_NOT_FINITE, "%s: q[%d] is %g, must be finite", call, k, q[k]);
    }
  }
  return BAUM_OK;
}

static baum_status draw_at(const baum_i_drawing *drawing, const double *q, baum_i_buffer *out)
{
  const baum_mechanism *m = drawing->mechanism;
  baum_i_spatial_frame *frames = NULL;
  if (q) {
    frames = baum_i_alloc((size_t)m->body_count + 1, sizeof *frames);
    if (!frames) {
      return baum_i_fail_memory();
    }
    for (int k = 0; k <= m->body_count; k++) {
      frames[k] = baum_i_drawing_frame(m->bodies[k], q);
    }
  }
  baum_status status = baum_i_put_picture(drawing, q ? frames : drawing->design, out);
  baum_i_free(frames);
  return status;
}

baum_status baum_i_put_svg(const baum_mechanism *mechanism, const double *q, const char *call,
                           baum_i_buffer *out)
{
  BAUM_I_TRY(check(mechanism, q, call));
  baum_i_drawing drawing;
  baum_status status = baum_i_drawing_create(mechanism, &(baum_i_samples){NULL, 0, 0}, &drawing);
  if (status == BAUM_OK) {
    status = draw_at(&drawing, q, out);
  }
  baum_i_drawing_release(&drawing);
  return status;
}

/* ---- the assembled configuration ---- */

typedef struct assembled {
  size_t struct_size;
  baum_i_buffer *out;
} assembled;

/* Draws the assembled configuration. If the constraints are inconsistent, draws the configuration
 * at which assembly stopped. */
static baum_status draw_assembled(baum_workspace *w, double *q, void *whole)
{
  const baum_mechanism *m = w->mechanism;
  assembled *drawn = whole;
  memcpy(q, m->design_q, (size_t)m->nq * sizeof *q);
  baum_status status = baum_i_assemble_closest(w, 0.0, q, m->held);
  return status == BAUM_OK || status == BAUM_ERR_INCONSISTENT
           ? baum_i_put_svg(m, q, "baum_mechanism_svg_assembled", drawn->out)
           : status;
}

baum_status baum_mechanism_svg_assembled(const baum_mechanism *mechanism, char *text,
                                         size_t capacity, size_t *size)
{
  const char *call = "baum_mechanism_svg_assembled";
  baum_i_buffer out = {0};
  assembled drawn = {sizeof drawn, &out}, ignored = {0};
  const baum_i_snapshot_out to = {call, &ignored, sizeof ignored, &drawn, sizeof drawn};
  baum_status status = baum_i_snapshot(mechanism, draw_assembled, &to);
  if (status == BAUM_OK) {
    status = baum_i_give_text(&out, call, text, capacity, size);
  }
  baum_i_buffer_clear(&out);
  return status;
}

/* ---- a given configuration ---- */

baum_status baum_mechanism_svg(const baum_mechanism *mechanism, const double *q, char *text,
                               size_t capacity, size_t *size)
{
  baum_i_buffer out = {0};
  baum_status status = baum_i_put_svg(mechanism, q, "baum_mechanism_svg", &out);
  if (status == BAUM_OK) {
    status = baum_i_give_text(&out, "baum_mechanism_svg", text, capacity, size);
  }
  baum_i_buffer_clear(&out);
  return status;
}

baum_status baum_mechanism_write_svg(const baum_mechanism *mechanism, const double *q,
                                     const char *path)
{
  baum_i_buffer out = {0};
  baum_status status = baum_i_put_svg(mechanism, q, "baum_mechanism_write_svg", &out);
  if (status == BAUM_OK) {
    status = baum_i_give_file(&out, "baum_mechanism_write_svg", path);
  }
  baum_i_buffer_clear(&out);
  return status;
}
