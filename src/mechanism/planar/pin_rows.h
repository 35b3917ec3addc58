/* SPDX-License-Identifier: BSD-3-Clause */
/* The two rows that make two markers coincide: all rows of the revolute joint, and the first two
 * rows of the fixed joint. */
#ifndef BAUM_I_MECHANISM_PLANAR_PIN_ROWS_H
#define BAUM_I_MECHANISM_PLANAR_PIN_ROWS_H

#include "mechanism/planar/planar_rows.h"

void baum_i_pin_phi(const baum_i_planar_pair *pair, double *phi);
void baum_i_pin_jacobian(const baum_i_planar_pair *pair, double *six);
void baum_i_pin_gamma(const baum_i_planar_pair *pair, double *gamma);
void baum_i_pin_linearize(const baum_i_planar_pair *pair, const double *w, const double *lambda,
                          baum_i_planar_blocks *out);

#endif
