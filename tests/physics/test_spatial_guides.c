/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests curves, knife edges and cables in space, with every integrator and all its formulations.
 * They are compared with closed forms and with other elements:
 *
 *   a bead on a helix, which slides down with constant acceleration
 *   a Chaplygin sleigh on a plane in space, compared with the knife edge in the plane
 *   three knife edges at one point, which together are a ball joint
 *   two weights on a cable over two points, which are a damped oscillator
 *   a weight in the middle of a cable, compared with two springs
 *   a weight that falls into a slack cable
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "check.h"
#include "construct.h"
#include "runs.h"
#include "step_mode.h"

static const double G = 9.81;
static const double END = 0.6;
enum { NQ_MAX = 14 };

static void set3(double out[3], double x, double y, double z)
{
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

static baum_mechanism *start(bool gravity)
{
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, gravity ? -G : 0.0));
  return m;
}

static baum_body_id add_particle(baum_mechanism *m, double mass, double x, double y, double z)
{
  baum_spatial_particle_def def = baum_spatial_particle_def_default();
  baum_body_id id;
  def.mass = mass;
  set3(def.position, x, y, z);
  check(baum_mechanism_add_spatial_particle(m, &def, &id));
  return id;
}

/* ---- every method ---- */

/* A mechanism and the positions at END that a run must reach. */
typedef struct task {
  const char *name;
  const baum_mechanism *m;
  bool refused_by_rattle;
  double want[NQ_MAX];
} task;

/* Returns the allowed error for h = 1e-3 s or rtol = 1e-8. The limits are listed by order, and the
 * first one is for variable steps. Each is at least three times the largest measured value. */
static double allowed(step_mode mode, baum_formulation formulation)
{
  static const double by_order[] = {2e-6, 0.2, 1e-4, 1.5e-6, 4e-10, 1e-12, 2e-14, 2e-14, 2e-14};
  if (formulation == BAUM_FORMULATION_INDEX3) {
    return 5e-5;
  }
  double wide = step_mode_is_adams(mode) ? 30.0 : 1.0;
  return wide * by_order[mode.fixed ? baum_integrator_order(mode.integrator) : 0];
}

static void try_method(const task *given, step_mode mode, baum_formulation formulation)
{
  int32_t nq;
  double error = 0.0;
  baum_energy_account account;
  baum_simulation_options o = step_mode_options(mode, 1e-3, 1e-8);
  o.formulation = formulation;
  o.energy_account = true;
  check(baum_mechanism_sizes(given->m, &nq, NULL, NULL));
  assert_true(nq <= NQ_MAX);
  baum_simulation *run = create_run(given->m, &o);
  check(step_mode_advance(mode, run, END));
  check(baum_simulation_energy_account(run, &account, sizeof account));
  for (int i = 0; i < nq; i++) {
    error = fmax(error, fabs(baum_simulation_q(run)[i] - given->want[i]));
  }
  double residual = fabs(account.residual) / 10.0; /* [J] a typical kinetic energy */
  double most = allowed(mode, formulation);
  if (!(error <= most && residual <= most)) {
    fail_msg("%s, %s, %s, %s: error %.3g, residual %.3g, allowed %.3g", given->name,
             baum_integrator_name(mode.integrator), mode.fixed ? "fixed step" : "variable step",
             baum_formulation_name(formulation), error, residual, most);
  }
  baum_simulation_destroy(run);
}

static void try_every_method(const task *given)
{
  int tried = 0;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    for (int f = BAUM_FORMULATION_DEFAULT + 1; baum_formulation_name((baum_formulation)f); f++) {
      if (baum_integrator_offers(mode.integrator, (baum_formulation)f) &&
          !(given->refused_by_rattle && mode.integrator == baum_rattle())) {
        try_method(given, mode, (baum_formulation)f);
        tried++;
      }
    }
  }
  assert_true(tried >= 15);
}

/* Runs with rk8 and a small step, and returns the positions at END. */
static void run_fine(const baum_mechanism *m, double step, double q[NQ_MAX])
{
  int32_t nq;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk8();
  o.formulation = BAUM_FORMULATION_PROJECTION;
  o.step = step;
  check(baum_mechanism_sizes(m, &nq, NULL, NULL));
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_advance_to(run, END));
  memcpy(q, baum_simulation_q(run), (size_t)nq * sizeof *q);
  baum_simulation_destroy(run);
}

/* ---- a bead on a helix ---- */

static const double R = 0.5; /* radius of the helix [m] */
static const double C = 0.2; /* rise [m/rad] */

static int helix(const double xyz[3], double out[20], void *user)
{
  (void)user;
  const double x = R * cos(xyz[2] / C), y = R * sin(xyz[2] / C);
  out[0] = xyz[0] - x;
  out[1] = 1.0;
  out[3] = y / C;
  out[9] = x / (C * C);
  out[10] = xyz[1] - y;
  out[12] = 1.0;
  out[13] = -x / C;
  out[19] = y / (C * C);
  return 0;
}

/* The bead starts at the angle 0 with the angular velocity W0. Its weight along the helix causes
 * the constant angular acceleration -g C / (R^2 + C^2). */
static const double W0 = 1.5;

static double helix_angle(double t)
{
  return W0 * t - 0.5 * G * C / (R * R + C * C) * t * t;
}

static baum_mechanism *make_helix(void)
{
  baum_mechanism *m = start(true);
  baum_spatial_curve_def def = baum_spatial_curve_def_default();
  baum_spatial_particle_def bead = baum_spatial_particle_def_default();
  bead.mass = 0.8;
  bead.position[0] = R;
  set3(bead.velocity, 0.0, R * W0, C * W0);
  def.body_a = BAUM_GROUND;
  check(baum_mechanism_add_spatial_particle(m, &bead, &def.body_b));
  set3(def.point_a, 0.0, 0.0, 0.0);
  set3(def.point_b, 0.0, 0.0, 0.0);
  def.curve = helix;
  check(baum_mechanism_add_spatial_curve(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

static void a_bead_slides_down_a_helix(void **state)
{
  (void)state;
  baum_mechanism *m = make_helix();
  const double angle = helix_angle(END);
  const task given = {"helix", m, false, {R * cos(angle), R * sin(angle), C * angle}};
  try_every_method(&given);
  baum_mechanism_destroy(m);
}

static void the_reaction_of_the_helix_has_its_closed_form(void **state)
{
  (void)state;
  baum_mechanism *m = make_helix();
  baum_simulation_options o = baum_simulation_options_default();
  double got[6];
  o.integrator = baum_rk8();
  o.step = 1e-3;
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_advance_to(run, END));
  const baum_channel channel =
    baum_channel_of_joint(BAUM_JOINT_REACTION, baum_mechanism_joint_at(m, 0));
  check(baum_simulation_get(run, &channel, 1, got));
  const double a = -G * C / (R * R + C * C);
  const double w = W0 + a * END;
  const double c = cos(helix_angle(END)), s = sin(helix_angle(END));
  const double want[6] = {0.8 * R * (-a * s - w * w * c), 0.8 * R * (a * c - w * w * s),
                          0.8 * (C * a + G)};
  for (int i = 0; i < 6; i++) {
    assert_true(fabs(got[i] - want[i]) <= 1e-9);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* ---- the Chaplygin sleigh ---- */

static const double ANGLE = 0.4;

/* Adds the sleigh. It is a planar body, or a spatial body on a plane. Its blade is 0.3 m behind the
 * centre of mass. */
static baum_mechanism *make_sleigh(bool spatial_body, bool spatial_edge)
{
  baum_mechanism *m = start(false);
  baum_body_id sleigh;
  const double c = cos(ANGLE), s = sin(ANGLE);
  if (spatial_body) {
    baum_spatial_body_def def = baum_spatial_body_def_default();
    baum_spatial_planar_def table = baum_spatial_planar_def_default();
    def.mass = 2.0;
    def.inertia[0] = 0.1;
    def.inertia[1] = 0.2;
    def.inertia[2] = 0.15;
    def.orientation[0] = cos(0.5 * ANGLE);
    def.orientation[3] = sin(0.5 * ANGLE);
    set3(def.velocity, 0.5 * c - 0.39 * s, 0.5 * s + 0.39 * c, 0.0);
    set3(def.angular_velocity, 0.0, 0.0, 1.3);
    check(baum_mechanism_add_spatial_body(m, &def, &sleigh));
    table.body_a = BAUM_GROUND;
    table.body_b = sleigh;
    set3(table.point, 0.0, 0.0, 0.0);
    check(baum_mechanism_add_spatial_planar(m, &table, NULL));
  } else {
    baum_planar_body_def def = baum_planar_body_def_default();
    def.mass = 2.0;
    def.inertia = 0.15;
    def.angle = ANGLE;
    def.velocity[0] = 0.5 * c - 0.39 * s;
    def.velocity[1] = 0.5 * s + 0.39 * c;
    def.angular_velocity = 1.3;
    check(baum_mechanism_add_planar_body(m, &def, &sleigh));
  }
  if (spatial_edge) {
    baum_spatial_knife_edge_def def = baum_spatial_knife_edge_def_default();
    def.body_a = sleigh;
    set3(def.point, -0.3 * c, -0.3 * s, 0.0);
    set3(def.axis, -2.0 * s, 2.0 * c, 0.0);
    check(baum_mechanism_add_spatial_knife_edge(m, &def, NULL));
  } else {
    baum_planar_knife_edge_def def = baum_planar_knife_edge_def_default();
    def.body_a = sleigh;
    def.point_a[0] = -0.3;
    def.point_a[1] = 0.0;
    check(baum_mechanism_add_planar_knife_edge(m, &def, NULL));
  }
  check(baum_mechanism_freeze(m));
  return m;
}

static void a_spatial_sleigh_moves_like_a_planar_sleigh(void **state)
{
  (void)state;
  double planar[NQ_MAX];
  baum_mechanism *m = make_sleigh(false, false);
  run_fine(m, 1e-3, planar);
  baum_mechanism_destroy(m);

  baum_mechanism *flat = make_sleigh(false, true);
  task given = {"planar body", flat, true, {planar[0], planar[1], planar[2]}};
  try_every_method(&given);
  baum_mechanism_destroy(flat);

  baum_mechanism *space = make_sleigh(true, true);
  const double half = 0.5 * planar[2];
  given =
    (task){"sleigh", space, true, {planar[0], planar[1], 0.0, cos(half), 0.0, 0.0, sin(half)}};
  try_every_method(&given);
  baum_mobility mobility;
  check(baum_mechanism_mobility(space, &mobility, sizeof mobility));
  assert_int_equal(mobility.degrees_of_freedom, 2);
  assert_int_equal(mobility.position_degrees_of_freedom, 3);
  baum_mechanism_destroy(space);
}

/* ---- three knife edges ---- */

static baum_body_id add_brick(baum_mechanism *m, double x, double w)
{
  static const double tensor[6] = {0.2, 0.5, 0.4, 0.05, -0.02, 0.03};
  baum_spatial_body_def def = baum_spatial_body_def_default();
  baum_body_id id;
  def.mass = 2.0;
  memcpy(def.inertia, tensor, sizeof tensor);
  def.position[0] = x;
  set3(def.angular_velocity, 0.7, w, -0.4);
  check(baum_mechanism_add_spatial_body(m, &def, &id));
  return id;
}

/* Makes a double pendulum. Its second joint is a ball joint or, if `edges` is true, three knife
 * edges whose directions are not perpendicular. */
static baum_mechanism *make_edges(bool edges)
{
  static const double axes[3][3] = {{1.0, 0.2, 0.0}, {0.0, 3.0, -0.5}, {0.4, 0.0, 1.0}};
  baum_mechanism *m = start(true);
  baum_spatial_spherical_def ball = baum_spatial_spherical_def_default();
  ball.body_a = BAUM_GROUND;
  ball.body_b = add_brick(m, 0.3, 0.8);
  set3(ball.point, 0.0, 0.0, 0.0);
  check(baum_mechanism_add_spatial_spherical(m, &ball, NULL));
  ball.body_a = add_brick(m, 0.9, -1.1);
  set3(ball.point, 0.6, 0.1, 0.0);
  for (int k = 0; edges && k < 3; k++) {
    baum_spatial_knife_edge_def def = baum_spatial_knife_edge_def_default();
    def.body_a = ball.body_a;
    def.body_b = ball.body_b;
    memcpy(def.point, ball.point, sizeof def.point);
    memcpy(def.axis, axes[k], sizeof def.axis);
    check(baum_mechanism_add_spatial_knife_edge(m, &def, NULL));
  }
  if (!edges) {
    check(baum_mechanism_add_spatial_spherical(m, &ball, NULL));
  }
  check(baum_mechanism_freeze(m));
  return m;
}

static void three_knife_edges_are_a_ball_joint(void **state)
{
  (void)state;
  baum_mechanism *ball = make_edges(false);
  baum_mechanism *m = make_edges(true);
  task given = {.name = "three edges", .m = m, .refused_by_rattle = true};
  run_fine(ball, 5e-4, given.want);
  try_every_method(&given);
  baum_mechanism_destroy(ball);
  baum_mechanism_destroy(m);
}

/* ---- a cable over two points ---- */

/* Weights of the masses m1 and m2 hang from a cable over two points of ground, and move down by x1
 * and x2. With the stiffness k and the damping d of the cable, its elongation s satisfies s'' = 2 g
 * - (1/m1 + 1/m2) (k s + d s'). Moreover, m1 x1 - m2 x2 has the constant acceleration (m1 - m2)
 * g. */
static const double K = 400.0, D = 6.0, M1 = 2.0, M2 = 3.0;

static baum_mechanism *make_pulleys(double stretch)
{
  static const double points[12] = {0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.5, 0.0, 1.0, 0.0, 0.0, 0.0};
  baum_mechanism *m = start(true);
  const baum_body_id bodies[4] = {add_particle(m, M1, 0.0, 0.0, 0.0), BAUM_GROUND, BAUM_GROUND,
                                  add_particle(m, M2, 0.5, 0.0, 0.2)};
  baum_spatial_cable_def def = baum_spatial_cable_def_default();
  def.bodies = bodies;
  def.points = points;
  def.point_count = 4;
  def.stiffness = K;
  def.damping = D;
  def.free_length = 1.0 + 0.5 + 0.8 - stretch;
  check(baum_mechanism_add_spatial_cable(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

static void weights_on_a_cable_are_a_damped_oscillator(void **state)
{
  (void)state;
  const double sum = 1.0 / M1 + 1.0 / M2;
  const double middle = 2.0 * G / (sum * K);
  const double first = 0.7 * middle;
  const double decay = 0.5 * sum * D;
  const double w = sqrt(sum * K - decay * decay);
  const double s =
    middle + (first - middle) * exp(-decay * END) * (cos(w * END) + decay / w * sin(w * END));
  const double both = s - first;                       /* x1 + x2 */
  const double fall = 0.5 * (M1 - M2) * G * END * END; /* m1 x1 - m2 x2 */
  const double x1 = (fall + M2 * both) / (M1 + M2);
  baum_mechanism *m = make_pulleys(first);
  const task given = {"pulleys", m, true, {0.0, 0.0, -x1, 0.5, 0.0, 0.2 - (both - x1)}};
  try_every_method(&given);
  baum_mechanism_destroy(m);
}

/* ---- a cable and two springs ---- */

/* Makes a weight between two points of ground. It hangs on a taut cable or on two springs. */
static baum_mechanism *make_middle(bool cable, double damping)
{
  static const double points[9] = {-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0};
  baum_mechanism *m = start(true);
  baum_spatial_particle_def weight = baum_spatial_particle_def_default();
  baum_body_id id;
  weight.mass = 1.5;
  set3(weight.position, 0.0, 0.3, -0.4);
  set3(weight.velocity, 0.0, 1.2, 0.5);
  check(baum_mechanism_add_spatial_particle(m, &weight, &id));
  if (cable) {
    const baum_body_id bodies[3] = {BAUM_GROUND, id, BAUM_GROUND};
    baum_spatial_cable_def def = baum_spatial_cable_def_default();
    def.bodies = bodies;
    def.points = points;
    def.point_count = 3;
    def.stiffness = 60.0;
    def.damping = damping;
    def.free_length = 1.0;
    check(baum_mechanism_add_spatial_cable(m, &def, NULL));
  }
  for (int k = 0; !cable && k < 2; k++) {
    baum_spatial_spring_def def = baum_spatial_spring_def_default();
    def.body_a = BAUM_GROUND;
    def.body_b = id;
    memcpy(def.point_a, points + 6 * (ptrdiff_t)k, sizeof def.point_a);
    set3(def.point_b, 0.0, 0.0, 0.0);
    def.stiffness = 2.0 * 60.0;
    def.damping = 2.0 * damping;
    def.free_length = 0.5;
    check(baum_mechanism_add_spatial_spring(m, &def, NULL));
  }
  check(baum_mechanism_freeze(m));
  return m;
}

static void a_cable_with_a_weight_in_the_middle_is_two_springs(void **state)
{
  (void)state;
  for (int damped = 0; damped < 2; damped++) {
    baum_mechanism *springs = make_middle(false, damped * 0.8);
    baum_mechanism *m = make_middle(true, damped * 0.8);
    task given = {"middle", m, damped == 1, {0.0}};
    run_fine(springs, 5e-4, given.want);
    try_every_method(&given);
    baum_mechanism_destroy(springs);
    baum_mechanism_destroy(m);
  }
}

/* ---- slack ---- */

static baum_mechanism *make_drop(double damping, baum_body_id *weight)
{
  static const double points[6] = {0.0};
  baum_mechanism *m = start(true);
  *weight = add_particle(m, 1.0, 0.0, 0.0, -0.5);
  const baum_body_id bodies[2] = {BAUM_GROUND, *weight};
  baum_spatial_cable_def def = baum_spatial_cable_def_default();
  def.bodies = bodies;
  def.points = points;
  def.point_count = 2;
  def.stiffness = 200.0;
  def.damping = damping;
  def.free_length = 1.0;
  check(baum_mechanism_add_spatial_cable(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  return m;
}

/* The weight falls 0.5 m, is stopped by the cable, and returns to where it started. */
static void a_weight_falls_into_the_cable_and_returns(void **state)
{
  (void)state;
  baum_body_id weight;
  baum_mechanism *m = make_drop(0.0, &weight);
  baum_simulation_options o = baum_simulation_options_default();
  const double fall = sqrt(2.0 * 0.5 / G);
  const double w = sqrt(200.0);
  const double speed = G * fall;
  /* On the cable, z + 1 = -g / w^2 + a cos(w t + p) with constants a and p. It is 0 when the cable
   * becomes taut, and when it slackens. */
  const double on_cable = 2.0 / w * (0.5 * 3.14159265358979324 + atan(G / w / speed));
  o.integrator = baum_dp5();
  o.rtol = 1e-10;
  baum_simulation *run = create_run(m, &o);
  check(baum_simulation_advance_to(run, 0.9 * fall));
  assert_true(fabs(baum_simulation_q(run)[2] + 0.5 + 0.5 * G * 0.81 * fall * fall) <= 1e-9);
  check(baum_simulation_advance_to(run, 2.0 * fall + on_cable));
  assert_true(fabs(baum_simulation_q(run)[2] + 0.5) <= 1e-7);
  assert_true(fabs(baum_simulation_v(run)[2]) <= 1e-6);
  baum_counters counters = counters_of(run);
  assert_true(fabs(counters.energy_change) <= 1e-7);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* The residual of the energy account must stay small although the cable becomes taut and slack
 * several times. */
static void the_energy_residual_stays_small_across_slack(void **state)
{
  (void)state;
  baum_body_id weight;
  baum_mechanism *m = make_drop(5.0, &weight);
  for (int fixed = 0; fixed < 2; fixed++) {
    baum_energy_account account;
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_dp5();
    o.rtol = fixed ? (double)NAN : 1e-9;
    o.step = fixed ? 1e-4 : (double)NAN;
    o.energy_account = true;
    baum_simulation *run = create_run(m, &o);
    check(baum_simulation_advance_to(run, 3.0));
    check(baum_simulation_energy_account(run, &account, sizeof account));
    assert_true(account.dampers < -1.0);
    /* In a fixed step, the weight moves by 3e-4 m. The transition to a taut cable takes only 1e-4
     * m. */
    assert_true(fabs(account.residual) <= (fixed ? 2e-3 : 2e-5));
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* The tension, read from the force on the weight, is continuous where the cable becomes taut, and
 * never negative. */
static void the_tension_is_continuous_and_never_negative(void **state)
{
  (void)state;
  baum_body_id weight;
  baum_mechanism *m = make_drop(5.0, &weight);
  baum_workspace *w = NULL;
  check(baum_workspace_create(m, &w));
  for (int rate = -2; rate <= 2; rate++) {
    double before = 0.0;
    for (int k = -200; k <= 1000; k++) {
      const double s = 1e-6 * k;
      const double q[3] = {0.0, 0.0, -1.0 - s};
      const double v[3] = {0.0, 0.0, -(double)rate};
      double force[3];
      check(baum_workspace_force(w, 0.0, q, v, force));
      const double tension = force[2] + G;
      assert_true(tension >= -1e-14 && (s > 0.0 || fabs(tension) <= 1e-14));
      /* The slope of the tension over the length l is at most k + 1.5 c |l'| / d. Here k is the
       * stiffness, c is the damping, and d = 1e-4 m is the elongation at which damping is full. */
      assert_true(fabs(tension - before) <= 1e-6 * (200.0 + 1.5 * 5.0 * 2.0 / 1e-4) + 1e-12);
      before = tension;
      const double x = fmin(s / 1e-4, 1.0);
      const double law = 200.0 * s + 5.0 * x * x * (3.0 - 2.0 * x) * rate;
      assert_true(fabs(tension - (s > 0.0 ? fmax(law, 0.0) : 0.0)) <= 1e-9);
    }
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

static void coinciding_points_exert_no_force(void **state)
{
  (void)state;
  static const double points[9] = {0.0, 0.0, 2.0};
  baum_mechanism *m = start(false);
  const baum_body_id bodies[3] = {BAUM_GROUND, add_particle(m, 1.0, 0.3, 0.0, 0.0),
                                  add_particle(m, 1.0, 0.3, 0.0, 0.0)};
  baum_spatial_cable_def def = baum_spatial_cable_def_default();
  def.bodies = bodies;
  def.points = points;
  def.point_count = 3;
  def.stiffness = 10.0;
  def.damping = 1.0;
  def.free_length = 0.5;
  check(baum_mechanism_add_spatial_cable(m, &def, NULL));
  check(baum_mechanism_freeze(m));
  baum_workspace *w = NULL;
  check(baum_workspace_create(m, &w));
  const double q[6] = {0.0};
  const double v[6] = {0.0, 0.0, -1.0, 3.0};
  const double want[6] = {0.0, 0.0, 10.0 * 1.5 + 1.0};
  double force[6];
  check(baum_workspace_force(w, 0.0, q, v, force));
  for (int i = 0; i < 6; i++) {
    assert_true(fabs(force[i] - want[i]) <= 1e-13);
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_bead_slides_down_a_helix),
    cmocka_unit_test(the_reaction_of_the_helix_has_its_closed_form),
    cmocka_unit_test(a_spatial_sleigh_moves_like_a_planar_sleigh),
    cmocka_unit_test(three_knife_edges_are_a_ball_joint),
    cmocka_unit_test(weights_on_a_cable_are_a_damped_oscillator),
    cmocka_unit_test(a_cable_with_a_weight_in_the_middle_is_two_springs),
    cmocka_unit_test(a_weight_falls_into_the_cable_and_returns),
    cmocka_unit_test(the_energy_residual_stays_small_across_slack),
    cmocka_unit_test(the_tension_is_continuous_and_never_negative),
    cmocka_unit_test(coinciding_points_exert_no_force),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
