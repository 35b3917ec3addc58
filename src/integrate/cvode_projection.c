/* SPDX-License-Identifier: BSD-3-Clause */
/* Projection within the steps of BDF (E. Eich, SIAM J. Numer. Anal. 30, 1993): after Newton's
 * iteration q and v are moved onto the constraints, by the least change in the metric of M. The
 * estimated error of q loses what points away from them, since the projection takes that off the
 * true error too:
 *
 *   e_q - P e_q,     P = M^-1 J^T (J M^-1 J^T)^-1 J at the projected q.
 *
 * That of v stays as it is. Its part across the constraints is not only what the projection takes
 * off: J e_v = -(J v)_q e_q is left by the error along them, and with P e_v taken away too errors
 * are twice as large at the same tolerance and the same cost (pendulum, slider-crank, four-bar,
 * Andrews, rtol 1e-4 to 1e-10).
 *
 * The history of the method is corrected by the same step, so that the next prediction begins
 * there. Adams' predictor and corrector work with f alone, whose past cannot be moved; CVODE
 * projects with BDF only.
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
  int nq = w->mechanism->nq;
  int nv = w->mechanism->nv;
  const double *state = N_VGetArrayPointer(y);
  double *projected = N_VGetArrayPointer(correction);
  memcpy(projected, state, (size_t)(nq + nv) * sizeof *state);
  baum_status status = baum_i_project(w, t, projected, projected + nq);
  if (status != BAUM_OK) {
    return answer(sundials, status);
  }
  subtract(nq + nv, state, projected);
  if (error) {
    double *normal = N_VGetArrayPointer(work);
    status = baum_i_normal_part(w, N_VGetArrayPointer(error), normal);
    subtract(status == BAUM_OK ? nv : 0, normal, N_VGetArrayPointer(error));
  }
  return status == BAUM_OK ? 0 : answer(sundials, status);
}

#endif
