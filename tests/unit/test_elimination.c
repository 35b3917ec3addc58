/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares orders of elimination with an elimination on the full adjacency matrix of the graph. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <limits.h>
#include <math.h>
#include <string.h>

#include "linear/elimination.h"
#include "saddle.h" /* for random numbers */

enum { MOST = 60, MOST_EDGES = MOST * MOST };

/* ---- graphs ---- */

typedef struct graph {
  int count;
  bool coupled[MOST][MOST];
  int32_t start[MOST + 1];
  int32_t neighbour[MOST_EDGES];
} graph;

static void couple(graph *g, int i, int k)
{
  g->coupled[i][k] = true;
  g->coupled[k][i] = true;
}

static graph make_graph(int count)
{
  graph g;
  memset(&g, 0, sizeof g);
  g.count = count;
  return g;
}

static graph make_chain(int count)
{
  graph g = make_graph(count);
  for (int i = 1; i < count; i++) {
    couple(&g, i - 1, i);
  }
  return g;
}

static graph make_ring(int count)
{
  graph g = make_chain(count);
  couple(&g, 0, count - 1);
  return g;
}

static graph make_star(int count)
{
  graph g = make_graph(count);
  for (int i = 1; i < count; i++) {
    couple(&g, 0, i);
  }
  return g;
}

static graph make_clique(int count)
{
  graph g = make_graph(count);
  for (int i = 0; i < count; i++) {
    for (int k = 0; k < i; k++) {
      couple(&g, i, k);
    }
  }
  return g;
}

static graph make_tree(uint64_t *seed, int count)
{
  graph g = make_graph(count);
  for (int i = 1; i < count; i++) {
    couple(&g, i, (int)floor((saddle_random(seed) + 1.0) / 2.0 * i));
  }
  return g;
}

static graph make_random(uint64_t *seed, int count, double density)
{
  graph g = make_graph(count);
  for (int i = 0; i < count; i++) {
    for (int k = 0; k < i; k++) {
      if ((saddle_random(seed) + 1.0) / 2.0 < density) {
        couple(&g, i, k);
      }
    }
  }
  return g;
}

/* Computes the order of elimination of nodes of given sizes, which may be NULL. The neighbours of a
 * node are passed in decreasing order. Their order must not matter. */
static baum_status order_by_size(graph *g, const int32_t *size, int most, baum_i_elimination *out)
{
  int32_t at = 0;
  for (int i = 0; i < g->count; i++) {
    g->start[i] = at;
    for (int k = g->count - 1; k >= 0; k--) {
      if (g->coupled[i][k]) {
        g->neighbour[at++] = k;
      }
    }
  }
  g->start[g->count] = at;
  const baum_i_graph asked = {g->count, g->start, g->neighbour, size};
  return baum_i_elimination_create(&asked, most, out);
}

static baum_status order(graph *g, int most, baum_i_elimination *out)
{
  return order_by_size(g, NULL, most, out);
}

static int count_edges(const graph *g)
{
  int count = 0;
  for (int i = 0; i < g->count; i++) {
    for (int k = 0; k < i; k++) {
      count += g->coupled[i][k] ? 1 : 0;
    }
  }
  return count;
}

/* ---- elimination on a full matrix ---- */

/* Couples all neighbours of `node` with each other and removes `node`. Returns the number of
 * neighbours. */
static int eliminate(graph *g, int node)
{
  int degree = 0;
  for (int i = 0; i < g->count; i++) {
    degree += g->coupled[node][i] ? 1 : 0;
    for (int k = 0; k < i; k++) {
      if (g->coupled[node][i] && g->coupled[node][k]) {
        couple(g, i, k);
      }
    }
  }
  for (int i = 0; i < g->count; i++) {
    g->coupled[node][i] = false;
    g->coupled[i][node] = false;
  }
  return degree;
}

/* Checks that each step of the elimination lists exactly the remaining neighbours of the node that
 * it eliminates. */
static void assert_elimination(const graph *given, const baum_i_elimination *found)
{
  graph g = *given;
  bool gone[MOST] = {false};
  assert_int_equal(found->count, g.count);
  assert_int_equal(found->start[0], 0);
  for (int p = 0; p < g.count; p++) {
    int node = found->node[p];
    assert_true(node >= 0 && node < g.count && !gone[node]);
    assert_int_equal(found->place[node], p);
    gone[node] = true;
    const int32_t *later = found->later + found->start[p];
    int count = found->start[p + 1] - found->start[p];
    for (int e = 0; e < count; e++) {
      assert_true(e == 0 || later[e - 1] < later[e]);
      assert_true(later[e] > p && later[e] < g.count);
      assert_true(g.coupled[node][found->node[later[e]]]);
    }
    assert_int_equal(eliminate(&g, node), count);
  }
}

static int couplings_in_order(const graph *given)
{
  graph g = *given;
  int sum = 0;
  for (int i = 0; i < g.count; i++) {
    sum += eliminate(&g, i);
  }
  return sum;
}

/* Returns the number of couplings that arise if every step eliminates a node with the fewest
 * neighbours. */
static int couplings_by_greed(const graph *given)
{
  graph g = *given;
  bool gone[MOST] = {false};
  int sum = 0;
  for (int round = 0; round < g.count; round++) {
    int best = -1;
    int least = MOST;
    for (int i = 0; i < g.count; i++) {
      int degree = 0;
      for (int k = 0; k < g.count; k++) {
        degree += g.coupled[i][k] ? 1 : 0;
      }
      if (!gone[i] && degree < least) {
        least = degree;
        best = i;
      }
    }
    gone[best] = true;
    sum += eliminate(&g, best);
  }
  return sum;
}

static int check(graph *g)
{
  baum_i_elimination found;
  assert_int_equal(order(g, INT_MAX, &found), BAUM_OK);
  assert_elimination(g, &found);
  int couplings = found.start[found.count];
  baum_i_elimination_clear(&found);
  return couplings;
}

/* ---- tests ---- */

static void graphs_without_rings_have_no_fill(void **state)
{
  (void)state;
  uint64_t seed = 1;
  for (int count = 1; count <= MOST; count++) {
    graph chain = make_chain(count);
    graph star = make_star(count);
    graph tree = make_tree(&seed, count);
    assert_int_equal(check(&chain), count - 1);
    assert_int_equal(check(&star), count - 1);
    assert_int_equal(check(&tree), count - 1);
  }
}

/* The elimination alternates between the two ends. A step thus does not have to wait for the result
 * of the step before. */
static void chains_are_eliminated_from_both_ends_in_turn(void **state)
{
  (void)state;
  enum { COUNT = 21 };
  graph chain = make_chain(COUNT);
  baum_i_elimination found;
  assert_int_equal(order(&chain, INT_MAX, &found), BAUM_OK);
  for (int p = 0; p + 1 < COUNT; p++) {
    int from_end = p / 2;
    int node = found.node[p];
    assert_true(node == from_end || node == COUNT - 1 - from_end);
  }
  assert_int_equal(found.node[COUNT - 1], COUNT / 2);
  baum_i_elimination_clear(&found);
}

/* The joints of an N-four-bar: bars 0 to N are pinned to the ground, and coupler k joins bar k to
 * bar k + 1. Node 3 k is the pin between bar k and the ground. Nodes 3 k + 1 and 3 k + 2 are the
 * pins at the two ends of coupler k. */
static graph make_ladder(int windows)
{
  graph g = make_graph(3 * windows + 1);
  for (int k = 0; k < windows; k++) {
    couple(&g, 3 * k, 3 * k + 1);
    couple(&g, 3 * k + 1, 3 * k + 2);
    couple(&g, 3 * k + 2, 3 * k + 3);
    if (k > 0) {
      couple(&g, 3 * k - 1, 3 * k + 1);
    }
  }
  return g;
}

/* The library sorts the nodes by their distance from the root of the elimination tree. At most four
 * nodes have the same distance, two at each end of the ladder. The elimination of a node changes
 * only nodes that are at most two levels nearer to the root. In the order of elimination, these
 * nodes therefore come less than 12 places after the eliminated node. */
static void nodes_come_shortly_before_the_nodes_that_they_change(void **state)
{
  (void)state;
  graph ladder = make_ladder(19);
  baum_i_elimination found;
  (void)check(&ladder);
  assert_int_equal(order(&ladder, INT_MAX, &found), BAUM_OK);
  for (int k = 0; k < found.count; k++) {
    for (int e = found.start[k]; e < found.start[k + 1]; e++) {
      assert_true(found.later[e] - k < 12);
    }
  }
  baum_i_elimination_clear(&found);
}

/* The joints of a Stewart platform: each leg is a chain of nodes of the sizes 4, 5 and 3, and the
 * six nodes of size 3 are all coupled with each other. All nodes of the sizes 4 and 5 are
 * eliminated in pairs. */
static void independent_nodes_of_the_same_size_are_adjacent(void **state)
{
  (void)state;
  enum { LEGS = 6, COUNT = 3 * LEGS };
  static const int32_t SIZES[3] = {4, 5, 3};
  graph g = make_graph(COUNT);
  int32_t size[COUNT];
  for (int k = 0; k < COUNT; k++) {
    size[k] = SIZES[k % 3];
    for (int i = k % 3 == 2 ? 2 : k; i < k; i += 3) {
      couple(&g, i, k);
    }
    if (k % 3 > 0) {
      couple(&g, k - 1, k);
    }
  }
  baum_i_elimination found;
  assert_int_equal(order_by_size(&g, size, INT_MAX, &found), BAUM_OK);
  assert_elimination(&g, &found);
  int pairs = 0;
  for (int p = 0; p + 1 < COUNT; p++) {
    bool coupled = found.later[found.start[p]] == p + 1;
    if (size[found.node[p]] == size[found.node[p + 1]] && !coupled) {
      pairs++;
      p++;
    }
  }
  assert_int_equal(pairs, LEGS);
  baum_i_elimination_clear(&found);
}

/* Each elimination removes one node of a ring and couples its two neighbours, until three nodes are
 * left. */
static void rings_have_the_least_possible_fill(void **state)
{
  (void)state;
  for (int count = 3; count <= MOST; count++) {
    graph ring = make_ring(count);
    assert_int_equal(check(&ring), count + count - 3);
  }
}

static void cliques_are_full(void **state)
{
  (void)state;
  for (int count = 1; count <= 20; count++) {
    graph clique = make_clique(count);
    assert_int_equal(check(&clique), count * (count - 1) / 2);
  }
}

static void uncoupled_nodes_and_empty_graphs_are_accepted(void **state)
{
  (void)state;
  graph none = make_graph(0);
  graph alone = make_graph(5);
  assert_int_equal(check(&none), 0);
  assert_int_equal(check(&alone), 0);
}

/* The library eliminates several nodes in each round. This may cause a few more couplings than the
 * greedy order, which eliminates one node at a time. It causes far fewer than an arbitrary
 * order. */
static void random_graphs_have_little_more_fill_than_in_the_greedy_order(void **state)
{
  (void)state;
  uint64_t seed = 2;
  int edges = 0;
  int found = 0;
  int greed = 0;
  int unordered = 0;
  for (int k = 0; k < 150; k++) {
    int count = 10 + k % (MOST - 10);
    graph g = make_random(&seed, count, (1.0 + k % 4) / count);
    edges += count_edges(&g);
    found += check(&g);
    greed += couplings_by_greed(&g);
    unordered += couplings_in_order(&g);
  }
  print_message("%d couplings, %d in the greedy order, %d in an arbitrary order; %d edges\n", found,
                greed, unordered, edges);
  assert_true(found >= edges);
  assert_true(found < 1.1 * greed);
  assert_true(found - edges < 0.5 * (unordered - edges));
}

static void too_many_couplings_are_refused(void **state)
{
  (void)state;
  graph ring = make_ring(20);
  baum_i_elimination found;
  assert_int_equal(order(&ring, 37, &found), BAUM_OK);
  baum_i_elimination_clear(&found);
  assert_int_equal(order(&ring, 36, &found), BAUM_ERR_SINGULAR);
  assert_null(found.node);
  assert_null(found.place);
  assert_null(found.start);
  assert_null(found.later);
  assert_int_equal(found.count, 0);
  baum_i_elimination_clear(&found);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(graphs_without_rings_have_no_fill),
    cmocka_unit_test(chains_are_eliminated_from_both_ends_in_turn),
    cmocka_unit_test(nodes_come_shortly_before_the_nodes_that_they_change),
    cmocka_unit_test(independent_nodes_of_the_same_size_are_adjacent),
    cmocka_unit_test(rings_have_the_least_possible_fill),
    cmocka_unit_test(cliques_are_full),
    cmocka_unit_test(uncoupled_nodes_and_empty_graphs_are_accepted),
    cmocka_unit_test(random_graphs_have_little_more_fill_than_in_the_greedy_order),
    cmocka_unit_test(too_many_couplings_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
