/* SPDX-License-Identifier: BSD-3-Clause */
/* Decides which branch a motion has taken after a singular configuration.
 *
 * In a singular configuration several branches of motion cross, and each branch has its own
 * direction. The smooth motion is the motion whose velocity is continuous. States are called clear
 * if they are far enough from the singular configuration. Polynomials p through positions and
 * velocities of the clear states before the singular configuration are extrapolated to the first
 * clear state after it. There the derivative p' is compared with the velocity v of the run:
 *
 *   jump    (max |v_i - p_i'| / s_i) / (max |v_i| / s_i),   s_i the scale of coordinate i
 *   error   the same, but instead of v - p' the difference between the p' of two polynomials, whose
 *           degrees are 2 m - 1 and 2 m - 3
 *
 * m is the number of clear states through which p passes. It is chosen so that the error is as
 * small as possible.
 *
 * It depends on the mechanism whether its branches really cross. If the branches only come close to
 * each other, there is a gap between them, and the singular configurations inside the gap violate
 * the constraints. The true motion then turns sharply from one branch to the other. A step that
 * jumps over this turn continues smoothly, but on the wrong branch. To detect a gap, the
 * constraints are evaluated where the motion has its smallest pivot. There is a gap if the
 * violation at this point is larger than the violation of the run plus the error of the polynomial.
 * Runs whose steps are short enough to resolve the turn follow the right branch. */
#include <math.h>
#include <string.h>

#include "base/least.h"
#include "simulate/crossing.h"

/* A jump is the relative change of velocity at a crossing. The velocities of two branches differ by
 * about the size of the velocity: runs that changed to another branch had jumps of at least 0.9.
 * With the longest steps, the error of the polynomials is 0.06. Up to SMALL_JUMP the motion has
 * stayed on its branch. Above LARGE_JUMP it has left its branch. In between, the branch is
 * unknown. */
static const double SMALL_JUMP = 0.1;
static const double LARGE_JUMP = 0.3;
/* A jump that is both above KICK and above SURELY times its estimated error is caused by steps with
 * inaccurate accelerations. None of 2688 correct runs had such a jump. */
static const double KICK = 5e-4;
static const double SURELY = 50.0;
/* For jumps above LARGE_KICK, the smaller factor LIKELY replaces SURELY, because runs with such
 * jumps are mostly wrong after the next crossing. The estimated error depends on the steps and
 * therefore on the tolerance. In correct runs, the estimated error may be more than ten times
 * smaller than the true one. */
static const double LARGE_KICK = 2e-3;
static const double LIKELY = 25.0;
/* If the estimated error of a jump is larger than this, the branch is unknown. */
static const double KNOWN = 0.1;
/* The steps resolve a turn if v changes by less than this fraction from step to step. */
static const double SMALL_TURN = 0.4;
/* If the constraints are violated, branches that would otherwise cross are separated by a gap. A
 * smallest pivot of up to OPENED times the violation is explained by the violation alone. In an
 * example the factor was about five. If the pivot is below GAP_OF_VIOLATION times the violation,
 * the violation may have caused the gap. */
static const double OPENED = 30.0;
static const double GAP_OF_VIOLATION = 10.0;
/* A violation (as a displacement) or a smallest pivot up to this value does not show a gap. Where
 * branches cross, the violation and the smallest pivot are 0. */
static const double GAP = 1e-5;

/* ---- smallest pivot of the motion ---- */

static void follow(const baum_simulation *run, const baum_i_knot *knots, int count, double t,
                   baum_i_knot *out)
{
  baum_workspace *w = run->workspace;
  out->t = t;
  baum_i_hermite(w->mechanism, knots, count, t, out->q, out->v, w->work_q);
}

/* The part of the motion in which the smallest pivot is searched, and the joint that has the
 * smallest pivot so far. */
typedef struct look {
  baum_simulation *run;
  const baum_i_knot *knots;
  int count;
  double least;
  int joint;
} look;

/* Return the pivot at time t of the motion, relative to the usual pivot. */
static double pivot_at(void *user, double t)
{
  look *in = user;
  baum_workspace *w = in->run->workspace;
  baum_i_crossings *p = in->run->crossings;
  int joint = -1;
  double pivot = 0.0;
  follow(in->run, in->knots, in->count, t, &p->at);
  if (baum_i_find_pivot(w, t, p->at.q, p->at.v) == BAUM_OK) {
    pivot = baum_i_smallest_pivot(w, &joint) / p->usual;
  } else {
    pivot = w->point.retry ? (double)INFINITY : 0.0;
  }
  if (pivot < in->least) {
    in->least = pivot;
    in->joint = joint;
  }
  return pivot;
}

/* The search finds the time of the smallest pivot to within a millionth of the interval between the
 * first and the last knot. The relative error of the pivot is only about the square of a millionth,
 * because the pivot has a minimum at this time. */
double baum_i_branch_least_pivot(baum_simulation *run, const baum_i_knot *knots, int count,
                                 double *at, int *joint)
{
  look in = {run, knots, count, (double)INFINITY, -1};
  double first = knots[0].t;
  double last = knots[count - 1].t;
  const double ends[2] = {fmin(first, last), fmax(first, last)};
  double pivot = baum_i_least(pivot_at, &in, ends, 1e-6 * (ends[1] - ends[0]), 32, at);
  *joint = in.joint;
  return pivot;
}

/* ---- gap ---- */

/* Return the largest violation as a scaled displacement. If it cannot be evaluated, return
 * INFINITY. */
static double violation_at(baum_simulation *run, const baum_i_knot *at)
{
  baum_workspace *w = run->workspace;
  int row = -1;
  baum_status status = baum_i_position_stage(w, at->t, at->q);
  return status == BAUM_OK ? baum_i_row_sizes(w, w->phi, &row) : (double)INFINITY;
}

/* Return the largest scaled difference between two configurations. */
static double apart(const baum_simulation *run, const double *q, const double *p)
{
  baum_workspace *w = run->workspace;
  baum_i_difference(w->mechanism, p, q, w->work_v);
  return baum_i_scaled_size(w->mechanism, w->work_v);
}

/* The last state of the run has the smallest pivot of the crossing. This pivot shows a gap if it is
 * clearly above 0 and the violation of the state does not explain its size. */
bool baum_i_branch_has_gap_at_end(baum_simulation *run)
{
  const baum_i_crossings *p = run->crossings;
  const baum_i_knot *last = baum_i_last_knot(p);
  return last->pivot > GAP && last->pivot > OPENED * violation_at(run, last);
}

/* Tell whether the branches have a gap at a time between two states of the run. A polynomial
 * through the states gives the configuration at this time. The violation of this configuration
 * shows a gap if it is larger than the violations of the states plus the error of the
 * polynomial. */
bool baum_i_branch_has_gap(baum_simulation *run, double t, double pivot)
{
  baum_i_crossings *p = run->crossings;
  double own = 0.0;
  for (int k = 0; k < p->recent_count; k++) {
    own = fmax(own, violation_at(run, &p->recent[k]));
  }
  follow(run, p->recent, p->recent_count, t, &p->at);
  follow(run, p->recent + 1, p->recent_count - 1, t, &p->other);
  double error = apart(run, p->at.q, p->other.q);
  double violation = violation_at(run, &p->at);
  double noise = GAP + 10.0 * (own + error);
  return violation > noise || (pivot > noise && pivot > OPENED * violation);
}

/* If the constraints are violated, a gap separates branches that would otherwise cross. A run that
 * has drifted off the constraints then turns sharply from one branch to the other. */
bool baum_i_branch_is_opened(baum_simulation *run, double pivot)
{
  const baum_i_crossings *p = run->crossings;
  return pivot < GAP_OF_VIOLATION * violation_at(run, baum_i_last_knot(p));
}

/* ---- jump ---- */

double baum_i_velocity_change(const baum_mechanism *m, const double *v, const double *w)
{
  double most = 0.0;
  for (int i = 0; i < m->nv; i++) {
    most = fmax(most, fabs(v[i] - w[i]) / m->scale[i]);
  }
  return most;
}

static void find_jump(baum_simulation *run, double *jump, double *error)
{
  baum_i_crossings *p = run->crossings;
  const baum_i_knot *behind = baum_i_last_knot(p);
  const baum_i_knot *end = p->clear + p->clear_count;
  const baum_mechanism *mechanism = run->workspace->mechanism;
  double size = baum_i_scaled_size(mechanism, behind->v);
  if (p->clear_count > 0) {
    size = fmax(size, baum_i_scaled_size(mechanism, end[-1].v));
  }
  *jump = *error = (double)NAN;
  for (int m = 2; m <= p->clear_count && size > 0.0; m++) {
    follow(run, end - m + 1, m - 1, behind->t, &p->other);
    follow(run, end - m, m, behind->t, &p->at);
    double e = baum_i_velocity_change(mechanism, p->at.v, p->other.v) / size;
    if (!(e >= *error)) {
      *error = e;
      *jump = baum_i_velocity_change(mechanism, behind->v, p->at.v) / size;
    }
  }
}

/* ---- decision ---- */

static baum_branch judge(double jump, double error, bool gap, double largest_turn)
{
  if (gap) {
    return largest_turn < SMALL_TURN ? BAUM_BRANCH_CONTINUED : BAUM_BRANCH_UNKNOWN;
  }
  if (!(error <= KNOWN)) {
    return BAUM_BRANCH_UNKNOWN;
  }
  bool kicked = jump > fmax(KICK, SURELY * error) || jump > fmax(LARGE_KICK, LIKELY * error);
  if (!kicked && jump <= fmax(SMALL_JUMP, 4.0 * error)) {
    return BAUM_BRANCH_CONTINUED;
  }
  return jump > LARGE_JUMP ? BAUM_BRANCH_LEFT : BAUM_BRANCH_UNKNOWN;
}

void baum_i_branch_decide(baum_simulation *run, baum_near_singular *out)
{
  const baum_i_crossings *p = run->crossings;
  out->t = p->lowest.t;
  out->pivot = p->lowest.pivot;
  find_jump(run, &out->jump, &out->jump_error);
  out->branch = judge(out->jump, out->jump_error, p->present.gap, p->present.largest_turn);
}
