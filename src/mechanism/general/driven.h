/* SPDX-License-Identifier: BSD-3-Clause */
/* Common part of drivers: one row that prescribes the coordinate c(q) of another joint.
 *
 *   Phi = c(q) - s(t),   J = c_q,   nu = s',   gamma = s'' - (c_q v)_q v,   nu_q = 0
 *
 * The type of the driven joint gives c, c_q and their derivatives. The driver acts on the same
 * bodies.
 *
 * The numbers of every driver begin with those of a polynomial in t - t0. While it is active the
 * polynomial is the motion. It is active from the start if the definition gives it, or because a
 * run replaced the law in its own copy of the numbers.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_DRIVEN_H
#define BAUM_I_MECHANISM_GENERAL_DRIVEN_H

#include "mechanism/identify.h"

/* The fields that the definition of every driver begins with. */
typedef struct baum_i_driver_head {
  size_t struct_size;
  const char *name;
  baum_joint_id joint;
} baum_i_driver_head;

/* Numbers; those of the type itself follow. */
enum {
  BAUM_I_DRIVER_S, /* at t0 */
  BAUM_I_DRIVER_DS,
  BAUM_I_DRIVER_DDS,
  BAUM_I_DRIVER_T0,
  BAUM_I_DRIVER_POLYNOMIAL, /* 1: active; 0: the type's motion is */
  BAUM_I_DRIVER_NUMBERS
};

/* Make a polynomial the motion; the replace_law of types. */
void baum_i_driver_replace_law(double *parameters, double t0, const double s[3]);

/* Check that s is finite. The message names the source: "law()". */
baum_status baum_i_check_motion(const baum_i_joint *driver, baum_i_point *point, const char *source,
                                const double s[3]);

/* ---- members of the type struct ---- */

#define BAUM_I_DRIVER_MEMBERS(MOTION)                                                       \
  .driven = baum_i_driven_by, .motion = (MOTION), .replace_law = baum_i_driver_replace_law, \
  .row_count = 1, .evaluate = baum_i_evaluate_each, .evaluate_one = baum_i_driver_evaluate, \
  .linearize = baum_i_driver_linearize, .place = baum_i_driver_place,                       \
  .force_on_b = baum_i_driver_force_on_b

const baum_i_joint *baum_i_driven_by(const baum_mechanism *mechanism, const void *def);
baum_status baum_i_driver_evaluate(const baum_i_joint *joint, baum_i_point *point,
                                   const baum_i_rows *out);

/* Check of the joint alone. */
baum_status baum_i_driver_check(const baum_mechanism *mechanism, const void *def,
                                const char *label);
baum_status baum_i_driver_linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                                    const double *lambda, const baum_i_joint_blocks *blocks);
void baum_i_driver_place(const baum_i_joint *joint, const baum_i_point *point, double at[3]);
void baum_i_driver_force_on_b(const baum_i_joint *joint, const baum_i_point *point,
                              const double *lambda, double six[BAUM_I_SPACE]);

#endif
