/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism with one coordinate x of unit mass: x'' = force. */
#ifndef BAUM_TEST_ONE_COORDINATE_H
#define BAUM_TEST_ONE_COORDINATE_H

#include <baum/mechanism.h>

/* Returns the frozen mechanism, which the caller destroys. It has the characteristic length 1 m and
 * starts at x with velocity v. *input receives a new input with the value 0, unless `input` is
 * NULL. */
baum_mechanism *one_coordinate(double x, double v, baum_force_fn *force, void *user,
                               baum_input_id *input);

#endif
