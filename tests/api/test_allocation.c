/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps and evaluations must not allocate memory. Every other call must return BAUM_ERR_MEMORY if
 * any of its allocations fails. Allocations of SuiteSparse and SUNDIALS are included, except those
 * that heap.h excludes. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "every_element.h"
#include "failing_heap.h"
#include "runs.h"
#include "step_mode.h"

#if BAUM_HAVE_SUNDIALS
#include <sundials/sundials_config.h>
#else
#define SUNDIALS_VERSION_MAJOR 0
#endif

/* ---- what the tests run ---- */

enum { CHANNELS = 14, WIDTH_MAX = 560, SAMPLES = 7 };

static bool is_of_a_body(baum_quantity quantity)
{
  return quantity == BAUM_BODY_POSE || quantity == BAUM_BODY_VELOCITY ||
         quantity == BAUM_BODY_ACCELERATION;
}

/* Makes one channel of every quantity. */
static int make_channels(const every_element *parts, baum_channel channels[CHANNELS])
{
  for (int k = 0; k < CHANNELS; k++) {
    baum_quantity quantity = (baum_quantity)(k + 1);
    channels[k] = baum_channel_of(quantity);
    if (is_of_a_body(quantity)) {
      channels[k].body = parts->tool;
    } else if (quantity == BAUM_JOINT_REACTION || quantity == BAUM_JOINT_COORDINATE) {
      channels[k].joint = parts->pin;
    } else if (quantity == BAUM_DRIVE_EFFORT) {
      channels[k].joint = parts->motor;
    }
  }
  int width = baum_channels_width(parts->mechanism, channels, CHANNELS);
  assert_in_range(width, 1, WIDTH_MAX);
  return width;
}

static baum_simulation_options options_for(step_mode mode, baum_formulation formulation)
{
  double rtol = formulation == BAUM_FORMULATION_INDEX3 ? 1e-4 : 1e-6;
  baum_simulation_options o = step_mode_options(mode, 1e-3, rtol);
  o.formulation = formulation;
  o.energy_account = true;
  return o;
}

static bool reached_the_end(baum_status status)
{
  return status == BAUM_OK || status == BAUM_WARNED;
}

/* Finds combination k of an integrator, a kind of step and a formulation in this build. Returns
 * false if there are fewer combinations. */
static bool find_pair(int k, baum_simulation_options *o)
{
  for (int i = 0; step_mode_at(i).integrator; i++) {
    step_mode mode = step_mode_at(i);
    if (!every_element_suits(mode.integrator)) {
      continue;
    }
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      if (baum_integrator_offers(mode.integrator, (baum_formulation)f) && k-- == 0) {
        *o = options_for(mode, (baum_formulation)f);
        return true;
      }
    }
  }
  return false;
}

/* ---- steps allocate nothing ---- */

/* Changes an input, and replaces the law of the motor by a quadratic polynomial that continues this
 * law. */
static baum_status act(baum_simulation *run, const every_element *parts)
{
  double t = baum_simulation_time(run);
  double throttle = baum_simulation_input(run, parts->throttle);
  baum_status status = baum_simulation_set_input(run, parts->throttle, 0.9 * throttle);
  return status == BAUM_OK ? baum_simulation_set_driver(
                               run, parts->motor, 0.5 + t * (2.0 + 0.15 * t), 2.0 + 0.3 * t, 0.3)
                           : status;
}

static void run_a_while(baum_simulation *run, const every_element *parts,
                        const baum_channel *channels, double *rows)
{
  assert_int_equal(act(run, parts), BAUM_OK);
  assert_true(reached_the_end(baum_simulation_step(run, 10)));
  double t = baum_simulation_time(run) + 0.0105;
  assert_true(reached_the_end(baum_simulation_advance_to(run, t)));
  double times[SAMPLES];
  for (int k = 0; k < SAMPLES; k++) {
    times[k] = t + 0.0213 * (k + 1);
  }
  assert_true(
    reached_the_end(baum_simulation_sample(run, times, SAMPLES, channels, CHANNELS, rows, NULL)));
  assert_int_equal(baum_simulation_get(run, channels, CHANNELS, rows), BAUM_OK);
}

static void check_steady(const every_element *parts, const baum_simulation_options *o)
{
  static double rows[SAMPLES * WIDTH_MAX];
  baum_channel channels[CHANNELS];
  (void)make_channels(parts, channels);
  baum_simulation *run = create_run(parts->mechanism, o);
  run_a_while(run, parts, channels, rows);
  int64_t full = counters_of(run).full_factorizations;
  heap_watch();
  run_a_while(run, parts, channels, rows);
  run_a_while(run, parts, channels, rows);
  baum_counters counters = counters_of(run);
  long allocations = heap_stop();
  if (allocations != 0 || counters.full_factorizations != full) {
    fail_msg("%s, %s: %ld allocations, %lld full factorizations",
             baum_integrator_name(o->integrator), baum_formulation_name(o->formulation),
             allocations, (long long)(counters.full_factorizations - full));
  }
  baum_simulation_destroy(run);
}

static void steps_samples_and_channels_allocate_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  every_element parts = every_element_make(NULL);
  baum_simulation_options o;
  for (int k = 0; find_pair(k, &o); k++) {
    check_steady(&parts, &o);
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* An input jumps in about every third step. Some methods restart at a jump. */
static void jumps_of_inputs_allocate_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  enum { JUMPS = 50 };
  double times[JUMPS];
  double values[JUMPS];
  for (int k = 0; k < JUMPS; k++) {
    times[k] = 3.3e-3 * (k + 1);
    values[k] = 1.0 - 0.1 * (k % 2);
  }
  every_element parts = every_element_make(NULL);
  baum_simulation_options o;
  for (int k = 0; find_pair(k, &o); k++) {
    baum_simulation *run = create_run(parts.mechanism, &o);
    assert_int_equal(baum_simulation_schedule_input(run, parts.throttle, times, values, JUMPS),
                     BAUM_OK);
    assert_true(reached_the_end(baum_simulation_advance_to(run, times[4])));
    int64_t full = counters_of(run).full_factorizations;
    heap_watch();
    assert_true(reached_the_end(baum_simulation_step(run, 10)));
    assert_true(reached_the_end(baum_simulation_advance_to(run, times[9])));
    long allocations = heap_stop();
    assert_true(baum_simulation_input(run, parts.throttle) == values[9]);
    if (allocations != 0 || counters_of(run).full_factorizations != full) {
      fail_msg("%s, %s: %ld allocations", baum_integrator_name(o.integrator),
               baum_formulation_name(o.formulation), allocations);
    }
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* A state at which functions of the workspace are evaluated. */
typedef struct point {
  double q[EVERY_NQ];
  double v[EVERY_NV];
  double y[EVERY_NQ + EVERY_NV + 2 * EVERY_NC];
  double out[EVERY_NV * EVERY_NV];
} point;

static baum_status evaluate(baum_workspace *w, const every_element *parts, point *p)
{
  const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX1, .alpha = 5.0, .beta = 5.0};
  const baum_dae ggl = {.index = BAUM_RESIDUAL_GGL};
  double energy[2];
  const baum_status all[] = {
    baum_workspace_phi(w, 0.0, p->q, p->out),
    baum_workspace_jacobian(w, 0.0, p->q, p->out),
    baum_workspace_nu(w, 0.0, p->q, p->out),
    baum_workspace_mass(w, 0.0, p->q, p->out),
    baum_workspace_gamma(w, 0.0, p->q, p->v, p->out),
    baum_workspace_force(w, 0.0, p->q, p->v, p->out),
    baum_workspace_energy(w, 0.0, p->q, p->v, &energy[0], &energy[1]),
    baum_workspace_acceleration(w, 0.0, p->q, p->v, 5.0, 5.0, p->out, NULL),
    baum_workspace_acceleration(w, 0.0, p->q, p->v, 0.0, 0.0, NULL, p->out),
    baum_workspace_reaction(w, 0.0, p->q, p->out, parts->rod, p->out + EVERY_NC),
    baum_workspace_residual(w, &dae, 0.0, p->y, p->y, p->out),
    baum_workspace_residual(w, &ggl, 0.0, p->y, p->y, p->out),
  };
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
    if (all[k] != BAUM_OK) {
      return all[k];
    }
  }
  return BAUM_OK;
}

static void start_point(baum_workspace *w, point *p)
{
  memset(p, 0, sizeof *p);
  assert_int_equal(baum_workspace_design(w, p->q, NULL), BAUM_OK);
  memcpy(p->y, p->q, sizeof p->q);
}

static void evaluations_allocate_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  every_element parts = every_element_make(NULL);
  baum_workspace *w = NULL;
  point p;
  assert_int_equal(baum_workspace_create(parts.mechanism, &w), BAUM_OK);
  start_point(w, &p);
  assert_int_equal(evaluate(w, &parts, &p), BAUM_OK);
  heap_watch();
  assert_int_equal(evaluate(w, &parts, &p), BAUM_OK);
  assert_int_equal(heap_stop(), 0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- every allocation may fail ---- */

static void *const GARBAGE = (void *)(uintptr_t)16;

static baum_status build_everything(void *context)
{
  (void)context;
  every_element parts = {.fault = NULL};
  baum_mechanism *copy = GARBAGE;
  baum_mobility mobility;
  baum_report report;
  baum_status status = every_element_build(&parts);
  if (status == BAUM_OK) {
    status = baum_mechanism_freeze(parts.mechanism);
    assert_int_equal(baum_mechanism_is_frozen(parts.mechanism), status == BAUM_OK);
  }
  if (status == BAUM_OK) {
    status = baum_mechanism_copy(parts.mechanism, &copy);
    assert_true(status == BAUM_OK || copy == NULL);
  }
  copy = copy == GARBAGE ? NULL : copy;
  if (status == BAUM_OK) {
    status = baum_mechanism_freeze(copy);
  }
  if (status == BAUM_OK) {
    status = baum_mechanism_mobility(copy, &mobility, sizeof mobility);
  }
  if (status == BAUM_OK) {
    assert_int_equal(mobility.degrees_of_freedom, EVERY_NV - EVERY_NC);
    status = baum_mechanism_report(copy, &report, sizeof report);
  }
  if (status == BAUM_OK) {
    assert_int_equal(report.degrees_of_freedom, EVERY_NV - EVERY_NC);
    status = baum_mechanism_check_derivatives(parts.mechanism);
  }
  baum_mechanism_destroy(parts.mechanism);
  baum_mechanism_destroy(copy);
  return status;
}

static void building_survives_every_failing_allocation(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  fail_every_allocation(build_everything, NULL);
}

/* If there is no memory for a new definition, the old one must stay. */
static baum_status replace_definitions(void *context)
{
  every_element *parts = context;
  baum_status status = BAUM_OK;
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    any_def def;
    any_def got;
    element_kinds[k].good(parts, &def);
    any_id id = every_element_id(parts, &element_kinds[k]);
    baum_status set = element_kinds[k].set(parts->mechanism, id, &def);
    assert_int_equal(element_kinds[k].get(parts->mechanism, id, &got, sizeof got), BAUM_OK);
    assert_string_equal(got.head.name, def.head.name);
    status = status == BAUM_OK ? set : status;
  }
  return status;
}

static void replacing_survives_every_failing_allocation(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  fail_every_allocation(replace_definitions, &parts);
  baum_mechanism_destroy(parts.mechanism);
}

/* Makes two calls, as a program would: the first one gets the sizes, and the second one gets all
 * three arrays. */
static baum_status evaluate_jacobian(baum_workspace *w, const point *p)
{
  static int32_t columns[EVERY_NQ + EVERY_NV + EVERY_NC + 1];
  static int32_t rows[(EVERY_NQ + EVERY_NV + EVERY_NC) * (EVERY_NQ + EVERY_NV + EVERY_NC)];
  static double values[(EVERY_NQ + EVERY_NV + EVERY_NC) * (EVERY_NQ + EVERY_NV + EVERY_NC)];
  const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX3};
  baum_sparse out = {NULL, NULL, NULL, 0};
  baum_status status = baum_workspace_residual_jacobian(w, &dae, 1.0, 0.0, p->y, p->y, &out);
  if (status == BAUM_OK) {
    out = (baum_sparse){columns, rows, values, 0};
    status = baum_workspace_residual_jacobian(w, &dae, 1.0, 0.0, p->y, p->y, &out);
  }
  return status;
}

static baum_status work(void *context)
{
  const every_element *parts = context;
  baum_workspace *w = GARBAGE;
  baum_status status = baum_workspace_create(parts->mechanism, &w);
  if (status != BAUM_OK) {
    assert_null(w);
    return status;
  }
  point p;
  start_point(w, &p);
  status = evaluate(w, parts, &p);
  if (status == BAUM_OK) {
    for (int i = 0; i < EVERY_NV; i++) {
      p.v[i] = (double)NAN;
    }
    status = baum_workspace_assemble(w, 0.0, p.q, p.v, &parts->slider, 1);
    assert_true(status == BAUM_OK || p.v[0] != p.v[0]);
  }
  if (status == BAUM_OK) {
    status = baum_workspace_project(w, 0.0, p.q, p.v);
  }
  if (status == BAUM_OK) {
    status = evaluate_jacobian(w, &p);
  }
  baum_workspace_destroy(w);
  return status;
}

static void a_workspace_survives_every_failing_allocation(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  every_element parts = every_element_make(NULL);
  fail_every_allocation(work, &parts);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- runs ---- */

typedef struct run_scenario {
  every_element parts;
  baum_simulation_options options;
  double span; /* [s] */
  bool warned; /* whether the creation of the run gives a warning */
} run_scenario;

/* Runs forward, reads all channels, sets the initial state, and runs backward. */
static baum_status go(baum_simulation *run, const every_element *parts, double span)
{
  baum_channel channels[CHANNELS];
  double row[WIDTH_MAX];
  double state[EVERY_NQ + EVERY_NV];
  (void)make_channels(parts, channels);
  memcpy(state, baum_simulation_q(run), EVERY_NQ * sizeof *state);
  memcpy(state + EVERY_NQ, baum_simulation_v(run), EVERY_NV * sizeof *state);
  baum_status status = baum_simulation_advance_to(run, span);
  if (reached_the_end(status)) {
    status = act(run, parts);
  }
  if (status == BAUM_OK) {
    status = baum_simulation_get(run, channels, CHANNELS, row);
  }
  if (status == BAUM_OK) {
    const double times[2] = {0.5 * span, 1.5 * span};
    const double values[2] = {0.9, 1.1};
    status = baum_simulation_schedule_input(run, parts->throttle, times, values, 2);
  }
  if (status == BAUM_OK) {
    status = baum_simulation_set_state(run, 0.0, state, state + EVERY_NQ);
  }
  return status == BAUM_OK ? baum_simulation_advance_to(run, -span) : status;
}

static bool run_warns(const baum_simulation *run)
{
  baum_warning warning;
  return baum_simulation_warning(run, 0, &warning, sizeof warning) == BAUM_OK;
}

static baum_status simulate(void *context)
{
  const run_scenario *s = context;
  baum_simulation *run = GARBAGE;
  baum_status status = baum_simulation_create(s->parts.mechanism, &s->options, &run);
  if (status != BAUM_OK) {
    assert_null(run);
    return status;
  }
  assert_true(!s->warned || run_warns(run));
  status = go(run, &s->parts, s->span);
  baum_simulation_destroy(run);
  return reached_the_end(status) ? BAUM_OK : status;
}

/* Excludes SUNDIALS 7.1. If an allocation fails, SUNDIALS 7.1 allocates memory for its message, and
 * writes to this memory without checking that it was allocated. */
static bool survives_without_memory(const baum_integrator *integrator)
{
  const char *name = baum_integrator_name(integrator);
  bool of_sundials = strncmp(name, "cvode", 5) == 0 || strcmp(name, "ida") == 0;
  return SUNDIALS_VERSION_MAJOR < 7 || !of_sundials;
}

/* All runs share some code, such as assembly and the check of derivatives. This code is tested only
 * with the first run. */
static void runs_survive_every_failing_allocation(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  run_scenario s = {.parts = every_element_make(NULL), .span = 0.004};
  for (int k = 0; find_pair(k, &s.options); k++) {
    s.options.check_derivatives = k == 0;
    s.options.start = k == 0 ? BAUM_START_ASSEMBLE : BAUM_START_AS_GIVEN;
    if (survives_without_memory(s.options.integrator) &&
        (k == 0 || s.options.formulation != BAUM_FORMULATION_UNSTABILIZED)) {
      fail_every_allocation(simulate, &s);
    }
  }
  baum_mechanism_destroy(s.parts.mechanism);
}

static const double *factors_of_rows(void)
{
  static double factors[EVERY_NC];
  for (int i = 0; i < EVERY_NC; i++) {
    factors[i] = i % 2 == 0 ? 1.0 : 0.5;
  }
  return factors;
}

/* If rows have gains of their own, the only additional allocation is a copy of the factors. The
 * code that makes the copy is the same for all integrators, so that testing one of them is
 * sufficient. */
static void runs_with_gains_of_rows_survive_every_failing_allocation(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  run_scenario s = {.parts = every_element_make(NULL), .span = 0.001};
  int done = 0;
  for (int k = 0; find_pair(k, &s.options); k++) {
    if (s.options.formulation == BAUM_FORMULATION_BAUMGARTE) {
      s.options.row_gains = factors_of_rows();
      s.options.row_gain_count = EVERY_NC;
      check_steady(&s.parts, &s.options);
      s.options.start = BAUM_START_AS_GIVEN;
      if (done++ == 0) {
        fail_every_allocation(simulate, &s);
      }
    }
  }
  baum_mechanism_destroy(s.parts.mechanism);
}

/* Adds the weld a second time. The code for rank, omitted rows and least-norm multipliers then
 * allocates memory, too. */
static every_element make_redundant(void)
{
  every_element parts = {.fault = NULL};
  any_def weld;
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  element_kinds[6].good(&parts, &weld);
  weld.head.name = "second weld";
  assert_int_equal(element_kinds[6].add(parts.mechanism, &weld, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(parts.mechanism), BAUM_OK);
  return parts;
}

static void runs_with_redundant_joints_and_any_solver_survive_every_failing_allocation(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  run_scenario s = {.parts = make_redundant(), .span = 0.001, .warned = true};
  s.options = options_for((step_mode){baum_euler(), true}, BAUM_FORMULATION_PROJECTION);
  for (int solver = BAUM_SOLVER_AUTO; solver <= BAUM_SOLVER_QR; solver++) {
    /* A run with a fixed step may make a second integration that estimates its error. With KLU or
     * QR, this test would then take too long, so it uses a variable step. */
    if (solver > BAUM_SOLVER_AUTO) {
      s.options = options_for((step_mode){baum_dp5(), false}, BAUM_FORMULATION_PROJECTION);
    }
    s.options.solver = (baum_solver)solver;
    s.options.check_derivatives = false;
    s.options.start = solver == BAUM_SOLVER_AUTO ? BAUM_START_ASSEMBLE : BAUM_START_AS_GIVEN;
    if (solver == BAUM_SOLVER_AUTO) {
      fail_every_allocation(simulate, &s);
    } else {
      /* A run makes thousands of allocations, but only a few places in the code make them. Only the
       * allocations of the solver differ from those with BAUM_SOLVER_AUTO, so it is enough to test
       * one allocation in fifty. */
      fail_allocations(simulate, &s, 50);
    }
  }
  baum_mechanism_destroy(s.parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(steps_samples_and_channels_allocate_nothing),
    cmocka_unit_test(jumps_of_inputs_allocate_nothing),
    cmocka_unit_test(evaluations_allocate_nothing),
    cmocka_unit_test(building_survives_every_failing_allocation),
    cmocka_unit_test(replacing_survives_every_failing_allocation),
    cmocka_unit_test(a_workspace_survives_every_failing_allocation),
    cmocka_unit_test(runs_survive_every_failing_allocation),
    cmocka_unit_test(runs_with_gains_of_rows_survive_every_failing_allocation),
    cmocka_unit_test(runs_with_redundant_joints_and_any_solver_survive_every_failing_allocation),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
