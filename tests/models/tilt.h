/* SPDX-License-Identifier: BSD-3-Clause */
/* Builds planar mechanisms of spatial elements, in a plane that is tilted against the ground axes.
 * Each closed loop then has three redundant rows. */
#ifndef BAUM_TEST_MODELS_TILT_H
#define BAUM_TEST_MODELS_TILT_H

#include "models.h"

/* Adds spatial elements for the bodies, particles, pins, guides, rods, drivers, springs and loads
 * of a planar mechanism, with the same names in the same order, and its gravity. */
baum_status model_tilt_into(const baum_mechanism *planar, baum_mechanism *into);
/* Makes and freezes such a mechanism. In its design configuration the last body is `aside` [m] off
 * the plane. */
baum_status model_tilt(const baum_mechanism *planar, double aside, baum_mechanism **out);

/* Converts x, y, angle in the plane to q (7) of a body in space. */
void model_tilt_body(const double pose[3], double q[7]);
/* Converts back; the angle is between -pi and pi. `off` is the deviation from the plane: [m],
 * [rad]. */
void model_untilt_body(const double q[7], double pose[3], double off[2]);

#endif
