/* SPDX-License-Identifier: BSD-3-Clause */
/* Steady motion of the disc. The axis of the disc is at the angle p from the vertical. The centre
 * moves with the angular velocity W on a circle of radius c, and the contact point is on the outer
 * side. Relative to axes that precess with the disc, the disc spins about its axis with -x'. The
 * disc has the mass m, the radius R, and the moments of inertia I_a (axial) and I_t (transverse).
 * The acceleration of gravity is g. The contact point does not slip, and the angular momentum about
 * the centre is balanced, if
 *
 *   x' = W (c / R + cos p),   m g R cos p = W^2 sin p (m R c + I_a c / R + I_t cos p)
 *
 * With A = m R^2 + I_a, W is therefore the smaller root of
 *
 *   (A - I_t) cos p W^2 - A x' W + m g R cot p = 0
 *
 * The bushing has the same stiffness k and the same damping d in all directions. Its points are at
 * the distance b from the axis of the revolute joint. At the start, the angle of the pendulum is
 * larger by RELAXED than the angle at which the bushing is relaxed. If h is the angle of the
 * pendulum minus this relaxed angle, the torque of the bushing is -k (b^2 sin h + h) - d (b^2 + 1)
 * x'.
 *
 * The bead is at (r cos x, r sin x, c x) and does not rotate. The cable has the stiffness k and the
 * damping d. It runs from the bead to the point (0, 0, h), and from there over the length SIDE to
 * its end. With l = sqrt(r^2 + (h - c x)^2), the torque of the cable is
 * -(k (l - RELAXED_LENGTH) + d l') dl/dx.
 */
#include "elements.h"

#include <math.h>
#include <string.h>

static const long double RADIUS = 0.5L; /* of the wheel and of the disc */
static const double RIM = 0.1;          /* of the wheel */
static const long double OFF_AXIS = 0.1L;
static const long double TILT = 1.2L; /* p */
static const long double PITCH = 0.4L;
static const long double REVOLUTION = 6.283185307179586476925286766559L;
static const long double BEND = 0.6L; /* angle between the shafts */
static const long double ALONG = 0.3L;
static const long double ARM = 0.5L;
static const long double BUSH = 0.4L; /* b */
static const double RELAXED = 0.1;
static const double RISE = 0.4; /* c [m/rad] */
static const double TOP = 2.0;  /* h */
static const double SIDE = 0.5;
/* The free length of the cable without SIDE. The cable is always taut. */
static const double RELAXED_LENGTH = 1.0;

static const long double MASSES[2][4] = {{1, 0.04L, 0.05L, 0.06L}, {1, 0.02L, 0.03L, 0.04L}};
static const long double DISC_MASS[4] = {1, 0.0625L, 0.0625L, 0.125L};

int elements_bodies(const scene *s)
{
  return s->kind == SCENE_DISC || s->kind >= SCENE_BUSHING ? 1 : 2;
}

/* `ratio` multiplies the mass and the moments of inertia of the last of two bodies, or the moments
 * of inertia of a single body. */
void elements_inertia(const scene *s, int body, long double out[4])
{
  const bool last = body == elements_bodies(s) - 1;
  memcpy(out, s->kind == SCENE_DISC ? DISC_MASS : MASSES[body], sizeof DISC_MASS);
  for (int i = body == 0 ? 1 : 0; i < 4 && last; i++) {
    out[i] *= s->ratio;
  }
}

/* ---- poses ---- */

static carried wheel_body(int body, jets x)
{
  carried c = carried_at(0, 0, RADIUS);
  c.r[0] = jets_scale(RADIUS, x);
  if (body == 0) {
    carried_turn(&c, 1, x);
    carried_go(&c, OFF_AXIS, 0, 0);
  }
  return c;
}

/* Returns W. The disc must be fast enough for steady motion. */
static long double precession_of(const scene *s)
{
  long double m = DISC_MASS[0];
  long double all = m * RADIUS * RADIUS + DISC_MASS[3];
  long double square = (all - DISC_MASS[1]) * cosl(TILT);
  long double linear = all * s->rate;
  long double constant = m * s->gravity * RADIUS * cosl(TILT) / sinl(TILT);
  /* This form has no cancellation, because the two terms of the denominator have the same sign. */
  return 2 * constant / (linear + sqrtl(linear * linear - 4 * square * constant));
}

static carried disc_body(const scene *s, jets x)
{
  long double part = precession_of(s) / s->rate;
  carried c = carried_at(0, 0, 0);
  carried_turn(&c, 2, jets_scale(part, x));
  carried_go(&c, RADIUS * (1 / part - cosl(TILT)), 0, RADIUS * sinl(TILT));
  carried_turn(&c, 1, jets_constant(TILT));
  carried_turn(&c, 2, jets_scale(-1, x));
  return c;
}

static carried screw_body(int body, jets x)
{
  carried c = carried_at(0, 0, 0);
  if (body == 0) {
    carried_turn(&c, 0, x);
    carried_go(&c, 0, OFF_AXIS, 0);
  } else {
    c.r[0] = jets_scale(-PITCH / REVOLUTION, x);
  }
  return c;
}

static carried shaft_body(int body, jets x)
{
  carried c = carried_at(0, 0, 0);
  carried_turn(&c, 2, jets_constant(body == 0 ? 0 : BEND));
  carried_turn(&c, 0, x);
  carried_go(&c, body == 0 ? -ALONG : ALONG, body == 0 ? OFF_AXIS : 0, 0);
  return c;
}

static carried pendulum_body(jets x)
{
  carried c = carried_at(0, 0, 0);
  carried_turn(&c, 1, x);
  carried_go(&c, ARM, 0, 0);
  return c;
}

static carried bead_body(jets x)
{
  carried c = carried_at(0, 0, 0);
  c.r[0] = jets_scale(RADIUS, jets_cos(x));
  c.r[1] = jets_scale(RADIUS, jets_sin(x));
  c.r[2] = jets_scale(RISE, x);
  return c;
}

carried elements_body(const scene *s, int body, jets x)
{
  switch ((int)s->kind) {
  case SCENE_WHEEL: return wheel_body(body, x);
  case SCENE_DISC: return disc_body(s, x);
  case SCENE_SCREW: return screw_body(body, x);
  case SCENE_SHAFTS: return shaft_body(body, x);
  case SCENE_BEAD: return bead_body(x);
  default: return pendulum_body(x);
  }
}

static long double cable_torque(const scene *s, long double x, long double v)
{
  const long double below = TOP - RISE * x;
  const long double length = sqrtl(RADIUS * RADIUS + below * below);
  const long double slope = -RISE * below / length;
  return -(s->stiffness * (length - RELAXED_LENGTH) + s->damping * slope * v) * slope;
}

long double elements_torque(const scene *s, long double x, long double v)
{
  if (s->kind == SCENE_BEAD) {
    return cable_torque(s, x, v);
  }
  long double h = x - (s->angle - RELAXED);
  long double square = BUSH * BUSH;
  return -s->stiffness * (square * sinl(h) + h) - s->damping * (square + 1) * v;
}

/* ---- building ---- */

typedef struct builder {
  const scene *s;
  baum_mechanism *m;
  baum_status status;
  baum_body_id bodies[2];
  double length, mass, time; /* units */
} builder;

#define ADD(KIND, DEF, ID)                                             \
  if (b->status == BAUM_OK) {                                          \
    b->status = baum_mechanism_add_spatial_##KIND(b->m, &(DEF), (ID)); \
  }

static void set_point(const builder *b, long double x, long double y, long double z, double out[3])
{
  out[0] = (double)x * b->length;
  out[1] = (double)y * b->length;
  out[2] = (double)z * b->length;
}

static void set_axis(double x, double y, double z, double out[3])
{
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

static void add_body(builder *b, int body)
{
  const scene *s = b->s;
  const carried c = elements_body(s, body, (jets){{s->angle, 1, 0}});
  baum_spatial_body_def def = baum_spatial_body_def_default();
  long double m[4];
  long double w[3];
  elements_inertia(s, body, m);
  carried_spin(&c, 1, w);
  def.mass = (double)m[0] * b->mass;
  for (int i = 0; i < 3; i++) {
    def.inertia[i] = (double)m[i + 1] * b->mass * b->length * b->length;
    def.position[i] = (double)c.r[i].d[0] * b->length;
    def.velocity[i] = (double)(c.r[i].d[1] * s->rate) * b->length / b->time;
    def.angular_velocity[i] = (double)(w[i] * s->rate) / b->time;
  }
  for (int i = 0; i < 4; i++) {
    def.orientation[i] = (double)c.p[i].d[0];
  }
  def.held = body == 0 && elements_bodies(s) > 1;
  ADD(body, def, &b->bodies[body])
}

static void add_revolute(builder *b, baum_body_id on, baum_body_id body, const double point[3],
                         const double axis[3])
{
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  def.body_a = on;
  def.body_b = body;
  memcpy(def.point, point, sizeof def.point);
  memcpy(def.axis, axis, sizeof def.axis);
  ADD(revolute, def, NULL)
}

/* Adds a slider along the x axis of the ground. */
static void add_slider(builder *b, baum_body_id body)
{
  baum_spatial_prismatic_def def = baum_spatial_prismatic_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = body;
  set_point(b, 0, 0, 0, def.point);
  set_axis(1.0, 0.0, 0.0, def.axis);
  ADD(prismatic, def, NULL)
}

/* The contacts, screws or constant-velocity joints after the first one are redundant. They differ
 * from the first one by `off` [m] and multiples of it. */
static double off_of(const scene *s, int k)
{
  return k * s->off;
}

static void add_wheel(builder *b, int k)
{
  const scene *s = b->s;
  baum_spatial_rolling_disc_def def = baum_spatial_rolling_disc_def_default();
  bool wheel = s->kind == SCENE_WHEEL;
  def.body_b = b->bodies[0];
  set_axis(0.0, 0.0, 1.0, def.normal);
  set_axis(0.0, wheel ? 1.0 : 0.0, wheel ? 0.0 : 1.0, def.axis_b);
  set_point(b, wheel ? -OFF_AXIS : 0, 0, 0, def.centre);
  def.radius = ((double)RADIUS + off_of(s, k)) * b->length;
  def.rim_radius = wheel ? RIM * b->length : 0.0;
  ADD(rolling_disc, def, NULL)
}

static void add_screw(builder *b, int k)
{
  baum_spatial_screw_def def = baum_spatial_screw_def_default();
  def.body_a = b->bodies[0];
  def.body_b = b->bodies[1];
  set_point(b, 0, -OFF_AXIS, 0, def.point_a);
  set_point(b, 0, 0, 0, def.point_b);
  set_axis(1.0, 0.0, 0.0, def.axis);
  def.pitch = (double)PITCH * b->length;
  def.offset = (double)(-PITCH / REVOLUTION * b->s->angle) * b->length;
  def.offset += off_of(b->s, k) * b->length;
  ADD(screw, def, NULL)
}

static void add_constant_velocity(builder *b, int k)
{
  baum_spatial_constant_velocity_def def = baum_spatial_constant_velocity_def_default();
  def.body_a = b->bodies[0];
  def.body_b = b->bodies[1];
  set_point(b, ALONG, -OFF_AXIS, 0, def.point_a);
  set_point(b, -ALONG + off_of(b->s, k), 0, 0, def.point_b);
  set_axis(1.0, 0.0, 0.0, def.axis);
  set_axis(1.0, 0.0, 0.0, def.axis_b);
  ADD(constant_velocity, def, NULL)
}

/* On the pendulum, the axis of the bushing is the pendulum's x axis. On the ground, it has the
 * direction of this axis at the relaxed angle. */
static void add_bushing(builder *b)
{
  const scene *s = b->s;
  const double relaxed = s->angle - RELAXED;
  baum_spatial_bushing_def def = baum_spatial_bushing_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = b->bodies[0];
  set_point(b, BUSH * cosl(relaxed), 0, -BUSH * sinl(relaxed), def.point_a);
  set_point(b, BUSH - ARM, 0, 0, def.point_b);
  set_axis(cos(relaxed), 0.0, -sin(relaxed), def.axis);
  set_axis(1.0, 0.0, 0.0, def.axis_b);
  set_axis(0.0, 1.0, 0.0, def.x_axis);
  for (int i = 0; i < 36; i += 7) {
    def.stiffness[i] = s->stiffness;
    def.damping[i] = s->damping;
  }
  ADD(bushing, def, NULL)
}

/* No axis of the stress grid varies the units of this scene, so all lengths are in m. */
static int helix(const double xyz[3], double out[20], void *user)
{
  const double r = (double)RADIUS;
  const double cosine = cos(xyz[2] / RISE);
  const double sine = sin(xyz[2] / RISE);
  (void)user;
  out[0] = xyz[0] - r * cosine;
  out[1] = 1.0;
  out[3] = r * sine / RISE;
  out[9] = r * cosine / (RISE * RISE);
  out[10] = xyz[1] - r * sine;
  out[12] = 1.0;
  out[13] = -r * cosine / RISE;
  out[19] = r * sine / (RISE * RISE);
  return 0;
}

static void add_helix(builder *b)
{
  baum_spatial_curve_def def = baum_spatial_curve_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = b->bodies[0];
  set_point(b, 0, 0, 0, def.point_a);
  set_point(b, 0, 0, 0, def.point_b);
  def.curve = helix;
  ADD(curve, def, NULL)
}

static void add_cable(builder *b)
{
  const double points[3][3] = {{SIDE, 0.0, TOP}, {0.0, 0.0, TOP}, {0.0, 0.0, 0.0}};
  const baum_body_id bodies[3] = {BAUM_GROUND, BAUM_GROUND, b->bodies[0]};
  baum_spatial_cable_def def = baum_spatial_cable_def_default();
  def.bodies = bodies;
  def.points = points[0];
  def.point_count = 3;
  def.stiffness = b->s->stiffness;
  def.damping = b->s->damping;
  def.free_length = RELAXED_LENGTH + SIDE;
  ADD(cable, def, NULL)
}

static void add_joints(builder *b)
{
  static const double x[3] = {1.0, 0.0, 0.0};
  static const double y[3] = {0.0, 1.0, 0.0};
  const scene *s = b->s;
  const double bent[3] = {cos((double)BEND), sin((double)BEND), 0.0};
  double origin[3] = {0.0, 0.0, 0.0};
  if (s->kind == SCENE_WHEEL) {
    set_point(b, RADIUS * s->angle, 0, RADIUS, origin);
    add_revolute(b, b->bodies[1], b->bodies[0], origin, y);
    add_slider(b, b->bodies[1]);
  } else if (s->kind == SCENE_SCREW) {
    add_revolute(b, BAUM_GROUND, b->bodies[0], origin, x);
    add_slider(b, b->bodies[1]);
  } else if (s->kind == SCENE_SHAFTS) {
    add_revolute(b, BAUM_GROUND, b->bodies[0], origin, x);
    add_revolute(b, BAUM_GROUND, b->bodies[1], origin, bent);
  } else if (s->kind == SCENE_BUSHING) {
    add_revolute(b, BAUM_GROUND, b->bodies[0], origin, y);
    add_bushing(b);
  } else if (s->kind == SCENE_BEAD) {
    add_helix(b);
    add_cable(b);
  }
  for (int k = 0; k <= s->spare; k++) {
    switch ((int)s->kind) {
    case SCENE_WHEEL:
    case SCENE_DISC: add_wheel(b, k); break;
    case SCENE_SCREW: add_screw(b, k); break;
    case SCENE_SHAFTS: add_constant_velocity(b, k); break;
    default: break;
    }
  }
}

baum_status elements_build(const scene *s, baum_mechanism **out)
{
  builder all = {.s = s, .length = s->units.length, .mass = s->units.mass, .time = s->units.time};
  builder *b = &all;
  b->status = baum_mechanism_create(&b->m);
  if (b->status == BAUM_OK) {
    double g = s->gravity * b->length / (b->time * b->time);
    b->status = baum_mechanism_set_gravity(b->m, 0.0, 0.0, -g);
  }
  for (int k = 0; k < elements_bodies(s); k++) {
    add_body(b, k);
  }
  add_joints(b);
  b->status = b->status == BAUM_OK ? baum_mechanism_freeze(b->m) : b->status;
  if (b->status != BAUM_OK) {
    baum_mechanism_destroy(b->m);
    b->m = NULL;
  }
  *out = b->m;
  return b->status;
}
