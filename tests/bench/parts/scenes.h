/* SPDX-License-Identifier: BSD-3-Clause */
/* Scenes for timing: mechanisms of tests/models in a given state. */
#ifndef BAUM_BENCH_SCENES_H
#define BAUM_BENCH_SCENES_H

#include "dynamics/dynamics.h"
#include "models.h"

typedef enum scene_kind {
  SCENE_SLIDER_CRANK, /* driven: 9 rows */
  SCENE_ANDREWS,
  SCENE_FOUR_BAR,
  SCENE_CHAIN,
  SCENE_ONE_GUIDE,      /* undriven slider-crank: 8 rows */
  SCENE_TWO_GUIDES,     /* a second guide: two redundant rows */
  SCENE_THIRD_BY_A_ROD, /* three parallel cranks without a redundant row */
  SCENE_THREE_CRANKS,   /* three parallel cranks with one redundant row */
  SCENE_TWO_CRANKS,
  SCENE_SPATIAL_SLIDER_CRANK, /* this and all below: spatial.h */
  SCENE_RSSR,
  SCENE_BRICARD,
  SCENE_SLENDER_BRICARD,
  SCENE_STEWART,
  SCENE_QUADRUPED,
  SCENE_FLYBALL,
  SCENE_SPHERICAL_CHAIN,
  SCENE_REVOLUTE_CHAIN
} scene_kind;

typedef struct scene {
  scene_kind kind;
  int n; /* number of loops or links, else 1 */
  model m;
  int bodies;
  baum_workspace *workspace;
  double *q; /* (nq) */
  double *v; /* (nv) */
} scene;

const char *scene_name(scene_kind kind);
bool scene_is_spatial(scene_kind kind);

/* Returns false with the reason in baum_message(). */
bool scene_make(scene_kind kind, int n, scene *out);
void scene_clear(scene *out);

#endif
