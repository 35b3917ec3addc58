/* SPDX-License-Identifier: BSD-3-Clause */
/* IDA with a dense Jacobian, which IDA computes by finite differences. Tests compare runs with this
 * Jacobian and runs with the exact one. This file has code only in builds with SUNDIALS. */
#ifndef DENSE_IDA_H
#define DENSE_IDA_H

#include "integrator_run.h"

/* Replaces the integrator of an open run. The replacement must be released before the run is
 * closed. Only one run at a time can use it. */
void dense_ida_use(integrator_run *run);
void dense_ida_release(void);

#endif
