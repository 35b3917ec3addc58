/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the factor by which one step of a method amplifies a constraint violation that satisfies
 * Phi'' + 2 alpha Phi' + beta^2 Phi = 0. All results are functions of A = |alpha h| and B = (beta
 * h)^2. Below, mu is one of the roots of mu^2 + 2 A mu + B = 0, and z is a factor by which one step
 * multiplies a violation. */
#ifndef BAUM_I_STABILIZATION_AMPLIFICATION_H
#define BAUM_I_STABILIZATION_AMPLIFICATION_H

#include <stdbool.h>

#include <baum/stabilization.h>

/* Kinds of method. */
typedef enum baum_i_method_kind {
  BAUM_I_METHOD_VARIABLE_STEP = 0, /* has no fixed region of stability; see baum_i_method_family */
  BAUM_I_METHOD_ONE_STEP,          /* z = R(mu) with R(mu) = sum coefficients[k] mu^k */
  BAUM_I_METHOD_SEMI_IMPLICIT,     /* z is a root of z^2 + (B + 2 A - 2) z + (1 - 2 A) */
  /* z is a root of z^k = z^(k-1) + mu sum_j coefficients[j] z^(k-1-j), with k = degree. */
  BAUM_I_METHOD_ADAMS_BASHFORTH,
  /* A fixed-step method that enforces the constraints without gains. */
  BAUM_I_METHOD_WITHOUT_GAINS
} baum_i_method_kind;

/* Families of methods of kind BAUM_I_METHOD_VARIABLE_STEP. */
typedef enum baum_i_method_family {
  BAUM_I_FAMILY_EXPLICIT = 0, /* explicit methods */
  BAUM_I_FAMILY_ADAMS,        /* Adams-Moulton methods, which treat the constraints implicitly */
  BAUM_I_FAMILY_BDF /* BDF methods, which are stable in a sector of the half-plane Re mu < 0 */
} baum_i_method_family;

enum { BAUM_I_METHOD_DEGREE = 12 };

/* The data that determine the stability of a method. This struct is a member of the method's
 * integrator. */
typedef struct baum_i_method {
  baum_i_method_kind kind;
  int degree; /* degree of R, or the number k of steps of Adams-Bashforth */
  double coefficients[BAUM_I_METHOD_DEGREE + 1];
  /* The result of baum_i_stability_best(), stored if its search is slow, otherwise 0. */
  double best[2];
} baum_i_method;

/* Returns a constant text that says with which gains violations decay. `chooses_step` tells whether
 * the method chooses its steps itself. */
const char *baum_i_method_statement(const baum_i_method *method, baum_i_method_family family,
                                    bool chooses_step);

/* Sets all members of `out` except struct_size. The numbers A and B may be any finite numbers. If a
 * radius overflows, it is infinite. */
void baum_i_amplification(const baum_i_method *method, double alpha_h, double beta2_h2,
                          baum_amplification *out);

/* Does what baum_i_amplification() does, for rows of velocity level. Their single mode is mu =
 * -alpha h, so z[1] is NaN. The second function returns the alpha h up to which the method is
 * stable for these rows. */
void baum_i_velocity_amplification(const baum_i_method *method, double alpha_h,
                                   baum_amplification *out);
double baum_i_velocity_limit(const baum_i_method *method);

/* Returns the spectral radius minus 1. The result is accurate even for small gains. This function
 * and all functions below require a method of kind ONE_STEP, SEMI_IMPLICIT or ADAMS_BASHFORTH. */
double baum_i_amplification_growth(const baum_i_method *method, double alpha_h, double beta2_h2);

/* Tells whether the spectral radius minus 1 is at most `growth`. For Adams-Bashforth methods this
 * is much cheaper than computing the radius. */
bool baum_i_amplification_within(const baum_i_method *method, double alpha_h, double beta2_h2,
                                 double growth);

/* ---- Along a ray alpha = damping_ratio * beta; damping_ratio is > 0 and finite ---- */

/* Returns alpha h at the point where the ray becomes unstable. The result is 0 if the ray is
 * unstable for small alpha h, and infinity if all points are stable. */
double baum_i_stability_limit(const baum_i_method *method, double damping_ratio);

/* Finds all stable intervals of alpha h, in ascending order. Only the first `capacity` intervals
 * are stored. Gaps and intervals shorter than 1 % of their alpha h may be missed. Returns the
 * number of intervals. */
int baum_i_stability_intervals(const baum_i_method *method, double damping_ratio, int capacity,
                               double *from, double *to);

/* Returns alpha h at the point of the ray that has the smallest spectral radius. Returns 0 if no
 * point of the ray is stable. */
double baum_i_stability_best_on_ray(const baum_i_method *method, double damping_ratio);

/* ---- In the plane --------------------------------------------------------- */

/* Finds the point with alpha h > 0 that has the smallest spectral radius. If there is a dead-beat
 * point, finds this point. If there are several dead-beat points, points with two different mu are
 * preferred, and among these the point with the smallest gains. */
void baum_i_stability_best(const baum_i_method *method, double *alpha_h, double *beta2_h2);

/* Finds the dead-beat point, which is the point where all z are 0. If there is none, returns false
 * and stores nothing. */
bool baum_i_stability_deadbeat(const baum_i_method *method, double *alpha_h, double *beta2_h2);

/* Finds the point nearest to (alpha_h, beta2_h2) that has a spectral radius of at most 0.9. The
 * distance to the point that is found is at most 1 % larger than the smallest possible distance. If
 * no point has such a spectral radius, finds the point with the smallest spectral radius. */
void baum_i_stability_nearest(const baum_i_method *method, double alpha_h, double beta2_h2,
                              double *good_alpha_h, double *good_beta2_h2);

/* A list of points that form closed curves. After each curve except the last, there is a point
 * whose coordinates are NaN. */
typedef struct baum_i_outline {
  int capacity;
  double *alpha_h;  /* (capacity) */
  double *beta2_h2; /* (capacity) */
  int count;        /* number of all points, including those that did not fit into the arrays */
} baum_i_outline;

/* Finds the curves on which the spectral radius minus 1 equals `growth`. `growth` must be > -1. The
 * list is empty if no point has this radius, or if the region is unbounded. */
void baum_i_stability_outline(const baum_i_method *method, double growth, baum_i_outline *out);

#endif
