/* SPDX-License-Identifier: BSD-3-Clause */
/* Adds drivers and springs to coordinates of the joints of a random spatial mechanism. */
#ifndef BAUM_TEST_RANDOM_COORDINATES_H
#define BAUM_TEST_RANDOM_COORDINATES_H

#include "random_spatial.h"

/* Draws a joint and adds a driver to it, unless it has no coordinate or already has a driver. */
void random_spatial_add_driver(random_spatial *r);

/* Adds a joint spring whose free value differs by up to 1 from the design coordinate. */
void random_spatial_add_joint_spring(random_spatial *r);

#endif
