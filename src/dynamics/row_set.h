/* SPDX-License-Identifier: BSD-3-Clause */
/* Which rows of J are kept, and which are omitted because they depend on these in every
 * configuration. How many is found once (redundancy.c), at the assembled initial configuration and
 * its neighbours; which may change on the way (row_set.c). */
#ifndef BAUM_I_DYNAMICS_ROW_SET_H
#define BAUM_I_DYNAMICS_ROW_SET_H

#include <stdbool.h>

#include <baum/dynamics.h>

typedef struct baum_i_row_set {
  int rank;                /* of J at the neighbours */
  int rank_at_start;       /* at the initial configuration; less: it is singular, or next to that */
  int count;               /* omitted rows */
  unsigned char *omitted;  /* (nc) 1 where a row is omitted; zeros where none is */
  unsigned char *selected; /* (nc) scratch: 1 where a row is in another set */
  double pivot_at_last_selection; /* relative; 0: as good as never */
} baum_i_row_set;

/* Find rank and rows at the assembled configuration (t, q). Also BAUM_ERR_MEMORY. */
baum_status baum_i_find_rows(baum_workspace *workspace, double t, const double *q);

/* The rank of J in the workspace with columns scaled by work_v (nv) (0 for fixed bodies), and one
 * largest set of independent rows into `selected`, those that are marked there first. The rows of
 * the welds that fix bodies are in it. BAUM_ERR_MEMORY, BAUM_ERR_NOT_FINITE. */
baum_status baum_i_select_rows(baum_workspace *workspace, double distance, int *rank);

/* Keep as many rows that are well apart in this configuration, if there are such; before paths are
 * made. */
baum_status baum_i_keep_rows_apart(baum_workspace *workspace, double t, const double *q);

/* Are there rows of the whole rank that are well apart in this configuration, whichever are
 * omitted? */
bool baum_i_rows_are_apart(baum_workspace *workspace, double t, const double *q);

/* Omit these rows (nc) from now on in place of those before, as many and of the same rank.
 * BAUM_ERR_MEMORY, BAUM_ERR_UNSUPPORTED where blocks do not suit the others, statuses of functions
 * of the user; then all stays as it is. */
baum_status baum_i_omit_rows(baum_workspace *workspace, const unsigned char *omitted);

/* Where the pivot, of the usual one, has become poor, for rows that were well apart need not be so
 * everywhere: omit others if these are. true: they have changed, and what was solved for is gone.
 * Allocates, but hardly ever. */
bool baum_i_choose_rows(baum_workspace *workspace, double t, const double *q, double pivot);

/* The same rows in a workspace of the same mechanism, before its paths are made. */
void baum_i_copy_rows(baum_workspace *to, const baum_workspace *from);

/* Zero the omitted rows of block values of J. */
void baum_i_clear_omitted_rows(const baum_workspace *workspace, double *jacobian);

#endif
