/* SPDX-License-Identifier: BSD-3-Clause */
/* Fixed bodies are welded to ground, either directly or through other bodies. The equations of
 * motion do not contain them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "dynamics/block_path.h"
#include "runs.h"
#include "simulate/run.h"

#define PI 3.14159265358979323846

enum { MOST = 300 };

/* ---- parts ---- */

static baum_body_id add_body(baum_mechanism *m, double x, double y)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.position[0] = x;
  def.position[1] = y;
  def.inertia = 0.1;
  check(baum_mechanism_add_planar_body(m, &def, &id));
  return id;
}

/* Two frames that carry a double pendulum. The first frame is welded to ground, and the second
 * frame to the first. */
enum { FRAMES = 2, BODIES = 4 };

typedef struct mounted {
  baum_mechanism *mechanism;
  baum_joint_id foot;
  baum_joint_id shoulder;
} mounted;

static mounted make_mounted(void)
{
  mounted out = {.mechanism = create_mechanism()};
  baum_mechanism *m = out.mechanism;
  baum_body_id low = add_body(m, 0.0, -1.0);
  baum_body_id high = add_body(m, 0.0, 0.0);
  baum_body_id arm = add_body(m, 0.5, 0.0);
  baum_body_id hand = add_body(m, 1.0, -0.5);
  out.foot = add_planar_weld(m, BAUM_GROUND, low, 0.3, -0.2);
  (void)add_planar_weld(m, low, high, 0.3, -0.2);
  out.shoulder = add_planar_pin(m, NULL, high, arm, 0.0, 0.0);
  (void)add_planar_pin(m, NULL, arm, hand, 1.0, 0.0);
  check(baum_mechanism_freeze(m));
  return out;
}

static baum_simulation_options fixed_step(void)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  return o;
}

static int omitted_bodies(const baum_simulation *run)
{
  const baum_i_block_path *path = run->workspace->motion;
  return path ? path->fixed_count : 0;
}

/* Starts a run with the solver of the whole system, which does not omit fixed bodies. */
static baum_simulation *start_whole(const baum_mechanism *m, baum_simulation_options o)
{
  o.solver = BAUM_SOLVER_KLU;
  return create_run(m, &o);
}

static void assert_same(const baum_simulation *run, const baum_simulation *want, double tolerance)
{
  const baum_mechanism *m = run->workspace->mechanism;
  for (int i = 0; i < m->nv; i++) {
    ASSERT_NEAR(baum_simulation_q(run)[i], baum_simulation_q(want)[i], 0.0, tolerance);
    ASSERT_NEAR(baum_simulation_v(run)[i], baum_simulation_v(want)[i], 0.0, tolerance);
  }
}

/* Compares a run of 0.5 s that must omit `count` fixed bodies with a run that omits none. */
static void assert_same_motion(const baum_mechanism *m, int count)
{
  baum_simulation_options o = fixed_step();
  baum_simulation *run = create_run(m, &o);
  baum_simulation *whole = start_whole(m, o);
  assert_int_equal(omitted_bodies(run), count);
  assert_int_equal(omitted_bodies(whole), 0);
  check(baum_simulation_advance_to(run, 0.5));
  check(baum_simulation_advance_to(whole, 0.5));
  assert_same(run, whole, 1e-11); /* rounding errors of 500 steps */
  baum_simulation_destroy(run);
  baum_simulation_destroy(whole);
}

/* ---- fixed bodies ---- */

static void welded_frames_are_fixed_and_the_motion_is_the_same(void **state)
{
  (void)state;
  mounted it = make_mounted();
  baum_simulation_options o = fixed_step();
  baum_simulation *run = create_run(it.mechanism, &o);
  assert_non_null(
    strstr(baum_simulation_explain(run), "blocks, 2 nodes, 1 coupling; 2 fixed bodies omitted;"));
  baum_simulation_destroy(run);
  assert_same_motion(it.mechanism, FRAMES);
  baum_mechanism_destroy(it.mechanism);
}

/* Two bodies and ground, joined by three pins, form a rigid triangle. No body is welded, so no body
 * is omitted. */
static void rigid_islands_are_not_omitted(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_body_id left = add_body(m, 0.5, 0.5);
  baum_body_id right = add_body(m, 1.5, 0.5);
  baum_body_id bob = add_body(m, 5.0, 0.0);
  add_planar_pin(m, NULL, BAUM_GROUND, left, 0.0, 0.0);
  add_planar_pin(m, NULL, BAUM_GROUND, right, 2.0, 0.0);
  add_planar_pin(m, NULL, left, right, 1.0, 1.0);
  add_planar_pin(m, NULL, BAUM_GROUND, bob, 4.0, 0.0);
  check(baum_mechanism_freeze(m));
  assert_same_motion(m, 0);
  baum_mechanism_destroy(m);
}

/* The order of the welds and of their bodies does not matter. */
static void chains_of_welds_are_fixed_in_any_order(void **state)
{
  (void)state;
  enum { CHAIN = 7 };
  for (int step = 1; step < CHAIN; step++) { /* CHAIN is prime, so any step joins all bodies */
    baum_mechanism *m = create_mechanism();
    baum_body_id bodies[CHAIN + 1] = {BAUM_GROUND};
    for (int k = 1; k <= CHAIN; k++) {
      bodies[k] = add_body(m, k, 0.1 * k);
    }
    for (int k = 1; k <= CHAIN; k++) {
      int at = 1 + k * step % CHAIN;
      (void)add_planar_weld(m, bodies[k % 2 ? at : at - 1], bodies[k % 2 ? at - 1 : at], 0.3, -0.2);
    }
    check(baum_mechanism_freeze(m));
    assert_int_equal(m->fixed_count, CHAIN);
    for (int i = 0; i < m->nq; i++) {
      ASSERT_NEAR(m->fixed_q[i], m->design_q[i], 0.0, 1e-14);
    }
    baum_mechanism_destroy(m);
  }
}

/* The block solver limits the number of joints of a body. This limit does not apply to fixed
 * bodies. */
static void a_fixed_body_may_have_any_number_of_joints(void **state)
{
  (void)state;
  enum { ARMS = 60 };
  baum_mechanism *m = create_mechanism();
  baum_body_id hub = add_body(m, 0.0, 0.0);
  add_planar_weld(m, BAUM_GROUND, hub, 0.3, -0.2);
  for (int k = 0; k < ARMS; k++) {
    double c = cos(2.0 * PI * k / ARMS);
    double s = sin(2.0 * PI * k / ARMS);
    add_planar_pin(m, NULL, hub, add_body(m, 1.5 * c, 1.5 * s), c, s);
  }
  check(baum_mechanism_freeze(m));
  baum_simulation_options o = fixed_step();
  baum_simulation *run = create_run(m, &o);
  assert_non_null(
    strstr(baum_simulation_explain(run), "blocks, 60 nodes, 0 couplings; 1 fixed body omitted;"));
  baum_simulation_destroy(run);
  assert_same_motion(m, 1);
  baum_mechanism_destroy(m);
}

static void a_mechanism_of_fixed_bodies_only_can_be_run(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  add_planar_weld(m, BAUM_GROUND, add_body(m, 1.0, 2.0), 0.3, -0.2);
  check(baum_mechanism_freeze(m));
  assert_same_motion(m, 1);
  baum_mechanism_destroy(m);
}

/* ---- bodies that are not fixed ---- */

static void a_body_held_by_a_driver_is_not_fixed(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_driver_def def = baum_driver_def_default();
  def.joint = add_planar_pin(m, NULL, BAUM_GROUND, add_body(m, 1.0, 0.0), 0.0, 0.0);
  def.value = 0.0;
  check(baum_mechanism_add_driver(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  assert_same_motion(m, 0);
  baum_mechanism_destroy(m);
}

/* Three parallel cranks, one of them on a frame, have one redundant row. The weld of the frame is
 * the last joint, so one of its rows could be omitted. Rows that fix a body must never be omitted,
 * so a row of a crank is omitted instead. */
static void rows_that_fix_a_body_are_kept(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_body_id coupler = add_body(m, 1.0, 1.0);
  baum_body_id frame = add_body(m, 2.0, -1.0);
  for (int k = 0; k < 3; k++) {
    baum_body_id crank = add_body(m, k, 0.5);
    add_planar_pin(m, NULL, k == 2 ? frame : BAUM_GROUND, crank, k, 0.0);
    add_planar_pin(m, NULL, crank, coupler, k, 1.0);
  }
  baum_joint_id foot = add_planar_weld(m, BAUM_GROUND, frame, 0.3, -0.2);
  check(baum_mechanism_freeze(m));
  baum_simulation_options o = fixed_step();
  o.formulation = BAUM_FORMULATION_PROJECTION;
  baum_simulation *run = create_run(m, &o);
  int32_t first = 0;
  check(baum_mechanism_rows(m, foot, &first, NULL));
  const unsigned char *omitted = run->workspace->rows.omitted + first;
  assert_int_equal(run->workspace->rows.count, 1);
  assert_int_equal(omitted[0] + omitted[1] + omitted[2], 0);
  assert_int_equal(omitted_bodies(run), 1);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* ---- fixed bodies do not move ---- */

static void fixed_bodies_do_not_move_by_a_digit(void **state)
{
  (void)state;
  mounted it = make_mounted();
  for (int32_t k = 0; baum_integrator_at(k); k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    if (!baum_integrator_has_fixed_step(integrator) && !BAUM_HAVE_SUNDIALS) {
      continue;
    }
    for (int f = 0; integrator->formulations[f] != BAUM_FORMULATION_DEFAULT; f++) {
      baum_simulation_options o = baum_simulation_options_default();
      o.integrator = integrator;
      o.formulation = integrator->formulations[f];
      o.step = baum_integrator_has_fixed_step(integrator) ? 1e-3 : (double)NAN;
      o.rtol = baum_integrator_has_fixed_step(integrator) ? (double)NAN : 1e-6;
      baum_simulation *run = create_run(it.mechanism, &o);
      double q[3 * FRAMES];
      memcpy(q, baum_simulation_q(run), sizeof q);
      check(baum_simulation_advance_to(run, 0.2));
      for (int i = 0; !integrator->solves_residuals && i < 3 * FRAMES; i++) {
        assert_true(baum_simulation_q(run)[i] == q[i]);
        assert_true(baum_simulation_v(run)[i] == 0.0);
      }
      baum_simulation_destroy(run);
    }
  }
  baum_mechanism_destroy(it.mechanism);
}

/* ---- results include fixed bodies ---- */

static void results_of_fixed_bodies_are_right(void **state)
{
  (void)state;
  mounted it = make_mounted();
  baum_simulation_options o = fixed_step();
  baum_simulation *run = create_run(it.mechanism, &o);
  baum_simulation *whole = start_whole(it.mechanism, o);
  const baum_channel channels[] = {baum_channel_of_joint(BAUM_JOINT_REACTION, it.foot),
                                   baum_channel_of_joint(BAUM_JOINT_REACTION, it.shoulder),
                                   baum_channel_of(BAUM_LAMBDA),
                                   baum_channel_of(BAUM_A),
                                   baum_channel_of(BAUM_PHI),
                                   baum_channel_of(BAUM_PHI_RATE)};
  double got[MOST];
  double want[MOST];
  int32_t width = baum_channels_width(it.mechanism, channels, 6);
  assert_true(width > 0 && width <= MOST);
  check(baum_simulation_advance_to(run, 0.3));
  check(baum_simulation_advance_to(whole, 0.3));
  check(baum_simulation_get(run, channels, 6, got));
  check(baum_simulation_get(whole, channels, 6, want));
  for (int i = 0; i < width; i++) {
    ASSERT_NEAR(got[i], want[i], 0.0, 1e-9); /* motions differ by 1e-12, and forces reach 1e2 N */
  }
  assert_true(want[1] > 10.0);                 /* shows that the foot carries a load */
  check(baum_simulation_advance_to(run, 0.4)); /* reading results must change nothing */
  check(baum_simulation_advance_to(whole, 0.4));
  assert_same(run, whole, 1e-11);
  baum_simulation_destroy(run);
  baum_simulation_destroy(whole);
  baum_mechanism_destroy(it.mechanism);
}

static void rows_between_fixed_bodies_stay_satisfied(void **state)
{
  (void)state;
  mounted it = make_mounted();
  baum_simulation_options o = fixed_step();
  baum_simulation *run = create_run(it.mechanism, &o);
  check(baum_simulation_advance_to(run, 0.2));
  for (int i = 0; i < 3 * FRAMES; i++) {
    /* Assembly leaves rounding errors of lengths that are about 1 m. */
    assert_true(fabs(run->workspace->phi[i]) < 1e-14);
    assert_true(run->workspace->phi_rate[i] == 0.0);
    assert_true(run->workspace->gamma[i] == 0.0);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(it.mechanism);
}

/* ---- states in which fixed bodies are elsewhere ---- */

static void displaced_frames_are_put_back(void **state)
{
  (void)state;
  mounted it = make_mounted();
  baum_simulation_options o = fixed_step();
  o.start = BAUM_START_AS_GIVEN;
  baum_simulation *run = create_run(it.mechanism, &o);
  double q[3 * BODIES];
  double v[3 * BODIES];
  memcpy(q, baum_simulation_q(run), sizeof q);
  memcpy(v, baum_simulation_v(run), sizeof v);
  double place = q[0];
  q[0] += 1e-3;
  v[1] = 1e-3;
  check(baum_simulation_set_state(run, 0.0, q, v));
  assert_true(baum_simulation_q(run)[0] == place);
  assert_true(baum_simulation_v(run)[1] == 0.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(it.mechanism);
}

static void a_displaced_design_is_put_in_place(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_planar_fixed_def def = baum_planar_fixed_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = add_body(m, 1.0, 0.0);
  def.point_a[0] = 1.001;
  def.point_a[1] = 0.0;
  def.point_b[0] = 0.0;
  def.point_b[1] = 0.0;
  def.angle = 0.3;
  check(baum_mechanism_add_planar_fixed(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  baum_simulation_options o = fixed_step();
  o.start = BAUM_START_AS_GIVEN;
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_advance_to(run, 0.5));
  ASSERT_NEAR(baum_simulation_q(run)[0], 1.001, 0.0, 1e-15);
  ASSERT_NEAR(baum_simulation_q(run)[2], 0.3, 0.0, 1e-15);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static void a_state_that_is_refused_changes_nothing(void **state)
{
  (void)state;
  mounted it = make_mounted();
  baum_simulation_options o = fixed_step();
  o.start = BAUM_START_EXACT;
  baum_simulation *run = create_run(it.mechanism, &o);
  double q[3 * BODIES];
  double v[3 * BODIES];
  memcpy(q, baum_simulation_q(run), sizeof q);
  memcpy(v, baum_simulation_v(run), sizeof v);
  q[0] += 1e-3;
  assert_int_equal(baum_simulation_set_state(run, 0.0, q, v), BAUM_ERR_INCONSISTENT);
  assert_int_equal(omitted_bodies(run), FRAMES);
  q[0] -= 1e-3;
  v[0] = 1e-3;
  assert_int_equal(baum_simulation_set_state(run, 0.0, q, v), BAUM_ERR_INCONSISTENT);
  /* The next step must not count the violations of the refused state. */
  check(baum_simulation_step(run, 1));
  baum_counters counters = counters_of(run);
  assert_true(counters.max_phi < 1e-9);
  assert_true(counters.max_phi_rate < 1e-9);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(it.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(welded_frames_are_fixed_and_the_motion_is_the_same),
    cmocka_unit_test(rigid_islands_are_not_omitted),
    cmocka_unit_test(chains_of_welds_are_fixed_in_any_order),
    cmocka_unit_test(a_fixed_body_may_have_any_number_of_joints),
    cmocka_unit_test(a_mechanism_of_fixed_bodies_only_can_be_run),
    cmocka_unit_test(a_body_held_by_a_driver_is_not_fixed),
    cmocka_unit_test(rows_that_fix_a_body_are_kept),
    cmocka_unit_test(fixed_bodies_do_not_move_by_a_digit),
    cmocka_unit_test(results_of_fixed_bodies_are_right),
    cmocka_unit_test(rows_between_fixed_bodies_stay_satisfied),
    cmocka_unit_test(displaced_frames_are_put_back),
    cmocka_unit_test(a_displaced_design_is_put_in_place),
    cmocka_unit_test(a_state_that_is_refused_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
