/* SPDX-License-Identifier: BSD-3-Clause */
/* Crank-rocker of uniform rods: crank a, coupler b, rocker c, pins of the frame at (0, 0) and
 * (d, 0).
 *
 *   a (cos, sin) th1 + b (cos, sin) th2 - c (cos, sin) th3 - (d, 0) = 0
 */
#include "builder.h"

#include <math.h>

static const double CRANK = 1.0;
static const double COUPLER = 3.0;
static const double ROCKER = 2.5;
static const double FRAME = 2.8;

/* A uniform rod that starts at (x, y). */
static baum_planar_body_def rod(const char *name, double mass, double length, double angle)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = name;
  def.mass = mass;
  def.inertia = mass * length * length / 12;
  def.position[0] = length / 2 * cos(angle);
  def.position[1] = length / 2 * sin(angle);
  def.angle = angle;
  return def;
}

baum_status model_four_bar(model *out)
{
  return model_four_bar_in(NULL, out);
}

baum_status model_four_bar_in(const model_units *units, model *out)
{
  builder build = build_begin_in(units, out);
  build_gravity(&build, 9.81);
  baum_planar_body_def crank = rod("crank", 1.0, CRANK, 1.0);
  crank.angular_velocity = 2.0;
  crank.held = true;
  /* th2, th3 at th1 = 1: where circles about the crank's tip and the rocker's pin meet, above. */
  double tip[2] = {CRANK * cos(1.0), CRANK * sin(1.0)};
  double between = hypot(FRAME - tip[0], tip[1]);
  double inner =
    acos((COUPLER * COUPLER + between * between - ROCKER * ROCKER) / (2 * COUPLER * between));
  double angle = inner + atan2(-tip[1], FRAME - tip[0]);
  double joint[2] = {tip[0] + COUPLER * cos(angle), tip[1] + COUPLER * sin(angle)};
  baum_planar_body_def coupler = rod("coupler", 2.0, COUPLER, angle);
  coupler.position[0] += tip[0];
  coupler.position[1] += tip[1];
  baum_planar_body_def rocker = rod("rocker", 1.5, ROCKER, atan2(joint[1], joint[0] - FRAME));
  rocker.position[0] += FRAME;

  baum_body_id a = build_body(&build, &crank);
  baum_body_id b = build_body(&build, &coupler);
  baum_body_id c = build_body(&build, &rocker);
  build_pin(&build, "A", (place){BAUM_GROUND, {0.0, 0.0}}, (place){a, {-CRANK / 2, 0.0}});
  build_pin(&build, "B", (place){a, {CRANK / 2, 0.0}}, (place){b, {-COUPLER / 2, 0.0}});
  build_pin(&build, "C", (place){b, {COUPLER / 2, 0.0}}, (place){c, {ROCKER / 2, 0.0}});
  build_pin(&build, "D", (place){BAUM_GROUND, {FRAME, 0.0}}, (place){c, {-ROCKER / 2, 0.0}});
  return build_finish(&build);
}
