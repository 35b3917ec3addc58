/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Baumgarte's gains (Baumgarte 1972; Flores et al. 2008, equations 6 to 19) and what an integrator
 *  makes of them.
 *
 *  Phi'' + 2 alpha Phi' + beta^2 Phi = 0 (6) is integrated by the same method as the motion, so
 *  whether the violation decays depends on the method and on (alpha h, beta^2 h^2). These functions
 *  compute it. They need no mechanism, allocate nothing and may be called from any thread.
 */
#ifndef BAUM_STABILIZATION_H
#define BAUM_STABILIZATION_H

#include <stddef.h>
#include <stdint.h>

#include <baum/export.h>
#include <baum/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A method of integration; see simulation.h for the list. */
typedef struct baum_integrator baum_integrator;

/** How gains are chosen. */
typedef enum baum_gain_rule {
  BAUM_GAINS_DEFAULT = 0, /**< Dead-beat for the Eulers, best damping for AB2 to AB4, else auto. */
  BAUM_GAINS_FIXED = 1,   /**< alpha, beta [1/s]. */
  BAUM_GAINS_SCALED = 2,  /**< alpha h, beta^2 h^2 [-]; fixed step only. */
  BAUM_GAINS_TAYLOR = 3,  /**< alpha = 1/h, beta = sqrt(2)/h (10, 11); fixed step only. */
  BAUM_GAINS_FREQUENCY = 4,   /**< beta = 2 pi f, alpha = damping ratio x beta. */
  BAUM_GAINS_DEADBEAT = 5,    /**< Both roots at zero; fixed step only. */
  BAUM_GAINS_AUTO = 6,        /**< alpha = beta = a share of the rate of the motion, capped. */
  BAUM_GAINS_BEST_DAMPING = 7 /**< Least spectral radius; fixed step only. */
} baum_gain_rule;

/** A rule with its numbers. Make it with one of the functions below; all-zero is
 *  BAUM_GAINS_DEFAULT. */
typedef struct baum_gains {
  int32_t rule;    /**< A baum_gain_rule. */
  double value[2]; /**< The numbers of the rule. */
} baum_gains;

/* Every rule: where it is stable, what violation it leaves, what it does to accuracy and cost.
 * Figures: a pendulum of 1 m released level, 1 s, h = 0.0025 s; more in
 * docs/theory/gain_rules.md. */

/** Gains as numbers. Stable where the method's region has (alpha h, beta^2 h^2); with a variable
 *  step wherever alpha >= 0.618 beta. A violation decays as exp(-alpha t) when alpha = beta; what
 *  the steps keep adding leaves |Phi'| of about h |gamma| / 2 and |Phi| of h |gamma| / alpha with
 *  Euler, and of the order of the method above. Order is kept, because the gains do not grow as h
 *  shrinks; cost is flat up to alpha h = 0.3 and beyond grows in proportion to alpha where steps
 *  are chosen by an explicit method.
 *  @param alpha,beta  [1/s] >= 0
 */
BAUM_API baum_gains baum_gains_fixed(double alpha, double beta);

/** Gains relative to the step; stable where the method's region says so. Violation of both Eulers:
 *  |Phi'| = h |gamma| / 2, |Phi| = (alpha h / (beta h)^2) h^2 |gamma|. Runge-Kutta methods lose
 *  order as with baum_gains_deadbeat(), for the same reason.
 *  @param alpha_h    [-] alpha h >= 0
 *  @param beta2_h2   [-] (beta h)^2 >= 0
 */
BAUM_API baum_gains baum_gains_scaled(double alpha_h, double beta2_h2);

/** Gains of the Taylor expansion, equations (10) and (11): alpha = 1/h, beta = sqrt(2)/h. With
 *  explicit Euler the roots lie on the unit circle (marginal: violations stay), with semi-implicit
 *  Euler and AB2 to AB4 outside (refused), with RK2 it is dead-beat, with RK3 and RK4 it damps by
 *  0.47 and 0.37 a step. Accuracy as baum_gains_deadbeat(). */
BAUM_API baum_gains baum_gains_taylor(void);

/** Gains of an oscillator; as baum_gains_fixed() in all else. Below a damping ratio of 0.618 BDF
 *  and IDA may not damp.
 *  @param hertz          [Hz] > 0, natural frequency
 *  @param damping_ratio  [-] > 0, 1 is critical
 */
BAUM_API baum_gains baum_gains_frequency(double hertz, double damping_ratio);

/** Both roots at zero, the fastest decay there is: explicit Euler alpha = beta = 1/h, semi-implicit
 *  Euler alpha = 1/(2h), beta = 1/h; RK2 alpha = 1/h, beta = sqrt(2)/h; other Runge-Kutta methods a
 *  zero of their polynomial. Stable in the midst of the region; a violation is gone after two steps
 *  at most, and both Eulers leave |Phi'| = h |gamma| / 2, |Phi| = h^2 |gamma| (semi-implicit: half
 *  of it). It costs Runge-Kutta methods their order, because the gains grow as the step shrinks:
 *  orders 2, 3, 4, 5, 8 become 1, 2, 2, 3, 2, errors 800 times (RK2) to 4000 times (RK4) those
 *  without gains. The Eulers, of order 1 anyway, lose none. Fixed step only; methods of several
 *  steps have no such point and are refused. */
BAUM_API baum_gains baum_gains_deadbeat(void);

/** alpha = beta, constant during a run, in proportion to the mean angular rate max(|v|/L,
 *  sqrt(|a|/L)) over the first radians of the motion. Where freedom is left: 0.35 times with a
 *  fixed step, 0.05 times with RK2, whose order is taken for more, 0.2 times with the Eulers and
 *  Adams-Bashforth; with steps of their own 0.25 times for CVODE and IDA, and 0.1 times for
 *  explicit methods, whose steps are longer. Where drivers take all freedom, 0.6 times with a fixed
 *  step, 2 times with variable ones, and 40 times with CVODE and IDA, whose matrix has the
 *  stiffness of the gains. The rate is that of a pilot run of 5 steps and 14
 *  evaluations when the run is created, which are counted; with freedom it is at least the rate
 *  sqrt(g/L) at which gravity swings the mechanism. Where the pilot run fails, what it has seen
 *  until then counts. A mechanism at rest in equilibrium takes sqrt(g/L); without gravity alpha is
 *  0.01/h, and 1 1/s where the step varies, which suits machines with times of seconds only.
 *  Stable: alpha h is at most 0.3 and at most half of the method's limit. Leaves violations of
 *  about those of the error of a step; they decay over some radians, not at once. Order is kept;
 *  cost is that of no gains at all. docs/theory/gain_rules.md compares it with all other
 *  constants. */
BAUM_API baum_gains baum_gains_auto(void);

/** The point of least spectral radius of the method: the dead-beat point where there is one, and
 *  alpha = beta = 2/(3h) for AB2 with radius 0.58; 0.69 for AB3 and 0.81 for AB4. The rule for AB2
 *  to AB4, whose violations it leaves 10 to 100 times smaller than auto. AB2 to AB4 keep their
 *  order, which other methods above order 1 do not (baum_gains_deadbeat()), for they have no stages
 *  between steps; their errors are 1.3 (AB3) to 8 times (AB2, AB4) those without gains. Fixed step
 *  only. */
BAUM_API baum_gains baum_gains_best_damping(void);

/** What becomes of a violation. */
typedef enum baum_stability {
  BAUM_STABLE = 0,        /**< Every violation decays: spectral radius < 1. */
  BAUM_MARGINAL = 1,      /**< Some violation neither decays nor grows exponentially: radius = 1. */
  BAUM_UNSTABLE = 2,      /**< Some violation grows exponentially: radius > 1. */
  BAUM_VARIABLE_STEP = 3, /**< The method chooses its step, so there is no fixed region; see
                               baum_stability_statement(). */
  BAUM_WITHOUT_GAINS = 4  /**< The method keeps the constraints by itself. */
} baum_stability;

/** Amplification of a violation by one step. */
typedef struct baum_amplification {
  size_t struct_size;       /**< Set by baum_stability_at(). */
  baum_stability stability; /**< Class. */
  double spectral_radius;   /**< [-] largest |z|; NaN without a region: BAUM_VARIABLE_STEP and
                                 BAUM_WITHOUT_GAINS. */
  double z[2][2]; /**< [-] the largest root z of each of the two modes, real and imaginary part, the
                       larger of them first; NaN likewise. */
  double damping; /**< [-] what a step takes off the slowest violation in the long run, as a share
                       of it: 1 - spectral_radius, with its digits also where that is small;
                       negative where violations grow; NaN likewise. */
} baum_amplification;

/** Amplification at a point of the plane of Fig. 1.
 *  @param      integrator   the method
 *  @param      alpha_h      [-] |alpha h|, finite
 *  @param      beta2_h2     [-] (beta h)^2, finite
 *  @param[out] out          the result
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_stability_at(const baum_integrator *integrator, double alpha_h,
                                       double beta2_h2, baum_amplification *out,
                                       size_t caller_size);

/** What holds for a method in words, also for one that chooses its steps or needs no gains.
 *  @return static text of one or two messages; NULL for NULL
 */
BAUM_API const char *baum_stability_statement(const baum_integrator *integrator);

/** Largest alpha h for which alpha = damping_ratio x beta is stable.
 *  @param      damping_ratio  [-] > 0, finite
 *  @param[out] alpha_h        receives the limit of the first instability from 0 on, 0 when small
 *                             gains are unstable; baum_stability_intervals() has what comes after
 *                             it
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region: variable step, or
 *              without gains)
 */
BAUM_API baum_status baum_stability_limit(const baum_integrator *integrator, double damping_ratio,
                                          double *alpha_h);

/** All intervals of alpha h for which alpha = damping_ratio x beta is stable. Most methods have
 *  one, from 0. Gaps and islands narrower than 1 % of their alpha h may be missed.
 *  @param      damping_ratio  [-] > 0, finite
 *  @param      capacity       of the arrays; >= 0
 *  @param[out] from,to        [-] (capacity) receive the first `capacity` intervals in order; `to`
 *              may
 *                             be infinite. NULL when capacity is 0
 *  @param[out] count          receives the number of intervals, which may exceed the capacity
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region)
 */
BAUM_API baum_status baum_stability_intervals(const baum_integrator *integrator,
                                              double damping_ratio, int32_t capacity, double *from,
                                              double *to, int32_t *count);

/** The alpha h of fastest decay for alpha = damping_ratio x beta.
 *  @param      damping_ratio  [-] > 0, finite
 *  @param[out] alpha_h        receives it; 0 when nothing is stable
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region)
 */
BAUM_API baum_status baum_stability_best_on_ray(const baum_integrator *integrator,
                                                double damping_ratio, double *alpha_h);

/** The point of fastest decay of all, alpha h > 0: the dead-beat point where there is one; of
 *  several the one of least gains. Takes some ten milliseconds for Adams-Bashforth methods.
 *  @param[out] alpha_h,beta2_h2  receive the point
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region)
 */
BAUM_API baum_status baum_stability_best(const baum_integrator *integrator, double *alpha_h,
                                         double *beta2_h2);

/** The dead-beat point, see baum_gains_deadbeat(): all roots are zero.
 *  @param[out] alpha_h,beta2_h2  receive the point
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region; or a method of several
 *              steps, which has no such point)
 */
BAUM_API baum_status baum_stability_deadbeat(const baum_integrator *integrator, double *alpha_h,
                                             double *beta2_h2);

/** The nearest point that damps well (spectral radius <= 0.9) in the plane of (alpha h, beta^2
 *  h^2). Its distance is within 1 % of the least.
 *  @param      alpha_h,beta2_h2            [-] finite, the point asked for
 *  @param[out] good_alpha_h,good_beta2_h2  receive the nearest good point; the point itself when it
 *                                          is good
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region)
 */
BAUM_API baum_status baum_stability_nearest(const baum_integrator *integrator, double alpha_h,
                                            double beta2_h2, double *good_alpha_h,
                                            double *good_beta2_h2);

/** Spectral radii over a rectangle of the plane.
 *  @param      alpha_h   [-] (2) first and last column, finite
 *  @param      beta2_h2  [-] (2) first and last row, finite
 *  @param      columns   >= 1; one is the first
 *  @param      rows      >= 1; likewise
 *  @param[out] radius    [-] (rows x columns) row-major; infinite beyond double
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region)
 */
BAUM_API baum_status baum_stability_grid(const baum_integrator *integrator, const double alpha_h[2],
                                         const double beta2_h2[2], int32_t columns, int32_t rows,
                                         double *radius);

/** Outline of the region in alpha h >= 0, beta^2 h^2 >= 0 where the spectral radius is at most a
 *  given number: 1 for the region of stability, less for a level line of damping. Every part of the
 *  region is a closed curve, its first point repeated at its end and the region on its right; so is
 *  every hole. Curves are separated by one point of NaNs. The points lie on the line, but for those
 *  on alpha h = 0 or beta^2 h^2 = 0 where the region is cut off. Parts of less than some hundredth
 *  of the whole may be missed. Uses 30 kB of stack.
 *  @param      radius            [-] > 0, finite
 *  @param      capacity          of the arrays; >= 0. 2000 is enough for every method here
 *  @param[out] alpha_h,beta2_h2  [-] (capacity) receive the first `capacity` points. NULL when
 *                                capacity is 0
 *  @param[out] count             receives the number of points, which may exceed the capacity; 0
 *                                when the radius is nowhere so small
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region)
 */
BAUM_API baum_status baum_stability_outline(const baum_integrator *integrator, double radius,
                                            int32_t capacity, double *alpha_h, double *beta2_h2,
                                            int32_t *count);

#ifdef __cplusplus
}
#endif

#endif
