/* SPDX-License-Identifier: BSD-3-Clause */
/* The Runge-Kutta pair of orders 5 and 4 of J. R. Dormand and P. J. Prince (J. Comp. Appl. Math. 6,
 * 1980), with the interpolant of order 4 of L. F. Shampine; table and interpolant as in Hairer,
 * Norsett, Wanner 1993, sections II.5 and II.6.
 *
 *   0    |
 *   1/5  | 1/5
 *   3/10 | 3/40        9/40
 *   4/5  | 44/45      -56/15       32/9
 *   8/9  | 19372/6561 -25360/2187  64448/6561 -212/729
 *   1    | 9017/3168  -355/33      46732/5247  49/176  -5103/18656
 *        | 35/384      0           500/1113    125/192 -2187/6784    11/84
 *
 * The seventh rate is at the end of the step, and is the first rate of the next step. The weights
 * of the error estimate are those of order 5 minus those of order 4. The amplification of a
 * violation is z = R(mu) = 1 + mu + ... + mu^5/120 + mu^6/600 (mu: amplification.h).
 */
#include "integrate/rk_adaptive.h"

static const double C[] = {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0};

static const double A[] = {
  1.0 / 5.0,       3.0 / 40.0,       9.0 / 40.0,        44.0 / 45.0,      -56.0 / 15.0,
  32.0 / 9.0,      19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0,
  9017.0 / 3168.0, -355.0 / 33.0,    46732.0 / 5247.0,  49.0 / 176.0,     -5103.0 / 18656.0,
};

static const double B[] = {35.0 / 384.0,     0.0,        500.0 / 1113.0, 125.0 / 192.0,
                           -2187.0 / 6784.0, 11.0 / 84.0};

static const double ERROR[] = {71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
                               -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};

static const double DENSE[] = {
  -12715105075.0 / 11282082432.0,  0.0,
  87487479700.0 / 32700410799.0,   -10690763975.0 / 1880347072.0,
  701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
  69997945.0 / 29380423.0,
};

static const baum_i_rk_pair PAIR = {
  .name = "dp5",
  .table = {.stages = 6, .c = C, .a = A, .b = B},
  .error_order = 5,
  .error_count = 7,
  .error = ERROR,
  .dense = 1,
  .dense_row = DENSE,
};

static const baum_integrator INTEGRATOR = {
  .name = "dp5",
  .table = &PAIR,
  .order = 5,
  .method = {.kind = BAUM_I_METHOD_ONE_STEP,
             .degree = 6,
             .coefficients = {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0,
                              1.0 / 600.0}},
  BAUM_I_RK_ADAPTIVE_OPERATIONS,
};

const baum_integrator *baum_dp5(void)
{
  return &INTEGRATOR;
}
