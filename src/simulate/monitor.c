/* SPDX-License-Identifier: BSD-3-Clause */
/* Monitors of a run: the largest violation and the joint that has it, predicted violation,
 * near-singular configurations, warnings, counters. */
#include <math.h>
#include <stddef.h>

#include "base/hot.h"
#include "base/measure.h"
#include "base/sized.h"
#include "simulate/account.h"
#include "simulate/crossing.h"

/* ---- observations at every step ---- */

static const baum_i_measure_kernel *kernel_of(const baum_mechanism *m)
{
  return BAUM_I_HOT_TABLE(m->wide, baum_i_measure_kernel);
}

static void observe_row(const baum_simulation *run, const double *rows, double *largest,
                        baum_joint_id *joint)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double size = kernel_of(m)->largest(m->nc, rows);
  if (size <= *largest) {
    return;
  }
  int row = 0;
  while (row < m->nc && !(fabs(rows[row]) >= size)) { /* no row matches if a number is not finite */
    row++;
  }
  row = row < m->nc ? row : baum_i_largest(rows, m->nc, &size);
  *largest = size;
  if (row >= 0) {
    *joint = baum_i_joint_id(m, baum_i_row_joint(m, row));
  }
}

static void observe_singular(baum_simulation *run, double t)
{
  const baum_workspace *w = run->workspace;
  if (w->near_singular == run->near_singular_seen) {
    return;
  }
  if (run->near_singular_seen == 0) {
    int row = baum_i_largest(w->lambda, w->mechanism->nc, NULL);
    baum_i_run_warn(
      run, BAUM_WARNING_ILL_CONDITIONED, t,
      row >= 0 ? baum_i_row_joint(w->mechanism, row) : BAUM_I_NO_JOINT,
      "t = %.9g s: the equations of motion are close to singular; largest multiplier in "
      "%s",
      t, baum_i_row_label(w->mechanism, row).text);
  }
  run->near_singular_seen = w->near_singular;
}

/* Omitted rows depend on the active rows only if the constraints do not contradict each other and
 * the motion stays on its branch. At a distance d from a configuration in which the active rows
 * alone are singular, the violation of the omitted rows may be 1/d times the violation of the
 * active rows. Very close to this configuration, the violation of the omitted rows may be as large
 * as the square root of the violation of the active rows. A larger violation is a contradiction. */
static const double NEGLIGIBLE = 1e-6; /* violation, as a displacement */
static const double TIMES = 10.0;

static double may_be_off(const baum_simulation *run, double kept)
{
  const baum_i_crossings *p = run->crossings;
  double pivot = p && p->recent_count > 0 ? baum_i_last_knot(p)->pivot : 0.0;
  return NEGLIGIBLE + TIMES * sqrt(kept * fmin(1.0, kept / pivot));
}

static void observe_redundant(baum_simulation *run, double t)
{
  baum_workspace *w = run->workspace;
  const baum_mechanism *m = w->mechanism;
  if (w->rows.count == 0 || baum_i_run_has_warned(run, BAUM_WARNING_CONTRADICTION) ||
      baum_i_need_jacobian(w) != BAUM_OK) {
    return; /* if a user function fails, a later evaluation reports it */
  }
  double kept = 0.0;
  double omitted = 0.0;
  int row = 0;
  (void)baum_i_row_sizes(w, w->phi, &row);
  for (int i = 0; i < m->nc; i++) {
    if (!w->rows.omitted[i]) {
      kept = fmax(kept, w->work_c[i]);
    } else if (w->work_c[i] > omitted) {
      omitted = w->work_c[i];
      row = i;
    }
  }
  if (omitted > may_be_off(run, kept)) {
    baum_i_run_warn(run, BAUM_WARNING_CONTRADICTION, t, baum_i_row_joint(m, row),
                    "t = %.9g s: an omitted redundant row of %s is violated by %.3g, relative to "
                    "the scales, but the active rows only by %.1g: constraints contradict each "
                    "other, or the motion has left its branch; do not trust it",
                    t, baum_i_row_label(m, row).text, omitted, kept);
  }
}

/* If the scaled violation is larger than this, the run has drifted far or diverges. */
static const double LARGE = 0.01;
/* The error of the motion is at least as large as the violation. If the run has a tolerance, the
 * violation must not be much larger than the tolerance. KEPT and TOLERANCES_KEPT are limits for
 * formulations that enforce Phi = 0. DRIFTED and TOLERANCES_DRIFTED are limits for formulations
 * that let Phi drift. */
static const double DRIFTED = 1e-3;
static const double TOLERANCES_DRIFTED = 1e4;
static const double KEPT = 1e-6;
static const double TOLERANCES_KEPT = 1e3;
/* For both Euler methods, this multiple of the violation predicted for the gains is allowed. */
static const double PREDICTED = 3.0;

/* Return the largest scaled violation for which the run does not warn. */
static double allowed_violation(const baum_simulation *run)
{
  double rtol = run->problem.rtol;
  if (baum_i_run_has_fixed_step(run) || isnan(rtol)) {
    return LARGE;
  }
  baum_formulation f = run->problem.formulation;
  bool keeps_positions =
    f == BAUM_FORMULATION_PROJECTION || f == BAUM_FORMULATION_GGL || f == BAUM_FORMULATION_INDEX3;
  double allowed =
    keeps_positions ? fmax(KEPT, TOLERANCES_KEPT * rtol) : fmax(DRIFTED, TOLERANCES_DRIFTED * rtol);
  return fmin(LARGE, allowed);
}

/* If gains are below this fraction of 1/h, the violation follows gamma with a delay, and the
 * formulas for the steady violation have errors above 10 %. */
static const double STEADY_GAIN = 0.1;

/* Predict the steady violation of both Euler methods: |Phi'| = h |gamma| / 2, |Phi| = alpha h
 * |gamma| / beta^2. */
static void predict(const baum_simulation *run, baum_counters *c)
{
  double alpha = run->problem.alpha;
  double beta = run->problem.beta;
  double h = run->options.step;
  bool predicted = run->integrator->predicts_violation && !run->workspace->row_gains &&
                   run->problem.formulation == BAUM_FORMULATION_BAUMGARTE &&
                   run->gains.amplification.stability == BAUM_STABLE &&
                   fmin(alpha, beta) * h >= STEADY_GAIN;
  c->predicted_phi = predicted ? alpha / (beta * beta) * h * run->largest_gamma : (double)NAN;
  c->predicted_phi_rate = predicted ? 0.5 * h * run->largest_gamma : (double)NAN;
}

/* Check the largest violation. The check is repeated only after the violation has doubled, because
 * it uses all values of J and therefore takes time. */
static void observe_large(baum_simulation *run, double t)
{
  baum_workspace *w = run->workspace;
  const baum_mechanism *m = w->mechanism;
  baum_counters *c = &run->counters;
  if (c->max_phi <= 2.0 * run->judged_phi || baum_i_run_has_warned(run, BAUM_WARNING_VIOLATION)) {
    return;
  }
  run->judged_phi = c->max_phi;
  if (baum_i_need_jacobian(w) != BAUM_OK) {
    return;
  }
  predict(run, c);
  double allowed = allowed_violation(run);
  int row = -1;
  (void)baum_i_row_sizes(w, w->phi, &row);
  for (int i = 0; i < m->nc; i++) {
    double size = w->work_c[i];
    if (size > allowed && !(fabs(w->phi[i]) <= PREDICTED * c->predicted_phi)) {
      baum_i_run_warn(
        run, BAUM_WARNING_VIOLATION, t, baum_i_row_joint(m, i),
        "t = %.9g s: %s is violated by %.3g, relative to the scales: the motion "
        "has drifted far or grows without bound; take other gains, a smaller step, or "
        "projection",
        t, baum_i_row_label(m, i).text, size);
      return;
    }
  }
}

/* Check the largest violation of rows of velocity level, relative to the speed of the motion. The
 * check is repeated only after the violation has doubled, as for positions. */
static void observe_large_velocities(baum_simulation *run, double t)
{
  baum_workspace *w = run->workspace;
  const baum_mechanism *m = w->mechanism;
  double largest = run->counters.max_phi_rate;
  if (m->velocity_row_count == 0 || baum_i_run_has_warned(run, BAUM_WARNING_VIOLATION) ||
      largest <= 2.0 * run->judged_phi_rate || baum_i_need_jacobian(w) != BAUM_OK) {
    return;
  }
  run->judged_phi_rate = largest;
  double rate = fmax(run->problem.rate, baum_i_scaled_size(m, run->state.v));
  int row = -1;
  (void)baum_i_row_sizes(w, w->phi_rate, &row);
  for (int i = 0; i < m->nc; i++) {
    if (m->velocity_rows[i] && w->work_c[i] > LARGE * rate) {
      baum_i_run_warn(
        run, BAUM_WARNING_VIOLATION, t, baum_i_row_joint(m, i),
        "t = %.9g s: %s, of velocity level, is violated by %.3g times the velocities: "
        "the motion has drifted far or grows without bound; take other gains, a "
        "smaller step, or projection",
        t, baum_i_row_label(m, i).text, w->work_c[i] / rate);
      return;
    }
  }
}

void baum_i_run_excuse_violation(baum_simulation *run)
{
  const baum_i_state *state = &run->state;
  baum_counters *c = &run->counters;
  if (baum_i_violation(run->workspace, state->t, state->q, state->v) == BAUM_OK) {
    observe_row(run, run->workspace->phi, &c->max_phi, &c->max_phi_joint);
    run->judged_phi = c->max_phi;
    (void)baum_i_largest(run->workspace->phi_rate, run->workspace->mechanism->nc,
                         &run->judged_phi_rate);
  }
}

void baum_i_run_observe(baum_simulation *run, double t, bool with_gamma)
{
  const baum_workspace *w = run->workspace;
  baum_counters *c = &run->counters;
  observe_row(run, w->phi, &c->max_phi, &c->max_phi_joint);
  observe_row(run, w->phi_rate, &c->max_phi_rate, &c->max_phi_rate_joint);
  if (with_gamma && run->integrator->predicts_violation) {
    /* The steady violation is proportional to |gamma| (docs/theory/stabilization.md). */
    double size = kernel_of(w->mechanism)->largest(w->mechanism->nc, w->gamma);
    run->largest_gamma = fmax(run->largest_gamma, size);
  }
  observe_large(run, t);
  observe_large_velocities(run, t);
  observe_singular(run, t);
  observe_redundant(run, t);
}

void baum_i_run_observe_jumps(baum_simulation *run, const baum_i_state *end)
{
  const baum_i_state *start = baum_i_run_has_fixed_step(run) ? &run->state : &run->ahead;
  const baum_i_point *point = &run->workspace->point;
  for (const baum_i_force_group *g = point->mechanism->force_groups; g->type; g++) {
    for (int i = 0; g->type->jumps && i < g->count; i++) {
      if (!g->type->jumps(g->forces[i], point, start->q, end->q)) {
        continue;
      }
      const baum_i_text label = baum_i_label(&g->forces[i]->element);
      if (g->type->counts_revolutions) {
        baum_i_run_warn(run, BAUM_WARNING_BUSHING, end->t, BAUM_I_NO_JOINT,
                        "t = %.9g s: the axes of %s nearly point in opposite directions, and the "
                        "step is too long to follow its angle; take smaller steps",
                        end->t, label.text);
      } else {
        baum_i_run_warn(run, BAUM_WARNING_BUSHING, end->t, BAUM_I_NO_JOINT,
                        "t = %.9g s: the rotation of %s has passed pi, where its moment jumps; for "
                        "larger rotations, use a joint and joint springs",
                        end->t, label.text);
      }
    }
  }
}

/* ---- counters ---- */

/* The counters of the work of solvers and methods. In a restored run, they also include the work
 * that was done before the run was saved. */
static const size_t COUNTED[BAUM_I_WORK] = {
  offsetof(baum_counters, factorizations), offsetof(baum_counters, full_factorizations),
  offsetof(baum_counters, rejected),       offsetof(baum_counters, nonlinear_iterations),
  offsetof(baum_counters, forced_steps),
};

static int64_t *counter_at(baum_counters *counters, int k)
{
  return (int64_t *)(void *)((char *)counters + COUNTED[k]);
}

static void count_here(const baum_simulation *run, int64_t here[BAUM_I_WORK])
{
  baum_i_kkt_counters kkt = baum_i_workspace_work(run->workspace);
  baum_i_statistics own = {0};
  if (run->integrator->statistics && run->self) {
    run->integrator->statistics(run->self, &own);
  }
  here[0] = kkt.factorizations + own.factorizations;
  here[1] = kkt.full_factorizations + own.full_factorizations;
  here[2] = own.rejected;
  here[3] = own.nonlinear_iterations;
  here[4] = own.forced;
}

void baum_i_run_count(baum_simulation *run)
{
  int64_t here[BAUM_I_WORK];
  count_here(run, here);
  run->counters.evaluations = run->workspace->evaluations;
  run->counters.near_singular = run->workspace->near_singular;
  for (int k = 0; k < BAUM_I_WORK; k++) {
    *counter_at(&run->counters, k) = run->work_before[k] + here[k];
  }
}

void baum_i_run_count_from_here(baum_simulation *run)
{
  int64_t here[BAUM_I_WORK];
  count_here(run, here);
  for (int k = 0; k < BAUM_I_WORK; k++) {
    run->work_before[k] = *counter_at(&run->counters, k) - here[k];
  }
}

baum_status baum_simulation_counters(baum_simulation *simulation, baum_counters *out,
                                     size_t caller_size)
{
  BAUM_I_TRY(baum_i_run_check_out(simulation, out, caller_size, "baum_simulation_counters"));
  double kinetic = 0.0;
  double potential = 0.0;
  const baum_i_state *state = &simulation->state;
  BAUM_I_TRY(baum_i_run_may_be_read(simulation, "baum_simulation_counters"));
  BAUM_I_TRY(
    baum_i_energy(simulation->workspace, state->t, state->q, state->v, &kinetic, &potential));
  baum_counters *c = &simulation->counters;
  double columns[BAUM_I_ACCOUNT_WIDTH] = {[BAUM_I_ACCOUNT_WIDTH - 1] = (double)NAN};
  BAUM_I_TRY(simulation->account ? baum_i_account_put(simulation, state, columns) : BAUM_OK);
  baum_i_run_count(simulation);
  predict(simulation, c);
  c->energy_change = kinetic + potential - simulation->start_energy;
  c->alpha = simulation->problem.alpha;
  c->beta = simulation->problem.beta;
  c->energy_residual = columns[BAUM_I_ACCOUNT_WIDTH - 1];
  bool stabilized = simulation->problem.formulation == BAUM_FORMULATION_BAUMGARTE;
  const baum_amplification *a = &simulation->gains.amplification;
  c->spectral_radius = stabilized ? a->spectral_radius : (double)NAN;
  /* log1p() loses no digits if the damping is small. */
  c->damping = stabilized ? -log1p(-a->damping) / simulation->options.step : (double)NAN;
  baum_i_give_sized(out, caller_size, c, sizeof *c);
  return BAUM_OK;
}
