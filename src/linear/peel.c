/* SPDX-License-Identifier: BSD-3-Clause */
/* A velocity that occurs in only one block of rows is free for that block. If the rows of a block,
 * scaled to unit length, are clearly independent in the columns of its free velocities, no
 * combination of other rows can cancel them. The rows of the block are then independent of the
 * other rows, and vice versa. The block is removed, and its other velocities may then be free for
 * another block. In this way an open chain is removed from its tip to its root, including its
 * motors, and closed loops remain. */
#include "linear/peel.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/alloc.h"

/* Larger blocks are not checked, because they are rare and repeated checks would be expensive. */
enum { MOST_ROWS = 6, MOST_COLUMNS = 24 };

/* A row is clearly independent if more than this of its unit length remains after
 * orthogonalization. The value is so large that the tolerance on the rank does not matter. */
static const double clear = 1e-3;

enum { GONE, LEFT, WAITING }; /* states of a block; a WAITING block is on the stack */

typedef struct peeling {
  const baum_i_kkt_structure *structure;
  const double *jacobian;
  const double *column_scale;
  int *users;  /* (nv) number of blocks in which a velocity occurs */
  int *user;   /* (nv) XOR of the indices of these blocks; if there is one block, its index */
  int *state;  /* (row_block_count) */
  int *stack;  /* (row_block_count) blocks to examine */
  int waiting; /* number of blocks on the stack */
} peeling;

static double size_of(const double *x, int count)
{
  double sum = 0.0;
  for (int k = 0; k < count; k++) {
    sum += x[k] * x[k];
  }
  return sqrt(sum);
}

/* Subtracts from x its components along `count` rows of unit length. */
static void orthogonalize(double *x, double rows[][MOST_COLUMNS], int count, int width)
{
  for (int i = 0; i < count; i++) {
    double part = 0.0;
    for (int k = 0; k < width; k++) {
      part += rows[i][k] * x[k];
    }
    for (int k = 0; k < width; k++) {
      x[k] -= part * rows[i][k];
    }
  }
}

/* Scales row i to unit length and loads its entries for the free velocities. Returns the number of
 * these entries. */
static int load_row(const peeling *p, const baum_i_row_block *block, int i, double *out)
{
  const double *value = p->jacobian + block->value + i * block->cols;
  double row[MOST_COLUMNS];
  int width = 0;
  for (int k = 0; k < block->cols; k++) {
    row[k] = value[k] * p->column_scale[block->col[k]];
  }
  double size = size_of(row, block->cols);
  for (int k = 0; k < block->cols; k++) {
    if (p->users[block->col[k]] == 1) {
      out[width++] = row[k] / size; /* 0 if squares overflow */
    }
  }
  return width;
}

static bool is_independent(const peeling *p, const baum_i_row_block *block)
{
  double rows[MOST_ROWS][MOST_COLUMNS];
  if (block->rows > MOST_ROWS || block->cols > MOST_COLUMNS) {
    return false;
  }
  for (int i = 0; i < block->rows; i++) {
    int width = load_row(p, block, i, rows[i]);
    orthogonalize(rows[i], rows, i, width);
    double rest = size_of(rows[i], width);
    if (!(rest > clear)) {
      return false;
    }
    for (int k = 0; k < width; k++) {
      rows[i][k] /= rest;
    }
  }
  return true;
}

/* Tells whether velocity k of a block has an entry that is not zero. */
static bool occurs(const peeling *p, const baum_i_row_block *block, int k)
{
  for (int i = 0; i < block->rows; i++) {
    if (p->jacobian[block->value + i * block->cols + k] != 0.0) {
      return true;
    }
  }
  return false;
}

static void queue_block(peeling *p, int block)
{
  p->state[block] = WAITING;
  p->stack[p->waiting++] = block;
}

static void remove_block(peeling *p, int b)
{
  const baum_i_row_block *block = &p->structure->row_blocks[b];
  p->state[b] = GONE;
  for (int k = 0; k < block->cols; k++) {
    int column = block->col[k];
    if (!occurs(p, block, k)) {
      continue;
    }
    p->users[column]--;
    p->user[column] ^= b;
    if (p->users[column] == 1 && p->state[p->user[column]] == LEFT) {
      queue_block(p, p->user[column]);
    }
  }
}

static void add_block(peeling *p, int b)
{
  const baum_i_row_block *block = &p->structure->row_blocks[b];
  for (int k = 0; k < block->cols; k++) {
    if (occurs(p, block, k)) {
      p->users[block->col[k]]++;
      p->user[block->col[k]] ^= b;
    }
  }
  queue_block(p, b);
}

static void peel_all(peeling *p)
{
  for (int b = 0; b < p->structure->row_block_count; b++) {
    add_block(p, b);
  }
  while (p->waiting > 0) {
    int b = p->stack[--p->waiting];
    p->state[b] = LEFT;
    if (is_independent(p, &p->structure->row_blocks[b])) {
      remove_block(p, b);
    }
  }
}

static void mark_rows(const peeling *p, unsigned char *peeled)
{
  for (int b = 0; b < p->structure->row_block_count; b++) {
    const baum_i_row_block *block = &p->structure->row_blocks[b];
    memset(peeled + block->row, p->state[b] == GONE, (size_t)block->rows);
  }
}

baum_status baum_i_peel(const baum_i_kkt_structure *structure, const double *jacobian,
                        const double *column_scale, unsigned char *peeled)
{
  size_t nv = (size_t)structure->nv;
  size_t blocks = (size_t)structure->row_block_count;
  int *memory = baum_i_alloc(2 * (nv + blocks), sizeof *memory);
  if (!memory) {
    return BAUM_ERR_MEMORY;
  }
  peeling p = {.structure = structure,
               .jacobian = jacobian,
               .column_scale = column_scale,
               .users = memory,
               .user = memory + nv,
               .state = memory + 2 * nv,
               .stack = memory + 2 * nv + blocks};
  peel_all(&p);
  mark_rows(&p, peeled);
  baum_i_free(memory);
  return BAUM_OK;
}
