/* SPDX-License-Identifier: BSD-3-Clause */
/* This file answers three questions about the results of a study: which entries are on the Pareto
 * front, what an error costs, and which setting is recommended.
 *
 * Between two entries of a method, the logarithms of error and cost are interpolated linearly over
 * the logarithm of the step or of rtol. A recommendation for the error E requires
 *
 *   error_validated x margin <= E
 *
 * both for an entry and for the next finer entry. An entry whose error is small only by accident is
 * thus not sufficient. The margin is the factor by which the error of the method decreases when its
 * work increases by the factor MORE_WORK, but it is limited to the range MARGINS. If no entry
 * satisfies this condition, only error <= E is required of both entries. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "base/text.h"
#include "integrate/integrator.h"
#include "study/study.h"

/* A margin is the factor by which the error decreases when the work increases by this factor. */
static const double MORE_WORK = 1.15;
static const double MARGINS[2] = {2.0, 4.0}; /* the smallest and the largest margin */
static const double SPEED_MARGIN = 1.25;     /* margin on CPU times, which vary between runs */

/* ---- front ---- */

static double cost_of(const baum_i_entry *entry, baum_study_cost cost)
{
  return cost == BAUM_STUDY_CPU ? entry->out.cpu : entry->out.work;
}

/* Tells whether another entry dominates this entry: neither its error nor its cost is larger, and
 * at least one of the two is smaller. If two entries have the same error and the same cost, the
 * first dominates the second. */
static bool is_beaten(const baum_study *study, int k, baum_study_cost cost)
{
  const baum_i_entry *entry = study->entries[k];
  double c = cost_of(entry, cost);
  double e = entry->out.error;
  for (int i = 0; i < study->entry_count; i++) {
    const baum_i_entry *other = study->entries[i];
    double oc = cost_of(other, cost);
    double oe = other->out.error;
    if (i != k && baum_i_study_is_answer(other) && oc <= c && oe <= e &&
        (oc < c || oe < e || i < k)) {
      return true;
    }
  }
  return false;
}

static baum_status check_cost(const baum_study *study, baum_study_cost cost, const char *call)
{
  BAUM_I_TRY(baum_i_study_check(study, call));
  if (cost != BAUM_STUDY_WORK && cost != BAUM_STUDY_CPU) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: cost is %d, must be one of baum_study_cost", call,
                       (int)cost);
  }
  return BAUM_OK;
}

/* A list of at most `capacity` entries, sorted from cheap to expensive. */
typedef struct list {
  int32_t *entries;
  int capacity;
  int count; /* number of entries found, which may be larger than the capacity */
} list;

/* Inserts an entry before all more expensive entries. The list drops entries beyond its
 * capacity. */
static void insert(const baum_study *study, list *l, int k, baum_study_cost cost)
{
  double c = cost_of(study->entries[k], cost);
  int at = l->count < l->capacity ? l->count : l->capacity;
  for (; at > 0 && cost_of(study->entries[l->entries[at - 1]], cost) > c; at--) {
    if (at < l->capacity) {
      l->entries[at] = l->entries[at - 1];
    }
  }
  if (at < l->capacity) {
    l->entries[at] = k;
  }
  l->count++;
}

baum_status baum_study_front(const baum_study *study, baum_study_cost cost, int32_t capacity,
                             /* NOLINTNEXTLINE(readability-non-const-parameter): the list writes to
                              * it. */
                             int32_t *entries, int32_t *count)
{
  const char *call = "baum_study_front";
  BAUM_I_TRY(check_cost(study, cost, call));
  if (!count || capacity < 0 || (capacity > 0 && !entries)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: count or entries are NULL, or capacity is negative",
                       call);
  }
  list found = {.entries = entries, .capacity = capacity};
  for (int k = 0; k < study->entry_count; k++) {
    if (baum_i_study_is_answer(study->entries[k]) && !is_beaten(study, k, cost)) {
      insert(study, &found, k, cost);
    }
  }
  *count = found.count;
  return BAUM_OK;
}

/* ---- interpolated settings ---- */

/* A setting between two entries of a method, or the setting of one entry if `coarse` equals
 * `fine`. */
typedef struct setting {
  const baum_i_entry *coarse;
  const baum_i_entry *fine;
  double share;  /* position between coarse (0) and fine (1), in logarithms */
  double margin; /* margin for other starts and spans; 1 if there is none */
} setting;

static double between(double a, double b, double share)
{
  return share <= 0.0 ? a : a * pow(b / a, share);
}

static double setting_cost(const setting *p, baum_study_cost cost)
{
  return between(cost_of(p->coarse, cost), cost_of(p->fine, cost), p->share);
}

static double setting_error(const setting *p)
{
  return between(p->coarse->out.error, p->fine->out.error, p->share);
}

/* Returns the position between two entries (see setting.share) at which a quantity has the value
 * `wanted`. `coarse` and `fine` are the values of this quantity at the two entries. */
static double share_at(double coarse, double fine, double wanted)
{
  return coarse == fine ? 1.0 : log(coarse / wanted) / log(coarse / fine);
}

/* ---- cost at an error ---- */

/* Finds the setting of a method at which the error has the given value, by linear interpolation of
 * logarithms. Before the first entry, extrapolates by at most the distance between the first two
 * entries. After the last entry, extrapolates by at most the distance between the last two. */
static bool find_error(const baum_i_entry *const *entries, int count, double error, setting *out)
{
  for (int k = 0; k + 1 < count; k++) {
    double e[2] = {entries[k]->out.error, entries[k + 1]->out.error};
    double share = share_at(e[0], e[1], error);
    bool first = k == 0;
    bool last = k + 2 == count;
    if (e[1] < e[0] && share >= (first ? -1.0 : 0.0) && share <= (last ? 2.0 : 1.0)) {
      *out = (setting){entries[k], entries[k + 1], share, 1.0};
      return true;
    }
  }
  return false;
}

/* A request for the cost at a given error. */
typedef struct cost_query {
  const baum_study *study;
  double error;
  baum_study_cost cost;
  const char *call;
} cost_query;

static baum_status check_error(double error, const char *call)
{
  return error > 0.0 && isfinite(error)
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: error is %g, must be finite and > 0", call, error);
}

static baum_status check_query(const cost_query *at, const double *out, const char *name)
{
  BAUM_I_TRY(check_cost(at->study, at->cost, at->call));
  if (!out) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is NULL", at->call, name);
  }
  return check_error(at->error, at->call);
}

static baum_status find_cost(const cost_query *at, int32_t method, double *out)
{
  const baum_study *study = at->study;
  if (method < 0 || method >= study->method_count) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: there is no method %d; the study has %d methods",
                       at->call, (int)method, study->method_count);
  }
  const baum_i_entry *entries[BAUM_I_METHOD_ENTRIES];
  int count = baum_i_study_usable(study, method, entries);
  setting p;
  if (!find_error(entries, count, at->error, &p)) {
    double least = (double)INFINITY;
    double most = 0.0;
    for (int k = 0; k < count; k++) {
      least = fmin(least, entries[k]->out.error);
      most = fmax(most, entries[k]->out.error);
    }
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: %s has been measured with errors from %.2g to %.2g, but not near %.2g",
                       at->call, study->methods[method].name.text, least, most, at->error);
  }
  double a = cost_of(p.coarse, at->cost);
  *out = a * pow(cost_of(p.fine, at->cost) / a, p.share);
  return BAUM_OK;
}

baum_status baum_study_cost_at(const baum_study *study, int32_t method, double error,
                               baum_study_cost cost, double *out)
{
  const cost_query at = {study, error, cost, "baum_study_cost_at"};
  BAUM_I_TRY(check_query(&at, out, "out"));
  return find_cost(&at, method, out);
}

baum_status baum_study_compare(const baum_study *study, int32_t a, int32_t b, double error,
                               baum_study_cost cost, double *ratio)
{
  const cost_query at = {study, error, cost, "baum_study_compare"};
  double costs[2] = {(double)NAN, (double)NAN};
  BAUM_I_TRY(check_query(&at, ratio, "ratio"));
  BAUM_I_TRY(find_cost(&at, a, &costs[0]));
  BAUM_I_TRY(find_cost(&at, b, &costs[1]));
  *ratio = costs[0] / costs[1];
  return BAUM_OK;
}

/* ---- recommendation ---- */

/* Returns the error that is expected of an entry. Without margin, this is the measured error. With
 * margin, it is the validated error, that is, the largest error over twice the span and for
 * perturbed starts. If this is not known, it is estimated as the measured error times the ratio of
 * the validated error to the measured error of `beside`, a neighbouring entry of the method. */
static double expected(const baum_i_entry *entry, const baum_i_entry *beside, bool with_margin)
{
  if (!with_margin) {
    return entry->out.error;
  }
  double validated = entry->out.error_validated;
  if (isnan(validated)) {
    validated = entry->out.error * beside->out.error_validated / beside->out.error;
  }
  return isnan(validated) ? (double)INFINITY : validated;
}

/* Returns the margin at an entry, which is the factor by which the error of the method decreases
 * near this entry when the work increases by the factor MORE_WORK. The margin is larger for methods
 * of higher order. */
static double margin_at(const baum_i_entry *const *entries, int count, int k)
{
  int fine = k > 0 || count == 1 ? k : 1;
  int coarse = fine > 0 ? fine - 1 : 0;
  double errors = entries[coarse]->out.error / entries[fine]->out.error;
  double works = entries[fine]->out.work / entries[coarse]->out.work;
  double power = works > 1.0 && errors > 1.0 ? log(errors) / log(works) : 0.0;
  return fmin(fmax(pow(MORE_WORK, power), MARGINS[0]), MARGINS[1]);
}

/* Finds the coarsest setting of a method at which two expected errors are at most the given error
 * divided by the margin: the error of the setting, and the error of the next finer entry.
 */
static bool find_setting(const baum_i_entry *const *entries, int count, double error,
                         bool with_margin, setting *out)
{
  for (int k = 0; k < count; k++) {
    double margin = with_margin ? margin_at(entries, count, k) : 1.0;
    double wanted = error / margin;
    double here = expected(entries[k], entries[k], with_margin);
    bool next = k + 1 == count || expected(entries[k + 1], entries[k], with_margin) <= wanted;
    if (here > wanted || !next) {
      continue;
    }
    *out = (setting){entries[k], entries[k], 0.0, margin};
    double before = k > 0 ? expected(entries[k - 1], entries[k], with_margin) : 0.0;
    if (before > wanted && isfinite(before)) {
      *out = (setting){entries[k - 1], entries[k], share_at(before, here, wanted), margin};
    }
    return true;
  }
  return false;
}

/* The requirements on a recommended setting. */
typedef struct question {
  double error;
  baum_study_cost cost;
  bool with_margin;
  const baum_integrator *without; /* an integrator that must not be recommended, or NULL */
} question;

/* Finds the cheapest setting of all methods that meets the requirements. Returns false if there is
 * none. */
static bool find_best(const baum_study *study, const question *q, setting *best)
{
  *best = (setting){.coarse = NULL};
  for (int m = 0; m < study->method_count; m++) {
    const baum_i_entry *entries[BAUM_I_METHOD_ENTRIES];
    int count = baum_i_study_usable(study, m, entries);
    setting p;
    if (count == 0 || entries[0]->out.unstable || entries[0]->options.integrator == q->without) {
      continue;
    }
    if (find_setting(entries, count, q->error, q->with_margin, &p) &&
        (!best->fine || setting_cost(&p, q->cost) < setting_cost(best, q->cost))) {
      *best = p;
    }
  }
  return best->fine != NULL;
}

/* Rounds rtol down to two digits, or a step down to a step that divides the span. */
static double rounded(const baum_study *study, double value, bool fixed)
{
  if (fixed) {
    double span = fabs(study->t1 - study->t0);
    return span / ceil(span / value - 1e-9);
  }
  double unit = pow(10.0, floor(log10(value)) - 1.0);
  return unit * floor(value / unit + 1e-9);
}

static baum_simulation_options options_of(const baum_study *study, const setting *p)
{
  baum_simulation_options o = p->fine->options;
  if (p->share < 1.0 && p->coarse != p->fine) {
    bool fixed = !isnan(o.step);
    double value =
      between(baum_i_setting(&p->coarse->options), baum_i_setting(&p->fine->options), p->share);
    *(fixed ? &o.step : &o.rtol) = rounded(study, value, fixed);
  }
  return o;
}

/* Appends the next best integrator and its relative cost to the text. */
static void add_rival(const baum_study *study, const setting *best, question q, char *why,
                      size_t size)
{
  setting rival;
  q.without = best->fine->options.integrator;
  if (find_best(study, &q, &rival)) {
    double ratio = setting_cost(&rival, q.cost) / setting_cost(best, q.cost);
    const char *name = study->methods[rival.fine->out.method].name.text;
    baum_i_append(why, size, "; the next best integrator, %s, costs ", name);
    if (ratio >= 1.05) {
      baum_i_append(why, size, "%.2g times ", ratio);
    }
    baum_i_append(why, size, "as much");
  }
}

static void explain(const setting *p, const baum_simulation_options *o, char *why, size_t size)
{
  why[0] = '\0';
  baum_i_append(why, size, "%s: error %.2g for a work of %.0f and %.3g ms",
                baum_i_options_name(o).text, setting_error(p), setting_cost(p, BAUM_STUDY_WORK),
                1e3 * setting_cost(p, BAUM_STUDY_CPU));
  if (p->coarse == p->fine) {
    baum_i_append(why, size, ", as measured");
    return;
  }
  bool fixed = !isnan(o->step);
  const char *unit = fixed ? " s" : "";
  baum_i_append(why, size, ", between %s %.3g%s (error %.2g) and %.3g%s (error %.2g)",
                fixed ? "step" : "rtol", baum_i_setting(&p->coarse->options), unit,
                p->coarse->out.error, baum_i_setting(&p->fine->options), unit, p->fine->out.error);
}

static void add_margin(const baum_study *study, const setting *p, const question *q, char *why,
                       size_t size)
{
  if (!q->with_margin) {
    baum_i_append(why, size, "; no margin remains for other starts or a longer span");
    return;
  }
  baum_i_append(
    why, size,
    "; over twice the span, and from nearby starts, %s has an error of %.2g, which leaves a "
    "margin of a factor of %.2g",
    p->coarse == p->fine ? "it" : "the finer of these", p->fine->out.error_validated, p->margin);
  add_rival(study, p, *q, why, size);
}

/* Warns if the recommended formulation has no stabilization. This formulation may be the cheapest
 * one within the span of the study, but its constraint violation grows with time. */
static void add_drift(const baum_simulation_options *o, char *why, size_t size)
{
  if (o->formulation == BAUM_FORMULATION_UNSTABILIZED) {
    baum_i_append(why, size,
                  "; constraints are not stabilized: their violation grows with the span");
  }
}

static baum_status deliver(const baum_study *study, const baum_simulation_options *o,
                           baum_simulation_options *best, size_t caller_size)
{
  baum_i_give_sized(best, caller_size, o, sizeof *o);
  return study->reference.out.trusted
           ? BAUM_OK
           : baum_i_fail(BAUM_WARNED, "study: the reference: %s", study->reference.text);
}

static baum_status check_answerable(const baum_study *study, const void *best, size_t caller_size,
                                    const char *call)
{
  if (!study || !baum_i_takes_sized(best, caller_size)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: study or best are NULL, or caller_size is too small",
                       call);
  }
  for (int k = 0; k < study->entry_count; k++) {
    if (study->entries[k]->stage >= BAUM_I_TIMED) {
      return BAUM_OK;
    }
  }
  return baum_i_fail(BAUM_ERR_STATE,
                     "%s: no entry is finished; call baum_study_run(); if it has spent its time "
                     "budget, call it again",
                     call);
}

/* Fails because no finished entry has a known error. */
static baum_status refuse_all(const baum_study *study, const char *call)
{
  if (study->reference.out.trusted) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: none of the finished entries followed the true motion", call);
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: no entry can be judged without a trusted reference: %s", call,
                     study->reference.text);
}

static baum_status refuse_error(const baum_study *study, double error, const char *call)
{
  const baum_i_entry *best = NULL;
  for (int k = 0; k < study->entry_count; k++) {
    const baum_i_entry *entry = study->entries[k];
    if (baum_i_study_is_answer(entry) && (!best || entry->out.error < best->out.error)) {
      best = entry;
    }
  }
  if (!best) {
    return refuse_all(study, call);
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: no entry reaches an error of %.2g; the smallest is %.2g, of %s, and the "
                     "uncertainty of the reference is %.2g",
                     call, error, best->out.error, best->name.text,
                     study->reference.out.uncertainty);
}

baum_status baum_study_recommend(const baum_study *study, double error, baum_study_cost cost,
                                 baum_simulation_options *best, size_t caller_size, char *why,
                                 size_t size)
{
  const char *call = "baum_study_recommend";
  BAUM_I_TRY(check_cost(study, cost, call));
  BAUM_I_TRY(check_answerable(study, best, caller_size, call));
  BAUM_I_TRY(check_error(error, call));
  setting p;
  question q = {.error = error, .cost = cost, .with_margin = true};
  bool found = find_best(study, &q, &p);
  if (!found) {
    q.with_margin = false;
    found = find_best(study, &q, &p);
  }
  if (!found) {
    return refuse_error(study, error, call);
  }
  baum_simulation_options o = options_of(study, &p);
  if (why && size > 0) {
    explain(&p, &o, why, size);
    add_margin(study, &p, &q, why, size);
    add_drift(&o, why, size);
  }
  return deliver(study, &o, best, caller_size);
}

/* Tells whether a setting is more accurate than another one, or equally accurate and faster. */
static bool beats(const setting *p, const setting *other)
{
  if (!other->fine) {
    return true;
  }
  double e[2] = {setting_error(p), setting_error(other)};
  double c[2] = {setting_cost(p, BAUM_STUDY_CPU), setting_cost(other, BAUM_STUDY_CPU)};
  return e[0] < e[1] || (e[0] == e[1] && c[0] < c[1]);
}

/* Finds the most accurate setting of a method that takes at most the given CPU time. */
static void find_affordable(const baum_i_entry *const *entries, int count, double seconds,
                            setting *best)
{
  for (int k = 0; k < count; k++) {
    setting p = {entries[k], entries[k], 0.0, 1.0};
    double here = entries[k]->out.cpu;
    double before = k > 0 ? entries[k - 1]->out.cpu : (double)INFINITY;
    if (here > seconds && before <= seconds && entries[k]->out.error < entries[k - 1]->out.error) {
      p = (setting){entries[k - 1], entries[k], share_at(before, here, seconds), 1.0};
    } else if (here > seconds) {
      continue;
    }
    if (beats(&p, best)) {
      *best = p;
    }
  }
}

/* Finds the most accurate setting of all methods that takes at most the given CPU time. Returns the
 * shortest CPU time among the coarsest entries of the methods. */
static double find_most_exact(const baum_study *study, double seconds, setting *best)
{
  double quickest = (double)INFINITY;
  *best = (setting){.coarse = NULL};
  for (int m = 0; m < study->method_count; m++) {
    const baum_i_entry *entries[BAUM_I_METHOD_ENTRIES];
    int count = baum_i_study_usable(study, m, entries);
    if (count > 0 && !entries[0]->out.unstable) {
      quickest = fmin(quickest, entries[0]->out.cpu);
      find_affordable(entries, count, seconds, best);
    }
  }
  return quickest;
}

baum_status baum_study_recommend_budget(const baum_study *study, double seconds,
                                        baum_simulation_options *best, size_t caller_size,
                                        char *why, size_t size)
{
  const char *call = "baum_study_recommend_budget";
  BAUM_I_TRY(check_answerable(study, best, caller_size, call));
  if (!(isfinite(seconds) && seconds > 0.0)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: seconds is %g s, must be finite and > 0", call,
                       seconds);
  }
  setting p;
  double quickest = find_most_exact(study, seconds / SPEED_MARGIN, &p);
  if (!isfinite(quickest)) {
    return refuse_all(study, call);
  }
  if (!p.fine) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: no entry takes at most 80 %% of %.3g s; the fastest takes %.3g s", call,
                       seconds, quickest);
  }
  baum_simulation_options o = options_of(study, &p);
  if (why && size > 0) {
    explain(&p, &o, why, size);
    baum_i_append(why, size, "; a fifth of the %.3g ms is kept in reserve, because times vary",
                  1e3 * seconds);
    add_drift(&o, why, size);
  }
  return deliver(study, &o, best, caller_size);
}
