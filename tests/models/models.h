/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms that tests have in common, each with one builder. Public interface only.
 *
 * A builder gives a frozen mechanism in its exact start pose and returns BAUM_OK, or gives no
 * mechanism and returns what failed. SI units; gravity along -y where there is any. Sources of the
 * data: tests/data/README.md.
 */
#ifndef BAUM_TEST_MODELS_H
#define BAUM_TEST_MODELS_H

#include <stdbool.h>

#include <baum/baum.h>

enum { MODEL_BODIES = 7, MODEL_JOINTS = 10 };

/* A frozen mechanism and its parts in the order of adding. */
typedef struct model {
  baum_mechanism *mechanism;
  baum_body_id bodies[MODEL_BODIES];
  baum_joint_id joints[MODEL_JOINTS];
  int body_count;
  int joint_count;
} model;

void model_destroy(model *out);

/* ---- pendulum: a point of 1 kg on a circle of 1 m -------------------------------------------- */

typedef struct model_pendulum {
  double gravity; /* [m/s^2] */
  double x;       /* [m] start, level with the pivot and at rest: 1 or -1 */
  double v;       /* [m/s] speed at start, downwards negative */
} model_pendulum;

extern const model_pendulum MODEL_PENDULUM_A01;      /* IFToMM/A Coruna A01 */
extern const model_pendulum MODEL_PENDULUM_SUNDIALS; /* cvPendulum_dns; its period is exactly 2 s */

/* Particle and distance joint. */
baum_status model_pendulum_rod(const model_pendulum *data, model *out);
/* Particle and the user constraint x^2 + y^2 - 1 = 0, Phi only. */
baum_status model_pendulum_circle(const model_pendulum *data, model *out);

/* ---- slider-crank of Flores, Leine, Glocker with eccentricity -------------------------------- */

enum { MODEL_CRANK, MODEL_ROD, MODEL_SLIDER };
enum { MODEL_PIN_GROUND, MODEL_PIN_CRANK, MODEL_PIN_SLIDER, MODEL_GUIDE, MODEL_MOTOR };

typedef struct model_slider_crank {
  bool driven; /* the crank turns at 150 rad/s for ever, else only at start */
  bool rough;  /* rod and slider are drawn on one line and out of place, the crank in place */
} model_slider_crank;

/* Three bodies, three pins, a guide, and the motor if driven. q = (x, y, angle) of crank, rod,
 * slider. */
baum_status model_slider_crank_build(model_slider_crank options, model *out);

/* ---- Andrews' squeezing mechanism ------------------------------------------------------------ */

enum { MODEL_ANDREWS_ANGLES = 7 };

/* In the 7 angles of the test set with 6 user rows, of which the Jacobian is given or not. */
baum_status model_andrews_angles(bool with_jacobian, model *out);
/* As 7 planar bodies (K1 to K7) and 10 pins, 21 coordinates and 20 rows. */
baum_status model_andrews_bodies(model *out);
/* The 7 angles of the test set from the 21 coordinates (or their rates from the velocities). */
void model_andrews_from_bodies(const double *q, double angles[MODEL_ANDREWS_ANGLES]);

/* ---- car axis: 4 coordinates, 2 rows that depend on time ------------------------------------- */

/* Jacobian and nu are given or not. Multipliers have the opposite sign of those of the test set. */
baum_status model_car_axis(bool with_derivatives, model *out);

/* ---- slider-crank of SUNDIALS' idaSlCrank_dns, as two bodies --------------------------------- */

/* q = (x, y, angle) of crank and rod; the rod's centre runs on the x axis. */
baum_status model_sundials_slider_crank(model *out);

/* ---- four-bar: crank-rocker of uniform rods under gravity ------------------------------------ */

/* q = (x, y, angle) of crank, coupler, rocker; the crank starts at 1 rad with 2 rad/s. */
baum_status model_four_bar(model *out);

#endif
