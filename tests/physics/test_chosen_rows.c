/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests mechanisms with redundant rows. The solver omits some rows, and changes during the motion
 * which rows it omits. Two pins join two bars rigidly. The bars make several revolutions with every
 * integrator, formulation and solver, and they must move as if they were welded. Another mechanism
 * consists of bodies that are almost points. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "locked_pair.h"
#include "runs.h"
#include "step_mode.h"

static const double STEP = 1e-3;
static const double RTOL = 1e-8;
/* [s] three revolutions, in which the omitted rows change several times. */
static const double END = 2.0;
static const double RATE = 10.0; /* [rad/s] */

static const baum_solver SOLVERS[] = {BAUM_SOLVER_AUTO, BAUM_SOLVER_BLOCK, BAUM_SOLVER_KLU,
                                      BAUM_SOLVER_QR};
enum { SOLVER_COUNT = sizeof SOLVERS / sizeof *SOLVERS };

static double apart(const double *a, const double *b)
{
  double most = 0.0;
  for (int i = 0; i < LOCKED_NV; i++) {
    most = fmax(most, fabs(a[i] - b[i]));
  }
  return most;
}

static void find_motion(double exact[LOCKED_NV])
{
  baum_simulation_options o = baum_simulation_options_default();
  baum_mechanism *m = locked_pair_make(RATE, true);
  o.integrator = baum_rk8();
  o.rtol = 1e-12;
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_advance_to(run, END));
  memcpy(exact, baum_simulation_q(run), LOCKED_NV * sizeof *exact);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* Runs to END. The run may warn only that multipliers are not unique. With KLU it may also report
 * near-singular intervals, because KLU's pivots do not measure singularity accurately. */
static baum_simulation *run_to_end(const baum_mechanism *m, const baum_simulation_options *o)
{
  baum_simulation *run = create_run(m, o);
  baum_status status = baum_simulation_advance_to(run, END);
  baum_counters counters = counters_of(run);
  int64_t looks = o->solver == BAUM_SOLVER_KLU ? counters.near_singular_intervals : 0;
  if (status < BAUM_OK || counters.warnings - looks != 1 || counters.branch_warnings != 0) {
    fail_msg("%s, %s, solver %d: %s", baum_integrator_name(o->integrator),
             baum_formulation_name(o->formulation), (int)o->solver, baum_simulation_message(run));
  }
  return run;
}

/* Tells whether a method is tested. Methods of order 1 and 2 are excluded, because they give a
 * warning at this step. IDA at index 3 is excluded, because it always gives a warning. */
static bool is_asked(const baum_simulation_options *o)
{
  int order = baum_integrator_order(o->integrator);
  return baum_integrator_offers(o->integrator, o->formulation) && (isnan(o->step) || order > 2) &&
         o->formulation != BAUM_FORMULATION_INDEX3;
}

/* The largest allowed error. With a fixed step, it is the error of a method of order 3. With a
 * variable step, it is the error of several hundred steps at the given tolerance. */
static const double ERROR = 2e-4;

static void bars_locked_by_two_pins_rotate_as_if_welded(void **state)
{
  (void)state;
  double exact[LOCKED_NV];
  find_motion(exact);
  baum_mechanism *m = locked_pair_make(RATE, false);
  int count = 0;
  for (int k = 0; k < 6 * SOLVER_COUNT; k++) {
    for (int i = 0; step_mode_at(i).integrator; i++) {
      baum_simulation_options o = step_mode_options(step_mode_at(i), STEP, RTOL);
      o.formulation = (baum_formulation)(1 + k / SOLVER_COUNT);
      o.solver = SOLVERS[k % SOLVER_COUNT];
      if (!is_asked(&o)) {
        continue;
      }
      baum_simulation *run = run_to_end(m, &o);
      double error = apart(baum_simulation_q(run), exact);
      if (!(error < ERROR)) {
        fail_msg("%s, %s, solver %d: off by %.2g", baum_integrator_name(o.integrator),
                 baum_formulation_name(o.formulation), (int)o.solver, error);
      }
      baum_simulation_destroy(run);
      count++;
    }
  }
  assert_true(count > 30);
  baum_mechanism_destroy(m);
}

/* RATTLE and generalized-alpha use the same pivots in many steps. When the omitted rows change,
 * these methods must choose new pivots. */
static void index_3_methods_make_several_revolutions(void **state)
{
  (void)state;
  const baum_integrator *const methods[] = {baum_rattle(), baum_generalized_alpha()};
  double exact[LOCKED_NV];
  find_motion(exact);
  baum_mechanism *m = locked_pair_make(RATE, false);
  for (int k = 0; k < 2; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = methods[k];
    o.step = STEP;
    baum_simulation *run = run_to_end(m, &o);
    /* The error of a method of order 2 is (omega h)^2 times 20 rad. */
    assert_true(apart(baum_simulation_q(run), exact) < 1e-2);
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* ---- save and restore ---- */

/* One run is saved, and the buffer is restored in another run. At its start, the other run has
 * chosen which rows to omit. It must replace this choice by the choice of the saved run. */
static void a_restored_run_omits_the_same_rows_as_the_saved_run(void **state)
{
  (void)state;
  baum_mechanism *m = locked_pair_make(RATE, false);
  for (int k = 0; k < 2; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = k == 0 ? baum_rk4() : baum_rk8();
    o.step = k == 0 ? STEP : (double)NAN;
    o.rtol = k == 0 ? (double)NAN : RTOL;
    o.energy_account = true;
    baum_simulation *one = create_run(m, &o);
    baum_simulation *other = create_run(m, &o);
    for (int at = 0; at < 5; at++) {
      size_t size = 0;
      check(baum_simulation_advance_to(one, 0.4 * at + 0.15));
      void *buffer = save_run(one, &size);
      check(baum_simulation_restore(other, buffer, size));
      free(buffer);
      check(baum_simulation_advance_to(one, 0.4 * at + 0.4));
      check(baum_simulation_advance_to(other, 0.4 * at + 0.4));
      assert_memory_equal(baum_simulation_q(one), baum_simulation_q(other),
                          LOCKED_NV * sizeof(double));
      assert_memory_equal(baum_simulation_v(one), baum_simulation_v(other),
                          LOCKED_NV * sizeof(double));
    }
    baum_energy_account account;
    check(baum_simulation_energy_account(one, &account, sizeof account));
    /* The limit allows for errors of the method, and for the corrections when the omitted rows
     * change. The kinetic energy is 100 J. */
    assert_true(fabs(account.residual) < 1e-4);
    baum_simulation_destroy(one);
    baum_simulation_destroy(other);
  }
  baum_mechanism_destroy(m);
}

/* ---- spatial mechanisms ---- */

static baum_body_id add_body(baum_mechanism *m, double inertia, const double position[3])
{
  baum_body_id body;
  baum_spatial_body_def def = baum_spatial_body_def_default();
  memcpy(def.position, position, sizeof def.position);
  def.inertia[0] = def.inertia[1] = def.inertia[2] = inertia;
  check(baum_mechanism_add_spatial_body(m, &def, &body));
  return body;
}

static void add_hinge(baum_mechanism *m, baum_body_id a, baum_body_id b, const double point[3],
                      const double axis[3])
{
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  def.body_a = a;
  def.body_b = b;
  memcpy(def.point, point, sizeof def.point);
  memcpy(def.axis, axis, sizeof def.axis);
  check(baum_mechanism_add_spatial_revolute(m, &def, NULL));
}

/* ---- bodies that are almost points ---- */

/* Sets out to the point (x, y) of the plane of motion, in ground axes. The plane is tilted, because
 * many entries of rows in ground axes would otherwise be 0. */
static void place(double x, double y, double out[3])
{
  out[0] = (-16.0 * x + 12.0 * y) / 29.0;
  out[1] = (-3.0 * x + 24.0 * y) / 29.0;
  out[2] = (-24.0 * x - 11.0 * y) / 29.0;
}

/* Makes a four-bar linkage of hinges in space, which has three redundant rows. The moments of
 * inertia are so small that the pivots of the block solver are rounding errors, and the distances
 * of the kept rows, with columns multiplied by 1 / sqrt(M_ii), become small only shortly before
 * the rows become dependent. */
static baum_mechanism *make_four_bar_of_points(void)
{
  static const double CORNERS[4][2] = {{0.0, 0.0},
                                       {0.21612092234725591, 0.33658839392315865},
                                       {1.1173627764876177, 0.76990481450475057},
                                       {0.9, 0.0}};
  baum_mechanism *m = NULL;
  check(baum_mechanism_create(&m));
  baum_body_id bodies[5] = {BAUM_GROUND, BAUM_GROUND, BAUM_GROUND, BAUM_GROUND, BAUM_GROUND};
  for (int k = 0; k < 3; k++) {
    double middle[3];
    place(0.5 * (CORNERS[k][0] + CORNERS[k + 1][0]), 0.5 * (CORNERS[k][1] + CORNERS[k + 1][1]),
          middle);
    bodies[k + 1] = add_body(m, 1e-6, middle);
  }
  for (int k = 0; k < 4; k++) {
    const double axis[3] = {21.0, -16.0, -12.0};
    double corner[3];
    place(CORNERS[k][0], CORNERS[k][1], corner);
    add_hinge(m, bodies[k], bodies[k + 1], corner, axis);
  }
  check(baum_mechanism_freeze(m));
  return m;
}

/* At the last of these times [s], the rows that are kept at the start are dependent. */
static const double DEPENDENT[] = {0.44, 0.4406, 0.440628889};
enum { TIMES = sizeof DEPENDENT / sizeof *DEPENDENT };

static void rows_of_almost_points_are_exchanged_in_time(void **state)
{
  (void)state;
  const baum_integrator *const methods[] = {baum_rk4(), baum_rattle()};
  baum_mechanism *m = make_four_bar_of_points();
  for (int k = 0; k < 2 * SOLVER_COUNT; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = methods[k % 2];
    o.step = 2e-4;
    o.solver = SOLVERS[k / 2];
    if (o.solver == BAUM_SOLVER_BLOCK) {
      continue; /* refuses these pivots */
    }
    baum_simulation *run = create_run(m, &o);
    for (int i = 0; i < TIMES; i++) {
      check(baum_simulation_advance_to(run, DEPENDENT[i]));
    }
    baum_counters counters = counters_of(run);
    /* Both methods satisfy the constraints to rounding, which the small inertias amplify. */
    assert_true(counters.max_phi < 1e-12);
    assert_true(counters.max_phi_rate < 1e-10);
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* ---- a large mechanism ---- */

/* Two hinges 0.3 m apart join two bars. A pendulum that hangs far away makes the characteristic
 * length so large that this distance is small in comparison. The rows must be exchanged anyway. */
static void rows_are_exchanged_in_a_large_mechanism(void **state)
{
  (void)state;
  baum_mechanism *m = NULL;
  check(baum_mechanism_create(&m));
  static const double centers[3][3] = {{0.5, 0.0, 0.0}, {1.5, 0.0, 0.0}, {9.0, 0.0, -1.0}};
  static const double points[4][3] = {
    {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.3}, {9.0, 0.0, 0.0}};
  static const double axis[3] = {0.0, 1.0, 0.0};
  baum_body_id first = add_body(m, 0.1, centers[0]);
  baum_body_id second = add_body(m, 0.1, centers[1]);
  baum_body_id distant = add_body(m, 0.1, centers[2]);
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -9.81));
  add_hinge(m, BAUM_GROUND, first, points[0], axis);
  add_hinge(m, first, second, points[1], axis);
  add_hinge(m, first, second, points[2], axis);
  add_hinge(m, BAUM_GROUND, distant, points[3], axis);
  check(baum_mechanism_freeze(m));
  for (int k = 0; k < SOLVER_COUNT; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_rattle();
    o.step = STEP;
    o.solver = SOLVERS[k];
    baum_simulation *run = create_run(m, &o);
    check(baum_simulation_advance_to(run, 1.5));
    assert_true(counters_of(run).max_phi_rate < 1e-10); /* rounding; 1e-7 without the exchange */
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(bars_locked_by_two_pins_rotate_as_if_welded),
    cmocka_unit_test(index_3_methods_make_several_revolutions),
    cmocka_unit_test(a_restored_run_omits_the_same_rows_as_the_saved_run),
    cmocka_unit_test(rows_of_almost_points_are_exchanged_in_time),
    cmocka_unit_test(rows_are_exchanged_in_a_large_mechanism),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
