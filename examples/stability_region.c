/* SPDX-License-Identifier: BSD-3-Clause */
/* Reproduces Fig. 1 of Flores et al. 2008 for every fixed-step integrator: the region of stable
 * gains in the plane of alpha h and beta^2 h^2. The library predicts the boundary of this region,
 * and how fast violations decay inside it. For explicit Euler, the region is the triangle of
 * equation (19). The prediction is compared with simulations of a slider-crank that starts with all
 * rows violated. In a simulation, gains count as stable if the largest violation stays bounded and
 * is smaller in the last quarter of the run than in the first. */
#include "slider_crank_model.h"

enum { CELLS = 22, STEPS = 1500, NQ = 9, NC = 8, OUTLINE = 2000 };

static const double H = 1e-5 / 150.0; /* [s] the crank rotates by 1e-5 rad in a step */
static const double OFF = 1e-6;       /* [m, rad] initial error of every coordinate */
static const double FAR = 1e3;        /* largest allowed violation / initial violation */
static const double LEVELS[] = {1.0, 0.9, 0.75, 0.5, 0.25};

typedef const baum_integrator *integrator_fn(void);
static integrator_fn *const INTEGRATORS[] = {baum_euler, baum_semi_implicit_euler,
                                             baum_rk2,   baum_rk3,
                                             baum_rk4,   baum_dp5,
                                             baum_rk8,   baum_ab2,
                                             baum_ab3,   baum_ab4};
enum { INTEGRATOR_COUNT = sizeof INTEGRATORS / sizeof INTEGRATORS[0] };

typedef struct bench {
  baum_mechanism *mechanism;
  baum_workspace *workspace;
  double q[NQ]; /* configuration that violates all rows */
  double v[NQ];
} bench;

static baum_simulation *start(const bench *b, const baum_integrator *integrator, baum_gains gains)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  options.gains = gains;
  options.allow_unstable = true;
  options.step = H;
  options.start = BAUM_START_AS_GIVEN;
  baum_simulation *run = NULL;
  CHECK(baum_simulation_create(b->mechanism, &options, &run));
  CHECK(baum_simulation_set_state(run, 0.0, b->q, b->v));
  return run;
}

/* Makes the initial state of the simulations: it is the assembled initial configuration, with every
 * coordinate moved by a different small amount. */
static bench make_bench(void)
{
  bench out = {.mechanism = slider_crank_build(false).mechanism};
  CHECK(baum_workspace_create(out.mechanism, &out.workspace));
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_euler();
  options.step = H;
  baum_simulation *run = NULL;
  CHECK(baum_simulation_create(out.mechanism, &options, &run));
  for (int i = 0; i < NQ; i++) {
    out.q[i] = baum_simulation_q(run)[i] + OFF * cos(2.0 * i);
    out.v[i] = baum_simulation_v(run)[i];
  }
  baum_simulation_destroy(run);
  return out;
}

static void read_phi(const bench *b, const baum_simulation *run, double phi[NC])
{
  CHECK(baum_workspace_phi(b->workspace, baum_simulation_time(run), baum_simulation_q(run), phi));
}

static double violation(const bench *b, const baum_simulation *run)
{
  double phi[NC];
  double most = 0.0;
  read_phi(b, run, phi);
  for (int i = 0; i < NC; i++) {
    most = fmax(most, fabs(phi[i]));
  }
  return most;
}

static bool simulated_stable(const bench *b, const baum_integrator *integrator, double alpha_h,
                             double beta2_h2)
{
  double most[4] = {0.0}; /* largest violation in each quarter of the run */
  baum_simulation *run = start(b, integrator, baum_gains_scaled(alpha_h, beta2_h2));
  const double far = FAR * violation(b, run);
  bool held = true;
  for (int k = 0; k < STEPS && held; k++) {
    double *quarter = &most[4 * k / STEPS];
    *quarter = fmax(*quarter, violation(b, run));
    held = *quarter < far && baum_simulation_step(run, 1) >= BAUM_OK;
  }
  baum_simulation_destroy(run);
  return held && most[3] < most[0];
}

/* ---- Predicted ------------------------------------------------------------ */

static bool predicted_stable(const baum_integrator *integrator, double alpha_h, double beta2_h2)
{
  baum_amplification z;
  CHECK(baum_stability_at(integrator, alpha_h, beta2_h2, &z, sizeof z));
  return z.stability == BAUM_STABLE;
}

/* Writes the contours into one table, and the largest alpha h and beta^2 h^2 of the region into
 * `most`. */
static void draw_outlines(const baum_integrator *integrator, double most[2])
{
  static const example_column columns[] = {{"radius", "spectral radius [-]", 'f', 2},
                                           {"alpha_h", "alpha h [-]", 'f', 4},
                                           {"beta2_h2", "beta^2 h^2 [-]", 'f', 4}};
  static double line[2][OUTLINE];
  char name[64];
  (void)snprintf(name, sizeof name, "%s_outline", baum_integrator_name(integrator));
  example_table(name, columns, 3, false);
  most[0] = most[1] = 0.0;
  for (size_t l = 0; l < sizeof LEVELS / sizeof LEVELS[0]; l++) {
    int32_t count = 0;
    CHECK(baum_stability_outline(integrator, LEVELS[l], OUTLINE, line[0], line[1], &count));
    for (int32_t k = 0; k < count; k++) {
      example_number(LEVELS[l]);
      example_number(line[0][k]);
      example_number(line[1][k]);
      most[0] = fmax(most[0], line[0][k]); /* from the first contour, which is the widest */
      most[1] = fmax(most[1], line[1][k]);
    }
  }
}

/* ---- Comparison ----------------------------------------------------------- */

typedef struct window {
  const baum_integrator *integrator;
  double step[2];
} window;

/* Returns alpha h of column i of the grid. The grid avoids the axes and round numbers, because
 * boundaries of regions may be there. */
static double alpha_at(const window *w, int i)
{
  return fmax(0.0, w->step[0] * (i + 0.6));
}

static double beta2_at(const window *w, int j)
{
  return fmax(0.0, w->step[1] * (j + 0.7));
}

/* Returns whether a point has a neighbour on the other side of the predicted boundary. */
static bool at_boundary(const window *w, int i, int j)
{
  bool here = predicted_stable(w->integrator, alpha_at(w, i), beta2_at(w, j));
  bool other = false;
  for (int k = 0; k < 9; k++) {
    double at[2] = {alpha_at(w, i + k % 3 - 1), beta2_at(w, j + k / 3 - 1)};
    other = other || predicted_stable(w->integrator, at[0], at[1]) != here;
  }
  return other;
}

/* Simulates all points of the grid and writes them to the files. @return the number of points where
 * simulation and prediction differ. Adds to `astray` the number of those points that are not next
 * to the predicted boundary. */
static int compare(const bench *b, const window *w, int *astray)
{
  static const example_column columns[] = {{"alpha_h", "alpha h [-]", 'f', 4},
                                           {"beta2_h2", "beta^2 h^2 [-]", 'f', 4},
                                           {"predicted", "predicted stable", 'd', 1},
                                           {"simulated", "simulated stable", 'd', 1}};
  char name[64];
  int differ = 0;
  (void)snprintf(name, sizeof name, "%s_points", baum_integrator_name(w->integrator));
  example_table(name, columns, 4, false);
  for (int k = 0; k < CELLS * CELLS; k++) {
    int i = k % CELLS;
    int j = k / CELLS;
    double at[2] = {alpha_at(w, i), beta2_at(w, j)};
    bool predicted = predicted_stable(w->integrator, at[0], at[1]);
    bool simulated = simulated_stable(b, w->integrator, at[0], at[1]);
    differ += predicted != simulated;
    *astray += predicted != simulated && !at_boundary(w, i, j);
    example_number(at[0]);
    example_number(at[1]);
    example_number(predicted);
    example_number(simulated);
  }
  return differ;
}

typedef struct summary {
  const char *name;
  double limit;   /* largest stable alpha h at alpha = beta */
  double best[2]; /* alpha h, beta^2 h^2 */
  double radius;  /* spectral radius at the best point */
  double agree;   /* [%] points where prediction and simulation agree */
} summary;

static summary examine(const bench *b, const baum_integrator *integrator, int *astray)
{
  summary out = {.name = baum_integrator_name(integrator)};
  double most[2];
  draw_outlines(integrator, most);
  window w = {integrator, {1.1 * most[0] / CELLS, 1.1 * most[1] / CELLS}};
  out.agree = 100.0 * (1.0 - (double)compare(b, &w, astray) / (CELLS * CELLS));
  baum_amplification z;
  CHECK(baum_stability_limit(integrator, 1.0, &out.limit));
  CHECK(baum_stability_best(integrator, &out.best[0], &out.best[1]));
  CHECK(baum_stability_at(integrator, out.best[0], out.best[1], &z, sizeof z));
  out.radius = z.spectral_radius;
  return out;
}

static void show(const summary *all)
{
  static const example_column columns[] = {
    {"integrator", "integrator", 's', 20},    {"limit", "limit, alpha = beta", 'f', 4},
    {"best_alpha_h", "best alpha h", 'f', 4}, {"best_beta2_h2", "beta^2 h^2", 'f', 4},
    {"best_radius", "radius", 'f', 3},        {"agree", "as predicted [%]", 'f', 1}};
  example_table("methods", columns, 6, true);
  for (int k = 0; k < INTEGRATOR_COUNT; k++) {
    example_text(all[k].name);
    example_number(all[k].limit);
    example_number(all[k].best[0]);
    example_number(all[k].best[1]);
    example_number(all[k].radius);
    example_number(all[k].agree);
  }
}

/* Simulates explicit Euler with Taylor's gains. In theory, the roots satisfy z^2 = -1: a violation
 * has the same value after every fourth step, and does not decay. @return its relative change in
 * 1000 steps */
static double taylor(const bench *b)
{
  static const example_column columns[] = {{"step", "step", 'd', 5}, {"phi", "Phi_1 [m]", 'e', 3}};
  enum { SHOWN = 8, LAST = 1000 };
  baum_simulation *run = start(b, baum_euler(), baum_gains_taylor());
  const double first = violation(b, run);
  double phi[NC];
  printf("\nTaylor's gains (10, 11) with explicit Euler, on the boundary:\n");
  example_table("taylor", columns, 2, true);
  for (int k = 0; k <= LAST; k++) {
    if (k > 0 && baum_simulation_step(run, 1) < BAUM_OK) {
      break;
    }
    if (k <= SHOWN) {
      example_number(k);
      read_phi(b, run, phi);
      example_number(phi[0]);
    }
  }
  double change = fabs(violation(b, run) / first - 1.0);
  baum_simulation_destroy(run);
  return change;
}

int main(int argc, char **argv)
{
  summary all[INTEGRATOR_COUNT];
  int astray = 0;
  double least = 100.0;
  example_begin(argc, argv, "stability_region");
  bench b = make_bench();
  printf("stability_region: free slider-crank, 3 bodies, 4 joints; %d x %d pairs of gains\n"
         "h = %.3g s, %d steps; formulation baumgarte; the prediction needs no "
         "integration\n\n",
         CELLS, CELLS, H, STEPS);
  for (int k = 0; k < INTEGRATOR_COUNT; k++) {
    all[k] = examine(&b, INTEGRATORS[k](), &astray);
    least = fmin(least, all[k].agree);
  }
  show(all);
  double change = taylor(&b);
  baum_workspace_destroy(b.workspace);
  baum_mechanism_destroy(b.mechanism);
  printf("\n");
  example_expect("largest share of wrong predictions", 1.0 - least / 100.0, 0.03);
  example_expect("wrong ones not next to the boundary", astray, 0.0);
  example_expect("Taylor: change in 1000 steps", change, 0.01);
  return example_end();
}
