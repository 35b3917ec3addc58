/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions of a whole mechanism. They share and destroy it, and evaluate all its elements. */
#ifndef BAUM_I_MECHANISM_MECHANISM_H
#define BAUM_I_MECHANISM_MECHANISM_H

#include "mechanism/identify.h"
#include "mechanism/model.h"

/* Tell whether a row is of velocity level: J v = nu without Phi. */
static inline bool baum_i_is_velocity_row(const baum_mechanism *mechanism, int row)
{
  return mechanism->velocity_rows && mechanism->velocity_rows[row];
}

/* Add an owner of a mechanism. Each owner must destroy the mechanism once. */
const baum_mechanism *baum_i_mechanism_share(const baum_mechanism *mechanism);

/* ---- fixed_bodies.c ---- */

/* Find the fixed bodies of a mechanism and their poses. The parameters of all elements must have
 * been set before. */
void baum_i_find_fixed_bodies(baum_mechanism *mechanism);
/* The first function sets the positions of fixed bodies in q (nq). The second one sets the
 * velocities of fixed bodies in v (nv) to zero. */
void baum_i_place_fixed_bodies(const baum_mechanism *mechanism, double *q);
void baum_i_rest_fixed_bodies(const baum_mechanism *mechanism, double *v);

/* Free everything that freezing has created, but not the elements. */
void baum_i_mechanism_thaw(baum_mechanism *mechanism);

/* ---- input.c ---- */

baum_status baum_i_copy_inputs(baum_mechanism *to, const baum_mechanism *from);
void baum_i_free_inputs(baum_mechanism *mechanism);

/* ---- body_outlines.c ---- */

/* Copy outlines together with their arrays and texts. Returns BAUM_OK or BAUM_ERR_MEMORY. *out is
 * NULL after a failure, and if the count is 0. */
baum_status baum_i_copy_outlines(const struct baum_outline *outlines, int count,
                                 struct baum_outline **out);
void baum_i_free_outlines(struct baum_outline *outlines, int count);

/* ---- evaluation of all elements ---- */

baum_status baum_i_mechanism_rows(baum_i_point *point, const baum_i_rows *rows);
/* Each of these functions evaluates one array: one member of baum_i_rows, the mass blocks or the
 * force. It sets all entries of the array. */
baum_status baum_i_mechanism_phi(baum_i_point *point, double *phi);           /* (nc) */
baum_status baum_i_mechanism_jacobian(baum_i_point *point, double *jacobian); /* (jacobian_size) */
baum_status baum_i_mechanism_nu(baum_i_point *point, double *nu);             /* (nc) */
baum_status baum_i_mechanism_gamma(baum_i_point *point, double *gamma);       /* (nc) */
baum_status baum_i_mechanism_mass(baum_i_point *point, double *mass);         /* (mass_size) */
baum_status baum_i_mechanism_force(baum_i_point *point, double *force);       /* (nv) */
/* Add forces of bodies to force (nv). If `constant` is set, add the forces of those bodies whose
 * force depends only on parameters. Otherwise add the forces of all other bodies. */
baum_status baum_i_mechanism_add_body_forces(baum_i_point *point, bool constant, double *force);
/* Add the forces of all bodies whose force is not constant, and of all force elements. */
baum_status baum_i_mechanism_add_varying_forces(baum_i_point *point, double *force);
baum_status baum_i_mechanism_potential(baum_i_point *point, double *potential);
/* Tell whether the force on every body depends only on parameters. */
bool baum_i_has_constant_force(const baum_mechanism *mechanism);
/* Tell whether no constraint depends on time, so that no driver moves the mechanism. */
bool baum_i_has_constant_constraints(const baum_mechanism *mechanism);
baum_status baum_i_mechanism_linearize_bodies(baum_i_point *point, const double *a,
                                              const baum_i_body_blocks *blocks);
baum_status baum_i_mechanism_linearize_joints(baum_i_point *point, const double *w,
                                              const double *lambda,
                                              const baum_i_joint_blocks *blocks);
baum_status baum_i_mechanism_linearize_forces(baum_i_point *point,
                                              const baum_i_force_blocks *blocks);

/* ---- for the energy account ---- */

/* Compute the power of each class of loads. The point must have velocities. */
baum_status baum_i_mechanism_power(baum_i_point *point, double power[BAUM_I_POWERS]);
/* Compute the potential of each class. Only those types are included whose power() uses the whole
 * force, including the part that has a potential. The energy account adds the change of these
 * potentials to the integral of the power. The sum is the work of the part that has no potential.
 */
baum_status baum_i_mechanism_potential_of_whole(baum_i_point *point,
                                                double potential[BAUM_I_POWERS]);

#endif
