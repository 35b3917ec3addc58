/* SPDX-License-Identifier: BSD-3-Clause */
/* What a run has cost on any machine.
 *
 *   work = evaluations + factorizations + iterations
 *
 * of right-hand sides or residuals, of matrices, and of the linear systems of implicit methods. An
 * explicit step pays two a stage, a step of CVODE's Adams three for each of its iterations.
 * Matrices of IDA and BDF are larger than that of (7), and what SUNDIALS does between evaluations
 * is not counted: CPU time tells.
 */
#include "study/study.h"

double baum_i_study_work(const baum_i_entry *entry)
{
  const baum_study_entry *r = &entry->out;
  return (double)(r->evaluations + r->factorizations + r->nonlinear_iterations);
}
