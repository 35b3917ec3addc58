/* SPDX-License-Identifier: BSD-3-Clause */
/* Rows of J whose independence shows in the structure already. */
#ifndef BAUM_I_LINEAR_PEEL_H
#define BAUM_I_LINEAR_PEEL_H

#include "linear/kkt.h"

/* Take away row blocks that neither depend on other rows nor have others depend on them, one after
 * the other: J has the rank of the rows that are left, plus the number of the others. peeled (nc),
 * zeroed, receives 1 for the others. Values are scaled as in baum_i_jacobian_rank(); rows that are
 * not finite stay. Every row lies in one block at most. BAUM_OK or BAUM_ERR_MEMORY, without a
 * message. */
baum_status baum_i_peel(const baum_i_kkt_structure *structure, const double *jacobian,
                        const double *column_scale, unsigned char *peeled);

#endif
