/* SPDX-License-Identifier: BSD-3-Clause */
/* The eccentric slider-crank of the examples.
 *
 * Lengths, masses and inertias are those of Flores, Leine, Glocker, Multibody System Dynamics 23
 * (2010) 165, Table 1, without clearance. The eccentricity of 0.05 m and the other numbers are
 * chosen here, because the paper on Baumgarte's method (Flores et al. 2008) does not give the data
 * of its figures.
 *
 *   rows of Phi   1, 2 pin A   3, 4 pin B   5, 6 pin C   7, 8 guide   9 motor, if driven
 */
#ifndef SLIDER_CRANK_MODEL_H
#define SLIDER_CRANK_MODEL_H

#include "example_util.h"

static const double SLIDER_CRANK_R = 0.153;     /* [m] crank */
static const double SLIDER_CRANK_L = 0.306;     /* [m] rod */
static const double SLIDER_CRANK_E = 0.05;      /* [m] height of the guide above the crank's pin */
static const double SLIDER_CRANK_SPEED = 150.0; /* [rad/s] of the crank, initial or prescribed */

typedef struct slider_crank {
  baum_mechanism *mechanism;
  baum_body_id crank;
  baum_body_id rod;
  baum_body_id slider;
  baum_joint_id pin_a; /* ground and crank */
  baum_joint_id pin_b; /* crank and rod; its first row is Phi_3 */
  baum_joint_id pin_c; /* rod and slider */
  baum_joint_id guide; /* ground and slider */
  baum_joint_id motor; /* when driven */
} slider_crank;

/* Adds a pin on the x axes of two bodies, at given distances from their centres. */
static inline baum_joint_id slider_crank_pin(baum_mechanism *mechanism, const char *name,
                                             baum_body_id body_a, double at_a, baum_body_id body_b,
                                             double at_b)
{
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.name = name;
  pin.body_a = body_a;
  pin.body_b = body_b;
  pin.point_a[0] = at_a;
  pin.point_b[0] = at_b;
  pin.point_a[1] = pin.point_b[1] = 0.0;
  baum_joint_id id;
  CHECK(baum_mechanism_add_planar_revolute(mechanism, &pin, &id));
  return id;
}

/* Adds the bodies. The crank is at angle 0. The poses of the other bodies are only approximate;
 * assembly corrects them. */
static inline void slider_crank_add_bodies(slider_crank *s, bool driven)
{
  const double r = SLIDER_CRANK_R;
  const double l = SLIDER_CRANK_L;
  baum_planar_body_def body = baum_planar_body_def_default();
  body.name = "crank";
  body.mass = 0.038;
  body.inertia = 7.4e-5;
  body.position[0] = r / 2.0;
  if (!driven) {
    body.held = true;
    body.angular_velocity = SLIDER_CRANK_SPEED;
  }
  CHECK(baum_mechanism_add_planar_body(s->mechanism, &body, &s->crank));

  body = baum_planar_body_def_default();
  body.name = "rod";
  body.mass = 0.038;
  body.inertia = 5.9e-4;
  body.position[0] = r + l / 2.0;
  CHECK(baum_mechanism_add_planar_body(s->mechanism, &body, &s->rod));

  body = baum_planar_body_def_default();
  body.name = "slider";
  body.mass = 0.076;
  body.inertia = 2.7e-6;
  body.position[0] = r + l;
  body.position[1] = SLIDER_CRANK_E;
  CHECK(baum_mechanism_add_planar_body(s->mechanism, &body, &s->slider));
}

/* Builds the mechanism. If `driven` is true, a motor rotates the crank at constant speed, and no
 * degree of freedom is left. Otherwise only the initial speed of the crank is given. */
static inline slider_crank slider_crank_build(bool driven)
{
  const double r = SLIDER_CRANK_R;
  const double l = SLIDER_CRANK_L;
  slider_crank s = {0};
  CHECK(baum_mechanism_create(&s.mechanism));
  slider_crank_add_bodies(&s, driven);
  s.pin_a = slider_crank_pin(s.mechanism, "pin A", BAUM_GROUND, 0.0, s.crank, -r / 2.0);
  s.pin_b = slider_crank_pin(s.mechanism, "pin B", s.crank, r / 2.0, s.rod, -l / 2.0);
  s.pin_c = slider_crank_pin(s.mechanism, "pin C", s.rod, l / 2.0, s.slider, 0.0);

  baum_planar_translational_def guide = baum_planar_translational_def_default();
  guide.name = "guide";
  guide.body_a = BAUM_GROUND;
  guide.body_b = s.slider;
  guide.point_a[0] = 0.0;
  guide.point_a[1] = SLIDER_CRANK_E;
  guide.point_b[0] = guide.point_b[1] = 0.0;
  CHECK(baum_mechanism_add_planar_translational(s.mechanism, &guide, &s.guide));

  if (driven) {
    baum_driver_def motor = baum_driver_def_default();
    motor.name = "motor";
    motor.joint = s.pin_a;
    motor.rate = SLIDER_CRANK_SPEED;
    CHECK(baum_mechanism_add_driver(s.mechanism, &motor, &s.motor));
  }
  CHECK(baum_mechanism_freeze(s.mechanism));
  return s;
}

#endif
