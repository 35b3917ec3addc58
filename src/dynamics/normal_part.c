/* SPDX-License-Identifier: BSD-3-Clause */
/* What the constraints have of a velocity-like x, by the factors that the last solution has left
 *
 *   P x = M^-1 J^T (J M^-1 J^T)^-1 J x:   [ M  J^T ] [ P x    ]   [ 0   ]
 *                                         [ J   0  ] [ lambda ] = [ J x ]
 *
 * and with any right side r of rows in the place of J x the smallest velocity that has J y = r.
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

static baum_status solve_whole(baum_workspace *w, const double *rows, double *out)
{
  memset(w->work_v, 0, (size_t)w->mechanism->nv * sizeof *w->work_v);
  return baum_i_kkt_solve(w->kkt, w->work_v, rows, out, w->work_c + w->mechanism->nc);
}

static baum_status solve_rows_by_blocks(const baum_i_block_path *path, const double *rows,
                                        double *out)
{
  baum_i_block_set_rest(path->block, rows);
  (void)path->kernel->correct(path->block);
  return path->kernel->read_motion(path->block, out) ? BAUM_OK : BAUM_ERR_NOT_FINITE;
}

static baum_status give_nothing(const baum_workspace *w, double *out)
{
  memset(out, 0, (size_t)w->mechanism->nv * sizeof *out);
  return BAUM_OK;
}

baum_status baum_i_normal_part(baum_workspace *w, const double *x, double *out)
{
  if (w->mechanism->nc == 0) {
    return give_nothing(w, out);
  }
  if (w->solved_by) {
    return solve_by_blocks(w->solved_by, x, out);
  }
  memset(w->work_c, 0, (size_t)w->mechanism->nc * sizeof *w->work_c);
  baum_i_jacobian_times(&w->structure, w->jacobian, x, w->work_c);
  return solve_whole(w, w->work_c, out);
}

baum_status baum_i_least_with_rows(baum_workspace *w, const double *rows, double *out)
{
  if (w->mechanism->nc == 0) {
    return give_nothing(w, out);
  }
  return w->solved_by ? solve_rows_by_blocks(w->solved_by, rows, out) : solve_whole(w, rows, out);
}
