/* SPDX-License-Identifier: BSD-3-Clause */
/* Derivatives by central differences. They are used where the user gives no function for a
 * derivative, and to check the derivatives that user functions return.
 *
 * Every derivative is computed as the derivative of a function f(s) of one variable at s = 0. Here
 * f is the function F along a straight line in (t, q, v). The line is called a ray:
 *
 *   f(s) = F(t + s dt, q + s dq, v + s dv)
 *
 * If q is not a vector, q + s dq means q moved by s dq (manifold.h). The file difference.c
 * describes the method and its accuracy.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_DIFFERENCE_H
#define BAUM_I_MECHANISM_GENERAL_DIFFERENCE_H

#include "mechanism/general/user_function.h"

/* The function F, which is called a field. It writes `size` values. It may fail at some points of
 * the ray. */
typedef baum_status baum_i_field_fn(const void *context, const baum_i_local *at, double *out);

typedef struct baum_i_field {
  baum_i_field_fn *evaluate;
  const void *context;
  int size;
  bool rough; /* true if F itself uses differences and therefore has larger errors */
} baum_i_field;

typedef struct baum_i_ray {
  double dt;
  const double *dq; /* (nl), or NULL for zeros */
  /* (nl) Used only if q is not a vector. Then q is first moved by s dq_first and afterwards by s
   * dq. NULL means zeros. */
  const double *dq_first;
  const double *dv; /* (nl), or NULL for zeros */
  double rate;      /* positive number; the change s = 1 / rate moves q or v by about its scale */
} baum_i_ray;

/* Tells whether a function is differentiated with respect to q or to v. */
typedef enum baum_i_variable { BAUM_I_VARIABLE_Q, BAUM_I_VARIABLE_V } baum_i_variable;

/* Return the largest |v_i| / scale_i, in 1/s. */
double baum_i_local_rate(const baum_i_local *at);

/* Return the ray along one coordinate. The function writes the direction of the ray to `direction`
 * (nl), and the ray points to this memory. */
baum_i_ray baum_i_column_ray(const baum_i_local *at, baum_i_variable variable, int column,
                             double *direction);

/* Compute the derivative f'(0), or the second derivative f''(0). `out` has `size` entries. */
baum_status baum_i_difference_first(const baum_i_field *field, const baum_i_ray *ray,
                                    const baum_i_local *at, double *out);
baum_status baum_i_difference_second(const baum_i_field *field, const baum_i_ray *ray,
                                     const baum_i_local *at, double *out);

/* Compute dF/dv, or dF/dq N, which is the derivative of F with respect to displacements of q (nl).
 * `out` is a matrix size x nl. */
baum_status baum_i_difference_columns(const baum_i_field *field, baum_i_variable variable,
                                      const baum_i_local *at, double *out);

/* ---- one step size at a time, for check.c ---- */

/* A difference formula for the first or second derivative, and the step sizes that are tried. Each
 * formula has a variant of sixth order and one of fourth order. The difference between the two
 * results estimates the error. */
typedef struct baum_i_stencil {
  int order;
  double sixth[3]; /* weights of the values of f at 1, 2 and 3 steps on both sides */
  double fourth[3];
  double between[3]; /* weights of the polynomial through these values (difference.c) */
  double step;       /* the first step, relative to the scales */
  double shrink;     /* factor from one step to the next */
  int steps;         /* maximum number of steps */
  double agreement;  /* the search ends if the relative difference of both variants is below this */
} baum_i_stencil;

extern const baum_i_stencil baum_i_stencil_first;
extern const baum_i_stencil baum_i_stencil_second;

/* Results for one step size. The arrays have `size` entries. */
typedef struct baum_i_estimate {
  double *value; /* result of sixth order */
  /* Difference between both variants; for a good step it is much larger than the error of
   * `value`. */
  double *error;
  double *noise;     /* the error that rounding of F causes in `value` */
  double *variation; /* largest term of the formula, in units of `value` */
  double *between;   /* used only while the estimate is computed */
} baum_i_estimate;

/* Allocate the arrays of an estimate from the free memory of `here`. */
baum_i_estimate baum_i_estimate_take(baum_i_local *here, int size);

/* Return the first step that a stencil tries. It is a power of two. */
double baum_i_first_step(const baum_i_stencil *stencil, const baum_i_ray *ray);

baum_status baum_i_difference_once(const baum_i_stencil *stencil, const baum_i_field *field,
                                   const baum_i_ray *ray, const baum_i_local *at, double step,
                                   const baum_i_estimate *out);

#endif
