/* SPDX-License-Identifier: BSD-3-Clause */
/* What one step of a method makes of a violation with Phi'' + 2 alpha Phi' + beta^2 Phi = 0.
 * Everything is in A = |alpha h| and B = (beta h)^2.
 */
#ifndef BAUM_I_STABILIZATION_AMPLIFICATION_H
#define BAUM_I_STABILIZATION_AMPLIFICATION_H

#include <stdbool.h>

#include <baum/stabilization.h>

/* The kinds of method that the mathematics here knows. */
typedef enum baum_i_method_kind {
  BAUM_I_METHOD_VARIABLE_STEP = 0, /* no fixed region; see baum_i_method_family */
  BAUM_I_METHOD_ONE_STEP,          /* z = R(mu), R(mu) = sum coefficients[k] mu^k */
  BAUM_I_METHOD_SEMI_IMPLICIT,     /* z^2 + (B + 2 A - 2) z + (1 - 2 A) */
  BAUM_I_METHOD_ADAMS_BASHFORTH,   /* z^k = z^(k-1) + mu sum_j coefficients[j] z^(k-1-j), k = degree
                                    */
  BAUM_I_METHOD_WITHOUT_GAINS      /* fixed step, but keeps the constraints by itself */
} baum_i_method_kind;

/* Of BAUM_I_METHOD_VARIABLE_STEP: what can be said without a region. */
typedef enum baum_i_method_family {
  BAUM_I_FAMILY_EXPLICIT = 0, /* nothing stiff */
  BAUM_I_FAMILY_ADAMS,        /* Adams-Moulton, implicit in the constraints */
  BAUM_I_FAMILY_BDF           /* A(alpha)-stable up to order 5 */
} baum_i_method_family;

enum { BAUM_I_METHOD_DEGREE = 12 };

/* Description that an integrator carries of itself. */
typedef struct baum_i_method {
  baum_i_method_kind kind;
  int degree; /* of the polynomial R, or steps k */
  double coefficients[BAUM_I_METHOD_DEGREE + 1];
  double best[2]; /* (A, B) of baum_i_stability_best() where the search for it is long; else 0 */
} baum_i_method;

/* Messages on what gains do with a method, also one that chooses its steps. Static. */
const char *baum_i_method_statement(const baum_i_method *method, baum_i_method_family family,
                                    bool chooses_step);

/* Fill every field of out but struct_size. A and B may be any finite numbers;
 * a radius beyond double is infinite. */
void baum_i_amplification(const baum_i_method *method, double alpha_h, double beta2_h2,
                          baum_amplification *out);

/* Spectral radius - 1, with its digits also where gains are small;
 * fixed-step methods only, as all below. */
double baum_i_amplification_growth(const baum_i_method *method, double alpha_h, double beta2_h2);

/* Is spectral radius - 1 <= growth? Much cheaper than the radius for Adams-Bashforth methods. */
bool baum_i_amplification_within(const baum_i_method *method, double alpha_h, double beta2_h2,
                                 double growth);

/* ---- Along a ray alpha = damping_ratio beta; damping_ratio > 0, finite ---- */

/* alpha h of the first instability: 0 when nothing is stable, infinite when everything is. */
double baum_i_stability_limit(const baum_i_method *method, double damping_ratio);

/* All stable intervals of alpha h, in order; the first `capacity` of them are stored. Gaps and
 * islands of less than 1 % of their place may be missed. @return their number */
int baum_i_stability_intervals(const baum_i_method *method, double damping_ratio, int capacity,
                               double *from, double *to);

/* alpha h of least spectral radius on the ray; 0 when nothing is stable. */
double baum_i_stability_best_on_ray(const baum_i_method *method, double damping_ratio);

/* ---- In the plane --------------------------------------------------------- */

/* The point of least spectral radius with alpha h > 0: the dead-beat point where there is one.
 * Where there are several it is the one of least gains. */
void baum_i_stability_best(const baum_i_method *method, double *alpha_h, double *beta2_h2);

/* The dead-beat point: all z are 0. False, and nothing is stored, where there is none. */
bool baum_i_stability_deadbeat(const baum_i_method *method, double *alpha_h, double *beta2_h2);

/* Nearest point with spectral radius <= 0.9, the point itself when it is good; the best one when
 * none is. Its distance is within 1 % of the least. */
void baum_i_stability_nearest(const baum_i_method *method, double alpha_h, double beta2_h2,
                              double *good_alpha_h, double *good_beta2_h2);

/* Closed curves, one after the other, a point of NaN between them. */
typedef struct baum_i_outline {
  int capacity;
  double *alpha_h;  /* (capacity) */
  double *beta2_h2; /* (capacity) */
  int count;        /* of all points, also those beyond capacity */
} baum_i_outline;

/* Where spectral radius - 1 = growth; growth > -1. No points when that is nowhere, or the region
 * has no end. */
void baum_i_stability_outline(const baum_i_method *method, double growth, baum_i_outline *out);

#endif
