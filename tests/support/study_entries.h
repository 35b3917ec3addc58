/* SPDX-License-Identifier: BSD-3-Clause */
/* Studies whose entries are compared in tests. Include after cmocka.h. */
#ifndef BAUM_TEST_STUDY_ENTRIES_H
#define BAUM_TEST_STUDY_ENTRIES_H

#include <baum/study.h>

/* Makes a study of 1 s with a small grid. The grid contains rk4 and rk8 with all formulations and
 * gains. The CPU time of every entry is measured once. */
baum_study *small_study(const baum_mechanism *mechanism, const baum_study_options *options);
baum_study_options small_study_options(void);

baum_study_entry study_entry(const baum_study *study, int32_t k);

/* Checks that the entries of two studies are equal bit for bit. Only their times may differ. */
void assert_same_entries(const baum_study *a, const baum_study *b);

#endif
