/* SPDX-License-Identifier: BSD-3-Clause */
/* Cranks of 1 m and 1 kg from (0, 0), (2, 0) and (1, 0), which carry a coupler of 2 m and 2 kg.
 *
 * Two cranks keep the coupler level; a third one of the same length then moves along by itself, and
 * one of the two rows of its pin says nothing new. A massless rod of 1 m instead, from its tip to the
 * coupler's left end, gives the one row that is needed.
 */
#include "builder.h"

#include <math.h>

static const double RATE = 2.0;

static baum_planar_body_def rod(const char *name, double mass, double length)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = name;
  def.mass = mass;
  def.inertia = mass * length * length / 12.0;
  return def;
}

static baum_body_id add_crank(builder *build, const char *name, double x, double angle)
{
  baum_planar_body_def def = rod(name, 1.0, 1.0);
  def.position[0] = x + cos(angle) / 2;
  def.position[1] = sin(angle) / 2;
  def.angle = angle;
  def.velocity[0] = -sin(angle) / 2 * RATE;
  def.velocity[1] = cos(angle) / 2 * RATE;
  def.angular_velocity = RATE;
  baum_body_id crank = build_body(build, &def);
  build_pin(build, NULL, (place){BAUM_GROUND, {x, 0.0}}, (place){crank, {-0.5, 0.0}});
  return crank;
}

static baum_body_id add_coupler(builder *build, double angle)
{
  baum_planar_body_def def = rod("coupler", 2.0, 2.0);
  def.position[0] = 1.0 + cos(angle);
  def.position[1] = sin(angle);
  def.velocity[0] = -sin(angle) * RATE;
  def.velocity[1] = cos(angle) * RATE;
  def.angular_velocity = 0.0;
  return build_body(build, &def);
}

static void pin_tip(builder *build, baum_body_id crank, baum_body_id coupler, double along)
{
  build_pin(build, NULL, (place){crank, {0.5, 0.0}}, (place){coupler, {along, 0.0}});
}

static void add_rod(builder *build, baum_body_id crank, baum_body_id coupler)
{
  if (!build_fine(build)) {
    return;
  }
  baum_planar_distance_def def = baum_planar_distance_def_default();
  double length = build_unit(build, 1, 0, 0);
  def.name = "rod";
  def.body_a = crank;
  def.body_b = coupler;
  def.point_a[0] = 0.5 * length;
  def.point_b[0] = -length;
  def.point_a[1] = def.point_b[1] = 0.0;
  def.length = length;
  baum_joint_id id = {0};
  baum_status status = baum_mechanism_add_planar_distance(build->out->mechanism, &def, &id);
  build_joint(build, status, id);
}

/* Where the last crank's tip is pinned to the coupler, a second pin. */
static void double_pin(builder *build, const model_parallelogram_data *data, baum_body_id crank,
                       baum_body_id coupler)
{
  double c = cos(data->angle);
  double s = sin(data->angle);
  place on_crank = {crank, {0.5 + data->gap + data->aside * c, -data->aside * s}};
  place on_coupler = {coupler, {1.0 + data->aside, 0.0}};
  build_pin(build, "pin again", on_crank, on_coupler);
}

baum_status model_parallelogram_build_of(const model_parallelogram_data *data, model *out)
{
  builder build = build_begin_in(data->units, out);
  build_gravity(&build, 9.81);
  baum_body_id first = add_crank(&build, "first crank", 0.0, data->angle);
  baum_body_id last = add_crank(&build, "last crank", 2.0, data->angle);
  baum_body_id coupler = add_coupler(&build, data->angle);
  pin_tip(&build, first, coupler, -1.0);
  pin_tip(&build, last, coupler, 1.0);
  if (data->which != MODEL_TWO_CRANKS) {
    baum_body_id middle = add_crank(&build, "middle crank", 1.0, data->angle);
    if (data->which == MODEL_THREE_CRANKS) {
      pin_tip(&build, middle, coupler, 0.0);
    } else {
      add_rod(&build, middle, coupler);
    }
  }
  if (data->doubled) {
    double_pin(&build, data, last, coupler);
  }
  return build_finish(&build);
}

baum_status model_parallelogram_build(model_parallelogram which, double angle, model *out)
{
  const model_parallelogram_data data = {.which = which, .angle = angle};
  return model_parallelogram_build_of(&data, out);
}
