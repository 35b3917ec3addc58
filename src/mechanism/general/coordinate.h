/* SPDX-License-Identifier: BSD-3-Clause */
/* The coordinate of a joint, for those that are tied to one: drivers and couplings. */
#ifndef BAUM_I_MECHANISM_GENERAL_COORDINATE_H
#define BAUM_I_MECHANISM_GENERAL_COORDINATE_H

#include "mechanism/identify.h"

/* Check that a joint named in a definition exists and has a coordinate: BAUM_OK, or
 * BAUM_ERR_ARGUMENT with the message; purpose ends it: "to drive". */
baum_status baum_i_check_coordinate(const baum_mechanism *mechanism, baum_joint_id id,
                                    const char *label, const char *field, const char *purpose);

/* Its value in the design configuration; for `lower` functions of joints that were added after
 * it. */
double baum_i_design_coordinate(const baum_mechanism *mechanism, const baum_i_joint *joint);

#endif
