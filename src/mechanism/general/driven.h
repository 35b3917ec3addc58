/* SPDX-License-Identifier: BSD-3-Clause */
/* The part that all drivers have in common. A driver has one row, which prescribes the coordinate
 * c(q) of another joint to be s(t):
 *
 *   Phi = c(q) - s(t),   J = c_q,   nu = s',   gamma = s'' - (c_q v)_q v,   nu_q = 0
 *
 * The type of the driven joint computes c, c_q and their derivatives. The driver acts on the
 * bodies of the driven joint.
 *
 * The parameters of every driver begin with the coefficients of a polynomial in t - t0. While the
 * polynomial is active, it determines s(t). It is active in two cases: if the definition gives a
 * polynomial, and if a run has replaced the law in its own copy of the parameters.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_DRIVEN_H
#define BAUM_I_MECHANISM_GENERAL_DRIVEN_H

#include "mechanism/general/coordinate.h"

/* The names of those fields of a driver's definition that select the driven coordinate. */
extern const baum_i_coordinate_fields baum_i_driver_fields;

/* Indices of the first parameters of a driver. The parameters of the particular type follow
 * them. */
enum {
  BAUM_I_DRIVER_S, /* s, s' and s'' at t0 */
  BAUM_I_DRIVER_DS,
  BAUM_I_DRIVER_DDS,
  BAUM_I_DRIVER_T0,
  BAUM_I_DRIVER_POLYNOMIAL, /* 1 if s is the polynomial, 0 if s is the type's `motion` */
  BAUM_I_DRIVER_NUMBERS
};

/* Replaces s(t) by the polynomial s[0] + s[1] (t - t0) + s[2] (t - t0)^2 / 2, by changing the
 * parameters of the driver. */
void baum_i_driver_replace_law(double *parameters, double t0, const double s[3]);

/* Sets the expected value of each driven angle of a spatial joint to the value that its driver
 * prescribes at time t. If an angle has several drivers, the last one is used. */
baum_status baum_i_expect_driven_angles(baum_i_point *point, double t);

/* Checks that the three numbers in s, which are value, rate and acceleration, are finite. The
 * message names the user function `source`, for example "law()". */
baum_status baum_i_check_motion(const baum_i_joint *driver, baum_i_point *point, const char *source,
                                const double s[3]);

/* ---- members of the type struct ---- */

#define BAUM_I_DRIVER_MEMBERS(DRIVEN, MOTION)                                               \
  .driven = (DRIVEN), .motion = (MOTION), .replace_law = baum_i_driver_replace_law,         \
  .row_count = 1, .evaluate = baum_i_evaluate_each, .evaluate_one = baum_i_driver_evaluate, \
  .linearize = baum_i_driver_linearize, .place = baum_i_driver_place,                       \
  .force_on_b = baum_i_driver_force_on_b

baum_status baum_i_driver_evaluate(const baum_i_joint *joint, baum_i_point *point,
                                   const baum_i_rows *out);

baum_status baum_i_driver_linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                                    const double *lambda, const baum_i_joint_blocks *blocks);
void baum_i_driver_place(const baum_i_joint *joint, const baum_i_point *point, double at[3]);
void baum_i_driver_force_on_b(const baum_i_joint *joint, const baum_i_point *point,
                              const double *lambda, double six[BAUM_I_SPACE]);

#endif
