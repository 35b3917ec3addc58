/* SPDX-License-Identifier: BSD-3-Clause */
/* Reports on a mechanism without a run, in a configuration that the report chooses. If the
 * mechanism is not frozen, a frozen copy is used. */
#ifndef BAUM_I_DYNAMICS_SNAPSHOT_H
#define BAUM_I_DYNAMICS_SNAPSHOT_H

#include "dynamics/dynamics.h"

/* Destination of a report. The report fills `whole`, and as much of it as fits is copied to the
 * caller's struct `out`. */
typedef struct baum_i_snapshot_out {
  const char *call; /* name of the public function, for messages */
  void *out;
  size_t caller_size;
  void *whole;
  size_t size;
} baum_i_snapshot_out;

/* Fills `whole`. q is zeroed scratch memory (nq + nv). */
typedef baum_status baum_i_look(baum_workspace *w, double *q, void *whole);

/* Fill the report and copy it to the caller's struct. On failure nothing is copied. */
baum_status baum_i_snapshot(const baum_mechanism *mechanism, baum_i_look *look,
                            const baum_i_snapshot_out *to);

#endif
