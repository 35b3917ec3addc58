/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks the derivatives that user functions return, by finite differences. The file check.c
 * describes when a derivative is accepted. */
#ifndef BAUM_I_MECHANISM_GENERAL_CHECK_H
#define BAUM_I_MECHANISM_GENERAL_CHECK_H

#include "mechanism/general/difference.h"

/* A derivative that a user function returned and that is to be checked. */
typedef struct baum_i_claim {
  /* The function "jacobian", for example, with the shape of its output. */
  const baum_i_user_function *function;
  /* The name of the function that was differentiated, for example "phi". */
  const char *source;
  const double *given; /* the values that the function returned */
} baum_i_claim;

/* Compare a claim with differences of a field (function) along a ray (straight line), see
 * difference.h. The stencil (difference formula) determines whether these are first or second
 * derivatives. Returns BAUM_OK if the values agree, or if the differences are too inaccurate to
 * decide. Otherwise returns BAUM_ERR_ARGUMENT with a message like `joint 2 "circle": gamma()[0] is
 * 3 but finite differences of phi give 2`. */
baum_status baum_i_compare_ray(const baum_i_claim *claim, const baum_i_stencil *stencil,
                               const baum_i_field *field, const baum_i_ray *ray,
                               const baum_i_local *at);

/* Compare a claim (size x nl) with differences of a field with respect to q or v. */
baum_status baum_i_compare_columns(const baum_i_claim *claim, const baum_i_field *field,
                                   baum_i_variable variable, const baum_i_local *at);

/* Indices of two entries of the output of one function. The entry number `entry` must be the
 * derivative of the entry number `of`. */
typedef struct baum_i_derived {
  int entry;
  int of;
} baum_i_derived;

/* For each pair, compare entry number `entry` of the output of a function with differences of entry
 * number `of` along a ray. The output has field->size entries. If the function fails at the point
 * `at`, its status is returned. */
baum_status baum_i_compare_entries(const baum_i_user_function *function, const char *source,
                                   const baum_i_field *field, const baum_i_derived *pairs,
                                   int pair_count, const baum_i_ray *ray, const baum_i_local *at);

/* Check that a function does not depend on velocities, by comparing its values at the point `at`
 * with its values at zero velocities. */
baum_status baum_i_compare_with_rest(const baum_i_user_function *function,
                                     const baum_i_field *field, const baum_i_local *at);

/* ---- during a run ---- */

/* Tell whether a mechanism has user functions that baum_mechanism_check_derivatives() checks. */
bool baum_i_has_checked_functions(const baum_mechanism *mechanism);

/* A state of a run, at which functions are checked. */
typedef struct baum_i_run_state {
  double t;
  const double *q;
  const double *v;
  double unit;    /* [s] time in which the motion changes */
  double *beside; /* (nq) memory for a point near this state */
} baum_i_run_state;

/* Check all user functions of the mechanism at a state. Functions that fail there are not checked.
 * Sets the point to the state. Returns BAUM_OK, or BAUM_ERR_ARGUMENT after setting the message. In
 * this case *joint is the number of the joint with the wrong function, or -1 for other elements. */
baum_status baum_i_check_at(baum_i_point *point, const baum_i_run_state *at, int *joint);

#endif
