/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms for tests of the energy account. Each kind of work that the account distinguishes
 * occurs in at least one of them. */
#ifndef BAUM_TEST_ACCOUNT_SCENES_H
#define BAUM_TEST_ACCOUNT_SCENES_H

#include <baum/baum.h>

typedef enum account_kind {
  ACCOUNT_QUIET,    /* only gravity acts on two links, so the energy is constant */
  ACCOUNT_DRIVEN,   /* a driver with a user's law rotates the first link */
  ACCOUNT_DAMPED,   /* has springs, dampers, a user's law, loads, an input and a user force */
  ACCOUNT_VIOLATED, /* the initial state violates the constraints */
  ACCOUNT_POLAR,    /* has user coordinates whose mass matrix depends on q, and a damper */
  ACCOUNT_SCENES
} account_kind;

typedef struct account_scene {
  const char *name;
  account_kind kind;
  baum_start start;
  double span; /* [s] */
} account_scene;

extern const account_scene account_scenes[ACCOUNT_SCENES];

/* Builds and freezes the mechanism. On failure returns NULL and sets the message. */
baum_mechanism *account_build(const account_scene *scene);

#endif
