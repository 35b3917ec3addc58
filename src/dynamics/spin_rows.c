/* SPDX-License-Identifier: BSD-3-Clause */
/* Adds spin rows (space_block.h) to a block path. Spin rows keep digits that the solver would lose
 * because bodies are thin. They are added only if pivots in the design configuration are weak, and
 * kept only if they make these pivots larger. */
#include <stdlib.h>

#include "base/alloc.h"
#include "base/message.h"
#include "dynamics/block_path.h"

/* A body is slim if its smallest moment of inertia is below this fraction of the trace of its
 * inertia tensor. Only slim bodies have spin rows. */
static const double SLIM = 0.03;
/* A node is suitable if its rows alone determine at least this part of the spin. */
static const double FIRM = 0.5;
/* Spin rows must make the weakest pivot larger by this factor. */
static const double BETTER = 8.0;

static bool is_slim(const baum_i_space_body *body)
{
  const double *s = body->spin;
  double inverse = s[0] * s[0] + s[1] * s[1] + s[2] * s[2]; /* of the smallest moment */
  double trace = body->inertia[0] + body->inertia[5] + body->inertia[10];
  return body->size == 6 && !body->fixed && SLIM * trace * inverse > 1.0;
}

/* A joint whose node is suitable for the spin row of a body. */
typedef struct candidate {
  int body;
  int joint;
  int choices; /* number of candidates for this body */
  double grip;
} candidate;

typedef struct search {
  candidate *list;
  int count;
  int *choices; /* (body_count) */
} search;

/* Adds a joint to the candidates of its slim bodies. */
static void add_candidates(const baum_i_space *space, int node, search *found)
{
  const baum_i_space_node *at = &space->list[node];
  for (int s = at->first_side; s < at->first_side + at->side_count; s++) {
    const baum_i_space_side *side = &space->side_list[s];
    double grip = is_slim(&space->bodies[side->body]) ? baum_i_space_grip(space, node, side) : 0.0;
    if (grip > FIRM) {
      found->list[found->count++] =
        (candidate){.body = side->body, .joint = at->row_block, .grip = grip};
      found->choices[side->body]++;
    }
  }
}

/* Candidates for bodies with few choices come first, then those with the firmest grip. */
static int by_choices(const void *a, const void *b)
{
  const candidate *x = a;
  const candidate *y = b;
  return x->choices != y->choices ? x->choices - y->choices
                                  : (x->grip < y->grip) - (x->grip > y->grip);
}

/* Sets the entry of each chosen joint in spins[] to the number of a body. Returns whether there are
 * such joints. */
static bool choose(const baum_i_block_path *path, search *found, int *spins)
{
  const baum_i_space_joints *joints = &path->space_joints;
  for (int i = 0; i < joints->count; i++) {
    if (baum_i_shape_with_spin(joints->list[i].shape) != BAUM_I_SHAPES) {
      add_candidates(path->space, joints->list[i].node, found);
    }
  }
  for (int i = 0; i < found->count; i++) {
    found->list[i].choices = found->choices[found->list[i].body];
  }
  qsort(found->list, (size_t)found->count, sizeof *found->list, by_choices);
  for (int i = 0; i < found->count; i++) {
    const candidate *c = &found->list[i];
    if (found->choices[c->body] > 0 && spins[c->joint] == 0) {
      spins[c->joint] = c->body;
      found->choices[c->body] = 0;
    }
  }
  return found->count > 0;
}

static bool has_slim_bodies(const baum_i_space *space)
{
  bool found = false;
  for (int t = 1; t < space->body_count && !found; t++) {
    found = is_slim(&space->bodies[t]);
  }
  return found;
}

/* Finds the weakest pivot in the design configuration. */
static baum_status measure(baum_workspace *w, baum_i_block_path *path, double *weakest)
{
  BAUM_I_TRY(baum_i_block_path_factor(w, path, 0.0, w->mechanism->design_q));
  *weakest = path->space->weakest;
  w->eliminated_by = NULL;
  w->jacobian_ready = false;
  path->factorizations = 0;
  return BAUM_OK;
}

/* Replaces the path by a path with the given spin rows if this path has larger pivots. */
static baum_status try_spins(baum_workspace *w, bool for_motion, const int *spins, double weakest,
                             baum_i_block_path **path)
{
  baum_i_block_verdict ignored;
  baum_i_block_path *other = NULL;
  double better = 0.0;
  BAUM_I_TRY(baum_i_block_path_create_with(w, for_motion, spins, &ignored, &other));
  baum_status status = other ? measure(w, other, &better) : BAUM_OK;
  if (status == BAUM_OK && better > BETTER * weakest) {
    baum_i_block_path *old = *path;
    *path = other;
    other = old;
  }
  baum_i_block_path_destroy(other);
  return status;
}

static baum_status add_spin_rows(baum_workspace *w, bool for_motion, baum_i_block_path **path)
{
  const baum_i_space *space = (*path)->space;
  double weakest;
  BAUM_I_TRY(measure(w, *path, &weakest));
  if (weakest >= space->weak_pivot) {
    return BAUM_OK;
  }
  int *spins = baum_i_alloc((size_t)w->mechanism->joint_count, sizeof *spins);
  search found = {.list = baum_i_alloc((size_t)space->side_count, sizeof *found.list),
                  .choices = baum_i_alloc((size_t)space->body_count, sizeof *found.choices)};
  baum_status status = baum_i_check_memory(spins && found.list && found.choices ? spins : NULL);
  if (status == BAUM_OK && choose(*path, &found, spins)) {
    status = try_spins(w, for_motion, spins, weakest, path);
  }
  baum_i_free(spins);
  baum_i_free(found.list);
  baum_i_free(found.choices);
  return status;
}

/* If a user function fails in the design configuration, the path stays as it is. */
baum_status baum_i_add_spin_rows(baum_workspace *w, bool for_motion, baum_i_block_path **path)
{
  if (!has_slim_bodies((*path)->space)) {
    return BAUM_OK;
  }
  const baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = add_spin_rows(w, for_motion, path);
  return status == BAUM_ERR_MEMORY ? status : baum_i_message_settle(BAUM_OK, &kept);
}
