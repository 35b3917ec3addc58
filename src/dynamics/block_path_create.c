/* SPDX-License-Identifier: BSD-3-Clause */
/* Creates the block paths of a workspace; see block_path.h. */
#include "dynamics/block_path.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/hot.h"
#include "base/message.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/spatial/spatial_joint.h"

/* In planar chains rounding errors grow even without small pivots, at worst in proportion to the
 * number of nodes. Up to FEW_NODES nodes the error stays below 5e-13. With more nodes every
 * evaluation checks the residual. This is not necessary in space, where chains of 1e3 and of 1e4
 * links have the same errors (test_spatial_accuracy.c). */
enum { FEW_NODES = 2048 };

/* The residual is checked if inverse masses differ by more than this factor and digits have
 * cancelled (block_path.c). */
static const double UNEVEN = 1e3;
/* In space, each accepted pivot is larger than the limit of a weak pivot, so more uneven masses
 * lose no further digits: with 1e4 instead of 1e3, the errors of 2000 random mechanisms
 * (bench_random_spatial) stay the same. */
static const double UNEVEN_IN_SPACE = 1e4;

/* ---- create ---- */

static bool is_diagonal(const baum_i_body *body)
{
  return body->type->frame == BAUM_I_FRAME_BODY || body->type->frame == BAUM_I_FRAME_PARTICLE;
}

/* Tell whether the solver for space (space_block.h) can be used: at least one body is spatial, and
 * no body consists of user coordinates. */
static bool is_in_space(const baum_mechanism *m)
{
  bool found = false;
  bool known = true;
  for (int i = 1; i <= m->body_count; i++) {
    baum_i_frame_kind kind = m->bodies[i]->type->frame;
    found = found || baum_i_is_spatial(kind);
    known = known && kind != BAUM_I_FRAME_NONE;
  }
  return found && known;
}

static baum_i_space_kind kind_of(const baum_i_body *body)
{
  switch (body->type->frame) {
  case BAUM_I_FRAME_BODY: return BAUM_I_SPACE_PLANAR_BODY;
  case BAUM_I_FRAME_PARTICLE: return BAUM_I_SPACE_PLANAR_PARTICLE;
  case BAUM_I_FRAME_SPATIAL_PARTICLE: return BAUM_I_SPACE_PARTICLE;
  case BAUM_I_FRAME_NONE:
  case BAUM_I_FRAME_GROUND:
  case BAUM_I_FRAME_SPATIAL_BODY:
  default: return BAUM_I_SPACE_BODY;
  }
}

/* Tell whether the omitted rows of a joint may become rows of zeros, so that space_joints_hot.c can
 * evaluate the joint. This is not possible if the joint has no shape of space_joints.h, if an
 * omitted row makes points coincide, or if all rows are omitted. */
static bool stays_whole(const baum_i_joint *joint, const unsigned char *omitted)
{
  baum_i_space_shape shape = baum_i_shape_of(joint);
  int coincide = shape == BAUM_I_SHAPE_PIN ? 2 : shape <= BAUM_I_SHAPE_PDED ? 3 : 0;
  int left = 0;
  bool met = true;
  for (int i = 0; i < joint->rows; i++) {
    left += omitted[i] ? 0 : 1;
    met = met && !(omitted[i] && i < coincide);
  }
  return shape != BAUM_I_SHAPES && left > 0 && met;
}

/* If the first three rows of a joint, or both rows of a planar revolute joint, make points coincide
 * and all other rows compare directions, return the number of the body whose E (space_block.h) is
 * -I. Otherwise return -1. */
static int pinned_body(const baum_i_joint *joint)
{
  if (joint->type->is_pin) {
    return joint->span.bodies[1];
  }
  const baum_i_spatial_row *rows = baum_i_spatial_rows_of(joint);
  bool pinned = rows && rows[0].x == BAUM_I_X_GROUND;
  for (int i = 3; pinned && i < joint->rows; i++) {
    pinned = rows[i].y != BAUM_I_APART;
  }
  return pinned ? joint->span.bodies[0] : -1;
}

/* Tell whether the multiplier of a row of a joint is a moment. All multipliers of couplings and of
 * user constraints count as forces. */
static bool is_moment(const baum_mechanism *m, const baum_i_joint *joint, int row)
{
  const baum_i_spatial_row *rows = baum_i_spatial_rows_of(joint);
  if (joint->type->driven) {
    const baum_i_joint_coordinate c = joint->type->driven(m, joint->element.def);
    return baum_i_is_angle(&c);
  }
  return rows && rows[row].y != BAUM_I_APART;
}

/* Properties of bodies, joints and rows that the solver needs. */
typedef struct traits {
  baum_i_block_pin *pins;
  int *pinned;
  unsigned char *whole;
  unsigned char *kinds;
  unsigned char *diagonal;
  unsigned char *fixed;
  unsigned char *omitted;
  unsigned char *moments;
} traits;

static void find_moments(const baum_mechanism *m, unsigned char *moments)
{
  for (int i = 0; i < m->joint_count; i++) {
    const baum_i_joint *joint = m->joints[i];
    for (int k = 0; k < joint->rows; k++) {
      moments[joint->row + k] = is_moment(m, joint, k) ? 1 : 0;
    }
  }
}

static void find_traits(const baum_workspace *w, bool for_motion, traits *out)
{
  const baum_mechanism *m = w->mechanism;
  for (int i = 0; i < m->body_count; i++) {
    out->diagonal[i] = is_diagonal(m->bodies[i + 1]) ? 1 : 0;
    out->kinds[i] = (unsigned char)kind_of(m->bodies[i + 1]);
    out->fixed[i] = for_motion && m->bodies[i + 1]->fixed ? 1 : 0;
  }
  for (int i = 0; i < m->joint_count; i++) {
    const baum_i_joint *joint = m->joints[i];
    out->pinned[i] = pinned_body(joint);
    if (joint->type->is_pin) {
      out->pins[i] = (baum_i_block_pin){
        .is_pin = true, .body_a = joint->span.bodies[0] - 1, .body_b = joint->span.bodies[1] - 1};
    }
    for (int k = joint->row; k < joint->row + joint->rows; k++) {
      bool redundant = w->rows.omitted[k];
      out->omitted[k] = redundant || (for_motion && joint->fixed) ? 1 : 0;
    }
    out->whole[i] = stays_whole(joint, out->omitted + joint->row) ? 1 : 0;
  }
}

static baum_status make_solver(const baum_workspace *w, const traits *t, const int *spins, int *hub,
                               baum_i_block_path *path)
{
  if (is_in_space(w->mechanism)) {
    const baum_i_space_layout layout = {.structure = &w->structure,
                                        .kinds = t->kinds,
                                        .pinned = t->pinned,
                                        .whole = t->whole,
                                        .omitted = t->omitted,
                                        .fixed = t->fixed,
                                        .moments = t->moments,
                                        .length = w->mechanism->length,
                                        .spins = spins};
    return baum_i_space_create(&layout, hub, &path->space);
  }
  const baum_i_block_layout layout = {.structure = &w->structure,
                                      .pins = t->pins,
                                      .diagonal = t->diagonal,
                                      .omitted = t->omitted,
                                      .fixed = t->fixed};
  return baum_i_block_create(&layout, hub, &path->block);
}

static baum_status make_block(const baum_workspace *w, bool for_motion, const int *spins,
                              baum_i_block_verdict *verdict, baum_i_block_path *path)
{
  const baum_mechanism *m = w->mechanism;
  traits t = {.pins = baum_i_alloc((size_t)m->joint_count, sizeof *t.pins),
              .pinned = baum_i_alloc((size_t)m->joint_count, sizeof *t.pinned),
              .whole = baum_i_alloc((size_t)m->joint_count, 1),
              .kinds = baum_i_alloc((size_t)m->body_count, 1),
              .diagonal = baum_i_alloc((size_t)m->body_count, 1),
              .fixed = baum_i_alloc((size_t)m->body_count, 1),
              .omitted = baum_i_alloc((size_t)m->nc, 1),
              .moments = baum_i_alloc((size_t)m->nc, 1)};
  baum_status status = BAUM_ERR_MEMORY;
  if (t.pins && t.pinned && t.whole && t.kinds && t.diagonal && t.fixed && t.omitted && t.moments) {
    int hub = -1;
    find_traits(w, for_motion, &t);
    find_moments(m, t.moments);
    status = make_solver(w, &t, spins, &hub, path);
    verdict->blocks = hub < 0 ? BAUM_I_BLOCKS_FILLED : BAUM_I_BLOCKS_CROWDED;
    verdict->body = hub + 1;
  }
  baum_i_free(t.pins);
  baum_i_free(t.pinned);
  baum_i_free(t.whole);
  baum_i_free(t.kinds);
  baum_i_free(t.diagonal);
  baum_i_free(t.fixed);
  baum_i_free(t.omitted);
  baum_i_free(t.moments);
  return status;
}

/* Mark the joints that hot files (block_path.h) evaluate, and store the data of these joints in the
 * solver's order. */
static baum_status place_points(const baum_workspace *w, baum_i_block_path *path,
                                unsigned char *is_done)
{
  const baum_i_block *block = path->block;
  if (path->space) {
    return baum_i_space_joints_find(w, path->space, is_done, &path->space_joints);
  }
  size_t count = baum_i_even((size_t)block->pin_count);
  path->points = baum_i_alloc(4 * count, sizeof *path->points);
  if (!path->points) {
    return BAUM_ERR_MEMORY;
  }
  for (size_t i = 0; i < count; i++) {
    int joint = baum_i_row_joint(w->mechanism, block->pins[i].row);
    is_done[joint] = 1;
    const double *points = w->point.parameters + w->mechanism->joints[joint]->element.parameter;
    memcpy(path->points + 4 * i, points, 4 * sizeof *points);
  }
  return BAUM_OK;
}

/* Copy the groups of the mechanism without the joints that are marked as done. */
static baum_status make_groups(const baum_mechanism *m, const unsigned char *is_done,
                               baum_i_block_path *path)
{
  path->groups = baum_i_alloc((size_t)m->joint_count, sizeof *path->groups);
  path->joints = baum_i_alloc((size_t)m->joint_count, sizeof(baum_i_joint *));
  if (!path->groups || !path->joints) {
    return BAUM_ERR_MEMORY;
  }
  const baum_i_joint **next = path->joints;
  for (const baum_i_joint_group *all = m->joint_groups; all->type; all++) {
    baum_i_joint_group *group = &path->groups[path->group_count];
    *group = (baum_i_joint_group){.type = all->type, .joints = next};
    for (int i = 0; i < all->count; i++) {
      if (!is_done[all->joints[i]->element.index - 1]) {
        next[group->count++] = all->joints[i];
      }
    }
    next += group->count;
    path->group_count += group->count > 0 ? 1 : 0;
  }
  return BAUM_OK;
}

/* List the omitted rows, first those of joints that no hot file evaluates. */
static baum_status list_omitted_rows(const baum_workspace *w, const unsigned char *is_done,
                                     baum_i_block_path *path)
{
  path->omitted = baum_i_alloc((size_t)w->mechanism->nc, sizeof *path->omitted);
  if (!path->omitted) {
    return BAUM_ERR_MEMORY;
  }
  for (int done = 0; done < 2; done++) {
    for (int i = 0; i < w->mechanism->nc && w->rows.count > 0; i++) {
      int number = baum_i_row_joint(w->mechanism, i);
      if (w->rows.omitted[i] && is_done[number] == done) {
        const baum_i_joint *joint = w->mechanism->joints[number];
        int nl = joint->span.nl;
        path->omitted[path->omitted_count++] =
          (baum_i_omitted_row){i, joint->jacobian + (i - joint->row) * nl, nl, joint->span.columns};
        path->rated_count += 1 - done;
      }
    }
  }
  return BAUM_OK;
}

static baum_status arrange_joints(const baum_workspace *w, bool for_motion, baum_i_block_path *path)
{
  const baum_mechanism *m = w->mechanism;
  unsigned char *is_done = baum_i_alloc((size_t)m->joint_count, 1);
  baum_status status = is_done ? place_points(w, path, is_done) : BAUM_ERR_MEMORY;
  if (status == BAUM_OK) {
    status = list_omitted_rows(w, is_done, path);
  }
  for (int k = 0; k < m->joint_count && status == BAUM_OK; k++) {
    is_done[k] |= for_motion && m->joints[k]->fixed ? 1 : 0;
  }
  if (status == BAUM_OK) {
    status = make_groups(m, is_done, path);
  }
  baum_i_free(is_done);
  return status;
}

static baum_status prepare_forces(baum_workspace *w, baum_i_block_path *path)
{
  const baum_mechanism *m = w->mechanism;
  path->constant_force = baum_i_alloc((size_t)m->nv, sizeof *path->constant_force);
  if (!path->constant_force) {
    return BAUM_ERR_MEMORY;
  }
  path->force_is_constant = baum_i_has_constant_force(m);
  BAUM_I_TRY(baum_i_mechanism_add_body_forces(&w->point, true, path->constant_force));
  if (path->force_is_constant) {
    memcpy(w->force, path->constant_force, (size_t)m->nv * sizeof *w->force);
    if (path->space) {
      path->space_sides->set_force(path->space, w->force);
    } else {
      path->sides_kernel->set_force(path->block, w->force);
    }
  }
  return BAUM_OK;
}

/* Return the number (from 1) of the first body whose M has no factorization L L^T, or 0 if there is
 * no such body. */
static int find_massless(const baum_workspace *w, const baum_i_block *block)
{
  for (int i = 0; i < block->dense_count; i++) {
    const baum_i_dense_body *dense = &block->dense[i];
    int n = w->structure.mass_blocks[dense->mass_block].size;
    for (int k = 0; k < n; k++) {
      if (!(block->factor[dense->factor + k * n + k] > 0.0)) {
        return dense->mass_block + 1;
      }
    }
  }
  return 0;
}

/* Invert constant masses. Returns BAUM_ERR_SINGULAR if M is not positive definite. */
static baum_status prepare_masses(baum_workspace *w, baum_i_block_verdict *verdict,
                                  baum_i_block_path *path)
{
  path->mass_is_constant = w->mechanism->constant_mass;
  baum_i_point_set(&w->point, 0.0, w->mechanism->design_q, NULL);
  BAUM_I_TRY(baum_i_evaluate_mass(w));
  if (path->space) {
    int body = baum_i_space_set_mass(path->space, w->mass);
    *verdict = (baum_i_block_verdict){BAUM_I_BLOCKS_MASSLESS, body + 1};
    return body < 0 ? BAUM_OK : BAUM_ERR_SINGULAR;
  }
  bool positive = baum_i_block_set_mass(path->block, w->mass);
  if (path->mass_is_constant) {
    positive = positive && baum_i_block_factor_dense(path->block, w->mass);
  }
  verdict->blocks = BAUM_I_BLOCKS_MASSLESS;
  verdict->body = find_massless(w, path->block);
  return positive ? BAUM_OK : BAUM_ERR_SINGULAR;
}

/* The smallest positive number and the largest number of all numbers given to include(). */
typedef struct range {
  double least;
  double most;
} range;

static void include(range *r, double x)
{
  r->least = x > 0.0 && x < r->least ? x : r->least;
  r->most = x > r->most ? x : r->most;
}

/* Do what is_uneven() does, for the solver for space. This function compares the inverse masses and
 * inertias of all bodies, even if no joint connects them. */
static bool is_uneven_in_space(const baum_i_space *b)
{
  range moves = {.least = (double)INFINITY};
  range turns = {.least = (double)INFINITY};
  for (int i = 1; i < b->body_count; i++) {
    include(&moves, b->bodies[i].weight[0]);
    for (int c = 0; c < 12; c += 5) {
      include(&turns, b->bodies[i].whiten[c] * b->bodies[i].whiten[c]);
    }
  }
  return moves.most > UNEVEN_IN_SPACE * moves.least || turns.most > UNEVEN_IN_SPACE * turns.least;
}

/* Tell whether joints may connect a light body to a heavy one. For both bodies of every pin, the
 * function compares the inverse masses w_0 + w_2 |p|^2, where w_0 is the inverse mass of the body,
 * w_2 its inverse inertia, and p the point of the pin. It also compares the inverse masses and
 * inertias of all bodies that other joints connect. It returns true for every mechanism that has
 * bodies with user coordinates. */
static bool is_uneven(const baum_i_block_path *path)
{
  const baum_i_block *b = path->block;
  range moves = {.least = (double)INFINITY};
  range turns = {.least = (double)INFINITY};
  for (int i = 0; i < 2 * b->pin_count; i++) {
    const double *w = b->weight + 2 * (size_t)b->pins[i / 2].body_block[i % 2];
    const double *p = path->points + 2 * (size_t)i;
    include(&moves, w[0] + w[1] * (p[0] * p[0] + p[1] * p[1]));
  }
  for (int i = 0; i < b->full_count; i++) {
    const baum_i_full_node *full = &b->fulls[i];
    for (int k = full->first_side; full->side_count > 1 && k < full->first_side + full->side_count;
         k++) {
      include(&moves, b->weight[2 * (size_t)b->side_body_block[k]]);
      include(&turns, b->weight[2 * (size_t)b->side_body_block[k] + 1]);
    }
  }
  return b->dense_count > 0 || moves.most > UNEVEN * moves.least ||
         turns.most > UNEVEN * turns.least;
}

static bool has_planar_bodies(const baum_mechanism *m)
{
  bool found = false;
  for (int i = 1; i <= m->body_count; i++) {
    found = found || !baum_i_is_spatial(m->bodies[i]->type->frame);
  }
  return found;
}

static baum_status fill(baum_workspace *w, bool for_motion, const int *spins,
                        baum_i_block_verdict *verdict, baum_i_block_path *path)
{
  BAUM_I_TRY(make_block(w, for_motion, spins, verdict, path));
  BAUM_I_TRY(arrange_joints(w, for_motion, path));
  BAUM_I_TRY(prepare_masses(w, verdict, path));
  if (path->space) {
    path->has_planar = has_planar_bodies(w->mechanism);
    path->only_hot = path->group_count == 0 && path->space_joints.count == path->space->node_count;
    path->only_weights = !path->has_planar && w->mechanism->force_count == 0;
    BAUM_I_TRY(baum_i_space_joints_set(w, path->space, &path->space_joints));
  }
  BAUM_I_TRY(prepare_forces(w, path));
  path->uneven = path->space ? is_uneven_in_space(path->space) : is_uneven(path);
  path->always_check = !path->space && baum_i_block_path_size(path).nodes > FEW_NODES;
  return BAUM_OK;
}

baum_status baum_i_block_path_create_with(baum_workspace *w, bool for_motion, const int *spins,
                                          baum_i_block_verdict *verdict, baum_i_block_path **out)
{
  *out = NULL;
  baum_i_block_path *path = baum_i_alloc(1, sizeof *path);
  BAUM_I_TRY(baum_i_check_memory(path));
  path->space_kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_space_kernel);
  path->refine_kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_space_refine_kernel);
  path->space_sides = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_space_sides_kernel);
  path->factor_kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_space_factor_kernel);
  path->residual_kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_space_residual_kernel);
  path->bodies_kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_space_bodies_kernel);
  path->joints_kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_space_joints_kernel);
  path->kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_block_kernel);
  path->sides_kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_block_sides_kernel);
  path->pins_kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_pins_kernel);
  path->fixed_count = for_motion ? w->mechanism->fixed_count : 0;
  baum_status status = fill(w, for_motion, spins, verdict, path);
  if (status != BAUM_OK) {
    baum_i_block_path_destroy(path);
    if (status == BAUM_ERR_MEMORY) {
      return baum_i_fail_memory();
    }
    return status == BAUM_ERR_SINGULAR ? BAUM_OK : status;
  }
  *verdict = (baum_i_block_verdict){0};
  *out = path;
  return BAUM_OK;
}

baum_status baum_i_block_path_create(baum_workspace *w, bool for_motion,
                                     baum_i_block_verdict *verdict, baum_i_block_path **out)
{
  BAUM_I_TRY(baum_i_block_path_create_with(w, for_motion, NULL, verdict, out));
  baum_status status = *out && (*out)->space ? baum_i_add_spin_rows(w, for_motion, out) : BAUM_OK;
  if (status != BAUM_OK) {
    baum_i_block_path_destroy(*out);
    *out = NULL;
  }
  return status;
}

void baum_i_block_path_destroy(baum_i_block_path *path)
{
  if (!path) {
    return;
  }
  baum_i_block_destroy(path->block);
  baum_i_space_destroy(path->space);
  baum_i_space_joints_clear(&path->space_joints);
  baum_i_free(path->points);
  baum_i_free(path->groups);
  baum_i_free(path->joints);
  baum_i_free(path->omitted);
  baum_i_free(path->constant_force);
  baum_i_free(path);
}

baum_status baum_i_paths_create(baum_workspace *w, baum_i_block_verdict *verdict, baum_i_paths *out)
{
  *out = (baum_i_paths){0};
  baum_status status = baum_i_block_path_create(w, false, verdict, &out->all);
  out->motion = out->all;
  if (status == BAUM_OK && w->mechanism->fixed_count > 0) {
    baum_i_block_verdict of_motion;
    status = baum_i_block_path_create(w, true, &of_motion, &out->motion);
  }
  if (status != BAUM_OK) {
    baum_i_block_path_destroy(out->all);
    *out = (baum_i_paths){0};
  }
  return status;
}

void baum_i_paths_destroy(const baum_i_paths *paths)
{
  baum_i_block_path_destroy(paths->all);
  if (paths->motion != paths->all) {
    baum_i_block_path_destroy(paths->motion);
  }
}

/* ---- size ---- */

baum_i_block_size baum_i_block_path_size(const baum_i_block_path *path)
{
  const baum_i_elimination *order = path->space ? &path->space->order : &path->block->order;
  baum_i_block_size size = {
    .nodes = order->count,
    .couplings = order->start[order->count],
    .fill = path->space ? path->space->zero_count : path->block->zero_count,
  };
  for (int k = 0; k < order->count; k++) {
    int later = order->start[k + 1] - order->start[k];
    size.most_couplings = later > size.most_couplings ? later : size.most_couplings;
  }
  return size;
}
