/* SPDX-License-Identifier: BSD-3-Clause */
#include "scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_spatial(scene_kind kind)
{
  return kind >= SCENE_SPATIAL;
}

static model_spatial model_of(scene_kind kind)
{
  return (model_spatial)((int)kind - SCENE_SPATIAL);
}

const char *scene_name(scene_kind kind)
{
  static const char *const names[] = {
    [SCENE_SLIDER_CRANK] = "slider_crank",
    [SCENE_ANDREWS] = "andrews",
    [SCENE_FOUR_BAR] = "four_bar",
    [SCENE_CHAIN] = "chain",
    [SCENE_ONE_GUIDE] = "slider_crank_one_guide",
    [SCENE_TWO_GUIDES] = "slider_crank_two_guides",
    [SCENE_THIRD_BY_A_ROD] = "three_cranks_by_a_rod",
    [SCENE_THREE_CRANKS] = "three_cranks",
    [SCENE_TWO_CRANKS] = "two_cranks",
  };
  return is_spatial(kind) ? model_spatial_name(model_of(kind)) : names[kind];
}

/* Builds a chain whose links are inclined to both sides, by irregular angles. */
static baum_status build_chain(int links, model *out)
{
  double *angle = calloc(2 * (size_t)links, sizeof *angle);
  if (!angle) {
    return BAUM_ERR_MEMORY;
  }
  double *rate = angle + links;
  for (int k = 0; k < links; k++) {
    double x = 0.6180339887498949 * (k + 1.0);
    angle[k] = 2.0 * (x - floor(x)) - 2.5;
    rate[k] = sin(x);
  }
  model_chain data = {.links = links, .angle = angle, .rate = rate};
  baum_status status = model_chain_build(&data, out);
  free(angle);
  return status;
}

static baum_status build_planar(scene_kind kind, int n, model *out)
{
  model_slider_crank crank = {.driven = kind == SCENE_SLIDER_CRANK,
                              .doubled_guide = kind == SCENE_TWO_GUIDES,
                              .angle = 1.0,
                              .moving = true};
  model_n_four_bar bars = model_n_four_bar_a02(n);
  bars.angle = 1.0;
  switch ((int)kind) {
  case SCENE_SLIDER_CRANK:
  case SCENE_ONE_GUIDE:
  case SCENE_TWO_GUIDES: return model_slider_crank_build(crank, out);
  case SCENE_ANDREWS: return model_andrews_bodies(out);
  case SCENE_FOUR_BAR: return model_n_four_bar_build(&bars, out);
  case SCENE_CHAIN: return build_chain(n, out);
  case SCENE_THIRD_BY_A_ROD: return model_parallelogram_build(MODEL_THIRD_BY_A_ROD, 1.0, out);
  case SCENE_THREE_CRANKS: return model_parallelogram_build(MODEL_THREE_CRANKS, 1.0, out);
  case SCENE_TWO_CRANKS: return model_parallelogram_build(MODEL_TWO_CRANKS, 1.0, out);
  default: return BAUM_ERR_ARGUMENT;
  }
}

bool scene_make(scene_kind kind, int n, scene *out)
{
  memset(out, 0, sizeof *out);
  out->kind = kind;
  out->n = n;
  baum_status status = is_spatial(kind) ? model_spatial_build(model_of(kind), n, &out->m)
                                        : build_planar(kind, n, &out->m);
  if (status != BAUM_OK || baum_workspace_create(out->m.mechanism, &out->workspace) != BAUM_OK) {
    scene_clear(out);
    return false;
  }
  size_t nq = (size_t)out->workspace->mechanism->nq;
  size_t nv = (size_t)out->workspace->mechanism->nv;
  out->bodies = out->m.body_count;
  out->q = calloc(nq + nv, sizeof *out->q);
  if (!out->q) {
    scene_clear(out);
    return false;
  }
  out->v = out->q + nq;
  return baum_workspace_design(out->workspace, out->q, out->v) == BAUM_OK &&
         /* the velocities of the RSSR are not given, so assembly computes them */
         (!is_spatial(kind) ||
          baum_workspace_assemble(out->workspace, 0.0, out->q, out->v, NULL, 0) == BAUM_OK);
}

void scene_clear(scene *out)
{
  baum_workspace_destroy(out->workspace);
  free(out->q);
  model_destroy(&out->m);
  memset(out, 0, sizeof *out);
}
