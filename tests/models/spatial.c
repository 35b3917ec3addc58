/* SPDX-License-Identifier: BSD-3-Clause */
#include "spatial.h"

#include <math.h>
#include <string.h>

#include <baum/catalog.h>

#include "catalog/spatial_parts.h"
#include "spatial_scenes.h"

/* Writes the axis `k` of `axes` in ground axes. */
static void find_axis(const baum_i_axes *axes, int k, double out[3])
{
  baum_i_axes tip = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  memcpy(tip.p, axes->p, sizeof tip.p);
  baum_i_axes_go(&tip, k == 0, k == 1, k == 2);
  memcpy(out, tip.r, 3 * sizeof *out);
}

/* ---- from the catalogue ---- */

static baum_status from_catalog(const char *name, const baum_catalog_setting *settings, int count,
                                model *out)
{
  const baum_catalog_choice choice = {name, settings, count};
  baum_mechanism *mechanism = NULL;
  baum_status status = baum_catalog_build(&choice, &mechanism);
  return status == BAUM_OK ? model_adopt(mechanism, out) : status;
}

static baum_status build_slider_crank(model *out)
{
  const baum_catalog_setting settings[] = {{"angle", 1.0}};
  return from_catalog("spatial_slider_crank", settings, 1, out);
}

/* axial: moment of inertia of the rods about their own axes, relative to that about transverse
 * axes */
static baum_status build_bricard(double axial, model *out)
{
  const baum_catalog_setting settings[] = {{"axial", axial}, {"angle", 0.3}, {"speed", 2.0}};
  return from_catalog("bricard", settings, 3, out);
}

/* ---- Stewart platform ---- */

/* Directions [rad] of the feet on the ground and of the balls on the platform, leg by leg. */
static const double FOOT[6] = {-0.3, 0.3, 1.7944, 2.3944, 3.8888, 4.4888};
static const double BALL[6] = {-0.7972, 0.7972, 1.2972, 2.8916, 3.3916, 4.986};
static const double FOOT_RADIUS = 1.0; /* [m] */
static const double BALL_RADIUS = 0.6; /* [m] */

static baum_i_axes platform_axes(void)
{
  static const double centre[3] = {0.05, -0.1, 1.0};
  static const double velocity[3] = {0.3, 0.2, -0.4};
  baum_i_axes axes = baum_i_axes_at(centre, velocity);
  baum_i_axes_turn(&axes, 2, 0.1, 0.5);
  baum_i_axes_turn(&axes, 0, 0.15, -0.7);
  return axes;
}

/* Adds a leg: a universal joint on the ground, a prismatic joint along the leg, and a spherical
 * joint on the platform. */
static void add_leg(baum_i_parts *parts, baum_body_id platform, int leg)
{
  static const double lower_inertia[3] = {0.002, 0.03, 0.03};
  static const double upper_inertia[3] = {0.001, 0.025, 0.025};
  static const double x[3] = {1.0, 0.0, 0.0};
  const double foot[3] = {FOOT_RADIUS * cos(FOOT[leg]), FOOT_RADIUS * sin(FOOT[leg]), 0.0};
  baum_i_axes end = platform_axes();
  baum_i_axes_go(&end, BALL_RADIUS * cos(BALL[leg]), BALL_RADIUS * sin(BALL[leg]), 0.0);
  baum_i_axes start = baum_i_axes_at(foot, baum_i_zeros);
  baum_i_axes lower = baum_i_axes_between(&start, &end);
  baum_i_axes upper = lower;
  memcpy(upper.r, end.r, sizeof end.r);
  memcpy(upper.v, end.v, sizeof end.v);
  baum_i_axes_go(&lower, 0.35, 0.0, 0.0);
  baum_i_axes_go(&upper, -0.35, 0.0, 0.0);
  double along[3];
  double across[3];
  find_axis(&lower, 0, along);
  find_axis(&lower, 2, across);
  baum_body_id ids[2] = {
    baum_i_parts_spatial_body(parts, NULL, 1.0, lower_inertia, baum_i_axes_state(&lower)),
    baum_i_parts_spatial_body(parts, NULL, 0.8, upper_inertia, baum_i_axes_state(&upper))};
  baum_i_parts_universal(parts, NULL, (baum_i_place){BAUM_GROUND, ids[0], foot, x}, across);
  baum_i_parts_prismatic(parts, NULL, (baum_i_place){ids[0], ids[1], lower.r, along});
  baum_i_parts_spherical(parts, NULL, (baum_i_place){ids[1], platform, end.r, NULL});
}

static baum_status build_stewart(model *out)
{
  static const double inertia[3] = {0.2, 0.2, 0.4};
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_parts_gravity_z(&parts, 9.81);
  baum_i_axes axes = platform_axes();
  baum_body_id platform =
    baum_i_parts_spatial_body(&parts, NULL, 5.0, inertia, baum_i_axes_state(&axes));
  for (int leg = 0; leg < 6; leg++) {
    add_leg(&parts, platform, leg);
  }
  return model_finish(&parts, NULL, out);
}

/* ---- quadruped ---- */

/* A link on a revolute joint. The fields refer to the axes of the body that carries the link. The
 * joint is at `point`, its axis is axis number `axis`, and the vector from the joint to the centre
 * of mass of the link is `centre`. */
typedef struct link {
  double point[3]; /* [m] */
  double centre[3];
  int axis;
  double angle; /* [rad] */
  double rate;  /* [rad/s] */
  double mass;
  double inertia[3];
} link;

/* Adds a link to the body `on`, whose axes are `at`. Afterwards, `on` and `at` are those of the
 * link. */
static void add_link(baum_i_parts *parts, const link *l, baum_body_id *on, baum_i_axes *at)
{
  double axis[3];
  baum_i_axes_go(at, l->point[0], l->point[1], l->point[2]);
  find_axis(at, l->axis, axis);
  baum_i_axes joint = *at;
  baum_i_axes_turn(at, l->axis, l->angle, l->rate);
  baum_i_axes_go(at, l->centre[0], l->centre[1], l->centre[2]);
  baum_body_id next =
    baum_i_parts_spatial_body(parts, NULL, l->mass, l->inertia, baum_i_axes_state(at));
  baum_i_parts_spatial_revolute(parts, NULL, (baum_i_place){*on, next, joint.r, axis});
  *on = next;
}

/* Adds a leg of hip, thigh and shank at the corner (x, y) of the trunk. */
static void add_limb(baum_i_parts *parts, baum_body_id trunk, baum_i_axes at, double x, double y)
{
  double out = y > 0.0 ? 0.04 : -0.04;
  const link links[3] = {
    {{x, y, 0.0}, {0.0, out, 0.0}, 0, 0.2, 0.5 + x, 0.7, {0.001, 0.0005, 0.001}},
    {{0.0, out, 0.0}, {0.0, 0.0, -0.135}, 1, -0.4 + y, 1.0, 1.0, {0.006, 0.006, 0.001}},
    {{0.0, 0.0, -0.135}, {0.0, 0.0, -0.165}, 1, 0.9, -1.5, 0.3, {0.003, 0.003, 0.0002}}};
  baum_body_id on = trunk;
  for (int k = 0; k < 3; k++) {
    add_link(parts, &links[k], &on, &at);
  }
}

static baum_status build_quadruped(model *out)
{
  static const double centre[3] = {0.0, 0.0, 0.6};
  static const double velocity[3] = {0.5, 0.1, 0.0};
  static const double inertia[3] = {0.1, 0.3, 0.35};
  static const link neck = {{0.4, 0.0, 0.05},   {0.1, 0.0, 0.08}, 1, 0.1, 0.8, 1.0,
                            {0.004, 0.01, 0.01}};
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_parts_gravity_z(&parts, 9.81);
  baum_i_axes trunk = baum_i_axes_at(centre, velocity);
  baum_i_axes_turn(&trunk, 1, 0.05, 0.3);
  baum_body_id id =
    baum_i_parts_spatial_body(&parts, "trunk", 10.0, inertia, baum_i_axes_state(&trunk));
  for (int k = 0; k < 4; k++) {
    add_limb(&parts, id, trunk, k < 2 ? -0.3 : 0.3, k % 2 ? 0.1 : -0.1);
  }
  baum_body_id on = id;
  baum_i_axes at = trunk;
  add_link(&parts, &neck, &on, &at);
  return model_finish(&parts, NULL, out);
}

/* ---- chains ---- */

static const double LINK_INERTIA[3] = {0.00167, 0.08417, 0.08417}; /* of a cylinder */

/* An irregular number from -1 to 1 for link k. */
static double irregular(int k, int which)
{
  double x = 0.6180339887498949 * (k + 1.0) + 0.37 * which;
  return 2.0 * (x - floor(x)) - 1.0;
}

/* Adds a chain along the x axes of its links. The links of a spherical chain have independent
 * orientations. Each link of a revolute chain rotates relative to the link before it about an axis
 * that is perpendicular to both links. */
static baum_status build_chain(bool revolute, int links, model *out)
{
  baum_i_parts parts = baum_i_parts_begin();
  baum_body_id last = BAUM_GROUND;
  baum_i_axes at = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  baum_i_parts_gravity_z(&parts, 9.81);
  for (int k = 0; k < links; k++) {
    double point[3];
    double axis[3];
    memcpy(point, at.r, sizeof point);
    if (revolute) {
      baum_i_axes_turn(&at, 0, 2.0 * irregular(k, 0), 0.0);
    } else {
      at = baum_i_axes_at(at.r, at.v);
      baum_i_axes_turn(&at, 1, 0.4 * irregular(k, 0), irregular(k, 1));
    }
    find_axis(&at, 2, axis);
    baum_i_axes_turn(&at, 2, 0.4 * irregular(k, 2), irregular(k, 3));
    baum_i_axes_go(&at, 0.5, 0.0, 0.0);
    baum_body_id next =
      baum_i_parts_spatial_body(&parts, NULL, 1.0, LINK_INERTIA, baum_i_axes_state(&at));
    const baum_i_place place = {last, next, point, axis};
    if (revolute) {
      baum_i_parts_spatial_revolute(&parts, NULL, place);
    } else {
      baum_i_parts_spherical(&parts, NULL, place);
    }
    baum_i_axes_go(&at, 0.5, 0.0, 0.0);
    last = next;
  }
  return model_finish(&parts, NULL, out);
}

const char *model_spatial_name(model_spatial which)
{
  static const char *const names[] = {
    [MODEL_SPATIAL_SLIDER_CRANK] = "spatial_slider_crank",
    [MODEL_RSSR] = "rssr",
    [MODEL_BRICARD] = "bricard",
    [MODEL_SLENDER_BRICARD] = "slender_bricard",
    [MODEL_STEWART] = "stewart",
    [MODEL_QUADRUPED] = "quadruped",
    [MODEL_FLYBALL] = "flyball",
    [MODEL_SPHERICAL_CHAIN] = "spherical_chain",
    [MODEL_REVOLUTE_CHAIN] = "revolute_chain",
  };
  return names[which];
}

baum_status model_spatial_build(model_spatial which, int links, model *out)
{
  *out = (model){.mechanism = NULL};
  switch (which) {
  case MODEL_SPATIAL_SLIDER_CRANK: return build_slider_crank(out);
  case MODEL_RSSR: return model_adopt(spatial_make_rssr(), out);
  case MODEL_BRICARD: return build_bricard(0.02, out);
  case MODEL_SLENDER_BRICARD: return build_bricard(0.0, out);
  case MODEL_STEWART: return build_stewart(out);
  case MODEL_QUADRUPED: return build_quadruped(out);
  case MODEL_FLYBALL: return from_catalog("flyball", NULL, 0, out);
  case MODEL_SPHERICAL_CHAIN: return build_chain(false, links, out);
  case MODEL_REVOLUTE_CHAIN: return build_chain(true, links, out);
  case MODEL_SPATIAL_COUNT: break;
  }
  return BAUM_ERR_ARGUMENT;
}
