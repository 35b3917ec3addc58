/* SPDX-License-Identifier: BSD-3-Clause */
/* The generalized-alpha method (J. Chung, G. Hulbert, J. Appl. Mech. 60 (1993) 371-375) on the
 * equations of index 3 (M. Arnold, O. Bruels, Multibody Syst. Dyn. 18 (2007) 185-202; for q that is
 * not a vector: O. Bruels, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121-137), order 2:
 *
 *   M v'_1 + J^T lambda_1 = g,  Phi(t_1, q_1) = 0                                 at t_1 = t + h
 *   (rows of velocity level: J v_1 = nu at t_1, q_1)
 *   q_1 = q moved by x,  x = h v + h^2 ((1/2 - beta) a + beta a_1)                (nq), x (nv)
 *   v_1 = v + h ((1 - gamma) a + gamma a_1)                                       (nv)
 *   (1 - alpha_m) a_1 + alpha_m a = (1 - alpha_f) v'_1 + alpha_f v'               (nv)
 *
 *   alpha_m = (2 rho - 1) / (rho + 1),  alpha_f = rho / (rho + 1),
 *   gamma = 1/2 + alpha_f - alpha_m,  beta = (gamma + 1/2)^2 / 4
 *
 * rho = 0.8 is the spectral radius for infinitely fast oscillations, such as those of multipliers.
 * A disturbance of the multipliers therefore decays to a tenth in ten steps. Slow oscillations,
 * whose period is many steps, are hardly damped.
 *
 * The variable a is not the acceleration at t. To second order, it is the acceleration at t +
 * (alpha_m - alpha_f) h, which is a ninth of a step before t. A run therefore starts with the
 * acceleration at that earlier time. Otherwise the multipliers of the first steps would have errors
 * of first order. If the length of the step changes, the difference a - v' is multiplied by the
 * ratio of the lengths.
 *
 * The first step after every start begins at the state projected onto the constraints. Otherwise a
 * violation would cause velocities of its size divided by h, which later steps would reduce only
 * slowly.
 *
 * Newton's method uses the exact matrix of step_matrix.h, with dv = gamma / (beta h) dx and scaled
 * multipliers. It keeps this matrix while the changes are small. (If q is not a vector, the matrix
 * has errors of the size of h times the angular velocity, because x is added at q, not at q_1.) */
#include "integrate/generalized_alpha.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "dynamics/step_matrix.h"

/* The parameters for rho = 0.8. */
static const double ALPHA_M = 1.0 / 3.0;
static const double ALPHA_F = 4.0 / 9.0;
static const double GAMMA = 11.0 / 18.0;
static const double BETA = 25.0 / 81.0;

enum { ITERATIONS = 20 };

/* Newton's iteration ends when the change of the positions is below the fraction CONVERGED of the
 * displacement that accelerations cause in a step. Multipliers and accelerations are then accurate
 * to that fraction. The iteration also ends when the change is below ROUNDINGS times the largest
 * position or the scale, whichever is larger. */
static const double CONVERGED = 1e-9;
static const double ROUNDINGS = 8.0 * DBL_EPSILON;
/* The next iterations use the same matrix as long as their changes of the positions, relative to
 * the scales, are at most NEAR, and each change is below FAST times the change before it. With a
 * matrix of a distant configuration, changes may become small although the error in a soft
 * direction is still large. */
static const double NEAR = 1e-6;
static const double FAST = 0.1;
/* Changes that have stopped decreasing are treated as rounding errors if they are at most STALLED
 * times the limit that ROUNDINGS gives. */
static const double STALLED = 64.0;
/* Even larger changes that have stopped decreasing may be rounding errors, because the rounding
 * error of a large coordinate may be large relative to the scale of a small coordinate that is
 * coupled to it. To decide, find_noise() changes all unknowns by the fraction NUDGE and measures
 * the effect. Changes of at most NOISES times this effect, and at most LARGEST_NOISE, are treated
 * as rounding errors. */
static const double LARGEST_NOISE = 1e-7;
static const double NOISES = 16.0;
static const double NUDGE = 4.0 * DBL_EPSILON;

/* The derivative of the acceleration is computed as a difference over this fraction of a step. Its
 * relative truncation error is about this fraction. Its relative rounding error is the unit
 * roundoff divided by this fraction. */
static const double SHIFT = 1e-3;

/* The variable a of the method is not scaled if successive step lengths differ by less than this
 * fraction. */
static const double SAME_STEP = 1e-6;

/* Results of a step that the next step needs. */
typedef struct alpha_past {
  double *rate;   /* (nv) v' */
  double *a;      /* (nv) */
  double *lambda; /* (nc) */
} alpha_past;

/* Memory of a run. */
typedef struct alpha_run {
  int nq;
  int nv;
  int nc;
  bool known;      /* `now` belongs to the present state */
  bool first;      /* no step has been accepted since the start */
  double step;     /* [s] step length to which now.a belongs */
  double trial;    /* [s] step length to which next.a belongs */
  alpha_past now;  /* results at the present state */
  alpha_past next; /* results at the end of the last trial */
  int64_t iterations;
  baum_i_step_matrix *matrix;
  double *memory;   /* memory of all arrays of this struct */
  double *moved;    /* (nv) displacement from q of the state to q of y */
  double *y;        /* (nq + nv + nc) q, v, lambda */
  double *dy;       /* (nq + nv + nc) zeros, then v', then an unused part */
  double *residual; /* (nq + nv + nc) */
  double *x;        /* (nv + nc) */
  double *nudged;   /* (2 (nq + nv + nc)) y and dy with changed last digits */
} alpha_run;

/* ---- begin ---- */

/* Find v' and lambda by equation (5) of docs/notation.md, and a by a difference along the motion. a
 * is computed for the step length of the grid, even if the first step has another length. */
static baum_status begin(alpha_run *run, const baum_i_problem *problem, const baum_i_state *state)
{
  double h = problem->direction * problem->step;
  baum_workspace *w = problem->workspace;
  size_t nv = (size_t)run->nv;
  BAUM_I_TRY(baum_i_problem_acceleration(problem, state->t, state->q, state->v));
  memcpy(run->now.rate, w->a, nv * sizeof *w->a);
  memcpy(run->now.lambda, w->lambda, (size_t)run->nc * sizeof *w->lambda);
  double shift = SHIFT * h;
  double *q = run->y;
  double *v = run->y + run->nq;
  for (size_t i = 0; i < nv; i++) {
    run->moved[i] = state->v[i] + 0.5 * shift * run->now.rate[i];
    v[i] = state->v[i] + shift * run->now.rate[i];
  }
  baum_i_move_from(w->mechanism, state->q, shift, run->moved, q);
  BAUM_I_TRY(baum_i_problem_acceleration(problem, state->t + shift, q, v));
  for (size_t i = 0; i < nv; i++) {
    run->now.a[i] = run->now.rate[i] + (ALPHA_M - ALPHA_F) * (w->a[i] - run->now.rate[i]) / SHIFT;
  }
  run->step = h;
  run->known = true;
  run->first = true;
  return BAUM_OK;
}

/* ---- one step ---- */

/* Return a_1 from (1 - alpha_m) a_1 = (1 - alpha_f) v'_1 + alpha_f v' - alpha_m a. */
static double next_a(double rate_next, double rate, double a)
{
  return ((1.0 - ALPHA_F) * rate_next + ALPHA_F * rate - ALPHA_M * a) / (1.0 - ALPHA_M);
}

/* Return a of the present state, scaled for a step of length h. */
static double present_a(const alpha_run *run, int i, double h)
{
  double ratio = h / run->step;
  double a = run->now.a[i];
  bool same = fabs(ratio - 1.0) <= SAME_STEP;
  return same ? a : run->now.rate[i] + ratio * (a - run->now.rate[i]);
}

static void move_end(alpha_run *run, const baum_mechanism *m, const baum_i_state *state)
{
  baum_i_move_from(m, state->q, 1.0, run->moved, run->y);
}

/* Predict the end of the step, assuming that v' and lambda do not change. */
static void predict(alpha_run *run, const baum_mechanism *m, const baum_i_state *state, double h)
{
  double *v = run->y + run->nq;
  for (int i = 0; i < run->nv; i++) {
    double rate = run->now.rate[i];
    double a = present_a(run, i, h);
    double a_next = next_a(rate, rate, a);
    run->moved[i] = h * (state->v[i] + h * ((0.5 - BETA) * a + BETA * a_next));
    v[i] = state->v[i] + h * ((1.0 - GAMMA) * a + GAMMA * a_next);
    run->dy[run->nq + i] = rate;
  }
  move_end(run, m, state);
  memcpy(v + run->nv, run->now.lambda, (size_t)run->nc * sizeof *run->y);
}

/* Apply a change x of all unknowns. */
static void apply(alpha_run *run, const baum_mechanism *m, const baum_i_state *state,
                  const baum_i_step_ratios *ratios)
{
  double *v = run->y + run->nq;
  for (int i = 0; i < run->nv; i++) {
    run->moved[i] += run->x[i];
    v[i] += ratios->by_v * run->x[i];
    run->dy[run->nq + i] += ratios->by_a * run->x[i];
  }
  move_end(run, m, state);
  for (int i = 0; i < run->nc; i++) {
    v[run->nv + i] += run->x[run->nv + i] / ratios->scale;
  }
}

static baum_status factor(alpha_run *run, baum_workspace *w, const baum_i_step_ratios *ratios,
                          double t)
{
  baum_status status = baum_i_step_matrix_factor(run->matrix, w, ratios, t, run->y, run->dy);
  return status == BAUM_ERR_SINGULAR
           ? baum_i_fail(status,
                         "t = %.9g s: generalized_alpha: the matrix of the step is singular", t)
           : status;
}

/* Take one Newton iteration and find the size of its change of the positions. If `renew` is false,
 * use the matrix of an earlier iteration of the same step. */
static baum_status improve(alpha_run *run, const baum_i_problem *problem, const baum_i_state *state,
                           double t, const baum_i_step_ratios *ratios, bool renew, double *size)
{
  static const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX3};
  baum_workspace *w = problem->workspace;
  BAUM_I_TRY(baum_i_residual(w, &dae, t, run->y, run->dy, run->residual));
  const double *rest = run->residual + run->nq;
  for (int i = 0; i < run->nv + run->nc; i++) {
    run->x[i] = -(i < run->nv ? ratios->scale : 1.0) * rest[i];
  }
  BAUM_I_TRY(renew ? factor(run, w, ratios, t) : BAUM_OK);
  baum_i_step_matrix_solve(run->matrix, run->x);
  apply(run, w->mechanism, state, ratios);
  run->iterations++;
  *size = baum_i_scaled_size(w->mechanism, run->x);
  return BAUM_OK;
}

/* Estimate the change of the positions that rounding causes: change all unknowns in their last
 * digits and solve with the resulting change of the residual. Each row is rounded independently, so
 * absolute values of the rows are used. */
static baum_status find_noise(alpha_run *run, const baum_i_problem *problem, double t,
                              const baum_i_step_ratios *ratios, double *noise)
{
  static const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX3};
  baum_workspace *w = problem->workspace;
  int whole = run->nq + run->nv + run->nc;
  const double *rest = run->residual + run->nq;
  double *y = run->nudged;
  double *dy = y + whole;
  for (int i = 0; i < whole; i++) {
    y[i] = run->y[i] * (1.0 + NUDGE);
    dy[i] = run->dy[i] * (1.0 + NUDGE);
  }
  memcpy(y + run->nq, run->y + run->nq,
         (size_t)run->nv * sizeof *y); /* v follows from the other unknowns */
  BAUM_I_TRY(baum_i_residual(w, &dae, t, run->y, run->dy, run->residual));
  memcpy(run->x, rest, (size_t)(run->nv + run->nc) * sizeof *rest);
  BAUM_I_TRY(baum_i_residual(w, &dae, t, y, dy, run->residual));
  for (int i = 0; i < run->nv + run->nc; i++) {
    run->x[i] = (i < run->nv ? ratios->scale : 1.0) * fabs(rest[i] - run->x[i]);
  }
  baum_i_step_matrix_solve(run->matrix, run->x);
  *noise = baum_i_scaled_size(w->mechanism, run->x);
  return BAUM_OK;
}

/* Tell whether the iteration diverges: a change is not finite, or is much larger than the change
 * before it. Growth is permitted for the second change, and for changes that were computed with the
 * matrix of an earlier iteration. */
static bool diverges(int k, bool renewed, double size, double before)
{
  return !isfinite(size) || (k > 1 && renewed && size > 2.0 * before);
}

static baum_status iterate(alpha_run *run, const baum_i_problem *problem, const baum_i_state *state,
                           double h)
{
  const baum_i_step_ratios ratios = {
    .by_v = GAMMA / (BETA * h),
    .by_a = (1.0 - ALPHA_M) / ((1.0 - ALPHA_F) * BETA * h * h),
    .scale = BETA * h * h,
  };
  const baum_mechanism *m = problem->workspace->mechanism;
  double acceleration = fmax(problem->rate * problem->rate, baum_i_scaled_size(m, run->now.rate));
  double rounding = ROUNDINGS * fmax(1.0, baum_i_position_size(m, state->q));
  double enough = fmax(CONVERGED * BETA * h * h * acceleration, rounding);
  double before = INFINITY;
  double size = INFINITY;
  for (int k = 0; k < ITERATIONS; k++) {
    bool renew = !(size <= NEAR && size < FAST * before);
    before = size;
    BAUM_I_TRY(improve(run, problem, state, state->t + h, &ratios, renew, &size));
    bool stalls = size > 0.5 * before;
    bool done = size <= enough || (stalls && size <= STALLED * rounding);
    if (!done && k > 1 && stalls && size <= LARGEST_NOISE) {
      double noise = 0.0;
      BAUM_I_TRY(find_noise(run, problem, state->t + h, &ratios, &noise));
      done = size <= NOISES * noise;
    }
    if (done) {
      return BAUM_OK;
    }
    if (diverges(k, renew, size, before)) {
      break;
    }
  }
  return baum_i_fail_iteration("generalized_alpha", "the equations", state->t, size);
}

static baum_status take_step(void *self, const baum_i_problem *problem, baum_i_state *state,
                             double h, const double *a)
{
  (void)a;
  alpha_run *run = self;
  int nv = run->nv;
  /* All trials from one state must start at the same point, so every first step projects, even if
   * it is discarded. */
  if (!run->known || run->first) {
    BAUM_I_TRY(baum_i_project(problem->workspace, state->t, state->q, state->v));
  }
  BAUM_I_TRY(run->known ? BAUM_OK : begin(run, problem, state));
  predict(run, problem->workspace->mechanism, state, h);
  BAUM_I_TRY(iterate(run, problem, state, h));
  run->trial = h;
  const double *v = run->y + run->nq;
  for (int i = 0; i < nv; i++) {
    run->next.rate[i] = run->dy[run->nq + i];
    run->next.a[i] = next_a(run->next.rate[i], run->now.rate[i], present_a(run, i, h));
  }
  memcpy(state->q, run->y, (size_t)run->nq * sizeof *v);
  memcpy(state->v, v, (size_t)nv * sizeof *v);
  memcpy(run->next.lambda, v + nv, (size_t)run->nc * sizeof *v);
  return BAUM_OK;
}

/* Accept the last trial. If the length of this step differs from the step of the grid, the results
 * of past steps are discarded, as in all other methods with a history. */
static void accept(void *self, const baum_i_problem *problem, const baum_i_state *state)
{
  alpha_run *run = self;
  alpha_past kept = run->now;
  run->now = run->next;
  run->next = kept;
  run->step = run->trial;
  run->first = false;
  run->known = baum_i_problem_is_grid_step(problem, state->t, run->trial);
}

static baum_status restart(void *self, const baum_i_problem *problem, const baum_i_state *state)
{
  (void)problem;
  (void)state;
  alpha_run *run = self;
  run->known = false;
  return BAUM_OK;
}

static void forget(void *self)
{
  alpha_run *run = self;
  run->known = false;
  baum_i_step_matrix_forget(run->matrix);
}

/* ---- life ---- */

static void close_run(void *self)
{
  alpha_run *run = self;
  baum_i_step_matrix_destroy(run->matrix);
  baum_i_free(run->memory);
}

static double *take(double **next, int count)
{
  double *taken = *next;
  *next += count;
  return taken;
}

static baum_status make_memory(alpha_run *run)
{
  int nv = run->nv;
  int nc = run->nc;
  int whole = run->nq + nv + nc;
  size_t count = 5 * (size_t)whole + 6 * (size_t)nv + 3 * (size_t)nc;
  run->memory = baum_i_alloc(count, sizeof *run->memory);
  BAUM_I_TRY(baum_i_check_memory(run->memory));
  double *next = run->memory;
  alpha_past *pasts[2] = {&run->now, &run->next};
  for (int k = 0; k < 2; k++) {
    pasts[k]->rate = take(&next, nv);
    pasts[k]->a = take(&next, nv);
    pasts[k]->lambda = take(&next, nc);
  }
  run->moved = take(&next, nv);
  run->y = take(&next, whole);
  run->dy = take(&next, whole);
  run->residual = take(&next, whole);
  run->x = take(&next, nv + nc);
  run->nudged = take(&next, 2 * whole);
  return BAUM_OK;
}

static baum_status open_run(void *self, const void *table, const baum_i_problem *problem,
                            const baum_i_state *start)
{
  (void)table;
  (void)start;
  alpha_run *run = self;
  run->nq = problem->workspace->mechanism->nq;
  run->nv = problem->workspace->mechanism->nv;
  run->nc = problem->workspace->mechanism->nc;
  BAUM_I_TRY(make_memory(run));
  return baum_i_step_matrix_create(problem->workspace, &run->matrix);
}

static void count(const void *self, baum_i_statistics *out)
{
  const alpha_run *run = self;
  baum_i_sparse_lu_work work = baum_i_step_matrix_work(run->matrix);
  *out = (baum_i_statistics){.factorizations = work.factorizations,
                             .full_factorizations = work.full_factorizations,
                             .nonlinear_iterations = run->iterations};
}

const double *baum_i_generalized_alpha_multipliers(const void *run)
{
  const alpha_run *self = run;
  return self->now.lambda;
}

static const baum_integrator GENERALIZED_ALPHA = {
  .name = "generalized_alpha",
  .order = 2,
  .formulations = {BAUM_FORMULATION_INDEX3},
  .gains = BAUM_GAINS_DEFAULT,
  .method = {.kind = BAUM_I_METHOD_WITHOUT_GAINS},
  .solves_residuals = true,
  .memory = sizeof(alpha_run),
  .open = open_run,
  .close = close_run,
  .step = take_step,
  .accept = accept,
  .restart = restart,
  .forget = forget,
  .statistics = count,
};

const baum_integrator *baum_generalized_alpha(void)
{
  return &GENERALIZED_ALPHA;
}
