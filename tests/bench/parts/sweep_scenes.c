/* SPDX-License-Identifier: BSD-3-Clause */
#include "sweep_scenes.h"

#include <math.h>
#include <string.h>

#include "sweep_motion.h"

static const double GRAVITY = 9.81;

/* Writes the pose of a body into q. */
static void place(long double *q, int body, long double x, long double y, long double angle)
{
  q[3 * body] = x;
  q[3 * body + 1] = y;
  q[3 * body + 2] = angle;
}

static void set_units(sweep_scene *s, double length)
{
  for (int i = 0; i < s->nq; i++) {
    s->unit[i] = i % 3 == 2 ? 1.0 : length;
  }
}

static baum_planar_body_def rod_def(double mass, double length)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.mass = mass;
  def.inertia = mass * length * length / 12.0;
  return def;
}

/* Returns the definition of a uniform rod whose pose is given by q. */
static baum_planar_body_def rod_at(double mass, double length, const long double *q)
{
  baum_planar_body_def def = rod_def(mass, length);
  def.position[0] = (double)q[0];
  def.position[1] = (double)q[1];
  def.angle = (double)q[2];
  return def;
}

/* Sets the velocity of a crank that rotates about the origin. */
static void set_turning(baum_planar_body_def *def, double rate)
{
  def->velocity[0] = -def->position[1] * rate;
  def->velocity[1] = def->position[0] * rate;
  def->angular_velocity = rate;
}

/* ---- four-bar ----
 *
 * The crank a starts at (0, 0), the coupler b follows, and the rocker c ends at (d, 0). They are
 * uniform rods of 1 kg/m with the angles th1, th2 and th3. With the unit vector e(th) at the angle
 * th, they satisfy
 *
 *   a e(th1) + b e(th2) - c e(th3) - d e(0) = 0
 *   th' = u n(th),  n = (sin(th2 - th3) / a, sin(th3 - th1) / b, sin(th2 - th1) / c)
 *
 * The vector n spans the null space of the Jacobian of both rows, even if the crank is in a dead
 * centre. It is zero only in singular configurations. The scalar u is the speed along n. Let th(s)
 * be the curve with dth/ds = n, so that s' = u. Along this curve, the kinetic energy is T = I(s)
 * u^2 / 2, and the potential energy is V(s). With the derivatives I_s and V_s, Lagrange's equation
 * is then
 *
 *   I u' + I_s u^2 / 2 + V_s = 0
 */

typedef struct linkage {
  long double a;
  long double b;
  long double c;
  long double d;
  long double g;
} linkage;

static void null_vector(const linkage *k, const long double *th, long double n[3])
{
  n[0] = sinl(th[1] - th[2]) / k->a;
  n[1] = sinl(th[2] - th[0]) / k->b;
  n[2] = sinl(th[1] - th[0]) / k->c;
}

/* Computes the derivative of n along the curve. */
static void null_slope(const linkage *k, const long double *th, const long double n[3],
                       long double dn[3])
{
  dn[0] = cosl(th[1] - th[2]) * (n[1] - n[2]) / k->a;
  dn[1] = cosl(th[2] - th[0]) * (n[2] - n[0]) / k->b;
  dn[2] = cosl(th[1] - th[0]) * (n[1] - n[0]) / k->c;
}

static long double coupling_mass(const linkage *k)
{
  return k->b * k->a * k->b / 2.0L;
}

/* Computes I, the generalized inertia of a motion along n. */
static long double inertia(const linkage *k, const long double *th, const long double n[3])
{
  long double m11 = k->a * k->a * k->a / 3.0L + k->b * k->a * k->a;
  long double m22 = k->b * k->b * k->b / 3.0L;
  long double m33 = k->c * k->c * k->c / 3.0L;
  return m11 * n[0] * n[0] + m22 * n[1] * n[1] + m33 * n[2] * n[2] +
         2.0L * coupling_mass(k) * cosl(th[0] - th[1]) * n[0] * n[1];
}

static long double potential(const linkage *k, const long double *th)
{
  return k->g * ((k->a * k->a / 2.0L + k->b * k->a) * sinl(th[0]) +
                 k->b * k->b / 2.0L * sinl(th[1]) + k->c * k->c / 2.0L * sinl(th[2]));
}

/* Computes dy for the state y = (th1, th2, th3, u). */
static void linkage_rate(const void *data, const long double *y, long double *dy)
{
  const linkage *k = data;
  long double n[3];
  long double dn[3];
  null_vector(k, y, n);
  null_slope(k, y, n, dn);
  long double m11 = k->a * k->a * k->a / 3.0L + k->b * k->a * k->a;
  long double m22 = k->b * k->b * k->b / 3.0L;
  long double m33 = k->c * k->c * k->c / 3.0L;
  long double m12 = coupling_mass(k) * cosl(y[0] - y[1]);
  long double dm12 = -coupling_mass(k) * sinl(y[0] - y[1]) * (n[0] - n[1]);
  long double half_slope = m11 * n[0] * dn[0] + m22 * n[1] * dn[1] + m33 * n[2] * dn[2] +
                           m12 * (dn[0] * n[1] + n[0] * dn[1]) + dm12 * n[0] * n[1];
  long double force =
    k->g * ((k->a * k->a / 2.0L + k->b * k->a) * cosl(y[0]) * n[0] +
            k->b * k->b / 2.0L * cosl(y[1]) * n[1] + k->c * k->c / 2.0L * cosl(y[2]) * n[2]);
  for (int i = 0; i < 3; i++) {
    dy[i] = y[3] * n[i];
  }
  dy[3] = -(half_slope * y[3] * y[3] + force) / inertia(k, y, n);
}

static long double linkage_energy(const linkage *k, const long double *y)
{
  long double n[3];
  null_vector(k, y, n);
  return inertia(k, y, n) * y[3] * y[3] / 2.0L + potential(k, y);
}

/* Returns the largest of three numbers: the two violations, and the relative change of energy. */
static long double linkage_fault(const linkage *k, const long double *y, long double energy,
                                 long double size)
{
  long double x = k->a * cosl(y[0]) + k->b * cosl(y[1]) - k->c * cosl(y[2]) - k->d;
  long double z = k->a * sinl(y[0]) + k->b * sinl(y[1]) - k->c * sinl(y[2]);
  return fmaxl(fmaxl(fabsl(x), fabsl(z)), fabsl(linkage_energy(k, y) - energy) / size);
}

static void linkage_q(const void *data, const long double *th, long double *q)
{
  const linkage *k = data;
  long double tip[2] = {k->a * cosl(th[0]), k->a * sinl(th[0])};
  place(q, 0, tip[0] / 2.0L, tip[1] / 2.0L, th[0]);
  place(q, 1, tip[0] + k->b / 2.0L * cosl(th[1]), tip[1] + k->b / 2.0L * sinl(th[1]), th[1]);
  place(q, 2, k->d + k->c / 2.0L * cosl(th[2]), k->c / 2.0L * sinl(th[2]), th[2]);
}

/* Closes the linkage for a given crank angle. The joint between coupler and rocker is to the left
 * or to the right of the diagonal. */
static void close_linkage(const linkage *k, long double crank, bool left, long double th[3])
{
  long double x = k->d - k->a * cosl(crank);
  long double y = -k->a * sinl(crank);
  long double diagonal = hypotl(x, y);
  long double at =
    acosl((k->b * k->b + diagonal * diagonal - k->c * k->c) / (2.0L * k->b * diagonal));
  th[0] = crank;
  th[1] = atan2l(y, x) + (left ? at : -at);
  th[2] =
    atan2l(k->a * sinl(crank) + k->b * sinl(th[1]), k->a * cosl(crank) + k->b * cosl(th[1]) - k->d);
}

static void build_linkage(sweep_scene *s, const linkage *k, const long double th[3])
{
  const double length[3] = {(double)k->a, (double)k->b, (double)k->c};
  long double q[SWEEP_NQ];
  baum_body_id body[3];
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_parts_gravity(&parts, s->gravity);
  linkage_q(k, th, q);
  for (int i = 0; i < 3; i++) {
    baum_planar_body_def def = rod_at(length[i], length[i], q + 3 * (ptrdiff_t)i);
    if (i == 0) {
      set_turning(&def, s->rate);
    }
    body[i] = baum_i_parts_body(&parts, &def);
  }
  baum_i_parts_pin(&parts, "A", (baum_i_spot){BAUM_GROUND, {0.0, 0.0}},
                   (baum_i_spot){body[0], {-length[0] / 2.0, 0.0}});
  baum_i_parts_pin(&parts, "B", (baum_i_spot){body[0], {length[0] / 2.0, 0.0}},
                   (baum_i_spot){body[1], {-length[1] / 2.0, 0.0}});
  baum_i_parts_pin(&parts, "C", (baum_i_spot){body[1], {length[1] / 2.0, 0.0}},
                   (baum_i_spot){body[2], {length[2] / 2.0, 0.0}});
  baum_i_parts_pin(&parts, "D", (baum_i_spot){BAUM_GROUND, {(double)k->d, 0.0}},
                   (baum_i_spot){body[2], {-length[2] / 2.0, 0.0}});
  sweep_must(model_finish(&parts, NULL, &s->m) == BAUM_OK, s->name);
}

static void follow_linkage(sweep_scene *s, const linkage *k, const long double th[3])
{
  sweep_motion m = {linkage_rate, linkage_q, k, 4, {th[0], th[1], th[2]}, 2, {{0.0L}, {0.0L}}};
  null_vector(k, th, m.direction[0]);
  m.y[3] = (long double)s->rate / m.direction[0][0];
  m.direction[1][3] = 1.0L;
  long double energy = linkage_energy(k, m.y);
  s->energy = (double)(energy - potential(k, th));
  sweep_follow(s, &m, true);
  sweep_must(linkage_fault(k, m.y, energy, (long double)s->energy) < 1e-11L,
             "four-bar off its energy");
}

typedef struct four_bar {
  const char *name;
  double lengths[4]; /* [m] crank, coupler, rocker and ground, exactly at a change point */
  int longer;        /* index of the length that is multiplied by 1 + by, to leave this point */
  double by;         /* [-] */
  bool left;
} four_bar;

static const four_bar FOUR_BARS[SWEEP_FOUR_BARS] = {
  {"parallelogram", {1.0, 2.0, 1.0, 2.0}, 1, 1e-3, false},
  {"parallelogram", {1.0, 2.0, 1.0, 2.0}, 1, -3e-3, false},
  {"parallelogram", {1.0, 2.0, 1.0, 2.0}, 2, 1e-2, false},
  {"parallelogram", {1.0, 1.5, 1.0, 1.5}, 3, 6e-3, false},
  {"kite", {1.0, 1.0, 2.0, 2.0}, 2, 3e-3, true},
  {"kite", {2.0, 2.0, 1.0, 1.0}, 1, -1e-2, true},
  {"crank-rocker", {1.0, 2.0, 3.0, 4.0}, 3, -2e-3, true},
  {"crank-rocker", {1.0, 2.0, 3.0, 4.0}, 3, 2e-3, true},
  {"drag link", {3.0, 2.0, 4.0, 1.0}, 2, 5e-3, true},
  {"drag link", {3.0, 2.0, 4.0, 1.0}, 2, -1e-3, true},
};

/* Makes a linkage for `turns` revolutions. It is so fast that gravity does not stop it. */
sweep_scene sweep_four_bar(int k, bool gravity, double turns)
{
  const four_bar *f = &FOUR_BARS[k];
  sweep_scene s = {.name = f->name, .parameter = f->by, .gravity = gravity ? GRAVITY : 0.0};
  double l[4];
  for (int i = 0; i < 4; i++) {
    l[i] = f->lengths[i] * (i == f->longer ? 1.0 + f->by : 1.0);
  }
  linkage at = {(long double)l[0], (long double)l[1], (long double)l[2], (long double)l[3],
                (long double)s.gravity};
  long double th[3];
  close_linkage(&at, 1.0L, f->left, th);
  s.nq = 9;
  s.rate = gravity ? 5.0 : 3.0;
  s.span = 2.0 * acos(-1.0) * turns / s.rate;
  set_units(&s, l[0]);
  build_linkage(&s, &at, th);
  follow_linkage(&s, &at, th);
  return s;
}

/* ---- taut rod ----
 *
 * A uniform rod has the mass mu, the length 1 m and the angle phi. One of its ends is at (x, 0),
 * and the other end carries a particle of 1 kg:
 *
 *   (mu + 1) x'' - (mu / 2 + 1) (sin phi phi'' + cos phi phi'^2) = 0
 *   -(mu / 2 + 1) sin phi x'' + (mu / 3 + 1) phi'' = 0
 */

/* Computes dy for the state y = (x, phi, x', phi'). */
static void taut_rate(const void *data, const long double *y, long double *dy)
{
  long double mu = (long double)*(const double *)data;
  long double m12 = -(mu / 2.0L + 1.0L) * sinl(y[1]);
  long double m22 = mu / 3.0L + 1.0L;
  long double force = (mu / 2.0L + 1.0L) * cosl(y[1]) * y[3] * y[3];
  /* This is m11 m22 - m12^2, in a form without cancellation. */
  long double cosine = cosl(y[1]);
  long double one = (mu / 2.0L + 1.0L) * cosine;
  long double det = mu / 3.0L + mu * mu / 12.0L + one * one;
  dy[0] = y[2];
  dy[1] = y[3];
  dy[2] = m22 * force / det;
  dy[3] = -m12 * force / det;
}

static void build_taut(sweep_scene *s, const double v[2])
{
  baum_planar_body_def rod = rod_def(s->parameter, 1.0);
  rod.position[0] = 0.4;
  rod.position[1] = -0.3;
  rod.angle = atan2(-0.6, 0.8);
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  bob.position[0] = 0.8;
  bob.position[1] = -0.6;
  memcpy(bob.velocity, v, sizeof bob.velocity);
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_parts_gravity(&parts, 0.0);
  baum_planar_pin_in_slot_def slot = baum_planar_pin_in_slot_def_default();
  slot.body_a = BAUM_GROUND;
  slot.body_b = baum_i_parts_body(&parts, &rod);
  slot.point_a[0] = slot.point_a[1] = slot.point_b[1] = 0.0;
  slot.point_b[0] = -0.5;
  sweep_must(baum_mechanism_add_planar_pin_in_slot(parts.mechanism, &slot, NULL) == BAUM_OK,
             s->name);
  baum_i_parts_pin(&parts, "pin", (baum_i_spot){slot.body_b, {0.5, 0.0}},
                   (baum_i_spot){baum_i_parts_particle(&parts, &bob), {0.0, 0.0}});
  sweep_must(model_finish(&parts, NULL, &s->m) == BAUM_OK, s->name);
}

static void taut_q(const void *data, const long double *y, long double *q)
{
  (void)data;
  place(q, 0, y[0] + cosl(y[1]) / 2.0L, sinl(y[1]) / 2.0L, y[1]);
  q[3] = y[0] + cosl(y[1]);
  q[4] = sinl(y[1]);
}

sweep_scene sweep_taut(double mass_ratio, bool growth)
{
  const double v[2] = {0.9558384584553545, -1.8884285084166446};
  sweep_scene s = {.name = "taut rod", .parameter = mass_ratio, .nq = 5, .span = 1.5};
  sweep_motion m = {.rate = taut_rate, .q = taut_q, .data = &mass_ratio, .n = 4, .directions = 4};
  set_units(&s, 1.0);
  build_taut(&s, v);
  m.y[1] = (long double)atan2(-0.6, 0.8);
  m.y[3] = (long double)v[1] / cosl(m.y[1]);
  m.y[2] = (long double)v[0] + sinl(m.y[1]) * m.y[3];
  for (int d = 0; d < 4; d++) {
    m.direction[d][d] = 1.0L;
  }
  s.rate = fabs((double)m.y[3]);
  s.energy = 0.5 * (v[0] * v[0] + v[1] * v[1]);
  sweep_follow(&s, &m, growth);
  return s;
}

/* ---- singular configurations ----
 *
 * On their smooth branch, all these scenes are described by one angle th. With constants i0, i1 and
 * k, it satisfies (i0 + i1 sin^2 th) th'' + i1 sin th cos th th'^2 + k cos th = 0.
 */

typedef struct swing {
  long double i0;
  long double i1;
  long double k;
} swing;

static void swing_rate(const void *data, const long double *y, long double *dy)
{
  const swing *s = data;
  long double sine = sinl(y[0]);
  long double cosine = cosl(y[0]);
  dy[0] = y[1];
  dy[1] = -(s->i1 * sine * cosine * y[1] * y[1] + s->k * cosine) / (s->i0 + s->i1 * sine * sine);
}

/* The IFToMM benchmark A02 with N = 1, from A Coruna's library of problems. Its rods have 1 m and 1
 * kg. At the start the cranks are upright, and their tips move to the right at 1 m/s. */
static void window_q(const void *data, const long double *y, long double *q)
{
  long double th = y[0];
  (void)data;
  place(q, 0, cosl(th) / 2.0L, sinl(th) / 2.0L, th);
  place(q, 1, cosl(th) + 0.5L, sinl(th), 0.0L);
  place(q, 2, 1.0L + cosl(th) / 2.0L, sinl(th) / 2.0L, th);
}

static baum_status build_window(model *m)
{
  model_n_four_bar data = model_n_four_bar_a02(1);
  return model_n_four_bar_build(&data, m);
}

static void cranks_q(const void *data, const long double *y, long double *q)
{
  long double th = y[0];
  (void)data;
  place(q, 0, cosl(th) / 2.0L, sinl(th) / 2.0L, th);
  place(q, 1, 2.0L + cosl(th) / 2.0L, sinl(th) / 2.0L, th);
  place(q, 2, 1.0L + cosl(th), sinl(th), 0.0L);
  place(q, 3, 1.0L + cosl(th) / 2.0L, sinl(th) / 2.0L, th);
}

static baum_status build_cranks(model *m)
{
  return model_parallelogram_build(MODEL_THREE_CRANKS, 1.0, m);
}

static void slider_q(const void *data, const long double *y, long double *q)
{
  long double th = y[0];
  (void)data;
  place(q, 0, cosl(th) / 2.0L, sinl(th) / 2.0L, th);
  place(q, 1, 1.5L * cosl(th), sinl(th) / 2.0L, -th);
  place(q, 2, 2.0L * cosl(th), 0.0L, 0.0L);
}

/* Builds a crank and a rod of 1 m each, and a slider. Every body has 1 kg. */
static baum_status build_slider(model *m)
{
  const long double start = 1.0L;
  baum_i_parts parts = baum_i_parts_begin();
  long double q[SWEEP_NQ];
  baum_body_id body[3];
  baum_i_parts_gravity(&parts, GRAVITY);
  slider_q(NULL, &start, q);
  for (int i = 0; i < 3; i++) {
    baum_planar_body_def def = rod_at(1.0, 1.0, q + 3 * (ptrdiff_t)i);
    if (i == 0) {
      set_turning(&def, 2.0);
    }
    body[i] = baum_i_parts_body(&parts, &def);
  }
  baum_i_parts_pin(&parts, "A", (baum_i_spot){BAUM_GROUND, {0.0, 0.0}},
                   (baum_i_spot){body[0], {-0.5, 0.0}});
  baum_i_parts_pin(&parts, "B", (baum_i_spot){body[0], {0.5, 0.0}},
                   (baum_i_spot){body[1], {-0.5, 0.0}});
  baum_i_parts_pin(&parts, "C", (baum_i_spot){body[1], {0.5, 0.0}},
                   (baum_i_spot){body[2], {0.0, 0.0}});
  baum_i_parts_guide(&parts, "guide", body[2], 0.0, 0.0);
  return model_finish(&parts, NULL, m);
}

typedef struct crossing {
  const char *name;
  int bodies;
  double start[2]; /* the angle and the angular velocity at the start */
  double gravity;  /* k divided by the acceleration of gravity */
  long double i0;
  long double i1;
  baum_status (*build)(model *m);
  void (*q)(const void *data, const long double *y, long double *q);
} crossing;

static const crossing CROSSINGS[SWEEP_SINGULAR] = {
  {"a02_nfourbar_N1",
   3,
   {1.5707963267948966, -1.0},
   2.0,
   5.0L / 3.0L,
   0.0L,
   build_window,
   window_q},
  {"three cranks", 4, {1.0, 2.0}, 3.5, 3.0L, 0.0L, build_cranks, cranks_q},
  {"equal slider-crank", 3, {1.0, 2.0}, 1.0, 2.0L / 3.0L, 6.0L, build_slider, slider_q},
};

sweep_scene sweep_singular(int k)
{
  const crossing *c = &CROSSINGS[k];
  sweep_scene s = {.name = c->name, .nq = 3 * c->bodies, .span = 10.0, .gravity = GRAVITY};
  swing at = {c->i0, c->i1, (long double)c->gravity * (long double)GRAVITY};
  sweep_motion m = {.rate = swing_rate, .q = c->q, .data = &at, .n = 2, .directions = 2};
  for (int d = 0; d < 2; d++) {
    m.y[d] = (long double)c->start[d];
    m.direction[d][d] = 1.0L;
  }
  s.rate = fabs(c->start[1]);
  s.energy = 0.5 * (double)(c->i0 + c->i1) * s.rate * s.rate;
  set_units(&s, 1.0);
  sweep_must(c->build(&s.m) == BAUM_OK, s.name);
  sweep_follow(&s, &m, true);
  return s;
}

void sweep_close(sweep_scene *scene)
{
  model_destroy(&scene->m);
}
