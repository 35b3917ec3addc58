/* SPDX-License-Identifier: BSD-3-Clause */
/* Minimum-degree ordering on the explicit elimination graph (D. J. Rose, 1972), in rounds of
 * independent nodes (J. W. H. Liu, 1985). Eliminating a node couples all its neighbours with each
 * other. Graphs of joints are sparse and mostly stay sparse; otherwise the caller uses another
 * solver.
 *
 * A node whose neighbours are already coupled with each other causes no fill, even if its degree is
 * high. Such nodes are eliminated first, so that one round eliminates all ends of a mechanism, not
 * only the ends of least degree. */
#include "linear/elimination.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/vector.h"

/* State of the search. Nodes that are not yet eliminated are in buckets. Bucket 0 contains nodes
 * that cause no fill; the bucket number of any other node is its degree. If a neighbour of a node
 * has been eliminated in this round, the node is in `waiting` until the next round. */
typedef struct search {
  int count;
  baum_i_vector *coupled; /* (count) neighbours of each node */
  int32_t *head;          /* (count) first node of each bucket; -1: empty */
  int32_t *next;          /* (count) */
  int32_t *previous;      /* (count) -1: first */
  int32_t *bucket;        /* (count) */
  int32_t *touched;       /* (count) the last round in which the node entered `waiting` */
  int32_t *mark;          /* (count) */
  const int32_t *size;    /* see baum_i_graph */
  int32_t stamp;
  int32_t round;
  int most;
  baum_i_vector waiting; /* touched in this round */
  baum_i_vector later;   /* neighbours of all eliminated nodes */
  baum_i_elimination *out;
} search;

/* ---- buckets ---- */

/* Tells whether all neighbours of a node are coupled with each other. Returns false without a check
 * for nodes with many neighbours. */
static bool makes_no_fill(search *s, int32_t node)
{
  enum { MANY = 8 };
  const baum_i_vector *around = &s->coupled[node];
  const int32_t *item = around->items;
  bool none = around->count <= MANY;
  s->stamp++;
  for (int32_t i = 0; i < around->count && none; i++) {
    s->mark[item[i]] = s->stamp;
  }
  for (int32_t i = 0; i < around->count && none; i++) {
    const baum_i_vector *beyond = &s->coupled[item[i]];
    const int32_t *other = beyond->items;
    int32_t shared = 1;
    for (int32_t k = 0; k < beyond->count; k++) {
      shared += s->mark[other[k]] == s->stamp;
    }
    none = shared == around->count;
  }
  return none;
}

static void enter(search *s, int32_t node)
{
  int32_t bucket = makes_no_fill(s, node) ? 0 : s->coupled[node].count;
  int32_t first = s->head[bucket];
  s->bucket[node] = bucket;
  s->next[node] = first;
  s->previous[node] = -1;
  if (first >= 0) {
    s->previous[first] = node;
  }
  s->head[bucket] = node;
}

static void leave(search *s, int32_t node)
{
  int32_t before = s->previous[node];
  int32_t after = s->next[node];
  if (before >= 0) {
    s->next[before] = after;
  } else {
    s->head[s->bucket[node]] = after;
  }
  if (after >= 0) {
    s->previous[after] = before;
  }
}

/* ---- elimination ---- */

/* `node` is being eliminated, and `other` is one of its neighbours. Makes the remaining neighbours
 * of `node` neighbours of `other`. */
static baum_status couple(search *s, int32_t node, int32_t other)
{
  const baum_i_vector *gone = &s->coupled[node];
  baum_i_vector *mine = &s->coupled[other];
  const int32_t *from = gone->items;
  int32_t *item = mine->items;
  s->stamp++;
  s->mark[other] = s->stamp;
  int32_t kept = 0;
  for (int32_t i = 0; i < mine->count; i++) {
    if (item[i] != node) {
      s->mark[item[i]] = s->stamp;
      item[kept++] = item[i];
    }
  }
  mine->count = kept;
  for (int32_t i = 0; i < gone->count; i++) {
    if (s->mark[from[i]] != s->stamp) {
      BAUM_I_TRY(baum_i_vector_append_number(mine, from[i]));
    }
  }
  return BAUM_OK;
}

/* Moves a node from its bucket to `waiting`. */
static baum_status touch(search *s, int32_t node)
{
  if (s->touched[node] == s->round) {
    return BAUM_OK;
  }
  leave(s, node);
  s->touched[node] = s->round;
  return baum_i_vector_append_number(&s->waiting, node);
}

static baum_status eliminate(search *s, int32_t node)
{
  baum_i_elimination *out = s->out;
  baum_i_vector *gone = &s->coupled[node];
  for (int32_t i = 0; i < gone->count; i++) {
    int32_t other = ((const int32_t *)gone->items)[i];
    BAUM_I_TRY(touch(s, other));
    BAUM_I_TRY(couple(s, node, other));
    BAUM_I_TRY(baum_i_vector_append_number(&s->later, other));
  }
  out->place[node] = out->count;
  out->node[out->count++] = node;
  out->start[out->count] = s->later.count;
  baum_i_free(gone->items);
  *gone = (baum_i_vector){0};
  return s->later.count > s->most ? BAUM_ERR_SINGULAR : BAUM_OK;
}

static baum_status eliminate_round(search *s, int32_t bucket)
{
  s->round++;
  s->waiting.count = 0;
  while (s->head[bucket] >= 0) {
    int32_t node = s->head[bucket];
    leave(s, node);
    BAUM_I_TRY(eliminate(s, node));
  }
  for (int32_t i = 0; i < s->waiting.count; i++) {
    enter(s, ((const int32_t *)s->waiting.items)[i]);
  }
  return BAUM_OK;
}

static baum_status eliminate_in_rounds(search *s)
{
  while (s->out->count < s->count) {
    int32_t bucket = 0;
    while (s->head[bucket] < 0) {
      bucket++;
    }
    BAUM_I_TRY(eliminate_round(s, bucket));
  }
  return BAUM_OK;
}

/* ---- start and final order ---- */

static baum_status load_graph(search *s, const baum_i_graph *graph)
{
  for (int i = 0; i < s->count; i++) {
    s->head[i] = -1;
  }
  for (int32_t i = 0; i < s->count; i++) {
    s->coupled[i].size = sizeof(int32_t);
    for (int32_t k = graph->start[i]; k < graph->start[i + 1]; k++) {
      BAUM_I_TRY(baum_i_vector_append_number(&s->coupled[i], graph->neighbour[k]));
    }
  }
  /* The last node that enters a bucket leaves it first, so nodes enter in descending order. */
  for (int32_t i = (int32_t)s->count - 1; i >= 0; i--) {
    enter(s, i);
  }
  return BAUM_OK;
}

/* Sets depth[k] (count) to the distance of place k from the root of the elimination tree, in which
 * the parent of a place is the first later place coupled with it. Returns the largest depth. */
static int32_t find_depths(const baum_i_elimination *order, const int32_t *later, int32_t *depth)
{
  int32_t most = 0;
  for (int32_t k = order->count - 1; k >= 0; k--) {
    int32_t parent = order->count;
    for (int32_t e = order->start[k]; e < order->start[k + 1]; e++) {
      int32_t place = order->place[later[e]];
      parent = place < parent ? place : parent;
    }
    depth[k] = parent < order->count ? depth[parent] + 1 : 0;
    most = depth[k] > most ? depth[k] : most;
  }
  return most;
}

/* Writes the places in the order of decreasing depth to sorted (count). Places of the same depth
 * keep their order. first (most + 2) is scratch. */
static void sort_by_depth(const int32_t *depth, int count, int32_t most, int32_t *first,
                          int32_t *sorted)
{
  for (int k = 0; k < count; k++) {
    first[most - depth[k] + 1]++;
  }
  for (int32_t d = 0; d < most; d++) {
    first[d + 1] += first[d];
  }
  for (int k = 0; k < count; k++) {
    sorted[first[most - depth[k]]++] = k;
  }
}

/* Tells whether the elimination of place `earlier` changes place `later`. */
static bool changes(const search *s, int32_t earlier, int32_t later)
{
  const baum_i_elimination *out = s->out;
  const int32_t *after = s->later.items;
  bool found = false;
  for (int32_t e = out->start[earlier]; e < out->start[earlier + 1]; e++) {
    found = found || out->place[after[e]] == later;
  }
  return found;
}

/* Returns the first of the next places of sorted[] that has the size of sorted[k] and that none of
 * the places from k on changes, or -1. */
static int find_twin(const search *s, const int32_t *sorted, int k)
{
  enum { MOST = 8 };
  const int32_t *node = s->out->node;
  int end = s->out->count - k <= MOST ? s->out->count : k + MOST + 1;
  for (int i = k + 1; i < end; i++) {
    bool fits = s->size[node[sorted[i]]] == s->size[node[sorted[k]]];
    for (int e = k; e < i && fits; e++) {
      fits = !changes(s, sorted[e], sorted[i]);
    }
    if (fits) {
      return i;
    }
  }
  return -1;
}

/* Makes independent places of the same size adjacent. */
static void join_twins(const search *s, int32_t *sorted)
{
  for (int k = 0; k < s->out->count; k++) {
    int twin = find_twin(s, sorted, k);
    if (twin >= 0) {
      int32_t place = sorted[twin];
      memmove(sorted + k + 2, sorted + k + 1, (size_t)(twin - k - 1) * sizeof *sorted);
      sorted[++k] = place;
    }
  }
}

/* Reorders the nodes so that each comes shortly before the nodes that its elimination changes. The
 * changed numbers are then still in the cache when they are needed. The fill stays the same, and
 * nodes of the same depth are independent of each other. */
static baum_status order_by_depth(search *s)
{
  baum_i_elimination *out = s->out;
  size_t n = (size_t)out->count;
  size_t count = (size_t)s->later.count;
  int32_t *later = s->later.items;
  int32_t *depth = baum_i_alloc(5 * n + 3 + count, sizeof *depth);
  if (!depth) {
    return BAUM_ERR_MEMORY;
  }
  int32_t *sorted = depth + n;
  int32_t *node = sorted + n;
  int32_t *start = node + n;
  int32_t *old = start + n + 1;
  int32_t most = find_depths(out, later, depth);
  sort_by_depth(depth, out->count, most, old + count, sorted);
  if (s->size) {
    join_twins(s, sorted);
  }
  memcpy(node, out->node, n * sizeof *node);
  memcpy(start, out->start, (n + 1) * sizeof *start);
  for (size_t i = 0; i < count; i++) {
    old[i] = later[i];
  }
  for (int32_t k = 0; k < out->count; k++) {
    int32_t from = sorted[k];
    out->node[k] = node[from];
    out->place[node[from]] = k;
    out->start[k + 1] = out->start[k];
    for (int32_t e = start[from]; e < start[from + 1]; e++) {
      later[out->start[k + 1]++] = old[e];
    }
  }
  baum_i_free(depth);
  return BAUM_OK;
}

static int ascending(const void *a, const void *b)
{
  int32_t x = *(const int32_t *)a;
  int32_t y = *(const int32_t *)b;
  return (x > y) - (x < y);
}

static void order_later(search *s)
{
  baum_i_elimination *out = s->out;
  int count = 0;
  out->later = baum_i_vector_give(&s->later, &count);
  for (int i = 0; i < count; i++) {
    out->later[i] = out->place[out->later[i]];
  }
  for (int k = 0; out->later && k < out->count; k++) {
    qsort(out->later + out->start[k], (size_t)(out->start[k + 1] - out->start[k]),
          sizeof *out->later, ascending);
  }
}

static baum_status allocate_search(search *s)
{
  size_t n = (size_t)s->count;
  baum_i_elimination *out = s->out;
  out->node = baum_i_alloc(n, sizeof *out->node);
  out->place = baum_i_alloc(n, sizeof *out->place);
  out->start = baum_i_alloc(n + 1, sizeof *out->start);
  s->coupled = baum_i_alloc(n, sizeof *s->coupled);
  s->head = baum_i_alloc(6 * n + 1, sizeof *s->head);
  if (!out->node || !out->place || !out->start || !s->coupled || !s->head) {
    return BAUM_ERR_MEMORY;
  }
  s->next = s->head + n;
  s->previous = s->next + n;
  s->bucket = s->previous + n;
  s->touched = s->bucket + n;
  s->mark = s->touched + n;
  return BAUM_OK;
}

static void clear_search(search *s)
{
  for (int i = 0; s->coupled && i < s->count; i++) {
    baum_i_free(s->coupled[i].items);
  }
  baum_i_free(s->coupled);
  baum_i_free(s->head);
  baum_i_free(s->waiting.items);
  baum_i_free(s->later.items);
}

baum_status baum_i_elimination_create(const baum_i_graph *graph, int most, baum_i_elimination *out)
{
  *out = (baum_i_elimination){0};
  search s = {.count = graph->count,
              .most = most,
              .size = graph->size,
              .out = out,
              .waiting = {.size = sizeof(int32_t)},
              .later = {.size = sizeof(int32_t)}};
  baum_status status = allocate_search(&s);
  if (status == BAUM_OK) {
    status = load_graph(&s, graph);
  }
  if (status == BAUM_OK) {
    status = eliminate_in_rounds(&s);
  }
  if (status == BAUM_OK) {
    status = order_by_depth(&s);
  }
  if (status == BAUM_OK) {
    order_later(&s);
  }
  clear_search(&s);
  if (status != BAUM_OK) {
    baum_i_elimination_clear(out);
  }
  return status;
}

int32_t baum_i_elimination_find(const baum_i_elimination *order, int32_t earlier, int32_t later)
{
  int32_t low = order->start[earlier];
  int32_t high = order->start[earlier + 1] - 1;
  while (low < high) {
    int32_t middle = (low + high) / 2;
    if (order->later[middle] < later) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

void baum_i_elimination_clear(baum_i_elimination *elimination)
{
  baum_i_free(elimination->node);
  baum_i_free(elimination->place);
  baum_i_free(elimination->start);
  baum_i_free(elimination->later);
  *elimination = (baum_i_elimination){0};
}
