/* SPDX-License-Identifier: BSD-3-Clause */
#include "manifold_bodies.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "rotation.h"

static const double GRAVITY = 9.81;

/* ---- an angle as (cos, sin) ---- */

static void turn(double angle, double *c)
{
  double cosine = cos(angle);
  double sine = sin(angle);
  double turned[2] = {c[0] * cosine - c[1] * sine, c[1] * cosine + c[0] * sine};
  memcpy(c, turned, sizeof turned);
}

static double angle_between(const double *from, const double *to)
{
  return atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
}

static void shorten(double *c)
{
  double length = hypot(c[0], c[1]);
  c[0] /= length;
  c[1] /= length;
}

static void angle_rate(const double *q, const double *v, double *dq, void *user)
{
  (void)user;
  dq[0] = -q[1] * v[0];
  dq[1] = q[0] * v[0];
}

static void angle_move(double h, const double *v, double *q, void *user)
{
  (void)user;
  turn(h * v[0], q);
}

static void angle_difference(const double *from, const double *to, double *dx, void *user)
{
  (void)user;
  dx[0] = angle_between(from, to);
}

static void angle_normalize(double *q, void *user)
{
  (void)user;
  shorten(q);
}

static int angle_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  const manifold_body *body = user;
  out[0] = body->inertia[0];
  return 0;
}

/* Computes the moment of the weight of a pendulum. The pendulum points in the direction q = (cos,
 * sin). */
static int angle_force(double t, const double *q, const double *v, const double *inputs,
                       double *out, void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  const manifold_body *body = user;
  out[0] = -body->mass * GRAVITY * q[0];
  return 0;
}

static int angle_potential(double t, const double *q, double *out, void *user)
{
  (void)t;
  const manifold_body *body = user;
  out[0] = body->mass * GRAVITY * q[1];
  return 0;
}

baum_body_id manifold_add_angle(baum_mechanism *mechanism, manifold_body *body, double angle,
                                const double *v)
{
  baum_body_id id;
  const double q[2] = {cos(angle), sin(angle)};
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = 1;
  def.position_count = 2;
  def.q = q;
  def.v = v;
  def.mass = angle_mass;
  def.force = angle_force;
  def.potential = angle_potential;
  def.rate = angle_rate;
  def.move = angle_move;
  def.difference = angle_difference;
  def.normalize = angle_normalize;
  def.constant_mass = true;
  def.depends_on_velocity = false;
  def.user = body;
  check(baum_mechanism_add_coordinates(mechanism, &def, &id));
  return id;
}

/* ---- turned body ---- */

static void turned_rate(const double *q, const double *v, double *dq, void *user)
{
  dq[0] = v[0];
  dq[1] = v[1];
  angle_rate(q + 2, v + 2, dq + 2, user);
}

static void turned_move(double h, const double *v, double *q, void *user)
{
  q[0] += h * v[0];
  q[1] += h * v[1];
  angle_move(h, v + 2, q + 2, user);
}

static void turned_difference(const double *from, const double *to, double *dx, void *user)
{
  dx[0] = to[0] - from[0];
  dx[1] = to[1] - from[1];
  angle_difference(from + 2, to + 2, dx + 2, user);
}

static void turned_normalize(double *q, void *user)
{
  angle_normalize(q + 2, user);
}

static int turned_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  const manifold_body *body = user;
  out[0] = out[4] = body->mass;
  out[8] = body->inertia[0];
  return 0;
}

static int turned_force(double t, const double *q, const double *v, const double *inputs,
                        double *out, void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  const manifold_body *body = user;
  out[1] = -body->mass * GRAVITY;
  return 0;
}

static int turned_potential(double t, const double *q, double *out, void *user)
{
  (void)t;
  const manifold_body *body = user;
  out[0] = body->mass * GRAVITY * q[1];
  return 0;
}

baum_body_id manifold_add_turned(baum_mechanism *mechanism, manifold_body *body, double x, double y,
                                 double angle, const double *v)
{
  baum_body_id id;
  const double q[4] = {x, y, cos(angle), sin(angle)};
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = 3;
  def.position_count = 4;
  def.q = q;
  def.v = v;
  def.mass = turned_mass;
  def.force = turned_force;
  def.potential = turned_potential;
  def.rate = turned_rate;
  def.move = turned_move;
  def.difference = turned_difference;
  def.normalize = turned_normalize;
  def.constant_mass = true;
  def.depends_on_velocity = false;
  def.user = body;
  check(baum_mechanism_add_coordinates(mechanism, &def, &id));
  return id;
}

/* ---- tops ---- */

static void free_rate(const double *p, const double *w, double *dp, void *user)
{
  (void)user;
  const double z[4] = {0.0, 0.5 * w[0], 0.5 * w[1], 0.5 * w[2]};
  quaternion_product(p, z, dp);
}

/* Rotates p by an angle for which tan(angle / 2) = h |w| / 2. This agrees with the exponential map
 * up to second order. */
static void free_move(double h, const double *w, double *p, void *user)
{
  (void)user;
  const double z[4] = {1.0, 0.5 * h * w[0], 0.5 * h * w[1], 0.5 * h * w[2]};
  double moved[4];
  quaternion_product(p, z, moved);
  quaternion_normalize(moved);
  memcpy(p, moved, sizeof moved);
}

static void free_difference(const double *from, const double *to, double *dx, void *user)
{
  (void)user;
  const double back[4] = {from[0], -from[1], -from[2], -from[3]};
  double z[4];
  quaternion_product(back, to, z);
  for (int i = 0; i < 3; i++) {
    dx[i] = 2.0 * z[i + 1] / z[0];
  }
}

static void free_normalize(double *p, void *user)
{
  (void)user;
  quaternion_normalize(p);
}

static int free_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  const manifold_body *body = user;
  for (int i = 0; i < 3; i++) {
    out[4 * i] = body->inertia[i];
  }
  return 0;
}

static bool is_gyroscopic(const manifold_body *body)
{
  return body->inertia[0] != body->inertia[1] || body->inertia[0] != body->inertia[2];
}

/* The gyroscopic moment -w x (I w). */
static int free_force(double t, const double *q, const double *v, const double *inputs, double *out,
                      void *user)
{
  (void)t;
  (void)q;
  (void)inputs;
  const manifold_body *body = user;
  const double momentum[3] = {body->inertia[0] * v[0], body->inertia[1] * v[1],
                              body->inertia[2] * v[2]};
  if (is_gyroscopic(body)) { /* otherwise `out` is already zero */
    cross(momentum, v, out);
  }
  return 0;
}

static const double P_SCALE[7] = {1.0, 1.0, 1.0, 0.5, 0.5, 0.5, 0.5};

baum_body_id manifold_add_free_top(baum_mechanism *mechanism, manifold_body *body,
                                   const double p[4], const double *v)
{
  baum_body_id id;
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = 3;
  def.position_count = 4;
  def.position_scale = P_SCALE + 3;
  def.q = p;
  def.v = v;
  def.mass = free_mass;
  def.force = free_force;
  def.rate = free_rate;
  def.move = free_move;
  def.difference = free_difference;
  def.normalize = free_normalize;
  def.constant_mass = true;
  def.depends_on_velocity = is_gyroscopic(body);
  def.user = body;
  check(baum_mechanism_add_coordinates(mechanism, &def, &id));
  return id;
}

static void top_rate(const double *q, const double *v, double *dq, void *user)
{
  memcpy(dq, v, 3 * sizeof *v);
  free_rate(q + 3, v + 3, dq + 3, user);
}

static void top_move(double h, const double *v, double *q, void *user)
{
  for (int i = 0; i < 3; i++) {
    q[i] += h * v[i];
  }
  free_move(h, v + 3, q + 3, user);
}

static void top_difference(const double *from, const double *to, double *dx, void *user)
{
  for (int i = 0; i < 3; i++) {
    dx[i] = to[i] - from[i];
  }
  free_difference(from + 3, to + 3, dx + 3, user);
}

static void top_normalize(double *q, void *user)
{
  free_normalize(q + 3, user);
}

static int top_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  const manifold_body *body = user;
  for (int i = 0; i < 6; i++) {
    out[7 * i] = i < 3 ? body->mass : body->inertia[i - 3];
  }
  return 0;
}

/* Adds the weight, which acts along -z. */
static int top_force(double t, const double *q, const double *v, const double *inputs, double *out,
                     void *user)
{
  const manifold_body *body = user;
  out[2] = -body->mass * GRAVITY;
  return free_force(t, q + 3, v + 3, inputs, out + 3, user);
}

static int top_potential(double t, const double *q, double *out, void *user)
{
  (void)t;
  const manifold_body *body = user;
  out[0] = body->mass * GRAVITY * q[2];
  return 0;
}

baum_body_id manifold_add_top(baum_mechanism *mechanism, manifold_body *body, const double q[7],
                              const double *v)
{
  baum_body_id id;
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = 6;
  def.position_count = 7;
  def.position_scale = P_SCALE;
  def.q = q;
  def.v = v;
  def.mass = top_mass;
  def.force = top_force;
  def.potential = top_potential;
  def.rate = top_rate;
  def.move = top_move;
  def.difference = top_difference;
  def.normalize = top_normalize;
  def.constant_mass = true;
  def.depends_on_velocity = is_gyroscopic(body);
  def.user = body;
  check(baum_mechanism_add_coordinates(mechanism, &def, &id));
  return id;
}
