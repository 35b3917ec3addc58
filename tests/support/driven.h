/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms whose driver leaves no degree of freedom, with their motion in closed form. Public
 * interface only. */
#ifndef BAUM_TEST_DRIVEN_H
#define BAUM_TEST_DRIVEN_H

#include <baum/baum.h>

/* What drives the crank: its angle is angle + rate t, or that of the law. */
typedef struct drive {
  double angle; /* [rad] at the design configuration */
  double rate;  /* [rad/s] */
  baum_law_fn *law;
  void *user;
} drive;

/* ---- slider-crank: crank r from the origin, rod l, slider on y = e ----
 *
 * q = (x, y, angle) of crank, rod, slider. Branch 1: the rod points to +x, -1: to -x. */

enum { SLIDER_X = 6, SLIDER_NV = 9 };

typedef struct slider_crank {
  double crank;  /* [m] r */
  double rod;    /* [m] l */
  double offset; /* [m] e */
  int branch;
  drive drive;
} slider_crank;

baum_mechanism *slider_crank_make(const slider_crank *data);
/* One more in a mechanism that is not yet frozen. */
void slider_crank_add(baum_mechanism *mechanism, const slider_crank *data);
/* x of the slider, its rate and acceleration while the crank at an angle turns at a constant
 * rate. */
void slider_crank_motion(const slider_crank *data, double angle, double x[3]);
/* Angle between the crank at some angle and the nearest one at which rod and guide are square: a
 * lock-up where the rod is too short. INFINITY where there is none. */
double slider_crank_to_lock(const slider_crank *data, double angle);

/* ---- four-bar: crank 1 m, coupler 3 m, rocker 2.5 m, pins of the frame 2.8 m apart ----
 *
 * q = (x, y, angle) of crank, coupler, rocker. A crank-rocker: the crank turns for ever. */

enum { ROCKER_ANGLE = 8 };

baum_mechanism *four_bar_make(const drive *motor);
/* Angle of the rocker, up to turns. */
double four_bar_rocker(double angle);

/* ---- parallelogram: three cranks of 1 m at x = 0, 1, 2 on one coupler, the first driven; a
 * redundant row ----
 *
 * q = (x, y, angle) of coupler and cranks. */

enum { PARALLELOGRAM_NV = 12 };

baum_mechanism *parallelogram_make(const drive *motor);

#endif
