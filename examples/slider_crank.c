/* SPDX-License-Identifier: BSD-3-Clause */
/* This program reproduces Fig. 3 of Flores et al. (EuCoMeS 2008) qualitatively. The figure shows
 * the constraint violation Phi_3 of the eccentric slider-crank, whose crank is driven at constant
 * speed. The integrator is explicit Euler, with eight sets of Baumgarte's gains.
 *
 * Phi_3 can be predicted. One step of Euler from the exact motion causes a violation d of Phi_3 and
 * a violation e of Phi_3'. Violations of earlier steps follow equation (6) of the paper. Together
 * this gives a recursion from one step to the next, where + marks the values after a step of length
 * h: Phi_3+ = Phi_3 + h Phi_3' + d, Phi_3'+ = Phi_3' - h (2 alpha Phi_3' + beta^2 Phi_3) + e. Its
 * characteristic equation is equation (19) of the paper. */
#include "slider_crank_model.h"

enum { STEPS = 10000, TURN = 419, SETS = 8, N = 9, ROW3 = 2, SLIDER_X = 6 };

static const double H = 1e-4; /* [s] */

/* The exact motion at every step, with which the runs are compared. */
static struct {
  double t[STEPS + 1];
  double x[STEPS + 1]; /* [m] x of the slider */
  double d[STEPS + 1]; /* violation of Phi_3 that one step of Euler causes */
  double e[STEPS + 1]; /* violation of Phi_3' that one step of Euler causes */
} exact;

/* Results of a run at every step: Phi_3 and Phi_4; x, y and angle of the slider. */
enum { PHI3, X = 2, CHANNELS = 5 };

static double rows[SETS][STEPS + 1][CHANNELS];
static double predicted[SETS][STEPS + 1]; /* Phi_3 */

/* Computes the exact motion. The driven mechanism has no degree of freedom, so its motion follows
 * from the constraints alone. */
static void solve_kinematics(const baum_mechanism *mechanism)
{
  baum_workspace *workspace = NULL;
  double q[N];
  double v[N];
  double a[N];
  double phi[N];
  double jacobian[N * N];
  double nu[N];
  CHECK(baum_workspace_create(mechanism, &workspace));
  CHECK(baum_workspace_design(workspace, q, v));
  for (int k = 0; k <= STEPS; k++) {
    double t = k * H;
    for (int i = 0; i < N; i++) {
      v[i] = (double)NAN; /* unknown, to be computed */
    }
    CHECK(baum_workspace_assemble(workspace, t, q, v, NULL, 0));
    CHECK(baum_workspace_acceleration(workspace, t, q, v, 0.0, 0.0, a, NULL));
    exact.t[k] = t;
    exact.x[k] = q[SLIDER_X];
    for (int i = 0; i < N; i++) {
      q[i] += H * v[i];
      v[i] += H * a[i];
    }
    CHECK(baum_workspace_phi(workspace, t + H, q, phi));
    CHECK(baum_workspace_jacobian(workspace, t + H, q, jacobian));
    CHECK(baum_workspace_nu(workspace, t + H, q, nu));
    exact.d[k] = phi[ROW3];
    exact.e[k] = -nu[ROW3];
    for (int i = 0; i < N; i++) {
      exact.e[k] += jacobian[N * ROW3 + i] * v[i];
    }
  }
  baum_workspace_destroy(workspace);
}

static void predict(double alpha, double beta, double *phi)
{
  double rate = 0.0;
  phi[0] = 0.0;
  for (int k = 0; k < STEPS; k++) {
    phi[k + 1] = phi[k] + H * rate + exact.d[k];
    rate += exact.e[k] - H * (2.0 * alpha * rate + beta * beta * phi[k]);
  }
}

/* Returns the largest difference of Phi_3 from its prediction, divided by the largest
 * prediction. */
static double relative_difference(int set)
{
  double difference = 0.0;
  double expected = 0.0;
  for (int k = 0; k <= STEPS; k++) {
    difference = fmax(difference, fabs(rows[set][k][PHI3] - predicted[set][k]));
    expected = fmax(expected, fabs(predicted[set][k]));
  }
  return difference / expected;
}

/* Simulates with one set of gains. @return the counters of the run */
static baum_counters simulate(const slider_crank *s, baum_gains gains, int set)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_euler();
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  options.gains = gains;
  options.step = H;
  baum_simulation *run = NULL;
  CHECK(baum_simulation_create(s->mechanism, &options, &run));
  const baum_channel channels[] = {baum_channel_of_joint(BAUM_PHI, s->pin_b),
                                   baum_channel_of_body(BAUM_BODY_POSE, s->slider)};
  baum_status status =
    baum_simulation_sample(run, exact.t, STEPS + 1, channels, 2, rows[set][0], NULL);
  if (status != BAUM_WARNED) { /* the table shows which gains are marginal */
    CHECK(status);
  }
  baum_counters counters;
  CHECK(baum_simulation_counters(run, &counters, sizeof counters));
  baum_simulation_destroy(run);
  return counters;
}

/* Prints one row of the table. */
static void tell(const char *name, const baum_counters *c, int set)
{
  static const char *const classes[] = {"stable", "marginal", "unstable", "-"};
  baum_amplification z;
  CHECK(baum_stability_at(baum_euler(), c->alpha * H, c->beta * H * c->beta * H, &z, sizeof z));
  double observed = 0.0;
  double expected = 0.0;
  double slider = 0.0;
  for (int k = 0; k <= STEPS; k++) {
    observed = fmax(observed, fabs(rows[set][k][PHI3]));
    expected = fmax(expected, fabs(predicted[set][k]));
    slider = fmax(slider, fabs(rows[set][k][X] - exact.x[k]));
  }
  example_text(name);
  example_number(c->alpha);
  example_number(c->beta);
  example_number(z.spectral_radius);
  example_text(classes[z.stability]);
  example_number(observed);
  example_number(expected);
  example_number(fabs(rows[set][STEPS][PHI3]));
  example_number(c->max_phi);
  example_number(c->predicted_phi);
  example_number(slider);
}

static const struct {
  const char *key;
  const char *name;
  int32_t rule;
  double value[2];
} sets[SETS] = {
  {"none", "none", BAUM_GAINS_FIXED, {0.0, 0.0}},
  {"equal_5", "alpha = beta = 5/s", BAUM_GAINS_FIXED, {5.0, 5.0}},
  {"equal_50", "alpha = beta = 50/s", BAUM_GAINS_FIXED, {50.0, 50.0}},
  {"equal_500", "alpha = beta = 500/s", BAUM_GAINS_FIXED, {500.0, 500.0}},
  {"underdamped", "100 Hz, damping ratio 0.2", BAUM_GAINS_FREQUENCY, {100.0, 0.2}},
  {"overdamped", "10 Hz, damping ratio 3", BAUM_GAINS_FREQUENCY, {10.0, 3.0}},
  {"taylor", "Taylor (10, 11)", BAUM_GAINS_TAYLOR, {0.0, 0.0}},
  {"stiff", "stiff, alpha = beta = 1/h", BAUM_GAINS_SCALED, {1.0, 1.0}},
};
enum { NONE, EQUAL_50 = 2, STIFF = SETS - 1 };

/* Writes Phi_3 over time, for the figure. */
static void write_series(const char *name, int steps, int every)
{
  example_column columns[SETS + 1] = {{"t", "t [s]", 'f', 4}};
  for (int set = 0; set < SETS; set++) {
    columns[set + 1] = (example_column){sets[set].key, sets[set].name, 'e', 6};
  }
  example_table(name, columns, SETS + 1, false);
  for (int k = 0; k <= steps; k += every) {
    example_number(exact.t[k]);
    for (int set = 0; set < SETS; set++) {
      example_number(rows[set][k][PHI3]);
    }
  }
  example_close_table();
}

int main(int argc, char **argv)
{
  static const example_column columns[] = {{"gains", "gains", 's', 25},
                                           {"alpha", "alpha [1/s]", 'f', 1},
                                           {"beta", "beta [1/s]", 'f', 1},
                                           {"spectral_radius", "max|z|", 'f', 4},
                                           {"stability", "class", 's', 8},
                                           {"max_phi3", "max|Phi_3| [m]", 'e', 2},
                                           {"max_phi3_predicted", "predicted", 'e', 2},
                                           {"final_phi3", "at 1 s", 'e', 2},
                                           {"max_phi", "max|Phi| [m]", 'e', 2},
                                           {"predicted_phi", "steady", 'e', 2},
                                           {"slider_error", "slider off [m]", 'e', 2}};
  example_begin(argc, argv, "slider_crank");
  slider_crank s = slider_crank_build(true);
  solve_kinematics(s.mechanism);
  printf("slider_crank: 3 bodies, 5 joints, no degree of freedom; crank driven at %g rad/s\n"
         "integrator    euler, h = %g s, %d steps; formulation baumgarte\n"
         "predicted     by the recursion of (19); steady: by the library, for gains >= 0.1/h\n\n",
         SLIDER_CRANK_SPEED, H, STEPS);
  example_table("gain_sets", columns, 11, true);
  double steady = 0.0; /* max|Phi| / the library's prediction, for the last set */
  for (int set = 0; set < SETS; set++) {
    baum_gains gains = {.rule = sets[set].rule, .value = {sets[set].value[0], sets[set].value[1]}};
    baum_counters counters = simulate(&s, gains, set);
    predict(counters.alpha, counters.beta, predicted[set]);
    tell(sets[set].name, &counters, set);
    steady = counters.max_phi / counters.predicted_phi;
  }
  baum_mechanism_destroy(s.mechanism);
  write_series("phi3", STEPS, 5);
  write_series("phi3_start", TURN, 1);

  printf("\n");
  double worst = 0.0;
  for (int set = EQUAL_50; set < SETS; set++) {
    worst = fmax(worst, relative_difference(set));
  }
  example_expect("none: |Phi_3| at 0.5 s / at 1 s",
                 fabs(rows[NONE][STEPS / 2][PHI3] / rows[NONE][STEPS][PHI3]), 0.7);
  example_expect("prediction, last six sets, off by", worst, 0.05);
  example_expect("gains 1/h: max|Phi| / prediction, off by", fabs(steady - 1.0), 0.02);
  return example_end();
}
