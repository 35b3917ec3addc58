/* SPDX-License-Identifier: BSD-3-Clause */
/* Gravity on bodies whose first coordinates are those of the centre of mass and whose first
 * parameter is the mass. */
#ifndef BAUM_I_MECHANISM_PLANAR_GRAVITY_H
#define BAUM_I_MECHANISM_PLANAR_GRAVITY_H

#include "mechanism/identify.h"

/* Place of the mass among a body's parameters. */
enum { BAUM_I_GRAVITY_MASS = 0 };

baum_status baum_i_gravity_force(const baum_i_body_group *group, baum_i_point *point,
                                 double *force);
baum_status baum_i_gravity_potential(const baum_i_body *body, baum_i_point *point, double *sum);

#endif
