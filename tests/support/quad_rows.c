/* SPDX-License-Identifier: BSD-3-Clause */
#include "quad_rows.h"

#include <math.h>
#include <stdlib.h>

/* ---- memory ---- */

bool quad_equations_create(quad_equations *s, int nv, int nc)
{
  size_t v = (size_t)nv;
  size_t r = (size_t)nc;
  *s = (quad_equations){.nv = nv, .nc = nc};
  s->mass = calloc(2 * v * v + 2 * r * v + r * r + 3 * v + 4 * r + 1, sizeof *s->mass);
  s->order = calloc(r + 1, sizeof *s->order);
  if (!s->mass || !s->order) {
    return false;
  }
  s->jacobian = s->mass + v * v;
  s->force = s->jacobian + r * v;
  s->gamma = s->force + v;
  s->factor = s->gamma + r;
  s->w = s->factor + v * v;
  s->r = s->w + r * v;
  s->c = s->r + r * r;
  s->length = s->c + r;
  s->y = s->length + r;
  s->work = s->y + v;
  return true;
}

void quad_equations_destroy(quad_equations *s)
{
  free(s->mass);
  free(s->order);
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

static bool factor_mass(const quad_equations *s)
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

/* Replaces x by L^-1 x. */
static void solve_lower(const quad_equations *s, wide *x)
{
  for (int i = 0; i < s->nv; i++) {
    const wide *row = s->factor + (size_t)i * (size_t)s->nv;
    x[i] = (x[i] - dot(row, x, i)) / row[i];
  }
}

/* Replaces x by L^-T x. */
static void solve_upper(const quad_equations *s, wide *x)
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

static wide *column(const quad_equations *s, int k)
{
  return s->w + (size_t)k * (size_t)s->nv;
}

static wide *entry(const quad_equations *s, int i, int k)
{
  return &s->r[i * s->nc + k];
}

static void make_columns(const quad_equations *s)
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
    s->length[k] = length > 0 ? length : 1;
    s->c[k] = s->gamma[k] / s->length[k];
    s->order[k] = k;
  }
}

static void exchange(wide *a, wide *b)
{
  wide kept = *a;
  *a = *b;
  *b = kept;
}

static void bring_up(const quad_equations *s, int k, int best)
{
  for (int i = 0; i < s->nv; i++) {
    exchange(&column(s, k)[i], &column(s, best)[i]);
  }
  for (int i = 0; i < k; i++) {
    exchange(entry(s, i, k), entry(s, i, best));
  }
  exchange(&s->c[k], &s->c[best]);
  int kept = s->order[k];
  s->order[k] = s->order[best];
  s->order[best] = kept;
}

/* Subtracts from all later columns their components along column k. This column has unit length.
 * The subtraction is made twice, because rounding leaves small components in the first pass. */
static void take_out(const quad_equations *s, int k)
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

/* Computes Q and R, with pivoting. If the remaining columns are dependent, the function stops and
 * returns the length of the longest of them. If all columns are independent, it returns 0. */
static wide factor_rows(const quad_equations *s, int *rank)
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

/* Solves a system with R^T, using only the first `rank` rows and columns of R. */
static void solve_transposed(const quad_equations *s, int rank, wide *x)
{
  for (int k = 0; k < rank; k++) {
    for (int i = 0; i < k; i++) {
      x[k] -= *entry(s, i, k) * x[i];
    }
    x[k] /= *entry(s, k, k);
  }
}

/* Solves a system with R in the same way. */
static void solve_straight(const quad_equations *s, int rank, wide *x)
{
  for (int i = rank - 1; i >= 0; i--) {
    for (int k = i + 1; k < rank; k++) {
      x[i] -= *entry(s, i, k) * x[k];
    }
    x[i] /= *entry(s, i, i);
  }
}

/* Makes ten inverse iterations with R^T R. The result is accurate to one or two digits. */
static wide smallest_singular_value(const quad_equations *s, int rank)
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

/* Moves y to the nearest point that satisfies the independent rows. At the beginning, y is L^-1
 * g. */
static void move_onto_rows(const quad_equations *s, int rank)
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

/* Returns the largest conflict |w^T y - c| of the dependent rows. For each of them, the column w of
 * W is Q times a column of R. */
static double largest_conflict(const quad_equations *s, int rank, wide size)
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

bool quad_equations_solve(quad_equations *s, wide *a, quad_rows *out)
{
  if (!factor_mass(s)) {
    return false;
  }
  make_columns(s);
  wide gap = factor_rows(s, &out->rank);
  s->rank = out->rank;
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
  for (int i = 0; i < s->nv; i++) {
    a[i] = s->y[i];
  }
  solve_upper(s, a);
  out->size = fmax(out->size, largest(a, s->nv));
  return true;
}

/* Computes the multipliers of the original rows from the multipliers of the scaled rows, which are
 * in s->work. */
static void unscale(const quad_equations *s, wide *lambda)
{
  for (int k = 0; k < s->nc; k++) {
    lambda[s->order[k]] = k < s->rank ? s->work[k] / s->length[s->order[k]] : 0;
  }
}

/* Solves W lambda = L^-1 g - y in the space spanned by Q. */
void quad_equations_multipliers(const quad_equations *s, wide *lambda)
{
  wide *rest = s->work + s->nc;
  for (int i = 0; i < s->nv; i++) {
    rest[i] = s->force[i];
  }
  solve_lower(s, rest);
  for (int i = 0; i < s->nv; i++) {
    rest[i] -= s->y[i];
  }
  for (int k = 0; k < s->rank; k++) {
    s->work[k] = dot(column(s, k), rest, s->nv);
  }
  solve_straight(s, s->rank, s->work);
  unscale(s, lambda);
}

void quad_equations_null(const quad_equations *s, int k, wide *lambda)
{
  int behind = s->rank + k;
  for (int i = 0; i < s->rank; i++) {
    s->work[i] = -*entry(s, i, behind);
  }
  solve_straight(s, s->rank, s->work);
  unscale(s, lambda);
  lambda[s->order[behind]] = 1 / s->length[s->order[behind]];
}

/* ---- the equations that the library provides ---- */

typedef struct read_equations {
  double *mass;
  double *jacobian;
  double *force;
  double *gamma;
} read_equations;

static bool begin(quad_equations *s, read_equations *read, int nv, int nc)
{
  size_t v = (size_t)nv;
  size_t r = (size_t)nc;
  read->mass = calloc(v * v + r * v + v + r + 1, sizeof *read->mass);
  if (!quad_equations_create(s, nv, nc) || !read->mass) {
    return false;
  }
  read->jacobian = read->mass + v * v;
  read->force = read->jacobian + r * v;
  read->gamma = read->force + v;
  return true;
}

static bool solve(quad_equations *s, const read_equations *read, double *a, quad_rows *out)
{
  size_t count = (size_t)(s->nv * s->nv + s->nc * s->nv + s->nv + s->nc);
  for (size_t i = 0; i < count; i++) { /* this covers mass, jacobian, force and gamma */
    s->mass[i] = read->mass[i];
  }
  wide *found = calloc((size_t)s->nv + 1, sizeof *found);
  bool done = found && quad_equations_solve(s, found, out);
  for (int i = 0; i < s->nv && done; i++) {
    a[i] = (double)found[i];
  }
  free(found);
  return done;
}

static void finish(quad_equations *s, read_equations *read)
{
  quad_equations_destroy(s);
  free(read->mass);
}

bool quad_rows_accelerate(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                          const double *v, double *a, quad_rows *out)
{
  quad_equations s;
  read_equations read;
  bool done =
    begin(&s, &read, nv, nc) && baum_workspace_mass(workspace, t, q, read.mass) == BAUM_OK &&
    baum_workspace_jacobian(workspace, t, q, read.jacobian) == BAUM_OK &&
    baum_workspace_force(workspace, t, q, v, read.force) == BAUM_OK &&
    baum_workspace_gamma(workspace, t, q, v, read.gamma) == BAUM_OK && solve(&s, &read, a, out);
  finish(&s, &read);
  return done;
}

/* Skipped rows are set to zero. A row of zeros is dependent, so it does not change the rank. */
bool quad_rows_rank(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                    const bool *skipped, quad_rows *out)
{
  quad_equations s;
  read_equations read;
  double *unused = calloc((size_t)nv + 1, sizeof *unused);
  bool done = begin(&s, &read, nv, nc) && unused &&
              baum_workspace_mass(workspace, t, q, read.mass) == BAUM_OK &&
              baum_workspace_jacobian(workspace, t, q, read.jacobian) == BAUM_OK;
  for (int i = 0; i < nc * nv && done; i++) {
    read.jacobian[i] = skipped[i / nv] ? 0.0 : read.jacobian[i];
  }
  done = done && solve(&s, &read, unused, out);
  finish(&s, &read);
  free(unused);
  return done;
}

bool quad_rows_project(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                       const double *v, double *projected, quad_rows *out)
{
  quad_equations s;
  read_equations read;
  bool done = begin(&s, &read, nv, nc) &&
              baum_workspace_mass(workspace, t, q, read.mass) == BAUM_OK &&
              baum_workspace_jacobian(workspace, t, q, read.jacobian) == BAUM_OK;
  for (int i = 0; i < nv * nv && done; i++) {
    read.force[i / nv] += read.mass[i] * v[i % nv];
  }
  done = done && solve(&s, &read, projected, out);
  finish(&s, &read);
  return done;
}
