/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms of the bodies of manifold_bodies.h. The planar ones have twins of ordinary bodies; the
 * tops have the motion about their fixed point, integrated here.
 */
#ifndef BAUM_TEST_MANIFOLD_SCENES_H
#define BAUM_TEST_MANIFOLD_SCENES_H

#include <stdbool.h>

#include <baum/baum.h>

enum { MANIFOLD_SIZE = 24, MANIFOLD_SCENES = 11 /* nq, nv, nc */ };

typedef struct manifold_scene {
  const char *name;
  void (*build)(baum_mechanism *mechanism);
  /* The same of ordinary bodies, and its q in terms of the scene's; or NULL. */
  void (*build_twin)(baum_mechanism *mechanism);
  void (*translate)(const double *twin_q, double *q);
  /* Or q at a time. */
  void (*solve)(double t, double *q);
  int degrees_of_freedom;
  bool gyroscopic; /* forces depend on velocities */
  struct {
    int first; /* of q */
    int count; /* one every four numbers, of quaternions every seven */
    int length;
  } units;            /* parts of q of unit length */
  int redundant_rows; /* 0 unless given */
} manifold_scene;

extern const manifold_scene manifold_scenes[MANIFOLD_SCENES];

/* Not among them: its motion crosses singular configurations. */
extern const manifold_scene manifold_crossing;

/* By name; fails the test if there is none. */
const manifold_scene *manifold_scene_find(const char *name);

/* Frozen; the caller destroys it. */
baum_mechanism *manifold_scene_make(const manifold_scene *scene);
baum_mechanism *manifold_scene_make_twin(const manifold_scene *scene);

/* q at a time, to 1e-10 or so: by the twin (rk8) or the solution. */
void manifold_scene_solve(const manifold_scene *scene, double t, double *q);

#endif
