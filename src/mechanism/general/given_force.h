/* SPDX-License-Identifier: BSD-3-Clause */
/* The force of user coordinates or of a user force. User functions compute its value, its potential
 * and its derivatives. Derivatives for which there is no user function are computed by
 * differences.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_GIVEN_FORCE_H
#define BAUM_I_MECHANISM_GENERAL_GIVEN_FORCE_H

#include "mechanism/general/difference.h"

typedef struct baum_i_given_force {
  const baum_i_element *element;
  baum_force_fn *force;
  /* Derivatives with respect to q and v, in the order of baum_i_variable; or NULL. */
  baum_force_fn *by[2];
  baum_q_fn *potential; /* or NULL */
  bool depends_on_velocity;
  void *user;
} baum_i_given_force;

/* Initialize a baum_i_given_force from a definition that has members with the same names. */
#define BAUM_I_GIVEN_FORCE(ELEMENT, DEF)                                   \
  ((baum_i_given_force){.element = (ELEMENT),                              \
                        .force = (DEF)->force,                             \
                        .by = {(DEF)->force_q, (DEF)->force_v},            \
                        .potential = (DEF)->potential,                     \
                        .depends_on_velocity = (DEF)->depends_on_velocity, \
                        .user = (DEF)->user})

baum_status baum_i_given_force_at(const baum_i_given_force *given, const baum_i_local *at,
                                  double *out); /* (nl) */

/* Compute the derivative of the force with respect to q or v (nl x nl). Does nothing if out is
 * NULL. */
baum_status baum_i_given_force_block(const baum_i_given_force *given, const baum_i_local *at,
                                     baum_i_variable variable, double *out);

/* Add the potential [J] or the power [W] of the force to *sum. */
baum_status baum_i_given_force_potential(const baum_i_given_force *given, const baum_i_local *at,
                                         double *sum);
baum_status baum_i_given_force_power(const baum_i_given_force *given, const baum_i_local *at,
                                     double *sum);

/* Check the derivatives that user functions return, by finite differences. */
baum_status baum_i_given_force_check(const baum_i_given_force *given, const baum_i_local *at);

#endif
