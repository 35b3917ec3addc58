/* SPDX-License-Identifier: BSD-3-Clause */
/* The energy account of a run compares the change of its energy with the work that was done. The
 * difference is called the residual. With variable steps, the residual must be below 100 rtol. With
 * fixed steps, it must have the order of the method. The test covers all mechanisms of
 * account_scenes.h with every formulation. The residual is read at 8 times, and the largest value
 * counts. This value is divided by the largest energy or work. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "account_scenes.h"
#include "physics_run.h"
#include "runs.h"

enum { WIDTH = 12, KINETIC = 0, POTENTIAL = 1, GAINS = 10, RESIDUAL = 11, TIMES = 8, RUNGS = 3 };

static const baum_formulation FORMULATIONS[] = {
  BAUM_FORMULATION_UNSTABILIZED, BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_PROJECTION,
  BAUM_FORMULATION_INDEX2,       BAUM_FORMULATION_GGL,       BAUM_FORMULATION_INDEX3};
enum { FORMULATION_COUNT = sizeof FORMULATIONS / sizeof *FORMULATIONS };

/* ---- one run ---- */

static double close_run(const account_scene *scene, baum_simulation_options options)
{
  const baum_channel channel = baum_channel_of(BAUM_ENERGY_ACCOUNT);
  double times[TIMES];
  double rows[TIMES][WIDTH];
  double residual = 0.0;
  double size = 0.0;
  baum_mechanism *m = account_build(scene);
  assert_non_null(m);
  for (int k = 0; k < TIMES; k++) {
    times[k] = scene->span * (k + 1) / TIMES;
  }
  options.energy_account = true;
  options.start = scene->start;
  baum_simulation *run = create_run(m, &options);
  check(baum_simulation_sample(run, times, TIMES, &channel, 1, rows[0], NULL));
  for (int k = 0; k < TIMES; k++) {
    residual = fmax(residual, fabs(rows[k][RESIDUAL]));
    size = fmax(size, rows[k][KINETIC]);
    size = fmax(size, largest_of(rows[k] + POTENTIAL + 1, GAINS - POTENTIAL - 1));
    assert_true(isfinite(rows[k][RESIDUAL]));
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  return residual / size;
}

static void print_head(const account_scene *scene, const baum_simulation_options *options)
{
  printf("%-9s %-20s %-13s", scene->name, baum_integrator_name(options->integrator),
         baum_formulation_name(options->formulation));
}

/* ---- fixed steps ---- */

/* Returns the number of steps of the coarsest run. With this number, the step of the coarsest run
 * is short enough for error terms of the next order to be small. The step of the finest run is long
 * enough for its residual to be above 1e-13. */
static int coarsest_of(const baum_integrator *method)
{
  int order = baum_integrator_order(method);
  if (order >= 5) {
    return order >= 8 ? 24 : 64;
  }
  return order == 1 || order == 4 ? 512 : 256;
}

/* How far a measured slope may be below the order. The slope is smaller than the order if error
 * terms of higher order have the opposite sign. If such terms dominate, the slope may also be
 * larger, which is allowed. */
static const double BELOW = 0.35;

static void observe_order(const account_scene *scene, baum_simulation_options options)
{
  double error[RUNGS];
  int order = baum_integrator_order(options.integrator);
  if (options.formulation == BAUM_FORMULATION_BAUMGARTE) {
    options.gains = baum_gains_fixed(5.0, 5.0);
  }
  print_head(scene, &options);
  for (int k = 0; k < RUNGS; k++) {
    options.step = scene->span / (coarsest_of(options.integrator) << k);
    error[k] = close_run(scene, options);
    printf(" %9.2e", error[k]);
  }
  double slope = log2(error[0] / error[RUNGS - 1]) / (RUNGS - 1);
  printf("   order %.2f\n", slope);
  (void)fflush(stdout);
  /* A residual below 1e-12 is only the rounding error that arises when the works of several
   * thousand steps are added. */
  assert_true(slope >= order - BELOW || error[RUNGS - 1] < 1e-12);
}

/* Tells whether the order of a method can be observed in a scene. At index 3 it cannot be observed
 * if the start violates the constraints, because the first step then moves the state onto the
 * constraints. RATTLE supports neither dampers nor mass matrices that depend on q. */
static bool suits(const account_scene *scene, const baum_simulation_options *options)
{
  bool index3 = options->formulation == BAUM_FORMULATION_INDEX3;
  return baum_integrator_offers(options->integrator, options->formulation) &&
         !(index3 && scene->kind == ACCOUNT_VIOLATED) &&
         (options->integrator != baum_rattle() || scene->kind <= ACCOUNT_DRIVEN);
}

static void residuals_fall_with_the_order_of_fixed_step_methods(void **state)
{
  (void)state;
  const baum_integrator *const methods[] = {baum_euler(),  baum_semi_implicit_euler(),
                                            baum_rk2(),    baum_rk3(),
                                            baum_rk4(),    baum_dp5(),
                                            baum_rk8(),    baum_ab2(),
                                            baum_ab3(),    baum_ab4(),
                                            baum_rattle(), baum_generalized_alpha()};
  printf("\nresiduals with steps that are halved each time, mean slope\n");
  for (int s = 0; s < ACCOUNT_SCENES; s++) {
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
      for (int f = 0; f < FORMULATION_COUNT; f++) {
        baum_simulation_options options = baum_simulation_options_default();
        options.integrator = methods[i];
        options.formulation = FORMULATIONS[f];
        if (suits(&account_scenes[s], &options)) {
          observe_order(&account_scenes[s], options);
        }
      }
    }
  }
}

/* ---- variable steps ---- */

/* Returns the largest allowed value of residual / rtol. IDA at index 3 does not control the error
 * of velocities, and exceeds its tolerance. The measured value was 197 with one compiler, and 340
 * with another one, because they round differently. */
static double allowed(const baum_simulation_options *options)
{
  return options->formulation == BAUM_FORMULATION_INDEX3 ? 500.0 : 100.0;
}

static void observe_tolerance(const account_scene *scene, baum_simulation_options options)
{
  static const double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10};
  double worst = 0.0;
  print_head(scene, &options);
  for (int k = 0; k < 4; k++) {
    options.rtol = tolerances[k];
    double error = close_run(scene, options) / options.rtol;
    worst = fmax(worst, error / allowed(&options));
    printf(" %9.2e", error);
  }
  printf("\n");
  (void)fflush(stdout);
  assert_true(worst <= 1.0);
}

static void close_all(const baum_integrator *method)
{
  for (int s = 0; s < ACCOUNT_SCENES; s++) {
    for (int f = 0; f < FORMULATION_COUNT; f++) {
      baum_simulation_options options = baum_simulation_options_default();
      options.integrator = method;
      options.formulation = FORMULATIONS[f];
      if (baum_integrator_offers(method, options.formulation)) {
        observe_tolerance(&account_scenes[s], options);
      }
    }
  }
}

static void residuals_of_runge_kutta_pairs_fall_with_the_tolerance(void **state)
{
  (void)state;
  printf("\nresiduals over rtol, at rtol 1e-4 to 1e-10\n");
  close_all(baum_dp5());
  close_all(baum_rk8());
}

static void residuals_of_sundials_fall_with_the_tolerance(void **state)
{
  (void)state;
  need_sundials();
  printf("\nresiduals over rtol, at rtol 1e-4 to 1e-10\n");
  close_all(baum_cvode_adams());
  close_all(baum_cvode_bdf());
  close_all(baum_ida());
}

/* ---- what causes the residual ---- */

/* A computed motion at TIMES times, with the largest error of q and the largest errors of the
 * energy account. The error of q is known only if an exact motion is given. */
typedef struct motion {
  double q[TIMES][WIDTH];
  double error; /* largest error of q [m or rad]; links are 1 m long, so both count equally */
  /* The next two are divided by the largest kinetic energy. */
  double residual; /* of the account */
  double works;    /* work done by violations and by projection */
} motion;

static motion follow(const baum_mechanism *m, baum_simulation_options options, const motion *exact)
{
  motion out = {.error = 0.0};
  double kinetic = 0.0;
  int32_t nq = 0;
  options.energy_account = true;
  check(baum_mechanism_sizes(m, &nq, NULL, NULL));
  baum_simulation *run = create_run(m, &options);
  for (int k = 0; k < TIMES; k++) {
    baum_energy_account a;
    check(baum_simulation_advance_to(run, account_scenes[ACCOUNT_QUIET].span * (k + 1) / TIMES));
    check(baum_simulation_energy_account(run, &a, sizeof a));
    for (int i = 0; i < nq; i++) {
      out.q[k][i] = baum_simulation_q(run)[i];
      out.error = fmax(out.error, exact ? fabs(out.q[k][i] - exact->q[k][i]) : 0.0);
    }
    kinetic = fmax(kinetic, a.kinetic);
    out.residual = fmax(out.residual, fabs(a.residual));
    out.works = fmax(out.works, fabs(a.violation) + fabs(a.projection));
  }
  out.residual /= kinetic;
  out.works /= kinetic;
  baum_simulation_destroy(run);
  return out;
}

/* If almost no work is done, the residual is the change of T + V and contains no errors of computed
 * works. The integrator alone then causes both the residual and the error of the motion. These two
 * must therefore be comparable. This shows that the residuals of BDF and IDA at tight tolerances
 * come from the integrators, and not from the account. */
static void residuals_are_comparable_with_the_error_of_the_motion(void **state)
{
  (void)state;
  need_sundials();
  const struct {
    const baum_integrator *integrator;
    baum_formulation formulation;
  } methods[] = {{baum_cvode_bdf(), BAUM_FORMULATION_PROJECTION},
                 {baum_ida(), BAUM_FORMULATION_GGL},
                 {baum_ida(), BAUM_FORMULATION_INDEX2}};
  baum_mechanism *m = account_build(&account_scenes[ACCOUNT_QUIET]);
  assert_non_null(m);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-13;
  const motion exact = follow(m, options, NULL);
  printf("\nresiduals, works and errors of the motion over rtol, at rtol 1e-8 and 1e-10\n");
  for (int k = 0; k < 6; k++) {
    options.integrator = methods[k / 2].integrator;
    options.formulation = methods[k / 2].formulation;
    options.rtol = k % 2 == 0 ? 1e-8 : 1e-10;
    motion got = follow(m, options, &exact);
    print_head(&account_scenes[ACCOUNT_QUIET], &options);
    printf(" %9.2e %9.2e %9.2e\n", got.residual / options.rtol, got.works / options.rtol,
           got.error / options.rtol);
    assert_true(got.works <= 0.05 * got.residual);
    assert_true(got.residual <= 2.0 * got.error); /* ratios from 0.7 to 1.3 were measured */
  }
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(residuals_fall_with_the_order_of_fixed_step_methods),
    cmocka_unit_test(residuals_of_runge_kutta_pairs_fall_with_the_tolerance),
    cmocka_unit_test(residuals_of_sundials_fall_with_the_tolerance),
    cmocka_unit_test(residuals_are_comparable_with_the_error_of_the_motion),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
