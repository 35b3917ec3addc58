/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares derivatives that user functions return with finite differences. check.c describes the
 * criterion. */
#ifndef BAUM_I_MECHANISM_GENERAL_CHECK_H
#define BAUM_I_MECHANISM_GENERAL_CHECK_H

#include "mechanism/general/difference.h"

/* A derivative that a user function returned, to be checked. */
typedef struct baum_i_claim {
  const baum_i_user_function *function; /* "jacobian", with its shape */
  const char *source;                   /* name of the function of which it is the derivative,
                                         * "phi" */
  const double *given;                  /* its values at this point */
} baum_i_claim;

/* Compare a claim with the first or second derivative (as the stencil says) of a field along a ray
 * (difference.h). Returns BAUM_OK if they agree or if differences are too inaccurate to decide, or
 * BAUM_ERR_ARGUMENT with a message like `joint 2 "circle": gamma()[0] is 3 but differences of phi
 * give 2`. */
baum_status baum_i_compare_ray(const baum_i_claim *claim, const baum_i_stencil *stencil,
                               const baum_i_field *field, const baum_i_ray *ray,
                               const baum_i_local *at);

/* Compare a claim (size x nl) with the derivatives of a field with respect to q or v. */
baum_status baum_i_compare_columns(const baum_i_claim *claim, const baum_i_field *field,
                                   baum_i_variable variable, const baum_i_local *at);

/* Indices of two entries of the output of a function: `entry` is the derivative of the entry
 * `of`. */
typedef struct baum_i_derived {
  int entry;
  int of;
} baum_i_derived;

/* For each pair, compare an entry of the output of a function with the derivative of the other
 * entry along a ray. The output has field->size entries. If the function fails at this point, its
 * status is returned. */
baum_status baum_i_compare_entries(const baum_i_user_function *function, const char *source,
                                   const baum_i_field *field, const baum_i_derived *pairs,
                                   int pair_count, const baum_i_ray *ray, const baum_i_local *at);

/* Check that a function does not depend on velocities: compare its values with those at rest. */
baum_status baum_i_compare_with_rest(const baum_i_user_function *function,
                                     const baum_i_field *field, const baum_i_local *at);

#endif
