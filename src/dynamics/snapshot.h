/* SPDX-License-Identifier: BSD-3-Clause */
/* Reports on a mechanism without a run. The report chooses the configuration. If the mechanism is
 * not frozen, a frozen copy is used. */
#ifndef BAUM_I_DYNAMICS_SNAPSHOT_H
#define BAUM_I_DYNAMICS_SNAPSHOT_H

#include "dynamics/dynamics.h"

/* Destination of a report: the caller's struct, and a whole struct to fill first. */
typedef struct baum_i_snapshot_out {
  const char *call; /* name of the public function, for messages */
  void *out;
  size_t caller_size;
  void *whole;
  size_t size;
} baum_i_snapshot_out;

/* Fills `whole`; q (nq + nv) is memory, zeroed. */
typedef baum_status baum_i_look(baum_workspace *w, double *q, void *whole);

/* Fill the report, and copy it to the caller. Writes nothing on failure. */
baum_status baum_i_snapshot(const baum_mechanism *mechanism, baum_i_look *look,
                            const baum_i_snapshot_out *to);

#endif
