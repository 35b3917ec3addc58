/* SPDX-License-Identifier: BSD-3-Clause */
/* Points in state space, and the frames of bodies at these points. */
#include <math.h>

#include "base/alloc.h"
#include "base/hot.h"
#include "base/message.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/planar/frames.h"

/* ---- frames ---- */

baum_i_frame_kind baum_i_frame_of(const baum_i_body *body)
{
  return body->type ? body->type->frame : BAUM_I_FRAME_GROUND;
}

baum_i_frame baum_i_frame_at(baum_i_frame_kind kind, const double *q)
{
  baum_i_frame frame = {.c = 1.0};
  if (kind != BAUM_I_FRAME_PARTICLE && kind != BAUM_I_FRAME_BODY) {
    return frame;
  }
  frame.x = q[0];
  frame.y = q[1];
  if (kind == BAUM_I_FRAME_BODY) {
    frame.angle = q[2];
    frame.c = cos(q[2]);
    frame.s = sin(q[2]);
  }
  return frame;
}

baum_i_frame baum_i_design_frame(const baum_mechanism *mechanism, int body)
{
  const baum_i_body *designed = mechanism->bodies[body];
  baum_i_frame_kind kind = baum_i_frame_of(designed);
  double q[3] = {0.0};
  if (kind == BAUM_I_FRAME_PARTICLE || kind == BAUM_I_FRAME_BODY) {
    double v[3];
    bool held;
    designed->type->design(designed->element.def, q, v, &held);
  }
  return baum_i_frame_at(kind, q);
}

/* ---- points ---- */

/* Allocate the memory that only mechanisms with spatial elements need. */
static baum_status create_spatial(const baum_mechanism *mechanism, baum_i_point *point)
{
  if (!mechanism->spatial) {
    return BAUM_OK;
  }
  point->spatial = baum_i_alloc_lines((size_t)mechanism->body_count + 1, sizeof *point->spatial);
  point->own_angles =
    baum_i_alloc((size_t)baum_i_angles_size(mechanism), sizeof *point->own_angles);
  point->angles = point->own_angles;
  if (!point->spatial || !point->angles) {
    return baum_i_fail_memory();
  }
  point->spatial[0] = baum_i_spatial_frame_at(BAUM_I_FRAME_GROUND, NULL, NULL);
  return BAUM_OK;
}

baum_status baum_i_point_create(const baum_mechanism *mechanism, baum_i_point *point)
{
  *point = (baum_i_point){.mechanism = mechanism,
                          .parameters = mechanism->parameters,
                          .inputs = baum_i_initial_inputs(mechanism),
                          .kernel = BAUM_I_HOT_TABLE(mechanism->wide, baum_i_frames_kernel)};
  point->frames = baum_i_alloc((size_t)mechanism->body_count + 1, sizeof *point->frames);
  point->scratch = baum_i_alloc((size_t)mechanism->scratch_size, sizeof *point->scratch);
  point->normalized =
    mechanism->flat ? NULL : baum_i_alloc((size_t)mechanism->nq, sizeof *point->normalized);
  if (!point->frames || !point->scratch || (!mechanism->flat && !point->normalized)) {
    return baum_i_fail_memory();
  }
  for (int i = 0; i <= mechanism->body_count; i++) {
    point->frames[i].c = 1.0;
  }
  return create_spatial(mechanism, point);
}

void baum_i_point_release(baum_i_point *point)
{
  baum_i_free(point->frames);
  baum_i_free(point->scratch);
  baum_i_free(point->normalized);
  baum_i_free_lines(point->spatial);
  baum_i_free(point->own_angles);
}

void baum_i_point_set_vector(baum_i_point *point, double t, const double *q, const double *v)
{
  point->t = t;
  point->q = q;
  point->v = v;
  point->retry = false;
  point->kernel->set(point->mechanism, q, v, point->frames);
  if (point->spatial) {
    baum_i_point_set_spatial(point);
  }
}
