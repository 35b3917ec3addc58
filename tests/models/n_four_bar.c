/* SPDX-License-Identifier: BSD-3-Clause */
/* N-four-bar: N + 1 cranks from (k, 0), which carry N couplers from crank to crank. While all cranks
 * are parallel at angle th, with masses a and b of cranks and couplers and L = 1,
 *
 *   [(N + 1) a / 3 + N b] th'' = -[(N + 1) a / 2 + N b] g cos th
 *
 * Where they lie flat each window may go over into crossed cranks: J loses N rows.
 */
#include "builder.h"

#include <math.h>

static const double UPRIGHT = 1.5707963267948966; /* pi / 2 */

model_n_four_bar model_n_four_bar_a02(int loops)
{
  return (model_n_four_bar){
    .loops = loops, .angle = UPRIGHT, .rate = -1.0, .crank_mass = 1.0, .coupler_mass = 1.0};
}

static baum_planar_body_def rod(double mass)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.mass = mass;
  def.inertia = mass / 12.0;
  return def;
}

static baum_body_id add_crank(builder *build, const model_n_four_bar *data, int k)
{
  double c = cos(data->angle);
  double s = sin(data->angle);
  baum_planar_body_def def = rod(data->crank_mass);
  def.position[0] = k + c / 2;
  def.position[1] = s / 2;
  def.angle = data->angle;
  def.velocity[0] = -s / 2 * data->rate;
  def.velocity[1] = c / 2 * data->rate;
  def.angular_velocity = data->rate;
  return build_body(build, &def);
}

static baum_body_id add_coupler(builder *build, const model_n_four_bar *data, int k)
{
  double c = cos(data->angle);
  double s = sin(data->angle);
  baum_planar_body_def def = rod(data->coupler_mass);
  def.position[0] = k + 0.5 + c;
  def.position[1] = s;
  def.velocity[0] = -s * data->rate;
  def.velocity[1] = c * data->rate;
  def.angular_velocity = 0.0;
  return build_body(build, &def);
}

static void pin_to_ground(builder *build, baum_body_id crank, int k)
{
  build_pin(build, NULL, (place){BAUM_GROUND, {k, 0.0}}, (place){crank, {-0.5, 0.0}});
}

static void pin_tip(builder *build, baum_body_id crank, baum_body_id coupler, double end)
{
  build_pin(build, NULL, (place){crank, {0.5, 0.0}}, (place){coupler, {end, 0.0}});
}

baum_status model_n_four_bar_build(const model_n_four_bar *data, model *out)
{
  builder build = build_begin_in(data->units, out);
  build_gravity(&build, 9.81);
  baum_body_id crank = add_crank(&build, data, 0);
  pin_to_ground(&build, crank, 0);
  for (int k = 0; k < data->loops; k++) {
    baum_body_id coupler = add_coupler(&build, data, k);
    pin_tip(&build, crank, coupler, -0.5);
    crank = add_crank(&build, data, k + 1);
    pin_to_ground(&build, crank, k + 1);
    pin_tip(&build, crank, coupler, 0.5);
  }
  return build_finish(&build);
}
