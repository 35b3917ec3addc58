/* SPDX-License-Identifier: BSD-3-Clause */
/* The residual forms of the equations of motion, for implicit solvers. With y = (q, v, lambda) the
 * residual consists of these rows:
 *
 *   q' - N v                                                  N = I where q' = v
 *   M v' + J^T lambda - g
 *   index 1:  J v' - gamma + 2 alpha Phi' + beta^2 Phi        index 2:  Phi' = J v - nu
 *   index 3:  Phi
 *
 * The form GGL (C. Gear, B. Leimkuhler, G. Gupta, J. Comp. Appl. Math. 12 (1985) 77-90) has index
 * 2. With y = (q, v, lambda, mu) and the metric W of metric.c, its residual consists of these rows:
 *
 *   q' - N (v - W^-1 J^T mu)
 *   M v' + J^T lambda - g
 *   Phi'
 *   Phi
 *
 * A row of velocity level has no Phi. In its place, the residual contains Phi' at index 3, and mu_i
 * in GGL. For an omitted row i, the residual contains lambda_i and mu_i instead of the constraint.
 * If the rows have different gains, alpha and beta above are the gains of row i.
 */
#include <string.h>

#include "base/message.h"
#include "dynamics/dynamics.h"

static void acceleration_rows(const baum_workspace *w, const baum_dae *dae, const double *dv,
                              double *out)
{
  int nc = w->mechanism->nc;
  for (int i = 0; i < nc; i++) {
    double alpha = dae->alpha * baum_i_row_gain(w, i);
    double beta = dae->beta * baum_i_row_gain(w, i);
    out[i] = 2.0 * alpha * w->phi_rate[i] + beta * beta * w->phi[i] - w->gamma[i];
  }
  baum_i_jacobian_times(&w->structure, w->jacobian, dv, out);
}

/* Compute Phi, but Phi' in rows of velocity level. */
static void position_level_rows(const baum_workspace *w, double *out)
{
  for (int i = 0; i < w->mechanism->nc; i++) {
    out[i] = baum_i_is_velocity_row(w->mechanism, i) ? w->phi_rate[i] : w->phi[i];
  }
}

/* Compute the rows that belong to lambda. */
static void constraint_rows(const baum_workspace *w, const baum_dae *dae, const double *dv,
                            double *out)
{
  size_t bytes = (size_t)w->mechanism->nc * sizeof *out;
  switch (dae->index) {
  case BAUM_RESIDUAL_INDEX2:
  case BAUM_RESIDUAL_GGL: memcpy(out, w->phi_rate, bytes); break;
  case BAUM_RESIDUAL_INDEX3: position_level_rows(w, out); break;
  case BAUM_RESIDUAL_INDEX1:
  default: acceleration_rows(w, dae, dv, out); break;
  }
}

const double *baum_i_corrected_velocities(baum_workspace *w, const double *v, const double *mu)
{
  double *out = w->work_v;
  memset(out, 0, (size_t)w->mechanism->nv * sizeof *out);
  baum_i_jacobian_transposed_times(&w->structure, w->jacobian, mu, out);
  for (int i = 0; i < w->mechanism->nv; i++) {
    out[i] = v[i] - out[i] / w->metric[i];
  }
  return out;
}

/* Compute the rows of the positions, q' - N v. */
static void position_rows(const baum_mechanism *m, const double *q, const double *v,
                          const double *dq, double *out)
{
  const double *rates = baum_i_rates(m, q, v, out);
  for (int i = 0; i < m->nq; i++) {
    out[i] = dq[i] - rates[i];
  }
}

/* Set the residual of GGL for rows of velocity level, whose second equation is mu = 0. */
static void hold_velocity_rows(const baum_mechanism *m, const double *mu, double *rows)
{
  for (int i = 0; i < m->nc && m->velocity_rows; i++) {
    rows[i] = m->velocity_rows[i] ? mu[i] : rows[i];
  }
}

static void hold_omitted(const baum_workspace *w, const double *multipliers, double *rows)
{
  for (int i = 0; i < w->mechanism->nc && w->rows.count > 0; i++) {
    rows[i] = w->rows.omitted[i] ? multipliers[i] : rows[i];
  }
}

int baum_i_residual_size(const baum_mechanism *mechanism, baum_residual index)
{
  int multipliers = index == BAUM_RESIDUAL_GGL ? 2 * mechanism->nc : mechanism->nc;
  return mechanism->nq + mechanism->nv + multipliers;
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
  BAUM_I_TRY(baum_i_velocity_stage(w, t, y, v));
  for (int i = 0; i < nv; i++) {
    newton[i] = -w->force[i];
  }
  baum_i_mass_times(&w->structure, w->mass, dv, newton);
  baum_i_jacobian_transposed_times(&w->structure, w->jacobian, lambda, newton);
  constraint_rows(w, dae, dv, rows);
  hold_omitted(w, lambda, rows);
  if (dae->index == BAUM_RESIDUAL_GGL) {
    v = baum_i_corrected_velocities(w, v, lambda + nc);
    memcpy(rows + nc, w->phi, (size_t)nc * sizeof *rows);
    hold_velocity_rows(w->mechanism, lambda + nc, rows + nc);
    hold_omitted(w, lambda + nc, rows + nc);
  }
  position_rows(w->mechanism, y, v, dy, residual);
  return BAUM_OK;
}
