/* SPDX-License-Identifier: BSD-3-Clause */
#include "spatial_elements.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "check.h"
#include "construct.h"

bool spatial_scene_is_particle(int body)
{
  return body == 3 || body == 5;
}

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

spatial_scene spatial_scene_make(bool spheres)
{
  spatial_scene s = {.bodies = {BAUM_GROUND}};
  s.mechanism = create_mechanism();
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
    if (!spatial_scene_is_particle(A)) {                                  \
      memcpy((DEF).point_a, at[0], sizeof at[0]);                         \
    }                                                                     \
    if (!spatial_scene_is_particle(B)) {                                  \
      memcpy((DEF).point_b, at[1], sizeof at[1]);                         \
    }                                                                     \
  } while (0)

#define ADD_POINTS(NAME)                                                 \
  static void add_##NAME(spatial_scene *s, int a, int b)                 \
  {                                                                      \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default(); \
    BETWEEN(s, def, a, b);                                               \
    check(baum_mechanism_add_spatial_##NAME(s->mechanism, &def, NULL));  \
  }

#define ADD_AXIS(NAME)                                                   \
  static void add_##NAME(spatial_scene *s, int a, int b)                 \
  {                                                                      \
    static const double axis[3] = {0.3, -1.0, 0.7};                      \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default(); \
    BETWEEN(s, def, a, b);                                               \
    memcpy(def.axis, axis, sizeof axis);                                 \
    check(baum_mechanism_add_spatial_##NAME(s->mechanism, &def, NULL));  \
  }

#define ADD_AXES(NAME)                                                   \
  static void add_##NAME(spatial_scene *s, int a, int b)                 \
  {                                                                      \
    static const double axis[3] = {0.3, -1.0, 0.7};                      \
    static const double axis_b[3] = {-0.2, 0.5, 0.9};                    \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default(); \
    BETWEEN(s, def, a, b);                                               \
    memcpy(def.axis, axis, sizeof axis);                                 \
    memcpy(def.axis_b, axis_b, sizeof axis_b);                           \
    check(baum_mechanism_add_spatial_##NAME(s->mechanism, &def, NULL));  \
  }

/* Phi of a screw jumps when it exceeds half the pitch. With this large pitch, Phi stays far below
 * the jump at all points of a finite difference. */
static void add_screw(spatial_scene *s, int a, int b)
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

/* Adds a wheel that rolls on a plane. With special values of the rim radius, the wheel becomes a
 * sharp disc or a sphere. */
static void add_rolling(spatial_scene *s, int a, int b, double rim_radius)
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

static void add_disc(spatial_scene *s, int a, int b)
{
  add_rolling(s, a, b, 0.0);
}

static void add_wheel(spatial_scene *s, int a, int b)
{
  add_rolling(s, a, b, 0.2);
}

static void add_sphere(spatial_scene *s, int a, int b)
{
  add_rolling(s, a, b, 0.6);
}

static void add_knife_edge(spatial_scene *s, int a, int b)
{
  static const double vectors[2][3] = {{0.3, -0.2, 0.5}, {0.3, 1.0, 0.7}};
  baum_spatial_knife_edge_def def = baum_spatial_knife_edge_def_default();
  def.body_a = s->bodies[a];
  def.body_b = s->bodies[b];
  memcpy(def.point_a, vectors[0], sizeof def.point_a);
  memcpy(def.axis, vectors[1], sizeof def.axis);
  check(baum_mechanism_add_spatial_knife_edge(s->mechanism, &def, NULL));
}

/* The curve F = G = 0. F = c . x + 0.1 (c . x) (d . x) + 0.3 sin(d . x), of which no derivative is
 * zero. G is the same function with other vectors c and d. */
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

static void add_curve(spatial_scene *s, int a, int b)
{
  baum_spatial_curve_def def = baum_spatial_curve_def_default();
  BETWEEN(s, def, a, b);
  def.curve = bent;
  check(baum_mechanism_add_spatial_curve(s->mechanism, &def, NULL));
}

/* Adds a cable that touches ground and runs twice through body a. If body a is a particle, the last
 * part of the cable has no length. */
static void add_cable_with(spatial_scene *s, int a, int b, double transition)
{
  double points[5][3] = {
    {0.3, -0.2, 0.5}, {-0.1, 0.4, 0.25}, {0.2, 1.5, -0.6}, {-0.4, 0.1, 0.3}, {0.5, 0.2, 0.1}};
  const baum_body_id bodies[5] = {s->bodies[a], s->bodies[b], BAUM_GROUND, s->bodies[a],
                                  s->bodies[a]};
  baum_spatial_cable_def def = baum_spatial_cable_def_default();
  for (int k = 0; k < 5; k++) {
    if (k != 2 && spatial_scene_is_particle(k == 1 ? b : a)) {
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

static void add_cable(spatial_scene *s, int a, int b)
{
  add_cable_with(s, a, b, 0.0);
}

/* The stretch of this cable is always smaller than its transition. */
static void add_soft_cable(spatial_scene *s, int a, int b)
{
  add_cable_with(s, a, b, 50.0);
}

static void add_spring(spatial_scene *s, int a, int b)
{
  baum_spatial_spring_def def = baum_spatial_spring_def_default();
  BETWEEN(s, def, a, b);
  def.stiffness = 3.0;
  def.damping = 0.7;
  def.free_length = 0.4;
  check(baum_mechanism_add_spatial_spring(s->mechanism, &def, NULL));
}

static void add_torsion_spring(spatial_scene *s, int a, int b)
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

/* The matrices of stiffness and damping are full. */
static void add_bushing(spatial_scene *s, int a, int b)
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

static void add_load_in(spatial_scene *s, int body, bool follows_body)
{
  static const double vectors[3][3] = {{0.2, 0.1, -0.3}, {1.0, -2.0, 0.5}, {0.3, 0.8, -0.6}};
  baum_spatial_load_def def = baum_spatial_load_def_default();
  def.body = s->bodies[body];
  if (!spatial_scene_is_particle(body)) {
    memcpy(def.point, vectors[0], sizeof def.point);
    memcpy(def.moment, vectors[2], sizeof def.moment);
    def.follows_body = follows_body;
  }
  memcpy(def.force, vectors[1], sizeof def.force);
  check(baum_mechanism_add_spatial_load(s->mechanism, &def, NULL));
}

static void add_load(spatial_scene *s, int a, int b)
{
  (void)b;
  if (a != 0) {
    add_load_in(s, a, false);
    add_load_in(s, a, true);
  }
}

const spatial_element spatial_elements[SPATIAL_ELEMENTS] = {
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

void spatial_scene_add(spatial_scene *s, const char *name, int a, int b)
{
  int k = 0;
  while (strcmp(spatial_elements[k].name, name) != 0) {
    k++;
    assert_true(k < SPATIAL_ELEMENTS);
  }
  spatial_elements[k].add(s, a, b);
}
