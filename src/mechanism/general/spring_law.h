/* SPDX-License-Identifier: BSD-3-Clause */
/* Common part of springs: the tension T as a function of a length l and its rate l'. For a torsion
 * spring, l is an angle; for a joint spring, it is a coordinate of a joint.
 *
 *   T = k (l - l_0) + c l' with the potential V = k (l - l_0)^2 / 2, or a user's T(l, l') without V
 */
#ifndef BAUM_I_MECHANISM_GENERAL_SPRING_LAW_H
#define BAUM_I_MECHANISM_GENERAL_SPRING_LAW_H

#include <baum/mechanism.h>

#include "mechanism/identify.h"

/* Parameters of a linear spring, in this order. */
enum { BAUM_I_STIFFNESS, BAUM_I_DAMPING, BAUM_I_FREE_LENGTH, BAUM_I_SPRING_NUMBERS };

typedef struct baum_i_spring_law {
  const baum_i_element *element;
  const double *numbers; /* (BAUM_I_SPRING_NUMBERS) */
  baum_spring_fn *law;   /* user function that is used instead of `numbers`, or NULL */
  void *user;
  bool depends_on_rate; /* whether the law depends on l' */
} baum_i_spring_law;

/* T and its derivatives with respect to l and l'. */
typedef struct baum_i_tension {
  double value;
  double by_length;
  double by_rate;
} baum_i_tension;

/* Call the user function. Returns BAUM_OK, BAUM_ERR_CALLBACK or BAUM_ERR_NOT_FINITE. */
baum_status baum_i_call_spring_law(const baum_i_spring_law *spring, baum_i_point *point,
                                   double length, double rate, baum_i_tension *out);

static inline baum_status baum_i_tension_at(const baum_i_spring_law *spring, baum_i_point *point,
                                            double length, double rate, baum_i_tension *out)
{
  if (spring->law) {
    return baum_i_call_spring_law(spring, point, length, rate, out);
  }
  const double *n = spring->numbers;
  out->value = n[BAUM_I_STIFFNESS] * (length - n[BAUM_I_FREE_LENGTH]) + n[BAUM_I_DAMPING] * rate;
  out->by_length = n[BAUM_I_STIFFNESS];
  out->by_rate = n[BAUM_I_DAMPING];
  return BAUM_OK;
}

/* Return V, or 0 for a user function. */
static inline double baum_i_spring_potential(const baum_i_spring_law *spring, double length)
{
  double stretch = length - spring->numbers[BAUM_I_FREE_LENGTH];
  return spring->law ? 0.0 : 0.5 * spring->numbers[BAUM_I_STIFFNESS] * stretch * stretch;
}

/* Add the power of the tension, except the part that changes V. For a user function, all of it is
 * added. */
static inline baum_status baum_i_spring_power(const baum_i_spring_law *spring, baum_i_point *point,
                                              double length, double rate, double sum[BAUM_I_POWERS])
{
  if (!spring->law) {
    sum[BAUM_I_POWER_DAMPERS] -= spring->numbers[BAUM_I_DAMPING] * rate * rate;
    return BAUM_OK;
  }
  baum_i_tension t;
  baum_status status = baum_i_call_spring_law(spring, point, length, rate, &t);
  sum[BAUM_I_POWER_SPRINGS] -= t.value * rate;
  return status;
}

/* Compare the derivatives that a user function returns with differences. scale is that of the
 * length. */
baum_status baum_i_check_spring_law(const baum_i_spring_law *spring, baum_i_point *point,
                                    double length, double rate, double scale);

#endif
