/* SPDX-License-Identifier: BSD-3-Clause */
/* Islands of a mechanism in space: groups of bodies that nodes connect. The solver judges each
 * island separately, because islands may differ by large factors in mass, size and acceleration. */
#include "base/alloc.h"
#include "base/sets.h"
#include "linear/space_block.h"

static bool moves(const baum_i_space *b, int32_t body)
{
  return body > 0 && !b->bodies[body].fixed;
}

/* Returns the first moving body of a node, or its last body if none moves. */
static int32_t first_moving(const baum_i_space *b, const baum_i_space_node *node)
{
  const baum_i_space_side *side = &b->side_list[node->first_side];
  const baum_i_space_side *end = side + node->side_count;
  while (side + 1 < end && !moves(b, side->body)) {
    side++;
  }
  return side->body;
}

/* Unites the bodies of each island, and fixed bodies with ground. */
static void unite_bodies(const baum_i_space *b, int *parent)
{
  baum_i_sets_begin(parent, b->body_count);
  for (int t = 1; t < b->body_count; t++) {
    if (b->bodies[t].fixed) {
      baum_i_sets_unite(parent, 0, t);
    }
  }
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *node = &b->list[k];
    int32_t first = first_moving(b, node);
    for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
      if (moves(b, b->side_list[s].body)) {
        baum_i_sets_unite(parent, first, b->side_list[s].body);
      }
    }
  }
}

/* Sorts `count` items by their islands. start (islands + 1) receives the index in sorted[] of the
 * first item of each island. */
static void sort(const int *island_of, int count, int islands, int32_t *start, int32_t *sorted)
{
  for (int i = 0; i < count; i++) {
    start[island_of[i]]++;
  }
  for (int i = 0; i < islands; i++) {
    start[i + 1] += start[i]; /* start[i] is now the end of island i */
  }
  for (int i = count - 1; i >= 0; i--) {
    sorted[--start[island_of[i]]] = i;
  }
}

baum_status baum_i_space_find_islands(baum_i_space *space)
{
  size_t bodies = (size_t)space->body_count;
  size_t nodes = (size_t)space->node_count;
  int *of_body = baum_i_alloc(bodies + nodes, sizeof *of_body);
  space->island_bodies = baum_i_alloc(2 * bodies + 2, sizeof *space->island_bodies);
  space->island_nodes = baum_i_alloc(nodes + bodies + 2, sizeof *space->island_nodes);
  if (!of_body || !space->island_bodies || !space->island_nodes) {
    baum_i_free(of_body);
    return BAUM_ERR_MEMORY;
  }
  int *of_node = of_body + bodies;
  unite_bodies(space, of_body);
  int islands = baum_i_sets_number(of_body, space->body_count);
  space->island_count = islands > 1 ? islands : 2;
  for (int k = 0; k < space->node_count; k++) {
    int island = of_body[first_moving(space, &space->list[k])];
    of_node[k] = island > 0 ? island : 1;
  }
  space->body_start = space->island_bodies + bodies;
  space->node_start = space->island_nodes + nodes;
  sort(of_body, space->body_count, space->island_count, space->body_start, space->island_bodies);
  sort(of_node, space->node_count, space->island_count, space->node_start, space->island_nodes);
  baum_i_free(of_body);
  return BAUM_OK;
}
