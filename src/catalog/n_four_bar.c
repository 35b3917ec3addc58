/* SPDX-License-Identifier: BSD-3-Clause */
/* The N-four-bar has N + 1 cranks with pins at (k l, 0), k = 0 to N, and N couplers between the
 * tips of neighbouring cranks. All of them are uniform rods of length l. The mass of a crank is a,
 * and the mass of a coupler is b. As long as all cranks are parallel at the angle th, the equation
 * of motion is
 *
 *   [(N + 1) a / 3 + N b] l th'' = -[(N + 1) a / 2 + N b] g cos th
 *
 * This is the pendulum equation for th + pi / 2. A window consists of two neighbouring cranks and
 * their coupler. When the cranks lie on the x axis, the two cranks of each window may change from
 * parallel to crossed. With all cranks on the x axis, the rank of the constraint Jacobian J is
 * lower by N than in neighbouring configurations.
 */
#include "catalog/catalog.h"

#include <math.h>
#include <stdio.h>

#include "catalog/swing.h"

#define QUARTER 1.5707963267948966 /* [rad] a quarter of a revolution */

enum { WINDOWS, ANGLE, RATE, LENGTH, CRANK_MASS, COUPLER_MASS, GRAVITY, COUNT };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [WINDOWS] = {"windows", "-", "N; a window consists of two cranks and a coupler", BAUM_I_WHOLE},
  [ANGLE] = {"angle", "rad", "of all cranks at start; the configuration at 0 is flat and singular",
             BAUM_I_ANY},
  [RATE] = {"rate", "rad/s", "of all cranks at start", BAUM_I_ANY},
  [LENGTH] = {"length", "m", "of all rods", BAUM_I_POSITIVE},
  [CRANK_MASS] = {"crank_mass", "kg", "of each crank", BAUM_I_POSITIVE},
  [COUPLER_MASS] = {"coupler_mass", "kg", "of each coupler", BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "downwards", BAUM_I_ANY},
};

static int count(const double *p)
{
  return 2 * (int)p[WINDOWS] + 1;
}

static double solution(const double *p, double t, double *q, double *v)
{
  double n = p[WINDOWS];
  double inertia = ((n + 1) * p[CRANK_MASS] / 3 + n * p[COUPLER_MASS]) * p[LENGTH];
  double moment = ((n + 1) * p[CRANK_MASS] / 2 + n * p[COUPLER_MASS]) * p[GRAVITY];
  q[0] = p[ANGLE] + QUARTER;
  v[0] = p[RATE];
  double off = baum_i_swing(moment / inertia, t, q, v);
  q[0] -= QUARTER;
  return off;
}

/* Computes the state of a body. The order of the bodies is crank 0, coupler 0, crank 1, ..., crank
 * N. */
static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  bool crank = body % 2 == 0;
  int window = body / 2;
  double half = p[LENGTH] / 2;
  baum_i_mover at = {{window * p[LENGTH] + (crank ? 0.0 : half), 0.0}, {0.0, 0.0}};
  baum_i_mover_go(&at, q[0], v[0], crank ? half : p[LENGTH], 0.0);
  return baum_i_mover_state(&at, crank ? q[0] : 0.0, crank ? v[0] : 0.0);
}

static baum_body_id add_rod(baum_i_parts *parts, const double *p, int k)
{
  char name[32];
  (void)snprintf(name, sizeof name, "%s %d", k % 2 == 0 ? "crank" : "coupler", k / 2);
  double mass = p[k % 2 == 0 ? CRANK_MASS : COUPLER_MASS];
  return baum_i_parts_body_at(parts, name, mass, mass * p[LENGTH] * p[LENGTH] / 12.0,
                              state(p, &p[ANGLE], &p[RATE], k), BAUM_I_GIVE_ALL);
}

static void build(baum_i_parts *parts, const double *p)
{
  double half = p[LENGTH] / 2;
  baum_i_parts_gravity(parts, p[GRAVITY]);
  baum_body_id crank = add_rod(parts, p, 0);
  baum_i_parts_hinge(parts, NULL, BAUM_GROUND, 0.0, crank, -half);
  for (int k = 1; k < count(p) && parts->status == BAUM_OK; k += 2) {
    baum_body_id coupler = add_rod(parts, p, k);
    baum_i_parts_hinge(parts, NULL, crank, half, coupler, -half);
    crank = add_rod(parts, p, k + 1);
    baum_i_parts_hinge(parts, NULL, BAUM_GROUND, (k / 2 + 1) * p[LENGTH], crank, -half);
    baum_i_parts_hinge(parts, NULL, crank, half, coupler, half);
  }
}

const baum_i_catalog_mechanism baum_i_n_four_bar = {
  .name = "n_four_bar",
  .title = "N-four-bar of uniform rods, through flat and singular configurations",
  .source = "IFToMM and A Coruna library of benchmarks, A02; the published table is for N = 40",
  .provenance =
    "Taylor series of the equation of parallel cranks, which is that of a pendulum; "
    "this series agrees to 13 digits with extrapolation in 160-bit arithmetic for N = 1, 2, 40",
  .note = "twice per revolution, the rank of J falls by N; the reference is the branch of "
          "parallel cranks",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmr", 0),
  .count = count,
  .defaults = (const double[COUNT]){2.0, QUARTER, -1.0, 1.0, 1.0, 1.0, 9.81},
  .end = 10.0,
  .branches = true,
  BAUM_I_CATALOG_COMPUTED(solution, 21, 1, 11),
};
