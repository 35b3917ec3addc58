/* SPDX-License-Identifier: BSD-3-Clause */
/* A small mechanism around each kind of joint: in gravity, in motion, with one freedom or two. What
 * all joints must be able to do is tried on all of them.
 */
#ifndef BAUM_TEST_JOINT_SCENES_H
#define BAUM_TEST_JOINT_SCENES_H

#include <baum/baum.h>

typedef struct joint_scene {
  const char *name;
  void (*build)(baum_mechanism *mechanism); /* fails the test on failure */
  int degrees_of_freedom;
  bool conservative; /* energy is kept: nothing drives */
} joint_scene;

enum { JOINT_SCENES = 15, JOINT_SCENE_SIZE_MAX = 12 }; /* nv, nc */
extern const joint_scene joint_scenes[JOINT_SCENES];

/* Frozen; the caller destroys it. */
baum_mechanism *joint_scene_make(const joint_scene *scene);

#endif
