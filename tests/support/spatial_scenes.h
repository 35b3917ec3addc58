/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms of spatial elements in a tilted plane, and their planar twins. */
#ifndef BAUM_TEST_SPATIAL_SCENES_H
#define BAUM_TEST_SPATIAL_SCENES_H

#include <baum/baum.h>

/* A four-bar of three moving links, whose revolute joints have three redundant rows. */
void spatial_build_four_bar(baum_mechanism *m);
void spatial_build_planar_four_bar(baum_mechanism *m);
void spatial_translate_four_bar(const double *twin_q, double *q);

#endif
