/* SPDX-License-Identifier: BSD-3-Clause */
/* Spatial mechanisms of the stress grid with elements that the catalogue does not have. Their
 * coordinates are functions of one angle x, as in all spatial mechanisms of the grid (space.c).
 * Gravity acts along -z.
 *
 *   wheel    an unbalanced wheel rolls on a plane, and moves a slider by its axle
 *   disc     a tilted disc rolls on a circle, in steady motion; x is the angle of its spin
 *   screw    an unbalanced spindle moves a nut
 *   shafts   a constant-velocity joint connects an unbalanced shaft and an inclined shaft
 *   bushing  a pendulum on a revolute joint, with a bushing between it and the ground
 *   bead     a bead on a helix, pulled by a cable that runs over a point of the ground
 */
#ifndef BAUM_TEST_ELEMENTS_H
#define BAUM_TEST_ELEMENTS_H

#include "carried.h"
#include "scene.h"

int elements_bodies(const scene *s);
carried elements_body(const scene *s, int body, jets x);
/* Returns the mass and the moments of inertia of a body. */
void elements_inertia(const scene *s, int body, long double out[4]);
/* Returns the torque of the cable in the scene `bead`, and the torque of the bushing in the other
 * scenes. */
long double elements_torque(const scene *s, long double x, long double v);
baum_status elements_build(const scene *s, baum_mechanism **out);

#endif
