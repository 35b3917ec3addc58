/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares two studies of a mechanism. One study computes a reference, and the other study uses the
 * reference that is stored in the catalogue. */
#ifndef BAUM_TEST_CATALOG_GRID_H
#define BAUM_TEST_CATALOG_GRID_H

#include <baum/catalog.h>
#include <baum/study.h>

/* Counts of entries of studies that have certain properties. Each entry is a run with one
 * setting. */
typedef struct catalog_tally {
  int entries;
  int state[BAUM_STUDY_TIMED_OUT + 1]; /* number of entries in each state */
  int off;
  int unstable;
  int at_floor;
  int compared; /* entries that are done in both studies */
  int missing;  /* methods without all their settings, and entries that were not run */
  int better;   /* entries whose error is below the uncertainty of the reference */
  int differ;   /* entries whose errors differ by more than the uncertainties of both references */
  int unmarked; /* entries whose flags `off` or `unstable` are wrong */
} catalog_tally;

void catalog_tally_add(catalog_tally *sum, const catalog_tally *of);

/* Returns the number of entries that are wrong: the sum of the last four numbers of the tally. */
int catalog_tally_wrong(const catalog_tally *of);

/* Runs both studies of a catalogue entry with the settings of `grid`. Counts the entries of
 * the studies, and prints those with wrong results. limit [s] is the option entry_limit of the
 * studies. */
baum_status catalog_grid_judge(const baum_catalog_entry *entry, const baum_study_grid *grid,
                               double limit, catalog_tally *out);

#endif
