/* SPDX-License-Identifier: BSD-3-Clause */
/* A chain of uniform rods. The first link starts at the origin, and each further link starts at the
 * end of the previous one. Angles are measured from the x axis. */
#include "catalog/chain.h"

#include <math.h>

#include "catalog/catalog.h"
#include "catalog/data/chain.h"

/* The three angles below are 90, 90 and 45 degrees from the downward vertical. */
static const double MASS_3[3] = {2.0, 1.0, 0.5};
static const double LENGTH_3[3] = {1.0, 0.8, 0.6};
static const double ANGLE_3[3] = {0.0, 0.0, -0.78539816339744831};

const baum_i_chain baum_i_chain_3 = {
  .links = 3, .mass = MASS_3, .length = LENGTH_3, .angle = ANGLE_3, .all = {.rate = 0.0}};

/* The point where the next link begins. */
typedef struct tip {
  baum_body_id body;
  double length; /* length of this body */
  baum_i_mover at;
} tip;

static double value_or(const double *values, int k, double otherwise)
{
  return values ? values[k] : otherwise;
}

static void add_link(baum_i_parts *parts, const baum_i_chain *data, int k, tip *from)
{
  double length = value_or(data->length, k, data->all.length);
  double angle = value_or(data->angle, k, data->all.angle);
  double rate = value_or(data->rate, k, data->all.rate);
  double mass = value_or(data->mass, k, data->all.mass);
  baum_i_mover_go(&from->at, angle, rate, length / 2, 0.0);
  const baum_i_body_state state = baum_i_mover_state(&from->at, angle, rate);
  baum_i_mover_go(&from->at, angle, rate, length / 2, 0.0);
  baum_body_id link =
    baum_i_parts_body_at(parts, NULL, mass, mass * length * length / 12.0, state, BAUM_I_GIVE_ALL);
  baum_i_parts_hinge(parts, NULL, from->body, from->length / 2, link, -length / 2);
  from->body = link;
  from->length = length;
}

void baum_i_chain_add(baum_i_parts *parts, const baum_i_chain *data)
{
  tip from = {.body = BAUM_GROUND};
  for (int k = 0; k < data->links && parts->status == BAUM_OK; k++) {
    add_link(parts, data, k, &from);
  }
}

/* ---- entries ---- */

static void build_3(baum_i_parts *parts, const double *p)
{
  baum_i_parts_gravity(parts, p[0]);
  baum_i_chain_add(parts, &baum_i_chain_3);
}

static baum_i_body_state state_3(const double *p, const double *q, const double *v, int body)
{
  (void)p;
  baum_i_mover at = {{0.0, 0.0}, {0.0, 0.0}};
  for (int k = 0; k < body; k++) {
    baum_i_mover_go(&at, q[k], v[k], LENGTH_3[k], 0.0);
  }
  baum_i_mover_go(&at, q[body], v[body], LENGTH_3[body] / 2, 0.0);
  return baum_i_mover_state(&at, q[body], v[body]);
}

static const baum_i_catalog_parameter PARAMETERS_3[1] = {
  {"gravity", "m/s^2", "downwards", BAUM_I_ANY},
};

const baum_i_catalog_mechanism baum_i_chain_of_3 = {
  .name = "chain_3",
  .title = "chain of three different uniform rods, from rest",
  .source = "chosen for this catalogue",
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 19 digits; "
    "a second, independent model in double precision agrees to 14.1 digits",
  BAUM_I_CATALOG_MODEL(PARAMETERS_3, build_3, state_3, "mmr", 3),
  .defaults = (const double[1]){9.81},
  .end = 2.0,
  BAUM_I_CATALOG_STORED(CHAIN, 15),
};

enum { LINKS, MASS, LENGTH, ANGLE, RATE, GRAVITY, COUNT };

static void build(baum_i_parts *parts, const double *p)
{
  const baum_i_chain data = {.links = (int)p[LINKS],
                             .all = {p[MASS], p[LENGTH], p[ANGLE], p[RATE]}};
  baum_i_parts_gravity(parts, p[GRAVITY]);
  baum_i_chain_add(parts, &data);
}

static int count(const double *p)
{
  return (int)p[LINKS];
}

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [LINKS] = {"links", "-", "N, number of rods", BAUM_I_WHOLE},
  [MASS] = {"mass", "kg", "of each link", BAUM_I_POSITIVE},
  [LENGTH] = {"length", "m", "of each link", BAUM_I_POSITIVE},
  [ANGLE] = {"angle", "rad", "of all links at start", BAUM_I_ANY},
  [RATE] = {"rate", "rad/s", "of all links at start", BAUM_I_ANY},
  [GRAVITY] = {"gravity", "m/s^2", "downwards", BAUM_I_ANY},
};

const baum_i_catalog_mechanism baum_i_chain_of_n = {
  .name = "chain",
  .title = "open chain of N equal uniform rods, level and at rest",
  .source = "chosen for this catalogue",
  .provenance = "",
  .note = "chaotic: errors grow with time",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, NULL, "mmr", 0),
  .count = count,
  .defaults = (const double[COUNT]){10.0, 1.0, 1.0, 0.0, 0.0, 9.81},
  .end = 1.0,
};
