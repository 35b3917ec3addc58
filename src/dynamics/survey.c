/* SPDX-License-Identifier: BSD-3-Clause */
#include "dynamics/survey.h"

#include "base/alloc.h"
#include "base/message.h"
#include "base/sized.h"

baum_status baum_i_survey(const baum_mechanism *mechanism, baum_i_look *look,
                          const baum_i_survey_out *to)
{
  baum_status status = baum_i_check_sized(to->out, to->caller_size, to->call);
  if (status == BAUM_OK) {
    status = baum_i_check_frozen(mechanism, to->call);
  }
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  baum_workspace *w = NULL;
  status = baum_workspace_create(mechanism, &w);
  if (status != BAUM_OK) {
    return status;
  }
  double *q = baum_i_alloc((size_t)mechanism->nq + (size_t)mechanism->nv, sizeof *q);
  status = q ? look(w, q, to->whole) : baum_i_fail_memory();
  if (status == BAUM_OK) {
    baum_i_give_sized(to->out, to->caller_size, to->whole, to->size);
  }
  baum_i_free(q);
  baum_workspace_destroy(w);
  return baum_i_message_settle(status, &kept);
}
