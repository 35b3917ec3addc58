/* SPDX-License-Identifier: BSD-3-Clause */
/* Balance of the forces of a joint. */
#ifndef BAUM_TEST_BALANCE_H
#define BAUM_TEST_BALANCE_H

#include "point.h"

/* Checks that forces and moments add up to zero for every joint that has one row and does not
 * involve ground: such a joint does not resist a rigid motion of all its bodies. (A pin is not
 * checked: its rows are in ground axes, and their moments balance only if the points coincide.) */
void check_rows_balance(test_point *p);

#endif
