/* SPDX-License-Identifier: BSD-3-Clause */
/* Evaluation of a whole mechanism. Where speed matters, one call evaluates a group of elements;
 * otherwise, each call evaluates one element. */
#include <string.h>

#include "base/message.h"
#include "mechanism/mechanism.h"

static void clear(double *values, int count)
{
  if (values) {
    memset(values, 0, (size_t)count * sizeof *values);
  }
}

/* ---- joints ---- */

baum_status baum_i_mechanism_rows(baum_i_point *point, const baum_i_rows *rows)
{
  for (const baum_i_joint_group *group = point->mechanism->joint_groups; group->type; group++) {
    BAUM_I_TRY(group->type->evaluate(group, point, rows));
  }
  return BAUM_OK;
}

baum_status baum_i_evaluate_each(const baum_i_joint_group *group, baum_i_point *point,
                                 const baum_i_rows *rows)
{
  for (int i = 0; i < group->count; i++) {
    BAUM_I_TRY(group->type->evaluate_one(group->joints[i], point, rows));
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
  clear(nu, point->mechanism->nc);
  return baum_i_mechanism_rows(point, &(baum_i_rows){.nu = nu});
}

baum_status baum_i_mechanism_gamma(baum_i_point *point, double *gamma)
{
  return baum_i_mechanism_rows(point, &(baum_i_rows){.gamma = gamma});
}

baum_status baum_i_mechanism_linearize_joints(baum_i_point *point, const double *w,
                                              const double *lambda,
                                              const baum_i_joint_blocks *blocks)
{
  const baum_mechanism *m = point->mechanism;
  clear(blocks->jw_q, m->jacobian_size);
  clear(blocks->gamma_q, m->jacobian_size);
  clear(blocks->gamma_v, m->jacobian_size);
  clear(blocks->nu_q, m->jacobian_size);
  clear(blocks->jtl_q, m->joint_square_size);
  for (const baum_i_joint_group *group = m->joint_groups; group->type; group++) {
    for (int i = 0; group->type->linearize && i < group->count; i++) {
      BAUM_I_TRY(group->type->linearize(group->joints[i], point, w, lambda, blocks));
    }
  }
  return BAUM_OK;
}

/* ---- bodies and forces ---- */

baum_status baum_i_mechanism_mass(baum_i_point *point, double *mass)
{
  for (const baum_i_body_group *group = point->mechanism->body_groups; group->type; group++) {
    BAUM_I_TRY(group->type->mass(group, point, mass));
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_add_body_forces(baum_i_point *point, bool constant, double *force)
{
  for (const baum_i_body_group *group = point->mechanism->body_groups; group->type; group++) {
    if (group->type->constant_force == constant) {
      BAUM_I_TRY(group->type->force(group, point, force));
    }
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_add_varying_forces(baum_i_point *point, double *force)
{
  BAUM_I_TRY(baum_i_mechanism_add_body_forces(point, false, force));
  for (const baum_i_force_group *group = point->mechanism->force_groups; group->type; group++) {
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

bool baum_i_has_constant_force(const baum_mechanism *mechanism)
{
  bool constant = mechanism->force_count == 0;
  for (const baum_i_body_group *group = mechanism->body_groups; group->type; group++) {
    constant = constant && group->type->constant_force;
  }
  return constant;
}

bool baum_i_has_constant_constraints(const baum_mechanism *mechanism)
{
  bool constant = true;
  for (int k = 0; k < mechanism->joint_count; k++) {
    constant = constant && mechanism->joints[k]->type->scleronomic;
  }
  return constant;
}

baum_status baum_i_mechanism_linearize_bodies(baum_i_point *point, const double *a,
                                              const baum_i_body_blocks *blocks)
{
  const baum_mechanism *m = point->mechanism;
  clear(blocks->ma_q, m->mass_size);
  clear(blocks->force_q, m->mass_size);
  clear(blocks->force_v, m->mass_size);
  for (const baum_i_body_group *group = m->body_groups; group->type; group++) {
    for (int i = 0; group->type->linearize && i < group->count; i++) {
      BAUM_I_TRY(group->type->linearize(group->bodies[i], point, a, blocks));
    }
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_linearize_forces(baum_i_point *point,
                                              const baum_i_force_blocks *blocks)
{
  const baum_mechanism *m = point->mechanism;
  clear(blocks->force_q, m->force_square_size);
  clear(blocks->force_v, m->force_square_size);
  for (const baum_i_force_group *group = m->force_groups; group->type; group++) {
    for (int i = 0; i < group->count; i++) {
      BAUM_I_TRY(group->type->linearize(group->forces[i], point, blocks));
    }
  }
  return BAUM_OK;
}

/* ---- energy ----
 *
 * A user function returns the potential of a force, but not the gradient of the potential. It is
 * therefore unknown which part of the power belongs to the potential. For forces with such a user
 * function, power() returns the power of the whole force. The change of the energy stored in the
 * potential is known exactly, as a difference of two values of the potential.
 */

static bool has_whole_power(const baum_i_force_type *type, const baum_i_force *force)
{
  return type->power_is_whole && type->power_is_whole(force);
}

static baum_status add_of_forces(const baum_i_force_group *group, baum_i_point *point,
                                 bool whole_power, double *sum)
{
  const baum_i_force_type *type = group->type;
  for (int i = 0; type->potential && i < group->count; i++) {
    if (!whole_power || has_whole_power(type, group->forces[i])) {
      double *own = whole_power ? &sum[type->whole_class] : sum;
      BAUM_I_TRY(type->potential(group->forces[i], point, own));
    }
  }
  return BAUM_OK;
}

/* Some elements compute their power from the whole force, including the part that has a potential.
 * If `whole_power` is set, include only these elements. Each potential is then added to the entry
 * of `sum` (BAUM_I_POWERS) for the class of the element. Otherwise add all potentials to *sum. */
static baum_status add_potentials(baum_i_point *point, bool whole_power, double *sum)
{
  const baum_mechanism *m = point->mechanism;
  double *of_bodies = whole_power ? &sum[BAUM_I_POWER_BODIES] : sum;
  for (const baum_i_body_group *group = m->body_groups; group->type; group++) {
    bool wanted = group->type->potential && (group->type->power || !whole_power);
    for (int i = 0; wanted && i < group->count; i++) {
      BAUM_I_TRY(group->type->potential(group->bodies[i], point, of_bodies));
    }
  }
  for (const baum_i_force_group *group = m->force_groups; group->type; group++) {
    BAUM_I_TRY(add_of_forces(group, point, whole_power, sum));
  }
  return BAUM_OK;
}

baum_status baum_i_mechanism_potential(baum_i_point *point, double *potential)
{
  *potential = 0.0;
  return add_potentials(point, false, potential);
}

baum_status baum_i_mechanism_potential_of_whole(baum_i_point *point,
                                                double potential[BAUM_I_POWERS])
{
  clear(potential, BAUM_I_POWERS);
  return add_potentials(point, true, potential);
}

baum_status baum_i_mechanism_power(baum_i_point *point, double power[BAUM_I_POWERS])
{
  const baum_mechanism *m = point->mechanism;
  clear(power, BAUM_I_POWERS);
  for (const baum_i_body_group *group = m->body_groups; group->type; group++) {
    for (int i = 0; group->type->power && i < group->count; i++) {
      BAUM_I_TRY(group->type->power(group->bodies[i], point, power));
    }
  }
  for (const baum_i_force_group *group = m->force_groups; group->type; group++) {
    for (int i = 0; i < group->count; i++) {
      BAUM_I_TRY(group->type->power(group->forces[i], point, power));
    }
  }
  return BAUM_OK;
}
