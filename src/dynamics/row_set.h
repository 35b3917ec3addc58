/* SPDX-License-Identifier: BSD-3-Clause */
/* A row set divides the rows of J into rows that are kept and rows that are omitted. Omitted rows
 * depend on the kept rows in every configuration. The number of omitted rows is determined only
 * once (redundancy.c), in the assembled initial configuration and in configurations near it. The
 * choice of these rows may change during a run (row_set.c). */
#ifndef BAUM_I_DYNAMICS_ROW_SET_H
#define BAUM_I_DYNAMICS_ROW_SET_H

#include <stdbool.h>

#include <baum/dynamics.h>

typedef struct baum_i_row_set {
  int rank;          /* usual rank of J, see redundancy.c */
  int position_rank; /* number of kept rows that are not of velocity level */
  /* Rank of J in the initial configuration. If it is less than `rank`, this configuration is
   * (nearly) singular. */
  int rank_at_start;
  int count;               /* number of omitted rows */
  unsigned char *omitted;  /* (nc) 1 if the row is omitted, else 0 */
  unsigned char *selected; /* (nc) scratch: 1 if the row is in a new set */
  /* The pivot at which baum_i_choose_rows() last searched for other rows. It is 0 if that search
   * changed the rows, if a later pivot was no longer poor, or if there was no search. */
  double pivot_at_last_selection;
} baum_i_row_set;

/* Assemble a copy of q at time t, and find the rank and the omitted rows in this configuration. May
 * fail with BAUM_ERR_MEMORY. */
baum_status baum_i_find_rows(baum_workspace *workspace, double t, const double *q);

/* Find the rank of the workspace's J, and mark one largest set of independent rows in `selected`.
 * The columns of J are multiplied by work_v (nv), which is 0 for fixed bodies. Rows that are
 * already marked in `selected` are tried first. A row is selected if its distance from the span of
 * the rows selected before it, relative to its length, is above `distance`. The set also contains
 * the rows of welds that fix bodies. May return BAUM_ERR_MEMORY or BAUM_ERR_NOT_FINITE. */
baum_status baum_i_select_rows(baum_workspace *workspace, double distance, int *rank);

/* Look for the set of independent rows that is farthest from dependence in this configuration (see
 * the limits in row_set.c). If a set is found, keep its rows instead of the present rows. The
 * number of rows stays the same. This must be called before the block paths are created. */
baum_status baum_i_keep_rows_apart(baum_workspace *workspace, double t, const double *q);

/* Tell whether there is a well-separated set of rows (see row_set.c) with full rank in this
 * configuration. It does not matter which rows are omitted now. */
bool baum_i_rows_are_apart(baum_workspace *workspace, double t, const double *q);

/* Omit the rows that are marked in `omitted` (nc) instead of the present ones. Their number must be
 * the same as before, and the kept rows must have the same rank. May fail with BAUM_ERR_MEMORY,
 * with BAUM_ERR_UNSUPPORTED if the block solver cannot be used with the new set, or with the status
 * of a user function. After a failure, nothing has changed. */
baum_status baum_i_omit_rows(baum_workspace *workspace, const unsigned char *omitted);

/* How to look for another set of rows. */
typedef struct baum_i_choice {
  /* Accept only a well-separated set. Without this demand, a run next to a singular configuration
   * would restart again and again. */
  bool well_separated;
  /* Multiply the columns of J by the scales of the coordinates, and keep the present rows while
   * they are well separated. Otherwise the columns are multiplied by 1 / sqrt(M_ii); if moments of
   * inertia are small, the distances of rows then decrease only shortly before the rows become
   * dependent. Kinematics uses lengths, because J v = nu does not contain masses. */
  bool by_lengths;
} baum_i_choice;

/* Omit other rows if the pivot is poor and another set of rows is better. `pivot` is the smallest
 * pivot; a run divides it by the largest pivot of the run so far. Returns true if the rows have
 * changed. The accelerations and multipliers computed last are then no longer available. This
 * function allocates memory if it searches for rows. */
bool baum_i_choose_rows(baum_workspace *workspace, double t, const double *q, double pivot,
                        baum_i_choice choice);

/* Check that the accelerations computed last also satisfy the omitted rows at the given velocities
 * and gains. If they do not, the function fails with BAUM_ERR_INCONSISTENT. */
baum_status baum_i_check_omitted_rows(baum_workspace *workspace, const double *v, double alpha,
                                      double beta);

/* Copy the row set to a workspace of the same mechanism. This must be called before the block paths
 * of that workspace are created. */
void baum_i_copy_rows(baum_workspace *to, const baum_workspace *from);

/* Set the values of the omitted rows to zero in `jacobian`, which contains the blocks of J. */
void baum_i_clear_omitted_rows(const baum_workspace *workspace, double *jacobian);

#endif
