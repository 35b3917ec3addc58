/* SPDX-License-Identifier: BSD-3-Clause */
/* Projection within the steps of BDF (E. Eich, SIAM J. Numer. Anal. 30, 1993): after Newton's iteration q and v are moved
 * onto the constraints, by the least change in the metric of M, and the estimate of the error loses what points away from
 * them, since the projection takes that off the true error too:
 *
 *   e_q - P e_q,  e_v - P e_v,     P = M^-1 J^T (J M^-1 J^T)^-1 J at the projected q.
 *
 * The history of the method is corrected by the same step, so that the next prediction begins there. Adams' predictor and
 * corrector work with f alone, whose past cannot be moved; CVODE projects with BDF only.
 */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include "integrate/cvode_projection.h"

#include <string.h>

static void subtract(int n, const double *what, double *from)
{
  for (int i = 0; i < n; i++) {
    from[i] -= what[i];
  }
}

/* Half of an error. */
static baum_status project_error(baum_workspace *w, double *error, double *work)
{
  baum_status status = baum_i_normal_part(w, error, work);
  if (status == BAUM_OK) {
    subtract(w->mechanism->nv, work, error);
  }
  return status;
}

/* What does not converge may do so closer to the last step. */
static int answer(baum_i_sundials *sundials, baum_status status)
{
  int answered = baum_i_sundials_answer(sundials, status);
  if (status == BAUM_ERR_CONVERGENCE || status == BAUM_ERR_SINGULAR) {
    sundials->stopped = false;
    return 1;
  }
  return answered;
}

int baum_i_cvode_project(baum_i_sundials *sundials, double t, N_Vector y, N_Vector correction,
                         N_Vector error, N_Vector work)
{
  baum_workspace *w = sundials->problem->workspace;
  int n = w->mechanism->nv;
  const double *state = N_VGetArrayPointer(y);
  double *projected = N_VGetArrayPointer(correction);
  memcpy(projected, state, 2 * (size_t)n * sizeof *state);
  baum_status status = baum_i_project(w, t, projected, projected + n);
  if (status != BAUM_OK) {
    return answer(sundials, status);
  }
  subtract(2 * n, state, projected);
  if (error) {
    double *e = N_VGetArrayPointer(error);
    status = project_error(w, e, N_VGetArrayPointer(work));
    status = status == BAUM_OK ? project_error(w, e + n, N_VGetArrayPointer(work)) : status;
  }
  return status == BAUM_OK ? 0 : 1;
}

#endif
