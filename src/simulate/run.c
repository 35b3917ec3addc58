/* SPDX-License-Identifier: BSD-3-Clause */
/* Common functions of a run: copy a state, create another workspace, warn (one entry per kind),
 * fail, finish. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "base/text.h"
#include "mechanism/general/coordinate.h"
#include "simulate/run.h"

void baum_i_run_copy(const baum_simulation *run, const baum_i_state *from, baum_i_state *to)
{
  const baum_mechanism *m = run->workspace->mechanism;
  to->t = from->t;
  memcpy(to->q, from->q, (size_t)(m->nq + m->nv) * sizeof *to->q);
}

double baum_i_run_follow_angles(baum_simulation *run, const baum_i_state *state)
{
  baum_i_point *point = &run->workspace->point;
  if (!point->angles) {
    return 0.0;
  }
  baum_i_point_set(point, state->t, state->q, state->v);
  return baum_i_follow_angles(point);
}

void baum_i_run_follow_step(baum_simulation *run, const baum_i_state *end)
{
  const baum_i_point *point = &run->workspace->point;
  if (point->angles) {
    double rate = baum_i_scaled_size(point->mechanism, end->v);
    if (!baum_i_angles_are_near(point, end->t, rate)) {
      (void)baum_i_run_follow_angles(run, end);
    }
  }
}

void baum_i_run_share_equations(const baum_simulation *run, baum_i_problem *own)
{
  baum_workspace *w = own->workspace;
  own->direction = run->problem.direction;
  own->alpha = run->problem.alpha; /* restoring a run may change them */
  own->beta = run->problem.beta;
  own->rate = run->problem.rate;
  w->point.parameters = run->workspace->point.parameters;
  w->point.inputs = run->workspace->point.inputs;
  w->point.angles = run->workspace->point.angles;
  w->row_gains = run->workspace->row_gains;
}

baum_status baum_i_run_make_workspace(const baum_simulation *run, baum_workspace **out)
{
  const baum_workspace *w = run->workspace;
  BAUM_I_TRY(baum_i_workspace_create(w->mechanism, w->choice, out));
  baum_i_copy_rows(*out, w);
  (*out)->blocks_only = w->blocks_only;
  return baum_i_use_blocks(*out);
}

baum_status baum_i_run_check_out(const baum_simulation *run, const void *out, size_t caller_size,
                                 const char *call)
{
  return run ? baum_i_check_sized(out, caller_size, call)
             : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the simulation is NULL", call);
}

/* ---- names of warnings ---- */

const char *baum_warning_name(baum_warning_code code)
{
  static const struct {
    baum_warning_code code;
    const char *name;
  } names[] = {
    {BAUM_WARNING_REDUNDANT_ROWS, "redundant_rows"},
    {BAUM_WARNING_GAINS, "gains"},
    {BAUM_WARNING_NOISY_DERIVATIVES, "noisy_derivatives"},
    {BAUM_WARNING_INDEX3, "index3"},
    {BAUM_WARNING_LOOSE_VELOCITIES, "loose_velocities"},
    {BAUM_WARNING_ENERGY_ACCOUNT, "energy_account"},
    {BAUM_WARNING_ILL_CONDITIONED, "ill_conditioned"},
    {BAUM_WARNING_SINGULARITY_CROSSED, "singularity_crossed"},
    {BAUM_WARNING_ERROR_UNKNOWN, "error_unknown"},
    {BAUM_WARNING_BRANCH, "branch"},
    {BAUM_WARNING_VIOLATION, "violation"},
    {BAUM_WARNING_CONTRADICTION, "contradiction"},
    {BAUM_WARNING_ACCURACY, "accuracy"},
    {BAUM_WARNING_SINGULAR_START, "singular_start"},
    {BAUM_WARNING_BUSHING, "bushing"},
    {BAUM_WARNING_WRONG_DERIVATIVE, "wrong_derivative"},
  };
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    if (names[i].code == code) {
      return names[i].name;
    }
  }
  return NULL;
}

bool baum_i_doubts_motion(baum_warning_code code)
{
  return code >= BAUM_WARNING_BRANCH;
}

/* ---- keep ---- */

static baum_warning *find_warning(baum_simulation *run, baum_warning_code code)
{
  for (int64_t k = 0; k < run->counters.warnings; k++) {
    if (run->warnings[k].code == code) {
      return &run->warnings[k];
    }
  }
  return NULL;
}

bool baum_i_run_has_warned(const baum_simulation *run, baum_warning_code code)
{
  return find_warning(baum_i_mutable(run), code) != NULL;
}

void baum_i_run_warn(baum_simulation *run, baum_warning_code code, double t, int joint,
                     const char *format, ...)
{
  baum_warning *warning = find_warning(run, code);
  if (warning) {
    warning->last = t;
    warning->count++;
    return;
  }
  if (run->counters.warnings == BAUM_I_WARNINGS) {
    return; /* possible only in a run restored from a forged buffer */
  }
  run->announced[run->counters.warnings] = 0;
  warning = &run->warnings[run->counters.warnings++];
  *warning = (baum_warning){
    .code = code, .doubts_motion = baum_i_doubts_motion(code), .first = t, .last = t, .count = 1};
  if (joint >= 0) {
    warning->joint = baum_i_joint_id(run->workspace->mechanism, joint);
  }
  run->counters.doubts += warning->doubts_motion;
  va_list arguments;
  va_start(arguments, format);
  (void)baum_i_format(warning->text, sizeof warning->text, format, arguments);
  va_end(arguments);
}

/* ---- tell ---- */

baum_status baum_i_run_end_call(baum_simulation *run, baum_status status,
                                const baum_i_kept_message *before)
{
  return status == BAUM_OK ? baum_i_message_settle(BAUM_OK, before) : baum_i_run_fail(run, status);
}

baum_status baum_i_run_fail(baum_simulation *run, baum_status status)
{
  memcpy(run->message, baum_message(), sizeof run->message);
  return status;
}

/* Write the message of a warning, the number of occurrences, and the heading of its entry in
 * docs/cookbook/warnings.md. If the text becomes too long, the message is cut, but the heading is
 * not. */
static void write_warning(const baum_warning *warning, char text[sizeof warning->text])
{
  const char *name = baum_warning_name(warning->code);
  const baum_i_text heading =
    baum_i_text_of(" [warning %d %s]", (int)warning->code, name ? name : "unknown");
  const size_t room = sizeof warning->text - strlen(heading.text);
  baum_i_print(text, room, "%s", warning->text);
  if (warning->count > 1) {
    baum_i_append(text, room, " (%lld times, the last at t = %.9g s)", (long long)warning->count,
                  warning->last);
  }
  baum_i_append(text, sizeof warning->text, "%s", heading.text);
}

baum_status baum_i_run_finish(baum_simulation *run)
{
  const baum_warning *worst = NULL;
  int64_t count = 0;
  for (int64_t k = 0; k < run->counters.warnings; k++) {
    const baum_warning *warning = &run->warnings[k];
    bool is_new = warning->count > run->announced[k];
    if (is_new && (!worst || warning->doubts_motion > worst->doubts_motion)) {
      worst = warning;
    }
    count += warning->count - run->announced[k];
    run->announced[k] = warning->count;
  }
  if (!worst) {
    return BAUM_OK;
  }
  char text[sizeof worst->text];
  write_warning(worst, text);
  (void)baum_i_fail(BAUM_WARNED, "t = %.9g s: %lld new %s: %s", run->state.t, (long long)count,
                    count == 1 ? "warning" : "warnings", text);
  return baum_i_run_fail(run, BAUM_WARNED);
}

baum_status baum_simulation_warning(const baum_simulation *simulation, int64_t k, baum_warning *out,
                                    size_t caller_size)
{
  const char *call = "baum_simulation_warning";
  BAUM_I_TRY(baum_i_run_check_out(simulation, out, caller_size, call));
  BAUM_I_TRY(baum_i_check_entry(k, 0, simulation->counters.warnings, call));
  baum_warning warning = simulation->warnings[k];
  write_warning(&simulation->warnings[k], warning.text);
  baum_i_give_sized(out, caller_size, &warning, sizeof warning);
  return BAUM_OK;
}
