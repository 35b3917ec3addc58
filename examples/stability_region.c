/* SPDX-License-Identifier: BSD-3-Clause */
/* Fig. 1 of Flores et al. 2008: for which gains does explicit Euler keep a constraint? Equation (19) says inside the
 * triangle (0, 0) (1, 0) (2, 4) of the plane of alpha h and beta^2 h^2. A pendulum says what it does: it starts
 * 1e-6 m off its circle, and the gains are good when the violation never gets out of hand and is smaller in the last
 * quarter of the run than in the first. */
#include "example_util.h"

enum { CELLS = 44, STEPS = 3000 };

static const double H = 1e-5;   /* [s] */
static const double OFF = 1e-6; /* [m] violation at start */
static const double FAR = 1e-3; /* [m] out of hand */

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

static bool simulated_stable(const baum_mechanism *mechanism, double a, double b)
{
  double most[4] = {0.0}; /* of each quarter */
  baum_simulation *run = start(mechanism, baum_gains_scaled(a, b));
  bool held = true;
  for (int k = 0; k < STEPS && held; k++) {
    double *quarter = &most[4 * k / STEPS];
    *quarter = fmax(*quarter, fabs(violation(run)));
    held = *quarter < FAR && baum_simulation_step(run, 1) >= BAUM_OK;
  }
  baum_simulation_destroy(run);
  return held && most[3] < most[0];
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

/* With Taylor's gains z^2 = -1: a violation comes back every fourth step and stays.
 * @return its relative change in 1000 steps */
static double taylor(const baum_mechanism *mechanism)
{
  static const example_column columns[] = {{"step", "step", 'd', 5}, {"phi", "Phi [m]", 'e', 3}};
  enum { SHOWN = 8, LAST = 1000 };
  baum_simulation *run = start(mechanism, baum_gains_taylor());
  const double first = violation(run);
  printf("\nTaylor's gains (10, 11), on the boundary:\n");
  example_table("taylor", columns, 2, true);
  for (int k = 0; k <= LAST; k++) {
    if (k > 0) {
      baum_status status = baum_simulation_step(run, 1);
      if (status != BAUM_WARNED) { /* of marginal gains */
        CHECK(status);
      }
    }
    if (k <= SHOWN) {
      example_number(k);
      example_number(violation(run));
    }
  }
  double change = fabs(violation(run) / first - 1.0);
  baum_simulation_destroy(run);
  return change;
}

/* The map, and the points in the files. @return number of points that are not as predicted */
static int compare(const baum_mechanism *mechanism, int *astray)
{
  static const example_column columns[] = {{"alpha_h", "alpha h [-]", 'f', 4},
                                           {"beta2_h2", "beta^2 h^2 [-]", 'f', 4},
                                           {"predicted", "predicted stable", 'd', 1},
                                           {"simulated", "simulated stable", 'd', 1}};
  int differ = 0;
  *astray = 0;
  example_table("points", columns, 4, false);
  for (int j = CELLS - 1; j >= 0; j--) {
    printf("%9.1f  ", beta2_h2(j));
    for (int i = 0; i < CELLS; i++) {
      bool predicted = predicted_stable(alpha_h(i), beta2_h2(j));
      bool simulated = simulated_stable(mechanism, alpha_h(i), beta2_h2(j));
      printf("%c", predicted ? (simulated ? '#' : 'p') : (simulated ? 's' : '.'));
      differ += predicted != simulated;
      *astray += predicted != simulated && !at_boundary(i, j);
      example_number(alpha_h(i));
      example_number(beta2_h2(j));
      example_number(predicted);
      example_number(simulated);
    }
    printf("\n");
  }
  printf("  alpha h  %-8.4f %*.4f\n", alpha_h(0), CELLS - 9, alpha_h(CELLS - 1));
  return differ;
}

int main(int argc, char **argv)
{
  example_begin(argc, argv, "stability_region");
  printf("stability_region: pendulum, 1 particle, 1 joint; %d x %d pairs of gains\n"
         "integrator        euler, h = %g s, %d steps; formulation baumgarte\n"
         "# both stable   . both unstable   p only predicted   s only simulated stable\n\n"
         "beta^2 h^2\n",
         CELLS, CELLS, H, STEPS);
  baum_mechanism *mechanism = pendulum();
  int astray;
  int differ = compare(mechanism, &astray);
  double change = taylor(mechanism);
  baum_mechanism_destroy(mechanism);
  printf("\n%d of %d points as predicted\n", CELLS * CELLS - differ, CELLS * CELLS);
  example_expect("share of points not as predicted", (double)differ / (CELLS * CELLS), 0.02);
  example_expect("those not next to the boundary", astray, 0.0);
  example_expect("Taylor: change in 1000 steps", change, 0.01);
  return example_end();
}
