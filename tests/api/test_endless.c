/* SPDX-License-Identifier: BSD-3-Clause */
/* Every call must return, whatever its numbers are. It must end within max_steps, or with a failure
 * status and a message. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "construct.h"
#include "driven.h"
#include "runs.h"
#include "step_mode.h"

enum {
  MOST_STEPS = 200,
  PATIENCE = 30 /* [s] time limit of a case; normally a case takes some milliseconds */
  ,
  MOST_NV = 9
};

/* A pinned body with extreme numbers. NaN stands for the default value. */
typedef struct hostile {
  double mass;
  double inertia;
  double arm;
  double velocity[2];
  double angular_velocity;
  double step;
  double rtol;
  double t;
  double gravity;
} hostile;

#define USUAL                                                                               \
  .mass = 1.0, .inertia = 0.1, .arm = 0.5, .velocity = {NAN, NAN}, .angular_velocity = NAN, \
  .step = 1e-3, .rtol = 1e-6, .t = 0.0, .gravity = -9.81

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Woverride-init"
static const hostile CASES[] = {
  {USUAL, .velocity = {1e308, 0.0}},
  {USUAL, .velocity = {0.0, 1e308}},
  {USUAL, .velocity = {1e308, 1e308}},
  {USUAL, .velocity = {1e300, 0.0}},
  {USUAL, .velocity = {0.0, 1e300}},
  {USUAL, .velocity = {0.0, 1e160}},
  {USUAL, .angular_velocity = 1e308},
  {USUAL, .angular_velocity = 1e300},
  {USUAL, .angular_velocity = 1e160},
  {USUAL, .angular_velocity = 1e150},
  {USUAL, .angular_velocity = 1e100},
  {USUAL, .angular_velocity = 1e30},
  {USUAL, .angular_velocity = 1e308, .arm = 0.0},
  {USUAL, .angular_velocity = 1e308, .arm = 0.0, .gravity = 0.0},
  {USUAL, .angular_velocity = 1e300, .arm = 1e-300},
  {USUAL, .inertia = 1e-300},
  {USUAL, .inertia = 1e-300, .angular_velocity = 1e300},
  {USUAL, .inertia = 1e-300, .arm = 0.0},
  {USUAL, .inertia = 1e-300, .arm = 1e-150},
  {USUAL, .mass = 1e308},
  {USUAL, .mass = 1e308, .inertia = 1e308},
  {USUAL, .mass = 1e308, .inertia = 1e-300},
  {USUAL, .mass = 1e-300, .inertia = 1e-300},
  {USUAL, .mass = 1e308, .velocity = {0.0, 1e308}},
  {USUAL, .mass = 1e-300, .inertia = 1e308, .angular_velocity = 1e160},
  {USUAL, .arm = 1e300},
  {USUAL, .arm = 1e300, .angular_velocity = 1e10},
  {USUAL, .arm = 1e-300},
  {USUAL, .step = 1e-300},
  {USUAL, .step = 1e300},
  {USUAL, .step = 1e308, .angular_velocity = 1e308},
  {USUAL, .step = 1e-300, .rtol = 1e-15, .angular_velocity = 1e308},
  {USUAL, .rtol = 1e-15},
  {USUAL, .rtol = 1e-15, .angular_velocity = 1e100},
  {USUAL, .t = 1e308},
  {USUAL, .t = -1e308},
  {USUAL, .t = 1e308, .step = 1e300},
  {USUAL, .t = 1e16},
  {USUAL, .t = 1e308, .angular_velocity = 1e308, .step = 1e-300},
  {USUAL, .gravity = -1e308},
  {USUAL, .gravity = -1e300, .step = 1e-300, .rtol = 1e-15},
  {USUAL, .gravity = -1e-300},
  {USUAL, .gravity = 0.0, .angular_velocity = 1e-300},
  {USUAL, .gravity = 0.0, .angular_velocity = 5e-324, .rtol = 1e-15},
};
#pragma GCC diagnostic pop

/* ---- a case ---- */

static baum_mechanism *build(const hostile *c)
{
  baum_body_id body;
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_set_gravity(m, 0.0, c->gravity, 0.0), BAUM_OK);
  def.mass = c->mass;
  def.inertia = c->inertia;
  def.position[0] = c->arm;
  memcpy(def.velocity, c->velocity, sizeof def.velocity);
  def.angular_velocity = c->angular_velocity;
  assert_int_equal(baum_mechanism_add_planar_body(m, &def, &body), BAUM_OK);
  (void)add_planar_pin(m, NULL, BAUM_GROUND, body, 0.0, 0.0);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

/* Tells whether the state is finite and whether a failure has a message. */
static bool is_sound(const baum_simulation *run, baum_status status)
{
  const double *q = baum_simulation_q(run);
  const double *v = baum_simulation_v(run);
  bool sound = status == BAUM_OK || strlen(baum_simulation_message(run)) > 0;
  for (int i = 0; i < 3; i++) {
    sound = sound && isfinite(q[i]) && isfinite(v[i]);
  }
  return sound;
}

/* Sets another angular velocity and continues the run. */
static bool goes_on_from(baum_simulation *run, double angular_velocity)
{
  const double *q = baum_simulation_q(run);
  const double v[MOST_NV] = {NAN, NAN, angular_velocity, NAN, NAN, NAN, NAN, NAN, NAN};
  bool sound = is_sound(run, baum_simulation_set_state(run, baum_simulation_time(run), q, v));
  return sound && is_sound(run, baum_simulation_step(run, MOST_STEPS));
}

static bool is_sound_by(const baum_mechanism *m, const baum_simulation_options *o)
{
  baum_simulation *run = NULL;
  if (baum_simulation_create(m, o, &run) != BAUM_OK) {
    return strlen(baum_message()) > 0;
  }
  const double times[] = {0.1, 1e300, -0.1};
  bool sound = true;
  for (int k = 0; k < 3 && sound; k++) {
    sound = is_sound(run, baum_simulation_advance_to(run, o->start_time + times[k]));
  }
  sound = sound && goes_on_from(run, 1e155) && goes_on_from(run, 1e308);
  baum_simulation_destroy(run);
  return sound;
}

/* Runs a case in a separate process. If the case does not return, an alarm ends this process. */
static int bad_of(const baum_mechanism *m, const baum_simulation_options *o, int k)
{
  int answer = -1;
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    (void)alarm(PATIENCE);
    _exit(is_sound_by(m, o) ? 0 : 1);
  }
  assert_true(waitpid(child, &answer, 0) == child);
  if (answer != 0) {
    print_error("case %d, %s%s, %s: %s\n", k, baum_integrator_name(o->integrator),
                isnan(o->rtol) ? "" : " with rtol", baum_formulation_name(o->formulation),
                WIFSIGNALED(answer) ? "does not return" : "no message, or a state is not finite");
  }
  return answer != 0;
}

static int bad_of_mode(const baum_mechanism *m, int k, step_mode mode)
{
  int bad = 0;
  baum_simulation_options o = step_mode_options(mode, CASES[k].step, CASES[k].rtol);
  o.max_steps = MOST_STEPS;
  o.start_time = CASES[k].t;
  for (int f = BAUM_FORMULATION_DEFAULT + 1; f <= BAUM_FORMULATION_INDEX3; f++) {
    o.formulation = (baum_formulation)f;
    if (baum_integrator_offers(mode.integrator, o.formulation)) {
      bad += bad_of(m, &o, k);
    }
  }
  return bad;
}

static void every_call_returns(void **state)
{
  (void)state;
  const int count = sizeof CASES / sizeof CASES[0];
  int bad = 0;
  for (int k = 0; k < count; k++) {
    baum_mechanism *m = build(&CASES[k]);
    for (int i = 0; step_mode_at(i).integrator; i++) {
      bad += bad_of_mode(m, k, step_mode_at(i));
    }
    baum_mechanism_destroy(m);
  }
  assert_int_equal(bad, 0);
}

/* Tests kinematics in the same way, for a crank with a driver and extreme speeds. */
static void every_call_of_kinematics_returns(void **state)
{
  (void)state;
  static const double rates[] = {1e308, 1e300, 1e160, 1e150, 1e100, 1e16, 1e-160, 1e-300, 5e-324};
  static const double starts[] = {0.0, 1e16, 1e308};
  int bad = 0;
  for (int k = 0; k < 9; k++) {
    const slider_crank data = {
      .crank = 1.0, .rod = 3.0, .branch = 1, .drive = {.angle = 0.3, .rate = rates[k]}};
    baum_mechanism *m = slider_crank_make(&data);
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_kinematics();
    o.max_steps = MOST_STEPS;
    for (int i = 0; i < 3; i++) {
      o.start_time = starts[i];
      bad += bad_of(m, &o, k);
    }
    baum_mechanism_destroy(m);
  }
  assert_int_equal(bad, 0);
}

/* The message must name the quantity that is too large. */
static void a_velocity_that_overflows_is_named(void **state)
{
  (void)state;
  baum_mechanism *m = build(&CASES[0]);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk8();
  o.rtol = 1e-6;
  check_run_refused(m, &o, BAUM_ERR_NOT_FINITE,
                    "velocity of body 1 \"body1\" is 1e+308|too large for double precision");
  baum_mechanism_destroy(m);
  hostile heavy = CASES[0];
  heavy.velocity[0] = (double)NAN;
  heavy.gravity = -1e308;
  m = build(&heavy);
  check_run_refused(m, &o, BAUM_ERR_NOT_FINITE, "gravity is too large for double precision");
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_call_returns),
    cmocka_unit_test(every_call_of_kinematics_returns),
    cmocka_unit_test(a_velocity_that_overflows_is_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
