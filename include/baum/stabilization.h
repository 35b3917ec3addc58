/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Baumgarte's gains (Baumgarte 1972; Flores et al. 2008, equations 6 to 19) and their stability
 *  with each integrator.
 *
 *  Gains make constraint violations follow Phi'' + 2 alpha Phi' + beta^2 Phi = 0 (6), which the
 *  integrator solves together with the motion. A violation is a sum of modes, and each step h
 *  multiplies a mode by z, a root of the characteristic equation of the method. The *spectral
 *  radius* is the largest |z|; violations decay if it is below 1. It depends on the method and on
 *  the point (alpha h, beta^2 h^2). The points where violations decay are the *region of stability*
 *  of the method. The functions below compute it. They need no mechanism, allocate nothing and may
 *  be called from any thread.
 *
 *  "No region" below means that the method has no such region: it always chooses its step (CVODE
 *  and IDA), or it needs no gains. */
#ifndef BAUM_STABILIZATION_H
#define BAUM_STABILIZATION_H

#include <stddef.h>
#include <stdint.h>

#include <baum/export.h>
#include <baum/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** An integration method; simulation.h lists them. */
typedef struct baum_integrator baum_integrator;

/** How gains are chosen. */
typedef enum baum_gain_rule {
  /** DEADBEAT for the Euler methods, BEST_DAMPING for AB2 to AB4, otherwise AUTO. */
  BAUM_GAINS_DEFAULT = 0,
  BAUM_GAINS_FIXED = 1,     /**< alpha, beta [1/s]. */
  BAUM_GAINS_SCALED = 2,    /**< alpha h, beta^2 h^2 [-]; fixed step only. */
  BAUM_GAINS_TAYLOR = 3,    /**< alpha = 1/h, beta = sqrt(2)/h (10, 11); fixed step only. */
  BAUM_GAINS_FREQUENCY = 4, /**< beta = 2 pi f, alpha = damping ratio x beta. */
  BAUM_GAINS_DEADBEAT = 5,  /**< Both roots z are zero; fixed step only. */
  /** alpha = beta in proportion to the angular velocity of the motion, up to a limit. */
  BAUM_GAINS_AUTO = 6,
  BAUM_GAINS_BEST_DAMPING = 7 /**< Least spectral radius; fixed step only. */
} baum_gain_rule;

/** A rule with its numbers. The functions below return it. All-zero is BAUM_GAINS_DEFAULT. */
typedef struct baum_gains {
  int32_t rule;    /**< A baum_gain_rule. */
  double value[2]; /**< [1/s, Hz or -] the numbers of the rule. */
} baum_gains;

/* The comment of each rule states where it is stable, which violation it leaves, and its effect on
 * accuracy and cost. The figures were measured with a pendulum of length 1 m that is released from
 * the horizontal and runs for 1 s with h = 0.0025 s; docs/theory/gain_rules.md has more. */

/** Given gains. A fixed-step method is stable if (alpha h, beta^2 h^2) lies in its region, a
 *  variable-step method if alpha >= 0.618 beta. With alpha = beta a violation decays as exp(-alpha
 *  t). Each step adds a new violation. With the Euler methods, |Phi'| remains at about h |gamma| /
 *  2 and |Phi| at about h |gamma| / alpha; with other methods violations fall with h at the order
 *  of the method. The method keeps its order, because the gains do not grow as h shrinks. Up to
 *  alpha h = 0.3 the gains cost nothing; above, the cost of an explicit variable-step method grows
 *  in proportion to alpha.
 *  @param alpha,beta  [1/s] >= 0
 *  @return  the rule */
BAUM_API baum_gains baum_gains_fixed(double alpha, double beta);

/** Gains given by the products alpha h and (beta h)^2. They are stable if these lie in the
 *  stability region of the method. With the two Euler methods,
 *  |Phi'| = h |gamma| / 2 and |Phi| = (alpha h / (beta h)^2) h^2 |gamma| remain. Runge-Kutta
 *  methods lose order as with baum_gains_deadbeat(), for the same reason.
 *  @param alpha_h   [-] alpha h >= 0
 *  @param beta2_h2  [-] (beta h)^2 >= 0
 *  @return  the rule */
BAUM_API baum_gains baum_gains_scaled(double alpha_h, double beta2_h2);

/** Gains of the Taylor expansion, equations (10) and (11): alpha = 1/h, beta = sqrt(2)/h. With
 *  explicit Euler the roots lie on the unit circle (marginal: violations remain), with
 *  semi-implicit Euler and AB2 to AB4 outside (refused). With RK2 these gains are dead-beat; with
 *  RK3 and RK4 the spectral radius is 0.47 and 0.37. The accuracy is that of baum_gains_deadbeat().
 *  @return  the rule */
BAUM_API baum_gains baum_gains_taylor(void);

/** Gains given by the natural frequency and the damping ratio of (6); otherwise as
 *  baum_gains_fixed(). With damping ratios below 0.618, CVODE BDF and IDA may not damp violations.
 *  @param hertz          [Hz] > 0, natural frequency
 *  @param damping_ratio  [-] > 0, 1 is critical
 *  @return  the rule */
BAUM_API baum_gains baum_gains_frequency(double hertz, double damping_ratio);

/** Gains for which both roots z are zero. This is the fastest possible decay: a violation vanishes
 *  after at most two steps. Explicit Euler: alpha = beta = 1/h. Semi-implicit Euler: alpha =
 *  1/(2h), beta = 1/h. RK2: alpha = 1/h, beta = sqrt(2)/h. Other Runge-Kutta methods: a zero of
 *  their stability polynomial. With the two Euler methods, |Phi'| = h |gamma| / 2 and |Phi| = h^2
 *  |gamma| remain (semi-implicit Euler: half of this |Phi|).
 *
 *  Runge-Kutta methods lose their order, because the gains grow as the step shrinks: orders 2, 3,
 *  4, 5, 8 become 1, 2, 2, 3, 2, and errors are 800 times (RK2) to 4000 times (RK4) as large as
 *  without gains. The Euler methods remain of order 1. Fixed step only. Multistep methods have no
 *  dead-beat point and refuse the rule.
 *  @return  the rule */
BAUM_API baum_gains baum_gains_deadbeat(void);

/** Gains alpha = beta, constant during a run, in proportion to the mean angular velocity max(|v|/L,
 *  sqrt(|a|/L)) over the first radians of the motion. L is the characteristic length.
 *
 *  The gains are this angular velocity times a factor. At a fixed step the factor is 0.35 for
 *  Runge-Kutta methods, but 0.05 for RK2, so that it keeps its order, and 0.2 for Euler and
 *  Adams-Bashforth methods. At variable steps it is 0.25 for CVODE and IDA, and 0.1 for explicit
 *  methods, whose steps are longer. If drivers prescribe the whole motion, the factor is 0.6 at a
 *  fixed step, 40 for CVODE and IDA, whose matrices include the gains, and 2 for explicit methods
 *  at variable steps.
 *
 *  Limit: alpha h is at most 0.3 and at most half of the method's stability limit, so the gains are
 *  stable. Violations stay at about the local error of a step and decay over some radians. The
 *  method keeps its order, and the cost is that of a run without gains.
 *
 *  The angular velocity comes from a pilot run of 5 steps and 14 evaluations when the run is
 *  created; the counters include it. If the pilot run fails, the part before the failure is used.
 *  For mechanisms with degrees of freedom, and for those at rest in equilibrium, the angular
 *  velocity is at least sqrt(g/L), the angular frequency of a pendulum of length L. At rest in
 *  equilibrium without gravity, alpha is 0.01/h, or 1 1/s at variable steps, which only suits
 *  machines with time scales of seconds. docs/theory/gain_rules.md compares other factors.
 *  @return  the rule */
BAUM_API baum_gains baum_gains_auto(void);

/** Gains of least spectral radius: the dead-beat point if the method has one. AB2 to AB4 have none.
 *  For AB2 these gains are alpha = beta = 2/(3h), with spectral radius 0.58; AB3 and AB4 have the
 *  radii 0.69 and 0.81. The rule is the default for AB2 to AB4. It makes their violations 10 to 100
 *  times smaller than auto does. AB2 to AB4 keep their order, because they have no stages between
 *  steps; their errors are 1.3 times (AB3) to 8 times (AB2, AB4) as large as without gains. Other
 *  methods above order 1 lose order, see baum_gains_deadbeat(). Fixed step only.
 *  @return  the rule */
BAUM_API baum_gains baum_gains_best_damping(void);

/** What happens to a violation in the long run. */
typedef enum baum_stability {
  BAUM_STABLE = 0, /**< Every violation decays: spectral radius < 1. */
  /** Some violation neither decays nor grows exponentially: radius = 1. */
  BAUM_MARGINAL = 1,
  BAUM_UNSTABLE = 2, /**< Some violation grows exponentially: radius > 1. */
  /** No region: the method chooses its step. See baum_stability_statement(). */
  BAUM_VARIABLE_STEP = 3,
  BAUM_WITHOUT_GAINS = 4 /**< No region: the method keeps the constraints without gains. */
} baum_stability;

/** Amplification of a violation by one step. */
typedef struct baum_amplification {
  size_t struct_size;       /**< Set by baum_stability_at(). */
  baum_stability stability; /**< Class. */
  double spectral_radius;   /**< [-] largest |z|; NaN without a region. */
  /** [-] largest root z of each of the two modes, as real and imaginary part; the mode with the
   *  larger |z| comes first. NaN without a region. */
  double z[2][2];
  /** [-] 1 - spectral_radius, computed without cancellation: the fraction of the slowest violation
   *  that a step removes. Negative if violations grow; NaN without a region. */
  double damping;
} baum_amplification;

/** Compute the amplification at a point (alpha h, beta^2 h^2), as in Fig. 1 of Flores et al.
 *  @param      integrator   the method
 *  @param      alpha_h      [-] |alpha h|, finite
 *  @param      beta2_h2     [-] (beta h)^2, finite
 *  @param[out] out          the result
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_stability_at(const baum_integrator *integrator, double alpha_h,
                                       double beta2_h2, baum_amplification *out,
                                       size_t caller_size);

/** Compute the amplification of rows of velocity level, J v = nu. Their equation J a = gamma -
 *  alpha (J v - nu) has a single mode z = R(-alpha h), so z[1] is NaN.
 *  @param      integrator   the method
 *  @param      alpha_h      [-] alpha h, finite
 *  @param[out] out          the result
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_stability_velocity_at(const baum_integrator *integrator, double alpha_h,
                                                baum_amplification *out, size_t caller_size);

/** Find the alpha h up to which rows of velocity level are stable.
 *  @param      integrator  the method; its step is fixed
 *  @param[out] alpha_h     [-] the limit
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region of stability) */
BAUM_API baum_status baum_stability_velocity_limit(const baum_integrator *integrator,
                                                   double *alpha_h);

/** Describe the effect of gains with a method in words, also for a method without a region.
 *  @param integrator  may be NULL
 *  @return  static text; NULL for NULL */
BAUM_API const char *baum_stability_statement(const baum_integrator *integrator);

/** Find the largest alpha h up to which alpha = damping_ratio x beta is stable.
 *  @param      integrator     the method
 *  @param      damping_ratio  [-] > 0, finite
 *  @param[out] alpha_h        [-] the first instability from 0 on; 0 if small gains are unstable.
 *                             baum_stability_intervals() finds stable intervals beyond it.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_limit(const baum_integrator *integrator, double damping_ratio,
                                          double *alpha_h);

/** Find all intervals of alpha h in which alpha = damping_ratio x beta is stable. Most methods have
 *  one interval, which begins at 0. Intervals, and gaps between them, may be missed if they are
 *  narrower than 1 % of their alpha h.
 *  @param      integrator     the method
 *  @param      damping_ratio  [-] > 0, finite
 *  @param      capacity       [-] of the arrays; >= 0
 *  @param[out] from,to        [-] (capacity) the first intervals in order; `to` may be infinite.
 *                             NULL if capacity is 0.
 *  @param[out] count          [-] number of intervals, which may exceed the capacity
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_intervals(const baum_integrator *integrator,
                                              double damping_ratio, int32_t capacity, double *from,
                                              double *to, int32_t *count);

/** Find the alpha h of fastest decay for alpha = damping_ratio x beta.
 *  @param      integrator     the method
 *  @param      damping_ratio  [-] > 0, finite
 *  @param[out] alpha_h        [-] 0 if nothing is stable
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_best_on_ray(const baum_integrator *integrator,
                                                double damping_ratio, double *alpha_h);

/** Find the point of fastest decay with alpha h > 0: the dead-beat point if there is one. If
 *  several points are equally good, it is the one with the smallest gains. Takes tens of
 *  milliseconds for Adams-Bashforth methods.
 *  @param      integrator        the method
 *  @param[out] alpha_h,beta2_h2  [-] the point
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_best(const baum_integrator *integrator, double *alpha_h,
                                         double *beta2_h2);

/** Find the dead-beat point, where all roots are zero; see baum_gains_deadbeat().
 *  @param      integrator        the method
 *  @param[out] alpha_h,beta2_h2  [-] the point
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region, or a multistep method,
 *           which has no such point) */
BAUM_API baum_status baum_stability_deadbeat(const baum_integrator *integrator, double *alpha_h,
                                             double *beta2_h2);

/** Find the nearest point with spectral radius <= 0.9 in the plane of (alpha h, beta^2 h^2). Its
 *  distance is within 1 % of the least.
 *  @param      integrator                  the method
 *  @param      alpha_h,beta2_h2            [-] finite, the requested point
 *  @param[out] good_alpha_h,good_beta2_h2  [-] the nearest such point; the requested point if its
 *                                          spectral radius is <= 0.9
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_nearest(const baum_integrator *integrator, double alpha_h,
                                            double beta2_h2, double *good_alpha_h,
                                            double *good_beta2_h2);

/** Compute spectral radii on a rectangular grid of the plane.
 *  @param      integrator    the method
 *  @param      alpha_h       [-] (2) alpha h of the first and last column, finite
 *  @param      beta2_h2      [-] (2) (beta h)^2 of the first and last row, finite
 *  @param      columns,rows  [-] >= 1; a single column or row is at the first value
 *  @param[out] radius        [-] (rows x columns) row-major; infinite if it overflows
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_grid(const baum_integrator *integrator, const double alpha_h[2],
                                         const double beta2_h2[2], int32_t columns, int32_t rows,
                                         double *radius);

/** Trace the outline of the region in alpha h >= 0, beta^2 h^2 >= 0 where the spectral radius is at
 *  most a given number. The number 1 gives the region of stability; a smaller number gives the
 *  region where violations decay at least that fast.
 *
 *  A closed curve, which repeats its first point, bounds each part of the region and each hole in
 *  it. The region is on the right of the curve. One point of NaNs separates curves. The points lie
 *  where the spectral radius has the given value, or on an axis where the axis bounds the region.
 *  Parts smaller than about a hundredth of the whole may be missed. Uses 30 kB of stack.
 *  @param      integrator        the method
 *  @param      radius            [-] > 0, finite
 *  @param      capacity          [-] of the arrays; >= 0. 2000 is enough for every method here.
 *  @param[out] alpha_h,beta2_h2  [-] (capacity) the first points. NULL if capacity is 0.
 *  @param[out] count             [-] number of points, which may exceed the capacity; 0 if the
 *                                radius is nowhere so small
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (no region) */
BAUM_API baum_status baum_stability_outline(const baum_integrator *integrator, double radius,
                                            int32_t capacity, double *alpha_h, double *beta2_h2,
                                            int32_t *count);

#ifdef __cplusplus
}
#endif

#endif
