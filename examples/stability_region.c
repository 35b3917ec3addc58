/* SPDX-License-Identifier: BSD-3-Clause */
/* Fig. 1 of Flores et al. 2008: for which gains does explicit Euler keep a constraint? Equation (19) says inside the
 * triangle (0, 0) (1, 0) (2, 4) of the plane of alpha h and beta^2 h^2. A pendulum says what it does: it starts
 * 1e-6 off its circle, and the gains are good when the violation is smaller in the end than in the beginning. */
#include "example_util.h"

enum { CELLS = 44, STEPS = 3000, TAYLOR_STEPS = 8 };

static const double H = 1e-5;   /* [s] */
static const double OFF = 1e-6; /* [m] */

/* 1 kg on a massless rod of 1 m. */
static baum_mechanism *pendulum(void)
{
  baum_mechanism *mechanism = NULL;
  CHECK(baum_mechanism_create(&mechanism));
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  bob.position[0] = 1.0 + OFF;
  baum_body_id body;
  CHECK(baum_mechanism_add_planar_particle(mechanism, &bob, &body));
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.body_a = BAUM_GROUND;
  rod.body_b = body;
  rod.point_a[0] = rod.point_a[1] = 0.0;
  rod.point_b[0] = rod.point_b[1] = 0.0;
  rod.length = 1.0;
  CHECK(baum_mechanism_add_planar_distance(mechanism, &rod, NULL));
  CHECK(baum_mechanism_freeze(mechanism));
  return mechanism;
}

static baum_simulation *start(const baum_mechanism *mechanism, baum_gains gains)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_euler();
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  options.gains = gains;
  options.allow_unstable = true;
  options.step = H;
  options.start = BAUM_START_AS_GIVEN;
  baum_simulation *run = NULL;
  CHECK(baum_simulation_create(mechanism, &options, &run));
  return run;
}

static double violation(const baum_simulation *run)
{
  const double *q = baum_simulation_q(run);
  return (q[0] * q[0] + q[1] * q[1] - 1.0) / 2.0;
}

/* Whether the largest violation of the last quarter of a run is below that of the first. */
static bool simulated_stable(const baum_mechanism *mechanism, double a, double b)
{
  double most[4] = {0.0};
  baum_simulation *run = start(mechanism, baum_gains_scaled(a, b));
  baum_status status = BAUM_OK;
  for (int k = 0; k < STEPS && status >= BAUM_OK; k++) {
    double *quarter = &most[4 * k / STEPS];
    *quarter = fmax(*quarter, fabs(violation(run)));
    status = baum_simulation_step(run, 1);
  }
  baum_simulation_destroy(run);
  return status >= BAUM_OK && most[3] < most[0];
}

static bool predicted_stable(double a, double b)
{
  baum_amplification z;
  CHECK(baum_stability_at(baum_euler(), a, b, &z, sizeof z));
  return z.stability == BAUM_STABLE;
}

/* The grid is laid so that no point is on the boundary. */
static double alpha_h(int i)
{
  return 0.05 * (i + 0.25);
}

static double beta2_h2(int j)
{
  return 0.1 * (j + 1);
}

/* Whether a point has a neighbour on the other side of the predicted boundary. */
static bool at_boundary(int i, int j)
{
  bool here = predicted_stable(alpha_h(i), beta2_h2(j));
  bool other = false;
  for (int di = -1; di <= 1; di++) {
    for (int dj = -1; dj <= 1; dj++) {
      other = other || predicted_stable(alpha_h(i + di), beta2_h2(j + dj)) != here;
    }
  }
  return other;
}

/* With Taylor's gains z^2 = -1: a violation returns every fourth step and never decays. */
static double taylor(const baum_mechanism *mechanism)
{
  static const example_column columns[] = {{"step", "step", 'd', 5}, {"phi", "Phi [m]", 'e', 3}};
  baum_simulation *run = start(mechanism, baum_gains_taylor());
  double first = violation(run);
  printf("\nTaylor's gains (10, 11), on the boundary:\n");
  example_table("taylor", columns, 2, true);
  for (int k = 0; k <= TAYLOR_STEPS; k++) {
    example_number(k);
    example_number(violation(run));
    CHECK(baum_simulation_step(run, 1));
  }
  CHECK(baum_simulation_step(run, 1000 - TAYLOR_STEPS - 1));
  double change = fabs(violation(run) / first - 1.0);
  baum_simulation_destroy(run);
  return change;
}

int main(int argc, char **argv)
{
  static const example_column columns[] = {{"alpha_h", "alpha h [-]", 'f', 4},
                                           {"beta2_h2", "beta^2 h^2 [-]", 'f', 4},
                                           {"predicted", "predicted stable", 'd', 1},
                                           {"simulated", "simulated stable", 'd', 1}};
  example_begin(argc, argv, "stability_region");
  baum_mechanism *mechanism = pendulum();
  printf("stability_region: pendulum, explicit Euler, h = %g s, %d steps, %d x %d pairs of gains\n",
         H, STEPS, CELLS, CELLS);
  printf("# both stable   . both unstable   p only predicted   s only simulated stable\n\n");
  example_table("points", columns, 4, false);
  int differ = 0;
  int astray = 0;
  for (int j = CELLS - 1; j >= 0; j--) {
    printf("%5.1f  ", beta2_h2(j));
    for (int i = 0; i < CELLS; i++) {
      bool predicted = predicted_stable(alpha_h(i), beta2_h2(j));
      bool simulated = simulated_stable(mechanism, alpha_h(i), beta2_h2(j));
      putchar(predicted ? (simulated ? '#' : 'p') : (simulated ? 's' : '.'));
      differ += predicted != simulated;
      astray += predicted != simulated && !at_boundary(i, j);
      example_number(alpha_h(i));
      example_number(beta2_h2(j));
      example_number(predicted);
      example_number(simulated);
    }
    printf("\n");
  }
  printf("beta^2 h^2 over alpha h from %g to %g\n", alpha_h(0), alpha_h(CELLS - 1));
  double change = taylor(mechanism);
  baum_mechanism_destroy(mechanism);
  printf("\npoints %d   in agreement %d\n", CELLS * CELLS, CELLS * CELLS - differ);
  example_expect("share of points that differ", (double)differ / (CELLS * CELLS), 0.02);
  example_expect("those away from the boundary", astray, 0.0);
  example_expect("Taylor: change in 1000 steps", change, 0.1);
  return example_end();
}
