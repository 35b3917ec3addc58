/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs a parallelogram that has three cranks and a duplicated pin, and therefore three redundant
 * rows. Every integrator, formulation and solver is used. The motion must be the same as without
 * these rows. A warning must name the joints whose multipliers are not unique. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "physics_run.h"
#include "runs.h"
#include "step_mode.h"

enum { NV = 12 };

static const double STEP = 1e-3;
static const double RTOL = 1e-7;
static const double END = 0.3; /* [s] end of the run, before the mechanism becomes flat */

static const baum_solver SOLVERS[] = {BAUM_SOLVER_AUTO, BAUM_SOLVER_BLOCK, BAUM_SOLVER_KLU,
                                      BAUM_SOLVER_QR};
enum { SOLVER_COUNT = sizeof SOLVERS / sizeof *SOLVERS };

typedef struct method {
  step_mode mode;
  baum_formulation formulation;
  baum_solver solver;
} method;

static baum_simulation_options options_of(const method *with)
{
  baum_simulation_options options = step_mode_options(with->mode, STEP, RTOL);
  options.formulation = with->formulation;
  options.solver = with->solver;
  return options;
}

typedef void method_fn(const method *with, void *context);

static void with_every_method(method_fn *act, void *context)
{
  for (int i = 0; step_mode_at(i).integrator; i++) {
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      method with = {.mode = step_mode_at(i), .formulation = (baum_formulation)f};
      for (int s = 0; s < SOLVER_COUNT; s++) {
        with.solver = SOLVERS[s];
        if (baum_integrator_offers(with.mode.integrator, with.formulation)) {
          act(&with, context);
        }
      }
    }
  }
}

static void expect(bool fine, const method *with, const char *what, double value)
{
  if (!fine) {
    fail_msg("%s, %s step, %s, solver %d: %s (%.3g)", baum_integrator_name(with->mode.integrator),
             with->mode.fixed ? "fixed" : "variable", baum_formulation_name(with->formulation),
             (int)with->solver, what, value);
  }
}

/* Tells whether one of the run's warnings contains both texts. */
static bool warns(const baum_simulation *run, int64_t count, const char *word, const char *other)
{
  bool found = false;
  baum_warning warning;
  for (int64_t k = 0; k < count; k++) {
    check(baum_simulation_warning(run, k, &warning, sizeof warning));
    found = found || (strstr(warning.text, word) && strstr(warning.text, other));
  }
  return found;
}

/* ---- redundant rows change nothing ---- */

static model make(bool redundant)
{
  const model_parallelogram_data data = {
    .which = redundant ? MODEL_THREE_CRANKS : MODEL_THIRD_BY_A_ROD,
    .angle = 1.0,
    .doubled = redundant,
  };
  model m;
  check(model_parallelogram_build_of(&data, &m));
  return m;
}

typedef struct comparison {
  model with;
  model without;
  double exact[NV]; /* the exact q at END */
  double alone[NV]; /* q at END, computed without redundant rows by the first solver */
  double own;       /* the error of `alone` */
  int count;
} comparison;

static double apart(const double a[NV], const double b[NV])
{
  double difference[NV];
  for (int i = 0; i < NV; i++) {
    difference[i] = a[i] - b[i];
  }
  return largest_of(difference, NV);
}

static void run_alone(comparison *c, const baum_simulation_options *options)
{
  baum_simulation *run = create_run(c->without.mechanism, options);
  check(baum_simulation_advance_to(run, END));
  memcpy(c->alone, baum_simulation_q(run), sizeof c->alone);
  c->own = apart(c->alone, c->exact);
  baum_simulation_destroy(run);
}

/* Returns the largest allowed difference. If different rows are omitted, the drift and the result
 * of IDA's iteration differ by a fraction of the error of the method. With a variable step, the
 * error of the method is about as large as the tolerance. */
static double allowed(const comparison *c, const method *with)
{
  return with->mode.fixed ? 1e-2 * c->own + 1e-11 : 10.0 * RTOL;
}

static void compare(const method *with, void *context)
{
  comparison *c = context;
  baum_simulation_options options = options_of(with);
  if (with->solver == SOLVERS[0]) {
    run_alone(c, &options);
  }
  baum_simulation *run = create_run(c->with.mechanism, &options);
  check(baum_simulation_advance_to(run, END));
  baum_counters counters = counters_of(run);
  double off = apart(baum_simulation_q(run), c->alone);
  if (with->solver == SOLVERS[0]) {
    printf("%-20s %-8s %-12s error %.1e, apart %.1e\n", baum_integrator_name(options.integrator),
           with->mode.fixed ? "fixed" : "variable", baum_formulation_name(with->formulation),
           c->own, off);
  }
  expect(off <= allowed(c, with), with, "redundant rows change the motion", off);
  expect(warns(run, counters.warnings, "3 redundant constraint rows among", "\"pin again\""), with,
         "no warning names the joints whose multipliers are not unique", 0.0);
  baum_simulation_destroy(run);
  c->count++;
}

static void redundant_rows_do_not_change_the_motion(void **state)
{
  (void)state;
  comparison c = {.with = make(true), .without = make(false)};
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-12;
  run_alone(&c, &options);
  memcpy(c.exact, c.alone, sizeof c.exact);
  with_every_method(compare, &c);
  assert_true(c.count >= 100);
  model_destroy(&c.with);
  model_destroy(&c.without);
}

/* ---- omitted rows are monitored ---- */

/* Makes a link whose pin to ground has two drivers. The drivers prescribe the angular velocities 2
 * rad/s and 2 rad/s + acceleration t. A second link hangs on the first one. */
static baum_mechanism *driven_twice(double acceleration)
{
  baum_mechanism *m = create_mechanism();
  baum_body_id links[3] = {BAUM_GROUND};
  baum_joint_id pins[3];
  for (int k = 1; k <= 2; k++) {
    baum_planar_body_def body = baum_planar_body_def_default();
    body.position[0] = k - 0.5;
    check(baum_mechanism_add_planar_body(m, &body, &links[k]));
    pins[k] = add_planar_pin(m, NULL, links[k - 1], links[k], k - 1.0, 0.0);
  }
  baum_driver_def motor = baum_driver_def_default();
  motor.joint = pins[1];
  motor.rate = 2.0;
  motor.name = "one motor";
  check(baum_mechanism_add_driver(m, &motor, NULL));
  motor.acceleration = acceleration;
  motor.name = "other motor";
  check(baum_mechanism_add_driver(m, &motor, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

/* [rad] difference between the angles that the two drivers prescribe at END */
static const double ANGLE = 1.0;

/* If the drivers contradict each other, the counters and a warning must report the violation. If
 * they agree, no violation may be reported. */
static void part(const method *with, void *context)
{
  const baum_mechanism *const *mechanisms = context;
  for (int k = 0; k < 2; k++) {
    baum_simulation_options options = options_of(with);
    baum_simulation *run = create_run(mechanisms[k], &options);
    check(baum_simulation_advance_to(run, END));
    baum_counters counters = counters_of(run);
    bool warned =
      warns(run, counters.warnings, "omitted redundant row of joint", "motor\" is violated");
    expect(warned == (k == 1), with, "the warning about a violated row is missing or unjustified",
           k);
    /* With methods of order 1, even consistent drivers have violations of up to 1e-2. A variable
     * step may end beyond END. */
    expect(k == 1 ? counters.max_phi >= ANGLE - 2e-2 : counters.max_phi <= 2e-2, with,
           "largest violation", counters.max_phi);
    baum_simulation_destroy(run);
  }
}

static void contradictions_of_omitted_rows_are_reported(void **state)
{
  (void)state;
  baum_mechanism *mechanisms[2] = {driven_twice(0.0), driven_twice(2.0 * ANGLE / (END * END))};
  with_every_method(part, mechanisms);
  for (int k = 0; k < 2; k++) {
    baum_mechanism_destroy(mechanisms[k]);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(redundant_rows_do_not_change_the_motion),
    cmocka_unit_test(contradictions_of_omitted_rows_are_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
