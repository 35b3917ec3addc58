/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds near-singular intervals of a run.
 *
 * The pivot p of a state is the smallest pivot in the solution of the equations at this state. p is
 * divided by the largest p of the run so far. Near a singular configuration p is proportional to
 * the square of the distance from it, so sqrt(p) falls linearly to zero and rises again linearly.
 *
 * - While p < BAUM_I_NEAR_PIVOT, the run is inside an interval. The ends of the interval are the
 *   last state before it and the first state after it.
 * - Steps may jump over a singular configuration. The run therefore examines the last three states.
 *   If sqrt(p) is smallest at the middle one of them, and falls and rises so steeply that it may be
 *   zero between the states, the run searches for the least p of the motion through them.
 * - If the least p < SINGULAR and J loses rank there, the interval is a crossing. The run then
 *   records the crossing, decides which branch the motion has taken (branch.c), and warns. In other
 *   intervals, which are not crossings, pivots are only smaller than usual. */
#include "simulate/crossing.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "mechanism/definition.h"

/* An interval counts as a crossing if J loses rank there and the smallest pivot of the interval is
 * below this limit. sqrt(p), and with it the distance from the singular configuration, is then at
 * most a thirtieth of its usual value. */
static const double SINGULAR = 1e-3;

/* Value of lowest.pivot after the crossing has been recorded. The interval then continues without
 * another warning. */
static const double RECORDED = -1.0;

/* [rad] After a path of this length from a singular configuration, the pivot should have risen. */
static const double STAY = 0.05;

/* [rad] Least distance between clear states. If they were closer, extrapolation would amplify
 * rounding and errors of the order of the tolerance. */
static const double SPACING = 0.1;

/* ---- memory ---- */

static void place_knots(const baum_mechanism *m, baum_i_knot *knots, int count, double **next)
{
  for (int k = 0; k < count; k++) {
    knots[k].q = *next;
    knots[k].v = *next + m->nq;
    *next += m->nq + m->nv;
  }
}

baum_status baum_i_crossings_create(baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  size_t numbers = (size_t)(m->nq + m->nv) * (BAUM_I_RECENT + BAUM_I_HERMITE_MOST + 4);
  baum_i_crossings *p = baum_i_alloc(1, sizeof *p + numbers * sizeof(double));
  BAUM_I_TRY(baum_i_check_memory(p));
  double *next = (double *)(p + 1);
  p->present.joint = -1;
  p->joint_noted = -1;
  place_knots(m, p->recent, BAUM_I_RECENT, &next);
  place_knots(m, p->clear, BAUM_I_HERMITE_MOST, &next);
  place_knots(m, &p->at, 1, &next);
  place_knots(m, &p->other, 1, &next);
  place_knots(m, &p->between, 1, &next);
  place_knots(m, &p->lowest, 1, &next);
  run->crossings = p;
  return BAUM_OK;
}

void baum_i_crossings_destroy(baum_i_crossings *crossings)
{
  baum_i_free(crossings);
}

void baum_i_crossings_forget(baum_i_crossings *p)
{
  if (!p) {
    return;
  }
  p->recent_count = 0;
  p->clear_count = 0;
  p->open = false;
}

/* ---- lists of knots ---- */

/* `state` contains q (nq) and v (nv). */
static void set_knot(const baum_mechanism *m, double t, double pivot, const double *state,
                     baum_i_knot *to)
{
  to->t = t;
  to->pivot = pivot;
  memcpy(to->q, state, (size_t)(m->nq + m->nv) * sizeof *state);
}

/* Return a new last knot (a stored state of the motion). If the list is full, remove the first
 * knot. */
static baum_i_knot *make_last(baum_i_knot *knots, int most, int *count)
{
  if (*count < most) {
    return &knots[(*count)++];
  }
  baum_i_knot first = knots[0];
  memmove(knots, knots + 1, (size_t)(most - 1) * sizeof *knots);
  knots[most - 1] = first;
  return &knots[most - 1];
}

static void keep_clear(baum_simulation *run, const baum_i_knot *state)
{
  baum_i_crossings *p = run->crossings;
  int n = p->clear_count;
  double rate = baum_i_scaled_size(run->workspace->mechanism, state->v);
  bool close = n >= 2 && fabs(p->clear[n - 1].t - p->clear[n - 2].t) * rate < SPACING;
  baum_i_knot *place =
    close ? &p->clear[n - 1] : make_last(p->clear, BAUM_I_HERMITE_MOST, &p->clear_count);
  set_knot(run->workspace->mechanism, state->t, state->pivot, state->q, place);
}

/* ---- states ---- */

static void note_state(baum_simulation *run, const baum_i_state *state, double pivot, int joint)
{
  baum_i_crossings *p = run->crossings;
  double since = p->recent_count > 0 ? state->t - baum_i_last_knot(p)->t : 0.0;
  if (p->recent_count > 0 && since == 0.0) {
    return;
  }
  if (since * run->problem.direction < 0.0) {
    baum_i_crossings_forget(p);
  }
  p->usual = fmax(p->usual, pivot);
  baum_i_knot *last = make_last(p->recent, BAUM_I_RECENT, &p->recent_count);
  set_knot(run->workspace->mechanism, state->t, pivot / p->usual, state->q, last);
  p->unseen = true;
  p->joint_noted = joint;
}

void baum_i_crossings_note(baum_simulation *run, const baum_i_state *state)
{
  if (run->crossings) {
    int joint = -1;
    double pivot = baum_i_smallest_pivot(run->workspace, NULL);
    if (pivot < 2.0 * BAUM_I_NEAR_PIVOT * run->crossings->usual) {
      /* Only near-singular states need the joint. The factor 2 covers rounding. */
      (void)baum_i_smallest_pivot(run->workspace, &joint);
    }
    note_state(run, state, pivot, joint);
  }
}

/* ---- crossings ---- */

static bool is_near(const baum_i_knot *state)
{
  return state->pivot < BAUM_I_NEAR_PIVOT;
}

/* Tell whether sqrt(p) may have been zero between the last three states. */
static bool may_have_jumped(const baum_i_crossings *p)
{
  const baum_i_knot *k = p->recent;
  if (p->recent_count < BAUM_I_RECENT || k[1].pivot > k[0].pivot || k[1].pivot > k[2].pivot) {
    return false;
  }
  double s[3] = {sqrt(k[0].pivot), sqrt(k[1].pivot), sqrt(k[2].pivot)};
  double before = fabs(k[1].t - k[0].t);
  double after = fabs(k[2].t - k[1].t);
  double falls = (s[0] - s[1]) / before * after;
  double grows = (s[2] - s[1]) / after * before;
  return s[1] <= 2.0 * fmax(falls, grows);
}

static void measure_turn(baum_simulation *run)
{
  baum_i_crossings *p = run->crossings;
  const baum_mechanism *m = run->workspace->mechanism;
  const baum_i_knot *last = baum_i_last_knot(p);
  if (p->recent_count < 2) {
    return;
  }
  double change = baum_i_velocity_change(m, last->v, last[-1].v);
  double size = fmax(baum_i_scaled_size(m, last->v), baum_i_scaled_size(m, last[-1].v));
  p->present.largest_turn = fmax(p->present.largest_turn, size > 0.0 ? change / size : 0.0);
}

static void open_crossing(baum_i_crossings *p, double from)
{
  p->open = true;
  p->lowest.t = from;
  p->lowest.pivot = (double)INFINITY;
  p->present = (baum_i_crossing){.from = from, .joint = -1};
}

/* Tell whether a pivot belongs to a singular configuration, or to a gap that a violation has
 * caused. */
static bool is_singular(baum_simulation *run, double pivot)
{
  return pivot < SINGULAR || baum_i_branch_is_opened(run, pivot);
}

/* Tell whether all rows of J together, active and omitted, keep their rank although the pivot is
 * small. This has two possible causes: the active rows alone lose rank, or a body is light. When a
 * light rod comes taut, for example, the pivot falls to the ratio of the masses, but not to
 * zero. */
static bool keeps_its_rank(baum_simulation *run, double t, const double *q, double pivot)
{
  return is_singular(run, pivot) && baum_i_rows_are_apart(run->workspace, t, q);
}

/* Store the pivot of a configuration in p->lowest if it is the smallest pivot so far. A pivot that
 * looks singular is not stored if J keeps its rank. Return whether the pivot was stored. */
static bool is_lowest(baum_simulation *run, double t, const double *q, double pivot, int joint)
{
  baum_i_crossings *p = run->crossings;
  if (!(pivot < p->lowest.pivot) || keeps_its_rank(run, t, q, pivot)) {
    return false;
  }
  p->lowest.t = t;
  p->lowest.pivot = pivot;
  memcpy(p->lowest.q, q, (size_t)run->workspace->mechanism->nq * sizeof *q);
  p->present.joint = joint;
  return true;
}

/* Search for the smallest pivot between the last three states. */
static void search_least_pivot(baum_simulation *run)
{
  baum_i_crossings *p = run->crossings;
  double at = 0.0;
  int joint = -1;
  double pivot = baum_i_branch_least_pivot(run, p->recent, BAUM_I_RECENT, &at, &joint);
  baum_i_hermite(run->workspace->mechanism, p->recent, BAUM_I_RECENT, at, p->at.q, p->at.v,
                 run->workspace->work_q);
  if (is_lowest(run, at, p->at.q, pivot, joint)) {
    p->present.gap = baum_i_branch_has_gap(run, at, pivot);
  }
}

/* The last state is near-singular. If it has the smallest pivot of the interval, store this pivot
 * and find out whether there is a gap. */
static void examine_last(baum_simulation *run)
{
  baum_i_crossings *p = run->crossings;
  const baum_i_knot *last = baum_i_last_knot(p);
  if (is_lowest(run, last->t, last->q, last->pivot, p->joint_noted)) {
    p->present.gap = last->pivot < SINGULAR && baum_i_branch_has_gap_at_end(run);
  }
}

static const char *const BRANCHES[] = {
  [BAUM_BRANCH_CONTINUED] = "the motion continues smoothly; this is correct at a true bifurcation "
                            "and wrong if two branches "
                            "only pass close to each other",
  [BAUM_BRANCH_LEFT] =
    "the motion has left its branch; prefer projection, with rk8 or a step that does not end there",
  [BAUM_BRANCH_UNKNOWN] = "whether the motion stays on its branch is unknown; compare with "
                          "projection and another step",
};

static void record_crossing(baum_simulation *run, double to)
{
  baum_i_crossings *p = run->crossings;
  baum_near_singular entry = {.struct_size = sizeof entry, .begin = p->present.from, .end = to};
  baum_i_branch_decide(run, &entry);
  entry.joint = baum_i_joint_id(run->workspace->mechanism, p->present.joint);
  baum_i_run_warn(
    run,
    entry.branch == BAUM_BRANCH_CONTINUED ? BAUM_WARNING_SINGULARITY_CROSSED : BAUM_WARNING_BRANCH,
    entry.t, p->present.joint,
    "t = %.9g s to %.9g s: near a singular configuration (smallest pivot %.1e, "
    "relative to the usual one, %s): %s",
    entry.begin, entry.end, entry.pivot,
    baum_i_joint_label(run->workspace->mechanism, p->present.joint).text, BRANCHES[entry.branch]);
  if (run->counters.near_singular_intervals < BAUM_I_NEAR_SINGULAR_KEPT) {
    p->kept[run->counters.near_singular_intervals] = entry;
  }
  run->counters.near_singular_intervals++;
  run->counters.branch_warnings += entry.branch != BAUM_BRANCH_CONTINUED;
  if (entry.branch != BAUM_BRANCH_CONTINUED) {
    p->clear_count = 0;
  }
}

/* Record the interval if it was a crossing and is not recorded yet. */
static void decide_crossing(baum_simulation *run)
{
  baum_i_crossings *p = run->crossings;
  double pivot = p->lowest.pivot;
  if (pivot != RECORDED && is_singular(run, pivot) &&
      !keeps_its_rank(run, p->lowest.t, p->lowest.q, pivot)) {
    record_crossing(run, baum_i_last_knot(p)->t);
    p->lowest.pivot = RECORDED;
  }
}

/* End an interval, and record it if it was a crossing. This is decided only now, because the
 * violation that may have caused a gap was not known before. */
static void close_crossing(baum_simulation *run)
{
  decide_crossing(run);
  run->crossings->open = false;
}

/* After a singular configuration p rises with the square of the path length. If it does not, the
 * motion has taken a branch of singular configurations, and the interval might never end. */
static bool stays_singular(const baum_simulation *run)
{
  const baum_i_crossings *p = run->crossings;
  const baum_i_knot *last = baum_i_last_knot(p);
  double rate = baum_i_scaled_size(run->workspace->mechanism, last->v);
  double path = rate * fabs(last->t - p->lowest.t);
  return path > STAY && last->pivot < SINGULAR * path * path;
}

static void examine_inside(baum_simulation *run)
{
  baum_i_crossings *p = run->crossings;
  measure_turn(run);
  if (may_have_jumped(p)) {
    search_least_pivot(run);
  }
  if (is_near(baum_i_last_knot(p))) {
    examine_last(run);
    if (stays_singular(run)) {
      decide_crossing(run);
    }
  } else {
    close_crossing(run);
  }
}

/* Tell whether the run has jumped over a singular configuration between the last three states. */
static bool has_jumped(baum_simulation *run)
{
  baum_i_crossings *p = run->crossings;
  if (is_near(baum_i_last_knot(p)) || !may_have_jumped(p)) {
    return false;
  }
  open_crossing(p, p->recent[0].t);
  search_least_pivot(run);
  p->open = is_singular(run, p->lowest.pivot);
  return p->open;
}

/* Store the last state but one as a clear state, unless it is near-singular. Call this only if the
 * run has not jumped over a singular configuration between the last three states. */
static void keep_last_but_one(baum_simulation *run)
{
  const baum_i_crossings *p = run->crossings;
  const baum_i_knot *last = baum_i_last_knot(p);
  if (p->recent_count >= 2 && !is_near(last - 1)) {
    keep_clear(run, last - 1);
  }
}

static void examine_outside(baum_simulation *run)
{
  baum_i_crossings *p = run->crossings;
  const baum_i_knot *last = baum_i_last_knot(p);
  if (has_jumped(run)) {
    measure_turn(run);
    close_crossing(run);
    return;
  }
  keep_last_but_one(run);
  if (is_near(last)) {
    open_crossing(p, p->recent_count >= 2 ? last[-1].t : last->t);
    measure_turn(run);
    examine_last(run);
  }
}

/* Examine the state that was noted last. Most calls return early. */
void baum_i_crossings_look(baum_simulation *run)
{
  baum_i_crossings *p = run->crossings;
  if (!p || !p->unseen) {
    return;
  }
  p->unseen = false;
  if (!p->open && !is_near(baum_i_last_knot(p)) && !may_have_jumped(p)) {
    keep_last_but_one(run);
    return;
  }
  baum_i_probe probe;
  baum_i_probe_begin(&probe, run->workspace);
  if (p->open) {
    examine_inside(run);
  } else {
    examine_outside(run);
  }
  (void)baum_i_probe_end(&probe, BAUM_OK);
}

void baum_i_crossings_end(baum_simulation *run)
{
  baum_i_crossings *p = run->crossings;
  if (p->open) {
    close_crossing(run);
  }
  baum_i_crossings_forget(p);
  p->unseen = false;
  p->usual = 0.0;
}

/* Recompute the pivots of `knots`, and raise *usual to the largest of them. */
static baum_status find_pivots(baum_workspace *w, baum_i_knot *knots, int count, double *usual)
{
  for (int k = 0; k < count; k++) {
    BAUM_I_TRY(baum_i_find_pivot(w, knots[k].t, knots[k].q, knots[k].v));
    knots[k].pivot = baum_i_smallest_pivot(w, NULL);
    *usual = fmax(*usual, knots[k].pivot);
  }
  return BAUM_OK;
}

void baum_i_crossings_renew(baum_simulation *run)
{
  baum_i_crossings *p = run->crossings;
  baum_i_probe probe;
  double usual = 0.0;
  baum_i_probe_begin(&probe, run->workspace);
  baum_status status = find_pivots(run->workspace, p->clear, p->clear_count, &usual);
  if (status == BAUM_OK) {
    status = find_pivots(run->workspace, p->recent, p->recent_count, &usual);
  }
  (void)baum_i_probe_end(&probe, BAUM_OK);
  if (status != BAUM_OK || !(usual > 0.0)) {
    baum_i_crossings_end(run);
    return;
  }
  p->usual = usual;
  for (int k = 0; k < p->recent_count; k++) {
    p->recent[k].pivot /= usual;
  }
  for (int k = 0; k < p->clear_count; k++) {
    p->clear[k].pivot /= usual;
  }
}

/* ---- steps of variable length ---- */

/* States inside a step are examined if the step may lead across a singular configuration. Let angle
 * [rad] be the size of the motion in the step, and p the smaller pivot of the two ends of the step.
 * The states are examined if angle > LONG and p < PIVOT, or if angle > LONG_NEAR and p <
 * PIVOT_NEAR. */
static const double LONG_NEAR = 0.25;
static const double LONG = 0.5;
static const double PIVOT_NEAR = 0.3;
static const double PIVOT = 0.5;

enum { INSIDE = 16 }; /* largest number of parts of a step */

/* Return the number of parts into which the step to `end` is divided. */
static int count_pieces(const baum_simulation *run, const baum_i_state *end, double pivot)
{
  const baum_i_crossings *p = run->crossings;
  if (p->recent_count == 0) {
    return 1;
  }
  const baum_i_knot *start = baum_i_last_knot(p);
  const baum_mechanism *m = run->workspace->mechanism;
  double rate = fmax(baum_i_scaled_size(m, start->v), baum_i_scaled_size(m, end->v));
  double angle = rate * fabs(end->t - start->t);
  double least = fmin(start->pivot, pivot / p->usual);
  bool is_long = (angle > LONG && least < PIVOT) || (angle > LONG_NEAR && least < PIVOT_NEAR);
  return is_long ? (int)fmin(ceil(angle / SPACING), INSIDE) : 1;
}

/* Examine a state inside the last step. */
static void examine_between(baum_simulation *run, double t)
{
  baum_i_crossings *p = run->crossings;
  baum_i_state between = {.t = t, .q = p->between.q, .v = p->between.v};
  if (run->integrator->interpolate(run->self, &run->problem, t, between.q, between.v) == BAUM_OK &&
      baum_i_find_pivot(run->workspace, t, between.q, between.v) == BAUM_OK) {
    baum_i_crossings_note(run, &between);
    baum_i_crossings_look(run);
  }
}

/* Failures are not reported here. They occur again in the next step, which reports them. */
bool baum_i_crossings_step(baum_simulation *run, const baum_i_state *end)
{
  baum_i_crossings *p = run->crossings;
  baum_workspace *w = run->workspace;
  if (!p) {
    return false;
  }
  baum_i_probe probe;
  baum_i_probe_begin(&probe, w);
  baum_status status =
    run->integrator->solves_residuals ? baum_i_find_pivot(w, end->t, end->q, end->v) : BAUM_OK;
  int joint = -1;
  double pivot = baum_i_smallest_pivot(w, &joint);
  int pieces = status == BAUM_OK ? count_pieces(run, end, pivot) : 1;
  double start = pieces > 1 ? baum_i_last_knot(p)->t : end->t;
  for (int k = 1; k < pieces; k++) {
    examine_between(run, start + (end->t - start) * k / pieces);
  }
  if (status == BAUM_OK) {
    note_state(run, end, pivot, joint);
  }
  (void)baum_i_probe_end(&probe, BAUM_OK);
  return run->integrator->solves_residuals || pieces > 1;
}

/* ---- public ---- */

baum_status baum_simulation_near_singular(const baum_simulation *simulation, int64_t k,
                                          baum_near_singular *out, size_t caller_size)
{
  const char *call = "baum_simulation_near_singular";
  BAUM_I_TRY(baum_i_run_check_out(simulation, out, caller_size, call));
  int64_t count = simulation->counters.near_singular_intervals;
  int64_t most = count < BAUM_I_NEAR_SINGULAR_KEPT ? count : BAUM_I_NEAR_SINGULAR_KEPT;
  BAUM_I_TRY(baum_i_check_entry(k, 0, most, call));
  baum_near_singular entry = simulation->crossings->kept[k];
  /* in a restored run, the id may contain the tag of another mechanism */
  if (entry.joint.index1 > 0) {
    entry.joint = baum_i_joint_id(simulation->workspace->mechanism, entry.joint.index1 - 1);
  }
  baum_i_give_sized(out, caller_size, &entry, sizeof entry);
  return BAUM_OK;
}
