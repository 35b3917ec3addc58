/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes P x, the part of a vector x (nv) that the constraints remove. The factors of the last
 * solution are used:
 *
 *   P x = M^-1 J^T (J M^-1 J^T)^-1 J x:   [ M  J^T ] [ P x    ]   [ 0   ]
 *                                         [ J   0  ] [ lambda ] = [ J x ]
 *
 * With any right-hand side r of the rows in place of J x, the same system gives the velocity y with
 * J y = r that is smallest in the metric of M.
 *
 * P P = P. In the metric of M, x - P x is the vector y nearest to x with J y = 0.
 */
#include <string.h>

#include "dynamics/block_path.h"

static baum_status solve_whole(baum_workspace *w, const double *rows, double *out)
{
  memset(w->work_v, 0, (size_t)w->mechanism->nv * sizeof *w->work_v);
  return baum_i_kkt_solve(w->kkt, w->work_v, rows, out, w->work_c + w->mechanism->nc);
}

baum_status baum_i_normal_part(baum_workspace *w, const double *x, double *out)
{
  if (w->mechanism->nc == 0) {
    memset(out, 0, (size_t)w->mechanism->nv * sizeof *out);
    return BAUM_OK;
  }
  if (w->solved_by) {
    return baum_i_block_path_normal_part(w->solved_by, x, out);
  }
  memset(w->work_c, 0, (size_t)w->mechanism->nc * sizeof *w->work_c);
  baum_i_jacobian_times(&w->structure, w->jacobian, x, w->work_c);
  return solve_whole(w, w->work_c, out);
}

baum_status baum_i_least_with_rows(baum_workspace *w, const double *rows, double *out)
{
  if (w->mechanism->nc == 0) {
    memset(out, 0, (size_t)w->mechanism->nv * sizeof *out);
    return BAUM_OK;
  }
  if (w->solved_by) {
    return baum_i_block_path_meet_rows(w->solved_by, rows, out);
  }
  return solve_whole(w, rows, out);
}

baum_status baum_i_displaced_part(baum_workspace *w, const double *x, double *out)
{
  const baum_mechanism *m = w->mechanism;
  if (m->velocity_row_count == 0) {
    return baum_i_normal_part(w, x, out);
  }
  BAUM_I_TRY(baum_i_need_jacobian(w));
  memset(w->work_c, 0, (size_t)m->nc * sizeof *w->work_c);
  baum_i_jacobian_times(&w->structure, w->jacobian, x, w->work_c);
  for (int i = 0; i < m->nc; i++) {
    w->work_c[i] = m->velocity_rows[i] ? 0.0 : w->work_c[i];
  }
  return baum_i_least_with_rows(w, w->work_c, out);
}
