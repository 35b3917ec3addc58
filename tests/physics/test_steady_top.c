/* SPDX-License-Identifier: BSD-3-Clause */
/* A heavy top precesses steadily for a thousand revolutions. Its motion is compared with the closed
 * form. Let W be the angular velocity of the precession, n the tilt of the axle, m the mass, and l
 * the distance from the joint to the centre of mass. Let C be the moment of inertia about the axle,
 * and A that about a perpendicular axis through the joint. The precession is steady if the angular
 * velocity about the axle is
 *
 *   w = (m g l + A W^2 cos(n)) / (C W)
 *
 * The orientation then consists of three rotations: by W t about the vertical, by n, and by (w - W
 * cos(n)) t about the axle (Goldstein, Classical Mechanics, 1980, section 5-7).
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "check.h"
#include "construct.h"
#include "rotation.h"
#include "runs.h"

static const double MASS = 1.0;     /* [kg] */
static const double GRAVITY = 9.81; /* [m/s^2] */
/* [m] distance from the joint to the centre of mass. */
static const double ARM = 0.1;
/* [kg m^2] moment of inertia about an axis through the centre of mass, perpendicular to the
 * axle. */
static const double ACROSS = 0.3;
static const double PRECESSION = 0.5;         /* [rad/s] */
static const double TILT = 0.9;               /* [rad] */
static const double SPIN = 6.283185307179586; /* [rad/s] about the axle */
enum { REVOLUTIONS = 1000 };

/* Computes the orientation p. It consists of rotations about z by a, about y by TILT, and about z
 * by b. */
static void orientation_of(double a, double b, double p[4])
{
  const double about_z[4] = {cos(0.5 * a), 0.0, 0.0, sin(0.5 * a)};
  const double about_y[4] = {cos(0.5 * TILT), 0.0, sin(0.5 * TILT), 0.0};
  const double about_axle[4] = {cos(0.5 * b), 0.0, 0.0, sin(0.5 * b)};
  double first[4];
  quaternion_product(about_z, about_y, first);
  quaternion_product(first, about_axle, p);
}

static baum_mechanism *make_top(void)
{
  static const double foot[3] = {0.0, 0.0, 0.0};
  const double moment = ACROSS + MASS * ARM * ARM;
  const double axial =
    (MASS * GRAVITY * ARM + moment * PRECESSION * PRECESSION * cos(TILT)) / (SPIN * PRECESSION);
  const double along[3] = {0.0, 0.0, ARM};
  baum_spatial_body_def top = baum_spatial_body_def_default();
  top.mass = MASS;
  top.inertia[0] = top.inertia[1] = ACROSS;
  top.inertia[2] = axial;
  orientation_of(0.0, 0.0, top.orientation);
  rotate(top.orientation, along, top.position);
  top.angular_velocity[0] = -PRECESSION * sin(TILT);
  top.angular_velocity[1] = 0.0;
  top.angular_velocity[2] = SPIN;
  baum_spatial_spherical_def joint = baum_spatial_spherical_def_default();
  joint.body_a = BAUM_GROUND;
  memcpy(joint.point, foot, sizeof foot);
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -GRAVITY));
  check(baum_mechanism_add_spatial_body(m, &top, &joint.body_b));
  check(baum_mechanism_add_spatial_spherical(m, &joint, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

/* Returns the angle [rad] between the orientation at the end of a run and the orientation of the
 * closed form. */
static double error_of(const baum_integrator *integrator, double rtol)
{
  baum_mechanism *m = make_top();
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.rtol = rtol;
  baum_simulation *s = create_run(m, &o);
  check(baum_simulation_advance_to(s, REVOLUTIONS));
  double p[4];
  double apart[4];
  orientation_of(PRECESSION * REVOLUTIONS, (SPIN - PRECESSION * cos(TILT)) * REVOLUTIONS, p);
  const double back[4] = {p[0], -p[1], -p[2], -p[3]};
  quaternion_product(back, baum_simulation_q(s) + 3, apart);
  baum_simulation_destroy(s);
  baum_mechanism_destroy(m);
  double error = 2.0 * sqrt(apart[1] * apart[1] + apart[2] * apart[2] + apart[3] * apart[3]);
  print_message("%s, rtol %.0e: %.2g rad\n", baum_integrator_name(integrator), rtol, error);
  return error;
}

static void rk8_keeps_the_orientation_of_a_top(void **state)
{
  (void)state;
  assert_true(error_of(baum_rk8(), 1e-13) <= 1e-8);
}

static void cvode_bdf_keeps_the_orientation_of_a_top(void **state)
{
  (void)state;
#if BAUM_HAVE_SUNDIALS
  assert_true(error_of(baum_cvode_bdf(), 1e-11) <= 1e-3);
#else
  skip();
#endif
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(rk8_keeps_the_orientation_of_a_top),
    cmocka_unit_test(cvode_bdf_keeps_the_orientation_of_a_top),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
