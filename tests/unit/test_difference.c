/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares finite differences with known derivatives. Errors are relative to the change of the
 * function over one scale of the coordinate. In most tests this change is about 1. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "base/message.h"
#include "mechanism/general/difference.h"
#include "point.h"
#include "user_models.h"

/* A function of the coordinate q[0], and the number of its calls. */
typedef struct curve {
  double (*value)(double x);
  int calls;
  double edge; /* the function fails for q[0] below this */
  int answer;  /* what the function returns when it fails; > 0 asks for a retry */
  double noise;
} curve;

static baum_status curve_field(const void *context, const baum_i_local *at, double *out)
{
  curve *c = *(curve *const *)context;
  c->calls++;
  if (at->q[0] < c->edge) {
    at->point->retry = c->answer > 0;
    return baum_i_fail(BAUM_ERR_CALLBACK, "refused");
  }
  out[0] = c->value(at->q[0]) + (c->calls % 2 == 0 ? c->noise : -c->noise);
  return BAUM_OK;
}

/* A state in which only the first coordinate moves. */
typedef struct stage {
  user_model model;
  test_point p;
  baum_i_local at;
  double q[2];
  double v[2];
  double scale[2];
} stage;

static void open_stage(stage *s, double q, double v, double scale)
{
  s->model = (user_model){1.0, 1.0};
  test_point_open(&s->p, user_make(&user_circle, &s->model, GIVE_NOTHING));
  s->at = baum_i_gather(&s->p.point, &s->p.mechanism->joints[0]->span);
  s->q[0] = q;
  s->v[0] = v;
  s->q[1] = 0.0;
  s->v[1] = 0.0;
  s->scale[0] = scale;
  s->scale[1] = scale;
  s->at.q = s->q;
  s->at.v = s->v;
  s->at.scale = s->scale;
}

static void close_stage(stage *s)
{
  test_point_close(&s->p);
}

static baum_status derivative(stage *s, curve *c, int order, double *out)
{
  const double direction[2] = {1.0, 0.0};
  baum_i_field field = {.evaluate = curve_field, .context = &c, .size = 1};
  baum_i_ray ray = {.dq = direction, .rate = 1.0 / s->scale[0]};
  return order == 1 ? baum_i_difference_first(&field, &ray, &s->at, out)
                    : baum_i_difference_second(&field, &ray, &s->at, out);
}

static double derivative_at(double (*value)(double x), double q, double scale, int order)
{
  stage s;
  open_stage(&s, q, 0.0, scale);
  curve c = {.value = value, .edge = -(double)INFINITY};
  double out = (double)NAN;
  assert_int_equal(derivative(&s, &c, order, &out), BAUM_OK);
  close_stage(&s);
  return out;
}

/* ---- functions ---- */

static double fifth_power(double x)
{
  return x * x * x * x * x;
}

static double bell(double x)
{
  return 1.0 / (1.0 + x * x);
}

static double three_times_as_fast(double x)
{
  return sin(3.0 * x);
}

static double million_times_as_fast(double x)
{
  return sin(1e6 * x);
}

static double straight(double x)
{
  return 3.0 * x - 7.0;
}

static double constant(double x)
{
  (void)x;
  return 12345.678;
}

/* The slope of this function changes from -1 to 1 within 1e-6. With larger steps it cannot be
 * distinguished from |x|. */
static double tiny_circle(double x)
{
  return sqrt(x * x + 1e-12);
}

/* ---- accuracy ---- */

static void first_derivatives_are_good_to_1e_12(void **state)
{
  (void)state;
  for (double x = -1.6; x < 1.7; x += 0.37) {
    ASSERT_NEAR(derivative_at(sin, x, 1.0, 1), cos(x), 0.0, 1e-12);
    ASSERT_NEAR(derivative_at(exp, x, 1.0, 1), exp(x), 1e-12, 0.0);
    ASSERT_NEAR(derivative_at(fifth_power, x, 1.0, 1), 5.0 * x * x * x * x, 1e-12, 1e-12);
    ASSERT_NEAR(derivative_at(bell, x, 1.0, 1), -2.0 * x * bell(x) * bell(x), 0.0, 1e-12);
    ASSERT_NEAR(derivative_at(three_times_as_fast, x, 1.0, 1), 3.0 * cos(3.0 * x), 0.0, 1e-12);
  }
}

static void second_derivatives_are_good_to_2e_11(void **state)
{
  (void)state;
  for (double x = -1.6; x < 1.7; x += 0.37) {
    ASSERT_NEAR(derivative_at(sin, x, 1.0, 2), -sin(x), 0.0, 2e-11);
    ASSERT_NEAR(derivative_at(exp, x, 1.0, 2), exp(x), 2e-11, 0.0);
    ASSERT_NEAR(derivative_at(fifth_power, x, 1.0, 2), 20.0 * x * x * x, 2e-11, 2e-11);
    /* The truncation error is of order 6. Relative to the derivative, it is therefore 3^6 = 729
     * times larger than for sin(x). */
    ASSERT_NEAR(derivative_at(three_times_as_fast, x, 1.0, 2), -9.0 * sin(3.0 * x), 0.0, 4e-10);
  }
}

static void derivatives_of_a_constant_are_exactly_zero(void **state)
{
  (void)state;
  ASSERT_NEAR(derivative_at(constant, 0.3, 1.0, 1), 0.0, 0.0, 0.0);
  ASSERT_NEAR(derivative_at(constant, 0.3, 1.0, 2), 0.0, 0.0, 0.0);
}

static void a_scale_a_million_times_too_large_costs_time_but_no_accuracy(void **state)
{
  (void)state;
  for (double x = -2e-6; x < 2e-6; x += 0.37e-6) {
    ASSERT_NEAR(derivative_at(million_times_as_fast, x, 1.0, 1), 1e6 * cos(1e6 * x), 0.0,
                1e6 * 1e-11);
    ASSERT_NEAR(derivative_at(million_times_as_fast, x, 1.0, 2), -1e12 * sin(1e6 * x), 0.0,
                1e12 * 1e-9);
    double radius = tiny_circle(x);
    ASSERT_NEAR(derivative_at(tiny_circle, x, 1.0, 1), x / radius, 0.0, 1e-11);
    ASSERT_NEAR(derivative_at(tiny_circle, x, 1.0, 2), 1e-12 / (radius * radius * radius), 0.0,
                1e6 * 1e-9);
  }
}

/* The step is a thousand times too small. The errors that rounding causes in the differences are
 * therefore a thousand times larger than with a good step. */
static void a_scale_a_thousand_times_too_small_costs_three_digits(void **state)
{
  (void)state;
  ASSERT_NEAR(derivative_at(sin, 0.8, 1e-3, 1), cos(0.8), 0.0, 1e-9);
}

static void ten_thousand_revolutions_do_not_spoil_the_steps(void **state)
{
  (void)state;
  double x = 1e4 * 6.283185307179586 + 0.7;
  ASSERT_NEAR(derivative_at(sin, x, 1.0, 1), cos(x), 0.0, 1e-12);
  ASSERT_NEAR(derivative_at(sin, x, 1.0, 2), -sin(x), 0.0, 2e-11);
}

static void a_line_in_any_direction_stays_accurate_after_ten_thousand_revolutions(void **state)
{
  (void)state;
  stage s;
  double x = 1e4 * 6.283185307179586 + 0.7;
  double v = 1.0 / 3.0;
  open_stage(&s, x, v, 1.0);
  curve c = {.value = sin, .edge = -(double)INFINITY};
  curve *context = &c;
  baum_i_field field = {.evaluate = curve_field, .context = &context, .size = 1};
  baum_i_ray ray = {.dq = s.v, .rate = v};
  double out;
  assert_int_equal(baum_i_difference_second(&field, &ray, &s.at, &out), BAUM_OK);
  /* q is rounded to 7e-12, and steps are v / 64 long. The direction of a step is therefore wrong by
   * about 1e-9. The steps are chosen so that they can be represented exactly. Otherwise the error
   * would be 1e-7. */
  ASSERT_NEAR(out, -v * v * sin(x), 0.0, 5e-9 * v * v);
  close_stage(&s);
}

/* ---- oscillations in time ---- */

enum { PERIODS = 6 };

/* The context is the angular frequency. */
static baum_status oscillation_field(const void *context, const baum_i_local *at, double *out)
{
  out[0] = sin(*(const double *)context * at->t);
  return BAUM_OK;
}

/* A difference with steps of a multiple of the period would be 0, or that of a slow function. */
static void periods_that_fit_into_a_step_do_not_hide_an_oscillation(void **state)
{
  (void)state;
  stage s;
  open_stage(&s, 1.0, 0.0, 1.0);
  const double periods_per_step[PERIODS] = {1.0, 1.01, 2.0, 3.01, 64.0, 1024.0};
  for (int i = 0; i < 2 * PERIODS; i++) {
    int order = 1 + i % 2;
    double step = order == 1 ? baum_i_stencil_first.step : baum_i_stencil_second.step;
    double rate = 6.283185307179586 * periods_per_step[i / 2] / step;
    const baum_i_field field = {.evaluate = oscillation_field, .context = &rate, .size = 1};
    const baum_i_ray ray = {.dt = 1.0, .rate = 1.0};
    double out;
    s.at.t = 0.7;
    assert_int_equal(order == 1 ? baum_i_difference_first(&field, &ray, &s.at, &out)
                                : baum_i_difference_second(&field, &ray, &s.at, &out),
                     BAUM_OK);
    double want = order == 1 ? rate * cos(rate * s.at.t) : -rate * rate * sin(rate * s.at.t);
    ASSERT_NEAR(out, want, 0.0, 1e-6 * pow(rate, order));
  }
  close_stage(&s);
}

/* ---- work ---- */

static int calls_of(const curve *given, double q, int order)
{
  stage s;
  curve c = *given;
  double out;
  open_stage(&s, q, 0.0, 1.0);
  (void)derivative(&s, &c, order, &out);
  close_stage(&s);
  return c.calls;
}

static void a_good_scale_takes_six_or_seven_evaluations(void **state)
{
  (void)state;
  const curve functions[] = {{.value = sin, .edge = -1e9},
                             {.value = exp, .edge = -1e9},
                             {.value = straight, .edge = -1e9},
                             {.value = constant, .edge = -1e9}};
  for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
    for (double x = -1.7; x < 1.8; x += 0.31) {
      assert_int_equal(calls_of(&functions[i], x, 1), 6);
      assert_int_equal(calls_of(&functions[i], x, 2), 7);
    }
  }
}

static void noise_at_most_doubles_the_evaluations(void **state)
{
  (void)state;
  const curve noisy = {.value = sin, .edge = -1e9, .noise = 1e-9};
  assert_in_range(calls_of(&noisy, 0.4, 1), 6, 12);
  assert_in_range(calls_of(&noisy, 0.4, 2), 7, 14);
}

/* ---- edges of the domain of a function ---- */

static void steps_shrink_near_the_edge_of_the_domain(void **state)
{
  (void)state;
  stage s;
  open_stage(&s, 1e-4, 0.0, 1.0);
  curve root = {.value = sqrt, .edge = 0.0, .answer = 1};
  double out;
  assert_int_equal(derivative(&s, &root, 1, &out), BAUM_OK);
  ASSERT_NEAR(out, 0.5 / sqrt(1e-4), 1e-10, 0.0);
  assert_int_equal(derivative(&s, &root, 2, &out), BAUM_OK);
  ASSERT_NEAR(out, -0.25 * pow(1e-4, -1.5), 1e-8, 0.0);
  assert_false(s.p.point.retry);
  close_stage(&s);
}

static void a_function_at_the_edge_of_its_domain_asks_for_a_retry(void **state)
{
  (void)state;
  stage s;
  open_stage(&s, 0.0, 0.0, 1.0);
  curve root = {.value = sqrt, .edge = 0.0, .answer = 1};
  double out;
  assert_int_equal(derivative(&s, &root, 1, &out), BAUM_ERR_CALLBACK);
  assert_true(s.p.point.retry);
  close_stage(&s);
}

static void a_function_that_returns_stop_is_not_called_again(void **state)
{
  (void)state;
  stage s;
  open_stage(&s, 1e-4, 0.0, 1.0);
  curve root = {.value = sqrt, .edge = 0.0, .answer = -1};
  double out;
  assert_int_equal(derivative(&s, &root, 1, &out), BAUM_ERR_CALLBACK);
  assert_false(s.p.point.retry);
  assert_int_equal(root.calls, 2);
  close_stage(&s);
}

/* ---- columns ---- */

/* Evaluates the functions x^2 y, sin(x + y) and x vx vy. */
static baum_status mixed_field(const void *context, const baum_i_local *at, double *out)
{
  (void)context;
  const double *q = at->q;
  const double *v = at->v;
  out[0] = q[0] * q[0] * q[1];
  out[1] = sin(q[0] + q[1]);
  out[2] = q[0] * v[0] * v[1];
  return BAUM_OK;
}

static void columns_are_derivatives_by_positions_and_by_velocities(void **state)
{
  (void)state;
  stage s;
  open_stage(&s, 0.4, -1.2, 1.0);
  s.q[1] = 0.9;
  s.v[1] = 0.5;
  baum_i_field field = {.evaluate = mixed_field, .size = 3};
  double by_q[6];
  double by_v[6];
  assert_int_equal(baum_i_difference_columns(&field, BAUM_I_VARIABLE_Q, &s.at, by_q), BAUM_OK);
  assert_int_equal(baum_i_difference_columns(&field, BAUM_I_VARIABLE_V, &s.at, by_v), BAUM_OK);
  const double want_q[6] = {2.0 * 0.4 * 0.9, 0.4 * 0.4, cos(1.3), cos(1.3), -1.2 * 0.5, 0.0};
  const double want_v[6] = {0.0, 0.0, 0.0, 0.0, 0.4 * 0.5, 0.4 * -1.2};
  for (int i = 0; i < 6; i++) {
    ASSERT_NEAR(by_q[i], want_q[i], 0.0, 1e-12);
    ASSERT_NEAR(by_v[i], want_v[i], 0.0, 1e-12);
  }
  close_stage(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(first_derivatives_are_good_to_1e_12),
    cmocka_unit_test(second_derivatives_are_good_to_2e_11),
    cmocka_unit_test(derivatives_of_a_constant_are_exactly_zero),
    cmocka_unit_test(a_scale_a_million_times_too_large_costs_time_but_no_accuracy),
    cmocka_unit_test(a_scale_a_thousand_times_too_small_costs_three_digits),
    cmocka_unit_test(ten_thousand_revolutions_do_not_spoil_the_steps),
    cmocka_unit_test(a_line_in_any_direction_stays_accurate_after_ten_thousand_revolutions),
    cmocka_unit_test(periods_that_fit_into_a_step_do_not_hide_an_oscillation),
    cmocka_unit_test(a_good_scale_takes_six_or_seven_evaluations),
    cmocka_unit_test(noise_at_most_doubles_the_evaluations),
    cmocka_unit_test(steps_shrink_near_the_edge_of_the_domain),
    cmocka_unit_test(a_function_at_the_edge_of_its_domain_asks_for_a_retry),
    cmocka_unit_test(a_function_that_returns_stop_is_not_called_again),
    cmocka_unit_test(columns_are_derivatives_by_positions_and_by_velocities),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
