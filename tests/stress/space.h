/* SPDX-License-Identifier: BSD-3-Clause */
/* The spatial mechanisms of the stress grid: entries of the catalogue whose exact motion follows
 * from one equation for one angle, and planar scenes in a tilted plane. A body has seven
 * coordinates: x, y, z [m] and the quaternion. */
#ifndef BAUM_TEST_SPACE_H
#define BAUM_TEST_SPACE_H

#include "scene.h"

enum { SPACE_NUMBERS = 7 };

/* Returns whether bodies of the scene have seven coordinates. */
bool space_is(const scene *s);
int space_bodies(const scene *s);
/* Pose of a body in an entry of the catalogue at the angle x. */
void space_pose(const scene *s, int body, long double x, long double pose[SPACE_NUMBERS]);
long double space_acceleration(const scene *s, long double x, long double v);
baum_status space_build(const scene *s, baum_mechanism **out);

/* Converts x, y, angle in the tilted plane to a pose in space. */
void space_tilt(const long double flat[3], long double pose[SPACE_NUMBERS]);
/* Distance of two poses: the larger of distance / `scale` and the angle of rotation in radians. */
double space_distance(const long double *a, const long double *b, double scale);

#endif
