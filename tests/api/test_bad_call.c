/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls every public function with NULL arguments, and with objects at a wrong stage, for example a
 * mechanism that is not frozen. Functions of elements are tested in test_bad_definition.c.
 * Functions of stabilization.h are also tested in tests/unit/test_stability.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "every_element.h"
#include "message.h"
#include "runs.h"

static void *const GARBAGE = (void *)(uintptr_t)16;

/* ---- status.h, version.h ---- */

static void texts_are_never_null(void **state)
{
  (void)state;
  for (int k = -40; k <= 20; k++) {
    assert_non_null(baum_status_name((baum_status)k));
    assert_non_null(baum_status_text((baum_status)k));
  }
  assert_string_equal(baum_status_name((baum_status)5), "BAUM_?");
  assert_string_equal(baum_status_name(BAUM_ERR_UNSTABLE), "BAUM_ERR_UNSTABLE");
  assert_non_null(baum_message());
  assert_string_equal(baum_version(), BAUM_VERSION);
  assert_false(baum_has(NULL));
  assert_false(baum_has("fortran"));
}

/* ---- mechanism.h ---- */

static void calls_on_a_null_mechanism_are_refused(void **state)
{
  (void)state;
  const baum_body_id body = {1, 1};
  const baum_joint_id joint = {1, 1};
  baum_mechanism *copy = GARBAGE;
  double numbers[3];
  baum_mobility mobility;
  baum_report report;
  ASSERT_SAYS(baum_mechanism_create(NULL), BAUM_ERR_ARGUMENT, "out is NULL");
  ASSERT_SAYS(baum_mechanism_copy(NULL, &copy), BAUM_ERR_ARGUMENT, "the mechanism is NULL");
  assert_null(copy);
  ASSERT_SAYS(baum_mechanism_set_gravity(NULL, 0.0, 0.0, 0.0), BAUM_ERR_ARGUMENT,
              "the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_get_gravity(NULL, numbers), BAUM_ERR_ARGUMENT,
              "the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_set_characteristic_length(NULL, 1.0), BAUM_ERR_ARGUMENT,
              "the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_get_characteristic_length(NULL, numbers), BAUM_ERR_ARGUMENT,
              "the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_freeze(NULL), BAUM_ERR_ARGUMENT, "the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_sizes(NULL, NULL, NULL, NULL), BAUM_ERR_ARGUMENT,
              "the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_rows(NULL, joint, NULL, NULL), BAUM_ERR_ARGUMENT,
              "the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_columns(NULL, body, NULL, NULL), BAUM_ERR_ARGUMENT,
              "the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_mobility(NULL, &mobility, sizeof mobility), BAUM_ERR_ARGUMENT,
              "baum_mechanism_mobility: the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_report(NULL, &report, sizeof report), BAUM_ERR_ARGUMENT,
              "baum_mechanism_report: the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_check_derivatives(NULL), BAUM_ERR_ARGUMENT, "the mechanism is NULL");
  assert_false(baum_mechanism_is_frozen(NULL));
  assert_null(baum_mechanism_body_name(NULL, body));
  assert_null(baum_mechanism_joint_name(NULL, joint));
  baum_mechanism_destroy(NULL);
}

static void an_open_mechanism_can_be_examined(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  baum_mobility mobility;
  baum_report report;
  assert_int_equal(baum_mechanism_mobility(parts.mechanism, &mobility, sizeof mobility), BAUM_OK);
  assert_int_equal(mobility.degrees_of_freedom, EVERY_NV - EVERY_NC);
  assert_int_equal(baum_mechanism_report(parts.mechanism, &report, sizeof report), BAUM_OK);
  assert_int_equal(report.velocities, EVERY_NV);
  assert_false(baum_mechanism_is_frozen(parts.mechanism));
  baum_mechanism_destroy(parts.mechanism);

  baum_mechanism *empty = create_mechanism();
  ASSERT_SAYS(baum_mechanism_mobility(empty, &mobility, sizeof mobility), BAUM_ERR_STATE,
              "the mechanism has no body");
  baum_mechanism_destroy(empty);
}

static void calls_that_need_a_frozen_mechanism_refuse_an_open_one(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  baum_workspace *workspace = GARBAGE;
  int32_t number = 77;
  const baum_channel channel = baum_channel_of(BAUM_Q);
  ASSERT_SAYS(baum_mechanism_sizes(parts.mechanism, &number, NULL, NULL), BAUM_ERR_STATE,
              "baum_mechanism_sizes: the mechanism is not frozen");
  ASSERT_SAYS(baum_mechanism_rows(parts.mechanism, parts.pin, &number, NULL), BAUM_ERR_STATE,
              "baum_mechanism_rows: the mechanism is not frozen");
  ASSERT_SAYS(baum_mechanism_columns(parts.mechanism, parts.bob, &number, NULL), BAUM_ERR_STATE,
              "baum_mechanism_columns: the mechanism is not frozen");
  assert_int_equal(number, 77);
  ASSERT_SAYS(baum_mechanism_check_derivatives(parts.mechanism), BAUM_ERR_STATE,
              "baum_mechanism_check_derivatives: the mechanism is not frozen");
  ASSERT_SAYS(baum_workspace_create(parts.mechanism, &workspace), BAUM_ERR_STATE,
              "baum_workspace_create: the mechanism is not frozen");
  assert_null(workspace);
  assert_int_equal(baum_channels_width(parts.mechanism, &channel, 1), -1);
  assert_non_null(strstr(baum_message(), "not frozen"));
  baum_mechanism_destroy(parts.mechanism);
}

static void required_outputs_of_a_mechanism_may_not_be_null(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_mobility mobility;
  baum_report report;
  ASSERT_SAYS(baum_mechanism_copy(parts.mechanism, NULL), BAUM_ERR_ARGUMENT, "out is NULL");
  ASSERT_SAYS(baum_mechanism_get_gravity(parts.mechanism, NULL), BAUM_ERR_ARGUMENT,
              "gravity is NULL");
  ASSERT_SAYS(baum_mechanism_get_characteristic_length(parts.mechanism, NULL), BAUM_ERR_ARGUMENT,
              "length is NULL");
  ASSERT_SAYS(baum_mechanism_mobility(parts.mechanism, NULL, sizeof mobility), BAUM_ERR_ARGUMENT,
              "out is NULL");
  ASSERT_SAYS(baum_mechanism_mobility(parts.mechanism, &mobility, 0), BAUM_ERR_ARGUMENT,
              "caller_size is too small");
  ASSERT_SAYS(baum_mechanism_report(parts.mechanism, NULL, sizeof report), BAUM_ERR_ARGUMENT,
              "out is NULL");
  ASSERT_SAYS(baum_mechanism_report(parts.mechanism, &report, 0), BAUM_ERR_ARGUMENT,
              "caller_size is too small");
  assert_int_equal(baum_mechanism_sizes(parts.mechanism, NULL, NULL, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_rows(parts.mechanism, parts.pin, NULL, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_columns(parts.mechanism, parts.bob, NULL, NULL), BAUM_OK);
  baum_mechanism_destroy(parts.mechanism);
}

static void reports_are_cut_to_the_callers_size(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_euler();
  o.step = 1e-3;
  baum_simulation *run = create_run(parts.mechanism, &o);
  const size_t size = 3 * sizeof(size_t);
  baum_mobility mobility;
  baum_report report;
  baum_counters counters;
  baum_amplification amplification;
  memset(&mobility, 0xA5, sizeof mobility);
  memset(&report, 0xA5, sizeof report);
  memset(&counters, 0xA5, sizeof counters);
  memset(&amplification, 0xA5, sizeof amplification);
  assert_int_equal(baum_mechanism_mobility(parts.mechanism, &mobility, size), BAUM_OK);
  assert_int_equal(baum_mechanism_report(parts.mechanism, &report, size), BAUM_OK);
  assert_int_equal(baum_simulation_counters(run, &counters, size), BAUM_OK);
  assert_int_equal(baum_stability_at(baum_euler(), 0.5, 0.5, &amplification, size), BAUM_OK);
  assert_int_equal(mobility.struct_size, size);
  assert_int_equal(report.struct_size, size);
  assert_int_equal(counters.struct_size, size);
  assert_int_equal(amplification.struct_size, size);
  assert_int_equal(((unsigned char *)&mobility)[size], 0xA5);
  assert_int_equal(((unsigned char *)&report)[size], 0xA5);
  assert_int_equal(((unsigned char *)&counters)[size], 0xA5);
  assert_int_equal(((unsigned char *)&amplification)[size], 0xA5);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- dynamics.h ---- */

/* All arguments that a call on a workspace may have. */
typedef struct arguments {
  baum_workspace *w;
  double t;
  double *q;
  double *v;
  double *out;
  double *y;
  const baum_dae *dae;
  baum_sparse *sparse;
  baum_joint_id joint;
} arguments;

typedef baum_status workspace_call(const arguments *a);

#define CALL(NAME, ...)                              \
  static baum_status call_##NAME(const arguments *a) \
  {                                                  \
    return baum_workspace_##NAME(a->w, __VA_ARGS__); \
  }

CALL(phi, a->t, a->q, a->out)
CALL(jacobian, a->t, a->q, a->out)
CALL(nu, a->t, a->q, a->out)
CALL(gamma, a->t, a->q, a->v, a->out)
CALL(mass, a->t, a->q, a->out)
CALL(force, a->t, a->q, a->v, a->out)
CALL(energy, a->t, a->q, a->v, a->out, NULL)
CALL(acceleration, a->t, a->q, a->v, 1.0, 1.0, a->out, NULL)
CALL(reaction, a->t, a->q, a->y, a->joint, a->out)
CALL(residual, a->dae, a->t, a->y, a->y, a->out)
CALL(residual_jacobian, a->dae, 1.0, a->t, a->y, a->y, a->sparse)
CALL(assemble, a->t, a->q, a->v, NULL, 0)
CALL(project, a->t, a->q, a->v)

/* A function of a workspace, and which of its arguments must not be NULL and must be finite. */
typedef struct workspace_row {
  const char *name;
  workspace_call *call;
  bool q;
  bool v;
  bool out;
  bool y;
  bool v_may_be_nan;
} workspace_row;

static const workspace_row workspace_rows[] = {
  {"phi", call_phi, true, false, true, false, false},
  {"jacobian", call_jacobian, true, false, true, false, false},
  {"nu", call_nu, true, false, true, false, false},
  {"gamma", call_gamma, true, true, true, false, false},
  {"mass", call_mass, true, false, true, false, false},
  {"force", call_force, true, true, true, false, false},
  {"energy", call_energy, true, true, false, false, false},
  {"acceleration", call_acceleration, true, true, false, false, false},
  {"reaction", call_reaction, true, false, true, true, false},
  {"residual", call_residual, false, false, true, true, false},
  {"residual_jacobian", call_residual_jacobian, false, false, false, true, false},
  {"assemble", call_assemble, true, true, false, false, true},
  {"project", call_project, true, true, false, false, false},
};
enum { WORKSPACE_ROWS = sizeof workspace_rows / sizeof *workspace_rows };

static void check_says(const workspace_row *row, const arguments *a, const char *what)
{
  ASSERT_SAYS(row->call(a), BAUM_ERR_ARGUMENT, what);
  assert_non_null(strstr(baum_message(), row->name));
}

static void check_null_arguments(const workspace_row *row, const arguments *good)
{
  arguments a = *good;
  a.w = NULL;
  check_says(row, &a, "the workspace is NULL");
  a = *good;
  a.q = NULL;
  assert_int_equal(row->call(&a), row->q ? BAUM_ERR_ARGUMENT : BAUM_OK);
  a = *good;
  a.v = NULL;
  assert_int_equal(row->call(&a), row->v ? BAUM_ERR_ARGUMENT : BAUM_OK);
  a = *good;
  a.out = NULL;
  assert_int_equal(row->call(&a), row->out ? BAUM_ERR_ARGUMENT : BAUM_OK);
  a = *good;
  a.y = NULL;
  assert_int_equal(row->call(&a), row->y ? BAUM_ERR_ARGUMENT : BAUM_OK);
}

static void check_not_finite(const workspace_row *row, const arguments *good)
{
  arguments a = *good;
  a.t = (double)NAN;
  check_says(row, &a, "t");
  assert_non_null(strstr(baum_message(), "nan"));
  const double infinite = (double)INFINITY;
  double *const arrays[] = {row->q ? a.q : NULL, row->v ? a.v : NULL, row->y ? a.y : NULL};
  for (int k = 0; k < 3; k++) {
    if (arrays[k]) {
      double kept = arrays[k][3];
      a = *good;
      arrays[k][3] = infinite;
      check_says(row, &a, "[3] is inf, must be finite");
      arrays[k][3] = kept;
    }
  }
}

static void calls_on_a_workspace_refuse_null_and_what_is_not_finite(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  static double q[EVERY_NQ];
  static double v[EVERY_NV];
  static double y[EVERY_NQ + EVERY_NV + EVERY_NC];
  static double out[EVERY_NV * EVERY_NV];
  const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX1};
  baum_sparse sparse = {NULL, NULL, NULL, 0};
  arguments good = {NULL, 0.0, q, v, out, y, &dae, &sparse, parts.rod};
  assert_int_equal(baum_workspace_create(parts.mechanism, &good.w), BAUM_OK);
  assert_int_equal(baum_workspace_design(good.w, q, v), BAUM_OK);
  for (int i = 0; i < EVERY_NV; i++) {
    v[i] = (double)NAN;
  }
  assert_int_equal(baum_workspace_assemble(good.w, 0.0, q, v, NULL, 0), BAUM_OK);
  memcpy(y, q, sizeof q);
  for (int k = 0; k < WORKSPACE_ROWS; k++) {
    assert_int_equal(workspace_rows[k].call(&good), BAUM_OK);
    check_null_arguments(&workspace_rows[k], &good);
    check_not_finite(&workspace_rows[k], &good);
    assert_int_equal(workspace_rows[k].call(&good), BAUM_OK);
  }
  baum_workspace_destroy(good.w);
  baum_mechanism_destroy(parts.mechanism);
}

static void other_bad_calls_on_a_workspace_are_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  every_element others = every_element_make(NULL);
  baum_workspace *w = GARBAGE;
  double q[EVERY_NQ];
  double v[EVERY_NV];
  double y[EVERY_NQ + EVERY_NV + EVERY_NC] = {0.0};
  baum_dae dae = {.index = (baum_residual)5};
  ASSERT_SAYS(baum_workspace_create(NULL, &w), BAUM_ERR_ARGUMENT, "the mechanism is NULL");
  assert_null(w);
  ASSERT_SAYS(baum_workspace_create(parts.mechanism, NULL), BAUM_ERR_ARGUMENT, "out is NULL");
  ASSERT_SAYS(baum_workspace_design(NULL, q, v), BAUM_ERR_ARGUMENT, "the workspace is NULL");
  assert_int_equal(baum_workspace_create(parts.mechanism, &w), BAUM_OK);
  assert_int_equal(baum_workspace_design(w, NULL, NULL), BAUM_OK);
  assert_int_equal(baum_workspace_design(w, q, v), BAUM_OK);
  ASSERT_SAYS(baum_workspace_residual(w, &dae, 0.0, y, y, y), BAUM_ERR_ARGUMENT,
              "index is 5, must be 1, 2, 3 or 4 (GGL)");
  ASSERT_SAYS(baum_workspace_residual(w, NULL, 0.0, y, y, y), BAUM_ERR_ARGUMENT, "dae is NULL");
  ASSERT_SAYS(baum_workspace_residual_jacobian(w, &dae, 1.0, 0.0, y, y, NULL), BAUM_ERR_ARGUMENT,
              "baum_workspace_residual_jacobian: the output is NULL");
  dae = (baum_dae){.index = BAUM_RESIDUAL_INDEX1, .alpha = (double)NAN};
  ASSERT_SAYS(baum_workspace_residual(w, &dae, 0.0, y, y, y), BAUM_ERR_ARGUMENT, "alpha");
  ASSERT_SAYS(baum_workspace_reaction(w, 0.0, q, y, others.rod, v), BAUM_ERR_ARGUMENT,
              "joint is not of this mechanism");
  ASSERT_SAYS(baum_workspace_reaction(w, 0.0, q, y, (baum_joint_id){0, 0}, v), BAUM_ERR_ARGUMENT,
              "joint is none");
  ASSERT_SAYS(baum_workspace_assemble(w, 0.0, q, v, NULL, 1), BAUM_ERR_ARGUMENT, "held is NULL");
  ASSERT_SAYS(baum_workspace_assemble(w, 0.0, q, v, &parts.bob, -1), BAUM_ERR_ARGUMENT,
              "held_count (-1) is negative");
  ASSERT_SAYS(baum_workspace_assemble(w, 0.0, q, v, &others.bob, 1), BAUM_ERR_ARGUMENT,
              "held is not of this mechanism");
  baum_workspace_destroy(w);
  baum_workspace_destroy(NULL);
  baum_mechanism_destroy(parts.mechanism);
  baum_mechanism_destroy(others.mechanism);
}

/* ---- stabilization.h ---- */

static void functions_of_stability_refuse_null(void **state)
{
  (void)state;
  baum_amplification out;
  double x = 7.0;
  ASSERT_SAYS(baum_stability_at(NULL, 0.5, 0.5, &out, sizeof out), BAUM_ERR_ARGUMENT,
              "integrator is NULL");
  ASSERT_SAYS(baum_stability_at(baum_euler(), 0.5, 0.5, NULL, sizeof out), BAUM_ERR_ARGUMENT,
              "out is NULL");
  ASSERT_SAYS(baum_stability_at(baum_euler(), 0.5, 0.5, &out, 0), BAUM_ERR_ARGUMENT,
              "caller_size is too small");
  ASSERT_SAYS(baum_stability_at(baum_euler(), (double)NAN, 0.5, &out, sizeof out),
              BAUM_ERR_ARGUMENT, "alpha_h is nan, must be finite");
  ASSERT_SAYS(baum_stability_limit(NULL, 1.0, &x), BAUM_ERR_ARGUMENT, "integrator is NULL");
  ASSERT_SAYS(baum_stability_limit(baum_rk4(), 1.0, NULL), BAUM_ERR_ARGUMENT, "alpha_h is NULL");
  ASSERT_SAYS(baum_stability_limit(baum_rk4(), 0.0, &x), BAUM_ERR_ARGUMENT, "0");
  ASSERT_SAYS(baum_stability_deadbeat(NULL, &x, &x), BAUM_ERR_ARGUMENT, "integrator is NULL");
  ASSERT_SAYS(baum_stability_deadbeat(baum_rk4(), NULL, &x), BAUM_ERR_ARGUMENT, "NULL");
  ASSERT_SAYS(baum_stability_nearest(NULL, 1.0, 1.0, &x, &x), BAUM_ERR_ARGUMENT,
              "integrator is NULL");
  ASSERT_SAYS(baum_stability_nearest(baum_rk4(), 1.0, 1.0, &x, NULL), BAUM_ERR_ARGUMENT, "NULL");
  ASSERT_SAYS(baum_stability_limit(baum_ida(), 1.0, &x), BAUM_ERR_UNSUPPORTED, "ida");
  assert_true(x == 7.0);
}

/* ---- simulation.h ---- */

static void descriptions_of_integrators_accept_null_and_unknown_values(void **state)
{
  (void)state;
  assert_null(baum_integrator_name(NULL));
  assert_int_equal(baum_integrator_order(NULL), 0);
  assert_false(baum_integrator_has_fixed_step(NULL));
  assert_false(baum_integrator_offers(NULL, BAUM_FORMULATION_BAUMGARTE));
  assert_null(baum_formulation_name((baum_formulation)99));
  assert_null(baum_integrator_at(-1));
  assert_null(baum_integrator_at(INT32_MAX));
}

static void calls_on_a_null_run_are_refused(void **state)
{
  (void)state;
  const baum_channel channel = baum_channel_of(BAUM_Q);
  double numbers[4] = {0.0};
  baum_warning warning;
  bool unique = false;
  baum_counters counters;
  ASSERT_SAYS(baum_simulation_advance_to(NULL, 1.0), BAUM_ERR_ARGUMENT, "the simulation is NULL");
  ASSERT_SAYS(baum_simulation_step(NULL, 1), BAUM_ERR_ARGUMENT, "the simulation is NULL");
  ASSERT_SAYS(baum_simulation_set_progress_interval(NULL, 1.0), BAUM_ERR_ARGUMENT,
              "the simulation is NULL");
  ASSERT_SAYS(baum_simulation_set_time_limit(NULL, 1.0), BAUM_ERR_ARGUMENT,
              "the simulation is NULL");
  ASSERT_SAYS(baum_simulation_set_state(NULL, 0.0, numbers, numbers), BAUM_ERR_ARGUMENT,
              "the simulation is NULL");
  ASSERT_SAYS(baum_simulation_set_angle(NULL, (baum_joint_id){0}, BAUM_COORDINATE_FIRST, 0.0),
              BAUM_ERR_ARGUMENT, "the simulation is NULL");
  ASSERT_SAYS(baum_simulation_get(NULL, &channel, 1, numbers), BAUM_ERR_ARGUMENT,
              "the simulation is NULL");
  ASSERT_SAYS(baum_simulation_unique_multipliers(NULL, &unique), BAUM_ERR_ARGUMENT,
              "the simulation is NULL");
  ASSERT_SAYS(baum_simulation_sample(NULL, numbers, 1, &channel, 1, numbers, NULL),
              BAUM_ERR_ARGUMENT, "the simulation is NULL");
  ASSERT_SAYS(baum_simulation_counters(NULL, &counters, sizeof counters), BAUM_ERR_ARGUMENT,
              "the simulation is NULL");
  ASSERT_SAYS(baum_simulation_warning(NULL, 0, &warning, sizeof warning), BAUM_ERR_ARGUMENT,
              "the simulation is NULL");
  assert_true(isnan(baum_simulation_time(NULL)));
  assert_null(baum_simulation_q(NULL));
  assert_null(baum_simulation_v(NULL));
  assert_null(baum_simulation_explain(NULL));
  assert_null(baum_simulation_message(NULL));
  assert_int_equal(baum_channels_width(NULL, &channel, 1), -1);
  baum_simulation_cancel(NULL);
  baum_simulation_destroy(NULL);
}

static void outputs_of_a_run_may_not_be_null(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk2();
  o.step = 1e-3;
  baum_counters counters;
  baum_warning warning = {.text = "as is"};
  baum_simulation *run = create_run(parts.mechanism, &o);
  ASSERT_SAYS(baum_simulation_counters(run, NULL, sizeof counters), BAUM_ERR_ARGUMENT,
              "out is NULL");
  ASSERT_SAYS(baum_simulation_counters(run, &counters, 0), BAUM_ERR_ARGUMENT,
              "caller_size is too small");
  ASSERT_SAYS(baum_simulation_warning(run, 0, NULL, sizeof warning), BAUM_ERR_ARGUMENT,
              "out is NULL");
  ASSERT_SAYS(baum_simulation_warning(run, 0, &warning, 0), BAUM_ERR_ARGUMENT,
              "caller_size is too small");
  ASSERT_SAYS(baum_simulation_warning(run, 0, &warning, sizeof warning), BAUM_ERR_ARGUMENT,
              "k is 0, but there are no entries");
  ASSERT_SAYS(baum_simulation_warning(run, -1, &warning, sizeof warning), BAUM_ERR_ARGUMENT,
              "k is -1");
  assert_string_equal(warning.text, "as is");
  assert_string_equal(baum_simulation_message(run), "");
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

static void a_run_and_a_workspace_keep_their_mechanism_alive(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk2();
  o.step = 1e-3;
  baum_workspace *w = NULL;
  double q[EVERY_NQ];
  double phi[EVERY_NC];
  baum_simulation *run = create_run(parts.mechanism, &o);
  assert_int_equal(baum_workspace_create(parts.mechanism, &w), BAUM_OK);
  baum_mechanism_destroy(parts.mechanism);
  assert_int_equal(baum_simulation_advance_to(run, 0.01), BAUM_OK);
  baum_simulation_destroy(run);
  assert_int_equal(baum_workspace_design(w, q, NULL), BAUM_OK);
  assert_int_equal(baum_workspace_phi(w, 0.0, q, phi), BAUM_OK);
  baum_workspace_destroy(w);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(texts_are_never_null),
    cmocka_unit_test(calls_on_a_null_mechanism_are_refused),
    cmocka_unit_test(an_open_mechanism_can_be_examined),
    cmocka_unit_test(calls_that_need_a_frozen_mechanism_refuse_an_open_one),
    cmocka_unit_test(required_outputs_of_a_mechanism_may_not_be_null),
    cmocka_unit_test(reports_are_cut_to_the_callers_size),
    cmocka_unit_test(calls_on_a_workspace_refuse_null_and_what_is_not_finite),
    cmocka_unit_test(other_bad_calls_on_a_workspace_are_refused),
    cmocka_unit_test(functions_of_stability_refuse_null),
    cmocka_unit_test(descriptions_of_integrators_accept_null_and_unknown_values),
    cmocka_unit_test(calls_on_a_null_run_are_refused),
    cmocka_unit_test(outputs_of_a_run_may_not_be_null),
    cmocka_unit_test(a_run_and_a_workspace_keep_their_mechanism_alive),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
