/* SPDX-License-Identifier: BSD-3-Clause */
/* Scenes of bench_sweeps, each with its motion in reduced coordinates, integrated without the
 * library.
 *
 * Errors are position errors: lengths relative to the characteristic length of the scene, angles in
 * radians.
 */
#ifndef BAUM_BENCH_SWEEP_SCENES_H
#define BAUM_BENCH_SWEEP_SCENES_H

#include "models.h"

enum { SWEEP_SAMPLES = 10, SWEEP_NQ = 12 };

typedef struct sweep_scene {
  const char *name;
  double parameter; /* [-] distance from the change point, or mass ratio, or 0 */
  double gravity;   /* [m/s^2] */
  model m;
  int nq;
  double unit[SWEEP_NQ]; /* unit of an error in q: [m] or 1 rad */
  double span;           /* [rad/s] initial, of the crank; steps are relative to 1 / rate */
  double rate;           /* [rad/s] initial angular velocity of the crank; steps are relative to 1 /
                          * rate */
  double energy;         /* [J] initial kinetic energy */
  double growth;         /* [-] largest growth of a perturbation; NaN: not computed */
  double times[SWEEP_SAMPLES];
  double want[SWEEP_SAMPLES][SWEEP_NQ];
} sweep_scene;

/* Linkages within 1 % of a change point: shortest + longest = sum of the other two lengths. */
enum { SWEEP_FOUR_BARS = 10 };
sweep_scene sweep_four_bar(int k, bool gravity, double turns);

/* A light rod that slides with one end in a slot, carries a bob at the other, and comes taut. */
sweep_scene sweep_taut(double mass_ratio, bool growth);

/* Motions through singular configurations. */
enum { SWEEP_SINGULAR = 3 };
sweep_scene sweep_singular(int k);

void sweep_close(sweep_scene *scene);

#endif
