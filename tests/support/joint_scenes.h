/* SPDX-License-Identifier: BSD-3-Clause */
/* One small mechanism for each kind of joint. It has gravity, initial velocities, and one or two
 * degrees of freedom. Tests of all joints use them. */
#ifndef BAUM_TEST_JOINT_SCENES_H
#define BAUM_TEST_JOINT_SCENES_H

#include <baum/baum.h>

typedef struct joint_scene {
  const char *name;
  void (*build)(baum_mechanism *mechanism); /* fails the test if a call fails */
  int degrees_of_freedom;
  bool conservative; /* whether the energy is constant, as it is without drivers */
} joint_scene;

enum { JOINT_SCENES = 15, JOINT_SCENE_SIZE_MAX = 12 }; /* of nv and nc */
extern const joint_scene joint_scenes[JOINT_SCENES];

/* Returns the frozen mechanism, which the caller destroys. */
baum_mechanism *joint_scene_make(const joint_scene *scene);

#endif
