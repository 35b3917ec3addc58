/* SPDX-License-Identifier: BSD-3-Clause */
#include "quad_saddle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "quad.h"

/* ---- the system as a list of entries ---- */

typedef struct entry {
  int row;
  int column;
  double value;
} entry;

typedef struct quad_system {
  int n; /* nv + nc */
  int nv;
  entry *entries; /* the entries of M and J, but not those of J^T */
  size_t count;
  size_t room;
  double *b;  /* (n) */
  int *place; /* (n) position of each unknown in the order of elimination */
  bool failed;
} quad_system;

static void *room_for(quad_system *s, size_t count, size_t size)
{
  void *memory = calloc(count + 1, size);
  s->failed = s->failed || !memory;
  return memory;
}

static quad_system begin(int nv, int nc)
{
  quad_system s = {.n = nv + nc, .nv = nv};
  s.b = room_for(&s, (size_t)s.n, sizeof *s.b);
  s.place = room_for(&s, (size_t)s.n, sizeof *s.place);
  return s;
}

static void finish(quad_system *s)
{
  free(s->entries);
  free(s->b);
  free(s->place);
}

static void add(quad_system *s, int row, int column, double value)
{
  if (value == 0.0 || s->failed) {
    return;
  }
  if (s->count == s->room) {
    s->room = 2 * s->room + 64;
    entry *moved = realloc(s->entries, s->room * sizeof *moved);
    if (!moved) {
      s->failed = true;
      return;
    }
    s->entries = moved;
  }
  s->entries[s->count++] = (entry){row, column, value};
}

/* ---- order ---- */

/* An unknown. Unknowns are sorted by the key `at`. For acceleration i the key is 2 i. For a
 * multiplier it is the sum of the indices of the first and the last velocity in its row of J. */
typedef struct seat {
  int at;
  int unknown;
} seat;

static int compare_seats(const void *a, const void *b)
{
  const seat *x = a;
  const seat *y = b;
  if (x->at != y->at) {
    return x->at < y->at ? -1 : 1;
  }
  return x->unknown < y->unknown ? -1 : 1;
}

static void take_seats(const quad_system *s, seat *seats, int *first, int *last)
{
  for (int i = 0; i < s->n; i++) {
    first[i] = s->n;
    last[i] = -1;
  }
  for (size_t k = 0; k < s->count; k++) {
    const entry *e = &s->entries[k];
    first[e->row] = e->column < first[e->row] ? e->column : first[e->row];
    last[e->row] = e->column > last[e->row] ? e->column : last[e->row];
  }
  for (int i = 0; i < s->n; i++) {
    seats[i] = (seat){i < s->nv ? 2 * i : first[i] + last[i], i};
  }
}

static void find_order(quad_system *s)
{
  seat *seats = room_for(s, (size_t)s->n, sizeof *seats);
  int *first = room_for(s, (size_t)s->n, sizeof *first);
  int *last = room_for(s, (size_t)s->n, sizeof *last);
  if (!s->failed) {
    take_seats(s, seats, first, last);
    qsort(seats, (size_t)s->n, sizeof *seats, compare_seats);
    for (int i = 0; i < s->n; i++) {
      s->place[seats[i].unknown] = i;
    }
  }
  free(seats);
  free(first);
  free(last);
}

/* ---- elimination in a band ---- */

/* A band matrix. Row i contains the columns i - half to i + 2 half, and then the right side. The
 * upper part is wider than the lower part, because row exchanges for pivots fill it. */
typedef struct band {
  int n;
  int half;
  int width;
  wide *values;
} band;

static wide *at(const band *m, int row, int column)
{
  return &m->values[(size_t)row * (size_t)(m->width + 1) + (size_t)(column - row + m->half)];
}

static wide *right_side(const band *m, int row)
{
  return &m->values[(size_t)row * (size_t)(m->width + 1) + (size_t)m->width];
}

static int half_width(const quad_system *s)
{
  int half = 0;
  for (size_t k = 0; k < s->count; k++) {
    int apart = abs(s->place[s->entries[k].row] - s->place[s->entries[k].column]);
    half = apart > half ? apart : half;
  }
  return half;
}

static band make_band(quad_system *s)
{
  band m = {.n = s->n, .half = half_width(s)};
  m.width = 3 * m.half + 1;
  m.values = room_for(s, (size_t)m.n * (size_t)(m.width + 1), sizeof *m.values);
  for (size_t k = 0; k < s->count && !s->failed; k++) {
    const entry *e = &s->entries[k];
    int row = s->place[e->row];
    int column = s->place[e->column];
    *at(&m, row, column) = e->value;
    if (e->row >= s->nv) {
      *at(&m, column, row) = e->value;
    }
  }
  for (int i = 0; i < s->n && !s->failed; i++) {
    *right_side(&m, s->place[i]) = s->b[i];
  }
  return m;
}

static int least(int a, int b)
{
  return a < b ? a : b;
}

static void exchange(wide *a, wide *b)
{
  wide kept = *a;
  *a = *b;
  *b = kept;
}

static void bring_up_pivot(const band *m, int k)
{
  int best = k;
  for (int i = k + 1; i <= least(k + m->half, m->n - 1); i++) {
    if (wide_size(*at(m, i, k)) > wide_size(*at(m, best, k))) {
      best = i;
    }
  }
  for (int j = k; j <= least(k + 2 * m->half, m->n - 1) && best != k; j++) {
    exchange(at(m, k, j), at(m, best, j));
  }
  if (best != k) {
    exchange(right_side(m, k), right_side(m, best));
  }
}

/* Subtracts a multiple of row k from row i, so that the entry in column k becomes zero. */
static void take_away(const band *m, int k, int last, int i)
{
  wide *low = at(m, i, k);
  if (*low == 0) {
    return;
  }
  wide factor = *low / *at(m, k, k);
  const wide *from = at(m, k, k);
  for (int j = 1; j <= last - k; j++) {
    if (from[j] != 0) {
      low[j] -= factor * from[j];
    }
  }
  *right_side(m, i) -= factor * *right_side(m, k);
}

static bool eliminate(const band *m)
{
  for (int k = 0; k < m->n; k++) {
    bring_up_pivot(m, k);
    if (*at(m, k, k) == 0) {
      return false;
    }
    int last = least(k + 2 * m->half, m->n - 1);
    for (int i = k + 1; i <= least(k + m->half, m->n - 1); i++) {
      take_away(m, k, last, i);
    }
  }
  return true;
}

static void substitute(const band *m)
{
  for (int k = m->n - 1; k >= 0; k--) {
    wide sum = *right_side(m, k);
    const wide *row = at(m, k, k);
    for (int j = 1; j <= least(2 * m->half, m->n - 1 - k); j++) {
      if (row[j] != 0) {
        sum -= row[j] * *right_side(m, k + j);
      }
    }
    *right_side(m, k) = sum / row[0];
  }
}

static bool solve(quad_system *s, double *a, double *lambda)
{
  band m = {0};
  find_order(s);
  if (!s->failed) {
    m = make_band(s);
  }
  bool done = !s->failed && eliminate(&m);
  if (done) {
    substitute(&m);
    for (int i = 0; i < s->n; i++) {
      double x = (double)*right_side(&m, s->place[i]);
      *(i < s->nv ? &a[i] : &lambda[i - s->nv]) = x;
    }
  }
  free(m.values);
  return done;
}

/* ---- reading ---- */

static void read_dense(quad_system *s, const double *mass, const double *jacobian,
                       const unsigned char *omitted)
{
  int nv = s->nv;
  for (int i = 0; i < nv; i++) {
    for (int j = 0; j < nv; j++) {
      add(s, i, j, mass[(size_t)i * (size_t)nv + (size_t)j]);
    }
  }
  for (int i = 0; i < s->n - nv; i++) {
    if (omitted && omitted[i]) {
      add(s, nv + i, nv + i, 1.0);
      s->b[nv + i] = 0.0;
      continue;
    }
    for (int j = 0; j < nv; j++) {
      add(s, nv + i, j, jacobian[(size_t)i * (size_t)nv + (size_t)j]);
    }
  }
}

/* Subtracts 2 gain Phi' + gain^2 Phi from the right sides of the rows. Phi' = J v - nu. */
static bool add_gain(const quad_system *s, baum_workspace *workspace, double t, const double *q,
                     const double *v, double gain, const double *jacobian)
{
  int nv = s->nv;
  int nc = s->n - nv;
  double *nu = calloc(2 * (size_t)nc + 1, sizeof *nu);
  double *phi = nu + nc;
  bool done = nu && baum_workspace_nu(workspace, t, q, nu) == BAUM_OK &&
              baum_workspace_phi(workspace, t, q, phi) == BAUM_OK;
  for (int i = 0; done && i < nc; i++) {
    wide rate = -(wide)nu[i];
    for (int j = 0; j < nv; j++) {
      rate += (wide)jacobian[(size_t)i * (size_t)nv + (size_t)j] * (wide)v[j];
    }
    wide less = 2 * (wide)gain * rate + (wide)gain * (wide)gain * (wide)phi[i];
    s->b[nv + i] = (double)((wide)s->b[nv + i] - less);
  }
  free(nu);
  return done;
}

bool quad_acceleration_with_gain(baum_workspace *workspace, double t, const double *q,
                                 const double *v, double gain, const unsigned char *omitted,
                                 double *a, double *lambda)
{
  int nv = workspace->mechanism->nv;
  int nc = workspace->mechanism->nc;
  quad_system s = begin(nv, nc);
  double *mass = room_for(&s, (size_t)nv * (size_t)nv, sizeof *mass);
  double *jacobian = room_for(&s, (size_t)nc * (size_t)nv, sizeof *jacobian);
  bool done = !s.failed && baum_workspace_mass(workspace, t, q, mass) == BAUM_OK &&
              baum_workspace_jacobian(workspace, t, q, jacobian) == BAUM_OK &&
              baum_workspace_force(workspace, t, q, v, s.b) == BAUM_OK &&
              baum_workspace_gamma(workspace, t, q, v, s.b + nv) == BAUM_OK;
  if (done && gain != 0.0) {
    done = add_gain(&s, workspace, t, q, v, gain, jacobian);
  }
  if (done) {
    read_dense(&s, mass, jacobian, omitted);
    done = solve(&s, a, lambda);
  }
  free(mass);
  free(jacobian);
  finish(&s);
  return done;
}

bool quad_acceleration(baum_workspace *workspace, double t, const double *q, const double *v,
                       const unsigned char *omitted, double *a, double *lambda)
{
  return quad_acceleration_with_gain(workspace, t, q, v, 0.0, omitted, a, lambda);
}

static void read_blocks(quad_system *s, const baum_workspace *w)
{
  for (int b = 0; b < w->structure.mass_block_count; b++) {
    const baum_i_mass_block *block = &w->structure.mass_blocks[b];
    for (int k = 0; k < block->size * block->size; k++) {
      add(s, block->first + k / block->size, block->first + k % block->size,
          w->mass[block->value + k]);
    }
  }
  for (int b = 0; b < w->structure.row_block_count; b++) {
    const baum_i_row_block *block = &w->structure.row_blocks[b];
    for (int k = 0; k < block->rows * block->cols; k++) {
      add(s, s->nv + block->row + k / block->cols, block->col[k % block->cols],
          w->jacobian[block->value + k]);
    }
  }
  memcpy(s->b, w->force, (size_t)s->nv * sizeof *s->b);
  memcpy(s->b + s->nv, w->gamma, (size_t)(s->n - s->nv) * sizeof *s->b);
}

bool quad_acceleration_of_blocks(baum_workspace *workspace, double t, const double *q,
                                 const double *v, double *a, double *lambda)
{
  quad_system s = begin(workspace->mechanism->nv, workspace->mechanism->nc);
  bool done = !s.failed && baum_i_velocity_stage(workspace, t, q, v) == BAUM_OK;
  if (done) {
    read_blocks(&s, workspace);
    done = solve(&s, a, lambda);
  }
  finish(&s);
  return done;
}

double quad_error(int count, const double *x, const double *want)
{
  double error = 0.0;
  double size = 0.0;
  for (int i = 0; i < count; i++) {
    double apart = fabs(x[i] - want[i]);
    error = isnan(error) || apart <= error ? error : apart; /* this keeps NaN */
    size = fmax(size, fabs(want[i]));
  }
  return size > 0.0 ? error / size : error;
}
