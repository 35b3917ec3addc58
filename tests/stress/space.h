/* SPDX-License-Identifier: BSD-3-Clause */
/* The spatial mechanisms of the stress grid. Some are entries of the catalogue whose exact motion
 * follows from one equation for one angle. Others are in elements.h. The rest are planar scenes in
 * a tilted plane. A body has seven coordinates: x, y, z [m] and the quaternion. */
#ifndef BAUM_TEST_SPACE_H
#define BAUM_TEST_SPACE_H

#include "scene.h"

enum { SPACE_NUMBERS = 7 };

/* Returns whether the bodies of a scene have seven coordinates. */
bool space_is(const scene *s);
int space_bodies(const scene *s);
/* Computes the pose of a body at the angle x, for a scene that is not in a tilted plane. */
void space_pose(const scene *s, int body, long double x, long double pose[SPACE_NUMBERS]);
long double space_acceleration(const scene *s, long double x, long double v);
baum_status space_build(const scene *s, baum_mechanism **out);

/* Converts x, y, angle in the tilted plane to a pose in space. */
void space_tilt(const long double flat[3], long double pose[SPACE_NUMBERS]);
/* Returns the distance between two poses. This is the distance of their positions divided by
 * `scale`, or the angle of rotation between them in radians, whichever is larger. */
double space_distance(const long double *a, const long double *b, double scale);

#endif
