/* SPDX-License-Identifier: BSD-3-Clause */
/* All coordinates p(x) are functions of one angle x(t). With p' = dp/dx and the masses m, the
 * equation of motion is
 *
 *   (sum m p'^2) x'' = sum (G p' - m p' p'' x'^2) - k (x - x_r) - d x'
 *
 * Here G is the force of gravity, and k, d and x_r are the stiffness, the damping and the relaxed
 * angle of the spring. Bodies that move in the same way are evaluated only once. The result is
 * multiplied by their number.
 */
#include "space.h"

#include <math.h>
#include <string.h>

#include "tilt.h"

static const long double CRANK = 1.0L;
static const long double COUPLER = 2.0L;
static const long double ROCKER = 2.2L;
static const long double GROUND = 2.5L;
/* [rad] angle at the start minus the relaxed angle of the spring. */
static const double RELAXED = 0.1;

static const scene START[SCENE_KINDS] = {
  [SCENE_BOB] = {.count = 2, .angle = 0.3, .rate = 1.0, .gravity = 9.81},
  [SCENE_PENDULUM] = {.count = 2, .angle = 0.3, .rate = 1.0, .gravity = 9.81},
  [SCENE_CRANK] = {.count = 2, .angle = 0.3, .rate = 1.0, .gravity = 9.81},
  [SCENE_FOUR_BAR] = {.count = 2, .angle = 1.0, .rate = 1.0, .gravity = 9.81},
  /* The cranks of the N-four-bar hang down at the start. They do not reach flat configurations,
   * which are singular. */
  [SCENE_WINDOWS] = {.count = 2, .angle = -1.0, .rate = 1.0, .gravity = 9.81},
  [SCENE_SLEIGH] = {.count = 2, .angle = 0.3, .rate = 1.0, .gravity = 1.0},
  [SCENE_CHAIN] = {.count = 3, .angle = 0.3, .rate = 3.0, .gravity = 0.0},
  [SCENE_SPATIAL_CRANK] = {.angle = 0.3, .rate = 1.0, .gravity = 9.81},
  [SCENE_RSSR] = {.angle = 0.0, .rate = 1.0, .gravity = 9.81, .driven = true},
  [SCENE_BRICARD] = {.angle = 1.0, .rate = 1.0, .gravity = 9.81},
  [SCENE_TOP] = {.angle = 0.0, .rate = 100.0, .gravity = 9.81},
  [SCENE_WHEEL] = {.angle = 0.3, .rate = 1.0, .gravity = 9.81},
  [SCENE_DISC] = {.angle = 0.3, .rate = 6.0, .gravity = 9.81},
  [SCENE_SCREW] = {.angle = 0.3, .rate = 1.0, .gravity = 9.81},
  [SCENE_SHAFTS] = {.angle = 0.3, .rate = 1.0, .gravity = 9.81},
  /* The pendulum starts at rest, so its angle stays far below pi. */
  [SCENE_BUSHING] = {.angle = 1.2, .rate = 0.0, .gravity = 9.81, .stiffness = 10.0},
  [SCENE_BEAD] = {.angle = 0.3, .rate = 1.0, .gravity = 9.81, .stiffness = 10.0},
};

scene scene_of(scene_kind kind)
{
  scene s = START[kind];
  s.kind = kind;
  s.ratio = 1.0;
  s.rod = 2.0;
  s.gap = 1.0;
  s.units = (model_units){1.0, 1.0, 1.0};
  return s;
}

const char *scene_name(const scene *s)
{
  static const char *const NAMES[SCENE_KINDS] = {
    "bob",   "pendulum",      "crank",  "four_bar", "windows", "sleigh",
    "chain", "spatial crank", "rssr",   "bricard",  "top",     "wheel",
    "disc",  "screw",         "shafts", "bushing",  "bead"};
  static const char *const TILTED[SCENE_KINDS] = {
    "tilted bob",     "tilted pendulum", "tilted crank", "tilted four_bar",
    "tilted windows", "tilted sleigh",   "tilted chain"};
  return s->tilted ? TILTED[s->kind] : NAMES[s->kind];
}

int scene_width(const scene *s)
{
  return space_is(s) ? SPACE_NUMBERS : s->kind == SCENE_BOB ? 2 : 3;
}

int scene_bodies(const scene *s)
{
  if (s->kind > SCENE_CHAIN) {
    return space_bodies(s);
  }
  switch ((int)s->kind) {
  case SCENE_CRANK:
  case SCENE_FOUR_BAR: return 3;
  case SCENE_WINDOWS: return 2 * s->count + 1;
  case SCENE_SLEIGH: return 2;
  case SCENE_CHAIN: return s->count;
  default: return 1;
  }
}

/* ---- geometry: points and angles, with two derivatives with respect to x ---- */

typedef struct curve {
  long double at[3]; /* x, y and angle */
  long double d[3];
  long double dd[3];
} curve;

/* An angle and its derivatives with respect to x. */
typedef struct turn {
  long double at;
  long double d;
  long double dd;
} turn;

/* Returns the point at the distance `length` from the point `from`, in the direction of the angle
 * a. The angle of the result is a. */
static curve along(curve from, turn a, long double length)
{
  long double c = length * cosl(a.at);
  long double s = length * sinl(a.at);
  return (curve){
    {from.at[0] + c, from.at[1] + s, a.at},
    {from.d[0] - s * a.d, from.d[1] + c * a.d, a.d},
    {from.dd[0] - s * a.dd - c * a.d * a.d, from.dd[1] + c * a.dd - s * a.d * a.d, a.dd}};
}

/* Returns the same point with the angle 0. */
static curve level(curve p)
{
  p.at[2] = p.d[2] = p.dd[2] = 0;
  return p;
}

static turn rod_of_crank(const scene *s, long double x)
{
  long double rod = s->rod;
  if (rod == CRANK) {
    /* This branch of the motion is smooth where rod and crank coincide. */
    return (turn){-x, -1, 0};
  }
  turn a = {.at = -asinl(CRANK * sinl(x) / rod)};
  long double c = cosl(a.at);
  a.d = -CRANK * cosl(x) / (rod * c);
  a.dd = (CRANK * sinl(x) / rod + sinl(a.at) * a.d * a.d) / c;
  return a;
}

/* Solves crank e(x) + coupler e(a) = ground + rocker e(b) for the angles a and b. Here e(a) = (cos
 * a, sin a). */
static void close_four_bar(long double x, turn *a, turn *b)
{
  long double r[2] = {GROUND - CRANK * cosl(x), -CRANK * sinl(x)};
  long double square = r[0] * r[0] + r[1] * r[1];
  long double side = (COUPLER * COUPLER + square - ROCKER * ROCKER) / (2 * COUPLER * sqrtl(square));
  a->at = atan2l(r[1], r[0]) + acosl(side);
  b->at = atan2l(COUPLER * sinl(a->at) - r[1], COUPLER * cosl(a->at) - r[0]);
  long double ca = COUPLER * cosl(a->at);
  long double sa = COUPLER * sinl(a->at);
  long double cb = ROCKER * cosl(b->at);
  long double sb = ROCKER * sinl(b->at);
  /* The derivatives satisfy -sa a' + sb b' = f and ca a' - cb b' = g, with this determinant. */
  long double det = sa * cb - ca * sb;
  long double f = CRANK * sinl(x);
  long double g = -CRANK * cosl(x);
  a->d = (-cb * f - sb * g) / det;
  b->d = (-sa * g - ca * f) / det;
  f = CRANK * cosl(x) + ca * a->d * a->d - cb * b->d * b->d;
  g = CRANK * sinl(x) + sa * a->d * a->d - sb * b->d * b->d;
  a->dd = (-cb * f - sb * g) / det;
  b->dd = (-sa * g - ca * f) / det;
}

/* Returns the pose of a body. Bodies with even numbers are cranks, and the others are couplers. */
static curve pose_in_windows(int body, turn first)
{
  curve left = {{(long double)(body / 2)}, {0}, {0}};
  curve tip = along(left, first, CRANK);
  tip.at[0] += 0.5L;
  return body % 2 ? level(tip) : along(left, first, CRANK / 2);
}

/* Returns the pose of the sleigh, whose angular velocity W is constant. Its velocity along the
 * blade is 0 at the start and has the time derivative -g sin x. This velocity is therefore W (c + k
 * cos x) with k = g / W^2 and a constant c. The integral of the velocity is the position. The body
 * on the pin does not rotate. */
static curve pose_of_sleigh(const scene *s, int body, long double x)
{
  long double k = s->gravity / ((long double)s->rate * s->rate);
  long double c = -k * cosl(s->angle);
  long double along_ = c + k * cosl(x);
  curve p = {
    {c * sinl(x) + k * (x / 2 + sinl(2 * x) / 4), -c * cosl(x) + k * sinl(x) * sinl(x) / 2, x},
    {along_ * cosl(x), along_ * sinl(x), 1},
    {-along_ * sinl(x) - k * sinl(x) * cosl(x), along_ * cosl(x) - k * sinl(x) * sinl(x), 0}};
  return body == 0 ? p : level(p);
}

static curve pose_of(const scene *s, int body, long double x)
{
  const curve origin = {0};
  turn first = {x, 1, 0};
  curve tip = along(origin, first, CRANK);
  turn a = {0};
  turn b = {0};
  switch ((int)s->kind) {
  case SCENE_BOB: return tip;
  case SCENE_CRANK: a = rod_of_crank(s, x); break;
  case SCENE_FOUR_BAR:
    close_four_bar(x, &a, &b);
    if (body == 2) {
      return along((curve){{GROUND}, {0}, {0}}, b, ROCKER / 2);
    }
    break;
  case SCENE_WINDOWS: return pose_in_windows(body, first);
  case SCENE_SLEIGH: return pose_of_sleigh(s, body, x);
  case SCENE_CHAIN: return along(origin, first, (body + 0.5L) / s->count);
  default: break; /* a pendulum */
  }
  long double length = s->kind == SCENE_CRANK ? (long double)s->rod : COUPLER;
  return body == 0   ? along(origin, first, CRANK / 2)
         : body == 1 ? along(tip, a, length / 2)
                     : level(along(tip, a, length));
}

void scene_pose(const scene *s, int body, long double x, long double pose[SCENE_NUMBERS])
{
  if (s->kind > SCENE_CHAIN) {
    space_pose(s, body, x, pose);
    return;
  }
  curve p = pose_of(s, body, x);
  if (s->tilted) {
    space_tilt(p.at, pose);
  } else {
    memcpy(pose, p.at, sizeof p.at);
  }
}

double scene_distance(const scene *s, const long double *a, const long double *b, double scale)
{
  double most = 0.0;
  if (space_is(s)) {
    return space_distance(a, b, scale);
  }
  for (int i = 0; i < scene_width(s); i++) {
    double off = fabs((double)(a[i] - b[i])) / (i < 2 ? scale : 1.0);
    most = off > most || isnan(off) ? off : most;
  }
  return most;
}

/* ---- masses ---- */

static double length_of(const scene *s, int body)
{
  if (s->kind == SCENE_CRANK) {
    return body == 0 ? (double)CRANK : body == 1 ? s->rod : 0.1;
  }
  if (s->kind == SCENE_FOUR_BAR) {
    return (double)(body == 0 ? CRANK : body == 1 ? COUPLER : ROCKER);
  }
  return s->kind == SCENE_CHAIN ? 1.0 / s->count : 1.0;
}

static double mass_of(const scene *s, int body)
{
  double mass = s->kind == SCENE_CHAIN ? 1.0 / s->count : 1.0;
  bool last = s->kind == SCENE_WINDOWS ? body % 2 == 1 : body == scene_bodies(s) - 1;
  return last && s->kind != SCENE_PENDULUM ? mass * s->ratio : mass;
}

/* Returns the moment of inertia of a body. For a pendulum, which has only one body, `ratio` is its
 * moment of inertia divided by the moment of inertia of a uniform rod. */
static double inertia_of(const scene *s, int body)
{
  double length = length_of(s, body);
  double mass = mass_of(s, body);
  double ratio = s->kind == SCENE_PENDULUM ? s->ratio : 1.0;
  return s->kind == SCENE_BOB ? 0.0 : ratio * mass * length * length / 12.0;
}

/* ---- the equation ---- */

typedef struct sums {
  long double mass;
  long double force;
} sums;

static sums sum_body(const scene *s, int body, long double x, long double v)
{
  curve p = pose_of(s, body, x);
  long double m[3] = {mass_of(s, body), mass_of(s, body), inertia_of(s, body)};
  sums out = {0};
  for (int k = 0; k < 3; k++) {
    out.mass += m[k] * p.d[k] * p.d[k];
    out.force -= m[k] * p.d[k] * p.dd[k] * v * v;
  }
  out.force -= m[1] * s->gravity * p.d[1];
  return out;
}

static sums sum_bodies(const scene *s, long double x, long double v)
{
  sums all = {0};
  int kinds = s->kind == SCENE_WINDOWS ? 2 : scene_bodies(s);
  for (int k = 0; k < kinds; k++) {
    long double alike = s->kind == SCENE_WINDOWS ? s->count + (k == 0) : 1;
    sums one = sum_body(s, k, x, v);
    all.mass += alike * one.mass;
    all.force += alike * one.force;
  }
  return all;
}

long double scene_acceleration(const void *scene_, long double x, long double v)
{
  const scene *s = scene_;
  if (s->kind == SCENE_CHAIN || s->kind == SCENE_SLEIGH || s->driven) {
    return 0;
  }
  if (s->kind > SCENE_CHAIN) {
    return space_acceleration(s, x, v);
  }
  sums all = sum_bodies(s, x, v);
  all.force -= s->stiffness * (x - (s->angle - RELAXED)) + s->damping * v;
  return all.force / all.mass;
}

/* ---- building ---- */

static void draw(const scene *s, int body, double position[2], double velocity[2], double turn_[2])
{
  curve p = pose_of(s, body, s->angle);
  bool aside = s->violation != 0.0 && body == scene_bodies(s) - 1;
  for (int k = 0; k < 2; k++) {
    position[k] = (double)p.at[k] + (aside ? s->violation * (k == 0 ? 0.6 : 0.8) : 0.0);
    velocity[k] = aside || s->driven ? (double)NAN : (double)(p.d[k] * s->rate);
  }
  turn_[0] = (double)p.at[2];
  turn_[1] = aside || s->driven ? (double)NAN : (double)(p.d[2] * s->rate);
}

static baum_body_id add_body(baum_i_parts *parts, const scene *s, int body)
{
  double turn_[2];
  if (s->kind == SCENE_BOB) {
    baum_planar_particle_def bob = baum_planar_particle_def_default();
    draw(s, body, bob.position, bob.velocity, turn_);
    bob.mass = mass_of(s, body);
    return baum_i_parts_particle(parts, &bob);
  }
  baum_planar_body_def def = baum_planar_body_def_default();
  def.mass = mass_of(s, body);
  def.inertia = inertia_of(s, body);
  draw(s, body, def.position, def.velocity, turn_);
  def.angle = turn_[0];
  def.angular_velocity = turn_[1];
  def.held = body == 0 && scene_bodies(s) > 1 && !s->driven;
  return baum_i_parts_body(parts, &def);
}

static void add_rod(baum_i_parts *parts, baum_body_id bob, double length)
{
  baum_i_parts_rod(parts, NULL, (baum_i_spot){BAUM_GROUND, {0.0, 0.0}},
                   (baum_i_spot){bob, {0.0, 0.0}}, length);
}

static baum_joint_id pin(baum_i_parts *parts, baum_body_id a, double xa, baum_body_id b, double xb)
{
  return baum_i_parts_pin(parts, NULL, (baum_i_spot){a, {xa, 0.0}}, (baum_i_spot){b, {xb, 0.0}});
}

static void pin_crank(baum_i_parts *parts, const scene *s, const baum_body_id *b)
{
  pin(parts, b[0], 0.5, b[1], -s->rod / 2);
  pin(parts, b[1], s->rod / 2, b[2], 0.0);
  baum_i_parts_guide(parts, "guide", b[2], 0.0, 0.0);
  for (int k = 0; k < s->spare; k++) {
    baum_i_parts_guide(parts, NULL, b[2], (k + 1) * s->off, 0.1);
  }
}

/* Adds knife edges at the centre of the sleigh. Redundant edges are displaced along the blade. */
static void pin_sleigh(baum_i_parts *parts, const scene *s, const baum_body_id *b)
{
  pin(parts, b[0], 0.0, b[1], 0.0);
  for (int k = 0; k <= s->spare; k++) {
    baum_planar_knife_edge_def def = baum_planar_knife_edge_def_default();
    def.body_a = b[0];
    def.point_a[0] = k * s->off;
    def.point_a[1] = 0.0;
    BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_planar_knife_edge(parts->mechanism, &def, NULL));
  }
}

static void pin_four_bar(baum_i_parts *parts, const baum_body_id *b)
{
  pin(parts, b[0], 0.5, b[1], -(double)COUPLER / 2);
  pin(parts, BAUM_GROUND, (double)GROUND, b[2], -(double)ROCKER / 2);
  pin(parts, b[1], (double)COUPLER / 2, b[2], (double)ROCKER / 2);
}

/* Adds joints between body k and the body before it or ground. Returns the first pin of body k, if
 * it has one. */
static baum_joint_id hang(baum_i_parts *parts, const scene *s, baum_body_id before,
                          baum_body_id body, int k)
{
  baum_joint_id joint = {0};
  if (s->kind == SCENE_CHAIN) {
    return pin(parts, before, k == 0 ? 0.0 : 0.5 / s->count, body, -0.5 / s->count);
  }
  if (s->kind == SCENE_WINDOWS && k % 2 == 0) {
    joint = pin(parts, BAUM_GROUND, (double)(k / 2), body, -0.5);
    if (k > 0) {
      pin(parts, body, 0.5, before, 0.5);
    }
  } else if (s->kind == SCENE_WINDOWS) {
    pin(parts, before, 0.5, body, -0.5);
  } else if (s->kind == SCENE_BOB) {
    add_rod(parts, body, 1.0);
  } else if (k == 0 && s->kind != SCENE_SLEIGH) {
    joint = pin(parts, BAUM_GROUND, 0.0, body, -0.5);
  }
  return joint;
}

static double motor_offset(const scene *s)
{
  return s->angle - s->rate * s->start;
}

double scene_begin(const scene *s)
{
  return s->driven ? (double)(motor_offset(s) + (long double)s->rate * s->start) : s->angle;
}

static void drive(baum_i_parts *parts, const scene *s, baum_joint_id joint)
{
  baum_driver_def def = baum_driver_def_default();
  def.joint = joint;
  def.rate = s->rate;
  def.value = motor_offset(s);
  if (s->driven) {
    BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_driver(parts->mechanism, &def, NULL));
  }
}

static void add_spares(baum_i_parts *parts, const scene *s, baum_body_id body)
{
  for (int k = 0; k < s->spare; k++) {
    if (s->kind == SCENE_BOB) {
      add_rod(parts, body, 1.0 + (k + 1) * s->off);
    } else {
      pin(parts, BAUM_GROUND, (k + 1) * s->off, body, -0.5);
    }
  }
}

static void add_spring(baum_i_parts *parts, const scene *s, baum_body_id body)
{
  if ((s->stiffness == 0.0 && s->damping == 0.0) || parts->status != BAUM_OK) {
    return;
  }
  baum_planar_torsion_spring_def def = baum_planar_torsion_spring_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = body;
  def.stiffness = s->stiffness;
  def.damping = s->damping;
  def.free_angle = s->angle - RELAXED;
  parts->status = baum_mechanism_add_planar_torsion_spring(parts->mechanism, &def, NULL);
}

static baum_status build_planar(const scene *s, model *out)
{
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_parts_gravity(&parts, s->gravity);
  baum_body_id first[3] = {BAUM_GROUND, BAUM_GROUND, BAUM_GROUND};
  baum_joint_id root = {0};
  baum_body_id before = BAUM_GROUND;
  for (int k = 0; k < scene_bodies(s); k++) {
    baum_body_id body = add_body(&parts, s, k);
    baum_joint_id joint = hang(&parts, s, before, body, k);
    root = k == 0 ? joint : root;
    before = body;
    if (k < 3) {
      first[k] = body;
    }
  }
  if (s->kind == SCENE_CRANK) {
    pin_crank(&parts, s, first);
  } else if (s->kind == SCENE_SLEIGH) {
    pin_sleigh(&parts, s, first);
  } else if (s->kind == SCENE_FOUR_BAR) {
    pin_four_bar(&parts, first);
  }
  if (s->kind != SCENE_CRANK && s->kind != SCENE_SLEIGH) {
    add_spares(&parts, s, first[0]);
  }
  drive(&parts, s, root);
  add_spring(&parts, s, first[0]);
  bool si = s->units.length == 1.0 && s->units.mass == 1.0 && s->units.time == 1.0;
  return model_finish(&parts, si ? NULL : &s->units, out);
}

/* Replaces a model by its twin in a tilted plane. If the scene has a violation, the last body is
 * also moved off the plane. */
static baum_status tilt_model(const scene *s, model *m)
{
  baum_mechanism *tilted = NULL;
  baum_status status = model_tilt(m->mechanism, s->violation * s->units.length, &tilted);
  model_destroy(m);
  return status == BAUM_OK ? model_adopt(tilted, m) : status;
}

baum_status scene_build(const scene *s, model *out)
{
  if (s->kind > SCENE_CHAIN) {
    baum_mechanism *mechanism = NULL;
    *out = (model){.mechanism = NULL};
    baum_status status = space_build(s, &mechanism);
    return status == BAUM_OK ? model_adopt(mechanism, out) : status;
  }
  baum_status status = build_planar(s, out);
  return status == BAUM_OK && s->tilted ? tilt_model(s, out) : status;
}
