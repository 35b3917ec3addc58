/* SPDX-License-Identifier: BSD-3-Clause */
/* Entries of a study with a reference of its own against the reference of the catalogue. */
#ifndef BAUM_TEST_CATALOG_GRID_H
#define BAUM_TEST_CATALOG_GRID_H

#include <baum/catalog.h>
#include <baum/study.h>

/* Counts of entries. */
typedef struct catalog_tally {
  int entries;
  int state[BAUM_STUDY_TIMED_OUT + 1]; /* by their state */
  int off;
  int unstable;
  int at_floor;
  int compared; /* done in both studies */
  int missing;  /* methods that are not there with all their settings, entries that were not run */
  int better;   /* graded better than their reference is known */
  int differ;   /* errors differ by more than both references leave open */
  int unmarked; /* another motion or unstable gains, and no flag, or a flag without */
} catalog_tally;

void catalog_tally_add(catalog_tally *sum, const catalog_tally *of);

/* How many entries are not as they should be. */
int catalog_tally_wrong(const catalog_tally *of);

/* Study an entry that has a reference twice, with these settings: with the study's own reference
 * and with the stored one. Entries that are wrong are printed. limit [s] is the option
 * entry_limit. */
baum_status catalog_grid_judge(const baum_catalog_entry *entry, const baum_study_grid *grid,
                               double limit, catalog_tally *out);

#endif
