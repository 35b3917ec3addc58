/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs random mechanisms with every integrator and formulation, and compares the runs with an
 * accurate reference.
 *
 *   bench_random_runs [COUNT [FIRST_SEED [BEGIN [SPAN]]]]     default: 50 mechanisms from
 *   seed 0, from 0 s over 2 s
 *
 * If the span is negative, runs go backward in time. The reference is rk8 with projection at rtol
 * 1e-12. If a run of rk8 with gains and KLU does not agree with this reference, the mechanism is
 * skipped. The error of a run is its largest position error at the end. Lengths are relative to the
 * characteristic length. The growth of a motion is the factor by which it amplifies small
 * perturbations of the start. With a variable step, the allowed error is about PROMISE times rtol
 * times the growth. With a fixed step, the allowed error is the step times the growth, but at least
 * WRONG. A run without a warning is called met if its error is allowed. If its error is larger than
 * allowed, the run is called poor up to an error of WRONG, and silently wrong above WRONG. However,
 * a fixed-step run is called poor, and not silently wrong, if a step four times shorter halves its
 * error. Errors that arise during the motion may grow more than perturbations of the start. If a
 * run is called silently wrong, one should therefore first check whether such errors have grown.
 * The program prints runs that are silently wrong, runs that fail although the reference succeeds,
 * and warnings that are not justified.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "random_mechanism.h"

enum { SIZE = 64 };

static const double PROMISE = 1000.0;
static const double WRONG = 1e-2;
static const double NUDGE = 1e-8;
static const double STEP = 1e-3;
static const double AGREEMENT = 1e-6;
static const double FLOOR = 1e-8;

typedef enum verdict {
  MET,
  POOR,
  SILENT,
  WARNED,
  IN_VAIN,
  REFUSED,
  STOPPED,
  UNSUPPORTED,
  VERDICTS
} verdict;

static const char *const NAMES[VERDICTS] = {"met",     "poor",    "silently wrong", "warned",
                                            "in vain", "refused", "stopped",        "unsupported"};

typedef struct scene {
  uint64_t seed;
  random_mechanism random;
  baum_mechanism *m;
  int nv;
  double scale;
  double begin;
  double span;
  double unit[SIZE]; /* units of position errors: the characteristic length, or 1 rad */
  double q0[SIZE];
  double v0[SIZE];
  double q[SIZE]; /* at the end */
  double growth;
} scene;

/* ---- scenes ---- */

static random_kind draw_kind(chance *c)
{
  random_kind kind = {.bodies = 1 + chance_below(c, 7)};
  kind.joints = 1 + chance_below(c, 1 + kind.bodies);
  kind.particles = chance_below(c, 3) == 0 ? chance_below(c, 60) : 0;
  kind.coordinates = chance_below(c, 4) == 0 ? chance_below(c, 40) : 0;
  kind.pins = 40 + chance_below(c, 61);
  kind.constant = chance_below(c, 2) == 0;
  kind.hub = chance_below(c, 10) == 0;
  kind.span = chance_decade(c, 1.0, chance_below(c, 6) == 0 ? 1e3 : 5.0);
  kind.loads = chance_below(c, 3);
  kind.springs = chance_below(c, 4);
  kind.drivers_begin = true;
  kind.velocity_rows = chance_below(c, 3) == 0 ? 1 + chance_below(c, 2) : 0;
  return kind;
}

static void set_velocity(scene *s, const random_body *b)
{
  int32_t first = 0;
  assert_int_equal(baum_mechanism_columns(s->random.mechanism, b->id, &first, NULL), BAUM_OK);
  const double *v = s->v0 + first;
  for (int k = 0; k < b->size; k++) {
    s->unit[first + k] = b->kind == 'c' || (b->kind == 'b' && k == 2) ? 1.0 : s->scale;
  }
  baum_status status = BAUM_OK;
  if (b->kind == 'b') {
    baum_planar_body_def def;
    (void)baum_mechanism_get_planar_body(s->m, b->id, &def, sizeof def);
    memcpy(def.velocity, v, sizeof def.velocity);
    def.angular_velocity = v[2];
    status = baum_mechanism_set_planar_body(s->m, b->id, &def);
  } else if (b->kind == 'p') {
    baum_planar_particle_def def;
    (void)baum_mechanism_get_planar_particle(s->m, b->id, &def, sizeof def);
    memcpy(def.velocity, v, sizeof def.velocity);
    status = baum_mechanism_set_planar_particle(s->m, b->id, &def);
  } else {
    baum_coordinates_def def;
    (void)baum_mechanism_get_coordinates(s->m, b->id, &def, sizeof def);
    def.v = v;
    status = baum_mechanism_set_coordinates(s->m, b->id, &def);
  }
  assert_int_equal(status, BAUM_OK);
}

/* Makes the mechanism of a seed, and sets velocities that satisfy the constraints. Returns false if
 * projection fails. */
static bool make(scene *s, uint64_t seed, double begin, double span)
{
  chance c = chance_of(seed);
  random_kind kind = draw_kind(&c);
  baum_workspace *w = NULL;
  *s = (scene){.seed = seed, .begin = begin, .span = span, .growth = 1.0};
  kind.start = begin;
  random_mechanism_make(&s->random, seed, &kind);
  (void)baum_mechanism_sizes(s->random.mechanism, NULL, &s->nv, NULL);
  (void)baum_mechanism_get_characteristic_length(s->random.mechanism, &s->scale);
  assert_true(s->nv <= SIZE);
  assert_int_equal(baum_workspace_create(s->random.mechanism, &w), BAUM_OK);
  (void)baum_workspace_design(w, s->q0, NULL);
  bool rests = chance_below(&c, 4) == 0;
  for (int i = 0; i < s->nv; i++) {
    s->v0[i] = rests ? 0.0 : chance_number(&c, -3.0, 3.0);
  }
  bool fits = baum_workspace_project(w, begin, s->q0, s->v0) == BAUM_OK;
  baum_workspace_destroy(w);
  assert_int_equal(baum_mechanism_copy(s->random.mechanism, &s->m), BAUM_OK);
  for (int i = 1; i < s->random.body_count; i++) {
    set_velocity(s, &s->random.bodies[i]);
  }
  assert_int_equal(baum_mechanism_freeze(s->m), BAUM_OK);
  return fits;
}

/* ---- runs ---- */

typedef struct result {
  baum_status status;
  bool began;
  bool doubts; /* whether the run has a warning that doubts the motion */
  double q[SIZE];
  char text[400];
} result;

static void read_warnings(const baum_simulation *run, result *out)
{
  baum_warning warning;
  for (int64_t k = 0; baum_simulation_warning(run, k, &warning, sizeof warning) == BAUM_OK; k++) {
    if (warning.doubts_motion) {
      out->doubts = true;
      memcpy(out->text, warning.text, sizeof warning.text);
    }
  }
}

/* Makes a run from (q, v). If q is NULL, it starts from the design configuration. */
static result run(const scene *s, baum_simulation_options o, const double *q, const double *v)
{
  baum_simulation *r = NULL;
  o.start_time = s->begin;
  o.max_steps = 1000000;
  result out = {.status = baum_simulation_create(s->m, &o, &r)};
  out.began = r != NULL;
  if (out.began && q) {
    out.status = baum_simulation_set_state(r, s->begin, q, v);
  }
  if (out.status >= BAUM_OK) {
    out.status = baum_simulation_advance_to(r, s->begin + s->span);
    memcpy(out.q, baum_simulation_q(r), (size_t)s->nv * sizeof *out.q);
  }
  if (out.status < BAUM_OK) {
    (void)snprintf(out.text, sizeof out.text, "%.399s", baum_message());
  } else {
    read_warnings(r, &out);
  }
  baum_simulation_destroy(r);
  return out;
}

static double apart(const scene *s, const double *a, const double *b)
{
  double most = 0.0;
  for (int i = 0; i < s->nv; i++) {
    double one = fabs(a[i] - b[i]) / s->unit[i];
    most = one <= most ? most : one; /* this keeps NaN */
  }
  return most;
}

static baum_simulation_options tight(baum_formulation formulation, baum_solver solver)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk8();
  o.formulation = formulation;
  o.solver = solver;
  o.rtol = 1e-12;
  return o;
}

static void find_growth(scene *s)
{
  chance c = chance_of(s->seed + 1);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(s->m, &w), BAUM_OK);
  for (int k = 0; k < 3; k++) {
    double q[SIZE];
    double v[SIZE];
    for (int i = 0; i < s->nv; i++) {
      q[i] = s->q0[i] + NUDGE * s->unit[i] * chance_number(&c, -1.0, 1.0);
      v[i] = s->v0[i] + NUDGE * s->unit[i] * chance_number(&c, -3.0, 3.0);
    }
    (void)baum_workspace_project(w, s->begin, q, v);
    result r = run(s, tight(BAUM_FORMULATION_PROJECTION, BAUM_SOLVER_AUTO), q, v);
    if (r.status >= BAUM_OK) {
      s->growth = fmax(s->growth, apart(s, r.q, s->q) / NUDGE);
    }
  }
  baum_workspace_destroy(w);
}

static bool find_truth(scene *s)
{
  result a = run(s, tight(BAUM_FORMULATION_PROJECTION, BAUM_SOLVER_AUTO), NULL, NULL);
  result b = run(s, tight(BAUM_FORMULATION_BAUMGARTE, BAUM_SOLVER_KLU), NULL, NULL);
  double error = apart(s, a.q, b.q);
  if (a.status < BAUM_OK || b.status < BAUM_OK || !(error < AGREEMENT)) {
    (void)printf("seed %llu: no reference, two runs differ by %.2g: %s / %s\n",
                 (unsigned long long)s->seed, error, a.text, b.text);
    return false;
  }
  memcpy(s->q, a.q, sizeof s->q);
  find_growth(s);
  return true;
}

/* ---- verdicts ---- */

static verdict judge(const scene *s, const baum_simulation_options *o, const result *r,
                     double error)
{
  double promise =
    isnan(o->step) ? (PROMISE * o->rtol + FLOOR) * s->growth : fmax(WRONG, o->step * s->growth);
  if (r->status == BAUM_ERR_UNSUPPORTED) {
    return UNSUPPORTED;
  }
  if (!r->began) {
    return REFUSED;
  }
  if (r->status < BAUM_OK) {
    return STOPPED;
  }
  if (r->doubts) {
    bool vain = error <= promise && o->formulation != BAUM_FORMULATION_INDEX3;
    return vain ? IN_VAIN : WARNED;
  }
  if (error <= promise) {
    return MET;
  }
  return error <= WRONG ? POOR : SILENT;
}

static bool shrinks(const scene *s, baum_simulation_options o, double error)
{
  o.step /= 4.0;
  result r = run(s, o, NULL, NULL);
  return r.status >= BAUM_OK && apart(s, r.q, s->q) < 0.5 * error;
}

static void try_way(const scene *s, const baum_simulation_options *o, long counts[VERDICTS])
{
  result r = run(s, *o, NULL, NULL);
  double error = apart(s, r.q, s->q);
  bool fixed = !isnan(o->step);
  verdict found = judge(s, o, &r, error);
  if (found == SILENT && fixed && shrinks(s, *o, error)) {
    found = POOR;
  }
  counts[found]++;
  if (found != MET && found != WARNED && found != UNSUPPORTED && !(found == POOR && fixed)) {
    (void)printf("seed %llu, %s, %s, %s %g: %s, error %.2g, growth %.2g: %s\n",
                 (unsigned long long)s->seed, baum_integrator_name(o->integrator),
                 baum_formulation_name(o->formulation), fixed ? "step" : "rtol",
                 fixed ? o->step : o->rtol, NAMES[found], error, s->growth, r.text);
  }
}

static void try_formulation(const scene *s, baum_simulation_options o, long counts[VERDICTS])
{
  if (baum_integrator_has_variable_step(o.integrator)) {
    for (int k = 4; k <= 8; k += 2) {
      o.rtol = pow(10.0, -k);
      try_way(s, &o, counts);
    }
  }
  if (baum_integrator_has_fixed_step(o.integrator)) {
    o.rtol = (double)NAN;
    o.step = STEP;
    try_way(s, &o, counts);
  }
}

static void try_ways(const scene *s, long counts[VERDICTS])
{
  baum_simulation_options o = baum_simulation_options_default();
  for (int k = 0; (o.integrator = baum_integrator_at(k)); k++) {
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      o.formulation = (baum_formulation)f;
      if (baum_integrator_offers(o.integrator, o.formulation)) {
        try_formulation(s, o, counts);
      }
    }
  }
}

int main(int count, char **arguments)
{
  static scene s;
  long counts[VERDICTS] = {0};
  long judged = 0;
  uint64_t mechanisms = count > 1 ? strtoull(arguments[1], NULL, 10) : 50;
  uint64_t first = count > 2 ? strtoull(arguments[2], NULL, 10) : 0;
  double begin = count > 3 ? strtod(arguments[3], NULL) : 0.0;
  double span = count > 4 ? strtod(arguments[4], NULL) : 2.0;
  for (uint64_t k = 0; k < mechanisms; k++) {
    if (make(&s, first + k, begin, span) && find_truth(&s)) {
      try_ways(&s, counts);
      judged++;
    }
    baum_mechanism_destroy(s.m);
    random_mechanism_destroy(&s.random);
  }
  (void)printf("%ld of %llu mechanisms judged:", judged, (unsigned long long)mechanisms);
  for (int k = 0; k < VERDICTS; k++) {
    (void)printf(" %ld %s%s", counts[k], NAMES[k], k + 1 < VERDICTS ? "," : "\n");
  }
  return counts[SILENT] == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
