/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms of one degree of freedom whose motion is known from one equation for one angle, with
 * every number that the stress grid varies. SI units; `units` only says in which ones the mechanism
 * is built. */
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
  SCENE_CHAIN,    /* straight, turning without gravity; 1 m long in all */
  SCENE_KINDS
} scene_kind;

typedef struct scene {
  scene_kind kind;
  int count;      /* windows, links */
  double angle;   /* [rad] at start, of the first body */
  double rate;    /* [rad/s] likewise */
  double gravity; /* [m/s^2] */
  double ratio;   /* [-] mass of the last body to that of the first */
  double rod;     /* [m] rod of the slider-crank, whose crank has 1 m */
  double
    stiffness;    /* [N m/rad] torsion spring at the first pin, relaxed 0.1 rad behind the start */
  double damping; /* [N m s/rad] torsion damper, likewise */
  bool driven;    /* the first body turns at its rate for ever */
  double start;   /* [s] time at start */
  double violation; /* [m] by which the last body is drawn beside its place */
  int spare;        /* joints that say again what others say */
  double off;       /* [m] by which spare joints disagree */
  double gap;       /* [rad] or [-] from a singular configuration at start; tells the grade, not the
                 mechanism */
  model_units units;
} scene;

/* Level, at rest under gravity, with equal masses, in SI units. */
scene scene_of(scene_kind kind);
const char *scene_name(scene_kind kind);

baum_status scene_build(const scene *s, model *out);

/* Where the motor, in doubles, has the first body at start [rad]; the angle at start without
 * one. */
double scene_begin(const scene *s);
/* Numbers of q per body. */
int scene_width(const scene *s);
int scene_bodies(const scene *s);
/* x, y, angle of a body [m, m, rad] when the angle of the first is x. */
void scene_pose(const scene *s, int body, long double x, long double pose[3]);
/* The one equation. */
long double scene_acceleration(const void *s, long double x, long double v);

#endif
