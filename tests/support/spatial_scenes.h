/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms of spatial elements: a planar four-bar in a tilted plane, and spatial mechanisms. */
#ifndef BAUM_TEST_SPATIAL_SCENES_H
#define BAUM_TEST_SPATIAL_SCENES_H

#include <baum/baum.h>

/* A four-bar of three moving links. Its spatial revolute joints have three redundant rows. */
void spatial_build_four_bar(baum_mechanism *m);
void spatial_build_planar_four_bar(baum_mechanism *m);
void spatial_translate_four_bar(const double *twin_q, double *q);

/* A four-bar in space (RSSR): a crank about z that starts at 12 rad/s, a coupler between spherical
 * joints, which can also rotate about its own axis, and a rocker about x. The inertia tensors have
 * products of inertia. */
enum { SPATIAL_RSSR_NQ = 21, SPATIAL_RSSR_NV = 18 };
void spatial_build_rssr(baum_mechanism *m);
baum_mechanism *spatial_make_rssr(void); /* frozen; the caller destroys it */

/* A nut on a screw, which drives a wheel with a torsion spring by more than half a revolution in
 * 0.5 s, and its exact motion. */
void spatial_build_screw(baum_mechanism *mechanism);
void spatial_solve_screw(double t, double *q);

#endif
