/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the messages for failures of CVODE and IDA: for every flag, and in runs with provoked
 * failures. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#if BAUM_HAVE_SUNDIALS

#include <cvode/cvode.h>
#include <ida/ida.h>

#include "construct.h"
#include "integrate/sundials_driver.h"
#include "message.h"
#include "runs.h"

/* ---- flag by flag ---- */

/* These are the flags that a step can return although no evaluation has failed. Failed evaluations
 * have their own messages. */
static const struct {
  int cvode;
  int ida;
  baum_status status;
  const char *words;
} FLAGS[] = {
  {CV_TOO_MUCH_ACC, IDA_TOO_MUCH_ACC, BAUM_ERR_STEP, "more digits than double precision has"},
  {CV_ERR_FAILURE, IDA_ERR_FAIL, BAUM_ERR_STEP, "error stays above the tolerance"},
  {CV_CONV_FAILURE, IDA_CONV_FAIL, BAUM_ERR_CONVERGENCE, "iteration does not converge"},
  {CV_TOO_CLOSE, 0, BAUM_ERR_STEP, "no first step can be found"}, /* IDA has no such flag */
  {CV_LSETUP_FAIL, IDA_LSETUP_FAIL, BAUM_ERR_SINGULAR, "cannot be factored; take"},
  {CV_LSOLVE_FAIL, IDA_LSOLVE_FAIL, BAUM_ERR_SINGULAR, "could not be solved; take"},
  {CV_NLS_FAIL, IDA_NLS_FAIL, BAUM_ERR_CONVERGENCE, "iteration failed; take"},
  {CV_ILL_INPUT, IDA_ILL_INPUT, BAUM_ERR_NOT_FINITE, "not finite; the motion grows"},
  {CV_MEM_FAIL, IDA_MEM_FAIL, BAUM_ERR_MEMORY, "out of memory"},
};
enum { FLAG_COUNT = sizeof FLAGS / sizeof *FLAGS };

static void check_flag(const char *name, int flag, baum_status status, int known)
{
  char words[40];
  (void)snprintf(words, sizeof words, "%s failed with flag %d", name, flag);
  baum_status want = known >= 0 ? FLAGS[known].status : BAUM_ERR_INTEGRATOR;
  const char *meaning = known >= 0 ? FLAGS[known].words : words;
  if (status != want || strncmp(baum_message(), "t = 0 s: ", 9) != 0 ||
      !strstr(baum_message(), name) || !strstr(baum_message(), meaning) ||
      !strstr(baum_message(), "(step 0.001 s")) {
    fail_msg("flag %d of %s: %s: %s", flag, name, baum_status_name(status), baum_message());
  }
}

static int answer;

static int give_step(void *memory, sunrealtype *step)
{
  (void)memory;
  *step = 1e-3;
  return 0;
}

static int give_flag(baum_i_sundials *run, double target, double *tau)
{
  (void)run;
  (void)target;
  (void)tau;
  return answer;
}

/* Takes a step of 0.001 s from t = 0. A function that returns `flag` replaces SUNDIALS. */
static baum_status step_with_flag(baum_i_sundials_kind kind, int flag)
{
  const baum_i_sundials_package package = {
    .kind = kind, .get_time = give_step, .get_step = give_step, .step = give_flag};
  const baum_i_sundials_method method = {
    .name = kind == BAUM_I_SUNDIALS_IDA ? "ida" : "cvode",
    .package = &package,
  };
  const baum_i_problem problem = {.rate = 1.0};
  baum_i_state state = {.t = 0.0};
  baum_i_sundials run = {.method = &method};
  answer = flag;
  return baum_i_sundials_advance(&run, &problem, &state);
}

static void every_flag_has_a_message_with_time_and_step(void **state)
{
  (void)state;
  for (int flag = CV_UNRECOGNIZED_ERR; flag < 0; flag++) {
    int known[2] = {-1, -1};
    for (int k = 0; k < FLAG_COUNT; k++) {
      known[0] = FLAGS[k].cvode == flag ? k : known[0];
      known[1] = FLAGS[k].ida == flag ? k : known[1];
    }
    check_flag("cvode", flag, step_with_flag(BAUM_I_SUNDIALS_CVODE, flag), known[0]);
    check_flag("ida", flag, step_with_flag(BAUM_I_SUNDIALS_IDA, flag), known[1]);
  }
}

/* ---- in runs ---- */

typedef enum fault {
  FAULT_NONE,
  FAULT_JUMPS, /* the force is random in t, so that iterations converge but errors are large */
  FAULT_NOISE, /* the force is random in t and q, so that iterations do not converge */
  FAULT_NAN,
  FAULT_RETRIES,
  FAULT_STOPS
} fault;

/* Returns a pseudo-random number in [-0.5, 0.5) that depends on the bits of x. */
static double noise(double x)
{
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  bits = (bits ^ (bits >> 29)) * UINT64_C(0xbf58476d1ce4e5b9);
  return (double)(bits >> 11) * 0x1p-53 - 0.5;
}

static int force(double t, const double *q, const double *v, const double *inputs, double *out,
                 void *user)
{
  const fault *now = user;
  (void)v;
  (void)inputs;
  out[0] = 0.0;
  out[1] = 0.0;
  switch (*now) {
  case FAULT_JUMPS: out[0] = 1e10 * noise(t); break;
  case FAULT_NOISE: out[0] = 1e20 * noise(q[0] + t); break;
  case FAULT_NAN: out[0] = (double)NAN; break;
  case FAULT_RETRIES: return 1;
  case FAULT_STOPS: return -1;
  case FAULT_NONE:
  default: break;
  }
  return 0;
}

static baum_mechanism *make_thrown(fault *now)
{
  baum_body_id body;
  baum_planar_particle_def particle = baum_planar_particle_def_default();
  baum_user_force_def gust = baum_user_force_def_default();
  baum_mechanism *m = create_mechanism();
  particle.velocity[0] = 1.0;
  assert_int_equal(baum_mechanism_add_planar_particle(m, &particle, &body), BAUM_OK);
  gust.name = "gust";
  gust.bodies = &body;
  gust.body_count = 1;
  gust.force = force;
  gust.user = now;
  assert_int_equal(baum_mechanism_add_user_force(m, &gust, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static const struct {
  fault fault;
  baum_status status;
  const char *words; /* parts of the message */
} PROVOKED[] = {
  {FAULT_JUMPS, BAUM_ERR_STEP, "error stays above the tolerance|(step |last good step, t = |take "},
  {FAULT_NOISE, BAUM_ERR_CONVERGENCE, "does not converge|(step |last good step, t = |take "},
  {FAULT_NAN, BAUM_ERR_NOT_FINITE, "\"gust\"|in a step of |from t = | long)|check functions"},
  {FAULT_RETRIES, BAUM_ERR_CALLBACK, "\"gust\"|returned 1 (retry)|in a step of |from t = | long)"},
  {FAULT_STOPS, BAUM_ERR_CALLBACK, "\"gust\"|returned -1 (stop)|in a step of |from t = | long)"},
};

/* Starts the fault between two calls, so that the next steps fail. When the fault has ended, the
 * run must continue from the last good state. */
static void provoke(const baum_integrator *integrator, int k)
{
  fault now = FAULT_NONE;
  baum_mechanism *m = make_thrown(&now);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.rtol = 1e-6;
  o.max_step = 0.01;
  baum_simulation *run = create_run(m, &o);
  assert_int_equal(baum_simulation_advance_to(run, 0.1), BAUM_OK);
  now = PROVOKED[k].fault;
  ASSERT_SAYS(baum_simulation_advance_to(run, 1.0), PROVOKED[k].status, PROVOKED[k].words);
  assert_non_null(strstr(baum_simulation_message(run), baum_integrator_name(integrator)));
  double t = baum_simulation_time(run);
  assert_true(t >= 0.1 && t < 1.0);
  now = FAULT_NONE;
  assert_int_equal(baum_simulation_advance_to(run, 1.5), BAUM_OK);
  if (PROVOKED[k].fault >= FAULT_NAN) { /* the other faults may have changed v in a good step */
    assert_true(fabs(baum_simulation_q(run)[0] - 1.5) <= 1e-5); /* ten times rtol */
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static void failures_that_can_be_provoked_have_their_messages(void **state)
{
  (void)state;
  const baum_integrator *const all[] = {baum_cvode_adams(), baum_cvode_bdf(), baum_ida()};
  for (int i = 0; i < 3; i++) {
    for (size_t k = 0; k < sizeof PROVOKED / sizeof *PROVOKED; k++) {
      provoke(all[i], (int)k);
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_flag_has_a_message_with_time_and_step),
    cmocka_unit_test(failures_that_can_be_provoked_have_their_messages),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

#else

#include "without_sundials.h"

#endif
