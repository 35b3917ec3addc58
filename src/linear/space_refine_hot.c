/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks and refinement of solutions for mechanisms in space; refinement is described in
 * block_hot.c. */
#include <math.h>
#include <string.h>

#include "linear/space_columns.h"

enum { MOST = BAUM_I_SPACE_ROWS, MOTION = BAUM_I_SPACE_MOTION };

typedef baum_i_four four;
typedef baum_i_space_column column;

/* Largest residual at rounding level, relative to the sum of the magnitudes of its terms. */
static const double rounding = 0x1p-46;

/* ---- residual ---- */

BAUM_I_INLINE column magnitude(column x)
{
  return (column){baum_i_four_magnitude(x.low), baum_i_magnitude(x.high)};
}

/* Returns -u . y - k mu as -u . (y + u mu) - (k - u . u) mu, in which less cancels. */
BAUM_I_INLINE double rest_of_spin(const baum_i_space *b, int body, double mu)
{
  const double *u = b->bodies[body].lack;
  const double *y = b->motion + (ptrdiff_t)MOTION * body + 4;
  double sum = -b->bodies[body].gap * mu;
  for (int c = 0; c < 3; c++) {
    sum -= u[c] * (y[c] + u[c] * mu);
  }
  return sum;
}

/* Returns r - J a of one node, for a spin row -u . y - k mu. If `size` is not NULL, it is set to
 * the sums of the magnitudes of the terms. */
BAUM_I_INLINE column rest_of(const baum_i_space *b, const baum_i_space_node *node, bool tall,
                             column *size)
{
  column rest = baum_i_column_load(b->nodes + node->at + (tall ? 8 : 4), 1, 0, tall);
  if (size) {
    *size = magnitude(rest);
  }
  for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
    const baum_i_space_side *side = &b->side_list[s];
    const double *x = b->motion + (ptrdiff_t)MOTION * side->body;
    BAUM_I_UNROLL(6)
    for (int c = 0; c < 6; c++) {
      const double *part = b->sides + (c < 3 ? side->move : side->turn);
      column g = baum_i_column_load(part, 3, c % 3, tall);
      double y = c < 3 ? x[c] : x[c + 1];
      rest = baum_i_column_subtract(rest, g, y, tall);
      if (size) {
        *size = baum_i_column_add(*size, magnitude(g), fabs(y), tall);
      }
    }
  }
  if (node->spin != 0) {
    double mu = b->nodes[node->at + node->rows - 1];
    double numbers[8] = {0.0};
    baum_i_column_store(numbers, 1, 0, true, rest);
    numbers[node->rows - 1] = rest_of_spin(b, node->spin, mu);
    rest = baum_i_column_load(numbers, 1, 0, tall);
    if (size) {
      column last = baum_i_column_last(node->rows, tall);
      *size = baum_i_column_add(*size, last, fabs(mu), tall);
    }
  }
  return rest;
}

static bool check_node(const baum_i_space *b, const baum_i_space_node *node)
{
  column size;
  column rest = node->rows > 4 ? rest_of(b, node, true, &size) : rest_of(b, node, false, &size);
  double over[8] = {0.0};
  double limit[8] = {0.0};
  baum_i_column_store(over, 1, 0, true, rest);
  baum_i_column_store(limit, 1, 0, true, size);
  bool fine = true;
  for (int i = 0; i < node->rows; i++) {
    fine = fine && fabs(over[i]) <= rounding * limit[i];
  }
  return fine;
}

static bool check(const baum_i_space *b)
{
  bool fine = true;
  for (int k = 0; k < b->node_count && fine; k++) {
    fine = check_node(b, &b->list[k]);
  }
  return fine;
}

/* ---- amplification ---- */

BAUM_I_INLINE four larger(four x, four most)
{
  return baum_i_four_larger(baum_i_four_magnitude(x), most);
}

static double larger_of(double x, double y)
{
  return x > y ? x : y;
}

static double largest(four x)
{
  baum_i_pair two = baum_i_larger(baum_i_four_low(x), baum_i_four_high(x));
  return larger_of(two[0], two[1]);
}

static double ratio(double x, double y)
{
  return x > 0.0 ? x / y : 0.0;
}

/* Largest accelerations of origins, and angular accelerations without spins of thin bodies. */
typedef struct peaks {
  four moves;
  four turns;
} peaks;

static const peaks NO_PEAKS = {0};

/* Returns the spin of a thin body about its axis. */
BAUM_I_INLINE double spin_of(const baum_i_space_body *body, const double *y)
{
  return body->spin[0] * y[0] + body->spin[1] * y[1] + body->spin[2] * y[2];
}

BAUM_I_INLINE four without_spin(const baum_i_space_body *body, four angular)
{
  four axis = baum_i_four_load(body->axis);
  return baum_i_four_subtract(angular, axis, baum_i_four_sum(baum_i_four_times(axis, angular)));
}

/* Includes the acceleration (x, y) of a body in `most`. The constant `thin` tells if any body is
 * thin. */
BAUM_I_INLINE peaks include(const baum_i_space_body *body, four move, const double *y, bool thin,
                            peaks most)
{
  four angular = baum_i_space_unwhitened(body, y);
  angular = thin && body->thin ? without_spin(body, angular) : angular;
  return (peaks){larger(move, most.moves), larger(angular, most.turns)};
}

/* Returns the largest acceleration in units of 1/s^2. Accelerations of origins are divided by the
 * characteristic length, so that the result does not depend on the unit of length. */
static double size_of(const baum_i_space *b, peaks of)
{
  return larger_of(largest(of.moves) / b->length, largest(of.turns));
}

/* Returns the largest acceleration of a body of one island. */
BAUM_I_INLINE double largest_motion(const baum_i_space *b, int island, bool thin)
{
  peaks most = NO_PEAKS;
  const int32_t *last = b->island_bodies + b->body_start[island + 1];
  for (const int32_t *at = b->island_bodies + b->body_start[island]; at < last; at++) {
    int t = *at;
    const double *x = b->motion + (ptrdiff_t)MOTION * t;
    most = include(&b->bodies[t], baum_i_four_load(x), x + 4, thin, most);
  }
  return size_of(b, most);
}

/* Includes in `most` the accelerations that the multipliers of one node cause. */
BAUM_I_INLINE peaks include_pushes(const baum_i_space *b, const baum_i_space_node *node, bool tall,
                                   bool thin, peaks most)
{
  column lambda = baum_i_column_load(b->nodes + node->at, 1, 0, tall);
  for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
    const baum_i_space_side *side = &b->side_list[s];
    const baum_i_space_body *body = &b->bodies[side->body];
    double turn[4];
    baum_i_four_store(turn, baum_i_column_transposed_times(b->sides + side->turn, lambda, tall));
    four push = lambda.low; /* if E is +-I: E^T lambda up to its sign; weight[3] is 0 */
    if (side->sign == 0) {
      push = baum_i_column_transposed_times(b->sides + side->move, lambda, tall);
    }
    push = baum_i_four_times(push, baum_i_four_load(body->weight));
    most = include(body, push, turn, thin, most);
  }
  return most;
}

/* Returns the sum of the magnitudes of the spins that the single multipliers cause at one side. */
BAUM_I_INLINE double pushed_spin(const baum_i_space *b, const baum_i_space_side *side,
                                 column lambda, bool tall)
{
  column sum = {.low = baum_i_four_zero()};
  for (int c = 0; c < 3; c++) {
    sum = baum_i_column_add(sum, baum_i_column_load(b->sides + side->turn, 3, c, tall),
                            b->bodies[side->body].spin[c], tall);
  }
  four all = baum_i_four_magnitude(baum_i_four_times(sum.low, lambda.low));
  if (tall) {
    all = baum_i_four_plus(all, baum_i_four_of(baum_i_magnitude(sum.high * lambda.high)));
  }
  return baum_i_four_sum(all);
}

/* For each thin body of a node, divides the spin that the multipliers of this node cause by the
 * whole spin of the body, or by `size` if that is larger. Returns the largest quotient. */
BAUM_I_INLINE double largest_spin(const baum_i_space *b, const baum_i_space_node *node, bool tall,
                                  double size)
{
  double most = 0.0;
  column lambda = baum_i_column_load(b->nodes + node->at, 1, 0, tall);
  for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
    const baum_i_space_side *side = &b->side_list[s];
    const baum_i_space_body *body = &b->bodies[side->body];
    if (body->thin) {
      double whole = fabs(spin_of(body, b->motion + (ptrdiff_t)MOTION * side->body + 4));
      most = larger_of(ratio(pushed_spin(b, side, lambda, tall), larger_of(whole, size)), most);
    }
  }
  return most;
}

BAUM_I_INLINE double amplify(const baum_i_space *b, int island, bool thin)
{
  peaks pushes = NO_PEAKS;
  double spins = 0.0;
  double size = largest_motion(b, island, thin);
  const int32_t *last = b->island_nodes + b->node_start[island + 1];
  for (const int32_t *at = b->island_nodes + b->node_start[island]; at < last; at++) {
    const baum_i_space_node *node = &b->list[*at];
    bool tall = node->rows > 4;
    pushes = tall ? include_pushes(b, node, true, thin, pushes)
                  : include_pushes(b, node, false, thin, pushes);
    if (thin) {
      spins = larger_of(largest_spin(b, node, tall, size), spins);
    }
  }
  return larger_of(ratio(size_of(b, pushes), size), spins);
}

static double amplification(const baum_i_space *b)
{
  double most = 0.0;
  for (int i = 1; i < b->island_count; i++) {
    most = larger_of(b->has_thin ? amplify(b, i, true) : amplify(b, i, false), most);
  }
  return most;
}

/* ---- weak nodes ---- */

/* Rounding errors of the first block of a node are divided by the ratio of this block
 * (baum_i_space_measure), and those of the second block by both ratios. A node is weak if the
 * product of its ratios is below WEAK or NaN. */
static const double WEAK = 1e-4;
/* Largest residual of a weak node, relative to the largest acceleration of the island. In 90000
 * random chains of bodies, errors of a and lambda were below 1e-10 if residuals were below this
 * limit, and up to 1e-7 otherwise. */
static const double SMALL = 0x1p-40;

static bool is_weak(const baum_i_space_measure *m)
{
  return !(m->det[0] * m->det[1] > WEAK * (m->size[0] * m->size[1]));
}

/* Tells whether the residual is small in all rows of a node except its spin row. `size` is the
 * largest acceleration of the island [m/s^2]. */
static bool check_weak_node(const baum_i_space *b, const baum_i_space_node *node, double size)
{
  double rest[8] = {0.0};
  baum_i_column_store(rest, 1, 0, true,
                      node->rows > 4 ? rest_of(b, node, true, NULL)
                                     : rest_of(b, node, false, NULL));
  bool fine = true;
  for (int i = 0; i < baum_i_space_own_rows(node); i++) {
    fine = fine && fabs(rest[i]) <= SMALL * size * b->units[node->place + i];
  }
  return fine;
}

static bool check_weak_nodes(const baum_i_space *b)
{
  bool fine = true;
  int count = 0;
  for (int k = 0; k < b->node_count; k++) {
    count += is_weak(&b->measures[k]);
  }
  for (int i = 1; i < b->island_count && count > 0; i++) {
    double size = -1.0; /* not yet known */
    for (int k = b->node_start[i]; k < b->node_start[i + 1] && fine; k++) {
      int node = b->island_nodes[k];
      if (is_weak(&b->measures[node])) {
        size = size < 0.0 ? b->length * largest_motion(b, i, b->has_thin) : size;
        fine = check_weak_node(b, &b->list[node], size);
      }
    }
  }
  return fine;
}

/* ---- refinement ---- */

/* Subtracts U x from the numbers of a later node. U has n columns. */
BAUM_I_INLINE void subtract_columns(int n, const double *u, const double *x, bool tall, double *to)
{
  column sum = baum_i_column_load(to, 1, 0, tall);
  BAUM_I_UNROLL(6)
  for (int c = 0; c < n; c++) {
    sum = baum_i_column_subtract(sum, baum_i_column_load(u, n, c, tall), x[c], tall);
  }
  baum_i_column_store(to, 1, 0, tall, sum);
}

/* Replaces lambda by D^-1 L^-1 lambda at node k, which has n rows. L and D are the factors of the
 * last elimination. */
BAUM_I_INLINE void forward_node(int n, const baum_i_space *b, int k)
{
  bool tall = n > 4;
  int n1 = n < 3 ? n : 3;
  double *numbers = b->nodes + b->list[k].at;
  const double *d = numbers + baum_i_space_pivot(n);
  double right[MOST];
  memcpy(right, numbers, (size_t)n * sizeof *right);
  BAUM_I_UNROLL(3)
  for (int c = 3; c < n; c++) {
    right[c] -= d[4 * c] * right[0] + d[4 * c + 1] * right[1] + d[4 * c + 2] * right[2];
  }
  for (int e = b->order.start[k]; e < b->order.start[k + 1]; e++) {
    const baum_i_space_node *later = &b->list[b->couplings[e].later];
    const double *u = b->off + b->couplings[e].at;
    if (later->rows > 4) {
      subtract_columns(n, u, right, true, b->nodes + later->at);
    } else {
      subtract_columns(n, u, right, false, b->nodes + later->at);
    }
  }
  four first = baum_i_four_zero();
  four second = baum_i_four_zero();
  BAUM_I_UNROLL(3)
  for (int c = 0; c < n1; c++) {
    first = baum_i_four_add(first, baum_i_four_load(d + 4 * c), right[c]);
  }
  BAUM_I_UNROLL(3)
  for (int c = 3; c < n; c++) {
    second = baum_i_four_add(second, baum_i_four_load(d + 4 * n + 4 * (c - 3)), right[c]);
  }
  column out = {.low = baum_i_four_put(first, 3, baum_i_four_get(second, 0))};
  out.high = (baum_i_pair){baum_i_four_get(second, 1), baum_i_four_get(second, 2)};
  baum_i_column_store(numbers, 1, 0, tall, out);
}

static void forward(const baum_i_space *b)
{
  for (int k = 0; k < b->node_count; k++) {
    switch (b->list[k].rows) {
    case 1: forward_node(1, b, k); break;
    case 2: forward_node(2, b, k); break;
    case 3: forward_node(3, b, k); break;
    case 4: forward_node(4, b, k); break;
    case 5: forward_node(5, b, k); break;
    default: forward_node(6, b, k); break;
    }
  }
}

/* Replaces lambda of one node by J pull - rest. */
BAUM_I_INLINE void gather_node(const baum_i_space *b, const baum_i_space_node *node, bool tall)
{
  column sum = {.low = baum_i_four_zero()};
  for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
    const baum_i_space_side *side = &b->side_list[s];
    const double *x = b->pull + (ptrdiff_t)MOTION * side->body;
    BAUM_I_UNROLL(3)
    for (int c = 0; c < 3; c++) {
      sum =
        baum_i_column_add(sum, baum_i_column_load(b->sides + side->move, 3, c, tall), x[c], tall);
      sum = baum_i_column_add(sum, baum_i_column_load(b->sides + side->turn, 3, c, tall), x[4 + c],
                              tall);
    }
  }
  sum =
    baum_i_column_subtract(sum, baum_i_column_load(b->rest + node->place, 1, 0, tall), 1.0, tall);
  baum_i_column_store(b->nodes + node->at, 1, 0, tall, sum);
}

/* Saves lambda in rest_low[], and then replaces it by J pull - rest. */
static void gather(baum_i_space *b)
{
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *node = &b->list[k];
    bool tall = node->rows > 4;
    column before = baum_i_column_load(b->nodes + node->at, 1, 0, tall);
    baum_i_column_store(b->rest_low + node->place, 1, 0, tall, before);
    if (tall) {
      gather_node(b, node, true);
    } else {
      gather_node(b, node, false);
    }
  }
}

/* Adds the corrections to the saved multipliers of an island. Returns the largest correction
 * relative to the largest multiplier. */
static double add_changes(const baum_i_space *b, int island)
{
  four changes = baum_i_four_zero();
  four sizes = baum_i_four_zero();
  const int32_t *last = b->island_nodes + b->node_start[island + 1];
  for (const int32_t *at = b->island_nodes + b->node_start[island]; at < last; at++) {
    const baum_i_space_node *node = &b->list[*at];
    double *numbers = b->nodes + node->at;
    bool tall = node->rows > 4;
    column unit = baum_i_column_load(b->units + node->place, 1, 0, tall);
    column change = baum_i_column_load(numbers, 1, 0, tall);
    column sum = baum_i_column_load(b->rest_low + node->place, 1, 0, tall);
    sum = baum_i_column_add(sum, change, 1.0, tall);
    baum_i_column_store(numbers, 1, 0, tall, sum);
    changes = larger(baum_i_four_times(change.low, unit.low), changes);
    sizes = larger(baum_i_four_times(sum.low, unit.low), sizes);
    if (tall) {
      changes = larger(baum_i_four_of(change.high * unit.high), changes);
      sizes = larger(baum_i_four_of(sum.high * unit.high), sizes);
    }
  }
  return ratio(largest(changes), largest(sizes));
}

/* Returns the change of a thin body's spin, relative to the spin or to `others` (the largest other
 * acceleration), whichever is larger. */
static double change_of_spin(const baum_i_space *b, int t, const double *before, double others)
{
  const baum_i_space_body *body = &b->bodies[t];
  ptrdiff_t at = (ptrdiff_t)MOTION * t + 4;
  double spin = spin_of(body, b->motion + at);
  return ratio(fabs(spin - spin_of(body, before + at)), larger_of(fabs(spin), others));
}

/* Returns the largest change of an acceleration in an island, relative to its largest
 * acceleration. */
BAUM_I_INLINE double change_of_motion(const baum_i_space *b, int island, const double *before,
                                      bool thin)
{
  peaks changes = NO_PEAKS;
  double spins = 0.0;
  double size = largest_motion(b, island, thin);
  const int32_t *last = b->island_bodies + b->body_start[island + 1];
  for (const int32_t *t = b->island_bodies + b->body_start[island]; t < last; t++) {
    ptrdiff_t at = (ptrdiff_t)MOTION * *t;
    four x = baum_i_four_minus(baum_i_four_load(b->motion + at), baum_i_four_load(before + at));
    double y[4];
    baum_i_four_store(y, baum_i_four_minus(baum_i_four_load(b->motion + at + 4),
                                           baum_i_four_load(before + at + 4)));
    changes = include(&b->bodies[*t], x, y, thin, changes);
    if (thin && b->bodies[*t].thin) {
      spins = larger_of(change_of_spin(b, *t, before, size), spins);
    }
  }
  return larger_of(ratio(size_of(b, changes), size), spins);
}

/* Corrects a and lambda for the right-hand sides that replace lambda. If `pulled` is true, first
 * adds pull[] to a. */
BAUM_I_INLINE double correct_all(baum_i_space *b, bool pulled)
{
  double *before = b->pull_low;
  forward(b);
  for (int i = 0; i < MOTION * b->body_count; i += 4) {
    four x = baum_i_four_load(b->motion + i);
    baum_i_four_store(before + i, x);
    if (pulled) {
      baum_i_four_store(b->motion + i, baum_i_four_plus(x, baum_i_four_load(b->pull + i)));
    }
  }
  BAUM_I_HOT(baum_i_space_kernel).substitute(b, NULL);
  double most = 0.0;
  for (int i = 1; i < b->island_count; i++) {
    double moved =
      b->has_thin ? change_of_motion(b, i, before, true) : change_of_motion(b, i, before, false);
    most = larger_of(add_changes(b, i), larger_of(moved, most));
  }
  return most;
}

static double correct(baum_i_space *b)
{
  gather(b);
  return correct_all(b, true);
}

/* Saves lambda of one node in rest_low[], and then replaces it by J a - r. */
BAUM_I_INLINE void set_rest(const baum_i_space *b, const baum_i_space_node *node, bool tall)
{
  double *lambda = b->nodes + node->at;
  baum_i_column_store(b->rest_low + node->place, 1, 0, tall,
                      baum_i_column_load(lambda, 1, 0, tall));
  column rest = rest_of(b, node, tall, NULL);
  baum_i_column_store(lambda, 1, 0, tall, baum_i_column_times(rest, -1.0, tall));
}

static double correct_rows(baum_i_space *b)
{
  for (int k = 0; k < b->node_count; k++) {
    if (b->list[k].rows > 4) {
      set_rest(b, &b->list[k], true);
    } else {
      set_rest(b, &b->list[k], false);
    }
  }
  return correct_all(b, false);
}

const baum_i_space_refine_kernel BAUM_I_HOT(baum_i_space_refine_kernel) = {
  .amplification = amplification,
  .check = check,
  .check_weak_nodes = check_weak_nodes,
  .correct = correct,
  .correct_rows = correct_rows,
};
