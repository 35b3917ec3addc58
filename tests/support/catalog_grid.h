/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares a study that computes its own reference with a study that uses the reference stored in
 * the catalogue. */
#ifndef BAUM_TEST_CATALOG_GRID_H
#define BAUM_TEST_CATALOG_GRID_H

#include <baum/catalog.h>
#include <baum/study.h>

/* Numbers of entries. */
typedef struct catalog_tally {
  int entries;
  int state[BAUM_STUDY_TIMED_OUT + 1]; /* by state */
  int off;
  int unstable;
  int at_floor;
  int compared; /* done in both studies */
  int missing;  /* methods without all their settings, and entries that were not run */
  int better;   /* error below the uncertainty of the reference */
  int differ;   /* errors differ by more than the uncertainty of both references */
  int unmarked; /* the flags `off` or `unstable` are missing or set wrongly */
} catalog_tally;

void catalog_tally_add(catalog_tally *sum, const catalog_tally *of);

/* Returns the number of entries that are missing, better, differ or unmarked. */
int catalog_tally_wrong(const catalog_tally *of);

/* Runs both studies of a catalogue entry with the settings of `grid`, counts, and prints wrong
 * entries. limit [s] is the option entry_limit. */
baum_status catalog_grid_judge(const baum_catalog_entry *entry, const baum_study_grid *grid,
                               double limit, catalog_tally *out);

#endif
