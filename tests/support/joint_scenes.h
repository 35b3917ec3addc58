/* SPDX-License-Identifier: BSD-3-Clause */
/* Small mechanisms, one for each kind of joint. Each has gravity, initial velocities, and one to
 * three degrees of freedom. Tests that cover all joints use these mechanisms. */
#ifndef BAUM_TEST_JOINT_SCENES_H
#define BAUM_TEST_JOINT_SCENES_H

#include <baum/baum.h>

typedef struct joint_scene {
  const char *name;
  void (*build)(baum_mechanism *mechanism); /* fails the test if a call fails */
  int degrees_of_freedom;
  bool conservative;  /* whether the energy is constant, as it is without drivers and loads */
  bool of_velocities; /* whether it has rows of velocity level, which rattle refuses */
} joint_scene;

enum { JOINT_SCENES = 17, JOINT_SCENE_SIZE_MAX = 12 }; /* largest nv and nc */
extern const joint_scene joint_scenes[JOINT_SCENES];

/* Returns the frozen mechanism, which the caller destroys. */
baum_mechanism *joint_scene_make(const joint_scene *scene);

#endif
