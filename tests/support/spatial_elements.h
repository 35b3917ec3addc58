/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism with bodies of all kinds, and a list of all spatial elements that can be added
 * between two of the bodies. */
#ifndef BAUM_TEST_SPATIAL_ELEMENTS_H
#define BAUM_TEST_SPATIAL_ELEMENTS_H

#include <baum/baum.h>

enum { SPATIAL_SCENE_BODIES = 6 };

/* Ground, two spatial bodies, a spatial particle, a planar body and a planar particle. */
typedef struct spatial_scene {
  baum_mechanism *mechanism;
  baum_body_id bodies[SPATIAL_SCENE_BODIES];
} spatial_scene;

/* If `spheres` is set, the spatial bodies have no gyroscopic moments. The derivatives of forces do
 * not include gyroscopic moments. Forces are therefore tested between spheres. */
spatial_scene spatial_scene_make(bool spheres);
bool spatial_scene_is_particle(int body);

typedef struct spatial_element {
  const char *name;
  void (*add)(spatial_scene *s, int a, int b);
  bool particle_a, particle_b; /* whether body a or body b may be a particle */
  bool force;
  bool has_angle; /* whether a row depends on the angle of the joint */
} spatial_element;

enum { SPATIAL_ELEMENTS = 23 };
extern const spatial_element spatial_elements[SPATIAL_ELEMENTS];

/* Adds the element with this name. */
void spatial_scene_add(spatial_scene *s, const char *name, int a, int b);

#endif
