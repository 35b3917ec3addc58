/* SPDX-License-Identifier: BSD-3-Clause */
/* Derivatives by central differences. They replace derivatives for which the user gives no
 * function, and check those that user functions return.
 *
 * All derivatives are those of a function f(s) at s = 0, where f is a function F along a line in
 * (t, q, v). The line is called a ray:
 *
 *   f(s) = F(t + s dt, q + s dq, v + s dv)
 *
 * If q is not a vector, q + s dq means q moved by s dq (manifold.h). difference.c describes the
 * method and its accuracy.
 */
#ifndef BAUM_I_MECHANISM_GENERAL_DIFFERENCE_H
#define BAUM_I_MECHANISM_GENERAL_DIFFERENCE_H

#include "mechanism/general/user_function.h"

/* The function F. It writes `size` values, and may fail at some points of the ray. */
typedef baum_status baum_i_field_fn(const void *context, const baum_i_local *at, double *out);

typedef struct baum_i_field {
  baum_i_field_fn *evaluate;
  const void *context;
  int size;
  bool rough; /* F itself uses differences, which have errors */
} baum_i_field;

typedef struct baum_i_ray {
  double dt;
  const double *dq; /* (nl), or NULL for zeros */
  /* (nl) Used only if q is not a vector: q is moved by s dq_first, then by s dq. NULL: zeros. */
  const double *dq_first;
  const double *dv; /* (nl), or NULL for zeros */
  double rate;      /* > 0; s = 1 / rate changes q or v by about its scale */
} baum_i_ray;

/* Whether a function is differentiated with respect to q or v. */
typedef enum baum_i_variable { BAUM_I_VARIABLE_Q, BAUM_I_VARIABLE_V } baum_i_variable;

/* Return the largest |v_i| / scale_i. */
double baum_i_local_rate(const baum_i_local *at);

/* Return the ray along one coordinate. Sets direction (nl), to which the ray points. */
baum_i_ray baum_i_column_ray(const baum_i_local *at, baum_i_variable variable, int column,
                             double *direction);

/* Compute f'(0) and f''(0). out (size). */
baum_status baum_i_difference_first(const baum_i_field *field, const baum_i_ray *ray,
                                    const baum_i_local *at, double *out);
baum_status baum_i_difference_second(const baum_i_field *field, const baum_i_ray *ray,
                                     const baum_i_local *at, double *out);

/* Compute dF/dv, or dF/dq N, which is the derivative with respect to displacements of q (nl). out
 * (size x nl). */
baum_status baum_i_difference_columns(const baum_i_field *field, baum_i_variable variable,
                                      const baum_i_local *at, double *out);

/* ---- one step size at a time, for check.c ---- */

/* A difference formula for the first or second derivative, and the step sizes that are tried. Each
 * formula has a variant of sixth and one of fourth order, whose difference estimates the error. */
typedef struct baum_i_stencil {
  int order;
  double sixth[3]; /* weights of f at distances of 1, 2 and 3 steps on both sides */
  double fourth[3];
  double step;      /* first step, relative to the scales */
  double shrink;    /* factor to the next step */
  int steps;        /* maximum number */
  double agreement; /* the search ends when both variants differ by less, relatively */
} baum_i_stencil;

extern const baum_i_stencil baum_i_stencil_first;
extern const baum_i_stencil baum_i_stencil_second;

/* Results of one step size; arrays (size). */
typedef struct baum_i_estimate {
  double *value;     /* of sixth order */
  double *error;     /* difference of both variants; far above the error of `value` at a good
                      * step */
  double *noise;     /* effect of the rounding of F on value */
  double *variation; /* largest term of the formula, in units of `value` */
} baum_i_estimate;

/* Allocate the arrays of an estimate from `here`. */
baum_i_estimate baum_i_estimate_take(baum_i_local *here, int size);

/* Return the first step of a stencil, which is a power of two. */
double baum_i_first_step(const baum_i_stencil *stencil, const baum_i_ray *ray);

baum_status baum_i_difference_once(const baum_i_stencil *stencil, const baum_i_field *field,
                                   const baum_i_ray *ray, const baum_i_local *at, double step,
                                   const baum_i_estimate *out);

#endif
