/* SPDX-License-Identifier: BSD-3-Clause */
/* Makes one run of a study. A run that measures errors computes all samples. A run that measures
 * the cost only advances to the end of the span.
 */
#include <math.h>
#include <stdio.h>

#include "base/alloc.h"
#include "base/platform.h"
#include "base/text.h"
#include "integrate/integrator.h"
#include "study/study.h"

static const double LOOK = 0.005; /* [s] wall time between two checks of the deadline */

bool baum_i_deadline_stops(const baum_i_deadline *deadline)
{
  return atomic_load(&deadline->study->cancelled) != 0 ||
         baum_i_wall_seconds() >= deadline->wall_end;
}

void baum_i_say_too_long(double limit, char *text, size_t size)
{
  baum_i_print(text, size, "it takes more than %g s; raise entry_limit or use a coarser setting",
               limit);
}

static int check_deadline(const baum_simulation *simulation, double t, void *user)
{
  (void)simulation;
  (void)t;
  baum_i_deadline *deadline = user;
  deadline->timed_out = baum_i_thread_seconds() - deadline->begin >= deadline->limit;
  return deadline->timed_out || baum_i_deadline_stops(deadline);
}

/* Returns the options of the task, completed by the options that the study determines. */
static baum_simulation_options complete(const baum_i_task *task, baum_i_deadline *deadline)
{
  const baum_study *study = task->study;
  baum_simulation_options o = *task->options;
  o.start_time = study->t0;
  o.check_derivatives = false;
  o.progress = check_deadline;
  o.progress_interval = LOOK;
  o.user = deadline;
  o.energy_account =
    task->with_account && study->options.energy_account && !o.integrator->without_freedom;
  return o;
}

static baum_status sample(const baum_i_task *task, baum_simulation *run, double *values)
{
  const baum_study *study = task->study;
  const baum_i_samples *samples = task->samples;
  baum_i_layout l = baum_i_study_layout(study);
  baum_channel *channels =
    baum_i_alloc((size_t)study->channel_count + BAUM_I_CHANNELS, sizeof *channels);
  BAUM_I_TRY(baum_i_check_memory(channels));
  int count = baum_i_study_channels(study, channels);
  for (int k = 0; k < samples->n * l.width; k++) {
    values[k] = (double)NAN;
  }
  baum_status status =
    baum_simulation_sample(run, samples->times, samples->n, channels, count, values, NULL);
  baum_i_free(channels);
  bool goes_on = status >= BAUM_OK && status != BAUM_STOP_CANCELLED && !samples->q;
  baum_status rest = goes_on ? baum_simulation_advance_to(run, study->t1) : BAUM_OK;
  return rest == BAUM_OK ? status : rest;
}

/* Advances a run to the end of the span. A run of kinematics also stops at the times of all
 * samples, because its cost depends on the times at which configurations are requested. */
static baum_status advance(const baum_i_task *task, baum_simulation *run)
{
  const baum_i_samples *samples = task->samples;
  baum_status status = BAUM_OK;
  for (int k = 0; task->options->integrator->without_freedom && k < samples->n && status >= BAUM_OK;
       k++) {
    status = baum_simulation_advance_to(run, samples->times[k]);
    if (status == BAUM_STOP_CANCELLED) {
      return status;
    }
  }
  return status < BAUM_OK ? status : baum_simulation_advance_to(run, task->study->t1);
}

/* Copies the first warning that says that the motion may be wrong. If there is none, copies the
 * first of all warnings. */
static void tell_warning(const baum_simulation *run, const baum_counters *counters, char *text,
                         size_t size)
{
  baum_warning warning = {.doubts_motion = false};
  for (int64_t k = counters->warnings - 1; k >= 0; k--) {
    baum_warning other;
    (void)baum_simulation_warning(run, k, &other, sizeof other);
    if (other.doubts_motion >= warning.doubts_motion) {
      warning = other;
    }
  }
  baum_i_print(text, size, "%s", warning.text);
}

static void read_outcome(baum_simulation *run, const baum_i_deadline *deadline, bool with_account,
                         baum_i_outcome *out)
{
  const double none = (double)NAN;
  out->account = (baum_energy_account){.violation = none, .projection = none, .gains = none};
  (void)baum_simulation_counters(run, &out->counters, sizeof out->counters);
  if (with_account) {
    (void)baum_simulation_energy_account(run, &out->account, sizeof out->account);
  }
  if (deadline->timed_out) {
    baum_i_say_too_long(deadline->limit, out->message, sizeof out->message);
  } else if (out->status < BAUM_OK) {
    (void)snprintf(out->message, sizeof out->message, "%s", baum_simulation_message(run));
  } else if (out->counters.warnings > 0) {
    tell_warning(run, &out->counters, out->message, sizeof out->message);
  }
}

void baum_i_study_run_one(const baum_i_task *task, baum_i_deadline *deadline, double *values,
                          baum_i_outcome *out)
{
  const baum_study *study = task->study;
  *out = (baum_i_outcome){0};
  baum_simulation_options o = complete(task, deadline);
  baum_simulation *run = NULL;
  deadline->timed_out = false;
  deadline->begin = baum_i_thread_seconds();
  out->status = baum_simulation_create(study->mechanism, &o, &run);
  if (out->status == BAUM_OK && task->samples->q) {
    out->status = baum_simulation_set_state(run, study->t0, task->samples->q, task->samples->v);
  }
  out->created = out->status == BAUM_OK;
  if (!out->created) {
    (void)snprintf(out->message, sizeof out->message, "%s", baum_message());
    baum_simulation_destroy(run);
    return;
  }
  out->status = values ? sample(task, run, values) : advance(task, run);
  read_outcome(run, deadline, o.energy_account, out);
  baum_simulation_destroy(run);
  out->cpu = baum_i_thread_seconds() - deadline->begin;
}

baum_status baum_i_study_probe(const baum_study *study, baum_simulation **out)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.formulation = BAUM_FORMULATION_UNSTABILIZED;
  o.step = fabs(study->t1 - study->t0);
  o.start_time = study->t0;
  o.check_derivatives = false;
  return baum_simulation_create(study->mechanism, &o, out);
}
