/* SPDX-License-Identifier: BSD-3-Clause */
/* Where a function of one variable is least. */
#ifndef BAUM_I_BASE_LEAST_H
#define BAUM_I_BASE_LEAST_H

typedef double baum_i_function(void *user, double t);

/* Least value seen between two ends, ends[0] < ends[1], until its place is known to `tolerance`, or
 * after `most` values, at least 1; its place into *at. Of several minima one is found. Values may
 * be infinite, not NaN. */
double baum_i_least(baum_i_function *function, void *user, const double ends[2], double tolerance,
                    int most, double *at);

#endif
