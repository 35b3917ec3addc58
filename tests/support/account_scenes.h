/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms that together have every kind of work that an energy account distinguishes. */
#ifndef BAUM_TEST_ACCOUNT_SCENES_H
#define BAUM_TEST_ACCOUNT_SCENES_H

#include <baum/baum.h>

typedef enum account_kind {
  ACCOUNT_QUIET,    /* two links under gravity: constant energy */
  ACCOUNT_DRIVEN,   /* a driver rotates the first link by a law */
  ACCOUNT_DAMPED,   /* springs, dampers, a user law, loads, an input, a user force */
  ACCOUNT_VIOLATED, /* starts off its constraints */
  ACCOUNT_POLAR,    /* a body in polar coordinates, M(q), with friction */
  ACCOUNT_SCENES
} account_kind;

typedef struct account_scene {
  const char *name;
  account_kind kind;
  baum_start start;
  double span; /* [s] */
} account_scene;

extern const account_scene account_scenes[ACCOUNT_SCENES];

/* Frozen. NULL on failure, with the message. */
baum_mechanism *account_build(const account_scene *scene);

#endif
