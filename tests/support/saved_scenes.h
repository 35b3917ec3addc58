/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs for tests that save and restore them. They cover every integrator with each of its
 * formulations, and every solver. */
#ifndef BAUM_TEST_SAVED_SCENES_H
#define BAUM_TEST_SAVED_SCENES_H

#include <stdbool.h>

#include <baum/baum.h>

enum { SAVED_NQ_MAX = 112, SAVED_NAME = 80 };

typedef struct saved_scene saved_scene;

struct saved_scene {
  char name[SAVED_NAME];
  baum_mechanism *mechanism;
  baum_simulation_options options;
  int32_t nq;
  int32_t nv;
  int times;   /* how often the run is saved */
  double span; /* [s] longest interval between two saves */
  bool has_input;
  baum_input_id input;
  /* An event occurs when the coordinate of this joint passes the value `passes`. If no joint is
   * given, there is no event. */
  baum_joint_id watched;
  double passes;
  baum_joint_id motor; /* the driver whose law is replaced during the run */
  /* Replaces the law of the motor without a jump. NULL if there is no motor. */
  baum_status (*law)(baum_simulation *run, const saved_scene *scene);
};

/* Opens scene `number` with a new mechanism. Returns false if there are fewer scenes. */
bool saved_scene_open(saved_scene *scene, int number);
void saved_scene_close(saved_scene *scene);

/* Creates a run of the scene. If anything fails, the test fails. */
baum_simulation *saved_scene_start(const saved_scene *scene);

/* Tells whether the status is BAUM_OK or BAUM_WARNED. */
bool saved_reached(baum_status status);

/* Returns the k-th of a sequence of pseudo-random numbers between 0 and 1. */
double saved_random(int k);

#endif
