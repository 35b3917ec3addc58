/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms with one degree of freedom. Their exact motion follows from one equation for one
 * angle. A scene contains all numbers that the stress grid varies, in SI units. The mechanism is
 * built in the units `units`. */
#ifndef BAUM_TEST_SCENE_H
#define BAUM_TEST_SCENE_H

#include "models.h"
#include "oracle.h"

typedef enum scene_kind {
  SCENE_BOB,      /* particle on a rod of 1 m */
  SCENE_PENDULUM, /* uniform rod of 1 m, pinned */
  SCENE_CRANK,    /* slider-crank */
  SCENE_FOUR_BAR, /* crank and rocker */
  SCENE_WINDOWS,  /* N-four-bar */
  SCENE_SLEIGH,   /* knife edge under gravity, with a second body on a pin */
  SCENE_CHAIN,    /* straight chain that rotates without gravity; its total length is 1 m */
  /* These are spatial mechanisms of the catalogue: */
  SCENE_SPATIAL_CRANK, /* slider-crank; its spring acts on the slider */
  SCENE_RSSR,          /* four-bar with a driver */
  SCENE_BRICARD,       /* it has a redundant row, and `ratio` is a ratio of moments of inertia */
  SCENE_TOP,           /* heavy top with a horizontal axis, which precesses steadily */
  /* These are described in elements.h: */
  SCENE_WHEEL,
  SCENE_DISC,
  SCENE_SCREW,
  SCENE_SHAFTS,
  SCENE_BUSHING,
  SCENE_BEAD,
  SCENE_KINDS
} scene_kind;

typedef struct scene {
  scene_kind kind;
  int count;      /* number of windows or of links */
  double angle;   /* [rad] of the first body at start */
  double rate;    /* [rad/s] angular velocity of the first body at start */
  double gravity; /* [m/s^2] */
  double ratio;   /* [-] mass of the last body divided by that of the first */
  double rod;     /* [m] length of the slider-crank's rod; the length of its crank is 1 m */
  /* [N m/rad] of the torsion spring at the first pin. It is relaxed at the angle `angle` - 0.1
   * rad. */
  double stiffness;
  double damping;   /* [N m s/rad] of the torsion damper at the first pin */
  bool driven;      /* whether a driver keeps the angular velocity of the first body at `rate` */
  double start;     /* [s] time at the start */
  double violation; /* [m] by how much the last body is displaced in the design configuration */
  int spare;        /* number of redundant joints */
  double off;       /* [m] by how much the redundant joints differ from the others */
  double gap;       /* [rad] or [m] distance from a singular configuration, for grade.c */
  /* Whether this is a planar mechanism built of spatial elements in a tilted plane. */
  bool tilted;
  model_units units;
} scene;

/* Returns the default scene of a kind, with equal masses, no spring, and SI units. */
scene scene_of(scene_kind kind);
const char *scene_name(const scene *s);

baum_status scene_build(const scene *s, model *out);

/* Returns the angle [rad] of the first body at the start. If there is a driver, this is the
 * driver's value in double precision. */
double scene_begin(const scene *s);
enum { SCENE_NUMBERS = 7 };
/* Returns the number of coordinates of each body. It is 2 or 3 in the plane, and 7 in space. */
int scene_width(const scene *s);
int scene_bodies(const scene *s);
/* Computes the pose of a body when the angle of the first body is x. The pose consists of x, y and
 * angle [m, m, rad], or of seven coordinates in space. */
void scene_pose(const scene *s, int body, long double x, long double pose[SCENE_NUMBERS]);
/* Returns the largest distance between two poses. Lengths are divided by `scale`, and angles are in
 * radians. */
double scene_distance(const scene *s, const long double *a, const long double *b, double scale);
/* Evaluates the equation of motion. Returns x'' at the angle x and the angular velocity v. */
long double scene_acceleration(const void *s, long double x, long double v);

#endif
