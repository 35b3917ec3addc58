/* SPDX-License-Identifier: BSD-3-Clause */
/* What drivers share: one row that prescribes the coordinate c(q) of another joint.
 *
 *   Phi = c(q) - s(t),   J = c_q,   nu = s',   gamma = s'' - (c_q v)_q v,   nu_q = 0
 *
 * c, c_q and their derivatives are those of the driven joint's type;
 * the driver acts on the same bodies.
 *
 * The numbers of every driver begin with those of a polynomial in t - t0. Where it is in
 * force it is the motion: from the start when the definition gives one, or because a run has put it
 * in the place of what the definition gives, in a copy of the numbers of its own.
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
  BAUM_I_DRIVER_POLYNOMIAL, /* 1: in force, 0: the type's motion is */
  BAUM_I_DRIVER_NUMBERS
};

/* Put a polynomial in force; the replace_law of types. */
void baum_i_driver_replace_law(double *parameters, double t0, const double s[3]);

/* Check that s is finite; source says in the message where it comes from: "law()". */
baum_status baum_i_check_motion(const baum_i_joint *driver, baum_i_point *point, const char *source,
                                const double s[3]);

/* ---- members of the type struct ---- */

#define BAUM_I_DRIVER_MEMBERS(MOTION)                                                           \
  .planar = true, .drives = true, .motion = (MOTION), .replace_law = baum_i_driver_replace_law, \
  .row_count = 1, .evaluate = baum_i_evaluate_each, .evaluate_one = baum_i_driver_evaluate,     \
  .linearize = baum_i_driver_linearize, .place = baum_i_driver_place

baum_status baum_i_driver_evaluate(const baum_i_joint *joint, baum_i_point *point,
                                   const baum_i_rows *out);

/* Check of the joint alone. */
baum_status baum_i_driver_check(const baum_mechanism *mechanism, const void *def,
                                const char *label);
baum_status baum_i_driver_linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                                    const double *lambda, const baum_i_joint_blocks *blocks);
void baum_i_driver_place(const baum_i_joint *joint, const baum_i_point *point, double at[2]);

#endif
