/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies whose positions are on a manifold. They are made with user coordinates. Their sizes are
 * (nq, nv):
 *
 *   turned body   q = (x, y, cos, sin), v = (x', y', angular velocity)                (4, 3)
 *   angle         q = (cos, sin), v the angular velocity                              (2, 1)
 *   top           q = (r, p) with a unit quaternion p, v = (r', w), w in body axes    (7, 6)
 *   free top      q = p, v = w                                                        (4, 3)
 */
#ifndef BAUM_TEST_MANIFOLD_BODIES_H
#define BAUM_TEST_MANIFOLD_BODIES_H

#include <baum/baum.h>

typedef struct manifold_body {
  double mass;
  double inertia[3]; /* a turned body uses only the first number */
} manifold_body;

baum_body_id manifold_add_turned(baum_mechanism *mechanism, manifold_body *body, double x, double y,
                                 double angle, const double *v);
baum_body_id manifold_add_angle(baum_mechanism *mechanism, manifold_body *body, double angle,
                                const double *v);
/* The length of the quaternion in q = (r, p) may differ from 1 by rounding. */
baum_body_id manifold_add_top(baum_mechanism *mechanism, manifold_body *body, const double q[7],
                              const double *v);
baum_body_id manifold_add_free_top(baum_mechanism *mechanism, manifold_body *body,
                                   const double p[4], const double *v);

#endif
