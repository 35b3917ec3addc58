/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the structure of the block Schur complement: nodes, sides, couplings, and all indices.
 *
 * The rows, in their order, are grouped into nodes with sides. Nodes with sides on the same body
 * block are coupled. The graph of these couplings gives the order of elimination. The position of a
 * node in this order is its *place*, which is also its final number. */
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/block_builder.h"

/* A body with more sides than MOST_SIDES couples too many nodes with each other. More couplings
 * than MOST_COUPLINGS times (number of nodes + SMALL) mean too much fill. In both cases, sparse
 * elimination of the whole system is faster, because it can eliminate joints before bodies. */
enum { MOST_SIDES = 48, MOST_COUPLINGS = 24, SMALL = 64 };

/* ---- bodies ---- */

static int body_blocks_for(int size)
{
  return (size + 2) / 3;
}

static int count_body_blocks(const baum_i_block_layout *layout, int *dense)
{
  const baum_i_kkt_structure *s = layout->structure;
  int count = 1 + s->mass_block_count;
  *dense = 0;
  for (int i = 0; i < s->mass_block_count; i++) {
    if (!layout->diagonal[i]) {
      ++*dense;
      count += body_blocks_for(s->mass_blocks[i].size);
    }
  }
  return count;
}

static baum_status make_bodies(baum_i_block_builder *u)
{
  const baum_i_kkt_structure *s = u->layout->structure;
  baum_i_block *b = u->block;
  b->body_block_count = count_body_blocks(u->layout, &b->dense_count);
  b->dense = baum_i_alloc((size_t)b->dense_count, sizeof *b->dense);
  b->place = baum_i_alloc((size_t)b->body_block_count, sizeof *b->place);
  u->column_body = baum_i_alloc((size_t)s->nv, sizeof *u->column_body);
  u->body_block_of = baum_i_alloc((size_t)s->mass_block_count, sizeof *u->body_block_of);
  u->dense_of = baum_i_alloc((size_t)s->mass_block_count, sizeof *u->dense_of);
  if (!b->dense || !b->place || !u->column_body || !u->body_block_of || !u->dense_of) {
    return BAUM_ERR_MEMORY;
  }
  return BAUM_OK;
}

/* Chooses the body blocks of all bodies. Mass block i belongs to body 1 + i. If the mass block is
 * diagonal, its body block is also 1 + i, so a planar body and its body block have the same
 * number. */
static void place_bodies(baum_i_block_builder *u)
{
  const baum_i_kkt_structure *s = u->layout->structure;
  baum_i_block *b = u->block;
  int32_t next = 1 + s->mass_block_count;
  int32_t end = s->nv;
  int dense = 0;
  b->place[0] = end;
  end += 3;
  for (int32_t i = 0; i < s->mass_block_count; i++) {
    const baum_i_mass_block *body = &s->mass_blocks[i];
    bool diagonal = u->layout->diagonal[i] != 0;
    u->body_block_of[i] = diagonal ? 1 + i : next;
    u->dense_of[i] = diagonal ? -1 : dense;
    b->place[1 + i] = body->first;
    b->leaves_v = b->leaves_v || !diagonal || body->size < 3;
    for (int c = 0; c < body->size; c++) {
      u->column_body[body->first + c] = i;
    }
    if (!diagonal) {
      b->dense[dense++] = (baum_i_dense_body){
        .mass_block = i, .body_block = next, .place = end, .factor = b->factor_size};
      b->factor_size += body->size * body->size;
      for (int k = 0; k < body_blocks_for(body->size); k++) {
        b->place[next++] = end;
        end += 3;
      }
    }
  }
  b->motion_size = end;
}

/* ---- nodes and sides ---- */

static bool is_omitted(const baum_i_block_builder *u, int row)
{
  return u->layout->omitted && u->layout->omitted[row] != 0;
}

static baum_status add_side(baum_i_block_builder *u, int32_t body_block, int32_t number)
{
  baum_i_raw_side *side = baum_i_vector_append(&u->sides);
  if (!side) {
    return BAUM_ERR_MEMORY;
  }
  *side = (baum_i_raw_side){.node = u->nodes.count - 1, .body_block = body_block, .number = number};
  baum_i_raw_node *nodes = u->nodes.items;
  nodes[u->nodes.count - 1].side_count++;
  return BAUM_OK;
}

static baum_i_raw_node *add_node(baum_i_block_builder *u)
{
  baum_i_raw_node *node = baum_i_vector_append(&u->nodes);
  if (node) {
    node->row[0] = -1;
    node->row[1] = -1;
    node->first_side = u->sides.count;
  }
  return node;
}

static baum_status add_pin(baum_i_block_builder *u, int row, const baum_i_block_pin *pin)
{
  baum_i_raw_node *node = add_node(u);
  if (!node) {
    return BAUM_ERR_MEMORY;
  }
  node->row[0] = row;
  node->row[1] = row + 1;
  node->is_pin = true;
  int32_t arm = 2 * u->raw_pins++;
  int32_t a = pin->body_a < 0 ? 0 : u->body_block_of[pin->body_a];
  int32_t b = pin->body_b < 0 ? 0 : u->body_block_of[pin->body_b];
  BAUM_I_TRY(add_side(u, a, ~arm));
  return add_side(u, b, ~(arm + 1));
}

/* Finds the general side of the present node on a body block, or adds one. */
static baum_status find_side(baum_i_block_builder *u, int32_t body_block, int32_t *number)
{
  const baum_i_raw_node *node = (baum_i_raw_node *)u->nodes.items + u->nodes.count - 1;
  const baum_i_raw_side *sides = u->sides.items;
  for (int i = node->first_side; i < node->first_side + node->side_count; i++) {
    if (sides[i].body_block == body_block) {
      *number = sides[i].number;
      return BAUM_OK;
    }
  }
  *number = u->full_sides.count;
  BAUM_I_TRY(baum_i_vector_append_number(&u->full_sides, body_block));
  return add_side(u, body_block, *number);
}

/* Finds or adds the sides of the present node on all body blocks of a dense body. New sides are
 * added together, so that they are consecutive. */
static baum_status find_dense_sides(baum_i_block_builder *u, int32_t body)
{
  int before = u->full_sides.count;
  int32_t first = 0;
  int size = u->layout->structure->mass_blocks[body].size;
  for (int k = 0; k < body_blocks_for(size); k++) {
    int32_t number;
    BAUM_I_TRY(find_side(u, u->body_block_of[body] + k, &number));
    first = k == 0 ? number : first;
  }
  if (u->full_sides.count == before) {
    return BAUM_OK;
  }
  baum_i_dense_side *side = baum_i_vector_append(&u->dense_sides);
  if (!side) {
    return BAUM_ERR_MEMORY;
  }
  *side = (baum_i_dense_side){.body = u->dense_of[body], .side = first};
  return BAUM_OK;
}

/* Adds the entries of one column of J in the rows of the present node. */
static baum_status add_column(baum_i_block_builder *u, const baum_i_row_block *rows, int c)
{
  int32_t body = u->column_body[rows->col[c]];
  int j = rows->col[c] - u->layout->structure->mass_blocks[body].first;
  int32_t number = 0;
  BAUM_I_TRY(u->dense_of[body] >= 0 ? find_dense_sides(u, body) : BAUM_OK);
  BAUM_I_TRY(find_side(u, u->body_block_of[body] + j / 3, &number));
  const baum_i_raw_node *node = (baum_i_raw_node *)u->nodes.items + u->nodes.count - 1;
  baum_i_side_entry *entry = baum_i_vector_append(&u->entries);
  if (!entry) {
    return BAUM_ERR_MEMORY;
  }
  entry->to = 6 * number + 2 * (j % 3);
  for (int r = 0; r < 2; r++) {
    int32_t row = node->row[r];
    entry->from[r] = row < 0 ? -1 : rows->value + (row - rows->row) * rows->cols + c;
  }
  return BAUM_OK;
}

static baum_status add_full(baum_i_block_builder *u, const baum_i_row_block *rows,
                            const int32_t row[2])
{
  baum_i_raw_node *node = add_node(u);
  if (!node) {
    return BAUM_ERR_MEMORY;
  }
  node->row[0] = row[0];
  node->row[1] = row[1];
  for (int c = 0; c < rows->cols; c++) {
    BAUM_I_TRY(add_column(u, rows, c));
  }
  return BAUM_OK;
}

/* Adds general nodes for the rows that are not omitted, two rows to a node. */
static baum_status add_rows(baum_i_block_builder *u, const baum_i_row_block *rows)
{
  int32_t pair[2] = {-1, -1};
  int have = 0;
  for (int r = rows->row; r < rows->row + rows->rows; r++) {
    if (!is_omitted(u, r)) {
      pair[have++] = r;
    }
    bool last = r == rows->row + rows->rows - 1;
    if (have == 2 || (have == 1 && last)) {
      BAUM_I_TRY(add_full(u, rows, pair));
      pair[0] = -1;
      pair[1] = -1;
      have = 0;
    }
  }
  return BAUM_OK;
}

static baum_status make_nodes(baum_i_block_builder *u)
{
  const baum_i_kkt_structure *s = u->layout->structure;
  for (int i = 0; i < s->row_block_count; i++) {
    const baum_i_row_block *rows = &s->row_blocks[i];
    const baum_i_block_pin *pin = &u->layout->pins[i];
    bool whole = pin->is_pin && !is_omitted(u, rows->row) && !is_omitted(u, rows->row + 1);
    BAUM_I_TRY(whole ? add_pin(u, rows->row, pin) : add_rows(u, rows));
  }
  return BAUM_OK;
}

/* Tells whether the next three entries are a whole side whose columns are consecutive in J. */
static bool is_whole_side(const baum_i_side_entry *entry, int left)
{
  bool whole = left >= 3 && entry->to % 6 == 0;
  for (int c = 1; c < 3 && whole; c++) {
    int32_t second = entry->from[1] < 0 ? -1 : entry->from[1] + c;
    whole = entry[c].to == entry->to + 2 * c && entry[c].from[0] == entry->from[0] + c &&
            entry[c].from[1] == second;
  }
  return whole;
}

/* Removes the entries of sides that can be copied from J as a whole. Sides of dense bodies keep
 * their entries, because they are multiplied by L^-1. */
static baum_status find_sources(baum_i_block_builder *u)
{
  baum_i_block *b = u->block;
  const int32_t *body_block = u->full_sides.items;
  baum_i_side_entry *entries = u->entries.items;
  int count = u->entries.count;
  b->side_from = baum_i_alloc(2 * (size_t)u->full_sides.count, sizeof *b->side_from);
  if (!b->side_from) {
    return BAUM_ERR_MEMORY;
  }
  for (int i = 0; i < 2 * u->full_sides.count; i++) {
    b->side_from[i] = -1;
  }
  u->entries.count = 0;
  for (int i = 0; i < count; i++) {
    int32_t side = entries[i].to / 6;
    bool dense = body_block[side] > u->layout->structure->mass_block_count;
    if (!dense && is_whole_side(&entries[i], count - i)) {
      memcpy(b->side_from + 2 * (ptrdiff_t)side, entries[i].from, sizeof entries[i].from);
      i += 2;
    } else {
      entries[u->entries.count++] = entries[i];
    }
  }
  return BAUM_OK;
}

/* ---- the graph ---- */

/* Returns the mass block of a body block that is not ground. */
static int body_of(const baum_i_block_builder *u, int body_block)
{
  int body = body_block - 1;
  for (int i = 0; i < u->layout->structure->mass_block_count; i++) {
    body = u->body_block_of[i] <= body_block && u->dense_of[i] >= 0 ? i : body;
  }
  return body;
}

/* Sorts sides by body blocks. */
static baum_status sort_sides(baum_i_block_builder *u)
{
  int body_blocks = u->block->body_block_count;
  u->sorted_start = baum_i_alloc((size_t)body_blocks + 2, sizeof *u->sorted_start);
  u->sorted = baum_i_alloc((size_t)u->sides.count, sizeof *u->sorted);
  if (!u->sorted_start || !u->sorted) {
    return BAUM_ERR_MEMORY;
  }
  const baum_i_raw_side *sides = u->sides.items;
  /* shifted by one entry, because filling the list moves each start to the next one */
  int32_t *place = u->sorted_start + 1;
  for (int i = 0; i < u->sides.count; i++) {
    place[sides[i].body_block + 1]++;
  }
  for (int t = 0; t < body_blocks; t++) {
    if (!baum_i_block_is_fixed(u, t) && place[t + 1] > MOST_SIDES) {
      u->block->hub = body_of(u, t);
      return BAUM_ERR_SINGULAR;
    }
    place[t + 1] += place[t];
  }
  for (int32_t i = 0; i < u->sides.count; i++) {
    u->sorted[place[sides[i].body_block]++] = i;
  }
  return BAUM_OK;
}

static baum_status add_neighbours(baum_i_block_builder *u, int32_t node, int32_t *mark)
{
  const baum_i_raw_node *nodes = u->nodes.items;
  const baum_i_raw_side *sides = u->sides.items;
  mark[node] = node + 1;
  for (int s = 0; s < nodes[node].side_count; s++) {
    int32_t body_block = sides[nodes[node].first_side + s].body_block;
    bool couples = !baum_i_block_is_fixed(u, body_block);
    for (int32_t k = u->sorted_start[body_block]; couples && k < u->sorted_start[body_block + 1];
         k++) {
      int32_t other = sides[u->sorted[k]].node;
      if (mark[other] != node + 1) {
        mark[other] = node + 1;
        BAUM_I_TRY(baum_i_vector_append_number(&u->neighbours, other));
      }
    }
  }
  return BAUM_OK;
}

static baum_status make_graph(baum_i_block_builder *u)
{
  int count = u->nodes.count;
  u->graph_start = baum_i_alloc((size_t)count + 1, sizeof *u->graph_start);
  int32_t *mark = baum_i_alloc((size_t)count, sizeof *mark);
  baum_status status = u->graph_start && mark ? BAUM_OK : BAUM_ERR_MEMORY;
  for (int32_t i = 0; i < count && status == BAUM_OK; i++) {
    status = add_neighbours(u, i, mark);
    u->graph_start[i + 1] = u->neighbours.count;
  }
  baum_i_free(mark);
  return status;
}

static baum_status find_order(baum_i_block_builder *u)
{
  baum_i_block *b = u->block;
  const baum_i_graph graph = {u->nodes.count, u->graph_start, u->neighbours.items, NULL};
  int most = MOST_COUPLINGS * (u->nodes.count + SMALL);
  BAUM_I_TRY(baum_i_elimination_create(&graph, most, &b->order));
  b->node_count = u->nodes.count;
  b->off_count = b->order.start[b->node_count];
  return BAUM_OK;
}

/* ---- nodes at their places ---- */

static baum_status place_nodes(baum_i_block_builder *u)
{
  baum_i_block *b = u->block;
  const baum_i_raw_node *nodes = u->nodes.items;
  const baum_i_raw_side *sides = u->sides.items;
  b->pins = baum_i_alloc(baum_i_even((size_t)u->raw_pins), sizeof *b->pins);
  b->fulls = baum_i_alloc((size_t)(b->node_count - u->raw_pins), sizeof *b->fulls);
  u->arm_of = baum_i_alloc((size_t)b->node_count, sizeof *u->arm_of);
  if (!b->pins || !b->fulls || !u->arm_of) {
    return BAUM_ERR_MEMORY;
  }
  for (int32_t k = 0; k < b->node_count; k++) {
    int32_t raw = b->order.node[k];
    const baum_i_raw_node *node = &nodes[raw];
    const baum_i_raw_side *side = &sides[node->first_side];
    if (node->is_pin) {
      u->arm_of[raw] = 2 * b->pin_count;
      b->pins[b->pin_count++] =
        (baum_i_pin_node){.node = k,
                          .row = node->row[0],
                          .body_block = {side[0].body_block, side[1].body_block},
                          .place = {b->place[side[0].body_block], b->place[side[1].body_block]}};
    } else {
      b->fulls[b->full_count++] =
        (baum_i_full_node){.node = k,
                           .row = {node->row[0], node->row[1]},
                           .first_side = node->side_count > 0 ? side[0].number : 0,
                           .side_count = node->side_count};
    }
  }
  if (b->pin_count % 2 == 1) {
    b->pins[b->pin_count] = b->pins[b->pin_count - 1];
  }
  return BAUM_OK;
}

/* ---- the whole structure ---- */

static void give_all(baum_i_block_builder *u)
{
  baum_i_block *b = u->block;
  int ignored;
  b->side_body_block = baum_i_vector_give(&u->full_sides, &b->side_count);
  b->entries = baum_i_vector_give(&u->entries, &b->entry_count);
  b->dense_sides = baum_i_vector_give(&u->dense_sides, &b->dense_side_count);
  b->alike = baum_i_vector_give(&u->alike, &b->alike_count);
  b->opposite = baum_i_vector_give(&u->opposite, &b->opposite_count);
  b->first_pairs = baum_i_vector_give(&u->first_pairs, &b->first_count);
  b->full_pairs = baum_i_vector_give(&u->full_pairs, &b->full_pair_count);
  b->zeros = baum_i_vector_give(&u->zeros, &b->zero_count);
  b->target = baum_i_vector_give(&u->targets, &ignored);
}

static void clear(baum_i_block_builder *u)
{
  const void *const arrays[] = {u->nodes.items,
                                u->sides.items,
                                u->full_sides.items,
                                u->entries.items,
                                u->alike.items,
                                u->opposite.items,
                                u->first_pairs.items,
                                u->full_pairs.items,
                                u->zeros.items,
                                u->targets.items,
                                u->dense_sides.items,
                                u->neighbours.items,
                                u->column_body,
                                u->body_block_of,
                                u->dense_of,
                                u->sorted_start,
                                u->sorted,
                                u->graph_start,
                                u->arm_of,
                                u->is_set};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
    baum_i_free(arrays[i]);
  }
}

typedef baum_status step(baum_i_block_builder *u);

baum_status baum_i_block_find_structure(const baum_i_block_layout *layout, baum_i_block *block)
{
  static step *const steps[] = {make_nodes,
                                find_sources,
                                sort_sides,
                                make_graph,
                                find_order,
                                place_nodes,
                                baum_i_block_make_pairs,
                                baum_i_block_make_targets};
  baum_i_block_builder u = {.layout = layout,
                            .block = block,
                            .nodes = {.size = sizeof(baum_i_raw_node)},
                            .sides = {.size = sizeof(baum_i_raw_side)},
                            .full_sides = {.size = sizeof(int32_t)},
                            .entries = {.size = sizeof(baum_i_side_entry)},
                            .dense_sides = {.size = sizeof(baum_i_dense_side)},
                            .neighbours = {.size = sizeof(int32_t)},
                            .alike = {.size = sizeof(baum_i_pin_pair)},
                            .opposite = {.size = sizeof(baum_i_pin_pair)},
                            .first_pairs = {.size = sizeof(baum_i_full_pair)},
                            .full_pairs = {.size = sizeof(baum_i_full_pair)},
                            .zeros = {.size = sizeof(int32_t)},
                            .targets = {.size = sizeof(int32_t)}};
  baum_status status = make_bodies(&u);
  if (status == BAUM_OK) {
    place_bodies(&u);
  }
  for (size_t i = 0; i < sizeof steps / sizeof *steps && status == BAUM_OK; i++) {
    status = steps[i](&u);
  }
  give_all(&u);
  clear(&u);
  return status;
}
