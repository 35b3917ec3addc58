/* SPDX-License-Identifier: BSD-3-Clause */
/* The stress grid: which cells there are. */
#ifndef BAUM_TEST_AXES_H
#define BAUM_TEST_AXES_H

#include "cell.h"

typedef struct cell_list {
  cell *cells;
  int count;
  int room;
} cell_list;

/* All cells; of `axis` alone if it is not NULL. */
cell_list axes_cells(const char *axis);
void axes_free(cell_list *list);

#endif
