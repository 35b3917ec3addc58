/* SPDX-License-Identifier: BSD-3-Clause */
/* Adds further elements to a random spatial mechanism: bodies on screws, constant-velocity joints,
 * rolling discs and knife edges, loops of these joints, couplings such as gears and belts, user
 * constraints of velocity level, torsion springs and bushings. The last of these elements are
 * spatial knife edges, a body with a point on a curve, and cables. */
#ifndef BAUM_TEST_RANDOM_FURTHER_H
#define BAUM_TEST_RANDOM_FURTHER_H

#include "random_spatial.h"

void random_spatial_add_further(random_spatial *r);

#endif
