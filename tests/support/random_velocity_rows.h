/* SPDX-License-Identifier: BSD-3-Clause */
/* Adds rows of velocity level to a random planar mechanism. */
#ifndef BAUM_TEST_RANDOM_VELOCITY_ROWS_H
#define BAUM_TEST_RANDOM_VELOCITY_ROWS_H

#include "random_mechanism.h"

/* Adds a knife edge between two random bodies that have an angle, or user constraints of velocity
 * level on random bodies. Sometimes a knife edge is added twice, which makes a row redundant. If
 * both random bodies are ground, nothing is added. */
void random_mechanism_add_velocity_rows(random_mechanism *r);

/* Returns whether a row is of velocity level. */
bool random_mechanism_is_velocity_row(const random_mechanism *r, int row);

#endif
