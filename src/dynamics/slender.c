/* SPDX-License-Identifier: BSD-3-Clause */
/* Raises moments of inertia of slender bodies in the block solver for space; see space_block.h. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "dynamics/block_path.h"

/* If the weakest pivot in the design configuration is smaller than this, the moments of inertia of
 * slender bodies are raised. */
static const double USELESS = 1e-6;
/* Each refinement must reduce the error of the spin of a slender body to this fraction, unless the
 * error is already below NOISE times the error before the first refinement. */
static const double FAST = 1e-2;
static const double NOISE = 1e-10;
enum { TRIALS = 3 };

/* Set sizes[] (body_count) to |u . y|, with u and y of space_block.h. */
static void measure_twists(const baum_i_space *space, double *sizes)
{
  for (int t = 1; t < space->body_count; t++) {
    const double *u = space->lack + (ptrdiff_t)4 * t;
    const double *y = space->motion + (ptrdiff_t)BAUM_I_SPACE_MOTION * t + 4;
    sizes[t] = fabs(u[0] * y[0] + u[1] * y[1] + u[2] * y[2]);
  }
}

/* Each refinement multiplies the error of a solution by P W K. Here W is the inverse of M with the
 * raised moments of inertia, K the difference between this M and the true M, and P the projection
 * on the null space of J. Apply this product to a vector with different rotations of all slender
 * bodies. sizes[] receives |u . y| of the vector at the beginning, before the last product, and at
 * the end. */
static void apply_refinements(const baum_i_block_path *path, double *sizes[3])
{
  const baum_i_space *space = path->space;
  int numbers = BAUM_I_SPACE_MOTION * space->body_count;
  memset(space->motion, 0, (size_t)numbers * sizeof *space->motion);
  for (int t = 1; t < space->body_count; t++) {
    for (int c = 0; c < 3; c++) {
      space->motion[BAUM_I_SPACE_MOTION * (ptrdiff_t)t + 4 + c] =
        cos(t) * space->lack[4 * (ptrdiff_t)t + c];
    }
  }
  measure_twists(space, sizes[0]);
  for (int k = 0; k < TRIALS; k++) {
    measure_twists(space, sizes[1]);
    path->refine_kernel->find_rest(path->space);
    memset(space->rest, 0, (size_t)space->numbers_of_rows * sizeof *space->rest);
    (void)path->refine_kernel->correct(path->space);
    for (int i = 0; i < numbers; i++) {
      space->motion[i] -= space->pull_low[i]; /* only the change */
    }
  }
  measure_twists(space, sizes[2]);
}

/* Refinement does not converge for bodies that can rotate about their axes without moving other
 * inertia. Restore the moments of inertia of these bodies. *count receives their number. */
static baum_status restore_free(const baum_i_block_path *path, int *count)
{
  baum_i_space *space = path->space;
  size_t bodies = (size_t)space->body_count;
  double *numbers = baum_i_alloc(3 * bodies, sizeof *numbers);
  BAUM_I_TRY(baum_i_check_memory(numbers));
  double *sizes[3] = {numbers, numbers + bodies, numbers + 2 * bodies};
  *count = 0;
  apply_refinements(path, sizes);
  for (int t = 1; t < space->body_count; t++) {
    if (sizes[2][t] > fmax(FAST * sizes[1][t], NOISE * sizes[0][t])) {
      baum_i_space_restore_slender(space, t);
      *count += 1;
    }
  }
  baum_i_free(numbers);
  return BAUM_OK;
}

static baum_status set_numbers_again(baum_workspace *w, baum_i_block_path *path)
{
  baum_i_free(path->space_joints.numbers);
  BAUM_I_TRY(baum_i_space_joints_set(w, path->space, &path->space_joints));
  BAUM_I_TRY(baum_i_block_path_factor(w, path, 0.0, w->mechanism->design_q));
  return BAUM_OK;
}

baum_status baum_i_raise_slender(baum_workspace *w, baum_i_block_path *path)
{
  baum_i_space *space = path->space;
  if (!baum_i_space_has_slender(space)) {
    return BAUM_OK;
  }
  BAUM_I_TRY(baum_i_block_path_factor(w, path, 0.0, w->mechanism->design_q));
  if (!(space->weakest > USELESS)) {
    int restored = 1;
    baum_i_space_raise_slender(space);
    BAUM_I_TRY(set_numbers_again(w, path));
    baum_i_space_use_force(space, true);
    while (space->is_raised && restored > 0) {
      BAUM_I_TRY(restore_free(path, &restored));
      BAUM_I_TRY(restored > 0 ? set_numbers_again(w, path) : BAUM_OK);
      baum_i_space_use_force(space, true);
    }
  }
  w->eliminated_by = NULL;
  w->jacobian_ready = false;
  path->factorizations = 0;
  return BAUM_OK;
}
