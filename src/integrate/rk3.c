/* SPDX-License-Identifier: BSD-3-Clause */
/* Kutta's method of order 3 (W. Kutta, 1901).
 *
 *   0   |
 *   1/2 |  1/2
 *   1   | -1    2
 *       |  1/6  2/3  1/6
 *
 * The amplification of a violation is z = R(mu) = 1 + mu + mu^2/2 + mu^3/6 (mu:
 * amplification.h).
 */
#include "integrate/rk.h"

static const double C[] = {0.0, 1.0 / 2.0, 1.0};
static const double A[] = {1.0 / 2.0, -1.0, 2.0};
static const double B[] = {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0};

static const baum_i_rk_table TABLE = {.stages = 3, .c = C, .a = A, .b = B};

static const baum_integrator INTEGRATOR = {
  .name = "rk3",
  .table = &TABLE,
  .order = 3,
  .method = {.kind = BAUM_I_METHOD_ONE_STEP,
             .degree = 3,
             .coefficients = {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0}},
  BAUM_I_RK_OPERATIONS,
};

const baum_integrator *baum_rk3(void)
{
  return &INTEGRATOR;
}
