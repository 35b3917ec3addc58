/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks the derivatives that user functions return, by finite differences of user functions.
 *
 * The check compares the value g that a user function returned with differences d for a sequence
 * of decreasing steps. The value g is accepted if
 *
 *   |g - d| <= 1e-6 max(|g|, |d|) + 1e-9 (size of its row)
 *
 * holds for one of the steps. The size of a row is its largest scaled entry, in magnitude. The
 * second term allows for the rounding error of an entry that is small compared with the other
 * entries of its row. The value g is rejected if the inequality holds for no step and, in addition,
 * the best d and at least one other d differ from g by more than the error of d. The error of d is
 * estimated as 20 times the difference between the formulas of two orders (difference.c), plus
 * twice the difference from the d of the previous step, plus rounding. At a kink, such as dry
 * friction at rest, the difference between the derivatives on both sides is the same for every
 * step. The function has no derivative there, and the check passes.
 *
 * The check evaluates the design configuration and three configurations near it. In these three
 * configurations, coordinates and velocities are quasi-random, so that no value is zero or
 * symmetric by chance. The constraint function Phi is not zero in these configurations, so the
 * check rejects derivatives that are only correct for Phi = 0. If a user function fails in a
 * configuration, the check skips this configuration. If a user function fails in all
 * configurations, the check fails. A function is allowed to fail in the design configuration,
 * because velocities that are not given are set to zero there.
 *
 * During a run, baum_i_check_at() checks the functions again at a state of the run. It calls them
 * less often: it compares all columns of a matrix together, along one direction, and each column
 * only if the results differ. A derivative that looks wrong is reported only if it also looks wrong
 * at two points shortly before the state, or at two points shortly after it. The reason is that the
 * state itself may be at a jump of a second derivative, for example at the end of a phase of
 * constant acceleration.
 */
#include "mechanism/general/check.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/golden.h"
#include "base/message.h"
#include "mechanism/manifold.h"

static const double tolerance = 1e-6;
static const double row_tolerance = 1e-9;

/* ---- one derivative ---- */

/* Results so far. Each array has one number for each entry of the derivative along one ray (a
 * straight line in (t, q, v), see difference.h). */
typedef struct trial {
  baum_i_estimate now;
  double *previous; /* value that the previous step gave */
  double *value;    /* best difference */
  /* Error of the best difference; negative if the given value has been accepted. */
  double *error;
  double *quality; /* error of the best difference, relative to the variation of the function */
  double *step;    /* the step that gave the best difference */
  double *wrong;   /* number of steps for which the given value looked wrong */
} trial;

/* The values that a user function returned for one ray. */
typedef struct column {
  const baum_i_claim *claim;
  const baum_i_stencil *stencil;
  const baum_i_field *field;
  const baum_i_ray *ray;
  const double *row_size; /* (field->size) result of find_row_size(), or NULL */
  /* Entry i of the derivative along the ray is entry first + i * stride of the claim. */
  int first;
  int stride;
} column;

static double given(const column *c, int i)
{
  return c->claim->given[c->first + i * c->stride];
}

static double allowed(const column *c, int i, double value)
{
  double floor = c->row_size ? row_tolerance * c->row_size[i] * c->ray->rate : 0.0;
  return tolerance * fmax(fabs(given(c, i)), fabs(value)) + floor;
}

static trial take_trial(baum_i_local *here, int size)
{
  trial t = {.now = baum_i_estimate_take(here, size)};
  t.previous = baum_i_take(here, size);
  t.value = baum_i_take(here, size);
  t.error = baum_i_take(here, size);
  t.quality = baum_i_take(here, size);
  t.step = baum_i_take(here, size);
  t.wrong = baum_i_take(here, size);
  for (int i = 0; i < size; i++) {
    t.previous[i] = (double)NAN;
    t.error[i] = (double)INFINITY;
    t.quality[i] = (double)INFINITY;
    t.wrong[i] = 0.0;
  }
  return t;
}

/* Store a new difference if it is the best one so far. For the first step there is no previous
 * value. The error is then NaN, and the difference is not stored. */
static void keep_best(const trial *t, int i, double value, double error, double step)
{
  double varied = t->now.variation[i] + t->now.noise[i];
  double quality = varied > 0.0 ? error / varied : error;
  if (quality < t->quality[i]) {
    t->value[i] = value;
    t->error[i] = error;
    t->quality[i] = quality;
    t->step[i] = step;
  }
}

/* Compare the given values with the differences for the present step. Returns true if all given
 * values are accepted. */
static bool judge_step(const column *c, const trial *t, double step)
{
  bool right = true;
  for (int i = 0; i < c->field->size; i++) {
    double value = t->now.value[i];
    double error = 20.0 * t->now.error[i] + t->now.noise[i] + 2.0 * fabs(value - t->previous[i]);
    double deviation = fabs(given(c, i) - value);
    t->previous[i] = value;
    if (t->error[i] < 0.0) {
      continue;
    }
    if (deviation <= allowed(c, i, value)) {
      t->error[i] = -1.0;
      continue;
    }
    right = false;
    t->wrong[i] += deviation > allowed(c, i, value) + error ? 1.0 : 0.0;
    keep_best(t, i, value, error, step);
  }
  return right;
}

/* Return the difference between the one-sided derivatives on both sides of the point, computed with
 * this step. */
static double kink(const column *c, const baum_i_local *at, const baum_i_estimate *work,
                   double step, int i)
{
  baum_status status =
    baum_i_difference_once(&baum_i_stencil_second, c->field, c->ray, at, step, work);
  return status == BAUM_OK ? step * fabs(work->value[i]) : (double)INFINITY;
}

/* Tell whether the function has no kink. It is considered to have none if the difference between
 * the derivatives on both sides decreases with the step, or if this difference is too small to
 * explain the deviation of the given value. */
static bool is_smooth(const column *c, const baum_i_local *at, const trial *t, int i)
{
  double far = kink(c, at, &t->now, t->step[i], i);
  double near = kink(c, at, &t->now, 0.125 * t->step[i], i);
  return near <= 0.5 * far || near <= 0.25 * fabs(given(c, i) - t->value[i]);
}

/* Return the k-th quasi-random number with alternating sign and a magnitude between 0.2 and 1. */
static double spread(int k)
{
  double size = 0.6 + 0.4 * baum_i_golden(k);
  return k % 2 == 0 ? size : -size;
}

/* Write a direction in which each coordinate changes by 0.2 to 1 times its scale. */
static void set_general_direction(const baum_i_local *at, double *direction)
{
  for (int j = 0; j < at->nl; j++) {
    direction[j] = at->scale[j] * spread(j);
  }
}

/* Tell whether the deviation of a value is negligible. Where a motion satisfies its constraints,
 * phi is zero along the motion, and the rounding errors of phi cannot be estimated from its size.
 * The deviation is therefore compared with the variation of the function when all coordinates
 * change.
 */
static bool is_negligible(const column *c, const baum_i_local *at, const trial *t, int i)
{
  baum_i_local here = *at;
  double *direction = baum_i_take(&here, at->nl);
  set_general_direction(at, direction);
  const baum_i_ray ray = {
    .dt = c->ray->dt / c->ray->rate, .dq = direction, .dv = direction, .rate = 1.0};
  baum_status status = baum_i_difference_once(&baum_i_stencil_first, c->field, &ray, &here,
                                              baum_i_stencil_first.step, &t->now);
  double least =
    (row_tolerance * t->now.variation[i] + t->now.noise[i]) * pow(c->ray->rate, c->stencil->order);
  return status != BAUM_OK || fabs(given(c, i) - t->value[i]) <= least;
}

/* Tell whether a value is wrong. A value is wrong only if it deviates for the best step and for at
 * least one other step, because rounding may affect a single step. */
static bool is_wrong(const column *c, const trial *t, int i)
{
  double deviation = fabs(given(c, i) - t->value[i]);
  return t->wrong[i] >= 2.0 && t->error[i] >= 0.0 &&
         deviation > allowed(c, i, t->value[i]) + t->error[i];
}

static baum_status verdict(const column *c, const baum_i_local *at, const trial *t)
{
  for (int i = 0; i < c->field->size; i++) {
    if (is_wrong(c, t, i) && (c->stencil->order == 2 || is_smooth(c, at, t, i)) &&
        !(at->point->checks_run && is_negligible(c, at, t, i))) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s is %.9g but finite differences of %s give %.9g",
                         baum_i_user_entry(c->claim->function, c->first + i * c->stride).text,
                         given(c, i), c->claim->source, t->value[i]);
    }
  }
  return BAUM_OK;
}

static baum_status compare(const column *c, const baum_i_local *at)
{
  baum_i_local here = *at;
  trial t = take_trial(&here, c->field->size);
  double step = baum_i_first_step(c->stencil, c->ray);
  for (int k = 0; k < c->stencil->steps; k++) {
    here.point->retry = false;
    baum_status status = baum_i_difference_once(c->stencil, c->field, c->ray, &here, step, &t.now);
    if (status != BAUM_OK && !here.point->retry) {
      /* The function refuses nearby points whatever the step is, so differences cannot decide. */
      return BAUM_OK;
    }
    if (status == BAUM_OK && judge_step(c, &t, step)) {
      return BAUM_OK;
    }
    step *= c->stencil->shrink;
  }
  return verdict(c, &here, &t);
}

baum_status baum_i_compare_ray(const baum_i_claim *claim, const baum_i_stencil *stencil,
                               const baum_i_field *field, const baum_i_ray *ray,
                               const baum_i_local *at)
{
  column c = {
    .claim = claim, .stencil = stencil, .field = field, .ray = ray, .first = 0, .stride = 1};
  return compare(&c, at);
}

/* Context of rearranged_field(). This function evaluates a field. It stores each entry of the
 * result at the index that the derivative of this entry has in the result. Messages then name the
 * right entry. */
typedef struct rearranged {
  const baum_i_field *field;
  const baum_i_derived *pairs;
  int pair_count;
} rearranged;

static baum_status rearranged_field(const void *context, const baum_i_local *at, double *out)
{
  const rearranged *r = context;
  baum_i_local here = *at;
  double *values = baum_i_take(&here, r->field->size);
  BAUM_I_TRY(r->field->evaluate(r->field->context, &here, values));
  memset(out, 0, (size_t)r->field->size * sizeof *out);
  for (int k = 0; k < r->pair_count; k++) {
    out[r->pairs[k].entry] = values[r->pairs[k].of];
  }
  return BAUM_OK;
}

baum_status baum_i_compare_entries(const baum_i_user_function *function, const char *source,
                                   const baum_i_field *field, const baum_i_derived *pairs,
                                   int pair_count, const baum_i_ray *ray, const baum_i_local *at)
{
  baum_i_local here = *at;
  double *values = baum_i_take(&here, field->size);
  double *given = baum_i_take(&here, field->size);
  BAUM_I_TRY(field->evaluate(field->context, &here, values));
  memset(given, 0, (size_t)field->size * sizeof *given);
  for (int k = 0; k < pair_count; k++) {
    given[pairs[k].entry] = values[pairs[k].entry];
  }
  const rearranged r = {field, pairs, pair_count};
  const baum_i_field derived = {.evaluate = rearranged_field, .context = &r, .size = field->size};
  const baum_i_claim claim = {function, source, given};
  return baum_i_compare_ray(&claim, &baum_i_stencil_first, &derived, ray, &here);
}

/* For each row, find the largest of the values that the user function gave, in magnitude. Before
 * the comparison, each value is multiplied by the scale of its coordinate. */
static void find_row_size(const baum_i_claim *claim, const baum_i_local *at,
                          baum_i_variable variable, int size, double *direction, double *row_size)
{
  memset(row_size, 0, (size_t)size * sizeof *row_size);
  for (int j = 0; j < at->nl; j++) {
    baum_i_ray ray = baum_i_column_ray(at, variable, j, direction);
    for (int i = 0; i < size; i++) {
      row_size[i] = fmax(row_size[i], fabs(claim->given[i * at->nl + j]) / ray.rate);
    }
  }
}

/* Tell whether a claim (size x nl) agrees with differences along one direction, in which all
 * coordinates change. */
static bool agrees_along(const baum_i_claim *claim, const baum_i_field *field,
                         baum_i_variable variable, const baum_i_local *at)
{
  baum_i_local here = *at;
  double *direction = baum_i_take(&here, at->nl);
  double *products = baum_i_take(&here, field->size);
  memset(products, 0, (size_t)field->size * sizeof *products);
  set_general_direction(at, direction);
  for (int j = 0; j < at->nl; j++) {
    for (int i = 0; i < field->size; i++) {
      products[i] += claim->given[i * at->nl + j] * direction[j];
    }
  }
  bool by_q = variable == BAUM_I_VARIABLE_Q;
  const baum_i_ray ray = {.dq = by_q ? direction : NULL,
                          .dv = by_q ? NULL : direction,
                          .rate = by_q ? 1.0 : 1.0 / fmax(baum_i_local_rate(at), 1.0)};
  const baum_i_claim along = {claim->function, claim->source, products};
  return baum_i_compare_ray(&along, &baum_i_stencil_first, field, &ray, &here) == BAUM_OK;
}

baum_status baum_i_compare_columns(const baum_i_claim *claim, const baum_i_field *field,
                                   baum_i_variable variable, const baum_i_local *at)
{
  if (at->point->checks_run && agrees_along(claim, field, variable, at)) {
    return BAUM_OK;
  }
  baum_i_local here = *at;
  double *direction = baum_i_take(&here, at->nl);
  double *row_size = baum_i_take(&here, field->size);
  find_row_size(claim, at, variable, field->size, direction, row_size);
  for (int j = 0; j < at->nl; j++) {
    baum_i_ray ray = baum_i_column_ray(at, variable, j, direction);
    column c = {.claim = claim,
                .stencil = &baum_i_stencil_first,
                .field = field,
                .ray = &ray,
                .row_size = row_size,
                .first = j,
                .stride = at->nl};
    BAUM_I_TRY(compare(&c, &here));
  }
  return BAUM_OK;
}

/* ---- the whole mechanism ---- */

/* One of the configurations in which the functions are compared. It has its own memory. */
typedef struct place {
  baum_i_point point;
  double *q;
  double *v;
} place;

static void release_place(place *p)
{
  baum_i_point_release(&p->point);
  baum_i_free(p->q);
  baum_i_free(p->v);
}

static baum_status make_place(const baum_mechanism *mechanism, place *p)
{
  *p = (place){.q = NULL};
  BAUM_I_TRY(baum_i_point_create(mechanism, &p->point));
  p->q = baum_i_alloc((size_t)mechanism->nq, sizeof(double));
  p->v = baum_i_alloc((size_t)mechanism->nv, sizeof(double));
  return p->q && p->v ? BAUM_OK : baum_i_fail_memory();
}

enum { CONFIGURATIONS = 4 };
/* [1/s] Scaled velocities below this are set to zero, because displacements along them would be
 * lost in the rounding errors of q. */
static const double REST = 1e-12;

baum_status baum_i_compare_with_rest(const baum_i_user_function *function,
                                     const baum_i_field *field, const baum_i_local *at)
{
  baum_i_local here = *at;
  double *moving = baum_i_take(&here, field->size);
  double *resting = baum_i_take(&here, field->size);
  double *zeros = baum_i_take(&here, at->nl);
  memset(zeros, 0, (size_t)at->nl * sizeof *zeros);
  BAUM_I_TRY(field->evaluate(field->context, &here, moving));
  here.v = zeros;
  BAUM_I_TRY(field->evaluate(field->context, &here, resting));
  for (int i = 0; i < field->size; i++) {
    if (moving[i] != resting[i]) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "%s is %.9g at rest and %.9g in motion, but depends_on_velocity is false",
                         baum_i_user_entry(function, i).text, resting[i], moving[i]);
    }
  }
  return BAUM_OK;
}

/* Set configuration k. Configuration 0 is the design configuration with the given velocities. The
 * others are near it and have non-zero velocities. */
static void set_configuration(place *p, int k)
{
  static const double times[CONFIGURATIONS] = {0.0, 0.0, 0.37, 1.3};
  const baum_mechanism *mechanism = p->point.mechanism;
  memcpy(p->q, mechanism->design_q, (size_t)mechanism->nq * sizeof *p->q);
  for (int i = 0; i < mechanism->nv && k > 0; i++) {
    p->v[i] = mechanism->scale[i] * spread(3 * i + k);
  }
  if (k > 0) {
    baum_i_move(mechanism, 0.3, p->v, p->q);
  }
  for (int i = 0; i < mechanism->nv; i++) {
    double design_v = mechanism->design_v[i];
    if (k > 0) {
      p->v[i] = mechanism->scale[i] * spread(3 * i + 8 * k + 1);
    } else {
      /* A velocity that is not given is NaN. It is set to 0. */
      p->v[i] = fabs(design_v) > REST * mechanism->scale[i] ? design_v : 0.0;
    }
  }
  baum_i_point_set(&p->point, times[k], p->q, p->v);
}

static bool is_refusal(baum_status status)
{
  return status == BAUM_ERR_CALLBACK || status == BAUM_ERR_NOT_FINITE;
}

static baum_status check_element(const baum_i_element *element, place *p)
{
  if (!element->definition->check_derivatives) {
    return BAUM_OK;
  }
  bool any = false;
  for (int k = 0; k < CONFIGURATIONS; k++) {
    set_configuration(p, k);
    baum_status status = element->definition->check_derivatives(element, &p->point);
    if (status != BAUM_OK && !is_refusal(status)) {
      return status;
    }
    any = any || status == BAUM_OK;
  }
  if (any) {
    return BAUM_OK;
  }
  set_configuration(p, 0); /* so that messages show the design configuration */
  return element->definition->check_derivatives(element, &p->point);
}

static baum_status check_elements(const baum_mechanism *mechanism, place *p)
{
  for (int i = 0; i < BAUM_I_FAMILIES; i++) {
    const baum_i_family *family = baum_i_families[i];
    for (int k = 0; k < baum_i_family_count(family, mechanism); k++) {
      BAUM_I_TRY(check_element(family->at(mechanism, k), p));
    }
  }
  return BAUM_OK;
}

baum_status baum_mechanism_check_derivatives(const baum_mechanism *mechanism)
{
  BAUM_I_TRY(baum_i_check_frozen(mechanism, "baum_mechanism_check_derivatives"));
  place p;
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = make_place(mechanism, &p);
  if (status == BAUM_OK) {
    status = check_elements(mechanism, &p);
  }
  release_place(&p);
  return baum_i_message_settle(status, &kept);
}

/* ---- a state of a run ---- */

/* Times from a state to the points on one side of it, in units of the time in which the motion
 * changes. They are less than the longest steps of the differences. */
static const double BESIDE[] = {0.0123, 0.0077};

static bool is_wrong_at(const baum_i_element *element, baum_i_point *point)
{
  return element->definition->check_derivatives(element, point) == BAUM_ERR_ARGUMENT;
}

/* Tell whether an element is wrong at both points on one side of the state. */
static bool is_wrong_beside(const baum_i_element *element, baum_i_point *point,
                            const baum_i_run_state *at, double side)
{
  const baum_mechanism *m = point->mechanism;
  for (int k = 0; k < 2; k++) {
    double dt = side * BESIDE[k] * at->unit;
    memcpy(at->beside, at->q, (size_t)m->nq * sizeof *at->beside);
    baum_i_move(m, dt, at->v, at->beside);
    baum_i_point_set(point, at->t + dt, at->beside, at->v);
    if (!is_wrong_at(element, point)) {
      return false;
    }
  }
  return true;
}

/* Confirm that an element is wrong. Sets the point to the state again, and restores the message. */
static bool is_confirmed(const baum_i_element *element, baum_i_point *point,
                         const baum_i_run_state *at)
{
  const baum_i_kept_message message = baum_i_message_keep();
  bool is_wrong =
    is_wrong_beside(element, point, at, -1.0) || is_wrong_beside(element, point, at, 1.0);
  baum_i_point_set(point, at->t, at->q, at->v);
  (void)baum_i_message_settle(BAUM_OK, &message);
  return is_wrong;
}

static bool has_functions(const baum_i_element *element)
{
  const baum_i_definition *d = element->definition;
  return d->check_derivatives && baum_i_fields_have_function(d, element->def);
}

bool baum_i_has_checked_functions(const baum_mechanism *mechanism)
{
  for (int i = 0; i < BAUM_I_FAMILIES; i++) {
    for (int k = 0; k < baum_i_family_count(baum_i_families[i], mechanism); k++) {
      if (has_functions(baum_i_families[i]->at(mechanism, k))) {
        return true;
      }
    }
  }
  return false;
}

baum_status baum_i_check_at(baum_i_point *point, const baum_i_run_state *at, int *joint)
{
  baum_status status = BAUM_OK;
  baum_i_point_set(point, at->t, at->q, at->v);
  point->checks_run = true;
  for (int i = 0; i < BAUM_I_FAMILIES && status == BAUM_OK; i++) {
    const baum_i_family *family = baum_i_families[i];
    for (int k = 0; k < baum_i_family_count(family, point->mechanism) && status == BAUM_OK; k++) {
      const baum_i_element *element = family->at(point->mechanism, k);
      if (has_functions(element) && is_wrong_at(element, point) &&
          is_confirmed(element, point, at)) {
        *joint = family == &baum_i_joint_family ? k : -1;
        status = BAUM_ERR_ARGUMENT;
      }
    }
  }
  point->checks_run = false;
  return status;
}
