/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the reports of mechanisms whose numbers can be counted by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "models.h"
#include "user_models.h"

#define PI 3.14159265358979323846

static baum_report report_of(const baum_mechanism *m)
{
  baum_report report;
  check(baum_mechanism_report(m, &report, sizeof report));
  assert_int_equal(report.struct_size, sizeof report);
  return report;
}

/* Freezes the mechanism, computes its report and destroys it. */
static baum_report report_once(baum_mechanism *m)
{
  check(baum_mechanism_freeze(m));
  baum_report report = report_of(m);
  baum_mechanism_destroy(m);
  return report;
}

static void assert_says(const baum_report *report, const char *part)
{
  if (!strstr(report->text, part)) {
    print_error("\"%s\" is not in\n%s\n", part, report->text);
    fail();
  }
}

/* ---- parts ---- */

static baum_body_id add_body(baum_mechanism *m, const char *name, double x, double y)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.name = name;
  def.position[0] = x;
  def.position[1] = y;
  check(baum_mechanism_add_planar_body(m, &def, &id));
  return id;
}

static void pin_around(baum_mechanism *m, baum_body_id hub, int arms)
{
  for (int k = 0; k < arms; k++) {
    double c = cos(2.0 * PI * k / arms);
    double s = sin(2.0 * PI * k / arms);
    add_planar_pin(m, NULL, hub, add_body(m, NULL, 1.5 * c, 1.5 * s), c, s);
  }
}

/* ---- numbers ---- */

static void a_slider_crank_is_counted(void **state)
{
  (void)state;
  model m;
  model_slider_crank data = {.driven = true, .angle = 1.0, .doubled_guide = true};
  check(model_slider_crank_build(data, &m));
  baum_report r = report_of(m.mechanism);
  model_destroy(&m);
  assert_int_equal(r.bodies, 3);
  assert_int_equal(r.joints, 6);
  assert_int_equal(r.forces, 0);
  assert_int_equal(r.velocities, 9);
  assert_int_equal(r.rows, 11);
  assert_int_equal(r.degrees_of_freedom, 0);
  assert_int_equal(r.redundant_rows, 2);
  assert_int_equal(r.constant_rows, 10); /* all rows except the motor's */
  assert_int_equal(r.islands, 1);
  assert_int_equal(r.fixed_bodies, 0);
  assert_true(r.constant_mass && r.constant_force && r.blocks);
  /* The five nodes are three pins, a guide and the motor. The crank causes three couplings, between
   * its two pins and the motor. The rod causes one, between its two pins. The slider causes one,
   * between its pin and the guide. */
  assert_int_equal(r.nodes, 5);
  assert_int_equal(r.couplings, 5);
  assert_int_equal(r.fill, 0);
  assert_int_equal(r.most_couplings, 2);
  assert_int_equal(r.most_joints, 3);
  assert_int_equal(r.most_joined.index1, 1); /* the crank has more joints than any other body */
  assert_says(
    &r,
    "mechanism     bodies 3, joints 6, forces 0; velocities 9, rows 11, degrees of freedom 0\n");
  assert_says(&r, "islands       1, of 3 bodies, 6 joints, 11 rows\n");
  assert_says(&r, "solver        blocks, 5 nodes, 5 couplings; klu and qr where pivots are bad\n");
  assert_says(&r,
              "fill          0 of 5 couplings, at most 2 of one node; body 1 \"crank\" has most "
              "joints, 3\n");
  assert_says(&r, "10 of 11 rows have no time derivatives; 2 redundant rows");
}

/* The mechanism is a ring of n pins that is not joined to ground. Each of the first n - 3
 * eliminations adds one coupling, which connects the two neighbours of the eliminated node. */
static void fill_is_the_number_of_couplings_that_elimination_adds(void **state)
{
  (void)state;
  enum { RING = 9 };
  baum_mechanism *m = create_mechanism();
  baum_body_id bodies[RING];
  for (int k = 0; k < RING; k++) {
    bodies[k] = add_body(m, NULL, cos(2.0 * PI * k / RING), sin(2.0 * PI * k / RING));
  }
  for (int k = 0; k < RING; k++) {
    double angle = 2.0 * PI * (k + 0.5) / RING;
    add_planar_pin(m, NULL, bodies[k], bodies[(k + 1) % RING], cos(angle), sin(angle));
  }
  baum_report r = report_once(m);
  assert_int_equal(r.nodes, RING);
  assert_int_equal(r.couplings, 2 * RING - 3);
  assert_int_equal(r.fill, RING - 3);
  assert_int_equal(r.most_couplings, 2);
  assert_int_equal(r.most_joints, 2);
  assert_int_equal(r.degrees_of_freedom, 3 * RING - 2 * RING);
}

static void islands_are_counted(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_body_id a = add_body(m, NULL, 1.0, 0.0);
  baum_body_id b = add_body(m, NULL, 2.0, 0.0);
  (void)add_body(m, NULL, 5.0, 5.0);
  add_planar_pin(m, NULL, BAUM_GROUND, a, 0.0, 0.0);
  add_planar_pin(m, NULL, a, b, 1.5, 0.0);
  add_planar_pin(m, NULL, BAUM_GROUND, add_body(m, NULL, 1.0, 3.0), 0.0, 3.0);
  baum_report r = report_once(m);
  assert_int_equal(r.islands, 3);
  assert_int_equal(r.couplings, 1);
  assert_says(&r,
              "islands       3, the largest of 2 bodies, 2 joints, 4 rows; they do not couple\n");
}

static void fixed_bodies_are_reported(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_body_id low = add_body(m, "low", 0.0, -1.0);
  baum_body_id high = add_body(m, "high", 0.0, 0.0);
  add_planar_weld(m, BAUM_GROUND, low, 0.0, 0.0);
  add_planar_weld(m, low, high, 0.0, 0.0);
  pin_around(m, high, 60);
  baum_report r = report_once(m);
  assert_int_equal(r.fixed_bodies, 2);
  assert_int_equal(r.islands, 60);
  assert_int_equal(r.nodes, 60);
  assert_int_equal(r.couplings, 0);
  assert_int_equal(r.most_joints, 1); /* only moving bodies are counted */
  assert_true(r.blocks);
  assert_says(&r, "60 nodes, 0 couplings; 2 fixed bodies omitted;");
  assert_says(&r, "2 fixed bodies");
}

static void a_mechanism_without_joints_has_no_nodes(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  (void)add_body(m, NULL, 0.0, 0.0);
  baum_report r = report_once(m);
  assert_int_equal(r.nodes, 0);
  assert_int_equal(r.degrees_of_freedom, 3);
  assert_int_equal(r.most_joints, 0);
  assert_int_equal(r.most_joined.index1, 0);
}

/* ---- mechanisms that are not suitable for the block solver ---- */

static void a_hub_is_named(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_body_id hub = add_body(m, "hub", 0.0, 0.0);
  add_planar_pin(m, NULL, BAUM_GROUND, hub, 0.0, 0.0);
  pin_around(m, hub, 60);
  baum_report r = report_once(m);
  assert_false(r.blocks);
  assert_int_equal(r.nodes, 0);
  assert_int_equal(r.most_joints, 61);
  assert_int_equal(r.most_joined.index1, 1);
  assert_says(&r,
              "solver        klu on the whole system: body 1 \"hub\" has 61 joints, too many for "
              "blocks\n");
  assert_says(&r, "fill          not by blocks; body 1 \"hub\" has most joints, 61\n");
}

/* ---- mechanisms that cannot be assembled ---- */

static void a_mechanism_that_cannot_be_assembled_is_reported_too(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.body_a = BAUM_GROUND;
  rod.body_b = add_body(m, NULL, 1.0, 0.0);
  rod.point_a[0] = 0.0;
  rod.point_a[1] = 0.0;
  rod.point_b[0] = 0.0;
  rod.point_b[1] = 0.0;
  rod.length = 1.0;
  check(baum_mechanism_add_planar_distance(m, &rod, NULL));
  rod.length = 2.0;
  check(baum_mechanism_add_planar_distance(m, &rod, NULL));
  baum_report r = report_once(m);
  assert_int_equal(r.degrees_of_freedom, -1);
  assert_int_equal(r.nodes, 2);
  assert_says(&r, "rows 2\n              cannot be assembled\n");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_slider_crank_is_counted),
    cmocka_unit_test(fill_is_the_number_of_couplings_that_elimination_adds),
    cmocka_unit_test(islands_are_counted),
    cmocka_unit_test(fixed_bodies_are_reported),
    cmocka_unit_test(a_mechanism_without_joints_has_no_nodes),
    cmocka_unit_test(a_hub_is_named),
    cmocka_unit_test(a_mechanism_that_cannot_be_assembled_is_reported_too),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
