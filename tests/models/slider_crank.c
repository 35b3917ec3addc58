/* SPDX-License-Identifier: BSD-3-Clause */
/* Slider-crank with the data of P. Flores, R. Leine, C. Glocker, Multibody System Dynamics 23
 * (2010), table 1, without clearance; the eccentricity of 0.05 m is not theirs. Crank 1 from the
 * origin, rod 2, slider 3 on y = e:
 *
 *   l1 sin th1 + l2 sin th2 = e,  x3 = l1 cos th1 + l2 cos th2,  th1(0) = 0, th1'(0) = 150 rad/s
 *
 * With l2 = l1 and e = 0 rod and crank fall on each other at th1 = pi/2, and J loses rank.
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

/* Lengths, and angles in radians. */
typedef struct pose {
  double rod;
  double eccentricity;
  double crank_angle;
  double rod_angle;
  double rod_rate;
} pose;

static pose find_pose(const model_slider_crank *options)
{
  pose out = {.rod = options->rod > 0.0 ? options->rod : ROD,
              .eccentricity = options->centric ? 0.0 : ECCENTRICITY,
              .crank_angle = options->angle};
  double rise = out.eccentricity - CRANK * sin(out.crank_angle);
  out.rod_angle = options->rough ? 0.0 : asin(rise / out.rod);
  out.rod_rate = -CRANK * cos(out.crank_angle) * SPEED / (out.rod * cos(out.rod_angle));
  return out;
}

static void add_crank(builder *build, const pose *at, bool moving, bodies *out)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = "crank";
  def.mass = 0.038;
  def.inertia = 7.4e-5;
  def.position[0] = CRANK / 2 * cos(at->crank_angle);
  def.position[1] = CRANK / 2 * sin(at->crank_angle);
  def.angle = at->crank_angle;
  def.angular_velocity = SPEED;
  def.held = true;
  if (moving) {
    def.velocity[0] = -CRANK / 2 * sin(at->crank_angle) * SPEED;
    def.velocity[1] = CRANK / 2 * cos(at->crank_angle) * SPEED;
  }
  out->crank = build_body(build, &def);
}

static bodies add_bodies(builder *build, const model_slider_crank *options, const pose *at)
{
  bodies out;
  bool rough = options->rough;
  double tip[2] = {CRANK * cos(at->crank_angle), CRANK * sin(at->crank_angle)};
  add_crank(build, at, options->moving, &out);

  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = "rod";
  def.mass = options->rod_mass > 0.0 ? options->rod_mass : 0.038;
  def.inertia = 5.9e-4 * (def.mass / 0.038) * (at->rod / ROD) * (at->rod / ROD);
  def.position[0] = tip[0] + at->rod / 2 * cos(at->rod_angle);
  def.position[1] = tip[1] + at->rod / 2 * sin(at->rod_angle);
  def.angle = at->rod_angle;
  if (options->moving) {
    def.velocity[0] = -tip[1] * SPEED - at->rod / 2 * sin(at->rod_angle) * at->rod_rate;
    def.velocity[1] = tip[0] * SPEED + at->rod / 2 * cos(at->rod_angle) * at->rod_rate;
    def.angular_velocity = at->rod_rate;
  }
  out.rod = build_body(build, &def);

  def = baum_planar_body_def_default();
  def.name = "slider";
  def.mass = 0.076;
  def.inertia = 2.7e-6;
  def.position[0] = tip[0] + at->rod * cos(at->rod_angle) + (rough ? 0.01 : 0.0);
  def.position[1] = at->eccentricity - (rough ? 0.02 : 0.0);
  if (options->moving) {
    def.velocity[0] = -tip[1] * SPEED - at->rod * sin(at->rod_angle) * at->rod_rate;
    def.velocity[1] = def.angular_velocity = 0.0;
  }
  out.slider = build_body(build, &def);
  return out;
}

/* Returns the last of them, with its centre of mass at the crank's pin; none: ground. */
static baum_body_id add_frames(builder *build, int count)
{
  baum_body_id last = BAUM_GROUND;
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_planar_fixed_def weld = baum_planar_fixed_def_default();
  def.mass = 2.0;
  weld.point_a[0] = weld.point_a[1] = weld.point_b[0] = weld.point_b[1] = 0.0;
  for (int k = 0; k < count && build_fine(build); k++) {
    baum_joint_id id = {0};
    weld.body_a = last;
    last = build_body(build, &def);
    weld.body_b = last;
    baum_status status = baum_mechanism_add_planar_fixed(build->out->mechanism, &weld, &id);
    build_joint(build, status, id);
  }
  return last;
}

static void add_motor(builder *build, baum_joint_id pin, double angle)
{
  if (!build_fine(build)) {
    return;
  }
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  def.joint = pin;
  def.value = angle;
  def.rate = SPEED * build_unit(build, 0, 0, -1);
  baum_joint_id id = {0};
  baum_status status = baum_mechanism_add_driver(build->out->mechanism, &def, &id);
  build_joint(build, status, id);
}

baum_status model_slider_crank_build(model_slider_crank options, model *out)
{
  builder build = build_begin_in(options.units, out);
  build_gravity(&build, 9.81);
  pose at = find_pose(&options);
  bodies body = add_bodies(&build, &options, &at);
  baum_body_id frame = add_frames(&build, options.frames);
  baum_joint_id pin =
    build_pin(&build, "A", (place){frame, {0.0, 0.0}}, (place){body.crank, {-CRANK / 2, 0.0}});
  build_pin(&build, "B", (place){body.crank, {CRANK / 2, 0.0}},
            (place){body.rod, {-at.rod / 2, 0.0}});
  build_pin(&build, "C", (place){body.rod, {at.rod / 2, 0.0}}, (place){body.slider, {0.0, 0.0}});
  build_guide(&build, "guide", body.slider, at.eccentricity, 0.0);
  if (options.doubled_guide) {
    build_guide(&build, "second guide", body.slider, at.eccentricity, CRANK / 2);
  }
  if (options.driven) {
    add_motor(&build, pin, options.angle);
  }
  return build_finish(&build);
}
