/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds an order of elimination of a sparse symmetric matrix, and its fill. */
#ifndef BAUM_I_LINEAR_ELIMINATION_H
#define BAUM_I_LINEAR_ELIMINATION_H

#include <stdint.h>

#include <baum/status.h>

/* The graph of a matrix. If b is listed as a neighbour of a, a is also listed as a neighbour of b.
 * A node is not its own neighbour.
 */
typedef struct baum_i_graph {
  int count;
  const int32_t *start;     /* (count + 1) */
  const int32_t *neighbour; /* (start[count]) each neighbour once, in any order */
  const int32_t *size;      /* (count) number of rows of each node, or NULL */
} baum_i_graph;

/* Places are positions in the order of elimination. */
typedef struct baum_i_elimination {
  int count;
  int32_t *node;  /* (count) node at each place */
  int32_t *place; /* (count) place of each node */
  int32_t *start; /* (count + 1) */
  /* (start[count]) for each place: the later places that are coupled with it when it is
   * eliminated, ascending */
  int32_t *later;
} baum_i_elimination;

/* Finds a minimum-degree order in rounds. A round eliminates all nodes that cause no fill. If there
 * are no such nodes, it eliminates nodes of the smallest degree that are not neighbours of each
 * other. A chain is thus eliminated from both ends. The nodes are then sorted by their distance
 * from the root of the elimination tree: a node comes shortly before the nodes that its elimination
 * changes, and independent nodes are adjacent in the order. If sizes are given, two independent
 * nodes of the same size are made adjacent where this is possible by a small change of the order.
 * Returns BAUM_OK, BAUM_ERR_MEMORY, or BAUM_ERR_SINGULAR if there would be more than `most`
 * couplings. On failure *out is empty. */
baum_status baum_i_elimination_create(const baum_i_graph *graph, int most, baum_i_elimination *out);
/* Finds the index in later[] of the coupling of two places. */
int32_t baum_i_elimination_find(const baum_i_elimination *elimination, int32_t earlier,
                                int32_t later);
void baum_i_elimination_clear(baum_i_elimination *elimination); /* a zeroed struct is allowed */

#endif
