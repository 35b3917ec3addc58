/* SPDX-License-Identifier: BSD-3-Clause */
#include "slender_rods.h"

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
#include "quad_rows.h"
#include "rotation.h"

enum { ISLANDS = 3, BODIES = 5, MOST = ISLANDS * BODIES };
enum { SPHERICAL, REVOLUTE, UNIVERSAL, CYLINDRICAL, PRISMATIC, FIXED };

/* If rounding changes accelerations by more than this, they cannot be judged. */
static const double ILL_POSED = 1e-3;
/* Rows whose distance from dependence is between this and QUAD_DEPENDENT cannot be judged. */
static const double DEPENDENT = 1e-14;
static const double UNIT_ROUNDING = 0x1p-53;
/* The effect of rounding is measured in three samples, in which every number is rounded once at
 * random. The largest of the three effects is then multiplied by this. */
static const double MANY = 1000.0;
/* If joints prevent accelerations, errors are relative to this fraction of the accelerations that
 * the forces would cause without joints. */
static const double HELD = 1e-2;
/* Errors are relative to accelerations of at least this fraction of rods.acceleration. */
static const double TINY = 1e-12;

typedef struct rod {
  baum_body_id id;
  int island;
  bool slender;
  double axis[3]; /* in body axes */
  double p[4];
  double r[3];
} rod;

typedef struct rods {
  chance chance;
  double unit;
  baum_mechanism *mechanism;
  int count;
  rod list[MOST];
  double ratio; /* smallest ratio of the axial to the transverse moment of inertia of a rod */
  double mass[ISLANDS];
  double length[ISLANDS];
  double acceleration[ISLANDS]; /* largest force of a load divided by the mass */
  double speed[MOST * 6];
} rods;

/* ---- bodies ---- */

static void vector(chance *c, double size, double out[3])
{
  for (int i = 0; i < 3; i++) {
    out[i] = chance_number(c, -size, size);
  }
}

static void random_turn(chance *c, double p[4])
{
  for (int i = 0; i < 4; i++) {
    p[i] = chance_number(c, -1.0, 1.0);
  }
  quaternion_normalize(p);
}

/* Sets the inertia tensor with the given principal moments. If `full` is true, the principal axes
 * are rotated at random. */
static void set_inertia(chance *c, const double moments[3], bool full, double tensor[6],
                        double axis[3])
{
  static const int places[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  double p[4] = {1.0, 0.0, 0.0, 0.0};
  double a[9];
  if (full) {
    random_turn(c, p);
  }
  rotation_matrix(p, a);
  for (int n = 0; n < 6; n++) {
    tensor[n] = 0.0;
    for (int k = 0; k < 3; k++) {
      tensor[n] += a[3 * places[n][0] + k] * moments[k] * a[3 * places[n][1] + k];
    }
  }
  for (int i = 0; i < 3; i++) {
    axis[i] = a[(ptrdiff_t)3 * i];
  }
}

static void choose_inertia(rods *r, rod *of, double tensor[6])
{
  chance *c = &r->chance;
  double length = r->length[of->island];
  double size = r->mass[of->island] * length * length / 12.0;
  double ratio = chance_below(c, 5) == 0 ? 0.0 : chance_decade(c, 1e-12, 1e-3);
  of->slender = chance_below(c, 4) > 0;
  ratio = of->slender ? ratio : chance_number(c, 0.5, 1.0);
  r->ratio = fmin(r->ratio, ratio);
  const double moments[3] = {size * ratio, size, size};
  set_inertia(c, moments, chance_below(c, 2) == 0, tensor, of->axis);
}

/* Chooses a point on the axis of a rod or near this axis. */
static void choose_point(rods *r, const rod *of, double point[3])
{
  chance *c = &r->chance;
  double length = r->length[of->island];
  double along = length * chance_number(c, -0.5, 0.5);
  double beside[3];
  vector(c, chance_below(c, 2) == 0 ? 0.0 : length * chance_decade(c, 1e-8, 0.3), beside);
  for (int i = 0; i < 3; i++) {
    point[i] = along * of->axis[i] + beside[i];
  }
}

/* Converts a direction from the axes of one body, with the quaternion `from`, to the axes of
 * another. */
static void axis_of(const double from[4], const double axis[3], const double to[4], double out[3])
{
  const double back[4] = {to[0], -to[1], -to[2], -to[3]};
  double ground[3];
  rotate(from, axis, ground);
  rotate(back, ground, out);
}

/* Defines the joint of a new body, and moves the body to this joint. If `before` is NULL, the joint
 * connects the body with ground. */
static void choose_place(rods *r, const rod *before, int kind, rod *of,
                         baum_spatial_revolute_def *def)
{
  chance *c = &r->chance;
  double length = r->length[of->island];
  double at[3];
  double own[3];
  vector(c, length, def->point_a);
  memcpy(at, def->point_a, sizeof at);
  if (before) {
    choose_point(r, before, def->point_a);
    rotate(before->p, def->point_a, at);
  }
  choose_point(r, of, def->point_b);
  rotate(of->p, def->point_b, own);
  for (int i = 0; i < 3; i++) {
    of->r[i] = at[i] + (before ? before->r[i] : 0.0) - own[i];
  }
  def->body_a = before ? before->id : BAUM_GROUND;
  vector(c, 1.0, def->axis);
  if (before && chance_below(c, 3) == 0) {
    memcpy(def->axis, before->axis, sizeof def->axis);
  }
  static const double identity[4] = {1.0, 0.0, 0.0, 0.0};
  double second[3];
  memcpy(second, def->axis, sizeof second);
  if (kind == UNIVERSAL) { /* its axes are perpendicular */
    double other[3];
    vector(c, 1.0, other);
    cross(def->axis, other, second);
  }
  axis_of(before ? before->p : identity, second, of->p, def->axis_b);
}

#define ADD(NAME)                                                               \
  {                                                                             \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default();        \
    size_t head = offsetof(baum_spatial_##NAME##_def, body_a);                  \
    memcpy((char *)&def + head, (const char *)given + head, sizeof def - head); \
    check(baum_mechanism_add_spatial_##NAME(r->mechanism, &def, &id));          \
  }

static void add_joint(const rods *r, int kind, const baum_spatial_revolute_def *given)
{
  baum_joint_id id;
  switch (kind) {
  case SPHERICAL: ADD(spherical) break;
  case REVOLUTE: ADD(revolute) break;
  case UNIVERSAL: ADD(universal) break;
  case CYLINDRICAL: ADD(cylindrical) break;
  case PRISMATIC: ADD(prismatic) break;
  default: ADD(fixed) break;
  }
}

static void add_body(rods *r, int island, int before)
{
  chance *c = &r->chance;
  rod *of = &r->list[r->count++];
  baum_spatial_body_def body = baum_spatial_body_def_default();
  baum_spatial_revolute_def joint = baum_spatial_revolute_def_default();
  of->island = island;
  choose_inertia(r, of, body.inertia);
  of->p[0] = 1.0;
  if (chance_below(c, 4) > 0) {
    random_turn(c, of->p);
  }
  int kind = chance_below(c, 8) == 0 ? FIXED : chance_below(c, FIXED);
  choose_place(r, before < 0 ? NULL : &r->list[before], kind, of, &joint);
  body.mass = r->mass[island];
  memcpy(body.position, of->r, sizeof body.position);
  memcpy(body.orientation, of->p, sizeof body.orientation);
  check(baum_mechanism_add_spatial_body(r->mechanism, &body, &of->id));
  joint.body_b = of->id;
  if (before >= 0 || chance_below(c, 10) > 0) {
    add_joint(r, kind, &joint);
  }
}

/* Connects a rod with ground by a spherical joint. The joint is on the axis of the rod or near this
 * axis. */
static void add_loop(rods *r, const rod *of)
{
  baum_spatial_revolute_def joint = baum_spatial_revolute_def_default();
  joint.body_a = of->id;
  joint.body_b = BAUM_GROUND;
  choose_point(r, of, joint.point_a);
  rotate(of->p, joint.point_a, joint.point_b);
  for (int i = 0; i < 3; i++) {
    joint.point_b[i] += of->r[i];
  }
  add_joint(r, SPHERICAL, &joint);
}

static void add_load(rods *r, const rod *of)
{
  chance *c = &r->chance;
  double force = r->mass[of->island] * r->acceleration[of->island];
  double moment = force * r->length[of->island];
  double axial = moment * chance_decade(c, 1e-12, 1.0);
  baum_force_id id;
  baum_spatial_load_def def = baum_spatial_load_def_default();
  def.body = of->id;
  def.follows_body = true;
  vector(c, force, def.force);
  vector(c, of->slender ? 0.0 : moment, def.moment);
  for (int i = 0; i < 3; i++) {
    def.moment[i] += axial * of->axis[i];
  }
  check(baum_mechanism_add_spatial_load(r->mechanism, &def, &id));
}

static void add_island(rods *r, int island)
{
  chance *c = &r->chance;
  int first = r->count;
  int bodies = 1 + chance_below(c, BODIES);
  r->mass[island] = chance_decade(c, 1e-6, 1e6);
  r->length[island] = r->unit * (chance_below(c, 3) == 0 ? chance_decade(c, 0.01, 100.0) : 1.0);
  r->acceleration[island] = r->unit * chance_decade(c, 1e-6, 1e6);
  for (int k = 0; k < bodies; k++) {
    add_body(r, island, k == 0 ? -1 : first + chance_below(c, k));
  }
  if (chance_below(c, 3) == 0) {
    add_loop(r, &r->list[r->count - 1]);
  }
  for (int k = first; k < r->count; k++) {
    double rate = sqrt(r->acceleration[island] / r->length[island]);
    for (int i = 0; i < 6; i++) {
      double size = i < 3 ? r->length[island] : 1.0;
      r->speed[6 * k + i] = chance_number(c, -rate, rate) * size;
    }
    if (chance_below(c, 2) == 0) {
      add_load(r, &r->list[k]);
    }
  }
}

static void make(rods *r, uint64_t seed, double unit)
{
  *r = (rods){.chance = chance_of(seed), .unit = unit, .ratio = 1.0};
  r->mechanism = create_mechanism();
  double g = chance_below(&r->chance, 2) == 0 ? 0.0 : -9.81 * unit;
  check(baum_mechanism_set_gravity(r->mechanism, 0.0, 0.0, g));
  int islands = 1 + chance_below(&r->chance, ISLANDS);
  for (int k = 0; k < islands; k++) {
    add_island(r, k);
  }
  check(baum_mechanism_freeze(r->mechanism));
}

/* ---- the oracle ---- */

/* M, J, g and gamma of the library, the accelerations of the oracle and those of the library. */
typedef struct equations {
  int nv, nc;
  double *numbers; /* M, J, g and gamma, in this order */
  wide *want;
  wide *rounded;
  double *a;
  double *lambda;
  quad_rows rows;
} equations;

static void allocate(equations *e)
{
  size_t v = (size_t)e->nv;
  size_t c = (size_t)e->nc;
  e->numbers = calloc(v * v + c * v + v + c + 1, sizeof *e->numbers);
  e->want = calloc(2 * v, sizeof *e->want);
  e->a = calloc(v + c + 1, sizeof *e->a);
  assert_true(e->numbers && e->want && e->a);
  e->rounded = e->want + v;
  e->lambda = e->a + v;
}

static void release(equations *e)
{
  free(e->numbers);
  free(e->want);
  free(e->a);
}

static void read_equations(baum_workspace *w, const double *q, const double *v, equations *e)
{
  double *jacobian = e->numbers + e->nv * e->nv;
  double *force = jacobian + e->nc * e->nv;
  check(baum_workspace_mass(w, 0.0, q, e->numbers));
  check(baum_workspace_jacobian(w, 0.0, q, jacobian));
  check(baum_workspace_force(w, 0.0, q, v, force));
  check(baum_workspace_gamma(w, 0.0, q, v, force + e->nv));
}

static double largest_of_three(const double *x)
{
  return fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2])));
}

static double noise(chance *c)
{
  return UNIT_ROUNDING * chance_number(c, -1.0, 1.0);
}

/* Adds rounding errors to the numbers of one body. A number that is 0 stays 0, unless it is a sum
 * of larger terms. */
static void round_body(int body, const double *v, chance *c, const equations *e, quad_equations *s)
{
  const double *mass = e->numbers;
  const double *jacobian = mass + e->nv * e->nv;
  const double *force = jacobian + e->nc * e->nv;
  int first = 6 * body + 3;
  double tensor = 0.0;
  for (int i = first; i < first + 3; i++) {
    tensor = fmax(tensor, largest_of_three(mass + e->nv * i + first));
  }
  for (int i = first; i < first + 3; i++) {
    for (int j = first; j <= i; j++) {
      double size = mass[e->nv * i + j] == 0.0 ? 0.0 : tensor;
      bool full = mass[e->nv * first + first + 1] != 0.0;
      double change = noise(c) * (full ? size : mass[e->nv * i + j]);
      s->mass[e->nv * i + j] += change;
      s->mass[e->nv * j + i] = s->mass[e->nv * i + j];
    }
    double gyroscopic = tensor * pow(largest_of_three(v + first), 2.0);
    s->force[i] += noise(c) * fmax(gyroscopic, largest_of_three(force + first));
  }
  for (int k = 0; k < e->nc; k++) {
    for (int i = 6 * body; i < 6 * body + 6; i++) {
      const double *row = jacobian + e->nv * k + (i < first ? first - 3 : first);
      s->jacobian[e->nv * k + i] +=
        jacobian[e->nv * k + i] == 0.0 ? 0.0 : noise(c) * largest_of_three(row);
      double speed = largest_of_three(v + first);
      s->gamma[k] += i >= first ? noise(c) * largest_of_three(row) * speed * speed : 0.0;
    }
  }
}

/* Solves the equations, with rounding errors if `c` is not NULL. Returns false if there is no
 * solution. */
static bool solve(const rods *r, const double *v, chance *c, equations *e, wide *a, quad_rows *rows)
{
  quad_equations s;
  assert_true(quad_equations_create(&s, e->nv, e->nc));
  for (int i = 0; i < e->nv * e->nv + e->nc * e->nv + e->nv + e->nc; i++) {
    s.mass[i] = e->numbers[i];
  }
  for (int k = 0; c && k < r->count; k++) {
    round_body(k, v, c, e, &s);
  }
  bool done = quad_equations_solve(&s, a, rows);
  quad_equations_destroy(&s);
  return done;
}

/* ---- errors ---- */

/* Returns the component of a vector along the axis of a rod. The function across() returns the
 * largest element of the vector without this component. */
static double along(const rod *of, const double x[3])
{
  return x[0] * of->axis[0] + x[1] * of->axis[1] + x[2] * of->axis[2];
}

static double across(const rod *of, const double x[3])
{
  double rest[3];
  for (int i = 0; i < 3; i++) {
    rest[i] = x[i] - along(of, x) * of->axis[i];
  }
  return largest_of_three(rest);
}

/* Returns the largest acceleration of a body in 1/s^2. The angular acceleration of a slender rod
 * about its axis is not included. */
static double size_of(const rods *r, int body, const double x[6])
{
  const rod *of = &r->list[body];
  double moves = largest_of_three(x) / r->length[of->island];
  return fmax(moves, of->slender ? across(of, x + 3) : largest_of_three(x + 3));
}

static double worse(double most, double x)
{
  return x <= most ? most : x; /* keeps NaN */
}

static double ratio_of(double error, double size)
{
  return error == 0.0 ? 0.0 : error / size;
}

/* Returns the largest acceleration that the forces on a body would cause without joints, in 1/s^2.
 * The transverse moment of inertia is used for all axes. */
static double free_size(const rods *r, const equations *e, int body)
{
  const double *force = e->numbers + (e->nv + e->nc) * e->nv + 6 * body;
  int island = r->list[body].island;
  double mass = r->mass[island];
  double length = r->length[island];
  return fmax(largest_of_three(force), largest_of_three(force + 3) * 12.0 / length) /
         (mass * length);
}

/* Returns the error of the accelerations `got`. If `got` is NULL, returns the error of
 * e->rounded. */
static double error_of(const rods *r, const equations *e, const double *got)
{
  double sizes[ISLANDS] = {0.0};
  double want[6 * MOST];
  double error[6 * MOST];
  for (int i = 0; i < e->nv; i++) {
    want[i] = (double)e->want[i];
    error[i] = (double)((got ? (wide)got[i] : e->rounded[i]) - e->want[i]);
  }
  for (int k = 0; k < r->count; k++) {
    double *size = &sizes[r->list[k].island];
    *size = fmax(*size, size_of(r, k, want + (ptrdiff_t)6 * k));
    *size = fmax(*size, HELD * free_size(r, e, k));
    *size = fmax(*size, TINY * r->acceleration[r->list[k].island] / r->length[r->list[k].island]);
  }
  double most = 0.0;
  for (int k = 0; k < r->count; k++) {
    const rod *of = &r->list[k];
    double size = sizes[of->island];
    most = worse(most, ratio_of(size_of(r, k, error + (ptrdiff_t)6 * k), size));
    double spin = fabs(along(of, want + (ptrdiff_t)6 * k + 3));
    double wrong = fabs(along(of, error + (ptrdiff_t)6 * k + 3));
    most = worse(most, of->slender ? ratio_of(wrong, fmax(spin, size)) : 0.0);
  }
  return most;
}

static double sensitivity(const rods *r, const double *v, uint64_t seed, equations *e)
{
  chance c = chance_of(seed);
  double most = 0.0;
  for (int turn = 0; turn < 3; turn++) {
    quad_rows rows;
    if (!solve(r, v, &c, e, e->rounded, &rows) || rows.rank != e->rows.rank) {
      return (double)INFINITY;
    }
    most = worse(most, error_of(r, e, NULL));
  }
  return most;
}

/* ---- verdicts ---- */

static int class_of(double ratio)
{
  return ratio > 0.0 ? (int)fmin(12.0, fmax(0.0, floor(-log10(ratio)))) : SLENDER_CLASSES - 1;
}

static slender_verdict judge(const rods *r, baum_workspace *w, const double *q, const double *v,
                             uint64_t seed, double *error)
{
  equations e = {.nv = 6 * r->count};
  int sizes[2];
  check(baum_mechanism_sizes(r->mechanism, &sizes[0], &sizes[1], &e.nc));
  allocate(&e);
  read_equations(w, q, v, &e);
  slender_verdict verdict = SLENDER_RIGHT;
  assert_true(solve(r, v, NULL, &e, e.want, &e.rows));
  double own = 0.0;
  *error = (double)INFINITY;
  if (baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, e.a, e.lambda) != BAUM_OK) {
    own = sensitivity(r, v, seed, &e);
    bool clear = e.rows.rank == e.nc && own <= ILL_POSED;
    verdict = clear ? SLENDER_FALSE_REFUSAL : SLENDER_REFUSED;
  } else {
    *error = error_of(r, &e, e.a);
    own = *error <= SLENDER_ERROR ? 0.0 : sensitivity(r, v, seed, &e);
    verdict = *error <= SLENDER_ERROR                   ? SLENDER_RIGHT
              : !(*error <= SLENDER_ERROR + MANY * own) ? SLENDER_WRONG
              : own <= ILL_POSED                        ? SLENDER_ROUNDED
                                                        : SLENDER_UNJUDGED;
  }
  if (e.rows.rank < e.nc && e.rows.distance > DEPENDENT) {
    verdict = SLENDER_UNJUDGED;
  }
  if (verdict >= SLENDER_FALSE_REFUSAL) {
    (void)printf("seed %llu: %s; %d bodies, %d rows of rank %d, smallest %.2g, ratio %.2g; error "
                 "%.2g, rounding %.2g\n",
                 (unsigned long long)seed, verdict == SLENDER_WRONG ? "wrong" : "refused", r->count,
                 e.nc, e.rows.rank, e.rows.kept, r->ratio, *error, own);
  }
  release(&e);
  return verdict;
}

void slender_judge(uint64_t seed, double unit, slender_tally *tally, slender_verdict *first)
{
  rods r;
  baum_workspace *w = NULL;
  double q[7 * MOST];
  double v[6 * MOST];
  double dx[6 * MOST];
  make(&r, seed, unit);
  tally->mechanisms++;
  check(baum_workspace_create(r.mechanism, &w));
  check(baum_workspace_design(w, q, NULL));
  for (int turn = 0; turn < 2; turn++) {
    double error = 0.0;
    for (int i = 0; i < 6 * r.count; i++) {
      double length = i % 6 < 3 ? r.length[r.list[i / 6].island] : 1.0;
      dx[i] = turn == 0 ? 0.0 : chance_number(&r.chance, -0.2, 0.2) * length;
    }
    memcpy(v, r.speed, sizeof v);
    check(baum_workspace_move(w, dx, q));
    if (baum_workspace_project(w, 0.0, q, v) != BAUM_OK) {
      tally->not_projected++;
      break;
    }
    slender_verdict verdict = judge(&r, w, q, v, seed, &error);
    tally->counts[verdict]++;
    tally->by_class[class_of(r.ratio)][verdict]++;
    double *worst = verdict == SLENDER_RIGHT ? &tally->worst : &tally->worst_rounded;
    *worst = verdict <= SLENDER_ROUNDED ? fmax(*worst, error) : *worst;
    if (first && turn == 0) {
      *first = verdict;
    }
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(r.mechanism);
}
