/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs of baum against the reference of judge_reference. */
#ifndef BAUM_JUDGE_RUNS_H
#define BAUM_JUDGE_RUNS_H

#include <baum/baum.h>

#include "judge_reference.h"

typedef struct judge_setting {
  const char *name;
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  double step; /* [s] 0: chosen by rtol */
  double rtol; /* [-] 0: by the step */
} judge_setting;

typedef enum judge_class {
  JUDGE_UNUSED, /* refused, or not asked for */
  JUDGE_STOPPED,
  JUDGE_RIGHT,
  JUDGE_GREY,
  JUDGE_WRONG,
  JUDGE_CLASSES
} judge_class;

enum { JUDGE_CODES = 8, JUDGE_SAMPLES = JUDGE_SEGMENTS / 2 };

typedef struct judge_outcome {
  judge_class class;
  baum_status status;
  double error;     /* [-] largest of positions over the samples, by the length and by radians */
  double error_end; /* [-] of the last one */
  bool doubted;
  int codes[JUDGE_CODES];
  int code_count;
  baum_counters counters;
} judge_outcome;

typedef struct judge_case {
  judge_scene scene;
  judge_reference reference;
  baum_mechanism *m;
  double length;
  const char *failed; /* NULL: there is a reference */
} judge_case;

/** Draw a scene and find its reference. The case is released with judge_close() in any case. */
bool judge_open(judge_case *c, uint64_t seed);
void judge_close(judge_case *c);

/** Run a setting over the samples of the reference. */
void judge_run(const judge_case *c, const judge_setting *setting, bool error_check,
               judge_outcome *out);

#endif
