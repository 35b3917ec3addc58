/* SPDX-License-Identifier: BSD-3-Clause */
/* A pendulum given by one function: 1 kg on a massless rod of 1 m, released from the horizontal. */
#include <baum/baum.h>

#include "example_util.h"

enum { SAMPLES = 501, SHOWN = 25 /* samples per printed row */ };

static double path[SAMPLES][5]; /* t, x, y, error, energy change; for the figure */

/* Phi(q) = x^2 + y^2 - 1: the only thing the library needs to know about the rod. */
static int circle(double t, const double *q, double *phi, void *user)
{
  (void)t;
  (void)user;
  phi[0] = q[0] * q[0] + q[1] * q[1] - 1.0;
  return 0;
}

static baum_mechanism *pendulum(void)
{
  baum_mechanism *mechanism = NULL;
  CHECK(baum_mechanism_create(&mechanism));

  baum_planar_particle_def bob = baum_planar_particle_def_default();
  bob.name = "bob";
  bob.position[0] = 1.0;
  baum_body_id body;
  CHECK(baum_mechanism_add_planar_particle(mechanism, &bob, &body));

  baum_user_constraint_def rod = baum_user_constraint_def_default();
  rod.name = "rod";
  rod.bodies = &body;
  rod.body_count = 1;
  rod.row_count = 1;
  rod.phi = circle;
  CHECK(baum_mechanism_add_user_constraint(mechanism, &rod, NULL));

  CHECK(baum_mechanism_freeze(mechanism));
  return mechanism;
}

/* Computes the exact motion. The angle is measured from the lowest point. With s = sin(angle / 2),
 * k^2 = 1/2 and the length l of the rod, the solution is s = k sn(K - sqrt(g/l) t, k). The
 * arithmetic-geometric mean (agm) gives the elliptic function sn (Abramowitz, Stegun 1964, 16.4)
 * and K = pi / (2 agm(1, sqrt(1 - k^2))). */
static void exact(double t, double *x, double *y)
{
  enum { LEVELS = 6 };
  const double k = sqrt(0.5);
  double a[LEVELS + 1] = {1.0};
  double c[LEVELS + 1] = {k};
  double b = sqrt(1.0 - k * k);
  for (int n = 0; n < LEVELS; n++) {
    a[n + 1] = (a[n] + b) / 2.0;
    c[n + 1] = (a[n] - b) / 2.0;
    b = sqrt(a[n] * b);
  }
  double u = acos(-1.0) / (2.0 * a[LEVELS]) - sqrt(9.81) * t;
  double phase = ldexp(a[LEVELS] * u, LEVELS);
  for (int n = LEVELS; n > 0; n--) {
    phase = (phase + asin(c[n] / a[n] * sin(phase))) / 2.0;
  }
  double s = k * sin(phase);
  *x = 2.0 * s * sqrt(1.0 - s * s);
  *y = 2.0 * s * s - 1.0;
}

static void write_path(void)
{
  static const example_column columns[] = {{"t", "t [s]", 'f', 2},
                                           {"x", "x [m]", 'f', 9},
                                           {"y", "y [m]", 'f', 9},
                                           {"error", "error [m]", 'e', 1},
                                           {"energy_change", "energy change [J]", 'e', 1}};
  example_table("path", columns, 5, false);
  for (int k = 0; k < SAMPLES; k++) {
    for (int i = 0; i < 5; i++) {
      example_number(path[k][i]);
    }
  }
}

int main(int argc, char **argv)
{
  example_begin(argc, argv, "pendulum");
  example_needs("sundials");
  baum_mechanism *mechanism = pendulum();

  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_cvode_adams();
  options.rtol = 1e-9;
  baum_simulation *run = NULL;
  CHECK(baum_simulation_create(mechanism, &options, &run));
  printf("pendulum: 1 kg on a rod of 1 m, released from the horizontal\n%s\n\n",
         baum_simulation_explain(run));

  static const example_column columns[] = {{"t", "t [s]", 'f', 1},
                                           {"x", "x [m]", 'f', 9},
                                           {"y", "y [m]", 'f', 9},
                                           {"error", "error [m]", 'e', 1},
                                           {"max_phi", "max|Phi| [m^2]", 'e', 1},
                                           {"energy_change", "energy change [J]", 'e', 1}};
  example_table("motion", columns, 6, true);
  double worst = 0.0;
  double energy = 0.0;
  baum_counters counters;
  for (int k = 0; k < SAMPLES; k++) {
    double t = 0.02 * k;
    double x;
    double y;
    CHECK(baum_simulation_advance_to(run, t));
    CHECK(baum_simulation_counters(run, &counters, sizeof counters));
    exact(t, &x, &y);
    const double *q = baum_simulation_q(run);
    double error = hypot(q[0] - x, q[1] - y);
    worst = fmax(worst, error);
    energy = fmax(energy, fabs(counters.energy_change));
    const double point[] = {t, q[0], q[1], error, counters.energy_change};
    memcpy(path[k], point, sizeof point);
    if (k % SHOWN == 0) {
      example_number(t);
      example_number(q[0]);
      example_number(q[1]);
      example_number(error);
      example_number(counters.max_phi);
      example_number(counters.energy_change);
    }
  }
  write_path();
  example_counters(run);
  example_expect("largest error of position [m]", worst, 1e-6);
  example_expect("largest violation max|Phi| [m^2]", counters.max_phi, 1e-7);
  example_expect("largest energy change [J]", energy, 1e-6);

  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return example_end();
}
