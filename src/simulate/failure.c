/* SPDX-License-Identifier: BSD-3-Clause */
/* Completes the message of a failed step. It adds the state of the run, the joint and the body that
 * are probably the cause, and advice. The function that failed has already set a message with the
 * time and the step.
 *
 * For this purpose, equation (5) of docs/notation.md is solved once at the end of the last good
 * step. The solution shows
 *
 *   the joint with the largest violation; if this is small, the joint with the largest multiplier
 *   the body with the largest acceleration
 *
 * All these quantities are compared relative to the scales. */
#include <math.h>

#include "base/text.h"
#include "simulate/crossing.h"
#include "simulate/run.h"

/* The message mentions a violation only if it is larger than this scaled displacement. */
static const double VIOLATED = 1e-3;
/* The message mentions a singular configuration only if the motion passed it less than this time
 * ago, in units of 1/rate. */
static const double RECENT = 10.0;

/* Kinematics has neither a step nor a tolerance. */
static const char *advice_for(const baum_simulation *run, baum_status status)
{
  bool is_kinematics = run->integrator->without_freedom;
  switch ((int)status) {
  case BAUM_ERR_SINGULAR:
    return is_kinematics ? "another integrator, such as rk8, may take the mechanism past an "
                           "isolated singular configuration; none passes a dead end"
                         : "a run with another step may pass an isolated singular configuration; "
                           "no step passes a dead end";
  case BAUM_ERR_CONVERGENCE:
    return is_kinematics                    ? "take a smaller max_step"
           : baum_i_run_has_fixed_step(run) ? "take a smaller step"
                                            : "take another rtol";
  case BAUM_ERR_STEP: return "check what acts there, or take a larger rtol";
  case BAUM_ERR_NOT_FINITE:
    return "check functions and numbers there; if the motion grows without bound, take a smaller "
           "step or other gains";
  case BAUM_ERR_INTEGRATOR: return "try another integrator";
  default: return NULL;
  }
}

/* If `times` is true, find the row i with the largest |x_i| n_i, otherwise the row with the largest
 * |x_i| / n_i. */
static int find_largest(const double *x, const double *n, int count, bool times, double *largest)
{
  int row = -1;
  *largest = 0.0;
  for (int i = 0; i < count; i++) {
    double size = times ? fabs(x[i]) * n[i] : fabs(x[i]) / n[i];
    if (size > *largest) {
      *largest = size;
      row = i;
    }
  }
  return row;
}

static void append_joint(baum_workspace *w, char *text, size_t size)
{
  const baum_mechanism *m = w->mechanism;
  double *displacement = w->work_c;
  double violation = 0.0;
  double load = 0.0;
  baum_i_row_displacements(w, displacement);
  int violated = find_largest(w->phi, displacement, m->nc, false, &violation);
  int loaded = find_largest(w->lambda, displacement, m->nc, true, &load);
  if (violated >= 0 && violation > VIOLATED) {
    baum_i_append(text, size, ", %s is violated by %.2g of the scales",
                  baum_i_row_label(m, violated).text, violation);
  } else if (loaded >= 0) {
    baum_i_append(text, size, ", %s bears the largest load", baum_i_row_label(m, loaded).text);
  }
}

static void append_body(const baum_workspace *w, char *text, size_t size)
{
  const baum_mechanism *m = w->mechanism;
  double largest = 0.0;
  int column = find_largest(w->a, m->scale, m->nv, false, &largest);
  if (column >= 0) {
    const baum_i_body *body = baum_i_velocity_body(m, column);
    baum_i_append(text, size, ", %s accelerates most", baum_i_label(&body->element).text);
  }
}

/* Name the singular configuration that the motion is near. If there is none, name the singular
 * configuration that the motion passed last, if this was not long ago and the motion may have left
 * its branch there. Only the first crossings of a run are stored. */
static void append_crossing(const baum_simulation *run, double now, char *text, size_t size)
{
  const baum_i_crossings *crossings = run->crossings;
  int64_t last = run->counters.near_singular_intervals - 1;
  if (!crossings || (!crossings->open && (last < 0 || last >= BAUM_I_NEAR_SINGULAR_KEPT))) {
    return;
  }
  double t = crossings->open ? crossings->lowest.t : crossings->kept[last].t;
  bool left = crossings->open || crossings->kept[last].branch != BAUM_BRANCH_CONTINUED;
  if (left && fabs(now - t) * run->problem.rate < RECENT) {
    baum_i_append(
      text, size,
      ", and the mechanism may lock up near t = %.9g s, where it is close to a singular "
      "configuration",
      t);
  }
}

/* Add facts about the run that can be stated without solving the equations. */
static void append_history(const baum_simulation *run, char *text, size_t size)
{
  const baum_counters *c = &run->counters;
  const baum_mechanism *m = run->workspace->mechanism;
  if (c->max_phi_joint.index1 > 0) {
    baum_i_append(text, size, ", %s has been violated most, by %.3g",
                  baum_i_joint_label(m, c->max_phi_joint.index1 - 1).text, c->max_phi);
  }
}

/* Add facts about the state of the run. This function evaluates the mechanism, but these
 * evaluations are not counted. */
static void append_place(baum_simulation *run, const baum_i_state *at, char *text, size_t size)
{
  baum_workspace *w = run->workspace;
  int64_t evaluations = w->evaluations;
  baum_status status = baum_i_acceleration(w, at->t, at->q, at->v, 0.0, 0.0);
  if (status == BAUM_OK) {
    status = baum_i_need_jacobian(w);
  }
  baum_i_append(text, size, "; at the last good step, t = %.9g s", at->t);
  if (status == BAUM_OK) {
    append_joint(w, text, size);
    append_body(w, text, size);
  } else {
    append_history(run, text, size);
  }
  append_crossing(run, at->t, text, size);
  w->evaluations = evaluations;
}

baum_status baum_i_run_explain_failure(baum_simulation *run, baum_status status,
                                       const baum_i_state *at)
{
  const char *help = advice_for(run, status);
  if (!help) {
    return status;
  }
  baum_i_probe probe;
  char text[BAUM_I_MESSAGE_SIZE / 2] = "";
  baum_i_probe_begin(&probe, run->workspace);
  append_place(run, at, text, sizeof text);
  int joint = BAUM_I_NO_JOINT;
  if (baum_i_run_find_wrong_derivative(run, at, &joint)) {
    return baum_i_fail(baum_i_probe_end(&probe, status),
                       "%.400s%.200s; correct a user function: "
                       "%.300s",
                       probe.message.text, text, baum_message());
  }
  return baum_i_fail(baum_i_probe_end(&probe, status), "%.500s%s; %s", probe.message.text, text,
                     help);
}
