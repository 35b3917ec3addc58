/* SPDX-License-Identifier: BSD-3-Clause */
/* RATTLE supports neither forces that depend on velocities nor variable masses. When it refuses a
 * mechanism, its message must name the elements that have such forces or masses. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "manifold_scenes.h"
#include "message.h"
#include "runs.h"

/* ---- a bar on a pin, and the elements that act on it ---- */

typedef struct scene {
  baum_mechanism *mechanism;
  baum_body_id bar;
} scene;

static scene make_bar(void)
{
  scene s = {.mechanism = create_mechanism()};
  baum_planar_body_def bar = baum_planar_body_def_default();
  bar.name = "bar";
  bar.mass = 1.0;
  bar.inertia = 0.1;
  bar.position[0] = 0.5;
  check(baum_mechanism_add_planar_body(s.mechanism, &bar, &s.bar));
  (void)add_planar_pin(s.mechanism, NULL, BAUM_GROUND, s.bar, 0.0, 0.0);
  return s;
}

/* Freezes the mechanism, starts a run of RATTLE and destroys the mechanism. */
static baum_status start(const scene *s, baum_simulation **run)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rattle();
  options.step = 1e-3;
  check(baum_mechanism_freeze(s->mechanism));
  baum_status status = baum_simulation_create(s->mechanism, &options, run);
  baum_mechanism_destroy(s->mechanism);
  return status;
}

static void expect_refusal(const scene *s, const char *parts)
{
  baum_simulation *run = NULL;
  ASSERT_SAYS(start(s, &run), BAUM_ERR_UNSUPPORTED, parts);
  assert_null(run);
}

static void expect_run(const scene *s)
{
  baum_simulation *run = NULL;
  check(start(s, &run));
  check(baum_simulation_step(run, 50));
  baum_simulation_destroy(run);
}

/* ---- springs ---- */

static int hard(double length, double rate, double out[3], void *user)
{
  (void)rate;
  (void)user;
  out[0] = 2.0 * length * length;
  out[1] = 4.0 * length;
  return 0;
}

static int damped(double length, double rate, double out[3], void *user)
{
  const double *damping = user;
  out[0] = length + *damping * rate;
  out[1] = 1.0;
  out[2] = *damping;
  return 0;
}

static baum_planar_spring_def coil(const scene *s)
{
  baum_planar_spring_def spring = baum_planar_spring_def_default();
  spring.name = "coil";
  spring.body_a = BAUM_GROUND;
  spring.body_b = s->bar;
  spring.point_a[0] = 0.0;
  spring.point_a[1] = 2.0;
  spring.point_b[0] = 0.5;
  spring.point_b[1] = 0.0;
  return spring;
}

static void add_spring(const scene *s, double damping)
{
  baum_planar_spring_def spring = coil(s);
  spring.stiffness = 3.0;
  spring.damping = damping;
  check(baum_mechanism_add_planar_spring(s->mechanism, &spring, NULL));
}

static void add_law(const scene *s, baum_spring_fn *law, bool depends, double *user)
{
  baum_planar_spring_def spring = coil(s);
  spring.law = law;
  spring.depends_on_velocity = depends;
  spring.user = user;
  check(baum_mechanism_add_planar_spring(s->mechanism, &spring, NULL));
}

static void add_torsion_spring(const scene *s, double damping)
{
  baum_planar_torsion_spring_def spring = baum_planar_torsion_spring_def_default();
  spring.name = "hairspring";
  spring.body_a = BAUM_GROUND;
  spring.body_b = s->bar;
  spring.stiffness = 2.0;
  spring.damping = damping;
  check(baum_mechanism_add_planar_torsion_spring(s->mechanism, &spring, NULL));
}

static void springs_are_supported_and_dampers_are_refused(void **state)
{
  (void)state;
  double tiny = 1e-6;
  scene s = make_bar();
  add_spring(&s, 0.0);
  add_torsion_spring(&s, 0.0);
  add_law(&s, hard, false, NULL);
  expect_run(&s);

  s = make_bar();
  add_torsion_spring(&s, 0.0);
  add_spring(&s, 1e-9);
  expect_refusal(&s, "rattle|time and position only|force 2 \"coil\" depends on velocities");

  s = make_bar();
  add_torsion_spring(&s, 1e-9);
  expect_refusal(&s, "force 1 \"hairspring\"");

  s = make_bar();
  add_law(&s, damped, true, &tiny);
  expect_refusal(&s, "force 1 \"coil\"");
}

/* ---- user functions ---- */

typedef struct behaviour {
  double drag;    /* the force is -drag v */
  bool by_time;   /* adds cos t to the force */
  bool claims;    /* declares that the force does not depend on v, and that the mass is constant */
  double inertia; /* the mass is 1 + inertia x^2 */
} behaviour;

static int user_force(double t, const double *q, const double *v, const double *inputs, double *out,
                      void *user)
{
  (void)inputs;
  const behaviour *b = user;
  out[0] = -q[0] + (b->by_time ? cos(t) : 0.0) - b->drag * v[0];
  return 0;
}

static int plunger_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  const behaviour *b = user;
  out[0] = 1.0 + b->inertia * q[0] * q[0];
  return 0;
}

static void add_user_force(const scene *s, behaviour *b)
{
  baum_user_force_def def = baum_user_force_def_default();
  def.name = "wind";
  def.bodies = &s->bar;
  def.body_count = 1;
  def.force = user_force;
  def.depends_on_velocity = !b->claims;
  def.user = b;
  check(baum_mechanism_add_user_force(s->mechanism, &def, NULL));
}

static void add_coordinate(const scene *s, behaviour *b)
{
  static const double at[1] = {0.5};
  static const double rest[1] = {0.0};
  baum_coordinates_def def = baum_coordinates_def_default();
  def.name = "plunger";
  def.size = 1;
  def.q = at;
  def.v = rest;
  def.mass = plunger_mass;
  def.force = user_force;
  def.constant_mass = b->claims;
  def.depends_on_velocity = !b->claims;
  def.user = b;
  check(baum_mechanism_add_coordinates(s->mechanism, &def, NULL));
}

/* In space, the gyroscopic moments of rigid bodies also depend on velocities. RATTLE supports these
 * moments, and refuses only the damper. */
static void a_damper_in_space_is_refused(void **state)
{
  (void)state;
  for (int damped_too = 0; damped_too < 2; damped_too++) {
    scene s = {.mechanism = NULL};
    baum_spatial_body_def body = baum_spatial_body_def_default();
    baum_spatial_spring_def spring = baum_spatial_spring_def_default();
    s.mechanism = create_mechanism();
    body.inertia[0] = 2.0;
    body.angular_velocity[1] = 1.0;
    check(baum_mechanism_add_spatial_body(s.mechanism, &body, &spring.body_b));
    spring.name = "strut";
    spring.body_a = BAUM_GROUND;
    spring.point_a[0] = 2.0;
    spring.point_a[1] = spring.point_a[2] = 0.0;
    spring.point_b[1] = 0.5;
    spring.point_b[0] = spring.point_b[2] = 0.0;
    spring.stiffness = 3.0;
    spring.damping = damped_too ? 1e-9 : 0.0;
    check(baum_mechanism_add_spatial_spring(s.mechanism, &spring, NULL));
    if (damped_too) {
      expect_refusal(&s, "force 1 \"strut\" depends on velocities");
    } else {
      expect_run(&s);
    }
  }
}

static void damping_is_refused_as_damping(void **state)
{
  (void)state;
  scene s = {.mechanism = create_mechanism()};
  baum_spatial_body_def body = baum_spatial_body_def_default();
  baum_spatial_bushing_def bushing = baum_spatial_bushing_def_default();
  bushing.body_a = BAUM_GROUND;
  memset(bushing.point, 0, sizeof bushing.point);
  bushing.damping[0] = 1.0;
  assert_int_equal(baum_mechanism_add_spatial_body(s.mechanism, &body, &bushing.body_b), BAUM_OK);
  assert_int_equal(baum_mechanism_add_spatial_bushing(s.mechanism, &bushing, NULL), BAUM_OK);
  expect_refusal(&s, "force 1|depends on velocities, because its damping is not 0; take");
}

/* RATTLE knows how the momenta of rigid bodies change on SO(3). It does not know this for a
 * manifold that the user defines. */
static void gyroscopic_moments_of_the_user_are_refused(void **state)
{
  (void)state;
  scene s = {.mechanism = create_mechanism()};
  manifold_scene_find("free top")->build(s.mechanism);
  expect_refusal(&s, "body 1|depends on velocities, or does not set depends_on_velocity = false");
}

static void functions_of_time_and_position_are_supported(void **state)
{
  (void)state;
  behaviour b = {.by_time = true, .claims = true};
  scene s = make_bar();
  add_user_force(&s, &b);
  add_coordinate(&s, &b);
  expect_run(&s);
}

static void functions_without_a_declaration_are_refused_by_name(void **state)
{
  (void)state;
  behaviour calm = {.claims = true};
  behaviour silent = {0};
  scene s = make_bar();
  add_user_force(&s, &calm);
  add_user_force(&s, &silent);
  expect_refusal(&s, "force 2 \"wind\" depends on velocities|depends_on_velocity = false");

  s = make_bar();
  add_coordinate(&s, &silent);
  expect_refusal(&s, "rattle needs constant masses|body 2 \"plunger\"|constant_mass = true");
}

/* Expects that the check of derivatives refuses the mechanism. This check does not depend on the
 * integrator. */
static void expect_denial(const scene *s, const char *parts)
{
  check(baum_mechanism_freeze(s->mechanism));
  ASSERT_SAYS(baum_mechanism_check_derivatives(s->mechanism), BAUM_ERR_ARGUMENT, parts);
  baum_mechanism_destroy(s->mechanism);
}

static void false_declarations_are_found(void **state)
{
  (void)state;
  double tiny = 1e-6;
  behaviour drag = {.drag = 1e-6, .claims = true};
  scene s = make_bar();
  add_user_force(&s, &drag);
  expect_denial(&s, "force 1 \"wind\": force()[0] is|at rest|depends_on_velocity is false");

  s = make_bar();
  add_coordinate(&s, &drag);
  expect_denial(&s, "body 2 \"plunger\": force()[0] is|depends_on_velocity is false");

  s = make_bar();
  add_law(&s, damped, false, &tiny);
  expect_denial(&s, "force 1 \"coil\": law()[0] is|depends_on_velocity is false");
}

static void only_index_3_without_gains_is_offered(void **state)
{
  (void)state;
  scene s = make_bar();
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rattle();
  options.step = 1e-3;
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  check(baum_mechanism_freeze(s.mechanism));
  check_run_refused(s.mechanism, &options, BAUM_ERR_UNSUPPORTED,
                    "rattle does not offer the formulation baumgarte|offers index3");
  options.formulation = BAUM_FORMULATION_DEFAULT;
  options.gains = baum_gains_fixed(1.0, 1.0);
  check_run_refused(s.mechanism, &options, BAUM_ERR_ARGUMENT, "gains are given");
  options.gains = (baum_gains){0};
  options.rtol = 1e-6;
  check_run_refused(s.mechanism, &options, BAUM_ERR_ARGUMENT, "rattle has a fixed step");
  baum_mechanism_destroy(s.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(springs_are_supported_and_dampers_are_refused),
    cmocka_unit_test(a_damper_in_space_is_refused),
    cmocka_unit_test(damping_is_refused_as_damping),
    cmocka_unit_test(gyroscopic_moments_of_the_user_are_refused),
    cmocka_unit_test(functions_of_time_and_position_are_supported),
    cmocka_unit_test(functions_without_a_declaration_are_refused_by_name),
    cmocka_unit_test(false_declarations_are_found),
    cmocka_unit_test(only_index_3_without_gains_is_offered),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
