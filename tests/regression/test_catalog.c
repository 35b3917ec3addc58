/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the parts of the catalogue with each other and with the tables of tests/data, which were
 * computed in another way. References must satisfy the constraints of their mechanisms and agree
 * with the initial states. Runs must agree with the references. References that are given by
 * formulas must be as accurate as the catalogue states. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include <baum/baum.h>
#include <baum/catalog.h>

#include "a01_pendulum_reference.h"
#include "assert_near.h"
#include "check.h"
#include "n_four_bar_reference.h"
#include "runs.h"
#include "slider_crank_driven_reference.h"
#include "sundials_pendulum_reference.h"

/* An entry of the catalogue with chosen parameters, and its reference motion. */
typedef struct known {
  baum_catalog_entry entry;
  baum_catalog_choice choice;
  baum_mechanism *mechanism;
  int32_t nq;
  int32_t nv;
  int32_t nc;
  double *t; /* (n) */
  double *q; /* (n x nq) */
  double *v; /* (n x nv) */
} known;

static known know(const baum_catalog_choice *choice)
{
  known k = {.choice = *choice};
  check(baum_catalog_find(choice->name, &k.entry, sizeof k.entry));
  check(baum_catalog_build(choice, &k.mechanism));
  check(baum_mechanism_sizes(k.mechanism, &k.nq, &k.nv, &k.nc));
  size_t n = (size_t)k.entry.sample_count;
  k.t = calloc(n + 1, sizeof *k.t);
  k.q = calloc(n * (size_t)k.nq + 1, sizeof *k.q);
  k.v = calloc(n * (size_t)k.nv + 1, sizeof *k.v);
  assert_true(k.t && k.q && k.v);
  if (n > 0) {
    check(baum_catalog_times(choice->name, k.t));
  }
  for (size_t i = 0; i < n; i++) {
    check(baum_catalog_reference(choice, k.t[i], k.q + i * (size_t)k.nq, k.v + i * (size_t)k.nv));
  }
  return k;
}

static void forget(known *k)
{
  baum_mechanism_destroy(k->mechanism);
  free(k->t);
  free(k->q);
  free(k->v);
}

static void for_each_reference(void (*look)(const known *k))
{
  for (int32_t i = 0; i < baum_catalog_count(); i++) {
    baum_catalog_entry entry;
    check(baum_catalog_entry_at(i, &entry, sizeof entry));
    if (entry.sample_count > 0) {
      known k = know(&(baum_catalog_choice){.name = entry.name});
      look(&k);
      forget(&k);
    }
  }
}

/* ---- all references ---- */

static double worst_of(const double *x, int count)
{
  double worst = 0.0;
  for (int i = 0; i < count; i++) {
    worst = fmax(worst, fabs(x[i]));
  }
  return worst;
}

/* Computes J v - nu, the time derivative of Phi, at sample i of the reference. It must be 0. */
static void find_rate(const known *k, baum_workspace *workspace, int i, double *rate)
{
  const double *q = k->q + (size_t)i * (size_t)k->nq;
  const double *v = k->v + (size_t)i * (size_t)k->nv;
  double *jacobian = calloc((size_t)k->nc * (size_t)k->nv, sizeof *jacobian);
  assert_non_null(jacobian);
  check(baum_workspace_jacobian(workspace, k->t[i], q, jacobian));
  check(baum_workspace_nu(workspace, k->t[i], q, rate));
  for (int row = 0; row < k->nc; row++) {
    rate[row] = -rate[row];
    for (int column = 0; column < k->nv; column++) {
      rate[row] += jacobian[row * k->nv + column] * v[column];
    }
  }
  free(jacobian);
}

static void look_at_constraints(const known *k)
{
  baum_workspace *workspace = NULL;
  double *phi = calloc((size_t)k->nc, sizeof *phi);
  double *rate = calloc((size_t)k->nc, sizeof *rate);
  double off = 0.0;
  double off_rate = 0.0;
  int samples = k->entry.sample_count;
  double fast = worst_of(k->v, samples * k->nv);
  check(baum_workspace_create(k->mechanism, &workspace));
  assert_true(phi && rate);
  for (int i = 0; i < samples; i++) {
    check(baum_workspace_phi(workspace, k->t[i], k->q + (size_t)i * (size_t)k->nq, phi));
    find_rate(k, workspace, i, rate);
    off = fmax(off, worst_of(phi, k->nc));
    off_rate = fmax(off_rate, worst_of(rate, k->nc));
  }
  printf("%-24s |Phi| <= %.1e  |Phi'| <= %.1e of %.3g\n", k->entry.name, off, off_rate, fast);
  /* Coordinates are at most 30 m or 30 rad. The limit allows for the rounding errors of such
   * coordinates, and of sums of a few sines and cosines. */
  assert_true(off <= 1e-14);
  assert_true(off_rate <= 1e-14 * fmax(1.0, fast));
  free(phi);
  free(rate);
  baum_workspace_destroy(workspace);
}

static void references_satisfy_the_constraints(void **state)
{
  (void)state;
  for_each_reference(look_at_constraints);
}

static baum_catalog_error run(const known *k, double rtol)
{
  const baum_channel channels[] = {baum_channel_of(BAUM_Q), baum_channel_of(BAUM_V)};
  size_t n = (size_t)k->entry.sample_count;
  size_t nq = (size_t)k->nq;
  size_t nv = (size_t)k->nv;
  double *rows = calloc(n * (nq + nv), sizeof *rows);
  double *q = calloc(n * nq, sizeof *q);
  double *v = calloc(n * nv, sizeof *v);
  assert_true(rows && q && v);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = rtol;
  baum_simulation *simulation = create_run(k->mechanism, &options);
  check(baum_simulation_sample(simulation, k->t, (int64_t)n, channels, 2, rows, NULL));
  for (size_t i = 0; i < n; i++) {
    memcpy(q + i * nq, rows + i * (nq + nv), nq * sizeof *q);
    memcpy(v + i * nv, rows + i * (nq + nv) + nq, nv * sizeof *v);
  }
  baum_catalog_error start;
  baum_catalog_error error;
  check(baum_catalog_compare(&k->choice, k->mechanism, k->t, 1, q, v, &start, sizeof start));
  check(
    baum_catalog_compare(&k->choice, k->mechanism, k->t, (int64_t)n, q, v, &error, sizeof error));
  printf("%-24s rtol %.0e: start %.0e %.0e, q %.1e at %g s, v %.1e at %g s, floors %.0e %.0e\n",
         k->entry.name, rtol, start.q, start.v, error.q, error.q_time, error.v, error.v_time,
         error.q_floor, error.v_floor);
  /* The limit allows for rounding of the design configuration and of its assembly. */
  assert_true(start.q <= 1e-15 && start.v <= 1e-15);
  baum_simulation_destroy(simulation);
  free(rows);
  free(q);
  free(v);
  return error;
}

static void look_at_run(const known *k)
{
  baum_catalog_error error = run(k, 1e-11);
  /* Most errors are at most 5e-10. They add up over hundreds of steps. The spatial slider-crank has
   * an error of 1.9e-9 after nine revolutions. After flat configurations, errors reach 6e-9. */
  double wanted = k->entry.smooth ? 3e-9 : 1e-7;
  assert_true(error.q <= wanted && error.v <= wanted);
  assert_true(error.q_final <= error.q && error.v_final <= error.v);
}

static void runs_start_at_the_references_and_stay_close_to_them(void **state)
{
  (void)state;
  for_each_reference(look_at_run);
}

/* ---- formulas, compared with tables ---- */

static void compare_with_table(const char *name, int count, const double *t, const double *q,
                               int width)
{
  const baum_catalog_choice choice = {.name = name};
  baum_catalog_entry entry;
  double got[9];
  double worst = 0.0;
  check(baum_catalog_find(name, &entry, sizeof entry));
  for (int i = 0; i < count; i++) {
    check(baum_catalog_reference(&choice, t[i], got, NULL));
    for (int k = 0; k < width; k++) {
      double want = q[i * width + k];
      worst = fmax(worst, fabs(got[k] - want) / fmax(1.0, fabs(want)));
    }
  }
  printf("%-24s differs by %.1e from the table; the catalogue states %.1f digits\n", name, worst,
         entry.digits_q);
  assert_true(worst <= pow(10.0, -entry.digits_q));
}

static void formulas_are_as_accurate_as_the_catalogue_states(void **state)
{
  (void)state;
  compare_with_table("pendulum", A01_PENDULUM_SAMPLES, A01_PENDULUM_T, A01_PENDULUM_Q[0],
                     A01_PENDULUM_WIDTH);
  compare_with_table("pendulum_sundials", SUNDIALS_PENDULUM_SAMPLES, SUNDIALS_PENDULUM_T,
                     SUNDIALS_PENDULUM_Q[0], SUNDIALS_PENDULUM_WIDTH);
  compare_with_table("slider_crank_driven", SLIDER_CRANK_DRIVEN_SAMPLES, SLIDER_CRANK_DRIVEN_T,
                     SLIDER_CRANK_DRIVEN_Q[0], SLIDER_CRANK_DRIVEN_WIDTH);
}

static void the_reference_of_forty_windows_agrees_with_the_table(void **state)
{
  (void)state;
  static double q[243];
  const baum_catalog_setting windows = {"windows", 40};
  const baum_catalog_choice choice = {"n_four_bar", &windows, 1};
  for (int i = 0; i < N_FOUR_BAR_SAMPLES; i++) {
    check(baum_catalog_reference(&choice, N_FOUR_BAR_T[i], q, NULL));
    ASSERT_NEAR(q[2], N_FOUR_BAR_Q[i][0], 0.0, 1e-13); /* accuracy of the table */
    ASSERT_NEAR(q[242], q[2], 0.0, 0.0);
    ASSERT_NEAR(q[5], 0.0, 0.0, 0.0);
  }
}

/* ---- formulas with other parameters, compared with runs ---- */

static void formulas_hold_for_other_parameters(void **state)
{
  (void)state;
  static const baum_catalog_setting over[] = {
    {"gravity", 3.0}, {"angle", 0.3}, {"speed", 9.0}, {"mass", 7.0}, {"length", 1.7}};
  static const baum_catalog_setting up[] = {{"gravity", -3.0}, {"angle", 2.0}, {"length", 0.4}};
  static const baum_catalog_setting short_rods[] = {
    {"windows", 3},      {"angle", 2.0},        {"rate", 0.1},   {"length", 0.3},
    {"crank_mass", 0.2}, {"coupler_mass", 3.0}, {"gravity", 1.0}};
  static const baum_catalog_setting driven[] = {
    {"crank", 0.2}, {"rod", 0.5}, {"eccentricity", -0.1}, {"angle", 2.0}, {"speed", -40.0}};
  static const baum_catalog_setting far[] = {
    {"crank", 0.05}, {"pivot_z", -0.1}, {"pivot_x", 0.1}, {"speed", -9.0}, {"rocker_mass", 5.0}};
  static const baum_catalog_setting reach[] = {{"reach", 3.0}, {"payload", 40.0}, {"gravity", 1.0}};
  static const baum_catalog_setting leaning[] = {
    {"tilt", -0.5}, {"turning", -2.0}, {"mass", 4.0}, {"radius", 0.3}, {"axial", 0.1}};
  static const baum_catalog_setting backward[] = {
    {"speed", -0.7}, {"rate", -2.0}, {"inertia", 0.6}, {"distance", 0.2}};
  static const baum_catalog_setting spinning[] = {
    {"wheel_teeth", 31.0}, {"spider_teeth", 17.0}, {"left_load", 3.0}, {"speed", -5.0}};
  static const baum_catalog_setting rising[] = {
    {"tilt", -0.7}, {"precession", -3.0}, {"arm", 0.1}, {"inner", 3e-3}, {"across", 4e-3}};
  static const baum_catalog_setting heavy[] = {{"upright", 60.0}, {"stiffness", 1e5}};
  static const baum_catalog_setting light[] = {{"platform", 0.5}, {"gravity", 1.0}};
  static const baum_catalog_choice choices[] = {{"rolling_disc", leaning, 5},
                                                {"chaplygin_sleigh", backward, 4},
                                                {"differential", spinning, 4},
                                                {"gimbals", rising, 5},
                                                {"double_wishbone", heavy, 2},
                                                {"stewart", light, 2},
                                                {"rssr", far, 5},
                                                {"robot_arm", reach, 3},
                                                {"pendulum", over, 5},
                                                {"pendulum", up, 3},
                                                {"pendulum_mebdf", over, 4},
                                                {"n_four_bar", short_rods, 7},
                                                {"slider_crank_driven", driven, 5}};
  for (size_t i = 0; i < sizeof choices / sizeof choices[0]; i++) {
    known k = know(&choices[i]);
    baum_catalog_error error = run(&k, 1e-11);
    double wanted = k.entry.smooth ? 1e-9 : 1e-7; /* errors are larger after flat configurations */
    assert_true(error.q <= wanted && error.v <= wanted);
    forget(&k);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(references_satisfy_the_constraints),
    cmocka_unit_test(runs_start_at_the_references_and_stay_close_to_them),
    cmocka_unit_test(formulas_are_as_accurate_as_the_catalogue_states),
    cmocka_unit_test(the_reference_of_forty_windows_agrees_with_the_table),
    cmocka_unit_test(formulas_hold_for_other_parameters),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
