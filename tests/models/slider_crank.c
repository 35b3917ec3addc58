/* SPDX-License-Identifier: BSD-3-Clause */
/* Slider-crank with the data of P. Flores, R. Leine, C. Glocker, Multibody System Dynamics 23
 * (2010), table 1, without clearance; the eccentricity of 0.05 m is not theirs. Crank 1 from the
 * origin, rod 2, slider 3 on y = e:
 *
 *   l1 sin th1 + l2 sin th2 = e,  x3 = l1 cos th1 + l2 cos th2,  th1(0) = 0, th1'(0) = 150 rad/s
 */
#include "builder.h"

#include <math.h>

static const double CRANK = 0.153;
static const double ROD = 0.306;
static const double ECCENTRICITY = 0.05;
static const double SPEED = 150.0;

typedef struct bodies {
  baum_body_id crank;
  baum_body_id rod;
  baum_body_id slider;
} bodies;

static bodies add_bodies(builder *build, bool rough)
{
  bodies out;
  double angle = rough ? 0.0 : asin(ECCENTRICITY / ROD);
  double reach = CRANK + ROD * cos(angle);
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = "crank";
  def.mass = 0.038;
  def.inertia = 7.4e-5;
  def.position[0] = CRANK / 2;
  def.angular_velocity = SPEED;
  def.held = true;
  out.crank = build_body(build, &def);

  def = baum_planar_body_def_default();
  def.name = "rod";
  def.mass = 0.038;
  def.inertia = 5.9e-4;
  def.position[0] = CRANK + ROD / 2 * cos(angle);
  def.position[1] = ROD / 2 * sin(angle);
  def.angle = angle;
  out.rod = build_body(build, &def);

  def = baum_planar_body_def_default();
  def.name = "slider";
  def.mass = 0.076;
  def.inertia = 2.7e-6;
  def.position[0] = reach + (rough ? 0.01 : 0.0);
  def.position[1] = ECCENTRICITY - (rough ? 0.02 : 0.0);
  out.slider = build_body(build, &def);
  return out;
}

static void add_guide(builder *build, baum_body_id slider)
{
  if (!build_fine(build)) {
    return;
  }
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.name = "guide";
  def.body_a = BAUM_GROUND;
  def.body_b = slider;
  def.point_a[0] = 0.0;
  def.point_a[1] = ECCENTRICITY;
  def.point_b[0] = def.point_b[1] = 0.0;
  baum_joint_id id = {0};
  baum_status status = baum_mechanism_add_planar_translational(build->out->mechanism, &def, &id);
  build_joint(build, status, id);
}

static void add_motor(builder *build, baum_joint_id pin)
{
  if (!build_fine(build)) {
    return;
  }
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  def.joint = pin;
  def.rate = SPEED;
  baum_joint_id id = {0};
  baum_status status = baum_mechanism_add_driver(build->out->mechanism, &def, &id);
  build_joint(build, status, id);
}

baum_status model_slider_crank_build(model_slider_crank options, model *out)
{
  builder build = build_begin(out);
  bodies body = add_bodies(&build, options.rough);
  baum_joint_id pin = build_pin(&build, "A", (place){BAUM_GROUND, {0.0, 0.0}},
                                (place){body.crank, {-CRANK / 2, 0.0}});
  build_pin(&build, "B", (place){body.crank, {CRANK / 2, 0.0}}, (place){body.rod, {-ROD / 2, 0.0}});
  build_pin(&build, "C", (place){body.rod, {ROD / 2, 0.0}}, (place){body.slider, {0.0, 0.0}});
  add_guide(&build, body.slider);
  if (options.driven) {
    add_motor(&build, pin);
  }
  return build_finish(&build);
}
