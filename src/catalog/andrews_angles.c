/* SPDX-License-Identifier: BSD-3-Clause */
/* Andrews' squeezing mechanism in 7 angles, q = (beta, Theta, gamma, Phi, delta, Omega, epsilon).
 * It is a problem of the Bari test set (G. Andrews, M. Ormrod, 1986; E. Hairer, G. Wanner, Solving
 * ODEs II, p. 530 ff). The functions mass(), force() and phi() compute the M, f and g of the test
 * set, term by term. The equation of motion of the test set is M a + G^T lambda = f with G =
 * dg/dq. */
#include "catalog/andrews.h"

#include <math.h>

#include "catalog/catalog.h"
#include "catalog/data/andrews.h"

enum { BETA, THETA, GAMMA, PHI, DELTA, OMEGA, EPSILON, COUNT };

static double square(double x)
{
  return x * x;
}

static void set(double *m, int i, int j, double value)
{
  m[COUNT * i + j] = value;
  m[COUNT * j + i] = value;
}

static int mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  const double *m = ANDREWS_MASS;
  const double *inertia = ANDREWS_INERTIA;
  double c2 = ANDREWS_DA * ANDREWS_RR * cos(q[THETA]);
  double e4 = ANDREWS_E - ANDREWS_EA;
  double s4 = ANDREWS_ZT * e4 * sin(q[PHI]);
  double f6 = ANDREWS_ZF - ANDREWS_FA;
  double s6 = ANDREWS_U * f6 * sin(q[OMEGA]);
  double own2 = m[1] * square(ANDREWS_DA) + inertia[1];
  double own4 = m[3] * square(e4) + inertia[3];
  double own6 = m[5] * square(f6) + inertia[5];

  set(out, BETA, BETA,
      m[0] * square(ANDREWS_RA) + m[1] * (square(ANDREWS_RR) - 2 * c2) + own2 + inertia[0]);
  set(out, THETA, BETA, own2 - m[1] * c2);
  set(out, THETA, THETA, own2);
  set(out, GAMMA, GAMMA, m[2] * (square(ANDREWS_SA) + square(ANDREWS_SB)) + inertia[2]);
  set(out, PHI, PHI, own4);
  set(out, DELTA, PHI, own4 + m[3] * s4);
  set(out, DELTA, DELTA,
      own4 + m[3] * (square(ANDREWS_ZT) + 2 * s4) +
        m[4] * (square(ANDREWS_TA) + square(ANDREWS_TB)) + inertia[4]);
  set(out, OMEGA, OMEGA, own6);
  set(out, EPSILON, OMEGA, own6 - m[5] * s6);
  set(out, EPSILON, EPSILON,
      own6 + m[5] * (square(ANDREWS_U) - 2 * s6) +
        m[6] * (square(ANDREWS_UA) + square(ANDREWS_UB)) + inertia[6]);
  return 0;
}

/* Computes the vector along the spring. The spring extends from the fixed point C to the point D on
 * K3. */
static void along_spring(double gamma, double out[2])
{
  out[0] = ANDREWS_SD * cos(gamma) + ANDREWS_SC * sin(gamma) + ANDREWS_B[0] - ANDREWS_C[0];
  out[1] = ANDREWS_SD * sin(gamma) - ANDREWS_SC * cos(gamma) + ANDREWS_B[1] - ANDREWS_C[1];
}

static int force(double t, const double *q, const double *v, const double *inputs, double *out,
                 void *user)
{
  (void)t;
  (void)inputs;
  (void)user;
  const double *m = ANDREWS_MASS;
  double cg = cos(q[GAMMA]);
  double sg = sin(q[GAMMA]);
  double arm[2];
  along_spring(q[GAMMA], arm);
  double length = hypot(arm[0], arm[1]);
  double pull = -ANDREWS_C0 * (length - ANDREWS_L0) / length;
  double k2 = m[1] * ANDREWS_DA * ANDREWS_RR * sin(q[THETA]);
  double k4 = m[3] * ANDREWS_ZT * (ANDREWS_E - ANDREWS_EA) * cos(q[PHI]);
  double k6 = m[5] * ANDREWS_U * (ANDREWS_ZF - ANDREWS_FA) * cos(q[OMEGA]);

  out[BETA] = ANDREWS_MOMENT - k2 * v[THETA] * (v[THETA] + 2 * v[BETA]);
  out[THETA] = k2 * square(v[BETA]);
  out[GAMMA] = pull * (arm[0] * (ANDREWS_SC * cg - ANDREWS_SD * sg) +
                       arm[1] * (ANDREWS_SD * cg + ANDREWS_SC * sg));
  out[PHI] = k4 * square(v[DELTA]);
  out[DELTA] = -k4 * v[PHI] * (v[PHI] + 2 * v[DELTA]);
  out[OMEGA] = -k6 * square(v[EPSILON]);
  out[EPSILON] = k6 * v[OMEGA] * (v[OMEGA] + 2 * v[EPSILON]);
  return 0;
}

static int potential(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  double arm[2];
  along_spring(q[GAMMA], arm);
  out[0] = ANDREWS_C0 / 2 * square(hypot(arm[0], arm[1]) - ANDREWS_L0);
  return 0;
}

/* Bodies K2, K3, K4 and K6 meet at the point F. This function computes the position of F as a point
 * of K2, and subtracts its position as a point of each of the other three bodies. */
static int phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  double along2 = q[BETA] + q[THETA];
  double along4 = q[PHI] + q[DELTA];
  double along6 = q[OMEGA] + q[EPSILON];
  double x = ANDREWS_RR * cos(q[BETA]) - ANDREWS_D * cos(along2);
  double y = ANDREWS_RR * sin(q[BETA]) - ANDREWS_D * sin(along2);
  out[0] = x - ANDREWS_SS * sin(q[GAMMA]) - ANDREWS_B[0];
  out[1] = y + ANDREWS_SS * cos(q[GAMMA]) - ANDREWS_B[1];
  out[2] = x - ANDREWS_E * sin(along4) - ANDREWS_ZT * cos(q[DELTA]) - ANDREWS_A[0];
  out[3] = y + ANDREWS_E * cos(along4) - ANDREWS_ZT * sin(q[DELTA]) - ANDREWS_A[1];
  out[4] = x - ANDREWS_ZF * cos(along6) - ANDREWS_U * sin(q[EPSILON]) - ANDREWS_A[0];
  out[5] = y - ANDREWS_ZF * sin(along6) + ANDREWS_U * cos(q[EPSILON]) - ANDREWS_A[1];
  return 0;
}

static void set_pair(double *out, int pair, int column, double x, double y)
{
  out[COUNT * (2 * pair) + column] = x;
  out[COUNT * (2 * pair + 1) + column] = y;
}

static int jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  double along2 = q[BETA] + q[THETA];
  double along4 = q[PHI] + q[DELTA];
  double along6 = q[OMEGA] + q[EPSILON];
  double theta[2] = {ANDREWS_D * sin(along2), -ANDREWS_D * cos(along2)};
  double x4 = -ANDREWS_E * cos(along4);
  double y4 = -ANDREWS_E * sin(along4);
  double x6 = ANDREWS_ZF * sin(along6);
  double y6 = -ANDREWS_ZF * cos(along6);
  for (int pair = 0; pair < 3; pair++) {
    set_pair(out, pair, BETA, theta[0] - ANDREWS_RR * sin(q[BETA]),
             theta[1] + ANDREWS_RR * cos(q[BETA]));
    set_pair(out, pair, THETA, theta[0], theta[1]);
  }
  set_pair(out, 0, GAMMA, -ANDREWS_SS * cos(q[GAMMA]), -ANDREWS_SS * sin(q[GAMMA]));
  set_pair(out, 1, PHI, x4, y4);
  set_pair(out, 1, DELTA, x4 + ANDREWS_ZT * sin(q[DELTA]), y4 - ANDREWS_ZT * cos(q[DELTA]));
  set_pair(out, 2, OMEGA, x6, y6);
  set_pair(out, 2, EPSILON, x6 - ANDREWS_U * cos(q[EPSILON]), y6 - ANDREWS_U * sin(q[EPSILON]));
  return 0;
}

void baum_i_andrews_pose(double beta, double angles[ANDREWS_ANGLES])
{
  double e[2] = {ANDREWS_RR * cos(beta), ANDREWS_RR * sin(beta)};
  double f[2];
  double g[2];
  double h[2];
  baum_i_meet(e, ANDREWS_D, ANDREWS_B, ANDREWS_SS, 1.0, f);
  baum_i_meet(ANDREWS_A, ANDREWS_ZT, f, ANDREWS_E, 1.0, g);
  baum_i_meet(ANDREWS_A, ANDREWS_U, f, ANDREWS_ZF, -1.0, h);
  angles[BETA] = beta;
  angles[THETA] = atan2(e[1] - f[1], e[0] - f[0]) - beta;
  angles[GAMMA] = atan2(f[0] - ANDREWS_B[0], ANDREWS_B[1] - f[1]);
  angles[DELTA] = atan2(g[1] - ANDREWS_A[1], g[0] - ANDREWS_A[0]);
  angles[PHI] = atan2(f[0] - g[0], g[1] - f[1]) - angles[DELTA];
  angles[EPSILON] = atan2(h[0] - ANDREWS_A[0], ANDREWS_A[1] - h[1]);
  angles[OMEGA] = atan2(f[1] - h[1], f[0] - h[0]) - angles[EPSILON];
}

static void build(baum_i_parts *parts, const double *p)
{
  static const double rest[COUNT] = {0};
  double start[COUNT];
  baum_i_andrews_pose(p[0], start);
  baum_coordinates_def angles = baum_coordinates_def_default();
  angles.name = "angles";
  angles.size = COUNT;
  angles.q = start;
  angles.v = rest;
  angles.mass = mass;
  angles.force = force;
  angles.potential = potential;
  baum_body_id body = {0};
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_coordinates(parts->mechanism, &angles, &body));
  baum_user_constraint_def loops = baum_user_constraint_def_default();
  loops.name = "loops";
  loops.row_count = 6;
  loops.phi = phi;
  loops.jacobian = jacobian;
  baum_i_parts_constraint(parts, body, loops);
}

static const baum_i_catalog_parameter PARAMETERS[1] = {
  {"beta", "rad", "angle of the crank K1 at start; K1 starts at rest", BAUM_I_ANY},
};

const baum_i_catalog_mechanism baum_i_andrews_angles = {
  .name = "andrews_angles",
  .title = "Andrews' squeezing mechanism in 7 angles, given by user functions",
  .source = ANDREWS_SOURCE,
  .provenance = ANDREWS_PROVENANCE,
  .note = "angular velocities reach 1500 rad/s within 0.03 s",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, NULL, "uuuuuuu", 1),
  .defaults = (const double[1]){ANDREWS_START},
  .end = 0.03,
  BAUM_I_CATALOG_STORED(ANDREWS, 15),
};
