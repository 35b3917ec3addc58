/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism of two planar bodies and two particles at different places. Tests add joints and
 * forces between them. */
#ifndef BAUM_TEST_PLANAR_SCENE_H
#define BAUM_TEST_PLANAR_SCENE_H

#include <baum/planar.h>
#include <baum/planar_joints.h>

#include "point.h"

typedef struct planar_scene {
  baum_mechanism *mechanism; /* the caller destroys it */
  baum_body_id link;
  baum_body_id crank;
  baum_body_id ball;
  baum_body_id bead;
} planar_scene;

planar_scene planar_scene_make(void);

/* Returns a point in the axes of a body or of ground. For a particle this point is the origin, and
 * for all other bodies it is not. */
void planar_scene_arm(const planar_scene *scene, baum_body_id body, double arm[2]);

/* Adds an element between the bodies a and b. This element is the one that is tested. */
typedef void planar_add_fn(planar_scene *scene, baum_body_id a, baum_body_id b);
typedef void planar_check_fn(test_point *p);

/* Calls `check` for every pair of bodies, at 20 random states. Ground is one of the bodies, and
 * particles are included if `particles` is true. Each mechanism has the element twice: first
 * between the bodies of the pair, and then between crank and ground. */
void for_each_planar_pair(planar_add_fn *add, bool particles, planar_check_fn *check);

/* Sets the two bodies and the two points of a definition. */
#define PLANAR_BETWEEN(scene, def, a, b)            \
  do {                                              \
    (def)->body_a = (a);                            \
    (def)->body_b = (b);                            \
    planar_scene_arm((scene), (a), (def)->point_a); \
    planar_scene_arm((scene), (b), (def)->point_b); \
  } while (0)

#endif
