/* SPDX-License-Identifier: BSD-3-Clause */
/* A pendulum for which the times of events are known in closed form. At the angle 0 it hangs down.
 * It starts at rest at an angle below pi, and passes the angle 0 at odd multiples of a quarter
 * period. Include after cmocka.h. */
#ifndef BAUM_TEST_PENDULUM_EVENTS_H
#define BAUM_TEST_PENDULUM_EVENTS_H

#include <math.h>

#include <baum/baum.h>

#include "construct.h"

typedef struct swing {
  baum_mechanism *mechanism;
  baum_joint_id pin;
  double quarter; /* [s] */
} swing;

/* Returns the quarter period. It is K(sin(angle / 2)) / rate, where `rate` is the angular frequency
 * of small swings. K is pi / (2 agm(1, cos(angle / 2))) (Abramowitz, Stegun 1964, 17.6.3). */
static inline double quarter_of(double angle, double rate)
{
  double a = 1.0;
  double b = cos(0.5 * angle);
  for (int k = 0; k < 8; k++) {
    double mean = 0.5 * (a + b);
    b = sqrt(a * b);
    a = mean;
  }
  return acos(-1.0) / (2.0 * a * rate);
}

/* Makes a pendulum. Its body has 1 kg and 0.25 kg m^2, and its centre is 1 m from the pin. The
 * angular frequency of small swings is sqrt(9.81 / 1.25) rad/s. */
static inline swing swing_make(double angle)
{
  swing s = {.mechanism = create_mechanism()};
  baum_planar_body_def body = baum_planar_body_def_default();
  body.mass = 1.0;
  body.inertia = 0.25;
  body.angle = angle;
  body.position[0] = sin(angle);
  body.position[1] = -cos(angle);
  body.angular_velocity = 0.0;
  baum_body_id bob;
  assert_int_equal(baum_mechanism_add_planar_body(s.mechanism, &body, &bob), BAUM_OK);
  s.pin = add_planar_pin(s.mechanism, NULL, BAUM_GROUND, bob, 0.0, 0.0);
  assert_int_equal(baum_mechanism_freeze(s.mechanism), BAUM_OK);
  s.quarter = quarter_of(angle, sqrt(9.81 / 1.25));
  return s;
}

#endif
