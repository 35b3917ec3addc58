/* SPDX-License-Identifier: BSD-3-Clause */
/* Residual of the whole system in twice the working precision, for refinement:
 *
 *   W (f - M a - J^T lambda)  and  r - J a
 *
 * Close to a singular configuration both residuals are tiny differences of large numbers, and the
 * multipliers depend on all digits of these differences. The rounding errors of sums and products
 * are therefore computed and added to the result (T. Ogita, S. M. Rump, S. Oishi, 2005, Dot2). */
#include <string.h>

#include "linear/block.h"
#include "linear/twofold.h"

/* A side of a node, column by column. */
typedef struct side {
  int32_t place;
  double g[6];
} side;

typedef void side_fn(baum_i_block *b, int32_t node, const side *s);

static void for_sides(baum_i_block *b, side_fn *visit)
{
  for (int i = 0; i < b->pin_count; i++) {
    const baum_i_pin_node *pin = &b->pins[i];
    const double *c = b->arm + 4 * (size_t)i;
    const side on_a = {pin->place[0], {1.0, 0.0, 0.0, 1.0, c[0], c[1]}};
    const side on_b = {pin->place[1], {-1.0, 0.0, 0.0, -1.0, c[2], c[3]}};
    visit(b, pin->node, &on_a);
    visit(b, pin->node, &on_b);
  }
  for (int i = 0; i < b->full_count; i++) {
    const baum_i_full_node *full = &b->fulls[i];
    for (int k = full->first_side; k < full->first_side + full->side_count; k++) {
      side s = {.place = b->place[b->side_body_block[k]]};
      memcpy(s.g, b->side + 6 * (size_t)k, sizeof s.g);
      visit(b, full->node, &s);
    }
  }
}

static void subtract_from_motion(baum_i_block *b, int32_t node, const side *s)
{
  const double *l = b->nodes[node].lambda;
  for (int c = 0; c < 3; c++) {
    size_t at = (size_t)s->place + (size_t)c;
    baum_i_twofold sum = {b->pull[at], b->pull_low[at]};
    baum_i_twofold_subtract_product(&sum, s->g[2 * c], l[0]);
    baum_i_twofold_subtract_product(&sum, s->g[2 * c + 1], l[1]);
    b->pull[at] = sum.high;
    b->pull_low[at] = sum.low;
  }
}

static void subtract_from_rows(baum_i_block *b, int32_t node, const side *s)
{
  const double *x = b->motion + s->place;
  for (int r = 0; r < 2; r++) {
    size_t at = 2 * (size_t)node + (size_t)r;
    baum_i_twofold sum = {b->rest[at], b->rest_low[at]};
    for (int c = 0; c < 3; c++) {
      baum_i_twofold_subtract_product(&sum, s->g[2 * c + r], x[c]);
    }
    b->rest[at] = sum.high;
    b->rest_low[at] = sum.low;
  }
}

/* Sets pull[] to f - M a. */
static void begin_motion(baum_i_block *b)
{
  for (int i = 0; i < b->motion_size; i++) {
    baum_i_twofold sum = {b->load[i], 0.0};
    baum_i_twofold_subtract_product(&sum, b->mass[i], b->motion[i]);
    b->pull[i] = sum.high;
    b->pull_low[i] = sum.low;
  }
}

static void end_motion(baum_i_block *b)
{
  for (int i = 0; i < b->motion_size; i++) {
    b->pull[i] = b->response[i] * (b->pull[i] + b->pull_low[i]);
  }
}

void baum_i_block_find_residual(baum_i_block *b)
{
  size_t rows = 2 * (size_t)b->node_count;
  begin_motion(b);
  memcpy(b->rest, b->right, rows * sizeof *b->rest);
  memset(b->rest_low, 0, rows * sizeof *b->rest_low);
  for_sides(b, subtract_from_motion);
  for_sides(b, subtract_from_rows);
  end_motion(b);
  for (size_t i = 0; i < rows; i++) {
    b->rest[i] += b->rest_low[i];
  }
}
