/* SPDX-License-Identifier: BSD-3-Clause */
/* A slider-crank. Crank 1 rotates about the origin, slider 3 moves on the line y = e, where e is
 * the eccentricity, and rod 2 connects them. The centres of mass of crank and rod are at half their
 * lengths. With the lengths l1 and l2 and the angles a1 and a2 of crank and rod, and the position
 * x3 of the slider, the constraints are
 *
 *   l1 sin a1 + l2 sin a2 = e,  x3 = l1 cos a1 + l2 cos a2
 *
 * The rod points to the right, so cos a2 > 0. The crank can make full revolutions if
 * l2 > l1 + abs(e). If the crank is driven at the angular velocity w, its angle a1 = a1(0) + w t
 * determines the motion.
 */
#include "catalog/slider_crank.h"

#include <float.h>
#include <math.h>

#include "catalog/catalog.h"
#include "catalog/data/slider_crank.h"
#include "catalog/data/slider_crank_eccentric.h"

#define P(name)  p[BAUM_I_SLIDER_CRANK_##name]
#define AT(name) [BAUM_I_SLIDER_CRANK_##name]

static const baum_i_catalog_parameter PARAMETERS[BAUM_I_SLIDER_CRANK_COUNT] = {
  AT(CRANK) = {"crank", "m", "length of the crank", BAUM_I_POSITIVE},
  AT(ROD) = {"rod", "m", "length of the rod", BAUM_I_POSITIVE},
  AT(ECCENTRICITY) = {"eccentricity", "m", "height of the guide above the crank's pin", BAUM_I_ANY},
  AT(CRANK_MASS) = {"crank_mass", "kg", "of the crank", BAUM_I_POSITIVE},
  AT(ROD_MASS) = {"rod_mass", "kg", "of the rod", BAUM_I_POSITIVE},
  AT(SLIDER_MASS) = {"slider_mass", "kg", "of the slider", BAUM_I_POSITIVE},
  AT(CRANK_INERTIA) = {"crank_inertia", "kg m^2", "of the crank about its centre of mass",
                       BAUM_I_POSITIVE},
  AT(ROD_INERTIA) = {"rod_inertia", "kg m^2", "of the rod about its centre of mass",
                     BAUM_I_POSITIVE},
  AT(SLIDER_INERTIA) = {"slider_inertia", "kg m^2", "of the slider, which does not rotate",
                        BAUM_I_POSITIVE},
  AT(GRAVITY) = {"gravity", "m/s^2", "downwards", BAUM_I_ANY},
  AT(ANGLE) = {"angle", "rad", "of the crank at start", BAUM_I_ANY},
  AT(SPEED) = {"speed", "rad/s", "of the crank at start; a driven crank keeps it", BAUM_I_ANY},
};

const double baum_i_slider_crank_data[BAUM_I_SLIDER_CRANK_COUNT] = {
  0.153, 0.306, 0.05, 0.038, 0.038, 0.076, 7.4e-5, 5.9e-4, 2.7e-6, 9.81, 0.0, 150.0};

static const double CENTRIC[BAUM_I_SLIDER_CRANK_COUNT] = {
  0.153, 0.306, 0.0, 0.038, 0.038, 0.076, 7.4e-5, 5.9e-4, 2.7e-6, 9.81, 0.0, 150.0};

/* Parameters of Simeon's slider-crank. The moments of inertia of the source are converted so that
 * they refer to the centres of mass. The source does not give the inertia of the slider. */
static const double SIMEON[BAUM_I_SLIDER_CRANK_COUNT] = {
  0.15, 0.3, 0.0, 0.36, 0.151104, 0.075552, 7.02e-4, 1.1340859e-3, 2.7e-6, 0.0, 0.0, 150.0};

baum_i_body_state baum_i_slider_crank_state(const double *p, const double *q, const double *v,
                                            int body)
{
  baum_i_mover at = {{0.0, 0.0}, {0.0, 0.0}};
  if (body == 0) {
    baum_i_mover_go(&at, q[0], v[0], P(CRANK) / 2, 0.0);
    return baum_i_mover_state(&at, q[0], v[0]);
  }
  baum_i_mover_go(&at, q[0], v[0], P(CRANK), 0.0);
  double angle = asin((P(ECCENTRICITY) - at.r[1]) / P(ROD));
  double rate = -at.v[1] / (P(ROD) * cos(angle));
  if (body == 1) {
    baum_i_mover_go(&at, angle, rate, P(ROD) / 2, 0.0);
    return baum_i_mover_state(&at, angle, rate);
  }
  baum_i_mover_go(&at, angle, rate, P(ROD), 0.0);
  at.r[1] = P(ECCENTRICITY);
  at.v[1] = 0.0;
  return baum_i_mover_state(&at, 0.0, 0.0);
}

static double driven_solution(const double *p, double t, double *q, double *v)
{
  q[0] = P(ANGLE) + P(SPEED) * t;
  v[0] = P(SPEED);
  return DBL_EPSILON * fabs(q[0]);
}

baum_i_slider_crank_bodies baum_i_slider_crank_add_bodies(baum_i_parts *parts, const double *p)
{
  static const char *const names[3] = {"crank", "rod", "slider"};
  baum_i_slider_crank_bodies bodies;
  for (int k = 0; k < 3; k++) {
    bodies.id[k] = baum_i_parts_body_at(parts, names[k], p[BAUM_I_SLIDER_CRANK_CRANK_MASS + k],
                                        p[BAUM_I_SLIDER_CRANK_CRANK_INERTIA + k],
                                        baum_i_slider_crank_state(p, &P(ANGLE), &P(SPEED), k),
                                        k == 0 ? BAUM_I_GIVE_ROTATION : BAUM_I_GIVE_NONE);
  }
  return bodies;
}

void baum_i_slider_crank_add_joints(baum_i_parts *parts, const double *p,
                                    const baum_i_slider_crank_bodies *bodies, baum_body_id frame,
                                    bool driven)
{
  const baum_body_id *id = bodies->id;
  baum_joint_id pin = baum_i_parts_hinge(parts, "A", frame, 0.0, id[0], -P(CRANK) / 2);
  baum_i_parts_hinge(parts, "B", id[0], P(CRANK) / 2, id[1], -P(ROD) / 2);
  baum_i_parts_hinge(parts, "C", id[1], P(ROD) / 2, id[2], 0.0);
  baum_i_parts_guide(parts, "guide", id[2], P(ECCENTRICITY), 0.0);
  if (driven) {
    baum_i_parts_motor(parts, pin, P(ANGLE), P(SPEED));
  }
}

static void build(baum_i_parts *parts, const double *p, bool driven)
{
  baum_i_parts_gravity(parts, P(GRAVITY));
  baum_i_slider_crank_bodies bodies = baum_i_slider_crank_add_bodies(parts, p);
  baum_i_slider_crank_add_joints(parts, p, &bodies, BAUM_GROUND, driven);
}

static void build_free(baum_i_parts *parts, const double *p)
{
  build(parts, p, false);
}

static void build_driven(baum_i_parts *parts, const double *p)
{
  build(parts, p, true);
}

/* ---- entries ---- */

#define FLORES                                                                               \
  "P. Flores, R. Leine, C. Glocker, Multibody System Dynamics 23 (2010) 165, table 1 (copy " \
  "in the GitHub repository siconos/siconos); this model has no clearance"

#define FREE \
  BAUM_I_CATALOG_MODEL(PARAMETERS, build_free, baum_i_slider_crank_state, "mmr", 3), .end = 0.2

#define DRIVEN                                                                               \
  BAUM_I_CATALOG_MODEL(PARAMETERS, build_driven, baum_i_slider_crank_state, "mmr", 3),       \
    BAUM_I_CATALOG_COMPUTED(driven_solution, 21, 1, 13),                                     \
    .provenance = "closed form; confirmed by an extrapolation method in 160-bit arithmetic", \
    .note = "no degrees of freedom; baum_kinematics() can simulate this mechanism, "         \
            "too. The reference requires rod > crank + |eccentricity|"

const baum_i_catalog_mechanism baum_i_slider_crank = {
  FREE,
  BAUM_I_CATALOG_SERIES(SLIDER_CRANK, 15, 14),
  .name = "slider_crank",
  .title = "centric slider-crank, the crank released at 150 rad/s",
  .source = FLORES,
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 18 digits; "
    "a second, independent model in double precision agrees to 12.8 digits",
  .defaults = CENTRIC,
};

const baum_i_catalog_mechanism baum_i_slider_crank_eccentric = {
  FREE,
  BAUM_I_CATALOG_SERIES(SLIDER_CRANK_ECCENTRIC, 15, 14),
  .name = "slider_crank_eccentric",
  .title = "eccentric slider-crank, the crank released at 150 rad/s",
  .source = FLORES "; the eccentricity was chosen for this catalogue",
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 17 digits; "
    "a second, independent model in double precision agrees to 12.8 digits",
  .defaults = baum_i_slider_crank_data,
};

const baum_i_catalog_mechanism baum_i_slider_crank_driven = {
  DRIVEN,
  .name = "slider_crank_driven",
  .title = "eccentric slider-crank, the crank driven at 150 rad/s",
  .source = FLORES "; the eccentricity was chosen for this catalogue",
  .defaults = baum_i_slider_crank_data,
  .end = 0.2,
};

const baum_i_catalog_mechanism baum_i_slider_crank_simeon = {
  DRIVEN,
  .name = "slider_crank_simeon",
  .title =
    "slider-crank of the Bari test set, with a rigid rod instead of the flexible one; driven",
  .source =
    "B. Simeon, Bari test set, crank.f, with a rigid rod; inertias about the centres of mass",
  .defaults = SIMEON,
  .end = 0.1,
};
