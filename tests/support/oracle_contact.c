/* SPDX-License-Identifier: BSD-3-Clause */
/* Evaluates rows of velocity level, and points on curves. Rows of velocity level state that the
 * material points of two bodies at the same place P have equal velocities in some directions. The
 * velocity of the material point of a body at P is r' + W x (P - r). Its derivative follows from
 * the motion of P. */
#include <math.h>
#include <string.h>

#include "oracle_motion.h"

static void point_on(const motion *body, const wide s[3], jet out[3])
{
  oracle_turned(body, s, out);
  for (int i = 0; i < 3; i++) {
    out[i] = jet_add(body->r[i], out[i]);
  }
}

/* Computes the velocity of body_b relative to body_a at a point. The result has only a value and a
 * first derivative. */
static void relative_velocity(const oracle_joint *joint, const motion *bodies, const jet point[3],
                              jet out[3])
{
  jet side[2][3];
  for (int k = 0; k < 2; k++) {
    const motion *body = &bodies[k == 0 ? joint->a : joint->b];
    jet w[3];
    jet arm[3];
    oracle_angular_velocity(body, w);
    for (int i = 0; i < 3; i++) {
      arm[i] = jet_less(point[i], body->r[i]);
    }
    jet_cross(w, arm, side[k]);
    for (int i = 0; i < 3; i++) {
      side[k][i] = jet_add(side[k][i], jet_rate(body->r[i]));
    }
  }
  for (int i = 0; i < 3; i++) {
    out[i] = jet_less(side[1][i], side[0][i]);
  }
}

/* Returns the row of velocity level e . u = 0, where u is a relative velocity. */
static jet velocity_row(const jet e[3], const jet u[3])
{
  const jet value = jet_dot(e, u);
  return (jet){{0, value.d[0], value.d[1]}};
}

bool oracle_is_edge(const oracle_joint *joint)
{
  return joint->kind == ORACLE_KNIFE_EDGE || joint->kind == ORACLE_SPATIAL_EDGE;
}

/* The point of the rim nearest to the plane is reached from the centre in the direction -n x (k x
 * n), where n is the axis of the disc and k is the normal of the plane. */
void oracle_contact_point(const oracle_joint *joint, const motion *bodies, jet out[3])
{
  const wide inner = (wide)joint->radius - (wide)joint->rim;
  jet k[3];
  jet n[3];
  jet beside[3];
  jet up[3];
  if (oracle_is_edge(joint)) {
    point_on(&bodies[joint->a], joint->s[0], out);
    return;
  }
  point_on(&bodies[joint->b], joint->s[1], out);
  oracle_turned(&bodies[joint->a], joint->axes[0] + 6, k);
  oracle_turned(&bodies[joint->b], joint->axes[1] + 6, n);
  jet_cross(k, n, beside);
  jet_cross(n, beside, up);
  const jet length = jet_root(jet_dot(up, up));
  for (int i = 0; i < 3; i++) {
    if (inner > 0) { /* not for a sphere, whose axis may be parallel to the normal */
      out[i] = jet_less(out[i], jet_scale(inner, jet_quotient(up[i], length)));
    }
    out[i] = jet_less(out[i], jet_scale(joint->rim, k[i]));
  }
}

int oracle_disc_rows(const oracle_joint *joint, const motion *bodies, jet *out)
{
  const motion *plane = &bodies[joint->a];
  jet point[3];
  jet on_plane[3];
  jet above[3];
  jet u[3];
  jet e[3][3];
  oracle_contact_point(joint, bodies, point);
  point_on(plane, joint->s[0], on_plane);
  relative_velocity(joint, bodies, point, u);
  for (int i = 0; i < 3; i++) {
    oracle_turned(plane, joint->axes[0] + (ptrdiff_t)3 * i, e[i]);
    above[i] = jet_less(point[i], on_plane[i]);
  }
  out[0] = jet_dot(e[2], above);
  out[1] = velocity_row(e[0], u);
  out[2] = velocity_row(e[1], u);
  return 3;
}

int oracle_edge_rows(const oracle_joint *joint, const motion *bodies, jet *out)
{
  jet point[3];
  jet across[3];
  jet u[3];
  oracle_contact_point(joint, bodies, point);
  relative_velocity(joint, bodies, point, u);
  oracle_turned(&bodies[joint->a], joint->axes[0] + 3, across);
  out[0] = velocity_row(across, u);
  return 1;
}

/* Computes cosine and sine of an angle. */
static void turn_along(jet angle, jet *cosine, jet *sine)
{
  const wide rate = angle.d[1];
  wide c;
  wide s;
  oracle_turn(angle.d[0], &c, &s);
  *cosine = (jet){{c, -s * rate, -c * rate * rate - s * angle.d[2]}};
  *sine = (jet){{s, c * rate, c * angle.d[2] - s * rate * rate}};
}

int oracle_curve_rows(const oracle_joint *joint, const motion *bodies, jet *out)
{
  const oracle_curve *curve = &joint->curve;
  const wide r = curve->r;
  const moving m = oracle_moving_of(joint, bodies);
  jet y[3];
  jet cosine;
  jet sine;
  for (int i = 0; i < 3; i++) {
    y[i] = (jet){{curve->shift[i], 0, 0}};
    for (int j = 0; j < 3; j++) {
      y[i] =
        jet_add(y[i], jet_scale(curve->turn[3 * i + j], jet_dot(bodies[joint->a].axes[j], m.e)));
    }
  }
  switch ((int)curve->kind) {
  case ORACLE_HELIX:
    turn_along(jet_scale(1 / (wide)curve->c, y[2]), &cosine, &sine);
    out[0] = jet_less(y[0], jet_scale(r, cosine));
    out[1] = jet_less(y[1], jet_scale(r, sine));
    break;
  case ORACLE_CIRCLE:
    out[0] = jet_scale(1 / (2 * r), jet_add(jet_times(y[0], y[0]), jet_times(y[1], y[1])));
    out[0].d[0] -= r / 2;
    out[1] = y[2];
    break;
  default:
    out[0] = jet_less(y[1], jet_scale(r / 2, jet_times(y[0], y[0])));
    out[1] = jet_less(y[2], jet_scale(curve->c, y[0]));
    break;
  }
  return 2;
}

int oracle_user_rows(const spatial_oracle *o, const oracle_joint *joint, const motion *bodies,
                     double t, int flow, jet *out)
{
  const oracle_user *user = &joint->user;
  const jet x = bodies[user->members[0]].r[0];
  for (int i = 0; i < user->rows; i++) {
    int j = 0;
    out[i] = (jet){{0, -flow * user->nu[i] * cos(t), flow * user->nu[i] * sin(t)}};
    for (int k = 0; k < user->member_count; k++) {
      const oracle_body *body = &o->bodies[user->members[k]];
      for (int n = 0; n < body->nv; n++, j++) {
        wide v = bodies[user->members[k]].six[oracle_six_of(body, n)];
        out[i].d[1] += ((wide)user->linear[i][j] + user->slope[i][j] * x.d[0]) * v;
        out[i].d[2] += user->slope[i][j] * x.d[1] * v;
      }
    }
  }
  return user->rows;
}
