/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the accuracy of accelerations and multipliers of spatial mechanisms. The solver that the
 * library chooses is compared with a solution in quadruple precision for the same M, J, g and
 * gamma. Every scene is evaluated in several configurations. Some of them satisfy the constraints,
 * and others do not. Every configuration is evaluated with and without stabilization. For every
 * case, the test prints the largest error of a and the largest error of lambda. Each is relative to
 * the largest element. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "posed.h"
#include "spatial.h"

/* The limit for ordinary scenes. It is about ten times the rounding error, amplified by condition
 * numbers of a few hundred. */
static const double ORDINARY = 1e-12;
/* In a chain of 1000 links on revolute joints, forces are large compared with accelerations. */
static const double LONG = 5e-12;
/* Masses or moments of inertia differ by a factor of 1e6. */
static const double UNEVEN = 1e-11;
/* Moments of inertia are small compared with m s^2, where s is the distance of a joint. */
static const double SMALL = 1e-10;
/* If large moments of joints on a light body nearly cancel, rounding the positions or J changes the
 * acceleration of the body by more than the error of the solver. In the tests of uneven masses,
 * ROUNDED times this change is therefore subtracted from the errors. */
static const double ROUNDED = 4.0;
/* A scene is useless for this test if rounded positions change its accelerations by more than this,
 * because the subtraction would then hide errors of the solver. In the scenes below, the largest
 * such change is 1e-8. */
static const double MOST_ROUNDED = 3e-8;
enum { ROUNDINGS = 10 };

enum { POSES = 5, LINKS = 10 };

typedef struct errors {
  double a;
  double lambda;
} errors;

/* How the bodies of a scene differ from those of the mechanism in spatial.h. */
typedef struct change {
  double other; /* factor on mass and inertia of every other body */
  double thin;  /* factor on the smallest moment of inertia of every other body */
} change;

static const change NO_CHANGE = {1.0, 1.0};

/* ---- scenes ---- */

static baum_spatial_body_def changed(baum_spatial_body_def def, change by)
{
  int least = 0;
  for (int i = 1; i < 3; i++) {
    least = def.inertia[i] < def.inertia[least] ? i : least;
  }
  def.mass *= by.other;
  for (int i = 0; i < 6; i++) {
    def.inertia[i] *= by.other;
  }
  bool principal = def.inertia[3] == 0.0 && def.inertia[4] == 0.0 && def.inertia[5] == 0.0;
  def.inertia[least] *= principal ? by.thin : 1.0;
  return def;
}

/* Replaces the mechanism of a model by one in which every `stride`-th body has another mass and
 * inertia. */
static void change_bodies(model *m, change by, int stride)
{
  baum_mechanism *copy = NULL;
  check(baum_mechanism_copy(m->mechanism, &copy));
  for (int k = stride - 1; k < m->body_count; k += stride) {
    baum_spatial_body_def def = baum_spatial_body_def_default();
    check(baum_mechanism_get_spatial_body(copy, m->bodies[k], &def, sizeof def));
    def = changed(def, by);
    check(baum_mechanism_set_spatial_body(copy, m->bodies[k], &def));
  }
  check(baum_mechanism_freeze(copy));
  baum_mechanism_destroy(m->mechanism);
  m->mechanism = copy;
}

static posed pose_scene(model_spatial which, int links, change by)
{
  model m;
  baum_status status = model_spatial_build(which, links, &m);
  if (status == BAUM_OK) {
    change_bodies(&m, by, 2);
  }
  posed p = pose_model(status, m);
  check(baum_workspace_assemble(p.workspace, 0.0, p.q, p.v, NULL, 0));
  return p;
}

/* Moves the scene along its motion from t = 0 to t. */
static void move_along(posed *p, double t)
{
  baum_simulation *run = NULL;
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-6;
  assert_true(baum_simulation_create(p->m.mechanism, &options, &run) >= BAUM_OK);
  assert_true(baum_simulation_advance_to(run, t) >= BAUM_OK);
  memcpy(p->q, baum_simulation_q(run), (size_t)p->nq * sizeof *p->q);
  memcpy(p->v, baum_simulation_v(run), (size_t)p->nv * sizeof *p->v);
  baum_simulation_destroy(run);
}

/* Moves all bodies off the constraints by up to `most` [m], [rad] and [m/s], [rad/s]. */
static void disturb(posed *p, uint64_t *seed, double most)
{
  double *dx = calloc((size_t)p->nv, sizeof *dx);
  assert_non_null(dx);
  for (int i = 0; i < p->nv; i++) {
    dx[i] = draw(seed, -most, most);
    p->v[i] += draw(seed, -most, most);
  }
  check(baum_workspace_move(p->workspace, dx, p->q));
  free(dx);
}

/* ---- errors ---- */

static double worse(double a, double b)
{
  return isnan(a) || a > b ? a : b;
}

/* Returns how much rounded positions change the oracle's accelerations. This must not exceed
 * MOST_ROUNDED. */
static double sensitivity(const posed *p, double gain)
{
  baum_workspace *w = p->workspace;
  double *q = calloc((size_t)(p->nq + p->nv + p->nc), sizeof *q);
  double *a = q + p->nq;
  double most = 0.0;
  uint64_t seed = 3;
  assert_non_null(q);
  for (int k = 0; k < ROUNDINGS; k++) {
    for (int i = 0; i < p->nq; i++) {
      q[i] = p->q[i] + draw(&seed, -0x1p-53, 0x1p-53) * fmax(1.0, fabs(p->q[i]));
    }
    assert_true(
      quad_acceleration_with_gain(w, 0.0, q, p->v, gain, baum_i_omitted_rows(w), a, a + p->nv));
    most = fmax(most, quad_error(p->nv, a, p->want_a));
  }
  free(q);
  assert_true(most <= MOST_ROUNDED);
  return most;
}

/* Updates the largest errors `worst` with the errors at the present state. Calls the internal
 * function for accelerations, because the public one replaces the multipliers by those of least
 * norm if a row is omitted. */
static void meet(posed *p, double gain, double rounded, errors *worst)
{
  baum_workspace *w = p->workspace;
  check(baum_i_acceleration(w, 0.0, p->q, p->v, gain, gain));
  memcpy(p->a, w->a, (size_t)p->nv * sizeof *p->a);
  memcpy(p->lambda, w->lambda, (size_t)p->nc * sizeof *p->lambda);
  assert_true(quad_acceleration_with_gain(w, 0.0, p->q, p->v, gain, baum_i_omitted_rows(w),
                                          p->want_a, p->want_lambda));
  double error = quad_error(p->nv, p->a, p->want_a);
  error -= rounded > 0.0 ? rounded * sensitivity(p, gain) : 0.0;
  worst->a = worse(error, worst->a);
  worst->lambda = worse(quad_error(p->nc, p->lambda, p->want_lambda), worst->lambda);
}

/* Updates the largest errors `worst` with the errors at a state, and with those at a second state
 * that violates the constraints. */
static void meet_all(posed *p, uint64_t *seed, double rounded, errors *worst)
{
  meet(p, 0.0, rounded, worst);
  meet(p, 20.0, rounded, worst);
  disturb(p, seed, 1e-3);
  meet(p, 0.0, rounded, worst);
  meet(p, 20.0, rounded, worst);
}

/* Finds the largest errors at POSES times of the motion up to `span` [s]. */
static errors measure_motion(model_spatial which, int links, double span)
{
  errors worst = {0};
  uint64_t seed = 1;
  posed p = pose_scene(which, links, NO_CHANGE);
  for (int k = 0; k < POSES; k++) {
    if (k > 0) {
      move_along(&p, span * k / (POSES - 1));
    }
    meet_all(&p, &seed, 0.0, &worst);
  }
  unpose(&p);
  return worst;
}

/* Finds the largest errors of a changed scene in POSES random configurations near its start. The
 * configurations are not taken from a motion, because a light body on a stiff spring would require
 * very short steps. */
static errors measure_changed(model_spatial which, int links, change by)
{
  errors worst = {0};
  uint64_t seed = 2;
  for (int k = 0; k < POSES; k++) {
    posed p = pose_scene(which, links, by);
    disturb(&p, &seed, 0.1);
    check(baum_workspace_project(p.workspace, 0.0, p.q, p.v));
    meet_all(&p, &seed, ROUNDED, &worst);
    unpose(&p);
  }
  return worst;
}

/* ---- table ---- */

static void print_head(const char *title)
{
  printf("\n%-44s %10s %10s %10s\n", title, "a", "lambda", "limit");
}

/* Prints a case and returns 1 if its errors exceed the limits. */
static int note(model_spatial which, int links, errors found, double limit, double lambda_limit)
{
  char name[64];
  bool fine = found.a <= limit && found.lambda <= lambda_limit;
  (void)snprintf(name, sizeof name, "%s %d", model_spatial_name(which), links);
  printf("%-44s %10.1e %10.1e %10.0e%s\n", links > 0 ? name : model_spatial_name(which), found.a,
         found.lambda, limit, fine ? "" : "  exceeded");
  (void)fflush(stdout);
  return fine ? 0 : 1;
}

static bool is_chain(model_spatial which)
{
  return which == MODEL_SPHERICAL_CHAIN || which == MODEL_REVOLUTE_CHAIN;
}

static int note_changed(change by)
{
  int failures = 0;
  for (int k = 0; k < MODEL_SPATIAL_COUNT; k++) {
    model_spatial which = (model_spatial)k;
    int links = is_chain(which) ? LINKS : 0;
    if (which == MODEL_SPHERICAL_CHAIN && by.thin < 1e-6) {
      continue; /* its rods turn freely, so rounding changes their accelerations too much */
    }
    failures += note(which, links, measure_changed(which, links, by), UNEVEN, UNEVEN);
  }
  return failures;
}

/* ---- tests ---- */

static void scenes_start_on_their_constraints(void **state)
{
  (void)state;
  for (int k = 0; k < MODEL_SPATIAL_COUNT; k++) {
    model m;
    baum_status status = model_spatial_build((model_spatial)k, 30, &m);
    posed p = pose_model(status, m);
    check(baum_workspace_phi(p.workspace, 0.0, p.q, p.lambda));
    for (int i = 0; i < p.nc; i++) {
      assert_true(fabs(p.lambda[i]) <= 1e-13 * (1.0 + p.m.body_count));
    }
    unpose(&p);
  }
}

static void ordinary_configurations_keep_twelve_digits(void **state)
{
  (void)state;
  int failures = 0;
  print_head("along 1 s of motion");
  for (int k = 0; k < MODEL_SPATIAL_COUNT; k++) {
    model_spatial which = (model_spatial)k;
    int links = is_chain(which) ? LINKS : 0;
    failures += note(which, links, measure_motion(which, links, 1.0), ORDINARY, ORDINARY);
  }
  print_head("along 0.2 s of motion");
  for (int k = MODEL_SPHERICAL_CHAIN; k <= MODEL_REVOLUTE_CHAIN; k++) {
    model_spatial which = (model_spatial)k;
    failures += note(which, 10 * LINKS, measure_motion(which, 10 * LINKS, 0.2), ORDINARY, ORDINARY);
  }
  assert_int_equal(failures, 0);
}

/* Finds the errors in the design configuration of a chain that is too long for dense matrices. */
static errors measure_long(model_spatial which, int links)
{
  model m;
  errors found;
  baum_status status = model_spatial_build(which, links, &m);
  posed p = pose_model(status, m);
  check(baum_i_acceleration(p.workspace, 0.0, p.q, p.v, 0.0, 0.0));
  memcpy(p.a, p.workspace->a, (size_t)p.nv * sizeof *p.a);
  memcpy(p.lambda, p.workspace->lambda, (size_t)p.nc * sizeof *p.lambda);
  assert_true(quad_acceleration_of_blocks(p.workspace, 0.0, p.q, p.v, p.want_a, p.want_lambda));
  found.a = quad_error(p.nv, p.a, p.want_a);
  found.lambda = quad_error(p.nc, p.lambda, p.want_lambda);
  unpose(&p);
  return found;
}

static void errors_do_not_grow_with_the_length_of_chains(void **state)
{
  (void)state;
  int failures = 0;
  print_head("long chains");
  for (int links = 1000; links <= 10000; links *= 10) {
    for (int k = MODEL_SPHERICAL_CHAIN; k <= MODEL_REVOLUTE_CHAIN; k++) {
      model_spatial which = (model_spatial)k;
      failures += note(which, links, measure_long(which, links), LONG, ORDINARY);
    }
  }
  assert_int_equal(failures, 0);
}

static void uneven_masses_keep_eleven_digits(void **state)
{
  (void)state;
  print_head("every other body heavier by 1e6");
  int failures = note_changed((change){1e6, 1.0});
  print_head("every other body lighter by 1e4");
  failures += note_changed((change){1e-4, 1.0});
  print_head("every other body lighter by 1e6");
  failures += note_changed((change){1e-6, 1.0});
  assert_int_equal(failures, 0);
}

/* The only forces in these chains are weights and inertia forces, so a common factor of all masses
 * does not matter. */
static void accelerations_do_not_depend_on_the_unit_of_mass(void **state)
{
  (void)state;
  for (int which = MODEL_SPHERICAL_CHAIN; which <= MODEL_REVOLUTE_CHAIN; which++) {
    posed p = pose_scene((model_spatial)which, LINKS, NO_CHANGE);
    check(baum_i_acceleration(p.workspace, 0.0, p.q, p.v, 0.0, 0.0));
    for (int power = -12; power <= 12; power += 3) {
      model m;
      baum_status status = model_spatial_build((model_spatial)which, LINKS, &m);
      change_bodies(&m, (change){pow(10.0, power), 1.0}, 1);
      posed scaled = pose_model(status, m);
      check(baum_i_acceleration(scaled.workspace, 0.0, p.q, p.v, 0.0, 0.0));
      assert_true(quad_error(p.nv, scaled.workspace->a, p.workspace->a) <= 1e-12);
      unpose(&scaled);
    }
    unpose(&p);
  }
}

static void thin_shafts_between_heavy_rods_keep_eleven_digits(void **state)
{
  (void)state;
  print_head("every other body thinner by 1e4");
  int failures = note_changed((change){1.0, 1e-4});
  print_head("every other body lighter by 1e3 and thinner by 1e4");
  failures += note_changed((change){1e-3, 1e-4});
  assert_int_equal(failures, 0);
}

/* The solver increases the smallest moments of inertia of slender rods, and then corrects the
 * solution. */
static void slender_rods_keep_eleven_digits(void **state)
{
  (void)state;
  print_head("every other body thinner by 1e8");
  assert_int_equal(note_changed((change){1.0, 1e-8}), 0);
}

/* Adds a slender rod along x whose start is hinged to another body. */
static baum_body_id add_rod(baum_mechanism *m, int k, baum_body_id before, const double axis[3])
{
  baum_body_id rod;
  baum_joint_id hinge;
  baum_spatial_body_def def = baum_spatial_body_def_default();
  const double inertia[3] = {0.0, 0.08, 0.08};
  memcpy(def.inertia, inertia, sizeof inertia);
  def.position[0] = k + 0.5;
  check(baum_mechanism_add_spatial_body(m, &def, &rod));
  baum_spatial_revolute_def joint = baum_spatial_revolute_def_default();
  joint.body_a = before;
  joint.body_b = rod;
  joint.point[0] = k;
  joint.point[1] = 0.0;
  joint.point[2] = 0.0;
  memcpy(joint.axis, axis, sizeof joint.axis);
  check(baum_mechanism_add_spatial_revolute(m, &joint, &hinge));
  return rod;
}

/* The second and the third of three rods can turn about their common axis. Even a tiny moment about
 * this axis causes a large acceleration, which an increased moment of inertia would hide. */
static void slender_rods_that_rotate_freely_have_accurate_accelerations(void **state)
{
  (void)state;
  static const double AXES[3][3] = {{0.3, 1.0, 0.2}, {1.0, 0.0, 0.0}, {0.2, 1.0, 0.5}};
  int failures = 0;
  print_head("three rods, moment about the axis of the second");
  for (double moment = 1e-16; moment < 1e-7; moment *= 10.0) {
    baum_body_id rods[3];
    baum_force_id force;
    model m;
    baum_mechanism *mechanism = create_mechanism();
    for (int k = 0; k < 3; k++) {
      rods[k] = add_rod(mechanism, k, k > 0 ? rods[k - 1] : BAUM_GROUND, AXES[k]);
    }
    baum_spatial_load_def load = baum_spatial_load_def_default();
    load.body = rods[1];
    load.moment[0] = moment;
    check(baum_mechanism_add_spatial_load(mechanism, &load, &force));
    check(baum_mechanism_freeze(mechanism));
    posed p = pose_model(model_adopt(mechanism, &m), m);
    errors found = {0};
    memset(p.v, 0, (size_t)p.nv * sizeof *p.v);
    meet(&p, 0.0, 0.0, &found);
    printf("%10.0e N m %30s %10.1e %10.1e %10.0e\n", moment, "", found.a, found.lambda, UNEVEN);
    failures += !(found.a <= UNEVEN && found.lambda <= UNEVEN);
    unpose(&p);
  }
  assert_int_equal(failures, 0);
}

/* Makes a body on a hinge on ground. Its moments of inertia about its centre are small compared
 * with those about the hinge. The axis and the velocities are random. */
static posed pose_small_body(double inertia, uint64_t *seed)
{
  model m;
  baum_body_id body;
  baum_mechanism *mechanism = create_mechanism();
  baum_spatial_body_def def = baum_spatial_body_def_default();
  baum_spatial_revolute_def hinge = baum_spatial_revolute_def_default();
  for (int i = 0; i < 3; i++) {
    def.inertia[i] = inertia * draw(seed, 0.7, 1.0);
    def.position[i] = draw(seed, -1.0, 1.0);
    hinge.point[i] = 0.0;
    hinge.axis[i] = draw(seed, -1.0, 1.0);
  }
  check(baum_mechanism_add_spatial_body(mechanism, &def, &body));
  hinge.body_a = BAUM_GROUND;
  hinge.body_b = body;
  check(baum_mechanism_add_spatial_revolute(mechanism, &hinge, NULL));
  check(baum_mechanism_freeze(mechanism));
  posed p = pose_model(model_adopt(mechanism, &m), m);
  for (int i = 0; i < p.nv; i++) {
    p.v[i] = draw(seed, -1.0, 1.0);
  }
  check(baum_workspace_project(p.workspace, 0.0, p.q, p.v));
  return p;
}

/* Both blocks of the only node have weak pivots, although most single pivots are not too weak. */
static void small_bodies_on_hinges_keep_ten_digits(void **state)
{
  (void)state;
  errors worst = {0};
  uint64_t seed = 4;
  print_head("small bodies on hinges");
  for (int k = 0; k < 1000; k++) {
    posed p = pose_small_body(pow(10.0, draw(&seed, -4.0, -2.0)), &seed);
    meet(&p, 0.0, 0.0, &worst);
    unpose(&p);
  }
  printf("%-44s %10.1e %10.1e %10.0e\n", "moments of inertia 1e-4 to 1e-2 kg m^2", worst.a,
         worst.lambda, SMALL);
  assert_true(worst.a <= SMALL && worst.lambda <= SMALL);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(scenes_start_on_their_constraints),
    cmocka_unit_test(ordinary_configurations_keep_twelve_digits),
    cmocka_unit_test(errors_do_not_grow_with_the_length_of_chains),
    cmocka_unit_test(uneven_masses_keep_eleven_digits),
    cmocka_unit_test(accelerations_do_not_depend_on_the_unit_of_mass),
    cmocka_unit_test(thin_shafts_between_heavy_rods_keep_eleven_digits),
    cmocka_unit_test(slender_rods_keep_eleven_digits),
    cmocka_unit_test(slender_rods_that_rotate_freely_have_accurate_accelerations),
    cmocka_unit_test(small_bodies_on_hinges_keep_ten_digits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
