/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms without degrees of freedom, because drivers prescribe all motion. Their motion is
 * known in closed form. These functions use only the public interface. */
#ifndef BAUM_TEST_DRIVEN_H
#define BAUM_TEST_DRIVEN_H

#include <baum/baum.h>

/* How the crank is driven. Its angle at time t is angle + rate t, unless a law is given. */
typedef struct drive {
  double angle; /* [rad] in the design configuration */
  double rate;  /* [rad/s] */
  baum_law_fn *law;
  void *user;
} drive;

/* ---- slider-crank: crank r from the origin, rod l, slider on y = e ----
 *
 * q = (x, y, angle) of crank, rod and slider. On branch 1 the rod points towards +x, on branch -1
 * towards -x. */

enum { SLIDER_X = 6, SLIDER_NV = 9 };

typedef struct slider_crank {
  double crank;  /* [m] r */
  double rod;    /* [m] l */
  double offset; /* [m] e */
  int branch;
  drive drive;
} slider_crank;

baum_mechanism *slider_crank_make(const slider_crank *data);
/* Adds a slider-crank to an open mechanism. */
void slider_crank_add(baum_mechanism *mechanism, const slider_crank *data);
/* Computes x of the slider, its velocity and its acceleration, at a crank angle. The angular
 * velocity of the crank is the constant data->drive.rate. */
void slider_crank_motion(const slider_crank *data, double angle, double x[3]);
/* If the rod is too short for a full revolution of the crank, the crank locks at the angles at
 * which the rod is perpendicular to the guide. Returns the smallest difference between the crank
 * angle `angle` and one of these angles, or INFINITY if the crank never locks. */
double slider_crank_to_lock(const slider_crank *data, double angle);

/* ---- four-bar: crank 1 m, coupler 3 m, rocker 2.5 m, pins of the frame 2.8 m apart ----
 *
 * q = (x, y, angle) of crank, coupler and rocker. The crank can make full revolutions. */

enum { ROCKER_ANGLE = 8 };

baum_mechanism *four_bar_make(const drive *motor);
/* Returns the angle of the rocker, up to a multiple of 2 pi. */
double four_bar_rocker(double angle);

/* ---- parallelogram: three cranks of 1 m at x = 0, 1, 2 on one coupler ----
 *
 * q = (x, y, angle) of the coupler and of the three cranks. The first crank is driven. One row is
 * redundant. */

enum { PARALLELOGRAM_NV = 12 };

baum_mechanism *parallelogram_make(const drive *motor);
/* The same, but the pins of the third crank are `above` higher, and the cranks have the given
 * moment of inertia. If `above` is not 0, the mechanism has no singular configurations. Whichever
 * row is omitted, however, the other rows are dependent in some configurations. */
baum_mechanism *parallelogram_make_of(const drive *motor, double above, double inertia);

#endif
