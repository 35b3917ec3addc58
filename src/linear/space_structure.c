/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the structure of the Schur complement of a mechanism in space: nodes, sides, the order of
 * elimination, couplings, and all indices. */
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/space_block.h"
#include "linear/vector.h"

/* Limits on sides and couplings, as in block_structure.c. */
enum { MOST_SIDES = 48, MOST_COUPLINGS = 24, SMALL = 64 };

/* Number of nodes that a stage eliminates. Their data have 300 to 600 kB. The number is even,
 * because nodes are factored in pairs. */
enum { STAGE = 128 };

/* sides[] begins with the constant parts E = I and E = -I of lean sides, which start at POSITIVE
 * and NEGATIVE and end at CONSTANTS. */
enum { POSITIVE = 0, NEGATIVE = 20, CONSTANTS = 40 };

typedef struct builder {
  const baum_i_space_layout *layout;
  baum_i_space *space;
  baum_i_vector nodes;  /* baum_i_space_node in the order of rows */
  baum_i_vector sides;  /* baum_i_space_side */
  int32_t *column_body; /* (nv) body of each column */
  int32_t *start;       /* (body_count + 1) start of the sides of each body in sorted[] */
  int32_t *sorted;      /* (side_count) sides by bodies */
  int32_t *side_node;   /* (side_count) node of each side, in the order of rows */
  int32_t *graph_start; /* (node_count + 1) */
  baum_i_vector neighbours;
  int32_t *coupling_stage; /* (coupling_count) stage in which the block of a coupling must be set */
  baum_i_vector pairs, zeros, targets;
} builder;

/* ---- bodies ---- */

static const int32_t whole_slots[6] = {0, 1, 2, 3, 4, 5};
static const int32_t plane_slots[3] = {0, 1, 5};

static baum_status make_bodies(builder *u)
{
  const baum_i_kkt_structure *s = u->layout->structure;
  baum_i_space *b = u->space;
  b->body_count = 1 + s->mass_block_count;
  b->bodies = baum_i_alloc_lines((size_t)b->body_count, sizeof *b->bodies);
  u->column_body = baum_i_alloc((size_t)s->nv, sizeof *u->column_body);
  if (!b->bodies || !u->column_body) {
    return BAUM_ERR_MEMORY;
  }
  for (int32_t i = 0; i < s->mass_block_count; i++) {
    const baum_i_mass_block *block = &s->mass_blocks[i];
    bool planar = u->layout->kinds[i] >= BAUM_I_SPACE_PLANAR_BODY;
    baum_i_space_body *body = &b->bodies[1 + i];
    body->fixed = u->layout->fixed[i] != 0;
    body->first = block->first;
    body->size = block->size;
    body->slots = planar ? plane_slots : whole_slots;
    for (int c = 0; c < block->size; c++) {
      u->column_body[block->first + c] = 1 + i;
    }
  }
  return BAUM_OK;
}

/* W of fixed bodies is 0, so they couple no nodes. */
static bool couples(const builder *u, int body)
{
  return body > 0 && !u->space->bodies[body].fixed;
}

/* ---- nodes and sides ---- */

static baum_i_space_side *find_side(builder *u, int first, int32_t body)
{
  baum_i_space_side *sides = u->sides.items;
  for (int i = first; i < u->sides.count; i++) {
    if (sides[i].body == body) {
      return &sides[i];
    }
  }
  baum_i_space_side *side = baum_i_vector_append(&u->sides);
  if (side) {
    side->body = body;
    for (int c = 0; c < BAUM_I_SPACE_ROWS; c++) {
      side->from[c] = -1;
    }
  }
  return side;
}

static baum_status add_sides(builder *u, const baum_i_row_block *rows, baum_i_space_node *node)
{
  node->first_side = u->sides.count;
  for (int c = 0; c < rows->cols; c++) {
    int32_t column = rows->col[c];
    int32_t number = u->column_body[column];
    const baum_i_space_body *body = &u->space->bodies[number];
    baum_i_space_side *side = find_side(u, node->first_side, number);
    if (!side) {
      return BAUM_ERR_MEMORY;
    }
    side->from[body->slots[column - body->first]] = c;
  }
  node->side_count = u->sides.count - node->first_side;
  return BAUM_OK;
}

/* Tells whether the first rows of the node make the points of the joint coincide. */
static bool is_lean(const builder *u, const baum_i_row_block *rows, const baum_i_space_node *node)
{
  int points = rows->rows < 3 ? rows->rows : 3;
  return u->layout->pinned[node->row_block] >= 0 && node->rows >= points &&
         node->row[points - 1] == rows->row + points - 1 && (node->omitted & 7u) == 0;
}

/* Adds the spin row of a body to a node. */
static void add_spin_row(builder *u, int body, baum_i_space_node *node)
{
  node->spin = body;
  node->omitted |= 1u << node->rows++;
  u->space->bodies[body].raised = true;
}

/* Adds a node for each group of up to six rows. Omitted rows are skipped, unless the layout marks
 * the row block as `whole`. */
static baum_status add_nodes(builder *u, int row_block)
{
  const baum_i_row_block *rows = &u->layout->structure->row_blocks[row_block];
  const unsigned char *omitted = u->layout->omitted;
  for (int row = rows->row; row < rows->row + rows->rows;) {
    baum_i_space_node node = {.row_block = row_block};
    for (; row < rows->row + rows->rows && node.rows < BAUM_I_SPACE_ROWS; row++) {
      if (!omitted[row] || u->layout->whole[row_block]) {
        node.omitted |= omitted[row] ? 1u << node.rows : 0u;
        node.row[node.rows++] = row;
      }
    }
    if (node.rows > 0) {
      if (u->layout->spins && u->layout->spins[row_block] > 0) {
        add_spin_row(u, u->layout->spins[row_block], &node);
      }
      node.lean = is_lean(u, rows, &node);
      BAUM_I_TRY(add_sides(u, rows, &node));
      baum_i_space_node *added = baum_i_vector_append(&u->nodes);
      if (!added) {
        return BAUM_ERR_MEMORY;
      }
      *added = node;
    }
  }
  return BAUM_OK;
}

static baum_status make_nodes(builder *u)
{
  for (int i = 0; i < u->layout->structure->row_block_count; i++) {
    BAUM_I_TRY(add_nodes(u, i));
  }
  u->space->node_count = u->nodes.count;
  u->space->side_count = u->sides.count;
  return BAUM_OK;
}

/* ---- the graph ---- */

static baum_status sort_sides(builder *u)
{
  int bodies = u->space->body_count;
  const baum_i_space_side *sides = u->sides.items;
  const baum_i_space_node *nodes = u->nodes.items;
  u->start = baum_i_alloc((size_t)bodies + 2, sizeof *u->start);
  u->sorted = baum_i_alloc((size_t)u->sides.count, sizeof *u->sorted);
  u->side_node = baum_i_alloc((size_t)u->sides.count, sizeof *u->side_node);
  if (!u->start || !u->sorted || !u->side_node) {
    return BAUM_ERR_MEMORY;
  }
  for (int32_t k = 0; k < u->nodes.count; k++) {
    for (int s = 0; s < nodes[k].side_count; s++) {
      u->side_node[nodes[k].first_side + s] = k;
    }
  }
  int32_t *place = u->start + 1; /* filling the list moves each start to the next one */
  for (int i = 0; i < u->sides.count; i++) {
    place[sides[i].body + 1]++;
  }
  for (int t = 0; t < bodies; t++) {
    if (couples(u, t) && place[t + 1] > MOST_SIDES) {
      u->space->hub = t - 1;
      return BAUM_ERR_SINGULAR;
    }
    place[t + 1] += place[t];
  }
  for (int32_t i = 0; i < u->sides.count; i++) {
    u->sorted[place[sides[i].body]++] = i;
  }
  return BAUM_OK;
}

static baum_status add_neighbours(builder *u, int32_t node, int32_t *mark)
{
  const baum_i_space_node *at = (const baum_i_space_node *)u->nodes.items + node;
  const baum_i_space_side *sides = u->sides.items;
  mark[node] = node + 1;
  for (int s = at->first_side; s < at->first_side + at->side_count; s++) {
    int32_t body = sides[s].body;
    for (int32_t k = u->start[body]; couples(u, body) && k < u->start[body + 1]; k++) {
      int32_t other = u->side_node[u->sorted[k]];
      if (mark[other] != node + 1) {
        mark[other] = node + 1;
        BAUM_I_TRY(baum_i_vector_append_number(&u->neighbours, other));
      }
    }
  }
  return BAUM_OK;
}

static baum_status find_order(builder *u)
{
  int count = u->nodes.count;
  u->graph_start = baum_i_alloc((size_t)count + 1, sizeof *u->graph_start);
  int32_t *mark = baum_i_alloc((size_t)count, sizeof *mark);
  baum_status status = u->graph_start && mark ? BAUM_OK : BAUM_ERR_MEMORY;
  for (int32_t i = 0; i < count && status == BAUM_OK; i++) {
    status = add_neighbours(u, i, mark);
    u->graph_start[i + 1] = u->neighbours.count;
  }
  const baum_i_space_node *nodes = u->nodes.items;
  int32_t *size = mark; /* the marks are no longer needed */
  for (int32_t i = 0; i < count && status == BAUM_OK; i++) {
    size[i] = nodes[i].rows;
  }
  const baum_i_graph graph = {count, u->graph_start, u->neighbours.items, size};
  if (status == BAUM_OK) {
    int most = MOST_COUPLINGS * (count + SMALL);
    status = baum_i_elimination_create(&graph, most, &u->space->order);
  }
  baum_i_free(mark);
  return status;
}

/* ---- nodes in the order of elimination ---- */

static int rounded(int count)
{
  return (count + 3) / 4 * 4;
}

/* Returns the number of entries of D or of its factors: three columns of a 3 x 3 inverse, and for
 * each further row one column of Y and one column of the second inverse. */
static int pivot_numbers(int rows)
{
  return rows > 3 ? 12 + 8 * (rows - 3) : 12;
}

static void place_side(const builder *u, const baum_i_space_node *node, baum_i_space_side *side)
{
  baum_i_space *b = u->space;
  bool negative = side->body == u->layout->pinned[node->row_block];
  if (node->lean) {
    side->sign = negative ? -1 : 1;
    side->move = negative ? NEGATIVE : POSITIVE;
  } else {
    side->move = b->numbers_of_sides;
    b->numbers_of_sides += baum_i_space_part(node->rows);
  }
  side->turn = b->numbers_of_sides;
  b->numbers_of_sides += baum_i_space_part(node->rows);
}

static baum_status place_nodes(builder *u)
{
  baum_i_space *b = u->space;
  const baum_i_space_node *nodes = u->nodes.items;
  const baum_i_space_side *sides = u->sides.items;
  b->list = baum_i_alloc((size_t)b->node_count, sizeof *b->list);
  b->side_list = baum_i_alloc((size_t)b->side_count, sizeof *b->side_list);
  if (!b->list || !b->side_list) {
    return BAUM_ERR_MEMORY;
  }
  int next = 0;
  b->numbers_of_sides = CONSTANTS;
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *from = &nodes[b->order.node[k]];
    baum_i_space_node *node = &b->list[k];
    *node = *from;
    node->at = b->numbers_of_nodes;
    node->place = b->numbers_of_rows;
    node->first_side = next;
    b->numbers_of_nodes += baum_i_space_pivot(node->rows) + pivot_numbers(node->rows);
    b->numbers_of_rows += baum_i_space_vector(node->rows);
    for (int s = 0; s < node->side_count; s++) {
      b->side_list[next] = sides[from->first_side + s];
      place_side(u, node, &b->side_list[next++]);
    }
  }
  return BAUM_OK;
}

/* ---- couplings ---- */

static void lower(int32_t *x, int32_t to)
{
  *x = to < *x ? to : *x;
}

static baum_status make_couplings(builder *u)
{
  baum_i_space *b = u->space;
  b->coupling_count = b->order.start[b->node_count];
  b->stage_count = b->node_count / STAGE + 1;
  b->couplings = baum_i_alloc((size_t)b->coupling_count, sizeof *b->couplings);
  b->stages = baum_i_alloc((size_t)b->stage_count + 1, sizeof *b->stages);
  b->node_stages = baum_i_alloc((size_t)b->node_count, sizeof *b->node_stages);
  u->coupling_stage = baum_i_alloc((size_t)b->coupling_count, sizeof *u->coupling_stage);
  if (!b->couplings || !b->stages || !b->node_stages || !u->coupling_stage) {
    return BAUM_ERR_MEMORY;
  }
  for (int k = 0; k < b->node_count; k++) {
    for (int e = b->order.start[k]; e < b->order.start[k + 1]; e++) {
      int later = b->order.later[e];
      int height = b->list[later].rows > 4 ? 6 : 4;
      b->couplings[e] = (baum_i_space_coupling){.later = later,
                                                .at = b->numbers_off,
                                                .numbers = b->list[later].at,
                                                .rows = b->list[later].rows};
      u->coupling_stage[e] = k / STAGE;
      b->numbers_off += rounded(height * b->list[k].rows);
    }
  }
  return BAUM_OK;
}

static baum_status add_pair(builder *u, int32_t i, int32_t k)
{
  baum_i_space *b = u->space;
  int32_t place[2] = {b->order.place[u->side_node[i]], b->order.place[u->side_node[k]]};
  int32_t raw[2] = {i, k};
  int late = place[0] > place[1] ? 0 : 1;
  baum_i_space_pair *pair = baum_i_vector_append(&u->pairs);
  if (!pair) {
    return BAUM_ERR_MEMORY;
  }
  const baum_i_space_side *side[2];
  const baum_i_space_node *raw_nodes = u->nodes.items;
  for (int n = 0; n < 2; n++) {
    int which = n == 0 ? late : 1 - late;
    const baum_i_space_node *node = &b->list[place[which]];
    int own = raw[which] - raw_nodes[u->side_node[raw[which]]].first_side;
    side[n] = &b->side_list[node->first_side + own];
    pair->rows[n] = node->rows;
    pair->move[n] = side[n]->move;
    pair->turn[n] = side[n]->turn;
  }
  pair->to = b->couplings[baum_i_elimination_find(&b->order, place[1 - late], place[late])].at;
  pair->body = side[0]->body;
  pair->sign = side[0]->sign * side[1]->sign;
  return BAUM_OK;
}

static int by_block(const void *a, const void *b)
{
  const baum_i_space_pair *x = a;
  const baum_i_space_pair *y = b;
  return x->to != y->to ? (x->to > y->to) - (x->to < y->to) : x->turn[0] - y->turn[0];
}

static int by_stage(const void *a, const void *b)
{
  const baum_i_space_pair *x = a;
  const baum_i_space_pair *y = b;
  return x->stage != y->stage ? x->stage - y->stage : by_block(a, b);
}

static baum_status make_pairs(builder *u)
{
  baum_i_space *b = u->space;
  for (int t = 1; t < b->body_count; t++) {
    for (int32_t i = u->start[t]; couples(u, t) && i < u->start[t + 1]; i++) {
      for (int32_t k = u->start[t]; k < i; k++) {
        BAUM_I_TRY(add_pair(u, u->sorted[i], u->sorted[k]));
      }
    }
  }
  if (u->pairs.count > 1) {
    qsort(u->pairs.items, (size_t)u->pairs.count, u->pairs.size, by_block);
  }
  baum_i_space_pair *pairs = u->pairs.items;
  int next = 0;
  for (int e = 0; e < b->coupling_count; e++) {
    int first = next;
    for (; next < u->pairs.count && pairs[next].to == b->couplings[e].at; next++) {
      pairs[next].adds = next > first;
      pairs[next].stage = u->coupling_stage[e];
    }
    if (next == first) {
      int end = e + 1 < b->coupling_count ? b->couplings[e + 1].at : b->numbers_off;
      BAUM_I_TRY(baum_i_vector_append_number(&u->zeros, b->couplings[e].at));
      BAUM_I_TRY(baum_i_vector_append_number(&u->zeros, end - b->couplings[e].at));
    }
  }
  return BAUM_OK;
}

/* The f-th coupling of a node is multiplied with all earlier couplings of this node. The block from
 * which the product is subtracted must be set before. */
static baum_status make_targets(builder *u)
{
  baum_i_space *b = u->space;
  const baum_i_elimination *order = &b->order;
  for (int k = 0; k < b->node_count; k++) {
    if (k % STAGE == 0) {
      b->stages[k / STAGE].target = u->targets.count;
    }
    for (int f = order->start[k] + 1; f < order->start[k + 1]; f++) {
      for (int e = order->start[k]; e < f; e++) {
        int32_t to = baum_i_elimination_find(order, order->later[e], order->later[f]);
        BAUM_I_TRY(baum_i_vector_append_number(&u->targets, b->couplings[to].at));
        lower(&u->coupling_stage[to], k / STAGE);
      }
    }
  }
  return BAUM_OK;
}

/* ---- stages ---- */

/* Sorts the pairs by stages. A node must be set before the first of its couplings. */
static baum_status make_stages(builder *u)
{
  baum_i_space *b = u->space;
  baum_i_space_pair *pairs = u->pairs.items;
  int next = 0;
  for (int k = 0; k < b->node_count; k++) {
    b->node_stages[k] = k / STAGE;
  }
  for (int k = 0; k < b->node_count; k++) {
    for (int e = b->order.start[k]; e < b->order.start[k + 1]; e++) {
      lower(&b->node_stages[k], u->coupling_stage[e]);
      lower(&b->node_stages[b->couplings[e].later], u->coupling_stage[e]);
    }
  }
  if (u->pairs.count > 1) {
    qsort(pairs, (size_t)u->pairs.count, u->pairs.size, by_stage);
  }
  for (int s = 0; s <= b->stage_count; s++) {
    while (next < u->pairs.count && pairs[next].stage < s) {
      next++;
    }
    b->stages[s].node = s < b->stage_count ? s * STAGE : b->node_count;
    b->stages[s].pair = next;
  }
  return BAUM_OK;
}

/* ---- the whole structure ---- */

static void give_all(builder *u)
{
  baum_i_space *b = u->space;
  int ignored;
  b->pairs = baum_i_vector_give(&u->pairs, &b->pair_count);
  b->zeros = baum_i_vector_give(&u->zeros, &b->zero_count);
  b->zero_count /= 2;
  b->targets = baum_i_vector_give(&u->targets, &ignored);
  const void *const arrays[] = {u->nodes.items, u->sides.items,      u->column_body,
                                u->start,       u->sorted,           u->side_node,
                                u->graph_start, u->neighbours.items, u->coupling_stage};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
    baum_i_free(arrays[i]);
  }
}

typedef baum_status step(builder *u);

baum_status baum_i_space_find_structure(const baum_i_space_layout *layout, baum_i_space *space)
{
  static step *const steps[] = {make_bodies,    make_nodes,   sort_sides, find_order, place_nodes,
                                make_couplings, make_targets, make_pairs, make_stages};
  builder u = {.layout = layout,
               .space = space,
               .nodes = {.size = sizeof(baum_i_space_node)},
               .sides = {.size = sizeof(baum_i_space_side)},
               .neighbours = {.size = sizeof(int32_t)},
               .pairs = {.size = sizeof(baum_i_space_pair)},
               .zeros = {.size = sizeof(int32_t)},
               .targets = {.size = sizeof(int32_t)}};
  baum_status status = BAUM_OK;
  for (size_t i = 0; i < sizeof steps / sizeof *steps && status == BAUM_OK; i++) {
    status = steps[i](&u);
  }
  give_all(&u);
  return status;
}
