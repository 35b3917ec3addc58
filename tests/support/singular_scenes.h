/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms whose motion is known and passes through singular configurations, and settings with
 * which they are run. As long as the motion does not change to another branch, it is described by
 * one angle th. This angle satisfies an equation with the constants i0, i1 and k:
 *
 *   (i0 + i1 sin^2 th) th'' + i1 sin th cos th th'^2 + k cos th = 0
 */
#ifndef BAUM_TEST_SINGULAR_SCENES_H
#define BAUM_TEST_SINGULAR_SCENES_H

#include <stdint.h>

#include "models.h"

enum { SINGULAR_SAMPLES = 50, SINGULAR_ANGLES = 41 };

typedef enum singular_kind {
  SINGULAR_N_FOUR_BAR,
  SINGULAR_PARALLELOGRAM,
  SINGULAR_THREE_CRANKS,
  SINGULAR_SLIDER_CRANK, /* rod and crank have the same length */
  /* A parallelogram whose coupler is 1e-4 m too long, so that it becomes only nearly singular. */
  SINGULAR_NEAR_PARALLELOGRAM,
  SINGULAR_KINDS
} singular_kind;

typedef struct singular_scene {
  model m;
  double end; /* [s] */
  /* [s] unit of steps and gains; in this time th changes by about 5 rad. */
  double unit;
  double want[SINGULAR_SAMPLES + 1]; /* [rad] th at the times k end / SINGULAR_SAMPLES */
  int count;                         /* how many angles in q are th or -th */
  int angle[SINGULAR_ANGLES];        /* the indices of these angles */
  double sign[SINGULAR_ANGLES];
  /* Positions at the times of `want` ((SINGULAR_SAMPLES + 1) x nq), if there is no equation for th.
   * Otherwise NULL. */
  double *reference;
} singular_scene;

/* `loops` is the number N of the N-four-bar. `seed` determines a random change of the initial angle
 * by up to 0.1 rad. For the N-four-bar, it also determines a change of the initial angular velocity
 * by up to 0.1 rad/s. */
singular_scene singular_open(singular_kind kind, int loops, uint64_t *seed);
void singular_close(singular_scene *scene);

/* Settings of a run. */
typedef struct singular_setting {
  const char *name;
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  double step; /* [unit] fixed step, or 0 for a variable step with rtol */
  double rtol;
  double alpha; /* [1/unit] alpha = beta of Baumgarte's formulation */
} singular_setting;

typedef struct singular_result {
  baum_status status; /* < 0: failed */
  /* [rad or m] largest error at those times k end / SINGULAR_SAMPLES that the run has reached. */
  double error;
  int64_t intervals;
  int64_t branch_warnings;
  int64_t warnings;
  int64_t doubts;
  int64_t forced;
} singular_result;

singular_result singular_run(const singular_scene *scene, const singular_setting *setting);

/* The settings that are tested. The name of the last one is NULL. */
extern const singular_setting SINGULAR_SETTINGS[];

#endif
