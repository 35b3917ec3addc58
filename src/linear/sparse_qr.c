/* SPDX-License-Identifier: BSD-3-Clause */
/* Factors a sparse m x n matrix A = Q R by Householder reflections and finds its rank.
 *
 * Structure. Columns are numbered in their order of elimination. The Cholesky factor of A^T A
 * contains the pattern of R (George & Heath 1980). The columns form a tree with
 *
 *   parent(k) = min { j > k : R_kj may be non-zero }
 *
 * R_kj may be non-zero if k is on the path in the tree from the first column of a row of A up to
 * another column j of that row (Liu 1986). A chain of columns and parents whose rows of R have
 * nearly the same pattern is eliminated in one dense matrix, a front (Duff & Reid 1983; Davis 2006,
 * 2011). The columns of the chain are the pivots of the front. A row begins with the first column
 * of its pattern. A front consists of the rows of A that begin with a pivot of the front, and of
 * the rows that its child fronts pass on. Rows are ordered by the column with which they begin:
 *
 *     pivots  others
 *   [ R   R | R  R  R ]   independent pivots: rows of R
 *   [ v   R | R  R  R ]
 *   [     v | r  r  r ]   remaining rows, passed to the parent
 *   [     v | v  r  r ]
 *   [       | v  v  r ]   v: vectors of the reflections 1 - tau v v^T
 *
 * Rank (Heath 1982). A pivot column whose remaining norm is at most the tolerance has neither a
 * reflection nor a row of R; its rows are passed to later columns. The remaining norm of a column
 * depends only on its descendants in the tree, so the rank is the same as if columns were
 * eliminated one by one in the given order.
 *
 * Memory. The other columns of a front are also reduced to a triangle, so the front passes on at
 * most as many rows as it has other columns, even if pivots are dependent. All sizes are therefore
 * known in advance.
 *
 *   A. George, M. T. Heath, Linear Algebra Appl. 34 (1980) 69-83
 *   I. S. Duff, J. K. Reid, ACM Trans. Math. Softw. 9 (1983) 302-325
 *   M. T. Heath, SIAM J. Sci. Stat. Comput. 3 (1982) 223-237
 *   J. W. H. Liu, ACM Trans. Math. Softw. 12 (1986) 127-148
 *   T. A. Davis, Direct Methods for Sparse Linear Systems, SIAM 2006;
 *                ACM Trans. Math. Softw. 38 (2011) 8:1-22 */
#include "linear/sparse_qr.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/pair.h"

enum { NONE = -1 };

/* If a row of R has p entries in its pattern, the front of this row has at most p + p / SLACK_SHARE
 * + SLACK columns. */
enum { SLACK_SHARE = 4, SLACK = 4 };

typedef struct front {
  int32_t parent; /* this and the next three: index of a front or of a row of A, or NONE */
  int32_t first_child;
  int32_t next_child;
  int32_t first_row; /* first row of A that begins with a pivot of this front */
  int32_t rows;      /* largest possible number of rows */
  int32_t columns;
  int32_t pivots; /* number of pivots, which are the first columns */
  int32_t *place; /* (columns) position of each column in the order of elimination, ascending */
  int32_t *end;   /* (columns) number of rows that begin with this or an earlier column */
  /* (columns) number of reflections up to and including this column */
  int32_t *done;
  int32_t *row;  /* (rows) index of each row in vectors of length m */
  double *tau;   /* (columns) tau of the reflection of each column */
  double *value; /* (rows x columns) row-major */
} front;

struct baum_i_sparse_qr {
  int32_t m;
  int32_t n;
  int32_t front_count;
  front *fronts;      /* each parent after its children */
  int32_t *memory;    /* memory of the six arrays below */
  int32_t *order;     /* (n) the columns of A in their order of elimination */
  int32_t *position;  /* (n) index of each column in the present front */
  int32_t *row_start; /* (m + 1) start of each row of A in place[] and source[] */
  int32_t *next_row;  /* (m) next row that begins in the same front, or NONE */
  int32_t *place;     /* (entries) */
  int32_t *source;    /* (entries) index in the values of A */
  double *work;       /* (max(m, n)) */
  int32_t *indices;   /* of all fronts */
  double *numbers;    /* of all fronts */
};

/* ---- structure ---- */

/* Data needed only while the structure is found. */
typedef struct plan {
  const baum_i_sparse_columns *pattern;
  int32_t *memory;   /* memory of the six arrays below, (n) each */
  int32_t *parent;   /* parent of each column, or NONE */
  int32_t *mark;     /* mark of a search */
  int32_t *count;    /* number of entries in each row of R */
  int32_t *below;    /* child of each column in the same front, or NONE */
  int32_t *front_of; /* front of each column */
  int32_t *listed;   /* number of columns listed so far in each front */
} plan;

static void fill(int32_t *x, int32_t count, int32_t value)
{
  for (int32_t i = 0; i < count; i++) {
    x[i] = value;
  }
}

static void list_rows(baum_i_sparse_qr *qr, const baum_i_sparse_columns *pattern)
{
  int32_t *next = qr->next_row; /* scratch */
  for (int32_t e = 0; e < pattern->start[qr->n]; e++) {
    qr->row_start[pattern->row[e] + 1]++;
  }
  for (int32_t i = 0; i < qr->m; i++) {
    next[i] = qr->row_start[i];
    qr->row_start[i + 1] += qr->row_start[i];
  }
  for (int32_t k = 0; k < qr->n; k++) {
    int32_t j = qr->order[k];
    for (int32_t e = pattern->start[j]; e < pattern->start[j + 1]; e++) {
      int32_t entry = next[pattern->row[e]]++;
      qr->place[entry] = k;
      qr->source[entry] = e;
    }
  }
}

static int32_t first_of_row(const baum_i_sparse_qr *qr, int32_t row)
{
  return qr->place[qr->row_start[row]];
}

/* Finds the tree. Each row of A connects each of its columns with the next one. mark[i] is a known
 * ancestor of column i, a shortcut to its present root. */
static void find_parents(const baum_i_sparse_qr *qr, plan *p)
{
  int32_t *last = qr->next_row; /* scratch: last column of each row so far */
  fill(last, qr->m, NONE);
  for (int32_t k = 0; k < qr->n; k++) {
    p->parent[k] = p->mark[k] = NONE;
    int32_t j = qr->order[k];
    for (int32_t e = p->pattern->start[j]; e < p->pattern->start[j + 1]; e++) {
      int32_t row = p->pattern->row[e];
      for (int32_t i = last[row], up; i != NONE && i != k; i = up) {
        up = p->mark[i];
        p->mark[i] = k;
        p->parent[i] = up == NONE ? k : p->parent[i];
      }
      last[row] = k;
    }
  }
}

/* Adds column k to the pattern of row i of R, and to the front of i if fronts exist. */
static void add_to_pattern(const baum_i_sparse_qr *qr, plan *p, int32_t i, int32_t k)
{
  p->mark[i] = k;
  p->count[i]++;
  if (qr->indices) {
    int32_t *place = qr->fronts[p->front_of[i]].place;
    int32_t *listed = &p->listed[p->front_of[i]];
    if (*listed == 0 || place[*listed - 1] != k) {
      place[(*listed)++] = k;
    }
  }
}

static void find_patterns(const baum_i_sparse_qr *qr, plan *p)
{
  fill(p->mark, qr->n, NONE);
  fill(p->count, qr->n, 0);
  for (int32_t k = 0; k < qr->n; k++) {
    int32_t j = qr->order[k];
    add_to_pattern(qr, p, k, k);
    for (int32_t e = p->pattern->start[j]; e < p->pattern->start[j + 1]; e++) {
      int32_t i = first_of_row(qr, p->pattern->row[e]);
      for (; p->mark[i] != k; i = p->parent[i]) {
        add_to_pattern(qr, p, i, k);
      }
    }
  }
}

/* Joins columns and their parents into fronts, as long as a front is only slightly wider than the
 * pattern of each of its rows of R. */
static void find_fronts(baum_i_sparse_qr *qr, plan *p)
{
  int32_t *length = p->mark;    /* length of the chain up to each column */
  int32_t *least = p->front_of; /* least `count` in this chain */
  fill(p->below, qr->n, NONE);
  for (int32_t k = 0; k < qr->n; k++) {
    int32_t below = p->below[k];
    int32_t up = p->parent[k];
    length[k] = below == NONE ? 1 : length[below] + 1;
    least[k] = below == NONE || p->count[k] < least[below] ? p->count[k] : least[below];
    if (up != NONE && length[k] + p->count[up] <= least[k] + least[k] / SLACK_SHARE + SLACK) {
      p->below[up] = k;
    }
  }
  for (int32_t k = 0; k < qr->n; k++) {
    bool is_top = p->parent[k] == NONE || p->below[p->parent[k]] != k;
    p->front_of[k] = is_top ? qr->front_count++ : NONE;
  }
  for (int32_t k = qr->n - 1; k >= 0; k--) {
    p->front_of[k] = p->front_of[k] == NONE ? p->front_of[p->parent[k]] : p->front_of[k];
  }
}

/* Makes two lists for each front: its children, and the rows that enter at this front. The lists
 * are filled from the end, so that they ascend. */
static void link_fronts(baum_i_sparse_qr *qr, const plan *p)
{
  for (int32_t f = 0; f < qr->front_count; f++) {
    qr->fronts[f].parent = qr->fronts[f].first_child = qr->fronts[f].first_row = NONE;
  }
  for (int32_t k = qr->n - 1; k >= 0; k--) {
    front *f = &qr->fronts[p->front_of[k]];
    f->columns += f->pivots++ == 0 ? p->count[k] : 1; /* the first column found is the top column */
    int32_t up = p->parent[k] == NONE ? NONE : p->front_of[p->parent[k]];
    if (up != NONE && up != p->front_of[k]) {
      f->parent = up;
      f->next_child = qr->fronts[up].first_child;
      qr->fronts[up].first_child = p->front_of[k];
    }
  }
  for (int32_t i = qr->m - 1; i >= 0; i--) {
    if (qr->row_start[i] < qr->row_start[i + 1]) {
      front *f = &qr->fronts[p->front_of[first_of_row(qr, i)]];
      qr->next_row[i] = f->first_row;
      f->first_row = i;
      f->rows++;
    }
  }
}

static bool make_room(baum_i_sparse_qr *qr)
{
  size_t indices = 0;
  size_t numbers = 0;
  for (front *f = qr->fronts; f < qr->fronts + qr->front_count; f++) {
    int32_t left = f->columns - f->pivots;
    if (f->parent != NONE) {
      qr->fronts[f->parent].rows += f->rows < left ? f->rows : left;
    }
    indices += 3 * (size_t)f->columns + (size_t)f->rows;
    numbers += (size_t)f->columns * (1 + (size_t)f->rows);
  }
  qr->indices = baum_i_alloc(indices, sizeof *qr->indices);
  qr->numbers = baum_i_alloc(numbers, sizeof *qr->numbers);
  if (!qr->indices || !qr->numbers) {
    return false;
  }
  int32_t *index = qr->indices;
  double *number = qr->numbers;
  for (front *f = qr->fronts; f < qr->fronts + qr->front_count; f++) {
    f->place = index;
    f->end = f->place + f->columns;
    f->done = f->end + f->columns;
    f->row = f->done + f->columns;
    index = f->row + f->rows;
    f->tau = number;
    f->value = f->tau + f->columns;
    number = f->value + (size_t)f->rows * (size_t)f->columns;
  }
  return true;
}

/* Parts of baum_i_sparse_qr_create(). They return false when out of memory. */
static bool copy_pattern(baum_i_sparse_qr *qr, const baum_i_sparse_columns *pattern,
                         const int32_t *order)
{
  size_t m = (size_t)pattern->rows;
  size_t n = (size_t)pattern->columns;
  size_t entries = (size_t)pattern->start[n];
  qr->m = pattern->rows;
  qr->n = pattern->columns;
  qr->work = baum_i_alloc(m > n ? m : n, sizeof *qr->work);
  qr->memory = baum_i_alloc(2 * (n + m + entries) + 1, sizeof *qr->memory);
  if (!qr->work || !qr->memory) {
    return false;
  }
  qr->order = qr->memory;
  qr->position = qr->order + n;
  qr->row_start = qr->position + n;
  qr->next_row = qr->row_start + m + 1;
  qr->place = qr->next_row + m;
  qr->source = qr->place + entries;
  for (int32_t k = 0; k < qr->n; k++) {
    qr->order[k] = order ? order[k] : k;
  }
  list_rows(qr, pattern);
  return true;
}

static bool make_plan(const baum_i_sparse_qr *qr, const baum_i_sparse_columns *pattern, plan *p)
{
  size_t n = (size_t)qr->n;
  *p = (plan){.pattern = pattern, .memory = baum_i_alloc(6 * n, sizeof *p->memory)};
  if (!p->memory) {
    return false;
  }
  p->parent = p->memory;
  p->mark = p->parent + n;
  p->count = p->mark + n;
  p->below = p->count + n;
  p->front_of = p->below + n;
  p->listed = p->front_of + n;
  return true;
}

static bool lay_out(baum_i_sparse_qr *qr, plan *p)
{
  find_parents(qr, p);
  find_patterns(qr, p);
  find_fronts(qr, p);
  qr->fronts = baum_i_alloc((size_t)qr->front_count, sizeof *qr->fronts);
  if (!qr->fronts) {
    return false;
  }
  link_fronts(qr, p);
  if (!make_room(qr)) {
    return false;
  }
  find_patterns(qr, p);
  return true;
}

void baum_i_sparse_qr_destroy(baum_i_sparse_qr *qr)
{
  if (!qr) {
    return;
  }
  baum_i_free(qr->fronts);
  baum_i_free(qr->memory);
  baum_i_free(qr->work);
  baum_i_free(qr->indices);
  baum_i_free(qr->numbers);
  baum_i_free(qr);
}

baum_status baum_i_sparse_qr_create(const baum_i_sparse_columns *pattern, const int32_t *order,
                                    baum_i_sparse_qr **out)
{
  plan p = {0};
  baum_i_sparse_qr *qr = baum_i_alloc(1, sizeof *qr);
  bool done =
    qr && copy_pattern(qr, pattern, order) && make_plan(qr, pattern, &p) && lay_out(qr, &p);
  baum_i_free(p.memory);
  if (!done) {
    baum_i_sparse_qr_destroy(qr);
    qr = NULL;
  }
  *out = qr;
  return qr ? BAUM_OK : BAUM_ERR_MEMORY;
}

/* ---- factorization ---- */

static double *row_of(const front *f, int32_t i)
{
  return f->value + (ptrdiff_t)i * f->columns;
}

/* Tells whether column j has a reflection. If so, row done[j] - 1 of the front is the row of R or r
 * (see the figure at the top of this file) that belongs to column j. */
static bool is_reduced(const front *f, int32_t j)
{
  return f->done[j] > (j > 0 ? f->done[j - 1] : 0);
}

static const front *front_at(const baum_i_sparse_qr *qr, int32_t index)
{
  return index == NONE ? NULL : &qr->fronts[index];
}

/* Sets end[j] to the first of the rows that begin with column j. Returns the number of rows. */
static int32_t count_rows(const baum_i_sparse_qr *qr, const front *f)
{
  fill(f->end, f->columns, 0);
  for (int32_t i = f->first_row; i != NONE; i = qr->next_row[i]) {
    f->end[qr->position[first_of_row(qr, i)]]++;
  }
  for (const front *c = front_at(qr, f->first_child); c; c = front_at(qr, c->next_child)) {
    for (int32_t j = c->pivots; j < c->columns; j++) {
      f->end[qr->position[c->place[j]]] += is_reduced(c, j);
    }
  }
  int32_t begin = 0;
  for (int32_t j = 0; j < f->columns; j++) {
    int32_t count = f->end[j];
    f->end[j] = begin;
    begin += count;
  }
  return begin;
}

/* Loads row i of A, and increments `end` of its first column. */
static void load_row(const baum_i_sparse_qr *qr, const double *values, int32_t i, const front *f)
{
  int32_t row = f->end[qr->position[first_of_row(qr, i)]]++;
  f->row[row] = i;
  for (int32_t e = qr->row_start[i]; e < qr->row_start[i + 1]; e++) {
    row_of(f, row)[qr->position[qr->place[e]]] = values[qr->source[e]];
  }
}

/* Loads the rows that a child front passes on. */
static void load_child(const baum_i_sparse_qr *qr, const front *c, const front *f)
{
  for (int32_t j = c->pivots; j < c->columns; j++) {
    if (!is_reduced(c, j)) {
      continue;
    }
    int32_t from = c->done[j] - 1;
    int32_t row = f->end[qr->position[c->place[j]]]++;
    f->row[row] = c->row[from];
    for (int32_t k = j; k < c->columns; k++) {
      row_of(f, row)[qr->position[c->place[k]]] = row_of(c, from)[k];
    }
  }
}

static void assemble(const baum_i_sparse_qr *qr, const double *values, const front *f)
{
  for (int32_t j = 0; j < f->columns; j++) {
    qr->position[f->place[j]] = j;
  }
  size_t rows = (size_t)count_rows(qr, f);
  memset(f->value, 0, rows * (size_t)f->columns * sizeof *f->value);
  for (int32_t i = f->first_row; i != NONE; i = qr->next_row[i]) {
    load_row(qr, values, i, f);
  }
  for (const front *c = front_at(qr, f->first_child); c; c = front_at(qr, c->next_child)) {
    load_child(qr, c, f);
  }
}

static double sum_of_squares(const front *f, int32_t j, int32_t first)
{
  double sum = 0.0;
  for (int32_t i = first; i < f->end[j]; i++) {
    sum += row_of(f, i)[j] * row_of(f, i)[j];
  }
  return sum;
}

/* Replaces column j from row `first` on by R_jj, v_1, v_2, ... (v_0 is 1). Returns tau. */
static double make_reflection(const front *f, int32_t j, int32_t first, double length)
{
  double *x = &row_of(f, first)[j];
  double before = *x;
  *x = before > 0.0 ? -length : length;
  for (int32_t i = first + 1; i < f->end[j]; i++) {
    row_of(f, i)[j] /= before - *x;
  }
  return (*x - before) / *x;
}

/* row += factor * other, from column j on */
static void add_row(double factor, const double *restrict other, int32_t j, int32_t columns,
                    double *restrict row)
{
  int32_t k = j;
  for (; k + 1 < columns; k += 2) {
    baum_i_store(row + k, baum_i_load(row + k) + factor * baum_i_load(other + k));
  }
  if (k < columns) {
    row[k] += factor * other[k];
  }
}

/* Applies the reflection of column j to all later columns. sum (columns) is scratch memory. */
static void reflect(const front *f, int32_t j, int32_t first, double *sum)
{
  double *top = row_of(f, first);
  memcpy(sum, top, (size_t)f->columns * sizeof *sum);
  for (int32_t i = first + 1; i < f->end[j]; i++) {
    add_row(row_of(f, i)[j], row_of(f, i), j + 1, f->columns, sum);
  }
  add_row(-f->tau[j], sum, j + 1, f->columns, top);
  for (int32_t i = first + 1; i < f->end[j]; i++) {
    add_row(-f->tau[j] * row_of(f, i)[j], sum, j + 1, f->columns, row_of(f, i));
  }
}

static void reduce(const front *f, double tolerance, double *sum)
{
  int32_t done = 0;
  for (int32_t j = 0; j < f->columns; j++) {
    double first = done < f->end[j] ? row_of(f, done)[j] : 0.0;
    double below = sum_of_squares(f, j, done + 1);
    double length = sqrt(first * first + below);
    if (length > (j < f->pivots ? tolerance : 0.0)) {
      f->tau[j] = below > 0.0 ? make_reflection(f, j, done, length) : 0.0;
      if (below > 0.0) {
        reflect(f, j, done, sum);
      }
      done++;
    }
    f->done[j] = done;
  }
}

int32_t baum_i_sparse_qr_factor(baum_i_sparse_qr *qr, const double *values, double tolerance,
                                unsigned char *independent)
{
  int32_t rank = 0;
  for (const front *f = qr->fronts; f < qr->fronts + qr->front_count; f++) {
    assemble(qr, values, f);
    reduce(f, tolerance, qr->work);
    rank += f->done[f->pivots - 1];
    for (int32_t j = 0; j < f->pivots && independent; j++) {
      independent[qr->order[f->place[j]]] = is_reduced(f, j);
    }
  }
  return rank;
}

/* ---- solve and project ---- */

/* Applies the reflection of column j to x, if there is one. */
static void reflect_by(const front *f, int32_t j, double *x)
{
  if (!is_reduced(f, j)) {
    return;
  }
  int32_t first = f->done[j] - 1;
  double sum = x[f->row[first]];
  for (int32_t i = first + 1; i < f->end[j]; i++) {
    sum += row_of(f, i)[j] * x[f->row[i]];
  }
  sum *= f->tau[j];
  x[f->row[first]] -= sum;
  for (int32_t i = first + 1; i < f->end[j]; i++) {
    x[f->row[i]] -= sum * row_of(f, i)[j];
  }
}

/* x <- Q^T x */
static void multiply_transposed(const baum_i_sparse_qr *qr, double *x)
{
  for (const front *f = qr->fronts; f < qr->fronts + qr->front_count; f++) {
    for (int32_t j = 0; j < f->columns; j++) {
      reflect_by(f, j, x);
    }
  }
}

/* x <- Q x */
static void multiply(const baum_i_sparse_qr *qr, double *x)
{
  for (int32_t i = qr->front_count - 1; i >= 0; i--) {
    for (int32_t j = qr->fronts[i].columns - 1; j >= 0; j--) {
      reflect_by(&qr->fronts[i], j, x);
    }
  }
}

/* Solves R x = y = Q^T b for x (n), in the order of elimination. x is zero in dependent columns. */
static void solve_triangle(const baum_i_sparse_qr *qr, const double *y, double *x)
{
  for (int32_t i = qr->front_count - 1; i >= 0; i--) {
    const front *f = &qr->fronts[i];
    for (int32_t j = f->pivots - 1; j >= 0; j--) {
      double *unknown = &x[f->place[j]];
      *unknown = 0.0;
      if (is_reduced(f, j)) {
        const double *row = row_of(f, f->done[j] - 1);
        double sum = y[f->row[f->done[j] - 1]];
        for (int32_t k = j + 1; k < f->columns; k++) {
          sum -= row[k] * x[f->place[k]];
        }
        *unknown = sum / row[j];
      }
    }
  }
}

void baum_i_sparse_qr_solve(baum_i_sparse_qr *qr, double *x)
{
  multiply_transposed(qr, x);
  solve_triangle(qr, x, qr->work);
  for (int32_t k = 0; k < qr->n; k++) {
    x[qr->order[k]] = qr->work[k];
  }
}

void baum_i_sparse_qr_project(baum_i_sparse_qr *qr, double *x)
{
  multiply_transposed(qr, x);
  memset(qr->work, 0, (size_t)qr->m * sizeof *qr->work);
  for (const front *f = qr->fronts; f < qr->fronts + qr->front_count; f++) {
    for (int32_t i = 0; i < f->done[f->pivots - 1]; i++) {
      qr->work[f->row[i]] = x[f->row[i]];
    }
  }
  memcpy(x, qr->work, (size_t)qr->m * sizeof *x);
  multiply(qr, x);
}
