/* SPDX-License-Identifier: BSD-3-Clause */
/* A quadruped that falls freely: a trunk, four legs of hip, thigh and shank, and a neck, with 13
 * revolute joints. No force but gravity acts, so the centre of mass moves on a parabola, and the
 * angular momentum about the centre of mass and the energy are constant. */
#include "catalog/catalog.h"
#include "catalog/spatial_parts.h"

enum { TRUNK, THIGH, GRAVITY, SPEED, COUNT };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [TRUNK] = {"trunk", "kg", "mass of the trunk", BAUM_I_POSITIVE},
  [THIGH] = {"thigh", "kg", "mass of each thigh", BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "along -z", BAUM_I_ANY},
  [SPEED] = {"speed", "m/s", "of the trunk along x at start", BAUM_I_ANY},
};

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

/* Adds a link to the body `on`, whose axes are `at`. Afterwards, `on` is the link, and `at` are the
 * axes of the link. */
static void add_link(baum_i_parts *parts, const link *l, baum_body_id *on, baum_i_axes *at)
{
  double axis[3];
  baum_i_axes_go(at, l->point[0], l->point[1], l->point[2]);
  baum_i_axes_direction(at, l->axis, axis);
  baum_i_axes joint = *at;
  baum_i_axes_turn(at, l->axis, l->angle, l->rate);
  baum_i_axes_go(at, l->centre[0], l->centre[1], l->centre[2]);
  baum_body_id next =
    baum_i_parts_spatial_body(parts, NULL, l->mass, l->inertia, baum_i_axes_state(at));
  baum_i_parts_spatial_revolute(parts, NULL, (baum_i_place){*on, next, joint.r, axis});
  *on = next;
}

/* Adds a leg of hip, thigh and shank at the corner (x, y) of the trunk. */
static void add_leg(baum_i_parts *parts, const double *p, baum_body_id trunk, baum_i_axes at,
                    double x, double y)
{
  double out = y > 0.0 ? 0.04 : -0.04;
  const link links[3] = {
    {{x, y, 0.0}, {0.0, out, 0.0}, 0, 0.2, 0.5 + x, 0.7, {0.001, 0.0005, 0.001}},
    {{0.0, out, 0.0}, {0.0, 0.0, -0.135}, 1, -0.4 + y, 1.0, p[THIGH], {0.006, 0.006, 0.001}},
    {{0.0, 0.0, -0.135}, {0.0, 0.0, -0.165}, 1, 0.9, -1.5, 0.3, {0.003, 0.003, 0.0002}}};
  baum_body_id on = trunk;
  for (int k = 0; k < 3; k++) {
    add_link(parts, &links[k], &on, &at);
  }
}

static void build(baum_i_parts *parts, const double *p)
{
  static const double centre[3] = {0.0, 0.0, 0.6};
  static const double inertia[3] = {0.1, 0.3, 0.35};
  static const link neck = {{0.4, 0.0, 0.05},   {0.1, 0.0, 0.08}, 1, 0.1, 0.8, 1.0,
                            {0.004, 0.01, 0.01}};
  const double velocity[3] = {p[SPEED], 0.1, 0.0};
  baum_i_parts_gravity_z(parts, p[GRAVITY]);
  baum_i_axes trunk = baum_i_axes_at(centre, velocity);
  baum_i_axes_turn(&trunk, 1, 0.05, 0.3);
  baum_body_id id =
    baum_i_parts_spatial_body(parts, "trunk", p[TRUNK], inertia, baum_i_axes_state(&trunk));
  for (int k = 0; k < 4; k++) {
    add_leg(parts, p, id, trunk, k < 2 ? -0.3 : 0.3, k % 2 ? 0.1 : -0.1);
  }
  baum_body_id on = id;
  baum_i_axes at = trunk;
  add_link(parts, &neck, &on, &at);
}

const baum_i_catalog_mechanism baum_i_quadruped = {
  .name = "quadruped",
  .title = "quadruped of 14 bodies and 13 revolute joints in free fall",
  .source = "chosen for this catalogue",
  .provenance = "",
  .note = "the centre of mass moves on a parabola; the angular momentum about the centre of mass "
          "and the energy are constant",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, NULL, "mmmqqqq", 14),
  .defaults = (const double[COUNT]){10.0, 1.0, 9.81, 0.5},
  .end = 1.0,
};
