/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef BAUM_I_CATALOG_SWING_H
#define BAUM_I_CATALOG_SWING_H

/* Integrates angle'' = -k sin angle with k in 1/s^2 over a time t of either sign. Replaces the
 * angle [rad] from the downward vertical and its angular velocity [rad/s]. Returns a bound of the
 * effect of rounding on the angle [rad]. The bound is large for long times and for motions that
 * nearly come to rest at the top. If too many steps would be needed, the bound is infinite, and the
 * angle and angular velocity are NaN. */
double baum_i_swing(double k, double t, double *angle, double *rate);

#endif
