/* SPDX-License-Identifier: BSD-3-Clause */
#include "oracle_motion.h"

#include <math.h>
#include <string.h>

static const wide REVOLUTION = 6.28318530717958647692528676655900577L;

static void normalize3(wide x[3])
{
  wide length = wide_root(dot3(x, x));
  for (int i = 0; i < 3; i++) {
    x[i] /= length;
  }
}

/* Halves the angle until it is below 1, sums the series, and doubles the angle again. */
void oracle_turn(wide angle, wide *cosine, wide *sine)
{
  int halved = 0;
  for (; wide_size(angle) > 1; halved++) {
    angle /= 2;
  }
  wide term = 1;
  *cosine = 0;
  *sine = 0;
  for (int n = 0; n < 32; n++) {
    wide sign = n % 4 < 2 ? 1 : -1;
    *(n % 2 == 0 ? cosine : sine) += sign * term;
    term *= angle / (n + 1);
  }
  for (int n = 0; n < halved; n++) {
    wide c = *cosine;
    *cosine = c * c - *sine * *sine;
    *sine *= 2 * c;
  }
}

/* ---- bodies ---- */

/* Computes the rotation matrix A of a quaternion p. For every vector e, A e = p e p*. */
static void matrix_of_quaternion(const wide p[4], wide a[9])
{
  wide square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3];
  const wide *u = p + 1;
  for (int j = 0; j < 3; j++) {
    wide e[3] = {j == 0, j == 1, j == 2};
    wide beside[3];
    cross3(u, e, beside);
    for (int i = 0; i < 3; i++) {
      wide sum = (p[0] * p[0] - dot3(u, u)) * e[i] + 2 * u[j] * u[i] + 2 * p[0] * beside[i];
      a[3 * i + j] = sum / square;
    }
  }
}

static void matrix_of(const oracle_body *body, const wide *q, wide a[9])
{
  memset(a, 0, 9 * sizeof *a);
  a[0] = a[4] = a[8] = 1;
  if (body->kind == 's') {
    matrix_of_quaternion(q + 3, a);
  } else if (body->kind == 'b') {
    oracle_turn(q[2], &a[0], &a[3]);
    a[1] = -a[3];
    a[4] = a[0];
  }
}

static void place_of(const oracle_body *body, const wide *q, wide r[3])
{
  for (int i = 0; i < 3; i++) {
    bool in_space = body->kind == 's' || body->kind == 'p';
    r[i] = body->kind != 'g' && (i < 2 || in_space) ? q[i] : 0;
  }
}

int oracle_six_of(const oracle_body *body, int k)
{
  return body->kind == 'b' && k == 2 ? 5 : k;
}

/* The derivatives are A' = A [w]x and, if w is constant, A'' = A [w]x [w]x. */
motion oracle_motion_of(const oracle_body *body, const wide *q, const wide six[6])
{
  motion m = {.r = {{{0}}}};
  wide a[9];
  wide r[3];
  memcpy(m.six, six, sizeof m.six);
  matrix_of(body, q, a);
  place_of(body, q, r);
  for (int i = 0; i < 3; i++) {
    m.r[i] = (jet){{r[i], six[i], 0}};
  }
  for (int j = 0; j < 3; j++) {
    const wide e[3] = {j == 0, j == 1, j == 2};
    wide first[3];
    wide second[3];
    cross3(six + 3, e, first);
    cross3(six + 3, first, second);
    for (int i = 0; i < 3; i++) {
      const wide *row = a + (ptrdiff_t)3 * i;
      m.axes[j][i] = (jet){{dot3(row, e), dot3(row, first), dot3(row, second)}};
    }
  }
  return m;
}

void oracle_angular_velocity(const motion *m, jet out[3])
{
  oracle_turned(m, m->six + 3, out);
}

void oracle_turned(const motion *m, const wide s[3], jet out[3])
{
  for (int i = 0; i < 3; i++) {
    out[i] = jet_add(jet_scale(s[0], m->axes[0][i]),
                     jet_add(jet_scale(s[1], m->axes[1][i]), jet_scale(s[2], m->axes[2][i])));
  }
}

static void design_of(const oracle_body *body, wide q[7])
{
  for (int i = 0; i < 7; i++) {
    q[i] = body->q[i];
  }
}

void oracle_axis_to_body(const oracle_body *body, const wide axis[3], wide s[3])
{
  wide q[7];
  wide a[9];
  design_of(body, q);
  matrix_of(body, q, a);
  for (int j = 0; j < 3; j++) {
    s[j] = a[j] * axis[0] + a[3 + j] * axis[1] + a[6 + j] * axis[2];
  }
}

void oracle_to_body(const oracle_body *body, const wide point[3], wide s[3])
{
  wide q[7];
  wide r[3];
  design_of(body, q);
  place_of(body, q, r);
  const wide apart[3] = {point[0] - r[0], point[1] - r[1], point[2] - r[2]};
  oracle_axis_to_body(body, apart, s);
}

void oracle_axis_to_ground(const oracle_body *body, const wide s[3], wide axis[3])
{
  wide q[7];
  wide a[9];
  design_of(body, q);
  matrix_of(body, q, a);
  for (int i = 0; i < 3; i++) {
    axis[i] = dot3(a + (ptrdiff_t)3 * i, s);
  }
}

void oracle_to_ground(const oracle_body *body, const wide s[3], wide point[3])
{
  wide q[7];
  wide r[3];
  design_of(body, q);
  place_of(body, q, r);
  oracle_axis_to_ground(body, s, point);
  for (int i = 0; i < 3; i++) {
    point[i] += r[i];
  }
}

/* ---- all bodies ---- */

void oracle_spread(const spatial_oracle *o, const double *v, wide six[][6])
{
  memset(six, 0, ORACLE_BODIES * sizeof *six);
  for (int k = 0; k < o->body_count; k++) {
    const oracle_body *body = &o->bodies[k];
    for (int i = 0; i < body->nv; i++) {
      six[k][oracle_six_of(body, i)] = v[body->first_v + i];
    }
  }
}

void oracle_set_velocities(instant *now, int body, const wide six[6])
{
  const oracle_body *of = &now->o->bodies[body];
  now->bodies[body] = oracle_motion_of(of, now->q + of->first_q, six);
}

instant oracle_instant_at(const spatial_oracle *o, double t, const wide *q, const double *v)
{
  instant now = {.o = o, .t = t, .q = q};
  wide six[ORACLE_BODIES][6];
  oracle_spread(o, v, six);
  for (int k = 0; k < o->body_count; k++) {
    oracle_set_velocities(&now, k, six[k]);
  }
  return now;
}

instant oracle_stop(const instant *now)
{
  static const wide none[6] = {0};
  instant still = *now;
  for (int k = 0; k < now->o->body_count; k++) {
    oracle_set_velocities(&still, k, none);
  }
  return still;
}

void oracle_design_motions(const spatial_oracle *o, motion bodies[ORACLE_BODIES])
{
  static const wide none[6] = {0};
  for (int k = 0; k < o->body_count; k++) {
    wide q[7];
    design_of(&o->bodies[k], q);
    bodies[k] = oracle_motion_of(&o->bodies[k], q, none);
  }
}

/* ---- joints ---- */

void oracle_place(const spatial_oracle *o, oracle_joint *joint, const wide point_a[3],
                  const wide point_b[3], const wide z[3])
{
  wide axes[9];
  wide *x = axes;
  memcpy(axes + 6, z, 3 * sizeof *z);
  normalize3(axes + 6);
  int least = z[0] * z[0] < z[1] * z[1] ? 0 : 1;
  const wide beside[3] = {least == 0, least == 1, 0};
  cross3(axes + 6, beside, x);
  normalize3(x);
  cross3(axes + 6, x, axes + 3);
  oracle_to_body(&o->bodies[joint->a], point_a, joint->s[0]);
  oracle_to_body(&o->bodies[joint->b], point_b, joint->s[1]);
  for (int k = 0; k < 9; k += 3) {
    oracle_axis_to_body(&o->bodies[joint->a], axes + k, joint->axes[0] + k);
    oracle_axis_to_body(&o->bodies[joint->b], axes + k, joint->axes[1] + k);
  }
  wide apart[3];
  for (int i = 0; i < 3; i++) {
    apart[i] = point_b[i] - point_a[i];
  }
  joint->length = wide_root(dot3(apart, apart));
}

/* With n = z_a x z and c = z_a . z, the smallest rotation that takes z_a to z takes any vector u to
 * u + n x u + n x (n x u) / (1 + c). */
void oracle_incline(const spatial_oracle *o, oracle_joint *joint, const wide z[3])
{
  wide unit[3] = {z[0], z[1], z[2]};
  wide axis[3];
  wide n[3];
  normalize3(unit);
  oracle_axis_to_ground(&o->bodies[joint->a], joint->axes[0] + 6, axis);
  cross3(axis, unit, n);
  wide c = dot3(axis, unit);
  for (int k = 0; k < 9; k += 3) {
    wide x[3];
    wide first[3];
    wide second[3];
    oracle_axis_to_ground(&o->bodies[joint->a], joint->axes[0] + k, x);
    cross3(n, x, first);
    cross3(n, first, second);
    for (int i = 0; i < 3; i++) {
      x[i] += first[i] + second[i] / (1 + c);
    }
    oracle_axis_to_body(&o->bodies[joint->b], x, joint->axes[1] + k);
  }
}

moving oracle_moving_of(const oracle_joint *joint, const motion *bodies)
{
  moving m;
  const motion *side[2] = {&bodies[joint->a], &bodies[joint->b]};
  jet arm[2][3];
  for (int k = 0; k < 2; k++) {
    oracle_turned(side[k], joint->s[k], arm[k]);
    for (int j = 0; j < 3; j++) {
      oracle_turned(side[k], joint->axes[k] + (ptrdiff_t)3 * j, m.axes[k][j]);
    }
  }
  for (int i = 0; i < 3; i++) {
    m.e[i] = jet_less(jet_add(side[1]->r[i], arm[1][i]), jet_add(side[0]->r[i], arm[0][i]));
  }
  return m;
}

static int add_same(const moving *m, int axis, jet *out)
{
  for (int i = 0; i < 3; i++) {
    out[i] = jet_less(m->axes[1][axis][i], m->axes[0][axis][i]);
  }
  return 3;
}

static int add_coincident(const moving *m, jet *out)
{
  memcpy(out, m->e, sizeof m->e);
  return 3;
}

static int add_on_line(const moving *m, jet *out)
{
  jet_cross(m->axes[0][2], m->e, out);
  return 3;
}

static int add_product(const jet x[3], const jet y[3], jet *out)
{
  out[0] = jet_dot(x, y);
  return 1;
}

/* Sets the row of the thread: the displacement minus the angle times the pitch per radian. */
static int add_thread(const oracle_joint *joint, const motion *bodies, jet *out)
{
  const wide part = joint->pitch / REVOLUTION;
  const jet angle = oracle_coordinate_of(joint, 1, bodies);
  out[0] = jet_less(oracle_coordinate_of(joint, 0, bodies), jet_scale(part, angle));
  out[0].d[0] = (wide)remainder((double)(out[0].d[0] - joint->offset), joint->pitch);
  return 1;
}

/* Sets the row that keeps the twist of two shafts at 0. The relative angular velocity is normal to
 * z_a + z_b (K. H. Hunt, 1973). The row of the library has a gradient of length 1 at every angle
 * between the shafts, so both expressions are divided by the length of z_a + z_b. */
static int add_equal_speeds(const oracle_joint *joint, const moving *m, const motion *bodies,
                            jet *out)
{
  jet w[2][3];
  jet sum[3];
  jet relative[3];
  oracle_angular_velocity(&bodies[joint->a], w[0]);
  oracle_angular_velocity(&bodies[joint->b], w[1]);
  for (int i = 0; i < 3; i++) {
    sum[i] = jet_add(m->axes[0][2][i], m->axes[1][2][i]);
    relative[i] = jet_less(w[1][i], w[0][i]);
  }
  const jet length = jet_root(jet_dot(sum, sum));
  const jet slip = jet_quotient(jet_dot(sum, relative), length);
  const jet sine =
    jet_less(jet_dot(m->axes[0][1], m->axes[1][0]), jet_dot(m->axes[0][0], m->axes[1][1]));
  const jet twist = jet_quotient(sine, length);
  out[0] = (jet){{twist.d[0], slip.d[0], slip.d[1]}};
  return 1;
}

/* Evaluates the rows of a joint whose rows are products of vectors, or the length of a vector. */
static int basic_rows_of(const oracle_joint *joint, const moving *m, jet out[ORACLE_ROWS])
{
  int n = 0;
  switch ((int)joint->kind) {
  case ORACLE_SPHERICAL: return add_coincident(m, out);
  case ORACLE_REVOLUTE: n = add_coincident(m, out); return n + add_same(m, 2, out + n);
  case ORACLE_UNIVERSAL:
    n = add_coincident(m, out);
    return n + add_product(m->axes[0][2], m->axes[1][0], out + n);
  case ORACLE_CYLINDRICAL: n = add_on_line(m, out); return n + add_same(m, 2, out + n);
  case ORACLE_PLANAR: n = add_same(m, 2, out); return n + add_product(m->axes[0][2], m->e, out + n);
  case ORACLE_PRISMATIC:
  case ORACLE_FIXED:
    n = joint->kind == ORACLE_FIXED ? add_coincident(m, out) : add_on_line(m, out);
    for (int axis = 0; axis < 3; axis++) {
      n += add_same(m, axis, out + n);
    }
    return n;
  case ORACLE_DISTANCE:
    out[0] = jet_root(jet_dot(m->e, m->e));
    out[0].d[0] -= joint->length;
    return 1;
  case ORACLE_ON_LINE: return add_on_line(m, out);
  default: return add_product(m->axes[0][2], m->e, out);
  }
}

static int rows_of(const oracle_joint *joint, const motion *bodies, jet out[ORACLE_ROWS])
{
  const moving m = oracle_moving_of(joint, bodies);
  int n = 0;
  switch ((int)joint->kind) {
  case ORACLE_SCREW:
    n = add_on_line(&m, out);
    n += add_same(&m, 2, out + n);
    return n + add_thread(joint, bodies, out + n);
  case ORACLE_CONSTANT_VELOCITY:
    n = add_coincident(&m, out);
    return n + add_equal_speeds(joint, &m, bodies, out + n);
  case ORACLE_ROLLING_DISC: return oracle_disc_rows(joint, bodies, out);
  case ORACLE_KNIFE_EDGE:
  case ORACLE_SPATIAL_EDGE: return oracle_edge_rows(joint, bodies, out);
  case ORACLE_CURVE: return oracle_curve_rows(joint, bodies, out);
  default: return basic_rows_of(joint, &m, out);
  }
}

bool oracle_is_velocity_row(const oracle_joint *joint, int row)
{
  return (joint->kind == ORACLE_ROLLING_DISC && row > 0) || oracle_is_edge(joint) ||
         joint->kind == ORACLE_USER;
}

const oracle_joint *oracle_pair_of(const spatial_oracle *o, const oracle_joint *joint)
{
  return joint->kind == ORACLE_DRIVER ? &o->joints[joint->of] : joint;
}

static void add_member(int body, int members[ORACLE_MEMBERS], int *count)
{
  bool known = body == 0;
  for (int k = 0; k < *count; k++) {
    known = known || members[k] == body;
  }
  if (!known) {
    members[(*count)++] = body;
  }
}

int oracle_members_of(const spatial_oracle *o, const oracle_joint *joint,
                      int members[ORACLE_MEMBERS])
{
  int count = 0;
  if (joint->kind == ORACLE_COUPLING) {
    add_member(o->joints[joint->of].a, members, &count);
    add_member(o->joints[joint->of].b, members, &count);
    add_member(o->joints[joint->to].a, members, &count);
    add_member(o->joints[joint->to].b, members, &count);
    return count;
  }
  if (joint->kind == ORACLE_USER) {
    memcpy(members, joint->user.members, sizeof joint->user.members);
    return joint->user.member_count;
  }
  members[0] = oracle_pair_of(o, joint)->a;
  members[1] = oracle_pair_of(o, joint)->b;
  return 2;
}

void oracle_reaction_arm(const oracle_joint *joint, const motion *bodies, wide arm[3])
{
  const motion *body = &bodies[joint->b];
  bool touches = joint->kind == ORACLE_ROLLING_DISC || oracle_is_edge(joint);
  jet at[3];
  if (touches) {
    oracle_contact_point(joint, bodies, at);
  } else {
    oracle_turned(body, joint->s[1], at);
  }
  for (int i = 0; i < 3; i++) {
    arm[i] = at[i].d[0] - (touches ? body->r[i].d[0] : 0);
  }
}

int oracle_coordinate_count(oracle_kind kind)
{
  switch ((int)kind) {
  case ORACLE_PLANAR: return 3;
  case ORACLE_UNIVERSAL:
  case ORACLE_SCREW:
  case ORACLE_CYLINDRICAL: return 2;
  case ORACLE_REVOLUTE:
  case ORACLE_PRISMATIC:
  case ORACLE_ON_LINE: return 1;
  default: return 0;
  }
}

/* Angles are 0 in the design configuration, because the axes on both bodies coincide there. The
 * second rotation of a universal joint is about the x axis of body_b. */
jet oracle_coordinate_of(const oracle_joint *joint, int number, const motion *bodies)
{
  const moving m = oracle_moving_of(joint, bodies);
  if (joint->kind == ORACLE_PLANAR && number < 2) {
    return jet_dot(m.axes[0][number], m.e);
  }
  if (joint->kind == ORACLE_UNIVERSAL && number == 1) {
    return jet_angle(jet_dot(m.axes[0][2], m.axes[1][2]), jet_dot(m.axes[0][2], m.axes[1][1]));
  }
  bool along = joint->kind == ORACLE_PRISMATIC || joint->kind == ORACLE_ON_LINE ||
               ((joint->kind == ORACLE_CYLINDRICAL || joint->kind == ORACLE_SCREW) && number == 0);
  return along
           ? jet_dot(m.axes[0][2], m.e)
           : jet_angle(jet_dot(m.axes[0][0], m.axes[1][0]), jet_dot(m.axes[0][1], m.axes[1][0]));
}

int oracle_law(double t, double s[3], void *user)
{
  const double *start = user;
  s[0] = start[1] + 0.3 * sin(t - start[0]);
  s[1] = 0.3 * cos(t - start[0]);
  s[2] = -0.3 * sin(t - start[0]);
  return 0;
}

static int coupling_row(const spatial_oracle *o, const oracle_joint *joint, const motion *bodies,
                        jet *out)
{
  const jet of = oracle_coordinate_of(&o->joints[joint->of], joint->coordinate, bodies);
  const jet to = oracle_coordinate_of(&o->joints[joint->to], joint->to_coordinate, bodies);
  out[0] = jet_less(to, jet_scale(joint->ratio, of));
  out[0].d[0] -= joint->offset;
  if (joint->period > 0.0) {
    out[0].d[0] = (wide)remainder((double)out[0].d[0], joint->period);
  }
  return 1;
}

int oracle_rows_of(const spatial_oracle *o, const oracle_joint *joint, const motion *bodies,
                   double t, int flow, jet out[ORACLE_ROWS])
{
  if (joint->kind < ORACLE_PAIR_KINDS) {
    return rows_of(joint, bodies, out);
  }
  if (joint->kind == ORACLE_COUPLING) {
    return coupling_row(o, joint, bodies, out);
  }
  if (joint->kind == ORACLE_USER) {
    return oracle_user_rows(o, joint, bodies, t, flow, out);
  }
  double s[3];
  double start[2] = {joint->start[0], joint->start[1]};
  (void)oracle_law(t, s, start);
  jet law = {{s[0], flow * s[1], flow * s[2]}};
  out[0] = jet_less(oracle_coordinate_of(&o->joints[joint->of], joint->coordinate, bodies), law);
  return 1;
}

wide oracle_design_coordinate(const spatial_oracle *o, const oracle_joint *joint, int number)
{
  motion bodies[ORACLE_BODIES];
  oracle_design_motions(o, bodies);
  return oracle_coordinate_of(joint, number, bodies).d[0];
}
