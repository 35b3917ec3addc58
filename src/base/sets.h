/* SPDX-License-Identifier: BSD-3-Clause */
/* Disjoint sets of the numbers 0, 1, ..., count - 1. parent[i] <= i is a member of the set of i.
 * The smallest member represents the set; its parent is the member itself. */
#ifndef BAUM_I_BASE_SETS_H
#define BAUM_I_BASE_SETS_H

static inline void baum_i_sets_begin(int *parent, int count)
{
  for (int i = 0; i < count; i++) {
    parent[i] = i;
  }
}

/* Return the smallest member of the set of i. */
static inline int baum_i_sets_find(int *parent, int i)
{
  while (parent[i] != i) {
    parent[i] = parent[parent[i]]; /* shortens the path for later calls */
    i = parent[i];
  }
  return i;
}

static inline void baum_i_sets_unite(int *parent, int a, int b)
{
  int root_a = baum_i_sets_find(parent, a);
  int root_b = baum_i_sets_find(parent, b);
  if (root_a < root_b) {
    parent[root_b] = root_a;
  } else {
    parent[root_a] = root_b;
  }
}

/* Replace parent[i] by the number of the set of i, counted from 0. Return the number of sets. */
static inline int baum_i_sets_number(int *parent, int count)
{
  int sets = 0;
  for (int i = 0; i < count; i++) {
    /* if parent[i] < i, the number parent[parent[i]] has already been replaced */
    parent[i] = parent[i] == i ? sets++ : parent[parent[i]];
  }
  return sets;
}

#endif
