/* SPDX-License-Identifier: BSD-3-Clause */
/* Rows of J whose independence follows from the structure. */
#ifndef BAUM_I_LINEAR_PEEL_H
#define BAUM_I_LINEAR_PEEL_H

#include "linear/kkt.h"

/* Removes, one after the other, row blocks that neither depend on other rows nor have others depend
 * on them. The rank of J is the rank of the rows that remain, plus the number of removed rows.
 * peeled (nc), zeroed, receives 1 for removed rows. Values are scaled as in baum_i_jacobian_rank().
 * Rows that are not finite stay. Every row belongs to one block at most. BAUM_OK or
 * BAUM_ERR_MEMORY, without a message. */
baum_status baum_i_peel(const baum_i_kkt_structure *structure, const double *jacobian,
                        const double *column_scale, unsigned char *peeled);

#endif
