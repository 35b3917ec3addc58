/* SPDX-License-Identifier: BSD-3-Clause */
/* Builds planar mechanisms from spatial elements, in a plane that is tilted relative to the ground
 * axes. Each closed loop then has three redundant rows. */
#ifndef BAUM_TEST_MODELS_TILT_H
#define BAUM_TEST_MODELS_TILT_H

#include "models.h"

/* Adds a spatial element for each body, particle, pin, guide, rod, driver, spring and load of a
 * planar mechanism. They have the same names and the same order. Also sets the gravity. */
baum_status model_tilt_into(const baum_mechanism *planar, baum_mechanism *into);
/* Makes and freezes a mechanism with these spatial elements. In the design configuration, the last
 * body is off the plane by `aside` [m]. */
baum_status model_tilt(const baum_mechanism *planar, double aside, baum_mechanism **out);

/* Converts x, y and angle in the plane to q (7) of a spatial body. */
void model_tilt_body(const double pose[3], double q[7]);
/* Converts q (7) of a spatial body to x, y and angle in the plane. The angle is between -pi and pi.
 * `off` is set to the deviations from the plane, in m and in rad. */
void model_untilt_body(const double q[7], double pose[3], double off[2]);

#endif
