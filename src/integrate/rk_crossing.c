/* SPDX-License-Identifier: BSD-3-Clause */
#include "integrate/rk_crossing.h"

#include <math.h>
#include <string.h>

#include "integrate/limit.h"

/* [rad] Scaled motion in a step. Near a singular configuration, a step that would move less than
 * SHORT is replaced by a step that moves STEP_OVER and so passes over the configuration. */
static const double SHORT = 0.0002;
static const double STEP_OVER = 0.05;
/* A step over a singular configuration is refused if its error, relative to the scales, is larger
 * than this. */
static const double LARGEST_FORCED = 0.01;
/* A step over a singular configuration may have the error ROUNDING / p, relative to the scales,
 * where p is the pivot at the start of the step (see below). This error comes from rounding, and
 * from gains that correct violations. For the mechanism n_four_bar of the catalogue (with windows =
 * 40), the error times p was up to 2e-10. Refusing such a step would not help, because a step that
 * starts closer to the configuration is less accurate. */
static const double ROUNDING = 1e-9;

/* Limits for the pivot p relative to its usual value. If p is below PIVOT_AHEAD, the method
 * searches for a singular configuration ahead. A step that starts with p above PIVOT_AHEAD must not
 * end near a singular configuration with p below PIVOT_POOR, where the error ROUNDING / p is
 * large. */
static const double PIVOT_AHEAD = 0.2;
static const double PIVOT_POOR = 1e-3;
/* [rad] Scaled motion between the two configurations whose pivots find_ahead() extrapolates. */
static const double LOOK = 1e-4;

/* If the pivot at a start is below PIVOT_OF_START, the start may be singular. The usual pivot is
 * then found FURTHER radians ahead. */
static const double PIVOT_OF_START = 1e-4;
static const double FURTHER = 0.5;

/* If HELD successive steps or tries near a singular configuration are shorter than TINY radians,
 * the method is stuck. A method that is not stuck takes only few steps of this length, because
 * each step may be six times as long as the last one. With steps of TINY radians, a motion of one
 * radian would take 1e8 steps. */
enum { HELD = 10 };
static const double TINY = 1e-8;

/* Compute the rate at which the mechanism moves [1/s]. */
static double find_rate(const baum_i_rk *rk, const baum_i_problem *problem)
{
  double rate = baum_i_scaled_size(problem->workspace->mechanism, rk->start + rk->nq);
  return fmax(rate, problem->rate);
}

/* Update the usual pivot, which is the largest so far. Return the pivot of the last evaluation
 * relative to it. */
static double see_pivot(baum_i_rk_crossing *crossing, const baum_i_problem *problem)
{
  double pivot = baum_i_smallest_pivot(problem->workspace, NULL);
  crossing->usual = fmax(crossing->usual, pivot);
  return pivot / crossing->usual;
}

/* Find the widest gap between the times of stages, which are not sorted. */
void baum_i_rk_crossing_open(baum_i_rk_crossing *crossing, const baum_i_rk_table *table)
{
  double width = 0.0;
  for (int i = 0; i < table->stages; i++) {
    double next = 1.0;
    for (int k = 0; k < table->stages; k++) {
      next = table->c[k] > table->c[i] ? fmin(next, table->c[k]) : next;
    }
    if (next - table->c[i] > width) {
      width = next - table->c[i];
      crossing->gap = 0.5 * (next + table->c[i]);
    }
  }
}

/* Find the usual pivot for a start in a singular configuration. The pivot at the start is nearly 0,
 * and no earlier pivot is known, so the pivot of a later configuration is used. This configuration
 * need not be exactly on the path. */
static void look_further(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                         const baum_i_problem *problem, double t)
{
  const double *v = rk->start + rk->nq;
  const double *a = baum_i_rk_rate(rk, 0) + rk->nq;
  double *mean = rk->point + rk->nq;
  double dt = problem->direction * FURTHER / find_rate(rk, problem);
  for (int i = 0; i < rk->nv; i++) {
    mean[i] = v[i] + 0.5 * dt * a[i];
  }
  baum_i_move_from(problem->workspace->mechanism, rk->start, dt, mean, rk->point);
  if (baum_i_problem_motion(problem, t, rk->point, v) == BAUM_OK) {
    (void)see_pivot(crossing, problem);
  }
}

/* Replace the acceleration at a singular start by its limit. */
static void take_limit(const baum_i_rk *rk, const baum_i_problem *problem, double t)
{
  const baum_i_state start = {.t = t, .q = rk->start, .v = rk->start + rk->nq};
  double *limit = baum_i_rk_rate(rk, 1);
  if (baum_i_limit_acceleration(problem, &start, rk->point, limit)) {
    memcpy(baum_i_rk_rate(rk, 0) + rk->nq, limit, (size_t)rk->nv * sizeof *limit);
  }
}

baum_status baum_i_rk_crossing_begin(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                                     const baum_i_problem *problem, double t)
{
  double pivot = baum_i_smallest_pivot(problem->workspace, NULL);
  crossing->usual = pivot; /* forget earlier steps */
  crossing->pivot = 1.0;
  crossing->held = 0;
  if (pivot >= PIVOT_OF_START) {
    return BAUM_OK;
  }
  look_further(crossing, rk, problem, t);
  crossing->pivot = crossing->usual > 0.0 ? pivot / crossing->usual : 0.0;
  if (crossing->pivot < BAUM_I_PIVOT_IN_POSE) {
    take_limit(rk, problem, t);
  }
  /* The workspace contains Phi of another configuration, but the run observes Phi of the start. */
  return baum_i_violation(problem->workspace, t, rk->start, rk->start + rk->nq);
}

/* Find the time until the singular configuration [s]. The square root of the pivot decreases
 * linearly towards this configuration, so the function extrapolates the square root to zero. */
static double find_ahead(const baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                         const baum_i_problem *problem, double t)
{
  if (!(crossing->pivot < PIVOT_AHEAD && crossing->pivot > 0.0)) {
    return (double)INFINITY;
  }
  const double one = 1.0;
  double dt = problem->direction * LOOK / find_rate(rk, problem);
  baum_i_rk_combine(rk, 1, &one, dt, rk->point);
  baum_status status = baum_i_problem_motion(problem, t + dt, rk->point, rk->point + rk->nq);
  double now = sqrt(crossing->pivot);
  double then = sqrt(baum_i_smallest_pivot(problem->workspace, NULL) / crossing->usual);
  return status == BAUM_OK && then < now ? fabs(dt) * now / (now - then) : (double)INFINITY;
}

void baum_i_rk_crossing_look(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                             const baum_i_problem *problem, double t)
{
  crossing->ahead = find_ahead(crossing, rk, problem, t);
  crossing->over = STEP_OVER / find_rate(rk, problem);
  crossing->least = 0.0;
  if (crossing->pivot < BAUM_I_PIVOT_IN_POSE) {
    crossing->least = crossing->over; /* no shorter step may begin here */
  } else if (crossing->pivot < BAUM_I_NEAR_PIVOT) {
    crossing->least = SHORT / find_rate(rk, problem);
  }
}

/* If a step of the wanted length can pass the singular configuration, its length is chosen such
 * that the configuration is in the middle of the widest gap between stages. Otherwise the step ends
 * where a next step of the wanted length can pass the configuration. The step is at least a fifth
 * of the wanted length, so that the next step can grow to the wanted length. */
double baum_i_rk_crossing_length(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                                 const baum_i_problem *problem, double t, double length,
                                 bool *forced)
{
  double over = crossing->ahead / crossing->gap;
  double before = crossing->ahead - crossing->gap * length;
  if (length < crossing->least && baum_i_rows_are_apart(problem->workspace, t, rk->start)) {
    crossing->least = 0.0; /* not singular: a light body rotates fast and needs short steps */
  }
  *forced = length < crossing->least;
  if (*forced) {
    return crossing->over;
  }
  if (length >= over) {
    return fmax(over, crossing->least);
  }
  return fmin(fmax(before, 0.2 * length), length);
}

double baum_i_rk_crossing_error(const baum_i_rk_crossing *crossing, double h, bool forced)
{
  if (forced) {
    return LARGEST_FORCED;
  }
  return fabs(h) > crossing->ahead ? fmin(ROUNDING / crossing->pivot, LARGEST_FORCED) : 0.0;
}

/* A step that began without a search for a singular configuration ahead must not end near a
 * singular configuration. In a short step, or where J keeps its rank, no singular configuration has
 * made the pivot so small. The measure has jumped, as KLU's estimate does if the order of pivots
 * changes. A shorter step would not help then. */
bool baum_i_rk_crossing_may_end(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                                const baum_i_problem *problem, double h, double t_end,
                                const double *end)
{
  crossing->pivot_end = see_pivot(crossing, problem);
  return crossing->pivot < PIVOT_AHEAD || crossing->pivot_end >= PIVOT_POOR ||
         fabs(h) * find_rate(rk, problem) < SHORT ||
         baum_i_rows_are_apart(problem->workspace, t_end, end);
}

void baum_i_rk_crossing_go_on(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                              const baum_i_problem *problem, double next)
{
  bool tiny = next * find_rate(rk, problem) < TINY;
  crossing->held = tiny && crossing->pivot_end < BAUM_I_NEAR_PIVOT ? crossing->held + 1 : 0;
  crossing->pivot = crossing->pivot_end;
}

void baum_i_rk_crossing_refuse(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                               const baum_i_problem *problem, double h)
{
  crossing->held += crossing->pivot < BAUM_I_NEAR_PIVOT && fabs(h) * find_rate(rk, problem) < TINY;
}

bool baum_i_rk_crossing_is_held(const baum_i_rk_crossing *crossing)
{
  return crossing->held >= HELD;
}
