/* SPDX-License-Identifier: BSD-3-Clause */
/* A small mechanism for each kind of joint: under gravity, in motion, with one or two degrees of
 * freedom. Tests of all joints use all of them. */
#ifndef BAUM_TEST_JOINT_SCENES_H
#define BAUM_TEST_JOINT_SCENES_H

#include <baum/baum.h>

typedef struct joint_scene {
  const char *name;
  void (*build)(baum_mechanism *mechanism); /* fails the test on failure */
  int degrees_of_freedom;
  bool conservative; /* energy is constant: nothing is driven */
} joint_scene;

enum { JOINT_SCENES = 15, JOINT_SCENE_SIZE_MAX = 12 }; /* nv, nc */
extern const joint_scene joint_scenes[JOINT_SCENES];

/* Frozen; the caller destroys it. */
baum_mechanism *joint_scene_make(const joint_scene *scene);

#endif
