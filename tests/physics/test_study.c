/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks what a study reports: its reference, its errors, and its recommendations. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/catalog.h>

#include "models.h"
#include "study_entries.h"

enum { WIDEST = 300, SAMPLES = 20, MOST = 512 };

/* ---- references ---- */

/* Samples of the reference that a study computes, at times for which the catalogue also has a
 * reference. n counts the samples. */
typedef struct samples {
  int n;
  double t[SAMPLES];
  double q[SAMPLES * WIDEST];
  double v[SAMPLES * WIDEST];
} samples;

static void take_common(const baum_study *study, const baum_catalog_choice *choice, int nq, int nv,
                        samples *out)
{
  for (int k = 0; k < SAMPLES; k++) {
    double *q = out->q + (size_t)out->n * nq;
    double *v = out->v + (size_t)out->n * nv;
    double *t = &out->t[out->n];
    assert_int_equal(baum_study_reference_sample(study, k, t, q, v, NULL), BAUM_OK);
    out->n += baum_catalog_reference(choice, *t, NULL, NULL) == BAUM_OK;
  }
  assert_true(out->n > 0);
}

/* Runs a study of a mechanism of the catalogue. The study computes its own reference. Every study
 * needs at least one method to run, but the results of this method are not used. */
static baum_study *study_of(const baum_mechanism *mechanism, const baum_catalog_entry *entry)
{
  baum_study *study = NULL;
  baum_study_options o = small_study_options();
  o.samples = SAMPLES;
  o.validate = false;
  assert_int_equal(baum_study_create(mechanism, entry->start_time, entry->end_time, &study),
                   BAUM_OK);
  assert_int_equal(baum_study_set_options(study, &o), BAUM_OK);
  baum_simulation_options rough = baum_simulation_options_default();
  rough.integrator = baum_rk8();
  rough.rtol = 1e-3;
  assert_int_equal(baum_study_add(study, &rough), BAUM_OK);
  assert_true(baum_study_run(study) >= BAUM_OK);
  return study;
}

/* Compares the reference that the study computes with the reference of the catalogue. Also compares
 * the estimated error of the computed reference with the actual difference. */
static void check_entry(const baum_catalog_entry *entry)
{
  const baum_catalog_choice choice = {.name = entry->name};
  baum_mechanism *m = NULL;
  int32_t nq = 0;
  int32_t nv = 0;
  assert_int_equal(baum_catalog_build(&choice, &m), BAUM_OK);
  assert_int_equal(baum_mechanism_sizes(m, &nq, &nv, NULL), BAUM_OK);
  assert_true(nq <= WIDEST);
  baum_study *study = study_of(m, entry);
  samples common = {.n = 0};
  baum_study_reference r;
  assert_int_equal(baum_study_reference_read(study, &r, sizeof r), BAUM_OK);
  take_common(study, &choice, nq, nv, &common);
  baum_catalog_error error;
  assert_int_equal(
    baum_catalog_compare(&choice, m, common.t, common.n, common.q, common.v, &error, sizeof error),
    BAUM_OK);
  print_message("%-22s agrees to %4.1f digits; the catalogue states %4.1f, the study %4.1f%s\n",
                entry->name, -log10(fmax(error.q, 1e-16)), entry->digits_q, r.digits,
                r.trusted ? "" : ", untrusted");
  if (r.trusted) {
    /* The estimated error is the largest of three differences. The true error may be a few times as
     * large. */
    assert_true(error.q <= 4.0 * fmax(r.uncertainty, error.q_floor));
  }
  if (entry->smooth && entry->digits_q >= 10.5) {
    assert_true(r.trusted && error.q <= 1e-10);
  }
  baum_study_destroy(study);
  baum_mechanism_destroy(m);
}

static void computed_references_agree_with_those_of_the_catalogue(void **state)
{
  (void)state;
  for (int32_t k = 0; k < baum_catalog_count(); k++) {
    baum_catalog_entry entry;
    assert_int_equal(baum_catalog_entry_at(k, &entry, sizeof entry), BAUM_OK);
    if (entry.sample_count > 0) {
      check_entry(&entry);
    }
  }
}

/* This motion passes through a flat configuration, which is a bifurcation. The study must not trust
 * a reference that it computes there. */
static void a_motion_through_a_singular_configuration_has_no_trusted_reference(void **state)
{
  (void)state;
  model m;
  model_n_four_bar data = model_n_four_bar_a02(1);
  assert_int_equal(model_n_four_bar_build(&data, &m), BAUM_OK);
  const baum_study_options o = small_study_options();
  baum_study *study = small_study(m.mechanism, &o);
  assert_int_equal(baum_study_run(study), BAUM_WARNED);
  baum_study_reference r;
  assert_int_equal(baum_study_reference_read(study, &r, sizeof r), BAUM_OK);
  assert_false(r.trusted);
  assert_non_null(strstr(r.text, "singular"));
  for (int32_t k = 0; k < baum_study_entry_count(study); k++) {
    baum_study_entry entry = study_entry(study, k);
    assert_true(entry.untrusted);
  }
  baum_study_destroy(study);
  model_destroy(&m);
}

static void a_driven_mechanism_is_compared_with_its_kinematics(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = true}, &m), BAUM_OK);
  baum_study *study = NULL;
  assert_int_equal(baum_study_create(m.mechanism, 0.0, 0.05, &study), BAUM_OK);
  baum_study_options o = small_study_options();
  assert_int_equal(baum_study_set_options(study, &o), BAUM_OK);
  baum_simulation_options run = baum_simulation_options_default();
  run.integrator = baum_kinematics();
  assert_int_equal(baum_study_add(study, &run), BAUM_OK);
  run.integrator = baum_rk4();
  run.step = 1e-4;
  assert_int_equal(baum_study_add(study, &run), BAUM_OK);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  baum_study_reference r;
  assert_int_equal(baum_study_reference_read(study, &r, sizeof r), BAUM_OK);
  assert_non_null(strstr(r.text, "kinematics"));
  assert_true(r.digits > 10.0);
  assert_true(study_entry(study, 0).at_floor); /* accurate to rounding */
  baum_study_destroy(study);
  model_destroy(&m);
}

/* ---- entries ---- */

static int circle_solution(double t, double *q, double *v, double *lambda, void *user)
{
  (void)lambda;
  (void)user;
  q[0] = cos(t);
  q[1] = sin(t);
  v[0] = -sin(t);
  v[1] = cos(t);
  return 0;
}

/* The solution that is given to the study is the motion of a particle on a circle without gravity.
 * The particle moves at a constant 1 rad/s. */
static void errors_against_an_exact_solution_show_the_order_of_the_method(void **state)
{
  (void)state;
  const model_pendulum free_turn = {.gravity = 0.0, .x = 1.0, .v = 1.0};
  model m;
  assert_int_equal(model_pendulum_rod(&free_turn, &m), BAUM_OK);
  baum_study *study = NULL;
  assert_int_equal(baum_study_create(m.mechanism, 0.0, 5.0, &study), BAUM_OK);
  assert_int_equal(baum_study_set_solution(study, circle_solution, NULL, 12.0), BAUM_OK);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.formulation = BAUM_FORMULATION_PROJECTION;
  for (int k = 0; k < 5; k++) {
    o.step = 0.5 / (1 << k);
    assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  }
  o.step = (double)NAN;
  o.integrator = baum_rk8();
  o.rtol = 1e-13;
  assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  baum_study_method method;
  assert_int_equal(baum_study_method_at(study, 0, &method, sizeof method), BAUM_OK);
  /* The slope must be the order of rk4. The tolerance allows for error terms of higher order, which
   * matter at the largest steps. */
  assert_true(fabs(method.slope - 4.0) < 0.3);
  assert_true(fabs(method.work_per_digit - pow(10.0, 0.25)) < 0.15);
  baum_study_entry entry = study_entry(study, 5);
  /* An entry whose error is below the accuracy of the reference is at the floor. Its reported error
   * is then the accuracy that was stated for the solution. */
  assert_true(entry.at_floor && entry.error == 1e-12);
  /* The error of the multipliers is unknown, because the solution gives no multipliers. */
  assert_true(isnan(entry.error_lambda));
  baum_study_destroy(study);
  model_destroy(&m);
}

static void two_threads_give_the_same_entries_as_one(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  baum_study_options o = small_study_options();
  baum_study *one = small_study(m.mechanism, &o);
  o.threads = 2;
  baum_study *two = small_study(m.mechanism, &o);
  assert_int_equal(baum_study_run(one), BAUM_OK);
  assert_int_equal(baum_study_run(two), BAUM_OK);
  assert_same_entries(one, two);
  baum_study_destroy(one);
  baum_study_destroy(two);
  model_destroy(&m);
}

/* ---- answers ---- */

/* The front contains the entries that no other entry beats. An entry may be missing from the front
 * only if an entry of the front has at most the same cost and at most the same error. The front
 * must be ordered from cheap to accurate. */
static void check_front(const baum_study *study, const int32_t *entries, int32_t count)
{
  for (int32_t k = 0; k < baum_study_entry_count(study); k++) {
    baum_study_entry entry = study_entry(study, k);
    bool is_on = false;
    bool beaten = entry.state != BAUM_STUDY_DONE || entry.off || entry.unstable;
    for (int32_t i = 0; i < count; i++) {
      baum_study_entry on = study_entry(study, entries[i]);
      is_on = is_on || entries[i] == k;
      beaten = beaten || (entries[i] != k && on.work <= entry.work && on.error <= entry.error);
    }
    assert_true(is_on != beaten);
  }
  for (int32_t i = 1; i < count; i++) {
    assert_true(study_entry(study, entries[i]).work > study_entry(study, entries[i - 1]).work);
    assert_true(study_entry(study, entries[i]).error < study_entry(study, entries[i - 1]).error);
  }
}

static void the_front_has_exactly_the_entries_that_no_entry_beats(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  const baum_study_options o = small_study_options();
  baum_study *study = small_study(m.mechanism, &o);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  int32_t entries[MOST];
  int32_t count = 0;
  assert_int_equal(baum_study_front(study, BAUM_STUDY_WORK, MOST, entries, &count), BAUM_OK);
  assert_true(count >= 3 && count <= MOST);
  check_front(study, entries, count);
  int32_t few[2] = {-1, -1};
  int32_t same = 0;
  assert_int_equal(baum_study_front(study, BAUM_STUDY_WORK, 2, few, &same), BAUM_OK);
  assert_true(same == count && few[0] == entries[0] && few[1] == entries[1]);
  baum_study_destroy(study);
  model_destroy(&m);
}
/* Returns the error of a run with these options over a span. The reference is rk8 at rtol 1e-13. */
static double error_over(const model *m, const baum_simulation_options *best, double span)
{
  baum_study *study = NULL;
  const baum_study_options o = small_study_options();
  assert_int_equal(baum_study_create(m->mechanism, 0.0, span, &study), BAUM_OK);
  assert_int_equal(baum_study_set_options(study, &o), BAUM_OK);
  assert_int_equal(baum_study_add(study, best), BAUM_OK);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  double error = study_entry(study, 0).error;
  baum_study_destroy(study);
  return error;
}

static void recommendations_hold_over_twice_the_span(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  const baum_study_options o = small_study_options();
  baum_study *study = small_study(m.mechanism, &o);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  const double targets[] = {1e-2, 1e-4, 1e-6, 1e-8};
  for (int k = 0; k < 4; k++) {
    baum_simulation_options best;
    char why[1024] = "";
    assert_int_equal(
      baum_study_recommend(study, targets[k], BAUM_STUDY_WORK, &best, sizeof best, why, sizeof why),
      BAUM_OK);
    assert_non_null(strstr(why, baum_integrator_name(best.integrator)));
    assert_true(error_over(&m, &best, 2.0) <= targets[k]);
  }
  baum_study_destroy(study);
  model_destroy(&m);
}

static void costs_are_interpolated_between_entries_to_compare_methods(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  const baum_study_options o = small_study_options();
  baum_study *study = small_study(m.mechanism, &o);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  baum_study_entry entries[2] = {study_entry(study, 2), study_entry(study, 3)};
  int32_t method = entries[0].method;
  assert_int_equal(entries[1].method, method);
  assert_true(entries[1].error < entries[0].error);
  double cost = 0.0;
  assert_int_equal(baum_study_cost_at(study, method, sqrt(entries[0].error * entries[1].error),
                                      BAUM_STUDY_WORK, &cost),
                   BAUM_OK);
  assert_true(fabs(cost - sqrt(entries[0].work * entries[1].work)) < 1e-9 * cost);
  double ratio = 0.0;
  int32_t exact = baum_study_method_count(study) - 1; /* the last method is rk8 */
  assert_int_equal(
    baum_study_compare(study, exact, method, entries[1].error, BAUM_STUDY_WORK, &ratio), BAUM_OK);
  assert_true(ratio > 0.0 && ratio < 1.0); /* in this case order 8 is cheaper than order 4 */
  assert_int_equal(baum_study_cost_at(study, method, 1e-30, BAUM_STUDY_WORK, &cost),
                   BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "has been measured with errors from"));
  assert_int_equal(baum_study_compare(study, method, 99, 1e-6, BAUM_STUDY_WORK, &ratio),
                   BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "baum_study_compare: there is no method 99"));
  baum_study_destroy(study);
  model_destroy(&m);
}

static void a_budget_gives_the_most_accurate_entry_within_it(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  const baum_study_options o = small_study_options();
  baum_study *study = small_study(m.mechanism, &o);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  baum_simulation_options best;
  char why[1024] = "";
  baum_study_entry quickest = study_entry(study, 0);
  for (int32_t k = 0; k < baum_study_entry_count(study); k++) {
    baum_study_entry entry = study_entry(study, k);
    quickest =
      entry.state == BAUM_STUDY_DONE && !entry.off && entry.cpu < quickest.cpu ? entry : quickest;
  }
  assert_int_equal(baum_study_recommend_budget(study, 1e3, &best, sizeof best, why, sizeof why),
                   BAUM_OK);
  assert_true(error_over(&m, &best, 1.0) < 1e-10);
  assert_int_equal(
    baum_study_recommend_budget(study, 0.5 * quickest.cpu, &best, sizeof best, why, sizeof why),
    BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "the fastest takes"));
  baum_study_destroy(study);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(computed_references_agree_with_those_of_the_catalogue),
    cmocka_unit_test(a_motion_through_a_singular_configuration_has_no_trusted_reference),
    cmocka_unit_test(a_driven_mechanism_is_compared_with_its_kinematics),
    cmocka_unit_test(errors_against_an_exact_solution_show_the_order_of_the_method),
    cmocka_unit_test(two_threads_give_the_same_entries_as_one),
    cmocka_unit_test(the_front_has_exactly_the_entries_that_no_entry_beats),
    cmocka_unit_test(recommendations_hold_over_twice_the_span),
    cmocka_unit_test(costs_are_interpolated_between_entries_to_compare_methods),
    cmocka_unit_test(a_budget_gives_the_most_accurate_entry_within_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
