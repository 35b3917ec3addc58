/* SPDX-License-Identifier: BSD-3-Clause */
/* Explicit midpoint rule, order 2 (C. Runge, 1895).
 *
 *   0   |
 *   1/2 | 1/2
 *       | 0    1
 *
 * The amplification of a violation is z = R(mu) = 1 + mu + mu^2/2 (mu: amplification.h).
 */
#include "integrate/rk.h"

static const double C[] = {0.0, 1.0 / 2.0};
static const double A[] = {1.0 / 2.0};
static const double B[] = {0.0, 1.0};

static const baum_i_rk_table TABLE = {.stages = 2, .c = C, .a = A, .b = B};

static const baum_integrator INTEGRATOR = {
  .name = "rk2",
  .table = &TABLE,
  .order = 2,
  .method = {.kind = BAUM_I_METHOD_ONE_STEP, .degree = 2, .coefficients = {1.0, 1.0, 1.0 / 2.0}},
  BAUM_I_RK_OPERATIONS,
};

const baum_integrator *baum_rk2(void)
{
  return &INTEGRATOR;
}
