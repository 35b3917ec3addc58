/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the kinetic energy v^T M v / 2 and the potential energy of the elements. */
#include <string.h>

#include "base/message.h"
#include "dynamics/dynamics.h"

baum_status baum_i_energy(baum_workspace *w, double t, const double *q, const double *v,
                          double *kinetic, double *potential)
{
  int nv = w->mechanism->nv;
  baum_i_point_set(&w->point, t, q, v);
  BAUM_I_TRY(baum_i_evaluate_mass(w));
  double *momentum = w->work_v;
  memset(momentum, 0, (size_t)nv * sizeof *momentum);
  baum_i_mass_times(&w->structure, w->mass, v, momentum);
  double sum = 0.0;
  for (int i = 0; i < nv; i++) {
    sum += momentum[i] * v[i];
  }
  *kinetic = 0.5 * sum;
  return baum_i_mechanism_potential(&w->point, potential);
}
