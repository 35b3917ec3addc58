/* SPDX-License-Identifier: BSD-3-Clause */
/* Andrews' squeezing mechanism as seven rigid bodies. The geometry below is derived from the
 * equations of this mechanism in the Bari test set of initial value problems. The seven coordinates
 * of the test set are the angles beta, Theta, gamma, Phi, delta, Omega and epsilon. Each line below
 * describes one of the bodies K1 to K7: its pivot, its angle a, and its point E, F, G or H.
 * src/catalog/andrews.h defines the fixed points A, B and C, and the lengths, such as rr and d.
 *
 *   K1 pivots at O = (0, 0), a = beta.                E = rr (cos a, sin a)
 *   K2 pivots at E, a = beta + Theta.                 F = E - d (cos a, sin a)
 *   K3 pivots at B, a = gamma.                        F = B + ss (sin a, -cos a)
 *                                                     spring from (sd, -sc) on K3 to C
 *   K5 pivots at A, a = delta.                        G = A + zt (cos a, sin a)
 *   K4 pivots at G, a = Phi + delta.                  F = G + e (sin a, -cos a)
 *   K7 pivots at A, a = epsilon.                      H = A + u (sin a, -cos a)
 *   K6 pivots at H, a = Omega + epsilon.              F = H + zf (cos a, sin a)
 *
 * The mass matrix of the test set determines the centres of mass: K1 has its centre at the distance
 * ra from O, K2 at the distance da from E towards F, K4 at the distance e - ea from G towards F,
 * and K6 at the distance zf - fa from H towards F. The distances of the centres of K3, K5 and K7
 * from their pivots are sqrt(sa^2 + sb^2), sqrt(ta^2 + tb^2) and sqrt(ua^2 + ub^2). Without
 * gravity, the directions from the pivots to these three centres do not affect the motion.
 */
#include "catalog/andrews.h"
#include "catalog/catalog.h"
#include "catalog/data/andrews.h"
#include "catalog/data/andrews_a03.h"

enum { BETA, MOMENT, STIFFNESS, FREE_LENGTH, COUNT };

/* The centre of mass of each body relative to its pivot, in the axes of the body. */
static const double CENTRE[7][2] = {
  {ANDREWS_RA, 0},           {-ANDREWS_DA, 0},
  {ANDREWS_SB, -ANDREWS_SA}, {0, -(ANDREWS_E - ANDREWS_EA)},
  {ANDREWS_TA, ANDREWS_TB},  {ANDREWS_ZF - ANDREWS_FA, 0},
  {ANDREWS_UA, -ANDREWS_UB},
};

/* Returns the angle of body k. If `angles` contains joint velocities, returns the angular velocity
 * of body k. */
static double turned(const double *angles, int k)
{
  static const int added[7][2] = {{0, -1}, {0, 1}, {2, -1}, {3, 4}, {4, -1}, {5, 6}, {6, -1}};
  double angle = angles[added[k][0]];
  return added[k][1] < 0 ? angle : angle + angles[added[k][1]];
}

/* Computes the position and the velocity of the pivot of body k. The pivot is a fixed point, or a
 * point of the body that carries body k. */
static baum_i_mover find_pivot(const double *angles, const double *rates, int k)
{
  static const double *const fixed[7] = {ANDREWS_O, ANDREWS_O, ANDREWS_B, ANDREWS_A,
                                         ANDREWS_A, ANDREWS_A, ANDREWS_A};
  static const int carrier[7] = {-1, 0, -1, 4, -1, 6, -1};
  static const double arm[7][2] = {
    [1] = {ANDREWS_RR, 0}, [3] = {ANDREWS_ZT, 0}, [5] = {0, -ANDREWS_U}};
  baum_i_mover at = {{fixed[k][0], fixed[k][1]}, {0.0, 0.0}};
  if (carrier[k] >= 0) {
    baum_i_mover_go(&at, turned(angles, carrier[k]), turned(rates, carrier[k]), arm[k][0],
                    arm[k][1]);
  }
  return at;
}

static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  (void)p;
  double angle = turned(q, body);
  double rate = turned(v, body);
  baum_i_mover at = find_pivot(q, v, body);
  baum_i_mover_go(&at, angle, rate, CENTRE[body][0], CENTRE[body][1]);
  return baum_i_mover_state(&at, angle, rate);
}

static void add_bodies(baum_i_parts *parts, const double *p, baum_body_id ids[7])
{
  static const char *const names[7] = {"K1", "K2", "K3", "K4", "K5", "K6", "K7"};
  static const double rest[ANDREWS_ANGLES] = {0};
  double angles[ANDREWS_ANGLES];
  baum_i_andrews_pose(p[BETA], angles);
  for (int k = 0; k < 7; k++) {
    ids[k] = baum_i_parts_body_at(parts, names[k], ANDREWS_MASS[k], ANDREWS_INERTIA[k],
                                  state(p, angles, rest, k), BAUM_I_GIVE_ALL);
  }
}

/* Returns a point of body k. The vector from the pivot to this point is (x, y) in the axes of the
 * body. */
static baum_i_spot on(const baum_body_id ids[7], int k, double x, double y)
{
  return (baum_i_spot){ids[k], {x - CENTRE[k][0], y - CENTRE[k][1]}};
}

static void add_pins(baum_i_parts *parts, const baum_body_id k[7])
{
  baum_i_spot ground_o = {BAUM_GROUND, {ANDREWS_O[0], ANDREWS_O[1]}};
  baum_i_spot ground_a = {BAUM_GROUND, {ANDREWS_A[0], ANDREWS_A[1]}};
  baum_i_spot ground_b = {BAUM_GROUND, {ANDREWS_B[0], ANDREWS_B[1]}};
  baum_i_spot f = on(k, 1, -ANDREWS_D, 0);
  baum_i_parts_pin(parts, "O", ground_o, on(k, 0, 0, 0));
  baum_i_parts_pin(parts, "E", on(k, 0, ANDREWS_RR, 0), on(k, 1, 0, 0));
  baum_i_parts_pin(parts, "B", ground_b, on(k, 2, 0, 0));
  baum_i_parts_pin(parts, "A5", ground_a, on(k, 4, 0, 0));
  baum_i_parts_pin(parts, "A7", ground_a, on(k, 6, 0, 0));
  baum_i_parts_pin(parts, "G", on(k, 4, ANDREWS_ZT, 0), on(k, 3, 0, 0));
  baum_i_parts_pin(parts, "H", on(k, 6, 0, -ANDREWS_U), on(k, 5, 0, 0));
  baum_i_parts_pin(parts, "F3", f, on(k, 2, 0, -ANDREWS_SS));
  baum_i_parts_pin(parts, "F4", f, on(k, 3, 0, -ANDREWS_E));
  baum_i_parts_pin(parts, "F6", f, on(k, 5, ANDREWS_ZF, 0));
}

static void add_forces(baum_i_parts *parts, const double *p, const baum_body_id k[7])
{
  baum_planar_spring_def spring = baum_planar_spring_def_default();
  baum_i_spot end = on(k, 2, ANDREWS_SD, -ANDREWS_SC);
  spring.name = "spring";
  spring.body_a = BAUM_GROUND;
  spring.body_b = end.body;
  for (int i = 0; i < 2; i++) {
    spring.point_a[i] = ANDREWS_C[i];
    spring.point_b[i] = end.point[i];
  }
  spring.stiffness = p[STIFFNESS];
  spring.free_length = p[FREE_LENGTH];
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_planar_spring(parts->mechanism, &spring, NULL));
  baum_planar_load_def motor = baum_planar_load_def_default();
  motor.name = "motor";
  motor.body = k[0];
  motor.torque = p[MOMENT];
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_planar_load(parts->mechanism, &motor, NULL));
}

static void build(baum_i_parts *parts, const double *p)
{
  baum_body_id ids[7];
  baum_i_parts_gravity(parts, 0.0);
  add_bodies(parts, p, ids);
  add_pins(parts, ids);
  add_forces(parts, p, ids);
}

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [BETA] = {"beta", "rad", "angle of the crank K1 at start; K1 starts at rest", BAUM_I_ANY},
  [MOMENT] = {"moment", "N m", "of the motor on K1", BAUM_I_ANY},
  [STIFFNESS] = {"stiffness", "N/m", "of the spring on K3", BAUM_I_POSITIVE},
  [FREE_LENGTH] = {"free_length", "m", "of the spring", BAUM_I_POSITIVE},
};

#define BODIES BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmr", 7)

const baum_i_catalog_mechanism baum_i_andrews_bodies = {
  BODIES,
  .name = "andrews_bodies",
  .title = "Andrews' squeezing mechanism as 7 rigid bodies",
  .source = ANDREWS_SOURCE,
  .provenance = ANDREWS_PROVENANCE,
  .note = "angular velocities reach 1500 rad/s within 0.03 s",
  .defaults = (const double[COUNT]){ANDREWS_START, ANDREWS_MOMENT, ANDREWS_C0, ANDREWS_L0},
  .end = 0.03,
  BAUM_I_CATALOG_STORED(ANDREWS, 15),
};

const baum_i_catalog_mechanism baum_i_andrews_a03 = {
  BODIES,
  .name = "andrews_a03",
  .title = "Andrews' mechanism as 7 rigid bodies, started at beta = -0.062 rad and run for 0.05 s",
  .source = "IFToMM and A Coruna library of benchmarks, A03, with the data of the Bari test set",
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 15.5 digits",
  .note = "the published result is only a plot",
  .defaults = (const double[COUNT]){-0.062, ANDREWS_MOMENT, ANDREWS_C0, ANDREWS_L0},
  .end = 0.05,
  BAUM_I_CATALOG_STORED(ANDREWS_A03, 14),
};
