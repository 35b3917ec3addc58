/* SPDX-License-Identifier: BSD-3-Clause */
/* Rows of studies that tests compare. Include after cmocka.h. */
#ifndef BAUM_TEST_STUDY_ROWS_H
#define BAUM_TEST_STUDY_ROWS_H

#include <baum/study.h>

/* A study of a pendulum over 1 s with a small grid: RK4 and RK8, all formulations and gains. Rows that are timed once. */
baum_study *small_study(const baum_mechanism *mechanism, const baum_study_options *options);
baum_study_options small_study_options(void);

baum_study_row study_row(const baum_study *study, int32_t k);

/* Rows of two studies are the same but for their times: bit for bit. */
void assert_same_rows(const baum_study *a, const baum_study *b);

#endif
