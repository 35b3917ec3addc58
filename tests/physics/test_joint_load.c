/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests loads on coordinates of joints. Such a load must accelerate a mechanism like a joint spring
 * whose law returns the opposite force or torque. With every integrator and formulation, the work
 * of a constant load must be its effort times the change of the coordinate. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "definitions.h"
#include "message.h"
#include "runs.h"
#include "step_mode.h"

enum { NQ = 14, NV = 12 };

/* ---- mechanisms ---- */

/* The kinds of joints on which the loads act, and their coordinates. */
typedef enum kind { PIN, GUIDE, HINGE, SLIDE, SLEEVE, CROSS, KINDS } kind;

static const baum_joint_coordinate coordinates[KINDS] = {
  [SLEEVE] = BAUM_COORDINATE_ANGLE, [CROSS] = BAUM_COORDINATE_ANGLE_B};

static void add_plane(baum_mechanism *m, kind which, baum_joint_id *joint)
{
  baum_body_id bodies[2];
  for (int k = 0; k < 2; k++) {
    baum_planar_body_def def = baum_planar_body_def_default();
    def.position[0] = 0.5 + k;
    def.inertia = 0.1 + 0.2 * k;
    def.angular_velocity = 2.0;
    check(baum_mechanism_add_planar_body(m, &def, &bodies[k]));
  }
  (void)add_planar_pin(m, NULL, BAUM_GROUND, bodies[0], 0.0, 0.0);
  if (which == PIN) {
    *joint = add_planar_pin(m, NULL, bodies[0], bodies[1], 1.0, 0.1);
    return;
  }
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.body_a = bodies[0];
  def.body_b = bodies[1];
  def.point[0] = 1.0;
  def.point[1] = 0.1;
  def.axis[0] = 0.8;
  def.axis[1] = 0.6;
  check(baum_mechanism_add_planar_translational(m, &def, joint));
}

#define CONNECT(NAME)                                                    \
  do {                                                                   \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default(); \
    def.body_a = bodies[0];                                              \
    def.body_b = bodies[1];                                              \
    memcpy(def.point, place, sizeof place);                              \
    memcpy(def.axis, axis, sizeof axis);                                 \
    check(baum_mechanism_add_spatial_##NAME(m, &def, joint));            \
  } while (0)

static void add_space(baum_mechanism *m, kind which, baum_joint_id *joint)
{
  static const double place[3] = {1.0, 0.1, 0.2};
  static const double axis[3] = {0.3, 0.8, -0.5};
  baum_body_id bodies[2];
  for (int k = 0; k < 2; k++) {
    baum_spatial_body_def def = baum_spatial_body_def_default();
    def.position[0] = 0.5 + k;
    def.inertia[0] = 0.2;
    def.inertia[1] = 0.3 + 0.1 * k;
    def.inertia[2] = 0.4;
    def.angular_velocity[0] = 1.0;
    def.angular_velocity[2] = 2.0;
    check(baum_mechanism_add_spatial_body(m, &def, &bodies[k]));
  }
  baum_spatial_spherical_def socket = baum_spatial_spherical_def_default();
  socket.body_a = BAUM_GROUND;
  socket.body_b = bodies[0];
  memset(socket.point, 0, sizeof socket.point);
  check(baum_mechanism_add_spatial_spherical(m, &socket, NULL));
  switch (which) {
  case HINGE: CONNECT(revolute); break;
  case SLIDE: CONNECT(prismatic); break;
  case SLEEVE: CONNECT(cylindrical); break;
  case CROSS: {
    baum_spatial_universal_def def = baum_spatial_universal_def_default();
    def.body_a = bodies[0];
    def.body_b = bodies[1];
    memcpy(def.point, place, sizeof place);
    def.axis[0] = 1.0;
    def.axis[2] = 0.0;
    def.axis_b[0] = def.axis_b[2] = 0.0;
    def.axis_b[1] = 1.0;
    check(baum_mechanism_add_spatial_universal(m, &def, joint));
    break;
  }
  case PIN:
  case GUIDE:
  case KINDS:
  default: fail();
  }
}

/* Adds two bodies and a joint between them. */
static baum_mechanism *make_pair(kind which, baum_joint_id *joint)
{
  baum_mechanism *m = create_mechanism();
  if (which == PIN || which == GUIDE) {
    add_plane(m, which, joint);
  } else {
    add_space(m, which, joint);
  }
  return m;
}

static baum_mechanism *make_loaded(kind which, double effort, double input, baum_joint_id *joint)
{
  baum_mechanism *m = make_pair(which, joint);
  baum_joint_load_def def = baum_joint_load_def_default();
  def.joint = *joint;
  def.coordinate = coordinates[which];
  def.effort = effort;
  if (!isnan(input)) {
    check(baum_mechanism_add_input(m, "throttle", input, &def.input));
  }
  check(baum_mechanism_add_joint_load(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

static int oppose(double length, double rate, double out[3], void *user)
{
  (void)length;
  (void)rate;
  out[0] = -*(const double *)user;
  return 0;
}

static baum_mechanism *make_sprung(kind which, double *effort)
{
  baum_joint_id joint;
  baum_mechanism *m = make_pair(which, &joint);
  baum_joint_spring_def def = baum_joint_spring_def_default();
  def.joint = joint;
  def.coordinate = coordinates[which];
  def.law = oppose;
  def.user = effort;
  check(baum_mechanism_add_joint_spring(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

/* ---- accelerations ---- */

/* Moves a mechanism for 0.3 s, to a configuration in which all axes have rotated. */
static void find_state(const baum_mechanism *m, double q[NQ], double v[NV])
{
  int32_t nq;
  int32_t nv;
  check(baum_mechanism_sizes(m, &nq, &nv, NULL));
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.step = 0.01;
  baum_simulation *run = create_run(m, &options);
  check(baum_simulation_advance_to(run, 0.3));
  memcpy(q, baum_simulation_q(run), (size_t)nq * sizeof *q);
  memcpy(v, baum_simulation_v(run), (size_t)nv * sizeof *v);
  baum_simulation_destroy(run);
}

static void accelerate(const baum_mechanism *m, const double q[NQ], const double v[NV],
                       double a[NV])
{
  baum_workspace *workspace = NULL;
  check(baum_workspace_create(m, &workspace));
  check(baum_workspace_acceleration(workspace, 0.0, q, v, 0.0, 0.0, a, NULL));
  baum_workspace_destroy(workspace);
}

/* Compares a load with a spring that drives the coordinate with the effort `want`. */
static void check_like_spring(kind which, double effort, double input, double want)
{
  double q[NQ] = {0.0};
  double v[NV] = {0.0};
  double got[NV] = {0.0};
  double expected[NV] = {0.0};
  baum_joint_id joint;
  baum_mechanism *loaded = make_loaded(which, effort, input, &joint);
  baum_mechanism *sprung = make_sprung(which, &want);
  find_state(loaded, q, v);
  accelerate(loaded, q, v, got);
  accelerate(sprung, q, v, expected);
  for (int i = 0; i < NV; i++) {
    ASSERT_NEAR(got[i], expected[i], 1e-13, 1e-13); /* rounding of the sums */
  }
  baum_mechanism_destroy(sprung);
  baum_mechanism_destroy(loaded);
}

static void a_load_accelerates_like_a_spring_with_the_opposite_law(void **state)
{
  (void)state;
  for (int k = 0; k < KINDS; k++) {
    check_like_spring((kind)k, 3.0, TEST_NAN, 3.0);
    check_like_spring((kind)k, -0.5, TEST_NAN, -0.5);
  }
}

static void an_input_multiplies_the_effort(void **state)
{
  (void)state;
  for (int k = 0; k < KINDS; k++) {
    check_like_spring((kind)k, 2.0, -1.5, -3.0);
    check_like_spring((kind)k, 2.0, 0.0, 0.0);
  }
}

static void a_positive_effort_drives_the_coordinate_in_its_positive_direction(void **state)
{
  (void)state;
  for (int k = 0; k < KINDS; k++) {
    double end[2];
    for (int pushed = 0; pushed <= 1; pushed++) {
      baum_joint_id joint;
      baum_mechanism *m = make_loaded((kind)k, 4.0 * pushed, TEST_NAN, &joint);
      baum_simulation_options options = baum_simulation_options_default();
      options.integrator = baum_rk4();
      options.step = 0.01;
      baum_simulation *run = create_run(m, &options);
      baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, joint);
      channel.coordinate = coordinates[k];
      double row[2];
      check(baum_simulation_advance_to(run, 0.1));
      check(baum_simulation_get(run, &channel, 1, row));
      end[pushed] = row[0];
      baum_simulation_destroy(run);
      baum_mechanism_destroy(m);
    }
    assert_true(end[1] - end[0] > 0.01);
  }
}

/* ---- work ---- */

/* Returns the difference of the work in the energy account and of effort times the change of the
 * coordinate, divided by the latter. */
static double work_error(kind which, const baum_simulation_options *options)
{
  enum { LOADS = 2, COORDINATE = 12, WIDTH = 14 };
  static const double effort = 3.0;
  double start[WIDTH];
  double end[WIDTH];
  baum_joint_id joint;
  baum_mechanism *m = make_loaded(which, -1.5 * effort, -1.0 / 1.5, &joint);
  baum_channel channels[2] = {baum_channel_of(BAUM_ENERGY_ACCOUNT),
                              baum_channel_of_joint(BAUM_JOINT_COORDINATE, joint)};
  channels[1].coordinate = coordinates[which];
  baum_simulation *run = create_run(m, options);
  check(baum_simulation_get(run, channels, 2, start));
  check(baum_simulation_advance_to(run, 0.2));
  check(baum_simulation_get(run, channels, 2, end));
  double work = effort * (end[COORDINATE] - start[COORDINATE]);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
  return fabs(end[LOADS] - work) / fabs(work);
}

static void the_work_is_effort_times_the_change_of_the_coordinate(void **state)
{
  (void)state;
  /* The largest allowed error by the order of the method, with steps of 1 ms. The first one is for
   * variable steps with rtol = 1e-8. Each limit is at least three times the largest measured value;
   * methods of order 5 and 8 differ only by rounding. */
  static const double allowed[] = {1e-6, 3e-2, 1e-4, 1e-6, 2e-7, 1e-13, 1e-13, 1e-13, 1e-13};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    const step_mode mode = step_mode_at(k);
    for (int f = BAUM_FORMULATION_DEFAULT + 1; baum_formulation_name((baum_formulation)f); f++) {
      if (!baum_integrator_offers(mode.integrator, (baum_formulation)f)) {
        continue;
      }
      baum_simulation_options options = step_mode_options(mode, 1e-3, 1e-8);
      options.formulation = (baum_formulation)f;
      options.energy_account = true;
      for (int which = 0; which < KINDS; which++) {
        double error = work_error((kind)which, &options);
        if (!(error <= allowed[mode.fixed ? baum_integrator_order(mode.integrator) : 0])) {
          fail_msg("%s, %s, %s, joint %d: the error of the work is %.3g",
                   baum_integrator_name(mode.integrator),
                   mode.fixed ? "fixed step" : "variable step",
                   baum_formulation_name((baum_formulation)f), which, error);
        }
      }
    }
  }
}

/* ---- definitions ---- */

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_joint_load(mechanism, def, NULL);
}

static void wrong_definitions_are_refused(void **state)
{
  (void)state;
  baum_joint_id joint;
  baum_joint_id foreign;
  baum_mechanism *m = make_pair(SLEEVE, &joint);
  baum_mechanism *other = make_pair(SLEEVE, &foreign);
  baum_joint_load_def def = baum_joint_load_def_default();
  def.name = "motor";
  check_refused(m, add, &def, "force 1 \"motor\": joint is none, must be given");
  def.joint = foreign;
  check_refused(m, add, &def, "force 1 \"motor\": joint is not of this mechanism");
  def.joint = baum_mechanism_joint_at(m, 0);
  check_refused(m, add, &def,
                "force 1 \"motor\": joint is joint 1 \"joint1\", a spatial spherical joint, which "
                "has no coordinate for a load");
  def.joint = joint;
  def.coordinate = BAUM_COORDINATE_ANGLE_B;
  check_refused(m, add, &def,
                "force 1 \"motor\": coordinate is \"angle_b\", but joint 2 \"joint2\", a spatial "
                "cylindrical joint, has \"displacement\", \"angle\"");
  def.coordinate = BAUM_COORDINATE_ANGLE;
  const bad_number effort = {offsetof(baum_joint_load_def, effort), TEST_NAN,
                             "force 1 \"motor\": effort is nan N m or N, must be finite"};
  check_bad_numbers(m, add, &def, sizeof def, &effort, 1);
  check(baum_mechanism_add_input(other, "gas", 1.0, &def.input));
  check_refused(m, add, &def,
                "force 1 \"motor\": input is not of this mechanism; the mechanism has no inputs, "
                "baum_mechanism_add_input() adds one before freezing");
  baum_mechanism_destroy(other);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_load_accelerates_like_a_spring_with_the_opposite_law),
    cmocka_unit_test(an_input_multiplies_the_effort),
    cmocka_unit_test(a_positive_effort_drives_the_coordinate_in_its_positive_direction),
    cmocka_unit_test(the_work_is_effort_times_the_change_of_the_coordinate),
    cmocka_unit_test(wrong_definitions_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
