/* SPDX-License-Identifier: BSD-3-Clause */
/* Adds drivers and springs to coordinates of the joints of a random spatial mechanism. */
#ifndef BAUM_TEST_RANDOM_COORDINATES_H
#define BAUM_TEST_RANDOM_COORDINATES_H

#include "random_spatial.h"

/* Chooses a random joint and adds a driver to it. If the joint has no coordinate or already has a
 * driver, nothing is added. */
void random_spatial_add_driver(random_spatial *r);

/* Adds a joint spring to a random coordinate of a random joint. The free value of the spring
 * differs by up to 1 from the value of this coordinate in the design configuration. If the joint
 * has no coordinate, nothing is added. */
void random_spatial_add_joint_spring(random_spatial *r);

/* Couples two random coordinates, such as the angles of two gears, the angle of a gear and the
 * displacement of a rack, or the two coordinates of one joint. If a chosen joint has no coordinate
 * or already has a driver, nothing is added. */
void random_spatial_add_coupling(random_spatial *r);

#endif
