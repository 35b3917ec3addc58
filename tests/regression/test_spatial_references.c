/* SPDX-License-Identifier: BSD-3-Clause */
/* Spatial mechanisms of the literature against samples that were found in another way.
 *
 * Slider-crank: E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems (1989),
 * 12.2. Flyball governor: the problem A05 of the benchmark library of IFToMM's technical committee
 * for multibody dynamics, and its softer variant. Bricard's mechanism: A04 there.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "check.h"
#include "spatial_samples.h"

#define COUNT(LIST) ((int)(sizeof(LIST) / sizeof *(LIST)))

static const double PI = 3.14159265358979323846;

static baum_body_id add_body(baum_mechanism *m, const baum_spatial_body_def *def)
{
  baum_body_id id;
  check(baum_mechanism_add_spatial_body(m, def, &id));
  return id;
}

static void set(double out[3], double x, double y, double z)
{
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

static void add_revolute(baum_mechanism *m, baum_body_id a, baum_body_id b, const double point[3],
                         int axis)
{
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  def.body_a = a;
  def.body_b = b;
  memcpy(def.point, point, sizeof def.point);
  set(def.axis, axis == 0, axis == 1, axis == 2);
  check(baum_mechanism_add_spatial_revolute(m, &def, NULL));
}

static void add_spherical(baum_mechanism *m, baum_body_id a, baum_body_id b, const double point[3])
{
  baum_spatial_spherical_def def = baum_spatial_spherical_def_default();
  def.body_a = a;
  def.body_b = b;
  memcpy(def.point, point, sizeof def.point);
  check(baum_mechanism_add_spatial_spherical(m, &def, NULL));
}

static void add_prismatic(baum_mechanism *m, baum_body_id a, baum_body_id b, const double point[3],
                          int axis)
{
  baum_spatial_prismatic_def def = baum_spatial_prismatic_def_default();
  def.body_a = a;
  def.body_b = b;
  memcpy(def.point, point, sizeof def.point);
  set(def.axis, axis == 0, axis == 1, axis == 2);
  check(baum_mechanism_add_spatial_prismatic(m, &def, NULL));
}

/* ---- slider-crank ---- */

static void build_slider_crank(baum_mechanism *m, baum_body_id bodies[3])
{
  static const double crank_pin[3] = {0.0, 0.1, 0.12};
  static const double rod_pin[3] = {0.0, 0.1, 0.2};
  static const double slider_pin[3] = {0.2, 0.0, 0.0};
  baum_spatial_body_def crank = baum_spatial_body_def_default();
  crank.mass = 0.12;
  set(crank.inertia, 1e-4, 1e-4, 1e-4);
  set(crank.position, 0.0, 0.1, 0.16);
  set(crank.angular_velocity, 6.0, 0.0, 0.0);
  bodies[0] = add_body(m, &crank);

  /* The rod's x axis from B to C: (0.2, -0.1, -0.2) / 0.3. Its z axis h is perpendicular to that
   * and to the ground's x: (0, 2, -1) / sqrt 5. */
  baum_spatial_body_def rod = baum_spatial_body_def_default();
  const double x[3] = {2.0 / 3.0, -1.0 / 3.0, -2.0 / 3.0};
  const double z[3] = {0.0, 2.0 / sqrt(5.0), -1.0 / sqrt(5.0)};
  const double y[3] = {z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2],
                       z[0] * x[1] - z[1] * x[0]};
  rod.mass = 0.5;
  set(rod.inertia, 4e-4, 4e-3, 4e-3);
  set(rod.position, 0.1, 0.05, 0.1);
  double w = 0.5 * sqrt(1.0 + x[0] + y[1] + z[2]);
  rod.orientation[0] = w;
  rod.orientation[1] = (y[2] - z[1]) / (4.0 * w);
  rod.orientation[2] = (z[0] - x[2]) / (4.0 * w);
  rod.orientation[3] = (x[1] - y[0]) / (4.0 * w);
  bodies[1] = add_body(m, &rod);

  baum_spatial_body_def slider = baum_spatial_body_def_default();
  slider.mass = 2.0;
  set(slider.inertia, 1e-3, 1e-3, 1e-3);
  memcpy(slider.position, slider_pin, sizeof slider_pin);
  bodies[2] = add_body(m, &slider);

  add_revolute(m, BAUM_GROUND, bodies[0], crank_pin, 0);
  add_spherical(m, bodies[0], bodies[1], rod_pin);
  add_prismatic(m, BAUM_GROUND, bodies[2], slider_pin, 0);
  baum_spatial_universal_def cross = baum_spatial_universal_def_default();
  cross.body_a = bodies[2];
  cross.body_b = bodies[1];
  memcpy(cross.point, slider_pin, sizeof slider_pin);
  set(cross.axis, 1.0, 0.0, 0.0);
  memcpy(cross.axis_b, z, sizeof z);
  check(baum_mechanism_add_spatial_universal(m, &cross, NULL));
}

/* Distance of the crank pin and the slider from a sample [m]. */
static double slider_crank_error(const double *q, const double *sample)
{
  double angle = 2.0 * atan2(q[4], q[3]);
  return fmax(0.08 * fabs(remainder(angle - sample[1], 2.0 * PI)), fabs(q[14] - sample[2]));
}

/* ---- flyball governor ---- */

static void turn_with(baum_spatial_body_def *def, double rate)
{
  const double *r = def->position;
  const double *p = def->orientation;
  set(def->velocity, -rate * r[1], rate * r[0], 0.0);
  /* The third row of A. */
  set(def->angular_velocity, rate * 2.0 * (p[1] * p[3] - p[0] * p[2]),
      rate * 2.0 * (p[2] * p[3] + p[0] * p[1]), rate * (1.0 - 2.0 * (p[1] * p[1] + p[2] * p[2])));
}

/* One side: rod, ball and spring; its x axis goes outwards and 30 degrees down. */
static void add_arm(baum_mechanism *m, const baum_body_id shaft, const baum_body_id slider,
                    double side, double rate, double stiffness, double damping, baum_body_id *rod)
{
  const double beta = PI / 6.0;
  const double c = cos(beta);
  const double s = sin(beta);
  const double top[3] = {0.05 * side, 0.0, 1.0};
  const double end[3] = {top[0] + side * c, 0.0, 1.0 - s};
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.mass = 0.3;
  double across = 0.3 * (1.0 + 1e-4) / 12.0;
  set(def.inertia, 0.3 * 2e-4 / 12.0, across, across);
  set(def.position, 0.5 * (top[0] + end[0]), 0.0, 0.5 * (top[2] + end[2]));
  /* About y by beta, or by pi - beta to the other side. */
  double angle = side > 0.0 ? beta : PI - beta;
  def.orientation[0] = cos(0.5 * angle);
  def.orientation[2] = sin(0.5 * angle);
  turn_with(&def, rate);
  *rod = add_body(m, &def);
  baum_body_id ball;
  baum_spatial_particle_def mass = baum_spatial_particle_def_default();
  mass.mass = 5.0;
  memcpy(mass.position, end, sizeof end);
  check(baum_mechanism_add_spatial_particle(m, &mass, &ball));
  add_revolute(m, shaft, *rod, top, 1);
  add_spherical(m, *rod, ball, end);
  baum_spatial_spring_def spring = baum_spatial_spring_def_default();
  spring.body_a = slider;
  spring.body_b = *rod;
  set(spring.point_a, 0.05 * side, 0.0, 0.0);
  set(spring.point_b, 0.0, 0.0, 0.0);
  spring.stiffness = stiffness;
  spring.damping = damping;
  spring.free_length = 0.5;
  check(baum_mechanism_add_spatial_spring(m, &spring, NULL));
}

static void build_flyball(baum_mechanism *m, baum_body_id bodies[3], double rate, double stiffness,
                          double damping)
{
  static const double foot[3] = {0.0, 0.0, 0.0};
  static const double centre[3] = {0.0, 0.0, 0.5};
  baum_spatial_body_def shaft = baum_spatial_body_def_default();
  double across = 0.3 * (1.0 + 1e-4) / 12.0;
  shaft.mass = 0.3;
  set(shaft.inertia, across, across, 0.3 * 2e-4 / 12.0);
  memcpy(shaft.position, centre, sizeof centre);
  turn_with(&shaft, rate);
  bodies[0] = add_body(m, &shaft);
  baum_spatial_body_def slider = baum_spatial_body_def_default();
  slider.mass = 3.0;
  set(slider.inertia, 0.005, 0.005, 0.005);
  memcpy(slider.position, centre, sizeof centre);
  turn_with(&slider, rate);
  bodies[1] = add_body(m, &slider);
  add_revolute(m, BAUM_GROUND, bodies[0], foot, 2);
  add_prismatic(m, bodies[0], bodies[1], centre, 2);
  baum_body_id other;
  add_arm(m, bodies[0], bodies[1], 1.0, rate, stiffness, damping, &bodies[2]);
  add_arm(m, bodies[0], bodies[1], -1.0, rate, stiffness, damping, &other);
}

static void build_soft_flyball(baum_mechanism *m, baum_body_id bodies[3])
{
  build_flyball(m, bodies, 2.0 * PI * 4.0 / 25.0, 4000.0, 200.0);
}

static void build_stiff_flyball(baum_mechanism *m, baum_body_id bodies[3])
{
  build_flyball(m, bodies, 2.0 * PI, 8e5, 4e4);
}

static double flyball_error(const double *q, const double *sample)
{
  double angle = 2.0 * atan2(q[6], q[3]);
  double s = q[9];
  double beta = asin((1.0 - q[16]) / 0.5);
  return fmax(fabs(remainder(angle - sample[1], 2.0 * PI)),
              fmax(fabs(s - sample[2]), fabs(beta - sample[3])));
}

/* ---- Bricard's mechanism ---- */

/* Five rods of 1 m and 1 kg without inertia about their axis; 30 rows, of which one is redundant
 * throughout. Also of IFToMM's library, A04. */

static void build_bricard(baum_mechanism *m, baum_body_id bodies[3])
{
  static const double points[6][3] = {{0.0, 0.0, 0.0},  {1.0, 0.0, 0.0},  {1.0, -1.0, 0.0},
                                      {1.0, -1.0, 1.0}, {0.0, -1.0, 1.0}, {0.0, 0.0, 1.0}};
  static const int axes[6] = {1, 2, 0, 1, 2, 0};
  baum_body_id last = BAUM_GROUND;
  check(baum_mechanism_set_gravity(m, 0.0, -9.81, 0.0));
  for (int k = 0; k < 6; k++) {
    baum_body_id next = BAUM_GROUND;
    if (k < 5) {
      baum_spatial_body_def def = baum_spatial_body_def_default();
      for (int i = 0; i < 3; i++) {
        bool along = points[k][i] != points[k + 1][i];
        def.position[i] = 0.5 * (points[k][i] + points[k + 1][i]);
        def.inertia[i] = along ? 0.0 : 1.0 / 12.0;
      }
      next = add_body(m, &def);
      bodies[0] = k == 0 ? next : bodies[0];
    }
    add_revolute(m, last, next, points[k], axes[k]);
    last = next;
  }
}

/* Distance of P1 to P4, found from the centres one after the other, from a sample [m]. */
static double bricard_error(const double *q, const double *sample)
{
  double point[3] = {0.0, 0.0, 0.0};
  double worst = 0.0;
  for (int k = 0; k < 4; k++) {
    for (int i = 0; i < 3; i++) {
      point[i] = 2.0 * q[7 * k + i] - point[i];
      worst = fmax(worst, fabs(point[i] - sample[1 + 3 * k + i]));
    }
  }
  return worst;
}

/* ---- runs ---- */

typedef struct reference {
  const char *name;
  void (*build)(baum_mechanism *m, baum_body_id bodies[3]);
  double (*error)(const double *q, const double *sample);
  const double *samples;
  int count;
  int width;
  double end;
} reference;

static const reference references[] = {
  {"spatial slider-crank", build_slider_crank, slider_crank_error,
   &spatial_slider_crank_samples[0][0], COUNT(spatial_slider_crank_samples), 3, 5.0},
  {"soft flyball", build_soft_flyball, flyball_error, &soft_flyball_samples[0][0],
   COUNT(soft_flyball_samples), 4, 5.0},
  {"stiff flyball", build_stiff_flyball, flyball_error, &stiff_flyball_samples[0][0],
   COUNT(stiff_flyball_samples), 4, 1.0},
  {"Bricard", build_bricard, bricard_error, &bricard_samples[0][0], COUNT(bricard_samples), 13,
   5.0},
};

static double run(const reference *r, const baum_integrator *integrator,
                  baum_formulation formulation, double rtol)
{
  baum_mechanism *m = NULL;
  baum_simulation *s = NULL;
  baum_body_id bodies[3];
  check(baum_mechanism_create(&m));
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -9.81));
  r->build(m, bodies);
  check(baum_mechanism_freeze(m));
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.formulation = formulation;
  o.rtol = rtol;
  check(baum_simulation_create(m, &o, &s));
  double worst = 0.0;
  for (int k = 0; k < r->count; k++) {
    const double *sample = r->samples + (ptrdiff_t)k * r->width;
    if (sample[0] > r->end) {
      break;
    }
    baum_status status = baum_simulation_advance_to(s, sample[0]);
    if (status < BAUM_OK) {
      fail_msg("%s: %s", r->name, baum_simulation_message(s));
    }
    worst = fmax(worst, r->error(baum_simulation_q(s), sample));
  }
  baum_counters counters;
  check(baum_simulation_counters(s, &counters, sizeof counters));
  printf("%-22s %-12s %-11s rtol %.0e: error %.1e, %lld steps\n", r->name,
         baum_integrator_name(integrator), baum_formulation_name(formulation), rtol, worst,
         (long long)counters.steps);
  baum_simulation_destroy(s);
  baum_mechanism_destroy(m);
  return worst;
}

static void references_are_met(void **state)
{
  (void)state;
  for (int k = 0; k < COUNT(references); k++) {
    const reference *r = &references[k];
    assert_true(run(r, baum_rk8(), BAUM_FORMULATION_PROJECTION, 1e-11) < 1e-9);
#if BAUM_HAVE_SUNDIALS
    assert_true(run(r, baum_cvode_bdf(), BAUM_FORMULATION_PROJECTION, 1e-10) < 1e-6);
    assert_true(run(r, baum_ida(), BAUM_FORMULATION_GGL, 1e-10) < 1e-6);
#endif
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(references_are_met),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
