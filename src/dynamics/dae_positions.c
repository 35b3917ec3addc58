/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the Jacobian dF/dy + c dF/dy' with respect to q itself. It starts from the matrix T of
 * dae_matrix.c, whose variables are not q but displacements dx = N^+ dq of length nv. If q consists
 * of more numbers than there are displacements, dq may also point away from the manifold of valid
 * q. Such parts of dq change only the rows of q; their effect is the term B. The Jacobian is
 * therefore
 *
 *   L T R + B,   L = diag(N, I),   R = diag(N^+, I),
 *   B = c I - (N u)_q - N (c I - N^+ (N v)_q N) N^+   in the rows and columns of q
 *
 * Here u = v, or u = v - W^-1 J^T mu for the form GGL. N and B consist of one block for each
 * body.
 */
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "dynamics/dynamics.h"

/* Step by which q is changed in the central differences of N u. It is relative to the scale of q. N
 * is usually linear in q, and then the differences are exact for every step. */
static const double STEP = 1e-5;

/* The Jacobian while it is being computed. */
typedef struct widening {
  baum_workspace *w;
  const double *q;
  const double *u; /* (nv) */
  double c;
  int widest;      /* largest number of positions nq of a body */
  double *memory;  /* one block of memory that contains all arrays below */
  double *rate;    /* (nv x widest) row j: entries of column j of N for the body of velocity j */
  double *inverse; /* (nv x widest) row j: entries of row j of N^+ for the body of velocity j */
  double *bend;    /* (nq x widest) row i: entries of row i of (N u)_q for the body of position i */
  double *unit;    /* (nq) scratch memory for one vector */
  double *room;    /* (4 nq) scratch memory for results */
  /* Collects the positions of entries while the pattern is found; otherwise NULL. */
  baum_i_places *places;
  const int32_t *slot; /* while values are added, points to the slot of the next entry */
  double *values;
} widening;

static void emit(widening *x, int row, int column, double value)
{
  if (x->places) {
    baum_i_places_add(x->places, row, column);
  } else {
    x->values[*x->slot++] += value;
  }
}

/* ---- N, N^+ and (N u)_q ---- */

static const baum_i_body *body_of_position(const baum_mechanism *m, int i)
{
  int k = m->body_count;
  while (m->bodies[k]->q > i) {
    k--;
  }
  return m->bodies[k];
}

static void set_rates(const widening *x)
{
  const baum_mechanism *m = x->w->mechanism;
  for (int j = 0; j < m->nv; j++) {
    const baum_i_body *body = baum_i_velocity_body(m, j);
    memset(x->unit, 0, (size_t)m->nv * sizeof *x->unit);
    x->unit[j] = 1.0;
    baum_i_rate(m, x->q, x->unit, x->room);
    memcpy(x->rate + (ptrdiff_t)j * x->widest, x->room + body->q,
           (size_t)body->nq * sizeof *x->room);
  }
}

static void set_inverse(const widening *x)
{
  const baum_mechanism *m = x->w->mechanism;
  for (int i = 0; i < m->nq; i++) {
    const baum_i_body *body = body_of_position(m, i);
    memset(x->unit, 0, (size_t)m->nq * sizeof *x->unit);
    x->unit[i] = 1.0;
    const double *dx = baum_i_tangent(m, x->q, x->unit, x->room);
    for (int j = body->v; j < body->v + body->nv; j++) {
      x->inverse[j * x->widest + i - body->q] = dx[j];
    }
  }
}

static void set_bends(const widening *x)
{
  const baum_mechanism *m = x->w->mechanism;
  double *ahead = x->room;
  double *behind = x->room + m->nq;
  memcpy(x->unit, x->q, (size_t)m->nq * sizeof *x->q);
  for (int i = 0; i < m->nq; i++) {
    const baum_i_body *body = body_of_position(m, i);
    double h = STEP * m->position_scale[i];
    x->unit[i] = x->q[i] + h;
    baum_i_rate(m, x->unit, x->u, ahead);
    x->unit[i] = x->q[i] - h;
    baum_i_rate(m, x->unit, x->u, behind);
    x->unit[i] = x->q[i];
    for (int k = body->q; k < body->q + body->nq; k++) {
      x->bend[k * x->widest + i - body->q] = (ahead[k] - behind[k]) / (2.0 * h);
    }
  }
}

/* ---- the walk ---- */

/* The product L T R has more rows and columns than T. A row of T contributes to one or several rows
 * of the product. An image lists these rows of the product, and the factor by which the row of T is
 * multiplied for each of them. For a column of T, an image lists columns of the product. */
typedef struct image {
  int first;
  int count;
  const double *factor;
} image;

static image image_of(const widening *x, const double *factors, int i)
{
  static const double ONE = 1.0;
  const baum_mechanism *m = x->w->mechanism;
  if (i >= m->nv) {
    return (image){i - m->nv + m->nq, 1, &ONE};
  }
  const baum_i_body *body = baum_i_velocity_body(m, i);
  if (!body->manifold) {
    return (image){body->q + i - body->v, 1, &ONE};
  }
  return (image){body->q, body->nq, factors + (ptrdiff_t)i * x->widest};
}

static void walk_entry(widening *x, int i, int j, double value)
{
  image rows = image_of(x, x->rate, i);
  image columns = image_of(x, x->inverse, j);
  for (int r = 0; r < rows.count; r++) {
    for (int s = 0; s < columns.count; s++) {
      emit(x, rows.first + r, columns.first + s, rows.factor[r] * value * columns.factor[s]);
    }
  }
}

/* Return the entry of B at row r and column s of the block of a body. */
static double own_entry(const widening *x, const baum_i_body *body, int r, int s)
{
  double value = (r == s ? x->c : 0.0) - x->bend[(body->q + r) * x->widest + s];
  for (int i = 0; i < body->nv; i++) {
    for (int j = 0; j < body->nv; j++) {
      double inner = (i == j ? x->c : 0.0) - x->w->rate_q[body->mass + i * body->nv + j];
      value -=
        x->rate[(body->v + i) * x->widest + r] * inner * x->inverse[(body->v + j) * x->widest + s];
    }
  }
  return value;
}

static void walk(widening *x, const baum_i_residual_matrix *narrow, const double *values)
{
  const baum_mechanism *m = x->w->mechanism;
  const baum_i_compressed *columns = baum_i_residual_matrix_pattern(narrow);
  for (int j = 0; j < columns->n; j++) {
    for (int32_t k = columns->start[j]; k < columns->start[j + 1]; k++) {
      walk_entry(x, columns->row[k], j, values[k]);
    }
  }
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    for (int i = 0; body->manifold && i < body->nq * body->nq; i++) {
      int r = i / body->nq;
      int s = i % body->nq;
      emit(x, body->q + r, body->q + s, own_entry(x, body, r, s));
    }
  }
}

/* ---- the whole ---- */

static bool prepare(widening *x, const baum_dae *dae, const double *y)
{
  const baum_mechanism *m = x->w->mechanism;
  for (int k = 1; k <= m->body_count; k++) {
    x->widest = m->bodies[k]->nq > x->widest ? m->bodies[k]->nq : x->widest;
  }
  size_t nq = (size_t)m->nq;
  size_t wide = (size_t)x->widest;
  x->memory = baum_i_alloc(wide * (2 * (size_t)m->nv + nq) + 5 * nq, sizeof *x->memory);
  if (!x->memory) {
    return false;
  }
  x->rate = x->memory;
  x->inverse = x->rate + wide * (size_t)m->nv;
  x->bend = x->inverse + wide * (size_t)m->nv;
  x->unit = x->bend + wide * nq;
  x->room = x->unit + nq;
  x->q = y;
  x->u = y + nq;
  if (dae->index == BAUM_RESIDUAL_GGL) {
    x->u = baum_i_corrected_velocities(x->w, y + nq, y + nq + m->nv + m->nc);
  }
  if (!m->flat) {
    set_rates(x);
    set_inverse(x);
    set_bends(x);
  }
  return true;
}

static baum_status widen(widening *x, const baum_i_residual_matrix *narrow, const double *values,
                         int n, baum_sparse *out)
{
  baum_i_places places = {0};
  baum_i_compressed pattern;
  x->places = &places;
  walk(x, narrow, values);
  if (baum_i_compress(&places, n, &pattern) != BAUM_OK) {
    return baum_i_fail_memory();
  }
  out->nonzeros = pattern.start[n];
  if (out->columns) {
    memcpy(out->columns, pattern.start, ((size_t)n + 1) * sizeof *out->columns);
  }
  if (out->rows) {
    memcpy(out->rows, pattern.row, (size_t)out->nonzeros * sizeof *out->rows);
  }
  if (out->values) {
    memset(out->values, 0, (size_t)out->nonzeros * sizeof *out->values);
    x->places = NULL;
    x->values = out->values;
    x->slot = pattern.slot;
    walk(x, narrow, values);
  }
  baum_i_compressed_clear(&pattern);
  return BAUM_OK;
}

static baum_status make_wide(baum_workspace *w, const baum_dae *dae, double c, const double *y,
                             const baum_i_residual_matrix *narrow, const double *values,
                             baum_sparse *out)
{
  widening x = {.w = w, .c = c};
  baum_status status = prepare(&x, dae, y) ? BAUM_OK : baum_i_fail_memory();
  if (status == BAUM_OK) {
    status = widen(&x, narrow, values, baum_i_residual_size(w->mechanism, dae->index), out);
  }
  baum_i_free(x.memory);
  return status;
}

baum_status baum_i_residual_jacobian(baum_workspace *w, const baum_dae *dae, double c, double t,
                                     const double *y, const double *dy, baum_sparse *out)
{
  baum_i_residual_matrix *matrix = NULL;
  BAUM_I_TRY(baum_i_residual_matrix_create(w, dae->index, &matrix));
  const baum_i_compressed *pattern = baum_i_residual_matrix_pattern(matrix);
  double *values = baum_i_alloc((size_t)pattern->start[pattern->n], sizeof *values);
  baum_status status = values ? BAUM_OK : baum_i_fail_memory();
  if (status == BAUM_OK && out->values) {
    status = baum_i_residual_matrix_fill(matrix, w, dae, c, t, y, dy, values);
  }
  if (status == BAUM_OK) {
    status = make_wide(w, dae, c, y, matrix, values, out);
  }
  baum_i_free(values);
  baum_i_residual_matrix_destroy(matrix);
  return status;
}
