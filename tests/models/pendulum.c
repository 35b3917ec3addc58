/* SPDX-License-Identifier: BSD-3-Clause */
#include "builder.h"

const model_pendulum MODEL_PENDULUM_A01 = {.gravity = 9.81, .x = -1.0};
const model_pendulum MODEL_PENDULUM_SUNDIALS = {.gravity = 13.750371636040745, .x = 1.0};

static baum_body_id add_bob(builder *build, const model_pendulum *data)
{
  build_gravity(build, data->gravity);
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  bob.name = "bob";
  bob.position[0] = data->x;
  bob.velocity[0] = 0.0;
  bob.velocity[1] = data->v;
  return build_particle(build, &bob);
}

baum_status model_pendulum_rod(const model_pendulum *data, model *out)
{
  builder build = build_begin(out);
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.name = "rod";
  rod.body_a = BAUM_GROUND;
  rod.body_b = add_bob(&build, data);
  rod.point_a[0] = rod.point_a[1] = 0.0;
  rod.point_b[0] = rod.point_b[1] = 0.0;
  rod.length = 1.0;
  if (build_fine(&build)) {
    baum_joint_id id = {0};
    baum_status status = baum_mechanism_add_planar_distance(out->mechanism, &rod, &id);
    build_joint(&build, status, id);
  }
  return build_finish(&build);
}

static int circle(double t, const double *q, double *phi, void *user)
{
  (void)t;
  (void)user;
  phi[0] = q[0] * q[0] + q[1] * q[1] - 1.0;
  return 0;
}

baum_status model_pendulum_circle(const model_pendulum *data, model *out)
{
  builder build = build_begin(out);
  baum_body_id bob = add_bob(&build, data);
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.name = "circle";
  def.bodies = &bob;
  def.body_count = 1;
  def.row_count = 1;
  def.phi = circle;
  build_constraint(&build, &def);
  return build_finish(&build);
}
