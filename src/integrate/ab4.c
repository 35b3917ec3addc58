/* SPDX-License-Identifier: BSD-3-Clause */
/* The explicit Adams method of four steps, order 4 (J. C. Adams, in: F. Bashforth, 1883).
 *
 * The weights w_j(theta) of past steps (adams_bashforth.c), and b_j = w_j(1), are:
 *
 *   w_0 = theta + 11 theta^2/12 + theta^3/3 + theta^4/24
 *   w_1 = -3 theta^2/2 - 5 theta^3/6 - theta^4/8
 *   w_2 = 3 theta^2/4 + 2 theta^3/3 + theta^4/8
 *   w_3 = -theta^2/6 - theta^3/6 - theta^4/24;  b = 55/24, -59/24, 37/24, -9/24
 *
 * The amplification z of a violation satisfies z^4 = z^3 + mu (55 z^3 - 59 z^2 + 37 z - 9)/24 (mu:
 * amplification.h). With alpha = beta, violations decay if alpha h is below 3/10.
 */
#include "integrate/adams_bashforth.h"

static const double WEIGHTS[] = {
  1.0, 11.0 / 12.0, 1.0 / 3.0,  1.0 / 24.0,  //
  0.0, -3.0 / 2.0,  -5.0 / 6.0, -1.0 / 8.0,  //
  0.0, 3.0 / 4.0,   2.0 / 3.0,  1.0 / 8.0,   //
  0.0, -1.0 / 6.0,  -1.0 / 6.0, -1.0 / 24.0, //
};

static const baum_i_adams_table TABLE = {.steps = 4, .weights = WEIGHTS};

static const baum_integrator INTEGRATOR = {
  .name = "ab4",
  .table = &TABLE,
  .order = 4,
  .method = {.kind = BAUM_I_METHOD_ADAMS_BASHFORTH,
             .degree = 4,
             .coefficients = {55.0 / 24.0, -59.0 / 24.0, 37.0 / 24.0, -9.0 / 24.0},
             .best = {0.21464433859629878, 0.21464433859629878 * 0.21464433859629878}},
  BAUM_I_ADAMS_OPERATIONS,
};

const baum_integrator *baum_ab4(void)
{
  return &INTEGRATOR;
}
