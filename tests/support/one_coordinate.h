/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism with one coordinate of unit mass, x'' = force. */
#ifndef BAUM_TEST_ONE_COORDINATE_H
#define BAUM_TEST_ONE_COORDINATE_H

#include <baum/mechanism.h>

/* Frozen, with the characteristic length 1, from position x with velocity v; the caller destroys
 * it. input: receives a new input of value 0; NULL for none. */
baum_mechanism *one_coordinate(double x, double v, baum_force_fn *force, void *user,
                               baum_input_id *input);

#endif
