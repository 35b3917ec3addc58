/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the calls of the catalogue: the descriptions of entries and parameters, refusals and their
 * messages, and the definition of errors. Also tests that the elements of a mechanism are found in
 * their order and by name. */
#define _GNU_SOURCE /* needed by heap.h */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include <baum/baum.h>
#include <baum/catalog.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "heap.h"
#include "message.h"

enum { NQ = 9 }; /* for the slider-crank */

static const baum_catalog_choice CRANK = {.name = "slider_crank"};

static baum_mechanism *build(const baum_catalog_choice *choice)
{
  baum_mechanism *out = NULL;
  check(baum_catalog_build(choice, &out));
  return out;
}

/* ---- entries and parameters ---- */

static void every_entry_says_what_it_is(void **state)
{
  (void)state;
  assert_true(baum_catalog_count() >= 16);
  for (int32_t k = 0; k < baum_catalog_count(); k++) {
    baum_catalog_entry entry;
    baum_catalog_entry found;
    assert_int_equal(baum_catalog_entry_at(k, &entry, sizeof entry), BAUM_OK);
    assert_int_equal(entry.struct_size, sizeof entry);
    assert_int_equal(baum_catalog_find(entry.name, &found, sizeof found), BAUM_OK);
    assert_ptr_equal(found.title, entry.title); /* fails if an earlier entry has the same name */
    assert_true(strlen(entry.title) > 0 && strlen(entry.source) > 0);
    assert_true(entry.end_time > entry.start_time);
    bool known = entry.sample_count > 0;
    assert_int_equal(known, strlen(entry.provenance) > 0);
    assert_int_equal(known, entry.digits_q > 8 && entry.digits_v > 8);
    assert_int_equal(known, !isnan(entry.digits_q));
    assert_true(known || !entry.exact);
  }
}

/* Describes a mechanism by six weighted sums. The sums of q, v, M, J and nu are computed at the
 * start. The sum of g is computed near the start, where no spring has its free length. */
static void describe(const baum_catalog_choice *choice, double out[6])
{
  baum_mechanism *m = build(choice);
  baum_workspace *w = NULL;
  int32_t n = 0;
  int32_t nc = 0;
  memset(out, 0, 6 * sizeof *out);
  assert_int_equal(baum_mechanism_sizes(m, &n, NULL, &nc), BAUM_OK);
  size_t room = (size_t)(n + nc) * (size_t)(n + nc);
  double *q = calloc(room, sizeof *q);
  double *v = calloc(room, sizeof *v);
  double *x = calloc(room, sizeof *x);
  assert_true(q && v && x);
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  assert_int_equal(baum_workspace_design(w, q, v), BAUM_OK);
  for (int i = 0; i < n; i++) {
    out[0] += (i + 1) * q[i];
    out[1] += isnan(v[i]) ? 0.0 : (i + 1) * v[i];
    /* The velocities are arbitrary, so that dampers exert forces. */
    v[i] = (isnan(v[i]) ? 0.0 : v[i]) + 1.0 + i;
  }
  assert_int_equal(baum_workspace_mass(w, 0.0, q, x), BAUM_OK);
  for (int i = 0; i < n * n; i++) {
    out[2] += (i + 1) * x[i];
  }
  assert_int_equal(baum_workspace_jacobian(w, 0.0, q, x), BAUM_OK);
  for (int i = 0; i < n * nc; i++) {
    out[4] += (i + 1) * x[i];
  }
  assert_int_equal(baum_workspace_nu(w, 0.0, q, x), BAUM_OK);
  for (int i = 0; i < nc; i++) {
    out[5] += (i + 1) * x[i];
  }
  for (int i = 0; i < n; i++) {
    x[i] = 1e-3 * (i + 1);
  }
  assert_int_equal(baum_workspace_move(w, x, q), BAUM_OK);
  assert_int_equal(baum_workspace_force(w, 0.0, q, v, x), BAUM_OK);
  for (int i = 0; i < n; i++) {
    out[3] += (i + 1) * x[i];
  }
  free(q);
  free(v);
  free(x);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

static void every_parameter_changes_its_mechanism(void **state)
{
  (void)state;
  int parameters = 0;
  for (int32_t k = 0; k < baum_catalog_count(); k++) {
    baum_catalog_entry entry;
    double before[6];
    assert_int_equal(baum_catalog_entry_at(k, &entry, sizeof entry), BAUM_OK);
    describe(&(baum_catalog_choice){.name = entry.name}, before);
    for (int32_t i = 0; i < entry.parameter_count; i++, parameters++) {
      baum_catalog_parameter p;
      double after[6];
      assert_int_equal(baum_catalog_parameter_at(entry.name, i, &p, sizeof p), BAUM_OK);
      double value = p.whole ? p.value + 1 : 1.01 * p.value + (p.value == 0.0 ? 0.01 : 0.0);
      const baum_catalog_setting setting = {p.name, value};
      describe(&(baum_catalog_choice){entry.name, &setting, 1}, after);
      if (memcmp(before, after, sizeof before) == 0) {
        fail_msg("%s: %s changes nothing", entry.name, p.name);
      }
    }
  }
  assert_true(parameters > 60);
}

static void giving_a_default_explicitly_changes_nothing(void **state)
{
  (void)state;
  const baum_catalog_setting setting = {"eccentricity", 0.0};
  const baum_catalog_choice choice = {"slider_crank", &setting, 1};
  double before[6];
  double after[6];
  double q[NQ];
  describe(&CRANK, before);
  describe(&choice, after);
  assert_memory_equal(before, after, sizeof before);
  assert_int_equal(baum_catalog_reference(&choice, 0.1, q, NULL), BAUM_OK);
}

static void a_shorter_struct_is_filled_up_to_its_size(void **state)
{
  (void)state;
  baum_catalog_entry entry;
  memset(&entry, 0x55, sizeof entry);
  size_t size = offsetof(baum_catalog_entry, source);
  assert_int_equal(baum_catalog_entry_at(0, &entry, size), BAUM_OK);
  assert_int_equal(entry.struct_size, size);
  assert_string_equal(entry.name, "pendulum");
  assert_int_equal(((const unsigned char *)&entry)[size], 0x55);
}

/* ---- refusals ---- */

static void missing_entries_and_parameters_are_refused_by_name(void **state)
{
  (void)state;
  baum_catalog_entry entry;
  baum_catalog_parameter parameter;
  baum_mechanism *out = NULL;
  double t[41];
  const baum_catalog_choice windmill = {.name = "windmill"};
  ASSERT_SAYS(baum_catalog_entry_at(-1, &entry, sizeof entry), BAUM_ERR_ARGUMENT, "k is -1");
  ASSERT_SAYS(baum_catalog_entry_at(0, NULL, sizeof entry), BAUM_ERR_ARGUMENT, "out is NULL");
  ASSERT_SAYS(baum_catalog_entry_at(0, &entry, 0), BAUM_ERR_ARGUMENT, "caller_size is too small");
  ASSERT_SAYS(baum_catalog_find("windmill", &entry, sizeof entry), BAUM_ERR_ARGUMENT,
              "no \"windmill\"; there are pendulum, ");
  ASSERT_SAYS(baum_catalog_find(NULL, &entry, sizeof entry), BAUM_ERR_ARGUMENT, "no \"NULL\"");
  ASSERT_SAYS(baum_catalog_parameter_at("chain", 6, &parameter, sizeof parameter),
              BAUM_ERR_ARGUMENT, "\"chain\" has 6 parameters");
  ASSERT_SAYS(baum_catalog_build(&windmill, &out), BAUM_ERR_ARGUMENT, "no \"windmill\"");
  assert_null(out);
  ASSERT_SAYS(baum_catalog_build(NULL, &out), BAUM_ERR_ARGUMENT, "choice is NULL");
  ASSERT_SAYS(baum_catalog_build(&windmill, NULL), BAUM_ERR_ARGUMENT, "out is NULL");
  ASSERT_SAYS(baum_catalog_times("windmill", t), BAUM_ERR_ARGUMENT, "no \"windmill\"");
  ASSERT_SAYS(baum_catalog_times("pendulum", NULL), BAUM_ERR_ARGUMENT, "times is NULL");
  ASSERT_SAYS(baum_catalog_times("chain", t), BAUM_ERR_UNSUPPORTED, "\"chain\" has no reference");
}

static void parameters_out_of_range_are_refused(void **state)
{
  (void)state;
  static const struct {
    const char *name;
    baum_catalog_setting setting;
    const char *message;
  } cases[] = {
    {"slider_crank", {"length", 1.0}, "no parameter \"length\"; there are: crank, rod, "},
    {"slider_crank", {NULL, 1.0}, "no parameter \"NULL\""},
    {"slider_crank", {"crank", 0.0}, "crank is 0 m, must be positive"},
    {"slider_crank", {"angle", (double)NAN}, "angle is nan rad, must be finite"},
    {"n_four_bar", {"windows", 1.5}, "windows is 1.5, must be a whole number"},
    {"n_four_bar", {"windows", -1.0}, "must be a whole number from 1"},
    {"n_four_bar", {"windows", 1e9}, "must be a whole number from 1 to 1e6"},
    {"slider_crank", {"eccentricity", 1.0}, "position"},
    {"rolling_disc", {"tilt", 2.0}, "tilt is 2 rad, must be between -pi/2 and pi/2"},
    {"rolling_disc", {"tilt", -1.5707963267948966}, "must be between -pi/2 and pi/2"},
    {"rolling_disc", {"turning", 0.0}, "turning is 0 rad/s, must be other than 0"},
    {"gimbals", {"precession", -0.0}, "precession is -0 rad/s, must be other than 0"},
    {"chaplygin_sleigh", {"rate", 0.0}, "rate is 0 rad/s, must be other than 0"},
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const baum_catalog_choice choice = {cases[k].name, &cases[k].setting, 1};
    baum_mechanism *out = NULL;
    ASSERT_SAYS(baum_catalog_build(&choice, &out), BAUM_ERR_ARGUMENT, cases[k].message);
    assert_null(out);
  }
  const baum_catalog_choice lost = {"chain", NULL, 1};
  baum_mechanism *out = NULL;
  ASSERT_SAYS(baum_catalog_build(&lost, &out), BAUM_ERR_ARGUMENT, "settings are NULL");
}

static void a_reference_that_does_not_hold_is_not_given(void **state)
{
  (void)state;
  const baum_catalog_setting setting = {"rod", 0.4};
  const baum_catalog_choice longer = {"slider_crank", &setting, 1};
  const baum_catalog_setting less = {"rod", 0.19};
  const baum_catalog_choice too_short = {"slider_crank_driven", &less, 1};
  double q[NQ] = {0.0};
  ASSERT_SAYS(baum_catalog_reference(&longer, 0.0, q, NULL), BAUM_ERR_UNSUPPORTED,
              "is known only for rod = 0.30599999999999999 m, not for 0.4");
  ASSERT_SAYS(baum_catalog_reference(&CRANK, 0.005, q, NULL), BAUM_ERR_ARGUMENT, "no sample at");
  ASSERT_SAYS(baum_catalog_reference(&CRANK, (double)INFINITY, q, NULL), BAUM_ERR_ARGUMENT,
              "must be finite");
  const baum_catalog_choice swing = {.name = "pendulum"};
  ASSERT_SAYS(
    baum_catalog_reference(&swing, 1e4, q, NULL), BAUM_ERR_UNSUPPORTED,
    "may be off by |at t = 10000 s, so they do not have the stated accuracy of 12 digits");
  ASSERT_SAYS(baum_catalog_reference(&swing, 1e300, q, NULL), BAUM_ERR_UNSUPPORTED, "off by inf");
  assert_int_equal(baum_catalog_reference(&swing, -10.0, q, NULL), BAUM_OK);
  /* When the crank points downwards, the rod is too short to reach the guide, because
   * 0.153 + 0.05 > 0.19. */
  assert_int_equal(baum_catalog_reference(&too_short, 0.0, q, NULL), BAUM_OK);
  ASSERT_SAYS(baum_catalog_reference(&too_short, 0.0314159, q, NULL), BAUM_ERR_UNSUPPORTED,
              "with these parameters");
}

static void formulas_that_cancel_or_overflow_are_not_given(void **state)
{
  (void)state;
  static const struct {
    const char *name;
    const char *message;
    double t;
    int count;
    baum_catalog_setting settings[7];
  } cases[] = {
    /* The two terms of the moment of the disc nearly cancel, so that relative errors are large. */
    {"rolling_disc",
     "may be off by",
     0.0,
     6,
     {{"mass", 0.1},
      {"radius", 1e-4},
      {"across", 1.0},
      {"axial", 1e-9},
      {"tilt", 0.3},
      {"turning", 0.010133}}}, /* sqrt(0.1 * 9.81e-4 / cos 0.3), rounded */
    {"rolling_disc",
     "may be off by",
     0.0,
     6,
     {{"mass", 100.0},
      {"radius", 1e-4},
      {"across", 1.0},
      {"axial", 1e-6},
      {"tilt", 0.3},
      {"turning", 0.32045}}}, /* sqrt(9.81e-2 / cos 0.3), rounded */
    /* Two terms nearly cancel, so that the sum 0.3 * 9.81 arm + (across + inner / 2) 2^2 sin 0.4 is
     * almost 0. */
    {"gimbals", "may be off by", 1.0, 2, {{"axial", 1e-9}, {"arm", -8.47e-4}}},
    {"differential", "may be off by", 1.0, 1, {{"damping", 1e-9}}},
    {"chaplygin_sleigh", "off by inf", 1e4, 0, {{NULL, 0.0}}},
    /* The square of this rate underflows to 0. */
    {"chaplygin_sleigh", "has no reference at t = 1 s", 1.0, 2, {{"speed", 0.0}, {"rate", 1e-200}}},
  };
  double q[28];
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const baum_catalog_choice choice = {cases[k].name, cases[k].settings, cases[k].count};
    const baum_catalog_choice usual = {.name = cases[k].name};
    ASSERT_SAYS(baum_catalog_reference(&choice, cases[k].t, q, NULL), BAUM_ERR_UNSUPPORTED,
                cases[k].message);
    assert_int_equal(baum_catalog_reference(&usual, 1.0, q, NULL), BAUM_OK);
  }
}

static void a_study_takes_a_formula_as_its_solution(void **state)
{
  (void)state;
  baum_study_solution_fn *solution = baum_catalog_solution;
  baum_catalog_choice driven = {.name = "slider_crank_driven"};
  double q[NQ];
  double v[NQ];
  double want[NQ];
  assert_int_equal(baum_catalog_reference(&driven, 0.0123, want, NULL), BAUM_OK);
  assert_int_equal(solution(0.0123, q, v, NULL, &driven), 0);
  assert_memory_equal(q, want, sizeof want);
  ASSERT_NEAR(v[2], 150.0, 0.0, 0.0);
  driven.name = "slider_crank";
  assert_int_equal(solution(0.0123, q, v, NULL, &driven), -1);
}

/* ---- errors ---- */

static void errors_are_differences_divided_by_scales(void **state)
{
  (void)state;
  baum_mechanism *m = build(&CRANK);
  double t[21];
  double q[2 * NQ];
  double v[2 * NQ];
  double length = 0.0;
  baum_catalog_error error;
  assert_int_equal(baum_mechanism_get_characteristic_length(m, &length), BAUM_OK);
  assert_int_equal(baum_catalog_times("slider_crank", t), BAUM_OK);
  for (int i = 0; i < 2; i++) {
    assert_int_equal(baum_catalog_reference(&CRANK, t[i], q + i * NQ, v + i * NQ), BAUM_OK);
  }
  q[0] += 1e-3 * length; /* x of the crank, in the first sample */
  q[NQ + 5] += 1e-4;     /* angle of the rod, in the second sample */
  v[NQ + 2] += 3.0;      /* angular velocity of the crank, which is 150 rad/s in this sample */
  assert_int_equal(baum_catalog_compare(&CRANK, m, t, 2, q, v, &error, sizeof error), BAUM_OK);
  ASSERT_NEAR(error.q, 1e-3, 1e-12, 0.0);
  ASSERT_NEAR(error.q_final, 1e-4, 1e-11, 0.0);
  /* Errors are divided by the largest velocity, 150.2. */
  ASSERT_NEAR(error.v, 3.0 / 150.0, 0.01, 0.0);
  assert_true(error.v == error.v_final && error.q_time == t[0] && error.v_time == t[1]);
  /* The reference gives angles, which are up to 30 rad, with 15 digits. It gives velocities with 14
   * digits. */
  assert_true(error.q_floor > 1e-15 && error.q_floor < 5e-14);
  ASSERT_NEAR(error.v_floor, 1e-14, 1e-2, 0.0);
  q[NQ] = (double)NAN;
  assert_int_equal(baum_catalog_compare(&CRANK, m, t, 2, q, NULL, &error, sizeof error), BAUM_OK);
  assert_true(isnan(error.q) && error.q_time == t[1] && isnan(error.v));
  baum_mechanism_destroy(m);
}

static void states_of_other_mechanisms_are_not_compared(void **state)
{
  (void)state;
  const baum_catalog_choice chain = {.name = "chain"};
  baum_mechanism *m = build(&chain);
  baum_mechanism *open = NULL;
  const double t = 0.0;
  double q[30] = {0.0};
  baum_catalog_error e;
  assert_int_equal(baum_mechanism_copy(m, &open), BAUM_OK);
  ASSERT_SAYS(baum_catalog_compare(&CRANK, m, &t, 1, q, q, &e, sizeof e), BAUM_ERR_ARGUMENT,
              "has 30 coordinates, but \"slider_crank\" has 9");
  ASSERT_SAYS(baum_catalog_compare(&chain, m, &t, 1, q, q, &e, sizeof e), BAUM_ERR_UNSUPPORTED,
              "no reference");
  ASSERT_SAYS(baum_catalog_compare(&CRANK, open, &t, 1, q, q, &e, sizeof e), BAUM_ERR_STATE,
              "not frozen");
  ASSERT_SAYS(baum_catalog_compare(&CRANK, NULL, &t, 1, q, q, &e, sizeof e), BAUM_ERR_ARGUMENT,
              "NULL");
  ASSERT_SAYS(baum_catalog_compare(&CRANK, m, &t, 0, q, q, &e, sizeof e), BAUM_ERR_ARGUMENT,
              "n is not positive");
  ASSERT_SAYS(baum_catalog_compare(&CRANK, m, NULL, 1, q, q, &e, sizeof e), BAUM_ERR_ARGUMENT,
              "times is NULL");
  ASSERT_SAYS(baum_catalog_compare(&CRANK, m, &t, 1, NULL, q, &e, sizeof e), BAUM_ERR_ARGUMENT,
              "q is NULL");
  baum_mechanism_destroy(open);
  baum_mechanism_destroy(m);
}

/* ---- memory ---- */

static void every_allocation_of_a_mechanism_may_fail(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  for (int32_t k = 0; k < baum_catalog_count(); k++) {
    baum_catalog_entry entry;
    assert_int_equal(baum_catalog_entry_at(k, &entry, sizeof entry), BAUM_OK);
    const baum_catalog_choice choice = {.name = entry.name};
    baum_status status = BAUM_ERR_MEMORY;
    long before = heap_blocks();
    for (long n = 0; status != BAUM_OK; n++) {
      baum_mechanism *out = NULL;
      heap_fail(n, false);
      status = baum_catalog_build(&choice, &out);
      (void)heap_stop();
      assert_true(status == BAUM_OK || (status == BAUM_ERR_MEMORY && !out));
      baum_mechanism_destroy(out);
      assert_int_equal(heap_blocks(), before);
    }
  }
}

static void references_and_errors_allocate_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  baum_mechanism *m = build(&CRANK);
  const double t = 0.0;
  double q[NQ];
  double v[NQ];
  baum_catalog_error error;
  heap_watch();
  assert_int_equal(baum_catalog_reference(&CRANK, t, q, v), BAUM_OK);
  assert_int_equal(baum_catalog_compare(&CRANK, m, &t, 1, q, v, &error, sizeof error), BAUM_OK);
  assert_int_equal(heap_stop(), 0);
  assert_true(error.q == 0.0 && error.v == 0.0);
  baum_mechanism_destroy(m);
}

/* ---- messages and elements ---- */

static void other_libraries_can_set_the_message(void **state)
{
  (void)state;
  assert_int_equal(baum_fail(BAUM_ERR_STEP, "the 100 % message"), BAUM_ERR_STEP);
  assert_string_equal(baum_message(), "the 100 % message");
  assert_int_equal(baum_fail(BAUM_ERR_STEP, NULL), BAUM_ERR_STEP);
  assert_string_equal(baum_message(), baum_status_text(BAUM_ERR_STEP));
}

static void elements_are_found_in_order_and_by_name(void **state)
{
  (void)state;
  const baum_catalog_choice andrews = {.name = "andrews_bodies"};
  baum_mechanism *m = build(&andrews);
  assert_int_equal(baum_mechanism_body_count(m), 7);
  assert_int_equal(baum_mechanism_joint_count(m), 10);
  assert_int_equal(baum_mechanism_force_count(m), 2);
  assert_string_equal(baum_mechanism_body_name(m, baum_mechanism_body_at(m, 6)), "K7");
  assert_string_equal(baum_mechanism_joint_name(m, baum_mechanism_joint_at(m, 1)), "E");
  assert_string_equal(baum_mechanism_force_name(m, baum_mechanism_force_at(m, 1)), "motor");
  assert_int_equal(baum_mechanism_find_body(m, "K2").index1, 2);
  assert_int_equal(baum_mechanism_find_body(m, "ground").index1, BAUM_GROUND.index1);
  assert_int_equal(baum_mechanism_find_joint(m, "F6").index1, 10);
  assert_int_equal(baum_mechanism_find_force(m, "spring").index1, 1);
  int32_t first = -1;
  assert_int_equal(baum_mechanism_columns(m, baum_mechanism_find_body(m, "K2"), &first, NULL),
                   BAUM_OK);
  assert_int_equal(first, 3);
  baum_mechanism_destroy(m);
}

static void inputs_are_found_by_name(void **state)
{
  (void)state;
  baum_input_id torque;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_input(m, "force", 0.0, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_add_input(m, "torque", 0.0, &torque), BAUM_OK);
  assert_int_equal(baum_mechanism_find_input(m, "torque").index1, torque.index1);
  assert_int_equal(baum_mechanism_find_input(m, "torque").tag, torque.tag);
  assert_int_equal(baum_mechanism_input_at(m, 1).index1, torque.index1);
  assert_int_equal(baum_mechanism_input_at(m, 2).index1, 0);
  assert_int_equal(baum_mechanism_find_input(m, "speed").index1, 0);
  baum_mechanism_destroy(m);
}

static void indices_and_names_of_missing_elements_give_no_element(void **state)
{
  (void)state;
  baum_mechanism *m = build(&CRANK);
  for (int k = 0; k < 2; k++) {
    const baum_mechanism *of = k == 0 ? m : NULL;
    assert_int_equal(baum_mechanism_body_at(of, k == 0 ? 3 : 0).index1, 0);
    assert_int_equal(baum_mechanism_body_at(of, -1).index1, 0);
    assert_int_equal(baum_mechanism_joint_at(of, k == 0 ? 4 : 0).index1, 0);
    assert_int_equal(baum_mechanism_force_at(of, 0).index1, 0);
    assert_int_equal(baum_mechanism_find_body(of, "wheel").index1, 0);
    assert_int_equal(baum_mechanism_find_joint(of, "crank").index1, 0);
    assert_int_equal(baum_mechanism_find_force(of, "motor").index1, 0);
    assert_int_equal(baum_mechanism_find_body(of, NULL).index1, 0);
    assert_null(baum_mechanism_force_name(of, (baum_force_id){0}));
  }
  assert_int_equal(baum_mechanism_find_body(NULL, "ground").index1, 0);
  assert_int_equal(baum_mechanism_body_count(NULL), 0);
  assert_int_equal(baum_mechanism_joint_count(NULL), 0);
  assert_int_equal(baum_mechanism_force_count(NULL), 0);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_entry_says_what_it_is),
    cmocka_unit_test(every_parameter_changes_its_mechanism),
    cmocka_unit_test(giving_a_default_explicitly_changes_nothing),
    cmocka_unit_test(a_shorter_struct_is_filled_up_to_its_size),
    cmocka_unit_test(missing_entries_and_parameters_are_refused_by_name),
    cmocka_unit_test(parameters_out_of_range_are_refused),
    cmocka_unit_test(a_reference_that_does_not_hold_is_not_given),
    cmocka_unit_test(formulas_that_cancel_or_overflow_are_not_given),
    cmocka_unit_test(a_study_takes_a_formula_as_its_solution),
    cmocka_unit_test(errors_are_differences_divided_by_scales),
    cmocka_unit_test(states_of_other_mechanisms_are_not_compared),
    cmocka_unit_test(every_allocation_of_a_mechanism_may_fail),
    cmocka_unit_test(references_and_errors_allocate_nothing),
    cmocka_unit_test(other_libraries_can_set_the_message),
    cmocka_unit_test(elements_are_found_in_order_and_by_name),
    cmocka_unit_test(inputs_are_found_by_name),
    cmocka_unit_test(indices_and_names_of_missing_elements_give_no_element),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
