/* SPDX-License-Identifier: BSD-3-Clause */
#include "random_judge.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "check.h"
#include "quad_rows.h"
#include "random_velocity_rows.h"

/* If dependent rows contradict each other by more than this, the library must refuse the
 * configuration. */
static const double CONTRADICTION = 1e-9;

/* Degrees of freedom are compared only if the rank is clear: independent rows are at least this far
 * from the span of the others. */
static const double CLEAR = 1e-6;

/* A configuration in which a mechanism is tested. */
typedef struct scene {
  const random_mechanism *random;
  random_tally *tally;
  uint64_t seed;
  baum_workspace *w;
  int nv;
  int nc;
  double t;
  double *q; /* (nv) */
  double *v;
  double *a;
  double *want;
} scene;

/* ---- kinds ---- */

/* Chooses what kind of mechanism is made. Most are small, but one in ten has up to 30 bodies. */
static random_kind draw_kind(chance *c)
{
  bool large = chance_below(c, 10) == 0;
  random_kind kind = {.bodies = 1 + chance_below(c, large ? 30 : 10)};
  kind.joints = chance_below(c, 1 + (3 * kind.bodies) / 2);
  kind.particles = chance_below(c, 3) == 0 ? chance_below(c, 60) : 0;
  kind.coordinates = chance_below(c, 3) == 0 ? chance_below(c, 40) : 0;
  kind.pins = chance_below(c, 101);
  kind.constant = chance_below(c, 2) == 0;
  kind.hub = chance_below(c, 10) == 0;
  kind.span = chance_decade(c, 1.0, chance_below(c, 4) == 0 ? 1e6 : 10.0);
  kind.loads = chance_below(c, 5);
  return kind;
}

/* ---- verdicts ---- */

static double error_of(const scene *s, const quad_rows *rows)
{
  double most = 0.0;
  for (int i = 0; i < s->nv; i++) {
    double apart = fabs(s->a[i] - s->want[i]);
    most = apart <= most ? most : apart; /* this keeps NaN */
  }
  return rows->size > 0.0 ? most / rows->size : most;
}

static random_verdict verdict_on(scene *s, baum_status status, const quad_rows *rows)
{
  bool dependent = rows->rank < s->nc;
  if (status != BAUM_OK) {
    return dependent || rows->distance < QUAD_DEPENDENT ? RANDOM_REFUSED : RANDOM_FALSE_ALARM;
  }
  if (dependent && rows->conflict > CONTRADICTION) {
    return RANDOM_CONFLICT;
  }
  double error = error_of(s, rows);
  /* The library and the oracle may omit different rows. Their results may then differ by the
   * conflict of these rows divided by the smallest singular value of the independent rows. */
  double choice = dependent ? rows->conflict / rows->kept : 0.0;
  if (!(error <= RANDOM_ERROR + choice)) {
    return RANDOM_WRONG;
  }
  s->tally->dependent += dependent ? 1 : 0;
  if (error > s->tally->worst) {
    s->tally->worst = error;
    s->tally->worst_seed = s->seed;
  }
  return RANDOM_MET;
}

static void look(scene *s, const char *what)
{
  quad_rows rows;
  baum_status status = baum_workspace_acceleration(s->w, s->t, s->q, s->v, 0.0, 0.0, s->a, NULL);
  if (!quad_rows_accelerate(s->w, s->nv, s->nc, s->t, s->q, s->v, s->want, &rows)) {
    (void)printf("seed %llu: no oracle: %s\n", (unsigned long long)s->seed, baum_message());
    s->tally->counts[RANDOM_WRONG]++;
    return;
  }
  random_verdict verdict = verdict_on(s, status, &rows);
  s->tally->poses++;
  s->tally->counts[verdict]++;
  if (verdict != RANDOM_MET && verdict != RANDOM_REFUSED) {
    (void)printf(
      "seed %llu, %s pose, %d coordinates, %d rows of rank %d, distance %.2g, conflict %.2g: %s, "
      "error %.2g\n",
      (unsigned long long)s->seed, what, s->nv, s->nc, rows.rank, rows.distance, rows.conflict,
      status == BAUM_OK ? "accelerated" : baum_message(),
      status == BAUM_OK ? error_of(s, &rows) : (double)NAN);
  }
}

/* ---- configurations ---- */

static void move_a_bit(scene *s, chance *c, double away)
{
  for (int i = 0; i < s->nv; i++) {
    s->q[i] += chance_number(c, -away, away);
    s->v[i] = chance_number(c, -3.0, 3.0);
  }
}

/* Projects the state onto the constraints. If this succeeds, tests the projected state and returns
 * true. */
static bool look_on_constraints(scene *s, const char *what)
{
  bool projected = baum_workspace_project(s->w, s->t, s->q, s->v) == BAUM_OK;
  if (projected) {
    look(s, what);
  }
  return projected;
}

/* Compares degrees of freedom with the rank of J at the present configuration, with and without the
 * rows of velocity level. */
static void compare_mobility(scene *s, const baum_mobility *mobility)
{
  quad_rows rows[2];
  bool *skipped = calloc((size_t)s->nc + 1, sizeof *skipped);
  assert_non_null(skipped);
  for (int k = 0; k < 2; k++) {
    assert_true(quad_rows_rank(s->w, s->nv, s->nc, s->t, s->q, skipped, &rows[k]));
    for (int i = 0; i < s->nc; i++) {
      skipped[i] = random_mechanism_is_velocity_row(s->random, i);
      s->tally->velocity_rows += k == 0 && skipped[i] ? 1 : 0;
    }
  }
  free(skipped);
  bool clear = fmin(rows[0].kept, rows[1].kept) >= CLEAR && !mobility->near_singular;
  if (!clear || mobility->conflicting_rows > 0) { /* drivers may prescribe unreachable values */
    return;
  }
  int want[2] = {s->nv - rows[0].rank, s->nv - rows[1].rank};
  int got[2] = {mobility->degrees_of_freedom, mobility->position_degrees_of_freedom};
  s->tally->mobilities++;
  if (got[0] != want[0] || got[1] != want[1]) {
    s->tally->counts[RANDOM_MOBILITY]++;
    (void)printf(
      "seed %llu: %d degrees of freedom of velocity, %d of position, must be %d, %d: %s\n",
      (unsigned long long)s->seed, got[0], got[1], want[0], want[1], mobility->text);
  }
}

static void look_at_all(scene *s, const baum_mechanism *m, chance *c)
{
  baum_mobility mobility = {.redundant_rows = 0};
  (void)baum_workspace_design(s->w, s->q, NULL);
  move_a_bit(s, c, 0.0);
  look_on_constraints(s, "design");
  move_a_bit(s, c, 0.2);
  bool moved = look_on_constraints(s, "moved");
  /* Rows that are redundant on the constraints may be independent off them. */
  check(baum_mechanism_mobility(m, &mobility, sizeof mobility));
  if (moved && s->nc > 0) {
    compare_mobility(s, &mobility);
  }
  if (mobility.redundant_rows == 0) {
    move_a_bit(s, c, 1.0);
    look(s, "free");
  }
}

void random_judge(random_mechanism *room, uint64_t seed, bool velocity_rows, random_tally *tally)
{
  chance c = chance_of(seed);
  random_kind kind = draw_kind(&c);
  kind.velocity_rows = velocity_rows ? 1 + (int)(seed % 3) : 0;
  scene s = {.random = room, .tally = tally, .seed = seed, .t = chance_number(&c, 0.0, 1.0)};
  random_mechanism_make(room, seed, &kind);
  assert_int_equal(baum_mechanism_sizes(room->mechanism, NULL, &s.nv, &s.nc), BAUM_OK);
  assert_int_equal(baum_workspace_create(room->mechanism, &s.w), BAUM_OK);
  s.q = calloc(4 * (size_t)s.nv, sizeof *s.q);
  assert_non_null(s.q);
  s.v = s.q + s.nv;
  s.a = s.v + s.nv;
  s.want = s.a + s.nv;
  look_at_all(&s, room->mechanism, &c);
  tally->mechanisms++;
  free(s.q);
  baum_workspace_destroy(s.w);
  random_mechanism_destroy(room);
}

long random_bad(const random_tally *tally)
{
  long bad = 0;
  for (int k = RANDOM_WRONG; k < RANDOM_VERDICTS; k++) {
    bad += tally->counts[k];
  }
  return bad;
}
