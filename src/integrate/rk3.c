/* SPDX-License-Identifier: BSD-3-Clause */
/* Kutta's method of order 3 (W. Kutta, 1901).
 *
 *   0   |
 *   1/2 |  1/2
 *   1   | -1    2
 *       |  1/6  2/3  1/6
 *
 * A violation obeys z = R(mu), R(mu) = 1 + mu + mu^2/2 + mu^3/6.
 */
#include "integrate/rk.h"

static const double C[] = {0.0, 1.0 / 2.0, 1.0};
static const double A[] = {1.0 / 2.0, -1.0, 2.0};
static const double B[] = {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0};

static const baum_i_rk_table TABLE = {.stages = 3, .c = C, .a = A, .b = B};

static baum_status create(const baum_i_problem *problem, const baum_i_state *start, void **out)
{
  (void)start;
  return baum_i_rk_create(&TABLE, problem, out);
}

static const baum_integrator INTEGRATOR = {
  .name = "rk3",
  .order = 3,
  .formulations = baum_i_rk_formulations,
  .gains = BAUM_GAINS_AUTO,
  .method = {.kind = BAUM_I_METHOD_ONE_STEP,
             .degree = 3,
             .coefficients = {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0}},
  .create = create,
  .destroy = baum_i_rk_destroy,
  .step = baum_i_rk_step,
};

const baum_integrator *baum_rk3(void)
{
  return &INTEGRATOR;
}
