/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests RATTLE: the quantities that it conserves, the solvers of its equations, and the steps that
 * it refuses. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "check.h"
#include "message.h"
#include "models.h"
#include "runs.h"

static baum_simulation_options options_with(const baum_integrator *integrator, double step)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.step = step;
  return options;
}

static model make_pendulum(void)
{
  model m = {0};
  check(model_pendulum_rod(&MODEL_PENDULUM_A01, &m));
  return m;
}

static model make_crank(model_slider_crank with)
{
  model m = {0};
  check(model_slider_crank_build(with, &m));
  return m;
}

/* ---- conserved quantities ---- */

static void check_rows(const model *m, double step, double speed)
{
  baum_simulation_options options = options_with(baum_rattle(), step);
  baum_simulation *run = create_run(m->mechanism, &options);
  check(baum_simulation_step(run, 5000));
  baum_counters c = counters_of(run);
  /* The tolerances are rounding errors of coordinates below 1 m and of velocities below `speed`. */
  assert_true(c.max_phi <= 1e-15);
  assert_true(c.max_phi_rate <= 4e-15 * speed);
  assert_true(c.nonlinear_iterations >= 5000);
  assert_int_equal(c.rejected, 0);
  assert_int_equal(c.warnings, 0);
  baum_simulation_destroy(run);
}

static void positions_and_velocities_fulfil_the_constraints_to_rounding(void **state)
{
  (void)state;
  model pendulum = make_pendulum();
  model crank = make_crank((model_slider_crank){0});
  model driven = make_crank((model_slider_crank){.driven = true});
  check_rows(&pendulum, 0.01, 5.0);
  check_rows(&crank, 1e-4, 100.0);
  check_rows(&driven, 1e-4, 100.0);
  model_destroy(&pendulum);
  model_destroy(&crank);
  model_destroy(&driven);
}

typedef struct band {
  double least;
  double most;
} band;

static band energy_band(baum_simulation *run, int steps, double unit)
{
  band b = {(double)INFINITY, -(double)INFINITY};
  for (int k = 0; k < steps; k++) {
    check(baum_simulation_step(run, 1));
    if (k % 7 == 0) {
      double change = counters_of(run).energy_change / unit;
      b.least = fmin(b.least, change);
      b.most = fmax(b.most, change);
    }
  }
  return b;
}

/* The energy error oscillates within a band. In steps 95000 to 100000, this band must be the same
 * as in the first 5000 steps, to within 1 % of its width. With semi-implicit Euler, the energy
 * would drift by more than 10 widths of the band. */
static void check_band(const model *m, double step, double unit)
{
  baum_simulation_options options = options_with(baum_rattle(), step);
  baum_simulation *run = create_run(m->mechanism, &options);
  band first = energy_band(run, 5000, unit);
  check(baum_simulation_step(run, 90000));
  band last = energy_band(run, 5000, unit);
  double width = first.most - first.least;
  print_message("rattle, h = %g s: energy in [%.6e, %.6e], after 1e5 steps in [%.6e, %.6e]\n", step,
                first.least, first.most, last.least, last.most);
  ASSERT_NEAR(last.least, first.least, 0.0, 0.01 * width);
  ASSERT_NEAR(last.most, first.most, 0.0, 0.01 * width);
  baum_simulation_destroy(run);

  options.integrator = baum_semi_implicit_euler();
  run = create_run(m->mechanism, &options);
  check(baum_simulation_step(run, 95000));
  band other = energy_band(run, 5000, unit);
  print_message("semi-implicit Euler: in [%.6e, %.6e]\n", other.least, other.most);
  assert_true(fmax(fabs(other.least), fabs(other.most)) > 10.0 * width);
  baum_simulation_destroy(run);
}

static void the_energy_of_long_runs_stays_in_its_band(void **state)
{
  (void)state;
  model pendulum = make_pendulum();
  model crank = make_crank((model_slider_crank){0});
  check_band(&pendulum, 0.01, 9.81);
  check_band(&crank, 1e-4, 20.0);
  model_destroy(&pendulum);
  model_destroy(&crank);
}

/* The method is symmetric, so the same number of backward steps returns to the start, up to the
 * rounding errors of 500 steps in each direction. The motion amplifies these errors like any
 * perturbation. */
static void steps_backward_return_to_the_start(void **state)
{
  (void)state;
  model m = {0};
  check(model_chain_3(&m));
  baum_simulation_options options = options_with(baum_rattle(), 5e-3);
  baum_simulation *run = create_run(m.mechanism, &options);
  double q[9];
  memcpy(q, baum_simulation_q(run), sizeof q);
  check(baum_simulation_advance_to(run, 2.5));
  assert_true(fabs(baum_simulation_q(run)[2] - q[2]) > 0.1);
  check(baum_simulation_advance_to(run, 0.0));
  assert_int_equal(counters_of(run).restarts, 0);
  for (int i = 0; i < 9; i++) {
    ASSERT_NEAR(baum_simulation_q(run)[i], q[i], 0.0, 1e-11);
  }
  baum_simulation_destroy(run);
  model_destroy(&m);
}

/* Computes the angle and the angular velocity of the pendulum after `steps` steps from the state
 * `from`. */
static void map_angle(baum_simulation *run, int steps, const double from[2], double to[2])
{
  const double q[2] = {cos(from[0]), sin(from[0])};
  const double v[2] = {-from[1] * q[1], from[1] * q[0]};
  check(baum_simulation_set_state(run, 0.0, q, v));
  check(baum_simulation_step(run, steps));
  const double *x = baum_simulation_q(run);
  const double *u = baum_simulation_v(run);
  to[0] = atan2(x[1], x[0]);
  to[1] = x[0] * u[1] - x[1] * u[0];
}

/* Returns the factor by which 40 steps change areas in phase space. This factor is the determinant
 * of the derivative of map_angle(), computed by central differences. It is 1 for a symplectic
 * method. */
static double area_factor(const baum_integrator *integrator)
{
  const double d = 1e-4; /* the truncation error is d^2 times third derivatives, about 1e-7 */
  model m = make_pendulum();
  baum_simulation_options options = options_with(integrator, 0.1);
  baum_simulation *run = create_run(m.mechanism, &options);
  double derivative[2][2];
  for (int k = 0; k < 2; k++) {
    double up[2] = {-1.0, 2.0};
    double down[2] = {-1.0, 2.0};
    double ends[2][2];
    up[k] += d;
    down[k] -= d;
    map_angle(run, 40, up, ends[0]);
    map_angle(run, 40, down, ends[1]);
    for (int i = 0; i < 2; i++) {
      derivative[i][k] = (ends[0][i] - ends[1][i]) / (2.0 * d);
    }
  }
  baum_simulation_destroy(run);
  model_destroy(&m);
  return derivative[0][0] * derivative[1][1] - derivative[0][1] * derivative[1][0];
}

static void areas_in_phase_space_are_conserved(void **state)
{
  (void)state;
  ASSERT_NEAR(area_factor(baum_rattle()), 1.0, 0.0, 1e-5);
  assert_true(fabs(area_factor(baum_rk2()) - 1.0) > 1e-3);
}

/* ---- solvers ---- */

static void end_of(const model *m, const baum_simulation_options *options, double t, double *q)
{
  baum_simulation *run = create_run(m->mechanism, options);
  check(baum_simulation_advance_to(run, t));
  memcpy(q, baum_simulation_q(run), 9 * sizeof *q);
  assert_true(counters_of(run).max_phi <= 1e-14); /* rounding errors of the solver */
  baum_simulation_destroy(run);
}

/* The motions with different solvers differ only by the rounding errors of 300 steps. */
static void all_solvers_give_the_same_motion(void **state)
{
  static const baum_solver SOLVERS[] = {BAUM_SOLVER_BLOCK, BAUM_SOLVER_KLU, BAUM_SOLVER_QR};
  (void)state;
  model m = make_crank((model_slider_crank){0});
  double want[9];
  baum_simulation_options options = options_with(baum_rattle(), 1e-4);
  end_of(&m, &options, 0.03, want);
  for (int k = 0; k < 3; k++) {
    double got[9];
    options.solver = SOLVERS[k];
    end_of(&m, &options, 0.03, got);
    for (int i = 0; i < 9; i++) {
      ASSERT_NEAR(got[i], want[i], 0.0, 1e-12);
    }
  }
  model_destroy(&m);
}

/* Neither redundant rows nor fixed bodies may change the motion. */
static void redundant_rows_and_fixed_bodies_do_not_change_the_motion(void **state)
{
  (void)state;
  model plain = make_crank((model_slider_crank){0});
  model doubled = make_crank((model_slider_crank){.doubled_guide = true});
  model framed = make_crank((model_slider_crank){.frames = 2});
  baum_simulation_options options = options_with(baum_rattle(), 1e-4);
  double want[9];
  double got[9];
  end_of(&plain, &options, 0.03, want);
  for (int k = 0; k < 4; k++) {
    options.solver = k % 2 == 0 ? BAUM_SOLVER_AUTO : BAUM_SOLVER_KLU;
    end_of(k < 2 ? &doubled : &framed, &options, 0.03, got);
    for (int i = 0; i < 9; i++) {
      ASSERT_NEAR(got[i], want[i], 0.0, 1e-12);
    }
  }
  model_destroy(&plain);
  model_destroy(&doubled);
  model_destroy(&framed);
}

/* A step of 0.5 s at 10 m/s leads 5 m along the tangent of a circle with a radius of 1 m. RATTLE
 * corrects the position by a force in the direction that the rod has at the start of the step. No
 * force in this direction leads back to the circle. */
static void a_step_without_a_solution_is_refused_and_keeps_the_state(void **state)
{
  (void)state;
  model_pendulum data = MODEL_PENDULUM_A01;
  data.v = -10.0;
  model m = {0};
  check(model_pendulum_rod(&data, &m));
  baum_simulation_options options = options_with(baum_rattle(), 0.5);
  baum_simulation *run = create_run(m.mechanism, &options);
  ASSERT_SAYS(baum_simulation_step(run, 1), BAUM_ERR_CONVERGENCE,
              "t = 0 s: rattle|the step is too large");
  assert_true(baum_simulation_time(run) == 0.0);
  assert_true(baum_simulation_q(run)[0] == -1.0);
  assert_true(baum_simulation_v(run)[1] == -10.0);
  baum_simulation_destroy(run);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(positions_and_velocities_fulfil_the_constraints_to_rounding),
    cmocka_unit_test(the_energy_of_long_runs_stays_in_its_band),
    cmocka_unit_test(steps_backward_return_to_the_start),
    cmocka_unit_test(areas_in_phase_space_are_conserved),
    cmocka_unit_test(all_solvers_give_the_same_motion),
    cmocka_unit_test(redundant_rows_and_fixed_bodies_do_not_change_the_motion),
    cmocka_unit_test(a_step_without_a_solution_is_refused_and_keeps_the_state),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
