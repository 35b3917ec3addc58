/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies welded to ground, one by one, are one with it: they cannot move, and hold no island
 * together. Other bodies cannot move either where their island has no freedom and no row that
 * depends on time. The freedoms of an island are its velocities less its rows that are not
 * redundant.
 *
 * Which rows were taken for redundant is a choice between equals. Where a row of a weld was chosen,
 * the row that it made redundant counts in an island which then seems too stiff; unless welds have
 * kept as many rows as their bodies have velocities, all that is left being the islands' own. If
 * not, welded bodies are counted in the islands that they hold together. They still cannot move.
 */
#include "dynamics/islands.h"

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/planar/planar.h"

/* ---- sets of bodies, as a forest ---- */

static int root_of(int *parent, int body)
{
  while (parent[body] != body) {
    parent[body] = parent[parent[body]]; /* half as far for the next one */
    body = parent[body];
  }
  return body;
}

/* The root of both is the first body. */
static void unite(int *parent, int a, int b)
{
  int root_a = root_of(parent, a);
  int root_b = root_of(parent, b);
  if (root_a < root_b) {
    parent[root_b] = root_a;
  } else {
    parent[root_a] = root_b;
  }
}

static void part(const baum_mechanism *m, int *parent)
{
  for (int i = 0; i <= m->body_count; i++) {
    parent[i] = i;
  }
}

/* ---- welded to ground ---- */

static void find_welded(const baum_mechanism *m, int *parent, bool *welded)
{
  part(m, parent);
  for (int k = 0; k < m->joint_count; k++) {
    if (baum_i_is_weld(m->joints[k])) {
      unite(parent, m->joints[k]->span.bodies[0], m->joints[k]->span.bodies[1]);
    }
  }
  for (int i = 0; i <= m->body_count; i++) {
    welded[i] = root_of(parent, i) == 0;
  }
}

static int count_kept(const baum_workspace *w, const baum_i_joint *joint)
{
  int kept = 0;
  for (int i = joint->row; i < joint->row + joint->rows; i++) {
    kept += w->redundancy.count > 0 && w->redundancy.omitted[i] ? 0 : 1;
  }
  return kept;
}

/* First body of a joint that is none of some, or -1. */
static int first_outside(const baum_i_joint *joint, const bool *some)
{
  for (int i = 0; i < joint->span.body_count; i++) {
    if (!some[joint->span.bodies[i]]) {
      return joint->span.bodies[i];
    }
  }
  return -1;
}

static bool welds_keep_their_rows(const baum_workspace *w, const bool *welded)
{
  const baum_mechanism *m = w->mechanism;
  int rest = 0;
  for (int i = 1; i <= m->body_count; i++) {
    rest += welded[i] ? m->bodies[i]->nv : 0;
  }
  for (int k = 0; k < m->joint_count; k++) {
    rest -= first_outside(m->joints[k], welded) < 0 ? count_kept(w, m->joints[k]) : 0;
  }
  return rest == 0;
}

/* ---- islands ---- */

/* Unite the bodies of each joint, those of ground left out. */
static void unite_joined(const baum_mechanism *m, const bool *ground, int *parent)
{
  part(m, parent);
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_span *span = &m->joints[k]->span;
    int first = first_outside(m->joints[k], ground);
    for (int i = 0; i < span->body_count && first >= 0; i++) {
      if (!ground[span->bodies[i]]) {
        unite(parent, first, span->bodies[i]);
      }
    }
  }
}

/* parent (body_count + 1) becomes of_body. A parent is a body before its own, and has its number
 * when they ask for it. Returns how many islands there are. */
static int number_bodies(const baum_mechanism *m, const bool *ground, int *parent)
{
  int count = 0;
  for (int i = 0; i <= m->body_count; i++) {
    int before = parent[i];
    if (ground[i]) {
      parent[i] = -1;
    } else {
      parent[i] = before == i ? count++ : parent[before];
    }
  }
  return count;
}

static void count_bodies(const baum_mechanism *m, baum_i_islands *out)
{
  for (int i = 1; i <= m->body_count; i++) {
    if (out->of_body[i] >= 0) {
      baum_i_island *island = &out->island[out->of_body[i]];
      island->bodies++;
      island->velocities += m->bodies[i]->nv;
      island->degrees_of_freedom += m->bodies[i]->nv;
    }
  }
}

static void count_joints(const baum_workspace *w, const bool *ground, baum_i_islands *out)
{
  const baum_mechanism *m = w->mechanism;
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_joint *joint = m->joints[k];
    int first = first_outside(joint, ground);
    out->of_joint[k] = first < 0 ? -1 : out->of_body[first];
    if (first >= 0) {
      baum_i_island *island = &out->island[out->of_body[first]];
      island->joints++;
      island->rows += joint->rows;
      island->degrees_of_freedom -= count_kept(w, joint);
      island->moved |= !joint->type->scleronomic;
    }
  }
}

/* A pose at which the rank is lower than nearby proves nothing. */
static void judge(const baum_workspace *w, baum_i_islands *out)
{
  const baum_mechanism *m = w->mechanism;
  const baum_i_redundancy *r = &w->redundancy;
  bool known = r->rank + r->count == m->nc;
  for (int k = 0; k < out->count; k++) {
    baum_i_island *island = &out->island[k];
    island->degrees_of_freedom = known ? island->degrees_of_freedom : -1;
    island->immobile =
      island->degrees_of_freedom == 0 && !island->moved && r->rank_at_start == r->rank;
  }
  for (int i = 1; i <= m->body_count; i++) {
    int island = out->of_body[i];
    out->immobile[i] = out->immobile[i] || (island >= 0 && out->island[island].immobile);
    out->immobile_count += out->immobile[i] ? 1 : 0;
  }
}

/* ground (body_count + 1), zeroed, is scratch. */
static baum_status find(const baum_workspace *w, bool *ground, baum_i_islands *out)
{
  const baum_mechanism *m = w->mechanism;
  find_welded(m, out->of_body, out->immobile);
  bool leave_out = welds_keep_their_rows(w, out->immobile);
  for (int i = 0; i <= m->body_count; i++) {
    ground[i] = i == 0 || (leave_out && out->immobile[i]);
  }
  unite_joined(m, ground, out->of_body);
  out->count = number_bodies(m, ground, out->of_body);
  out->island = baum_i_alloc((size_t)out->count, sizeof *out->island);
  if (!out->island) {
    return baum_i_fail_memory();
  }
  count_bodies(m, out);
  count_joints(w, ground, out);
  judge(w, out);
  return BAUM_OK;
}

baum_status baum_i_find_islands(const baum_workspace *workspace, baum_i_islands *out)
{
  size_t bodies = (size_t)workspace->mechanism->body_count + 1;
  bool *ground = baum_i_alloc(bodies, sizeof *ground);
  *out = (baum_i_islands){
    .of_body = baum_i_alloc(bodies, sizeof *out->of_body),
    .of_joint = baum_i_alloc((size_t)workspace->mechanism->joint_count, sizeof *out->of_joint),
    .immobile = baum_i_alloc(bodies, sizeof *out->immobile),
  };
  baum_status status = ground && out->of_body && out->of_joint && out->immobile
                         ? find(workspace, ground, out)
                         : baum_i_fail_memory();
  baum_i_free(ground);
  if (status != BAUM_OK) {
    baum_i_islands_clear(out);
  }
  return status;
}

void baum_i_islands_clear(baum_i_islands *islands)
{
  baum_i_free(islands->island);
  baum_i_free(islands->of_body);
  baum_i_free(islands->of_joint);
  baum_i_free(islands->immobile);
  *islands = (baum_i_islands){0};
}
