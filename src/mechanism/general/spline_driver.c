/* SPDX-License-Identifier: BSD-3-Clause */
/* Driver along a cubic spline: GSL's, natural (s'' = 0 at both ends) or periodic. On the interval
 * from t_i to t_i+1 with d = t - t_i
 *
 *   s = y_i + b_i d + c_i d^2 + D_i d^3
 *
 * The natural one goes on with its end slopes, so that s'' stays continuous.
 *
 * GSL's error handler ends the program; it is never reached: the definition is checked before, and
 * only functions that return codes are called. What GSL allocates is tried beforehand.
 */
#include <baum/spline.h>

#if BAUM_HAVE_GSL

#include <math.h>
#include <stddef.h>
#include <string.h>

#include <gsl/gsl_interp.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/general/driven.h"
#include "mechanism/general/user_function.h"

/* Fewer leave a natural spline a line, and GSL no periodic one. */
enum { COUNT_MIN = 3 };

/* A motion that is closed but for rounding. */
static const double SAME_VALUE = 1e-12;

static const baum_spline_driver_def defaults = {.struct_size = sizeof(baum_spline_driver_def)};

/* ---- definition ---- */

static baum_status check_given(const baum_spline_driver_def *def, const char *label)
{
  if (def->count < COUNT_MIN) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: count is %d, must be at least %d", label,
                       (int)def->count, (int)COUNT_MIN);
  }
  baum_status status = baum_i_check_given(label, "times", def->times != NULL);
  return status == BAUM_OK ? baum_i_check_given(label, "values", def->values != NULL) : status;
}

/* Both numbers, and the slope from the place before. */
static baum_status check_place(const baum_spline_driver_def *def, int32_t k, const char *label)
{
  const double *t = def->times + k;
  const double *s = def->values + k;
  if (!isfinite(*t) || !isfinite(*s)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: times[%d] is %g s and values[%d] %g, must be finite",
                       label, (int)k, *t, (int)k, *s);
  }
  if (k > 0 && !(t[0] > t[-1])) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: times[%d] is %.9g s after %.9g s, must be later",
                       label, (int)k, t[0], t[-1]);
  }
  if (k > 0 && !isfinite((s[0] - s[-1]) / (t[0] - t[-1]))) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the slope between places %d and %d is not finite",
                       label, (int)k - 1, (int)k);
  }
  return BAUM_OK;
}

static baum_status check_closed(const baum_spline_driver_def *def, const char *label)
{
  double first = def->values[0];
  double last = def->values[def->count - 1];
  double largest = 0.0;
  for (int32_t k = 0; k < def->count; k++) {
    largest = fmax(largest, fabs(def->values[k]));
  }
  if (fabs(last - first) <= SAME_VALUE * largest) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: values[%d] is %.9g, must be values[0], %.9g, of a periodic spline", label,
                     (int)def->count - 1, last, first);
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_spline_driver_def *def = given;
  baum_status status = baum_i_driver_check(mechanism, def, label);
  if (status == BAUM_OK) {
    status = check_given(def, label);
  }
  for (int32_t k = 0; k < def->count && status == BAUM_OK; k++) {
    status = check_place(def, k, label);
  }
  return status == BAUM_OK && def->periodic ? check_closed(def, label) : status;
}

/* ---- what a copy owns ---- */

/* The copy's times and values point to the numbers, one after the other. */
typedef struct curve {
  gsl_interp *spline;
  double numbers[];
} curve;

static curve *curve_of(const baum_spline_driver_def *def)
{
  char *numbers = baum_i_mutable(def->times);
  return (curve *)(void *)(numbers - offsetof(curve, numbers));
}

/* Somewhat more than GSL takes: four vectors to keep and five to find them. */
static bool memory_suffices(size_t count)
{
  double *block = baum_i_alloc(12 * count + 64, sizeof *block);
  baum_i_free(block);
  return block != NULL;
}

/* NULL when out of memory. */
static gsl_interp *make_spline(const double *times, const double *values, size_t count,
                               bool periodic)
{
  if (!memory_suffices(count)) {
    return NULL;
  }
  gsl_interp *spline =
    gsl_interp_alloc(periodic ? gsl_interp_cspline_periodic : gsl_interp_cspline, count);
  if (spline && gsl_interp_init(spline, times, values, count) != 0) {
    gsl_interp_free(spline);
    return NULL;
  }
  return spline;
}

static baum_status own(void *copy)
{
  baum_spline_driver_def *def = copy;
  size_t count = (size_t)def->count;
  curve *c = baum_i_alloc(1, sizeof *c + 2 * count * sizeof *c->numbers);
  if (!c) {
    return BAUM_ERR_MEMORY;
  }
  double *times = c->numbers;
  double *values = c->numbers + count;
  memcpy(times, def->times, count * sizeof *times);
  memcpy(values, def->values, count * sizeof *values);
  c->spline = make_spline(times, values, count, def->periodic);
  if (!c->spline) {
    baum_i_free(c);
    return BAUM_ERR_MEMORY;
  }
  def->times = times;
  def->values = values;
  return BAUM_OK;
}

static void digest(const void *given, baum_i_digest *sum)
{
  const baum_spline_driver_def *def = given;
  size_t bytes = (size_t)def->count * sizeof(double);
  baum_i_digest_add_integer(sum, def->count);
  baum_i_digest_add_integer(sum, def->periodic);
  baum_i_digest_add(sum, def->times, bytes);
  baum_i_digest_add(sum, def->values, bytes);
}

static void release(void *copy)
{
  baum_spline_driver_def *def = copy;
  curve *c = curve_of(def);
  gsl_interp_free(c->spline);
  baum_i_free(c);
  def->times = NULL;
  def->values = NULL;
}

/* ---- motion ---- */

/* The time between the first and the last that t stands for. */
static double time_within(const baum_spline_driver_def *def, double t)
{
  double first = def->times[0];
  double last = def->times[def->count - 1];
  if (def->periodic) {
    double period = last - first;
    t -= period * floor((t - first) / period);
  }
  return fmin(fmax(t, first), last);
}

/* GSL's functions set NaN where they fail, which is looked for. */
static baum_status motion(const baum_i_joint *driver, baum_i_point *point, double s[3])
{
  const baum_spline_driver_def *def = driver->element.def;
  const gsl_interp *spline = curve_of(def)->spline;
  double t = time_within(def, point->t);
  (void)gsl_interp_eval_e(spline, def->times, def->values, t, NULL, &s[0]);
  (void)gsl_interp_eval_deriv_e(spline, def->times, def->values, t, NULL, &s[1]);
  (void)gsl_interp_eval_deriv2_e(spline, def->times, def->values, t, NULL, &s[2]);
  if (!def->periodic && t != point->t) {
    s[0] += s[1] * (point->t - t);
    s[2] = 0.0;
  }
  return baum_i_check_motion(driver, point, "the spline", s);
}

/* ---- type ---- */

static baum_status evaluate(const baum_i_joint_group *group, baum_i_point *point,
                            const baum_i_rows *out)
{
  return baum_i_driver_evaluate(group, point, motion, out);
}

static const baum_i_joint_type type = {
  .definition = {.kind = "spline driver",
                 .size = sizeof(baum_spline_driver_def),
                 .defaults = &defaults,
                 .check = check,
                 .own = own,
                 .release = release,
                 .tied = baum_i_driver_tied,
                 .digest = digest},
  .parameter_count = BAUM_I_DRIVER_NUMBERS, /* all zero at first */
  .planar = true,
  .scleronomic = false,
  .drives = true,
  .replace_law = baum_i_driver_replace_law,
  .row_count = 1,
  .bodies = baum_i_driver_bodies,
  .evaluate = evaluate,
  .linearize = baum_i_driver_linearize,
  .place = baum_i_driver_place,
};

BAUM_I_DEFINE(joint, spline_driver, type)

#endif
