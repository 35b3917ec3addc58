/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the smallest pivot. It must become small near singular configurations, but not because
 * masses differ by large factors. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "catalog/parts.h"
#include "check.h"
#include "construct.h"
#include "dynamics/dynamics.h"
#include "models.h"
#include "runs.h"

static baum_body_id add_rod(baum_i_parts *parts, double x, double y, double angle, double inertia)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.position[0] = x;
  def.position[1] = y;
  def.angle = angle;
  def.inertia = inertia;
  return baum_i_parts_body(parts, &def);
}

static double pivot_of(const baum_mechanism *m)
{
  baum_workspace *w = NULL;
  check(baum_i_workspace_create(m, BAUM_I_KKT_AUTO, &w));
  check(baum_i_find_rows(w, 0.0, m->design_q));
  check(baum_i_use_blocks(w));
  const double v[9] = {0.0};
  check(baum_i_acceleration(w, 0.0, m->design_q, v, 0.0, 0.0));
  double pivot = baum_i_smallest_pivot(w, NULL);
  check(baum_i_find_pivot(w, 0.0, m->design_q, v));
  assert_true(baum_i_smallest_pivot(w, NULL) == pivot);
  baum_workspace_destroy(w);
  return pivot;
}

/* The rods have inertias down to 1e-14 kg m^2. At 1e-12 kg m^2 and less, the block solver fails in
 * most directions of the rod. The solver of the whole system then replaces the block solver. */
static void the_pivot_of_a_pinned_rod_is_one_for_all_inertias_and_directions(void **state)
{
  (void)state;
  for (double inertia = 1.0; inertia > 1e-14; inertia /= 10.0) {
    for (int k = 0; k < 8; k++) {
      double angle = 0.2 * k;
      baum_mechanism *m = NULL;
      baum_i_parts parts = baum_i_parts_begin();
      baum_body_id rod = add_rod(&parts, 0.5 * cos(angle), 0.5 * sin(angle), angle, inertia);
      baum_i_parts_pin(&parts, NULL, (baum_i_spot){BAUM_GROUND, {0.0, 0.0}},
                       (baum_i_spot){rod, {-0.5, 0.0}});
      check(baum_i_parts_finish(&parts, &m));
      /* The tolerance is the rounding error of the pin, amplified by mass / inertia. */
      assert_true(fabs(pivot_of(m) - 1.0) <= 1e-15 / inertia + 1e-12);
      baum_mechanism_destroy(m);
    }
  }
}

static void pivots_fall_with_the_square_of_the_distance_to_a_singularity(void **state)
{
  (void)state;
  double first = 0.0;
  for (int decade = 2; decade <= 7; decade++) {
    model m;
    check(model_parallelogram_build(MODEL_TWO_CRANKS, pow(10.0, -decade), &m));
    double ratio = pivot_of(m.mechanism) * pow(10.0, 2.0 * decade);
    first = decade == 2 ? ratio : first;
    /* The tolerance allows for higher powers of the angle, and for rounding errors relative to the
     * small pivot. */
    assert_true(fabs(ratio / first - 1.0) <= 1e-3 + 1e-15 * pow(10.0, 2.0 * decade));
    model_destroy(&m);
  }
  model m;
  check(model_parallelogram_build(MODEL_TWO_CRANKS, 0.0, &m));
  assert_true(pivot_of(m.mechanism) <= 1e-14);
  model_destroy(&m);
}

/* A slider-crank with a slider of 1e-12 kg swings from a crank angle of 0.3 rad to -3.4 rad and
 * back. KLU keeps its pivots as long as they are suitable. */
static void a_light_slider_causes_few_near_singular_intervals(void **state)
{
  (void)state;
  double angle = 0.3;
  double rod_angle = -asin(sin(angle) / 2.0);
  double end = cos(angle) + 2.0 * cos(rod_angle);
  baum_mechanism *m = NULL;
  baum_i_parts parts = baum_i_parts_begin();
  baum_planar_body_def slider = baum_planar_body_def_default();
  slider.mass = 1e-12;
  slider.inertia = 1e-15;
  slider.position[0] = end;
  baum_body_id crank = add_rod(&parts, cos(angle) / 2.0, sin(angle) / 2.0, angle, 1.0 / 12.0);
  baum_body_id rod =
    add_rod(&parts, (cos(angle) + end) / 2.0, sin(angle) / 2.0, rod_angle, 4.0 / 12.0);
  baum_body_id light = baum_i_parts_body(&parts, &slider);
  baum_i_parts_gravity(&parts, 9.81);
  baum_i_parts_pin(&parts, NULL, (baum_i_spot){BAUM_GROUND, {0.0, 0.0}},
                   (baum_i_spot){crank, {-0.5, 0.0}});
  baum_i_parts_pin(&parts, NULL, (baum_i_spot){crank, {0.5, 0.0}}, (baum_i_spot){rod, {-1.0, 0.0}});
  baum_i_parts_pin(&parts, NULL, (baum_i_spot){rod, {1.0, 0.0}}, (baum_i_spot){light, {0.0, 0.0}});
  baum_i_parts_guide(&parts, NULL, light, 0.0, 0.0);
  check(baum_i_parts_finish(&parts, &m));
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_semi_implicit_euler();
  options.step = 0.005;
  baum_simulation *run = create_run(m, &options);
  check(baum_simulation_step(run, 600));
  baum_counters counters = counters_of(run);
  /* Estimates from KLU's pivots differ by a factor of 25 between configurations. If KLU kept its
   * first pivots, 12 near-singular intervals would be reported falsely. */
  assert_true(counters.near_singular_intervals <= 2);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* Adds three rods that hinges join in a chain. A light rod is between two heavy ones. The last rod
 * is slender, and its axis (2, 1, 2) / 3 is not an axis of its frame. */
static baum_mechanism *make_uneven_chain(void)
{
  static const double axes[3][3] = {{-0.4, 1.2, 1.4}, {-0.9, -0.9, -1.0}, {-0.6, -1.1, -1.2}};
  static const double rods[3][3] = {{0.1, 0.1, -0.1}, {0.2, 0.0, 0.0}, {-0.2, 0.1, 0.0}};
  static const double masses[3] = {500.0, 0.01, 500.0};
  const double axial = 1.0 - 1e-9; /* 1 minus the ratio of the moments of inertia */
  const double slender[6] = {9.0 - 4.0 * axial, 9.0 - axial,  9.0 - 4.0 * axial,
                             -2.0 * axial,      -4.0 * axial, -2.0 * axial};
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -9.81));
  baum_spatial_revolute_def hinge = baum_spatial_revolute_def_default();
  hinge.body_a = BAUM_GROUND;
  hinge.point[0] = hinge.point[1] = hinge.point[2] = 0.0;
  for (int k = 0; k < 3; k++) {
    baum_spatial_body_def rod = baum_spatial_body_def_default();
    rod.mass = masses[k];
    for (int i = 0; i < 6; i++) {
      double compact = i < 3 ? 9.0 : 0.0;
      rod.inertia[i] = 0.01 * masses[k] * (k == 2 ? slender[i] : compact) / 9.0;
    }
    for (int i = 0; i < 3; i++) {
      rod.position[i] = hinge.point[i] + 0.5 * rods[k][i];
      hinge.axis[i] = axes[k][i];
    }
    check(baum_mechanism_add_spatial_body(m, &rod, &hinge.body_b));
    check(baum_mechanism_add_spatial_revolute(m, &hinge, NULL));
    hinge.body_a = hinge.body_b;
    for (int i = 0; i < 3; i++) {
      hinge.point[i] += rods[k][i];
    }
  }
  check(baum_mechanism_freeze(m));
  return m;
}

/* All pivots of the block solver are at rounding level, and it gives up at some of the states. */
static void pivots_at_rounding_level_do_not_make_steps_short(void **state)
{
  (void)state;
  baum_mechanism *m = make_uneven_chain();
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk8();
  o.rtol = 1e-6;
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_advance_to(run, 2.0));
  assert_in_range(counters_of(run).steps, 1, 300);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* ---- jumps of the measure ---- */

static baum_body_id add_spatial_body(baum_mechanism *m, double mass, const double inertia[3],
                                     const double position[3], const double orientation[4])
{
  baum_spatial_body_def def = baum_spatial_body_def_default();
  baum_body_id id;
  def.mass = mass;
  memcpy(def.inertia, inertia, 3 * sizeof *inertia);
  memcpy(def.position, position, 3 * sizeof *position);
  memcpy(def.orientation, orientation, 4 * sizeof *orientation);
  check(baum_mechanism_add_spatial_body(m, &def, &id));
  return id;
}

static baum_joint_id add_hinge(baum_mechanism *m, baum_body_id a, baum_body_id b,
                               const double point[3], const double axis[3])
{
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  baum_joint_id id;
  def.body_a = a;
  def.body_b = b;
  memcpy(def.point, point, 3 * sizeof *point);
  memcpy(def.axis, axis, 3 * sizeof *axis);
  check(baum_mechanism_add_spatial_revolute(m, &def, &id));
  return id;
}

static void add_joint_spring(baum_mechanism *m, baum_joint_id joint, double stiffness,
                             double free_value)
{
  baum_joint_spring_def def = baum_joint_spring_def_default();
  def.joint = joint;
  def.stiffness = stiffness;
  def.free_value = free_value;
  check(baum_mechanism_add_joint_spring(m, &def, NULL));
}

/* Adds a particle on two rods that are almost parallel, so that rows of J are not well separated in
 * any configuration. */
static void add_particle_on_two_rods(baum_mechanism *m)
{
  baum_spatial_particle_def particle = baum_spatial_particle_def_default();
  baum_spatial_distance_def rod = baum_spatial_distance_def_default();
  particle.position[0] = 5.0;
  particle.position[2] = -1.0;
  check(baum_mechanism_add_spatial_particle(m, &particle, &rod.body_b));
  rod.body_a = BAUM_GROUND;
  for (int k = 0; k < 2; k++) {
    rod.point_a[0] = 5.0;
    rod.point_a[1] = 0.03 * k;
    rod.point_a[2] = 0.0;
    rod.point_b[0] = rod.point_b[1] = rod.point_b[2] = 0.0;
    check(baum_mechanism_add_spatial_distance(m, &rod, NULL));
  }
}

/* Makes a body on a hinge with a wound spring. */
static baum_mechanism *make_wound_body(double free_value, bool with_rods)
{
  static const double inertia[3] = {0.0334, 0.0330, 0.0239};
  static const double position[3] = {0.2222, 0.1898, -0.1342};
  static const double orientation[4] = {0.0903979, -0.5264880, 0.8139814, 0.2281948};
  static const double origin[3] = {0.0, 0.0, 0.0};
  static const double axis[3] = {-0.8754, 0.4051, 0.2637};
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, -1.026, -3.7075, 6.939));
  baum_body_id body = add_spatial_body(m, 0.11, inertia, position, orientation);
  add_joint_spring(m, add_hinge(m, BAUM_GROUND, body, origin, axis), 0.577, free_value);
  if (with_rods) {
    add_particle_on_two_rods(m);
  }
  check(baum_mechanism_freeze(m));
  return m;
}

/* Makes a chain of a hinge, a universal joint and a hinge. The first of the three bodies is almost
 * a point. */
static baum_mechanism *make_chain_with_a_point(void)
{
  static const double inertias[2][3] = {{5e-6, 5e-6, 5e-6}, {0.2, 0.2, 0.2}};
  static const double positions[3][3] = {
    {0.1, 0.1, -0.1}, {0.25, 0.15, -0.15}, {0.35, 0.15, -0.05}};
  static const double points[3][3] = {{0.0, 0.0, 0.0}, {0.2, 0.2, -0.2}, {0.3, 0.1, -0.1}};
  static const double axes[2][3] = {{-0.8, 0.7, 0.5}, {1.0, 0.9, 0.1}};
  static const double across[3] = {1.0, 0.0, 0.0};
  static const double upright[4] = {1.0, 0.0, 0.0, 0.0};
  baum_mechanism *m = create_mechanism();
  baum_spatial_universal_def universal = baum_spatial_universal_def_default();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -9.81));
  universal.body_a = add_spatial_body(m, 5.0, inertias[0], positions[0], upright);
  universal.body_b = add_spatial_body(m, 5.0, inertias[1], positions[1], upright);
  baum_body_id last = add_spatial_body(m, 5.0, inertias[1], positions[2], upright);
  memcpy(universal.point, points[1], sizeof points[1]);
  memcpy(universal.axis_b, across, sizeof across);
  baum_joint_id first = add_hinge(m, BAUM_GROUND, universal.body_a, points[0], axes[0]);
  check(baum_mechanism_add_spatial_universal(m, &universal, NULL));
  (void)add_hinge(m, universal.body_b, last, points[2], axes[1]);
  add_joint_spring(m, first, 20.0, 20.0);
  check(baum_mechanism_freeze(m));
  return m;
}

/* Checks that a run reaches `end`, and that it refuses at most `most` steps. */
static void check_run(const baum_mechanism *m, const baum_simulation_options *options, double end,
                      int most)
{
  baum_simulation *run = create_run(m, options);
  assert_true(baum_simulation_advance_to(run, end) >= BAUM_OK);
  assert_in_range(counters_of(run).rejected, 0, most);
  baum_simulation_destroy(run);
}

/* KLU's estimate falls by a factor of 4000 between neighbouring configurations, because the order
 * of its pivots changes. */
static void jumps_of_an_estimate_by_klu_do_not_end_a_run(void **state)
{
  (void)state;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk8();
  o.rtol = 1e-8;
  o.solver = BAUM_SOLVER_KLU;
  for (int k = 0; k < 80; k++) {
    bool with_rods = k >= 40;
    baum_mechanism *m = make_wound_body(10.0 + 0.01 * (k % 40), with_rods);
    check_run(m, &o, 5.0, with_rods ? 50 : 10);
    baum_mechanism_destroy(m);
  }
}

/* In some configurations, the block solver gives up and the measure of KLU replaces its pivots. */
static void a_change_of_the_measure_does_not_end_a_run(void **state)
{
  (void)state;
  baum_mechanism *m = make_chain_with_a_point();
  baum_simulation_options o = baum_simulation_options_default();
  for (int k = 0; k < 8; k++) {
    o.integrator = k % 2 == 0 ? baum_rk8() : baum_dp5();
    o.rtol = pow(10.0, -5 - k / 2);
    check_run(m, &o, 0.5, 15);
  }
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_pivot_of_a_pinned_rod_is_one_for_all_inertias_and_directions),
    cmocka_unit_test(pivots_fall_with_the_square_of_the_distance_to_a_singularity),
    cmocka_unit_test(a_light_slider_causes_few_near_singular_intervals),
    cmocka_unit_test(pivots_at_rounding_level_do_not_make_steps_short),
    cmocka_unit_test(jumps_of_an_estimate_by_klu_do_not_end_a_run),
    cmocka_unit_test(a_change_of_the_measure_does_not_end_a_run),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
