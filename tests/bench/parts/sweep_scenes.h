/* SPDX-License-Identifier: BSD-3-Clause */
/* Scenes of bench_sweeps, each with its motion in reduced coordinates, which owes nothing to the
 * library.
 *
 * Errors are of positions: lengths by the characteristic length of the scene, angles in radians.
 */
#ifndef BAUM_BENCH_SWEEP_SCENES_H
#define BAUM_BENCH_SWEEP_SCENES_H

#include "models.h"

enum { SWEEP_SAMPLES = 10, SWEEP_NQ = 12 };

typedef struct sweep_scene {
  const char *name;
  double parameter; /* [-] distance from the change point, mass ratio; 0 for others */
  double gravity;   /* [m/s^2] */
  model m;
  int nq;
  double unit[SWEEP_NQ]; /* of an error in q */
  double span;           /* [s] */
  double rate;           /* [rad/s] of the crank at the start, by which steps are told */
  double energy;         /* [J] kinetic, at the start */
  double growth;         /* [-] largest of perturbations between samples; NaN: not computed */
  double times[SWEEP_SAMPLES];
  double want[SWEEP_SAMPLES][SWEEP_NQ];
} sweep_scene;

/* Linkages within 1 % of a change point, s + l = p + q. */
enum { SWEEP_FOUR_BARS = 10 };
sweep_scene sweep_four_bar(int k, bool gravity, double turns);

/* A light rod that comes taut: it slides with one end in a slot and carries a bob at the other. */
sweep_scene sweep_taut(double mass_ratio, bool growth);

/* Through singular configurations. */
enum { SWEEP_SINGULAR = 3 };
sweep_scene sweep_singular(int k);

void sweep_close(sweep_scene *scene);

#endif
