/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms with the bodies of manifold_bodies.h. Each planar one has a twin, the same mechanism
 * with the library's planar bodies and joints. For the tops, the tests integrate a reference
 * solution. */
#ifndef BAUM_TEST_MANIFOLD_SCENES_H
#define BAUM_TEST_MANIFOLD_SCENES_H

#include <stdbool.h>

#include <baum/baum.h>

enum { MANIFOLD_SIZE = 24, MANIFOLD_SCENES = 12 /* nq, nv, nc */ };

typedef struct manifold_scene {
  const char *name;
  void (*build)(baum_mechanism *mechanism);
  /* Builds the twin, and converts the q of the twin to q of the scene. NULL: no twin. */
  void (*build_twin)(baum_mechanism *mechanism);
  void (*translate)(const double *twin_q, double *q);
  /* Computes the exact q at a time. NULL: there is a twin instead. */
  void (*solve)(double t, double *q);
  int degrees_of_freedom;
  bool refuses_rattle; /* its user functions compute gyroscopic moments */
  struct {
    int first; /* index in q of the first part */
    int count; /* how many; quaternions begin seven numbers apart, others four */
    int length;
  } units;            /* unit vectors and unit quaternions in q */
  int redundant_rows; /* 0 unless given */
} manifold_scene;

extern const manifold_scene manifold_scenes[MANIFOLD_SCENES];

/* An additional scene, whose motion passes through singular configurations. */
extern const manifold_scene manifold_crossing;

/* Finds a scene by its name. Fails the test if there is none. */
const manifold_scene *manifold_scene_find(const char *name);

/* Returns the frozen mechanism, which the caller destroys. */
baum_mechanism *manifold_scene_make(const manifold_scene *scene);
baum_mechanism *manifold_scene_make_twin(const manifold_scene *scene);

/* Computes q at a time with an accuracy of about 1e-10, by a run of the twin with rk8 or by
 * `solve`. */
void manifold_scene_solve(const manifold_scene *scene, double t, double *q);

#endif
