/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism as a whole: create and destroy, and evaluate all elements. */
#ifndef BAUM_I_MECHANISM_MECHANISM_H
#define BAUM_I_MECHANISM_MECHANISM_H

#include "mechanism/identify.h"
#include "mechanism/model.h"

/* Share a mechanism; destroying it ends one share. */
const baum_mechanism *baum_i_mechanism_share(const baum_mechanism *mechanism);

/* ---- fixed_bodies.c ---- */

/* Called when all numbers are known. */
void baum_i_find_fixed_bodies(baum_mechanism *mechanism);
/* Set their part of q (nq); set their part of v (nv) to zero. */
void baum_i_place_fixed_bodies(const baum_mechanism *mechanism, double *q);
void baum_i_rest_fixed_bodies(const baum_mechanism *mechanism, double *v);

/* Free everything that freeze made; keeps the elements. */
void baum_i_mechanism_thaw(baum_mechanism *mechanism);

/* ---- input.c ---- */

baum_status baum_i_copy_inputs(baum_mechanism *to, const baum_mechanism *from);
void baum_i_free_inputs(baum_mechanism *mechanism);

/* ---- evaluation of all elements ---- */

baum_status baum_i_mechanism_rows(baum_i_point *point, const baum_i_rows *rows);
/* One of them; all entries are set. */
baum_status baum_i_mechanism_phi(baum_i_point *point, double *phi);           /* (nc) */
baum_status baum_i_mechanism_jacobian(baum_i_point *point, double *jacobian); /* (jacobian_size) */
baum_status baum_i_mechanism_nu(baum_i_point *point, double *nu);             /* (nc) */
baum_status baum_i_mechanism_gamma(baum_i_point *point, double *gamma);       /* (nc) */
baum_status baum_i_mechanism_mass(baum_i_point *point, double *mass);         /* (mass_size) */
baum_status baum_i_mechanism_force(baum_i_point *point, double *force);       /* (nv) */
/* Parts of the force, added to (nv): of the bodies whose force depends on parameters only, or of
 * the other bodies; */
baum_status baum_i_mechanism_add_body_forces(baum_i_point *point, bool constant, double *force);
/* of the other bodies and all forces. */
baum_status baum_i_mechanism_add_varying_forces(baum_i_point *point, double *force);
baum_status baum_i_mechanism_potential(baum_i_point *point, double *potential);
/* Whether the force on every body depends on parameters only. */
bool baum_i_has_constant_force(const baum_mechanism *mechanism);
baum_status baum_i_mechanism_linearize_bodies(baum_i_point *point, const double *a,
                                              const baum_i_body_blocks *blocks);
baum_status baum_i_mechanism_linearize_joints(baum_i_point *point, const double *w,
                                              const double *lambda,
                                              const baum_i_joint_blocks *blocks);
baum_status baum_i_mechanism_linearize_forces(baum_i_point *point,
                                              const baum_i_force_blocks *blocks);

/* ---- for the energy account ---- */

/* Powers by class; needs velocities. */
baum_status baum_i_mechanism_power(baum_i_point *point, double power[BAUM_I_POWERS]);
/* Potentials by class of the types whose power includes that of the potential. The account adds the
 * change of these potentials to their work. */
baum_status baum_i_mechanism_potential_of_whole(baum_i_point *point,
                                                double potential[BAUM_I_POWERS]);

#endif
