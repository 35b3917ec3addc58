/* SPDX-License-Identifier: BSD-3-Clause */
/* Derivatives by central differences: for derivatives that the user does not give, and to check
 * those that the user gives.
 *
 * All are derivatives at s = 0 along a ray in (t, q, v):
 *
 *   f(s) = F(t + s dt, q + s dq, v + s dv)
 *
 * Where q is no vector, q + s dq means q moved by s dq (manifold.h). difference.c describes the
 * method and its accuracy.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_DIFFERENCE_H
#define BAUM_I_MECHANISM_GENERAL_DIFFERENCE_H

#include "mechanism/general/user_function.h"

/* F: writes `size` values at a point. It may fail at some points of the ray. */
typedef baum_status baum_i_field_fn(const void *context, const baum_i_local *at, double *out);

typedef struct baum_i_field {
  baum_i_field_fn *evaluate;
  const void *context;
  int size;
  bool rough; /* the values are themselves differences, with their error */
} baum_i_field;

typedef struct baum_i_ray {
  double dt;
  const double *dq; /* (nl), or NULL for zeros */
  /* (nl) where q is no vector: q is first moved by s times this, then by s dq. NULL: zeros. */
  const double *dq_first;
  const double *dv; /* (nl), or NULL for zeros */
  double rate;      /* > 0; s = 1 / rate is a relevant change */
} baum_i_ray;

/* The variable of derivatives by all columns. */
typedef enum baum_i_variable { BAUM_I_VARIABLE_Q, BAUM_I_VARIABLE_V } baum_i_variable;

/* Largest |v_i| / scale_i: relevant changes per unit of time. */
double baum_i_local_rate(const baum_i_local *at);

/* Ray along one coordinate. Sets direction (nl), to which the ray refers. */
baum_i_ray baum_i_column_ray(const baum_i_local *at, baum_i_variable variable, int column,
                             double *direction);

/* f'(0) and f''(0); out (size). */
baum_status baum_i_difference_first(const baum_i_field *field, const baum_i_ray *ray,
                                    const baum_i_local *at, double *out);
baum_status baum_i_difference_second(const baum_i_field *field, const baum_i_ray *ray,
                                     const baum_i_local *at, double *out);

/* dF/dq, by a displacement of velocity size, or dF/dv; out (size x nl). */
baum_status baum_i_difference_columns(const baum_i_field *field, baum_i_variable variable,
                                      const baum_i_local *at, double *out);

/* ---- one step size at a time, for check.c ---- */

/* Weights of a derivative of order 1 or 2. */
typedef struct baum_i_stencil {
  int order;
  double sixth[3]; /* weights of the pairs at distance 1, 2, 3 */
  double fourth[3];
  double step;      /* first step, in relevant changes */
  double shrink;    /* factor to the next step */
  int steps;        /* maximum number */
  double agreement; /* relative disagreement of the orders that ends the search */
} baum_i_stencil;

extern const baum_i_stencil baum_i_stencil_first;
extern const baum_i_stencil baum_i_stencil_second;

/* Results of one step size; arrays (size). */
typedef struct baum_i_estimate {
  double *value;     /* of sixth order */
  double *error;     /* disagreement of the orders: far above the error of value at a good step */
  double *noise;     /* effect of the rounding of F on value */
  double *variation; /* largest pair of the stencil, in units of value */
} baum_i_estimate;

/* Arrays of an estimate. */
baum_i_estimate baum_i_estimate_take(baum_i_local *here, int size);

/* The first step of a stencil, a power of two. */
double baum_i_first_step(const baum_i_stencil *stencil, const baum_i_ray *ray);

baum_status baum_i_difference_once(const baum_i_stencil *stencil, const baum_i_field *field,
                                   const baum_i_ray *ray, const baum_i_local *at, double step,
                                   const baum_i_estimate *out);

#endif
