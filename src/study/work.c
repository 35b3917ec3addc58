/* SPDX-License-Identifier: BSD-3-Clause */
/* What a run has cost on any machine. */
#include "integrate/integrator.h"
#include "study/study.h"

double baum_i_study_work(const baum_study *study, const baum_i_row *row)
{
  (void)study;
  const baum_study_row *r = &row->out;
  return (double)(r->evaluations + r->factorizations + r->nonlinear_iterations);
}
