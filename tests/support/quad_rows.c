/* SPDX-License-Identifier: BSD-3-Clause */
#include "quad_rows.h"

#include <math.h>
#include <stdlib.h>

#include "quad.h"

typedef struct system {
  int nv;
  int nc;
  double *mass; /* as read */
  double *jacobian;
  double *force;
  double *gamma;
  wide *factor; /* (nv x nv) L */
  wide *w;      /* (nc x nv) columns of W, then of Q: column k from k nv on */
  wide *r;      /* (nc x nc) R in the order of the pivots */
  wide *c;      /* (nc) right sides in that order */
  wide *y;      /* (nv) */
  wide *work;   /* (nv + nc) */
} system_of_rows;

/* ---- memory ---- */

static bool begin(system_of_rows *s, int nv, int nc)
{
  size_t v = (size_t)nv;
  size_t r = (size_t)nc;
  *s = (system_of_rows){.nv = nv, .nc = nc};
  s->mass = calloc(v * v + r * v + v + r + 1, sizeof *s->mass);
  s->factor = calloc(v * v + r * v + r * r + r + v + v + r + 1, sizeof *s->factor);
  if (!s->mass || !s->factor) {
    return false;
  }
  s->jacobian = s->mass + v * v;
  s->force = s->jacobian + r * v;
  s->gamma = s->force + v;
  s->w = s->factor + v * v;
  s->r = s->w + r * v;
  s->c = s->r + r * r;
  s->y = s->c + r;
  s->work = s->y + v;
  return true;
}

static void finish(system_of_rows *s)
{
  free(s->mass);
  free(s->factor);
}

static wide dot(const wide *a, const wide *b, int count)
{
  wide sum = 0;
  for (int i = 0; i < count; i++) {
    sum += a[i] == 0 ? 0 : a[i] * b[i];
  }
  return sum;
}

/* ---- M = L L^T ---- */

static bool factor_mass(const system_of_rows *s)
{
  int n = s->nv;
  for (int i = 0; i < n; i++) {
    wide *row = s->factor + (size_t)i * (size_t)n;
    for (int j = 0; j <= i; j++) {
      const wide *other = s->factor + (size_t)j * (size_t)n;
      wide rest = s->mass[i * n + j] - dot(row, other, j);
      if (i == j && !(rest > 0)) {
        return false;
      }
      row[j] = i == j ? wide_root(rest) : rest / other[j];
    }
  }
  return true;
}

/* x := L^-1 x */
static void solve_lower(const system_of_rows *s, wide *x)
{
  for (int i = 0; i < s->nv; i++) {
    const wide *row = s->factor + (size_t)i * (size_t)s->nv;
    x[i] = (x[i] - dot(row, x, i)) / row[i];
  }
}

/* x := L^-T x */
static void solve_upper(const system_of_rows *s, wide *x)
{
  for (int i = s->nv - 1; i >= 0; i--) {
    const wide *row = s->factor + (size_t)i * (size_t)s->nv;
    x[i] /= row[i];
    for (int j = 0; j < i; j++) {
      x[j] -= row[j] * x[i];
    }
  }
}

/* ---- W = Q R ---- */

static wide *column(const system_of_rows *s, int k)
{
  return s->w + (size_t)k * (size_t)s->nv;
}

static wide *entry(const system_of_rows *s, int i, int k)
{
  return &s->r[i * s->nc + k];
}

static void make_columns(const system_of_rows *s)
{
  for (int k = 0; k < s->nc; k++) {
    wide *w = column(s, k);
    for (int i = 0; i < s->nv; i++) {
      w[i] = s->jacobian[k * s->nv + i];
    }
    solve_lower(s, w);
    wide length = wide_root(dot(w, w, s->nv));
    for (int i = 0; i < s->nv && length > 0; i++) {
      w[i] /= length;
    }
    s->c[k] = length > 0 ? s->gamma[k] / length : s->gamma[k];
  }
}

static void exchange(wide *a, wide *b)
{
  wide kept = *a;
  *a = *b;
  *b = kept;
}

static void bring_up(const system_of_rows *s, int k, int best)
{
  for (int i = 0; i < s->nv; i++) {
    exchange(&column(s, k)[i], &column(s, best)[i]);
  }
  for (int i = 0; i < k; i++) {
    exchange(entry(s, i, k), entry(s, i, best));
  }
  exchange(&s->c[k], &s->c[best]);
}

/* Takes column k, of length 1 now, out of all behind it; twice, so that it is gone. */
static void take_out(const system_of_rows *s, int k)
{
  const wide *q = column(s, k);
  for (int j = k + 1; j < s->nc; j++) {
    wide *w = column(s, j);
    for (int turn = 0; turn < 2; turn++) {
      wide part = dot(q, w, s->nv);
      *entry(s, k, j) += part;
      for (int i = 0; i < s->nv; i++) {
        w[i] -= part * q[i];
      }
    }
  }
}

/* Returns the length of the column with which it ended, 0 after the last. */
static wide factor_rows(const system_of_rows *s, int *rank)
{
  for (int k = 0; k < s->nc; k++) {
    int best = k;
    wide most = -1;
    for (int j = k; j < s->nc; j++) {
      wide square = dot(column(s, j), column(s, j), s->nv);
      best = square > most ? j : best;
      most = square > most ? square : most;
    }
    wide length = wide_root(most);
    *rank = k;
    if (length < QUAD_DEPENDENT) {
      return length;
    }
    bring_up(s, k, best);
    *entry(s, k, k) = length;
    for (int i = 0; i < s->nv; i++) {
      column(s, k)[i] /= length;
    }
    take_out(s, k);
  }
  *rank = s->nc;
  return 0;
}

/* ---- solution ---- */

/* x := R^-T x, of the first `rank` rows and columns. */
static void solve_transposed(const system_of_rows *s, int rank, wide *x)
{
  for (int k = 0; k < rank; k++) {
    for (int i = 0; i < k; i++) {
      x[k] -= *entry(s, i, k) * x[i];
    }
    x[k] /= *entry(s, k, k);
  }
}

/* x := R^-1 x likewise. */
static void solve_straight(const system_of_rows *s, int rank, wide *x)
{
  for (int i = rank - 1; i >= 0; i--) {
    for (int k = i + 1; k < rank; k++) {
      x[i] -= *entry(s, i, k) * x[k];
    }
    x[i] /= *entry(s, i, i);
  }
}

/* By inverse iteration on R^T R; ten turns have the smallest to a digit or two. */
static wide smallest_singular_value(const system_of_rows *s, int rank)
{
  wide *x = s->work;
  wide size = 1;
  for (int i = 0; i < rank; i++) {
    x[i] = 1 + (wide)(i % 7) / 8;
  }
  for (int turn = 0; turn < 10; turn++) {
    size = wide_root(dot(x, x, rank));
    for (int i = 0; i < rank; i++) {
      x[i] /= size;
    }
    solve_transposed(s, rank, x);
    solve_straight(s, rank, x);
    size = wide_root(dot(x, x, rank));
  }
  return 1 / wide_root(size);
}

/* y from L^-1 g to where the independent rows hold. */
static void move_onto_rows(const system_of_rows *s, int rank)
{
  wide *x = s->work;
  for (int k = 0; k < rank; k++) {
    x[k] = s->c[k];
  }
  solve_transposed(s, rank, x);
  for (int k = 0; k < rank; k++) {
    wide lacks = x[k] - dot(column(s, k), s->y, s->nv);
    for (int i = 0; i < s->nv; i++) {
      s->y[i] += lacks * column(s, k)[i];
    }
  }
}

/* Of the rows behind the rank: their columns of W are those of R times Q. */
static double largest_conflict(const system_of_rows *s, int rank, wide size)
{
  wide worst = 0;
  wide *along = s->work; /* Q^T y */
  for (int k = 0; k < rank; k++) {
    along[k] = dot(column(s, k), s->y, s->nv);
  }
  for (int k = rank; k < s->nc; k++) {
    wide rest = -s->c[k];
    for (int i = 0; i < rank; i++) {
      rest += *entry(s, i, k) * along[i];
    }
    wide relative = wide_size(rest) / (wide_size(s->c[k]) + size + (size == 0 ? 1 : 0));
    worst = relative > worst ? relative : worst;
  }
  return (double)worst;
}

static double largest(const wide *x, int count)
{
  double most = 0.0;
  for (int i = 0; i < count; i++) {
    most = fmax(most, fabs((double)x[i]));
  }
  return most;
}

static bool solve(const system_of_rows *s, double *a, quad_rows *out)
{
  if (!factor_mass(s)) {
    return false;
  }
  make_columns(s);
  wide gap = factor_rows(s, &out->rank);
  for (int i = 0; i < s->nv; i++) {
    s->y[i] = s->force[i];
  }
  solve_lower(s, s->y);
  for (int i = 0; i < s->nv; i++) {
    s->work[i] = s->y[i];
  }
  solve_upper(s, s->work);
  out->size = largest(s->work, s->nv);
  wide size = wide_root(dot(s->y, s->y, s->nv));
  move_onto_rows(s, out->rank);
  size += wide_root(dot(s->y, s->y, s->nv));
  out->conflict = largest_conflict(s, out->rank, size);
  out->kept = out->rank > 0 ? (double)smallest_singular_value(s, out->rank) : 1.0;
  out->distance = out->rank < s->nc ? (double)gap : out->kept;
  solve_upper(s, s->y);
  out->size = fmax(out->size, largest(s->y, s->nv));
  for (int i = 0; i < s->nv; i++) {
    a[i] = (double)s->y[i];
  }
  return true;
}

bool quad_rows_accelerate(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                          const double *v, double *a, quad_rows *out)
{
  system_of_rows s;
  bool done = begin(&s, nv, nc) && baum_workspace_mass(workspace, t, q, s.mass) == BAUM_OK &&
              baum_workspace_jacobian(workspace, t, q, s.jacobian) == BAUM_OK &&
              baum_workspace_force(workspace, t, q, v, s.force) == BAUM_OK &&
              baum_workspace_gamma(workspace, t, q, v, s.gamma) == BAUM_OK && solve(&s, a, out);
  finish(&s);
  return done;
}

bool quad_rows_project(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                       const double *v, double *projected, quad_rows *out)
{
  system_of_rows s;
  bool done = begin(&s, nv, nc) && baum_workspace_mass(workspace, t, q, s.mass) == BAUM_OK &&
              baum_workspace_jacobian(workspace, t, q, s.jacobian) == BAUM_OK;
  for (int i = 0; i < nv * nv && done; i++) {
    s.force[i / nv] += s.mass[i] * v[i % nv];
  }
  done = done && solve(&s, projected, out);
  finish(&s);
  return done;
}
