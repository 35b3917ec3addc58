/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Functions that find the elements of a mechanism, by name or by number. Elements are numbered in
 *  the order in which they were added. The mechanism may be frozen or not. Use these functions for
 *  mechanisms that your program has not built itself, such as the mechanisms of the catalogue. For
 *  these functions, ground does not count as a body, and drivers, couplings and user constraints
 *  count as joints.
 */
#ifndef BAUM_ELEMENTS_H
#define BAUM_ELEMENTS_H

#include <stdint.h>

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Count the bodies. @param mechanism  may be NULL @return number of bodies; 0 for NULL */
BAUM_API int32_t baum_mechanism_body_count(const baum_mechanism *mechanism);

/** Count the joints. @param mechanism  may be NULL @return number of joints; 0 for NULL */
BAUM_API int32_t baum_mechanism_joint_count(const baum_mechanism *mechanism);

/** Count the forces, not including gravity.
 *  @param mechanism  may be NULL
 *  @return  number of forces; 0 for NULL */
BAUM_API int32_t baum_mechanism_force_count(const baum_mechanism *mechanism);

/** Find a body by number.
 *  @param mechanism  may be NULL
 *  @param k          number of the element, counted from 0; bodies, joints, forces and inputs are
 *                    counted separately
 *  @return  id of the element; all-zero if there is no such element */
BAUM_API baum_body_id baum_mechanism_body_at(const baum_mechanism *mechanism, int32_t k);

/** Find a joint by number. @copydetails baum_mechanism_body_at() */
BAUM_API baum_joint_id baum_mechanism_joint_at(const baum_mechanism *mechanism, int32_t k);

/** Find a force by number. @copydetails baum_mechanism_body_at() */
BAUM_API baum_force_id baum_mechanism_force_at(const baum_mechanism *mechanism, int32_t k);

/** Find an input by number. @copydetails baum_mechanism_body_at() */
BAUM_API baum_input_id baum_mechanism_input_at(const baum_mechanism *mechanism, int32_t k);

/** Find the first body with the given name; "ground" gives BAUM_GROUND if no body has this name.
 *  @param     mechanism  may be NULL
 *  @param[in] name       may be NULL
 *  @return  id of the element; all-zero if there is no such element */
BAUM_API baum_body_id baum_mechanism_find_body(const baum_mechanism *mechanism, const char *name);

/** Find the first joint with the given name. @copydetails baum_mechanism_find_body() */
BAUM_API baum_joint_id baum_mechanism_find_joint(const baum_mechanism *mechanism, const char *name);

/** Find the first force with the given name. @copydetails baum_mechanism_find_body() */
BAUM_API baum_force_id baum_mechanism_find_force(const baum_mechanism *mechanism, const char *name);

/** Find the first input with the given name. @copydetails baum_mechanism_find_body() */
BAUM_API baum_input_id baum_mechanism_find_input(const baum_mechanism *mechanism, const char *name);

/** Read the name of a force.
 *  @param mechanism  frozen or not
 *  @param force      a force of the mechanism
 *  @return  the name, owned by the mechanism; NULL for ids of other mechanisms */
BAUM_API const char *baum_mechanism_force_name(const baum_mechanism *mechanism,
                                               baum_force_id force);

#ifdef __cplusplus
}
#endif

#endif
