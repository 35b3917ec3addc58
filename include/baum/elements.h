/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  What a mechanism consists of, frozen or not: bodies, joints, forces and inputs in the order of
 *  adding, and by name. For mechanisms that somebody else has put together, such as those of the
 *  catalogue. Ground is not among the bodies, drivers and user constraints are joints. An id that
 *  is not there is "none", all-zero.
 */
#ifndef BAUM_ELEMENTS_H
#define BAUM_ELEMENTS_H

#include <stdint.h>

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Number of bodies; 0 for NULL. */
BAUM_API int32_t baum_mechanism_body_count(const baum_mechanism *mechanism);

/** Number of joints; 0 for NULL. */
BAUM_API int32_t baum_mechanism_joint_count(const baum_mechanism *mechanism);

/** Number of forces, gravity not among them; 0 for NULL. */
BAUM_API int32_t baum_mechanism_force_count(const baum_mechanism *mechanism);

/** Body k, 0 to baum_mechanism_body_count() - 1; none for NULL and other k. */
BAUM_API baum_body_id baum_mechanism_body_at(const baum_mechanism *mechanism, int32_t k);

/** Joint k, likewise. */
BAUM_API baum_joint_id baum_mechanism_joint_at(const baum_mechanism *mechanism, int32_t k);

/** Force k, likewise. */
BAUM_API baum_force_id baum_mechanism_force_at(const baum_mechanism *mechanism, int32_t k);

/** Input k, 0 to baum_mechanism_input_count() - 1, likewise. */
BAUM_API baum_input_id baum_mechanism_input_at(const baum_mechanism *mechanism, int32_t k);

/** The first body of that name, "ground" too; none for NULL and when there is none. */
BAUM_API baum_body_id baum_mechanism_find_body(const baum_mechanism *mechanism, const char *name);

/** The first joint of that name, likewise. */
BAUM_API baum_joint_id baum_mechanism_find_joint(const baum_mechanism *mechanism, const char *name);

/** The first force of that name, likewise. */
BAUM_API baum_force_id baum_mechanism_find_force(const baum_mechanism *mechanism, const char *name);

/** The first input of that name, likewise. */
BAUM_API baum_input_id baum_mechanism_find_input(const baum_mechanism *mechanism, const char *name);

/** Name of a force, owned by the mechanism; NULL when the id is not one of its forces. */
BAUM_API const char *baum_mechanism_force_name(const baum_mechanism *mechanism,
                                               baum_force_id force);

#ifdef __cplusplus
}
#endif

#endif
