/* SPDX-License-Identifier: BSD-3-Clause */
/* What the constraints have of a velocity-like x, by the factors that the last solution has left
 *
 *   P x = M^-1 J^T (J M^-1 J^T)^-1 J x:   [ M  J^T ] [ P x    ]   [ 0   ]
 *                                         [ J   0  ] [ lambda ] = [ J x ]
 *
 * P P = P; x - P x is the nearest vector in the metric of M that fulfils J x = 0.
 */
#include <string.h>

#include "dynamics/block_path.h"
#include "linear/block_pull.h"

static baum_status solve_by_blocks(const baum_i_block_path *path, const double *x, double *out)
{
  baum_i_block_pull(path->block, x);
  (void)path->kernel->correct(path->block);
  bool finite = path->kernel->read_motion(path->block, out);
  for (int i = 0; i < path->block->structure->nv; i++) {
    out[i] = -out[i];
  }
  return finite ? BAUM_OK : BAUM_ERR_NOT_FINITE;
}

static baum_status solve_whole(baum_workspace *w, const double *x, double *out)
{
  int nc = w->mechanism->nc;
  double *right = w->work_c;
  memset(right, 0, (size_t)nc * sizeof *right);
  memset(w->work_v, 0, (size_t)w->mechanism->nv * sizeof *w->work_v);
  baum_i_jacobian_times(&w->structure, w->jacobian, x, right);
  return baum_i_kkt_solve(w->kkt, w->work_v, right, out, right + nc);
}

baum_status baum_i_normal_part(baum_workspace *w, const double *x, double *out)
{
  if (w->mechanism->nc == 0) {
    memset(out, 0, (size_t)w->mechanism->nv * sizeof *out);
    return BAUM_OK;
  }
  return w->solved_by ? solve_by_blocks(w->solved_by, x, out) : solve_whole(w, x, out);
}
