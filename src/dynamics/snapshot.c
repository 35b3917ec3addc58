/* SPDX-License-Identifier: BSD-3-Clause */
#include "dynamics/snapshot.h"

#include "base/alloc.h"
#include "base/message.h"
#include "base/sized.h"

static baum_status report_on(const baum_mechanism *mechanism, baum_i_report_fn *make,
                             const baum_i_snapshot_out *to)
{
  baum_i_kept_message kept = baum_i_message_keep();
  baum_workspace *w = NULL;
  BAUM_I_TRY(baum_workspace_create(mechanism, &w));
  double *q = baum_i_alloc((size_t)mechanism->nq + (size_t)mechanism->nv, sizeof *q);
  baum_status status = q ? make(w, q, to->whole) : baum_i_fail_memory();
  if (status == BAUM_OK) {
    baum_i_give_sized(to->out, to->caller_size, to->whole, to->size);
  }
  baum_i_free(q);
  baum_workspace_destroy(w);
  return baum_i_message_settle(status, &kept);
}

/* Make a frozen copy of the mechanism, and make the report with this copy. */
static baum_status report_on_copy(const baum_mechanism *mechanism, baum_i_report_fn *make,
                                  const baum_i_snapshot_out *to)
{
  baum_mechanism *copy = NULL;
  BAUM_I_TRY(baum_mechanism_copy(mechanism, &copy));
  baum_status status = baum_mechanism_freeze(copy);
  if (status == BAUM_OK) {
    status = report_on(copy, make, to);
  }
  baum_mechanism_destroy(copy);
  return status;
}

baum_status baum_i_snapshot(const baum_mechanism *mechanism, baum_i_report_fn *make,
                            const baum_i_snapshot_out *to)
{
  BAUM_I_TRY(baum_i_check_sized(to->out, to->caller_size, to->call));
  if (!mechanism) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the mechanism is NULL", to->call);
  }
  return mechanism->frozen ? report_on(mechanism, make, to) : report_on_copy(mechanism, make, to);
}
