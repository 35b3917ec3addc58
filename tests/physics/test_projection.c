/* SPDX-License-Identifier: BSD-3-Clause */
/* With the formulation PROJECTION, every row is satisfied to rounding, at every step and at every
 * output time:
 *
 *   |Phi_i|  <= 1e-13 L_i + rounding,   L_i = max_j |J_ij| scale_j
 *   |Phi'_i| <= 1e-13 (|J_i| |v| + |nu_i|) + rounding
 *
 * Here scale_j is the unit of coordinate j: the characteristic length, or 1 rad. The test covers
 * every integrator that offers this formulation, with fixed and variable steps. The mechanisms stay
 * away from singular configurations. The rounding error of Phi_i is relative to the terms of row i.
 * The rounding error of Phi'_i is relative to L_i times the largest |v_j| / scale_j of the
 * mechanism, because all velocities are solved together.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdio.h>

#include "check.h"
#include "models.h"
#include "runs.h"

enum { WIDEST = 21, STEPS = 400, PARTS = 4000, SAMPLES = 37 };

static const double KEPT = 1e-13;
/* A few rounding errors. */
static const double ROUNDINGS = 8.0 * DBL_EPSILON;

/* ---- one state ---- */

typedef struct looked_on {
  baum_workspace *workspace;
  int32_t nv;
  int32_t nc;
  double scale[WIDEST];
  double worst_phi; /* largest ratio of a violation to its bound */
  double worst_rate;
} looked_on;

static void look_at(looked_on *at, double t, const double *q, const double *v)
{
  double jacobian[WIDEST * WIDEST];
  double phi[WIDEST];
  double nu[WIDEST];
  check(baum_workspace_phi(at->workspace, t, q, phi));
  check(baum_workspace_nu(at->workspace, t, q, nu));
  check(baum_workspace_jacobian(at->workspace, t, q, jacobian));
  double fastest = 0.0;
  for (int j = 0; j < at->nv; j++) {
    fastest = fmax(fastest, fabs(v[j]) / at->scale[j]);
  }
  for (int i = 0; i < at->nc; i++) {
    const double *row = jacobian + (ptrdiff_t)i * at->nv;
    double unit = 0.0;
    double terms = 0.0;
    double rates = fabs(nu[i]);
    double rate = -nu[i];
    for (int j = 0; j < at->nv; j++) {
      unit = fmax(unit, fabs(row[j]) * at->scale[j]);
      terms += fabs(row[j] * q[j]);
      rates += fabs(row[j] * v[j]);
      rate += row[j] * v[j];
    }
    at->worst_phi = fmax(at->worst_phi, fabs(phi[i]) / (KEPT * unit + ROUNDINGS * terms));
    double rounding = ROUNDINGS * unit * fastest;
    at->worst_rate = fmax(at->worst_rate, fabs(rate) / (KEPT * rates + rounding + DBL_MIN));
  }
}

/* ---- one run ---- */

typedef struct scene {
  const char *name;
  const char *kinds; /* (nv) a letter for each velocity: 'm' for a length, 'r' for an angle */
  double span;       /* [s] */
} scene;

static looked_on look_on(const baum_mechanism *mechanism, const scene *of)
{
  looked_on at = {0};
  double scale = (double)NAN;
  check(baum_mechanism_sizes(mechanism, NULL, &at.nv, &at.nc));
  check(baum_mechanism_get_characteristic_length(mechanism, &scale));
  check(baum_workspace_create(mechanism, &at.workspace));
  assert_true(at.nv <= WIDEST && at.nc <= WIDEST);
  for (int j = 0; j < at.nv; j++) {
    at.scale[j] = of->kinds[j % 3] == 'm' ? scale : 1.0;
  }
  return at;
}

static void step_through(looked_on *at, baum_simulation *run)
{
  for (int k = 0; k < STEPS; k++) {
    check(baum_simulation_step(run, 1));
    look_at(at, baum_simulation_time(run), baum_simulation_q(run), baum_simulation_v(run));
  }
}

/* Makes samples at times at which no step ends. */
static void sample_through(looked_on *at, baum_simulation *run, double span)
{
  const baum_channel channels[] = {baum_channel_of(BAUM_Q), baum_channel_of(BAUM_V)};
  double times[SAMPLES];
  double rows[SAMPLES * 2 * WIDEST];
  double begin = baum_simulation_time(run);
  for (int k = 0; k < SAMPLES; k++) {
    times[k] = begin + span * (k + 0.37) / SAMPLES;
  }
  check(baum_simulation_sample(run, times, SAMPLES, channels, 2, rows, NULL));
  for (int k = 0; k < SAMPLES; k++) {
    const double *q = rows + (ptrdiff_t)k * 2 * at->nv;
    look_at(at, times[k], q, q + at->nv);
  }
}

static void assert_kept(const baum_mechanism *mechanism, const scene *of,
                        const baum_integrator *integrator, bool fixed)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.formulation = BAUM_FORMULATION_PROJECTION;
  *(fixed ? &o.step : &o.rtol) = fixed ? of->span / PARTS : 1e-6;
  looked_on at = look_on(mechanism, of);
  baum_simulation *run = create_run(mechanism, &o);
  step_through(&at, run);
  sample_through(&at, run, 0.2 * of->span);
  printf("%-22s %-20s %-4s %10.3f %10.3f\n", of->name, baum_integrator_name(integrator),
         fixed ? "step" : "rtol", at.worst_phi, at.worst_rate);
  (void)fflush(stdout);
  assert_true(at.worst_phi <= 1.0);
  assert_true(at.worst_rate <= 1.0);
  baum_simulation_destroy(run);
  baum_workspace_destroy(at.workspace);
}

static void assert_kept_by_all(model *m, const scene *of)
{
  printf("\nlargest violation divided by its bound\n%-22s %-25s %10s %10s\n", "", "", "Phi",
         "Phi'");
  for (int k = 0; baum_integrator_at(k); k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    bool variable = baum_integrator_has_variable_step(integrator);
    bool runs = BAUM_HAVE_SUNDIALS || baum_integrator_has_fixed_step(integrator);
    if (!baum_integrator_offers(integrator, BAUM_FORMULATION_PROJECTION) || !runs) {
      continue;
    }
    if (baum_integrator_has_fixed_step(integrator)) {
      assert_kept(m->mechanism, of, integrator, true);
    }
    if (variable) {
      assert_kept(m->mechanism, of, integrator, false);
    }
  }
  model_destroy(m);
}

/* ---- mechanisms ---- */

static void the_rows_of_a_pendulum_are_satisfied_to_rounding(void **state)
{
  (void)state;
  model m;
  check(model_pendulum_rod(&MODEL_PENDULUM_A01, &m));
  assert_kept_by_all(&m, &(scene){"pendulum", "mmm", 4.0});
}

static void the_rows_of_a_slider_crank_are_satisfied_to_rounding(void **state)
{
  (void)state;
  model m;
  check(model_slider_crank_build((model_slider_crank){.driven = false}, &m));
  assert_kept_by_all(&m, &(scene){"slider-crank, free", "mmr", 0.1});
}

static void the_rows_of_a_driven_slider_crank_are_satisfied_to_rounding(void **state)
{
  (void)state;
  model m;
  check(model_slider_crank_build((model_slider_crank){.driven = true}, &m));
  assert_kept_by_all(&m, &(scene){"slider-crank, driven", "mmr", 0.1});
}

static void the_rows_of_a_four_bar_are_satisfied_to_rounding(void **state)
{
  (void)state;
  model m;
  check(model_four_bar(&m));
  assert_kept_by_all(&m, &(scene){"four-bar", "mmr", 4.0});
}

static void the_rows_of_andrews_mechanism_are_satisfied_to_rounding(void **state)
{
  (void)state;
  model m;
  check(model_andrews_bodies(&m));
  assert_kept_by_all(&m, &(scene){"Andrews, 7 bodies", "mmr", 0.02});
}

static void the_rows_of_a_car_axis_are_satisfied_to_rounding(void **state)
{
  (void)state;
  model m;
  check(model_car_axis(true, &m));
  assert_kept_by_all(&m, &(scene){"car axis", "mmm", 1.0});
}

static void the_rows_of_a_chain_are_satisfied_to_rounding(void **state)
{
  (void)state;
  model m;
  check(model_chain_3(&m));
  assert_kept_by_all(&m, &(scene){"chain of 3", "mmr", 2.0});
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_rows_of_a_pendulum_are_satisfied_to_rounding),
    cmocka_unit_test(the_rows_of_a_slider_crank_are_satisfied_to_rounding),
    cmocka_unit_test(the_rows_of_a_driven_slider_crank_are_satisfied_to_rounding),
    cmocka_unit_test(the_rows_of_a_four_bar_are_satisfied_to_rounding),
    cmocka_unit_test(the_rows_of_andrews_mechanism_are_satisfied_to_rounding),
    cmocka_unit_test(the_rows_of_a_car_axis_are_satisfied_to_rounding),
    cmocka_unit_test(the_rows_of_a_chain_are_satisfied_to_rounding),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
