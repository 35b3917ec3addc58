/* SPDX-License-Identifier: BSD-3-Clause */
#include "random_mechanism.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "random_velocity_rows.h"

/* ---- chance ---- */

chance chance_of(uint64_t seed)
{
  return (chance){.state = 0x9e3779b97f4a7c15u * (seed + 1)};
}

static uint64_t draw(chance *c)
{
  c->state ^= c->state >> 12;
  c->state ^= c->state << 25;
  c->state ^= c->state >> 27;
  return c->state * 0x2545f4914f6cdd1du;
}

double chance_number(chance *c, double low, double high)
{
  return low + (high - low) * ((double)(draw(c) >> 11) * 0x1p-53);
}

double chance_decade(chance *c, double low, double high)
{
  return low * pow(high / low, chance_number(c, 0.0, 1.0));
}

int chance_below(chance *c, int count)
{
  return (int)((draw(c) >> 33) % (uint64_t)count);
}

/* ---- user functions ---- */

static int coordinates_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  const random_body *b = user;
  for (int i = 0; i < b->size; i++) {
    for (int j = 0; j < b->size; j++) {
      double sum = 0.0;
      for (int k = 0; k < b->size; k++) {
        sum += b->factor[i * b->size + k] * b->factor[j * b->size + k];
      }
      out[i * b->size + j] = sum;
    }
  }
  if (!b->constant) {
    out[0] *= 1.0 + 0.25 * q[0] * q[0];
  }
  return 0;
}

static int coordinates_force(double t, const double *q, const double *v, const double *inputs,
                             double *out, void *user)
{
  (void)t;
  (void)inputs;
  const random_body *b = user;
  for (int i = 0; i < b->size; i++) {
    out[i] = b->force[i] - 0.1 * v[i] - q[i];
  }
  return 0;
}

static int answer(random_rows *r, double *out)
{
  if (r->fail_at > 0 && --r->fail_at == 0) {
    out[0] = (double)NAN;
    return r->answer;
  }
  return 0;
}

static int rows_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  random_rows *r = user;
  for (int i = 0; i < r->rows; i++) {
    out[i] = 0.0;
    for (int j = 0; j < r->columns; j++) {
      double x = q[j] - r->at[j];
      out[i] += r->linear[i][j] * x + 0.5 * r->square[i][j] * x * x;
    }
  }
  return answer(r, out);
}

static int rows_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  random_rows *r = user;
  for (int i = 0; i < r->rows; i++) {
    for (int j = 0; j < r->columns; j++) {
      out[i * r->columns + j] = r->linear[i][j] + r->square[i][j] * (q[j] - r->at[j]);
    }
  }
  return answer(r, out);
}

static int rows_nu(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  random_rows *r = user;
  memset(out, 0, (size_t)r->rows * sizeof *out);
  return answer(r, out);
}

static int rows_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  (void)q;
  random_rows *r = user;
  for (int i = 0; i < r->rows; i++) {
    out[i] = 0.0;
    for (int j = 0; j < r->columns; j++) {
      out[i] -= r->square[i][j] * v[j] * v[j];
    }
  }
  return answer(r, out);
}

static int circle(const double xy[2], double out[6], void *user)
{
  const double *radius = user;
  out[0] = xy[0] * xy[0] + xy[1] * xy[1] - radius[0];
  out[1] = 2.0 * xy[0];
  out[2] = 2.0 * xy[1];
  out[3] = 2.0;
  out[4] = 0.0;
  out[5] = 2.0;
  return 0;
}

static int sway(double t, double s[3], void *user)
{
  const double *start = user;
  s[0] = start[0] + 0.3 * sin(t - start[1]);
  s[1] = 0.3 * cos(t - start[1]);
  s[2] = -0.3 * sin(t - start[1]);
  return 0;
}

/* ---- bodies ---- */

static void add_body(random_mechanism *r, const random_kind *kind)
{
  chance *c = &r->chance;
  random_body *b = &r->bodies[r->body_count++];
  int roll = chance_below(c, 100);
  b->kind = 'b';
  if (roll < kind->particles) {
    b->kind = 'p';
  } else if (roll < kind->particles + kind->coordinates) {
    b->kind = 'c';
  }
  b->size = b->kind == 'b' ? 3 : b->kind == 'p' ? 2 : 1 + chance_below(c, RANDOM_SIZE);
  b->constant = kind->constant;
  for (int i = 0; i < b->size; i++) {
    b->q[i] = chance_number(c, -2.0, 2.0);
    b->force[i] = chance_number(c, -3.0, 3.0);
    for (int j = 0; j <= i; j++) {
      b->factor[i * b->size + j] = chance_number(c, -0.4, 0.4) + (i == j ? 1.5 : 0.0);
    }
  }
  double mass = chance_decade(c, 1.0 / kind->span, kind->span);
  baum_status status = BAUM_OK;
  if (b->kind == 'b') {
    baum_planar_body_def def = baum_planar_body_def_default();
    def.mass = mass;
    def.inertia = mass * chance_decade(c, 0.05, 1.0);
    memcpy(def.position, b->q, sizeof def.position);
    def.angle = b->q[2];
    status = baum_mechanism_add_planar_body(r->mechanism, &def, &b->id);
  } else if (b->kind == 'p') {
    baum_planar_particle_def def = baum_planar_particle_def_default();
    def.mass = mass;
    memcpy(def.position, b->q, sizeof def.position);
    status = baum_mechanism_add_planar_particle(r->mechanism, &def, &b->id);
  } else {
    baum_coordinates_def def = baum_coordinates_def_default();
    def.size = b->size;
    def.q = b->q;
    def.mass = coordinates_mass;
    def.force = coordinates_force;
    def.constant_mass = b->constant;
    def.user = b;
    status = baum_mechanism_add_coordinates(r->mechanism, &def, &b->id);
  }
  assert_int_equal(status, BAUM_OK);
}

/* ---- joints ---- */

/* Chooses a point near the centre of `a`, or the centre itself. */
static void choose_point(random_mechanism *r, const random_body *a, double point[2])
{
  chance *c = &r->chance;
  bool centre = chance_below(c, 5) == 0;
  for (int i = 0; i < 2; i++) {
    point[i] = a->q[i] + (centre ? 0.0 : chance_number(c, -1.0, 1.0));
  }
}

/* Converts a point from ground axes to body axes. */
static void to_body(const random_body *b, const double point[2], double out[2])
{
  double x = point[0] - b->q[0];
  double y = point[1] - b->q[1];
  double angle = b->kind == 'b' ? b->q[2] : 0.0;
  out[0] = cos(angle) * x + sin(angle) * y;
  out[1] = -sin(angle) * x + cos(angle) * y;
}

static void keep(random_mechanism *r, char kind, baum_status status, baum_joint_id id)
{
  if (status != BAUM_OK) {
    print_message("%c: %s\n", kind, baum_message());
  }
  assert_int_equal(status, BAUM_OK);
  r->joint_kind[r->joint_count] = kind;
  r->joints[r->joint_count++] = id;
}

/* Sets the fields that all definitions of joints with one point share. */
#define PLACE(DEF)           \
  (DEF).body_a = a->id;      \
  (DEF).body_b = b->id;      \
  (DEF).point[0] = point[0]; \
  (DEF).point[1] = point[1]

static void add_pin(random_mechanism *r, const random_body *a, const random_body *b)
{
  double point[2];
  choose_point(r, chance_below(&r->chance, 2) ? a : b, point);
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  baum_joint_id id;
  PLACE(def);
  keep(r, 'r', baum_mechanism_add_planar_revolute(r->mechanism, &def, &id), id);
}

static void add_slide(random_mechanism *r, const random_body *a, const random_body *b)
{
  double point[2];
  double angle = chance_number(&r->chance, 0.0, 6.0);
  choose_point(r, b, point);
  baum_planar_translational_def def = baum_planar_translational_def_default();
  baum_joint_id id;
  PLACE(def);
  def.axis[0] = cos(angle);
  def.axis[1] = sin(angle);
  keep(r, 't', baum_mechanism_add_planar_translational(r->mechanism, &def, &id), id);
}

static void add_weld(random_mechanism *r, const random_body *a, const random_body *b)
{
  double point[2];
  choose_point(r, b, point);
  baum_planar_fixed_def def = baum_planar_fixed_def_default();
  baum_joint_id id;
  PLACE(def);
  keep(r, 'f', baum_mechanism_add_planar_fixed(r->mechanism, &def, &id), id);
}

/* Chooses a random point in body axes. For a particle, this is the particle itself. */
static void choose_end(random_mechanism *r, const random_body *body, double end[2])
{
  double point[2];
  choose_point(r, body, point);
  to_body(body, body->kind == 'p' ? body->q : point, end);
}

static void add_rod(random_mechanism *r, const random_body *a, const random_body *b)
{
  baum_planar_distance_def def = baum_planar_distance_def_default();
  baum_joint_id id;
  def.body_a = a->id;
  def.body_b = b->id;
  choose_end(r, a, def.point_a);
  choose_end(r, b, def.point_b);
  keep(r, 'd', baum_mechanism_add_planar_distance(r->mechanism, &def, &id), id);
}

static void add_slot(random_mechanism *r, const random_body *a, const random_body *b)
{
  double point[2];
  double angle = chance_number(&r->chance, 0.0, 6.0);
  choose_point(r, b, point);
  if (b->kind == 'p') {
    memcpy(point, b->q, sizeof point);
  }
  baum_planar_pin_in_slot_def def = baum_planar_pin_in_slot_def_default();
  baum_joint_id id;
  PLACE(def);
  def.axis[0] = cos(angle);
  def.axis[1] = sin(angle);
  keep(r, 's', baum_mechanism_add_planar_pin_in_slot(r->mechanism, &def, &id), id);
}

static void add_rack(random_mechanism *r, const random_body *a, const random_body *b)
{
  double point[2];
  choose_point(r, b, point);
  baum_planar_rack_and_pinion_def def = baum_planar_rack_and_pinion_def_default();
  baum_joint_id id;
  PLACE(def);
  def.axis[0] = chance_number(&r->chance, 0.2, 1.0);
  def.axis[1] = chance_number(&r->chance, -1.0, 1.0);
  def.radius = chance_number(&r->chance, 0.1, 0.5);
  keep(r, 'k', baum_mechanism_add_planar_rack_and_pinion(r->mechanism, &def, &id), id);
}

static void add_gear(random_mechanism *r, const random_body *a, const random_body *b)
{
  baum_planar_gear_def def = baum_planar_gear_def_default();
  baum_joint_id id;
  const random_body *carrier = &r->bodies[chance_below(&r->chance, r->body_count)];
  def.body_a = a->id;
  def.body_b = b->id;
  if (carrier != a && carrier != b && carrier->kind == 'b') {
    def.carrier = carrier->id;
  } else if (a->kind == 'g' || b->kind == 'g') {
    return;
  }
  def.radius_a = chance_number(&r->chance, 0.1, 0.5);
  def.radius_b = chance_number(&r->chance, -0.5, -0.1);
  keep(r, 'z', baum_mechanism_add_planar_gear(r->mechanism, &def, &id), id);
}

static void add_curve(random_mechanism *r, const random_body *a, const random_body *b)
{
  baum_planar_curve_def def = baum_planar_curve_def_default();
  baum_joint_id id;
  random_rows *rows = &r->rows[r->rows_count++];
  double place[2];
  double on_a[2];
  to_body(a, b->q, place);
  def.body_a = a->id;
  def.body_b = b->id;
  if (a->kind == 'p') {
    return;
  }
  def.point_a[0] = 0.1;
  def.point_a[1] = 0.0;
  def.point_b[0] = 0.0;
  def.point_b[1] = 0.0;
  on_a[0] = place[0] - def.point_a[0];
  on_a[1] = place[1] - def.point_a[1];
  rows->at[0] = on_a[0] * on_a[0] + on_a[1] * on_a[1];
  def.curve = circle;
  def.user = rows->at;
  keep(r, 'c', baum_mechanism_add_planar_curve(r->mechanism, &def, &id), id);
}

static void add_rows(random_mechanism *r, const random_body *a, const random_body *b)
{
  chance *c = &r->chance;
  const random_body *members[RANDOM_SPAN] = {a, b, &r->bodies[chance_below(c, r->body_count)]};
  baum_body_id ids[RANDOM_SPAN];
  baum_user_constraint_def def = baum_user_constraint_def_default();
  random_rows *rows = &r->rows[r->rows_count++];
  baum_joint_id id;
  for (int k = 0; k < RANDOM_SPAN; k++) {
    if (members[k]->kind != 'g' && (k < 2 || (members[k] != a && members[k] != b))) {
      memcpy(rows->at + rows->columns, members[k]->q, (size_t)members[k]->size * sizeof(double));
      rows->columns += members[k]->size;
      ids[def.body_count++] = members[k]->id;
    }
  }
  rows->rows = 1 + chance_below(c, RANDOM_ROWS);
  rows->rows = rows->rows > rows->columns ? rows->columns : rows->rows;
  for (int i = 0; i < rows->rows; i++) {
    for (int j = 0; j < rows->columns; j++) {
      rows->linear[i][j] = chance_below(c, 4) == 0 ? 0.0 : chance_number(c, -1.0, 1.0);
      rows->square[i][j] = chance_below(c, 2) == 0 ? 0.0 : chance_number(c, -0.5, 0.5);
    }
  }
  def.bodies = ids;
  def.row_count = rows->rows;
  def.phi = rows_phi;
  def.jacobian = rows_jacobian;
  def.nu = rows_nu;
  def.gamma = rows_gamma;
  def.user = rows;
  keep(r, 'u', baum_mechanism_add_user_constraint(r->mechanism, &def, &id), id);
}

/* Returns the coordinate of a joint in the design configuration. For sliders and slots it is 0,
 * because their points coincide. */
static double design_coordinate(const random_mechanism *r, int joint)
{
  baum_planar_revolute_def def;
  if (r->joint_kind[joint] != 'r') {
    return 0.0;
  }
  assert_int_equal(
    baum_mechanism_get_planar_revolute(r->mechanism, r->joints[joint], &def, sizeof def), BAUM_OK);
  double angle[2] = {0.0, 0.0};
  for (int i = 1; i < r->body_count; i++) {
    const random_body *b = &r->bodies[i];
    angle[0] = b->id.index1 == def.body_a.index1 ? b->q[2] : angle[0];
    angle[1] = b->id.index1 == def.body_b.index1 ? b->q[2] : angle[1];
  }
  return angle[1] - angle[0];
}

/* Chooses a random joint, and adds a driver to it if it has a coordinate. */
static void add_driver(random_mechanism *r, const random_kind *kind)
{
  int k = chance_below(&r->chance, r->joint_count + 1) - 1;
  if (k < 0 || !strchr("rts", r->joint_kind[k])) {
    return;
  }
  baum_driver_def def = baum_driver_def_default();
  baum_joint_id id;
  random_rows *rows = &r->rows[r->rows_count++];
  rows->at[0] = chance_number(&r->chance, -0.1, 0.1);
  if (kind->drivers_begin) {
    rows->at[0] = design_coordinate(r, k);
    rows->at[1] = kind->start;
  }
  def.joint = r->joints[k];
  def.law = sway;
  def.user = rows->at;
  r->joint_kind[k] = 'x'; /* this prevents a second driver */
  keep(r, 'v', baum_mechanism_add_driver(r->mechanism, &def, &id), id);
}

static void add_coupling(random_mechanism *r)
{
  int k = chance_below(&r->chance, r->joint_count + 1) - 1;
  int n = chance_below(&r->chance, r->joint_count + 1) - 1;
  if (k < 0 || n < 0 || k == n || !strchr("rts", r->joint_kind[k]) ||
      !strchr("rts", r->joint_kind[n])) {
    return;
  }
  baum_coupling_def def = baum_coupling_def_default();
  baum_joint_id id;
  def.joint_a = r->joints[k];
  def.joint_b = r->joints[n];
  def.ratio = chance_number(&r->chance, -2.0, 2.0);
  keep(r, 'o', baum_mechanism_add_coupling(r->mechanism, &def, &id), id);
}

static bool turns(const random_body *b)
{
  return b->kind == 'b' || b->kind == 'g';
}

static void add_planar(random_mechanism *r, const random_body *a, const random_body *b)
{
  typedef void add(random_mechanism *, const random_body *, const random_body *);
  static add *const any[] = {add_rod, add_slot, add_curve};
  static add *const turning[] = {add_slide, add_weld, add_rod,  add_slot,
                                 add_rack,  add_gear, add_curve};
  if (turns(a) && turns(b)) {
    turning[chance_below(&r->chance, 7)](r, a, b);
  } else if (a->kind != 'p' || b->kind != 'p') {
    any[chance_below(&r->chance, 3)](r, a->kind == 'p' ? b : a, a->kind == 'p' ? a : b);
  } else {
    add_rod(r, a, b);
  }
}

static void add_joint(random_mechanism *r, const random_kind *kind)
{
  chance *c = &r->chance;
  int i = kind->hub ? 1 : chance_below(c, r->body_count);
  int k = chance_below(c, r->body_count);
  const random_body *a = &r->bodies[i];
  const random_body *b = &r->bodies[k];
  int roll = chance_below(c, 100);
  if (i == k) {
    return;
  }
  if (roll < kind->pins && turns(a) && turns(b)) {
    add_pin(r, a, b);
    if (chance_below(c, 12) == 0) {
      add_pin(r, b, a);
    }
  } else if (roll % 9 == 0) {
    add_driver(r, kind);
  } else if (roll % 9 == 1) {
    add_coupling(r);
  } else if (a->kind == 'c' || b->kind == 'c' || roll % 7 == 0) {
    add_rows(r, a, b);
  } else {
    add_planar(r, a, b);
  }
}

/* ---- all ---- */

static void add_load(random_mechanism *r)
{
  chance *c = &r->chance;
  const random_body *b = &r->bodies[chance_below(c, r->body_count)];
  if (b->kind != 'b') {
    return;
  }
  baum_planar_load_def def = baum_planar_load_def_default();
  baum_force_id id;
  def.body = b->id;
  def.point[0] = chance_number(c, -1.0, 1.0);
  def.force[0] = chance_number(c, -5.0, 5.0);
  def.force[1] = chance_number(c, -5.0, 5.0);
  def.torque = chance_number(c, -1.0, 1.0);
  def.follows_body = chance_below(c, 2) == 0;
  assert_int_equal(baum_mechanism_add_planar_load(r->mechanism, &def, &id), BAUM_OK);
}

/* Adds a spring between two bodies. Bodies with user coordinates are excluded, because they have no
 * points. */
static void add_spring(random_mechanism *r)
{
  chance *c = &r->chance;
  const random_body *a = &r->bodies[chance_below(c, r->body_count)];
  const random_body *b = &r->bodies[chance_below(c, r->body_count)];
  if (a == b || a->kind == 'c' || b->kind == 'c') {
    return;
  }
  baum_planar_spring_def def = baum_planar_spring_def_default();
  baum_force_id id;
  def.body_a = a->id;
  def.body_b = b->id;
  choose_end(r, a, def.point_a);
  choose_end(r, b, def.point_b);
  def.stiffness = chance_decade(c, 1.0, 100.0);
  def.damping = chance_below(c, 2) == 0 ? 0.0 : chance_decade(c, 0.01, 10.0);
  assert_int_equal(baum_mechanism_add_planar_spring(r->mechanism, &def, &id), BAUM_OK);
}

void random_mechanism_make(random_mechanism *out, uint64_t seed, const random_kind *kind)
{
  memset(out, 0, sizeof *out);
  out->chance = chance_of(seed);
  out->mechanism = create_mechanism();
  out->body_count = 1;
  out->bodies[0] = (random_body){.id = BAUM_GROUND, .kind = 'g', .size = 3};
  for (int i = 0; i < kind->bodies; i++) {
    add_body(out, kind);
  }
  for (int i = 0; i < kind->joints; i++) {
    add_joint(out, kind);
  }
  for (int i = 0; i < kind->loads; i++) {
    add_load(out);
  }
  for (int i = 0; i < kind->springs; i++) {
    add_spring(out);
  }
  for (int i = 0; i < kind->velocity_rows; i++) {
    random_mechanism_add_velocity_rows(out);
  }
  assert_int_equal(baum_mechanism_freeze(out->mechanism), BAUM_OK);
}

void random_mechanism_destroy(random_mechanism *out)
{
  baum_mechanism_destroy(out->mechanism);
  out->mechanism = NULL;
}
