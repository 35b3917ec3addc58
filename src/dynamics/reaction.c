/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the reaction of a joint, which is the generalized force -J^T lambda of the joint's rows
 * on its bodies.
 *
 * For a planar joint, the entries of this force at (x, y) of body_b are the force F, and the entry
 * at the angle of body_b is the moment m_C about its centre of mass C. The moment about the joint's
 * point P on body_b is m_P = m_C - cross(P - C, F). Ground has no columns in J. If body_b is
 * ground, force and moment on it are therefore the opposite of those on body_a. In space the same
 * equations hold with vectors. All six columns of body_b are used, even if it is planar, a particle
 * or ground. The entries at the rotations are the components of the moment about C in body axes.
 */
#include <string.h>

#include "base/rotation.h"
#include "dynamics/dynamics.h"
#include "mechanism/planar/planar.h"

/* Compute -J^T lambda over the joint's local columns. */
static void find_generalized_force(const baum_workspace *w, const baum_i_joint *joint,
                                   const double *lambda, double *out)
{
  const double *block = w->jacobian + joint->jacobian;
  int nl = joint->span.nl;
  memset(out, 0, (size_t)nl * sizeof *out);
  for (int i = 0; i < joint->rows; i++) {
    for (int j = 0; j < nl; j++) {
      out[j] -= block[i * nl + j] * lambda[joint->row + i];
    }
  }
}

/* Compute the force on one body of a planar joint and its moment about the point `at`. */
static void reduce_to_point(const baum_i_frame *frame, const double *side, int nv,
                            const double at[2], double out[3])
{
  out[0] = side[0];
  out[1] = side[1];
  double moment = nv == 3 ? side[2] : 0.0;
  out[2] = moment - ((at[0] - frame->x) * side[1] - (at[1] - frame->y) * side[0]);
}

static void find_planar_reaction(const baum_workspace *w, const baum_i_joint *joint,
                                 const double *local, double out[3])
{
  const baum_mechanism *m = w->mechanism;
  int a = joint->span.bodies[0];
  int b = joint->span.bodies[1];
  double at[3];
  joint->type->place(joint, &w->point, at);
  if (b != 0) {
    int offset = a != 0 ? m->bodies[a]->nv : 0;
    reduce_to_point(&w->point.frames[b], local + offset, m->bodies[b]->nv, at, out);
    return;
  }
  reduce_to_point(&w->point.frames[a], local, m->bodies[a]->nv, at, out);
  for (int i = 0; i < 3; i++) {
    out[i] = -out[i];
  }
}

/* The reaction includes forces and moments on planar bodies and particles in directions in which
 * they cannot move. */
static void find_spatial_reaction(const baum_workspace *w, const baum_i_joint *joint,
                                  const double *lambda, double out[6])
{
  const baum_i_spatial_frame *frame = &w->point.spatial[joint->span.bodies[1]];
  double six[BAUM_I_SPACE] = {0.0};
  double at[3];
  double arm[3];
  double shift[3];
  joint->type->force_on_b(joint, &w->point, lambda + joint->row, six);
  joint->type->place(joint, &w->point, at);
  baum_i_turn(frame->axes, six + 3, out + 3);
  for (int i = 0; i < 3; i++) {
    arm[i] = at[i] - frame->r[i];
  }
  baum_i_cross(arm, six, shift);
  for (int i = 0; i < 3; i++) {
    out[i] = six[i];
    out[3 + i] -= shift[i];
  }
}

static int width_of(const baum_mechanism *m, const baum_i_joint *joint)
{
  bool drives = joint->type->driven != NULL;
  return (drives ? joint->type->driven(m, joint->element.def).joint : joint)->type->width;
}

int baum_i_reaction_width(const baum_mechanism *mechanism, int joint)
{
  const baum_i_joint *j = mechanism->joints[joint];
  int width = width_of(mechanism, j);
  return width > 0 ? width : j->span.nl;
}

void baum_i_reaction(const baum_workspace *w, int joint, const double *lambda, double *out)
{
  const baum_i_joint *j = w->mechanism->joints[joint];
  int width = width_of(w->mechanism, j);
  if (width == BAUM_I_PLANE) {
    double local[6];
    find_generalized_force(w, j, lambda, local);
    find_planar_reaction(w, j, local, out);
  } else if (width == BAUM_I_SPACE) {
    find_spatial_reaction(w, j, lambda, out);
  } else {
    find_generalized_force(w, j, lambda, out);
  }
}
