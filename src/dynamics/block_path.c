/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes accelerations by the block solver; see block_path.h. */
#include "dynamics/block_path.h"

#include <math.h>
#include <string.h>

#include "base/hot.h"
#include "linear/block_pull.h"
#include "mechanism/planar/frames.h"

/* Solutions for other right-hand sides may take more refinements, because the factors have already
 * been accepted. With three, 4 of 40000 random systems with weak pivots did not converge. */
enum { MOST_REFINEMENTS = 3, MOST_FURTHER_REFINEMENTS = 8 };

/* Limits of the relative change of the multipliers in a refinement. Below SETTLED the refinement
 * has converged; up to SETTLING the result is still acceptable. */
static const double SETTLED = 0x1p-48;
static const double SETTLING = 1e-9;
/* In space, the accelerations also contribute to the change. A refinement that converges gains at
 * least four digits, so no further refinement is necessary after a change this small. Refinements
 * that gain fewer digits do not reach this limit. */
static const double SETTLED_IN_SPACE = 1e-9;
/* A refinement with a residual in working precision leaves an error of up to the size of its
 * change. */
static const double SETTLED_SIMPLY = 1e-10;
static const double SETTLING_IN_SPACE = 1e-12;

/* In space, the relative error of a is about DBL_EPSILON * amplification / pivot. Here `pivot` is
 * the smallest pivot of the solution, and the amplification (space_block.h) tells how much a = a0
 * - W J^T lambda increases errors of lambda. Solutions with a pivot above FAIR_PIVOT are not
 * refined if amplification / pivot is at most MOST_LOST, or MOST_LOST_UNEVEN if masses are uneven.
 * Compared with solutions in quadruple precision, their errors were below 1e-10 in 1500 random
 * mechanisms. In the scenes of test_spatial_accuracy.c they were below 1e-12, and below 1e-11 if
 * masses differ by large factors. */
static const double FAIR_PIVOT = 1e-4;
static const double MOST_LOST = 1e5;
static const double MOST_LOST_UNEVEN = 2e4;

/* The residual is checked if masses are uneven and the largest a0 exceeds the largest a by more
 * than this factor, because then digits have cancelled in a = a0 - W J^T lambda (W: inverse masses;
 * a0: accelerations without constraint forces). */
static const double CANCELLED = 2048.0;

/* Evaluate the rows of the joints in the path's groups. If `bending` is false, set gamma to zero,
 * because its old values may be infinite. */
BAUM_I_INLINE baum_status evaluate_joints(baum_workspace *w, const baum_i_block_path *path,
                                          bool bending)
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

BAUM_I_INLINE baum_status evaluate_forces(baum_workspace *w, const baum_i_block_path *path,
                                          bool wanted)
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

/* Set Phi' = J v - nu, equation (3), of the omitted rows that no hot file (block_path.h)
 * evaluates. */
BAUM_I_INLINE void set_omitted_rates(baum_workspace *w, const baum_i_block_path *path,
                                     const double *v)
{
  for (int i = 0; v && i < path->rated_count; i++) {
    const baum_i_omitted_row *omitted = &path->omitted[i];
    double rate = -w->nu[omitted->row];
    for (int c = 0; c < omitted->count; c++) {
      rate += w->jacobian[omitted->value + c] * v[omitted->columns[c]];
    }
    w->phi_rate[omitted->row] = rate;
  }
}

/* Return by how much the factor right->row_gains[row] changes damping Phi' + stiffness Phi of a
 * row. */
static double gain_of_row(const baum_workspace *w, const baum_i_right_side *right, int row)
{
  double f = right->row_gains[row];
  return (f - 1.0) * right->damping * w->phi_rate[row] +
         (f * f - 1.0) * right->stiffness * w->phi[row];
}

static void add_row_gain(const baum_workspace *w, baum_i_block *block,
                         const baum_i_right_side *right, int node, int slot, int row)
{
  if (row < 0) {
    return;
  }
  double more = gain_of_row(w, right, row);
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

static baum_i_block_rows rows_of(const baum_workspace *w, const double *v,
                                 const baum_i_right_side *right)
{
  return (baum_i_block_rows){.jacobian = w->jacobian,
                             .v = v,
                             .phi = w->phi,
                             .nu = w->nu,
                             .gamma = w->gamma,
                             .bending = right->bending,
                             .damping = right->damping,
                             .stiffness = right->stiffness,
                             .phi_rate = w->phi_rate};
}

BAUM_I_INLINE void set_nodes(baum_workspace *w, const baum_i_block_path *path, const double *v,
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
  const baum_i_block_rows rows = rows_of(w, v, right);
  path->pins_kernel->set(path->block, &pins);
  path->sides_kernel->set(path->block, &rows);
  set_omitted_rates(w, path, v);
}

/* Tell whether the residual is at rounding level. In a projection, the solution a corrects a
 * violation that has rounding errors itself, so a residual below these errors is also accepted.
 * These errors are proportional to the terms of J x with x = beside * scale, where `beside` is the
 * scaled size of the state. MARGIN makes the limit smaller than this estimate. For accelerations,
 * `beside` is 0. */
static const double MARGIN = 0.125;

static bool check(const baum_workspace *w, const baum_i_block_path *path, double beside)
{
  const baum_i_block *block = path->block;
  if (beside == 0.0 || block->leaves_v) {
    return path->kernel->check(block, NULL);
  }
  int nv = w->mechanism->nv;
  memset(block->pull + nv, 0, (size_t)(block->motion_size - nv) * sizeof *block->pull);
  for (int i = 0; i < nv; i++) {
    block->pull[i] = MARGIN * beside * w->mechanism->scale[i];
  }
  return path->kernel->check(block, block->pull);
}

/* Refine the solution. Unless pivots are bad, every refinement gains at least six digits. Close to
 * a singular configuration the multipliers may be wrong although the residual of J a is small.
 * Therefore solutions with weak pivots are always refined, and solutions with good pivots only if
 * the residual is large. */
static baum_status refine(const baum_workspace *w, baum_i_block_path *path, baum_i_pivots pivots,
                          double beside)
{
  bool done = check(w, path, beside) && pivots == BAUM_I_PIVOTS_GOOD;
  double change = 0.0;
  for (int k = 0; k < MOST_REFINEMENTS && !done; k++) {
    path->refinements++;
    baum_i_block_find_residual(path->block);
    change = path->kernel->correct(path->block);
    done = check(w, path, beside) || change <= SETTLED;
  }
  return done || change <= SETTLING ? BAUM_OK : BAUM_ERR_SINGULAR;
}

/* Tell whether a (`motion`) is small compared with a0 (`from`). */
static bool has_cancelled(const double *from, const double *motion, int count)
{
  double before = 0.0;
  double after = 0.0;
  for (int i = 0; i < count; i++) {
    double a0 = fabs(from[i]);
    double a = fabs(motion[i]);
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

/* Return the scaled size of the state that a projection corrects: of v, or of q if v is NULL. */
static double size_of_state(const baum_workspace *w, const double *q, const double *v)
{
  return v ? baum_i_scaled_size(w->mechanism, v) : fmax(1.0, baum_i_position_size(w->mechanism, q));
}

/* Solutions with good pivots, and solutions in space that judge() trusts, have relative errors far
 * below 1e-8. If a projection changes the velocities by less than this fraction, its solution need
 * not be more accurate than an acceleration. */
static const double SMALL_CHANGE = 1e-8;

static bool is_small_change(const baum_workspace *w, const baum_i_block_path *path, const double *v)
{
  double size = SMALL_CHANGE * baum_i_scaled_size(w->mechanism, v);
  bool finite = path->space ? path->space_kernel->read_motion(path->space, w->a)
                            : path->kernel->read_motion(path->block, w->a);
  return finite && baum_i_scaled_size(w->mechanism, w->a) <= size;
}

/* If `last` is true, no later solution corrects this one. The residual must then be checked, unless
 * the solution is a small change of the velocities v. */
BAUM_I_INLINE baum_status solve(baum_workspace *w, baum_i_block_path *path, bool last,
                                const double *q, const double *v, bool force)
{
  const baum_i_block_kernel *kernel = path->kernel;
  baum_i_block *block = path->block;
  baum_i_pivots pivots = factor(w, path);
  if (pivots == BAUM_I_PIVOTS_BAD) {
    return BAUM_ERR_SINGULAR;
  }
  path->weak = pivots != BAUM_I_PIVOTS_GOOD;
  kernel->substitute(block, w->lambda);
  last = last && !is_small_change(w, path, v);
  bool check = last || pivots != BAUM_I_PIVOTS_GOOD || path->always_check ||
               (path->uneven && has_cancelled(block->from, block->motion, block->motion_size));
  if (!check) {
    return BAUM_OK;
  }
  baum_status status = refine(w, path, pivots, force ? 0.0 : size_of_state(w, q, v));
  kernel->read_lambda(block, w->lambda);
  return status;
}

/* Evaluate joints, masses and forces at a state, and write them to the block solver. */
BAUM_I_INLINE baum_status set_state(baum_workspace *w, const baum_i_block_path *path, double t,
                                    const double *q, const double *v,
                                    const baum_i_right_side *right)
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

/* ---- in space ---- */

/* Do for mechanisms in space what add_row_gains() does for other mechanisms. */
static void add_row_gains_in_space(const baum_workspace *w, const baum_i_space *space,
                                   const baum_i_right_side *right)
{
  for (int k = 0; k < space->node_count; k++) {
    const baum_i_space_node *node = &space->list[k];
    double *numbers = space->nodes + node->at;
    for (int i = 0; i < node->rows; i++) {
      bool omitted = (node->omitted >> i & 1u) != 0;
      double more = omitted ? 0.0 : gain_of_row(w, right, node->row[i]);
      numbers[baum_i_space_vector(node->rows) + i] -= more;
      numbers[i] += more;
    }
  }
}

/* Add the forces of all elements except bodies in space, whose forces are already set. */
static baum_status add_other_forces(baum_workspace *w, const baum_i_block_path *path)
{
  const baum_mechanism *m = w->mechanism;
  for (const baum_i_body_group *group = m->body_groups; group->type; group++) {
    if (!baum_i_is_spatial(group->type->frame)) {
      for (int i = 0; i < group->count; i++) {
        memset(w->force + group->bodies[i]->v, 0, (size_t)group->bodies[i]->nv * sizeof *w->force);
      }
      BAUM_I_TRY(group->type->force(group, &w->point, w->force));
    }
  }
  for (const baum_i_force_group *group = m->force_groups; group->type; group++) {
    BAUM_I_TRY(group->type->force(group, &w->point, w->force));
  }
  path->space_sides->set_force(path->space, w->force);
  return BAUM_OK;
}

/* Do the same as baum_i_point_set(), but inline. */
static void begin_point(baum_i_point *point, double t, const double *q, const double *v)
{
  point->t = t;
  point->q = point->normalized ? point->normalized : q;
  point->v = v;
  point->retry = false;
}

static baum_i_space_pass pass_of(const baum_workspace *w, const baum_i_block_path *path,
                                 const double *q, const double *v, const baum_i_right_side *right)
{
  return (baum_i_space_pass){.joints = path->space_joints,
                             .places = w->mechanism->places,
                             .q = q,
                             .v = v,
                             .normalized = w->point.normalized,
                             .frames = w->point.frames,
                             .spatial = w->point.spatial,
                             .gravity = right->force ? w->mechanism->gravity : NULL,
                             .moments = w->point.moments,
                             .force = w->force,
                             .bending = right->bending,
                             .damping = right->damping,
                             .stiffness = right->stiffness,
                             .phi = w->phi,
                             .phi_rate = w->phi_rate,
                             .gamma = w->gamma};
}

/* Set everything that precedes the joints of hot files. If `bodies` is false, frames of bodies are
 * not set yet. */
static baum_status begin_space(baum_workspace *w, const baum_i_block_path *path, double t,
                               const baum_i_space_pass *pass, const baum_i_right_side *right,
                               bool bodies)
{
  begin_point(&w->point, t, pass->q, pass->v);
  if (path->has_planar) {
    w->point.kernel->set(w->mechanism, pass->q, pass->v, w->point.frames);
  }
  if (bodies) {
    path->bodies_kernel->set(path->space, pass, 0, path->space->stage_count);
  }
  w->eliminated_by = NULL;
  w->jacobian_ready = false; /* if a function fails, J is partly overwritten */
  BAUM_I_TRY(evaluate_joints(w, path, right->bending != 0.0));
  baum_i_space_use_force(path->space, right->force);
  if (right->force && !path->only_weights) {
    BAUM_I_TRY(add_other_forces(w, path));
  }
  w->jacobian_ready = path->space_joints.count == 0 && path->fixed_count == 0;
  return BAUM_OK;
}

static baum_status set_space(baum_workspace *w, const baum_i_block_path *path, double t,
                             const double *q, const double *v, const baum_i_right_side *right)
{
  const baum_i_space_pass pass = pass_of(w, path, q, v, right);
  const baum_i_block_rows rows = rows_of(w, v, right);
  BAUM_I_TRY(begin_space(w, path, t, &pass, right, true));
  path->joints_kernel->set(path->space, &pass, 0, path->space->stage_count);
  path->space_sides->set(path->space, &rows);
  set_omitted_rates(w, path, v);
  if (right->row_gains) {
    add_row_gains_in_space(w, path->space, right);
  }
  return BAUM_OK;
}

static baum_i_pivots factor_space(baum_workspace *w, baum_i_block_path *path)
{
  path->factor_kernel->couple(path->space, 0, path->space->stage_count);
  path->factorizations++;
  w->eliminated_by = path;
  return path->factor_kernel->eliminate(path->space, 0, path->space->stage_count);
}

/* Do the same as set_space() and factor_space(), by stages (space_block.h) if possible. */
static baum_status set_and_factor_space(baum_workspace *w, baum_i_block_path *path, double t,
                                        const double *q, const double *v,
                                        const baum_i_right_side *right, baum_i_pivots *pivots)
{
  if (!path->only_hot || right->row_gains) {
    BAUM_I_TRY(set_space(w, path, t, q, v, right));
    *pivots = factor_space(w, path);
    return BAUM_OK;
  }
  const baum_i_space_pass pass = pass_of(w, path, q, v, right);
  baum_i_space *space = path->space;
  BAUM_I_TRY(begin_space(w, path, t, &pass, right, !path->only_weights));
  for (int s = 0; s < space->stage_count; s++) {
    if (path->only_weights) {
      path->bodies_kernel->set(space, &pass, s, s + 1);
    }
    path->joints_kernel->set(space, &pass, s, s + 1);
    path->factor_kernel->couple(space, s, s + 1);
    *pivots = path->factor_kernel->eliminate(space, s, s + 1);
  }
  path->factorizations++;
  w->eliminated_by = path;
  return BAUM_OK;
}

static void find_residual(const baum_i_block_path *path)
{
  if (path->space) {
    path->residual_kernel->find(path->space);
  } else {
    baum_i_block_find_residual(path->block);
  }
}

static double correct(const baum_i_block_path *path)
{
  return path->space ? path->refine_kernel->correct(path->space)
                     : path->kernel->correct(path->block);
}

static double refine_any(const baum_i_block_path *path)
{
  find_residual(path);
  return correct(path);
}

/* If `simple` is true, the first refinement needs no residual in twice the working precision. */
static baum_status refine_space(baum_i_block_path *path, bool done, bool simple, double settled)
{
  double change = 0.0;
  for (int k = 0; k < MOST_REFINEMENTS && !done; k++) {
    bool simply = simple && k == 0;
    path->refinements++;
    change = simply ? path->refine_kernel->correct_rows(path->space) : refine_any(path);
    done = change <= (simply ? SETTLED_SIMPLY : settled) ||
           (!path->uneven && path->refine_kernel->check(path->space));
  }
  return done || change <= SETTLING_IN_SPACE ? BAUM_OK : BAUM_ERR_SINGULAR;
}

/* How far a solution in space can be trusted. */
typedef struct trust {
  bool good;   /* it needs no refinement, unless the residual is large */
  bool simple; /* the first refinement needs no residual in twice the working precision */
} trust;

static trust judge(const baum_i_block_path *path, baum_i_pivots pivots, bool last)
{
  const baum_i_space *space = path->space;
  bool sound = path->refine_kernel->check_weak_nodes(space);
  bool good = pivots == BAUM_I_PIVOTS_GOOD && !path->uneven && sound;
  if (good || last) {
    return (trust){.good = good, .simple = false};
  }
  /* If masses are uneven, a rounding error of lambda that is negligible for heavy bodies may
   * accelerate light bodies. The residual r - J a does not show this error if the constraints
   * permit the direction of the acceleration. */
  double amplified = path->refine_kernel->amplification(space);
  double most = path->uneven ? MOST_LOST_UNEVEN : MOST_LOST;
  bool fair = space->weakest > FAIR_PIVOT && amplified <= most * space->weakest;
  return (trust){.good = sound && fair, .simple = amplified <= CANCELLED};
}

/* `last` has the same meaning as in solve(). If `last` is true, the solution is a correction of the
 * velocities v. */
static baum_status solve_space(baum_workspace *w, baum_i_block_path *path, bool last,
                               const double *v, baum_i_pivots pivots)
{
  const baum_i_space_kernel *kernel = path->space_kernel;
  baum_i_space *space = path->space;
  if (pivots == BAUM_I_PIVOTS_BAD) {
    return BAUM_ERR_SINGULAR;
  }
  kernel->substitute(space, w->lambda);
  last = last && !is_small_change(w, path, v);
  const trust of = judge(path, pivots, last);
  path->weak = !of.good;
  if (of.good && !last) {
    return BAUM_OK;
  }
  bool done = of.good && path->refine_kernel->check(space);
  baum_status status = refine_space(path, done, of.simple, last ? SETTLED : SETTLED_IN_SPACE);
  kernel->read_lambda(space, w->lambda);
  return status;
}

/* ---- both ---- */

baum_status baum_i_block_path_evaluate(baum_workspace *w, const baum_i_block_path *path, double t,
                                       const double *q, const double *v,
                                       const baum_i_right_side *right)
{
  return path->space ? set_space(w, path, t, q, v, right) : set_state(w, path, t, q, v, right);
}

baum_status baum_i_block_path_factor(baum_workspace *w, baum_i_block_path *path, double t,
                                     const double *q)
{
  const baum_i_right_side nothing = {0};
  BAUM_I_TRY(baum_i_block_path_evaluate(w, path, t, q, NULL, &nothing));
  (void)(path->space ? factor_space(w, path) : factor(w, path));
  return BAUM_OK;
}

baum_status baum_i_block_path_solve(baum_workspace *w, baum_i_block_path *path, double t,
                                    const double *q, const double *v,
                                    const baum_i_right_side *right)
{
  /* The projection of velocities solves only once. The projection of positions iterates, so later
   * solutions correct earlier ones. */
  bool last = v && !right->force;
  bool finite;
  w->solved_by = path;
  if (path->space) {
    baum_i_pivots pivots = BAUM_I_PIVOTS_BAD;
    BAUM_I_TRY(set_and_factor_space(w, path, t, q, v, right, &pivots));
    BAUM_I_TRY(solve_space(w, path, last, v, pivots));
    finite = path->space_kernel->read_motion(path->space, w->a);
  } else {
    BAUM_I_TRY(set_state(w, path, t, q, v, right));
    BAUM_I_TRY(solve(w, path, last, q, v, right->force));
    finite = path->kernel->read_motion(path->block, w->a);
  }
  for (int i = 0; i < path->omitted_count; i++) {
    w->lambda[path->omitted[i].row] = 0.0;
  }
  return finite ? BAUM_OK : BAUM_ERR_SINGULAR;
}

/* ---- other right-hand sides ---- */

/* Set out (nv) to `factor` times the solution for the right-hand side that was written to the
 * solver. If pivots are weak, refine it. */
static baum_status solve_again(const baum_i_block_path *path, double factor, double *out)
{
  double change = correct(path);
  for (int k = 0; k < MOST_FURTHER_REFINEMENTS && path->weak && !(change <= SETTLING); k++) {
    change = refine_any(path);
  }
  bool finite = path->space ? path->space_kernel->read_motion(path->space, out)
                            : path->kernel->read_motion(path->block, out);
  int nv = path->space ? path->space->structure->nv : path->block->structure->nv;
  for (int i = 0; i < nv; i++) {
    out[i] *= factor;
  }
  baum_status status = path->weak && !(change <= SETTLING) ? BAUM_ERR_SINGULAR : BAUM_OK;
  return finite ? status : BAUM_ERR_NOT_FINITE;
}

baum_status baum_i_block_path_meet_rows(const baum_i_block_path *path, const double *r, double *out)
{
  if (path->space) {
    baum_i_space_set_rest(path->space, r);
  } else {
    baum_i_block_set_rest(path->block, r);
  }
  return solve_again(path, 1.0, out);
}

baum_status baum_i_block_path_normal_part(const baum_i_block_path *path, const double *x,
                                          double *out)
{
  if (path->space) {
    baum_i_space_pull(path->space, x);
  } else {
    baum_i_block_pull(path->block, x);
  }
  if (path->weak) {
    find_residual(path);
    if (path->space) {
      baum_i_space_move_rest(path->space);
    } else {
      baum_i_block_move_rest(path->block);
    }
  }
  return solve_again(path, path->weak ? 1.0 : -1.0, out);
}
