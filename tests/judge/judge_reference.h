/* SPDX-License-Identifier: BSD-3-Clause */
/* The reference motion of a judge_scene, and the growth of perturbations along it. The integrator
 * extrapolates the modified midpoint rule (Gragg 1965, Bulirsch and Stoer 1966). It uses the
 * accelerations of judge_equations, and projects after each step. */
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
  /* Largest difference of positions between the two runs for the reference. Their orders are 14 and
   * 12, and their tolerances are 1e-12 and 1e-10. */
  double agreement;
  /* Mean over the samples of the root mean square of v [m/s, rad/s], but at least 0.1. */
  double rate;
  double kinetic;     /* [J] largest kinetic energy at a sample */
  double growth;      /* largest factor by which perturbations grow between any two samples */
  double growth_end;  /* the same between any sample and the last sample */
  double growth_q;    /* like growth, but counts only positions at the later sample */
  const char *failed; /* why there is no reference, or NULL if there is one */
} judge_reference;

/** Integrates twice from (q, v) at t = 0 to the end of the scene. The start (q, v) must satisfy the
 * constraints up to rounding errors. Differences of lengths are divided by `length`. Returns true
 * if both runs agree to 1e-6 and the growth of perturbations is known. */
bool judge_find_reference(const judge_scene *s, const double *q, const double *v, double length,
                          judge_reference *out);

/** Returns whether a column of q is an angle. */
bool judge_is_angle(const judge_scene *s, int column);

#endif
