/* SPDX-License-Identifier: BSD-3-Clause */
/* The true motion of a judge_scene, and how it amplifies perturbations. Extrapolation of the
 * modified midpoint rule (Gragg 1965, Bulirsch and Stoer 1966) over the accelerations of
 * judge_equations, with a projection after each step. */
#ifndef BAUM_JUDGE_REFERENCE_H
#define BAUM_JUDGE_REFERENCE_H

#include "judge_equations.h"

enum { JUDGE_SEGMENTS = 20 };

typedef struct judge_state {
  double q[JUDGE_N];
  double v[JUDGE_N];
} judge_state;

typedef struct judge_reference {
  double t[JUDGE_SEGMENTS + 1];
  judge_state at[JUDGE_SEGMENTS + 1];
  double agreement;   /* of two runs: orders 14 and 12, tolerances 1e-12 and 1e-10 */
  double rate;        /* [1/s] mean speed over the samples, of coordinates by 1 m and 1 rad */
  double kinetic;     /* [J] largest over the samples */
  double growth;      /* from any sample to any later one */
  double growth_end;  /* from any sample to the end */
  double growth_q;    /* from any sample to the positions of any later one */
  const char *failed; /* why there is none; NULL when there is one */
} judge_reference;

/** From (q, v), which fulfil the constraints to rounding, at t = 0 to the end of the scene.
 *  `length` is what errors of positions are relative to. True when both runs agree to 1e-6. */
bool judge_find_reference(const judge_scene *s, const double *q, const double *v, double length,
                          judge_reference *out);

/** Whether a column is an angle. */
bool judge_is_angle(const judge_scene *s, int column);

#endif
