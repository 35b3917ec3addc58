/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests a slider-crank that has one joint too many. The additional pin, guide or rod is almost the
 * same as another joint. Its position or direction differs by 1e-14 to 1e-6. With every solver, a
 * run must either be refused, with a message that names a joint, or have the right accelerations.
 * The right accelerations are computed in quadruple precision for the same M, J, g and gamma. This
 * reference treats two rows as the same row if they differ by less than 1e-10. If there are initial
 * velocities, the reference first projects them so that they satisfy the rows. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "catalog/parts.h"
#include "check.h"
#include "quad_rows.h"
#include "runs.h"

enum { NV = 9 };

static const double ROD = 2.0; /* [m] */
static const double ANGLE = 0.7;

/* ---- the mechanism ---- */

typedef enum again {
  PIN_ASIDE, /* a pin whose two points are moved along the rod; it locks crank and rod */
  PIN_APART, /* a pin with only one of its two points moved; it contradicts the crank pin */
  /* a second pin near the pin "foot" to ground; both of its points are moved, so it locks the
   * crank */
  FOOT_ASIDE,
  GUIDE_TURNED,
  GUIDE_APART,
  /* a massless rod from crank to slider, on the line of the body `rod`; it fits only in this
   * configuration */
  ROD_ASIDE,
  ROD_LONGER,
  AGAIN_COUNT
} again;

static const char *const NAMES[AGAIN_COUNT] = {
  "pin aside", "pin apart", "foot aside", "guide turned", "guide apart", "rod aside", "rod longer"};

typedef struct pose {
  double turn; /* [rad] angle of the rod */
  double end;  /* [m] x of the slider */
  baum_body_id crank;
  baum_body_id rod;
  baum_body_id slider;
} pose;

/* v contains the velocities of x, of y and of the angle. */
static baum_body_id add_body(baum_i_parts *parts, const double centre[2], double angle,
                             double inertia, const double v[3])
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.inertia = inertia;
  memcpy(def.position, centre, sizeof def.position);
  def.angle = angle;
  memcpy(def.velocity, v, sizeof def.velocity);
  def.angular_velocity = v[2];
  return baum_i_parts_body(parts, &def);
}

/* `rate` is the angular velocity of the crank [rad/s]. */
static pose add_slider_crank(baum_i_parts *parts, double rate)
{
  pose p = {.turn = -asin(sin(ANGLE) / ROD)};
  double tip[2] = {cos(ANGLE), sin(ANGLE)};
  double turning = -rate * cos(ANGLE) / (ROD * cos(p.turn));
  double sliding = -rate * sin(ANGLE) - turning * ROD * sin(p.turn);
  p.end = tip[0] + ROD * cos(p.turn);
  baum_i_parts_gravity(parts, 9.81);
  p.crank = add_body(parts, (double[2]){tip[0] / 2, tip[1] / 2}, ANGLE, 1.0 / 12,
                     (double[3]){-rate * tip[1] / 2, rate * tip[0] / 2, rate});
  p.rod = add_body(parts, (double[2]){(tip[0] + p.end) / 2, tip[1] / 2}, p.turn, ROD * ROD / 12,
                   (double[3]){(sliding - rate * tip[1]) / 2, rate * tip[0] / 2, turning});
  p.slider = add_body(parts, (double[2]){p.end, 0.0}, 0.0, 0.1, (double[3]){sliding, 0.0, 0.0});
  baum_i_parts_pin(parts, "foot", (baum_i_spot){BAUM_GROUND, {0.0, 0.0}},
                   (baum_i_spot){p.crank, {-0.5, 0.0}});
  baum_i_parts_pin(parts, "crank pin", (baum_i_spot){p.crank, {0.5, 0.0}},
                   (baum_i_spot){p.rod, {-ROD / 2, 0.0}});
  baum_i_parts_pin(parts, "slider pin", (baum_i_spot){p.rod, {ROD / 2, 0.0}},
                   (baum_i_spot){p.slider, {0.0, 0.0}});
  baum_i_parts_guide(parts, "guide", p.slider, 0.0, 0.0);
  return p;
}

static void turn_guide(baum_i_parts *parts, const pose *p, double off)
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.name = "again";
  def.body_a = BAUM_GROUND;
  def.body_b = p->slider;
  def.point_a[0] = p->end;
  def.point_a[1] = def.point_b[0] = def.point_b[1] = 0.0;
  def.axis[0] = cos(off);
  def.axis[1] = sin(off);
  if (parts->status == BAUM_OK) {
    parts->status = baum_mechanism_add_planar_translational(parts->mechanism, &def, NULL);
  }
}

/* Returns a point of the crank. It is on the line of the rod, at the distance `off` from the crank
 * pin. */
static baum_i_spot beside_pin(const pose *p, double off)
{
  double between = p->turn - ANGLE;
  return (baum_i_spot){p->crank, {0.5 + off * cos(between), off * sin(between)}};
}

static void add_again(baum_i_parts *parts, const pose *p, again which, double off)
{
  baum_i_spot slider = {p->slider, {0.0, 0.0}};
  switch (which) {
  case PIN_ASIDE:
    baum_i_parts_pin(parts, "again", beside_pin(p, off),
                     (baum_i_spot){p->rod, {off - ROD / 2, 0.0}});
    break;
  case PIN_APART:
    baum_i_parts_pin(parts, "again", (baum_i_spot){p->crank, {0.5 + off, 0.0}},
                     (baum_i_spot){p->rod, {-ROD / 2, 0.0}});
    break;
  case FOOT_ASIDE:
    baum_i_parts_pin(parts, "again", (baum_i_spot){BAUM_GROUND, {off, 0.0}},
                     (baum_i_spot){p->crank, {off * cos(ANGLE) - 0.5, -off * sin(ANGLE)}});
    break;
  case GUIDE_TURNED: turn_guide(parts, p, off); break;
  case GUIDE_APART: baum_i_parts_guide(parts, "again", p->slider, off, 0.1); break;
  case ROD_ASIDE: baum_i_parts_rod(parts, "again", beside_pin(p, off), slider, ROD - off); break;
  case ROD_LONGER:
    baum_i_parts_rod(parts, "again", (baum_i_spot){p->crank, {0.5, 0.0}}, slider, ROD + off);
    break;
  case AGAIN_COUNT:
  default: fail();
  }
}

static baum_mechanism *make(again which, double off, double rate)
{
  baum_mechanism *m = NULL;
  baum_i_parts parts = baum_i_parts_begin();
  pose p = add_slider_crank(&parts, rate);
  add_again(&parts, &p, which, off);
  check(baum_i_parts_finish(&parts, &m));
  return m;
}

/* ---- verdicts ---- */

typedef struct tally {
  int right;
  int refused;
  int wrong;
} tally;

static bool names_a_joint(const char *message)
{
  static const char *const JOINTS[] = {"\"foot\"", "\"crank pin\"", "\"slider pin\"", "\"guide\"",
                                       "\"again\""};
  for (size_t k = 0; k < sizeof JOINTS / sizeof JOINTS[0]; k++) {
    if (strstr(message, JOINTS[k])) {
      return true;
    }
  }
  return false;
}

/* Returns the error of the accelerations, divided by the largest acceleration that occurs with or
 * without the constraints. */
static double error_of(const baum_mechanism *m, baum_simulation *run)
{
  const baum_channel channel = baum_channel_of(BAUM_A);
  int nv = 0;
  int nc = 0;
  double a[NV];
  double want[NV];
  double v[NV];
  double most = 0.0;
  quad_rows rows;
  baum_workspace *w = NULL;
  check(baum_mechanism_sizes(m, NULL, &nv, &nc));
  assert_int_equal(nv, NV);
  check(baum_workspace_create(m, &w));
  check(baum_simulation_get(run, &channel, 1, a));
  const double *q = baum_simulation_q(run);
  assert_true(quad_rows_project(w, nv, nc, 0.0, q, baum_simulation_v(run), v, &rows));
  assert_true(quad_rows_accelerate(w, nv, nc, 0.0, q, v, want, &rows));
  for (int i = 0; i < NV; i++) {
    double apart = fabs(a[i] - want[i]);
    most = apart <= most ? most : apart; /* this keeps NaN */
  }
  baum_workspace_destroy(w);
  return most / rows.size;
}

/* Returns the largest allowed error. At the start of a run, the library tolerates a relative
 * violation of Phi' of up to 1e-6 without a message (the constant OPEN in src/simulate/start.c).
 * Accelerations depend on the squares of velocities. The relative error of accelerations may
 * therefore be more than twice this violation. */
static double allowed(double rate)
{
  /* Rows that differ by 1e-10 may be treated as the same row. If a guide is rotated by an angle of
   * 1e-10, the accelerations change by about this fraction. */
  return rate > 0.0 ? 1e-5 : 1e-9;
}

static bool is_right(const baum_mechanism *m, baum_simulation *run, double rate, const char *name)
{
  double error = error_of(m, run);
  bool right = error <= allowed(rate);
  if (!right) {
    printf("%s, %g rad/s: error %.2g\n", name, rate, error);
  }
  return right;
}

static void judge(again which, double off, double rate, baum_solver solver, tally *t)
{
  baum_mechanism *m = make(which, off, rate);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.step = 1e-4;
  options.solver = solver;
  baum_simulation *run = NULL;
  char name[64];
  (void)snprintf(name, sizeof name, "%s by %g, solver %d", NAMES[which], off, (int)solver);
  if (baum_simulation_create(m, &options, &run) < BAUM_OK) {
    t->refused++;
    if (!names_a_joint(baum_message())) {
      fail_msg("%s: %s", name, baum_message());
    }
  } else {
    bool right = is_right(m, run, rate, name);
    t->right += right;
    t->wrong += !right;
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static void judge_all(double rate)
{
  for (int solver = BAUM_SOLVER_AUTO; solver <= BAUM_SOLVER_BLOCK; solver++) {
    tally t = {0};
    for (int which = 0; which < AGAIN_COUNT; which++) {
      for (int k = 0; k <= 16; k++) {
        judge((again)which, pow(10.0, -6.0 - 0.5 * k), rate, (baum_solver)solver, &t);
      }
    }
    printf("%g rad/s, solver %d: %d right, %d refused, %d wrong\n", rate, solver, t.right,
           t.refused, t.wrong);
    assert_int_equal(t.wrong, 0);
    assert_true(t.right > t.refused);
  }
}

static void nearly_duplicate_joints_are_right_or_refused_by_name(void **state)
{
  (void)state;
  judge_all(0.0);
}

static void nearly_duplicate_joints_in_motion_are_right_or_refused(void **state)
{
  (void)state;
  judge_all(1e-3);
  judge_all(1.0);
  judge_all(100.0);
}

/* ---- velocities that a locked mechanism cannot have ---- */

static baum_simulation *start_pendulums(const double rate[2], baum_mechanism **m)
{
  baum_i_parts parts = baum_i_parts_begin();
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-8;
  for (int k = 0; k < 2; k++) {
    baum_body_id rod = add_body(&parts, (double[2]){0.5, 0.0}, 0.0, 1.0 / 12,
                                (double[3]){0.0, rate[k] / 2, rate[k]});
    for (int i = 0; i <= k; i++) {
      baum_i_parts_pin(&parts, i ? "again" : "foot", (baum_i_spot){BAUM_GROUND, {2e-9 * i, 0.0}},
                       (baum_i_spot){rod, {2e-9 * i - 0.5, 0.0}});
    }
  }
  check(baum_i_parts_finish(&parts, m));
  return create_run(*m, &options);
}

static void velocities_of_locked_bodies_warn_if_small_and_are_refused_if_large(void **state)
{
  (void)state;
  baum_mechanism *m = NULL;
  baum_simulation *run = start_pendulums((double[2]){1.0, 1e-4}, &m);
  baum_warning warning;
  baum_counters counters = counters_of(run);
  assert_int_equal(counters.warnings, 2); /* the second warning says that one row is redundant */
  check(baum_simulation_warning(run, 0, &warning, sizeof warning));
  assert_int_equal(warning.code, BAUM_WARNING_LOOSE_VELOCITIES);
  assert_true(names_a_joint(warning.text));
  double q[6];
  double v[6];
  memcpy(q, baum_simulation_q(run), sizeof q);
  memcpy(v, baum_simulation_v(run), sizeof v);
  v[5] = 0.1;
  v[4] = 0.05;
  assert_int_equal(baum_simulation_set_state(run, 0.0, q, v), BAUM_ERR_INCONSISTENT);
  assert_true(names_a_joint(baum_message()));
  assert_true(baum_simulation_v(run)[5] == 1e-4);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* If both ends of a rod are pinned, it cannot move. Its initial velocities are rounding errors of
 * the size that a projection leaves. The library must treat the rod as being at rest, both with
 * gravity and without. */
static void velocities_of_locked_bodies_count_as_rest_if_they_are_rounding(void **state)
{
  (void)state;
  for (int with_gravity = 0; with_gravity < 2; with_gravity++) {
    baum_i_parts parts = baum_i_parts_begin();
    baum_simulation_options options = baum_simulation_options_default();
    baum_mechanism *m = NULL;
    options.integrator = baum_rk8();
    options.rtol = 1e-8;
    baum_body_id rod =
      add_body(&parts, (double[2]){0.5, 0.0}, 0.0, 1.0 / 12, (double[3]){1e-16, -3e-16, 2e-16});
    for (int end = 0; end < 2; end++) {
      baum_i_parts_pin(&parts, "end", (baum_i_spot){BAUM_GROUND, {end, 0.0}},
                       (baum_i_spot){rod, {end - 0.5, 0.0}});
    }
    check(baum_mechanism_set_gravity(parts.mechanism, 0.0, with_gravity * -9.81, 0.0));
    check(baum_i_parts_finish(&parts, &m));
    baum_simulation *run = create_run(m, &options);
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(nearly_duplicate_joints_are_right_or_refused_by_name),
    cmocka_unit_test(nearly_duplicate_joints_in_motion_are_right_or_refused),
    cmocka_unit_test(velocities_of_locked_bodies_warn_if_small_and_are_refused_if_large),
    cmocka_unit_test(velocities_of_locked_bodies_count_as_rest_if_they_are_rounding),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
