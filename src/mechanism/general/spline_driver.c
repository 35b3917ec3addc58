/* SPDX-License-Identifier: BSD-3-Clause */
/* A driver whose law is a cubic spline, either natural or periodic. Before the first and after the
 * last given time, a natural spline continues with the slope that it has at this time. The
 * acceleration s'' is then continuous. */
#include <baum/spline.h>

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/cubic_spline.h"
#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/general/driven.h"
#include "mechanism/general/user_function.h"

/* With fewer points, a natural spline would be a straight line, and a periodic spline would be
 * constant. */
enum { COUNT_MIN = 3 };

/* The first and the last value of a periodic spline are considered equal if their relative
 * difference is at most this. */
static const double SAME_VALUE = 1e-12;

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_spline_driver_def, joint, JOINT),
  BAUM_I_ARRAY(baum_spline_driver_def, times, OWN_ARRAY, FINITE, count, count),
  BAUM_I_ARRAY(baum_spline_driver_def, values, OWN_ARRAY, FINITE, count, count),
  BAUM_I_FIELD(baum_spline_driver_def, count, OWN_COUNT),
  BAUM_I_FIELD(baum_spline_driver_def, periodic, FLAG),
  BAUM_I_FIELD(baum_spline_driver_def, coordinate, COORDINATE),
  {0},
};

/* ---- definition ---- */

static baum_status check_given(const baum_spline_driver_def *def, const char *label)
{
  if (def->count < COUNT_MIN) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: count is %d, must be at least %d", label,
                       (int)def->count, (int)COUNT_MIN);
  }
  BAUM_I_TRY(baum_i_check_given(label, "times", def->times != NULL));
  return baum_i_check_given(label, "values", def->values != NULL);
}

/* Check point k: its time, its value, and the slope of the line from the previous point. */
static baum_status check_knot(const baum_spline_driver_def *def, int32_t k, const char *label)
{
  const double *t = def->times + k;
  const double *s = def->values + k;
  if (!isfinite(*t) || !isfinite(*s)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: times[%d] is %g s and values[%d] %g, must be finite",
                       label, (int)k, *t, (int)k, *s);
  }
  if (k > 0 && !(t[0] > t[-1])) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: times[%d] is %.9g s, must be later than the time before it, %.9g s",
                       label, (int)k, t[0], t[-1]);
  }
  if (k > 0 && !isfinite((s[0] - s[-1]) / (t[0] - t[-1]))) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the slope between points %d and %d is not finite",
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
  return baum_i_fail(
    BAUM_ERR_ARGUMENT,
    "%s: values[%d] is %.9g, must equal values[0], %.9g, because the spline is periodic", label,
    (int)def->count - 1, last, first);
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_spline_driver_def *def = given;
  BAUM_I_TRY(
    baum_i_check_coordinate(mechanism, def->joint, def->coordinate, label, &baum_i_driver_fields));
  BAUM_I_TRY(check_given(def, label));
  for (int32_t k = 0; k < def->count; k++) {
    BAUM_I_TRY(check_knot(def, k, label));
  }
  return def->periodic ? check_closed(def, label) : BAUM_OK;
}

static baum_i_joint_coordinate driven(const baum_mechanism *mechanism, const void *given)
{
  const baum_spline_driver_def *def = given;
  return baum_i_joint_coordinate_of(mechanism, def->joint, def->coordinate);
}

/* ---- memory of an element's copy ---- */

/* The memory that an element owns. `numbers` contains the times, values and second derivatives of
 * the spline. */
typedef struct curve {
  baum_i_cubic_spline spline;
  double numbers[];
} curve;

static curve *curve_of(const baum_spline_driver_def *def)
{
  char *numbers = baum_i_mutable(def->times);
  return (curve *)(void *)(numbers - offsetof(curve, numbers));
}

static baum_status own(void *copy)
{
  baum_spline_driver_def *def = copy;
  size_t count = (size_t)def->count;
  curve *c = baum_i_alloc(1, sizeof *c + 3 * count * sizeof *c->numbers);
  if (!c) {
    return BAUM_ERR_MEMORY;
  }
  double *values = c->numbers + count;
  memcpy(c->numbers, def->times, count * sizeof *values);
  memcpy(values, def->values, count * sizeof *values);
  c->spline = (baum_i_cubic_spline){def->count, c->numbers, values, values + count};
  baum_status status = baum_i_cubic_spline_fit(&c->spline, def->periodic);
  if (status != BAUM_OK) {
    baum_i_free(c);
    return status;
  }
  def->times = c->numbers;
  def->values = values;
  return BAUM_OK;
}

static void release(void *copy)
{
  baum_spline_driver_def *def = copy;
  baum_i_free(curve_of(def));
  def->times = NULL;
  def->values = NULL;
}

/* ---- motion ---- */

/* Return the time at which the spline must be evaluated for the time t. It lies within the range of
 * the spline. */
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

static baum_status motion(const baum_i_joint *driver, baum_i_point *point, double s[3])
{
  const baum_spline_driver_def *def = driver->element.def;
  double t = time_within(def, point->t);
  baum_i_cubic_spline_evaluate(&curve_of(def)->spline, t, s);
  if (!def->periodic && t != point->t) {
    s[0] += s[1] * (point->t - t);
    s[2] = 0.0;
  }
  return baum_i_check_motion(driver, point, "the spline", s);
}

/* ---- type ---- */

static const baum_i_joint_type type = {
  .definition = {BAUM_I_DEFINITION(spline_driver, "spline driver", fields), .check = check,
                 .own = own, .release = release,
                 /* These parameters are all zero. BAUM_I_DRIVER_POLYNOMIAL is therefore 0, and
                  * the driver uses motion(). */
                 .parameter_count = BAUM_I_DRIVER_NUMBERS},
  BAUM_I_DRIVER_MEMBERS(driven, motion),
};

BAUM_I_DEFINE(joint, spline_driver, type)
