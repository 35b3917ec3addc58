/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms whose motion passes through singular configurations and is known, and settings to run
 * them with. On the right branch, one angle th describes the motion:
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
  SINGULAR_SLIDER_CRANK,       /* rod and crank of the same length */
  SINGULAR_NEAR_PARALLELOGRAM, /* coupler longer by 1e-4 m: only nearly singular */
  SINGULAR_KINDS
} singular_kind;

typedef struct singular_scene {
  model m;
  double end;                        /* [s] */
  double unit;                       /* [s] for steps and gains; th changes by about 5 rad in it */
  double want[SINGULAR_SAMPLES + 1]; /* [rad] th at k end / SINGULAR_SAMPLES */
  int count;                         /* number of angles in q that are th or -th */
  int angle[SINGULAR_ANGLES];        /* their indices */
  double sign[SINGULAR_ANGLES];
  double *reference; /* ((SINGULAR_SAMPLES + 1) x nq) if there is no equation for th, else NULL */
} singular_scene;

/* `loops` is N of the N-four-bar. `seed` is for the random start, up to 0.1 rad from the usual
 * one. */
singular_scene singular_open(singular_kind kind, int loops, uint64_t *seed);
void singular_close(singular_scene *scene);

/* Settings of a run. */
typedef struct singular_setting {
  const char *name;
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  double step; /* [unit]; 0: variable step with rtol */
  double rtol;
  double alpha; /* [1/unit] alpha = beta of BAUMGARTE */
} singular_setting;

typedef struct singular_result {
  baum_status status; /* < 0: failed */
  double error;       /* [rad or m] largest error at a sample, up to a failure */
  int64_t intervals;
  int64_t branch_warnings;
  int64_t warnings;
  int64_t doubts;
  int64_t forced;
} singular_result;

singular_result singular_run(const singular_scene *scene, const singular_setting *setting);

/* All settings to test. The last one has a NULL name. */
extern const singular_setting SINGULAR_SETTINGS[];

#endif
