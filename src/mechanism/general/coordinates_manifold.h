/* SPDX-License-Identifier: BSD-3-Clause */
/* The manifold of user coordinates whose positions are not a vector, by user functions. */
#ifndef BAUM_I_MECHANISM_GENERAL_COORDINATES_MANIFOLD_H
#define BAUM_I_MECHANISM_GENERAL_COORDINATES_MANIFOLD_H

#include "mechanism/general/user_function.h"

/* The manifold of a definition; NULL: positions are a vector. */
const baum_i_manifold *baum_i_coordinates_manifold(const void *def);

/* Number of positions of a definition. */
int baum_i_coordinates_positions(const baum_coordinates_def *def);

/* Check that a definition has all functions of a manifold or none, and that its q lies on it. */
baum_status baum_i_coordinates_check_manifold(const baum_coordinates_def *def, const char *label);

/* Compare `move` with `rate`, to second order, and `difference` with `move`. */
baum_status baum_i_coordinates_compare_manifold(const baum_i_body *body, const baum_i_local *at);

#endif
