/* SPDX-License-Identifier: BSD-3-Clause */
#include "manifold_tops.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "manifold_bodies.h"
#include "rotation.h"

/* A body that rotates about a fixed point, the origin. */
typedef struct top {
  manifold_body body;
  double point[3]; /* the fixed point relative to the centre of mass, in body axes */
  double p[4];
  double w[3];
} top;

static top free_top = {.body = {.mass = 0.0, .inertia = {1.0, 2.0, 2.7}},
                       .p = {0.5, 0.5, -0.5, 0.5},
                       .w = {3.0, 0.4, 2.0}};
static top heavy_top = {.body = {.mass = 1.2, .inertia = {0.3, 0.5, 0.4}},
                        .point = {0.1, -0.2, -0.6},
                        .p = {0.6, 0.0, 0.8, 0.0},
                        .w = {2.0, -1.0, 6.0}};
static top ball = {.body = {.mass = 1.2, .inertia = {0.4, 0.4, 0.4}},
                   .point = {0.1, -0.2, -0.6},
                   .p = {0.6, 0.0, 0.8, 0.0},
                   .w = {2.0, -1.0, 3.0}};

static int point_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  const top *of = user;
  rotate(q + 3, of->point, out);
  for (int i = 0; i < 3; i++) {
    out[i] += q[i];
  }
  return 0;
}

/* The velocity of the fixed point is r' + A (w x s), where s is this point in body axes and A is
 * the rotation matrix. The columns for w are therefore A (e_j x s). */
static int point_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  const top *of = user;
  for (int j = 0; j < 3; j++) {
    const double axis[3] = {j == 0, j == 1, j == 2};
    double arm[3];
    double column[3];
    cross(axis, of->point, arm);
    rotate(q + 3, arm, column);
    out[6 * j + j] = 1.0;
    for (int i = 0; i < 3; i++) {
      out[6 * i + 3 + j] = column[i];
    }
  }
  return 0;
}

static void build_top(baum_mechanism *mechanism, top *of, bool jacobian)
{
  double q[7];
  double v[6] = {(double)NAN, (double)NAN, (double)NAN, of->w[0], of->w[1], of->w[2]};
  rotate(of->p, of->point, q);
  for (int i = 0; i < 7; i++) {
    q[i] = i < 3 ? -q[i] : of->p[i - 3];
  }
  baum_body_id id = manifold_add_top(mechanism, &of->body, q, v);
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.bodies = &id;
  def.body_count = 1;
  def.row_count = 3;
  def.phi = point_phi;
  def.jacobian = jacobian ? point_jacobian : NULL;
  def.user = of;
  check(baum_mechanism_add_user_constraint(mechanism, &def, NULL));
  check(baum_mechanism_set_gravity(mechanism, 0.0, 0.0, -9.81));
}

void manifold_build_free_top(baum_mechanism *mechanism)
{
  (void)manifold_add_free_top(mechanism, &free_top.body, free_top.p, free_top.w);
}

void manifold_build_heavy_top(baum_mechanism *mechanism)
{
  build_top(mechanism, &heavy_top, false);
}

void manifold_build_given_top(baum_mechanism *mechanism)
{
  build_top(mechanism, &heavy_top, true);
}

void manifold_build_spatial_top(baum_mechanism *mechanism)
{
  baum_body_id id;
  const top *of = &heavy_top;
  baum_spatial_body_def body = baum_spatial_body_def_default();
  baum_spatial_spherical_def joint = baum_spatial_spherical_def_default();
  body.mass = of->body.mass;
  memcpy(body.inertia, of->body.inertia, 3 * sizeof *body.inertia);
  memcpy(body.orientation, of->p, sizeof of->p);
  memcpy(body.angular_velocity, of->w, sizeof of->w);
  rotate(of->p, of->point, body.position);
  for (int i = 0; i < 3; i++) {
    body.position[i] = -body.position[i];
  }
  check(baum_mechanism_add_spatial_body(mechanism, &body, &id));
  joint.body_b = id;
  memset(joint.point, 0, sizeof joint.point);
  joint.body_a = BAUM_GROUND;
  check(baum_mechanism_add_spatial_spherical(mechanism, &joint, NULL));
  check(baum_mechanism_set_gravity(mechanism, 0.0, 0.0, -9.81));
}

void manifold_build_ball(baum_mechanism *mechanism)
{
  build_top(mechanism, &ball, true);
}

/* Evaluates Euler's equations about the fixed point: J0 w' = (J0 w) x w + moment of the weight,
 * with J0 = I + m (s.s - s s^T). Here s is the fixed point in body axes. */
static void top_rates(const top *of, const double y[7], double dy[7])
{
  const double *s = of->point;
  const double *w = y + 4;
  double mass = of->body.mass;
  double down[3] = {0.0, 0.0, mass * 9.81};
  const double back[4] = {y[0], -y[1], -y[2], -y[3]};
  double weight[3];
  double moment[3];
  double spin[3];
  double momentum[3];
  double matrix[9];
  double square = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
  for (int i = 0; i < 3; i++) {
    momentum[i] = 0.0;
    for (int j = 0; j < 3; j++) {
      double inertia = i == j ? of->body.inertia[i] + mass * square : 0.0;
      matrix[3 * i + j] = inertia - mass * s[i] * s[j];
      momentum[i] += matrix[3 * i + j] * w[j];
    }
  }
  rotate(back, down, weight);
  cross(s, weight, moment);
  cross(momentum, w, spin);
  for (int i = 0; i < 3; i++) {
    moment[i] += spin[i];
  }
  double determinant = 0.0;
  double columns[3][3];
  for (int i = 0; i < 3; i++) {
    cross(matrix + 3 * ((i + 1) % 3), matrix + 3 * ((i + 2) % 3), columns[i]);
  }
  for (int j = 0; j < 3; j++) {
    determinant += matrix[j] * columns[0][j];
  }
  for (int j = 0; j < 3; j++) {
    dy[4 + j] =
      (columns[0][j] * moment[0] + columns[1][j] * moment[1] + columns[2][j] * moment[2]) /
      determinant;
  }
  const double z[4] = {0.0, 0.5 * w[0], 0.5 * w[1], 0.5 * w[2]};
  quaternion_product(y, z, dy);
}

/* Integrates to t by the classical Runge-Kutta method with steps of 1/20000 s. */
static void solve_top(const top *of, double t, double y[7])
{
  static const double SHARE[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  static const double AT[4] = {0.0, 0.5, 0.5, 1.0};
  int steps = (int)ceil(fabs(t) * 20000.0);
  memcpy(y, of->p, 4 * sizeof *y);
  memcpy(y + 4, of->w, 3 * sizeof *y);
  quaternion_normalize(y);
  for (int n = 0; n < steps; n++) {
    double h = t / steps;
    double next[7];
    double rate[7] = {0.0};
    memcpy(next, y, sizeof next);
    for (int k = 0; k < 4; k++) {
      double at[7];
      for (int i = 0; i < 7; i++) {
        at[i] = y[i] + AT[k] * h * rate[i];
      }
      top_rates(of, at, rate);
      for (int i = 0; i < 7; i++) {
        next[i] += SHARE[k] * h * rate[i];
      }
    }
    memcpy(y, next, sizeof next);
    quaternion_normalize(y);
  }
}

void manifold_solve_free_top(double t, double *q)
{
  double y[7];
  solve_top(&free_top, t, y);
  memcpy(q, y, 4 * sizeof *q);
}

static void solve_fixed(const top *of, double t, double *q)
{
  double y[7];
  solve_top(of, t, y);
  rotate(y, of->point, q);
  for (int i = 0; i < 3; i++) {
    q[i] = -q[i];
  }
  memcpy(q + 3, y, 4 * sizeof *q);
}

void manifold_solve_heavy_top(double t, double *q)
{
  solve_fixed(&heavy_top, t, q);
}

void manifold_solve_ball(double t, double *q)
{
  solve_fixed(&ball, t, q);
}
