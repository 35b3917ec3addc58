/* SPDX-License-Identifier: BSD-3-Clause */
#include "tilt.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/rotation.h"

/* The orientation of the tilted plane relative to the ground, as a quaternion. */
static const double TILT[4] = {0.7, -0.1, 0.5, 0.5}; /* its length is 1 */
/* Principal moments of inertia, divided by the moment about the normal of the plane. */
static const double SHAPE[3] = {0.6, 0.7, 1.0};

static void tilt(const double *xy, double z, double out[3])
{
  double axes[9];
  const double in[3] = {xy[0], xy[1], z};
  baum_i_rotation_of(TILT, axes);
  baum_i_turn(axes, in, out);
}

static void tilt_normal(double out[3])
{
  const double zero[2] = {0.0, 0.0};
  tilt(zero, 1.0, out);
}

void model_tilt_body(const double pose[3], double q[7])
{
  const double spin[4] = {cos(0.5 * pose[2]), 0.0, 0.0, sin(0.5 * pose[2])};
  tilt(pose, 0.0, q);
  baum_i_quaternion_product(TILT, spin, q + 3);
}

void model_untilt_body(const double q[7], double pose[3], double off[2])
{
  const double back[4] = {TILT[0], -TILT[1], -TILT[2], -TILT[3]};
  double axes[9];
  double r[3];
  double p[4];
  baum_i_rotation_of(back, axes);
  baum_i_turn(axes, q, r);
  baum_i_quaternion_product(back, q + 3, p);
  pose[0] = r[0];
  pose[1] = r[1];
  pose[2] = remainder(2.0 * atan2(p[3], p[0]), BAUM_I_REVOLUTION);
  off[0] = fabs(r[2]);
  off[1] = 2.0 * hypot(p[1], p[2]);
}

/* ---- elements ---- */

typedef struct twin {
  const baum_mechanism *planar;
  baum_mechanism *into;
  baum_body_id *bodies;  /* (count) */
  double *angles;        /* (count) [rad] */
  baum_joint_id *joints; /* (count) */
  /* (count) [rad] for each joint, the angle of body b minus the angle of body a. */
  double *relative;
} twin;

static bool is_ground(baum_body_id id)
{
  return id.index1 == BAUM_GROUND.index1;
}

static baum_body_id body_of(const twin *t, baum_body_id id)
{
  return is_ground(id) ? BAUM_GROUND : t->bodies[id.index1 - 1];
}

static double angle_of(const twin *t, baum_body_id id)
{
  return is_ground(id) ? 0.0 : t->angles[id.index1 - 1];
}

/* Converts a point or direction. If it belongs to ground, it is converted to ground axes, otherwise
 * to body axes. */
static void put(baum_body_id on, const double xy[2], double z, double out[3])
{
  if (is_ground(on)) {
    tilt(xy, z, out);
  } else {
    out[0] = xy[0];
    out[1] = xy[1];
    out[2] = z;
  }
}

/* Copies the fields with which all definitions with two bodies begin. */
#define PLACE(t, from, to)                                   \
  do {                                                       \
    (to).name = (from).name;                                 \
    (to).body_a = body_of(t, (from).body_a);                 \
    (to).body_b = body_of(t, (from).body_b);                 \
    if (!isnan((from).point[0])) {                           \
      tilt((from).point, 0.0, (to).point);                   \
    } else {                                                 \
      put((from).body_a, (from).point_a, 0.0, (to).point_a); \
      put((from).body_b, (from).point_b, 0.0, (to).point_b); \
    }                                                        \
  } while (0)

static baum_status add_body(twin *t, int k)
{
  baum_body_id id = baum_mechanism_body_at(t->planar, k);
  baum_planar_body_def from = baum_planar_body_def_default();
  if (baum_mechanism_get_planar_body(t->planar, id, &from, sizeof from) != BAUM_OK) {
    baum_planar_particle_def light = baum_planar_particle_def_default();
    baum_spatial_particle_def bob = baum_spatial_particle_def_default();
    baum_status status = baum_mechanism_get_planar_particle(t->planar, id, &light, sizeof light);
    bob.name = light.name;
    bob.mass = light.mass;
    bob.held = light.held;
    tilt(light.position, 0.0, bob.position);
    tilt(light.velocity, 0.0, bob.velocity);
    return status == BAUM_OK ? baum_mechanism_add_spatial_particle(t->into, &bob, &t->bodies[k])
                             : status;
  }
  baum_spatial_body_def to = baum_spatial_body_def_default();
  const double pose[3] = {from.position[0], from.position[1], from.angle};
  double q[7];
  model_tilt_body(pose, q);
  to.name = from.name;
  to.mass = from.mass;
  to.held = from.held;
  for (int i = 0; i < 3; i++) {
    to.inertia[i] = SHAPE[i] * from.inertia;
    to.position[i] = q[i];
  }
  memcpy(to.orientation, q + 3, sizeof to.orientation);
  tilt(from.velocity, 0.0, to.velocity);
  to.angular_velocity[2] = from.angular_velocity;
  t->angles[k] = from.angle;
  return baum_mechanism_add_spatial_body(t->into, &to, &t->bodies[k]);
}

/* Each of these functions adds joint k, if this joint is of the kind in the function's name.
 * Otherwise it calls the function above it, which tries another kind. */

static baum_status add_driver(twin *t, int k)
{
  baum_driver_def def = baum_driver_def_default();
  baum_status status =
    baum_mechanism_get_driver(t->planar, baum_mechanism_joint_at(t->planar, k), &def, sizeof def);
  int of = def.joint.index1 - 1;
  def.joint = t->joints[of];
  def.value -= t->relative[of]; /* spatial joint angles are 0 in the design configuration */
  return status == BAUM_OK ? baum_mechanism_add_driver(t->into, &def, &t->joints[k]) : status;
}

static baum_status add_rod(twin *t, int k)
{
  baum_planar_distance_def from = baum_planar_distance_def_default();
  baum_joint_id id = baum_mechanism_joint_at(t->planar, k);
  if (baum_mechanism_get_planar_distance(t->planar, id, &from, sizeof from) != BAUM_OK) {
    return add_driver(t, k);
  }
  baum_spatial_distance_def to = baum_spatial_distance_def_default();
  PLACE(t, from, to);
  to.length = from.length;
  return baum_mechanism_add_spatial_distance(t->into, &to, &t->joints[k]);
}

static baum_status add_guide(twin *t, int k)
{
  baum_planar_translational_def from = baum_planar_translational_def_default();
  baum_joint_id id = baum_mechanism_joint_at(t->planar, k);
  if (baum_mechanism_get_planar_translational(t->planar, id, &from, sizeof from) != BAUM_OK) {
    return add_rod(t, k);
  }
  baum_spatial_prismatic_def to = baum_spatial_prismatic_def_default();
  PLACE(t, from, to);
  put(isnan(from.point[0]) ? from.body_a : BAUM_GROUND, from.axis, 0.0, to.axis);
  return baum_mechanism_add_spatial_prismatic(t->into, &to, &t->joints[k]);
}

static baum_status add_joint(twin *t, int k)
{
  static const double zero[2] = {0.0, 0.0};
  baum_planar_revolute_def from = baum_planar_revolute_def_default();
  baum_joint_id id = baum_mechanism_joint_at(t->planar, k);
  if (baum_mechanism_get_planar_revolute(t->planar, id, &from, sizeof from) != BAUM_OK) {
    return add_guide(t, k);
  }
  baum_spatial_revolute_def to = baum_spatial_revolute_def_default();
  PLACE(t, from, to);
  if (isnan(from.point[0])) {
    put(from.body_a, zero, 1.0, to.axis);
    put(from.body_b, zero, 1.0, to.axis_b);
  } else {
    tilt_normal(to.axis);
  }
  t->relative[k] = angle_of(t, from.body_b) - angle_of(t, from.body_a);
  return baum_mechanism_add_spatial_revolute(t->into, &to, &t->joints[k]);
}

static baum_status add_load(twin *t, int k)
{
  static const double zero[2] = {0.0, 0.0};
  baum_planar_load_def from = baum_planar_load_def_default();
  baum_status status = baum_mechanism_get_planar_load(
    t->planar, baum_mechanism_force_at(t->planar, k), &from, sizeof from);
  baum_spatial_load_def to = baum_spatial_load_def_default();
  baum_body_id axes = from.follows_body ? from.body : BAUM_GROUND;
  to.name = from.name;
  to.body = body_of(t, from.body);
  to.follows_body = from.follows_body;
  memcpy(to.point, from.point, sizeof from.point);
  put(axes, from.force, 0.0, to.force);
  put(axes, zero, from.torque, to.moment);
  return status == BAUM_OK ? baum_mechanism_add_spatial_load(t->into, &to, NULL) : status;
}

static baum_status add_force(twin *t, int k)
{
  baum_planar_spring_def from = baum_planar_spring_def_default();
  baum_force_id id = baum_mechanism_force_at(t->planar, k);
  if (baum_mechanism_get_planar_spring(t->planar, id, &from, sizeof from) != BAUM_OK) {
    return add_load(t, k);
  }
  baum_spatial_spring_def to = baum_spatial_spring_def_default();
  PLACE(t, from, to);
  to.stiffness = from.stiffness;
  to.damping = from.damping;
  to.free_length = from.free_length;
  return baum_mechanism_add_spatial_spring(t->into, &to, NULL);
}

/* ---- the whole ---- */

static baum_status add_all(twin *t)
{
  double g[3];
  double tilted[3];
  baum_status status = baum_mechanism_get_gravity(t->planar, g);
  tilt(g, g[2], tilted);
  if (status == BAUM_OK) {
    status = baum_mechanism_set_gravity(t->into, tilted[0], tilted[1], tilted[2]);
  }
  for (int k = 0; k < baum_mechanism_body_count(t->planar) && status == BAUM_OK; k++) {
    status = add_body(t, k);
  }
  for (int k = 0; k < baum_mechanism_joint_count(t->planar) && status == BAUM_OK; k++) {
    status = add_joint(t, k);
  }
  for (int k = 0; k < baum_mechanism_force_count(t->planar) && status == BAUM_OK; k++) {
    status = add_force(t, k);
  }
  return status;
}

baum_status model_tilt_into(const baum_mechanism *planar, baum_mechanism *into)
{
  size_t bodies = (size_t)baum_mechanism_body_count(planar) + 1;
  size_t joints = (size_t)baum_mechanism_joint_count(planar) + 1;
  twin t = {planar,
            into,
            calloc(bodies, sizeof *t.bodies),
            calloc(bodies, sizeof *t.angles),
            calloc(joints, sizeof *t.joints),
            calloc(joints, sizeof *t.relative)};
  baum_status status =
    t.bodies && t.angles && t.joints && t.relative ? add_all(&t) : BAUM_ERR_MEMORY;
  free(t.bodies);
  free(t.angles);
  free(t.joints);
  free(t.relative);
  return status;
}

static baum_status move_last(baum_mechanism *m, double aside)
{
  baum_spatial_body_def def = baum_spatial_body_def_default();
  baum_body_id id = baum_mechanism_body_at(m, baum_mechanism_body_count(m) - 1);
  double normal[3];
  baum_status status = baum_mechanism_get_spatial_body(m, id, &def, sizeof def);
  tilt_normal(normal);
  for (int i = 0; i < 3; i++) {
    def.position[i] += aside * normal[i];
  }
  return status == BAUM_OK ? baum_mechanism_set_spatial_body(m, id, &def) : status;
}

baum_status model_tilt(const baum_mechanism *planar, double aside, baum_mechanism **out)
{
  baum_status status = baum_mechanism_create(out);
  status = status == BAUM_OK ? model_tilt_into(planar, *out) : status;
  status = status == BAUM_OK && aside != 0.0 ? move_last(*out, aside) : status;
  status = status == BAUM_OK ? baum_mechanism_freeze(*out) : status;
  if (status != BAUM_OK) {
    baum_mechanism_destroy(*out);
    *out = NULL;
  }
  return status;
}
