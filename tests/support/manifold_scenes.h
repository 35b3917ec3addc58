/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms whose positions are on a manifold. Most are made of the bodies of manifold_bodies.h,
 * and the others are made of spatial elements. Some mechanisms have a twin, which is the same
 * mechanism with angles as coordinates. The tops, the screw and the driven slider-crank have no
 * twin. For them, the motion is known in closed form, or the tests integrate a reference
 * solution. */
#ifndef BAUM_TEST_MANIFOLD_SCENES_H
#define BAUM_TEST_MANIFOLD_SCENES_H

#include <stdbool.h>

#include <baum/baum.h>

enum { MANIFOLD_SIZE = 24 /* largest nq, nv and nc */, MANIFOLD_SCENES = 12 };

typedef struct manifold_scene {
  const char *name;
  void (*build)(baum_mechanism *mechanism);
  /* The first function builds the twin. The second one converts positions q of the twin to
   * positions q of the scene. Both are NULL if there is no twin. */
  void (*build_twin)(baum_mechanism *mechanism);
  void (*translate)(const double *twin_q, double *q);
  /* Computes the exact positions q at a time. NULL if there is a twin. */
  void (*solve)(double t, double *q);
  int degrees_of_freedom;
  bool refuses_rattle; /* its user functions compute gyroscopic moments, which RATTLE refuses */
  /* The unit vectors (cos, sin), or the unit quaternions, that q contains. In q, two successive
   * quaternions begin seven numbers apart, and two successive unit vectors four numbers apart. */
  struct {
    int first;  /* index in q of the first unit vector or quaternion */
    int count;  /* number of unit vectors or quaternions */
    int length; /* how many numbers each of them has */
  } units;
  int redundant_rows; /* 0 unless given */
} manifold_scene;

extern const manifold_scene manifold_scenes[MANIFOLD_SCENES];

/* A further scene, whose motion passes through singular configurations. */
extern const manifold_scene manifold_crossing;

/* Finds a scene by its name. Fails the test if there is none. */
const manifold_scene *manifold_scene_find(const char *name);

/* Returns the frozen mechanism, which the caller destroys. */
baum_mechanism *manifold_scene_make(const manifold_scene *scene);
baum_mechanism *manifold_scene_make_twin(const manifold_scene *scene);

/* Computes q at a time, with an accuracy of about 1e-10. It runs the twin with rk8, or calls
 * `solve`. */
void manifold_scene_solve(const manifold_scene *scene, double t, double *q);

#endif
