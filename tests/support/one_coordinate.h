/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism with one coordinate x and unit mass, so that x'' = force. */
#ifndef BAUM_TEST_ONE_COORDINATE_H
#define BAUM_TEST_ONE_COORDINATE_H

#include <baum/mechanism.h>

/* Returns the frozen mechanism, which the caller destroys. Its characteristic length is 1 m, and it
 * starts at x with the velocity v. Unless `input` is NULL, *input is set to a new input whose value
 * is 0. */
baum_mechanism *one_coordinate(double x, double v, baum_force_fn *force, void *user,
                               baum_input_id *input);

#endif
