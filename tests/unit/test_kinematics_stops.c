/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests what the kinematics integrator refuses, and where it stops instead of jumping to another
 * branch. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "driven.h"
#include "integrator_run.h"
#include "message.h"
#include "methods.h"
#include "models.h"
#include "runs.h"

static const double PI = 3.14159265358979323846;

static baum_simulation_options kinematic_options(void)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  return o;
}

static baum_simulation *open_run(const baum_mechanism *mechanism)
{
  baum_simulation_options o = kinematic_options();
  return create_run(mechanism, &o);
}

static void close_run(baum_simulation *run, baum_mechanism *mechanism)
{
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

/* ---- lock-ups ---- */

typedef struct tally {
  double to_lock; /* [rad] */
  double error;   /* [m] */
} tally;

static void run_into_lock(const slider_crank *data, tally *worst)
{
  baum_mechanism *mechanism = slider_crank_make(data);
  baum_simulation *run = open_run(mechanism);
  double end = 10.0 / fabs(data->drive.rate);
  ASSERT_SAYS(baum_simulation_advance_to(run, end), BAUM_ERR_SINGULAR,
              "t = |kinematics: the mechanism locks up here: |satisfies|\"motor\" and the other "
              "constraints|especially joint ");
  double t = baum_simulation_time(run);
  double angle = data->drive.angle + data->drive.rate * t;
  double x[3];
  char when[32];
  slider_crank_motion(data, angle, x);
  worst->to_lock = fmax(worst->to_lock, slider_crank_to_lock(data, angle));
  worst->error = fmax(worst->error, fabs(baum_simulation_q(run)[SLIDER_X] - x[0]));
  (void)snprintf(when, sizeof when, "t = %.9g s: ", t);
  assert_non_null(strstr(baum_simulation_message(run), when));
  /* A second attempt also fails. The run can still go back in time. */
  ASSERT_SAYS(baum_simulation_advance_to(run, end), BAUM_ERR_SINGULAR, "locks up");
  assert_true(baum_simulation_time(run) >= t);
  assert_true(baum_simulation_advance_to(run, 0.0) >= BAUM_OK);
  slider_crank_motion(data, data->drive.angle, x);
  ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, 1e-13);
  close_run(run, mechanism);
}

/* The rod is 0.14 m long, the offset is 0.05 m, and the crank is 0.1 m long. For crank angles
 * between -64 and -116 degrees, no configuration exists. */
static void a_rod_that_is_too_short_locks_the_crank_from_any_start(void **state)
{
  (void)state;
  uint64_t seed = 5;
  tally worst = {0.0, 0.0};
  for (int start = 0; start < 200; start++) {
    slider_crank data = {.crank = 0.1, .rod = 0.14, .offset = 0.05};
    data.branch = start % 2 == 0 ? 1 : -1;
    do {
      data.drive.angle = uniform(&seed, -PI, PI);
    } while (fabs(data.offset - data.crank * sin(data.drive.angle)) > 0.97 * data.rod);
    data.drive.rate = pow(10.0, uniform(&seed, -2.0, 2.0)) * (start % 3 == 0 ? -1.0 : 1.0);
    run_into_lock(&data, &worst);
  }
  printf("stopped at most %.1e rad from the lock-up, %.1e m off the branch\n", worst.to_lock,
         worst.error);
  /* The crank rotates by 1e-10 rad in the shortest step. At a distance of 1e-9 rad from the
   * lock-up, the error of the slider is 1e4 times as large as the rounding error of the crank
   * angle. */
  assert_true(worst.to_lock <= 1e-6);
  assert_true(worst.error <= 1e-9);
}

/* The outputs before the lock-up must be computed, although the last output time is after the
 * lock-up. */
static void outputs_before_the_lock_up_are_computed(void **state)
{
  (void)state;
  slider_crank data = {0.1, 0.14, 0.05, 1, {.angle = 0.0, .rate = -1.0}};
  double lock = slider_crank_to_lock(&data, 0.0);
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation *run = open_run(mechanism);
  double times[4] = {0.5 * lock, 0.999 * lock, lock - 1e-6, 1.5 * lock};
  double q[4][SLIDER_NV];
  const baum_channel channel = baum_channel_of(BAUM_Q);
  int64_t done = 0;
  ASSERT_SAYS(baum_simulation_sample(run, times, 4, &channel, 1, q[0], &done), BAUM_ERR_SINGULAR,
              "locks up");
  assert_int_equal(done, 3);
  for (int k = 0; k < 3; k++) {
    double x[3];
    slider_crank_motion(&data, -times[k], x);
    /* At the last of these times, the crank is 1e-6 rad from the singular configuration. There, the
     * error of x is 1e3 times as large as the rounding error of the crank angle. */
    ASSERT_NEAR(q[k][SLIDER_X], x[0], 0.0, 1e-12);
  }
  close_run(run, mechanism);
}

/* A flat parallelogram can continue as an antiparallelogram. In the flat configuration J is
 * singular, and the driver does not determine the motion. The run must therefore stop before this
 * configuration. */
static void a_run_stops_where_branches_cross(void **state)
{
  (void)state;
  for (int sign = -1; sign <= 1; sign += 2) {
    const drive motor = {.angle = 1.0, .rate = sign * 2.0};
    baum_mechanism *mechanism = parallelogram_make(&motor);
    baum_simulation *run = open_run(mechanism);
    double flat = (sign > 0 ? PI - 1.0 : 1.0) / 2.0;
    ASSERT_SAYS(baum_simulation_advance_to(run, 10.0), BAUM_ERR_SINGULAR,
                "kinematics: the configuration is singular here|in more than one way");
    assert_true(baum_simulation_time(run) < flat);
    ASSERT_NEAR(baum_simulation_time(run), flat, 0.0, 1e-6);
    ASSERT_NEAR(baum_simulation_q(run)[2], 0.0, 0.0, 1e-6);
    close_run(run, mechanism);
  }
}

/* Rows 0 and 2 are equal until 0.5 s. Until then, one of them is omitted. Later they contradict
 * each other. */
static int diverging_rows(double t, const double *q, double *out, void *user)
{
  (void)user;
  out[0] = q[0] - t;
  out[1] = q[1];
  out[2] = q[0] - t + (t > 0.5 ? (t - 0.5) * (t - 0.5) : 0.0);
  return 0;
}

static void omitted_rows_that_are_violated_stop_the_run(void **state)
{
  (void)state;
  baum_body_id point;
  baum_planar_particle_def particle = baum_planar_particle_def_default();
  baum_user_constraint_def rows = baum_user_constraint_def_default();
  baum_mechanism *mechanism = create_mechanism();
  assert_int_equal(baum_mechanism_set_characteristic_length(mechanism, 1.0), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_particle(mechanism, &particle, &point), BAUM_OK);
  rows.name = "rows";
  rows.bodies = &point;
  rows.body_count = 1;
  rows.row_count = 3;
  rows.phi = diverging_rows;
  assert_int_equal(baum_mechanism_add_user_constraint(mechanism, &rows, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  baum_simulation *run = open_run(mechanism);
  ASSERT_SAYS(baum_simulation_advance_to(run, 2.0), BAUM_ERR_CONVERGENCE,
              "kinematics: a row of |\"rows\" that was omitted as redundant no longer");
  /* The run tolerates violations of up to 1e-6. After 0.5 s the violation is (t - 0.5)^2, which
   * reaches this limit at 0.501 s. */
  ASSERT_NEAR(baum_simulation_time(run), 0.5 + 1e-3, 0.0, 1e-6);
  close_run(run, mechanism);
}

/* ---- laws that fail ---- */

typedef struct fault {
  double after; /* [s] */
  int answer;   /* 0: the law sets NaN; 9: the law jumps */
  int64_t calls;
} fault;

static int faulty(double t, double s[3], void *user)
{
  fault *f = user;
  bool fails = t > f->after;
  f->calls++;
  s[0] = 0.3 + t + (fails && f->answer == 9 ? 0.6 : 0.0);
  s[1] = fails && f->answer == 0 ? (double)NAN : 1.0;
  s[2] = 0.0;
  return fails && f->answer != 9 ? f->answer : 0;
}

static void run_with_faulty_law(int answer, baum_status want, const char *message)
{
  fault f = {.after = (double)INFINITY, .answer = answer};
  slider_crank data = {0.1, 0.16, 0.05, 1, {.angle = 0.3, .law = faulty, .user = &f}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation *run = open_run(mechanism);
  double x[3];
  f.after = 0.7;
  ASSERT_SAYS(baum_simulation_advance_to(run, 2.0), want, message);
  assert_non_null(strstr(baum_simulation_message(run), "t = 0."));
  double t = baum_simulation_time(run);
  assert_true(t > (answer < 0 ? 0.2 : 0.699) && t <= 0.7);
  slider_crank_motion(&data, 0.3 + t, x);
  ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, 1e-13);
  ASSERT_SAYS(baum_simulation_advance_to(run, 2.0), want, message);
  f.after = (double)INFINITY;
  assert_int_equal(baum_simulation_advance_to(run, 2.0), BAUM_OK);
  slider_crank_motion(&data, 2.3, x);
  ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, 1e-13);
  close_run(run, mechanism);
}

static void a_law_that_fails_leaves_the_last_good_step(void **state)
{
  (void)state;
  run_with_faulty_law(-3, BAUM_ERR_CALLBACK, "\"motor\": law() returned -3 (stop)");
  run_with_faulty_law(4, BAUM_ERR_CALLBACK, "\"motor\": law() returned 4 (retry)");
  run_with_faulty_law(0, BAUM_ERR_NOT_FINITE, "\"motor\": law() gave nan for the rate");
}

static void a_law_that_jumps_is_an_error(void **state)
{
  (void)state;
  run_with_faulty_law(
    9, BAUM_ERR_CONVERGENCE,
    "t = 0.7|kinematics: no configuration is found nearby|the law of |\"motor\" may jump here");
}

static void a_law_that_returns_stop_is_not_called_again(void **state)
{
  (void)state;
  fault f = {.after = (double)INFINITY, .answer = -1};
  slider_crank data = {0.1, 0.16, 0.05, 1, {.angle = 0.3, .law = faulty, .user = &f}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation *run = open_run(mechanism);
  assert_int_equal(baum_simulation_advance_to(run, 0.5), BAUM_OK);
  f.after = -1.0;
  f.calls = 0;
  assert_int_equal(baum_simulation_step(run, 1), BAUM_ERR_CALLBACK);
  assert_true(f.calls <= 3); /* one call in the step, and the others for the present state */
  close_run(run, mechanism);
}

/* ---- runs that are not created ---- */

static void degrees_of_freedom_are_refused_with_their_number_and_advice(void **state)
{
  (void)state;
  baum_simulation_options o = kinematic_options();
  model scene;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = false}, &scene),
                   BAUM_OK);
  check_run_refused(scene.mechanism, &o, BAUM_ERR_UNSUPPORTED,
                    "kinematics: 1 degree of freedom is left|add a driver for each|such as rk8");
  model_destroy(&scene);
  assert_int_equal(model_chain_3(&scene), BAUM_OK);
  check_run_refused(scene.mechanism, &o, BAUM_ERR_UNSUPPORTED,
                    "kinematics: 3 degrees of freedom are left");
  model_destroy(&scene);
}

static void settings_of_other_integrators_are_refused(void **state)
{
  (void)state;
  const drive motor = {.angle = 1.0, .rate = 2.0};
  baum_mechanism *mechanism = four_bar_make(&motor);
  baum_simulation_options o = kinematic_options();
  o.step = 1e-3;
  check_run_refused(mechanism, &o, BAUM_ERR_ARGUMENT,
                    "step is 0.001 s, but kinematics solves|give neither step nor tolerance");
  o = kinematic_options();
  o.rtol = 1e-6;
  check_run_refused(mechanism, &o, BAUM_ERR_ARGUMENT, "rtol is 1e-06, but kinematics solves");
  o = kinematic_options();
  o.atol = 0.0;
  check_run_refused(mechanism, &o, BAUM_ERR_ARGUMENT, "atol is 0, but kinematics solves");
  o = kinematic_options();
  o.max_step = -1.0;
  check_run_refused(mechanism, &o, BAUM_ERR_ARGUMENT, "max_step is -1 s, must be > 0");
  o = kinematic_options();
  o.gains = baum_gains_auto();
  check_run_refused(mechanism, &o, BAUM_ERR_ARGUMENT,
                    "gains are given, but the integrator kinematics has none");
  for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
    o = kinematic_options();
    o.formulation = (baum_formulation)f;
    assert_false(baum_integrator_offers(o.integrator, o.formulation));
    check_run_refused(
      mechanism, &o, BAUM_ERR_UNSUPPORTED,
      "kinematics does not offer the formulation |it offers none, because no degree of "
      "freedom is left");
  }
  baum_mechanism_destroy(mechanism);
}

/* A start that is 0.01 m off the constraints is corrected. A start that is 1 m off is refused. */
static void a_start_off_the_constraints_is_corrected_or_refused(void **state)
{
  (void)state;
  slider_crank data = {0.1, 0.16, 0.05, 1, {.angle = 0.3, .rate = 1.0}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  for (int far = 0; far < 2; far++) {
    baum_simulation_options o = kinematic_options();
    double q[SLIDER_NV];
    double v[SLIDER_NV] = {0.0};
    double x[3];
    o.start = BAUM_START_AS_GIVEN;
    baum_simulation *run = create_run(mechanism, &o);
    memcpy(q, baum_simulation_q(run), sizeof q);
    q[SLIDER_X] += far ? 1.0 : 0.01;
    baum_status status = baum_simulation_set_state(run, 0.0, q, v);
    if (far) {
      ASSERT_SAYS(status, BAUM_ERR_INCONSISTENT,
                  "kinematics: no configuration that satisfies the constraints is found near");
    } else {
      assert_int_equal(status, BAUM_OK);
    }
    assert_true(baum_simulation_advance_to(run, 1.0) >= BAUM_OK);
    slider_crank_motion(&data, 1.3, x);
    ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, 1e-13);
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(mechanism);
}

static void a_restart_that_fails_changes_nothing(void **state)
{
  (void)state;
  fault f = {.after = (double)INFINITY, .answer = 4};
  slider_crank data = {0.1, 0.16, 0.05, 1, {.angle = 0.3, .law = faulty, .user = &f}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation_options o = kinematic_options();
  double q[SLIDER_NV];
  double v[SLIDER_NV];
  double x[3];
  o.start = BAUM_START_AS_GIVEN;
  baum_simulation *run = create_run(mechanism, &o);
  memcpy(q, baum_simulation_q(run), sizeof q);
  memcpy(v, baum_simulation_v(run), sizeof v);
  assert_int_equal(baum_simulation_advance_to(run, 0.5), BAUM_OK);
  f.after = -1.0;
  ASSERT_SAYS(baum_simulation_set_state(run, 0.0, q, v), BAUM_ERR_CALLBACK, "law() returned 4");
  assert_true(baum_simulation_time(run) == 0.5);
  f.after = (double)INFINITY;
  assert_int_equal(baum_simulation_advance_to(run, 1.0), BAUM_OK);
  slider_crank_motion(&data, 1.3, x);
  ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, 1e-13);
  close_run(run, mechanism);
}

/* The run reaches its flat configuration at 0.8 s. A state in this configuration satisfies the
 * constraints. It is refused, because two branches continue from it. */
static void a_singular_state_cannot_be_set(void **state)
{
  (void)state;
  const drive motor = {.angle = PI - 0.8, .rate = 1.0};
  const drive flat = {.angle = PI};
  double q[PARALLELOGRAM_NV];
  double v[PARALLELOGRAM_NV];
  baum_mechanism *mechanism = parallelogram_make(&motor);
  baum_mechanism *there = parallelogram_make(&flat);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(there, &w), BAUM_OK);
  assert_int_equal(baum_workspace_design(w, q, v), BAUM_OK);
  memset(v, 0, sizeof v);
  baum_workspace_destroy(w);
  baum_simulation_options o = kinematic_options();
  o.start = BAUM_START_AS_GIVEN;
  baum_simulation *run = create_run(mechanism, &o);
  ASSERT_SAYS(baum_simulation_set_state(run, 0.8, q, v), BAUM_ERR_SINGULAR,
              "t = 0.8 s: kinematics: the start configuration is singular");
  assert_true(baum_simulation_advance_to(run, 0.5) >= BAUM_OK);
  ASSERT_NEAR(baum_simulation_q(run)[5], PI - 0.3, 0.0, 1e-12);
  close_run(run, mechanism);
  baum_mechanism_destroy(there);
}

static void a_singular_start_is_refused(void **state)
{
  (void)state;
  const drive motor = {.angle = 0.0, .rate = 1.0};
  baum_mechanism *mechanism = parallelogram_make(&motor);
  baum_simulation_options o = kinematic_options();
  check_run_refused(mechanism, &o, BAUM_ERR_SINGULAR, "t = 0 s|singular");
  baum_mechanism_destroy(mechanism);
}

/* ---- explanations and advice ---- */

static void kinematics_is_explained_and_other_integrators_suggest_it(void **state)
{
  (void)state;
  const drive motor = {.angle = 1.0, .rate = 2.0};
  baum_mechanism *mechanism = four_bar_make(&motor);
  baum_simulation *run = open_run(mechanism);
  const char *text = baum_simulation_explain(run);
  assert_non_null(strstr(text, "integrator    kinematics: Phi(q, t) = 0 is solved to rounding"));
  assert_non_null(strstr(text, "no degree of freedom is left"));
  assert_null(strstr(text, "formulation"));
  assert_null(strstr(text, "nan"));
  baum_simulation_destroy(run);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  run = create_run(mechanism, &o);
  text = baum_simulation_explain(run);
  assert_non_null(strstr(text, "kinematics gives it exactly"));
  assert_non_null(strstr(text, "integrator    rk4"));
  close_run(run, mechanism);
}

/* Two fixed pins hold the bar, and no driver moves it. */
static void a_mechanism_that_cannot_move_is_reported(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_body_def bar = baum_planar_body_def_default();
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.body_a = BAUM_GROUND;
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &bar, &pin.body_b), BAUM_OK);
  for (int k = 0; k < 2; k++) {
    pin.point[0] = k;
    pin.point[1] = 0.0;
    assert_int_equal(baum_mechanism_add_planar_revolute(mechanism, &pin, NULL), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  baum_mobility mobility;
  assert_int_equal(baum_mechanism_mobility(mechanism, &mobility, sizeof mobility), BAUM_OK);
  assert_non_null(
    strstr(mobility.text, "4 constraint rows. The mechanism cannot move. 1 redundant"));
  baum_simulation *run = open_run(mechanism);
  const char *text = baum_simulation_explain(run);
  assert_non_null(strstr(text, "no driver moves the mechanism: it stays at rest"));
  assert_null(strstr(text, "follows from the drivers"));
  close_run(run, mechanism);
}

/* Configurations are available at both ends of the last step and inside it. Other times are
 * refused. */
static void configurations_are_returned_inside_the_last_step_only(void **state)
{
  (void)state;
  slider_crank data = {0.1, 0.16, 0.05, 1, {.angle = 0.3, .rate = 1.0}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  integrator_setup setup =
    integrator_setup_make(mechanism, baum_kinematics(), BAUM_FORMULATION_DEFAULT);
  integrator_run run;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  double begin = 0.0;
  for (int k = 0; k < 3; k++) {
    begin = run.state.t;
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
  }
  double h = run.state.t - begin;
  for (int k = 0; k <= 4; k++) {
    double t = k == 4 ? run.state.t : begin + 0.25 * k * h;
    double x[3];
    assert_int_equal(baum_kinematics()->interpolate(run.self, &run.problem, t, run.q, run.v),
                     BAUM_OK);
    slider_crank_motion(&data, 0.3 + t, x);
    ASSERT_NEAR(run.q[SLIDER_X], x[0], 0.0, 1e-14);
    ASSERT_NEAR(run.v[SLIDER_X], x[1], 0.0, 1e-14);
  }
  for (int side = 0; side < 2; side++) {
    double t = side == 0 ? begin - 0.1 * h : run.state.t + 0.1 * h;
    ASSERT_SAYS(baum_kinematics()->interpolate(run.self, &run.problem, t, run.q, run.v),
                BAUM_ERR_INTEGRATOR, "is not inside the last step of kinematics");
  }
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_rod_that_is_too_short_locks_the_crank_from_any_start),
    cmocka_unit_test(outputs_before_the_lock_up_are_computed),
    cmocka_unit_test(a_run_stops_where_branches_cross),
    cmocka_unit_test(omitted_rows_that_are_violated_stop_the_run),
    cmocka_unit_test(a_law_that_fails_leaves_the_last_good_step),
    cmocka_unit_test(a_law_that_jumps_is_an_error),
    cmocka_unit_test(a_law_that_returns_stop_is_not_called_again),
    cmocka_unit_test(degrees_of_freedom_are_refused_with_their_number_and_advice),
    cmocka_unit_test(settings_of_other_integrators_are_refused),
    cmocka_unit_test(a_start_off_the_constraints_is_corrected_or_refused),
    cmocka_unit_test(a_restart_that_fails_changes_nothing),
    cmocka_unit_test(a_singular_state_cannot_be_set),
    cmocka_unit_test(a_singular_start_is_refused),
    cmocka_unit_test(kinematics_is_explained_and_other_integrators_suggest_it),
    cmocka_unit_test(a_mechanism_that_cannot_move_is_reported),
    cmocka_unit_test(configurations_are_returned_inside_the_last_step_only),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
