/* SPDX-License-Identifier: BSD-3-Clause */
#include "redundant_mechanism.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"
#include "random_mechanism.h"

enum { BODY_SIZE = 3 };

/* ---- parts ---- */

typedef struct builder {
  baum_mechanism *m;
  chance chance;
  double ratio;
} builder;

static baum_body_id add_body(builder *b, double x, double y, double mass)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.mass = mass;
  def.inertia = mass * chance_decade(&b->chance, 0.01, 1.0);
  def.position[0] = x;
  def.position[1] = y;
  check(baum_mechanism_add_planar_body(b->m, &def, &id));
  if (chance_below(&b->chance, 3) == 0) {
    baum_planar_load_def load = baum_planar_load_def_default();
    double size = chance_below(&b->chance, 2) == 0 ? 10.0 * mass : 10.0;
    load.body = id;
    load.force[0] = size * chance_number(&b->chance, -1.0, 1.0);
    load.force[1] = size * chance_number(&b->chance, -1.0, 1.0);
    load.torque = size * chance_number(&b->chance, -1.0, 1.0);
    check(baum_mechanism_add_planar_load(b->m, &load, NULL));
  }
  return id;
}

static baum_body_id add_any(builder *b, double x, double y)
{
  return add_body(b, x, y, chance_decade(&b->chance, 1.0 / b->ratio, 1.0));
}

static void add_slider(builder *b, baum_body_id body_a, baum_body_id body_b, double x, double y)
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.body_a = body_a;
  def.body_b = body_b;
  def.point[0] = x;
  def.point[1] = y;
  check(baum_mechanism_add_planar_translational(b->m, &def, NULL));
}

/* Adds a rod between two points. The points are given relative to the centres of the bodies. All
 * bodies have the angle 0 in the design configuration. */
static void add_rod(builder *b, baum_body_id body_a, baum_body_id body_b, const double at_a[2],
                    const double at_b[2])
{
  baum_planar_distance_def def = baum_planar_distance_def_default();
  def.body_a = body_a;
  def.body_b = body_b;
  memcpy(def.point_a, at_a, sizeof def.point_a);
  memcpy(def.point_b, at_b, sizeof def.point_b);
  check(baum_mechanism_add_planar_distance(b->m, &def, NULL));
}

/* ---- kinds ---- */

typedef enum chain_kind { CHAIN_OF_PINS, CHAIN_OF_WELDS, CHAIN_CLOSED } chain_kind;

static void join(builder *b, chain_kind kind, baum_body_id before, baum_body_id body,
                 const double at[2])
{
  int roll = chance_below(&b->chance, kind == CHAIN_CLOSED ? 4 : 2);
  if (kind == CHAIN_OF_PINS || roll == 0) {
    add_planar_pin(b->m, NULL, before, body, at[0], at[1]);
  } else if (roll == 3) {
    add_slider(b, before, body, at[0], at[1]);
  } else {
    (void)add_planar_weld(b->m, before, body, at[0], at[1]);
  }
}

/* Makes a chain of links that are about 1 m long. Some joints are added twice. */
static void make_chain(builder *b, chain_kind kind)
{
  int count = 1 + chance_below(&b->chance, 6);
  baum_body_id before = BAUM_GROUND;
  double at[2] = {0.0, 0.0};
  for (int k = 0; k < count; k++) {
    double to[2] = {at[0] + chance_number(&b->chance, 0.5, 1.0),
                    at[1] + chance_number(&b->chance, -0.7, 0.7)};
    baum_body_id body = add_any(b, 0.5 * (at[0] + to[0]), 0.5 * (at[1] + to[1]));
    join(b, kind, before, body, at);
    if (k == 0 || chance_below(&b->chance, 2) == 0) {
      join(b, kind == CHAIN_OF_PINS ? kind : CHAIN_OF_WELDS, before, body, at);
    }
    before = body;
    memcpy(at, to, sizeof at);
  }
  if (kind == CHAIN_CLOSED) {
    join(b, kind, before, BAUM_GROUND, at);
  }
}

/* Makes equal, parallel cranks between a base and a coupler. The pins on the base may lie on one
 * line or not. The second crank is sometimes a massless rod. */
static baum_body_id make_cranks(builder *b, baum_body_id base, const double corner[2], int cranks)
{
  double crank[2] = {chance_number(&b->chance, -0.6, 0.6), chance_number(&b->chance, 0.5, 1.0)};
  double slope = chance_below(&b->chance, 2) ? 0.0 : chance_number(&b->chance, -0.3, 0.3);
  bool rod = cranks > 2 && base.index1 == BAUM_GROUND.index1 && chance_below(&b->chance, 2);
  double centre[2] = {corner[0] + crank[0] + 0.5, corner[1] + crank[1]};
  baum_body_id coupler = add_any(b, centre[0], centre[1]);
  for (int k = 0; k < cranks; k++) {
    double x = (double)k / (cranks - 1);
    double foot[2] = {corner[0] + x, corner[1] + slope * x * (x - 1.0)};
    double head[2] = {foot[0] + crank[0], foot[1] + crank[1]};
    double in_coupler[2] = {head[0] - centre[0], head[1] - centre[1]};
    if (rod && k == 1) {
      add_rod(b, base, coupler, foot, in_coupler);
      continue;
    }
    baum_body_id body = add_any(b, 0.5 * (foot[0] + head[0]), 0.5 * (foot[1] + head[1]));
    add_planar_pin(b->m, NULL, base, body, foot[0], foot[1]);
    add_planar_pin(b->m, NULL, body, coupler, head[0], head[1]);
    if (chance_below(&b->chance, 4) == 0) {
      add_planar_pin(b->m, NULL, body, coupler, head[0], head[1]);
    }
  }
  return coupler;
}

static void make_storeys(builder *b)
{
  baum_body_id base = BAUM_GROUND;
  int count = 1 + chance_below(&b->chance, 3);
  for (int k = 0; k < count; k++) {
    const double corner[2] = {0.1 * k, 1.2 * k};
    base = make_cranks(b, base, corner, k == 0 ? 3 : 2 + chance_below(&b->chance, 2));
  }
}

static builder begin(uint64_t seed)
{
  builder b = {.chance = chance_of(seed)};
  b.m = create_mechanism();
  return b;
}

baum_mechanism *redundant_mechanism(uint64_t seed, double *ratio)
{
  static const double ground[2] = {0.0, 0.0};
  builder b = begin(seed);
  b.ratio = chance_decade(&b.chance, 1.0, 1e12);
  *ratio = b.ratio;
  switch (seed % 5) {
  case 0: make_chain(&b, CHAIN_OF_PINS); break;
  case 1: make_chain(&b, CHAIN_OF_WELDS); break;
  case 2: (void)make_cranks(&b, BAUM_GROUND, ground, 3 + chance_below(&b.chance, 3)); break;
  case 3: make_storeys(&b); break;
  default: make_chain(&b, CHAIN_CLOSED); break;
  }
  check(baum_mechanism_freeze(b.m));
  return b.m;
}

baum_mechanism *redundant_bracket(double ratio, baum_joint_id *hold)
{
  builder b = begin(0);
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id bracket;
  baum_body_id heavy;
  def.mass = 1.0 / ratio;
  def.inertia = 0.1 / ratio;
  def.position[0] = 0.4;
  def.position[1] = -0.3;
  check(baum_mechanism_add_planar_body(b.m, &def, &bracket));
  def.mass = 1.0;
  def.inertia = 0.1;
  def.position[0] = 1.2;
  def.position[1] = -0.9;
  check(baum_mechanism_add_planar_body(b.m, &def, &heavy));
  add_planar_pin(b.m, NULL, BAUM_GROUND, bracket, 0.0, 0.0);
  (void)add_planar_weld(b.m, bracket, BAUM_GROUND, 0.0, 0.0);
  *hold = add_planar_weld(b.m, bracket, heavy, 0.8, -0.6);
  check(baum_mechanism_freeze(b.m));
  return b.m;
}

/* ---- balance ---- */

static double worse(double a, double b)
{
  return isnan(b) || b > a ? (isnan(b) ? (double)INFINITY : b) : a;
}

/* Returns the largest relative residual of all groups of rows. Each residual is divided by the
 * largest term of its group, or by 1e-14 of the largest term of all groups if that is larger. */
static double largest_share(const double *rest, const double *size, int count, int group)
{
  double all = 0.0;
  double share = 0.0;
  for (int i = 0; i < count; i++) {
    all = worse(all, size[i]);
  }
  for (int i = 0; i < count; i += group) {
    double most = 0.0;
    double most_rest = 0.0;
    for (int k = i; k < i + group; k++) {
      most = worse(most, size[k]);
      most_rest = worse(most_rest, fabs(rest[k]));
    }
    /* A group in which everything is zero is in balance. */
    share = most_rest == 0.0 ? share : worse(share, most_rest / fmax(most, 1e-14 * all));
  }
  return share;
}

static void subtract(double term, double *rest, double *size)
{
  *rest -= term;
  *size = worse(*size, fabs(term));
}

double redundant_imbalance(const redundant_state *s, double *rows)
{
  size_t n = (size_t)s->nv;
  size_t c = (size_t)s->nc;
  double *mass = calloc(n * n + n * c + 2 * (n + c), sizeof *mass);
  assert_non_null(mass);
  double *jacobian = mass + n * n;
  double *rest = jacobian + n * c; /* (nv + nc) */
  double *size = rest + n + c;
  check(baum_workspace_mass(s->w, 0.0, s->q, mass));
  check(baum_workspace_jacobian(s->w, 0.0, s->q, jacobian));
  check(baum_workspace_force(s->w, 0.0, s->q, s->v, rest));
  check(baum_workspace_gamma(s->w, 0.0, s->q, s->v, rest + n));
  for (size_t i = 0; i < n + c; i++) {
    size[i] = fabs(rest[i]);
  }
  for (size_t i = 0; i < n; i++) {
    double free = rest[i] / mass[i * n + i]; /* the acceleration without constraints */
    for (size_t k = 0; k < c; k++) {
      size[n + k] = worse(size[n + k], fabs(jacobian[k * n + i] * free));
    }
    for (size_t j = 0; j < n; j++) {
      subtract(mass[i * n + j] * s->a[j], &rest[i], &size[i]);
    }
    for (size_t k = 0; k < c; k++) {
      subtract(jacobian[k * n + i] * s->lambda[k], &rest[i], &size[i]);
      subtract(jacobian[k * n + i] * s->a[i], &rest[n + k], &size[n + k]);
    }
  }
  double share = largest_share(rest, size, s->nv, BODY_SIZE);
  if (rows) {
    *rows = largest_share(rest + n, size + n, s->nc, s->nc);
  }
  free(mass);
  return share;
}

/* ---- uniqueness: if a row does not depend on the others, its multiplier is unique ---- */

/* Subtracts from `row` its components along orthonormal rows (count x n), and returns the length of
 * the result. This is done in two passes, because rounding leaves small components in the first
 * pass. */
static double leave(const double *rows, int count, int n, double *row)
{
  double size = 0.0;
  for (int pass = 0; pass < 2; pass++) {
    for (int k = 0; k < count; k++) {
      double along = 0.0;
      for (int i = 0; i < n; i++) {
        along += rows[k * n + i] * row[i];
      }
      for (int i = 0; i < n; i++) {
        row[i] -= along * rows[k * n + i];
      }
    }
  }
  for (int i = 0; i < n; i++) {
    size += row[i] * row[i];
  }
  return sqrt(size);
}

static void divide(double *row, int n, double by)
{
  for (int i = 0; i < n; i++) {
    row[i] /= by;
  }
}

/* Returns the distance of a unit row from the span of all other rows. */
static double distance(const double *jacobian, int nc, int n, int which, double *room)
{
  static const double DEPENDENT = 1e-7;
  int count = 0;
  for (int k = 0; k <= nc; k++) {
    int row = k < nc ? k : which;
    double *next = room + (ptrdiff_t)count * n;
    memcpy(next, jacobian + (ptrdiff_t)row * n, (size_t)n * sizeof *next);
    double left = k == which ? 0.0 : leave(room, count, n, next);
    if (k == nc) {
      return left;
    }
    if (left > DEPENDENT) {
      divide(next, n, left);
      count++;
    }
  }
  return 0.0;
}

/* Counts how many of the flags s->unique are wrong. Rows are not judged if their distance from the
 * others is between 1e-9 and 1e-5. */
static int count_wrong_unique(const redundant_state *s)
{
  size_t n = (size_t)s->nv;
  size_t c = (size_t)s->nc;
  int wrong = 0;
  double *jacobian = calloc((2 * c + 1) * n, sizeof *jacobian);
  assert_non_null(jacobian);
  check(baum_workspace_jacobian(s->w, 0.0, s->q, jacobian));
  for (size_t k = 0; k < c; k++) {
    divide(jacobian + k * n, s->nv, leave(NULL, 0, s->nv, jacobian + k * n));
  }
  for (int k = 0; k < s->nc; k++) {
    double apart = distance(jacobian, s->nc, s->nv, k, jacobian + n * c);
    wrong += (apart < 1e-9 && s->unique[k]) || (apart > 1e-5 && !s->unique[k]) ? 1 : 0;
  }
  free(jacobian);
  return wrong;
}

/* ---- verdicts ---- */

static redundant_verdict verdict(baum_status status, double share)
{
  if (status < BAUM_OK) {
    return REDUNDANT_REFUSED;
  }
  return share <= REDUNDANT_ERROR ? REDUNDANT_MET : REDUNDANT_WRONG;
}

/* Reads accelerations, multipliers and the flags of uniqueness from a run. The run starts without
 * assembly. */
static baum_status read_run(const baum_mechanism *m, redundant_state *s)
{
  const baum_channel channels[] = {baum_channel_of(BAUM_A), baum_channel_of(BAUM_LAMBDA)};
  baum_simulation_options o = baum_simulation_options_default();
  baum_simulation *run = NULL;
  o.integrator = baum_rk4();
  o.step = 1e-3;
  o.start = BAUM_START_AS_GIVEN;
  baum_status status = baum_simulation_create(m, &o, &run);
  if (status >= BAUM_OK) {
    status = baum_simulation_set_state(run, 0.0, s->q, s->v);
  }
  if (status >= BAUM_OK) {
    /* The run may have changed the state of fixed bodies. */
    memcpy(s->q, baum_simulation_q(run), (size_t)s->nv * sizeof *s->q);
    memcpy(s->v, baum_simulation_v(run), (size_t)s->nv * sizeof *s->v);
    status = baum_simulation_get(run, channels, 2, s->a);
  }
  if (status >= BAUM_OK) {
    status = baum_simulation_unique_multipliers(run, s->unique);
  }
  baum_simulation_destroy(run);
  return status;
}

static double judge_state(redundant_state *s, baum_status status, bool on_constraints,
                          long counts[REDUNDANT_VERDICTS])
{
  double rows = 0.0;
  double share = status < BAUM_OK ? 0.0 : redundant_imbalance(s, on_constraints ? &rows : NULL);
  share = worse(share, rows);
  counts[verdict(status, share)]++;
  return share;
}

static void judge_both(const baum_mechanism *m, redundant_state *s, int k, redundant_tally *tally,
                       const char *label)
{
  double share[2];
  baum_status status =
    baum_workspace_acceleration(s->w, 0.0, s->q, s->v, 0.0, 0.0, s->a, s->lambda);
  share[0] = judge_state(s, status, k == 0, tally->workspace[k]);
  status = read_run(m, s);
  share[1] = judge_state(s, status, k == 0, tally->run[k]);
  int wrong = status >= BAUM_OK && k == 0 ? count_wrong_unique(s) : 0;
  if (wrong > 0) {
    (void)printf("%s: %d multipliers are wrongly called unique, or not unique\n", label, wrong);
    tally->wrong_unique += wrong;
  }
  for (int i = 0; i < 2; i++) {
    if (share[i] > REDUNDANT_ERROR) {
      (void)printf("%s, state %d, %s: off by %.2g\n", label, k, i ? "run" : "workspace", share[i]);
    } else {
      tally->worst = worse(tally->worst, share[i]);
    }
  }
}

void redundant_judge(uint64_t seed, redundant_tally *tally)
{
  static const double off[REDUNDANT_STATES] = {0.0, 1e-6, 1e-3};
  double ratio = 0.0;
  char label[64];
  redundant_state s = {0};
  baum_mechanism *m = redundant_mechanism(seed, &ratio);
  chance c = chance_of(~seed);
  (void)snprintf(label, sizeof label, "seed %llu, ratio %.0e", (unsigned long long)seed, ratio);
  check(baum_mechanism_sizes(m, NULL, &s.nv, &s.nc));
  check(baum_workspace_create(m, &s.w));
  s.q = calloc((size_t)(3 * s.nv + s.nc), sizeof *s.q);
  s.unique = calloc((size_t)s.nc, sizeof *s.unique);
  assert_non_null(s.q);
  assert_non_null(s.unique);
  s.v = s.q + s.nv;
  s.a = s.v + s.nv;
  s.lambda = s.a + s.nv;
  check(baum_workspace_design(s.w, s.q, NULL));
  for (int i = 0; i < s.nv; i++) {
    s.v[i] = chance_number(&c, -1.0, 1.0);
  }
  if (baum_workspace_project(s.w, 0.0, s.q, s.v) < BAUM_OK) {
    check(baum_workspace_design(s.w, s.q, NULL));
    memset(s.v, 0, (size_t)s.nv * sizeof *s.v);
  }
  for (int k = 0; k < REDUNDANT_STATES; k++) {
    for (int i = 0; i < s.nv; i++) {
      s.q[i] += off[k] * chance_number(&c, -1.0, 1.0);
    }
    judge_both(m, &s, k, tally, label);
  }
  free(s.unique);
  free(s.q);
  baum_workspace_destroy(s.w);
  baum_mechanism_destroy(m);
}
