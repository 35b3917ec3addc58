/* SPDX-License-Identifier: BSD-3-Clause */
/* Approximates the rotation of a rigid body without moments in a step h. The approximation is
 * symplectic, symmetric and of order 2.
 *
 * With principal moments I_0, I_1, I_2, a body with the angular momentum m in body axes has the
 * energy
 *
 *   m.m / (2 I_1) + m_0^2 (1/I_0 - 1/I_1) / 2  +  m_2^2 (1/I_2 - 1/I_1) / 2
 *
 * The first two terms are the energy of a symmetric top. In a step, the top rotates by the rotation
 * vector h m / I_1, and then about axis 0 by the angle h m_0 (1/I_0 - 1/I_1). The last term rotates
 * the body about axis 2, for half a step before the rotation of the top and for half a step after
 * it (F. Fasso, J. Comput. Phys. 189 (2003) 527-538). The angular momentum in ground axes does not
 * change. The rotation is exact for symmetric bodies, and for all bodies that rotate about a
 * principal axis.
 *
 * I_1 is the middle moment. Of the other two axes, axis 2 is the one with the smaller
 * |1/I - 1/I_1|. In a slender body, axis 0 is therefore the long axis.
 */
#ifndef BAUM_I_INTEGRATE_FREE_ROTATION_H
#define BAUM_I_INTEGRATE_FREE_ROTATION_H

typedef struct baum_i_free_rotation {
  double inverse_1; /* 1/I_1 */
  double axis_0[3]; /* unit vectors in body axes */
  double axis_2[3];
  double excess_0; /* 1/I_0 - 1/I_1 */
  double excess_2; /* 1/I_2 - 1/I_1 */
  double largest;  /* the largest of 1/I_0, 1/I_1 and 1/I_2 */
} baum_i_free_rotation;

baum_i_free_rotation baum_i_free_rotation_of(const double inertia[9]);

/* Advance the angular momentum, in body axes, by a step h. Write to w the constant angular
 * velocity, in body axes, that would rotate the body in the same way in the time h. */
void baum_i_rotate_freely(const baum_i_free_rotation *body, double h, double momentum[3],
                          double w[3]);

#endif
