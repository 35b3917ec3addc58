/* SPDX-License-Identifier: BSD-3-Clause */
/* The stages of an evaluation: what depends on (t, q), then what depends on v as well. */
#include "dynamics/dynamics.h"

baum_status baum_i_evaluate_mass(baum_workspace *w)
{
  if (w->mass_ready) {
    return BAUM_OK;
  }
  baum_status status = baum_i_mechanism_mass(&w->point, w->mass);
  w->mass_ready = status == BAUM_OK && w->mechanism->constant_mass;
  return status;
}

static baum_status evaluate_position(baum_workspace *w)
{
  baum_status status = baum_i_mechanism_phi(&w->point, w->phi);
  if (status == BAUM_OK) {
    status = baum_i_mechanism_jacobian(&w->point, w->jacobian);
  }
  if (status == BAUM_OK) {
    status = baum_i_mechanism_nu(&w->point, w->nu);
  }
  return status;
}

/* Phi' = J v - nu (3) */
static void evaluate_rate(baum_workspace *w, const double *v)
{
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->phi_rate[i] = -w->nu[i];
  }
  baum_i_jacobian_times(&w->structure, w->jacobian, v, w->phi_rate);
}

baum_status baum_i_position_stage(baum_workspace *w, double t, const double *q)
{
  baum_i_point_set(&w->point, t, q, NULL);
  baum_status status = evaluate_position(w);
  return status == BAUM_OK ? baum_i_evaluate_mass(w) : status;
}

baum_status baum_i_violation(baum_workspace *w, double t, const double *q, const double *v)
{
  baum_i_point_set(&w->point, t, q, v);
  baum_status status = evaluate_position(w);
  if (status == BAUM_OK) {
    evaluate_rate(w, v);
  }
  return status;
}

baum_status baum_i_velocity_stage(baum_workspace *w, double t, const double *q, const double *v)
{
  baum_status status = baum_i_violation(w, t, q, v);
  if (status == BAUM_OK) {
    status = baum_i_evaluate_mass(w);
  }
  if (status == BAUM_OK) {
    status = baum_i_mechanism_gamma(&w->point, w->gamma);
  }
  if (status == BAUM_OK) {
    status = baum_i_mechanism_force(&w->point, w->force);
  }
  return status;
}
