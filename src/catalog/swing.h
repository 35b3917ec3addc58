/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef BAUM_I_CATALOG_SWING_H
#define BAUM_I_CATALOG_SWING_H

/* angle'' = -k sin angle with k in 1/s^2, by time t of either sign: the angle [rad] from below and
 * its rate [rad/s] are replaced. Returns by how much rounding may have put the angle off [rad]: a
 * lot for long times and for motions that nearly come to rest above; infinity, and NaN for both,
 * where too many steps would be needed. */
double baum_i_swing(double k, double t, double *angle, double *rate);

#endif
