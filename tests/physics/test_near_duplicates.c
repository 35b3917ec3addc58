/* SPDX-License-Identifier: BSD-3-Clause */
/* A joint that is there twice, nearly: a slider-crank with a second pin, guide or rod that is off by 1e-14 to 1e-6 in place
 * or in direction. Whichever solver is asked, accelerations are those of quadruple precision from the same M, J, g and
 * gamma, where rows less than 1e-10 apart count as one; or the run is refused, and the sentence names a joint.
 */
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

enum { NV = 9 };

static const double ROD = 2.0; /* [m] */
static const double ANGLE = 0.7;

/* ---- the mechanism ---- */

typedef enum again {
  PIN_ASIDE, /* both of its points elsewhere: rod and crank cannot turn against each other any more */
  PIN_APART,  /* one of them: contradicts the other pin */
  FOOT_ASIDE, /* both: the crank cannot turn */
  GUIDE_TURNED,
  GUIDE_APART,
  ROD_ASIDE, /* a massless rod from a point beside the crank pin, which holds for a moment */
  ROD_LONGER,
  AGAIN_COUNT
} again;

static const char *const NAMES[AGAIN_COUNT] = {
  "pin aside", "pin apart", "foot aside", "guide turned", "guide apart", "rod aside", "rod longer"};

typedef struct pose {
  double turn; /* [rad] of the rod */
  double end;  /* [m] x of the slider */
  baum_body_id crank;
  baum_body_id rod;
  baum_body_id slider;
} pose;

static baum_body_id add_body(baum_i_parts *parts, const double centre[2], double angle,
                             double inertia)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.inertia = inertia;
  memcpy(def.position, centre, sizeof def.position);
  def.angle = angle;
  return baum_i_parts_body(parts, &def, NULL, NULL);
}

static pose add_slider_crank(baum_i_parts *parts)
{
  pose p = {.turn = -asin(sin(ANGLE) / ROD)};
  double tip[2] = {cos(ANGLE), sin(ANGLE)};
  p.end = tip[0] + ROD * cos(p.turn);
  baum_i_parts_gravity(parts, 9.81);
  p.crank = add_body(parts, (double[2]){tip[0] / 2, tip[1] / 2}, ANGLE, 1.0 / 12);
  p.rod = add_body(parts, (double[2]){(tip[0] + p.end) / 2, tip[1] / 2}, p.turn, ROD * ROD / 12);
  p.slider = add_body(parts, (double[2]){p.end, 0.0}, 0.0, 0.1);
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

/* By `off` along the rod from the crank pin, in axes of the crank. */
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

static baum_mechanism *make(again which, double off)
{
  baum_mechanism *m = NULL;
  baum_i_parts parts = baum_i_parts_begin();
  pose p = add_slider_crank(&parts);
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

static bool names_a_joint(const char *sentence)
{
  static const char *const JOINTS[] = {"\"foot\"", "\"crank pin\"", "\"slider pin\"", "\"guide\"",
                                       "\"again\""};
  for (size_t k = 0; k < sizeof JOINTS / sizeof JOINTS[0]; k++) {
    if (strstr(sentence, JOINTS[k])) {
      return true;
    }
  }
  return false;
}

/* At rest, where rows that hold hardly do not contradict the others. */
static double error_of(const baum_mechanism *m, baum_simulation *run)
{
  const baum_channel channel = {.quantity = BAUM_A};
  int nv = 0;
  int nc = 0;
  double a[NV];
  double want[NV];
  double most = 0.0;
  quad_rows rows;
  baum_workspace *w = NULL;
  check(baum_mechanism_sizes(m, NULL, &nv, &nc));
  assert_int_equal(nv, NV);
  check(baum_workspace_create(m, &w));
  check(baum_simulation_get(run, &channel, 1, a));
  assert_true(quad_rows_accelerate(w, nv, nc, 0.0, baum_simulation_q(run), baum_simulation_v(run),
                                   want, &rows));
  for (int i = 0; i < NV; i++) {
    double apart = fabs(a[i] - want[i]);
    most = apart <= most ? most : apart; /* NaN stays */
  }
  baum_workspace_destroy(w);
  return most / rows.size;
}

static void judge(again which, double off, baum_solver solver, tally *t)
{
  baum_mechanism *m = make(which, off);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.step = 1e-4;
  options.solver = solver;
  baum_simulation *run = NULL;
  if (baum_simulation_create(m, &options, &run) < BAUM_OK) {
    t->refused++;
    if (!names_a_joint(baum_message())) {
      fail_msg("%s by %g, solver %d: %s", NAMES[which], off, (int)solver, baum_message());
    }
  } else {
    /* 1e-10 apart count as one row: in a guide turned by so much a moves by as much */
    double error = error_of(m, run);
    bool is_right = error <= 1e-9;
    if (!is_right) {
      printf("%s by %g, solver %d: error %.2g\n", NAMES[which], off, (int)solver, error);
    }
    t->right += is_right;
    t->wrong += !is_right;
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static void joints_that_are_there_twice_nearly_are_right_or_refused_by_name(void **state)
{
  (void)state;
  for (int solver = BAUM_SOLVER_AUTO; solver <= BAUM_SOLVER_BLOCK; solver++) {
    tally t = {0};
    for (int which = 0; which < AGAIN_COUNT; which++) {
      for (int decade = 6; decade <= 14; decade++) {
        judge((again)which, pow(10.0, -decade), (baum_solver)solver, &t);
      }
    }
    printf("solver %d: %d right, %d refused, %d wrong\n", solver, t.right, t.refused, t.wrong);
    assert_int_equal(t.wrong, 0);
    assert_true(t.right > t.refused);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(joints_that_are_there_twice_nearly_are_right_or_refused_by_name),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
