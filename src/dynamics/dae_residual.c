/* SPDX-License-Identifier: BSD-3-Clause */
/* Residual forms of the equations of motion, y = (q, v, lambda), for implicit solvers:
 *
 *   q' - v
 *   M v' + J^T lambda - g
 *   index 1:  J v' - gamma + 2 alpha Phi' + beta^2 Phi        index 3:  Phi
 *
 * A dropped row i reads lambda_i = 0.
 */
#include <string.h>

#include "dynamics/dynamics.h"

static void acceleration_rows(const baum_workspace *w, const baum_dae *dae, const double *dv,
                              double *out)
{
  int nc = w->mechanism->nc;
  for (int i = 0; i < nc; i++) {
    out[i] = 2.0 * dae->alpha * w->phi_rate[i] + dae->beta * dae->beta * w->phi[i] - w->gamma[i];
  }
  baum_i_jacobian_times(&w->structure, w->jacobian, dv, out);
}

baum_status baum_i_residual(baum_workspace *w, const baum_dae *dae, double t, const double *y,
                            const double *dy, double *residual)
{
  int nq = w->mechanism->nq;
  int nv = w->mechanism->nv;
  int nc = w->mechanism->nc;
  const double *v = y + nq;
  const double *lambda = v + nv;
  const double *dv = dy + nq;
  double *newton = residual + nq;
  double *rows = newton + nv;
  w->evaluations++;
  baum_status status = baum_i_velocity_stage(w, t, y, v);
  if (status != BAUM_OK) {
    return status;
  }
  for (int i = 0; i < nv; i++) {
    residual[i] = dy[i] - v[i];
    newton[i] = -w->force[i];
  }
  baum_i_mass_times(&w->structure, w->mass, dv, newton);
  baum_i_jacobian_transposed_times(&w->structure, w->jacobian, lambda, newton);
  if (dae->index == BAUM_RESIDUAL_INDEX1) {
    acceleration_rows(w, dae, dv, rows);
  } else {
    memcpy(rows, w->phi, (size_t)nc * sizeof *rows);
  }
  for (int i = 0; i < nc && w->redundancy.count > 0; i++) {
    rows[i] = w->redundancy.dropped[i] ? lambda[i] : rows[i];
  }
  return BAUM_OK;
}
