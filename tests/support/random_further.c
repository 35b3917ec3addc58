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

/* Chooses a wheel with a sharp or a round rim, or a sphere, of random position on body b. The plane
 * on body a is chosen so that it touches the wheel. */
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

/* Adds a joint that is not a basic one between two bodies with orientations. */
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
}
