/* SPDX-License-Identifier: BSD-3-Clause */
/* Chooses the metric W that weights the correction of positions in the form GGL:
 *
 *   q' = v - W^-1 J^T mu,   W diagonal and constant,   W_jj = max(M_jj, E / s_j^2),
 *
 * Here s_j is the scale of coordinate j. E is a millionth of the largest M_kk s_k^2, or 1 if no
 * coordinate has mass. E makes W positive also for coordinates without mass. All products M_kk
 * s_k^2 have the same unit. The choice of units and a mixture of lengths and angles therefore do
 * not matter.
 *
 * Any positive definite W gives the same motion, because mu is zero in the exact solution. W only
 * decides how the error of a method is distributed among the coordinates. W does not change with q.
 * The Jacobian of the equations therefore needs no derivatives of W.
 */
#include <math.h>

#include "base/message.h"
#include "dynamics/dynamics.h"

static const double LEAST_SHARE = 1e-6;

void baum_i_choose_metric(baum_workspace *w)
{
  const double *scale = w->mechanism->scale;
  double largest = 0.0;
  for (int k = 0; k < w->structure.mass_block_count; k++) {
    const baum_i_mass_block *block = &w->structure.mass_blocks[k];
    for (int i = 0; i < block->size; i++) {
      int j = block->first + i;
      w->metric[j] = w->mass[block->value + i * block->size + i];
      largest = fmax(largest, w->metric[j] * scale[j] * scale[j]);
    }
  }
  double least = largest > 0.0 ? LEAST_SHARE * largest : 1.0;
  for (int j = 0; j < w->mechanism->nv; j++) {
    w->metric[j] = fmax(w->metric[j], least / (scale[j] * scale[j]));
  }
  w->metric_ready = true;
}

baum_status baum_i_need_metric(baum_workspace *w)
{
  if (w->metric_ready) {
    return BAUM_OK;
  }
  BAUM_I_TRY(baum_i_position_stage(w, 0.0, w->mechanism->design_q));
  baum_i_choose_metric(w);
  return BAUM_OK;
}
