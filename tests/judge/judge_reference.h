/* SPDX-License-Identifier: BSD-3-Clause */
/* The reference motion of a judge_scene, and how it amplifies perturbations. The method is
 * extrapolation of the modified midpoint rule (Gragg 1965, Bulirsch and Stoer 1966) with the
 * accelerations of judge_equations, and a projection after each step. */
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
  double agreement;   /* largest difference of two runs, of orders 14 and 12, at 1e-12 and 1e-10 */
  double rate;        /* [1/s] mean over the samples of |v|, with v in m/s and rad/s */
  double kinetic;     /* [J] largest kinetic energy of the samples */
  double growth;      /* largest factor of perturbations between any two samples */
  double growth_end;  /* from any sample to the last */
  double growth_q;    /* as growth, but only positions count at the later sample */
  const char *failed; /* why there is no reference, or NULL */
} judge_reference;

/** Integrates twice from (q, v) at t = 0 to the end of the scene. (q, v) must fulfil the
 *  constraints to rounding. Errors of positions are relative to `length`. Returns true if both runs
 *  agree to 1e-6. */
bool judge_find_reference(const judge_scene *s, const double *q, const double *v, double length,
                          judge_reference *out);

/** Returns whether a column is an angle. */
bool judge_is_angle(const judge_scene *s, int column);

#endif
