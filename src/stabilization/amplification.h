/* SPDX-License-Identifier: BSD-3-Clause */
/* Amplification of a constraint violation by one step of a method, with Phi'' + 2 alpha Phi' +
 * beta^2 Phi = 0. All results are functions of A = |alpha h| and B = (beta h)^2. */
#ifndef BAUM_I_STABILIZATION_AMPLIFICATION_H
#define BAUM_I_STABILIZATION_AMPLIFICATION_H

#include <stdbool.h>

#include <baum/stabilization.h>

/* Kinds of method. */
typedef enum baum_i_method_kind {
  BAUM_I_METHOD_VARIABLE_STEP = 0, /* no fixed region of stability; see baum_i_method_family */
  BAUM_I_METHOD_ONE_STEP,          /* z = R(mu), R(mu) = sum coefficients[k] mu^k */
  BAUM_I_METHOD_SEMI_IMPLICIT,     /* z^2 + (B + 2 A - 2) z + (1 - 2 A) */
  BAUM_I_METHOD_ADAMS_BASHFORTH,   /* z^k = z^(k-1) + mu sum_j coefficients[j] z^(k-1-j), k = degree
                                    */
  BAUM_I_METHOD_WITHOUT_GAINS      /* fixed step; enforces the constraints without gains */
} baum_i_method_kind;

/* Families of methods of kind BAUM_I_METHOD_VARIABLE_STEP. */
typedef enum baum_i_method_family {
  BAUM_I_FAMILY_EXPLICIT = 0, /* explicit methods */
  BAUM_I_FAMILY_ADAMS,        /* Adams-Moulton methods, implicit in the constraints */
  BAUM_I_FAMILY_BDF           /* BDF methods, A(alpha)-stable up to order 5 */
} baum_i_method_family;

enum { BAUM_I_METHOD_DEGREE = 12 };

/* Stability properties of a method; member of its integrator. */
typedef struct baum_i_method {
  baum_i_method_kind kind;
  int degree; /* degree of R, or number k of steps */
  double coefficients[BAUM_I_METHOD_DEGREE + 1];
  double best[2]; /* stored result of baum_i_stability_best() if its search is slow, otherwise 0 */
} baum_i_method;

/* Returns a static text on the effect of gains with a method. chooses_step: the method chooses its
 * steps. */
const char *baum_i_method_statement(const baum_i_method *method, baum_i_method_family family,
                                    bool chooses_step);

/* Fills all fields of out except struct_size. A and B may be any finite numbers. A radius that
 * overflows is infinite. */
void baum_i_amplification(const baum_i_method *method, double alpha_h, double beta2_h2,
                          baum_amplification *out);

/* The same for rows of velocity level, whose single mode is mu = -alpha h: z[1] is NaN. The second
 * function returns the alpha h up to which the method is stable for them. */
void baum_i_velocity_amplification(const baum_i_method *method, double alpha_h,
                                   baum_amplification *out);
double baum_i_velocity_limit(const baum_i_method *method);

/* Returns spectral radius - 1, which is accurate even for small gains. This and all functions below
 * are for fixed-step methods only. */
double baum_i_amplification_growth(const baum_i_method *method, double alpha_h, double beta2_h2);

/* Tells whether spectral radius - 1 <= growth. For Adams-Bashforth methods this is much cheaper
 * than the radius. */
bool baum_i_amplification_within(const baum_i_method *method, double alpha_h, double beta2_h2,
                                 double growth);

/* ---- Along a ray alpha = damping_ratio beta; damping_ratio > 0, finite ---- */

/* Returns the alpha h at which the ray becomes unstable: 0 if no point is stable, infinity if all
 * are. */
double baum_i_stability_limit(const baum_i_method *method, double damping_ratio);

/* Finds all stable intervals of alpha h, in order; the first `capacity` are stored. Gaps and
 * intervals shorter than 1 % of their alpha h may be missed. Returns the number of intervals. */
int baum_i_stability_intervals(const baum_i_method *method, double damping_ratio, int capacity,
                               double *from, double *to);

/* Returns alpha h of the least spectral radius on the ray, or 0 if no point is stable. */
double baum_i_stability_best_on_ray(const baum_i_method *method, double damping_ratio);

/* ---- In the plane --------------------------------------------------------- */

/* Finds the point of least spectral radius with alpha h > 0, which is the dead-beat point if there
 * is one. Of several such points it is the one with the smallest gains. */
void baum_i_stability_best(const baum_i_method *method, double *alpha_h, double *beta2_h2);

/* Finds the dead-beat point, where all z are 0. Returns false and stores nothing if there is
 * none. */
bool baum_i_stability_deadbeat(const baum_i_method *method, double *alpha_h, double *beta2_h2);

/* Finds the nearest point with spectral radius <= 0.9, or the point of least spectral radius if
 * there is none. The distance is at most 1 % above the least. */
void baum_i_stability_nearest(const baum_i_method *method, double alpha_h, double beta2_h2,
                              double *good_alpha_h, double *good_beta2_h2);

/* Closed curves. A point of NaN separates each from the next. */
typedef struct baum_i_outline {
  int capacity;
  double *alpha_h;  /* (capacity) */
  double *beta2_h2; /* (capacity) */
  int count;        /* number of all points, including those beyond capacity */
} baum_i_outline;

/* Finds the curves where spectral radius - 1 = growth; growth > -1. There are no points if no point
 * has this radius or the region is unbounded. */
void baum_i_stability_outline(const baum_i_method *method, double growth, baum_i_outline *out);

#endif
