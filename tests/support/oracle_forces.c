/* SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "oracle_motion.h"

/* ---- forces at points ---- */

void oracle_inertia_times(const oracle_body *body, const wide x[3], wide out[3])
{
  const double *i = body->inertia;
  out[0] = i[0] * x[0] + i[3] * x[1] + i[4] * x[2];
  out[1] = i[3] * x[0] + i[1] * x[1] + i[5] * x[2];
  out[2] = i[4] * x[0] + i[5] * x[1] + i[2] * x[2];
}

void oracle_add_wrench(const motion *body, const wide point[3], const wide force[3],
                       const wide moment[3], wide six[6])
{
  wide arm[3];
  wide about[3];
  for (int i = 0; i < 3; i++) {
    arm[i] = point[i] - body->r[i].d[0];
  }
  cross3(arm, force, about);
  for (int i = 0; i < 3; i++) {
    six[i] += force[i];
    for (int j = 0; j < 3; j++) {
      six[3 + i] += body->axes[i][j].d[0] * (about[j] + moment[j]);
    }
  }
}

static void place_at(const motion *body, const double s[3], jet out[3])
{
  const wide point[3] = {s[0], s[1], s[2]};
  oracle_turned(body, point, out);
  for (int i = 0; i < 3; i++) {
    out[i] = jet_add(out[i], body->r[i]);
  }
}

static void add_spring(const oracle_force *f, const motion *bodies, wide six[][6])
{
  static const wide none[3] = {0};
  jet ends[2][3];
  jet apart[3];
  place_at(&bodies[f->a], f->s[0], ends[0]);
  place_at(&bodies[f->b], f->s[1], ends[1]);
  for (int i = 0; i < 3; i++) {
    apart[i] = jet_less(ends[1][i], ends[0][i]);
  }
  const jet length = jet_root(jet_dot(apart, apart));
  wide tension = f->stiffness * (length.d[0] - f->free_length) + f->damping * length.d[1];
  for (int side = 0; side < 2; side++) {
    wide force[3];
    wide point[3];
    for (int i = 0; i < 3; i++) {
      force[i] = (side == 0 ? tension : -tension) * apart[i].d[0] / length.d[0];
      point[i] = ends[side][i].d[0];
    }
    int body = side == 0 ? f->a : f->b;
    oracle_add_wrench(&bodies[body], point, force, none, six[body]);
  }
}

static void add_load(const oracle_force *f, const motion *bodies, wide six[][6])
{
  const motion *body = &bodies[f->b];
  jet at[3];
  wide given[2][3];
  wide point[3];
  place_at(body, f->s[1], at);
  for (int i = 0; i < 3; i++) {
    point[i] = at[i].d[0];
    given[0][i] = f->force[i];
    given[1][i] = f->moment[i];
  }
  for (int k = 0; k < 2 && f->follows_body; k++) {
    jet out[3];
    oracle_turned(body, given[k], out);
    for (int i = 0; i < 3; i++) {
      given[k][i] = out[i].d[0];
    }
  }
  oracle_add_wrench(body, point, given[0], given[1], six[f->b]);
}

static void add_joint_spring(const oracle_force *f, const instant *now, wide six[][6])
{
  const oracle_joint *joint = &now->o->joints[f->of];
  const jet c = oracle_coordinate_of(joint, f->coordinate, now->bodies);
  wide force = f->stiffness * (c.d[0] - f->free_length) + f->damping * c.d[1];
  instant still = oracle_stop(now);
  for (int side = 0; side < 2; side++) {
    int body = side == 0 ? joint->a : joint->b;
    const motion kept = still.bodies[body];
    for (int k = 0; k < 6; k++) {
      wide unit[6] = {0};
      unit[k] = 1;
      oracle_set_velocities(&still, body, unit);
      six[body][k] -= force * oracle_coordinate_of(joint, f->coordinate, still.bodies).d[1];
    }
    still.bodies[body] = kept;
  }
}

/* ---- torsion springs ---- */

/* The angle is the twist of body_b relative to body_a. Its derivative is the component of the
 * relative angular velocity along (z_a + z_b) / (1 + z_a . z_b), so the torque acts along this
 * vector. */
static void add_torsion_spring(const oracle_force *f, const motion *bodies, wide six[][6])
{
  static const wide none[3] = {0};
  const moving m = oracle_moving_of(&f->frame, bodies);
  const motion *side[2] = {&bodies[f->frame.a], &bodies[f->frame.b]};
  jet w[2][3];
  wide along[3];
  wide rate = 0;
  wide c = jet_dot(m.axes[0][2], m.axes[1][2]).d[0];
  oracle_angular_velocity(side[0], w[0]);
  oracle_angular_velocity(side[1], w[1]);
  for (int i = 0; i < 3; i++) {
    along[i] = (m.axes[0][2][i].d[0] + m.axes[1][2][i].d[0]) / (1 + c);
    rate += along[i] * (w[1][i].d[0] - w[0][i].d[0]);
  }
  const jet cosine =
    jet_add(jet_dot(m.axes[0][0], m.axes[1][0]), jet_dot(m.axes[0][1], m.axes[1][1]));
  const jet sine =
    jet_less(jet_dot(m.axes[0][1], m.axes[1][0]), jet_dot(m.axes[0][0], m.axes[1][1]));
  const jet angle = jet_angle(cosine, sine);
  wide torque = f->stiffness * (angle.d[0] - f->free_length) + f->damping * rate;
  for (int k = 0; k < 2; k++) {
    wide moment[3];
    for (int i = 0; i < 3; i++) {
      moment[i] = (k == 0 ? torque : -torque) * along[i];
    }
    oracle_add_wrench(side[k], none, none, moment, six[k == 0 ? f->frame.a : f->frame.b]);
  }
}

/* ---- bushings ---- */

/* Computes the rotation vector of a rotation matrix with the elements r. The function first
 * computes the quaternion. Square roots of the quaternion then halve the angle several times.
 * Finally, the series of the arcsine is summed for the small vector part. */
static void rotation_vector(jet r[3][3], jet out[3])
{
  enum { HALVED = 3, TERMS = 28 };
  const jet one = {{1, 0, 0}};
  jet w =
    jet_scale((wide)1 / 2, jet_root(jet_add(one, jet_add(r[0][0], jet_add(r[1][1], r[2][2])))));
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3;
    int k = (i + 2) % 3;
    out[i] = jet_quotient(jet_less(r[k][j], r[j][k]), jet_scale(4, w));
  }
  for (int n = 0; n < HALVED; n++) {
    w = jet_root(jet_scale((wide)1 / 2, jet_add(one, w)));
    for (int i = 0; i < 3; i++) {
      out[i] = jet_quotient(out[i], jet_scale(2, w));
    }
  }
  const jet square = jet_dot(out, out);
  jet power = {{1, 0, 0}};
  jet sum = {{0, 0, 0}};
  wide factor = 1;
  for (int n = 0; n < TERMS; n++) {
    sum = jet_add(sum, jet_scale(factor / (2 * n + 1), power));
    factor *= (wide)(2 * n + 1) / (2 * n + 2);
    power = jet_times(power, square);
  }
  for (int i = 0; i < 3; i++) {
    out[i] = jet_scale(1 << (HALVED + 1), jet_times(sum, out[i]));
  }
}

/* Computes the six displacements, in the axes of the bushing on body_a. */
static void displacements_of(const oracle_joint *frame, const motion *bodies, jet out[6])
{
  const moving m = oracle_moving_of(frame, bodies);
  jet r[3][3];
  for (int i = 0; i < 3; i++) {
    out[i] = jet_dot(m.axes[0][i], m.e);
    for (int j = 0; j < 3; j++) {
      r[i][j] = jet_dot(m.axes[0][i], m.axes[1][j]);
    }
  }
  rotation_vector(r, out + 3);
}

static void add_bushing(const oracle_force *f, const instant *now, wide six[][6])
{
  const oracle_joint *frame = &f->frame;
  jet x[6];
  wide force[6] = {0};
  displacements_of(frame, now->bodies, x);
  for (int i = 0; i < 6; i++) {
    for (int j = 0; j < 6; j++) {
      force[i] += f->stiffness_of_6[6 * i + j] * x[j].d[0] + f->damping_of_6[6 * i + j] * x[j].d[1];
    }
  }
  instant still = oracle_stop(now);
  for (int side = 0; side < 2; side++) {
    int body = side == 0 ? frame->a : frame->b;
    const motion kept = still.bodies[body];
    for (int k = 0; k < 6; k++) {
      wide unit[6] = {0};
      unit[k] = 1;
      oracle_set_velocities(&still, body, unit);
      displacements_of(frame, still.bodies, x);
      for (int i = 0; i < 6; i++) {
        six[body][k] -= force[i] * x[i].d[1];
      }
    }
    still.bodies[body] = kept;
  }
}

/* ---- cables ---- */

/* Computes the length of a cable, the points of its path, and the unit vector of each part. The
 * unit vector of a part without length is 0. */
static jet length_of(const oracle_force *f, const motion *bodies, wide at[ORACLE_PATH][3],
                     wide along[ORACLE_PATH][3])
{
  jet points[ORACLE_PATH][3];
  jet sum = {{0, 0, 0}};
  memset(along, 0, ORACLE_PATH * sizeof *along);
  for (int k = 0; k < f->point_count; k++) {
    place_at(&bodies[f->path[k]], f->points[k], points[k]);
    for (int i = 0; i < 3; i++) {
      at[k][i] = points[k][i].d[0];
    }
  }
  for (int k = 0; k + 1 < f->point_count; k++) {
    jet apart[3];
    for (int i = 0; i < 3; i++) {
      apart[i] = jet_less(points[k + 1][i], points[k][i]);
    }
    const jet square = jet_dot(apart, apart);
    if (square.d[0] > 0) {
      const jet length = jet_root(square);
      sum = jet_add(sum, length);
      for (int i = 0; i < 3; i++) {
        along[k][i] = apart[i].d[0] / length.d[0];
      }
    }
  }
  return sum;
}

wide oracle_design_length(const spatial_oracle *o, const oracle_force *cable)
{
  motion bodies[ORACLE_BODIES];
  wide at[ORACLE_PATH][3];
  wide along[ORACLE_PATH][3];
  oracle_design_motions(o, bodies);
  return length_of(cable, bodies, at, along).d[0];
}

/* Returns the tension of a cable. During the transition, the damping is multiplied by 3 x^2 - 2
 * x^3, where x is the stretch divided by the length of the transition. */
static wide tension_of(const oracle_force *f, jet length)
{
  const wide stretch = length.d[0] - f->free_length;
  const wide x = stretch < f->transition ? stretch / f->transition : 1;
  const wide tension =
    f->stiffness * stretch + f->damping * (3 * x * x - 2 * x * x * x) * length.d[1];
  return stretch > 0 && tension > 0 ? tension : 0;
}

/* The tension pulls each point towards the next point and towards the previous point. */
static void add_cable(const oracle_force *f, const motion *bodies, wide six[][6])
{
  static const wide none[3] = {0};
  wide at[ORACLE_PATH][3];
  wide along[ORACLE_PATH][3];
  const wide tension = tension_of(f, length_of(f, bodies, at, along));
  for (int k = 0; k < f->point_count; k++) {
    wide force[3];
    for (int i = 0; i < 3; i++) {
      force[i] = tension * (along[k][i] - (k > 0 ? along[k - 1][i] : 0));
    }
    oracle_add_wrench(&bodies[f->path[k]], at[k], force, none, six[f->path[k]]);
  }
}

/* ---- all ---- */

void oracle_forces_at(const instant *now, wide six[][6])
{
  const spatial_oracle *o = now->o;
  memset(six, 0, ORACLE_BODIES * sizeof *six);
  for (int k = 1; k < o->body_count; k++) {
    const oracle_body *body = &o->bodies[k];
    wide momentum[3];
    wide moment[3];
    oracle_inertia_times(body, now->bodies[k].six + 3, momentum);
    cross3(momentum, now->bodies[k].six + 3, moment);
    for (int i = 0; i < 3; i++) {
      six[k][i] = (wide)body->mass * o->gravity[i];
      six[k][3 + i] = moment[i];
    }
  }
  for (int n = 0; n < o->force_count; n++) {
    const oracle_force *f = &o->forces[n];
    switch (f->kind) {
    case ORACLE_LOAD: add_load(f, now->bodies, six); break;
    case ORACLE_SPRING: add_spring(f, now->bodies, six); break;
    case ORACLE_JOINT_SPRING: add_joint_spring(f, now, six); break;
    case ORACLE_TORSION_SPRING: add_torsion_spring(f, now->bodies, six); break;
    case ORACLE_BUSHING: add_bushing(f, now, six); break;
    case ORACLE_CABLE: add_cable(f, now->bodies, six); break;
    case ORACLE_FORCE_KINDS:
    default: break;
    }
  }
}
