/* SPDX-License-Identifier: BSD-3-Clause */
/* User coordinates whose positions are not a vector: their manifold by functions of the user. */
#ifndef BAUM_I_MECHANISM_GENERAL_COORDINATES_MANIFOLD_H
#define BAUM_I_MECHANISM_GENERAL_COORDINATES_MANIFOLD_H

#include "mechanism/general/user_function.h"

/* NULL: the definition has none. */
const baum_i_manifold *baum_i_coordinates_manifold(const void *def);

/* Number of positions of a definition. */
int baum_i_coordinates_positions(const baum_coordinates_def *def);

/* Whether a definition has the functions, and its q is on the manifold. */
baum_status baum_i_coordinates_check_manifold(const baum_coordinates_def *def, const char *label);

/* Compare the functions with each other: `move` with `rate`, to second order, and `difference` with
 * `move`. */
baum_status baum_i_coordinates_compare_manifold(const baum_i_body *body, const baum_i_local *at);

#endif
