/* SPDX-License-Identifier: BSD-3-Clause */
/* The reference is the motion with which runs are compared. The user gives it as samples or as a
 * closed-form solution, or the study computes it.
 *
 * The study computes a reference with projection and with Baumgarte's method, which have nothing in
 * common except the equations of motion. With each of these formulations, the study makes a run at
 * a tight tolerance and a run at half of this tolerance. The projection run at the tighter
 * tolerance is the reference. The largest difference between the reference and the other three runs
 * is the uncertainty of the reference. If runs fail, differ by more than CLOSE, or come near a
 * singular configuration, the study also tries looser tolerances and implicit methods. It then uses
 * the attempt with the smallest difference, but prefers attempts without a singular configuration.
 * In the last attempt, all runs use projection. Its second pair of runs uses RK4, with STEPS and
 * with 2 STEPS steps. This attempt succeeds even after singular configurations, where constraint
 * violations grow strongly. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/rotation.h"
#include "base/text.h"
#include "integrate/integrator.h"
#include "simulate/run.h"
#include "study/study.h"

/* No other attempt is made if the runs of an attempt differ by at most this. */
static const double CLOSE = 1e-9;
static const double TRUSTED = 1e-3;   /* largest difference for which a reference is trusted */
static const double ROUNDING = 1e-15; /* the uncertainty is at least this */
/* Time limit of a run of the reference, divided by the limit of an entry. */
static const double PATIENCE = 5.0;

enum {
  PARTIES = 2,
  RUNS = 4,
  STEPS = 5000,
  /* Runs with a tolerance take at least this many steps, and twice as many with half of it. Without
   * this limit, all four runs could step over a force that acts only for a short time, and would
   * agree on a wrong motion. With the same limit in all runs, their steps could be equal, and
   * their differences would not show their errors. */
  LEAST_STEPS = 250
};

typedef const baum_integrator *integrator_fn(void);

/* The integrators, the formulations and the tolerance with which an attempt computes a
 * reference. */
typedef struct attempt {
  integrator_fn *integrator[PARTIES];
  baum_formulation formulation[PARTIES];
  double rtol;
} attempt;

static const attempt ATTEMPTS[] = {
  {{baum_rk8, baum_rk8}, {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE}, 1e-13},
  {{baum_rk8, baum_rk8}, {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE}, 1e-11},
  {{baum_cvode_bdf, baum_ida}, {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE}, 1e-12},
  {{baum_rk8, baum_rk8}, {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE}, 1e-9},
  {{baum_cvode_bdf, baum_ida}, {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE}, 1e-10},
  {{baum_rk8, baum_rk4}, {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_PROJECTION}, 1e-10},
};

/* The attempt for mechanisms in which drivers prescribe all degrees of freedom. It compares
 * kinematics, whose configurations are accurate to rounding errors, with an integration. */
static const attempt WITHOUT_FREEDOM[] = {
  {{baum_kinematics, baum_rk8}, {BAUM_FORMULATION_DEFAULT, BAUM_FORMULATION_PROJECTION}, 1e-13},
};

/* ---- an attempt ---- */

/* The result of an attempt. */
typedef struct found {
  double *values; /* samples of the reference, or NULL if there is none */
  baum_i_differences most;
  bool singular;                   /* whether a run was near a singular configuration */
  bool failed;                     /* whether a run did not reach the end */
  baum_simulation_options options; /* options of the run that became the reference */
  char text[BAUM_I_TEXT_SIZE];
} found;

static baum_simulation_options setting(const baum_study *study, const attempt *a, int party,
                                       int half)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = a->integrator[party]();
  o.formulation = a->formulation[party];
  if (o.integrator == baum_rk4()) {
    o.step = fabs(study->t1 - study->t0) / (half ? 2 * STEPS : STEPS);
  } else if (!o.integrator->without_freedom) {
    o.rtol = half ? 0.5 * a->rtol : a->rtol;
    if (a != WITHOUT_FREEDOM) { /* forces do not change a prescribed motion */
      o.max_step = fabs(study->t1 - study->t0) / (half ? 2 * LEAST_STEPS : LEAST_STEPS);
    }
  }
  return o;
}

static void keep_largest(double *most, const double *other, int count)
{
  for (int k = 0; k < count; k++) {
    most[k] = fmax(most[k], other[k]);
  }
}

static void keep_most(baum_i_differences *most, const baum_i_differences *other)
{
  keep_largest(most->error, other->error, 3);
  keep_largest(most->q, other->q, 2);
  keep_largest(most->v, other->v, 2);
  keep_largest(most->lambda, other->lambda, 2);
  keep_largest(most->energy, other->energy, 2);
}

static void describe_failure(const baum_simulation_options *o, const baum_i_outcome *outcome,
                             found *out)
{
  (void)snprintf(out->text, sizeof out->text, "%s did not reach the end: %s",
                 baum_i_options_name(o).text, outcome->message);
}

/* Makes one run of an attempt and writes its samples to `values`. The first run becomes the
 * reference, and later runs are compared with it. */
static baum_status compare_run(baum_study *study, const baum_simulation_options *o,
                               baum_i_deadline *deadline, double *values, found *out)
{
  baum_i_outcome outcome;
  const baum_i_task task = {study, o, &study->reference.samples, false};
  baum_i_study_run_one(&task, deadline, values, &outcome);
  if (outcome.status == BAUM_ERR_MEMORY || baum_i_deadline_stops(deadline)) {
    return outcome.status == BAUM_ERR_MEMORY ? baum_i_fail_memory() : BAUM_STOP_CANCELLED;
  }
  if (outcome.status < BAUM_OK || outcome.status == BAUM_STOP_CANCELLED) {
    describe_failure(o, &outcome, out);
    out->failed = true;
    return BAUM_OK;
  }
  out->singular = out->singular || outcome.counters.near_singular_intervals > 0;
  if (!study->reference.samples.values) {
    study->reference.samples.values = values;
    return baum_i_study_weigh(study);
  }
  baum_i_differences d = baum_i_study_compare(study, &study->reference.samples, values);
  keep_most(&out->most, &d);
  return BAUM_OK;
}

static void describe(const baum_study *study, const attempt *a, found *out)
{
  const baum_simulation_options one = setting(study, a, 0, 0);
  const baum_simulation_options other = setting(study, a, 1, 0);
  baum_i_print(out->text, sizeof out->text, "%s and %s, with rtol %g and half of it,",
               baum_i_method_name(&one).text, baum_i_method_name(&other).text, a->rtol);
}

/* Makes up to four runs of an attempt, beginning with the run that becomes the reference. Sets
 * study->reference.samples.values to NULL afterwards. */
static baum_status run_attempt(baum_study *study, const attempt *a, baum_i_deadline *deadline,
                               found *out)
{
  baum_i_samples *r = &study->reference.samples;
  size_t size = (size_t)r->n * (size_t)baum_i_study_layout(study).width;
  *out = (found){.most = {.error = {ROUNDING, ROUNDING, ROUNDING}}};
  double *values[2] = {baum_i_alloc(size, sizeof(double)), baum_i_alloc(size, sizeof(double))};
  baum_status status = values[0] && values[1] ? BAUM_OK : baum_i_fail_memory();
  r->values = NULL;
  for (int k = 0; k < RUNS && status == BAUM_OK && !out->failed; k++) {
    baum_simulation_options o = setting(study, a, k / 2, k % 2 == 0);
    if (k % 2 == 0 || !o.integrator->without_freedom) {
      status = compare_run(study, &o, deadline, values[k > 0], out);
    }
  }
  if (!out->failed) {
    describe(study, a, out);
    out->options = setting(study, a, 0, 1);
  }
  r->values = NULL;
  baum_i_free(values[1]);
  bool kept = status == BAUM_OK && !out->failed;
  out->values = kept ? values[0] : NULL;
  if (!kept) {
    baum_i_free(values[0]);
  }
  return status;
}

/* ---- computed reference ---- */

static bool is_better(const found *a, const found *b)
{
  if (!a->values || !b->values) {
    return a->values != NULL;
  }
  return a->singular != b->singular ? b->singular : a->most.error[0] < b->most.error[0];
}

static void set_outcome(baum_study *study, const found *best)
{
  baum_i_study_reference *r = &study->reference;
  baum_study_reference *out = &r->out;
  out->uncertainty = fmax(best->most.error[0], ROUNDING);
  out->uncertainty_q = fmax(best->most.q[0], ROUNDING);
  out->uncertainty_v = fmax(best->most.v[0], ROUNDING);
  out->uncertainty_lambda = fmax(best->most.lambda[0], ROUNDING);
  out->uncertainty_energy = best->most.energy[0];
  out->digits = -log10(out->uncertainty);
  r->options = best->options;
  out->trusted = best->values && !best->singular && out->uncertainty <= TRUSTED;
  (void)snprintf(r->text, sizeof r->text, "%s", best->text);
  if (!best->values) {
    out->uncertainty = out->uncertainty_q = out->uncertainty_v = (double)NAN;
    out->uncertainty_lambda = out->uncertainty_energy = out->digits = (double)NAN;
    baum_i_append(r->text, sizeof r->text, "; there is no reference");
    return;
  }
  if (out->digits > 0.0) {
    baum_i_append(r->text, sizeof r->text, " agree to %.1f digits", out->digits);
  } else {
    baum_i_append(r->text, sizeof r->text, " differ by %.2g", out->uncertainty);
  }
  if (best->singular) {
    baum_i_append(r->text, sizeof r->text,
                  "; not trusted: the motion passes near a singular configuration");
  } else if (!out->trusted) {
    baum_i_append(r->text, sizeof r->text,
                  "; not trusted: they differ too much; take a shorter span, because the motion "
                  "may be chaotic");
  }
}

/* Returns the attempts that are suitable for the mechanism. */
static const attempt *attempts_for(const baum_mechanism *mechanism, int *count)
{
  baum_mobility mobility;
  baum_status status = baum_mechanism_mobility(mechanism, &mobility, sizeof mobility);
  bool is_free = status != BAUM_OK || mobility.position_degrees_of_freedom > 0;
  *count = (int)(is_free ? sizeof ATTEMPTS / sizeof ATTEMPTS[0]
                         : sizeof WITHOUT_FREEDOM / sizeof WITHOUT_FREEDOM[0]);
  return is_free ? ATTEMPTS : WITHOUT_FREEDOM;
}

static baum_status make_own(baum_study *study, baum_i_deadline *deadline)
{
  int count = 0;
  const attempt *attempts = attempts_for(study->mechanism, &count);
  found best = {.values = NULL};
  bool done = false;
  baum_status status = BAUM_OK;
  for (int k = 0; k < count && !done && status == BAUM_OK; k++) {
    found now;
    status = run_attempt(study, &attempts[k], deadline, &now);
    bool take = status == BAUM_OK && (k == 0 || is_better(&now, &best));
    baum_i_free(take ? best.values : now.values);
    best = take ? now : best;
    done = best.values && !best.singular && best.most.error[0] <= CLOSE;
  }
  study->reference.samples.values = best.values;
  BAUM_I_TRY(status);
  set_outcome(study, &best);
  return best.values ? baum_i_study_weigh(study) : BAUM_OK;
}

/* ---- given reference ---- */

static bool all_known(const double *values, int count)
{
  for (int i = 0; i < count; i++) {
    if (isnan(values[i])) {
      return false;
    }
  }
  return true;
}

/* Tells whether a channel is independent of velocities. */
static bool is_of_position(baum_quantity quantity)
{
  return quantity == BAUM_Q || quantity == BAUM_BODY_POSE || quantity == BAUM_PHI;
}

/* A run that serves only to evaluate channels. It is set to one sample after the other. */
typedef struct probe {
  baum_simulation *run;
  bool lost; /* whether the number of revolutions of some angle is unknown */
} probe;

/* Counts the revolutions of angles from the previous sample to this one. The velocities of both
 * samples predict each angle. If an angle differs from its prediction by more than a quarter of a
 * revolution, its number of revolutions is unknown from then on. */
static void follow(probe *p, const baum_i_state *at)
{
  double off = baum_i_run_follow_angles(p->run, at);
  p->lost = p->lost || off > 0.25 * BAUM_I_REVOLUTION;
}

/* Computes the energy and the user's channels of a sample from its q and v. Values that depend on
 * unknown elements of q or v become NaN. */
static baum_status derive(const baum_study *study, const baum_i_layout *l, probe *p, double t,
                          double *sample)
{
  baum_status status = BAUM_OK;
  bool has_v = all_known(sample + l->v, l->nv);
  for (int i = l->energy; i < l->width; i++) {
    sample[i] = (double)NAN;
  }
  if (!all_known(sample, l->nq)) {
    return BAUM_OK;
  }
  double *v = sample + l->v;
  double *still = baum_i_alloc((size_t)l->nv, sizeof *still);
  baum_i_state at = {.t = t, .q = sample, .v = has_v ? v : still};
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  BAUM_I_TRY(baum_i_check_memory(still));
  follow(p, &at);
  if (p->lost) {
    has_v = false; /* forces and energies may depend on the unknown number of revolutions */
  }
  if (has_v) {
    status = baum_i_output(p->run, &at, &energy, 1, sample + l->energy);
  }
  double *next = sample + l->user;
  for (int k = 0; k < study->channel_count && status == BAUM_OK; k++) {
    if (has_v || is_of_position(study->channels[k].quantity)) {
      status = baum_i_output(p->run, &at, &study->channels[k], 1, next);
    }
    next += baum_channels_width(study->mechanism, &study->channels[k], 1);
  }
  baum_i_free(still);
  return status;
}

static void fill(double *to, const double *from, int count)
{
  for (int i = 0; i < count; i++) {
    to[i] = from ? from[i] : (double)NAN;
  }
}

static baum_status give_one(const baum_study *study, const baum_i_layout *l, int k, double *sample)
{
  const baum_i_study_reference *r = &study->reference;
  fill(sample, NULL, l->width);
  if (!r->solution) {
    fill(sample, r->given[0] + (size_t)k * l->nq, l->nq);
    fill(sample + l->v, r->given[1] ? r->given[1] + (size_t)k * l->nv : NULL, l->nv);
    fill(sample + l->lambda, r->given[2] ? r->given[2] + (size_t)k * l->nc : NULL, l->nc);
    return BAUM_OK;
  }
  baum_i_listen();
  int answer = r->solution(r->samples.times[k], sample, sample + l->v, sample + l->lambda, r->user);
  const char *said = baum_i_heard();
  return answer == 0
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_CALLBACK, "study: the solution returned %d at t = %g s%s%s",
                         answer, r->samples.times[k], said ? ": " : "", said ? said : "");
}

static void trust_given(baum_study *study)
{
  baum_i_study_reference *r = &study->reference;
  baum_i_layout l = baum_i_study_layout(study);
  double least = pow(10.0, -r->digits);
  double kinetic = 0.0;
  for (int k = 0; k < r->samples.n; k++) {
    kinetic = fmax(kinetic, r->samples.values[(size_t)k * l.width + l.energy]);
  }
  r->out.uncertainty = r->out.uncertainty_q = r->out.uncertainty_v = least;
  r->out.uncertainty_lambda = least;
  r->out.uncertainty_energy = least * kinetic;
  r->out.digits = r->digits;
  r->out.trusted = true;
  baum_i_print(r->text, sizeof r->text, "%s, trusted to %.1f digits",
               r->solution ? "a closed-form solution" : "given", r->digits);
}

static baum_status take_given(baum_study *study)
{
  baum_i_study_reference *r = &study->reference;
  baum_i_layout l = baum_i_study_layout(study);
  probe p = {.lost = false};
  baum_i_samples *samples = &r->samples;
  samples->values = baum_i_alloc((size_t)samples->n * (size_t)l.width, sizeof *samples->values);
  BAUM_I_TRY(baum_i_check_memory(samples->values));
  baum_status status = baum_i_study_probe(study, &p.run);
  for (int k = 0; k < samples->n && status == BAUM_OK; k++) {
    double *sample = samples->values + (size_t)k * l.width;
    status = give_one(study, &l, k, sample);
    status = status == BAUM_OK ? derive(study, &l, &p, samples->times[k], sample) : status;
  }
  baum_simulation_destroy(p.run);
  status = status == BAUM_OK ? baum_i_study_weigh(study) : status;
  if (status == BAUM_OK) {
    trust_given(study);
  }
  return status;
}

/* ---- any reference ---- */

baum_status baum_i_study_set_times(baum_study *study)
{
  baum_i_study_reference *r = &study->reference;
  if (r->given[0]) {
    return BAUM_OK;
  }
  int n = study->options.samples;
  double *times = baum_i_alloc((size_t)n, sizeof *times);
  BAUM_I_TRY(baum_i_check_memory(times));
  for (int k = 0; k < n; k++) {
    times[k] = k == n - 1 ? study->t1 : study->t0 + (k + 1) * (study->t1 - study->t0) / n;
  }
  baum_i_free(r->samples.times);
  r->samples.times = times;
  r->samples.n = r->out.samples = n;
  return BAUM_OK;
}

baum_status baum_i_study_make_reference(baum_study *study, baum_i_deadline *deadline)
{
  baum_i_study_reference *r = &study->reference;
  if (r->samples.values) {
    return BAUM_OK;
  }
  baum_i_deadline longer = *deadline;
  longer.limit = PATIENCE * deadline->limit;
  bool is_given = r->given[0] || r->solution;
  baum_status status = is_given ? take_given(study) : make_own(study, &longer);
  if (status != BAUM_OK) {
    baum_i_free(r->samples.values);
    r->samples.values = NULL;
  }
  r->known = status == BAUM_OK;
  return status;
}

void baum_i_study_clear_reference(baum_study *study)
{
  baum_i_study_reference *r = &study->reference;
  baum_i_study_clear_samples(&r->samples);
  baum_i_free(r->weight);
  for (int k = 0; k < 3; k++) {
    baum_i_free(r->given[k]);
  }
  *r = (baum_i_study_reference){0};
}
