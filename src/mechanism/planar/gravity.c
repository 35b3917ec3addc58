/* SPDX-License-Identifier: BSD-3-Clause */
/* Gravity in the plane: force (m g_x, m g_y) at the centre of mass (x, y),
 * potential -m (g_x x + g_y y). */
#include "mechanism/planar/gravity.h"

static double mass_of(const baum_i_body *body, const baum_i_point *point)
{
  return point->parameters[body->element.parameter + BAUM_I_GRAVITY_MASS];
}

baum_status baum_i_gravity_force(const baum_i_body_group *group, baum_i_point *point, double *force)
{
  const double *gravity = point->mechanism->gravity;
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    double mass = mass_of(body, point);
    force[body->v] += mass * gravity[0];
    force[body->v + 1] += mass * gravity[1];
  }
  return BAUM_OK;
}

baum_status baum_i_gravity_potential(const baum_i_body *body, baum_i_point *point, double *sum)
{
  const double *gravity = point->mechanism->gravity;
  const double *r = point->q + body->q;
  *sum -= mass_of(body, point) * (gravity[0] * r[0] + gravity[1] * r[1]);
  return BAUM_OK;
}
