/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the energy account of a run.
 *
 * The kinetic energy is T = v^T M v / 2. The change of T follows from M v' + J^T lambda = g and J v
 * = nu + Phi':
 *
 *   T' = g^T v + v^T M' v / 2 - nu^T lambda - Phi'^T lambda
 *
 * Forces with a potential V do not change T + V, so they do not count as work. The powers of all
 * other forces are integrated over each step by a Gauss rule. At the nodes of this rule, which are
 * inside the step, lambda is computed from the equations that the run integrates, (5) or (7) of
 * docs/notation.md. Equation (5) is also used for the formulations of index 2 and 3. Motions that
 * are integrated by these formulations satisfy J v = nu or Phi = 0. They therefore also satisfy the
 * second line of (5), J a = gamma, which follows from these equations by differentiation. The gains
 * of the stabilization change the multipliers by lambda_s. With the matrix S = J M^-1 J^T of (5),
 * the power of this change is
 *
 *   -(J v)^T lambda_s,   lambda_s = S^-1 (2 alpha Phi' + beta^2 Phi) = lambda of (7) - lambda of
 *   (5).
 *
 * This power is contained in the work of the drivers and in the work of the violation
 * (docs/theory/energy.md).
 *
 * States inside a step are mostly computed by the interpolant of the method. For fixed steps of
 * methods up to order 4, the interpolant consists of Hermite polynomials of degree 5 in q and 3 in
 * v. The error of these polynomials over a step is of order 5. For fixed steps of methods above
 * order 4, each state is the end of a shorter step from the same start. States inside a variable
 * step are also found by shorter steps if the projection after the step is large, for example after
 * a start off the constraints. The reason is that the interpolant of a Runge-Kutta pair ends at the
 * projected state and not at the state before the projection.
 *
 * IDA first moves the given initial state onto the constraints of its formulation. The account
 * treats this move as a projection.
 *
 * The account has its own workspace. Its evaluations therefore do not change the solver or the
 * counters of the run. */
#include "simulate/account.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "simulate/saved.h"

enum { MOST_NODES = 4, HERMITE_ORDER = 4 };

/* If a projection moves the state by more than this many tolerances, the projection does more than
 * correct an error of the method. For example, it may remove an initial violation. */
static const double FAR = 10.0;

struct baum_i_account {
  /* The members before `workspace` are plain numbers. They are part of a saved run. */
  /* Works from the start of the account to the start of the last step. */
  double before[BAUM_I_WORKS];
  double last[BAUM_I_WORKS]; /* works of the last step */
  double read[BAUM_I_WORKS]; /* works from the start of the account to the state requested last */
  int32_t broken;            /* not 0 if a work could not be evaluated */

  baum_workspace *workspace;
  baum_i_problem problem; /* the problem of the run, but with the workspace of the account */
  int nodes;
  bool fresh; /* true if the method has taken no step since its last restart */
  bool far;   /* true if the last projection moved the state far (see FAR) */
  /* Second instance of the method for shorter steps, or NULL if it is not needed. */
  void *stepper;
  baum_i_state from; /* state at the start of the last step */
  baum_i_state node;
  /* (nq + nv) state before projection, at the end of the last step or at a sample. */
  double *unprojected;
  /* (nv) acceleration at the end of a step, or at its start if `far` is true. */
  double *end_a;
  double *lambda; /* (nc) multipliers by equation (5) */
};

/* Nodes of Gauss' rules over (-1, 1). Row n - 1 is the rule with n nodes. */
static const double PLACE[MOST_NODES][MOST_NODES] = {
  {0.0},
  {-0.5773502691896257, 0.5773502691896257},
  {-0.7745966692414834, 0.0, 0.7745966692414834},
  {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526},
};
static const double WEIGHT[MOST_NODES][MOST_NODES] = {
  {2.0},
  {1.0, 1.0},
  {0.5555555555555556, 0.8888888888888888, 0.5555555555555556},
  {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538},
};

/* A part of the motion between the state account->from and the state (q, v) at time t. */
typedef struct stretch {
  double t;
  const double *q;
  const double *v;
  const double *from_a; /* (nv) accelerations at the start and at the end of the stretch */
  const double *to_a;
  void *stepper; /* instance of the method that takes shorter steps, or NULL */
} stretch;

/* ---- powers ---- */

static double product(int n, const double *x, const double *y)
{
  double sum = 0.0;
  for (int i = 0; i < n; i++) {
    sum += x[i] * y[i];
  }
  return sum;
}

/* Compute two sets of multipliers: those of the integrated equations, in the workspace, and those
 * of equation (5), in account->lambda. */
static baum_status solve(baum_i_account *account, const baum_i_state *at)
{
  baum_workspace *w = account->workspace;
  BAUM_I_TRY(baum_i_acceleration(w, at->t, at->q, at->v, 0.0, 0.0));
  memcpy(account->lambda, w->lambda, (size_t)w->mechanism->nc * sizeof *w->lambda);
  return account->problem.formulation == BAUM_FORMULATION_BAUMGARTE
           ? baum_i_problem_acceleration(&account->problem, at->t, at->q, at->v)
           : BAUM_OK;
}

static baum_status power_at(baum_i_account *account, const baum_i_state *at,
                            double power[BAUM_I_WORKS])
{
  baum_workspace *w = account->workspace;
  int nc = w->mechanism->nc;
  BAUM_I_TRY(solve(account, at));
  BAUM_I_TRY(baum_i_mechanism_power(&w->point, power));
  power[BAUM_I_WORK_DRIVERS] = -product(nc, w->nu, w->lambda);
  power[BAUM_I_WORK_VIOLATION] = -product(nc, w->phi_rate, w->lambda);
  power[BAUM_I_WORK_PROJECTION] = 0.0;
  power[BAUM_I_WORK_GAINS] = product(nc, w->nu, account->lambda) +
                             product(nc, w->phi_rate, account->lambda) +
                             power[BAUM_I_WORK_DRIVERS] + power[BAUM_I_WORK_VIOLATION];
  return BAUM_OK;
}

/* ---- states inside a step ---- */

/* Set account->node to the state at the fraction x of the stretch. The polynomials, of degree 5 in
 * q and 3 in v, have the given values and rates at both ends of the stretch. */
static void find_by_hermite(baum_i_account *account, const stretch *s, double x)
{
  const baum_mechanism *m = account->workspace->mechanism;
  ptrdiff_t nq = m->nq;
  double *room = account->workspace->work_q;
  const baum_i_state *from = &account->from;
  const baum_i_state *node = &account->node;
  double h = s->t - from->t;
  double y = 1.0 - x;
  double x3 = x * x * x;
  double y3 = y * y * y;
  const double q0 = y3 * (1.0 + 3.0 * x + 6.0 * x * x);
  const double q1 = x3 * (1.0 + 3.0 * y + 6.0 * y * y);
  const double v0 = h * y3 * x * (1.0 + 3.0 * x);
  const double v1 = -h * x3 * y * (1.0 + 3.0 * y);
  const double a0 = 0.5 * h * h * y3 * x * x;
  const double a1 = 0.5 * h * h * x3 * y * y;
  const double *from_rate = baum_i_rates(m, from->q, from->v, room);
  const double *rate = baum_i_rates(m, s->q, s->v, room + nq);
  const double *from_bend = baum_i_second_rates(m, from->q, from->v, s->from_a, room + 2 * nq);
  const double *bend = baum_i_second_rates(m, s->q, s->v, s->to_a, room + 3 * nq);
  for (int i = 0; i < m->nq; i++) {
    node->q[i] = q0 * from->q[i] + q1 * s->q[i] + v0 * from_rate[i] + v1 * rate[i] +
                 a0 * from_bend[i] + a1 * bend[i];
  }
  baum_i_normalize(m, node->q);
  for (int i = 0; i < m->nv; i++) {
    node->v[i] = y * y * (1.0 + 2.0 * x) * from->v[i] + x * x * (1.0 + 2.0 * y) * s->v[i] +
                 h * x * y * (y * s->from_a[i] - x * s->to_a[i]);
  }
}

/* Find the state at the fraction x of a stretch and write it to account->node. */
static baum_status find_node(baum_simulation *run, const stretch *s, double x)
{
  baum_i_account *account = run->account;
  baum_i_state *node = &account->node;
  const baum_integrator *method = run->integrator;
  double h = x * (s->t - account->from.t);
  if (s->to_a) {
    find_by_hermite(account, s, x);
    node->t = account->from.t + h;
    return BAUM_OK;
  }
  if (s->stepper) {
    baum_i_run_copy(run, &account->from, node);
    baum_status status = method->step(s->stepper, &account->problem, node, h, s->from_a);
    node->t = account->from.t + h;
    return status;
  }
  node->t = account->from.t + h;
  return method->interpolate(run->self, &account->problem, node->t, node->q, node->v);
}

/* ---- works ---- */

/* For some elements, the computed power contains all of their forces, even the forces that have a
 * potential. The work of the forces that have a potential must not count. Adding the change of the
 * potential to the integral of the power removes this work. Add `factor` times the potentials of
 * these elements to `works`. */
static baum_status add_potentials(baum_i_account *account, double factor, double t, const double *q,
                                  const double *v, double works[BAUM_I_WORKS])
{
  double potential[BAUM_I_POWERS];
  baum_i_point_set(&account->workspace->point, t, q, v);
  BAUM_I_TRY(baum_i_mechanism_potential_of_whole(&account->workspace->point, potential));
  for (int k = 0; k < BAUM_I_POWERS; k++) {
    works[k] += factor * potential[k];
  }
  return BAUM_OK;
}

static baum_status integrate_powers(baum_simulation *run, const stretch *s,
                                    double works[BAUM_I_WORKS])
{
  baum_i_account *account = run->account;
  const baum_i_state *from = &account->from;
  const double *place = PLACE[account->nodes - 1];
  const double *weight = WEIGHT[account->nodes - 1];
  double half = 0.5 * (s->t - from->t);
  for (int k = 0; k < account->nodes; k++) {
    double power[BAUM_I_WORKS] = {0.0};
    BAUM_I_TRY(find_node(run, s, 0.5 + 0.5 * place[k]));
    BAUM_I_TRY(power_at(account, &account->node, power));
    for (int i = 0; i < BAUM_I_WORKS; i++) {
      works[i] += half * weight[k] * power[i];
    }
  }
  BAUM_I_TRY(add_potentials(account, -1.0, from->t, from->q, from->v, works));
  return add_potentials(account, 1.0, s->t, s->q, s->v, works);
}

/* A projection has moved the state from `from` to (q, v). Add the change of energy to the work of
 * the projection. */
static baum_status add_projection(baum_i_account *account, double t, const double *from,
                                  const double *q, const double *v, double works[BAUM_I_WORKS])
{
  baum_workspace *w = account->workspace;
  double before[2] = {0.0};
  double after[2] = {0.0};
  BAUM_I_TRY(baum_i_energy(w, t, from, from + w->mechanism->nq, &before[0], &before[1]));
  BAUM_I_TRY(baum_i_energy(w, t, q, v, &after[0], &after[1]));
  works[BAUM_I_WORK_PROJECTION] += after[0] - before[0] + (after[1] - before[1]);
  return BAUM_OK;
}

/* IDA may have moved the given initial state before its first step. Move account->from to the state
 * at which IDA started, and count the change of energy as work of the projection. */
static baum_status move_start(baum_simulation *run, double works[BAUM_I_WORKS])
{
  baum_i_account *account = run->account;
  const baum_i_state *from = &account->from;
  const baum_i_state *node = &account->node;
  BAUM_I_TRY(run->integrator->interpolate(run->self, &account->problem, from->t, node->q, node->v));
  /* The arrays q and v of a state follow each other in memory, so from->q contains both. */
  BAUM_I_TRY(add_projection(account, from->t, from->q, node->q, node->v, works));
  account->node.t = from->t;
  baum_i_run_copy(run, node, &account->from);
  return BAUM_OK;
}

/* Tell whether the projection has moved a state by more than FAR tolerances. */
static bool moved_far(const baum_simulation *run, const baum_i_state *state)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double tolerance = FAR * run->problem.rtol;
  const double *q = run->account->unprojected;
  const double *v = q + m->nq;
  double *moved = run->account->workspace->work_v;
  baum_i_difference(m, q, state->q, moved);
  bool far = baum_i_scaled_size(m, moved) > tolerance;
  for (int i = 0; i < m->nv; i++) {
    far = far || fabs(state->v[i] - v[i]) > tolerance * m->scale[i] * run->problem.rate;
  }
  return far;
}

/* Choose how states inside the stretch are found. */
static baum_status choose_nodes(baum_simulation *run, stretch *s)
{
  baum_i_account *account = run->account;
  baum_workspace *w = account->workspace;
  size_t bytes = (size_t)w->mechanism->nv * sizeof *w->a;
  bool fixed = baum_i_run_has_fixed_step(run);
  baum_status status = BAUM_OK;
  if (fixed && run->integrator->order <= HERMITE_ORDER) {
    status = baum_i_problem_acceleration(&account->problem, s->t, s->q, s->v);
    memcpy(account->end_a, w->a, bytes);
    s->to_a = account->end_a;
  } else if (fixed) {
    s->stepper = run->self;
  } else if (account->far) {
    const baum_i_state *from = &account->from;
    status = baum_i_problem_acceleration(&account->problem, from->t, from->q, from->v);
    memcpy(account->end_a, w->a, bytes);
    s->from_a = account->end_a;
    s->stepper = account->stepper;
  }
  return status;
}

/* Add to `works` the works of the motion from account->from to `state`. If the formulation includes
 * projection, also add the work of the projection. */
static baum_status work_to(baum_simulation *run, const baum_i_state *state,
                           double works[BAUM_I_WORKS])
{
  baum_i_account *account = run->account;
  const double *raw = account->unprojected;
  bool projected = run->problem.formulation == BAUM_FORMULATION_PROJECTION;
  stretch s = {.t = state->t, .q = state->q, .v = state->v, .from_a = run->acceleration};
  if (projected) {
    s.q = raw;
    s.v = raw + run->workspace->mechanism->nq;
  }
  BAUM_I_TRY(choose_nodes(run, &s));
  BAUM_I_TRY(integrate_powers(run, &s, works));
  return projected ? add_projection(account, state->t, raw, state->q, state->v, works) : BAUM_OK;
}

static void try_work(baum_simulation *run, const baum_i_state *state, double works[BAUM_I_WORKS])
{
  baum_i_account *account = run->account;
  if (account->broken) {
    return;
  }
  baum_i_run_share_equations(run, &run->account->problem);
  /* Only IDA with variable steps may start from another state than the given one. */
  bool moves =
    account->fresh && run->integrator->solves_residuals && !baum_i_run_has_fixed_step(run);
  baum_status status = moves ? move_start(run, account->before) : BAUM_OK;
  if (status == BAUM_OK) {
    status = work_to(run, state, works);
  }
  if (status != BAUM_OK) {
    account->broken = true;
    baum_i_run_warn(run, BAUM_WARNING_ENERGY_ACCOUNT, account->from.t, BAUM_I_NO_JOINT,
                    "t = %.9g s: the energy account ends here: %.200s", account->from.t,
                    baum_message());
  }
}

/* ---- during a run ---- */

static void add_works(const double *what, double *to)
{
  for (int i = 0; i < BAUM_I_WORKS; i++) {
    to[i] += what[i];
  }
}

void baum_i_account_begin(baum_simulation *run)
{
  baum_i_account *account = run->account;
  account->broken = false;
  memset(account->read, 0, sizeof account->read);
  baum_i_account_go_on(run);
}

void baum_i_account_go_on(baum_simulation *run)
{
  baum_i_account *account = run->account;
  memcpy(account->before, account->read, sizeof account->before);
  memset(account->last, 0, sizeof account->last);
  baum_i_run_copy(run, &run->state, &account->from);
  account->fresh = true;
}

void baum_i_account_step(baum_simulation *run)
{
  baum_i_account *account = run->account;
  bool fixed = baum_i_run_has_fixed_step(run);
  if (!fixed) {
    baum_i_account_accept(run);
  }
  memset(account->last, 0, sizeof account->last);
  baum_i_run_copy(run, fixed ? &run->state : &run->ahead, &account->from);
  account->far = account->stepper && moved_far(run, &run->trial);
  try_work(run, &run->trial, account->last);
  account->fresh = false;
}

void baum_i_account_accept(baum_simulation *run)
{
  add_works(run->account->last, run->account->before);
  memset(run->account->last, 0, sizeof run->account->last);
}

/* Find the state at a time t inside the last step as it is before projection, and write it to
 * account->unprojected. */
static baum_status find_unprojected(baum_simulation *run, double t)
{
  baum_i_account *account = run->account;
  const baum_mechanism *m = run->workspace->mechanism;
  stretch s = {.t = t};
  baum_i_run_share_equations(run, &run->account->problem);
  BAUM_I_TRY(choose_nodes(run, &s));
  BAUM_I_TRY(find_node(run, &s, 1.0));
  memcpy(account->unprojected, account->node.q, (size_t)m->nq * sizeof(double));
  memcpy(account->unprojected + m->nq, account->node.v, (size_t)m->nv * sizeof(double));
  return BAUM_OK;
}

/* With fixed steps, a sample is the end of a trial step. This trial step is not part of the motion.
 * With variable steps, a sample may be inside the last step. Powers are then integrated from the
 * start of the step up to the sample. */
void baum_i_account_read(baum_simulation *run, const baum_i_state *state)
{
  baum_i_account *account = run->account;
  bool fixed = baum_i_run_has_fixed_step(run);
  memcpy(account->read, account->before, sizeof account->read);
  if (fixed ? state == &run->trial : state->t == run->ahead.t) {
    add_works(account->last, account->read);
  } else if (!fixed && state->t != account->from.t) {
    bool projected = run->problem.formulation == BAUM_FORMULATION_PROJECTION;
    if (projected && find_unprojected(run, state->t) != BAUM_OK) {
      account->broken = true;
    }
    try_work(run, state, account->read);
  }
}

baum_status baum_i_account_put(baum_simulation *run, const baum_i_state *state, double *out)
{
  baum_i_account *account = run->account;
  if (!account) {
    return baum_i_fail(BAUM_ERR_STATE, "channel: the run keeps no energy account; set the option "
                                       "energy_account");
  }
  baum_i_kept_message kept = baum_i_message_keep();
  baum_i_account_read(run, state);
  baum_status status =
    baum_i_energy(account->workspace, state->t, state->q, state->v, &out[0], &out[1]);
  double works = 0.0;
  for (int i = 0; i < BAUM_I_WORKS; i++) {
    out[2 + i] = account->broken ? (double)NAN : account->read[i];
    works += i == BAUM_I_WORK_GAINS ? 0.0 : out[2 + i];
  }
  out[2 + BAUM_I_WORKS] = out[0] + out[1] - run->start_energy - works;
  return baum_i_message_settle(status, &kept);
}

/* ---- life ---- */

/* Return the number of Gauss nodes that the order of the method requires. */
static int node_count(const baum_simulation *run)
{
  int order = run->integrator->order;
  if (!baum_i_run_has_fixed_step(run) || order > 6) {
    return 4;
  }
  return order > 4 ? 3 : 2;
}

static baum_status make_memory(baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  baum_i_account *account = run->account;
  size_t nq = (size_t)m->nq;
  size_t nv = (size_t)m->nv;
  double *next = baum_i_alloc(3 * (nq + nv) + nv + (size_t)m->nc, sizeof *next);
  BAUM_I_TRY(baum_i_check_memory(next));
  account->from = (baum_i_state){.q = next, .v = next + nq};
  account->node = (baum_i_state){.q = next + nq + nv, .v = next + 2 * nq + nv};
  account->unprojected = next + 2 * (nq + nv);
  account->end_a = account->unprojected + nq + nv;
  account->lambda = account->end_a + nv;
  return BAUM_OK;
}

/* If projections may be large, create the second instance of the method. */
static baum_status make_stepper(baum_simulation *run)
{
  const baum_integrator *method = run->integrator;
  baum_i_account *account = run->account;
  bool wanted = method->step && method->advance &&
                run->problem.formulation == BAUM_FORMULATION_PROJECTION &&
                !baum_i_run_has_fixed_step(run);
  return wanted
           ? baum_i_integrator_create(method, &account->problem, &run->trial, &account->stepper)
           : BAUM_OK;
}

baum_status baum_i_account_create(baum_simulation *run)
{
  if (run->integrator->without_freedom) {
    return baum_i_fail(BAUM_ERR_UNSUPPORTED,
                       "simulation options: energy_account is true, but %s does not integrate "
                       "the motion, so powers cannot be summed",
                       run->integrator->name);
  }
  run->account = baum_i_alloc(1, sizeof *run->account);
  BAUM_I_TRY(baum_i_check_memory(run->account));
  BAUM_I_TRY(make_memory(run));
  BAUM_I_TRY(baum_i_run_make_workspace(run, &run->account->workspace));
  run->beside[0] = run->account->workspace;
  run->account->problem = run->problem;
  run->account->problem.workspace = run->account->workspace;
  run->account->nodes = node_count(run);
  run->workspace->unprojected = run->account->unprojected;
  return make_stepper(run);
}

void baum_i_account_destroy(const baum_integrator *method, baum_i_account *account)
{
  if (account) {
    baum_i_integrator_destroy(method, account->stepper);
    baum_workspace_destroy(account->workspace);
    baum_i_free(account->from.q);
    baum_i_free(account);
  }
}

/* ---- saved ---- */

void baum_i_account_forget(baum_i_account *account)
{
  baum_i_workspace_forget(account->workspace);
}

void baum_i_account_saved(baum_i_account *account, baum_i_saved *list)
{
  baum_workspace *w = account->workspace;
  baum_i_saved_add(list, account, offsetof(baum_i_account, workspace), 0);
  baum_i_saved_add(list, &w->evaluations, sizeof w->evaluations, 1);
  baum_i_saved_add_state(list, w->mechanism, &account->from);
}

/* ---- public ---- */

baum_status baum_simulation_energy_account(baum_simulation *simulation, baum_energy_account *out,
                                           size_t caller_size)
{
  const char *call = "baum_simulation_energy_account";
  BAUM_I_TRY(baum_i_run_check_out(simulation, out, caller_size, call));
  if (!simulation->account) {
    return baum_i_fail(BAUM_ERR_STATE,
                       "%s: the run keeps no account; set the option energy_account", call);
  }
  double columns[BAUM_I_ACCOUNT_WIDTH];
  BAUM_I_TRY(baum_i_run_may_be_read(simulation, call));
  BAUM_I_TRY(baum_i_account_put(simulation, &simulation->state, columns));
  const double *works = columns + 2;
  baum_energy_account account = {.kinetic = columns[0],
                                 .potential = columns[1],
                                 .start = simulation->start_energy,
                                 .loads = works[BAUM_I_POWER_LOADS],
                                 .springs = works[BAUM_I_POWER_SPRINGS],
                                 .dampers = works[BAUM_I_POWER_DAMPERS],
                                 .user_forces = works[BAUM_I_POWER_USER_FORCES],
                                 .bodies = works[BAUM_I_POWER_BODIES],
                                 .drivers = works[BAUM_I_WORK_DRIVERS],
                                 .violation = works[BAUM_I_WORK_VIOLATION],
                                 .projection = works[BAUM_I_WORK_PROJECTION],
                                 .gains = works[BAUM_I_WORK_GAINS],
                                 .residual = works[BAUM_I_WORKS],
                                 .evaluations = simulation->account->workspace->evaluations};
  baum_i_give_sized(out, caller_size, &account, sizeof account);
  return BAUM_OK;
}
