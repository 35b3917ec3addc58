/* SPDX-License-Identifier: BSD-3-Clause */
/* Balance of the forces of a joint. */
#ifndef BAUM_TEST_BALANCE_H
#define BAUM_TEST_BALANCE_H

#include "point.h"

/* Checks that forces and moments add up to zero for every joint with one row that does not involve
 * ground, because such a joint does not resist a rigid motion of all its bodies. Pins are not
 * checked: the moments of their rows balance only if both points coincide. */
void check_rows_balance(test_point *p);

#endif
