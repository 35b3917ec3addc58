/* SPDX-License-Identifier: BSD-3-Clause */
#include "random_further.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "oracle_motion.h"
#include "random_coordinates.h"
#include "random_definitions.h"
#include "rotation.h"

/* Returns a random body that has an orientation, or ground. If `planar` is true, the body is planar
 * or ground. */
static int choose_turning(random_spatial *r, bool planar)
{
  const spatial_oracle *o = &r->oracle;
  int k = chance_below(&r->chance, o->body_count);
  const oracle_body *b = &o->bodies[k];
  return random_turns(b) && (!planar || b->kind == 'b') ? k : 0;
}

/* ---- rolling discs and knife edges ---- */

/* Adds a rolling disc. On body b, at a random position, it is a wheel with a sharp or a round rim,
 * or a sphere. The plane on body a is chosen so that it touches the wheel or the sphere. */
static void add_disc(random_spatial *r, int a, int b)
{
  static const wide x[3] = {1, 0, 0};
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  oracle_joint *joint = random_spatial_next_joint(r, ORACLE_ROLLING_DISC, a, b);
  baum_spatial_rolling_disc_def def = baum_spatial_rolling_disc_def_default();
  wide k[3];
  wide s[3];
  motion bodies[ORACLE_BODIES];
  jet point[3];
  def.body_a = o->bodies[a].id;
  def.body_b = o->bodies[b].id;
  int rim = chance_below(c, 3);
  def.radius = chance_number(c, 0.2, 1.0);
  def.rim_radius = rim == 0 ? 0.0 : rim == 1 ? def.radius : chance_number(c, 0.1, 0.9) * def.radius;
  random_vector(c, 0.5, def.centre);
  random_vector(c, 1.0, def.normal);
  wide_from_double(def.normal, s);
  oracle_axis_to_ground(&o->bodies[a], s, k);
  oracle_place(o, joint, x, x, k);
  /* The axis of the disc is inclined by less than pi / 3 to a direction in the plane. */
  for (int i = 0; i < 3; i++) {
    s[i] = joint->axes[0][i] + chance_number(c, -1.2, 1.2) * joint->axes[0][6 + i];
  }
  oracle_axis_to_ground(&o->bodies[a], s, k);
  oracle_axis_to_body(&o->bodies[b], k, s);
  wide_to_double(s, def.axis_b);
  wide_from_double(def.axis_b, joint->axes[1] + 6);
  wide length = wide_root(dot3(joint->axes[1] + 6, joint->axes[1] + 6));
  for (int i = 0; i < 3; i++) {
    joint->axes[1][6 + i] /= length;
  }
  wide_from_double(def.centre, joint->s[1]);
  joint->radius = def.radius;
  joint->rim = def.rim_radius;
  oracle_design_motions(o, bodies);
  oracle_contact_point(joint, bodies, point);
  const wide at[3] = {point[0].d[0], point[1].d[0], point[2].d[0]};
  oracle_to_body(&o->bodies[a], at, s);
  wide_to_double(s, def.point_a);
  wide_from_double(def.point_a, joint->s[0]);
  check(baum_mechanism_add_spatial_rolling_disc(r->mechanism, &def, &joint->id));
}

static void add_edge(random_spatial *r, int a, int b)
{
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  oracle_joint *joint = random_spatial_next_joint(r, ORACLE_KNIFE_EDGE, a, b);
  baum_planar_knife_edge_def def = baum_planar_knife_edge_def_default();
  double angle = chance_number(c, 0.0, 6.0);
  def.body_a = o->bodies[a].id;
  def.body_b = o->bodies[b].id;
  def.axis[0] = cos(angle);
  def.axis[1] = sin(angle);
  wide length = wide_root((wide)def.axis[0] * def.axis[0] + (wide)def.axis[1] * def.axis[1]);
  for (int i = 0; i < 2; i++) {
    def.point_a[i] = chance_number(c, -1.0, 1.0);
    joint->s[0][i] = def.point_a[i];
    joint->axes[0][i] = def.axis[i] / length;
  }
  joint->axes[0][3] = -joint->axes[0][1];
  joint->axes[0][4] = joint->axes[0][0];
  check(baum_mechanism_add_planar_knife_edge(r->mechanism, &def, &joint->id));
}

/* ---- bodies and loops ---- */

/* Adds a screw, a constant-velocity joint or a rolling disc between two bodies with
 * orientations. */
static void add_pair(random_spatial *r, int a, int b)
{
  int kind = chance_below(&r->chance, 4);
  if (kind == 0) {
    random_spatial_add_joint(r, ORACLE_SCREW, a, b);
  } else if (kind == 1) {
    random_spatial_add_joint(r, ORACLE_CONSTANT_VELOCITY, a, b);
  } else {
    add_disc(r, a, b);
  }
}

static void add_body(random_spatial *r)
{
  bool planar = chance_below(&r->chance, 4) == 0;
  int other = choose_turning(r, planar);
  bool swap = chance_below(&r->chance, 2) == 0 && other > 0;
  random_spatial_add_body(r, false, planar);
  int added = r->oracle.body_count - 1;
  if (planar) {
    add_edge(r, swap ? other : added, swap ? added : other);
  } else {
    add_pair(r, swap ? added : other, swap ? other : added);
  }
}

static void add_loop(random_spatial *r)
{
  bool planar = chance_below(&r->chance, 4) == 0;
  int a = choose_turning(r, planar);
  int b = choose_turning(r, planar);
  if (a != b && planar) {
    add_edge(r, a, b);
  } else if (a != b) {
    add_pair(r, a, b);
  }
}

/* ---- user constraints ---- */

static int user_jacobian(double t, const double *q, double *out, void *data)
{
  (void)t;
  const oracle_user *user = data;
  for (int i = 0; i < user->rows; i++) {
    for (int j = 0; j < user->columns; j++) {
      out[i * user->columns + j] = user->linear[i][j] + user->slope[i][j] * q[0];
    }
  }
  return 0;
}

static int user_nu(double t, const double *q, double *out, void *data)
{
  (void)q;
  const oracle_user *user = data;
  for (int i = 0; i < user->rows; i++) {
    out[i] = user->nu[i] * cos(t);
  }
  return 0;
}

static int user_gamma(double t, const double *q, const double *v, double *out, void *data)
{
  (void)q;
  const oracle_user *user = data;
  for (int i = 0; i < user->rows; i++) {
    out[i] = -user->nu[i] * sin(t);
    for (int j = 0; j < user->columns; j++) {
      out[i] -= user->slope[i][j] * v[0] * v[j];
    }
  }
  return 0;
}

static void add_user_rows(random_spatial *r)
{
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  const int bodies[2] = {1 + chance_below(c, o->body_count - 1),
                         1 + chance_below(c, o->body_count - 1)};
  oracle_joint *joint = random_spatial_next_joint(r, ORACLE_USER, 0, 0);
  oracle_user *user = &joint->user;
  baum_user_constraint_def def = baum_user_constraint_def_default();
  baum_body_id ids[2];
  for (int k = 0; k < 2 && (k == 0 || bodies[1] != bodies[0]); k++) {
    user->members[user->member_count++] = bodies[k];
    user->columns += o->bodies[bodies[k]].nv;
    ids[def.body_count++] = o->bodies[bodies[k]].id;
  }
  user->rows = 1 + chance_below(c, ORACLE_USER_ROWS);
  for (int i = 0; i < user->rows; i++) {
    user->nu[i] = chance_below(c, 2) == 0 ? 0.0 : chance_number(c, -1.0, 1.0);
    for (int j = 0; j < user->columns; j++) {
      user->linear[i][j] = chance_below(c, 4) == 0 ? 0.0 : chance_number(c, -1.0, 1.0);
      user->slope[i][j] = chance_below(c, 2) == 0 ? 0.0 : chance_number(c, -0.5, 0.5);
    }
  }
  def.bodies = ids;
  def.row_count = user->rows;
  def.jacobian = user_jacobian;
  def.nu = user_nu;
  def.gamma = user_gamma;
  def.velocity_level = true;
  def.user = user;
  check(baum_mechanism_add_user_constraint(r->mechanism, &def, &joint->id));
}

/* ---- forces ---- */

/* Chooses two bodies, and the points and axes of a force between them. Returns false if the bodies
 * are the same. */
static bool define_frame(random_spatial *r, oracle_joint *frame, baum_spatial_revolute_def *def)
{
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  double point[3];
  double axis[3];
  double apart[3];
  *frame = (oracle_joint){.kind = ORACLE_CONSTANT_VELOCITY};
  frame->a = choose_turning(r, false);
  frame->b = choose_turning(r, false);
  *def = baum_spatial_revolute_def_default();
  def->body_a = o->bodies[frame->a].id;
  def->body_b = o->bodies[frame->b].id;
  random_vector(c, 1.0, point);
  random_vector(c, 1.0, axis);
  random_vector(c, 0.5, apart);
  if (frame->a == frame->b) {
    return false;
  }
  if (chance_below(c, 2) == 0) {
    random_define_at_point(r, point, axis, frame, def);
  } else {
    random_define_on_bodies(r, point, axis, apart, frame, def);
  }
  return true;
}

/* Copies the members that the definitions of all elements with one axis share. */
#define COPY_HEAD(TYPE, DEF, FROM, END)                                       \
  memcpy((char *)&(DEF) + offsetof(TYPE, body_a),                             \
         (const char *)&(FROM) + offsetof(baum_spatial_revolute_def, body_a), \
         offsetof(TYPE, END) - offsetof(TYPE, body_a))

static void add_torsion_spring(random_spatial *r)
{
  chance *c = &r->chance;
  oracle_force f = {.kind = ORACLE_TORSION_SPRING};
  baum_spatial_revolute_def given;
  baum_spatial_torsion_spring_def def = baum_spatial_torsion_spring_def_default();
  if (!define_frame(r, &f.frame, &given)) {
    return;
  }
  COPY_HEAD(baum_spatial_torsion_spring_def, def, given, stiffness);
  def.free_angle = chance_number(c, -1.0, 1.0);
  f.free_length = def.free_angle;
  f.stiffness = def.stiffness = chance_decade(c, 1.0, 100.0);
  f.damping = def.damping = chance_below(c, 2) == 0 ? 0.0 : chance_decade(c, 0.01, 10.0);
  r->oracle.forces[r->oracle.force_count++] = f;
  check(baum_mechanism_add_spatial_torsion_spring(r->mechanism, &def, NULL));
}

/* Chooses a positive definite matrix. */
static void choose_matrix(chance *c, double size, double out[36])
{
  double factor[6][6] = {{0.0}};
  for (int i = 0; i < 6; i++) {
    for (int j = 0; j <= i; j++) {
      factor[i][j] = chance_number(c, -0.5, 0.5) + (i == j ? 1.0 : 0.0);
    }
  }
  for (int i = 0; i < 6; i++) {
    for (int j = 0; j < 6; j++) {
      double sum = 0.0;
      for (int k = 0; k < 6; k++) {
        sum += factor[i][k] * factor[j][k];
      }
      out[6 * i + j] = size * sum;
    }
  }
}

static void add_bushing(random_spatial *r)
{
  chance *c = &r->chance;
  oracle_force f = {.kind = ORACLE_BUSHING};
  baum_spatial_revolute_def given;
  baum_spatial_bushing_def def = baum_spatial_bushing_def_default();
  wide x[3];
  if (!define_frame(r, &f.frame, &given)) {
    return;
  }
  COPY_HEAD(baum_spatial_bushing_def, def, given, x_axis);
  memcpy(x, f.frame.axes[0], sizeof x);
  if (!isnan(given.point[0])) {
    oracle_axis_to_ground(&r->oracle.bodies[f.frame.a], f.frame.axes[0], x);
  }
  wide_to_double(x, def.x_axis);
  choose_matrix(c, chance_decade(c, 1.0, 100.0), def.stiffness);
  if (chance_below(c, 2) == 0) {
    choose_matrix(c, chance_decade(c, 0.01, 10.0), def.damping);
  }
  memcpy(f.stiffness_of_6, def.stiffness, sizeof def.stiffness);
  memcpy(f.damping_of_6, def.damping, sizeof def.damping);
  r->oracle.forces[r->oracle.force_count++] = f;
  check(baum_mechanism_add_spatial_bushing(r->mechanism, &def, NULL));
}

/* ---- spatial knife edges ---- */

/* One edge in six is added twice. */
static void add_spatial_edge(random_spatial *r)
{
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  int a = choose_turning(r, false);
  int b = choose_turning(r, false);
  double given[2][3];
  random_vector(c, 1.0, given[0]);
  random_vector(c, 1.0, given[1]);
  bool in_ground = chance_below(c, 2) == 0;
  for (int k = chance_below(c, 6) == 0 ? 2 : 1; k > 0 && a != b; k--) {
    oracle_joint *joint = random_spatial_next_joint(r, ORACLE_SPATIAL_EDGE, a, b);
    baum_spatial_knife_edge_def def = baum_spatial_knife_edge_def_default();
    wide point[3];
    wide axis[3];
    def.body_a = o->bodies[a].id;
    def.body_b = o->bodies[b].id;
    memcpy(in_ground ? def.point : def.point_a, given[0], sizeof given[0]);
    memcpy(def.axis, given[1], sizeof given[1]);
    wide_from_double(given[0], point);
    wide_from_double(given[1], axis);
    wide length = wide_root(dot3(axis, axis));
    for (int i = 0; i < 3; i++) {
      axis[i] /= length;
    }
    memcpy(joint->s[0], point, sizeof point);
    memcpy(joint->axes[0] + 3, axis, sizeof axis);
    if (in_ground) {
      oracle_to_body(&o->bodies[a], point, joint->s[0]);
      oracle_axis_to_body(&o->bodies[a], axis, joint->axes[0] + 3);
    }
    check(baum_mechanism_add_spatial_knife_edge(r->mechanism, &def, &joint->id));
  }
}

/* ---- curves ---- */

/* Computes F or G, its three first derivatives with respect to y, and its second derivatives
 * d^2/dy_1^2, d^2/dy_2^2 and d^2/dy_3^2. All mixed derivatives are 0. */
static void curve_of(const oracle_curve *u, int row, const double y[3], double out[7])
{
  const double r = u->r;
  const double cosine = cos(y[2] / u->c);
  const double sine = sin(y[2] / u->c);
  const double helix[2][7] = {
    {y[0] - r * cosine, 1.0, 0.0, r * sine / u->c, 0.0, 0.0, r * cosine / (u->c * u->c)},
    {y[1] - r * sine, 0.0, 1.0, -r * cosine / u->c, 0.0, 0.0, r * sine / (u->c * u->c)}};
  const double circle[2][7] = {{(y[0] * y[0] + y[1] * y[1] - r * r) / (2.0 * r), y[0] / r, y[1] / r,
                                0.0, 1.0 / r, 1.0 / r, 0.0},
                               {y[2], 0.0, 0.0, 1.0}};
  const double parabola[2][7] = {{y[1] - 0.5 * r * y[0] * y[0], -r * y[0], 1.0, 0.0, -r},
                                 {y[2] - u->c * y[0], -u->c, 0.0, 1.0}};
  memcpy(out,
         u->kind == ORACLE_HELIX    ? helix[row]
         : u->kind == ORACLE_CIRCLE ? circle[row]
                                    : parabola[row],
         sizeof helix[row]);
}

static int curve(const double xyz[3], double out[20], void *data)
{
  const oracle_curve *u = data;
  double y[3];
  for (int i = 0; i < 3; i++) {
    const double *turn = u->turn + (ptrdiff_t)3 * i;
    y[i] = u->shift[i] + turn[0] * xyz[0] + turn[1] * xyz[1] + turn[2] * xyz[2];
  }
  for (int row = 0; row < 2; row++) {
    double f[7];
    double *second = out + 10 * row + 4;
    curve_of(u, row, y, f);
    out[10 * row] = f[0];
    for (int i = 0; i < 3; i++) {
      for (int k = 0; k < 3; k++) {
        out[10 * row + 1 + i] += f[1 + k] * u->turn[3 * k + i];
      }
      for (int j = i; j < 3; j++, second++) {
        for (int k = 0; k < 3; k++) {
          *second += f[4 + k] * u->turn[3 * k + i] * u->turn[3 * k + j];
        }
      }
    }
  }
  return 0;
}

/* Chooses a curve, and a point y of it. */
static void choose_curve(chance *c, oracle_curve *u, double y[3])
{
  double p[4];
  const double along = chance_number(c, -1.0, 1.0);
  u->kind = chance_below(c, ORACLE_CURVES);
  u->r = chance_number(c, 0.3, 1.0);
  u->c = chance_number(c, 0.3, 1.0);
  for (int i = 0; i < 4; i++) {
    p[i] = chance_number(c, -1.0, 1.0);
  }
  quaternion_normalize(p);
  rotation_matrix(p, u->turn);
  if (u->kind == ORACLE_PARABOLA) {
    y[0] = along;
    y[1] = 0.5 * u->r * along * along;
    y[2] = u->c * along;
    return;
  }
  y[0] = u->r * cos(along / u->c);
  y[1] = u->r * sin(along / u->c);
  y[2] = u->kind == ORACLE_HELIX ? along : 0.0;
}

/* Puts a point of body b on a curve that is fixed on body a. In half of all cases, body_a's point
 * is the same point. In the other cases, the vector from body_a's point to the point of body b is
 * random. */
static void add_curve(random_spatial *r, int a, int b)
{
  static const wide z[3] = {0, 0, 1};
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  oracle_joint *joint = random_spatial_next_joint(r, ORACLE_CURVE, a, b);
  oracle_curve *u = &joint->curve;
  baum_spatial_curve_def def = baum_spatial_curve_def_default();
  bool in_ground = chance_below(c, 2) == 0;
  double y[3];
  double apart[3] = {0.0};
  wide point[3];
  choose_curve(c, u, y);
  random_vector(c, random_turns(&o->bodies[b]) ? 1.0 : 0.0, def.point_b);
  wide_from_double(def.point_b, joint->s[1]);
  oracle_to_ground(&o->bodies[b], joint->s[1], point);
  if (in_ground) {
    wide_to_double(point, def.point);
    def.point_b[0] = def.point_b[1] = def.point_b[2] = (double)NAN;
    wide_from_double(def.point, point);
    oracle_place(o, joint, point, point, z);
  } else {
    random_vector(c, 1.0, apart);
    oracle_to_body(&o->bodies[a], point, joint->s[0]);
    for (int i = 0; i < 3; i++) {
      def.point_a[i] = (double)joint->s[0][i] - apart[i];
    }
    wide_from_double(def.point_a, joint->s[0]);
  }
  for (int i = 0; i < 3; i++) {
    const double *turn = u->turn + (ptrdiff_t)3 * i;
    u->shift[i] = y[i] - turn[0] * apart[0] - turn[1] * apart[1] - turn[2] * apart[2];
  }
  def.body_a = o->bodies[a].id;
  def.body_b = o->bodies[b].id;
  def.curve = curve;
  def.user = u;
  check(baum_mechanism_add_spatial_curve(r->mechanism, &def, &joint->id));
}

/* Adds a body or a particle. One in three of them is planar. A point of the new body moves on a
 * curve that is fixed on another body. If the new body has an orientation, the curve may instead be
 * fixed on the new body, and the point on the other body. */
static void add_bead(random_spatial *r)
{
  chance *c = &r->chance;
  bool particle = chance_below(c, 2) == 0;
  bool planar = chance_below(c, 3) == 0;
  int other = choose_turning(r, false);
  bool swap = chance_below(c, 2) == 0 && !particle && other > 0;
  random_spatial_add_body(r, particle, planar);
  int added = r->oracle.body_count - 1;
  add_curve(r, swap ? added : other, swap ? other : added);
}

/* ---- cables ---- */

static void choose_path(random_spatial *r, oracle_force *f, baum_body_id bodies[ORACLE_PATH])
{
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  f->point_count = 2 + chance_below(c, ORACLE_PATH - 1);
  for (int k = 0; k < f->point_count; k++) {
    f->path[k] = chance_below(c, o->body_count);
    bodies[k] = o->bodies[f->path[k]].id;
    random_vector(c, random_turns(&o->bodies[f->path[k]]) ? 1.0 : 0.0, f->points[k]);
  }
}

/* Adds a cable, whose path often visits a body twice. With the default free length, the cable is
 * just about to become taut at the start. A transition of 0 would make the damping jump at this
 * length, so it is not combined with the default free length. The damper is often so strong that it
 * cancels the tension of a cable that becomes shorter. */
static void add_cable(random_spatial *r)
{
  static const double share = 1e-4; /* the default of the transition, relative to the free length */
  chance *c = &r->chance;
  oracle_force f = {.kind = ORACLE_CABLE};
  baum_body_id bodies[ORACLE_PATH];
  baum_spatial_cable_def def = baum_spatial_cable_def_default();
  choose_path(r, &f, bodies);
  f.stiffness = def.stiffness = chance_decade(c, 1.0, 100.0);
  f.damping = def.damping = chance_below(c, 3) == 0 ? 0.0 : chance_decade(c, 0.1, 100.0);
  f.free_length = oracle_design_length(&r->oracle, &f);
  bool is_default = chance_below(c, 6) == 0;
  if (!is_default) {
    def.free_length = chance_number(c, 0.2, 1.2) * (double)f.free_length;
    f.free_length = def.free_length;
  }
  f.transition = share * f.free_length;
  if (chance_below(c, 2) == 0) {
    def.transition = !is_default && chance_below(c, 4) == 0 ? 0.0 : chance_decade(c, 0.1, 10.0);
    f.transition = def.transition;
  }
  r->oracle.forces[r->oracle.force_count++] = f;
  def.bodies = bodies;
  def.points = f.points[0];
  def.point_count = f.point_count;
  check(baum_mechanism_add_spatial_cable(r->mechanism, &def, NULL));
}

/* ---- all ---- */

/* Calls `add` up to `most` times. */
static void repeat(random_spatial *r, int most, void (*add)(random_spatial *))
{
  for (int k = chance_below(&r->chance, most + 1); k > 0; k--) {
    add(r);
  }
}

void random_spatial_add_further(random_spatial *r)
{
  add_body(r);
  repeat(r, 2, add_body);
  repeat(r, 1, add_loop);
  repeat(r, 2, random_spatial_add_coupling);
  repeat(r, 1, add_user_rows);
  repeat(r, 2, add_torsion_spring);
  repeat(r, 2, add_bushing);
  repeat(r, 2, add_spatial_edge);
  repeat(r, 1, add_bead);
  repeat(r, 2, add_cable);
}
