/* SPDX-License-Identifier: BSD-3-Clause */
/* Andrews' squeezing mechanism as seven rigid bodies. Geometry, read off the equations of the
 * test set:
 *
 *   K1 turns about O = (0, 0), angle beta.            E = rr (cos, sin) beta
 *   K2 at E, angle beta + Theta.                      F = E - d (cos, sin)
 *   K3 turns about B, angle gamma.                    F = B + ss (sin, -cos) gamma
 *                                                     and the spring at (sd, -sc) to C
 *   K5 turns about A, angle delta.                    G = A + zt (cos, sin) delta
 *   K4 at G, angle Phi + delta.                       F = G + e (sin, -cos)
 *   K7 turns about A, angle epsilon.                  H = A + u (sin, -cos) epsilon
 *   K6 at H, angle Omega + epsilon.                   F = H + zf (cos, sin)
 *
 * Centres of mass from the mass matrix: K1 ra from O, K2 da from E towards F, K4 e - ea from G
 * towards F, K6 zf - fa from H towards F, K3, K5, K7 at sqrt(sa^2 + sb^2), sqrt(ta^2 + tb^2),
 * sqrt(ua^2 + ub^2) from their pivots; without gravity their directions do not matter.
 */
#include "andrews.h"
#include "builder.h"

#include <math.h>

/* Points below are in axes of the body, from its pivot (E, G, H for K2, K4, K6); centre[] is the
 * centre of mass. */
static const double CENTRE[7][2] = {
  {ANDREWS_RA, 0},           {-ANDREWS_DA, 0},
  {ANDREWS_SB, -ANDREWS_SA}, {0, -(ANDREWS_E - ANDREWS_EA)},
  {ANDREWS_TA, ANDREWS_TB},  {ANDREWS_ZF - ANDREWS_FA, 0},
  {ANDREWS_UA, -ANDREWS_UB},
};

static double body_angle(int k)
{
  static const int added[7][2] = {{0, -1}, {0, 1}, {2, -1}, {3, 4}, {4, -1}, {5, 6}, {6, -1}};
  double angle = ANDREWS_START[added[k][0]];
  return added[k][1] < 0 ? angle : angle + ANDREWS_START[added[k][1]];
}

/* at + the point (x, y) of a body at some angle. */
static void locate(const double at[2], double angle, double x, double y, double out[2])
{
  double c = cos(angle);
  double s = sin(angle);
  out[0] = at[0] + c * x - s * y;
  out[1] = at[1] + s * x + c * y;
}

static void find_pivots(double pivots[7][2])
{
  static const double origin[2] = {0, 0};
  for (int i = 0; i < 2; i++) {
    pivots[0][i] = origin[i];
    pivots[2][i] = ANDREWS_B[i];
    pivots[4][i] = pivots[6][i] = ANDREWS_A[i];
  }
  locate(origin, body_angle(0), ANDREWS_RR, 0, pivots[1]);
  locate(ANDREWS_A, body_angle(4), ANDREWS_ZT, 0, pivots[3]);
  locate(ANDREWS_A, body_angle(6), 0, -ANDREWS_U, pivots[5]);
}

static void add_bodies(builder *build, baum_body_id ids[7])
{
  static const char *const names[7] = {"K1", "K2", "K3", "K4", "K5", "K6", "K7"};
  double pivots[7][2];
  find_pivots(pivots);
  for (int k = 0; k < 7; k++) {
    baum_planar_body_def def = baum_planar_body_def_default();
    def.name = names[k];
    def.mass = ANDREWS_MASS[k];
    def.inertia = ANDREWS_INERTIA[k];
    def.angle = body_angle(k);
    def.velocity[0] = def.velocity[1] = def.angular_velocity = 0.0;
    locate(pivots[k], def.angle, CENTRE[k][0], CENTRE[k][1], def.position);
    ids[k] = build_body(build, &def);
  }
}

/* The point of body k that is (x, y) from its pivot. */
static place on(const baum_body_id ids[7], int k, double x, double y)
{
  return (place){ids[k], {x - CENTRE[k][0], y - CENTRE[k][1]}};
}

static void add_pins(builder *build, const baum_body_id k[7])
{
  static const double origin[2] = {0, 0};
  place ground_o = {BAUM_GROUND, {origin[0], origin[1]}};
  place ground_a = {BAUM_GROUND, {ANDREWS_A[0], ANDREWS_A[1]}};
  place ground_b = {BAUM_GROUND, {ANDREWS_B[0], ANDREWS_B[1]}};
  place f = on(k, 1, -ANDREWS_D, 0);
  build_pin(build, "O", ground_o, on(k, 0, 0, 0));
  build_pin(build, "E", on(k, 0, ANDREWS_RR, 0), on(k, 1, 0, 0));
  build_pin(build, "B", ground_b, on(k, 2, 0, 0));
  build_pin(build, "A5", ground_a, on(k, 4, 0, 0));
  build_pin(build, "A7", ground_a, on(k, 6, 0, 0));
  build_pin(build, "G", on(k, 4, ANDREWS_ZT, 0), on(k, 3, 0, 0));
  build_pin(build, "H", on(k, 6, 0, -ANDREWS_U), on(k, 5, 0, 0));
  build_pin(build, "F3", f, on(k, 2, 0, -ANDREWS_SS));
  build_pin(build, "F4", f, on(k, 3, 0, -ANDREWS_E));
  build_pin(build, "F6", f, on(k, 5, ANDREWS_ZF, 0));
}

static void add_forces(builder *build, const baum_body_id k[7])
{
  baum_planar_spring_def spring = baum_planar_spring_def_default();
  place end = on(k, 2, ANDREWS_SD, -ANDREWS_SC);
  spring.name = "spring";
  spring.body_a = BAUM_GROUND;
  spring.body_b = end.body;
  for (int i = 0; i < 2; i++) {
    spring.point_a[i] = ANDREWS_C[i] * build_unit(build, 1, 0, 0);
    spring.point_b[i] = end.point[i] * build_unit(build, 1, 0, 0);
  }
  spring.stiffness = ANDREWS_C0 * build_unit(build, 0, 1, -2);
  spring.free_length = ANDREWS_L0 * build_unit(build, 1, 0, 0);
  baum_planar_load_def motor = baum_planar_load_def_default();
  motor.name = "motor";
  motor.body = k[0];
  motor.torque = ANDREWS_MOMENT * build_unit(build, 2, 1, -2);
  if (build_fine(build)) {
    build_force(build, baum_mechanism_add_planar_spring(build->out->mechanism, &spring, NULL));
  }
  if (build_fine(build)) {
    build_force(build, baum_mechanism_add_planar_load(build->out->mechanism, &motor, NULL));
  }
}

baum_status model_andrews_bodies(model *out)
{
  return model_andrews_bodies_in(NULL, out);
}

baum_status model_andrews_bodies_in(const model_units *units, model *out)
{
  builder build = build_begin_in(units, out);
  build_gravity(&build, 0.0);
  baum_body_id ids[7];
  add_bodies(&build, ids);
  add_pins(&build, ids);
  add_forces(&build, ids);
  return build_finish(&build);
}

void model_andrews_from_bodies(const double *q, double angles[MODEL_ANDREWS_ANGLES])
{
  double k[7];
  for (int i = 0; i < 7; i++) {
    k[i] = q[3 * i + 2];
  }
  angles[0] = k[0];
  angles[1] = k[1] - k[0];
  angles[2] = k[2];
  angles[3] = k[3] - k[4];
  angles[4] = k[4];
  angles[5] = k[5] - k[6];
  angles[6] = k[6];
}
