/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests errors that only spatial elements can have, and their messages. They concern orientations,
 * inertias, axes, points on particles, bodies of the wrong kind, and joints that are mounted the
 * wrong way round. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"
#include "every_element.h"
#include "message.h"
#include "runs.h"

enum { TEXT = 160 };

/* ---- definitions of every kind ---- */

static bool begins(const char *text, const char *with)
{
  return strncmp(text, with, strlen(with)) == 0;
}

/* Sets a field, which is given by its name. Returns false if the kind has no such field. */
static bool set_field(any_def *def, const element_kind *kind, const char *name, const void *bytes)
{
  const element_fields fields = element_fields_of(kind);
  for (int k = 0; k < fields.count; k++) {
    if (strcmp(fields.list[k].name, name) == 0) {
      memcpy(def->bytes + fields.list[k].offset, bytes, fields.list[k].size);
      return true;
    }
  }
  return false;
}

/* Replaces one field of a good definition. Checks that adding and setting this definition is
 * refused. Returns false if the kind has no such field. */
static bool refuses(const every_element *parts, const element_kind *kind, const char *field,
                    const void *bytes, const char *message)
{
  any_def def;
  any_id id;
  kind->good(parts, &def);
  if (!set_field(&def, kind, field, bytes)) {
    return false;
  }
  char text[TEXT];
  (void)snprintf(text, sizeof text, "\"%s\": |%s", def.head.name, message);
  ASSERT_SAYS(kind->add(parts->mechanism, &def, &id), BAUM_ERR_ARGUMENT, text);
  ASSERT_SAYS(kind->set(parts->mechanism, every_element_id(parts, kind), &def), BAUM_ERR_ARGUMENT,
              text);
  return true;
}

static const element_kind *kind_of(const char *name)
{
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    if (strcmp(element_kinds[k].name, name) == 0) {
      return &element_kinds[k];
    }
  }
  fail_msg("no kind %s", name);
  return NULL;
}

static every_element open_parts(void)
{
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  return parts;
}

/* ---- bodies ---- */

static void orientations_that_are_no_unit_quaternion_are_refused(void **state)
{
  (void)state;
  static const struct {
    double p[4];
    const char *message;
  } bad[] = {
    {{0.0, 0.0, 0.0, 0.0}, "orientation has the length 0, must be 1 within 1e-6: a unit"},
    {{2.0, 0.0, 0.0, 0.0}, "orientation has the length 2, must be 1 within 1e-6"},
    {{0.0, 1.0 + 2e-6, 0.0, 0.0}, "orientation has the length 1.000002, must be 1 within 1e-6"},
    {{0.0, 0.0, 0.0, 1.0 - 2e-6}, "orientation has the length 0.999998, must be 1 within 1e-6"},
    {{1e300, 1e300, 0.0, 0.0}, "orientation has the length inf, must be 1 within 1e-6"},
  };
  every_element parts = open_parts();
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    assert_true(refuses(&parts, kind_of("spatial_body"), "orientation", bad[k].p, bad[k].message));
  }
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.orientation[0] = 1.0 - 0.9e-6;
  assert_int_equal(baum_mechanism_add_spatial_body(parts.mechanism, &def, NULL), BAUM_OK);
  baum_mechanism_destroy(parts.mechanism);
}

static void inertias_that_no_body_has_are_refused(void **state)
{
  (void)state;
  static const char positive[] =
    "inertia has the principal moments | kg m^2; two must be > 0, and none < 0";
  static const char triangle[] = "kg m^2; none may be larger than the sum of the other two";
  static const struct {
    double inertia[6]; /* xx, yy, zz, xy, xz, yz */
    const char *message;
  } bad[] = {
    {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, positive},
    {{1.0, 1.0, -1.0, 0.0, 0.0, 0.0}, positive},
    {{1.0, 0.0, 0.0, 0.0, 0.0, 0.0}, positive},
    {{1.0, 1.0, 1.0, 1.0, 0.0, 0.0}, triangle},
    {{1.0, 1.0, 1.0, 0.0, 0.0, -1.5}, positive},
    {{1.0, 1.0, 2.001, 0.0, 0.0, 0.0}, triangle},
    {{1.0, 3.0, 1.0, 0.0, 0.0, 0.0}, triangle},
    {{1.0, 1.0, 1.0, 0.9, 0.0, 0.0}, "principal moments 0.1, 1 and 1.9 kg m^2; none may"},
  };
  every_element parts = open_parts();
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    assert_true(
      refuses(&parts, kind_of("spatial_body"), "inertia", bad[k].inertia, bad[k].message));
  }
  /* The inertia of a plate, whose principal moments are 2, 1 and 1 kg m^2, in axes rotated by 45
   * degrees. The largest moment of a plate is the sum of the other two, which is the limit of what
   * is possible. */
  static const double plate[6] = {1.5, 1.5, 1.0, 0.5, 0.0, 0.0};
  baum_spatial_body_def def = baum_spatial_body_def_default();
  memcpy(def.inertia, plate, sizeof plate);
  assert_int_equal(baum_mechanism_add_spatial_body(parts.mechanism, &def, NULL), BAUM_OK);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- axes ---- */

static void axes_without_direction_are_refused(void **state)
{
  (void)state;
  static const double zero[3] = {0.0, 0.0, 0.0};
  const double absent[3] = {(double)NAN, (double)NAN, (double)NAN};
  const double half[3] = {1.0, (double)NAN, 0.0};
  every_element parts = open_parts();
  int counts[2] = {0, 0};
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    const element_kind *kind = &element_kinds[k];
    if (begins(kind->name, "spatial")) {
      counts[0] += refuses(&parts, kind, "axis", zero, "axis is (0, 0, 0), which has no direction");
      counts[1] +=
        refuses(&parts, kind, "axis_b", zero, "axis_b is (0, 0, 0), which has no direction");
      (void)refuses(&parts, kind, "axis", absent, "axis|nan");
      (void)refuses(&parts, kind, "axis_b", half, "axis_b|nan");
    }
  }
  assert_int_equal(counts[0], 12);
  assert_int_equal(counts[1], 10);
  assert_true(
    refuses(&parts, kind_of("spatial_universal"), "axis_b", absent, "axis_b is not given"));
  baum_mechanism_destroy(parts.mechanism);
}

/* The axes have a very small length, and must be accepted. */
static void the_shortest_axis_has_a_direction(void **state)
{
  (void)state;
  every_element parts = open_parts();
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = parts.yoke;
  memset(def.point, 0, sizeof def.point);
  memset(def.axis_b, 0, sizeof def.axis_b);
  def.axis[2] = 1e-300;
  def.axis_b[2] = 1e-300;
  assert_int_equal(baum_mechanism_add_spatial_revolute(parts.mechanism, &def, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(parts.mechanism), BAUM_OK);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- cables ---- */

static void wrong_cables_are_refused(void **state)
{
  (void)state;
  every_element parts = open_parts();
  const baum_body_id bodies[2] = {BAUM_GROUND, parts.ball};
  const baum_body_id none[2] = {BAUM_GROUND, {0, 0}};
  const baum_body_id coordinates[2] = {BAUM_GROUND, parts.masses};
  static const double good[6] = {0.0}, infinite[6] = {[2] = (double)INFINITY};
  static const double off[6] = {[5] = 0.1};
  const struct {
    const baum_body_id *bodies;
    const double *points;
    int32_t count;
    const char *message;
  } wrong[] = {
    {NULL, good, 2, "bodies is NULL, must be given"},
    {bodies, NULL, 2, "points is NULL, must be given"},
    {bodies, good, 1, "point_count is 1, must be at least 2"},
    {bodies, good, -2, "point_count is -2, must be at least 2"},
    {bodies, good, INT32_MAX, "point_count is 2147483647, must be at most 10000"},
    {none, good, 2, "bodies[1]"},
    {coordinates, good, 2, "bodies[1] is body |\"masses\", which has no place in space"},
    {bodies, infinite, 2, "points[0][2] is inf m, must be finite"},
    {bodies, off, 2, "points[1] is (0, 0, 0.1) m, must be (0, 0, 0) on the particle"},
  };
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
    baum_spatial_cable_def def = baum_spatial_cable_def_default();
    def.bodies = wrong[k].bodies;
    def.points = wrong[k].points;
    def.point_count = wrong[k].count;
    ASSERT_SAYS(baum_mechanism_add_spatial_cable(parts.mechanism, &def, NULL), BAUM_ERR_ARGUMENT,
                wrong[k].message);
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- knife edges ---- */

static void wrong_knife_edges_are_refused(void **state)
{
  (void)state;
  every_element parts = open_parts();
  const struct {
    baum_body_id body_b;
    bool point, point_a;
    const char *message;
  } wrong[] = {
    {parts.skate, true, false, "body_a and body_b are both body |\"skate\""},
    {parts.drop, true, false, "body_b is body |\"drop\", which has no orientation"},
    {BAUM_GROUND, false, false, "no point is given; give either point or point_a"},
    {BAUM_GROUND, true, true, "point and point_a are both given; give either"},
  };
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
    baum_spatial_knife_edge_def def = baum_spatial_knife_edge_def_default();
    def.body_a = parts.skate;
    def.body_b = wrong[k].body_b;
    for (int i = 0; i < 3; i++) {
      def.point[i] = wrong[k].point ? 0.0 : (double)NAN;
      def.point_a[i] = wrong[k].point_a ? 0.0 : (double)NAN;
    }
    ASSERT_SAYS(baum_mechanism_add_spatial_knife_edge(parts.mechanism, &def, NULL),
                BAUM_ERR_ARGUMENT, wrong[k].message);
  }
  baum_spatial_knife_edge_def ground = baum_spatial_knife_edge_def_default();
  ground.body_a = BAUM_GROUND;
  ground.point[0] = ground.point[1] = ground.point[2] = 0.0;
  ASSERT_SAYS(baum_mechanism_add_spatial_knife_edge(parts.mechanism, &ground, NULL),
              BAUM_ERR_ARGUMENT, "body_a and body_b are both ground");
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- bodies of the wrong kind ---- */

static void check_bodies(const every_element *parts, const element_kind *kind)
{
  const struct {
    const char *name;
    /* Which bodies must have an orientation: 1 for body_a, 2 for body_b, 3 for both. */
    int oriented;
  } needs[] = {{"spatial_revolute", 3},       {"spatial_universal", 3},
               {"spatial_cylindrical", 3},    {"spatial_prismatic", 3},
               {"spatial_planar", 3},         {"spatial_fixed", 3},
               {"spatial_point_on_line", 1},  {"spatial_point_on_plane", 1},
               {"spatial_screw", 3},          {"spatial_constant_velocity", 3},
               {"spatial_torsion_spring", 3}, {"spatial_bushing", 3},
               {"spatial_curve", 1},          {"spatial_knife_edge", 3}};
  int oriented = 0;
  for (size_t k = 0; k < sizeof needs / sizeof *needs; k++) {
    oriented = strcmp(needs[k].name, kind->name) == 0 ? needs[k].oriented : oriented;
  }
  (void)refuses(parts, kind, "body_a", &parts->masses,
                "body_a is body |\"masses\", which has no place in space");
  (void)refuses(parts, kind, "body_b", &parts->masses,
                "body_b is body |\"masses\", which has no place in space");
  if (oriented & 1) {
    assert_true(refuses(parts, kind, "body_a", &parts->bob,
                        "body_a is body |\"bob\", which has no orientation"));
  }
  if (oriented & 2) {
    assert_true(refuses(parts, kind, "body_b", &parts->ball,
                        "body_b is body |\"ball\", which has no orientation"));
  }
}

static void bodies_of_the_wrong_kind_are_refused(void **state)
{
  (void)state;
  every_element parts = open_parts();
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    const element_kind *kind = &element_kinds[k];
    if (begins(kind->name, "spatial")) {
      check_bodies(&parts, kind);
    } else if (begins(kind->name, "planar")) {
      const char *fields[] = {"body_a", "body_b", "body"};
      for (int f = 0; f < 3; f++) {
        char text[TEXT];
        (void)snprintf(text, sizeof text, "%s is body |\"yoke\", which has no ", fields[f]);
        (void)refuses(&parts, kind, fields[f], &parts.yoke, text);
      }
    }
  }
  baum_mechanism_destroy(parts.mechanism);
}

static void coordinates_that_joints_do_not_have_are_refused(void **state)
{
  (void)state;
  every_element parts = open_parts();
  const element_kind *kind = kind_of("coupling");
  const baum_joint_coordinate x = BAUM_COORDINATE_X;
  const struct {
    const char *kind;
    const char *field;
    const char *message;
  } bad[] = {
    {"coupling", "coordinate_a",
     "coordinate_a is \"x\", but joint |\"pin\", a planar "
     "revolute joint, has \"angle\""},
    {"coupling", "coordinate_b", "coordinate_b is \"x\", but |, has \"displacement\""},
    {"driver", "coordinate", "coordinate is \"x\", but joint |\"pin\", a planar revolute joint"},
    {"spline_driver", "coordinate", "coordinate is \"x\", but joint |\"hinge\""},
    {"joint_spring", "coordinate",
     "coordinate is \"x\", but joint |\"sleeve\", a spatial "
     "cylindrical joint, has \"displacement\", \"angle\""},
    {"joint_load", "coordinate", "\"thrust\": coordinate is \"x\", but joint |\"sleeve\""},
  };
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    assert_true(refuses(&parts, kind_of(bad[k].kind), bad[k].field, &x, bad[k].message));
  }
  assert_true(refuses(&parts, kind_of("joint_spring"), "joint", &parts.clamp,
                      "joint is joint |\"clamp\", a spatial fixed joint, which has no coordinate "
                      "for a spring"));
  assert_true(refuses(&parts, kind_of("joint_load"), "joint", &parts.clamp,
                      "joint is joint |\"clamp\", a spatial fixed joint, which has no coordinate "
                      "for a load"));
  assert_true(refuses(&parts, kind, "joint_b", &parts.socket,
                      "joint_b is joint |\"socket\", a spatial spherical joint, which has no "
                      "coordinate to couple"));
  assert_true(refuses(&parts, kind_of("driver"), "joint", &parts.clamp,
                      "joint is joint |\"clamp\", a spatial fixed joint, which has no coordinate"));
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- points ---- */

static void points_are_given_in_one_way_only(void **state)
{
  (void)state;
  const double absent[3] = {(double)NAN, (double)NAN, (double)NAN};
  const double off[3] = {0.0, 0.0, 0.25};
  every_element parts = open_parts();
  const element_kind *strut = kind_of("spatial_distance");
  const element_kind *coil = kind_of("spatial_spring");
  const element_kind *socket = kind_of("spatial_spherical");
  const char *length =
    "point is given, but the length would be zero; give point_a and point_b instead";
  const char *off_ball = "point_b is (0, 0, 0.25) m, must be (0, 0, 0) on the particle body ";
  assert_true(refuses(&parts, strut, "point", off, length));
  assert_true(refuses(&parts, coil, "point", off, length));
  assert_true(refuses(&parts, strut, "point_b", off, off_ball));
  assert_true(refuses(&parts, coil, "point_b", off, off_ball));
  assert_true(refuses(&parts, strut, "point_a", absent, "point_b is given, but not point_a"));
  assert_true(refuses(&parts, strut, "point_b", absent, "point_a is given, but not point_b"));
  assert_true(refuses(&parts, socket, "point", absent,
                      "no point is given; give point, or point_a and point_b"));
  assert_true(refuses(&parts, socket, "point_a", off, "point and point_a are both given"));
  baum_mechanism_destroy(parts.mechanism);
}

/* Only freeze can compare the point with the particle, because the particle may be moved until
 * then. */
static void freezing_refuses_a_point_off_its_particle(void **state)
{
  (void)state;
  every_element parts = open_parts();
  baum_spatial_particle_def ball;
  check(baum_mechanism_get_spatial_particle(parts.mechanism, parts.ball, &ball, sizeof ball));
  /* Replaces the name that was read, because it belongs to the old definition, which is freed. */
  ball.name = "ball";
  ball.position[1] += 1e-6;
  check(baum_mechanism_set_spatial_particle(parts.mechanism, parts.ball, &ball));
  ASSERT_SAYS(baum_mechanism_freeze(parts.mechanism), BAUM_ERR_ARGUMENT,
              "\"wire\": point is (0.2, 0.05, 0.15) m, must be at the particle |\"ball\", whose "
              "design position is (0.2, 0.050001, 0.15) m");
  ball.position[1] -= 1e-6;
  check(baum_mechanism_set_spatial_particle(parts.mechanism, parts.ball, &ball));
  check(baum_mechanism_freeze(parts.mechanism));
  baum_mechanism_destroy(parts.mechanism);
}

static void loads_that_a_particle_cannot_take_are_refused(void **state)
{
  (void)state;
  every_element parts = open_parts();
  baum_spatial_load_def def = baum_spatial_load_def_default();
  def.name = "push";
  def.body = parts.ball;
  def.moment[1] = 0.5;
  ASSERT_SAYS(baum_mechanism_add_spatial_load(parts.mechanism, &def, NULL), BAUM_ERR_ARGUMENT,
              "\"push\": moment is (0, 0.5, 0) N m, must be (0, 0, 0) on the particle |\"ball\"");
  def.moment[1] = 0.0;
  def.point[0] = 1e-200;
  ASSERT_SAYS(baum_mechanism_add_spatial_load(parts.mechanism, &def, NULL), BAUM_ERR_ARGUMENT,
              "\"push\": point is (1e-200, 0, 0) m, must be (0, 0, 0) on the particle |\"ball\"");
  def.point[0] = 0.0;
  def.follows_body = true;
  ASSERT_SAYS(baum_mechanism_add_spatial_load(parts.mechanism, &def, NULL), BAUM_ERR_ARGUMENT,
              "\"push\": body is body |\"ball\", which has no orientation");
  def.follows_body = false;
  def.force[2] = 1.0;
  assert_int_equal(baum_mechanism_add_spatial_load(parts.mechanism, &def, NULL), BAUM_OK);
  def.body = parts.masses;
  ASSERT_SAYS(baum_mechanism_add_spatial_load(parts.mechanism, &def, NULL), BAUM_ERR_ARGUMENT,
              "\"push\": body is body |\"masses\", which has no place in space");
  def.body = BAUM_GROUND;
  ASSERT_SAYS(baum_mechanism_add_spatial_load(parts.mechanism, &def, NULL), BAUM_ERR_ARGUMENT,
              "\"push\": body is ground, which does not move");
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- opposite axes ---- */

/* Joins a body to ground. The axis of the joint on ground is z. The axis on the body is `axis_b`.
 * If `axis_b` is NULL, the definition does not give this axis. */
static baum_mechanism *mount(const char *kind_name, const double *axis_b)
{
  const element_kind *kind = kind_of(kind_name);
  static const double origin[3] = {0.0, 0.0, 0.0};
  baum_spatial_body_def body = baum_spatial_body_def_default();
  baum_body_id id;
  any_def def;
  baum_mechanism *mechanism = create_mechanism();
  check(baum_mechanism_add_spatial_body(mechanism, &body, &id));
  kind->init(&def, kind->size);
  def.head.name = "mount";
  assert_true(set_field(&def, kind, "body_a", &BAUM_GROUND));
  assert_true(set_field(&def, kind, "body_b", &id));
  assert_true(set_field(&def, kind, "point", origin));
  assert_true(!axis_b || set_field(&def, kind, "axis_b", axis_b));
  any_id joint;
  check(kind->add(mechanism, &def, &joint));
  return mechanism;
}

static const char *const directed[] = {"spatial_revolute", "spatial_cylindrical",
                                       "spatial_prismatic", "spatial_planar", "spatial_fixed"};

static void freezing_refuses_opposite_axes(void **state)
{
  (void)state;
  static const double bad[2][3] = {{0.0, 0.0, -3.0}, {1e-5, 0.0, -1.0}};
  static const double good[3] = {0.01, 0.0, -1.0};
  for (int k = 0; k < 4; k++) {
    for (int i = 0; i < 2; i++) {
      baum_mechanism *mechanism = mount(directed[k], bad[i]);
      ASSERT_SAYS(baum_mechanism_freeze(mechanism), BAUM_ERR_ARGUMENT,
                  "\"mount\": axis and axis_b point in opposite directions in the design "
                  "configuration; reverse one of them");
      baum_mechanism_destroy(mechanism);
    }
    baum_mechanism *mechanism = mount(directed[k], good);
    assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
    baum_mechanism_destroy(mechanism);
  }
}

static void freezing_refuses_axes_that_leave_coordinates_open(void **state)
{
  (void)state;
  static const double along[3] = {1e-7, 0.0, -2.0};
  static const double z[3] = {0.0, 0.0, 1.0};
  baum_mechanism *mechanism = mount("spatial_universal", along);
  ASSERT_SAYS(baum_mechanism_freeze(mechanism), BAUM_ERR_ARGUMENT,
              "\"mount\": axis and axis_b are parallel in the design configuration, must be "
              "perpendicular");
  baum_mechanism_destroy(mechanism);
  mechanism = mount("spatial_planar", NULL);
  baum_joint_id id = baum_mechanism_joint_at(mechanism, 0);
  baum_spatial_planar_def def;
  check(baum_mechanism_get_spatial_planar(mechanism, id, &def, sizeof def));
  memcpy(def.x_axis, z, sizeof z);
  check(baum_mechanism_set_spatial_planar(mechanism, id, &def));
  ASSERT_SAYS(baum_mechanism_freeze(mechanism), BAUM_ERR_ARGUMENT,
              "\"mount\": x_axis is parallel to axis; give another");
  baum_mechanism_destroy(mechanism);
}

/* Assembles from an orientation in which all rows are satisfied, although two axes of the joint
 * point in opposite directions. Assembly must refuse this orientation. */
static void check_reversed(const char *kind, const double orientation[4])
{
  baum_mechanism *mechanism = mount(kind, NULL);
  baum_workspace *w = NULL;
  double q[7];
  double v[6];
  double phi[6];
  int32_t nc = 0;
  check(baum_mechanism_freeze(mechanism));
  check(baum_mechanism_sizes(mechanism, NULL, NULL, &nc));
  check(baum_workspace_create(mechanism, &w));
  check(baum_workspace_design(w, q, v));
  assert_int_equal(baum_workspace_assemble(w, 0.0, q, v, NULL, 0), BAUM_OK);
  memcpy(q + 3, orientation, 4 * sizeof *q);
  check(baum_workspace_phi(w, 0.0, q, phi));
  for (int i = 0; i < nc; i++) {
    assert_true(fabs(phi[i]) < 1e-15);
  }
  ASSERT_SAYS(baum_workspace_assemble(w, 0.0, q, v, NULL, 0), BAUM_ERR_INCONSISTENT,
              "t = 0 s: assembly makes the axes of |\"mount\"|; give a configuration "
              "in which they point in the same direction");
  baum_workspace_destroy(w);
  baum_mechanism_destroy(mechanism);
}

static void assembly_refuses_joints_that_end_the_wrong_way_round(void **state)
{
  (void)state;
  static const double about_x[4] = {0.0, 1.0, 0.0, 0.0};
  static const double about_z[4] = {0.0, 0.0, 0.0, 1.0};
  /* A rotation by 120 degrees about (1, 1, 1). */
  static const double third[4] = {0.5, 0.5, 0.5, 0.5};
  for (size_t k = 0; k < sizeof directed / sizeof *directed; k++) {
    check_reversed(directed[k], about_x);
  }
  check_reversed("spatial_prismatic", about_z);
  check_reversed("spatial_fixed", about_z);
  check_reversed("spatial_fixed", third);
}

/* Two spherical joints hold the x axis of the body in one direction. In the design configuration,
 * the x axis differs from this direction by 1.2 rad. */
static void a_body_turned_too_far_off_is_refused(void **state)
{
  (void)state;
  const double turned[3] = {cos(1.2), sin(1.2), 0.0};
  baum_mechanism *mechanism = create_mechanism();
  baum_spatial_body_def body = baum_spatial_body_def_default();
  body.name = "bar";
  baum_spatial_spherical_def joint = baum_spatial_spherical_def_default();
  joint.body_a = BAUM_GROUND;
  assert_int_equal(baum_mechanism_add_spatial_body(mechanism, &body, &joint.body_b), BAUM_OK);
  for (int k = 0; k < 2; k++) {
    for (int i = 0; i < 3; i++) {
      joint.point_a[i] = k * turned[i];
      joint.point_b[i] = k * (i == 0);
    }
    assert_int_equal(baum_mechanism_add_spatial_spherical(mechanism, &joint, NULL), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_euler();
  options.step = 1e-3;
  check_run_refused(mechanism, &options, BAUM_ERR_INCONSISTENT,
                    "assembly would move body 1 \"bar\" by 1.2 rad, more than 1 rad");
  baum_mechanism_destroy(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(orientations_that_are_no_unit_quaternion_are_refused),
    cmocka_unit_test(inertias_that_no_body_has_are_refused),
    cmocka_unit_test(axes_without_direction_are_refused),
    cmocka_unit_test(wrong_cables_are_refused),
    cmocka_unit_test(wrong_knife_edges_are_refused),
    cmocka_unit_test(the_shortest_axis_has_a_direction),
    cmocka_unit_test(bodies_of_the_wrong_kind_are_refused),
    cmocka_unit_test(coordinates_that_joints_do_not_have_are_refused),
    cmocka_unit_test(points_are_given_in_one_way_only),
    cmocka_unit_test(freezing_refuses_a_point_off_its_particle),
    cmocka_unit_test(loads_that_a_particle_cannot_take_are_refused),
    cmocka_unit_test(freezing_refuses_opposite_axes),
    cmocka_unit_test(freezing_refuses_axes_that_leave_coordinates_open),
    cmocka_unit_test(assembly_refuses_joints_that_end_the_wrong_way_round),
    cmocka_unit_test(a_body_turned_too_far_off_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
