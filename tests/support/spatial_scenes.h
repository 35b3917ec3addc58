/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms of spatial elements. One of them is a planar four-bar in a tilted plane, and the
 * others are truly spatial. */
#ifndef BAUM_TEST_SPATIAL_SCENES_H
#define BAUM_TEST_SPATIAL_SCENES_H

#include <baum/baum.h>

/* A four-bar of three moving links. Its joints are spatial revolute joints, so three rows are
 * redundant. */
void spatial_build_four_bar(baum_mechanism *m);
void spatial_build_planar_four_bar(baum_mechanism *m);
void spatial_translate_four_bar(const double *twin_q, double *q);

/* A four-bar in space (RSSR). A crank about z starts at 12 rad/s. A coupler between spherical
 * joints can also rotate about its own axis. A rocker rotates about x. The inertia tensors have
 * products of inertia. */
enum { SPATIAL_RSSR_NQ = 21, SPATIAL_RSSR_NV = 18 };
void spatial_build_rssr(baum_mechanism *m);
baum_mechanism *spatial_make_rssr(void); /* the mechanism is frozen, and the caller destroys it */

/* A nut on a screw drives a wheel, on which a joint spring acts. In 0.5 s, the wheel makes more
 * than half a revolution. Its exact motion is known. */
void spatial_build_screw(baum_mechanism *mechanism);
void spatial_solve_screw(double t, double *q);

#endif
