/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs to be saved and restored: every integrator with every formulation, and every solver. */
#ifndef BAUM_TEST_SAVED_SCENES_H
#define BAUM_TEST_SAVED_SCENES_H

#include <stdbool.h>

#include <baum/baum.h>

enum { SAVED_NQ_MAX = 72, SAVED_NAME = 80 };

typedef struct saved_scene saved_scene;

struct saved_scene {
  char name[SAVED_NAME];
  baum_mechanism *mechanism;
  baum_simulation_options options;
  int32_t nq;
  int32_t nv;
  int times;   /* at which it is saved */
  double span; /* [s] most between two of them */
  bool has_input;
  baum_input_id input;
  baum_joint_id watched; /* an event counts where its coordinate passes this; none: no event */
  double passes;
  baum_joint_id motor; /* of the law */
  /* Give the motor another law, from where it is; NULL: there is none. */
  baum_status (*law)(baum_simulation *run, const saved_scene *scene);
};

/* The number-th, its mechanism built again; false past the last. */
bool saved_scene_open(saved_scene *scene, int number);
void saved_scene_close(saved_scene *scene);

/* A run of it; fails the test on failure. */
baum_simulation *saved_scene_start(const saved_scene *scene);

/* BAUM_OK or BAUM_WARNED. */
bool saved_reached(baum_status status);

/* The k-th of a sequence of numbers between 0 and 1. */
double saved_random(int k);

#endif
