/* SPDX-License-Identifier: BSD-3-Clause */
/* IDA with a dense Jacobian from its own differences, for comparison with the exact one. Only in
 * builds with SUNDIALS. */
#ifndef DENSE_IDA_H
#define DENSE_IDA_H

#include "integrator_run.h"

/* Replaces the integrator of an open run. Release the replacement before the run is closed. One run
 * at a time. */
void dense_ida_use(integrator_run *run);
void dense_ida_release(void);

#endif
