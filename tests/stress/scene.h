/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms of one degree of freedom, whose exact motion follows from one equation for one angle.
 * A scene holds all numbers that the stress grid varies, in SI units; the mechanism is built in
 * `units`. */
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
  SCENE_CHAIN,    /* straight, rotating without gravity; its total length is 1 m */
  /* Spatial mechanisms of the catalogue: */
  SCENE_SPATIAL_CRANK, /* slider-crank; its spring acts on the slider */
  SCENE_RSSR,          /* four-bar, driven */
  SCENE_BRICARD,       /* has a redundant row; `ratio` is a ratio of moments of inertia */
  SCENE_TOP,           /* heavy top that precesses steadily with a horizontal axis */
  SCENE_KINDS
} scene_kind;

typedef struct scene {
  scene_kind kind;
  int count;        /* number of windows or links */
  double angle;     /* [rad] of the first body at start */
  double rate;      /* [rad/s] angular velocity of the first body at start */
  double gravity;   /* [m/s^2] */
  double ratio;     /* [-] mass of the last body to that of the first */
  double rod;       /* [m] length of the slider-crank's rod; that of its crank is 1 m */
  double stiffness; /* [N m/rad] torsion spring at the first pin, relaxed at `angle` - 0.1 rad */
  double damping;   /* [N m s/rad] torsion damper at the first pin */
  bool driven;      /* a driver keeps the first body at `rate` */
  double start;     /* [s] time at start */
  double violation; /* [m] displacement of the last body in the design configuration */
  int spare;        /* number of redundant joints */
  double off;       /* [m] distance by which the redundant joints do not fit */
  double gap;       /* [rad] or [m] distance from a singular configuration, for grade.c */
  bool tilted;      /* planar mechanism, built of spatial elements in a tilted plane */
  model_units units;
} scene;

/* Returns the default scene of a kind, with equal masses, no spring, and SI units. */
scene scene_of(scene_kind kind);
const char *scene_name(const scene *s);

baum_status scene_build(const scene *s, model *out);

/* [rad] angle of the first body at start; if driven, the driver's value in double precision. */
double scene_begin(const scene *s);
enum { SCENE_NUMBERS = 7 };
/* Number of coordinates of each body: 2, 3 or, in space, 7. */
int scene_width(const scene *s);
int scene_bodies(const scene *s);
/* Pose of a body when the angle of the first is x: x, y, angle [m, m, rad], or seven coordinates in
 * space. */
void scene_pose(const scene *s, int body, long double x, long double pose[SCENE_NUMBERS]);
/* Largest distance between poses: lengths divided by `scale`, angles in radians. */
double scene_distance(const scene *s, const long double *a, const long double *b, double scale);
/* The equation of motion: returns x'' at the angle x and the angular velocity v. */
long double scene_acceleration(const void *s, long double x, long double v);

#endif
