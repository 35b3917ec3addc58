/* SPDX-License-Identifier: BSD-3-Clause */
/* Block solver for mechanisms in space: memory, masses, and other right-hand sides. */
#include "linear/space_block.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/hot.h"
#include "base/pair.h"
#include "linear/arrays.h"
#include "linear/twofold.h"

/* The same limits as in block.c. In space, weak_pivot also has a lower bound, because evaluations
 * in space accept good pivots without a check of the residual. */
static const double weak_pivot = 1e-3;
static const double least_weak_pivot = 1e-5;
static const double many_nodes = 128.0;

/* A body is thin if its smallest moment of inertia is below this fraction of the trace of I. The
 * axis of this moment is the axis of the body. The angular acceleration about this axis is called
 * spin. It may be much larger than all other accelerations. */
static const double thin = 2e-5;

/* ---- memory ---- */

static baum_status make_arrays(baum_i_space *b)
{
  size_t motion = BAUM_I_SPACE_MOTION * (size_t)b->body_count;
  size_t nodes = (size_t)b->node_count;
  size_t rows = (size_t)b->numbers_of_rows;
  const baum_i_array arrays[] = {
    {&b->sides, (size_t)b->numbers_of_sides},
    {&b->nodes, (size_t)b->numbers_of_nodes},
    {&b->measures, sizeof(baum_i_space_measure) / sizeof(double) * nodes},
    {&b->off, (size_t)b->numbers_off},
    {&b->free, motion},
    {&b->motion, motion},
    {&b->force, motion},
    {&b->nothing, motion},
    {&b->pull, motion},
    {&b->pull_low, motion},
    {&b->units, rows},
    {&b->rest, rows},
    {&b->rest_low, rows},
  };
  b->numbers = baum_i_arrays_create(arrays, sizeof arrays / sizeof *arrays);
  if (!b->numbers) {
    return BAUM_ERR_MEMORY;
  }
  for (int c = 0; c < 3; c++) {
    b->sides[5 * c] = 1.0; /* E = I and E = -I, see space_structure.c */
    b->sides[20 + 5 * c] = -1.0;
  }
  return BAUM_OK;
}

static void set_units(const baum_i_space *b, const baum_i_space_layout *layout)
{
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *node = &b->list[k];
    for (int i = 0; i < baum_i_space_own_rows(node); i++) {
      b->units[node->place + i] = layout->moments[node->row[i]] ? 1.0 / layout->length : 1.0;
    }
  }
}

baum_status baum_i_space_create(const baum_i_space_layout *layout, int *hub, baum_i_space **out)
{
  *out = NULL;
  baum_i_space *b = baum_i_alloc(1, sizeof *b);
  if (!b) {
    return BAUM_ERR_MEMORY;
  }
  b->structure = layout->structure;
  b->hub = -1;
  baum_status status = baum_i_space_find_structure(layout, b);
  *hub = b->hub;
  if (status == BAUM_OK) {
    status = baum_i_space_find_islands(b);
  }
  if (status == BAUM_OK) {
    status = make_arrays(b);
  }
  if (status != BAUM_OK) {
    baum_i_space_destroy(b);
    return status;
  }
  set_units(b, layout);
  double few = fmin(1.0, many_nodes / fmax(1.0, b->node_count));
  b->weak_pivot = fmax(weak_pivot * few * sqrt(few), least_weak_pivot);
  b->length = layout->length;
  baum_i_space_use_force(b, true);
  *out = b;
  return BAUM_OK;
}

void baum_i_space_destroy(baum_i_space *space)
{
  if (!space) {
    return;
  }
  const void *arrays[] = {space->stages,        space->node_stages, space->list,
                          space->side_list,     space->pairs,       space->couplings,
                          space->zeros,         space->targets,     space->numbers,
                          space->island_bodies, space->island_nodes};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
    baum_i_free(arrays[i]);
  }
  baum_i_free_lines(space->bodies);
  baum_i_elimination_clear(&space->order);
  baum_i_free(space);
}

void baum_i_space_use_force(baum_i_space *space, bool use)
{
  space->from = use ? space->free : space->nothing;
  space->load = use ? space->force : space->nothing;
}

/* ---- masses ---- */

/* Computes the Cholesky factor L of I = L L^T. */
static bool factor_tensor(const double tensor[12], double l[9])
{
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j <= i; j++) {
      double sum = tensor[4 * i + j];
      for (int k = 0; k < j; k++) {
        sum -= l[3 * i + k] * l[3 * j + k];
      }
      /* a sum below this limit is only a rounding error left by cancellation */
      if (i == j && !(sum > 1e-14 * tensor[5 * i])) {
        return false;
      }
      l[3 * i + j] = i == j ? sqrt(sum) : sum / l[4 * j];
    }
  }
  return true;
}

/* Sets L^T and L^-T of a tensor. */
static bool whiten(const double tensor[12], baum_i_space_body *body)
{
  double l[9] = {0.0};
  if (!factor_tensor(tensor, l)) {
    return false;
  }
  for (int c = 0; c < 3; c++) { /* solves L^T x = e_c */
    for (int i = 2; i >= 0; i--) {
      double sum = i == c ? 1.0 : 0.0;
      for (int k = i + 1; k < 3; k++) {
        sum -= l[3 * k + i] * body->whiten[4 * k + c];
      }
      body->whiten[4 * i + c] = sum / l[4 * i];
      body->columns[4 * c + i] = body->whiten[4 * i + c];
      body->unwhite[4 * i + c] = l[3 * c + i];
    }
  }
  return true;
}

/* ---- axes of thin bodies ---- */

static double trace_of(const baum_i_space_body *body)
{
  return body->inertia[0] + body->inertia[5] + body->inertia[10];
}

/* Sets the axis of the smallest moment of inertia to the largest column of (I^-1)^2, which is
 * accurate if this moment is much smaller than the others. Returns the moment. */
static double find_axis(baum_i_space_body *body)
{
  double inverse[9];
  double most = 0.0;
  for (int i = 0; i < 9; i++) {
    const double *x = body->whiten + (ptrdiff_t)4 * (i / 3);
    const double *y = body->whiten + (ptrdiff_t)4 * (i % 3);
    inverse[i] = x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  }
  for (int c = 0; c < 3; c++) {
    double column[3];
    for (int i = 0; i < 3; i++) {
      column[i] = inverse[3 * i] * inverse[c] + inverse[3 * i + 1] * inverse[3 + c] +
                  inverse[3 * i + 2] * inverse[6 + c];
    }
    double size = hypot(hypot(column[0], column[1]), column[2]);
    for (int i = 0; i < 3 && size > most; i++) {
      body->axis[i] = column[i] / size;
    }
    most = size > most ? size : most;
  }
  return 1.0 / sqrt(most);
}

static void set_spin(baum_i_space_body *body)
{
  const double *e = body->axis;
  const double *white = body->whiten;
  for (int k = 0; k < 3; k++) {
    body->spin[k] = white[k] * e[0] + white[4 + k] * e[1] + white[8 + k] * e[2];
  }
}

static double square_of(const double x[3])
{
  return x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
}

/* Sets k of the spin row so that a unit moment about the axis causes the spin `inverse`, as with
 * the tensor I: |s|^2 + (u . s)^2 / (k - u . u) = inverse, where s is the spin vector for I'. */
static void set_factor(baum_i_space_body *body, double inverse)
{
  const double *u = body->lack;
  double along = u[0] * body->spin[0] + u[1] * body->spin[1] + u[2] * body->spin[2];
  body->gap = along * along / (inverse - square_of(body->spin));
  baum_i_twofold k = {body->gap, 0.0};
  for (int i = 0; i < 3; i++) {
    baum_i_twofold_subtract_product(&k, u[i], -u[i]);
  }
  body->factor[0] = k.high;
  body->factor[1] = k.low;
}

/* Replaces I by I + c e e^T with c = trace(I) / 2. */
static void raise_moment(baum_i_space_body *body)
{
  double weight = 0.5 * trace_of(body);
  const double *e = body->axis;
  double tensor[12];
  for (int i = 0; i < 12; i++) {
    tensor[i] = body->inertia[i] + (i % 4 < 3 ? weight * e[i / 4] * e[i % 4] : 0.0);
  }
  (void)whiten(tensor, body); /* cannot fail, because I is positive definite */
  const double inverse =
    square_of(body->spin); /* spin caused by a unit moment, without constraints */
  set_spin(body);
  for (int k = 0; k < 3; k++) {
    body->lack[k] = sqrt(weight) * body->spin[k];
  }
  set_factor(body, inverse);
}

static void set_thin(baum_i_space_body *body)
{
  double least = find_axis(body);
  body->thin = least < thin * trace_of(body);
  set_spin(body);
  if (body->raised) {
    raise_moment(body);
  }
}

static bool set_body(const baum_i_mass_block *block, const double *mass, baum_i_space_body *body)
{
  const double *m = mass + block->value;
  int n = block->size;
  bool positive = m[0] > 0.0;
  body->mass = m[0];
  bool planar = body->slots[2] == 5;
  for (int i = 0; i < 3; i++) {
    body->weight[i] = planar && i == 2 ? 0.0 : 1.0 / m[0];
  }
  if (n == 6) {
    positive = whiten(body->inertia, body) && positive;
    if (positive) {
      set_thin(body);
    }
  } else if (n == 3 && planar) {
    positive = positive && m[8] > 0.0;
    body->unwhite[10] = sqrt(m[8]);
    body->whiten[10] = 1.0 / body->unwhite[10];
    body->columns[10] = body->whiten[10];
  }
  return positive;
}

int baum_i_space_set_mass(baum_i_space *space, const double *mass)
{
  for (int i = 0; i < space->structure->mass_block_count; i++) {
    const baum_i_mass_block *block = &space->structure->mass_blocks[i];
    baum_i_space_body *body = &space->bodies[1 + i];
    body->heft = mass[block->value];
    for (int c = 0; block->size == 6 && c < 9; c++) {
      body->inertia[c / 3 * 4 + c % 3] = mass[block->value + 21 + c / 3 * 6 + c % 3];
    }
    if (!body->fixed && !set_body(block, mass, body)) {
      return i;
    }
    space->has_thin = space->has_thin || body->thin;
  }
  return -1;
}

/* ---- other right-hand sides ---- */

static void clear(baum_i_space *b)
{
  size_t motion = BAUM_I_SPACE_MOTION * (size_t)b->body_count;
  baum_i_space_use_force(b, false);
  memset(b->motion, 0, motion * sizeof *b->motion);
  memset(b->pull, 0, motion * sizeof *b->pull);
  memset(b->rest, 0, (size_t)b->numbers_of_rows * sizeof *b->rest);
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *node = &b->list[k];
    size_t numbers = 2 * (size_t)baum_i_space_vector(node->rows); /* lambda and r */
    memset(b->nodes + node->at, 0, numbers * sizeof *b->nodes);
  }
}

/* Sets r of the rows of a node except its spin row to rest. */
static void set_right(const baum_i_space *b, const baum_i_space_node *node)
{
  double *r = b->nodes + node->at + baum_i_space_vector(node->rows);
  memcpy(r, b->rest + node->place, (size_t)baum_i_space_own_rows(node) * sizeof *r);
}

void baum_i_space_set_rest(baum_i_space *space, const double *r)
{
  clear(space);
  for (int k = 0; k < space->node_count; k++) {
    const baum_i_space_node *node = &space->list[k];
    for (int i = 0; i < node->rows; i++) {
      bool omitted = (node->omitted >> i & 1u) != 0;
      space->rest[node->place + i] = omitted ? 0.0 : r[node->row[i]];
    }
    set_right(space, node);
  }
}

void baum_i_space_move_rest(baum_i_space *space)
{
  size_t motion = BAUM_I_SPACE_MOTION * (size_t)space->body_count;
  memset(space->motion, 0, motion * sizeof *space->motion);
  memset(space->pull, 0, motion * sizeof *space->pull);
  for (int k = 0; k < space->node_count; k++) {
    const baum_i_space_node *node = &space->list[k];
    set_right(space, node);
    for (int i = baum_i_space_own_rows(node); i < node->rows; i++) {
      space->rest[node->place + i] = 0.0; /* a spin row */
    }
  }
}

/* For spin rows, sets rest[] to u . y of pull[]: mu is the change of -u . y by the constraints. */
static void rest_spin_rows(const baum_i_space *b)
{
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *node = &b->list[k];
    if (node->spin != 0) {
      const double *u = b->bodies[node->spin].lack;
      const double *y = b->pull + (ptrdiff_t)BAUM_I_SPACE_MOTION * node->spin + 4;
      b->rest[node->place + node->rows - 1] = u[0] * y[0] + u[1] * y[1] + u[2] * y[2];
    }
  }
}

void baum_i_space_pull(baum_i_space *space, const double *x)
{
  clear(space);
  for (int t = 1; t < space->body_count; t++) {
    const baum_i_space_body *body = &space->bodies[t];
    double six[6] = {0.0};
    double *pull = space->pull + (ptrdiff_t)BAUM_I_SPACE_MOTION * t;
    for (int c = 0; body->mass > 0.0 && c < body->size; c++) {
      six[body->slots[c]] = x[body->first + c];
    }
    for (int i = 0; i < 3; i++) {
      pull[i] = six[i];
      for (int c = 0; c < 3; c++) {
        pull[4 + i] += body->unwhite[4 * i + c] * six[3 + c];
      }
    }
  }
  rest_spin_rows(space);
  for (int i = 0; i < BAUM_I_SPACE_MOTION * space->body_count; i++) {
    space->motion[i] = -space->pull[i];
  }
}

/* ---- pivots ---- */

enum { MOST = BAUM_I_SPACE_ROWS };

/* Adds G W G^T to the lower triangle of s. G is a part (E or R) of three columns, and W is
 * diagonal. s[j] is column j of the triangle. */
BAUM_I_INLINE void add_products(const double *part, const double w[3], bool tall,
                                double s[MOST][MOST])
{
  const int rows = tall ? 6 : 4;
  for (int c = 0; c < 3; c++) {
    const double *high = part + 4 * (ptrdiff_t)c;
    const double *low = part + 12 + 2 * (ptrdiff_t)c;
    BAUM_I_UNROLL(6)
    for (int j = 0; j < rows; j++) {
      baum_i_pair factor = baum_i_both(w[c] * (j < 4 ? high[j] : low[j - 4]));
      BAUM_I_UNROLL(3)
      for (int i = j - j % 2; i < rows; i += 2) {
        baum_i_pair g = baum_i_load(i < 4 ? high + i : low);
        baum_i_store(s[j] + i, baum_i_load(s[j] + i) + factor * g);
      }
    }
  }
}

BAUM_I_INLINE void add_sides(const baum_i_space *b, const baum_i_space_node *node, bool tall,
                             double s[MOST][MOST])
{
  static const double ONES[3] = {1.0, 1.0, 1.0};
  for (int k = node->first_side; k < node->first_side + node->side_count; k++) {
    const baum_i_space_side *side = &b->side_list[k];
    add_products(b->sides + side->move, b->bodies[side->body].weight, tall, s);
    add_products(b->sides + side->turn, ONES, tall, s);
  }
}

/* Sets the lower triangle of D before the elimination. s[j] is column j. */
static void set_undivided(const baum_i_space *b, const baum_i_space_node *node,
                          double s[MOST][MOST])
{
  memset(s, 0, MOST * sizeof *s);
  if (node->rows > 4) {
    add_sides(b, node, true, s);
  } else {
    add_sides(b, node, false, s);
  }
  for (int i = 0; i < baum_i_space_own_rows(node); i++) {
    s[i][i] += node->omitted >> i & 1u;
  }
  if (node->spin != 0) {
    s[node->rows - 1][node->rows - 1] = -b->bodies[node->spin].gap;
  }
}

/* Factors a lower triangle L D L^T of n rows in place. s[k][k] is then D. */
static void factor_triangle(int n, double s[MOST][MOST])
{
  for (int k = 0; k < n; k++) {
    for (int i = k + 1; i < n; i++) {
      double factor = s[k][i] / s[k][k];
      for (int j = k + 1; j <= i; j++) {
        s[j][i] -= factor * s[k][j];
      }
    }
    for (int i = k + 1; i < n; i++) {
      s[k][i] /= s[k][k];
    }
  }
}

void baum_i_space_undivided(const baum_i_space *space, int node, double det[2])
{
  const baum_i_space_node *at = &space->list[node];
  double s[MOST][MOST];
  set_undivided(space, at, s);
  factor_triangle(at->rows, s);
  det[0] = 1.0;
  det[1] = 1.0;
  for (int k = 0; k < at->rows; k++) {
    det[k < 3 ? 0 : 1] *= s[k][k];
  }
}

/* With x = R L^T e / |L^T e|, the grip is x^T D^-1 x. */
double baum_i_space_grip(const baum_i_space *space, int node, const baum_i_space_side *side)
{
  const baum_i_space_node *at = &space->list[node];
  const baum_i_space_body *body = &space->bodies[side->body];
  double s[MOST][MOST];
  double x[MOST];
  double y[3];
  double square = 0.0;
  double grip = 0.0;
  for (int c = 0; c < 3; c++) {
    const double *l = body->unwhite + (ptrdiff_t)4 * c;
    y[c] = l[0] * body->axis[0] + l[1] * body->axis[1] + l[2] * body->axis[2];
    square += y[c] * y[c];
  }
  set_undivided(space, at, s);
  factor_triangle(at->rows, s);
  for (int i = 0; i < at->rows; i++) {
    const double *high = space->sides + side->turn + (i < 4 ? i : 12 + i - 4);
    int next = i < 4 ? 4 : 2;
    x[i] = high[0] * y[0] + high[next] * y[1] + high[2 * next] * y[2];
    for (int k = 0; k < i; k++) {
      x[i] -= s[k][i] * x[k];
    }
    grip += x[i] * x[i] / s[i][i];
  }
  return grip / square;
}
