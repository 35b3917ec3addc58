/* SPDX-License-Identifier: BSD-3-Clause */
/* A particle on a massless rod moves on a circle. In the mechanism "pendulum_mebdf", a test problem
 * of the MEBDF codes, the constraint (x^2 + y^2 - 1) / 2 replaces the rod, so that the multipliers
 * agree with the published ones. If a is the angle from the downward vertical, then
 *
 *   a'' = -(g / l) sin a,  (x, y) = l (sin a, -cos a)
 */
#include "catalog/catalog.h"

#include <math.h>
#include <string.h>

#include "catalog/swing.h"

#define LEVEL 1.5707963267948966 /* a quarter of a revolution */

enum { GRAVITY, ANGLE, SPEED, MASS, COUNT_ON_CIRCLE, LENGTH = COUNT_ON_CIRCLE, COUNT };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [GRAVITY] = {"gravity", "m/s^2", "downwards", BAUM_I_ANY},
  [ANGLE] = {"angle", "rad", "of the rod at start, from the downward vertical", BAUM_I_ANY},
  [SPEED] = {"speed", "m/s", "of the point at start, counterclockwise", BAUM_I_ANY},
  [MASS] = {"mass", "kg", "of the point", BAUM_I_POSITIVE},
  [LENGTH] = {"length", "m", "of the rod", BAUM_I_POSITIVE},
};

/* ---- motion ---- */

static double solve(const double *p, double length, double t, double *q, double *v)
{
  q[0] = p[ANGLE];
  v[0] = p[SPEED] / length;
  return baum_i_swing(p[GRAVITY] / length, t, q, v);
}

static baum_i_body_state place(double length, double angle, double rate)
{
  return (baum_i_body_state){{length * sin(angle), -length * cos(angle)},
                             {length * cos(angle) * rate, length * sin(angle) * rate}};
}

static double rod_solution(const double *p, double t, double *q, double *v)
{
  return solve(p, p[LENGTH], t, q, v);
}

static double circle_solution(const double *p, double t, double *q, double *v)
{
  return solve(p, 1.0, t, q, v);
}

static baum_i_body_state rod_state(const double *p, const double *q, const double *v, int body)
{
  (void)body;
  return place(p[LENGTH], q[0], v[0]);
}

static baum_i_body_state circle_state(const double *p, const double *q, const double *v, int body)
{
  (void)p;
  (void)body;
  return place(1.0, q[0], v[0]);
}

/* ---- mechanisms ---- */

static baum_body_id add_bob(baum_i_parts *parts, const double *p, double length)
{
  const baum_i_body_state at = place(length, p[ANGLE], p[SPEED] / length);
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  bob.name = "bob";
  bob.mass = p[MASS];
  memcpy(bob.position, at.q, sizeof bob.position);
  memcpy(bob.velocity, at.v, sizeof bob.velocity);
  baum_i_parts_gravity(parts, p[GRAVITY]);
  return baum_i_parts_particle(parts, &bob);
}

static void build_on_rod(baum_i_parts *parts, const double *p)
{
  baum_i_spot bob = {.body = add_bob(parts, p, p[LENGTH])};
  baum_i_parts_rod(parts, "rod", (baum_i_spot){.body = BAUM_GROUND}, bob, p[LENGTH]);
}

static int phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = (q[0] * q[0] + q[1] * q[1] - 1.0) / 2;
  return 0;
}

static int jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[0];
  out[1] = q[1];
  return 0;
}

static int gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  out[0] = -v[0] * v[0] - v[1] * v[1];
  return 0;
}

static void build_on_circle(baum_i_parts *parts, const double *p)
{
  baum_body_id bob = add_bob(parts, p, 1.0);
  baum_user_constraint_def circle = baum_user_constraint_def_default();
  circle.name = "circle";
  circle.row_count = 1;
  circle.phi = phi;
  circle.jacobian = jacobian;
  circle.gamma = gamma;
  baum_i_parts_constraint(parts, bob, circle);
}

/* ---- entries ---- */

#define BY_SERIES                                                                               \
  "Taylor series of the pendulum equation, available for all values of the parameters; agrees " \
  "to 13 digits with extrapolation in 160-bit arithmetic"

#define ON_ROD(SAMPLES)                                               \
  BAUM_I_CATALOG_MODEL(PARAMETERS, build_on_rod, rod_state, "mm", 1), \
    BAUM_I_CATALOG_COMPUTED(rod_solution, SAMPLES, 1, 12), .provenance = BY_SERIES

const baum_i_catalog_mechanism baum_i_pendulum_a01 = {
  ON_ROD(21),
  .name = "pendulum",
  .title = "simple pendulum, released from the horizontal on the left",
  .source = "IFToMM and A Coruna library of benchmarks, A01",
  .defaults = (const double[COUNT]){9.81, -LEVEL, 0.0, 1.0, 1.0},
  .end = 10.0,
};

const baum_i_catalog_mechanism baum_i_pendulum_sundials = {
  ON_ROD(41), /* one sample every 0.75 s, so that not all samples are at the ends of the swing */
  .name = "pendulum_sundials",
  .title =
    "simple pendulum with a period of exactly 2 s, released from the horizontal on the right",
  .source = "LLNL/sundials, examples/cvode/serial/cvPendulum_dns.c",
  .defaults = (const double[COUNT]){13.750371636040745, LEVEL, 0.0, 1.0, 1.0},
  .end = 30.0,
};

const baum_i_catalog_mechanism baum_i_pendulum_mebdf = {
  .name = "pendulum_mebdf",
  .title = "simple pendulum of 1 m, given by user functions: test problem of the MEBDF codes",
  .source = "J. Cash, MEBDFDAE, pendul3.f (copy in the GitHub repository fons/JavaOdeInt)",
  .provenance = BY_SERIES ". All 10 digits of the published values at 1 s agree",
  .parameter_count = COUNT_ON_CIRCLE,
  .parameters = PARAMETERS,
  .defaults = (const double[COUNT_ON_CIRCLE]){1.0, LEVEL, 1.0, 1.0},
  .end = 1.0,
  .build = build_on_circle,
  .units = "mm",
  .bodies = 1,
  BAUM_I_CATALOG_COMPUTED(circle_solution, 11, 1, 12),
  .state = circle_state,
};
