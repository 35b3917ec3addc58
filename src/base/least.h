/* SPDX-License-Identifier: BSD-3-Clause */
/* Minimum of a function of one variable. */
#ifndef BAUM_I_BASE_LEAST_H
#define BAUM_I_BASE_LEAST_H

typedef double baum_i_function(void *user, double t);

/* Search for the minimum of a function between ends[0] and ends[1], where ends[0] < ends[1]. The
 * search ends when the error of the position of the minimum is at most `tolerance`, or after `most`
 * evaluations. `most` must be at least 1. Returns the least value found, and writes the position of
 * this value to *at. If there are several minima, the search finds one of them. Values of the
 * function may be infinite, but not NaN. */
double baum_i_least(baum_i_function *function, void *user, const double ends[2], double tolerance,
                    int most, double *at);

#endif
