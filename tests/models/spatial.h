/* SPDX-License-Identifier: BSD-3-Clause */
/* Spatial mechanisms for tests of accuracy and for timing. Some are mechanisms of the catalogue
 * that are set in motion. Others are larger. */
#ifndef BAUM_TEST_MODELS_SPATIAL_H
#define BAUM_TEST_MODELS_SPATIAL_H

#include "models.h"

typedef enum model_spatial {
  MODEL_SPATIAL_SLIDER_CRANK, /* 3 bodies, 17 rows: revolute, spherical, universal, prismatic */
  MODEL_RSSR,                 /* 3 bodies, 16 rows: revolute, spherical, spherical, revolute */
  MODEL_BRICARD,              /* 5 bodies, 30 rows of revolute joints, one redundant */
  MODEL_SLENDER_BRICARD,      /* the same with rods that have no inertia about their own axes */
  MODEL_STEWART,              /* 13 bodies, 72 rows: a platform on six legs of two bodies each */
  MODEL_QUADRUPED,            /* 14 bodies, 65 rows: a free trunk with four legs and a neck */
  MODEL_FLYBALL,              /* 4 bodies, 20 rows, with springs and dampers */
  MODEL_SPHERICAL_CHAIN,      /* links of 1 m and 1 kg on spherical joints: 3 rows a link */
  MODEL_REVOLUTE_CHAIN,       /* the same links on revolute joints with skew axes: 5 rows a link */
  MODEL_SPATIAL_COUNT
} model_spatial;

/* Makes a mechanism under gravity along -z (Bricard: -y). `links` is the number of links of a
 * chain. Other mechanisms ignore it. All velocities are given, except those of the coupler and the
 * rocker of MODEL_RSSR. */
baum_status model_spatial_build(model_spatial which, int links, model *out);

const char *model_spatial_name(model_spatial which);

#endif
