/* SPDX-License-Identifier: BSD-3-Clause */
/* A run that continues from the present state of another run of the same mechanism, with its own
 * options. */
#include "base/alloc.h"
#include "mechanism/definition.h"
#include "simulate/run.h"

/* Copies of the present state, inputs and driver laws of a run. */
typedef struct standing {
  double *q;          /* (nq) */
  double *v;          /* (nv) */
  double *inputs;     /* (input_count) */
  double *parameters; /* own parameters of the run; NULL: those of the mechanism */
  baum_i_schedule schedule;
} standing;

static baum_status copy_standing(const baum_simulation *from, standing *out)
{
  const baum_mechanism *m = from->workspace->mechanism;
  *out = (standing){0};
  out->q = baum_i_copy(from->state.q, (size_t)m->nq, sizeof *out->q);
  out->v = baum_i_copy(from->state.v, (size_t)m->nv, sizeof *out->v);
  out->inputs = baum_i_copy(from->workspace->inputs, (size_t)m->input_count, sizeof *out->inputs);
  if (from->parameters) {
    out->parameters =
      baum_i_copy(from->parameters, (size_t)m->parameter_count, sizeof *out->parameters);
  }
  bool complete = out->q && out->v && out->inputs && (out->parameters || !from->parameters);
  return complete ? baum_i_schedule_copy(&from->schedule, &out->schedule) : baum_i_fail_memory();
}

static void clear_standing(standing *s)
{
  baum_i_free(s->q);
  baum_i_free(s->v);
  baum_i_free(s->inputs);
  baum_i_free(s->parameters);
  baum_i_free(s->schedule.jumps);
}

/* Exchange these inputs, parameters and schedule with those of the run. */
static void exchange(baum_simulation *run, standing *s)
{
  baum_workspace *w = run->workspace;
  double *parameters = run->parameters;
  baum_i_schedule schedule = run->schedule;
  for (int k = 0; k < w->mechanism->input_count; k++) {
    double input = w->inputs[k];
    w->inputs[k] = s->inputs[k];
    s->inputs[k] = input;
  }
  run->parameters = s->parameters;
  s->parameters = parameters;
  run->schedule = s->schedule;
  s->schedule = schedule;
  w->point.parameters = run->parameters ? run->parameters : w->mechanism->parameters;
}

static baum_status check_both(const baum_simulation *run, const baum_simulation *from)
{
  const char *call = "baum_simulation_continue";
  BAUM_I_TRY(baum_i_run_may_be_changed(run, call));
  BAUM_I_TRY(baum_i_check_given(call, "the run to continue", from != NULL));
  bool same = run->fingerprint.structure == from->fingerprint.structure &&
              run->fingerprint.numbers == from->fingerprint.numbers;
  return same
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the two runs are of different mechanisms", call);
}

baum_status baum_simulation_continue(baum_simulation *simulation, const baum_simulation *from)
{
  standing theirs;
  BAUM_I_TRY(check_both(simulation, from));
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = copy_standing(from, &theirs);
  if (status == BAUM_OK) {
    exchange(simulation, &theirs);
    /* The other run may have a violation that this one does not accept. Projection removes it by
     * the least change of q and v. */
    if (simulation->options.start != BAUM_START_AS_GIVEN) {
      status = baum_i_project(simulation->workspace, from->state.t, theirs.q, theirs.v);
    }
    if (status == BAUM_OK) {
      status = baum_simulation_set_state(simulation, from->state.t, theirs.q, theirs.v);
    }
    if (status != BAUM_OK) {
      exchange(simulation, &theirs);
    }
  }
  clear_standing(&theirs);
  return baum_i_run_end_call(simulation, status, &kept);
}
