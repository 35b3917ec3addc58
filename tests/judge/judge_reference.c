/* SPDX-License-Identifier: BSD-3-Clause */
#include "judge_reference.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = 7, STATE = 2 * JUDGE_N, MOST_STEPS = 20000 };

static const double AGREEMENT = 1e-6;
static const double NUDGE = 1e-6;

typedef struct run {
  const judge_scene *s;
  int columns; /* number of columns of the extrapolation table */
  double tolerance;
  double h;
  int steps;
  judge_state y;
} run;

/* ---- a step ---- */

/* Computes the derivative of y. The positions q begin at index 0 of y, and the velocities v at
 * index JUDGE_N. */
static bool slope(const judge_scene *s, double t, const double *y, double *dy)
{
  memcpy(dy, y + JUDGE_N, (size_t)s->n * sizeof *dy);
  return judge_acceleration(s, t, y, y + JUDGE_N, dy + JUDGE_N);
}

static void add_scaled(const judge_scene *s, const double *y, double h, const double *dy,
                       double *out)
{
  for (int i = 0; i < s->n; i++) {
    out[i] = y[i] + h * dy[i];
    out[JUDGE_N + i] = y[JUDGE_N + i] + h * dy[JUDGE_N + i];
  }
}

/* Takes a step by Gragg's modified midpoint rule, with `parts` substeps and smoothing at the
 * end. */
static bool midpoint(const judge_scene *s, double t, const double *y, const double *dy, double h,
                     int parts, double *out)
{
  double z[3][STATE];
  double f[STATE];
  double part = h / parts;
  double *before = z[0];
  double *now = z[1];
  double *next = z[2];
  memcpy(before, y, sizeof z[0]);
  add_scaled(s, y, part, dy, now);
  for (int k = 1; k < parts; k++) {
    if (!slope(s, t + k * part, now, f)) {
      return false;
    }
    add_scaled(s, before, 2.0 * part, f, next);
    double *free = before;
    before = now;
    now = next;
    next = free;
  }
  if (!slope(s, t + h, now, f)) {
    return false;
  }
  add_scaled(s, before, part, f, next);
  for (int i = 0; i < STATE; i++) {
    out[i] = 0.5 * (now[i] + next[i]);
  }
  return true;
}

static double scale_error(const run *r, const double *error, const double *y)
{
  double speed = 1.0;
  double most = 0.0;
  for (int i = 0; i < r->s->n; i++) {
    speed = fmax(speed, fabs(y[JUDGE_N + i]));
  }
  for (int i = 0; i < r->s->n; i++) {
    double one = fmax(fabs(error[i]), fabs(error[JUDGE_N + i]) / speed);
    most = one <= most ? most : one; /* this keeps NaN */
  }
  return most / r->tolerance;
}

/* Extrapolates by the Aitken-Neville scheme. Each row of the table overwrites the previous row.
 * Returns the error divided by the tolerance. */
static double extrapolate(const run *r, double t, const double *y, const double *dy, double h,
                          double *out)
{
  double table[COLUMNS][STATE] = {{0}};
  double error[STATE] = {0};
  for (int j = 0; j < r->columns; j++) {
    double fresh[STATE] = {0};
    if (!midpoint(r->s, t, y, dy, h, 2 * (j + 1), fresh)) {
      return INFINITY;
    }
    for (int k = 0; k <= j; k++) {
      double ratio = (double)(j + 1) / (j - k);
      for (int i = 0; i < STATE; i++) {
        double old = table[k][i];
        table[k][i] = fresh[i];
        if (k < j) {
          error[i] = (fresh[i] - old) / (ratio * ratio - 1.0);
          fresh[i] += error[i];
        }
      }
    }
  }
  memcpy(out, table[r->columns - 1], sizeof error);
  return scale_error(r, error, out);
}

/* ---- a run ---- */

static void pack(const judge_state *from, double *y)
{
  memcpy(y, from->q, sizeof from->q);
  memcpy(y + JUDGE_N, from->v, sizeof from->v);
}

/* Returns the factor for the next step. `error` is the error divided by the tolerance. */
static double rescale(const run *r, double error)
{
  double factor = 0.85 * pow(fmax(error, 1e-30), -1.0 / (2 * r->columns - 1));
  return isfinite(error) ? fmin(fmax(factor, 0.2), 3.0) : 0.2;
}

static bool advance(run *r, double t, double end)
{
  double y[STATE];
  double dy[STATE] = {0};
  double out[STATE] = {0};
  bool known = false;
  pack(&r->y, y);
  while (t < end) {
    bool last = t + r->h * (1.0 + 1e-9) >= end;
    double h = last ? end - t : r->h;
    if (++r->steps > MOST_STEPS || r->h < 1e-9 || (!known && !slope(r->s, t, y, dy))) {
      return false;
    }
    known = true;
    double error = extrapolate(r, t, y, dy, h, out);
    double factor = rescale(r, error);
    if (error <= 1.0) {
      t = last ? end : t + h;
      memcpy(r->y.q, out, sizeof r->y.q);
      memcpy(r->y.v, out + JUDGE_N, sizeof r->y.v);
      if (!judge_project(r->s, t, true, r->y.q, r->y.v)) {
        return false;
      }
      pack(&r->y, y);
      known = false;
      r->h = last && factor > 1.0 ? fmax(r->h, h * factor) : h * factor;
    } else {
      r->h = h * fmin(factor, 0.7);
    }
  }
  return true;
}

bool judge_is_angle(const judge_scene *s, int column)
{
  for (int k = 0; k < s->body_count; k++) {
    if (!s->bodies[k].particle && column == s->bodies[k].first + 2) {
      return true;
    }
  }
  return false;
}

/* ---- growth ---- */

enum { FREE = 2 * JUDGE_N };

typedef struct matrix {
  int rows;
  int columns;
  double at[FREE][FREE];
} matrix;

typedef struct tangent {
  int free;
  double rate;
  double basis[JUDGE_N][JUDGE_N];
} tangent;

static bool find_tangent(const judge_scene *s, double t, const judge_state *y, double rate,
                         tangent *out)
{
  judge_rows rows;
  judge_factors f;
  out->free = s->n - s->rows;
  out->rate = rate;
  judge_evaluate_rows(s, t, y->q, y->v, &rows);
  if (!judge_factor(s, &rows, false, &f)) {
    return false;
  }
  for (int k = 0; k < out->free; k++) {
    judge_null_vector(&f, k, out->basis[k]);
  }
  return true;
}

static double along(const judge_scene *s, const double *direction, const double *a, const double *b)
{
  double sum = 0.0;
  for (int i = 0; i < s->n; i++) {
    sum += direction[i] * (a[i] - b[i]);
  }
  return sum;
}

/* Computes a matrix by finite differences. The matrix maps small changes of positions and
 * velocities at sample k to the changes that they cause at sample k + 1. */
static bool differentiate(const judge_scene *s, const judge_reference *ref, int k, double h,
                          matrix *out)
{
  tangent from;
  tangent to;
  run base = {.s = s, .columns = 6, .tolerance = 1e-11, .h = h, .y = ref->at[k]};
  if (!find_tangent(s, ref->t[k], &ref->at[k], ref->rate, &from) ||
      !find_tangent(s, ref->t[k + 1], &ref->at[k + 1], ref->rate, &to)) {
    return false;
  }
  out->rows = 2 * to.free;
  out->columns = 2 * from.free;
  for (int c = 0; c < out->columns; c++) {
    run r = base;
    const double *direction = from.basis[c % from.free];
    for (int i = 0; i < s->n; i++) {
      double *what = c < from.free ? &r.y.q[i] : &r.y.v[i];
      *what += NUDGE * direction[i] * (c < from.free ? 1.0 : ref->rate);
    }
    if (!judge_project(s, ref->t[k], false, r.y.q, r.y.v) ||
        !advance(&r, ref->t[k], ref->t[k + 1])) {
      return false;
    }
    for (int d = 0; d < to.free; d++) {
      const judge_state *end = &ref->at[k + 1];
      out->at[d][c] = along(s, to.basis[d], r.y.q, end->q) / NUDGE;
      out->at[to.free + d][c] = along(s, to.basis[d], r.y.v, end->v) / NUDGE / ref->rate;
    }
  }
  return true;
}

static void multiply(const matrix *a, const matrix *b, matrix *out)
{
  static const matrix EMPTY = {0};
  *out = EMPTY;
  out->rows = a->rows;
  out->columns = b->columns;
  for (int i = 0; i < a->rows; i++) {
    for (int k = 0; k < a->columns; k++) {
      for (int j = 0; j < b->columns; j++) {
        out->at[i][j] += a->at[i][k] * b->at[k][j];
      }
    }
  }
}

/* Computes the largest singular value of the first `rows` rows by power iteration with A^T A. */
static double largest_singular_value(const matrix *a, int rows)
{
  double x[FREE];
  double size = 0.0;
  for (int j = 0; j < a->columns; j++) {
    x[j] = 1.0 + 0.1 * j;
  }
  for (int pass = 0; pass < 60; pass++) {
    double y[FREE] = {0};
    double z[FREE] = {0};
    double square = 0.0;
    for (int i = 0; i < rows; i++) {
      for (int j = 0; j < a->columns; j++) {
        y[i] += a->at[i][j] * x[j];
      }
    }
    for (int j = 0; j < a->columns; j++) {
      for (int i = 0; i < rows; i++) {
        z[j] += a->at[i][j] * y[i];
      }
      square += z[j] * z[j];
    }
    size = sqrt(sqrt(square)); /* from the second iteration on, x has length 1 */
    for (int j = 0; j < a->columns; j++) {
      x[j] = square > 0.0 ? z[j] / sqrt(square) : 0.0;
    }
  }
  return size;
}

/* Computes how much perturbations grow from every sample to every later sample. */
static bool find_growth(const judge_scene *s, judge_reference *ref)
{
  matrix segment;
  matrix product;
  /* Each matrix maps changes at an earlier sample to changes at the present sample. */
  matrix from[JUDGE_SEGMENTS];
  ref->growth = 1.0;
  ref->growth_end = 1.0;
  ref->growth_q = 1.0;
  for (int k = 0; s->n > s->rows && k < JUDGE_SEGMENTS; k++) {
    if (!differentiate(s, ref, k, ref->t[1] / 4.0, &segment)) {
      return false;
    }
    ref->growth_end = 1.0;
    from[k] = segment;
    for (int j = 0; j <= k; j++) {
      if (j < k) {
        multiply(&segment, &from[j], &product);
        from[j] = product;
      }
      ref->growth_end = fmax(ref->growth_end, largest_singular_value(&from[j], segment.rows));
      ref->growth_q = fmax(ref->growth_q, largest_singular_value(&from[j], segment.rows / 2));
    }
    ref->growth = fmax(ref->growth, ref->growth_end);
  }
  return true;
}

/* ---- the reference ---- */

static double compare(const judge_scene *s, const judge_state *a, const judge_state *b,
                      double length)
{
  double most = 0.0;
  for (int i = 0; i < s->n; i++) {
    double one = fabs(a->q[i] - b->q[i]) / (judge_is_angle(s, i) ? 1.0 : length);
    most = one <= most ? most : one;
  }
  return most;
}

static void note_sample(const judge_scene *s, const judge_state *y, judge_reference *out)
{
  double squares = 0.0;
  for (int i = 0; i < s->n; i++) {
    squares += y->v[i] * y->v[i] / s->n;
  }
  out->rate += sqrt(squares) / (JUDGE_SEGMENTS + 1);
  out->kinetic = fmax(out->kinetic, judge_kinetic(s, y->v));
}

bool judge_find_reference(const judge_scene *s, const double *q, const double *v, double length,
                          judge_reference *out)
{
  *out = (judge_reference){.failed = "start"};
  memcpy(out->at[0].q, q, (size_t)s->n * sizeof *q);
  memcpy(out->at[0].v, v, (size_t)s->n * sizeof *v);
  if (!judge_project(s, 0.0, true, out->at[0].q, out->at[0].v)) {
    return false;
  }
  double first = s->end / JUDGE_SEGMENTS;
  run a = {.s = s, .columns = 7, .tolerance = 1e-12, .h = first / 4.0, .y = out->at[0]};
  run b = {.s = s, .columns = 6, .tolerance = 1e-10, .h = first / 3.0, .y = out->at[0]};
  note_sample(s, &out->at[0], out);
  for (int k = 0; k < JUDGE_SEGMENTS; k++) {
    out->t[k + 1] = s->end * (k + 1) / JUDGE_SEGMENTS;
    out->failed = "steps";
    if (!advance(&a, out->t[k], out->t[k + 1]) || !advance(&b, out->t[k], out->t[k + 1])) {
      return false;
    }
    out->at[k + 1] = a.y;
    out->agreement = fmax(out->agreement, compare(s, &a.y, &b.y, length));
    note_sample(s, &a.y, out);
  }
  out->failed = "agreement";
  out->rate = fmax(out->rate, 0.1);
  if (!(out->agreement < AGREEMENT)) {
    return false;
  }
  out->failed = find_growth(s, out) ? NULL : "growth";
  return !out->failed;
}
