/* SPDX-License-Identifier: BSD-3-Clause */
#include "manifold_scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"
#include "manifold_bodies.h"
#include "manifold_tops.h"
#include "rotation.h"
#include "runs.h"
#include "spatial_scenes.h"

enum { SIZE = MANIFOLD_SIZE };

/* ---- pins between turned bodies ---- */

/* A pin. It joins point b of the last body to point a of the first body or of ground. */
typedef struct pin {
  bool to_ground;
  bool to_ordinary; /* the last body has an ordinary angle instead of (cos, sin) */
  double a[2];
  double b[2];
} pin;

static void add_arm(const double *c, const double s[2], double sign, double *out)
{
  out[0] += sign * (c[0] * s[0] - c[1] * s[1]);
  out[1] += sign * (c[1] * s[0] + c[0] * s[1]);
}

static int pin_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  const pin *p = user;
  const double *last = p->to_ground ? q : q + 4;
  const double angle[2] = {cos(last[2]), sin(last[2])};
  out[0] = last[0];
  out[1] = last[1];
  add_arm(p->to_ordinary ? angle : last + 2, p->b, 1.0, out);
  if (p->to_ground) {
    out[0] -= p->a[0];
    out[1] -= p->a[1];
  } else {
    out[0] -= q[0];
    out[1] -= q[1];
    add_arm(q + 2, p->a, -1.0, out);
  }
  return 0;
}

static void put_side(const double *c, const double s[2], double sign, int first, int columns,
                     double *out)
{
  double arm[2] = {0.0, 0.0};
  add_arm(c, s, 1.0, arm);
  out[first] = sign;
  out[columns + first + 1] = sign;
  out[first + 2] = -sign * arm[1];
  out[columns + first + 2] = sign * arm[0];
}

/* Computes the Jacobian with respect to velocities. The function supports only pins that connect
 * turned bodies with each other or with ground. */
static int pin_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  const pin *p = user;
  if (p->to_ground) {
    put_side(q + 2, p->b, 1.0, 0, 3, out);
  } else {
    put_side(q + 2, p->a, -1.0, 0, 6, out);
    put_side(q + 6, p->b, 1.0, 3, 6, out);
  }
  return 0;
}

static void add_pin(baum_mechanism *mechanism, pin *p, const baum_body_id *bodies, bool jacobian)
{
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.bodies = bodies;
  def.body_count = p->to_ground ? 1 : 2;
  def.row_count = 2;
  def.phi = pin_phi;
  def.jacobian = jacobian ? pin_jacobian : NULL;
  def.user = p;
  check(baum_mechanism_add_user_constraint(mechanism, &def, NULL));
}

static baum_body_id add_ordinary(baum_mechanism *mechanism, const manifold_body *body, double x,
                                 double y, double angle, const double *v)
{
  baum_body_id id;
  baum_planar_body_def def = baum_planar_body_def_default();
  def.mass = body->mass;
  def.inertia = body->inertia[0];
  def.position[0] = x;
  def.position[1] = y;
  def.angle = angle;
  if (v) {
    def.velocity[0] = v[0];
    def.velocity[1] = v[1];
    def.angular_velocity = v[2];
  }
  check(baum_mechanism_add_planar_body(mechanism, &def, &id));
  return id;
}

static void translate_bodies(const double *twin_q, double *q, int count)
{
  for (int k = 0; k < count; k++) {
    q[4 * k] = twin_q[3 * k];
    q[4 * k + 1] = twin_q[3 * k + 1];
    q[4 * k + 2] = cos(twin_q[3 * k + 2]);
    q[4 * k + 3] = sin(twin_q[3 * k + 2]);
  }
}

/* ---- angle: a pendulum of one coordinate ---- */

static manifold_body bob = {.mass = 2.0, .inertia = {2.5}};
static const double BOB_V[1] = {-4.0};

static void build_angle(baum_mechanism *mechanism)
{
  (void)manifold_add_angle(mechanism, &bob, 0.3, BOB_V);
}

static int swing_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  out[0] = bob.inertia[0];
  return 0;
}

static int swing_force(double t, const double *q, const double *v, const double *inputs,
                       double *out, void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = -bob.mass * 9.81 * cos(q[0]);
  return 0;
}

static void build_angle_twin(baum_mechanism *mechanism)
{
  static const double q[1] = {0.3};
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = 1;
  def.q = q;
  def.v = BOB_V;
  def.mass = swing_mass;
  def.force = swing_force;
  def.constant_mass = true;
  def.depends_on_velocity = false;
  check(baum_mechanism_add_coordinates(mechanism, &def, NULL));
}

static void translate_angle(const double *twin_q, double *q)
{
  q[0] = cos(twin_q[0]);
  q[1] = sin(twin_q[0]);
}

/* ---- pendulum ---- */

static manifold_body rod = {.mass = 1.5, .inertia = {0.2}};
static pin hinge = {.to_ground = true, .b = {-0.5, 0.1}};
/* Finds the position of the rod at the angle 0.4 rad, with its point b at the origin. The
 * velocities v belong to an angular velocity of -4 rad/s. */
static void place_rod(double *x, double *y, double v[3])
{
  double arm[2] = {0.0, 0.0};
  const double c[2] = {cos(0.4), sin(0.4)};
  add_arm(c, hinge.b, 1.0, arm);
  *x = -arm[0];
  *y = -arm[1];
  v[0] = -4.0 * arm[1];
  v[1] = 4.0 * arm[0];
  v[2] = -4.0;
}

static void build_pendulum(baum_mechanism *mechanism)
{
  double x;
  double y;
  double v[3];
  place_rod(&x, &y, v);
  baum_body_id id = manifold_add_turned(mechanism, &rod, x, y, 0.4, v);
  add_pin(mechanism, &hinge, &id, false);
}

static void build_pendulum_twin(baum_mechanism *mechanism)
{
  double x;
  double y;
  double v[3];
  place_rod(&x, &y, v);
  baum_body_id id = add_ordinary(mechanism, &rod, x, y, 0.4, v);
  add_planar_pin(mechanism, NULL, BAUM_GROUND, id, 0.0, 0.0);
}

static void translate_one(const double *twin_q, double *q)
{
  translate_bodies(twin_q, q, 1);
}

/* ---- slider-crank ---- */

static manifold_body crank = {.mass = 1.0, .inertia = {0.1}};
static manifold_body coupler = {.mass = 2.0, .inertia = {0.5}};
static manifold_body slider = {.mass = 1.0, .inertia = {1.0}};
static pin main_pin = {.to_ground = true, .b = {-0.5, 0.0}};
static pin crank_pin = {.a = {0.5, 0.0}, .b = {-1.0, 0.0}};
static pin slider_pin = {.a = {1.0, 0.0}, .b = {0.0, 0.0}};
/* The pins of a coupler that is only as long as the crank. With this coupler, configurations in
 * which the slider is at the pin of the crank on ground are bifurcations. */
static pin short_crank_pin = {.a = {0.5, 0.0}, .b = {-0.5, 0.0}};
static pin short_slider_pin = {.a = {0.5, 0.0}, .b = {0.0, 0.0}};
/* The crank starts at an angle of 1 rad with an angular velocity of 4 rad/s. */
static const double CRANK = 1.0;
static const double CRANK_V[3] = {(double)NAN, (double)NAN, 4.0};

typedef struct crank_place {
  double crank[2];
  double coupler[3];
  double slider;
} crank_place;

/* Computes the positions of the bodies for a crank angle. `half` is half the length of the
 * coupler. */
static crank_place place_crank(double angle, double half)
{
  crank_place p = {.crank = {0.5 * cos(angle), 0.5 * sin(angle)}};
  p.coupler[2] = -asin(0.5 * sin(angle) / half);
  p.coupler[0] = cos(angle) + half * cos(p.coupler[2]);
  p.coupler[1] = sin(angle) + half * sin(p.coupler[2]);
  p.slider = cos(angle) + 2.0 * half * cos(p.coupler[2]);
  return p;
}

/* The two rows of the slider: y = 0 and sin(angle) = 0. */
static int rail_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[1];
  out[1] = q[3];
  return 0;
}

static void add_rail(baum_mechanism *mechanism, const baum_body_id *body)
{
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.bodies = body;
  def.body_count = 1;
  def.row_count = 2;
  def.phi = rail_phi;
  check(baum_mechanism_add_user_constraint(mechanism, &def, NULL));
}

/* Builds the slider-crank, and sets the ids of its bodies. */
static void build_crank_of(baum_mechanism *mechanism, double half, baum_body_id ids[3])
{
  crank_place p = place_crank(CRANK, half);
  ids[0] = manifold_add_turned(mechanism, &crank, p.crank[0], p.crank[1], CRANK, CRANK_V);
  ids[1] = manifold_add_turned(mechanism, &coupler, p.coupler[0], p.coupler[1], p.coupler[2], NULL);
  ids[2] = manifold_add_turned(mechanism, &slider, p.slider, 0.0, 0.0, NULL);
  add_pin(mechanism, &main_pin, ids, true);
  add_pin(mechanism, half < 1.0 ? &short_crank_pin : &crank_pin, ids, true);
  add_pin(mechanism, half < 1.0 ? &short_slider_pin : &slider_pin, ids + 1, half < 1.0);
  add_rail(mechanism, ids + 2);
}

static void build_crank(baum_mechanism *mechanism)
{
  baum_body_id ids[3];
  build_crank_of(mechanism, 1.0, ids);
}

static void build_short_crank(baum_mechanism *mechanism)
{
  baum_body_id ids[3];
  build_crank_of(mechanism, 0.5, ids);
}

/* Drives the crank by the constraint sin(angle - CRANK - 4 t) = 0. */
static int driver_phi(double t, const double *q, double *out, void *user)
{
  (void)user;
  double angle = CRANK + 4.0 * t;
  out[0] = q[3] * cos(angle) - q[2] * sin(angle);
  return 0;
}

static void build_driven_crank(baum_mechanism *mechanism)
{
  baum_body_id ids[3];
  baum_user_constraint_def def = baum_user_constraint_def_default();
  build_crank_of(mechanism, 1.0, ids);
  def.bodies = ids;
  def.body_count = 1;
  def.row_count = 1;
  def.phi = driver_phi;
  check(baum_mechanism_add_user_constraint(mechanism, &def, NULL));
}

static void solve_driven_crank(double t, double *q)
{
  crank_place p = place_crank(CRANK + 4.0 * t, 1.0);
  const double twin_q[9] = {p.crank[0],   p.crank[1],   CRANK + 4.0 * t,
                            p.coupler[0], p.coupler[1], p.coupler[2],
                            p.slider,     0.0,          0.0};
  translate_bodies(twin_q, q, 3);
}

static void build_crank_twin_of(baum_mechanism *mechanism, double half)
{
  crank_place p = place_crank(CRANK, half);
  baum_body_id ids[3] = {
    add_ordinary(mechanism, &crank, p.crank[0], p.crank[1], CRANK, CRANK_V),
    add_ordinary(mechanism, &coupler, p.coupler[0], p.coupler[1], p.coupler[2], NULL),
    add_ordinary(mechanism, &slider, p.slider, 0.0, 0.0, NULL)};
  add_planar_pin(mechanism, NULL, BAUM_GROUND, ids[0], 0.0, 0.0);
  add_planar_pin(mechanism, NULL, ids[0], ids[1], cos(CRANK), sin(CRANK));
  add_planar_pin(mechanism, NULL, ids[1], ids[2], p.slider, 0.0);
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = ids[2];
  def.axis[0] = 1.0;
  def.point[0] = p.slider;
  def.point[1] = 0.0;
  check(baum_mechanism_add_planar_translational(mechanism, &def, NULL));
}

static void build_crank_twin(baum_mechanism *mechanism)
{
  build_crank_twin_of(mechanism, 1.0);
}

static void build_short_crank_twin(baum_mechanism *mechanism)
{
  build_crank_twin_of(mechanism, 0.5);
}

static void translate_crank(const double *twin_q, double *q)
{
  translate_bodies(twin_q, q, 3);
}

/* ---- an ordinary body after a turned body begins at different indices of q and v ---- */

static manifold_body lower_rod = {.mass = 0.7, .inertia = {0.05}};
static pin joint_pin = {.to_ordinary = true, .a = {0.5, 0.0}, .b = {-0.4, 0.0}};

static void place_lower(double x, double y, double lower[3])
{
  lower[0] = x + 0.5 * cos(0.4) + 0.4 * cos(-0.8);
  lower[1] = y + 0.5 * sin(0.4) + 0.4 * sin(-0.8);
  lower[2] = -0.8;
}

static void build_mixed(baum_mechanism *mechanism)
{
  double at[3];
  double x;
  double y;
  double v[3];
  place_rod(&x, &y, v);
  place_lower(x, y, at);
  baum_body_id ids[2] = {manifold_add_turned(mechanism, &rod, x, y, 0.4, v)};
  ids[1] = add_ordinary(mechanism, &lower_rod, at[0], at[1], at[2], NULL);
  add_pin(mechanism, &hinge, ids, true);
  add_pin(mechanism, &joint_pin, ids, false);
}

static void build_mixed_twin(baum_mechanism *mechanism)
{
  double at[3];
  double x;
  double y;
  double v[3];
  place_rod(&x, &y, v);
  place_lower(x, y, at);
  baum_body_id upper = add_ordinary(mechanism, &rod, x, y, 0.4, v);
  baum_body_id lower = add_ordinary(mechanism, &lower_rod, at[0], at[1], at[2], NULL);
  add_planar_pin(mechanism, NULL, BAUM_GROUND, upper, 0.0, 0.0);
  add_planar_pin(mechanism, NULL, upper, lower, x + 0.5 * cos(0.4), y + 0.5 * sin(0.4));
}

static void translate_mixed(const double *twin_q, double *q)
{
  translate_bodies(twin_q, q, 1);
  memcpy(q + 4, twin_q + 3, 3 * sizeof *q);
}

/* ---- all ---- */

const manifold_scene manifold_scenes[MANIFOLD_SCENES] = {
  {"angle", build_angle, build_angle_twin, translate_angle, NULL, 1, false, {0, 1, 2}, 0},
  {"pendulum", build_pendulum, build_pendulum_twin, translate_one, NULL, 1, false, {2, 1, 2}, 0},
  {"slider-crank", build_crank, build_crank_twin, translate_crank, NULL, 1, false, {2, 3, 2}, 0},
  {"mixed double pendulum",
   build_mixed,
   build_mixed_twin,
   translate_mixed,
   NULL,
   2,
   false,
   {2, 1, 2},
   0},
  {"free top", manifold_build_free_top, NULL, NULL, manifold_solve_free_top, 3, true, {0, 1, 4}, 0},
  {"heavy top",
   manifold_build_heavy_top,
   NULL,
   NULL,
   manifold_solve_heavy_top,
   3,
   true,
   {3, 1, 4},
   0},
  {"heavy top with its Jacobian",
   manifold_build_given_top,
   NULL,
   NULL,
   manifold_solve_heavy_top,
   3,
   true,
   {3, 1, 4},
   0},
  {"ball", manifold_build_ball, NULL, NULL, manifold_solve_ball, 3, false, {3, 1, 4}, 0},
  {"spatial four-bar",
   spatial_build_four_bar,
   spatial_build_planar_four_bar,
   spatial_translate_four_bar,
   NULL,
   1,
   false,
   {3, 3, 4},
   3},
  {"spatial heavy top",
   manifold_build_spatial_top,
   NULL,
   NULL,
   manifold_solve_heavy_top,
   3,
   false,
   {3, 1, 4},
   0},
  {"screw", spatial_build_screw, NULL, NULL, spatial_solve_screw, 1, false, {3, 2, 4}, 0},
  {"driven slider-crank",
   build_driven_crank,
   NULL,
   NULL,
   solve_driven_crank,
   0,
   false,
   {2, 3, 2},
   0},
};

const manifold_scene manifold_crossing = {"slider-crank of equal lengths",
                                          build_short_crank,
                                          build_short_crank_twin,
                                          translate_crank,
                                          NULL,
                                          1,
                                          false,
                                          {2, 3, 2},
                                          0};

const manifold_scene *manifold_scene_find(const char *name)
{
  for (int k = 0; k < MANIFOLD_SCENES; k++) {
    if (strcmp(manifold_scenes[k].name, name) == 0) {
      return &manifold_scenes[k];
    }
  }
  fail_msg("there is no scene %s", name);
  return NULL;
}

static baum_mechanism *make(void (*build)(baum_mechanism *))
{
  baum_mechanism *mechanism = create_mechanism();
  build(mechanism);
  check(baum_mechanism_freeze(mechanism));
  return mechanism;
}

baum_mechanism *manifold_scene_make(const manifold_scene *scene)
{
  return make(scene->build);
}

baum_mechanism *manifold_scene_make_twin(const manifold_scene *scene)
{
  return make(scene->build_twin);
}

void manifold_scene_solve(const manifold_scene *scene, double t, double *q)
{
  if (scene->solve) {
    scene->solve(t, q);
    return;
  }
  baum_mechanism *twin = manifold_scene_make_twin(scene);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.formulation = BAUM_FORMULATION_PROJECTION;
  options.step = 1e-3;
  baum_simulation *run = create_run(twin, &options);
  check(baum_simulation_advance_to(run, t));
  scene->translate(baum_simulation_q(run), q);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(twin);
}
