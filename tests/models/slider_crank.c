/* SPDX-License-Identifier: BSD-3-Clause */
/* Variants of the eccentric slider-crank of the catalogue. If the rod is as long as the crank and
 * there is no eccentricity, rod and crank coincide when the crank angle is pi / 2. There the
 * Jacobian J loses rank. */
#include "models.h"

#include <math.h>
#include <string.h>

#include "catalog/slider_crank.h"

typedef baum_i_slider_crank_bodies crank_bodies;

static void find_parameters(const model_slider_crank *options, double *p)
{
  double mass = p[BAUM_I_SLIDER_CRANK_ROD_MASS];
  double length = p[BAUM_I_SLIDER_CRANK_ROD];
  if (options->rod_mass > 0.0) {
    p[BAUM_I_SLIDER_CRANK_ROD_MASS] = options->rod_mass;
    p[BAUM_I_SLIDER_CRANK_ROD_INERTIA] *= options->rod_mass / mass;
  }
  if (options->rod > 0.0) {
    double longer = options->rod / length;
    p[BAUM_I_SLIDER_CRANK_ROD] = options->rod;
    p[BAUM_I_SLIDER_CRANK_ROD_INERTIA] *= longer * longer;
  }
  if (options->centric) {
    p[BAUM_I_SLIDER_CRANK_ECCENTRICITY] = 0.0;
  }
  p[BAUM_I_SLIDER_CRANK_ANGLE] = options->angle;
}

static void change_body(baum_i_parts *parts, baum_body_id id, const double *q, const double *v)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  if (parts->status == BAUM_OK) {
    parts->status = baum_mechanism_get_planar_body(parts->mechanism, id, &def, sizeof def);
  }
  if (q) {
    memcpy(def.position, q, sizeof def.position);
    def.angle = q[2];
  }
  if (v) {
    memcpy(def.velocity, v, sizeof def.velocity);
    def.angular_velocity = v[2];
  }
  if (parts->status == BAUM_OK) {
    parts->status = baum_mechanism_set_planar_body(parts->mechanism, id, &def);
  }
}

static void give_velocities(baum_i_parts *parts, const double *p, const crank_bodies *bodies)
{
  for (int k = 0; k < 3; k++) {
    const baum_i_body_state at =
      baum_i_slider_crank_state(p, &p[BAUM_I_SLIDER_CRANK_ANGLE], &p[BAUM_I_SLIDER_CRANK_SPEED], k);
    change_body(parts, bodies->id[k], NULL, at.v);
  }
}

/* Places the rod horizontally at the tip of the crank, and the slider at a wrong place. */
static void draw_roughly(baum_i_parts *parts, const double *p, const crank_bodies *bodies)
{
  double angle = p[BAUM_I_SLIDER_CRANK_ANGLE];
  double tip[2] = {p[BAUM_I_SLIDER_CRANK_CRANK] * cos(angle),
                   p[BAUM_I_SLIDER_CRANK_CRANK] * sin(angle)};
  double length = p[BAUM_I_SLIDER_CRANK_ROD];
  const double rod[3] = {tip[0] + length / 2, tip[1], 0.0};
  const double slider[3] = {tip[0] + length + 0.01, p[BAUM_I_SLIDER_CRANK_ECCENTRICITY] - 0.02,
                            0.0};
  change_body(parts, bodies->id[1], rod, NULL);
  change_body(parts, bodies->id[2], slider, NULL);
}

/* Adds frames. Returns the last frame, whose centre of mass is at the pin of the crank. If there
 * are no frames, returns ground. */
static baum_body_id add_frames(baum_i_parts *parts, int count)
{
  baum_body_id last = BAUM_GROUND;
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_planar_fixed_def weld = baum_planar_fixed_def_default();
  def.mass = 2.0;
  weld.point_a[0] = weld.point_a[1] = weld.point_b[0] = weld.point_b[1] = 0.0;
  for (int k = 0; k < count && parts->status == BAUM_OK; k++) {
    weld.body_a = last;
    last = baum_i_parts_body(parts, &def);
    weld.body_b = last;
    if (parts->status == BAUM_OK) {
      parts->status = baum_mechanism_add_planar_fixed(parts->mechanism, &weld, NULL);
    }
  }
  return last;
}

baum_status model_slider_crank_build(model_slider_crank options, model *out)
{
  double p[BAUM_I_SLIDER_CRANK_COUNT];
  memcpy(p, baum_i_slider_crank_data, sizeof p);
  find_parameters(&options, p);
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_parts_gravity(&parts, p[BAUM_I_SLIDER_CRANK_GRAVITY]);
  crank_bodies bodies = baum_i_slider_crank_add_bodies(&parts, p);
  if (options.moving) {
    give_velocities(&parts, p, &bodies);
  }
  if (options.rough) {
    draw_roughly(&parts, p, &bodies);
  }
  baum_body_id frame = add_frames(&parts, options.frames);
  baum_i_slider_crank_add_joints(&parts, p, &bodies, frame, options.driven);
  if (options.doubled_guide) {
    baum_i_parts_guide(&parts, "second guide", bodies.id[2], p[BAUM_I_SLIDER_CRANK_ECCENTRICITY],
                       p[BAUM_I_SLIDER_CRANK_CRANK] / 2);
  }
  return model_finish(&parts, options.units, out);
}
