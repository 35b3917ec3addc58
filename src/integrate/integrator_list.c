/* SPDX-License-Identifier: BSD-3-Clause */
/* The list of all integrators. This is the only file that refers to all of them, so a program that
 * links it contains every integrator. */
#include "integrate/integrator.h"

typedef const baum_integrator *integrator_fn(void);

static integrator_fn *const INTEGRATORS[] = {
  baum_euler,       baum_semi_implicit_euler,
  baum_rk2,         baum_rk3,
  baum_rk4,         baum_dp5,
  baum_rk8,         baum_ab2,
  baum_ab3,         baum_ab4,
  baum_rattle,      baum_generalized_alpha,
  baum_cvode_adams, baum_cvode_bdf,
  baum_ida,         baum_kinematics,
};

const baum_integrator *baum_integrator_at(int32_t k)
{
  int32_t count = (int32_t)(sizeof INTEGRATORS / sizeof INTEGRATORS[0]);
  return k >= 0 && k < count ? INTEGRATORS[k]() : NULL;
}
