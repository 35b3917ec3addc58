/* SPDX-License-Identifier: BSD-3-Clause */
/* What joints do to their bodies together. */
#ifndef BAUM_TEST_BALANCE_H
#define BAUM_TEST_BALANCE_H

#include "point.h"

/* Forces and moments on all its bodies add up to nothing for every joint of one row and without
 * ground, at the present state: it does not resist a motion of its bodies as one. (Two rows of a
 * pin are in ground axes; their moments balance only where the points coincide.) */
void check_rows_balance(test_point *p);

#endif
