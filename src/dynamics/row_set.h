/* SPDX-License-Identifier: BSD-3-Clause */
/* The rows of J that are kept, and the rows that are omitted because they depend on these in every
 * configuration. Their number is found once (redundancy.c), at the assembled initial configuration
 * and its neighbours. The choice of rows may change during a run (row_set.c). */
#ifndef BAUM_I_DYNAMICS_ROW_SET_H
#define BAUM_I_DYNAMICS_ROW_SET_H

#include <stdbool.h>

#include <baum/dynamics.h>

typedef struct baum_i_row_set {
  int rank; /* of J at the neighbours */
  /* rank at the initial configuration, which is (nearly) singular if this is less */
  int rank_at_start;
  int count;                      /* omitted rows */
  unsigned char *omitted;         /* (nc) 1 where a row is omitted; zeros where none is */
  unsigned char *selected;        /* (nc) scratch: 1 where a row is in another set */
  double pivot_at_last_selection; /* relative; 0: never */
} baum_i_row_set;

/* Find rank and rows at the assembled configuration (t, q). Also BAUM_ERR_MEMORY. */
baum_status baum_i_find_rows(baum_workspace *workspace, double t, const double *q);

/* Find the rank of J in the workspace, with columns scaled by work_v (nv) (0 for fixed bodies), and
 * mark one largest set of independent rows in `selected`. Rows that are marked before come first.
 * The set contains the rows of welds that fix bodies. BAUM_ERR_MEMORY, BAUM_ERR_NOT_FINITE. */
baum_status baum_i_select_rows(baum_workspace *workspace, double distance, int *rank);

/* If possible, keep a set of the same size whose rows are well separated in this configuration.
 * Call this before paths are created. */
baum_status baum_i_keep_rows_apart(baum_workspace *workspace, double t, const double *q);

/* Whether this configuration has a well-separated set of rows of full rank, whichever rows are
 * omitted now. */
bool baum_i_rows_are_apart(baum_workspace *workspace, double t, const double *q);

/* Omit these rows (nc) instead of the present ones. Their number and the rank must be the same.
 * BAUM_ERR_MEMORY, BAUM_ERR_UNSUPPORTED where blocks do not suit the other rows, or statuses of
 * user functions; then nothing changes. */
baum_status baum_i_omit_rows(baum_workspace *workspace, const unsigned char *omitted);

/* Omit other rows if the pivot, relative to its usual value, is poor and others are better.
 * Returns true if the rows have changed; then the last solution is lost. It allocates memory,
 * but rarely. */
bool baum_i_choose_rows(baum_workspace *workspace, double t, const double *q, double pivot);

/* Copy the rows to a workspace of the same mechanism, before its paths are created. */
void baum_i_copy_rows(baum_workspace *to, const baum_workspace *from);

/* Zero the omitted rows of block values of J. */
void baum_i_clear_omitted_rows(const baum_workspace *workspace, double *jacobian);

#endif
