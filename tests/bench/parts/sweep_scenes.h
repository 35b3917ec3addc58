/* SPDX-License-Identifier: BSD-3-Clause */
/* The scenes of bench_sweeps. For each, the motion is integrated in reduced coordinates, without
 * the library.
 *
 * Errors are position errors. Lengths are relative to the characteristic length of the scene, and
 * angles are in radians.
 */
#ifndef BAUM_BENCH_SWEEP_SCENES_H
#define BAUM_BENCH_SWEEP_SCENES_H

#include "models.h"

enum { SWEEP_SAMPLES = 10, SWEEP_NQ = 12 };

typedef struct sweep_scene {
  const char *name;
  double parameter; /* [-] relative distance from a change point, or mass ratio, or 0 */
  double gravity;   /* [m/s^2] */
  model m;
  int nq;
  double unit[SWEEP_NQ]; /* an error in q is divided by this: a length [m], or 1 rad */
  double span;           /* [s] duration of the motion */
  double rate;           /* [rad/s] initial angular velocity of the crank */
  double energy;         /* [J] initial kinetic energy */
  double growth;         /* [-] largest growth of a perturbation; NaN if not computed */
  double times[SWEEP_SAMPLES];
  double want[SWEEP_SAMPLES][SWEEP_NQ];
} sweep_scene;

/* Linkages close to a change point. The sum of the shortest and the longest length differs by at
 * most 1 % from the sum of the other two. */
enum { SWEEP_FOUR_BARS = 10 };
sweep_scene sweep_four_bar(int k, bool gravity, double turns);

/* A light rod. One of its ends slides in a slot, and the other end carries a bob. During the motion
 * the rod comes taut. */
sweep_scene sweep_taut(double mass_ratio, bool growth);

/* Motions that pass through singular configurations. */
enum { SWEEP_SINGULAR = 3 };
sweep_scene sweep_singular(int k);

void sweep_close(sweep_scene *scene);

#endif
