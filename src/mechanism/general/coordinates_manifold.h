/* SPDX-License-Identifier: BSD-3-Clause */
/* The configuration manifold of user coordinates whose positions do not form a vector. User
 * functions define this manifold. */
#ifndef BAUM_I_MECHANISM_GENERAL_COORDINATES_MANIFOLD_H
#define BAUM_I_MECHANISM_GENERAL_COORDINATES_MANIFOLD_H

#include "mechanism/general/user_function.h"

/* Return the manifold of a definition, or NULL if the positions are a vector. */
const baum_i_manifold *baum_i_coordinates_manifold(const void *def);

/* Return the number of positions of a definition. */
int baum_i_coordinates_positions(const baum_coordinates_def *def);

/* Check that a definition has either all functions of a manifold or none of them, and that its
 * initial q lies on the manifold. */
baum_status baum_i_coordinates_check_manifold(const baum_coordinates_def *def, const char *label);

/* Check that the user functions of a manifold agree with each other: `move` must match `rate` to
 * second order, and `difference` must be the inverse of `move`. */
baum_status baum_i_coordinates_compare_manifold(const baum_i_body *body, const baum_i_local *at);

#endif
