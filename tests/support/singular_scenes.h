/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms whose motion leads through singular configurations and is known: on its branch each is
 * one turning angle th with
 *
 *   (i0 + i1 sin^2 th) th'' + i1 sin th cos th th'^2 + k cos th = 0
 *
 * and settings to run them with.
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
  SINGULAR_SLIDER_CRANK,       /* rod and crank of one length */
  SINGULAR_NEAR_PARALLELOGRAM, /* coupler longer by 1e-4: close to singular only; no angle is known
                                  */
  SINGULAR_KINDS
} singular_kind;

typedef struct singular_scene {
  model m;
  double end;  /* [s] */
  double unit; /* [s] time in which it turns by about five radians, of which steps and gains are
                  told */
  double want[SINGULAR_SAMPLES + 1]; /* [rad] th at k end / SINGULAR_SAMPLES */
  int count;                         /* of angles in q that follow th */
  int angle[SINGULAR_ANGLES];        /* where they are */
  double sign[SINGULAR_ANGLES];
  double *reference; /* ((SINGULAR_SAMPLES + 1) x nq) where no angle is known, else NULL */
} singular_scene;

/* loops: N of the N-four-bar. seed: of the start, which differs by up to 0.1 rad. */
singular_scene singular_open(singular_kind kind, int loops, uint64_t *seed);
void singular_close(singular_scene *scene);

/* One setting to run it with. */
typedef struct singular_setting {
  const char *name;
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  double step; /* [unit]; 0: rtol */
  double rtol;
  double alpha; /* [1/unit] of BAUMGARTE, beta likewise */
} singular_setting;

typedef struct singular_result {
  baum_status status; /* < 0: failed */
  double error;       /* [rad or m] largest at a sample, until it failed */
  int64_t intervals;
  int64_t branch_warnings;
  int64_t warnings;
  int64_t doubts;
  int64_t forced;
} singular_result;

singular_result singular_run(const singular_scene *scene, const singular_setting *setting);

/* All that the issue of singular positions is about; ends with a NULL name. */
extern const singular_setting SINGULAR_SETTINGS[];

#endif
