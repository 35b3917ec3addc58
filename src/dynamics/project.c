/* SPDX-License-Identifier: BSD-3-Clause */
/* Projects states onto the constraints by the least change in the metric of M (Eich 1993; Lubich
 * 1991).
 *
 *   positions:                            velocities:
 *   [ M  J^T ] [ dq     ]   [  0   ]      [ M  J^T ] [ dv     ]   [ 0        ]
 *   [ J   0  ] [ lambda ] = [ -Phi ]      [ J   0  ] [ lambda ] = [ nu - J v ]
 *
 * Phi of rows of velocity level is 0, so positions are projected in directions that these rows
 * permit, and the projection of velocities removes the violation of these rows.
 *
 * Newton's method on the positions ends when a step is so small that the next step, which is of the
 * order of the square of this step, is below rounding.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "dynamics/block_path.h"
#include "dynamics/islands.h"

enum { ITERATIONS = 12 };
/* A Newton step of relative size 1e-10 leaves an error of about 1e-20 times the ratio of the
 * characteristic length to the radius of curvature of the constraints. */
static const double CONVERGED = 1e-10;
/* Changes of q that have stopped decreasing are rounding errors under two conditions: the changes
 * are below this size times the number of rows, and the violation is only rounding. The number of
 * rows is included because the rounding errors of all rows may add up, as in a chain of 1e5
 * links. */
static const double STALLED = 8.0 * DBL_EPSILON;
/* A violation up to this size counts as rounding. It is a displacement relative to the largest
 * coordinate. */
static const double NOISE = 64.0 * DBL_EPSILON;

/* Return the size below which steps are rounding errors of the coordinates. This size is large far
 * from the origin and after many revolutions. */
static double rounding_of(const baum_mechanism *m, const double *q)
{
  return 8.0 * DBL_EPSILON * baum_i_position_size(m, q);
}

baum_status baum_i_change_of_velocities(baum_workspace *w, double t, const double *q,
                                        const double *v)
{
  static const baum_i_right_side right = {.damping = 1.0};
  return baum_i_solve_motion(w, t, q, v, &right);
}

/* Tell whether the violation at q is only rounding. */
static baum_status is_at_rounding(baum_workspace *w, double t, const double *q, bool *is)
{
  const baum_mechanism *m = w->mechanism;
  double most = NOISE * fmax(1.0, baum_i_position_size(m, q));
  BAUM_I_TRY(baum_i_position_stage(w, t, q));
  baum_i_row_displacements(w, w->rhs);
  *is = true;
  for (int i = 0; i < m->nc && *is; i++) {
    *is = w->rows.omitted[i] || fabs(w->phi[i]) <= most * w->rhs[i];
  }
  return BAUM_OK;
}

static baum_status project_positions(baum_workspace *w, double t, double *q)
{
  static const baum_i_right_side right = {.stiffness = 1.0};
  const baum_mechanism *m = w->mechanism;
  double last = INFINITY;
  double size = INFINITY;
  for (int k = 0; k < ITERATIONS; k++) {
    BAUM_I_TRY(baum_i_solve_motion(w, t, q, NULL, &right));
    baum_i_move(m, 1.0, w->a, q);
    size = baum_i_scaled_size(m, w->a);
    if (size <= CONVERGED || size <= rounding_of(m, q)) {
      return BAUM_OK;
    }
    if (!(size < 2.0 * last)) {
      break;
    }
    last = size;
  }
  bool stalled = false;
  if (size <= STALLED * m->nc * fmax(1.0, baum_i_position_size(m, q))) {
    BAUM_I_TRY(is_at_rounding(w, t, q, &stalled));
  }
  return stalled ? BAUM_OK
                 : baum_i_fail(BAUM_ERR_CONVERGENCE,
                               "t = %.9g s: projection of the positions does not converge (last "
                               "change %.3g times the scale): the step is too large, the "
                               "mechanism locks up here, or the configuration is near a "
                               "singular one",
                               t, last);
}

static baum_status project_velocities(baum_workspace *w, double t, const double *q, double *v)
{
  baum_i_rest_fixed_bodies(w->mechanism, v);
  BAUM_I_TRY(baum_i_change_of_velocities(w, t, q, v));
  baum_i_add_scaled(w->mechanism->nv, 1.0, w->a, v);
  return BAUM_OK;
}

baum_status baum_i_project_velocities(baum_workspace *workspace, double t, const double *q,
                                      double *v)
{
  return workspace->mechanism->nc == 0 ? BAUM_OK : project_velocities(workspace, t, q, v);
}

static void save_unprojected(const baum_workspace *workspace, const double *q, const double *v)
{
  size_t nq = (size_t)workspace->mechanism->nq;
  memcpy(workspace->unprojected, q, nq * sizeof *q);
  memcpy(workspace->unprojected + nq, v, (size_t)workspace->mechanism->nv * sizeof *v);
}

baum_status baum_i_project(baum_workspace *workspace, double t, double *q, double *v)
{
  baum_i_normalize(workspace->mechanism, q);
  if (workspace->unprojected) {
    save_unprojected(workspace, q, v);
  }
  if (workspace->mechanism->nc == 0) {
    return BAUM_OK;
  }
  baum_i_place_fixed_bodies(workspace->mechanism, q);
  BAUM_I_TRY(project_positions(workspace, t, q));
  return project_velocities(workspace, t, q, v);
}

/* ---- omitted rows ---- */

/* Largest allowed violation of an omitted row: of Phi as a displacement, and of Phi' relative to
 * the velocities of the island. Rounding errors are smaller than this limit. If the configuration
 * is on another branch, violations are larger. */
static const double NEGLIGIBLE = 1e-7;

static baum_status fail_omitted_row(const baum_workspace *w, int row)
{
  return baum_i_fail(
    BAUM_ERR_INCONSISTENT,
    "t = %.9g s: projection: a redundant row of %s was omitted, but is violated by %.3g, and its "
    "time derivative by %.3g, although the other rows are satisfied: constraints contradict each "
    "other, or the configuration is on another branch",
    w->point.t, baum_i_row_label(w->mechanism, row).text, w->phi[row], w->phi_rate[row]);
}

/* Set size[k] (body_count + 1) to the largest scaled velocity in island number k. Joints between
 * fixed bodies use size[0], the largest scaled velocity in all islands. */
static void find_speeds(const baum_workspace *w, const double *v, double *size)
{
  const baum_mechanism *m = w->mechanism;
  memset(size, 0, ((size_t)m->body_count + 1) * sizeof *size);
  for (int k = 1; k <= m->body_count; k++) {
    double *of = &size[w->island[k]];
    for (int i = m->bodies[k]->v; i < m->bodies[k]->v + m->bodies[k]->nv; i++) {
      *of = fmax(*of, fabs(v[i]) / m->scale[i]);
      size[0] = fmax(size[0], *of);
    }
  }
}

baum_status baum_i_check_projection(baum_workspace *w, double t, const double *q, const double *v,
                                    const double *before)
{
  const baum_mechanism *m = w->mechanism;
  double *speed = w->work_q;
  if (w->rows.count == 0) {
    return BAUM_OK;
  }
  BAUM_I_TRY(baum_i_violation(w, t, q, v));
  baum_i_row_displacements(w, w->work_c);
  find_speeds(w, before, speed);
  for (int i = 0; i < m->nc; i++) {
    double distance = w->work_c[i];
    int island = baum_i_island_of_joint(m, w->island, m->joints[baum_i_row_joint(m, i)]);
    double most = NEGLIGIBLE * (speed[island] * distance + fabs(w->nu[i]));
    bool is_off = fabs(w->phi[i]) > NEGLIGIBLE * distance || fabs(w->phi_rate[i]) > most;
    BAUM_I_TRY(w->rows.omitted[i] && is_off ? fail_omitted_row(w, i) : BAUM_OK);
  }
  return BAUM_OK;
}
