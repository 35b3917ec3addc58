/* SPDX-License-Identifier: BSD-3-Clause */
#include "account_scenes.h"

#include <math.h>

const account_scene account_scenes[ACCOUNT_SCENES] = {
  {"quiet", ACCOUNT_QUIET, BAUM_START_ASSEMBLE, 1.0},
  {"driven", ACCOUNT_DRIVEN, BAUM_START_ASSEMBLE, 1.0},
  {"damped", ACCOUNT_DAMPED, BAUM_START_ASSEMBLE, 1.0},
  {"violated", ACCOUNT_VIOLATED, BAUM_START_AS_GIVEN, 1.0},
  {"polar", ACCOUNT_POLAR, BAUM_START_ASSEMBLE, 1.0},
};

/* ---- user functions ---- */

/* The law of a stiffening spring with a damper. */
static int spring_law(double length, double rate, double *out, void *user)
{
  (void)user;
  double stretch = length - 0.8;
  out[0] = 6.0 * stretch + 20.0 * stretch * stretch * stretch + 0.3 * rate;
  out[1] = 6.0 + 60.0 * stretch * stretch;
  out[2] = 0.3;
  return 0;
}

/* The law of the driver. At the start it prescribes the velocity 0, because the link is at rest. */
static int drive_law(double t, double s[3], void *user)
{
  (void)user;
  s[0] = 0.9 * (1.0 - cos(4.0 * t));
  s[1] = 3.6 * sin(4.0 * t);
  s[2] = 14.4 * cos(4.0 * t);
  return 0;
}

/* A user force on a planar body. It is the sum of drag and of the force -x^3 along x, which has the
 * potential x^4 / 4. */
static int drag(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)t;
  (void)inputs;
  (void)user;
  double speed = sqrt(1.0 + v[0] * v[0] + v[1] * v[1]);
  out[0] = -0.4 * speed * v[0] - q[0] * q[0] * q[0];
  out[1] = -0.4 * speed * v[1];
  return 0;
}

static int pull(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = 0.25 * q[0] * q[0] * q[0] * q[0];
  return 0;
}

/* Computes the mass matrix of a particle of 2 kg in polar coordinates (r, angle). */
static int polar_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = 2.0;
  out[3] = 2.0 * q[0] * q[0];
  return 0;
}

/* Computes the inertia forces of this particle that depend on velocities, and adds the force of a
 * radial spring of 30 N/m and of a radial damper of 0.5 N s/m. */
static int polar_force(double t, const double *q, const double *v, const double *inputs,
                       double *out, void *user)
{
  (void)t;
  (void)inputs;
  (void)user;
  out[0] = 2.0 * q[0] * v[1] * v[1] - 30.0 * (q[0] - 1.0) - 0.5 * v[0];
  out[1] = -4.0 * q[0] * v[0] * v[1];
  return 0;
}

static int polar_potential(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = 15.0 * (q[0] - 1.0) * (q[0] - 1.0);
  return 0;
}

/* ---- parts ---- */

/* A mechanism that several calls build. `status` keeps the status of the first call that failed. */
typedef struct maker {
  baum_mechanism *m;
  baum_status status;
  baum_body_id links[2];
  baum_joint_id pins[2];
} maker;

static void keep(maker *make, baum_status status)
{
  make->status = make->status == BAUM_OK ? status : make->status;
}

/* Adds a double pendulum. Its two links are 1 m long and lie along x, and the second one rotates at
 * 2 rad/s. If `off` [m] is not 0, the positions and velocities of the links violate the
 * constraints. */
static void add_links(maker *make, double off)
{
  keep(make, baum_mechanism_set_gravity(make->m, 0.0, -9.81, 0.0));
  for (int k = 0; k < 2; k++) {
    baum_planar_body_def link = baum_planar_body_def_default();
    link.mass = 1.0 + k;
    link.inertia = (1.0 + k) / 12.0;
    link.position[0] = 0.5 + k + off * k;
    link.position[1] = off;
    link.angular_velocity = 2.0 * k;
    if (off != 0.0) {
      link.velocity[0] = 0.3 * k;
      link.velocity[1] = 1.0 * k;
    }
    keep(make, baum_mechanism_add_planar_body(make->m, &link, &make->links[k]));
    baum_planar_revolute_def pin = baum_planar_revolute_def_default();
    pin.body_a = k == 0 ? BAUM_GROUND : make->links[0];
    pin.body_b = make->links[k];
    pin.point_a[0] = k == 0 ? 0.0 : 0.5;
    pin.point_a[1] = 0.0;
    pin.point_b[0] = -0.5;
    pin.point_b[1] = 0.0;
    keep(make, baum_mechanism_add_planar_revolute(make->m, &pin, &make->pins[k]));
  }
}

static void add_driver(maker *make)
{
  baum_driver_def driver = baum_driver_def_default();
  driver.joint = make->pins[0];
  driver.law = drive_law;
  keep(make, baum_mechanism_add_driver(make->m, &driver, NULL));
}

static void add_springs(maker *make)
{
  baum_planar_spring_def spring = baum_planar_spring_def_default();
  spring.body_a = BAUM_GROUND;
  spring.body_b = make->links[0];
  spring.point_a[0] = 0.3;
  spring.point_a[1] = 1.0;
  spring.point_b[0] = 0.25;
  spring.point_b[1] = 0.0;
  spring.stiffness = 12.0;
  spring.damping = 0.7;
  spring.free_length = 0.9;
  keep(make, baum_mechanism_add_planar_spring(make->m, &spring, NULL));
  spring.body_b = make->links[1];
  spring.stiffness = 0.0;
  spring.damping = 0.0;
  spring.free_length = NAN;
  spring.law = spring_law;
  keep(make, baum_mechanism_add_planar_spring(make->m, &spring, NULL));
  baum_planar_torsion_spring_def torsion = baum_planar_torsion_spring_def_default();
  torsion.body_a = make->links[0];
  torsion.body_b = make->links[1];
  torsion.stiffness = 2.0;
  torsion.damping = 0.2;
  keep(make, baum_mechanism_add_planar_torsion_spring(make->m, &torsion, NULL));
}

static void add_loads(maker *make)
{
  baum_input_id input;
  keep(make, baum_mechanism_add_input(make->m, "motor", 1.5, &input));
  baum_planar_load_def load = baum_planar_load_def_default();
  load.body = make->links[0];
  load.torque = 2.0;
  load.input = input;
  keep(make, baum_mechanism_add_planar_load(make->m, &load, NULL));
  load = baum_planar_load_def_default();
  load.body = make->links[1];
  load.force[0] = 1.0;
  load.force[1] = 3.0;
  load.point[0] = 0.5;
  keep(make, baum_mechanism_add_planar_load(make->m, &load, NULL));
  load.follows_body = true;
  keep(make, baum_mechanism_add_planar_load(make->m, &load, NULL));
  baum_joint_load_def motor = baum_joint_load_def_default();
  motor.joint = make->pins[1];
  motor.effort = -0.8;
  motor.input = input;
  keep(make, baum_mechanism_add_joint_load(make->m, &motor, NULL));
  baum_user_force_def user = baum_user_force_def_default();
  user.bodies = &make->links[1];
  user.body_count = 1;
  user.force = drag;
  user.potential = pull;
  keep(make, baum_mechanism_add_user_force(make->m, &user, NULL));
}

static void add_polar(maker *make)
{
  static const double q[2] = {1.2, 0.0};
  static const double v[2] = {0.0, 3.0};
  baum_coordinates_def polar = baum_coordinates_def_default();
  polar.size = 2;
  polar.q = q;
  polar.v = v;
  polar.mass = polar_mass;
  polar.force = polar_force;
  polar.potential = polar_potential;
  keep(make, baum_mechanism_add_coordinates(make->m, &polar, NULL));
}

baum_mechanism *account_build(const account_scene *scene)
{
  maker make = {.status = BAUM_OK};
  keep(&make, baum_mechanism_create(&make.m));
  if (scene->kind == ACCOUNT_POLAR) {
    add_polar(&make);
  } else {
    add_links(&make, scene->kind == ACCOUNT_VIOLATED ? 0.01 : 0.0);
  }
  if (scene->kind == ACCOUNT_DRIVEN) {
    add_driver(&make);
  }
  if (scene->kind == ACCOUNT_DAMPED) {
    add_springs(&make);
    add_loads(&make);
  }
  keep(&make, make.m ? baum_mechanism_freeze(make.m) : make.status);
  if (make.status != BAUM_OK) {
    baum_mechanism_destroy(make.m);
    return NULL;
  }
  return make.m;
}
