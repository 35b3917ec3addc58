/* SPDX-License-Identifier: BSD-3-Clause */
/* The classical method of order 4 (W. Kutta, 1901).
 *
 *   0   |
 *   1/2 | 1/2
 *   1/2 | 0    1/2
 *   1   | 0    0    1
 *       | 1/6  1/3  1/3  1/6
 *
 * The amplification of a violation is z = R(mu) = 1 + mu + mu^2/2 + mu^3/6 + mu^4/24 (mu:
 * amplification.h).
 */
#include "integrate/rk.h"

static const double C[] = {0.0, 1.0 / 2.0, 1.0 / 2.0, 1.0};
static const double A[] = {1.0 / 2.0, 0.0, 1.0 / 2.0, 0.0, 0.0, 1.0};
static const double B[] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};

static const baum_i_rk_table TABLE = {.stages = 4, .c = C, .a = A, .b = B};

static const baum_integrator INTEGRATOR = {
  .name = "rk4",
  .table = &TABLE,
  .order = 4,
  .method = {.kind = BAUM_I_METHOD_ONE_STEP,
             .degree = 4,
             .coefficients = {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0}},
  BAUM_I_RK_OPERATIONS,
};

const baum_integrator *baum_rk4(void)
{
  return &INTEGRATOR;
}
