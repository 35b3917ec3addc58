/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's method with the matrix of one configuration for all iterations (the chord method):
 *
 *   [ M   J^T ] [ dq     ]   [  0      ]
 *   [ J   0   ] [ lambda ] = [ -Phi(q) ]      M, J: at the factored configuration
 *
 * After a step of length 1/rate, the velocities satisfy J v = nu if a solves
 *
 *   [ M   J^T ] [ a      ]   [ g         ]
 *   [ J   0   ] [ lambda ] = [ -rate Phi' ]
 *
 * The block solver solves both systems. If it gives up, the solver of the whole system is used
 * instead.
 */
#include "dynamics/chord.h"

#include <string.h>

#include "base/message.h"
#include "dynamics/block_path.h"

/* ---- positions ---- */

static baum_status factor_whole(baum_workspace *w, double t, const double *q)
{
  const baum_i_kkt_values values = baum_i_kkt_values_of(w);
  BAUM_I_TRY(baum_i_position_stage(w, t, q));
  return baum_i_report_constraints(w, baum_i_kkt_factor(w->kkt, &values));
}

baum_status baum_i_chord_begin(baum_workspace *w, double t, const double *q, baum_i_chord *out)
{
  static const baum_i_right_side right = {.stiffness = 1.0};
  baum_status status =
    w->motion ? baum_i_block_path_solve(w, w->motion, t, q, NULL, &right) : BAUM_ERR_SINGULAR;
  out->path = w->motion;
  w->evaluations++;
  if (status == BAUM_ERR_SINGULAR) {
    out->path = NULL;
    status = factor_whole(w, t, q);
  }
  return status;
}

static baum_status change_by_blocks(baum_workspace *w, const baum_i_block_path *path)
{
  return baum_i_report_constraints(w, baum_i_block_path_meet_rows(path, w->rhs, w->a));
}

static baum_status change_by_whole(baum_workspace *w)
{
  memset(w->force, 0, (size_t)w->mechanism->nv * sizeof *w->force);
  BAUM_I_TRY(
    baum_i_report_constraints(w, baum_i_kkt_solve(w->kkt, w->force, w->rhs, w->a, w->lambda)));
  baum_i_rest_fixed_bodies(w->mechanism, w->a);
  return BAUM_OK;
}

baum_status baum_i_chord_change(baum_workspace *w, const baum_i_chord *chord, double t,
                                const double *q)
{
  baum_i_point_set(&w->point, t, q, NULL);
  BAUM_I_TRY(baum_i_mechanism_phi(&w->point, w->phi));
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->rhs[i] = -w->phi[i];
  }
  return chord->path ? change_by_blocks(w, chord->path) : change_by_whole(w);
}

/* ---- velocities ---- */

baum_status baum_i_hold_velocities(baum_workspace *w, double t, const double *q, const double *v,
                                   const double *moments, double rate)
{
  const baum_i_right_side right = {.damping = rate, .force = true};
  w->evaluations++;
  w->point.moments = moments;
  baum_status status = baum_i_solve_motion(w, t, q, v, &right);
  w->point.moments = NULL;
  return status;
}
