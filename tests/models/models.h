/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms that several tests use. They are mechanisms of the catalogue and variants of them.
 *
 * Each call makes a frozen mechanism whose design configuration is exactly its initial
 * configuration, and returns BAUM_OK. If it fails, it makes no mechanism and returns the status.
 * All data are in SI units. If there is gravity, it acts along -y.
 */
#ifndef BAUM_TEST_MODELS_H
#define BAUM_TEST_MODELS_H

#include <stdbool.h>

#include <baum/baum.h>

#include "catalog/parts.h"

/* A frozen mechanism. Its bodies and joints are listed in the order in which they were added. */
typedef struct model {
  baum_mechanism *mechanism;
  baum_body_id *bodies;  /* (body_count) */
  baum_joint_id *joints; /* (joint_count) */
  int body_count;
  int joint_count;
} model;

/* Becomes the owner of a frozen mechanism. If this fails, the mechanism is destroyed. */
baum_status model_adopt(baum_mechanism *mechanism, model *out);
void model_destroy(model *out);

/* The values of one metre, one kilogram and one second in other units. The data of models are in SI
 * units, and the mechanism is built in the other units. */
typedef struct model_units {
  double length;
  double mass;
  double time;
} model_units;

extern const model_units MODEL_MILLI; /* millimetres, grams and milliseconds */

/* Replaces a frozen mechanism in SI units by the same mechanism in other units. If this fails, the
 * mechanism is destroyed. */
baum_status model_change_units(baum_mechanism **mechanism, const model_units *units);
/* Freezes parts that are in SI units, and converts them to `units`. If `units` is NULL, they stay
 * in SI units. */
baum_status model_finish(baum_i_parts *parts, const model_units *units, model *out);

/* ---- pendulum: a point of 1 kg on a circle of 1 m -------------------------------------------- */

typedef struct model_pendulum {
  double gravity; /* [m/s^2] */
  double x;       /* [m] x at the start, where the point is level with the pivot: 1 or -1 */
  double v;       /* [m/s] vertical velocity at the start */
} model_pendulum;

extern const model_pendulum MODEL_PENDULUM_A01;      /* problem A01 of IFToMM and A Coruna */
extern const model_pendulum MODEL_PENDULUM_SUNDIALS; /* cvPendulum_dns; its period is exactly 2 s */

/* Makes the pendulum as a particle with a distance joint. */
baum_status model_pendulum_rod(const model_pendulum *data, model *out);
/* Makes the pendulum as a particle with the user constraint x^2 + y^2 - 1 = 0. The user gives no
 * derivatives of this constraint. */
baum_status model_pendulum_circle(const model_pendulum *data, model *out);

/* ---- slider-crank of Flores, Leine, Glocker with eccentricity -------------------------------- */

enum { MODEL_CRANK, MODEL_ROD, MODEL_SLIDER };
enum { MODEL_PIN_GROUND, MODEL_PIN_CRANK, MODEL_PIN_SLIDER, MODEL_GUIDE, MODEL_MOTOR };

typedef struct model_slider_crank {
  /* Whether a motor keeps the crank at 150 rad/s; otherwise the crank only starts with 150
   * rad/s. */
  bool driven;
  /* Whether only the crank is in its exact pose, so that assembly has to move the other bodies. */
  bool rough;
  bool centric;       /* whether there is no eccentricity */
  bool doubled_guide; /* whether a second guide on the same line adds two redundant rows */
  /* Whether the velocities of all bodies are given; otherwise only the velocity of the crank is
   * given. */
  bool moving;
  double angle;    /* [rad] of the crank at the start */
  double rod;      /* [m] length of the rod, or 0 for the length in the paper */
  double rod_mass; /* [kg] mass of the rod, or 0 for the mass in the paper */
  /* Number of frame bodies between the ground and the crank. Each frame is welded to the frame
   * before it. */
  int frames;
  const model_units *units; /* NULL for SI units */
} model_slider_crank;

/* Makes three bodies, three pins and a guide. Options add a second guide, a motor, and frames with
 * their welds. q = (x, y, angle) of crank, rod, slider, frames. */
baum_status model_slider_crank_build(model_slider_crank options, model *out);

/* ---- Andrews' squeezing mechanism ------------------------------------------------------------ */

enum { MODEL_ANDREWS_ANGLES = 7 };

/* Makes Andrews' mechanism in the 7 angles of the Bari test set. A user function gives its 6 rows.
 * `with_jacobian` tells whether a second user function gives the Jacobian of these rows. */
baum_status model_andrews_angles(bool with_jacobian, model *out);
/* Makes Andrews' mechanism of 7 planar bodies (K1 to K7) and 10 pins. It has 21 coordinates and 20
 * rows. */
baum_status model_andrews_bodies(model *out);
baum_status model_andrews_bodies_in(const model_units *units, model *out); /* NULL for SI units */
/* Converts the 21 coordinates to the 7 angles of the Bari test set. Velocities are converted to the
 * rates of these angles in the same way. */
void model_andrews_from_bodies(const double *q, double angles[MODEL_ANDREWS_ANGLES]);

/* ---- car axis: 4 coordinates, 2 rows that depend on time ------------------------------------- */

/* Makes the car axis. `with_derivatives` tells whether user functions give the Jacobian J and nu
 * (of J v = nu). The signs of the multipliers are opposite to those in the Bari test set. */
baum_status model_car_axis(bool with_derivatives, model *out);

/* ---- slider-crank of SUNDIALS' idaSlCrank_dns, as two bodies --------------------------------- */

/* Its positions are q = (x, y, angle) of crank and rod. The centre of the rod moves on the x
 * axis. */
baum_status model_sundials_slider_crank(model *out);

/* ---- four-bar: crank-rocker of uniform rods under gravity ------------------------------------ */

/* Its positions are q = (x, y, angle) of crank, coupler and rocker. The crank starts at 1 rad with
 * 2 rad/s. */
baum_status model_four_bar(model *out);
baum_status model_four_bar_in(const model_units *units, model *out); /* NULL for SI units */

/* ---- N-four-bar: N square loops ("windows") of uniform rods of 1 m ---- */

typedef struct model_n_four_bar {
  int loops; /* N */
  /* [rad] of all cranks at the start; 0 is the flat configuration, which is singular. */
  double angle;
  double rate;              /* [rad/s] of all cranks at the start */
  double crank_mass;        /* [kg] 1 in the benchmark */
  double coupler_mass;      /* [kg] 1 in the benchmark */
  const model_units *units; /* NULL for SI units */
} model_n_four_bar;

/* Returns the data of problem A02 of IFToMM and A Coruna. The cranks start upright, and their tips
 * move to the right at 1 m/s. */
model_n_four_bar model_n_four_bar_a02(int loops);
/* Makes an N-four-bar. Its positions are q = (x, y, angle) of crank 0, coupler 0, crank 1, ...,
 * crank N. It has 2 N + 1 bodies and 6 N + 2 rows. */
baum_status model_n_four_bar_build(const model_n_four_bar *data, model *out);

/* ---- chain: uniform rods in a row, pinned to the ground at the origin ---- */

typedef struct model_chain {
  int links;
  const double *mass;   /* (links) [kg], or NULL if all are 1 */
  const double *length; /* (links) [m], or NULL if all are 1 */
  /* (links) [rad] at the start, or NULL if all are 0, which is horizontal. */
  const double *angle;
  const double *rate;       /* (links) [rad/s] at the start, or NULL if all are 0 */
  const model_units *units; /* NULL for SI units */
} model_chain;

/* The chain of the catalogue, which has three different links. The second function returns its
 * data, from which variants can be made. */
baum_status model_chain_3(model *out);
model_chain model_chain_3_data(void);
/* Makes a chain. Its positions are q = (x, y, angle) of each link. N links have 3 N coordinates and
 * 2 N rows. */
baum_status model_chain_build(const model_chain *data, model *out);

/* ---- parallelogram: cranks of 1 m that carry one coupler of 2 m ---- */

typedef enum model_parallelogram {
  MODEL_TWO_CRANKS, /* one crank at each end; 9 coordinates and 8 rows */
  /* A third crank in the middle; 12 coordinates and 12 rows, of which one is redundant. */
  MODEL_THREE_CRANKS,
  MODEL_THIRD_BY_A_ROD /* a massless rod of 1 m replaces the pin of the middle crank; 11 rows */
} model_parallelogram;

typedef struct model_parallelogram_data {
  model_parallelogram which;
  double angle; /* [rad] of the cranks at the start */
  double rate;  /* [rad/s] of the cranks at the start; if it is 0, they start with 2 rad/s */
  /* Whether a second pin, "pin again", joins the tip of the last crank to the coupler. It adds two
   * rows. */
  bool doubled;
  double aside; /* [m] how far the second pin is from the first, on both bodies of the pins */
  double gap;   /* [m] distance along the crank between the two points that the second pin joins */
  double above; /* [m] how much higher the foot of the middle crank is than those of the others */
  bool framed;  /* whether there is an additional body, which is welded to the ground */
  const model_units *units; /* NULL for SI units */
} model_parallelogram_data;

/* Both functions make a parallelogram. Its positions are q = (x, y, angle) of the first crank, the
 * last crank, the coupler and the middle crank. */
baum_status model_parallelogram_build_of(const model_parallelogram_data *data, model *out);
baum_status model_parallelogram_build(model_parallelogram which, double angle, model *out);

#endif
