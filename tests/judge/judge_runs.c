/* SPDX-License-Identifier: BSD-3-Clause */
#include "judge_runs.h"

#include <math.h>
#include <string.h>

#include "judge_baum.h"

static const double RIGHT = 0.01;
static const double GREY = 0.1;

static bool read_start(judge_case *c)
{
  baum_simulation *run = NULL;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  c->failed = "create";
  if (baum_simulation_create(c->m, &o, &run) != BAUM_OK) {
    return false;
  }
  memcpy(c->scene.q, baum_simulation_q(run), (size_t)c->scene.n * sizeof *c->scene.q);
  memcpy(c->scene.v, baum_simulation_v(run), (size_t)c->scene.n * sizeof *c->scene.v);
  baum_simulation_destroy(run);
  return true;
}

/* Checks that the library and the reference describe the same mechanism, by comparing their
 * accelerations at the start. */
static bool accelerations_agree(judge_case *c)
{
  const judge_scene *s = &c->scene;
  double own[JUDGE_N];
  double theirs[JUDGE_N];
  double most = 0.0;
  double apart = 0.0;
  baum_workspace *w = NULL;
  c->failed = "accelerations";
  if (baum_workspace_create(c->m, &w) != BAUM_OK) {
    return false;
  }
  baum_status status = baum_workspace_acceleration(w, 0.0, s->q, s->v, 0.0, 0.0, theirs, NULL);
  baum_workspace_destroy(w);
  if (status != BAUM_OK || !judge_acceleration(s, 0.0, s->q, s->v, own)) {
    return false;
  }
  for (int i = 0; i < s->n; i++) {
    most = fmax(most, fabs(own[i]));
    apart = fmax(apart, fabs(own[i] - theirs[i]));
  }
  return apart <= 1e-7 * (1.0 + most);
}

bool judge_open(judge_case *c, uint64_t seed)
{
  *c = (judge_case){.failed = "scene"};
  if (!judge_scene_draw(&c->scene, seed)) {
    return false;
  }
  c->failed = "build";
  c->m = judge_build(&c->scene);
  if (!c->m || !read_start(c) || !accelerations_agree(c)) {
    return false;
  }
  (void)baum_mechanism_get_characteristic_length(c->m, &c->length);
  c->failed = NULL;
  if (!judge_find_reference(&c->scene, c->scene.q, c->scene.v, c->length, &c->reference)) {
    c->failed = c->reference.failed;
  }
  return !c->failed;
}

void judge_close(judge_case *c)
{
  baum_mechanism_destroy(c->m);
  c->m = NULL;
}

static void read_codes(const baum_simulation *run, judge_outcome *out)
{
  baum_warning warning;
  while (out->code_count < JUDGE_CODES &&
         baum_simulation_warning(run, out->code_count, &warning, sizeof warning) == BAUM_OK) {
    out->codes[out->code_count++] = (int)warning.code;
  }
}

static void compare(const judge_case *c, const double *rows, judge_outcome *out)
{
  const judge_scene *s = &c->scene;
  out->error = 0.0;
  for (int k = 1; k <= JUDGE_SAMPLES; k++) {
    const double *truth = c->reference.at[2 * k].q;
    out->error_end = 0.0;
    for (int i = 0; i < s->n; i++) {
      double unit = judge_is_angle(s, i) ? 1.0 : c->length;
      double one = fabs(rows[(k - 1) * s->n + i] - truth[i]) / unit;
      out->error_end = one <= out->error_end ? out->error_end : one; /* this keeps NaN */
    }
    out->error = out->error_end <= out->error ? out->error : out->error_end;
  }
}

static judge_class classify(const judge_outcome *out)
{
  if (out->status < BAUM_OK) {
    return JUDGE_STOPPED;
  }
  if (out->error < RIGHT) {
    return JUDGE_RIGHT;
  }
  return out->error < GREY ? JUDGE_GREY : JUDGE_WRONG;
}

void judge_run(const judge_case *c, const judge_setting *setting, bool error_check,
               judge_outcome *out)
{
  double rows[JUDGE_SAMPLES * JUDGE_N];
  double times[JUDGE_SAMPLES];
  const baum_channel positions = baum_channel_of(BAUM_Q);
  baum_simulation *run = NULL;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = setting->integrator();
  o.formulation = setting->formulation;
  if (setting->step > 0.0) {
    o.step = setting->step;
  } else {
    o.rtol = setting->rtol;
  }
  o.max_steps = 1000000;
  o.error_check = error_check;
  *out = (judge_outcome){.error = (double)NAN, .error_end = (double)NAN};
  out->status = baum_simulation_create(c->m, &o, &run);
  if (!run) {
    out->class = out->status == BAUM_ERR_UNSUPPORTED ? JUDGE_UNUSED : JUDGE_STOPPED;
    return;
  }
  for (int k = 0; k < JUDGE_SAMPLES; k++) {
    times[k] = c->reference.t[2 * (k + 1)];
  }
  out->status = baum_simulation_sample(run, times, JUDGE_SAMPLES, &positions, 1, rows, NULL);
  if (out->status >= BAUM_OK) {
    compare(c, rows, out);
  }
  out->class = classify(out);
  read_codes(run, out);
  (void)baum_simulation_counters(run, &out->counters, sizeof out->counters);
  out->doubted = out->counters.doubts > 0;
  baum_simulation_destroy(run);
}
