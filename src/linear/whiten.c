/* SPDX-License-Identifier: BSD-3-Clause */
#include "linear/whiten.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

/* A tensor is whitened if, in its Cholesky factorization, less than this fraction of a diagonal
 * entry remains. */
static const double SLENDER = 1e-4;

/* A body in space has SIZE velocities; the velocities from FIRST_TURN on are angular. */
enum { SIZE = 6, FIRST_TURN = 3 };

typedef struct white_body {
  bool slender;
  double l[9];
} white_body;

struct baum_i_whitening {
  const baum_i_kkt_structure *structure;
  white_body *bodies;         /* (mass_block_count) */
  const white_body **columns; /* (nv) body whose first angular velocity is this column, or NULL */
  double *numbers;            /* memory of both arrays below */
  double *mass;
  double *jacobian;
};

/* ---- create ---- */

static size_t larger(size_t x, size_t y)
{
  return x > y ? x : y;
}

/* Blocks may be out of order, with gaps between their values. */
static size_t mass_size(const baum_i_kkt_structure *s)
{
  size_t size = 0;
  for (int b = 0; b < s->mass_block_count; b++) {
    const baum_i_mass_block *block = &s->mass_blocks[b];
    size = larger(size, (size_t)block->value + (size_t)block->size * (size_t)block->size);
  }
  return size;
}

static size_t jacobian_size(const baum_i_kkt_structure *s)
{
  size_t size = 0;
  for (int b = 0; b < s->row_block_count; b++) {
    const baum_i_row_block *block = &s->row_blocks[b];
    size = larger(size, (size_t)block->value + (size_t)block->rows * (size_t)block->cols);
  }
  return size;
}

/* Removes bodies whose angular velocities are not adjacent columns in a block of J that contains
 * them. */
static void check_columns(const baum_i_whitening *w)
{
  const baum_i_kkt_structure *s = w->structure;
  for (int b = 0; b < s->row_block_count; b++) {
    const baum_i_row_block *block = &s->row_blocks[b];
    for (int i = 0; i < block->cols; i++) {
      int column = block->col[i];
      bool whole =
        i + 2 < block->cols && block->col[i + 1] == column + 1 && block->col[i + 2] == column + 2;
      w->columns[column] = whole ? w->columns[column] : NULL;
    }
  }
}

static baum_status fill(baum_i_whitening *w)
{
  const baum_i_kkt_structure *s = w->structure;
  w->bodies = baum_i_alloc((size_t)s->mass_block_count, sizeof *w->bodies);
  w->columns = baum_i_alloc((size_t)s->nv, sizeof(const white_body *));
  w->numbers = baum_i_alloc(mass_size(s) + jacobian_size(s), sizeof *w->numbers);
  if (!w->bodies || !w->columns || !w->numbers) {
    return BAUM_ERR_MEMORY;
  }
  w->mass = w->numbers;
  w->jacobian = w->numbers + mass_size(s);
  for (int b = 0; b < s->mass_block_count; b++) {
    if (s->mass_blocks[b].size == SIZE) {
      w->columns[s->mass_blocks[b].first + FIRST_TURN] = &w->bodies[b];
    }
  }
  check_columns(w);
  return BAUM_OK;
}

baum_status baum_i_whitening_create(const baum_i_kkt_structure *structure, baum_i_whitening **out)
{
  bool in_space = false;
  *out = NULL;
  for (int b = 0; b < structure->mass_block_count; b++) {
    in_space = in_space || structure->mass_blocks[b].size == SIZE;
  }
  if (!in_space) {
    return BAUM_OK;
  }
  baum_i_whitening *w = baum_i_alloc(1, sizeof *w);
  if (!w) {
    return BAUM_ERR_MEMORY;
  }
  w->structure = structure;
  baum_status status = fill(w);
  if (status != BAUM_OK) {
    baum_i_whitening_destroy(w);
    return status;
  }
  *out = w;
  return BAUM_OK;
}

void baum_i_whitening_destroy(baum_i_whitening *whitening)
{
  if (whitening) {
    baum_i_free(whitening->bodies);
    baum_i_free(whitening->columns);
    baum_i_free(whitening->numbers);
    baum_i_free(whitening);
  }
}

/* ---- set ---- */

/* Tells whether angular velocities are coupled with each other, but not with the translational
 * velocities. */
static bool has_full_tensor(const double *m)
{
  bool coupled = false;
  for (int i = 0; i < FIRST_TURN; i++) {
    for (int j = FIRST_TURN; j < SIZE; j++) {
      coupled = coupled || m[SIZE * i + j] != 0.0 || m[SIZE * j + i] != 0.0;
    }
  }
  const double *tensor = m + SIZE * FIRST_TURN + FIRST_TURN;
  return !coupled && (tensor[1] != 0.0 || tensor[2] != 0.0 || tensor[SIZE + 2] != 0.0);
}

/* Computes L. Returns whether the tensor is nearly singular, but positive definite. */
static bool factor_slender(const double *m, double l[9])
{
  bool slender = false;
  for (int i = 0; i < 3; i++) {
    const double *row = m + (ptrdiff_t)SIZE * (FIRST_TURN + i) + FIRST_TURN;
    for (int j = 0; j <= i; j++) {
      double sum = row[j];
      for (int k = 0; k < j; k++) {
        sum -= l[3 * i + k] * l[3 * j + k];
      }
      if (i == j && !(sum > 0.0)) {
        return false;
      }
      slender = slender || (i == j && sum < SLENDER * row[i]);
      l[3 * i + j] = i == j ? sqrt(sum) : sum / l[4 * j];
    }
  }
  return slender;
}

/* Replaces x by L^-1 x. */
static void solve_lower(const double l[9], double x[3])
{
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < i; k++) {
      x[i] -= l[3 * i + k] * x[k];
    }
    x[i] /= l[4 * i];
  }
}

/* Replaces x by L^-T x. */
static void solve_upper(const double l[9], double x[3])
{
  for (int i = 2; i >= 0; i--) {
    for (int k = i + 1; k < 3; k++) {
      x[i] -= l[3 * k + i] * x[k];
    }
    x[i] /= l[4 * i];
  }
}

/* Replaces the tensors of slender bodies by the identity. Returns whether there are any. */
static bool set_mass(baum_i_whitening *w)
{
  bool any = false;
  for (int b = 0; b < w->structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &w->structure->mass_blocks[b];
    white_body *body = &w->bodies[b];
    double *m = w->mass + block->value;
    body->slender = block->size == SIZE && w->columns[block->first + FIRST_TURN] &&
                    has_full_tensor(m) && factor_slender(m, body->l);
    for (int i = 0; body->slender && i < 9; i++) {
      m[SIZE * (FIRST_TURN + i / 3) + FIRST_TURN + i % 3] = i % 4 == 0 ? 1.0 : 0.0;
    }
    any = any || body->slender;
  }
  return any;
}

/* Replaces the columns of slender bodies in J by J L^-T: each row j of J becomes (L^-1 j^T)^T. */
static void set_jacobian(const baum_i_whitening *w)
{
  for (int b = 0; b < w->structure->row_block_count; b++) {
    const baum_i_row_block *block = &w->structure->row_blocks[b];
    for (int i = 0; i < block->cols; i++) {
      const white_body *body = w->columns[block->col[i]];
      for (int row = 0; body && body->slender && row < block->rows; row++) {
        solve_lower(body->l, w->jacobian + block->value + (ptrdiff_t)row * block->cols + i);
      }
    }
  }
}

void baum_i_whitening_set(baum_i_whitening *whitening, baum_i_kkt_values *values)
{
  if (!whitening) {
    return;
  }
  const baum_i_kkt_structure *s = whitening->structure;
  memcpy(whitening->mass, values->mass, mass_size(s) * sizeof(double));
  if (set_mass(whitening)) {
    memcpy(whitening->jacobian, values->jacobian, jacobian_size(s) * sizeof(double));
    set_jacobian(whitening);
    values->mass = whitening->mass;
    values->jacobian = whitening->jacobian;
  }
}

/* ---- vectors ---- */

static void convert(const baum_i_whitening *w, void (*by)(const double l[9], double x[3]),
                    double *x)
{
  for (int b = 0; w && b < w->structure->mass_block_count; b++) {
    if (w->bodies[b].slender) {
      by(w->bodies[b].l, x + w->structure->mass_blocks[b].first + FIRST_TURN);
    }
  }
}

void baum_i_whitening_convert_force(const baum_i_whitening *whitening, double *f)
{
  convert(whitening, solve_lower, f);
}

void baum_i_whitening_restore_motion(const baum_i_whitening *whitening, double *a)
{
  convert(whitening, solve_upper, a);
}
