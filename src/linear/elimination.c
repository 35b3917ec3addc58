/* SPDX-License-Identifier: BSD-3-Clause */
/* Minimum degree on the explicit elimination graph (D. J. Rose, 1972; in rounds of independent
 * nodes: J. W. H. Liu, 1985). Eliminating a node couples all its neighbours with each other. The
 * graphs of joints are sparse and stay so; where they do not, the caller wants another solver
 * anyway.
 *
 * A node whose neighbours are all coupled already makes no fill whatever its degree is. Such nodes
 * come first, so that a round takes all ends of a mechanism, not the thinnest only.
 */
#include "linear/elimination.h"

#include <stdbool.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "base/message.h"

/* A growing list of nodes. */
typedef struct list {
  int32_t *item;
  int32_t count;
  int32_t room;
} list;

/* Everything while the order is being found. Nodes not yet eliminated stand in buckets: those
 * without fill in the first, the others by degree; those that a round has touched wait for the next
 * one. */
typedef struct search {
  int count;
  list *coupled;     /* (count) */
  int32_t *head;     /* (count) first of each bucket, -1: empty */
  int32_t *next;     /* (count) */
  int32_t *previous; /* (count) -1: first */
  int32_t *bucket;   /* (count) */
  int32_t *touched;  /* (count) round */
  int32_t *mark;     /* (count) */
  int32_t stamp;
  int32_t round;
  int most;
  list waiting; /* touched in this round */
  list later;   /* of all eliminated ones, as nodes */
  baum_i_elimination *out;
} search;

static baum_status push(list *l, int32_t item)
{
  if (l->count == l->room) {
    int32_t room = l->room > 0 ? 2 * l->room : 4;
    int32_t *grown = baum_i_grow(l->item, (size_t)room, sizeof *grown);
    if (!grown) {
      return BAUM_ERR_MEMORY;
    }
    l->item = grown;
    l->room = room;
  }
  l->item[l->count++] = item;
  return BAUM_OK;
}

/* ---- buckets ---- */

/* Whether all neighbours of a node are coupled with each other. Of many it is not asked. */
static bool makes_no_fill(search *s, int32_t node)
{
  enum { MANY = 8 };
  const list *around = &s->coupled[node];
  bool none = around->count <= MANY;
  s->stamp++;
  for (int32_t i = 0; i < around->count && none; i++) {
    s->mark[around->item[i]] = s->stamp;
  }
  for (int32_t i = 0; i < around->count && none; i++) {
    const list *beyond = &s->coupled[around->item[i]];
    int32_t shared = 1;
    for (int32_t k = 0; k < beyond->count; k++) {
      shared += s->mark[beyond->item[k]] == s->stamp ? 1 : 0;
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

/* The neighbours of `node`, which goes, become neighbours of `other`, which is one of them. */
static baum_status couple(search *s, int32_t node, int32_t other)
{
  const list *gone = &s->coupled[node];
  list *mine = &s->coupled[other];
  s->stamp++;
  s->mark[other] = s->stamp;
  int32_t kept = 0;
  for (int32_t i = 0; i < mine->count; i++) {
    if (mine->item[i] != node) {
      s->mark[mine->item[i]] = s->stamp;
      mine->item[kept++] = mine->item[i];
    }
  }
  mine->count = kept;
  for (int32_t i = 0; i < gone->count; i++) {
    if (s->mark[gone->item[i]] != s->stamp) {
      BAUM_I_TRY(push(mine, gone->item[i]));
    }
  }
  return BAUM_OK;
}

/* Out of its bucket until the next round. */
static baum_status touch(search *s, int32_t node)
{
  if (s->touched[node] == s->round) {
    return BAUM_OK;
  }
  leave(s, node);
  s->touched[node] = s->round;
  return push(&s->waiting, node);
}

static baum_status eliminate(search *s, int32_t node)
{
  baum_i_elimination *out = s->out;
  list *gone = &s->coupled[node];
  for (int32_t i = 0; i < gone->count; i++) {
    int32_t other = gone->item[i];
    BAUM_I_TRY(touch(s, other));
    BAUM_I_TRY(couple(s, node, other));
    BAUM_I_TRY(push(&s->later, other));
  }
  out->place[node] = out->count;
  out->node[out->count++] = node;
  out->start[out->count] = s->later.count;
  baum_i_free(gone->item);
  *gone = (list){0};
  return s->later.count > s->most ? BAUM_ERR_SINGULAR : BAUM_OK;
}

static baum_status take_round(search *s, int32_t bucket)
{
  s->round++;
  s->waiting.count = 0;
  while (s->head[bucket] >= 0) {
    int32_t node = s->head[bucket];
    leave(s, node);
    BAUM_I_TRY(eliminate(s, node));
  }
  for (int32_t i = 0; i < s->waiting.count; i++) {
    enter(s, s->waiting.item[i]);
  }
  return BAUM_OK;
}

static baum_status take_rounds(search *s)
{
  while (s->out->count < s->count) {
    int32_t bucket = 0;
    while (s->head[bucket] < 0) {
      bucket++;
    }
    BAUM_I_TRY(take_round(s, bucket));
  }
  return BAUM_OK;
}

/* ---- before and after ---- */

static baum_status begin(search *s, const baum_i_graph *graph)
{
  for (int i = 0; i < s->count; i++) {
    s->head[i] = -1;
  }
  for (int32_t i = 0; i < s->count; i++) {
    for (int32_t k = graph->start[i]; k < graph->start[i + 1]; k++) {
      BAUM_I_TRY(push(&s->coupled[i], graph->neighbour[k]));
    }
  }
  /* The last to enter a bucket is the first to leave it. */
  for (int32_t i = (int32_t)s->count - 1; i >= 0; i--) {
    enter(s, i);
  }
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
  out->later = s->later.item;
  s->later.item = NULL;
  for (int32_t i = 0; out->later && i < out->start[out->count]; i++) {
    out->later[i] = out->place[out->later[i]];
  }
  for (int k = 0; out->later && k < out->count; k++) {
    int32_t count = out->start[k + 1] - out->start[k];
    if (count > 1) {
      qsort(out->later + out->start[k], (size_t)count, sizeof *out->later, ascending);
    }
  }
}

static baum_status make_room(search *s)
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
    baum_i_free(s->coupled[i].item);
  }
  baum_i_free(s->coupled);
  baum_i_free(s->head);
  baum_i_free(s->waiting.item);
  baum_i_free(s->later.item);
}

baum_status baum_i_elimination_create(const baum_i_graph *graph, int most, baum_i_elimination *out)
{
  *out = (baum_i_elimination){0};
  search s = {.count = graph->count, .most = most, .out = out};
  baum_status status = make_room(&s);
  if (status == BAUM_OK) {
    status = begin(&s, graph);
  }
  if (status == BAUM_OK) {
    status = take_rounds(&s);
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

void baum_i_elimination_clear(baum_i_elimination *elimination)
{
  baum_i_free(elimination->node);
  baum_i_free(elimination->place);
  baum_i_free(elimination->start);
  baum_i_free(elimination->later);
  *elimination = (baum_i_elimination){0};
}
