/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the fixed bodies and their poses. A body is fixed if a chain of welds connects it to
 * ground. */
#include <string.h>

#include "mechanism/mechanism.h"

/* If exactly one body of a weld is fixed, mark the other one as fixed and find its pose. */
static bool fix_next(baum_mechanism *m, baum_i_joint *joint)
{
  const baum_i_body *a = m->bodies[joint->span.bodies[0]];
  const baum_i_body *b = m->bodies[joint->span.bodies[1]];
  if (a->fixed == b->fixed) {
    return false;
  }
  const baum_i_body *known = a->fixed ? a : b;
  baum_i_body *next = m->bodies[joint->span.bodies[a->fixed ? 1 : 0]];
  joint->type->weld(m->parameters + joint->element.parameter, a->fixed,
                    known == m->bodies[0] ? NULL : m->fixed_q + known->q, m->fixed_q + next->q);
  next->fixed = true;
  joint->fixes = true;
  m->fixed_count++;
  m->fixed_nv += next->nv;
  return true;
}

/* The joints are visited in several passes, alternately forwards and backwards. If the welds of a
 * chain were added in the order from ground outwards, or in the opposite order, at most two passes
 * find all its bodies. */
static void fix_bodies(baum_mechanism *m)
{
  bool found = true;
  for (bool forward = true; found; forward = !forward) {
    found = false;
    for (int i = 0; i < m->joint_count; i++) {
      baum_i_joint *joint = m->joints[forward ? i : m->joint_count - 1 - i];
      found = (joint->type->weld && fix_next(m, joint)) || found;
    }
  }
}

void baum_i_find_fixed_bodies(baum_mechanism *m)
{
  m->fixed_count = 0;
  m->fixed_nv = 0;
  for (int i = 0; i <= m->body_count; i++) {
    m->bodies[i]->fixed = i == 0;
  }
  for (int k = 0; k < m->joint_count; k++) {
    m->joints[k]->fixes = false;
  }
  fix_bodies(m);
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_span *span = &m->joints[k]->span;
    m->joints[k]->fixed = true;
    for (int i = 0; i < span->body_count; i++) {
      m->joints[k]->fixed &= m->bodies[span->bodies[i]]->fixed;
    }
  }
}

void baum_i_place_fixed_bodies(const baum_mechanism *m, double *q)
{
  for (int i = 1; m->fixed_count > 0 && i <= m->body_count; i++) {
    const baum_i_body *body = m->bodies[i];
    if (body->fixed) {
      memcpy(q + body->q, m->fixed_q + body->q, (size_t)body->nq * sizeof *q);
    }
  }
}

void baum_i_rest_fixed_bodies(const baum_mechanism *m, double *v)
{
  for (int i = 1; m->fixed_count > 0 && i <= m->body_count; i++) {
    const baum_i_body *body = m->bodies[i];
    if (body->fixed) {
      memset(v + body->v, 0, (size_t)body->nv * sizeof *v);
    }
  }
}
