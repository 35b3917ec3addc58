/* SPDX-License-Identifier: BSD-3-Clause */
/* Chain of uniform rods: link k from the tip of link k - 1, the first one from the origin, at an
 * angle of its own from the x axis.
 */
#include "builder.h"

#include <math.h>

/* Angles of (90, 90, 45) degrees from the downward vertical. */
static const double MASS_3[3] = {2.0, 1.0, 0.5};
static const double LENGTH_3[3] = {1.0, 0.8, 0.6};
static const double ANGLE_3[3] = {0.0, 0.0, -0.78539816339744831};

const model_chain MODEL_CHAIN_3 = {
  .links = 3, .mass = MASS_3, .length = LENGTH_3, .angle = ANGLE_3};

/* Where a link begins. */
typedef struct tip {
  baum_body_id body;
  double length; /* of that body */
  double position[2];
  double velocity[2];
} tip;

static double value_or(const double *values, int k, double otherwise)
{
  return values ? values[k] : otherwise;
}

/* Go along half a link at an angle. */
static void go(tip *from, double half, double angle, double rate)
{
  from->position[0] += half * cos(angle);
  from->position[1] += half * sin(angle);
  from->velocity[0] -= half * sin(angle) * rate;
  from->velocity[1] += half * cos(angle) * rate;
}

static void add_link(builder *build, const model_chain *data, int k, tip *from)
{
  double length = value_or(data->length, k, 1.0);
  baum_planar_body_def def = baum_planar_body_def_default();
  def.mass = value_or(data->mass, k, 1.0);
  def.inertia = def.mass * length * length / 12.0;
  def.angle = value_or(data->angle, k, 0.0);
  def.angular_velocity = value_or(data->rate, k, 0.0);
  go(from, length / 2, def.angle, def.angular_velocity);
  for (int i = 0; i < 2; i++) {
    def.position[i] = from->position[i];
    def.velocity[i] = from->velocity[i];
  }
  go(from, length / 2, def.angle, def.angular_velocity);
  baum_body_id link = build_body(build, &def);
  build_pin(build, NULL, (place){from->body, {from->length / 2, 0.0}},
            (place){link, {-length / 2, 0.0}});
  from->body = link;
  from->length = length;
}

baum_status model_chain_build(const model_chain *data, model *out)
{
  builder build = build_begin_in(data->units, out);
  build_gravity(&build, 9.81);
  tip from = {.body = BAUM_GROUND};
  for (int k = 0; k < data->links && build_fine(&build); k++) {
    add_link(&build, data, k, &from);
  }
  return build_finish(&build);
}
