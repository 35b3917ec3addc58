/* SPDX-License-Identifier: BSD-3-Clause */
/* The library's own evaluation, which goes by blocks. The whole is baum_i_acceleration() itself; the
 * phases are the calls it makes, in their order.
 */
#include <stdlib.h>
#include <string.h>

#include "base/hot.h"
#include "dynamics/block_path.h"
#include "mechanism/frames.h"
#include "solvers.h"

typedef struct block_solver {
  scene *at;
  baum_i_block_path *path;
  bool plain; /* with the tables for any processor */
} block_solver;

static void *create(scene *at, bool plain)
{
  if (!at->workspace->path) {
    return NULL;
  }
  block_solver *s = calloc(1, sizeof *s);
  if (s) {
    *s = (block_solver){.at = at, .path = at->workspace->path, .plain = plain};
  }
  return s;
}

static void *block_create(scene *at)
{
  return create(at, false);
}

/* Only where it is not the same as "block". */
static void *plain_create(scene *at)
{
  return baum_i_hot_is_wide() ? create(at, true) : NULL;
}

/* ---- phases ---- */

static bool run_joints(const block_solver *s)
{
  baum_workspace *w = s->at->workspace;
  const baum_i_rows rows = {.phi = w->phi, .jacobian = w->jacobian, .nu = w->nu, .gamma = w->gamma};
  bool done = true;
  for (int k = 0; k < s->path->group_count && done; k++) {
    const baum_i_joint_group *group = &s->path->groups[k];
    done = group->type->evaluate(group, &w->point, &rows) == BAUM_OK;
  }
  return done;
}

static bool run_forces(const block_solver *s)
{
  baum_workspace *w = s->at->workspace;
  if (s->path->force_is_constant) {
    return true;
  }
  bool done = baum_i_mechanism_force(&w->point, w->force) == BAUM_OK;
  s->path->sides_kernel->set_force(s->path->block, w->force);
  return done;
}

static bool run_geometry(const block_solver *s)
{
  baum_workspace *w = s->at->workspace;
  baum_i_point_set(&w->point, 0.0, s->at->q, s->at->v);
  bool done = run_joints(s) && run_forces(s);
  const baum_i_pins pins = {.points = s->path->points,
                            .frames = w->point.frames,
                            .bending = 1.0,
                            .damping = 2.0 * SOLVER_GAIN,
                            .stiffness = SOLVER_GAIN * SOLVER_GAIN,
                            .phi = w->phi,
                            .phi_rate = w->phi_rate,
                            .gamma = w->gamma};
  s->path->pins_kernel->set(s->path->block, &pins);
  const baum_i_block_rows rows = {.jacobian = w->jacobian,
                                  .v = s->at->v,
                                  .phi = w->phi,
                                  .nu = w->nu,
                                  .gamma = w->gamma,
                                  .bending = pins.bending,
                                  .damping = pins.damping,
                                  .stiffness = pins.stiffness,
                                  .phi_rate = w->phi_rate};
  s->path->sides_kernel->set(s->path->block, &rows);
  return done;
}

static bool run_phases(const block_solver *s, int last_phase)
{
  const baum_i_block_kernel *kernel = s->path->kernel;
  bool done = run_geometry(s);
  if (done && last_phase >= PHASE_ASSEMBLY) {
    kernel->couple(s->path->block);
  }
  if (done && last_phase >= PHASE_FACTOR) {
    done = kernel->eliminate(s->path->block) != BAUM_I_PIVOTS_BAD;
  }
  if (done && last_phase >= PHASE_SOLVE) {
    kernel->substitute(s->path->block, s->at->workspace->lambda);
  }
  return done;
}

static bool block_run(void *self, int last_phase)
{
  block_solver *s = self;
  if (last_phase < PHASE_WHOLE) {
    return run_phases(s, last_phase);
  }
  return baum_i_acceleration(s->at->workspace, 0.0, s->at->q, s->at->v, SOLVER_GAIN, SOLVER_GAIN) ==
         BAUM_OK;
}

/* Four assignments and back are next to nothing beside an evaluation. */
static bool plain_run(void *self, int last_phase)
{
  block_solver *s = self;
  baum_i_point *point = &s->at->workspace->point;
  const baum_i_block_kernel *kernel = s->path->kernel;
  const baum_i_pins_kernel *pins = s->path->pins_kernel;
  const baum_i_block_sides_kernel *sides = s->path->sides_kernel;
  const baum_i_frames_kernel *frames = point->kernel;
  s->path->kernel = &baum_i_block_kernel_plain;
  s->path->pins_kernel = &baum_i_pins_kernel_plain;
  s->path->sides_kernel = &baum_i_block_sides_kernel_plain;
  point->kernel = &baum_i_frames_kernel_plain;
  bool done = block_run(self, last_phase);
  s->path->kernel = kernel;
  s->path->pins_kernel = pins;
  s->path->sides_kernel = sides;
  point->kernel = frames;
  return done;
}

static void block_read(const void *self, double *a, double *lambda)
{
  const block_solver *s = self;
  solver_read_workspace(s->at->workspace, a, lambda);
}

/* ---- cost ---- */

/* Counted from src/dynamics/pins_hot.c and src/linear/block_hot.c; a sine with its cosine is about 40. */
static double count_flops(const block_solver *s)
{
  const baum_i_block *b = s->path->block;
  double couplings = b->order.start[b->node_count];
  double targets = 0.0;
  for (int k = 0; k < b->node_count; k++) {
    double later = b->order.start[k + 1] - b->order.start[k];
    targets += later * (later - 1.0) / 2.0;
  }
  return 40.0 * s->at->bodies + (77.0 + 18.0) * b->pin_count + 54.0 * b->side_count +
         10.0 * (b->alike_count + b->opposite_count) + 30.0 * b->full_pair_count +
         18.0 * b->node_count + (41.0 + 8.0) * couplings + 16.0 * targets;
}

/* Every number and index of the path once; the traffic is about twice that. */
static double count_bytes(const block_solver *s)
{
  const baum_i_block *b = s->path->block;
  double couplings = b->order.start[b->node_count];
  double targets = 0.0;
  for (int k = 0; k < b->node_count; k++) {
    double later = b->order.start[k + 1] - b->order.start[k];
    targets += later * (later - 1.0) / 2.0;
  }
  double number = sizeof(double);
  double bodies = number * (3.0 * 3.0 + 3.0) + sizeof(baum_i_frame); /* q, v, a, turn, frame */
  double pins = number * (4.0 + 4.0 + 2.0 * 3.0) + sizeof(baum_i_pin_node);
  double nodes = sizeof(baum_i_node) + number * 2.0 + sizeof(int32_t) * 2.0;
  double motion = number * (2.0 * b->motion_size + 2.0 * b->triple_count);
  return bodies * s->at->bodies + motion + pins * b->pin_count + nodes * b->node_count +
         (4.0 * number + sizeof(int32_t)) * couplings + sizeof(int32_t) * targets +
         6.0 * number * b->side_count +
         (double)sizeof(baum_i_pin_pair) * (b->alike_count + b->opposite_count) +
         (double)sizeof(baum_i_full_pair) * b->full_pair_count;
}

static solver_cost block_cost(const void *self)
{
  const block_solver *s = self;
  return (solver_cost){.bytes = count_bytes(s), .flops = count_flops(s)};
}

const solver solver_block = {.name = "block",
                             .has_phases = true,
                             .create = block_create,
                             .run = block_run,
                             .read = block_read,
                             .cost = block_cost,
                             .destroy = free};

const solver solver_block_plain = {.name = "block_plain",
                                   .create = plain_create,
                                   .run = plain_run,
                                   .read = block_read,
                                   .destroy = free};
