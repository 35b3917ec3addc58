/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef BAUM_I_CATALOG_SWING_H
#define BAUM_I_CATALOG_SWING_H

/* Integrates angle'' = -k sin(angle) over the time t, which may be negative. The unit of k is
 * 1/s^2. The initial values, the angle [rad] from the downward vertical and its angular velocity
 * [rad/s], are replaced by the final values. Returns a bound [rad] for the rounding error of the
 * angle. This bound is large for long times, and for motions that almost come to rest at the top.
 * If too many steps would be needed, the bound is infinite, and both the angle and the angular
 * velocity are NaN. */
double baum_i_swing(double k, double t, double *angle, double *rate);

#endif
