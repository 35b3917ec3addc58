/* SPDX-License-Identifier: BSD-3-Clause */
#include "dynamics/islands.h"

#include "base/alloc.h"
#include "base/message.h"
#include "base/sets.h"

/* Return the first body that a joint connects and that is not fixed, or -1. */
static int first_free(const baum_mechanism *m, const baum_i_joint *joint)
{
  for (int i = 0; i < joint->span.body_count; i++) {
    if (!m->bodies[joint->span.bodies[i]]->fixed) {
      return joint->span.bodies[i];
    }
  }
  return -1;
}

static void unite_joined(const baum_mechanism *m, int *parent)
{
  baum_i_sets_begin(parent, m->body_count + 1);
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_span *span = &m->joints[k]->span;
    int first = first_free(m, m->joints[k]);
    for (int i = 0; i < span->body_count && first >= 0; i++) {
      if (!m->bodies[span->bodies[i]]->fixed) {
        baum_i_sets_unite(parent, first, span->bodies[i]);
      }
    }
  }
}

baum_status baum_i_number_islands(const baum_mechanism *m, int **island)
{
  *island = baum_i_alloc((size_t)m->body_count + 1, sizeof **island);
  BAUM_I_TRY(baum_i_check_memory(*island));
  unite_joined(m, *island);
  (void)baum_i_sets_number(*island, m->body_count + 1);
  return BAUM_OK;
}

int baum_i_island_of_joint(const baum_mechanism *m, const int *island, const baum_i_joint *joint)
{
  int first = first_free(m, joint);
  return first >= 0 ? island[first] : island[0];
}

static void count_all(const baum_mechanism *m, const int *number, baum_i_island *island)
{
  for (int i = 1; i <= m->body_count; i++) {
    island[number[i]].bodies += m->bodies[i]->fixed ? 0 : 1;
  }
  for (int k = 0; k < m->joint_count; k++) {
    baum_i_island *of = &island[baum_i_island_of_joint(m, number, m->joints[k])];
    of->joints++;
    of->rows += m->joints[k]->rows;
  }
}

baum_status baum_i_count_islands(const baum_mechanism *m, int *count, baum_i_island *largest)
{
  *count = 0;
  *largest = (baum_i_island){0};
  int *number = NULL;
  BAUM_I_TRY(baum_i_number_islands(m, &number));
  size_t bodies = (size_t)m->body_count + 1;
  baum_i_island *island = baum_i_alloc(bodies, sizeof *island);
  if (island) {
    count_all(m, number, island);
  }
  for (size_t i = 1; i < bodies && island; i++) {
    *count += island[i].bodies > 0 ? 1 : 0;
    *largest = island[i].bodies > largest->bodies ? island[i] : *largest;
  }
  baum_status status = baum_i_check_memory(island);
  baum_i_free(number);
  baum_i_free(island);
  return status;
}

baum_status baum_i_count_joints(const baum_mechanism *m, int **joints)
{
  int *count = baum_i_alloc((size_t)m->body_count + 1, sizeof *count);
  *joints = count;
  for (int k = 0; count && k < m->joint_count; k++) {
    const baum_i_span *span = &m->joints[k]->span;
    for (int i = 0; i < span->body_count; i++) {
      count[span->bodies[i]]++;
    }
  }
  return count ? BAUM_OK : baum_i_fail_memory();
}
