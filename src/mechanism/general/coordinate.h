/* SPDX-License-Identifier: BSD-3-Clause */
/* The coordinate of a joint, which drivers and couplings use. */
#ifndef BAUM_I_MECHANISM_GENERAL_COORDINATE_H
#define BAUM_I_MECHANISM_GENERAL_COORDINATE_H

#include "mechanism/identify.h"

/* Check that a joint in a definition exists and has a coordinate: BAUM_OK or BAUM_ERR_ARGUMENT. The
 * purpose, such as "to drive", ends the message. */
baum_status baum_i_check_coordinate(const baum_mechanism *mechanism, baum_joint_id id,
                                    const char *label, const char *field, const char *purpose);

/* Value of the coordinate in the design configuration. Only joints added later may call it, in
 * `lower`. */
double baum_i_design_coordinate(const baum_mechanism *mechanism, const baum_i_joint *joint);

#endif
