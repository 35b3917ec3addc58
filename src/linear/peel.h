/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds rows of J whose independence follows from the structure. */
#ifndef BAUM_I_LINEAR_PEEL_H
#define BAUM_I_LINEAR_PEEL_H

#include "linear/kkt.h"

/* Removes row blocks that neither depend on other rows nor cause a dependence of other rows. The
 * rank of J is the rank of the remaining rows plus the number of removed rows. peeled (nc) must be
 * zero on entry and receives 1 for each removed row. Values are scaled as in
 * baum_i_jacobian_rank(). Rows with numbers that are not finite are not removed. Every row may
 * belong to at most one block. Returns BAUM_OK or BAUM_ERR_MEMORY, without a message. */
baum_status baum_i_peel(const baum_i_kkt_structure *structure, const double *jacobian,
                        const double *column_scale, unsigned char *peeled);

#endif
