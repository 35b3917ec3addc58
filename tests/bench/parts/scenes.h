/* SPDX-License-Identifier: BSD-3-Clause */
/* Scenes for timing: mechanisms of tests/models in a given state. */
#ifndef BAUM_BENCH_SCENES_H
#define BAUM_BENCH_SCENES_H

#include "dynamics/dynamics.h"
#include "models.h"
#include "spatial.h"

typedef enum scene_kind {
  SCENE_SLIDER_CRANK, /* with a driver; it has 9 rows */
  SCENE_ANDREWS,
  SCENE_FOUR_BAR,
  SCENE_CHAIN,
  SCENE_ONE_GUIDE,      /* slider-crank without a driver; it has 8 rows */
  SCENE_TWO_GUIDES,     /* the same with a second guide, which adds two redundant rows */
  SCENE_THIRD_BY_A_ROD, /* three parallel cranks without a redundant row */
  SCENE_THREE_CRANKS,   /* three parallel cranks with one redundant row */
  SCENE_TWO_CRANKS,
  /* the kind of a spatial scene is SCENE_SPATIAL + k, where k is a value of model_spatial */
  SCENE_SPATIAL
} scene_kind;

typedef struct scene {
  scene_kind kind;
  int n; /* number of loops or links, or 1 if the scene has neither */
  model m;
  int bodies;
  baum_workspace *workspace;
  double *q; /* (nq) */
  double *v; /* (nv) */
} scene;

const char *scene_name(scene_kind kind);

static inline scene_kind scene_of_space(model_spatial which)
{
  return (scene_kind)(SCENE_SPATIAL + (int)which);
}

/* Makes a scene. If this fails, returns false, and baum_message() gives the reason. */
bool scene_make(scene_kind kind, int n, scene *out);
void scene_clear(scene *out);

#endif
