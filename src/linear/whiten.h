/* SPDX-License-Identifier: BSD-3-Clause */
/* Whitens slender bodies in the saddle-point system.
 *
 * If the inertia tensor I of a body in space is nearly singular and not diagonal, no scaling of
 * single columns makes its block of M well-conditioned. With I = L L^T, the angular acceleration w'
 * is replaced by y = L^T w': the block becomes the identity, the columns of J for w' become J L^-T,
 * and the moment f becomes L^-1 f. */
#ifndef BAUM_I_LINEAR_WHITEN_H
#define BAUM_I_LINEAR_WHITEN_H

#include "linear/kkt.h"

typedef struct baum_i_whitening baum_i_whitening;

/* *out is NULL if no mass block has the size of a body in space. The structure's arrays must
 * outlive the result. Returns BAUM_OK or BAUM_ERR_MEMORY, without a message. */
baum_status baum_i_whitening_create(const baum_i_kkt_structure *structure, baum_i_whitening **out);
void baum_i_whitening_destroy(baum_i_whitening *whitening); /* NULL is allowed */

/* The functions below do nothing if `whitening` is NULL. The first function finds the slender
 * bodies, and replaces M and J in *values if there are any. In vectors of length nv, the second
 * function converts f to L^-1 f, and the third converts y to w'. */
void baum_i_whitening_set(baum_i_whitening *whitening, baum_i_kkt_values *values);
void baum_i_whitening_convert_force(const baum_i_whitening *whitening, double *f);
void baum_i_whitening_restore_motion(const baum_i_whitening *whitening, double *a);

#endif
