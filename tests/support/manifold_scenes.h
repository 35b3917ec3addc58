/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms with the bodies of manifold_bodies.h. The planar ones have twins of ordinary bodies;
 * the tops have a solution, integrated here. */
#ifndef BAUM_TEST_MANIFOLD_SCENES_H
#define BAUM_TEST_MANIFOLD_SCENES_H

#include <stdbool.h>

#include <baum/baum.h>

enum { MANIFOLD_SIZE = 24, MANIFOLD_SCENES = 12 /* nq, nv, nc */ };

typedef struct manifold_scene {
  const char *name;
  void (*build)(baum_mechanism *mechanism);
  /* Builds the twin of ordinary bodies, and converts its q to that of the scene; or NULL. */
  void (*build_twin)(baum_mechanism *mechanism);
  void (*translate)(const double *twin_q, double *q);
  /* Gives q at a time; or NULL. */
  void (*solve)(double t, double *q);
  int degrees_of_freedom;
  bool refuses_rattle; /* user functions give gyroscopic moments */
  struct {
    int first; /* of q */
    int count; /* quaternions are seven elements apart, others four */
    int length;
  } units;            /* parts of q that have unit length */
  int redundant_rows; /* 0 unless given */
} manifold_scene;

extern const manifold_scene manifold_scenes[MANIFOLD_SCENES];

/* An additional scene, whose motion crosses singular configurations. */
extern const manifold_scene manifold_crossing;

/* Finds a scene by its name; fails the test if there is none. */
const manifold_scene *manifold_scene_find(const char *name);

/* Frozen; the caller destroys it. */
baum_mechanism *manifold_scene_make(const manifold_scene *scene);
baum_mechanism *manifold_scene_make_twin(const manifold_scene *scene);

/* q at a time with an accuracy of about 1e-10, from the twin (rk8) or the solution. */
void manifold_scene_solve(const manifold_scene *scene, double t, double *q);

#endif
