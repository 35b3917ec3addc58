/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/simulation.h>
#include <baum/spline.h>

#include "assert_near.h"
#include "construct.h"
#include "definitions.h"
#include "derivatives.h"
#include "planar_scene.h"
#include "runs.h"

static baum_joint_id pin_between(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  baum_joint_id id;
  assert_int_equal(baum_mechanism_add_planar_revolute(scene->mechanism, &def, &id), BAUM_OK);
  return id;
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_spline_driver(mechanism, def, NULL);
}

static baum_spline_driver_def spline_def_of(const double *times, const double *values,
                                            int32_t count, bool periodic)
{
  baum_spline_driver_def def = baum_spline_driver_def_default();
  def.name = "cam";
  def.times = times;
  def.values = values;
  def.count = count;
  def.periodic = periodic;
  return def;
}

/* Makes a pin with a spline driver, and opens a test point at the design configuration. The driver
 * is joint 2. */
static void open_cam(test_point *p, baum_spline_driver_def def)
{
  planar_scene scene = planar_scene_make();
  def.joint = pin_between(&scene, scene.link, scene.crank);
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point_open(p, scene.mechanism);
}

/* Reads s, s' and s'' from phi, nu and gamma of row 2, which is the driver's row. The mechanism is
 * at rest in its design configuration, where the coordinate of the pin is -1.5. */
static void motion_at(test_point *p, double t, double s[3])
{
  double rows[3];
  p->t = t;
  test_point_update(p);
  assert_int_equal(baum_i_mechanism_phi(&p->point, rows), BAUM_OK);
  s[0] = -1.1 - 0.4 - rows[2];
  assert_int_equal(baum_i_mechanism_nu(&p->point, rows), BAUM_OK);
  s[1] = rows[2];
  assert_int_equal(baum_i_mechanism_gamma(&p->point, rows), BAUM_OK);
  s[2] = rows[2];
}

/* ---- derivatives ---- */

/* Tests with differences use times from 0 s to 2 s. No knot is in this interval or near it, because
 * the third derivative of a spline jumps at knots. */
static const double FAR_TIMES[4] = {-3.0, -0.5, 2.5, 4.0};
static const double FAR_VALUES[4] = {0.3, -1.0, 2.0, 0.3};

static void add_driven_pin(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_spline_driver_def def = spline_def_of(FAR_TIMES, FAR_VALUES, 4, false);
  def.joint = pin_between(scene, a, b);
  assert_int_equal(add(scene->mechanism, &def), BAUM_OK);
  def.periodic = true;
  assert_int_equal(add(scene->mechanism, &def), BAUM_OK);
}

static void add_driven_slider(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_translational_def slider = baum_planar_translational_def_default();
  PLANAR_BETWEEN(scene, &slider, a, b);
  slider.axis[1] = -0.4;
  baum_spline_driver_def def = spline_def_of(FAR_TIMES, FAR_VALUES, 4, false);
  assert_int_equal(baum_mechanism_add_planar_translational(scene->mechanism, &slider, &def.joint),
                   BAUM_OK);
  assert_int_equal(add(scene->mechanism, &def), BAUM_OK);
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_driven_pin, false, check_joint_derivatives);
  for_each_planar_pair(add_driven_slider, false, check_joint_derivatives);
}

/* ---- the curve ---- */

/* The natural spline through three points has a closed form. The second derivative of this spline
 * at the middle point is 3 (d_1 - d_0) / (h_0 + h_1), where h_i are the lengths of the intervals
 * and d_i are the slopes of the chords over these intervals. */
static void a_natural_spline_through_three_points_has_its_closed_form(void **state)
{
  (void)state;
  const double times[3] = {1.0, 1.5, 3.5};
  const double values[3] = {0.2, 1.2, -0.8};
  const double h[2] = {0.5, 2.0};
  const double d[2] = {2.0, -1.0};
  const double middle = 3.0 * (d[1] - d[0]) / (h[0] + h[1]);
  test_point p;
  open_cam(&p, spline_def_of(times, values, 3, false));
  for (int k = 0; k <= 8; k++) {
    double x = k / 8.0;
    double s[3];
    motion_at(&p, times[0] + x * h[0], s);
    ASSERT_NEAR(s[0], values[0] + h[0] * x * d[0] + middle * h[0] * h[0] * (x * x * x - x) / 6.0,
                0.0, 1e-14); /* rounding errors of numbers near 1 */
    ASSERT_NEAR(s[1], d[0] + middle * h[0] * (3.0 * x * x - 1.0) / 6.0, 0.0, 1e-14);
    ASSERT_NEAR(s[2], middle * x, 0.0, 1e-14);
    motion_at(&p, times[2] - x * h[1], s);
    ASSERT_NEAR(s[0], values[2] - h[1] * x * d[1] + middle * h[1] * h[1] * (x * x * x - x) / 6.0,
                0.0, 1e-14);
    ASSERT_NEAR(s[1], d[1] - middle * h[1] * (3.0 * x * x - 1.0) / 6.0, 0.0, 1e-14);
    ASSERT_NEAR(s[2], middle * x, 0.0, 1e-14);
  }
  test_point_close(&p);
}

static void a_natural_spline_is_straight_outside_of_its_times(void **state)
{
  (void)state;
  const double times[3] = {1.0, 1.5, 3.5};
  const double values[3] = {0.2, 1.2, -0.8};
  test_point p;
  open_cam(&p, spline_def_of(times, values, 3, false));
  const double ends[2] = {1.0, 3.5};
  const double away[2] = {-7.0, 11.0};
  for (int k = 0; k < 2; k++) {
    double end[3];
    double far[3];
    motion_at(&p, ends[k], end);
    motion_at(&p, ends[k] + away[k], far);
    ASSERT_NEAR(end[2], 0.0, 0.0, 1e-14); /* rounding error of 3.6 */
    ASSERT_NEAR(far[0], end[0] + away[k] * end[1], 1e-14, 0.0);
    ASSERT_NEAR(far[1], end[1], 0.0, 0.0);
    ASSERT_NEAR(far[2], 0.0, 0.0, 0.0);
  }
  test_point_close(&p);
}

static const double REVOLUTION = 6.283185307179586;

enum { KNOTS = 41 };

static void sample_sine(double times[KNOTS], double values[KNOTS])
{
  for (int k = 0; k < KNOTS; k++) {
    times[k] = 0.3 + REVOLUTION * k / (KNOTS - 1);
    values[k] = sin(times[k]);
  }
}

/* A periodic spline interpolates the sine at intervals h. Its error is at most 5 h^4 / 384. The
 * errors of its derivatives are at most h^3 / 24 and 3 h^2 / 8 (Hall and Meyer 1976). The test also
 * uses times before the first knot and after the last one. */
static void a_periodic_spline_repeats_and_approximates_the_sine(void **state)
{
  (void)state;
  double times[KNOTS];
  double values[KNOTS];
  sample_sine(times, values);
  test_point p;
  open_cam(&p, spline_def_of(times, values, KNOTS, true));
  const double h = REVOLUTION / (KNOTS - 1);
  for (int k = -300; k <= 300; k++) {
    double t = 0.1 * k + 0.007;
    double s[3];
    motion_at(&p, t, s);
    ASSERT_NEAR(s[0], sin(t), 0.0, 5.0 / 384.0 * h * h * h * h + 1e-14);
    ASSERT_NEAR(s[1], cos(t), 0.0, h * h * h / 24.0);
    ASSERT_NEAR(s[2], -sin(t), 0.0, 3.0 / 8.0 * h * h);
  }
  test_point_close(&p);
}

/* Compares values 1e-12 s before and after each knot. A periodic spline continues with the next
 * period after its last knot. */
static void second_derivatives_are_continuous(void **state)
{
  (void)state;
  for (int periodic = 0; periodic < 2; periodic++) {
    test_point p;
    open_cam(&p, spline_def_of(FAR_TIMES, FAR_VALUES, 4, periodic == 1));
    for (int k = 0; k < 4; k++) {
      double before[3];
      double after[3];
      motion_at(&p, FAR_TIMES[k] - 1e-12, before);
      motion_at(&p, FAR_TIMES[k] + 1e-12, after);
      for (int i = 0; i < 3; i++) {
        /* The times differ by 2e-12 s, and derivatives are up to 20. */
        ASSERT_NEAR(before[i], after[i], 0.0, 1e-10);
      }
    }
    test_point_close(&p);
  }
}

static void overflow_is_reported_with_the_name_of_the_spline(void **state)
{
  (void)state;
  const double times[3] = {0.0, 1e-150, 2e-150};
  const double values[3] = {0.0, 1e100, 0.0};
  test_point p;
  open_cam(&p, spline_def_of(times, values, 3, false));
  double rows[3];
  p.t = 1e-150;
  test_point_update(&p);
  assert_int_equal(baum_i_mechanism_gamma(&p.point, rows), BAUM_ERR_NOT_FINITE);
  assert_non_null(strstr(baum_message(), "joint 2 \"cam\": the spline gave "));
  assert_true(p.point.retry);
  test_point_close(&p);
}

/* ---- runs ---- */

static double coordinate_of(baum_simulation *run, baum_joint_id joint)
{
  const baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, joint);
  double row[2];
  assert_int_equal(baum_simulation_get(run, &channel, 1, row), BAUM_OK);
  return row[0];
}

static void a_run_follows_the_spline_until_its_law_is_replaced(void **state)
{
  (void)state;
  const double times[3] = {0.0, 0.5, 1.5};
  const double values[3] = {-1.1, -0.7, 0.2};
  planar_scene scene = planar_scene_make();
  baum_spline_driver_def def = spline_def_of(times, values, 3, false);
  baum_joint_id cam;
  baum_joint_id pin = add_planar_pin(scene.mechanism, NULL, BAUM_GROUND, scene.crank, 0.5, 0.7);
  def.joint = pin;
  assert_int_equal(baum_mechanism_add_spline_driver(scene.mechanism, &def, &cam), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(scene.mechanism), BAUM_OK);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.formulation = BAUM_FORMULATION_PROJECTION;
  o.step = 0.01;
  baum_simulation *run = create_run(scene.mechanism, &o);
  assert_int_equal(baum_simulation_advance_to(run, 0.5), BAUM_OK);
  /* Projection satisfies the driver to rounding. */
  ASSERT_NEAR(coordinate_of(run, pin), -0.7, 1e-12, 0.0);
  assert_int_equal(baum_simulation_set_driver(run, cam, -0.7, 2.0, 0.0), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(run, 1.5), BAUM_OK);
  ASSERT_NEAR(coordinate_of(run, pin), 1.3, 1e-12, 0.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(scene.mechanism);
}

/* ---- definitions ---- */

static void the_spline_keeps_copies_of_its_arrays(void **state)
{
  (void)state;
  double times[3] = {0.0, 1.0, 2.0};
  double values[3] = {0.0, 0.5, 0.0};
  planar_scene scene = planar_scene_make();
  baum_spline_driver_def def = spline_def_of(times, values, 3, false);
  baum_spline_driver_def got;
  baum_joint_id cam;
  def.joint = pin_between(&scene, scene.link, scene.crank);
  assert_int_equal(baum_mechanism_add_spline_driver(scene.mechanism, &def, &cam), BAUM_OK);
  memset(times, 0, sizeof times);
  memset(values, 0, sizeof values);

  baum_mechanism *copy;
  assert_int_equal(baum_mechanism_copy(scene.mechanism, &copy), BAUM_OK);
  baum_mechanism_destroy(scene.mechanism);
  assert_int_equal(baum_mechanism_get_spline_driver(copy, cam, &got, sizeof got), BAUM_OK);
  assert_true(got.count == 3 && !got.periodic);
  ASSERT_NEAR(got.times[2], 2.0, 0.0, 0.0);
  ASSERT_NEAR(got.values[1], 0.5, 0.0, 0.0);

  const double other_times[4] = {0.0, 1.0, 2.0, 3.0};
  const double other_values[4] = {-1.5, 0.0, 1.0, -1.5};
  got = spline_def_of(other_times, other_values, 4, true);
  got.joint = def.joint;
  assert_int_equal(baum_mechanism_set_spline_driver(copy, cam, &got), BAUM_OK);
  test_point p;
  test_point_open(&p, copy);
  double s[3];
  motion_at(&p, 5.0, s);
  ASSERT_NEAR(s[0], 1.0, 0.0, 1e-15);
  test_point_close(&p);
}

static void wrong_curves_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  const double times[4] = {0.0, 1.0, 2.0, 3.0};
  const double values[4] = {0.0, 0.5, -1.0, 1e-13};
  const double back[4] = {0.0, 1.0, 1.0, 3.0};
  const double bad[4] = {0.0, TEST_NAN, 2.0, 3.0};
  const double huge[4] = {-1e308, 1e308, 0.0, -1e308};
  baum_joint_id pin = pin_between(&scene, scene.link, scene.crank);
  const struct {
    baum_spline_driver_def def;
    const char *message;
  } wrong[] = {
    {spline_def_of(times, values, 2, false), "joint 2 \"cam\": count is 2, must be at least 3"},
    {spline_def_of(times, values, -4, false), "joint 2 \"cam\": count is -4, must be at least 3"},
    {spline_def_of(NULL, values, 4, false), "joint 2 \"cam\": times is NULL, must be given"},
    {spline_def_of(times, NULL, 4, false), "joint 2 \"cam\": values is NULL, must be given"},
    {spline_def_of(back, values, 4, false),
     "joint 2 \"cam\": times[2] is 1 s, must be later than the time before it, 1 s"},
    {spline_def_of(bad, values, 4, false),
     "joint 2 \"cam\": times[1] is nan s and values[1] 0.5, must be finite"},
    {spline_def_of(times, bad, 4, false),
     "joint 2 \"cam\": times[1] is 1 s and values[1] nan, must be finite"},
    {spline_def_of(times, huge, 4, false),
     "joint 2 \"cam\": the slope between points 0 and 1 is not finite"},
    {spline_def_of(times, values, 3, true),
     "joint 2 \"cam\": values[2] is -1, must equal values[0], 0, because the spline is periodic"},
  };
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
    baum_spline_driver_def def = wrong[k].def;
    def.joint = pin;
    check_refused(scene.mechanism, add, &def, wrong[k].message);
  }
  /* The first value and the last value differ by 1e-13. A periodic spline must accept this. */
  baum_spline_driver_def def = spline_def_of(times, values, 4, true);
  check_refused(scene.mechanism, add, &def, "joint 2 \"cam\": joint is none, must be given");
  def.joint = pin;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  baum_mechanism_destroy(scene.mechanism);
}

static void the_joint_of_a_driver_cannot_change(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_spline_driver_def def = spline_def_of(FAR_TIMES, FAR_VALUES, 4, false);
  def.joint = pin_between(&scene, scene.link, scene.crank);
  baum_joint_id cam;
  assert_int_equal(baum_mechanism_add_spline_driver(scene.mechanism, &def, &cam), BAUM_OK);
  def.joint = pin_between(&scene, scene.link, scene.crank);
  assert_int_equal(baum_mechanism_set_spline_driver(scene.mechanism, cam, &def), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(), "joint 2 \"cam\": its joint cannot change");
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(a_natural_spline_through_three_points_has_its_closed_form),
    cmocka_unit_test(a_natural_spline_is_straight_outside_of_its_times),
    cmocka_unit_test(a_periodic_spline_repeats_and_approximates_the_sine),
    cmocka_unit_test(second_derivatives_are_continuous),
    cmocka_unit_test(overflow_is_reported_with_the_name_of_the_spline),
    cmocka_unit_test(a_run_follows_the_spline_until_its_law_is_replaced),
    cmocka_unit_test(the_spline_keeps_copies_of_its_arrays),
    cmocka_unit_test(wrong_curves_are_refused),
    cmocka_unit_test(the_joint_of_a_driver_cannot_change),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
