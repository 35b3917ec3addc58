/* SPDX-License-Identifier: BSD-3-Clause */
/* For each kind of request to the library, lets the user functions fail from call number n on, with
 * every n. The request must then fail with the message of the function, and it must change nothing.
 * When the function works again, the request must succeed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "dynamics/dynamics.h"
#include "runs.h"
#include "step_mode.h"

/* ---- a bead on a hoop, which is defined only by user functions ---- */

typedef struct fault {
  int answer;   /* return value of the failing call; if 0, the call sets NaN instead */
  int64_t from; /* number of the first call that fails, or 0 if none fails */
  int64_t calls;
} fault;

static int answer(fault *f, double *out)
{
  f->calls++;
  if (f->from == 0 || f->calls < f->from) {
    return 0;
  }
  if (f->answer == 0) {
    out[0] = (double)NAN;
  }
  return f->answer;
}

static int bead_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = 2.0 + 0.5 * q[0];
  out[3] = 2.0 + 0.5 * q[0];
  return answer(user, out);
}

static int bead_constant_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  out[0] = 2.0;
  out[3] = 2.0;
  return answer(user, out);
}

static int bead_force(double t, const double *q, const double *v, const double *inputs, double *out,
                      void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  out[1] = -20.0;
  return answer(user, out);
}

static int bead_potential(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = 20.0 * q[1];
  return answer(user, out);
}

static int hoop_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = 0.5 * (q[0] * q[0] + q[1] * q[1] - 1.0);
  return answer(user, out);
}

static int hoop_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = q[0];
  out[1] = q[1];
  return answer(user, out);
}

static int hoop_nu(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  return answer(user, out);
}

static int hoop_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  (void)q;
  out[0] = -(v[0] * v[0] + v[1] * v[1]);
  return answer(user, out);
}

/* The constraint is y = 0.75 + 0.3 t. */
static int lift_phi(double t, const double *q, double *out, void *user)
{
  out[0] = q[1] - 0.75 - 0.3 * t;
  return answer(user, out);
}

static int lift_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  out[1] = 1.0;
  return answer(user, out);
}

static int lift_nu(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  out[0] = 0.3;
  return answer(user, out);
}

static int lift_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)v;
  return answer(user, out);
}

static void add_lift(baum_mechanism *m, const baum_body_id *bead, fault *f)
{
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.name = "lift";
  def.bodies = bead;
  def.body_count = 1;
  def.row_count = 1;
  def.phi = lift_phi;
  def.jacobian = lift_jacobian;
  def.nu = lift_nu;
  def.gamma = lift_gamma;
  def.user = f;
  check(baum_mechanism_add_user_constraint(m, &def, NULL));
}

static void add_hoop(baum_mechanism *m, const char *name, const baum_body_id *bead, fault *f)
{
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.name = name;
  def.bodies = bead;
  def.body_count = 1;
  def.row_count = 1;
  def.phi = hoop_phi;
  def.jacobian = hoop_jacobian;
  def.nu = hoop_nu;
  def.gamma = hoop_gamma;
  def.user = f;
  check(baum_mechanism_add_user_constraint(m, &def, NULL));
}

/* The design position of the bead. It is off the hoop, so that a run has to be assembled. */
static const double DESIGN_Q[2] = {0.48, 0.64};

typedef struct variant {
  int hoops;
  bool constant_mass;
  bool lifted; /* whether y has a driver, so that no degree of freedom remains */
} variant;

static baum_mechanism *make_bead(variant of, fault *f)
{
  baum_coordinates_def def = baum_coordinates_def_default();
  baum_body_id bead;
  def.name = "bead";
  def.size = 2;
  def.q = DESIGN_Q;
  def.mass = of.constant_mass ? bead_constant_mass : bead_mass;
  def.constant_mass = of.constant_mass;
  def.depends_on_velocity = !of.constant_mass;
  def.force = bead_force;
  def.potential = bead_potential;
  def.user = f;
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_add_coordinates(m, &def, &bead));
  for (int k = 0; k < of.hoops; k++) {
    add_hoop(m, k == 0 ? "hoop" : "other hoop", &bead, f);
  }
  if (of.lifted) {
    add_lift(m, &bead, f);
  }
  check(baum_mechanism_set_characteristic_length(m, 1.0));
  check(baum_mechanism_freeze(m));
  return m;
}

/* ---- requests to a workspace ---- */

enum { MOST_ROWS = 2, MOST_OUT = 16 };

typedef struct request {
  baum_workspace *w;
  double q[2]; /* a point off the hoop */
  double v[2];
  double out[MOST_OUT];
} request;

typedef baum_status ask(request *r);

static baum_status ask_phi(request *r)
{
  return baum_workspace_phi(r->w, 0.0, r->q, r->out);
}

static baum_status ask_jacobian(request *r)
{
  return baum_workspace_jacobian(r->w, 0.0, r->q, r->out);
}

static baum_status ask_nu(request *r)
{
  return baum_workspace_nu(r->w, 0.0, r->q, r->out);
}

static baum_status ask_mass(request *r)
{
  return baum_workspace_mass(r->w, 0.0, r->q, r->out);
}

static baum_status ask_gamma(request *r)
{
  return baum_workspace_gamma(r->w, 0.0, r->q, r->v, r->out);
}

static baum_status ask_force(request *r)
{
  return baum_workspace_force(r->w, 0.0, r->q, r->v, r->out);
}

static baum_status ask_energy(request *r)
{
  return baum_workspace_energy(r->w, 0.0, r->q, r->v, r->out, r->out + 1);
}

static baum_status ask_acceleration(request *r)
{
  return baum_workspace_acceleration(r->w, 0.0, r->q, r->v, 5.0, 5.0, r->out, r->out + 2);
}

static baum_status ask_reported(request *r)
{
  return baum_workspace_acceleration(r->w, 0.0, r->q, r->v, 0.0, 0.0, r->out, r->out + 2);
}

static baum_status ask_reaction(request *r)
{
  const double lambda[MOST_ROWS] = {3.0, 3.0};
  return baum_workspace_reaction(r->w, 0.0, r->q, lambda, (baum_joint_id){1, r->w->mechanism->tag},
                                 r->out);
}

static baum_status ask_residual(request *r)
{
  const baum_dae dae = {.index = BAUM_RESIDUAL_GGL};
  const double y[4 + 2 * MOST_ROWS] = {r->q[0], r->q[1], r->v[0], r->v[1]};
  return baum_workspace_residual(r->w, &dae, 0.0, y, y, r->out);
}

static baum_status ask_residual_jacobian(request *r)
{
  enum { SIZE = 4 + 2 * MOST_ROWS };
  static int32_t columns[SIZE + 1];
  static int32_t rows[SIZE * SIZE];
  static double values[SIZE * SIZE];
  const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX1, .alpha = 5.0, .beta = 5.0};
  const double y[SIZE] = {r->q[0], r->q[1], r->v[0], r->v[1]};
  baum_sparse out = {columns, rows, values, 0};
  baum_status status = baum_workspace_residual_jacobian(r->w, &dae, 1.0, 0.0, y, y, &out);
  memcpy(r->out, values, sizeof r->out);
  return status;
}

static baum_status ask_assemble(request *r)
{
  r->v[1] = (double)NAN;
  return baum_workspace_assemble(r->w, 0.0, r->q, r->v, NULL, 0);
}

static baum_status ask_project(request *r)
{
  return baum_workspace_project(r->w, 0.0, r->q, r->v);
}

static ask *const ASKS[] = {
  ask_phi,          ask_jacobian, ask_nu,       ask_mass,     ask_gamma,
  ask_force,        ask_energy,   ask_reaction, ask_residual, ask_residual_jacobian,
  ask_acceleration, ask_reported, ask_assemble, ask_project};
enum { ASK_COUNT = sizeof ASKS / sizeof *ASKS };

static request request_of(baum_workspace *w)
{
  return (request){.w = w, .q = {0.606, 0.808}, .v = {-0.8, 0.63}};
}

/* ---- failures and how they are reported ---- */

static const struct {
  int answer;
  baum_status status;
  const char *message;
} FAULTS[] = {
  {-3, BAUM_ERR_CALLBACK, "returned -3 (stop)"},
  {4, BAUM_ERR_CALLBACK, "returned 4 (retry"},
  {0, BAUM_ERR_NOT_FINITE, "nan"},
};
enum { FAULT_COUNT = 3 };

/* Checks that numbers are equal. Two NaN count as equal: one velocity of the mechanism is NaN,
 * because it is free. */
static void assert_same_numbers(const double *got, const double *want, int count)
{
  for (int i = 0; i < count; i++) {
    if (!(isnan(got[i]) && isnan(want[i]))) {
      ASSERT_NEAR(got[i], want[i], 1e-12, 1e-14); /* with new pivots, rounding may be different */
    }
  }
}

static void check_ask(baum_workspace *w, fault *f, int which)
{
  request want = request_of(w);
  check(ASKS[which](&want)); /* the first call computes the metric of GGL and stores it */
  want = request_of(w);
  f->calls = 0;
  check(ASKS[which](&want));
  int64_t calls = f->calls;
  for (int64_t n = 1; n <= calls * FAULT_COUNT; n++) {
    int k = (int)(n % FAULT_COUNT);
    request r = request_of(w);
    f->answer = FAULTS[k].answer;
    f->from = (n + FAULT_COUNT - 1) / FAULT_COUNT;
    f->calls = 0;
    baum_status status = ASKS[which](&r);
    f->from = 0;
    if (status != FAULTS[k].status || !strstr(baum_message(), FAULTS[k].message)) {
      fail_msg("request %d, call %lld of %lld, answer %d: %s: %s", which,
               (long long)((n + FAULT_COUNT - 1) / FAULT_COUNT), (long long)calls, FAULTS[k].answer,
               baum_status_name(status), baum_message());
    }
    request before = request_of(w);
    assert_memory_equal(r.q, before.q, sizeof r.q);
    assert_true(r.v[0] == before.v[0]);
    check(ASKS[which](&r));
    assert_same_numbers(r.q, want.q, 2);
    assert_same_numbers(r.v, want.v, 2);
    assert_same_numbers(r.out, want.out, MOST_OUT);
  }
  assert_true(calls > 0);
}

/* Tests the block solver, and both solvers of the whole system, KLU and QR. */
static void a_workspace_passes_on_every_failing_call(void **state)
{
  (void)state;
  static const baum_i_kkt_choice choices[] = {BAUM_I_KKT_AUTO, BAUM_I_KKT_KLU, BAUM_I_KKT_QR};
  for (int k = 0; k < 3; k++) {
    fault f = {0};
    baum_mechanism *m = make_bead((variant){.hoops = 1}, &f);
    baum_workspace *w = NULL;
    check(baum_i_workspace_create(m, choices[k], &w));
    for (int i = 0; i < ASK_COUNT; i++) {
      check_ask(w, &f, i);
    }
    baum_workspace_destroy(w);
    baum_mechanism_destroy(m);
  }
}

static void a_workspace_with_redundant_rows_passes_on_every_failing_call(void **state)
{
  (void)state;
  fault f = {0};
  baum_mechanism *m = make_bead((variant){.hoops = 2}, &f);
  baum_workspace *w = NULL;
  check(baum_workspace_create(m, &w));
  assert_int_equal(w->rows.count, 1);
  for (int i = 0; i < ASK_COUNT; i++) {
    check_ask(w, &f, i);
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

/* ---- runs ---- */

static bool is_done(baum_status status)
{
  return status == BAUM_OK || status == BAUM_WARNED;
}

static bool is_of_fault(baum_status status, int k)
{
  return status == FAULTS[k].status && strstr(baum_message(), FAULTS[k].message);
}

/* Tests the creation and the steps of a run, and returns whether the run could be created. If it
 * was created, it must reach the end, even if a call has failed in between. */
static bool check_run(const baum_mechanism *m, const baum_simulation_options *o, fault *f, int k)
{
  baum_simulation *run = NULL;
  baum_status status = baum_simulation_create(m, o, &run);
  if (status < BAUM_OK) {
    f->from = 0;
    if (!is_of_fault(status, k)) {
      fail_msg("%s: %s", baum_status_name(status), baum_message());
    }
    assert_null(run);
    return false;
  }
  status = baum_simulation_advance_to(run, 0.02);
  f->from = 0;
  if (!is_done(status) && !is_of_fault(status, k)) {
    fail_msg("%s: %s: %s", baum_integrator_name(o->integrator), baum_status_name(status),
             baum_message());
  }
  assert_true(isfinite(baum_simulation_q(run)[0]) && isfinite(baum_simulation_v(run)[0]));
  assert_true(is_done(baum_simulation_advance_to(run, 0.02)));
  assert_true(baum_simulation_time(run) == 0.02);
  baum_simulation_destroy(run);
  return true;
}

/* Makes call number n and all later calls fail, for several values of n. n begins at 1 and
 * increases by 1 + n / rarer. */
static void check_every_call(const baum_simulation_options *o, variant of, int64_t rarer)
{
  fault f = {.from = 0};
  baum_mechanism *m = make_bead(of, &f);
  assert_true(check_run(m, o, &f, 0));
  int64_t calls = f.calls;
  int failed = 0;
  for (int64_t n = 1; n <= calls; n += 1 + n / rarer) {
    int k = (int)(n % FAULT_COUNT);
    f = (fault){.answer = FAULTS[k].answer, .from = n};
    failed += check_run(m, o, &f, k) ? 0 : 1;
  }
  assert_in_range(failed, 10, calls - 1); /* creation fails for some n, but not for all */
  baum_mechanism_destroy(m);
}

/* Tests the block solver and KLU. The run is assembled, checked, started and advanced. */
static void a_failing_call_ends_creation_or_a_step_and_the_run_can_continue(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    for (int solver = 0; solver < 2; solver++) {
      baum_simulation_options o = step_mode_options(step_mode_at(k), 2e-3, 1e-4);
      o.solver = solver == 0 ? BAUM_SOLVER_AUTO : BAUM_SOLVER_KLU;
      o.energy_account = solver == 1;
      check_every_call(&o, (variant){.hoops = 1, .constant_mass = o.integrator == baum_rattle()},
                       20);
    }
  }
}

static void a_failing_call_in_kinematics_ends_creation_or_a_step(void **state)
{
  (void)state;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  for (int k = 1; k <= 2; k++) {
    check_every_call(&o, (variant){.hoops = k, .constant_mass = true, .lifted = true}, INT64_MAX);
  }
}

/* ---- reading from a run ---- */

typedef baum_status read_fn(baum_simulation *run, fault *f);

static baum_status read_channels(baum_simulation *run, fault *f)
{
  (void)f;
  const baum_channel channels[] = {
    baum_channel_of(BAUM_A),      baum_channel_of(BAUM_LAMBDA),
    baum_channel_of(BAUM_PHI),    baum_channel_of(BAUM_PHI_RATE),
    baum_channel_of(BAUM_ENERGY), baum_channel_of(BAUM_ENERGY_ACCOUNT),
  };
  double row[32];
  return baum_simulation_get(run, channels, 6, row);
}

static baum_status read_counters(baum_simulation *run, fault *f)
{
  (void)f;
  baum_counters out;
  return baum_simulation_counters(run, &out, sizeof out);
}

static baum_status read_account(baum_simulation *run, fault *f)
{
  (void)f;
  baum_energy_account out;
  return baum_simulation_energy_account(run, &out, sizeof out);
}

static int height(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  out[0] = q[1];
  return answer(user, out);
}

static baum_status add_event(baum_simulation *run, fault *f)
{
  baum_event_def def = baum_event_def_default();
  def.name = "level";
  def.function = height;
  def.user = f;
  return baum_simulation_add_event(run, &def, NULL);
}

/* The first call of an event function is for the present state. The other calls are for states
 * nearby, where the value need not be finite. */
static bool is_nearby(read_fn *read, int64_t call, int given)
{
  return read == add_event && call > 1 && given == 0;
}

static void reading_from_a_run_fails_if_a_user_function_fails(void **state)
{
  (void)state;
  static read_fn *const READS[] = {read_channels, read_counters, read_account, add_event};
  fault f = {.from = 0};
  baum_mechanism *m = make_bead((variant){.hoops = 1}, &f);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  o.energy_account = true;
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_step(run, 3));
  for (int i = 0; i < 4; i++) {
    f.calls = 0;
    check(READS[i](run, &f));
    int64_t calls = f.calls;
    assert_true(calls > 0);
    for (int64_t n = 1; n <= calls; n++) {
      for (int k = 0; k < FAULT_COUNT; k++) {
        f = (fault){.answer = FAULTS[k].answer, .from = n};
        baum_status status = READS[i](run, &f);
        f.from = 0;
        bool fine = is_nearby(READS[i], n, FAULTS[k].answer);
        if (fine ? status != BAUM_OK : !is_of_fault(status, k)) {
          fail_msg("read %d, call %lld of %lld, answer %d: %s: %s", i, (long long)n,
                   (long long)calls, FAULTS[k].answer, baum_status_name(status), baum_message());
        }
        check(READS[i](run, &f));
      }
    }
  }
  check(baum_simulation_step(run, 3));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_workspace_passes_on_every_failing_call),
    cmocka_unit_test(a_workspace_with_redundant_rows_passes_on_every_failing_call),
    cmocka_unit_test(a_failing_call_ends_creation_or_a_step_and_the_run_can_continue),
    cmocka_unit_test(a_failing_call_in_kinematics_ends_creation_or_a_step),
    cmocka_unit_test(reading_from_a_run_fails_if_a_user_function_fails),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
