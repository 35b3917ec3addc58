/* SPDX-License-Identifier: BSD-3-Clause */
/* Reports on a mechanism, or a frozen copy of it, at a configuration of their own finding, outside
 * any run. */
#ifndef BAUM_I_DYNAMICS_SNAPSHOT_H
#define BAUM_I_DYNAMICS_SNAPSHOT_H

#include "dynamics/dynamics.h"

/* Where a report goes: the caller's struct, and a whole one to fill first. */
typedef struct baum_i_snapshot_out {
  const char *call; /* name of the public function, for messages */
  void *out;
  size_t caller_size;
  void *whole;
  size_t size;
} baum_i_snapshot_out;

/* Fills `whole`; q (nq + nv) is memory, zeroed. */
typedef baum_status baum_i_look(baum_workspace *w, double *q, void *whole);

/* Look at the mechanism, and give the report if that went well; else nothing is written. */
baum_status baum_i_snapshot(const baum_mechanism *mechanism, baum_i_look *look,
                            const baum_i_snapshot_out *to);

#endif
