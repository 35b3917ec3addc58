/* SPDX-License-Identifier: BSD-3-Clause */
/* Defines joints of random spatial mechanisms, both for the library and for the oracle. */
#ifndef BAUM_TEST_RANDOM_DEFINITIONS_H
#define BAUM_TEST_RANDOM_DEFINITIONS_H

#include "random_spatial.h"

/* Chooses a vector whose elements are at most `size`. */
void random_vector(chance *c, double size, double out[3]);
void wide_to_double(const wide x[3], double out[3]);
void wide_from_double(const double x[3], wide out[3]);

/* The first function returns whether a body has an orientation. The second one returns whether it
 * is a planar body or particle. */
bool random_turns(const oracle_body *b);
bool random_is_planar(const oracle_body *b);

/* Chooses points and axes on both bodies of `joint`, whose kind and bodies are set, and sets the
 * same points and axes in *def. The first function defines them by `point` in ground axes. The
 * second one defines them in body axes. `apart` is the vector from body_a's point to body_b's
 * point. The point and the axis are given in ground axes. */
void random_define_at_point(random_spatial *r, const double point[3], const double axis[3],
                            oracle_joint *joint, baum_spatial_revolute_def *def);
void random_define_on_bodies(random_spatial *r, const double point[3], const double axis[3],
                             const double apart[3], oracle_joint *joint,
                             baum_spatial_revolute_def *def);

#endif
