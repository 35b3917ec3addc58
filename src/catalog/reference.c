/* SPDX-License-Identifier: BSD-3-Clause */
/* Reference solutions of motions, and the errors of runs relative to them. */
#include "catalog/catalog.h"

#include <math.h>
#include <string.h>

/* A mechanism, its parameters, and its reference solution at one time. */
typedef struct sample {
  const baum_i_catalog_mechanism *of;
  double p[BAUM_I_CATALOG_PARAMETERS];
  double q[BAUM_I_CATALOG_COLUMNS];
  double v[BAUM_I_CATALOG_COLUMNS];
} sample;

/* ---- samples ---- */

static double time_of(const baum_i_catalog_mechanism *of, int k)
{
  return of->t ? of->t[k] : k * of->end / (of->samples - 1);
}

static baum_status check_known(const baum_i_catalog_mechanism *of)
{
  return of->samples > 0 ? BAUM_OK
                         : baum_i_catalog_fail(BAUM_ERR_UNSUPPORTED,
                                               "catalogue: \"%s\" has no reference", of->name);
}

baum_status baum_catalog_times(const char *name, double *times)
{
  const baum_i_catalog_mechanism *of = baum_i_catalog_find(name);
  if (!of) {
    return BAUM_ERR_ARGUMENT;
  }
  if (!times) {
    return baum_fail(BAUM_ERR_ARGUMENT, "baum_catalog_times: times is NULL");
  }
  BAUM_I_CATALOG_TRY(check_known(of));
  for (int k = 0; k < of->samples; k++) {
    times[k] = time_of(of, k);
  }
  return BAUM_OK;
}

/* Checks that the parameters have their default values. Stored samples are valid only for these. */
static baum_status check_parameters(const sample *at)
{
  const baum_i_catalog_mechanism *of = at->of;
  for (int k = 0; !of->solution && k < of->parameter_count; k++) {
    if (at->p[k] != of->defaults[k]) {
      return baum_i_catalog_fail(
        BAUM_ERR_UNSUPPORTED,
        "catalogue: the reference of \"%s\" is known only for %s = %.17g %s, not for %.17g",
        of->name, of->parameters[k].name, of->defaults[k], of->parameters[k].unit, at->p[k]);
    }
  }
  return BAUM_OK;
}

static baum_status resolve(const baum_catalog_choice *choice, sample *at)
{
  BAUM_I_CATALOG_TRY(baum_i_catalog_resolve(choice, &at->of, at->p));
  BAUM_I_CATALOG_TRY(check_known(at->of));
  return check_parameters(at);
}

/* Computes the reference by a formula. Formulas also have rounding errors. If the bound of these
 * errors is large, the formula cannot be used as a reference. */
static baum_status evaluate_formula(sample *at, double t)
{
  const baum_i_catalog_mechanism *of = at->of;
  double off = of->solution(at->p, t, at->q, at->v);
  double wanted = pow(10.0, -fmin(of->digits_q, of->digits_v));
  if (off <= wanted) {
    return BAUM_OK;
  }
  return baum_i_catalog_fail(
    BAUM_ERR_UNSUPPORTED,
    "catalogue: with these parameters the formulas of \"%s\" may be off by "
    "%.1e at t = %g s, so they do not have the stated accuracy of %g digits",
    of->name, off, t, fmin(of->digits_q, of->digits_v));
}

static baum_status find_sample(sample *at, double t)
{
  const baum_i_catalog_mechanism *of = at->of;
  if (!isfinite(t)) {
    return baum_i_catalog_fail(BAUM_ERR_ARGUMENT, "catalogue: t is %g s, must be finite", t);
  }
  if (of->solution) {
    return evaluate_formula(at, t);
  }
  for (int k = 0; k < of->samples; k++) {
    if (of->t[k] == t) {
      size_t first = (size_t)k * (size_t)of->columns;
      memcpy(at->q, of->q + first, (size_t)of->columns * sizeof *of->q);
      memcpy(at->v, of->v + first, (size_t)of->columns * sizeof *of->v);
      return BAUM_OK;
    }
  }
  return baum_i_catalog_fail(BAUM_ERR_ARGUMENT,
                             "catalogue: the reference of \"%s\" has no sample at t = %.17g s; "
                             "baum_catalog_times() returns the times of its samples",
                             of->name, t);
}

static int width(const baum_i_catalog_mechanism *of)
{
  return (int)strlen(of->units);
}

/* Tells whether the mechanism has spatial bodies, which have quaternions ('q'). Such a body has one
 * velocity fewer than positions. */
static bool is_spatial(const baum_i_catalog_mechanism *of)
{
  return strchr(of->units, 'q') != NULL;
}

static int width_v(const baum_i_catalog_mechanism *of)
{
  return width(of) - is_spatial(of);
}

static baum_i_body_state state_of(const sample *at, int body)
{
  if (at->of->state) {
    return at->of->state(at->p, at->q, at->v, body);
  }
  baum_i_body_state out;
  int count = width(at->of);
  memcpy(out.q, at->q + body * count, (size_t)count * sizeof *out.q);
  memcpy(out.v, at->v + body * count, (size_t)count * sizeof *out.v);
  return out;
}

/* Checks that the reference is finite. A formula may have no value, for example if the rod of a
 * driven crank is too short. */
static baum_status check_finite(const sample *at, double t)
{
  for (int body = 0; body < baum_i_catalog_bodies(at->of, at->p); body++) {
    const baum_i_body_state s = state_of(at, body);
    for (int k = 0; k < width(at->of); k++) {
      if (!isfinite(s.q[k]) || (k < width_v(at->of) && !isfinite(s.v[k]))) {
        return baum_i_catalog_fail(BAUM_ERR_UNSUPPORTED,
                                   "catalogue: with these parameters \"%s\" has no reference at "
                                   "t = %g s",
                                   at->of->name, t);
      }
    }
  }
  return BAUM_OK;
}

static baum_status look_up(sample *at, double t)
{
  BAUM_I_CATALOG_TRY(find_sample(at, t));
  return check_finite(at, t);
}

baum_status baum_catalog_reference(const baum_catalog_choice *choice, double t, double *q,
                                   double *v)
{
  sample at;
  BAUM_I_CATALOG_TRY(resolve(choice, &at));
  BAUM_I_CATALOG_TRY(look_up(&at, t));
  int count = width(at.of);
  int count_v = width_v(at.of);
  for (int body = 0; body < baum_i_catalog_bodies(at.of, at.p); body++) {
    const baum_i_body_state s = state_of(&at, body);
    if (q) {
      memcpy(q + body * count, s.q, (size_t)count * sizeof *q);
    }
    if (v) {
      memcpy(v + body * count_v, s.v, (size_t)count_v * sizeof *v);
    }
  }
  return BAUM_OK;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): it is a baum_study_solution_fn. */
int baum_catalog_solution(double t, double *q, double *v, double *lambda, void *user)
{
  (void)lambda;
  return baum_catalog_reference(user, t, q, v) == BAUM_OK ? 0 : -1;
}

/* ---- errors ---- */

/* Each member is the largest value over all coordinates of a state. q and v are the differences
 * from the reference, size_v is the magnitude of the velocities of the reference, and the floors
 * are the uncertainties of the reference. All values are divided by the scales of the
 * coordinates. */
typedef struct measure {
  double q;
  double v;
  double size_v;
  double floor_q;
  double floor_v;
} measure;

/* Returns the larger number, or NaN if either is NaN. */
static double most(double a, double b)
{
  return b > a || isnan(b) ? b : a;
}

/* Finds the displacement of a body between two poses. The displacement of a quaternion is the
 * rotation vector in body axes, to first order. The signs of the quaternions do not matter. */
static void subtract(const baum_i_catalog_mechanism *of, const double *from, const double *to,
                     double d[BAUM_I_BODY_WIDTH])
{
  for (int k = 0; k < width(of); k++) {
    d[k] = to[k] - from[k];
  }
  if (is_spatial(of)) {
    const double *a = from + 3;
    const double *b = to + 3;
    double same = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    for (int i = 0; i < 3; i++) {
      int j = (i + 1) % 3;
      int k = (i + 2) % 3;
      double half = a[0] * b[i + 1] - a[i + 1] * b[0] - a[j + 1] * b[k + 1] + a[k + 1] * b[j + 1];
      d[3 + i] = copysign(2.0, same) * half;
    }
  }
}

/* Compares a state with the reference. q and v contain the positions and velocities of all bodies.
 * Each of them may be NULL. */
static measure measure_state(const sample *at, double scale, const double *q, const double *v)
{
  measure out = {0};
  const baum_i_catalog_mechanism *of = at->of;
  double step_q = pow(10.0, -of->digits_q);
  double step_v = pow(10.0, -of->digits_v);
  int count = width_v(of);
  for (int body = 0; body < baum_i_catalog_bodies(of, at->p); body++) {
    double d[BAUM_I_BODY_WIDTH];
    const baum_i_body_state s = state_of(at, body);
    subtract(of, s.q, q ? q + body * width(of) : s.q, d);
    for (int k = 0; k < count; k++) {
      double unit = of->units[k] == 'm' ? scale : 1.0;
      out.q = most(out.q, q ? fabs(d[k]) / unit : (double)NAN);
      out.v = most(out.v, v ? fabs(v[body * count + k] - s.v[k]) / unit : (double)NAN);
      out.size_v = most(out.size_v, fabs(s.v[k]) / unit);
      out.floor_q = most(out.floor_q, step_q * fmax(1.0, fabs(s.q[k])) / unit);
      out.floor_v = most(out.floor_v, step_v * fmax(1.0, fabs(s.v[k])) / unit);
    }
  }
  return out;
}

/* Finds the largest velocity over all samples, by which errors of velocities are divided. It also
 * finds the largest uncertainties of the reference, which are called floors. */
static baum_status measure_reference(sample *at, double scale, measure *out)
{
  *out = (measure){0};
  for (int k = 0; k < at->of->samples; k++) {
    BAUM_I_CATALOG_TRY(look_up(at, time_of(at->of, k)));
    measure one = measure_state(at, scale, NULL, NULL);
    out->size_v = most(out->size_v, one.size_v);
    out->floor_q = most(out->floor_q, one.floor_q);
    out->floor_v = most(out->floor_v, one.floor_v);
  }
  /* If nothing moves, errors of velocities are divided by `scale` per second and by 1 rad/s. */
  out->size_v = out->size_v > 0.0 ? out->size_v : 1.0;
  return BAUM_OK;
}

static void keep_worst(double error, double t, double *worst, double *when)
{
  if (error > *worst || (isnan(error) && !isnan(*worst)) || isnan(*when)) {
    *worst = error;
    *when = t;
  }
}

static baum_status check_sizes(const sample *at, const baum_mechanism *mechanism)
{
  int32_t nq = 0;
  BAUM_I_CATALOG_TRY(baum_mechanism_sizes(mechanism, &nq, NULL, NULL));
  int wanted = baum_i_catalog_bodies(at->of, at->p) * width(at->of);
  return nq == wanted
           ? BAUM_OK
           : baum_i_catalog_fail(BAUM_ERR_ARGUMENT,
                                 "catalogue: the mechanism has %d coordinates, but \"%s\" has %d",
                                 (int)nq, at->of->name, wanted);
}

static baum_status compare_all(sample *at, double scale, const double *times, int64_t n,
                               const double *q, const double *v, baum_catalog_error *error)
{
  measure whole;
  size_t bodies = (size_t)baum_i_catalog_bodies(at->of, at->p);
  size_t nq = bodies * (size_t)width(at->of);
  size_t nv = bodies * (size_t)width_v(at->of);
  BAUM_I_CATALOG_TRY(measure_reference(at, scale, &whole));
  for (int64_t i = 0; i < n; i++) {
    size_t row = (size_t)i;
    BAUM_I_CATALOG_TRY(look_up(at, times[i]));
    measure one = measure_state(at, scale, q + row * nq, v ? v + row * nv : NULL);
    error->q_final = one.q;
    error->v_final = one.v / whole.size_v;
    keep_worst(error->q_final, times[i], &error->q, &error->q_time);
    keep_worst(error->v_final, times[i], &error->v, &error->v_time);
  }
  error->q_floor = whole.floor_q;
  error->v_floor = whole.floor_v / whole.size_v;
  return BAUM_OK;
}

baum_status baum_catalog_compare(const baum_catalog_choice *choice, const baum_mechanism *mechanism,
                                 const double *times, int64_t n, const double *q, const double *v,
                                 baum_catalog_error *out, size_t caller_size)
{
  sample at;
  double scale = (double)NAN;
  baum_catalog_error error = {.q_time = (double)NAN, .v_time = (double)NAN};
  if (!times || !q || n <= 0) {
    return baum_i_catalog_fail(BAUM_ERR_ARGUMENT, "baum_catalog_compare: %s",
                               n <= 0   ? "n is not positive"
                               : !times ? "times is NULL"
                                        : "q is NULL");
  }
  BAUM_I_CATALOG_TRY(resolve(choice, &at));
  BAUM_I_CATALOG_TRY(check_sizes(&at, mechanism));
  BAUM_I_CATALOG_TRY(baum_mechanism_get_characteristic_length(mechanism, &scale));
  BAUM_I_CATALOG_TRY(compare_all(&at, scale, times, n, q, v, &error));
  return baum_i_catalog_give(out, caller_size, &error, sizeof error);
}
