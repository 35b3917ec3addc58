/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations by blocks; see block_path.h. */
#include "dynamics/block_path.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/hot.h"
#include "base/message.h"

/* In chains rounding errors grow even without small pivots, at worst in proportion to the number of
 * nodes. Up to FEW_NODES nodes the error stays below 5e-13. With more nodes every evaluation checks
 * the residual. */
enum { FEW_NODES = 2048, MOST_REFINEMENTS = 3 };

/* Relative change of the multipliers by a refinement. Below SETTLED it has converged; up to
 * SETTLING the result is still acceptable. */
static const double SETTLED = 0x1p-48;
static const double SETTLING = 1e-9;

/* The residual is checked if inverse masses differ by more than the factor UNEVEN and the largest
 * a0 exceeds the largest a by more than the factor CANCELLED, because then digits have cancelled in
 * a = a0 - W J^T lambda (W: inverse masses; a0: accelerations without constraint forces). */
static const double UNEVEN = 1e3;
static const double CANCELLED = 2048.0;

/* ---- create ---- */

static bool is_diagonal(const baum_i_body *body)
{
  return body->type->frame == BAUM_I_FRAME_BODY || body->type->frame == BAUM_I_FRAME_PARTICLE;
}

/* Properties of bodies, joints and rows that the solver needs. */
typedef struct traits {
  baum_i_block_pin *pins;
  unsigned char *diagonal;
  unsigned char *fixed;
  unsigned char *omitted;
} traits;

static void find_traits(const baum_workspace *w, bool for_motion, traits *out)
{
  const baum_mechanism *m = w->mechanism;
  for (int i = 0; i < m->body_count; i++) {
    out->diagonal[i] = is_diagonal(m->bodies[i + 1]) ? 1 : 0;
    out->fixed[i] = for_motion && m->bodies[i + 1]->fixed ? 1 : 0;
  }
  for (int i = 0; i < m->joint_count; i++) {
    const baum_i_joint *joint = m->joints[i];
    if (joint->type->is_pin) {
      out->pins[i] = (baum_i_block_pin){
        .is_pin = true, .body_a = joint->span.bodies[0] - 1, .body_b = joint->span.bodies[1] - 1};
    }
    for (int k = joint->row; k < joint->row + joint->rows; k++) {
      bool redundant = w->rows.omitted[k];
      out->omitted[k] = redundant || (for_motion && joint->fixed) ? 1 : 0;
    }
  }
}

static baum_status make_block(const baum_workspace *w, bool for_motion,
                              baum_i_block_verdict *verdict, baum_i_block_path *path)
{
  const baum_mechanism *m = w->mechanism;
  traits t = {.pins = baum_i_alloc((size_t)m->joint_count, sizeof *t.pins),
              .diagonal = baum_i_alloc((size_t)m->body_count, 1),
              .fixed = baum_i_alloc((size_t)m->body_count, 1),
              .omitted = baum_i_alloc((size_t)m->nc, 1)};
  baum_status status = BAUM_ERR_MEMORY;
  if (t.pins && t.diagonal && t.fixed && t.omitted) {
    find_traits(w, for_motion, &t);
    const baum_i_block_layout layout = {.structure = &w->structure,
                                        .pins = t.pins,
                                        .diagonal = t.diagonal,
                                        .omitted = t.omitted,
                                        .fixed = t.fixed};
    int hub = -1;
    status = baum_i_block_create(&layout, &hub, &path->block);
    verdict->blocks = hub < 0 ? BAUM_I_BLOCKS_FILLED : BAUM_I_BLOCKS_CROWDED;
    verdict->body = hub + 1;
  }
  baum_i_free(t.pins);
  baum_i_free(t.diagonal);
  baum_i_free(t.fixed);
  baum_i_free(t.omitted);
  return status;
}

/* Copy the points of pins in the solver's order, and mark their joints as done. */
static baum_status place_points(const baum_workspace *w, baum_i_block_path *path,
                                unsigned char *is_done)
{
  const baum_i_block *block = path->block;
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

static baum_status arrange_joints(const baum_workspace *w, bool for_motion, baum_i_block_path *path)
{
  const baum_mechanism *m = w->mechanism;
  unsigned char *is_done = baum_i_alloc((size_t)m->joint_count, 1);
  baum_status status = is_done ? place_points(w, path, is_done) : BAUM_ERR_MEMORY;
  for (int k = 0; k < m->joint_count && status == BAUM_OK; k++) {
    is_done[k] |= for_motion && m->joints[k]->fixed ? 1 : 0;
  }
  if (status == BAUM_OK) {
    status = make_groups(m, is_done, path);
  }
  baum_i_free(is_done);
  return status;
}

static baum_status list_omitted_rows(const baum_workspace *w, baum_i_block_path *path)
{
  path->omitted = baum_i_alloc((size_t)w->mechanism->nc, sizeof *path->omitted);
  if (!path->omitted) {
    return BAUM_ERR_MEMORY;
  }
  for (int i = 0; i < w->mechanism->nc && w->rows.count > 0; i++) {
    if (w->rows.omitted[i]) {
      const baum_i_joint *joint = w->mechanism->joints[baum_i_row_joint(w->mechanism, i)];
      int nl = joint->span.nl;
      path->omitted[path->omitted_count++] =
        (baum_i_omitted_row){i, joint->jacobian + (i - joint->row) * nl, nl, joint->span.columns};
    }
  }
  return BAUM_OK;
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
    path->sides_kernel->set_force(path->block, w->force);
  }
  return BAUM_OK;
}

/* Find the number, from 1, of the first body whose M has no factorization L L^T, or 0. */
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
  bool positive = baum_i_block_set_mass(path->block, w->mass);
  if (path->mass_is_constant) {
    positive = positive && baum_i_block_factor_dense(path->block, w->mass);
  }
  verdict->blocks = BAUM_I_BLOCKS_MASSLESS;
  verdict->body = find_massless(w, path->block);
  return positive ? BAUM_OK : BAUM_ERR_SINGULAR;
}

/* The smallest positive number and the largest number that were included. */
typedef struct range {
  double least;
  double most;
} range;

static void include(range *r, double x)
{
  r->least = x > 0.0 && x < r->least ? x : r->least;
  r->most = x > r->most ? x : r->most;
}

/* Tell whether joints may connect a light body to a heavy one. The function compares the inverse
 * masses w_0 + w_2 |p|^2 at both sides of all pins, and the inverse inertias of all bodies that
 * other joints connect. It returns true for every mechanism with dense bodies. */
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

static baum_status fill(baum_workspace *w, bool for_motion, baum_i_block_verdict *verdict,
                        baum_i_block_path *path)
{
  BAUM_I_TRY(make_block(w, for_motion, verdict, path));
  BAUM_I_TRY(arrange_joints(w, for_motion, path));
  BAUM_I_TRY(list_omitted_rows(w, path));
  BAUM_I_TRY(prepare_masses(w, verdict, path));
  BAUM_I_TRY(prepare_forces(w, path));
  path->uneven = is_uneven(path);
  path->always_check = path->block->node_count > FEW_NODES;
  return BAUM_OK;
}

baum_status baum_i_block_path_create(baum_workspace *w, bool for_motion,
                                     baum_i_block_verdict *verdict, baum_i_block_path **out)
{
  *out = NULL;
  baum_i_block_path *path = baum_i_alloc(1, sizeof *path);
  BAUM_I_TRY(baum_i_check_memory(path));
  path->kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_block_kernel);
  path->sides_kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_block_sides_kernel);
  path->pins_kernel = BAUM_I_HOT_TABLE(w->mechanism->wide, baum_i_pins_kernel);
  path->fixed_count = for_motion ? w->mechanism->fixed_count : 0;
  baum_status status = fill(w, for_motion, verdict, path);
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

void baum_i_block_path_destroy(baum_i_block_path *path)
{
  if (!path) {
    return;
  }
  baum_i_block_destroy(path->block);
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

/* ---- solve ---- */

/* If `bending` is 0, set gamma to zero, because its old values may be infinite. */
static baum_status evaluate_joints(baum_workspace *w, const baum_i_block_path *path, bool bending)
{
  const baum_i_rows rows = {
    .phi = w->phi, .jacobian = w->jacobian, .nu = w->nu, .gamma = bending ? w->gamma : NULL};
  if (!bending) {
    memset(w->gamma, 0, (size_t)w->mechanism->nc * sizeof *w->gamma);
  }
  for (int k = 0; k < path->group_count; k++) {
    BAUM_I_TRY(path->groups[k].type->evaluate(&path->groups[k], &w->point, &rows));
  }
  return BAUM_OK;
}

static baum_status evaluate_forces(baum_workspace *w, const baum_i_block_path *path, bool wanted)
{
  baum_i_block_use_force(path->block, wanted);
  if (path->force_is_constant || !wanted) {
    return BAUM_OK;
  }
  memcpy(w->force, path->constant_force, (size_t)w->mechanism->nv * sizeof *w->force);
  BAUM_I_TRY(baum_i_mechanism_add_varying_forces(&w->point, w->force));
  path->sides_kernel->set_force(path->block, w->force);
  return BAUM_OK;
}

static baum_status evaluate_masses(baum_workspace *w, const baum_i_block_path *path)
{
  if (path->mass_is_constant) {
    return BAUM_OK;
  }
  BAUM_I_TRY(baum_i_evaluate_mass(w));
  return baum_i_block_factor_dense(path->block, w->mass) ? BAUM_OK : BAUM_ERR_SINGULAR;
}

/* Phi' = J v - nu (3) of the omitted rows. */
static void set_omitted_rates(baum_workspace *w, const baum_i_block_path *path, const double *v)
{
  for (int i = 0; v && i < path->omitted_count; i++) {
    const baum_i_omitted_row *omitted = &path->omitted[i];
    double rate = -w->nu[omitted->row];
    for (int c = 0; c < omitted->count; c++) {
      rate += w->jacobian[omitted->value + c] * v[omitted->columns[c]];
    }
    w->phi_rate[omitted->row] = rate;
  }
}

static void add_row_gain(const baum_workspace *w, baum_i_block *block,
                         const baum_i_right_side *right, int node, int slot, int row)
{
  if (row < 0) {
    return;
  }
  double f = right->row_gains[row];
  double more =
    (f - 1.0) * right->damping * w->phi_rate[row] + (f * f - 1.0) * right->stiffness * w->phi[row];
  block->right[2 * (size_t)node + (size_t)slot] -= more;
  block->nodes[node].lambda[slot] += more; /* J a0 - r */
}

/* Apply the gains of single rows to nodes that were set with equal gains for all rows. */
static void add_row_gains(const baum_workspace *w, baum_i_block *block,
                          const baum_i_right_side *right)
{
  for (int i = 0; i < block->pin_count; i++) {
    const baum_i_pin_node *pin = &block->pins[i];
    add_row_gain(w, block, right, pin->node, 0, pin->row);
    add_row_gain(w, block, right, pin->node, 1, pin->row + 1);
  }
  for (int i = 0; i < block->full_count; i++) {
    const baum_i_full_node *full = &block->fulls[i];
    add_row_gain(w, block, right, full->node, 0, full->row[0]);
    add_row_gain(w, block, right, full->node, 1, full->row[1]);
  }
}

static void set_nodes(baum_workspace *w, const baum_i_block_path *path, const double *v,
                      const baum_i_right_side *right)
{
  const baum_i_pins pins = {.points = path->points,
                            .frames = w->point.frames,
                            .bending = right->bending,
                            .damping = right->damping,
                            .stiffness = right->stiffness,
                            .phi = w->phi,
                            .phi_rate = w->phi_rate,
                            .gamma = w->gamma};
  const baum_i_block_rows rows = {.jacobian = w->jacobian,
                                  .v = v,
                                  .phi = w->phi,
                                  .nu = w->nu,
                                  .gamma = w->gamma,
                                  .bending = right->bending,
                                  .damping = right->damping,
                                  .stiffness = right->stiffness,
                                  .phi_rate = w->phi_rate};
  path->pins_kernel->set(path->block, &pins);
  path->sides_kernel->set(path->block, &rows);
  set_omitted_rates(w, path, v);
}

/* Refine the solution. Unless pivots are bad, every refinement gains at least six digits. Close to
 * a singular configuration the multipliers may be wrong although the residual of J a is small.
 * Therefore solutions with weak pivots are always refined, and those with good pivots only if the
 * residual is large. */
static baum_status refine(baum_i_block_path *path, baum_i_pivots pivots)
{
  bool done = path->kernel->check(path->block) && pivots == BAUM_I_PIVOTS_GOOD;
  double change = 0.0;
  for (int k = 0; k < MOST_REFINEMENTS && !done; k++) {
    path->refinements++;
    baum_i_block_find_residual(path->block);
    change = path->kernel->correct(path->block);
    done = path->kernel->check(path->block) || change <= SETTLED;
  }
  return done || change <= SETTLING ? BAUM_OK : BAUM_ERR_SINGULAR;
}

/* Tell whether a is small compared with a0. */
static bool has_cancelled(const baum_i_block *block)
{
  double before = 0.0;
  double after = 0.0;
  for (int i = 0; i < block->motion_size; i++) {
    double a0 = fabs(block->from[i]);
    double a = fabs(block->motion[i]);
    before = a0 > before ? a0 : before;
    after = a > after ? a : after;
  }
  return before > CANCELLED * after;
}

static baum_i_pivots factor(baum_workspace *w, baum_i_block_path *path)
{
  path->kernel->couple(path->block);
  path->factorizations++;
  w->eliminated_by = path;
  return path->kernel->eliminate(path->block);
}

/* `last` means that no later solution corrects this one, so the residual must be checked. */
static baum_status solve(baum_workspace *w, baum_i_block_path *path, bool last)
{
  const baum_i_block_kernel *kernel = path->kernel;
  baum_i_block *block = path->block;
  baum_i_pivots pivots = factor(w, path);
  if (pivots == BAUM_I_PIVOTS_BAD) {
    return BAUM_ERR_SINGULAR;
  }
  kernel->substitute(block, w->lambda);
  bool check = last || pivots != BAUM_I_PIVOTS_GOOD || path->always_check ||
               (path->uneven && has_cancelled(block));
  if (!check) {
    return BAUM_OK;
  }
  baum_status status = refine(path, pivots);
  kernel->read_lambda(block, w->lambda);
  return status;
}

/* Evaluate joints, masses and forces at a state, and write them to the block. */
static baum_status set_state(baum_workspace *w, const baum_i_block_path *path, double t,
                             const double *q, const double *v, const baum_i_right_side *right)
{
  baum_i_point_set(&w->point, t, q, v);
  w->eliminated_by = NULL;
  w->jacobian_ready = false; /* if a function fails, J is partly overwritten */
  BAUM_I_TRY(evaluate_joints(w, path, right->bending != 0.0));
  BAUM_I_TRY(evaluate_masses(w, path));
  BAUM_I_TRY(evaluate_forces(w, path, right->force));
  w->jacobian_ready = path->block->pin_count == 0 && path->fixed_count == 0;
  set_nodes(w, path, v, right);
  if (right->row_gains) {
    add_row_gains(w, path->block, right);
  }
  return BAUM_OK;
}

baum_status baum_i_block_path_factor(baum_workspace *w, baum_i_block_path *path, double t,
                                     const double *q)
{
  const baum_i_right_side nothing = {0};
  BAUM_I_TRY(set_state(w, path, t, q, NULL, &nothing));
  (void)factor(w, path);
  return BAUM_OK;
}

baum_status baum_i_block_path_solve(baum_workspace *w, baum_i_block_path *path, double t,
                                    const double *q, const double *v,
                                    const baum_i_right_side *right)
{
  w->solved_by = path;
  BAUM_I_TRY(set_state(w, path, t, q, v, right));
  /* The projection of velocities solves once; the projection of positions repeats the solution and
   * so corrects it. */
  BAUM_I_TRY(solve(w, path, v && !right->force));
  bool finite = path->kernel->read_motion(path->block, w->a);
  for (int i = 0; i < path->omitted_count; i++) {
    w->lambda[path->omitted[i].row] = 0.0;
  }
  return finite ? BAUM_OK : BAUM_ERR_SINGULAR;
}
