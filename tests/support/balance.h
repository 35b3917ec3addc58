/* SPDX-License-Identifier: BSD-3-Clause */
/* What joints do to their bodies together. */
#ifndef BAUM_TEST_BALANCE_H
#define BAUM_TEST_BALANCE_H

#include "point.h"

/* Forces and moments of every row on its bodies add up to nothing, for joints without ground, at
 * the present state: no row resists a motion of all its bodies as one. */
void check_rows_balance(test_point *p);

#endif
