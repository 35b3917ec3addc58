/* SPDX-License-Identifier: BSD-3-Clause */
/* IDA with a dense Jacobian that it computes by differences, for comparison with the exact
 * Jacobian. Only in builds with SUNDIALS. */
#ifndef DENSE_IDA_H
#define DENSE_IDA_H

#include "integrator_run.h"

/* Replaces the integrator of an open run. Release the replacement before you close the run. Only
 * one run at a time can have it. */
void dense_ida_use(integrator_run *run);
void dense_ida_release(void);

#endif
