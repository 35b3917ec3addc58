/* SPDX-License-Identifier: BSD-3-Clause */
/* The first two stages of an evaluation (dynamics.h). The position stage computes the terms that
 * depend only on (t, q). The velocity stage also computes the terms that depend on v. */
#include <string.h>

#include "dynamics/dynamics.h"

baum_status baum_i_evaluate_mass(baum_workspace *w)
{
  if (w->mass_ready) {
    return BAUM_OK;
  }
  BAUM_I_TRY(baum_i_mechanism_mass(&w->point, w->mass));
  w->mass_ready = w->mechanism->constant_mass;
  return BAUM_OK;
}

/* Compute Phi' = J v - nu, equation (3). */
static void evaluate_rate(baum_workspace *w, const double *v)
{
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->phi_rate[i] = -w->nu[i];
  }
  baum_i_jacobian_times(&w->structure, w->jacobian, v, w->phi_rate);
}

baum_status baum_i_need_jacobian(baum_workspace *w)
{
  BAUM_I_TRY(w->jacobian_ready ? BAUM_OK : baum_i_mechanism_jacobian(&w->point, w->jacobian));
  w->jacobian_ready = true;
  return BAUM_OK;
}

/* Evaluate the rows at (t, q), and Phi' if v is given. */
static baum_status evaluate_rows(baum_workspace *w, double t, const double *q, const double *v,
                                 bool with_gamma)
{
  baum_i_point_set(&w->point, t, q, v);
  const baum_i_rows rows = {
    .phi = w->phi, .jacobian = w->jacobian, .nu = w->nu, .gamma = with_gamma ? w->gamma : NULL};
  baum_status status = baum_i_mechanism_rows(&w->point, &rows);
  w->jacobian_ready = status == BAUM_OK;
  if (status == BAUM_OK && v) {
    evaluate_rate(w, v);
  }
  return status;
}

baum_status baum_i_position_stage(baum_workspace *w, double t, const double *q)
{
  BAUM_I_TRY(evaluate_rows(w, t, q, NULL, false));
  return baum_i_evaluate_mass(w);
}

baum_status baum_i_violation(baum_workspace *w, double t, const double *q, const double *v)
{
  return evaluate_rows(w, t, q, v, false);
}

baum_status baum_i_velocity_stage(baum_workspace *w, double t, const double *q, const double *v)
{
  BAUM_I_TRY(evaluate_rows(w, t, q, v, true));
  BAUM_I_TRY(baum_i_evaluate_mass(w));
  return baum_i_mechanism_force(&w->point, w->force);
}

void baum_i_clear_fixed_rows(baum_workspace *w)
{
  for (int k = 0; k < w->mechanism->joint_count; k++) {
    const baum_i_joint *joint = w->mechanism->joints[k];
    if (joint->fixed) {
      memset(w->phi + joint->row, 0, (size_t)joint->rows * sizeof *w->phi);
      memset(w->phi_rate + joint->row, 0, (size_t)joint->rows * sizeof *w->phi_rate);
    }
  }
}
