/* SPDX-License-Identifier: BSD-3-Clause */
/* Makes the list of all cells of the stress grid. */
#ifndef BAUM_TEST_AXES_H
#define BAUM_TEST_AXES_H

#include "cell.h"

typedef struct cell_list {
  cell *cells;
  int count;
  int room;
} cell_list;

/* Returns the cells of all axes. If `axis` is not NULL, returns only the cells of axes whose names
 * begin with this text. */
cell_list axes_cells(const char *axis);
void axes_free(cell_list *list);

#endif
