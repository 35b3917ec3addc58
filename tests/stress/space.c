/* SPDX-License-Identifier: BSD-3-Clause */
/* The positions r(x) and quaternions p(x) of all bodies are functions of one angle x(t). With
 * r' = dr/dx, w = 2 vec(p^-1 p'), the masses m and the inertias I, the equation of motion is
 *
 *   sum (m r'.r' + w.I w) x'' = sum (m g.r' - (m r'.r'' + w.I w') x'^2) + the spring's force
 *
 * Here w' = 2 vec(p^-1 p''). The gyroscopic moment does no work.
 */
#include "space.h"

#include <baum/catalog.h>
#include <math.h>
#include <string.h>

#include "carried.h"
#include "elements.h"
#include "tilt.h"

/* ---- data: the defaults of the catalogue ---- */

static const long double CRANK = 0.08L;
static const long double ROD = 0.3L;
static const long double BESIDE = 0.1L;
static const long double ABOVE = 0.12L;
static const long double ANCHOR = 1; /* [m] x of the end of the spring that is on the ground */

static const long double SHORT_CRANK = 0.1L;
static const long double COUPLER = 0.4L;
static const long double ROCKER = 0.25L;
static const long double PIVOT[3] = {0.2L, 0.3L, 0.05L};

static const double TOP_MASS = 15.0;
static const double TOP_RADIUS = 0.25;

enum { RODS = 5 };
static const long double EDGE[RODS][3] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}};
static const int AXIS[RODS] = {1, 2, 0, 1, 2};

bool space_is(const scene *s)
{
  return s->tilted || s->kind > SCENE_CHAIN;
}

int space_bodies(const scene *s)
{
  return s->kind > SCENE_TOP        ? elements_bodies(s)
         : s->kind == SCENE_TOP     ? 1
         : s->kind == SCENE_BRICARD ? RODS
                                    : 3;
}

/* Returns the angular velocity of precession. A top with a horizontal axis precesses steadily at m
 * g l / (C n). Here m is the mass, l = 1 m is the distance of the centre of mass from the fixed
 * point, C is the axial moment of inertia, and n is the spin. */
static double precession(const scene *s)
{
  double axial = TOP_MASS * TOP_RADIUS * TOP_RADIUS / 2;
  return TOP_MASS * s->gravity / (axial * s->rate);
}

/* ---- mechanisms ---- */

/* Returns axes whose origin is `from`, whose x axis points to `to`, and whose z axis is
 * perpendicular to the x axis of the ground. */
static carried between(const carried *from, const carried *to)
{
  jets d[3];
  carried out = carried_at(0, 0, 0);
  memcpy(out.r, from->r, sizeof out.r);
  for (int i = 0; i < 3; i++) {
    d[i] = jets_less(to->r[i], from->r[i]);
  }
  jets aside = jets_root(jets_add(jets_times(d[1], d[1]), jets_times(d[2], d[2])));
  carried_turn(&out, 0, jets_angle(d[1], d[2]));
  carried_turn(&out, 2, jets_angle(d[0], aside));
  return out;
}

static carried crank_body(int body, jets x)
{
  carried tip = carried_at(0, BESIDE, ABOVE);
  carried_turn(&tip, 0, x);
  carried_go(&tip, 0, 0, body == 0 ? CRANK / 2 : CRANK);
  if (body == 0) {
    return tip;
  }
  carried slider = carried_at(0, 0, 0);
  jets square = jets_add(jets_times(tip.r[1], tip.r[1]), jets_times(tip.r[2], tip.r[2]));
  slider.r[0] = jets_root(jets_less(jets_constant(ROD * ROD), square));
  if (body == 2) {
    return slider;
  }
  carried rod = between(&tip, &slider);
  carried_go(&rod, ROD / 2, 0, 0);
  return rod;
}

/* The angle b of the rocker is the solution of d[1] cos b + d[2] sin b = c. Here d is the vector
 * from the tip of the crank to the pivot of the rocker, and c follows from d and the lengths of
 * coupler and rocker. */
static carried rssr_body(int body, jets x)
{
  carried tip = carried_at(0, 0, 0);
  carried_turn(&tip, 2, x);
  carried_go(&tip, body == 0 ? SHORT_CRANK / 2 : SHORT_CRANK, 0, 0);
  if (body == 0) {
    return tip;
  }
  carried end = carried_at(PIVOT[0], PIVOT[1], PIVOT[2]);
  jets c = jets_constant((COUPLER * COUPLER - ROCKER * ROCKER) / (2 * ROCKER));
  jets d[3];
  for (int i = 0; i < 3; i++) {
    d[i] = jets_less(end.r[i], tip.r[i]);
    c = jets_less(c, jets_scale(0.5L / ROCKER, jets_times(d[i], d[i])));
  }
  jets square = jets_add(jets_times(d[1], d[1]), jets_times(d[2], d[2]));
  jets aside = jets_root(jets_less(square, jets_times(c, c)));
  carried_turn(&end, 0, jets_less(jets_angle(d[1], d[2]), jets_angle(c, aside)));
  carried_go(&end, 0, body == 2 ? ROCKER / 2 : ROCKER, 0);
  if (body == 2) {
    return end;
  }
  carried coupler = between(&tip, &end);
  carried_go(&coupler, COUPLER / 2, 0, 0);
  return coupler;
}

/* The angles of the joints are a, b, a, b, a. The angle b follows from sin a + sin b + sin a sin
 * b = 0. */
static carried bricard_body(int body, jets a)
{
  jets sine = jets_sin(a);
  jets minus = jets_scale(-1, jets_times(sine, jets_inverse(jets_add(jets_constant(1), sine))));
  jets cosine = jets_root(jets_less(jets_constant(1), jets_times(minus, minus)));
  jets b = jets_angle(cosine, minus);
  carried c = carried_at(0, 0, 0);
  for (int k = 0; k <= body; k++) {
    long double part = k < body ? 1 : 0.5L;
    carried_turn(&c, AXIS[k], k % 2 ? b : a);
    carried_go(&c, part * EDGE[k][0], part * EDGE[k][1], part * EDGE[k][2]);
  }
  return c;
}

static carried top_body(const scene *s, jets x)
{
  carried c = carried_at(0, 0, 0);
  carried_turn(&c, 2, jets_scale((long double)precession(s) / s->rate, x));
  carried_turn(&c, 1, x);
  carried_go(&c, 0, 1, 0);
  return c;
}

static carried body_of(const scene *s, int body, long double x)
{
  jets angle = {{x, 1, 0}};
  switch ((int)s->kind) {
  case SCENE_SPATIAL_CRANK: return crank_body(body, angle);
  case SCENE_RSSR: return rssr_body(body, angle);
  case SCENE_BRICARD: return bricard_body(body, angle);
  case SCENE_TOP: return top_body(s, angle);
  default: return elements_body(s, body, angle);
  }
}

static void give_pose(const carried *c, long double pose[SPACE_NUMBERS])
{
  for (int i = 0; i < 3; i++) {
    pose[i] = c->r[i].d[0];
  }
  for (int i = 0; i < 4; i++) {
    pose[3 + i] = c->p[i].d[0];
  }
}

void space_pose(const scene *s, int body, long double x, long double pose[SPACE_NUMBERS])
{
  carried c = body_of(s, body, x);
  give_pose(&c, pose);
}

/* ---- the equation ---- */

/* Returns the mass and the moments of inertia of a body. */
static void inertia_of(const scene *s, int body, long double out[4])
{
  static const long double crank[3][4] = {
    {0.12L, 1e-4L, 1e-4L, 1e-4L}, {0.5L, 4e-4L, 4e-3L, 4e-3L}, {2.0L, 1e-3L, 1e-3L, 1e-3L}};
  if (s->kind == SCENE_SPATIAL_CRANK) {
    memcpy(out, crank[body], sizeof crank[body]);
    out[0] *= body == 2 ? s->ratio : 1;
    return;
  }
  if (s->kind > SCENE_TOP) {
    elements_inertia(s, body, out);
    return;
  }
  out[0] = 1;
  for (int i = 0; i < 3; i++) {
    out[i + 1] = (EDGE[body][i] == 0 ? 1 : (long double)s->ratio) / 12;
  }
}

/* Returns the free length of the spring [m]. This is its length at the angle 0.1 rad before the
 * start, rounded to double as in the mechanism. */
static long double relaxed_length(const scene *s)
{
  jets at = crank_body(2, (jets){{s->angle - 0.1L, 1, 0}}).r[0];
  return (double)(ANCHOR - at.d[0]);
}

long double space_acceleration(const scene *s, long double x, long double v)
{
  long double mass = 0;
  long double force = 0;
  if (s->kind == SCENE_TOP || s->kind == SCENE_RSSR || s->kind == SCENE_DISC) {
    return 0;
  }
  for (int k = 0; k < space_bodies(s); k++) {
    carried c = body_of(s, k, x);
    long double m[4];
    long double w[3];
    long double dw[3];
    inertia_of(s, k, m);
    carried_spin(&c, 1, w);
    carried_spin(&c, 2, dw);
    for (int i = 0; i < 3; i++) {
      mass += m[0] * c.r[i].d[1] * c.r[i].d[1] + m[i + 1] * w[i] * w[i];
      force -= (m[0] * c.r[i].d[1] * c.r[i].d[2] + m[i + 1] * w[i] * dw[i]) * v * v;
    }
    force -= m[0] * s->gravity * c.r[s->kind == SCENE_BRICARD ? 1 : 2].d[1];
  }
  if (s->kind == SCENE_BUSHING || s->kind == SCENE_BEAD) {
    force += elements_torque(s, x, v);
  } else if (s->stiffness != 0.0 || s->damping != 0.0) {
    jets at = crank_body(2, (jets){{x, 1, 0}}).r[0];
    long double stretched = ANCHOR - at.d[0] - relaxed_length(s);
    force += (s->stiffness * stretched - s->damping * at.d[1] * v) * at.d[1];
  }
  return force / mass;
}

/* ---- building ---- */

/* Returns the factor from SI units to the units of the scene. */
static double factor_of(const char *unit, const model_units *u)
{
  double length = u->length;
  double mass = u->mass;
  double time = u->time;
  return strcmp(unit, "m") == 0        ? length
         : strcmp(unit, "kg") == 0     ? mass
         : strcmp(unit, "kg m^2") == 0 ? mass * length * length
         : strcmp(unit, "m/s^2") == 0  ? length / (time * time)
         : strcmp(unit, "rad/s") == 0  ? 1.0 / time
                                       : 1.0;
}

/* Returns the value of a parameter in SI units. */
static double value_of(const scene *s, const baum_catalog_parameter *p)
{
  bool is_top = s->kind == SCENE_TOP;
  return strcmp(p->name, "slider_mass") == 0 || strcmp(p->name, "rocker_mass") == 0
           ? p->value * s->ratio
         : strcmp(p->name, "axial") == 0              ? s->ratio
         : strcmp(p->name, "angle") == 0              ? s->angle
         : strcmp(p->name, "speed") == 0              ? s->rate
         : strcmp(p->name, "spin") == 0               ? s->rate
         : strcmp(p->name, "precession") == 0         ? precession(s)
         : is_top && strcmp(p->name, "distance") == 0 ? 1.0
                                                      : p->value;
}

static baum_status add_spring(const scene *s, baum_mechanism **m)
{
  const model_units *u = &s->units;
  baum_mechanism *copy = NULL;
  baum_spatial_spring_def def = baum_spatial_spring_def_default();
  baum_status status = baum_mechanism_copy(*m, &copy);
  def.body_a = BAUM_GROUND;
  def.body_b = baum_mechanism_body_at(*m, 2);
  def.stiffness = s->stiffness * u->mass / (u->time * u->time);
  def.damping = s->damping * u->mass / u->time;
  def.free_length = (double)relaxed_length(s) * u->length;
  for (int i = 0; i < 3; i++) {
    def.point_a[i] = i == 0 ? (double)ANCHOR * u->length : 0.0;
    def.point_b[i] = 0.0;
  }
  status = status == BAUM_OK ? baum_mechanism_add_spatial_spring(copy, &def, NULL) : status;
  status = status == BAUM_OK ? baum_mechanism_freeze(copy) : status;
  baum_mechanism_destroy(*m);
  *m = copy;
  return status;
}

baum_status space_build(const scene *s, baum_mechanism **out)
{
  static const char *const ENTRIES[] = {"spatial_slider_crank", "rssr", "bricard", "heavy_top"};
  enum { MOST = 16 };
  if (s->kind > SCENE_TOP) {
    return elements_build(s, out);
  }
  baum_catalog_setting settings[MOST];
  baum_catalog_parameter p[MOST];
  baum_catalog_choice choice = {ENTRIES[s->kind - SCENE_SPATIAL_CRANK], settings, 0};
  while (choice.setting_count < MOST &&
         baum_catalog_parameter_at(choice.name, choice.setting_count, &p[choice.setting_count],
                                   sizeof *p) == BAUM_OK) {
    const baum_catalog_parameter *of = &p[choice.setting_count];
    settings[choice.setting_count++] =
      (baum_catalog_setting){of->name, value_of(s, of) * factor_of(of->unit, &s->units)};
  }
  baum_status status = baum_catalog_build(&choice, out);
  bool sprung = s->stiffness != 0.0 || s->damping != 0.0;
  return status == BAUM_OK && sprung ? add_spring(s, out) : status;
}

/* ---- poses ---- */

void space_tilt(const long double flat[3], long double pose[SPACE_NUMBERS])
{
  const double plane[3] = {0.0, 0.0, 0.0};
  double at[SPACE_NUMBERS];
  model_tilt_body(plane, at); /* origin and orientation of the plane */
  carried c = carried_at(0, 0, 0);
  for (int i = 0; i < 4; i++) {
    c.p[i] = jets_constant(at[3 + i]);
  }
  carried_go(&c, flat[0], flat[1], 0);
  carried_turn(&c, 2, jets_constant(flat[2]));
  give_pose(&c, pose);
}

double space_distance(const long double *a, const long double *b, double scale)
{
  long double most = 0;
  long double square = 0;
  for (int i = 0; i < 3; i++) {
    long double off = fabsl(a[i] - b[i]) / scale;
    int j = i + 4;
    int k = (i + 1) % 3 + 4;
    int l = (i + 2) % 3 + 4;
    long double half = a[3] * b[j] - a[j] * b[3] - a[k] * b[l] + a[l] * b[k];
    square += half * half;
    most = off > most || isnan(off) ? off : most;
  }
  long double same = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6];
  long double turned = 2 * atan2l(sqrtl(square), fabsl(same));
  return (double)(turned > most || isnan(turned) ? turned : most);
}
