/* SPDX-License-Identifier: BSD-3-Clause */
/* Order of elimination of a sparse symmetric matrix, and its fill. */
#ifndef BAUM_I_LINEAR_ELIMINATION_H
#define BAUM_I_LINEAR_ELIMINATION_H

#include <stdint.h>

#include <baum/status.h>

/* The graph of a matrix: the neighbours of each node, in both directions, without the node itself.
 */
typedef struct baum_i_graph {
  int count;
  const int32_t *start;     /* (count + 1) */
  const int32_t *neighbour; /* (start[count]) each once a node, in any order */
} baum_i_graph;

/* Places are positions in the order of elimination. */
typedef struct baum_i_elimination {
  int count;
  int32_t *node;  /* (count) at each place */
  int32_t *place; /* (count) of each node */
  int32_t *start; /* (count + 1) */
  int32_t *later; /* (start[count]) places coupled with a place when it is eliminated, ascending */
} baum_i_elimination;

/* Finds an order by minimum degree in rounds. A round takes all nodes that make no fill, or else
 * all of the smallest degree that are not neighbours. A chain is thus eliminated from both ends in
 * turn, and independent nodes are adjacent in the order. Returns BAUM_ERR_SINGULAR where more than
 * `most` couplings would arise. BAUM_OK, BAUM_ERR_MEMORY; on failure *out is empty. */
baum_status baum_i_elimination_create(const baum_i_graph *graph, int most, baum_i_elimination *out);
void baum_i_elimination_clear(baum_i_elimination *elimination); /* a zeroed one is valid */

#endif
