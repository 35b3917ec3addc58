/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares all derivatives of every spatial element, between bodies of all kinds, with differences
 * along the configuration manifold. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "derivatives.h"
#include "spatial_elements.h"

#include <baum/baum.h>

#include "construct.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/spatial/spatial_rows.h"

enum { STATES = 4 };

/* ---- checks ---- */

static void check_bodies(test_point *p)
{
  double force_v[TEST_SIZE_MAX * TEST_SIZE_MAX] = {0.0};
  double force_q[TEST_SIZE_MAX * TEST_SIZE_MAX] = {0.0};
  double ma_q[TEST_SIZE_MAX * TEST_SIZE_MAX] = {0.0};
  double a[TEST_SIZE_MAX] = {0.0};
  const baum_i_body_blocks blocks = {.ma_q = ma_q, .force_q = force_q, .force_v = force_v};
  check(baum_i_mechanism_linearize_bodies(&p->point, a, &blocks));
  for (int k = 1; k <= 2; k++) {
    const baum_i_body *body = p->mechanism->bodies[k];
    for (int j = 0; j < 6; j++) {
      /* Differences are exact for any step, because the moments are quadratic in v. */
      static const double step = 1e-3;
      double f[2][TEST_SIZE_MAX];
      for (int side = 0; side < 2; side++) {
        double v = p->v[body->v + j];
        p->v[body->v + j] = v + (side == 0 ? -step : step);
        test_point_update(p);
        check(baum_i_mechanism_force(&p->point, f[side]));
        p->v[body->v + j] = v;
      }
      test_point_update(p);
      for (int i = 0; i < 6; i++) {
        double slope = (f[1][body->v + i] - f[0][body->v + i]) / (2.0 * step);
        assert_true(fabs(force_v[body->mass + 6 * i + j] - slope) <= 1e-9 * (1.0 + fabs(slope)));
      }
    }
  }
}

/* Tells whether differences can be used for the coordinates of a joint. A random state may violate
 * the constraints of a joint strongly. The angle of the joint is then the angle of a short vector,
 * which changes too quickly for differences. */
static bool is_smooth(const test_point *p, int joint)
{
  const baum_i_joint *j = p->mechanism->joints[joint];
  for (int k = 0; j->type->coordinates[k] != BAUM_COORDINATE_FIRST; k++) {
    const baum_i_joint_coordinate of = {j, k};
    baum_i_coordinate c;
    baum_i_coordinate_at(&of, &p->point, &c);
    for (int i = 0; i < BAUM_I_PAIR_COLUMNS && baum_i_is_spatial_angle(&of); i++) {
      if (fabs(c.gradient[i]) > 1.1) {
        return false;
      }
    }
  }
  return true;
}

/* Tries random states until differences can be used for all coordinates of the first `joints`
 * joints. */
static void find_smooth(test_point *p, int joints, uint64_t *seed)
{
  bool smooth = false;
  for (int i = 0; i < 2000 && !smooth; i++) {
    test_point_random(p, seed);
    smooth = true;
    for (int k = 0; k < joints; k++) {
      smooth = smooth && is_smooth(p, k);
    }
  }
  assert_true(smooth);
}

/* Tells whether the first force is smooth near the state p. A force with axes is not smooth near
 * two relative orientations of its bodies. In one of them, the angle of a torsion spring is
 * undefined. In the other one, the rotation vector of a bushing jumps. */
static bool is_force_smooth(const test_point *p)
{
  const baum_i_force *force = p->mechanism->force_count > 0 ? p->mechanism->forces[0] : NULL;
  if (!force || force->element.definition->parameter_count < BAUM_I_SPATIAL_NUMBERS) {
    return true;
  }
  const baum_i_spatial_pair pair = baum_i_spatial_pair_at(
    &force->span, p->point.parameters + force->element.parameter, true, &p->point);
  double cosines[3];
  for (int i = 0; i < 3; i++) {
    cosines[i] = baum_i_dot3(pair.axes[0] + (ptrdiff_t)3 * i, pair.axes[1] + (ptrdiff_t)3 * i);
  }
  return cosines[2] > -0.3 && cosines[0] + cosines[1] + cosines[2] > -0.6;
}

static void find_smooth_force(test_point *p, uint64_t *seed)
{
  int tries = 0;
  do {
    test_point_random(p, seed);
  } while (!is_force_smooth(p) && tries++ < 200);
  assert_true(is_force_smooth(p));
}

/* Adds a spring on every coordinate of the first joint. */
static void add_joint_springs(const spatial_scene *s)
{
  const baum_joint_coordinate *all = s->mechanism->joints[0]->type->coordinates;
  for (int k = 0; all[k] != BAUM_COORDINATE_FIRST; k++) {
    baum_joint_spring_def def = baum_joint_spring_def_default();
    def.joint = baum_mechanism_joint_at(s->mechanism, 0);
    def.coordinate = k > 0 ? all[k] : BAUM_COORDINATE_FIRST;
    def.stiffness = 3.0 + k;
    def.damping = 0.7;
    def.free_value = 0.4;
    check(baum_mechanism_add_joint_spring(s->mechanism, &def, NULL));
  }
}

/* Adds a load on every coordinate of the first joint. An input multiplies the loads. */
static void add_joint_loads(const spatial_scene *s)
{
  const baum_joint_coordinate *all = s->mechanism->joints[0]->type->coordinates;
  baum_joint_load_def def = baum_joint_load_def_default();
  check(baum_mechanism_add_input(s->mechanism, NULL, -1.5, &def.input));
  for (int k = 0; all[k] != BAUM_COORDINATE_FIRST; k++) {
    def.joint = baum_mechanism_joint_at(s->mechanism, 0);
    def.coordinate = k > 0 ? all[k] : BAUM_COORDINATE_FIRST;
    def.effort = 2.0 + k;
    check(baum_mechanism_add_joint_load(s->mechanism, &def, NULL));
  }
}

/* Checks that the power of each load of a joint is g^T v. */
static void check_powers(test_point *p)
{
  for (int k = 0; k < p->mechanism->force_count; k++) {
    const baum_i_force *load = p->mechanism->forces[k];
    const baum_i_force_group alone = {load->type, 1, &load};
    double force[TEST_SIZE_MAX] = {0.0};
    double power[BAUM_I_POWERS] = {0.0};
    double product = 0.0;
    double size = 0.0;
    check(load->type->force(&alone, &p->point, force));
    check(load->type->power(load, &p->point, power));
    for (int i = 0; i < p->nv; i++) {
      product += force[i] * p->v[i];
      size += fabs(force[i] * p->v[i]);
    }
    assert_true(size > 0.0);
    assert_true(fabs(power[BAUM_I_POWER_LOADS] - product) <= 1e-14 * size); /* rounding */
  }
}

static void check_coordinates(const spatial_element *e, int a, int b, bool loads)
{
  spatial_scene s = spatial_scene_make(true);
  e->add(&s, a, b);
  if (loads) {
    add_joint_loads(&s);
  } else {
    add_joint_springs(&s);
  }
  if (s.mechanism->force_count == 0) {
    baum_mechanism_destroy(s.mechanism);
    return;
  }
  test_point p;
  test_point_open(&p, s.mechanism);
  uint64_t seed = 11;
  for (int i = 0; i < STATES; i++) {
    find_smooth(&p, 1, &seed);
    check_force_derivatives(&p);
    if (loads) {
      check_powers(&p);
      continue;
    }
    check_coordinate_derivatives(&p);
    check_potential_gradient(&p);
  }
  test_point_close(&p);
}

/* Checks the potential of the forces, if there is one. Loads with moments have no potential. */
static void check_elastic_forces(test_point *p)
{
  if (p->mechanism->force_count == 1) {
    check_potential_gradient(p);
  }
}

static void check_pair(const spatial_element *e, int a, int b)
{
  spatial_scene s = spatial_scene_make(e->force);
  e->add(&s, a, b);
  if (!e->force) {
    e->add(&s, 1, 0);
  }
  test_point p;
  test_point_open(&p, s.mechanism);
  uint64_t seed = 11;
  for (int i = 0; i < STATES; i++) {
    if (e->force) {
      find_smooth_force(&p, &seed);
      check_force_derivatives(&p);
      check_elastic_forces(&p);
    } else {
      find_smooth(&p, e->has_angle ? 2 : 0, &seed);
      check_joint_derivatives(&p);
    }
  }
  test_point_close(&p);
  if (!e->force) {
    check_coordinates(e, a, b, false);
    check_coordinates(e, a, b, true);
  }
}

/* Tells whether an element is tested between two bodies. If a body is a particle, the element must
 * allow particles. Body 1 (spatial) or body 4 (planar) must be one of the bodies. */
static bool is_tested(const spatial_element *e, int a, int b)
{
  bool allowed = (e->particle_a || !spatial_scene_is_particle(a)) &&
                 (e->particle_b || !spatial_scene_is_particle(b));
  return a != b && allowed && (a == 1 || b == 1 || a == 4 || b == 4);
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for (size_t k = 0; k < SPATIAL_ELEMENTS; k++) {
    for (int a = 0; a < SPATIAL_SCENE_BODIES; a++) {
      for (int b = 0; b < SPATIAL_SCENE_BODIES; b++) {
        if (is_tested(&spatial_elements[k], a, b)) {
          check_pair(&spatial_elements[k], a, b);
        }
      }
    }
  }
}

/* ---- couplings ---- */

static int cam(double x, double f[3], void *user)
{
  (void)user;
  f[0] = 0.3 * x + 0.2 * sin(1.3 * x);
  f[1] = 0.3 + 0.26 * cos(1.3 * x);
  f[2] = -0.338 * sin(1.3 * x);
  return 0;
}

static void couple(const spatial_scene *s, int a, baum_joint_coordinate of_a, int b,
                   baum_joint_coordinate of_b, baum_coupling_fn *law)
{
  baum_coupling_def def = baum_coupling_def_default();
  def.joint_a = baum_mechanism_joint_at(s->mechanism, a);
  def.joint_b = baum_mechanism_joint_at(s->mechanism, b);
  def.coordinate_a = of_a;
  def.coordinate_b = of_b;
  if (!law) {
    def.ratio = -1.5;
    def.offset = 0.3;
  }
  def.law = law;
  check(baum_mechanism_add_coupling(s->mechanism, &def, NULL));
}

enum { COUPLED = 4 };

/* Makes couplings between coordinates of one or two joints. Each coupling connects two to four
 * spatial and planar bodies. The coordinates are of all kinds. */
static spatial_scene make_coupled(void)
{
  static const baum_joint_coordinate x = BAUM_COORDINATE_X;
  static const baum_joint_coordinate angle = BAUM_COORDINATE_ANGLE;
  static const baum_joint_coordinate angle_b = BAUM_COORDINATE_ANGLE_B;
  static const baum_joint_coordinate displacement = BAUM_COORDINATE_DISPLACEMENT;
  spatial_scene s = spatial_scene_make(false);
  spatial_scene_add(&s, "cylindrical", 1, 2);
  spatial_scene_add(&s, "universal", 0, 1);
  spatial_scene_add(&s, "planar", 2, 4);
  (void)add_planar_pin(s.mechanism, NULL, s.bodies[4], BAUM_GROUND, 0.3, 0.2);
  couple(&s, 0, displacement, 0, angle, NULL); /* this is a screw */
  couple(&s, 0, angle, 1, angle_b, NULL);
  couple(&s, 1, angle, 2, x, cam);
  couple(&s, 3, angle, 0, angle, cam);
  couple(&s, 2, angle, 3, angle, NULL);
  couple(&s, 2, BAUM_COORDINATE_Y, 0, displacement, cam);
  return s;
}

static void couplings_agree_with_differences(void **state)
{
  (void)state;
  spatial_scene s = make_coupled();
  test_point p;
  test_point_open(&p, s.mechanism);
  uint64_t seed = 11;
  for (int i = 0; i < STATES; i++) {
    find_smooth(&p, COUPLED, &seed);
    check_joint_derivatives(&p);
  }
  test_point_close(&p);
}

static void gyroscopic_moments_agree_with_differences(void **state)
{
  (void)state;
  spatial_scene s = spatial_scene_make(false);
  test_point p;
  test_point_open(&p, s.mechanism);
  uint64_t seed = 5;
  for (int i = 0; i < STATES; i++) {
    test_point_random(&p, &seed);
    check_bodies(&p);
  }
  test_point_close(&p);
}

/* Checks N v by a central difference of the function move(). Also checks that the function
 * difference() is the inverse of move(). */
static void move_agrees_with_rate_and_difference(void **state)
{
  (void)state;
  spatial_scene s = spatial_scene_make(false);
  test_point p;
  test_point_open(&p, s.mechanism);
  uint64_t seed = 3;
  const baum_i_body *body = s.mechanism->bodies[1];
  for (int i = 0; i < STATES; i++) {
    static const double h = 1e-4;
    double rate[7];
    double q[2][7];
    double dx[6];
    test_point_random(&p, &seed);
    body->manifold->rate(body, p.q + body->q, p.v + body->v, rate);
    for (int side = 0; side < 2; side++) {
      memcpy(q[side], p.q + body->q, sizeof q[side]);
      body->manifold->move(body, side == 0 ? -h : h, p.v + body->v, q[side]);
    }
    body->manifold->difference(body, p.q + body->q, q[1], dx);
    for (int k = 0; k < 7; k++) {
      assert_true(fabs((q[1][k] - q[0][k]) / (2.0 * h) - rate[k]) < 1e-6);
    }
    for (int k = 0; k < 6; k++) {
      assert_true(fabs(dx[k] - h * p.v[body->v + k]) < 1e-15 * 8.0);
    }
  }
  test_point_close(&p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(couplings_agree_with_differences),
    cmocka_unit_test(gyroscopic_moments_agree_with_differences),
    cmocka_unit_test(move_agrees_with_rate_and_difference),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
