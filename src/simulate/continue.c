/* SPDX-License-Identifier: BSD-3-Clause */
/* Lets a run continue from the present state of another run. Both runs belong to the same
 * mechanism, but each run has its own options. */
#include "base/alloc.h"
#include "mechanism/definition.h"
#include "mechanism/general/coordinate.h"
#include "simulate/run.h"

/* Copies of the present state, the inputs and the driver laws of a run. */
typedef struct standing {
  double *q;      /* (nq) */
  double *v;      /* (nv) */
  double *inputs; /* (input_count) */
  /* The run's own copy of the parameters of elements, or NULL if it uses those of the mechanism. */
  double *parameters;
  /* angles of joints and forces that count revolutions, or NULL if there are none */
  double *angles;
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
  const double *angles = from->workspace->point.angles;
  if (angles) {
    out->angles = baum_i_copy(angles, (size_t)baum_i_angles_size(m), sizeof *angles);
  }
  size_t jumps = (size_t)from->schedule.count;
  out->schedule.jumps = baum_i_copy(from->schedule.jumps, jumps, sizeof *out->schedule.jumps);
  out->schedule.count = out->schedule.room = from->schedule.count;
  bool complete = out->q && out->v && out->inputs && (out->parameters || !from->parameters) &&
                  (out->angles || !angles) && out->schedule.jumps;
  return complete ? BAUM_OK : baum_i_fail_memory();
}

static void clear_standing(standing *s)
{
  baum_i_free(s->q);
  baum_i_free(s->v);
  baum_i_free(s->inputs);
  baum_i_free(s->parameters);
  baum_i_free(s->angles);
  baum_i_free(s->schedule.jumps);
}

/* Exchange the inputs, parameters, angles and schedule in *s with those of the run. */
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
  for (int k = 0; s->angles && k < baum_i_angles_size(w->mechanism); k++) {
    double angle = w->point.angles[k];
    w->point.angles[k] = s->angles[k];
    s->angles[k] = angle;
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
  return same ? BAUM_OK
              : baum_i_fail(
                  BAUM_ERR_ARGUMENT,
                  "%s: the two runs are of different mechanisms; "
                  "baum_workspace_project() and baum_simulation_set_state() carry a state over",
                  call);
}

baum_status baum_simulation_continue(baum_simulation *simulation, const baum_simulation *from)
{
  standing theirs;
  BAUM_I_TRY(check_both(simulation, from));
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = copy_standing(from, &theirs);
  if (status == BAUM_OK) {
    exchange(simulation, &theirs);
    (void)baum_i_run_follow_angles(simulation, &from->state);
    /* The state of the other run may violate the constraints by more than this run accepts.
     * Projection then removes the violation and changes q and v as little as possible. */
    if (simulation->options.start != BAUM_START_AS_GIVEN) {
      status = baum_i_project(simulation->workspace, from->state.t, theirs.q, theirs.v);
    }
    if (status == BAUM_OK) {
      status = baum_i_run_set_state(simulation, from->state.t, theirs.q, theirs.v);
    }
    if (status != BAUM_OK) {
      exchange(simulation, &theirs);
    }
  }
  clear_standing(&theirs);
  return baum_i_run_end_call(simulation, status, &kept);
}
