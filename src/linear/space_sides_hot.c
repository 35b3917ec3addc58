/* SPDX-License-Identifier: BSD-3-Clause */
/* For mechanisms in space: computes the nodes whose sides come from the blocks of J. With a0 = (x0,
 * y0) for each body:
 *
 *   R = (columns of J for w') L^-T,   D = sum over sides of E E^T / m + R R^T,
 *   J a0 - r = sum over sides of E x0 + R y0, minus r */
#include <string.h>

#include "linear/space_columns.h"

enum { MOST = BAUM_I_SPACE_ROWS, MOTION = BAUM_I_SPACE_MOTION };

/* Sets f and a0 of a body in space that is not fixed. */
BAUM_I_INLINE void set_spatial_force(const baum_i_space_body *body, const double *force, double *f,
                                     double *a)
{
  const baum_i_four push = baum_i_four_set(force[0], force[1], force[2], 0.0);
  const double *w = body->whiten;
  baum_i_four turn = baum_i_four_times(baum_i_four_load(w), baum_i_four_all(force[3]));
  turn = baum_i_four_add(turn, baum_i_four_load(w + 4), force[4]);
  turn = baum_i_four_add(turn, baum_i_four_load(w + 8), force[5]);
  baum_i_four_store(f, push);
  baum_i_four_store(a, baum_i_four_times(push, baum_i_four_load(body->weight)));
  baum_i_four_store(f + 4, turn);
  baum_i_four_store(a + 4, turn);
}

static void set_force(baum_i_space *b, const double *force)
{
  for (int t = 1; t < b->body_count; t++) {
    const baum_i_space_body *body = &b->bodies[t];
    double six[6] = {0.0};
    double *f = b->force + (ptrdiff_t)MOTION * t;
    double *a = b->free + (ptrdiff_t)MOTION * t;
    if (body->size == 6 && !body->fixed) {
      set_spatial_force(body, force + body->first, f, a);
      continue;
    }
    for (int c = 0; c < body->size; c++) {
      six[body->slots[c]] = force[body->first + c];
    }
    for (int i = 0; i < 3; i++) {
      const double *w = body->whiten + i;
      f[i] = body->mass > 0.0 ? six[i] : 0.0;
      a[i] = body->weight[i] * six[i];
      f[4 + i] = w[0] * six[3] + w[4] * six[4] + w[8] * six[5];
      a[4 + i] = f[4 + i];
    }
  }
}

/* Copies E and R of a side from the rows of J. Columns that the body does not have stay 0. */
static void copy_side(const baum_i_space *b, const baum_i_space_node *node,
                      const baum_i_space_side *side, const double *jacobian)
{
  const baum_i_row_block *rows = &b->structure->row_blocks[node->row_block];
  const double *whiten = b->bodies[side->body].whiten;
  for (int i = 0; i < node->rows; i++) {
    const double *j = jacobian + rows->value + (ptrdiff_t)(node->row[i] - rows->row) * rows->cols;
    bool omitted = (node->omitted >> i & 1u) != 0;
    double six[6];
    for (int c = 0; c < 6; c++) {
      six[c] = omitted || side->from[c] < 0 ? 0.0 : j[side->from[c]];
    }
    for (int c = 0; c < 3; c++) {
      ptrdiff_t at = baum_i_column_entry(3, i, c);
      if (side->sign == 0 && side->from[c] >= 0) {
        b->sides[side->move + at] = six[c];
      }
      if (side->from[3 + c] >= 0) {
        b->sides[side->turn + at] =
          whiten[c] * six[3] + whiten[4 + c] * six[4] + whiten[8 + c] * six[5];
      }
    }
  }
}

/* Returns the right-hand side of one row; also sets Phi'. */
static double right_of(const baum_i_space *b, const baum_i_space_node *node, int i,
                       const baum_i_block_rows *at)
{
  const baum_i_row_block *rows = &b->structure->row_blocks[node->row_block];
  int32_t row = node->row[i];
  const double *j = at->jacobian + rows->value + (ptrdiff_t)(row - rows->row) * rows->cols;
  double rate = -at->nu[row];
  for (int c = 0; at->v && c < rows->cols; c++) {
    rate += j[c] * at->v[rows->col[c]];
  }
  at->phi_rate[row] = rate;
  return at->bending * at->gamma[row] - at->damping * rate - at->stiffness * at->phi[row];
}

/* D with columns of eight numbers. */
typedef double square[MOST][8];

/* Adds G W G^T of a side to D, and G a0 to the sum. */
static void add_side(const baum_i_space *b, const baum_i_space_side *side, int n, square d,
                     baum_i_space_column *sum)
{
  const double *a0 = b->from + (ptrdiff_t)MOTION * side->body;
  for (int c = 0; c < 6; c++) {
    if (side->from[c] < 0) {
      continue;
    }
    const double *part = b->sides + (c < 3 ? side->move : side->turn);
    baum_i_space_column g =
      n > 4 ? baum_i_column_load(part, 3, c % 3, true) : baum_i_column_load(part, 3, c % 3, false);
    double w = c < 3 ? b->bodies[side->body].weight[c] : 1.0;
    *sum = baum_i_column_add(*sum, g, a0[c < 3 ? c : c + 1], true);
    for (int j = 0; j < n; j++) {
      baum_i_space_column old = baum_i_column_load(d[j], 1, 0, true);
      old = baum_i_column_add(old, g, w * part[baum_i_column_entry(3, j, c % 3)], true);
      baum_i_column_store(d[j], 1, 0, true, old);
    }
  }
}

static void store_pivot(const baum_i_space *b, int k, square from)
{
  int n = b->list[k].rows;
  double *d = b->nodes + b->list[k].at + baum_i_space_pivot(n);
  baum_i_space_measure measure = {.size = {1.0, 1.0}};
  for (int j = 0; j < n; j++) {
    memcpy(d + (ptrdiff_t)4 * j, from[j], 4 * sizeof *d);
    if (j >= 4) {
      memcpy(d + (ptrdiff_t)4 * n + (ptrdiff_t)2 * (j - 4), from[j] + 4, 2 * sizeof *d);
    }
    measure.size[j < 3 ? 0 : 1] *= from[j][j];
  }
  b->measures[k] = measure;
}

static void set_node(const baum_i_space *b, int k, const baum_i_block_rows *at)
{
  const baum_i_space_node *node = &b->list[k];
  int n = node->rows;
  bool tall = n > 4;
  double *numbers = b->nodes + node->at;
  double right[8] = {0.0};
  square d = {{0.0}};
  for (int i = 0; i < n; i++) {
    bool omitted = (node->omitted >> i & 1u) != 0;
    double r = right_of(b, node, i, at);
    right[i] = omitted ? 0.0 : r;
    d[i][i] = omitted ? 1.0 : 0.0;
  }
  baum_i_space_column rest = baum_i_column_load(right, 1, 0, true);
  baum_i_space_column sum = {baum_i_four_zero(), {0.0, 0.0}};
  for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
    const baum_i_space_side *side = &b->side_list[s];
    copy_side(b, node, side, at->jacobian);
    add_side(b, side, n, d, &sum);
  }
  sum = baum_i_column_subtract(sum, rest, 1.0, true);
  baum_i_column_store(numbers, 1, 0, tall, sum);
  baum_i_column_store(numbers + baum_i_space_vector(n), 1, 0, tall, rest);
  store_pivot(b, k, d);
}

static void set(baum_i_space *b, const baum_i_block_rows *rows)
{
  for (int k = 0; k < b->node_count; k++) {
    if (!b->list[k].direct) {
      set_node(b, k, rows);
    }
  }
}

const baum_i_space_sides_kernel BAUM_I_HOT(baum_i_space_sides_kernel) = {.set_force = set_force,
                                                                         .set = set};
