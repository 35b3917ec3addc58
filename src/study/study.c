/* SPDX-License-Identifier: BSD-3-Clause */
/* Creates a study, sets its options, its error and its reference, and returns the reference. */
#include <baum/study.h>

#include <math.h>
#include <string.h>

#include <baum/version.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "base/text.h"
#include "integrate/integrator.h"
#include "mechanism/definition.h"
#include "simulate/options.h"
#include "simulate/run.h"
#include "study/study.h"

/* ---- creating and destroying ---- */

enum { NAMED = 3 }; /* the description of the error names at most this many channels */

static void describe_error(baum_study *study)
{
  char *text = study->error_text;
  size_t size = sizeof study->error_text;
  if (study->channel_count == 0) {
    baum_i_print(text, size,
                 "largest error of all positions over all samples, "
                 "lengths divided by %.4g m, angles in rad",
                 study->mechanism->length);
    return;
  }
  baum_i_print(text, size, "largest error of ");
  for (int k = 0; k < study->channel_count && k < NAMED; k++) {
    baum_i_append(text, size, "%s", k > 0 ? ", " : "");
    baum_i_append_channel(study->mechanism, &study->channels[k], text, size);
  }
  if (study->channel_count > NAMED) {
    baum_i_append(text, size, " and %d more", study->channel_count - NAMED);
  }
  baum_i_append(text, size, " over all samples, divided by %g", study->unit);
}

baum_status baum_study_create(const baum_mechanism *mechanism, double t0, double t1,
                              baum_study **out)
{
  const char *call = "baum_study_create";
  if (!out) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: out is NULL", call);
  }
  *out = NULL;
  BAUM_I_TRY(baum_i_check_frozen(mechanism, call));
  if (!isfinite(t0) || !isfinite(t1) || t0 == t1) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: t0 is %g s and t1 is %g s; they must be finite and differ", call, t0,
                       t1);
  }
  baum_study *study = baum_i_alloc(1, sizeof *study);
  BAUM_I_TRY(baum_i_check_memory(study));
  study->mechanism = baum_i_mechanism_share(mechanism);
  study->t0 = t0;
  study->t1 = t1;
  study->unit = 1.0;
  study->options = baum_study_options_default();
  study->reference.out.digits = (double)NAN;
  atomic_init(&study->cancelled, 0);
  describe_error(study);
  *out = study;
  return BAUM_OK;
}

/* Removes the last entries and methods, so that only the first `entries` entries and the first
 * `methods` methods remain. */
static void truncate(baum_study *study, int entries, int methods)
{
  for (int k = entries; k < study->entry_count; k++) {
    baum_i_free(study->entries[k]->row_gains);
    baum_i_free(study->entries[k]);
  }
  study->entry_count = entries;
  study->method_count = methods;
}

/* Tells whether this build contains an integrator. The list of integrators always contains the
 * integrators of SUNDIALS, even in a build without SUNDIALS. */
static bool is_in_build(const baum_integrator *integrator)
{
  const char *name = integrator->name;
  bool of_sundials = strncmp(name, "cvode", 5) == 0 || strcmp(name, "ida") == 0;
  return !of_sundials || baum_has("sundials");
}

baum_status baum_i_study_add_each(baum_study *study, const baum_integrator *only,
                                  baum_i_add_fn *add, void *user, const char *missing)
{
  int entries = study->entry_count;
  int methods = study->method_count;
  baum_status status = BAUM_OK;
  const baum_integrator *integrator = NULL;
  for (int k = 0; status == BAUM_OK && (integrator = baum_integrator_at(k)) != NULL; k++) {
    if ((!only || only == integrator) && is_in_build(integrator)) {
      status = add(user, integrator);
    }
  }
  if (status == BAUM_OK && study->entry_count == entries) {
    status = baum_i_fail(BAUM_ERR_ARGUMENT, "%s", missing);
  }
  if (status != BAUM_OK) {
    truncate(study, entries, methods);
  }
  return status;
}

void baum_study_destroy(baum_study *study)
{
  if (!study || study->running) {
    return;
  }
  truncate(study, 0, 0);
  baum_i_free(study->entries);
  baum_i_free(study->methods);
  baum_i_free(study->channels);
  baum_i_free(study->options.file);
  baum_i_study_clear_reference(study);
  for (int k = 0; k < BAUM_I_VALIDATIONS; k++) {
    baum_i_study_clear_samples(&study->validations[k]);
  }
  baum_mechanism_destroy(baum_i_mutable(study->mechanism));
  baum_i_free(study);
}

void baum_study_cancel(baum_study *study)
{
  if (study) {
    atomic_store(&study->cancelled, 1);
  }
}

/* ---- options ---- */

enum { SAMPLES = 100, MOST_SAMPLES = 1000000, MOST_THREADS = 1024, MOST_REPEATS = 1000000 };
/* Largest total number of values of q, v and lambda in the samples of a run. */
static const double MOST_NUMBERS = 1e8;

static int most_samples(const baum_mechanism *m)
{
  double each = (double)m->nq + m->nv + m->nc;
  return (int)fmax(SAMPLES, fmin(MOST_SAMPLES, MOST_NUMBERS / each));
}

void baum_study_options_init(baum_study_options *options, size_t caller_size)
{
  const baum_study_options defaults = {
    .samples = SAMPLES,
    .threads = 1,
    .repeats = 5,
    .entry_limit = 10.0,
    .time_budget = INFINITY,
    .energy_account = true,
    .validate = true,
  };
  baum_i_give_sized(options, caller_size, &defaults, sizeof defaults);
}

static baum_status check_options(const baum_study *study, const baum_study_options *o)
{
  const struct {
    const char *name;
    int32_t value;
    int least;
    int most;
  } counts[] = {{"samples", o->samples, 2, most_samples(study->mechanism)},
                {"threads", o->threads, 1, MOST_THREADS},
                {"repeats", o->repeats, 1, MOST_REPEATS}};
  for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
    if (counts[k].value < counts[k].least || counts[k].value > counts[k].most) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "study options: %s is %d, must be %d to %d",
                         counts[k].name, (int)counts[k].value, counts[k].least, counts[k].most);
    }
  }
  const char *const times[2] = {"entry_limit", "time_budget"};
  const double time[2] = {o->entry_limit, o->time_budget};
  for (int k = 0; k < 2; k++) {
    if (!(time[k] > 0.0)) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "study options: %s is %g s, must be > 0", times[k],
                         time[k]);
    }
  }
  if (o->file && o->file[0] == '\0') {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "study options: file is empty; use NULL for no file");
  }
  return BAUM_OK;
}

static baum_status refuse_change(const char *call, const char *what)
{
  return baum_i_fail(BAUM_ERR_STATE,
                     "%s: entries have been run, so %s can no longer change; use a new study", call,
                     what);
}

static bool same_file(const char *a, const char *b)
{
  return a && b ? strcmp(a, b) == 0 : a == b;
}

static baum_status check_begun(const baum_study *study, const baum_study_options *o)
{
  const baum_study_options *now = &study->options;
  const char *what = o->samples != now->samples                 ? "samples"
                     : o->energy_account != now->energy_account ? "energy_account"
                     : !same_file(o->file, now->file)           ? "file"
                                                                : NULL;
  return study->begun && what ? refuse_change("baum_study_set_options", what) : BAUM_OK;
}

baum_status baum_i_study_check(const baum_study *study, const char *call)
{
  return study ? BAUM_OK : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the study is NULL", call);
}

baum_status baum_i_study_check_idle(const baum_study *study, const char *call)
{
  return study->running ? baum_i_fail(BAUM_ERR_STATE, "%s: baum_study_run() is still running", call)
                        : BAUM_OK;
}

baum_status baum_study_set_options(baum_study *study, const baum_study_options *options)
{
  const char *call = "baum_study_set_options";
  if (!study || !options) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: study or options are NULL", call);
  }
  baum_study_options o = baum_study_options_default();
  BAUM_I_TRY(baum_i_take_sized(&o, sizeof o, options, call, "", "the default"));
  BAUM_I_TRY(check_options(study, &o));
  BAUM_I_TRY(baum_i_study_check_idle(study, call));
  BAUM_I_TRY(check_begun(study, &o));
  char *file = o.file ? baum_i_copy_text(o.file) : NULL;
  if (o.file && !file) {
    return baum_i_fail_memory();
  }
  baum_i_free(study->options.file);
  study->options = o;
  study->options.file = file;
  return BAUM_OK;
}

baum_status baum_study_settings(const baum_study *study, double *t0, double *t1,
                                baum_study_options *options, size_t caller_size)
{
  if (!study || (options && !baum_i_takes_sized(options, caller_size))) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "baum_study_settings: the study is NULL or the size is 0");
  }
  if (t0) {
    *t0 = study->t0;
  }
  if (t1) {
    *t1 = study->t1;
  }
  if (options) {
    baum_i_give_sized(options, caller_size, &study->options, sizeof study->options);
  }
  return BAUM_OK;
}

/* ---- definition of the error ---- */

baum_status baum_study_set_error(baum_study *study, const baum_channel *channels, int32_t count,
                                 double unit)
{
  const char *call = "baum_study_set_error";
  if (!study || !channels || count < 1) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: study or channels are NULL, or count is below 1",
                       call);
  }
  if (!(isfinite(unit) && unit > 0.0)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: unit is %g, must be finite and > 0", call, unit);
  }
  int width = 0;
  BAUM_I_TRY(baum_i_check_channels(study->mechanism, channels, count, &width));
  if (study->begun) {
    return refuse_change(call, "the definition of the error");
  }
  baum_channel *copy = baum_i_alloc((size_t)count, sizeof *copy);
  BAUM_I_TRY(baum_i_check_memory(copy));
  for (int32_t k = 0; k < count; k++) {
    copy[k] = baum_i_channel(channels, k);
  }
  baum_i_free(study->channels);
  study->channels = copy;
  study->channel_count = count;
  study->unit = unit;
  describe_error(study);
  return BAUM_OK;
}

const char *baum_study_error_text(const baum_study *study)
{
  return study ? study->error_text : NULL;
}

/* ---- the reference ---- */

static baum_status check_digits(const char *call, double digits)
{
  if (!(isfinite(digits) && digits > 0.0)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: digits is %g, must be finite and > 0", call, digits);
  }
  return BAUM_OK;
}

static baum_status check_sample_times(const baum_study *study, const double *times, int32_t n)
{
  double direction = study->t1 > study->t0 ? 1.0 : -1.0;
  double last = study->t0;
  for (int k = 0; k < n; k++) {
    if (!(direction * (times[k] - last) > 0.0) || !(direction * (study->t1 - times[k]) >= 0.0)) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "baum_study_set_reference: times[%d] is %.9g s, and the time before it is "
                         "%.9g s; times must be monotonic after t0 = %g s, up to t1 = %g s",
                         k, times[k], last, study->t0, study->t1);
    }
    last = times[k];
  }
  return BAUM_OK;
}

/* Copies the samples that a caller gives as the reference. Returns false when out of memory. */
static bool copy_given(const baum_study *study, const double *times, int32_t n,
                       const double *const given[3], baum_i_study_reference *out)
{
  const baum_mechanism *m = study->mechanism;
  const int widths[3] = {m->nq, m->nv, m->nc};
  out->samples.times = baum_i_copy(times, (size_t)n, sizeof *times);
  bool fine = out->samples.times != NULL;
  for (int k = 0; k < 3 && fine; k++) {
    if (given[k]) {
      size_t count = (size_t)n * (size_t)widths[k];
      out->given[k] =
        count > 0 ? baum_i_copy(given[k], count, sizeof(double)) : baum_i_alloc(1, sizeof(double));
      fine = out->given[k] != NULL;
    }
  }
  return fine;
}

static void put_reference(baum_study *study, const baum_i_study_reference *reference)
{
  baum_i_study_clear_reference(study);
  study->reference = *reference;
  study->reference.out.digits = (double)NAN;
}

baum_status baum_study_set_reference(baum_study *study, const double *times, int32_t n,
                                     const double *q, const double *v, const double *lambda,
                                     double digits)
{
  const char *call = "baum_study_set_reference";
  if (!study || !times || !q || n < 1) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: study, times or q are NULL, or n is below 1", call);
  }
  BAUM_I_TRY(check_digits(call, digits));
  BAUM_I_TRY(check_sample_times(study, times, n));
  if (study->begun) {
    return refuse_change(call, "the reference");
  }
  baum_i_study_reference r = {
    .samples = {.n = n}, .digits = digits, .out = {.origin = BAUM_STUDY_GIVEN}};
  r.out.samples = n;
  const double *const given[3] = {q, v, lambda};
  if (!copy_given(study, times, n, given, &r)) {
    baum_i_free(r.samples.times);
    for (int k = 0; k < 3; k++) {
      baum_i_free(r.given[k]);
    }
    return baum_i_fail_memory();
  }
  put_reference(study, &r);
  return BAUM_OK;
}

baum_status baum_study_set_solution(baum_study *study, baum_study_solution_fn *solution, void *user,
                                    double digits)
{
  const char *call = "baum_study_set_solution";
  if (!study || !solution) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: study or solution are NULL", call);
  }
  BAUM_I_TRY(check_digits(call, digits));
  if (study->begun) {
    return refuse_change(call, "the reference");
  }
  const baum_i_study_reference r = {
    .solution = solution, .user = user, .digits = digits, .out = {.origin = BAUM_STUDY_SOLUTION}};
  put_reference(study, &r);
  return BAUM_OK;
}

baum_status baum_study_reference_read(const baum_study *study, baum_study_reference *out,
                                      size_t caller_size)
{
  const char *call = "baum_study_reference_read";
  BAUM_I_TRY(baum_i_study_check(study, call));
  BAUM_I_TRY(baum_i_check_sized(out, caller_size, call));
  baum_study_reference whole = study->reference.out;
  whole.text = study->reference.text;
  if (!study->reference.known) {
    whole.uncertainty = whole.uncertainty_q = whole.uncertainty_v = (double)NAN;
    whole.uncertainty_lambda = whole.uncertainty_energy = whole.digits = (double)NAN;
  }
  baum_i_give_sized(out, caller_size, &whole, sizeof whole);
  return BAUM_OK;
}

static void give(double *to, const double *from, int count)
{
  if (to) {
    memcpy(to, from, (size_t)count * sizeof *to);
  }
}

baum_status baum_study_reference_sample(const baum_study *study, int32_t k, double *t, double *q,
                                        double *v, double *lambda)
{
  const char *call = "baum_study_reference_sample";
  BAUM_I_TRY(baum_i_study_check(study, call));
  const baum_i_samples *r = &study->reference.samples;
  if (!r->values) {
    return baum_i_fail(BAUM_ERR_STATE, "%s: the reference has not been computed", call);
  }
  if (k < 0 || k >= r->n) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: k is %d, must be 0 to %d", call, (int)k, r->n - 1);
  }
  baum_i_layout l = baum_i_study_layout(study);
  const double *values = r->values + (size_t)k * l.width;
  give(t, &r->times[k], 1);
  give(q, values, l.nq);
  give(v, values + l.v, l.nv);
  give(lambda, values + l.lambda, l.nc);
  return BAUM_OK;
}
