/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests all derivatives of every spatial element between bodies of all kinds. They are compared
 * with differences along the configuration manifold. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "derivatives.h"

#include <baum/baum.h>

#include "mechanism/general/coordinate.h"
#include "mechanism/spatial/spatial_rows.h"

enum { BODIES = 6, STATES = 4 };

/* Ground, two spatial bodies, a spatial particle, a planar body and a planar particle. */
typedef struct scene {
  baum_mechanism *mechanism;
  baum_body_id bodies[BODIES];
} scene;

static bool is_particle(int body)
{
  return body == 3 || body == 5;
}

/* If `sphere` is set, the body has no gyroscopic moments. The derivatives of forces do not include
 * gyroscopic moments. Forces are therefore tested between spheres. */
static baum_body_id add_body(baum_mechanism *m, double x, bool sphere)
{
  baum_body_id id;
  baum_spatial_body_def def = baum_spatial_body_def_default();
  static const double tensor[6] = {1.0, 1.4, 1.1, 0.1, -0.2, 0.05};
  if (!sphere) {
    memcpy(def.inertia, tensor, sizeof tensor);
  }
  def.mass = 2.0;
  def.position[0] = x;
  def.position[2] = 0.4;
  def.orientation[0] = 0.8;
  def.orientation[2] = 0.6;
  check(baum_mechanism_add_spatial_body(m, &def, &id));
  return id;
}

static scene make(bool spheres)
{
  scene s = {.bodies = {BAUM_GROUND}};
  check(baum_mechanism_create(&s.mechanism));
  s.bodies[1] = add_body(s.mechanism, 0.3, spheres);
  s.bodies[2] = add_body(s.mechanism, -0.7, spheres);
  baum_spatial_particle_def ball = baum_spatial_particle_def_default();
  ball.position[1] = 1.0;
  check(baum_mechanism_add_spatial_particle(s.mechanism, &ball, &s.bodies[3]));
  baum_planar_body_def link = baum_planar_body_def_default();
  link.angle = 0.3;
  check(baum_mechanism_add_planar_body(s.mechanism, &link, &s.bodies[4]));
  baum_planar_particle_def bead = baum_planar_particle_def_default();
  bead.position[0] = -1.0;
  check(baum_mechanism_add_planar_particle(s.mechanism, &bead, &s.bodies[5]));
  return s;
}

/* ---- the elements that are added between two bodies ---- */

#define BETWEEN(S, DEF, A, B)                                             \
  do {                                                                    \
    static const double at[2][3] = {{0.3, -0.2, 0.5}, {-0.1, 0.4, 0.25}}; \
    memset((DEF).point_a, 0, sizeof(DEF).point_a);                        \
    memset((DEF).point_b, 0, sizeof(DEF).point_b);                        \
    (DEF).body_a = (S)->bodies[A];                                        \
    (DEF).body_b = (S)->bodies[B];                                        \
    if (!is_particle(A)) {                                                \
      memcpy((DEF).point_a, at[0], sizeof at[0]);                         \
    }                                                                     \
    if (!is_particle(B)) {                                                \
      memcpy((DEF).point_b, at[1], sizeof at[1]);                         \
    }                                                                     \
  } while (0)

#define ADD_POINTS(NAME)                                                 \
  static void add_##NAME(scene *s, int a, int b)                         \
  {                                                                      \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default(); \
    BETWEEN(s, def, a, b);                                               \
    check(baum_mechanism_add_spatial_##NAME(s->mechanism, &def, NULL));  \
  }

#define ADD_AXIS(NAME)                                                   \
  static void add_##NAME(scene *s, int a, int b)                         \
  {                                                                      \
    static const double axis[3] = {0.3, -1.0, 0.7};                      \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default(); \
    BETWEEN(s, def, a, b);                                               \
    memcpy(def.axis, axis, sizeof axis);                                 \
    check(baum_mechanism_add_spatial_##NAME(s->mechanism, &def, NULL));  \
  }

#define ADD_AXES(NAME)                                                   \
  static void add_##NAME(scene *s, int a, int b)                         \
  {                                                                      \
    static const double axis[3] = {0.3, -1.0, 0.7};                      \
    static const double axis_b[3] = {-0.2, 0.5, 0.9};                    \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default(); \
    BETWEEN(s, def, a, b);                                               \
    memcpy(def.axis, axis, sizeof axis);                                 \
    memcpy(def.axis_b, axis_b, sizeof axis_b);                           \
    check(baum_mechanism_add_spatial_##NAME(s->mechanism, &def, NULL));  \
  }

/* The pitch of the screw is so large that Phi does not jump within a difference. */
static void add_screw(scene *s, int a, int b)
{
  static const double axis[3] = {0.3, -1.0, 0.7};
  static const double axis_b[3] = {-0.2, 0.5, 0.9};
  baum_spatial_screw_def def = baum_spatial_screw_def_default();
  BETWEEN(s, def, a, b);
  memcpy(def.axis, axis, sizeof axis);
  memcpy(def.axis_b, axis_b, sizeof axis_b);
  def.pitch = 40.0;
  def.offset = 0.2;
  check(baum_mechanism_add_spatial_screw(s->mechanism, &def, NULL));
}

ADD_AXES(constant_velocity)
ADD_POINTS(spherical)
ADD_AXES(revolute)
ADD_AXES(universal)
ADD_AXES(cylindrical)
ADD_AXES(prismatic)
ADD_AXES(planar)
ADD_POINTS(fixed)
ADD_POINTS(distance)
ADD_AXIS(point_on_line)
ADD_AXIS(point_on_plane)

/* Adds a wheel that rolls on a plane. The disc and the sphere are the limits of the wheel for
 * special values of the rim radius. */
static void add_rolling(scene *s, int a, int b, double rim_radius)
{
  static const double vectors[4][3] = {
    {0.3, -0.2, 0.5}, {0.3, 1.0, 0.7}, {-0.1, 0.4, 0.25}, {-0.2, 0.5, 0.9}};
  baum_spatial_rolling_disc_def def = baum_spatial_rolling_disc_def_default();
  def.body_a = s->bodies[a];
  def.body_b = s->bodies[b];
  memcpy(def.point_a, vectors[0], sizeof vectors[0]);
  memcpy(def.normal, vectors[1], sizeof vectors[0]);
  memcpy(def.centre, vectors[2], sizeof vectors[0]);
  memcpy(def.axis_b, vectors[3], sizeof vectors[0]);
  def.radius = 0.6;
  def.rim_radius = rim_radius;
  check(baum_mechanism_add_spatial_rolling_disc(s->mechanism, &def, NULL));
}

static void add_disc(scene *s, int a, int b)
{
  add_rolling(s, a, b, 0.0);
}

static void add_wheel(scene *s, int a, int b)
{
  add_rolling(s, a, b, 0.2);
}

static void add_sphere(scene *s, int a, int b)
{
  add_rolling(s, a, b, 0.6);
}

static void add_knife_edge(scene *s, int a, int b)
{
  static const double vectors[2][3] = {{0.3, -0.2, 0.5}, {0.3, 1.0, 0.7}};
  baum_spatial_knife_edge_def def = baum_spatial_knife_edge_def_default();
  def.body_a = s->bodies[a];
  def.body_b = s->bodies[b];
  memcpy(def.point_a, vectors[0], sizeof def.point_a);
  memcpy(def.axis, vectors[1], sizeof def.axis);
  check(baum_mechanism_add_spatial_knife_edge(s->mechanism, &def, NULL));
}

/* F = c . x + 0.1 (c . x) (d . x) + 0.3 sin(d . x) with all derivatives nonzero, and the same function G
 * with other vectors. */
static int bent(const double xyz[3], double out[20], void *user)
{
  static const double c[2][3] = {{0.9, 0.2, -0.4}, {-0.3, 0.8, 0.3}};
  static const double d[2][3] = {{0.7, -0.5, 0.4}, {0.3, 0.6, 0.9}};
  (void)user;
  for (int row = 0; row < 2; row++) {
    double *f = out + 10 * row;
    double along = 0.0;
    double turned = 0.0;
    for (int i = 0; i < 3; i++) {
      along += c[row][i] * xyz[i];
      turned += d[row][i] * xyz[i];
    }
    f[0] = along + 0.1 * along * turned + 0.3 * sin(turned);
    for (int i = 0, k = 4; i < 3; i++) {
      f[1 + i] = c[row][i] * (1.0 + 0.1 * turned) + d[row][i] * (0.1 * along + 0.3 * cos(turned));
      for (int j = i; j < 3; j++, k++) {
        f[k] = 0.1 * (c[row][i] * d[row][j] + c[row][j] * d[row][i]) -
               0.3 * sin(turned) * d[row][i] * d[row][j];
      }
    }
  }
  return 0;
}

static void add_curve(scene *s, int a, int b)
{
  baum_spatial_curve_def def = baum_spatial_curve_def_default();
  BETWEEN(s, def, a, b);
  def.curve = bent;
  check(baum_mechanism_add_spatial_curve(s->mechanism, &def, NULL));
}

/* Adds a cable that touches ground and runs twice through body a. If body a is a particle, the last
 * part of the cable has no length. */
static void add_cable_with(scene *s, int a, int b, double transition)
{
  double points[5][3] = {
    {0.3, -0.2, 0.5}, {-0.1, 0.4, 0.25}, {0.2, 1.5, -0.6}, {-0.4, 0.1, 0.3}, {0.5, 0.2, 0.1}};
  const baum_body_id bodies[5] = {s->bodies[a], s->bodies[b], BAUM_GROUND, s->bodies[a],
                                  s->bodies[a]};
  baum_spatial_cable_def def = baum_spatial_cable_def_default();
  for (int k = 0; k < 5; k++) {
    if (k != 2 && is_particle(k == 1 ? b : a)) {
      memset(points[k], 0, sizeof points[k]);
    }
  }
  def.bodies = bodies;
  def.points = points[0];
  def.point_count = 5;
  def.stiffness = 3.0;
  def.damping = 0.7;
  def.free_length = 0.4;
  def.transition = transition;
  check(baum_mechanism_add_spatial_cable(s->mechanism, &def, NULL));
}

static void add_cable(scene *s, int a, int b)
{
  add_cable_with(s, a, b, 0.0);
}

/* The stretch of this cable is always smaller than its transition. */
static void add_soft_cable(scene *s, int a, int b)
{
  add_cable_with(s, a, b, 50.0);
}

static void add_spring(scene *s, int a, int b)
{
  baum_spatial_spring_def def = baum_spatial_spring_def_default();
  BETWEEN(s, def, a, b);
  def.stiffness = 3.0;
  def.damping = 0.7;
  def.free_length = 0.4;
  check(baum_mechanism_add_spatial_spring(s->mechanism, &def, NULL));
}

static void add_torsion_spring(scene *s, int a, int b)
{
  static const double axis[3] = {0.3, -1.0, 0.7};
  static const double axis_b[3] = {-0.2, 0.5, 0.9};
  baum_spatial_torsion_spring_def def = baum_spatial_torsion_spring_def_default();
  BETWEEN(s, def, a, b);
  memcpy(def.axis, axis, sizeof axis);
  memcpy(def.axis_b, axis_b, sizeof axis_b);
  def.stiffness = 3.0;
  def.damping = 0.7;
  def.free_angle = 0.4;
  check(baum_mechanism_add_spatial_torsion_spring(s->mechanism, &def, NULL));
}

/* Both matrices are full. */
static void add_bushing(scene *s, int a, int b)
{
  static const double axis[3] = {0.3, -1.0, 0.7};
  static const double axis_b[3] = {-0.2, 0.5, 0.9};
  baum_spatial_bushing_def def = baum_spatial_bushing_def_default();
  BETWEEN(s, def, a, b);
  memcpy(def.axis, axis, sizeof axis);
  memcpy(def.axis_b, axis_b, sizeof axis_b);
  for (int i = 0; i < 36; i++) {
    int row = i / 6;
    int column = i % 6;
    def.stiffness[i] = (row == column ? 3.0 : 0.0) + 0.1 * (row + column) - 0.05 * row * column;
    def.damping[i] = (row == column ? 0.8 : 0.0) + 0.04 * (row + 1) * (column + 1);
  }
  check(baum_mechanism_add_spatial_bushing(s->mechanism, &def, NULL));
}

static void add_load_in(scene *s, int body, bool follows_body)
{
  static const double vectors[3][3] = {{0.2, 0.1, -0.3}, {1.0, -2.0, 0.5}, {0.3, 0.8, -0.6}};
  baum_spatial_load_def def = baum_spatial_load_def_default();
  def.body = s->bodies[body];
  if (!is_particle(body)) {
    memcpy(def.point, vectors[0], sizeof def.point);
    memcpy(def.moment, vectors[2], sizeof def.moment);
    def.follows_body = follows_body;
  }
  memcpy(def.force, vectors[1], sizeof def.force);
  check(baum_mechanism_add_spatial_load(s->mechanism, &def, NULL));
}

static void add_load(scene *s, int a, int b)
{
  (void)b;
  if (a != 0) {
    add_load_in(s, a, false);
    add_load_in(s, a, true);
  }
}

typedef struct element {
  const char *name;
  void (*add)(scene *s, int a, int b);
  bool particle_a, particle_b; /* whether body a or body b may be a particle */
  bool force;
  bool has_angle; /* whether a row depends on the angle of the joint */
} element;

static const element elements[] = {
  {"spherical", add_spherical, true, true, false, false},
  {"revolute", add_revolute, false, false, false, false},
  {"universal", add_universal, false, false, false, false},
  {"cylindrical", add_cylindrical, false, false, false, false},
  {"prismatic", add_prismatic, false, false, false, false},
  {"planar", add_planar, false, false, false, false},
  {"fixed", add_fixed, false, false, false, false},
  {"distance", add_distance, true, true, false, false},
  {"point on line", add_point_on_line, false, true, false, false},
  {"point on plane", add_point_on_plane, false, true, false, false},
  {"screw", add_screw, false, false, false, true},
  {"constant velocity", add_constant_velocity, false, false, false, false},
  {"rolling disc", add_disc, false, false, false, false},
  {"rolling wheel", add_wheel, false, false, false, false},
  {"rolling sphere", add_sphere, false, false, false, false},
  {"curve", add_curve, false, true, false, false},
  {"knife edge", add_knife_edge, false, false, false, false},
  {"spring", add_spring, true, true, true, false},
  {"cable", add_cable, true, true, true, false},
  {"soft cable", add_soft_cable, true, true, true, false},
  {"torsion spring", add_torsion_spring, false, false, true, false},
  {"bushing", add_bushing, false, false, true, false},
  {"load", add_load, true, true, true, false},
};

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
      /* differences are exact for any step, because the moments are quadratic in v */
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

/* Tells whether differences can be used for the coordinates of a joint. In a random state, a joint
 * may be far off its constraints. Its angle is then the angle of a short vector, which changes too
 * quickly for differences. */
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

/* Tries random states until differences can be used for all coordinates of the first joints. */
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

/* Tells whether the first force is smooth near this point. A force with axes is not smooth near two
 * relative orientations: in one the angle of a torsion spring is undefined, and in the other the
 * rotation vector of a bushing jumps. */
static bool is_moderate(const test_point *p)
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

static void find_moderate(test_point *p, uint64_t *seed)
{
  int tries = 0;
  do {
    test_point_random(p, seed);
  } while (!is_moderate(p) && tries++ < 200);
  assert_true(is_moderate(p));
}

/* Adds a spring on every coordinate of the first joint. */
static void add_joint_springs(const scene *s)
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

static void check_springs(const element *e, int a, int b)
{
  scene s = make(true);
  e->add(&s, a, b);
  add_joint_springs(&s);
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

static void check_pair(const element *e, int a, int b)
{
  scene s = make(e->force);
  e->add(&s, a, b);
  if (!e->force) {
    e->add(&s, 1, 0);
  }
  test_point p;
  test_point_open(&p, s.mechanism);
  uint64_t seed = 11;
  for (int i = 0; i < STATES; i++) {
    if (e->force) {
      find_moderate(&p, &seed);
      check_force_derivatives(&p);
      check_elastic_forces(&p);
    } else {
      find_smooth(&p, e->has_angle ? 2 : 0, &seed);
      check_joint_derivatives(&p);
    }
  }
  test_point_close(&p);
  if (!e->force) {
    check_springs(e, a, b);
  }
}

/* Tells whether an element is tested between two bodies. The element must allow the particles among
 * them, and body 1 (spatial) or body 4 (planar) must be one of them. */
static bool is_tested(const element *e, int a, int b)
{
  bool allowed = (e->particle_a || !is_particle(a)) && (e->particle_b || !is_particle(b));
  return a != b && allowed && (a == 1 || b == 1 || a == 4 || b == 4);
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof elements / sizeof *elements; k++) {
    for (int a = 0; a < BODIES; a++) {
      for (int b = 0; b < BODIES; b++) {
        if (is_tested(&elements[k], a, b)) {
          check_pair(&elements[k], a, b);
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

static void couple(const scene *s, int a, baum_joint_coordinate of_a, int b,
                   baum_joint_coordinate of_b, baum_coupling_fn *law)
{
  baum_coupling_def def = baum_coupling_def_default();
  def.joint_a = baum_mechanism_joint_at(s->mechanism, a);
  def.joint_b = baum_mechanism_joint_at(s->mechanism, b);
  def.coordinate_a = of_a;
  def.coordinate_b = of_b;
  def.ratio = -1.5;
  def.offset = 0.3;
  def.law = law;
  check(baum_mechanism_add_coupling(s->mechanism, &def, NULL));
}

enum { COUPLED = 4 };

/* Makes couplings between joints of two to four bodies. The bodies are spatial and planar, and the
 * coordinates are of all kinds. */
static scene make_coupled(void)
{
  static const baum_joint_coordinate x = BAUM_COORDINATE_X;
  static const baum_joint_coordinate angle = BAUM_COORDINATE_ANGLE;
  static const baum_joint_coordinate angle_b = BAUM_COORDINATE_ANGLE_B;
  static const baum_joint_coordinate displacement = BAUM_COORDINATE_DISPLACEMENT;
  scene s = make(false);
  add_cylindrical(&s, 1, 2);
  add_universal(&s, 0, 1);
  add_planar(&s, 2, 4);
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.body_a = s.bodies[4];
  pin.body_b = BAUM_GROUND;
  pin.point[0] = 0.3;
  pin.point[1] = 0.2;
  check(baum_mechanism_add_planar_revolute(s.mechanism, &pin, NULL));
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
  scene s = make_coupled();
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
  scene s = make(false);
  test_point p;
  test_point_open(&p, s.mechanism);
  uint64_t seed = 5;
  for (int i = 0; i < STATES; i++) {
    test_point_random(&p, &seed);
    check_bodies(&p);
  }
  test_point_close(&p);
}

/* Checks N v by a central difference of move. Also checks that difference is the inverse of
 * move. */
static void the_manifold_is_consistent(void **state)
{
  (void)state;
  scene s = make(false);
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
    cmocka_unit_test(the_manifold_is_consistent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
