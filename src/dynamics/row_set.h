/* SPDX-License-Identifier: BSD-3-Clause */
/* The rows of J that are kept, and the rows that are omitted because they depend on the kept rows
 * in every configuration. The number of omitted rows is determined once (redundancy.c), at the
 * assembled initial configuration and its neighbours. Which rows are omitted may change during a
 * run (row_set.c). */
#ifndef BAUM_I_DYNAMICS_ROW_SET_H
#define BAUM_I_DYNAMICS_ROW_SET_H

#include <stdbool.h>

#include <baum/dynamics.h>

typedef struct baum_i_row_set {
  int rank;          /* of the mechanism, see redundancy.c */
  int position_rank; /* the same without rows of velocity level */
  /* rank of J at the initial configuration, which is (nearly) singular if this is less than
   * `rank` */
  int rank_at_start;
  int count;                      /* number of omitted rows */
  unsigned char *omitted;         /* (nc) 1 if the row is omitted, else 0 */
  unsigned char *selected;        /* (nc) scratch: 1 if the row is in a new set */
  double pivot_at_last_selection; /* relative; 0: the last search changed the rows, or none */
} baum_i_row_set;

/* Find the rank and the omitted rows at the assembled configuration (t, q). May also return
 * BAUM_ERR_MEMORY. */
baum_status baum_i_find_rows(baum_workspace *workspace, double t, const double *q);

/* Find the rank of J in the workspace, with columns scaled by work_v (nv) (0 for fixed bodies), and
 * mark one largest set of independent rows in `selected`. Rows that are already marked come first.
 * A row belongs to the set if its distance from the span of the rows before it, relative to its
 * length, is above `distance`. The set contains the rows of welds that fix bodies. May return
 * BAUM_ERR_MEMORY or BAUM_ERR_NOT_FINITE. */
baum_status baum_i_select_rows(baum_workspace *workspace, double distance, int *rank);

/* Keep the set of the same size whose rows are separated best in this configuration, if one is
 * found. Call this before the block paths are created. */
baum_status baum_i_keep_rows_apart(baum_workspace *workspace, double t, const double *q);

/* Whether some well-separated set of rows has full rank in this configuration. The rows that are
 * omitted now do not matter. */
bool baum_i_rows_are_apart(baum_workspace *workspace, double t, const double *q);

/* Omit these rows (nc) instead of the present ones. Their number and the rank must be the same. May
 * return BAUM_ERR_MEMORY, BAUM_ERR_UNSUPPORTED if the block solver does not suit the new set, or
 * statuses of user functions. On failure nothing changes. */
baum_status baum_i_omit_rows(baum_workspace *workspace, const unsigned char *omitted);

/* Omit other rows if the pivot, relative to its usual value, is poor and another set is better.
 * `well_separated` demands that the new set is well separated; otherwise a run next to a singular
 * configuration would restart again and again. Returns true if the rows have changed; then the last
 * solution is lost. Allocates memory, but rarely. */
bool baum_i_choose_rows(baum_workspace *workspace, double t, const double *q, double pivot,
                        bool well_separated);

/* Check that the last acceleration, with these velocities and gains, satisfies the omitted rows.
 * Fails with BAUM_ERR_INCONSISTENT. */
baum_status baum_i_check_omitted_rows(baum_workspace *workspace, const double *v, double alpha,
                                      double beta);

/* Copy the rows to a workspace of the same mechanism, before its block paths are created. */
void baum_i_copy_rows(baum_workspace *to, const baum_workspace *from);

/* Set the omitted rows to zero in the block values `jacobian`. */
void baum_i_clear_omitted_rows(const baum_workspace *workspace, double *jacobian);

#endif
