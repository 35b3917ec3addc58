/* SPDX-License-Identifier: BSD-3-Clause */
/* Makes reports on a mechanism without a run. Each report chooses the configuration that it
 * describes. If the mechanism is not frozen, the report is made with a frozen copy. */
#ifndef BAUM_I_DYNAMICS_SNAPSHOT_H
#define BAUM_I_DYNAMICS_SNAPSHOT_H

#include "dynamics/dynamics.h"

/* The destination of a report. The report fills the struct `whole`. The part that fits is then
 * copied to the caller's struct `out`. */
typedef struct baum_i_snapshot_out {
  const char *call; /* name of the public function, for messages */
  void *out;
  size_t caller_size;
  void *whole;
  size_t size;
} baum_i_snapshot_out;

/* A function that makes a report and fills `whole` with it. q is zeroed scratch memory for nq + nv
 * numbers. */
typedef baum_status baum_i_report_fn(baum_workspace *w, double *q, void *whole);

/* Fill the report and copy it to the caller's struct. After a failure, nothing has been copied. */
baum_status baum_i_snapshot(const baum_mechanism *mechanism, baum_i_report_fn *make,
                            const baum_i_snapshot_out *to);

#endif
