/* SPDX-License-Identifier: BSD-3-Clause */
/* A double pendulum has two rods of 1 m and 1 kg. They are joined by a bushing, which has a spring
 * of 1e6 N/m and a damper of 1e3 N s/m in each of two directions. Motion in the bushing decays at
 * rates of 1e3 to 1e4 1/s, that is, within milliseconds. The rods swing at 3 to 7 rad/s, which is
 * much slower, so the problem is stiff. Adams methods therefore need short steps. At the same
 * tolerance, the number of steps of BDF must be at most a twentieth of theirs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "physics_run.h"
#include "runs.h"

enum { COORDINATES = 6 };

static const double STIFFNESS = 1e6; /* [N/m] */
static const double DAMPING = 1e3;   /* [N s/m] */
static const double ARM = 0.1;       /* [m] length of the springs */
static const double ANGLE = -1.0;    /* [rad] of both rods, from the x axis */
static const double END = 5.0;       /* [s] */

static baum_body_id add_rod(baum_mechanism *mechanism, double from)
{
  baum_planar_body_def rod = baum_planar_body_def_default();
  rod.inertia = 1.0 / 12.0;
  rod.angle = ANGLE;
  rod.position[0] = (from + 0.5) * cos(ANGLE);
  rod.position[1] = (from + 0.5) * sin(ANGLE);
  rod.velocity[0] = rod.velocity[1] = rod.angular_velocity = 0.0;
  baum_body_id id;
  check(baum_mechanism_add_planar_body(mechanism, &rod, &id));
  return id;
}

/* Adds a spring along the rods and one across them. */
static void add_bushing(baum_mechanism *mechanism, baum_body_id upper, baum_body_id lower)
{
  for (int k = 0; k < 2; k++) {
    baum_planar_spring_def spring = baum_planar_spring_def_default();
    spring.body_a = upper;
    spring.body_b = lower;
    spring.point_a[0] = k == 0 ? 0.5 - ARM : 0.5;
    spring.point_a[1] = k == 0 ? 0.0 : ARM;
    spring.point_b[0] = -0.5;
    spring.point_b[1] = 0.0;
    spring.stiffness = STIFFNESS;
    spring.damping = DAMPING;
    check(baum_mechanism_add_planar_spring(mechanism, &spring, NULL));
  }
}

static baum_mechanism *make_rods(void)
{
  baum_mechanism *mechanism = create_mechanism();
  baum_body_id upper = add_rod(mechanism, 0.0);
  baum_body_id lower = add_rod(mechanism, 1.0);
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.body_a = BAUM_GROUND;
  pin.body_b = upper;
  pin.point_a[0] = pin.point_a[1] = pin.point_b[1] = 0.0;
  pin.point_b[0] = -0.5;
  check(baum_mechanism_add_planar_revolute(mechanism, &pin, NULL));
  add_bushing(mechanism, upper, lower);
  check(baum_mechanism_freeze(mechanism));
  return mechanism;
}

typedef struct stiff_run {
  double q[COORDINATES];
  baum_counters counters;
} stiff_run;

static stiff_run run_to_the_end(const baum_mechanism *mechanism, const baum_integrator *integrator,
                                baum_formulation formulation, double rtol)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = formulation;
  options.rtol = rtol;
  stiff_run out;
  baum_simulation *run = create_run(mechanism, &options);
  check(baum_simulation_advance_to(run, END));
  memcpy(out.q, baum_simulation_q(run), sizeof out.q);
  out.counters = counters_of(run);
  baum_simulation_destroy(run);
  return out;
}

/* Returns the largest difference of positions, in m or rad. */
static double error_of(const stiff_run *run, const stiff_run *want)
{
  double error = 0.0;
  for (int i = 0; i < COORDINATES; i++) {
    error = fmax(error, fabs(run->q[i] - want->q[i]));
  }
  return error;
}

static stiff_run report(const baum_mechanism *mechanism, const baum_integrator *integrator,
                        baum_formulation formulation, double rtol, const stiff_run *want)
{
  stiff_run run = run_to_the_end(mechanism, integrator, formulation, rtol);
  printf("%-12s %-13s %8.0e %8lld %12lld %10.1e\n", baum_integrator_name(integrator),
         baum_formulation_name(formulation), rtol, (long long)run.counters.steps,
         (long long)run.counters.evaluations, error_of(&run, want));
  return run;
}

static void bdf_needs_few_steps_for_a_stiff_bushing(void **state)
{
  (void)state;
  need_sundials();
  baum_mechanism *mechanism = make_rods();
  /* The reference is computed by an explicit method. The bushing forces this method to take short
   * steps, so that its error is far below the errors of the other runs. */
  stiff_run want = run_to_the_end(mechanism, baum_rk8(), BAUM_FORMULATION_PROJECTION, 1e-9);
  printf("\n%-12s %-13s %8s %8s %12s %10s\n", "bushing", "", "rtol", "steps", "evaluations",
         "error");
  stiff_run adams = report(mechanism, baum_cvode_adams(), BAUM_FORMULATION_BAUMGARTE, 1e-4, &want);
  const baum_formulation formulations[] = {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE,
                                           BAUM_FORMULATION_UNSTABILIZED};
  for (int k = 0; k < 3; k++) {
    stiff_run bdf = report(mechanism, baum_cvode_bdf(), formulations[k], 1e-4, &want);
    assert_true(20 * bdf.counters.steps <= adams.counters.steps);
    stiff_run finer = report(mechanism, baum_cvode_bdf(), formulations[k], 1e-7, &want);
    /* The tolerance is three decades tighter. At order 4 to 5, this should reduce the error by a
     * factor of about 250. This does not test the Jacobian; a wrong one would increase the number
     * of steps. */
    assert_true(error_of(&finer, &want) <= error_of(&bdf, &want) / 10.0);
  }
  baum_mechanism_destroy(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(bdf_needs_few_steps_for_a_stiff_bushing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
