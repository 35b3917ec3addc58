/* SPDX-License-Identifier: BSD-3-Clause */
/* The explicit Adams method of three steps, order 3 (J. C. Adams, in: F. Bashforth, 1883).
 *
 * The weights w_j(theta) of past steps (adams_bashforth.c), and b_j = w_j(1), are:
 *
 *   w_0 = theta + 3 theta^2/4 + theta^3/6
 *   w_1 = -theta^2 - theta^3/3
 *   w_2 = theta^2/4 + theta^3/6;  b = 23/12, -16/12, 5/12
 *
 * The amplification z of a violation satisfies z^3 = z^2 + mu (23 z^2 - 16 z + 5)/12 (mu:
 * amplification.h). With alpha = beta, violations decay if alpha h is below 6/11.
 */
#include "integrate/adams_bashforth.h"

static const double WEIGHTS[] = {
  1.0, 3.0 / 4.0, 1.0 / 6.0,  //
  0.0, -1.0,      -1.0 / 3.0, //
  0.0, 1.0 / 4.0, 1.0 / 6.0,  //
};

static const baum_i_adams_table TABLE = {.steps = 3, .weights = WEIGHTS};

static const baum_integrator INTEGRATOR = {
  .name = "ab3",
  .table = &TABLE,
  .order = 3,
  .method = {.kind = BAUM_I_METHOD_ADAMS_BASHFORTH,
             .degree = 3,
             .coefficients = {23.0 / 12.0, -16.0 / 12.0, 5.0 / 12.0},
             .best = {33.0 / 92.0, 33.0 / 92.0 * 33.0 / 92.0}},
  BAUM_I_ADAMS_OPERATIONS,
};

const baum_integrator *baum_ab3(void)
{
  return &INTEGRATOR;
}
