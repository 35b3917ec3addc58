/* SPDX-License-Identifier: BSD-3-Clause */
/* Gravity: force m g at the centre of mass r, potential -m g . r; in the plane of x and y alone. */
#include "mechanism/general/gravity.h"

static double mass_of(const baum_i_body *body, const baum_i_point *point)
{
  return point->parameters[body->element.parameter + BAUM_I_GRAVITY_MASS];
}

static int dimensions(const baum_i_body *body)
{
  return baum_i_is_spatial(body->type->frame) ? 3 : 2;
}

baum_status baum_i_gravity_force(const baum_i_body_group *group, baum_i_point *point, double *force)
{
  const double *gravity = point->mechanism->gravity;
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    double mass = mass_of(body, point);
    for (int k = 0; k < dimensions(body); k++) {
      force[body->v + k] += mass * gravity[k];
    }
  }
  return BAUM_OK;
}

baum_status baum_i_gravity_potential(const baum_i_body *body, baum_i_point *point, double *sum)
{
  const double *gravity = point->mechanism->gravity;
  const double *r = point->q + body->q;
  double height = gravity[0] * r[0] + gravity[1] * r[1];
  if (dimensions(body) == 3) {
    height += gravity[2] * r[2];
  }
  *sum -= mass_of(body, point) * height;
  return BAUM_OK;
}
