/* SPDX-License-Identifier: BSD-3-Clause */
/* The pendulum of the catalogue, with its circle as a user constraint without derivatives. */
#include "models.h"

static int circle(double t, const double *q, double *phi, void *user)
{
  (void)t;
  (void)user;
  phi[0] = q[0] * q[0] + q[1] * q[1] - 1.0;
  return 0;
}

baum_status model_pendulum_circle(const model_pendulum *data, model *out)
{
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_parts_gravity(&parts, data->gravity);
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  bob.name = "bob";
  bob.position[0] = data->x;
  bob.velocity[0] = 0.0;
  bob.velocity[1] = data->v;
  baum_body_id id = baum_i_parts_particle(&parts, &bob);
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.name = "circle";
  def.row_count = 1;
  def.phi = circle;
  baum_i_parts_constraint(&parts, id, def);
  return model_finish(&parts, NULL, out);
}
