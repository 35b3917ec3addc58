/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms used by several tests: those of the catalogue, and variants of them.
 *
 * Each call gives a frozen mechanism in its exact start configuration and returns BAUM_OK. On
 * failure it gives no mechanism and returns the status. SI units; gravity, if any, along -y.
 */
#ifndef BAUM_TEST_MODELS_H
#define BAUM_TEST_MODELS_H

#include <stdbool.h>

#include <baum/baum.h>

#include "catalog/parts.h"

/* A frozen mechanism with its bodies and joints in the order in which they were added. */
typedef struct model {
  baum_mechanism *mechanism;
  baum_body_id *bodies;  /* (body_count) */
  baum_joint_id *joints; /* (joint_count) */
  int body_count;
  int joint_count;
} model;

/* Takes ownership of a frozen mechanism, which it destroys on failure. */
baum_status model_adopt(baum_mechanism *mechanism, model *out);
void model_destroy(model *out);

/* The values of one metre, one kilogram and one second in other units. Data of models are in SI
 * units; the mechanism is built in the other units. */
typedef struct model_units {
  double length;
  double mass;
  double time;
} model_units;

extern const model_units MODEL_MILLI; /* millimetres, grams, milliseconds */

/* Replaces a frozen mechanism in SI units by the same in other units; destroys it on failure. */
baum_status model_change_units(baum_mechanism **mechanism, const model_units *units);
/* Freezes parts that are in SI units. units: NULL for SI. */
baum_status model_finish(baum_i_parts *parts, const model_units *units, model *out);

/* ---- pendulum: a point of 1 kg on a circle of 1 m -------------------------------------------- */

typedef struct model_pendulum {
  double gravity; /* [m/s^2] */
  double x;       /* [m] start, level with the pivot: 1 or -1 */
  double v;       /* [m/s] vertical velocity at the start */
} model_pendulum;

extern const model_pendulum MODEL_PENDULUM_A01;      /* IFToMM/A Coruna A01 */
extern const model_pendulum MODEL_PENDULUM_SUNDIALS; /* cvPendulum_dns; its period is exactly 2 s */

/* As a particle with a distance joint. */
baum_status model_pendulum_rod(const model_pendulum *data, model *out);
/* As a particle with the user constraint x^2 + y^2 - 1 = 0, Phi only. */
baum_status model_pendulum_circle(const model_pendulum *data, model *out);

/* ---- slider-crank of Flores, Leine, Glocker with eccentricity -------------------------------- */

enum { MODEL_CRANK, MODEL_ROD, MODEL_SLIDER };
enum { MODEL_PIN_GROUND, MODEL_PIN_CRANK, MODEL_PIN_SLIDER, MODEL_GUIDE, MODEL_MOTOR };

typedef struct model_slider_crank {
  bool driven;        /* a motor keeps the crank at 150 rad/s; else this is its initial velocity */
  bool rough;         /* only the crank is in its exact pose, and assembly has to move the others */
  bool centric;       /* no eccentricity */
  bool doubled_guide; /* a second guide on the same line: two redundant rows */
  bool moving;        /* the velocities of all bodies are given; else only that of the crank */
  double angle;       /* [rad] of the crank at start */
  double rod;         /* [m] length of the rod; 0: as in the paper */
  double rod_mass;    /* [kg] 0: as in the paper */
  int frames;         /* number of stacked bodies, welded to the ground, that carry the crank */
  const model_units *units; /* NULL: SI */
} model_slider_crank;

/* Three bodies, three pins and a guide; with options a second guide, a motor, and frames with their
 * welds. q = (x, y, angle) of crank, rod, slider, frames. */
baum_status model_slider_crank_build(model_slider_crank options, model *out);

/* ---- Andrews' squeezing mechanism ------------------------------------------------------------ */

enum { MODEL_ANDREWS_ANGLES = 7 };

/* Andrews' mechanism in the 7 angles of the test set with 6 user rows, with or without their
 * Jacobian. */
baum_status model_andrews_angles(bool with_jacobian, model *out);
/* Andrews' mechanism as 7 planar bodies (K1 to K7) and 10 pins: 21 coordinates and 20 rows. */
baum_status model_andrews_bodies(model *out);
baum_status model_andrews_bodies_in(const model_units *units, model *out); /* NULL: SI */
/* Converts the 21 coordinates to the 7 angles of the test set, or velocities to their rates. */
void model_andrews_from_bodies(const double *q, double angles[MODEL_ANDREWS_ANGLES]);

/* ---- car axis: 4 coordinates, 2 rows that depend on time ------------------------------------- */

/* With or without Jacobian and nu. Multipliers have the opposite sign of those of the test set. */
baum_status model_car_axis(bool with_derivatives, model *out);

/* ---- slider-crank of SUNDIALS' idaSlCrank_dns, as two bodies --------------------------------- */

/* q = (x, y, angle) of crank and rod; the rod's centre moves on the x axis. */
baum_status model_sundials_slider_crank(model *out);

/* ---- four-bar: crank-rocker of uniform rods under gravity ------------------------------------ */

/* q = (x, y, angle) of crank, coupler, rocker; the crank starts at 1 rad with 2 rad/s. */
baum_status model_four_bar(model *out);
baum_status model_four_bar_in(const model_units *units, model *out); /* NULL: SI */

/* ---- N-four-bar: N windows of uniform rods of 1 m ---- */

typedef struct model_n_four_bar {
  int loops;                /* N */
  double angle;             /* [rad] of all cranks at start; 0 is flat, a singular configuration */
  double rate;              /* [rad/s] of all cranks at start */
  double crank_mass;        /* [kg] 1 in the benchmark */
  double coupler_mass;      /* [kg] 1 in the benchmark */
  const model_units *units; /* NULL: SI */
} model_n_four_bar;

/* IFToMM/A Coruna A02: cranks upright, moving to the right at 1 m/s. */
model_n_four_bar model_n_four_bar_a02(int loops);
/* q = (x, y, angle) of crank 0, coupler 0, crank 1, ..., crank N: 2 N + 1 bodies, 6 N + 2 rows. */
baum_status model_n_four_bar_build(const model_n_four_bar *data, model *out);

/* ---- chain: uniform rods in a row, pinned to the ground at the origin ---- */

typedef struct model_chain {
  int links;
  const double *mass;       /* (links) [kg]; NULL: 1 */
  const double *length;     /* (links) [m]; NULL: 1 */
  const double *angle;      /* (links) [rad] at start; NULL: 0, horizontal */
  const double *rate;       /* (links) [rad/s] at start; NULL: 0 */
  const model_units *units; /* NULL: SI */
} model_chain;

/* The chain of the catalogue, with three different links, and its data for variants. */
baum_status model_chain_3(model *out);
model_chain model_chain_3_data(void);
/* q = (x, y, angle) of each link: 3 N coordinates, 2 N rows. */
baum_status model_chain_build(const model_chain *data, model *out);

/* ---- parallelogram: cranks of 1 m that carry one coupler of 2 m ---- */

typedef enum model_parallelogram {
  MODEL_TWO_CRANKS,    /* one crank at each end: 9 coordinates, 8 rows */
  MODEL_THREE_CRANKS,  /* a third crank in the middle: 12 coordinates, 12 rows, one redundant */
  MODEL_THIRD_BY_A_ROD /* a massless rod of 1 m replaces the pin of the middle crank: 11 rows */
} model_parallelogram;

typedef struct model_parallelogram_data {
  model_parallelogram which;
  double angle; /* [rad] of the cranks at start */
  double rate;  /* [rad/s] of the cranks at start; 0: 2 rad/s */
  bool doubled; /* a second pin, "pin again", at the tip of the last crank: two rows */
  double aside; /* [m] distance of the second pin from the first, on both of its bodies */
  double gap;   /* [m] distance along the crank by which the second pin does not fit */
  double above; /* [m] height of the middle crank's foot above those of the others */
  bool framed;  /* an additional body that is welded to the ground */
  const model_units *units; /* NULL: SI */
} model_parallelogram_data;

/* q = (x, y, angle) of first and last crank, coupler, middle crank. */
baum_status model_parallelogram_build_of(const model_parallelogram_data *data, model *out);
baum_status model_parallelogram_build(model_parallelogram which, double angle, model *out);

#endif
