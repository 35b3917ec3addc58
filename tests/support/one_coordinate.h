/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism of one coordinate of unit mass, x'' = force. */
#ifndef BAUM_TEST_ONE_COORDINATE_H
#define BAUM_TEST_ONE_COORDINATE_H

#include <baum/mechanism.h>

/* Frozen, of scale 1, from x with the rate v; destroy it. input: receives an input of value 0,
 * NULL: there is none. */
baum_mechanism *one_coordinate(double x, double v, baum_force_fn *force, void *user,
                               baum_input_id *input);

#endif
