/* SPDX-License-Identifier: BSD-3-Clause */
/* Derivatives by central differences of sixth order. f(s) is the function F along a straight line
 * (difference.h), and h is the step:
 *
 *   f'(0)  = sum_k c_k (f(kh) - f(-kh)) / h             c = 3/4, -3/20, 1/60,   error h^6 f^(7)/140
 *   f''(0) = sum_k c_k (f(kh) - 2 f(0) + f(-kh)) / h^2  c = 3/2, -3/20, 1/90,   error h^6 f^(8)/560
 *
 * The values of F have rounding errors of a few eps |F|. They cause errors of eps |F| / h in f' and
 * of 6 eps |F| / h^2 in f''. If steps are measured relative to the scale of a coordinate, the best
 * step is near 2^-8 for f' and near 2^-6 for f''. The steps used here are a little smaller.
 * Therefore even functions that vary three times as fast as the scale suggests lose no accuracy.
 * The errors are about 1e-13 for f' and 1e-11 for f''.
 *
 * The same function values also give differences of fourth order (c = 2/3, -1/12 for f' and 4/3,
 * -1/12 for f''). If the results of both orders agree to 1e-7, the error of the sixth order is
 * about 1e-11. For first derivatives, an agreement to 1e-9 is required. If the results do not
 * agree, the scale is too large for F, and the step is reduced until they agree. A scale that is
 * wrong by a factor of 1e6 costs time, but no accuracy. The search for a step also ends if the
 * results of both orders differ only by rounding.
 *
 * If F oscillates in time, several periods may fit into one step. If their number is an integer,
 * all values above are those of a slow function, and both orders agree on a wrong result. For rays
 * along t, F is therefore also evaluated at 0.618 h, and compared with the polynomial through the
 * other values.
 *
 * Steps are powers of two, and the step of each coordinate is rounded to the spacing of numbers at
 * q. Therefore q + k h is exact even after ten thousand revolutions of a crank.
 *
 * If q is not a vector, moving q causes rounding errors in q, and therefore an error of F even
 * where F is small.
 *
 * Central differences need function values on both sides. F is therefore evaluated at times up to
 * 3 h before and after the present time.
 */
#include "mechanism/general/difference.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "mechanism/manifold.h"

const baum_i_stencil baum_i_stencil_first = {
  .order = 1,
  .sixth = {3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0},
  .fourth = {2.0 / 3.0, -1.0 / 12.0, 0.0},
  .between = {0.8029379096353511, -0.1097265355833544, 0.01151638342708421},
  .step = 0x1p-9,
  .shrink = 0.125,
  .steps = 8,
  .agreement = 1e-9,
};

/* This formula is for functions F that have an error of 1e-11 because they use differences
 * themselves. Its steps are larger, because the error of F is divided by the step. */
static const baum_i_stencil stencil_rough = {
  .order = 1,
  .sixth = {3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0},
  .fourth = {2.0 / 3.0, -1.0 / 12.0, 0.0},
  .between = {0.8029379096353511, -0.1097265355833544, 0.01151638342708421},
  .step = 0x1p-5,
  .shrink = 0.125,
  .steps = 9,
  .agreement = 1e-7,
};

const baum_i_stencil baum_i_stencil_second = {
  .order = 2,
  .sixth = {3.0 / 2.0, -3.0 / 20.0, 1.0 / 90.0},
  .fourth = {4.0 / 3.0, -1.0 / 12.0, 0.0},
  .between = {0.4962429190104387, -0.03390736422914389, 0.002372505461804679},
  .step = 0x1p-6,
  .shrink = 0.25,
  .steps = 12,
  .agreement = 1e-7,
};

/* Distance of the values that test whether F oscillates within a step, in steps. Any number that is
 * not near a fraction of small integers would do. */
static const double between = 0.6180339887498949;

/* Relative rounding error of F. The factor 64 allows for larger terms that cancel inside F. */
static const double rounding = 64.0 * DBL_EPSILON;

/* ---- rays ---- */

double baum_i_local_rate(const baum_i_local *at)
{
  double rate = 0.0;
  for (int i = 0; i < at->nl; i++) {
    rate = fmax(rate, fabs(at->v[i]) / at->scale[i]);
  }
  return rate;
}

baum_i_ray baum_i_column_ray(const baum_i_local *at, baum_i_variable variable, int column,
                             double *direction)
{
  for (int i = 0; i < at->nl; i++) {
    direction[i] = i == column ? 1.0 : 0.0;
  }
  baum_i_ray ray = {.rate = 1.0 / at->scale[column]};
  if (variable == BAUM_I_VARIABLE_Q) {
    ray.dq = direction;
  } else {
    ray.dv = direction;
    ray.rate /= fmax(baum_i_local_rate(at), 1.0);
  }
  return ray;
}

double baum_i_first_step(const baum_i_stencil *stencil, const baum_i_ray *ray)
{
  int exponent;
  (void)frexp(stencil->step / ray->rate, &exponent);
  return ldexp(1.0, exponent - 1);
}

/* ---- one step size ---- */

/* A field, the point at which it is differentiated, the step of every coordinate, and memory for
 * evaluations. */
typedef struct probe {
  const baum_i_field *field;
  const baum_i_ray *ray;
  const baum_i_local *at;
  double step;
  double step_t;
  double *step_q;
  double *step_v;
  double *q;
  double *v;
  double *free;
} probe;

/* Round the step d so that x + d, x + 2 d and x + 3 d are exact. */
static double exact_step(double x, double d)
{
  double farthest = fabs(x) + 3.0 * fabs(d);
  if (farthest == 0.0 || !isfinite(farthest)) {
    return d;
  }
  double spacing = ldexp(1.5, ilogb(farthest) + 1);
  return (d + spacing) - spacing;
}

static void set_steps(double *steps, const double *x, const double *direction, double step, int n)
{
  for (int i = 0; i < n; i++) {
    steps[i] = direction ? exact_step(x[i], step * direction[i]) : 0.0;
  }
}

static probe make_probe(baum_i_local *here, const baum_i_field *field, const baum_i_ray *ray,
                        const baum_i_local *at, double step)
{
  probe p = {.field = field, .ray = ray, .at = at, .step = step};
  p.step_t = exact_step(at->t, step * ray->dt);
  p.step_q = baum_i_take(here, at->nl);
  p.step_v = baum_i_take(here, at->nl);
  p.q = baum_i_take(here, at->ql);
  p.v = baum_i_take(here, at->nl);
  set_steps(p.step_q, at->q, at->span ? NULL : ray->dq, step, at->nl);
  set_steps(p.step_v, at->v, ray->dv, step, at->nl);
  return p;
}

static void move_along(const probe *p, double k, const double *dq)
{
  if (dq) {
    baum_i_span_move(p->at->point->mechanism, p->at->span, k * p->step, dq, p->q);
  }
}

/* Evaluate F at k steps from the present point. */
static baum_status sample(const probe *p, double k, double *out)
{
  if (p->at->span) {
    memcpy(p->q, p->at->q, (size_t)p->at->ql * sizeof *p->q);
    move_along(p, k, p->ray->dq_first);
    move_along(p, k, p->ray->dq);
  }
  for (int i = 0; i < p->at->nl; i++) {
    if (!p->at->span) {
      p->q[i] = p->at->q[i] + k * p->step_q[i];
    }
    p->v[i] = p->at->v[i] + k * p->step_v[i];
  }
  baum_i_local there = *p->at;
  there.t = p->at->t + k * p->step_t;
  there.q = p->q;
  there.v = p->v;
  there.free = p->free;
  return p->field->evaluate(p->field->context, &there, out);
}

static void clear_estimate(const baum_i_estimate *out, int size)
{
  for (int i = 0; i < size; i++) {
    out->value[i] = 0.0;
    out->error[i] = 0.0;
    out->noise[i] = 0.0;
    out->variation[i] = 0.0;
    out->between[i] = 0.0;
  }
}

/* Add the contribution of the two values at the distance of k + 1 steps. `centre` is the value at
 * the point itself. It is NULL for first derivatives. */
static void add_pair(const baum_i_stencil *stencil, int k, const double *plus, const double *minus,
                     const double *centre, const baum_i_estimate *out, int size)
{
  for (int i = 0; i < size; i++) {
    double pair = centre ? (plus[i] - centre[i]) + (minus[i] - centre[i]) : plus[i] - minus[i];
    out->between[i] -= stencil->between[k] * pair;
    out->value[i] += stencil->sixth[k] * pair;
    out->error[i] += (stencil->sixth[k] - stencil->fourth[k]) * pair;
    out->noise[i] = fmax(out->noise[i], fmax(fabs(plus[i]), fabs(minus[i])));
    out->variation[i] = fmax(out->variation[i], fabs(pair));
  }
}

static void finish(const baum_i_stencil *stencil, double step, const baum_i_estimate *out, int size)
{
  double unit = stencil->order == 1 ? step : step * step;
  for (int i = 0; i < size; i++) {
    out->value[i] /= unit;
    out->error[i] = fabs(out->error[i]) / unit;
    out->noise[i] *= rounding / unit;
    out->variation[i] /= unit;
  }
}

baum_i_estimate baum_i_estimate_take(baum_i_local *here, int size)
{
  baum_i_estimate estimate;
  estimate.value = baum_i_take(here, size);
  estimate.error = baum_i_take(here, size);
  estimate.noise = baum_i_take(here, size);
  estimate.variation = baum_i_take(here, size);
  estimate.between = baum_i_take(here, size);
  return estimate;
}

/* Evaluate F after q has moved along the ray by half its scale. The result tells the size of F,
 * which may be zero at the point itself. */
static baum_status evaluate_beside(const probe *p, double *out)
{
  baum_i_local there = *p->at;
  double far = 0.5 / p->ray->rate;
  memcpy(p->q, p->at->q, (size_t)p->at->ql * sizeof *p->q);
  if (p->at->span) {
    move_along(p, far / p->step, p->ray->dq);
  } else {
    for (int i = 0; i < p->at->nl; i++) {
      p->q[i] += far * p->ray->dq[i];
    }
  }
  there.q = p->q;
  there.free = p->free;
  return p->field->evaluate(p->field->context, &there, out);
}

/* On a manifold, rounding errors of q cause an error of F in proportion to the size of F nearby. If
 * F fails there, the error is not estimated. */
static void estimate_noise(const probe *p, const baum_i_estimate *out, double *beside)
{
  if (p->at->span && p->ray->dq && evaluate_beside(p, beside) == BAUM_OK) {
    for (int i = 0; i < p->field->size; i++) {
      out->noise[i] = fabs(beside[i]);
    }
  }
}

static bool varies(const baum_i_estimate *out, int size)
{
  for (int i = 0; i < size; i++) {
    if (out->variation[i] > 0.0) {
      return true;
    }
  }
  return false;
}

/* Compare the values at the distance `between` with the polynomial. If F oscillates within a step,
 * the difference counts as an error. Differences that rounding of q may cause do not count. */
static baum_status add_between(const probe *p, double *plus, double *minus, const double *centre,
                               const baum_i_estimate *out)
{
  bool oscillates = false;
  BAUM_I_TRY(sample(p, between, plus));
  BAUM_I_TRY(sample(p, -between, minus));
  for (int i = 0; i < p->field->size; i++) {
    double pair = centre ? (plus[i] - centre[i]) + (minus[i] - centre[i]) : plus[i] - minus[i];
    out->between[i] = fabs(out->between[i] + pair);
    out->variation[i] = fmax(out->variation[i], fabs(pair));
    oscillates = oscillates || out->between[i] > 0.01 * out->variation[i];
  }
  memset(plus, 0, (size_t)p->field->size * sizeof *plus);
  if (!oscillates || (p->ray->dq && evaluate_beside(p, plus) != BAUM_OK)) {
    return BAUM_OK;
  }
  for (int i = 0; i < p->field->size; i++) {
    if (out->between[i] > 0.01 * out->variation[i] + 1e-9 * fabs(plus[i])) {
      out->error[i] = fabs(out->error[i]) + out->between[i];
    }
  }
  return BAUM_OK;
}

baum_status baum_i_difference_once(const baum_i_stencil *stencil, const baum_i_field *field,
                                   const baum_i_ray *ray, const baum_i_local *at, double step,
                                   const baum_i_estimate *out)
{
  baum_i_local here = *at;
  probe p = make_probe(&here, field, ray, at, step);
  double *plus = baum_i_take(&here, field->size);
  double *minus = baum_i_take(&here, field->size);
  double *centre = stencil->order == 2 ? baum_i_take(&here, field->size) : NULL;
  p.free = here.free;
  clear_estimate(out, field->size);
  estimate_noise(&p, out, plus);
  BAUM_I_TRY(centre ? sample(&p, 0, centre) : BAUM_OK);
  for (int k = 0; k < 3; k++) {
    BAUM_I_TRY(sample(&p, k + 1, plus));
    BAUM_I_TRY(sample(&p, -k - 1, minus));
    add_pair(stencil, k, plus, minus, centre, out, field->size);
  }
  if (ray->dt != 0.0 && varies(out, field->size)) {
    BAUM_I_TRY(add_between(&p, plus, minus, centre, out));
  }
  finish(stencil, step, out, field->size);
  return BAUM_OK;
}

/* ---- the search for a step ---- */

/* Store the entries of the derivative that have improved. For each entry, best (size) contains the
 * smallest difference so far between the results of the two orders, relative to the variation of F.
 * A number in `best` is negative if this difference was small enough. Returns true if a smaller
 * step would not help. */
static bool keep_improved(const baum_i_estimate *now, double agreement, double *out, double *best,
                          int size)
{
  bool settled = true;
  for (int i = 0; i < size; i++) {
    if (best[i] < 0.0) {
      continue;
    }
    if (now->error[i] <= agreement * fabs(now->value[i]) + now->noise[i]) {
      out[i] = now->value[i];
      best[i] = -1.0;
      continue;
    }
    /* The search continues if smaller steps help, or if the two orders differ by much more than
     * rounding. */
    double apart = now->error[i] / now->variation[i];
    bool helps = apart < 0.5 * best[i];
    bool coarse = apart > 1e-3 && now->error[i] > 1e4 * now->noise[i];
    settled = settled && !helps && !coarse;
    if (apart < best[i]) {
      out[i] = now->value[i];
      best[i] = apart;
    }
  }
  return settled;
}

static baum_status differentiate(const baum_i_stencil *stencil, const baum_i_field *field,
                                 const baum_i_ray *ray, const baum_i_local *at, double *out)
{
  baum_i_local here = *at;
  baum_i_estimate now = baum_i_estimate_take(&here, field->size);
  double *best = baum_i_take(&here, field->size);
  for (int i = 0; i < field->size; i++) {
    best[i] = (double)INFINITY;
  }
  double step = baum_i_first_step(stencil, ray);
  baum_status status = BAUM_OK;
  bool any = false;
  for (int k = 0; k < stencil->steps; k++) {
    here.point->retry = false;
    status = baum_i_difference_once(stencil, field, ray, &here, step, &now);
    /* The function may ask for a smaller step (retry), because its domain may end near this
     * point. */
    if (status != BAUM_OK && !here.point->retry) {
      return status;
    }
    if (status == BAUM_OK) {
      any = true;
      if (keep_improved(&now, stencil->agreement, out, best, field->size)) {
        break;
      }
    }
    step *= stencil->shrink;
  }
  here.point->retry = !any;
  return any ? BAUM_OK : status;
}

baum_status baum_i_difference_first(const baum_i_field *field, const baum_i_ray *ray,
                                    const baum_i_local *at, double *out)
{
  const baum_i_stencil *stencil = field->rough ? &stencil_rough : &baum_i_stencil_first;
  return differentiate(stencil, field, ray, at, out);
}

baum_status baum_i_difference_second(const baum_i_field *field, const baum_i_ray *ray,
                                     const baum_i_local *at, double *out)
{
  return differentiate(&baum_i_stencil_second, field, ray, at, out);
}

baum_status baum_i_difference_columns(const baum_i_field *field, baum_i_variable variable,
                                      const baum_i_local *at, double *out)
{
  baum_i_local here = *at;
  double *direction = baum_i_take(&here, at->nl);
  double *column = baum_i_take(&here, field->size);
  for (int j = 0; j < at->nl; j++) {
    baum_i_ray ray = baum_i_column_ray(at, variable, j, direction);
    BAUM_I_TRY(baum_i_difference_first(field, &ray, &here, column));
    for (int i = 0; i < field->size; i++) {
      out[i * at->nl + j] = column[i];
    }
  }
  return BAUM_OK;
}
