/* SPDX-License-Identifier: BSD-3-Clause */
/* Generates random scenes. Links are placed first. Then joints are placed where links meet, so that
 * the design configuration satisfies the constraints. The velocities are random and are then
 * projected, so that they satisfy the constraints. Lengths are about 1 m. */
#include "judge_scene.h"

#include <math.h>
#include <string.h>

#include "judge_equations.h"

static const double PI = 3.14159265358979323846;

/* A scene that is being generated, and the choices that apply to the whole scene. */
typedef struct pen {
  judge_scene *s;
  judge_dice dice;
  double spread;  /* log10 of the largest ratio of two masses */
  bool frictions; /* whether there are dampers */
} pen;

/* ---- random numbers ---- */

static uint64_t roll(judge_dice *d)
{
  d->state ^= d->state >> 12;
  d->state ^= d->state << 25;
  d->state ^= d->state >> 27;
  return d->state * 0x2545F4914F6CDD1Du;
}

static judge_dice dice_of(uint64_t seed)
{
  judge_dice d = {(seed + 1) * 0x9E3779B97F4A7C15u};
  for (int k = 0; k < 8; k++) {
    (void)roll(&d);
  }
  return d;
}

double judge_between(judge_dice *d, double from, double to)
{
  return from + (to - from) * (double)(roll(d) >> 11) / 9007199254740992.0;
}

int judge_below(judge_dice *d, int count)
{
  return (int)judge_between(d, 0.0, (double)count);
}

bool judge_chance(judge_dice *d, double share)
{
  return judge_between(d, 0.0, 1.0) < share;
}

static double draw_decades(judge_dice *d, double from, double to)
{
  return pow(10.0, judge_between(d, from, to));
}

void judge_law(const judge_joint *joint, double t, double s[3])
{
  const double *law = joint->law;
  double angle = law[3] * t + law[4];
  s[0] = law[0] + law[1] * t + law[2] * sin(angle);
  s[1] = law[1] + law[2] * law[3] * cos(angle);
  s[2] = -law[2] * law[3] * law[3] * sin(angle);
}

/* ---- bodies ---- */

static void local_of(const judge_scene *s, int body, const double world[2], double out[2])
{
  double d[2] = {world[0], world[1]};
  double angle = 0.0;
  if (body != JUDGE_GROUND) {
    d[0] -= s->bodies[body].pose[0];
    d[1] -= s->bodies[body].pose[1];
    angle = s->bodies[body].pose[2];
  }
  out[0] = cos(angle) * d[0] + sin(angle) * d[1];
  out[1] = -sin(angle) * d[0] + cos(angle) * d[1];
}

/* Writes a point of a rod. `share` is -0.5 at its start, and 0.5 at its tip. */
static void point_on(const judge_scene *s, int body, double share, double out[2])
{
  const judge_body *b = &s->bodies[body];
  out[0] = b->pose[0] + share * b->length * cos(b->pose[2]);
  out[1] = b->pose[1] + share * b->length * sin(b->pose[2]);
}

static double draw_mass(pen *p)
{
  bool least = judge_chance(&p->dice, 0.3);
  return least ? pow(10.0, -p->spread) : draw_decades(&p->dice, -p->spread, 0.0);
}

static int add_body(pen *p, const judge_body *b)
{
  judge_scene *s = p->s;
  s->bodies[s->body_count] = *b;
  s->bodies[s->body_count].first = s->n;
  s->n += b->particle ? 2 : 3;
  return s->body_count++;
}

/* Adds a rod from one point to another. */
static int add_rod(pen *p, const double from[2], const double to[2])
{
  double d[2] = {to[0] - from[0], to[1] - from[1]};
  judge_body b = {.mass = draw_mass(p), .length = hypot(d[0], d[1])};
  b.inertia = b.mass * b.length * b.length * judge_between(&p->dice, 0.04, 0.15);
  b.pose[0] = 0.5 * (from[0] + to[0]);
  b.pose[1] = 0.5 * (from[1] + to[1]);
  b.pose[2] = atan2(d[1], d[0]);
  return add_body(p, &b);
}

static int add_particle(pen *p, const double at[2])
{
  judge_body b = {.particle = true, .mass = draw_mass(p), .pose = {at[0], at[1], 0.0}};
  return add_body(p, &b);
}

/* ---- joints ---- */

static judge_joint *add_joint(pen *p, judge_kind kind, int a, int b)
{
  judge_joint *j = &p->s->joints[p->s->joint_count++];
  *j = (judge_joint){.kind = kind, .a = a, .b = b, .axis = {1.0, 0.0}, .of = -1};
  p->s->rows += kind == JUDGE_REVOLUTE || kind == JUDGE_TRANSLATIONAL ? 2 : 1;
  return j;
}

static void add_pin(pen *p, int a, int b, const double at[2])
{
  judge_joint *j = add_joint(p, JUDGE_REVOLUTE, a, b);
  local_of(p->s, a, at, j->point_a);
  local_of(p->s, b, at, j->point_b);
}

static double angle_of(const judge_scene *s, int body)
{
  return body == JUDGE_GROUND ? 0.0 : s->bodies[body].pose[2];
}

/* Adds a slot or a translational joint at a point. Its axis is fixed on body a and is at `angle` to
 * the x axis of the ground. */
static void add_slider(pen *p, judge_kind kind, int a, int b, const double at[2], double angle)
{
  judge_joint *j = add_joint(p, kind, a, b);
  local_of(p->s, a, at, j->point_a);
  local_of(p->s, b, at, j->point_b);
  j->axis[0] = cos(angle - angle_of(p->s, a));
  j->axis[1] = sin(angle - angle_of(p->s, a));
  j->kept = angle_of(p->s, b) - angle_of(p->s, a);
}

static void add_distance(pen *p, int a, const double at_a[2], int b, const double at_b[2])
{
  double length = hypot(at_b[0] - at_a[0], at_b[1] - at_a[1]);
  if (length > 0.05) {
    judge_joint *j = add_joint(p, JUDGE_DISTANCE, a, b);
    local_of(p->s, a, at_a, j->point_a);
    local_of(p->s, b, at_b, j->point_b);
    j->kept = length;
  }
}

static int draw_body(pen *p, bool ground)
{
  int from = ground ? 1 : 0;
  return judge_below(&p->dice, p->s->body_count + from) - from;
}

static void draw_point(pen *p, int body, double out[2])
{
  if (body == JUDGE_GROUND) {
    out[0] = judge_between(&p->dice, -1.0, 1.5);
    out[1] = judge_between(&p->dice, -0.8, 0.8);
  } else {
    bool tip = judge_chance(&p->dice, 0.5);
    point_on(p->s, body, tip ? 0.5 : judge_between(&p->dice, -0.5, 0.5), out);
  }
}

static void from_polar(const double from[2], double radius, double angle, double out[2])
{
  out[0] = from[0] + radius * cos(angle);
  out[1] = from[1] + radius * sin(angle);
}

/* ---- springs ---- */

/* Returns the smaller one of the masses or moments of inertia of two bodies. If one of them is the
 * ground, returns the value of the other body. */
static double lighter(const judge_scene *s, int a, int b, bool inertia)
{
  double least = INFINITY;
  for (int k = 0; k < 2; k++) {
    int body = k == 0 ? a : b;
    if (body != JUDGE_GROUND) {
      least = fmin(least, inertia ? s->bodies[body].inertia : s->bodies[body].mass);
    }
  }
  return least;
}

static void add_spring(pen *p, int a, int b, bool torsion)
{
  judge_scene *s = p->s;
  double at[2][2];
  draw_point(p, a, at[0]);
  draw_point(p, b, at[1]);
  double length = hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]);
  if (a == b || s->spring_count == JUDGE_SPRINGS || (!torsion && length < 0.3)) {
    return;
  }
  judge_spring *g = &s->springs[s->spring_count++];
  *g = (judge_spring){.torsion = torsion, .a = a, .b = b};
  local_of(s, a, at[0], g->point_a);
  local_of(s, b, at[1], g->point_b);
  double m = lighter(s, a, b, torsion);
  double omega = judge_between(&p->dice, 1.0, 15.0);
  g->stiffness = m * omega * omega;
  g->damping = p->frictions ? m * omega * judge_between(&p->dice, 0.0, 0.6) : 0.0;
  g->free = torsion ? angle_of(s, b) - angle_of(s, a) + judge_between(&p->dice, -1.0, 1.0)
                    : length * judge_between(&p->dice, 0.6, 1.1);
}

static bool is_particle(const judge_scene *s, int body)
{
  return body != JUDGE_GROUND && s->bodies[body].particle;
}

static void add_springs(pen *p)
{
  int count = judge_below(&p->dice, 3);
  for (int k = 0; k < count; k++) {
    int a = draw_body(p, true);
    int b = draw_body(p, false);
    bool round = !is_particle(p->s, a) && !is_particle(p->s, b);
    add_spring(p, a, b, round && judge_chance(&p->dice, 0.3));
  }
}

/* ---- families ---- */

static void add_attached(pen *p, int parent, const double at[2], const double to[2])
{
  judge_dice *d = &p->dice;
  double kind = judge_between(d, 0.0, 1.0);
  double angle = judge_between(d, 0.0, 2.0 * PI);
  bool particle = judge_chance(d, 0.25);
  double begin[2] = {at[0], at[1]};
  if (particle) { /* the particle slides in a slot, or hangs on a rod or a spring */
    bool slides = kind < 0.4 && !is_particle(p->s, parent);
    int body = add_particle(p, slides ? at : to);
    if (slides) {
      add_slider(p, JUDGE_SLOT, parent, body, at, angle);
    } else if (kind < 0.9) {
      add_distance(p, parent, at, body, to);
    } else {
      add_spring(p, parent, body, false);
    }
    return;
  }
  int body = add_rod(p, begin, to);
  if (kind < 0.66 || is_particle(p->s, parent)) {
    add_pin(p, parent, body, at);
  } else if (kind < 0.78) {
    add_slider(p, JUDGE_SLOT, parent, body, at, angle);
  } else if (kind < 0.84 && parent != JUDGE_GROUND) {
    add_slider(p, JUDGE_SLOT, body, parent, at, angle_of(p->s, body));
  } else if (kind < 0.93) {
    add_slider(p, JUDGE_TRANSLATIONAL, parent, body, at, angle);
  } else {
    from_polar(at, -judge_between(d, 0.3, 1.0), angle, begin);
    add_distance(p, parent, begin, body, at);
  }
}

static void grow_tree(pen *p, int count)
{
  for (int k = 0; k < count; k++) {
    bool free = p->s->body_count == 0 || judge_chance(&p->dice, 0.15);
    int parent = free ? JUDGE_GROUND : p->s->body_count - 1;
    if (!free && judge_chance(&p->dice, 0.3)) {
      parent = draw_body(p, false);
    }
    double at[2];
    double to[2];
    draw_point(p, parent, at);
    from_polar(at, judge_between(&p->dice, 0.3, 1.2), judge_between(&p->dice, 0.0, 2.0 * PI), to);
    add_attached(p, parent, at, to);
  }
  int loads = judge_below(&p->dice, 4);
  if (loads == 0 && p->s->body_count > 0) { /* add a bob at the tip of the last rod */
    int body = p->s->body_count - 1;
    double at[2];
    point_on(p->s, body, 0.5, at);
    if (!is_particle(p->s, body)) {
      add_pin(p, body, add_particle(p, at), at);
    }
  }
}

/* Writes the point where a rod of length ra from a meets a rod of length rb from b. Returns false
 * if they cannot meet. */
static bool meet(const double a[2], double ra, const double b[2], double rb, double out[2])
{
  double d[2] = {b[0] - a[0], b[1] - a[1]};
  double length = hypot(d[0], d[1]);
  double along = (ra * ra - rb * rb + length * length) / (2.0 * length);
  double square = ra * ra - along * along;
  if (!(square > 1e-4)) {
    return false;
  }
  double up = sqrt(square);
  out[0] = a[0] + (along * d[0] - up * d[1]) / length;
  out[1] = a[1] + (along * d[1] + up * d[0]) / length;
  return true;
}

/* Adds a chain of rods through points. Pins connect its start, and its end if `closed` is set, to
 * the ground. */
static void add_chain(pen *p, double points[][2], int count, bool closed)
{
  int before = JUDGE_GROUND;
  for (int k = 0; k + 1 < count; k++) {
    int body = add_rod(p, points[k], points[k + 1]);
    add_pin(p, before, body, points[k]);
    before = body;
  }
  if (closed) {
    add_pin(p, before, JUDGE_GROUND, points[count - 1]);
  }
}

static bool draw_four_bar(pen *p, bool near)
{
  judge_dice *d = &p->dice;
  double link[4];
  for (int k = 0; k < 3; k++) {
    link[k] = judge_between(d, 0.3, 1.3);
  }
  link[3] = judge_between(d, 0.4, 1.5);
  /* Near a change point, the longest and the shortest link are together almost as long as the two
   * others. */
  if (near) {
    double off = draw_decades(d, -3.0, -1.3) * (judge_chance(d, 0.5) ? 1.0 : -1.0);
    link[0] = judge_between(d, 0.25, 0.7);
    link[1] = judge_between(d, link[0], 1.3);
    link[2] = judge_between(d, link[0], 1.3);
    link[3] = (link[1] + link[2] - link[0]) * (1.0 + off);
  }
  double points[4][2] = {{0}};
  points[3][0] = link[3];
  from_polar(points[0], link[0], judge_between(d, 0.0, 2.0 * PI), points[1]);
  if (!meet(points[1], link[1], points[3], link[2], points[2])) {
    return false;
  }
  add_chain(p, points, 4, true);
  return true;
}

static bool draw_five_bar(pen *p)
{
  judge_dice *d = &p->dice;
  double points[5][2] = {{0}};
  points[4][0] = judge_between(d, 0.3, 1.5);
  from_polar(points[0], judge_between(d, 0.3, 1.0), judge_between(d, 0.0, 2.0 * PI), points[1]);
  from_polar(points[4], judge_between(d, 0.3, 1.0), judge_between(d, 0.0, 2.0 * PI), points[3]);
  if (!meet(points[1], judge_between(d, 0.4, 1.4), points[3], judge_between(d, 0.4, 1.4),
            points[2])) {
    return false;
  }
  add_chain(p, points, 5, true);
  add_spring(p, JUDGE_GROUND, draw_body(p, false), true);
  add_spring(p, 0, 2, false);
  return true;
}

static bool draw_slider_crank(pen *p)
{
  judge_dice *d = &p->dice;
  double crank = judge_between(d, 0.2, 0.7);
  double rod = judge_chance(d, 0.25) ? crank * (1.0 + draw_decades(d, -3.0, -1.0))
                                     : judge_between(d, crank, 1.4);
  double off = judge_chance(d, 0.5) ? 0.0 : judge_between(d, -0.3, 0.3);
  double points[3][2] = {{0}};
  from_polar(points[0], crank, judge_between(d, 0.0, 2.0 * PI), points[1]);
  double drop = points[1][1] - off;
  if (!(rod * rod > drop * drop + 1e-4)) {
    return false;
  }
  points[2][0] = points[1][0] + sqrt(rod * rod - drop * drop);
  points[2][1] = off;
  add_chain(p, points, 3, false);
  int kind = judge_below(d, 3);
  if (kind == 0) {
    add_slider(p, JUDGE_SLOT, JUDGE_GROUND, 1, points[2], 0.0);
  } else if (kind == 1) {
    int bob = add_particle(p, points[2]);
    add_pin(p, 1, bob, points[2]);
    add_slider(p, JUDGE_SLOT, JUDGE_GROUND, bob, points[2], 0.0);
  } else {
    double end[2] = {points[2][0] + 0.2, points[2][1]};
    int block = add_rod(p, points[2], end);
    add_pin(p, 1, block, points[2]);
    add_slider(p, JUDGE_TRANSLATIONAL, JUDGE_GROUND, block, points[2], 0.0);
  }
  return true;
}

/* Generates a tree. A distance joint or a slot between two of its bodies then closes a loop. */
static bool draw_loop(pen *p)
{
  grow_tree(p, 2 + judge_below(&p->dice, 3));
  int a = draw_body(p, true);
  int b = draw_body(p, false);
  if (a == b) {
    return false;
  }
  double at[2][2];
  draw_point(p, a, at[0]);
  draw_point(p, b, at[1]);
  if (judge_chance(&p->dice, 0.3) && !is_particle(p->s, a)) {
    add_slider(p, JUDGE_SLOT, a, b, at[1], judge_between(&p->dice, 0.0, PI));
  } else {
    add_distance(p, a, at[0], b, at[1]);
  }
  return true;
}

/* Generates a light rod between a slot in the ground and a bob. The bob moves almost freely until
 * the rod is perpendicular to the slot. Then the velocity of the bob changes abruptly, as if it
 * hung on a string that becomes taut. */
static void draw_taut(pen *p)
{
  judge_dice *d = &p->dice;
  double from[2];
  double to[2];
  draw_point(p, JUDGE_GROUND, from);
  from_polar(from, judge_between(d, 0.4, 1.2), judge_between(d, 0.0, 2.0 * PI), to);
  p->spread = judge_between(d, 1.0, 4.0);
  int rod = add_rod(p, from, to);
  double light = pow(10.0, -p->spread) / p->s->bodies[rod].mass;
  p->s->bodies[rod].mass *= light;
  p->s->bodies[rod].inertia *= light;
  p->spread = 0.0;
  int bob = add_particle(p, to);
  add_slider(p, JUDGE_SLOT, JUDGE_GROUND, rod, from, judge_between(d, 0.0, PI));
  add_pin(p, rod, bob, to);
}

static bool draw_family(pen *p)
{
  judge_dice *d = &p->dice;
  double kind = judge_between(d, 0.0, 1.0);
  if (kind < 0.04) {
    p->s->family = "taut";
    draw_taut(p);
    return true;
  }
  if (kind < 0.40) {
    p->s->family = "tree";
    grow_tree(p, 1 + judge_below(d, 5));
    return true;
  }
  if (kind < 0.55) {
    p->s->family = "loop";
    return draw_loop(p);
  }
  if (kind < 0.78) {
    bool near = kind > 0.73;
    p->s->family = near ? "change point" : "four-bar";
    return draw_four_bar(p, near);
  }
  if (kind < 0.88) {
    p->s->family = "five-bar";
    return draw_five_bar(p);
  }
  p->s->family = "slider-crank";
  return draw_slider_crank(p);
}

/* ---- drivers, loads, start ---- */

static void add_driver(pen *p)
{
  judge_scene *s = p->s;
  int of = judge_below(&p->dice, s->joint_count);
  judge_joint j = s->joints[of];
  bool angle = j.kind == JUDGE_REVOLUTE;
  bool fits = (angle && !is_particle(s, j.a) && !is_particle(s, j.b)) || j.kind == JUDGE_SLOT;
  if (!fits || s->n - s->rows < 2) {
    return;
  }
  j.kind = angle ? JUDGE_DRIVE_ANGLE : JUDGE_DRIVE_SLIDE;
  j.of = of;
  bool swings = !angle || judge_chance(&p->dice, 0.6);
  j.law[1] = swings ? 0.0 : judge_between(&p->dice, -6.0, 6.0);
  j.law[2] = swings ? judge_between(&p->dice, 0.05, angle ? 1.0 : 0.4) : 0.0;
  j.law[3] = judge_between(&p->dice, 1.0, 6.0);
  j.law[4] = judge_between(&p->dice, 0.0, 2.0 * PI);
  j.law[0] = (angle ? angle_of(s, j.b) - angle_of(s, j.a) : 0.0) - j.law[2] * sin(j.law[4]);
  s->joints[s->joint_count++] = j;
  s->rows++;
  s->conservative = false;
  s->driven = true;
}

static void add_load(pen *p)
{
  int body = draw_body(p, false);
  double most = p->s->bodies[body].mass * 6.0;
  if (!p->s->bodies[body].particle) {
    p->s->load_body = body;
    for (int i = 0; i < 3; i++) {
      p->s->load[i] = judge_between(&p->dice, -most, most) * (i < 2 ? 1.0 : 0.05);
    }
    p->s->conservative = false;
  }
}

static bool find_start(pen *p)
{
  judge_scene *s = p->s;
  judge_dice *d = &p->dice;
  double least = INFINITY;
  double most = 0.0;
  bool rests = judge_chance(d, 0.15) && s->gravity > 0.0;
  double speed = rests ? 0.0 : draw_decades(d, -0.5, 0.6);
  double squares = 0.0;
  for (int k = 0; k < s->body_count; k++) {
    const judge_body *b = &s->bodies[k];
    memcpy(s->q + b->first, b->pose, (b->particle ? 2 : 3) * sizeof *s->q);
    least = fmin(least, b->mass);
    most = fmax(most, b->mass);
  }
  s->mass_ratio = least / most;
  for (int i = 0; i < s->n; i++) {
    s->v[i] = speed * judge_between(d, -1.0, 1.0);
  }
  if (s->n < s->rows || !judge_project(s, 0.0, true, s->q, s->v)) {
    return false;
  }
  for (int i = 0; i < s->n; i++) {
    squares += s->v[i] * s->v[i] / s->n;
  }
  double rate = fmax(fmax(sqrt(s->gravity), sqrt(squares)), 1.0);
  double end = fmin(judge_between(d, 0.8, 3.0) * 2.0 * PI / rate, 6.0);
  s->end = 0.1 * ceil(10.0 * end);
  return true;
}

static bool draw_once(judge_scene *s, uint64_t seed, int attempt)
{
  pen p = {.s = s, .dice = dice_of(seed * 64 + (uint64_t)attempt)};
  *s = (judge_scene){.seed = seed, .load_body = JUDGE_GROUND, .conservative = true};
  const double spreads[] = {0.0, 1.0, 2.0, 3.0, 3.0, 4.0};
  p.spread = spreads[judge_below(&p.dice, 6)];
  p.frictions = judge_chance(&p.dice, 0.3);
  s->gravity = judge_chance(&p.dice, 0.8) ? 9.81 : 0.0;
  if (!draw_family(&p)) {
    return false;
  }
  add_springs(&p);
  if (judge_chance(&p.dice, 0.25)) {
    add_driver(&p);
  }
  if (judge_chance(&p.dice, 0.12)) {
    add_load(&p);
  }
  for (int k = 0; k < s->spring_count; k++) {
    s->conservative = s->conservative && s->springs[k].damping <= 0.0;
  }
  return s->n > s->rows && find_start(&p);
}

bool judge_scene_draw(judge_scene *s, uint64_t seed)
{
  for (int attempt = 0; attempt < 64; attempt++) {
    if (draw_once(s, seed, attempt)) {
      return true;
    }
  }
  return false;
}
