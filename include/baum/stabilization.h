/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Baumgarte's gains, and their stability with each integrator. The equations are those of
 *  Baumgarte (1972) and Flores et al. (2008). Numbers of equations are those of Flores et al.
 *
 *  With the gains alpha and beta, the constraint violation Phi follows the equation Phi'' + 2 alpha
 *  Phi' + beta^2 Phi = 0 (6). The integrator solves this equation together with the motion. A
 *  violation is a sum of modes. In each step of length h, each mode is multiplied by a number z,
 *  which is a root of the characteristic equation of the integrator. The *spectral radius* is the
 *  largest |z|; violations decay if it is below 1. The spectral radius depends on the integrator
 *  and on the two products alpha h and beta^2 h^2, which are the coordinates of a point in a plane.
 *  The points where violations decay form the *region of stability* of the integrator. The
 *  functions below compute spectral radii and regions. They need no mechanism, allocate no memory
 *  and may be called from any thread.
 *
 *  Rules: a gain rule chooses the gains. The comments of baum_gains_fixed() and of the other rules
 *  state for which steps the gains are stable, how large a violation they leave, and what they do
 *  to accuracy and cost. The measured values in the comments are those of a pendulum of length 1 m,
 *  which is released from the horizontal and simulated for 1 s with h = 0.0025 s. The page
 *  "docs/theory/gain_rules.md" has more measurements.
 *
 *  Two kinds of integrators have no region of stability: those that always choose their step
 *  themselves (CVODE and IDA), and those that need no gains. Below, "no region" means that an
 *  integrator is of one of these kinds. */
#ifndef BAUM_STABILIZATION_H
#define BAUM_STABILIZATION_H

#include <stddef.h>
#include <stdint.h>

#include <baum/export.h>
#include <baum/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** An integration method; simulation.h lists all methods. */
typedef struct baum_integrator baum_integrator;

/** Rules that choose the gains. */
typedef enum baum_gain_rule {
  /** DEADBEAT for the Euler methods, BEST_DAMPING for the Adams-Bashforth methods AB2 to AB4,
   *  otherwise AUTO. */
  BAUM_GAINS_DEFAULT = 0,
  BAUM_GAINS_FIXED = 1,  /**< alpha and beta are given [1/s]. */
  BAUM_GAINS_SCALED = 2, /**< alpha h and beta^2 h^2 are given [-]; fixed step only. */
  /** alpha = 1/h, beta = sqrt(2)/h (equations 10 and 11 of Flores et al.); fixed step only. */
  BAUM_GAINS_TAYLOR = 3,
  /** beta = 2 pi f and alpha = zeta beta, where the natural frequency f [Hz] and the damping ratio
   *  zeta are given. */
  BAUM_GAINS_FREQUENCY = 4,
  /** Dead-beat gains, for which both roots z of the characteristic equation of the integrator are
   *  zero; fixed step only. */
  BAUM_GAINS_DEADBEAT = 5,
  /** alpha = beta, proportional to the mean angular velocity of the motion, but with a fixed step
   *  not above a limit; see baum_gains_auto(). */
  BAUM_GAINS_AUTO = 6,
  BAUM_GAINS_BEST_DAMPING = 7 /**< Gains of least spectral radius; fixed step only. */
} baum_gain_rule;

/** A gain rule and its numbers. baum_gains_fixed() and the functions of the other rules return such
 *  structs. If all bytes are zero, the rule is BAUM_GAINS_DEFAULT. */
typedef struct baum_gains {
  int32_t rule; /**< A baum_gain_rule. */
  /** [1/s, Hz or -] the arguments of the function of the rule, such as alpha and beta of
   *  baum_gains_fixed(). */
  double value[2];
} baum_gains;

/** Gains that you choose. With a fixed-step method they are stable if the point (alpha h, beta^2
 *  h^2) lies in the region of stability of the method. With CVODE BDF and IDA they are stable if
 *  alpha >= 0.618 beta. With the other variable-step methods they are always stable.
 *
 *  With alpha = beta, a violation decays approximately as exp(-alpha t). Each step adds a new
 *  violation, so that a steady violation remains. With the Euler methods, the steady |Phi'| is
 *  about h |gamma| / 2, and the steady |Phi| is about h |gamma| alpha / beta^2, where gamma is the
 *  right-hand side of J a = gamma. With other methods, a steady violation is approximately
 *  proportional to h^p, where p is the order of the method.
 *
 *  The motion keeps the order of the method, because the gains do not grow when h is reduced. Up to
 *  alpha h = 0.3 the gains cause no additional cost. Above this value, the cost of an explicit
 *  variable-step method grows in proportion to alpha.
 *  @param alpha  [1/s] >= 0
 *  @param beta   [1/s] >= 0
 *  @return  the rule */
BAUM_API baum_gains baum_gains_fixed(double alpha, double beta);

/** Gains given by the products alpha h and (beta h)^2. They are stable if the point (alpha h, (beta
 *  h)^2) lies in the region of stability of the method. With the two Euler methods, the steady
 *  violations are |Phi'| = h |gamma| / 2 and |Phi| = (alpha h / (beta h)^2) h^2 |gamma|, where
 *  gamma is the right-hand side of J a = gamma. Runge-Kutta methods lose order, because the gains
 *  grow when the step is reduced. The comment of baum_gains_deadbeat() gives the orders.
 *  @param alpha_h   [-] alpha h >= 0
 *  @param beta2_h2  [-] (beta h)^2 >= 0
 *  @return  the rule */
BAUM_API baum_gains baum_gains_scaled(double alpha_h, double beta2_h2);

/** Gains for which the Taylor expansion of the violation to second order is zero after one step,
 *  equations (10) and (11) of Flores et al.: alpha = 1/h, beta = sqrt(2)/h. With explicit Euler the
 *  spectral radius is 1, so violations do not decay. With semi-implicit Euler and AB2 to AB4 the
 *  spectral radius is greater than 1, so the gains are unstable and refused. With RK2 these gains
 *  are dead-beat. With RK3 the spectral radius is 0.47, and with RK4 0.37. The orders of accuracy
 *  of Euler and RK2 to RK4 are the same as with baum_gains_deadbeat().
 *  @return  the rule */
BAUM_API baum_gains baum_gains_taylor(void);

/** Gains given by the natural frequency and the damping ratio of the equation
 *  Phi'' + 2 alpha Phi' + beta^2 Phi = 0. Stability, accuracy and cost are those of
 *  baum_gains_fixed(). With a damping ratio below 0.618, violations may grow with CVODE BDF and
 *  IDA.
 *  @param hertz          [Hz] > 0, natural frequency
 *  @param damping_ratio  [-] > 0; 1 is critical damping
 *  @return  the rule */
BAUM_API baum_gains baum_gains_frequency(double hertz, double damping_ratio);

/** Dead-beat gains, for which both roots z of the characteristic equation of the integrator are
 *  zero. No other gains make violations decay faster: a violation vanishes after at most two steps.
 *  For explicit Euler these gains are alpha = beta = 1/h, for semi-implicit Euler alpha = 1/(2h)
 *  and beta = 1/h, and for RK2 alpha = 1/h and beta = sqrt(2)/h. For other Runge-Kutta methods they
 *  follow from a zero of the stability polynomial. With explicit Euler, the steady violations are
 *  |Phi'| = h |gamma| / 2 and |Phi| = h^2 |gamma|, where gamma is the right-hand side of J a =
 *  gamma. With semi-implicit Euler, |Phi'| is the same and |Phi| is half as large.
 *
 *  With these gains Runge-Kutta methods lose order, because the gains grow when the step is
 *  reduced: the orders 2, 3, 4, 5, 8 become 1, 2, 2, 3, 2. For a particle on a rod of 1 m and steps
 *  of 0.0025 s, the error is larger than without gains, by a factor of 800 (RK2), 100 (RK3) and
 *  4000 (RK4). The Euler methods remain of order 1. The rule is for fixed steps only. Multistep
 *  methods have no dead-beat point and refuse the rule.
 *  @return  the rule */
BAUM_API baum_gains baum_gains_deadbeat(void);

/** Gains that suit the speed of the motion. alpha and beta are equal and constant during a run.
 *  They are proportional to the mean angular velocity over roughly the first 4 rad of the motion.
 *  This angular velocity is max(|v|/L, sqrt(|a|/L)), where v are velocities, a are accelerations,
 *  and L is the characteristic length.
 *
 *  The gains are this angular velocity times a factor:
 *
 *  - With a fixed step, the factor is 0.35 for Runge-Kutta methods and 0.2 for Euler and
 *    Adams-Bashforth methods. For RK2 it is only 0.05, because RK2 would otherwise lose order. If
 *    drivers prescribe the whole motion, the factor is 0.6 for all of these methods.
 *
 *  - With CVODE and IDA the factor is 0.25, and 40 if drivers prescribe the whole motion. The
 *    matrices of these implicit methods include the gains, so large gains do not limit their steps.
 *
 *  - With explicit methods at variable steps the factor is 0.1, because variable steps are usually
 *    longer than fixed steps, and alpha h should stay small. If drivers prescribe the whole motion,
 *    the factor is 2.
 *
 *  With a fixed step, the gains are limited: alpha h is at most 0.3, and at most half of the
 *  stability limit of the method. With this limit, the gains are always stable. With variable
 *  steps, equal gains need no limit to be stable. The steady violation is approximately as large as
 *  the local error of a step, and violations decay over some radians of the motion. The method
 *  keeps its order, and the run costs as much as a run without gains.
 *
 *  When a run is created, a short pilot run determines the angular velocity. It takes 5 steps and
 *  14 evaluations, which the counters of the run include. If the pilot run fails, the library uses
 *  the part of the pilot run before the failure. If the mechanism has degrees of freedom, or if it
 *  is at rest in equilibrium, the angular velocity is at least sqrt(g/L), where g is the magnitude
 *  of gravity; this is the angular frequency of a pendulum of length L. For a mechanism at rest in
 *  equilibrium without gravity, alpha is 0.01/h with a fixed step. For such a mechanism, alpha is 1
 *  per second with variable steps, which only suits machines with time scales of seconds. The page
 *  "docs/theory/gain_rules.md" compares other factors.
 *  @return  the rule */
BAUM_API baum_gains baum_gains_auto(void);

/** Gains of least spectral radius. If a method has dead-beat gains, this rule chooses them. AB2 to
 *  AB4 have no dead-beat gains, and for these methods this rule is the default. For AB2 the gains
 *  are alpha = beta = 2/(3h) with the spectral radius 0.58. For AB3 the least spectral radius is
 *  0.69, and for AB4 it is 0.81. Violations are 10 to 100 times smaller than with
 *  baum_gains_auto(). AB2 to AB4 keep their order, because they evaluate accelerations only at the
 *  ends of steps. Their errors are larger than without gains: 1.3 times with AB3, and 8 times with
 *  AB2 and AB4. Other methods above order 1 lose order, see baum_gains_deadbeat(). The rule is for
 *  fixed steps only.
 *  @return  the rule */
BAUM_API baum_gains baum_gains_best_damping(void);

/** The kind of stability: what happens to constraint violations in the long run. */
typedef enum baum_stability {
  BAUM_STABLE = 0, /**< Every violation decays: spectral radius < 1. */
  /** Some violations neither decay nor grow exponentially: spectral radius = 1. */
  BAUM_MARGINAL = 1,
  BAUM_UNSTABLE = 2, /**< Some violations grow exponentially: spectral radius > 1. */
  /** The method has no region of stability, because it always chooses its step itself. See
   *  baum_stability_statement(). */
  BAUM_VARIABLE_STEP = 3,
  /** The method has no region of stability, because it keeps the constraints without gains. */
  BAUM_WITHOUT_GAINS = 4
} baum_stability;

/** The result of baum_stability_at() and baum_stability_velocity_at(): how one step changes
 *  constraint violations. */
typedef struct baum_amplification {
  size_t struct_size;       /**< Set by the function that fills the struct. */
  baum_stability stability; /**< Whether violations decay. */
  double spectral_radius;   /**< [-] largest |z|; NaN if the method has no region of stability. */
  /** [-] the largest root z of each of the two modes, as real and imaginary part. The mode with the
   *  larger |z| comes first. NaN if the method has no region of stability. */
  double z[2][2];
  /** [-] 1 - spectral_radius, computed without cancellation. This is the fraction of a violation
   *  that one step removes, for the mode that decays most slowly. Negative if violations grow; NaN
   *  if the method has no region of stability. */
  double damping;
} baum_amplification;

/** Compute the amplification of constraint violations at a point (alpha h, beta^2 h^2), as in the
 *  first figure of Flores et al.
 *  @param      integrator   the method
 *  @param      alpha_h      [-] alpha h, finite
 *  @param      beta2_h2     [-] (beta h)^2, finite
 *  @param[out] out          the result
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_stability_at(const baum_integrator *integrator, double alpha_h,
                                       double beta2_h2, baum_amplification *out,
                                       size_t caller_size);

/** Compute the amplification for rows of velocity level, which are the rows of non-holonomic
 *  constraints J v = nu. With gains, the equation of these rows is J a = gamma - alpha (J v - nu).
 *  Their violation x = J v - nu has a single mode, x' = -alpha x, so z[1] is NaN.
 *  @param      integrator   the method
 *  @param      alpha_h      [-] alpha h, finite
 *  @param[out] out          the result
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_stability_velocity_at(const baum_integrator *integrator, double alpha_h,
                                                baum_amplification *out, size_t caller_size);

/** Find the alpha h up to which violations of non-holonomic constraints J v = nu decay; see
 *  baum_stability_velocity_at().
 *  @param      integrator  a method with a fixed step
 *  @param[out] alpha_h     [-] the limit
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region of stability) */
BAUM_API baum_status baum_stability_velocity_limit(const baum_integrator *integrator,
                                                   double *alpha_h);

/** Describe in words how gains act with a method. The function also describes methods without a
 *  region of stability.
 *  @param integrator  may be NULL
 *  @return  static text; NULL if the argument is NULL */
BAUM_API const char *baum_stability_statement(const baum_integrator *integrator);

/** Find the stability limit for gains of a given damping ratio alpha / beta: these gains are stable
 *  from alpha h = 0 up to this limit.
 *  @param      integrator     the method
 *  @param      damping_ratio  [-] > 0, finite
 *  @param[out] alpha_h        [-] the limit; 0 if even small gains are unstable. Beyond the limit
 *                             there may be further stable intervals, see
 *                             baum_stability_intervals().
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_limit(const baum_integrator *integrator, double damping_ratio,
                                          double *alpha_h);

/** Find all intervals of alpha h in which gains of a given damping ratio alpha / beta are stable.
 *  Most methods have one interval, which begins at 0. The function may miss intervals, and gaps
 *  between intervals, if they are narrower than 1 % of the alpha h at which they lie.
 *  @param      integrator     the method
 *  @param      damping_ratio  [-] > 0, finite
 *  @param      capacity       [-] size of the arrays; >= 0
 *  @param[out] from           [-] (capacity) lower ends of the intervals, in rising order. May
 *                             be NULL if capacity is 0.
 *  @param[out] to             [-] (capacity) upper ends of the intervals; the last one may be
 *                             infinite. May be NULL if capacity is 0.
 *  @param[out] count          [-] number of intervals. If it exceeds the capacity, `from` and `to`
 *                             receive only the first intervals.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_intervals(const baum_integrator *integrator,
                                              double damping_ratio, int32_t capacity, double *from,
                                              double *to, int32_t *count);

/** Find the alpha h at which violations decay fastest, among all gains of a given damping ratio
 *  alpha / beta.
 *  @param      integrator     the method
 *  @param      damping_ratio  [-] > 0, finite
 *  @param[out] alpha_h        [-] the best alpha h; 0 if no gains of this damping ratio are stable
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_best_on_ray(const baum_integrator *integrator,
                                                double damping_ratio, double *alpha_h);

/** Find the point (alpha h, beta^2 h^2) at which violations decay fastest, among all points with
 *  alpha h > 0. This is the dead-beat point if the method has one. If several points are equally
 *  good, the function returns the one with the smallest gains. The search takes tens of
 *  milliseconds for Adams-Bashforth methods.
 *  @param      integrator  the method
 *  @param[out] alpha_h     [-] alpha h of the point
 *  @param[out] beta2_h2    [-] (beta h)^2 of the point
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_best(const baum_integrator *integrator, double *alpha_h,
                                         double *beta2_h2);

/** Find the dead-beat point, where both roots z are zero; see baum_gains_deadbeat().
 *  @param      integrator  the method
 *  @param[out] alpha_h     [-] alpha h of the point
 *  @param[out] beta2_h2    [-] (beta h)^2 of the point
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region, or a multistep method,
 *           which has no such point) */
BAUM_API baum_status baum_stability_deadbeat(const baum_integrator *integrator, double *alpha_h,
                                             double *beta2_h2);

/** Find the point with a spectral radius of at most 0.9 that is nearest to a given point in the
 *  plane of (alpha h, beta^2 h^2). The distance to the point found is at most 1 % larger than the
 *  least distance.
 *  @param      integrator     the method
 *  @param      alpha_h        [-] finite, alpha h of the given point
 *  @param      beta2_h2       [-] finite, (beta h)^2 of the given point
 *  @param[out] good_alpha_h   [-] alpha h of the point found, which is the given point itself if
 *                             its spectral radius is at most 0.9
 *  @param[out] good_beta2_h2  [-] (beta h)^2 of the point found
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_nearest(const baum_integrator *integrator, double alpha_h,
                                            double beta2_h2, double *good_alpha_h,
                                            double *good_beta2_h2);

/** Compute spectral radii on a rectangular grid in the plane of (alpha h, beta^2 h^2).
 *  @param      integrator    the method
 *  @param      alpha_h       [-] (2) alpha h of the first and of the last column, finite
 *  @param      beta2_h2      [-] (2) (beta h)^2 of the first and of the last row, finite
 *  @param      columns       [-] >= 1, number of columns; a single column is at alpha_h[0]
 *  @param      rows          [-] >= 1, number of rows; a single row is at beta2_h2[0]
 *  @param[out] radius        [-] (rows x columns) row-major; infinite where a value overflows
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_grid(const baum_integrator *integrator, const double alpha_h[2],
                                         const double beta2_h2[2], int32_t columns, int32_t rows,
                                         double *radius);

/** Trace the outline of the region where the spectral radius is at most `radius`, with alpha h >= 0
 *  and beta^2 h^2 >= 0. With `radius` = 1, this is the region of stability. With a smaller radius,
 *  it is the region where each step multiplies violations by at most `radius` in the long run.
 *
 *  The outline consists of closed curves: one around each part of the region, and one around each
 *  hole in it. The last point of a curve is equal to its first point. If you follow a curve from
 *  point to point, the region is to the right. In the arrays, an entry of NaN separates each curve
 *  from the next one. The points of the outline lie where the spectral radius is equal to `radius`;
 *  where an axis bounds the region, they lie on the axis. The function may miss parts that are
 *  smaller than about a hundredth of the whole region. The call uses 30 kB of stack.
 *  @param      integrator  the method
 *  @param      radius      [-] > 0, finite
 *  @param      capacity    [-] size of the arrays; >= 0. A capacity of 2000 is enough for every
 *                          integrator of the library.
 *  @param[out] alpha_h     [-] (capacity) alpha h of each point. May be NULL if capacity is 0.
 *  @param[out] beta2_h2    [-] (capacity) (beta h)^2 of each point. May be NULL if capacity is
 *                          0.
 *  @param[out] count       [-] number of points; 0 if the spectral radius is larger than `radius`
 *                          everywhere. If the number exceeds the capacity, the arrays receive only
 *                          the first points.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_outline(const baum_integrator *integrator, double radius,
                                            int32_t capacity, double *alpha_h, double *beta2_h2,
                                            int32_t *count);

#ifdef __cplusplus
}
#endif

#endif
