/* SPDX-License-Identifier: BSD-3-Clause */

#include <math.h>

#include "base/message.h"
#include "simulate/account.h"
#include "simulate/companion.h"
#include "simulate/crossing.h"

/* Copy the set of omitted rows to the workspaces of the account and of the companion. If there is
 * not enough memory, these workspaces keep their previous omitted rows, which are still valid. */
static void tell_others(baum_simulation *run)
{
  for (int k = 0; k < 2; k++) {
    if (run->beside[k]) {
      (void)baum_i_omit_rows(run->beside[k], run->workspace->rows.omitted);
    }
  }
}

/* Project the present state before other rows are omitted. If the active rows are ill-conditioned,
 * the omitted rows are violated more than the active rows. Without the projection, the violation
 * would grow tenfold each time other rows are chosen. A state that the user has just given with
 * BAUM_START_AS_GIVEN is not changed. */
static void project_present(baum_simulation *run)
{
  baum_i_state *trial = &run->trial;
  if (run->options.start == BAUM_START_AS_GIVEN) {
    return;
  }
  baum_i_run_copy(run, &run->state, trial);
  if (baum_i_project(run->workspace, trial->t, trial->q, trial->v) == BAUM_OK) {
    baum_i_run_copy(run, trial, &run->state);
  }
}

static const double WHILE = 0.02; /* [rad] motion between two checks of the rows */

/* Tell whether the smallest pivots show that the kept rows become dependent. Pivots of KLU vary
 * irregularly, and pivots of QR become small only very close to a singular configuration. If
 * moments of inertia are small, the pivots of the block solver are rounding errors. */
static bool has_suitable_pivots(const baum_simulation *run)
{
  static const double NOISE = 1e-8;
  return run->workspace->path && run->crossings->usual > NOISE;
}

/* Return a number in place of a pivot that is not suitable: 0, which causes a check of the rows,
 * each time the mechanism has moved by WHILE, and otherwise 1. These checks cost little compared
 * with the other work of KLU and QR. */
static double guess_pivot(baum_simulation *run)
{
  const baum_i_state *state = &run->state;
  double rate = baum_i_scaled_size(run->workspace->mechanism, state->v);
  if (fabs(state->t - run->rows_looked_at) * rate < WHILE) {
    return 1.0;
  }
  run->rows_looked_at = state->t;
  return 0.0;
}

/* Tell whether the method may keep its history when other rows are omitted. It may keep the history
 * if the positions satisfy the constraints, because the motion then does not depend on the choice
 * of rows. The multipliers jump, but variable-step methods do not control the error of multipliers.
 * GGL restarts, because the jump would increase the error (three cranks at rtol 1e-10: 1.5e-7
 * instead of 1e-9). INDEX2 restarts, because the violation of positions would grow with each new
 * choice of rows. */
static bool goes_on(const baum_simulation *run)
{
  baum_formulation f = run->problem.formulation;
  return (f == BAUM_FORMULATION_PROJECTION || f == BAUM_FORMULATION_INDEX3) &&
         !baum_i_run_has_fixed_step(run);
}

static baum_status restart(baum_simulation *run)
{
  project_present(run);
  baum_status status = baum_i_run_restart(run);
  if (baum_i_integrator_remembers(run->integrator, &run->problem)) {
    run->integrator->forget(run->self); /* its pivots belong to the previous rows */
  }
  return status;
}

baum_status baum_i_run_choose_rows(baum_simulation *run)
{
  const baum_i_crossings *p = run->crossings;
  const baum_i_state *state = &run->state;
  if (!p || p->recent_count == 0 || run->workspace->rows.count == 0) {
    return BAUM_OK;
  }
  bool suitable = has_suitable_pivots(run);
  double pivot = suitable ? baum_i_last_knot(p)->pivot : guess_pivot(run);
  baum_i_choice choice = {.well_separated = true, .by_lengths = !suitable};
  if (!baum_i_choose_rows(run->workspace, state->t, state->q, pivot, choice)) {
    return BAUM_OK;
  }
  if (!goes_on(run)) {
    baum_i_run_end_before_change(run);
  }
  tell_others(run);
  baum_i_crossings_renew(run);
  return goes_on(run) ? BAUM_OK : restart(run);
}

void baum_i_run_restart_rows(baum_simulation *run, const baum_i_state *state)
{
  bool is_kinematics = !run->crossings;
  baum_i_choice choice = {.well_separated = !is_kinematics, .by_lengths = is_kinematics};
  if (baum_i_choose_rows(run->workspace, state->t, state->q, 0.0, choice) && !is_kinematics) {
    tell_others(run);
    baum_i_crossings_end(run);
  }
}

baum_status baum_i_run_omit_rows(baum_simulation *run, const unsigned char *omitted)
{
  BAUM_I_TRY(baum_i_omit_rows(run->workspace, omitted));
  tell_others(run);
  return BAUM_OK;
}
