/* SPDX-License-Identifier: BSD-3-Clause */
/* Slider-crank of SUNDIALS' examples idaSlCrank_dns and idasSlCrank_dns (R. Serban), read as rigid
 * bodies: a crank of inertia 1 about the origin with a pin at distance 1/2; a rod of mass 1 and
 * inertia 2 whose centre runs on the x axis while it turns, from the pin at (-1, 0) to (1, 0) in
 * its axes, where a force (1, 0) acts; a spring and damper from the middle of the crank to the
 * middle of pin and centre of the rod. No gravity.
 */
#include "builder.h"

#include <math.h>

static const double CRANK = 0.5;

static int guide(double t, const double *q, double *phi, void *user)
{
  (void)t;
  (void)user;
  phi[0] = q[1];
  return 0;
}

static int guide_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  out[1] = 1.0;
  return 0;
}

static void add_guide(builder *build, baum_body_id rod)
{
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.name = "guide";
  def.bodies = &rod;
  def.body_count = 1;
  def.row_count = 1;
  def.phi = guide;
  def.jacobian = guide_jacobian;
  build_constraint(build, &def);
}

static void add_forces(builder *build, baum_body_id crank, baum_body_id rod)
{
  baum_planar_spring_def spring = baum_planar_spring_def_default();
  spring.name = "spring";
  spring.body_a = crank;
  spring.body_b = rod;
  spring.point_a[0] = CRANK / 2;
  spring.point_b[0] = -0.5;
  spring.point_a[1] = spring.point_b[1] = 0.0;
  spring.stiffness = 1.0;
  spring.damping = 1.0;
  spring.free_length = 1.0;
  baum_planar_load_def load = baum_planar_load_def_default();
  load.name = "push";
  load.body = rod;
  load.point[0] = 1.0;
  load.force[0] = 1.0;
  if (build_fine(build)) {
    build_force(build, baum_mechanism_add_planar_spring(build->out->mechanism, &spring, NULL));
  }
  if (build_fine(build)) {
    build_force(build, baum_mechanism_add_planar_load(build->out->mechanism, &load, NULL));
  }
}

baum_status model_sundials_slider_crank(model *out)
{
  builder build = build_begin(out);
  build_gravity(&build, 0.0);
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = "crank";
  def.angle = acos(0.0);
  baum_body_id crank = build_body(&build, &def);
  def = baum_planar_body_def_default();
  def.name = "rod";
  def.inertia = 2.0;
  def.angle = -asin(CRANK);
  def.position[0] = cos(def.angle);
  baum_body_id rod = build_body(&build, &def);
  build_pin(&build, "A", (place){BAUM_GROUND, {0.0, 0.0}}, (place){crank, {0.0, 0.0}});
  build_pin(&build, "B", (place){crank, {CRANK, 0.0}}, (place){rod, {-1.0, 0.0}});
  add_guide(&build, rod);
  add_forces(&build, crank, rod);
  return build_finish(&build);
}
