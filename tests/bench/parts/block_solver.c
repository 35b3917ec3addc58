/* SPDX-License-Identifier: BSD-3-Clause */
/* Evaluates accelerations with the library's block solver. For PHASE_WHOLE, this file calls
 * baum_i_acceleration(). For the other phases, it makes the calls that baum_i_acceleration() makes,
 * in the same order. */
#include <stdlib.h>
#include <string.h>

#include "base/hot.h"
#include "dynamics/block_path.h"
#include "mechanism/planar/frames.h"
#include "solvers.h"

typedef struct block_solver {
  scene *at;
  baum_i_block_path *path;
  bool plain; /* does not use wide vectors */
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

/* Creates the solver without wide vectors. If this processor has no wide vectors, returns NULL,
 * because "block" is then the same solver. */
static void *plain_create(scene *at)
{
  return baum_i_hot_is_wide() ? create(at, true) : NULL;
}

/* ---- phases ---- */

static bool run_geometry(const block_solver *s)
{
  static const baum_i_right_side right = {.bending = 1.0,
                                          .damping = 2.0 * SOLVER_GAIN,
                                          .stiffness = SOLVER_GAIN * SOLVER_GAIN,
                                          .force = true};
  return baum_i_block_path_evaluate(s->at->workspace, s->path, 0.0, s->at->q, s->at->v, &right) ==
         BAUM_OK;
}

static bool run_phases(const block_solver *s, int last_phase)
{
  const baum_i_block_path *path = s->path;
  double *lambda = s->at->workspace->lambda;
  bool done = run_geometry(s);
  if (done && last_phase >= PHASE_ASSEMBLY) {
    path->space ? path->factor_kernel->couple(path->space, 0, path->space->stage_count)
                : path->kernel->couple(path->block);
  }
  if (done && last_phase >= PHASE_FACTOR) {
    baum_i_pivots pivots =
      path->space ? path->factor_kernel->eliminate(path->space, 0, path->space->stage_count)
                  : path->kernel->eliminate(path->block);
    done = pivots != BAUM_I_PIVOTS_BAD;
  }
  if (done && last_phase >= PHASE_SOLVE) {
    path->space ? path->space_kernel->substitute(path->space, lambda)
                : path->kernel->substitute(path->block, lambda);
  }
  return done;
}

static bool accelerate(const scene *at)
{
  return baum_i_acceleration(at->workspace, 0.0, at->q, at->v, SOLVER_GAIN, SOLVER_GAIN) == BAUM_OK;
}

static bool block_run(void *self, int last_phase)
{
  block_solver *s = self;
  if (last_phase < PHASE_WHOLE) {
    return run_phases(s, last_phase);
  }
  return accelerate(s->at);
}

/* Replaces the kernels by those without wide vectors, and restores them afterwards. The time that
 * this takes is negligible. */
static bool plain_run(void *self, int last_phase)
{
  block_solver *s = self;
  baum_i_point *point = &s->at->workspace->point;
  const baum_i_block_path path = *s->path;
  const baum_i_frames_kernel *frames = point->kernel;
  s->path->kernel = &baum_i_block_kernel_plain;
  s->path->pins_kernel = &baum_i_pins_kernel_plain;
  s->path->sides_kernel = &baum_i_block_sides_kernel_plain;
  s->path->space_kernel = &baum_i_space_kernel_plain;
  s->path->refine_kernel = &baum_i_space_refine_kernel_plain;
  s->path->space_sides = &baum_i_space_sides_kernel_plain;
  s->path->factor_kernel = &baum_i_space_factor_kernel_plain;
  s->path->residual_kernel = &baum_i_space_residual_kernel_plain;
  s->path->bodies_kernel = &baum_i_space_bodies_kernel_plain;
  s->path->joints_kernel = &baum_i_space_joints_kernel_plain;
  point->kernel = &baum_i_frames_kernel_plain;
  bool done = block_run(self, last_phase);
  s->path->kernel = path.kernel;
  s->path->pins_kernel = path.pins_kernel;
  s->path->sides_kernel = path.sides_kernel;
  s->path->space_kernel = path.space_kernel;
  s->path->refine_kernel = path.refine_kernel;
  s->path->space_sides = path.space_sides;
  s->path->factor_kernel = path.factor_kernel;
  s->path->residual_kernel = path.residual_kernel;
  s->path->bodies_kernel = path.bodies_kernel;
  s->path->joints_kernel = path.joints_kernel;
  point->kernel = frames;
  return done;
}

static void block_read(const void *self, double *a, double *lambda)
{
  const block_solver *s = self;
  solver_read_workspace(s->at->workspace, a, lambda);
}

/* Creates the solver that the library chooses. Its phases cannot be run separately. */
static void *automatic_create(scene *at)
{
  block_solver *s = calloc(1, sizeof *s);
  if (s) {
    s->at = at;
  }
  return s;
}

static bool automatic_run(void *self, int last_phase)
{
  (void)last_phase;
  const block_solver *s = self;
  return accelerate(s->at);
}

const solver solver_automatic = {.name = "automatic",
                                 .create = automatic_create,
                                 .run = automatic_run,
                                 .read = block_read,
                                 .destroy = free};

const solver solver_block = {.name = "block",
                             .has_phases = true,
                             .create = block_create,
                             .run = block_run,
                             .read = block_read,
                             .destroy = free};

const solver solver_block_plain = {.name = "block_plain",
                                   .create = plain_create,
                                   .run = plain_run,
                                   .read = block_read,
                                   .destroy = free};
