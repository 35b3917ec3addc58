/* SPDX-License-Identifier: BSD-3-Clause */
/* Some allocations are not reached by test_allocation.c. This test makes them fail: those for fixed
 * bodies, for dense mass matrices with rows, for break times, and for the solver that is created at
 * a singular configuration. */
#define _GNU_SOURCE /* needed by heap.h */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "check.h"
#include "failing_heap.h"
#include "saddle_solver.h"

/* ---- a pendulum on a fixed frame, and three user coordinates with one constraint row ---- */

static int three_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  out[0] = out[4] = out[8] = 2.0;
  out[1] = out[3] = 1.0;
  return 0;
}

static int three_force(double t, const double *q, const double *v, const double *inputs,
                       double *out, void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = 1.0;
  return 0;
}

static int first_two_are_one(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[0] - q[1];
  return 0;
}

static baum_status add_frame(baum_mechanism *m)
{
  baum_body_id ids[2] = {{0, 0}, {0, 0}};
  baum_status status = BAUM_OK;
  for (int k = 0; k < 2 && status == BAUM_OK; k++) {
    baum_planar_body_def body = baum_planar_body_def_default();
    body.position[0] = k;
    status = baum_mechanism_add_planar_body(m, &body, &ids[k]);
  }
  if (status == BAUM_OK) {
    baum_planar_fixed_def weld = baum_planar_fixed_def_default();
    weld.body_a = BAUM_GROUND;
    weld.body_b = ids[0];
    weld.point[0] = weld.point[1] = 0.0;
    status = baum_mechanism_add_planar_fixed(m, &weld, NULL);
  }
  if (status == BAUM_OK) {
    baum_planar_revolute_def pin = baum_planar_revolute_def_default();
    pin.body_a = ids[0];
    pin.body_b = ids[1];
    pin.point[0] = pin.point[1] = 0.0;
    status = baum_mechanism_add_planar_revolute(m, &pin, NULL);
  }
  return status;
}

static baum_status add_three(baum_mechanism *m)
{
  baum_coordinates_def three = baum_coordinates_def_default();
  baum_body_id id;
  three.size = 3;
  three.mass = three_mass;
  three.force = three_force;
  three.constant_mass = true;
  baum_status status = baum_mechanism_add_coordinates(m, &three, &id);
  if (status == BAUM_OK) {
    baum_user_constraint_def row = baum_user_constraint_def_default();
    row.bodies = &id;
    row.body_count = 1;
    row.row_count = 1;
    row.phi = first_two_are_one;
    status = baum_mechanism_add_user_constraint(m, &row, NULL);
  }
  return status;
}

static baum_status build(baum_mechanism *m)
{
  static const double times[3] = {0.3, 0.1, 0.2};
  baum_status status = add_frame(m);
  if (status == BAUM_OK) {
    status = add_three(m);
  }
  if (status == BAUM_OK) {
    int32_t count = 0;
    status = baum_mechanism_add_break_times(m, times, 3);
    (void)baum_mechanism_break_times(m, &count);
    assert_int_equal(count, status == BAUM_OK ? 3 : 0);
  }
  return status == BAUM_OK ? baum_mechanism_freeze(m) : status;
}

static baum_status run(const baum_mechanism *m)
{
  baum_simulation_options o = baum_simulation_options_default();
  baum_simulation *s = NULL;
  o.integrator = baum_rk4();
  o.step = 1e-3;
  baum_status status = baum_simulation_create(m, &o, &s);
  if (status == BAUM_OK) {
    assert_non_null(strstr(baum_simulation_explain(s), "1 fixed body omitted"));
    status = baum_simulation_step(s, 3);
  }
  baum_simulation_destroy(s);
  return status;
}

static baum_status build_and_run(void *context)
{
  (void)context;
  baum_mechanism *m = NULL;
  baum_status status = baum_mechanism_create(&m);
  if (status == BAUM_OK) {
    status = build(m);
  }
  if (status == BAUM_OK) {
    status = run(m);
  }
  baum_mechanism_destroy(m);
  return status;
}

static void fixed_bodies_survive_every_failing_allocation(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  fail_every_allocation(build_and_run, NULL);
}

/* ---- at a singular configuration ---- */

static baum_status solve_singular(void *context)
{
  saddle *system = context;
  baum_i_kkt *kkt = NULL;
  baum_status status = baum_i_kkt_create(&system->structure, BAUM_I_KKT_AUTO, &kkt);
  if (status == BAUM_OK) {
    status = factor(kkt, system);
  }
  if (status == BAUM_OK) {
    status = solve(kkt, system);
    assert_string_equal(baum_i_kkt_backend(kkt), "qr");
  }
  baum_i_kkt_destroy(kkt);
  return status;
}

static void solving_at_a_singular_configuration_survives_every_failing_allocation(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  saddle system = saddle_make_four_bar(1);
  saddle_pose_four_bar(&system, 0.0);
  saddle_make_consistent(&system, 17);
  fail_every_allocation(solve_singular, &system);
  saddle_free(&system);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(fixed_bodies_survive_every_failing_allocation),
    cmocka_unit_test(solving_at_a_singular_configuration_survives_every_failing_allocation),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
