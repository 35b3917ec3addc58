/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares runs of the library with the reference of judge_reference.h. */
#ifndef BAUM_JUDGE_RUNS_H
#define BAUM_JUDGE_RUNS_H

#include <baum/baum.h>

#include "judge_reference.h"

typedef struct judge_setting {
  const char *name;
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  double step; /* [s] fixed step; 0 if rtol determines the steps */
  double rtol; /* [-] 0 for a fixed step */
} judge_setting;

typedef enum judge_class {
  JUDGE_UNUSED, /* the library does not support the setting, or the setting has not been run */
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
  double error;     /* [-] largest position error at the samples, relative to a length or 1 rad */
  double error_end; /* [-] the same at the last sample */
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
  const char *failed; /* why there is no reference, or NULL if there is one */
} judge_case;

/** Generates the scene of a seed, and finds its reference. The caller must call judge_close(), even
 * after a failure. */
bool judge_open(judge_case *c, uint64_t seed);
void judge_close(judge_case *c);

/** Makes a run with a setting, and compares its positions with those of the reference. */
void judge_run(const judge_case *c, const judge_setting *setting, bool error_check,
               judge_outcome *out);

#endif
