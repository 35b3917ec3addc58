/* SPDX-License-Identifier: BSD-3-Clause */
/* The explicit Adams method of two steps, order 2 (J. C. Adams, in: F. Bashforth, 1883).
 *
 * The weights w_j(theta) of past steps (adams_bashforth.c), and b_j = w_j(1), are:
 *
 *   w_0 = theta + theta^2/2,  w_1 = -theta^2/2;  b = 3/2, -1/2
 *
 * The amplification z of a violation satisfies z^2 = z + mu (3 z - 1)/2 (mu: amplification.h). With
 * alpha = beta, violations decay if alpha h is below 1.
 */
#include "integrate/adams_bashforth.h"

static const double WEIGHTS[] = {
  1.0, 1.0 / 2.0,  //
  0.0, -1.0 / 2.0, //
};

static const baum_i_adams_table TABLE = {.steps = 2, .weights = WEIGHTS};

static const baum_integrator INTEGRATOR = {
  .name = "ab2",
  .table = &TABLE,
  .order = 2,
  .method = {.kind = BAUM_I_METHOD_ADAMS_BASHFORTH,
             .degree = 2,
             .coefficients = {3.0 / 2.0, -1.0 / 2.0},
             .best = {2.0 / 3.0, 4.0 / 9.0}},
  BAUM_I_ADAMS_OPERATIONS,
};

const baum_integrator *baum_ab2(void)
{
  return &INTEGRATOR;
}
