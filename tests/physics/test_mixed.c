/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests mechanisms of planar and spatial bodies. A planar slider-crank carries a spatial pendulum
 * on its rod. This mechanism is compared with the same mechanism made only of spatial bodies, with
 * every integrator of this build and all its formulations. Furthermore, accelerations and
 * multipliers must satisfy the equations of motion for every kind of spatial joint on a planar body
 * or particle. */
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
#include "runs.h"
#include "step_mode.h"

enum { CRANK, ROD, SLIDER, BOB, BODIES, NUMBERS = 2 * 3 + 7, MOST = 32 };

static const double END = 0.25;

/* ---- a slider-crank with a pendulum ---- */

typedef struct assembly {
  baum_mechanism *mechanism;
  baum_body_id bodies[BODIES];
  baum_joint_id crank_pin;
  baum_joint_id ball;
} assembly;

/* Adds a link at (x, y) with the given angle, as a planar body or as a spatial body. */
static baum_body_id add_link(baum_mechanism *m, bool spatial, const double at[3], double mass,
                             double speed)
{
  baum_body_id id;
  if (!spatial) {
    baum_planar_body_def def = baum_planar_body_def_default();
    def.mass = mass;
    def.inertia = 0.1 * mass;
    memcpy(def.position, at, sizeof def.position);
    def.angle = at[2];
    def.angular_velocity = speed;
    check(baum_mechanism_add_planar_body(m, &def, &id));
    return id;
  }
  baum_spatial_body_def def = baum_spatial_body_def_default();
  const double inertia[6] = {0.02 * mass, 0.09 * mass, 0.1 * mass};
  def.mass = mass;
  memcpy(def.inertia, inertia, sizeof inertia);
  memcpy(def.position, at, 2 * sizeof *at);
  def.orientation[0] = cos(0.5 * at[2]);
  def.orientation[3] = sin(0.5 * at[2]);
  def.angular_velocity[2] = speed;
  check(baum_mechanism_add_spatial_body(m, &def, &id));
  return id;
}

static baum_joint_id add_pin(baum_mechanism *m, bool spatial, baum_body_id a, baum_body_id b,
                             const double at[2])
{
  baum_joint_id id;
  if (!spatial) {
    baum_planar_revolute_def def = baum_planar_revolute_def_default();
    def.body_a = a;
    def.body_b = b;
    memcpy(def.point, at, sizeof def.point);
    check(baum_mechanism_add_planar_revolute(m, &def, &id));
    return id;
  }
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  const double point[3] = {at[0], at[1], 0.0};
  def.body_a = a;
  def.body_b = b;
  memcpy(def.point, point, sizeof point);
  check(baum_mechanism_add_spatial_revolute(m, &def, &id));
  return id;
}

static void add_slide(baum_mechanism *m, bool spatial, baum_body_id b, const double at[2])
{
  if (!spatial) {
    baum_planar_translational_def def = baum_planar_translational_def_default();
    def.body_a = BAUM_GROUND;
    def.body_b = b;
    memcpy(def.point, at, sizeof def.point);
    check(baum_mechanism_add_planar_translational(m, &def, NULL));
    return;
  }
  baum_spatial_prismatic_def def = baum_spatial_prismatic_def_default();
  const double point[3] = {at[0], at[1], 0.0};
  const double axis[3] = {1.0, 0.0, 0.0};
  def.body_a = BAUM_GROUND;
  def.body_b = b;
  memcpy(def.point, point, sizeof point);
  memcpy(def.axis, axis, sizeof axis);
  check(baum_mechanism_add_spatial_prismatic(m, &def, NULL));
}

/* Adds a bob whose centre is below, behind and beside the point `at`. If `rigid` is true, it is
 * welded to the body; otherwise it hangs on a spherical joint. */
static void add_bob(assembly *s, baum_body_id on, const double at[2], bool rigid)
{
  baum_spatial_body_def def = baum_spatial_body_def_default();
  const double inertia[6] = {0.02, 0.01, 0.015, 0.001, -0.002, 0.0};
  const double position[3] = {at[0] + 0.05, at[1] - 0.2, 0.15};
  const double spin[3] = {1.0, 0.5, 2.0};
  def.mass = 0.5;
  memcpy(def.inertia, inertia, sizeof inertia);
  memcpy(def.position, position, sizeof position);
  if (!rigid) {
    memcpy(def.angular_velocity, spin, sizeof spin);
  }
  check(baum_mechanism_add_spatial_body(s->mechanism, &def, &s->bodies[BOB]));
  baum_spatial_spherical_def ball = baum_spatial_spherical_def_default();
  baum_spatial_fixed_def weld = baum_spatial_fixed_def_default();
  ball.body_a = weld.body_a = on;
  ball.body_b = weld.body_b = s->bodies[BOB];
  ball.point[0] = weld.point[0] = at[0];
  ball.point[1] = weld.point[1] = at[1];
  ball.point[2] = weld.point[2] = 0.0;
  check(rigid ? baum_mechanism_add_spatial_fixed(s->mechanism, &weld, &s->ball)
              : baum_mechanism_add_spatial_spherical(s->mechanism, &ball, &s->ball));
}

/* Makes the mechanism. The bodies of its slider-crank are planar or spatial. If `driven` is true, a
 * driver moves the crank and the bob is welded to the rod. */
static assembly make(bool spatial, bool driven)
{
  static const double crank = 0.3;
  static const double rod = 0.8;
  static const double origin[2] = {0.0, 0.0};
  const double angle = 0.7;
  const double tilt = -asin(crank * sin(angle) / rod);
  const double pin[2] = {crank * cos(angle), crank * sin(angle)};
  const double end[3] = {pin[0] + rod * cos(tilt), 0.0, 0.0};
  const double crank_at[3] = {0.5 * pin[0], 0.5 * pin[1], angle};
  const double rod_at[3] = {0.5 * (pin[0] + end[0]), 0.5 * pin[1], tilt};
  const double hook[2] = {rod_at[0] + 0.1 * cos(tilt), rod_at[1] + 0.1 * sin(tilt)};
  assembly s = {.mechanism = create_mechanism()};
  baum_mechanism *m = s.mechanism;
  s.bodies[CRANK] = add_link(m, spatial, crank_at, 1.0, driven ? (double)NAN : 5.0);
  s.bodies[ROD] = add_link(m, spatial, rod_at, 2.0, (double)NAN);
  s.bodies[SLIDER] = add_link(m, spatial, end, 3.0, (double)NAN);
  s.crank_pin = add_pin(m, spatial, BAUM_GROUND, s.bodies[CRANK], origin);
  add_pin(m, spatial, s.bodies[CRANK], s.bodies[ROD], pin);
  add_pin(m, spatial, s.bodies[ROD], s.bodies[SLIDER], end);
  add_slide(m, spatial, s.bodies[SLIDER], end);
  add_bob(&s, s.bodies[ROD], hook, driven);
  if (driven) {
    baum_driver_def motor = baum_driver_def_default();
    motor.joint = s.crank_pin;
    motor.value = spatial ? 0.0 : angle; /* spatial angles are 0 in the design configuration */
    motor.rate = 5.0;
    check(baum_mechanism_add_driver(m, &motor, NULL));
  }
  check(baum_mechanism_freeze(m));
  return s;
}

/* ---- runs ---- */

/* The state at the end of a run. The reaction is that of the joint that holds the bob. */
typedef struct outcome {
  double places[NUMBERS]; /* x, y of three links, pose of the bob */
  double reaction[6];
  double energy[2];
} outcome;

static outcome run_to(bool spatial, bool driven, double end, const baum_simulation_options *options)
{
  outcome out;
  assembly s = make(spatial, driven);
  baum_channel reaction = baum_channel_of(BAUM_JOINT_REACTION);
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  reaction.joint = s.ball;
  baum_simulation *run = create_run(s.mechanism, options);
  check(baum_simulation_advance_to(run, end));
  for (int k = 0; k < BODIES; k++) {
    int32_t first;
    check(baum_mechanism_columns(s.mechanism, s.bodies[k], &first, NULL));
    memcpy(out.places + (ptrdiff_t)2 * k, baum_simulation_q(run) + first,
           (k == BOB ? 7 : 2) * sizeof *out.places);
  }
  check(baum_simulation_get(run, &reaction, 1, out.reaction));
  check(baum_simulation_get(run, &energy, 1, out.energy));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
  return out;
}

static double apart(int n, const double *x, const double *y)
{
  double largest = 0.0;
  for (int i = 0; i < n; i++) {
    largest = fmax(largest, fabs(x[i] - y[i]));
  }
  return largest;
}

/* Runs the mixed and the spatial model by the same method. Returns the difference of their
 * positions. The mixed model must not be much less accurate than the spatial one. */
static double compare(const baum_simulation_options *options, const outcome *exact)
{
  const outcome mixed = run_to(false, false, END, options);
  const outcome spatial = run_to(true, false, END, options);
  double error = apart(NUMBERS, spatial.places, exact->places);
  assert_true(apart(NUMBERS, mixed.places, exact->places) <= 4.0 * error + 1e-10);
  return apart(NUMBERS, mixed.places, spatial.places);
}

/* With projection and with implicit methods, both models satisfy the same constraints. Their
 * results therefore differ only because the formulas for rotations differ. With other formulations,
 * each model drifts off the constraints in a different way. */
static void planar_links_move_like_spatial_links(void **state)
{
  (void)state;
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-13;
  const outcome exact = run_to(true, false, END, &options);
  for (int k = 0; step_mode_at(k).integrator; k++) {
    const step_mode mode = step_mode_at(k);
    double least = (double)INFINITY;
    options = step_mode_options(mode, 2.5e-5, 1e-12);
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      options.formulation = (baum_formulation)f;
      if (baum_integrator_offers(mode.integrator, options.formulation)) {
        least = fmin(least, compare(&options, &exact));
      }
    }
    printf("%-20s %-14s apart %.1e\n", baum_integrator_name(mode.integrator),
           mode.fixed ? "fixed step" : "variable step", least);
    assert_true(least <= 1e-10);
  }
}

/* Spatial reactions also contain the force normal to the plane and the moments about axes in it. */
static void planar_and_spatial_links_have_the_same_reactions_and_energies(void **state)
{
  (void)state;
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-13;
  for (int driven = 0; driven < 2; driven++) {
    const outcome mixed = run_to(false, driven == 1, END, &options);
    const outcome spatial = run_to(true, driven == 1, END, &options);
    assert_true(apart(6, mixed.reaction, spatial.reaction) <= 1e-10);
    assert_true(apart(2, mixed.energy, spatial.energy) <= 1e-10);
    assert_true(fabs(mixed.reaction[2]) + fabs(mixed.reaction[3]) > 0.1);
  }
}

static void planar_and_spatial_links_have_the_same_kinematics(void **state)
{
  (void)state;
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_kinematics();
  const outcome mixed = run_to(false, true, END, &options);
  const outcome spatial = run_to(true, true, END, &options);
  assert_true(apart(NUMBERS, mixed.places, spatial.places) <= 1e-13);
  assert_true(apart(6, mixed.reaction, spatial.reaction) <= 1e-11);
}

/* ---- every kind of joint ---- */

static const double HOOK[3] = {1.3, 0.2, 0.0};
static const double AXIS[3] = {0.3, -1.0, 0.7};
static const double ACROSS[3] = {1.0, 0.3, 0.0}; /* perpendicular to AXIS */

#define JOIN(NAME)                                                          \
  static void add_##NAME(baum_mechanism *m, baum_body_id a, baum_body_id b) \
  {                                                                         \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default();    \
    def.body_a = a;                                                         \
    def.body_b = b;                                                         \
    memcpy(def.point, HOOK, sizeof HOOK);                                   \
    check(baum_mechanism_add_spatial_##NAME(m, &def, NULL));                \
  }

#define JOIN_AXIS(NAME)                                                     \
  static void add_##NAME(baum_mechanism *m, baum_body_id a, baum_body_id b) \
  {                                                                         \
    baum_spatial_##NAME##_def def = baum_spatial_##NAME##_def_default();    \
    def.body_a = a;                                                         \
    def.body_b = b;                                                         \
    memcpy(def.point, HOOK, sizeof HOOK);                                   \
    memcpy(def.axis, AXIS, sizeof AXIS);                                    \
    check(baum_mechanism_add_spatial_##NAME(m, &def, NULL));                \
  }

JOIN(spherical)
JOIN(fixed)
JOIN_AXIS(revolute)
JOIN_AXIS(cylindrical)
JOIN_AXIS(prismatic)
JOIN_AXIS(planar)
JOIN_AXIS(constant_velocity)
JOIN_AXIS(point_on_line)
JOIN_AXIS(point_on_plane)

static void add_universal(baum_mechanism *m, baum_body_id a, baum_body_id b)
{
  baum_spatial_universal_def def = baum_spatial_universal_def_default();
  def.body_a = a;
  def.body_b = b;
  memcpy(def.point, HOOK, sizeof HOOK);
  memcpy(def.axis, AXIS, sizeof AXIS);
  memcpy(def.axis_b, ACROSS, sizeof ACROSS);
  check(baum_mechanism_add_spatial_universal(m, &def, NULL));
}

static void add_screw(baum_mechanism *m, baum_body_id a, baum_body_id b)
{
  baum_spatial_screw_def def = baum_spatial_screw_def_default();
  def.body_a = a;
  def.body_b = b;
  memcpy(def.point, HOOK, sizeof HOOK);
  memcpy(def.axis, AXIS, sizeof AXIS);
  def.pitch = 0.4;
  check(baum_mechanism_add_spatial_screw(m, &def, NULL));
}

static void add_distance(baum_mechanism *m, baum_body_id a, baum_body_id b)
{
  baum_spatial_distance_def def = baum_spatial_distance_def_default();
  def.body_a = a;
  def.body_b = b;
  memset(def.point_a, 0, sizeof def.point_a);
  memset(def.point_b, 0, sizeof def.point_b);
  check(baum_mechanism_add_spatial_distance(m, &def, NULL));
}

typedef void add_fn(baum_mechanism *m, baum_body_id a, baum_body_id b);

/* The first two joints of this list can be on particles. */
static add_fn *const KINDS[] = {
  add_spherical,   add_distance,          add_revolute,      add_universal,
  add_cylindrical, add_prismatic,         add_planar,        add_fixed,
  add_screw,       add_constant_velocity, add_point_on_line, add_point_on_plane};
enum { KIND_COUNT = sizeof KINDS / sizeof *KINDS, WITH_PARTICLES = 2 };

/* Makes two pinned links, a rod to a planar particle, and a spatial body on the second link or on
 * the particle. */
static baum_mechanism *make_kind(int kind, bool swapped, bool particle)
{
  static const double at[2][3] = {{0.5, 0.1, 0.2}, {1.2, 0.3, -0.4}};
  static const double pins[2][2] = {{0.0, 0.0}, {1.0, 0.2}};
  baum_body_id links[2];
  baum_body_id bead;
  baum_body_id tool;
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 1.0, -9.81, 3.0));
  links[0] = add_link(m, false, at[0], 1.0, 3.0);
  links[1] = add_link(m, false, at[1], 2.0, -2.0);
  add_pin(m, false, BAUM_GROUND, links[0], pins[0]);
  add_pin(m, false, links[0], links[1], pins[1]);
  baum_planar_particle_def ball = baum_planar_particle_def_default();
  memcpy(ball.position, HOOK, sizeof ball.position);
  check(baum_mechanism_add_planar_particle(m, &ball, &bead));
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.body_a = links[0];
  rod.body_b = bead;
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  check(baum_mechanism_add_planar_distance(m, &rod, NULL));
  const double place[3] = {1.5, -0.1, 0.2};
  baum_spatial_body_def body = baum_spatial_body_def_default();
  const double inertia[6] = {0.2, 0.1, 0.15, 0.01, -0.02, 0.0};
  memcpy(body.position, place, sizeof place);
  memcpy(body.inertia, inertia, sizeof inertia);
  check(baum_mechanism_add_spatial_body(m, &body, &tool));
  const baum_body_id on = particle ? bead : links[1];
  KINDS[kind](m, swapped ? tool : on, swapped ? on : tool);
  check(baum_mechanism_freeze(m));
  return m;
}

/* Returns the largest residual of M a + J^T lambda = g and of J a = gamma. The matrices come from
 * the functions of the elements, and a and lambda from the solver. */
static double residual(const baum_mechanism *m, double t, const double *q, const double *v)
{
  static double mass[MOST * MOST];
  static double jacobian[MOST * MOST];
  double force[MOST];
  double gamma[MOST];
  double a[MOST];
  double lambda[MOST];
  double largest = 0.0;
  int32_t nv;
  int32_t nc;
  baum_workspace *w = NULL;
  check(baum_mechanism_sizes(m, NULL, &nv, &nc));
  assert_true(nv <= MOST && nc <= MOST);
  check(baum_workspace_create(m, &w));
  check(baum_workspace_mass(w, t, q, mass));
  check(baum_workspace_jacobian(w, t, q, jacobian));
  check(baum_workspace_force(w, t, q, v, force));
  check(baum_workspace_gamma(w, t, q, v, gamma));
  check(baum_workspace_acceleration(w, t, q, v, 0.0, 0.0, a, lambda));
  for (int i = 0; i < nv; i++) {
    double sum = -force[i];
    for (int k = 0; k < nv; k++) {
      sum += mass[i * nv + k] * a[k];
    }
    for (int k = 0; k < nc; k++) {
      sum += jacobian[k * nv + i] * lambda[k];
    }
    largest = fmax(largest, fabs(sum));
  }
  for (int k = 0; k < nc; k++) {
    double sum = -gamma[k];
    for (int i = 0; i < nv; i++) {
      sum += jacobian[k * nv + i] * a[i];
    }
    largest = fmax(largest, fabs(sum));
  }
  baum_workspace_destroy(w);
  return largest;
}

static void check_kind(baum_mechanism *m, int kind)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.formulation = BAUM_FORMULATION_PROJECTION;
  options.rtol = 1e-9;
  baum_simulation *run = create_run(m, &options);
  check(baum_simulation_advance_to(run, 0.3));
  double left = residual(m, 0.3, baum_simulation_q(run), baum_simulation_v(run));
  if (!(left <= 1e-10)) {
    fail_msg("kind %d: the residual is %.2g", kind, left);
  }
  baum_simulation_destroy(run);
}

static void equations_hold_for_every_joint(void **state)
{
  (void)state;
  for (int kind = 0; kind < KIND_COUNT; kind++) {
    for (int k = 0; k < (kind < WITH_PARTICLES ? 4 : 2); k++) {
      baum_mechanism *m = make_kind(kind, k % 2 == 1, k > 1);
      check_kind(m, kind);
      baum_mechanism_destroy(m);
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(planar_links_move_like_spatial_links),
    cmocka_unit_test(planar_and_spatial_links_have_the_same_reactions_and_energies),
    cmocka_unit_test(planar_and_spatial_links_have_the_same_kinematics),
    cmocka_unit_test(equations_hold_for_every_joint),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
