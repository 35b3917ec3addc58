/* SPDX-License-Identifier: BSD-3-Clause */
#include "spatial_judge.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* The largest violation that is permitted after a projection by the library. Velocities are about 3
 * m/s. */
static const double ON_CONSTRAINTS = 1e-9;

/* Degrees of freedom are compared only if the rank is clear: independent rows are at least this far
 * from the span of the others. */
static const double CLEAR = 1e-6;

/* The largest effect of rounding that excuses an error. A larger effect would excuse errors above
 * 1e-6, and could hide faults of the solver. Configurations in which the effect is larger cannot be
 * judged. */
static const double MOST_ROUNDING = 1e-8;

enum { SIZE = 7 * ORACLE_BODIES, MULTIPLIERS = ORACLE_JOINTS * 6 };

/* A configuration in which a mechanism is tested. */
typedef struct scene {
  const random_spatial *random;
  spatial_tally *tally;
  uint64_t seed;
  const char *what; /* configuration */
  baum_workspace *w;
  int nc;
  double t;
  double q[SIZE];
  double v[SIZE];
  double a[SIZE];
  double reactions[ORACLE_JOINTS][ORACLE_REACTION];
  oracle_answer want;
} scene;

/* Relative errors. They are either the errors of the library, or errors of the oracle that are
 * caused by rounding of the positions. */
typedef struct errors {
  double acceleration;
  double reaction;
  double imbalance;
} errors;

/* ---- errors ---- */

static void widen(const scene *s, chance *c, wide q[SIZE])
{
  for (int i = 0; i < SIZE; i++) {
    q[i] = s->q[i];
    if (c) {
      q[i] += 0x1p-53 * chance_number(c, -1.0, 1.0) * fmax(1.0, fabs(s->q[i]));
    }
  }
}

static double largest_reaction(const scene *s)
{
  double most = 0.0;
  for (int n = 0; n < s->random->oracle.joint_count; n++) {
    for (int i = 0; i < ORACLE_REACTION; i++) {
      most = fmax(most, s->want.unique[n] ? fabs((double)s->want.reaction[n][i]) : 0.0);
      most = fmax(most, fabs(s->reactions[n][i]));
    }
  }
  return most;
}

static double more(double most, double apart)
{
  return apart <= most ? most : apart; /* this keeps NaN */
}

/* Returns errors relative to s->want. If `from` is &s->want, these are the errors of the library's
 * results. Otherwise they are the errors of the results in `from`. */
static errors errors_of(const scene *s, const oracle_answer *from)
{
  const spatial_oracle *o = &s->random->oracle;
  errors e = {.reaction = 0.0};
  for (int i = 0; i < o->nv; i++) {
    double a = from == &s->want ? s->a[i] : (double)from->a[i];
    e.acceleration = more(e.acceleration, fabs((double)(a - s->want.a[i])));
  }
  for (int n = 0; n < o->joint_count; n++) {
    for (int i = 0; i < ORACLE_REACTION && s->want.unique[n]; i++) {
      double f = from == &s->want ? s->reactions[n][i] : (double)from->reaction[n][i];
      e.reaction = more(e.reaction, fabs((double)(f - s->want.reaction[n][i])));
    }
  }
  double size = largest_reaction(s);
  e.acceleration /= s->want.rows.size > 0.0 ? s->want.rows.size : 1.0;
  e.reaction /= size > 0.0 ? size : 1.0;
  return e;
}

/* Returns how much the results of the oracle change if positions, inertias and J change by rounding
 * errors. The rounding errors of J matter if forces on a light body nearly cancel. */
static errors sensitivity(const scene *s)
{
  chance c = chance_of(s->seed);
  errors most = {.reaction = 0.0};
  for (int turn = 0; turn < 3; turn++) {
    wide q[SIZE];
    oracle_answer moved;
    spatial_oracle rounded = s->random->oracle;
    rounded.rounding = s->seed + (uint64_t)turn + 1;
    for (int k = 1; k < rounded.body_count; k++) {
      for (int i = 0; i < 6; i++) {
        rounded.bodies[k].inertia[i] *= 1.0 + (double)(chance_below(&c, 3) - 1) * 0x1p-52;
      }
    }
    widen(s, &c, q);
    assert_true(oracle_answer_at(&rounded, s->t, q, s->v, &moved));
    errors e = errors_of(s, &moved);
    most.acceleration = fmax(most.acceleration, e.acceleration);
    most.reaction = fmax(most.reaction, e.reaction);
  }
  return most;
}

/* ---- verdicts ---- */

static void print(const scene *s, const char *verdict, const errors *e, const errors *own)
{
  const spatial_oracle *o = &s->random->oracle;
  (void)printf("seed %llu, %s: %s; %d bodies, %d joints, %d rows of rank %d, smallest %.2g, "
               "conflict %.2g, Phi %.2g, Phi' %.2g; errors %.2g %.2g %.2g, rounding %.2g %.2g\n",
               (unsigned long long)s->seed, s->what, verdict, o->body_count - 1, o->joint_count,
               s->nc, s->want.rows.rank, s->want.rows.kept, s->want.rows.conflict, s->want.phi,
               s->want.rate, e->acceleration, e->reaction, e->imbalance, own->acceleration,
               own->reaction);
}

static spatial_verdict verdict_of(const quad_rows *rows, const errors *e, const errors *own)
{
  if (!(e->acceleration <= SPATIAL_ERROR + 100.0 * own->acceleration)) {
    /* The library and the oracle may omit different rows. Their results may then differ by the
     * conflict of these rows divided by the smallest singular value of the independent rows. */
    return e->acceleration <= rows->conflict / rows->kept ? SPATIAL_CONFLICT : SPATIAL_ACCELERATED;
  }
  if (!(e->reaction <= SPATIAL_ERROR + 100.0 * own->reaction)) {
    return SPATIAL_REACTION;
  }
  /* Two kinds of errors cause an imbalance: errors of reactions, and errors of accelerations times
   * masses. */
  double allowed = SPATIAL_ERROR + 100.0 * (own->acceleration + own->reaction);
  return e->imbalance <= allowed ? SPATIAL_MET : SPATIAL_BALANCE;
}

static void count(scene *s, spatial_verdict verdict, const errors *e, const errors *own)
{
  static const char *const names[SPATIAL_VERDICTS] = {
    "met",       "refused", "conflict",    "off the constraints", "accelerations",
    "reactions", "balance", "false alarm", "degrees of freedom"};
  s->tally->counts[verdict]++;
  if (verdict > SPATIAL_REFUSED) {
    print(s, names[verdict], e, own);
  }
}

/* Reads the reaction of a joint from the library. For a planar knife edge, the library gives two
 * components of the force and the moment about z. */
static void read_reaction(scene *s, int n, const double *lambda)
{
  const oracle_joint *joint = &s->random->oracle.joints[n];
  double *out = s->reactions[n];
  memset(out, 0, ORACLE_REACTION * sizeof *out);
  assert_int_equal(baum_workspace_reaction(s->w, s->t, s->q, lambda, joint->id, out), BAUM_OK);
  if (joint->kind == ORACLE_KNIFE_EDGE) {
    out[5] = out[2];
    out[2] = 0.0;
  }
  s->tally->reactions += s->want.unique[n] ? 1 : 0;
}

static spatial_verdict read_library(scene *s, errors *e)
{
  const spatial_oracle *o = &s->random->oracle;
  double lambda[MULTIPLIERS];
  wide q[SIZE];
  widen(s, NULL, q);
  if (baum_workspace_acceleration(s->w, s->t, s->q, s->v, 0.0, 0.0, s->a, lambda) != BAUM_OK) {
    bool dependent = s->want.rows.rank < s->nc || s->want.rows.kept < QUAD_DEPENDENT;
    return dependent ? SPATIAL_REFUSED : SPATIAL_FALSE_ALARM;
  }
  for (int n = 0; n < o->joint_count; n++) {
    read_reaction(s, n, lambda);
  }
  *e = errors_of(s, &s->want);
  e->imbalance = oracle_imbalance(o, q, s->v, s->a, s->reactions);
  return SPATIAL_MET;
}

static void look(scene *s)
{
  errors e = {.reaction = 0.0};
  errors own = {.reaction = 0.0};
  wide q[SIZE];
  widen(s, NULL, q);
  assert_true(oracle_answer_at(&s->random->oracle, s->t, q, s->v, &s->want));
  s->tally->configurations++;
  if (!(s->want.phi <= ON_CONSTRAINTS && s->want.rate <= ON_CONSTRAINTS)) {
    count(s, SPATIAL_OFF, &e, &own);
    return;
  }
  spatial_verdict verdict = read_library(s, &e);
  if (verdict == SPATIAL_MET && verdict_of(&s->want.rows, &e, &own) != SPATIAL_MET) {
    own = sensitivity(s);
    if (!(own.acceleration + own.reaction <= MOST_ROUNDING)) {
      s->tally->unjudged++;
      print(s, "too sensitive to rounding", &e, &own);
      return;
    }
  }
  verdict = verdict == SPATIAL_MET ? verdict_of(&s->want.rows, &e, &own) : verdict;
  count(s, verdict, &e, &own);
  if (verdict == SPATIAL_MET && own.acceleration + own.reaction > 0.01 * SPATIAL_ERROR) {
    s->tally->ill_conditioned++;
  } else if (verdict == SPATIAL_MET) {
    s->tally->dependent += s->want.rows.rank < s->nc ? 1 : 0;
    s->tally->worst_reaction = fmax(s->tally->worst_reaction, e.reaction);
    if (e.acceleration > s->tally->worst) {
      s->tally->worst = e.acceleration;
      s->tally->worst_seed = s->seed;
    }
  }
}

/* ---- degrees of freedom ---- */

static void compare_mobility(scene *s)
{
  baum_mobility mobility;
  const errors none = {.reaction = 0.0};
  const int nv = s->random->oracle.nv;
  const oracle_answer *want = &s->want;
  assert_int_equal(baum_mechanism_mobility(s->random->mechanism, &mobility, sizeof mobility),
                   BAUM_OK);
  bool clear = fmin(want->rows.kept, want->position_rows.kept) >= CLEAR && !mobility.near_singular;
  if (!clear || mobility.conflicting_rows > 0) { /* drivers may prescribe unreachable values */
    return;
  }
  s->tally->mobilities++;
  if (mobility.degrees_of_freedom != nv - want->rows.rank ||
      mobility.position_degrees_of_freedom != nv - want->position_rows.rank) {
    count(s, SPATIAL_MOBILITY, &none, &none);
    (void)printf("  %s; must be %d of velocity, %d of position\n", mobility.text,
                 nv - want->rows.rank, nv - want->position_rows.rank);
  }
}

/* ---- configurations ---- */

static bool look_beside(scene *s, const char *what, double away, chance *c)
{
  double dx[SIZE];
  for (int i = 0; i < s->random->oracle.nv; i++) {
    dx[i] = chance_number(c, -away, away);
    s->v[i] = chance_number(c, -3.0, 3.0);
  }
  s->what = what;
  assert_int_equal(baum_workspace_move(s->w, dx, s->q), BAUM_OK);
  bool projected = baum_workspace_project(s->w, s->t, s->q, s->v) == BAUM_OK;
  if (projected) {
    look(s);
    s->tally->velocity_rows += s->want.velocity_rows;
  } else {
    s->tally->not_projected++;
  }
  return projected;
}

static void count_elements(const spatial_oracle *o, spatial_tally *tally)
{
  for (int n = 0; n < o->joint_count; n++) {
    tally->joints[o->joints[n].kind]++;
  }
  for (int n = 0; n < o->force_count; n++) {
    tally->forces[o->forces[n].kind]++;
  }
}

void spatial_judge(random_spatial *room, uint64_t seed, bool further, spatial_tally *tally)
{
  random_spatial_make(room, seed, further);
  count_elements(&room->oracle, tally);
  scene s = {.random = room, .tally = tally, .seed = seed, .t = room->start};
  chance c = chance_of(seed + 1);
  int nq;
  int nv;
  assert_int_equal(baum_mechanism_sizes(room->mechanism, &nq, &nv, &s.nc), BAUM_OK);
  assert_int_equal(nq, room->oracle.nq);
  assert_int_equal(nv, room->oracle.nv);
  assert_int_equal(baum_workspace_create(room->mechanism, &s.w), BAUM_OK);
  assert_int_equal(baum_workspace_design(s.w, s.q, NULL), BAUM_OK);
  (void)look_beside(&s, "design", 0.0, &c);
  if (look_beside(&s, "moved", 0.2, &c) && s.nc > 0) {
    compare_mobility(&s);
  }
  tally->mechanisms++;
  baum_workspace_destroy(s.w);
  random_spatial_destroy(room);
}

/* Configurations that cannot be judged count as bad if they are more than one in a thousand. */
long spatial_bad(const spatial_tally *tally)
{
  long bad = 1000 * tally->unjudged > tally->configurations ? tally->unjudged : 0;
  for (int k = SPATIAL_CONFLICT; k < SPATIAL_VERDICTS; k++) {
    bad += tally->counts[k];
  }
  return bad;
}
