/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks that the forces of a joint are in balance. */
#ifndef BAUM_TEST_BALANCE_H
#define BAUM_TEST_BALANCE_H

#include "point.h"

/* Checks every joint that has one row and does not involve ground. Such a joint does not resist a
 * rigid motion of all its bodies, so its forces and moments must add up to zero. Pins are not
 * checked, because the moments of their rows are only in balance if both points coincide. */
void check_rows_balance(test_point *p);

#endif
