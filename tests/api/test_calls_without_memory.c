/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls every public function that allocates no memory, with good arguments, while every allocation
 * fails. tests/layout/check_allocation.sh checks that each public function is called here or in
 * test_calls_losing_memory.c. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/catalog.h>

#include "every_element.h"
#include "heap.h"
#include "report_scene.h"
#include "runs.h"

enum { BYTES = 1 << 16, TEXT = 256, GRID = 4, WIDTH = 64, TIMES = 4096 };

/* The objects on which functions are called, and memory for the results. */
typedef struct scene {
  every_element parts; /* the mechanism is frozen */
  every_element open;
  baum_workspace *w;
  baum_simulation *run;
  report_scene report;
  baum_study *study; /* a study of `report` that has been run */
  baum_study *fresh;

  double q[EVERY_NQ];
  double v[EVERY_NV];
  double lambda[EVERY_NC];
  double y[EVERY_NQ + EVERY_NV + 2 * EVERY_NC];
  double x[EVERY_NV * EVERY_NV];
  double two[2];
  double later; /* [s] */
  double times[TIMES];
  int32_t n[GRID];
  size_t size;
  bool unique[EVERY_NC];
  baum_warning warning;
  char text[TEXT];
  unsigned char bytes[BYTES];
  baum_dae dae;
  baum_channel channel;
  baum_outline outline;
  baum_page page;
  baum_catalog_choice choice;
  baum_mechanism *pendulum; /* from the catalogue */
  baum_catalog_error error;
  baum_catalog_entry entry;
  baum_catalog_parameter parameter;
  baum_counters counters;
  baum_energy_account account;
  baum_near_singular crossing;
  baum_event_record event;
  baum_event_def event_def;
  baum_amplification amplification;
  baum_simulation_options options;
  baum_study_options study_options;
  baum_sweep_def sweep;
  baum_study_grid grid;
  baum_study_entry study_entry;
  baum_study_method method;
  baum_study_reference reference;
  double catalog_x[WIDTH];
} scene;

/* ---- calls that return a status: the name and the arguments ---- */

#define STATUS_CALLS(X)                                                                        \
  X(baum_fail, (BAUM_OK, "fine"))                                                              \
  X(baum_mechanism_columns, (s->parts.mechanism, s->parts.crank, &s->n[0], &s->n[1]))          \
  X(baum_mechanism_rows, (s->parts.mechanism, s->parts.pin, &s->n[0], &s->n[1]))               \
  X(baum_mechanism_sizes, (s->parts.mechanism, &s->n[0], &s->n[1], &s->n[2]))                  \
  X(baum_mechanism_get_gravity, (s->parts.mechanism, s->x))                                    \
  X(baum_mechanism_get_outline,                                                                \
    (s->parts.mechanism, s->parts.crank, 0, &s->outline, sizeof s->outline))                   \
  X(baum_mechanism_get_characteristic_length, (s->parts.mechanism, s->x))                      \
  X(baum_mechanism_get_input, (s->parts.mechanism, s->parts.throttle, s->x))                   \
  X(baum_mechanism_set_gravity, (s->open.mechanism, 0.0, -9.81, 0.0))                          \
  X(baum_mechanism_set_characteristic_length, (s->open.mechanism, 1.0))                        \
  X(baum_mechanism_set_input, (s->open.mechanism, s->open.throttle, 1.0))                      \
  X(baum_workspace_design, (s->w, s->q, NULL))                                                 \
  X(baum_workspace_rate, (s->w, s->q, s->v, s->x))                                             \
  X(baum_workspace_difference, (s->w, s->q, s->q, s->x))                                       \
  X(baum_workspace_move, (s->w, s->v, s->x))                                                   \
  X(baum_workspace_phi, (s->w, 0.0, s->q, s->x))                                               \
  X(baum_workspace_jacobian, (s->w, 0.0, s->q, s->x))                                          \
  X(baum_workspace_nu, (s->w, 0.0, s->q, s->x))                                                \
  X(baum_workspace_mass, (s->w, 0.0, s->q, s->x))                                              \
  X(baum_workspace_gamma, (s->w, 0.0, s->q, s->v, s->x))                                       \
  X(baum_workspace_force, (s->w, 0.0, s->q, s->v, s->x))                                       \
  X(baum_workspace_energy, (s->w, 0.0, s->q, s->v, &s->two[0], &s->two[1]))                    \
  X(baum_workspace_acceleration, (s->w, 0.0, s->q, s->v, 1.0, 1.0, s->x, s->lambda))           \
  X(baum_workspace_reaction, (s->w, 0.0, s->q, s->lambda, s->parts.rod, s->x))                 \
  X(baum_workspace_residual, (s->w, &s->dae, 0.0, s->y, s->y, s->x))                           \
  X(baum_workspace_set_input, (s->w, s->parts.throttle, 0.5))                                  \
  X(baum_workspace_set_angle, (s->w, s->parts.bearing, BAUM_COORDINATE_FIRST, 7.0))            \
  X(baum_simulation_step, (s->run, 3))                                                         \
  X(baum_simulation_advance_to, (s->run, 0.01))                                                \
  X(baum_simulation_sample, (s->run, &s->later, 1, &s->channel, 1, s->x, NULL))                \
  X(baum_simulation_get, (s->run, &s->channel, 1, s->x))                                       \
  X(baum_simulation_set_input, (s->run, s->parts.throttle, 0.9))                               \
  X(baum_simulation_set_progress_interval, (s->run, 0.5))                                      \
  X(baum_simulation_set_time_limit, (s->run, 0.5))                                             \
  X(baum_simulation_counters, (s->run, &s->counters, sizeof s->counters))                      \
  X(baum_simulation_energy_account, (s->run, &s->account, sizeof s->account))                  \
  X(baum_simulation_event, (s->run, 0, &s->event, sizeof s->event))                            \
  X(baum_simulation_near_singular, (s->run, 0, &s->crossing, sizeof s->crossing))              \
  X(baum_simulation_warning, (s->run, 0, &s->warning, sizeof s->warning))                      \
  X(baum_simulation_unique_multipliers, (s->run, s->unique))                                   \
  X(baum_simulation_save, (s->run, s->bytes, BYTES, &s->size))                                 \
  X(baum_simulation_restore, (s->run, s->bytes, s->size))                                      \
  X(baum_stability_at, (baum_rk4(), 1.0, 1.0, &s->amplification, sizeof s->amplification))     \
  X(baum_stability_best, (baum_rk4(), &s->two[0], &s->two[1]))                                 \
  X(baum_stability_best_on_ray, (baum_rk4(), 1.0, s->two))                                     \
  X(baum_stability_deadbeat, (baum_euler(), &s->two[0], &s->two[1]))                           \
  X(baum_stability_grid, (baum_rk4(), s->two, s->two, 2, 2, s->x))                             \
  X(baum_stability_intervals, (baum_rk4(), 1.0, 1, &s->two[0], &s->two[1], s->n))              \
  X(baum_stability_limit, (baum_rk4(), 1.0, s->two))                                           \
  X(baum_stability_nearest, (baum_rk4(), 9.0, 9.0, &s->two[0], &s->two[1]))                    \
  X(baum_stability_outline, (baum_rk4(), 1.0, GRID, s->x, s->x + GRID, s->n))                  \
  X(baum_stability_velocity_at, (baum_rk4(), 1.0, &s->amplification, sizeof s->amplification)) \
  X(baum_stability_velocity_limit, (baum_rk4(), s->two))                                       \
  X(baum_catalog_entry_at, (0, &s->entry, sizeof s->entry))                                    \
  X(baum_catalog_find, ("pendulum", &s->entry, sizeof s->entry))                               \
  X(baum_catalog_parameter_at, ("pendulum", 0, &s->parameter, sizeof s->parameter))            \
  X(baum_catalog_times, ("pendulum", s->times))                                                \
  X(baum_catalog_reference, (&s->choice, 0.0, s->catalog_x, s->catalog_x + WIDTH / 2))         \
  X(baum_catalog_compare, (&s->choice, s->pendulum, s->times, 1, s->catalog_x,                 \
                           s->catalog_x + WIDTH / 2, &s->error, sizeof s->error))              \
  X(baum_study_set_solution, (s->fresh, baum_catalog_solution, &s->choice, 9.0))               \
  X(baum_study_entry_at, (s->study, 0, &s->study_entry, sizeof s->study_entry))                \
  X(baum_study_entry_options, (s->study, 0, &s->options, sizeof s->options))                   \
  X(baum_study_method_at, (s->study, 0, &s->method, sizeof s->method))                         \
  X(baum_study_reference_read, (s->study, &s->reference, sizeof s->reference))                 \
  X(baum_study_reference_sample, (s->study, 0, s->x, NULL, NULL, NULL))                        \
  X(baum_study_settings, (s->study, s->x, s->x, &s->study_options, sizeof s->study_options))   \
  X(baum_study_front, (s->study, BAUM_STUDY_WORK, GRID, s->n, &s->n[0]))                       \
  X(baum_study_cost_at, (s->study, 0, 1e-4, BAUM_STUDY_WORK, s->x))                            \
  X(baum_study_compare, (s->study, 0, 0, 1e-4, BAUM_STUDY_WORK, s->x))                         \
  X(baum_study_recommend,                                                                      \
    (s->study, 1e-2, BAUM_STUDY_WORK, &s->options, sizeof s->options, s->text, TEXT))          \
  X(baum_study_recommend_budget, (s->study, 1e3, &s->options, sizeof s->options, s->text, TEXT))

/* ---- calls that return something else, or nothing ---- */

#define VALUE_CALLS(X)                                                                           \
  X(baum_message, ())                                                                            \
  X(baum_status_name, (BAUM_OK))                                                                 \
  X(baum_warning_name, (BAUM_WARNING_ACCURACY))                                                  \
  X(baum_status_text, (BAUM_OK))                                                                 \
  X(baum_version, ())                                                                            \
  X(baum_has, ("sundials"))                                                                      \
  X(baum_mechanism_destroy, (NULL))                                                              \
  X(baum_mechanism_is_frozen, (s->parts.mechanism))                                              \
  X(baum_mechanism_body_count, (s->parts.mechanism))                                             \
  X(baum_mechanism_joint_count, (s->parts.mechanism))                                            \
  X(baum_mechanism_force_count, (s->parts.mechanism))                                            \
  X(baum_mechanism_input_count, (s->parts.mechanism))                                            \
  X(baum_mechanism_body_at, (s->parts.mechanism, 0))                                             \
  X(baum_mechanism_joint_at, (s->parts.mechanism, 0))                                            \
  X(baum_mechanism_force_at, (s->parts.mechanism, 0))                                            \
  X(baum_mechanism_input_at, (s->parts.mechanism, 0))                                            \
  X(baum_mechanism_body_name, (s->parts.mechanism, s->parts.crank))                              \
  X(baum_mechanism_joint_name, (s->parts.mechanism, s->parts.pin))                               \
  X(baum_mechanism_force_name, (s->parts.mechanism, s->parts.spring))                            \
  X(baum_mechanism_input_name, (s->parts.mechanism, s->parts.throttle))                          \
  X(baum_mechanism_find_body, (s->parts.mechanism, "crank"))                                     \
  X(baum_mechanism_find_joint, (s->parts.mechanism, "pin"))                                      \
  X(baum_mechanism_find_force, (s->parts.mechanism, "spring"))                                   \
  X(baum_mechanism_find_input, (s->parts.mechanism, "throttle"))                                 \
  X(baum_mechanism_break_times, (s->parts.mechanism, s->n))                                      \
  X(baum_channels_width, (s->parts.mechanism, &s->channel, 1))                                   \
  X(baum_workspace_input, (s->w, s->parts.throttle))                                             \
  X(baum_workspace_destroy, (NULL))                                                              \
  X(baum_simulation_options_init, (&s->options, sizeof s->options))                              \
  X(baum_simulation_destroy, (NULL))                                                             \
  X(baum_simulation_time, (s->run))                                                              \
  X(baum_simulation_q, (s->run))                                                                 \
  X(baum_simulation_v, (s->run))                                                                 \
  X(baum_simulation_input, (s->run, s->parts.throttle))                                          \
  X(baum_simulation_event_count, (s->run))                                                       \
  X(baum_simulation_explain, (s->run))                                                           \
  X(baum_simulation_message, (s->run))                                                           \
  X(baum_simulation_cancel, (NULL))                                                              \
  X(baum_event_def_init, (&s->event_def, sizeof s->event_def))                                   \
  X(baum_outline_init, (&s->outline, sizeof s->outline))                                         \
  X(baum_mechanism_outline_count, (s->parts.mechanism, s->parts.crank))                          \
  X(baum_page_init, (&s->page, sizeof s->page))                                                  \
  X(baum_channel_init, (&s->channel, sizeof s->channel))                                         \
  X(baum_gains_auto, ())                                                                         \
  X(baum_gains_best_damping, ())                                                                 \
  X(baum_gains_deadbeat, ())                                                                     \
  X(baum_gains_fixed, (1.0, 1.0))                                                                \
  X(baum_gains_frequency, (1.0, 1.0))                                                            \
  X(baum_gains_scaled, (1.0, 1.0))                                                               \
  X(baum_gains_taylor, ())                                                                       \
  X(baum_formulation_name, (BAUM_FORMULATION_GGL))                                               \
  X(baum_integrator_at, (0))                                                                     \
  X(baum_integrator_name, (baum_rk4()))                                                          \
  X(baum_integrator_order, (baum_rk4()))                                                         \
  X(baum_integrator_offers, (baum_rk4(), BAUM_FORMULATION_GGL))                                  \
  X(baum_integrator_has_fixed_step, (baum_rk4()))                                                \
  X(baum_integrator_has_variable_step, (baum_rk4()))                                             \
  X(baum_stability_statement, (baum_rk4()))                                                      \
  X(baum_ab2, ())                                                                                \
  X(baum_ab3, ())                                                                                \
  X(baum_ab4, ())                                                                                \
  X(baum_cvode_adams, ())                                                                        \
  X(baum_cvode_bdf, ())                                                                          \
  X(baum_dp5, ())                                                                                \
  X(baum_euler, ())                                                                              \
  X(baum_generalized_alpha, ())                                                                  \
  X(baum_ida, ())                                                                                \
  X(baum_kinematics, ())                                                                         \
  X(baum_rattle, ())                                                                             \
  X(baum_rk2, ())                                                                                \
  X(baum_rk3, ())                                                                                \
  X(baum_rk4, ())                                                                                \
  X(baum_rk8, ())                                                                                \
  X(baum_semi_implicit_euler, ())                                                                \
  X(baum_catalog_count, ())                                                                      \
  X(baum_catalog_solution, (0.0, s->catalog_x, s->catalog_x + WIDTH / 2, s->lambda, &s->choice)) \
  X(baum_study_options_init, (&s->study_options, sizeof s->study_options))                       \
  X(baum_sweep_def_init, (&s->sweep, sizeof s->sweep))                                           \
  X(baum_study_grid_init, (&s->grid, sizeof s->grid))                                            \
  X(baum_study_destroy, (NULL))                                                                  \
  X(baum_study_cancel, (NULL))                                                                   \
  X(baum_study_entry_count, (s->study))                                                          \
  X(baum_study_method_count, (s->study))                                                         \
  X(baum_study_error_text, (s->study))                                                           \
  X(baum_study_state_name, (BAUM_STUDY_DONE))

/* ---- the table ---- */

typedef struct call {
  const char *name;
  baum_status (*make)(scene *s);
} call;

#define MAKE_STATUS(NAME, ARGUMENTS)       \
  static baum_status call_##NAME(scene *s) \
  {                                        \
    (void)s;                               \
    return NAME ARGUMENTS;                 \
  }
#define MAKE_VALUE(NAME, ARGUMENTS)        \
  static baum_status call_##NAME(scene *s) \
  {                                        \
    (void)s;                               \
    (void)NAME ARGUMENTS;                  \
    return BAUM_OK;                        \
  }
#define ROW(NAME, ARGUMENTS) {#NAME, call_##NAME},

STATUS_CALLS(MAKE_STATUS)
VALUE_CALLS(MAKE_VALUE)
static const call CALLS[] = {STATUS_CALLS(ROW) VALUE_CALLS(ROW)};

/* ---- scenes ---- */

static baum_simulation *start(const every_element *parts)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.formulation = BAUM_FORMULATION_UNSTABILIZED;
  o.step = 1e-3;
  o.energy_account = true;
  return create_run(parts->mechanism, &o);
}

static void make_scene(scene *s)
{
  memset(s, 0, sizeof *s);
  s->parts = every_element_make(NULL);
  s->outline = baum_outline_default();
  s->outline.form = BAUM_OUTLINE_CIRCLE;
  s->outline.radius = 1.0;
  assert_int_equal(baum_mechanism_set_outlines(s->parts.mechanism, s->parts.crank, &s->outline, 1),
                   BAUM_OK);
  assert_int_equal(every_element_build(&s->open), BAUM_OK);
  assert_int_equal(baum_workspace_create(s->parts.mechanism, &s->w), BAUM_OK);
  s->run = start(&s->parts);
  s->report = report_scene_make();
  s->study = s->report.study;
  assert_int_equal(baum_study_run(s->study), BAUM_OK);
  s->dae = (baum_dae){.index = BAUM_RESIDUAL_INDEX1};
  s->channel = baum_channel_of(BAUM_ENERGY);
  s->choice = (baum_catalog_choice){.name = "pendulum"};
  assert_int_equal(baum_catalog_build(&s->choice, &s->pendulum), BAUM_OK);
  assert_int_equal(baum_study_create(s->pendulum, 0.0, 1.0, &s->fresh), BAUM_OK);
  s->two[1] = 1.0;
  s->later = 0.02;
  assert_int_equal(baum_workspace_design(s->w, s->q, NULL), BAUM_OK);
  memcpy(s->y, s->q, sizeof s->q);
}

static void end_scene(scene *s)
{
  baum_simulation_destroy(s->run);
  baum_workspace_destroy(s->w);
  report_scene_end(&s->report);
  baum_mechanism_destroy(s->parts.mechanism);
  baum_mechanism_destroy(s->open.mechanism);
  baum_study_destroy(s->fresh);
  baum_mechanism_destroy(s->pendulum);
}

/* Tells whether a call has done its work. For calls that read an event, a singular configuration or
 * a warning, BAUM_ERR_ARGUMENT is right, because there is nothing to read. */
static bool is_done(baum_status status, const char *name)
{
  return status >= BAUM_OK ||
         (status == BAUM_ERR_ARGUMENT && (strcmp(name, "baum_simulation_event") == 0 ||
                                          strcmp(name, "baum_simulation_near_singular") == 0 ||
                                          strcmp(name, "baum_simulation_warning") == 0));
}

static void calls_that_need_no_memory_allocate_none(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  static scene s;
  int failures = 0;
  make_scene(&s);
  for (size_t k = 0; k < sizeof CALLS / sizeof CALLS[0]; k++) {
    long before = heap_blocks();
    heap_fail(0, true);
    baum_status status = CALLS[k].make(&s);
    long allocations = heap_stop();
    if (allocations != 0 || heap_blocks() != before || !is_done(status, CALLS[k].name)) {
      fail_msg("%s: %ld allocations, %s: %s", CALLS[k].name, allocations, baum_status_name(status),
               baum_message());
    }
  }
  assert_int_equal(failures, 0);
  end_scene(&s);
}

/* For every kind of element, makes default definitions and reads definitions back. */
static void definitions_are_made_and_read_without_memory(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  every_element parts = every_element_make(NULL);
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    const element_kind *kind = &element_kinds[k];
    any_id id = every_element_id(&parts, kind);
    any_def def;
    heap_fail(0, true);
    kind->init(&def, sizeof def);
    baum_status status = kind->get(parts.mechanism, id, &def, kind->size);
    long allocations = heap_stop();
    if (allocations != 0 || status != BAUM_OK) {
      fail_msg("%s: %ld allocations, %s", kind->name, allocations, baum_message());
    }
  }
  baum_mechanism_destroy(parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(calls_that_need_no_memory_allocate_none),
    cmocka_unit_test(definitions_are_made_and_read_without_memory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
