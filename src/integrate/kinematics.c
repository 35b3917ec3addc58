/* SPDX-License-Identifier: BSD-3-Clause */
/* Kinematics of mechanisms without degrees of freedom. Phi(q, t) = 0 determines all coordinates.
 * The method is continuation in time:
 *
 *   guess at t + h:       q moved by h v + h^2 a / 2
 *   solution at t + h:    the configuration, its v and a, found by Newton's method (continuation.c)
 *   guess inside a step:  the polynomial of degree 5 through q, v, a at both ends of the step; its
 *                         values are displacements from the right end
 *
 * Nothing is integrated, and no error accumulates: a requested configuration is accurate to
 * rounding for every step length. Steps only ensure that the motion stays on its branch. A step
 * that may have passed a singular configuration is refused and shortened. If no step is short
 * enough, the run ends. The mechanism is then at a lock-up, which is a fold of the path beyond
 * which no configuration exists, or at a point where branches cross.
 *
 * The length of the next step is chosen from two numbers of the last step. The contraction of
 * Newton's iteration grows with the error of the guess, like h^3. The turning of J (continuation.c)
 * grows like h. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/text.h"
#include "integrate/continuation.h"
#include "integrate/integrator.h"

/* The next step length is chosen such that turning and contraction will have these values, which
 * are below the limits at which a step is refused. */
static const double WANTED_TURNING = 0.4;
static const double WANTED_CONTRACTION = 0.05;
static const double GROWTH = 2.5;
static const double SHRINKAGE = 0.5; /* largest factor on the step length after a refusal */
static const double COLLAPSE = 0.1;  /* smallest factor on the step length */
/* [rad] Largest rotation in a first step, approximately. */
static const double FIRST_TURN = 0.1;
/* The shortest step is SHORTEST times 1/rate of the motion plus TIME_ROUNDINGS times the rounding
 * error of the time. */
static const double SHORTEST = 1e-10;
static const double TIME_ROUNDINGS = 64.0;
/* The longest step, relative to 1/rate, for a mechanism at rest. */
static const double LONGEST = 1e6;
/* A configuration is treated as singular if |J^-1| is above this number. When a run stops at a fold
 * because no shorter step is possible, |J^-1| is about 1e5. */
static const double SINGULAR_GAIN = 1e3;
/* A singular configuration is treated as a fold if the share of drivers (`pull` of continuation.h)
 * is above this number. Where branches cross, the share is only about 1 / |J^-1|. */
static const double FOLD_PULL = 1e-3;

enum { STORED = 4, MOST_PIECES = 10000 /* largest number of steps in walk() */ };

typedef struct kinematics_run {
  baum_i_continuation path;
  double *memory;
  baum_i_configuration stored[STORED];
  baum_i_configuration *left;  /* start of the last step */
  baum_i_configuration *right; /* end of the last step: the last good configuration */
  baum_i_configuration *trial;
  baum_i_configuration *spare;
  bool forgotten; /* the next step restarts */
  double h;       /* [s] > 0, length that the next step tries first */
  baum_i_statistics statistics;
  baum_i_kept_message evaluation; /* message of the last evaluation that failed */
} kinematics_run;

/* ---- configurations ---- */

/* Return how many numbers a configuration consists of. They are contiguous and begin with q. */
static size_t number_count(const baum_mechanism *m)
{
  return (size_t)m->nq + 3 * (size_t)m->nv + (size_t)m->jacobian_size;
}

static void copy_configuration(const baum_mechanism *m, const baum_i_configuration *from,
                               baum_i_configuration *to)
{
  to->t = from->t;
  memcpy(to->q, from->q, number_count(m) * sizeof *to->q);
}

static void swap(baum_i_configuration **a, baum_i_configuration **b)
{
  baum_i_configuration *kept = *a;
  *a = *b;
  *b = kept;
}

/* Write to q the guess at t: `from` moved by h v + h^2 a / 2. work (nv) is scratch memory. */
static void extrapolate(const baum_mechanism *m, const baum_i_configuration *from, double t,
                        double *q, double *work)
{
  double h = t - from->t;
  for (int i = 0; i < m->nv; i++) {
    work[i] = from->v[i] + 0.5 * h * from->a[i];
  }
  baum_i_move_from(m, from->q, h, work, q);
}

/* Evaluate the Hermite polynomial through both ends of the last step. */
static void interpolate_guess(const kinematics_run *run, const baum_mechanism *m, double t,
                              double *q)
{
  double *dx = run->path.image;
  const baum_i_configuration *l = run->left;
  const baum_i_configuration *r = run->right;
  double h = r->t - l->t;
  double s = (t - l->t) / h;
  double u = 1.0 - s;
  double l0 = u * u * u * (1.0 + s * (3.0 + 6.0 * s));
  double l1 = h * u * u * u * s * (1.0 + 3.0 * s);
  double l2 = 0.5 * h * h * u * u * u * s * s;
  double r1 = -h * s * s * s * u * (1.0 + 3.0 * u);
  double r2 = 0.5 * h * h * s * s * s * u * u;
  baum_i_difference(m, r->q, l->q, dx);
  for (int i = 0; i < m->nv; i++) {
    dx[i] = l0 * dx[i] + l1 * l->v[i] + l2 * l->a[i] + r1 * r->v[i] + r2 * r->a[i];
  }
  baum_i_move_from(m, r->q, 1.0, dx, q);
}

/* ---- steps ---- */

/* Find the configuration near the guess in `to`, and count the iterations. */
static bool solve(kinematics_run *run, const baum_i_configuration *from, baum_i_configuration *to,
                  baum_i_verdict *verdict)
{
  bool found = baum_i_continuation_solve(&run->path, from, to, verdict);
  run->statistics.nonlinear_iterations += verdict->iterations;
  if (verdict->refusal == BAUM_I_REFUSAL_EVALUATION) {
    run->evaluation = baum_i_message_keep();
  }
  return found;
}

/* Add the time to the message of a failed callback, because this message does not contain the
 * time. */
static baum_status say_when(const baum_i_configuration *from, baum_status status)
{
  if (status != BAUM_ERR_CALLBACK && status != BAUM_ERR_NOT_FINITE) {
    return status;
  }
  return baum_i_fail(status, "t = %.9g s: kinematics: in the next step: %.800s", from->t,
                     baum_message());
}

/* Return the factor for the next step length after a step with this verdict. */
static double change(const baum_i_verdict *verdict)
{
  bool refused = verdict->refusal != BAUM_I_REFUSAL_NONE;
  double factor = refused ? SHRINKAGE : GROWTH;
  if (verdict->turning > 0.0) {
    factor = fmin(factor, WANTED_TURNING / verdict->turning);
  }
  if (verdict->contraction > 0.0) {
    factor = fmin(factor, cbrt(WANTED_CONTRACTION / verdict->contraction));
  }
  return fmax(factor, COLLAPSE);
}

static double shortest_step(const baum_i_problem *problem, double t)
{
  return fmax(SHORTEST / problem->rate + TIME_ROUNDINGS * DBL_EPSILON * fabs(t), DBL_MIN);
}

static baum_status fail_singular(const baum_mechanism *m, double t, const baum_i_impasse *at)
{
  const baum_i_text resister = baum_i_joint_label(m, at->resister);
  if (at->driver >= 0 && at->pull > FOLD_PULL) {
    return baum_i_fail(BAUM_ERR_SINGULAR,
                       "t = %.9g s: kinematics: the mechanism locks up here: beyond this time no "
                       "configuration satisfies both %s and the other constraints, especially %s",
                       t, baum_i_joint_label(m, at->driver).text, resister.text);
  }
  return baum_i_fail(
    BAUM_ERR_SINGULAR,
    "t = %.9g s: kinematics: the configuration is singular here and the motion may continue in "
    "more than one way, especially in %s; the drivers do not determine which way",
    t, resister.text);
}

/* Fail if the cause of the refusal is a callback, an evaluation or memory. Otherwise return
 * BAUM_OK, and write an analysis of the configuration to *at. */
static baum_status fail_for_cause(kinematics_run *run, const baum_i_configuration *to,
                                  const baum_i_verdict *verdict, const char *when,
                                  baum_i_impasse *at)
{
  if (verdict->refusal == BAUM_I_REFUSAL_STOP) {
    return say_when(to, verdict->status);
  }
  if (verdict->refusal == BAUM_I_REFUSAL_EVALUATION) {
    return baum_i_fail(verdict->status, "t = %.9g s: kinematics: %s: %.800s", to->t, when,
                       run->evaluation.text);
  }
  baum_status status = baum_i_continuation_explain(&run->path, to, at);
  return status == BAUM_ERR_SINGULAR ? BAUM_OK : say_when(to, status);
}

/* Fail because no step was short enough. */
static baum_status fail(kinematics_run *run, const baum_i_problem *problem,
                        const baum_i_verdict *verdict, double h)
{
  const baum_mechanism *m = problem->workspace->mechanism;
  double t = run->right->t;
  baum_i_impasse at;
  const baum_i_text when = baum_i_text_of("in a step of %.3g s", h);
  BAUM_I_TRY(fail_for_cause(run, run->right, verdict, when.text, &at));
  if (!(at.gain < SINGULAR_GAIN)) {
    return fail_singular(m, t, &at);
  }
  if (verdict->refusal == BAUM_I_REFUSAL_OMITTED) {
    return baum_i_fail(BAUM_ERR_CONVERGENCE,
                       "t = %.9g s: kinematics: a row of %s that was omitted as redundant no "
                       "longer follows from the "
                       "others",
                       t, baum_i_row_label(m, verdict->row).text);
  }
  return baum_i_fail(
    BAUM_ERR_CONVERGENCE,
    "t = %.9g s: kinematics: no configuration is found nearby, however small the step "
    "(%.3g s); the law of %s may jump here",
    t, h, baum_i_joint_label(m, at.driver).text);
}

/* Take one step from *from towards t_end and write its end to *to. Refused steps are shortened. On
 * entry, *h is the length to try first. On return, it is the length for the next step. */
static baum_status step(kinematics_run *run, const baum_i_problem *problem,
                        const baum_i_configuration *from, baum_i_configuration *to, double t_end,
                        double *h)
{
  const baum_mechanism *m = problem->workspace->mechanism;
  double shortest = shortest_step(problem, from->t);
  double longest = 1.0;
  for (;;) {
    baum_i_verdict verdict;
    bool last = *h >= fabs(t_end - from->t);
    to->t = last ? t_end : from->t + problem->direction * *h;
    extrapolate(m, from, to->t, to->q, run->path.image);
    bool found = solve(run, from, to, &verdict);
    if (verdict.refusal == BAUM_I_REFUSAL_STOP) {
      return say_when(from, verdict.status);
    }
    double tried = fabs(to->t - from->t);
    double factor = change(&verdict);
    *h = tried * (found ? fmin(factor, longest * GROWTH) : factor);
    if (found) {
      return BAUM_OK;
    }
    run->statistics.rejected++;
    longest = 1.0 / GROWTH;
    if (!(*h >= shortest)) {
      return fail(run, problem, &verdict, tried);
    }
  }
}

/* ---- inside the last step ---- */

/* Compute the configuration at a time t inside the last step, if the guess from the polynomial was
 * refused: take short steps from the start of the last step to t. h has a lower limit, because a
 * step below the rounding of the time would not advance. */
static baum_status walk(kinematics_run *run, const baum_i_problem *problem, double t)
{
  copy_configuration(problem->workspace->mechanism, run->left, run->trial);
  double h = 0.5 * fabs(t - run->left->t);
  for (int k = 0; run->trial->t != t; k++) {
    if (k == MOST_PIECES) {
      return baum_i_fail(BAUM_ERR_STEP,
                         "t = %.9g s: kinematics: %d short steps inside the last step do not reach "
                         "the output at %.9g s",
                         run->trial->t, (int)MOST_PIECES, t);
    }
    h = fmax(h, shortest_step(problem, t));
    BAUM_I_TRY(step(run, problem, run->trial, run->spare, t, &h));
    swap(&run->trial, &run->spare);
  }
  return BAUM_OK;
}

static baum_status solve_inside(kinematics_run *run, const baum_i_problem *problem, double t)
{
  const baum_mechanism *m = problem->workspace->mechanism;
  baum_i_verdict verdict;
  run->trial->t = t;
  interpolate_guess(run, m, t, run->trial->q);
  if (solve(run, run->left, run->trial, &verdict)) {
    return BAUM_OK;
  }
  return verdict.refusal == BAUM_I_REFUSAL_STOP ? say_when(run->left, verdict.status)
                                                : walk(run, problem, t);
}

static baum_status interpolate(void *self, const baum_i_problem *problem, double t, double *q,
                               double *v)
{
  kinematics_run *run = self;
  const baum_mechanism *m = problem->workspace->mechanism;
  if (!((t - run->left->t) * (t - run->right->t) <= 0.0)) {
    return baum_i_fail(BAUM_ERR_INTEGRATOR, "t = %.9g s is not inside the last step of kinematics",
                       t);
  }
  const baum_i_configuration *to = t == run->right->t ? run->right : run->left;
  if (t != to->t) {
    BAUM_I_TRY(solve_inside(run, problem, t));
    to = run->trial;
  }
  memcpy(q, to->q, (size_t)m->nq * sizeof *q);
  memcpy(v, to->v, (size_t)m->nv * sizeof *v);
  return BAUM_OK;
}

/* ---- start ---- */

static baum_status fail_to_start(kinematics_run *run, const baum_i_verdict *verdict)
{
  double t = run->spare->t;
  baum_i_impasse at;
  BAUM_I_TRY(fail_for_cause(run, run->spare, verdict, "at the start", &at));
  if (!(at.gain < SINGULAR_GAIN)) {
    return baum_i_fail(
      BAUM_ERR_SINGULAR,
      "t = %.9g s: kinematics: the start configuration is singular, and the motion may continue "
      "from it in more than one way; start at another time or configuration",
      t);
  }
  return baum_i_fail(
    BAUM_ERR_INCONSISTENT,
    "t = %.9g s: kinematics: no configuration that satisfies the constraints is found near the "
    "given state; let the laws of drivers start at the present coordinates, and assemble the start",
    t);
}

/* Find the configuration that is nearest to a given state and on the same branch. This
 * configuration becomes both the start and the end of the last step. */
static baum_status restart(void *self, const baum_i_problem *problem, const baum_i_state *state)
{
  kinematics_run *run = self;
  const baum_mechanism *m = problem->workspace->mechanism;
  size_t size = (size_t)m->nq * sizeof *state->q;
  baum_i_verdict verdict;
  run->spare->t = state->t;
  run->trial->t = state->t;
  memcpy(run->spare->q, state->q, size);
  memcpy(run->trial->q, state->q, size);
  BAUM_I_TRY(say_when(run->trial, baum_i_continuation_mark(&run->path, run->spare)));
  if (!solve(run, run->spare, run->trial, &verdict)) {
    return fail_to_start(run, &verdict);
  }
  swap(&run->right, &run->trial);
  copy_configuration(m, run->right, run->left);
  run->forgotten = false;
  double rate = baum_i_state_rate(m, run->right->v, run->right->a);
  run->h = FIRST_TURN / fmax(rate, problem->rate);
  return BAUM_OK;
}

/* ---- the next step ---- */

static baum_status advance(void *self, const baum_i_problem *problem, baum_i_state *state)
{
  kinematics_run *run = self;
  const baum_mechanism *m = problem->workspace->mechanism;
  BAUM_I_TRY(run->forgotten ? restart(self, problem, state) : BAUM_OK);
  double h = fmin(fmin(run->h, problem->max_step), LONGEST / problem->rate);
  h = fmax(h, 2.0 * shortest_step(problem, run->right->t));
  double left = problem->stops ? fabs(problem->stop - run->right->t) : (double)INFINITY;
  double end = h < left ? run->right->t + problem->direction * h : problem->stop;
  BAUM_I_TRY(step(run, problem, run->right, run->trial, end, &h));
  run->h = h;
  swap(&run->left, &run->right);
  swap(&run->right, &run->trial);
  state->t = run->right->t;
  memcpy(state->q, run->right->q, (size_t)m->nq * sizeof *state->q);
  memcpy(state->v, run->right->v, (size_t)m->nv * sizeof *state->v);
  return BAUM_OK;
}

static void forget(void *self)
{
  kinematics_run *run = self;
  run->forgotten = true;
}

static void count(const void *self, baum_i_statistics *out)
{
  const kinematics_run *run = self;
  *out = run->statistics;
}

static void close_run(void *self)
{
  kinematics_run *run = self;
  baum_i_continuation_close(&run->path);
  baum_i_free(run->memory);
}

static baum_status make_configurations(kinematics_run *run, const baum_mechanism *m)
{
  size_t nv = (size_t)m->nv;
  size_t size = number_count(m);
  run->memory = baum_i_alloc(STORED * size, sizeof *run->memory);
  BAUM_I_TRY(baum_i_check_memory(run->memory));
  for (size_t k = 0; k < STORED; k++) {
    double *at = run->memory + k * size;
    double *v = at + m->nq;
    run->stored[k] = (baum_i_configuration){
      .q = at, .v = v, .a = v + nv, .turn = v + 2 * nv, .jacobian = v + 3 * nv};
  }
  run->left = &run->stored[0];
  run->right = &run->stored[1];
  run->trial = &run->stored[2];
  run->spare = &run->stored[3];
  return BAUM_OK;
}

static baum_status check_freedom(const baum_workspace *w)
{
  if (w->mechanism->velocity_row_count > 0) {
    return baum_i_fail(BAUM_ERR_UNSUPPORTED,
                       "kinematics: %d constraint %s of velocity level, so the motion does not "
                       "follow from Phi(q, t) = 0 alone; choose an integrator of the equations of "
                       "motion, such as rk8",
                       w->mechanism->velocity_row_count,
                       w->mechanism->velocity_row_count == 1 ? "row is" : "rows are");
  }
  int degrees_of_freedom = w->mechanism->nv - (w->mechanism->nc > 0 ? w->rows.rank : 0);
  if (degrees_of_freedom == 0) {
    return BAUM_OK;
  }
  return baum_i_fail(
    BAUM_ERR_UNSUPPORTED,
    "kinematics: %d %s left, so the motion does not follow from Phi(q, t) = 0 alone; add a driver "
    "for each, or choose an integrator of the equations of motion, such as rk8",
    degrees_of_freedom,
    degrees_of_freedom == 1 ? "degree of freedom is" : "degrees of freedom are");
}

static baum_status open_run(void *self, const void *table, const baum_i_problem *problem,
                            const baum_i_state *start)
{
  (void)table;
  kinematics_run *run = self;
  BAUM_I_TRY(check_freedom(problem->workspace));
  BAUM_I_TRY(baum_i_continuation_open(&run->path, problem->workspace));
  BAUM_I_TRY(make_configurations(run, problem->workspace->mechanism));
  return restart(run, problem, start);
}

/* ---- the integrator ---- */

static const baum_integrator KINEMATICS = {
  .name = "kinematics",
  .gains = BAUM_GAINS_DEFAULT,
  .method = {.kind = BAUM_I_METHOD_WITHOUT_GAINS},
  .without_freedom = true,
  .memory = sizeof(kinematics_run),
  .open = open_run,
  .close = close_run,
  .advance = advance,
  .interpolate = interpolate,
  .restart = restart,
  .forget = forget,
  .statistics = count,
};

const baum_integrator *baum_kinematics(void)
{
  return &KINEMATICS;
}
