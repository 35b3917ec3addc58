/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms whose driver leaves no degree of freedom, with their motion in closed form. Public
 * interface only. */
#ifndef BAUM_TEST_DRIVEN_H
#define BAUM_TEST_DRIVEN_H

#include <baum/baum.h>

/* Drives the crank to angle + rate t, or by a law. */
typedef struct drive {
  double angle; /* [rad] at the design configuration */
  double rate;  /* [rad/s] */
  baum_law_fn *law;
  void *user;
} drive;

/* ---- slider-crank: crank r from the origin, rod l, slider on y = e ----
 *
 * q = (x, y, angle) of crank, rod, slider. Branch 1: the rod points towards +x, -1: towards -x. */

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
/* x of the slider, its velocity and acceleration at a crank angle with constant angular
 * velocity. */
void slider_crank_motion(const slider_crank *data, double angle, double x[3]);
/* Smallest difference between this crank angle and one at which the rod is perpendicular to the
 * guide; INFINITY if there is none. There the crank locks if the rod is too short. */
double slider_crank_to_lock(const slider_crank *data, double angle);

/* ---- four-bar: crank 1 m, coupler 3 m, rocker 2.5 m, pins of the frame 2.8 m apart ----
 *
 * q = (x, y, angle) of crank, coupler, rocker. A crank-rocker, whose crank can make full
 * revolutions. */

enum { ROCKER_ANGLE = 8 };

baum_mechanism *four_bar_make(const drive *motor);
/* Angle of the rocker, up to revolutions. */
double four_bar_rocker(double angle);

/* ---- parallelogram: three cranks of 1 m at x = 0, 1, 2 on one coupler, the first driven; a
 * redundant row ----
 *
 * q = (x, y, angle) of coupler and cranks. */

enum { PARALLELOGRAM_NV = 12 };

baum_mechanism *parallelogram_make(const drive *motor);

#endif
