/* SPDX-License-Identifier: BSD-3-Clause */
/* Cranks of 1 m and 1 kg carry a coupler of 2 m and 2 kg. Their feet are at (0, 0), (2, 0) and (1,
 * above).
 *
 * Two cranks keep the coupler horizontal. A third crank of the same length therefore needs only one
 * of the two rows of its pin, and the other row is redundant. Instead of the pin, there may be a
 * massless rod of 1 m from the tip of the third crank to the left end of the coupler. The rod adds
 * only the row that is needed. With three cranks and `above` > 0, the mechanism has no singular
 * configurations. With two cranks, it is singular where it is flat.
 */
#include "models.h"

#include <math.h>

static const double RATE = 2.0; /* [rad/s] the default value */

static baum_planar_body_def rod(const char *name, double mass, double length)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = name;
  def.mass = mass;
  def.inertia = mass * length * length / 12.0;
  return def;
}

static double rate_of(const model_parallelogram_data *data)
{
  return data->rate != 0.0 ? data->rate : RATE;
}

static baum_body_id add_crank(baum_i_parts *parts, const model_parallelogram_data *data,
                              const char *name, double x, double y)
{
  double angle = data->angle;
  double rate = rate_of(data);
  baum_planar_body_def def = rod(name, 1.0, 1.0);
  def.position[0] = x + cos(angle) / 2;
  def.position[1] = y + sin(angle) / 2;
  def.angle = angle;
  def.velocity[0] = -sin(angle) / 2 * rate;
  def.velocity[1] = cos(angle) / 2 * rate;
  def.angular_velocity = rate;
  baum_body_id crank = baum_i_parts_body(parts, &def);
  baum_i_parts_pin(parts, NULL, (baum_i_spot){BAUM_GROUND, {x, y}},
                   (baum_i_spot){crank, {-0.5, 0.0}});
  return crank;
}

static baum_body_id add_coupler(baum_i_parts *parts, const model_parallelogram_data *data)
{
  double angle = data->angle;
  double rate = rate_of(data);
  baum_planar_body_def def = rod("coupler", 2.0, 2.0);
  def.position[0] = 1.0 + cos(angle);
  def.position[1] = sin(angle);
  def.velocity[0] = -sin(angle) * rate;
  def.velocity[1] = cos(angle) * rate;
  def.angular_velocity = 0.0;
  return baum_i_parts_body(parts, &def);
}

static void pin_tip(baum_i_parts *parts, baum_body_id crank, baum_body_id coupler, double along,
                    double above)
{
  baum_i_parts_pin(parts, NULL, (baum_i_spot){crank, {0.5, 0.0}},
                   (baum_i_spot){coupler, {along, above}});
}

/* Adds a second pin at the place where the tip of the last crank is pinned to the coupler. */
static void double_pin(baum_i_parts *parts, const model_parallelogram_data *data,
                       baum_body_id crank, baum_body_id coupler)
{
  double c = cos(data->angle);
  double s = sin(data->angle);
  baum_i_spot on_crank = {crank, {0.5 + data->gap + data->aside * c, -data->aside * s}};
  baum_i_spot on_coupler = {coupler, {1.0 + data->aside, 0.0}};
  baum_i_parts_pin(parts, "pin again", on_crank, on_coupler);
}

static void add_frame(baum_i_parts *parts)
{
  baum_planar_body_def def = rod("frame", 3.0, 2.0);
  baum_planar_fixed_def weld = baum_planar_fixed_def_default();
  weld.body_a = BAUM_GROUND;
  weld.body_b = baum_i_parts_body(parts, &def);
  weld.point[0] = weld.point[1] = 0.0;
  if (parts->status == BAUM_OK) {
    parts->status = baum_mechanism_add_planar_fixed(parts->mechanism, &weld, NULL);
  }
}

baum_status model_parallelogram_build_of(const model_parallelogram_data *data, model *out)
{
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_parts_gravity(&parts, 9.81);
  baum_body_id first = add_crank(&parts, data, "first crank", 0.0, 0.0);
  baum_body_id last = add_crank(&parts, data, "last crank", 2.0, 0.0);
  baum_body_id coupler = add_coupler(&parts, data);
  pin_tip(&parts, first, coupler, -1.0, 0.0);
  pin_tip(&parts, last, coupler, 1.0, 0.0);
  if (data->which != MODEL_TWO_CRANKS) {
    baum_body_id middle = add_crank(&parts, data, "middle crank", 1.0, data->above);
    if (data->which == MODEL_THREE_CRANKS) {
      pin_tip(&parts, middle, coupler, 0.0, data->above);
    } else {
      baum_i_parts_rod(&parts, "rod", (baum_i_spot){middle, {0.5, 0.0}},
                       (baum_i_spot){coupler, {-1.0, 0.0}}, 1.0);
    }
  }
  if (data->doubled) {
    double_pin(&parts, data, last, coupler);
  }
  if (data->framed) {
    add_frame(&parts);
  }
  return model_finish(&parts, data->units, out);
}

baum_status model_parallelogram_build(model_parallelogram which, double angle, model *out)
{
  const model_parallelogram_data data = {.which = which, .angle = angle};
  return model_parallelogram_build_of(&data, out);
}
