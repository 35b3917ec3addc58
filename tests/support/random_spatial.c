/* SPDX-License-Identifier: BSD-3-Clause */
#include "random_spatial.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"
#include "random_coordinates.h"
#include "random_definitions.h"
#include "random_further.h"
#include "rotation.h"

/* ---- bodies ---- */

/* Chooses the inertia tensor of an ellipsoid with random axes. One in six of these ellipsoids is
 * nearly a rod. */
static void choose_inertia(chance *c, double mass, double out[6])
{
  double square[3];
  double p[4];
  double a[9];
  bool rod = chance_below(c, 6) == 0;
  for (int i = 0; i < 3; i++) {
    double half = chance_decade(c, 0.1, 1.0) * (rod && i > 0 ? 1e-3 : 1.0);
    square[i] = 0.2 * half * half;
  }
  for (int i = 0; i < 4; i++) {
    p[i] = chance_number(c, -1.0, 1.0);
  }
  quaternion_normalize(p);
  rotation_matrix(p, a);
  static const int places[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  for (int n = 0; n < 6; n++) {
    out[n] = 0.0;
    for (int k = 0; k < 3; k++) {
      double moment = mass * (square[0] + square[1] + square[2] - square[k]);
      out[n] += a[3 * places[n][0] + k] * moment * a[3 * places[n][1] + k];
    }
  }
}

static void add_spatial_body(random_spatial *r, oracle_body *b)
{
  for (int i = 3; i < 7; i++) {
    b->q[i] = chance_number(&r->chance, -1.0, 1.0);
  }
  quaternion_normalize(b->q + 3);
  choose_inertia(&r->chance, b->mass, b->inertia);
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.mass = b->mass;
  memcpy(def.inertia, b->inertia, sizeof def.inertia);
  memcpy(def.position, b->q, sizeof def.position);
  memcpy(def.orientation, b->q + 3, sizeof def.orientation);
  check(baum_mechanism_add_spatial_body(r->mechanism, &def, &b->id));
}

static void add_spatial_particle(random_spatial *r, oracle_body *b)
{
  baum_spatial_particle_def def = baum_spatial_particle_def_default();
  def.mass = b->mass;
  memcpy(def.position, b->q, sizeof def.position);
  check(baum_mechanism_add_spatial_particle(r->mechanism, &def, &b->id));
}

static void add_planar_body(random_spatial *r, oracle_body *b)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  b->inertia[2] = b->mass * chance_decade(&r->chance, 0.05, 1.0);
  def.mass = b->mass;
  def.inertia = b->inertia[2];
  memcpy(def.position, b->q, sizeof def.position);
  def.angle = b->q[2];
  check(baum_mechanism_add_planar_body(r->mechanism, &def, &b->id));
}

static void add_planar_particle(random_spatial *r, oracle_body *b)
{
  baum_planar_particle_def def = baum_planar_particle_def_default();
  def.mass = b->mass;
  memcpy(def.position, b->q, sizeof def.position);
  check(baum_mechanism_add_planar_particle(r->mechanism, &def, &b->id));
}

void random_spatial_add_body(random_spatial *r, bool particle, bool planar)
{
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  oracle_body *b = &o->bodies[o->body_count++];
  b->first_q = o->nq;
  b->first_v = o->nv;
  b->mass = chance_decade(c, 1.0 / r->span, r->span);
  random_vector(c, 2.0, b->q);
  if (particle) {
    b->kind = planar ? 'o' : 'p';
    b->nv = b->nq = planar ? 2 : 3;
    (planar ? add_planar_particle : add_spatial_particle)(r, b);
  } else {
    b->kind = planar ? 'b' : 's';
    b->nv = planar ? 3 : 6;
    b->nq = planar ? 3 : 7;
    (planar ? add_planar_body : add_spatial_body)(r, b);
  }
  o->nq += b->nq;
  o->nv += b->nv;
}

/* ---- definitions of joints ---- */

/* Adds a joint of the kind NAME. The first SIZE bytes of its definition are the same as in the
 * definition of a revolute joint. They are copied from `given`. */
#define ADD(NAME, SIZE)                                                       \
  {                                                                           \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default();      \
    size_t head = offsetof(baum_spatial_##NAME##_def, body_a);                \
    memcpy((char *)&def + head, (const char *)given + head, (SIZE)-head);     \
    check(baum_mechanism_add_spatial_##NAME(r->mechanism, &def, &joint->id)); \
  }

static void add_screw(random_spatial *r, const baum_spatial_revolute_def *given,
                      oracle_joint *joint)
{
  baum_spatial_screw_def def = baum_spatial_screw_def_default();
  size_t head = offsetof(baum_spatial_screw_def, body_a);
  memcpy((char *)&def + head, (const char *)given + head,
         offsetof(baum_spatial_screw_def, pitch) - head);
  def.pitch = chance_number(&r->chance, 0.2, 2.0) * (chance_below(&r->chance, 2) == 0 ? 1.0 : -1.0);
  joint->pitch = def.pitch;
  joint->offset = oracle_design_coordinate(&r->oracle, joint, 0);
  check(baum_mechanism_add_spatial_screw(r->mechanism, &def, &joint->id));
}

/* Adds a planar joint. Its x axis is the x axis of the oracle's joint. */
static void add_planar(random_spatial *r, const baum_spatial_revolute_def *given,
                       oracle_joint *joint)
{
  wide x[3];
  baum_spatial_planar_def def = baum_spatial_planar_def_default();
  size_t head = offsetof(baum_spatial_planar_def, body_a);
  memcpy((char *)&def + head, (const char *)given + head,
         offsetof(baum_spatial_planar_def, x_axis) - head);
  memcpy(x, joint->axes[0], sizeof x);
  if (!isnan(given->point[0])) {
    oracle_axis_to_ground(&r->oracle.bodies[joint->a], joint->axes[0], x);
  }
  wide_to_double(x, def.x_axis);
  check(baum_mechanism_add_spatial_planar(r->mechanism, &def, &joint->id));
}

static void add_defined(random_spatial *r, const baum_spatial_revolute_def *given,
                        oracle_joint *joint)
{
  switch ((int)joint->kind) {
  case ORACLE_SPHERICAL: ADD(spherical, sizeof def) break;
  case ORACLE_REVOLUTE: ADD(revolute, sizeof def) break;
  case ORACLE_UNIVERSAL: ADD(universal, sizeof def) break;
  case ORACLE_CYLINDRICAL: ADD(cylindrical, sizeof def) break;
  case ORACLE_PRISMATIC: ADD(prismatic, sizeof def) break;
  case ORACLE_PLANAR: add_planar(r, given, joint); break;
  case ORACLE_FIXED: ADD(fixed, sizeof def) break;
  case ORACLE_DISTANCE: ADD(distance, offsetof(baum_spatial_distance_def, length)) break;
  case ORACLE_ON_LINE: ADD(point_on_line, sizeof def) break;
  case ORACLE_SCREW: add_screw(r, given, joint); break;
  case ORACLE_CONSTANT_VELOCITY: ADD(constant_velocity, sizeof def) break;
  default: ADD(point_on_plane, sizeof def) break;
  }
}

/* ---- points and axes of joints ---- */

static void choose_axis(random_spatial *r, const double point[3], bool in_plane, double axis[3])
{
  chance *c = &r->chance;
  random_vector(c, 1.0, axis);
  if (r->axes == RANDOM_PARALLEL) {
    memcpy(axis, r->direction, sizeof r->direction);
  } else if (r->axes == RANDOM_CONCURRENT) {
    for (int i = 0; i < 3; i++) {
      axis[i] = point[i] - r->direction[i];
    }
  } else if (in_plane && chance_below(c, 3) > 0) {
    axis[0] = axis[1] = 0.0;
    axis[2] = chance_below(c, 2) == 0 ? 1.0 : -1.0;
  }
}

/* Chooses the vector from body_a's point to body_b's point, in a direction that the joint
 * permits. */
static void choose_apart(chance *c, oracle_kind kind, const double axis[3], double apart[3])
{
  double beside[3];
  double away[3];
  double slide = chance_number(c, -1.0, 1.0);
  random_vector(c, 1.0, beside);
  cross(axis, beside, away);
  for (int i = 0; i < 3; i++) {
    bool along = kind == ORACLE_CYLINDRICAL || kind == ORACLE_PRISMATIC || kind == ORACLE_ON_LINE ||
                 kind == ORACLE_SCREW;
    bool across = kind == ORACLE_PLANAR || kind == ORACLE_ON_PLANE;
    apart[i] = along ? slide * axis[i] : across ? slide * away[i] : 0.0;
  }
}

static void position_of(const oracle_body *body, double out[3])
{
  static const wide centre[3] = {0};
  wide p[3];
  oracle_to_ground(body, centre, p);
  wide_to_double(p, out);
}

static void choose_point(random_spatial *r, oracle_kind kind, int a, int b, double point[3])
{
  const oracle_body *bodies = r->oracle.bodies;
  double away[3];
  int near = chance_below(&r->chance, 2) == 0 ? a : b;
  near = random_turns(&bodies[b]) ? near : b;
  near = kind == ORACLE_SPHERICAL && !random_turns(&bodies[a]) ? a : near;
  position_of(&bodies[near], point);
  random_vector(&r->chance, random_turns(&bodies[near]) ? 1.0 : 0.0, away);
  for (int i = 0; i < 3; i++) {
    point[i] += away[i];
  }
}

/* Defines a rod between two random points. */
static void define_rod(random_spatial *r, oracle_joint *joint, baum_spatial_revolute_def *def)
{
  static const wide z[3] = {0, 0, 1};
  double *const ends[2] = {def->point_a, def->point_b};
  const int bodies[2] = {joint->a, joint->b};
  wide p[2][3];
  for (int k = 0; k < 2; k++) {
    const oracle_body *body = &r->oracle.bodies[bodies[k]];
    wide s[3];
    random_vector(&r->chance, random_turns(body) ? 1.0 : 0.0, ends[k]);
    wide_from_double(ends[k], s);
    oracle_to_ground(body, s, p[k]);
  }
  oracle_place(&r->oracle, joint, p[0], p[1], z);
}

oracle_joint *random_spatial_next_joint(random_spatial *r, oracle_kind kind, int a, int b)
{
  oracle_joint *joint = &r->oracle.joints[r->oracle.joint_count++];
  *joint = (oracle_joint){.kind = kind, .a = a, .b = b};
  return joint;
}

static void add_joint_at(random_spatial *r, oracle_kind kind, const int bodies[2],
                         const double point[3], const double axis[3])
{
  chance *c = &r->chance;
  oracle_joint *joint = random_spatial_next_joint(r, kind, bodies[0], bodies[1]);
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  def.body_a = r->oracle.bodies[bodies[0]].id;
  def.body_b = r->oracle.bodies[bodies[1]].id;
  if (kind == ORACLE_DISTANCE) {
    define_rod(r, joint, &def);
  } else if (chance_below(c, 2) == 0) {
    random_define_at_point(r, point, axis, joint, &def);
  } else {
    double apart[3];
    choose_apart(c, kind, axis, apart);
    random_define_on_bodies(r, point, axis, apart, joint, &def);
  }
  add_defined(r, &def, joint);
}

/* Chooses a kind of joint that both bodies support. Two thirds of the joints that close loops have
 * few rows. */
static oracle_kind choose_kind(random_spatial *r, int a, int b, bool loop)
{
  static const oracle_kind few[] = {ORACLE_SPHERICAL, ORACLE_UNIVERSAL, ORACLE_PLANAR,
                                    ORACLE_DISTANCE,  ORACLE_ON_LINE,   ORACLE_ON_PLANE};
  static const oracle_kind point[] = {ORACLE_DISTANCE, ORACLE_SPHERICAL, ORACLE_ON_LINE,
                                      ORACLE_ON_PLANE};
  chance *c = &r->chance;
  if (!random_turns(&r->oracle.bodies[b])) {
    return random_turns(&r->oracle.bodies[a]) ? point[chance_below(c, 4)] : ORACLE_DISTANCE;
  }
  if (!random_turns(&r->oracle.bodies[a])) {
    return point[chance_below(c, 2)];
  }
  if (r->axes != RANDOM_ANY) {
    return chance_below(c, 5) == 0 ? (oracle_kind)chance_below(c, ORACLE_BASIC_KINDS)
                                   : ORACLE_REVOLUTE;
  }
  return loop && chance_below(c, 3) > 0 ? few[chance_below(c, 6)]
                                        : (oracle_kind)chance_below(c, ORACLE_BASIC_KINDS);
}

void random_spatial_add_joint(random_spatial *r, oracle_kind kind, int a, int b)
{
  const int bodies[2] = {a, b};
  double point[3];
  double axis[3];
  choose_point(r, kind, a, b, point);
  choose_axis(r, point, false, axis);
  add_joint_at(r, kind, bodies, point, axis);
}

/* Adds a joint. Of the joints between bodies with orientations, one in twelve is added a second
 * time, with exchanged bodies or at another point of its axis. This makes rows redundant. */
static void add_joint(random_spatial *r, int one, int other, bool loop)
{
  chance *c = &r->chance;
  bool swap = chance_below(c, 2) == 0;
  int bodies[2] = {swap ? other : one, swap ? one : other};
  oracle_kind kind = choose_kind(r, bodies[0], bodies[1], loop);
  double point[3];
  double axis[3];
  bool planar =
    random_is_planar(&r->oracle.bodies[one]) || random_is_planar(&r->oracle.bodies[other]);
  choose_point(r, kind, bodies[0], bodies[1], point);
  choose_axis(r, point, planar, axis);
  add_joint_at(r, kind, bodies, point, axis);
  bool both_turn = random_turns(&r->oracle.bodies[one]) && random_turns(&r->oracle.bodies[other]);
  if (both_turn && chance_below(c, 12) == 0) {
    double slide = chance_below(c, 2) == 0 ? 0.0 : 0.5;
    for (int i = 0; i < 3; i++) {
      point[i] += slide * axis[i];
    }
    const int again[2] = {bodies[slide == 0.0 ? 1 : 0], bodies[slide == 0.0 ? 0 : 1]};
    add_joint_at(r, kind, again, point, axis);
  }
}

/* ---- forces ---- */

static void add_spring(random_spatial *r)
{
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  int a = chance_below(c, o->body_count);
  int b = chance_below(c, o->body_count);
  if (a == b) {
    return;
  }
  oracle_force *f = &o->forces[o->force_count++];
  *f = (oracle_force){.kind = ORACLE_SPRING, .a = a, .b = b};
  random_vector(c, random_turns(&o->bodies[a]) ? 1.0 : 0.0, f->s[0]);
  random_vector(c, random_turns(&o->bodies[b]) ? 1.0 : 0.0, f->s[1]);
  f->stiffness = chance_decade(c, 1.0, 100.0);
  f->damping = chance_below(c, 2) == 0 ? 0.0 : chance_decade(c, 0.01, 10.0);
  double free_length = chance_number(c, 0.0, 2.0);
  f->free_length = free_length;
  baum_spatial_spring_def def = baum_spatial_spring_def_default();
  def.body_a = o->bodies[a].id;
  def.body_b = o->bodies[b].id;
  memcpy(def.point_a, f->s[0], sizeof def.point_a);
  memcpy(def.point_b, f->s[1], sizeof def.point_b);
  def.stiffness = f->stiffness;
  def.damping = f->damping;
  def.free_length = free_length;
  check(baum_mechanism_add_spatial_spring(r->mechanism, &def, NULL));
}

static void add_load(random_spatial *r)
{
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  int b = 1 + chance_below(c, o->body_count - 1);
  oracle_force *f = &o->forces[o->force_count++];
  *f = (oracle_force){.b = b};
  bool body = random_turns(&o->bodies[b]);
  random_vector(c, body ? 1.0 : 0.0, f->s[1]);
  random_vector(c, 5.0, f->force);
  random_vector(c, body ? 2.0 : 0.0, f->moment);
  f->follows_body = body && chance_below(c, 2) == 0;
  baum_spatial_load_def def = baum_spatial_load_def_default();
  def.body = o->bodies[b].id;
  memcpy(def.point, f->s[1], sizeof def.point);
  memcpy(def.force, f->force, sizeof def.force);
  memcpy(def.moment, f->moment, sizeof def.moment);
  def.follows_body = f->follows_body;
  check(baum_mechanism_add_spatial_load(r->mechanism, &def, NULL));
}

/* ---- all ---- */

static void choose_all(random_spatial *r)
{
  chance *c = &r->chance;
  int spread = chance_below(c, 20);
  r->span = chance_decade(c, 1.0, spread == 0 ? 1e6 : spread < 6 ? 1e3 : 3.0);
  r->particles = chance_below(c, 3) == 0 ? chance_below(c, 60) : 0;
  r->planar = chance_below(c, 3) == 0 ? chance_below(c, 60) : 0;
  int special = chance_below(c, 12);
  r->axes = special == 0 ? RANDOM_PARALLEL : special == 1 ? RANDOM_CONCURRENT : RANDOM_ANY;
  random_vector(c, 1.0, r->direction);
  r->start = chance_number(c, 0.0, 1.0);
  random_vector(c, 10.0, r->oracle.gravity);
}

static void add_joints(random_spatial *r)
{
  chance *c = &r->chance;
  int bodies = r->oracle.body_count;
  for (int k = 1; k < bodies; k++) {
    if (chance_below(c, 10) > 0) {
      add_joint(r, chance_below(c, k), k, false);
    }
  }
  int loops = chance_below(c, 2) == 0 ? 0 : chance_below(c, 2 + bodies / 2);
  for (int k = 0; k < loops; k++) {
    int a = chance_below(c, bodies);
    int b = chance_below(c, bodies);
    if (a != b) {
      add_joint(r, a, b, true);
    }
  }
  if (chance_below(c, 4) == 0) {
    random_spatial_add_driver(r);
  }
}

void random_spatial_make(random_spatial *out, uint64_t seed, bool further)
{
  enum { MOST_BODIES = 8, MOST_FORCES = 4 };
  memset(out, 0, sizeof *out);
  chance *c = &out->chance;
  *c = chance_of(seed);
  choose_all(out);
  out->mechanism = create_mechanism();
  const double *g = out->oracle.gravity;
  check(baum_mechanism_set_gravity(out->mechanism, g[0], g[1], g[2]));
  out->oracle.body_count = 1;
  out->oracle.bodies[0] = (oracle_body){.id = BAUM_GROUND, .kind = 'g'};
  int bodies = 1 + chance_below(c, MOST_BODIES);
  for (int k = 0; k < bodies; k++) {
    bool particle = chance_below(c, 100) < out->particles;
    bool planar = chance_below(c, 100) < out->planar;
    random_spatial_add_body(out, particle, planar);
  }
  add_joints(out);
  for (int k = chance_below(c, MOST_FORCES); k > 0; k--) {
    add_load(out);
  }
  for (int k = chance_below(c, MOST_FORCES); k > 0; k--) {
    add_spring(out);
  }
  for (int k = chance_below(c, 3); k > 0; k--) {
    random_spatial_add_joint_spring(out);
  }
  if (further) {
    random_spatial_add_further(out);
  }
  check(baum_mechanism_freeze(out->mechanism));
}

void random_spatial_destroy(random_spatial *out)
{
  baum_mechanism_destroy(out->mechanism);
  out->mechanism = NULL;
}
