/* SPDX-License-Identifier: BSD-3-Clause */
/* Evaluation of a whole mechanism: one call per group. */
#include <string.h>

#include "base/message.h"
#include "mechanism/mechanism.h"

/* ---- joints ---- */

baum_status baum_i_mechanism_rows(baum_i_point *point, const baum_i_rows *rows)
{
  const baum_mechanism *mechanism = point->mechanism;
  for (int k = 0; k < mechanism->joint_group_count; k++) {
    const baum_i_joint_group *group = &mechanism->joint_groups[k];
    BAUM_I_TRY(group->type->evaluate(group, point, rows));
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_phi(baum_i_point *point, double *phi)
{
  return baum_i_mechanism_rows(point, &(baum_i_rows){.phi = phi});
}

baum_status baum_i_mechanism_jacobian(baum_i_point *point, double *jacobian)
{
  return baum_i_mechanism_rows(point, &(baum_i_rows){.jacobian = jacobian});
}

baum_status baum_i_mechanism_nu(baum_i_point *point, double *nu)
{
  memset(nu, 0, (size_t)point->mechanism->nc * sizeof *nu);
  return baum_i_mechanism_rows(point, &(baum_i_rows){.nu = nu});
}

baum_status baum_i_mechanism_gamma(baum_i_point *point, double *gamma)
{
  return baum_i_mechanism_rows(point, &(baum_i_rows){.gamma = gamma});
}

static void clear(double *values, int count)
{
  if (values) {
    memset(values, 0, (size_t)count * sizeof *values);
  }
}

baum_status baum_i_mechanism_linearize_joints(baum_i_point *point, const double *w,
                                              const double *lambda,
                                              const baum_i_joint_blocks *blocks)
{
  const baum_mechanism *mechanism = point->mechanism;
  clear(blocks->jw_q, mechanism->jacobian_size);
  clear(blocks->gamma_q, mechanism->jacobian_size);
  clear(blocks->gamma_v, mechanism->jacobian_size);
  clear(blocks->nu_q, mechanism->jacobian_size);
  clear(blocks->jtl_q, mechanism->joint_square_size);
  for (int k = 0; k < mechanism->joint_group_count; k++) {
    const baum_i_joint_group *group = &mechanism->joint_groups[k];
    for (int i = 0; group->type->linearize && i < group->count; i++) {
      BAUM_I_TRY(group->type->linearize(group->joints[i], point, w, lambda, blocks));
    }
  }
  return BAUM_OK;
}

/* ---- bodies and forces ---- */

baum_status baum_i_mechanism_mass(baum_i_point *point, double *mass)
{
  const baum_mechanism *mechanism = point->mechanism;
  for (int k = 0; k < mechanism->body_group_count; k++) {
    const baum_i_body_group *group = &mechanism->body_groups[k];
    BAUM_I_TRY(group->type->mass(group, point, mass));
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_add_body_forces(baum_i_point *point, bool constant, double *force)
{
  const baum_mechanism *mechanism = point->mechanism;
  for (int k = 0; k < mechanism->body_group_count; k++) {
    const baum_i_body_group *group = &mechanism->body_groups[k];
    if (group->type->constant_force == constant) {
      BAUM_I_TRY(group->type->force(group, point, force));
    }
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_add_varying_forces(baum_i_point *point, double *force)
{
  const baum_mechanism *mechanism = point->mechanism;
  BAUM_I_TRY(baum_i_mechanism_add_body_forces(point, false, force));
  for (int k = 0; k < mechanism->force_group_count; k++) {
    const baum_i_force_group *group = &mechanism->force_groups[k];
    BAUM_I_TRY(group->type->force(group, point, force));
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_force(baum_i_point *point, double *force)
{
  clear(force, point->mechanism->nv);
  BAUM_I_TRY(baum_i_mechanism_add_body_forces(point, true, force));
  return baum_i_mechanism_add_varying_forces(point, force);
}

baum_status baum_i_mechanism_potential(baum_i_point *point, double *potential)
{
  const baum_mechanism *mechanism = point->mechanism;
  *potential = 0.0;
  for (int k = 0; k < mechanism->body_group_count; k++) {
    const baum_i_body_group *group = &mechanism->body_groups[k];
    if (group->type->potential) {
      BAUM_I_TRY(group->type->potential(group, point, potential));
    }
  }
  for (int k = 0; k < mechanism->force_group_count; k++) {
    const baum_i_force_group *group = &mechanism->force_groups[k];
    if (group->type->potential) {
      BAUM_I_TRY(group->type->potential(group, point, potential));
    }
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_linearize_bodies(baum_i_point *point, const double *a,
                                              const baum_i_body_blocks *blocks)
{
  const baum_mechanism *mechanism = point->mechanism;
  clear(blocks->ma_q, mechanism->mass_size);
  clear(blocks->force_q, mechanism->mass_size);
  clear(blocks->force_v, mechanism->mass_size);
  for (int k = 0; k < mechanism->body_group_count; k++) {
    const baum_i_body_group *group = &mechanism->body_groups[k];
    for (int i = 0; group->type->linearize && i < group->count; i++) {
      BAUM_I_TRY(group->type->linearize(group->bodies[i], point, a, blocks));
    }
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_linearize_forces(baum_i_point *point,
                                              const baum_i_force_blocks *blocks)
{
  const baum_mechanism *mechanism = point->mechanism;
  clear(blocks->force_q, mechanism->force_square_size);
  clear(blocks->force_v, mechanism->force_square_size);
  for (int k = 0; k < mechanism->force_group_count; k++) {
    const baum_i_force_group *group = &mechanism->force_groups[k];
    for (int i = 0; i < group->count; i++) {
      BAUM_I_TRY(group->type->linearize(group->forces[i], point, blocks));
    }
  }
  return BAUM_OK;
}
